"""Paths as arrays: views without copies, the same bits as the command line says, valid as long as they live."""

import gc
import sys
import unittest
from unittest import mock

import numpy as np

import emca
from support import CLI, RENDER, Known, ServedScene, cli


def base_of(array):
    while isinstance(array.base, np.ndarray):
        array = array.base
    return array.base


@unittest.skipUnless(RENDER and CLI, "the reference renderer and the command line are not built")
class ReferenceRenderer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.served = ServedScene("cornell-box", "32x24", 16)
        cls.address = cls.served.__enter__()
        cls.connection = emca.connect(cls.address)
        cls.image = cls.connection.render()
        cls.trace = cls.connection.pixel(16, 12)
        cls.paths = cls.trace.paths

    @classmethod
    def tearDownClass(cls):
        cls.connection.close()
        cls.served.__exit__()

    def test_columns_are_views(self):
        paths, vertices = self.paths, self.paths.vertices
        arrays = [paths.pixel, paths.sample, paths.part, paths.origin, paths.estimate, paths.first_vertex, vertices.depth, vertices.flags,
                  vertices.position, vertices.estimate, vertices.emission, vertices.mesh, vertices.face, vertices.event, vertices.lobe,
                  paths.next_events.position, paths.next_events.visible, paths.next_events.vertex, paths.contributions.value,
                  paths.contributions.mis_weight, paths.contributions.vertex, self.trace.pixels, self.image.pixels, self.image.variance]
        arrays += [column.values for column in vertices.columns]
        self.assertGreater(len(vertices.columns), 2)
        for array in arrays:
            self.assertGreater(array.size, 0)
            self.assertFalse(array.flags.owndata)
            self.assertEqual(type(base_of(array)).__name__, "PyCapsule")
            self.assertFalse(array.flags.writeable)
            with self.assertRaises(ValueError):
                array.setflags(write=True)

    def test_two_looks_share_memory(self):
        again = emca.PathSet(self.trace._native.paths())
        self.assertTrue(np.shares_memory(again.estimate, self.paths.estimate))
        self.assertTrue(np.shares_memory(again.contributions.value, self.paths.contributions.value))
        pdf = self.paths.vertices["BSDF pdf"]
        self.assertTrue(np.shares_memory(again.vertices["BSDF pdf"].values, pdf.values))
        if pdf.dense:
            self.assertTrue(np.shares_memory(np.asarray(pdf), pdf.values))

    def test_bits_are_those_of_the_command_line(self):
        said = cli("pixel", self.address, 16, 12, "--json")
        paths, vertices = self.paths, self.paths.vertices
        self.assertEqual(self.trace.verdict, "exact")
        self.assertEqual(said["replay"]["verdict"], "exact")
        self.assertEqual(len(said["paths"]), len(paths))
        checked = 0

        def same(text, number):
            nonlocal checked
            checked += 1
            expected = np.asarray(text, dtype=np.asarray(number).dtype)  # "NaN" and "Infinity" are read as numbers
            np.testing.assert_array_equal(np.asarray(number), expected)

        for i, path in enumerate(said["paths"]):
            same(path["sample"], paths.sample[i])
            same(path["estimate"], paths.estimate[i])
            same(path["origin"], paths.origin[i])
            same(path["depth"], paths.depth[i])
            own = range(len(vertices))[paths.vertices_of(i)]
            self.assertEqual(len(own), len(path["vertices"]))
            for v, vertex in zip(own, path["vertices"]):
                same(vertex["depth"], vertices.depth[v])
                place = vertex["envmap"] if vertices.is_environment[v] else vertex["position"]
                if place is not None:
                    same(place, vertices.position[v])
                if vertex["event"] is not None:
                    self.assertEqual(vertex["event"]["type"], emca.Event(vertices.event[v]).name)
                    self.assertEqual(vertex["event"]["lobe"], emca.Lobe(vertices.lobe[v]).name)
                    self.assertEqual(vertex["event"]["label"], vertices.label[v])
                if vertex["surface"] is not None:
                    same([vertex["surface"]["mesh"], vertex["surface"]["face"]], [vertices.mesh[v], vertices.face[v]])
                if vertex["estimate"] is not None:
                    same(vertex["estimate"], vertices.estimate[v])
                for name, value in vertex["data"].items():
                    column = vertices[name]
                    self.assertTrue(column.has()[v])
                    if column.type == "text":
                        self.assertEqual(value, column.per_owner()[v])
                    else:
                        same(value, column.per_owner(fill=0)[v])
                seen = np.flatnonzero(paths.next_events.vertex == v)
                self.assertEqual([e["visible"] for e in vertex["nee"]], [bool(s) for s in paths.next_events.visible[seen]])
                for event, k in zip(vertex["nee"], seen):
                    same(event["position"], paths.next_events.position[k])
            added = np.flatnonzero(paths.contributions.path == i)
            self.assertEqual(len(path["contributions"]), len(added))
            for contribution, k in zip(path["contributions"], added):
                same(contribution["value"], paths.contributions.value[k])
                self.assertEqual(contribution["technique"], paths.contributions.technique[k])
        self.assertGreater(checked, 500)

    def test_the_pixel_is_the_mean_of_its_paths(self):
        np.testing.assert_allclose(self.paths.estimate.mean(axis=0, dtype=np.float64), self.image.color[12, 16], rtol=1e-5)
        self.assertEqual(self.trace.replay.sums, "matches")
        np.testing.assert_array_equal(np.float32(self.trace.replay.rendered), self.image.color[12, 16])

    def test_vertices_belong_to_their_paths(self):
        first = self.paths.first_vertex
        self.assertEqual((first[0], first[-1], len(first)), (0, len(self.paths.vertices), len(self.paths) + 1))
        for i in range(len(self.paths)):
            self.assertTrue((self.paths.vertices.path[self.paths.vertices_of(i)] == i).all())
        self.assertEqual(self.paths.vertices_of(-1), self.paths.vertices_of(len(self.paths) - 1))
        with self.assertRaises(IndexError):
            self.paths.vertices_of(len(self.paths))

    def test_a_query_is_what_numpy_computes(self):
        paths, vertices = self.paths, self.paths.vertices
        np.testing.assert_array_equal(paths.select("depth > 3"), np.flatnonzero(paths.depth > 3))
        np.testing.assert_array_equal(paths.select("luminance > 0.1"), np.flatnonzero(paths.luminance.astype(np.float64) > 0.1))
        glossy = np.zeros(len(paths), bool)
        pdf = vertices["BSDF pdf"]
        glossy[vertices.path[pdf.owners[pdf.values < 0.1]]] = True
        np.testing.assert_array_equal(paths.select("any(v.`BSDF pdf` < 0.1)"), np.flatnonzero(glossy))
        np.testing.assert_array_equal(paths.evaluate("estimate").filled(0), paths.estimate.astype(np.float64))
        self.assertEqual(paths.evaluate("depth > 3").dtype, bool)
        np.testing.assert_array_equal(paths.where("depth > 3").sample, paths.sample[paths.depth > 3])

    def test_a_query_that_travels_finds_the_same(self):
        query = "any(v.lobe == \"diffuse\" and v.depth > 1) and luminance > 0.05"
        sent = self.connection.pixel(16, 12, where=query)
        np.testing.assert_array_equal(sent.paths.sample, self.paths.sample[self.paths.select(query)])
        self.assertEqual(sent.matches.matched, len(sent.paths))
        self.assertEqual(sent.matches.paths, len(self.paths))
        counted = self.connection.pixel(16, 12, where=query, keep="none")
        self.assertEqual((len(counted.paths), counted.matches.matched), (0, len(sent.paths)))
        best = self.connection.pixel(16, 12, where="true", top=3)
        np.testing.assert_array_equal(np.sort(best.paths.luminance), np.sort(self.paths.luminance)[-3:])

    def test_tables(self):
        table = self.paths.table("count() as n, mean(luminance) as mean group by depth")
        self.assertEqual(table.group_keys, ["depth"])
        depths, counts = np.unique(self.paths.depth, return_counts=True)
        np.testing.assert_array_equal(table["depth"], depths)
        np.testing.assert_array_equal(table["n"], counts)
        for row in table.rows():
            self.assertAlmostEqual(row["mean"], float(self.paths.luminance[self.paths.depth == row["depth"]].mean(dtype=np.float64)), places=6)
        self.assertEqual(len(str(table).splitlines()), len(depths) + 1)

    def test_a_wrong_query_says_where(self):
        with self.assertRaises(emca.QueryError) as caught:
            self.paths.select("depth > 3 änd luminance")
        self.assertEqual(caught.exception.position, 10)
        self.assertEqual(caught.exception.code, "parseFailed")
        self.assertEqual(caught.exception.point().splitlines()[1].index("^"), 10)
        with self.assertRaises(emca.QueryError) as caught:  # characters, not bytes
            self.paths.select("\"é\" == \"é\" and )")
        self.assertEqual(caught.exception.position, 15)
        with self.assertRaises(emca.QueryError):
            self.connection.pixel(1, 1, where="depth >")

    def test_a_name_that_nobody_recorded(self):
        with self.assertWarns(emca.QueryWarning):
            self.assertEqual(len(self.paths.select("any(v.`no such thing` > 1)")), 0)
        self.assertEqual(self.paths.match("any(v.`no such thing` > 1)").missing, ["no such thing"])
        with self.assertRaises(emca.NotRecordedError) as caught:
            self.paths.vertices["no such thing"]
        self.assertIn("BSDF pdf", str(caught.exception))
        self.assertNotIn("no such thing", self.paths.vertices)
        few = self.connection.pixel(16, 12, columns=["position"]).paths
        self.assertEqual(few.vertices.position.shape, (len(few.vertices), 3))
        with self.assertRaises(emca.NotRecordedError):
            few.estimate
        self.assertTrue(np.isnan(few.luminance).all())

    def test_subsets_and_unions(self):
        mask = self.paths.depth > 3
        deep, others = self.paths.subset(mask), self.paths.subset(np.flatnonzero(~mask))
        self.assertEqual(len(deep) + len(others), len(self.paths))
        both = emca.merge([deep, others])
        np.testing.assert_array_equal(both.estimate, self.paths.estimate)
        np.testing.assert_array_equal(both.vertices.position, self.paths.vertices.position)
        self.assertEqual(len(self.paths.subset([])), 0)
        self.assertEqual(self.paths.find((16, 12), 5), 5)
        self.assertIsNone(self.paths.find((16, 13), 5))
        for wrong in ([3, 1], [1, 1]):
            with self.assertRaises(ValueError):
                self.paths.subset(wrong)
        with self.assertRaises(IndexError):
            self.paths.subset([len(self.paths)])

    def test_dataframes(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = self.paths.to_dataframe()
        np.testing.assert_array_equal(frame["g"].to_numpy(), self.paths.estimate[:, 1])
        vertices = self.paths.vertices.to_dataframe()
        np.testing.assert_array_equal(vertices["path"].to_numpy(), self.paths.vertices.path)
        np.testing.assert_array_equal(vertices["BSDF pdf"].to_numpy(), self.paths.vertices["BSDF pdf"].per_owner())
        self.assertEqual(vertices["event"][0], emca.Event(self.paths.vertices.event[0]).name)
        grouped = self.paths.table("count() as n group by depth").to_dataframe()
        self.assertEqual(grouped["n"].sum(), len(self.paths))

    def test_without_pandas_a_sentence_says_so(self):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            with self.assertRaisesRegex(ImportError, "python3-pandas"):
                self.paths.to_dataframe()

    def test_arrays_outlive_everything(self):
        connection = emca.connect(self.address)
        trace = connection.pixel(16, 12)
        estimate, position = trace.paths.estimate, trace.paths.vertices.position
        pdf = trace.paths.vertices["BSDF pdf"].values
        mesh = connection.meshes()[0].positions
        image = connection.render().color  # others compare with the latest image: the same settings
        kept = [array.copy() for array in (estimate, position, pdf, mesh, image)]
        connection.close()
        del connection, trace
        gc.collect()
        spoiler = [np.full(1 << 16, 7.0) for _ in range(64)]  # takes what was let go
        for array, copy in zip((estimate, position, pdf, mesh, image), kept):
            np.testing.assert_array_equal(array, copy)
        del spoiler


class Columns(unittest.TestCase):
    """User data of every type, with gaps and repetitions."""

    class Data(Known):
        def record(self, rec, pixel, sample):
            super().record(rec, pixel, sample)
            rec.set_depth_index(1)
            rec.add_intersection_data("float32", np.float32(0.1))
            rec.add_intersection_data("float", 0.1)
            rec.add_intersection_data("three", (1.5, 2.5, 3.5))
            rec.add_intersection_data("two", np.array([1, 2], np.float32))
            rec.add_intersection_data("integers", [1, 2, 3])
            rec.add_intersection_data("color", emca.Color(1, 2, 3))
            rec.add_intersection_data("rgba", emca.ColorA(1, 2, 3, 0.5))
            rec.add_intersection_data("spectrum", np.arange(sample + 4, dtype=np.float32))
            rec.add_intersection_data("text", lambda: f"sample {sample}")
            if sample % 2:
                rec.add_intersection_data("odd", sample)
                rec.add_intersection_data("often", float(sample))
                rec.add_intersection_data("often", float(sample) + 0.5)
            rec.add_path_data("flag", sample > 1)
            rec.add_path_data("index", np.int32(sample))
            rec.add_path_data("mixed", sample if sample % 2 else float(sample))

    @classmethod
    def setUpClass(cls):
        with emca.serve(cls.Data()) as server, emca.connect(server.address) as connection:
            cls.paths = connection.pixel(2, 3).paths
        cls.vertices = cls.paths.vertices

    def test_types(self):
        types = {column.name: column.type for column in self.vertices.columns}
        self.assertEqual(types, {"float32": "float", "float": "double", "three": "double3", "two": "float2", "integers": "int3", "color": "color",
                                 "rgba": "rgba", "spectrum": "spectrum", "text": "text", "odd": "int", "often": "double"})
        self.assertEqual(self.vertices["float32"].values[0], np.float32(0.1))
        self.assertEqual(self.vertices["float"].values[0], 0.1)
        np.testing.assert_array_equal(self.vertices["three"].values, np.tile([1.5, 2.5, 3.5], (4, 1)))
        np.testing.assert_array_equal(self.vertices["rgba"].values[0], [1, 2, 3, 0.5])
        self.assertEqual(self.vertices["integers"].values.dtype, np.int64)
        self.assertEqual(self.paths["flag"].values.dtype, bool)

    def test_dense_and_sparse(self):
        self.assertTrue(self.paths["index"].dense)
        np.testing.assert_array_equal(self.paths["index"], [0, 1, 2, 3])
        odd = self.vertices["odd"]
        self.assertFalse(odd.dense)
        np.testing.assert_array_equal(odd.values, [1, 3])
        np.testing.assert_array_equal(self.vertices.path[odd.owners], [1, 3])
        np.testing.assert_array_equal(odd.per_owner(fill=-1), [-1, -1, 1, -1, -1, -1, 3, -1])
        with self.assertRaises(ValueError):
            odd.per_owner()

    def test_the_last_value_counts(self):
        often = self.vertices["often"]
        np.testing.assert_array_equal(often.values, [1, 1.5, 3, 3.5])
        np.testing.assert_array_equal(often.owners, [2, 2, 6, 6])
        np.testing.assert_array_equal(often > 1, [False, False, True, False, False, False, True, False])
        np.testing.assert_array_equal(np.nan_to_num(often), [0, 0, 1.5, 0, 0, 0, 3.5, 0])
        self.assertEqual((often * 2)[6], 7)

    def test_texts_and_spectra(self):
        self.assertEqual(list(self.vertices["text"].texts), [f"sample {s}" for s in range(4)])
        self.assertEqual(list(self.vertices["text"].per_owner()[:3]), ["sample 0", None, "sample 1"])
        spectra = self.vertices["spectrum"]
        np.testing.assert_array_equal(np.diff(spectra.offsets), [4, 5, 6, 7])
        np.testing.assert_array_equal(spectra.values[spectra.offsets[2]:spectra.offsets[3]], np.arange(6))
        with self.assertRaises(TypeError):
            spectra.per_owner()

    def test_a_key_of_two_types(self):
        with self.assertRaises(emca.NotRecordedError) as caught:
            self.paths["mixed"]
        self.assertIn("int and double", str(caught.exception))
        self.assertEqual([c.type for c in self.paths.columns if c.name == "mixed"], ["int", "double"])
        np.testing.assert_array_equal(self.paths.evaluate("mixed").filled(-1), [0, 1, 2, 3])

    def test_dataframes_have_gaps(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = self.vertices.to_dataframe()
        self.assertEqual(frame["odd"].dtype, pandas.Int64Dtype())
        self.assertEqual(int(frame["odd"].isna().sum()), 6)
        self.assertEqual(frame["three.y"].dropna().tolist(), [2.5] * 4)
        self.assertEqual(self.paths.to_dataframe()["mixed (int)"].dropna().tolist(), [1, 3])


class NoPaths(unittest.TestCase):
    def test_an_empty_set(self):
        paths = emca.PathSet()
        self.assertEqual((len(paths), len(paths.vertices), list(paths.first_vertex)), (0, 0, [0]))
        self.assertEqual(paths.estimate.shape, (0, 3))
        self.assertEqual(paths.vertices.position.shape, (0, 3))
        self.assertEqual(len(paths.select("depth > 1")), 0)
        self.assertEqual(paths.keys(), [])


if __name__ == "__main__":
    unittest.main()
