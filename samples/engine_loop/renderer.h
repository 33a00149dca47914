// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// The engine's own renderer, in plain OpenGL: it draws ranges of its meshes into its targets, and asks
// whether boxes are seen. All that it knows of rhview are three plain structs.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/view.h"
#include "rhview/occlusion_queries/query.h"
#include "rhview/rhoctree/rhoctree.h"
#include "world.h"

namespace engine {

/// The camera's picture, or the depth map of the sun.
enum class Target { Picture, ShadowMap };

class Renderer {
  public:
    static constexpr int kWidth = 640, kHeight = 360, kShadowSize = 512;

    /// `indices` replaces those of the meshes: batch 0 is the ground, 1 the walls, 2 the furniture.
    Renderer(const World& world, std::span<const std::uint32_t> indices);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Clears `target`; draws go to it, seen by `view`, whose depth is reversed.
    void begin(Target target, const rhview::View& view);
    void draw(const rhview::DrawRange& range);

    /// Is anything of `boxes` seen, against what was drawn since `begin`? Nothing waits.
    void ask(std::uint64_t ticket, std::span<const rhview::Aabb> boxes);
    /// Drawn if the query sees something: the GPU decides.
    void draw_if_seen(std::uint64_t ticket, const rhview::DrawRange& range);
    /// The answers that have come since the last call, of any frame.
    std::span<const rhview::QueryAnswer> answers();

    [[nodiscard]] std::vector<float> read_depths() const;
    [[nodiscard]] std::uint64_t draw_calls() const { return draw_calls_; }

  private:
    struct Batch {
        unsigned vertex_array = 0, vertex_buffer = 0;
        bool painted = false;
        glm::vec3 colour{1.0f};
    };
    struct Question {
        std::uint64_t ticket = 0;
        unsigned query = 0;
    };

    void add_batch(const void* vertices, std::size_t bytes, const Batch& batch);
    [[nodiscard]] unsigned query_of(std::uint64_t ticket) const;

    std::vector<Batch> batches_;
    unsigned index_buffer_ = 0, program_ = 0, box_program_ = 0, box_array_ = 0;
    unsigned framebuffers_[2]{}, depths_[2]{}, colour_ = 0;
    Target target_ = Target::Picture;
    glm::dvec3 eye_{0.0};
    std::vector<Question> asked_;  ///< in flight
    std::vector<unsigned> spare_;  ///< query objects
    std::vector<rhview::QueryAnswer> answers_;
    std::uint64_t draw_calls_ = 0;
};

}  // namespace engine
