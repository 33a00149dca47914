// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// An OGRE scene as applications make them: a mesh for each kind of thing, an entity and a node for each
// thing.
#pragma once

#include <OgreSceneManager.h>

constexpr int kStreets = 40;     ///< along each side
constexpr float kPitch = 24.0f;  ///< metres from street to street
constexpr float kHalf = 0.5f * kPitch * kStreets;

/// Meshes and materials, GLSL for OpenGL 3 and later.
void make_town_resources();
/// 8,000 entities: houses with roofs, trees, lamps and fountains.
void place_town(Ogre::SceneManager& scene);
