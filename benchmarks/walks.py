#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Walks scenes with every method and writes one CSV row per scene, method and kind of occlusion culling.

Draw calls and indices are counted and repeat exactly. Times are noisy: the methods are interleaved, every walk is repeated,
and a row holds the median over the repeats of each walk's median frame, with the smallest and largest beside it. Compare
rows of one run only. Every scene is calibrated with first, and all its walks use that profile.
"""

import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

# Method, leaf, and for `rhview` what it asks about: nothing, either way in the same frame, or of earlier frames.
RUNS = [("none", None, ""), ("frustum", None, ""), ("octree", 4096, ""), ("rhview-seed", 4096, ""), ("rhview", None, "off"),
        ("rhview", None, "exact"), ("rhview", None, "latent")]
FIELDS = ["scene", "triangles", "materials", "method", "leaf", "occlusion", "draw_calls_mean", "draw_calls_max", "indices_mean",
          "skipped_indices_mean", "queries_mean", "hidden_fraction_mean", "visible_set_indices_mean", "blocking_reads",
          "prediction_error_median", "prediction_error_p95", "nodes_visited_mean", "build_ms", "cull_ms", "frame_ms", "frame_ms_min", "frame_ms_max", "frame_ms_mean", "missing_pixels",
          "checked_frames", "plan_hash", "frames", "size", "renderer", "timer"]


def walk(program, scene, run, profile, options, check_every):
    method, leaf, occlusion = run
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder) / "walk.json"
        command = [program, "walk", scene, "--method", method, "--json", str(result), "--frames", str(options.frames),
                   "--size", options.size, "--warmup", "2", "--profile", str(profile)]
        if leaf is not None:
            command += ["--leaf", str(leaf)]
        if occlusion:
            command += ["--occlusion", "off"] if occlusion == "off" else ["--mode", occlusion]
        if check_every and method == "rhview":
            command.append("--visible-set")
        if check_every:
            command += ["--check-every", str(check_every)]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
        if done.returncode not in (0, 1):
            sys.exit(f"{' '.join(command)} ended with exit code {done.returncode}")
        return json.loads(result.read_text())


def mean_of(summary, name, digits):
    return "" if summary.get(name) is None else round(summary[name]["mean"], digits)


def row(scene, run, walks):
    method, leaf, occlusion = run
    first = walks[0]
    summary = first["summary"]
    frame_ms = [w["summary"]["frame_ms"]["median"] for w in walks]
    hashes = {w["summary"]["plan_hash"] for w in walks}
    if len(hashes) != 1:
        sys.exit(f"{scene} {method}: plans differ between repeats")
    return {
        "scene": first["scene"]["name"], "triangles": first["scene"]["triangles"],
        "materials": first["scene"]["materials"], "method": method, "leaf": leaf or "", "occlusion": occlusion,
        "draw_calls_mean": round(summary["draw_calls"]["mean"], 1), "draw_calls_max": summary["draw_calls"]["max"],
        "indices_mean": round(summary["indices"]["mean"]),
        "skipped_indices_mean": mean_of(summary, "skipped_indices", None),
        "queries_mean": mean_of(summary, "queries", 1) if occlusion not in ("", "off") else "",
        "hidden_fraction_mean": mean_of(summary, "hidden_fraction", 3),
        "visible_set_indices_mean": mean_of(summary, "visible_set_indices", None),
        "blocking_reads": "" if summary["blocking_reads"] is None else summary["blocking_reads"],
        "prediction_error_median": round(summary["prediction_error"]["median"], 3),
        "prediction_error_p95": round(summary["prediction_error"]["p95"], 3),
        "nodes_visited_mean": round(summary["nodes_visited"]["mean"]),
        "build_ms": "" if first["build"]["ms"] is None else round(statistics.median(w["build"]["ms"] for w in walks)),
        "cull_ms": round(statistics.median(w["summary"]["cull_ms"]["median"] for w in walks), 4),
        "frame_ms": round(statistics.median(frame_ms), 2), "frame_ms_min": round(min(frame_ms), 2),
        "frame_ms_max": round(max(frame_ms), 2),
        "frame_ms_mean": round(statistics.median(w["summary"]["frame_ms"]["mean"] for w in walks), 2), "missing_pixels": summary["missing_pixels"]["total"],
        "checked_frames": summary["missing_pixels"]["checked_frames"], "plan_hash": summary["plan_hash"],
        "frames": first["frames"], "size": "x".join(map(str, first["size"])), "renderer": first["device"]["renderer"],
        "timer": first["device"]["timer"],
    }


def write(output, rows):
    output.parent.mkdir(parents=True, exist_ok=True)
    with output.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="+", help="named scenes or files")
    parser.add_argument("--program", default="build/release/cli/rhview")
    parser.add_argument("--output", required=True)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--size", default="1280x720")
    options = parser.parse_args()

    rows = []
    for scene in options.scenes:
        walks = {run: [] for run in RUNS}
        with tempfile.TemporaryDirectory() as folder:
            profile = pathlib.Path(folder) / "profile.json"
            subprocess.run([options.program, "calibrate", scene, "--size", options.size, "-o", str(profile)],
                           stdout=subprocess.DEVNULL, check=True)
            for repeat in range(options.repeats):
                for run in RUNS:
                    # The first repeat also checks pixels; the timed part of a frame does not hold that work.
                    walks[run].append(walk(options.program, scene, run, profile, options, 5 if repeat == 0 else 0))
                    frame_ms = walks[run][-1]["summary"]["frame_ms"]
                    print(f"{scene} {run[0]} {run[1] or ''} {run[2]} repeat {repeat + 1}: median {frame_ms['median']:.1f}, "
                          f"mean {frame_ms['mean']:.1f} ms", file=sys.stderr)
        rows += [row(scene, run, walks[run]) for run in RUNS]
        write(pathlib.Path(options.output), rows)


if __name__ == "__main__":
    main()
