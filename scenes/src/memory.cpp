// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/memory.h"

#include <fmt/format.h>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

#include <fstream>

namespace rhview {

std::uint64_t available_memory_bytes() {
    // Linux: pages that can be had without swapping, caches included; other systems tell free pages only.
    std::ifstream meminfo("/proc/meminfo");
    std::string key;
    std::uint64_t kibibytes = 0;
    while (meminfo >> key >> kibibytes) {
        if (key == "MemAvailable:") return kibibytes * 1024;
        meminfo.ignore(64, '\n');
    }
#if defined(_SC_AVPHYS_PAGES) && defined(_SC_PAGESIZE)
    const long pages = sysconf(_SC_AVPHYS_PAGES);
    const long page_bytes = sysconf(_SC_PAGESIZE);
    if (pages > 0 && page_bytes > 0)
        return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_bytes);
#endif
    return std::uint64_t{1} << 62;
}

std::uint64_t estimated_scene_bytes(std::uint64_t triangles, std::uint64_t vertices,
                                    std::uint64_t bytes_per_vertex) {
    // Indices: the scene's, the octree's ordered copy, the driver's two uploads (12 bytes each); sorting keys
    // and order (24 bytes); nodes and ranges (at most 8). Vertices: the scene's and the driver's.
    constexpr std::uint64_t kBytesPerTriangle = 4 * 12 + 24 + 8;
    return triangles * kBytesPerTriangle + 2 * vertices * bytes_per_vertex;
}

Status check_memory(const std::string& what, std::uint64_t needed_bytes) {
    const std::uint64_t available = available_memory_bytes();
    if (needed_bytes <= available) return success();
    constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;
    return Error{fmt::format("{} needs about {:.1f} GiB of memory and {:.1f} GiB are free; make it smaller",
                             what, static_cast<double>(needed_bytes) / kGibibyte,
                             static_cast<double>(available) / kGibibyte)};
}

}  // namespace rhview
