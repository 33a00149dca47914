// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "recorder.h"

namespace rhview {

void DrawnFrame::clear() {
    plan.clear();
    answers.clear();
    geometry_queries = 0;
    hidden_queries = 0;
}

void Recorder::begin(OcclusionDevice& device, DrawnFrame& drawn) {
    device_ = &device;
    drawn_ = &drawn;
    drawn.clear();
    first_unasked_ = 0;
}

void Recorder::draw(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) {
    device_->draw(ranges, objects);
    drawn_->plan.opaque.insert(drawn_->plan.opaque.end(), ranges.begin(), ranges.end());
    drawn_->plan.objects.insert(drawn_->plan.objects.end(), objects.begin(), objects.end());
}

Asked Recorder::draw_and_ask(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) {
    const Asked asked{device_->draw_and_ask(ranges, objects), 0};
    drawn_->plan.opaque.insert(drawn_->plan.opaque.end(), ranges.begin(), ranges.end());
    drawn_->plan.objects.insert(drawn_->plan.objects.end(), objects.begin(), objects.end());
    ++drawn_->geometry_queries;
    return asked;
}

void Recorder::begin_query() {
    FramePlan& plan = drawn_->plan;
    const auto first = static_cast<std::uint32_t>(plan.query_boxes.size());
    plan.queries.push_back({next_ticket_++, first, 0, QueryWay::HardwareQuery, false});
}

void Recorder::add_box(const Aabb& box) {
    drawn_->plan.query_boxes.push_back(box);
    ++drawn_->plan.queries.back().box_count;
}

void Recorder::ask(std::vector<Asked>& asked) {
    const FramePlan& plan = drawn_->plan;
    if (first_unasked_ == plan.queries.size()) return;
    const std::uint32_t first_box = plan.queries[first_unasked_].first_box;
    queries_.clear();
    handles_.clear();
    for (std::size_t i = first_unasked_; i < plan.queries.size(); ++i)
        queries_.push_back({plan.queries[i].first_box - first_box, plan.queries[i].box_count});
    device_->ask(queries_, std::span(plan.query_boxes).subspan(first_box), handles_);
    for (std::size_t i = 0; i < handles_.size(); ++i)
        asked.push_back({handles_[i], plan.queries[first_unasked_ + i].ticket});
    first_unasked_ = plan.queries.size();
}

bool Recorder::take(const Asked& asked) {
    const bool seen = device_->take_answer(asked.handle);
    if (asked.ticket != 0) drawn_->answers.push_back({asked.ticket, seen, 0});
    if (!seen) ++drawn_->hidden_queries;
    return seen;
}

}  // namespace rhview
