// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

#include "constants.h"
#include "picture_size.h"
#include "rhview/pipeline/node_visibility.h"
#include "verbs.h"

namespace rhview::cli {

/// How `rhview` asks what is hidden; absent, with the reason where it was wanted, if it does not.
Result<std::optional<OcclusionOptions>> choose_occlusion(const WalkOptions& options,
                                                         const WantedConstants& wanted,
                                                         const std::optional<UserConstants>& constants,
                                                         PictureSize size, std::string& why_not);

}  // namespace rhview::cli
