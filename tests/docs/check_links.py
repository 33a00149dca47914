#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Every relative link of the Markdown files leads to a file of the tree, and to a heading of it.

usage: check_links.py ROOT
"""

import pathlib
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.DOTALL | re.MULTILINE)
HEADING = re.compile(r"^#+ +(.*?) *$", re.MULTILINE)


def markdown_files(root):
    return [path for path in sorted(root.rglob("*.md"))
            if not any(part.startswith(("build", ".")) for part in path.relative_to(root).parts)]


def anchors(text):
    """Those that a forge makes of the headings: lower case, spaces to dashes, no other marks; the second of a name has -1."""
    seen, found = {}, set()
    without_blocks = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    for heading in HEADING.findall(without_blocks):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        count = seen.get(name, 0)
        seen[name] = count + 1
        found.add(f"{name}-{count}" if count else name)
    return found


def broken_links(root):
    for file in markdown_files(root):
        text = file.read_text(encoding="utf-8")
        blanked = CODE.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
        for match in LINK.finditer(blanked):
            target, _, anchor = match[1].partition("#")
            place = f"{file.relative_to(root)}:{text.count(chr(10), 0, match.start()) + 1}"
            if re.match(r"[a-z]+:", target):
                continue
            path = (file.parent / target).resolve() if target else file
            if not path.exists() or root.resolve() not in (path.resolve(), *path.resolve().parents):
                yield f"{place}: there is no '{target}'"
            elif anchor and (path.suffix != ".md" or anchor not in anchors(path.read_text(encoding="utf-8"))):
                yield f"{place}: '{target or file.name}' has no heading '#{anchor}'"


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[0])
    if not markdown_files(root):
        print(f"{root} has no Markdown file: nothing was checked", file=sys.stderr)
        return 2
    broken = list(broken_links(root))
    print("\n".join(broken) or "no broken link")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
