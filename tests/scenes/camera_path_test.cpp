// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

namespace rhview {
namespace {

using Vec = glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

CameraPath two_keys(const Vec& from = {0, 0, -1}, const Vec& to = {1, 0, 0}) {
    CameraPath path;
    path.keys = {{1.0, {0, 2, 0}, Vec(0, 2, 0) + from}, {3.0, {10, 2, 4}, Vec(10, 2, 4) + to}};
    return path;
}

Vec direction_of(const View& view) {
    return -Vec(view.camera_from_world[0][2], view.camera_from_world[1][2], view.camera_from_world[2][2]);
}

View view_at(const CameraPath& path, double time) {
    return path.view_at(time, 1.5, ClipDepth::NegativeOneToOne);
}

bool near(const Vec& a, const Vec& b) {
    return glm::distance(a, b) < 1e-12;
}

std::string refusal(const CameraPath& path) {
    const Status status = validate(path);
    return status.ok() ? "no error" : status.error().message;
}

std::string refusal(std::string_view json) {
    const Result<CameraPath> path = parse_camera_path(json, "a.json");
    return path.ok() ? "no error" : path.error().message;
}

TEST(CameraPath, eye_moves_along_the_straight_line_between_keys) {
    const CameraPath path = two_keys();
    ASSERT_TRUE(validate(path).ok());
    EXPECT_TRUE(near(view_at(path, 1.5).eye(), {2.5, 2, 1}));
    EXPECT_TRUE(near(view_at(path, 3.0).eye(), {10, 2, 4}));
}

TEST(CameraPath, direction_turns_along_the_great_circle_at_constant_speed) {
    const CameraPath path = two_keys({0, 0, -3}, {5, 0, 0});
    EXPECT_TRUE(near(direction_of(view_at(path, 1.0)), {0, 0, -1}));
    EXPECT_TRUE(near(direction_of(view_at(path, 2.0)), {std::sqrt(0.5), 0, -std::sqrt(0.5)}));
    EXPECT_TRUE(near(direction_of(view_at(path, 1.0 + 2.0 / 3.0)), {0.5, 0, -std::sqrt(0.75)}));
    const CameraPath still = two_keys({0, 0, -1}, {0, 0, -4});
    EXPECT_TRUE(near(direction_of(view_at(still, 1.7)), {0, 0, -1}));
}

TEST(CameraPath, opposite_directions_turn_about_up) {
    const CameraPath level = two_keys({0, 0, -1}, {0, 0, 2});
    ASSERT_TRUE(validate(level).ok());
    EXPECT_NEAR(std::abs(direction_of(view_at(level, 2.0)).x), 1.0, 1e-12);
    const CameraPath tilted = two_keys({0, 1, -1}, {0, -1, 1});
    ASSERT_TRUE(validate(tilted).ok());
    EXPECT_NEAR(std::abs(direction_of(view_at(tilted, 2.0)).x), 1.0, 1e-12);
    EXPECT_TRUE(near(direction_of(view_at(tilted, 3.0)), {0, -std::sqrt(0.5), std::sqrt(0.5)}));
}

TEST(CameraPath, views_before_and_after_the_keys_are_the_ends) {
    const CameraPath path = two_keys();
    for (const double time : {-kInfinity, -5.0, 1.0, kNan})
        EXPECT_TRUE(near(view_at(path, time).eye(), {0, 2, 0}));
    for (const double time : {3.0, 99.0, kInfinity}) EXPECT_TRUE(near(view_at(path, time).eye(), {10, 2, 4}));
}

TEST(CameraPath, frames_are_evenly_spaced_from_the_first_key_to_the_last) {
    const CameraPath path = two_keys();
    const auto eye = [&](int frame, int frames) {
        return path.view_of_frame(frame, frames, 1.5, ClipDepth::ZeroToOne).eye();
    };
    EXPECT_TRUE(near(eye(0, 5), {0, 2, 0}));
    EXPECT_TRUE(near(eye(1, 5), {2.5, 2, 1}));
    EXPECT_TRUE(near(eye(4, 5), {10, 2, 4}));
    EXPECT_TRUE(near(eye(0, 1), {0, 2, 0}));
}

TEST(CameraPath, lens_and_clip_depth_reach_the_view) {
    CameraPath path = two_keys();
    path.fov_y_deg = 90.0;
    path.far_m = kInfinity;
    ASSERT_TRUE(validate(path).ok());
    const View view = path.view_at(1.0, 2.0, ClipDepth::ReversedZeroToOne);
    EXPECT_EQ(view.clip_depth, ClipDepth::ReversedZeroToOne);
    EXPECT_NEAR(view.clip_from_camera[1][1], 1.0, 1e-12);
    EXPECT_NEAR(view.clip_from_camera[0][0], 0.5, 1e-12);
    EXPECT_TRUE(validate(view).ok());
}

TEST(CameraPath, bad_paths_are_refused_by_key_and_mend) {
    const struct {
        std::function<void(CameraPath&)> spoil;
        const char* sentence;
    } cases[] = {
        {[](CameraPath& p) { p.keys.pop_back(); }, "1 keys; at least two are needed"},
        {[](CameraPath& p) { p.keys[1].time_s = 1.0; },
         "key 1 has time 1, which is not after the key before it (1)"},
        {[](CameraPath& p) { p.keys[0].time_s = kNan; }, "key 0 holds a number that is not finite"},
        {[](CameraPath& p) { p.keys[1].eye.y = kInfinity; }, "key 1 holds a number that is not finite"},
        {[](CameraPath& p) { p.keys[1].target.z = kNan; }, "key 1 holds a number that is not finite"},
        {[](CameraPath& p) { p.keys[1].target = p.keys[1].eye; }, "key 1 has its eye at its target"},
        {[](CameraPath& p) { p.keys[0].target = p.keys[0].eye + Vec(0, -7, 0); },
         "key 0 looks along the up vector"},
        {[](CameraPath& p) {
             p.keys[0].target = {1e308, 0, 0}, p.keys[0].eye = {-1e308, 0, 0};
         },
         "key 0 has its target too far away"},
        {[](CameraPath& p) { p.keys[0].time_s = -1e308, p.keys[1].time_s = 1e308; },
         "key 1 has a time too far"},
        {[](CameraPath& p) { p.fov_y_deg = 180.0; }, "fov_y_deg is 180; it must be above 0 and below 180"},
        {[](CameraPath& p) { p.fov_y_deg = 0.0; }, "fov_y_deg is 0"},
        {[](CameraPath& p) { p.fov_y_deg = kNan; }, "fov_y_deg is nan"},
        {[](CameraPath& p) { p.near_m = 0.0; }, "near is 0; it must be a finite distance above 0"},
        {[](CameraPath& p) { p.near_m = p.far_m = kInfinity; }, "near is inf"},
        {[](CameraPath& p) { p.far_m = p.near_m; }, "far is 0.1; it must be beyond near, which is 0.1"},
        {[](CameraPath& p) { p.far_m = kNan; }, "far is nan"},
        {[](CameraPath& p) { p.up = Vec(0.0); }, "up must be three finite numbers that are not all 0"},
        {[](CameraPath& p) { p.up.x = kNan; }, "up must be three finite numbers"},
    };
    for (const auto& c : cases) {
        CameraPath path = two_keys();
        c.spoil(path);
        EXPECT_NE(refusal(path).find(c.sentence), std::string::npos)
            << refusal(path) << " lacks: " << c.sentence;
    }
}

TEST(CameraPath, a_turn_over_the_pole_between_good_keys_is_refused) {
    for (const double up : {1.0, -1.0}) {
        const CameraPath over = two_keys({1, 0.5 * up, 0}, {-1, 0.5 * up, 0});
        EXPECT_NE(refusal(over).find("between keys 0 and 1 the camera turns through the up vector"),
                  std::string::npos)
            << refusal(over);
        // A little to the side is enough, and so is a turn the other way round.
        EXPECT_TRUE(validate(two_keys({1, 0.5 * up, 0}, {-1, 0.5 * up, 0.01})).ok());
        EXPECT_TRUE(validate(two_keys({1, 0.5 * up, 0}, {1, -0.5 * up, 0})).ok());
    }
}

TEST(CameraPath, a_file_with_every_field_is_read) {
    const Result<CameraPath> path = parse_camera_path(
        R"({"schema": "rhview.path/1", "fov_y_deg": 45, "near": 0.5, "far": "infinity", "up": [0, 0, 1],
            "keys": [{"time": 0, "eye": [0, 2, 0], "target": [0, 2.5, -1]},
                     {"time": 5.5, "eye": [9, 2, 0], "target": [10, 2, 0]}]})",
        "a.json");
    ASSERT_TRUE(path.ok()) << path.error().message;
    EXPECT_EQ(path->fov_y_deg, 45.0);
    EXPECT_EQ(path->near_m, 0.5);
    EXPECT_EQ(path->far_m, kInfinity);
    EXPECT_EQ(path->up, Vec(0, 0, 1));
    ASSERT_EQ(path->keys.size(), 2u);
    EXPECT_EQ(path->keys[1].time_s, 5.5);
    EXPECT_EQ(path->keys[0].target, Vec(0, 2.5, -1));
}

TEST(CameraPath, bad_text_is_refused_by_name_place_and_mend) {
    const std::string keys = R"("keys": [{"time": 0, "eye": [0, 2, 0], "target": [0, 2, -1]},)"
                             R"({"time": 5, "eye": [9, 2, 0], "target": [9, 2, -1]}]})";
    const std::string start = R"({"schema": "rhview.path/1", )";
    const struct {
        std::string text;
        const char* sentence;
    } cases[] = {
        {"", "a.json: not JSON at line 1, column 1"},
        {"{\n \"schema\" 3}", "a.json: not JSON at line 2, column 11"},
        {"\xff\xfe", "a.json: not JSON"},
        {"[1, 2]", "a.json: the path is not a JSON object"},
        {R"({"keys": []})", "a.json: the path has no field \"schema\"; add it"},
        {R"({"schema": "rhview.path/2"})",
         "another schema than this program reads; it must be \"rhview.path/1\""},
        {R"({"schema": 1})", "another schema"},
        {start + R"("near": 1})", "a.json: the path has no field \"keys\"; add it"},
        {start + R"("keys": 4})", "has \"keys\" that are not a list"},
        {start + R"("keys": []})", "a.json: camera path: 0 keys; at least two are needed"},
        {start + R"("speed": 1, )" + keys,
         "a.json: the path has an unknown field \"speed\"; the fields are schema"},
        {start + R"("near": "x", )" + keys, "a.json: the path has a \"near\" that is not a number"},
        {start + R"("far": "far", )" + keys, "neither a number nor the string \"infinity\""},
        {start + R"("far": 1e999, )" + keys,
         "a.json: not JSON that can be read: it holds a number too large"},
        {start + R"("up": [0, 1], )" + keys, "a \"up\" that is not three numbers, as in [0, 1, 0]"},
        {start + R"("fov_y_deg": 200, )" + keys, "a.json: camera path: fov_y_deg is 200"},
        {start + R"("keys": [7]})", "a.json: key 0 is not a JSON object"},
        {start +
             R"("keys": [{"time": 0, "eye": [0, 0, 0], "target": [1, 0, 0]}, {"time": 1, "eye": [0, 0, 0]}]})",
         "a.json: key 1 has no field \"target\"; add it"},
        {start + R"("keys": [{"time": 0, "eye": [0, "a", 0], "target": [1, 0, 0]}]})",
         "a.json: key 0 has a \"eye\" that is not three numbers"},
        {start + R"("keys": [{"time": 0, "eye": [0, 0, 0], "target": [1, 0, 0], "roll": 1}]})",
         "a.json: key 0 has an unknown field \"roll\"; the fields are time, eye, target"},
    };
    for (const auto& c : cases)
        EXPECT_NE(refusal(c.text).find(c.sentence), std::string::npos)
            << refusal(c.text) << " lacks: " << c.sentence;
    EXPECT_EQ(refusal(start + keys), "no error");
}

TEST(CameraPath, files_that_cannot_be_read_are_refused_by_name) {
    const std::filesystem::path folder = ::testing::TempDir();
    const std::filesystem::path file = folder / "rhview_camera_path_test.json";
    std::filesystem::remove(file);
    const Result<CameraPath> missing = load_camera_path(file);
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().message, file.string() + ": there is no such file; check the path");
    const Result<CameraPath> directory = load_camera_path(folder);
    ASSERT_FALSE(directory.ok());
    EXPECT_EQ(directory.error().message, folder.string() + ": this is a folder; name a path file");

    std::ofstream(file)
        << R"({"schema": "rhview.path/1", "keys": [{"time": 0, "eye": [0, 2, 0], "target": [0, 2, -1]},)"
        << R"({"time": 5, "eye": [9, 2, 0], "target": [9, 2, -1]}]})";
    EXPECT_TRUE(load_camera_path(file).ok());
    std::filesystem::resize_file(file, 60);
    const Result<CameraPath> truncated = load_camera_path(file);
    ASSERT_FALSE(truncated.ok());
    EXPECT_EQ(truncated.error().message.rfind(file.string() + ": not JSON at line 1", 0), 0u);
    std::filesystem::remove(file);
}

TEST(CameraPath, written_as_text_comes_back_to_the_last_bit) {
    CameraPath path;
    path.fov_y_deg = 100.0 / 3.0;
    path.near_m = 0.1;
    path.far_m = std::numeric_limits<double>::infinity();
    path.up = {0.1, 1.0 / 7.0, 1e-17};
    path.keys = {{0.1, {1e7 / 3.0, -2.0, 1e-300}, {1.0, 2.0, 3.0}},
                 {2e5 / 3.0, {1.0, 2.0, 3.0}, {4.0, 2.0, 3.1}}};
    for (const double far : {path.far_m, 2000.0 / 3.0}) {
        path.far_m = far;
        const Result<CameraPath> again = parse_camera_path(to_json(path), "again");
        ASSERT_TRUE(again.ok()) << again.error().message;
        EXPECT_EQ(again->fov_y_deg, path.fov_y_deg);
        EXPECT_EQ(again->near_m, path.near_m);
        EXPECT_EQ(again->far_m, path.far_m);
        EXPECT_EQ(again->up, path.up);
        ASSERT_EQ(again->keys.size(), path.keys.size());
        for (std::size_t i = 0; i < path.keys.size(); ++i) {
            EXPECT_EQ(again->keys[i].time_s, path.keys[i].time_s);
            EXPECT_EQ(again->keys[i].eye, path.keys[i].eye);
            EXPECT_EQ(again->keys[i].target, path.keys[i].target);
        }
    }
}

TEST(CameraPath, a_key_every_64th_of_a_second_is_walked_as_it_was_flown) {
    for (const int frames : {2, 3, 7, 50, 97, 1000}) {
        CameraPath path;
        for (int i = 0; i < frames; ++i) {
            const double angle = 0.1 * i;
            const Vec eye(100.0 / 3.0 * i, 2.0 / 7.0, 0.1 * i);
            path.keys.push_back({i / 64.0, eye, eye + Vec(std::sin(angle), 0.2, std::cos(angle))});
        }
        for (int i = 0; i < frames; ++i) {
            CameraPath alone = path;
            alone.keys = {path.keys[static_cast<std::size_t>(i)], path.keys[static_cast<std::size_t>(i)]};
            EXPECT_EQ(path.time_of_frame(i, frames), i / 64.0);
            const View walked = path.view_of_frame(i, frames, 1.5, ClipDepth::ReversedZeroToOne);
            const View flown = alone.view_at(0.0, 1.5, ClipDepth::ReversedZeroToOne);
            ASSERT_EQ(walked.camera_from_world, flown.camera_from_world) << i << " of " << frames;
        }
    }
}

TEST(WalkthroughOfBounds, is_valid_and_keeps_the_scene_in_range_for_any_bounds) {
    const struct {
        Aabb bounds;
        Vec origin{0.0};
    } cases[] = {
        {{{-5, 0, -8}, {5, 3, 8}}},
        {{{-1000, 0, -1000}, {1000, 0, 1000}}},  // flat
        {{{0, -2, 0}, {2000, 60, 2000}}},
        {{{-1, 0, -1}, {1, 300, 1}}},            // tall
        {{{0, 0, -500}, {3, 4, 500}}},           // elongated
        {{{0, 0, 0}, {700, 0, 0}}},              // a line
        {{{7, 7, 7}, {7, 7, 7}}},                // a point
        {{{1e7f, 0, -1e7f}, {1e7f, 0, -1e7f}}},  // a point far away
        {{{0, 0, 0}, {1, 1, 1}}, {1e9, -1e9, 5e8}},
        {{{-1e-6f, 0, 0}, {1e-6f, 1e-6f, 1e-6f}}},
        {{{-1e30f, -1e30f, -1e30f}, {1e30f, 1e30f, 1e30f}}},
    };
    for (const auto& c : cases) {
        const CameraPath path = walkthrough_of_bounds(c.bounds, c.origin);
        const Status status = validate(path);
        EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
        EXPECT_GE(path.near_m, 1e-6 * path.far_m);
        const Vec low = Vec(c.bounds.min) + c.origin, high = Vec(c.bounds.max) + c.origin;
        for (int frame = 0; frame < 50; ++frame) {
            const View view = path.view_of_frame(frame, 50, 1.5, ClipDepth::ZeroToOne);
            ASSERT_TRUE(validate(view).ok());
            const Vec farthest = glm::max(glm::abs(view.eye() - low), glm::abs(view.eye() - high));
            EXPECT_LE(glm::length(farthest), path.far_m);
            EXPECT_GE(view.eye().y, low.y);
        }
    }
}

TEST(WalkthroughOfBounds, begins_inside_at_eye_level_and_ends_with_an_overview) {
    const Aabb bounds{{-20, 5, -60}, {20, 15, 60}};
    const CameraPath path = walkthrough_of_bounds(bounds, {100, 0, 0});
    const Vec first = path.keys.front().eye - Vec(100, 0, 0);
    EXPECT_NEAR(first.y, 6.0, 0.1);
    EXPECT_LT(std::abs(first.x), 20.0);
    EXPECT_LT(std::abs(first.z), 60.0);
    // The last view sees the middle from outside and above.
    const CameraKey& last = path.keys.back();
    EXPECT_GT(last.eye.y, 15.0);
    EXPECT_LT(glm::distance(last.target, Vec(100, 9, 0)), 2.0);
    EXPECT_GT(glm::distance(last.eye, last.target), 50.0);
}

}  // namespace
}  // namespace rhview
