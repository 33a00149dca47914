// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "baked_scene_check.h"

#include <cmath>
#include <limits>

#include "placement.h"
#include "rhview/base/index_check.h"
#include "rhview/scenes/object_motion.h"

namespace rhview {
namespace {

bool is_box(const Aabb& box) {
    return !box.is_empty() && is_finite(box.min) && is_finite(box.max);
}

bool is_affine(const glm::dmat4& matrix) {
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return matrix[0][3] == 0.0 && matrix[1][3] == 0.0 && matrix[2][3] == 0.0 && matrix[3][3] == 1.0;
}

/// What batches and meshes have in common; the problem, or nothing.
template <class Part>
const char* problem_of(const Scene& scene, const Part& part) {
    if (index_of(part.material) >= scene.materials.size()) return "its material is not in the list";
    if (part.pool >= scene.pools.size()) return "its vertex pool is not in the list";
    if (part.indices.size() % 3 != 0) return "its index count is no multiple of three";
    if (part.indices.size() >= std::numeric_limits<std::uint32_t>::max())
        return "it has 2^32 indices or more";
    if (!all_below(part.indices.span(), scene.pools[part.pool].positions.size()))
        return "an index is not below its number of vertices";
    return nullptr;
}

const char* problem_of(const Scene& scene, const StaticInstance& instance) {
    if (index_of(instance.mesh) >= scene.meshes.size()) return "its mesh is not in the list";
    if (!can_be_drawn_through(instance.scene_from_mesh)) return "its placement can't be drawn through";
    return is_box(instance.bounds) ? nullptr : "its box is none";
}

/// Numbers for reports: none of them is a count of anything in the file.
bool is_sound(const InstancingReport& report) {
    for (const double ns : {report.all_kept_ns, report.all_flattened_ns, report.chosen_ns})
        if (!(ns >= 0.0 && std::isfinite(ns))) return false;
    return true;
}

const char* problem_of_objects(const SceneBatch& batch) {
    std::uint64_t next = 0;
    for (const SceneObject& object : batch.objects) {
        if (object.first_index != next || object.index_count % 3 != 0)
            return "its objects don't follow one another";
        if (!is_box(object.bounds)) return "an object's box is none";
        next += object.index_count;
    }
    return next == batch.indices.size() ? nullptr : "its objects don't cover its indices";
}

Status check_lists(const RhoFile& file, const Scene& scene) {
    const auto error = [&](const std::string& what, std::size_t number, const char* problem) {
        return file.error(kSceneDescription, what + " " + std::to_string(number) + ": " + problem);
    };
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (!is_finite(scene.materials[i].colour)) return error("material", i, "its colour is not finite");
    for (std::size_t i = 0; i < scene.batches.size(); ++i) {
        if (const char* problem = problem_of(scene, scene.batches[i])) return error("batch", i, problem);
        if (const char* problem = problem_of_objects(scene.batches[i])) return error("batch", i, problem);
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (const char* problem = problem_of(scene, scene.meshes[i])) return error("mesh", i, problem);
        if (!is_box(scene.meshes[i].bounds)) return error("mesh", i, "its box is none");
    }
    if (scene.index_bytes() / sizeof(std::uint32_t) >= std::numeric_limits<std::uint32_t>::max())
        return file.error(kSceneDescription, "there are 2^32 indices or more");
    for (std::size_t i = 0; i < scene.dynamic_objects.size(); ++i) {
        if (index_of(scene.dynamic_objects[i].mesh) >= scene.meshes.size())
            return error("object", i, "its mesh is not in the list");
        if (!is_affine(scene.dynamic_objects[i].scene_from_mesh))
            return error("object", i, "its placement is not affine");
        if (const std::uint32_t motion = scene.dynamic_objects[i].motion;
            motion != DynamicObject::kStill && motion >= scene.motions.size())
            return error("object", i, "its way is not in the list");
    }
    for (std::size_t i = 0; i < scene.motions.size(); ++i)
        if (const char* problem = problem_of(scene.motions[i])) return error("way", i, problem);
    for (std::size_t i = 0; i < scene.static_instances.size(); ++i)
        if (const char* problem = problem_of(scene, scene.static_instances[i]))
            return error("instance", i, problem);
    return success();
}

}  // namespace

Status check_baked_scene(const RhoFile& file, const SceneAndPath& loaded) {
    const glm::dvec3& origin = loaded.scene.origin;
    if (!std::isfinite(origin.x) || !std::isfinite(origin.y) || !std::isfinite(origin.z))
        return file.error(kSceneDescription, "the scene's origin is not finite");
    if (Status status = check_lists(file, loaded.scene); !status) return status;
    if (!is_sound(loaded.scene.instancing))
        return file.error(kSceneDescription, "a modelled time of its instances is none");
    if (loaded.scene.batches.empty() && loaded.scene.object_count() == 0)
        return file.error(kSceneDescription, "the scene holds nothing to draw");
    if (Status status = validate(loaded.path); !status)
        return file.error(kSceneDescription, "the camera path: " + status.error().message);
    return success();
}

}  // namespace rhview
