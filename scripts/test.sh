#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test. Works as the first command on a bare Debian 12.
# EMCA_BUILD_DIR: where to build (default: build/release).
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-deps.sh
build=${EMCA_BUILD_DIR:-build/release}
jobs=$(nproc)

echo "== configure"
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DEMCA_BUILD_TESTS=ON
echo "== build"
cmake --build "$build" -j "$jobs"
echo "== test"
# Programs of tests without a display bring their own virtual one.
ctest --test-dir "$build" --output-on-failure --no-tests=error -j "$jobs"
