// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "run_property.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "draw_list_price.h"
#include "fake_gpu.h"
#include "property_scene.h"
#include "rhview/pipeline/rhview_planner.h"

namespace rhview {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

DrawCosts costs_of(const PropertyCase& property) {
    return {1.0, property.draw_ns, property.call_ns};
}

RhOctree octree_of(const PropertyCase& property, const PropertyScene& scene, int threads) {
    OctreeOptions options;
    options.max_leaf_triangles = property.leaf;
    options.min_record_indices = property.record;
    options.replica_budget = property.replicas;
    options.costs = costs_of(property);
    const tbb::global_control more_than_cores(tbb::global_control::max_allowed_parallelism, 2);
    tbb::task_arena arena(threads);
    return arena.execute([&] { return build_octree(scene.batches(), options).value(); });
}

std::optional<OcclusionOptions> occlusion_of(const PropertyCase& property) {
    if (static_cast<PropertyMode>(property.mode) == PropertyMode::NoQueries) return std::nullopt;
    OcclusionOptions options;
    options.settings.mode = static_cast<PropertyMode>(property.mode) == PropertyMode::Latent
                                ? OcclusionMode::Latent
                                : OcclusionMode::Exact;
    options.costs = {{.query_ns = 3.0 * property.query_ns, .box_ns = 1.0, .draw_ns = 8.0},
                     {.query_ns = property.query_ns, .box_ns = 3.0, .draw_ns = 6.0}};
    return options;
}

/// Nodes that hold all that may be in view: each is drawn whole or divided, at random.
void random_list(const RhOctree& octree, const Frustum& frustum, std::uint32_t node, Uniform& uniform,
                 NodeList& list) {
    PlaneMask mask = frustum.mask;
    if (classify(frustum, octree.nodes()[node].bounds, mask) == Containment::Outside) return;
    if (octree.is_leaf(NodeId{node}) || uniform(0, 1) < 0.2) return list.nodes.push_back(NodeId{node});
    for (std::uint32_t child = node + 1; child < octree.nodes()[node].end; child = octree.nodes()[child].end)
        random_list(octree, frustum, child, uniform, list);
}

/// Appends `to_show`, where each range is joined to the one before, over the gap between, at random.
void bridge_at_random(std::span<const DrawRange> to_show, double part, Uniform& uniform,
                      std::vector<DrawRange>& ranges) {
    for (const DrawRange& range : to_show) {
        if (!ranges.empty() && ranges.back().batch == range.batch && uniform(0, 1) < part)
            ranges.back().index_count = range.first_index + range.index_count - ranges.back().first_index;
        else
            ranges.push_back(range);
    }
}

class Run {
  public:
    explicit Run(const PropertyCase& property)
        : property_(property),
          scene_(property),
          triangles_(scene_.triangles()),
          octree_(octree_of(property, scene_, 1)),
          other_octree_(octree_of(property, scene_, 2)),
          planner_(octree_, costs_of(property), occlusion_of(property)),
          other_(other_octree_, costs_of(property), occlusion_of(property)),
          gpu_({property.latency, property.spread, property.lost, property.duplicated, true, property.seed}),
          uniform_(property.seed) {
        // Objects are boxes of triangles that the static scene has as well: whether they are drawn is asked.
        for (std::size_t t = 0; t < triangles_.size(); t += 3) {
            object_boxes_.emplace_back();
            for (const glm::dvec3& corner : triangles_[t].corners)
                object_boxes_.back().grow(glm::vec3(corner));
        }
    }

    PropertyOutcome all_frames() {
        for (const View& view : views_of(property_, scene_)) {
            frame(view);
            if (!outcome_.failure.empty()) break;
            ++outcome_.frames;
        }
        return outcome_;
    }

  private:
    void fail(const char* what) {
        if (outcome_.failure.empty())
            outcome_.failure = std::string(what) + ", frame " + std::to_string(outcome_.frames);
    }

    void frame(const View& view) {
        const auto answers = gpu_.next_frame();
        for (const QueryAnswer& answer : answers) outcome_.hidden_answers += answer.visible ? 0 : 1;
        const FrameInput input{
            .culling_view = view, .scene_origin = origin_of(property_), .object_boxes = object_boxes_};
        for (FramePlanner* planner : {&planner_, &other_}) planner->absorb(answers);
        planner_.plan(input, plan_);
        other_.plan(input, other_plan_);
        if (plan_hash(plan_) != plan_hash(other_plan_)) fail("builds on one thread and on two differ");
        outcome_.hash = plan_hash(plan_, outcome_.hash ^ 0xcbf29ce484222325ull);
        if (!read_plan()) return fail("a range or query leaves its array");
        check_boxes();
        check_picture(RayPicture(view, origin_of(property_), triangles_));
        if (static_cast<PropertyMode>(property_.mode) != PropertyMode::Latent) check_corners(view);
        if (static_cast<PropertyMode>(property_.mode) == PropertyMode::NoQueries) check_price(view);
    }

    bool read_plan() {
        at_once_.assign(triangles_.size(), false);
        query_.assign(triangles_.size(), kNone);
        const auto each = [&](const DrawRange& range, const auto& mark) {
            if (range.index_count == 0 ||
                std::uint64_t{range.first_index} + range.index_count > octree_.indices().size())
                return false;
            for (std::uint32_t k = 0; k < range.index_count; ++k)
                mark(octree_.indices()[range.first_index + k] / 3);
            return true;
        };
        for (const DrawRange& range : plan_.opaque)
            if (!each(range, [&](std::uint32_t t) { at_once_[t] = true; })) return false;
        for (const ConditionalRange& conditional : plan_.conditional)
            if (conditional.query >= plan_.queries.size() ||
                !each(conditional.range, [&](std::uint32_t t) { query_[t] = conditional.query; }))
                return false;
        outcome_.conditional_ranges += plan_.conditional.size();
        return std::ranges::all_of(plan_.queries, [&](const PlannedQuery& query) {
            return query.box_count > 0 &&
                   std::uint64_t{query.first_box} + query.box_count <= plan_.query_boxes.size();
        });
    }

    [[nodiscard]] std::span<const Aabb> boxes_of(const PlannedQuery& query) const {
        return std::span(plan_.query_boxes).subspan(query.first_box, query.box_count);
    }

    void check_boxes() {
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (query_[t] == kNone) continue;
            const auto boxes = boxes_of(plan_.queries[query_[t]]);
            const bool held = std::ranges::any_of(boxes, [&](const Aabb& box) {
                return std::ranges::all_of(triangles_[t].corners, [&](const glm::dvec3& p) {
                    return glm::all(glm::lessThanEqual(glm::dvec3(box.min), p)) &&
                           glm::all(glm::lessThanEqual(p, glm::dvec3(box.max)));
                });
            });
            if (!held) fail("a triangle hangs on a query whose boxes do not hold it");
        }
    }

    template <class Shown>
    static double nearest(const RayPicture& picture, std::size_t pixel, const Shown& shown) {
        double distance = RayPicture::kNothing;
        for (const RayHit& hit : picture.hits(pixel))
            if (shown(hit.triangle)) distance = std::min(distance, hit.distance);
        return distance;
    }

    void check_picture(const RayPicture& picture) {
        std::vector<bool> sees(plan_.queries.size());
        for (std::size_t pixel = 0; pixel < picture.pixels(); ++pixel) {
            const double opaque = nearest(picture, pixel, [&](std::uint32_t t) { return at_once_[t]; });
            for (std::size_t q = 0; q < sees.size(); ++q)
                for (const Aabb& box : boxes_of(plan_.queries[q]))
                    if (!sees[q]) {
                        const double enters = picture.enters(pixel, box);
                        sees[q] = enters < RayPicture::kNothing && enters <= opaque * (1.0 + 1e-9);
                    }
        }
        for (std::size_t q = 0; q < sees.size(); ++q) gpu_.ask({plan_.queries[q].ticket, sees[q], 0});
        // In latent mode what was hidden may be left out, but not before an answer has said so.
        if (static_cast<PropertyMode>(property_.mode) == PropertyMode::Latent && outcome_.hidden_answers > 0)
            return;
        for (std::size_t pixel = 0; pixel < picture.pixels(); ++pixel) {
            const double all = nearest(picture, pixel, [](std::uint32_t) { return true; });
            const double shown = nearest(picture, pixel, [&](std::uint32_t t) {
                return at_once_[t] || (query_[t] != kNone && sees[query_[t]]);
            });
            if (all < RayPicture::kNothing && !(shown <= all * (1.0 + 1e-9))) fail("a pixel is missing");
            outcome_.pixels += all < RayPicture::kNothing ? 1 : 0;
        }
    }

    /// Triangles whose corners are all well in view, and whose front the eye is clearly before.
    void check_corners(const View& view) {
        if (property_.orthographic != 0) return;
        const glm::dmat4 clip = view.clip_from_eye_relative();
        const glm::dvec3 eye = view.eye() - origin_of(property_);
        const auto well_in_view = [&](const glm::dvec3& corner) {
            const glm::dvec4 p = clip * glm::dvec4(corner - eye, 1.0);
            const double z = view.clip_depth == ClipDepth::NegativeOneToOne ? 0.5 * (p.z + p.w) : p.z;
            const double w = p.w * (1.0 - 1e-5);
            return p.w > 0.0 && std::abs(p.x) < w && std::abs(p.y) < w && z > 1e-5 * p.w && z < w;
        };
        std::vector<bool> object_drawn(object_boxes_.size());
        for (const ObjectId object : plan_.objects) object_drawn[index_of(object)] = true;
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const auto& c = triangles_[t].corners;
            const bool object_missing = t % 3 == 0 && !object_drawn[t / 3];
            if (!object_missing && (at_once_[t] || query_[t] != kNone)) continue;
            if (object_missing && std::ranges::any_of(c, well_in_view))
                return fail("an object in view is left out");
            if (at_once_[t] || query_[t] != kNone || !std::ranges::all_of(c, well_in_view)) continue;
            const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
            const double facing = glm::dot(normal, eye - c[0]);
            if (triangles_[t].two_sided || facing > 1e-3 * glm::length(normal) * glm::length(eye - c[0]))
                return fail("a triangle in view is left out");
        }
    }

    void check_price(const View& view) {
        const DrawCosts costs = costs_of(property_);
        const double ours = price(plan_.opaque, costs);
        if (!plan_.predicted_ns || std::abs(*plan_.predicted_ns - ours) > 1e-9 * (1.0 + ours))
            fail("a plan does not cost what it says");
        const Frustum frustum = make_frustum(view, origin_of(property_));
        std::vector<DrawRange> ranges;
        const auto compare = [&](const char* what) {
            if (ours > price(ranges, costs) * (1.0 + 1e-9)) fail(what);
            ++outcome_.lists;
            ranges.clear();
        };
        const auto everything = octree_.ranges(NodeId{0});
        ranges.assign(everything.begin(), everything.end());
        compare("everything is cheaper");
        std::vector<DrawRange> to_show;
        append_ranges_to_show(octree_, frustum, make_viewpoint(view, origin_of(property_)), to_show);
        std::ranges::sort(to_show, {},
                          [](const DrawRange& range) { return std::pair(range.batch, range.first_index); });
        for (const double bridged : {0.0, 0.1, 0.5, 0.9}) {
            bridge_at_random(to_show, bridged, uniform_, ranges);
            compare("what must be shown, with random gaps bridged, is cheaper");
        }
        // Records that were joined are coarser than leaves: what they hold is drawn as one.
        if (property_.record > 0) return;
        NodeList nodes;
        leaf_draw_list(octree_, frustum, nodes);
        append_ranges(octree_, nodes, ranges);
        compare("the leaves are cheaper");
        seed_draw_list(octree_, frustum, nodes);
        append_ranges(octree_, nodes, ranges);
        compare("the paper's list is cheaper");
        for (int i = 0; i < 4; ++i) {
            nodes.nodes.clear();
            random_list(octree_, frustum, 0, uniform_, nodes);
            append_ranges(octree_, nodes, ranges);
            compare("a random list is cheaper");
        }
    }

    PropertyCase property_;
    PropertyScene scene_;
    std::vector<SingleTriangle> triangles_;
    RhOctree octree_, other_octree_;
    RhviewPlanner planner_, other_;
    FakeGpu gpu_;
    Uniform uniform_;
    FramePlan plan_, other_plan_;
    std::vector<Aabb> object_boxes_;
    std::vector<bool> at_once_;         ///< by triangle
    std::vector<std::uint32_t> query_;  ///< by triangle
    PropertyOutcome outcome_;
};

}  // namespace

PropertyOutcome run_property(const PropertyCase& property) {
    return Run(property).all_frames();
}

PropertyCase shrink(PropertyCase failing, int most_runs) {
    for (bool found = true; found;) {
        found = false;
        for (const PropertyCase& candidate : simpler(failing)) {
            if (most_runs-- <= 0) return failing;
            if (run_property(candidate).failure.empty()) continue;
            failing = candidate;
            found = true;
            break;
        }
    }
    return failing;
}

}  // namespace rhview
