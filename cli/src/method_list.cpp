// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "method_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "method.h"

namespace rhview::cli {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t first = 0; first <= text.size();) {
        const std::size_t end = std::min(text.find(separator, first), text.size());
        parts.push_back(text.substr(first, end - first));
        first = end + 1;
    }
    return parts;
}

template <class Number>
bool read_number(const std::string& text, Number& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

Status read_option(const std::string& label, const std::string& option, WalkOptions& walk) {
    const std::size_t equals = std::min(option.find('='), option.size());
    const std::string name = option.substr(0, equals);
    const std::string value = equals < option.size() ? option.substr(equals + 1) : "";
    const auto wrong = [&](const char* wanted) {
        return Error{
            fmt::format("--methods {}: {}={} is no value for it; write {}", label, name, value, wanted)};
    };
    if (name == "leaf") {
        std::uint32_t leaf = 0;
        if (!read_number(value, leaf) || leaf == 0) return wrong("a whole number of triangles, 1 or more");
        walk.leaf = leaf;
    } else if (name == "replica-budget") {
        if (!read_number(value, walk.replica_budget) ||
            !(walk.replica_budget >= 0.0 && walk.replica_budget <= 1000.0))
            return wrong("a number from 0 to 1000");
    } else if (name == "visible-pixels") {
        if (!read_number(value, walk.visible_pixels)) return wrong("a whole number of pixels");
    } else if (name == "lod-error") {
        if (!read_number(value, walk.lod_error_px) ||
            !(walk.lod_error_px >= 0.0 && walk.lod_error_px <= 1000.0))
            return wrong("a number of pixels from 0 to 1000");
    } else if (name == "mode") {
        walk.mode = value;
    } else if (name == "occlusion") {
        walk.occlusion = value;
    } else if (name == "hierarchy") {
        walk.hierarchy = value;
    } else if (name == "submission") {
        walk.submission = value;
    } else if (is_tune_key(name)) {
        walk.tune += (walk.tune.empty() ? "" : ",") + option;
    } else {
        return Error{
            fmt::format("--methods {}: there is no option '{}'; a method has leaf, replica-budget, mode, "
                        "visible-pixels, occlusion, hierarchy, submission, lod-error and the keys of --tune",
                        label, name)};
    }
    return success();
}

}  // namespace

Result<std::vector<ListedMethod>> parse_methods(const std::string& list, const WalkOptions& common) {
    const std::vector<std::string> known = method_names();
    std::vector<ListedMethod> methods;
    for (const std::string& label : split(list, ',')) {
        const std::vector<std::string> parts = split(label, ':');
        if (std::ranges::find(known, parts[0]) == known.end())
            return Error{fmt::format("--methods {}: unknown method '{}'; the methods are {}", list, parts[0],
                                     fmt::join(known, ", "))};
        if (std::ranges::find(methods, label, &ListedMethod::label) != methods.end())
            return Error{fmt::format("--methods {}: {} is listed twice; list it once", list, label)};
        ListedMethod method{label, common};
        method.walk.method = parts[0];
        if (parts[0] != "rhview") method.walk.mode = "exact", method.walk.visible_pixels = 0;
        if (!parts[0].starts_with("rhview")) method.walk.occlusion = "auto";
        if (!has_hierarchy(parts[0])) method.walk.hierarchy = "auto";
        if (!has_tune(parts[0])) method.walk.tune.clear();
        for (std::size_t i = 1; i < parts.size(); ++i)
            if (Status status = read_option(label, parts[i], method.walk); !status) return status.error();
        methods.push_back(std::move(method));
    }
    return methods;
}

}  // namespace rhview::cli
