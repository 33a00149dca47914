// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/replacement_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <string>

namespace rhview {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

class ReplacementFileTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(testing::TempDir()) / (std::string("rhview_replacement_") + info->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        file_ = folder_ / "file";
        std::ofstream(file_) << "old";
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] int files() const {
        return static_cast<int>(std::distance(fs::directory_iterator(folder_), {}));
    }

    fs::path folder_;
    fs::path file_;
};

TEST_F(ReplacementFileTest, is_there_when_it_is_committed_and_not_before) {
    Result<ReplacementFile> replacement = ReplacementFile::create(file_);
    ASSERT_TRUE(replacement.ok());
    EXPECT_TRUE(replacement->write("nEw"));
    EXPECT_TRUE(replacement->seek(1));
    EXPECT_TRUE(replacement->write("e"));
    EXPECT_EQ(text_of(file_), "old");
    ASSERT_TRUE(replacement->commit().ok());
    EXPECT_EQ(text_of(file_), "new");
    EXPECT_EQ(files(), 1);
}

TEST_F(ReplacementFileTest, links_where_its_temporary_file_should_be_are_not_followed) {
    const fs::path victim = folder_ / "victim";
    std::ofstream(victim) << "precious";
    fs::create_symlink("victim", folder_ / "file.part");
    fs::create_symlink("nothing there", folder_ / "file.1.part");
    Result<ReplacementFile> replacement = ReplacementFile::create(file_);
    ASSERT_TRUE(replacement.ok());
    replacement->write("new");
    ASSERT_TRUE(replacement->commit().ok());
    EXPECT_EQ(text_of(file_), "new");
    EXPECT_EQ(text_of(victim), "precious");
    EXPECT_FALSE(fs::exists(folder_ / "nothing there"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "file.part"));
    EXPECT_EQ(files(), 4);
}

TEST_F(ReplacementFileTest, keeps_the_permissions_of_what_it_replaces) {
    const fs::perms owner_only = fs::perms::owner_read | fs::perms::owner_write;
    fs::permissions(file_, owner_only);
    Result<ReplacementFile> replacement = ReplacementFile::create(file_);
    ASSERT_TRUE(replacement.ok());
    EXPECT_EQ(fs::status(folder_ / "file.part").permissions(), owner_only);
    ASSERT_TRUE(replacement->commit().ok());
    EXPECT_EQ(fs::status(file_).permissions(), owner_only);
}

TEST_F(ReplacementFileTest, on_a_disk_that_is_full_at_any_byte_the_old_file_stays) {
    // A limit on the size of files fails writes as a full disk does, at a byte of our choice.
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    constexpr std::size_t kSize = 10000;
    int faults = 0;
    for (std::size_t limit = 0; limit < kSize; limit += 61) {
        const rlimit full{limit, before.rlim_max};
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &full), 0);
        {
            Result<ReplacementFile> replacement = ReplacementFile::create(file_);
            ASSERT_TRUE(replacement.ok());
            for (std::size_t i = 0; i < kSize; i += 100) replacement->write(std::string(100, 'x'));
            const Status status = replacement->commit();
            ASSERT_FALSE(status.ok()) << limit;
            EXPECT_NE(status.error().message.find("has space"), std::string::npos);
        }
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
        ASSERT_EQ(text_of(file_), "old");
        ASSERT_EQ(files(), 1);
        ++faults;
    }
    std::cout << faults << " full disks\n";
}

TEST_F(ReplacementFileTest, of_a_process_that_is_killed_leaves_the_old_file_or_the_new_one) {
    const std::string fresh(300000, 'n');
    int kills = 0, old_kept = 0;
    for (int step = 0; step <= 31; ++step) {
        std::ofstream(file_) << "old";
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            Result<ReplacementFile> replacement = ReplacementFile::create(file_);
            for (int i = 0; i < 30; ++i) {
                if (i == step) raise(SIGKILL);
                replacement->write(
                    std::string_view(fresh).substr(static_cast<std::size_t>(i) * 10000, 10000));
            }
            if (step == 30) raise(SIGKILL);
            const Status committed = replacement->commit();
            if (!committed) _exit(1);
            raise(SIGKILL);
        }
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
        const std::string now = text_of(file_);
        ASSERT_TRUE(now == "old" || now == fresh) << step << ": " << now.size();
        EXPECT_EQ(now == "old", step < 31) << step;
        ++kills;
        old_kept += now == "old" ? 1 : 0;
    }
    std::cout << kills << " kills, " << old_kept << " old files kept\n";
    // What they left is in nobody's way.
    Result<ReplacementFile> replacement = ReplacementFile::create(file_);
    ASSERT_TRUE(replacement.ok());
    replacement->write("after");
    ASSERT_TRUE(replacement->commit().ok());
    EXPECT_EQ(text_of(file_), "after");
}

TEST_F(ReplacementFileTest, in_a_folder_that_vanishes_is_told) {
    const fs::path folder = folder_ / "short-lived";
    fs::create_directories(folder);
    Result<ReplacementFile> replacement = ReplacementFile::create(folder / "file");
    ASSERT_TRUE(replacement.ok());
    replacement->write("new");
    fs::remove_all(folder);
    EXPECT_NE(replacement->commit().error().message.find("can't be written"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder));
}

TEST_F(ReplacementFileTest, in_a_folder_that_may_not_be_written_is_told) {
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    const bool may_write = access(folder_.c_str(), W_OK) == 0;  // as the superuser
    const Result<ReplacementFile> replacement = ReplacementFile::create(file_);
    EXPECT_EQ(replacement.ok(), may_write);
    fs::permissions(folder_, fs::perms::owner_all);
    EXPECT_EQ(text_of(file_), "old");
}

}  // namespace
}  // namespace rhview
