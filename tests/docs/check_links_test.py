#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Sound links pass, broken ones are found."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from check_links import broken_links  # noqa: E402


def broken(text):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "docs").mkdir()
        (root / "docs/other.md").write_text("# A title, with `marks`\n## Twice\n## Twice\n```sh\n# no heading\n```\n",
                                           encoding="utf-8")
        (root / "docs/page.md").write_text(text, encoding="utf-8")
        return list(broken_links(root))


class CheckLinks(unittest.TestCase):
    def test_links_to_files_folders_headings_and_the_web_pass(self):
        self.assertEqual(broken("# Here\n[a](other.md) [b](../docs) [c](other.md#a-title-with-marks)\n"
                                "[d](other.md#twice-1) [e](#here) [f](https://example.org/x) ![g](other.md)\n"), [])

    def test_a_file_that_is_not_there_is_found_with_its_line(self):
        self.assertEqual(broken("\n[a](missing.md)\n"), ["docs/page.md:2: there is no 'missing.md'"])

    def test_a_heading_that_is_not_there_is_found(self):
        self.assertEqual(len(broken("[a](other.md#no-heading) [b](#nowhere)\n")), 2)

    def test_a_link_out_of_the_tree_is_found(self):
        self.assertEqual(len(broken("[a](../../)\n")), 1)

    def test_code_holds_no_links(self):
        self.assertEqual(broken("`[a](x)`\n```\n[b](y)\n```\n"), [])


if __name__ == "__main__":
    unittest.main()
