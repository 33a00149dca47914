// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What every function of the C interface does: errors become a status and a sentence, structures are taken
/// in whatever size they come.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <new>
#include <string_view>

#include "rhview/base/workers.h"
#include "rhview/rhview.h"

namespace rhview::capi {

/// Keeps the sentence for `rhview_last_error` and returns `status`. Takes no memory: it may be about that.
rhview_status fail(rhview_status status, std::string_view sentence) noexcept;
const char* last_error() noexcept;

/// What `body` returns; what it throws becomes a status.
template <class Body>
rhview_status guarded(Body&& body) noexcept {
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return fail(RHVIEW_OUT_OF_MEMORY, "memory ran out: give the allocator more, or the library less");
    } catch (...) {
        return fail(RHVIEW_INTERNAL_ERROR,
                    "something was thrown that should not have been: please report it");
    }
}

/// Larger than any structure will ever be: another size is a mistake.
inline constexpr std::size_t kLargestStruct = 4096;

/// Whether a structure can have this size in any version: one that is cut within a field has not, and a part
/// of a pointer would point anywhere.
template <class Struct>
constexpr bool can_be_size(std::size_t size) {
    return size >= sizeof(std::size_t) && size <= kLargestStruct && size % alignof(Struct) == 0;
}

/// "rhview_batch: indices is null".
rhview_status fail_field(const char* name, std::initializer_list<const char*> wrong) noexcept;
rhview_status fail_size(const char* name, std::size_t size) noexcept;

/// Copies a structure of any size; zeros where it is shorter. Null: all zeros.
template <class Struct>
rhview_status take(const Struct* given, const char* name, Struct& taken) noexcept {
    taken = {};
    taken.size = sizeof(Struct);
    if (given == nullptr) return RHVIEW_OK;
    const std::size_t size = given->size;
    if (!can_be_size<Struct>(size)) return fail_size(name, size);
    const auto* bytes = reinterpret_cast<const unsigned char*>(given);
    for (std::size_t i = sizeof(Struct); i < size; ++i)
        if (bytes[i] != 0) return fail_size(name, size);
    std::memcpy(&taken, given, std::min(size, sizeof(Struct)));
    taken.size = sizeof(Struct);
    return RHVIEW_OK;
}

/// Fills as much of the caller's structure as there is, with zeros where it is longer.
template <class Struct>
rhview_status give(const Struct& full, const char* name, Struct* out) noexcept {
    if (out == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "there is no structure to fill: it is null");
    const std::size_t size = out->size;
    if (!can_be_size<Struct>(size)) return fail_size(name, size);
    auto* bytes = reinterpret_cast<unsigned char*>(out);
    std::memcpy(bytes, &full, std::min(size, sizeof(Struct)));
    for (std::size_t i = sizeof(Struct); i < size; ++i) bytes[i] = 0;
    out->size = size;
    return RHVIEW_OK;
}

/// The caller's threads; null: the calling one.
rhview_status take_workers(const rhview_workers* given, Workers& workers) noexcept;

}  // namespace rhview::capi
