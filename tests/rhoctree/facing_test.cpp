// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The promise that matters: what `faces_away` calls turned away shows no front face to a renderer. Oracles:
// every triangle's plane in long double, and a renderer's own float transform with corners snapped to 1/256
// pixel.

#include "rhview/rhoctree/facing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/mat4x4.hpp>
#include <limits>
#include <vector>

#include "../uniform.h"

namespace rhview {
namespace {

using glm::dvec3;
using Vector = glm::tvec3<long double>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        for (const glm::vec3& corner : {a, b, c}) {
            indices.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.push_back(corner);
        }
    }
    [[nodiscard]] FacingCone bound() const { return bound_facing(positions, indices); }
    [[nodiscard]] std::size_t count() const { return indices.size() / 3; }
    [[nodiscard]] Vector corner(std::size_t triangle, int corner) const {
        return Vector(positions[indices[3 * triangle + static_cast<std::size_t>(corner)]]);
    }
};

/// A triangle of size `size` about `centre` whose normal is `normal`, before its corners are rounded.
void add_facing(Triangles& triangles, Uniform& uniform, const dvec3& centre, const dvec3& normal,
                double size) {
    const dvec3 n = glm::normalize(normal);
    const dvec3 u = glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const dvec3 v = glm::cross(n, u);
    const double turn = uniform(0, 6.28);
    const auto corner = [&](double angle) {
        return glm::vec3(centre + size * (std::cos(turn + angle) * u + std::sin(turn + angle) * v));
    };
    triangles.add(corner(0.0), corner(uniform(1.0, 2.5)), corner(uniform(3.2, 5.2)));
}

/// Normals within about `spread` (tangent of an angle) of one direction.
Triangles random_set(Uniform& uniform, const dvec3& where, double spread, int count) {
    Triangles triangles;
    const dvec3 axis = glm::normalize(uniform.point(1.0));
    // Far from zero a float corner has no more than 23 bits: smaller sets would be shapes of their rounding.
    const double reach = uniform.log(0.1, 100.0) + 0x1p-19 * glm::length(where);
    for (int i = 0; i < count; ++i)
        add_facing(triangles, uniform, where + uniform.point(reach), axis + spread * uniform.point(0.57),
                   reach * uniform.log(0.01, 1.0));
    return triangles;
}

/// The least sine, over all corners, between a triangle's plane and the ray to the corner, positive where
/// the triangle is seen from behind.
long double least_sine(const Triangles& triangles, const Viewpoint& viewpoint) {
    long double least = 2.0L;
    for (std::size_t t = 0; t < triangles.count(); ++t) {
        const Vector a = triangles.corner(t, 0);
        const Vector cross = glm::cross(triangles.corner(t, 1) - a, triangles.corner(t, 2) - a);
        if (glm::dot(cross, cross) == 0.0L) continue;
        for (int c = 0; c < 3; ++c) {
            const Vector ray = viewpoint.kind == Viewpoint::Kind::Direction
                                   ? Vector(viewpoint.direction)
                                   : triangles.corner(t, c) - Vector(viewpoint.point);
            least = std::min(least, glm::dot(cross, ray) / (glm::length(cross) * glm::length(ray)));
        }
    }
    return least;
}

/// Any camera: perspective, asymmetric, with an oblique near plane, or orthographic and sheared.
View random_view(Uniform& uniform, const dvec3& eye, const dvec3& target) {
    View view;
    view.clip_depth = static_cast<ClipDepth>(static_cast<int>(uniform(0, 3)));
    view.camera_from_world = look_along(eye, target - eye + uniform.point(1e-3), {0.1, 1.0, 0.05});
    const bool infinite = uniform(0, 1) < 0.3;
    view.clip_from_camera =
        perspective(uniform(0.1, 2.5), uniform(0.5, 2.0), 0.01,
                    infinite ? std::numeric_limits<double>::infinity() : 1e5, view.clip_depth);
    const double kind = uniform(0, 1);
    if (kind < 0.3) {
        view.clip_from_camera =
            orthographic(uniform.log(1, 1e3), uniform.log(1, 1e3), 0.01, 1e4, view.clip_depth);
        if (kind < 0.15)  // a cabinet projection: x and y move with depth
            view.clip_from_camera[2][0] = uniform(-0.5, 0.5) * view.clip_from_camera[0][0];
    } else if (kind < 0.6) {
        view.clip_from_camera[2][0] = uniform(-0.8, 0.8);
        view.clip_from_camera[2][1] = uniform(-0.8, 0.8);
    } else if (kind < 0.8) {
        for (int column = 0; column < 4; ++column) view.clip_from_camera[column][2] = uniform(-1, 1);
    }
    return view;
}

class FacingOracle : public testing::TestWithParam<double> {};

TEST_P(FacingOracle, sets_that_face_away_are_back_facing_by_the_slack_in_long_double) {
    Uniform uniform(11 + static_cast<std::uint32_t>(GetParam()));
    std::size_t yes = 0, provable = 0, narrow_yes = 0, narrow_provable = 0;
    for (int i = 0; i < 2000; ++i) {
        const dvec3 where = GetParam() * dvec3(1.0, -0.3, 0.7) + uniform.point(10.0);
        const double far = 0x1p-18 * glm::length(where);
        const double spread = uniform.log(1e-3, 2.0);
        const Triangles triangles = random_set(uniform, where, spread, 1 + i % 30);
        const FacingCone cone = triangles.bound();
        for (int v = 0; v < 20; ++v) {
            const View view = random_view(uniform, where + uniform.point(uniform.log(1, 1e4) + far), where);
            const Viewpoint viewpoint = make_viewpoint(view);
            ASSERT_NE(viewpoint.kind, Viewpoint::Kind::Unknown);
            const long double sine = least_sine(triangles, viewpoint);
            const bool away = faces_away(cone, viewpoint);
            if (away) {
                ASSERT_GT(sine, 0.999L * static_cast<long double>(viewpoint.slack));
            }
            yes += away;
            provable += sine > 0.1L;
            narrow_yes += away && spread < 0.05;
            narrow_provable += sine > 0.1L && spread < 0.05;
        }
    }
    EXPECT_GT(provable, 5'000u);
    EXPECT_GT(narrow_provable, 3'000u);
    EXPECT_GT(static_cast<double>(narrow_yes), 0.9 * static_cast<double>(narrow_provable));
    EXPECT_GT(static_cast<double>(yes), 0.8 * static_cast<double>(provable));
}

INSTANTIATE_TEST_SUITE_P(Offsets, FacingOracle, testing::Values(0.0, 1e3, 1e5, 1e7));

}  // namespace
}  // namespace rhview
