// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include "constants.h"
#include "instances.h"
#include "level_chains.h"
#include "method.h"
#include "progress.h"
#include "rhview/base/version.h"
#include "rhview/gl/context.h"
#include "rhview/gl/timer.h"
#include "scene_source.h"
#include "verbs.h"
#include "walk_report.h"

namespace rhview::cli {
namespace {

// Quick calibrations draw at this size where the user names none.
constexpr int kWidth = 1280;
constexpr int kHeight = 720;

/// The constants that `rhview` builds by, chosen as a walk would; none for other methods.
Result<std::optional<UserConstants>> constants_of(const BakeOptions& options, const WantedConstants& wanted,
                                                  const LoadedScene& loaded) {
    if (options.method != "rhview") return std::optional<UserConstants>();
    const Result<gl::Context> context = gl::Context::create_headless();
    if (!context) return context.error();
    const Result<ChosenConstants> chosen =
        choose_constants(wanted, options.scene, loaded, context->device(), kWidth, kHeight);
    if (!chosen) return chosen.error();
    if (!chosen->warning.empty()) fmt::print(stderr, "rhview: warning: {}\n", chosen->warning);
    return chosen->constants;
}

std::string levels_text(const std::vector<LodChain>& chains, double build_ms) {
    std::size_t levels = 0, bytes = 0;
    for (const LodChain& chain : chains) {
        levels += chain.levels.size() - 1;
        bytes += chain.indices.span().size_bytes();
    }
    return fmt::format("{} of detail below full, {:.1f} MiB; built in {:.0f} ms", levels,
                       static_cast<double>(bytes) / (1024.0 * 1024.0), build_ms);
}

}  // namespace

Result<int> run_bake(const BakeOptions& options) {
    if (!is_baked_name(options.output))
        return Error{fmt::format("-o {}: a baked file is known by its name; let it end in .rho",
                                 options.output.string())};
    if (options.method != "octree" && options.method != "rhview-seed" && options.method != "rhview")
        return Error{fmt::format("--method {}: has no octree to bake; write octree, rhview-seed or rhview",
                                 options.method)};
    if (Status status = check_instances(options.instances); !status) return status.error();
    const Result<WantedConstants> wanted = parse_constants(options.profile, options.set);
    if (!wanted) return wanted.error();
    Result<RhoWriter> writer = RhoWriter::create(options.output);
    if (!writer) return writer.error();

    Progress progress;
    progress.say("loading " + options.scene);
    Result<LoadedScene> loaded = load_scene(options.scene, options.path);
    if (!loaded) return loaded.error();
    progress.say("choosing timing constants");
    const Result<std::optional<UserConstants>> constants = constants_of(options, *wanted, *loaded);
    if (!constants) return constants.error();
    progress.say("building");
    if (Status status = settle_instances(*loaded, options.scene, options.instances, *constants); !status)
        return status.error();
    const Scene& scene = loaded->scene;
    const DrawCosts costs = *constants ? draw_costs((*constants)->profile, false) : DrawCosts();
    const OctreeOptions octree_options =
        octree_options_of(options.method, scene, {options.leaf, options.replica_budget, costs, {}, {}});
    const gl::WallTimer build_timer;
    const std::vector<TriangleBatch> batches = scene.triangle_batches();
    const Result<RhOctree> octree = build_octree(batches, octree_options);
    if (!octree) return Error{scene.name + ": " + octree.error().message};
    const double build_ms = build_timer.elapsed_ms();

    std::vector<LodChain> chains;
    const gl::WallTimer chain_timer;
    if (!scene.dynamic_objects.empty()) {
        Result<std::vector<LodChain>> built = build_chains(scene, progress);
        if (!built) return built.error();
        chains = std::move(built).value();
    }
    const double chains_ms = chain_timer.elapsed_ms();

    progress.say("writing");
    const gl::WallTimer write_timer;
    // Baked anew, a scene keeps the name of its first source.
    const std::string source = loaded->baked ? loaded->baked->provenance.source : options.scene;
    add_scene_sections(*writer, *loaded, {source, fmt::format("rhview {}", kVersion)});
    add_octree_sections(*writer, *octree, batches, octree_options);
    if (!chains.empty()) add_lod_sections(*writer, chains);
    const Result<std::uint64_t> bytes = writer->finish();
    if (!bytes) return bytes.error();
    const double write_ms = write_timer.elapsed_ms();
    progress.clear();

    constexpr double kMebibyte = 1024.0 * 1024.0;
    fmt::print("{}\n", options.output.string());
    fmt::print("  scene       {}: {} triangles, {:.1f} MiB of vertices, {:.1f} MiB of indices\n", scene.name,
               scene.static_triangles() + scene.dynamic_triangles(),
               static_cast<double>(scene.vertex_bytes()) / kMebibyte,
               static_cast<double>(scene.index_bytes()) / kMebibyte);
    if (const std::string line = instancing_text(scene.instancing); !line.empty())
        fmt::print("  instances   {}\n", line);
    fmt::print(
        "  octree      {} nodes, {} leaves of at most {} triangles, {} replicas of {:.1f} MiB; built in "
        "{:.0f} ms\n",
        octree->nodes().size(), octree->leaf_count(), octree_options.max_leaf_triangles,
        octree->replicas().size(), static_cast<double>(octree->replica_bytes()) / kMebibyte, build_ms);
    if (!chains.empty()) fmt::print("  levels      {}\n", levels_text(chains, chains_ms));
    fmt::print("  file        {:.1f} MiB, written in {:.0f} ms\n", static_cast<double>(*bytes) / kMebibyte,
               write_ms);
    return kDone;
}

}  // namespace rhview::cli
