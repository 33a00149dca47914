#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Writes the tables of docs/performance.md from the committed CSV files: no figure on that page is typed by hand.

usage: performance.py [--check] [DOCUMENT [RESULTS]]

Replaces what stands between <!-- begin NAME --> and <!-- end NAME -->. --check writes nothing, and fails if a table is not
what the files say.
"""

import csv
import pathlib
import re
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "docs/performance.md"
RESULTS = ROOT / "benchmarks/results/llvmpipe-2core"
METHODS = ("frustum", "chc", "chc++", "rhview")


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def short(value):
    """Three digits, as a reader wants them: 0.52, 12.6, 148, 3.94 M."""
    if value >= 1e6:
        return f"{short(value / 1e6)} M"
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


class Results:
    def __init__(self, folder):
        self.folder = folder

    def rows(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        if not rows:
            sys.exit(f"performance: {self.folder / name} has no line")
        return rows

    def frames(self, name):
        """{scene: {method: frame times in ms, by frame}} of a comparison."""
        scenes = {}
        for row in self.rows(name):
            scenes.setdefault(row["scene"], {}).setdefault(row["method"], []).append(float(row["frame_ms"]))
        return scenes

    def benchmark(self, name, case, column):
        """A median of a Google Benchmark file."""
        found = [row for row in self.rows(name) if row["name"] == case]
        if len(found) != 1:
            sys.exit(f"performance: {name} has {len(found)} lines '{case}'")
        return float(found[0][column])


def paired_ratio(of, over):
    return statistics.median(a / b for a, b in zip(of, over, strict=True))


def compared(name):
    def write(results):
        rows = []
        for scene, times in results.frames(name).items():
            medians = [short(statistics.median(times[method])) for method in METHODS]
            ratios = [short(paired_ratio(times[method], times["rhview"])) for method in METHODS[:-1]]
            rows.append([f"`{scene}`", *medians, *ratios])
        return table(["scene", *(f"`{method}`, ms" for method in METHODS),
                      *(f"`{method}` over `rhview`" for method in METHODS[:-1])], rows)
    return write


def losses(results):
    """Every pair of the comparisons and walks in which another exact method is faster."""
    rows = []
    for name, what in (("compare_pace.csv", "pace"), ("compare.csv", "hurried")):
        for scene, times in results.frames(name).items():
            for method in METHODS[:-1]:
                ratio = paired_ratio(times[method], times["rhview"])
                if ratio < 1:
                    rows.append([f"`{scene}`, {what}", f"`{method}`", "`rhview`", short(ratio)])
    scenes = {}
    for row in results.rows("walks.csv"):
        way = {"exact": "`rhview`", "off": "`rhview --occlusion off`"}.get(row["occlusion"])
        key = way or (f"`{row['method']}`" if row["occlusion"] == "" else None)
        if key:
            scenes.setdefault(row["scene"], {})[key] = float(row["frame_ms"])
    for scene, times in scenes.items():
        for ours in ("`rhview`", "`rhview --occlusion off`"):
            for method, time in times.items():
                if method.startswith("`rhview ") or method == "`rhview`":
                    continue
                if time < times[ours]:
                    rows.append([f"`{scene}`, hurried", method, ours, short(time / times[ours])])
    return table(["scene", "is faster", "than", "its time over ours"], rows)


def submitted(results):
    rows = []
    for row in results.rows("walks.csv"):
        if row["occlusion"] == "latent":
            continue
        method = f"`{row['method']}`" + {"off": ", no queries", "exact": ", queries"}.get(row["occlusion"], "")
        rows.append([f"`{row['scene']}`, {short(float(row['triangles']))}, {row['materials']}", method,
                     short(float(row["draw_calls_mean"])), short(float(row["indices_mean"])),
                     short(float(row["queries_mean"])) if row["queries_mean"] else "",
                     short(float(row["cull_ms"])), short(float(row["frame_ms"])), row["missing_pixels"]])
    return table(["scene, triangles, materials", "method", "draw calls", "indices", "queries", "planning, ms", "frame, ms",
                  "missing pixels"], rows)


def latent(results):
    modes = {}
    for row in results.rows("walks.csv"):
        if row["method"] == "rhview":
            modes.setdefault(row["scene"], {})[row["occlusion"]] = row
    rows = []
    for scene, found in modes.items():
        exact, trusting = found["exact"], found["latent"]
        width, height = map(int, trusting["size"].split("x"))
        pixels = int(trusting["checked_frames"]) * width * height
        rows.append([f"`{scene}`", short(float(exact["frame_ms"])), short(float(trusting["frame_ms"])),
                     f"{int(trusting['missing_pixels']) / pixels:.1%}"])
    return table(["scene", "exact, ms", "latent, ms", "pixels missing"], rows)


def lists(results):
    rows = []
    for row in results.rows("draw_list.csv"):
        seed = row["method"] == "rhview-seed" and row["leaf"] == "4096"
        if not seed and row["leaf"] not in ("chosen", "chosen without replicas"):
            continue
        method = {"4096": "the paper's rule", "chosen": "`rhview`"}.get(row["leaf"], "`rhview`, no replicas")
        rows.append([f"`{row['scene']}`", short(float(row["c3_ns"]) / float(row["c1_ns"])), method,
                     short(float(row["draws_mean"])), short(float(row["indices_mean"])),
                     short(float(row["modelled_us"]) / 1000), short(float(row["plan_us_median"])),
                     short(float(row["replica_share"]))])
    return table(["scene", "a draw's price, indices", "list", "draws", "indices", "modelled, ms", "planning, µs",
                  "replicas, share of the indices' bytes"], rows)


def build(results):
    rows = []
    for case, what in (("build_rhview/100", "octree of `rhview`, replicas up to the indices' size"),
                       ("build_rhview/0", "the same without replicas"),
                       ("build_plain/4096", "octree alone, leaves of 4,096")):
        rows.append([what, short(results.benchmark("octree_build.csv", f"{case}/real_time_median", "real_time")),
                     short(results.benchmark("octree_build.csv", f"{case}/real_time_median", "Mtri/s"))])
    rows.append(["baked file mapped and checked",
                 short(results.benchmark("octree_load.csv", "load_baked/100/real_time_median", "real_time")), ""])
    return table(["of `town`, 6.3 M triangles", "ms", "million triangles/s"], rows)


def planning(results):
    return table(["scene", "nodes of the octree", "visited", "candidates", "queries", "draws", "µs, median", "µs, p95"],
                 [[f"`{row['scene']}`", *(short(float(row[column])) for column in (
                     "nodes", "nodes_visited", "candidates", "queries", "draws", "plan_us_median", "plan_us_p95"))]
                  for row in results.rows("planning.csv")])


def movers(results):
    walks = {}
    for row in results.rows("crowd_hidden.csv"):
        if row["run"] != "least":  # made of the other rows
            walks.setdefault((row["walk"], int(row["hidden_walkers"])), []).append(row)
    def middle(rows, column):
        return short(statistics.median(float(row[column]) for row in rows))
    return table(["walk", "hidden walkers", "frame, ms", "planning, ms", "indices"],
                 [[walk, f"{walkers:,}", middle(rows, "frame_ms_mean"), middle(rows, "cull_ms_mean"),
                   middle(rows, "indices_mean")] for (walk, walkers), rows in walks.items()])


def levels(results):
    return table(["error bound, px", "indices", "frame, ms", "largest error, px", "SSIM"],
                 [[row["lod_error_px"], short(float(row["indices_mean"])), short(float(row["frame_ms_mean"])),
                   row["largest_error_px"], row["ssim_mean"]] for row in results.rows("farm_levels.csv")])


def budgets(results):
    return table(["budget, ms", "frames", "said: can be met", "of those, met", "frame, ms, mean", "p95"],
                 [[row["budget_ms"], row["frames"], row["can_be_met"],
                   f"{row['met_of_those']} ({int(row['met_of_those']) / int(row['can_be_met']):.1%})",
                   row["frame_ms_mean"], row["frame_ms_p95"]] for row in results.rows("farm_budget.csv")])


def boxes(results):
    cases = (("scalar_loop", "plain loop"), ("compiler_vectorised<straight_loop_avx512>", "loop that GCC vectorises, AVX-512"),
             ("batch/sse4", "`cull_boxes`, SSE4"), ("batch/avx2", "`cull_boxes`, AVX2"), ("batch/avx512", "`cull_boxes`, AVX-512"),
             ("batch_of_four_views", "`cull_boxes`, four views at once, per view"), ("plain_read", "reading the boxes"))
    sizes = ("8192", "1000000", "4000000")
    return table(["ns a box", *(f"{int(size):,} boxes" for size in sizes)],
                 [[what, *(short(results.benchmark("box_batch.csv", f"{case}/{size}_median", "ns/box")) for size in sizes)]
                  for case, what in cases])


def predictions(results):
    scenes = {}
    for row in results.rows("predictions.csv"):
        scenes.setdefault(row["scene"], {}).setdefault(row["profile"], []).append(float(row["error_median"]))
    def spread(errors):
        return f"{100 * min(errors):.0f} to {100 * max(errors):.0f} %"
    return table(["scene", "the machine's profile", "the scene's own", "following the frames before"],
                 [[f"`{scene}`", *(spread(found[profile]) for profile in ("machine", "scene", "running"))]
                  for scene, found in scenes.items()])


TABLES = {"pace": compared("compare_pace.csv"), "hurried": compared("compare.csv"), "losses": losses,
          "submitted": submitted, "latent": latent, "lists": lists, "build": build, "planning": planning, "movers": movers,
          "levels": levels, "budgets": budgets, "boxes": boxes, "predictions": predictions}


def written(text, results):
    for name, write in TABLES.items():
        pattern = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.DOTALL)
        content = "\n".join(write(results)) + "\n"
        text, count = pattern.subn(lambda match: match[1] + content + match[2], text)
        if count != 1:
            sys.exit(f"performance: the document has {count} places for the table '{name}', not one")
    return text


def main(arguments):
    check = arguments[:1] == ["--check"]
    paths = [pathlib.Path(argument) for argument in arguments[check:]]
    if len(paths) > 2 or any(argument.startswith("-") for argument in arguments[check:]):
        print(__doc__, file=sys.stderr)
        return 2
    document, folder = paths + [DOCUMENT, RESULTS][len(paths):]
    before = document.read_text(encoding="utf-8")
    after = written(before, Results(folder))
    if not check:
        document.write_text(after, encoding="utf-8")
        return 0
    wrong = [(i, a, b) for i, (a, b) in enumerate(zip(before.splitlines(), after.splitlines()), 1) if a != b]
    for line, old, new in wrong:
        print(f"{document}:{line}: says\n  {old}\nbut the files say\n  {new}")
    if before != after:
        print("to mend: scripts/performance.py")
    return 0 if before == after else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
