// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A random scene, camera path, profile and device as a few numbers: made from a seed, written to a file,
/// read back, and made simpler.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rhview {

enum class PropertyMode : std::uint32_t { NoQueries, Exact, Latent };

struct PropertyCase {
    std::uint32_t seed = 1;  ///< of the triangles and the path
    std::uint32_t triangles = 300;
    std::uint32_t batches = 1;  ///< the third is two-sided
    std::uint32_t walls = 0;    ///< large quads that hide what is behind them
    std::uint32_t copies = 0;   ///< triangles that stand in the same place as another
    std::uint32_t slivers = 0;  ///< triangles without area, or nearly
    std::uint32_t frames = 1;
    std::uint32_t stand = 1;   ///< frames that the camera stays in a place
    std::uint32_t leaf = 8;    ///< `OctreeOptions::max_leaf_triangles`
    std::uint32_t record = 0;  ///< `OctreeOptions::min_record_indices`
    std::uint32_t depth = 0;   ///< `ClipDepth`
    std::uint32_t mode = 0;    ///< `PropertyMode`
    std::uint32_t orthographic = 0;
    std::uint32_t latency = 1;  ///< frames
    std::uint32_t spread = 0;   ///< frames
    double replicas = 0.0;      ///< `OctreeOptions::replica_budget`
    double scale = 1.0;         ///< metres per unit of the scene
    double origin = 0.0;        ///< of the scene in the world, on every axis, in units of the scene
    double fov = 1.0;           ///< radians
    double draw_ns = 60.0;      ///< for an `index_ns` of 1
    double call_ns = 0.0;
    double query_ns = 100.0;  ///< of a box pass; a hardware query takes thrice as much
    double lost = 0.0;        ///< part of the answers
    double duplicated = 0.0;

    friend bool operator==(const PropertyCase&, const PropertyCase&) = default;
};

PropertyCase random_property_case(std::uint32_t seed);
/// A line for each number: its name and value.
std::string text_of(const PropertyCase& property);
/// Nothing if a line is not one that `text_of` writes.
std::optional<PropertyCase> read_property_case(const std::string& text);
/// Cases that are simpler in one respect each, the boldest first.
std::vector<PropertyCase> simpler(const PropertyCase& property);

}  // namespace rhview
