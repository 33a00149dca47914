// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include "rhview/base/result.h"
#include "verbs.h"

namespace rhview::cli {

/// A method of a comparison as the user names it, `octree:leaf=4096`, and its walk.
struct ListedMethod {
    std::string label;
    WalkOptions walk;
};

/// The methods of `list`, separated by commas; behind a colon each, its own options: leaf, replica-budget,
/// mode, visible-pixels, occlusion, hierarchy, submission, lod-error, and the keys of --tune. What is not
/// given is as in `common`; mode and occlusion of `common` hold for the methods that ask the device. Errors:
/// an unknown name, option or value, a method listed twice.
Result<std::vector<ListedMethod>> parse_methods(const std::string& list, const WalkOptions& common);

}  // namespace rhview::cli
