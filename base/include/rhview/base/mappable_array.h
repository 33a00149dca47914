// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Arrays that live in memory of their own, or in a mapped file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace rhview {

/// A `std::vector`, or a view of elements that someone else keeps: whoever only reads it can't tell. Copies
/// of a view share its owner. `own` makes a view a vector first. Moving keeps the elements where they are.
template <class T>
class MappableArray {
  public:
    /// As containers name it.
    using value_type = T;

    MappableArray() = default;
    MappableArray(std::vector<T> values) : own_(std::move(values)) {}
    /// `owner` keeps the elements of `view` alive; it is not null.
    MappableArray(std::span<const T> view, std::shared_ptr<const void> owner)
        : view_(view), owner_(std::move(owner)) {}

    [[nodiscard]] std::span<const T> span() const { return owner_ == nullptr ? std::span(own_) : view_; }
    [[nodiscard]] std::size_t size() const { return span().size(); }
    [[nodiscard]] bool empty() const { return span().empty(); }
    [[nodiscard]] std::size_t size_bytes() const { return span().size_bytes(); }
    [[nodiscard]] const T* data() const { return span().data(); }
    [[nodiscard]] const T* begin() const { return data(); }
    [[nodiscard]] const T* end() const { return data() + size(); }
    [[nodiscard]] const T& operator[](std::size_t i) const { return span()[i]; }

    /// The vector, to be changed. Cost: a copy of all elements if this is a view.
    std::vector<T>& own() {
        if (owner_ != nullptr) {
            own_.assign(view_.begin(), view_.end());
            view_ = {};
            owner_ = nullptr;
        }
        return own_;
    }

    friend bool operator==(const MappableArray& a, const MappableArray& b) {
        return std::ranges::equal(a.span(), b.span());
    }

  private:
    std::vector<T> own_;  ///< empty while there is an owner
    std::span<const T> view_;
    std::shared_ptr<const void> owner_;
};

}  // namespace rhview
