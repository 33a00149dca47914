// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "rhview/pipeline/query_boxes.h"

namespace rhview::gl {

/// Bits of a pixel that vertices are moved to. Asks the driver: not for every frame.
int subpixel_bits();
/// Of the bound framebuffer and viewport.
RasterPrecision bound_raster_precision(int subpixel_bits);

}  // namespace rhview::gl
