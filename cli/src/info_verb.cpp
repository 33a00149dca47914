// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "output_file.h"
#include "progress.h"
#include "rhview/scenes/static_instances.h"
#include "scene_source.h"
#include "verbs.h"

namespace rhview::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::optional<BakedParts>& baked) {
    if (!baked) return nullptr;
    const RhOctree& octree = baked->octree.octree;
    return {{"source", baked->provenance.source},
            {"baked_by", baked->provenance.baked_by},
            {"load_ms", baked->load_ms},
            {"nodes", octree.nodes().size()},
            {"leaves", octree.leaf_count()},
            {"max_leaf_triangles", baked->octree.options.max_leaf_triangles},
            {"replica_bytes", octree.replica_bytes()},
            {"replica_budget", baked->octree.options.replica_budget},
            {"c1_ns", baked->octree.options.costs.index_ns},
            {"c3_ns", baked->octree.options.costs.draw_ns}};
}

Json to_json(const LoadedScene& loaded) {
    const Scene& scene = loaded.scene;
    const Aabb bounds = scene.bounds();
    const auto world = [&](const glm::vec3& p) {
        const glm::dvec3 w = scene.origin + glm::dvec3(p);
        return Json{w.x, w.y, w.z};
    };
    Json materials = Json::array();
    for (const Material& material : scene.materials)
        materials.push_back({{"name", material.name},
                             {"two_sided", material.two_sided},
                             {"alpha_tested", material.alpha_tested}});
    return {{"schema", "rhview.info/1"},
            {"name", scene.name},
            {"triangles", scene.static_triangles() + scene.dynamic_triangles()},
            {"static_triangles", scene.static_triangles()},
            {"static_objects", scene.static_objects()},
            {"static_instances", scene.static_instances.size()},
            {"instance_triangles", scene.instance_triangles()},
            {"meshes", scene.meshes.size()},
            {"stored_triangles", scene.index_bytes() / (3 * sizeof(std::uint32_t))},
            {"dynamic_objects", scene.dynamic_objects.size()},
            {"dynamic_triangles", scene.dynamic_triangles()},
            {"vertices", scene.vertex_count()},
            {"vertex_bytes", scene.vertex_bytes()},
            {"index_bytes", scene.index_bytes()},
            {"batches", scene.batches.size()},
            {"materials", materials},
            {"extent", {{"min", world(bounds.min)}, {"max", world(bounds.max)}}},
            {"dropped_triangles", scene.dropped_triangles},
            {"warnings", scene.warnings},
            {"baked", to_json(loaded.baked)}};
}

std::string grouped(std::uint64_t value) {
    const std::string digits = std::to_string(value);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
        text += digits[i];
    }
    return text;
}

void print(const BakedParts& baked) {
    const RhOctree& octree = baked.octree.octree;
    fmt::print(
        "  baked       from {} by {}: {} nodes, {} leaves of at most {} triangles, {} replicas of {} MiB; "
        "loaded in "
        "{:.1f} ms\n",
        baked.provenance.source, baked.provenance.baked_by, grouped(octree.nodes().size()),
        grouped(octree.leaf_count()), grouped(baked.octree.options.max_leaf_triangles),
        grouped(octree.replicas().size()), octree.replica_bytes() >> 20, baked.load_ms);
}

void print(const LoadedScene& loaded) {
    const Scene& scene = loaded.scene;
    const Aabb bounds = scene.bounds();
    const glm::vec3 extent = bounds.extent();
    std::size_t two_sided = 0, alpha_tested = 0;
    for (const Material& material : scene.materials) {
        two_sided += material.two_sided;
        alpha_tested += material.alpha_tested;
    }
    fmt::print("{}\n", scene.name);
    fmt::print("  triangles   {} static in {} objects", grouped(scene.static_triangles()),
               grouped(scene.static_objects()));
    if (!scene.dynamic_objects.empty())
        fmt::print(", {} placed by {} dynamic objects", grouped(scene.dynamic_triangles()),
                   grouped(scene.dynamic_objects.size()));
    if (!scene.static_instances.empty())
        fmt::print("\n  instances   {} of the objects place {} meshes: {} triangles, {} stored in all",
                   grouped(scene.static_instances.size()), grouped(repeated_meshes(scene).size()),
                   grouped(scene.instance_triangles()),
                   grouped(scene.index_bytes() / (3 * sizeof(std::uint32_t))));
    fmt::print("\n  vertices    {} ({} MiB), indices {} MiB\n", grouped(scene.vertex_count()),
               scene.vertex_bytes() >> 20, scene.index_bytes() >> 20);
    fmt::print("  materials   {} ({} two-sided, {} alpha-tested) in {} batches\n", scene.materials.size(),
               two_sided, alpha_tested, scene.batches.size());
    fmt::print("  extent      {:.6g} x {:.6g} x {:.6g} m around ({:.6g}, {:.6g}, {:.6g})\n", extent.x,
               extent.y, extent.z, scene.origin.x + static_cast<double>(bounds.centre().x),
               scene.origin.y + static_cast<double>(bounds.centre().y),
               scene.origin.z + static_cast<double>(bounds.centre().z));
    if (loaded.baked) print(*loaded.baked);
    for (const std::string& warning : scene.warnings) fmt::print("  warning     {}\n", warning);
}

}  // namespace

Result<int> run_info(const InfoOptions& options) {
    std::optional<OutputFile> json;
    if (options.json) {
        Result<OutputFile> file = OutputFile::open(*options.json);
        if (!file) return file.error();
        json.emplace(std::move(file).value());
    }
    Result<LoadedScene> loaded = [&] {
        Progress progress;
        progress.say("loading " + options.scene);
        return load_scene(options.scene);
    }();
    if (!loaded) return loaded.error();
    print(*loaded);
    if (json) {
        const std::string text = to_json(*loaded).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
        if (Status status = json->commit(text); !status) return status.error();
    }
    return kDone;
}

}  // namespace rhview::cli
