#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Doxygen finds nothing wrong with the public headers, and nothing in them without a comment.

usage: check_reference.py DOXYGEN DOXYFILE FOLDER

Runs Doxygen with that file, into FOLDER. All of its warnings are errors, but for what says itself what it is, since a
comment does not repeat a name: fields of structures, friends, operators, moves, and functions whose body stands in the
line that declares them.
"""

import pathlib
import re
import subprocess
import sys

UNDOCUMENTED = re.compile(r"^(?P<file>[^\n]*?):(?P<line>\d+): .*?Member (?P<name>.*) \((?P<kind>[\w ]+)\) of "
                          r"(?P<of>\w+) .* is not documented\.", re.DOTALL)
MOVE = re.compile(r"&&\s*\w*\)\s*noexcept")
BODY = re.compile(r"\)[^;{]*\{")


def says_itself(warning):
    found = UNDOCUMENTED.match(warning)
    if not found:
        return False
    if found["kind"] == "friend" or (found["kind"] == "variable" and found["of"] in ("struct", "union")):
        return True
    if found["kind"] != "function":
        return False
    declaration = pathlib.Path(found["file"]).read_text(encoding="utf-8").splitlines()[int(found["line"]) - 1]
    # Of a namespace, an inline function is one of the API like any other.
    in_class = found["of"] in ("class", "struct")
    return in_class and bool(MOVE.search(declaration) or BODY.search(declaration) or "operator" in found["name"])


def warnings(doxygen, doxyfile, folder):
    """Every warning, a text each; ends the program where Doxygen made nothing."""
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "warnings.txt"
    settings = doxyfile.read_text(encoding="utf-8") + f'\nOUTPUT_DIRECTORY = "{folder}"\nWARN_LOGFILE = "{log}"\n'
    done = subprocess.run([doxygen, "-"], input=settings, text=True, capture_output=True, check=False)
    if done.returncode != 0 or not (folder / "index.html").exists():
        sys.exit(f"reference: doxygen returned {done.returncode} and made no pages:\n{done.stderr}")
    return [text for text in re.split(r"\n(?=/)", log.read_text(encoding="utf-8").strip()) if text]


def main(arguments):
    if len(arguments) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    wrong = [text for text in warnings(arguments[0], pathlib.Path(arguments[1]), pathlib.Path(arguments[2]))
             if not says_itself(text)]
    print("\n".join(wrong) or "reference: nothing wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
