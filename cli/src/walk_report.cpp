// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "walk_columns.h"

namespace rhview::cli {
namespace {

std::string reveal_frames_line(const WalkReport& report) {
    if (!report.reveal_frames) return "";
    if (report.reveal_frames->empty()) return "  nothing that is seen was left out\n";
    const Statistics s = summarise(*report.reveal_frames);
    return fmt::format(
        "  left out though seen: {} times a leaf or object, for {:.0f} frame{} in the median, {:.0f} at p95, "
        "{:.0f} at most\n",
        report.reveal_frames->size(), s.median, s.median == 1.0 ? "" : "s", s.p95, s.max);
}

std::string table_row(const char* name, int decimals, const std::vector<double>& values) {
    const Statistics s = summarise(values);
    return fmt::format("  {:<18}{:>14.{}f}{:>14.{}f}{:>14.{}f}{:>14.{}f}\n", name, s.mean, decimals, s.median,
                       decimals, s.p95, decimals, s.max, decimals);
}

std::string image_error_line(const WalkReport& report) {
    const std::optional<ImageErrorSummary> error = report.image_error();
    if (!error) return "";
    const std::string ssim =
        error->ssim ? fmt::format("SSIM {:.5f} (least {:.5f}), ", error->ssim->mean, error->least_ssim) : "";
    return fmt::format("  image error in {} frame{}: {}PSNR {:.1f} dB, depth {:.4f} % of the distance\n",
                       error->frames, error->frames == 1 ? "" : "s", ssim, gl::psnr_db(error->colour_mse),
                       100.0 * error->depth.mean);
}

std::string timing_line(const WalkReport& report) {
    if (report.in_steps) return "  no prediction: the model has no price for waiting\n";
    if (!report.profile) return fmt::format("  no prediction: {}\n", report.why_no_profile);
    const TimingProfile& constants = report.profile->constants;
    const Statistics error = prediction_errors(report, kPredicted);
    return fmt::format(
        "  prediction off by {:.1f} % in the median, {:.1f} % at p95; {:.3g} ns an index, {:.4g} ns a call,\n"
        "  constants {}\n",
        100.0 * error.median, 100.0 * error.p95, constants.c1_ns,
        constants.c3_ns + constants.sub_draw_ns.value_or(0.0), report.profile->told);
}

std::string lod_line(const WalkReport& report) {
    if (!report.lod.budget_ms) return "";
    return fmt::format("  budget {} ms: the model says that {} of {} frames can hold it; {} of those did\n",
                       *report.lod.budget_ms, report.frames_within_reach(), report.frames.size(),
                       report.frames_within_budget());
}

std::string method_line(const WalkReport& report) {
    if (report.in_steps) return report.method;
    if (!report.has_occlusion()) return report.method + (report.occlusion == "off" ? " without queries" : "");
    std::string line = report.method;
    if (report.mode != "exact") line += ", " + report.mode;
    if (report.occlusion != "auto") line += ", by " + report.occlusion + " alone";
    return line;
}

}  // namespace

bool WalkReport::has_occlusion() const {
    return !frames.empty() && frames.front().occlusion.has_value();
}

int WalkReport::checked_frames() const {
    return static_cast<int>(
        std::ranges::count_if(frames, [](const FrameRecord& f) { return f.missing_pixels.has_value(); }));
}

int WalkReport::frames_within_reach() const {
    return static_cast<int>(
        std::ranges::count_if(frames, [](const FrameRecord& f) { return f.budget && f.budget->can_be_met; }));
}

int WalkReport::frames_within_budget() const {
    return static_cast<int>(std::ranges::count_if(frames, [&](const FrameRecord& f) {
        return f.budget && f.budget->can_be_met && f.frame_ms <= lod.budget_ms.value_or(0.0);
    }));
}

std::uint64_t WalkReport::missing_pixels() const {
    std::uint64_t total = 0;
    for (const FrameRecord& frame : frames) total += frame.missing_pixels.value_or(0);
    return total;
}

double modelled_indices(const FrameRecord& frame) {
    constexpr double kIndicesPerDraw = 8000.0;
    return frame.work.indices + kIndicesPerDraw * frame.work.draw_calls;
}

std::optional<ImageErrorSummary> WalkReport::image_error() const {
    ImageErrorSummary sum;
    std::vector<double> ssim;
    for (const FrameRecord& frame : frames) {
        if (!frame.image_error) continue;
        const gl::ImageDifference& error = *frame.image_error;
        ++sum.frames;
        sum.missing_pixels += error.missing_pixels;
        sum.depth.mean += error.depth.mean;
        sum.depth.greatest = std::max(sum.depth.greatest, error.depth.greatest);
        sum.colour_mse += error.colour_mse;
        if (error.ssim) ssim.push_back(*error.ssim);
    }
    if (sum.frames == 0) return {};
    sum.depth.mean /= sum.frames;
    sum.colour_mse /= sum.frames;
    if (ssim.empty()) return sum;
    sum.ssim = summarise(ssim);
    sum.least_ssim = *std::ranges::min_element(ssim);
    return sum;
}

std::string instancing_text(const InstancingReport& report) {
    if (report.flattened_meshes + report.kept_meshes == 0) return "";
    constexpr double kMebibyte = 1024.0 * 1024.0;
    const auto mebibytes = [](std::uint64_t bytes) { return static_cast<double>(bytes) / kMebibyte; };
    return fmt::format(
        "{} meshes flattened to {} objects of {:.1f} MiB, {} kept for {} of {:.1f} MiB; all flattened: "
        "{:.1f} "
        "MiB\n  by the model, ns a frame: {:.4g}; all kept {:.4g}, all flattened {:.4g}",
        report.flattened_meshes, report.flattened_placements, mebibytes(report.flattened_bytes),
        report.kept_meshes, report.kept_placements, mebibytes(report.kept_bytes),
        mebibytes(report.all_flattened_bytes), report.chosen_ns, report.all_kept_ns, report.all_flattened_ns);
}

std::string to_csv(const WalkReport& report) {
    std::string csv =
        "frame,draw_calls,sub_draws,indices,nodes_visited,cull_ms,frame_ms,gpu_ms,missing_pixels,predicted_"
        "ms,queries,lod_error_px,budget_can_be_met\n";
    for (const FrameRecord& f : report.frames) {
        csv += fmt::format("{},{},{},{},{},{:.4f},{:.4f},{},{},{},{},{:.4f},{}\n", f.frame,
                           count(f.work.draw_calls), count(f.work.sub_draws), count(f.work.indices),
                           f.nodes_visited, f.cull_ms, f.frame_ms,
                           f.gpu_ms ? fmt::format("{:.4f}", *f.gpu_ms) : "",
                           f.missing_pixels ? std::to_string(*f.missing_pixels) : "",
                           f.predicted_ms ? fmt::format("{:.4f}", *f.predicted_ms) : "",
                           count(f.work.queries), f.lod_error_px,
                           !f.budget              ? ""
                           : f.budget->can_be_met ? "1"
                                                  : "0");
    }
    return csv;
}

std::string to_table(const WalkReport& report) {
    std::string table = fmt::format(
        "{}: {:.2f} M triangles, {} material{}{}\n", report.scene.name,
        static_cast<double>(report.scene.static_triangles + report.scene.dynamic_triangles) * 1e-6,
        report.scene.materials, report.scene.materials == 1 ? "" : "s",
        report.scene.dynamic_objects > 0 ? fmt::format(", {} dynamic objects", report.scene.dynamic_objects)
                                         : "");
    if (const std::string line = instancing_text(report.build.instancing); !line.empty())
        table += "instances: " + line + "\n";
    if (report.build.nodes)
        table += fmt::format("{}: {} nodes, {} leaves of at most {} triangles, {} in {:.0f} ms\n",
                             report.build.hierarchy, *report.build.nodes, *report.build.leaves,
                             report.leaf.value_or(0), report.build.load_ms ? "loaded" : "built",
                             report.build.load_ms.value_or(report.build.ms.value_or(0.0)));
    if (report.build.replica_bytes > 0)
        table += fmt::format(
            "replicas: {}, {:.2f} times the source's index bytes\n", report.build.replicas.value_or(0),
            static_cast<double>(report.build.replica_bytes) / static_cast<double>(report.build.index_bytes));
    table += fmt::format("{}: {} frames of {}x{} on {}, timed by the {}\n\n", method_line(report),
                         report.frames.size(), report.width, report.height, report.device.renderer,
                         report.device.timer == "gpu" ? "GPU and the wall clock" : "wall clock");
    table += fmt::format("  {:<18}{:>14}{:>14}{:>14}{:>14}\n", "per frame", "mean", "median", "p95", "max");
    const auto row = [&](const char* name, int decimals, auto field) {
        table += table_row(name, decimals, column(report, field));
    };
    row("draw calls", 1, [](const FrameRecord& f) { return f.work.draw_calls; });
    if (report.submission != "plain")
        row("sub-draws", 1, [](const FrameRecord& f) { return f.work.sub_draws; });
    row("indices", 0, [](const FrameRecord& f) { return f.work.indices; });
    if (!report.frames.empty() && report.frames.front().visible_set_indices)
        row("in seen leaves", 0, [](const FrameRecord& f) { return f.visible_set_indices.value_or(0); });
    if (report.has_occlusion()) {
        const auto of = [&](const char* name, int decimals, auto field) {
            row(name, decimals,
                [&](const FrameRecord& f) { return field(f.occlusion.value_or(OcclusionRecord{}), f); });
        };
        row("queries", 1, [](const FrameRecord& f) { return f.work.queries; });
        of("of them hidden, %", 1,
           [](const OcclusionRecord& o, const FrameRecord& f) { return 100.0 * kHiddenFraction(o, f); });
        if (report.in_steps)
            of("waits", 1, [](const OcclusionRecord& o, const FrameRecord&) { return o.waits; });
    }
    if (report.has_occlusion() && !report.in_steps) {
        const auto of = [&](const char* name, int decimals, auto field) {
            row(name, decimals,
                [&](const FrameRecord& f) { return field(f.occlusion.value_or(OcclusionRecord{}), f); });
        };
        of("ranges skipped", 1, [](const OcclusionRecord& o, const FrameRecord&) {
            return o.conditional_ranges - o.executed_ranges;
        });
        of("indices skipped", 0,
           [](const OcclusionRecord& o, const FrameRecord&) { return o.skipped_indices; });
    }
    row("V + 8000 N", 0, [](const FrameRecord& f) { return modelled_indices(f); });
    row("nodes visited", 0, [](const FrameRecord& f) { return f.nodes_visited; });
    if (report.scene.dynamic_objects > 0)
        row("visible objects", 1, [](const FrameRecord& f) { return f.visible_objects; });
    if (report.lod.levels > 0) row("LoD error, px", 2, [](const FrameRecord& f) { return f.lod_error_px; });
    if (report.scene.static_instances > 0)
        row("instances", 1, [](const FrameRecord& f) { return f.visible_instances; });
    row("cull ms", 3, [](const FrameRecord& f) { return f.cull_ms; });
    row("frame ms", 2, [](const FrameRecord& f) { return f.frame_ms; });
    if (report.profile && !report.in_steps)
        row("predicted ms", 2, [](const FrameRecord& f) { return f.predicted_ms.value_or(0.0); });
    if (!report.frames.empty() && report.frames.front().gpu_ms)
        row("GPU ms", 2, [](const FrameRecord& f) { return f.gpu_ms.value_or(0.0); });
    table +=
        fmt::format("\n  everything: {} draw calls, {} indices; plan hash {:016x}\n",
                    report.scene.batches + report.scene.object_groups,
                    3 * (report.scene.static_triangles + report.scene.dynamic_triangles), report.plan_hash);
    table += timing_line(report);
    table += lod_line(report);
    if (report.has_occlusion())
        table += fmt::format("  occlusion: {} answers waited for, {} lost\n", report.blocking_reads,
                             report.lost_queries);
    else if (!report.why_no_occlusion.empty())
        table += fmt::format("  no occlusion culling: {}\n", report.why_no_occlusion);
    if (const int checked = report.checked_frames(); checked > 0)
        table += fmt::format("  missing pixels: {} in {} checked frame{}\n", report.missing_pixels(), checked,
                             checked == 1 ? "" : "s");
    table += image_error_line(report);
    table += reveal_frames_line(report);
    return table;
}

}  // namespace rhview::cli
