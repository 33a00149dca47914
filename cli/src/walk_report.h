// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rhview/gl/image_difference.h"
#include "rhview/scenes/scene.h"
#include "rhview/timing_model/profile.h"
#include "statistics.h"

namespace rhview::cli {

/// What occlusion culling did in one frame.
struct OcclusionRecord {
    std::uint64_t candidates = 0;  ///< nodes and objects in the frustum that were decided about
    std::uint64_t boxes = 0;       ///< asked with
    std::uint64_t hidden = 0;      ///< queries whose answer was that nothing is seen
    std::uint64_t box_pass_queries = 0;
    std::uint64_t conditional_draws = 0;   ///< calls
    std::uint64_t conditional_ranges = 0;  ///< in those
    std::uint64_t executed_ranges = 0;     ///< of those, by the answers
    std::uint64_t skipped_indices = 0;     ///< of the others
    std::uint64_t waits = 0;               ///< for answers
    double query_ms = 0.0;                 ///< what asking costs by the model
    double exploration_ms = 0.0;
    double saved_ms = 0.0;
};

/// What was said of a frame's budget before it was drawn.
struct BudgetRecord {
    double predicted_ms = 0.0;
    double margin = 1.0;  ///< by which predictions are reckoned to be too low
    bool can_be_met = false;
};

/// What was counted and measured in one frame; absent is what was not measured.
struct FrameRecord {
    int frame = 0;
    Work work;
    std::uint64_t nodes_visited = 0;
    std::uint64_t visible_objects = 0;    ///< dynamic ones
    std::uint64_t visible_instances = 0;  ///< static ones
    std::uint64_t object_draws = 0;       ///< calls that drew objects at once
    std::uint64_t mesh_levels = 0;        ///< meshes, each at a level and mirrored or not, in those
    double cull_ms = 0.0;
    double frame_ms = 0.0;
    std::optional<double> gpu_ms;
    std::optional<double> predicted_ms;
    std::optional<double> running_predicted_ms;  ///< with constants that follow the frames before
    std::optional<OcclusionRecord> occlusion;
    double lod_error_px = 0.0;  ///< the largest of an object that was drawn; infinite where nothing bounds it
    std::optional<BudgetRecord> budget;
    std::optional<std::uint64_t> visible_set_indices;  ///< of the leaves that show a pixel
    std::optional<std::uint64_t> missing_pixels;
    std::optional<std::uint64_t> late_items;         ///< leaves and objects that lack a pixel; latent mode
    std::optional<gl::ImageDifference> image_error;  ///< from everything at full detail
};

/// The picture's error over the frames in which it was measured.
struct ImageErrorSummary {
    int frames = 0;
    std::uint64_t missing_pixels = 0;
    gl::DepthDifference depth;  ///< the mean of means, the greatest of all
    double colour_mse = 0.0;    ///< mean
    std::optional<Statistics> ssim;
    double least_ssim = 1.0;
};

/// V + 8000·N: a frame's price, in indices, where a draw call costs as much as 8,000 of them.
double modelled_indices(const FrameRecord& frame);

/// One method along one path: the run of `rhview.walk/1`.
struct WalkReport {
    struct {
        std::string name;
        std::uint64_t static_triangles = 0;
        std::uint64_t dynamic_objects = 0;
        std::uint64_t dynamic_triangles = 0;
        std::uint64_t materials = 0;
        std::uint64_t batches = 0;
        std::uint64_t static_instances = 0;
        std::uint64_t instance_triangles = 0;
        std::uint64_t object_groups = 0;  ///< of objects that can share a call
    } scene;
    struct {
        std::string renderer;
        std::string version;
        std::string timer;
    } device;
    struct {
        std::optional<double> ms;
        std::optional<double> load_ms;  ///< of a baked file, which is not built
        std::optional<std::uint64_t> nodes;
        std::optional<std::uint64_t> leaves;
        std::optional<std::uint64_t> replicas;
        InstancingReport instancing;
        std::optional<double> settle_ms;  ///< to choose and flatten instances; of a baked file, none
        std::string hierarchy;            ///< "octree", "bvh" or "grid"; empty: none
        std::uint64_t replica_bytes = 0;
        std::uint64_t index_bytes = 0;
        std::uint64_t vertex_bytes = 0;
    } build;
    struct Profile {
        TimingProfile constants;
        std::string source;  ///< "file", "quick" or "set"
        std::string told;
    };
    struct {
        double error_bound_px = 0.0;
        std::string policy = "error";
        std::optional<double> budget_ms;
        std::optional<double> build_ms;  ///< of chains; absent: from a baked file, or none
        std::uint64_t levels = 0;        ///< of all chains, the meshes themselves not counted
        std::uint64_t index_bytes = 0;   ///< of those
    } lod;
    std::optional<Profile> profile;
    std::string why_no_profile;
    std::string occlusion;                  ///< "auto", "hardware", "boxes" or "off"
    std::optional<QueryCosts> query_costs;  ///< what was asked was priced by
    std::string why_no_occlusion;           ///< where it was wanted and could not be
    bool in_steps = false;                  ///< drew and asked in turns: nothing was predicted
    std::uint64_t blocking_reads = 0;       ///< of answers, in the whole walk
    std::uint64_t lost_queries = 0;
    /// Frames for which leaves and objects lacked a pixel, once each time that one did; absent where not
    /// every frame of latent mode was checked.
    std::optional<std::vector<double>> reveal_frames;
    std::string method;
    std::string mode;
    std::uint32_t visible_pixels = 0;  ///< below which latent mode leaves out what it saw
    std::string submission;
    std::optional<std::uint32_t> leaf;
    std::optional<double> rate_hz;  ///< absent: the frames are spread over all of the path
    int excerpts = 1;
    int width = 0;
    int height = 0;
    std::vector<FrameRecord> frames;
    std::uint64_t plan_hash = 0;

    [[nodiscard]] bool has_occlusion() const;
    [[nodiscard]] int checked_frames() const;
    /// Frames that can hold the budget, by the model, and those of them that did.
    [[nodiscard]] int frames_within_reach() const;
    [[nodiscard]] int frames_within_budget() const;
    [[nodiscard]] std::uint64_t missing_pixels() const;
    /// Absent where no frame's was measured.
    [[nodiscard]] std::optional<ImageErrorSummary> image_error() const;
};

std::string to_json(const WalkReport& report);
std::string to_csv(const WalkReport& report);
/// What became of instances, for people; empty where the scene places no mesh twice.
std::string instancing_text(const InstancingReport& report);
/// For people.
std::string to_table(const WalkReport& report);

}  // namespace rhview::cli
