// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Batches equal the scalar loop bit for bit, with every instruction set that this machine has.

#include "rhview/frustum/box_batch.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <limits>

#ifdef __unix__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include "random_boxes.h"

namespace rhview {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// The instruction sets that this machine has and the library was compiled for, and the choice among them.
std::vector<std::int64_t> instruction_sets() {
    std::vector<std::int64_t> sets;
    const std::int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
    for (std::int64_t rest = supported; rest != 0; rest &= rest - 1) sets.push_back(rest & -rest);
    return sets;
}

class BoxBatch : public testing::TestWithParam<std::int64_t> {
  protected:
    void SetUp() override { choose(GetParam()); }
    void TearDown() override { choose(0); }  // 0: what the machine has

  private:
    static void choose(std::int64_t set) {
        hwy::SetSupportedTargetsForTest(set);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

std::vector<std::uint64_t> words_for(std::size_t count, std::size_t views = 1) {
    return std::vector<std::uint64_t>(views * visibility_words(count), 0x5555555555555555ull);
}

std::vector<std::uint64_t> scalar_answer(const Frustum& frustum, const BoxSpans& boxes) {
    std::vector<std::uint64_t> words = words_for(boxes.count);
    cull_boxes_scalar(frustum, boxes, words);
    return words;
}

std::vector<Frustum> random_frusta(std::uint32_t seed, int count, double offset) {
    Uniform uniform(seed);
    std::vector<Frustum> frusta;
    for (int i = 0; i < count; ++i)
        frusta.push_back(make_frustum(
            random_view(uniform, glm::dvec3(offset) + uniform.point(20.0), static_cast<ClipDepth>(i % 3))));
    return frusta;
}

TEST_P(BoxBatch, equals_the_scalar_loop_for_any_count_and_alignment) {
    Uniform uniform(1);
    const std::vector<Aabb> all = random_boxes(uniform, 330, glm::dvec3(1e3), 60.0, 0.01, 30.0);
    const std::vector<Frustum> frusta = random_frusta(2, 12, 1e3);
    for (std::size_t count = 0; count <= 300; ++count) {
        const Frustum& frustum = frusta[count % frusta.size()];
        const std::size_t shift = count % 17;  // floats off any alignment
        const std::span<const Aabb> boxes = std::span(all).subspan(shift, count);
        const BoxArrays arrays{std::span<const Aabb>(all)};
        const BoxSpans spans = arrays.spans().subspan(shift, count);
        std::vector<std::uint64_t> words = words_for(count);
        cull_boxes(frustum, spans, words);
        ASSERT_EQ(words, scalar_answer(frustum, spans)) << count << " boxes";
        words = words_for(count);
        cull_boxes(frustum, boxes, words);
        ASSERT_EQ(words, scalar_answer(frustum, spans)) << count << " boxes one after another";
    }
}

TEST_P(BoxBatch, several_views_in_one_pass_equal_one_after_another) {
    Uniform uniform(3);
    const BoxArrays arrays(random_boxes(uniform, 1000, glm::dvec3(0.0), 60.0, 0.01, 30.0));
    const std::vector<Frustum> frusta = random_frusta(4, 37, 0.0);
    std::vector<std::uint64_t> words = words_for(1000, frusta.size());
    cull_boxes(frusta, arrays.spans(), words);
    std::vector<std::uint64_t> expected;
    for (const Frustum& frustum : frusta) {
        const std::vector<std::uint64_t> one = scalar_answer(frustum, arrays.spans());
        expected.insert(expected.end(), one.begin(), one.end());
    }
    EXPECT_EQ(words, expected);
}

TEST_P(BoxBatch, equals_the_scalar_loop_on_half_a_million_boxes_far_and_near) {
    std::size_t visible = 0, tested = 0;
    for (const double offset : {0.0, 1e3, 1e5, 1e7}) {
        Uniform uniform(static_cast<std::uint32_t>(offset) + 5);
        for (const Frustum& frustum : random_frusta(6, 20, offset)) {
            const BoxArrays arrays(
                random_boxes(uniform, 6000, glm::dvec3(offset), uniform.log(1.0, 1e4), 1e-6, 1e4));
            std::vector<std::uint64_t> words = words_for(arrays.size());
            cull_boxes(frustum, arrays.spans(), words);
            ASSERT_EQ(words, scalar_answer(frustum, arrays.spans()));
            for (const std::uint64_t word : words) visible += static_cast<std::size_t>(std::popcount(word));
            tested += arrays.size();
        }
    }
    EXPECT_GT(visible, tested / 20);
    EXPECT_LT(visible, tested * 19 / 20);
}

TEST_P(BoxBatch, boxes_without_a_number_or_an_end_are_visible_and_inverted_ones_as_in_the_scalar_loop) {
    std::vector<Aabb> boxes(3, Aabb{});
    for (int corner = 0; corner < 6; ++corner) {
        for (const float odd : {kNan, kInf, -kInf}) {
            Aabb box{glm::vec3(500, 500, 500), glm::vec3(501, 501, 501)};
            (corner < 3 ? box.min : box.max)[corner % 3] = odd;
            boxes.push_back(box);
        }
    }
    const std::size_t endless = boxes.size();
    Uniform uniform(7);
    for (int i = 0; i < 500; ++i) {
        boxes.push_back({glm::vec3(uniform.point(100.0)), glm::vec3(uniform.point(100.0))});
        boxes.push_back({glm::vec3(uniform.point(3e38)), glm::vec3(uniform.point(3e38))});
    }
    const BoxArrays arrays{std::span<const Aabb>(boxes)};
    for (const Frustum& frustum : random_frusta(8, 50, 0.0)) {
        std::vector<std::uint64_t> words = words_for(boxes.size());
        cull_boxes(frustum, arrays.spans(), words);
        EXPECT_EQ(words, scalar_answer(frustum, arrays.spans()));
        for (std::size_t i = 0; i < endless; ++i) EXPECT_TRUE(words[i / 64] >> (i % 64) & 1u) << i;
    }
}

#ifdef __unix__
TEST_P(BoxBatch, nothing_behind_the_last_box_is_read) {
    // Arrays that end where a page that may not be read begins.
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const auto guarded = [&] {
        void* memory = mmap(nullptr, 8 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        EXPECT_NE(memory, MAP_FAILED);
        EXPECT_EQ(mprotect(static_cast<char*>(memory) + 7 * page, page, PROT_NONE), 0);
        return static_cast<char*>(memory);
    };
    std::array<char*, 7> areas;
    for (char*& area : areas) area = guarded();
    const Frustum frustum = random_frusta(9, 1, 0.0)[0];
    for (std::size_t count = 1; count <= 200; ++count) {
        std::array<const float*, 6> arrays;
        for (int i = 0; i < 6; ++i)
            arrays[i] = reinterpret_cast<float*>(areas[i] + 7 * page - count * sizeof(float));
        const BoxSpans spans{arrays[0], arrays[1], arrays[2], arrays[3], arrays[4], arrays[5], count};
        std::vector<std::uint64_t> words = words_for(count);
        cull_boxes(frustum, spans, words);
        EXPECT_EQ(words, scalar_answer(frustum, spans));
        const std::span<const Aabb> boxes(
            reinterpret_cast<const Aabb*>(areas[6] + 7 * page - count * sizeof(Aabb)), count);
        cull_boxes(frustum, boxes, words);
        EXPECT_EQ(words, scalar_answer(frustum, spans));
    }
    for (char* area : areas) munmap(area, 8 * page);
}
#endif

INSTANTIATE_TEST_SUITE_P(InstructionSets, BoxBatch, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(hwy::TargetName(set.param)); });

TEST(BoxArrays, hold_what_was_assigned_and_new_boxes_are_empty) {
    const std::vector<Aabb> boxes{{glm::vec3(1, 2, 3), glm::vec3(4, 5, 6)}, {glm::vec3(-1), glm::vec3(1)}};
    BoxArrays arrays{std::span<const Aabb>(boxes)};
    arrays.resize(3);
    EXPECT_EQ(arrays.spans()[0], boxes[0]);
    EXPECT_EQ(arrays.spans()[1], boxes[1]);
    EXPECT_EQ(arrays.spans()[2], Aabb());
    arrays.set(2, boxes[0]);
    EXPECT_EQ(arrays.spans().subspan(2, 1)[0], boxes[0]);
}

}  // namespace
}  // namespace rhview
