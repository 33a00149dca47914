// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Draw calls, counted where OpenGL is called.
#pragma once

#include <osg/PrimitiveSet>

#include <cstdint>

struct DrawCounter {
    std::uint64_t calls = 0, triangles = 0;

    void count(std::uint64_t indices) {
        ++calls;
        triangles += indices / 3;
    }
};

/// Triangles of a geometry, which OpenSceneGraph draws with one call.
class CountedTriangles final : public osg::DrawElementsUShort {
  public:
    /// `counter` lives as long as the triangles are drawn.
    explicit CountedTriangles(DrawCounter& counter) : DrawElementsUShort(GL_TRIANGLES), counter_(counter) {}

    void draw(osg::State& state, bool use_buffers) const override {
        counter_.count(size());
        DrawElementsUShort::draw(state, use_buffers);
    }

  private:
    DrawCounter& counter_;
};
