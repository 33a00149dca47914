// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Static OGRE entities, merged by material and culled by rhview; OGRE still draws them, with their own
// materials.
#pragma once

#include <OgreMovableObject.h>
#include <OgreRenderable.h>
#include <OgreSceneManager.h>

#include <memory>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/pipeline/rhview_planner.h"

/// Attach it to a node of any scene manager, best one without entities that it holds too: it plans when a
/// camera is about to render, and gives OGRE one renderable per draw call. It is never outside of a camera's
/// view; what of it is drawn is rhview's to say.
class MergedScene final : public Ogre::MovableObject {
  public:
    /// Copies the triangles of all entities of `source`, where their nodes are now, and builds the octree.
    /// The buffers of their meshes must be readable: shadowed, or not write-only.
    static rhview::Result<std::unique_ptr<MergedScene>> merge(Ogre::SceneManager& source,
                                                              const rhview::DrawCosts& costs);
    ~MergedScene() override;

    [[nodiscard]] std::size_t triangle_count() const { return triangle_count_; }
    [[nodiscard]] std::size_t batch_count() const { return batches_.size(); }
    /// Of the last frame.
    [[nodiscard]] const rhview::FramePlan& plan() const { return plan_; }

    [[nodiscard]] const Ogre::String& getMovableType() const override;
    [[nodiscard]] const Ogre::AxisAlignedBox& getBoundingBox() const override { return bounds_; }
    [[nodiscard]] Ogre::Real getBoundingRadius() const override;
    void _notifyCurrentCamera(Ogre::Camera* camera) override;
    void _updateRenderQueue(Ogre::RenderQueue* queue) override;
    void visitRenderables(Ogre::Renderable::Visitor* visitor, bool debug) override;

  private:
    /// All triangles of one material.
    struct Batch {
        Ogre::MaterialPtr material;
        std::vector<glm::vec3> positions, normals;
        std::vector<std::uint32_t> indices;
        std::unique_ptr<Ogre::VertexData> vertices;
    };
    class Range;

    MergedScene(std::vector<Batch> batches, rhview::RhOctree octree, const rhview::DrawCosts& costs);
    static void append(const Ogre::SubMesh& part, const Ogre::Affine3& world_from_mesh, Batch& batch);
    void upload();

    std::vector<Batch> batches_;
    rhview::RhOctree octree_;
    rhview::RhviewPlanner planner_;
    rhview::FramePlan plan_;
    Ogre::HardwareIndexBufferSharedPtr indices_;
    std::vector<std::unique_ptr<Range>> ranges_;  ///< used again every frame
    Ogre::AxisAlignedBox bounds_;
    Ogre::Camera* camera_ = nullptr;
    std::size_t triangle_count_ = 0;
};
