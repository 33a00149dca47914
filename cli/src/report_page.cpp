// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "report_page.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

namespace rhview::cli {
namespace {

/// Where the program lies; `given` is how it was called. Linux tells; elsewhere, and if it does not, a path
/// that was called with a folder is one.
std::filesystem::path program_file(const std::filesystem::path& given) {
    std::error_code error;
    const std::filesystem::path told = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? std::filesystem::absolute(given, error) : told;
}

/// For a POSIX shell.
std::string shell_word(const std::filesystem::path& path) {
    std::string text = "'";
    for (const char c : path.string()) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

}  // namespace

Result<std::filesystem::path> find_report_script(const std::filesystem::path& program) {
    std::error_code error;
    const std::filesystem::path folder = program_file(program).parent_path();
    const std::filesystem::path installed = folder.parent_path() / "share" / "rhview" / "report.py";
    if (std::filesystem::exists(installed, error)) return installed;
    for (std::filesystem::path above = folder; above.has_relative_path(); above = above.parent_path())
        if (std::filesystem::exists(above / "scripts" / "report.py", error))
            return above / "scripts" / "report.py";
    return Error{fmt::format("--report: {} is not there; install rhview again, or leave --report out",
                             installed.string())};
}

Status make_report_page(const std::filesystem::path& script, const std::filesystem::path& folder) {
    const std::string command = fmt::format("python3 {} {} -o {} </dev/null >/dev/null", shell_word(script),
                                            shell_word(folder / "compare.json"), shell_word(folder));
    if (std::system(command.c_str()) == 0) return success();
    return Error{
        fmt::format("--report: {} could not make the page (see above; it needs python3); {} is whole",
                    script.string(), (folder / "compare.json").string())};
}

}  // namespace rhview::cli
