// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "allocations.h"
#include "fake_gpu.h"
#include "rhview/occlusion_queries/occlusion_scheduler.h"
#include "uniform.h"

namespace rhview {

/// A world in the plane: discs, and an eye that sees 90 degrees of it in columns with a depth each. Small
/// enough to know exactly what is visible, of the world and against what was drawn.
class FlatWorld {
  public:
    static constexpr int kColumns = 512;
    static constexpr int kColumnPixels = 300;  ///< a disc is so high, anywhere
    static constexpr double kScreenPixels = double{kColumns} * kColumnPixels;

    struct Disc {
        double x = 0, y = 0, radius = 1;
        float render_ns = 1000;
        bool exists = true;
    };
    struct Eye {
        double x = 0, y = 0, heading = 0;
    };

    std::vector<Disc> discs;
    Eye eye;
    std::uint16_t boxes = 1, draws = 1;

    /// Candidates of this frame: what exists in the frustum. Computes what is truly visible, too.
    std::span<const OcclusionCandidate> look() {
        candidates_.clear();
        spans_.clear();
        for (std::uint32_t item = 0; item < discs.size(); ++item) add(item);
        truth_.fill(kFar);
        for (const Span& span : spans_) draw(truth_, span);
        return candidates_;
    }
    [[nodiscard]] bool truly_visible(std::size_t candidate) const {
        return visible(truth_, spans_[candidate]);
    }

    /// Draws what is drawn at once; the queries see that depth.
    void draw_at_once(const OcclusionDecisions& decided) {
        drawn_.fill(kFar);
        for (std::size_t i = 0; i < spans_.size(); ++i) {
            const OcclusionAction action = decided.decisions[i].action;
            if (action == OcclusionAction::Draw || action == OcclusionAction::DrawAndQuery)
                draw(drawn_, spans_[i]);
        }
    }
    [[nodiscard]] bool seen(std::size_t candidate) const { return visible(drawn_, spans_[candidate]); }

  private:
    struct Span {
        int first = 0, last = 0;
        float distance = 0;
    };
    using Depth = std::array<float, kColumns>;
    static constexpr float kFar = 1e30f;

    void add(std::uint32_t item) {
        const Disc& disc = discs[item];
        if (!disc.exists) return;
        const double dx = disc.x - eye.x, dy = disc.y - eye.y;
        const double distance = std::sqrt(dx * dx + dy * dy);
        const double ahead = dx * std::cos(eye.heading) + dy * std::sin(eye.heading);
        const double aside = dy * std::cos(eye.heading) - dx * std::sin(eye.heading);
        Span span{0, kColumns - 1, static_cast<float>(distance - disc.radius)};
        const bool testable = ahead > disc.radius + 0.1;
        if (testable) {
            // The disc's face is a segment across the line of sight at its nearest depth.
            const double scale = 0.5 * kColumns / (ahead - disc.radius);
            span.first = static_cast<int>(std::floor(0.5 * kColumns + (aside - disc.radius) * scale));
            span.last = static_cast<int>(std::floor(0.5 * kColumns + (aside + disc.radius) * scale));
            if (span.last < 0 || span.first >= kColumns) return;
            span.first = std::max(span.first, 0);
            span.last = std::min(span.last, kColumns - 1);
        } else if (distance > 3.0 * disc.radius) {
            return;
        }
        const int columns = span.last - span.first + 1;
        candidates_.push_back({item, disc.render_ns, static_cast<float>(columns * kColumnPixels),
                               span.distance, boxes, draws, testable, false});
        spans_.push_back(span);
    }
    static void draw(Depth& depth, const Span& span) {
        for (int i = span.first; i <= span.last; ++i) depth[i] = std::min(depth[i], span.distance);
    }
    static bool visible(const Depth& depth, const Span& span) {
        for (int i = span.first; i <= span.last; ++i) {
            if (span.distance <= depth[i]) return true;
        }
        return false;
    }

    std::vector<OcclusionCandidate> candidates_;
    std::vector<Span> spans_;
    Depth truth_{}, drawn_{};
};

/// `count` discs in a square of side 400 around the origin, dense enough that most are hidden, but for a
/// glade of radius 30 around it.
inline FlatWorld forest(std::uint32_t count, std::uint32_t seed, double radius = 1.0) {
    FlatWorld world;
    Uniform random(seed);
    while (world.discs.size() < count) {
        const double x = random(-200, 200), y = random(-200, 200);
        const auto render_ns = static_cast<float>(random.log(2e3, 2e5));
        if (x * x + y * y < 900) continue;
        world.discs.push_back({x, y, random(0.5, 1.5) * radius, render_ns, true});
    }
    return world;
}

/// Around the glade, a little in and out of the trees, looking about.
inline FlatWorld::Eye stroll(int frame) {
    const double t = frame * 0.003;
    return {34.0 * std::cos(t), 34.0 * std::sin(1.3 * t), 0.7 * t + std::sin(2.1 * t)};
}

/// So far apart, and the nearer the smaller, that nothing hides anything.
inline FlatWorld fan(std::uint32_t count) {
    FlatWorld world;
    for (std::uint32_t i = 0; i < count; ++i) {
        // One disc in the middle of each of `count` slices of the view: tangents apart evenly.
        const double tangent = -0.95 + 1.9 * (i + 0.5) / count;
        const double x = 20.0 + i % 13;
        world.discs.push_back({x, tangent * x, 0.2 * x / count, 2e3f * static_cast<float>(1 + i % 40), true});
    }
    return world;
}

/// What a frame came to, by the model and in truth.
struct FrameOutcome {
    double drawn_ns = 0;    ///< at once or because a query saw it
    double visible_ns = 0;  ///< of what is truly visible
    double all_ns = 0;      ///< of all candidates
    double query_ns = 0, exploration_ns = 0, saved_ns = 0;
    std::size_t candidates = 0, queries = 0, hardware = 0, first = 0, hidden = 0, hidden_asked_first = 0;
    std::size_t missing = 0;       ///< truly visible, not drawn
    long allocations_of_test = 0;  ///< made by the world and the device, not by the scheduler
    std::uint64_t hash = 1469598103934665603u;
};

/// One view of a flat world: scheduler and device in a loop.
class FlatView {
  public:
    FlatView(const OcclusionSettings& settings, const QueryCosts& costs, const FakeGpuHabits& habits = {})
        : scheduler(settings, costs), gpu(habits) {}

    FrameOutcome frame(FlatWorld& world, double frame_ns = 10e6) {
        if (world.discs.size() > items_) scheduler.resize(items_ = world.discs.size());
        long before = allocations();
        const std::span<const QueryAnswer> answers = gpu.next_frame();
        candidates_ = world.look();
        long outside = allocations() - before;
        scheduler.absorb(answers);
        scheduler.begin_frame(frame_ns, FlatWorld::kScreenPixels);
        for (const OcclusionCandidate& candidate : candidates_) scheduler.visit(candidate.item);
        scheduler.decide(candidates_, decided);
        before = allocations();
        world.draw_at_once(decided);
        FrameOutcome outcome;
        answer(world, outcome);
        for (std::size_t i = 0; i < candidates_.size(); ++i) count(world, candidates_[i], i, outcome);
        outcome.candidates = candidates_.size();
        outcome.queries = decided.queries.size();
        outcome.query_ns = decided.query_ns;
        outcome.exploration_ns = decided.exploration_ns;
        outcome.saved_ns = decided.saved_ns;
        outcome.allocations_of_test = outside + allocations() - before;
        return outcome;
    }
    /// Whether the decisions of the last frame fit together, whatever they are.
    [[nodiscard]] bool is_consistent() const {
        std::size_t members = 0;
        for (std::size_t q = 0; q < decided.queries.size(); ++q) {
            const ScheduledQuery& query = decided.queries[q];
            if (query.first_member != members || query.member_count == 0) return false;
            members += query.member_count;
            if (query.way == QueryWay::BoxPass && query.member_count != 1) return false;
            if (q > 0 && query.ticket <= decided.queries[q - 1].ticket) return false;
            for (std::uint32_t i = query.first_member; i < members; ++i) {
                const OcclusionDecision& decision = decided.decisions[decided.members[i]];
                if (decision.query != q || decision.action == OcclusionAction::Draw) return false;
            }
        }
        std::size_t asked = 0;
        for (std::size_t i = 0; i < decided.decisions.size(); ++i) {
            const OcclusionDecision& decision = decided.decisions[i];
            const bool has_query = decision.query != OcclusionDecision::kNoQuery;
            const bool needs_query = decision.action == OcclusionAction::QueryFirst ||
                                     decision.action == OcclusionAction::DrawAndQuery;
            if (needs_query && !has_query) return false;
            if (has_query && !candidates_[i].testable) return false;
            asked += has_query ? 1 : 0;
        }
        return members == asked && decided.decisions.size() == candidates_.size();
    }

    OcclusionScheduler scheduler;
    FakeGpu gpu;
    OcclusionDecisions decided;

  private:
    void answer(const FlatWorld& world, FrameOutcome& outcome) {
        saw_.clear();
        for (const ScheduledQuery& query : decided.queries) {
            bool visible = false;
            for (std::uint32_t i = 0; i < query.member_count; ++i) {
                const std::uint32_t member = decided.members[query.first_member + i];
                visible = visible || world.seen(member);
                mix(outcome.hash, member);
            }
            saw_.push_back(visible);
            outcome.hardware += query.way == QueryWay::HardwareQuery ? 1 : 0;
            gpu.ask({query.ticket, visible, 0});
        }
    }
    void count(const FlatWorld& world, const OcclusionCandidate& candidate, std::size_t i,
               FrameOutcome& outcome) {
        const OcclusionDecision& decision = decided.decisions[i];
        const bool first = decision.action == OcclusionAction::QueryFirst;
        const bool drawn = first ? saw_[decision.query] : decision.action != OcclusionAction::Skip;
        const bool visible = world.truly_visible(i);
        outcome.all_ns += candidate.render_ns;
        if (drawn) outcome.drawn_ns += candidate.render_ns;
        if (visible) outcome.visible_ns += candidate.render_ns;
        if (visible && !drawn) ++outcome.missing;
        outcome.first += first ? 1 : 0;
        outcome.hidden += visible ? 0 : 1;
        outcome.hidden_asked_first += first && !visible ? 1 : 0;
        mix(outcome.hash, static_cast<std::uint64_t>(decision.action));
        mix(outcome.hash, decision.query);
    }
    static void mix(std::uint64_t& hash, std::uint64_t value) { hash = (hash ^ value) * 1099511628211u; }

    std::size_t items_ = 0;
    std::span<const OcclusionCandidate> candidates_;
    std::vector<bool> saw_;
};

/// About what was measured on a software renderer: ns.
inline QueryCosts software_costs() {
    return {{0, 3500, 0, 0.1, 50}, {20000, 300, 800, 1.0, 100}};
}

}  // namespace rhview
