// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "walk_columns.h"
#include "walk_report.h"

namespace rhview::cli {
namespace {

using Json = nlohmann::ordered_json;

template <class Field>
Json statistics(const WalkReport& report, Field field) {
    const Statistics s = summarise(column(report, field));
    return {{"mean", s.mean}, {"median", s.median}, {"p95", s.p95}, {"max", s.max}};
}

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json missing_pixels_json(const WalkReport& report) {
    if (report.checked_frames() == 0) return nullptr;
    std::uint64_t max = 0;
    int frames = 0;
    for (const FrameRecord& frame : report.frames) {
        max = std::max(max, frame.missing_pixels.value_or(0));
        frames += frame.missing_pixels.value_or(0) > 0;
    }
    return {{"total", report.missing_pixels()},
            {"max", max},
            {"frames", frames},
            {"checked_frames", report.checked_frames()}};
}

/// Absent where both pictures are equal: JSON has no word for infinite.
Json psnr_json(double colour_mse) {
    return colour_mse > 0.0 ? Json(gl::psnr_db(colour_mse)) : Json(nullptr);
}

Json image_error_json(const std::optional<gl::ImageDifference>& error) {
    if (!error) return nullptr;
    return {{"missing_pixels", error->missing_pixels}, {"depth_mean", error->depth.mean},
            {"depth_max", error->depth.greatest},      {"colour_mse", error->colour_mse},
            {"psnr_db", psnr_json(error->colour_mse)}, {"ssim", or_null(error->ssim)}};
}

Json image_error_json(const std::optional<ImageErrorSummary>& error) {
    if (!error) return nullptr;
    const bool has_ssim = error->ssim.has_value();
    return {{"frames", error->frames},
            {"missing_pixels", error->missing_pixels},
            {"depth_mean", error->depth.mean},
            {"depth_max", error->depth.greatest},
            {"colour_mse", error->colour_mse},
            {"psnr_db", psnr_json(error->colour_mse)},
            {"ssim", has_ssim ? Json(error->ssim->mean) : Json(nullptr)},
            {"ssim_min", has_ssim ? Json(error->least_ssim) : Json(nullptr)}};
}

Json reveal_frames_json(const WalkReport& report) {
    if (!report.reveal_frames) return nullptr;
    if (report.reveal_frames->empty()) return {{"items", 0}};
    const Statistics s = summarise(*report.reveal_frames);
    return {{"items", report.reveal_frames->size()},
            {"mean", s.mean},
            {"median", s.median},
            {"p95", s.p95},
            {"max", s.max}};
}

constexpr auto kRunningPredicted = [](const FrameRecord& f) { return f.running_predicted_ms; };

template <class Field>
Json prediction_error_json(const WalkReport& report, Field predicted_ms) {
    if (!report.profile || report.in_steps) return nullptr;
    const Statistics s = prediction_errors(report, predicted_ms);
    return {{"median", s.median}, {"p95", s.p95}};
}

Json profile_json(const std::optional<WalkReport::Profile>& profile) {
    Json json;
    for (const Term term : kAllTerms) {
        const std::optional<double> value =
            profile ? profile->constants.constant(term) : std::optional<double>();
        json[std::string(profile_field_of(term))] = or_null(value);
    }
    json["combination"] = nullptr;
    json["hold_out_error"] = nullptr;
    json["source"] = nullptr;
    if (!profile) return json;
    json["combination"] = profile->constants.combination == Combination::Sum ? "sum" : "max";
    json["hold_out_error"] = or_null(profile->constants.hold_out_error);
    json["source"] = profile->source;
    return json;
}

/// Statistics of a field of the occlusion records; null where there are none.
template <class Field>
Json occlusion_statistics(const WalkReport& report, Field field) {
    if (!report.has_occlusion()) return nullptr;
    return statistics(
        report, [&](const FrameRecord& f) { return field(f.occlusion.value_or(OcclusionRecord{}), f); });
}

constexpr auto kExplorationShare = [](const OcclusionRecord& o, const FrameRecord& f) {
    return share(o.exploration_ms, f.predicted_ms.value_or(0.0));
};

void add_occlusion(const WalkReport& report, Json& summary) {
    const auto add = [&](const char* name, auto field) {
        summary[name] = occlusion_statistics(report, field);
    };
    add("query_boxes", [](const OcclusionRecord& o, const FrameRecord&) { return o.boxes; });
    add("hidden_fraction", kHiddenFraction);
    add("waits", [](const OcclusionRecord& o, const FrameRecord&) { return o.waits; });
    // What is drawn and asked in turns hangs on no query, and no model decided about it.
    const auto add_planned = [&](const char* name, auto field) {
        report.in_steps ? void(summary[name] = nullptr) : add(name, field);
    };
    add_planned("box_pass_queries",
                [](const OcclusionRecord& o, const FrameRecord&) { return o.box_pass_queries; });
    add_planned("conditional_draws",
                [](const OcclusionRecord& o, const FrameRecord&) { return o.conditional_draws; });
    add_planned("conditional_ranges",
                [](const OcclusionRecord& o, const FrameRecord&) { return o.conditional_ranges; });
    add_planned("executed_ranges",
                [](const OcclusionRecord& o, const FrameRecord&) { return o.executed_ranges; });
    add_planned("skipped_indices",
                [](const OcclusionRecord& o, const FrameRecord&) { return o.skipped_indices; });
    add_planned("exploration_share", kExplorationShare);
    add_planned("query_predicted_ms",
                [](const OcclusionRecord& o, const FrameRecord&) { return o.query_ms; });
    add_planned("saved_predicted_ms",
                [](const OcclusionRecord& o, const FrameRecord&) { return o.saved_ms; });
    summary["blocking_reads"] = report.has_occlusion() ? Json(report.blocking_reads) : Json(nullptr);
    summary["lost_queries"] = report.has_occlusion() ? Json(report.lost_queries) : Json(nullptr);
}

Json instancing_json(const WalkReport& report) {
    const InstancingReport& r = report.build.instancing;
    return {{"flattened_meshes", r.flattened_meshes},
            {"flattened_placements", r.flattened_placements},
            {"flattened_bytes", r.flattened_bytes},
            {"kept_meshes", r.kept_meshes},
            {"kept_placements", r.kept_placements},
            {"kept_bytes", r.kept_bytes},
            {"all_flattened_bytes", r.all_flattened_bytes},
            {"budget_bytes", r.budget_bytes},
            {"all_kept_ns", r.all_kept_ns},
            {"all_flattened_ns", r.all_flattened_ns},
            {"chosen_ns", r.chosen_ns},
            {"ms", or_null(report.build.settle_ms)}};
}

Json answer_costs_json(const std::optional<QueryCosts>& costs) {
    if (!costs) return nullptr;
    // What is never asked has an infinite price, which JSON has no word for.
    const auto number = [](double ns) { return std::isfinite(ns) ? Json(ns) : Json(nullptr); };
    const auto way = [&](const AnswerCosts& c) {
        return Json{{"frame_ns", number(c.frame_ns)},
                    {"query_ns", number(c.query_ns)},
                    {"box_ns", number(c.box_ns)},
                    {"pixel_ns", number(c.pixel_ns)},
                    {"draw_ns", number(c.draw_ns)}};
    };
    return {{"hardware_query", way(costs->hardware)}, {"box_pass", way(costs->box_pass)}};
}

Json budget_json(const WalkReport& report) {
    if (!report.lod.budget_ms) return nullptr;
    return {{"can_be_met_frames", report.frames_within_reach()},
            {"met_of_those", report.frames_within_budget()}};
}

Json frame_budget_json(const std::optional<BudgetRecord>& budget) {
    if (!budget) return nullptr;
    return {{"predicted_ms", budget->predicted_ms},
            {"margin", budget->margin},
            {"can_be_met", budget->can_be_met}};
}

Json summary_json(const WalkReport& report) {
    const bool has_gpu = !report.frames.empty() && report.frames.front().gpu_ms.has_value();
    const bool has_objects = report.scene.dynamic_objects > 0;
    const bool has_instances = report.scene.static_instances > 0;
    Json summary;
    summary["draw_calls"] = statistics(report, [](const FrameRecord& f) { return f.work.draw_calls; });
    summary["sub_draws"] = statistics(report, [](const FrameRecord& f) { return f.work.sub_draws; });
    summary["indices"] = statistics(report, [](const FrameRecord& f) { return f.work.indices; });
    summary["modelled_indices"] =
        statistics(report, [](const FrameRecord& f) { return modelled_indices(f); });
    summary["queries"] = statistics(report, [](const FrameRecord& f) { return f.work.queries; });
    add_occlusion(report, summary);
    const bool has_set = !report.frames.empty() && report.frames.front().visible_set_indices.has_value();
    summary["visible_set_indices"] =
        has_set ? statistics(report, [](const FrameRecord& f) { return f.visible_set_indices.value_or(0); })
                : Json(nullptr);
    summary["nodes_visited"] = statistics(report, [](const FrameRecord& f) { return f.nodes_visited; });
    summary["cull_ms"] = statistics(report, [](const FrameRecord& f) { return f.cull_ms; });
    summary["frame_ms"] = statistics(report, [](const FrameRecord& f) { return f.frame_ms; });
    summary["gpu_ms"] = has_gpu
                            ? statistics(report, [](const FrameRecord& f) { return f.gpu_ms.value_or(0.0); })
                            : Json(nullptr);
    const bool predicted = report.profile.has_value() && !report.in_steps;
    summary["predicted_ms"] =
        predicted ? statistics(report, [](const FrameRecord& f) { return f.predicted_ms.value_or(0.0); })
                  : Json(nullptr);
    summary["prediction_error"] = prediction_error_json(report, kPredicted);
    summary["running_prediction_error"] = prediction_error_json(report, kRunningPredicted);
    summary["visible_objects"] =
        has_objects ? statistics(report, [](const FrameRecord& f) { return f.visible_objects; })
                    : Json(nullptr);
    summary["visible_instances"] =
        has_instances ? statistics(report, [](const FrameRecord& f) { return f.visible_instances; })
                      : Json(nullptr);
    const bool has_any = has_objects || has_instances;
    summary["object_draw_calls"] =
        has_any ? statistics(report, [](const FrameRecord& f) { return f.object_draws; }) : Json(nullptr);
    summary["visible_mesh_levels"] =
        has_any ? statistics(report, [](const FrameRecord& f) { return f.mesh_levels; }) : Json(nullptr);
    summary["lod_error_px"] =
        has_objects ? statistics(report, [](const FrameRecord& f) { return f.lod_error_px; }) : Json(nullptr);
    summary["budget"] = budget_json(report);
    summary["missing_pixels"] = missing_pixels_json(report);
    summary["image_error"] = image_error_json(report.image_error());
    summary["reveal_frames"] = reveal_frames_json(report);
    summary["plan_hash"] = fmt::format("{:016x}", report.plan_hash);
    return summary;
}

/// What is drawn and asked in turns hangs on no query, and no model decided about it.
Json occlusion_json(const WalkReport& report, const std::optional<OcclusionRecord>& o) {
    if (!o) return nullptr;
    const auto planned = [&](auto value) { return report.in_steps ? Json(nullptr) : Json(value); };
    return {{"candidates", o->candidates},
            {"waits", o->waits},
            {"boxes", o->boxes},
            {"hidden", o->hidden},
            {"box_pass_queries", planned(o->box_pass_queries)},
            {"conditional_draws", planned(o->conditional_draws)},
            {"conditional_ranges", planned(o->conditional_ranges)},
            {"executed_ranges", planned(o->executed_ranges)},
            {"skipped_indices", planned(o->skipped_indices)},
            {"query_ms", planned(o->query_ms)},
            {"exploration_ms", planned(o->exploration_ms)},
            {"saved_ms", planned(o->saved_ms)}};
}

}  // namespace

std::string to_json(const WalkReport& report) {
    Json json;
    json["schema"] = "rhview.walk/1";
    json["scene"] = {{"name", report.scene.name},
                     {"triangles", report.scene.static_triangles + report.scene.dynamic_triangles},
                     {"static_triangles", report.scene.static_triangles},
                     {"dynamic_objects", report.scene.dynamic_objects},
                     {"dynamic_triangles", report.scene.dynamic_triangles},
                     {"static_instances", report.scene.static_instances},
                     {"instance_triangles", report.scene.instance_triangles},
                     {"materials", report.scene.materials}};
    json["device"] = {{"renderer", report.device.renderer},
                      {"version", report.device.version},
                      {"timer", report.device.timer}};
    json["profile"] = profile_json(report.profile);
    json["profile"]["answer_costs"] = answer_costs_json(report.query_costs);
    json["method"] = report.method;
    json["mode"] = report.mode;
    json["visible_pixels"] = report.visible_pixels;
    json["submission"] = report.submission;
    json["occlusion"] = report.occlusion;
    json["leaf"] = or_null(report.leaf);
    json["frames"] = report.frames.size();
    json["rate_hz"] = or_null(report.rate_hz);
    json["excerpts"] = report.excerpts;
    json["size"] = {report.width, report.height};
    const bool has_tree = !report.build.hierarchy.empty();
    json["build"] = {{"ms", or_null(report.build.ms)},
                     {"hierarchy", has_tree ? Json(report.build.hierarchy) : Json(nullptr)},
                     {"load_ms", or_null(report.build.load_ms)},
                     {"nodes", or_null(report.build.nodes)},
                     {"leaves", or_null(report.build.leaves)},
                     {"replicas", or_null(report.build.replicas)},
                     {"instancing", instancing_json(report)},
                     {"replica_bytes", report.build.replica_bytes},
                     {"index_bytes", report.build.index_bytes},
                     {"vertex_bytes", report.build.vertex_bytes}};
    json["lod"] = {{"error_bound_px", report.lod.error_bound_px},
                   {"policy", report.lod.policy},
                   {"budget_ms", or_null(report.lod.budget_ms)},
                   {"build_ms", or_null(report.lod.build_ms)},
                   {"levels", report.lod.levels},
                   {"index_bytes", report.lod.index_bytes}};
    json["summary"] = summary_json(report);
    const auto counted = [&](double value) { return report.in_steps ? Json(nullptr) : Json(count(value)); };
    const bool has_objects = report.scene.dynamic_objects > 0;
    json["per_frame"] = Json::array();
    for (const FrameRecord& f : report.frames)
        json["per_frame"].push_back({{"frame", f.frame},
                                     {"draw_calls", count(f.work.draw_calls)},
                                     {"sub_draws", count(f.work.sub_draws)},
                                     {"indices", count(f.work.indices)},
                                     {"material_changes", count(f.work.material_changes)},
                                     {"primitives", counted(f.work.primitives)},
                                     {"fragments", counted(f.work.fragments)},
                                     {"passed_samples", counted(f.work.passed_samples)},
                                     {"object_draw_calls", f.object_draws},
                                     {"visible_mesh_levels", f.mesh_levels},
                                     {"queries", count(f.work.queries)},
                                     {"occlusion", occlusion_json(report, f.occlusion)},
                                     {"lod_error_px", has_objects ? Json(f.lod_error_px) : Json(nullptr)},
                                     {"budget", frame_budget_json(f.budget)},
                                     {"nodes_visited", f.nodes_visited},
                                     {"cull_ms", f.cull_ms},
                                     {"frame_ms", f.frame_ms},
                                     {"gpu_ms", or_null(f.gpu_ms)},
                                     {"predicted_ms", or_null(f.predicted_ms)},
                                     {"running_predicted_ms", or_null(f.running_predicted_ms)},
                                     {"visible_set_indices", or_null(f.visible_set_indices)},
                                     {"missing_pixels", or_null(f.missing_pixels)},
                                     {"late_items", or_null(f.late_items)},
                                     {"image_error", image_error_json(f.image_error)}});
    // A file name need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rhview::cli
