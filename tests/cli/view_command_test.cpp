// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "view_command.h"

#include <gtest/gtest.h>

#include "view_camera.h"

namespace rhview::cli {
namespace {

std::vector<ScriptLine> script(const std::string& text) {
    Result<std::vector<ScriptLine>> lines = parse_view_script(text, "s.txt");
    EXPECT_TRUE(lines.ok()) << (lines.ok() ? "" : lines.error().message);
    return lines.ok() ? *lines : std::vector<ScriptLine>();
}

std::string refusal(const std::string& text) {
    const Result<std::vector<ScriptLine>> lines = parse_view_script(text, "s.txt");
    return lines.ok() ? "no error" : lines.error().message;
}

TEST(ViewScript, is_a_command_a_line_with_comments_and_blank_ones) {
    const std::vector<ScriptLine> lines =
        script("# hello\r\n\r\nframes 10 # ten\r\n  hold W,shift 20\r\nturn 40 -1.5\n");
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].line, 3);
    EXPECT_EQ(lines[0].command.verb, ViewVerb::Frames);
    EXPECT_EQ(lines[0].command.frames, 10);
    EXPECT_EQ(lines[1].command.verb, ViewVerb::Hold);
    EXPECT_EQ(lines[1].command.text, "W,shift");
    EXPECT_EQ(lines[1].command.frames, 20);
    EXPECT_EQ(lines[2].command.x, 40.0);
    EXPECT_EQ(lines[2].command.y, -1.5);
}

TEST(ViewScript, takes_the_rest_of_a_line_for_a_name) {
    const std::vector<ScriptLine> lines =
        script("open my scenes/a castle.glb  \nscreenshot\nrecord a b.json\nfreeze off");
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_EQ(lines[0].command.text, "my scenes/a castle.glb");
    EXPECT_EQ(lines[1].command.text, "");
    EXPECT_EQ(lines[2].command.text, "a b.json");
    EXPECT_EQ(lines[3].command.on, false);
}

TEST(ViewScript, that_is_wrong_is_refused_by_line_with_an_example) {
    const struct {
        const char* text;
        const char* sentence;
    } cases[] = {
        {"frames 1\nfly 3", "s.txt, line 2: unknown command 'fly'; the commands are frames, hold, turn"},
        {"frames", "s.txt, line 1: 'frames' is not complete or not right; write for example: frames 10"},
        {"frames 0", "write for example: frames 10"},
        {"frames 10 20", "write for example: frames 10"},
        {"\nhold X 3",
         "s.txt, line 2: 'hold X 3' is not complete or not right; write for example: hold W,shift 20"},
        {"turn 3", "turn 40 -10"},
        {"turn 3 nan", "turn 40 -10"},
        {"c3 -1", "c3 2000"},
        {"c3 inf", "c3 2000"},
        {"freeze maybe", "freeze on"},
        {"method", "method octree"},
        {"tell me", "tell"},
    };
    for (const auto& c : cases)
        EXPECT_NE(refusal(c.text).find(c.sentence), std::string::npos)
            << refusal(c.text) << " lacks " << c.sentence;
    EXPECT_EQ(refusal(""), "no error");
}

TEST(ViewKeys, fly_or_command_never_both) {
    for (const char* key : {"W", "S", "A", "D", "E", "Q", "shift"}) {
        EXPECT_NE(movement_of_key(key), 0u) << key;
        EXPECT_FALSE(command_of_key(key)) << key;
    }
    for (const char* key : {"F", "O", "B", "C", "R", "P", "F12", "Tab", "Escape"}) {
        EXPECT_TRUE(command_of_key(key)) << key;
        EXPECT_EQ(movement_of_key(key), 0u) << key;
    }
    EXPECT_FALSE(command_of_key("Z"));
    EXPECT_EQ(movement_of_key("Z"), 0u);
    EXPECT_GE(key_help().size(), 12u);
}

}  // namespace
}  // namespace rhview::cli
