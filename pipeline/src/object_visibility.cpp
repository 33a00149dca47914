// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The part of `NodeVisibility` that is about objects.

#include <algorithm>

#include "rhview/pipeline/node_visibility.h"

namespace rhview {
namespace {

/// Objects of a leaf: as many as are worth about this many questions, within limits.
constexpr double kLeafQuestions = 16.0;
constexpr double kMostPerLeaf = 64.0, kLeastPerLeaf = 4.0;

}  // namespace

/// What drawing an object takes, with its share of the calls of its group.
double NodeVisibility::object_ns(const FrameInput& input, std::size_t object) const {
    const double index_ns = std::max(costs_.index_ns, options_.shown_index_ns);
    const double sharing =
        object < input.object_groups.size() ? group_sizes_[input.object_groups[object]] : 1.0;
    return index_ns * options_.object_indices[object] + costs_.draw_ns / std::max(sharing, 1.0);
}

/// The mean of `object_ns` in one pass: the calls of a group are shared by all of it.
void NodeVisibility::price_objects(const FrameInput& input) {
    group_sizes_.clear();
    const std::size_t count = input.object_boxes.size();
    const std::size_t grouped = std::min(count, input.object_groups.size());
    const std::size_t known = std::min(count, options_.object_indices.size());
    std::uint64_t indices = 0, priced = 0;
    double draws = 0.0;
    const auto count_groups = [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const std::uint32_t group = input.object_groups[i];
            if (group >= group_sizes_.size()) group_sizes_.resize(group + 1, 0);
            if (input.is_alive(i)) ++group_sizes_[group];
        }
    };
    count_groups(0, std::min(grouped, known));
    known_sizes_.assign(group_sizes_.begin(), group_sizes_.end());
    count_groups(std::min(grouped, known), grouped);
    for (std::size_t group = 0; group < known_sizes_.size(); ++group)
        if (known_sizes_[group] > 0) draws += static_cast<double>(known_sizes_[group]) / group_sizes_[group];
    for (std::size_t i = 0; i < known; ++i) {
        if (!input.is_alive(i)) continue;
        indices += options_.object_indices[i];
        ++priced;
        draws += i < grouped ? 0.0 : 1.0;
    }
    const double index_ns = std::max(costs_.index_ns, options_.shown_index_ns);
    const double sum_ns = index_ns * static_cast<double>(indices) + costs_.draw_ns * draws;
    mean_object_ns_ = priced > 0 ? sum_ns / static_cast<double>(priced) : 0.0;
    groups_in_use_ = std::max<std::size_t>(
        group_sizes_.size() - static_cast<std::size_t>(std::ranges::count(group_sizes_, 0u)), 1);
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
    candidate.counts_samples |= options_.counts_samples;
    candidates_.push_back(candidate);
    region_of_candidate_.push_back(kNoRegion);
    return part_of(candidate, belief);
}

OcclusionCandidate NodeVisibility::region_candidate(std::uint32_t index, bool testable) const {
    const HierarchyNode& node = regions_.nodes()[index];
    OcclusionCandidate candidate = candidate_of(region_item(index), node.bounds);
    candidate.render_ns = static_cast<float>(mean_object_ns_ * node.count);
    candidate.draws = static_cast<std::uint16_t>(std::min<std::size_t>({node.count, groups_in_use_, 0xffff}));
    candidate.testable = testable;
    return candidate;
}

NodeVisibility::Parts NodeVisibility::add_region(std::uint32_t index, bool testable, Belief belief) {
    candidates_.push_back(region_candidate(index, testable));
    region_of_candidate_.push_back(index);
    return part_of(candidates_.back(), belief);
}

/// Regions made anew inherit what was believed of their objects.
bool NodeVisibility::was_hidden(const HierarchyNode& node) const {
    const auto objects = regions_.order().subspan(node.first, node.count);
    return std::ranges::all_of(objects, [&](ObjectId object) {
        const std::size_t id = index_of(object);
        return id / 64 < hidden_objects_.size() && (hidden_objects_[id / 64] >> (id % 64) & 1) != 0;
    });
}

/// As with nodes of the octree: one question while all of it is believed hidden, else its parts. Recursion is
/// as deep as the hierarchy: 64 levels at most.
NodeVisibility::Parts NodeVisibility::visit_region(const FrameInput& input, std::uint32_t index,
                                                   PlaneMask mask, Belief otherwise) {
    const HierarchyNode& node = regions_.nodes()[index];
    ++nodes_visited_;
    if (classify(*frustum_, node.bounds, mask) == Containment::Outside) return {};
    if (regions_remade_) otherwise = was_hidden(node) ? Belief::Hidden : Belief::Unknown;
    const std::uint32_t item = region_item(index);
    const Belief belief = scheduler_.visit(item, otherwise);
    const bool leaf = regions_.is_leaf(index);
    // Objects that nothing would be asked about one by one: never taken apart.
    const bool whole = leaf && mean_object_ns_ < query_ns_;
    const bool one =
        belief == Belief::Hidden || (belief == Belief::Unknown && mean_object_ns_ * node.count <= grain_ns_);
    const bool testable = (one || whole) && is_testable(node.bounds);
    if (whole || (one && testable)) return add_region(index, testable, belief);
    const bool parts_hidden = belief == Belief::Hidden || scheduler_.turned_visible(item);
    return visit_members(input, index, mask, parts_hidden ? Belief::Hidden : Belief::Unknown);
}

NodeVisibility::Parts NodeVisibility::visit_members(const FrameInput& input, std::uint32_t index,
                                                    PlaneMask mask, Belief otherwise) {
    const HierarchyNode& node = regions_.nodes()[index];
    const std::size_t first = candidates_.size();
    Parts parts;
    if (regions_.is_leaf(index))
        regions_.for_each_in_view(index, *frustum_, input.object_alive, words_, [&](ObjectId object) {
            parts.add(add_object(input, static_cast<std::uint32_t>(object), otherwise));
        });
    else
        for (std::uint32_t child = index + 1; child < node.escape; child = regions_.nodes()[child].escape)
            parts.add(visit_region(input, child, mask, otherwise));
    if (!parts.seem_hidden() || candidates_.size() <= first + 1 || !is_testable(node.bounds)) return parts;
    OcclusionCandidate whole = region_candidate(index, true);
    if (make_trial(parts, whole)) {
        candidates_.push_back(whole);
        region_of_candidate_.push_back(index);
    }
    return parts;
}

/// Whether the objects of the frame are in regions.
bool NodeVisibility::update_regions(const FrameInput& input) {
    regions_remade_ = false;
    const std::size_t count = input.object_boxes.size();
    if (options_.settings.policy != OcclusionPolicy::Model || count < options_.fewest_for_regions ||
        options_.object_indices.size() < count || !(mean_object_ns_ > 0.0))
        return false;
    const double worth = kLeafQuestions * query_ns_ / mean_object_ns_;
    const double per_leaf = worth >= kLeastPerLeaf ? std::min(worth, kMostPerLeaf) : kLeastPerLeaf;
    regions_remade_ = regions_.update(input.object_boxes, static_cast<std::uint32_t>(per_leaf));
    if (regions_.nodes().size() > count) return false;  // there are no more numbers
    if (regions_remade_)
        for (std::uint32_t i = 0; i < regions_.nodes().size(); ++i) scheduler_.forget(region_item(i));
    return true;
}

void NodeVisibility::add_objects(const FrameInput& input) {
    region_of_candidate_.clear();
    price_objects(input);
    const std::span<const Aabb> boxes = input.object_boxes;
    if (!update_regions(input)) {
        objects_in_view_.clear();
        append_visible_objects(*frustum_, boxes, objects_in_view_, input.object_alive);
        for (const ObjectId object : objects_in_view_)
            add_object(input, static_cast<std::uint32_t>(object), Belief::Unknown);
        return;
    }
    visit_region(input, 0, frustum_->mask, Belief::Unknown);
    for (std::size_t i = regions_.object_count(); i < boxes.size(); ++i) {
        PlaneMask mask = frustum_->mask;
        if (input.is_alive(i) && classify(*frustum_, boxes[i], mask) != Containment::Outside)
            add_object(input, static_cast<std::uint32_t>(i), Belief::Unknown);
    }
}

void NodeVisibility::write_objects(const FrameInput& input, FramePlan& plan) {
    hidden_objects_.assign((input.object_boxes.size() + 63) / 64, 0);
    for (std::size_t c = leaf_of_candidate_.size(); c < candidates_.size(); ++c) {
        if (candidates_[c].trial) continue;
        const OcclusionDecision& decision = decided_.decisions[c];
        const auto write = [&](ObjectId object) {
            const bool hidden =
                decision.action == OcclusionAction::QueryFirst || decision.action == OcclusionAction::Skip;
            if (hidden) hidden_objects_[index_of(object) / 64] |= std::uint64_t{1} << (index_of(object) % 64);
            if (decision.action == OcclusionAction::QueryFirst)
                plan.conditional_objects.push_back({object, decision.query});
            else if (!hidden)
                plan.objects.push_back(object);
        };
        const std::uint32_t region = region_of_candidate_[c - leaf_of_candidate_.size()];
        if (region != kNoRegion) {
            regions_.for_each_in_view(region, *frustum_, input.object_alive, words_, write);
            continue;
        }
        const ObjectId object{(candidates_[c].item - first_object_item()) / 2};
        write(object);
        if (decision.query == OcclusionDecision::kNoQuery) continue;
        const ScheduledQuery& query = decided_.queries[decision.query];
        if (query.counts_samples && query.member_count == 1)
            plan.counted_objects.push_back({object, decision.query});
    }
}

}  // namespace rhview
