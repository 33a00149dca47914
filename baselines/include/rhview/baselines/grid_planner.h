// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Method `grid`: occlusion in a regular grid, on the CPU alone; moving things that are hidden cost nothing
/// until they may have left the volume that was promised to hold them.
///
/// Conservative: what it leaves out shows no pixel, or the caller broke a promise below. Cells are opaque
/// only where they lie inside closed surfaces, seen from outside of these.
/// Sources: Batagelo 2002 (master's thesis, Unicamp); Sudarsky & Gotsman 1999 (temporal bounding volumes);
/// Schaufler et al. 2000 (occluders extended into what is already hidden).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "rhview/base/triangle_batch.h"
#include "rhview/baselines/cell_grid.h"
#include "rhview/baselines/shell_face.h"
#include "rhview/baselines/solid_cells.h"
#include "rhview/baselines/temporal_volumes.h"
#include "rhview/frustum/frustum.h"
#include "rhview/pipeline/frame_planner.h"

namespace rhview {

/// An object placed by the application, by `ObjectId`. Lengths in metres.
struct GridObject {
    Aabb bounds;  ///< of one that never moves
    /// How far each face of its box moves from one plan to the next at most. 0: never; infinite: unknown.
    float max_step = 0.0f;
    glm::vec3 inner_offset{0.0f};  ///< centre of a ball inside its closed surface, from its box's centre
    float inner_radius = 0.0f;     ///< 0: hides nothing
    float outer_radius = std::numeric_limits<float>::infinity();  ///< of a ball about its box's centre
};

struct GridOptions {
    glm::ivec3 cells{100, 60, 100};
    Aabb bounds;  ///< empty: of everything. What moves out of it is only tested against the frustum
    bool nothing_leaves = false;  ///< the caller's promise: then volumes may end at the bounds
    int face_pixels = 1024;       ///< resolution of an occlusion volume's cross-section, a multiple of 64
};

/// What the last plan did.
struct GridStatistics {
    std::uint64_t cells_reached = 0;
    std::uint64_t volumes_renewed = 0;   ///< temporal volumes whose time was over
    std::uint64_t volumes_revealed = 0;  ///< found by the traversal, or by the eye
    std::uint64_t volumes = 0;           ///< alive after it: objects that cost nothing
    std::uint64_t opaque_cells = 0;      ///< of moving objects
};

class GridPlanner final : public FramePlanner {
  public:
    /// `batches` (read while it is built, and again near the eye: they outlive it) hold the triangles of
    /// `statics`, in order, and nothing else. `occludes[b]`: whether batch b has no holes (alpha test).
    GridPlanner(std::span<const TriangleBatch> batches, std::span<const bool> occludes,
                std::vector<GridStatic> statics, std::vector<GridObject> objects, const GridOptions& options);

    void plan(const FrameInput& input, FramePlan& plan) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

    [[nodiscard]] const GridStatistics& statistics() const { return statistics_; }
    [[nodiscard]] std::size_t static_opaque_cells() const { return solids_.opaque.size(); }

  private:
    /// What the eye sees with, in cell coordinates.
    struct Eye {
        glm::dvec3 scene{0.0};
        glm::dvec3 position{0.0};
        glm::ivec3 cell{0};
        double near_reach = 0.0;             ///< metres: nothing nearer is shown for certain
        std::array<glm::dvec3, 4> planes{};  ///< of the view's sides, through the eye
    };
    struct ObjectNode {
        std::uint32_t object = 0;
        std::uint32_t next = 0;
    };
    static constexpr std::uint32_t kNone = 0xffffffffu;

    void build_fixed(std::span<const TriangleBatch> batches);
    void append_static_cells(std::vector<CellEntry>& entries) const;
    [[nodiscard]] Eye eye_of(const FrameInput& input) const;

    [[nodiscard]] std::array<glm::dvec3, 3> corners_of(std::uint32_t triangle) const;

    void begin_frame(const FrameInput& input, const Eye& eye);
    void restore_occluders();
    void drop_owner(std::uint32_t owner);
    void drop_near_surfaces(const Eye& eye);
    void drop_surfaces_around(const Eye& eye);
    void renew_expired(const FrameInput& input, const Eye& eye);
    void reveal(ObjectId object, const FrameInput& input, const Eye& eye);
    void discretise(ObjectId object, const FrameInput& input, const Eye& eye);
    void add_occluder(const GridObject& object, const Aabb& box, const Eye& eye);
    void give_volume(ObjectId object, const Aabb& box, const Eye& eye);
    void give_volumes(const FrameInput& input, const Eye& eye);

    void traverse(const FrameInput& input, const Eye& eye);
    void visit_face(std::size_t face, int shell, const FrameInput& input, const Eye& eye);
    void visit_cell(const glm::ivec3& cell, const FrameInput& input, const Eye& eye);
    void show(std::uint32_t item);
    void emit(const FrameInput& input, const Frustum& frustum, FramePlan& plan);

    std::vector<GridStatic> statics_;  ///< items, followed by the objects
    std::vector<GridObject> objects_;
    std::span<const TriangleBatch> batches_;
    bool nothing_leaves_;
    std::vector<std::uint32_t> batch_first_triangle_;
    CellGrid grid_;
    float lowest_y_ = 0.0f;
    SolidCells solids_;
    CellLists fixed_;                         ///< items that never move, by cell: matrix I of what is static
    CellSet fixed_occluders_;                 ///< matrix O_s
    std::vector<OpaqueCell> owned_;           ///< cells of `fixed_occluders_` by owner: surface, then object
    std::vector<std::uint32_t> owner_first_;  ///< into `owned_`

    CellSet occluders_;                ///< matrix O
    std::vector<glm::ivec3> changed_;  ///< cells of `occluders_` that may differ from O_s
    CellSet reached_;                  ///< complement of matrix H, so far
    std::vector<glm::ivec3> reached_cells_;
    std::vector<std::uint32_t> moving_heads_;  ///< matrix I of moving objects without a temporal volume
    std::vector<ObjectNode> moving_nodes_;
    std::vector<std::uint32_t> moving_cells_;  ///< whose heads are set
    TemporalVolumes volumes_;                  ///< matrix T
    std::vector<std::uint16_t> period_;        ///< frames that the next volume of an object shall last
    std::vector<ObjectId> tracked_;            ///< moving objects without a temporal volume
    std::vector<ObjectId> found_;              ///< scratch
    std::vector<ObjectId> kept_;               ///< scratch
    std::vector<std::pair<std::uint32_t, int>> windings_;  ///< scratch: of surfaces around the eye

    std::vector<ShellFace> faces_;      ///< -x, +x, -y, +y, -z, +z
    std::vector<std::uint64_t> slab_;   ///< scratch: what blocks rays, by row
    std::vector<std::uint64_t> row_;    ///< scratch
    std::vector<std::uint64_t> shown_;  ///< by item
    GridStatistics statistics_;
};

}  // namespace rhview
