// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

namespace rhview::gl {

/// Vertex attribute locations, as the shaders name them.
inline constexpr unsigned kPositionAttribute = 0;
inline constexpr unsigned kNormalAttribute = 1;
inline constexpr unsigned kColourAttribute = 2;
/// Of an instance, four floats each: `ObjectInstanceData`.
inline constexpr unsigned kFirstInstanceAttribute = 3;
inline constexpr unsigned kInstanceAttributes = 9;
/// The vertex buffer binding that instances come from.
inline constexpr unsigned kInstanceBinding = 3;

}  // namespace rhview::gl
