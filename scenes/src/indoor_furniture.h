// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What stands in the rooms of the scene `indoor`.
#pragma once

#include <array>
#include <cstdint>

#include "random.h"
#include "shapes.h"

namespace rhview {

enum class IndoorMaterial : std::uint8_t {
    Plaster,
    Concrete,
    Parquet,
    Oak,
    Walnut,
    Steel,
    RedCloth,
    BlueCloth,
    Paper,
    Leather,
    Ceramic,
    Leaf,
    LampGlass,
};
inline constexpr std::size_t kIndoorMaterials = 13;

/// Hands finished shapes to the scene, one static object each.
class IndoorWriter {
  public:
    explicit IndoorWriter(SceneBuilder& builder);

    void reserve(std::size_t vertices);
    /// An empty buffer for the next object.
    ShapeBuffer& start();
    void finish(IndoorMaterial material);
    void add_plain_box(IndoorMaterial material, const Frame& frame, const glm::dvec3& low,
                       const glm::dvec3& high);

  private:
    SceneBuilder& builder_;
    std::array<MaterialId, kIndoorMaterials> materials_{};
    ShapeBuffer buffer_;
};

/// Furnishes a room of about 5.8 m × 5.8 m × 3 m; the frame's origin is the middle of its floor. A strip
/// of 1.2 m along z through the middle stays free: people come in there.
void furnish_room(IndoorWriter& writer, SceneRandom& random, const Frame& room);

/// A lamp that hangs from `ceiling`.
void add_lamp(IndoorWriter& writer, const glm::dvec3& ceiling);

}  // namespace rhview
