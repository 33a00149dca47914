#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""What is taken out of a Markdown file, and what is refused."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from extract_snippets import snippets  # noqa: E402


def taken(text):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "guide.md"
        file.write_text(text, encoding="utf-8")
        return snippets(file)


class ExtractSnippets(unittest.TestCase):
    def test_blocks_of_one_name_are_joined_in_their_order(self):
        files, mistakes = taken("a\n```cpp x.cpp\nint a;\n```\n```cmake y.txt\nq()\n```\n```cpp x.cpp\nint b;\n```\n")
        self.assertEqual(files, {"x.cpp": "int a;\nint b;\n", "y.txt": "q()\n"})
        self.assertEqual(mistakes, [])

    def test_a_block_of_code_without_a_name_is_a_mistake_with_its_line(self):
        files, mistakes = taken("\n\n```cpp\nint a;\n```\n")
        self.assertEqual(files, {})
        self.assertEqual(len(mistakes), 1)
        self.assertIn("guide.md:3:", mistakes[0])

    def test_a_name_cannot_lead_out_of_the_folder(self):
        self.assertEqual(len(taken("```c ../x.c\nint a;\n```\n")[1]), 1)

    def test_shell_and_output_are_not_taken(self):
        self.assertEqual(taken("```sh\nls\n```\n```text x\n1\n```\n"), ({}, []))


if __name__ == "__main__":
    unittest.main()
