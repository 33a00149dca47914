// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/visibility_report.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "rhview/base/assert.h"

namespace rhview {
namespace {

/// From the eye to the nearest point of the box; infinite for an empty one.
double distance_to(const Aabb& box, const glm::dvec3& eye) {
    const glm::dvec3 nearest = glm::clamp(eye, glm::dvec3(box.min), glm::dvec3(box.max));
    return box.is_empty() ? std::numeric_limits<double>::infinity() : glm::distance(eye, nearest);
}

}  // namespace

VisibilityReport::VisibilityReport(VisibilityReportSettings settings)
    : settings_(std::move(settings)), asked_(std::max(settings_.max_answer_frames, 1u)) {
    RHVIEW_ASSERT(std::ranges::is_sorted(settings_.band_ends));
    RHVIEW_ASSERT(settings_.band_ends.size() < 0xffff);
}

void VisibilityReport::absorb(std::span<const QueryAnswer> answers) {
    for (const QueryAnswer& answer : answers)
        for (const AskedFrame& asked : asked_) {
            const auto query = std::ranges::lower_bound(asked.queries, answer.ticket, {}, &Pending::ticket);
            if (query == asked.queries.end() || query->ticket != answer.ticket) continue;
            for (std::uint32_t i = 0; i < query->object_count; ++i)
                tell(asked.objects[query->first_object + i], answer.visible, asked.frame);
            break;
        }
}

void VisibilityReport::tell(ObjectId object, bool visible, std::uint64_t frame) {
    Entry& entry = entries_[index_of(object)];
    if (!entry.alive || frame < entry.known_from) return;
    if (visible &&
        (entry.sighting.last_seen_frame == ObjectSighting::kNever || entry.sighting.last_seen_frame < frame))
        entry.sighting.last_seen_frame = frame;
    if (frame < entry.known_frame) return;
    entry.known_frame = frame;
    entry.sighting.visible = visible;
}

void VisibilityReport::update(const FrameInput& input, const FramePlan& plan) {
    became_visible_.clear();
    became_hidden_.clear();
    resize(input);
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        if (index_of(plan.objects[i]) >= entries_.size()) continue;
        Entry& entry = entries_[index_of(plan.objects[i])];
        entry.planned_frame = frame_;
        entry.sighting.level = plan.level_of_object(i);
        tell(plan.objects[i], true, frame_);
    }
    for (const ConditionalObject& conditional : plan.conditional_objects) {
        if (index_of(conditional.object) >= entries_.size()) continue;
        Entry& entry = entries_[index_of(conditional.object)];
        entry.planned_frame = frame_;
        entry.sighting.level = conditional.level;
    }
    remember_queries(plan);
    find_bands(input);
    list_changes();
    ++frame_;
}

void VisibilityReport::resize(const FrameInput& input) {
    if (entries_.size() < input.object_boxes.size()) entries_.resize(input.object_boxes.size());
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const bool alive = i < input.object_boxes.size() && input.is_alive(i);
        if (alive != entries_[i].alive) entries_[i] = {.known_from = frame_, .alive = alive};
    }
    // Numbers are used again: what has one now may be another thing than in the frame before.
    for (const ObjectId object : input.new_objects)
        if (index_of(object) < entries_.size())
            entries_[index_of(object)] = {.known_from = frame_, .alive = entries_[index_of(object)].alive};
}

void VisibilityReport::remember_queries(const FramePlan& plan) {
    AskedFrame& asked = asked_[frame_ % asked_.size()];
    asked.frame = frame_;
    asked.objects.clear();
    asked.queries.resize(plan.queries.size());
    for (std::size_t q = 0; q < plan.queries.size(); ++q) asked.queries[q] = {plan.queries[q].ticket, 0, 0};
    for (const ConditionalObject& conditional : plan.conditional_objects)
        ++asked.queries[conditional.query].object_count;
    std::uint32_t first = 0;
    for (Pending& query : asked.queries) {
        query.first_object = first;
        first += std::exchange(query.object_count, 0);
    }
    asked.objects.resize(first);
    for (const ConditionalObject& conditional : plan.conditional_objects) {
        Pending& query = asked.queries[conditional.query];
        asked.objects[query.first_object + query.object_count++] = conditional.object;
    }
    std::ranges::sort(asked.queries, {}, &Pending::ticket);
}

void VisibilityReport::find_bands(const FrameInput& input) {
    const std::vector<double>& ends = settings_.band_ends;
    const glm::dvec3 eye = input.culling_view.eye() - input.scene_origin;
    for (std::size_t i = 0; i < input.object_boxes.size() && !ends.empty(); ++i) {
        const double distance = distance_to(input.object_boxes[i], eye);
        const auto band_at = [&](double at) {
            return static_cast<std::uint16_t>(std::ranges::upper_bound(ends, at) - ends.begin());
        };
        Entry& entry = entries_[i];
        const std::uint16_t late = band_at(distance / (1.0 + settings_.band_hysteresis));
        const std::uint16_t now = band_at(distance);
        entry.sighting.band = entry.known_from == frame_ ? now : std::clamp(entry.sighting.band, late, now);
    }
}

void VisibilityReport::list_changes() {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        Entry& entry = entries_[i];
        if (!entry.alive) continue;
        if (entry.planned_frame != frame_) {
            entry.known_frame = frame_;
            entry.sighting.visible = false;
        }
        if (entry.sighting.visible == entry.was_visible) continue;
        (entry.sighting.visible ? became_visible_ : became_hidden_)
            .push_back(ObjectId{static_cast<std::uint32_t>(i)});
        entry.was_visible = entry.sighting.visible;
    }
}

ObjectSighting VisibilityReport::sighting(ObjectId object) const {
    return index_of(object) < entries_.size() ? entries_[index_of(object)].sighting : ObjectSighting{};
}

}  // namespace rhview
