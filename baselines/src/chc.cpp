// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/chc.h"

#include "front_to_back.h"
#include "query_line.h"
#include "recorder.h"

namespace rhview {

class Chc::Frame {
  public:
    explicit Frame(CullTree tree) : tree_(std::move(tree)) {}

    void draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) {
        ++number_;
        tree_.set_objects(input.object_boxes, input.object_alive);
        states_.resize(tree_.nodes().size());
        const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
        recorder_.begin(device, drawn);
        queue_.begin(tree_, frustum);
        queue_.push(0, frustum.mask);
        while (!queue_.empty() || !line_.empty()) {
            while (!line_.empty() && (queue_.empty() || recorder_.has_answer(line_.front().asked)))
                answer(line_.pop());
            if (!queue_.empty()) visit(queue_.pop());
        }
    }

    [[nodiscard]] const CullTree& tree() const { return tree_; }

  private:
    struct State {
        std::uint32_t last_visited = 0;
        bool visible = false;
    };
    struct Waiting {
        Asked asked;
        FrontToBack::Entry entry;
        bool was_visible = false;  ///< and is drawn already: not again when the answer comes
    };

    void visit(FrontToBack::Entry entry) {
        recorder_.count_visit();
        const FrontToBack::Place place = queue_.place(entry);
        if (place == FrontToBack::Place::Outside) return;
        State& state = states_[entry.node];
        const bool was_visible = state.visible && state.last_visited + 1 == number_;
        state = {number_, false};
        if (place == FrontToBack::Place::AtEye) {
            pull_up(entry.node);
            return traverse(entry);
        }
        if (!was_visible) return line_.push({ask_box(entry.node), entry, false});
        if (!tree_.is_leaf(entry.node)) return traverse(entry);
        recorder_.chose(entry.node);
        line_.push(
            {recorder_.draw_and_ask(tree_.ranges(entry.node), tree_.objects(entry.node)), entry, true});
    }

    void answer(const Waiting& waiting) {
        if (!recorder_.take(waiting.asked)) return;
        pull_up(waiting.entry.node);
        if (!waiting.was_visible) traverse(waiting.entry);
    }

    void traverse(const FrontToBack::Entry& entry) {
        if (!tree_.is_leaf(entry.node)) return queue_.push_children(entry);
        recorder_.chose(entry.node);
        recorder_.draw(tree_.ranges(entry.node), tree_.objects(entry.node));
    }

    /// What a visible node is in is visible.
    void pull_up(std::uint32_t node) {
        while (!states_[node].visible) {
            states_[node].visible = true;
            node = tree_.nodes()[node].parent;
        }
    }

    Asked ask_box(std::uint32_t node) {
        recorder_.begin_query();
        recorder_.add_box(tree_.nodes()[node].bounds);
        asked_.clear();
        recorder_.ask(asked_);
        return asked_.front();
    }

    CullTree tree_;
    FrontToBack queue_;
    Recorder recorder_;
    QueryLine<Waiting> line_;
    std::vector<State> states_;
    std::vector<Asked> asked_;
    std::uint32_t number_ = 1;  ///< of the frame; the first is 2, so that 0 is never the one before
};

Chc::Chc(CullTree tree) : frame_(std::make_unique<Frame>(std::move(tree))) {}
Chc::~Chc() = default;

void Chc::draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) {
    frame_->draw(input, device, drawn);
}

Aabb Chc::bounds_of(std::uint32_t chosen) const {
    return frame_->tree().nodes()[chosen].bounds;
}

}  // namespace rhview
