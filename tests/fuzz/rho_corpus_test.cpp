// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The fuzzer's target with any compiler: its corpus as it is, and mutated by a seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rho_corpus.h"
#include "rho_input.h"

namespace rhview {
namespace {

std::vector<RhoBytes> corpus() {
    // A folder of the running test's own: two of them may run at once.
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / (std::string("rhview_rho_corpus_") + info->name());
    std::vector<RhoBytes> files;
    for (const std::filesystem::path& file : write_corpus(folder)) {
        const auto bytes = FileBytes::open(file).value();
        files.push_back({{bytes->bytes().begin(), bytes->bytes().end()}});
    }
    std::filesystem::remove_all(folder);
    return files;
}

TEST(RhoCorpus, each_file_is_accepted_in_what_it_holds) {
    const std::vector<RhoBytes> files = corpus();
    ASSERT_EQ(files.size(), 8u);
    for (std::size_t i = 0; i < files.size(); ++i)
        EXPECT_EQ(use_baked_file(files[i].bytes), i == 6 ? 2 : 1) << i;
}

TEST(RhoCorpus, mutated_files_are_refused_or_used_within_bounds) {
    const std::vector<RhoBytes> files = corpus();
    std::mt19937 random(3);
    const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random()) % count; };
    int used = 0;
    constexpr int kRounds = 1500;
    for (int round = 0; round < kRounds; ++round) {
        RhoBytes file = files[below(files.size())];
        for (std::size_t change = 0; change <= below(4); ++change) {
            const std::size_t place = below(file.bytes.size() - 8);
            switch (below(5)) {
                case 0:
                    file.bytes[place] ^= static_cast<std::byte>(1 << below(8));
                    break;
                case 1:
                    file.set(place / 4 * 4, static_cast<std::uint32_t>(below(64)));
                    break;
                case 2:
                    file.set(place / 4 * 4, ~static_cast<std::uint32_t>(below(64)));
                    break;
                case 3:
                    file.set(place / 4 * 4, file.get<std::uint32_t>(below(file.bytes.size() - 4)));
                    break;
                default:
                    // A cut, or a piece of itself at the end.
                    if (below(2) == 0) {
                        file.bytes.resize(std::max<std::size_t>(place, 64));
                    } else {
                        const std::vector<std::byte> piece(
                            file.bytes.begin() + static_cast<std::ptrdiff_t>(place), file.bytes.end());
                        file.bytes.insert(file.bytes.end(), piece.begin(), piece.end());
                    }
            }
        }
        used += use_raw_and_repaired(file.bytes) > 0 ? 1 : 0;
    }
    EXPECT_GT(used, kRounds / 20);
}

}  // namespace
}  // namespace rhview
