// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "view.h"

#include <algorithm>
#include <cstring>

#include "rhview/base/rounding.h"

namespace rhview::capi {
namespace {

std::uint32_t number_of(ObjectId object) {
    return static_cast<std::uint32_t>(object);
}

rhview_draw draw_of(const DrawRange& range) {
    return {static_cast<std::uint32_t>(range.batch), range.first_index, range.index_count};
}

rhview_box box_of(const Aabb& box) {
    return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

/// `made(element)` of each, in their order.
template <class From, class To, class Make>
void convert(const std::vector<From>& from, std::vector<To>& to, Make made) {
    to.clear();
    to.reserve(from.size());
    for (const From& element : from) to.push_back(made(element));
}

void number(std::span<const ObjectId> objects, std::vector<std::uint32_t>& numbers) {
    numbers.clear();
    for (const ObjectId object : objects) numbers.push_back(number_of(object));
}

}  // namespace

View::View(std::shared_ptr<Scene> scene, const KnownCosts& costs,
           const std::optional<OcclusionOptions>& occlusion, VisibilityReportSettings report)
    : scene_(std::move(scene)),
      object_indices_(scene_->object_indices),
      planner_(scene_->octree, costs.draw, with_indices(occlusion, object_indices_)),
      report_(std::move(report)),
      missed_(scene_->max_objects()) {
    // What is drawn of an object is in the frustum.
    level_costs_.index_ns = std::max(costs.draw.index_ns, costs.shown_index_ns);
    level_costs_.draw_ns = costs.draw.draw_ns;
    if (scene_->chains) levels_.emplace(*scene_->chains, scene_->levelled);
    scene_->views.push_back(this);
}

View::~View() {
    std::erase(scene_->views, this);
}

std::optional<OcclusionOptions> View::with_indices(std::optional<OcclusionOptions> occlusion,
                                                   std::span<const std::uint32_t> object_indices) {
    if (occlusion) occlusion->object_indices = object_indices;
    return occlusion;
}

void View::set_levelled(ObjectId object, const LevelledObject& levelled) {
    if (levels_) levels_->set_object(object, levelled);
}

void View::set_camera(const rhview::View& camera, glm::ivec2 viewport_pixels) {
    input_.culling_view = camera;
    input_.viewport_pixels = viewport_pixels;
    has_camera_ = true;
}

void View::absorb(std::span<const QueryAnswer> given) {
    planner_.absorb(given);
    report_.absorb(given);
}

ViewToPlan View::prepare() {
    input_.scene_origin = scene_->origin;
    scene_->objects.describe(input_);
    find_new_objects();
    count_object_indices();
    return {this, &input_, &plan_};
}

void View::find_new_objects() {
    new_objects_.assign(input_.new_objects.begin(), input_.new_objects.end());
    for (std::uint32_t i = 0; i < missed_.size(); ++i)
        if (missed_[i] != 0) new_objects_.push_back(ObjectId{i});
    input_.new_objects = new_objects_;
}

/// What drawing each object would take, if its level were that of the last plan.
void View::count_object_indices() {
    const std::vector<std::uint32_t>& whole = scene_->object_indices;
    std::ranges::copy(whole, object_indices_.begin());
    if (!levels_ || !level_options_) return;
    for (std::uint32_t i = 0; i < whole.size(); ++i)
        object_indices_[i] = levels_->indices(ObjectId{i}, whole[i]);
}

void View::plan(const FrameInput& input, FramePlan& plan) {
    planner_.plan(input, plan);
    level_summary_ = {};
    if (levels_ && level_options_) level_summary_ = levels_->choose(input, *level_options_, plan);
    report_.update(input, plan);
    export_plan();
    std::ranges::fill(missed_, std::uint8_t{0});
    planned_view_ = input.culling_view;
    planned_pixels_ = input.viewport_pixels;
    has_plan_ = is_planned_ = true;
}

const FramePlan* View::end_frame(std::span<const ObjectId> new_objects) {
    if (std::exchange(is_planned_, false)) return &plan_;
    for (const ObjectId object : new_objects) missed_[index_of(object)] = 1;
    return nullptr;
}

void View::export_plan() {
    convert(plan_.opaque, draws_, draw_of);
    objects_.clear();
    for (std::size_t i = 0; i < plan_.objects.size(); ++i)
        objects_.push_back({number_of(plan_.objects[i]), plan_.level_of_object(i)});
    convert(plan_.queries, queries_, [](const PlannedQuery& query) {
        return rhview_query{query.ticket, query.first_box, query.box_count,
                            query.way == QueryWay::BoxPass ? std::uint32_t{RHVIEW_BOX_PASS}
                                                           : std::uint32_t{RHVIEW_HARDWARE_QUERY},
                            0};
    });
    convert(plan_.query_boxes, boxes_, box_of);
    convert(plan_.conditional, conditional_draws_, [](const ConditionalRange& conditional) {
        return rhview_conditional_draw{draw_of(conditional.range), conditional.query};
    });
    convert(plan_.conditional_objects, conditional_objects_, [](const ConditionalObject& conditional) {
        return rhview_conditional_object{number_of(conditional.object), conditional.level, conditional.query};
    });
    number(report_.became_visible(), became_visible_);
    number(report_.became_hidden(), became_hidden_);
}

rhview_plan View::exported_plan() const {
    rhview_plan plan{};
    plan.draws = draws_.data();
    plan.draw_count = draws_.size();
    plan.objects = objects_.data();
    plan.object_count = objects_.size();
    plan.queries = queries_.data();
    plan.query_count = queries_.size();
    plan.boxes = boxes_.data();
    plan.box_count = boxes_.size();
    plan.conditional_draws = conditional_draws_.data();
    plan.conditional_draw_count = conditional_draws_.size();
    plan.conditional_objects = conditional_objects_.data();
    plan.conditional_object_count = conditional_objects_.size();
    plan.predicted_ns = plan_.predicted_ns.value_or(0.0);
    plan.hash = plan_hash(plan_);
    plan.nodes_visited = plan_.nodes_visited;
    plan.level_error_px = level_summary_.max_error_px;
    plan.level_ns = level_summary_.cost_ns;
    plan.level_indices = level_summary_.indices;
    plan.misses_bound = level_summary_.bound_met ? 0 : 1;
    plan.misses_budget = level_summary_.budget_met ? 0 : 1;
    return plan;
}

std::span<const rhview_wide_box> View::widen_boxes(const RasterPrecision& raster, double growth,
                                                   rhview_box_lens& lens) {
    static_assert(sizeof(rhview_wide_box) == sizeof(BoxInstance));
    RasterPrecision precision = raster;
    precision.width = planned_pixels_.x;
    precision.height = planned_pixels_.y;
    const BoxWidener widener(planned_view_, scene_->origin, precision, growth);
    const SplitPosition eye = split_position(planned_view_.eye() - scene_->origin);
    for (int i = 0; i < 16; ++i) lens.clip_from_relative[i] = widener.clip_from_relative()[i / 4][i % 4];
    for (int i = 0; i < 3; ++i) lens.eye_high[i] = eye.high[i], lens.eye_low[i] = eye.low[i];
    for (int i = 0; i < 4; ++i) lens.depth_error[i] = widener.depth_error()[i];
    lens.nearer = widener.nearer();
    lens.nearest = widener.nearest();
    wide_boxes_.resize(plan_.query_boxes.size());
    for (std::uint32_t q = 0; q < plan_.queries.size(); ++q)
        for (std::uint32_t b = 0; b < plan_.queries[q].box_count; ++b) {
            const std::uint32_t box = plan_.queries[q].first_box + b;
            const BoxInstance wide = widener.widen(plan_.query_boxes[box], q);
            std::memcpy(&wide_boxes_[box], &wide, sizeof wide);
        }
    return wide_boxes_;
}

rhview_changes View::exported_changes() const {
    rhview_changes changes{};
    changes.became_visible = became_visible_.data();
    changes.became_visible_count = became_visible_.size();
    changes.became_hidden = became_hidden_.data();
    changes.became_hidden_count = became_hidden_.size();
    return changes;
}

}  // namespace rhview::capi
