// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "frame_pictures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace rhview::cli {
namespace {

constexpr double kMargin = 1.05;
constexpr glm::vec3 kPaper(0.96f, 0.96f, 0.94f);
constexpr glm::vec3 kNotDrawn(0.30f, 0.31f, 0.33f);
constexpr glm::vec3 kBridged(0.70f, 0.10f, 0.85f);
constexpr glm::vec3 kBoxes(0.10f, 0.25f, 0.75f);
constexpr glm::vec3 kSeen(0.0f, 0.62f, 0.20f);
constexpr glm::vec3 kHidden = kBoxes;
constexpr glm::vec3 kFrustum(0.85f, 0.0f, 0.25f);

/// Looks straight down on all of `bounds`, north (-z) up. What is higher than a viewer within the scene is
/// cut off: a ceiling would hide all that matters.
View view_from_above(const Aabb& bounds, const glm::dvec3& origin, double aspect, const View& viewer) {
    const glm::dvec3 extent = glm::max(glm::dvec3(bounds.extent()), glm::dvec3(1e-3));
    const glm::dvec3 centre = origin + glm::dvec3(bounds.centre());
    const double height = kMargin * std::max(extent.z, extent.x / aspect);
    const glm::dvec3 eye(centre.x, origin.y + static_cast<double>(bounds.max.y) + 0.1 * extent.y, centre.z);
    return {look_along(eye, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}),
            orthographic(height * aspect, height, std::clamp(eye.y - viewer.eye().y, 0.0, 1.1 * extent.y),
                         1.2 * extent.y, viewer.clip_depth),
            viewer.clip_depth};
}

/// Colour of the n-th call: neighbours differ, replicas never look like base ranges.
glm::vec3 call_colour(std::size_t call, bool replica) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    const double turn = kGoldenRatio * static_cast<double>(call);
    const auto t = static_cast<float>(turn - std::floor(turn));
    return replica ? glm::mix(glm::vec3(0.05f, 0.75f, 0.45f), glm::vec3(0.05f, 0.35f, 1.0f), t)
                   : glm::mix(glm::vec3(1.0f, 0.80f, 0.10f), glm::vec3(0.95f, 0.15f, 0.05f), t);
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

/// The boxes of the plan's queries that saw something, or nothing.
gl::Lines boxes_answered(const FramePlan& plan, std::span<const QueryAnswer> answers, bool visible,
                         const glm::dvec3& origin) {
    gl::Lines lines;
    for (const PlannedQuery& query : plan.queries) {
        const auto answer = std::ranges::find(answers, query.ticket, &QueryAnswer::ticket);
        if ((answer == answers.end() || answer->visible) != visible) continue;
        for (std::uint32_t box = query.first_box; box < query.first_box + query.box_count; ++box)
            lines.add_box(plan.query_boxes[box], origin);
    }
    return lines;
}

}  // namespace

ViewFromAbove::ViewFromAbove(gl::RenderTarget target, gl::LineDrawer lines)
    : target_(std::move(target)), lines_(std::move(lines)) {}

Result<ViewFromAbove> ViewFromAbove::create(int width, int height) {
    Result<gl::RenderTarget> target = gl::RenderTarget::create(width, height);
    if (!target) return target.error();
    Result<gl::LineDrawer> lines = gl::LineDrawer::create();
    if (!lines) return lines.error();
    return ViewFromAbove(std::move(target).value(), std::move(lines).value());
}

gl::Picture ViewFromAbove::draw(const FramePlan& everything, const FramePlan& plan,
                                std::span<const QueryAnswer> answers, std::span<const DrawRange> to_show,
                                const std::function<Aabb(std::uint32_t)>& bounds_of,
                                const gl::SceneBuffers& buffers, const Aabb& bounds, const View& view,
                                std::span<const glm::dmat4> placements, gl::Executor& executor) {
    const double aspect = static_cast<double>(target_.width()) / target_.height();
    const View above = view_from_above(bounds, buffers.origin(), aspect, view);
    target_.begin(view.clip_depth, kPaper);
    executor.draw(everything, buffers, above, {gl::Submission::MultiDraw, kNotDrawn, nullptr, placements});
    std::uint64_t base_indices = 0;
    for (const DrawRange& range : everything.opaque) base_indices += range.index_count;
    std::vector<DrawRange> sorted(to_show.begin(), to_show.end());
    std::ranges::sort(sorted, {}, &DrawRange::first_index);
    FramePlan one, gaps;
    for (std::size_t call = 0; call < plan.opaque.size(); ++call) {
        const bool replica = plan.opaque[call].first_index >= base_indices;
        one.opaque.assign(1, plan.opaque[call]);
        executor.draw(one, buffers, above, {gl::Submission::Plain, call_colour(call, replica)});
        if (!replica && !sorted.empty()) append_gaps(plan.opaque[call], sorted, gaps.opaque);
    }
    executor.draw(gaps, buffers, above, {gl::Submission::MultiDraw, kBridged});
    const auto is_hidden = [&](std::uint32_t query) {
        const auto answer = std::ranges::find(answers, plan.queries[query].ticket, &QueryAnswer::ticket);
        return answer != answers.end() && !answer->visible;
    };
    FramePlan objects;
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        objects.objects.push_back(plan.objects[i]);
        objects.object_levels.push_back(plan.level_of_object(i));
    }
    for (const ConditionalObject& object : plan.conditional_objects) {
        if (is_hidden(object.query)) continue;
        objects.objects.push_back(object.object);
        objects.object_levels.push_back(object.level);
    }
    for (std::size_t i = 0; i < plan.conditional.size(); ++i) {
        if (is_hidden(plan.conditional[i].query)) continue;
        one.opaque.assign(1, plan.conditional[i].range);
        executor.draw(one, buffers, above,
                      {gl::Submission::Plain, call_colour(plan.opaque.size() + i, false)});
    }
    executor.draw(objects, buffers, above,
                  {gl::Submission::Plain, call_colour(0, false), nullptr, placements});
    gl::Lines boxes;
    if (plan.queries.empty())
        for (const std::uint32_t chosen : plan.chosen) boxes.add_box(bounds_of(chosen), buffers.origin());
    lines_.draw(boxes, above, kBoxes);
    lines_.draw(boxes_answered(plan, answers, false, buffers.origin()), above, kHidden);
    lines_.draw(boxes_answered(plan, answers, true, buffers.origin()), above, kSeen);
    gl::Lines frustum;
    frustum.add_frustum(view, static_cast<double>(glm::length(bounds.extent())));
    lines_.draw(frustum, above, kFrustum);
    return target_.read_colour();
}

}  // namespace rhview::cli
