#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""scripts/report.py on files whose errors are known, and on files that are none.

usage: report_test.py REPORT_PY
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

REPORT = sys.argv.pop() if len(sys.argv) > 1 else "scripts/report.py"
PNG = b"\x89PNG\r\n\x1a\n"


def walk(errors, schema="rhview.walk/1"):
    frames = [{"frame": i, "frame_ms": 10.0, "predicted_ms": None if e is None else 10.0 * (1 + e), "indices": 1000 * i}
              for i, e in enumerate(errors)]
    return json.dumps({"schema": schema, "scene": {"name": "town"}, "method": "octree", "per_frame": frames})


class Report(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def run_report(self, *files):
        return subprocess.run([sys.executable, REPORT, *map(str, files), "-o", str(self.folder / "out")],
                              capture_output=True, text=True, check=False)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return self.folder / name

    def test_errors_are_those_of_the_walk_and_pictures_are_written(self):
        # Magnitudes 0.01 … 0.20: median 0.105, 95th percentile (nearest rank) 0.19.
        errors = [(-1) ** i * 0.01 * (i + 1) for i in range(20)]
        done = self.run_report(self.write("walk.json", walk(errors)))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("town, octree: 20 frames, off by 10.5 % in the median, 19.0 % at p95", done.stdout)
        for name in ("prediction.png", "residuals.png"):
            data = (self.folder / "out" / name).read_bytes()
            self.assertEqual(data[:8], PNG)
            self.assertGreater(len(data), 5000)

    def test_a_calibration_is_read_too(self):
        text = "indices,frame_ns,predicted_ns\n" + "".join(f"{1000 * i},1000000,1100000\n" for i in range(1, 9))
        done = self.run_report(self.write("calibration.csv", text))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("8 frames, off by 10.0 % in the median, 10.0 % at p95", done.stdout)

    def test_what_is_no_walk_is_told_by_name(self):
        for name, text, said in (("other.json", walk([0.1], "rhview.info/1"), "rhview.walk/1"),
                                 ("blind.json", walk([None, None]), "no frame was predicted"),
                                 ("cut.json", walk([0.1])[:40], "can't be read"),
                                 ("other.csv", "a,b\n1,2\n", "predicted_ns")):
            done = self.run_report(self.write(name, text))
            self.assertNotEqual(done.returncode, 0, name)
            self.assertIn(name, done.stderr)
            self.assertIn(said, done.stderr)
            self.assertFalse((self.folder / "out").exists(), name)
        self.assertIn("nowhere.json", self.run_report(self.folder / "nowhere.json").stderr)


if __name__ == "__main__":
    unittest.main()
