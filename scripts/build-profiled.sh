#!/usr/bin/env bash
# Builds emca-render once more, as fast as the compiler can make it: with a profile of how the scenes of this repository
# are rendered, for this machine's processor (-march=native), and with optimisation across files. Images stay equal, bit
# by bit, which is checked.
#   scripts/build-profiled.sh [FOLDER]     default: build/profiled; the program is FOLDER/bin/emca-render
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/profiled}
program=$build/bin/emca-render
images=$build/profile-images

compile() {  # compile generate|use
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-march=native -DEMCA_PROFILE="$1" -DEMCA_BUILD_TESTS=OFF \
    -DEMCA_BUILD_BENCH=OFF >"$build/configure.log" || { cat "$build/configure.log" >&2; exit 1; }
  cmake --build "$build" --target emca-render
}
render() {  # render FOLDER: small images, one thread, so that the counts are exact
  mkdir -p "$1"
  for scene in scenes/*/scene.xml; do
    "$program" "$scene" --spp 16 --size 96x96 --threads 1 -o "$1/$(basename "$(dirname "$scene")").exr" >/dev/null
  done
}

mkdir -p "$build"
find "$build" -name '*.gcda' -delete
compile generate
render "$images/counted"
compile use
render "$images/profiled"
for image in "$images"/counted/*.exr; do
  cmp "$image" "$images/profiled/$(basename "$image")" ||
    { echo "The profiled build renders other bits: please report it, and use the build without profile." >&2; exit 1; }
done
echo "$program is ready; its images equal those of the build that made the profile, bit by bit."
