// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "loops.h"
#include "scene_recipe.h"
#include "shapes.h"

namespace rhview {
namespace {

using Vec = glm::dvec3;

constexpr double kCourt = 25.0;  ///< edge of a court
constexpr int kCourts = 8;       ///< on each side of the street
constexpr double kHalfLength = 0.5 * kCourt * kCourts;
constexpr double kHalfStreet = 6.0;
constexpr double kWall = 0.5, kWallHeight = 6.0;
constexpr double kStone = 0.5;   ///< edge of a wall's quads, which divides all of the above
constexpr double kMargin = 1.5;  ///< that the walkers keep from the walls
constexpr std::int64_t kKinds = 4;
constexpr std::int64_t kMostOnStreet = 1000;

class Crowd {
  public:
    Crowd(SceneBuilder& builder, std::uint64_t seed);

    void add_ground();
    void add_walls();
    void add_walkers(std::int64_t behind_walls, std::int64_t on_street, std::int64_t mesh_triangles);

  private:
    /// From `low` to `high`, in stones: what is drawn of a wall is not two triangles.
    void add_wall(const Vec& low, const Vec& high);
    void add_face(const Vec& corner, const Vec& along, const Vec& up);
    void add_walker(MeshId mesh, const Vec& low, const Vec& high);

    SceneBuilder& builder_;
    SceneRandom random_;
    ShapeBuffer buffer_;
    MaterialId ground_, stone_;
    std::array<MaterialId, kKinds> cloth_;
};

Crowd::Crowd(SceneBuilder& builder, std::uint64_t seed) : builder_(builder), random_(seed) {
    ground_ = builder.add_material({"paving", {0.42f, 0.40f, 0.37f}});
    stone_ = builder.add_material({"stone", {0.62f, 0.56f, 0.46f}});
    cloth_ = {builder.add_material({"red cloth", {0.55f, 0.10f, 0.08f}}),
              builder.add_material({"blue cloth", {0.10f, 0.18f, 0.45f}}),
              builder.add_material({"green cloth", {0.12f, 0.36f, 0.14f}}),
              builder.add_material({"white cloth", {0.75f, 0.73f, 0.68f}})};
}

void Crowd::add_face(const Vec& corner, const Vec& along, const Vec& up) {
    const Vec normal = glm::normalize(glm::cross(along, up));
    const auto stones = [](const Vec& edge) {
        return static_cast<int>(std::max(1.0, std::round(glm::length(edge) / kStone)));
    };
    const int columns = stones(along), rows = stones(up);
    const auto first = static_cast<std::uint32_t>(buffer_.positions.size());
    for (int c = 0; c <= columns; ++c)
        for (int r = 0; r <= rows; ++r)
            buffer_.add_vertex(
                corner + along * (static_cast<double>(c) / columns) + up * (static_cast<double>(r) / rows),
                normal);
    const auto at = [&](int c, int r) { return first + static_cast<std::uint32_t>(c * (rows + 1) + r); };
    for (int c = 0; c < columns; ++c)
        for (int r = 0; r < rows; ++r)
            buffer_.add_quad(at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1));
}

void Crowd::add_wall(const Vec& low, const Vec& high) {
    const Vec x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
    add_face({low.x, low.y, high.z}, x, y);
    add_face({high.x, low.y, low.z}, -x, y);
    add_face({high.x, low.y, high.z}, -z, y);
    add_face(low, z, y);
    add_face({low.x, high.y, high.z}, x, -z);
    builder_.add_static(stone_, buffer_.piece());
    buffer_.clear();
}

void Crowd::add_ground() {
    const double side = kHalfStreet + kWall + kCourt + kWall;
    for (int i = -kCourts / 2; i < kCourts / 2; ++i) {
        add_face({i * kCourt, 0.0, side}, {kCourt, 0, 0}, {0, 0, -2.0 * side});
        builder_.add_static(ground_, buffer_.piece());
        buffer_.clear();
    }
}

void Crowd::add_walls() {
    constexpr double kNear = kHalfStreet, kFar = kHalfStreet + kWall + kCourt;
    for (int i = -kCourts / 2; i < kCourts / 2; ++i) {
        const double from = i * kCourt, to = from + kCourt;
        for (const double near : {kNear, kFar, -kNear - kWall, -kFar - kWall})
            add_wall({from, 0, near}, {to, kWallHeight, near + kWall});
    }
    for (int i = -kCourts / 2; i <= kCourts / 2; ++i) {
        const double from = i * kCourt - 0.5 * kWall, to = i * kCourt + 0.5 * kWall;
        add_wall({from, 0, kNear + kWall}, {to, kWallHeight, kFar});
        add_wall({from, 0, -kFar}, {to, kWallHeight, -kNear - kWall});
    }
    // The street's ends: nobody sees out of it.
    for (const double end : {-kHalfLength - kWall, kHalfLength})
        add_wall({end, 0, -kHalfStreet - kWall}, {end + kWall, kWallHeight, kHalfStreet + kWall});
}

void Crowd::add_walker(MeshId mesh, const Vec& low, const Vec& high) {
    const double x = random_.between(low.x, high.x), z = random_.between(low.z, high.z);
    // As far as the walls let it: the round begins anywhere on itself.
    const double reach_x = 0.5 * std::min(x - low.x, high.x - x),
                 reach_z = 0.5 * std::min(z - low.z, high.z - z);
    LoopShape shape;
    shape.radius_x = std::max(0.2, reach_x * random_.between(0.3, 1.0));
    shape.radius_z = std::max(0.2, reach_z * random_.between(0.3, 1.0));
    shape.speed = random_.between(0.6, 1.6);
    shape.keys = 8;
    const double size = random_.between(0.85, 1.1);
    const Frame frame = turned_frame({x, 0.0, z}, random_.unit());
    builder_.add_dynamic(mesh,
                         {glm::dvec4(size * frame.x, 0.0), glm::dvec4(size * frame.y, 0.0),
                          glm::dvec4(size * frame.z, 0.0), glm::dvec4(frame.origin, 1.0)},
                         make_loop(random_, shape, [](double, double) { return 0.0; }));
}

/// A body and a head. Within a tenth of `triangles`, or some more.
void add_figure(ShapeBuffer& buffer, std::int64_t triangles) {
    const int sides = std::max(5, static_cast<int>(std::sqrt(static_cast<double>(triangles) / 3.0)));
    const int rings = std::max(4, static_cast<int>(triangles * 2 / 3 / (2 * sides)) + 1);
    add_sphere(buffer, {{0.0, 0.75, 0.0}}, 0.26, 0.75, sides, rings);
    const int head_rings = std::max(3, static_cast<int>(triangles / 3 / (2 * sides)) + 1);
    add_sphere(buffer, {{0.0, 1.62, 0.0}}, 0.13, 0.16, sides, head_rings);
}

void Crowd::add_walkers(std::int64_t behind_walls, std::int64_t on_street, std::int64_t mesh_triangles) {
    add_figure(buffer_, mesh_triangles);
    std::array<std::optional<MeshId>, kKinds> meshes;
    for (std::size_t k = 0; k < meshes.size(); ++k) meshes[k] = builder_.add_mesh(cloth_[k], buffer_.piece());
    buffer_.clear();
    for (std::int64_t i = 0; i < on_street; ++i)
        add_walker(*meshes[static_cast<std::size_t>(i % kKinds)],
                   {-kHalfLength + kMargin, 0, -kHalfStreet + kMargin},
                   {kHalfLength - kMargin, 0, kHalfStreet - kMargin});
    for (std::int64_t i = 0; i < behind_walls; ++i) {
        const int court = random_.below(2 * kCourts);
        const double from = (court / 2 - kCourts / 2) * kCourt;
        const double near = court % 2 == 0 ? kHalfStreet + kWall : -kHalfStreet - kWall - kCourt;
        add_walker(*meshes[static_cast<std::size_t>(i % kKinds)], {from + kMargin, 0, near + kMargin},
                   {from + kCourt - kMargin, 0, near + kCourt - kMargin});
    }
}

CameraPath walk_through_crowd() {
    CameraPath path;
    path.near_m = 0.1;
    path.far_m = 300.0;
    const double end = kHalfLength - 4.0;
    add_key(path, 0, {-end, 1.7, 1.0}, {1, 0, 0.1});
    add_key(path, 25, {-0.3 * end, 1.7, -1.0}, {1, 0, -0.8});
    add_key(path, 10, {0.0, 1.7, 0.0}, {0.3, 0, 1});
    add_key(path, 25, {0.7 * end, 1.7, 1.0}, {1, 0.05, 0.4});
    add_key(path, 6, {end, 1.7, 0.0}, {-0.2, 0, -1});
    add_key(path, 20, {0.4 * end, 1.7, -2.0}, {-1, 0, 0.05});
    return path;
}

Result<SceneAndPath> build_crowd(ParameterValues values, const std::string& name) {
    SceneBuilder builder;
    Crowd crowd(builder, static_cast<std::uint64_t>(values[3]));
    crowd.add_ground();
    crowd.add_walls();
    crowd.add_walkers(values[0], values[1], values[2]);
    return with_path(builder.finish(name), walk_through_crowd());
}

SceneSize crowd_size(ParameterValues values) {
    constexpr std::uint64_t kStatic = 260'000;
    const std::uint64_t meshes = kKinds * (static_cast<std::uint64_t>(values[2]) * 3 / 2 + 200);
    const auto objects = static_cast<std::uint64_t>(values[0] + values[1]);
    return {kStatic + meshes, kStatic + meshes, sizeof(glm::vec3) + sizeof(PackedNormal), objects * 1024};
}

constexpr std::array<SceneParameter, 4> kParameters{{
    {"objects", 10000, 0, 500000, "walkers in the courts behind the walls, out of sight"},
    {"street", 40, 1, kMostOnStreet, "walkers in the street"},
    {"mesh", 200, 60, 100000, "triangles of a walker, about"},
    {"seed", 1, 0, kLargestSeed, "another crowd"},
}};

}  // namespace

const SceneRecipe& crowd_recipe() {
    static const SceneRecipe recipe{
        {"crowd",
         "a walled street with few walkers, and courts full of them behind its walls: moving things that are "
         "hidden",
         "232,496 triangles in 60 objects, and 10,040 dynamic objects of 192 triangles", kParameters},
        crowd_size,
        build_crowd};
    return recipe;
}

}  // namespace rhview
