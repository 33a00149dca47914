// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Typed ids: an index into the array that its name says, never interchangeable with another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rhview {

enum class MaterialId : std::uint32_t {};  ///< what the engine binds together: shader, textures, state
enum class BatchId : std::uint32_t {};     ///< static triangles of one material in one vertex format
enum class NodeId : std::uint32_t {};      ///< a node of the octree
enum class ObjectId : std::uint32_t {};    ///< an object the application places
enum class MeshId : std::uint32_t {};      ///< a mesh that objects share

/// The id's place in its array.
template <class Id>
requires std::is_enum_v<Id>
constexpr std::size_t index_of(Id id) {
    return static_cast<std::size_t>(id);
}

}  // namespace rhview
