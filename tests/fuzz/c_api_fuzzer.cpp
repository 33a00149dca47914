// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// libFuzzer target: any sequence of calls of the C interface. With the arguments `--seeds FOLDER` in place of
// libFuzzer's it writes the first corpus there.

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "c_api_session.h"

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    if (*argc != 3 || std::strcmp((*argv)[1], "--seeds") != 0) return 0;
    std::filesystem::create_directories((*argv)[2]);
    int number = 0;
    for (const std::vector<std::uint8_t>& seed : rhview::c_api_seeds()) {
        std::ofstream file(std::filesystem::path((*argv)[2]) / std::to_string(number++), std::ios::binary);
        file.write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
    }
    std::exit(0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    rhview::run_c_api_session({data, size});
    return 0;
}
