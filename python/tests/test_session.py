"""Sessions: what is saved comes back with equal bits, as views."""

import os
import tempfile
import unittest

import numpy as np

import emca
from support import SOURCE, Known


class Sessions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "a session.emca")
        with emca.serve(Known()) as server, emca.connect(server.address) as connection:
            self.image = connection.render()
            self.first, self.second = connection.pixel(1, 2), connection.region((3, 3, 5, 5))
            self.session = emca.Session(
                info=connection.info, camera=connection.camera(), meshes=connection.meshes(),
                images=[self.image, emca.Image(np.ones((2, 3)), title="grey")], current_image=1, traces=[self.second, self.first],
                shown=[1], selected_paths=[(1, 2, 3, 0)], notes="änything", pixel_notes={(1, 2): "look", (3, 3): "here"})

    def test_there_and_back(self):
        self.session.save(self.file)
        opened = emca.open(self.file)
        self.assertTrue(opened.whole)
        self.assertEqual(opened.notices, [])
        self.assertIn("EMCA", opened.software)
        for part in ("info", "camera", "current_image", "shown", "selected_paths", "notes", "pixel_notes"):
            self.assertEqual(getattr(opened, part), getattr(self.session, part), part)
        np.testing.assert_array_equal(opened.images[0].color, self.image.color)
        self.assertEqual(opened.images[0].render_id, self.image.render_id)
        self.assertEqual((opened.images[1].title, opened.images[1].pixels.shape, opened.images[1].color.shape), ("grey", (2, 3, 1), (2, 3, 3)))
        for trace, back in zip(self.session.traces, opened.traces):
            np.testing.assert_array_equal(trace.paths.estimate, back.paths.estimate)
            np.testing.assert_array_equal(trace.paths.vertices.position, back.paths.vertices.position)
            self.assertEqual(trace.replays, back.replays)
            self.assertFalse(back.paths.estimate.flags.owndata)
        np.testing.assert_array_equal(opened.meshes[0].positions, self.session.meshes[0].positions)
        again = self.file + "2"
        opened.save(again)
        self.assertEqual(emca.open(again).pixel_notes, self.session.pixel_notes)

    def test_by_parts(self):
        emca.save(self.file, traces=[self.first], notes="one")
        opened = emca.open(self.file)
        self.assertEqual((len(opened.traces), opened.shown, opened.notes, opened.meshes, opened.info), (1, [0], "one", None, None))
        with self.assertRaises(TypeError):
            emca.save(self.file, self.session, notes="both")
        with self.assertRaises(TypeError):
            emca.save(self.file, no_such_part=1)

    def test_a_cut_file_opens_as_far_as_it_is_whole(self):
        self.session.save(self.file)
        with open(self.file, "r+b") as file:
            file.truncate(os.path.getsize(self.file) * 2 // 3)
        opened = emca.open(self.file)
        self.assertFalse(opened.whole)
        self.assertTrue(opened.notices)

    def test_errors(self):
        with self.assertRaises(emca.FileError) as caught:
            emca.open(self.file)
        self.assertEqual(caught.exception.code, "fileNotFound")
        with self.assertRaises(OSError):
            emca.open(__file__)
        with self.assertRaises(emca.FileError) as caught:
            emca.save(os.path.join(self.file, "below", "a file"), notes="x")
        self.assertEqual(caught.exception.code, "fileUnwritable")

    def test_the_golden_file_of_version_1(self):
        opened = emca.open(SOURCE / "tests" / "golden" / "session_v1.emca")
        self.assertTrue(opened.whole)
        for trace in opened.traces:
            self.assertEqual(len(trace.paths.first_vertex), len(trace.paths) + 1)


if __name__ == "__main__":
    unittest.main()
