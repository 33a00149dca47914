// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Which items share a query, and what that is reckoned to cost.

#include "multiqueries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "uniform.h"

namespace rhview {
namespace {

struct Group {
    std::vector<std::uint32_t> members;
    double p_all = 0;
};

std::vector<float> levels() {
    std::vector<float> p;
    for (std::uint32_t rank = 0; rank < OptionPricer::kRanks; ++rank) {
        p.push_back(static_cast<float>(0.999 - 0.7 * std::pow(rank / 16.0, 2)));
    }
    return p;
}

std::vector<CandidateOption> random_options(Uniform& random, std::uint32_t count) {
    std::vector<CandidateOption> options(count);
    for (CandidateOption& option : options) {
        option.render_ns = static_cast<float>(random.log(1e2, 1e5));
        option.rank = static_cast<std::uint8_t>(random(0, OptionPricer::kRanks));
    }
    return options;
}

std::vector<Group> groups_of(const std::vector<CandidateOption>& options, const std::vector<float>& p_by_rank,
                             const Multiqueries::Price& price) {
    Multiqueries queries;
    for (std::uint32_t i = 0; i < options.size(); ++i) queries.add(i, options[i].rank);
    std::vector<Group> groups;
    queries.for_each_group(options, p_by_rank, price,
                           [&](std::span<const std::uint32_t> members, double p_all) {
                               groups.push_back({{members.begin(), members.end()}, p_all});
                           });
    return groups;
}

/// docs/occlusion.md 4, as it is written there.
double overhead(const std::vector<std::uint32_t>& members, const std::vector<CandidateOption>& options,
                const std::vector<float>& p_by_rank, double query_ns) {
    if (members.size() == 1) return query_ns;
    double p_all = 1, render_ns = 0, seen_ns = 0;
    for (const std::uint32_t member : members) {
        const double p = p_by_rank[options[member].rank];
        p_all *= p;
        render_ns += options[member].render_ns;
        seen_ns += (1 - p) * options[member].render_ns;
    }
    return query_ns + (1 - p_all) * (static_cast<double>(members.size()) * query_ns + render_ns) - seen_ns;
}

TEST(Multiqueries, hold_everyone_once_in_descending_p) {
    Uniform random(1);
    const std::vector<float> p = levels();
    for (int trial = 0; trial < 200; ++trial) {
        const std::vector<CandidateOption> options =
            random_options(random, static_cast<std::uint32_t>(random(0, 300)));
        const std::vector<Group> groups = groups_of(options, p, {random.log(10, 1e5), 64, trial % 2 == 0});
        std::vector<std::uint32_t> all;
        for (const Group& group : groups) {
            EXPECT_LE(group.members.size(), 64u);
            double p_all = 1;
            for (const std::uint32_t member : group.members) p_all *= p[options[member].rank];
            EXPECT_NEAR(group.p_all, p_all, 1e-6);
            all.insert(all.end(), group.members.begin(), group.members.end());
        }
        ASSERT_EQ(all.size(), options.size());
        for (std::size_t i = 1; i < all.size(); ++i) {
            const std::uint8_t before = options[all[i - 1]].rank, after = options[all[i]].rank;
            EXPECT_TRUE(before < after || (before == after && all[i - 1] < all[i]));
        }
    }
}

TEST(Multiqueries, end_where_the_overhead_per_member_stops_falling) {
    Uniform random(2);
    const std::vector<float> p = levels();
    for (int trial = 0; trial < 200; ++trial) {
        const std::vector<CandidateOption> options = random_options(random, 120);
        const double query_ns = random.log(10, 1e5);
        const std::vector<Group> groups = groups_of(options, p, {query_ns, 64, true});
        for (std::size_t g = 0; g < groups.size(); ++g) {
            std::vector<std::uint32_t> members;
            double last = 1e300;
            for (const std::uint32_t member : groups[g].members) {
                members.push_back(member);
                const double each =
                    overhead(members, options, p, query_ns) / static_cast<double>(members.size());
                EXPECT_LT(each, last * (1 + 1e-9));
                last = each;
            }
            if (g + 1 == groups.size() || members.size() == 64) continue;
            members.push_back(groups[g + 1].members.front());
            EXPECT_GE(overhead(members, options, p, query_ns) / static_cast<double>(members.size()),
                      last * (1 - 1e-9));
        }
    }
}

TEST(Multiqueries, cost_less_than_single_queries_and_than_groups_of_one_size) {
    Uniform random(3);
    const std::vector<float> p(OptionPricer::kRanks, 0.99f);
    std::vector<CandidateOption> options = random_options(random, 640);
    for (CandidateOption& option : options) option.render_ns = 3500;
    const auto total = [&](const std::vector<Group>& groups) {
        double sum = 0;
        for (const Group& group : groups) sum += overhead(group.members, options, p, 3500);
        return sum;
    };
    const double best = total(groups_of(options, p, {3500, 64, true}));
    for (const std::uint32_t size : {1u, 2u, 4u, 16u, 32u, 64u}) {
        std::vector<Group> groups;
        for (std::uint32_t i = 0; i < 640; ++i) {
            if (i % size == 0) groups.emplace_back();
            groups.back().members.push_back(i);
        }
        EXPECT_LT(best, total(groups)) << size;
    }
}

TEST(Multiqueries, a_members_share_is_the_least_over_all_sizes) {
    Uniform random(4);
    for (int trial = 0; trial < 2000; ++trial) {
        const double q = random.log(10, 1e6), r = random.log(10, 1e6), f = random.log(1e-3, 0.9);
        const double most = std::floor(random(1, 100));
        const auto of = [&](double n) { return q / n + f * (n * q + (n - 1) * r); };
        double least = std::min(q, of(most));
        for (double n = 1; n <= most; n += 0.01) least = std::min(least, of(n));
        const float share = query_share_ns(static_cast<float>(q), static_cast<float>(f),
                                           static_cast<float>(r), static_cast<float>(most));
        EXPECT_NEAR(share, least, 1e-3 * q) << q << ' ' << r << ' ' << f << ' ' << most;
    }
}

}  // namespace
}  // namespace rhview
