// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "indoor_furniture.h"

namespace rhview {
namespace {

using Vec = glm::dvec3;

void add_table(IndoorWriter& writer, SceneRandom& random, const Frame& at, double half_x, double half_z) {
    const IndoorMaterial wood = random.chance(0.5) ? IndoorMaterial::Oak : IndoorMaterial::Walnut;
    ShapeBuffer& table = writer.start();
    add_box(table, at, {-half_x, 0.71, -half_z}, {half_x, 0.75, half_z});
    for (const double x : {-half_x + 0.08, half_x - 0.08})
        for (const double z : {-half_z + 0.08, half_z - 0.08})
            add_turned(
                table, at.moved({x, 0.0, z}),
                {{0.0, 0.0}, {0.03, 0.0}, {0.02, 0.1}, {0.04, 0.2}, {0.03, 0.5}, {0.05, 0.6}, {0.04, 0.71}},
                8);
    writer.finish(wood);
}

/// Its back is on the +z side of its frame.
void add_chair(IndoorWriter& writer, const Frame& at, IndoorMaterial cloth) {
    ShapeBuffer& chair = writer.start();
    for (const double x : {-0.19, 0.19}) {
        add_turned(chair, at.moved({x, 0.0, -0.19}), {{0.0, 0.0}, {0.015, 0.0}, {0.025, 0.3}, {0.02, 0.44}},
                   6);
        add_turned(chair, at.moved({x, 0.0, 0.19}),
                   {{0.0, 0.0}, {0.015, 0.0}, {0.025, 0.44}, {0.015, 1.0}, {0.0, 1.0}}, 6);
    }
    for (const double y : {0.62, 0.78, 0.92}) add_box(chair, at, {-0.18, y, 0.18}, {0.18, y + 0.06, 0.2});
    writer.finish(IndoorMaterial::Oak);
    add_sphere(writer.start(), at.moved({0.0, 0.46, 0.0}), 0.23, 0.05, 12, 6);
    writer.finish(cloth);
}

void add_vase(ShapeBuffer& buffer, const Frame& at, double scale) {
    add_turned(buffer, at,
               {{0.0, 0.0},
                {0.5 * scale, 0.0},
                {0.8 * scale, 0.5 * scale},
                {0.85 * scale, 0.9 * scale},
                {0.6 * scale, 1.4 * scale},
                {0.3 * scale, 1.7 * scale},
                {0.45 * scale, 2.0 * scale},
                {0.0, 1.95 * scale}},
               7);
}

/// Boards with books and pots on them; its back is the plane z = 0 of its frame, its front at z = 0.35.
void add_shelf(IndoorWriter& writer, SceneRandom& random, const Frame& at) {
    constexpr double kHalf = 0.9, kBoard = 0.03, kStep = 0.46;
    constexpr int kBoards = 5;
    ShapeBuffer& frame = writer.start();
    for (int board = 0; board < kBoards; ++board)
        add_box(frame, at, {-kHalf, 0.05 + board * kStep, 0.02},
                {kHalf, 0.05 + board * kStep + kBoard, 0.35});
    for (const double x : {-kHalf - kBoard, kHalf})
        add_box(frame, at, {x, 0.0, 0.0}, {x + kBoard, 2.1, 0.35});
    add_box(frame, at, {-kHalf, 0.0, 0.0}, {kHalf, 2.1, 0.02});
    writer.finish(IndoorMaterial::Walnut);

    for (int board = 0; board + 1 < kBoards; ++board) {
        const double y = 0.05 + board * kStep + kBoard;
        const bool pots = random.chance(0.12);
        ShapeBuffer& items = writer.start();
        double x = -kHalf + 0.05;
        while (x < kHalf - 0.15) {
            if (pots) {
                const double scale = random.between(0.06, 0.1);
                add_vase(items, at.moved({x + scale, y, 0.19}), scale);
                x += 2.0 * scale + random.between(0.02, 0.08);
            } else {
                const double thick = random.between(0.04, 0.1), tall = random.between(0.18, 0.3);
                add_box(items, at, {x, y, 0.08}, {x + thick, y + tall, random.between(0.24, 0.31)});
                x += thick + (random.chance(0.08) ? 0.15 : 0.002);
            }
        }
        constexpr std::array<IndoorMaterial, 4> kBooks{IndoorMaterial::Paper, IndoorMaterial::Leather,
                                                       IndoorMaterial::RedCloth, IndoorMaterial::BlueCloth};
        writer.finish(pots ? IndoorMaterial::Ceramic : kBooks[static_cast<std::size_t>(random.below(4))]);
    }
}

/// Its back is on the -z side.
void add_sofa(IndoorWriter& writer, SceneRandom& random, const Frame& at) {
    const IndoorMaterial cloth = random.chance(0.5) ? IndoorMaterial::RedCloth : IndoorMaterial::BlueCloth;
    ShapeBuffer& sofa = writer.start();
    add_box(sofa, at, {-0.95, 0.1, -0.4}, {0.95, 0.35, 0.4});
    add_box(sofa, at, {-0.95, 0.35, -0.4}, {0.95, 0.85, -0.2});
    for (const double x : {-0.95, 0.8}) add_box(sofa, at, {x, 0.35, -0.2}, {x + 0.15, 0.6, 0.4});
    for (const double x : {-0.4, 0.4}) add_sphere(sofa, at.moved({x, 0.38, 0.1}), 0.38, 0.13, 14, 7);
    writer.finish(cloth);
}

void add_plant(IndoorWriter& writer, SceneRandom& random, const Frame& at) {
    add_vase(writer.start(), at, 0.2);
    writer.finish(IndoorMaterial::Ceramic);
    ShapeBuffer& leaves = writer.start();
    for (int i = 0; i < 5; ++i) {
        const double height = random.between(0.5, 1.3), reach = random.between(0.0, 0.25);
        const CosSin turn = cos_sin_of_turns(random.unit());
        add_sphere(leaves, at.moved({reach * turn.cos, height, reach * turn.sin}), 0.16, 0.1, 8, 4);
    }
    writer.finish(IndoorMaterial::Leaf);
}

void add_cabinet(IndoorWriter& writer, const Frame& at) {
    ShapeBuffer& cabinet = writer.start();
    add_box(cabinet, at, {-0.5, 0.0, 0.0}, {0.5, 1.3, 0.45});
    for (int drawer = 0; drawer < 4; ++drawer) {
        const double y = 0.06 + 0.31 * drawer;
        add_box(cabinet, at, {-0.46, y, 0.45}, {0.46, y + 0.27, 0.47});
        add_torus(cabinet, {at.point({0.0, y + 0.14, 0.48}), at.x, at.z, -at.y}, 0.04, 0.01, 10, 4);
    }
    writer.finish(IndoorMaterial::Steel);
}

void add_dining_group(IndoorWriter& writer, SceneRandom& random, const Frame& at) {
    add_table(writer, random, at, 0.5, 0.9);
    const IndoorMaterial cloth = random.chance(0.5) ? IndoorMaterial::Leather : IndoorMaterial::BlueCloth;
    for (const double z : {-0.45, 0.45}) {
        for (const double side : {-1.0, 1.0}) {
            const Frame chair{at.point({0.75 * side, 0.0, z}), -side * at.z, at.y, side * at.x};
            add_chair(writer, chair, cloth);
        }
    }
    ShapeBuffer& cups = writer.start();
    for (int i = 0; i < 4; ++i)
        add_vase(cups, at.moved({random.between(-0.4, 0.4), 0.75, random.between(-0.8, 0.8)}), 0.05);
    writer.finish(IndoorMaterial::Ceramic);
}

}  // namespace

IndoorWriter::IndoorWriter(SceneBuilder& builder) : builder_(builder) {
    constexpr std::array<glm::vec3, kIndoorMaterials> kColours{{{0.74f, 0.72f, 0.66f},
                                                                {0.42f, 0.42f, 0.41f},
                                                                {0.44f, 0.28f, 0.14f},
                                                                {0.50f, 0.33f, 0.16f},
                                                                {0.22f, 0.12f, 0.06f},
                                                                {0.48f, 0.50f, 0.52f},
                                                                {0.48f, 0.08f, 0.07f},
                                                                {0.08f, 0.16f, 0.40f},
                                                                {0.76f, 0.70f, 0.56f},
                                                                {0.26f, 0.13f, 0.07f},
                                                                {0.16f, 0.42f, 0.44f},
                                                                {0.10f, 0.32f, 0.08f},
                                                                {0.90f, 0.86f, 0.70f}}};
    constexpr std::array<const char*, kIndoorMaterials> kNames{
        "plaster",    "concrete", "parquet", "oak",     "walnut", "steel",     "red cloth",
        "blue cloth", "paper",    "leather", "ceramic", "leaf",   "lamp glass"};
    for (std::size_t i = 0; i < kIndoorMaterials; ++i)
        materials_[i] = builder.add_material({kNames[i], kColours[i]});
}

void IndoorWriter::reserve(std::size_t vertices) {
    builder_.reserve(materials_[0], true, false, vertices, 0);
}

ShapeBuffer& IndoorWriter::start() {
    buffer_.clear();
    return buffer_;
}

void IndoorWriter::finish(IndoorMaterial material) {
    builder_.add_static(materials_[static_cast<std::size_t>(material)], buffer_.piece());
}

void IndoorWriter::add_plain_box(IndoorMaterial material, const Frame& frame, const Vec& low,
                                 const Vec& high) {
    add_box(start(), frame, low, high);
    finish(material);
}

void add_lamp(IndoorWriter& writer, const Vec& ceiling) {
    add_cylinder(writer.start(), {ceiling - Vec(0.0, 0.5, 0.0)}, 0.015, 0.015, 0.5, 6);
    writer.finish(IndoorMaterial::Steel);
    add_sphere(writer.start(), {ceiling - Vec(0.0, 0.6, 0.0)}, 0.22, 0.14, 12, 6);
    writer.finish(IndoorMaterial::LampGlass);
}

void furnish_room(IndoorWriter& writer, SceneRandom& random, const Frame& room) {
    // Shelves stand back to the walls on either side; what stands before them leaves the middle free.
    for (const double side : {-1.0, 1.0}) {
        const auto by_wall = [&](double z) {
            return Frame{room.point({2.85 * side, 0.0, z}), side * room.z, room.y, -side * room.x};
        };
        add_shelf(writer, random, by_wall(-1.85));
        if (random.chance(0.15))
            add_shelf(writer, random, by_wall(1.8));
        else
            add_cabinet(writer, by_wall(1.8));
        const Frame middle = room.moved({1.65 * side, 0.0, 0.0});
        const int kind = random.below(3);
        if (kind == 0) add_dining_group(writer, random, middle.moved({-0.1 * side, 0.0, 0.0}));
        if (kind == 1) {
            add_sofa(writer, random,
                     {room.point({2.3 * side, 0.0, 0.0}), side * room.z, room.y, -side * room.x});
            add_table(writer, random, room.moved({1.2 * side, 0.0, 0.0}), 0.35, 0.5);
        }
        if (kind == 2) {
            add_table(writer, random, middle, 0.4, 0.8);
            add_chair(writer, middle.moved({0.0, 0.0, 1.0}), IndoorMaterial::Leather);
        }
        add_plant(writer, random, room.moved({2.5 * side, 0.0, side > 0.0 ? -0.45 : 0.45}));
    }
    add_lamp(writer, room.point({0.0, 2.98, -1.4}));
    add_lamp(writer, room.point({0.0, 2.98, 1.4}));
}

}  // namespace rhview
