// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/calibration.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "gl_fixture.h"
#include "rhview/gl/work_counter.h"
#include "rhview/scenes/named_scene.h"

namespace rhview::gl {
namespace {

Scene small_scene(const char* spec = "indoor:rooms=2,floors=1") {
    return make_named_scene(spec).value().scene;
}

DesignOptions small_design() {
    DesignOptions options;
    options.frames = 60;
    options.most_indices = 2e5;
    options.most_draw_calls = 500.0;
    options.aspect = 4.0 / 3.0;
    return options;
}

double indices_of(const FramePlan& plan) {
    double sum = 0.0;
    for (const DrawRange& range : plan.opaque) sum += static_cast<double>(range.index_count);
    return sum;
}

TEST(ExperimentDesign, equal_input_gives_an_equal_design_and_another_seed_another) {
    const Scene scene = small_scene();
    DesignOptions options = small_design();
    const auto first = design_experiment(scene, {}, options);
    const auto again = design_experiment(scene, {}, options);
    ++options.seed;
    const auto other = design_experiment(scene, {}, options);
    ASSERT_EQ(first.size(), 60u);
    bool differs = false;
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(plan_hash(first[i].plan), plan_hash(again[i].plan));
        EXPECT_EQ(first[i].view.camera_from_world, again[i].view.camera_from_world);
        EXPECT_EQ(first[i].queried_boxes, again[i].queried_boxes);
        differs |= plan_hash(first[i].plan) != plan_hash(other[i].plan);
    }
    EXPECT_TRUE(differs);
}

TEST(ExperimentDesign, ranges_lie_in_their_batches_and_stand_by_batch) {
    const Scene scene = small_scene();
    std::vector<std::uint32_t> first_of_batch{0};
    for (const SceneBatch& batch : scene.batches)
        first_of_batch.push_back(first_of_batch.back() + static_cast<std::uint32_t>(batch.indices.size()));
    for (const ExperimentFrame& frame : design_experiment(scene, {}, small_design())) {
        EXPECT_TRUE(validate(frame.view).ok());
        EXPECT_TRUE(std::ranges::is_sorted(frame.plan.opaque, {}, &DrawRange::batch));
        for (const DrawRange& range : frame.plan.opaque) {
            EXPECT_GT(range.index_count, 0u);
            EXPECT_EQ(range.index_count % 3, 0u);
            EXPECT_EQ(range.first_index % 3, 0u);
            EXPECT_GE(range.first_index, first_of_batch[index_of(range.batch)]);
            EXPECT_LE(range.first_index + range.index_count, first_of_batch[index_of(range.batch) + 1]);
        }
    }
}

TEST(ExperimentDesign, every_amount_varies_on_its_own) {
    const Scene scene = small_scene();
    int plain = 0, multi = 0, with_queries = 0, few_indices = 0, many_indices = 0, one_call = 0,
        many_calls = 0;
    int one_batch = 0, many_batches = 0, many_calls_of_few_indices = 0, few_calls_of_many_indices = 0;
    for (const ExperimentFrame& frame : design_experiment(scene, {}, small_design())) {
        const double indices = indices_of(frame.plan);
        const std::size_t calls = frame.plan.opaque.size();
        if (calls == 0) continue;
        (frame.submission == Submission::Plain ? plain : multi) += 1;
        with_queries += !frame.queried_boxes.empty();
        few_indices += indices < 5e3;
        many_indices += indices > 1e5;
        one_call += calls <= 2;
        many_calls += calls > 250;
        one_batch += frame.plan.opaque.front().batch == frame.plan.opaque.back().batch;
        many_batches +=
            index_of(frame.plan.opaque.back().batch) >= index_of(frame.plan.opaque.front().batch) + 4;
        many_calls_of_few_indices += calls > 250 && indices < 3e4;
        few_calls_of_many_indices += calls < 30 && indices > 1e5;
    }
    for (const int count : {plain, multi, with_queries, few_indices, many_indices, one_call, many_calls,
                            one_batch, many_batches, many_calls_of_few_indices, few_calls_of_many_indices})
        EXPECT_GE(count, 1);
}

TEST(ExperimentDesign, a_scene_of_objects_alone_is_drawn_by_its_objects) {
    SceneBuilder builder;
    const MeshId mesh = builder.add_mesh(builder.add_material({}), triangle_piece()).value();
    for (int i = 0; i < 5; ++i) builder.add_dynamic(mesh, glm::dmat4(1.0));
    const Scene scene = builder.finish("objects").value();
    for (const ExperimentFrame& frame : design_experiment(scene, {}, small_design())) {
        EXPECT_TRUE(frame.plan.opaque.empty());
        EXPECT_FALSE(frame.plan.objects.empty());
        EXPECT_LE(frame.plan.objects.size(), 5u);
    }
}

TEST_F(GlTest, a_frames_work_is_counted_by_the_device) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    builder.add_static(material, triangle_piece());
    builder.add_static(material, triangle_piece(), glm::dmat4(1.0));
    const Scene scene = builder.finish("two").value();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    FramePlan plan;
    plan.opaque = {{BatchId{0}, 0, 6}};
    WorkCounter counter;
    if (!counter.is_available()) GTEST_SKIP() << "the driver has no pipeline statistics";
    for (const double away : {-1.0, 1.0}) {
        counter.begin();
        const std::vector<float> depths = depths_of(plan, buffers, view_at({0, 0, 0}, {0, 0, away}));
        counter.end();
        Work work = work_of(counters_);
        counter.read(work);
        EXPECT_EQ(work.indices, 6.0);
        EXPECT_EQ(work.draw_calls, 1.0);
        EXPECT_EQ(work.material_changes, 1.0);
        // Both triangles lie in one place: the second one passes too (less or equal).
        EXPECT_EQ(work.primitives, away < 0.0 ? 2.0 : 0.0);
        EXPECT_EQ(work.passed_samples, 2.0 * static_cast<double>(covered_pixels(depths)));
        EXPECT_GE(work.fragments, work.passed_samples);
    }
}

TEST_F(GlTest, an_experiment_times_every_frame_and_puts_the_state_back) {
    const Scene scene = small_scene();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    const std::vector<ExperimentFrame> frames = design_experiment(scene, {}, small_design());
    glEnable(GL_CULL_FACE);
    glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_FALSE);
    ExperimentOptions options;
    options.rounds = 2;
    int last_done = -1;
    options.progress = [&](int done, int total) {
        EXPECT_EQ(done, last_done + 1);
        EXPECT_LT(done, total);
        last_done = done;
    };
    const Result<std::vector<FrameTiming>> timings =
        run_experiment(frames, buffers, *executor_, *target_, options);
    ASSERT_TRUE(timings.ok()) << timings.error().message;
    ASSERT_EQ(timings->size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const FrameTiming& timing = (*timings)[i];
        EXPECT_EQ(timing.work.indices, indices_of(frames[i].plan));
        EXPECT_EQ(timing.work.sub_draws, static_cast<double>(frames[i].plan.opaque.size()));
        EXPECT_EQ(timing.work.queries, static_cast<double>(frames[i].queried_boxes.size()));
        EXPECT_GT(timing.submit_ns, 0.0);
        EXPECT_GE(timing.frame_ns, timing.submit_ns);
        EXPECT_GE(timing.rounds, 1);
        EXPECT_LE(timing.rounds, 2);
        EXPECT_FALSE(timing.gpu_ns.has_value());
    }
    GLboolean colour_mask[4] = {}, depth_mask = GL_TRUE;
    glGetBooleanv(GL_COLOR_WRITEMASK, colour_mask);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask);
    EXPECT_EQ(colour_mask[1], GL_FALSE);
    EXPECT_EQ(depth_mask, GL_FALSE);
    EXPECT_TRUE(glIsEnabled(GL_CULL_FACE));
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
}

TEST_F(GlTest, a_calibration_gives_a_profile_that_can_be_saved) {
    const Scene scene = small_scene();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    const CalibrationSubject subject{&scene, &buffers, {}, 60.0, 0.1, 1000.0};
    CalibrationOptions options;
    options.frames = 80;
    options.rounds = 2;
    options.longest_s = 3.0;
    const Result<Calibration> calibration =
        calibrate(std::span(&subject, 1), context_->device(), *executor_, *target_, options);
    ASSERT_TRUE(calibration.ok()) << calibration.error().message;
    EXPECT_EQ(calibration->timings.size(), 80u);
    EXPECT_EQ(calibration->profile.samples, 80u);
    EXPECT_EQ(calibration->profile.renderer, context_->device().renderer);
    EXPECT_EQ(calibration->profile.timer_name, "wall");
    EXPECT_FALSE(calibration->profile.timer_why.empty());
    EXPECT_GT(calibration->profile.c1_ns + calibration->profile.primitive_ns.value_or(0.0), 0.0);
    EXPECT_TRUE(calibration->profile.standard_errors_ns[index_of(Term::Indices)].has_value());
    EXPECT_GE(calibration->selection.candidates.size(), 8u);
    EXPECT_TRUE(validate(calibration->profile).ok());
    const Result<TimingProfile> read = parse_profile(profile_text(calibration->profile), "text");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->constants(), calibration->profile.constants());
}

TEST_F(GlTest, a_scene_too_small_to_tell_prices_apart_is_told_as_such) {
    SceneBuilder builder;
    builder.add_static(builder.add_material({}), triangle_piece());
    const Scene scene = builder.finish("one triangle").value();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    const CalibrationSubject subject{&scene, &buffers, {}, 60.0, 0.1, 1000.0};
    CalibrationOptions options;
    options.frames = 6;
    options.rounds = 1;
    const Result<Calibration> calibration =
        calibrate(std::span(&subject, 1), context_->device(), *executor_, *target_, options);
    ASSERT_FALSE(calibration.ok());
    EXPECT_TRUE(calibration.error().message.starts_with("the timing model could not be fitted: "))
        << calibration.error().message;
}

}  // namespace
}  // namespace rhview::gl
