// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// libFuzzer target: any bytes, read as a baked file, end in an error sentence or in an octree that plans
// within its bounds.

#include "rho_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    rhview::use_raw_and_repaired(std::as_bytes(std::span(data, size)));
    return 0;
}
