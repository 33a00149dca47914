#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""A documented header passes; each planted mistake is found.

usage: check_reference_test.py DOXYGEN
"""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from check_reference import main  # noqa: E402

DOXYGEN = sys.argv.pop()
SOUND = """/// \\file
/// A header.
#pragma once

/// What a thing is.
struct Thing {
    int width = 0;
    int height = 0;  ///< metres
    Thing(Thing&& other) noexcept;
    int area() const { return width * height; }
    /// Turns it round.
    void turn();
    friend bool operator==(const Thing&, const Thing&) = default;
};

/// Of all things.
int count_things(int width);
"""


def checked(text):
    """(exit code, output) for a header of that text."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "include").mkdir()
        (root / "include/thing.h").write_text(text, encoding="utf-8")
        (root / "Doxyfile").write_text(
            f'INPUT = "{root}/include"\nHTML_OUTPUT = .\nGENERATE_LATEX = NO\nHAVE_DOT = NO\nQUIET = YES\n'
            'JAVADOC_AUTOBRIEF = YES\nWARN_NO_PARAMDOC = NO\nWARN_FORMAT = "$file:$line: $text"\n', encoding="utf-8")
        with contextlib.redirect_stdout(io.StringIO()) as output:
            code = main([DOXYGEN, str(root / "Doxyfile"), str(root / "out")])
        return code, output.getvalue()


class CheckReference(unittest.TestCase):
    def expect_found(self, text, word):
        code, output = checked(text)
        self.assertEqual(code, 1)
        self.assertIn(word, output)

    def test_a_header_whose_fields_and_accessors_say_themselves_passes(self):
        self.assertEqual(checked(SOUND), (0, "reference: nothing wrong\n"))

    def test_a_structure_without_a_comment_is_found(self):
        self.expect_found(SOUND.replace("/// What a thing is.\n", ""), "Thing")

    def test_a_member_function_without_a_comment_is_found(self):
        self.expect_found(SOUND.replace("    /// Turns it round.\n", ""), "turn")

    def test_a_function_without_a_comment_is_found(self):
        self.expect_found(SOUND.replace("/// Of all things.\n", ""), "count_things")

    def test_a_constant_and_an_enumeration_without_comments_are_found(self):
        self.expect_found(SOUND + "inline constexpr int kMost = 3;\n", "kMost")
        self.expect_found(SOUND + "enum class Colour { Red };\n", "Colour")

    def test_a_parameter_that_is_not_there_is_found(self):
        self.expect_found(SOUND.replace("/// Of all things.", "/// Of all things.\n/// \\param colour of those"), "colour")

    def test_a_command_that_is_not_there_is_found(self):
        self.expect_found(SOUND.replace("/// Of all things.", "/// Of all \\thingz."), "thingz")


if __name__ == "__main__":
    unittest.main()
