// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "picture.h"

#include <chrono>

using Clock = std::chrono::steady_clock;

/// Called when all of a frame was submitted.
class Picture::Finish final : public osg::Camera::DrawCallback {
  public:
    void operator()(osg::RenderInfo&) const override {
        glFinish();
        end = Clock::now();
        glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    }

    mutable Clock::time_point end;
    mutable std::vector<unsigned char> pixels = std::vector<unsigned char>(4 * kWidth * kHeight);
};

namespace {

/// Nobody looks at what was drawn but `Finish`.
class NoSwap final : public osg::GraphicsContext::SwapCallback {
  public:
    void swapBuffersImplementation(osg::GraphicsContext*) override {}
};

}  // namespace

Picture::Picture(osg::Node& scene) : finish_(new Finish) {
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->width = kWidth;
    traits->height = kHeight;
    traits->red = traits->green = traits->blue = traits->alpha = 8;
    traits->depth = 24;
    traits->doubleBuffer = true;
    traits->pbuffer = true;
    const osg::ref_ptr<osg::GraphicsContext> context = osg::GraphicsContext::createGraphicsContext(traits);
    if (!context) return;
    context->setSwapCallback(new NoSwap);

    osg::Camera& camera = *viewer_.getCamera();
    camera.setGraphicsContext(context);
    camera.setDrawBuffer(GL_BACK);
    camera.setReadBuffer(GL_BACK);
    camera.setViewport(0, 0, kWidth, kHeight);
    camera.setClearColor({0.7f, 0.8f, 0.9f, 1.0f});
    camera.setProjectionMatrixAsPerspective(60.0, static_cast<double>(kWidth) / kHeight, 0.5, 2000.0);
    // Pictures are compared: nothing small is left out, and near and far stay where they are.
    camera.setCullingMode(osg::CullSettings::VIEW_FRUSTUM_CULLING);
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setFinalDrawCallback(finish_);
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    viewer_.setSceneData(&scene);
    viewer_.realize();
}

Picture::~Picture() = default;

double Picture::render(const osg::Matrixd& camera_from_world) {
    viewer_.getCamera()->setViewMatrix(camera_from_world);
    const Clock::time_point start = Clock::now();
    viewer_.frame();
    return std::chrono::duration<double, std::milli>(finish_->end - start).count();
}

const std::vector<unsigned char>& Picture::pixels() const {
    return finish_->pixels;
}
