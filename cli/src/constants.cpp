// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "constants.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <set>
#include <string_view>

namespace rhview::cli {
namespace {

/// Applies one `name=value`; the name, for the caller to know what was set.
Result<std::string> apply(std::string_view assignment, TimingProfile& profile) {
    const std::size_t equals = assignment.find('=');
    const std::string name(assignment.substr(0, equals));
    const std::string_view text = equals == std::string_view::npos ? "" : assignment.substr(equals + 1);
    double value = 0.0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || !std::isfinite(value) ||
        value < 0.0)
        return Error{fmt::format(
            "--set {}: write name=value with a value of 0 or more nanoseconds, as in c1=0.25", assignment)};
    if (name == "c0")
        profile.c0_ns = value;
    else if (name == "c1")
        profile.c1_ns = value;
    else if (name == "c3")
        profile.c3_ns = value;
    else if (name == "query")
        profile.query_ns = value;
    else
        return Error{
            fmt::format("--set {}: unknown constant; the constants are c0, c1, c3 and query", assignment)};
    return name;
}

}  // namespace

Result<std::optional<UserConstants>> read_constants(const std::optional<std::filesystem::path>& file,
                                                    const std::string& set) {
    if (!file && set.empty()) return std::optional<UserConstants>();
    UserConstants constants;
    constants.source = set.empty() ? "file" : "set";
    if (file) {
        Result<TimingProfile> profile = load_profile(*file);
        if (!profile) return profile.error();
        constants.profile = std::move(profile).value();
    }
    std::set<std::string> names;
    for (std::size_t begin = 0; begin < set.size();) {
        const std::size_t end = std::min(set.find(',', begin), set.size());
        const Result<std::string> name =
            apply(std::string_view(set).substr(begin, end - begin), constants.profile);
        if (!name) return name.error();
        if (!names.insert(*name).second) return Error{fmt::format("--set {}: {} is there twice", set, *name)};
        begin = end + 1;
    }
    if (!file && (!names.contains("c1") || !names.contains("c3")))
        return Error{
            fmt::format("--set {}: without --profile both c1 and c3 are needed, as in c1=0.25,c3=2000", set)};
    return std::optional<UserConstants>(std::move(constants));
}

}  // namespace rhview::cli
