// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "rhview/gl/handle.h"

namespace rhview::gl {

/// Storage of an OpenGL internal format; leaves it bound.
Renderbuffer make_renderbuffer(unsigned format, int width, int height);

/// A complete framebuffer of both, bound for drawing and reading; no name if the driver can't make it.
Framebuffer make_framebuffer(const Renderbuffer& colour, const Renderbuffer& depth);

}  // namespace rhview::gl
