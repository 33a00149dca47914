#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""The check of the exported symbols finds what is planted."""

import sys
import unittest

sys.dont_write_bytecode = True
import exported_symbols  # noqa: E402

NM = """0000000000000000 A RHVIEW_0.1
000000000000d6e0 T rhview_build@@RHVIEW_0.1
000000000000d6e1 W _ZNSt6vectorD1Ev
"""
HEADER = """RHVIEW_API uint32_t rhview_build(void);
/** RHVIEW_API mentioned. */
RHVIEW_API const char* rhview_name(
    int of);
"""


class ExportedSymbols(unittest.TestCase):
    def test_version_nodes_are_no_symbols_and_leaked_ones_are(self):
        self.assertEqual(exported_symbols.exported(NM), {"rhview_build", "_ZNSt6vectorD1Ev"})

    def test_declarations_are_found_over_line_ends(self):
        self.assertEqual(exported_symbols.declared(HEADER), {"rhview_build", "rhview_name"})

    def test_both_directions_are_told(self):
        told = list(exported_symbols.differences("exported", {"a", "b"}, {"b", "c"}))
        self.assertEqual([line.split(":")[0] for line in told], ["a", "c"])


if __name__ == "__main__":
    unittest.main()
