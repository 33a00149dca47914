// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/executor.h"

#include <epoxy/gl.h>

#include <glm/gtc/matrix_transform.hpp>

#include "gl_fixture.h"
#include "rhview/gl/line_drawer.h"
#include "rhview/gl/timer.h"
#include "rhview/scenes/static_instances.h"

namespace rhview::gl {
namespace {

/// Two materials (the second two-sided), two triangles each.
Scene two_materials() {
    SceneBuilder builder;
    const MaterialId plain = builder.add_material({"plain", {1, 0, 0}, false, false});
    const MaterialId two_sided = builder.add_material({"two-sided", {0, 1, 0}, true, false});
    for (const MaterialId material : {plain, two_sided})
        for (const double x : {-2.0, 2.0})
            builder.add_static(
                material, triangle_piece(),
                glm::translate(glm::dmat4(1.0), glm::dvec3(x, material == plain ? 1.0 : -1.0, 0)));
    return builder.finish("two materials").value();
}

FramePlan whole_of(const Scene& scene) {
    FramePlan plan;
    std::uint32_t first = 0;
    for (std::uint32_t b = 0; b < scene.batches.size(); ++b) {
        for (const SceneObject& object : scene.batches[b].objects)
            plan.opaque.push_back({BatchId{b}, first + object.first_index, object.index_count});
        first += static_cast<std::uint32_t>(scene.batches[b].indices.size());
    }
    for (std::uint32_t i = 0; i < scene.object_count(); ++i) plan.objects.push_back(ObjectId{i});
    return plan;
}

TEST_F(GlTest, counts_calls_sub_draws_and_indices_of_plain_and_multi_draws) {
    const Scene scene = two_materials();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    const std::vector<float> plain = depths_of(whole_of(scene), buffers, view);
    EXPECT_EQ(counters_.draw_calls, 4u);
    EXPECT_EQ(counters_.sub_draws, 4u);
    EXPECT_EQ(counters_.indices, 12u);
    const std::vector<float> multi =
        depths_of(whole_of(scene), buffers, view, {.submission = Submission::MultiDraw, .colour = {}});
    EXPECT_EQ(counters_.draw_calls, 2u);
    EXPECT_EQ(counters_.sub_draws, 4u);
    EXPECT_EQ(counters_.indices, 12u);
    EXPECT_GT(covered_pixels(plain), 500u);
    EXPECT_EQ(count_missing_pixels(plain, multi), 0u);
    depths_of({}, buffers, view);
    EXPECT_EQ(counters_.draw_calls, 0u);
}

TEST_F(GlTest, back_faces_are_drawn_for_two_sided_materials_only) {
    const Scene scene = two_materials();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    const std::size_t front =
        covered_pixels(depths_of(whole_of(scene), buffers, view_at({0, 0, 0}, {0, 0, -1})));
    const std::size_t back =
        covered_pixels(depths_of(whole_of(scene), buffers, view_at({0, 0, -10}, {0, 0, 1})));
    EXPECT_NEAR(static_cast<double>(back), static_cast<double>(front) / 2.0, 20.0);
}

TEST_F(GlTest, mirrored_dynamic_object_shows_its_front) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    const MeshId mesh = builder.add_mesh(material, triangle_piece()).value();
    builder.add_dynamic(mesh, glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1)));
    const Scene scene = builder.finish("mirrored").value();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    EXPECT_GT(covered_pixels(depths_of(whole_of(scene), buffers, view_at({0, 0, 0}, {0, 0, -1}))), 500u);
    EXPECT_EQ(counters_.indices, 3u);
    EXPECT_EQ(covered_pixels(depths_of(whole_of(scene), buffers, view_at({0, 0, -10}, {0, 0, 1}))), 0u);
}

TEST_F(GlTest, colours_come_from_vertices_materials_or_the_override) {
    SceneBuilder builder;
    const MaterialId red = builder.add_material({"red", {1, 0, 0}, false, false});
    const std::vector<PackedColour> blue(3, pack_colour({0, 0, 1}));
    builder.add_static(red, triangle_piece(), glm::translate(glm::dmat4(1.0), glm::dvec3(-1.5, 0, 0)));
    MeshPiece coloured = triangle_piece();
    coloured.colours = blue;
    builder.add_static(red, coloured, glm::translate(glm::dmat4(1.0), glm::dvec3(1.5, 0, 0)));
    const Scene scene = builder.finish("colours").value();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    const auto pixel = [](const Picture& picture, int x) {
        const std::uint8_t* p = picture.row(picture.height() / 2) + 3 * x;
        return glm::ivec3(p[0], p[1], p[2]);
    };
    depths_of(whole_of(scene), buffers, view);
    const Picture own = target_->read_colour();
    const int left = 80 - 33, right = 80 + 33;
    EXPECT_GT(pixel(own, left).r, 100);
    EXPECT_EQ(pixel(own, left).b, 0);
    EXPECT_GT(pixel(own, right).b, 100);
    EXPECT_EQ(pixel(own, right).r, 0);
    depths_of(whole_of(scene), buffers, view,
              {.submission = Submission::Plain, .colour = glm::vec3(0, 1, 0)});
    const Picture green = target_->read_colour();
    EXPECT_GT(pixel(green, left).g, 100);
    EXPECT_EQ(pixel(green, right).b, 0);
}

TEST_F(GlTest, smooth_normals_are_lit_differently_from_each_side_of_a_surface) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    const std::vector<glm::vec3> towards_sun(3, glm::vec3(0.48f, 0.74f, 0.47f)),
        away(3, glm::vec3(-0.48f, -0.74f, -0.47f));
    MeshPiece lit = triangle_piece(), dark = triangle_piece();
    lit.normals = towards_sun;
    dark.normals = away;
    builder.add_static(material, lit, glm::translate(glm::dmat4(1.0), glm::dvec3(-1.5, 0, 0)));
    builder.add_static(material, dark, glm::translate(glm::dmat4(1.0), glm::dvec3(1.5, 0, 0)));
    const Scene scene = builder.finish("normals").value();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    depths_of(whole_of(scene), buffers, view_at({0, 0, 0}, {0, 0, -1}));
    const Picture picture = target_->read_colour();
    const std::uint8_t* row = picture.row(60);
    EXPECT_GT(row[3 * 47 + 1], row[3 * 113 + 1] + 50);
    EXPECT_GT(row[3 * 113 + 1], 30);
}

/// One mesh per way to look: smooth normals, vertex colours, two-sided; each placed straight, turned and
/// mirrored, of one size: where axes are scaled apart, normals that are interpolated before they are turned
/// shade otherwise.
Scene instances_of_all_kinds() {
    SceneBuilder builder(glm::dvec3(1e5, 0, 0));
    const MaterialId plain = builder.add_material({"plain", {0.9f, 0.5f, 0.1f}, false, false});
    const MaterialId leaf = builder.add_material({"leaf", {0.1f, 0.9f, 0.1f}, true, false});
    static const std::vector<glm::vec3> normals{{0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}, {0, 0.8f, 0.6f}};
    static const std::vector<PackedColour> colours{pack_colour({1, 0, 0}), pack_colour({0, 1, 0}),
                                                   pack_colour({0, 0, 1})};
    static const std::vector<std::uint32_t> both_sides{0, 1, 2, 0, 2, 1};
    const MeshPiece pieces[] = {{kTrianglePositions, normals, {}, kTriangleIndices},
                                {kTrianglePositions, {}, colours, kTriangleIndices},
                                {kTrianglePositions, normals, colours, both_sides}};
    for (int p = 0; p < 3; ++p) {
        for (const MaterialId material : {plain, leaf}) {
            const MeshId mesh = builder.add_mesh(material, pieces[p]).value();
            for (int i = 0; i < 4; ++i) {
                glm::dmat4 place = glm::translate(
                    glm::dmat4(1.0), glm::dvec3(1e5 + 2.4 * i - 4, 2.4 * p - 2, material == leaf ? -4 : 0));
                place = glm::scale(place, glm::dvec3(i % 2 ? -0.9 : 0.9, 0.9, 0.9));
                place = glm::translate(place, {0, 0, -5});
                place = glm::rotate(place, 0.4 * i, glm::dvec3(0, 1, 0.2));
                EXPECT_TRUE(builder.add_instance(mesh, glm::translate(place, {0, 0, 5})));
            }
        }
    }
    return builder.finish("kinds").value();
}

TEST_F(GlTest, instances_look_as_if_they_were_flattened) {
    const Scene kept = instances_of_all_kinds();
    Scene flattened = kept;
    ASSERT_TRUE(settle_instances(flattened, {InstancePolicy::Flatten, {}, 0}).ok());
    ASSERT_EQ(flattened.object_count(), 0u);
    ASSERT_EQ(kept.object_count(), 24u);
    for (const double side : {1.0, -1.0}) {
        const View view = view_at({1e5, 0, side > 0 ? 4.0 : -14.0}, {0, 0, -side});
        const SceneBuffers kept_buffers = SceneBuffers::upload(kept).value();
        const std::vector<float> kept_depths = depths_of(whole_of(kept), kept_buffers, view);
        const Picture kept_picture = target_->read_colour();
        EXPECT_EQ(counters_.draw_calls, 24u);
        EXPECT_EQ(counters_.indices, 3u * kept.static_triangles());
        const SceneBuffers flat_buffers = SceneBuffers::upload(flattened).value();
        const std::vector<float> flat_depths = depths_of(whole_of(flattened), flat_buffers, view);
        const Picture flat_picture = target_->read_colour();
        EXPECT_LE(counters_.material_changes, 6u);
        EXPECT_GT(covered_pixels(kept_depths), 2000u);
        // Edges may differ by a pixel, what both cover by little: other arithmetic leads there.
        std::size_t other_pixels = 0;
        for (int y = 0; y < kept_picture.height(); ++y)
            for (int x = 0; x < kept_picture.width(); ++x) {
                int difference = 0;
                for (int c = 0; c < 3; ++c)
                    difference = std::max(difference, std::abs(kept_picture.row(y)[3 * x + c] -
                                                               flat_picture.row(y)[3 * x + c]));
                other_pixels += difference > 3;
            }
        EXPECT_LT(other_pixels, covered_pixels(kept_depths) / 200);
        std::size_t other_depths = 0;
        for (std::size_t i = 0; i < kept_depths.size(); ++i)
            other_depths += std::abs(kept_depths[i] - flat_depths[i]) > 1e-5f;
        EXPECT_LT(other_depths, covered_pixels(kept_depths) / 200);
    }
}

TEST_F(GlTest, state_of_the_application_is_put_back) {
    const Scene scene = two_materials();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    LineDrawer lines = LineDrawer::create().value();
    const auto integer = [](GLenum name) {
        GLint value = -1;
        glGetIntegerv(name, &value);
        return static_cast<GLenum>(value);
    };
    GLuint application_buffer = 0;
    glGenBuffers(1, &application_buffer);
    glBindBuffer(GL_ARRAY_BUFFER, application_buffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
    glDisable(GL_DEPTH_TEST);
    glDepthFunc(GL_NOTEQUAL);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glFrontFace(GL_CW);
    glVertexAttrib4f(1, 1, 2, 3, 4);
    glVertexAttrib4f(2, 5, 6, 7, 8);
    target_->begin(ClipDepth::ZeroToOne, glm::vec3(0));
    const GLenum framebuffer = integer(GL_DRAW_FRAMEBUFFER_BINDING);
    glDepthMask(GL_FALSE);
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    executor_->draw(whole_of(scene), buffers, view_at({0, 0, 0}, {0, 0, -1}, ClipDepth::ZeroToOne));
    Lines box;
    box.add_box({glm::vec3(-1), glm::vec3(1)}, glm::dvec3(0));
    lines.draw(box, view_at({0, 0, 5}, {0, 0, -1}), glm::vec3(1));
    EXPECT_TRUE(SceneBuffers::upload(scene).ok());
    EXPECT_EQ(RenderTarget::create(8, 8).value().read_colour().width(), 8);
    EXPECT_TRUE(check_gpu_timer().ok());
    EXPECT_EQ(integer(GL_ARRAY_BUFFER_BINDING), application_buffer);
    EXPECT_EQ(integer(GL_DRAW_FRAMEBUFFER_BINDING), framebuffer);
    EXPECT_EQ(integer(GL_PACK_ALIGNMENT), 2u);
    EXPECT_EQ(integer(GL_CURRENT_PROGRAM), 0u);
    EXPECT_EQ(integer(GL_VERTEX_ARRAY_BINDING), 0u);
    EXPECT_EQ(integer(GL_DEPTH_FUNC), static_cast<GLenum>(GL_NOTEQUAL));
    EXPECT_EQ(integer(GL_CULL_FACE_MODE), static_cast<GLenum>(GL_FRONT));
    EXPECT_EQ(integer(GL_FRONT_FACE), static_cast<GLenum>(GL_CW));
    EXPECT_EQ(integer(GL_CLIP_ORIGIN), static_cast<GLenum>(GL_UPPER_LEFT));
    EXPECT_EQ(integer(GL_CLIP_DEPTH_MODE), static_cast<GLenum>(GL_NEGATIVE_ONE_TO_ONE));
    EXPECT_EQ(integer(GL_DEPTH_WRITEMASK), 0u);
    EXPECT_TRUE(glIsEnabled(GL_CULL_FACE));
    EXPECT_FALSE(glIsEnabled(GL_DEPTH_TEST));
    GLfloat normal[4] = {}, colour[4] = {};
    glGetVertexAttribfv(1, GL_CURRENT_VERTEX_ATTRIB, normal);
    glGetVertexAttribfv(2, GL_CURRENT_VERTEX_ATTRIB, colour);
    EXPECT_EQ(normal[0], 1.0f);
    EXPECT_EQ(colour[3], 8.0f);
    glDeleteBuffers(1, &application_buffer);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

TEST_F(GlTest, lines_are_drawn_over_everything) {
    LineDrawer lines = LineDrawer::create().value();
    target_->begin(ClipDepth::NegativeOneToOne, glm::vec3(0));
    Lines shapes;
    shapes.add_box({glm::vec3(-1, -1, -6), glm::vec3(1, 1, -5)}, glm::dvec3(0));
    shapes.add_frustum(view_at({0, 0, -5}, {0, 0, -1}), 3.0);
    EXPECT_EQ(shapes.points.size(), 24u + 16u);
    lines.draw(shapes, view_at({0, 0, 0}, {0, 0, -1}), glm::vec3(1, 0, 0));
    const Picture picture = target_->read_colour();
    int red = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) red += picture.row(y)[3 * x] == 255;
    EXPECT_GT(red, 100);
    EXPECT_LT(red, 2000);
}

}  // namespace
}  // namespace rhview::gl
