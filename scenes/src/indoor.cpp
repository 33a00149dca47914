// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <vector>

#include "indoor_furniture.h"
#include "scene_recipe.h"

namespace rhview {
namespace {

using Vec = glm::dvec3;

constexpr double kRoomEdge = 6.0;  ///< from the middle of a wall to the middle of the next
constexpr double kCorridor = 2.4;
constexpr double kHall = 3.0;    ///< the corridor that joins the others, from x = 0
constexpr double kStairs = 2.0;  ///< the stair well lies beside the hall, from x = -2 to 0
constexpr double kFlight = 6.0;
constexpr double kLanding = 1.5;
constexpr double kFloorHeight = 3.3;
constexpr double kSlab = 0.3;  ///< top of the slab above the floor's zero
constexpr double kHalfWall = 0.1;
constexpr double kDoor = 1.1, kDoorHeight = 2.1;
constexpr int kSteps = 18;

/// A hole in a wall: [low, high] along it, [bottom, top] above the slab.
struct Opening {
    double low = 0.0, high = 0.0;
    double bottom = 0.0, top = kDoorHeight;
};

Opening door_at(double middle) {
    return {middle - 0.5 * kDoor, middle + 0.5 * kDoor};
}

Opening window_at(double middle) {
    return {middle - 0.9, middle + 0.9, 0.9, 2.3};
}

/// A floor of `rooms` × `rooms` rooms: rows in pairs with a corridor between them, all ending in the hall.
struct IndoorPlan {
    int rooms = 0;
    int floors = 0;
    std::uint64_t seed = 0;

    [[nodiscard]] int corridors() const { return (rooms + 1) / 2; }
    [[nodiscard]] double width() const { return kHall + kRoomEdge * rooms; }
    [[nodiscard]] double depth() const { return kRoomEdge * rooms + kCorridor * corridors(); }
    [[nodiscard]] double pair_z(int pair) const { return pair * (2.0 * kRoomEdge + kCorridor); }
    [[nodiscard]] double corridor_z(int pair) const { return pair_z(pair) + kRoomEdge + 0.5 * kCorridor; }
    /// The least z of a row of rooms.
    [[nodiscard]] double row_z(int row) const {
        return pair_z(row / 2) + (row % 2 == 0 ? 0.0 : kRoomEdge + kCorridor);
    }
    [[nodiscard]] double room_x(int room) const { return kHall + kRoomEdge * (room + 0.5); }
    [[nodiscard]] static double floor_y(int floor) { return floor * kFloorHeight; }
};

/// Adds a wall along x (or z) as boxes round its openings, which are in order and do not touch.
void add_wall(IndoorWriter& writer, bool along_x, double line, double from, double to, double y,
              const std::vector<Opening>& openings) {
    ShapeBuffer& wall = writer.start();
    const double bottom = y + kSlab, top = y + kFloorHeight;
    const auto add = [&](double a, double b, double low, double high) {
        if (along_x)
            add_box(wall, {}, {a, low, line - kHalfWall}, {b, high, line + kHalfWall});
        else
            add_box(wall, {}, {line - kHalfWall, low, a}, {line + kHalfWall, high, b});
    };
    double start = from;
    for (const Opening& opening : openings) {
        add(start, opening.low, bottom, top);
        add(opening.low, opening.high, bottom + opening.top, top);
        if (opening.bottom > 0.0) add(opening.low, opening.high, bottom, bottom + opening.bottom);
        start = opening.high;
    }
    add(start, to, bottom, top);
    writer.finish(IndoorMaterial::Plaster);
}

void add_slab(IndoorWriter& writer, IndoorMaterial material, double y, const glm::dvec2& low,
              const glm::dvec2& high) {
    writer.add_plain_box(material, {}, {low.x, y, low.y}, {high.x, y + kSlab, high.y});
}

/// Walls along x: at the outer sides with windows, beside corridors with doors, between pairs of rows closed.
void add_walls_along_x(IndoorWriter& writer, const IndoorPlan& plan, double y) {
    const double from = kHall + kHalfWall, to = plan.width() - kHalfWall;
    std::vector<Opening> doors, windows;
    for (int room = 0; room < plan.rooms; ++room) {
        doors.push_back(door_at(plan.room_x(room)));
        windows.push_back(window_at(plan.room_x(room)));
    }
    for (int pair = 0; pair < plan.corridors(); ++pair) {
        const double z = plan.pair_z(pair);
        const bool second_row = 2 * pair + 1 < plan.rooms;
        add_wall(writer, true, z + (pair == 0 ? kHalfWall : 0.0), from, to, y,
                 pair == 0 ? windows : std::vector<Opening>{});
        add_wall(writer, true, z + kRoomEdge, from, to, y, doors);
        if (second_row) add_wall(writer, true, z + kRoomEdge + kCorridor, from, to, y, doors);
    }
    add_wall(writer, true, plan.depth() - kHalfWall, from, to, y, windows);
    for (const double z : {kHalfWall, plan.depth() - kHalfWall})
        add_wall(writer, true, z, kHalfWall, kHall - kHalfWall, y, {window_at(0.5 * kHall)});
}

/// Walls along z: the outer ones, the hall's (open to the corridors), and those between rooms, some with a
/// door.
void add_walls_along_z(IndoorWriter& writer, SceneRandom& random, const IndoorPlan& plan, double y) {
    std::vector<Opening> mouths, windows;
    for (int pair = 0; pair < plan.corridors(); ++pair) {
        const double z = plan.corridor_z(pair);
        mouths.push_back({z - 0.5 * kCorridor + kHalfWall, z + 0.5 * kCorridor - kHalfWall, 0.0, 2.6});
        windows.push_back({z - 0.6, z + 0.6, 0.9, 2.3});
    }
    const double stairs_end = 2.0 * kLanding + kFlight;
    std::vector<Opening> hall_openings{door_at(0.5 * kLanding + kHalfWall),
                                       door_at(stairs_end - 0.5 * kLanding)};
    for (double z = stairs_end + 3.0; z + 2.0 < plan.depth(); z += 4.0) hall_openings.push_back(window_at(z));
    add_wall(writer, false, 0.0, 0.0, plan.depth(), y, hall_openings);
    add_wall(writer, false, kHall, 0.0, plan.depth(), y, mouths);
    add_wall(writer, false, plan.width(), 0.0, plan.depth(), y, windows);
    for (int row = 0; row < plan.rooms; ++row) {
        const double low = plan.row_z(row) + kHalfWall, high = plan.row_z(row) + kRoomEdge - kHalfWall;
        for (int room = 1; room < plan.rooms; ++room) {
            std::vector<Opening> doors;
            if (random.chance(0.3)) doors.push_back(door_at(plan.row_z(row) + 0.5 * kRoomEdge));
            add_wall(writer, false, kHall + kRoomEdge * room, low, high, y, doors);
        }
    }
}

/// The well's outer walls, its landings, and a flight of stairs up to the next floor.
void add_stairs(IndoorWriter& writer, double y, bool lowest, bool flight_up) {
    const double end = 2.0 * kLanding + kFlight;
    add_wall(writer, false, -kStairs, 0.0, end, y, {window_at(0.5 * end)});
    for (const double z : {kHalfWall, end - kHalfWall})
        add_wall(writer, true, z, -kStairs + kHalfWall, -kHalfWall, y, {});
    add_slab(writer, IndoorMaterial::Concrete, y, {-kStairs, 0.0}, {0.0, kLanding});
    add_slab(writer, IndoorMaterial::Concrete, y, {-kStairs, end - kLanding}, {0.0, end});
    if (lowest) add_slab(writer, IndoorMaterial::Concrete, y, {-kStairs, kLanding}, {0.0, end - kLanding});
    if (!flight_up) return;
    ShapeBuffer& steps = writer.start();
    for (int step = 0; step < kSteps; ++step) {
        const double top = y + kSlab + kFloorHeight * (step + 1) / kSteps,
                     z = kLanding + kFlight * step / kSteps;
        add_box(steps, {}, {-kStairs + kHalfWall, top - 0.25, z},
                {-kHalfWall, top - 0.001, z + kFlight / kSteps});
    }
    writer.finish(IndoorMaterial::Concrete);
}

void add_storey(IndoorWriter& writer, SceneRandom& random, const IndoorPlan& plan, int floor) {
    const double y = IndoorPlan::floor_y(floor), ceiling = y + kFloorHeight;
    add_walls_along_x(writer, plan, y);
    add_walls_along_z(writer, random, plan, y);
    add_stairs(writer, y, floor == 0, floor + 1 < plan.floors);
    add_slab(writer, IndoorMaterial::Concrete, y, {0.0, 0.0}, {kHall, plan.depth()});
    for (int pair = 0; pair < plan.corridors(); ++pair) {
        const double z = plan.pair_z(pair) + kRoomEdge;
        add_lamp(writer, {0.5 * kHall, ceiling, z - 0.5 * kRoomEdge});
        add_slab(writer, IndoorMaterial::Concrete, y, {kHall, z}, {plan.width(), z + kCorridor});
        for (int room = 0; room < plan.rooms; ++room)
            add_lamp(writer, {plan.room_x(room), ceiling, z + 0.5 * kCorridor});
    }
    for (int row = 0; row < plan.rooms; ++row) {
        for (int room = 0; room < plan.rooms; ++room) {
            const double x = plan.room_x(room), z = plan.row_z(row), half = 0.5 * kRoomEdge;
            add_slab(writer, IndoorMaterial::Parquet, y, {x - half, z}, {x + half, z + kRoomEdge});
            furnish_room(writer, random, {{x, y + kSlab, z + half}});
        }
    }
}

/// From the corridor at z = `corridor` through the door of a room, a look round, and out again.
void visit_room(CameraPath& path, const Vec& door, double row_middle) {
    const double side = row_middle > door.z ? 1.0 : -1.0;
    const Vec room(door.x, door.y, row_middle);
    add_key(path, 1, door, {0.1, 0, side});
    add_key(path, 3, room - Vec(0, 0, 0.8 * side), {-0.8, -0.2, 0.8 * side});
    add_key(path, 4, room + Vec(0, 0, 0.8 * side), {1, -0.2, 0.5 * side});
    add_key(path, 4, room + Vec(0, 0, 0.8 * side), {1, -0.2, -0.8 * side});
    add_key(path, 3, room, {-1, -0.1, -0.7 * side});
    add_key(path, 1, room - Vec(0, 0, 0.2 * side), {-0.1, -0.1, -side});
    add_key(path, 3, door, {0.4, 0, -side});
}

/// One storey: along a corridor, into rooms on either side of it, and back through the hall.
void walk_storey(CameraPath& path, const IndoorPlan& plan, int floor) {
    const double eye = IndoorPlan::floor_y(floor) + kSlab + 1.6, hall = 0.5 * kHall, half = 0.5 * kRoomEdge;
    const int pair = floor % plan.corridors(), first = plan.rooms / 4,
              second = (plan.rooms + floor) / 2 % plan.rooms;
    const double z = plan.corridor_z(pair);
    add_key(path, 2, {hall, eye, 0.5 * kLanding + kHalfWall}, {0.1, 0, 1});
    add_key(path, 2.0 + 1.2 * pair, {hall, eye, z - 0.3}, {0.3, 0, 1});
    add_key(path, 2, {hall + 0.3, eye, z}, {1, 0, 0});
    add_key(path, 2.0 + first, {plan.room_x(first) - 0.3, eye, z}, {1, 0, -0.2});
    visit_room(path, {plan.room_x(first), eye, z}, plan.row_z(2 * pair) + half);
    if (2 * pair + 1 < plan.rooms && second > first) {
        add_key(path, 2, {plan.room_x(first) + 0.3, eye, z}, {1, 0, 0});
        add_key(path, 1.0 + second - first, {plan.room_x(second) - 0.3, eye, z}, {1, 0, 0.2});
        visit_room(path, {plan.room_x(second), eye, z}, plan.row_z(2 * pair + 1) + half);
    }
    add_key(path, 2, {plan.room_x(std::max(first, second)) + 0.3, eye, z}, {1, 0, 0.1});
    add_key(path, 1.0 + 0.5 * plan.rooms, {plan.width() - 1.5, eye, z}, {1, 0, -0.1});
    add_key(path, 3, {plan.width() - 1.7, eye, z}, {-1, 0, -0.05});
    add_key(path, 2.0 + plan.rooms, {hall, eye, z}, {-1, 0, -0.6});
}

/// Through the stair well to the next floor, and out to the hall.
void walk_stairs(CameraPath& path, int floor) {
    const double eye = IndoorPlan::floor_y(floor) + kSlab + 1.6, hall = 0.5 * kHall, well = -0.5 * kStairs;
    const double foot = 0.5 * kLanding + kHalfWall, end = 2.0 * kLanding + kFlight,
                 head = end - 0.5 * kLanding;
    add_key(path, 1, {hall, eye, foot + 0.6}, {-0.3, 0, -1});
    add_key(path, 1, {hall, eye, foot}, {-1, 0, -0.1});
    add_key(path, 2, {well, eye, foot}, {-0.2, 0.1, 1});
    add_key(path, 1, {well, eye, kLanding}, {0, 0.2, 1});
    add_key(path, 4, {well, eye + kFloorHeight, kLanding + kFlight}, {0.1, 0.1, 1});
    add_key(path, 1, {well, eye + kFloorHeight, head}, {1, 0, 0.1});
    add_key(path, 2, {hall, eye + kFloorHeight, head}, {0.3, 0, -1});
}

CameraPath walk_through_rooms(const IndoorPlan& plan) {
    CameraPath path;
    path.near_m = 0.05;
    path.far_m = 2.0 * (plan.width() + plan.depth()) + 50.0;
    for (int floor = 0; floor < plan.floors; ++floor) {
        walk_storey(path, plan, floor);
        if (floor + 1 < plan.floors) walk_stairs(path, floor);
    }
    return path;
}

SceneSize indoor_size(ParameterValues values) {
    const auto floors = static_cast<std::uint64_t>(values[1]),
               rooms = static_cast<std::uint64_t>(values[0] * values[0]);
    // Measured means are 6,700 triangles and 8,400 vertices for a room.
    return {floors * (rooms * 7500 + 5000), floors * (rooms * 9500 + 8000),
            sizeof(glm::vec3) + sizeof(PackedNormal), 0};
}

Result<SceneAndPath> build_indoor(ParameterValues values, const std::string& name) {
    const IndoorPlan plan{static_cast<int>(values[0]), static_cast<int>(values[1]),
                          static_cast<std::uint64_t>(values[2])};
    SceneBuilder builder;
    IndoorWriter writer(builder);
    writer.reserve(indoor_size(values).vertices);
    for (int floor = 0; floor < plan.floors; ++floor) {
        SceneRandom random(hash_of_cell(plan.seed, floor, 0, 0));
        add_storey(writer, random, plan, floor);
    }
    const double roof = IndoorPlan::floor_y(plan.floors);
    add_slab(writer, IndoorMaterial::Concrete, roof, {0.0, 0.0}, {plan.width(), plan.depth()});
    add_slab(writer, IndoorMaterial::Concrete, roof, {-kStairs, 0.0}, {0.0, 2.0 * kLanding + kFlight});
    return with_path(builder.finish(name), walk_through_rooms(plan));
}

constexpr std::array<SceneParameter, 3> kParameters{{
    {"rooms", 12, 2, 256, "rooms along each side of a floor"},
    {"floors", 3, 1, 100, "storeys"},
    {"seed", 1, 0, kLargestSeed, "other furniture and doors"},
}};

}  // namespace

const SceneRecipe& indoor_recipe() {
    static const SceneRecipe recipe{
        {"indoor",
         "furnished rooms along corridors on several floors, walked through doors and up the stairs",
         "2,932,184 triangles in 14,883 objects", kParameters},
        indoor_size,
        build_indoor};
    return recipe;
}

}  // namespace rhview
