// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "frame_comparison.h"

#include <fmt/format.h>

#include <algorithm>

#include "rhview/gl/executor.h"
#include "rhview/rhoctree/draw_list.h"

namespace rhview::cli {
namespace {

constexpr glm::vec3 kSky(0.74f, 0.82f, 0.90f);

}  // namespace

void WalkStage::clear() const {
    target->begin(clip_depth, kSky);
}

FrameComparison::FrameComparison(const WalkStage& stage)
    : stage_(stage),
      scene_(stage.ground.loaded.scene),
      bounds_(scene_.bounds()),
      reference_(make_reference(scene_)) {}

Result<FrameComparison> FrameComparison::create(const WalkStage& stage) {
    FrameComparison comparison(stage);
    if (Status status = comparison.prepare(); !status) return status.error();
    return comparison;
}

Status FrameComparison::prepare() {
    const WalkOptions& options = stage_.options;
    const PictureSize size = stage_.ground.size;
    const bool times_delays = options.mode == "latent" && options.check && options.check_every == 1;
    if (times_delays) delays_.emplace(stage_.method.octree->nodes().size() + scene_.object_count());
    if (options.visible_set || times_delays) {
        Result<gl::ItemBuffer> items = gl::ItemBuffer::create(size.width, size.height);
        if (!items) return Error{"--size: " + items.error().message};
        items_.emplace(std::move(items).value());
        list_leaves();
    }
    if (options.images) {
        Result<ViewFromAbove> above = ViewFromAbove::create(size.width, size.height);
        if (!above) return above.error();
        above_.emplace(std::move(above).value());
    }
    return success();
}

/// The octree's leaves as items, in their batches' order.
void FrameComparison::list_leaves() {
    const RhOctree& octree = *stage_.method.octree;
    for (std::uint32_t i = 0; i < octree.nodes().size(); ++i)
        if (octree.is_leaf(NodeId{i}))
            for (const DrawRange& range : octree.ranges(NodeId{i})) leaves_.push_back({range, i});
    std::ranges::stable_sort(leaves_, {}, [](const gl::ItemRange& leaf) { return leaf.range.batch; });
}

void FrameComparison::place_all(const WalkedFrame& frame) {
    stage_.objects.place_all(frame.time_s);
    if (stage_.levels)
        all_levels_ =
            stage_.levels->complete(stage_.objects.input(frame.culling, stage_.viewport()), frame.plan);
}

std::uint64_t FrameComparison::visible_set_indices(const WalkedFrame& frame) {
    std::uint64_t indices = 0;
    for (const std::uint32_t leaf : items_->visible_items(leaves_, stage_.buffers, frame.view,
                                                          stage_.objects.scene_from_mesh(), all_levels_))
        indices += 3 * std::uint64_t{stage_.method.octree->node(NodeId{leaf}).triangle_count};
    return indices;
}

/// At the levels of `place_all`.
void FrameComparison::plan_everything(const View& view) {
    reference_->plan(stage_.objects.input(view, stage_.viewport()), everything_);
    if (stage_.levels)
        for (const ObjectId object : everything_.objects)
            everything_.object_levels.push_back(all_levels_[index_of(object)]);
}

void FrameComparison::draw_everything(const View& view) {
    gl::DrawOptions draw;
    draw.placements = stage_.objects.scene_from_mesh();
    stage_.clear();
    stage_.executor.draw(everything_, stage_.buffers, view, draw);
}

PicturedPlan FrameComparison::describe(const WalkedFrame& frame) {
    to_show_.clear();
    if (stage_.options.method == "rhview")
        append_ranges_to_show(*stage_.method.octree, make_frustum(frame.culling, scene_.origin),
                              make_viewpoint(frame.culling, scene_.origin), to_show_);
    return {everything_,
            frame.plan,
            frame.answers,
            to_show_,
            [&method = stage_.method](std::uint32_t chosen) { return method.bounds_of(chosen); },
            stage_.buffers,
            bounds_,
            frame.culling,
            stage_.objects.scene_from_mesh()};
}

PicturedPlan FrameComparison::pictured(const WalkedFrame& frame) {
    place_all(frame);
    plan_everything(frame.culling);
    return describe(frame);
}

Status FrameComparison::compare(const WalkedFrame& frame, bool checked, bool pictured, FrameRecord& record) {
    place_all(frame);
    stage_.target->read_depth(culled_depths_);
    std::optional<gl::Picture> culled;
    if (pictured) culled.emplace(stage_.target->read_colour());
    plan_everything(frame.view);
    draw_everything(frame.view);
    stage_.target->read_depth(reference_depths_);
    const std::size_t missing = gl::count_missing_pixels(culled_depths_, reference_depths_);
    if (checked) record.missing_pixels = missing;
    if (checked && delays_)
        record.late_items = delays_->add_frame(
            items_->item_pixels(leaves_, static_cast<std::uint32_t>(stage_.method.octree->nodes().size()),
                                stage_.buffers, frame.view, stage_.objects.scene_from_mesh(), all_levels_),
            culled_depths_, reference_depths_);
    return pictured ? save_pictures(frame, std::move(*culled), missing, record) : success();
}

Status FrameComparison::save_pictures(const WalkedFrame& frame, gl::Picture culled, std::size_t missing,
                                      const FrameRecord& record) {
    const std::string& method = stage_.options.method;
    gl::Picture reference = stage_.target->read_colour();
    gl::Picture difference = gl::difference_picture(reference, culled_depths_, reference_depths_);
    gl::Picture above = above_->draw(describe(frame), stage_.executor);
    culled.label(fmt::format("{}, frame {}: {} draw calls, {:.2f} M indices", method, frame.number,
                             record.work.draw_calls, record.work.indices * 1e-6));
    reference.label("everything drawn");
    difference.label(fmt::format("missing pixels (red): {}", missing));
    above.label(!frame.plan.queries.empty()
                    ? "from above: a colour per call, gaps violet; asked about: blue hidden, green seen"
                : method == "rhview"
                    ? "from above: a colour per call (replicas blue, green), gaps violet, rest grey"
                    : "from above: a colour per call, rest grey, nodes blue, frustum red");
    return gl::sheet(culled, reference, difference, above)
        .save_png(*stage_.options.images / fmt::format("frame_{:04}.png", frame.number));
}

void FrameComparison::keep_picture() {
    kept_.emplace(stage_.target->read_colour());
    stage_.target->read_depth(kept_depths_);
}

gl::ImageDifference FrameComparison::image_error(const WalkedFrame& frame) {
    ReferenceFrame& reference = *stage_.ground.reference;
    if (reference.frame != frame.number) {
        stage_.objects.place_all(frame.time_s);
        reference_->plan(stage_.objects.input(frame.view, stage_.viewport()), everything_);
        draw_everything(frame.view);
        reference.colour.emplace(stage_.target->read_colour());
        stage_.target->read_depth(reference.depths);
        reference.frame = frame.number;
    }
    return gl::image_difference(*kept_, kept_depths_, *reference.colour, reference.depths, frame.view);
}

std::optional<std::vector<double>> FrameComparison::reveal_frames() const {
    if (!delays_) return std::nullopt;
    return delays_->frames();
}

}  // namespace rhview::cli
