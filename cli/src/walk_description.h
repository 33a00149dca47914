// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "method.h"
#include "verbs.h"
#include "walk_ground.h"
#include "walk_report.h"

namespace rhview::cli {

/// What a report says before the first frame: scene, device, build, method and constants.
WalkReport describe(const WalkOptions& options, const WalkGround& ground, const PreparedMethod& method);

}  // namespace rhview::cli
