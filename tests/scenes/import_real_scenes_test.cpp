// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Counts as the scenes' own table gives them; objects are node × primitive, counted from the files' JSON.

#include <algorithm>

#include "import_test_files.h"
#include "rhview/scenes/static_instances.h"

namespace rhview {
namespace {

struct RealScene {
    const char* file;
    std::uint64_t triangles;
    std::uint64_t stored_triangles;
    std::uint64_t objects;
    std::size_t materials;
    std::ptrdiff_t two_sided;
    std::ptrdiff_t alpha_tested;
};

void PrintTo(const RealScene& scene, std::ostream* stream) {
    *stream << scene.file;
}

class ImportRealScene : public testing::TestWithParam<RealScene> {};

TEST_P(ImportRealScene, has_the_published_counts) {
    const RealScene& expected = GetParam();
    const std::filesystem::path file = std::filesystem::path(RHVIEW_SHARED_SCENES_DIR) / expected.file;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << expected.file << " is not on this machine";
    const Result<Scene> scene = import_scene(file);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->static_triangles(), expected.triangles);
    EXPECT_EQ(scene->static_objects(), expected.objects);
    ASSERT_EQ(scene->materials.size(), expected.materials);
    const auto& materials = scene->materials;
    EXPECT_EQ(
        std::count_if(materials.begin(), materials.end(), [](const Material& m) { return m.two_sided; }),
        expected.two_sided);
    EXPECT_EQ(
        std::count_if(materials.begin(), materials.end(), [](const Material& m) { return m.alpha_tested; }),
        expected.alpha_tested);
    EXPECT_EQ(scene->dropped_triangles, 0u);
    EXPECT_TRUE(scene->warnings.empty());
    EXPECT_LE(scene->batches.size(), expected.materials);
    expect_sound(scene, file);
}

TEST_P(ImportRealScene, is_stored_as_its_author_did_and_comes_out_whole_when_flattened) {
    const RealScene& expected = GetParam();
    const std::filesystem::path file = std::filesystem::path(RHVIEW_SHARED_SCENES_DIR) / expected.file;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << expected.file << " is not on this machine";
    Result<Scene> scene = import_scene(file, RepeatedMeshes::Keep);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->static_triangles(), expected.triangles);
    EXPECT_EQ(scene->static_objects(), expected.objects);
    EXPECT_EQ(scene->index_bytes() / 12, expected.stored_triangles);
    for (const InstancePolicy policy : {InstancePolicy::Auto, InstancePolicy::Flatten}) {
        ASSERT_TRUE(settle_instances(*scene, {policy, {3.5, 220}, kDefaultInstanceBudget}).ok());
        EXPECT_EQ(scene->static_triangles(), expected.triangles);
        EXPECT_EQ(scene->static_objects(), expected.objects);
        expect_sound(scene, file);
    }
    EXPECT_TRUE(scene->static_instances.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Shared, ImportRealScene,
    testing::Values(RealScene{"0ad_napata_reconstruction.glb", 8977234, 697631, 30055, 24, 8, 8},
                    RealScene{"intel_castle.glb", 1070891, 139619, 2114, 31, 0, 0},
                    RealScene{"intel_castle_market_substitute.glb", 1921276, 172491, 28414, 17, 0, 0},
                    RealScene{"stk_candela_city.glb", 429312, 124210, 2865, 92, 3, 3},
                    RealScene{"bsp_nexuiz_ons-reborn.glb", 125091, 125091, 1795, 71, 2, 2},
                    RealScene{"rvm_pmuc_plm_sample.glb", 31746, 31746, 646, 4, 0, 0},
                    RealScene{"rvm_huldra_wd1_psup.glb", 85240, 85240, 2628, 1, 0, 0}),
    [](const testing::TestParamInfo<RealScene>& instance) {
        std::string name = instance.param.file;
        name = name.substr(0, name.rfind('.'));
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
        return name;
    });

}  // namespace
}  // namespace rhview
