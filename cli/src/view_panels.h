// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "view_session.h"

namespace rhview::cli {

/// Makes the panels of a frame, between `ViewWindow::begin_panels` and `draw_panels`. What is chosen in them
/// is appended to `commands`; only `session.marks` is changed at once.
void make_panels(ViewSession& session, std::vector<ViewCommand>& commands);

}  // namespace rhview::cli
