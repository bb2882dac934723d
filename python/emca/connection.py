"""A renderer that serves, seen from a script."""

from __future__ import annotations

import operator
from dataclasses import dataclass, field
from types import TracebackType
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Type, Union

from . import _native
from .errors import InputError
from .image import Image
from .scene import Camera, LayerDescription, Mesh, Surface
from .trace import Trace

__all__ = ["connect", "Connection", "ServerInfo"]

Progress = Optional[Callable[[float], Any]]
_KEEP = {"all": 0, "none": 1, "brightest": 2}


@dataclass(frozen=True)
class ServerInfo:
    """What a renderer and its server say about themselves.

    Sizes in pixels; ``samples_per_pixel``, ``seed``, ``integrator`` and ``sampler`` are the scene's own choice.
    ``latest_render`` is the id of the newest finished image, 0 if none; ``layers`` are the 3D data that a render can collect, and
    ``surface_render`` the newest render that has some.
    """

    renderer: str
    scene: str
    integrator: str
    sampler: str
    width: int
    height: int
    samples_per_pixel: int
    seed: int
    triangle_count: int
    mesh_count: int
    maximum_samples_per_pixel: int
    maximum_pixels_per_trace: int
    capabilities: List[str]
    tools: List[str]
    latest_render: int
    layers: List[LayerDescription]
    surface_render: int
    _native: Any = field(default=None, repr=False, compare=False)

    @classmethod
    def _of(cls, native: "_native.ServerInfo") -> "ServerInfo":
        values = native.values()
        values["layers"] = [LayerDescription(**layer) for layer in values["layers"]]
        return cls(**values, _native=native)


def connect(address: str = "localhost:50013", token: str = "", timeout: float = 5.0, silence: float = 30.0) -> "Connection":
    """Opens a connection to a renderer.

    Args:
        address: "host:port", "[v6]:port", "host" or "port".
        token: if the server asks for one.
        timeout: seconds to wait for the server's greeting.
        silence: longest silence of the server during a request, in seconds; it reports progress while it works.
    Raises:
        ConnectionError: nobody listens there, something else does, or it refuses. TimeoutError. InputError: no address.
    """
    return Connection(_native.connect(str(address), token, timeout, silence))


class Connection:
    """One open connection to a renderer; :func:`connect` makes it. A context manager that closes it.

    Every method waits for its answer with the interpreter's lock released; any thread may call, and several calls may run at once.
    Ctrl-C cancels the request and raises KeyboardInterrupt. ``progress`` is called with the fraction done, in the calling thread;
    if it raises, the request is cancelled, too.

    All methods raise ConnectionError or TimeoutError if the connection was lost, and what the server replies: InputError for
    settings that it cannot do, ServerError if the renderer fails.
    """

    def __init__(self, native: "_native.Connection"):
        self._native = native

    def __enter__(self) -> "Connection":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], value: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection. Calls that wait in other threads raise ConnectionError. What was received stays."""
        self._native.close()

    @property
    def is_open(self) -> bool:
        """False once it was closed or lost."""
        return self._native.is_open()

    @property
    def address(self) -> str:
        """"host:port"."""
        return self._native.address()

    @property
    def info(self) -> ServerInfo:
        """What the renderer says about itself, asked anew each time."""
        return ServerInfo._of(self._native.info())

    def camera(self) -> Camera:
        """Where the image is taken from."""
        return Camera(**self._native.camera())

    def meshes(self, progress: Progress = None) -> List[Mesh]:
        """The scene, world space. Arrays are read-only views on what was received."""
        return [Mesh(**mesh) for mesh in self._native.meshes(progress)]

    def render(self, spp: Optional[int] = None, seed: Optional[int] = None, integrator: str = "", sampler: str = "",
               layers: Sequence[str] = (), surface_budget: int = 0, progress: Progress = None) -> Image:
        """Renders the whole image. What is not given is as the scene says.

        Args:
            spp: samples per pixel.
            layers: 3D data to collect on surfaces meanwhile, names out of ``info.layers``; then see :meth:`surface`.
            surface_budget: bytes for them; 0: the server's default.
            progress: called with the fraction done in [0, 1].
        """
        if isinstance(layers, str):
            raise InputError("layers is a list of names, not one text")
        native, seconds, collected = self._native.render(_count("spp", spp), seed, integrator, sampler, list(layers), surface_budget, progress)
        return Image._of(native, seconds, collected)

    def surface(self, layers: Sequence[str] = (), render: Union[Image, int, None] = None, progress: Progress = None) -> Surface:
        """3D data that a render has collected on surfaces.

        Args:
            layers: names; empty: all that were collected.
            render: an image, or its render id; None: the newest one that has layers.
        """
        if isinstance(layers, str):
            raise InputError("layers is a list of names, not one text")
        return Surface(self._native.surface(_render_id(render) or 0, list(layers), progress))

    def pixel(self, x: int, y: int, where: str = "", *, progress: Progress = None, **options: Any) -> Trace:
        """Traces one pixel again and returns what the renderer recorded.

        Args:
            x, y: column and row; (0, 0) is the top-left pixel.
            where: a query; only paths for which it is true come, and only what the query reads is recorded on the way to it.
            spp, seed, integrator, sampler: by default those of the render that it is compared with, else the scene's.
            columns: names of the quantities wanted ("position", "estimate", …, and user data); by default all.
            render: the image (or its id) that the replay is compared with; by default the latest of the same settings.
            keep: with a query, which of its paths the reply brings: "all", "none" (counts alone) or "brightest".
            top: how many, with "brightest" (which it implies).
            budget: bytes of the recording; 0: the server's default.
            locations: also record the source line of each value.
        Raises:
            InputError: the pixel is outside the image. QueryError: with the position in ``where``.
        """
        return Trace(self._native.trace_pixel(_index("x", x), _index("y", y), _options(where, **options), progress))

    def pixels(self, pixels: Sequence[Tuple[int, int]], where: str = "", *, progress: Progress = None, **options: Any) -> Trace:
        """Traces a list of pixels, (x, y) each, or an array of shape (k, 2); otherwise as :meth:`pixel`."""
        return Trace(self._native.trace_pixels(pixels, _options(where, **options), progress))

    def region(self, rect: Sequence[Any], where: str = "", *, progress: Progress = None, **options: Any) -> Trace:
        """Traces a rectangle of pixels; otherwise as :meth:`pixel`.

        Args:
            rect: ((x0, y0), (x1, y1)) or (x0, y0, x1, y1): columns x0 up to, without, x1, and rows y0 up to, without, y1.
        """
        flat = [value for item in rect for value in (item if hasattr(item, "__len__") else (item,))]
        if len(flat) != 4:
            raise InputError(f"A rectangle is ((x0, y0), (x1, y1)), not {rect!r}.")
        corners = [_index("a corner", value) for value in flat]
        return Trace(self._native.trace_rect(corners, _options(where, **options), progress))

    def ask_tool(self, tool: str, request: bytes, progress: Progress = None) -> bytes:
        """Sends bytes of a server tool's own schema and returns its answer. ``info.tools`` names them."""
        return self._native.ask_tool(tool, bytes(request), progress)

    def quit_server(self) -> None:
        """Asks the server to end. Raises InputError unless it was started so that clients may end it."""
        self._native.quit_server()

    def __repr__(self) -> str:
        return f"<Connection to {self.address}{'' if self.is_open else ', closed'}>"


def _index(name: str, value: Any) -> int:
    number = operator.index(value)
    if not 0 <= number <= 0xFFFFFFFF:
        raise InputError(f"{name} is {number}: columns and rows count from 0.", "pixelOutOfRange")
    return number


def _count(name: str, value: Optional[int]) -> int:
    if value is None:
        return 0
    number = operator.index(value)
    if not 1 <= number <= 0xFFFFFFFF:
        raise InputError(f"{name} is {number}, but must be at least 1.")
    return number


def _render_id(render: Union[Image, int, None]) -> Optional[int]:
    return render.render_id if isinstance(render, Image) else render


def _options(where: str, spp: Optional[int] = None, seed: Optional[int] = None, integrator: str = "", sampler: str = "",
             columns: Sequence[str] = (), render: Union[Image, int, None] = None, keep: Optional[str] = None,
             top: Optional[int] = None, budget: int = 0, locations: bool = False) -> Dict[str, Any]:
    """Keyword arguments of the methods that trace, for the compiled half."""
    if isinstance(columns, str):
        raise InputError("columns is a list of names, not one text")
    if keep is None:
        keep = "all" if top is None else "brightest"
    if keep not in _KEEP:
        raise InputError(f'keep is {keep!r}, but must be "all", "none" or "brightest".')
    if top is not None and keep != "brightest":
        raise InputError('top goes with keep="brightest".')
    if (keep != "all") and not where:
        raise InputError(f"keep={keep!r} needs a query; where=\"true\" takes every path.")
    if where:
        _native.query_columns(where)  # so that errors come with their position, and nothing is sent
    return {"where": where, "spp": _count("spp", spp), "seed": seed, "integrator": integrator, "sampler": sampler,
            "columns": list(columns), "render": _render_id(render), "keep": _KEEP[keep], "top": _count("top", top),
            "budget": budget, "locations": locations}
