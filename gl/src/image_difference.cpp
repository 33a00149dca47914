// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/image_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rhview/base/assert.h"
#include "rhview/gl/render_target.h"

namespace rhview::gl {
namespace {

constexpr int kWindow = 11;
constexpr double kWindowSigma = 1.5;
constexpr double kPeak = 255.0;
constexpr double kC1 = (0.01 * kPeak) * (0.01 * kPeak);
constexpr double kC2 = (0.03 * kPeak) * (0.03 * kPeak);

using Weights = std::array<double, kWindow>;

/// The window is the product of one such row and one such column.
Weights window_weights() {
    Weights weights{};
    double sum = 0.0;
    for (int i = 0; i < kWindow; ++i) {
        const double from_middle = (i - kWindow / 2) / kWindowSigma;
        weights[static_cast<std::size_t>(i)] = std::exp(-0.5 * from_middle * from_middle);
        sum += weights[static_cast<std::size_t>(i)];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

/// Weighted means of x, y, x², y² and xy.
struct Moments {
    double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;

    void add(double weight, const Moments& other) {
        x += weight * other.x;
        y += weight * other.y;
        xx += weight * other.xx;
        yy += weight * other.yy;
        xy += weight * other.xy;
    }
};

double ssim_of(const Moments& m) {
    const double means = m.x * m.y, squares = m.x * m.x + m.y * m.y;
    const double covariance = m.xy - means, variances = m.xx + m.yy - squares;
    return (2.0 * means + kC1) * (2.0 * covariance + kC2) / ((squares + kC1) * (variances + kC2));
}

double luma(const std::uint8_t* rgb) {
    return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
}

/// Each pixel's products, then the windows' means along the row: `along` has `kWindow` - 1 fewer.
void filter_row(const std::uint8_t* a, const std::uint8_t* b, const Weights& weights,
                std::vector<Moments>& products, std::vector<Moments>& along) {
    for (std::size_t i = 0; i < products.size(); ++i) {
        const double x = luma(a + 3 * i), y = luma(b + 3 * i);
        products[i] = {x, y, x * x, y * y, x * y};
    }
    for (std::size_t i = 0; i < along.size(); ++i) {
        along[i] = {};
        for (std::size_t k = 0; k < kWindow; ++k) along[i].add(weights[k], products[i + k]);
    }
}

void assert_one_size(const Picture& a, const Picture& b) {
    RHVIEW_ASSERT(a.width() == b.width() && a.height() == b.height());
    RHVIEW_ASSERT(a.width() > 0 && a.height() > 0);
}

}  // namespace

double mean_squared_difference(const Picture& picture, const Picture& reference) {
    assert_one_size(picture, reference);
    const int values = 3 * picture.width();
    std::uint64_t sum = 0;
    for (int y = 0; y < picture.height(); ++y) {
        const std::uint8_t *a = picture.row(y), *b = reference.row(y);
        for (int i = 0; i < values; ++i) {
            const int difference = a[i] - b[i];
            sum += static_cast<std::uint64_t>(difference * difference);
        }
    }
    return static_cast<double>(sum) / (static_cast<double>(values) * picture.height());
}

double psnr_db(double mean_squared_difference) {
    if (mean_squared_difference <= 0.0) return std::numeric_limits<double>::infinity();
    return 10.0 * std::log10(kPeak * kPeak / mean_squared_difference);
}

std::optional<double> structural_similarity(const Picture& picture, const Picture& reference) {
    assert_one_size(picture, reference);
    const int rows = picture.height();
    if (picture.width() < kWindow || rows < kWindow) return {};
    const Weights weights = window_weights();
    const auto width = static_cast<std::size_t>(picture.width());
    const std::size_t windows = width - kWindow + 1;
    std::vector<Moments> products(width);
    std::array<std::vector<Moments>, kWindow> recent;  // row y at y % kWindow
    recent.fill(std::vector<Moments>(windows));
    double sum = 0.0;
    for (int y = 0; y < rows; ++y) {
        filter_row(picture.row(y), reference.row(y), weights, products,
                   recent[static_cast<std::size_t>(y % kWindow)]);
        const int first = y - kWindow + 1;
        for (std::size_t i = 0; first >= 0 && i < windows; ++i) {
            Moments window;
            for (int k = 0; k < kWindow; ++k)
                window.add(weights[static_cast<std::size_t>(k)],
                           recent[static_cast<std::size_t>((first + k) % kWindow)][i]);
            sum += ssim_of(window);
        }
    }
    return sum / (static_cast<double>(windows) * (rows - kWindow + 1));
}

double distance_of_depth(float depth, const View& view) {
    const float cleared = view.clip_depth == ClipDepth::ReversedZeroToOne ? 0.0f : 1.0f;
    if (depth == cleared) return std::numeric_limits<double>::infinity();
    const double d =
        view.clip_depth == ClipDepth::NegativeOneToOne ? 2.0 * depth - 1.0 : static_cast<double>(depth);
    // d = (p22 z + p32) / (p23 z + p33), the matrix by column and row, solved for z; the eye looks along -z.
    const glm::dmat4& p = view.clip_from_camera;
    return (d * p[3][3] - p[3][2]) / (d * p[2][3] - p[2][2]);
}

DepthDifference depth_difference(std::span<const float> depths, std::span<const float> reference,
                                 const View& view) {
    RHVIEW_ASSERT(depths.size() == reference.size());
    DepthDifference difference;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        if (depths[i] == reference[i]) continue;
        const double a = distance_of_depth(depths[i], view), b = distance_of_depth(reference[i], view);
        const double error = std::isinf(std::max(a, b)) ? 1.0 : std::abs(a - b) / std::max(a, b);
        difference.mean += error;
        difference.greatest = std::max(difference.greatest, error);
    }
    if (!depths.empty()) difference.mean /= static_cast<double>(depths.size());
    return difference;
}

ImageDifference image_difference(const Picture& picture, std::span<const float> depths,
                                 const Picture& reference, std::span<const float> reference_depths,
                                 const View& view) {
    return {count_missing_pixels(depths, reference_depths), depth_difference(depths, reference_depths, view),
            mean_squared_difference(picture, reference), structural_similarity(picture, reference)};
}

}  // namespace rhview::gl
