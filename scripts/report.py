#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Plots what was predicted against what was measured, for walks (`rhview walk --json`) and calibrations (`--csv`);
makes the page of a comparison (`rhview compare --json`), which needs no matplotlib.

usage: scripts/report.py FILE… -o FOLDER [--front]

Writes prediction.png (predicted against measured, one colour per file) and residuals.png (the relative residual of every
frame, and against indices), and prints a line per file: median and 95th percentile of |predicted - measured| / measured.
Of a comparison, one file alone: report.html, with the picture of FOLDER/scene if there is one; with --front also
front.png, cost against the picture's error, of what `rhview compare --pareto` wrote.
"""

import argparse
import csv
import json
import pathlib
import sys

import report_page

plt = None  # matplotlib.pyplot, once a plot is wanted


def load_matplotlib():
    global plt
    try:
        import matplotlib
        matplotlib.use("Agg")  # before pyplot: no window
        import matplotlib.pyplot
    except ImportError:
        sys.exit(f"report: {sys.executable} has no matplotlib; install it (Debian: python3-matplotlib, for "
                 "/usr/bin/python3)")
    plt = matplotlib.pyplot


class Frames:
    """The frames of one file: measured and predicted milliseconds, indices."""

    def __init__(self, name, measured, predicted, indices):
        self.name, self.measured, self.predicted, self.indices = name, measured, predicted, indices

    def residuals(self):
        return [(p - m) / m for p, m in zip(self.predicted, self.measured)]

    def errors(self):
        """Median and 95th percentile (nearest rank) of the magnitude, as the walk reports them."""
        ordered = sorted(abs(r) for r in self.residuals())
        count = len(ordered)
        median = 0.5 * (ordered[(count - 1) // 2] + ordered[count // 2])
        return median, ordered[(95 * count + 99) // 100 - 1]


def frames_of_walk(file):
    walk = json.loads(file.read_text(encoding="utf-8"))
    if walk.get("schema") != "rhview.walk/1":
        sys.exit(f"{file}: its schema is not rhview.walk/1; name a file written by rhview walk --json")
    frames = [f for f in walk["per_frame"] if f["predicted_ms"] is not None]
    if not frames:
        sys.exit(f"{file}: no frame was predicted; walk again with timing constants")
    return Frames(f"{walk['scene']['name']}, {walk['method']}", [f["frame_ms"] for f in frames],
                  [f["predicted_ms"] for f in frames], [f["indices"] for f in frames])


def frames_of_calibration(file):
    with file.open(newline="", encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    if not rows or "predicted_ns" not in rows[0]:
        sys.exit(f"{file}: has no column predicted_ns; name a file written by rhview calibrate --csv")
    return Frames(f"calibration {file.stem}", [1e-6 * float(r["frame_ns"]) for r in rows],
                  [1e-6 * float(r["predicted_ns"]) for r in rows], [float(r["indices"]) for r in rows])


def read(file):
    try:
        return frames_of_calibration(file) if file.suffix == ".csv" else frames_of_walk(file)
    except (OSError, json.JSONDecodeError, KeyError, UnicodeDecodeError) as problem:
        sys.exit(f"{file}: can't be read ({problem})")


def colours_of(runs):
    """One for each run, far apart in hue."""
    return [plt.get_cmap("turbo")((i + 0.5) / len(runs)) for i in range(len(runs))]


def plot_prediction(runs, file):
    figure, axes = plt.subplots(figsize=(7, 6))
    for run, colour in zip(runs, colours_of(runs)):
        axes.scatter(run.measured, run.predicted, s=12, alpha=0.8, color=colour, label=run.name)
    low = min(min(r.measured + r.predicted) for r in runs)
    high = max(max(r.measured + r.predicted) for r in runs)
    axes.plot([low, high], [low, high], color="black", linewidth=1, label="equal")
    for share in (0.85, 1.15):
        axes.plot([low, high], [share * low, share * high], color="grey", linewidth=0.7, linestyle="--",
                  label="± 15 %" if share < 1 else None)
    axes.set(xscale="log", yscale="log", xlabel="measured, ms", ylabel="predicted, ms",
             title="Frame times, predicted and measured")
    axes.legend(fontsize="x-small")
    figure.tight_layout()
    figure.savefig(file, dpi=110)
    plt.close(figure)


def plot_residuals(runs, file):
    figure, (by_frame, by_size) = plt.subplots(1, 2, figsize=(11, 5), sharey=True)
    for run, colour in zip(runs, colours_of(runs)):
        percent = [100 * r for r in run.residuals()]
        by_frame.plot(range(len(percent)), percent, marker=".", linewidth=0.7, color=colour, label=run.name)
        by_size.scatter([max(1, i) for i in run.indices], percent, s=12, alpha=0.8, color=colour)
    for axes in (by_frame, by_size):
        axes.axhline(0, color="black", linewidth=1)
        axes.axhspan(-15, 15, color="grey", alpha=0.15)
    by_frame.set(xlabel="frame", ylabel="(predicted - measured) / measured, %", title="along the walk")
    by_size.set(xscale="log", xlabel="indices", title="by size; grey: ± 15 %")
    by_frame.legend(fontsize="x-small")
    figure.tight_layout()
    figure.savefig(file, dpi=110)
    plt.close(figure)


def read_comparison(file):
    """The comparison in a file, or nothing if it is something else."""
    if file.suffix == ".csv":
        return None
    try:
        page = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, json.JSONDecodeError, UnicodeDecodeError) as problem:
        sys.exit(f"{file}: can't be read ({problem})")
    return page if isinstance(page, dict) and page.get("schema") == "rhview.compare/1" else None


def write_page(page, file, folder):
    try:
        text = report_page.page_of(page, folder)
    except (KeyError, TypeError, IndexError) as problem:
        sys.exit(f"{file}: lacks what a comparison has ({problem!r}); write it with rhview compare --json")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.html").write_text(text, encoding="utf-8")
    print(f"{folder / 'report.html'}: {len(page['runs'])} methods")


def plot_front(page, file, target):
    if not page.get("pareto"):
        sys.exit(f"{file}: tells no front; write it with rhview compare --pareto")
    load_matplotlib()
    figure, all_axes = plt.subplots(1, len(report_page.FRONTS), figsize=(15, 5))
    for axes, (field, unit) in zip(all_axes, report_page.FRONTS):
        points, front = report_page.front_points(page, field)
        positive = [p[2] for p in points if p[2] > report_page.ErrorAxis.NONE]
        axes.plot([p[2] for p in front], [p[3] for p in front], color="grey", linewidth=1, linestyle="--")
        for number, label, error, cost in points:
            axes.scatter(error, cost, s=28, color=plt.get_cmap("turbo")((number + 0.5) / len(page["runs"])), label=label)
        axes.set_xscale("symlog", linthresh=min(positive, default=1.0))
        axes.set(xlabel="1 - SSIM, against everything at full detail", ylabel=unit, ylim=(0, None))
    all_axes[-1].legend(fontsize="xx-small")
    figure.suptitle(f"{page['runs'][0]['scene']['name']}: speed against error")
    figure.tight_layout()
    figure.savefig(target, dpi=110)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("files", nargs="+", type=pathlib.Path, metavar="FILE",
                        help="walk JSON or calibration CSV (by its ending), or the JSON of one comparison")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, metavar="FOLDER")
    parser.add_argument("--front", action="store_true", help="of a comparison: front.png, cost against error")
    options = parser.parse_args()
    comparison = read_comparison(options.files[0]) if len(options.files) == 1 else None
    if comparison is not None:
        write_page(comparison, options.files[0], options.output)
        if options.front:
            plot_front(comparison, options.files[0], options.output / "front.png")
        return
    if options.front:
        sys.exit("report: --front wants the JSON of one comparison")
    load_matplotlib()
    runs = [read(file) for file in options.files]
    options.output.mkdir(parents=True, exist_ok=True)
    plot_prediction(runs, options.output / "prediction.png")
    plot_residuals(runs, options.output / "residuals.png")
    for run in runs:
        median, p95 = run.errors()
        print(f"{run.name}: {len(run.measured)} frames, off by {100 * median:.1f} % in the median, "
              f"{100 * p95:.1f} % at p95")


if __name__ == "__main__":
    main()
