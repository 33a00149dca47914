// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/moving_objects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "rhview/base/assert.h"

namespace rhview {
namespace {

/// Of a distance that is computed and then rounded to float.
constexpr double kRounding = 1e-6;

/// Steps of the period: up by less than down, so that a volume is too large, and drawn for nothing, now and
/// then and not every other time.
constexpr double kLonger = 1.25, kShorter = 0.5;

/// A range that was seen is tried again after 2^this unseen expiries at most: a minute, at the longest
/// period, since by then the eye may be elsewhere.
constexpr std::uint8_t kMostFailures = 6;

/// `box` and all that is within `distance` of it, rounded outwards.
Aabb grown(const Aabb& box, double distance) {
    const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
    const double largest = std::max({reach.x, reach.y, reach.z});
    const auto margin = static_cast<float>(distance * (1.0 + kRounding) + largest * kRounding);
    return {box.min - margin, box.max + margin};
}

bool holds(const Aabb& outer, const Aabb& inner) {
    return glm::all(glm::lessThanEqual(outer.min, inner.min)) &&
           glm::all(glm::lessThanEqual(inner.max, outer.max));
}

/// Different for neighbours, so that what falls asleep together does not wake together: 0.75 to 1.25.
double spread(std::uint32_t object) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    const double turn = kGoldenRatio * object;
    return 0.75 + 0.5 * (turn - std::floor(turn));
}

}  // namespace

bool MovingObjects::later(const Expiry& a, const Expiry& b) {
    return a.until_s != b.until_s ? a.until_s > b.until_s : a.object > b.object;
}

void MovingObjects::put(ObjectId object, const Aabb& box) {
    Slot& slot = slots_[index_of(object)];
    slot.told = volumes_[index_of(object)] = box;
    slot.told_s = time_s_;
    wake(static_cast<std::uint32_t>(object));
}

void MovingObjects::wake(std::uint32_t object) {
    Slot& slot = slots_[object];
    slot.asleep = false;
    if (slot.listed) return;
    slot.listed = true;
    awake_.push_back(ObjectId{object});
}

ObjectId MovingObjects::add(const Aabb& box, std::uint32_t group, const MotionPromise& promise) {
    auto number = static_cast<std::uint32_t>(slots_.size());
    if (!free_.empty()) {
        std::ranges::pop_heap(free_, std::greater());
        number = free_.back();
        free_.pop_back();
    } else {
        slots_.emplace_back();
        volumes_.emplace_back();
        ranges_.emplace_back();
        groups_.emplace_back();
        alive_.resize((slots_.size() + 63) / 64);
    }
    Slot& slot = slots_[number];
    slot.period_s = settings_.first_period_s;
    slot.top_speed = promise.top_speed;
    slot.expired = false;
    slot.waits = slot.failures = 0;
    ranges_[number] = promise.range.is_empty() ? Aabb{} : grown(promise.range, 0.0);
    groups_[number] = group;
    alive_[number / 64] |= std::uint64_t{1} << (number % 64);
    new_.push_back(ObjectId{number});
    if (!keeps_range(number, box)) break_promise();
    put(ObjectId{number}, box);
    return ObjectId{number};
}

void MovingObjects::remove(ObjectId object) {
    const std::size_t i = index_of(object);
    RHVIEW_ASSERT(i < slots_.size() && is_alive(i));
    alive_[i / 64] &= ~(std::uint64_t{1} << (i % 64));
    slots_[i].asleep = false;
    free_.push_back(static_cast<std::uint32_t>(object));
    std::ranges::push_heap(free_, std::greater());
}

void MovingObjects::restart_clock(double time_s) {
    // Before anything that the new clock will show: no object can have been too fast since.
    constexpr double kLongAgoS = 1e12;
    if (std::isfinite(time_s)) time_s_ = time_s;
    expiries_.clear();
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
        slots_[i].told_s = time_s_ - kLongAgoS;
        if (is_alive(i)) wake(i);
    }
}

void MovingObjects::begin_frame(double time_s) {
    const bool is_later = std::isfinite(time_s) && time_s >= time_s_;
    RHVIEW_ASSERT(is_later);
    if (!is_later) restart_clock(time_s);
    if (is_later) time_s_ = time_s;
    while (!expiries_.empty() && expiries_.front().until_s <= time_s_) {
        const Expiry expiry = expiries_.front();
        std::ranges::pop_heap(expiries_, later);
        expiries_.pop_back();
        Slot& slot = slots_[expiry.object];
        if (!slot.asleep || slot.until_s != expiry.until_s) continue;
        slot.expired = true;
        wake(expiry.object);
    }
    std::erase_if(awake_, [&](ObjectId object) {
        Slot& slot = slots_[index_of(object)];
        slot.listed = is_alive(index_of(object)) && !slot.asleep;
        return !slot.listed;
    });
}

void MovingObjects::break_promise() {
    const bool promise_was_kept = false;
    RHVIEW_ASSERT(promise_was_kept);
    ++broken_promises_;
}

/// Whether the object is where it promised to be; else it has promised no range from now on.
bool MovingObjects::keeps_range(std::size_t object, const Aabb& box) {
    Aabb& range = ranges_[object];
    const bool kept = range.is_empty() || holds(range, box);
    if (!kept) range = {};
    return kept;
}

void MovingObjects::move(ObjectId object, const Aabb& box) {
    const Slot& slot = slots_[index_of(object)];
    RHVIEW_ASSERT(is_alive(index_of(object)));
    const bool fast = std::isfinite(slot.top_speed) &&
                      !holds(grown(slot.told, slot.top_speed * (time_s_ - slot.told_s)), box);
    const bool strayed = !keeps_range(index_of(object), box);
    if (!fast && !strayed) return put(object, box);
    break_promise();
    new_.push_back(object);
    put(object, box);
}

void MovingObjects::teleport(ObjectId object, const Aabb& box) {
    RHVIEW_ASSERT(is_alive(index_of(object)));
    if (!keeps_range(index_of(object), box)) break_promise();
    new_.push_back(object);
    put(object, box);
}

void MovingObjects::describe(FrameInput& input) const {
    input.object_boxes = volumes_;
    input.object_groups = groups_;
    input.object_alive = alive_;
    input.new_objects = new_;
}

/// What holds the object until then.
Aabb MovingObjects::volume_until(std::uint32_t object, double until_s) const {
    const Slot& slot = slots_[object];
    const Aabb reach = grown(slot.told, slot.top_speed * (until_s - slot.told_s));
    const Aabb& range = ranges_[object];
    if (range.is_empty()) return reach;
    return {glm::max(reach.min, range.min), glm::min(reach.max, range.max)};
}

void MovingObjects::put_to_sleep(std::uint32_t object) {
    Slot& slot = slots_[object];
    slot.in_range = slot.expired && slot.waits == 0 && !ranges_[object].is_empty();
    if (slot.expired) slot.period_s = std::min(kLonger * slot.period_s, settings_.greatest_period_s);
    if (slot.expired && slot.waits > 0) --slot.waits;
    slot.expired = false;
    slot.asleep = true;
    slot.listed = false;
    if (slot.in_range) {
        slot.until_s = std::numeric_limits<double>::infinity();
        volumes_[object] = ranges_[object];
        return;
    }
    slot.until_s = time_s_ + slot.period_s * spread(object);
    volumes_[object] = volume_until(object, slot.until_s);
    expiries_.push_back({slot.until_s, object});
    std::ranges::push_heap(expiries_, later);
}

void MovingObjects::see(const FramePlan& plan) {
    for (const ObjectId object : plan.objects) {
        const std::size_t i = index_of(object);
        if (i >= slots_.size()) continue;
        seen_[i / 64] |= std::uint64_t{1} << (i % 64);
        Slot& slot = slots_[i];
        if (!slot.asleep) continue;
        if (slot.in_range) {
            slot.waits = static_cast<std::uint8_t>(1u << slot.failures);
            slot.failures = std::min<std::uint8_t>(slot.failures + 1, kMostFailures);
        } else {
            slot.period_s = std::max(kShorter * slot.period_s, settings_.least_period_s);
        }
        wake(static_cast<std::uint32_t>(i));
    }
}

void MovingObjects::end_frame_of_views(std::span<const FramePlan* const> plans) {
    seen_.assign(alive_.size(), 0);
    for (const FramePlan* plan : plans) see(*plan);
    std::erase_if(awake_, [&](ObjectId object) {
        const std::size_t i = index_of(object);
        const bool seen = (seen_[i / 64] >> (i % 64) & 1) != 0;
        Slot& slot = slots_[i];
        slot.expired = slot.expired && !seen;
        if (seen || !is_alive(i) || !std::isfinite(slot.top_speed)) return false;
        put_to_sleep(static_cast<std::uint32_t>(i));
        return true;
    });
    new_.clear();
}

}  // namespace rhview
