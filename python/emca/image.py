"""Images: what a render delivers, and what a session holds."""

from __future__ import annotations

import functools
from typing import Any, List, Optional, Sequence

import numpy as np

from . import _native
from .settings import RenderSettings

__all__ = ["Image"]


class Image(RenderSettings):
    """An image and the settings that it was rendered with.

    Make one of any array to put it into a session: ``emca.Image(array, title="reference")``.

    Args:
        color: (height, width), or (height, width, channels); copied as float32. Row 0 is the top.
        title: for people.
        channels: names; by default Y, R G B, R G B A.
    """

    seconds: float = 0.0  #: the renderer's own time, where it was rendered just now
    layers: Sequence[str] = ()  #: 3D data collected meanwhile: ``Connection.surface`` fetches it

    def __init__(self, color: Any, title: str = "", channels: Sequence[str] = ()):
        self._native = _native.make_image(color, list(channels), title)

    @classmethod
    def _of(cls, native: "_native.Image", seconds: float = 0.0, layers: Sequence[str] = ()) -> "Image":
        image = cls.__new__(cls)
        image._native = native
        image.seconds = seconds
        image.layers = list(layers)
        return image

    @functools.cached_property
    def pixels(self) -> np.ndarray:
        """(height, width, channels) float32, read-only view of all channels; row 0 is the top."""
        array = self._native.array("color")
        return array if array is not None else np.zeros((0, 0, 0), np.float32)

    @property
    def color(self) -> np.ndarray:
        """(height, width, 3) float32, read-only view: linear Rec. 709, mean radiance of each pixel, W/(sr m²). A grey image comes
        three times, still without a copy."""
        if self.pixels.shape[2] < 3:
            return np.broadcast_to(self.pixels[:, :, :1], self.pixels.shape[:2] + (3,))
        return self.pixels[:, :, :3]

    @functools.cached_property
    def samples(self) -> Optional[np.ndarray]:
        """(height, width) float32, read-only view: samples of each pixel; None of an image from elsewhere."""
        array = self._native.array("samples")
        return None if array is None else array[:, :, 0]

    @functools.cached_property
    def variance(self) -> Optional[np.ndarray]:
        """(height, width, 3) float32, read-only view: unbiased variance of a pixel's samples (not of their mean); None of an
        image from elsewhere."""
        return self._native.array("variance")

    @property
    def channels(self) -> List[str]:
        """Names of the channels of ``pixels``."""
        return self._native.channels()

    @property
    def title(self) -> str:
        """For people."""
        return self._settings["title"]

    @property
    def width(self) -> int:
        """In pixels."""
        return self.pixels.shape[1]

    @property
    def height(self) -> int:
        """In pixels."""
        return self.pixels.shape[0]

    @property
    def render_id(self) -> int:
        """Under which the server keeps it; 0 of an image from elsewhere."""
        return self._settings["render_id"]

    def __array__(self, dtype: Any = None) -> np.ndarray:
        return self.pixels if dtype is None else self.pixels.astype(dtype, copy=False)

    def __repr__(self) -> str:
        return f"<Image {self.title!r}: {self.width} x {self.height}, {', '.join(self.channels)}>"
