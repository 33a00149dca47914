#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# Installs the Debian packages that building and testing rhview need (Debian 12 or newer, or a relative of it).
#
# usage: scripts/setup.sh [--list]
#   --list   print the packages, one a line, and install nothing

set -euo pipefail

packages=(
    # tools
    g++ gcc cmake ninja-build git python3 pkg-config clang-format dpkg-dev groff-base
    # the fuzzer: Clang, its sanitizers and libFuzzer
    clang libclang-rt-dev
    # static analysis
    cppcheck clang-tidy
    # the core
    libglm-dev libtbb-dev libmeshoptimizer-dev libhwy-dev
    # the timing model, to build it only
    libeigen3-dev
    # gl: entry points, contexts without a window, a software renderer, PNG files
    libepoxy-dev libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri libstb-dev
    # scenes
    libtinygltf-dev libtinyobjloader-dev nlohmann-json3-dev
    # the program and text
    libcli11-dev libfmt-dev
    # the viewer, and a display without a screen that it is tested in
    libglfw3-dev libimgui-dev xvfb xauth
    # the samples that drive OGRE and OpenSceneGraph
    libogre-1.12-dev libopenscenegraph-dev
    # tests and benchmarks
    libgtest-dev libbenchmark-dev
    # the reference, made of the headers
    doxygen
    # plots, and a browser that report pages are tested in
    python3-matplotlib chromium
)

fail() {
    echo "setup: $*" >&2
    exit 1
}

is_installed() {
    # One line per architecture; "not-installed" must not match.
    dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -x installed >/dev/null
}

as_root() {
    if [[ "$(id -u)" -eq 0 ]]; then
        "$@"
    else
        sudo -n "$@"
    fi
}

apt() {
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get -q -y -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=120 "$@" </dev/null
}

case "${1-}" in
    '') ;;
    --list)
        printf '%s\n' "${packages[@]}"
        exit 0
        ;;
    *) fail "unknown option '$1'; usage: scripts/setup.sh [--list]" ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    fail "this system has no apt-get; install the equivalents of what 'scripts/setup.sh --list' prints"
fi

missing=()
for package in "${packages[@]}"; do
    is_installed "$package" || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
    echo "setup: nothing to install"
    exit 0
fi

if [[ "$(id -u)" -ne 0 ]] && ! sudo -n true 2>/dev/null; then
    fail "needs root or sudo without a password to install: ${missing[*]}"
fi

echo "setup: updating the package lists"
apt update || fail "apt-get update failed (see above): the network or the package sources are not in order"
echo "setup: installing ${missing[*]}"
apt install --no-install-recommends "${missing[@]}" || fail "apt-get could not install (see above): ${missing[*]}"
echo "setup: done"
