// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The promise that matters: what `faces_away` calls turned away shows no front face to a renderer. Oracles:
// every triangle's plane in long double, and a renderer's own float transform with corners snapped to 1/256
// pixel.

#include "rhview/rhoctree/facing.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
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

/// The vertex shader of `gl` in float, then the viewport, then corners on a grid of 1/256 pixel.
struct SnappingRenderer {
    static constexpr double kWidth = 1280.0, kHeight = 720.0;

    explicit SnappingRenderer(const View& view) : clip(view.clip_from_eye_relative()) {
        const dvec3 eye = view.eye();
        for (int axis = 0; axis < 3; ++axis) {
            // GCC 12 folds a vector's way from double to float and back: one number at a time, by memory.
            const volatile float high = static_cast<float>(eye[axis]);
            eye_high[axis] = high;
            eye_low[axis] = static_cast<float>(eye[axis] - static_cast<double>(high));
        }
    }
    /// Twice the area in squares of the grid, positive for front faces; false if a corner is behind or far
    /// off.
    bool twice_area(const Triangles& triangles, double& area) const {
        std::array<glm::dvec2, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec4 p = clip * glm::vec4((triangles.positions[c] - eye_high) - eye_low, 1.0f);
            if (!(p.w > 0.0f) || std::abs(p.x) > 16.0f * p.w || std::abs(p.y) > 16.0f * p.w) return false;
            const float x = (p.x / p.w * 0.5f + 0.5f) * static_cast<float>(kWidth);
            const float y = (p.y / p.w * 0.5f + 0.5f) * static_cast<float>(kHeight);
            corners[c] = {std::round(static_cast<double>(x) * 256.0),
                          std::round(static_cast<double>(y) * 256.0)};
        }
        const glm::dvec2 a = corners[1] - corners[0], b = corners[2] - corners[0];
        area = a.x * b.y - a.y * b.x;
        return true;
    }

    glm::vec3 eye_high{0.0f}, eye_low{0.0f};
    glm::mat4 clip;
};

/// The shortest altitude of a triangle, as a share of the distance of its farthest corner.
double altitude_share(const Triangles& triangles, const dvec3& eye) {
    double longest = 0.0, farthest = 0.0;
    for (int c = 0; c < 3; ++c) {
        longest = std::max(
            longest, glm::length(dvec3(triangles.corner(0, c)) - dvec3(triangles.corner(0, (c + 1) % 3))));
        farthest = std::max(farthest, glm::length(dvec3(triangles.corner(0, c)) - eye));
    }
    const dvec3 a(triangles.corner(0, 0)), b(triangles.corner(0, 1)), c(triangles.corner(0, 2));
    return glm::length(glm::cross(b - a, c - a)) / (longest * farthest);
}

TEST(FacingOracle, triangles_a_pixel_high_that_face_away_are_never_front_faces_of_a_snapping_float_renderer) {
    Uniform uniform(21);
    std::size_t away_edge_on = 0, flipped_within_slack = 0;
    for (int i = 0; i < 400'000; ++i) {
        const dvec3 where = (i % 3 == 0   ? 0.0
                             : i % 3 == 1 ? 1e4
                                          : 1e7) *
                                dvec3(0.7, 0.1, -1.0) +
                            uniform.point(10.0);
        const double distance = uniform.log(1.0, 1e3) + 0x1p-12 * glm::length(where);
        Triangles triangles;
        const dvec3 normal = glm::normalize(uniform.point(1.0));
        const double focal = uniform.log(0.5, 20.0);  // of half the height
        const double size = distance / (focal * 360.0) * uniform.log(1.0, 100.0);
        add_facing(triangles, uniform, where, normal, size);
        const dvec3 across = glm::normalize(glm::cross(normal, uniform.point(1.0)));
        const dvec3 eye = where + distance * (across - uniform(0.0, 0.03) * normal);
        View view;
        view.camera_from_world =
            look_along(eye, where - eye + 0.3 * distance / focal * uniform.point(1.0), {0.1, 1, 0});
        view.clip_from_camera =
            perspective(2.0 * std::atan(1.0 / focal), 16.0 / 9.0, 0.01, 1e6, view.clip_depth);
        const double share = altitude_share(triangles, eye);
        double area = 0.0;
        if (share < 1.0 / 2700.0 || share * focal * 360.0 < 1.07) continue;
        if (!SnappingRenderer(view).twice_area(triangles, area)) continue;
        const Viewpoint viewpoint = make_viewpoint(view);
        const long double sine = least_sine(triangles, viewpoint);
        if (faces_away(triangles.bound(), viewpoint)) {
            ASSERT_LE(area, 0.0);
            ++away_edge_on;
        } else if (sine > 0.0L) {
            flipped_within_slack += area > 0.0;
        }
    }
    EXPECT_GT(away_edge_on, 50'000u);
    EXPECT_GT(flipped_within_slack, 20u);  // the slack is needed: the renderer does turn triangles round
}

/// Triangles of exactly one normal, (1, 2, 3) or an axis, on several planes of a lattice.
Triangles parallel_set(Uniform& uniform, bool axis_aligned, const glm::vec3& where) {
    const glm::vec3 u = axis_aligned ? glm::vec3(0, 1, 0) : glm::vec3(2, -1, 0);
    const glm::vec3 v = axis_aligned ? glm::vec3(0, 0, 1) : glm::vec3(3, 0, -1);
    Triangles triangles;
    const auto whole = [&](double low, double high) {
        return static_cast<float>(std::floor(uniform(low, high)));
    };
    for (int i = 0; i < 20; ++i) {
        const glm::vec3 corner = where + glm::vec3(whole(-30, 30), whole(-30, 30), whole(-30, 30));
        triangles.add(corner, corner + whole(1, 9) * u, corner + whole(1, 9) * v);
    }
    return triangles;
}

TEST(Facing, parallel_normals_give_the_slab_test_and_nothing_less) {
    Uniform uniform(31);
    std::size_t yes = 0;
    for (int i = 0; i < 400; ++i) {
        const bool axis_aligned = i % 2 == 0;
        const glm::vec3 where = i % 4 < 2 ? glm::vec3(0.0f) : glm::vec3(65536.0f, 4096.0f, -32768.0f);
        const Triangles triangles = parallel_set(uniform, axis_aligned, where);
        const FacingCone cone = triangles.bound();
        const Vector a = triangles.corner(0, 0);
        const Vector normal =
            glm::normalize(glm::cross(triangles.corner(0, 1) - a, triangles.corner(0, 2) - a));
        if (axis_aligned) {
            ASSERT_EQ(cone.cutoff, 0.0f);
        }
        ASSERT_LE(cone.cutoff, 0x1p-22f);
        long double lowest = glm::dot(normal, a);
        for (std::size_t t = 0; t < triangles.count(); ++t)
            lowest = std::min(lowest, glm::dot(normal, triangles.corner(t, 0)));
        const long double below = lowest - glm::dot(normal, Vector(cone.apex));
        ASSERT_GE(below, axis_aligned ? 0.0L : -1e-12L);
        ASSERT_LE(below, axis_aligned ? 0.0L : 4.0L * 0x1p-23L * glm::length(Vector(cone.apex)));
        for (int v = 0; v < 100; ++v) {
            Viewpoint viewpoint{Viewpoint::Kind::Point, dvec3(where) + uniform.point(uniform.log(1, 1e4))};
            const long double depth = lowest - glm::dot(normal, Vector(viewpoint.point));
            const long double needed =
                static_cast<long double>(kFacingSlack) *
                (glm::length(Vector(cone.apex) - Vector(viewpoint.point)) + cone.reach);
            const long double rounding = 1e-4L * needed + 0x1p-21L * glm::length(Vector(where));
            if (depth > needed + rounding) {
                ASSERT_TRUE(faces_away(cone, viewpoint));
            }
            if (depth < needed - rounding) {
                ASSERT_FALSE(faces_away(cone, viewpoint));
            }
            yes += depth > needed + rounding;
        }
    }
    EXPECT_GT(yes, 10'000u);
}

TEST(Facing, cone_is_as_narrow_as_any_axis_allows_and_its_apex_as_far_forward) {
    Uniform uniform(41);
    for (int i = 0; i < 300; ++i) {
        const Triangles triangles = random_set(uniform, dvec3(0.0), uniform.log(0.01, 1.0), 1 + i % 40);
        const FacingCone cone = triangles.bound();
        if (cone.cutoff > 1.0f) continue;
        std::vector<dvec3> normals;
        double excess = -1e30, farthest = 0.0;
        for (std::size_t t = 0; t < triangles.count(); ++t) {
            const dvec3 a(triangles.corner(t, 0)), b(triangles.corner(t, 1)), c(triangles.corner(t, 2));
            normals.push_back(glm::normalize(glm::cross(b - a, c - a)));
            excess = std::max(excess, glm::dot(normals.back(), dvec3(cone.apex) - a) /
                                          glm::dot(normals.back(), dvec3(cone.axis)));
            for (const dvec3& corner : {a, b, c})
                farthest = std::max(farthest, glm::length(corner - dvec3(cone.apex)));
        }
        EXPECT_LE(excess, 1e-9);
        EXPECT_GT(excess, -1e-4 * (1.0 + cone.reach));
        EXPECT_LE(farthest, static_cast<double>(cone.reach));
        const double cosine =
            std::sqrt(1.0 - static_cast<double>(cone.cutoff) * static_cast<double>(cone.cutoff));
        dvec3 best(cone.axis);
        for (int attempt = 0; attempt < 2000; ++attempt) {
            const dvec3 axis = glm::normalize(best + uniform.log(1e-4, 0.3) * uniform.point(1.0));
            double least = 1.0;
            for (const dvec3& normal : normals) least = std::min(least, glm::dot(axis, normal));
            ASSERT_LE(least, cosine + 1e-6);
        }
    }
}

TEST(Facing, single_triangle_is_seen_from_its_front_only) {
    Triangles triangles;
    triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const FacingCone cone = triangles.bound();
    EXPECT_FALSE(faces_away(cone, {Viewpoint::Kind::Point, {0, 0, 1}}));
    EXPECT_TRUE(faces_away(cone, {Viewpoint::Kind::Point, {0, 0, -1}}));
    EXPECT_TRUE(faces_away(cone, {Viewpoint::Kind::Direction, {}, {0, 0, 1}}));
    EXPECT_FALSE(faces_away(cone, {Viewpoint::Kind::Direction, {}, {0, 0, -1}}));
    EXPECT_FALSE(faces_away(cone, {Viewpoint::Kind::Point, {5, 3, 0}})) << "edge-on is within the slack";
    EXPECT_FALSE(faces_away(cone, {Viewpoint::Kind::Unknown, {0, 0, -1}, {0, 0, 1}}));
    EXPECT_FALSE(faces_away(FacingCone{}, {Viewpoint::Kind::Point, {0, 0, -1}}));
    EXPECT_FALSE(faces_away(FacingCone{}, {Viewpoint::Kind::Direction, {}, {0, 0, 1}}));
}

TEST(Facing, sets_without_an_area_or_with_opposite_normals_or_without_a_number_are_never_turned_away) {
    const float inf = std::numeric_limits<float>::infinity();
    std::vector<Triangles> sets(8);
    sets[1].add({1, 2, 3}, {1, 2, 3}, {1, 2, 3});
    sets[2].add({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
    sets[3].add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    sets[3].add({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    sets[4].add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    sets[4].add({0, kNan, 0}, {1, 0, 0}, {0, 1, 0});
    sets[5].add({0, 0, 0}, {inf, 0, 0}, {0, 1, 0});
    sets[6].add({0, 0, 0}, {1e-42f, 0, 0}, {0, 1e-42f, 0});
    sets[7].add({-3e38f, 0, 3e38f}, {3e38f, 0, 3e38f}, {0, 3e38f, 3e38f});
    for (const Triangles& set : sets)
        for (const dvec3& eye : {dvec3(0, 0, -1), dvec3(0, 0, 1), dvec3(9, -3, 1e-42), dvec3(0, 0, -1e30)})
            EXPECT_FALSE(faces_away(set.bound(), {Viewpoint::Kind::Point, eye}) && &set != &sets[6]);
    // The smallest triangle there is has a side all the same.
    EXPECT_TRUE(faces_away(sets[6].bound(), {Viewpoint::Kind::Point, {0, 0, -1}}));
    EXPECT_FALSE(faces_away(sets[6].bound(), {Viewpoint::Kind::Point, {0, 0, -1e-42}}));
}

TEST(Facing, triangles_without_an_area_bind_nothing) {
    Triangles triangles;
    triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const FacingCone alone = triangles.bound();
    triangles.add({0, 0, -5}, {0, 0, -5}, {0, 1, -5});
    triangles.add({0, 0, -5}, {1, 1, -4}, {2, 2, -3});
    const FacingCone cone = triangles.bound();
    EXPECT_EQ(cone.apex, alone.apex);
    EXPECT_EQ(cone.cutoff, alone.cutoff);
}

TEST(Facing, numbers_that_are_none_and_distances_beyond_float_prove_nothing) {
    Triangles triangles;
    triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const FacingCone cone = triangles.bound();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(faces_away(cone, {Viewpoint::Kind::Point, {nan, 0, -1}}));
    EXPECT_FALSE(faces_away(cone, {Viewpoint::Kind::Point, {0, 0, -1e30}}));
    EXPECT_FALSE(faces_away(cone, {Viewpoint::Kind::Point, {0, 0, -1e300}}));
    EXPECT_FALSE(faces_away(cone, {Viewpoint::Kind::Direction, {}, glm::vec3(kNan)}));
    EXPECT_TRUE(faces_away(cone, {Viewpoint::Kind::Point, {0, 0, -1e15}}));
}

TEST(MakeViewpoint, perspective_is_seen_from_the_eye_whatever_its_planes) {
    Uniform uniform(51);
    for (int i = 0; i < 200; ++i) {
        const dvec3 eye = uniform.point(i % 2 == 0 ? 10.0 : 1e7);
        View view = random_view(uniform, eye, uniform.point(1.0));
        const Viewpoint viewpoint = make_viewpoint(view, {1, 2, 3});
        if (view.clip_from_camera[3][3] == 1.0) {
            ASSERT_EQ(viewpoint.kind, Viewpoint::Kind::Direction);
            ASSERT_NEAR(glm::length(viewpoint.direction), 1.0f, 1e-6f);
        } else {
            ASSERT_EQ(viewpoint.kind, Viewpoint::Kind::Point);
            ASSERT_LT(glm::length(viewpoint.point - (eye - dvec3(1, 2, 3))),
                      1e-15 * (1.0 + glm::length(eye)) * 4.0);
        }
    }
}

TEST(MakeViewpoint, orthographic_view_looks_along_its_forward_axis) {
    for (const ClipDepth depth :
         {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne, ClipDepth::ReversedZeroToOne}) {
        View view;
        view.clip_depth = depth;
        view.camera_from_world = look_along({3, 4, 5}, {1, -2, 3}, {0, 1, 0});
        view.clip_from_camera = orthographic(20, 10, 1, 100, depth);
        const Viewpoint viewpoint = make_viewpoint(view);
        ASSERT_EQ(viewpoint.kind, Viewpoint::Kind::Direction);
        EXPECT_LT(glm::length(viewpoint.direction - glm::vec3(glm::normalize(dvec3(1, -2, 3)))), 1e-6f);
    }
}

TEST(MakeViewpoint, mirrors_and_what_lies_between_point_and_direction_are_unknown) {
    Uniform uniform(61);
    for (int i = 0; i < 100; ++i) {
        const View view = random_view(uniform, uniform.point(10.0), uniform.point(1.0));
        View flipped = view;
        for (int column = 0; column < 4; ++column) flipped.clip_from_camera[column][1] *= -1.0;
        EXPECT_EQ(make_viewpoint(flipped).kind, Viewpoint::Kind::Unknown);
        View mirrored = view;
        mirrored.camera_from_world = glm::dmat4(1.0);
        mirrored.camera_from_world[0][0] = -1.0;
        EXPECT_EQ(make_viewpoint(mirrored).kind, Viewpoint::Kind::Unknown);
    }
    View between;
    between.clip_from_camera = orthographic(2, 2, 1, 10, between.clip_depth);
    between.clip_from_camera[0][3] = 1.0;
    between.clip_from_camera[2][3] = -1e-10;
    EXPECT_EQ(make_viewpoint(between).kind, Viewpoint::Kind::Unknown);
    between.clip_from_camera[2][3] = -1e-3;
    EXPECT_EQ(make_viewpoint(between).kind, Viewpoint::Kind::Point);
}

}  // namespace
}  // namespace rhview
