// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Boxes and frusta as lines over a picture.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/view.h"
#include "rhview/gl/handle.h"

namespace rhview::gl {

/// World positions, two per line.
struct Lines {
    std::vector<glm::dvec3> points;

    /// The twelve edges of a box relative to `origin`.
    void add_box(const Aabb& box, const glm::dvec3& origin);
    /// The edges of the view's frustum, from the eye; one longer than `reach` metres is cut there.
    void add_frustum(const View& view, double reach);
};

/// Draws lines of one width over a picture.
class LineDrawer {
  public:
    /// Needs a current context, which outlives it.
    static Result<LineDrawer> create();

    /// Draws into the bound framebuffer, over everything; state is put back.
    void draw(const Lines& lines, const View& view, const glm::vec3& colour);

  private:
    Program program_;
    VertexArray vertex_array_;
    Buffer buffer_;
    int colour_ = -1;
};

}  // namespace rhview::gl
