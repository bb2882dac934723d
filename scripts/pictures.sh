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
  name=${name#[0-9][0-9]-}
  case "$name" in
    history.png | intersection-data.png | parallel-coordinates.png) continue ;;  # on no page, or made by figures.sh
  esac
  cp "$picture" "docs/pictures/$name"
done
