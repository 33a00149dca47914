// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Triangles: Möller & Trumbore 1997. Boxes: the slab test of Kay & Kajiya 1986.

#include "ray_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace rhview {
namespace {

// Cosine of an angle at which float and double agree on the side that is seen.
constexpr double kClearlyFacing = 1e-3;
// Of the interval of depth: what is nearer to its ends may be clipped, or not.
constexpr double kClearlyInside = 1e-5;

std::optional<double> distance_of(const PixelRay& ray, const SingleTriangle& triangle) {
    const glm::dvec3 ab = triangle.corners[1] - triangle.corners[0];
    const glm::dvec3 ac = triangle.corners[2] - triangle.corners[0];
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double facing = -glm::dot(normal, ray.direction);
    const double certain = kClearlyFacing * glm::length(normal) * glm::length(ray.direction);
    if (!(triangle.two_sided ? std::abs(facing) > certain : facing > certain)) return std::nullopt;
    const glm::dvec3 from = ray.start - triangle.corners[0];
    const glm::dvec3 across = glm::cross(ray.direction, from);
    const double u = -glm::dot(ac, across) / facing, v = glm::dot(ab, across) / facing;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return std::nullopt;
    return glm::dot(normal, from) / facing;
}

bool clearly_in_depth(const glm::dmat4& clip, ClipDepth depth, const glm::dvec3& from_eye) {
    const glm::dvec4 p = clip * glm::dvec4(from_eye, 1.0);
    if (!(p.w > 0.0)) return false;
    double z = p.z / p.w;
    if (depth == ClipDepth::NegativeOneToOne) z = 0.5 * z + 0.5;
    return z > kClearlyInside && z < 1.0 - kClearlyInside;
}

}  // namespace

RayPicture::RayPicture(const View& view, const glm::dvec3& scene_origin,
                       const std::vector<SingleTriangle>& triangles) {
    const glm::dmat4 clip = view.clip_from_eye_relative(), from_clip = glm::inverse(clip);
    const glm::dvec3 eye = view.eye() - scene_origin;
    const bool reversed = view.clip_depth == ClipDepth::ReversedZeroToOne;
    const auto place = [&](double x, double y, double z) {
        const glm::dvec4 p = from_clip * glm::dvec4(x, y, z, 1.0);
        return glm::dvec3(p) / p.w;
    };
    const double near = reversed ? 1.0 : view.clip_depth == ClipDepth::ZeroToOne ? 0.0 : -1.0;
    for (std::uint32_t row = 0; row < kHeight; ++row)
        for (std::uint32_t column = 0; column < kWidth; ++column) {
            const double x = (2.0 * column + 1.0) / kWidth - 1.0, y = (2.0 * row + 1.0) / kHeight - 1.0;
            const glm::dvec3 start = place(x, y, near), later = place(x, y, 0.5);
            rays_.push_back({eye + start, glm::normalize(later - start)});
        }
    hits_.resize(rays_.size());
    for (std::size_t pixel = 0; pixel < rays_.size(); ++pixel)
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            const std::optional<double> distance = distance_of(rays_[pixel], triangles[t]);
            if (distance && *distance > 0.0 &&
                clearly_in_depth(clip, view.clip_depth,
                                 rays_[pixel].start + *distance * rays_[pixel].direction - eye))
                hits_[pixel].push_back({t, *distance});
        }
}

double RayPicture::enters(std::size_t pixel, const Aabb& box) const {
    const PixelRay& ray = rays_[pixel];
    double first = 0.0, last = kNothing;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double low = static_cast<double>(box.min[axis]), high = static_cast<double>(box.max[axis]);
        const double slack = 1e-9 * std::max({std::abs(low), std::abs(high), std::abs(ray.start[axis])});
        if (ray.direction[axis] == 0.0) {
            if (ray.start[axis] < low - slack || ray.start[axis] > high + slack) return kNothing;
            continue;
        }
        const double a = (low - slack - ray.start[axis]) / ray.direction[axis];
        const double b = (high + slack - ray.start[axis]) / ray.direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last ? first : kNothing;
}

}  // namespace rhview
