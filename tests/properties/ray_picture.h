// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What a camera sees of single triangles, by rays in double precision, one by one against everything.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/view.h"

namespace rhview {

struct SingleTriangle {
    glm::dvec3 corners[3];
    bool two_sided = false;
};

/// A ray through a pixel's middle from the near plane on: the distance is in units of its direction, of any
/// length.
struct PixelRay {
    glm::dvec3 start{0.0};
    glm::dvec3 direction{0.0};
};

/// What a triangle does to a pixel: it counts where it is clearly before the far plane and clearly faces the
/// ray (or is two-sided), so that a renderer's rounding cannot decide.
struct RayHit {
    std::uint32_t triangle = 0;
    double distance = 0.0;
};

class RayPicture {
  public:
    static constexpr std::uint32_t kWidth = 24, kHeight = 16;
    static constexpr double kNothing = std::numeric_limits<double>::infinity();

    /// Coordinates of triangles and boxes are relative to `scene_origin`.
    RayPicture(const View& view, const glm::dvec3& scene_origin,
               const std::vector<SingleTriangle>& triangles);

    [[nodiscard]] std::size_t pixels() const { return rays_.size(); }
    /// All that counts at a pixel, in no order.
    [[nodiscard]] const std::vector<RayHit>& hits(std::size_t pixel) const { return hits_[pixel]; }
    /// Where the pixel's ray enters `box`, widened by rounding; `kNothing` if it misses it.
    [[nodiscard]] double enters(std::size_t pixel, const Aabb& box) const;

  private:
    std::vector<PixelRay> rays_;
    std::vector<std::vector<RayHit>> hits_;
};

}  // namespace rhview
