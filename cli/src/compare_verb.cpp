// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "compare_report.h"
#include "method_list.h"
#include "output_file.h"
#include "pareto.h"
#include "report_page.h"
#include "verbs.h"
#include "walk_session.h"

namespace rhview::cli {
namespace {

constexpr const char* kPicture = "scene";  ///< folder of the report's picture

struct Outputs {
    std::optional<OutputFile> json;
    std::optional<OutputFile> csv;
    std::optional<OutputFile> page_json;
    std::filesystem::path script;

    Status open(const CompareOptions& options) {
        const WalkOptions& walk = options.walk;
        if (walk.json && walk.csv && resolved(*walk.json) == resolved(*walk.csv))
            return Error{walk.csv->string() + ": --json and --csv name the same file; name two"};
        if (Status status = open_one(walk.json, json); !status) return status;
        if (Status status = open_one(walk.csv, csv); !status) return status;
        if (!options.report) return success();
        Result<std::filesystem::path> found = find_report_script(options.program);
        if (!found) return found.error();
        script = *found;
        if (Status status = prepare_folder(*options.report); !status) return status;
        if (Status status = prepare_folder(*options.report / kPicture); !status) return status;
        return open_one(*options.report / "compare.json", page_json);
    }

    Status commit(const CompareReport& report, const CompareOptions& options) {
        if (csv)
            if (Status status = csv->commit(to_csv(report)); !status) return status;
        if (!json && !page_json) return success();
        const std::string text = to_json(report);
        if (json)
            if (Status status = json->commit(text); !status) return status;
        if (!page_json) return success();
        if (Status status = page_json->commit(text); !status) return status;
        return make_report_page(script, *options.report);
    }

  private:
    static Status open_one(const std::optional<std::filesystem::path>& file,
                           std::optional<OutputFile>& output) {
        if (!file) return success();
        Result<OutputFile> opened = OutputFile::open(*file);
        if (!opened) return opened.error();
        output.emplace(std::move(opened).value());
        return success();
    }
};

/// What ratios refer to: rhview, else the first method.
std::size_t reference_of(const std::vector<ListedMethod>& methods) {
    const auto found =
        std::ranges::find(methods, "rhview", [](const ListedMethod& method) { return method.walk.method; });
    return found == methods.end() ? 0 : static_cast<std::size_t>(found - methods.begin());
}

std::string method_list(const CompareOptions& options, bool levels) {
    if (!options.pareto) return options.methods.value_or(kDefaultMethods);
    return (options.methods ? *options.methods + "," : "") + pareto_methods(levels);
}

/// The methods, validated; the reference makes the report's picture.
Result<std::vector<ListedMethod>> list_methods(const CompareOptions& options, bool levels) {
    if (options.order != "frame" && options.order != "run")
        return Error{fmt::format("--order {}: unknown; write frame or run", options.order)};
    Result<std::vector<ListedMethod>> methods = parse_methods(method_list(options, levels), options.walk);
    if (!methods) return methods.error();
    for (ListedMethod& method : *methods) {
        if (options.pareto && method.walk.image_error_every == 0) method.walk.image_error_every = 1;
        if (const Result<WalkWishes> wishes = parse_wishes(method.walk); !wishes)
            return Error{fmt::format("--methods {}: {}", method.label, wishes.error().message)};
    }
    if (options.report) {
        WalkOptions& pictured = (*methods)[reference_of(*methods)].walk;
        pictured.images = *options.report / kPicture;
        pictured.images_every = std::max(1, pictured.frames / 3);
    }
    return methods;
}

/// Whose turn it is rotates, so that no method always follows the same one.
Status walk_by_frame(std::vector<WalkSession>& sessions, const WalkOptions& common, Progress& progress) {
    for (int i = 0; i < common.warmup; ++i) {
        progress.show("warm-up", i, common.warmup);
        for (WalkSession& session : sessions) session.warm_up();
    }
    for (int frame = 0; frame < common.frames; ++frame) {
        progress.show("walking", frame, common.frames);
        for (std::size_t turn = 0; turn < sessions.size(); ++turn) {
            const std::size_t i = (turn + static_cast<std::size_t>(frame)) % sessions.size();
            if (Status status = sessions[i].walk(frame); !status) return status;
        }
    }
    return success();
}

Status walk_by_run(std::vector<WalkSession>& sessions, const WalkOptions& common, Progress& progress) {
    const int total = common.frames * static_cast<int>(sessions.size());
    int done = 0;
    for (WalkSession& session : sessions) {
        for (int i = 0; i < common.warmup; ++i) session.warm_up();
        for (int frame = 0; frame < common.frames; ++frame) {
            progress.show("walking", done++, total);
            if (Status status = session.walk(frame); !status) return status;
        }
    }
    return success();
}

CompareReport report_of(const CompareOptions& options, const std::vector<ListedMethod>& methods,
                        const std::vector<WalkSession>& sessions) {
    CompareReport report;
    for (std::size_t i = 0; i < methods.size(); ++i)
        report.runs.push_back({methods[i].label, &sessions[i].report()});
    report.reference = reference_of(methods);
    report.pareto = options.pareto;
    report.by_frame = options.order == "frame";
    report.command = options.command;
    return report;
}

}  // namespace

Result<int> run_compare(const CompareOptions& options) {
    Result<std::vector<ListedMethod>> methods = list_methods(options, false);
    if (!methods) return methods.error();
    Result<WalkWishes> wishes = parse_wishes(methods->front().walk);
    if (!wishes) return wishes.error();
    Outputs outputs;
    if (Status status = outputs.open(options); !status) return status.error();

    Progress progress;
    WalkOptions common = options.walk;
    for (const ListedMethod& method : *methods)
        common.lod_error_px = std::max(common.lod_error_px, method.walk.lod_error_px);
    const Result<WalkGround> ground = prepare_ground(common, std::move(wishes).value(), progress);
    if (!ground) return ground.error();
    if (!ground->chains.empty()) methods = list_methods(options, true);
    if (!methods) return methods.error();
    std::vector<WalkSession> sessions;
    for (const ListedMethod& method : *methods) {
        progress.say("building " + method.label);
        Result<WalkSession> session = WalkSession::create(method.walk, *ground);
        if (!session) return Error{fmt::format("--methods {}: {}", method.label, session.error().message)};
        sessions.push_back(std::move(session).value());
    }
    const auto walk = options.order == "frame" ? walk_by_frame : walk_by_run;
    if (Status status = walk(sessions, options.walk, progress); !status) return status.error();
    for (WalkSession& session : sessions)
        if (Status status = session.finish(); !status) return status.error();
    const CompareReport report = report_of(options, *methods, sessions);
    progress.clear();
    fmt::print("{}", to_table(report));
    if (Status status = outputs.commit(report, options); !status) return status.error();
    return report.missing_pixels_in_exact_mode() > 0 ? kCheckFailed : kDone;
}

}  // namespace rhview::cli
