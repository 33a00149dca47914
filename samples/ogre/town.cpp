// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "town.h"

#include <OgreEntity.h>
#include <OgreHardwareBufferManager.h>
#include <OgreHighLevelGpuProgram.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgreMesh.h>
#include <OgreMeshManager.h>
#include <OgreSubMesh.h>
#include <OgreTechnique.h>

#include <array>
#include <cmath>
#include <vector>

namespace {

const Ogre::String kGroup = Ogre::RGN_DEFAULT;

constexpr const char* kVertexShader = R"(#version 330 core
in vec4 vertex;
in vec3 normal;
uniform mat4 world;
uniform mat4 clip_from_world;
out vec3 direction;
void main() {
    gl_Position = clip_from_world * (world * vertex);
    direction = mat3(world) * normal;
})";

constexpr const char* kFragmentShader = R"(#version 330 core
in vec3 direction;
uniform vec4 colour;
out vec4 pixel;
void main() {
    float light = 0.4 + 0.6 * max(dot(normalize(direction), normalize(vec3(1.0, 2.0, 0.5))), 0.0);
    pixel = vec4(colour.rgb * light, 1.0);
})";

void make_programs() {
    auto& manager = Ogre::HighLevelGpuProgramManager::getSingleton();
    const auto vertex = manager.createProgram("town_vertex", kGroup, "glsl", Ogre::GPT_VERTEX_PROGRAM);
    vertex->setSource(kVertexShader);
    vertex->load();
    const Ogre::GpuProgramParametersSharedPtr parameters = vertex->getDefaultParameters();
    parameters->setNamedAutoConstant("world", Ogre::GpuProgramParameters::ACT_WORLD_MATRIX);
    parameters->setNamedAutoConstant("clip_from_world", Ogre::GpuProgramParameters::ACT_VIEWPROJ_MATRIX);
    const auto fragment = manager.createProgram("town_fragment", kGroup, "glsl", Ogre::GPT_FRAGMENT_PROGRAM);
    fragment->setSource(kFragmentShader);
    fragment->load();
}

void make_material(const char* name, const Ogre::ColourValue& colour) {
    const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(name, kGroup);
    Ogre::Pass& pass = *material->getTechnique(0)->getPass(0);
    pass.setVertexProgram("town_vertex");
    pass.setFragmentProgram("town_fragment");
    pass.getFragmentProgramParameters()->setNamedConstant("colour", colour);
}

/// Triangles of one mesh, flat ones with vertices of their own.
struct Shape {
    std::vector<Ogre::Vector3> vertices;  ///< position, normal, position, normal…
    std::vector<std::uint16_t> indices;
    Ogre::AxisAlignedBox bounds;

    /// Counter-clockwise, seen from outside.
    void add_face(std::initializer_list<Ogre::Vector3> corners) {
        const auto first = static_cast<std::uint16_t>(vertices.size() / 2);
        const Ogre::Vector3* c = corners.begin();
        const Ogre::Vector3 normal = (c[1] - c[0]).crossProduct(c[2] - c[0]).normalisedCopy();
        for (const Ogre::Vector3& corner : corners) {
            vertices.push_back(corner);
            vertices.push_back(normal);
            bounds.merge(corner);
        }
        for (std::uint16_t i = 2; i < corners.size(); ++i)
            for (const int k : {0, i - 1, static_cast<int>(i)})
                indices.push_back(static_cast<std::uint16_t>(first + k));
    }

    void add_box(const Ogre::Vector3& a, const Ogre::Vector3& b) {
        const auto corner = [&](int i) {
            return Ogre::Vector3(i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z);
        };
        for (const auto& f :
             {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
            add_face({corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])});
    }

    /// A body of revolution about y.
    void add_turned(const std::vector<Ogre::Vector2>& profile, int segments) {
        const auto at = [&](std::size_t ring, int segment) {
            const float turn = 6.2831853f * static_cast<float>(segment) / static_cast<float>(segments);
            return Ogre::Vector3(profile[ring].x * std::cos(turn), profile[ring].y,
                                 profile[ring].x * std::sin(turn));
        };
        for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring)
            for (int s = 0; s < segments; ++s) {
                if (profile[ring].x > 0.0f) add_face({at(ring, s), at(ring + 1, s), at(ring, s + 1)});
                if (profile[ring + 1].x > 0.0f)
                    add_face({at(ring, s + 1), at(ring + 1, s), at(ring + 1, s + 1)});
            }
    }
};

void make_mesh(const char* name, const char* material, const Shape& shape) {
    const Ogre::MeshPtr mesh = Ogre::MeshManager::getSingleton().createManual(name, kGroup);
    Ogre::SubMesh& part = *mesh->createSubMesh();
    part.setMaterialName(material);
    part.useSharedVertices = false;
    part.vertexData = OGRE_NEW Ogre::VertexData();
    part.vertexData->vertexCount = shape.vertices.size() / 2;
    Ogre::VertexDeclaration& declaration = *part.vertexData->vertexDeclaration;
    std::size_t offset = 0;
    for (const Ogre::VertexElementSemantic semantic : {Ogre::VES_POSITION, Ogre::VES_NORMAL})
        offset += declaration.addElement(0, offset, Ogre::VET_FLOAT3, semantic).getSize();
    auto& manager = Ogre::HardwareBufferManager::getSingleton();
    // With a shadow: who merges entities reads them.
    const auto vertices = manager.createVertexBuffer(offset, part.vertexData->vertexCount,
                                                     Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY, true);
    vertices->writeData(0, vertices->getSizeInBytes(), shape.vertices.data(), true);
    part.vertexData->vertexBufferBinding->setBinding(0, vertices);
    part.indexData->indexCount = shape.indices.size();
    part.indexData->indexBuffer =
        manager.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_16BIT, shape.indices.size(),
                                  Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY, true);
    part.indexData->indexBuffer->writeData(0, part.indexData->indexBuffer->getSizeInBytes(),
                                           shape.indices.data(), true);
    mesh->_setBounds(shape.bounds);
    mesh->_setBoundingSphereRadius(shape.bounds.getSize().length());
    mesh->load();
}

void place(Ogre::SceneManager& scene, const char* mesh, float x, float z, float scale, float turn) {
    Ogre::SceneNode& node = *scene.getRootSceneNode()->createChildSceneNode(Ogre::Vector3(x, 0.0f, z));
    node.setScale(scale, scale, scale);
    node.yaw(Ogre::Radian(turn));
    node.attachObject(scene.createEntity(mesh));
}

}  // namespace

void make_town_resources() {
    make_programs();
    make_material("brick", Ogre::ColourValue(0.70f, 0.45f, 0.38f));
    make_material("tiles", Ogre::ColourValue(0.45f, 0.28f, 0.25f));
    make_material("leaves", Ogre::ColourValue(0.30f, 0.55f, 0.25f));
    make_material("iron", Ogre::ColourValue(0.35f, 0.37f, 0.40f));
    make_material("stone", Ogre::ColourValue(0.75f, 0.73f, 0.68f));

    Shape walls, roof, tree, lamp, fountain;
    walls.add_box({-7.0f, 0.0f, -7.0f}, {7.0f, 8.0f, 7.0f});
    for (int floor = 0; floor < 2; ++floor)  // window sills
        for (int i = 0; i < 4; ++i)
            for (const float side : {-7.2f, 6.9f}) {
                const float along = -6.0f + 3.5f * static_cast<float>(i),
                            high = 1.5f + 3.5f * static_cast<float>(floor);
                walls.add_box({along, high, side}, {along + 1.5f, high + 0.2f, side + 0.3f});
                walls.add_box({side, high, along}, {side + 0.3f, high + 0.2f, along + 1.5f});
            }
    make_mesh("walls", "brick", walls);
    roof.add_turned({{0.0f, 12.0f}, {10.5f, 8.0f}, {0.0f, 8.0f}}, 4);
    make_mesh("roof", "tiles", roof);
    tree.add_turned({{0.0f, 7.0f},
                     {0.8f, 5.5f},
                     {0.6f, 5.5f},
                     {1.3f, 4.0f},
                     {1.0f, 4.0f},
                     {1.8f, 2.0f},
                     {0.25f, 2.0f},
                     {0.25f, 0.0f}},
                    14);
    make_mesh("tree", "leaves", tree);
    lamp.add_turned({{0.0f, 4.6f}, {0.3f, 4.4f}, {0.35f, 4.0f}, {0.08f, 3.8f}, {0.08f, 0.4f}, {0.2f, 0.0f}},
                    12);
    make_mesh("lamp", "iron", lamp);
    fountain.add_turned(
        {{0.0f, 2.5f}, {0.4f, 2.3f}, {0.2f, 1.2f}, {1.6f, 1.0f}, {1.7f, 0.6f}, {2.2f, 0.5f}, {2.2f, 0.0f}},
        24);
    make_mesh("fountain", "stone", fountain);
}

void place_town(Ogre::SceneManager& scene) {
    for (int i = 0; i < kStreets * kStreets; ++i) {
        const float x = kPitch * (static_cast<float>(i % kStreets) + 0.5f) - kHalf;
        const float z = kPitch * (static_cast<float>(i / kStreets) + 0.5f) - kHalf;
        const float scale = 0.8f + 0.02f * static_cast<float>(i * 7 % 17);
        const float turn = 1.5707963f * static_cast<float>(i % 4);
        place(scene, "walls", x, z, scale, turn);
        place(scene, "roof", x, z, scale, turn + 0.7853982f);
        place(scene, "tree", x + 0.42f * kPitch, z - 4.0f, 0.7f + 0.03f * static_cast<float>(i * 5 % 13),
              turn);
        place(scene, "lamp", x + 0.42f * kPitch, z + 4.0f, 1.0f, turn);
        place(scene, "fountain", x - 4.0f, z + 0.45f * kPitch, 0.5f, turn);
    }
}
