// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "plan_drawable.h"

#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/GLExtensions>
#include <osg/Program>
#include <osg/State>
#include <osg/VertexArrayState>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>

namespace {

constexpr const char* kBoxVertexShader = R"(#version 120
uniform vec3 low;
uniform vec3 high;
void main() {
    gl_Position = gl_ModelViewProjectionMatrix * vec4(mix(low, high, gl_Vertex.xyz), 1.0);
})";

constexpr const char* kBoxFragmentShader = "#version 120\nvoid main() { gl_FragColor = vec4(1.0); }";

/// OpenSceneGraph multiplies from the left and stores rows: in memory these are OpenGL's columns.
glm::dmat4 to_glm(const osg::Matrixd& matrix) {
    return glm::make_mat4(matrix.ptr());
}

/// What the current camera sees.
rhview::View view_of(const osg::State& state) {
    return {to_glm(state.getModelViewMatrix()), to_glm(state.getProjectionMatrix()),
            rhview::ClipDepth::NegativeOneToOne};
}

/// Half a pixel, and what rounding moves: a box that is not seen must prove that what it holds is not.
rhview::Aabb widened(const rhview::Aabb& box, const glm::vec3& eye) {
    const glm::vec3 farthest = glm::max(glm::abs(box.min - eye), glm::abs(box.max - eye));
    const glm::vec3 margin(1e-3f * glm::length(farthest));
    return {box.min - margin, box.max + margin};
}

const GLvoid* bind(osg::State& state, const osg::DrawElements& elements, std::size_t byte) {
    osg::GLBufferObject* buffer = elements.getOrCreateGLBufferObject(state.getContextID());
    state.getCurrentVertexArrayState()->bindElementBufferObject(buffer);
    return reinterpret_cast<const GLvoid*>(
        static_cast<std::uintptr_t>(buffer->getOffset(elements.getBufferIndex())) + byte);
}

void set_arrays(osg::State& state, const osg::Array& positions, const osg::Array* normals) {
    osg::VertexArrayState& arrays = *state.getCurrentVertexArrayState();
    arrays.setVertexBufferObjectSupported(true);
    arrays.lazyDisablingOfVertexAttributes();
    arrays.setVertexArray(state, &positions);
    if (normals != nullptr) arrays.setNormalArray(state, normals);
    arrays.applyDisablingOfVertexAttributes(state);
}

osg::ref_ptr<osg::Vec3Array> in_buffer(osg::ref_ptr<osg::Vec3Array> array) {
    array->setBinding(osg::Array::BIND_PER_VERTEX);
    array->setVertexBufferObject(new osg::VertexBufferObject);
    return array;
}

}  // namespace

rhview::Result<osg::ref_ptr<PlanDrawable>> PlanDrawable::create(
    std::vector<MergedBatch> batches, const rhview::DrawCosts& costs,
    const std::optional<rhview::OcclusionOptions>& occlusion, DrawCounter& counter) {
    std::vector<rhview::TriangleBatch> triangles;
    std::size_t index_count = 0;
    for (std::uint32_t b = 0; b < batches.size(); ++b) {
        triangles.push_back({rhview::MaterialId{b}, batches[b].positions, batches[b].indices});
        index_count += batches[b].indices.size();
    }
    rhview::OctreeOptions options = rhview::choose_octree_options(costs, index_count, triangles.size());
    // Triangles as the geometries order them: on llvmpipe, ordered by normal they are fewer and take longer
    // all the same (README.md). Measure it where you draw.
    options.normal_order = false;
    rhview::Result<rhview::RhOctree> octree = rhview::build_octree(triangles, options);
    if (!octree) return octree.error();
    return osg::ref_ptr<PlanDrawable>(
        new PlanDrawable(std::move(batches), std::move(octree).value(), costs, occlusion, counter));
}

PlanDrawable::PlanDrawable(std::vector<MergedBatch> batches, rhview::RhOctree octree,
                           const rhview::DrawCosts& costs,
                           const std::optional<rhview::OcclusionOptions>& occlusion, DrawCounter& counter)
    : octree_(std::move(octree)), counter_(counter), planner_(octree_, costs, occlusion) {
    setSupportsDisplayList(false);
    setDataVariance(DYNAMIC);  // the next frame is not culled while this one plans
    setCullingActive(false);   // what of it is drawn is rhview's to say
    // Its own, though nothing is in it: then what the nodes above it set is on the state's stack, to which
    // materials are added; and nothing else is drawn with the state that drawing this leaves behind.
    getOrCreateStateSet();
    for (MergedBatch& batch : batches) {
        osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
        positions->reserve(batch.positions.size());
        for (const glm::vec3& p : batch.positions) positions->push_back({p.x, p.y, p.z});
        batches_.push_back({batch.material, in_buffer(positions), in_buffer(batch.normals)});
    }
    order_ = new osg::DrawElementsUInt(GL_TRIANGLES, octree_.indices().begin(), octree_.indices().end());
    order_->setElementBufferObject(new osg::ElementBufferObject);
    if (occlusion) make_box_state();
}

void PlanDrawable::make_box_state() {
    cube_ = new osg::Vec3Array;
    for (int i = 0; i < 8; ++i)
        cube_->push_back(
            {static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)});
    cube_ = in_buffer(cube_);
    constexpr GLushort kFaces[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    cube_faces_ = new osg::DrawElementsUShort(GL_TRIANGLES, std::begin(kFaces), std::end(kFaces));
    cube_faces_->setElementBufferObject(new osg::ElementBufferObject);

    // Against the depth that is there, from both sides, and without a trace.
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, kBoxVertexShader));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, kBoxFragmentShader));
    box_state_ = new osg::StateSet;
    box_state_->setAttributeAndModes(program);
    box_state_->setAttributeAndModes(new osg::ColorMask(false, false, false, false));
    box_state_->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    box_state_->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
}

osg::BoundingBox PlanDrawable::computeBoundingBox() const {
    osg::BoundingBox box;
    for (const Batch& batch : batches_)
        for (const osg::Vec3& position : *batch.positions) box.expandBy(position);
    return box;
}

void PlanDrawable::drawImplementation(osg::RenderInfo& info) const {
    osg::State& state = *info.getState();
    plan_frame(state);
    draw_at_once(state);
    if (!plan_.queries.empty()) {
        ask(state);
        draw_conditionally(state);
    }
    state.getCurrentVertexArrayState()->unbindVertexBufferObject();
    state.getCurrentVertexArrayState()->unbindElementBufferObject();
}

void PlanDrawable::plan_frame(const osg::State& state) const {
    absorb_answers(state);
    const osg::Viewport& viewport = *state.getCurrentViewport();
    planner_.plan(
        {.culling_view = view_of(state),
         .viewport_pixels = {static_cast<int>(viewport.width()), static_cast<int>(viewport.height())}},
        plan_);
}

/// Those that have come: none is waited for.
void PlanDrawable::absorb_answers(const osg::State& state) const {
    const auto& gl = *state.get<osg::GLExtensions>();
    answers_.clear();
    std::erase_if(asked_, [&](const Question& question) {
        GLuint available = 0, seen = 0;
        gl.glGetQueryObjectuiv(question.query, GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == 0) return false;
        gl.glGetQueryObjectuiv(question.query, GL_QUERY_RESULT, &seen);
        answers_.push_back({question.ticket, seen != 0});
        spare_.push_back(question.query);
        return true;
    });
    planner_.absorb(answers_);
}

void PlanDrawable::draw_at_once(osg::State& state) const {
    for (std::size_t i = 0; i < plan_.opaque.size();) {
        const rhview::BatchId batch = plan_.opaque[i].batch;
        state.pushStateSet(batches_[rhview::index_of(batch)].material);
        use(state, batches_[rhview::index_of(batch)]);
        for (; i < plan_.opaque.size() && plan_.opaque[i].batch == batch; ++i) draw(state, plan_.opaque[i]);
        state.popStateSet();
    }
}

void PlanDrawable::ask(osg::State& state) const {
    const auto& gl = *state.get<osg::GLExtensions>();
    const glm::vec3 eye(view_of(state).eye());
    state.pushStateSet(box_state_);
    state.apply();
    set_arrays(state, *cube_, nullptr);
    const GLvoid* faces = bind(state, *cube_faces_, 0);
    const osg::Program::PerContextProgram& program = *state.getLastAppliedProgramObject();
    const GLint low = program.getUniformLocation("low"), high = program.getUniformLocation("high");
    frame_.clear();
    for (const rhview::PlannedQuery& query : plan_.queries) {
        frame_.push_back(query_object(gl));
        asked_.push_back({query.ticket, frame_.back()});
        gl.glBeginQuery(GL_ANY_SAMPLES_PASSED, frame_.back());
        for (std::uint32_t b = 0; b < query.box_count; ++b) {
            const rhview::Aabb box = widened(plan_.query_boxes[query.first_box + b], eye);
            gl.glUniform3fv(low, 1, glm::value_ptr(box.min));
            gl.glUniform3fv(high, 1, glm::value_ptr(box.max));
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(cube_faces_->size()), GL_UNSIGNED_SHORT, faces);
            counter_.count(cube_faces_->size());
        }
        gl.glEndQuery(GL_ANY_SAMPLES_PASSED);
    }
    state.popStateSet();
}

/// The GPU decides; the CPU does not wait for it.
void PlanDrawable::draw_conditionally(osg::State& state) const {
    const auto& gl = *state.get<osg::GLExtensions>();
    for (std::size_t i = 0; i < plan_.conditional.size();) {
        const rhview::BatchId batch = plan_.conditional[i].range.batch;
        state.pushStateSet(batches_[rhview::index_of(batch)].material);
        use(state, batches_[rhview::index_of(batch)]);
        for (; i < plan_.conditional.size() && plan_.conditional[i].range.batch == batch; ++i) {
            gl.glBeginConditionalRender(frame_[plan_.conditional[i].query], GL_QUERY_WAIT);
            draw(state, plan_.conditional[i].range);
            gl.glEndConditionalRender();
        }
        state.popStateSet();
    }
}

void PlanDrawable::use(osg::State& state, const Batch& batch) const {
    state.apply();
    set_arrays(state, *batch.positions, batch.normals);
}

void PlanDrawable::draw(osg::State& state, const rhview::DrawRange& range) const {
    const GLvoid* first = bind(state, *order_, std::size_t{range.first_index} * sizeof(GLuint));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.index_count), GL_UNSIGNED_INT, first);
    counter_.count(range.index_count);
}

GLuint PlanDrawable::query_object(const osg::GLExtensions& gl) const {
    if (spare_.empty()) {
        spare_.resize(64);
        gl.glGenQueries(static_cast<GLsizei>(spare_.size()), spare_.data());
    }
    const GLuint query = spare_.back();
    spare_.pop_back();
    return query;
}
