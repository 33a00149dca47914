// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/image_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "uniform.h"

namespace rhview::gl {
namespace {

constexpr double kC1 = 6.5025, kC2 = 58.5225;  // (0.01·255)², (0.03·255)²

/// A grey picture; `value` is asked for column and row.
Picture grey(int width, int height, const std::function<int(int, int)>& value) {
    Picture picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            std::fill_n(picture.row(y) + 3 * x, 3, static_cast<std::uint8_t>(value(x, y)));
    return picture;
}

Picture flat(int width, int height, int value) {
    return grey(width, height, [&](int, int) { return value; });
}

/// Squares of one pixel around 128: under the window its mean is 128, its variance amplitude², to 1e-4.
Picture board(int amplitude) {
    return grey(32, 24, [&](int x, int y) { return 128 + ((x + y) % 2 == 0 ? amplitude : -amplitude); });
}

Picture noise(int width, int height, Uniform& uniform) {
    Picture picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int i = 0; i < 3 * width; ++i)
            picture.row(y)[i] = static_cast<std::uint8_t>(uniform(0.0, 256.0));
    return picture;
}

double luma(const Picture& picture, int x, int y) {
    const std::uint8_t* rgb = picture.row(y) + 3 * x;
    return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
}

/// The definition, window by window, the variances around the means.
double ssim_by_definition(const Picture& a, const Picture& b) {
    const auto weight = [](int i, int k) { return std::exp(-((i - 5) * (i - 5) + (k - 5) * (k - 5)) / 4.5); };
    double total_weight = 0.0, total = 0.0;
    for (int i = 0; i < 121; ++i) total_weight += weight(i % 11, i / 11);
    int windows = 0;
    for (int y = 0; y + 11 <= a.height(); ++y)
        for (int x = 0; x + 11 <= a.width(); ++x, ++windows) {
            const auto mean = [&](auto value) {
                double sum = 0.0;
                for (int i = 0; i < 121; ++i) sum += weight(i % 11, i / 11) * value(x + i % 11, y + i / 11);
                return sum / total_weight;
            };
            const auto of_a = [&](int u, int v) { return luma(a, u, v); };
            const auto of_b = [&](int u, int v) { return luma(b, u, v); };
            const double ma = mean(of_a), mb = mean(of_b);
            const double va = mean([&](int u, int v) { return std::pow(of_a(u, v) - ma, 2); });
            const double vb = mean([&](int u, int v) { return std::pow(of_b(u, v) - mb, 2); });
            const double cov = mean([&](int u, int v) { return (of_a(u, v) - ma) * (of_b(u, v) - mb); });
            total += (2 * ma * mb + kC1) / (ma * ma + mb * mb + kC1) * (2 * cov + kC2) / (va + vb + kC2);
        }
    return total / windows;
}

TEST(ImageDifference, equal_pictures_have_none) {
    Uniform uniform(1);
    const Picture picture = noise(40, 30, uniform);
    EXPECT_EQ(mean_squared_difference(picture, picture), 0.0);
    EXPECT_EQ(psnr_db(0.0), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(structural_similarity(picture, picture).value(), 1.0, 1e-12);
}

TEST(ImageDifference, a_constant_shift_has_the_psnr_of_its_square) {
    for (const int shift : {1, 5, 100}) {
        const double mse = mean_squared_difference(flat(20, 20, 50 + shift), flat(20, 20, 50));
        EXPECT_EQ(mse, shift * shift);
        EXPECT_NEAR(psnr_db(mse), 20.0 * std::log10(255.0 / shift), 1e-12);
    }
    EXPECT_NEAR(psnr_db(mean_squared_difference(flat(9, 9, 255), flat(9, 9, 0))), 0.0, 1e-12);
}

TEST(ImageDifference, one_changed_channel_of_one_pixel_counts_once) {
    Picture picture = flat(16, 12, 80);
    picture.row(7)[3 * 4 + 1] = 90;
    EXPECT_DOUBLE_EQ(mean_squared_difference(picture, flat(16, 12, 80)), 100.0 / (3 * 16 * 12));
}

TEST(ImageDifference, noise_has_the_psnr_of_its_variance) {
    Uniform uniform(2);
    // Whole numbers from -k to k, each as likely, have the variance k (k + 1) / 3.
    for (const int k : {3, 20}) {
        const Picture noisy =
            grey(400, 300, [&](int, int) { return 128 - k + static_cast<int>(uniform(0.0, 2.0 * k + 1.0)); });
        const double variance = k * (k + 1) / 3.0;
        EXPECT_NEAR(mean_squared_difference(noisy, flat(400, 300, 128)), variance, 0.02 * variance);
    }
}

TEST(ImageDifference, ssim_of_flat_pictures_is_that_of_their_means) {
    for (const auto& [a, b] : {std::pair(100, 110), {0, 255}, {0, 0}, {255, 1}}) {
        const double expected = (2.0 * a * b + kC1) / (a * a + b * b + kC1);
        EXPECT_NEAR(structural_similarity(flat(15, 14, a), flat(15, 14, b)).value(), expected, 1e-9);
    }
}

TEST(ImageDifference, ssim_of_lost_contrast_is_that_of_the_variance) {
    for (const int amplitude : {1, 8, 60}) {
        const double variance = amplitude * amplitude;
        EXPECT_NEAR(structural_similarity(board(amplitude), board(0)).value(), kC2 / (variance + kC2), 2e-4);
        EXPECT_NEAR(structural_similarity(board(amplitude), board(-amplitude)).value(),
                    (kC2 - 2.0 * variance) / (kC2 + 2.0 * variance), 4e-4);
        EXPECT_NEAR(structural_similarity(board(amplitude), board(2 * amplitude)).value(),
                    (4.0 * variance + kC2) / (5.0 * variance + kC2), 4e-4);
    }
}

TEST(ImageDifference, ssim_agrees_with_the_definition_window_by_window) {
    Uniform uniform(3);
    for (const auto& [width, height] : {std::pair(11, 11), {11, 30}, {37, 11}, {40, 25}}) {
        const Picture a = noise(width, height, uniform);
        Picture b = a;
        for (int y = 0; y < height; ++y)
            for (int i = 0; i < 3 * width; ++i)
                b.row(y)[i] = static_cast<std::uint8_t>(0.6 * b.row(y)[i] + uniform(0.0, 90.0));
        EXPECT_NEAR(structural_similarity(a, b).value(), ssim_by_definition(a, b), 1e-9);
        EXPECT_NEAR(structural_similarity(a, b).value(), structural_similarity(b, a).value(), 1e-12);
    }
}

TEST(ImageDifference, ssim_is_absent_where_no_window_fits) {
    EXPECT_FALSE(structural_similarity(flat(10, 40, 1), flat(10, 40, 1)).has_value());
    EXPECT_FALSE(structural_similarity(flat(40, 10, 1), flat(40, 10, 1)).has_value());
    EXPECT_EQ(mean_squared_difference(flat(1, 1, 3), flat(1, 1, 1)), 4.0);
}

View view_with(ClipDepth clip_depth, const glm::dmat4& clip_from_camera) {
    View view;
    view.clip_from_camera = clip_from_camera;
    view.clip_depth = clip_depth;
    return view;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<View> views() {
    std::vector<View> all;
    for (const ClipDepth depth :
         {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne, ClipDepth::ReversedZeroToOne}) {
        all.push_back(view_with(depth, perspective(1.0, 1.5, 0.5, 800.0, depth)));
        all.push_back(view_with(depth, perspective(1.0, 1.5, 0.5, kInfinity, depth)));
        all.push_back(view_with(depth, orthographic(30.0, 20.0, 0.5, 800.0, depth)));
    }
    return all;
}

/// As a depth buffer of doubles would hold it.
double depth_of_distance(double distance, const View& view) {
    const glm::dvec4 clip = view.clip_from_camera * glm::dvec4(0.0, 0.0, -distance, 1.0);
    const double d = clip.z / clip.w;
    return view.clip_depth == ClipDepth::NegativeOneToOne ? 0.5 * d + 0.5 : d;
}

float cleared(const View& view) {
    return view.clip_depth == ClipDepth::ReversedZeroToOne ? 0.0f : 1.0f;
}

TEST(ImageDifference, distances_come_back_from_depths_in_every_convention) {
    for (const View& view : views()) {
        for (const double distance : {0.5, 1.0, 7.0, 60.0}) {
            const double depth = depth_of_distance(distance, view);
            // What the rounding of the depth to a float moves.
            const auto rounded = static_cast<float>(depth);
            const double slack = std::abs(distance_of_depth(std::nextafterf(rounded, 2.0f), view) -
                                          distance_of_depth(rounded, view));
            EXPECT_NEAR(distance_of_depth(rounded, view), distance, slack + 1e-9);
        }
        EXPECT_EQ(distance_of_depth(cleared(view), view), kInfinity);
    }
}

TEST(ImageDifference, depth_error_is_relative_and_whole_where_something_is_gone) {
    for (const View& view : views()) {
        const auto at = [&](double distance) {
            return static_cast<float>(depth_of_distance(distance, view));
        };
        const std::vector<float> reference{at(10.0), at(2.0), cleared(view), cleared(view)};
        const DepthDifference none = depth_difference(reference, reference, view);
        EXPECT_EQ(none.mean, 0.0);
        EXPECT_EQ(none.greatest, 0.0);
        const DepthDifference nearer =
            depth_difference(std::vector{at(8.0), at(2.0), cleared(view), cleared(view)}, reference, view);
        EXPECT_NEAR(nearer.greatest, 0.2, 1e-3);
        EXPECT_NEAR(nearer.mean, 0.05, 1e-3);
        const DepthDifference gone =
            depth_difference(std::vector{cleared(view), at(2.0), cleared(view), at(5.0)}, reference, view);
        EXPECT_EQ(gone.greatest, 1.0);
        EXPECT_EQ(gone.mean, 0.5);
    }
}

TEST(ImageDifference, all_of_a_frame_is_told_together) {
    const View view = views().front();
    std::vector<float> depths(12 * 11, cleared(view)), reference = depths;
    depths[5] = static_cast<float>(depth_of_distance(3.0, view));
    const ImageDifference difference =
        image_difference(flat(12, 11, 60), depths, flat(12, 11, 63), reference, view);
    EXPECT_EQ(difference.missing_pixels, 1u);
    EXPECT_DOUBLE_EQ(difference.depth.mean, 1.0 / (12 * 11));
    EXPECT_EQ(difference.depth.greatest, 1.0);
    EXPECT_EQ(difference.colour_mse, 9.0);
    EXPECT_NEAR(difference.ssim.value(), (2.0 * 60 * 63 + kC1) / (60 * 60 + 63 * 63 + kC1), 1e-9);
}

}  // namespace
}  // namespace rhview::gl
