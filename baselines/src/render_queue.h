// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "recorder.h"

namespace rhview {

/// Leaves that are to be drawn before the next queries, and then are, sorted by batch and within a batch in
/// the order of adding: front to back.
class RenderQueue {
  public:
    void add(std::span<const DrawRange> ranges, std::span<const ObjectId> objects);
    /// A leaf that is one draw, which is asked about with it.
    void add_asked(std::uint32_t leaf, std::span<const DrawRange> ranges, std::span<const ObjectId> objects);
    /// Draws and empties it, objects by `groups` (`FrameInput::object_groups`); calls `asked(leaf, query)`
    /// for each leaf that was asked about.
    template <class Callback>
    void flush(Recorder& recorder, std::span<const std::uint32_t> groups, Callback asked) {
        sort(groups);
        for (std::size_t first = 0; first < ranges_.size();) {
            const std::size_t end = end_of_run(first);
            const std::span<const DrawRange> run = std::span(sorted_).subspan(first, end - first);
            if (ranges_[first].leaf == kNotAsked)
                recorder.draw(run, {});
            else
                asked(ranges_[first].leaf, recorder.draw_and_ask(run, {}));
            first = end;
        }
        if (!objects_.empty()) recorder.draw({}, objects_);
        for (const AskedObject& object : asked_objects_)
            asked(object.leaf, recorder.draw_and_ask({}, {&object.object, 1}));
        clear();
    }

  private:
    static constexpr std::uint32_t kNotAsked = 0xffffffffu;
    struct Queued {
        DrawRange range;
        std::uint32_t number = 0;
        std::uint32_t leaf = kNotAsked;
    };
    struct AskedObject {
        ObjectId object{};
        std::uint32_t leaf = 0;
    };

    void add_range(const DrawRange& range, std::uint32_t leaf);
    void sort(std::span<const std::uint32_t> groups);
    /// Ranges that go to the device with one call: until one that is asked about, or that one alone.
    [[nodiscard]] std::size_t end_of_run(std::size_t first) const;
    void clear();

    std::vector<Queued> ranges_;
    std::vector<DrawRange> sorted_;
    std::vector<ObjectId> objects_;
    std::vector<AskedObject> asked_objects_;
};

}  // namespace rhview
