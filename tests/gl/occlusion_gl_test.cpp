// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Conditional draws on real pixels: what hangs on queries leaves the depths of drawing everything, bit for
// bit, and the answers say what was drawn.

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>

#include "gl_fixture.h"
#include "query_scene.h"

namespace rhview::gl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Ways {
    bool hardware, box_pass;
};
constexpr Ways kEveryWay[] = {{true, false}, {false, true}, {true, true}};

class OcclusionTest : public GlTest {
  protected:
    /// Answers of all that was asked, by ticket; the device is idle, so none may be missing.
    std::map<std::uint64_t, QueryAnswer> answers() {
        finish();
        std::vector<QueryAnswer> list;
        executor_->poll_answers(list);
        std::map<std::uint64_t, QueryAnswer> result;
        for (const QueryAnswer& answer : list) {
            EXPECT_FALSE(result.contains(answer.ticket)) << "answered twice";
            result[answer.ticket] = answer;
        }
        EXPECT_EQ(executor_->answer_counters().blocking_reads, 0u);
        return result;
    }

    /// Draws everything and then `plan`; returns the pixels that differ.
    std::size_t missing(const FramePlan& plan, const std::vector<Cell>& cells, const SceneBuffers& buffers,
                        const View& view, const DrawOptions& options = {}) {
        const std::vector<float> whole = depths_of(everything(cells), buffers, view);
        return count_missing_pixels(depths_of(plan, buffers, view, options), whole);
    }
};

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

}  // namespace
}  // namespace rhview::gl
