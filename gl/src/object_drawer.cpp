// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "object_drawer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "attributes.h"
#include "program.h"
#include "rhview/base/assert.h"
#include "rhview/base/prefetch.h"
#include "rhview/base/rounding.h"
#include "rhview/pipeline/query_boxes.h"

namespace rhview::gl {
namespace {

// The executor's transform, from attributes that change with the instance. The cofactor matrix carries
// normals through any affine map.
constexpr const char* kVertexShader = R"(#version 430 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 colour;
layout(location = 3) in mat4 clip_from_relative;
layout(location = 7) in vec4 eye_high;
layout(location = 8) in vec4 eye_low;
layout(location = 9) in mat3 scene_from_mesh;
out vec3 relative;
out vec3 surface_normal;
out vec3 surface_colour;
invariant gl_Position;
void main() {
    precise vec3 from_eye = (position - eye_high.xyz) - eye_low.xyz;
    precise vec4 clip = clip_from_relative * vec4(from_eye, 1.0);
    gl_Position = clip;
    relative = scene_from_mesh * from_eye;
    mat3 cofactor = mat3(cross(scene_from_mesh[1], scene_from_mesh[2]),
                         cross(scene_from_mesh[2], scene_from_mesh[0]),
                         cross(scene_from_mesh[0], scene_from_mesh[1]));
    vec3 n = cofactor * normal.xyz;
    surface_normal = dot(normal.xyz, normal.xyz) > 0.01 ? eye_high.w * normalize(n) : vec3(0.0);
    surface_colour = colour.rgb;
}
)";

const void* index_offset(std::uint32_t first_index) {
    return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(first_index) * sizeof(std::uint32_t));
}

}  // namespace

bool is_mirrored(const glm::dmat4& scene_from_mesh) {
    return glm::determinant(glm::dmat3(scene_from_mesh)) < 0.0;
}

/// What of the view all objects share.
struct ObjectDrawer::Eye {
    Eye(const View& view, const glm::dvec3& origin)
        : position(view.eye() - origin), clip_from_relative(view.clip_from_eye_relative()) {}

    glm::dvec3 position;
    glm::dmat4 clip_from_relative;
};

Result<ObjectDrawer> ObjectDrawer::create(const char* fragment_shader) {
    Result<Program> program = link_program(kVertexShader, fragment_shader);
    if (!program) return program.error();
    ObjectDrawer drawer;
    drawer.program_ = std::move(program).value();
    drawer.override_colour_ = glGetUniformLocation(drawer.program_.name(), "override_colour");
    GLuint name = 0;
    glGenBuffers(1, &name);
    drawer.instances_ = Buffer(name);
    return drawer;
}

void ObjectDrawer::place_one(const Eye& eye, const glm::dmat4& scene_from_mesh, bool asks,
                             InstanceData& data) {
    const glm::dmat3 linear(scene_from_mesh), inverse(glm::inverse(linear));
    const SplitPosition split = split_position(inverse * (eye.position - glm::dvec3(scene_from_mesh[3])));
    const glm::dmat4& clip = eye.clip_from_relative;
    for (int column = 0; column < 3; ++column) {
        const glm::dvec3& axis = linear[column];
        data.clip_from_relative[column] = glm::vec4(clip[0] * axis.x + clip[1] * axis.y + clip[2] * axis.z);
        data.scene_from_mesh[column] = glm::vec4(glm::vec3(axis), 0.0f);
    }
    data.clip_from_relative[3] = glm::vec4(clip[3]);
    data.eye_high = split.high;
    data.eye_low = split.low;
    data.handedness = glm::determinant(linear) < 0.0 ? -1.0f : 1.0f;
    if (asks) largest_growth_ = std::max(largest_growth_, rounding_growth(linear, inverse));
}

void ObjectDrawer::append(std::vector<ObjectRun>& runs, const ObjectRun& one) {
    if (!runs.empty()) {
        ObjectRun& last = runs.back();
        if (last.shares_state(one) && last.level == one.level && last.query == one.query) {
            ++last.instances;
            return;
        }
    }
    runs.push_back(one);
}

struct ObjectDrawer::Ground {
    Ground(const SceneBuffers& buffers, const View& view, std::span<const glm::dmat4> given, bool is_asked)
        : scene(buffers),
          eye(view, buffers.origin()),
          placements(given.empty() ? buffers.placements() : given),
          asks(is_asked) {
        RHVIEW_ASSERT(placements.size() >= scene.object_meshes().size());
    }

    const SceneBuffers& scene;
    Eye eye;
    std::span<const glm::dmat4> placements;
    bool asks;  ///< something is asked in this frame
};

void ObjectDrawer::add(const Ground& ground, std::vector<ObjectRun>& runs, const ConditionalObject& object) {
    const std::size_t id = index_of(object.object);
    const std::uint32_t mesh = ground.scene.object_meshes()[id];
    const auto place = static_cast<std::uint32_t>(data_.size());
    InstanceData& data = data_.emplace_back();
    place_one(ground.eye, ground.placements[id], ground.asks, data);
    append(runs, {&ground.scene.meshes()[mesh], ground.scene.level_range(mesh, object.level), place, 1,
                  object.query, object.level, data.handedness < 0.0f});
}

void ObjectDrawer::add_conditional(const Ground& ground, std::span<const ConditionalObject> objects,
                                   std::size_t count, const auto& place_of) {
    conditional_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        if (i + kPrefetchSteps < count)
            prefetch(&ground.placements[index_of(objects[place_of(i + kPrefetchSteps)].object)]);
        add(ground, conditional_, objects[place_of(i)]);
    }
}

void ObjectDrawer::place(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                         std::span<const glm::dmat4> placements, bool late) {
    RHVIEW_ASSERT(plan.object_levels.empty() || plan.object_levels.size() == plan.objects.size());
    const Ground ground(scene, view, placements, !plan.queries.empty());
    if (ground.asks) largest_growth_ = std::max(largest_growth_, scene.largest_growth());
    data_.clear();
    at_once_.clear();
    for (std::size_t i = 0; i < plan.objects.size(); ++i)
        add(ground, at_once_, {plan.objects[i], 0, plan.level_of_object(i)});
    add_conditional(ground, plan.conditional_objects, late ? 0 : plan.conditional_objects.size(),
                    [](std::size_t i) { return i; });
    if (!data_.empty()) upload();
}

void ObjectDrawer::place_late(const FramePlan& plan, std::span<const std::uint32_t> places,
                              const SceneBuffers& scene, const View& view,
                              std::span<const glm::dmat4> placements) {
    data_.clear();
    add_conditional(Ground(scene, view, placements, true), plan.conditional_objects, places.size(),
                    [&](std::size_t i) { return places[i]; });
    if (!data_.empty()) upload();
}

void ObjectDrawer::upload() const {
    const auto bytes = static_cast<GLsizeiptr>(data_.size() * sizeof(InstanceData));
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    // New storage, so that the device may go on reading the old.
    glBufferData(GL_ARRAY_BUFFER, bytes, data_.data(), GL_STREAM_DRAW);
}

void ObjectDrawer::begin(const std::optional<glm::vec3>& colour) const {
    glUseProgram(program_.name());
    const glm::vec3 c = colour.value_or(glm::vec3(0.0f));
    glUniform4f(override_colour_, c.r, c.g, c.b, colour ? 1.0f : 0.0f);
}

void ObjectDrawer::set_state(const ObjectRun& run) const {
    const DrawState& state = run.mesh->state;
    glBindVertexArray(run.mesh->instanced_array);
    glBindVertexBuffer(kInstanceBinding, instances_.name(), 0, sizeof(InstanceData));
    glVertexAttrib4f(kNormalAttribute, 0.0f, 0.0f, 0.0f, 0.0f);
    if (!state.vertex_colours)
        glVertexAttrib4f(kColourAttribute, state.colour.r, state.colour.g, state.colour.b, 1.0f);
    state.two_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    glFrontFace(run.mirrored ? GL_CW : GL_CCW);
}

void ObjectDrawer::draw(const ObjectRun& run) {
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(run.range.index_count),
                                        GL_UNSIGNED_INT, index_offset(run.range.first_index),
                                        static_cast<GLsizei>(run.instances), run.first_instance);
}

}  // namespace rhview::gl
