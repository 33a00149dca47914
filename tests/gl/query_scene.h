// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "rhview/pipeline/frame_plan.h"
#include "rhview/scenes/scene_builder.h"
#include "uniform.h"

namespace rhview::gl {

/// Triangles that fill a box to its faces, to the last bit.
struct Cell {
    DrawRange range;
    Aabb bounds;
};

struct CellScene {
    Scene scene;
    std::vector<Cell> cells;
};

/// Seeded cells of all sizes, half of them on a coarse grid, so that faces coincide with one another's: whole
/// boxes, triangles and slivers from face to face, flat ones, points.
class CellMaker {
  public:
    explicit CellMaker(unsigned seed) : uniform_(seed) {}

    CellScene make(int count, double extent, const glm::dvec3& origin = glm::dvec3(0.0)) {
        SceneBuilder builder(origin);
        const glm::dmat4 to_world{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, glm::dvec4(origin, 1.0)};
        const MaterialId materials[2] = {builder.add_material({"one", glm::vec3(0.8f), true, false}),
                                         builder.add_material({"two", glm::vec3(0.4f), true, false})};
        for (int i = 0; i < count; ++i) {
            make_piece(extent, i);
            builder.add_static(materials[i % 2], {positions_, {}, {}, indices_}, to_world);
        }
        CellScene result{builder.finish("cells").value(), {}};
        std::uint32_t first = 0;
        for (std::uint32_t b = 0; b < result.scene.batches.size(); ++b) {
            const SceneBatch& batch = result.scene.batches[b];
            for (const SceneObject& object : batch.objects)
                result.cells.push_back(
                    {{BatchId{b}, first + object.first_index, object.index_count}, object.bounds});
            first += static_cast<std::uint32_t>(batch.indices.size());
        }
        return result;
    }

  private:
    float coordinate(double extent, bool on_grid) {
        const double value = uniform_(-extent, extent);
        return static_cast<float>(on_grid ? std::round(value) : value);
    }

    void make_piece(double extent, int number) {
        const bool on_grid = number % 2 == 0;
        glm::vec3 low, high;
        const double size = std::exp(uniform_(std::log(0.02), std::log(6.0)));
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = coordinate(extent, on_grid);
            const double length = size * uniform_(0.3, 1.0);
            high[axis] = low[axis] + static_cast<float>(on_grid ? std::ceil(length) : length);
        }
        if (number % 7 == 3) high[number % 3] = low[number % 3];
        if (number % 29 == 5) high = low;
        positions_.clear();
        indices_.clear();
        number % 3 == 0 ? add_box(low, high) : add_triangles(low, high, number % 3 == 1);
    }

    void add_box(const glm::vec3& low, const glm::vec3& high) {
        for (int c = 0; c < 8; ++c)
            positions_.emplace_back(c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z);
        constexpr std::array<std::uint32_t, 36> kIndices{0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5,
                                                         0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6,
                                                         0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
        indices_.assign(kIndices.begin(), kIndices.end());
    }

    void add_triangles(const glm::vec3& low, const glm::vec3& high, bool slivers) {
        const auto on_a_face = [&] {
            glm::vec3 p;
            for (int axis = 0; axis < 3; ++axis)
                p[axis] = low[axis] + static_cast<float>(uniform_(0, 1)) * (high[axis] - low[axis]);
            p = glm::clamp(p, low, high);
            const int axis = static_cast<int>(uniform_(0, 2.999));
            p[axis] = uniform_(0, 1) < 0.5 ? low[axis] : high[axis];
            return p;
        };
        for (int t = 0; t < 8; ++t) {
            const glm::vec3 a = on_a_face(), b = on_a_face();
            const float share = static_cast<float>(std::exp(uniform_(-9, -2)));
            glm::vec3 c = on_a_face();
            if (slivers) c = glm::clamp(a + 0.5f * (b - a) + share * (c - a), low, high);
            for (const glm::vec3& p : {a, b, c}) {
                indices_.push_back(static_cast<std::uint32_t>(positions_.size()));
                positions_.push_back(p);
            }
        }
    }

    Uniform uniform_;
    std::vector<glm::vec3> positions_;
    std::vector<std::uint32_t> indices_;
};

/// Draws the first `at_once` of every `stride` cells at once, the others behind a query each, or several
/// behind one.
struct QueryPlanner {
    bool hardware = true, box_pass = true;
    std::size_t stride = 3, at_once = 1;
    std::size_t most_boxes = 3;
    std::size_t walls = 0;  ///< cells from the first that are drawn at once
    bool counts_samples = false;
    std::uint64_t next_ticket = 1000;

    FramePlan plan(const std::vector<Cell>& cells) {
        FramePlan plan;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (i % stride < at_once || i < walls) {
                plan.opaque.push_back(cells[i].range);
                continue;
            }
            const bool new_query =
                plan.queries.empty() || plan.queries.back().box_count >= 1 + i % most_boxes;
            if (new_query) {
                PlannedQuery query{next_ticket++, static_cast<std::uint32_t>(plan.query_boxes.size()), 0,
                                   QueryWay::HardwareQuery, counts_samples};
                if (box_pass && (!hardware || plan.queries.size() % 2 == 1))
                    query = {query.ticket, query.first_box, 0, QueryWay::BoxPass, false};
                plan.queries.push_back(query);
            }
            ++plan.queries.back().box_count;
            plan.query_boxes.push_back(cells[i].bounds);
            plan.conditional.push_back({cells[i].range, static_cast<std::uint32_t>(plan.queries.size() - 1)});
        }
        return plan;
    }
};

/// `count` pieces around `origin`, each of two triangles that share part of an edge with their box,
/// which is `size` wide (a random share of it) and flat across one axis, if `flat_axis` >= 0; at `place`. The
/// first `walls` are 100 times as wide.
template <class Place>
CellScene scatter_pieces(unsigned seed, int count, double size, int flat_axis, int walls, Place place) {
    Uniform uniform(seed);
    SceneBuilder builder;
    const MaterialId material = builder.add_material({"", glm::vec3(0.8f), true, false});
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < count; ++i) {
        glm::dvec3 low = place(uniform);
        glm::dvec3 extent(size * uniform(0.1, 1.0), size * uniform(0.1, 1.0), size * uniform(0.1, 1.0));
        if (flat_axis >= 0) extent[flat_axis] = 0.0;
        if (i < walls) {
            extent *= 100.0;
            low -= 0.5 * extent;
        }
        positions.clear();
        indices.clear();
        const glm::dvec3 edge = glm::round(uniform.point(0.5) + 0.5);
        for (std::uint32_t t = 0; t < 6; ++t) {
            glm::dvec3 share = uniform.point(0.5) + 0.5;
            for (int axis = 0; axis < 3; ++axis)
                if (t % 3 < 2 && axis != i % 3) share[axis] = edge[axis];
            if (t % 3 == 2) share[i % 3] = edge[i % 3];
            positions.emplace_back(low + share * extent);
            indices.push_back(t);
        }
        builder.add_static(material, {positions, {}, {}, indices});
    }
    CellScene result{builder.finish("pieces").value(), {}};
    const SceneBatch& batch = result.scene.batches[0];
    for (const SceneObject& object : batch.objects)
        result.cells.push_back({{BatchId{0}, object.first_index, object.index_count}, object.bounds});
    return result;
}

inline FramePlan everything(const std::vector<Cell>& cells) {
    FramePlan plan;
    for (const Cell& cell : cells) plan.opaque.push_back(cell.range);
    return plan;
}

}  // namespace rhview::gl
