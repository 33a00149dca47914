// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "verbs.h"

namespace rhview::cli {

Result<int> run_view(const ViewOptions&) {
    return Error{
        "view: this build has no viewer; configure with -DRHVIEW_BUILD_VIEWER=ON, which needs GLFW and Dear "
        "ImGui (libglfw3-dev, libimgui-dev)"};
}

}  // namespace rhview::cli
