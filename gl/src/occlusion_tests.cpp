// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "occlusion_tests.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <numeric>

#include "raster_precision.h"
#include "rhview/base/assert.h"
#include "rhview/pipeline/query_boxes.h"

namespace rhview::gl {

OcclusionTests::OcclusionTests(BoxDrawer drawer, QueryPool pool)
    : drawer_(std::move(drawer)), pool_(std::move(pool)) {}

Result<OcclusionTests> OcclusionTests::create(std::uint32_t lost_after_frames) {
    const bool marks = BoxPass::is_available();
    Result<BoxDrawer> drawer = BoxDrawer::create(marks);
    if (!drawer) return drawer.error();
    OcclusionTests tests(std::move(drawer).value(), QueryPool(lost_after_frames));
    if (marks) {
        Result<BoxPass> box_pass = BoxPass::create(lost_after_frames);
        if (!box_pass) return box_pass.error();
        tests.box_pass_ = std::move(box_pass).value();
    }
    tests.subpixel_bits_ = subpixel_bits();
    return tests;
}

void OcclusionTests::begin_frame() {
    pool_.begin_frame();
    if (box_pass_) box_pass_->begin_frame();
}

void OcclusionTests::ask(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                         const ObjectDrawer& objects, double growth, FrameCounters& counters) {
    counters.queries += plan.queries.size();
    const BoxWidener widener(view, scene.origin(), bound_raster_precision(subpixel_bits_), growth);
    place_boxes(plan, widener);
    if (!boxes_.empty()) drawer_.upload(boxes_);
    counters.query_boxes += boxes_.size();
    if (first_marking_ != 0) ask_hardware(plan, widener, counters);
    draws_.clear();
    for (const ConditionalRange& conditional : plan.conditional)
        if (is_indirect(conditional.query))
            draws_.push_back({conditional.range.first_index, conditional.range.index_count,
                              fates_[conditional.query].slot});
    collect_draws(objects);
    if (!slots_.empty()) ask_box_pass(widener, counters);
}

void OcclusionTests::place_boxes(const FramePlan& plan, const BoxWidener& widener) {
    fates_.assign(plan.queries.size(), {});
    boxes_.clear();
    slots_.clear();
    for (const QueryWay way : {QueryWay::HardwareQuery, QueryWay::BoxPass}) {
        if (way == QueryWay::BoxPass) first_marking_ = static_cast<std::uint32_t>(boxes_.size());
        for (std::size_t i = 0; i < plan.queries.size(); ++i)
            if (plan.queries[i].way == way) place_query(plan.queries[i], plan, widener, fates_[i]);
    }
}

void OcclusionTests::place_query(const PlannedQuery& query, const FramePlan& plan, const BoxWidener& widener,
                                 Fate& fate) {
    RHVIEW_ASSERT(query.box_count > 0 && query.first_box + query.box_count <= plan.query_boxes.size());
    const bool marks = query.way == QueryWay::BoxPass;
    RHVIEW_ASSERT(!marks || (has_box_pass() && !query.counts_samples));
    if (query.box_count == 0 || (marks && !has_box_pass())) {
        early_.push_back({query.ticket, true, 0});
        return;
    }
    fate.first_box = static_cast<std::uint32_t>(boxes_.size());
    if (marks) {
        fate.slot = static_cast<std::uint32_t>(slots_.size());
        slots_.push_back(query.ticket);
    }
    for (std::uint32_t i = 0; i < query.box_count; ++i)
        boxes_.push_back(widener.widen(plan.query_boxes[query.first_box + i], marks ? fate.slot : 0));
}

void OcclusionTests::ask_hardware(const FramePlan& plan, const BoxWidener& widener, FrameCounters& counters) {
    drawer_.begin(widener, BoxDrawer::Effect::None);
    for (std::size_t i = 0; i < plan.queries.size(); ++i) {
        const PlannedQuery& query = plan.queries[i];
        if (query.way != QueryWay::HardwareQuery || query.box_count == 0) continue;
        fates_[i].name = pool_.begin(query.ticket, query.counts_samples);
        BoxDrawer::draw(fates_[i].first_box, query.box_count);
        pool_.end();
        ++counters.query_draw_calls;
    }
}

void OcclusionTests::collect_draws(const ObjectDrawer& objects) {
    for (const ObjectRun& run : objects.conditional())
        if (is_indirect(run.query))
            draws_.push_back({run.range.first_index, run.range.index_count, fates_[run.query].slot,
                              run.instances, run.first_instance});
}

void OcclusionTests::ask_box_pass(const BoxWidener& widener, FrameCounters& counters) {
    box_pass_->clear(slots_.size());
    drawer_.begin(widener, BoxDrawer::Effect::MarkSlot);
    BoxDrawer::draw(first_marking_, static_cast<std::uint32_t>(boxes_.size()) - first_marking_);
    ++counters.query_draw_calls;
    box_pass_->decide(draws_, slots_);
}

void OcclusionTests::command_late(const ObjectDrawer& objects) {
    draws_.clear();
    collect_draws(objects);
    if (draws_.empty()) return;
    box_pass_->remake(draws_);
    box_pass_->bind_commands();
}

void OcclusionTests::look(const FramePlan& plan) {
    const std::size_t before = early_.size();
    pool_.poll(early_);
    if (box_pass_) box_pass_->poll(early_);
    if (early_.size() == before) return;
    by_ticket_.resize(plan.queries.size());
    std::iota(by_ticket_.begin(), by_ticket_.end(), 0u);
    const auto ticket_of = [&](std::uint32_t query) { return plan.queries[query].ticket; };
    if (!std::ranges::is_sorted(by_ticket_, {}, ticket_of)) std::ranges::sort(by_ticket_, {}, ticket_of);
    for (std::size_t i = before; i < early_.size(); ++i) {
        const auto found = std::ranges::lower_bound(by_ticket_, early_[i].ticket, {}, ticket_of);
        if (found != by_ticket_.end() && ticket_of(*found) == early_[i].ticket)
            fates_[*found].hidden = !early_[i].visible;
    }
}

void OcclusionTests::bind_commands() const {
    if (box_pass_) box_pass_->bind_commands();
}

void OcclusionTests::poll(std::vector<QueryAnswer>& answers) {
    answers.insert(answers.end(), early_.begin(), early_.end());
    early_.clear();
    pool_.poll(answers);
    if (box_pass_) box_pass_->poll(answers);
}

void OcclusionTests::wait(std::vector<QueryAnswer>& answers) {
    answers.insert(answers.end(), early_.begin(), early_.end());
    early_.clear();
    pool_.wait(answers);
    if (box_pass_) box_pass_->wait(answers);
}

AnswerCounters OcclusionTests::counters() const {
    AnswerCounters sum = pool_.counters();
    if (!box_pass_) return sum;
    const AnswerCounters& passed = box_pass_->counters();
    sum.asked += passed.asked;
    sum.answered += passed.answered;
    sum.lost += passed.lost;
    sum.blocking_reads += passed.blocking_reads;
    return sum;
}

}  // namespace rhview::gl
