// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/baked_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <random>

#include "../rho_bytes.h"
#include "rhview/scenes/scene_builder.h"
#include "rhview/scenes/static_instances.h"

namespace rhview {
namespace {

RhoBytes baked(const SceneAndPath& scene, const SceneProvenance& provenance = {"a.glb", "a test"}) {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / (std::string("rhview_scene_") + info->name() + ".rho");
    {
        Result<RhoWriter> writer = RhoWriter::create(file);
        EXPECT_TRUE(writer.ok());
        add_scene_sections(*writer, scene, provenance);
        EXPECT_TRUE(writer->finish().ok());
    }
    const auto bytes = FileBytes::open(file).value();
    std::filesystem::remove(file);
    return {{bytes->bytes().begin(), bytes->bytes().end()}};
}

Result<BakedScene> read(const RhoBytes& file) {
    const Result<RhoFile> parsed = RhoFile::parse(FileBytes::copy_of(file.bytes), "x.rho");
    if (!parsed) return parsed.error();
    return read_scene_sections(*parsed);
}

/// Two vertex formats, two batches of several objects, a mesh placed twice, far from the origin.
SceneAndPath small_scene() {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<glm::vec3> normals(4, glm::vec3(0, 1, 0));
    const std::vector<PackedColour> colours(4, pack_colour({1, 0.5f, 0}));
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    SceneBuilder builder(glm::dvec3(1e7, 3.5, -2e6));
    const MaterialId wall = builder.add_material({"wall", glm::vec3(0.5f), false, false});
    const MaterialId leaves = builder.add_material({"leaves \xc3\xa9", glm::vec3(0, 1, 0), true, true});
    const glm::dmat4 there(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e7 + 5, 3, -2e6, 1);
    builder.add_static(wall, {positions, normals, {}, indices}, there);
    builder.add_static(leaves, {positions, {}, colours, indices}, there);
    builder.add_static(wall, {positions, normals, {}, indices}, there);
    const std::optional<MeshId> mesh = builder.add_mesh(leaves, {positions, {}, colours, indices});
    builder.add_dynamic(*mesh, there);
    builder.add_dynamic(*mesh, there * 2.0 - glm::dmat4(there),
                        {{{}, {1.5, {1, 2, 3}, 0.25}, {4.0, {0, 0, 0}, -1.0}}});
    const std::optional<MeshId> stone = builder.add_mesh(wall, {positions, normals, {}, indices});
    for (const double x : {1.0, -2.0}) {
        glm::dmat4 place = there;
        place[0][0] = x;
        builder.add_instance(*stone, place);
    }
    builder.add_warning("something was left out");
    Scene scene = builder.finish("small").value();
    CameraPath path = walkthrough_of_scene(scene);
    return {std::move(scene), std::move(path)};
}

void expect_equal(const SceneAndPath& a, const SceneAndPath& b) {
    EXPECT_EQ(a.scene.name, b.scene.name);
    EXPECT_EQ(a.scene.origin, b.scene.origin);
    EXPECT_EQ(a.scene.warnings, b.scene.warnings);
    EXPECT_EQ(a.scene.dropped_triangles, b.scene.dropped_triangles);
    ASSERT_EQ(a.scene.materials.size(), b.scene.materials.size());
    for (std::size_t i = 0; i < a.scene.materials.size(); ++i) {
        EXPECT_EQ(a.scene.materials[i].name, b.scene.materials[i].name);
        EXPECT_EQ(a.scene.materials[i].colour, b.scene.materials[i].colour);
        EXPECT_EQ(a.scene.materials[i].two_sided, b.scene.materials[i].two_sided);
        EXPECT_EQ(a.scene.materials[i].alpha_tested, b.scene.materials[i].alpha_tested);
    }
    ASSERT_EQ(a.scene.pools.size(), b.scene.pools.size());
    for (std::size_t i = 0; i < a.scene.pools.size(); ++i) {
        EXPECT_EQ(a.scene.pools[i].positions, b.scene.pools[i].positions);
        EXPECT_EQ(a.scene.pools[i].normals, b.scene.pools[i].normals);
        EXPECT_EQ(a.scene.pools[i].colours, b.scene.pools[i].colours);
    }
    ASSERT_EQ(a.scene.batches.size(), b.scene.batches.size());
    for (std::size_t i = 0; i < a.scene.batches.size(); ++i) {
        EXPECT_EQ(a.scene.batches[i].material, b.scene.batches[i].material);
        EXPECT_EQ(a.scene.batches[i].pool, b.scene.batches[i].pool);
        EXPECT_EQ(a.scene.batches[i].indices, b.scene.batches[i].indices);
        ASSERT_EQ(a.scene.batches[i].objects.size(), b.scene.batches[i].objects.size());
        for (std::size_t o = 0; o < a.scene.batches[i].objects.size(); ++o)
            EXPECT_EQ(a.scene.batches[i].objects[o].bounds, b.scene.batches[i].objects[o].bounds);
    }
    ASSERT_EQ(a.scene.meshes.size(), b.scene.meshes.size());
    for (std::size_t i = 0; i < a.scene.meshes.size(); ++i) {
        EXPECT_EQ(a.scene.meshes[i].indices, b.scene.meshes[i].indices);
        EXPECT_EQ(a.scene.meshes[i].bounds, b.scene.meshes[i].bounds);
        EXPECT_EQ(a.scene.meshes[i].material, b.scene.meshes[i].material);
    }
    ASSERT_EQ(a.scene.dynamic_objects.size(), b.scene.dynamic_objects.size());
    for (std::size_t i = 0; i < a.scene.dynamic_objects.size(); ++i)
        EXPECT_EQ(a.scene.dynamic_objects[i].scene_from_mesh, b.scene.dynamic_objects[i].scene_from_mesh);
    for (std::size_t i = 0; i < a.scene.dynamic_objects.size(); ++i)
        EXPECT_EQ(a.scene.dynamic_objects[i].motion, b.scene.dynamic_objects[i].motion);
    ASSERT_EQ(a.scene.motions.size(), b.scene.motions.size());
    for (std::size_t i = 0; i < a.scene.motions.size(); ++i) {
        ASSERT_EQ(a.scene.motions[i].keys.size(), b.scene.motions[i].keys.size());
        for (std::size_t k = 0; k < a.scene.motions[i].keys.size(); ++k) {
            EXPECT_EQ(a.scene.motions[i].keys[k].time_s, b.scene.motions[i].keys[k].time_s);
            EXPECT_EQ(a.scene.motions[i].keys[k].offset, b.scene.motions[i].keys[k].offset);
            EXPECT_EQ(a.scene.motions[i].keys[k].turns, b.scene.motions[i].keys[k].turns);
        }
    }
    ASSERT_EQ(a.scene.static_instances.size(), b.scene.static_instances.size());
    for (std::size_t i = 0; i < a.scene.static_instances.size(); ++i) {
        EXPECT_EQ(a.scene.static_instances[i].mesh, b.scene.static_instances[i].mesh);
        EXPECT_EQ(a.scene.static_instances[i].scene_from_mesh, b.scene.static_instances[i].scene_from_mesh);
        EXPECT_EQ(a.scene.static_instances[i].bounds, b.scene.static_instances[i].bounds);
    }
    EXPECT_EQ(a.scene.instancing, b.scene.instancing);
    ASSERT_EQ(a.path.keys.size(), b.path.keys.size());
    EXPECT_EQ(a.path.far_m, b.path.far_m);
    for (std::size_t i = 0; i < a.path.keys.size(); ++i) {
        EXPECT_EQ(a.path.keys[i].time_s, b.path.keys[i].time_s);
        EXPECT_EQ(a.path.keys[i].eye, b.path.keys[i].eye);
        EXPECT_EQ(a.path.keys[i].target, b.path.keys[i].target);
    }
}

TEST(BakedScene, comes_back_as_it_was) {
    SceneAndPath scene = small_scene();
    scene.path.far_m = INFINITY;
    ASSERT_TRUE(settle_instances(scene.scene, {InstancePolicy::Keep, {}, 77}).ok());
    ASSERT_EQ(scene.scene.instancing.kept_placements, 2u);
    const Result<BakedScene> back = read(baked(scene));
    ASSERT_TRUE(back.ok()) << back.error().message;
    expect_equal(back->scene, scene);
    EXPECT_EQ(back->provenance.source, "a.glb");
    EXPECT_EQ(back->provenance.baked_by, "a test");
    // Baked again, it is the same file.
    EXPECT_EQ(baked(back->scene, back->provenance).bytes, baked(scene).bytes);
}

TEST(BakedScene, named_scenes_come_back_and_outlive_the_file) {
    for (const char* spec : {"town:size=64,materials=3", "farm:instances=5,mesh=1000", "crowd:objects=20",
                             "plant:objects=200"}) {
        const SceneAndPath scene = make_named_scene(spec).value();
        SceneAndPath copy;
        {
            const Result<BakedScene> back = read(baked(scene));
            ASSERT_TRUE(back.ok()) << back.error().message;
            copy = back->scene;
        }
        expect_equal(copy, scene);
    }
}

TEST(BakedScene, a_change_to_a_loaded_scene_is_its_own) {
    const SceneAndPath scene = small_scene();
    const RhoBytes file = baked(scene);
    const auto bytes = FileBytes::copy_of(file.bytes);
    const RhoFile parsed = RhoFile::parse(bytes, "x.rho").value();
    BakedScene back = read_scene_sections(parsed).value();
    back.scene.scene.pools[0].positions.own()[0] = glm::vec3(9);
    EXPECT_EQ(read_scene_sections(parsed)->scene.scene.pools[0].positions[0],
              scene.scene.pools[0].positions[0]);
    EXPECT_EQ(back.scene.scene.pools[0].positions[0], glm::vec3(9));
}

TEST(BakedScene, what_contradicts_itself_is_told_by_name) {
    const SceneAndPath good = small_scene();
    using Damage = std::function<void(SceneAndPath&)>;
    const double nan = std::nan("");
    const std::vector<std::pair<Damage, const char*>> cases{
        {[](auto& s) { s.scene.batches[1].indices.own()[4] = 0xffffffffu; },
         "batch 1: an index is not below"},
        {[](auto& s) { s.scene.batches[1].indices.own()[4] = 1000; }, "batch 1: an index is not below"},
        {[](auto& s) { s.scene.batches[1].indices.own().pop_back(); }, "batch 1: its index count"},
        {[](auto& s) { s.scene.batches[0].material = MaterialId{2}; },
         "batch 0: its material is not in the list"},
        {[](auto& s) { s.scene.batches[0].pool = 2; }, "batch 0: its vertex pool is not in the list"},
        {[](auto& s) { s.scene.batches[0].objects.own()[1].first_index = 3; },
         "batch 0: its objects don't follow"},
        {[](auto& s) { s.scene.batches[0].objects.own()[0].index_count = 0xfffffffdu; },
         "batch 0: its objects"},
        {[](auto& s) { s.scene.batches[0].objects.own().pop_back(); }, "batch 0: its objects don't cover"},
        {[](auto& s) { s.scene.batches[0].objects.own()[0].bounds = {}; },
         "batch 0: an object's box is none"},
        {[](auto& s) { s.scene.meshes[0].indices.own()[0] = 1000; }, "mesh 0: an index is not below"},
        {[](auto& s) { s.scene.meshes[0].bounds.max.x = INFINITY; }, "mesh 0: its box is none"},
        {[=](auto& s) { s.scene.dynamic_objects[1].scene_from_mesh[3][0] = nan; }, "object 1: its placement"},
        {[](auto& s) { s.scene.dynamic_objects[1].scene_from_mesh[0][3] = 1; }, "object 1: its placement"},
        {[](auto& s) { s.scene.dynamic_objects[0].motion = 1; }, "object 0: its way"},
        {[](auto& s) { s.scene.motions[0].keys[1].time_s = 9; }, "way 0: its times"},
        {[=](auto& s) { s.scene.motions[0].keys[1].turns = nan; }, "way 0: a key"},
        {[](auto& s) { s.scene.static_instances[0].scene_from_mesh[0] = {}; },
         "instance 0: its placement can't be drawn through"},
        {[=](auto& s) { s.scene.static_instances[0].scene_from_mesh[3][1] = nan; },
         "instance 0: its placement can't be drawn through"},
        {[](auto& s) { s.scene.static_instances[1].scene_from_mesh[2][3] = 1; },
         "instance 1: its placement can't be drawn through"},
        {[](auto& s) { s.scene.static_instances[1].bounds = {}; }, "instance 1: its box is none"},
        {[](auto& s) { s.scene.static_instances[1].bounds.max.y = INFINITY; }, "instance 1: its box is none"},
        {[=](auto& s) { s.scene.instancing.chosen_ns = nan; }, "a modelled time"},
        {[](auto& s) { s.scene.instancing.all_kept_ns = -1; }, "a modelled time"},
        {[](auto& s) { s.scene.materials[1].colour.x = NAN; }, "material 1: its colour"},
        {[=](auto& s) { s.scene.origin.z = nan; }, "origin is not finite"},
        {[](auto& s) { s.path.keys.clear(); }, "the camera path: "},
        {[](auto& s) { s.path.keys[1].time_s = -1; }, "the camera path: "},
        {[](auto& s) { s.scene.pools[0].normals.own().pop_back(); }, "section SNRM: it holds more or fewer"},
        {[](auto& s) { s.scene.pools[1].colours.own().push_back({}); },
         "section SCOL: it holds more or fewer"},
    };
    for (const auto& [damage, words] : cases) {
        SceneAndPath scene = good;
        damage(scene);
        const Result<BakedScene> back = read(baked(scene));
        if (back.ok()) {
            ADD_FAILURE() << "accepted, though " << words;
            continue;
        }
        EXPECT_NE(back.error().message.find(words), std::string::npos)
            << back.error().message << " lacks " << words;
    }
    // A mesh that is not there can't even be counted: put in place in the bytes.
    RhoBytes file = baked(good);
    file.bytes[file.offset_of("SCNE") + 40] ^= std::byte{1};
    file.repair();
    EXPECT_FALSE(read(file).ok());
    // The second instance's mesh stands before the -2 that its placement begins with.
    file = baked(good);
    std::size_t place = file.offset_of("SCNE");
    while (file.get<double>(place) != -2.0) ++place;
    ASSERT_EQ(file.get<std::uint32_t>(place - 4), 1u);
    file.set<std::uint32_t>(place - 4, 2);
    file.repair();
    ASSERT_FALSE(read(file).ok());
    EXPECT_NE(read(file).error().message.find("instance 1: its mesh is not in the list"), std::string::npos);
}

TEST(BakedScene, description_without_instances_of_an_older_program_is_told) {
    RhoBytes file = baked(small_scene());
    file.set<std::uint32_t>(RhoBytes::entry(file.find("SCNE")) + RhoBytes::kEntryVersion, 1);
    file.repair();
    EXPECT_EQ(
        read(file).error().message,
        "x.rho: section SCNE is of version 1, and this program reads none before 2; bake the scene again "
        "with this program");
}

TEST(BakedScene, description_without_motions_of_an_older_program_is_read) {
    SceneAndPath scene = small_scene();
    scene.scene.motions.clear();
    for (DynamicObject& object : scene.scene.dynamic_objects) object.motion = DynamicObject::kStill;
    RhoBytes file = baked(scene);
    // Version 2 ended before the number of motions and each object's.
    const std::size_t begin = file.offset_of("SCNE");
    const auto size = static_cast<std::size_t>(
        file.get<std::uint64_t>(RhoBytes::entry(file.find("SCNE")) + RhoBytes::kEntrySize));
    const std::vector<std::byte> content(
        file.bytes.begin() + static_cast<std::ptrdiff_t>(begin),
        file.bytes.begin() + static_cast<std::ptrdiff_t>(begin + size - 8 - 2 * 4));
    file.replace("SCNE", content);
    file.set<std::uint32_t>(RhoBytes::entry(file.find("SCNE")) + RhoBytes::kEntryVersion, 2);
    file.repair();
    const Result<BakedScene> back = read(file);
    ASSERT_TRUE(back.ok()) << back.error().message;
    expect_equal(back->scene, scene);
}

TEST(BakedScene, scene_of_instances_alone_comes_back) {
    SceneAndPath scene = small_scene();
    scene.scene.batches.clear();
    scene.scene.dynamic_objects.clear();
    const Result<BakedScene> back = read(baked(scene));
    ASSERT_TRUE(back.ok()) << back.error().message;
    expect_equal(back->scene, scene);
    scene.scene.static_instances.clear();
    EXPECT_FALSE(read(baked(scene)).ok());
}

TEST(BakedScene, description_of_absurd_counts_allocates_nothing_for_them) {
    const RhoBytes good = baked(small_scene());
    const std::size_t begin = good.offset_of("SCNE");
    const auto size = good.get<std::uint64_t>(RhoBytes::entry(good.find("SCNE")) + RhoBytes::kEntrySize);
    std::size_t refused = 0;
    for (std::size_t place = begin; place + 8 <= begin + size; ++place) {
        RhoBytes file = good;
        file.set<std::uint64_t>(place, 0x00ffffffffffffffull);
        file.repair();
        refused += read(file).ok() ? 0 : 1;
    }
    EXPECT_GT(refused, size / 3);
}

TEST(BakedScene, description_cut_short_or_too_long_is_told) {
    const RhoBytes good = baked(small_scene());
    const std::size_t begin = good.offset_of("SCNE");
    const auto size = good.get<std::uint64_t>(RhoBytes::entry(good.find("SCNE")) + RhoBytes::kEntrySize);
    const std::vector<std::byte> content(good.bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                                         good.bytes.begin() + static_cast<std::ptrdiff_t>(begin + size));
    for (std::size_t cut = 0; cut <= size + 1; ++cut) {
        std::vector<std::byte> part = content;
        part.resize(cut);
        RhoBytes file = good;
        file.replace("SCNE", part);
        file.repair();
        EXPECT_EQ(read(file).ok(), cut == size) << cut;
    }
}

TEST(BakedScene, wild_bytes_with_checksums_that_fit_are_refused_or_count_in_bounds) {
    const RhoBytes good = baked(small_scene());
    const std::size_t content = good.offset_of("SCNE");
    std::mt19937 random(9);
    int refused = 0, read_whole = 0;
    for (int round = 0; round < 5000; ++round) {
        RhoBytes file = good;
        for (unsigned change = 0; change <= random() % 3; ++change)
            file.bytes[content + random() % (file.bytes.size() - content)] =
                static_cast<std::byte>(random() >> 13);
        file.repair();
        const Result<BakedScene> back = read(file);
        ++(back.ok() ? read_whole : refused);
        if (!back.ok()) continue;
        const Scene& scene = back->scene.scene;
        EXPECT_FALSE(scene.bounds().is_empty());
        EXPECT_TRUE(validate(back->scene.path).ok());
        for (const TriangleBatch& batch : scene.triangle_batches())
            for (const std::uint32_t index : batch.indices) EXPECT_LT(index, batch.positions.size());
    }
    EXPECT_GT(refused, 500);
    EXPECT_GT(read_whole, 500);
}

}  // namespace
}  // namespace rhview
