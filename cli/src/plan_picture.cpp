// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "plan_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace rhview::cli {
namespace {

constexpr glm::vec3 kNotDrawn(0.30f, 0.31f, 0.33f);
constexpr glm::vec3 kBridged(0.70f, 0.10f, 0.85f);
constexpr glm::vec3 kBoxes(0.10f, 0.25f, 0.75f);
constexpr glm::vec3 kSeen(0.0f, 0.62f, 0.20f);
constexpr glm::vec3 kHidden = kBoxes;
constexpr glm::vec3 kFrustum(0.85f, 0.0f, 0.25f);

/// Colour of the n-th call: neighbours differ, replicas never look like base ranges.
glm::vec3 call_colour(std::size_t call, bool replica) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    const double turn = kGoldenRatio * static_cast<double>(call);
    const auto t = static_cast<float>(turn - std::floor(turn));
    return replica ? glm::mix(glm::vec3(0.05f, 0.75f, 0.45f), glm::vec3(0.05f, 0.35f, 1.0f), t)
                   : glm::mix(glm::vec3(1.0f, 0.80f, 0.10f), glm::vec3(0.95f, 0.15f, 0.05f), t);
}

/// Finest red, coarser over yellow, green and blue to violet.
glm::vec3 level_colour(std::uint8_t level) {
    constexpr std::array kLevels{glm::vec3(0.95f, 0.15f, 0.10f), glm::vec3(1.0f, 0.55f, 0.05f),
                                 glm::vec3(0.95f, 0.85f, 0.10f), glm::vec3(0.35f, 0.80f, 0.20f),
                                 glm::vec3(0.10f, 0.70f, 0.70f), glm::vec3(0.15f, 0.35f, 0.95f),
                                 glm::vec3(0.55f, 0.15f, 0.80f)};
    return kLevels[std::min<std::size_t>(level, kLevels.size() - 1)];
}

/// The parts of `drawn`, which is one range of the base order, that `to_show` (by first index) doesn't hold.
void append_gaps(const DrawRange& drawn, std::span<const DrawRange> to_show, std::vector<DrawRange>& gaps) {
    const std::uint32_t end = drawn.first_index + drawn.index_count;
    std::uint32_t next = drawn.first_index;
    auto shown = std::ranges::lower_bound(to_show, drawn.first_index, {}, &DrawRange::first_index);
    for (; shown != to_show.end() && shown->first_index < end; ++shown) {
        if (shown->first_index > next) gaps.push_back({drawn.batch, next, shown->first_index - next});
        next = shown->first_index + shown->index_count;
    }
    if (next < end) gaps.push_back({drawn.batch, next, end - next});
}

bool is_hidden(const PicturedPlan& pictured, std::uint32_t query) {
    const auto answer =
        std::ranges::find(pictured.answers, pictured.plan.queries[query].ticket, &QueryAnswer::ticket);
    return answer != pictured.answers.end() && !answer->visible;
}

/// The boxes of the plan's queries that saw something, or nothing.
gl::Lines boxes_answered(const PicturedPlan& pictured, bool hidden) {
    gl::Lines lines;
    for (std::uint32_t q = 0; q < pictured.plan.queries.size(); ++q) {
        if (is_hidden(pictured, q) != hidden) continue;
        const PlannedQuery& query = pictured.plan.queries[q];
        for (std::uint32_t box = query.first_box; box < query.first_box + query.box_count; ++box)
            lines.add_box(pictured.plan.query_boxes[box], pictured.buffers.origin());
    }
    return lines;
}

}  // namespace

Result<PlanPicture> PlanPicture::create() {
    Result<gl::LineDrawer> lines = gl::LineDrawer::create();
    if (!lines) return lines.error();
    return PlanPicture(std::move(lines).value());
}

void PlanPicture::draw_opaque(const PicturedPlan& pictured, const View& from, bool with_gaps,
                              gl::Executor& executor) const {
    std::uint64_t base_indices = 0;
    for (const DrawRange& range : pictured.everything.opaque) base_indices += range.index_count;
    std::vector<DrawRange> sorted(pictured.to_show.begin(), pictured.to_show.end());
    std::ranges::sort(sorted, {}, &DrawRange::first_index);
    FramePlan one, gaps;
    for (std::size_t call = 0; call < pictured.plan.opaque.size(); ++call) {
        const DrawRange& range = pictured.plan.opaque[call];
        const bool replica = range.first_index >= base_indices;
        one.opaque.assign(1, range);
        executor.draw(one, pictured.buffers, from, {gl::Submission::Plain, call_colour(call, replica)});
        if (!replica && !sorted.empty()) append_gaps(range, sorted, gaps.opaque);
    }
    if (with_gaps) executor.draw(gaps, pictured.buffers, from, {gl::Submission::MultiDraw, kBridged});
}

void PlanPicture::draw_conditional(const PicturedPlan& pictured, const View& from,
                                   gl::Executor& executor) const {
    FramePlan one;
    for (std::size_t i = 0; i < pictured.plan.conditional.size(); ++i) {
        if (is_hidden(pictured, pictured.plan.conditional[i].query)) continue;
        one.opaque.assign(1, pictured.plan.conditional[i].range);
        const glm::vec3 colour = call_colour(pictured.plan.opaque.size() + i, false);
        executor.draw(one, pictured.buffers, from, {gl::Submission::Plain, colour});
    }
}

/// A call per level, each in its colour.
void PlanPicture::draw_objects(const PicturedPlan& pictured, const View& from, gl::Executor& executor) const {
    std::map<std::uint8_t, FramePlan> by_level;
    const auto add = [&](ObjectId object, std::uint8_t level) {
        by_level[level].objects.push_back(object);
        by_level[level].object_levels.push_back(level);
    };
    for (std::size_t i = 0; i < pictured.plan.objects.size(); ++i)
        add(pictured.plan.objects[i], pictured.plan.level_of_object(i));
    for (const ConditionalObject& object : pictured.plan.conditional_objects)
        if (!is_hidden(pictured, object.query)) add(object.object, object.level);
    for (const auto& [level, objects] : by_level)
        executor.draw(objects, pictured.buffers, from,
                      {gl::Submission::Plain, level_colour(level), nullptr, pictured.placements});
}

void PlanPicture::draw_boxes(const PicturedPlan& pictured, const View& from) {
    gl::Lines boxes;
    if (pictured.plan.queries.empty())
        for (const std::uint32_t chosen : pictured.plan.chosen)
            boxes.add_box(pictured.bounds_of(chosen), pictured.buffers.origin());
    lines_.draw(boxes, from, kBoxes);
    lines_.draw(boxes_answered(pictured, true), from, kHidden);
    lines_.draw(boxes_answered(pictured, false), from, kSeen);
}

void PlanPicture::draw(const PicturedPlan& pictured, const View& from, const PlanMarks& marks,
                       gl::Executor& executor) {
    if (marks.rest)
        executor.draw(pictured.everything, pictured.buffers, from,
                      {gl::Submission::MultiDraw, kNotDrawn, nullptr, pictured.placements});
    draw_opaque(pictured, from, marks.gaps, executor);
    draw_conditional(pictured, from, executor);
    draw_objects(pictured, from, executor);
    if (marks.boxes) draw_boxes(pictured, from);
    if (!marks.frustum) return;
    gl::Lines frustum;
    frustum.add_frustum(pictured.culling, static_cast<double>(glm::length(pictured.bounds.extent())));
    lines_.draw(frustum, from, kFrustum);
}

}  // namespace rhview::cli
