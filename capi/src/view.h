// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A view of a scene, with its last plan as C sees it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "costs.h"
#include "rhview/pipeline/query_boxes.h"
#include "scene.h"

namespace rhview::capi {

/// `plan` is the planner's, then the report and the C arrays of it: whoever plans a view has them too.
class View final : public FramePlanner {
  public:
    View(std::shared_ptr<Scene> scene, const KnownCosts& costs,
         const std::optional<OcclusionOptions>& occlusion, VisibilityReportSettings report);
    ~View() override;
    View(const View&) = delete;
    View& operator=(const View&) = delete;

    void set_camera(const rhview::View& camera, glm::ivec2 viewport_pixels);
    [[nodiscard]] bool has_camera() const { return has_camera_; }
    [[nodiscard]] const Scene& scene() const { return *scene_; }

    /// Of the next plans; none: full detail.
    void set_levels(const std::optional<LevelOptions>& options) { level_options_ = options; }
    void set_levelled(ObjectId object, const LevelledObject& levelled);
    /// Without what an object costs whatever its level.
    [[nodiscard]] const LodCosts& level_costs() const { return level_costs_; }

    void absorb(std::span<const QueryAnswer> answers) override;
    /// Takes in what changed of the scene. Then the view can be planned.
    ViewToPlan prepare();
    void plan(const FrameInput& input, FramePlan& plan) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override { return planner_.bounds_of(chosen); }
    /// What was planned in the frame that ends; null: nothing, and what is new is still to be told.
    const FramePlan* end_frame(std::span<const ObjectId> new_objects);

    [[nodiscard]] bool has_plan() const { return has_plan_; }
    [[nodiscard]] rhview_plan exported_plan() const;
    [[nodiscard]] rhview_changes exported_changes() const;
    /// The last plan's boxes, for the camera that it was made for.
    std::span<const rhview_wide_box> widen_boxes(const RasterPrecision& raster, double growth,
                                                 rhview_box_lens& lens);
    [[nodiscard]] const VisibilityReport& report() const { return report_; }

    std::vector<QueryAnswer> answers;  ///< scratch
    std::vector<ViewToPlan> to_plan;   ///< scratch of calls whose first view this is

  private:
    static std::optional<OcclusionOptions> with_indices(std::optional<OcclusionOptions> occlusion,
                                                        std::span<const std::uint32_t> object_indices);
    void find_new_objects();
    void count_object_indices();
    void export_plan();

    std::shared_ptr<Scene> scene_;
    std::vector<std::uint32_t> object_indices_;  ///< by object, at its level; never moves: the planner looks
    RhviewPlanner planner_;
    std::optional<ObjectLevels> levels_;  ///< none: no object has chains
    std::optional<LevelOptions> level_options_;
    LodCosts level_costs_;
    LevelSummary level_summary_;
    VisibilityReport report_;
    FrameInput input_;
    rhview::View planned_view_;  ///< what the plan was made for
    glm::ivec2 planned_pixels_{0};
    FramePlan plan_;
    bool has_camera_ = false, has_plan_ = false;
    bool is_planned_ = false;           ///< in this frame
    std::vector<std::uint8_t> missed_;  ///< by object: became new in a frame without a plan
    std::vector<ObjectId> new_objects_;

    std::vector<rhview_draw> draws_;
    std::vector<rhview_object_draw> objects_;
    std::vector<rhview_query> queries_;
    std::vector<rhview_box> boxes_;
    std::vector<rhview_wide_box> wide_boxes_;
    std::vector<rhview_conditional_draw> conditional_draws_;
    std::vector<rhview_conditional_object> conditional_objects_;
    std::vector<std::uint32_t> became_visible_, became_hidden_;
};

}  // namespace rhview::capi

struct rhview_view {
    rhview::capi::View state;
};
