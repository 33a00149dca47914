// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Merged triangles as a drawable of OpenSceneGraph that plans with rhview and executes the plan.
#pragma once

#include <osg/Drawable>
#include <osg/PrimitiveSet>

#include <memory>
#include <optional>
#include <vector>

#include "draw_counter.h"
#include "merged_batches.h"
#include "rhview/base/result.h"
#include "rhview/pipeline/rhview_planner.h"

/// For one camera of one graphics context: it remembers what that camera saw. It plans and draws on the
/// thread that draws, whatever the viewer's threading model. Give it to a node with nothing else in it.
class PlanDrawable final : public osg::Drawable {
  public:
    /// Builds the octree. With `occlusion` it asks the GPU what is hidden. `counter` lives as long as it.
    static rhview::Result<osg::ref_ptr<PlanDrawable>> create(
        std::vector<MergedBatch> batches, const rhview::DrawCosts& costs,
        const std::optional<rhview::OcclusionOptions>& occlusion, DrawCounter& counter);

    [[nodiscard]] std::size_t batch_count() const { return batches_.size(); }
    [[nodiscard]] std::size_t triangle_count() const { return octree_.base_index_count() / 3; }
    /// Of the last frame.
    [[nodiscard]] const rhview::FramePlan& plan() const { return plan_; }

    void drawImplementation(osg::RenderInfo& info) const override;
    [[nodiscard]] osg::BoundingBox computeBoundingBox() const override;

  protected:
    ~PlanDrawable() override = default;

  private:
    struct Batch {
        osg::ref_ptr<osg::StateSet> material;
        osg::ref_ptr<osg::Vec3Array> positions, normals;
    };
    /// A query that was asked; its object is given back when the answer is there.
    struct Question {
        std::uint64_t ticket = 0;
        GLuint query = 0;
    };

    PlanDrawable(std::vector<MergedBatch> batches, rhview::RhOctree octree, const rhview::DrawCosts& costs,
                 const std::optional<rhview::OcclusionOptions>& occlusion, DrawCounter& counter);
    void make_box_state();

    void plan_frame(const osg::State& state) const;
    void absorb_answers(const osg::State& state) const;
    void draw_at_once(osg::State& state) const;
    void ask(osg::State& state) const;
    void draw_conditionally(osg::State& state) const;
    void use(osg::State& state, const Batch& batch) const;
    void draw(osg::State& state, const rhview::DrawRange& range) const;
    [[nodiscard]] GLuint query_object(const osg::GLExtensions& gl) const;

    std::vector<Batch> batches_;
    rhview::RhOctree octree_;
    osg::ref_ptr<osg::DrawElementsUInt> order_;  ///< the octree's indices: what plans refer to
    // Boxes of queries: a cube that the shader stretches.
    osg::ref_ptr<osg::StateSet> box_state_;
    osg::ref_ptr<osg::Vec3Array> cube_;
    osg::ref_ptr<osg::DrawElementsUShort> cube_faces_;
    DrawCounter& counter_;

    // OpenSceneGraph draws what is const; only the thread that draws comes here.
    mutable rhview::RhviewPlanner planner_;
    mutable rhview::FramePlan plan_;
    mutable std::vector<Question> asked_;        ///< in flight, the oldest first
    mutable std::vector<GLuint> frame_, spare_;  ///< query objects: by query of the plan; unused
    mutable std::vector<rhview::QueryAnswer> answers_;
};
