#!/usr/bin/env bash
# Makes the pictures of README.md and docs/ anew: the tour off screen, in both themes.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/demo.sh --off-screen --theme light
mkdir -p docs/pictures
cp demo-output/01-window.png docs/pictures/window-light.png
scripts/demo.sh --off-screen --theme dark
for picture in demo-output/[0-9][0-9]-*.png; do
  name=$(basename "$picture")
  [ "$name" != 11-history.png ] || continue  # on no page
  cp "$picture" "docs/pictures/${name#[0-9][0-9]-}"
done
