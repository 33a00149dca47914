// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>

#include "method.h"
#include "rhview/base/log.h"
#include "rhview/base/version.h"
#include "verbs.h"

namespace rhview::cli {
namespace {

constexpr std::array<std::string_view, 7> kVerbs{"scenes", "info",    "calibrate", "bake",
                                                 "walk",   "compare", "view"};

constexpr const char* kSceneHelp = "A file (.glb .gltf .obj .ply .rho) or a named scene";

int fail(std::string_view sentence) {
    fmt::print(stderr, "rhview: {}\n", sentence);
    return kBadInput;
}

void print_log(LogLevel level, std::string_view message) {
    if (level == LogLevel::Error) fmt::print(stderr, "rhview: {}\n", message);
}

void add_info(CLI::App& app, InfoOptions& options) {
    CLI::App* info = app.add_subcommand("info", "What is in a scene");
    info->add_option("SCENE", options.scene, kSceneHelp)->required();
    info->add_option("--json", options.json, "Write it as JSON")->type_name("FILE");
}

constexpr const char* kLeafHelp =
    "Triangles per octree leaf, at most; default: rhview chooses, the others take 4096";
constexpr const char* kLeafHelpOfAll =
    "Triangles per leaf, at most; default: rhview chooses; octree, rhview-seed and octrees of chc and chc++ "
    "take "
    "4096, their hierarchies over the scene's objects 1024, cells of nested-grid 16384; none, frustum and "
    "grid have "
    "no leaves";

void add_octree_options(CLI::App& verb, const char* leaf_help, std::optional<std::uint32_t>& leaf,
                        double& replica_budget) {
    verb.add_option("--leaf", leaf, leaf_help)->type_name("N")->check(CLI::Range(1u, 4'000'000'000u));
    verb.add_option("--replica-budget", replica_budget,
                    "Bytes of rhview's replicas, as a multiple of the source indices' bytes")
        ->type_name("R")
        ->check(CLI::Range(0.0, 1'000.0))
        ->capture_default_str();
}

void add_instance_options(CLI::App& verb, InstancesWanted& wanted) {
    verb.add_option("--instances", wanted.policy,
                    "Meshes that a file places repeatedly: auto (flattened where the model says that it "
                    "pays), flatten, keep")
        ->type_name("HOW")
        ->capture_default_str();
    verb.add_option("--instance-budget", wanted.budget_mib,
                    "MiB that flattened instances may take with --instances auto; default: 1024")
        ->type_name("MIB")
        ->check(CLI::Range(0.0, 1e6));
}

void add_calibrate(CLI::App& app, CalibrateOptions& options) {
    CLI::App* calibrate =
        app.add_subcommand("calibrate", "Fit the timing constants of this machine, in 20 seconds at most");
    calibrate->add_option("SCENE", options.scene,
                          "Measure with this scene's triangles; without it, with those of named scenes");
    calibrate->add_option("-o,--output", options.output, "Where to write the profile, instead of the cache")
        ->type_name("PROFILE");
    calibrate->add_option("--size", options.size, "Picture size")->type_name("WxH")->capture_default_str();
    calibrate->add_option("--csv", options.csv, "Write a line per timed frame")->type_name("FILE");
}

/// What all verbs that cull have in common.
void add_culling_options(CLI::App* walk, WalkOptions& options) {
    walk->add_option("SCENE", options.scene, kSceneHelp)->required();
    walk->add_option("--mode", options.mode,
                     "exact: what is left out is proved hidden in the same frame; latent: earlier frames' "
                     "answers are trusted")
        ->capture_default_str();
    walk->add_option("--occlusion", options.occlusion,
                     "rhview and rhview-seed: ask the device what is hidden: auto (either way, where it "
                     "pays), hardware (queries "
                     "only), boxes (box pass only), off")
        ->type_name("W")
        ->capture_default_str();
    walk->add_option("--hierarchy", options.hierarchy,
                     "chc and chc++: what is culled: bvh (over the scene's objects), octree, auto (bvh "
                     "unless objects are large)")
        ->type_name("H")
        ->capture_default_str();
    walk->add_option("--tune", options.tune,
                     "Parameters of chc++ (batch, visible-frames, tight-depth, tight-area, visible-query) "
                     "nested-grid (levels, top-cells, inner-cells) and grid (cells); docs/rivals.md")
        ->type_name("KEY=VALUE,…");
    walk->add_option("--path", options.path, "Camera path (rhview.path/1), instead of the scene's own")
        ->type_name("FILE");
    walk->add_option(
            "--profile", options.profile,
            "Timing constants (rhview.profile/1); else those that calibrate saved, else measured quickly")
        ->type_name("FILE");
    walk->add_option("--set", options.set,
                     "Timing constants in ns: c0, c1 per index, c3 per draw call, query (an occlusion query, "
                     "whatever its boxes), box (a query of the box pass, likewise)")
        ->type_name("c1=…,c3=…,query=…");
    walk->add_option("--size", options.size, "Picture size")->type_name("WxH")->capture_default_str();
    add_octree_options(*walk, kLeafHelpOfAll, options.leaf, options.replica_budget);
    add_instance_options(*walk, options.instances);
    walk->add_option("--submission", options.submission,
                     "plain: a call per range; multi: a multi-draw per batch")
        ->capture_default_str();
    walk->add_option("--lod-error", options.lod_error_px,
                     "Largest error of dynamic objects' levels of detail, in pixels; 0: full detail")
        ->type_name("PX")
        ->check(CLI::Range(0.0, 1000.0))
        ->capture_default_str();
    walk->add_option("--lod-policy", options.lod_policy,
                     "error: the coarsest level within --lod-error; fragments: coarser still where a query "
                     "saw fewer fragments than triangles")
        ->type_name("P")
        ->capture_default_str();
    walk->add_option("--budget", options.budget_ms,
                     "Frame budget: levels of detail give way to it, and each frame says whether it can be "
                     "met; 16.6 where no MS is given, none without the option")
        ->type_name("MS")
        ->expected(0, 1)
        ->default_str("16.6")
        ->check(CLI::Range(0.001, 1e6));
}

/// What walks and comparisons have in common.
void add_walk_options(CLI::App* walk, WalkOptions& options) {
    add_culling_options(walk, options);
    walk->add_option("--frames", options.frames, "Frames to measure")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    walk->add_option("--rate", options.rate_hz,
                     "Frames per second of the path's own time; default: all of the path in --frames")
        ->type_name("HZ")
        ->check(CLI::Range(1e-3, 1e6));
    walk->add_option("--excerpts", options.excerpts,
                     "With --rate: so many stretches of the path, evenly spread, share the frames")
        ->type_name("K")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    walk->add_option("--warmup", options.warmup, "Frames drawn before, not measured")
        ->check(CLI::Range(0, 1'000'000))
        ->capture_default_str();
    walk->add_option("--repeats", options.repeats, "Draw each frame that often, report the median time")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    walk->add_option("--visible-pixels", options.visible_pixels,
                     "--mode latent: what shows fewer pixels of its boxes than this is left out as well")
        ->type_name("PX")
        ->check(CLI::Range(0u, 1'000'000'000u));
    walk->add_option("--image-error", options.image_error_every,
                     "Measure every N-th frame's difference from everything at full detail: depth error, "
                     "PSNR, SSIM")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000));
    walk->add_flag("--check", options.check, "Compare every frame's depth with drawing everything");
    walk->add_option("--check-every", options.check_every, "Check every N-th frame only (implies --check)")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000))
        ->each([&options](const std::string&) { options.check = true; });
    walk->add_flag("--visible-set", options.visible_set,
                   "Count the indices of the octree's leaves that show a pixel, by an item buffer");
    walk->add_option(
            "--freeze-culling", options.freeze_culling,
            "From this frame on, cull for its camera while the picture's goes on: shows what is left out")
        ->type_name("FRAME")
        ->check(CLI::Range(0, 1'000'000));
    walk->add_option("--csv", options.csv, "Write a line per frame")->type_name("FILE");
}

void add_method(CLI::App* verb, WalkOptions& options) {
    verb->add_option("--method", options.method, fmt::format("{}", fmt::join(method_names(), ", ")))
        ->type_name("M")
        ->capture_default_str();
}

void add_view(CLI::App& app, ViewOptions& options) {
    CLI::App* view =
        app.add_subcommand("view", "A window to fly through, with the culling seen from outside");
    add_method(view, options.walk);
    add_culling_options(view, options.walk);
    view->add_option("--script", options.script,
                     "Run the commands of a file, then quit: frames, hold, turn, key, freeze, record, "
                     "screenshot and more; docs/viewer.md")
        ->type_name("FILE");
    view->add_option("--folder", options.folder, "Where screenshots and recordings go")
        ->type_name("DIR")
        ->capture_default_str();
}

void add_walk(CLI::App& app, WalkOptions& options) {
    CLI::App* walk = app.add_subcommand("walk", "One culling method along a camera path, headless");
    add_method(walk, options);
    add_walk_options(walk, options);
    walk->add_option("--json", options.json, "Write the results as JSON (rhview.walk/1)")->type_name("FILE");
    walk->add_option("--images", options.images, "Write a PNG of every 30th frame")->type_name("DIR");
    walk->add_option("--images-every", options.images_every, "Another interval for --images")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000));
}

void add_compare(CLI::App& app, CompareOptions& options) {
    CLI::App* compare = app.add_subcommand("compare", "Several culling methods along one path, in one run");
    compare
        ->add_option("--methods", options.methods,
                     "Methods, separated by commas, each with options of its own behind colons (leaf, "
                     "replica-budget, mode, visible-pixels, lod-error, occlusion, hierarchy, submission): "
                     "octree:leaf=4096,rhview; default: " +
                         std::string(kDefaultMethods))
        ->type_name("a,b,…");
    compare->add_flag("--pareto", options.pareto,
                      "Add rhview with everything that it may give up for speed (latent mode, visibility "
                      "thresholds, levels of detail), measure the picture's error, tell the front");
    compare
        ->add_option("--order", options.order,
                     "frame: methods take turns frame by frame; run: one walks after the other")
        ->type_name("O")
        ->capture_default_str();
    compare
        ->add_option("--report", options.report,
                     "Write report.html, a page that needs nothing else, and compare.json")
        ->type_name("DIR");
    add_walk_options(compare, options.walk);
    compare->add_option("--json", options.walk.json, "Write the results as JSON (rhview.compare/1)")
        ->type_name("FILE");
}

void add_bake(CLI::App& app, BakeOptions& options) {
    CLI::App* bake =
        app.add_subcommand("bake", "Build a scene's octree and levels of detail once and save all");
    bake->add_option("SCENE", options.scene, kSceneHelp)->required();
    bake->add_option("-o,--output", options.output, "The baked file")->type_name("FILE.rho")->required();
    bake->add_option("--method", options.method, "Whose octree: octree, rhview-seed or rhview")
        ->type_name("M")
        ->capture_default_str();
    add_octree_options(*bake, kLeafHelp, options.leaf, options.replica_budget);
    add_instance_options(*bake, options.instances);
    bake->add_option(
            "--profile", options.profile,
            "Timing constants (rhview.profile/1) that leaves and replicas are chosen by; default: this "
            "machine's")
        ->type_name("FILE");
    bake->add_option("--set", options.set, "Timing constants in ns: c1 per index, c3 per draw call")
        ->type_name("c1=…,c3=…");
    bake->add_option("--path", options.path, "Camera path (rhview.path/1), instead of the scene's own")
        ->type_name("FILE");
}

/// As a shell takes it for one word.
std::string quoted(std::string_view word) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+:,./%@";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

/// CLI11's message as one sentence.
std::string one_sentence(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text;
}

int run(int argc, char** argv) {
    if (argc > 1 && argv[1][0] != '-' && std::ranges::find(kVerbs, std::string_view(argv[1])) == kVerbs.end())
        return fail(fmt::format("unknown verb '{}'; the verbs are {}", argv[1], fmt::join(kVerbs, ", ")));

    CLI::App app("rhview: few draw calls that show every visible pixel", "rhview");
    app.require_subcommand(1);
    app.set_version_flag("--version", kVersion);
    const CLI::App* scenes =
        app.add_subcommand("scenes", "The named procedural scenes, their parameters and sizes");
    InfoOptions info;
    add_info(app, info);
    CalibrateOptions calibrate;
    add_calibrate(app, calibrate);
    WalkOptions walk;
    add_walk(app, walk);
    CompareOptions compare;
    compare.program = argv[0];
    for (int i = 0; i < argc; ++i)
        compare.command += (i > 0 ? " " : "") + (i > 0 ? quoted(argv[i]) : std::string("rhview"));
    add_compare(app, compare);
    BakeOptions bake;
    add_bake(app, bake);
    ViewOptions view;
    add_view(app, view);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& done) {
        return app.exit(done);
    } catch (const CLI::ParseError& error) {
        if (argc < 2)
            return fail(fmt::format("which verb? The verbs are {}; rhview --help tells more",
                                    fmt::join(kVerbs, ", ")));
        const bool verb = std::ranges::find(kVerbs, std::string_view(argv[1])) != kVerbs.end();
        if (!verb)
            return fail(fmt::format("unknown option {}; the verbs are {}", argv[1], fmt::join(kVerbs, ", ")));
        return fail(fmt::format("{}; see rhview {} --help", one_sentence(error.what()), argv[1]));
    }
    Result<int> code = app.got_subcommand(scenes->get_name()) ? run_scenes()
                       : app.got_subcommand("info")           ? run_info(info)
                       : app.got_subcommand("bake")           ? run_bake(bake)
                       : app.got_subcommand("compare")        ? run_compare(compare)
                       : app.got_subcommand("view")           ? run_view(view)
                       : app.got_subcommand("calibrate")      ? run_calibrate(calibrate)
                                                              : run_walk(walk);
    if (code && std::fflush(stdout) != 0)
        code = Error{"standard output can't be written to; is the disk full?"};
    return code ? *code : fail(code.error().message);
}

}  // namespace
}  // namespace rhview::cli

int main(int argc, char** argv) {
    rhview::set_log_callback(rhview::cli::print_log);
    try {
        return rhview::cli::run(argc, argv);
    } catch (const std::bad_alloc&) {
        return rhview::cli::fail("out of memory; choose a smaller scene");
    } catch (const std::exception& error) {
        return rhview::cli::fail(error.what());
    }
}
