// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/lod/projected_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>

#include "rhview/base/view.h"
#include "uniform.h"

namespace rhview {
namespace {

constexpr double kWidth = 1280, kHeight = 720;

struct ScreenPoint {
    glm::dvec2 px{0.0};
    bool on_screen = false;
};

ScreenPoint project(const glm::dmat4& clip_from_object, const glm::dvec3& p) {
    const glm::dvec4 clip = clip_from_object * glm::dvec4(p, 1.0);
    const glm::dvec2 at(clip.x / clip.w, clip.y / clip.w);
    return {0.5 * at * glm::dvec2(kWidth, kHeight),
            clip.w > 0.0 && std::abs(at.x) <= 1.0 && std::abs(at.y) <= 1.0};
}

glm::dmat4 random_projection(Uniform& uniform, int kind) {
    if (kind == 0) return orthographic(uniform.log(1, 100), uniform.log(1, 100), 0.1, 1000, {});
    glm::dmat4 m = perspective(uniform(0.2, 2.4), uniform(0.5, 2.5), 0.1, 1000, ClipDepth::ZeroToOne);
    // Off-centre, as for one eye of two or a tile of a wall.
    if (kind == 2) m[2] += glm::dvec4(uniform(-0.8, 0.8), uniform(-0.8, 0.8), 0, 0);
    return m;
}

/// Rotation, scale that differs by axis and may mirror, shear.
glm::dmat4 random_placement(Uniform& uniform) {
    glm::dmat4 m(1.0);
    for (glm::length_t c = 0; c < 3; ++c) m[c] = glm::dvec4(uniform.log(0.05, 5) * uniform.point(1.0), 0.0);
    return m;
}

glm::dvec3 point_in(const BoundingSphere& sphere, Uniform& uniform) {
    glm::dvec3 p = uniform.point(1.0);
    while (glm::length(p) > 1.0) p = uniform.point(1.0);
    return sphere.centre + sphere.radius * p;
}

TEST(PixelsPerUnit, no_two_points_in_the_sphere_are_farther_apart_on_the_screen) {
    Uniform uniform(5);
    int seen = 0, cases = 0;
    double tightest = 0.0;
    for (int i = 0; i < 30'000; ++i) {
        glm::dmat4 m = random_placement(uniform);
        m[3] = glm::dvec4(uniform(-40, 40), uniform(-40, 40), uniform(-60, 5), 1);
        m = random_projection(uniform, i % 3) * m;
        const BoundingSphere sphere{uniform.point(2.0), uniform.log(0.05, 3)};
        const double factor = pixels_per_unit(m, sphere, kWidth, kHeight);
        if (!std::isfinite(factor)) continue;
        ++cases;
        for (int pair = 0; pair < 10; ++pair) {
            const glm::dvec3 p = point_in(sphere, uniform);
            glm::dvec3 q = point_in(sphere, uniform);
            if (pair % 2 == 0) q = p + (q - p) * 0.01;
            const ScreenPoint at = project(m, p);
            if (!at.on_screen) continue;
            ++seen;
            const double moved = glm::length(project(m, q).px - at.px);
            ASSERT_LE(moved, factor * glm::length(q - p) * (1.0 + 1e-9)) << i;
            tightest = std::max(tightest, moved / (factor * glm::length(q - p)));
        }
    }
    EXPECT_GT(cases, 20'000);
    EXPECT_GT(seen, 10'000);
    EXPECT_GT(tightest, 0.95);
}

TEST(PixelsPerUnit, a_small_thing_ahead_is_seen_as_large_as_the_formula_of_the_books_says) {
    const double fov = std::numbers::pi / 3.0;
    const glm::dmat4 m = perspective(fov, kWidth / kHeight, 0.1, 1000, {});
    const double expected = 0.5 * kHeight / std::tan(0.5 * fov) / 100.0;
    EXPECT_NEAR(pixels_per_unit(m, {{0, 0, -100}, 0.001}, kWidth, kHeight), expected, 1e-3 * expected);
    EXPECT_NEAR(pixels_per_unit(m, {{0, 0, -101}, 1.0}, kWidth, kHeight), expected, 2e-2 * expected);
}

TEST(PixelsPerUnit, an_orthographic_view_is_the_same_at_any_distance) {
    const glm::dmat4 m = orthographic(16, 9, 0.1, 1000, {});
    for (const double z : {-1.0, -500.0, 20.0})
        EXPECT_NEAR(pixels_per_unit(m, {{3, 1, z}, 2.0}, kWidth, kHeight), 80.0, 1e-9);
}

TEST(PixelsPerUnit, scale_counts_where_it_stretches) {
    const glm::dmat4 view = orthographic(16, 9, 0.1, 1000, {});
    const auto scaled = [&](const glm::dvec3& scale) {
        return pixels_per_unit(glm::scale(view, scale), {{0, 0, -1}, 1.0}, kWidth, kHeight);
    };
    EXPECT_NEAR(scaled({3, 1, 1}), 240.0, 1e-9);
    EXPECT_NEAR(scaled({-3, 1, 1}), 240.0, 1e-9);
    EXPECT_NEAR(scaled({0.5, 0.25, 100}), 40.0, 1e-9) << "depth is not seen from ahead";
}

TEST(PixelsPerUnit, a_sphere_that_reaches_the_eye_allows_no_error_at_all) {
    const glm::dmat4 m = perspective(1.0, 1.5, 0.1, 1000, {});
    for (const BoundingSphere& sphere :
         {BoundingSphere{{0, 0, -1}, 1.0}, BoundingSphere{{0, 0, -1}, 2.0}, BoundingSphere{{0, 0, 0}, 0.0}}) {
        const double factor = pixels_per_unit(m, sphere, kWidth, kHeight);
        EXPECT_EQ(factor, std::numeric_limits<double>::infinity());
        EXPECT_EQ(projected_error_px(0.0f, factor), 0.0);
        EXPECT_EQ(projected_error_px(1e-9f, factor), std::numeric_limits<double>::infinity());
    }
}

TEST(PixelsPerUnit, what_is_all_behind_the_eye_is_not_on_the_screen) {
    const glm::dmat4 m = perspective(1.0, 1.5, 0.1, 1000, {});
    EXPECT_EQ(pixels_per_unit(m, {{0, 0, 5}, 0.1}, kWidth, kHeight), 0.0);
    EXPECT_EQ(pixels_per_unit(m, {{0, 0, 5}, 5.0}, kWidth, kHeight), std::numeric_limits<double>::infinity());
}

TEST(LargestStretch, no_vector_is_stretched_more_and_one_is_as_much) {
    Uniform uniform(11);
    for (int i = 0; i < 2000; ++i) {
        const glm::dmat3 m =
            i % 5 == 0 ? glm::dmat3(uniform.log(0.01, 100.0)) : glm::dmat3(random_placement(uniform));
        const double most = largest_stretch(m);
        // Power iteration finds the vector that is stretched most.
        glm::dvec3 v = glm::normalize(uniform.point(1.0) + glm::dvec3(1e-3));
        for (int k = 0; k < 2000; ++k) v = glm::normalize(glm::transpose(m) * (m * v));
        ASSERT_GE(most, glm::length(m * v)) << i;
        ASSERT_LE(most, glm::length(m * v) * (1.0 + 1e-4)) << i;
    }
    EXPECT_FALSE(std::isfinite(largest_stretch(glm::dmat3(std::numeric_limits<double>::quiet_NaN()))));
}

TEST(PixelsPerUnit, what_is_no_number_allows_no_error_at_all) {
    glm::dmat4 m = perspective(1.0, 1.5, 0.1, 1000, {});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(pixels_per_unit(m, {{0, nan, -5}, 1.0}, kWidth, kHeight),
              std::numeric_limits<double>::infinity());
    m[0][0] = nan;
    EXPECT_EQ(pixels_per_unit(m, {{0, 0, -5}, 1.0}, kWidth, kHeight),
              std::numeric_limits<double>::infinity());
}

TEST(SphereOf, holds_the_corners_of_its_box) {
    Uniform uniform(8);
    for (int i = 0; i < 1000; ++i) {
        Aabb box;
        for (int k = 0; k < 2; ++k) box.grow(glm::vec3(uniform.point(i % 2 == 0 ? 1.0 : 1e7)));
        const BoundingSphere sphere = sphere_of(box);
        for (int c = 0; c < 8; ++c) {
            const glm::dvec3 corner((c & 1 ? box.max : box.min).x, (c & 2 ? box.max : box.min).y,
                                    (c & 4 ? box.max : box.min).z);
            ASSERT_LE(glm::length(corner - sphere.centre), sphere.radius);
        }
    }
    EXPECT_EQ(sphere_of({}).radius, 0.0);
}

}  // namespace
}  // namespace rhview
