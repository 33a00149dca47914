// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "plan_picture.h"
#include "rhview/gl/render_target.h"

namespace rhview::cli {

/// What was drawn of a scene, seen from above.
class ViewFromAbove {
  public:
    static Result<ViewFromAbove> create(int width, int height);

    gl::Picture draw(const PicturedPlan& pictured, gl::Executor& executor);

  private:
    ViewFromAbove(gl::RenderTarget target, PlanPicture picture);

    gl::RenderTarget target_;
    PlanPicture picture_;
};

}  // namespace rhview::cli
