// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Owners of OpenGL names. Made and destroyed while their context is current.
#pragma once

#include <cstdint>
#include <utility>

namespace rhview::gl {

/// What of OpenGL's objects a handle owns.
enum class HandleKind { Buffer, VertexArray, Program, Framebuffer, Renderbuffer, Query };

/// Deletes the object, whose context is current; 0 is none.
void delete_handle(HandleKind kind, std::uint32_t name);

/// Owns an object of OpenGL: deleted with the handle, while its context is current.
template <HandleKind Kind>
class Handle {
  public:
    Handle() = default;
    explicit Handle(std::uint32_t name) : name_(name) {}
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Handle() {
        if (name_ != 0) delete_handle(Kind, name_);
    }

    [[nodiscard]] std::uint32_t name() const { return name_; }

  private:
    std::uint32_t name_ = 0;
};

/// Vertices, indices, storage.
using Buffer = Handle<HandleKind::Buffer>;
/// Where the attributes of a vertex are read from.
using VertexArray = Handle<HandleKind::VertexArray>;
/// Linked shaders.
using Program = Handle<HandleKind::Program>;
/// What is drawn into.
using Framebuffer = Handle<HandleKind::Framebuffer>;
/// An image that is only drawn into.
using Renderbuffer = Handle<HandleKind::Renderbuffer>;
/// An occlusion or timer query.
using Query = Handle<HandleKind::Query>;

/// Deletes the fence, whose context is current; null is none.
void delete_fence(void* sync);

/// A GLsync.
class Fence {
  public:
    Fence() = default;
    explicit Fence(void* sync) : sync_(sync) {}
    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }
    ~Fence() {
        if (sync_ != nullptr) delete_fence(sync_);
    }

    [[nodiscard]] void* sync() const { return sync_; }

  private:
    void* sync_ = nullptr;
};

}  // namespace rhview::gl
