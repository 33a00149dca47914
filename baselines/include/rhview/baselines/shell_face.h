// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Occlusion volumes behind one face of the shells of cells around the eye.
///
/// A shell is all cells at one chessboard distance from the eye's cell: the hull of a cube, whose faces lie
/// in slabs of cells. An occluder of a face throws a volume whose sides run through the eye; every cut of
/// that volume parallel to the face is the same picture seen from the eye. So the volumes of all shells of a
/// direction are kept as one picture of bits, and fuse in it: a bit says that every ray of its pixel ends, or
/// leaves the view, before the slabs that come next. What is outside of the view is set from the start.
/// Rasterising is conservative both ways: a pixel is set only if covered whole, a cell is hidden only if
/// every pixel that it touches is set. All positions are in cell coordinates (`CellGrid`).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "rhview/baselines/cell_grid.h"

namespace rhview {

/// One face of the shells around the eye's cell: which of its cells light can still reach.
class ShellFace {
  public:
    /// Slopes of the rays that the picture holds, to either side. Up to 2, a cell of a face's third shell or
    /// beyond is never cut off.
    static constexpr double kReach = 2.125;
    /// Shells up to this one may be cut off.
    static constexpr int kCutShells = 2;

    /// `axis` and `sign` say which way the face looks; `pixels` is a multiple of 64.
    ShellFace(int axis, int sign, int pixels);

    /// Empties the picture for an eye and its view: directions d with dot(plane, d) < 0 for one of `planes`
    /// are outside of it.
    void begin(const glm::dvec3& eye, std::span<const glm::dvec3> planes);

    [[nodiscard]] int axis() const { return axis_; }
    [[nodiscard]] int sign() const { return sign_; }
    [[nodiscard]] SlabAxes axes() const { return slab_axes(axis_); }
    /// Whether a ray is left.
    [[nodiscard]] bool is_open() const { return open_rows_ > 0; }

    /// Cells that a ray may reach in a slab, of those that the picture does not cut off.
    struct Reach {
        int u_first = 0, u_last = -1;
        int v_first = 0, v_last = -1;

        /// Whether no cell of the rectangle is in this one; bounds are inclusive.
        [[nodiscard]] bool misses(int u0, int u1, int v0, int v1) const {
            return u_first > u1 || u_last < u0 || v_first > v1 || v_last < v0;
        }
    };
    /// Everything where the picture may cut cells off.
    [[nodiscard]] Reach reach_at(int slab, int shell) const;

    /// Cells [u_first, u_last] of row `v` of a slab that rays may reach: sets their bits in `reached`, which
    /// is clear. Cells beyond the picture may always be reached.
    void find_reached(int slab, int v, int u_first, int u_last, std::span<std::uint64_t> reached) const;

    /// Rays end that enter the slab through a cell set in `blocked`: rows of `row_words` words, one for each
    /// v of the grid.
    void occlude(int slab, std::span<const std::uint64_t> blocked, std::size_t row_words, int u_cells,
                 int v_cells);

    /// Rays end that meet the ball about `centre` (from the eye, metres, as is `radius`); `cell_size` is that
    /// of the grid. The ball lies before the slabs that come next. Nothing happens where it reaches the slab
    /// of the eye, or is so near that its outline is not an ellipse.
    void occlude_ball(const glm::dvec3& centre, double radius, const glm::dvec3& cell_size);

  private:
    /// Words of a row that are not full.
    struct OpenWords {
        std::uint16_t first = 0;
        std::uint16_t end = 0;
    };

    /// From the eye to the slab's nearer border; below zero for the eye's own slab.
    [[nodiscard]] double distance_to(int slab) const;
    [[nodiscard]] double pixel_of(double slope) const { return (slope + kReach) * pixels_per_slope_; }
    [[nodiscard]] double slope_of(int pixel) const { return pixel / pixels_per_slope_ - kReach; }
    [[nodiscard]] bool sees_some(std::span<const glm::dvec3> planes) const;
    void begin_row(int row, std::span<const glm::dvec3> planes);
    /// The pixels of a row covered by the cells set in all of `blocked`'s rows from `v_first` to `v_last`.
    bool make_stamp(double distance, std::span<const std::uint64_t> blocked, std::size_t row_words,
                    int u_cells, int v_first, int v_last);
    void press_stamp(int row);
    void trim_open_rows();
    void find_open_pixels();
    [[nodiscard]] bool is_row_open(int row) const {
        return open_[static_cast<std::size_t>(row)].first != open_[static_cast<std::size_t>(row)].end;
    }
    void shrink(int row);

    int axis_;
    int sign_;
    int pixels_;
    double pixels_per_slope_;
    std::size_t words_;
    double eye_a_ = 0.0, eye_u_ = 0.0, eye_v_ = 0.0;
    int open_rows_ = 0;
    int first_open_row_ = 0;
    int end_open_row_ = 0;
    int first_open_pixel_ = 0;  ///< of any row, as are its last ones; no less
    int end_open_pixel_ = 0;
    std::vector<std::uint64_t> bits_;
    std::vector<OpenWords> open_;
    std::vector<std::uint64_t> stamp_;
    std::vector<std::uint64_t> both_;         ///< scratch: rows of cells, all of them set
    mutable std::vector<std::uint64_t> all_;  ///< scratch: rows of pixels, all of them set
};

}  // namespace rhview
