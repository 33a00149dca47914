// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "failing_memory.h"

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
constinit std::atomic<std::uint64_t> count{0};
constinit std::atomic<std::uint64_t> fails_at{kNever};
constinit std::atomic<bool> for_good{false};
constinit std::atomic<bool> failed{false};
constinit std::atomic<std::int64_t> in_use{0};

void* allocate(std::size_t bytes, std::size_t alignment) noexcept {
    const std::uint64_t index = count.fetch_add(1, std::memory_order_relaxed);
    const std::uint64_t failing = fails_at.load(std::memory_order_relaxed);
    if (index == failing || (index > failing && for_good.load(std::memory_order_relaxed))) {
        failed = true;
        return nullptr;
    }
    bytes = bytes == 0 ? 1 : bytes;
    void* memory = alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
                       ? std::malloc(bytes)
                       : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    in_use.fetch_add(memory != nullptr ? 1 : 0, std::memory_order_relaxed);
    return memory;
}

void* allocate_or_throw(std::size_t bytes, std::size_t alignment = __STDCPP_DEFAULT_NEW_ALIGNMENT__) {
    if (void* memory = allocate(bytes, alignment)) return memory;
    throw std::bad_alloc();
}

void release(void* memory) noexcept {
    in_use.fetch_sub(memory != nullptr ? 1 : 0, std::memory_order_relaxed);
    std::free(memory);
}

}  // namespace

// Not inlined: GCC would see malloc's memory given to a delete expression, and warn. Array forms too: the
// sanitizers bring such of their own.
#define RHVIEW_NOT_INLINED [[gnu::noinline]]

RHVIEW_NOT_INLINED void* operator new(std::size_t size) {
    return allocate_or_throw(size);
}
RHVIEW_NOT_INLINED void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
RHVIEW_NOT_INLINED void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
RHVIEW_NOT_INLINED void* operator new(std::size_t size, std::align_val_t alignment,
                                      const std::nothrow_t&) noexcept {
    return allocate(size, static_cast<std::size_t>(alignment));
}
RHVIEW_NOT_INLINED void operator delete(void* memory) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, std::align_val_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, const std::nothrow_t&) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, std::align_val_t, const std::nothrow_t&) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void* operator new[](std::size_t size) {
    return allocate_or_throw(size);
}
RHVIEW_NOT_INLINED void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory, std::size_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory, const std::nothrow_t&) noexcept {
    release(memory);
}

namespace rhview {

void fail_allocation(std::uint64_t index, Shortage shortage) {
    failed = false;
    count = 0;
    for_good = shortage == Shortage::ForGood;
    fails_at = index;
}

bool stop_failing() {
    fails_at = kNever;
    return failed;
}

std::int64_t blocks_in_use() {
    return in_use;
}

}  // namespace rhview
