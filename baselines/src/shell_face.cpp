// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/shell_face.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace rhview {
namespace {

/// Of a pixel, or a cell: far more than double rounds here, and than a renderer moves a vertex.
constexpr double kSlack = 1e-3;
constexpr std::uint64_t kFull = ~std::uint64_t{0};

/// Bits [first, end) of a word, 0 <= first < end <= 64.
std::uint64_t span_of(int first, int end) {
    return (kFull >> (64 - (end - first))) << first;
}

void set_bits(std::span<std::uint64_t> words, int first, int end) {
    for (int word = first / 64; word * 64 < end; ++word) {
        const int low = std::max(first - word * 64, 0), high = std::min(end - word * 64, 64);
        words[static_cast<std::size_t>(word)] |= span_of(low, high);
    }
}

bool all_set(std::span<const std::uint64_t> words, int first, int end) {
    for (int word = first / 64; word * 64 < end; ++word) {
        const int low = std::max(first - word * 64, 0), high = std::min(end - word * 64, 64);
        const std::uint64_t wanted = span_of(low, high);
        if ((words[static_cast<std::size_t>(word)] & wanted) != wanted) return false;
    }
    return true;
}

/// Calls use(first, end) for each run of set bits.
template <class Use>
void for_each_run(std::span<const std::uint64_t> words, int bits, Use&& use) {
    int first = -1;
    for (int word = 0; word * 64 < bits; ++word) {
        const std::uint64_t w = words[static_cast<std::size_t>(word)];
        for (int at = 0; at < 64;) {
            const std::uint64_t rest = (first < 0 ? w : ~w) >> at;
            if (rest == 0) break;
            at += std::countr_zero(rest);
            if (first < 0) {
                first = word * 64 + at;
            } else {
                use(first, word * 64 + at);
                first = -1;
            }
        }
    }
    if (first >= 0) use(first, bits);
}

struct Slopes {
    double low = 0.0, high = 0.0;
};

/// Of all rays to a cell that starts at `from_eye` beside the eye, in a slab at `distance` > 0.
Slopes slopes_to_cell(double from_eye, double distance) {
    const double end = from_eye + 1.0, beyond = distance + 1.0;
    return {from_eye / (from_eye < 0.0 ? distance : beyond), end / (end > 0.0 ? distance : beyond)};
}

int clamp_to_int(double value, int low, int high) {
    return static_cast<int>(std::clamp(value, static_cast<double>(low), static_cast<double>(high)));
}

}  // namespace

ShellFace::ShellFace(int axis, int sign, int pixels)
    : axis_(axis),
      sign_(sign),
      pixels_(pixels),
      pixels_per_slope_(pixels / (2 * kReach)),
      words_(static_cast<std::size_t>(pixels) / 64),
      bits_(words_ * static_cast<std::size_t>(pixels)),
      open_(static_cast<std::size_t>(pixels)),
      stamp_(words_),
      all_(words_) {}

double ShellFace::distance_to(int slab) const {
    return sign_ > 0 ? slab - eye_a_ : eye_a_ - (slab + 1);
}

void ShellFace::begin(const glm::dvec3& eye, std::span<const glm::dvec3> planes) {
    eye_a_ = eye[axis_], eye_u_ = eye[axes().u], eye_v_ = eye[axes().v];
    open_rows_ = 0;
    first_open_row_ = pixels_;
    end_open_row_ = 0;
    if (!sees_some(planes)) return;
    for (int row = 0; row < pixels_; ++row) begin_row(row, planes);
    find_open_pixels();
}

/// Whether none of the planes has the whole picture outside.
bool ShellFace::sees_some(std::span<const glm::dvec3> planes) const {
    return std::all_of(planes.begin(), planes.end(), [&](const glm::dvec3& plane) {
        const double most = kReach * (std::abs(plane[axes().u]) + std::abs(plane[axes().v]));
        return plane[axis_] * sign_ + most >= -1e-6;
    });
}

// A plane leaves of each row an interval of slopes u: n_u·u + max over the row of n_v·v + n_a·sign >= 0.
void ShellFace::begin_row(int row, std::span<const glm::dvec3> planes) {
    const SlabAxes a = axes();
    const double v0 = slope_of(row), v1 = slope_of(row + 1);
    double low = 0.0, high = pixels_;
    for (const glm::dvec3& plane : planes) {
        const double n_u = plane[a.u], n_v = plane[a.v];
        const double rest = std::max(n_v * v0, n_v * v1) + plane[axis_] * sign_;
        if (std::abs(n_u) < 1e-9) {
            if (rest < -1e-6) high = -1.0;
        } else if (n_u > 0.0) {
            low = std::max(low, pixel_of(-rest / n_u));
        } else {
            high = std::min(high, pixel_of(-rest / n_u));
        }
    }
    std::uint64_t* bits = &bits_[static_cast<std::size_t>(row) * words_];
    std::fill(bits, bits + words_, kFull);
    const int first = clamp_to_int(std::floor(low - kSlack), 0, pixels_);
    const int end = clamp_to_int(std::ceil(high + kSlack), 0, pixels_);
    OpenWords& open = open_[static_cast<std::size_t>(row)];
    open = {};
    if (first >= end) return;
    open = {static_cast<std::uint16_t>(first / 64), static_cast<std::uint16_t>((end + 63) / 64)};
    for (int word = open.first; word < open.end; ++word)
        bits[word] &= ~span_of(std::max(first - word * 64, 0), std::min(end - word * 64, 64));
    ++open_rows_;
    first_open_row_ = std::min(first_open_row_, row);
    end_open_row_ = row + 1;
}

void ShellFace::find_reached(int slab, int v, int u_first, int u_last,
                             std::span<std::uint64_t> reached) const {
    const double distance = distance_to(slab);
    const Slopes rows = slopes_to_cell(v - eye_v_, distance);
    const double first_row = pixel_of(rows.low) - kSlack, last_row = pixel_of(rows.high) + kSlack;
    if (distance < kSlack || first_row < 0.0 || last_row >= pixels_) {
        set_bits(reached, u_first, u_last + 1);
        return;
    }
    std::size_t first_word = words_, end_word = 0;
    for (int row = std::max(static_cast<int>(first_row), first_open_row_);
         row <= std::min(static_cast<int>(last_row), end_open_row_ - 1); ++row) {
        if (!is_row_open(row)) continue;
        const OpenWords open = open_[static_cast<std::size_t>(row)];
        if (first_word == words_) std::fill(all_.begin(), all_.end(), kFull);
        const std::uint64_t* bits = &bits_[static_cast<std::size_t>(row) * words_];
        for (std::size_t w = open.first; w < open.end; ++w) all_[w] &= bits[w];
        first_word = std::min<std::size_t>(first_word, open.first);
        end_word = std::max<std::size_t>(end_word, open.end);
    }
    const double per_far = pixels_per_slope_ / (distance + 1.0), per_near = pixels_per_slope_ / distance;
    const double middle = kReach * pixels_per_slope_;
    const auto pixels_of = [&](int u) {
        const double from = u - eye_u_, end = from + 1.0;
        return Slopes{middle + from * (from < 0.0 ? per_near : per_far) - kSlack,
                      middle + end * (end > 0.0 ? per_near : per_far) + kSlack};
    };
    // Only the ends of the row may be cut off; in between, what is beside the open words is hidden.
    if (pixels_of(u_first).low < 0.0 || pixels_of(u_last).high >= pixels_) {
        for (int u = u_first; u <= u_last; ++u)
            if (pixels_of(u).low < 0.0 || pixels_of(u).high >= pixels_) set_bits(reached, u, u + 1);
    }
    if (first_word >= end_word) return;
    const double low = static_cast<double>(first_word) * 64 - middle,
                 high = static_cast<double>(end_word) * 64 - middle;
    const int first = clamp_to_int(eye_u_ + low / (low < 0.0 ? per_far : per_near) - 2.0, u_first, u_last);
    const int last = clamp_to_int(eye_u_ + high / (high > 0.0 ? per_far : per_near) + 2.0, u_first, u_last);
    for (int u = first; u <= last; ++u) {
        const Slopes pixels = pixels_of(u);
        if (pixels.low < 0.0 || pixels.high >= pixels_) continue;
        if (!all_set(all_, static_cast<int>(pixels.low), static_cast<int>(pixels.high) + 1))
            reached[static_cast<std::size_t>(u) / 64] |= std::uint64_t{1} << (u % 64);
    }
}

bool ShellFace::make_stamp(double distance, std::span<const std::uint64_t> blocked, std::size_t row_words,
                           int u_cells, int v_first, int v_last) {
    const auto first_row =
        blocked.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(v_first) * row_words);
    both_.assign(first_row, first_row + static_cast<std::ptrdiff_t>(row_words));
    for (int v = v_first + 1; v <= v_last; ++v)
        for (std::size_t w = 0; w < row_words; ++w)
            both_[w] &= blocked[static_cast<std::size_t>(v) * row_words + w];
    std::fill(stamp_.begin(), stamp_.end(), 0);
    bool any = false;
    for_each_run(both_, u_cells, [&](int begin, int end) {
        const double low = pixel_of((begin - eye_u_) / distance), high = pixel_of((end - eye_u_) / distance);
        const int first = clamp_to_int(std::ceil(low + kSlack), 0, pixels_);
        const int stop = clamp_to_int(std::floor(high - kSlack), 0, pixels_);
        if (first >= stop) return;
        set_bits(stamp_, first, stop);
        any = true;
    });
    return any;
}

void ShellFace::press_stamp(int row) {
    const OpenWords open = open_[static_cast<std::size_t>(row)];
    std::uint64_t* bits = &bits_[static_cast<std::size_t>(row) * words_];
    for (std::size_t w = open.first; w < open.end; ++w) bits[w] |= stamp_[w];
    shrink(row);
}

void ShellFace::shrink(int row) {
    OpenWords& open = open_[static_cast<std::size_t>(row)];
    const std::uint64_t* bits = &bits_[static_cast<std::size_t>(row) * words_];
    while (open.first < open.end && bits[open.first] == kFull) ++open.first;
    while (open.first < open.end && bits[open.end - 1] == kFull) --open.end;
    if (open.first == open.end) --open_rows_;
}

// A row of pixels is covered where all rows of cells are that it touches; neighbouring rows mostly touch the
// same ones and share a stamp.
void ShellFace::occlude(int slab, std::span<const std::uint64_t> blocked, std::size_t row_words, int u_cells,
                        int v_cells) {
    const double distance = distance_to(slab);
    if (distance < kSlack) return;
    int stamp_first = -1, stamp_last = -1;
    bool any = false;
    for (int row = first_open_row_; row < end_open_row_; ++row) {
        const OpenWords open = open_[static_cast<std::size_t>(row)];
        if (open.first == open.end) continue;
        const double low = eye_v_ + distance * slope_of(row) - kSlack;
        const double high = eye_v_ + distance * slope_of(row + 1) + kSlack;
        if (low < 0.0 || high >= v_cells) continue;
        const int v_first = static_cast<int>(low), v_last = static_cast<int>(high);
        if (v_first != stamp_first || v_last != stamp_last) {
            any = make_stamp(distance, blocked, row_words, u_cells, v_first, v_last);
            stamp_first = v_first, stamp_last = v_last;
        }
        if (any) press_stamp(row);
    }
    trim_open_rows();
    find_open_pixels();
}

void ShellFace::trim_open_rows() {
    while (first_open_row_ < end_open_row_ && !is_row_open(first_open_row_)) ++first_open_row_;
    while (first_open_row_ < end_open_row_ && !is_row_open(end_open_row_ - 1)) --end_open_row_;
}

void ShellFace::find_open_pixels() {
    int first = pixels_, end = 0;
    for (int row = first_open_row_; row < end_open_row_; ++row) {
        if (!is_row_open(row)) continue;
        first = std::min(first, 64 * open_[static_cast<std::size_t>(row)].first);
        end = std::max(end, 64 * open_[static_cast<std::size_t>(row)].end);
    }
    first_open_pixel_ = first;
    end_open_pixel_ = end;
}

ShellFace::Reach ShellFace::reach_at(int slab, int shell) const {
    constexpr int kAll = 1 << 28;
    const double distance = distance_to(slab);
    if (shell <= kCutShells || distance < kSlack) return {-kAll, kAll, -kAll, kAll};
    // The eye may be farther away than integers reach.
    const auto cell_at = [](double coordinate) {
        return static_cast<int>(std::fmin(std::fmax(std::floor(coordinate), -kAll), kAll));
    };
    const auto first = [&](double eye, int pixel) {
        const double slope = slope_of(pixel);
        return cell_at(eye + slope * (slope < 0.0 ? distance + 1.0 : distance) - kSlack) - 1;
    };
    const auto last = [&](double eye, int pixel) {
        const double slope = slope_of(pixel);
        return cell_at(eye + slope * (slope > 0.0 ? distance + 1.0 : distance) + kSlack) + 1;
    };
    return {first(eye_u_, first_open_pixel_), last(eye_u_, end_open_pixel_), first(eye_v_, first_open_row_),
            last(eye_v_, end_open_row_)};
}

// A ray along d meets the ball if dot(d, c)^2 >= |d|^2 (|c|^2 - r^2) and dot(d, c) > 0: in a row, for the
// slopes u between the roots of a quadratic. The outline is convex: a pixel lies inside if its corners do.
void ShellFace::occlude_ball(const glm::dvec3& centre, double radius, const glm::dvec3& cell_size) {
    const SlabAxes a = axes();
    const double c_u = centre[a.u], c_v = centre[a.v], c_a = centre[axis_] * sign_;
    const double s_u = cell_size[a.u], s_v = cell_size[a.v], s_a = cell_size[axis_];
    const double k = glm::dot(centre, centre) - radius * radius;
    if (c_a <= radius || k <= c_u * c_u || k <= c_v * c_v) return;
    const double square = s_u * s_u * (c_u * c_u - k);
    const auto between = [&](double v) -> Slopes {
        const double rest = v * s_v * c_v + s_a * c_a, half = s_u * c_u * rest;
        const double constant = rest * rest - (v * v * s_v * s_v + s_a * s_a) * k;
        const double root = half * half - square * constant;
        if (root <= 0.0) return {1.0, -1.0};
        const double low = (-half + std::sqrt(root)) / square, high = (-half - std::sqrt(root)) / square;
        if (0.5 * (low + high) * s_u * c_u + rest <= 0.0) return {1.0, -1.0};
        return {low, high};
    };
    const double v_low = (c_v - radius) / s_v / ((c_v < radius ? c_a - radius : c_a + radius) / s_a);
    const double v_high = (c_v + radius) / s_v / ((c_v > -radius ? c_a - radius : c_a + radius) / s_a);
    const int first_row = clamp_to_int(pixel_of(v_low) - 1.0, first_open_row_, end_open_row_);
    const int end_row = clamp_to_int(pixel_of(v_high) + 2.0, first_open_row_, end_open_row_);
    Slopes before = between(slope_of(first_row));
    for (int row = first_row; row < end_row; ++row) {
        const Slopes after = between(slope_of(row + 1));
        const double low = std::max(before.low, after.low), high = std::min(before.high, after.high);
        const bool both = before.low < before.high && after.low < after.high && low < high;
        before = after;
        if (!both || !is_row_open(row)) continue;
        const int first = clamp_to_int(std::ceil(pixel_of(low) + kSlack), 0, pixels_);
        const int end = clamp_to_int(std::floor(pixel_of(high) - kSlack), 0, pixels_);
        if (first >= end) continue;
        set_bits({&bits_[static_cast<std::size_t>(row) * words_], words_}, first, end);
        shrink(row);
    }
    trim_open_rows();
}

}  // namespace rhview
