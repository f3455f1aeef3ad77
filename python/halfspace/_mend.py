"""Surfaces that are no solid's, mended."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import List, Optional

from . import _core
from ._solid import Path, Solid

__all__ = ["Mended", "mended"]


@dataclass(frozen=True)
class Mended:
    """A solid that was mended.

    Attributes
    ----------
    solid : Solid
    done : list of str
        A sentence for each thing that was done.
    """

    solid: Solid
    done: List[str]


def mended(path: Path, *, weld: Optional[float] = None,
           close_all: bool = False,
           thicken: Optional[float] = None) -> Mended:
    """The solid that the surface in a mesh file was meant to be.

    What has to be done is done: polygons that others cover go, borders are
    welded, polygons are turned to agree, holes are filled, components turned
    outwards, and what crosses itself is resolved by winding number.

    Parameters
    ----------
    path : path-like
    weld : float, optional
        Welds vertices at borders that are no farther apart, along any axis;
        None: four steps of floats of the mesh's size. Units: model units.
    close_all : bool
        Fills borders that are half as wide as their component, too.
    thicken : float, optional
        Makes an open surface a shell as thick as this, in place of filling it.
        Units: model units.

    Raises
    ------
    Error
        Those of reading; ``OPEN``, ``INSIDE_OUT``, ``EMPTY``: the message says
        what is left to decide.

    Examples
    --------
    >>> import os, tempfile
    >>> from halfspace import mended
    >>> lines = ["v 0 0 0", "v 1 0 0", "v 0 1 0", "v 0 0 1",
    ...          "f 1 3 2", "f 1 2 4", "f 1 4 3"]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "open.obj")
    ...     with open(path, "w") as file:
    ...         print(*lines, sep="\\n", file=file)
    ...     mended(path, close_all=True).solid.exact_volume()
    Fraction(1, 6)
    """
    how = (os.fspath(path), None if weld is None else float(weld),
           bool(close_all), None if thicken is None else float(thicken))
    core, done = _core.mended(*how)
    return Mended(Solid._of(core, ("mended", (), how)), done)
