// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The constants of occlusion culling: what each means, its default, and where that is from.
#pragma once

#include <cstdint>

namespace rhview {

enum class OcclusionMode : std::uint8_t {
    Exact,   ///< left out only what a query of this same frame covers
    Latent,  ///< what was hidden in earlier frames is left out; its error must be measured
};

enum class OcclusionPolicy : std::uint8_t {
    Model,  ///< a query where p·render_ns exceeds its price
    Paper,  ///< all items are asked about, if drawing them is predicted to exceed `paper_budget_ns`; else none
};

struct OcclusionSettings {
    OcclusionMode mode = OcclusionMode::Exact;
    OcclusionPolicy policy = OcclusionPolicy::Model;
    double paper_budget_ns = 16e6;
    std::uint32_t visible_interval = 8;
    double exploration_share = 0.02;
    double tight_area = 1.4;
    std::uint32_t tight_depth = 3;
    std::uint32_t max_multiquery = 64;
    std::uint32_t lost_after_frames = 16;
    std::uint32_t latent_max_age = 8;
    std::uint64_t seed = 1;
};

}  // namespace rhview
