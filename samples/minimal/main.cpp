// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// An engine's own triangles, culled for one camera. The engine's renderer is replaced by two functions that
// print.

#include <cstdint>
#include <cstdio>
#include <glm/vec3.hpp>
#include <vector>

#include "rhview/pipeline/rhview_planner.h"

namespace {

std::uint32_t drawn_indices = 0;
int draw_calls = 0;

void upload_index_buffer(std::span<const std::uint32_t> indices) {
    std::printf("uploaded %zu indices\n", indices.size());
}

void draw_indexed(std::uint32_t first, std::uint32_t count) {
    std::printf("draw %u indices from %u\n", count, first);
    drawn_indices += count;
    ++draw_calls;
}

/// 10,000 triangular houses on a square of a kilometre.
void build_houses(std::vector<glm::vec3>& positions, std::vector<std::uint32_t>& indices) {
    for (int i = 0; i < 10'000; ++i) {
        const glm::vec3 place(10.0f * static_cast<float>(i % 100) - 495.0f, 0,
                              10.0f * static_cast<float>(i / 100) - 495.0f);
        for (const glm::vec3 corner : {glm::vec3(-4, 0, 0), glm::vec3(4, 0, 0), glm::vec3(0, 9, 0)}) {
            indices.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.push_back(place + corner);
        }
    }
}

}  // namespace

int main() {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    build_houses(positions, indices);

    // [snippet]
    // Once: what drawing costs, and your triangles, one batch per material. Vertices stay; indices come back
    // in a new order.
    const rhview::DrawCosts costs{.index_ns = 0.25, .draw_ns = 2000};
    const rhview::TriangleBatch batch{rhview::MaterialId{0}, positions, indices};
    const auto octree =
        rhview::build_octree({&batch, 1}, rhview::choose_octree_options(costs, indices.size(), 1));
    if (!octree) return std::puts(octree.error().message.c_str()), 1;
    upload_index_buffer(octree->indices());

    // Per view and frame: the camera goes in, draw calls come out.
    rhview::RhviewPlanner planner(*octree, costs);
    rhview::FramePlan plan;
    rhview::View view;
    view.camera_from_world = rhview::look_along({0, 2, 0}, {0, 0, -1}, {0, 1, 0});
    view.clip_from_camera = rhview::perspective(1.6, 16.0 / 9.0, 0.1, 500.0, view.clip_depth);
    planner.plan({.culling_view = view}, plan);
    for (const rhview::DrawRange& range : plan.opaque) draw_indexed(range.first_index, range.index_count);
    // [/snippet]

    std::printf("drew %u of %zu houses with %d draw call%s\n", drawn_indices / 3, indices.size() / 3,
                draw_calls, draw_calls == 1 ? "" : "s");
    return 0;
}
