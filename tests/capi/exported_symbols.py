#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""The shared library exports the functions of its list, and the header declares them, no more and no fewer.

usage: exported_symbols.py NM LIBRARY HEADER LIST
"""

import pathlib
import re
import subprocess
import sys


def exported(nm_output):
    """Names of `nm -D --defined-only`, without the version nodes and the versions behind the names."""
    fields = [line.split() for line in nm_output.splitlines()]
    return {name.split("@")[0] for *_, kind, name in (line for line in fields if len(line) >= 3) if kind != "A"}


def declared(header):
    return set(re.findall(r"^RHVIEW_API [^;(]*?\b(\w+)\(", header, re.MULTILINE))


def differences(what, names, listed):
    yield from (f"{name}: {what}, but not in the list: a new function bumps RHVIEW_C_API_VERSION and joins the list"
                for name in sorted(names - listed))
    yield from (f"{name}: in the list, but not {what}: removing a function changes the soname"
                for name in sorted(listed - names))


def main(nm, library, header, list_file):
    listed = set(pathlib.Path(list_file).read_text(encoding="utf-8").split())
    output = subprocess.run([nm, "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    wrong = [*differences("exported", exported(output), listed),
             *differences("declared", declared(pathlib.Path(header).read_text(encoding="utf-8")), listed)]
    print("\n".join(wrong) or f"{len(listed)} functions, as listed")
    return 1 if wrong or not listed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
