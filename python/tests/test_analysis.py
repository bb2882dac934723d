"""Statistics and image metrics agree with numpy and with published figures."""

import unittest

import numpy as np

import emca
from emca import image_metrics, statistics
from support import Known

# Rosner 1983; the worked example of the NIST/SEMATECH e-Handbook of Statistical Methods, section 1.3.5.17.3.
ROSNER = [-0.25, 0.68, 0.94, 1.15, 1.20, 1.26, 1.26, 1.34, 1.38, 1.43, 1.49, 1.49, 1.55, 1.56, 1.58, 1.65, 1.69, 1.70, 1.76, 1.77, 1.81, 1.91,
          1.94, 1.96, 1.99, 2.06, 2.09, 2.10, 2.14, 2.15, 2.23, 2.24, 2.26, 2.35, 2.37, 2.40, 2.47, 2.54, 2.62, 2.64, 2.90, 2.92, 2.92, 2.93,
          3.21, 3.26, 3.30, 3.59, 3.68, 4.30, 4.64, 5.34, 5.42, 6.01]


class Outliers(unittest.TestCase):
    def test_rosners_example(self):
        found = emca.outliers(ROSNER, "esd", maximum=10)
        np.testing.assert_array_equal(np.array(ROSNER)[found.indices], [5.34, 5.42, 6.01])
        np.testing.assert_allclose([s.statistic for s in found.steps][:3], [3.118, 2.942, 3.179], atol=1e-3)
        np.testing.assert_allclose([s.critical for s in found.steps][:3], [3.158, 3.151, 3.143], atol=1e-3)
        self.assertFalse(found.maximum_reached)

    def test_deviation(self):
        values = np.r_[np.linspace(-1, 1, 99), 50, np.nan]
        found = emca.outliers(values, deviations=3)
        np.testing.assert_array_equal(found.indices, [99, 100])
        self.assertAlmostEqual(found.mean, values[:-1].mean())
        self.assertAlmostEqual(found.deviation, values[:-1].std(ddof=1))
        self.assertEqual((found.considered, found.not_finite), (100, 1))

    def test_of_paths(self):
        class Burning(Known):
            spp = 32
            def value(self, pixel, sample):
                return (1e4, 1e4, 1e4) if sample == 17 else (sample % 3, 0, 0)
        with emca.serve(Burning()) as server, emca.connect(server.address) as connection:
            trace = connection.pixel(0, 0)
        for of in (trace, trace.paths):
            self.assertEqual(list(emca.outliers(of).indices), [17])
        self.assertEqual(list(emca.outliers(trace, "esd", "red").indices), [17])
        self.assertEqual(list(emca.outliers(trace, quantity="depth").indices), [])

    def test_per_pixel_is_each_pixel_alone(self):
        class Uneven(Known):
            spp = 32
            def value(self, pixel, sample):
                return (10.0 ** pixel[0] * (5 if sample == 9 + pixel[0] else 1 + sample % 3 / 10),) * 3
        with emca.serve(Uneven()) as server, emca.connect(server.address) as connection:
            region = connection.pixels([(0, 0), (1, 0), (2, 0)])
            alone = [emca.outliers(connection.pixel(x, 0)) for x in range(3)]
        self.assertNotIn(9, emca.outliers(region).indices)   # the dark pixel's hides behind the bright one
        found = emca.outliers_per_pixel(region)
        self.assertEqual(list(found), [(0, 0), (1, 0), (2, 0)])
        for x in range(3):
            self.assertEqual(list(found[x, 0].indices), [32 * x + i for i in alone[x].indices])
            self.assertEqual(list(alone[x].indices), [9 + x])
            self.assertEqual((found[x, 0].mean, found[x, 0].upper), (alone[x].mean, alone[x].upper))

    def test_errors(self):
        with self.assertRaises(emca.InputError):
            emca.outliers(ROSNER, deviations=-1)
        for wrong in ({"method": "guess"},):
            with self.assertRaises(ValueError):
                emca.outliers(ROSNER, **wrong)
        with self.assertRaises(ValueError):
            emca.outliers(emca.PathSet(), quantity="taste")


class Numbers(unittest.TestCase):
    def test_summaries(self):
        values = np.random.default_rng(1).normal(1e6, 1, 1000)
        summary = statistics.summarize(np.r_[values, np.nan, np.inf])
        self.assertEqual((summary.count, summary.finite, summary.nan, summary.positive_infinite), (1002, 1000, 1, 1))
        self.assertAlmostEqual(summary.mean, values.mean())
        self.assertAlmostEqual(summary.variance, values.var(ddof=1), places=9)

    def test_histograms(self):
        values = np.random.default_rng(2).exponential(1, 1000)
        made = statistics.histogram(values, 10, (0, 2))
        counts, edges = np.histogram(values, 10, (0, 2))
        np.testing.assert_array_equal(made.counts, counts)
        np.testing.assert_allclose(made.edges, edges)
        self.assertEqual(made.above, (values > 2).sum())
        logarithmic = statistics.histogram(values, 5, (0.01, 10), log=True)
        np.testing.assert_allclose(logarithmic.edges, np.geomspace(0.01, 10, 6))
        self.assertEqual(int(statistics.histogram(values).counts.sum()), 1000)


class Images(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(3)
        self.reference = rng.random((16, 24, 3), np.float32)
        self.image = self.reference + rng.normal(0, 0.1, (16, 24, 3)).astype(np.float32)

    def test_metrics(self):
        a, b = self.image.astype(np.float64), self.reference.astype(np.float64)
        d = a - b
        expected = {"error": d, "absolute error": abs(d), "squared error": d * d}
        for name, values in expected.items():
            self.assertIn(name, image_metrics.METRICS)
            np.testing.assert_allclose(image_metrics.difference(self.image, self.reference, name), values, rtol=1e-5, atol=1e-7)
        self.assertAlmostEqual(image_metrics.mean(self.image, self.reference), float((d * d).mean()), places=7)
        for name in image_metrics.METRICS:
            self.assertEqual(image_metrics.mean(self.image, self.image, name), 0)
        with self.assertRaises(emca.InputError):
            image_metrics.difference(self.image, self.reference[1:])
        with self.assertRaises(ValueError):
            image_metrics.difference(self.image, self.reference, "taste")

    def test_flip(self):
        for hdr in (False, True):
            same = image_metrics.flip(self.reference, self.reference, hdr)
            self.assertEqual((same.error.shape, float(same.error.max())), ((16, 24), 0.0))
            other = image_metrics.flip(self.image, self.reference, hdr).error
            self.assertTrue(((other >= 0) & (other <= 1)).all() and other.mean() > 0)
        chosen = image_metrics.flip(self.image, self.reference, exposures=(-1, 1, 3))
        self.assertEqual(chosen.exposures, (-1, 1, 3))
        with self.assertRaises(emca.InputError):
            image_metrics.flip(self.image, self.reference, pixels_per_degree=-1)

    def test_statistics(self):
        found = image_metrics.statistics(self.image, (2, 3, 10, 9))
        self.assertEqual(list(found), ["R", "G", "B", "luminance"])
        self.assertAlmostEqual(found["G"]["mean"], float(self.image[3:9, 2:10, 1].astype(np.float64).mean()))
        self.assertEqual(found["R"]["negative"], int((self.image[3:9, 2:10, 0] < 0).sum()))

    def test_faults_and_fireflies(self):
        image = np.full((9, 9, 3), 0.5, np.float32)
        image[4, 5] = 100
        image[1, 2, 0] = np.nan
        image[7, 8, 1] = -1
        self.assertEqual(image_metrics.faulty_pixels(image), [(2, 1, "nan"), (8, 7, "negative")])
        fireflies = image_metrics.fireflies(emca.Image(image))
        self.assertEqual({(f.x, f.y) for f in fireflies}, {(5, 4), (2, 1)})

    def test_wrong_shapes(self):
        for wrong in (np.zeros(3), np.zeros((2, 2, 2, 2)), [[1, 2], [3]]):
            with self.assertRaises(ValueError):
                emca.Image(wrong)


if __name__ == "__main__":
    unittest.main()
