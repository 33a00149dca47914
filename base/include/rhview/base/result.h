// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A value, or one sentence that says what is wrong with data from outside and how to mend it.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "rhview/base/assert.h"

namespace rhview {

/// One sentence that names the file or option, the place in it, and the mend. No trailing newline.
struct Error {
    std::string message;
};

/// A `T`, or an `Error`: whoever calls has to look which.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    /// The caller has seen that `ok()`.
    [[nodiscard]] T& value() & { return *checked_value(); }
    [[nodiscard]] const T& value() const& { return *const_cast<Result*>(this)->checked_value(); }
    [[nodiscard]] T&& value() && { return std::move(*checked_value()); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return checked_value(); }
    const T* operator->() const { return const_cast<Result*>(this)->checked_value(); }

    /// The caller has seen that `!ok()`.
    [[nodiscard]] const Error& error() const {
        RHVIEW_ASSERT(!ok());
        return *std::get_if<1>(&state_);
    }

  private:
    T* checked_value() {
        RHVIEW_ASSERT(ok());
        return std::get_if<0>(&state_);
    }

    std::variant<T, Error> state_;
};

/// A success that carries nothing.
using Status = Result<std::monostate>;
/// The `Status` of what went well.
inline Status success() {
    return std::monostate{};
}

}  // namespace rhview
