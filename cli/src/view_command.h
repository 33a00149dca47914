// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rhview/base/result.h"

namespace rhview::cli {

/// What a viewer can be told, by keys, panels or a script.
enum class ViewVerb {
    Frames,  ///< go on for `frames`
    Hold,    ///< fly with the keys of `text` for `frames`
    Turn,    ///< the mouse is dragged by `x`, `y` pixels
    Key,     ///< the key `text` is tapped
    Method,  ///< `text`, and so are the next ones
    Mode,
    Occlusion,
    Submission,
    IndexPrice,  ///< c1 becomes `x` ns
    DrawPrice,   ///< c3 becomes `x` ns
    LodError,    ///< levels of detail may be `x` pixels off
    Budget,      ///< a frame may take `x` ms; 0: as long as it takes
    Rebuild,     ///< the octree, for the prices
    Freeze,      ///< the culling camera; `on`
    Outside,     ///< look at the frozen camera from outside
    Back,        ///< to where the frozen camera is
    Colours,     ///< show the plan's parts, frozen or not; `on`
    Panels,      ///< `on`
    Record,      ///< the flight to the file `text`, or to a new one
    Stop,        ///< recording or replaying
    Replay,      ///< the path file `text`, or the scene's own path
    Screenshot,  ///< to the file `text`, or to a new one, after the next frame
    Open,        ///< the scene `text`, as if its file were dropped on the window
    Tell,        ///< print what the last frame was
    Quit,
};

struct ViewCommand {
    ViewVerb verb = ViewVerb::Frames;
    std::string text;
    double x = 0.0, y = 0.0;
    int frames = 0;
    std::optional<bool> on;  ///< absent: the other way round
};

/// A command, and the line that it stands in.
struct ScriptLine {
    int line = 0;
    ViewCommand command;
};

/// A command a line: `frames 10`, `hold W,shift 20`, `turn 40 -10`, `freeze on`, `screenshot a.png`; # begins
/// a comment. An error names `source_name`, the line and the mend.
Result<std::vector<ScriptLine>> parse_view_script(std::string_view text, const std::string& source_name);

/// What a tapped key means, by its name; absent: nothing.
std::optional<ViewCommand> command_of_key(std::string_view key);
/// What a held key means, as bits of `Movement`; 0: nothing.
std::uint32_t movement_of_key(std::string_view key);

/// The keys and what they do, for people.
struct KeyHelp {
    const char* key;
    const char* what;
};
const std::vector<KeyHelp>& key_help();

}  // namespace rhview::cli
