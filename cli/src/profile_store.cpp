// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "profile_store.h"

#include <fmt/format.h>

#include <cstdlib>

namespace rhview::cli {
namespace {

std::optional<std::filesystem::path> cache_folder() {
    // The XDG base directory specification: relative paths are to be ignored.
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && std::filesystem::path(cache).is_absolute())
        return std::filesystem::path(cache) / "rhview";
    const char* home = std::getenv("HOME");
    if (home == nullptr || *home == '\0') return std::nullopt;
    return std::filesystem::path(home) / ".cache" / "rhview";
}

/// A file name for any text: letters and digits stay, a hash (FNV-1a) keeps what was replaced apart.
std::string file_name_of(const std::string& text) {
    std::string name;
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const char c : text) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        name += plain ? c : '_';
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    }
    return fmt::format("{}-{:08x}", name.substr(name.size() > 40 ? name.size() - 40 : 0), hash >> 32);
}

}  // namespace

std::optional<std::filesystem::path> saved_profile_path(const std::string& scene_spec) {
    const std::optional<std::filesystem::path> folder = cache_folder();
    if (!folder) return std::nullopt;
    return *folder / (scene_spec.empty() ? std::string("profile.json")
                                         : fmt::format("profile-{}.json", file_name_of(scene_spec)));
}

bool is_of_device(const TimingProfile& profile, const gl::DeviceInfo& device) {
    return profile.renderer == device.renderer && profile.version == device.version;
}

std::optional<SavedProfile> find_saved_profile(const std::string& scene_spec, const gl::DeviceInfo& device,
                                               std::string& why_not) {
    for (const std::string& name : {scene_spec, std::string()}) {
        const std::optional<std::filesystem::path> file = saved_profile_path(name);
        std::error_code ignored;
        if (!file || !std::filesystem::exists(*file, ignored)) continue;
        Result<TimingProfile> profile = load_profile(*file);
        if (!profile) {
            why_not = profile.error().message;
        } else if (!is_of_device(*profile, device)) {
            why_not = fmt::format("{}: of another device ({}, {}); run rhview calibrate again",
                                  file->string(), profile->renderer, profile->version);
        } else {
            return SavedProfile{std::move(profile).value(), *file};
        }
    }
    return std::nullopt;
}

}  // namespace rhview::cli
