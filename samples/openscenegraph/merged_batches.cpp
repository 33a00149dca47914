// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "merged_batches.h"

#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/TriangleIndexFunctor>

#include <algorithm>

namespace {

struct Triangles {
    std::vector<std::uint32_t> indices;

    void operator()(unsigned a, unsigned b, unsigned c) {
        if (a == b || b == c || a == c) return;
        indices.insert(indices.end(), {a, b, c});
    }
};

class Merger final : public osg::NodeVisitor {
  public:
    using NodeVisitor::apply;

    Merger() : NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Geometry& geometry) override {
        const auto* vertices = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
        const auto* normals = dynamic_cast<const osg::Vec3Array*>(geometry.getNormalArray());
        osg::StateSet* material = geometry.getStateSet();
        if (vertices == nullptr || normals == nullptr || material == nullptr ||
            normals->size() != vertices->size())
            return;
        const osg::Matrix world = osg::computeLocalToWorld(getNodePath());
        const osg::Matrix inverse = osg::Matrix::inverse(world);
        MergedBatch& batch = batch_of(material);
        const auto first = static_cast<std::uint32_t>(batch.positions.size());
        for (std::size_t i = 0; i < vertices->size(); ++i) {
            const osg::Vec3 position = (*vertices)[i] * world;
            batch.positions.emplace_back(position.x(), position.y(), position.z());
            osg::Vec3 normal = osg::Matrix::transform3x3(inverse, (*normals)[i]);
            normal.normalize();
            batch.normals->push_back(normal);
        }
        osg::TriangleIndexFunctor<Triangles> triangles;
        geometry.accept(triangles);
        for (const std::uint32_t index : triangles.indices) batch.indices.push_back(first + index);
    }

    std::vector<MergedBatch> batches;

  private:
    MergedBatch& batch_of(osg::StateSet* material) {
        const auto found = std::ranges::find(batches, material,
                                             [](const MergedBatch& batch) { return batch.material.get(); });
        if (found != batches.end()) return *found;
        batches.emplace_back().material = material;
        return batches.back();
    }
};

}  // namespace

std::vector<MergedBatch> merge_by_material(osg::Node& node) {
    Merger merger;
    node.accept(merger);
    return std::move(merger.batches);
}
