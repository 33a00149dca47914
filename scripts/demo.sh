#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# Builds the program alone and walks through the town with it, headless: pictures and figures in build/demo.
#
# usage: scripts/demo.sh [options of `rhview walk`, but for --images and --json]

set -euo pipefail

for argument in "$@"; do
    case "$argument" in
        -h | --help)
            sed -n 's/^# usage: /usage: /p' "$0"
            exit 0
            ;;
        --images | --images=* | --json | --json=*)
            echo "demo: the demo decides where its pictures and figures go; run rhview walk for your own" >&2
            exit 2
            ;;
    esac
done

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$root/build/demo"
images="$build/images"
json="$build/walk.json"

given=("$@")
options=(--images "$images" --json "$json")

# The program refuses an option that is given twice.
add_default() {
    local argument
    for argument in "${given[@]}"; do
        [[ "$argument" != "$1" && "$argument" != "$1="* ]] || return 0
    done
    options+=("$@")
}
add_default --frames 120
add_default --size 1280x720
case " $* " in
    *" --check "*) ;;
    *) add_default --check-every 10 ;;
esac

"$root/scripts/setup.sh"
if command -v ccache >/dev/null && [[ -z "${CMAKE_CXX_COMPILER_LAUNCHER-}" ]]; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi

(cd "$root" && cmake --preset release -B "$build" -DRHVIEW_BUILD_TESTS=OFF -DRHVIEW_BUILD_BENCHMARKS=OFF \
    -DRHVIEW_BUILD_SAMPLES=OFF) </dev/null
cmake --build "$build" --target rhview_cli </dev/null

# Nothing of an earlier walk may pass for this one's.
rm -rf "$images" "$json"
status=0
"$build/cli/rhview" walk town "${options[@]}" "$@" </dev/null || status=$?
if [[ $status -ne 0 ]]; then
    echo "demo: the walk ended with exit code $status" >&2
    exit "$status"
fi
echo "demo: pictures in $images, figures in $json"
