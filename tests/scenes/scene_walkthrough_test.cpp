// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>

#include "rhview/scenes/camera_path.h"
#include "rhview/scenes/scene_builder.h"

namespace rhview {
namespace {

float hill(float x, float z) {
    return 150.0f * std::exp(-(x * x + z * z) / 90000.0f);
}

/// A hill of 150 m in a plain of 2 km, and a house on top.
Scene hill_with_house(const glm::dvec3& origin) {
    constexpr int kSide = 80;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int i = 0; i <= kSide; ++i) {
        for (int k = 0; k <= kSide; ++k) {
            const float x = -1000.0f + 25.0f * static_cast<float>(i),
                        z = -1000.0f + 25.0f * static_cast<float>(k);
            positions.emplace_back(x, hill(x, z), z);
            if (i == kSide || k == kSide) continue;
            const auto corner = static_cast<std::uint32_t>(i * (kSide + 1) + k);
            indices.insert(indices.end(), {corner, corner + 1, corner + kSide + 1});
            indices.insert(indices.end(), {corner + 1, corner + kSide + 2, corner + kSide + 1});
        }
    }
    SceneBuilder builder(origin);
    const MaterialId material = builder.add_material({});
    glm::dmat4 place(1.0);
    place[3] = glm::dvec4(origin, 1.0);
    builder.add_static(material, {positions, {}, {}, indices}, place);
    const std::vector<glm::vec3> house{{-20, 150, 0}, {20, 150, 0}, {0, 200, 0}};
    const std::vector<std::uint32_t> triangle{0, 1, 2};
    builder.add_static(material, {house, {}, {}, triangle}, place);
    return builder.finish("hill").value();
}

TEST(WalkthroughOfScene, keeps_above_the_ground_and_below_the_roofs_wherever_the_scene_is) {
    for (const glm::dvec3 origin : {glm::dvec3(0.0), glm::dvec3(5e6, -300.0, 1e6)}) {
        const Scene scene = hill_with_house(origin);
        const CameraPath path = walkthrough_of_scene(scene);
        ASSERT_TRUE(validate(path).ok()) << validate(path).error().message;
        double highest_walk = 0.0;
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 eye = path.view_of_frame(i, 200, 1.5, ClipDepth::ZeroToOne).eye() - origin;
            const double ground =
                static_cast<double>(hill(static_cast<float>(eye.x), static_cast<float>(eye.z)));
            EXPECT_GT(eye.y, ground) << "frame " << i;
            if (i < 100) {
                EXPECT_LT(eye.y, ground + 120.0) << "frame " << i;
                highest_walk = std::max(highest_walk, eye.y);
            }
        }
        EXPECT_GT(highest_walk, 140.0);  // over the hill, not through it
        EXPECT_EQ(walkthrough_of_scene(scene).keys.size(), path.keys.size());
    }
}

TEST(WalkthroughOfScene, scene_of_one_triangle_gets_a_path) {
    SceneBuilder builder;
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    builder.add_static(builder.add_material({}), {positions, {}, {}, indices});
    EXPECT_TRUE(validate(walkthrough_of_scene(builder.finish("one").value())).ok());
}

}  // namespace
}  // namespace rhview
