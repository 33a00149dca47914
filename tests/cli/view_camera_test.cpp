// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "view_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace rhview::cli {
namespace {

using Vec = glm::dvec3;

CameraPath straight_path(const Vec& up = {0, 1, 0}) {
    CameraPath path;
    path.up = up;
    path.keys = {{0.0, {1, 2, 3}, {1, 2, -7}}, {2.0, {1, 2, -5}, {1, 2, -15}}};
    return path;
}

void expect_near(const Vec& a, const Vec& b) {
    EXPECT_LT(glm::distance(a, b), 1e-9) << a.x << " " << a.y << " " << a.z;
}

TEST(FlyCamera, begins_where_the_path_does_and_as_fast) {
    const FlyCamera camera(straight_path());
    expect_near(camera.eye(), {1, 2, 3});
    expect_near(camera.direction(), {0, 0, -1});
    EXPECT_DOUBLE_EQ(camera.speed, 4.0);
}

TEST(FlyCamera, flies_along_its_own_axes) {
    FlyCamera camera(straight_path());
    camera.speed = 10.0;
    camera.move(kForward, 0.5);
    expect_near(camera.eye(), {1, 2, -2});
    camera.move(kBack | kRight, 0.5);
    expect_near(camera.eye(), {6, 2, 3});
    camera.move(kLeft | kUp, 0.5);
    expect_near(camera.eye(), {1, 7, 3});
    camera.move(kDown | kFast, 0.125);
    expect_near(camera.eye(), {1, 2, 3});
    camera.move(kForward | kBack, 1.0);
    expect_near(camera.eye(), {1, 2, 3});
    camera.turn(std::acos(0.0), 0.0);
    expect_near(camera.direction(), {1, 0, 0});
    camera.move(kForward, 0.1);
    expect_near(camera.eye(), {2, 2, 3});
}

TEST(FlyCamera, never_tips_over_however_far_it_turns) {
    FlyCamera camera(straight_path());
    for (const double up : {100.0, -100.0}) {
        camera.turn(0.3, up);
        EXPECT_GT(glm::length(glm::cross(camera.direction(), Vec(0, 1, 0))), 0.01);
        EXPECT_EQ(camera.direction().y > 0.0, up > 0.0);
        EXPECT_TRUE(validate(camera.view(1.5, ClipDepth::ReversedZeroToOne)).ok());
    }
}

TEST(FlyCamera, knows_any_up_vector) {
    for (const Vec& up : {Vec(0, 0, 1), Vec(0, 0, -3), Vec(1, 2, 0.5)}) {
        CameraPath path = straight_path(up);
        path.keys[0].target = {4, 3, 2};
        FlyCamera camera(path);
        expect_near(camera.direction(), glm::normalize(Vec(3, 1, -1)));
        const double height = glm::dot(camera.eye(), glm::normalize(up));
        camera.move(kUp, 1.0);
        EXPECT_NEAR(glm::dot(camera.eye(), glm::normalize(up)), height + camera.speed, 1e-9);
        camera.move(kRight, 1.0);
        EXPECT_NEAR(glm::dot(camera.eye(), glm::normalize(up)), height + camera.speed, 1e-9);
    }
}

TEST(FlyCamera, sees_what_a_path_with_its_key_shows_to_the_last_bit) {
    FlyCamera camera(straight_path());
    for (int i = 0; i < 50; ++i) {
        camera.turn(0.1 * i, 0.03 * (i % 7 - 3));
        camera.move(kForward | kRight, 1.0 / 3.0);
        CameraPath path = camera.lens();
        path.keys = {camera.key(0.0), camera.key(1.0)};
        ASSERT_TRUE(validate(path).ok());
        const Result<CameraPath> read = parse_camera_path(to_json(path), "flown");
        ASSERT_TRUE(read.ok());
        const View flown = camera.view(1.6, ClipDepth::ReversedZeroToOne);
        const View walked = read->view_at(0.0, 1.6, ClipDepth::ReversedZeroToOne);
        EXPECT_EQ(flown.camera_from_world, walked.camera_from_world);
        EXPECT_EQ(flown.clip_from_camera, walked.clip_from_camera);
    }
}

TEST(FlyCamera, has_a_direction_far_from_the_origin_too) {
    CameraPath path = straight_path();
    for (CameraKey& key : path.keys) {
        key.eye += Vec(1e7, 0, -1e7);
        key.target += Vec(1e7, 0, -1e7);
    }
    FlyCamera camera(path);
    camera.turn(0.7, 0.1);
    const CameraKey key = camera.key(0.0);
    EXPECT_LT(glm::distance(glm::normalize(key.target - key.eye), camera.direction()), 1e-8);
}

}  // namespace
}  // namespace rhview::cli
