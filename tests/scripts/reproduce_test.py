#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""scripts/reproduce.sh --quick, from its options to its tables.

usage: reproduce_test.py REPRODUCE_SH BUILD_FOLDER
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

BUILT = sys.argv.pop()
SCRIPT = sys.argv.pop()
TEXT = pathlib.Path(SCRIPT).parent.parent / "docs" / "reproduction.md"


def without_tables(text):
    """What stands outside of the marks, and the marks."""
    lines, inside = [], False
    for line in text.splitlines():
        if line.startswith("<!-- end "):
            inside = False
        if not inside:
            lines.append(line)
        if line.startswith("<!-- begin "):
            inside = True
    return lines


def tables(text):
    """Rows by mark, without the head."""
    found, name = {}, None
    for line in text.splitlines():
        if line.startswith("<!-- begin "):
            name = line[len("<!-- begin "):-len(" -->")]
            found[name] = []
        elif line.startswith("<!-- end "):
            name = None
        elif name and line.startswith("|"):
            found[name].append([cell.strip() for cell in line.strip("|").split("|")])
    return {name: rows[2:] for name, rows in found.items()}


class Reproduce(unittest.TestCase):
    def run_script(self, *options):
        return subprocess.run([SCRIPT, *options], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)

    def test_a_quick_run_fills_every_table_and_leaves_the_text(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "page.md"
            done = self.run_script("--quick", "--built", BUILT, "-o", str(output))
            self.assertEqual(done.returncode, 0, done.stderr)
            text = output.read_text(encoding="utf-8")
            self.assertEqual(without_tables(text), without_tables(TEXT.read_text(encoding="utf-8")))
            self.assertIn("its numbers say nothing", text)
            found = tables(text)
            self.assertEqual([len(found[name]) for name in ("table 1", "claims", "batagelo")], [13, 10, 10])
            for row in found["table 1"]:
                for measured in (row[3], row[5], row[7], row[9]):
                    self.assertGreater(float(measured.replace(",", "").replace(" M", "e6")), 0, row)
            for row in found["batagelo"]:
                self.assertTrue(any(c.isdigit() for c in row[2]), row)
            self.assertEqual(sum("0 visible objects missing" in row[2] for row in found["batagelo"]), 2)
            self.assertGreater((output.parent / "images" / "reproduction.png").stat().st_size, 20000)
            for name in ("town.json", "farm.json", "spheres.json", "grid.csv"):
                self.assertTrue((output.parent / "results" / name).exists(), name)

    def test_unknown_options_are_told(self):
        for options, said in ((["--fast"], "unknown option '--fast'"), (["-o"], "-o needs a value")):
            done = self.run_script(*options)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
