"""Paths as pandas tables. pandas is optional: only these functions need it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List

import numpy as np

from .errors import NotRecordedError

if TYPE_CHECKING:
    from .columns import Column
    from .paths import PathSet
    from .table import Table

_COMPONENTS = {"int2": "xy", "float2": "xy", "double2": "xy", "int3": "xyz", "float3": "xyz", "double3": "xyz", "color": "rgb", "rgba": "rgba"}


def _pandas() -> Any:
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_dataframe() needs pandas, which is not installed: install the package python3-pandas (or pandas "
                          "with pip), or use the arrays as they are") from error
    return pandas


def _components(out: Dict[str, np.ndarray], name: str, letters: str, array: np.ndarray, there: np.ndarray) -> None:
    for i, letter in enumerate(letters):
        values = array[:, i]
        out[f"{name}.{letter}" if name else letter] = values if there.all() else np.where(there, values, np.nan)


def _optional(out: Dict[str, np.ndarray], part: Any, attribute: str, name: str, letters: str, there: np.ndarray) -> None:
    try:
        _components(out, name, letters, getattr(part, attribute), there)
    except NotRecordedError:
        pass


def _add_user_data(pandas: Any, out: Dict[str, Any], columns: List["Column"]) -> None:
    names = [column.name for column in columns]
    for column in columns:
        name = column.name if names.count(column.name) == 1 else f"{column.name} ({column.type})"
        if name in out:
            name = f"data.{name}"
        if column.type == "spectrum":
            continue  # no scalar: values and offsets have them
        if column.dense or column.values.dtype.kind == "f" or column.type == "text":
            values = column.per_owner()
        else:
            values = np.where(column.has() if column.values.ndim == 1 else column.has()[:, None], column.per_owner(fill=0).astype(object), None)
        if values.ndim > 1:
            for i, letter in enumerate(_COMPONENTS[column.type]):
                out[f"{name}.{letter}"] = values[:, i]
        elif column.dense or values.dtype != object or column.type == "text":
            out[name] = values
        else:  # integers and conditions with gaps have types of their own in pandas
            out[name] = pandas.array(values, dtype="boolean" if column.type == "bool" else "Int64")


def path_frame(paths: "PathSet") -> Any:
    pandas = _pandas()
    out: Dict[str, Any] = {"x": paths.pixel[:, 0], "y": paths.pixel[:, 1], "sample": paths.sample, "part": paths.part, "depth": paths.depth}
    _optional(out, paths, "estimate", "", "rgb", paths.has_estimate)
    out["luminance"] = paths.luminance
    _optional(out, paths, "origin", "origin", "xyz", paths.has_origin)
    _add_user_data(pandas, out, paths.columns)
    return pandas.DataFrame(out)


def vertex_frame(paths: "PathSet") -> Any:
    from .events import Event, Lobe
    pandas = _pandas()
    vertices = paths.vertices
    out: Dict[str, Any] = {"path": vertices.path, "depth": vertices.depth, "light subpath": vertices.on_light_subpath}
    _optional(out, vertices, "position", "", "xyz", vertices.has_position)
    out["environment"] = vertices.is_environment
    try:
        event, lobe = (np.array([item.name.rstrip("_") for item in kind], dtype=object) for kind in (Event, Lobe))
        out["event"], out["lobe"] = event[vertices.event], lobe[vertices.lobe]
        out["label"] = vertices.label
    except NotRecordedError:
        pass
    try:
        there = vertices.has_surface
        out["mesh"], out["face"] = (pandas.array(np.where(there, a.astype(object), None), dtype="Int64") for a in (vertices.mesh, vertices.face))
    except NotRecordedError:
        pass
    _optional(out, vertices, "estimate", "estimate", "rgb", vertices.has_estimate)
    _optional(out, vertices, "emission", "emission", "rgb", vertices.has_emission)
    _add_user_data(pandas, out, vertices.columns)
    return pandas.DataFrame(out)


def table_frame(table: "Table") -> Any:
    pandas = _pandas()
    frame = pandas.DataFrame(table.rows(), columns=list(table))
    return frame.set_index(table.group_keys) if table.group_keys else frame
