#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""docs/performance.md says what the CSV files say; a figure that differs is found.

usage: performance_test.py ROOT
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop())
DOCUMENT = ROOT / "docs/performance.md"


def check(text):
    """(exit code, output) of the check of a document with that text."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "performance.md"
        file.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, ROOT / "scripts/performance.py", "--check", file], capture_output=True,
                              text=True, check=False)
        return done.returncode, done.stdout + done.stderr


class Performance(unittest.TestCase):
    def setUp(self):
        self.text = DOCUMENT.read_text(encoding="utf-8")

    def test_the_tables_are_those_of_the_files(self):
        self.assertEqual(check(self.text), (0, ""))

    def test_a_changed_figure_of_any_table_is_found(self):
        tables = list(re.finditer(r"<!-- begin (\w+) -->\n(.*?)<!-- end", self.text, re.DOTALL))
        self.assertGreater(len(tables), 10)
        for match in tables:
            digit = max(i for i in range(match.start(2), match.end(2)) if self.text[i].isdigit())
            other = str((int(self.text[digit]) + 1) % 10)
            code, output = check(self.text[:digit] + other + self.text[digit + 1:])
            self.assertEqual(code, 1, match[1])
            self.assertIn(f"performance.md:{self.text.count(chr(10), 0, digit) + 1}:", output, match[1])

    def test_a_line_too_many_is_found(self):
        self.assertEqual(check(self.text.replace("<!-- end pace -->", "| `x` |\n<!-- end pace -->"))[0], 1)

    def test_a_table_without_a_place_is_an_error_that_names_it(self):
        code, output = check(self.text.replace("<!-- begin boxes -->", ""))
        self.assertEqual(code, 1)
        self.assertIn("'boxes'", output)


if __name__ == "__main__":
    unittest.main()
