#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""scripts/report.py on files whose errors are known, and on files that are none.

usage: report_test.py REPORT_PY
"""

import html.parser
import json
import pathlib
import shutil
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


def image_error(number):
    """None of the first method, then ten times more of each."""
    loss = 0.0 if number == 0 else 1e-4 * 10 ** number
    return {"frames": 20, "missing_pixels": 40 * number, "depth_mean": loss, "depth_max": 1.0, "colour_mse": 100 * loss,
            "psnr_db": None if number == 0 else 30.0 - number, "ssim": 1 - loss, "ssim_min": 1 - 2 * loss}


def compare(labels=("frustum", "octree:leaf=100", "rhview"), winner=None, lod=False, pareto=None):
    """A comparison as the program writes it, with a label that is hostile to HTML at will."""
    runs, compared = [], []
    for number, label in enumerate(labels):
        statistics = lambda value: {"mean": value, "median": value, "p95": value, "max": value}
        frames = [{"frame": i, "frame_ms": 10.0 + number + i % 3, "cull_ms": 0.1, "draw_calls": 10 * (number + 1) + i,
                   "indices": 30000 * (i + 1), "queries": i, "predicted_ms": 9.0 + i} for i in range(20)]
        runs.append({"schema": "rhview.walk/1", "label": label, "method": "octree", "frames": 20, "size": [640, 360],
                     "scene": {"name": "town", "triangles": 5000000, "dynamic_objects": 0},
                     "device": {"renderer": "a device", "version": "4.5", "timer": "wall"},
                     "profile": {"c1_ns": 1.0, "c3_ns": 1000.0, "source": "set"},
                     "summary": {"frame_ms": statistics(11.0), "cull_ms": statistics(0.1), "draw_calls": statistics(20),
                                 "indices": statistics(3e5), "queries": statistics(9), "predicted_ms": statistics(18),
                                 "modelled_indices": statistics(5e5),
                                 "image_error": image_error(number) if pareto else None,
                                 "lod_error_px": statistics(0.5 * number) if lod else None,
                                 "missing_pixels": {"total": 0, "max": 0, "frames": 0, "checked_frames": 20}},
                     "per_frame": frames})
        interval = {"median": 1.0, "low": 0.9, "high": 1.1}
        compared.append({"label": label, "frame_ms": interval, "frame_ms_ratio": interval})
    return json.dumps({"schema": "rhview.compare/1", "command": "rhview compare town --methods 'a<b'", "order": "frame",
                       "threads": 2, "pareto": pareto, "reference": labels[-1], "winner": winner, "comparison": compared, "runs": runs})


class Page(html.parser.HTMLParser):
    """Tags that are open at the end, ids, and what a browser would fetch."""

    VOID = {"meta", "link", "img"}

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.references, self.tags = [], [], [], set()
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        if tag not in self.VOID:
            self.open.append(tag)
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            if name in ("src", "href", "xlink:href", "srcset", "data"):
                self.references.append(value)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()


PLOTS = ["frame_ms", "cull_ms", "draw_calls", "indices", "queries", "prediction"]
BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


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

    def page(self, text):
        done = self.run_report(self.write("compare.json", text))
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "out" / "report.html").read_text(encoding="utf-8")

    def test_the_page_of_a_comparison_has_every_plot_and_needs_nothing_else(self):
        (self.folder / "out" / "scene").mkdir(parents=True)
        (self.folder / "out" / "scene" / "frame_0000.png").write_bytes(PNG)
        text = self.page(compare(lod=True, winner="rhview"))
        page = Page(text)
        self.assertEqual(page.open, [])
        self.assertEqual([i for i in page.ids if i.startswith("plot-")], [f"plot-{p}" for p in PLOTS + ["error"]])
        self.assertIn("scene", page.ids)
        self.assertTrue(page.references)
        for reference in page.references:
            self.assertTrue(reference.startswith("data:"), reference[:80])
        self.assertNotIn("script", page.tags)
        for word in ("@import", "url(", "http:", "https:"):
            self.assertNotIn(word, text)
        self.assertEqual(text.count('<polyline class="series"'), 3 * 5)
        self.assertIn("<strong>rhview</strong> is fastest", text)
        self.assertIn("prefers-color-scheme: dark", text)
        self.assertIn("width=device-width", text)

    def test_the_page_tells_no_winner_where_there_is_none_and_no_error_plot_without_levels(self):
        text = self.page(compare())
        self.assertNotIn("is fastest:", text)
        self.assertIn("No method is told to be the fastest", text)
        self.assertNotIn("plot-error", Page(text).ids)

    FRONT = {"error": "1 - ssim", "frame_ms": ["frustum"], "draw_calls": ["frustum", "rhview"], "indices": ["frustum"]}

    def test_the_page_of_a_front_has_its_plots_and_its_table(self):
        text = self.page(compare(pareto=self.FRONT))
        page = Page(text)
        self.assertEqual(page.open, [])
        for cost in ("frame_ms", "draw_calls", "indices"):
            self.assertIn(f"plot-front_{cost}", page.ids)
        self.assertIn("errors", page.ids)
        self.assertEqual(text.count('<polyline class="front"'), 3)
        self.assertEqual(text.count('<circle cx="'), 3 * 3 + 3 * 20)
        self.assertIn("<td>equal</td>", text)
        self.assertIn("<td>0.99900</td>", text)
        self.assertIn("<td>20*</td>", text)
        self.assertNotIn("plot-front", self.page(compare()))

    def test_lines_that_nobody_could_tell_apart_are_left_out(self):
        labels = tuple(f"method {i}" for i in range(13))
        front = {cost: [labels[0]] for cost in ("frame_ms", "draw_calls", "indices")}
        text = self.page(compare(labels=labels, pareto=front))
        self.assertNotIn("plot-frame_ms", Page(text).ids)
        self.assertIn("plot-front_frame_ms", Page(text).ids)

    def test_the_front_is_a_picture_too(self):
        done = subprocess.run([sys.executable, REPORT, str(self.write("compare.json", compare(pareto=self.FRONT))), "-o",
                               str(self.folder / "out"), "--front"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        data = (self.folder / "out" / "front.png").read_bytes()
        self.assertEqual(data[:8], PNG)
        self.assertGreater(len(data), 5000)
        done = subprocess.run([sys.executable, REPORT, str(self.write("plain.json", compare())), "-o",
                               str(self.folder / "out"), "--front"], capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("plain.json: tells no front", done.stderr)

    def test_names_are_text_not_markup(self):
        text = self.page(compare(labels=("<script>alert(1)</script>", "rhview")))
        self.assertNotIn("script", Page(text).tags)
        self.assertIn("&lt;script&gt;", text)
        self.assertIn("a&lt;b", text)

    def test_a_comparison_that_lacks_fields_is_told_by_name(self):
        broken = json.loads(compare())
        del broken["runs"][0]["summary"]
        done = self.run_report(self.write("broken.json", json.dumps(broken)))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("broken.json: lacks what a comparison has", done.stderr)

    @unittest.skipIf(BROWSER is None, "no chromium here: the page was not opened in a browser")
    def test_a_browser_shows_the_page_without_an_error(self):
        self.page(compare(lod=True, pareto=self.FRONT))
        done = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0",
                               f"--user-data-dir={self.folder / 'browser'}", "--dump-dom",
                               (self.folder / "out" / "report.html").as_uri()],
                              capture_output=True, text=True, check=False, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("CONSOLE", done.stderr)
        self.assertEqual(done.stdout.count("<figure"), len(PLOTS) + 1 + 3)


if __name__ == "__main__":
    unittest.main()
