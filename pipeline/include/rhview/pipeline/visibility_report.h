// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What a view shows of the objects, for an application that streams, animates or simulates by it.
///
/// An object is *visible* when a plan draws it at once (it may be seen), or when the query that it hung on
/// saw something; *hidden* when a plan leaves it out (out of the view; in latent mode also on the word of an
/// earlier answer), or when the query said that nothing of it is seen. While its answer is on the way it
/// stays what it was. So `visible` may be wrong for as long as answers take, `hidden` is never said of an
/// object that the newest knowledge shows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/ids.h"
#include "rhview/occlusion_queries/query.h"
#include "rhview/pipeline/frame_planner.h"

namespace rhview {

/// Bands of distance, and how long answers count.
struct VisibilityReportSettings {
    /// Distances from the eye to an object's box where bands end, rising, world units; band 0 is the nearest.
    std::vector<double> band_ends{};
    /// A band is left outwards only this share of its end beyond it, so that objects at a limit don't
    /// flicker.
    double band_hysteresis = 0.1;
    /// Answers that take more frames are ignored: the object stays what it was.
    std::uint32_t max_answer_frames = 16;
};

/// Of one object in one view.
struct ObjectSighting {
    static constexpr std::uint64_t kNever = ~std::uint64_t{0};

    std::uint64_t last_seen_frame = kNever;  ///< the last one in which it was visible, by `frame`
    bool visible = false;
    std::uint8_t level = 0;  ///< of detail, in the last plan that drew it
    std::uint16_t band = 0;  ///< of distance, in the last frame
};

/// One per view. A frame goes
///
///     absorb(answers)  planner.absorb(answers)  planner.plan(input, plan)  update(input, plan)
///
/// Deterministic; no allocation once the most objects and queries have been there.
class VisibilityReport {
  public:
    /// Nothing was seen yet.
    explicit VisibilityReport(VisibilityReportSettings settings = {});

    /// Those that the planner absorbs, in any order.
    void absorb(std::span<const QueryAnswer> answers);
    /// Takes in the plan of a frame. Cost: linear in the objects.
    void update(const FrameInput& input, const FramePlan& plan);

    /// Frames so far: the number of the one to come.
    [[nodiscard]] std::uint64_t frame() const { return frame_; }
    /// Objects that turned since the `update` before the last, by id: by answers or by the last plan. An
    /// object that was removed is in neither; a new one, or one put elsewhere, is hidden until it is shown.
    [[nodiscard]] std::span<const ObjectId> became_visible() const { return became_visible_; }
    [[nodiscard]] std::span<const ObjectId> became_hidden() const { return became_hidden_; }
    /// What is known of an object; of one that was never there: nothing.
    [[nodiscard]] ObjectSighting sighting(ObjectId object) const;

  private:
    struct Entry {
        ObjectSighting sighting{};
        std::uint64_t known_from = 0;   ///< the frame in which it came, or was put elsewhere
        std::uint64_t known_frame = 0;  ///< of the newest word on whether it is visible
        std::uint64_t planned_frame = ObjectSighting::kNever;  ///< the last whose plan has it
        bool was_visible = false;                              ///< at the last `update`
        bool alive = false;
    };
    /// A query on the way, and what hangs on it.
    struct Pending {
        std::uint64_t ticket = 0;
        std::uint32_t first_object = 0;  ///< into `AskedFrame::objects`
        std::uint32_t object_count = 0;
    };
    struct AskedFrame {
        std::uint64_t frame = 0;
        std::vector<Pending> queries;  ///< by ticket
        std::vector<ObjectId> objects;
    };

    void resize(const FrameInput& input);
    void tell(ObjectId object, bool visible, std::uint64_t frame);
    void remember_queries(const FramePlan& plan);
    void find_bands(const FrameInput& input);
    void list_changes();

    VisibilityReportSettings settings_;
    std::uint64_t frame_ = 0;
    std::vector<Entry> entries_;     ///< by object
    std::vector<AskedFrame> asked_;  ///< a ring, by frame
    std::vector<ObjectId> became_visible_, became_hidden_;
};

}  // namespace rhview
