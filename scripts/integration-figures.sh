#!/usr/bin/env bash
# The pictures of docs/integrations/: of the explorer on a renderer that its page told how to serve.
#   scripts/integration-figures.sh NAME HOST:PORT
# NAME: mitsuba06 (emcapath on veach-ajar, 320 x 180), pbrt4 (emcapath on integrations/pbrt4/scenes/room.pbrt), lajolla and
# lajolla-emcapath (these integrators on its scenes/cbox/cbox.xml), nori, emca2021. EMCA_BUILD_DIR: a build (default: build/release).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${EMCA_BUILD_DIR:-build/release}
name=${1:?which renderer} address=${2:?HOST:PORT}
settings=$(mktemp) tour=$(mktemp -d)
trap 'rm -rf "$settings" "$tour"' EXIT

explorer() {
  : > "$settings"
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1920x1080x24" "$build/bin/emca-explorer" "$address" --size 1920x1080 \
    --theme dark --settings "$settings" "$@"
}

# picture NAME [option of emca-explorer…]: the window
picture() {
  explorer --screenshot "docs/pictures/integrations/$1.png" "${@:2}"
  echo "docs/pictures/integrations/$1.png"
}

# striking NAME [option of emca-explorer…]: the window with the most striking path of the pixel selected
striking() {
  explorer --tour "$tour" "${@:2}"
  mv "$tour/01-window.png" "docs/pictures/integrations/$1.png"
  echo "docs/pictures/integrations/$1.png"
}

probe=(--front plugin-light-probe,surfaces)
case $name in
  mitsuba06)
    picture mitsuba06 --spp 16 --pixel firefly
    striking mitsuba06-layer-and-probe --spp 256 --pixel 125,80 --layers "reflected radiance" --layer-exposure -2 "${probe[@]}" ;;
  pbrt4)
    striking pbrt4 --spp 64 --pixel 84,120 --layers "reflected radiance,next-event density,throughput" --layer-exposure 1 "${probe[@]}" ;;
  lajolla)
    picture lajolla --spp 16 --pixel 330,390 --layers "intersection density,next-event density,shadowed light samples" \
      --show-layer "shadowed light samples" --front surfaces ;;
  lajolla-emcapath)
    striking lajolla-layer-and-probe --spp 64 --pixel 330,390 --layers "reflected radiance" --layer-exposure 2 "${probe[@]}" ;;
  nori)
    picture nori --spp 8 --pixel 100,90 --layers "intersection density,shadowed tests" --show-layer "shadowed tests" --front surfaces
    striking nori-layer-and-probe --spp 1 --pixel 170,100 --layers "shadowed tests" "${probe[@]}" ;;
  emca2021)
    picture emca2021 --spp 32 --pixel firefly --layers all --show-layer "published heat map (number)" --layer-map viridis \
      --layer-percentiles 2,90 --eye 0.35,1.05,4.3 --target 0,1,0 ;;
  *) echo "integration-figures.sh: no pictures for $name" >&2; exit 2 ;;
esac
