"""How images differ, and what stands out in them: as in the explorer and on the command line.

Images are :class:`emca.Image` or arrays of shape (height, width) or (height, width, channels), linear Rec. 709, row 0 at the top.
"""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _native

__all__ = ["METRICS", "difference", "mean", "flip", "Flip", "statistics", "faulty_pixels", "fireflies", "FaultyPixel", "Firefly"]

#: Names of the metrics of :func:`difference`. d = image - reference; the small constants keep dark pixels from dominating:
#: "relative absolute error" is |d| / (|reference| + 0.01), "relative squared error" d² / (reference² + 0.01), "symmetric
#: absolute error" 2 |d| / (|image| + |reference| + 0.02). :func:`flip` says more about FLIP.
METRICS: Tuple[str, ...] = tuple(_native.metric_names)


def difference(image: Any, reference: Any, metric: str = "error") -> np.ndarray:
    """A metric of each pixel and channel: (height, width, 3) float32, or (height, width, 1) if either image is grey.

    Where both have the same infinity, or both NaN, it is 0. Raises InputError if sizes differ, ValueError for an unknown metric.
    """
    return _native.difference(image, reference, metric)


def mean(image: Any, reference: Any, metric: str = "squared error") -> float:
    """Mean of a metric over all pixels and channels with finite values. Raises as :func:`difference`."""
    values = difference(image, reference, metric)
    finite = values[np.isfinite(values)]
    return float(finite.mean(dtype=np.float64)) if finite.size else 0.0


class Flip(NamedTuple):
    """error: (height, width) float32 in [0, 1], 0 is no visible difference. exposures: (first, last, count) in stops, of HDR."""

    error: np.ndarray
    exposures: Tuple[float, float, int]


def flip(image: Any, reference: Any, hdr: bool = True, pixels_per_degree: Optional[float] = None,
         exposures: Optional[Sequence[float]] = None) -> Flip:
    """FLIP: the difference that a person sees who alternates between two images on a screen (Andersson et al. 2020, 2021).

    Args:
        hdr: over a series of exposures; False: as a screen shows the images, values above 1 clipped.
        pixels_per_degree: of the visual field; by default some 67, the papers' screen.
        exposures: (first, last, count) in stops; by default from the reference.
    Raises InputError if sizes differ or an argument is out of range.
    """
    error, used = _native.flip(image, reference, hdr, pixels_per_degree, exposures)
    return Flip(error[:, :, 0], used)


def statistics(image: Any, rect: Optional[Sequence[int]] = None) -> Dict[str, Dict[str, Any]]:
    """Counts and moments of each channel, and of "luminance" if there are at least three.

    Args:
        rect: (x0, y0, x1, y1), clipped to the image; None: all of it.
    Returns:
        By channel: count, finite, nan, positive_infinite, negative_infinite, negative, min, max, mean, variance (unbiased),
        deviation, standard_error.
    """
    return {channel.pop("channel"): channel for channel in _native.image_statistics(image, rect)}


class FaultyPixel(NamedTuple):
    """kind: "nan", "infinite" or "negative"."""

    x: int
    y: int
    kind: str


class Firefly(NamedTuple):
    """A pixel that stands out. neighbours: median luminance around it; ratio: how much brighter the pixel is."""

    x: int
    y: int
    luminance: float
    neighbours: float
    ratio: float


def faulty_pixels(image: Any, maximum: int = 1000) -> List[FaultyPixel]:
    """Pixels with a NaN, infinite or negative channel, in reading order."""
    return [FaultyPixel(*found) for found in _native.faulty_pixels(image, maximum)]


def fireflies(image: Any, radius: int = 2, ratio: float = 10.0, maximum: int = 100) -> List[Firefly]:
    """Pixels that are at least ``ratio`` times as bright as their neighbourhood, most striking first.

    Args:
        radius: of the neighbourhood, in pixels: 2 is a window of 5 x 5.
    """
    return [Firefly(*found) for found in _native.fireflies(image, radius, ratio, maximum)]
