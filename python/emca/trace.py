"""What a trace brings."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

import numpy as np

from . import _native
from .paths import PathSet
from .settings import RenderSettings

__all__ = ["Trace", "Replay", "MatchCounts"]

Rgb = Tuple[float, float, float]


@dataclass(frozen=True)
class Replay:
    """How a replayed pixel compares with the rendered one.

    Attributes:
        verdict: "exact" (equal bits), "close" (relative error up to 1e-4), "different", or "unknown": no such render.
        sums: "matches" if the recorded estimates add up to the pixel, else "differs" or "unknown".
        rendered: the pixel in the image; black if the verdict is unknown.
        replayed: the pixel as the renderer's film code computes it, just now.
    """

    verdict: str
    sums: str
    rendered: Rgb
    replayed: Rgb


@dataclass(frozen=True, eq=False)
class MatchCounts:
    """What the query of a trace found, counted beside the renderer.

    Attributes:
        paths: replayed. matched: for which the query is true. unknown: for which it is neither true nor false.
        omitted: matched, but not in the reply: not asked for, or beyond the budget.
        missing: names that the query reads and no path had.
        matched_of_pixel: (pixels,) uint32 view. sum_of_pixel: (pixels, 3) float32 view, sum of the final estimates of the
            matches, not divided by samples.
    """

    paths: int
    matched: int
    unknown: int
    omitted: int
    missing: List[str]
    matched_of_pixel: np.ndarray
    sum_of_pixel: np.ndarray

    def __repr__(self) -> str:
        return f"<MatchCounts: {self.matched} of {self.paths} paths; {self.unknown} unknown, {self.omitted} omitted>"


class Trace(RenderSettings):
    """Recorded paths of the pixels that were asked for, and how the replay went."""

    def __init__(self, native: "_native.Trace"):
        self._native = native
        #: The recorded paths, a :class:`PathSet`.
        self.paths = PathSet(native.paths())

    @property
    def pixels(self) -> np.ndarray:
        """(k, 2) uint32 view: the pixels as asked, column and row."""
        return self._native.pixels()

    @functools.cached_property
    def replays(self) -> List[Replay]:
        """One per pixel, in the order of ``pixels``."""
        return [Replay(*replay) for replay in self._native.replays()]

    @property
    def replay(self) -> Replay:
        """Of a trace of one pixel. Raises ValueError if there are several."""
        if len(self.replays) != 1:
            raise ValueError(f"this trace has {len(self.replays)} pixels: see replays")
        return self.replays[0]

    @property
    def verdict(self) -> str:
        """The worst verdict of all pixels: "exact", "close", "different"; "unknown" if any is."""
        order = ["exact", "close", "different", "unknown"]
        return max((replay.verdict for replay in self.replays), key=order.index, default="unknown")

    @functools.cached_property
    def matches(self) -> Optional[MatchCounts]:
        """What the query found; None if there was none."""
        counts = self._native.matches()
        return None if counts is None else MatchCounts(**counts)

    @functools.cached_property
    def stats(self) -> Dict[str, int]:
        """What the recording had to leave out: dropped_without_path, dropped_without_vertex, dropped_by_budget (values),
        paths_not_kept, and the bytes in use at its end."""
        return self._native.stats()

    @property
    def render_id(self) -> int:
        """The image that it was compared with; 0 if none."""
        return self._settings["render_id"]

    @property
    def render_seconds(self) -> float:
        """The renderer's own time."""
        return self._settings["render_seconds"]

    @property
    def total_seconds(self) -> float:
        """From sending the request to the decoded reply."""
        return self._settings["total_seconds"]

    def __repr__(self) -> str:
        return f"<Trace of {len(self.pixels)} pixels: {len(self.paths)} paths, {len(self.paths.vertices)} vertices, replay {self.verdict}>"
