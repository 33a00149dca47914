// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "front_to_back.h"
#include "recorder.h"
#include "rhview/baselines/nested_grid.h"

namespace rhview {

class StopAndWait::Frame {
  public:
    explicit Frame(CullTree tree) : tree_(std::move(tree)) {}

    void draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) {
        tree_.set_objects(input.object_boxes, input.object_alive);
        const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
        recorder_.begin(device, drawn);
        queue_.begin(tree_, frustum);
        queue_.push(0, frustum.mask);
        while (!queue_.empty()) {
            FrontToBack::Entry entry = queue_.pop();
            recorder_.count_visit();
            const FrontToBack::Place place = queue_.place(entry);
            if (place == FrontToBack::Place::Outside) continue;
            if (place == FrontToBack::Place::InSight && entry.node != 0 && !is_seen(entry.node)) continue;
            if (tree_.is_leaf(entry.node))
                draw_leaf(entry.node);
            else
                queue_.push_children(entry);
        }
    }

    [[nodiscard]] const CullTree& tree() const { return tree_; }

  private:
    bool is_seen(std::uint32_t node) {
        recorder_.begin_query();
        recorder_.add_box(tree_.nodes()[node].bounds);
        asked_.clear();
        recorder_.ask(asked_);
        return recorder_.take(asked_.front());
    }

    void draw_leaf(std::uint32_t leaf) {
        recorder_.draw(tree_.ranges(leaf), tree_.objects(leaf));
        recorder_.chose(leaf);
    }

    CullTree tree_;
    FrontToBack queue_;
    Recorder recorder_;
    std::vector<Asked> asked_;
};

StopAndWait::StopAndWait(CullTree tree) : frame_(std::make_unique<Frame>(std::move(tree))) {}
StopAndWait::~StopAndWait() = default;

void StopAndWait::draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) {
    frame_->draw(input, device, drawn);
}

Aabb StopAndWait::bounds_of(std::uint32_t chosen) const {
    return frame_->tree().nodes()[chosen].bounds;
}

}  // namespace rhview
