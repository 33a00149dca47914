// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/lod/baked_lod.h"

#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <limits>

#include "meshes.h"
#include "rho_bytes.h"

namespace rhview {
namespace {

std::vector<LodChain> some_chains() {
    const std::vector<TestMesh> meshes{rippled_torus(20, 50, 0.02), wavy_sheet(3), wavy_sheet(30),
                                       TestMesh{}};
    std::vector<LodMesh> spans;
    for (const TestMesh& mesh : meshes) spans.push_back(mesh.mesh());
    return build_lod_chains(spans, {}).value();
}

/// A file with these chains.
RhoBytes bake(const std::vector<LodChain>& chains) {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / (std::string("rhview_lod_") + info->name() + ".rho");
    Result<RhoWriter> writer = RhoWriter::create(file);
    add_lod_sections(*writer, chains);
    EXPECT_TRUE(writer->finish().ok());
    const auto bytes = FileBytes::open(file).value();
    RhoBytes result{{bytes->bytes().begin(), bytes->bytes().end()}};
    std::filesystem::remove(file);
    return result;
}

auto read(const RhoBytes& bytes) {
    const Result<RhoFile> file = RhoFile::parse(FileBytes::copy_of(bytes.bytes), "a.rho");
    EXPECT_TRUE(file.ok());
    return read_lod_sections(*file);
}

TEST(BakedLod, chains_come_back_as_they_were_without_a_copy) {
    const std::vector<LodChain> chains = some_chains();
    const RhoBytes bytes = bake(chains);
    const auto owner = FileBytes::copy_of(bytes.bytes);
    const auto back = read_lod_sections(RhoFile::parse(owner, "a.rho").value());
    ASSERT_TRUE(back.ok() && back->has_value());
    ASSERT_EQ((*back)->size(), chains.size());
    for (std::size_t i = 0; i < chains.size(); ++i) {
        const LodChain& chain = (**back)[i];
        EXPECT_EQ(chain.levels, chains[i].levels);
        EXPECT_EQ(chain.indices, chains[i].indices);
        EXPECT_EQ(chain.vertex_count, chains[i].vertex_count);
        EXPECT_EQ(chain.end, chains[i].end);
    }
    const auto* first = reinterpret_cast<const std::byte*>((**back)[0].indices.data());
    EXPECT_GE(first, owner->bytes().data());
    EXPECT_LT(first, owner->bytes().data() + owner->bytes().size());
}

TEST(BakedLod, a_file_without_chains_has_none_and_one_without_meshes_an_empty_list) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "rhview_lod_none.rho";
    Result<RhoWriter> writer = RhoWriter::create(file);
    writer->add_owned(section_tag("SOME"), 1, {});
    ASSERT_TRUE(writer->finish().ok());
    const auto none = read_lod_sections(RhoFile::open(file).value());
    std::filesystem::remove(file);
    ASSERT_TRUE(none.ok());
    EXPECT_FALSE(none->has_value());
    const auto empty = read(bake({}));
    ASSERT_TRUE(empty.ok() && empty->has_value());
    EXPECT_TRUE((*empty)->empty());
}

struct Damage {
    const char* tag;
    std::size_t offset;
    std::uint32_t value;
    const char* sentence;
};

TEST(BakedLod, records_that_contradict_each_other_are_named) {
    const std::vector<LodChain> chains = some_chains();
    const RhoBytes good = bake(chains);
    ASSERT_TRUE(read(good).ok());
    constexpr std::size_t kChain = 32, kLevel = 16;
    const auto infinity = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
    const std::vector<Damage> damages{
        {"LCHN", 24, 0, "section LCHN: chain 0: its levels are not in section LLEV"},
        {"LCHN", 24, ~0u, "section LCHN: chain 0: its levels are not in section LLEV"},
        {"LCHN", 28, 6, "section LCHN: chain 0: there is no such reason for its end"},
        {"LCHN", 0, 9, "section LCHN: chain 0: an index is not below its number of vertices"},
        {"LCHN", 16, 9, "section LCHN: chain 0: it has more or fewer indices than its levels"},
        {"LCHN", 20, 9, "section LCHN: chain 0: its indices are not in section LIDX, or leave a gap"},
        {"LCHN", kChain + 8, 9, "section LCHN: chain 1: its indices are not in section LIDX, or leave a gap"},
        {"LLEV", 0, 1, "section LCHN: chain 0: its level 0 is not the mesh itself"},
        {"LLEV", 4, 7, "section LCHN: chain 0: its level 0 is not the mesh itself"},
        {"LLEV", kLevel, 3,
         "section LLEV: chain 0, level 1: its indices do not follow those of the one before"},
        {"LLEV", kLevel + 4, 7,
         "section LLEV: chain 0, level 1: its index count is none, or no multiple of three"},
        {"LLEV", kLevel + 4, 0,
         "section LLEV: chain 0, level 1: its index count is none, or no multiple of three"},
        {"LLEV", kLevel + 4, 999'999,
         "section LLEV: chain 0, level 1: it is not smaller than the one before"},
        {"LLEV", kLevel + 8, infinity,
         "section LLEV: chain 0, level 1: its error is not finite, or below that of the one before"},
        {"LLEV", kLevel + 8, 0,
         "section LLEV: chain 0, level 1: its error is not finite, or below that of the one before"},
        {"LLEV", kLevel + 12, 2, "section LLEV: chain 0, level 1: it is not known whether it is sloppy"},
        {"LIDX", 0, 1'000'000, "section LCHN: chain 0: an index is not below its number of vertices"},
    };
    for (const Damage& damage : damages) {
        RhoBytes bad = good;
        bad.set(bad.offset_of(damage.tag) + damage.offset, damage.value);
        bad.repair();
        const auto result = read(bad);
        ASSERT_FALSE(result.ok()) << damage.tag << " " << damage.offset;
        EXPECT_NE(result.error().message.find(damage.sentence), std::string::npos) << result.error().message;
    }
}

TEST(BakedLod, what_belongs_to_no_chain_is_refused) {
    const RhoBytes good = bake(some_chains());
    for (const char* tag : {"LLEV", "LIDX"}) {
        RhoBytes bad = good;
        const auto size = bad.get<std::uint64_t>(RhoBytes::entry(bad.find(tag)) + RhoBytes::kEntrySize);
        std::vector<std::byte> content(
            bad.bytes.begin() + static_cast<std::ptrdiff_t>(bad.offset_of(tag)),
            bad.bytes.begin() + static_cast<std::ptrdiff_t>(bad.offset_of(tag) + size));
        content.resize(content.size() + 48);
        bad.replace(tag, content);
        bad.repair();
        const auto result = read(bad);
        ASSERT_FALSE(result.ok());
        EXPECT_NE(result.error().message.find("of no chain"), std::string::npos) << result.error().message;
    }
}

TEST(BakedLod, damaged_bytes_are_found_by_their_checksum) {
    RhoBytes bad = bake(some_chains());
    bad.bytes[bad.offset_of("LIDX") + 5] ^= std::byte{1};
    const auto result = read(bad);
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().message.find("section LIDX"), std::string::npos);
}

}  // namespace
}  // namespace rhview
