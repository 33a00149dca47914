// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The constants of occlusion culling: what each means, its default, and where that is from.
///
/// Sources: CHC++ is Mattausch, Bittner & Wimmer 2008 (n_av, multiqueries, tight bounds), with the values
/// that public implementations of it use where the paper gives a range. "Ours" are choices of this module,
/// each derived in docs/occlusion.md. Numbers that make no sense (NaN, negative, zero intervals) are taken
/// for the nearest that does.
#pragma once

#include <cstdint>

namespace rhview {

/// Whose word a thing is left out on.
enum class OcclusionMode : std::uint8_t {
    Exact,   ///< left out only what a query of this same frame covers
    Latent,  ///< what was hidden in earlier frames is left out; its error must be measured
};

/// Which things are asked about.
enum class OcclusionPolicy : std::uint8_t {
    Model,  ///< a query where p·render_ns exceeds its price
    Paper,  ///< all items are asked about, if drawing them is predicted to exceed `paper_budget_ns`; else
            ///< none. One hardware query each, always in exact mode
};

/// The defaults are meant to be kept: only `mode` is for every user to choose.
struct OcclusionSettings {
    OcclusionMode mode = OcclusionMode::Exact;
    OcclusionPolicy policy = OcclusionPolicy::Model;
    /// 16 ms, one frame at 60 Hz: Serpa & Rodrigues 2018.
    double paper_budget_ns = 16e6;

    /// p that an item answered hidden i times in a row is still hidden: `keep_certainty` − `keep_doubt`·e^−i.
    /// CHC++ fitted such a curve to measurements; 0.99 and 0.7 are an implementation's (another: 0.98, 0.68).
    double keep_certainty = 0.99;
    double keep_doubt = 0.7;
    /// As many answers as this curve weighs, at each i, against what answers tell. Ours.
    double keep_prior_answers = 50.0;
    /// p that an item of which nothing is known is hidden, until answers tell. Ours: no preference.
    double unknown_hidden = 0.5;
    /// Frames until an item that is seen turns hidden, on average, until answers tell. Ours: about the time
    /// that a walker at 60 Hz needs to pass a door.
    double turn_frames = 100.0;
    /// How many answers the learned p's remember. Ours: a few frames' worth, so that a change of scene shows.
    double memory_answers = 1000.0;
    /// How many frames × items the learned turn rate remembers. Ours: it bounds what testing costs where
    /// nothing is ever hidden (below 0.3 % of what the items take).
    double memory_item_frames = 100000.0;

    /// Frames for which an item that was seen is not asked about again, at least; the phase of the first such
    /// wait is random. CHC++'s n_av: 5 to 10.
    std::uint32_t visible_interval = 8;
    /// Part of the predicted frame that may go to queries which the gate alone would not ask. Ours.
    double exploration_share = 0.02;
    /// Part of `exploration_share` that is left where exploration finds nothing hidden. Ours.
    double exploration_floor = 0.1;
    /// Frames untested after which exploration takes an item. Ours: four times `visible_interval`.
    std::uint32_t explore_after = 32;

    /// Cold start: of what is not known yet, the nearest that hide more than they cost are drawn at once
    /// until what is drawn at once covers the screen this often. Ours: boxes cover about twice what their
    /// triangles do.
    double cold_coverage = 2.0;

    /// For planners: boxes of descendants replace an item's box down to this depth, while their areas add up
    /// to less than this multiple of its own. CHC++: d_max 3, s_max 1.4. Ours is 0.7: each box has its price,
    /// and at 1.4 they cost more than they find (docs/occlusion.md, section 10).
    double tight_area = 0.7;
    std::uint32_t tight_depth = 3;
    /// Members of a multiquery at most. CHC++ collects 20 to 80.
    std::uint32_t max_multiquery = 64;

    /// Frames for which an item that was seen is not tried as one again (`may_try`): doubled each time in a
    /// row, up to the greatest. Ours.
    std::uint32_t merge_interval = 8;
    std::uint32_t max_merge_interval = 512;

    /// A query without an answer after so many frames counts as visible. Ours: drivers buffer two or three.
    std::uint32_t lost_after_frames = 16;
    /// Latent mode: an item is left out on the word of an answer to a question at most so many frames old.
    /// Ours: with `visible_interval`, as long as CHC++ trusts the opposite answer.
    std::uint32_t latent_max_age = 8;
    /// Latent mode: an answer that counts fewer samples than this is taken for hidden; the counted ones are
    /// those of its boxes. Above 1, planners ask for counts, by a hardware query for each item. CHC++'s
    /// visibility threshold is one less.
    std::uint32_t visible_samples = 1;
    std::uint64_t seed = 1;  ///< of the random phases
};

}  // namespace rhview
