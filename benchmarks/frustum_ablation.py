#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Draws what each technique of frustum culling costs, from the CSV of rhview_frustum_ablation_benchmark.

usage: frustum_ablation.py CSV PICTURE [--objects N]
"""

import argparse
import csv

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)

COLOURS = {"flat": "#4c72b0", "tree": "#dd8452", "hierarchy": "#55a868"}


def read_rows(path, objects):
    """(name, mean µs a frame, worst µs) of the medians for so many objects, slowest first."""
    rows = []
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            name, _, rest = row["name"].partition(f"/{objects}/")
            if rest.endswith("_median"):
                rows.append((name, float(row["us/frame"]), float(row["worst_us"])))
    return sorted(rows, key=lambda row: -row[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("csv")
    parser.add_argument("picture")
    parser.add_argument("--objects", type=int, default=710000)
    arguments = parser.parse_args()
    rows = read_rows(arguments.csv, arguments.objects)
    if not rows:
        parser.error(f"{arguments.csv} has no medians for {arguments.objects} objects")
    names, means, worst = zip(*rows)
    figure, axes = plt.subplots(figsize=(9, 0.24 * len(rows) + 1.2))
    axes.barh(names, means, color=[COLOURS[name.split("/")[0]] for name in names])
    axes.scatter(worst, names, marker="|", color="black", label="worst frame")
    axes.set_xscale("log")
    axes.set_xlabel("µs a frame, culling alone")
    axes.set_title(f"plant, {arguments.objects:,} objects, one path")
    axes.grid(axis="x", which="both", alpha=0.3)
    axes.legend(loc="upper right")
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=110)


if __name__ == "__main__":
    main()
