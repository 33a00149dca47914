// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Conditional draws on real pixels: what hangs on queries leaves the depths of drawing everything, bit for
// bit, and the answers say what was drawn.

#include <epoxy/gl.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "any_target.h"
#include "occlusion_fixture.h"

namespace rhview::gl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct RandomCase {
    ClipDepth depth;
    double far;
    bool orthographic;
    double offset;
};

class RandomScenes : public OcclusionTest, public testing::WithParamInterface<RandomCase> {};

TEST_P(RandomScenes, conditional_draws_leave_the_depths_of_drawing_everything) {
    const auto [depth, far, orthographic_view, offset] = GetParam();
    const glm::dvec3 origin(offset, -offset, 0.5 * offset);
    Uniform uniform(71);
    std::size_t hidden = 0, asked = 0, covered = 0;
    for (unsigned seed = 0; seed < 4; ++seed) {
        const CellScene cells = CellMaker(100 + seed).make(400, 12.0, origin);
        const SceneBuffers buffers = SceneBuffers::upload(cells.scene).value();
        QueryPlanner planner;
        for (int v = 0; v < 12; ++v) {
            planner.hardware = v % 3 != 1;
            planner.box_pass = v % 3 != 0;
            planner.stride = 2 + static_cast<std::size_t>(v % 3);
            const glm::dvec3 eye = uniform.point(v % 4 == 0 ? 30.0 : 14.0);
            const glm::dvec3 target = uniform.point(6.0);
            View view = view_at(origin + eye, target - eye, depth, far);
            if (orthographic_view) view.clip_from_camera = orthographic(24.0, 18.0, 0.1, far, depth);
            const FramePlan plan = planner.plan(cells.cells);
            DrawOptions options;
            if (v % 2 == 0) options.submission = Submission::MultiDraw;
            EXPECT_EQ(missing(plan, cells.cells, buffers, view, options), 0u) << seed << " " << v;
            const auto known = answers();
            EXPECT_EQ(known.size(), plan.queries.size());
            asked += known.size();
            for (const auto& [ticket, answer] : known) hidden += !answer.visible;
            covered += covered_pixels(depths_of(everything(cells.cells), buffers, view), depth);
        }
    }
    EXPECT_GT(hidden, asked / 10);
    EXPECT_LT(hidden, asked);
    EXPECT_GT(covered, 100'000u);
    EXPECT_EQ(executor_->answer_counters().lost, 0u);
}

INSTANTIATE_TEST_SUITE_P(Views, RandomScenes,
                         testing::Values(RandomCase{ClipDepth::NegativeOneToOne, 1000.0, false, 0.0},
                                         RandomCase{ClipDepth::ZeroToOne, 100.0, false, 0.0},
                                         RandomCase{ClipDepth::ReversedZeroToOne, kInfinity, false, 0.0},
                                         RandomCase{ClipDepth::ReversedZeroToOne, 100.0, false, 1e6},
                                         RandomCase{ClipDepth::NegativeOneToOne, 1e6, false, 1e6},
                                         RandomCase{ClipDepth::NegativeOneToOne, 100.0, true, 0.0},
                                         RandomCase{ClipDepth::ReversedZeroToOne, 100.0, true, 1e5}));

/// A view, and what one metre across it at one metre's distance is in pixels.
struct ViewCase {
    ClipDepth depth;
    double far;
};

class ViewCases : public OcclusionTest, public testing::WithParamInterface<ViewCase> {};

// The smallest that can be seen: a sample or none, in a box that has no more. All that is drawn hangs on its
// own query.
TEST_P(ViewCases, pieces_smaller_than_a_pixel_do_not_vanish) {
    const auto [depth, far] = GetParam();
    Uniform uniform(81);
    QueryPlanner planner{.hardware = false, .stride = 2, .at_once = 0, .most_boxes = 1};
    for (unsigned seed = 0; seed < 8; ++seed) {
        const double distance = seed % 2 ? 9.0 : 60.0;
        const double pixel = distance / 110.0;
        const CellScene cells = scatter_pieces(
            seed, 15'000, 1.5 * pixel, static_cast<int>(seed % 4) - 1, 0, [&](Uniform& random) {
                return glm::dvec3(random(-1, 1), random(-1, 1), random(-0.02, 0.02)) * distance;
            });
        const SceneBuffers buffers = SceneBuffers::upload(cells.scene).value();
        const glm::dvec3 eye(uniform(-1, 1), uniform(-1, 1), distance);
        const View view = view_at(eye, {uniform(-0.3, 0.3), uniform(-0.3, 0.3), -1}, depth, far);
        EXPECT_EQ(missing(planner.plan(cells.cells), cells.cells, buffers, view), 0u) << seed;
        std::size_t visible = 0;
        for (const auto& [ticket, answer] : answers()) visible += answer.visible;
        EXPECT_GT(visible, 1000u);
        EXPECT_LT(visible, 15'000u) << "most cover no sample";
    }
}

// The depths of a wall and of pieces in its plane differ by rounding alone.
TEST_P(ViewCases, pieces_in_the_plane_of_what_hides_them_change_no_depth) {
    const auto [depth, far] = GetParam();
    Uniform uniform(82);
    QueryPlanner planner{.hardware = false, .stride = 2, .at_once = 0, .most_boxes = 1, .walls = 40};
    for (unsigned seed = 0; seed < 9; ++seed) {
        const int axis = static_cast<int>(seed % 3);
        // From afar a step of the depth buffer is metres.
        const double scale = seed < 3 ? 1.0 : seed < 6 ? 50.0 : 1000.0;
        CellScene cells = scatter_pieces(200 + seed, 15'000, 0.1 * scale, axis, 40, [&](Uniform& random) {
            glm::dvec3 p = scale * random.point(20.0);
            p[axis] = scale * (random(0, 1) < 0.8 ? -3.0 : -3.0 - 1e-6);
            return p;
        });
        const SceneBuffers buffers = SceneBuffers::upload(cells.scene).value();
        glm::dvec3 eye = scale * uniform.point(20.0), forward = uniform.point(1.0);
        eye[axis] = scale * (-3.0 + uniform.log(0.3, 20.0));
        forward[axis] = -uniform(0.2, 1.0);
        const View view = view_at(eye, forward, depth, far);
        FramePlan plan = planner.plan(cells.cells);
        EXPECT_EQ(missing(plan, cells.cells, buffers, view), 0u) << seed;
        std::size_t hidden = 0;
        for (const auto& [ticket, answer] : answers()) hidden += !answer.visible;
        EXPECT_GT(hidden, 100u);
    }
}

// The larger the picture, the larger the rounding of steep depths.
TEST_P(ViewCases, large_pictures_lose_no_pixel_of_steep_triangles) {
    const auto [depth, far] = GetParam();
    target_.emplace(RenderTarget::create(1920, 1080).value());
    Uniform uniform(84);
    QueryPlanner planner;
    for (unsigned seed = 0; seed < 3; ++seed) {
        const CellScene cells = CellMaker(400 + seed).make(500, 12.0);
        const SceneBuffers buffers = SceneBuffers::upload(cells.scene).value();
        for (int v = 0; v < 3; ++v) {
            const glm::dvec3 eye = uniform.point(14.0);
            const View view = view_at(eye, uniform.point(4.0) - eye, depth, far);
            EXPECT_EQ(missing(planner.plan(cells.cells), cells.cells, buffers, view), 0u) << seed << " " << v;
            answers();
        }
    }
}

// Objects are transformed in their own space: other matrices, other rounding.
TEST_P(ViewCases, conditional_objects_leave_the_depths_of_drawing_them_all) {
    const auto [depth, far] = GetParam();
    Uniform uniform(83);
    std::size_t hidden = 0, asked = 0;
    for (unsigned seed = 0; seed < 6; ++seed) {
        SceneBuilder builder;
        const MaterialId material = builder.add_material({"", glm::vec3(0.8f), true, false});
        const MeshId mesh = builder.add_mesh(material, triangle_piece()).value();
        for (int i = 0; i < 600; ++i) {
            glm::dmat4 place = glm::translate(glm::dmat4(1.0), uniform.point(12.0));
            if (i % 4 != 0) place = glm::rotate(place, uniform(0, 6), uniform.point(1.0));
            if (i % 4 == 3) place[1] += 3.0 * place[0];
            const double size = i < 20 ? 10.0 : uniform.log(0.02, 3.0);
            builder.add_dynamic(
                mesh, glm::translate(glm::scale(place, glm::dvec3(size, size, i % 2 ? 0.01 : -size)),
                                     glm::dvec3(0, 0, 5)));
        }
        const Scene scene = builder.finish("objects").value();
        const SceneBuffers buffers = SceneBuffers::upload(scene).value();
        FramePlan whole, plan;
        for (std::uint32_t i = 0; i < scene.dynamic_objects.size(); ++i) {
            whole.objects.push_back(ObjectId{i});
            if (i < 20) {
                plan.objects.push_back(ObjectId{i});
                continue;
            }
            const QueryWay way = i % 2 ? QueryWay::BoxPass : QueryWay::HardwareQuery;
            plan.queries.push_back({i, static_cast<std::uint32_t>(plan.query_boxes.size()), 1, way, false});
            plan.query_boxes.push_back(
                transform_box(scene.dynamic_objects[i].scene_from_mesh, scene.meshes[0].bounds));
            plan.conditional_objects.push_back(
                {ObjectId{i}, static_cast<std::uint32_t>(plan.queries.size() - 1)});
        }
        const glm::dvec3 eye = uniform.point(16.0);
        const View view = view_at(eye, uniform.point(4.0) - eye, depth, far);
        const std::vector<float> reference = depths_of(whole, buffers, view);
        EXPECT_EQ(count_missing_pixels(depths_of(plan, buffers, view), reference), 0u) << seed;
        asked += plan.queries.size();
        for (const auto& [ticket, answer] : answers()) hidden += !answer.visible;
    }
    EXPECT_GT(hidden, asked / 20);
    EXPECT_LT(hidden, asked);
}

// As latent mode asks about what it left out: nothing hangs on the answer.
TEST_P(ViewCases, objects_that_are_asked_about_and_not_drawn_are_seen_where_they_would_show) {
    const auto [depth, far] = GetParam();
    Uniform uniform(85);
    SceneBuilder builder;
    const MaterialId material = builder.add_material({"", glm::vec3(0.8f), true, false});
    const MeshId mesh = builder.add_mesh(material, triangle_piece()).value();
    // Turned, then squashed: what rounds in their own space is much in the scene's.
    const glm::dmat4 squashed = glm::scale(glm::dmat4(1.0), {1.0, 0.01, 30.0});
    for (int i = 0; i < 200; ++i) {
        glm::dmat4 place = glm::translate(squashed, uniform.point(36.0));
        place = glm::rotate(place, uniform(0, 6), glm::normalize(uniform.point(1.0) + 1.1));
        place = glm::scale(place, glm::dvec3(uniform.log(0.3, 6.0)));
        builder.add_dynamic(mesh, glm::translate(place, glm::dvec3(0, 0, 5)));
    }
    const Scene scene = builder.finish("squashed").value();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    FramePlan asking;
    for (std::uint32_t i = 0; i < scene.dynamic_objects.size(); ++i) {
        if (i % 2 == 0) {
            asking.objects.push_back(ObjectId{i});
            continue;
        }
        const auto box = static_cast<std::uint32_t>(asking.query_boxes.size());
        asking.queries.push_back(
            {i, box, 1, i % 4 == 1 ? QueryWay::BoxPass : QueryWay::HardwareQuery, false});
        asking.query_boxes.push_back(
            transform_box(scene.dynamic_objects[i].scene_from_mesh, scene.meshes[0].bounds));
    }
    std::size_t seen = 0, hidden = 0;
    for (int v = 0; v < 60; ++v) {
        const glm::dvec3 eye = uniform.point(45.0);
        const View view = view_at(eye, uniform.point(12.0) - eye, depth, far);
        const std::vector<float> without = depths_of(asking, buffers, view);
        FramePlan with;
        with.objects = asking.objects;
        for (const auto& [object, answer] : answers()) {
            if (!answer.visible) with.objects.push_back(ObjectId{static_cast<std::uint32_t>(object)});
            seen += answer.visible ? 1 : 0;
        }
        hidden += with.objects.size() - asking.objects.size();
        EXPECT_EQ(count_missing_pixels(depths_of(with, buffers, view), without), 0u) << v;
    }
    EXPECT_GT(hidden, 100u);
    EXPECT_GT(seen, 100u);
}

INSTANTIATE_TEST_SUITE_P(Depths, ViewCases,
                         testing::Values(ViewCase{ClipDepth::NegativeOneToOne, 1e5},
                                         ViewCase{ClipDepth::ZeroToOne, 1e5},
                                         ViewCase{ClipDepth::ReversedZeroToOne, kInfinity}));

struct TargetCase {
    GLenum format;
    int samples;
    ClipDepth depth;
};

class Targets : public OcclusionTest, public testing::WithParamInterface<TargetCase> {};

TEST_P(Targets, conditional_draws_leave_the_depths_of_every_sample) {
    const auto [format, samples, depth] = GetParam();
    AnyTarget target(format, samples);
    Uniform uniform(91);
    std::size_t hidden = 0, asked = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        const bool dust = seed >= 8;
        const CellScene cells = dust ? scatter_pieces(seed, 8'000, 0.3, static_cast<int>(seed % 3), 0,
                                                      [](Uniform& random) { return random.point(8.0); })
                                     : CellMaker(300 + seed).make(400, 12.0);
        const SceneBuffers buffers = SceneBuffers::upload(cells.scene).value();
        const glm::dvec3 eye = uniform.point(14.0);
        const View view = view_at(eye, uniform.point(4.0) - eye, depth, 100.0);
        QueryPlanner planner{.hardware = !dust, .stride = 3, .at_once = dust ? 0u : 1u, .most_boxes = 2};
        const FramePlan plan = planner.plan(cells.cells);
        target.begin(depth);
        executor_->draw(everything(cells.cells), buffers, view);
        const std::vector<float> whole = target.read(*target_);
        target.begin(depth);
        executor_->draw(plan, buffers, view);
        EXPECT_EQ(count_missing_pixels(target.read(*target_), whole), 0u) << seed;
        EXPECT_GT(covered_pixels(whole, depth), 100u);
        asked += plan.queries.size();
        for (const auto& [ticket, answer] : answers()) hidden += !answer.visible;
    }
    EXPECT_GT(hidden, asked / 20);
    EXPECT_LT(hidden, asked);
}

INSTANTIATE_TEST_SUITE_P(Formats, Targets,
                         testing::Values(TargetCase{GL_DEPTH_COMPONENT32F, 4, ClipDepth::NegativeOneToOne},
                                         TargetCase{GL_DEPTH_COMPONENT32F, 4, ClipDepth::ReversedZeroToOne},
                                         TargetCase{GL_DEPTH24_STENCIL8, 1, ClipDepth::NegativeOneToOne},
                                         TargetCase{GL_DEPTH24_STENCIL8, 4, ClipDepth::ReversedZeroToOne},
                                         TargetCase{GL_DEPTH_COMPONENT16, 1, ClipDepth::ZeroToOne}));

}  // namespace
}  // namespace rhview::gl
