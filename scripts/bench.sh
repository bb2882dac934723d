#!/usr/bin/env bash
# Measures the rows of docs/performance.md. Quote medians and ratios; machines are noisy.
# EMCA_BUILD_DIR: a build with benchmarks (default: build/release).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${EMCA_BUILD_DIR:-build/release}
cmake --build "$build" --target recorder_bench c_recorder_bench layers_bench surface_bench transfer_bench explorer_click_bench scene_bench

medians=(--benchmark_repetitions=9 --benchmark_report_aggregates_only=true)
echo "== recording, per intersection"
"$build/bench/recorder_bench" "${medians[@]}" 2>/dev/null | grep -E 'median|Counters' || true
echo "== recording through C beside C++, per intersection"
"$build/bench/c_recorder_bench" "${medians[@]}" --benchmark_enable_random_interleaving=true 2>/dev/null | grep -E 'median|Counters' || true
echo "== surface layers, per sample"
"$build/bench/surface_bench" 2>/dev/null | grep -E 'threads' || true
echo "== transfer of a pixel, 1024 x 8"
"$build/bench/transfer_bench" "${medians[@]}" 2>/dev/null | grep -E 'median' || true
echo "== click and selection, in the real window"
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1920x1080x24" "$build/bench/explorer_click_bench"
echo "== 3D view"
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1920x1080x24" "$build/bench/scene_bench" 5
echo "== what layers cost a render"
"$build/bench/layers_bench" scenes/cornell-box/scene.xml 16 7
if [ -d "$build/python/emca" ]; then
  echo "== Python: a pixel and a session to arrays"
  cmake --build "$build" --target emca_python emca-render
  PYTHONPATH="$build/python" /usr/bin/python3 python/bench/python_bench.py "$build/bin/emca-render"
fi
