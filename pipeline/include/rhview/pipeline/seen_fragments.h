// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// How many samples were seen of each object, by the answers of queries that count them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rhview/pipeline/frame_plan.h"

namespace rhview {

/// One per view. Deterministic; no allocation once the most queries were on their way.
class SeenFragments {
  public:
    /// Answers to the queries of `FramePlan::counted_objects` are waited for from now on; those that did not
    /// come within `kLostAfter` plans are no longer.
    void expect(const FramePlan& plan);
    /// In any order; others' answers, and those that come twice, are ignored.
    void absorb(std::span<const QueryAnswer> answers);
    /// Another object has the number, or it is somewhere else: answers on the way say nothing of it.
    void forget(ObjectId object);

    /// The samples that passed of its box: as many as it shows itself, or more. None: it was not asked about,
    /// its last answer has not come, or nothing of it was seen, which says nothing of the next time.
    [[nodiscard]] std::optional<std::uint64_t> of(ObjectId object) const;

  private:
    static constexpr std::uint32_t kLostAfter = 64;
    struct OnTheWay {
        std::uint64_t ticket = 0;
        ObjectId object{};
        std::uint32_t plan = 0;
    };

    std::vector<OnTheWay> on_the_way_;    ///< by ticket
    std::vector<std::uint64_t> samples_;  ///< by `ObjectId`; 0: not known
    std::uint32_t plan_ = 0;
};

}  // namespace rhview
