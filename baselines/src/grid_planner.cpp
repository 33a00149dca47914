// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/grid_planner.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "cell_distances.h"
#include "rhview/base/assert.h"

namespace rhview {
namespace {

Aabb grown(const Aabb& box, double by) {
    const auto f = static_cast<float>(by);
    return {box.min - f, box.max + f};
}

std::array<glm::dvec3, 3> in_cells(const std::array<glm::dvec3, 3>& t, const CellGrid& grid) {
    return {grid.to_cells(t[0]), grid.to_cells(t[1]), grid.to_cells(t[2])};
}

/// Those of word `word` among bits [first, end).
std::uint64_t bits_between(int first, int end, std::size_t word) {
    const int low = std::max(first - static_cast<int>(64 * word), 0);
    const int high = std::min(end - static_cast<int>(64 * word), 64);
    return low < high ? (~std::uint64_t{0} >> (64 - (high - low))) << low : 0;
}

/// The eye is where all rays of the view meet.
bool is_perspective(const glm::dmat4& clip_from_relative) {
    const glm::dvec4& origin = clip_from_relative[3];
    return origin.x == 0.0 && origin.y == 0.0 && origin.w == 0.0;
}

/// How far the corners of the near plane are.
double near_corner_distance(const glm::dmat4& clip_from_relative, ClipDepth depth) {
    const double z = depth == ClipDepth::NegativeOneToOne ? -1.0 : depth == ClipDepth::ZeroToOne ? 0.0 : 1.0;
    const glm::dmat4 inverse = glm::inverse(clip_from_relative);
    double farthest = 0.0;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) {
            const glm::dvec4 corner = inverse * glm::dvec4(x, y, z, 1.0);
            farthest = std::max(farthest, glm::length(glm::dvec3(corner) / corner.w));
        }
    return farthest;
}

}  // namespace

GridPlanner::Eye GridPlanner::eye_of(const FrameInput& input) const {
    Eye eye;
    eye.scene = input.culling_view.eye() - input.scene_origin;
    eye.position = grid_.to_cells(eye.scene);
    eye.cell = glm::ivec3(glm::floor(glm::clamp(eye.position, glm::dvec3(-1e8), glm::dvec3(1e8))));
    const glm::dmat4 clip = input.culling_view.clip_from_eye_relative();
    eye.near_reach = near_corner_distance(clip, input.culling_view.clip_depth) * 1.001;
    const auto row = [&](int r) { return glm::dvec3(clip[0][r], clip[1][r], clip[2][r]); };
    const std::array<glm::dvec3, 4> planes{row(3) + row(0), row(3) - row(0), row(3) + row(1),
                                           row(3) - row(1)};
    for (std::size_t p = 0; p < 4; ++p) eye.planes[p] = glm::normalize(planes[p] * grid_.cell_size());
    return eye;
}

void GridPlanner::restore_occluders() {
    for (const glm::ivec3& cell : changed_) {
        if (fixed_occluders_.contains(cell))
            occluders_.insert(cell);
        else
            occluders_.erase(cell);
    }
    changed_.clear();
}

void GridPlanner::drop_owner(std::uint32_t owner) {
    for (std::uint32_t i = owner_first_[owner]; i < owner_first_[owner + 1]; ++i) {
        changed_.push_back(grid_.cell_at(owned_[i].cell));
        occluders_.erase(changed_.back());
    }
}

// What the near plane may cut away hides nothing: a surface with a triangle that near, an object whose box
// is.
void GridPlanner::drop_near_surfaces() {
    const Aabb near = grown({glm::vec3(eye_.scene), glm::vec3(eye_.scene)}, eye_.near_reach);
    for_each_cell(grid_.clipped(grid_.touched(near)), [&](const glm::ivec3& cell) {
        const std::size_t c = grid_.index(cell);
        for (const std::uint32_t t : solids_.triangles.of(c)) {
            const std::uint32_t surface = solids_.surface_of[t];
            if (surface == SolidCells::kOpen || owner_first_[surface] == owner_first_[surface + 1]) continue;
            if (triangle_distance(eye_.scene, corners_of(t)) <= eye_.near_reach) drop_owner(surface);
        }
        for (const std::uint32_t item : fixed_.of(c)) {
            if (item < statics_.size()) continue;
            const auto object = item - static_cast<std::uint32_t>(statics_.size());
            if (touch(grown(objects_[object].bounds, eye_.near_reach), eye_.scene))
                drop_owner(solids_.surface_count + object);
        }
    });
}

// From inside of a surface its triangles are seen from behind and hide nothing. It is left out of a surface
// that winds around the eye: crossings of the line along x, counted from the eye on.
void GridPlanner::drop_surfaces_around() {
    windings_.clear();
    const glm::ivec3 n = grid_.cells();
    if (eye_.cell.y < 0 || eye_.cell.y >= n.y || eye_.cell.z < 0 || eye_.cell.z >= n.z) return;
    for (int x = std::max(eye_.cell.x, 0); x < n.x; ++x)
        for (const std::uint32_t t : solids_.triangles.of(grid_.index({x, eye_.cell.y, eye_.cell.z}))) {
            const std::uint32_t surface = solids_.surface_of[t];
            if (surface == SolidCells::kOpen || owner_first_[surface] == owner_first_[surface + 1]) continue;
            const int crossing = ray_crossing(in_cells(corners_of(t), grid_), eye_.position, x, n.x);
            if (crossing == 0) continue;
            const auto at = std::find_if(windings_.begin(), windings_.end(),
                                         [&](const auto& w) { return w.first == surface; });
            if (at == windings_.end())
                windings_.emplace_back(surface, crossing);
            else
                at->second += crossing;
        }
    for (const auto& [surface, winding] : windings_)
        if (winding != 0) drop_owner(surface);
}

std::array<glm::dvec3, 3> GridPlanner::corners_of(std::uint32_t triangle) const {
    const auto after = std::upper_bound(batch_first_triangle_.begin(), batch_first_triangle_.end(), triangle);
    const auto b = static_cast<std::size_t>(after - batch_first_triangle_.begin()) - 1;
    const std::size_t first = 3 * std::size_t{triangle - batch_first_triangle_[b]};
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::dvec3(batches_[b].positions[batches_[b].indices[first + k]]);
    return corners;
}

void GridPlanner::add_occluder(const GridObject& object, const Aabb& box) {
    if (object.inner_radius <= 0.0f || touch(grown(box, eye_.near_reach), eye_.scene)) return;
    const glm::dvec3 centre = glm::dvec3(box.centre()) + glm::dvec3(object.inner_offset);
    const glm::vec3 radius(object.inner_radius);
    for_each_cell(grid_.clipped(grid_.touched({glm::vec3(centre) - radius, glm::vec3(centre) + radius})),
                  [&](const glm::ivec3& cell) {
                      if (distances_to_cell(centre, grid_, cell).farthest >= object.inner_radius) return;
                      occluders_.insert(cell);
                      changed_.push_back(cell);
                      ++statistics_.opaque_cells;
                  });
}

// Found while the traversal runs, an object may lie in cells that it has passed.
void GridPlanner::discretise(ObjectId object) {
    const auto id = static_cast<std::uint32_t>(object);
    const GridObject& properties = objects_[id];
    const Aabb& box = boxes_[id];
    const CellBox cells = grid_.touched(box);
    const auto item = static_cast<std::uint32_t>(statics_.size()) + id;
    if (!grid_.holds(cells)) return show(item);
    add_occluder(properties, box);
    const glm::dvec3 centre(box.centre());
    for_each_cell(cells, [&](const glm::ivec3& cell) {
        if (distances_to_cell(centre, grid_, cell).nearest > properties.outer_radius) return;
        const auto c = static_cast<std::uint32_t>(grid_.index(cell));
        if (moving_heads_[c] == kNone) moving_cells_.push_back(c);
        moving_nodes_.push_back({id, moving_heads_[c]});
        moving_heads_[c] = static_cast<std::uint32_t>(moving_nodes_.size() - 1);
        if (reached_.contains(cell)) show(item);
    });
}

void GridPlanner::reveal(ObjectId object) {
    if (!volumes_.has(object)) return;
    volumes_.remove(object);
    ++statistics_.volumes_revealed;
    std::uint16_t& period = period_[index_of(object)];
    period = std::max<std::uint16_t>(1, period / 2);
    tracked_.push_back(object);
    discretise(object);
}

// The longest that fits: all of it in the grid, the eye outside. An object that has none is looked at again
// in the next frame.
void GridPlanner::give_volume(ObjectId object, const Aabb& box) {
    const float step = objects_[index_of(object)].max_step;
    const std::uint32_t longest = std::isfinite(step) ? period_[index_of(object)] : 0;
    // Ends are spread, lest all volumes of one frame end in one frame.
    const std::uint32_t spread = (static_cast<std::uint32_t>(object) * 0x9e3779b9u) >> 16;
    for (std::uint32_t period = longest - spread % (longest / 2 + 1); period > 0; period /= 2) {
        CellBox cells = grid_.touched(grown(box, static_cast<double>(step) * period));
        if (nothing_leaves_) cells = grid_.clipped(cells);
        if (!grid_.holds(cells) || cells.is_empty() || cells.contains(eye_.cell)) continue;
        volumes_.insert(object, cells, period);
        return;
    }
    kept_.push_back(object);
}

void GridPlanner::renew_expired() {
    found_.clear();
    volumes_.next_frame(found_);
    statistics_.volumes_renewed = found_.size();
    for (const ObjectId object : found_) {
        volumes_.remove(object);
        std::uint16_t& period = period_[index_of(object)];
        period =
            static_cast<std::uint16_t>(std::min<std::uint32_t>(2u * period, TemporalVolumes::kLongestPeriod));
        give_volume(object, boxes_[index_of(object)]);
    }
    tracked_.insert(tracked_.end(), kept_.begin(), kept_.end());
    kept_.clear();
}

void GridPlanner::begin_frame() {
    restore_occluders();
    for (const std::uint32_t cell : moving_cells_) moving_heads_[cell] = kNone;
    moving_cells_.clear();
    moving_nodes_.clear();
    for (const glm::ivec3& cell : reached_cells_) reached_.erase(cell);
    reached_cells_.clear();
    std::fill(shown_.begin(), shown_.end(), 0);
    statistics_ = {};
    renew_expired();
    if (solids_.opened_below && eye_.scene.y <= static_cast<double>(lowest_y_) + eye_.near_reach)
        for (std::uint32_t surface = 0; surface < solids_.surface_count; ++surface) drop_owner(surface);
    drop_near_surfaces();
    drop_surfaces_around();
    for (const ObjectId object : tracked_) discretise(object);
    found_.clear();
    volumes_.find_around(eye_.cell, found_);
    for (const ObjectId object : found_) reveal(object);
}

void GridPlanner::show(std::uint32_t item) {
    const std::uint64_t bit = std::uint64_t{1} << (item % 64);
    if ((shown_[item / 64] & bit) != 0) return;
    shown_[item / 64] |= bit;
    if (fuses_balls_ && item >= statics_.size())
        await_ball(item - static_cast<std::uint32_t>(statics_.size()));
}

// A ball ends rays in each face that has it before the eye's slab, from the first shell that is past it. What
// the near plane may cut does not; nor does what is found when the traversal is past it.
void GridPlanner::await_ball(std::uint32_t object) {
    const GridObject& properties = objects_[object];
    const Aabb& box = boxes_[object];
    if (properties.inner_radius <= 0.0f || touch(grown(box, eye_.near_reach), eye_.scene)) return;
    const glm::dvec3 centre = glm::dvec3(box.centre()) + glm::dvec3(properties.inner_offset) - eye_.scene;
    const double radius = properties.inner_radius;
    for (std::size_t face = 0; face < faces_.size(); ++face) {
        if (!faces_[face].is_open()) continue;
        const int axis = faces_[face].axis();
        const int sign = faces_[face].sign(), last = grid_.cells()[axis] - 1;
        const double size = grid_.cell_size()[axis], beyond = (centre[axis] * sign + radius) / size;
        if (centre[axis] * sign <= radius) continue;
        // From the eye back to the border of its cell.
        const double into =
            sign > 0 ? eye_.position[axis] - eye_.cell[axis] : eye_.cell[axis] + 1 - eye_.position[axis];
        const int shell = std::max(static_cast<int>(std::ceil(beyond + into + 1e-6)), shell_ + 1);
        const int slab = eye_.cell[axis] + sign * shell;
        if (sign > 0 ? slab > last : slab < 0) continue;
        const std::size_t list = face * longest_axis_ + static_cast<std::size_t>(std::clamp(slab, 0, last));
        waiting_.push_back({centre, radius, waiting_heads_[list]});
        waiting_heads_[list] = static_cast<std::uint32_t>(waiting_.size() - 1);
    }
}

void GridPlanner::press_balls(std::size_t face, int slab) {
    std::uint32_t& head = waiting_heads_[face * longest_axis_ + static_cast<std::size_t>(slab)];
    for (std::uint32_t n = head; n != kNone && faces_[face].is_open(); n = waiting_[n].next)
        faces_[face].occlude_ball(waiting_[n].centre, waiting_[n].radius, grid_.cell_size());
    head = kNone;
}

void GridPlanner::visit_cell(const glm::ivec3& cell) {
    ++statistics_.cells_reached;
    reached_.insert(cell);
    reached_cells_.push_back(cell);
    const std::size_t c = grid_.index(cell);
    found_.clear();
    volumes_.find_at(cell, found_);
    for (const ObjectId object : found_) reveal(object);
    for (const std::uint32_t item : fixed_.of(c)) show(item);
    for (std::uint32_t n = moving_heads_[c]; n != kNone; n = moving_nodes_[n].next)
        show(static_cast<std::uint32_t>(statics_.size()) + moving_nodes_[n].object);
}

// A cell on an edge of the shell belongs to the face of the first axis.
void GridPlanner::visit_face(std::size_t face, int shell) {
    ShellFace& volume = faces_[face];
    const int axis = volume.axis(), slab = eye_.cell[axis] + volume.sign() * shell;
    const glm::ivec3 n = grid_.cells();
    if (slab < 0 || slab >= n[axis] || (shell > ShellFace::kCutShells && !volume.is_open())) return;
    press_balls(face, slab);
    const SlabAxes a = volume.axes();
    const int u_reach = a.u < axis ? shell - 1 : shell, v_reach = a.v < axis ? shell - 1 : shell;
    const int u_first = std::max(0, eye_.cell[a.u] - u_reach),
              u_last = std::min(n[a.u] - 1, eye_.cell[a.u] + u_reach);
    const int v_first = std::max(0, eye_.cell[a.v] - v_reach),
              v_last = std::min(n[a.v] - 1, eye_.cell[a.v] + v_reach);
    if (u_first > u_last || v_first > v_last) return block_rays(volume, slab, 0, -1);
    const ShellFace::Reach reach = volume.reach_at(slab, shell);
    const std::size_t words = (static_cast<std::size_t>(n[a.u]) + 63) / 64;
    const std::span<std::uint64_t> reached(row_.data(), words);
    if (reach.misses(u_first, u_last, v_first, v_last) && shell > ShellFace::kCutShells) return;
    for (int v = v_first; v <= v_last; ++v) {
        std::fill(reached.begin(), reached.end(), 0);
        if (v >= reach.v_first && v <= reach.v_last) volume.find_reached(slab, v, u_first, u_last, reached);
        std::uint64_t* hidden = &slab_[static_cast<std::size_t>(v) * words];
        for (std::size_t w = 0; w < words; ++w) {
            hidden[w] = bits_between(u_first, u_last + 1, w) & ~reached[w];
            for (std::uint64_t rest = reached[w]; rest != 0; rest &= rest - 1) {
                glm::ivec3 cell(slab);
                cell[a.u] = static_cast<int>(64 * w) + std::countr_zero(rest);
                cell[a.v] = v;
                visit_cell(cell);
            }
        }
    }
    block_rays(volume, slab, v_first, v_last);
}

/// `slab_` has what is hidden of rows `v_first` to `v_last`; what is opaque blocks too, in all of the slab.
void GridPlanner::block_rays(ShellFace& volume, int slab, int v_first, int v_last) {
    const int u_cells = grid_.cells()[volume.axes().u], v_cells = grid_.cells()[volume.axes().v];
    const std::size_t words = (static_cast<std::size_t>(u_cells) + 63) / 64;
    std::uint64_t any = 0;
    for (int v = 0; v < v_cells; ++v) {
        const std::span<const std::uint64_t> opaque = occluders_.row(volume.axis(), slab, v);
        std::uint64_t* blocked = &slab_[static_cast<std::size_t>(v) * words];
        for (std::size_t w = 0; w < words; ++w) {
            any |= opaque[w];
            blocked[w] = (v >= v_first && v <= v_last ? blocked[w] : 0) | opaque[w];
        }
    }
    if (any != 0)
        volume.occlude(slab, {slab_.data(), words * static_cast<std::size_t>(v_cells)}, words, u_cells,
                       v_cells);
}

void GridPlanner::traverse() {
    for (ShellFace& face : faces_) face.begin(eye_.position, eye_.planes);
    const glm::ivec3 last_cell = grid_.cells() - 1,
                     last_side = glm::max(glm::abs(eye_.cell), glm::abs(last_cell - eye_.cell)),
                     first_side = glm::max(glm::max(-eye_.cell, eye_.cell - last_cell), glm::ivec3(0));
    last_shell_ = std::max({last_side.x, last_side.y, last_side.z});
    const int first_shell = std::max({first_side.x, first_side.y, first_side.z, 1});
    if (grid_.holds({eye_.cell, eye_.cell})) visit_cell(eye_.cell);
    for (int shell = first_shell; shell <= last_shell_; ++shell) {
        shell_ = shell;
        bool open = shell <= ShellFace::kCutShells;
        for (std::size_t face = 0; face < faces_.size(); ++face) {
            visit_face(face, shell);
            open = open || faces_[face].is_open();
        }
        if (!open) break;
    }
    shell_ = 0;
    waiting_.clear();
    std::fill(waiting_heads_.begin(), waiting_heads_.end(), kNone);
}

// What was seen stays tracked; the rest is hidden from now on.
void GridPlanner::give_volumes() {
    for (const ObjectId object : tracked_) {
        const std::size_t item = statics_.size() + index_of(object);
        if ((shown_[item / 64] >> (item % 64) & 1) != 0)
            kept_.push_back(object);
        else
            give_volume(object, boxes_[index_of(object)]);
    }
    tracked_.swap(kept_);
    kept_.clear();
    statistics_.volumes = volumes_.size();
}

void GridPlanner::emit(const Frustum& frustum, FramePlan& plan) {
    for (std::size_t word = 0; word < shown_.size(); ++word)
        for (std::uint64_t rest = shown_[word]; rest != 0; rest &= rest - 1) {
            const std::size_t item = 64 * word + static_cast<std::size_t>(std::countr_zero(rest));
            const bool is_static = item < statics_.size();
            const std::size_t object = item - statics_.size();
            PlaneMask mask = frustum.mask;
            const Aabb& box = is_static ? statics_[item].bounds : boxes_[object];
            if (classify(frustum, box, mask) == Containment::Outside) continue;
            if (is_static)
                plan.opaque.push_back(statics_[item].range);
            else
                plan.objects.push_back(ObjectId{static_cast<std::uint32_t>(object)});
            plan.chosen.push_back(static_cast<std::uint32_t>(item));
        }
}

void GridPlanner::plan(const FrameInput& input, FramePlan& plan) {
    RHVIEW_ASSERT(input.object_boxes.size() == objects_.size());
    plan.clear();
    const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
    eye_ = eye_of(input);
    boxes_ = input.object_boxes;
    begin_frame();
    if (is_perspective(input.culling_view.clip_from_eye_relative())) {
        traverse();
        give_volumes();
    } else {
        std::fill(shown_.begin(), shown_.end(), ~std::uint64_t{0});
        if (!shown_.empty()) shown_.back() >>= (64 - (statics_.size() + objects_.size()) % 64) % 64;
    }
    emit(frustum, plan);
    sorter_.sort(input.object_groups, plan);
    plan.nodes_visited = statistics_.cells_reached;
}

Aabb GridPlanner::bounds_of(std::uint32_t chosen) const {
    return chosen < statics_.size() ? statics_[chosen].bounds : objects_[chosen - statics_.size()].bounds;
}

}  // namespace rhview
