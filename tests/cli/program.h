// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace rhview::cli {

inline std::string read_file(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

inline void write_file(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// What GoogleTest takes for the name of a parameter: `text` with _ for all but letters and digits.
inline std::string test_name(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return text;
}

/// Runs the program in a folder of its own, which is gone afterwards.
class ProgramTest : public testing::Test {
  protected:
    struct Outcome {
        int code = -1;
        std::string out;
        std::string err;
    };

    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string(info->test_suite_name()) + "." + info->name();
        std::ranges::replace(name, '/', '_');
        folder_ = std::filesystem::path(testing::TempDir()) / ("rhview_" + name);
        cache_ = folder_.string() + "_cache";
        for (const std::filesystem::path& folder : {folder_, cache_}) {
            std::filesystem::remove_all(folder);
            std::filesystem::create_directories(folder);
        }
    }
    void TearDown() override {
        std::filesystem::remove_all(folder_);
        std::filesystem::remove_all(cache_);
    }

    /// `environment` as in a shell: "A=1 B=2". Profiles are saved in the test's own folder.
    Outcome run(const std::string& arguments, const std::string& environment = "") {
        const std::filesystem::path out = folder_ / ".out", err = folder_ / ".err";
        const std::string command = "cd '" + folder_.string() + "' && XDG_CACHE_HOME='" + cache_.string() +
                                    "' " + environment + " '" + program_ + "' " + arguments + " >'" +
                                    out.string() + "' 2>'" + err.string() + "' </dev/null";
        const int status = std::system(command.c_str());
        Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
        std::filesystem::remove(out);
        std::filesystem::remove(err);
        return outcome;
    }

    nlohmann::json walk_json(const std::string& arguments) {
        const Outcome outcome = run("walk " + arguments + " --json walk.json");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return nlohmann::json::parse(read_file(folder_ / "walk.json"));
    }

    [[nodiscard]] std::size_t files_in_folder() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
    }

    std::string program_ = RHVIEW_PROGRAM;
    std::filesystem::path folder_;
    std::filesystem::path cache_;  ///< where saved profiles go
};

}  // namespace rhview::cli
