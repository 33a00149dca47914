// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/node_visibility.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rhview {
namespace {

// New subtrees are asked about in parts that are worth this many queries: finer costs more to ask than it can
// save, coarser draws much for a small thing that shows. CHC asks about whole new subtrees and pays with
// frames; measured on `indoor` and `town`, see docs/occlusion.md.
constexpr double kUnknownGrain = 16.0;

// A box nearer to the near plane than this share of its farthest reach is not asked about: more than drawing
// it may widen it by (a part of a pixel).
constexpr float kNearMargin = 1e-3f;
constexpr float kRounding = 0x1p-22f;

// A leaf is asked about in pieces if these, weighted by their indices, have less than this share of its
// surface: what is left to be drawn of it would at least be halved, by the surface area heuristic.
constexpr double kSplitArea = 0.5;

// More boxes than this describe no node: each has its price.
constexpr std::size_t kMaxTightBoxes = 16;

float area_of(const Aabb& box) {
    const glm::vec3 e = box.max - box.min;
    return 2.0f * (e.x * e.y + e.y * e.z + e.z * e.x);
}

/// To ask about one thing and hang one draw on the answer.
double cheapest_query_ns(const QueryCosts& costs) {
    const auto price = [](const AnswerCosts& way) { return way.query_ns + way.box_ns + way.draw_ns; };
    return std::min(price(costs.hardware), price(costs.box_pass));
}

}  // namespace

NodeVisibility::NodeVisibility(const RhOctree& octree, const OcclusionOptions& options)
    : octree_(octree),
      nodes_(octree.nodes()),
      pieces_(octree.pieces()),
      options_(options),
      scheduler_(options.settings, options.costs),
      query_ns_(cheapest_query_ns(options.costs)),
      grain_ns_(kUnknownGrain * query_ns_) {
    scheduler_.resize(first_object_item());
    indices_before_.reserve(octree.pieces().size() + 1);
    std::uint32_t sum = 0;
    for (const OctreePiece& piece : octree.pieces()) {
        indices_before_.push_back(sum);
        sum += piece.index_count;
    }
    indices_before_.push_back(sum);
    find_tight_boxes();
    find_split_leaves();
}

void NodeVisibility::Parts::add(const Parts& part) {
    any_seen = any_seen || part.any_seen;
    hidden_ns += part.hidden_ns;
    unknown_ns += part.unknown_ns;
    asking_ns += part.asking_ns;
    p_hidden = std::min(p_hidden, part.p_hidden);
}

/// By the cheaper way, with the draws that hang on it.
double NodeVisibility::asking_ns(const OcclusionCandidate& candidate) const {
    const auto price = [&](const AnswerCosts& way) {
        return way.query_ns + candidate.boxes * way.box_ns + candidate.pixels * way.pixel_ns +
               candidate.draws * way.draw_ns;
    };
    return std::min(price(options_.costs.hardware), price(options_.costs.box_pass));
}

NodeVisibility::Parts NodeVisibility::part_of(const OcclusionCandidate& candidate, Belief belief) const {
    Parts part;
    if (!candidate.testable || belief == Belief::Visible) {
        part.any_seen = true;
    } else if (belief == Belief::Hidden) {
        part.hidden_ns = candidate.render_ns;
        part.asking_ns = asking_ns(candidate);
        part.p_hidden = scheduler_.p_hidden(candidate.item);
    } else {
        part.unknown_ns = candidate.render_ns;
    }
    return part;
}

void NodeVisibility::find_split_leaves() {
    is_split_.resize(nodes_.size());
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const OctreeNode& node = nodes_[i];
        if (!octree_.is_leaf(NodeId{i}) || node.piece_end < node.first_piece + 2) continue;
        double weighted = 0.0;
        for (std::uint32_t p = node.first_piece; p < node.piece_end; ++p)
            weighted += static_cast<double>(area_of(pieces_[p].bounds)) * pieces_[p].index_count;
        const std::uint32_t indices = indices_before_[node.piece_end] - indices_before_[node.first_piece];
        is_split_[i] = weighted < kSplitArea * area_of(node.bounds) * indices;
    }
}

/// Descendants down to `tight_depth` whose boxes' areas sum up to no more than `tight_area` of the node's.
void NodeVisibility::find_tight_boxes() {
    std::vector<NodeId> parts, finer;
    first_box_.reserve(nodes_.size() + 1);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        first_box_.push_back(static_cast<std::uint32_t>(tight_nodes_.size()));
        const double limit = options_.settings.tight_area * area_of(nodes_[i].bounds);
        parts.assign(1, NodeId{i});
        for (std::uint32_t depth = 0; depth < options_.settings.tight_depth; ++depth) {
            finer.clear();
            double area = 0.0;
            for (const NodeId part : parts) {
                if (octree_.is_leaf(part))
                    finer.push_back(part);
                else
                    for (std::size_t c = index_of(part) + 1; c < octree_.node(part).end; c = nodes_[c].end)
                        finer.push_back(NodeId{static_cast<std::uint32_t>(c)});
            }
            for (const NodeId part : finer) area += area_of(octree_.node(part).bounds);
            if (finer.size() == parts.size() || finer.size() > kMaxTightBoxes || area > limit) break;
            parts.swap(finer);
        }
        tight_nodes_.insert(tight_nodes_.end(), parts.begin(), parts.end());
    }
    first_box_.push_back(static_cast<std::uint32_t>(tight_nodes_.size()));
}

void NodeVisibility::make_lens(const FrameInput& input, const Frustum& frustum) {
    const View& view = input.culling_view;
    const FrustumPlane& near = frustum.planes[Frustum::Near];
    lens_.eye = glm::vec3(frustum.eye);
    lens_.near_normal = near.normal;
    lens_.near_distance = near.distance - near.slack;
    lens_.screen_pixels =
        static_cast<float>(input.viewport_pixels.x) * static_cast<float>(input.viewport_pixels.y);
    // Half the screen is one unit of x/w and y/w: a focal length squared is pixels per steradian, in the
    // middle.
    const glm::dmat4& clip = view.clip_from_camera;
    lens_.pixels_per_unit =
        static_cast<float>(std::abs(clip[0][0] * clip[1][1]) * 0.25) * lens_.screen_pixels;
    lens_.parallel = clip[2][3] == 0.0;
}

bool NodeVisibility::is_testable(const Aabb& box) const {
    const glm::vec3 half = 0.5f * (box.max - box.min);
    const glm::vec3 from_eye = 0.5f * (box.max + box.min) - lens_.eye;
    // The differences above are rounded in units of the positions. Sums of absolutes are no less than
    // lengths.
    const glm::vec3 reach =
        kNearMargin * (glm::abs(from_eye) + half) +
        kRounding * (glm::max(glm::abs(box.min), glm::abs(box.max)) + glm::abs(lens_.eye));
    const float margin = reach.x + reach.y + reach.z;
    const glm::vec3 beside = glm::abs(from_eye) - half;
    const bool holds_eye = std::max({beside.x, beside.y, beside.z}) <= margin;
    const float nearest = glm::dot(lens_.near_normal, from_eye) -
                          glm::dot(glm::abs(lens_.near_normal), half) + lens_.near_distance;
    return !holds_eye && nearest > margin;  // NaN: no
}

OcclusionCandidate NodeVisibility::candidate_of(std::uint32_t item, const Aabb& box) const {
    const glm::vec3 extent = box.max - box.min;
    const glm::vec3 from_eye = 0.5f * (box.max + box.min) - lens_.eye;
    const glm::vec3 areas(extent.y * extent.z, extent.z * extent.x, extent.x * extent.y);
    OcclusionCandidate candidate;
    candidate.item = item;
    candidate.distance = glm::length(from_eye);
    // The faces that look at the eye, as seen from it: their solid angle, far away.
    const glm::vec3 direction = lens_.parallel ? lens_.near_normal : from_eye / candidate.distance;
    const float seen = glm::dot(areas, glm::abs(direction));
    const float scale = lens_.parallel ? 1.0f : 1.0f / (candidate.distance * candidate.distance);
    const float pixels = seen * scale * lens_.pixels_per_unit;
    candidate.pixels = pixels < lens_.screen_pixels ? pixels : lens_.screen_pixels;
    candidate.counts_samples =
        options_.settings.mode == OcclusionMode::Latent && options_.settings.visible_samples > 1;
    return candidate;
}

double NodeVisibility::render_ns(std::uint32_t index) const {
    const OctreeNode& node = nodes_[index];
    const double index_ns = std::max(costs_.index_ns, options_.shown_index_ns);
    // Without the draw: a node that is shown shares one with its neighbours, as a rule.
    return index_ns * (indices_before_[node.piece_end] - indices_before_[node.first_piece]);
}

OcclusionCandidate NodeVisibility::node_candidate(std::uint32_t index, bool testable) const {
    const OctreeNode& node = nodes_[index];
    OcclusionCandidate candidate = candidate_of(index, node.bounds);
    candidate.render_ns = static_cast<float>(render_ns(index));
    candidate.boxes = static_cast<std::uint16_t>(first_box_[index + 1] - first_box_[index]);
    candidate.draws =
        static_cast<std::uint16_t>(std::min({node.range_count, node.piece_end - node.first_piece, 0xffffu}));
    candidate.testable = testable;
    return candidate;
}

NodeVisibility::Parts NodeVisibility::add_node(std::uint32_t index, bool testable, Belief belief) {
    candidates_.push_back(node_candidate(index, testable));
    leaf_of_candidate_.push_back(NodeId{index});
    return part_of(candidates_.back(), belief);
}

/// Recursion is as deep as the octree: 21 levels at most.
NodeVisibility::Parts NodeVisibility::visit(std::uint32_t index, PlaneMask mask, Belief otherwise) {
    const OctreeNode& node = nodes_[index];
    if (node.first_piece == node.piece_end) return {};
    ++nodes_visited_;
    const bool outside = classify(*frustum_, node.bounds, mask) == Containment::Outside;
    containment_[index] = outside ? KnownContainment::kOutside : mask;
    if (outside) return {};
    const Belief belief = scheduler_.visit(index, otherwise);
    const bool leaf = node.end == index + 1;
    const bool one = belief == Belief::Hidden || (belief == Belief::Unknown && render_ns(index) <= grain_ns_);
    const bool testable = (leaf || one) && is_testable(node.bounds);
    // Parts of what was hidden until now are hidden, most of them.
    const bool was_hidden = belief == Belief::Hidden || scheduler_.turned_visible(index);
    const Belief otherwise_parts = was_hidden ? Belief::Hidden : Belief::Unknown;
    if (leaf && is_split_[index] && (!testable || belief == Belief::Visible))
        return visit_pieces(index, mask, otherwise_parts);
    return leaf || testable ? add_node(index, testable, belief) : visit_parts(index, mask, otherwise_parts);
}

NodeVisibility::Parts NodeVisibility::add_piece(std::uint32_t piece, Belief otherwise) {
    const OctreePiece& part = pieces_[piece];
    const auto item = static_cast<std::uint32_t>(nodes_.size()) + piece;
    const Belief belief = scheduler_.visit(item, otherwise);
    OcclusionCandidate candidate = candidate_of(item, part.bounds);
    const double index_ns = std::max(costs_.index_ns, options_.shown_index_ns);
    candidate.render_ns = static_cast<float>(index_ns * part.index_count);
    candidate.testable = is_testable(part.bounds);
    candidates_.push_back(candidate);
    return part_of(candidate, belief);
}

NodeVisibility::Parts NodeVisibility::visit_pieces(std::uint32_t index, PlaneMask mask, Belief otherwise) {
    const OctreeNode& node = nodes_[index];
    const std::size_t first_candidate = candidates_.size();
    Parts all;
    for (std::uint32_t p = node.first_piece; p < node.piece_end; ++p) {
        PlaneMask piece_mask = mask;
        if (classify(*frustum_, pieces_[p].bounds, piece_mask) == Containment::Outside) continue;
        all.add(add_piece(p, otherwise));
        leaf_of_candidate_.push_back(NodeId{index});
    }
    try_as_one(index, first_candidate, all);
    return all;
}

/// `whole` could be asked about beside its parts: worth what asking about it instead of them would save in a
/// frame.
bool NodeVisibility::make_trial(const Parts& parts, OcclusionCandidate& whole) {
    whole.trial = true;
    whole.render_ns = static_cast<float>(parts.asking_ns - asking_ns(whole));
    return whole.render_ns > 0.0f && scheduler_.may_try(whole.item, parts.p_hidden);
}

/// If all parts of the node seem hidden, it is asked about as one beside them: it takes their place once it
/// is known to be hidden.
void NodeVisibility::try_as_one(std::uint32_t index, std::size_t first_candidate, const Parts& parts) {
    if (!parts.seem_hidden() || candidates_.size() <= first_candidate + 1) return;
    if (!is_testable(nodes_[index].bounds)) return;
    OcclusionCandidate whole = node_candidate(index, true);
    if (!make_trial(parts, whole)) return;
    candidates_.push_back(whole);
    leaf_of_candidate_.push_back(NodeId{index});
}

NodeVisibility::Parts NodeVisibility::visit_parts(std::uint32_t index, PlaneMask mask, Belief otherwise) {
    const OctreeNode& node = nodes_[index];
    const std::size_t first_candidate = candidates_.size();
    Parts all;
    for (std::uint32_t child = index + 1; child < node.end; child = nodes_[child].end)
        all.add(visit(child, mask, otherwise));
    try_as_one(index, first_candidate, all);
    return all;
}

void NodeVisibility::decide(const FrameInput& input, const Frustum& frustum, const DrawCosts& costs,
                            double frame_ns, FramePlan& plan) {
    frustum_ = &frustum;
    costs_ = costs;
    nodes_visited_ = 0;
    candidates_.clear();
    leaf_of_candidate_.clear();
    containment_.assign(nodes_.size(), KnownContainment::kUnknown);
    make_lens(input, frustum);
    scheduler_.resize(first_object_item() + 2 * input.object_boxes.size());
    for (const ObjectId object : input.new_objects)
        scheduler_.forget(object_item(static_cast<std::uint32_t>(object)));
    scheduler_.begin_frame(frame_ns, lens_.screen_pixels);
    if (!nodes_.empty()) visit(0, frustum.mask, Belief::Unknown);
    add_objects(input);
    scheduler_.decide(candidates_, decided_);
    write_queries(input.object_boxes, plan);
    write_nodes();
    write_objects(input, plan);
    plan.occlusion = {candidates_.size(), decided_.query_ns, decided_.exploration_ns, decided_.saved_ns};
    frustum_ = nullptr;
}

void NodeVisibility::append_boxes(std::uint32_t candidate, std::span<const Aabb> object_boxes,
                                  FramePlan& plan) const {
    const std::uint32_t item = candidates_[candidate].item;
    if (item >= first_object_item()) {
        const std::uint32_t region = region_of_candidate_[candidate - leaf_of_candidate_.size()];
        return plan.query_boxes.push_back(region == kNoRegion ? object_boxes[(item - first_object_item()) / 2]
                                                              : regions_.nodes()[region].bounds);
    }
    if (!is_node(item)) return plan.query_boxes.push_back(pieces_[item - nodes_.size()].bounds);
    for (std::uint32_t b = first_box_[item]; b < first_box_[item + 1]; ++b)
        plan.query_boxes.push_back(octree_.node(tight_nodes_[b]).bounds);
}

void NodeVisibility::write_queries(std::span<const Aabb> object_boxes, FramePlan& plan) const {
    for (const ScheduledQuery& query : decided_.queries) {
        const auto first = static_cast<std::uint32_t>(plan.query_boxes.size());
        for (std::uint32_t m = query.first_member; m < query.first_member + query.member_count; ++m)
            append_boxes(decided_.members[m], object_boxes, plan);
        const auto count = static_cast<std::uint32_t>(plan.query_boxes.size()) - first;
        plan.queries.push_back({query.ticket, first, count, query.way, query.counts_samples});
    }
}

void NodeVisibility::write_nodes() {
    alternatives_.clear();
    alternative_candidates_.clear();
    for (std::uint32_t c = 0; c < leaf_of_candidate_.size(); ++c) {
        const OcclusionDecision& decision = decided_.decisions[c];
        const NodeId node = leaf_of_candidate_[c];
        const std::uint32_t item = candidates_[c].item;
        const std::uint32_t piece =
            is_node(item) ? NodeAlternative::kWhole : item - static_cast<std::uint32_t>(nodes_.size());
        if (decision.action == OcclusionAction::Skip) {
            alternatives_.push_back({node, piece, 0.0, 0.0});
        } else if (decision.action == OcclusionAction::QueryFirst) {
            const bool hardware = decided_.queries[decision.query].way == QueryWay::HardwareQuery;
            const AnswerCosts& answer = hardware ? options_.costs.hardware : options_.costs.box_pass;
            const double p = scheduler_.p_hidden(item);
            alternatives_.push_back(
                {node, piece, (1.0 - p) * costs_.index_ns, answer.draw_ns + (1.0 - p) * costs_.draw_ns});
        } else {
            continue;
        }
        alternative_candidates_.push_back(c);
    }
}

void NodeVisibility::append_conditional(std::span<const AlternativeRange> left, FramePlan& plan) const {
    for (const AlternativeRange& range : left) {
        const std::uint32_t c = alternative_candidates_[range.alternative];
        if (decided_.decisions[c].action == OcclusionAction::QueryFirst)
            plan.conditional.push_back({range.range, decided_.decisions[c].query});
    }
}

}  // namespace rhview
