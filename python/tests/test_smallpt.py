"""The small path tracer of examples/: replays exactly, and a client reads it back."""

import os
import re
import subprocess
import sys
import unittest

import numpy as np

import emca
from support import SOURCE


class SmallPathTracer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.process = subprocess.Popen([sys.executable, str(SOURCE / "examples" / "smallpt.py"), "--port", "0", "--size", "16x12", "--spp", "4"],
                                       stdout=subprocess.PIPE, text=True, env=dict(os.environ, PYTHONUNBUFFERED="1"))
        address = re.match(r"listening on (\S+)", cls.process.stdout.readline()).group(1)
        cls.connection = emca.connect(address)
        cls.image = cls.connection.render()

    @classmethod
    def tearDownClass(cls):
        cls.connection.quit_server()
        cls.connection.close()
        code = cls.process.wait(20)
        cls.process.stdout.close()
        assert code == 0, code

    def test_it_replays_exactly(self):
        trace = self.connection.region((0, 0, 16, 12))
        self.assertEqual({replay.verdict for replay in trace.replays}, {"exact"})
        self.assertEqual({replay.sums for replay in trace.replays}, {"matches"})
        np.testing.assert_array_equal(np.float32([r.replayed for r in trace.replays]).reshape(12, 16, 3), self.image.color)

    def test_contributions_add_up(self):
        paths = self.connection.region((0, 0, 16, 12)).paths
        total = np.zeros((len(paths), 3))
        np.add.at(total, paths.contributions.path, paths.contributions.value)
        np.testing.assert_allclose(total, paths.estimate, rtol=1e-5, atol=1e-6)
        self.assertEqual(set(paths.contributions.technique), {"light sampling", "BSDF sampling"})

    def test_more_samples_extend_the_paths(self):
        few, many = self.connection.pixel(8, 6, spp=4).paths, self.connection.pixel(8, 6, spp=8).paths
        np.testing.assert_array_equal(few.estimate, many.estimate[:4])

    def test_vertices_lie_on_the_meshes(self):
        meshes = self.connection.meshes()
        vertices = self.connection.region((0, 0, 16, 12), spp=1).paths.vertices
        self.assertTrue(vertices.has_surface.all())
        for position, mesh, face in zip(vertices.position, vertices.mesh, vertices.face):
            corners = meshes[mesh].positions[meshes[mesh].triangles[face]]
            # Within half a step of a ball's triangulation; walls are flat but large.
            near = 0.15 if len(meshes[mesh].triangles) > 2 else 10
            self.assertLess(np.linalg.norm(position - corners.mean(axis=0)), near)

    def test_caustics_are_found_by_their_events(self):
        paths = self.connection.region((0, 0, 16, 12)).paths
        caustic = paths.select('lpe("C<RD>.*L") and any(v.lobe == "specular")')
        self.assertTrue(set(caustic) <= set(np.unique(paths.vertices.path[paths.vertices.lobe == emca.Lobe.specular])))

    def test_the_image_is_lit(self):
        self.assertTrue(np.isfinite(self.image.color).all())
        self.assertGreater(self.image.color.mean(), 0.1)
        self.assertEqual(self.image.variance.shape, (12, 16, 3))
        self.assertEqual(self.image.samples.min(), 4)


if __name__ == "__main__":
    unittest.main()
