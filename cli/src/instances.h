// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "constants.h"
#include "rhview/scenes/static_instances.h"
#include "scene_source.h"
#include "verbs.h"

namespace rhview::cli {

/// An error where the user wrote none of `auto`, `flatten` and `keep`.
Status check_instances(const InstancesWanted& wanted);

/// Flattens and keeps as the user wants and `constants` say; without constants by the default costs. A baked
/// scene was settled when it was baked: asking for anything else is an error.
Status settle_instances(LoadedScene& loaded, const std::string& spec, const InstancesWanted& wanted,
                        const std::optional<UserConstants>& constants);

}  // namespace rhview::cli
