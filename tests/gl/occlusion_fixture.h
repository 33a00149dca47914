// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <vector>

#include "gl_fixture.h"
#include "query_scene.h"

namespace rhview::gl {

struct Ways {
    bool hardware, box_pass;
};
inline constexpr Ways kEveryWay[] = {{true, false}, {false, true}, {true, true}};

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

}  // namespace rhview::gl
