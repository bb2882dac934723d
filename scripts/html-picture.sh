#!/usr/bin/env bash
# Makes docs/pictures/html-export.png: the page of the firefly's pixel in headless Chromium.
# EMCA_BUILD_DIR: a build (default: build/release).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${EMCA_BUILD_DIR:-build/release}
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$build" --target emca-render emca -j "$(nproc)"
work=$(mktemp -d)
. scripts/serve.sh
trap 'stop_serving; rm -rf "$serve_log" "$work"' EXIT
serve firefly

"$build/bin/emca" render "$address" -o "$work/firefly.exr" --spp 256
"$build/bin/emca" export "$address" 146 97 --spp 256 --html "$work/firefly.html"
mkdir -p docs/pictures
# Blink's number of the dark scheme is 0.
chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --disable-dev-shm-usage --user-data-dir="$work/profile" \
  --window-size=1600,1000 --hide-scrollbars --blink-settings=preferredColorScheme=0 --virtual-time-budget=3000 \
  --screenshot="$PWD/docs/pictures/html-export.png" "file://$work/firefly.html" 2>/dev/null
echo docs/pictures/html-export.png
