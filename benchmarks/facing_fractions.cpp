// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// How many of the back-facing triangles the normal order lets a viewer skip, with at most 1, 2, 3 or any
// number of ranges per part, against the exact count. Parts are runs of triangles along the octree's order;
// eyes are anywhere in the scene's box, and around it. Nothing is drawn, no frustum: all triangles count.
//
//   rhview_facing_fractions [scene ...]     named scenes or files; by default sphere, town and the real
//   scenes
//
// Writes a CSV to standard output. Counts only: it repeats exactly.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "rhview/rhoctree/facing.h"
#include "rhview/rhoctree/normal_clusters.h"
#include "rhview/rhoctree/rhoctree.h"
#include "rhview/scenes/import.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {
namespace {

constexpr std::array<std::size_t, 3> kPartTriangles{512, 4096, 32768};
constexpr std::size_t kEyes = 16;
constexpr std::uint32_t kMostClusters = std::max(kAxisClusters, kConeClusters);

/// Single-sided triangles in the octree's order, batch after batch.
struct Soup {
    std::string name;
    std::vector<std::vector<glm::vec3>> corners;  ///< by batch, three per triangle
    std::size_t triangles = 0;
    std::size_t two_sided = 0;
    Aabb bounds;
};

/// Indices that count a batch's corners.
std::vector<std::uint32_t> counting(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    for (std::size_t i = 0; i < count; ++i) indices[i] = static_cast<std::uint32_t>(i);
    return indices;
}

Soup soup_of(std::string name, std::span<const TriangleBatch> batches) {
    Soup soup;
    soup.name = std::move(name);
    const RhOctree octree = build_octree(batches, {64}).value();
    if (octree.nodes().empty()) return soup;
    soup.bounds = octree.node(NodeId{0}).bounds;
    for (const DrawRange& range : octree.ranges(NodeId{0})) {
        const std::span<const glm::vec3> positions = batches[static_cast<std::size_t>(range.batch)].positions;
        std::vector<glm::vec3>& corners = soup.corners.emplace_back();
        for (const std::uint32_t index : octree.indices().subspan(range.first_index, range.index_count))
            corners.push_back(positions[index]);
        soup.triangles += corners.size() / 3;
    }
    return soup;
}

/// A geodesic sphere of 327,680 triangles.
Soup sphere() {
    std::vector<glm::vec3> corners;
    const auto split = [&](const auto& self, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           int depth) -> void {
        if (depth == 0) {
            for (const glm::dvec3& corner : {a, b, c}) corners.emplace_back(corner);
            return;
        }
        const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
        self(self, a, ab, ca, depth - 1);
        self(self, b, bc, ab, depth - 1);
        self(self, c, ca, bc, depth - 1);
        self(self, ab, bc, ca, depth - 1);
    };
    // An icosahedron's faces are the triples of its corners that are neighbours of one another.
    std::vector<glm::dvec3> points;
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    for (const double one : {-1.0, 1.0})
        for (const double long_side : {-golden, golden})
            for (const glm::dvec3& point : {glm::dvec3(0, one, long_side), glm::dvec3(one, long_side, 0),
                                            glm::dvec3(long_side, 0, one)})
                points.push_back(glm::normalize(point));
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, b) > 0.4; };
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            for (std::size_t k = j + 1; k < points.size(); ++k) {
                const glm::dvec3 &a = points[i], &b = points[j], &c = points[k];
                if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
                const bool outward = glm::dot(glm::cross(b - a, c - a), a) > 0.0;
                split(split, a, outward ? b : c, outward ? c : b, 7);
            }
    const std::vector<std::uint32_t> indices = counting(corners.size());
    const TriangleBatch batch{MaterialId{0}, corners, indices};
    return soup_of("sphere", {&batch, 1});
}

Soup soup_of_scene(const std::string& name, const Scene& scene) {
    std::vector<TriangleBatch> batches;
    std::size_t two_sided = 0;
    for (const TriangleBatch& batch : scene.triangle_batches()) {
        if (scene.materials[static_cast<std::size_t>(batch.material)].two_sided)
            two_sided += batch.indices.size() / 3;
        else
            batches.push_back(batch);
    }
    Soup soup = soup_of(name, batches);
    soup.two_sided = two_sided;
    return soup;
}

/// One part's clusters for one number of ranges.
struct Part {
    std::uint32_t clusters = 0;
    std::array<FacingCone, kMostClusters> cones;
    std::array<std::uint32_t, kMostClusters> counts{};
};

Part sorted_part(std::span<const glm::vec3> corners, int max_ranges, ClusterScheme scheme) {
    Part part;
    part.clusters = cluster_count(scheme);
    std::array<std::vector<std::uint32_t>, kMostClusters> members;
    for (std::uint32_t i = 0; i < corners.size(); i += 3) {
        const glm::dvec3 normal = face_normal(corners[i], corners[i + 1], corners[i + 2]);
        members[cluster_of(scheme, normal, max_ranges)].insert(
            members[cluster_of(scheme, normal, max_ranges)].end(), {i, i + 1, i + 2});
    }
    for (std::uint32_t c = 0; c < part.clusters; ++c) {
        part.counts[c] = static_cast<std::uint32_t>(members[c].size());
        part.cones[c] = bound_facing(corners, members[c]);
    }
    return part;
}

std::uint64_t skipped(const Part& part, const Viewpoint& viewpoint, std::size_t max_ranges) {
    std::uint64_t skippable = 0, total = 0;
    for (std::uint32_t c = 0; c < part.clusters; ++c) {
        total += part.counts[c];
        if (part.counts[c] != 0 && faces_away(part.cones[c], viewpoint)) skippable |= std::uint64_t{1} << c;
    }
    std::array<ClusterRange, kMostClusters> ranges;
    const std::span<const std::uint32_t> counts = std::span(part.counts).first(part.clusters);
    return (total - cover_ranges(counts, skippable, std::span(ranges).first(max_ranges)).index_count) / 3;
}

std::uint64_t back_facing(const Soup& soup, const glm::dvec3& eye) {
    std::uint64_t count = 0;
    for (const std::vector<glm::vec3>& corners : soup.corners)
        for (std::size_t i = 0; i < corners.size(); i += 3)
            count += glm::dot(face_normal(corners[i], corners[i + 1], corners[i + 2]),
                              eye - glm::dvec3(corners[i])) <= 0.0;
    return count;
}

/// Positions in the box, or at 1.5 to 3 times its half diagonal from its centre.
std::vector<glm::dvec3> eyes(const Aabb& box, bool inside) {
    std::mt19937 random(7);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    const glm::dvec3 low(box.min), size = glm::dvec3(box.max) - low;
    std::vector<glm::dvec3> result;
    while (result.size() < kEyes) {
        const glm::dvec3 point(uniform(), uniform(), uniform());
        if (inside) {
            result.push_back(low + size * point);
            continue;
        }
        const glm::dvec3 direction = 2.0 * point - 1.0;
        const double length = glm::length(direction);
        if (length > 1.0 || length < 0.1) continue;
        result.push_back(low + 0.5 * size +
                         direction / length * (1.5 + 1.5 * uniform()) * 0.5 * glm::length(size));
    }
    return result;
}

/// Skipped triangles over all eyes, by the number of ranges: 1, 2, 3, any.
using Skips = std::array<std::uint64_t, 4>;

struct Totals {
    std::size_t parts = 0, axis_aligned = 0;
    std::array<Skips, 2> skips{};  ///< inside, outside
};

void add_part(Totals& totals, std::span<const glm::vec3> corners,
              const std::array<std::vector<glm::dvec3>, 2>& views) {
    const ClusterScheme scheme = choose_scheme(corners, counting(corners.size()));
    ++totals.parts;
    totals.axis_aligned += scheme == ClusterScheme::AxisAligned;
    for (int max_ranges = 1; max_ranges <= kMaxClusterRanges; ++max_ranges) {
        const Part part = sorted_part(corners, max_ranges, scheme);
        const auto ranges = static_cast<std::size_t>(max_ranges);
        for (std::size_t where = 0; where < 2; ++where) {
            Skips& skips = totals.skips[where];
            for (const glm::dvec3& eye : views[where]) {
                const Viewpoint viewpoint{Viewpoint::Kind::Point, eye};
                skips[ranges - 1] += skipped(part, viewpoint, ranges);
                if (max_ranges == 2) skips[3] += skipped(part, viewpoint, kMostClusters);
            }
        }
    }
}

void measure(const Soup& soup) {
    if (soup.triangles == 0) {
        std::fprintf(stderr, "%s: every material is two-sided, nothing to measure\n", soup.name.c_str());
        return;
    }
    const std::array<std::vector<glm::dvec3>, 2> views{eyes(soup.bounds, true), eyes(soup.bounds, false)};
    std::array<std::uint64_t, 2> back{};
    for (std::size_t where = 0; where < 2; ++where)
        for (const glm::dvec3& eye : views[where]) back[where] += back_facing(soup, eye);
    for (const std::size_t part_triangles : kPartTriangles) {
        Totals totals;
        for (const std::vector<glm::vec3>& corners : soup.corners)
            for (std::size_t first = 0; first < corners.size(); first += 3 * part_triangles)
                add_part(
                    totals,
                    std::span(corners).subspan(first, std::min(3 * part_triangles, corners.size() - first)),
                    views);
        for (std::size_t where = 0; where < 2; ++where) {
            const auto all = static_cast<double>(soup.triangles * kEyes),
                       exact = static_cast<double>(back[where]);
            const auto share = [&](std::size_t i) {
                return static_cast<double>(totals.skips[where][i]) / exact;
            };
            std::printf("%s,%zu,%zu,%zu,%zu,%zu,%s,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\n", soup.name.c_str(),
                        soup.triangles, soup.two_sided, part_triangles, totals.parts, totals.axis_aligned,
                        where == 0 ? "inside" : "outside", exact / all, share(0), share(1), share(2),
                        share(3), 1.0 - static_cast<double>(totals.skips[where][1]) / all);
        }
        std::fflush(stdout);
    }
}

void measure_named(const std::string& name) {
    if (name == "sphere") return measure(sphere());
    if (is_named_scene(name)) {
        const Result<SceneAndPath> scene = make_named_scene(name);
        if (scene) return measure(soup_of_scene(name, scene->scene));
        std::fprintf(stderr, "%s: %s\n", name.c_str(), scene.error().message.c_str());
        return;
    }
    const std::filesystem::path file(name);
    const Result<Scene> scene = import_scene(file);
    if (scene) return measure(soup_of_scene(file.filename().string(), *scene));
    std::fprintf(stderr, "%s: skipped: %s\n", name.c_str(), scene.error().message.c_str());
}

int run(int argc, char** argv) {
    std::vector<std::string> names(argv + 1, argv + argc);
    if (names.empty()) {
        names = {"sphere", "town"};
        for (const char* file : {"intel_castle.glb", "bsp_nexuiz_ons-reborn.glb", "stk_candela_city.glb",
                                 "rvm_huldra_wd1_psup.glb", "0ad_napata_reconstruction.glb"})
            names.push_back(std::string(RHVIEW_SHARED_SCENES_DIR) + "/" + file);
    }
    std::printf(
        "scene,triangles,two_sided_left_out,part_triangles,parts,axis_aligned_parts,eyes,back_facing,"
        "skipped_1,skipped_2,skipped_3,skipped_any,drawn_2\n");
    for (const std::string& name : names) measure_named(name);
    return 0;
}

}  // namespace
}  // namespace rhview

int main(int argc, char** argv) {
    return rhview::run(argc, argv);
}
