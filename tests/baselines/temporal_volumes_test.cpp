// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/temporal_volumes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "uniform.h"

namespace rhview {
namespace {

const glm::ivec3 kCells(9, 7, 8);

CellBox random_box(Uniform& uniform) {
    CellBox box;
    for (int a = 0; a < 3; ++a) {
        const int x = static_cast<int>(uniform(0, kCells[a])), y = static_cast<int>(uniform(0, kCells[a]));
        box.min[a] = std::min(x, y), box.max[a] = std::max(x, y);
    }
    return box;
}

bool on_hull(const CellBox& box, const glm::ivec3& cell) {
    const CellBox inside{box.min + 1, box.max - 1};
    return box.contains(cell) && (inside.is_empty() || !inside.contains(cell));
}

std::set<ObjectId> as_set(const std::vector<ObjectId>& objects) {
    return {objects.begin(), objects.end()};
}

TEST(TemporalVolumes, are_found_in_the_cells_of_their_hull_and_in_no_other_while_they_come_and_go) {
    Uniform uniform(3);
    TemporalVolumes volumes(kCells, 12);
    std::map<ObjectId, CellBox> living;
    for (int step = 0; step < 60; ++step) {
        const ObjectId object{static_cast<std::uint32_t>(uniform(0, 12))};
        if (volumes.has(object)) {
            volumes.remove(object);
            living.erase(object);
        } else {
            living[object] = random_box(uniform);
            volumes.insert(object, living[object], 256);
        }
        ASSERT_EQ(volumes.size(), living.size());
        for_each_cell({glm::ivec3(0), kCells - 1}, [&](const glm::ivec3& cell) {
            std::set<ObjectId> hulls, boxes;
            for (const auto& [id, box] : living) {
                if (on_hull(box, cell)) hulls.insert(id);
                if (box.contains(cell)) boxes.insert(id);
            }
            std::vector<ObjectId> at, around;
            volumes.find_at(cell, at);
            volumes.find_around(cell, around);
            EXPECT_EQ(as_set(at), hulls) << step;
            EXPECT_EQ(as_set(around), boxes) << step;
        });
    }
}

TEST(TemporalVolumes, end_in_the_frame_that_was_said_unless_they_are_removed_before) {
    TemporalVolumes volumes(kCells, 3);
    const CellBox box{glm::ivec3(1), glm::ivec3(2)};
    volumes.insert(ObjectId{0}, box, 3);
    volumes.insert(ObjectId{1}, box, 3);
    volumes.insert(ObjectId{2}, box, TemporalVolumes::kLongestPeriod);
    volumes.remove(ObjectId{1});
    for (std::uint32_t frame = 1; frame <= TemporalVolumes::kLongestPeriod; ++frame) {
        std::vector<ObjectId> expired;
        volumes.next_frame(expired);
        std::vector<ObjectId> expected;
        if (frame == 3) expected = {ObjectId{0}};
        if (frame == TemporalVolumes::kLongestPeriod) expected = {ObjectId{2}};
        EXPECT_EQ(expired, expected) << frame;
        for (const ObjectId object : expired) volumes.remove(object);
    }
    EXPECT_EQ(volumes.size(), 0u);
}

}  // namespace
}  // namespace rhview
