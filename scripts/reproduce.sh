#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# Makes figures of the literature again and writes them beside the published ones: docs/reproduction.md, its picture in
# docs/images, what was measured in build/reproduction. Four minutes on two cores without a GPU, once built.
#
# usage: scripts/reproduce.sh [--quick] [--built FOLDER] [-o FILE]
#
# --quick    small scenes and few frames, only to see that it runs: to build/reproduction/reproduction.md
# --built    where the program and benchmarks are built already, as by the preset release; else they are built
# -o         another file; its picture goes into the folder images beside it

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
results="$root/build/reproduction"
output=""
built=""
quick=()

usage() { sed -n 's/^# usage: /usage: /p' "$0"; }
while [[ $# -gt 0 ]]; do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        --quick) quick=(--quick) ;;
        --built | -o)
            if [[ $# -lt 2 ]]; then
                echo "reproduce: $1 needs a value; $(usage)" >&2
                exit 2
            fi
            if [[ "$1" == -o ]]; then output="$2"; else built="$2"; fi
            shift
            ;;
        *)
            echo "reproduce: unknown option '$1'; $(usage)" >&2
            exit 2
            ;;
    esac
    shift
done

if [[ -z "$output" ]]; then
    output="$root/docs/reproduction.md"
    [[ ${#quick[@]} -eq 0 ]] || output="$results/reproduction.md"
fi
folder="$(dirname "$output")"
[[ "$output" == "$root/docs/reproduction.md" ]] || results="$folder/results"

if [[ -z "$built" ]]; then
    "$root/scripts/setup.sh"
    if command -v ccache >/dev/null && [[ -z "${CMAKE_CXX_COMPILER_LAUNCHER-}" ]]; then
        export CMAKE_CXX_COMPILER_LAUNCHER=ccache
    fi
    built="$root/build/release"
    (cd "$root" && cmake --preset release) </dev/null
    cmake --build "$built" --target rhview_cli rhview_grid_visibility </dev/null
fi

# The interpreter that has matplotlib: a system's package may be for another one than the first in the path.
python=""
for candidate in python3 /usr/bin/python3; do
    if "$candidate" -c "import matplotlib" >/dev/null 2>&1; then
        python="$candidate"
        break
    fi
done
if [[ -z "$python" ]]; then
    echo "reproduce: python3 has no matplotlib; install it (Debian: python3-matplotlib)" >&2
    exit 2
fi

exec "$python" "$root/scripts/reproduce.py" "${quick[@]}" --program "$built/cli/rhview" \
    --grid-program "$built/benchmarks/rhview_grid_visibility" --text "$root/docs/reproduction.md" --results "$results" \
    --figure "$folder/images/reproduction.png" -o "$output"
