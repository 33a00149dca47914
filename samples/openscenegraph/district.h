// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// A scene as applications of OpenSceneGraph make them: a geometry for each kind of thing, a transform for
// each thing, one state set for each material.
#pragma once

#include <osg/Group>

#include "draw_counter.h"

constexpr int kStreets = 40;     ///< along each side
constexpr float kPitch = 30.0f;  ///< metres from street to street
constexpr float kHalf = 0.5f * kPitch * kStreets;
constexpr int kEntities = 5 * kStreets * kStreets;

/// Houses of up to ten floors with roofs, trees, lamps and benches: 8,000 transforms under one group, then
/// put into a hierarchy by OpenSceneGraph's own optimiser. `counter` counts what is drawn of them.
osg::ref_ptr<osg::Group> make_district(DrawCounter& counter);

/// Back faces are left out, and light comes from where the camera is.
void set_common_state(osg::StateSet& state);
