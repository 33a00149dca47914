// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/aabb.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace rhview {
namespace {

TEST(Aabb, default_is_empty_and_the_identity_of_grow) {
    Aabb box;
    EXPECT_TRUE(box.is_empty());
    box.grow(Aabb{});
    EXPECT_TRUE(box.is_empty());
    box.grow(glm::vec3(1, 2, 3));
    EXPECT_FALSE(box.is_empty());
    EXPECT_EQ(box, (Aabb{glm::vec3(1, 2, 3), glm::vec3(1, 2, 3)}));
}

TEST(Aabb, box_with_nan_is_empty) {
    Aabb box{glm::vec3(0), glm::vec3(1)};
    box.max.y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(box.is_empty());
}

TEST(Aabb, centre_of_the_largest_box_does_not_overflow) {
    constexpr float kMax = std::numeric_limits<float>::max();
    EXPECT_EQ((Aabb{glm::vec3(kMax), glm::vec3(kMax)}).centre(), glm::vec3(kMax));
}

TEST(Aabb, transformed_box_contains_every_transformed_corner) {
    std::mt19937 random(1);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    for (int i = 0; i < 2000; ++i) {
        const Aabb box{glm::vec3(uniform(-9, 0), uniform(-9, 0), uniform(-9, 0)),
                       glm::vec3(uniform(0, 9), uniform(0, 9), uniform(0, 9))};
        const double scale = i % 2 == 0 ? 1.0 : -3.0;
        glm::dmat4 map = glm::translate(glm::dmat4(1.0), glm::dvec3(uniform(-1e6, 1e6), 7.0, -1e3));
        map = glm::rotate(map, uniform(0, 6.3), glm::dvec3(uniform(0.1, 1), uniform(0, 1), uniform(0, 1)));
        map = glm::scale(map, glm::dvec3(scale, 2.0, 0.5));
        const Aabb image = transform_box(map, box);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec4 point((corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                                   (corner & 4 ? box.max : box.min).z, 1.0);
            const glm::dvec3 moved(map * point);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(static_cast<double>(image.min[axis]), moved[axis]);
                EXPECT_GE(static_cast<double>(image.max[axis]), moved[axis]);
            }
        }
    }
    EXPECT_TRUE(transform_box(glm::dmat4(2.0), Aabb{}).is_empty());
}

}  // namespace
}  // namespace rhview
