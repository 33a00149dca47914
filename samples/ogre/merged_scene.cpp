// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "merged_scene.h"

#include <OgreCamera.h>
#include <OgreEntity.h>
#include <OgreHardwareBufferManager.h>
#include <OgreMesh.h>
#include <OgreRenderQueue.h>
#include <OgreSubEntity.h>
#include <OgreSubMesh.h>

#include <glm/geometric.hpp>
#include <map>

namespace {

glm::vec3 to_glm(const Ogre::Vector3& v) {
    return {v.x, v.y, v.z};
}

/// OGRE's matrices are row-major.
template <class Matrix>
glm::dmat4 to_glm(const Matrix& matrix) {
    glm::dmat4 result(1.0);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            result[column][row] = static_cast<double>(matrix[row][column]);
    return result;
}

/// What rhview culls for. OGRE's own projection has OpenGL's depth, whatever the render system.
rhview::View view_of(const Ogre::Camera& camera) {
    return {to_glm(camera.getViewMatrix()), to_glm(camera.getProjectionMatrix()),
            rhview::ClipDepth::NegativeOneToOne};
}

/// Three floats per vertex.
std::vector<Ogre::Vector3> read_vectors(const Ogre::VertexData& vertices,
                                        Ogre::VertexElementSemantic semantic) {
    std::vector<Ogre::Vector3> vectors(vertices.vertexCount, Ogre::Vector3::UNIT_Y);
    const Ogre::VertexElement* element = vertices.vertexDeclaration->findElementBySemantic(semantic);
    if (element == nullptr) return vectors;
    const Ogre::HardwareVertexBufferSharedPtr& buffer =
        vertices.vertexBufferBinding->getBuffer(element->getSource());
    const Ogre::HardwareBufferLockGuard lock(buffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
    const auto* bytes =
        static_cast<const unsigned char*>(lock.pData) + vertices.vertexStart * buffer->getVertexSize();
    for (Ogre::Vector3& vector : vectors) {
        float* numbers = nullptr;
        element->baseVertexPointerToElement(const_cast<unsigned char*>(bytes), &numbers);
        vector = Ogre::Vector3(numbers[0], numbers[1], numbers[2]);
        bytes += buffer->getVertexSize();
    }
    return vectors;
}

std::vector<std::uint32_t> read_indices(const Ogre::IndexData& indices) {
    std::vector<std::uint32_t> numbers(indices.indexCount);
    const Ogre::HardwareBufferLockGuard lock(indices.indexBuffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
    const bool wide = indices.indexBuffer->getType() == Ogre::HardwareIndexBuffer::IT_32BIT;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = wide ? static_cast<const std::uint32_t*>(lock.pData)[indices.indexStart + i]
                          : static_cast<const std::uint16_t*>(lock.pData)[indices.indexStart + i];
    return numbers;
}

}  // namespace

/// One draw call.
class MergedScene::Range final : public Ogre::Renderable {
  public:
    explicit Range(const MergedScene& scene) : scene_(scene) {}

    void set(const Batch& batch, const rhview::DrawRange& range) {
        batch_ = &batch;
        indices_.indexBuffer = scene_.indices_;
        indices_.indexStart = range.first_index;
        indices_.indexCount = range.index_count;
    }

    [[nodiscard]] const Ogre::MaterialPtr& getMaterial() const override { return batch_->material; }
    void getRenderOperation(Ogre::RenderOperation& operation) override {
        operation.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
        operation.vertexData = batch_->vertices.get();
        operation.indexData = &indices_;
        operation.useIndexes = true;
        operation.srcRenderable = this;
    }
    void getWorldTransforms(Ogre::Matrix4* transforms) const override {
        *transforms = Ogre::Matrix4::IDENTITY;
    }
    /// Renderables with holes or glass would be sorted by it; these are neither.
    [[nodiscard]] Ogre::Real getSquaredViewDepth(const Ogre::Camera*) const override { return 0; }
    [[nodiscard]] const Ogre::LightList& getLights() const override { return scene_.queryLights(); }

  private:
    const MergedScene& scene_;
    const Batch* batch_ = nullptr;
    Ogre::IndexData indices_;
};

rhview::Result<std::unique_ptr<MergedScene>> MergedScene::merge(Ogre::SceneManager& source,
                                                                const rhview::DrawCosts& costs) {
    std::map<Ogre::String, Batch> by_material;
    for (const auto& [name, object] : source.getMovableObjects("Entity")) {
        const auto& entity = static_cast<const Ogre::Entity&>(*object);
        for (Ogre::SubEntity* part : entity.getSubEntities()) {
            Batch& batch = by_material[part->getMaterialName()];
            batch.material = part->getMaterial();
            append(*part->getSubMesh(), entity._getParentNodeFullTransform(), batch);
        }
    }
    std::vector<Batch> batches;
    for (auto& [name, batch] : by_material) batches.push_back(std::move(batch));

    std::vector<rhview::TriangleBatch> triangles;
    std::size_t index_count = 0;
    for (std::uint32_t b = 0; b < batches.size(); ++b) {
        triangles.push_back({rhview::MaterialId{b}, batches[b].positions, batches[b].indices});
        index_count += batches[b].indices.size();
    }
    rhview::OctreeOptions options = rhview::choose_octree_options(costs, index_count, triangles.size());
    // Triangles as OGRE's meshes order them: on llvmpipe, ordered by normal they are fewer and take longer
    // all the same (README.md). Measure it where you draw.
    options.normal_order = false;
    rhview::Result<rhview::RhOctree> octree = rhview::build_octree(triangles, options);
    if (!octree) return octree.error();
    return std::unique_ptr<MergedScene>(
        new MergedScene(std::move(batches), std::move(octree).value(), costs));
}

void MergedScene::append(const Ogre::SubMesh& part, const Ogre::Affine3& world_from_mesh, Batch& batch) {
    const Ogre::VertexData& vertices =
        part.useSharedVertices ? *part.parent->sharedVertexData : *part.vertexData;
    const auto first = static_cast<std::uint32_t>(batch.positions.size());
    for (const Ogre::Vector3& position : read_vectors(vertices, Ogre::VES_POSITION))
        batch.positions.push_back(to_glm(world_from_mesh * position));
    const Ogre::Matrix3 turn = world_from_mesh.linear().Inverse().Transpose();
    for (const Ogre::Vector3& normal : read_vectors(vertices, Ogre::VES_NORMAL))
        batch.normals.push_back(to_glm((turn * normal).normalisedCopy()));
    for (const std::uint32_t index : read_indices(*part.indexData)) batch.indices.push_back(first + index);
}

MergedScene::MergedScene(std::vector<Batch> batches, rhview::RhOctree octree, const rhview::DrawCosts& costs)
    : batches_(std::move(batches)), octree_(std::move(octree)), planner_(octree_, costs) {
    bounds_.setInfinite();
    upload();
}

MergedScene::~MergedScene() = default;

void MergedScene::upload() {
    auto& manager = Ogre::HardwareBufferManager::getSingleton();
    for (Batch& batch : batches_) {
        batch.vertices.reset(OGRE_NEW Ogre::VertexData());
        batch.vertices->vertexCount = batch.positions.size();
        Ogre::VertexDeclaration& declaration = *batch.vertices->vertexDeclaration;
        std::size_t offset = 0;
        for (const Ogre::VertexElementSemantic semantic : {Ogre::VES_POSITION, Ogre::VES_NORMAL})
            offset += declaration.addElement(0, offset, Ogre::VET_FLOAT3, semantic).getSize();
        std::vector<glm::vec3> interleaved;
        for (std::size_t i = 0; i < batch.positions.size(); ++i) {
            interleaved.push_back(batch.positions[i]);
            interleaved.push_back(batch.normals[i]);
        }
        const Ogre::HardwareVertexBufferSharedPtr buffer = manager.createVertexBuffer(
            offset, batch.positions.size(), Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
        buffer->writeData(0, buffer->getSizeInBytes(), interleaved.data(), true);
        batch.vertices->vertexBufferBinding->setBinding(0, buffer);
        triangle_count_ += batch.indices.size() / 3;
        batch.positions = {};
        batch.normals = {};
        batch.indices = {};
    }
    // The order that plans refer to: batch after batch, then replicas.
    const std::span<const std::uint32_t> order = octree_.indices();
    indices_ = manager.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_32BIT, order.size(),
                                         Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
    indices_->writeData(0, order.size_bytes(), order.data(), true);
}

const Ogre::String& MergedScene::getMovableType() const {
    static const Ogre::String type = "MergedScene";
    return type;
}

Ogre::Real MergedScene::getBoundingRadius() const {
    return std::numeric_limits<Ogre::Real>::infinity();
}

void MergedScene::_notifyCurrentCamera(Ogre::Camera* camera) {
    MovableObject::_notifyCurrentCamera(camera);
    camera_ = camera;
}

void MergedScene::_updateRenderQueue(Ogre::RenderQueue* queue) {
    planner_.plan({.culling_view = view_of(*camera_)}, plan_);
    while (ranges_.size() < plan_.opaque.size()) ranges_.push_back(std::make_unique<Range>(*this));
    for (std::size_t i = 0; i < plan_.opaque.size(); ++i) {
        ranges_[i]->set(batches_[index_of(plan_.opaque[i].batch)], plan_.opaque[i]);
        queue->addRenderable(ranges_[i].get(), getRenderQueueGroup());
    }
}

void MergedScene::visitRenderables(Ogre::Renderable::Visitor* visitor, bool) {
    for (std::size_t i = 0; i < plan_.opaque.size(); ++i) visitor->visit(ranges_[i].get(), 0, false);
}
