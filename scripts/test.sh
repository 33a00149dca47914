#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# Installs what is missing, looks through the sources with cppcheck, builds and tests: optimised with warnings as
# errors, then with the sanitizers; then two minutes of fuzzing, and views planned on several threads with the thread sanitizer.
# Stops at the first step that fails; the last lines are CTest's own summary.
#
# usage: scripts/test.sh [--release-only | --asan-only | --fuzz-only | --tsan-only]

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
presets=(ci asan)
fuzz=true
tsan=true
case "${1-}" in
    '') ;;
    --release-only)
        presets=(ci)
        fuzz=false
        tsan=false
        ;;
    --asan-only)
        presets=(asan)
        fuzz=false
        tsan=false
        ;;
    --fuzz-only)
        presets=()
        tsan=false
        ;;
    --tsan-only)
        presets=()
        fuzz=false
        ;;
    *)
        echo "test: unknown option '$1'; usage: scripts/test.sh [--release-only | --asan-only | --fuzz-only | --tsan-only]" >&2
        exit 2
        ;;
esac

phase() { echo "== $* [${SECONDS} s]"; }

phase "setup"
"$root/scripts/setup.sh"

if command -v ccache >/dev/null && [[ -z "${CMAKE_CXX_COMPILER_LAUNCHER-}" ]]; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi

cd "$root"
if [[ -z "${1-}" || "$1" == --release-only ]]; then
    phase "lint: cppcheck"
    scripts/lint.sh --cppcheck
fi
for preset in "${presets[@]}"; do
    phase "$preset: configure"
    cmake --preset "$preset" </dev/null
    phase "$preset: build"
    cmake --build --preset "$preset" </dev/null
    phase "$preset: test"
    ctest --preset "$preset" -j2 --output-on-failure </dev/null
done

if $fuzz; then
    phase "fuzz: 15 seconds of each target"
    scripts/fuzz.sh 15
fi

if $tsan; then
    phase "tsan: build"
    cmake --preset tsan </dev/null
    cmake --build --preset tsan </dev/null
    phase "tsan: views on several threads"
    # One core, so that oneTBB starts no threads: its library is not instrumented, and what it hands over looks like races.
    taskset -c "$(taskset -cp $$ | sed 's/.*: //; s/[-,].*//')" build/tsan/tests/pipeline/rhview_pipeline_tests \
        --gtest_filter='PlanViews*:OcclusionPlanner.two_views*' </dev/null
fi
