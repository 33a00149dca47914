// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "program.h"

namespace rhview::cli {
namespace {

struct RealScene {
    const char* file;
    std::uint64_t triangles;
};

class RealScenes : public ProgramTest, public testing::WithParamInterface<RealScene> {};

TEST_P(RealScenes, no_method_misses_a_pixel) {
    const std::filesystem::path file = std::filesystem::path(RHVIEW_SHARED_SCENES_DIR) / GetParam().file;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "the real test scenes are not here: " << file;
    for (const std::string method : {"none", "frustum", "octree", "rhview-seed"}) {
        for (const std::string how : {"flatten", "keep", "auto"}) {
            const nlohmann::json walk = walk_json("'" + file.string() +
                                                  "' --frames 6 --warmup 0 --size 320x180 --leaf 500 --check "
                                                  "--set c1=3.5,c3=220 --method " +
                                                  method + " --instances " + how);
            EXPECT_EQ(walk["scene"]["triangles"], GetParam().triangles);
            EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0) << method << " " << how;
            EXPECT_GT(walk["summary"]["indices"]["mean"], 0) << method << " " << how;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RealScenes,
                         testing::Values(RealScene{"intel_castle.glb", 1070891},
                                         RealScene{"stk_candela_city.glb", 429312},
                                         RealScene{"bsp_nexuiz_ons-reborn.glb", 125091},
                                         RealScene{"rvm_huldra_wd1_psup.glb", 85240}),
                         [](const auto& test) { return test_name(test.param.file); });

}  // namespace
}  // namespace rhview::cli
