// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "pareto.h"
#include "statistics.h"

namespace rhview::cli {
namespace {

using Json = nlohmann::ordered_json;

template <class Field>
std::vector<double> column(const WalkReport& walk, Field field) {
    std::vector<double> values;
    for (const FrameRecord& frame : walk.frames) values.push_back(static_cast<double>(field(frame)));
    return values;
}

constexpr auto kFrameMs = [](const FrameRecord& f) { return f.frame_ms; };
constexpr auto kCullMs = [](const FrameRecord& f) { return f.cull_ms; };
constexpr auto kDraws = [](const FrameRecord& f) { return f.work.draw_calls; };
constexpr auto kIndices = [](const FrameRecord& f) { return f.work.indices; };
constexpr auto kModelled = [](const FrameRecord& f) { return modelled_indices(f); };
constexpr auto kQueries = [](const FrameRecord& f) { return f.work.queries; };

template <class Field>
double median_of(const WalkReport& walk, Field field) {
    return summarise(column(walk, field)).median;
}

Json interval_json(const std::optional<MedianInterval>& interval) {
    if (!interval) return nullptr;
    return {{"median", interval->median}, {"low", interval->low}, {"high", interval->high}};
}

Json comparison_json(const CompareReport& report, std::size_t run) {
    const WalkReport &walk = *report.runs[run].walk, &reference = *report.runs[report.reference].walk;
    const auto ratio = [&](auto field) {
        const double base = median_of(reference, field);
        return base > 0.0 ? Json(median_of(walk, field) / base) : Json(nullptr);
    };
    return {{"label", report.runs[run].label},
            {"frame_ms", interval_json(median_interval(column(walk, kFrameMs)))},
            {"frame_ms_ratio", interval_json(report.time_ratio(run, report.reference))},
            {"cull_ms_ratio", ratio(kCullMs)},
            {"draw_calls_ratio", ratio(kDraws)},
            {"indices_ratio", ratio(kIndices)},
            {"modelled_ratio", ratio(kModelled)},
            {"queries_ratio", ratio(kQueries)}};
}

/// 1 - SSIM; NaN where it was not measured.
double ssim_loss(const WalkReport& walk) {
    const std::optional<ImageErrorSummary> error = walk.image_error();
    return error && error->ssim ? 1.0 - error->ssim->mean : std::numeric_limits<double>::quiet_NaN();
}

template <class Field>
std::vector<std::size_t> front_of(const CompareReport& report, Field field) {
    std::vector<double> costs, errors;
    for (const CompareReport::Run& run : report.runs) {
        costs.push_back(median_of(*run.walk, field));
        errors.push_back(ssim_loss(*run.walk));
    }
    return pareto_front(costs, errors);
}

template <class Field>
Json front_json(const CompareReport& report, Field field) {
    Json labels = Json::array();
    for (const std::size_t run : front_of(report, field)) labels.push_back(report.runs[run].label);
    return labels;
}

Json pareto_json(const CompareReport& report) {
    if (!report.pareto) return nullptr;
    return {{"error", "1 - ssim"},
            {"frame_ms", front_json(report, kFrameMs)},
            {"draw_calls", front_json(report, kDraws)},
            {"indices", front_json(report, kIndices)}};
}

std::string interval_text(const std::optional<MedianInterval>& interval, int decimals) {
    if (!interval) return "-";
    return fmt::format("{:.{}f} – {:.{}f}", interval->low, decimals, interval->high, decimals);
}

/// The text's width on a terminal: an en dash takes three bytes.
std::string padded(const std::string& text, std::size_t width) {
    const auto is_continued = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; };
    const std::size_t shown =
        text.size() - static_cast<std::size_t>(std::ranges::count_if(text, is_continued));
    return std::string(width > shown ? width - shown : 0, ' ') + text;
}

std::string medians_table(const CompareReport& report, std::size_t label_width) {
    std::string table = fmt::format("  {:<{}}{:>10}{:>20}{:>10}{:>12}{:>14}{:>14}{:>10}{:>10}\n", "median",
                                    label_width, "frame ms", "95 % interval", "cull ms", "draw calls",
                                    "indices", "V + 8000 N", "queries", "missing");
    for (const CompareReport::Run& run : report.runs) {
        const WalkReport& walk = *run.walk;
        const bool checked = walk.checked_frames() > 0;
        table += fmt::format("  {:<{}}{:>10.3f}{}{:>10.3f}{:>12.1f}{:>14.0f}{:>14.0f}{:>10.1f}{:>10}\n",
                             run.label, label_width, median_of(walk, kFrameMs),
                             padded(interval_text(median_interval(column(walk, kFrameMs)), 3), 20),
                             median_of(walk, kCullMs), median_of(walk, kDraws), median_of(walk, kIndices),
                             median_of(walk, kModelled), median_of(walk, kQueries),
                             checked ? std::to_string(walk.missing_pixels()) : "-");
    }
    return table;
}

std::string ratios_table(const CompareReport& report, std::size_t label_width) {
    const std::string& reference = report.runs[report.reference].label;
    std::string table =
        fmt::format("  {:<{}}{:>10}{:>20}{:>10}{:>12}{:>14}{:>14}{:>10}\n", "over " + reference, label_width,
                    "frame ms", "95 % interval", "cull ms", "draw calls", "indices", "V + 8000 N", "queries");
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        if (i == report.reference) continue;
        const WalkReport &walk = *report.runs[i].walk, &base = *report.runs[report.reference].walk;
        const auto ratio = [&](auto field) {
            const double of = median_of(base, field);
            return of > 0.0 ? fmt::format("{:.2f}", median_of(walk, field) / of) : std::string("-");
        };
        const std::optional<MedianInterval> time = report.time_ratio(i, report.reference);
        table +=
            fmt::format("  {:<{}}{:>10}{}{:>10}{:>12}{:>14}{:>14}{:>10}\n", report.runs[i].label, label_width,
                        time ? fmt::format("{:.3f}", time->median) : "-", padded(interval_text(time, 3), 20),
                        ratio(kCullMs), ratio(kDraws), ratio(kIndices), ratio(kModelled), ratio(kQueries));
    }
    return table;
}

/// What is given up, and for what; a star where nothing else has less of both.
std::string pareto_table(const CompareReport& report, std::size_t label_width) {
    std::string table =
        fmt::format("  {:<{}}{:>10}{:>12}{:>14}{:>10}{:>10}{:>12}{:>10}\n", "error", label_width, "frame ms",
                    "draw calls", "indices", "SSIM", "PSNR dB", "depth %", "missing %");
    const auto fronts =
        std::array{front_of(report, kFrameMs), front_of(report, kDraws), front_of(report, kIndices)};
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        const WalkReport& walk = *report.runs[i].walk;
        const std::optional<ImageErrorSummary> error = walk.image_error();
        if (!error) continue;
        const auto starred = [&](std::size_t front, const std::string& text) {
            return text + (std::ranges::find(fronts[front], i) != fronts[front].end() ? "*" : " ");
        };
        const double pixels = static_cast<double>(walk.width) * walk.height * error->frames;
        table += fmt::format(
            "  {:<{}}{:>10}{:>12}{:>14}{:>10}{:>10.1f}{:>12.4f}{:>10.4f}\n", report.runs[i].label,
            label_width, starred(0, fmt::format("{:.3f}", median_of(walk, kFrameMs))),
            starred(1, fmt::format("{:.1f}", median_of(walk, kDraws))),
            starred(2, fmt::format("{:.0f}", median_of(walk, kIndices))),
            error->ssim ? fmt::format("{:.5f}", error->ssim->mean) : "-", gl::psnr_db(error->colour_mse),
            100.0 * error->depth.mean, 100.0 * static_cast<double>(error->missing_pixels) / pixels);
    }
    return table + "  * on the front: no other has as little of this and of 1 - SSIM, and less of one\n";
}

std::string verdict(const CompareReport& report) {
    if (const std::optional<std::size_t> winner = report.winner())
        return fmt::format("  fastest: {}; its frame times are below each other method's, beyond the noise\n",
                           report.runs[*winner].label);
    if (!report.time_ratio(0, 0)) return "  fastest: not told; fewer than 6 frames prove nothing\n";
    return "  fastest: not told; the intervals of the best ones overlap\n";
}

}  // namespace

std::optional<MedianInterval> CompareReport::time_ratio(std::size_t run, std::size_t other) const {
    const std::vector<FrameRecord>&a = runs[run].walk->frames, &b = runs[other].walk->frames;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        ratios.push_back(a[i].frame_ms / b[i].frame_ms);
    return median_interval(ratios);
}

std::optional<std::size_t> CompareReport::winner() const {
    for (std::size_t i = 0; i < runs.size() && runs.size() > 1; ++i) {
        bool wins = true;
        for (std::size_t other = 0; other < runs.size() && wins; ++other) {
            if (other == i) continue;
            const std::optional<MedianInterval> ratio = time_ratio(i, other);
            wins = ratio && ratio->high < 1.0;
        }
        if (wins) return i;
    }
    return {};
}

std::uint64_t CompareReport::missing_pixels_in_exact_mode() const {
    std::uint64_t missing = 0;
    for (const Run& run : runs)
        if (run.walk->mode == "exact") missing += run.walk->missing_pixels();
    return missing;
}

std::string to_json(const CompareReport& report) {
    Json json;
    json["schema"] = "rhview.compare/1";
    json["command"] = report.command;
    json["order"] = report.by_frame ? "frame" : "run";
    json["threads"] = std::thread::hardware_concurrency();
    json["reference"] = report.runs[report.reference].label;
    const std::optional<std::size_t> winner = report.winner();
    json["winner"] = winner ? Json(report.runs[*winner].label) : Json(nullptr);
    json["pareto"] = pareto_json(report);
    json["comparison"] = Json::array();
    json["runs"] = Json::array();
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        json["comparison"].push_back(comparison_json(report, i));
        Json walk = Json::parse(to_json(*report.runs[i].walk));
        walk["label"] = report.runs[i].label;
        json["runs"].push_back(std::move(walk));
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_csv(const CompareReport& report) {
    std::string csv;
    for (const CompareReport::Run& run : report.runs) {
        std::istringstream lines(to_csv(*run.walk));
        std::string line;
        for (bool header = true; std::getline(lines, line); header = false) {
            if (!header)
                csv += fmt::format("{},{}\n", run.label, line);
            else if (csv.empty())
                csv = "method," + line + "\n";
        }
    }
    return csv;
}

std::string to_table(const CompareReport& report) {
    const WalkReport& first = *report.runs.front().walk;
    std::size_t width = report.runs[report.reference].label.size() + 7;
    for (const CompareReport::Run& run : report.runs) width = std::max(width, run.label.size() + 2);
    std::string table = fmt::format(
        "{}: {:.2f} M triangles\n{} methods, {}: {} frames of {}x{} on {}, timed by the wall clock\n\n",
        first.scene.name,
        static_cast<double>(first.scene.static_triangles + first.scene.dynamic_triangles) * 1e-6,
        report.runs.size(), report.by_frame ? "taking turns frame by frame" : "one walk after the other",
        first.frames.size(), first.width, first.height, first.device.renderer);
    table += medians_table(report, width) + "\n";
    if (report.pareto) table += pareto_table(report, width) + "\n";
    if (report.runs.size() > 1) table += ratios_table(report, width) + "\n" + verdict(report);
    return table;
}

}  // namespace rhview::cli
