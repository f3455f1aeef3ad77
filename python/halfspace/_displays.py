"""Displays for one purpose: areas and feeds, colours by numbers, motion."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Literal, NamedTuple, Optional, Sequence

import numpy as np
import numpy.typing as npt

from . import _core
from ._display import Counts, Display, Picture, View
from ._mesh import Floats, Ints, MeshLike, mesh_of
from ._solid import Path, Progress, affine_rows

__all__ = ["CutDisplay", "MovingDisplay", "MovingPicture", "ScalarDisplay",
           "ScalarStyle", "SeenAreas", "VertexFeed"]

FeedOrder = Literal["back_to_front", "front_to_back"]


class SeenAreas(NamedTuple):
    """How much of each polygon that is seen is: the doubles nearest to the
    exact areas.

    Attributes
    ----------
    polygons : ndarray of int32, shape (n,)
        -1 first, where nothing is seen; then by polygon.
    area_px : ndarray of float64, shape (n,)
        Units: square pixels.
    solid_angles : ndarray of float64, shape (n,)
        Units: steradians; 0 in a parallel view.
    """

    polygons: Ints
    area_px: Floats
    solid_angles: Floats


class VertexFeed(NamedTuple):
    """What is displayed, cut so that an order of triangles needs no depth
    buffer: the same for every view.

    Attributes
    ----------
    positions : ndarray of float64, shape (v, 3)
        Within a few ulps where cut. Units: model units.
    polygons : ndarray of int32, shape (v,)
        By vertex that of the display.
    """

    positions: Floats
    polygons: Ints


class CutDisplay:
    """A display's polygons, cut by the planes of each other: for what is asked
    of the parts, and not of pictures. Threads may use it at once.

    It keeps the display. When that has changed, all that is asked of this one
    raises `ValueError`.

    Examples
    --------
    >>> from halfspace import CutDisplay, Display, Solid, View
    >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
    >>> areas = CutDisplay.of(display).seen_areas(
    ...     View(width_px=64, height_px=48))
    >>> areas.polygons.tolist(), float(areas.area_px.sum())
    ([-1, 2, 3, 5], 3072.0)
    """

    __slots__ = ("_core", "__weakref__")

    def __init__(self, core: _core.CutDisplay) -> None:
        self._core = core

    @staticmethod
    def of(display: Display, *, threads: int = 0,
           progress: Optional[Progress] = None) -> "CutDisplay":
        """Cuts what is displayed.

        Parameters
        ----------
        display : Display
        threads : int
            0: as many as the machine has.
        progress : callable, optional
            As of `Solid.evaluate`.

        Raises
        ------
        Error
            ``STOPPED``.
        """
        return CutDisplay(_core.CutDisplay.of(display._core, int(threads),
                                              progress))

    def seen_areas(self, view: View = View()) -> SeenAreas:
        """How much of each polygon that is seen is. Exact.

        Raises
        ------
        Error
            ``BAD_CAMERA``, ``NOT_FINITE``; ``OUT_OF_RANGE`` (clip planes, which
            areas do not have; too much to be seen).
        """
        return SeenAreas(*self._core.seen_areas(view))

    def vertex_feed(self) -> VertexFeed:
        """Vertices for a graphics card, the same for every view.

        Examples
        --------
        >>> from halfspace import CutDisplay, Display, Solid
        >>> cut = CutDisplay.of(Display.of(Solid.box((0, 0, 0), (1, 1, 1))))
        >>> cut.vertex_feed().positions.shape, len(cut.feed_indices()) // 3
        ((24, 3), 12)
        """
        return VertexFeed(*self._core.vertex_feed())

    def feed_indices(self, view: View = View(), *,
                     order: FeedOrder = "back_to_front") -> Counts:
        """The triangles of a view, in an order in which none hides one before
        it, or one after it. Exact. What is culled or clipped is for the card to
        leave out.

        Parameters
        ----------
        view : View
        order : {"back_to_front", "front_to_back"}

        Returns
        -------
        ndarray of uint32, shape (3 t,)
            Three indices a triangle.

        Raises
        ------
        Error
            ``BAD_CAMERA``, ``NOT_FINITE``, ``OUT_OF_RANGE``.
        ValueError
            If `order` is another one.
        """
        if order not in ("back_to_front", "front_to_back"):
            raise ValueError(f"order is {order!r}, not back_to_front or "
                             "front_to_back")
        return self._core.feed_indices(view, order == "front_to_back")


@dataclass(frozen=True)
class ScalarStyle:
    """How numbers become colours.

    Parameters
    ----------
    map : str
        heated, grey, viridis, cividis, turbo, coolwarm, ``_r`` after it in
        reverse, or the path of a text file with a colour a line.
    low, high : float, optional
        None: the least number there is, and the greatest.
    logarithmic : bool
    steps : int
        So many bands; 0: as many as the map has colours.
    clamp : bool
        Else what is outside has the colour of no data.
    no_data : sequence of 3 ints
        Red, green and blue, 0 to 255.
    legend : bool
        With a scale at the picture's right side.
    title : str
        Of the legend.
    """

    map: str = "viridis"
    low: Optional[float] = None
    high: Optional[float] = None
    logarithmic: bool = False
    steps: int = 0
    clamp: bool = True
    no_data: Sequence[int] = (160, 160, 160)
    legend: bool = False
    title: str = ""


class ScalarDisplay:
    """Polygons to look at, coloured by numbers at their corners.

    What is interpolated is the number, exactly; the colour is that of the
    number at the pixel's centre, dimmed by the light on the polygon.

    Examples
    --------
    >>> from halfspace import Mesh, ScalarDisplay, ScalarStyle, Solid, View
    >>> V, F = Solid.box((0, 0, 0), (1, 1, 1)).mesh()
    >>> heights = V[F.ravel(), 2:]
    >>> display = ScalarDisplay.of(Mesh(V, F, fields=heights))
    >>> picture = display.render(View(width_px=64, height_px=48),
    ...                          ScalarStyle(map="turbo", steps=8))
    >>> picture.colors.shape
    (48, 64, 3)
    """

    __slots__ = ("_core", "__weakref__")

    def __init__(self, core: _core.ScalarDisplay) -> None:
        self._core = core

    @staticmethod
    def of(mesh: MeshLike, field: int = 0) -> "ScalarDisplay":
        """Takes polygons and one of their fields, in which a NaN is no data.

        Parameters
        ----------
        mesh : Mesh
            With fields. What is no triangle is cut into triangles.
        field : int
            The column of `Mesh.fields`.

        Raises
        ------
        Error
            Those of `Display.of`; ``BAD_INDEX`` (there is no such field);
            ``NOT_FINITE`` (an infinite number).
        """
        if field < 0:
            raise ValueError("a field is numbered from 0")
        return ScalarDisplay(_core.ScalarDisplay.of(mesh_of(mesh)._core,
                                                    int(field)))

    def render(self, view: View = View(),
               style: ScalarStyle = ScalarStyle()) -> Picture:
        """The picture, with the polygons of the mesh. Exact.

        Raises
        ------
        Error
            Those of `Display.render`; ``OUT_OF_RANGE`` (a scale's range or
            steps, or exact areas and marks, which have no scalars); ``EMPTY`` (no number,
            and no range); ``UNKNOWN_FORMAT``, ``UNREADABLE`` and others of a
            file with colours.
        """
        return Picture(*self._core.render(view, style))


@dataclass(frozen=True)
class MovingPicture:
    """A picture of objects.

    Attributes
    ----------
    ids : ndarray of int32, shape (height, width)
        At each pixel the polygon, of its model's mesh; -1 where there is none,
        and ``-2 - k`` at the cap of clip plane ``k``. With many samples a
        pixel an entry a sample.
    objects : ndarray of int32, shape (height, width)
        Whose polygon that is; 0: the world's; -1 where there is none, and at
        caps unless ``View.caps_by_solid`` tells objects apart and one has it.
    colors : ndarray of uint8, shape (height, width, 3)
        Red, green and blue.
    """

    ids: Ints
    objects: Ints
    colors: npt.NDArray[np.uint8]

    def save(self, path: Path) -> None:
        """Writes the colours as PNG.

        Raises
        ------
        Error
            ``UNWRITABLE``.
        """
        _core.save_picture(os.fspath(path), self.colors)


class MovingDisplay:
    """A world with objects that move, come and go while no tree of what they
    are made of changes.

    An object is a model in a region, which no other region of its owner shares
    and no polygon of its owner reaches into. The world is model 0 and object 0.
    Threads may use it at once.

    Examples
    --------
    >>> import numpy as np
    >>> from halfspace import MovingDisplay, Solid, View
    >>> display = MovingDisplay.of(Solid.box((-4, -4, -1), (4, 4, 0)).mesh())
    >>> model = display.add_model(Solid.sphere(1, 12).mesh())
    >>> ball = display.insert(model, [(-3, -3, 0.5), (3, 3, 4)])
    >>> view = View(width_px=64, height_px=48, eye=(9, -14, 12),
    ...             target=(0, 0, 0))
    >>> for x in (-1, 0, 1):
    ...     display.place(ball, [(1, 0, 0, x), (0, 1, 0, 0), (0, 0, 1, 2)])
    ...     picture = display.render(view)
    >>> sorted(set(picture.objects.flat))
    [-1, 0, 1]
    """

    __slots__ = ("_core", "__weakref__")

    def __init__(self, core: _core.MovingDisplay) -> None:
        self._core = core

    @staticmethod
    def of(world: MeshLike) -> "MovingDisplay":
        """The world's polygons, which stay where they are.

        Raises
        ------
        Error
            Those of `Display.of`.
        """
        return MovingDisplay(_core.MovingDisplay.of(mesh_of(world)._core))

    def add_model(self, mesh: MeshLike) -> int:
        """Takes polygons that objects are made of.

        Returns
        -------
        int
            The model's number.

        Raises
        ------
        Error
            Those of `Display.of`.
        """
        return self._core.add_model(mesh_of(mesh)._core)

    def insert(self, model: int, region: npt.ArrayLike, owner: int = 0) -> int:
        """Adds an object of a model to the world, or to every object of another
        model. It is not there before it is placed.

        Parameters
        ----------
        model : int
        region : array_like, shape (2, 3) or (n, 3)
            A box, by two corners, or the convex hull of 4 to 30 points; rounded
            to the owner's grid. Units: model units of the owner.
        owner : int
            A model that was added before; 0: the world.

        Returns
        -------
        int
            The object's number.

        Raises
        ------
        Error
            ``BAD_INDEX`` (no such model; one that is not after its owner);
            ``NOT_FINITE``; ``OUT_OF_RANGE`` (no region; one that shares space
            with another one of the owner).
        """
        points = np.array(region, dtype=np.float64).reshape(-1, 3)
        return self._core.insert(int(model), points, int(owner))

    def remove(self, object: int) -> None:
        """Takes an object away for good; its region is free for others. The
        others keep their numbers.

        Raises
        ------
        Error
            ``BAD_INDEX``.
        """
        self._core.remove(int(object))

    def place(self, object: int, matrix: npt.ArrayLike) -> None:
        """Where an object stands in its owner, rounded to some 20 bits.

        Parameters
        ----------
        object : int
        matrix : array_like, shape (3, 4) or (4, 4)
            As of `Solid.transformed`.

        Raises
        ------
        Error
            ``BAD_INDEX``, ``NOT_FINITE``.
        ValueError
            If the shape is another one.
        """
        self._core.place(int(object), affine_rows(matrix))

    def hide(self, object: int) -> None:
        """An object is not there until it is placed again.

        Raises
        ------
        Error
            ``BAD_INDEX``.
        """
        self._core.hide(int(object))

    def render(self, view: View = View()) -> MovingPicture:
        """The picture, exact: that of all polygons moved.

        Raises
        ------
        Error
            Those of `Display.render`; ``OUT_OF_RANGE`` (an object that leaves
            its region, with `Error.index` the object; a region that is not
            free, or that is interlocked with others; what has moved, where the
            view asks for samples, areas, an alpha or marks, and no grid holds
            all of it); ``ZERO_AREA`` (a singular map).
        """
        return MovingPicture(*self._core.render(view))
