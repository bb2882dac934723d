"""Sessions: everything that was received and what a person made of it, as one file (.emca)."""

from __future__ import annotations

import datetime
import os
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

from . import _native
from .connection import ServerInfo
from .image import Image
from .scene import Camera, Mesh, Surface
from .trace import Trace

__all__ = ["Session", "open", "save"]

PathLike = Union[str, "os.PathLike[str]"]


@dataclass(eq=False)
class Session:
    """What a session holds. Every part may be absent.

    Attributes:
        info: of the renderer, out of a connection or a session.
        meshes: None: no scene. surface: 3D data on these meshes.
        images: renders and opened files. current_image: index of the one that is shown.
        traces: traced pixels, newest first. shown: indices of those that views show.
        selected_paths: (x, y, sample, part) each.
        notes: about the whole session. pixel_notes: (x, y) to text.
        whole: when opened, whether nothing was cut off or damaged. notices: what is missing, as sentences.
        software: product and version that saved it. saved: when, UTC; None if not known.
    """

    info: Optional[ServerInfo] = None
    camera: Optional[Camera] = None
    meshes: Optional[List[Mesh]] = None
    surface: Optional[Surface] = None
    images: List[Image] = field(default_factory=list)
    current_image: int = 0
    traces: List[Trace] = field(default_factory=list)
    shown: List[int] = field(default_factory=list)
    selected_paths: List[Tuple[int, int, int, int]] = field(default_factory=list)
    notes: str = ""
    pixel_notes: Dict[Tuple[int, int], str] = field(default_factory=dict)
    whole: bool = True
    notices: List[str] = field(default_factory=list)
    software: str = ""
    saved: Optional[datetime.datetime] = None

    def save(self, file: PathLike, progress: Optional[Callable[[float], Any]] = None) -> None:
        """Writes the session; see :func:`save`."""
        _native.save_session(os.fspath(file), {
            "info": self.info._native if self.info is not None else None,
            "camera": self.camera, "meshes": self.meshes,
            "surface": self.surface._native if self.surface is not None else None,
            "images": [image._native for image in self.images], "current_image": self.current_image,
            "traces": [trace._native for trace in self.traces], "shown": list(self.shown),
            "selected_paths": [tuple(path) for path in self.selected_paths], "notes": self.notes,
            "pixel_notes": [(x, y, text) for (x, y), text in self.pixel_notes.items()],
        }, progress)

    def __repr__(self) -> str:
        scene = f"{len(self.meshes)} meshes" if self.meshes is not None else "no scene"
        return f"<Session: {scene}, {len(self.images)} images, {len(self.traces)} traces{'' if self.whole else ', damaged'}>"


def open(file: PathLike) -> Session:
    """Opens a session file, as far as it is whole: see ``whole`` and ``notices`` of the result.

    Arrays of the traces are views on memory that was read once. Raises FileError (no such file, no session); Ctrl-C gives up.
    """
    parts, whole, notices, software, saved = _native.open_session(os.fspath(file))
    parts["info"] = ServerInfo._of(parts["info"]) if parts["info"] is not None else None
    parts["camera"] = Camera(**parts["camera"]) if parts["camera"] is not None else None
    parts["meshes"] = [Mesh(**mesh) for mesh in parts["meshes"]] if parts["meshes"] is not None else None
    parts["surface"] = Surface(parts["surface"]) if parts["surface"] is not None else None
    parts["images"] = [Image._of(image) for image in parts["images"]]
    parts["traces"] = [Trace(trace) for trace in parts["traces"]]
    parts["pixel_notes"] = {(x, y): text for x, y, text in parts["pixel_notes"]}
    when = datetime.datetime.fromtimestamp(saved, datetime.timezone.utc) if saved else None
    return Session(**parts, whole=whole, notices=notices, software=software, saved=when)


def save(file: PathLike, session: Optional[Session] = None, *, progress: Optional[Callable[[float], Any]] = None, **parts: Any) -> None:
    """Writes a session, given as a whole or by its parts: ``emca.save("door.emca", images=[image], traces=[trace])``.

    The file appears, or takes the place of an older one, when it is complete and on the disk. With traces and no ``shown``, the
    first of them is shown.

    Raises:
        FileError: it cannot be written. InputError: surface data without the meshes that it lies on, or a trace beyond 1 GiB.
        TypeError: an unknown part.
    """
    if session is not None and parts:
        raise TypeError("give a session, or its parts, not both")
    if session is None:
        session = Session(**parts)
        if session.traces and not session.shown:
            session.shown = [0]
    session.save(file, progress)
