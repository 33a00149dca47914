// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Mattausch, Bittner & Wimmer 2008; where the paper leaves a choice, docs/rivals.md says which was taken.

#include "rhview/baselines/chc_plus_plus.h"

#include <algorithm>
#include <cmath>

#include "front_to_back.h"
#include "query_line.h"
#include "recorder.h"
#include "render_queue.h"

namespace rhview {
namespace {

/// p_keep is read from a table: beyond it e^-i is nothing.
constexpr std::uint32_t kLongestHidden = 31;

}  // namespace

class ChcPlusPlus::Frame {
  public:
    Frame(CullTree tree, const ChcPlusPlusOptions& options)
        : tree_(std::move(tree)), options_(options), random_(options.seed) {
        tree_.find_tight_bounds(options.tight);
        for (std::uint32_t i = 0; i <= kLongestHidden; ++i)
            p_keep_[i] = options.keep_certainty - options.keep_doubt * std::exp(-static_cast<double>(i));
    }

    void draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) {
        recorder_.begin(device, drawn);
        begin_frame(input);
        const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
        queue_.begin(tree_, frustum);
        queue_.push(0, frustum.mask);
        while (!queue_.empty() || !line_.empty()) {
            take_answers();
            if (!queue_.empty()) visit(queue_.pop());
            if (queue_.empty()) ask_hidden();
        }
        draw_queued();
        later_.clear();
        while (!asked_later_.empty()) {
            later_.push_back(asked_later_.pop());
            add_query(later_.back());
        }
        send_later();
    }

    [[nodiscard]] const CullTree& tree() const { return tree_; }

  private:
    struct State {
        std::uint32_t last_visited = 0;
        std::uint32_t next_query = 0;     ///< frame from which a visible leaf is asked about again
        std::uint32_t hidden_in_row = 0;  ///< answers
        bool visible = false;
        bool asked = false;  ///< as a visible leaf; the answer is not there yet
    };
    struct Waiting {
        Asked asked;
        std::uint32_t first_member = 0, member_count = 0;  ///< into `members_`
    };
    struct WaitingLeaf {
        Asked asked;
        std::uint32_t leaf = 0;
    };

    void begin_frame(const FrameInput& input) {
        ++number_;
        members_.clear();
        groups_of_objects_ = input.object_groups;
        tree_.set_objects(input.object_boxes, input.object_alive);
        const bool other_nodes = states_.size() != tree_.nodes().size();
        while (!leaves_.empty() && (other_nodes || recorder_.has_answer(leaves_.front().asked)))
            take_leaf_answer(leaves_.pop());
        states_.resize(tree_.nodes().size());
    }

    /// Of a leaf that was drawn in an earlier frame.
    void take_leaf_answer(const WaitingLeaf& waiting) {
        const bool seen = recorder_.take(waiting.asked);
        State& state = states_[waiting.leaf];
        state.asked = false;
        if (seen) {
            state.next_query = number_ + options_.visible_frames;
        } else {
            state.visible = false;
            state.hidden_in_row = 1;
        }
    }

    void take_answers() {
        while (!line_.empty()) {
            const bool ready = recorder_.has_answer(line_.front().asked);
            if (!ready && !queue_.empty()) return;
            if (!ready && !asked_later_.empty())
                ask_one_later();
            else
                answer(line_.pop());
        }
    }

    /// The nodes in its queue are not yet known to be seen or not.
    void visit(FrontToBack::Entry entry) {
        recorder_.count_visit();
        const FrontToBack::Place place = queue_.place(entry);
        if (place == FrontToBack::Place::Outside) return;
        State& state = states_[entry.node];
        const bool known = state.last_visited + 1 == number_;
        const bool was_visible = known && state.visible;
        if (!known) state.hidden_in_row = 0;
        state.last_visited = number_;
        if (place == FrontToBack::Place::AtEye) return show(entry, was_visible);
        if (was_visible) return traverse(entry, state.next_query <= number_ && !state.asked);
        state.visible = false;
        hidden_.push_back(entry);
        if (hidden_.size() >= options_.batch) ask_hidden();
    }

    /// A node that was proved visible, or may not be asked about.
    void show(const FrontToBack::Entry& entry, bool was_visible) {
        traverse(entry, false);
        pull_up(entry.node);
        State& state = states_[entry.node];
        state.hidden_in_row = 0;
        if (!was_visible) state.next_query = number_ + first_wait();
    }

    /// Draws a leaf, `ask`ing about it for the next frame, or goes on to the children.
    void traverse(const FrontToBack::Entry& entry, bool ask) {
        states_[entry.node].visible = false;
        if (!tree_.is_leaf(entry.node)) return queue_.push_children(entry);
        const std::span<const DrawRange> ranges = tree_.ranges(entry.node);
        const std::span<const ObjectId> objects = tree_.objects(entry.node);
        const bool one = ranges.size() + objects.size() == 1;
        if (ask && one && options_.visible_query == VisibleQuery::Geometry) {
            render_queue_.add_asked(entry.node, ranges, objects);
        } else {
            render_queue_.add(ranges, objects);
            if (ask) asked_later_.push(entry.node);
        }
        recorder_.chose(entry.node);
        states_[entry.node].asked = states_[entry.node].asked || ask;
        pull_up(entry.node);
    }

    void pull_up(std::uint32_t node) {
        while (!states_[node].visible) {
            states_[node].visible = true;
            node = tree_.nodes()[node].parent;
        }
    }

    void draw_queued() {
        render_queue_.flush(recorder_, groups_of_objects_, [&](std::uint32_t leaf, const Asked& asked) {
            leaves_.push({asked, leaf});
        });
    }

    void answer(const Waiting& waiting) {
        const bool seen = recorder_.take(waiting.asked);
        if (seen && waiting.member_count == 1) return show(members_[waiting.first_member], false);
        if (seen) return ask_each(waiting);
        for (std::uint32_t m = 0; m < waiting.member_count; ++m)
            ++states_[members_[waiting.first_member + m].node].hidden_in_row;
    }

    /// The members of a query that saw something, each on its own.
    void ask_each(const Waiting& waiting) {
        draw_queued();
        groups_.clear();
        for (std::uint32_t m = 0; m < waiting.member_count; ++m) {
            add_query(members_[waiting.first_member + m].node);
            groups_.push_back({{}, waiting.first_member + m, 1});
        }
        send_groups();
    }

    /// All hidden nodes that were collected, in as few queries as will probably do.
    void ask_hidden() {
        if (hidden_.empty()) return;
        draw_queued();
        std::ranges::sort(hidden_, [&](const FrontToBack::Entry& a, const FrontToBack::Entry& b) {
            const std::uint32_t of_a = states_[a.node].hidden_in_row, of_b = states_[b.node].hidden_in_row;
            if (of_a != of_b) return of_a > of_b;
            return a.distance != b.distance ? a.distance < b.distance : a.node < b.node;
        });
        const auto first = static_cast<std::uint32_t>(members_.size());
        members_.insert(members_.end(), hidden_.begin(), hidden_.end());
        hidden_.clear();
        groups_.clear();
        for (auto next = first; next < members_.size(); next += groups_.back().member_count) {
            groups_.push_back({{}, next, group_size(next)});
            recorder_.begin_query();
            for (std::uint32_t m = next; m < next + groups_.back().member_count; ++m)
                add_boxes(members_[m].node);
        }
        send_groups();
    }

    /// Members from `first` on of the most valuable query: nodes decided per expected query. One alone is
    /// never asked in vain.
    [[nodiscard]] std::uint32_t group_size(std::uint32_t first) const {
        double all_keep = p_keep(members_[first].node);
        double value = 1.0;
        std::uint32_t count = 1;
        while (first + count < members_.size()) {
            all_keep *= p_keep(members_[first + count].node);
            const double size = count + 1;
            const double next_value = size / (1.0 + (1.0 - all_keep) * size);
            if (!(next_value > value)) break;
            value = next_value;
            ++count;
        }
        return count;
    }

    [[nodiscard]] double p_keep(std::uint32_t node) const {
        return p_keep_[std::min(states_[node].hidden_in_row, kLongestHidden)];
    }

    void add_boxes(std::uint32_t node) {
        for (const std::uint32_t part : tree_.tight(node)) recorder_.add_box(tree_.nodes()[part].bounds);
    }

    void add_query(std::uint32_t node) {
        recorder_.begin_query();
        add_boxes(node);
    }

    void send_groups() {
        asked_.clear();
        recorder_.ask(asked_);
        for (std::size_t i = 0; i < asked_.size(); ++i) {
            groups_[i].asked = asked_[i];
            line_.push(groups_[i]);
        }
    }

    /// The next visible leaf's query, while there is nothing else to do.
    void ask_one_later() {
        draw_queued();
        later_.assign(1, asked_later_.pop());
        add_query(later_.front());
        send_later();
    }

    void send_later() {
        asked_.clear();
        recorder_.ask(asked_);
        for (std::size_t i = 0; i < asked_.size(); ++i) leaves_.push({asked_[i], later_[i]});
    }

    /// Frames, so that what turned visible together is not asked about together: 0 < r < n_av.
    std::uint32_t first_wait() {
        random_ = 6364136223846793005ull * random_ + 1442695040888963407ull;
        const std::uint32_t most = std::max(options_.visible_frames, 2u) - 1;
        return 1 + static_cast<std::uint32_t>((random_ >> 33) % most);
    }

    CullTree tree_;
    ChcPlusPlusOptions options_;
    std::uint64_t random_;
    double p_keep_[kLongestHidden + 1] = {};
    FrontToBack queue_;
    Recorder recorder_;
    RenderQueue render_queue_;
    std::span<const std::uint32_t> groups_of_objects_;  ///< of the frame
    QueryLine<Waiting> line_;                           ///< of hidden nodes, this frame's
    QueryLine<WaitingLeaf> leaves_;                     ///< of visible leaves
    std::vector<State> states_;                         ///< by node
    std::vector<FrontToBack::Entry> hidden_;            ///< the i-queue
    QueryLine<std::uint32_t> asked_later_;              ///< the v-queue
    std::vector<std::uint32_t> later_;                  ///< of it, about to be sent
    std::vector<FrontToBack::Entry> members_;           ///< of this frame's queries
    std::vector<Waiting> groups_;                       ///< about to be sent
    std::vector<Asked> asked_;
    std::uint32_t number_ = 1;  ///< of the frame; the first is 2, so that 0 is never the one before
};

ChcPlusPlus::ChcPlusPlus(CullTree tree, const ChcPlusPlusOptions& options)
    : frame_(std::make_unique<Frame>(std::move(tree), options)) {}
ChcPlusPlus::~ChcPlusPlus() = default;

void ChcPlusPlus::draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) {
    frame_->draw(input, device, drawn);
}

Aabb ChcPlusPlus::bounds_of(std::uint32_t chosen) const {
    return frame_->tree().nodes()[chosen].bounds;
}

}  // namespace rhview
