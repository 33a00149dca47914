// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/lod/projected_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace rhview {
namespace {

/// Of what is computed in a dozen steps from a square.
constexpr double kRoundingUp = 1e-7;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A row of a matrix: `linear`·p + `constant`.
struct Row {
    glm::dvec3 linear;
    double constant;

    Row(const glm::dmat4& m, glm::length_t i) : linear(m[0][i], m[1][i], m[2][i]), constant(m[3][i]) {}
    [[nodiscard]] double at(const glm::dvec3& p) const { return glm::dot(linear, p) + constant; }
};

/// Screen coordinates of one axis, within the screen, that the sphere can show.
struct ScreenRange {
    double low = -1.0;
    double high = 1.0;
};

/// For p in the sphere, x·p / w·p differs from its value s at the centre by at most |x - s w|·radius / w_min.
/// A sphere beside the screen has its nearest edge for a range.
ScreenRange range_on_screen(const Row& x, const Row& w, const BoundingSphere& sphere, double w_min) {
    const double s = x.at(sphere.centre) / w.at(sphere.centre);
    const double reach = glm::length(x.linear - s * w.linear) * sphere.radius / w_min;
    return {std::clamp(s - reach, -1.0, 1.0), std::clamp(s + reach, -1.0, 1.0)};
}

/// The square of the greatest singular value of the 2×3 matrix of rows `u` and `v`.
double squared_stretch(const glm::dvec3& u, const glm::dvec3& v) {
    const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
    const double half_difference = 0.5 * (uu - vv);
    return 0.5 * (uu + vv) + std::sqrt(half_difference * half_difference + uv * uv);
}

}  // namespace

BoundingSphere sphere_of(const Aabb& box) {
    if (box.is_empty()) return {};
    const glm::dvec3 low = box.min, high = box.max;
    // A little more than half the diagonal: centre and root are rounded.
    return {0.5 * (low + high), 0.5 * glm::length(high - low) * (1.0 + 1e-12)};
}

double largest_stretch(const glm::dmat3& linear) {
    // The greatest eigenvalue of AᵀA, in closed form: Smith, "Eigenvalues of a symmetric 3 × 3 matrix", 1961.
    const glm::dmat3 square = glm::transpose(linear) * linear;
    const double mean = (square[0][0] + square[1][1] + square[2][2]) / 3.0;
    const glm::dmat3 rest = square - glm::dmat3(mean);
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += glm::dot(rest[i], rest[i]);
    const double spread = std::sqrt(sum / 6.0);
    double greatest = mean;
    if (spread > 0.0) {
        const double cosine = 0.5 * glm::determinant(rest / spread);
        greatest = mean + 2.0 * spread * std::cos(std::acos(std::clamp(cosine, -1.0, 1.0)) / 3.0);
    }
    return std::sqrt(greatest) * (1.0 + kRoundingUp);
}

double pixels_per_unit(const glm::dmat4& clip_from_object, const BoundingSphere& sphere, double width_px,
                       double height_px) {
    const Row x(clip_from_object, 0), y(clip_from_object, 1), w(clip_from_object, 3);
    const double w_reach = glm::length(w.linear) * sphere.radius;
    const double w_min = w.at(sphere.centre) - w_reach;
    if (w.at(sphere.centre) + w_reach < 0.0) return 0.0;
    if (!(w_min > 0.0)) return kInfinity;
    const ScreenRange s = range_on_screen(x, w, sphere, w_min), t = range_on_screen(y, w, sphere, w_min);
    const glm::dvec3 u[2]{0.5 * width_px * (x.linear - s.low * w.linear),
                          0.5 * width_px * (x.linear - s.high * w.linear)};
    const glm::dvec3 v[2]{0.5 * height_px * (y.linear - t.low * w.linear),
                          0.5 * height_px * (y.linear - t.high * w.linear)};
    double most = 0.0;
    for (const glm::dvec3& across : u)
        for (const glm::dvec3& up : v) most = std::max(most, squared_stretch(across, up));
    most = std::sqrt(most);
    // A NaN in x or y is lost in max, but not in a sum.
    const double sum = s.low + s.high + t.low + t.high;
    return std::isfinite(sum) && std::isfinite(most) ? most / w_min : kInfinity;
}

}  // namespace rhview
