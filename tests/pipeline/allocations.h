// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

namespace rhview {

/// Allocations of this program so far: the promise is that a warm planner makes none.
long allocations();

}  // namespace rhview
