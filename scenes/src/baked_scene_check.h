// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "rhview/base/rho_file.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {

inline constexpr SectionTag kSceneDescription = section_tag("SCNE");

/// Whether a scene whose arrays have the lengths that its description says is one that can be drawn: an error
/// names the batch, mesh, object or key.
Status check_baked_scene(const RhoFile& file, const SceneAndPath& scene);

}  // namespace rhview
