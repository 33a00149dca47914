// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// A viewer of OpenSceneGraph without a window.
#pragma once

#include <osgViewer/Viewer>

#include <vector>

class Picture {
  public:
    static constexpr int kWidth = 960, kHeight = 540;

    /// Shows `scene`, of which OpenSceneGraph leaves out what is outside of the frustum, and nothing else.
    explicit Picture(osg::Node& scene);
    ~Picture();
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    /// False: there is no graphics context to be had.
    [[nodiscard]] bool is_ready() const { return viewer_.isRealized(); }

    /// Culling or planning, submission and completion, ms.
    double render(const osg::Matrixd& camera_from_world);
    /// RGBA, of the last frame.
    [[nodiscard]] const std::vector<unsigned char>& pixels() const;

  private:
    class Finish;

    osgViewer::Viewer viewer_;
    osg::ref_ptr<Finish> finish_;
};
