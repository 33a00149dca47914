// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The part of `NodeVisibility` that is about objects.

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "rhview/pipeline/node_visibility.h"

namespace rhview {
namespace {

/// Fewer objects, or fewer to a region, and regions are not worth their upkeep.
constexpr std::size_t kFewObjects = 128;
constexpr double kFewPerRegion = 4.0;

bool is_finite(const Aabb& box) {
    const glm::vec3 sum = glm::abs(box.min) + glm::abs(box.max);
    return std::isfinite(sum.x + sum.y + sum.z);
}

}  // namespace

template <class Each>
void NodeVisibility::for_each_object(const RegionInView& region, Each each) const {
    for (std::uint64_t rest = region.objects; rest != 0; rest &= rest - 1) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(rest));
        each(static_cast<std::uint32_t>(regions_.order()[region.first + bit]), bit);
    }
}

/// What drawing an object takes, with its share of the calls of its group.
double NodeVisibility::object_ns(const FrameInput& input, std::size_t object) const {
    const double index_ns = std::max(costs_.index_ns, options_.shown_index_ns);
    const double sharing =
        object < input.object_groups.size() ? group_sizes_[input.object_groups[object]] : 1.0;
    return index_ns * options_.object_indices[object] + costs_.draw_ns / std::max(sharing, 1.0);
}

void NodeVisibility::price_objects(const FrameInput& input) {
    group_sizes_.clear();
    const std::size_t count = input.object_boxes.size();
    for (std::size_t i = 0; i < std::min(count, input.object_groups.size()); ++i) {
        const std::uint32_t group = input.object_groups[i];
        if (group >= group_sizes_.size()) group_sizes_.resize(group + 1, 0);
        if (input.is_alive(i)) ++group_sizes_[group];
    }
    double sum = 0.0;
    std::size_t known = 0;
    for (std::size_t i = 0; i < std::min(count, options_.object_indices.size()); ++i) {
        if (!input.is_alive(i)) continue;
        sum += object_ns(input, i);
        ++known;
    }
    mean_object_ns_ = known > 0 ? sum / static_cast<double>(known) : 0.0;
}

NodeVisibility::Parts NodeVisibility::add_object(const FrameInput& input, std::uint32_t object,
                                                 Belief otherwise) {
    const std::uint32_t item = object_item(object);
    const Belief belief = scheduler_.visit(item, otherwise);
    const Aabb& box = input.object_boxes[object];
    const bool known = object < options_.object_indices.size();
    OcclusionCandidate candidate = candidate_of(item, box);
    candidate.render_ns = known ? static_cast<float>(object_ns(input, object)) : 0.0f;
    candidate.testable = known && is_testable(box);
    candidate.counts_samples = options_.counts_samples;
    candidates_.push_back(candidate);
    region_of_candidate_.push_back(kNoRegion);
    const bool hidden = belief == Belief::Hidden && candidate.testable;
    return {true, hidden, hidden ? scheduler_.p_hidden(item) : 0.0};
}

/// Takes out of `region` what can't be asked about with others, and adds it on its own. False: nothing is
/// left.
bool NodeVisibility::describe_region(const FrameInput& input, RegionInView& region,
                                     OcclusionCandidate& candidate, Aabb& box) {
    double render_ns = 0.0;
    std::uint64_t groups = 0, alone = 0;
    for_each_object(region, [&](std::uint32_t object, std::uint32_t bit) {
        if (object >= options_.object_indices.size() || !is_finite(input.object_boxes[object])) {
            alone |= std::uint64_t{1} << bit;
            add_object(input, object, Belief::Unknown);
            return;
        }
        box.grow(input.object_boxes[object]);
        render_ns += object_ns(input, object);
        groups |= std::uint64_t{1} << (object < input.object_groups.size() ? input.object_groups[object] % 64
                                                                           : object % 64);
    });
    region.objects &= ~alone;
    if (region.objects == 0) return false;
    candidate = candidate_of(region_item(region.region), box);
    candidate.render_ns = static_cast<float>(render_ns);
    candidate.draws = static_cast<std::uint16_t>(std::popcount(groups));
    candidate.testable = is_testable(box);
    return true;
}

void NodeVisibility::add_region(std::uint32_t in_view, const OcclusionCandidate& candidate) {
    candidates_.push_back(candidate);
    region_of_candidate_.push_back(in_view);
}

void NodeVisibility::visit_region(const FrameInput& input, std::uint32_t in_view) {
    RegionInView& region = regions_in_view_[in_view];
    OcclusionCandidate candidate;
    if (!describe_region(input, region, candidate, region_boxes_[in_view])) return;
    const Belief belief = scheduler_.visit(candidate.item);
    // Objects that nothing would be asked about one by one: never taken apart.
    const bool whole = mean_object_ns_ < query_ns_;
    const bool one = belief == Belief::Hidden ||
                     (belief == Belief::Unknown && static_cast<double>(candidate.render_ns) <= grain_ns_);
    if (whole || (one && candidate.testable)) return add_region(in_view, candidate);
    const bool was_hidden = belief == Belief::Hidden || scheduler_.turned_visible(candidate.item);
    const std::size_t first = candidates_.size();
    Parts parts;
    for_each_object(region, [&](std::uint32_t object, std::uint32_t) {
        parts.add(add_object(input, object, was_hidden ? Belief::Hidden : Belief::Unknown));
    });
    const bool all_hidden = parts.all_hidden && candidates_.size() > first + 1 && candidate.testable;
    if (!all_hidden || !scheduler_.merge(candidate.item, parts.p_hidden)) return;
    candidates_.resize(first);
    region_of_candidate_.resize(first - leaf_of_candidate_.size());
    add_region(in_view, candidate);
}

void NodeVisibility::add_objects(const FrameInput& input) {
    region_of_candidate_.clear();
    regions_in_view_.clear();
    price_objects(input);
    const std::span<const Aabb> boxes = input.object_boxes;
    const double per_region = mean_object_ns_ > 0.0 ? grain_ns_ / mean_object_ns_ : 0.0;
    std::size_t held = 0;
    if (options_.settings.policy == OcclusionPolicy::Model && boxes.size() >= kFewObjects &&
        per_region >= kFewPerRegion) {
        const auto most =
            static_cast<std::uint32_t>(std::min<double>(per_region, ObjectRegions::kMostObjects));
        if (regions_.update(boxes, most))
            for (std::uint32_t r = 0; r < regions_.count(); ++r) scheduler_.forget(region_item(r));
        regions_.cull(*frustum_, input.object_alive, regions_in_view_);
        region_boxes_.assign(regions_in_view_.size(), {});
        for (std::uint32_t r = 0; r < regions_in_view_.size(); ++r) visit_region(input, r);
        held = regions_.object_count();
    }
    if (held == 0) {
        objects_in_view_.clear();
        append_visible_objects(*frustum_, boxes, objects_in_view_, input.object_alive);
        for (const ObjectId object : objects_in_view_)
            add_object(input, static_cast<std::uint32_t>(object), Belief::Unknown);
        return;
    }
    for (std::size_t i = held; i < boxes.size(); ++i) {
        PlaneMask mask = frustum_->mask;
        if (input.is_alive(i) && classify(*frustum_, boxes[i], mask) != Containment::Outside)
            add_object(input, static_cast<std::uint32_t>(i), Belief::Unknown);
    }
}

void NodeVisibility::write_objects(FramePlan& plan) const {
    for (std::size_t c = leaf_of_candidate_.size(); c < candidates_.size(); ++c) {
        const OcclusionDecision& decision = decided_.decisions[c];
        if (decision.action == OcclusionAction::Skip) continue;
        const auto write = [&](std::uint32_t object, std::uint32_t) {
            if (decision.action == OcclusionAction::QueryFirst)
                plan.conditional_objects.push_back({ObjectId{object}, decision.query});
            else
                plan.objects.push_back(ObjectId{object});
        };
        const std::uint32_t region = region_of_candidate_[c - leaf_of_candidate_.size()];
        if (region != kNoRegion)
            for_each_object(regions_in_view_[region], write);
        else
            write((candidates_[c].item - first_object_item()) / 2, 0);
    }
}

}  // namespace rhview
