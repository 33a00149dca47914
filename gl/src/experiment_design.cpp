// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/experiment_design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "rhview/frustum/frustum.h"

namespace rhview::gl {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr std::size_t kMostBlocks = 20000;
constexpr std::uint32_t kSmallestBlock = 96;
/// Every so many indices bound a block: what is chosen need not be exact, and all would take a second.
constexpr std::uint32_t kSampled = 7;
constexpr double kFewestIndices = 1000.0;
constexpr double kNoLimit = 1e18;
constexpr std::size_t kMostRepeats = 1000;  ///< of a small scene on a fast machine
constexpr std::size_t kIndexLevels = 7;
constexpr std::size_t kDrawLevels = 5;
constexpr std::array<std::size_t, 4> kQueryLevels{30, 1000, 5, 200};

/// Consecutive indices of one batch, and the box of some of them.
struct Block {
    DrawRange range;
    Aabb bounds;
};

/// What the camera sees of what is drawn.
enum class Seen {
    Everything,  ///< all that is in the frustum, as a culled frame does: surfaces hide one another
    Inside,      ///< some of it
    Mixed,       ///< whatever comes
    Outside,     ///< nothing
};
constexpr std::array kSeen{Seen::Inside, Seen::Everything, Seen::Mixed, Seen::Outside, Seen::Everything};

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double operator()(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) + 0.5) / 4294967296.0;
    }
    std::size_t below(std::size_t count) {
        return std::min(count - 1, static_cast<std::size_t>((*this)(0.0, static_cast<double>(count))));
    }

  private:
    std::mt19937 engine_;
};

/// Level `level` of `levels`, evenly spaced in the logarithm.
double log_level(double low, double high, std::size_t level, std::size_t levels) {
    const double share = static_cast<double>(level) / static_cast<double>(levels - 1);
    return low * std::pow(std::max(high, low) / low, share);
}

std::vector<Block> cut_blocks(const Scene& scene, std::span<const std::uint32_t> static_indices) {
    std::size_t total = 0;
    for (const SceneBatch& batch : scene.batches) total += batch.indices.size();
    const auto size =
        std::max<std::uint32_t>(kSmallestBlock, 3 * static_cast<std::uint32_t>(total / 3 / kMostBlocks + 1));
    std::vector<Block> blocks;
    std::uint32_t first_of_batch = 0;
    for (std::uint32_t b = 0; b < scene.batches.size(); ++b) {
        const SceneBatch& batch = scene.batches[b];
        const auto count = static_cast<std::uint32_t>(batch.indices.size());
        const std::span<const std::uint32_t> indices = static_indices.empty()
                                                           ? std::span<const std::uint32_t>(batch.indices)
                                                           : static_indices.subspan(first_of_batch, count);
        const std::span<const glm::vec3> positions = scene.pools[batch.pool].positions;
        for (std::uint32_t first = 0; first < count; first += size) {
            Block block{{BatchId{b}, first_of_batch + first, std::min(size, count - first)}, {}};
            for (std::uint32_t i = 0; i < block.range.index_count; i += kSampled)
                block.bounds.grow(positions[indices[first + i]]);
            blocks.push_back(block);
        }
        first_of_batch += count;
    }
    return blocks;
}

class Designer {
  public:
    Designer(const Scene& scene, std::vector<Block> blocks, const DesignOptions& options)
        : scene_(scene),
          blocks_(std::move(blocks)),
          options_(options),
          random_(options.seed),
          bounds_(scene.bounds()) {
        for (std::size_t i = 0; i < scene.batches.size(); ++i)
            if (scene.batches[i].indices.size() > scene.batches[largest_batch_].indices.size())
                largest_batch_ = static_cast<std::uint32_t>(i);
    }

    ExperimentFrame frame(std::size_t number) {
        // Strides without a common factor: every pair of levels meets.
        const double jitter = std::exp2(random_(-0.4, 0.4));
        const double indices =
            jitter * log_level(kFewestIndices, options_.most_indices, number % kIndexLevels, kIndexLevels);
        const double draws =
            log_level(1.0, options_.most_draw_calls, (number / 2) % kDrawLevels, kDrawLevels);
        Seen seen = kSeen[(number / 3) % kSeen.size()];
        if (seen == Seen::Everything && whole_view_indices_ > options_.most_whole_view_indices)
            seen = Seen::Inside;
        const bool one_material = seen != Seen::Everything && number % 3 == 0;

        ExperimentFrame result;
        result.view = seen == Seen::Outside ? view_away() : view_towards();
        if (options_.multi_draw && number % 4 == 1) result.submission = Submission::MultiDraw;
        double budget = seen == Seen::Everything ? kNoLimit : indices;
        if (scene_.object_count() > 0 && (blocks_.empty() || number % 3 == 1))
            budget -= add_objects(indices, result.plan);
        if (!blocks_.empty()) {
            result.plan.opaque = choose_blocks(budget, seen, one_material, result.view);
            if (seen == Seen::Everything)
                for (const DrawRange& range : result.plan.opaque)
                    whole_view_indices_ += static_cast<double>(range.index_count);
            cut(result.plan.opaque, draws);
        }
        if (options_.queries && !blocks_.empty() && number % 4 == 2) add_queries(number / 4, result);
        return result;
    }

  private:
    [[nodiscard]] View looking(const glm::dvec3& eye, const glm::dvec3& forward) const {
        View view;
        view.clip_depth = options_.clip_depth;
        view.camera_from_world = look_along(eye, forward, {0.0, 1.0, 0.0});
        view.clip_from_camera = perspective(options_.fov_y_deg * kPi / 180.0, options_.aspect,
                                            options_.near_m, options_.far_m, options_.clip_depth);
        return view;
    }

    glm::dvec3 point_in_bounds(double margin) {
        const glm::dvec3 extent(bounds_.extent());
        const glm::dvec3 low = scene_.origin + glm::dvec3(bounds_.min);
        // Cubed: eyes are near the ground more often than above the roofs.
        const double height = random_(0.05, 1.0);
        return {low.x + extent.x * random_(-margin, 1.0 + margin),
                low.y + 1.2 * extent.y * height * height * height,
                low.z + extent.z * random_(-margin, 1.0 + margin)};
    }

    View view_towards() {
        const glm::dvec3 eye = point_in_bounds(0.1);
        glm::dvec3 forward = point_in_bounds(-0.2) - eye;
        forward.y = std::clamp(forward.y, -0.7 * std::hypot(forward.x, forward.z), 0.2 * std::abs(forward.x));
        if (std::hypot(forward.x, forward.z) < 1e-9) forward = {0.0, 0.0, -1.0};
        return looking(eye, forward);
    }

    /// From beside the scene, away from it.
    View view_away() {
        const glm::dvec3 extent(bounds_.extent());
        const glm::dvec3 centre = scene_.origin + glm::dvec3(bounds_.centre());
        const double angle = random_(0.0, 2.0 * kPi);
        const glm::dvec3 forward(std::cos(angle), 0.0, std::sin(angle));
        return looking(centre + forward * (glm::length(extent) + options_.near_m), forward);
    }

    /// Consecutive objects from a random one on; the indices they have.
    double add_objects(double budget, FramePlan& plan) {
        const std::size_t count = scene_.object_count();
        const std::size_t first = random_.below(count);
        double added = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const auto id = static_cast<std::uint32_t>((first + i) % count);
            const SceneMesh& mesh = scene_.meshes[index_of(scene_.object_mesh(ObjectId{id}))];
            const auto indices = static_cast<double>(mesh.indices.size());
            if (added + indices > budget && !(plan.objects.empty() && blocks_.empty())) break;
            added += indices;
            plan.objects.push_back(ObjectId{id});
        }
        return added;
    }

    [[nodiscard]] bool is_wanted(const Block& block, Seen seen, bool one_material,
                                 const Frustum& frustum) const {
        if (one_material && index_of(block.range.batch) != largest_batch_) return false;
        if (seen == Seen::Mixed || seen == Seen::Outside) return true;
        PlaneMask mask = frustum.mask;
        return classify(frustum, block.bounds, mask) != Containment::Outside;
    }

    /// Consecutive wanted blocks from a random place on, repeated where the scene has too few; by batch.
    std::vector<DrawRange> choose_blocks(double budget, Seen seen, bool one_material, const View& view) {
        const Frustum frustum = make_frustum(view, scene_.origin);
        std::vector<DrawRange> wanted;
        for (const Block& block : blocks_)
            if (is_wanted(block, seen, one_material, frustum)) wanted.push_back(block.range);
        std::vector<DrawRange> chosen;
        if (wanted.empty()) return chosen;
        const std::size_t start = random_.below(wanted.size());
        const std::size_t most = seen == Seen::Everything ? wanted.size() : wanted.size() * kMostRepeats;
        for (std::size_t i = 0; budget > 0.0 && i < most; ++i) {
            DrawRange range = wanted[(start + i) % wanted.size()];
            if (static_cast<double>(range.index_count) > budget)
                range.index_count = 3 * static_cast<std::uint32_t>(budget / 3.0 + 1.0);
            budget -= static_cast<double>(range.index_count);
            chosen.push_back(range);
        }
        std::ranges::stable_sort(chosen, {}, &DrawRange::batch);
        return chosen;
    }

    /// Joins what touches, then cuts into about `draws` calls of equal size.
    static void cut(std::vector<DrawRange>& ranges, double draws) {
        std::vector<DrawRange> joined;
        double total = 0.0;
        for (const DrawRange& range : ranges) {
            total += static_cast<double>(range.index_count);
            if (!joined.empty() && joined.back().batch == range.batch &&
                joined.back().first_index + joined.back().index_count == range.first_index)
                joined.back().index_count += range.index_count;
            else
                joined.push_back(range);
        }
        const auto size = 3 * static_cast<std::uint32_t>(std::max(1.0, std::ceil(total / (3.0 * draws))));
        ranges.clear();
        for (DrawRange rest : joined) {
            while (rest.index_count > 0) {
                const std::uint32_t count = std::min(size, rest.index_count);
                ranges.push_back({rest.batch, rest.first_index, count});
                rest.first_index += count;
                rest.index_count -= count;
            }
        }
    }

    void add_queries(std::size_t number, ExperimentFrame& frame) {
        for (std::size_t i = 0; i < kQueryLevels[number % kQueryLevels.size()]; ++i)
            frame.queried_boxes.push_back(blocks_[random_.below(blocks_.size())].bounds);
    }

    const Scene& scene_;
    std::vector<Block> blocks_;
    const DesignOptions& options_;
    Random random_;
    Aabb bounds_;
    std::uint32_t largest_batch_ = 0;
    double whole_view_indices_ = 0.0;  ///< of the frames so far
};

}  // namespace

std::vector<ExperimentFrame> design_experiment(const Scene& scene,
                                               std::span<const std::uint32_t> static_indices,
                                               const DesignOptions& options) {
    Designer designer(scene, cut_blocks(scene, static_indices), options);
    std::vector<ExperimentFrame> frames;
    for (int i = 0; i < options.frames; ++i) frames.push_back(designer.frame(static_cast<std::size_t>(i)));
    return frames;
}

}  // namespace rhview::gl
