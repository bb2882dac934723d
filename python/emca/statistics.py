"""Statistics of values and paths: as in the explorer and on the command line."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native
from .paths import PathSet
from .trace import Trace

__all__ = ["outliers", "outliers_per_pixel", "Outliers", "EsdStep", "summarize", "Summary", "histogram", "Histogram"]


class EsdStep(NamedTuple):
    """A step of the generalized ESD test: the value farthest from the mean of those that were left.

    It is significant if statistic > critical.
    """

    index: int
    value: float
    mean: float
    deviation: float
    statistic: float
    critical: float


class Outliers(NamedTuple):
    """Which values stand out.

    Attributes:
        indices: (k,) uint32, positions of the outliers (of paths in their set), ascending. NaN and infinite ones are among them.
        considered: finite values that entered mean and deviation. not_finite: NaN and infinite ones.
        without_value: paths without final estimate; never outliers.
        mean, deviation: of all finite values; with "esd", of those that are no outliers.
        lower, upper: limits beyond which values are outliers; with "esd", the extremes of the others.
        steps: with "esd", in the order of removal.
        maximum_reached: with "esd", that all values tested are outliers, so that there may be more.
    """

    indices: np.ndarray
    considered: int
    not_finite: int
    without_value: int
    mean: float
    deviation: float
    lower: float
    upper: float
    steps: List[EsdStep]
    maximum_reached: bool


def outliers(of: Union[PathSet, Trace, Any], method: str = "deviation", quantity: str = "luminance", *, deviations: float = 3.0,
             upper_only: bool = False, maximum: int = 10, significance: float = 0.05) -> Outliers:
    """Paths, or values, that stand out from the rest.

    Args:
        of: paths, a trace, or an array of numbers.
        method: "deviation": beyond mean ± ``deviations`` · standard deviation. "esd": the generalized extreme studentized
            deviate test (Rosner 1983) for at most ``maximum`` outliers at the level ``significance``; outliers do not hide each
            other.
        quantity: of paths: "sample", "luminance", "red", "green", "blue", "depth" or "vertex count".
        upper_only: only large values are outliers.
    Raises:
        InputError: an option out of range. ValueError: no such method or quantity.
    """
    options = _outlier_options(method, deviations, upper_only, maximum, significance)
    if isinstance(of, Trace):
        of = of.paths
    return _as_outliers(_native.path_outliers(of._native, quantity, *options) if isinstance(of, PathSet) else _native.value_outliers(of, *options))


def outliers_per_pixel(of: Union[PathSet, Trace], method: str = "deviation", quantity: str = "luminance", *, deviations: float = 3.0,
                       upper_only: bool = False, maximum: int = 10, significance: float = 0.05) -> Dict[Tuple[int, int], Outliers]:
    """Paths that stand out from the others of their own pixel, as if each pixel of a region had been traced alone.

    Args: as of :func:`outliers`.
    Returns:
        By pixel (x, y), in their order. ``indices`` are positions in the whole set.
    Raises:
        InputError: an option out of range. ValueError: no such method or quantity.
    """
    options = _outlier_options(method, deviations, upper_only, maximum, significance)
    paths = of.paths if isinstance(of, Trace) else of
    return {pixel: _as_outliers(report) for pixel, report in _native.path_outliers_per_pixel(paths._native, quantity, *options)}


def _outlier_options(method: str, *parameters: Any) -> Tuple[Any, ...]:
    if method not in ("deviation", "esd"):
        raise ValueError(f'method is {method!r}, but must be "deviation" or "esd"')
    return (method == "esd", *parameters)


def _as_outliers(report: Dict[str, Any]) -> Outliers:
    report["steps"] = [EsdStep(*step) for step in report["steps"]]
    return Outliers(**report)


class Summary(NamedTuple):
    """Moments and extremes of the finite values; the variance is unbiased."""

    count: int
    finite: int
    nan: int
    positive_infinite: int
    negative_infinite: int
    min: float
    max: float
    mean: float
    variance: float
    deviation: float
    standard_error: float


def summarize(values: Any) -> Summary:
    """Moments and extremes of the finite values of an array; others are counted."""
    return Summary(**_native.summarize(values))


class Histogram(NamedTuple):
    """counts: (bins,) uint64. edges: (bins + 1,) float64. Others are counted: outside the range, and not finite."""

    counts: np.ndarray
    edges: np.ndarray
    below: int
    above: int
    nan: int
    positive_infinite: int
    negative_infinite: int


def histogram(values: Any, bins: int = 0, range: Optional[Sequence[float]] = None, log: bool = False) -> Histogram:
    """Counts in bins of equal width, linear or logarithmic.

    Args:
        bins: 0: after Freedman and Diaconis 1981.
        range: (first, last); None: all finite (log: positive) values.
        log: bins of equal ratio; values <= 0 are below.
    """
    return Histogram(*_native.histogram(values, bins, range, log))
