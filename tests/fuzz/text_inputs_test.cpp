// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The fuzzer's targets with any compiler: their seeds as they are, and mutated.

#include <gtest/gtest.h>

#include <random>

#include "text_inputs.h"

namespace rhview {
namespace {

TEST(TextInputs, seeds_are_accepted_all_but_the_last_of_each) {
    for (const TextTarget& target : text_targets())
        for (std::size_t i = 0; i < target.seeds.size(); ++i)
            EXPECT_EQ(target.use(target.seeds[i]), i + 1 < target.seeds.size()) << target.name << ' ' << i;
}

TEST(TextInputs, mutated_seeds_end_in_a_sentence_or_in_something_sound) {
    std::mt19937 random(5);
    const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random()) % count; };
    for (const TextTarget& target : text_targets()) {
        int refused = 0;
        constexpr int kRounds = 400;
        for (int round = 0; round < kRounds; ++round) {
            std::string text = target.seeds[below(target.seeds.size())];
            for (std::size_t change = 0; change <= below(3); ++change) {
                const std::size_t place = below(text.size());
                switch (below(4)) {
                    case 0:
                        text[place] = static_cast<char>(random());
                        break;
                    case 1:
                        text.insert(place, text.substr(below(text.size()), below(20)));
                        break;
                    case 2:
                        text.erase(place, 1 + below(8));
                        break;
                    default:
                        text.insert(place, 1, "0123456789-.e[]{}\",:\n "[below(22)]);
                }
                if (text.empty()) text = " ";
            }
            refused += target.use(text) ? 0 : 1;
        }
        EXPECT_GT(refused, kRounds / 10) << target.name;
    }
}

}  // namespace
}  // namespace rhview
