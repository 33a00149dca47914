// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// What an engine does first; both ways of taking rhview compile it.

#include <rhview/base/aabb.h>
#include <rhview/base/version.h>
#include <rhview/base/view.h>
#include <rhview/frustum/frustum.h>

#include <cstdio>

int main() {
    rhview::View view;
    view.camera_from_world = rhview::look_along({0, 2, 0}, {0, 0, -1}, {0, 1, 0});
    view.clip_from_camera = rhview::perspective(1.0, 1.5, 0.1, 100.0, rhview::ClipDepth::ZeroToOne);
    view.clip_depth = rhview::ClipDepth::ZeroToOne;
    if (!rhview::validate(view)) return 1;

    const rhview::Frustum frustum = rhview::make_frustum(view);
    rhview::PlaneMask mask = frustum.mask;
    if (rhview::classify(frustum, {{-1, 1, -11}, {1, 3, -9}}, mask) != rhview::Containment::Inside) return 2;
    mask = frustum.mask;
    if (rhview::classify(frustum, {{-1, 1, 9}, {1, 3, 11}}, mask) != rhview::Containment::Outside) return 3;

    std::printf("rhview %s: one box inside, one outside\n", rhview::kVersion);
    return 0;
}
