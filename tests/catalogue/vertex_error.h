// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "rhview/base/view.h"
#include "rhview/scenes/scene.h"

namespace rhview {

/// The largest distance, in pixels of a picture `width` × `height`, between where the renderer's `float`
/// transform puts a vertex of the static batches and where it is by `long double`: of those in view.
double worst_vertex_error_px(const Scene& scene, const View& view, double width, double height);

}  // namespace rhview
