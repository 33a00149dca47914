// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The program is killed or interrupted at many moments of its work: what it was to replace is old or new.

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include "program.h"
#include "rhview/scenes/baked_scene.h"

namespace rhview::cli {
namespace {

class Interrupted : public ProgramTest {
  protected:
    /// Starts the program in the test's folder. `file_limit`: its files end there, as on a full disk.
    pid_t start(const std::vector<std::string>& arguments, rlim_t file_limit = RLIM_INFINITY) {
        const pid_t child = fork();
        if (child != 0) return child;
        const int nothing = open("/dev/null", O_RDWR);
        for (const int stream : {0, 1, 2}) dup2(nothing, stream);
        setenv("XDG_CACHE_HOME", cache_.c_str(), 1);
        std::signal(SIGINT, SIG_DFL);
        std::signal(SIGXFSZ, SIG_IGN);
        if (file_limit != RLIM_INFINITY) {
            const rlimit limit{file_limit, file_limit};
            setrlimit(RLIMIT_FSIZE, &limit);
        }
        std::vector<char*> argv{const_cast<char*>("rhview")};
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        if (chdir(folder_.c_str()) == 0) execv(RHVIEW_PROGRAM, argv.data());
        _exit(127);
    }
    static int wait_for(pid_t child) {
        int status = 0;
        EXPECT_EQ(waitpid(child, &status, 0), child);
        return status;
    }
    /// Runs `arguments` a few times, ended by SIGINT and SIGKILL in turn, each time a bit later; `intact` is
    /// asked after each. How many runs the signal ended.
    template <class Intact>
    int interrupt(const std::vector<std::string>& arguments, const Intact& intact) {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point begin = Clock::now();
        EXPECT_EQ(WEXITSTATUS(wait_for(start(arguments))), 0);
        const auto whole = Clock::now() - begin;
        intact();
        constexpr int kRuns = 16;
        int ended = 0;
        for (int run = 0; run < kRuns; ++run) {
            const int signal = run % 2 == 0 ? SIGKILL : SIGINT;
            const pid_t child = start(arguments);
            // The later half of the work is where files are written.
            std::this_thread::sleep_for(whole * (kRuns / 4 + run) / (kRuns + 2));
            kill(child, signal);
            const int status = wait_for(child);
            ended += WIFSIGNALED(status) && WTERMSIG(status) == signal ? 1 : 0;
            intact();
        }
        std::cout << ended << " of " << kRuns << " runs ended by a signal\n";
        return ended;
    }
};

TEST_F(Interrupted, bake_leaves_the_old_file_or_the_new_one) {
    const std::filesystem::path file = folder_ / "scene.rho";
    const auto is_whole = [&] {
        const Result<RhoFile> rho = RhoFile::open(file);
        ASSERT_TRUE(rho.ok()) << rho.error().message;
        const Result<BakedScene> scene = read_scene_sections(*rho);
        EXPECT_TRUE(scene.ok()) << scene.error().message;
    };
    EXPECT_GT(interrupt({"bake", "town:size=150", "-o", "scene.rho", "--set", "c1=1,c3=1000"}, is_whole), 0);
}

TEST_F(Interrupted, a_report_is_old_or_new) {
    const std::filesystem::path file = folder_ / "walk.json";
    const auto is_whole = [&] { EXPECT_TRUE(nlohmann::json::accept(read_file(file))) << read_file(file); };
    EXPECT_GT(interrupt({"walk", "soup:triangles=2000", "--frames", "20", "--size", "160x90", "--set",
                         "c1=1,c3=1000,query=1000,box=100", "--json", "walk.json"},
                        is_whole),
              0);
}

TEST_F(Interrupted, bake_on_a_full_disk_says_so_and_leaves_the_old_file) {
    write_file(folder_ / "scene.rho", "old");
    int faults = 0;
    for (const rlim_t limit : {0, 1, 64, 4096, 65536}) {
        const int status = wait_for(
            start({"bake", "soup:triangles=3000", "-o", "scene.rho", "--set", "c1=1,c3=1000"}, limit));
        ASSERT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 2) << limit;
        EXPECT_EQ(read_file(folder_ / "scene.rho"), "old");
        EXPECT_EQ(files_in_folder(), 1u);
        ++faults;
    }
    std::cout << faults << " full disks\n";
}

}  // namespace
}  // namespace rhview::cli
