// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "world.h"

#include <array>
#include <cmath>

namespace engine {
namespace {

constexpr int kHouses = 24;  ///< along each side
constexpr float kPitch = 24.0f;
constexpr float kWidth = 14.0f;

void add_box(LitMesh& mesh, const glm::vec3& low, const glm::vec3& high) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            glm::vec3 normal(0.0f);
            normal[axis] = side == 0 ? -1.0f : 1.0f;
            for (int corner = 0; corner < 4; ++corner) {
                glm::vec3 position;
                position[axis] = side == 0 ? low[axis] : high[axis];
                position[u] = corner == 1 || corner == 2 ? high[u] : low[u];
                position[v] = corner >= 2 ? high[v] : low[v];
                mesh.vertices.push_back({position, normal});
            }
            // Counter-clockwise seen from outside.
            for (const std::uint32_t k :
                 side == 1 ? std::array{0u, 1u, 2u, 0u, 2u, 3u} : std::array{0u, 2u, 1u, 0u, 3u, 2u})
                mesh.indices.push_back(first + k);
        }
    }
}

void add_ball(PaintedMesh& mesh, const glm::vec3& centre, float radius, const glm::vec3& colour) {
    constexpr int kRings = 10, kSegments = 16;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int ring = 0; ring <= kRings; ++ring) {
        const float polar = 3.14159265f * static_cast<float>(ring) / kRings;
        for (int segment = 0; segment < kSegments; ++segment) {
            const float turn = 6.2831853f * static_cast<float>(segment) / kSegments;
            const glm::vec3 out(std::sin(polar) * std::cos(turn), std::cos(polar),
                                std::sin(polar) * std::sin(turn));
            mesh.vertices.push_back({centre + radius * out, colour * (0.6f + 0.4f * out.y)});
        }
    }
    const auto at = [&](int ring, int segment) {
        return first + static_cast<std::uint32_t>(ring * kSegments + segment % kSegments);
    };
    for (int ring = 0; ring < kRings; ++ring)
        for (int segment = 0; segment < kSegments; ++segment)
            for (const std::uint32_t k :
                 {at(ring, segment), at(ring, segment + 1), at(ring + 1, segment + 1), at(ring, segment),
                  at(ring + 1, segment + 1), at(ring + 1, segment)})
                mesh.indices.push_back(k);
}

}  // namespace

World make_world() {
    World world;
    world.ground.material_colour = {0.35f, 0.45f, 0.3f};
    world.walls.material_colour = {0.7f, 0.62f, 0.55f};
    const float half = 0.5f * kPitch * kHouses;
    add_box(world.ground, {-half, -1.0f, -half}, {half, 0.0f, half});
    for (int i = 0; i < kHouses * kHouses; ++i) {
        const float x = kPitch * (static_cast<float>(i % kHouses) + 0.5f) - half;
        const float z = kPitch * (static_cast<float>(i / kHouses) + 0.5f) - half;
        const float height = 6.0f + static_cast<float>(i * 37 % 17);
        const float side = 0.5f * kWidth;
        add_box(world.walls, {x - side, 0.0f, z - side}, {x + side, height, z + side});
        for (int k = 0; k < 8; ++k) {
            const auto floor = static_cast<float>(k / 4);
            add_ball(world.furniture,
                     {x + (k % 2 == 0 ? -3.0f : 3.0f), 1.5f + 3.0f * floor, z + (k % 4 < 2 ? -3.0f : 3.0f)},
                     1.2f, {0.9f, 0.3f + 0.08f * static_cast<float>(k), 0.2f});
        }
        // A lamp in the street.
        add_ball(world.furniture, {x + 0.5f * kPitch, 3.0f, z}, 0.4f, {0.9f, 0.9f, 0.7f});
    }
    return world;
}

}  // namespace engine
