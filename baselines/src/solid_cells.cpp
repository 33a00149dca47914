// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/solid_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include "closed_surfaces.h"

namespace rhview {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

/// Half a cell and what rounding may move, cells.
constexpr double kHalfCell = 0.5 + 1e-4;

/// In cell coordinates. Source: Akenine-Möller 2001, "Fast 3D triangle-box overlap testing".
bool touches(const Triangle& triangle, const glm::ivec3& cell) {
    const glm::dvec3 centre = glm::dvec3(cell) + 0.5;
    const Triangle t{triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
    const auto separates = [&](const glm::dvec3& axis) {
        const double a = glm::dot(axis, t[0]), b = glm::dot(axis, t[1]), c = glm::dot(axis, t[2]);
        const double reach = kHalfCell * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
        return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
    };
    const Triangle edges{t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    if (separates(glm::cross(edges[0], edges[1]))) return false;
    for (const glm::dvec3& e : edges)
        if (separates({0.0, -e.z, e.y}) || separates({e.z, 0.0, -e.x}) || separates({-e.y, e.x, 0.0}))
            return false;
    return true;
}

/// Where a line along x, through the centres of a column of cells, crosses a surface.
struct Crossing {
    std::uint32_t column = 0;
    std::uint32_t surface = 0;
    double x = 0.0;
    std::int32_t winding = 0;  ///< +1: entered with growing x
};

struct Point2 {
    double y = 0.0, z = 0.0;
};

/// Whether the edge passes the point on the side of greater y, where it spans z half-open. The ends are put
/// in order first: both triangles of an edge get the same answer, so that each point lies in exactly one of
/// those that tile a surface's projection.
bool passes(Point2 a, Point2 b, const Point2& p) {
    if ((a.z <= p.z) == (b.z <= p.z)) return false;
    if (a.z > b.z) std::swap(a, b);
    return (b.y - a.y) * (p.z - a.z) > (p.y - a.y) * (b.z - a.z);
}

/// Whether the line along x through `p` runs through the triangle.
bool line_meets(const Triangle& t, const Point2& p) {
    bool inside = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 &a = t[k], &b = t[(k + 1) % 3];
        inside ^= passes({a.y, a.z}, {b.y, b.z}, p);
    }
    return inside;
}

double line_x(const Triangle& t, const glm::dvec3& normal, const Point2& p) {
    return t[0].x - (normal.y * (p.y - t[0].y) + normal.z * (p.z - t[0].z)) / normal.x;
}

void append_crossings(const Triangle& t, std::uint32_t surface, const CellGrid& grid,
                      std::vector<Crossing>& crossings) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (normal.x == 0.0) return;
    const glm::dvec3 low = glm::min(glm::min(t[0], t[1]), t[2]), high = glm::max(glm::max(t[0], t[1]), t[2]);
    const glm::ivec3 cells = grid.cells();
    const auto first = [](double v) { return std::max(0, static_cast<int>(std::floor(v - 0.5))); };
    const auto last = [](double v, int n) { return std::min(n - 1, static_cast<int>(std::ceil(v - 0.5))); };
    for (int z = first(low.z); z <= last(high.z, cells.z); ++z)
        for (int y = first(low.y); y <= last(high.y, cells.y); ++y) {
            const Point2 p{y + 0.5, z + 0.5};
            if (line_meets(t, p))
                crossings.push_back({static_cast<std::uint32_t>(z * cells.y + y), surface,
                                     line_x(t, normal, p), normal.x < 0.0 ? 1 : -1});
        }
}

/// Cells that a closed surface touches, in order.
bool is_touched(const std::vector<std::uint64_t>& touched, std::uint32_t cell, std::uint32_t surface) {
    return std::binary_search(touched.begin(), touched.end(), std::uint64_t{cell} << 32 | surface);
}

/// The opaque cells of one column and surface. A winding that does not return to 0 proves nothing.
void append_inside(std::span<const Crossing> crossings, const CellGrid& grid,
                   const std::vector<std::uint64_t>& touched, std::vector<OpaqueCell>& opaque) {
    const std::size_t kept = opaque.size();
    const std::uint32_t column = crossings[0].column, surface = crossings[0].surface;
    const auto y_cells = static_cast<std::uint32_t>(grid.cells().y);
    int winding = 0;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        winding += crossings[i].winding;
        if (winding <= 0 || i + 1 == crossings.size()) continue;
        const int first = std::max(0, static_cast<int>(std::ceil(crossings[i].x - 0.5)));
        const int end = std::min(grid.cells().x, static_cast<int>(std::ceil(crossings[i + 1].x - 0.5)));
        for (int x = first; x < end; ++x) {
            const auto cell = static_cast<std::uint32_t>(
                grid.index({x, static_cast<int>(column % y_cells), static_cast<int>(column / y_cells)}));
            if (!is_touched(touched, cell, surface)) opaque.push_back({cell, surface});
        }
    }
    if (winding != 0) opaque.resize(kept);
}

std::vector<OpaqueCell> find_inside(const CellGrid& grid, std::vector<Crossing>& crossings,
                                    const std::vector<std::uint64_t>& touched) {
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return std::tie(a.column, a.surface, a.x, a.winding) < std::tie(b.column, b.surface, b.x, b.winding);
    });
    std::vector<OpaqueCell> opaque;
    for (std::size_t first = 0, end = 0; first < crossings.size(); first = end) {
        while (end < crossings.size() && crossings[end].column == crossings[first].column &&
               crossings[end].surface == crossings[first].surface)
            ++end;
        append_inside({crossings.data() + first, end - first}, grid, touched, opaque);
    }
    return opaque;
}

struct Gathered {
    std::vector<Corners> corners;
    std::vector<bool> joins;
    float lowest_y = std::numeric_limits<float>::infinity();
};

Gathered gather(std::span<const TriangleBatch> batches, const std::vector<bool>& occludes) {
    Gathered result;
    for (std::size_t b = 0; b < batches.size(); ++b)
        for (std::size_t i = 0; i + 2 < batches[b].indices.size(); i += 3) {
            Corners corners;
            for (std::size_t k = 0; k < 3; ++k) corners[k] = batches[b].positions[batches[b].indices[i + k]];
            for (const glm::vec3& c : corners) result.lowest_y = std::min(result.lowest_y, c.y);
            result.corners.push_back(corners);
            result.joins.push_back(occludes[b]);
        }
    return result;
}

Triangle in_cells(const Corners& corners, const CellGrid& grid) {
    return {grid.to_cells(corners[0]), grid.to_cells(corners[1]), grid.to_cells(corners[2])};
}

template <class Use>
void for_each_touched(const Corners& corners, const CellGrid& grid, Use&& use) {
    Aabb box;
    for (const glm::vec3& corner : corners) box.grow(corner);
    const CellBox cells = grid.clipped(grid.touched(box));
    const Triangle triangle = in_cells(corners, grid);
    const bool single = cells.min == cells.max;
    for_each_cell(cells, [&](const glm::ivec3& cell) {
        if (single || touches(triangle, cell)) use(static_cast<std::uint32_t>(grid.index(cell)));
    });
}

}  // namespace

CellLists make_cell_lists(std::size_t cell_count, std::span<const CellEntry> entries) {
    CellLists lists;
    lists.first.assign(cell_count + 1, 0);
    for (const CellEntry& e : entries) ++lists.first[e.cell + 1];
    for (std::size_t c = 0; c < cell_count; ++c) lists.first[c + 1] += lists.first[c];
    lists.entries.resize(entries.size());
    std::vector<std::uint32_t> next(lists.first.begin(), lists.first.end() - 1);
    for (const CellEntry& e : entries) lists.entries[next[e.cell]++] = e.entry;
    return lists;
}

SolidCells find_solid_cells(const CellGrid& grid, std::span<const TriangleBatch> batches,
                            const std::vector<bool>& occludes) {
    const Gathered all = gather(batches, occludes);
    ClosedSurfaces surfaces = find_closed_surfaces(all.corners, all.joins, all.lowest_y);
    std::vector<CellEntry> entries;
    std::vector<std::uint64_t> touched;
    std::vector<Crossing> crossings;
    for (std::uint32_t t = 0; t < all.corners.size(); ++t) {
        const std::uint32_t surface = surfaces.surface_of[t];
        for_each_touched(all.corners[t], grid, [&](std::uint32_t cell) {
            entries.push_back({cell, t});
            if (surface == SolidCells::kOpen) return;
            const std::uint64_t key = std::uint64_t{cell} << 32 | surface;
            if (touched.empty() || touched.back() != key) touched.push_back(key);
        });
        if (surface != SolidCells::kOpen)
            append_crossings(in_cells(all.corners[t], grid), surface, grid, crossings);
    }
    std::sort(touched.begin(), touched.end());
    SolidCells result;
    result.triangles = make_cell_lists(grid.cell_count(), entries);
    result.opaque = find_inside(grid, crossings, touched);
    result.surface_of = std::move(surfaces.surface_of);
    result.surface_count = surfaces.count;
    result.opened_below = surfaces.opened_below;
    return result;
}

int ray_crossing(const Triangle& triangle, const glm::dvec3& eye, int x, int x_cells) {
    const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const Point2 p{eye.y, eye.z};
    if (normal.x == 0.0 || !line_meets(triangle, p)) return 0;
    const double at = line_x(triangle, normal, p);
    if (at < eye.x || std::clamp(static_cast<int>(std::floor(at)), 0, x_cells - 1) != x) return 0;
    return normal.x < 0.0 ? 1 : -1;
}

double triangle_distance(const glm::dvec3& p, const Triangle& t) {
    const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], normal = glm::cross(ab, ac);
    const double area2 = glm::dot(normal, normal);
    if (area2 > 0.0) {
        const glm::dvec3 ap = p - t[0];
        const double v = glm::dot(glm::cross(ap, ac), normal) / area2,
                     w = glm::dot(glm::cross(ab, ap), normal) / area2;
        if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) return std::abs(glm::dot(ap, normal)) / std::sqrt(area2);
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 &a = t[k], e = t[(k + 1) % 3] - a;
        const double length2 = glm::dot(e, e);
        const double s = length2 > 0.0 ? std::clamp(glm::dot(p - a, e) / length2, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::distance(p, a + s * e));
    }
    return least;
}

float enclosed_radius(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                      const glm::vec3& centre) {
    const TriangleBatch batch{MaterialId{}, positions, indices, false};
    const Gathered all = gather({&batch, 1}, {true});
    const ClosedSurfaces surfaces =
        find_closed_surfaces(all.corners, all.joins, -std::numeric_limits<float>::infinity());
    double least = std::numeric_limits<double>::infinity(), angle = 0.0;
    for (std::size_t t = 0; t < all.corners.size(); ++t) {
        if (surfaces.surface_of[t] == SolidCells::kOpen) return 0.0f;
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = glm::dvec3(all.corners[t][k]);
        least = std::min(least, triangle_distance(glm::dvec3(centre), triangle));
        for (glm::dvec3& corner : triangle) corner -= glm::dvec3(centre);
        // Solid angle of the triangle (Van Oosterom & Strackee 1983): 4 pi in all, seen from inside.
        const double a = glm::length(triangle[0]), b = glm::length(triangle[1]), c = glm::length(triangle[2]);
        angle += 2.0 * std::atan2(glm::dot(triangle[0], glm::cross(triangle[1], triangle[2])),
                                  a * b * c + glm::dot(triangle[0], triangle[1]) * c +
                                      glm::dot(triangle[1], triangle[2]) * a +
                                      glm::dot(triangle[2], triangle[0]) * b);
    }
    const bool inside = angle > 6.0;
    return inside && std::isfinite(least) ? static_cast<float>(least * (1.0 - 1e-5)) : 0.0f;
}

}  // namespace rhview
