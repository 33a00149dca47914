// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// What levels of detail do to the picture, measured: outlines and depths of rendered levels against full
// detail, over 64 views. docs/lod.md has the figures.

#include <algorithm>
#include <cmath>
#include <limits>

#include "gl_fixture.h"
#include "rhview/lod/projected_error.h"
#include "rhview/pipeline/object_levels.h"
#include "rhview/scenes/named_scene.h"
#include "uniform.h"

namespace rhview::gl {
namespace {

// A picture of 240×180, drawn in samples of a quarter of a pixel: what the grid of samples itself misses is
// far below the half pixel that is judged by.
constexpr int kWidth = 240, kHeight = 180, kFine = 4;
constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Distances from the camera's plane, row after row; `kNothing` where nothing is.
struct Depths {
    std::vector<double> at;
    [[nodiscard]] double of(int x, int y) const {
        return at[static_cast<std::size_t>(y) * kWidth * kFine + static_cast<std::size_t>(x)];
    }
};

/// How far a picture is from another, in pixels: the largest that a sample has to look about itself in the
/// other until something is there that is no farther away than it (`outline`: also that nothing is there),
/// within `slack`. What no neighbour explains within `reach` counts as `reach`.
struct Deviation {
    double nearer_px = 0.0;        ///< no surface comes nearer: what is seen in one is not there in the other
    double farther_px = 0.0;       ///< no surface goes farther: one is seen through in the other
    std::size_t seen_through = 0;  ///< samples of those that are beyond `allowed_px`
    std::size_t samples = 0;
};

void compare(const Depths& a, const Depths& b, double slack, double allowed_px, Deviation& deviation) {
    const int reach = static_cast<int>(std::ceil((allowed_px + 2.0) * kFine));
    const auto look = [&](int x, int y, const auto& found) {
        double best = reach;
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) {
                const double distance = std::sqrt(static_cast<double>(dx * dx + dy * dy));
                if (distance < best && found(b.of(x + dx, y + dy))) best = distance;
            }
        return best / kFine;
    };
    for (int y = reach; y < kHeight * kFine - reach; ++y)
        for (int x = reach; x < kWidth * kFine - reach; ++x) {
            const double here = a.of(x, y), there = b.of(x, y);
            if (here == kNothing && there == kNothing) continue;
            ++deviation.samples;
            if (there > here + slack)
                deviation.nearer_px = std::max(
                    deviation.nearer_px, look(x, y, [&](double other) { return other <= here + slack; }));
            if (there < here - slack) {
                const double px = look(x, y, [&](double other) { return other >= here - slack; });
                deviation.farther_px = std::max(deviation.farther_px, px);
                deviation.seen_through += px > allowed_px;
            }
        }
}

class LevelDeviation : public testing::Test {
  protected:
    static constexpr std::size_t kViews = 64;

    void SetUp() override {
        context_.emplace(Context::create_headless({.debug = true}).value());
        executor_.emplace(Executor::create().value());
        target_.emplace(RenderTarget::create(kWidth * kFine, kHeight * kFine).value());
    }
    void TearDown() override { EXPECT_EQ(take_error(), ""); }

    Depths draw(const FramePlan& plan, const SceneBuffers& buffers, const View& view) {
        target_->begin(view.clip_depth, glm::vec3(0.0f));
        executor_->draw(plan, buffers, view);
        std::vector<float> depths;
        target_->read_depth(depths);
        Depths result;
        const glm::dmat4& clip = view.clip_from_camera;
        for (const float depth : depths)
            result.at.push_back(depth == 0.0f ? kNothing
                                              : clip[3][2] / (static_cast<double>(depth) + clip[2][2]));
        return result;
    }

    std::optional<Context> context_;
    std::optional<Executor> executor_;
    std::optional<RenderTarget> target_;
};

TEST_F(LevelDeviation, outlines_and_depths_stay_within_the_error_that_is_stated_and_half_a_pixel) {
    const Scene scene = make_named_scene("farm:instances=1,mesh=20000")->scene;
    const SceneMesh& mesh = scene.meshes[0];
    const LodMesh lod_mesh{scene.pools[mesh.pool].positions, mesh.indices};
    const std::vector<LodChain> chains = build_lod_chains({&lod_mesh, 1}, {}).value();
    std::vector<LevelRange> ranges;
    for (const LodLevel& level : chains[0].levels.span().subspan(1))
        ranges.push_back({level.first_index, level.index_count});
    const MeshLevels levels{chains[0].indices, ranges};
    const SceneBuffers buffers = SceneBuffers::upload(scene, {}, {&levels, 1}).value();
    const double scale = largest_stretch(glm::dmat3(scene.object_placement(ObjectId{0})));
    const LevelledObject levelled{0, static_cast<float>(scale)};
    const std::vector<Aabb> boxes = scene.object_boxes();
    const glm::dvec3 centre = scene.origin + glm::dvec3(boxes[0].centre());
    Uniform uniform(64);
    std::size_t coarse = 0;
    Deviation most;
    double nearest_to_bound = 0.0, largest_error_px = 0.0;
    for (std::size_t i = 0; i < kViews; ++i) {
        const double bound = std::array{0.5, 1.0, 2.0, 4.0}[i % 4];
        const glm::dvec3 direction = glm::normalize(uniform.point(1.0) + glm::dvec3(0, 0.05, 0));
        const double distance = uniform.log(7.0, 40.0);
        FrameInput input;
        input.culling_view = {look_along(centre - distance * direction, direction, {0.1, 1.0, 0.0}),
                              perspective(0.7, 4.0 / 3.0, 0.5, 200.0, ClipDepth::ReversedZeroToOne),
                              ClipDepth::ReversedZeroToOne};
        input.scene_origin = scene.origin;
        input.object_boxes = boxes;
        input.viewport_pixels = {kWidth, kHeight};
        FramePlan whole, reduced;
        whole.objects = reduced.objects = {ObjectId{0}};
        LevelOptions options;
        options.max_error_px = bound;
        const LevelSummary summary = ObjectLevels(chains, {&levelled, 1}).choose(input, options, reduced);
        ASSERT_LE(summary.max_error_px, bound);
        if (reduced.object_levels.empty()) continue;
        ++coarse;
        const double slack =
            scale * static_cast<double>(chains[0].levels[reduced.object_levels[0]].error) + 1e-4;
        const Depths full = draw(whole, buffers, input.culling_view);
        const Depths level = draw(reduced, buffers, input.culling_view);
        const double allowed = summary.max_error_px + 0.5;
        Deviation found;
        compare(level, full, slack, allowed, found);
        compare(full, level, slack, allowed, found);
        EXPECT_LE(found.nearer_px, allowed) << "view " << i << ", level " << int{reduced.object_levels[0]};
        EXPECT_GT(found.samples, 1000u);
        nearest_to_bound = std::max(nearest_to_bound, found.nearer_px - summary.max_error_px);
        largest_error_px = std::max(largest_error_px, summary.max_error_px);
        most.nearer_px = std::max(most.nearer_px, found.nearer_px);
        most.farther_px = std::max(most.farther_px, found.farther_px - summary.max_error_px);
        most.seen_through += found.seen_through;
        most.samples += found.samples;
    }
    RecordProperty("views", static_cast<int>(coarse));
    RecordProperty("largest_error_px", std::to_string(largest_error_px));
    RecordProperty("most_deviation_px", std::to_string(most.nearer_px));
    RecordProperty("beyond_error_px", std::to_string(nearest_to_bound));
    RecordProperty("seen_through_beyond_error_px", std::to_string(most.farther_px));
    RecordProperty("seen_through_samples", std::to_string(most.seen_through));
    RecordProperty("samples", std::to_string(most.samples));
    EXPECT_GE(coarse, 48u);
    EXPECT_GT(most.nearer_px, 0.25) << "levels that change nothing prove nothing";
    // A level may have a hole, or lose a thin part before a deeper one, as wide as its error: no distance
    // between surfaces forbids it.
    EXPECT_LE(static_cast<double>(most.seen_through), 1e-3 * static_cast<double>(most.samples));
}

}  // namespace
}  // namespace rhview::gl
