"""What happens at vertices, by the numbers that columns hold."""

from __future__ import annotations

import enum

__all__ = ["Event", "Lobe"]


class Event(enum.IntEnum):
    """What happened at a vertex."""

    none = 0
    reflect = 1
    transmit = 2
    volume = 3  #: scattering in a medium
    emission = 4  #: the walk ended on an emitter
    background = 5  #: the walk left the scene
    absorb = 6  #: the walk ended without light
    # "pass" is a keyword of Python.
    pass_ = 7  #: went straight through


class Lobe(enum.IntEnum):
    """How concentrated the scattering was."""

    none = 0
    diffuse = 1
    glossy = 2
    specular = 3
    straight = 4
