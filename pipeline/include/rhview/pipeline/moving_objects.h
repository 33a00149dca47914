// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Objects that the application adds, moves and removes, and temporal bounding volumes for those that are not
/// seen: such an object is not touched until its volume expires or is drawn.
///
/// An object that promises a top speed and was not drawn at once falls asleep: its box, grown by how far it
/// can get within a period, stands in for it. Asleep it costs what a box costs in `cull_boxes`, and nothing
/// of it has to be computed unless a plan names it, which then needs its placement. The period adapts: longer
/// when it expires unseen, shorter when its volume was seen before. Where an object promises a range that it
/// never leaves (a room, a court, a closed way), that is its volume, without end, once a first one expired
/// unseen; if the range is seen it is tried again after one unseen expiry, then two, four… So what is hidden
/// with its range is not touched at all, however many there are. Source: Sudarsky & Gotsman 1999, "Dynamic
/// scene occlusion culling".
///
/// A frame goes
///
///     add, remove, teleport…  begin_frame  move(each of due())  describe  plan  end_frame
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/ids.h"
#include "rhview/pipeline/frame_planner.h"

namespace rhview {

/// For how long a volume may stand in for its object.
struct TemporalVolumeSettings {
    /// Periods, seconds. Ours: a few frames at 60 Hz at first, and no more than a walker needs to get past a
    /// wall: a volume that is seen where its object is not costs more than being told where that is.
    double first_period_s = 0.25;
    double least_period_s = 0.05;
    double greatest_period_s = 1.0;
};

/// What an application promises of an object.
struct MotionPromise {
    /// No point of what is drawn moves faster, in units per second; infinite or not a number: no promise, it
    /// never sleeps.
    double top_speed = std::numeric_limits<double>::infinity();
    /// Nothing of what is drawn is ever outside, teleported or not; empty: no promise.
    Aabb range{};
};

/// Deterministic; no allocation once the most objects have been there.
class MovingObjects {
  public:
    explicit MovingObjects(const TemporalVolumeSettings& settings = {}) : settings_(settings) {}

    /// The lowest number that is free. `group` as in `FrameInput::object_groups`.
    ObjectId add(const Aabb& box, std::uint32_t group, const MotionPromise& promise);
    /// One that promises no range.
    ObjectId add(const Aabb& box, std::uint32_t group, double top_speed) {
        return add(box, group, MotionPromise{top_speed, {}});
    }
    /// Its number is free again at once.
    void remove(ObjectId object);
    /// Times are finite and never fall. Where a clock jumps back all the same, or has no number, that is
    /// asserted, and all objects are due; by one that stands still nothing expires.
    void begin_frame(double time_s);
    /// The objects that must be moved now, each once: those awake, and those whose volumes expired.
    [[nodiscard]] std::span<const ObjectId> due() const { return awake_; }
    /// Where an object is now; wakes one that slept. If it broke its promise, that is asserted, counted, and
    /// taken for a teleport; a range that was left is a promise no more.
    void move(ObjectId object, const Aabb& box);
    /// Somewhere else at once: allowed, and what was known of the object is forgotten.
    void teleport(ObjectId object, const Aabb& box);
    /// Sets the parts of `input` that are about objects; spans into this until it changes.
    void describe(FrameInput& input) const;
    /// What none of the frame's plans draws at once falls asleep; what one does wakes.
    void end_frame_of_views(std::span<const FramePlan* const> plans);
    /// For an application with one view.
    void end_frame(const FramePlan& plan) {
        const FramePlan* const only = &plan;
        end_frame_of_views({&only, 1});
    }

    /// One more than the largest number in use, now or before.
    [[nodiscard]] std::size_t slot_count() const { return slots_.size(); }
    [[nodiscard]] bool is_asleep(ObjectId object) const { return slots_[index_of(object)].asleep; }
    [[nodiscard]] std::uint64_t broken_promises() const { return broken_promises_; }

  private:
    struct Slot {
        Aabb told;             ///< the last box that the application gave
        double told_s = 0.0;   ///< when
        double until_s = 0.0;  ///< of its volume
        double period_s = 0.0;
        double top_speed = 0.0;
        bool asleep = false;
        bool listed = false;        ///< in `awake_`
        bool expired = false;       ///< its last volume did, unseen
        bool in_range = false;      ///< asleep without end, all of its range standing in for it
        std::uint8_t waits = 0;     ///< unseen expiries to go before that is tried
        std::uint8_t failures = 0;  ///< how often, in powers of two, the range was seen
    };
    struct Expiry {
        double until_s = 0.0;
        std::uint32_t object = 0;
    };
    [[nodiscard]] static bool later(const Expiry& a, const Expiry& b);

    [[nodiscard]] bool is_alive(std::size_t object) const {
        return (alive_[object / 64] >> (object % 64) & 1) != 0;
    }
    void put(ObjectId object, const Aabb& box);
    [[nodiscard]] bool keeps_range(std::size_t object, const Aabb& box);
    void break_promise();
    void restart_clock(double time_s);
    [[nodiscard]] Aabb volume_until(std::uint32_t object, double until_s) const;
    void wake(std::uint32_t object);
    void see(const FramePlan& plan);
    void put_to_sleep(std::uint32_t object);

    TemporalVolumeSettings settings_;
    double time_s_ = 0.0;
    std::vector<Slot> slots_;
    std::vector<Aabb> volumes_;  ///< by object: its box, or what stands in for it
    std::vector<Aabb> ranges_;   ///< by object, rounded outwards; empty: none
    std::vector<std::uint32_t> groups_;
    std::vector<std::uint64_t> alive_;
    std::vector<std::uint64_t> seen_;    ///< scratch: a bit per object
    std::vector<std::uint32_t> free_;    ///< a heap, the lowest first
    std::vector<Expiry> expiries_;       ///< a heap, the soonest first; some are out of date
    std::vector<ObjectId> awake_, new_;  ///< new ones since the last frame's end
    std::uint64_t broken_promises_ = 0;
};

}  // namespace rhview
