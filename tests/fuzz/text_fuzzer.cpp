// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// libFuzzer target, one program for each of `text_targets`: RHVIEW_FUZZ_TARGET is its number. With the
// argument
// `--seeds FOLDER` in place of libFuzzer's it writes the first corpus there.

#include <cstring>

#include "text_inputs.h"

namespace {

const rhview::TextTarget& target() {
    return rhview::text_targets().at(RHVIEW_FUZZ_TARGET);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    if (*argc != 3 || std::strcmp((*argv)[1], "--seeds") != 0) return 0;
    std::filesystem::create_directories((*argv)[2]);
    int number = 0;
    for (const std::string& seed : target().seeds)
        std::ofstream(std::filesystem::path((*argv)[2]) / std::to_string(number++), std::ios::binary) << seed;
    std::exit(0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    target().use({reinterpret_cast<const char*>(data), size});
    return 0;
}
