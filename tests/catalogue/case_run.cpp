// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "case_run.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <optional>

#include "any_target.h"
#include "catalogue_methods.h"
#include "rhview/gl/context.h"
#include "rhview/rhoctree/facing.h"
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

/// The same, a call per static triangle; those that `shown` refuses are left out.
template <class Shown>
FramePlan one_by_one(const FramePlan& plan, const Shown& shown) {
    FramePlan result = plan;
    result.opaque.clear();
    result.conditional.clear();
    const auto split = [&](const DrawRange& range, const auto& add) {
        for (std::uint32_t first = range.first_index; first < range.first_index + range.index_count;
             first += 3)
            if (const DrawRange triangle{range.batch, first, 3}; shown(triangle)) add(triangle);
    };
    for (const DrawRange& range : plan.opaque)
        split(range, [&](const DrawRange& triangle) { result.opaque.push_back(triangle); });
    for (const ConditionalRange& conditional : plan.conditional)
        split(conditional.range, [&](const DrawRange& triangle) {
            result.conditional.push_back({triangle, conditional.query});
        });
    return result;
}

FramePlan one_by_one(const FramePlan& plan) {
    return one_by_one(plan, [](const DrawRange&) { return true; });
}

using Corners = std::array<glm::dvec3, 3>;

/// Whether a triangle shows its back, to a perspective from `eye`, by the margin that `faces_away` has.
bool is_turned_away(const Corners& corners, const glm::dvec3& eye) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    return std::ranges::all_of(corners, [&](const glm::dvec3& corner) {
        const glm::dvec3 ray = corner - eye;
        return glm::dot(normal, ray) >=
               static_cast<double>(kFacingSlack) * glm::length(normal) * glm::length(ray);
    });
}

/// The shortest altitude of corners in a plane or in space, in their unit.
double altitude(const Corners& corners) {
    const glm::dvec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0], bc = corners[2] - corners[1];
    const double longest = std::max({glm::length(ab), glm::length(ac), glm::length(bc)});
    return longest > 0.0 ? glm::length(glm::cross(ab, ac)) / longest : 0.0;
}

/// How thin a triangle is on the picture, pixels. One that reaches behind the eye is any size there: then
/// the share that its altitude has of its size, as if that were the picture's.
double thickness_px(const Corners& corners, const View& view, const glm::dvec3& eye) {
    const glm::dmat4 clip = view.clip_from_eye_relative();
    Corners pixels;
    bool is_before_eye = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4 p = clip * glm::dvec4(corners[i] - eye, 1.0);
        is_before_eye = is_before_eye && p.w > 0.0;
        pixels[i] = {0.5 * kWidth * p.x / p.w, 0.5 * kHeight * p.y / p.w, 0.0};
    }
    if (is_before_eye) return altitude(pixels);
    const double size = std::max(glm::length(corners[1] - corners[0]), glm::length(corners[2] - corners[0]));
    return size > 0.0 ? kWidth * altitude(corners) / size : 0.0;
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
        std::uint32_t first = 0;
        for (const SceneBatch& batch : scene_.scene.batches) {
            batch_first_.push_back(first);
            first += static_cast<std::uint32_t>(batch.indices.size());
        }
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
        const std::uint64_t all_indices = draw_plan(everything, view, source_order, picture, reference_);
        draw_plan(one_by_one(everything), view, source_order, picture, single_);
        const auto is_certain = [&](const DrawRange& triangle) { return !is_drawn_by_luck(triangle, view); };
        draw_plan(one_by_one(everything, is_certain), view, source_order, picture, certain_);
        const float farthest = view.clip_depth == ClipDepth::ReversedZeroToOne ? 0.0f : 1.0f;
        for (std::size_t pixel = 0; pixel < reference_.size(); ++pixel) {
            tally_.covered += reference_[pixel] != farthest ? 1 : 0;
            tally_.undecided += reference_[pixel] != single_[pixel] ? 1 : 0;
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
    std::uint64_t draw_plan(const FramePlan& plan, const View& view, const gl::SceneBuffers& buffers,
                            Picture& picture, std::vector<float>& depths) {
        picture.begin(view.clip_depth);
        const std::uint64_t indices = device_->executor.draw(plan, buffers, view).indices;
        picture.read(depths);
        return indices;
    }

    /// `triangle` is of the scene's own order of indices.
    [[nodiscard]] bool is_drawn_by_luck(const DrawRange& triangle, const View& view) const {
        const SceneBatch& batch = scene_.scene.batches[index_of(triangle.batch)];
        const std::uint32_t first = triangle.first_index - batch_first_[index_of(triangle.batch)];
        const auto corner = [&](std::uint32_t i) {
            return glm::dvec3(scene_.scene.pools[batch.pool].positions[batch.indices[first + i]]);
        };
        const Corners corners{corner(0), corner(1), corner(2)};
        const glm::dvec3 eye = view.eye() - scene_.scene.origin;
        const double thickness = thickness_px(corners, view, eye);
        const bool is_perspective = view.clip_from_camera[3][3] == 0.0;
        return thickness < 1.0 / 16.0 ||
               (thickness < 1.06 && is_perspective &&
                !scene_.scene.materials[index_of(batch.material)].two_sided && is_turned_away(corners, eye));
    }

    /// Of the frame just drawn, against drawing everything.
    [[nodiscard]] bool differs(const std::vector<float>& expected) const {
        for (std::size_t pixel = 0; pixel < depths_.size(); ++pixel)
            if (depths_[pixel] != expected[pixel] && reference_[pixel] == single_[pixel]) return true;
        return false;
    }

    /// Pixels of the frame just drawn that differ, in this frame and with a call per triangle.
    std::uint64_t missing_pixels(const CatalogueMethod& method, const View& view, bool promised,
                                 Picture& picture) {
        if (!differs(reference_)) return 0;
        draw_plan(one_by_one(method.last_plan()), view, method.buffers, picture, depths_);
        gl::finish();
        answers_.clear();
        device_->executor.poll_answers(answers_);  // the method has had them
        std::uint64_t missing = 0;
        for (std::size_t pixel = 0; pixel < depths_.size(); ++pixel) {
            if (depths_[pixel] == single_[pixel] || reference_[pixel] != single_[pixel]) continue;
            const bool is_certain = single_[pixel] == certain_[pixel];
            missing += is_certain ? 1 : 0;
            tally_.doubtful += promised && !is_certain ? 1 : 0;
        }
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
            const std::uint64_t missing = missing_pixels(method, input.culling_view, promised, picture);
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
    std::vector<float> reference_, single_, certain_, depths_;
    std::vector<std::uint32_t> batch_first_;  ///< indices before a batch's
    std::vector<QueryAnswer> answers_;
    gl::FrameCounters counters_;
    Tally tally_;
};

}  // namespace

Tally run_case(const HardCase& hard_case, int views, Amount amount) {
    return CaseRun(hard_case, views, amount).all_frames();
}

}  // namespace rhview
