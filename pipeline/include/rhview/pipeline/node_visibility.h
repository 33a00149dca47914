// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Occlusion culling of an octree and of dynamic objects for one view: which nodes and objects of a frame are
/// asked about, with which boxes, and what hangs on the answers.
#pragma once

#include <span>
#include <vector>

#include "rhview/frustum/frustum.h"
#include "rhview/occlusion_queries/occlusion_scheduler.h"
#include "rhview/pipeline/frame_planner.h"
#include "rhview/pipeline/object_regions.h"
#include "rhview/rhoctree/draw_list.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// What asking costs here, and how to go about it.
struct OcclusionOptions {
    OcclusionSettings settings;
    QueryCosts costs;
    /// What an index costs that is in the frustum, ns: more than `DrawCosts::index_ns` where shading and
    /// rasterising weigh. 0: the same.
    double shown_index_ns = 0.0;
    /// The indices of a dynamic object, by `ObjectId`; an object beyond the end counts as none and is drawn
    /// at once. Read in every frame: the caller may change them with the objects' levels of detail.
    std::span<const std::uint32_t> object_indices{};
    /// Fewer objects are asked about one by one, tested by a flat batch; as many or more by region, from a
    /// hierarchy that follows them. Where one overtakes the other: `rhview_object_regions`,
    /// docs/occlusion.md.
    std::size_t fewest_for_regions = 16;
    /// Queries about objects say how many samples were seen: hardware queries only.
    bool counts_samples = false;
};

/// The nodes of the octree are the scheduler's items, its pieces and the objects follow them, and between the
/// objects regions of them.
///
/// Many objects, if they are not dear, are asked about by region: the nodes of a hierarchy over their boxes,
/// one box and one answer for all that is in a node believed hidden; those too cheap to be asked about one by
/// one by leaf at least.
///
/// A node believed hidden is asked about as a whole, with the boxes of its descendants where these are tight;
/// one believed visible is descended into, down to its leaves, and to their pieces where these are much
/// smaller than their leaf (a wall that crosses it makes a leaf's box large). What is new is asked about in
/// parts that are worth some queries each. A node whose parts all seem hidden is asked about as one
/// beside them, and takes their place once it is known to be hidden.
/// What an inner node holds of batches too small to be divided is drawn with it and never asked about.
/// Sources: Mattausch, Bittner & Wimmer 2008 (CHC++: tight bounds, pulling visibility up and down).
class NodeVisibility {
  public:
    /// `octree` outlives it.
    NodeVisibility(const RhOctree& octree, const OcclusionOptions& options);

    void absorb(std::span<const QueryAnswer> answers) { scheduler_.absorb(answers); }

    /// Decides about the frame, and fills `plan` with its queries and with the objects. `frame_ns`: what the
    /// frame is expected to take.
    void decide(const FrameInput& input, const Frustum& frustum, const DrawCosts& costs, double frame_ns,
                FramePlan& plan);
    /// What the draw list of this frame may leave to its queries, in the order of the nodes.
    [[nodiscard]] std::span<const NodeAlternative> alternatives() const { return alternatives_; }
    /// What `decide` found out about the nodes of this frame.
    [[nodiscard]] KnownContainment known_containment() const { return {containment_}; }
    /// Hangs what the draw list left out on its queries; in latent mode some of it is dropped.
    void append_conditional(std::span<const AlternativeRange> left, FramePlan& plan) const;

    [[nodiscard]] const OcclusionScheduler& scheduler() const { return scheduler_; }
    [[nodiscard]] std::uint64_t nodes_visited() const { return nodes_visited_; }

  private:
    /// What a subtree in the frustum is made of.
    struct Parts {
        bool any_seen = false;    ///< or cannot be asked about
        double hidden_ns = 0.0;   ///< to draw what is believed hidden
        double unknown_ns = 0.0;  ///< and what nothing is known of
        double asking_ns = 0.0;   ///< to ask about what is believed hidden
        double p_hidden = 1.0;    ///< the least of those believed hidden

        void add(const Parts& part);
        /// Hidden as far as is known, and more is known than not.
        [[nodiscard]] bool seem_hidden() const { return !any_seen && hidden_ns > unknown_ns; }
    };
    [[nodiscard]] Parts part_of(const OcclusionCandidate& candidate, Belief belief) const;
    static constexpr std::uint32_t kNoRegion = 0xffffffffu;

    /// How boxes look from the eye.
    struct Lens {
        glm::vec3 eye{0.0f};
        glm::vec3 near_normal{0.0f};
        float near_distance = 0.0f;
        float pixels_per_unit = 0.0f;  ///< of solid angle, or of area where `parallel`
        float screen_pixels = 0.0f;
        bool parallel = false;
    };

    void make_lens(const FrameInput& input, const Frustum& frustum);
    [[nodiscard]] OcclusionCandidate candidate_of(std::uint32_t item, const Aabb& box) const;
    [[nodiscard]] bool is_testable(const Aabb& box) const;

    Parts visit(std::uint32_t index, PlaneMask mask, Belief otherwise);
    Parts visit_parts(std::uint32_t index, PlaneMask mask, Belief belief);
    Parts visit_pieces(std::uint32_t index, PlaneMask mask, Belief otherwise);
    [[nodiscard]] double asking_ns(const OcclusionCandidate& candidate) const;
    [[nodiscard]] OcclusionCandidate node_candidate(std::uint32_t index, bool testable) const;
    [[nodiscard]] OcclusionCandidate region_candidate(std::uint32_t index, bool testable) const;
    bool make_trial(const Parts& parts, OcclusionCandidate& whole);
    void try_as_one(std::uint32_t index, std::size_t first_candidate, const Parts& parts);
    Parts add_node(std::uint32_t index, bool testable, Belief belief);
    Parts add_piece(std::uint32_t piece, Belief otherwise);
    void add_objects(const FrameInput& input);
    void price_objects(const FrameInput& input);
    [[nodiscard]] double object_ns(const FrameInput& input, std::size_t object) const;
    Parts add_object(const FrameInput& input, std::uint32_t object, Belief otherwise);
    bool update_regions(const FrameInput& input);
    [[nodiscard]] bool was_hidden(const HierarchyNode& node) const;
    Parts visit_region(const FrameInput& input, std::uint32_t index, PlaneMask mask, Belief otherwise);
    Parts visit_members(const FrameInput& input, std::uint32_t index, PlaneMask mask, Belief otherwise);
    Parts add_region(std::uint32_t index, bool testable, Belief belief);
    [[nodiscard]] double render_ns(std::uint32_t index) const;
    [[nodiscard]] bool is_node(std::uint32_t item) const { return item < nodes_.size(); }
    [[nodiscard]] std::uint32_t first_object_item() const {
        return static_cast<std::uint32_t>(nodes_.size() + pieces_.size());
    }
    /// Objects and regions take turns: either number stays what it is whatever the other does.
    [[nodiscard]] std::uint32_t object_item(std::uint32_t object) const {
        return first_object_item() + 2 * object;
    }
    [[nodiscard]] std::uint32_t region_item(std::uint32_t region) const {
        return first_object_item() + 2 * region + 1;
    }
    void append_boxes(std::uint32_t candidate, std::span<const Aabb> object_boxes, FramePlan& plan) const;
    void write_queries(std::span<const Aabb> object_boxes, FramePlan& plan) const;
    void write_nodes();
    void write_objects(const FrameInput& input, FramePlan& plan);
    void find_tight_boxes();
    void find_split_leaves();

    const RhOctree& octree_;
    std::span<const OctreeNode> nodes_;
    std::span<const OctreePiece> pieces_;
    OcclusionOptions options_;
    OcclusionScheduler scheduler_;
    std::vector<std::uint32_t> indices_before_;  ///< by piece: in the pieces before it
    std::vector<std::uint32_t> first_box_;       ///< by node, into `tight_nodes_`; one more at the end
    std::vector<NodeId> tight_nodes_;            ///< whose boxes a node is asked about with
    std::vector<bool> is_split_;                 ///< by node: a leaf that is asked about in pieces

    // Of the frame:
    const Frustum* frustum_ = nullptr;
    DrawCosts costs_;
    Lens lens_;
    double query_ns_ = 0.0;  ///< the cheapest question
    double grain_ns_ = 0.0;
    ObjectRegions regions_;
    bool regions_remade_ = false;
    std::vector<std::uint64_t> hidden_objects_;       ///< a bit each: believed hidden in the last frame
    std::vector<std::uint64_t> words_;                ///< scratch
    std::vector<std::uint32_t> region_of_candidate_;  ///< by candidate that is an object or a region
    std::vector<std::uint32_t> group_sizes_;          ///< objects by group
    std::vector<std::uint32_t> known_sizes_;          ///< of them, those whose indices are known
    std::size_t groups_in_use_ = 1;
    double mean_object_ns_ = 0.0;
    std::vector<ObjectId> objects_in_view_;
    std::vector<PlaneMask> containment_;  ///< by node
    std::vector<OcclusionCandidate> candidates_;
    OcclusionDecisions decided_;
    std::vector<NodeAlternative> alternatives_;
    std::vector<std::uint32_t> alternative_candidates_;  ///< by alternative
    std::vector<NodeId> leaf_of_candidate_;  ///< by candidate that is no object: its node, or its leaf
    std::uint64_t nodes_visited_ = 0;
};

}  // namespace rhview
