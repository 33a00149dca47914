// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rivals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "method.h"
#include "rhview/baselines/chc.h"

namespace rhview::cli {
namespace {

/// Measured, see docs/rivals.md.
constexpr std::uint32_t kObjectLeaf = 1024;
constexpr std::uint32_t kOctreeLeaf = 4096;

struct Setting {
    std::string_view key;
    double low, high;
    void (*set)(RivalOptions&, double);
};

std::uint32_t whole(double value) {
    return static_cast<std::uint32_t>(value);
}

constexpr std::array kSettings{
    Setting{"batch", 1, 1e6, [](RivalOptions& o, double v) { o.chc_plus_plus.batch = whole(v); }},
    Setting{"visible-frames", 1, 1e6,
            [](RivalOptions& o, double v) { o.chc_plus_plus.visible_frames = whole(v); }},
    Setting{"tight-depth", 0, 64, [](RivalOptions& o, double v) { o.chc_plus_plus.tight.depth = whole(v); }},
    Setting{"tight-area", 0, 1e6, [](RivalOptions& o, double v) { o.chc_plus_plus.tight.area = v; }},
    Setting{"cells", 1, 64e6, [](RivalOptions& o, double v) { o.grid_cells = v; }},
    Setting{"levels", 1, 3, [](RivalOptions& o, double v) { o.grid.levels = whole(v); }},
    Setting{"top-cells", 1, 512, [](RivalOptions& o, double v) { o.grid.top_cells = whole(v); }},
    Setting{"inner-cells", 2, 64, [](RivalOptions& o, double v) { o.grid.inner_cells = whole(v); }},
};

Status apply_setting(RivalOptions& options, std::string_view key, std::string_view text) {
    if (key == "visible-query") {
        if (text != "geometry" && text != "box")
            return Error{fmt::format("--tune visible-query={}: write geometry or box", text)};
        options.chc_plus_plus.visible_query = text == "box" ? VisibleQuery::Box : VisibleQuery::Geometry;
        return success();
    }
    const auto setting = std::ranges::find(kSettings, key, &Setting::key);
    if (setting == kSettings.end()) {
        std::vector<std::string_view> keys{"visible-query"};
        for (const Setting& s : kSettings) keys.push_back(s.key);
        return Error{fmt::format("--tune {}: unknown; the keys are {}", key, fmt::join(keys, ", "))};
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() ||
        !(value >= setting->low && value <= setting->high))
        return Error{fmt::format("--tune {}={}: write a number from {} to {}", key, text, setting->low,
                                 setting->high)};
    setting->set(options, value);
    return success();
}

/// Whether the objects that the scene's author placed are no larger, on average, than an octree's leaves.
bool has_fine_objects(const Scene& scene) {
    return static_objects(scene).size() * std::uint64_t{kOctreeLeaf} >= scene.batch_triangles();
}

void use(OrderedTree tree, PreparedRival& prepared, CullTree& into) {
    into = std::move(tree.tree);
    prepared.indices = std::move(tree.indices);
}

Status build_octree_tree(const Scene& scene, const BakedOctree* baked, PreparedRival& prepared,
                         CullTree& tree) {
    const auto take = [&](const RhOctree& octree) {
        tree = CullTree::of_octree(octree);
        const std::span<const std::uint32_t> base = octree.indices().first(octree.base_index_count());
        prepared.indices.assign(base.begin(), base.end());
    };
    prepared.hierarchy = "octree";
    if (baked != nullptr) {
        prepared.leaf_triangles = baked->options.max_leaf_triangles;
        take(baked->octree);
        return success();
    }
    OctreeOptions options;
    options.max_leaf_triangles = prepared.leaf_triangles;
    options.normal_order = false;
    const Result<RhOctree> octree = build_octree(scene.triangle_batches(), options);
    if (!octree) return Error{scene.name + ": " + octree.error().message};
    take(*octree);
    return success();
}

}  // namespace

bool is_interactive(std::string_view method) {
    return method == "chc" || method == "chc++" || method == "nested-grid";
}

bool is_tune_key(std::string_view key) {
    return key == "visible-query" || std::ranges::find(kSettings, key, &Setting::key) != kSettings.end();
}

bool has_hierarchy(std::string_view method) {
    return method == "chc" || method == "chc++";
}

bool has_tune(std::string_view method) {
    return method == "chc++" || method == "nested-grid" || method == "grid";
}

Result<RivalOptions> parse_rival(std::string_view hierarchy, std::string_view tune) {
    RivalOptions options;
    options.hierarchy = hierarchy;
    if (hierarchy != "auto" && hierarchy != "bvh" && hierarchy != "octree")
        return Error{fmt::format("--hierarchy {}: unknown; write auto, bvh or octree", hierarchy)};
    while (!tune.empty()) {
        const std::string_view item = tune.substr(0, tune.find(','));
        tune.remove_prefix(std::min(tune.size(), item.size() + 1));
        const std::size_t equals = item.find('=');
        if (equals == std::string_view::npos) return Error{fmt::format("--tune {}: write KEY=VALUE,…", item)};
        if (Status status = apply_setting(options, item.substr(0, equals), item.substr(equals + 1)); !status)
            return status.error();
    }
    return options;
}

Result<PreparedRival> prepare_rival(std::string_view method, const Scene& scene, const RivalOptions& options,
                                    const BakedOctree* baked) {
    PreparedRival prepared;
    CullTree tree;
    if (method == "nested-grid") {
        NestedGridOptions grid = options.grid;
        grid.max_triangles = options.leaf_triangles.value_or(grid.max_triangles);
        prepared.leaf_triangles = grid.max_triangles;
        prepared.hierarchy = "grid";
        use(make_nested_grid(scene.triangle_batches(), grid), prepared, tree);
    } else if (options.hierarchy == "bvh" || (options.hierarchy == "auto" && has_fine_objects(scene))) {
        prepared.hierarchy = "bvh";
        prepared.leaf_triangles = options.leaf_triangles.value_or(kObjectLeaf);
        use(make_object_tree(static_objects(scene), scene.triangle_batches(), prepared.leaf_triangles),
            prepared, tree);
    } else {
        prepared.leaf_triangles = options.leaf_triangles.value_or(kOctreeLeaf);
        if (Status status = build_octree_tree(scene, baked, prepared, tree); !status) return status.error();
    }
    prepared.nodes = tree.nodes().size();
    prepared.leaves = tree.leaf_count();
    if (method == "chc")
        prepared.method = std::make_unique<Chc>(std::move(tree));
    else if (method == "chc++")
        prepared.method = std::make_unique<ChcPlusPlus>(std::move(tree), options.chc_plus_plus);
    else
        prepared.method = std::make_unique<StopAndWait>(std::move(tree));
    return prepared;
}

}  // namespace rhview::cli
