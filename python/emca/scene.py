"""Camera, meshes, and 3D data on surfaces: the same classes for what is received and for what a renderer gives."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native

__all__ = ["Color", "ColorA", "Camera", "Mesh", "LayerDescription", "SurfaceLayer", "Surface"]

Vector = Tuple[float, float, float]


class Color(NamedTuple):
    """Linear Rec. 709 RGB. Marks a recorded value as a colour, which three bare numbers are not."""

    r: float
    g: float
    b: float


class ColorA(NamedTuple):
    """As :class:`Color`, with opacity in [0, 1], not premultiplied."""

    r: float
    g: float
    b: float
    a: float = 1.0


@dataclass
class Camera:
    """Where the image was taken from, as far as a viewer needs it. World space, scene units.

    ``direction`` and ``up`` are unit vectors, orthogonal; a renderer's need not be: they are made so. The field of view is in
    degrees, from the top to the bottom edge of the image.
    """

    position: Vector = (0.0, 0.0, 0.0)
    direction: Vector = (0.0, 0.0, -1.0)
    up: Vector = (0.0, 1.0, 0.0)
    vertical_field_of_view: float = 45.0
    kind: str = "perspective"  #: or "spherical", "orthographic", "other"
    near_clip: float = 0.01
    far_clip: float = 1e4
    focus_distance: float = 0.0  #: of a thin lens; 0 for a pinhole
    aperture_radius: float = 0.0  #: of a thin lens; 0 for a pinhole
    right_handed: bool = True


@dataclass(eq=False)
class Mesh:
    """One shape as triangles.

    Its place in the list of meshes is the ``mesh`` of vertices, a triangle's place in ``triangles`` the ``face``.

    Attributes:
        positions: (n, 3) float32, world space, scene units.
        triangles: (m, 3) integers below n, counter-clockwise seen from the front.
        name, material: as the scene calls them; may be empty.
        diffuse: rough colour for display, in [0, 1].
        emission: radiance it emits, W/(sr m²); black if none.
    """

    positions: np.ndarray
    triangles: np.ndarray
    name: str = ""
    material: str = ""
    diffuse: Vector = (0.5, 0.5, 0.5)
    emission: Vector = (0.0, 0.0, 0.0)

    @property
    def is_emitter(self) -> bool:
        """Whether it emits light."""
        return any(c != 0 for c in self.emission)

    def __repr__(self) -> str:
        return f"<Mesh {self.name!r}: {len(self.positions)} positions, {len(self.triangles)} triangles>"


@dataclass(frozen=True)
class LayerDescription:
    """How a layer of 3D data introduces itself. ``kind`` is "mean", "mean color", "sum" or "density"."""

    name: str
    kind: str
    unit: str = ""
    description: str = ""


@dataclass(frozen=True, eq=False)
class SurfaceLayer:
    """One layer's values.

    Attributes:
        values: read-only view, float32: (faces,), or (faces, 3) of kind "mean color". One entry per refined face of all
            meshes in order. Where nothing was added: NaN of means, 0 of sums and densities.
        samples: how many values were added; exact.
        total: their sum (of colours: of their luminances).
    """

    name: str
    kind: str
    unit: str
    description: str
    values: np.ndarray
    samples: int
    total: float

    def __repr__(self) -> str:
        return f"<SurfaceLayer {self.name!r}: {self.kind}, {len(self.values)} faces, {self.samples} samples>"


class Surface(Mapping[str, SurfaceLayer]):
    """3D data collected on surfaces: a mapping from names to layers, all on one subdivision of the scene's meshes."""

    def __init__(self, native: "_native.Surface"):
        self._native = native
        self._layers = {layer["name"]: SurfaceLayer(**layer) for layer in native.layers()}

    def __getitem__(self, name: str) -> SurfaceLayer:
        return self._layers[name]

    def __iter__(self):
        return iter(self._layers)

    def __len__(self) -> int:
        return len(self._layers)

    @property
    def points(self) -> np.ndarray:
        """(faces,) float32 view: places located on each refined face; 0 where the value was filled in from neighbours."""
        return self._native.points()

    @property
    def counts(self) -> Dict[str, int]:
        """What is to be said besides values: points, coarse, invalid, refused_divisions, bytes_used, budget_bytes."""
        return self._native.counts()

    def faces_of(self, mesh: int) -> slice:
        """Where the refined faces of a mesh are in ``values`` and ``points``; empty if no sample landed on it."""
        first, count = self._native.faces()[mesh]
        return slice(first, first + count)

    def refined(self, mesh: int, base: Mesh) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The refined triangles of a mesh.

        Args:
            mesh: its index.
            base: the mesh itself, out of ``Connection.meshes()``.
        Returns:
            positions (n, 3) float32 in world space; triangles (k, 3) uint32; for each of them its triangle in ``base``, (k,)
            uint32. The k triangles are those of ``values[faces_of(mesh)]``, in order.
        """
        return self._native.refined(mesh, base)

    def __repr__(self) -> str:
        return f"<Surface: {', '.join(self)}>"
