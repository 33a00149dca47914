// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "box_pass.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "program.h"
#include "rhview/base/assert.h"

namespace rhview::gl {
namespace {

constexpr const char* kComputeShader = R"(#version 430 core
layout(local_size_x = 64) in;
struct Draw { uint first_index, index_count, slot, instances, first_instance; };
struct Command { uint count, instances, first_index, base_vertex, base_instance; };
layout(std430, binding = 0) readonly buffer Words { uint seen[]; };
layout(std430, binding = 1) readonly buffer Draws { Draw draws[]; };
layout(std430, binding = 2) writeonly buffer Commands { Command commands[]; };
uniform uint draw_count;
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= draw_count) return;
    Draw draw = draws[i];
    uint instances = seen[draw.slot] != 0u ? draw.instances : 0u;
    commands[i] = Command(draw.index_count, instances, draw.first_index, 0u, draw.first_instance);
}
)";

constexpr std::size_t kGroup = 64;
constexpr std::size_t kCommandBytes = 5 * sizeof(std::uint32_t);
/// Frames on their way back at most; a frame more, and the oldest is given up.
constexpr std::size_t kMostParcels = 16;

Buffer make_buffer() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return Buffer(name);
}

/// New storage of at least `bytes`, so that the device may go on reading the old.
void renew(const Buffer& buffer, std::size_t bytes) {
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.name());
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_DRAW);
}

bool has_signalled(const Fence& fence) {
    const GLenum status = glClientWaitSync(static_cast<GLsync>(fence.sync()), GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
}

}  // namespace

bool BoxPass::is_available() {
    if (epoxy_gl_version() < 44 && !epoxy_has_gl_extension("GL_ARB_buffer_storage")) return false;
    GLint blocks = 0;
    glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &blocks);
    return epoxy_gl_version() >= 43 && blocks >= 1;
}

Result<BoxPass> BoxPass::create(std::uint32_t lost_after_frames) {
    Result<Program> program = link_compute_program(kComputeShader);
    if (!program) return program.error();
    BoxPass pass;
    pass.program_ = std::move(program).value();
    pass.draw_count_ = glGetUniformLocation(pass.program_.name(), "draw_count");
    pass.lost_after_frames_ = lost_after_frames;
    pass.words_ = make_buffer();
    pass.draws_ = make_buffer();
    pass.commands_ = make_buffer();
    return pass;
}

void BoxPass::clear(std::size_t slots) {
    if (slots > words_capacity_) {
        words_capacity_ = std::max(slots, 2 * words_capacity_);
        renew(words_, words_capacity_ * sizeof(std::uint32_t));
        // Where the device had no memory, the next frame tries again.
        GLint64 bytes = 0;
        glGetBufferParameteri64v(GL_COPY_WRITE_BUFFER, GL_BUFFER_SIZE, &bytes);
        words_capacity_ = static_cast<std::size_t>(bytes) / sizeof(std::uint32_t);
    }
    const GLuint zero = 0;
    glBindBuffer(GL_COPY_WRITE_BUFFER, words_.name());
    glClearBufferSubData(GL_COPY_WRITE_BUFFER, GL_R32UI, 0,
                         static_cast<GLsizeiptr>(slots * sizeof(std::uint32_t)), GL_RED_INTEGER,
                         GL_UNSIGNED_INT, &zero);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, words_.name());
}

void BoxPass::decide(std::span<const SlotDraw> draws, std::span<const std::uint64_t> tickets) {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    if (!draws.empty()) make_commands(draws);
    send(tickets);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

void BoxPass::remake(std::span<const SlotDraw> draws) {
    make_commands(draws);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

void BoxPass::make_commands(std::span<const SlotDraw> draws) {
    draws_capacity_ = std::max(draws_capacity_, draws.size());
    renew(commands_, draws_capacity_ * kCommandBytes);
    renew(draws_, draws_capacity_ * sizeof(SlotDraw));
    glBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(draws.size_bytes()), draws.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, draws_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, commands_.name());
    glUseProgram(program_.name());
    glUniform1ui(draw_count_, static_cast<GLuint>(draws.size()));
    glDispatchCompute(static_cast<GLuint>((draws.size() + kGroup - 1) / kGroup), 1, 1);
}

void BoxPass::send(std::span<const std::uint64_t> tickets) {
    counters_.asked += tickets.size();
    Parcel& parcel = free_parcel();
    reserve(parcel, tickets.size());
    glBindBuffer(GL_COPY_READ_BUFFER, words_.name());
    glBindBuffer(GL_COPY_WRITE_BUFFER, parcel.buffer.name());
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
                        static_cast<GLsizeiptr>(tickets.size() * sizeof(std::uint32_t)));
    parcel.fence = Fence(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    parcel.frame = frame_;
    parcel.tickets.assign(tickets.begin(), tickets.end());
}

BoxPass::Parcel& BoxPass::free_parcel() {
    const auto free = std::ranges::find_if(parcels_, [](const Parcel& p) { return p.tickets.empty(); });
    if (free != parcels_.end()) return *free;
    if (parcels_.size() < kMostParcels) return parcels_.emplace_back();
    Parcel& oldest = *std::ranges::min_element(parcels_, {}, &Parcel::frame);
    give_up(oldest, given_up_);
    return oldest;
}

void BoxPass::reserve(Parcel& parcel, std::size_t words) {
    if (words <= parcel.capacity) return;
    parcel.capacity = std::max<std::size_t>(words, 2 * parcel.capacity);
    parcel.buffer = make_buffer();
    const auto bytes = static_cast<GLsizeiptr>(parcel.capacity * sizeof(std::uint32_t));
    constexpr GLbitfield kAccess = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glBindBuffer(GL_COPY_WRITE_BUFFER, parcel.buffer.name());
    glBufferStorage(GL_COPY_WRITE_BUFFER, bytes, nullptr, kAccess | GL_CLIENT_STORAGE_BIT);
    parcel.words =
        static_cast<const std::uint32_t*>(glMapBufferRange(GL_COPY_WRITE_BUFFER, 0, bytes, kAccess));
    if (parcel.words == nullptr) parcel.capacity = 0;  // without memory; the next frame tries again
}

void BoxPass::bind_commands() const {
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
}

const void* BoxPass::command_offset(std::size_t draw) {
    return reinterpret_cast<const void*>(draw * kCommandBytes);
}

void BoxPass::open(Parcel& parcel, std::vector<QueryAnswer>& answers) {
    for (std::size_t i = 0; i < parcel.tickets.size(); ++i)
        answers.push_back({parcel.tickets[i], parcel.words == nullptr || parcel.words[i] != 0, 0});
    counters_.answered += parcel.tickets.size();
    parcel.tickets.clear();
}

void BoxPass::give_up(Parcel& parcel, std::vector<QueryAnswer>& answers) {
    for (const std::uint64_t ticket : parcel.tickets) answers.push_back({ticket, true, 0});
    counters_.lost += parcel.tickets.size();
    parcel.tickets.clear();
}

void BoxPass::poll(std::vector<QueryAnswer>& answers) {
    answers.insert(answers.end(), given_up_.begin(), given_up_.end());
    given_up_.clear();
    for (Parcel& parcel : parcels_) {
        if (parcel.tickets.empty()) continue;
        if (has_signalled(parcel.fence))
            open(parcel, answers);
        else if (frame_ - parcel.frame > lost_after_frames_)
            give_up(parcel, answers);
    }
}

void BoxPass::wait(std::vector<QueryAnswer>& answers) {
    for (const Parcel& parcel : parcels_) {
        if (parcel.tickets.empty() || has_signalled(parcel.fence)) continue;
        ++counters_.blocking_reads;
        constexpr GLuint64 kTenSeconds = 10'000'000'000;
        glClientWaitSync(static_cast<GLsync>(parcel.fence.sync()), GL_SYNC_FLUSH_COMMANDS_BIT, kTenSeconds);
    }
    poll(answers);
}

}  // namespace rhview::gl
