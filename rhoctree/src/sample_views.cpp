// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "sample_views.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace rhview {
namespace {

constexpr double kNearestShare = 1.0 / 500.0;
constexpr std::size_t kOctaves = 8;
constexpr double kSteepest = 0.6;  // height of the view direction over its length on the ground
constexpr double kFovY = 1.0471975511965976;
constexpr double kAspect = 16.0 / 9.0;

class Random {
  public:
    double operator()(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    std::size_t below(std::size_t count) {
        return static_cast<std::size_t>((*this)(0.0, 1.0) * static_cast<double>(count));
    }

  private:
    std::mt19937 engine_{20261124u};
};

View view_in_front_of(const TriangleBatch& batch, std::size_t triangle, double size, Random& random) {
    const std::uint32_t* corner = batch.indices.data() + 3 * triangle;
    const glm::dvec3 a(batch.positions[corner[0]]), b(batch.positions[corner[1]]),
        c(batch.positions[corner[2]]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    // Evenly over octaves, and within one: no library function whose last bit differs between machines.
    double share = kNearestShare * random(1.0, 2.0);
    for (std::size_t octave = random.below(kOctaves); octave > 0; --octave) share *= 2.0;
    glm::dvec3 eye = (a + b + c) / 3.0;
    // One without area has no front: its camera stays above it.
    eye += size * share * (length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0));
    glm::dvec3 forward(0.0);
    while (!(glm::dot(forward, forward) <= 1.0 && glm::dot(forward, forward) > 0.01))
        forward = {random(-1.0, 1.0), 0.0, random(-1.0, 1.0)};
    forward = glm::normalize(forward) + glm::dvec3(0.0, random(-kSteepest, kSteepest), 0.0);
    return {look_along(eye, forward, {0.0, 1.0, 0.0}),
            perspective(kFovY, kAspect, 1e-4 * size, std::numeric_limits<double>::infinity(),
                        ClipDepth::ReversedZeroToOne),
            ClipDepth::ReversedZeroToOne};
}

}  // namespace

std::vector<View> sample_views(std::span<const TriangleBatch> batches, const Aabb& bounds,
                               std::size_t count) {
    std::size_t triangles = 0;
    for (const TriangleBatch& batch : batches) triangles += batch.indices.size() / 3;
    const double size = glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
    std::vector<View> views;
    if (triangles == 0 || !(size > 0.0) || !std::isfinite(size)) return views;
    Random random;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t triangle = random.below(triangles);
        std::size_t b = 0;
        while (triangle >= batches[b].indices.size() / 3) triangle -= batches[b++].indices.size() / 3;
        View view = view_in_front_of(batches[b], triangle, size, random);
        if (validate(view).ok()) views.push_back(view);
    }
    return views;
}

}  // namespace rhview
