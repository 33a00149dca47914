// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <rhview/gl/context.h>
#include <rhview/scenes/import.h>

#include <cstdio>

// Calls into both modules, so that the link needs the libraries that the package must have found.
int main() {
    if (rhview::import_scene("no such file.obj").ok()) return 1;
    const auto context = rhview::gl::Context::create_headless();
    std::puts(context.ok() ? context->device().renderer.c_str() : context.error().message.c_str());
    return 0;
}
