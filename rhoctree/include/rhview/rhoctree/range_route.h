// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The cheapest index ranges that show one batch: a shortest path along its base order.
///
/// The caller goes along the base order and tells what must be shown (`show`) and where a replica could be
/// drawn instead (`enter_replica` … `leave_replica`, properly nested). Everything it doesn't mention is
/// hidden. The path has two states, a base range that is open or none, and the cost of each is that of the
/// least list so far:
///
///     show s indices after a gap of g    open = closed = min(open + c1·g, closed + c3) + c1·s
///     leave a replica of cost r          closed = min(closed, closed at its entry + r)
///
/// Closing is free, so closed never exceeds open, and hidden parts need no step of their own. That is the
/// min-plus product of the nodes' 2×2 matrices, applied to a vector: exact. Cost: a few flops a step; a step
/// that keeps the open range writes nothing but the state.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "rhview/rhoctree/draw_costs.h"

namespace rhview {

/// Back-pointers of all routes of a frame. Clearing keeps the memory.
class RangeLog {
  public:
    /// No place; as `first` of an entry: a replica.
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// A base range [first, end), or replica `end` if `first` is kNone.
    struct Entry {
        std::uint32_t previous = kNone;
        std::uint32_t first = 0;
        std::uint32_t end = 0;

        [[nodiscard]] bool is_replica() const { return first == kNone; }
    };

    void clear() { entries_.clear(); }
    [[nodiscard]] const Entry& operator[](std::uint32_t place) const { return entries_[place]; }
    /// Appends an entry and returns its place.
    std::uint32_t add(const Entry& entry) {
        entries_.push_back(entry);
        return static_cast<std::uint32_t>(entries_.size() - 1);
    }

  private:
    std::vector<Entry> entries_;
};

/// One batch's path. At equal cost a gap is bridged, and the base order is preferred to a replica.
class RangeRoute {
  public:
    /// What a replica is an alternative to.
    struct ReplicaEntry {
        double closed_ns = 0.0;
        std::uint32_t last = RangeLog::kNone;
    };

    /// Base indices [first, first + count) must be drawn; `first` is not below the end of what was shown
    /// before.
    void show(std::uint32_t first, std::uint32_t count, const DrawCosts& costs, RangeLog& log) {
        const double bridged = open_ns_ + costs.index_ns * (first - position_);
        const double fresh = closed_ns_ + costs.draw_ns;
        if (fresh < bridged) {
            open_previous_ = last_of_closed(log);
            open_first_ = first;
            closed_ns_ = fresh;
        } else {
            closed_ns_ = bridged;
        }
        closed_ns_ += costs.index_ns * count;
        open_ns_ = closed_ns_;
        position_ = first + count;
        closes_open_ = true;
    }

    /// From here to `leave_replica` a replica shows all that `show` is told.
    [[nodiscard]] ReplicaEntry enter_replica(RangeLog& log) { return {closed_ns_, last_of_closed(log)}; }

    /// The replica with this number shows what was told since `entry`, for `replica_ns`.
    void leave_replica(const ReplicaEntry& entry, std::uint32_t replica, double replica_ns, RangeLog& log) {
        if (!(entry.closed_ns + replica_ns < closed_ns_)) return;
        closed_ns_ = entry.closed_ns + replica_ns;
        closed_last_ = log.add({entry.last, RangeLog::kNone, replica});
        closes_open_ = false;
    }

    /// The least cost of all that was told, ns.
    [[nodiscard]] double cost_ns() const { return closed_ns_; }

    /// The last entry of the cheapest list; `previous` leads to those before. kNone: nothing is drawn.
    [[nodiscard]] std::uint32_t finish(RangeLog& log) { return last_of_closed(log); }

  private:
    /// The list that `closed_ns_` is the cost of: written down only when something follows it.
    std::uint32_t last_of_closed(RangeLog& log) {
        if (closes_open_) {
            closed_last_ = log.add({open_previous_, open_first_, position_});
            closes_open_ = false;
        }
        return closed_last_;
    }

    double open_ns_ = std::numeric_limits<double>::infinity();
    double closed_ns_ = 0.0;
    std::uint32_t position_ = 0;  ///< where the open range ends
    std::uint32_t open_first_ = 0;
    std::uint32_t open_previous_ = RangeLog::kNone;
    std::uint32_t closed_last_ = RangeLog::kNone;
    bool closes_open_ = false;  ///< the closed list is the open one, closed: not yet in the log
};

}  // namespace rhview
