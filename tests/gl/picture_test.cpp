// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace rhview::gl {
namespace {

Picture filled(int width, int height, std::uint8_t value) {
    Picture picture(width, height);
    for (int y = 0; y < height; ++y) std::fill_n(picture.row(y), 3 * width, value);
    return picture;
}

TEST(Picture, png_reads_back_as_written_and_leaves_no_other_file) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "rhview_picture_test";
    std::filesystem::create_directories(folder);
    Picture picture = filled(17, 9, 10);
    picture.row(3)[3 * 5 + 1] = 200;
    ASSERT_TRUE(picture.save_png(folder / "a.png").ok());
    int width = 0, height = 0, channels = 0;
    stbi_uc* pixels = stbi_load((folder / "a.png").c_str(), &width, &height, &channels, 3);
    ASSERT_NE(pixels, nullptr);
    EXPECT_EQ(width, 17);
    EXPECT_EQ(height, 9);
    EXPECT_TRUE(std::equal(pixels, pixels + 3 * 17 * 9, picture.row(0)));
    stbi_image_free(pixels);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
    std::filesystem::remove_all(folder);
}

TEST(Picture, unwritable_place_is_named) {
    const Status status = filled(2, 2, 0).save_png("/nonexistent-folder/a.png");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message.rfind("/nonexistent-folder/a.png: ", 0), 0u);
}

TEST(Picture, label_writes_white_letters_on_a_dark_band_and_nothing_below) {
    Picture picture = filled(200, 100, 120);
    picture.label("frame 7");
    int white = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 200; ++x) white += picture.row(y)[3 * x] == 255;
    EXPECT_GT(white, 40);
    EXPECT_EQ(picture.row(0)[0], 24);
    EXPECT_EQ(picture.row(60)[0], 120);
    Picture tiny(1, 1);
    tiny.label("longer than the picture");
}

TEST(Picture, sheet_holds_four_pictures) {
    const Picture all = sheet(filled(4, 3, 1), filled(4, 3, 2), filled(4, 3, 3), filled(4, 3, 4));
    EXPECT_EQ(all.width(), 8);
    EXPECT_EQ(all.height(), 6);
    EXPECT_EQ(all.row(0)[0], 1);
    EXPECT_EQ(all.row(0)[3 * 7], 2);
    EXPECT_EQ(all.row(5)[0], 3);
    EXPECT_EQ(all.row(5)[3 * 7], 4);
}

TEST(Picture, difference_is_red_around_pixels_whose_depth_differs) {
    std::vector<float> a(20 * 10, 1.0f), b = a;
    b[20 * 0 + 4] = 0.5f;  // bottom row, column 4
    const Picture difference = difference_picture(filled(20, 10, 90), a, b);
    EXPECT_EQ(difference.row(9)[3 * 4], 255);
    EXPECT_EQ(difference.row(7)[3 * 6], 255);
    EXPECT_EQ(difference.row(6)[3 * 4], 30);
    EXPECT_EQ(difference.row(0)[0], 30);
}

}  // namespace
}  // namespace rhview::gl
