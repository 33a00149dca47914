// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "surface_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rhview {
namespace {

// Bounds this much above a distance that was seen are tight enough.
constexpr double kTightness = 1.05;
// Cuts in a row: what they leave is far below any tolerance, and the stack is bounded.
constexpr int kMaxDepth = 64;
// Cuts for each triangle of either surface, on average over a chunk. Surfaces that are alike take about five;
// the bound holds without the rest, so nothing that is strange can make the work grow without end.
constexpr double kCutsPerTriangle = 64.0;
// Of the surface's size: distances that differ by less are told apart by rounding only.
constexpr double kLeastDistance = 1e-7;
// Halvings of an edge to find where to cut it.
constexpr int kCutSteps = 10;
// The least part of it that a cut leaves on either side, and its least length beside the longest edge: so
// each cut makes triangles smaller, and one near triangle after the other is not cut off in as many cuts in a
// row.
constexpr double kLeastPart = 0.25;
constexpr double kLeastEdge = 0.9;
// Hints pass on within a chunk and not between chunks: what is found must not depend on the threads.
constexpr std::size_t kChunk = 512;

using Corners = std::array<glm::dvec3, 3>;

class Bounder {
  public:
    Bounder(const TriangleTree& to, double enough, std::uint64_t cuts)
        : to_(to), enough_(enough), cuts_left_(cuts) {}

    /// A bound for the triangle of these corners.
    double bound(const Corners& corners) { return bound(corners, kMaxDepth); }

  private:
    double bound(const Corners& corners, int depth) {
        // What the neighbour is near to comes first: as a rule it will do.
        if (const double hinted = distances(corners, hint_).most(); hinted <= enough_) return hinted;
        const TriangleTree::Nearest found = to_.nearest((corners[0] + corners[1] + corners[2]) / 3.0, hint_);
        hint_ = found.triangle;
        const Distances near = distances(corners, found.triangle);
        // The centre is that far indeed: no cut, here or elsewhere, can prove less of the whole surface.
        enough_ = std::max(enough_, kTightness * std::sqrt(found.distance_squared));
        if (near.most() <= enough_ || depth == 0 || cuts_left_ == 0) return near.most();
        --cuts_left_;
        const Cut cut = choose_cut(corners, near, found.triangle, enough_);
        Corners first = corners, second = corners;
        first[cut.to] = cut.at;
        second[cut.from] = cut.at;
        return std::max(bound(first, depth - 1), bound(second, depth - 1));
    }

    /// Of the corners from one triangle.
    struct Distances {
        std::array<double, 3> of;
        [[nodiscard]] double most() const { return std::max({of[0], of[1], of[2]}); }
    };
    [[nodiscard]] Distances distances(const Corners& corners, std::uint32_t triangle) const {
        const Triangle near = to_.triangle(triangle);
        Distances result{};
        for (std::size_t i = 0; i < 3; ++i) result.of[i] = std::sqrt(distance_squared(corners[i], near));
        return result;
    }

    struct Cut {
        std::size_t from = 0;
        std::size_t to = 1;
        glm::dvec3 at{0.0};
    };

    /// Of the edges that leave what is within `tight` of the triangle, the longest, where it leaves it; if
    /// none does, or at its very beginning, the middle of the longest edge of all.
    [[nodiscard]] Cut choose_cut(const Corners& corners, const Distances& near, std::uint32_t triangle,
                                 double tight) const {
        Cut longest, leaving;
        double longest_squared = -1.0, leaving_squared = -1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const glm::dvec3 edge = corners[j] - corners[i];
            const double squared = glm::dot(edge, edge);
            const bool begins = near.of[i] <= tight, ends = near.of[j] <= tight;
            if (squared > longest_squared) {
                longest = {i, j, 0.5 * (corners[i] + corners[j])};
                longest_squared = squared;
            }
            if (begins != ends && squared > leaving_squared) {
                leaving = begins ? Cut{i, j, {}} : Cut{j, i, {}};
                leaving_squared = squared;
            }
        }
        if (leaving_squared < kLeastEdge * kLeastEdge * longest_squared) return longest;
        const double share = share_within(corners[leaving.from], corners[leaving.to], triangle, tight);
        if (share < kLeastPart || share > 1.0 - kLeastPart) return longest;
        leaving.at = glm::mix(corners[leaving.from], corners[leaving.to], share);
        return leaving;
    }

    /// How much of the way from `a`, which is within `tight` of the triangle, to `b`, which is not, is
    /// within: all of it from `a` on, since the distance is convex. Not more than it is, and little less.
    [[nodiscard]] double share_within(const glm::dvec3& a, const glm::dvec3& b, std::uint32_t triangle,
                                      double tight) const {
        const Triangle near = to_.triangle(triangle);
        const double tight_squared = tight * tight;
        double low = 0.0, high = 1.0;
        for (int step = 0; step < kCutSteps; ++step) {
            const double t = 0.5 * (low + high);
            (distance_squared(glm::mix(a, b, t), near) <= tight_squared ? low : high) = t;
        }
        return low;
    }

    const TriangleTree& to_;
    double enough_;
    std::uint64_t cuts_left_;
    std::uint32_t hint_ = 0;
};

/// The greatest of `value(first, last)` over chunks of `count`.
template <class Value>
double greatest(std::size_t count, const Value& value) {
    const std::size_t chunks = (count + kChunk - 1) / kChunk;
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, chunks), 0.0,
        [&](const tbb::blocked_range<std::size_t>& range, double most) {
            for (std::size_t chunk = range.begin(); chunk < range.end(); ++chunk)
                most = std::max(most, value(chunk * kChunk, std::min(count, (chunk + 1) * kChunk)));
            return most;
        },
        [](double a, double b) { return std::max(a, b); });
}

Corners corners_of(const SurfaceTriangles& surface, std::size_t triangle) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = surface.positions[surface.indices[3 * triangle + i]];
    return corners;
}

/// The greatest distance among centroids and first corners.
double seen_distance(const SurfaceTriangles& from, const TriangleTree& to) {
    return greatest(from.indices.size() / 3, [&](std::size_t first, std::size_t last) {
        double most_squared = 0.0;
        std::uint32_t hint = 0;
        for (std::size_t t = first; t < last; ++t) {
            const Corners corners = corners_of(from, t);
            for (const glm::dvec3& point : {(corners[0] + corners[1] + corners[2]) / 3.0, corners[0]}) {
                // Near enough to what is near: it can't be the farthest.
                if (distance_squared(point, to.triangle(hint)) <= most_squared) continue;
                const TriangleTree::Nearest found = to.nearest(point, hint);
                hint = found.triangle;
                most_squared = std::max(most_squared, found.distance_squared);
            }
        }
        return std::sqrt(most_squared);
    });
}

}  // namespace

double one_sided_distance_bound(const SurfaceTriangles& from, const TriangleTree& to, double floor) {
    const double least = kLeastDistance * glm::length(glm::dvec3(to.bounds().extent()));
    const double enough = std::max({floor, least, kTightness * seen_distance(from, to)});
    const auto count = static_cast<double>(from.indices.size() / 3);
    const double cuts = kCutsPerTriangle * (1.0 + static_cast<double>(to.triangle_count()) / count);
    return greatest(from.indices.size() / 3, [&](std::size_t first, std::size_t last) {
        Bounder bounder(to, enough, static_cast<std::uint64_t>(cuts * static_cast<double>(last - first)));
        double most = 0.0;
        for (std::size_t t = first; t < last; ++t) most = std::max(most, bounder.bound(corners_of(from, t)));
        return most;
    });
}

}  // namespace rhview
