#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""How well a timing profile predicts walks it never saw: one CSV row per scene, method and profile.

Each scene is walked by every method, each frame drawn several times (`--repeats`) and its median taken. The constants
come from `rhview calibrate` alone: once for the machine (`machine`), once with the scene's own triangles from random
places (`scene`). `running` is the scene's profile, updated frame by frame. The same walk is predicted by all three.
"""

import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

METHODS = ["none", "frustum", "octree", "rhview-seed", "rhview"]
FIELDS = ["scene", "method", "profile", "frames", "frame_ms", "predicted_ms", "error_median", "error_p95", "bias",
          "hold_out_error", "draw_calls_mean", "indices_mean", "renderer"]
TERMS = {"c1_ns": "indices", "c3_ns": "draw_calls", "sub_draw_ns": "sub_draws", "material_ns": "material_changes",
         "query_ns": "queries", "primitive_ns": "primitives", "fragment_ns": "fragments",
         "passed_sample_ns": "passed_samples"}


def run(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], stdout=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        sys.exit(f"{program} {' '.join(map(str, arguments))} ended with exit code {done.returncode}")


def predict_ms(profile, frame):
    """T of docs/timing-model.md; the program's own prediction is checked against it."""
    side = {"cpu": 0.0, "gpu": 0.0}
    for constant, count in TERMS.items():
        gpu = count in ("indices", "primitives", "fragments", "passed_samples")
        side["gpu" if gpu else "cpu"] += (profile[constant] or 0.0) * frame[count]
    work = side["cpu"] + side["gpu"] if profile["combination"] == "sum" else max(side.values())
    return 1e-6 * (profile["c0_ns"] + work)


def row(walk, name, profile, predicted):
    measured = [f["frame_ms"] for f in walk["per_frame"]]
    errors = sorted(abs(p - m) / m for p, m in zip(predicted, measured))
    summary = walk["summary"]
    return {"scene": walk["scene"]["name"], "method": walk["method"], "profile": name, "frames": len(measured),
            "frame_ms": round(statistics.median(measured), 2), "predicted_ms": round(statistics.median(predicted), 2),
            "error_median": round(statistics.median(errors), 4),
            "error_p95": round(errors[(95 * len(errors) + 99) // 100 - 1], 4),
            "bias": round(statistics.median(p / m for p, m in zip(predicted, measured)), 3),
            "hold_out_error": round(profile["hold_out_error"], 4),
            "draw_calls_mean": round(summary["draw_calls"]["mean"], 1),
            "indices_mean": round(summary["indices"]["mean"]), "renderer": walk["device"]["renderer"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="+", help="named scenes or files")
    parser.add_argument("--program", default="build/release/cli/rhview")
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--frames", type=int, default=24)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--keep", type=pathlib.Path, help="folder to keep profiles and walks in, for scripts/report.py")
    options = parser.parse_args()

    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        machine_file = folder / "machine.json"
        run(options.program, "calibrate", "-o", machine_file)
        machine = json.loads(machine_file.read_text())
        for scene in options.scenes:
            name = pathlib.Path(scene).stem.replace(":", "_")
            scene_file = folder / f"{name}.json"
            run(options.program, "calibrate", scene, "-o", scene_file)
            profile = json.loads(scene_file.read_text())
            for method in METHODS:
                walk_file = folder / f"{name}-{method}.json"
                run(options.program, "walk", scene, "--method", method, "--frames", options.frames, "--warmup", 1,
                    "--repeats", options.repeats, "--profile", scene_file, "--json", walk_file)
                walk = json.loads(walk_file.read_text())
                frames = walk["per_frame"]
                by_scene = [predict_ms(profile, f) for f in frames]
                assert all(abs(p - f["predicted_ms"]) < 1e-6 * p for p, f in zip(by_scene, frames))
                rows += [row(walk, "machine", machine, [predict_ms(machine, f) for f in frames]),
                         row(walk, "scene", profile, by_scene),
                         row(walk, "running", profile, [f["running_predicted_ms"] for f in frames])]
                print(f"{scene} {method}: " + ", ".join(
                    f"{r['profile']} {100 * r['error_median']:.1f}/{100 * r['error_p95']:.1f} %" for r in rows[-3:]),
                    file=sys.stderr)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    with options.output.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
