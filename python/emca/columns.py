"""User data: what a renderer recorded under names of its own."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, List, NamedTuple, Optional, Tuple

import numpy as np

if TYPE_CHECKING:
    from .paths import PathSet

__all__ = ["Column"]


class ColumnNames(NamedTuple):
    name: str
    type: str
    count: int
    dense: bool
    of_vertices: bool


class Column(np.lib.mixins.NDArrayOperatorsMixin):
    """Values of one name and one type, of paths or of vertices.

    ``values`` and ``owners`` are what was received, without copies: value i belongs to path (or vertex) ``owners[i]``. A column
    is *dense* if every owner has exactly one value.

    In expressions a column stands for one value per owner (``paths.vertices["BSDF pdf"] < 1e-4``), as
    :meth:`per_owner` gives it: dense columns as they are, without copying; of others the last value of each owner, NaN where it
    has none.
    """

    def __init__(self, paths: "PathSet", index: int, names: ColumnNames):
        self._paths = paths
        self._index = index
        self._names = names

    @property
    def name(self) -> str:
        """As the renderer called it."""
        return self._names.name

    @property
    def type(self) -> str:
        """"bool", "int", "int2", "int3", "float", "float2", "float3", "double", "double2", "double3", "color", "rgba", "text"
        or "spectrum"."""
        return self._names.type

    @property
    def dense(self) -> bool:
        """Whether every owner has exactly one value."""
        return self._names.dense

    @functools.cached_property
    def _arrays(self) -> Tuple[np.ndarray, Optional[np.ndarray], Optional[np.ndarray], Optional[np.ndarray]]:
        return self._paths._native.column_arrays(self._index)

    @property
    def values(self) -> np.ndarray:
        """The values, in the order of their owners and then of the calls: a read-only view.

        (count,), or (count, components) of vectors and colours. Texts: uint32 indices into ``PathSet.strings`` (``texts`` has
        them decoded). Spectra: all entries one after the other; ``offsets`` says where each begins.
        """
        return self._arrays[0]

    @functools.cached_property
    def owners(self) -> np.ndarray:
        """(count,) the path or vertex of each value; never decreases. A view, except of dense columns, where it is counted
        up."""
        owners = self._arrays[1]
        return owners if owners is not None else np.arange(self._names.count, dtype=np.uint32)

    @property
    def offsets(self) -> Optional[np.ndarray]:
        """Of spectra: (count + 1,) uint32 view, where each begins in ``values``; else None."""
        return self._arrays[2]

    @property
    def locations(self) -> Optional[np.ndarray]:
        """(count,) object array of texts: the source line that recorded each value; None if not asked for. Computed."""
        locations = self._arrays[3]
        return None if locations is None else self._paths._text(locations)

    @functools.cached_property
    def texts(self) -> np.ndarray:
        """(count,) object array: the values of a column of texts, decoded. Raises TypeError for other types."""
        if self.type != "text":
            raise TypeError(f"{self.name!r} holds values of the type {self.type}, no texts")
        return self._paths._text(self.values)

    @property
    def _owner_count(self) -> int:
        return len(self._paths.vertices) if self._names.of_vertices else len(self._paths)

    def has(self) -> np.ndarray:
        """(owners,) bool, computed: whether a path or vertex has a value."""
        if self.dense:
            return np.ones(self._owner_count, bool)
        found = np.zeros(self._owner_count, bool)
        found[self.owners] = True
        return found

    def per_owner(self, fill: Any = None) -> np.ndarray:
        """One value per path or vertex: the last one recorded.

        Args:
            fill: for those without one. By default NaN, or None of texts; integers and conditions have no such value, so that
                ``fill`` must be given for columns of them that are not dense.
        Returns:
            (owners,), or (owners, components). The view itself for dense columns of numbers, else a copy.
        Raises:
            ValueError: no ``fill`` where it is needed. TypeError: spectra, which may differ in length.
        """
        if self.type == "spectrum":
            raise TypeError(f"{self.name!r} holds spectra: use values and offsets")
        values = self.texts if self.type == "text" else self.values
        if self.dense:
            return values
        if fill is None and values.dtype.kind == "f":
            fill = np.nan
        if fill is None and values.dtype.kind in "iub":
            raise ValueError(f"{self.name!r} ({self.type}) has no value for some: say per_owner(fill=…), or use values and owners")
        out = np.full((self._owner_count,) + values.shape[1:], fill, dtype=values.dtype)
        # Of equal indices numpy keeps the last assignment, as a column's order wants it.
        out[self.owners] = values
        return out

    def __array__(self, dtype: Any = None) -> np.ndarray:
        array = self.per_owner()
        return array if dtype is None else array.astype(dtype, copy=False)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        return getattr(ufunc, method)(*(i.per_owner() if isinstance(i, Column) else i for i in inputs), **options)

    def __len__(self) -> int:
        return self._owner_count

    def __getitem__(self, which: Any) -> Any:
        return self.per_owner()[which]

    def __repr__(self) -> str:
        whose = "vertices" if self._names.of_vertices else "paths"
        how = "dense" if self.dense else f"{self._names.count} values"
        return f"<Column {self.name!r} of {self._owner_count} {whose}: {self.type}, {how}>"
