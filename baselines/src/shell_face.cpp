// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/shell_face.h"

#include <algorithm>
#include <bit>
#include <cmath>

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
    for (int row = 0; row < pixels_; ++row) begin_row(row, planes);
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
    std::fill(all_.begin(), all_.end(), kFull);
    for (int row = std::max(static_cast<int>(first_row), first_open_row_);
         row <= std::min(static_cast<int>(last_row), end_open_row_ - 1); ++row) {
        const OpenWords open = open_[static_cast<std::size_t>(row)];
        if (open.first == open.end) continue;
        const std::uint64_t* bits = &bits_[static_cast<std::size_t>(row) * words_];
        for (std::size_t w = open.first; w < open.end; ++w) all_[w] &= bits[w];
        first_word = std::min<std::size_t>(first_word, open.first);
        end_word = std::max<std::size_t>(end_word, open.end);
    }
    // A cell beside the open words is hidden, unless the picture cuts it off.
    const double open_low = first_word < end_word ? static_cast<double>(first_word) * 64 : 1e9;
    const double open_high = first_word < end_word ? static_cast<double>(end_word) * 64 : -1e9;
    for (int u = u_first; u <= u_last; ++u) {
        const Slopes columns = slopes_to_cell(u - eye_u_, distance);
        const double first = pixel_of(columns.low) - kSlack, last = pixel_of(columns.high) + kSlack;
        const bool cut = first < 0.0 || last >= pixels_;
        if (!cut && (last < open_low || first >= open_high)) continue;
        if (cut || !all_set(all_, static_cast<int>(first), static_cast<int>(last) + 1))
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
    while (first_open_row_ < end_open_row_ && open_[static_cast<std::size_t>(first_open_row_)].first ==
                                                  open_[static_cast<std::size_t>(first_open_row_)].end)
        ++first_open_row_;
    while (first_open_row_ < end_open_row_ && open_[static_cast<std::size_t>(end_open_row_ - 1)].first ==
                                                  open_[static_cast<std::size_t>(end_open_row_ - 1)].end)
        --end_open_row_;
}

}  // namespace rhview
