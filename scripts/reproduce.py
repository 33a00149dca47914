#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Makes figures of the literature again and writes them beside the published ones: Table 1 of Serpa & Rodrigues 2018 on
our substitutes for its scenes, figures 4.3 to 4.8 of Batagelo 2002 on the scene `spheres`.

Replaces what stands between <!-- begin NAME --> and <!-- end NAME --> in a text; the text itself is left as it is.
scripts/reproduce.sh builds what this runs.
"""

import argparse
import csv
import json
import pathlib
import re
import statistics
import subprocess
import sys

# Serpa & Rodrigues 2018, Table 1: milliseconds, frames/s, indices ("vertices"), draw calls, visible objects.
PUBLISHED = {
    "town": {"octree": (86.6, 11.53, 5406271, 195831.18, None), "nested-grid": (13.7, 72.86, 582542, 1197.29, None),
             "chc++": (3.0, 329.46, 1019734, 152.57, None), "rhview": (1.7, 570.06, 4012393, 98.46, None)},
    "farm": {"nested-grid": (29.1, 34.31, 88982068, 184.10, 33.90), "chc++": (28.1, 35.54, 89495474, 37.16, 33.98),
             "rhview": (25.5, 39.11, 84198523, 15.52, 31.83), "rhview, levels": (10.5, 95.08, 31952939, 15.52, 31.83)}}
# What is walked, what it is called, and the published row that it stands beside.
METHODS = {
    "town": [("octree:leaf=16", "octree, 16 triangles a leaf", "octree"), ("octree", "octree, 4,096 triangles a leaf", None),
             ("nested-grid", "nested grid", "nested-grid"), ("chc", "CHC", None), ("chc++", "CHC++", "chc++"),
             ("rhview-seed", "the paper's rules", "rhview"), ("rhview", "rhview", "rhview")],
    "farm": [("nested-grid:lod-error=0", "nested grid", "nested-grid"), ("chc++:lod-error=0", "CHC++", "chc++"),
             ("rhview-seed:lod-error=0", "the paper's rules", "rhview"), ("rhview:lod-error=0", "rhview", "rhview"),
             ("chc++:lod-error=1", "CHC++, levels within 1 px", None),
             ("rhview:lod-error=1", "rhview, levels within 1 px", "rhview, levels")]}
SPHERES = ["none", "frustum", "grid", "grid:cells=75000", "rhview"]
FULL = {"scenes": {"town": "town", "farm": "farm"}, "frames": {"town": 30, "farm": 3}, "spheres": "spheres",
        "spheres_frames": 150, "size": "1280x720", "grid": []}
QUICK = {"scenes": {"town": "town:size=80", "farm": "farm:mesh=2000,instances=20"}, "frames": {"town": 4, "farm": 4},
         "spheres": "spheres:spheres=300,moving=30,sides=8", "spheres_frames": 6, "size": "160x90", "grid": ["--quick"]}


class Runs:
    """What was measured: `compare` of each scene, and the rows of the grid program."""

    def __init__(self, plan, program, grid_program, folder):
        self.plan, self.program, self.folder = plan, program, folder
        folder.mkdir(parents=True, exist_ok=True)
        self.walks = {name: self.compare(name, spec, plan["frames"][name], [m[0] for m in METHODS[name]])
                      for name, spec in plan["scenes"].items()}
        self.spheres = self.compare("spheres", plan["spheres"], plan["spheres_frames"], SPHERES)
        self.grid = self.grid_rows(grid_program)

    def run(self, command, **more):
        print(" ".join(map(str, command)), file=sys.stderr, flush=True)
        done = subprocess.run(list(map(str, command)), check=False, text=True, stdin=subprocess.DEVNULL, **more)
        if done.returncode != 0:
            sys.exit(f"reproduce: {' '.join(map(str, command))} ended with exit code {done.returncode}")
        return done

    def compare(self, name, spec, frames, methods):
        result, profile = self.folder / f"{name}.json", self.folder / f"profile-{name}.json"
        constants = ["--set", "c1=1,c3=500,query=2000"]
        if self.plan is FULL:
            self.run([self.program, "calibrate", spec, "-o", profile], stdout=subprocess.DEVNULL)
            constants = ["--profile", profile]
        self.run([self.program, "compare", spec, "--frames", frames, "--warmup", 2, "--size", self.plan["size"],
                  "--methods", ",".join(methods), "--json", result, *constants], stdout=subprocess.DEVNULL)
        return json.loads(result.read_text(encoding="utf-8"))

    def grid_rows(self, program):
        text = self.run([program, *self.plan["grid"]], stdout=subprocess.PIPE).stdout
        (self.folder / "grid.csv").write_text(text, encoding="utf-8")
        return [{key: value if key in ("test", "cells") else float(value) for key, value in row.items()}
                for row in csv.DictReader(text.splitlines())]


def run_of(compared, label):
    return next(run for run in compared["runs"] if run["label"] == label)


def number(value):
    """Three figures or all of a whole number's, with commas; a dash for what is not there."""
    if value is None:
        return ""
    if abs(value) >= 1e6:
        return f"{value / 1e6:.2f} M"
    if abs(value) >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}"


def table_of(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def mean(run, field):
    value = run["summary"][field]
    return None if value is None else value["mean"]


def table_1(runs):
    head = ["scene", "method", "ms, published", "here", "frames/s, published", "here", "indices, published", "here",
            "calls, published", "here", "objects, published", "here"]
    rows = []
    for scene, methods in METHODS.items():
        for label, name, published in methods:
            run = run_of(runs.walks[scene], label)
            ms = mean(run, "frame_ms")
            here = (ms, 1000.0 / ms, mean(run, "indices"), mean(run, "draw_calls"), mean(run, "visible_objects"))
            beside = PUBLISHED[scene][published] if published else (None,) * 5
            rows.append([f"`{scene}`", name, *(number(v) for pair in zip(beside, here) for v in pair)])
    return table_of(head, rows)


def claims(runs):
    """Ratios that the paper rests on."""
    def ratio(scene, slow, fast, of):
        value = lambda label: mean(run_of(runs.walks[scene], label), of)
        return value(slow) / value(fast)

    published = lambda scene, slow, fast, column: PUBLISHED[scene][slow][column] / PUBLISHED[scene][fast][column]
    asked = [("`town`: time, octree of tiny leaves over RHView", published("town", "octree", "rhview", 0), "town",
              "octree:leaf=16", "frame_ms"),
             ("`town`: time, nested grid over RHView", published("town", "nested-grid", "rhview", 0), "town", "nested-grid",
              "frame_ms"),
             ("`town`: time, CHC++ over RHView", published("town", "chc++", "rhview", 0), "town", "chc++", "frame_ms"),
             ("`town`: calls, CHC++ over RHView", published("town", "chc++", "rhview", 3), "town", "chc++", "draw_calls"),
             ("`farm`: time, nested grid over RHView", published("farm", "nested-grid", "rhview", 0), "farm", "nested-grid",
              "frame_ms"),
             ("`farm`: time, CHC++ over RHView", published("farm", "chc++", "rhview", 0), "farm", "chc++", "frame_ms"),
             ("`farm`: calls, CHC++ over RHView", published("farm", "chc++", "rhview", 3), "farm", "chc++", "draw_calls"),
             ("`farm`: time, CHC++ at full detail over RHView with levels", published("farm", "chc++", "rhview, levels", 0),
              "farm", "chc++", "frame_ms"),
             ("`farm`: time, both with levels", None, "farm", "chc++:levels", "frame_ms"),
             ("`farm`: indices, full detail over levels", published("farm", "rhview", "rhview, levels", 2), "farm",
              "rhview", "indices")]
    rows = []
    for name, value, scene, rival, of in asked:
        plain = lambda method: f"{method}:lod-error=0" if scene == "farm" else method
        rival_label = "chc++:lod-error=1" if rival == "chc++:levels" else plain(rival)
        with_levels = "levels" in name
        here = [number(ratio(scene, rival_label, plain("rhview-seed") if not with_levels else "", of))
                if not with_levels else "",
                number(ratio(scene, rival_label, "rhview:lod-error=1" if with_levels else plain("rhview"), of))]
        rows.append([name, number(value), *here])
    return table_of(["ratio, above 1: RHView is better", "published", "here, the paper's rules", "here, `rhview`"], rows)


class Grid:
    """The rows of one test of the grid program."""

    def __init__(self, runs):
        self.rows = runs.grid

    def of(self, test, cells=None):
        return [row for row in self.rows if row["test"] == test and cells in (None, row["cells"])]

    def at(self, test, cells, x):
        """The row nearest to x."""
        return min(self.of(test, cells), key=lambda row: abs(row["x"] - x))


COARSE, FINE = "50x30x50", "100x60x100"


def walk_text(grid, cells):
    rows = grid.of("walk", cells)
    total = lambda field: statistics.fmean(row[field] for row in rows)
    worst = max(row["pvs"] / row["exact"] for row in rows if row["exact"] > 0)
    missing = sum(row["missing"] for row in rows)
    return (f'{total("pvs") / total("exact"):.2f} ({total("pvs"):.0f} of {total("exact"):.0f} objects; '
            f'{total("in_view"):.0f} in the frustum), {worst:.2f} in the worst frame; {missing:.0f} visible objects missing')


def hidden_text(grid, cells):
    at = lambda x: grid.at("hidden", cells, x)
    return ", ".join(f'{at(x)["plan_ms_mean"]:.2f} ms for {at(x)["x"]:,.0f} (at most {at(x)["plan_ms_max"]:.2f})'
                     for x in (500, 10000, 20000)) + f'; none: {at(0)["plan_ms_mean"]:.2f} ms'


def batagelo(runs):
    grid, walk = Grid(runs), runs.spheres
    ms = lambda label: run_of(walk, label)["summary"]["frame_ms"]["median"]
    last = lambda cells: max(grid.of("traversal", cells), key=lambda row: row["x"])
    at_80 = grid.at("traversal", FINE, 80)
    resolution = grid.of("resolution")
    best = min(resolution, key=lambda row: row["plan_ms_median"])
    exactness = lambda n: (lambda row: f'{row["pvs"] / max(row["exact"], 1):.2f} at {row["x"]:.0f}³')(
        grid.at("resolution", None, n))
    rows = [
        ["4.3, hidden moving objects, 50 × 30 × 50", "3.4 ms for 500; about 100 frames/s with more than 10,000; constant",
         hidden_text(grid, COARSE)],
        ["4.3, 100 × 60 × 100", "0.20 ms more", hidden_text(grid, FINE)],
        ["4.4, walk, frame time", "z-buffer alone constant and slowest; 50 × 30 × 50 more than twice as fast as 100 × 60 × 100",
         f'everything {ms("none"):.1f} ms, frustum {ms("frustum"):.1f}, 50 × 30 × 50 {ms("grid:cells=75000"):.1f}, '
         f'100 × 60 × 100 {ms("grid"):.1f}; `rhview` {ms("rhview"):.1f}'],
        ["4.5, the same walk: potentially over exactly visible, 50 × 30 × 50", '"excessive"', walk_text(grid, COARSE)],
        ["4.5, 100 × 60 × 100", "about 2", walk_text(grid, FINE)],
        ["4.6, all cells of an empty scene, 100 × 60 × 100 over 50 × 30 × 50", '"grows fast": 8 times the cells',
         f'{last(FINE)["plan_ms_median"] / last(COARSE)["plan_ms_median"]:.1f} times ({last(FINE)["plan_ms_median"]:.1f} and '
         f'{last(COARSE)["plan_ms_median"]:.1f} ms, field of view of {last(FINE)["x"]:.0f}°)'],
        ["4.6, shape", "steep to about 80°, flat beyond",
         f'{at_80["plan_ms_median"]:.1f} of {last(FINE)["plan_ms_median"]:.1f} ms are reached at {at_80["x"]:.0f}°'],
        ["4.7, best resolution N³", "about 70³", f'{best["x"]:.0f}³: {best["plan_ms_median"]:.2f} ms, planning alone'],
        ["4.8, potentially over exactly visible", "3.6 at 70³, 3.2 at 100³", f"{exactness(70)}, {exactness(100)}"],
        ["4.8, below 25³", "no occlusion at all", exactness(20)]]
    return table_of(["figure", "thesis", "here"], rows)


def about(runs):
    first = runs.walks["town"]
    device = first["runs"][0]["device"]["renderer"]
    frames = runs.plan["frames"]
    quick = " **A quick run, to see that it runs: its numbers say nothing.**" if runs.plan is QUICK else ""
    return (f'{device}, {first["threads"]} threads, {runs.plan["size"]}; {frames["town"]} frames of `{runs.plan["scenes"]["town"]}`, '
            f'{frames["farm"]} of `{runs.plan["scenes"]["farm"]}`, {runs.plan["spheres_frames"]} of `{runs.plan["spheres"]}`; '
            f"methods take turns frame by frame.{quick}")


def plot(runs, file):
    import matplotlib
    matplotlib.use("Agg")  # before pyplot: no window
    import matplotlib.pyplot as plt

    grid = Grid(runs)
    figure, axes = plt.subplots(2, 3, figsize=(15, 8))
    names = {COARSE: "50 × 30 × 50", FINE: "100 × 60 × 100"}
    for cells, name in names.items():
        for place, test, label in ((axes[0][0], "hidden", "plan_ms_mean"), (axes[1][0], "traversal", "plan_ms_median")):
            rows = grid.of(test, cells)
            place.plot([r["x"] for r in rows], [r[label] for r in rows], marker=".", label=name)
        rows = grid.of("walk", cells)
        axes[0][2].plot([r["x"] for r in rows], [r["pvs"] for r in rows], label=f"grid, {name}")
    rows = grid.of("walk", FINE)
    for field, name in (("in_view", "frustum"), ("exact", "exact")):
        axes[0][2].plot([r["x"] for r in rows], [r[field] for r in rows], label=name)
    for run in runs.spheres["runs"]:
        axes[0][1].plot([1000.0 / f["frame_ms"] for f in run["per_frame"]], linewidth=0.9, label=run["label"])
    rows = grid.of("resolution")
    axes[1][1].plot([r["x"] for r in rows], [r["plan_ms_median"] for r in rows], marker=".")
    for field, name in (("in_view", "frustum"), ("pvs", "grid"), ("exact", "exact")):
        axes[1][2].plot([r["x"] for r in rows], [r[field] for r in rows], marker=".", label=name)
    titles = (("4.3: hidden moving objects", "objects", "planning, ms"), ("4.4: a walk", "frame", "frames/s"),
              ("4.5: objects drawn on it", "frame", "objects"), ("4.6: an empty scene", "field of view, degrees", "planning, ms"),
              ("4.7: resolution N³, one view", "N", "planning, ms"), ("4.8: objects drawn in it", "N", "objects"))
    for place, (title, x, y) in zip(axes.flat, titles):
        place.set(title=title, xlabel=x, ylabel=y)
        if place in (axes[0][2], axes[1][2]):
            place.set_yscale("log")
        else:
            place.set_ylim(bottom=0)
        if place.get_legend_handles_labels()[1]:
            place.legend(fontsize="x-small")
    figure.tight_layout()
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=90)
    plt.close(figure)


def replaced(text, name, part):
    pattern = re.compile(rf"(<!-- begin {re.escape(name)} -->\n).*?(<!-- end {re.escape(name)} -->)", re.DOTALL)
    if len(pattern.findall(text)) != 1:
        sys.exit(f"reproduce: the text has no single place <!-- begin {name} --> … <!-- end {name} -->")
    return pattern.sub(lambda match: f"{match.group(1)}{part}\n{match.group(2)}", text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", required=True, help="rhview")
    parser.add_argument("--grid-program", required=True, help="rhview_grid_visibility")
    parser.add_argument("--text", type=pathlib.Path, required=True, help="with the places of the tables")
    parser.add_argument("--results", type=pathlib.Path, required=True, help="folder for what was measured")
    parser.add_argument("--figure", type=pathlib.Path, required=True, help="picture of the figures")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--quick", action="store_true", help="small scenes and few frames: only to see that it runs")
    options = parser.parse_args()
    text = options.text.read_text(encoding="utf-8")
    for name in ("about", "table 1", "claims", "batagelo"):
        replaced(text, name, "")  # a text without its places is told before the long part
    runs = Runs(QUICK if options.quick else FULL, options.program, options.grid_program, options.results)
    for name, part in (("about", about(runs)), ("table 1", table_1(runs)), ("claims", claims(runs)),
                       ("batagelo", batagelo(runs))):
        text = replaced(text, name, part)
    plot(runs, options.figure)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(text, encoding="utf-8")
    print(f"{options.output}: written; what was measured lies in {options.results}")


if __name__ == "__main__":
    main()
