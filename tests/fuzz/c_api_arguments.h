// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What a session hands to the C interface: numbers, structures of any size, memory that runs out. Each
/// structure lies in a block of exactly the size that it tells, so that a sanitizer sees reads beyond it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "c_api_session.h"

namespace rhview {

inline void demand(bool condition) {
    if (!condition) std::abort();
}

inline double RecordBytes::number(double plain) {
    using Limits = std::numeric_limits<double>;
    const std::uint8_t choice = next();
    const std::array hard{Limits::quiet_NaN(),
                          Limits::infinity(),
                          -Limits::infinity(),
                          Limits::max(),
                          Limits::denorm_min(),
                          -0.0,
                          -1.0,
                          1e-9,
                          1e30,
                          3.5e38,
                          1e8,
                          0.5,
                          -1e6,
                          2.0};
    if (choice < 192) return plain + choice * 0.25;
    if (choice - 192u < hard.size()) return hard[choice - 192u];
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | next();
    return std::bit_cast<double>(bits);
}

/// A copy of a structure as C might give it: whole by rule, else null, or of another size than this header's.
template <class Struct>
class Given {
  public:
    Given(Struct full, RecordBytes& bytes) {
        const std::uint8_t choice = bytes.next();
        if (choice >= 128 && choice % 8 == 0) return;
        std::size_t size = sizeof(Struct);
        const std::size_t words = bytes.next();
        const std::array<std::size_t, 8> others{size,
                                                0,
                                                size - 1,
                                                8 + words * 8 % (size - 8),
                                                size + words * 8,
                                                size + 8 + words * 8,
                                                4104,
                                                std::numeric_limits<std::size_t>::max()};
        if (choice >= 128) size = others[choice % 8];
        block_bytes_ = std::clamp<std::size_t>(size > 4096 ? 0 : size, sizeof(std::size_t), 4096);
        full.size = size;
        block_ = std::make_unique<unsigned char[]>(block_bytes_);
        std::memcpy(block_.get(), &full, std::min(block_bytes_, sizeof(Struct)));
        if (choice >= 128 && choice % 8 == 5) block_[block_bytes_ - 1] = 1;
        before_.assign(block_.get(), block_.get() + block_bytes_);
    }

    [[nodiscard]] Struct* get() const { return reinterpret_cast<Struct*>(block_.get()); }
    [[nodiscard]] bool is_unchanged() const {
        return std::equal(before_.begin(), before_.end(), block_.get());
    }

  private:
    std::size_t block_bytes_ = 0;
    std::unique_ptr<unsigned char[]> block_;  ///< from new: aligned for any structure
    std::vector<unsigned char> before_;
};

/// A structure to be filled, with something in it already.
template <class Struct>
Struct to_fill() {
    Struct made;
    std::memset(&made, 0xcd, sizeof made);
    return made;
}

/// At most 64 MiB at a time, and none from the k-th allocation on, if told so.
class LimitedMemory {
  public:
    static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

    [[nodiscard]] rhview_allocator hooks() {
        return {sizeof(rhview_allocator), this, &LimitedMemory::allocate, &LimitedMemory::release};
    }
    void fail_from(std::uint32_t allocation) { left_ = allocation; }
    void give_all() { left_ = std::numeric_limits<std::uint32_t>::max(); }
    [[nodiscard]] std::size_t block_count() const { return block_count_; }

  private:
    // In front of each block, as far as its alignment goes, lies its size.
    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        auto& self = *static_cast<LimitedMemory*>(user);
        demand(std::has_single_bit(alignment));
        const std::size_t head = std::max<std::size_t>(alignment, kHead);
        if (self.left_ == 0 || bytes > kMostBytes || self.used_bytes_ + bytes > kMostBytes) return nullptr;
        if (self.left_ != std::numeric_limits<std::uint32_t>::max()) --self.left_;
        auto* memory =
            static_cast<unsigned char*>(std::aligned_alloc(head, (head + bytes + head - 1) / head * head));
        demand(memory != nullptr);
        const std::array<std::size_t, 2> told{bytes, head};
        std::memcpy(memory + head - sizeof told, told.data(), sizeof told);
        self.used_bytes_ += bytes;
        ++self.block_count_;
        return memory + head;
    }
    static void release(void* user, void* memory) {
        auto& self = *static_cast<LimitedMemory*>(user);
        demand(memory != nullptr);
        std::array<std::size_t, 2> told{};
        auto* block = static_cast<unsigned char*>(memory);
        std::memcpy(told.data(), block - sizeof told, sizeof told);
        self.used_bytes_ -= told[0];
        --self.block_count_;
        std::free(block - told[1]);
    }

    static constexpr std::size_t kHead = 16;
    std::size_t used_bytes_ = 0;
    std::size_t block_count_ = 0;
    std::uint32_t left_ = std::numeric_limits<std::uint32_t>::max();
};

}  // namespace rhview
