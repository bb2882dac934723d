"""EMCA from Python: light paths of a renderer as numpy arrays, and renderers written in Python.

    import emca
    with emca.connect("localhost:50013") as renderer:
        trace = renderer.pixel(146, 97)
    paths = trace.paths
    print(trace.verdict, paths.luminance.max(), paths.select("luminance > 10 * mean(luminance)"))

The guide is docs/python.md; the query language is docs/queries.md. Conventions: pixels are (x, y), (0, 0) at the top left; images are
(height, width, channels), row 0 at the top; radiance is linear Rec. 709 RGB in W/(sr m²); positions are in world space, in scene
units; densities are per steradian unless their name ends in ``_area``.
"""

from . import image_metrics, statistics
from ._native import __version__
from .columns import Column
from .connection import Connection, ServerInfo, connect
from .errors import (Cancelled, ConnectionError, Error, FileError, InputError, NotRecordedError, QueryError, QueryWarning, ServerError,
                     TimeoutError)
from .events import Event, Lobe
from .image import Image
from .paths import Contributions, NextEvents, PathSet, Splats, Vertices, merge
from .queries import Matches
from .renderer import PathRecorder, Recording, Renderer, RendererInfo, RenderSettings, RequestMonitor, SeedMap, Server, recorder, serve
from .scene import Camera, Color, ColorA, LayerDescription, Mesh, Surface, SurfaceLayer
from .session import Session, open, save
from .statistics import outliers, outliers_per_pixel
from .table import Table
from .trace import MatchCounts, Replay, Trace

# "open" is left out: "from emca import *" must not hide the one of Python.
__all__ = [
    "connect", "Connection", "ServerInfo", "Trace", "Replay", "MatchCounts", "PathSet", "Vertices", "Contributions", "NextEvents",
    "Splats", "Column", "Matches", "Table", "merge", "Event", "Lobe", "Image", "Camera", "Mesh", "Surface", "SurfaceLayer",
    "LayerDescription", "Color", "ColorA", "outliers", "outliers_per_pixel", "statistics", "image_metrics", "Session", "save", "Renderer",
    "RendererInfo", "RenderSettings", "RequestMonitor", "Recording", "PathRecorder", "SeedMap", "recorder", "serve", "Server",
    "Error", "InputError", "FileError", "QueryError", "NotRecordedError", "ServerError", "Cancelled", "QueryWarning",
]
