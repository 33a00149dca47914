#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# Static analysis of the modules' sources: cppcheck, and clang-tidy by .clang-tidy with the flags of the preset release.
# Ends with 1 if either finds something. A finding that is wrong is suppressed where it stands, with the reason.
#
# usage: scripts/lint.sh [--cppcheck] [MODULE …]      (both, of all modules; --cppcheck takes seconds, the rest minutes)

set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
programs=(cppcheck clang-tidy)
if [[ "${1-}" == --cppcheck ]]; then
    programs=(cppcheck)
    shift
fi
all=(base frustum lod timing_model scenes occlusion_queries rhoctree pipeline gl baselines capi cli)
modules=("${all[@]}")
if (($# > 0)); then
    modules=("$@")
fi
for program in "${programs[@]}"; do
    if ! command -v "$program" >/dev/null; then
        echo "lint: there is no $program here; install it with apt-get install $program" >&2
        exit 2
    fi
done
includes=()
for module in "${all[@]}"; do
    if [[ -d "$module/include" ]]; then includes+=("-I$module/include"); fi
done
sources=()
for module in "${modules[@]}"; do
    if [[ ! " ${all[*]} " == *" $module "* ]]; then
        echo "lint: '$module' is no module; usage: scripts/lint.sh [--cppcheck] [MODULE …]" >&2
        exit 2
    fi
    sources+=("$module"/src/*.cpp)
done

found=0
echo "== cppcheck: ${#sources[@]} sources [${SECONDS} s]"
# Members that are set in a constructor's body are set there since they need each other; all are small.
cppcheck "${includes[@]}" --std=c++20 --language=c++ --quiet --inline-suppr --enable=warning,performance,portability \
    --suppress=missingIncludeSystem --suppress=useInitializationList --error-exitcode=1 "${sources[@]}" || found=1

if [[ " ${programs[*]} " == *" clang-tidy "* ]]; then
    cmake --preset release </dev/null >/dev/null
    echo "== clang-tidy: ${#sources[@]} sources [${SECONDS} s]"
    printf '%s\0' "${sources[@]}" |
        xargs -0 -P "$(nproc)" -n 2 clang-tidy -p build/release --quiet 2>/dev/null || found=1
fi
echo "== lint: $([[ $found == 0 ]] && echo nothing found || echo see above) [${SECONDS} s]"
exit "$found"
