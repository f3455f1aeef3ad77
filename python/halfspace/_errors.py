"""Errors of the library as exceptions."""

from __future__ import annotations

import enum
import re
from typing import Optional

__all__ = ["Error", "ErrorCode"]


class ErrorCode(enum.Enum):
    """The fault of an input; the value is a few words for it."""

    UNREADABLE = "unreadable file"
    UNWRITABLE = "unwritable file"
    UNKNOWN_FORMAT = "unknown format"
    SYNTAX = "syntax error"
    TRUNCATED = "truncated input"
    NOT_FINITE = "number not finite"
    OUT_OF_RANGE = "out of range"
    BAD_INDEX = "bad index"
    TOO_FEW_VERTICES = "too few vertices"
    REPEATED_VERTEX = "repeated vertex"
    ZERO_AREA = "zero area"
    NOT_PLANAR = "polygon not planar"
    NOT_CONVEX = "polygon not convex"
    NOT_TRIANGLE = "polygon not a triangle"
    BAD_CAMERA = "bad camera"
    BAD_RAY = "bad ray"
    OPEN = "open surface"
    SELF_CROSSING = "surface crosses itself"
    INSIDE_OUT = "surface inside out"
    UNBOUNDED = "unbounded solid"
    EMPTY = "nothing there"
    STOPPED = "stopped"


# Codes whose index is a polygon's.
_OF_POLYGONS = {
    ErrorCode.TOO_FEW_VERTICES, ErrorCode.REPEATED_VERTEX,
    ErrorCode.ZERO_AREA, ErrorCode.NOT_PLANAR, ErrorCode.NOT_CONVEX,
    ErrorCode.NOT_TRIANGLE,
}

_FILE = re.compile(r"^(.*?\.(?:obj|stl|ply|off|scene|csg|scad|3mf)(?:\.gz)?): ",
                   re.IGNORECASE)
_LINE = re.compile(r"\bline (\d+)\b")
_POLYGON = re.compile(r"\b(?:polygon|face) (\d+)\b")


class Error(Exception):
    """What is wrong with an input, and where.

    Attributes
    ----------
    code : ErrorCode
        What kind of fault it is.
    message : str
        One sentence that says what, where, and what to do next.
    file : str or None
        The file that is at fault, if one is.
    line : int or None
        The line of that file, from 1, if it is text.
    polygon : int or None
        The polygon that is at fault, from 0, if one is.
    index : int
        The index of the vertex, corner, polygon, line or byte, as the code
        says; -1 if there is none.

    Examples
    --------
    >>> import halfspace
    >>> try:
    ...     halfspace.Solid.from_file("no.off").volume()
    ... except halfspace.Error as error:
    ...     print(error.code.name, error.file, error.line)
    UNREADABLE no.off None
    """

    def __init__(self, code: ErrorCode, message: str, index: int = -1) -> None:
        super().__init__(code, message, index)
        self.code = code
        self.message = message
        self.index = index
        found = _FILE.match(message)
        self.file: Optional[str] = found[1] if found else None
        found = _LINE.search(message)
        self.line: Optional[int] = int(found[1]) if found else None
        found = _POLYGON.search(message)
        self.polygon: Optional[int] = int(found[1]) if found else None
        if self.polygon is None and code in _OF_POLYGONS and index >= 0:
            self.polygon = index

    def __str__(self) -> str:
        return self.message


def error_of(words: str, message: str, index: int) -> Error:
    """The exception for an error of the module."""
    return Error(ErrorCode(words), message, index)
