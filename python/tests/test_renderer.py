"""Renderers in Python: what they say arrives, what they raise becomes an error, and nothing ever hangs."""

import gc
import logging
import pathlib
import subprocess
import sys
import textwrap
import threading
import time
import unittest
import weakref

import numpy as np

import emca
from support import Known, Slow, eventually


def quiet():
    logging.getLogger("emca").setLevel(logging.CRITICAL)


class Recorder(unittest.TestCase):
    def record(self, record):
        """What one pixel's path brings, recorded by a function of the recorder."""
        class One(Known):
            spp = 1
            def record(self, rec, pixel, sample):
                record(rec)
        with emca.serve(One()) as server, emca.connect(server.address) as connection:
            trace = connection.pixel(1, 1)
            return trace.paths, trace

    def test_every_call(self):
        def record(rec):
            rec.set_path_origin((1, 2, 3))
            rec.set_depth_index(1)
            rec.set_intersection_pos(np.array([4, 5, 6.5]))
            rec.set_intersection_surface(2, 7)
            rec.set_intersection_event(emca.Event.transmit, emca.Lobe.glossy, "glass")
            rec.set_intersection_estimate([1, 2, 3])
            rec.set_intersection_emission(0.5)
            rec.set_next_event_estimation_pos((7, 8, 9), True)
            rec.set_next_event_estimation_pos((7, 8, 10), False)
            rec.add_contribution((1, 0, 0), "light sampling", 0.25, "connected")
            rec.add_contribution(lambda: (0, 1, 0), "BSDF sampling")
            rec.set_depth_index(2)
            rec.set_intersection_pos_envmap((0, 100, 0))
            rec.set_intersection_event("background")
            rec.set_depth_index(1, "light")
            rec.add_splat((1, 1), (1, 2, 3))
        paths, trace = self.record(record)
        vertices = paths.vertices
        np.testing.assert_array_equal(paths.origin, [(1, 2, 3)])
        np.testing.assert_array_equal(vertices.depth, [1, 2, 1])
        np.testing.assert_array_equal(vertices.on_light_subpath, [False, False, True])
        np.testing.assert_array_equal(vertices.is_environment, [False, True, False])
        np.testing.assert_array_equal(vertices.position[:2], [(4, 5, 6.5), (0, 100, 0)])
        self.assertEqual((vertices.mesh[0], vertices.face[0]), (2, 7))
        np.testing.assert_array_equal(vertices.event, [emca.Event.transmit, emca.Event.background, emca.Event.none])
        self.assertEqual((vertices.lobe[0], vertices.label[0]), (emca.Lobe.glossy, "glass"))
        np.testing.assert_array_equal(vertices.estimate[0], (1, 2, 3))
        np.testing.assert_array_equal(vertices.emission[0], (0.5, 0.5, 0.5))
        np.testing.assert_array_equal(paths.next_events.position, [(7, 8, 9), (7, 8, 10)])
        np.testing.assert_array_equal(paths.next_events.visible, [1, 0])
        self.assertEqual(list(paths.contributions.technique), ["light sampling", "BSDF sampling"])
        np.testing.assert_array_equal(paths.contributions.value, [(1, 0, 0), (0, 1, 0)])
        np.testing.assert_array_equal(paths.contributions.mis_weight, [0.25, np.nan])
        np.testing.assert_array_equal(paths.contributions.end, [2, 0])
        np.testing.assert_array_equal(paths.splats.pixel, [(1, 1)])
        np.testing.assert_array_equal(paths.splats.value, [(1, 2, 3)])

    def test_outside_a_replay_nothing_is_looked_at(self):
        rec = emca.recorder()
        self.assertFalse(rec.is_recording)
        rec.set_path_index(0)
        rec.set_intersection_pos("no position")
        rec.add_intersection_data("costly", lambda: self.fail("called"))
        rec.add_contribution(None, "no technique")

    def test_what_cannot_be_recorded_says_so(self):
        quiet()
        for value, kind in ((object(), "TypeError"), ({}, "TypeError"), (1j, "TypeError"), (np.zeros((2, 2)), "ValueError"), ([], "ValueError")):
            with self.assertRaisesRegex(emca.ServerError, kind):
                self.record(lambda rec: (rec.set_depth_index(1), rec.add_intersection_data("x", value)))
        with self.assertRaisesRegex(emca.ServerError, "ValueError.*sideways"):
            self.record(lambda rec: (rec.set_depth_index(1), rec.set_intersection_event("sideways")))
        with self.assertRaisesRegex(emca.ServerError, "three numbers"):
            self.record(lambda rec: (rec.set_depth_index(1), rec.set_intersection_pos((1, 2))))

    def test_seeds_are_those_of_other_renderers(self):
        seeds = emca.SeedMap(3)
        self.assertEqual(seeds.seed((1, 2), 3), emca.SeedMap(3).seed((1, 2), 3))
        self.assertEqual(len({seeds.seed((x, y), s) for x in range(8) for y in range(8) for s in range(8)}), 512)


class Handles(unittest.TestCase):
    def test_paths_by_name_and_threads(self):
        kept = []

        class Wavefront(Known):
            spp = 3

            def render_pixel(self, pixel, settings, recording, monitor):
                for sample in range(settings.samples_per_pixel):
                    path = recording.path(pixel, sample).origin((0, 0, 0)).add("who", "handle")
                    path.vertex(1).position((1, 2, 3)).event("reflect", "diffuse", "wall").add("pdf", 0.5).contribution((1, 1, 1), "light", 1.0)
                    path.final_estimate(self.value(pixel, sample))

                def other():
                    with recording.scope(pixel):
                        rec = emca.recorder()
                        rec.set_path_index(7)
                        rec.set_depth_index(1)
                        rec.set_final_estimate((1, 1, 1))
                thread = threading.Thread(target=other)
                thread.start()
                thread.join()
                kept.extend([recording, path, monitor])
                return (1, 1, 1)

        with emca.serve(Wavefront()) as server, emca.connect(server.address) as connection:
            paths = connection.pixel(2, 2).paths
        np.testing.assert_array_equal(paths.sample, [0, 1, 2, 7])
        np.testing.assert_array_equal(paths.vertices["pdf"].values, [0.5] * 3)
        self.assertEqual(list(paths["who"].texts), ["handle"] * 3)
        self.assertEqual(paths.contributions.technique[0], "light")
        for use in (lambda: kept[0].path((2, 2), 1), lambda: kept[1].add("late", 1), lambda: kept[2].progress(0.5)):
            with self.assertRaisesRegex(RuntimeError, "is over"):
                use()

    def test_paths_that_reach_any_pixel(self):
        class LightTracer(Known):
            spp = 5

            def info(self):
                info = super().info()
                info.paths_reach_any_pixel = True
                return info

            def render_pixels(self, pixels, settings, recording, monitor):
                rec = emca.recorder()
                values = {pixel: 0.0 for pixel in pixels}
                for sample in range(settings.samples_per_pixel):
                    rec.clear_pixel()
                    rec.set_path_index(sample)
                    rec.set_depth_index(1, "light")
                    hit = (sample, 0)
                    rec.add_splat(hit, (1, 1, 1))
                    if hit in values:
                        values[hit] += 1
                return [[v, v, v] for v in values.values()]

        with emca.serve(LightTracer()) as server, emca.connect(server.address) as connection:
            trace = connection.pixels([(3, 0), (1, 0)])
        self.assertEqual(sorted(trace.paths.sample), [1, 3])
        self.assertEqual([replay.replayed[0] for replay in trace.replays], [1, 1])


class Failures(unittest.TestCase):
    def setUp(self):
        quiet()

    def said(self, **methods):
        """What a client is told if methods of a renderer are replaced."""
        renderer = type("Failing", (Known,), methods)()
        with emca.serve(renderer) as server, emca.connect(server.address) as connection:
            with self.assertRaises(emca.Error) as caught:
                connection.pixel(0, 0) if "render_pixel" in methods else connection.render() if "render_image" in methods else connection.meshes()
            if "meshes" not in methods:
                self.assertEqual(connection.info.renderer, "known")  # still there
        return caught.exception

    def test_what_is_raised(self):
        def raises(self, *arguments):
            raise LookupError("no such brush")
        for method in ("render_pixel", "render_image"):
            error = self.said(**{method: raises})
            self.assertEqual(error.code, "rendererFailed")
            self.assertRegex(str(error), rf"{method} raised LookupError: no such brush \(test_renderer.py, line \d+\)")
        self.assertIn("no such brush", str(self.said(meshes=raises)))

    def test_errors_of_ours_keep_their_code(self):
        def refuses(self, *arguments):
            raise emca.InputError("This renderer knows no integrator but path.")
        error = self.said(render_image=refuses)
        self.assertEqual((type(error), error.code), (emca.InputError, "invalidArgument"))
        self.assertIn("no integrator but path", str(error))

    def test_what_is_returned(self):
        for image in (None, "no image", [[1, 2], [3]], np.zeros((3, 3)), np.zeros((6, 8, 3, 1)), np.zeros((6, 9, 3))):
            self.said(render_image=lambda self, *_: image)
        for pixel in (None, (1, 2), "black"):
            self.said(render_pixel=lambda self, *_: pixel)
        self.said(meshes=lambda self: [emca.Mesh([(0, 0, 0)], [(0, 1, 2)])])

    def test_info_that_raises(self):
        class Broken(Known):
            def info(self):
                raise RuntimeError("not today")
        with self.assertRaisesRegex(Exception, "not today"):
            emca.serve(Broken())
        with self.assertRaises(TypeError):
            emca.Renderer()

    def test_a_port_that_is_taken(self):
        with emca.serve(Known()) as server:
            with self.assertRaises(emca.ConnectionError) as caught:
                emca.serve(Known(), port=server.port)
            self.assertEqual(caught.exception.code, "addressInUse")


class Endings(unittest.TestCase):
    def test_stopping_cancels(self):
        renderer = Slow()
        server = emca.serve(renderer)
        connection = emca.connect(server.address)
        client = threading.Thread(target=lambda: self.assertRaises(emca.Error, connection.render))
        client.start()
        time.sleep(0.1)
        server.stop()
        client.join(10)
        self.assertFalse(client.is_alive())
        self.assertTrue(renderer.cancelled)
        self.assertTrue(server.wait(0))
        server.stop()  # twice is fine

    def test_waiting(self):
        with emca.serve(Known()) as server:
            begin = time.monotonic()
            self.assertFalse(server.wait(0.1))
            self.assertGreater(time.monotonic() - begin, 0.09)

    def test_forgetting_a_server_stops_it(self):
        server = emca.serve(Known())
        address = server.address
        gone = weakref.ref(server)
        del server
        gc.collect()
        self.assertIsNone(gone())
        with self.assertRaises(emca.ConnectionError):
            emca.connect(address)

    def test_a_renderer_cannot_stop_its_server(self):
        seen = []

        class Stopping(Known):
            def render_pixel(self, *arguments):
                try:
                    self.server.stop()
                except emca.InputError as error:
                    seen.append(error)
                return (0, 0, 0)
        renderer = Stopping()
        with emca.serve(renderer) as server, emca.connect(server.address) as connection:
            renderer.server = server
            connection.pixel(0, 0)
        self.assertEqual(len(seen), 1)

    def test_remarks(self):
        remarks = []
        with emca.serve(Known(), log=remarks.append) as server, emca.connect(server.address) as connection:
            connection.pixel(0, 0)
        self.assertTrue(remarks)

    def run_script(self, body):
        script = "import emca, sys, threading, time, os\nfrom support import Known, Slow\n" + textwrap.dedent(body)
        return subprocess.run([sys.executable, "-c", script], timeout=60, capture_output=True, text=True,
                              cwd=pathlib.Path(__file__).parent)

    def test_the_interpreter_exits(self):
        """With a server that renders, clients that wait, in the main thread's way or not."""
        bodies = ["server = emca.serve(Known())",
                  "server = emca.serve(Known())\nconnection = emca.connect(server.address)\nconnection.pixel(1, 1)",
                  "renderer = Slow()\nserver = emca.serve(renderer)\nrenderer.server = server\nconnection = emca.connect(server.address)",
                  """
                  server = emca.serve(Slow())
                  connection = emca.connect(server.address)
                  def client():
                      try:
                          connection.render()
                      except emca.Error:
                          pass
                  threading.Thread(target=client, daemon=True).start()
                  time.sleep(0.2)
                  """,
                  """
                  import socket
                  stranger = socket.create_server(("127.0.0.1", 0))
                  where = "127.0.0.1:%d" % stranger.getsockname()[1]
                  for _ in range(4):
                      threading.Thread(target=lambda: emca.connect(where, timeout=30), daemon=True).start()
                  end = time.monotonic() + 0.2
                  while time.monotonic() < end:
                      pass
                  """,
                  """
                  server = emca.serve(Slow())
                  connection = emca.connect(server.address)
                  threading.Thread(target=server.wait, daemon=True).start()
                  time.sleep(0.1)
                  raise SystemExit(0)
                  """]
        for body in bodies:
            done = self.run_script(body)
            self.assertEqual(done.returncode, 0, body + done.stderr)
            self.assertNotIn("Fatal", done.stderr)

    def test_ctrl_c_ends_waiting(self):
        done = self.run_script("""
            import signal
            server = emca.serve(Known())
            threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
            try:
                server.wait()
            except KeyboardInterrupt:
                print("interrupted")
        """)
        self.assertEqual((done.returncode, done.stdout), (0, "interrupted\n"), done.stderr)

    def test_the_last_reference_goes_in_a_call(self):
        class Holder(Known):
            def render_pixel(self, *arguments):
                self.server = None
                gc.collect()
                return (0, 0, 0)
        renderer = Holder()
        renderer.server = emca.serve(renderer)
        with emca.connect(renderer.server.address) as connection:
            with self.assertRaises(emca.Error):
                connection.pixel(0, 0)
                for _ in range(100):  # the server ends when the call is over
                    time.sleep(0.05)
                    connection.info


if __name__ == "__main__":
    unittest.main()
