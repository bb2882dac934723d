#!/usr/bin/env bash
# Rebuilds Figures 2, 9, 10 and 11 of the EMCA paper from our own scenes, off screen, into docs/pictures/, and the pictures
# of every view in docs/explorer/pictures/. (That of the example plugin comes with the plugin.)
# EMCA_BUILD_DIR: a build (default: build/release).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${EMCA_BUILD_DIR:-build/release}
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$build" --target emca-render emca-explorer explorer_gallery emca-plugin-probe intersection-data light-probe -j "$(nproc)"
mkdir -p docs/pictures
. scripts/serve.sh
settings=$serve_log.settings

# picture NAME LAYER [option of emca-explorer…]: the 3D view with the layer's colour bar
picture() {
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1920x1080x24" "$build/bin/emca-explorer" "$address" \
    --only scene --size 960x720 --theme dark --settings "$settings" --layers "$2" --show-layer "$2" --opacity 1 \
    --screenshot "docs/pictures/$1.png" "${@:3}"
  rm -f "$settings"
  echo "docs/pictures/$1.png"
}

serve light-sampling-bug -D bug=false
picture figure-2-mis-weight "MIS weight" --spp 256 --paths 0 --eye 0.9,0.9,-5.5 --target 3.2,3.6,3.0 --fov 50
serve cornell-glass
picture figure-2-invalid-directions "invalid directions" --spp 256 --paths 0 --layer-log

below=(--spp 64 --paths 0 --layer-range 0,8e6 --eye 2.78,2.2,1.4 --target 2.78,5.48,3.0 --fov 50)
serve light-sampling-bug
picture figure-9-light "next-event density" "${below[@]}"
serve light-sampling-bug -D bug=false
picture figure-9-light-correct "next-event density" "${below[@]}"

aside=(--spp 256 --paths 0 --eye 0.9,4.6,-5.5 --target 3.2,2.0,3.0 --fov 50)
serve cornell-box
picture figure-10-reflected-radiance "reflected radiance" "${aside[@]}"
picture figure-10-image-contribution "image contribution" "${aside[@]}"

serve door-ajar
picture figure-11-intersections "intersection density" --spp 64 --paths 0 --layer-log
picture figure-11-from-above "intersection density" --spp 64 --paths 0 --layer-log --eye -4.5,9.5,-7 --target 0.2,0.6,0.4 --fov 45

serve firefly
mkdir -p docs/explorer/pictures
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1920x1080x24" "$build/bin/explorer_gallery" "$address" docs/explorer/pictures 146,97
