// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/rho_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numeric>
#include <random>

#include "../rho_bytes.h"
#include "rhview/base/rho_writer.h"

namespace rhview {
namespace {

constexpr SectionTag kNumbers = section_tag("NUMB");
constexpr SectionTag kText = section_tag("TEXT");
constexpr SectionTag kNothing = section_tag("NONE");

class RhoFileTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(testing::TempDir()) / (std::string("rhview_rho_") + info->name());
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        file_ = folder_ / "small.rho";
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write_small() const {
        const std::vector<std::uint32_t> numbers{1, 2, 3, 5, 8};
        Result<RhoWriter> writer = RhoWriter::create(file_);
        ASSERT_TRUE(writer.ok());
        writer->add_array<std::uint32_t>(kNumbers, 1, numbers);
        writer->add_owned(kText, 2, std::vector<std::byte>(70, std::byte{'x'}));
        writer->add(kNothing, 1, {});
        const Result<std::uint64_t> bytes = writer->finish();
        ASSERT_TRUE(bytes.ok()) << bytes.error().message;
        EXPECT_EQ(*bytes, std::filesystem::file_size(file_));
    }

    [[nodiscard]] RhoBytes small() const {
        write_small();
        std::ifstream stream(file_, std::ios::binary);
        const std::string text(std::istreambuf_iterator<char>(stream), {});
        RhoBytes result;
        for (const char c : text) result.bytes.push_back(static_cast<std::byte>(c));
        return result;
    }

    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
    }

    std::filesystem::path folder_;
    std::filesystem::path file_;
};

/// What is wrong with the file or one of its sections; empty when nothing is.
std::string complaint(const std::vector<std::byte>& bytes) {
    const Result<RhoFile> file = RhoFile::parse(FileBytes::copy_of(bytes), "x.rho");
    if (!file) return file.error().message;
    for (const SectionTag tag : {kNumbers, kText, kNothing})
        if (const auto section = file->section(tag, 2); !section) return section.error().message;
    return {};
}

void expect_sentence(const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << "'" << message << "' lacks '" << words << "'";
    EXPECT_EQ(message.rfind("x.rho: ", 0), 0u) << message;
    EXPECT_TRUE(message.find("bake the scene again") != std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST_F(RhoFileTest, gives_back_the_sections_that_were_written) {
    write_small();
    const Result<RhoFile> file = RhoFile::open(file_);
    ASSERT_TRUE(file.ok()) << file.error().message;
    const auto numbers = file->array<std::uint32_t>(kNumbers, 1);
    ASSERT_TRUE(numbers.ok());
    EXPECT_EQ(*numbers, (MappableArray<std::uint32_t>({1, 2, 3, 5, 8})));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers->data()) % 64, 0u);
    EXPECT_EQ(file->section(kText, 2)->size(), 70u);
    EXPECT_EQ(file->section(kNothing, 1)->size(), 0u);
    EXPECT_TRUE(file->has(kText));
    EXPECT_EQ(file->section(kText, 3, 2)->size(), 70u);
    EXPECT_FALSE(file->has(section_tag("GONE")));
    EXPECT_NE(file->section(section_tag("GONE"), 1).error().message.find("section GONE is missing"),
              std::string::npos);
}

TEST_F(RhoFileTest, sections_of_many_pieces_and_blocks_are_whole_and_outlive_the_reader) {
    std::vector<std::uint64_t> values(400'000);
    std::iota(values.begin(), values.end(), 0u);
    const std::span<const std::uint64_t> all(values);
    Result<RhoWriter> writer = RhoWriter::create(file_);
    ASSERT_TRUE(writer.ok());
    writer->add(kNumbers, 1,
                {std::as_bytes(all.first(1)), std::as_bytes(all.subspan(1, 0)),
                 std::as_bytes(all.subspan(1, 250'000)), std::as_bytes(all.subspan(250'001))});
    ASSERT_TRUE(writer->finish().ok());
    MappableArray<std::uint64_t> kept;
    {
        const Result<RhoFile> file = RhoFile::open(file_);
        ASSERT_TRUE(file.ok());
        kept = file->array<std::uint64_t>(kNumbers, 1).value();
    }
    EXPECT_TRUE(std::ranges::equal(kept, values));
}

TEST_F(RhoFileTest, cut_short_at_any_byte_is_told) {
    const RhoBytes whole = small();
    for (std::size_t size = 0; size < whole.bytes.size(); ++size) {
        RhoBytes cut = whole;
        cut.bytes.resize(size);
        expect_sentence(complaint(cut.bytes), size == 0 ? "is empty" : "is cut short");
        // The same where the header knows no better.
        cut.repair();
        if (size >= RhoBytes::kTable) {
            EXPECT_NE(complaint(cut.bytes), "") << size;
        }
    }
    RhoBytes longer = whole;
    longer.bytes.push_back(std::byte{0});
    expect_sentence(complaint(longer.bytes), "1 bytes after its end");
    longer.repair();
    expect_sentence(complaint(longer.bytes), "1 bytes after the last section");
}

TEST_F(RhoFileTest, any_bit_that_flips_is_told) {
    RhoBytes file = small();
    for (std::size_t i = 0; i < file.bytes.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            file.bytes[i] ^= static_cast<std::byte>(1 << bit);
            EXPECT_NE(complaint(file.bytes), "") << "byte " << i << ", bit " << bit;
            file.bytes[i] ^= static_cast<std::byte>(1 << bit);
        }
    }
    EXPECT_EQ(complaint(file.bytes), "");
}

TEST_F(RhoFileTest, each_field_of_header_and_table_is_checked_by_what_it_says) {
    const RhoBytes whole = small();
    using Damage = std::function<void(RhoBytes&)>;
    const std::size_t numbers = RhoBytes::entry(0), text = RhoBytes::entry(1);
    const auto set64 = [](std::size_t offset, std::uint64_t value) {
        return [=](RhoBytes& file) { file.set<std::uint64_t>(offset, value); };
    };
    const auto set32 = [](std::size_t offset, std::uint32_t value) {
        return [=](RhoBytes& file) { file.set<std::uint32_t>(offset, value); };
    };
    const std::vector<std::pair<Damage, const char*>> cases{
        {set32(0, 0x46546c67), "is not a baked file"},
        {set32(RhoBytes::kVersion, 2), "format version 2, and this program reads up to 1"},
        {set32(RhoBytes::kVersion, 0), "no format version 0"},
        {set32(RhoBytes::kByteOrder, 0x04030201), "big-endian"},
        {set32(RhoBytes::kByteOrder, 7), "byte-order mark"},
        {set32(RhoBytes::kSectionCount, 0xffffffffu), "4294967295 sections"},
        {set32(RhoBytes::kSectionCount, 64), "ends after the file"},
        {set32(RhoBytes::kSectionCount, 2), "hole"},
        {set32(RhoBytes::kZero, 1), "unused bytes"},
        {set32(RhoBytes::kReserved + 20, 1), "unused bytes"},
        {set32(text, 0x424d554e), "section NUMB: is there twice"},
        {set32(numbers, 0x424d554f), "section NUMB is missing"},
        {set32(text, 0x0a0a0a0a), "section TEXT is missing"},
        {set32(text + RhoBytes::kEntryVersion, 3), "version 3, and this program reads up to 2"},
        {set32(text + RhoBytes::kEntryVersion, 0), "no version 0"},
        {set64(text + RhoBytes::kEntryOffset, 260), "no multiple of 64"},
        {set64(text + RhoBytes::kEntryOffset, 128), "is inside what stands before it"},
        {set64(text + RhoBytes::kEntryOffset, 0), "is inside what stands before it"},
        {[&](RhoBytes& file) {
             file.set<std::uint64_t>(text + RhoBytes::kEntryOffset, 320);
             file.set<std::uint64_t>(text + RhoBytes::kEntrySize, 64);
         },
         "hole"},
        {set64(text + RhoBytes::kEntryOffset, std::uint64_t{1} << 63), "end after the file"},
        {set64(text + RhoBytes::kEntryOffset, ~std::uint64_t{63}), "end after the file"},
        {set64(text + RhoBytes::kEntrySize, ~std::uint64_t{0}), "end after the file"},
        {set64(text + RhoBytes::kEntrySize, 0xffffffffffffff00ull), "end after the file"},
        {set64(text + RhoBytes::kEntrySize, 1000), "end after the file"},
        {set64(numbers + RhoBytes::kEntrySize, 100), "is inside what stands before it"},
        {set64(numbers + RhoBytes::kEntrySize, 7), "not zero"},
    };
    for (const auto& [damage, words] : cases) {
        RhoBytes file = whole;
        damage(file);
        file.repair();
        expect_sentence(complaint(file.bytes), words);
    }
    // The two fields that `repair` mends.
    RhoBytes file = whole;
    file.set<std::uint64_t>(RhoBytes::kFileBytes, 1ull << 40);
    expect_sentence(complaint(file.bytes), "is cut short");
    file = whole;
    file.set<std::uint64_t>(RhoBytes::kChecksum, 1);
    expect_sentence(complaint(file.bytes), "header: its checksum");
    file = whole;
    file.bytes[file.offset_of("TEXT")] ^= std::byte{1};
    expect_sentence(complaint(file.bytes), "section TEXT: its checksum");
}

TEST_F(RhoFileTest, a_size_that_is_no_whole_number_of_records_is_told) {
    write_small();
    const Result<RhoFile> file = RhoFile::open(file_);
    ASSERT_TRUE(file.ok());
    EXPECT_NE(file->array<std::uint32_t>(kText, 2).error().message.find("70 bytes"), std::string::npos);
}

TEST_F(RhoFileTest, wild_headers_with_checksums_that_fit_do_no_harm) {
    const RhoBytes whole = small();
    std::mt19937 random(7);
    int refused = 0;
    for (int round = 0; round < 5000; ++round) {
        RhoBytes file = whole;
        for (unsigned change = 0; change <= random() % 3; ++change)
            file.bytes[random() % (RhoBytes::entry(3))] = static_cast<std::byte>(random() >> 13);
        file.repair();
        refused += complaint(file.bytes).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 4000);
}

TEST_F(RhoFileTest, what_is_no_plain_file_is_told) {
    EXPECT_NE(RhoFile::open(folder_ / "gone.rho").error().message.find("no such file"), std::string::npos);
    EXPECT_NE(RhoFile::open(folder_).error().message.find("is a folder"), std::string::npos);
    if (std::filesystem::exists("/dev/zero")) {
        EXPECT_NE(RhoFile::open("/dev/zero").error().message.find("is not a plain file"), std::string::npos);
    }
    std::ofstream(file_).close();
    EXPECT_NE(RhoFile::open(file_).error().message.find("is empty"), std::string::npos);
    std::filesystem::permissions(file_, std::filesystem::perms::none);
    if (!std::ifstream(file_)) {
        EXPECT_NE(RhoFile::open(file_).error().message.find("can't be read"), std::string::npos);
    }
}

TEST_F(RhoFileTest, writer_leaves_the_old_file_until_the_new_one_is_whole) {
    write_small();
    {
        Result<RhoWriter> abandoned = RhoWriter::create(file_);
        ASSERT_TRUE(abandoned.ok());
        abandoned->add_owned(kText, 2, std::vector<std::byte>(7));
        EXPECT_EQ(files(), 2u);
        EXPECT_TRUE(RhoFile::open(file_).ok());
    }
    EXPECT_EQ(files(), 1u);
    EXPECT_EQ(RhoFile::open(file_)->section(kText, 2)->size(), 70u);

    // A crash left its temporary file; a mapping of the old file outlives its replacement.
    std::ofstream(file_.string() + ".part") << "half";
    const Result<RhoFile> old = RhoFile::open(file_);
    Result<RhoWriter> writer = RhoWriter::create(file_);
    ASSERT_TRUE(writer.ok());
    writer->add_owned(kText, 2, std::vector<std::byte>(9));
    ASSERT_TRUE(writer->finish().ok());
    EXPECT_EQ(old->section(kText, 2)->size(), 70u);
    EXPECT_EQ(RhoFile::open(file_)->section(kText, 2)->size(), 9u);
    EXPECT_EQ(files(), 2u);
}

TEST_F(RhoFileTest, writer_refuses_places_that_hold_no_plain_file) {
    EXPECT_NE(RhoWriter::create("").error().message.find("needs a name"), std::string::npos);
    EXPECT_NE(RhoWriter::create(folder_).error().message.find("is a folder"), std::string::npos);
    EXPECT_NE(RhoWriter::create(folder_ / "no" / "such.rho").error().message.find("can't be written"),
              std::string::npos);
    if (std::filesystem::exists("/dev/null")) {
        EXPECT_NE(RhoWriter::create("/dev/null").error().message.find("is not a plain file"),
                  std::string::npos);
    }
    EXPECT_EQ(files(), 0u);
}

TEST_F(RhoFileTest, writer_follows_a_link_to_the_file_meant) {
    write_small();
    std::filesystem::create_symlink("small.rho", folder_ / "link.rho");
    Result<RhoWriter> writer = RhoWriter::create(folder_ / "link.rho");
    ASSERT_TRUE(writer.ok());
    writer->add_owned(kText, 1, std::vector<std::byte>(1));
    ASSERT_TRUE(writer->finish().ok());
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.rho"));
    EXPECT_EQ(RhoFile::open(file_)->section(kText, 1)->size(), 1u);
}

}  // namespace
}  // namespace rhview
