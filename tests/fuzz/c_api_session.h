// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Any bytes as calls of the C interface: right and wrong ones, in any order, with structures of any size,
/// null pointers, numbers of any kind, and memory that runs out. What C cannot check is right: a pointer is
/// null or points to as much as is told, a handle is used until it is destroyed. Each call aborts the program
/// if it breaks a promise of rhview.h: another status than those that there are, a mistake of the library's
/// own, an error without a sentence, an output changed by a call that failed, a plan out of bounds, memory
/// that is in use when all handles are destroyed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rhview/rhview.h"

namespace rhview {

/// A call: its number, and what its arguments are drawn from. Zeros are the plainest right arguments.
inline constexpr std::size_t kRecordBytes = 16;

/// The bytes of a record, and zeros for ever after.
class RecordBytes {
  public:
    explicit RecordBytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::uint8_t next() { return place_ < bytes_.size() ? bytes_[place_++] : std::uint8_t{0}; }
    std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(next() % count); }
    /// `plain`, or a number that is hard: NaN, infinite, huge, denormal, negative, …
    double number(double plain);
    float real(float plain) { return static_cast<float>(number(plain)); }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t place_ = 0;
};

/// How many calls of a sequence ended how, by status.
using StatusCounts = std::array<std::uint64_t, RHVIEW_INTERNAL_ERROR + 1>;

/// Calls the interface once for each whole record of `bytes`, at most 64 times, and destroys what is left.
StatusCounts run_c_api_session(std::span<const std::uint8_t> bytes);

/// Sessions of right calls, to start from.
std::vector<std::vector<std::uint8_t>> c_api_seeds();

}  // namespace rhview
