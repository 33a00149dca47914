// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "rhview/base/result.h"
#include "rhview/timing_model/profile.h"

namespace rhview::cli {

/// The timing constants that the user names: those of a profile file, those of `--set` in their place.
struct UserConstants {
    TimingProfile profile;
    std::string source;  ///< "file" or "set"
};

/// Nothing when the user names none. `set` is `c1=0.25,c3=2000` (ns); without a file it must hold c1 and c3.
Result<std::optional<UserConstants>> read_constants(const std::optional<std::filesystem::path>& file,
                                                    const std::string& set);

}  // namespace rhview::cli
