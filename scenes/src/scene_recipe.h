// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What each procedural scene tells the table of named scenes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "rhview/scenes/named_scene.h"

namespace rhview {

/// One per parameter of the scene, in its order, each in its range.
using ParameterValues = std::span<const std::int64_t>;

/// An upper bound of what a scene takes, known before it is built.
struct SceneSize {
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint64_t bytes_per_vertex = 0;
    std::uint64_t scratch_bytes = 0;
};

struct SceneRecipe {
    NamedSceneInfo info;
    SceneSize (*size)(ParameterValues values) = nullptr;
    Result<SceneAndPath> (*build)(ParameterValues values, const std::string& name) = nullptr;
};

const SceneRecipe& town_recipe();
const SceneRecipe& plant_recipe();
const SceneRecipe& indoor_recipe();
const SceneRecipe& farm_recipe();
const SceneRecipe& city_recipe();
const SceneRecipe& crowd_recipe();
const SceneRecipe& swarm_recipe();
const SceneRecipe& spheres_recipe();
const SceneRecipe& soup_recipe();

inline constexpr std::int64_t kLargestSeed = 4'294'967'295;

/// Appends a key `seconds` after the last one that looks along `towards`; the first is at 0 whatever
/// `seconds` says.
void add_key(CameraPath& path, double seconds, const glm::dvec3& eye, const glm::dvec3& towards);

/// The scene with its path, or why the builder refused it.
Result<SceneAndPath> with_path(Result<Scene> scene, CameraPath path);

}  // namespace rhview
