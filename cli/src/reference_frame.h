// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "rhview/gl/picture.h"

namespace rhview::cli {

/// Everything drawn at full detail, of one frame. Methods that take turns frame by frame share it: it is
/// dear.
struct ReferenceFrame {
    int frame = -1;  ///< none yet
    std::optional<gl::Picture> colour;
    std::vector<float> depths;
};

}  // namespace rhview::cli
