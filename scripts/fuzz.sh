#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# Builds the fuzzers with Clang and runs each for as long as told, one after the other; what one finds ends the script
# and stays in build/fuzz. The last lines of each give its executions.
#
# usage: scripts/fuzz.sh [SECONDS [TARGET …]]      (600 seconds each of all: rho profile path scene_parameters obj ply gltf c_api)

set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds="${1-600}"
if [[ ! "$seconds" =~ ^[1-9][0-9]*$ ]]; then
    echo "fuzz: '$seconds' is no number of seconds; usage: scripts/fuzz.sh [SECONDS [TARGET …]]" >&2
    exit 2
fi
targets=(rho profile path scene_parameters obj ply gltf c_api)
if (($# > 1)); then
    targets=("${@:2}")
fi

cmake --preset fuzz </dev/null
cmake --build --preset fuzz </dev/null
cd build/fuzz
programs="$PWD/tests/fuzz"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
for target in "${targets[@]}"; do
    echo "== fuzz: $target, $seconds seconds"
    corpus="$PWD/corpus/$target"
    rm -rf "$corpus"
    mkdir -p "$corpus"
    most=4096
    if [[ "$target" == rho ]]; then
        most=262144
        "$programs/rhview_rho_corpus" "$corpus" </dev/null
    else
        "$programs/rhview_${target}_fuzzer" --seeds "$corpus" </dev/null
    fi
    TMPDIR="$scratch" ASAN_OPTIONS=detect_leaks=0 "$programs/rhview_${target}_fuzzer" "-max_total_time=$seconds" \
        "-max_len=$most" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 "$corpus" </dev/null
done
