// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Where the objects of a scene are at a time, and how fast they can be.
///
/// Bit-identical on every machine. Objects are numbered as `Scene` numbers them: the dynamic ones first, then
/// the static instances, which stand still.
#pragma once

#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/ids.h"
#include "rhview/scenes/scene.h"

namespace rhview {

/// `scene_from_mesh` of an object at a time, which may be any finite number: its way repeats. At time 0 it is
/// `Scene::object_placement`, to the last bit. Cost: about 0.1 µs.
glm::dmat4 placement_at(const Scene& scene, ObjectId object, double time_s);

/// No point of the object's mesh box moves faster, in units of the scene per second; 0: it stands still.
double top_speed(const Scene& scene, ObjectId object);

/// No point of the object's mesh box is outside at any time: of a moving object all of its way, rounded
/// outwards.
Aabb motion_range(const Scene& scene, ObjectId object);

/// `placement_at` for frame after frame: it remembers on which part of its way each object is, and what that
/// takes lies together, so that many are placed without a miss of the cache for each key.
class ObjectWays {
  public:
    /// `scene` outlives it, and does not change.
    explicit ObjectWays(const Scene& scene);

    /// `placement_at`, to the last bit. Cost: about 0.05 µs while an object stays on one part of its way.
    glm::dmat4 placement_at(ObjectId object, double time_s);
    /// Fetches what `placement_at` reads of an object that is placed some objects later.
    void prefetch(ObjectId object) const;

  private:
    /// Between two keys; of a still object: for ever. Three lines of the cache.
    struct alignas(64) Part {
        glm::dmat4x3 start{1.0};
        double period_s = 0.0;
        double from_s = 0.0, to_s = 0.0;
        glm::dvec3 offset{0.0}, step{0.0};
        double turns = 0.0, turns_step = 0.0;
        std::uint32_t motion = DynamicObject::kStill;
    };
    static_assert(sizeof(Part) == 192);

    void find_part(Part& part, double time) const;

    const Scene& scene_;
    std::vector<Part> parts_;  ///< by dynamic object
};

/// All objects at one time, by `ObjectId`.
struct ObjectPlacements {
    std::vector<glm::dmat4> scene_from_mesh;
    std::vector<Aabb> boxes;  ///< contain what is drawn
};

/// Cost: linear in the moving objects, once `placements` has been filled for this scene; no allocation then.
void place_objects(const Scene& scene, double time_s, ObjectPlacements& placements);

/// By `ObjectId`: objects with equal numbers share mesh and mirroring, and so can share a draw call. Below
/// 2 * meshes.
std::vector<std::uint32_t> object_groups(const Scene& scene);

/// What is wrong with a way, or nothing.
const char* problem_of(const ObjectMotion& motion);

}  // namespace rhview
