// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "border.h"

#include <array>
#include <charconv>

#include "rhview/base/version.h"

namespace rhview::capi {
namespace {

/// Longer sentences are cut.
thread_local std::array<char, 1024> sentence_of_thread{};

}  // namespace

rhview_status fail(rhview_status status, std::string_view sentence) noexcept {
    const std::size_t length = std::min(sentence.size(), sentence_of_thread.size() - 1);
    std::copy_n(sentence.data(), length, sentence_of_thread.data());
    sentence_of_thread[length] = '\0';
    return status;
}

const char* last_error() noexcept {
    return sentence_of_thread.data();
}

rhview_status fail_field(const char* name, std::initializer_list<const char*> wrong) noexcept {
    std::array<char, 256> text{};
    std::size_t length = 0;
    const auto append = [&](const char* part) {
        const std::size_t part_length = std::min(std::strlen(part), text.size() - length);
        std::copy_n(part, part_length, text.data() + length);
        length += part_length;
    };
    append(name);
    append(": ");
    for (const char* part : wrong) append(part);
    return fail(RHVIEW_INVALID_ARGUMENT, {text.data(), length});
}

rhview_status fail_size(const char* name, std::size_t size) noexcept {
    std::array<char, 24> number{};
    std::to_chars(number.data(), number.data() + number.size() - 1, size);
    return fail_field(name, {"its size is ", number.data(),
                             ", which is none of this library's, or what it adds is not zero: set it to "
                             "zero, then size to sizeof"});
}

rhview_status take_workers(const rhview_workers* given, Workers& workers) noexcept {
    rhview_workers taken;
    if (const rhview_status status = take(given, "rhview_workers", taken); status != RHVIEW_OK) return status;
    workers = {taken.thread_count, taken.run, taken.user};
    return RHVIEW_OK;
}

}  // namespace rhview::capi

uint32_t rhview_c_api_version(void) {
    return RHVIEW_C_API_VERSION;
}

const char* rhview_version(void) {
    return rhview::kVersion;
}

const char* rhview_last_error(void) {
    return rhview::capi::last_error();
}
