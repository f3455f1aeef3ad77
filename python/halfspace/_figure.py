"""Drawings of lines, and figures of regions: pictures without pixels."""

from __future__ import annotations

import enum
import os
from dataclasses import dataclass
from typing import (Any, Iterator, List, Literal, NamedTuple, Optional,
                    Sequence, Tuple)

import numpy as np
import numpy.typing as npt

from . import _core
from ._mesh import Floats, Ints
from ._solid import Path

__all__ = ["EdgeClass", "Figure", "LineDrawing", "SeenRegion"]

FigureKey = Literal["color", "polygon", "solid"]


class EdgeClass(enum.IntEnum):
    """What makes an edge a line of a drawing, the first one that holds."""

    SECTION = 0
    BORDER = 1
    SILHOUETTE = 2
    INTERSECTION = 3
    CREASE = 4
    GIVEN = 5


@dataclass(frozen=True, eq=False)
class LineDrawing:
    """The lines of what is displayed: visible and hidden, none twice.

    Attributes
    ----------
    width_px, height_px : int
        The size of the image. Units: pixels.
    starts, ends : ndarray of float64, shape (n, 2)
        The nearest doubles, y downwards. Units: pixels.
    edge_classes : ndarray of uint8, shape (n,)
        An `EdgeClass` by line.
    layers : ndarray of int32, shape (n,)
        How many polygons hide the line; 0: it is visible.

    Examples
    --------
    >>> from halfspace import Display, EdgeClass, Solid, View
    >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
    >>> lines = display.draw(View(width_px=64, height_px=48))
    >>> int((lines.edge_classes == EdgeClass.SILHOUETTE).sum())
    6
    """

    width_px: int
    height_px: int
    starts: Floats
    ends: Floats
    edge_classes: npt.NDArray[np.uint8]
    layers: Ints

    def __len__(self) -> int:
        return len(self.layers)

    def save(self, path: Path, *, with_hidden: bool = False) -> None:
        """Writes the visible lines, and the hidden ones dashed if asked for, as
        SVG, PDF, EPS, PGF, DXF or HPGL; the name of the file says the format.

        Raises
        ------
        Error
            ``UNKNOWN_FORMAT``, ``UNWRITABLE``.
        """
        _core.save_drawing(os.fspath(path), self, bool(with_hidden))


class SeenRegion(NamedTuple):
    """A part of the image in which one polygon, solid or colour is seen.

    Attributes
    ----------
    polygon : int
        The first of those that are seen in it, as in `Picture.ids`; -2 where
        polygons are transparent (`View.alpha`).
    color : tuple of 3 ints
        Of that polygon, or what is seen of all.
    loops : list of ndarray of float64, shape (n, 2)
        The outer one first, then those of holes. Units: pixels.
    """

    polygon: int
    color: Tuple[int, int, int]
    loops: List[Floats]


@dataclass(eq=False)
class Figure(Sequence[SeenRegion]):
    """All that is seen: a sequence of regions that fill the image, over arrays,
    and lines over them.

    Attributes
    ----------
    width_px, height_px : int
        The size of the image. Units: pixels.
    polygons : ndarray of int32, shape (r,)
        By region the first polygon that is seen in it, as in `Picture.ids`.
    colors : ndarray of uint8, shape (r, 3)
        By region the colour of that polygon.
    first_loop : ndarray of uint32, shape (r + 1,)
        The loops of region i are ``first_loop[i]`` up to ``first_loop[i + 1]``,
        the outer one first.
    first_point, points : ndarray, shapes (l + 1,) and (p, 2)
        The points of loop k are ``points[first_point[k]:first_point[k + 1]]``,
        the nearest doubles, y downwards. Units: pixels.
    lines : LineDrawing, optional
        None unless put there, such as those of `Display.draw`.

    Examples
    --------
    >>> from halfspace import Display, Solid, View
    >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
    >>> view = View(width_px=64, height_px=48)
    >>> figure = display.figure(view, by="polygon")
    >>> figure.lines = display.draw(view)
    >>> sorted(region.polygon for region in figure)
    [-1, 2, 3, 5]
    """

    width_px: int
    height_px: int
    polygons: Ints
    colors: npt.NDArray[np.uint8]
    first_loop: npt.NDArray[np.uint32]
    first_point: npt.NDArray[np.uint32]
    points: Floats
    lines: Optional[LineDrawing] = None

    def __len__(self) -> int:
        return len(self.polygons)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        i = range(len(self))[index]
        bounds = self.first_point[int(self.first_loop[i]):
                                  int(self.first_loop[i + 1]) + 1].tolist()
        red, green, blue = self.colors[i].tolist()
        return SeenRegion(int(self.polygons[i]), (red, green, blue),
                          [self.points[begin:end] for begin, end
                           in zip(bounds[:-1], bounds[1:])])

    def __iter__(self) -> Iterator[SeenRegion]:
        return (self[i] for i in range(len(self)))

    def save(self, path: Path) -> None:
        """Writes the regions and the visible lines as SVG, PDF, EPS or PGF: a
        path a region, and no seams between them. The name of the file says the
        format.

        Raises
        ------
        Error
            ``UNKNOWN_FORMAT``, ``UNWRITABLE``.
        """
        _core.save_figure(os.fspath(path), self)
