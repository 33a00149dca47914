// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "case_run.h"

#include <algorithm>
#include <optional>

#include "any_target.h"
#include "catalogue_methods.h"
#include "rhview/gl/context.h"
#include "rhview/scenes/object_motion.h"
#include "vertex_error.h"

namespace rhview {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr ClipDepth kDepths[] = {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne,
                                 ClipDepth::ReversedZeroToOne};

/// Where a case is drawn: into floating-point depths, or any others.
class Picture {
  public:
    explicit Picture(GLenum format) : scratch_(gl::RenderTarget::create(kWidth, kHeight).value()) {
        if (format != GL_DEPTH_COMPONENT32F) other_.emplace(format, 1);
    }
    void begin(ClipDepth depth) { other_ ? other_->begin(depth) : scratch_.begin(depth, glm::vec3(0.0f)); }
    void read(std::vector<float>& depths) {
        if (other_)
            depths = other_->read(scratch_);
        else
            scratch_.read_depth(depths);
    }

  private:
    gl::RenderTarget scratch_;
    std::optional<gl::AnyTarget> other_;
};

/// The same, a call per static triangle.
FramePlan one_by_one(FramePlan plan) {
    std::vector<DrawRange> triangles;
    for (const DrawRange& range : plan.opaque)
        for (std::uint32_t first = 0; first < range.index_count; first += 3)
            triangles.push_back({range.batch, range.first_index + first, 3});
    plan.opaque = std::move(triangles);
    return plan;
}

class CaseRun {
  public:
    CaseRun(const HardCase& hard_case, int views, Amount amount)
        : case_(hard_case),
          views_(views),
          amount_(amount),
          scene_(hard_case.make(amount)),
          boxes_(scene_.scene.object_boxes()),
          groups_(object_groups(scene_.scene)) {
        tally_.static_triangles = scene_.scene.batch_triangles();
        tally_.objects = boxes_.size();
    }

    Tally all_frames() {
        gl::Executor executor = gl::Executor::create().value();
        gl::SteppedExecutor stepped = gl::SteppedExecutor::create(executor).value();
        device_.emplace(CatalogueDevice{executor, stepped});
        methods_ = catalogue_methods(scene_.scene, case_.is_large);
        const gl::SceneBuffers source_order = gl::SceneBuffers::upload(scene_.scene).value();
        Uniform uniform(7);
        for (const GLenum format : {GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT16}) {
            if (format != GL_DEPTH_COMPONENT32F && !case_.every_depth_format) continue;
            Picture picture(format);
            for (const ClipDepth depth : kDepths)
                for (const View& view : views_of(case_, scene_, depth, amount_, views_, uniform))
                    one_view(view, source_order, picture);
        }
        for (const CatalogueMethod& method : methods_) tally_.hidden += method.hidden;
        return tally_;
    }

  private:
    void one_view(const View& view, const gl::SceneBuffers& source_order, Picture& picture) {
        FrameInput input{view, scene_.scene.origin, boxes_, {kWidth, kHeight}};
        input.object_groups = groups_;
        const FramePlan everything = everything_of(scene_.scene, input);
        const std::uint64_t all_indices = draw_reference(everything, view, source_order, picture, reference_);
        draw_reference(one_by_one(everything), view, source_order, picture, other_reference_);
        const float farthest = view.clip_depth == ClipDepth::ReversedZeroToOne ? 0.0f : 1.0f;
        for (std::size_t pixel = 0; pixel < reference_.size(); ++pixel) {
            tally_.covered += reference_[pixel] != farthest ? 1 : 0;
            if (reference_[pixel] != other_reference_[pixel]) ++tally_.undecided;
        }
        ++tally_.views;
        tally_.worst_error_px =
            std::max(tally_.worst_error_px, worst_vertex_error_px(scene_.scene, view, 1920.0, 1440.0));
        for (CatalogueMethod& method : methods_) {
            stand(method, input, picture);
            if (method.name != "rhview, exact, box pass") continue;
            tally_.indices += counters_.indices + counters_.conditional_indices;
            tally_.all_indices += all_indices;
        }
    }

    /// The number of indices.
    std::uint64_t draw_reference(const FramePlan& plan, const View& view, const gl::SceneBuffers& buffers,
                                 Picture& picture, std::vector<float>& depths) {
        picture.begin(view.clip_depth);
        const std::uint64_t indices = device_->executor.draw(plan, buffers, view).indices;
        picture.read(depths);
        return indices;
    }

    [[nodiscard]] std::uint64_t missing_pixels() const {
        std::uint64_t missing = 0;
        for (std::size_t pixel = 0; pixel < depths_.size(); ++pixel)
            if (depths_[pixel] != reference_[pixel] && reference_[pixel] == other_reference_[pixel])
                ++missing;
        return missing;
    }

    /// The frame that is promised first, and one more, which knows what the first was answered.
    void stand(CatalogueMethod& method, const FrameInput& input, Picture& picture) {
        for (int frame = 1; frame <= method.frames_to_promise + 1; ++frame) {
            const bool promised = frame >= method.frames_to_promise;
            picture.begin(input.culling_view.clip_depth);
            counters_ = method.draw(input, device_.value(),
                                    frame % 2 == 0 ? gl::Submission::MultiDraw : gl::Submission::Plain);
            ++tally_.frames;
            picture.read(depths_);
            const std::uint64_t missing = missing_pixels();
            (promised ? tally_.missing : tally_.late) += missing;
            if (promised && missing > 0 && tally_.first_missing.empty())
                tally_.first_missing = method.name + ", view " + std::to_string(tally_.views) + ", frame " +
                                       std::to_string(frame);
        }
    }

    const HardCase& case_;
    int views_;
    Amount amount_;
    HardScene scene_;
    std::vector<Aabb> boxes_;
    std::vector<std::uint32_t> groups_;
    std::optional<CatalogueDevice> device_;
    std::vector<CatalogueMethod> methods_;
    std::vector<float> reference_, other_reference_, depths_;
    gl::FrameCounters counters_;
    Tally tally_;
};

}  // namespace

Tally run_case(const HardCase& hard_case, int views, Amount amount) {
    return CaseRun(hard_case, views, amount).all_frames();
}

}  // namespace rhview
