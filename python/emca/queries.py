"""What queries give back."""

from __future__ import annotations

import warnings
from typing import Any, List, NamedTuple, Sequence

import numpy as np

from .errors import QueryWarning

__all__ = ["Matches"]


class Matches(NamedTuple):
    """What a query found.

    Attributes:
        paths: (k,) positions of the paths for which it is true, ascending, uint32.
        unknown: paths for which it is neither true nor false, since something was not recorded.
        missing: names that the query reads and no path has.
    """

    paths: np.ndarray
    unknown: int
    missing: List[str]


def warn_of(missing: Sequence[str]) -> None:
    """Tells the caller of a method of PathSet of names that no path has."""
    if missing:
        names = ", ".join(repr(name) for name in missing)
        warnings.warn(f"The query reads {names}, which no path has.", QueryWarning, stacklevel=4)


def masked(values: Any, known: np.ndarray, kind: str) -> np.ma.MaskedArray:
    """Values of the query language: unknown ones are masked. Texts become an object array, conditions bool."""
    if kind == "text":
        data = np.array(values, dtype=object)
    elif kind == "condition":
        data = values != 0
    else:
        data = values
    mask = ~known
    if data.ndim > 1:
        mask = np.broadcast_to(mask[:, None], data.shape)
    return np.ma.MaskedArray(data, mask=mask)
