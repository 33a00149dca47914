// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include "rhview/base/result.h"

namespace rhview::cli {

struct PictureSize {
    int width = 0;
    int height = 0;
};

/// `1280x720`.
Result<PictureSize> parse_size(const std::string& text);

}  // namespace rhview::cli
