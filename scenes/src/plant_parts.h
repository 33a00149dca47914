// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// One bay of the scene `plant`: its deck and steelwork, its machines, and pipes until the bay has its share
/// of objects.
#pragma once

#include <array>
#include <cstdint>

#include "random.h"
#include "shapes.h"

namespace rhview {

inline constexpr double kBayPitch = 12.0;
inline constexpr double kDeckHeight = 6.0;
inline constexpr double kWalkway = 2.4;  ///< on the low z side of each bay

enum class PlantMaterial : std::uint8_t {
    Steel,
    PipeSteel,
    Copper,
    YellowPaint,
    RedPaint,
    BluePaint,
    GreenPaint,
    TankWhite,
    Grating,
    Insulation,
};
inline constexpr std::size_t kPlantMaterials = 10;

/// Hands finished shapes to the scene, one static object each, and nothing beyond the quota.
class PlantWriter {
  public:
    PlantWriter(SceneBuilder& builder, int sides, std::int64_t objects);

    /// From now on objects are taken until there are `objects` in all.
    void set_quota(std::int64_t objects) { quota_ = objects; }
    [[nodiscard]] bool is_full() const { return written_ >= quota_; }
    [[nodiscard]] int sides() const { return sides_; }
    /// An empty buffer for the next object.
    ShapeBuffer& start();
    /// Adds what was put into the buffer since `start`.
    void finish(PlantMaterial material);

  private:
    SceneBuilder& builder_;
    std::array<MaterialId, kPlantMaterials> materials_{};
    ShapeBuffer buffer_;
    int sides_;
    std::int64_t quota_ = 0;
    std::int64_t written_ = 0;
};

struct BayPlace {
    glm::dvec3 corner{0.0};  ///< least x, deck level, least z
    bool top_deck = false;
    bool last_x = false;
    bool last_z = false;
};

void add_bay(PlantWriter& writer, SceneRandom& random, const BayPlace& place);

}  // namespace rhview
