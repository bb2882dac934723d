"""What images and traces were made with."""

from __future__ import annotations

import functools
from typing import Any


class RenderSettings:
    """What an image was rendered, or a trace replayed, with."""

    _native: Any

    @functools.cached_property
    def _settings(self) -> dict:
        return self._native.settings()

    @property
    def samples_per_pixel(self) -> int:
        """0 if unknown."""
        return self._settings["samples_per_pixel"]

    @property
    def seed(self) -> int:
        """Another one gives another noise of the same image."""
        return self._settings["seed"]

    @property
    def integrator(self) -> str:
        """Its name; may be empty."""
        return self._settings["integrator"]

    @property
    def sampler(self) -> str:
        """Its name; may be empty."""
        return self._settings["sampler"]
