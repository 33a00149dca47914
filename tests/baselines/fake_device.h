// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rhview/base/triangle_batch.h"
#include "rhview/base/view.h"
#include "rhview/pipeline/occlusion_device.h"

namespace rhview {

/// A device without graphics that looks along -z, parallel, at the square ±kReach: one depth per pixel
/// centre, exact answers, after a chosen number of calls. Objects are drawn as the front of their boxes.
class FakeDevice final : public OcclusionDevice {
  public:
    static constexpr int kPixels = 96;
    static constexpr double kReach = 96.0;
    static View view() {
        View view;
        view.camera_from_world = look_along({0, 0, 1000}, {0, 0, -1}, {0, 1, 0});
        view.clip_from_camera = orthographic(2 * kReach, 2 * kReach, 1, 3000, view.clip_depth);
        return view;
    }

    /// `latency`: calls until an answer is there; taking it before is counted as a wait.
    explicit FakeDevice(std::uint32_t latency) : latency_(latency) {
        for (auto& row : depth_) row.fill(kFar);
    }

    void begin_frame(std::span<const TriangleBatch> batches, std::span<const std::uint32_t> indices,
                     std::span<const Aabb> objects) {
        batches_ = batches;
        indices_ = indices;
        objects_ = objects;
        for (auto& row : depth_) row.fill(kFar);
        drawn_indices_.assign(indices.size(), 0);
        drawn_objects_.assign(objects.size(), 0);
        calls_log_ = {};
    }

    void draw(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) override {
        paint(ranges, objects);
    }
    QueryHandle draw_and_ask(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) override {
        ++calls_log_.geometry_queries;
        return remember(paint(ranges, objects));
    }
    void ask(std::span<const BoxQuery> queries, std::span<const Aabb> boxes,
             std::vector<QueryHandle>& handles) override {
        ++clock_;
        ++calls_log_.box_batches;
        calls_log_.box_queries += queries.size();
        for (const BoxQuery& query : queries) {
            EXPECT_GT(query.box_count, 0u);
            bool seen = false;
            for (const Aabb& box : boxes.subspan(query.first_box, query.box_count))
                seen = visit_front(box, [](double& depth, double z) { return z >= depth - 1e-9; }) || seen;
            handles.push_back(remember(seen));
        }
        calls_log_.most_outstanding = std::max(calls_log_.most_outstanding, outstanding_);
    }
    bool has_answer(QueryHandle query) override {
        ++clock_;
        return queries_[index_of(query)].ready <= clock_;
    }
    bool take_answer(QueryHandle query) override {
        Asked& asked = queries_[index_of(query)];
        EXPECT_FALSE(asked.taken) << "an answer was taken twice";
        asked.taken = true;
        if (asked.ready > clock_) ++calls_log_.waits;
        clock_ = std::max(clock_, asked.ready);
        --outstanding_;
        return asked.seen;
    }

    /// What the calls since `begin_frame` did.
    struct Log {
        std::size_t draws = 0, box_queries = 0, box_batches = 0, geometry_queries = 0, waits = 0;
        std::size_t most_outstanding = 0;
    };
    [[nodiscard]] const Log& log() const { return calls_log_; }
    [[nodiscard]] bool drew_something_twice() const {
        const auto twice = [](std::uint8_t count) { return count > 1; };
        return std::ranges::any_of(drawn_indices_, twice) || std::ranges::any_of(drawn_objects_, twice);
    }
    [[nodiscard]] std::size_t drawn_triangles() const {
        return static_cast<std::size_t>(std::ranges::count(drawn_indices_, 1)) / 3;
    }
    [[nodiscard]] bool drew_object(std::size_t object) const { return drawn_objects_[object] > 0; }

    /// Pixels that drawing everything would change; draws it.
    std::size_t missing_pixels() {
        const auto before = depth_;
        std::uint32_t first = 0;
        for (std::uint32_t b = 0; b < batches_.size(); ++b) {
            const auto count = static_cast<std::uint32_t>(batches_[b].indices.size());
            paint_triangles({BatchId{b}, first, count});
            first += count;
        }
        for (const Aabb& box : objects_) visit_front(box, kNearest);
        std::size_t missing = 0;
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x) missing += depth_[y][x] != before[y][x] ? 1 : 0;
        return missing;
    }
    [[nodiscard]] std::size_t outstanding() const { return outstanding_; }

  private:
    static constexpr double kFar = -std::numeric_limits<double>::infinity();
    struct Asked {
        bool seen = false, taken = false;
        std::uint64_t ready = 0;
    };

    static double centre(int pixel) { return -kReach + (pixel + 0.5) * 2.0 * kReach / kPixels; }
    static bool keep_nearest(double& depth, double z) {
        const bool passes = z >= depth;
        depth = std::max(depth, z);
        return passes;
    }
    static constexpr auto kNearest = keep_nearest;

    QueryHandle remember(bool seen) {
        queries_.push_back({seen, false, clock_ + latency_});
        ++outstanding_;
        return QueryHandle{static_cast<std::uint32_t>(queries_.size() - 1)};
    }

    bool paint(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) {
        ++clock_;
        bool seen = false;
        for (const DrawRange& range : ranges) {
            ++calls_log_.draws;
            for (std::uint32_t i = 0; i < range.index_count; ++i) ++drawn_indices_[range.first_index + i];
            seen = paint_triangles(range) || seen;
        }
        for (const ObjectId object : objects) {
            ++calls_log_.draws;
            ++drawn_objects_[index_of(object)];
            seen = visit_front(objects_[index_of(object)], kNearest) || seen;
        }
        return seen;
    }

    /// `action(depth, z)` at every pixel whose centre the front covers; whether it said yes anywhere.
    template <class Action>
    bool visit_front(const Aabb& box, Action action) {
        bool any = false;
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x)
                if (centre(x) >= box.min.x && centre(x) <= box.max.x && centre(y) >= box.min.y &&
                    centre(y) <= box.max.y)
                    any = action(depth_[y][x], box.max.z) || any;
        return any;
    }

    bool paint_triangles(const DrawRange& range) {
        bool any = false;
        const std::span<const glm::vec3> positions = batches_[index_of(range.batch)].positions;
        for (std::uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3)
            any = paint_triangle(positions[indices_[i]], positions[indices_[i + 1]],
                                 positions[indices_[i + 2]]) ||
                  any;
        return any;
    }

    bool paint_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const auto cross = [](const glm::dvec3& p, const glm::dvec3& q, double x, double y) {
            return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
        };
        const double area = cross(a, b, c.x, c.y);
        if (area == 0.0) return false;
        const glm::dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        const auto pixel = [](double at) {
            return static_cast<int>(std::floor((at + kReach) * kPixels / (2 * kReach)));
        };
        bool any = false;
        for (int y = std::max(pixel(low.y), 0); y <= std::min(pixel(high.y), kPixels - 1); ++y)
            for (int x = std::max(pixel(low.x), 0); x <= std::min(pixel(high.x), kPixels - 1); ++x) {
                const double u = cross(b, c, centre(x), centre(y)) / area;
                const double v = cross(c, a, centre(x), centre(y)) / area;
                const double w = 1.0 - u - v;
                if (u >= 0 && v >= 0 && w >= 0)
                    any = keep_nearest(depth_[y][x], u * a.z + v * b.z + w * c.z) || any;
            }
        return any;
    }

    std::uint32_t latency_;
    std::uint64_t clock_ = 0;
    std::array<std::array<double, kPixels>, kPixels> depth_;
    std::span<const TriangleBatch> batches_;
    std::span<const std::uint32_t> indices_;
    std::span<const Aabb> objects_;
    std::vector<std::uint8_t> drawn_indices_, drawn_objects_;
    std::vector<Asked> queries_;
    std::size_t outstanding_ = 0;
    Log calls_log_;
};

}  // namespace rhview
