#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Writes the code blocks of a Markdown file that name a file (```cpp main.cpp) to files of those names.

usage: extract_snippets.py MARKDOWN FOLDER

Blocks of one name are joined in their order. A block of C, C++ or CMake without a name is an error: it would be
compiled by nobody. ```text blocks are expected output and are not written.
"""

import pathlib
import re
import sys

COMPILED = ("c", "cpp", "cmake")
BLOCK = re.compile(r"^```(\w*)[ ]*([^\n]*)\n(.*?)^```[ ]*$", re.DOTALL | re.MULTILINE)


def blocks(text):
    """(language, name, content, line) of every fenced block."""
    return [(match[1], match[2].strip(), match[3], text.count("\n", 0, match.start()) + 1)
            for match in BLOCK.finditer(text)]


def snippets(markdown):
    """{file name: content} of the blocks that name one; the mistakes found."""
    files, mistakes = {}, []
    for language, name, content, line in blocks(markdown.read_text(encoding="utf-8")):
        if language not in COMPILED:
            continue
        if not re.fullmatch(r"[\w.-]+", name):
            mistakes.append(f"{markdown}:{line}: a {language} block names no file: nobody compiles it")
        else:
            files[name] = files.get(name, "") + content
    return files, mistakes


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    files, mistakes = snippets(pathlib.Path(arguments[0]))
    if mistakes or not files:
        print("\n".join(mistakes) or f"{arguments[0]}: no block names a file", file=sys.stderr)
        return 1
    folder = pathlib.Path(arguments[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        (folder / name).write_text(content, encoding="utf-8")
        print(name)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
