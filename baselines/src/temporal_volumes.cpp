// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/temporal_volumes.h"

#include <algorithm>

namespace rhview {
namespace {

/// The axes of the matrices xy, xz, yz.
constexpr std::array<std::array<int, 2>, 3> kAxes{{{0, 1}, {0, 2}, {1, 2}}};

}  // namespace

TemporalVolumes::TemporalVolumes(const glm::ivec3& cells, std::size_t object_count)
    : cells_(cells),
      first_node_(object_count, kNone),
      place_(object_count, kNone),
      next_due_(object_count, kNone),
      previous_due_(object_count, kNone) {
    std::size_t total = 0;
    for (std::size_t m = 0; m < 3; ++m) {
        matrix_first_[m] = total;
        total += static_cast<std::size_t>(cells[kAxes[m][0]]) * static_cast<std::size_t>(cells[kAxes[m][1]]);
    }
    heads_.assign(total, kNone);
    lengths_.assign(total, 0);
    boxes_.reserve(object_count);
    owner_.reserve(object_count);
    due_.fill(kNone);
}

std::size_t TemporalVolumes::cell_of(int matrix, int a, int b) const {
    const auto m = static_cast<std::size_t>(matrix);
    return matrix_first_[m] + static_cast<std::size_t>(b) * static_cast<std::size_t>(cells_[kAxes[m][0]]) +
           static_cast<std::size_t>(a);
}

void TemporalVolumes::add_node(std::uint32_t cell, std::uint32_t object) {
    std::uint32_t n = free_;
    if (n != kNone) {
        free_ = nodes_[n].next;
    } else {
        n = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
    }
    nodes_[n] = {object, cell, kNone, heads_[cell], first_node_[object]};
    if (heads_[cell] != kNone) nodes_[heads_[cell]].previous = n;
    heads_[cell] = n;
    first_node_[object] = n;
    ++lengths_[cell];
}

void TemporalVolumes::add_outline(int matrix, const CellBox& box, std::uint32_t object) {
    const auto& axes = kAxes[static_cast<std::size_t>(matrix)];
    const int a0 = box.min[axes[0]], a1 = box.max[axes[0]], b0 = box.min[axes[1]], b1 = box.max[axes[1]];
    const auto add = [&](int a, int b) {
        add_node(static_cast<std::uint32_t>(cell_of(matrix, a, b)), object);
    };
    for (int a = a0; a <= a1; ++a) {
        add(a, b0);
        if (b1 > b0) add(a, b1);
    }
    for (int b = b0 + 1; b < b1; ++b) {
        add(a0, b);
        if (a1 > a0) add(a1, b);
    }
}

void TemporalVolumes::insert(ObjectId object, const CellBox& box, std::uint32_t period) {
    const auto id = static_cast<std::uint32_t>(object);
    for (int matrix = 0; matrix < 3; ++matrix) add_outline(matrix, box, id);
    SmallBox small{};
    for (std::size_t a = 0; a < 3; ++a) {
        small.min[a] = static_cast<std::int16_t>(box.min[static_cast<int>(a)]);
        small.max[a] = static_cast<std::int16_t>(box.max[static_cast<int>(a)]);
    }
    place_[id] = static_cast<std::uint32_t>(boxes_.size());
    boxes_.push_back(small);
    owner_.push_back(id);
    const auto list = (frame_ + period) % static_cast<std::uint32_t>(due_.size());
    next_due_[id] = due_[list];
    previous_due_[id] = kHead | list;
    if (due_[list] != kNone) previous_due_[due_[list]] = id;
    due_[list] = id;
}

void TemporalVolumes::unlink_due(std::uint32_t id) {
    const std::uint32_t previous = previous_due_[id], next = next_due_[id];
    ((previous & kHead) != 0 ? due_[previous & ~kHead] : next_due_[previous]) = next;
    if (next != kNone) previous_due_[next] = previous;
}

void TemporalVolumes::remove(ObjectId object) {
    const auto id = static_cast<std::uint32_t>(object);
    for (std::uint32_t n = first_node_[id]; n != kNone;) {
        const Node node = nodes_[n];
        (node.previous == kNone ? heads_[node.cell] : nodes_[node.previous].next) = node.next;
        --lengths_[node.cell];
        if (node.next != kNone) nodes_[node.next].previous = node.previous;
        nodes_[n].next = free_;
        free_ = n;
        n = node.sibling;
    }
    first_node_[id] = kNone;
    unlink_due(id);
    const std::uint32_t place = place_[id], last = owner_.back();
    boxes_[place] = boxes_.back();
    owner_[place] = last;
    place_[last] = place;
    boxes_.pop_back();
    owner_.pop_back();
    place_[id] = kNone;
}

void TemporalVolumes::next_frame(std::vector<ObjectId>& expired) {
    ++frame_;
    const auto first = static_cast<std::ptrdiff_t>(expired.size());
    for (std::uint32_t id = due_[frame_ % due_.size()]; id != kNone; id = next_due_[id])
        expired.push_back(ObjectId{id});
    std::sort(expired.begin() + first, expired.end());
}

bool TemporalVolumes::on_hull(std::uint32_t place, const glm::ivec3& cell) const {
    const SmallBox& box = boxes_[place];
    bool inside = true, border = false;
    for (std::size_t a = 0; a < 3; ++a) {
        const int c = cell[static_cast<int>(a)];
        inside = inside && c >= box.min[a] && c <= box.max[a];
        border = border || c == box.min[a] || c == box.max[a];
    }
    return inside && border;
}

// A cell of the hull lies on two outlines of three, so it is found in one of any two matrices.
void TemporalVolumes::find_at(const glm::ivec3& cell, std::vector<ObjectId>& found) const {
    std::array<std::size_t, 3> lists{};
    for (std::size_t m = 0; m < 3; ++m)
        lists[m] = cell_of(static_cast<int>(m), cell[kAxes[m][0]], cell[kAxes[m][1]]);
    std::sort(lists.begin(), lists.end(),
              [&](std::size_t a, std::size_t b) { return lengths_[a] < lengths_[b]; });
    for (std::size_t k = 0; k < 2; ++k)
        for (std::uint32_t n = heads_[lists[k]]; n != kNone; n = nodes_[n].next)
            if (on_hull(place_[nodes_[n].object], cell)) found.push_back(ObjectId{nodes_[n].object});
}

void TemporalVolumes::find_around(const glm::ivec3& cell, std::vector<ObjectId>& found) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        const SmallBox& box = boxes_[i];
        bool inside = true;
        for (std::size_t a = 0; a < 3; ++a) {
            const int c = cell[static_cast<int>(a)];
            inside &= (c >= box.min[a]) & (c <= box.max[a]);
        }
        if (inside) found.push_back(ObjectId{owner_[i]});
    }
}

}  // namespace rhview
