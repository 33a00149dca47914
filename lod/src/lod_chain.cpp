// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/lod/lod_chain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "rhview/base/assert.h"
#include "rhview/base/build_progress.h"
#include "rhview/base/index_check.h"
#include "simplified_levels.h"
#include "surface_distance.h"

namespace rhview {
namespace {

// Distances below this share of the mesh's diagonal are not told apart: no camera that has the mesh in its
// picture could, and proving less would take most of the build.
constexpr double kErrorFloor = 2e-5;
// A level that is hardly better than the next one would be chosen for a narrow band of distances only.
constexpr float kWorthALevel = 0.9f;
// A fourth of a chain's time, about; the rest goes to measuring.
constexpr std::size_t kSimplifyingPart = 4;
// What a bound computed in double can be short of by rounding, with room to spare.
constexpr double kRoundingMargin = 1e-6;

/// The part of a mesh's positions that its triangles use: others may share the rest.
struct CompactMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> sources;  ///< the mesh's own number of each position
    Aabb bounds;
    bool finite = true;

    explicit CompactMesh(const LodMesh& mesh);
};

CompactMesh::CompactMesh(const LodMesh& mesh) {
    if (mesh.indices.empty()) return;
    constexpr std::uint32_t kUnused = ~0u;
    const auto [least, most] = std::ranges::minmax_element(mesh.indices);
    const std::uint32_t first = *least;
    std::vector<std::uint32_t> places(std::size_t{*most} - first + 1, kUnused);
    indices.reserve(mesh.indices.size());
    for (const std::uint32_t source : mesh.indices) {
        std::uint32_t& place = places[source - first];
        if (place == kUnused) {
            place = static_cast<std::uint32_t>(positions.size());
            positions.push_back(mesh.positions[source]);
            sources.push_back(source);
            bounds.grow(positions.back());
            const glm::vec3& p = positions.back();
            finite = finite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        }
        indices.push_back(place);
    }
}

/// The triangles of `indices` that have an area: the others draw nothing, and are no surface.
std::vector<std::uint32_t> triangles_with_area(std::span<const glm::vec3> positions,
                                               std::span<const std::uint32_t> indices) {
    std::vector<std::uint32_t> kept;
    kept.reserve(indices.size());
    for (std::size_t t = 0; t < indices.size(); t += 3) {
        const glm::dvec3 a = positions[indices[t]], b = positions[indices[t + 1]],
                         c = positions[indices[t + 2]];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        if (glm::dot(normal, normal) > 0.0)
            kept.insert(kept.end(), indices.begin() + static_cast<std::ptrdiff_t>(t),
                        indices.begin() + static_cast<std::ptrdiff_t>(t) + 3);
    }
    return kept;
}

/// Levels, finest first, without those that a coarser one is about as good as, and without what has no area.
std::vector<std::size_t> levels_worth_keeping(std::span<const float> errors) {
    std::vector<std::size_t> kept;
    float coarser = std::numeric_limits<float>::infinity();
    for (std::size_t i = errors.size(); i-- > 0;) {
        if (!(errors[i] < kWorthALevel * coarser)) continue;
        kept.push_back(i);
        coarser = errors[i];
    }
    std::ranges::reverse(kept);
    return kept;
}

/// Builds one chain, in as many tasks as there are levels.
class ChainBuilder {
  public:
    ChainBuilder(const LodMesh& mesh, const LodOptions& options, BuildProgress& progress)
        : mesh_(mesh), options_(options), progress_(progress) {}

    LodChain build();

  private:
    LodChain level_0(LodEnd end) const;
    LodChain chain_of(const SimplifiedLevels& simplified, std::span<const float> errors) const;
    std::vector<float> errors_of(std::span<const SimplifiedLevel> levels);
    float error_of(const SimplifiedLevel& level, const TriangleTree& surface) const;

    const LodMesh& mesh_;
    const LodOptions& options_;
    BuildProgress& progress_;
    std::size_t triangles_ = mesh_.indices.size() / 3;  ///< the steps of its progress
    CompactMesh compact_{mesh_};
    std::vector<std::uint32_t> surface_;
};

LodChain ChainBuilder::level_0(LodEnd end) const {
    LodChain chain;
    chain.levels.own().push_back({0, static_cast<std::uint32_t>(mesh_.indices.size()), 0.0f, 0});
    chain.vertex_count = mesh_.positions.size();
    chain.end = end;
    return chain;
}

LodChain ChainBuilder::build() {
    if (compact_.indices.size() <= 3 * std::size_t{options_.min_triangles})
        return level_0(LodEnd::FewTriangles);
    if (!compact_.finite) return level_0(LodEnd::NotFinite);
    surface_ = triangles_with_area(compact_.positions, compact_.indices);
    if (surface_.empty()) return level_0(LodEnd::NoArea);
    SimplifiedLevels simplified =
        simplify_to_levels(compact_.positions, compact_.indices, options_, progress_);
    progress_.advance(triangles_ / kSimplifyingPart);
    if (progress_.stopped()) return level_0(LodEnd::Smallest);
    return chain_of(simplified, errors_of(simplified.levels));
}

/// The two-sided bound, rounded up.
float ChainBuilder::error_of(const SimplifiedLevel& level, const TriangleTree& surface) const {
    const std::vector<std::uint32_t> indices = triangles_with_area(compact_.positions, level.indices);
    if (indices.empty() || progress_.stopped()) return std::numeric_limits<float>::infinity();
    const TriangleTree level_surface(compact_.positions, indices);
    const double diagonal = glm::length(glm::dvec3(compact_.bounds.extent()));
    const double floor = kErrorFloor * diagonal;
    const double of_mesh = one_sided_distance_bound({compact_.positions, surface_}, level_surface, floor);
    const double of_level =
        one_sided_distance_bound({compact_.positions, indices}, surface, std::max(floor, of_mesh));
    const double bound = std::max({of_mesh, of_level, floor}) * (1.0 + kRoundingMargin);
    return std::nextafter(static_cast<float>(bound), std::numeric_limits<float>::infinity());
}

std::vector<float> ChainBuilder::errors_of(std::span<const SimplifiedLevel> levels) {
    std::vector<float> errors(levels.size());
    if (levels.empty()) return errors;
    const TriangleTree surface(compact_.positions, surface_);
    tbb::parallel_for(std::size_t{0}, levels.size(),
                      [&](std::size_t i) { errors[i] = error_of(levels[i], surface); });
    return errors;
}

LodChain ChainBuilder::chain_of(const SimplifiedLevels& simplified, std::span<const float> errors) const {
    LodChain chain = level_0(simplified.end);
    std::vector<LodLevel>& levels = chain.levels.own();
    std::vector<std::uint32_t>& indices = chain.indices.own();
    for (const std::size_t i : levels_worth_keeping(errors)) {
        const SimplifiedLevel& level = simplified.levels[i];
        levels.push_back({static_cast<std::uint32_t>(indices.size()),
                          static_cast<std::uint32_t>(level.indices.size()), errors[i],
                          level.sloppy ? 1u : 0u});
        for (const std::uint32_t index : level.indices) indices.push_back(compact_.sources[index]);
    }
    return chain;
}

Error wrong_mesh(std::size_t mesh, const std::string& what) {
    return Error{"mesh " + std::to_string(mesh) + ": " + what};
}

Status check_mesh(const LodMesh& mesh, std::size_t number) {
    const std::size_t count = mesh.indices.size();
    if (count % 3 != 0)
        return wrong_mesh(number, "its index count " + std::to_string(count) +
                                      " is no multiple of three; give whole triangles");
    // The levels together have about as many as the mesh, at the least ratio four times as many.
    if (count > std::numeric_limits<std::uint32_t>::max() / 4)
        return wrong_mesh(number, "it has more than 2^30 indices; split it");
    if (!all_below(mesh.indices, mesh.positions.size()))
        return wrong_mesh(
            number, "an index is not below its " + std::to_string(mesh.positions.size()) + " positions");
    return success();
}

}  // namespace

std::string_view text_of(LodEnd end) {
    switch (end) {
        case LodEnd::Smallest:
            return "the last level is as small as was asked for";
        case LodEnd::FewTriangles:
            return "the mesh is small as it is";
        case LodEnd::NotFinite:
            return "a corner of the mesh is not finite";
        case LodEnd::NoArea:
            return "none of its triangles has an area";
        case LodEnd::NonManifold:
            return "edges of three triangles or more hold the rest in place";
        case LodEnd::Locked:
            return "borders, seams or its shape hold the rest in place";
    }
    return "";
}

Result<std::vector<LodChain>> build_lod_chains(std::span<const LodMesh> meshes, const LodOptions& options) {
    RHVIEW_ASSERT(options.ratio >= 0.1 && options.ratio <= 0.8);
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (Status status = check_mesh(meshes[i], i); !status) return status.error();
        triangles += meshes[i].indices.size() / 3;
    }
    BuildProgress progress(options.progress);
    progress.begin_phase(1.0, triangles);
    std::vector<LodChain> chains(meshes.size());
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t i) {
        if (!progress.stopped()) chains[i] = ChainBuilder(meshes[i], options, progress).build();
    });
    if (progress.stopped()) return BuildProgress::stopped_error();
    progress.begin_phase(0.0, 1);
    return chains;
}

}  // namespace rhview
