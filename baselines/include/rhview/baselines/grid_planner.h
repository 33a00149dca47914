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

/// How fine the grid is, and what counts as an occluder.
struct GridOptions {
    glm::ivec3 cells{100, 60, 100};
    Aabb bounds;  ///< empty: of everything. What moves out of it is only tested against the frustum
    bool nothing_leaves = false;  ///< the caller's promise: then volumes may end at the bounds
    int face_pixels = 1024;       ///< resolution of an occlusion volume's cross-section, a multiple of 64
    /// Besides opaque cells, objects' inner balls end rays as a whole, once the traversal is past them:
    /// fusion in the image, which the thesis names as its future work. False: its method as published.
    bool fuses_balls = true;
};

/// What the last plan did.
struct GridStatistics {
    std::uint64_t cells_reached = 0;
    std::uint64_t volumes_renewed = 0;   ///< temporal volumes whose time was over
    std::uint64_t volumes_revealed = 0;  ///< found by the traversal, or by the eye
    std::uint64_t volumes = 0;           ///< alive after it: objects that cost nothing
    std::uint64_t opaque_cells = 0;      ///< of moving objects
};

/// Traverses the grid from the eye outwards, shell by shell, and draws what it reaches.
class GridPlanner final : public FramePlanner {
  public:
    /// `batches` hold the triangles of `statics`, in order, and nothing else; their arrays outlive it.
    /// `occludes[b]`: whether batch b has no holes (alpha test). Cost: that of `find_solid_cells`.
    GridPlanner(std::span<const TriangleBatch> batches, const std::vector<bool>& occludes,
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
    /// A ball that was reached, in the list of the slab of a face that it lies before.
    struct WaitingBall {
        glm::dvec3 centre{0.0};  ///< from the eye, metres
        double radius = 0.0;
        std::uint32_t next = 0;
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

    void begin_frame();
    void restore_occluders();
    void drop_owner(std::uint32_t owner);
    void drop_near_surfaces();
    void drop_surfaces_around();
    void renew_expired();
    void reveal(ObjectId object);
    void discretise(ObjectId object);
    void add_occluder(const GridObject& object, const Aabb& box);
    void give_volume(ObjectId object, const Aabb& box);
    void give_volumes();

    void traverse();
    void visit_face(std::size_t face, int shell);
    void block_rays(ShellFace& volume, int slab, int v_first, int v_last);
    void visit_cell(const glm::ivec3& cell);
    void show(std::uint32_t item);
    void await_ball(std::uint32_t object);
    void press_balls(std::size_t face, int slab);
    void emit(const Frustum& frustum, FramePlan& plan);

    std::vector<GridStatic> statics_;  ///< items, followed by the objects
    std::vector<GridObject> objects_;
    std::vector<TriangleBatch> batches_;
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

    bool fuses_balls_;
    std::span<const Aabb> boxes_;  ///< of the objects, while a plan is made
    Eye eye_;
    std::vector<std::uint32_t> waiting_heads_;  ///< by face and slab
    std::vector<WaitingBall> waiting_;
    int shell_ = 0;  ///< that the traversal is in
    int last_shell_ = 0;
    std::size_t longest_axis_ = 0;

    std::vector<ShellFace> faces_;      ///< -x, +x, -y, +y, -z, +z
    std::vector<std::uint64_t> slab_;   ///< scratch: what blocks rays, by row
    std::vector<std::uint64_t> row_;    ///< scratch
    std::vector<std::uint64_t> shown_;  ///< by item
    ObjectSorter sorter_;
    GridStatistics statistics_;
};

}  // namespace rhview
