"""What can go wrong, as exceptions.

Every exception of this package is an :class:`Error` with a ``code`` (the same words as on the command line and in the
protocol) and one sentence that says what was asked, what was found and what to do.
"""

from __future__ import annotations

import builtins
import logging
import os
import traceback
from types import TracebackType
from typing import Optional, Tuple, Type

__all__ = [
    "Error", "ConnectionError", "TimeoutError", "InputError", "FileError", "QueryError", "NotRecordedError",
    "ServerError", "Cancelled", "QueryWarning",
]

log = logging.getLogger("emca")


class Error(Exception):
    """Base of all exceptions of this package.

    Attributes:
        code: a short stable name, e.g. ``"pixelOutOfRange"``.
    """

    code: str = "internal"

    def __init__(self, message: str, code: Optional[str] = None):
        super().__init__(message)
        if code is not None:
            self.code = code


class ConnectionError(Error, builtins.ConnectionError):
    """Nobody listens there, the peer is no EMCA server or refuses, or the connection was lost."""

    code = "connectionLost"


class TimeoutError(ConnectionError, builtins.TimeoutError):
    """The server was silent for too long."""

    code = "timedOut"


class InputError(Error, ValueError):
    """A value that no request may have: a pixel outside the image, an unknown integrator, too many samples."""

    code = "invalidArgument"


class FileError(Error, OSError):
    """A file is not there, is not what it should be, or cannot be written."""

    code = "fileUnreadable"


class QueryError(InputError):
    """A query does not follow the language, or asks for what was recorded with another type.

    Attributes:
        query: the text.
        position: character at which the wrong piece begins, from 0.
        end: character behind it.
    """

    code = "parseFailed"

    def __init__(self, message: str, code: Optional[str] = None, query: str = "", position: int = 0, end: int = 0):
        super().__init__(message, code)
        self.query = query
        self.position = position
        self.end = end

    def point(self) -> str:
        """The query, and below it a line with ``^`` under the wrong piece."""
        return f"{self.query}\n{' ' * self.position}{'^' * max(1, self.end - self.position)}"


class NotRecordedError(Error, LookupError):
    """A quantity that the renderer did not record, or that the trace did not ask for."""

    code = "notRecorded"


class ServerError(Error):
    """The server or the renderer behind it failed."""

    code = "rendererFailed"


class Cancelled(Error):
    """The work was given up. A renderer raises it when ``monitor.cancelled`` is true."""

    code = "cancelled"

    def __init__(self, message: str = "The work was cancelled.", code: Optional[str] = None):
        super().__init__(message, code)


class QueryWarning(UserWarning):
    """A query names something that no path has: perhaps a misspelling."""


_KINDS = {
    "connectionFailed": ConnectionError, "connectionLost": ConnectionError, "protocolViolation": ConnectionError,
    "versionMismatch": ConnectionError, "refused": ConnectionError, "addressInUse": ConnectionError,
    "timedOut": TimeoutError,
    "invalidArgument": InputError, "pixelOutOfRange": InputError, "notSupported": InputError, "tooLarge": InputError,
    "fileNotFound": FileError, "fileUnreadable": FileError, "fileUnwritable": FileError,
    "parseFailed": QueryError, "cancelled": Cancelled, "rendererFailed": ServerError,
}

# Numbers of emca::ErrorCode, for what travels to clients.
_NUMBERS = {
    "internal": 1, "invalidArgument": 2, "pixelOutOfRange": 3, "notSupported": 4, "cancelled": 15, "rendererFailed": 16,
    "tooLarge": 14, "outOfMemory": 19,
}


def _make(code: str, message: str, query: Optional[str] = None, position: int = 0, end: int = 0) -> Error:
    """The exception for an error of the compiled half."""
    kind = _KINDS.get(code, Error)
    if query is not None and issubclass(kind, QueryError):
        return kind(message, code, query, position, end)
    return kind(message, code)


def _describe(kind: Type[BaseException], value: BaseException, trace: Optional[TracebackType], where: str) -> Tuple[int, str]:
    """Number and sentence of the error reply for what a renderer raised; its traceback goes to the log."""
    if isinstance(value, Error) and value.code in _NUMBERS:
        return _NUMBERS[value.code], str(value)
    log.error("The renderer's %s raised an exception.", where, exc_info=(kind, value, trace))
    place = ""
    frames = traceback.extract_tb(trace) if trace is not None else []
    if frames:
        place = f" ({os.path.basename(frames[-1].filename)}, line {frames[-1].lineno})"
    what = f"{kind.__name__}: {value}" if str(value) else kind.__name__
    return _NUMBERS["rendererFailed"], f"The renderer's {where} raised {what}{place}."
