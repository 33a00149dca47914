// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// An OpenGL context without a window: EGL, on a GPU where there is one, else on a software renderer. Or one
/// that the application made, with a window.
#pragma once

#include <memory>
#include <string>

#include "rhview/base/result.h"

namespace rhview::gl {

/// What draws, as its driver calls itself, and what it can do.
struct DeviceInfo {
    std::string renderer;
    std::string version;
    bool software = false;      ///< drawn by the CPU
    bool clip_control = false;  ///< `ClipDepth::ZeroToOne` and `ReversedZeroToOne` can be drawn
    bool box_pass = false;      ///< `QueryWay::BoxPass` can be drawn
    bool tells_loss = false;    ///< `check_device` sees a reset of the device
};

/// What to ask of the driver.
struct ContextOptions {
    bool debug = false;  ///< a debug context: the driver checks more and is slower
};

/// Current on the thread that made it, until destroyed (an adopted one stays the application's). The driver's
/// debug messages go to the library's log.
class Context {
  public:
    /// OpenGL 4.5 core, or 4.3 where that is all there is. An error names what was found on each device.
    static Result<Context> create_headless(const ContextOptions& options = {});

    /// Describes the context that is current on this thread, and forwards its debug messages. Its owner keeps
    /// it current while the library is used, and destroys it afterwards. An error where there is none, or one
    /// older than OpenGL 4.3.
    static Result<Context> adopt_current();

    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();

    /// Of the device found; valid as long as the context.
    [[nodiscard]] const DeviceInfo& device() const;

  private:
    struct State;
    explicit Context(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// An error if the device was reset since the context was made: nothing that it is told is drawn any more,
/// and queries get no answers (they count as visible). Cost: one API call.
Status check_device();
/// The sentence of an answer of glGetGraphicsResetStatus; empty if there was no reset.
std::string describe_reset(unsigned status);

/// Waits until everything submitted has been drawn.
void finish();

/// Clears the error flags; the first of them as text, empty if there was none. After a reset of the device it
/// is "context lost".
std::string take_error();

}  // namespace rhview::gl
