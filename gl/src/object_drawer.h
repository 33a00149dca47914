// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/base/view.h"
#include "rhview/gl/handle.h"
#include "rhview/gl/scene_buffers.h"
#include "rhview/pipeline/frame_plan.h"

namespace rhview::gl {

/// Whether a map turns front faces into back faces.
bool is_mirrored(const glm::dmat4& scene_from_mesh);

/// Neighbours in a plan that one instanced call draws: of one mesh, level and mirroring, on one query.
struct ObjectRun {
    const MeshState* mesh = nullptr;
    LevelRange range;
    std::uint32_t first_instance = 0;
    std::uint32_t instances = 0;
    std::uint32_t query = 0;  ///< of conditional ones
    std::uint8_t level = 0;
    bool mirrored = false;

    [[nodiscard]] std::uint64_t indices() const { return std::uint64_t{range.index_count} * instances; }
    /// Whether nothing but the indices has to be changed between the two.
    [[nodiscard]] bool shares_state(const ObjectRun& other) const {
        return mesh == other.mesh && mirrored == other.mirrored;
    }
};

/// Where an instance is, as its shader reads it: the same arithmetic as of static triangles, in the mesh's
/// own space.
struct InstanceData {
    glm::mat4 clip_from_relative{1.0f};
    glm::vec3 eye_high{0.0f};
    float handedness = 1.0f;  ///< -1: mirrored
    glm::vec3 eye_low{0.0f};
    float unused = 0.0f;
    glm::vec4 scene_from_mesh[3]{};  ///< the linear part, for shading
};
static_assert(sizeof(InstanceData) == 144);

/// Draws the objects of a plan. An object goes the same way whatever stands beside it and however many are
/// drawn in its call, so its depths are the same to the last bit.
class ObjectDrawer {
  public:
    static Result<ObjectDrawer> create(const char* fragment_shader);

    /// Places the objects of `plan` for `view`, without the conditional ones if these are `late`, and finds
    /// its runs. `placements` by `ObjectId`; empty: those of the scene. Cost: about 0.1 µs per object, and
    /// 144 bytes of upload.
    void place(const FramePlan& plan, const SceneBuffers& scene, const View& view,
               std::span<const glm::dmat4> placements, bool late = false);
    /// In their stead those conditional objects whose places are named.
    void place_late(const FramePlan& plan, std::span<const std::uint32_t> places, const SceneBuffers& scene,
                    const View& view, std::span<const glm::dmat4> placements);
    [[nodiscard]] std::span<const ObjectRun> at_once() const { return at_once_; }
    [[nodiscard]] std::span<const ObjectRun> conditional() const { return conditional_; }
    /// The largest `rounding_growth` of any object that queries can be about: of the scenes that were asked
    /// about, and of all that was placed when something was asked. It never falls, since a plan need not name
    /// what its queries are about: latent mode leaves out what they say of objects that it drew earlier.
    [[nodiscard]] double largest_growth() const { return largest_growth_; }

    void begin(const std::optional<glm::vec3>& colour) const;
    void set_state(const ObjectRun& run) const;
    static void draw(const ObjectRun& run);

  private:
    struct Eye;
    /// What objects are placed from.
    struct Ground;
    void add(const Ground& ground, std::vector<ObjectRun>& runs, const ConditionalObject& object);
    void add_conditional(const Ground& ground, std::span<const ConditionalObject> objects, std::size_t count,
                         const auto& place_of);
    void place_one(const Eye& eye, const glm::dmat4& scene_from_mesh, bool asks, InstanceData& data);
    static void append(std::vector<ObjectRun>& runs, const ObjectRun& one);
    void upload() const;

    Program program_;
    int override_colour_ = -1;
    Buffer instances_;
    std::vector<InstanceData> data_;
    std::vector<ObjectRun> at_once_, conditional_;
    double largest_growth_ = 1.0;
};

}  // namespace rhview::gl
