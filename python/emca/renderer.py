"""The other direction: a renderer written in Python, served to explorers, command lines and scripts."""

from __future__ import annotations

import abc
import atexit
import weakref
from dataclasses import asdict, dataclass, field
from types import TracebackType
from typing import Any, Callable, List, Optional, Sequence, Tuple, Type, Union

import numpy as np

from . import _native
from ._native import PathRecorder, Recording, RequestMonitor, SeedMap
from .image import Image
from .scene import Camera, Mesh

__all__ = ["Renderer", "RendererInfo", "RenderSettings", "Server", "serve", "recorder", "PathRecorder", "Recording", "RequestMonitor", "SeedMap"]

Rgb = Sequence[float]


@dataclass
class RendererInfo:
    """What a renderer says about itself.

    Attributes:
        width, height: of the image, in pixels.
        samples_per_pixel, integrator, sampler, seed: the scene's own choice.
        concurrent: methods may run in several threads at once, so that a click is answered while an image renders. If False, one
            call follows the other.
        deterministic: the same settings give the same bits, so that a replay can be exact.
        paths_reach_any_pixel: paths may add to any pixel (light tracing, Metropolis): implement ``render_pixels``.
    """

    width: int
    height: int
    renderer: str = "a renderer in Python"
    scene: str = ""
    samples_per_pixel: int = 1
    integrator: str = ""
    sampler: str = ""
    seed: int = 0
    concurrent: bool = False
    deterministic: bool = True
    paths_reach_any_pixel: bool = False
    capabilities: List[str] = field(default_factory=list)


@dataclass(frozen=True)
class RenderSettings:
    """What to render with: what a client asked for, and the scene's own choice for the rest."""

    samples_per_pixel: int
    integrator: str
    sampler: str
    seed: int


class Renderer(abc.ABC):
    """The one class that an adapter implements.

    The server calls it from threads of its own, with the interpreter's lock; one call at a time unless ``info().concurrent``. An
    exception that escapes becomes an error reply with its text and line, and its traceback goes to the logger "emca". Return early,
    by ``raise emca.Cancelled()``, when ``monitor.cancelled`` is true.
    """

    @abc.abstractmethod
    def info(self) -> RendererInfo:
        """Called once, when the server starts: what it says must stay true."""

    @abc.abstractmethod
    def camera(self) -> Camera:
        """Where the image is taken from."""

    @abc.abstractmethod
    def meshes(self) -> Sequence[Mesh]:
        """The scene, world space. Its order gives the mesh indices of ``set_intersection_surface``."""

    @abc.abstractmethod
    def render_image(self, settings: RenderSettings, monitor: RequestMonitor) -> Any:
        """Renders the whole image; nothing is recorded meanwhile.

        Returns an array of shape (height, width, 3), mean radiance, or a tuple (color, samples, variance) of such arrays, where
        samples has the shape (height, width) and either may be None.
        """

    @abc.abstractmethod
    def render_pixel(self, pixel: Tuple[int, int], settings: RenderSettings, recording: Recording, monitor: RequestMonitor) -> Rgb:
        """Renders one pixel again with the same settings, bit by bit as ``render_image`` does, while ``emca.recorder()`` listens.

        Threads that it starts besides record inside ``with recording.scope(pixel):``. Returns the pixel's three numbers.
        """

    def render_pixels(self, pixels: Sequence[Tuple[int, int]], settings: RenderSettings, recording: Recording,
                      monitor: RequestMonitor) -> Any:
        """For methods whose paths may hit any pixel: one pass for all pixels, which records splats. Optional.

        Returns an array of shape (len(pixels), 3). By default ``render_pixel`` is called for each of them.
        """
        raise NotImplementedError


class _Adapter:
    """A renderer as the compiled half calls it: plain values only."""

    def __init__(self, renderer: Renderer):
        self._renderer = renderer
        self._info: Optional[RendererInfo] = None
        self.has_render_pixels = type(renderer).render_pixels is not Renderer.render_pixels

    def info(self) -> dict:
        self._info = self._renderer.info()
        return asdict(self._info)

    def camera(self) -> Camera:
        return self._renderer.camera()

    def meshes(self) -> Sequence[Mesh]:
        return self._renderer.meshes()

    def _settings(self, asked: Tuple[int, str, str, Optional[int]]) -> RenderSettings:
        info = self._info
        assert info is not None
        spp, integrator, sampler, seed = asked
        return RenderSettings(spp or info.samples_per_pixel, integrator or info.integrator, sampler or info.sampler,
                              info.seed if seed is None else seed)

    def render_image(self, asked: Any, monitor: RequestMonitor) -> Tuple[Any, Any, Any]:
        image = self._renderer.render_image(self._settings(asked), monitor)
        if isinstance(image, Image):
            return image.color, image.samples, image.variance
        if isinstance(image, tuple):
            return (*image, None, None)[:3]
        return image, None, None

    def render_pixel(self, x: int, y: int, asked: Any, recording: Recording, monitor: RequestMonitor) -> Rgb:
        return self._renderer.render_pixel((x, y), self._settings(asked), recording, monitor)

    def render_pixels(self, pixels: Sequence[Tuple[int, int]], asked: Any, recording: Recording, monitor: RequestMonitor) -> Any:
        return self._renderer.render_pixels(pixels, self._settings(asked), recording, monitor)


_recorder = PathRecorder()


def recorder() -> PathRecorder:
    """The recorder of the calling thread. Outside a replay its calls do nothing, and the values are not looked at."""
    return _recorder


class Server:
    """A renderer that is served; :func:`serve` makes it. A context manager that stops it.

    It also stops when the interpreter exits, or when nobody refers to it any more.
    """

    def __init__(self, renderer: Renderer, options: dict):
        self._native = _native.Server(_Adapter(renderer), options)
        _running.add(self)

    @property
    def port(self) -> int:
        """The one in use, also where 0 was asked for."""
        return self._native.port()

    @property
    def address(self) -> str:
        """"127.0.0.1:50013": what :func:`emca.connect` takes."""
        return self._native.address()

    def wait(self, timeout: Optional[float] = None) -> bool:
        """Waits until the server has ended: stopped, or by a client's request. Ctrl-C raises KeyboardInterrupt.

        Args:
            timeout: in seconds; None: no limit.
        Returns:
            whether it has ended.
        """
        return self._native.wait(-1.0 if timeout is None else max(0.0, float(timeout)))

    def stop(self) -> None:
        """Cancels what runs, waits for it, and closes all connections. Raises InputError inside a call of the renderer."""
        self._native.stop()

    def __enter__(self) -> "Server":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], value: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        self.stop()

    def __repr__(self) -> str:
        return f"<Server at {self.address}>"


_running: "weakref.WeakSet[Server]" = weakref.WeakSet()


@atexit.register
def _end() -> None:
    # The servers' threads call into the interpreter: they must have ended before it does.
    for server in list(_running):
        server.stop()
    _native.begin_exit()


def serve(renderer: Renderer, port: int = 0, host: str = "127.0.0.1", token: str = "", allow_quit: bool = False,
          log: Optional[Callable[[str], Any]] = None) -> Server:
    """Serves a renderer, in threads of the server's own.

    Args:
        port: 0: the system picks one.
        host: loopback unless told otherwise; "0.0.0.0" for every interface.
        token: if not empty, clients must present it.
        allow_quit: whether a client may end the server.
        log: called with remarks for people (a client came, was refused), from the server's network thread.
    Raises:
        ConnectionError: another program listens there (addressInUse). InputError: no such host. Error: ``info()`` failed.
    """
    return Server(renderer, {"host": host, "port": port, "token": token, "allow_quit": allow_quit, "log": log})
