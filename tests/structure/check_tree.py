#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Rules about the source tree that no compiler checks. check_tree_test.py plants the mistakes they must find.

usage: check_tree.py CHECK ROOT [ARGUMENT]
"""

import pathlib
import re
import subprocess
import sys
import textwrap

CODE = {".h", ".cpp"}
SHADERS = {".glsl", ".vert", ".frag", ".comp", ".geom", ".hlsl"}
SOURCES = CODE | SHADERS | {".in", ".cmake", ".py", ".sh"}
NO_GRAPHICS = ("base", "frustum", "rhoctree", "lod", "timing_model", "occlusion_queries", "pipeline", "scenes",
               "baselines")
MAX_README_LINES = 60

GRAPHICS_INCLUDE = re.compile(
    r'^\s*#\s*include\s*[<"]((?:epoxy|gles\d*|gl|egl|glad|glew|glfw|khr|vulkan|d3d\w*|dxgi\w*|rhview/gl)[/.][^>"]*)',
    re.IGNORECASE | re.MULTILINE)
GRAPHICS_NAME = re.compile(
    r"\b(?:gl[A-Z]\w*(?=\s*\()|GL_[A-Z0-9]\w*|GL(?:enum|u?int|sizei|float|boolean|bitfield|sync|u?byte|char)\b"
    r"|epoxy_\w+|egl[A-Z]\w*|EGL\w*|glfw[A-Z]\w*|GLFW\w*|vk[A-Z]\w*(?=\s*\()|Vk[A-Z]\w*|VK_\w+|vulkan\w*"
    r"|ID3D\w+|D3D\w+|d3d\w+|IDXGI\w+|gl(?=::))")
GRAPHICS_PACKAGE = re.compile(r"\b(?:epoxy|EGL|OpenGL|GLEW|glfw3?|Vulkan|rhview_gl)\b|\brhview::gl\b")

COMMENT_OR_LITERAL = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^()\s\\]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'", re.DOTALL)


def tree_files(root, suffixes=None):
    """Files below `root`, without build folders and git's own, in a fixed order."""
    def walk(folder):
        for path in sorted(folder.iterdir()):
            if path.is_symlink():
                continue
            if path.is_dir():
                is_build = (folder == root and path.name.startswith("build")) or (path / "CMakeCache.txt").exists()
                if not is_build and path.name not in (".git", ".cache", "__pycache__"):
                    yield from walk(path)
            elif suffixes is None or path.suffix in suffixes:
                yield path
    return list(walk(root))


def read(path):
    return path.read_text(encoding="utf-8", errors="replace")


def without_comments(text, keep_literals=False):
    """C++ text with comments (and literals) blanked; lines keep their numbers."""
    def blank(match):
        if keep_literals and not match.group().startswith("/"):
            return match.group()
        return "\n" * match.group().count("\n") or " "
    return COMMENT_OR_LITERAL.sub(blank, text)


def matches(pattern, text):
    """(line number, matched text) of every match."""
    for match in pattern.finditer(text):
        found = match.group(1) if pattern.groups else match.group()
        yield text.count("\n", 0, match.end()) + 1, found


def modules(root):
    return [path.parent.name for path in sorted(root.glob("*/CMakeLists.txt")) if "rhview_module(" in read(path)]


def check_graphics_api(root):
    """A graphics API is named in gl, cli and samples only. Comments may speak of it."""
    for folder in NO_GRAPHICS:
        if not (root / folder).is_dir():
            continue
        for path in tree_files(root / folder):
            place = path.relative_to(root)
            found = []
            if path.suffix in SHADERS:
                yield f"{place}: a shader outside gl"
            elif path.suffix in CODE or path.name.endswith(".h.in"):
                text = read(path)
                found += matches(GRAPHICS_INCLUDE, without_comments(text, keep_literals=True))
                found += matches(GRAPHICS_NAME, without_comments(text))
            elif path.name == "CMakeLists.txt" or path.suffix == ".cmake":
                found += matches(GRAPHICS_PACKAGE, re.sub(r"#[^\n]*", "", read(path)))
            for line, name in found:
                yield f"{place}:{line}: '{name}' belongs to a graphics API: only gl, cli and samples may name it"


def check_includes(root):
    """An include of another module names one on a lower floor."""
    floors = {name: int(floor) for name, floor in
              re.findall(r"set\(RHVIEW_FLOOR_(\w+) (\d+)\)", read(root / "cmake/RhviewModule.cmake"))}
    include = re.compile(r'^\s*#\s*include\s*[<"]rhview/(\w+)/', re.MULTILINE)
    for module in modules(root):
        for path in tree_files(root / module, CODE):
            for line, other in matches(include, without_comments(read(path), keep_literals=True)):
                if other != module and floors.get(other, 99) >= floors.get(module, -1):
                    place = path.relative_to(root)
                    yield f"{place}:{line}: {module} may not include {other}: it is not on a lower floor"


def check_readmes(root):
    """Every module has a README.md, a short one."""
    for module in modules(root):
        readme = root / module / "README.md"
        if not readme.exists():
            yield f"{module}/README.md is missing"
        elif (lines := len(read(readme).splitlines())) > MAX_README_LINES:
            yield f"{module}/README.md has {lines} lines, {MAX_README_LINES} are allowed"


def check_spdx(root):
    """Every source begins with its two SPDX lines."""
    for path in tree_files(root):
        if path.suffix in SOURCES or path.parent.name == ".ci":
            head = "\n".join(read(path).splitlines()[:4])
            for tag in ("SPDX-FileCopyrightText: 2026 The rhview authors", "SPDX-License-Identifier: MIT"):
                if tag not in head:
                    yield f"{path.relative_to(root)}: no '{tag}' in its first lines"


def check_shared_folder(root):
    """The folder of test scenes beside the checkout is there for tests and benchmarks only."""
    for path in tree_files(root):
        place = path.relative_to(root)
        if place.parts[0] not in ("tests", "benchmarks", ".ci"):
            for line, name in matches(re.compile(r"\.\./shared"), read(path)):
                yield f"{place}:{line}: '{name}' is not there for users; only tests, benchmarks and .ci may name it"


def check_registered_headers(root, list_file):
    """Every header in a module's include folder is given to rhview_module: else it would not be installed."""
    registered = set(read(pathlib.Path(list_file)).split())
    if not registered:
        yield f"{list_file} names no header"
    for module in sorted({name.split("/")[0] for name in registered}):
        for path in tree_files(root / module / "include", {".h"}):
            if path.relative_to(root).as_posix() not in registered:
                yield f"{path.relative_to(root)}: not among the HEADERS of rhview_module({module})"


# Where the C++ of README.md is from, block after block.
SNIPPET_SAMPLES = ["samples/minimal/main.cpp", "samples/engine_loop/main.cpp"]


def check_readme_snippet(root):
    """The C++ blocks in README.md are the parts of the samples between their [snippet] marks."""
    def normalised(text):
        return "\n".join(line.rstrip() for line in textwrap.dedent(text).strip("\n").splitlines())
    blocks = re.findall(r"^```cpp\n(.*?)^```", read(root / "README.md"), re.DOTALL | re.MULTILINE)
    if len(blocks) != len(SNIPPET_SAMPLES):
        yield f"README.md: {len(blocks)} ```cpp blocks; expected one for each of {', '.join(SNIPPET_SAMPLES)}"
        return
    for block, sample in zip(blocks, SNIPPET_SAMPLES):
        regions = re.findall(r"^[ \t]*// \[snippet\]\n(.*?)^[ \t]*// \[/snippet\]", read(root / sample),
                             re.DOTALL | re.MULTILINE)
        if len(regions) != 1:
            yield f"{sample}: expected one [snippet] … [/snippet] region, found {len(regions)}"
        elif normalised(block) != normalised(regions[0]):
            yield f"README.md: a ```cpp block differs from the [snippet] region of {sample}"


def check_format(root, clang_format):
    """clang-format would change nothing."""
    files = tree_files(root, CODE)
    run = subprocess.run([clang_format, "--dry-run", "-Werror", *map(str, files)], cwd=root, capture_output=True,
                         text=True, check=False)
    if run.returncode != 0:
        yield run.stderr
        wrong = sorted(set(re.findall(r"^(\S+?):\d+:\d+: error", run.stderr, re.MULTILINE)))
        yield f"to mend: {clang_format} -i " + " ".join(wrong)


CHECKS = {name.removeprefix("check_"): check for name, check in list(globals().items()) if name.startswith("check_")}


def main(arguments):
    if len(arguments) < 2 or arguments[0] not in CHECKS:
        print(__doc__, "checks:", ", ".join(CHECKS), file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[1])
    if not (root / "cmake/RhviewModule.cmake").exists() or not modules(root):
        print(f"{root} holds no module of rhview: nothing was checked", file=sys.stderr)
        return 2
    mistakes = list(CHECKS[arguments[0]](root, *arguments[2:]))
    print("\n".join(mistakes) if mistakes else f"{arguments[0]}: nothing wrong")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
