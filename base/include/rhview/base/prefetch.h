// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Fetching what is read some steps later: for loops that look many things up by id, each a miss of the
/// cache.
#pragma once

#include <cstddef>

namespace rhview {

/// Steps ahead at which a loop of some ten nanoseconds a step hides a miss.
inline constexpr std::size_t kPrefetchSteps = 8;

/// A hint: any address will do, nothing is read.
template <class T>
void prefetch(const T* object) {
#if defined(__GNUC__)
    constexpr std::size_t kLine = 64;
    const char* bytes = reinterpret_cast<const char*>(object);
    for (std::size_t offset = 0; offset < sizeof(T); offset += kLine) __builtin_prefetch(bytes + offset);
#else
    static_cast<void>(object);
#endif
}

}  // namespace rhview
