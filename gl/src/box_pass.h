// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/gl/handle.h"
#include "rhview/gl/query_pool.h"

namespace rhview::gl {

/// A draw that hangs on a slot; as the compute shader reads it.
struct SlotDraw {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::uint32_t slot = 0;
    std::uint32_t instances = 1;
    std::uint32_t first_instance = 0;
};

/// A word per query that fragments of its boxes set, indirect commands made from them on the device, and the
/// words' way back: copied to mapped memory and read when a fence says that they are there.
class BoxPass {
  public:
    /// Whether the current context has what it needs: storage buffers, compute shaders and multi-draw
    /// indirect (OpenGL 4.3), persistently mapped memory (4.4 or GL_ARB_buffer_storage).
    static bool is_available();
    static Result<BoxPass> create(std::uint32_t lost_after_frames);

    BoxPass(BoxPass&&) noexcept = default;
    BoxPass& operator=(BoxPass&&) noexcept = default;

    void begin_frame() { ++frame_; }
    /// Clears `slots` words and binds them to storage buffer 0.
    void clear(std::size_t slots);
    /// After the boxes were drawn: makes a command of each draw, with its instances if its slot is set, else
    /// none, and sends the words of `tickets`, slot by slot, on their way back.
    void decide(std::span<const SlotDraw> draws, std::span<const std::uint64_t> tickets);
    /// Makes other commands by the same words. Takes the place of the program, and changes buffer bindings.
    void remake(std::span<const SlotDraw> draws);
    /// Binds the commands for indirect drawing.
    void bind_commands() const;
    static const void* command_offset(std::size_t draw);

    /// Appends the answers that have come, and those given up; never waits.
    void poll(std::vector<QueryAnswer>& answers);
    /// Appends all answers; waits, and counts it.
    void wait(std::vector<QueryAnswer>& answers);
    [[nodiscard]] const AnswerCounters& counters() const { return counters_; }

  private:
    /// A frame's words on their way back; memory that is used again.
    struct Parcel {
        Buffer buffer;
        const std::uint32_t* words = nullptr;  ///< mapped as long as the buffer lives
        std::size_t capacity = 0;
        Fence fence;
        std::uint64_t frame = 0;
        std::vector<std::uint64_t> tickets;  ///< none: free
    };

    BoxPass() = default;
    void make_commands(std::span<const SlotDraw> draws);
    void send(std::span<const std::uint64_t> tickets);
    Parcel& free_parcel();
    void open(Parcel& parcel, std::vector<QueryAnswer>& answers);
    void give_up(Parcel& parcel, std::vector<QueryAnswer>& answers);
    static void reserve(Parcel& parcel, std::size_t words);

    Program program_;
    int draw_count_ = -1;
    Buffer words_, draws_, commands_;
    std::size_t words_capacity_ = 0, draws_capacity_ = 0;
    std::vector<Parcel> parcels_;
    std::vector<QueryAnswer> given_up_;  ///< by `send`, for the next `poll`
    std::uint32_t lost_after_frames_ = 0;
    std::uint64_t frame_ = 0;
    AnswerCounters counters_;
};

}  // namespace rhview::gl
