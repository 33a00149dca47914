// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "picture_size.h"
#include "rhview/base/result.h"

namespace rhview::cli {

/// What was done with keys and mouse since it was last asked. What the panels took is not in it.
struct ViewInput {
    std::uint32_t held = 0;  ///< a set of `Movement`, now
    double right_px = 0.0, down_px = 0.0;
    double wheel = 0.0;
    std::vector<std::string> tapped;  ///< names of keys, as `command_of_key` knows them
    std::vector<std::filesystem::path> dropped;
};

/// A window with an OpenGL context (through EGL) and Dear ImGui. One at a time.
class ViewWindow {
  public:
    /// The context is current until the window is destroyed. Errors: no display, no OpenGL 4.3.
    static Result<ViewWindow> create(const std::string& title, PictureSize size);
    ViewWindow(ViewWindow&&) noexcept;
    ViewWindow& operator=(ViewWindow&&) noexcept;
    ~ViewWindow();

    /// Pixels, not the window system's units. 0 while it is minimised.
    [[nodiscard]] PictureSize size() const;
    [[nodiscard]] bool wants_to_close() const;
    ViewInput take_input();
    void set_title(const std::string& title);

    /// Panels are made between `begin_panels` and `draw_panels`, which draws them over the window's picture.
    void begin_panels();
    void draw_panels();
    /// Brings the picture to the screen.
    void present();

  private:
    struct State;
    explicit ViewWindow(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rhview::cli
