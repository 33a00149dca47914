#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""The code of docs/guide.md is one project: it builds against an installed rhview, and does what the guide says.

usage: guide_test.py --guide FILE --work FOLDER --prefix FOLDER --settings FILE --generator NAME
                     [--clang-format PROGRAM] [--xvfb-run PROGRAM]
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
from extract_snippets import blocks, snippets  # noqa: E402

# A renderer that forgets what hangs on queries: the guide's own check has to find it.
FORGETFUL = ("    draw({&range, 1});\n    glEndConditionalRender();", "    (void)range;\n    glEndConditionalRender();")
WARNINGS = "-Wall -Wextra -Wshadow -Wconversion -Wpedantic -Werror"


def fail(sentence):
    sys.exit(f"guide: {sentence}")


def run(command, code=0):
    # The display may fail where the program did not, as when another one goes down at the same time: then once more.
    for _ in range(2):
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=400)
        if "xvfb-run: error" not in done.stdout + done.stderr:
            break
    if done.returncode != code:
        fail(f"'{' '.join(map(str, command))}' returned {done.returncode}, not {code}:\n{done.stdout}{done.stderr}")
    return done.stdout


def write_project(guide, folder):
    files, mistakes = snippets(guide)
    if mistakes:
        fail("\n".join(mistakes))
    if files["opengl_renderer.cpp"].count(FORGETFUL[0]) != 1:
        fail("opengl_renderer.cpp has no longer the lines that the forgetful renderer lacks")
    files["forgetful_renderer.cpp"] = files["opengl_renderer.cpp"].replace(*FORGETFUL)
    files["CMakeLists.txt"] += ("add_executable(forgetful engine.cpp forgetful_renderer.cpp)\n"
                                "target_link_libraries(forgetful PRIVATE rhview::rhview glfw PkgConfig::epoxy)\n")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, content in files.items():
        (folder / name).write_text(content, encoding="utf-8")
    return files


def check_format(clang_format, style, folder, files):
    shutil.copy(style, folder / ".clang-format")
    sources = [folder / name for name in files if name.endswith((".h", ".cpp"))]
    run([clang_format, "--dry-run", "-Werror", *sources])


def check_outputs(guide, build):
    told = [(name, content) for language, name, content, _ in blocks(guide.read_text(encoding="utf-8"))
            if language == "text"]
    if len(told) < 3:
        fail(f"{guide} tells the output of {len(told)} programs, expected of first, more and first_c")
    for name, content in told:
        printed = run([build / name])
        if printed != content:
            fail(f"the guide says that {name} prints\n{content}but it prints\n{printed}")


def check_windows(xvfb_run, build):
    def in_window(*command, code=0):
        return run([xvfb_run, "-a", "-s", "-screen 0 1400x900x24", *command], code)

    drawn = in_window(build / "window", 12)
    found = re.search(r"(\d+) of (\d+) indices in (\d+) draw calls at once; (\d+) hang on (\d+) queries", drawn)
    if not found or not 0 < int(found[1]) < int(found[2]) or int(found[3]) == 0 or int(found[5]) == 0:
        fail(f"window culls nothing, or asks nothing: {drawn}")
    checked = in_window(build / "engine", 12, "check")
    found = re.search(r"(\d+) draws at once, (\d+) behind (\d+) queries\n0 missing pixels in 12 frames", checked)
    if not found or 0 in map(int, found.groups()):
        fail(f"engine loses pixels, or asks nothing: {checked}")
    plain = in_window(build / "engine", 4, "check", "plain")
    if not re.search(r"[1-9]\d* draws at once, 0 behind 0 queries\n0 missing pixels in 4 frames", plain):
        fail(f"engine without queries: {plain}")
    lost = in_window(build / "forgetful", 12, "check", code=1)
    if not re.search(r"[1-9]\d* missing pixels", lost):
        fail(f"a renderer that draws nothing behind queries passed the check: {lost}")


def main():
    parser = argparse.ArgumentParser()
    for name in ("guide", "work", "prefix", "settings"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    parser.add_argument("--generator", required=True)
    parser.add_argument("--clang-format")
    parser.add_argument("--xvfb-run")
    options = parser.parse_args()
    os.environ["XDG_CACHE_HOME"] = str(options.work / "cache")

    source, build = options.work / "first", options.work / "build"
    files = write_project(options.guide, source)
    if options.clang_format:
        check_format(options.clang_format, options.guide.parent.parent / ".clang-format", source, files)
    shutil.rmtree(build, ignore_errors=True)
    run(["cmake", "-S", source, "-B", build, "-G", options.generator, "-C", options.settings,
         f"-Drhview_ROOT={options.prefix}", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS={WARNINGS}"])
    run(["cmake", "--build", build, "--parallel", "2"])
    check_outputs(options.guide, build)
    if options.xvfb_run:
        check_windows(options.xvfb_run, build)
    else:
        print("guide: the programs with windows were built and not run: there is no xvfb-run (xvfb, xauth)")


if __name__ == "__main__":
    main()
