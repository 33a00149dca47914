// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// The shared library's own `operator new` and `operator delete`. They are not exported: all code inside the
// library uses them, the C++ standard library's inside it too, and nothing else does. What is made by other
// shared libraries (oneTBB, meshoptimizer) is also freed there, and never passes through here.

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "border.h"

namespace {

/// Constant-initialised: used before anything else of the library is.
constinit rhview_allocator hook{};
constinit std::atomic<std::size_t> blocks_in_use{0};

constexpr std::size_t kUsualAlignment = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

void* allocate_default(std::size_t bytes, std::size_t alignment) {
    if (alignment <= kUsualAlignment) return std::malloc(bytes);
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

void* allocate(std::size_t bytes, std::size_t alignment) noexcept {
    bytes = bytes == 0 ? 1 : bytes;
    void* memory = hook.allocate != nullptr ? hook.allocate(hook.user, bytes, alignment)
                                            : allocate_default(bytes, alignment);
    if (memory != nullptr) blocks_in_use.fetch_add(1, std::memory_order_relaxed);
    return memory;
}

void* allocate_or_throw(std::size_t bytes, std::size_t alignment = kUsualAlignment) {
    if (void* memory = allocate(bytes, alignment)) return memory;
    throw std::bad_alloc();
}

void release(void* memory) noexcept {
    if (memory == nullptr) return;
    if (hook.release != nullptr) {
        hook.release(hook.user, memory);
    } else {
        std::free(memory);
    }
    blocks_in_use.fetch_sub(1, std::memory_order_relaxed);
}

}  // namespace

// Not inlined: GCC would see malloc's memory given to a delete expression, and warn.
#define RHVIEW_NOT_INLINED [[gnu::noinline]]

RHVIEW_NOT_INLINED void* operator new(std::size_t size) {
    return allocate_or_throw(size);
}
RHVIEW_NOT_INLINED void* operator new[](std::size_t size) {
    return allocate_or_throw(size);
}
RHVIEW_NOT_INLINED void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
RHVIEW_NOT_INLINED void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
RHVIEW_NOT_INLINED void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, kUsualAlignment);
}
RHVIEW_NOT_INLINED void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, kUsualAlignment);
}
RHVIEW_NOT_INLINED void* operator new(std::size_t size, std::align_val_t alignment,
                                      const std::nothrow_t&) noexcept {
    return allocate(size, static_cast<std::size_t>(alignment));
}
RHVIEW_NOT_INLINED void* operator new[](std::size_t size, std::align_val_t alignment,
                                        const std::nothrow_t&) noexcept {
    return allocate(size, static_cast<std::size_t>(alignment));
}
RHVIEW_NOT_INLINED void operator delete(void* memory) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory, std::size_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, std::align_val_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory, std::align_val_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, const std::nothrow_t&) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory, const std::nothrow_t&) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete(void* memory, std::align_val_t, const std::nothrow_t&) noexcept {
    release(memory);
}
RHVIEW_NOT_INLINED void operator delete[](void* memory, std::align_val_t, const std::nothrow_t&) noexcept {
    release(memory);
}

rhview_status rhview_set_allocator(const rhview_allocator* allocator) {
    using namespace rhview::capi;
    rhview_allocator taken;
    if (const rhview_status status = take(allocator, "rhview_allocator", taken); status != RHVIEW_OK)
        return status;
    if ((taken.allocate == nullptr) != (taken.release == nullptr))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_allocator: set both allocate and release, or neither");
    if (blocks_in_use.load(std::memory_order_relaxed) != 0)
        return fail(RHVIEW_WRONG_STATE,
                    "memory of the allocator before is in use: destroy all scenes and views first");
    hook = taken;
    return RHVIEW_OK;
}
