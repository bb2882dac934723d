"""Measures what docs/performance.md says of Python.

    PYTHONPATH=build/release/python python3 python/bench/python_bench.py build/release/bin/emca-render

Pixel: 2,048 paths with some 9,000 vertices (the goal names 1,024 paths of 8), from the request to all arrays, without the renderer's
own time. Session: a million vertices, from the file to all arrays (the file was just written: it comes from memory).
"""

import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import emca

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


def touch(paths):
    """Every array of a set; no copy of any."""
    vertices = paths.vertices
    arrays = [paths.pixel, paths.sample, paths.part, paths.origin, paths.estimate, paths.first_vertex, vertices.depth, vertices.flags,
              vertices.position, vertices.estimate, vertices.emission, vertices.mesh, vertices.face, vertices.event, vertices.lobe,
              paths.next_events.position, paths.next_events.visible, paths.contributions.value, paths.contributions.mis_weight]
    arrays += [column.values for column in vertices.columns + paths.columns]
    assert not any(array.flags.owndata and array.size for array in arrays)
    return arrays


def pixel(connection, x, y):
    rest, alone, round_trips, own = [], [], [], []
    for _ in range(31):
        begin, used = time.perf_counter(), time.process_time()
        trace = connection.pixel(x, y, spp=2048)
        received = time.perf_counter()
        arrays = touch(trace.paths)
        end = time.perf_counter()
        rest.append(end - begin - trace.render_seconds)
        own.append(time.process_time() - used)
        alone.append(end - received)
        round_trips.append(end - begin)
    print(f"pixel: {len(trace.paths)} paths, {len(trace.paths.vertices)} vertices, {len(arrays)} arrays, "
          f"{sum(a.nbytes for a in arrays) / 1e6:.1f} MB")
    print(f"  request to arrays, without the renderer: median {1e3 * statistics.median(rest):.2f} ms, worst {1e3 * max(rest):.2f} ms "
          f"(with it: {1e3 * statistics.median(round_trips):.2f} ms; arrays alone: {1e3 * statistics.median(alone):.3f} ms; "
          f"processor time here: {1e3 * statistics.median(own):.2f} ms)")


def session(connection, width, height, file):
    connection.render(spp=1)
    spp, traces, total = 64, [], 0
    for y in range(0, height - 15, 16):
        for x in range(0, width - 15, 16):
            if total < 1_000_000:
                traces.append(connection.region((x, y, x + 16, y + 16), spp=spp))
                total += len(traces[-1].paths.vertices)
    emca.save(file, traces=traces)
    times, used = [], []
    for _ in range(7):
        begin, before = time.perf_counter(), time.process_time()
        opened = emca.open(file)
        arrays = [array for trace in opened.traces for array in touch(trace.paths)]
        times.append(time.perf_counter() - begin)
        used.append(time.process_time() - before)
    print(f"session: {sum(len(t.paths) for t in opened.traces)} paths, {total} vertices, {len(opened.traces)} traces, file {os.path.getsize(file) / 1e6:.0f} MB, "
          f"arrays {sum(a.nbytes for a in arrays) / 1e6:.0f} MB")
    print(f"  file to arrays: median {statistics.median(times):.3f} s, worst {max(times):.3f} s; processor time: {statistics.median(used):.3f} s")


def main():
    scene = sys.argv[2] if len(sys.argv) > 2 else "cornell-glass"
    command = [sys.argv[1], str(SCENES / scene / "scene.xml"), "--size", "128x96", "--serve", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            address = next(m.group(1) for line in process.stdout if (m := re.match(r"listening on (\S+)", line)))
            with emca.connect(address) as connection, tempfile.TemporaryDirectory() as folder:
                print(f"scene {scene}; load {os.getloadavg()[0]:.1f}")
                pixel(connection, 64, 60)
                session(connection, 128, 96, os.path.join(folder, "million.emca"))
        finally:
            process.kill()


if __name__ == "__main__":
    main()
