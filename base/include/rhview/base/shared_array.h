// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Read-only arrays that may live in memory of their own or in a mapped file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace rhview {

/// A constant array and a share in whatever owns its memory. Copies share it: they cost no allocation, and
/// elements stay where they are as long as one copy lives.
template <class T>
class SharedArray {
  public:
    SharedArray() = default;
    /// Takes over `values`.
    SharedArray(std::vector<T> values) {
        auto owned = std::make_shared<const std::vector<T>>(std::move(values));
        view_ = *owned;
        owner_ = std::move(owned);
    }
    /// `owner` keeps the elements of `view` alive.
    SharedArray(std::span<const T> view, std::shared_ptr<const void> owner)
        : view_(view), owner_(std::move(owner)) {}

    [[nodiscard]] std::size_t size() const { return view_.size(); }
    [[nodiscard]] bool empty() const { return view_.empty(); }
    [[nodiscard]] const T* data() const { return view_.data(); }
    [[nodiscard]] const T* begin() const { return view_.data(); }
    [[nodiscard]] const T* end() const { return view_.data() + view_.size(); }
    [[nodiscard]] const T& operator[](std::size_t i) const { return view_[i]; }
    [[nodiscard]] std::span<const T> span() const { return view_; }
    [[nodiscard]] std::size_t size_bytes() const { return view_.size_bytes(); }

    /// Elements [first, first + count), which shares the same owner.
    [[nodiscard]] SharedArray part(std::size_t first, std::size_t count) const {
        return {view_.subspan(first, count), owner_};
    }

    friend bool operator==(const SharedArray& a, const SharedArray& b) {
        return std::ranges::equal(a.view_, b.view_);
    }

  private:
    std::span<const T> view_;
    std::shared_ptr<const void> owner_;
};

}  // namespace rhview
