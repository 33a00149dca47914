// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/gl/context.h"
#include "rhview/rhoctree/draw_costs.h"
#include "rhview/scenes/named_scene.h"
#include "rhview/timing_model/profile.h"

namespace rhview::cli {

/// What the user asked for: a profile file, constants to put in place of its own.
struct WantedConstants {
    std::optional<TimingProfile> profile;
    std::filesystem::path file;
    std::vector<std::pair<std::string, double>> set;  ///< c0, c1, c3, query or box, and its value in ns

    /// c1 and c3 are named: no machine needs to be measured.
    [[nodiscard]] bool are_complete() const;
};

/// `set` is `c1=0.25,c3=2000` (ns).
Result<WantedConstants> parse_constants(const std::optional<std::filesystem::path>& file,
                                        const std::string& set);

/// The constants a walk predicts and decides with.
struct UserConstants {
    TimingProfile profile;
    std::string source;  ///< "file", "quick" or "set"
    std::string told;    ///< where they come from, for people: one clause
};

/// In this order: what the user named; the saved profile of this scene or machine; a quick calibration with
/// the scene itself (2 s at most for the timing of frames), drawn at `width` × `height`. Absent only where
/// that calibration could not tell the prices apart: `why_not` says why. Errors: the driver's.
/// `warning` is set when the user's file is of another device.
struct ChosenConstants {
    std::optional<UserConstants> constants;
    std::string why_not;
    std::string warning;
};
Result<ChosenConstants> choose_constants(const WantedConstants& wanted, const std::string& scene_spec,
                                         const SceneAndPath& loaded, const gl::DeviceInfo& device, int width,
                                         int height);

/// Of timing, where what asking costs is measured in passing.
inline constexpr double kQuickAnswersS = 0.4;

/// What asking about hidden things costs by these constants; absent where they do not say. With `--set`,
/// `query` is a hardware query and `box` a box of the box pass, either with a draw for each conditional one;
/// what is not set is never used.
std::optional<QueryCosts> query_costs(const WantedConstants& wanted, const UserConstants& constants);

/// What a range costs: a call of its own, or a part of its batch's multi-draw.
DrawCosts draw_costs(const TimingProfile& profile, bool multi_draw);

}  // namespace rhview::cli
