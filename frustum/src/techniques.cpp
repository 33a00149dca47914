// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Assarsson & Möller, "Optimized view frustum culling algorithms for bounding boxes", 2000. Left out of their
// techniques: rotation coherency. It says that what was outside of a plane stays outside while the camera
// turns away from it, but not by how much, so the margin for the renderer's rounding is lost.

#include "rhview/frustum/techniques.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>

#include "box_kernels.h"
#include "order_ranges.h"
#include "technique_test.h"

namespace rhview {
namespace {

constexpr std::uint32_t kMaxDepth = 64;
// With threads: nodes of more boxes than this share of the tree are entered before the work is shared out.
constexpr std::size_t kShares = 64;

struct Subtree {
    std::uint32_t node;
    PlaneMask mask;
};

}  // namespace

/// One frame. Subtrees may be walked by several threads: they touch different memory.
class TechniqueWalk {
  public:
    TechniqueWalk(TechniqueCuller& culler, const TechniqueView& view)
        : culler_(culler),
          techniques_(culler.techniques_),
          view_(view),
          nodes_(culler.tree_.nodes()),
          boxes_(culler.tree_.boxes()) {}

    HierarchyVisits flat(std::vector<OrderRange>& visible) {
        HierarchyVisits visits;
        if (techniques_.test == BoxTest::VectorAcross) {
            const KernelPlanes planes = kernel_planes(view_.frustum, view_.frustum.mask);
            for (std::size_t first = 0; first < boxes_.count; first += 64)
                append_bits(visible, static_cast<std::uint32_t>(first),
                            cull_word(planes, boxes_.subspan(
                                                  first, std::min<std::size_t>(64, boxes_.count - first))));
        } else {
            test_leaf({{}, 0, 0, static_cast<std::uint32_t>(boxes_.count), 0}, view_.frustum.mask, visible);
        }
        visits.boxes = boxes_.count;
        return visits;
    }

    HierarchyVisits subtree(Subtree subtree, std::vector<OrderRange>& visible) {
        return techniques_.traversal == Traversal::Stack ? with_stack(subtree, visible)
                                                         : without_stack(subtree, visible);
    }

    /// Splits the tree for threads, the largest nodes first tested here.
    HierarchyVisits collect(std::vector<Subtree>& subtrees) {
        HierarchyVisits visits;
        std::array<PlaneMask, kMaxDepth + 1> masks;
        masks[0] = view_.frustum.mask;
        for (std::uint32_t i = 0; i < nodes_.size();) {
            const HierarchyNode& node = nodes_[i];
            PlaneMask mask = masks[node.depth];
            if (node.count > boxes_.count / kShares && node.escape != i + 1) {
                ++visits.nodes;
                const Containment containment = test(node.bounds, i, mask);
                if (containment == Containment::Intersecting) {
                    masks[node.depth + 1] = techniques_.masking ? mask : view_.frustum.mask;
                    ++i;
                    continue;
                }
                if (containment == Containment::Inside) subtrees.push_back({i, 0});
            } else {
                subtrees.push_back({i, mask});
            }
            i = node.escape;
        }
        return visits;
    }

  private:
    HierarchyVisits without_stack(Subtree subtree, std::vector<OrderRange>& visible) {
        HierarchyVisits visits;
        std::array<PlaneMask, kMaxDepth + 1> masks;
        masks[nodes_[subtree.node].depth] = subtree.mask;
        for (std::uint32_t i = subtree.node, end = nodes_[i].escape; i < end;) {
            const HierarchyNode& node = nodes_[i];
            PlaneMask mask = techniques_.masking ? masks[node.depth] : subtree.mask;
            if (enter(node, i, mask, visits, visible)) {
                masks[node.depth + 1] = mask;
                ++i;
            } else {
                i = node.escape;
            }
        }
        return visits;
    }

    HierarchyVisits with_stack(Subtree subtree, std::vector<OrderRange>& visible) {
        HierarchyVisits visits;
        // Each level leaves seven of eight children at most.
        std::array<Subtree, 7 * kMaxDepth + 1> stack;
        std::size_t size = 1;
        stack[0] = subtree;
        while (size > 0) {
            const Subtree next = stack[--size];
            const HierarchyNode& node = nodes_[next.node];
            PlaneMask mask = next.mask;
            if (!enter(node, next.node, mask, visits, visible)) continue;
            const std::size_t first = size;
            for (std::uint32_t child = next.node + 1; child < node.escape; child = nodes_[child].escape)
                stack[size++] = {child, techniques_.masking ? mask : subtree.mask};
            std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(first),
                         stack.begin() + static_cast<std::ptrdiff_t>(size));
        }
        return visits;
    }

    /// True: the node's children are to be visited, with `mask`.
    bool enter(const HierarchyNode& node, std::uint32_t index, PlaneMask& mask, HierarchyVisits& visits,
               std::vector<OrderRange>& visible) {
        ++visits.nodes;
        const PlaneMask before = mask;
        const Containment containment = test(node.bounds, index, mask);
        if (containment == Containment::Outside) return false;
        if (containment == Containment::Inside) {
            append_range(visible, node.first, node.count);
            return false;
        }
        if (node.escape != index + 1) return true;
        visits.boxes += node.count;
        test_leaf(node, techniques_.masking ? mask : before, visible);
        return false;
    }

    void test_leaf(const HierarchyNode& node, PlaneMask mask, std::vector<OrderRange>& visible) {
        if (techniques_.test == BoxTest::VectorAcross && node.count <= 64) {
            append_bits(
                visible, node.first,
                cull_word(kernel_planes(view_.frustum, mask), boxes_.subspan(node.first, node.count)));
            return;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            PlaneMask box_mask = mask;
            if (test(boxes_[i], nodes_.size() + i, box_mask) != Containment::Outside)
                append_range(visible, i, 1);
        }
    }

    /// As `classify`; `place` is where the box's memory lies.
    Containment test(const Aabb& bounds, std::size_t place, PlaneMask& mask) {
        const RelativeBox box(view_, bounds);
        if (techniques_.frustum_box_first && mask != 0 && is_beyond_corners(view_, box))
            return Containment::Outside;
        if (techniques_.translation_coherency) return judge(sides_by_distance(box, bounds, place), mask);
        if (techniques_.test == BoxTest::VectorWithin) return judge(sides_in_one_vector(view_, box), mask);
        if (techniques_.test == BoxTest::Radar && view_.is_symmetric)
            return judge(sides_by_radar(view_, box), mask);
        return test_planes(box, place, mask);
    }

    static Containment judge(const PlaneSides& sides, PlaneMask& mask) {
        if ((sides.outside & mask) != 0) return Containment::Outside;
        mask = static_cast<PlaneMask>(mask & sides.crossed);
        return mask == 0 ? Containment::Inside : Containment::Intersecting;
    }

    /// Plane after plane, until one rejects the box.
    Containment test_planes(const RelativeBox& box, std::size_t place, PlaneMask& mask) {
        unsigned crossed = 0, untested = mask;
        if (techniques_.plane_coherency) {
            const unsigned first = 1u << culler_.last_plane_[place] & mask;
            if (first != 0 && is_outside(box, first, crossed, place)) return Containment::Outside;
            untested &= ~first;
        }
        if (techniques_.octant_test && view_.is_symmetric) {
            const unsigned octant = octant_planes(view_, box) & untested;
            if (is_outside(box, octant, crossed, place)) return Containment::Outside;
            untested &= ~octant;
            // What crosses is entered, and there the planes left out are tested: they must stay in the mask.
            if (crossed != 0) {
                mask = static_cast<PlaneMask>(crossed | untested);
                return Containment::Intersecting;
            }
        }
        if (is_outside(box, untested, crossed, place)) return Containment::Outside;
        mask = static_cast<PlaneMask>(crossed);
        return crossed == 0 ? Containment::Inside : Containment::Intersecting;
    }

    bool is_outside(const RelativeBox& box, unsigned planes, unsigned& crossed, std::size_t place) {
        for (; planes != 0; planes &= planes - 1) {
            const int plane = std::countr_zero(planes);
            const PlaneSides sides = techniques_.test == BoxTest::EightCorners
                                         ? side_of_corners(view_, box, plane)
                                         : side_of_p_and_n_vertex(view_, box, plane);
            if (sides.outside != 0) {
                if (techniques_.plane_coherency)
                    culler_.last_plane_[place] = static_cast<std::uint8_t>(plane);
                return true;
            }
            crossed |= sides.crossed;
        }
        return false;
    }

    /// From the distances of an earlier frame and the way since, or from new ones. In double: what is kept
    /// must be as exact near the eye as it was far away.
    PlaneSides sides_by_distance(const RelativeBox& box, const Aabb& bounds, std::size_t place) {
        TechniqueCuller::Distances& memory = culler_.distances_[place];
        const TechniqueCuller::Camera& camera = culler_.camera_;
        if (memory.epoch != camera.epoch) {
            memory.epoch = camera.epoch;
            const glm::dvec3 low(glm::dvec3(bounds.min) - view_.frustum.eye);
            const glm::dvec3 high(glm::dvec3(bounds.max) - view_.frustum.eye);
            for (int i = 0; i < 6; ++i) {
                const glm::dvec3 n(view_.frustum.box_planes[i].normal);
                const glm::dvec3 a = n * low, b = n * high;
                const glm::dvec3 most = glm::max(a, b), least = glm::min(a, b);
                memory.p[i] = most.x + most.y + most.z + camera.moved[i];
                memory.n[i] = least.x + least.y + least.z + camera.moved[i];
            }
        }
        PlaneSides sides;
        for (unsigned i = 0; i < 6; ++i) {
            const BoxPlane& plane = view_.frustum.box_planes[i];
            const double far = memory.p[i] - camera.moved[i] + plane.outside_distance;
            const double close = memory.n[i] - camera.moved[i] + plane.inside_distance;
            sides.outside |= (far + box.slack < 0.0 ? 1u : 0u) << i;
            sides.crossed |= (close - box.slack >= 0.0 ? 0u : 1u) << i;
        }
        return sides;
    }

    TechniqueCuller& culler_;
    const CullingTechniques& techniques_;
    const TechniqueView& view_;
    std::span<const HierarchyNode> nodes_;
    BoxSpans boxes_;
};

TechniqueCuller::TechniqueCuller(const BoxHierarchy& tree, const CullingTechniques& techniques)
    : tree_(tree), techniques_(techniques) {
    const std::size_t places = tree.nodes().size() + tree.order().size();
    if (techniques.plane_coherency) last_plane_.resize(places);
    if (techniques.translation_coherency) distances_.resize(places);
}

void TechniqueCuller::follow_camera(const View& view, const Frustum& frustum) {
    const glm::dmat4 clip = view.clip_from_eye_relative();
    if (camera_.epoch == 0 || clip != camera_.clip) {
        camera_ = {clip, frustum.eye, {}, camera_.epoch + 1};
        return;
    }
    for (int i = 0; i < 6; ++i)
        camera_.moved[i] += glm::dot(glm::dvec3(frustum.box_planes[i].normal), frustum.eye - camera_.eye);
    camera_.eye = frustum.eye;
}

HierarchyVisits TechniqueCuller::cull(const View& view, const glm::dvec3& scene_origin,
                                      std::vector<OrderRange>& visible) {
    visible.clear();
    const TechniqueView technique_view(view, scene_origin, techniques_);
    if (techniques_.translation_coherency) follow_camera(view, technique_view.frustum);
    TechniqueWalk walk(*this, technique_view);
    if (tree_.nodes().empty()) return {};
    if (techniques_.traversal == Traversal::Flat) return walk.flat(visible);
    if (techniques_.threads == Threads::One) return walk.subtree({0, technique_view.frustum.mask}, visible);

    std::vector<Subtree> subtrees;
    HierarchyVisits visits = walk.collect(subtrees);
    std::vector<HierarchyVisits> part_visits(subtrees.size());
    if (parts_.size() < subtrees.size()) parts_.resize(subtrees.size());
    const auto do_part = [&](std::size_t i) {
        parts_[i].clear();
        part_visits[i] = walk.subtree(subtrees[i], parts_[i]);
    };
    if (techniques_.threads == Threads::StaticSplit)
        tbb::parallel_for(std::size_t{0}, subtrees.size(), do_part, tbb::static_partitioner());
    else
        tbb::parallel_for(std::size_t{0}, subtrees.size(), do_part, tbb::simple_partitioner());
    for (std::size_t i = 0; i < subtrees.size(); ++i) {
        for (const OrderRange& range : parts_[i]) append_range(visible, range.first, range.count);
        visits.nodes += part_visits[i].nodes;
        visits.boxes += part_visits[i].boxes;
    }
    return visits;
}

}  // namespace rhview
