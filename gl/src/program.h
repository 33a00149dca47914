// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "rhview/base/result.h"
#include "rhview/gl/handle.h"

namespace rhview::gl {

/// Compiles and links; an error carries the driver's log.
Result<Program> link_program(const char* vertex_source, const char* fragment_source);
Result<Program> link_compute_program(const char* source);

}  // namespace rhview::gl
