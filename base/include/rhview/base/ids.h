// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Typed ids: an index into the array that its name says, never interchangeable with another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rhview {

/// What the engine binds together: shader, textures, state.
enum class MaterialId : std::uint32_t {};
/// Static triangles of one material in one vertex format.
enum class BatchId : std::uint32_t {};
/// A node of the octree.
enum class NodeId : std::uint32_t {};
/// An object that the application places.
enum class ObjectId : std::uint32_t {};
/// A mesh that objects share.
enum class MeshId : std::uint32_t {};

/// The id's place in its array.
template <class Id>
requires std::is_enum_v<Id>
constexpr std::size_t index_of(Id id) {
    return static_cast<std::size_t>(id);
}

}  // namespace rhview
