// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "rhview/base/result.h"

namespace rhview::cli {

/// Exit codes of the program.
inline constexpr int kDone = 0;
inline constexpr int kCheckFailed = 1;
inline constexpr int kBadInput = 2;

struct InfoOptions {
    std::string scene;
    std::optional<std::filesystem::path> json;
};

struct CalibrateOptions {
    std::string scene;  ///< empty: named scenes of several kinds
    std::string size = "1280x720";
    std::optional<std::filesystem::path> output;
    std::optional<std::filesystem::path> csv;
};

/// What becomes of meshes that the scene places repeatedly.
struct InstancesWanted {
    std::string policy = "auto";
    std::optional<double> budget_mib;  ///< of flattened placements; else the library's
};

struct WalkOptions {
    std::string scene;
    std::string method = "rhview";
    std::string mode = "exact";
    std::string occlusion = "auto";
    std::string hierarchy = "auto";
    std::string tune;
    std::string submission = "plain";
    std::string size = "1280x720";
    std::optional<std::filesystem::path> path;
    std::optional<std::filesystem::path> profile;
    std::string set;
    int frames = 120;
    int warmup = 8;
    int repeats = 1;
    std::optional<double> rate_hz;      ///< frames per second of the path; else all of it in `frames`
    int excerpts = 1;                   ///< of the path, with `rate_hz`
    std::optional<std::uint32_t> leaf;  ///< else the baked file's own, or the method's
    double replica_budget = 1.0;
    InstancesWanted instances;
    double lod_error_px = 1.0;
    std::string lod_policy = "error";
    std::optional<double> budget_ms;
    bool check = false;
    int check_every = 1;
    bool visible_set = false;
    std::uint32_t visible_pixels = 0;  ///< latent mode: what shows fewer is left out
    int image_error_every = 0;         ///< measure the picture's error in every so many frames; 0: in none
    int images_every = 30;
    std::optional<int> freeze_culling;
    std::optional<std::filesystem::path> json;
    std::optional<std::filesystem::path> csv;
    std::optional<std::filesystem::path> images;
};

inline constexpr const char* kDefaultMethods = "frustum,octree,nested-grid,chc++,rhview-seed,rhview";

struct CompareOptions {
    WalkOptions walk;  ///< what all methods have in common
    /// Absent: a rival of each kind, or with `pareto` none but those that it adds.
    std::optional<std::string> methods;
    bool pareto = false;  ///< rhview with what it may give up, against the picture's error
    std::string order = "frame";
    std::optional<std::filesystem::path> report;
    std::string command;  ///< as it was typed, for the report
    std::filesystem::path program;
};

struct ViewOptions {
    WalkOptions walk;
    std::optional<std::filesystem::path> script;
    std::filesystem::path folder = ".";  ///< where screenshots and recordings go
};

struct BakeOptions {
    std::string scene;
    std::filesystem::path output;
    std::string method = "rhview";
    std::optional<std::uint32_t> leaf;
    double replica_budget = 1.0;
    InstancesWanted instances;
    std::optional<std::filesystem::path> profile;
    std::string set;
    std::optional<std::filesystem::path> path;
};

/// Each verb prints its answer and returns the exit code, or an error that ends the program with `kBadInput`.
Result<int> run_scenes();
Result<int> run_info(const InfoOptions& options);
Result<int> run_calibrate(const CalibrateOptions& options);
Result<int> run_walk(const WalkOptions& options);
Result<int> run_compare(const CompareOptions& options);
Result<int> run_bake(const BakeOptions& options);
/// An error in a build without the viewer.
Result<int> run_view(const ViewOptions& options);

}  // namespace rhview::cli
