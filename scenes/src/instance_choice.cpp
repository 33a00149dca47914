// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "rhview/scenes/static_instances.h"

namespace rhview {
namespace {

// Means of five scenes' walks (README.md: town, indoor, plant, castle, Candela), where `frustum` draws whole
// objects as instances are drawn.
// Share of all indices in the frustum: 0.30, 0.30, 0.61, 0.51, 0.62.
constexpr double kShareInView = 0.5;
// Indices of `rhview` to those of `frustum`: 0.56, 0.75, 0.90, 0.77, 0.63.
constexpr double kIndexShare = 0.72;
// Those of `rhview-seed`, without normal order, which two-sided materials can't have: 0.97, 1.18, 1.07, 0.99,
// 0.99. An octree's cells cut objects, and leaves reach out of the frustum as objects do.
constexpr double kIndexShareTwoSided = 1.04;
// Calls of `rhview` cost 2 to 11 % of what its indices do where a call is worth 60 indices (README.md), 7 to
// 16 % where it is worth 1,000 to 50,000 (docs/draw-list.md, town).
constexpr double kDrawShare = 0.1;
// Planning of `frustum`, an object.
constexpr double kBoxNs = 15.0;

double indices_ns(const RepeatedMesh& mesh, const InstanceCosts& costs) {
    return 3.0 * static_cast<double>(mesh.triangles) * costs.index_ns;
}

struct Candidate {
    MeshId mesh{};
    double saved_ns = 0.0;
    std::uint64_t bytes = 0;

    [[nodiscard]] double worth() const { return saved_ns / static_cast<double>(bytes); }
};

}  // namespace

double kept_ns(const RepeatedMesh& mesh, const InstanceCosts& costs) {
    const double drawn = costs.draw_ns + indices_ns(mesh, costs);
    return static_cast<double>(mesh.placements) * (kBoxNs + kShareInView * drawn);
}

double flattened_ns(const RepeatedMesh& mesh, const InstanceCosts& costs) {
    const double all = indices_ns(mesh, costs);
    const double drawn = (mesh.two_sided ? kIndexShareTwoSided : kIndexShare) * all +
                         std::min(costs.draw_ns, kDrawShare * all);
    return static_cast<double>(mesh.placements) * kShareInView * drawn;
}

std::vector<MeshId> choose_flattened(std::span<const RepeatedMesh> meshes, const InstanceCosts& costs,
                                     std::uint64_t budget_bytes) {
    std::vector<Candidate> candidates;
    for (const RepeatedMesh& mesh : meshes) {
        const double saved = kept_ns(mesh, costs) - flattened_ns(mesh, costs);
        if (saved > 0.0) candidates.push_back({mesh.mesh, saved, mesh.flattened_bytes()});
    }
    std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::worth);
    std::vector<MeshId> chosen;
    for (const Candidate& candidate : candidates) {
        if (candidate.bytes > budget_bytes) continue;
        budget_bytes -= candidate.bytes;
        chosen.push_back(candidate.mesh);
    }
    std::ranges::sort(chosen);
    return chosen;
}

}  // namespace rhview
