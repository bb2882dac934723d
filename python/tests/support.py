"""What the tests share: programs as they were built, and a renderer whose values are known."""

import json
import os
import pathlib
import re
import subprocess
import time

import emca

SOURCE = pathlib.Path(os.environ["EMCA_SOURCE_DIR"])
RENDER = os.environ.get("EMCA_RENDER", "")
CLI = os.environ.get("EMCA_CLI", "")


class ServedScene:
    """emca-render serving a scene, small, until the end of the with statement."""

    def __init__(self, scene="cornell-box", size="32x24", spp=16, *options):
        self._command = [RENDER, str(SOURCE / "scenes" / scene / "scene.xml"), "--size", size, "--spp", str(spp), "--serve", "0", *options]

    def __enter__(self):
        self._process = subprocess.Popen(self._command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in self._process.stdout:
            if match := re.match(r"listening on (\S+)", line):
                return match.group(1)
        raise RuntimeError("emca-render did not start")

    def __exit__(self, *_):
        self._process.kill()
        self._process.wait()
        self._process.stdout.close()


def cli(*arguments):
    """What `emca … --json` says."""
    return json.loads(subprocess.run([CLI, *map(str, arguments)], check=True, capture_output=True, text=True).stdout)


class Known(emca.Renderer):
    """Values that a test can compute: sample s of pixel (x, y) is (x, y, s), at two vertices."""

    size = (8, 6)
    spp = 4

    def info(self):
        return emca.RendererInfo(*self.size, renderer="known", scene="a test", samples_per_pixel=self.spp, seed=7, concurrent=True)

    def camera(self):
        return emca.Camera(position=(1, 2, 3), direction=(0, 0, -2), up=(0, 1, 1), vertical_field_of_view=50)

    def meshes(self):
        return [emca.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], name="triangle", emission=(1, 2, 3))]

    def value(self, pixel, sample):
        return (float(pixel[0]), float(pixel[1]), float(sample))

    def record(self, rec, pixel, sample):
        """May be replaced."""
        rec.set_path_origin((0, 0, 1))
        for depth in (1, 2):
            rec.set_depth_index(depth)
            rec.set_intersection_pos((pixel[0], pixel[1], depth))

    def mean(self, pixel, settings):
        rec = emca.recorder()
        total = [0.0, 0.0, 0.0]
        for sample in range(settings.samples_per_pixel):
            rec.set_path_index(sample)
            self.record(rec, pixel, sample)
            value = self.value(pixel, sample)
            rec.set_final_estimate(value)
            total = [a + b for a, b in zip(total, value)]
        return [t / settings.samples_per_pixel for t in total]

    def render_image(self, settings, monitor):
        width, height = self.size
        return [[self.mean((x, y), settings) for x in range(width)] for y in range(height)]

    def render_pixel(self, pixel, settings, recording, monitor):
        return self.mean(pixel, settings)


class Slow(Known):
    """Renders until it is cancelled; says whether it was."""

    cancelled = False

    def render_image(self, settings, monitor):
        end = time.monotonic() + 30
        while time.monotonic() < end:
            if monitor.cancelled:
                self.cancelled = True
                raise emca.Cancelled()
            monitor.progress(0.5)
            time.sleep(0.005)
        raise RuntimeError("nobody cancelled")


def eventually(condition, seconds=10):
    """Waits for what another thread is about to do."""
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.005)
    return condition()
