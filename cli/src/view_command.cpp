// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "view_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "view_camera.h"

namespace rhview::cli {
namespace {

enum class Arguments { None, Frames, KeysAndFrames, TwoNumbers, Price, Text, MaybeText, Switch };

struct Word {
    const char* name;
    ViewVerb verb;
    Arguments arguments;
    const char* usage;
};

constexpr std::array kWords{
    Word{"frames", ViewVerb::Frames, Arguments::Frames, "frames 10"},
    Word{"hold", ViewVerb::Hold, Arguments::KeysAndFrames, "hold W,shift 20"},
    Word{"turn", ViewVerb::Turn, Arguments::TwoNumbers, "turn 40 -10"},
    Word{"key", ViewVerb::Key, Arguments::Text, "key F"},
    Word{"method", ViewVerb::Method, Arguments::Text, "method octree"},
    Word{"mode", ViewVerb::Mode, Arguments::Text, "mode latent"},
    Word{"occlusion", ViewVerb::Occlusion, Arguments::Text, "occlusion off"},
    Word{"submission", ViewVerb::Submission, Arguments::Text, "submission multi"},
    Word{"c1", ViewVerb::IndexPrice, Arguments::Price, "c1 0.25"},
    Word{"c3", ViewVerb::DrawPrice, Arguments::Price, "c3 2000"},
    Word{"lod-error", ViewVerb::LodError, Arguments::Price, "lod-error 2"},
    Word{"budget", ViewVerb::Budget, Arguments::Price, "budget 16.6"},
    Word{"rebuild", ViewVerb::Rebuild, Arguments::None, "rebuild"},
    Word{"freeze", ViewVerb::Freeze, Arguments::Switch, "freeze on"},
    Word{"outside", ViewVerb::Outside, Arguments::None, "outside"},
    Word{"back", ViewVerb::Back, Arguments::None, "back"},
    Word{"colours", ViewVerb::Colours, Arguments::Switch, "colours on"},
    Word{"panels", ViewVerb::Panels, Arguments::Switch, "panels off"},
    Word{"record", ViewVerb::Record, Arguments::MaybeText, "record path.json"},
    Word{"stop", ViewVerb::Stop, Arguments::None, "stop"},
    Word{"replay", ViewVerb::Replay, Arguments::MaybeText, "replay path.json"},
    Word{"screenshot", ViewVerb::Screenshot, Arguments::MaybeText, "screenshot a.png"},
    Word{"open", ViewVerb::Open, Arguments::Text, "open castle.glb"},
    Word{"tell", ViewVerb::Tell, Arguments::None, "tell"},
    Word{"quit", ViewVerb::Quit, Arguments::None, "quit"},
};

struct TappedKey {
    const char* key;
    ViewVerb verb;
    const char* what;
};

constexpr std::array kTapped{
    TappedKey{"F", ViewVerb::Freeze, "freeze the culling camera, or let it go"},
    TappedKey{"O", ViewVerb::Outside, "look at the frozen camera from outside"},
    TappedKey{"B", ViewVerb::Back, "back to the frozen camera"},
    TappedKey{"C", ViewVerb::Colours, "show draw calls, gaps and boxes"},
    TappedKey{"R", ViewVerb::Record, "record the flight, or stop"},
    TappedKey{"P", ViewVerb::Replay, "replay the last recording, or the scene's path; or stop"},
    TappedKey{"F12", ViewVerb::Screenshot, "screenshot"},
    TappedKey{"Tab", ViewVerb::Panels, "panels"},
    TappedKey{"Escape", ViewVerb::Quit, "quit"},
};

struct HeldKey {
    std::string_view key;
    Movement movement;
};

constexpr std::array kHeld{HeldKey{"W", kForward}, HeldKey{"S", kBack}, HeldKey{"A", kLeft},
                           HeldKey{"D", kRight},   HeldKey{"E", kUp},   HeldKey{"Q", kDown},
                           HeldKey{"shift", kFast}};

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const std::size_t first = text.find_first_not_of(separators);
        if (first == std::string_view::npos) break;
        const std::size_t end = std::min(text.find_first_of(separators, first), text.size());
        parts.push_back(text.substr(first, end - first));
        text.remove_prefix(end);
    }
    return parts;
}

template <class Number>
bool read_number(std::string_view text, Number& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

bool read_frames(std::string_view text, int& frames) {
    return read_number(text, frames) && frames >= 1 && frames <= 1'000'000;
}

bool read_arguments(Arguments kind, const std::vector<std::string_view>& words, std::string_view rest,
                    ViewCommand& command) {
    switch (kind) {
        case Arguments::None:
            return words.empty();
        case Arguments::Frames:
            return words.size() == 1 && read_frames(words[0], command.frames);
        case Arguments::KeysAndFrames:
            if (words.size() != 2) return false;
            for (const std::string_view key : split(words[0], ","))
                if (movement_of_key(key) == 0) return false;
            command.text = words[0];
            return read_frames(words[1], command.frames);
        case Arguments::TwoNumbers:
            return words.size() == 2 && read_number(words[0], command.x) &&
                   read_number(words[1], command.y) && std::isfinite(command.x) && std::isfinite(command.y);
        case Arguments::Price:
            return words.size() == 1 && read_number(words[0], command.x) && std::isfinite(command.x) &&
                   command.x >= 0.0;
        case Arguments::Text:
        case Arguments::MaybeText:
            command.text = rest;
            return kind == Arguments::MaybeText || !rest.empty();
        case Arguments::Switch:
            if (words.size() != 1 || (words[0] != "on" && words[0] != "off")) return false;
            command.on = words[0] == "on";
            return true;
    }
    return false;
}

}  // namespace

std::uint32_t movement_of_key(std::string_view key) {
    const auto held = std::ranges::find(kHeld, key, &HeldKey::key);
    return held != kHeld.end() ? held->movement : 0u;
}

std::optional<ViewCommand> command_of_key(std::string_view key) {
    for (const TappedKey& tapped : kTapped)
        if (key == tapped.key) return ViewCommand{tapped.verb, {}, 0.0, 0.0, 0, {}};
    return std::nullopt;
}

const std::vector<KeyHelp>& key_help() {
    static const std::vector<KeyHelp> help = [] {
        std::vector<KeyHelp> lines{{"W S A D", "fly forward, back, left, right"},
                                   {"E Q", "up, down"},
                                   {"Shift", "four times as fast; the wheel changes the speed"},
                                   {"drag", "look around"}};
        for (const TappedKey& tapped : kTapped) lines.push_back({tapped.key, tapped.what});
        return lines;
    }();
    return help;
}

Result<std::vector<ScriptLine>> parse_view_script(std::string_view text, const std::string& source_name) {
    std::vector<ScriptLine> lines;
    int number = 0;
    while (!text.empty()) {
        ++number;
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        line = line.substr(0, line.find('#'));
        const std::vector<std::string_view> words = split(line, " \t\r");
        if (words.empty()) continue;
        const auto word = std::ranges::find(kWords, words[0], &Word::name);
        if (word == kWords.end()) {
            std::vector<const char*> names;
            for (const Word& known : kWords) names.push_back(known.name);
            return Error{fmt::format("{}, line {}: unknown command '{}'; the commands are {}", source_name,
                                     number, words[0], fmt::join(names, ", "))};
        }
        ScriptLine parsed{number, {word->verb, {}, 0.0, 0.0, 0, {}}};
        const std::string_view rest =
            words.size() > 1
                ? std::string_view(
                      words[1].data(),
                      static_cast<std::size_t>(words.back().data() + words.back().size() - words[1].data()))
                : std::string_view();
        if (!read_arguments(word->arguments, {words.begin() + 1, words.end()}, rest, parsed.command))
            return Error{fmt::format("{}, line {}: '{}' is not complete or not right; write for example: {}",
                                     source_name, number, split(line, "\r").front(), word->usage)};
        lines.push_back(std::move(parsed));
    }
    return lines;
}

}  // namespace rhview::cli
