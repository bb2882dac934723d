"""Connections: what they say, errors of every kind, threads, Ctrl-C, progress."""

import os
import signal
import socket
import threading
import time
import unittest

import numpy as np

import emca
from support import RENDER, Known, ServedScene, Slow, eventually


class Connected(unittest.TestCase):
    renderer = Known

    def setUp(self):
        self.served = self.renderer()
        self.server = emca.serve(self.served, allow_quit=True)
        self.connection = emca.connect(self.server.address)

    def tearDown(self):
        self.connection.close()
        self.server.stop()


class Answers(Connected):
    def test_info(self):
        info = self.connection.info
        self.assertEqual((info.renderer, info.scene, info.width, info.height, info.samples_per_pixel, info.seed), ("known", "a test", 8, 6, 4, 7))
        self.assertEqual((info.mesh_count, info.triangle_count, info.latest_render, info.layers), (1, 1, 0, []))
        self.assertIn("trace-rectangle", info.capabilities)

    def test_camera_and_meshes(self):
        camera = self.connection.camera()
        self.assertEqual(camera.position, (1, 2, 3))
        self.assertEqual((camera.direction, camera.up), ((0, 0, -1), (0, 1, 0)))  # made orthonormal
        self.assertEqual(camera.vertical_field_of_view, 50)
        mesh, = self.connection.meshes()
        np.testing.assert_array_equal(mesh.positions, np.float32([(0, 0, 0), (1, 0, 0), (0, 1, 0)]))
        np.testing.assert_array_equal(mesh.triangles, np.uint32([(0, 1, 2)]))
        self.assertEqual((mesh.name, mesh.emission, mesh.is_emitter), ("triangle", (1, 2, 3), True))

    def test_image(self):
        image = self.connection.render(spp=3, seed=5)
        y, x = np.mgrid[0:6, 0:8].astype(np.float32)
        np.testing.assert_array_equal(image.color, np.stack([x, y, np.ones_like(x)], axis=-1))
        self.assertEqual((image.width, image.height, image.samples_per_pixel, image.seed, image.channels), (8, 6, 3, 5, ["R", "G", "B"]))
        self.assertEqual(self.connection.info.latest_render, image.render_id)
        self.assertEqual(np.asarray(image).shape, (6, 8, 3))

    def test_pixels_and_regions(self):
        self.connection.render()
        trace = self.connection.pixel(5, 2)
        np.testing.assert_array_equal(trace.pixels, [(5, 2)])
        np.testing.assert_array_equal(trace.paths.estimate, np.float32([(5, 2, s) for s in range(4)]))
        self.assertEqual((trace.verdict, trace.replay.sums, trace.samples_per_pixel, trace.seed), ("exact", "matches", 4, 7))
        listed = self.connection.pixels([(7, 5), (0, 0)], spp=2)
        np.testing.assert_array_equal(listed.pixels, [(7, 5), (0, 0)])
        np.testing.assert_array_equal(listed.paths.pixel, [(0, 0), (0, 0), (7, 5), (7, 5)])
        for rect in (((2, 1), (4, 3)), (2, 1, 4, 3), np.array([[2, 1], [4, 3]])):
            region = self.connection.region(rect, spp=1)
            np.testing.assert_array_equal(region.paths.pixel, [(2, 1), (3, 1), (2, 2), (3, 2)])
        with self.assertRaises(ValueError):
            region.replay

    def test_queries_count_per_pixel(self):
        trace = self.connection.region((0, 0, 8, 6), where="estimate.r > estimate.b", keep="none")
        expected = [sum(x > s for s in range(4)) for y in range(6) for x in range(8)]
        np.testing.assert_array_equal(trace.matches.matched_of_pixel, expected)
        self.assertEqual((trace.matches.paths, trace.matches.matched, trace.matches.omitted), (192, sum(expected), sum(expected)))
        np.testing.assert_array_equal(trace.matches.sum_of_pixel[:, 0], [x * n for n, x in zip(expected, list(range(8)) * 6)])

    def test_compare_with_a_chosen_image(self):
        first = self.connection.render(spp=2)
        self.connection.render(spp=4)
        self.assertEqual(self.connection.pixel(1, 1, render=first).samples_per_pixel, 2)
        self.assertEqual(self.connection.pixel(1, 1, render=first.render_id).verdict, "exact")
        self.assertEqual(self.connection.pixel(1, 1, render=12345).verdict, "unknown")

    def test_progress_comes_to_its_end(self):
        calls, thread = [], threading.get_ident()
        self.connection.region((0, 0, 8, 6), spp=64, progress=lambda f: calls.append((f, threading.get_ident())))
        self.assertTrue(all(0 <= f <= 1 and t == thread for f, t in calls))

    def test_closing(self):
        with emca.connect(self.server.address) as connection:
            self.assertTrue(connection.is_open)
        self.assertFalse(connection.is_open)
        with self.assertRaises(emca.ConnectionError) as caught:
            connection.info
        self.assertEqual(caught.exception.code, "connectionLost")

    def test_quitting(self):
        self.connection.quit_server()
        self.assertTrue(self.server.wait(10))

    def test_many_threads_at_once(self):
        failures = []

        def work(number):
            try:
                for i in range(20):
                    x, y = (number + i) % 8, i % 6
                    paths = self.connection.pixel(x, y).paths
                    np.testing.assert_array_equal(paths.estimate[:, :2], np.tile(np.float32([x, y]), (4, 1)))
            except BaseException as failure:
                failures.append(failure)

        threads = [threading.Thread(target=work, args=(n,)) for n in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])


class Refusals(Connected):
    def refused(self, kind, code, call):
        with self.assertRaises(kind) as caught:
            call()
        self.assertIsInstance(caught.exception, emca.Error)
        self.assertEqual(caught.exception.code, code)
        self.assertGreater(len(str(caught.exception)), 20)

    def test_input(self):
        c = self.connection
        self.refused(emca.InputError, "pixelOutOfRange", lambda: c.pixel(8, 0))
        self.refused(ValueError, "pixelOutOfRange", lambda: c.pixel(-1, 0))
        self.refused(emca.InputError, "tooLarge", lambda: c.pixel(0, 0, spp=(1 << 20) + 1))
        self.refused(emca.InputError, "invalidArgument", lambda: c.pixel(0, 0, spp=0))
        self.refused(emca.InputError, "invalidArgument", lambda: c.region((0, 0, 3)))
        self.refused(emca.InputError, "invalidArgument", lambda: c.region((2, 2, 2, 2)))
        self.refused(emca.InputError, "invalidArgument", lambda: c.pixel(0, 0, top=3))
        self.refused(emca.InputError, "invalidArgument", lambda: c.pixel(0, 0, where="true", keep="some"))
        self.refused(emca.InputError, "invalidArgument", lambda: c.pixel(0, 0, columns="position"))
        self.refused(emca.Error, "notSupported", lambda: c.surface())
        self.assertEqual(len(c.pixel(0, 0).paths), 4)  # the connection is as good as before
        for wrong in (lambda: c.pixel(0.5, 0), lambda: c.pixel("1", 0), lambda: c.pixel(0, 0, no_such_option=1)):
            with self.assertRaises(TypeError):
                wrong()

    def test_queries(self):
        self.refused(emca.QueryError, "parseFailed", lambda: self.connection.pixel(0, 0, where="depth >"))

    def test_nobody_listens(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.refused(ConnectionError, "connectionFailed", lambda: emca.connect(f"127.0.0.1:{port}"))
        self.refused(emca.InputError, "invalidArgument", lambda: emca.connect("127.0.0.1:123456"))

    def test_a_stranger_listens(self):
        with socket.create_server(("127.0.0.1", 0)) as stranger:
            self.refused(emca.TimeoutError, "timedOut", lambda: emca.connect(f"127.0.0.1:{stranger.getsockname()[1]}", timeout=0.2))

    def test_tokens(self):
        with emca.serve(Known(), token="secret") as server:
            self.refused(emca.ConnectionError, "refused", lambda: emca.connect(server.address))
            with emca.connect(server.address, token="secret") as connection:
                self.assertEqual(connection.info.renderer, "known")


class GivingUp(Connected):
    renderer = Slow

    def test_ctrl_c(self):
        timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            self.connection.render()
        self.assertLess(time.monotonic() - begin, 5)
        timer.join()
        self.assertTrue(eventually(lambda: self.served.cancelled))
        self.assertEqual(len(self.connection.pixel(1, 1).paths), 4)

    def test_progress_that_raises(self):
        def enough(fraction):
            raise ZeroDivisionError("enough")
        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            self.connection.render(progress=enough)
        self.assertTrue(eventually(lambda: self.served.cancelled))

    def test_others_go_on_meanwhile(self):
        waiting = threading.Thread(target=lambda: self.assertRaises(emca.ConnectionError, self.connection.render))
        waiting.start()
        self.assertEqual(len(self.connection.pixel(1, 1).paths), 4)  # while the other thread waits for its image
        self.assertTrue(waiting.is_alive())
        self.connection.close()
        waiting.join(10)
        self.assertFalse(waiting.is_alive())


@unittest.skipUnless(RENDER, "the reference renderer is not built")
class SurfaceLayers(unittest.TestCase):
    def test_layers(self):
        with ServedScene("cornell-box", "32x24", 8) as address, emca.connect(address) as connection:
            names = [layer.name for layer in connection.info.layers]
            self.assertGreater(len(names), 1)
            image = connection.render(layers=names[:2])
            self.assertEqual(image.layers, names[:2])
            surface = connection.surface(render=image)
            meshes = connection.meshes()
            self.assertEqual(list(surface), names[:2])
            for layer in surface.values():
                self.assertGreater(layer.samples, 0)
                self.assertFalse(layer.values.flags.owndata)
                self.assertEqual(len(layer.values), len(surface.points))
            for index, mesh in enumerate(meshes):
                faces = surface.faces_of(index)
                if faces.stop == faces.start:
                    continue
                positions, triangles, base = surface.refined(index, mesh)
                self.assertEqual(len(triangles), faces.stop - faces.start)
                self.assertLess(base.max(), len(mesh.triangles))

                def area(p, t):
                    a, b, c = (p[t[:, i]].astype(np.float64) for i in range(3))
                    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2

                self.assertAlmostEqual(area(positions, triangles) / area(mesh.positions, mesh.triangles), 1, places=5)
            with self.assertRaises(emca.InputError):
                connection.render(layers=["no such layer"])


if __name__ == "__main__":
    unittest.main()
