// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/query_boxes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "rhview/base/assert.h"
#include "rhview/base/rounding.h"

namespace rhview {
namespace {

constexpr double kUnit = 0x1p-24;
constexpr double kClipRounding = 12.0;  ///< u, of the geometry and of the box each
constexpr double kGridSteps = 4.0;      ///< of GL_SUBPIXEL_BITS
constexpr double kDepthRounding = 8.0;  ///< u, of the largest depth
constexpr double kDepthSteps = 2.0;     ///< of a fixed-point depth buffer
/// u per pixel of the picture, of the box's depth range: interpolation errs by up to 8u·slope·size, and
/// slopes go up to the whole range in an eighth of a pixel.
constexpr double kRangeRounding = 64.0;
/// The eye is rounded to 2^-48 of its coordinates, an object's once more.
constexpr double kEyeRounding = 0x1p-46;

/// A⁺ of the x, y and w rows as three columns; the third is 0 where w is constant.
struct Inverse {
    glm::dvec3 columns[3]{};

    explicit Inverse(const glm::dvec4 (&rows)[4]) {
        const glm::dvec3 x(rows[0]), y(rows[1]), w(rows[3]);
        if (w == glm::dvec3(0.0)) {
            const double xx = glm::dot(x, x), xy = glm::dot(x, y), yy = glm::dot(y, y);
            const double determinant = xx * yy - xy * xy;
            columns[0] = (yy * x - xy * y) / determinant;
            columns[1] = (xx * y - xy * x) / determinant;
            return;
        }
        const double determinant = glm::dot(x, glm::cross(y, w));
        columns[0] = glm::cross(y, w) / determinant;
        columns[1] = glm::cross(w, x) / determinant;
        columns[2] = glm::cross(x, y) / determinant;
    }

    [[nodiscard]] double norm() const {
        double sum = 0.0;
        for (const glm::dvec3& c : columns) sum += glm::dot(c, c);
        return std::sqrt(sum);
    }
};

/// The homogeneous point that the rows x, y and w all map to 0: minors of the 3×4 matrix.
glm::dvec4 centre_of_projection(const glm::dvec4 (&rows)[4], double nearer) {
    const glm::dvec3 x(rows[0]), y(rows[1]), w(rows[3]);
    glm::dvec4 centre(
        rows[0].w * glm::cross(y, w) + rows[1].w * glm::cross(w, x) + rows[3].w * glm::cross(x, y),
        -glm::dot(x, glm::cross(y, w)));
    // Parallel rays come from where depths are nearer.
    if (centre.w < 0.0 || (centre.w == 0.0 && nearer * glm::dot(rows[2], centre) < 0.0)) centre = -centre;
    return centre;
}

glm::dvec4 inside_near(const glm::dvec4 (&rows)[4], ClipDepth depth) {
    if (depth == ClipDepth::NegativeOneToOne) return rows[2] + rows[3];
    return depth == ClipDepth::ZeroToOne ? rows[2] : rows[3] - rows[2];
}

double weighted(const glm::dvec4& weights, const glm::dvec3& magnitude) {
    return glm::dot(glm::dvec3(weights), magnitude) + weights.w;
}

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

double rounding_growth(const glm::dmat4& scene_from_mesh) {
    const glm::dmat3 linear(scene_from_mesh);
    return rounding_growth(linear, glm::inverse(linear));
}

double rounding_growth(const glm::dmat3& linear, const glm::dmat3& inverse) {
    double growth = 1.0;
    for (int row = 0; row < 3; ++row) {
        double sum = 0.0;
        for (int column = 0; column < 3; ++column)
            for (int k = 0; k < 3; ++k) sum += std::abs(linear[k][row] * inverse[column][k]);
        growth = std::max(growth, sum);
    }
    return std::isfinite(growth) ? growth : 1.0;
}

BoxWidener::BoxWidener(const View& view, const glm::dvec3& scene_origin, const RasterPrecision& raster,
                       double growth)
    : clip_(view.clip_from_eye_relative()) {
    for (int r = 0; r < 4; ++r) {
        rows_[r] = glm::dvec4(clip_[0][r], clip_[1][r], clip_[2][r], clip_[3][r]);
        absolute_[r] = glm::abs(rows_[r]);
    }
    const bool reversed = view.clip_depth == ClipDepth::ReversedZeroToOne;
    const bool symmetric = view.clip_depth == ClipDepth::NegativeOneToOne;
    nearer_ = reversed ? 1.0f : -1.0f;
    nearest_ = reversed ? 1.0f : symmetric ? -1.0f : 0.0f;
    inside_near_ = inside_near(rows_, view.clip_depth);
    centre_ = centre_of_projection(rows_, nearer_);
    const glm::dvec3 exact_eye = view.eye() - scene_origin;
    const SplitPosition eye = split_position(exact_eye);
    eye_ = glm::dvec3(eye.high) + glm::dvec3(eye.low);
    eye_error_ = kEyeRounding * growth * glm::length(exact_eye);

    const Inverse inverse(rows_);
    spread_ = inverse.norm();
    rounding_ = kClipRounding * (1.0 + growth) * kUnit;
    range_share_ = kRangeRounding * kUnit * std::max(raster.width, raster.height);
    snap_ = 2.0 * kGridSteps * std::exp2(-raster.subpixel_bits) / std::min(raster.width, raster.height);
    glm::dvec3 residual(0.0);  // M_2·A⁺
    for (int i = 0; i < 3; ++i) residual[i] = std::abs(glm::dot(glm::dvec3(rows_[2]), inverse.columns[i]));
    depth_error_ = glm::vec4(rounding_ * (absolute_[2] + residual[0] * absolute_[0] +
                                          residual[1] * absolute_[1] + residual[2] * absolute_[3]));
    // Window depth is (z/w + 1) / 2 in the symmetric convention: its steps count twice.
    base_shift_ =
        (residual[0] + residual[1]) * snap_ + (symmetric ? 2.0 : 1.0) * kDepthSteps * raster.depth_step;
    if (symmetric) base_shift_ += 2.0 * kDepthRounding * kUnit;
}

BoxWidener::Range BoxWidener::range(const glm::dvec4& row, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 a = glm::dvec3(row) * low;
    const glm::dvec3 b = glm::dvec3(row) * high;
    const glm::dvec3 least = glm::min(a, b), most = glm::max(a, b);
    return {least.x + least.y + least.z + row.w, most.x + most.y + most.z + row.w};
}

/// z/w is monotonous along every line, so its extremes are at corners; at those where z or w is extreme, for
/// projections whose depth depends on w alone.
BoxWidener::Range BoxWidener::depth_range(const glm::dvec3& low, const glm::dvec3& high) const {
    Range result{1.0, -1.0};
    for (const int r : {2, 3}) {
        const glm::dvec3 positive(rows_[r].x > 0.0 ? high.x : low.x, rows_[r].y > 0.0 ? high.y : low.y,
                                  rows_[r].z > 0.0 ? high.z : low.z);
        for (const glm::dvec3& corner : {positive, low + high - positive}) {
            const double w = glm::dot(glm::dvec3(rows_[3]), corner) + rows_[3].w;
            const double z = glm::dot(glm::dvec3(rows_[2]), corner) + rows_[2].w;
            const double depth = std::clamp(z / w, -1.0, 1.0);
            result.low = std::min(result.low, depth);
            result.high = std::max(result.high, depth);
        }
    }
    return result;
}

std::uint32_t BoxWidener::faces(const glm::vec3& low, const glm::vec3& high) const {
    std::uint32_t result = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (centre_[axis] < static_cast<double>(low[axis]) * centre_.w) result |= 1u << (2 * axis);
        if (centre_[axis] > static_cast<double>(high[axis]) * centre_.w) result |= 2u << (2 * axis);
    }
    return result;
}

BoxInstance BoxWidener::widen(const Aabb& box, std::uint32_t slot) const {
    RHVIEW_ASSERT(slot < BoxInstance::kMostSlots);
    BoxInstance instance;
    instance.faces_and_slot = BoxInstance::kCover | slot << BoxInstance::kSlotShift;
    glm::dvec3 low = glm::dvec3(box.min) - eye_, high = glm::dvec3(box.max) - eye_;
    if (box.is_empty() || !is_finite(low) || !is_finite(high)) return instance;
    const glm::dvec3 magnitude = glm::max(glm::abs(low), glm::abs(high));
    const double error =
        rounding_ * std::max({weighted(absolute_[0], magnitude), weighted(absolute_[1], magnitude),
                              weighted(absolute_[3], magnitude)});
    const double farthest = std::max(0.0, range(rows_[3], low, high).high);
    const double widening =
        spread_ * (std::sqrt(2.0) * snap_ * farthest + std::sqrt(3.0) * error) + eye_error_;
    low -= widening;
    high += widening;
    const double slack = rounding_ * (weighted(absolute_[2], magnitude) + weighted(absolute_[3], magnitude));
    if (!(range(inside_near_, low, high).low > slack) || !(range(rows_[3], low, high).low > 0.0))
        return instance;
    const Range depth = depth_range(low, high);
    double shift = base_shift_ + range_share_ * (depth.high - depth.low);
    if (nearest_ != -1.0f)
        shift += kDepthRounding * kUnit * std::max(std::abs(depth.low), std::abs(depth.high));
    instance.low = nearest_float(low);
    instance.high = nearest_float(high);
    instance.shift = static_cast<float>(shift);
    const std::uint32_t drawn = faces(instance.low, instance.high);
    if (drawn != 0) instance.faces_and_slot = drawn | slot << BoxInstance::kSlotShift;
    return instance;
}

}  // namespace rhview
