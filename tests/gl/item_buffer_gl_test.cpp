// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/item_buffer.h"

#include "gl_fixture.h"

namespace rhview::gl {
namespace {

class ItemBufferTest : public GlTest {};

/// Triangles ahead of the origin, each further away; the last one to the right of the others.
SceneBuffers three_in_a_row() {
    SceneBuilder builder;
    const MaterialId grey = builder.add_material({"grey", glm::vec3(0.5f), false, false});
    for (const glm::dvec3 offset : {glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(2.5, 0, -1)}) {
        glm::dmat4 to_world(1.0);
        to_world[3] = glm::dvec4(offset, 1.0);
        builder.add_static(grey, triangle_piece(), to_world);
    }
    return SceneBuffers::upload(builder.finish("row").value()).value();
}

TEST_F(ItemBufferTest, sees_what_is_nearest_in_some_pixel) {
    const SceneBuffers buffers = three_in_a_row();
    ItemBuffer items = ItemBuffer::create(160, 120).value();
    const std::vector<ItemRange> ranges{
        {{BatchId{0}, 0, 3}, 7}, {{BatchId{0}, 3, 3}, 0}, {{BatchId{0}, 6, 3}, 3}};
    for (const ClipDepth depth : {ClipDepth::NegativeOneToOne, ClipDepth::ReversedZeroToOne}) {
        EXPECT_EQ(items.visible_items(ranges, buffers, view_at({0, 0, 0}, {0, 0, -1}, depth)),
                  (std::vector<std::uint32_t>{3, 7}));
        // Without the first, the one behind it is seen; from behind, nothing is.
        EXPECT_EQ(
            items.visible_items(std::span(ranges).subspan(1), buffers, view_at({0, 0, 0}, {0, 0, -1}, depth)),
            (std::vector<std::uint32_t>{0, 3}));
        EXPECT_TRUE(items.visible_items(ranges, buffers, view_at({0, 0, -20}, {0, 0, 1}, depth)).empty());
    }
}

TEST_F(ItemBufferTest, tells_what_each_pixel_shows) {
    const SceneBuffers buffers = three_in_a_row();
    ItemBuffer items = ItemBuffer::create(160, 120).value();
    const std::vector<ItemRange> ranges{{{BatchId{0}, 3, 3}, 0}, {{BatchId{0}, 0, 3}, 7}};
    const auto pixels =
        items.item_pixels(ranges, ItemBuffer::kNoItem, buffers, view_at({0, 0, 0}, {0, 0, -1}));
    ASSERT_EQ(pixels.size(), 160u * 120u);
    EXPECT_EQ(pixels[60 * 160 + 80], 7u);  // the nearer of the two
    EXPECT_EQ(pixels[0], ItemBuffer::kNoItem);
}

TEST_F(ItemBufferTest, leaves_the_target_that_was_bound) {
    const SceneBuffers buffers = three_in_a_row();
    ItemBuffer items = ItemBuffer::create(40, 30).value();
    target_->begin(ClipDepth::NegativeOneToOne, glm::vec3(0.0f));
    const ItemRange range{{BatchId{0}, 0, 3}, 1};
    items.visible_items({&range, 1}, buffers, view_at({0, 0, 0}, {0, 0, -1}));
    FramePlan plan;
    plan.opaque = {range.range};
    executor_->draw(plan, buffers, view_at({0, 0, 0}, {0, 0, -1}));
    std::vector<float> depths;
    target_->read_depth(depths);
    EXPECT_GT(covered_pixels(depths), 0u);
}

}  // namespace
}  // namespace rhview::gl
