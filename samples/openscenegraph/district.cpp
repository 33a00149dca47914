// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "district.h"

#include <osg/CullFace>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osgUtil/Optimizer>

#include <array>
#include <cmath>
#include <vector>

namespace {

constexpr const char* kVertexShader = R"(#version 120
varying vec3 direction;
void main() {
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
    direction = gl_NormalMatrix * gl_Normal;
})";

constexpr const char* kFragmentShader = R"(#version 120
varying vec3 direction;
uniform vec3 colour;
void main() {
    float light = 0.3 + 0.7 * max(dot(normalize(direction), normalize(vec3(0.3, 0.8, 1.0))), 0.0);
    gl_FragColor = vec4(colour * light, 1.0);
})";

/// Triangles of one geometry, flat ones with vertices of their own.
class Shape {
  public:
    Shape& add_box(const osg::Vec3& a, const osg::Vec3& b) {
        const auto corner = [&](int i) {
            return osg::Vec3(i & 1 ? b.x() : a.x(), i & 2 ? b.y() : a.y(), i & 4 ? b.z() : a.z());
        };
        for (const auto& f :
             {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
            add_face({corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])});
        return *this;
    }

    /// A body of revolution about z: radius and height of its rings, from below.
    Shape& add_turned(const std::vector<osg::Vec2>& rings, int segments) {
        const auto at = [&](const osg::Vec2& ring, int segment) {
            const float turn = 6.2831853f * static_cast<float>(segment) / static_cast<float>(segments);
            return osg::Vec3(ring.x() * std::cos(turn), ring.x() * std::sin(turn), ring.y());
        };
        for (std::size_t r = 0; r + 1 < rings.size(); ++r)
            for (int s = 0; s < segments; ++s) {
                if (rings[r].x() > 0.0f)
                    add_face({at(rings[r], s), at(rings[r], s + 1), at(rings[r + 1], s)});
                if (rings[r + 1].x() > 0.0f)
                    add_face({at(rings[r], s + 1), at(rings[r + 1], s + 1), at(rings[r + 1], s)});
            }
        return *this;
    }

    osg::ref_ptr<osg::Geometry> geometry(const osg::Vec3& colour, DrawCounter& counter) const {
        osg::ref_ptr<CountedTriangles> triangles = new CountedTriangles(counter);
        triangles->assign(indices_.begin(), indices_.end());
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setUseDisplayList(false);
        geometry->setUseVertexBufferObjects(true);
        geometry->setVertexArray(vertices_);
        geometry->setNormalArray(normals_, osg::Array::BIND_PER_VERTEX);
        geometry->addPrimitiveSet(triangles);
        geometry->getOrCreateStateSet()->addUniform(new osg::Uniform("colour", colour));
        return geometry;
    }

  private:
    /// Counter-clockwise, seen from outside.
    void add_face(std::initializer_list<osg::Vec3> corners) {
        const auto first = static_cast<GLushort>(vertices_->size());
        const osg::Vec3* c = corners.begin();
        osg::Vec3 normal = (c[1] - c[0]) ^ (c[2] - c[0]);
        normal.normalize();
        for (const osg::Vec3& corner : corners) {
            vertices_->push_back(corner);
            normals_->push_back(normal);
        }
        for (std::size_t i = 2; i < corners.size(); ++i)
            for (const std::size_t k : {std::size_t{0}, i - 1, i})
                indices_.push_back(static_cast<GLushort>(first + k));
    }

    osg::ref_ptr<osg::Vec3Array> vertices_ = new osg::Vec3Array, normals_ = new osg::Vec3Array;
    std::vector<GLushort> indices_;
};

/// 14 by 14 by 1 metres, with sills; stretched to the height of the house.
Shape walls() {
    Shape shape;
    shape.add_box({-7.0f, -7.0f, 0.0f}, {7.0f, 7.0f, 1.0f});
    for (int floor = 0; floor < 4; ++floor)
        for (int i = 0; i < 4; ++i)
            for (const float side : {-7.2f, 6.9f}) {
                const float along = -6.0f + 3.5f * static_cast<float>(i),
                            high = 0.1f + 0.22f * static_cast<float>(floor);
                shape.add_box({along, side, high}, {along + 1.5f, side + 0.3f, high + 0.01f});
                shape.add_box({side, along, high}, {side + 0.3f, along + 1.5f, high + 0.01f});
            }
    return shape;
}

/// What stands at a corner of streets.
struct Kinds {
    osg::ref_ptr<osg::Geometry> walls, roof, tree, lamp, bench;

    explicit Kinds(DrawCounter& counter) {
        walls = ::walls().geometry({0.70f, 0.45f, 0.38f}, counter);
        roof = Shape()
                   .add_turned({{0.0f, 0.0f}, {10.5f, 0.0f}, {0.0f, 4.0f}}, 4)
                   .geometry({0.45f, 0.28f, 0.25f}, counter);
        tree = Shape()
                   .add_turned({{0.25f, 0.0f},
                                {0.25f, 2.0f},
                                {1.8f, 2.0f},
                                {1.0f, 4.0f},
                                {1.3f, 4.0f},
                                {0.6f, 5.5f},
                                {0.8f, 5.5f},
                                {0.0f, 7.0f}},
                               16)
                   .geometry({0.30f, 0.55f, 0.25f}, counter);
        lamp =
            Shape()
                .add_turned(
                    {{0.2f, 0.0f}, {0.08f, 0.4f}, {0.08f, 3.8f}, {0.35f, 4.0f}, {0.3f, 4.4f}, {0.0f, 4.6f}},
                    12)
                .geometry({0.35f, 0.37f, 0.40f}, counter);
        Shape planks;
        for (int i = 0; i < 8; ++i) {
            const float at = 0.12f * static_cast<float>(i);
            planks.add_box({-0.9f, at, 0.45f}, {0.9f, at + 0.1f, 0.5f});
        }
        for (const float x : {-0.8f, 0.7f}) planks.add_box({x, 0.0f, 0.0f}, {x + 0.1f, 0.94f, 0.45f});
        bench = planks.geometry({0.60f, 0.45f, 0.30f}, counter);
    }
};

void place(osg::Group& group, osg::Geometry& geometry, const osg::Vec3& at, const osg::Vec3& scale,
           float turn) {
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(
        osg::Matrix::scale(scale) * osg::Matrix::rotate(turn, osg::Z_AXIS) * osg::Matrix::translate(at));
    transform->setDataVariance(osg::Object::STATIC);
    transform->addChild(&geometry);
    group.addChild(transform);
}

}  // namespace

osg::ref_ptr<osg::Group> make_district(DrawCounter& counter) {
    const Kinds kinds(counter);
    osg::ref_ptr<osg::Group> district = new osg::Group;
    for (int i = 0; i < kStreets * kStreets; ++i) {
        const float x = kPitch * (static_cast<float>(i % kStreets) + 0.5f) - kHalf;
        const float y = kPitch * (static_cast<float>(i / kStreets) + 0.5f) - kHalf;
        const float height = 3.0f * static_cast<float>(2 + i * 7 % 9);
        const float turn = 1.5707963f * static_cast<float>(i % 4);
        const float tree = 0.7f + 0.05f * static_cast<float>(i * 5 % 13);
        place(*district, *kinds.walls, {x, y, 0.0f}, {1.0f, 1.0f, height}, turn);
        place(*district, *kinds.roof, {x, y, height}, {1.0f, 1.0f, 1.0f}, turn + 0.7853982f);
        place(*district, *kinds.tree, {x + 11.5f, y - 4.0f, 0.0f}, {tree, tree, tree}, turn);
        place(*district, *kinds.lamp, {x + 11.5f, y + 4.0f, 0.0f}, {1.0f, 1.0f, 1.0f}, 0.0f);
        place(*district, *kinds.bench, {x - 4.0f, y + 11.5f, 0.0f}, {1.0f, 1.0f, 1.0f}, turn);
    }
    // One group of 8,000 would be tested child by child.
    osgUtil::Optimizer().optimize(district, osgUtil::Optimizer::SPATIALIZE_GROUPS);
    return district;
}

void set_common_state(osg::StateSet& state) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, kVertexShader));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, kFragmentShader));
    state.setAttributeAndModes(program);
    state.setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
}
