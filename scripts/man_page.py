#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Writes the manual page of the program from what its own --help says, so that it can't be out of date.

usage: scripts/man_page.py PROGRAM OUTPUT
"""

import pathlib
import re
import subprocess
import sys

ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")

EXIT_STATUS = [("0", "Done."),
               ("1", "A check failed: with --check, a pixel was missing in exact mode."),
               ("2", "Bad usage or input: one sentence on standard error names the file or option, and the mend.")]

FILES = [("$XDG_CACHE_HOME/rhview, else ~/.cache/rhview",
          "The timing constants that calibrate saved, by device and scene.")]


def help_of(program, *verb):
    return subprocess.run([program, *verb, "--help"], check=True, capture_output=True, encoding="utf-8").stdout


def parse(text):
    """(description, usage, {section: [(entry, its text)]}) of a help text."""
    description, usage, sections, section = "", "", {}, None
    for line in text.splitlines():
        if line.startswith("Usage: "):
            usage = line.removeprefix("Usage: ")
        elif line.endswith(":") and not line.startswith(" "):
            section = sections.setdefault(line[:-1], [])
        elif not line.strip():
            continue
        elif section is None:
            description = f"{description} {line}".strip()
        elif re.match(r" {10,}\S", line) and section:
            section[-1] = (section[-1][0], f"{section[-1][1]} {line.strip()}".strip())
        elif entry := ENTRY.match(line):
            section.append((entry.group(1), entry.group(2) or ""))
        else:
            raise ValueError(f"the help has a line of unknown form: '{line}'")
    return description, usage, sections


def escaped(text):
    """Text for troff: hyphens stay hyphens that can be copied, no line is taken for a request."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def entries(pairs):
    for name, text in pairs:
        yield from (".TP", f".B {escaped(name)}", escaped(text) or "\\&")


def page(program):
    about, usage, sections = parse(help_of(program))
    version = subprocess.run([program, "--version"], check=True, capture_output=True, encoding="utf-8").stdout.strip()
    name, _, what = about.partition(": ")
    lines = ['.\\" SPDX-FileCopyrightText: 2026 The rhview authors', '.\\" SPDX-License-Identifier: MIT',
             f'.\\" Written by scripts/man_page.py from {name} --help.',
             f'.TH {name.upper()} 1 "" "{name} {version}" "User Commands"',
             ".SH NAME", f"{name} \\- {escaped(what)}", ".SH SYNOPSIS", f".B {escaped(usage)}"]
    for section, pairs in sections.items():
        lines += [f".SH {section.upper()}", *entries(pairs)]
    for verb, _ in sections["Subcommands"]:
        what, usage, parts = parse(help_of(program, verb))
        lines += [f".SH {name.upper()} {verb.upper()}", escaped(what) + ".", ".PP", f".B {escaped(usage)}"]
        for pairs in parts.values():
            lines += entries(pair for pair in pairs if not pair[0].startswith("-h,"))
    lines += [".SH EXIT STATUS", *entries(EXIT_STATUS), ".SH FILES", *entries(FILES), ".SH SEE ALSO",
              "The guide, and the library's reference, are in the project's docs folder."]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    pathlib.Path(sys.argv[2]).write_text(page(sys.argv[1]), encoding="utf-8")
