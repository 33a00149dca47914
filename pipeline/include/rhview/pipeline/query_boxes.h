// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Boxes as the device tests them: widened, so that a box which does not pass the depth test proves that
/// nothing in it would.
///
/// What is proved: geometry inside a box covers no sample that the faces of the widened box do not cover, nor
/// any at a nearer depth, if both are drawn in float as `gl::Executor` draws them: the eye, split in two
/// (`split_position`), is subtracted from a vertex, the rest multiplied by M = `clip_from_relative`. A box's
/// vertex shader takes a corner p of `low` and `high`, and adds to M·(p, 1)
///
///     z += nearer · (depth_error.xyz · |p| + depth_error.w + shift · w)
///
/// with depth clamped. With rows M_0 … M_3, p a position relative to the eye, u = 2⁻²⁴ and
/// S_r(p) = Σⱼ |M_rⱼ pⱼ| + |M_r3|:
///
/// 1. The renderer's clip coordinate of a vertex errs by at most 7u·S_r; the box's own corner by as much; an
///    object, whose matrix and eye are rounded in its own space, by `growth` (`rounding_growth`) times that.
///    e_r = 12u·(1 + growth)·S_r covers both and what clipping adds.
/// 2. Vertices are moved to a grid of 2^-bits pixels (GL_SUBPIXEL_BITS), the geometry's and the box's: 4
///    steps, m in units of x/w, cover both and leave a margin that no sample can fall into.
/// 3. The x, y and w rows A of M (x and y alone, if w is constant) map a displacement ε to A·ε. So every
///    error of 1 and 2 is a displacement of the vertex by at most |A⁺|·(√2·m·w + √3·max e_r): that is how far
///    all faces move outwards, with w and e at the farthest corner. What of it changes z but not w (oblique
///    depth) is added to 4: M_2·A⁺·(m w, m w, e_3) and M_2·A⁺·(e_0, e_1, ·).
/// 4. Depth moves towards the viewer by e_2 and the above, evaluated at each corner (they are convex in p, so
///    the hull of the moved corners holds every moved vertex); by 8u of the largest depth and two steps of a
///    fixed-point depth buffer (viewport transform, interpolation and conversion of both); and by 64u per
///    pixel of the picture's longer side of the box's own depth range (1/205 at 1,280): interpolation errs
///    by up to 8u·slope·side, so this covers triangles as steep as the box's whole range in an eighth of a
///    pixel; of steeper ones (slivers, faces seen edge-on) tests have lost no pixel, but that is no proof.
///    Depth is clamped instead of clipped.
///
/// Of a box outside the viewer only the up to three faces that face him are drawn: of a convex body they
/// cover all of its outline, at its nearest depth. A box with the eye inside, crossing the near plane, empty
/// or not finite is drawn as a cover of the whole picture at the nearest depth: it is always visible.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "rhview/base/aabb.h"
#include "rhview/base/view.h"

namespace rhview {

/// What the picture's rasteriser rounds to. Its depth range is [0, 1].
struct RasterPrecision {
    int width = 1, height = 1;  ///< of the viewport
    int subpixel_bits = 8;
    double depth_step = 0.0;  ///< of a fixed-point depth buffer, 2^-bits; 0 for floating point
};

/// One box as the vertex shader takes it.
struct BoxInstance {
    static constexpr std::uint32_t kCover = 1u << 6;
    static constexpr std::uint32_t kSlotShift = 8;
    static constexpr std::uint32_t kMostSlots = 1u << 24;

    glm::vec3 low{0.0f};  ///< relative to the eye, widened
    float shift = 0.0f;   ///< of the clip depth towards the viewer, per w
    glm::vec3 high{0.0f};
    /// Bits 2a and 2a + 1: the face drawn across axis a (0 none, 1 low, 2 high); `kCover`; the slot above.
    std::uint32_t faces_and_slot = kCover;

    [[nodiscard]] bool is_cover() const { return (faces_and_slot & kCover) != 0; }
};
static_assert(sizeof(BoxInstance) == 32);

/// By how much more the clip coordinates of an object's vertices err than those of static triangles: 1 for a
/// translation, at most 3 for rotations and scales, more for shears. 1 too for what has no inverse (a scale
/// of 0): drawn in its own space, nothing of it is seen.
double rounding_growth(const glm::dmat4& scene_from_mesh);
/// The same of its linear part, whose inverse is known.
double rounding_growth(const glm::dmat3& linear, const glm::dmat3& inverse);

/// Widens the boxes of one frame. Cost: about 60 ns a box.
class BoxWidener {
  public:
    /// `view` is valid; boxes are relative to `scene_origin`. `growth`: the largest `rounding_growth` of the
    /// objects in the boxes.
    BoxWidener(const View& view, const glm::dvec3& scene_origin, const RasterPrecision& raster,
               double growth = 1.0);

    /// `slot` < `BoxInstance::kMostSlots` comes out in the shader.
    [[nodiscard]] BoxInstance widen(const Aabb& box, std::uint32_t slot) const;

    [[nodiscard]] const glm::mat4& clip_from_relative() const { return clip_; }
    /// Weights of |x|, |y|, |z| and 1 in what a corner's clip depth is shifted by, besides shift·w.
    [[nodiscard]] const glm::vec4& depth_error() const { return depth_error_; }
    /// -1 where nearer depths are less, +1 where they are greater.
    [[nodiscard]] float nearer() const { return nearer_; }
    /// z/w of the near plane.
    [[nodiscard]] float nearest() const { return nearest_; }

  private:
    struct Range {
        double low, high;
    };
    [[nodiscard]] static Range range(const glm::dvec4& row, const glm::dvec3& low, const glm::dvec3& high);
    [[nodiscard]] Range depth_range(const glm::dvec3& low, const glm::dvec3& high) const;
    [[nodiscard]] std::uint32_t faces(const glm::vec3& low, const glm::vec3& high) const;

    glm::mat4 clip_;
    glm::dvec4 rows_[4];
    glm::dvec4 absolute_[4];  ///< |rows_|
    glm::dvec4 inside_near_;  ///< positive beyond the near plane
    glm::dvec4 centre_;       ///< of projection, homogeneous; its w is 0 or positive
    glm::dvec3 eye_;          ///< of the renderer, relative to the scene's origin
    glm::vec4 depth_error_;
    double spread_ = 0.0;  ///< |A⁺|
    double rounding_ = 0.0;
    double snap_ = 0.0;        ///< m
    double eye_error_ = 0.0;   ///< metres
    double base_shift_ = 0.0;  ///< per w
    double range_share_ = 0.0;
    float nearer_ = -1.0f;
    float nearest_ = -1.0f;
};

}  // namespace rhview
