#!/usr/bin/env bash
# The tour of EMCA: installs what is missing, builds, renders scenes/firefly and opens the explorer on a firefly with its
# outlier path selected. Without a display the same tour runs off screen and leaves its pictures, and a page that tells
# the story, in demo-output/. Works as the first command on a bare Debian 12.
#   --off-screen   pictures even where there is a display
#   --theme dark|light
# EMCA_BUILD_DIR: where to build (default: build/release).
set -euo pipefail
cd "$(dirname "$0")/.."

off_screen=0
theme=dark
pixel=146,97  # a firefly on the paperweight, at the scene's own size and seed
while [ $# -gt 0 ]; do
  case "$1" in
    --off-screen) off_screen=1 ;;
    --theme) theme=${2:?--theme needs dark or light}; shift ;;
    *) echo "demo.sh: unknown option $1 (there are --off-screen and --theme dark|light)" >&2; exit 2 ;;
  esac
  shift
done
[ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] || off_screen=1

scripts/install-deps.sh
build=${EMCA_BUILD_DIR:-build/release}
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$build" --target emca-render emca emca-explorer -j "$(nproc)"

. scripts/serve.sh
serve firefly

if [ "$off_screen" -eq 1 ]; then
  rm -rf demo-output
  mkdir -p demo-output
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1920x1080x24" \
    "$build/bin/emca-explorer" "$address" --pixel "$pixel" --tour demo-output --theme "$theme"
  echo "The tour is in demo-output/: begin with demo-output/index.md"
else
  "$build/bin/emca-explorer" "$address" --pixel "$pixel" --theme "$theme"
fi
