// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// The triangles of a scene graph, joined by material where they stand.
#pragma once

#include <osg/Array>
#include <osg/Node>
#include <osg/StateSet>

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

/// All triangles of one state set.
struct MergedBatch {
    osg::ref_ptr<osg::StateSet> material;
    std::vector<glm::vec3> positions;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    std::vector<std::uint32_t> indices;
};

/// Of all geometries below `node`, in its coordinates, in the order in which they are found. Their materials
/// are told apart by their own state sets; those of the nodes above them stay with the nodes. A geometry
/// without one, or without normals per vertex, is left out.
std::vector<MergedBatch> merge_by_material(osg::Node& node);
