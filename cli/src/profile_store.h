// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "rhview/base/result.h"
#include "rhview/gl/context.h"
#include "rhview/timing_model/profile.h"

namespace rhview::cli {

/// Where `calibrate` saves and `walk` looks: `$XDG_CACHE_HOME/rhview`, else `~/.cache/rhview`; a file for the
/// machine, and one for each scene that was calibrated with. Absent where neither variable is set.
std::optional<std::filesystem::path> saved_profile_path(const std::string& scene_spec);

/// Whether the profile was measured on this device with this driver.
bool is_of_device(const TimingProfile& profile, const gl::DeviceInfo& device);

struct SavedProfile {
    TimingProfile profile;
    std::filesystem::path file;
};

/// The saved profile of this scene, else of the machine. Files that are damaged or of another device are not
/// used; `why_not` says so, in a sentence.
std::optional<SavedProfile> find_saved_profile(const std::string& scene_spec, const gl::DeviceInfo& device,
                                               std::string& why_not);

}  // namespace rhview::cli
