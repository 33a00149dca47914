// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <limits>

#include "border.h"
#include "view.h"

namespace rhview::capi {
namespace {

constexpr std::uint32_t kMostPixels = 65'536;
constexpr std::uint32_t kMostBands = 65'534;
constexpr std::uint32_t kMostSubpixelBits = 16;
constexpr double kUsualGrowth = 3.0;  ///< of rotations and scales: `rounding_growth`

rhview_status occlusion_of(const rhview_view_options& options, const KnownCosts& costs,
                           std::optional<OcclusionOptions>& occlusion) {
    if (options.occlusion == RHVIEW_OCCLUSION_OFF) return RHVIEW_OK;
    if (options.occlusion > RHVIEW_OCCLUSION_LATENT)
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_options: there is no such occlusion");
    if (!costs.queries)
        return fail(RHVIEW_INVALID_ARGUMENT,
                    "rhview_view_options: occlusion needs costs with has_hardware_queries or has_box_pass");
    occlusion.emplace();
    occlusion->settings.mode =
        options.occlusion == RHVIEW_OCCLUSION_LATENT ? OcclusionMode::Latent : OcclusionMode::Exact;
    occlusion->costs = *costs.queries;
    occlusion->shown_index_ns = costs.shown_index_ns;
    return RHVIEW_OK;
}

rhview_status report_of(const rhview_view_options& options, VisibilityReportSettings& report) {
    if (options.band_count > kMostBands || (options.band_count > 0 && options.band_ends == nullptr))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_options: too many bands, or band_ends is null");
    if (!(options.band_hysteresis >= 0.0 && options.band_hysteresis <= 1.0))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_options: band_hysteresis is 0 to 1");
    report.band_ends.assign(options.band_ends, options.band_ends + options.band_count);
    const auto is_wrong = [](double end) { return std::isnan(end); };
    if (std::ranges::any_of(report.band_ends, is_wrong) || !std::ranges::is_sorted(report.band_ends))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_options: band_ends do not rise");
    report.band_hysteresis = options.band_hysteresis;
    return RHVIEW_OK;
}

rhview_status create(rhview_scene& scene, const rhview_view_options* given, rhview_view** view) {
    rhview_view_options options;
    if (const rhview_status status = take(given, "rhview_view_options", options); status != RHVIEW_OK)
        return status;
    KnownCosts costs;
    if (const rhview_status status = take_costs(options.costs, costs); status != RHVIEW_OK) return status;
    std::optional<OcclusionOptions> occlusion;
    if (const rhview_status status = occlusion_of(options, costs, occlusion); status != RHVIEW_OK)
        return status;
    VisibilityReportSettings report;
    if (const rhview_status status = report_of(options, report); status != RHVIEW_OK) return status;
    *view = new rhview_view{View(scene.state, costs, occlusion, std::move(report))};
    return RHVIEW_OK;
}

rhview_status set_levels(View& view, const rhview_level_bounds& bounds) {
    for (const double value : {bounds.max_error_px, bounds.budget_ns, bounds.object_ns})
        if (!(std::isfinite(value) && value >= 0.0))
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_level_bounds: a bound is negative or no number");
    LevelOptions options;
    options.max_error_px = bounds.max_error_px;
    if (bounds.budget_ns > 0.0) options.budget_ns = bounds.budget_ns;
    options.costs = view.level_costs();
    options.costs.object_ns = bounds.object_ns;
    view.set_levels(options);
    return RHVIEW_OK;
}

rhview_status take_raster(const rhview_raster* given, RasterPrecision& precision, double& growth) {
    rhview_raster raster;
    if (const rhview_status status = take(given, "rhview_raster", raster); status != RHVIEW_OK) return status;
    if (raster.subpixel_bits > kMostSubpixelBits)
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_raster: subpixel_bits is 1 to 16, or 0 for 8");
    if (!(raster.depth_step >= 0.0 && raster.depth_step <= 1.0))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_raster: depth_step is 0 to 1");
    growth = raster.rounding_growth == 0.0 ? kUsualGrowth : raster.rounding_growth;
    if (!(growth >= 1.0 && std::isfinite(growth)))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_raster: rounding_growth is at least 1, or 0 for 3");
    if (raster.subpixel_bits != 0) precision.subpixel_bits = static_cast<int>(raster.subpixel_bits);
    precision.depth_step = raster.depth_step;
    return RHVIEW_OK;
}

glm::dmat4 matrix_of(const double (&columns)[16]) {
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = columns[i];
    return matrix;
}

rhview_status set_camera(rhview_view& view, const rhview_camera& camera) {
    if (camera.clip_depth > RHVIEW_DEPTH_REVERSED)
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_camera: there is no such clip_depth");
    if (camera.viewport_width < 1 || camera.viewport_width > kMostPixels || camera.viewport_height < 1 ||
        camera.viewport_height > kMostPixels)
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_camera: the viewport has 1 to 65,536 pixels each way");
    const rhview::View given{matrix_of(camera.camera_from_world), matrix_of(camera.clip_from_camera),
                             static_cast<ClipDepth>(camera.clip_depth)};
    if (const Status valid = validate(given); !valid) return fail(RHVIEW_INVALID_DATA, valid.error().message);
    view.state.set_camera(
        given, {static_cast<int>(camera.viewport_width), static_cast<int>(camera.viewport_height)});
    return RHVIEW_OK;
}

rhview_status find_wrong(rhview_view* const* views, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        if (views[i] == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_plan_views: a view is null");
        if (&views[i]->state.scene() != &views[0]->state.scene())
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_plan_views: the views are of several scenes");
        if (!views[i]->state.has_camera())
            return fail(RHVIEW_WRONG_STATE, "rhview_plan_views: a view has no camera yet");
        for (std::size_t other = 0; other < i; ++other)
            if (views[other] == views[i])
                return fail(RHVIEW_INVALID_ARGUMENT, "rhview_plan_views: a view is there twice");
    }
    return RHVIEW_OK;
}

}  // namespace
}  // namespace rhview::capi

using namespace rhview::capi;

rhview_status rhview_view_create(rhview_scene* scene, const rhview_view_options* options,
                                 rhview_view** view) {
    return guarded([&] {
        if (scene == nullptr || view == nullptr)
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_create: scene or view is null");
        if (!scene->state->is_built) return fail(RHVIEW_WRONG_STATE, "the scene is not built yet");
        return create(*scene, options, view);
    });
}

void rhview_view_destroy(rhview_view* view) {
    delete view;
}

rhview_status rhview_view_set_camera(rhview_view* view, const rhview_camera* camera) {
    return guarded([&] {
        if (view == nullptr || camera == nullptr)
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_set_camera: view or camera is null");
        rhview_camera taken;
        if (const rhview_status status = take(camera, "rhview_camera", taken); status != RHVIEW_OK)
            return status;
        return set_camera(*view, taken);
    });
}

rhview_status rhview_view_set_levels(rhview_view* view, const rhview_level_bounds* bounds) {
    return guarded([&] {
        if (view == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_set_levels: view is null");
        if (bounds == nullptr) return view->state.set_levels(std::nullopt), rhview_status{RHVIEW_OK};
        rhview_level_bounds taken;
        if (const rhview_status status = take(bounds, "rhview_level_bounds", taken); status != RHVIEW_OK)
            return status;
        return set_levels(view->state, taken);
    });
}

rhview_status rhview_plan_views(rhview_view* const* views, size_t count, const rhview_workers* workers) {
    return guarded([&] {
        if (count == 0) return rhview_status{RHVIEW_OK};
        if (views == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_plan_views: views is null");
        if (const rhview_status status = find_wrong(views, count); status != RHVIEW_OK) return status;
        rhview::Workers threads;
        if (const rhview_status status = take_workers(workers, threads); status != RHVIEW_OK) return status;
        std::vector<rhview::ViewToPlan>& to_plan = views[0]->state.to_plan;
        to_plan.clear();
        for (std::size_t i = 0; i < count; ++i) to_plan.push_back(views[i]->state.prepare());
        rhview::plan_views(to_plan, threads);
        return rhview_status{RHVIEW_OK};
    });
}

rhview_status rhview_view_plan(const rhview_view* view, rhview_plan* plan) {
    if (view == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_plan: view is null");
    if (!view->state.has_plan()) return fail(RHVIEW_WRONG_STATE, "the view was not planned yet");
    return give(view->state.exported_plan(), "rhview_plan", plan);
}

rhview_status rhview_view_widen_boxes(rhview_view* view, const rhview_raster* raster, rhview_box_lens* lens,
                                      const rhview_wide_box** boxes, size_t* count) {
    return guarded([&] {
        if (view == nullptr || lens == nullptr || boxes == nullptr || count == nullptr)
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_widen_boxes: an argument is null");
        if (!view->state.has_plan()) return fail(RHVIEW_WRONG_STATE, "the view was not planned yet");
        rhview::RasterPrecision precision;
        double growth = 1.0;
        if (const rhview_status status = take_raster(raster, precision, growth); status != RHVIEW_OK)
            return status;
        rhview_box_lens full{};
        const auto wide = view->state.widen_boxes(precision, growth, full);
        if (const rhview_status status = give(full, "rhview_box_lens", lens); status != RHVIEW_OK)
            return status;
        *boxes = wide.data();
        *count = wide.size();
        return rhview_status{RHVIEW_OK};
    });
}

rhview_status rhview_view_absorb(rhview_view* view, const rhview_answer* answers, size_t count) {
    return guarded([&] {
        if (view == nullptr || (answers == nullptr && count > 0))
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_absorb: view or answers is null");
        std::vector<rhview::QueryAnswer>& taken = view->state.answers;
        taken.clear();
        for (std::size_t i = 0; i < count; ++i)
            taken.push_back({answers[i].ticket, answers[i].is_visible != 0, 0});
        view->state.absorb(taken);
        return rhview_status{RHVIEW_OK};
    });
}

rhview_status rhview_view_changes(const rhview_view* view, rhview_changes* changes) {
    if (view == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_changes: view is null");
    return give(view->state.exported_changes(), "rhview_changes", changes);
}

rhview_status rhview_view_object_state(const rhview_view* view, uint32_t number, rhview_object_state* state) {
    if (view == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_view_object_state: view is null");
    const rhview::ObjectSighting sighting = view->state.report().sighting(rhview::ObjectId{number});
    static_assert(rhview::ObjectSighting::kNever == RHVIEW_NEVER);
    rhview_object_state full{};
    full.last_seen_frame = sighting.last_seen_frame;
    full.is_visible = sighting.visible ? 1 : 0;
    full.level = sighting.level;
    full.band = sighting.band;
    return give(full, "rhview_object_state", state);
}
