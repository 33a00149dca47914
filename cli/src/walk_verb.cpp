// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include "output_file.h"
#include "verbs.h"
#include "walk_session.h"

namespace rhview::cli {
namespace {

/// Where the results go; opened before the work, so that an unwritable place is told at once.
struct Outputs {
    std::optional<OutputFile> json;
    std::optional<OutputFile> csv;

    Status open(const WalkOptions& options) {
        const auto open_one = [](const auto& file, std::optional<OutputFile>& output) -> Status {
            if (!file) return success();
            Result<OutputFile> opened = OutputFile::open(*file);
            if (!opened) return opened.error();
            output.emplace(std::move(opened).value());
            return success();
        };
        if (options.json && options.csv && resolved(*options.json) == resolved(*options.csv))
            return Error{options.csv->string() + ": --json and --csv name the same file; name two"};
        if (Status status = open_one(options.json, json); !status) return status;
        if (Status status = open_one(options.csv, csv); !status) return status;
        return options.images ? prepare_folder(*options.images) : success();
    }

    Status commit(const WalkReport& report) {
        if (json)
            if (Status status = json->commit(to_json(report)); !status) return status;
        return csv ? csv->commit(to_csv(report)) : success();
    }
};

Status walk_path(WalkSession& session, const WalkOptions& options, Progress& progress) {
    for (int i = 0; i < options.warmup; ++i) {
        progress.show("warm-up", i, options.warmup);
        session.warm_up();
    }
    for (int frame = 0; frame < options.frames; ++frame) {
        progress.show("walking", frame, options.frames);
        if (Status status = session.walk(frame); !status) return status;
    }
    return session.finish();
}

}  // namespace

Result<int> run_walk(const WalkOptions& options) {
    Result<WalkWishes> wishes = parse_wishes(options);
    if (!wishes) return wishes.error();
    Outputs outputs;
    if (Status status = outputs.open(options); !status) return status.error();

    Progress progress;
    const Result<WalkGround> ground = prepare_ground(options, std::move(wishes).value(), progress);
    if (!ground) return ground.error();
    progress.say("building");
    Result<WalkSession> session = WalkSession::create(options, *ground);
    if (!session) return session.error();
    if (Status status = walk_path(*session, options, progress); !status) return status.error();
    const WalkReport& report = session->report();
    if (Status status = outputs.commit(report); !status) return status.error();
    progress.clear();
    fmt::print("{}", to_table(report));
    return report.missing_pixels() > 0 && options.mode == "exact" ? kCheckFailed : kDone;
}

}  // namespace rhview::cli
