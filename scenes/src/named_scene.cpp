// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/named_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <new>
#include <optional>
#include <vector>

#include "rhview/scenes/memory.h"
#include "scene_recipe.h"

namespace rhview {
namespace {

using RecipeTable = std::array<const SceneRecipe*, 9>;

const RecipeTable& recipes() {
    static const RecipeTable table{&town_recipe(),  &plant_recipe(),   &indoor_recipe(),
                                   &farm_recipe(),  &city_recipe(),    &crowd_recipe(),
                                   &swarm_recipe(), &spheres_recipe(), &soup_recipe()};
    return table;
}

template <class Items>
std::string listed(const Items& items) {
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i > 0) text += i + 1 < items.size() ? ", " : " and ";
        text += items[i].name;
    }
    return text;
}

std::string_view name_of(std::string_view spec) {
    return spec.substr(0, spec.find(':'));
}

const SceneRecipe* find_recipe(std::string_view name) {
    const auto found = std::find_if(recipes().begin(), recipes().end(),
                                    [&](const SceneRecipe* recipe) { return recipe->info.name == name; });
    return found == recipes().end() ? nullptr : *found;
}

/// The value of `parameter` in `text`.
Result<std::int64_t> parse_value(const NamedSceneInfo& info, const SceneParameter& parameter,
                                 std::string_view text) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = end == text.data() + text.size() && error != std::errc::invalid_argument;
    if (!whole) {
        return Error{fmt::format("{}: {}={} is not a whole number; write one from {} to {}", info.name,
                                 parameter.name, text, parameter.minimum, parameter.maximum)};
    }
    if (error != std::errc{} || value < parameter.minimum || value > parameter.maximum) {
        return Error{fmt::format("{}: {}={} is out of range; it must be from {} to {}", info.name,
                                 parameter.name, text, parameter.minimum, parameter.maximum)};
    }
    return value;
}

/// Reads one `key=value` into `values`.
Status parse_item(const NamedSceneInfo& info, std::string_view item,
                  std::vector<std::optional<std::int64_t>>& values) {
    const std::string_view key = item.substr(0, item.find('='));
    if (key.empty()) {
        return Error{fmt::format("{}: a parameter is empty; write {}:{}={}", info.name, info.name,
                                 info.parameters[0].name, info.parameters[0].default_value)};
    }
    const auto parameter =
        std::find_if(info.parameters.begin(), info.parameters.end(),
                     [&](const SceneParameter& candidate) { return candidate.name == key; });
    if (parameter == info.parameters.end()) {
        return Error{fmt::format("{}: there is no parameter '{}'; {} has {}", info.name, key, info.name,
                                 listed(info.parameters))};
    }
    if (key.size() == item.size() || key.size() + 1 == item.size()) {
        return Error{
            fmt::format("{}: {} has no value; write {}={}", info.name, key, key, parameter->default_value)};
    }
    std::optional<std::int64_t>& value =
        values[static_cast<std::size_t>(parameter - info.parameters.begin())];
    if (value) return Error{fmt::format("{}: {} is given twice; give it once", info.name, key)};
    const Result<std::int64_t> parsed = parse_value(info, *parameter, item.substr(key.size() + 1));
    if (!parsed) return parsed.error();
    value = *parsed;
    return success();
}

/// One value per parameter, in the scene's order.
Result<std::vector<std::int64_t>> parse_values(const NamedSceneInfo& info, std::string_view spec) {
    std::vector<std::optional<std::int64_t>> given(info.parameters.size());
    std::size_t colon = spec.find(':');
    while (colon != std::string_view::npos) {
        spec.remove_prefix(colon + 1);
        colon = spec.find(',');
        if (const Status status = parse_item(info, spec.substr(0, colon), given); !status)
            return status.error();
    }
    std::vector<std::int64_t> values;
    for (std::size_t i = 0; i < given.size(); ++i)
        values.push_back(given[i].value_or(info.parameters[i].default_value));
    return values;
}

}  // namespace

std::span<const NamedSceneInfo> named_scenes() {
    static const auto infos = [] {
        std::array<NamedSceneInfo, std::tuple_size_v<RecipeTable>> all;
        std::transform(recipes().begin(), recipes().end(), all.begin(),
                       [](const SceneRecipe* recipe) { return recipe->info; });
        return all;
    }();
    return infos;
}

bool is_named_scene(std::string_view spec) {
    return find_recipe(name_of(spec)) != nullptr;
}

Result<SceneAndPath> make_named_scene(std::string_view spec) {
    const SceneRecipe* recipe = find_recipe(name_of(spec));
    if (recipe == nullptr) {
        return Error{fmt::format("there is no named scene '{}'; the named scenes are {}", name_of(spec),
                                 listed(named_scenes()))};
    }
    const Result<std::vector<std::int64_t>> values = parse_values(recipe->info, spec);
    if (!values) return values.error();
    const std::string name(spec);
    const SceneSize size = recipe->size(*values);
    const std::uint64_t bytes =
        estimated_scene_bytes(size.triangles, size.vertices, size.bytes_per_vertex) + size.scratch_bytes;
    if (const Status status = check_memory(name, bytes); !status) return status.error();
    try {
        return recipe->build(*values, name);
    } catch (const std::bad_alloc&) {
        return Error{fmt::format("{}: the memory ran out while the scene was built; make it smaller", name)};
    }
}

void add_key(CameraPath& path, double seconds, const glm::dvec3& eye, const glm::dvec3& towards) {
    path.keys.push_back({path.keys.empty() ? 0.0 : path.keys.back().time_s + seconds, eye, eye + towards});
}

Result<SceneAndPath> with_path(Result<Scene> scene, CameraPath path) {
    if (!scene) return scene.error();
    return SceneAndPath{std::move(scene).value(), std::move(path)};
}

}  // namespace rhview
