// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <limits>

#include "cell_distances.h"
#include "rhview/baselines/grid_planner.h"

namespace rhview {
namespace {

/// Frames of a volume whose object was never hidden before.
constexpr std::uint16_t kFirstPeriod = 8;

}  // namespace

GridPlanner::GridPlanner(std::span<const TriangleBatch> batches, const std::vector<bool>& occludes,
                         std::vector<GridStatic> statics, std::vector<GridObject> objects,
                         const GridOptions& options)
    : statics_(std::move(statics)),
      objects_(std::move(objects)),
      batches_(batches.begin(), batches.end()),
      nothing_leaves_(options.nothing_leaves),
      period_(objects_.size(), kFirstPeriod),
      fuses_balls_(options.fuses_balls) {
    Aabb bounds = options.bounds;
    if (bounds.is_empty()) {
        for (const GridStatic& item : statics_) bounds.grow(item.bounds);
        for (const GridObject& object : objects_) bounds.grow(object.bounds);
    }
    if (bounds.is_empty()) bounds = {glm::vec3(0.0f), glm::vec3(1.0f)};
    grid_ = CellGrid(bounds, options.cells);
    solids_ = find_solid_cells(grid_, batches, occludes);
    build_fixed(batches);
    for (int axis = 0; axis < 3; ++axis)
        for (const int sign : {-1, 1}) faces_.emplace_back(axis, sign, options.face_pixels);

    occluders_ = fixed_occluders_;
    reached_ = CellSet(grid_.cells());
    moving_heads_.assign(grid_.cell_count(), kNone);
    volumes_ = TemporalVolumes(grid_.cells(), objects_.size());
    for (std::uint32_t i = 0; i < objects_.size(); ++i)
        if (objects_[i].max_step > 0.0f) tracked_.push_back(ObjectId{i});
    tracked_.reserve(objects_.size());
    kept_.reserve(objects_.size());
    found_.reserve(2 * objects_.size());
    shown_.assign((statics_.size() + objects_.size() + 63) / 64, 0);
    const glm::ivec3 n = grid_.cells();
    const int longest = std::max({n.x, n.y, n.z});
    longest_axis_ = static_cast<std::size_t>(longest);
    waiting_heads_.assign(faces_.size() * longest_axis_, kNone);
    row_.resize(static_cast<std::size_t>(longest + 63) / 64);
    slab_.resize(row_.size() * static_cast<std::size_t>(longest));
}

void GridPlanner::append_static_cells(std::vector<CellEntry>& entries) const {
    std::vector<std::uint32_t> item_of(solids_.surface_of.size());
    for (std::uint32_t i = 0; i < statics_.size(); ++i) {
        const DrawRange& range = statics_[i].range;
        for (std::uint32_t t = range.first_index / 3; t < (range.first_index + range.index_count) / 3; ++t)
            item_of[t] = i;
    }
    for (std::uint32_t cell = 0; cell < grid_.cell_count(); ++cell) {
        std::uint32_t last = kNone;
        for (const std::uint32_t triangle : solids_.triangles.of(cell)) {
            if (item_of[triangle] != last) entries.push_back({cell, item_of[triangle]});
            last = item_of[triangle];
        }
    }
}

void GridPlanner::build_fixed(std::span<const TriangleBatch> batches) {
    lowest_y_ = std::numeric_limits<float>::infinity();
    std::uint32_t triangles = 0;
    for (const TriangleBatch& batch : batches) {
        batch_first_triangle_.push_back(triangles);
        triangles += static_cast<std::uint32_t>(batch.indices.size() / 3);
    }
    for (const GridStatic& item : statics_) lowest_y_ = std::min(lowest_y_, item.bounds.min.y);

    std::vector<CellEntry> entries;
    append_static_cells(entries);
    owned_ = solids_.opaque;
    for (std::uint32_t i = 0; i < objects_.size(); ++i) {
        const GridObject& object = objects_[i];
        if (object.max_step > 0.0f) continue;
        const glm::dvec3 centre(object.bounds.centre()), inner = centre + glm::dvec3(object.inner_offset);
        for_each_cell(grid_.clipped(grid_.touched(object.bounds)), [&](const glm::ivec3& cell) {
            const auto c = static_cast<std::uint32_t>(grid_.index(cell));
            if (distances_to_cell(centre, grid_, cell).nearest <= object.outer_radius)
                entries.push_back({c, static_cast<std::uint32_t>(statics_.size()) + i});
            if (distances_to_cell(inner, grid_, cell).farthest < object.inner_radius)
                owned_.push_back({c, solids_.surface_count + i});
        });
    }
    fixed_ = make_cell_lists(grid_.cell_count(), entries);
    fixed_occluders_ = CellSet(grid_.cells());
    for (const OpaqueCell& o : owned_) fixed_occluders_.insert(grid_.cell_at(o.cell));
    std::sort(owned_.begin(), owned_.end(), [](const OpaqueCell& a, const OpaqueCell& b) {
        return std::pair(a.surface, a.cell) < std::pair(b.surface, b.cell);
    });
    const std::size_t owners = solids_.surface_count + objects_.size();
    owner_first_.assign(owners + 1, 0);
    for (const OpaqueCell& o : owned_) ++owner_first_[o.surface + 1];
    for (std::size_t o = 0; o < owners; ++o) owner_first_[o + 1] += owner_first_[o];
}

}  // namespace rhview
