// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "instances.h"
#include "level_chains.h"
#include "method.h"
#include "rhview/gl/timer.h"
#include "walk_pace.h"

namespace rhview::cli {
namespace {

Status check_options(const WalkOptions& options) {
    const std::vector<std::string> methods = method_names();
    if (std::ranges::find(methods, options.method) == methods.end())
        return Error{fmt::format("--method {}: unknown; the methods are {}", options.method,
                                 fmt::join(methods, ", "))};
    if (options.mode != "exact" && options.mode != "latent")
        return Error{fmt::format("--mode {}: unknown; write exact or latent", options.mode)};
    const std::array ways{"auto", "hardware", "boxes", "off"};
    if (std::ranges::find(ways, options.occlusion) == ways.end())
        return Error{
            fmt::format("--occlusion {}: unknown; write {}", options.occlusion, fmt::join(ways, ", "))};
    const bool interactive = is_interactive(options.method);
    if (options.visible_set &&
        (options.method == "none" || options.method == "frustum" || options.method == "grid" || interactive))
        return Error{fmt::format("--visible-set: {} has no octree; choose another --method", options.method)};
    if (options.mode == "latent" && (options.method != "rhview" || options.occlusion == "off"))
        return Error{"--mode latent: needs --method rhview, and no --occlusion off"};
    if (options.visible_pixels > 0 && (options.mode != "latent" || options.occlusion == "boxes"))
        return Error{
            fmt::format("--visible-pixels {}: needs --mode latent, and no --occlusion boxes (only hardware "
                        "queries count)",
                        options.visible_pixels)};
    if (options.occlusion == "boxes" && options.method == "rhview-seed")
        return Error{"--occlusion boxes: rhview-seed asks by hardware queries; leave it out"};
    if (options.occlusion != "auto" && interactive)
        return Error{fmt::format("--occlusion {}: {} asks in its own way; leave it out", options.occlusion,
                                 options.method)};
    if ((options.hierarchy != "auto" && !has_hierarchy(options.method)) ||
        (!options.tune.empty() && !has_tune(options.method)))
        return Error{
            fmt::format("--hierarchy and --tune: {} has no such choice; leave them out", options.method)};
    if (const Result<RivalOptions> rival = parse_rival(options.hierarchy, options.tune); !rival)
        return rival.error();
    if (options.occlusion != "auto" && options.occlusion != "off" && options.method != "rhview" &&
        options.method != "rhview-seed")
        return Error{fmt::format("--occlusion {}: {} asks nothing; choose --method rhview, or leave it out",
                                 options.occlusion, options.method)};
    if (options.submission != "plain" && options.submission != "multi")
        return Error{fmt::format("--submission {}: unknown; write plain or multi", options.submission)};
    if (options.lod_policy != "error" && options.lod_policy != "fragments")
        return Error{fmt::format("--lod-policy {}: unknown; write error or fragments", options.lod_policy)};
    if (options.lod_policy == "fragments" &&
        (options.method != "rhview" || options.occlusion == "off" || options.occlusion == "boxes"))
        return Error{
            "--lod-policy fragments: needs --method rhview and its hardware queries; leave out --occlusion"};
    if (options.budget_ms && interactive)
        return Error{
            fmt::format("--budget: {} draws as it finds, and plans no frame; leave it out", options.method)};
    return check_instances(options.instances);
}

Result<LoadedScene> load(const WalkOptions& options) {
    Result<LoadedScene> loaded = load_scene(options.scene, options.path);
    if (loaded && loaded->baked && options.leaf)
        return Error{fmt::format(
            "--leaf {}: {} brings its octree, with leaves of at most {} triangles; bake it again with "
            "another --leaf",
            *options.leaf, options.scene, loaded->baked->octree.options.max_leaf_triangles)};
    if (loaded)
        if (const Status pace = check_pace(loaded->path, options); !pace) return pace.error();
    return loaded;
}

/// A baked file's, else built.
Status add_chains(const WalkOptions& options, WalkGround& ground, Progress& progress) {
    const bool wanted = options.lod_error_px > 0.0 || options.budget_ms;
    if (!wanted || ground.loaded.scene.dynamic_objects.empty()) return success();
    std::optional<BakedParts>& baked = ground.loaded.baked;
    if (baked && baked->chains) {
        ground.chains = std::move(*baked->chains);
        return success();
    }
    const gl::WallTimer timer;
    Result<std::vector<LodChain>> chains = build_chains(ground.loaded.scene, progress);
    if (!chains) return chains.error();
    ground.chains = std::move(chains).value();
    ground.chains_ms = timer.elapsed_ms();
    return success();
}

}  // namespace

Result<WalkWishes> parse_wishes(const WalkOptions& options) {
    if (Status status = check_options(options); !status) return status.error();
    const Result<PictureSize> size = parse_size(options.size);
    if (!size) return size.error();
    Result<WantedConstants> constants = parse_constants(options.profile, options.set);
    if (!constants) return constants.error();
    return WalkWishes{*size, std::move(constants).value()};
}

Result<WalkGround> prepare_ground(const WalkOptions& options, WalkWishes wishes, Progress& progress) {
    Result<gl::Context> context = gl::Context::create_headless();
    if (!context) return context.error();
    return prepare_ground(options, std::move(wishes), std::move(context).value(), progress);
}

Result<WalkGround> prepare_ground(const WalkOptions& options, WalkWishes wishes, gl::Context context,
                                  Progress& progress) {
    progress.say("loading " + options.scene);
    Result<LoadedScene> loaded = load(options);
    if (!loaded) return loaded.error();
    progress.say("choosing timing constants");
    Result<ChosenConstants> chosen = choose_constants(
        wishes.constants, options.scene, *loaded, context.device(), wishes.size.width, wishes.size.height);
    if (!chosen) return chosen.error();
    if (!chosen->warning.empty()) {
        progress.clear();
        fmt::print(stderr, "rhview: warning: {}\n", chosen->warning);
    }
    progress.say("settling instances");
    const gl::WallTimer timer;
    if (Status status = settle_instances(*loaded, options.scene, options.instances, chosen->constants);
        !status)
        return status.error();
    const double settle_ms = timer.elapsed_ms();
    WalkGround ground{std::move(context),
                      std::move(loaded).value(),
                      std::move(wishes.constants),
                      std::move(chosen).value(),
                      wishes.size,
                      settle_ms,
                      {},
                      {}};
    if (Status status = add_chains(options, ground, progress); !status) return status.error();
    return ground;
}

}  // namespace rhview::cli
