"""Recorded paths as numpy arrays.

A path set has *n* paths and, over all of them, *m* vertices. Quantities of paths have n entries, quantities of vertices m;
``first_vertex`` says where the vertices of each path begin. Arrays are views on the memory in which the reply arrived: no
copy, read-only, valid as long as they live, whatever becomes of connection and trace. What is computed says so.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, Dict, Iterable, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native
from .columns import Column, ColumnNames
from .errors import NotRecordedError
from .queries import Matches, masked, warn_of

if TYPE_CHECKING:
    from .table import Table

__all__ = ["PathSet", "Vertices", "Contributions", "NextEvents", "Splats", "merge"]


class _Part:
    """Some of a path set's arrays."""

    def __init__(self, paths: "PathSet"):
        self._paths = paths

    def _array(self, name: str, count: int, asked: str) -> np.ndarray:
        """A column of the compiled half; one that is empty although there are owners was not recorded."""
        array = self._paths._native.array(name)
        if len(array) == 0 and count > 0:
            raise NotRecordedError(f"No {asked} was recorded: the renderer does not give it, or the trace did not ask for it.")
        return array


class Vertices(_Part):
    """The vertices of all paths, path by path, those of a path by subpath and depth. m entries each."""

    def __len__(self) -> int:
        return self._paths._native.vertex_count

    def __getitem__(self, name: str) -> Column:
        """User data by the name under which the renderer recorded it; see :class:`Column`.

        Raises NotRecordedError if there is none of that name, or several types of it (``columns`` has them all).
        """
        return self._paths._column(True, name)

    def __contains__(self, name: object) -> bool:
        return any(column.name == name for column in self.columns)

    @property
    def columns(self) -> List[Column]:
        """All user data of vertices, by name and type."""
        return self._paths._columns[True]

    def keys(self) -> List[str]:
        """Names of all user data of vertices, each once."""
        return list(dict.fromkeys(column.name for column in self.columns))

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    @functools.cached_property
    def depth(self) -> np.ndarray:
        """(m,) int32 view: depth index as the renderer gave it; usually 0 is the camera, 1 the first hit."""
        return self._paths._native.array("depth")

    @functools.cached_property
    def flags(self) -> np.ndarray:
        """(m,) uint8 view: 1 has position, 2 environment, 4 has estimate, 8 has emission, 16 has surface, 32 has event,
        64 on the light subpath."""
        return self._paths._native.array("vertex_flags")

    def _flag(self, bit: int) -> np.ndarray:
        return (self.flags & bit) != 0

    @property
    def has_position(self) -> np.ndarray:
        """(m,) bool, computed. Where a quantity's flag is False, its entry in the array means nothing."""
        return self._flag(1)

    @property
    def is_environment(self) -> np.ndarray:
        """(m,) bool, computed: the path left the scene here."""
        return self._flag(2)

    @property
    def has_estimate(self) -> np.ndarray:
        """(m,) bool, computed."""
        return self._flag(4)

    @property
    def has_emission(self) -> np.ndarray:
        """(m,) bool, computed."""
        return self._flag(8)

    @property
    def has_surface(self) -> np.ndarray:
        """(m,) bool, computed."""
        return self._flag(16)

    @property
    def has_event(self) -> np.ndarray:
        """(m,) bool, computed."""
        return self._flag(32)

    @property
    def on_light_subpath(self) -> np.ndarray:
        """(m,) bool, computed: generated from a light."""
        return self._flag(64)

    @functools.cached_property
    def position(self) -> np.ndarray:
        """(m, 3) float32 view, world space, scene units; see ``has_position``. Raises NotRecordedError."""
        return self._array("position", len(self), "position of vertices")

    @functools.cached_property
    def estimate(self) -> np.ndarray:
        """(m, 3) float32 view, W/(sr m²): the path's camera-weighted sum up to here; see ``has_estimate``. Raises
        NotRecordedError."""
        return self._array("vertex_estimate", len(self), "estimate of vertices")

    @functools.cached_property
    def emission(self) -> np.ndarray:
        """(m, 3) float32 view, W/(sr m²): unweighted emitted radiance; see ``has_emission``. Raises NotRecordedError."""
        return self._array("emission", len(self), "emission of vertices")

    @functools.cached_property
    def mesh(self) -> np.ndarray:
        """(m,) int32 view: index into ``Connection.meshes()``; see ``has_surface``. Raises NotRecordedError."""
        return self._array("mesh", len(self), "surface of vertices")

    @functools.cached_property
    def face(self) -> np.ndarray:
        """(m,) int32 view: triangle of the mesh; see ``has_surface``. Raises NotRecordedError."""
        return self._array("face", len(self), "surface of vertices")

    @functools.cached_property
    def event(self) -> np.ndarray:
        """(m,) uint8 view: an :class:`emca.Event`; 0 where none was recorded. Raises NotRecordedError."""
        return self._array("event", len(self), "event of vertices")

    @functools.cached_property
    def lobe(self) -> np.ndarray:
        """(m,) uint8 view: a :class:`emca.Lobe`; see ``has_event``. Raises NotRecordedError."""
        return self._array("lobe", len(self), "event of vertices")

    @functools.cached_property
    def label(self) -> np.ndarray:
        """(m,) object array of texts, computed: the event's label, e.g. a material; None without. Raises NotRecordedError."""
        return self._paths._text(self._array("label", len(self), "label of events"))

    @functools.cached_property
    def path(self) -> np.ndarray:
        """(m,) int64, computed: the path that each vertex belongs to, as its position in the set."""
        first = self._paths.first_vertex.astype(np.int64)
        return np.repeat(np.arange(len(self._paths)), np.diff(first))

    def to_dataframe(self) -> "Any":
        """A pandas DataFrame with one row per vertex: path, depth, what was recorded, and user data (the last value where there
        are several). Copies. Raises ImportError without pandas."""
        from .dataframes import vertex_frame
        return vertex_frame(self._paths)

    def __repr__(self) -> str:
        return f"<Vertices: {len(self)}; user data: {', '.join(self.keys()) or 'none'}>"


class Contributions(_Part):
    """Light that techniques added, in the order of vertices; any number for each vertex."""

    @functools.cached_property
    def vertex(self) -> np.ndarray:
        """(k,) uint32 view: position of the vertex in ``Vertices``."""
        return self._paths._native.array("contribution_vertex")

    @functools.cached_property
    def value(self) -> np.ndarray:
        """(k, 3) float32 view, W/(sr m²): weighted by the camera path and by ``mis_weight``."""
        return self._paths._native.array("contribution_value")

    @functools.cached_property
    def mis_weight(self) -> np.ndarray:
        """(k,) float32 view; NaN where the renderer gave none."""
        return self._paths._native.array("contribution_mis_weight")

    @functools.cached_property
    def technique(self) -> np.ndarray:
        """(k,) object array of texts, computed: e.g. "light sampling"."""
        return self._paths._text(self._paths._native.array("contribution_technique"))

    @functools.cached_property
    def end(self) -> np.ndarray:
        """(k,) uint8 view: 0 follows from the vertex, 1 this vertex is on the light, 2 connected to a sampled point."""
        return self._paths._native.array("contribution_end")

    @property
    def path(self) -> np.ndarray:
        """(k,) int64, computed: position of the path."""
        return self._paths.vertices.path[self.vertex]

    def __len__(self) -> int:
        return len(self.vertex)

    def __repr__(self) -> str:
        return f"<Contributions: {len(self)}>"


class NextEvents(_Part):
    """Shadow tests of next-event estimation, in the order of vertices; any number for each vertex."""

    @functools.cached_property
    def vertex(self) -> np.ndarray:
        """(k,) uint32 view: position of the vertex in ``Vertices``."""
        return self._paths._native.array("next_event_vertex")

    @functools.cached_property
    def position(self) -> np.ndarray:
        """(k, 3) float32 view: the sampled point on the light, world space, scene units."""
        return self._paths._native.array("next_event_position")

    @functools.cached_property
    def visible(self) -> np.ndarray:
        """(k,) uint32 view: 1 if nothing was in between, else 0."""
        return self._paths._native.array("next_event_visible")

    def __len__(self) -> int:
        return len(self.vertex)

    def __repr__(self) -> str:
        return f"<NextEvents: {len(self)}>"


class Splats(_Part):
    """Light that paths added to pixels of the film, in the order of paths; any number for each path."""

    @functools.cached_property
    def path(self) -> np.ndarray:
        """(k,) uint32 view: position of the path."""
        return self._paths._native.array("splat_path")

    @functools.cached_property
    def pixel(self) -> np.ndarray:
        """(k, 2) uint32 view: column and row."""
        return self._paths._native.array("splat_pixel")

    @functools.cached_property
    def value(self) -> np.ndarray:
        """(k, 3) float32 view, in the film's units."""
        return self._paths._native.array("splat_value")

    def __len__(self) -> int:
        return len(self.path)

    def __repr__(self) -> str:
        return f"<Splats: {len(self)}>"


class PathSet(_Part):
    """Paths of one or more pixels, ordered by pixel (row, then column), sample and part. n entries each. Immutable; safe to
    use from several threads."""

    def __init__(self, native: Optional["_native.PathSet"] = None):
        super().__init__(self)
        self._native = native if native is not None else _native.PathSet()
        self.vertices = Vertices(self)
        self.contributions = Contributions(self)
        self.next_events = NextEvents(self)
        self.splats = Splats(self)

    def __len__(self) -> int:
        return self._native.path_count

    # -- quantities of paths

    @functools.cached_property
    def pixel(self) -> np.ndarray:
        """(n, 2) uint32 view: column and row; (0, 0) is the top-left corner."""
        return self._native.array("pixel")

    @functools.cached_property
    def sample(self) -> np.ndarray:
        """(n,) int64 view: sample index as the renderer gave it."""
        return self._native.array("sample")

    @functools.cached_property
    def part(self) -> np.ndarray:
        """(n,) int32 view: 0 unless a sample splits into several paths."""
        return self._native.array("part")

    @functools.cached_property
    def origin(self) -> np.ndarray:
        """(n, 3) float32 view, world space, scene units; see ``has_origin``. Raises NotRecordedError."""
        return self._array("origin", len(self), "origin of paths")

    @functools.cached_property
    def estimate(self) -> np.ndarray:
        """(n, 3) float32 view, W/(sr m²): the path's value before division by samples per pixel; see ``has_estimate``. Raises
        NotRecordedError."""
        return self._array("estimate", len(self), "final estimate of paths")

    @property
    def has_origin(self) -> np.ndarray:
        """(n,) bool, computed. Where it is False, ``origin`` means nothing."""
        return (self._native.array("path_flags") & 1) != 0

    @property
    def has_estimate(self) -> np.ndarray:
        """(n,) bool, computed. Where it is False, ``estimate`` means nothing."""
        return (self._native.array("path_flags") & 2) != 0

    @functools.cached_property
    def luminance(self) -> np.ndarray:
        """(n,) float32, computed: of the final estimate, after ITU-R BT.709; NaN where there is none."""
        return self._native.luminance()

    @functools.cached_property
    def depth(self) -> np.ndarray:
        """(n,) int32, computed: largest depth index with a position; 0 if none."""
        return self._native.path_depth()

    @functools.cached_property
    def first_vertex(self) -> np.ndarray:
        """(n + 1,) uint32 view: the vertices of path i are ``first_vertex[i]`` up to, without, ``first_vertex[i + 1]``."""
        first = self._native.array("first_vertex")
        return first if len(first) else np.zeros(1, np.uint32)

    def vertices_of(self, path: int) -> slice:
        """Where the vertices of a path are: ``paths.vertices.position[paths.vertices_of(3)]``. Raises IndexError."""
        count = len(self)
        if not -count <= path < count:
            raise IndexError(f"there is no path {path} among {count}")
        path %= count
        return slice(int(self.first_vertex[path]), int(self.first_vertex[path + 1]))

    # -- user data

    def __getitem__(self, name: str) -> Column:
        """User data of paths by name; see :class:`Column`. Raises NotRecordedError as ``Vertices`` does."""
        return self._column(False, name)

    def __contains__(self, name: object) -> bool:
        return any(column.name == name for column in self.columns)

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    @property
    def columns(self) -> List[Column]:
        """All user data of paths, by name and type."""
        return self._columns[False]

    def keys(self) -> List[str]:
        """Names of all user data of paths, each once."""
        return list(dict.fromkeys(column.name for column in self.columns))

    @functools.cached_property
    def strings(self) -> np.ndarray:
        """Object array of all texts of the set; columns of texts hold indices into it."""
        return np.array(self._native.strings(), dtype=object)

    @functools.cached_property
    def _columns(self) -> Dict[bool, List[Column]]:
        all_columns: Dict[bool, List[Column]] = {False: [], True: []}
        for index, (of_vertices, name, kind, count, dense) in enumerate(self._native.column_names()):
            all_columns[of_vertices].append(Column(self, index, ColumnNames(name, kind, count, dense, of_vertices)))
        return all_columns

    def _column(self, of_vertices: bool, name: str) -> Column:
        if not isinstance(name, str):
            raise TypeError(f"user data has names, not {type(name).__name__}; vertices_of(i) and subset([…]) take positions")
        found = [column for column in self._columns[of_vertices] if column.name == name]
        if len(found) == 1:
            return found[0]
        whose = "vertices" if of_vertices else "paths"
        if not found:
            names = ", ".join(dict.fromkeys(column.name for column in self._columns[of_vertices])) or "nothing"
            raise NotRecordedError(f"Nothing called {name!r} was recorded for {whose}; there is {names}.")
        kinds = " and ".join(column.type for column in found)
        raise NotRecordedError(f"{name!r} was recorded as {kinds}: choose out of {whose}' columns.", "ambiguous")

    def _text(self, indices: np.ndarray) -> np.ndarray:
        """Texts of indices into the string table; None beyond it."""
        table = np.append(self.strings, None)
        return table[np.minimum(indices, len(self.strings))]

    # -- queries

    def match(self, query: str) -> Matches:
        """Which paths a query selects, and what could not be told.

        Raises QueryError (with the position), or Cancelled.
        """
        return Matches(*_native.select(self._native, query))

    def select(self, query: str) -> np.ndarray:
        """Positions of the paths for which a query is true: ``paths.luminance[paths.select("depth > 3")]``.

        Returns (k,) uint32, ascending. Warns (QueryWarning) of names that no path has. Raises QueryError.
        """
        found = self.match(query)
        warn_of(found.missing)
        return found.paths

    def where(self, query: str) -> "PathSet":
        """The paths for which a query is true, as a set of their own. Copies them. Raises QueryError."""
        found = self.match(query)
        warn_of(found.missing)
        return self.subset(found.paths)

    def evaluate(self, expression: str) -> np.ma.MaskedArray:
        """The value of an expression for every path.

        Returns n entries; masked where the value is unknown, as something was not recorded. Numbers and spectra: float64;
        colours and vectors: (n, components) float64; conditions: bool; texts: object. Raises QueryError.
        """
        (kind, values, known), missing = _native.evaluate(self._native, expression)
        warn_of(missing)
        return masked(values, known, kind)

    def table(self, query: str) -> "Table":
        """Aggregates in groups: ``paths.table("count(), mean(luminance) group by depth")``; see :class:`Table`.

        Raises QueryError.
        """
        from .table import Table
        columns, rows, missing = _native.table(self._native, query)
        warn_of(missing)
        return Table(columns, rows)

    # -- other sets

    def subset(self, paths: Union[np.ndarray, Sequence[int], slice]) -> "PathSet":
        """Some of the paths as a set of their own. Copies them.

        Args:
            paths: ascending positions, a boolean mask of n entries, or a slice.
        Raises IndexError, ValueError.
        """
        if isinstance(paths, slice):
            positions = np.arange(len(self))[paths]
        else:
            positions = np.asarray(paths)
            if positions.dtype == bool:
                if positions.shape != (len(self),):
                    raise IndexError(f"a mask needs {len(self)} entries, not {positions.shape}")
                positions = np.flatnonzero(positions)
        if positions.size == 0:
            positions = positions.astype(np.int64)
        return PathSet(self._native.subset(positions))

    def find(self, pixel: Tuple[int, int], sample: int, part: int = 0) -> Optional[int]:
        """Position of a path, or None."""
        return self._native.find_path(pixel[0], pixel[1], sample, part)

    def to_dataframe(self) -> "Any":
        """A pandas DataFrame with one row per path: x, y, sample, part, depth, estimate as r, g, b and luminance, and user data
        (the last value where there are several). Copies. Raises ImportError without pandas."""
        from .dataframes import path_frame
        return path_frame(self)

    def __repr__(self) -> str:
        return f"<PathSet: {len(self)} paths, {len(self.vertices)} vertices; user data: {', '.join(self.keys()) or 'none'}>"


def merge(sets: Iterable[PathSet]) -> PathSet:
    """Paths of several sets in one, ordered. Where two hold the same path, that of the later set stays. Copies."""
    return PathSet(_native.merged([paths._native for paths in sets]))
