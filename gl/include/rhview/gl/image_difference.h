// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// How far a picture is from the one that it stands for, in colours and in depths. No graphics API.
///
/// Of a method that promises every pixel, `count_missing_pixels` is the oracle, and all of these are 0 (or 1,
/// or infinite). They measure what is given up on purpose: levels of detail, small things left out, late
/// answers. Pictures that are compared have one size, 1×1 at least; all are thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "rhview/base/view.h"
#include "rhview/gl/picture.h"

namespace rhview::gl {

/// Mean over pixels and the three channels of the squared difference: 0 (equal) to 255².
double mean_squared_difference(const Picture& picture, const Picture& reference);

/// Peak signal-to-noise ratio, 10·log10(255² / `mean_squared_difference`), in dB; infinite for 0. Of several
/// frames, that of the mean of their squared differences.
double psnr_db(double mean_squared_difference);

/// Mean structural similarity, -1 to 1 (1: equal luma), of the lumas Y = 0.299 R + 0.587 G + 0.114 B:
///
///     SSIM = (2 μx μy + C1) (2 σxy + C2) / ((μx² + μy² + C1) (σx² + σy² + C2)),
///     C1 = (0.01·255)²,  C2 = (0.03·255)²,
///
/// with means, variances and covariance under a Gaussian window of 11×11 pixels, σ = 1.5, weights of sum 1;
/// mean over all windows inside the picture, at full resolution. Absent where a side has fewer than 11
/// pixels. Cost: about 130 multiplications a pixel. Source: Wang, Bovik, Sheikh & Simoncelli 2004, section
/// III.B–C.
std::optional<double> structural_similarity(const Picture& picture, const Picture& reference);

/// Distance from the eye's plane of what has this depth in the depth buffer of `view`, infinite for what was
/// cleared (the far end of its `clip_depth`). For projections whose depth depends on that distance alone.
double distance_of_depth(float depth, const View& view);

/// Distances d and e of one pixel are |d - e| / max(d, e) apart: 0 (equal) to 1 (nothing is there in one of
/// them).
struct DepthDifference {
    double mean = 0.0;  ///< over all pixels
    double greatest = 0.0;
};
/// Depths are as `RenderTarget::read_depth` gives them, as many of each.
DepthDifference depth_difference(std::span<const float> depths, std::span<const float> reference,
                                 const View& view);

/// All of it, of one frame.
struct ImageDifference {
    std::uint64_t missing_pixels =
        0;  ///< as `count_missing_pixels` counts them: the depth differs in any bit
    DepthDifference depth;
    double colour_mse = 0.0;
    std::optional<double> ssim;
};
/// All of them at once. Both pictures have the same size, and a depth per pixel from `view`.
ImageDifference image_difference(const Picture& picture, std::span<const float> depths,
                                 const Picture& reference, std::span<const float> reference_depths,
                                 const View& view);

}  // namespace rhview::gl
