"""Pictures, orders and visible maps of polygons."""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import (Any, Iterable, List, Literal, NamedTuple, Optional,
                    Sequence, Tuple, Union, get_args)

import numpy as np
import numpy.typing as npt

from . import _core
from ._figure import Figure, FigureKey, LineDrawing
from ._mesh import Floats, Ints, Mesh, MeshLike, fraction_of, mesh_of
from ._solid import Path, Plane, Progress, Solid, Vector, _triple

__all__ = ["CapStyle", "Display", "DynamicScreen", "Hit", "Pick", "Picture",
           "SeenPolygon", "Traversal", "View", "VisibleMap"]

Bytes = npt.NDArray[np.uint8]
Counts = npt.NDArray[np.uint32]


@dataclass(frozen=True)
class CapStyle:
    """How the cuts of clip planes look.

    Parameters
    ----------
    color : sequence of 3 ints
        Red, green and blue, 0 to 255.
    hatch : sequence of 3 ints, optional
        Of lines over the colour.
    """

    color: Sequence[int] = (200, 80, 40)
    hatch: Optional[Sequence[int]] = None


@dataclass(frozen=True)
class View:
    """From where something is seen, and how.

    The default sees all of it from above and to one side, z upwards.

    Parameters
    ----------
    eye, target, up : sequence of 3 floats, optional
        The eye; what is in the middle of the image; what points upwards there.
        Units: model units.
    fov_deg : float
        Of perspective views, top to bottom. Units: degrees.
    orthographic : bool
    ortho_height : float
        Of orthographic views, top to bottom. Units: model units.
    near : float, optional
        What is not farther is not seen. Units: model units.
    width_px, height_px : int
        Units: pixels; at most 65,536.
    cull : bool
        Polygons seen from behind are not there.
    clips : sequence of Plane
        What is on the negative side of any is not there; up to eight.
    caps : CapStyle, optional
        Fills the cuts of what is closed; None: they stay open.
    caps_by_solid : bool
        Tells the caps of the display's solids apart: each has a colour of its
        own, and lines in another direction or at another distance if there are
        any; caps look as `caps` says where several solids are.
    background : sequence of 3 ints
        Red, green and blue, 0 to 255.
    back_color : sequence of 3 ints, optional
        Marks what is seen from behind, in its own light; not in pictures of
        exact areas.
    alpha : int
        How much of what is behind a polygon it hides, in pictures and figures:
        255 all of it, less alpha / 255 of it.
    anti_aliasing : {1, 2, 4, 8, "area"}
        What of a pixel its colour is taken from: one sample, the mean of so
        many each way, or the exact integral of all that is seen in it.
    threads : int
        0: as many as the machine has.
    progress : callable, optional
        Receives the share that is done, 0 to 1, of the tree that the first view
        makes; where it returns False the work stops. It must not ask anything
        of the display.
    lazy : bool
        Pictures and picks build the tree where they look, as rays do; the first
        of many polygons is there sooner. What else is asked of the display
        builds all of it.

    Raises
    ------
    ValueError
        If `anti_aliasing` is another value.

    Examples
    --------
    >>> from halfspace import View
    >>> View(width_px=320, height_px=240).sized(64, 48).height_px
    48
    """

    eye: Optional[Vector] = None
    target: Optional[Vector] = None
    up: Optional[Vector] = None
    fov_deg: float = 30
    orthographic: bool = False
    ortho_height: float = 2
    near: Optional[float] = None
    width_px: int = 640
    height_px: int = 480
    cull: bool = False
    clips: Sequence[Union[Plane, Tuple[Vector, float]]] = ()
    caps: Optional[CapStyle] = None
    caps_by_solid: bool = False
    background: Sequence[int] = (255, 255, 255)
    back_color: Optional[Sequence[int]] = None
    alpha: int = 255
    anti_aliasing: Union[int, Literal["area"]] = 1
    threads: int = 0
    progress: Optional[Progress] = field(default=None, compare=False)
    lazy: bool = False

    def __post_init__(self) -> None:
        if not 0 <= self.alpha <= 255:
            raise ValueError(f"alpha is {self.alpha!r}, not from 0 to 255")
        if self.anti_aliasing not in (1, 2, 4, 8, "area"):
            raise ValueError(f"anti_aliasing is {self.anti_aliasing!r}, not 1, "
                             "2, 4, 8 or 'area'")

    def sized(self, width_px: int, height_px: int) -> "View":
        """The same view, in another size."""
        return replace(self, width_px=width_px, height_px=height_px)


@dataclass(frozen=True)
class Picture:
    """A picture: at each pixel its colour, and the polygon that is seen.

    Attributes
    ----------
    ids : ndarray of int32, shape (height, width)
        The polygon; -1 where there is none.
    colors : ndarray of uint8, shape (height, width, 3)
        Red, green and blue.
    """

    ids: Ints
    colors: Bytes

    def save(self, path: Path) -> None:
        """Writes the colours as PNG.

        Raises
        ------
        Error
            ``UNWRITABLE``.
        """
        _core.save_picture(os.fspath(path), self.colors)


class Pick(NamedTuple):
    """The polygon seen at a pixel, and the solid that it belongs to.

    Attributes
    ----------
    polygon, solid : int
        Of the display; of those that it was made of, -1 for a cap.
    point : tuple of 3 floats
        What the pixel's centre sees, to the nearest doubles.
    distance : float
        From the eye; in orthographic views from its plane.
    """

    polygon: int
    solid: int
    point: Tuple[float, float, float]
    distance: float


class Hit(NamedTuple):
    """What a ray hits: the doubles are the nearest ones to exact numbers.

    Attributes
    ----------
    polygon, solid : int
        Of the display; of those that it was made of.
    point : tuple of 3 floats
    distance : float
        From where the ray begins.
    parameter : float
        The share of the direction, or of the way.
    fraction : fractions.Fraction
        The same exactly.
    """

    polygon: int
    solid: int
    point: Tuple[float, float, float]
    distance: float
    parameter: float
    fraction: Fraction


def _hit(parts: Any) -> Hit:
    polygon, solid, point, distance, parameter, fraction = parts
    x, y, z = point
    return Hit(polygon, solid, (x, y, z), distance, parameter,
               fraction_of(fraction))


class SeenPolygon(NamedTuple):
    """A part of a polygon, as a traversal hands it out.

    Attributes
    ----------
    polygon : int
        Of the display's mesh.
    points : ndarray of float64, shape (n, 3)
        Its corners. Units: model units.
    projected : ndarray of float64, shape (m, 2)
        The corners in the image, y downwards, of what is in front of the eye.
        Units: pixels.
    spans : ndarray of int32, shape (k, 3)
        The line, the first and the last of the pixels whose centres it covers,
        if the traversal was asked for them. Exact.
    color : ndarray of uint8, shape (3,)
        Of the polygon.
    """

    polygon: int
    points: Floats
    projected: Floats
    spans: Ints
    color: Bytes


class Traversal(Sequence[SeenPolygon]):
    """Parts of polygons in an order in which none hides one before it, or one
    after it: a sequence of `SeenPolygon`, over arrays.

    Attributes
    ----------
    polygons : ndarray of int32, shape (n,)
        The polygon by part.
    first_point, points : ndarray, shapes (n + 1,) and (p, 3)
        The corners of part i are ``points[first_point[i]:first_point[i + 1]]``.
    first_projected, projected : ndarray, shapes (n + 1,) and (q, 2)
    first_span, spans : ndarray, shapes (n + 1,) and (s, 3)
    colors : ndarray of uint8, shape (n, 3)
        The colour by part.
    """

    __slots__ = ("polygons", "first_point", "points", "first_projected",
                 "projected", "first_span", "spans", "colors")

    def __init__(self, arrays: Tuple[Any, ...]) -> None:
        self.polygons: Ints = arrays[0]
        self.first_point: Counts = arrays[1]
        self.points: Floats = arrays[2]
        self.first_projected: Counts = arrays[3]
        self.projected: Floats = arrays[4]
        self.first_span: Counts = arrays[5]
        self.spans: Ints = arrays[6]
        self.colors: Bytes = arrays[7]

    def __len__(self) -> int:
        return len(self.polygons)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        i = range(len(self))[index]

        def part(first: Counts, rows: Any) -> Any:
            return rows[int(first[i]):int(first[i + 1])]

        return SeenPolygon(int(self.polygons[i]),
                           part(self.first_point, self.points),
                           part(self.first_projected, self.projected),
                           part(self.first_span, self.spans),
                           self.colors[i])


class VisibleMap:
    """The image without pixels: the exact regions in which one thing is seen
    (spec/S7-map.md).

    Attributes
    ----------
    width_px, height_px : int
        The size of the image. Units: pixels.
    vertices : ndarray of float64, shape (v, 2)
        Where lines of the map meet: the nearest doubles to exact coordinates,
        y downwards. Units: pixels.
    arcs : ndarray of int32, shape (a, 4)
        The vertices at both ends, and the regions on the left and the right;
        -1 outside of the image.
    keys : ndarray of int32, shape (r,)
        By region its key; -1 is the background.
    items : ndarray of int32, shape (r,)
        By region the first polygon that is seen in it; -1 is none.
    """

    __slots__ = ("_core", "width_px", "height_px")

    def __init__(self, core: _core.VisibleMap, width_px: int,
                 height_px: int) -> None:
        self._core = core
        self.width_px = width_px
        self.height_px = height_px

    @property
    def vertices(self) -> Floats:
        return self._core.vertices

    @property
    def arcs(self) -> Ints:
        return self._core.arcs

    @property
    def keys(self) -> Ints:
        return self._core.regions[:, 0]

    @property
    def items(self) -> Ints:
        return self._core.regions[:, 1]

    def __len__(self) -> int:
        return len(self._core.regions)

    def loops(self, region: int) -> List[Floats]:
        """The loops of a region: its boundary, then its holes.

        Returns
        -------
        list of ndarray of float64, shape (n, 2)
            Without the first point again at the end. Units: pixels.

        Examples
        --------
        >>> from halfspace import Display, Solid, View
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> shown = display.visible_map(View(width_px=64, height_px=48))
        >>> sorted(shown.keys.tolist()), len(shown.loops(0))
        ([-1, 2, 3, 5], 2)
        """
        _, _, first_loop, count = self._core.regions[region].tolist()
        bounds = self._core.first_corner[first_loop:first_loop + count + 1]
        corners, vertices = self._core.corners, self.vertices
        return [vertices[corners[int(begin):int(end)]]
                for begin, end in zip(bounds[:-1], bounds[1:])]

    def areas(self) -> Floats:
        """The area of each region, shape (r,). Units: square pixels."""
        ends = self.vertices[self.arcs[:, :2]]
        twice = ends[:, 0, 0] * ends[:, 1, 1] - ends[:, 0, 1] * ends[:, 1, 0]
        areas = np.zeros(len(self) + 1)
        np.add.at(areas, self.arcs[:, 3], twice / 2)
        np.add.at(areas, self.arcs[:, 2], -twice / 2)
        return areas[:-1]

    def draw(self, ending: str, *, fills: Optional[npt.ArrayLike] = None,
             line_width: float = 0, decimals: int = 3) -> bytes:
        """The drawing as a file: one path a region, without seams.

        Parameters
        ----------
        ending : {".svg", ".pdf", ".eps", ".tex"}
        fills : array_like of uint8, shape (r, 3), optional
            The colour of each region; none: regions are not filled.
        line_width : float
            Of the borders of regions; 0: none. Units: pixels.
        decimals : int
            Of coordinates.

        Raises
        ------
        Error
            ``UNKNOWN_FORMAT``.
        ValueError
            If `fills` are not one a region.

        Examples
        --------
        >>> from halfspace import Display, Solid, View
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> shown = display.visible_map(View(width_px=64, height_px=48))
        >>> shown.draw(".svg", line_width=1)[:4]
        b'<svg'
        """
        colors = None if fills is None else np.asarray(fills, np.uint8)
        return self._core.draw(ending, colors, float(line_width),
                               int(decimals))

    def save(self, path: Path, **how: Any) -> None:
        """Writes the drawing; the name of the file says the format. The
        arguments are those of `draw`."""
        name = os.fspath(path)
        data = self.draw(os.path.splitext(name)[1], **how)
        with open(name, "wb") as file:
            file.write(data)

    def __repr__(self) -> str:
        return (f"<halfspace.VisibleMap: {len(self)} regions, "
                f"{len(self.arcs)} arcs>")


class Display:
    """Polygons to look at, with a BSP tree of them: made once, for any number
    of views and threads.

    Examples
    --------
    >>> from halfspace import Display, Solid, View
    >>> display = Display.of(Solid.sphere(1) - Solid.box((0, 0, 0), (2, 2, 2)))
    >>> picture = display.render(View(width_px=64, height_px=48))
    >>> picture.ids.shape, picture.ids.dtype.name, picture.colors.dtype.name
    ((48, 64), 'int32', 'uint8')
    """

    __slots__ = ("_core", "__weakref__")

    def __init__(self, core: _core.Display) -> None:
        self._core = core

    @staticmethod
    def of(shown: Union[Solid, Iterable[Solid], MeshLike]) -> "Display":
        """Shows a solid, several, or polygons, which need not bound a solid.

        Parameters
        ----------
        shown : Solid, iterable of Solid, Mesh, (V, F), meshio mesh or trimesh
            What is not planar or not convex is cut into triangles.

        Raises
        ------
        Error
            ``EMPTY``, ``BAD_INDEX``, ``NOT_FINITE``, ``OUT_OF_RANGE``; those
            of solids.
        """
        if isinstance(shown, Solid):
            return Display(_core.Display.of_solids([shown._core]))
        if isinstance(shown, (list, tuple)) and shown and all(
                isinstance(solid, Solid) for solid in shown):
            return Display(_core.Display.of_solids(
                [solid._core for solid in shown]))
        return Display(_core.Display.of_mesh(mesh_of(shown)._core))

    @staticmethod
    def of_file(path: Path) -> "Display":
        """Shows an OBJ, STL, PLY, OFF, 3MF, GLB, glTF or scene file.

        Raises
        ------
        Error
            Those of reading; ``EMPTY``.
        """
        return Display(_core.Display.of_file(os.fspath(path)))

    @property
    def polygon_count(self) -> int:
        """How many polygons there are, numbered as they were given."""
        return self._core.polygon_count()

    def render(self, view: View = View()) -> Picture:
        """The picture: at each pixel the nearest polygon, or as
        ``polygon_count + k`` the cap of the k-th different clip plane; with
        `View.caps_by_solid` 16 s more for that of solid s, or, where several
        are, of their number. Exact, whatever the number of threads.

        Raises
        ------
        Error
            ``BAD_CAMERA``, ``NOT_FINITE``, ``OUT_OF_RANGE`` (also for a ninth
            clip plane), ``STOPPED`` (by ``view.progress``), ``ZERO_AREA`` (a
            clip plane's normal is 0), ``OPEN`` (caps for what is not closed).
            These are those of all that asks for a view.

        Examples
        --------
        >>> from halfspace import CapStyle, Display, Plane, Solid, View
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> cut = View(width_px=64, height_px=48, caps=CapStyle(),
        ...            clips=[Plane((0, 0, -1), -0.5)])
        >>> sorted(set(display.render(cut).ids.flat))
        [-1, 2, 5, 6]
        """
        return Picture(*self._core.render(view))

    def draw(self, view: View = View(), *,
             crease_deg: float = 20) -> LineDrawing:
        """The edges that the view shows: silhouettes, borders, intersections
        and creases. Exact.

        Parameters
        ----------
        view : View
            Without clip planes.
        crease_deg : float
            Faces that turn by more make a crease. Units: degrees.

        Raises
        ------
        Error
            Those of `render`; ``OUT_OF_RANGE``, where there are too many.

        Examples
        --------
        >>> from halfspace import Display, Solid, View
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> lines = display.draw(View(width_px=64, height_px=48))
        >>> len(lines), int((lines.layers == 0).sum())
        (12, 9)
        """
        return LineDrawing(view.width_px, view.height_px,
                           *self._core.draw(view, float(crease_deg)))

    def figure(self, view: View = View(), *,
               by: FigureKey = "color") -> Figure:
        """The picture as regions, clip planes and caps too: what is seen at any
        point of the image, not only at pixels' centres. Exact; corners are
        rounded once.

        Parameters
        ----------
        view : View
        by : {"color", "polygon", "solid"}
            What is one region where parts of it meet.

        Raises
        ------
        Error
            Those of `render`; ``OUT_OF_RANGE``, where there is too much to be
            seen.

        Examples
        --------
        >>> from halfspace import Display, Solid, View
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> figure = display.figure(View(width_px=64, height_px=48), by="solid")
        >>> figure.polygons.tolist(), len(figure[0].loops)
        ([-1, 2], 2)
        """
        if by not in get_args(FigureKey):
            raise ValueError(f"by is {by!r}, not color, polygon or solid")
        return Figure(view.width_px, view.height_px,
                      *self._core.figure(view, by))

    def pick(self, view: View, x: int, y: int) -> Optional[Pick]:
        """What is seen at a pixel; None at the background, and off the image.

        Examples
        --------
        >>> from halfspace import Display, Solid, View
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> pick = display.pick(View(width_px=64, height_px=48), 32, 20)
        >>> pick.polygon, pick.solid
        (2, 0)
        """
        found = self._core.pick(view, int(x), int(y))
        if found is None:
            return None
        polygon, solid, point, distance = found
        px, py, pz = point
        return Pick(polygon, solid, (px, py, pz), distance)

    def first_hit(self, start: Vector, along: Vector) -> Optional[Hit]:
        """What the ray from a point on in a direction hits first, edges of
        polygons included. Polygons in whose plane the ray runs are not hit.

        Parameters
        ----------
        start, along : sequence of 3 floats
            Rounded to the camera's lattice; from there on all is exact.

        Raises
        ------
        Error
            ``NOT_FINITE``, ``OUT_OF_RANGE``, ``BAD_RAY``.

        Examples
        --------
        >>> from halfspace import Display, Solid
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> display.first_hit((0.5, 0.5, 4), (0, 0, -7)).fraction
        Fraction(3, 7)
        """
        found = self._core.first_hit(_triple(start), _triple(along))
        return None if found is None else _hit(found)

    def all_hits(self, start: Vector, along: Vector) -> List[Hit]:
        """All that a ray hits, in order."""
        return [_hit(parts) for parts in self._core.hits(
            _triple(start), _triple(along), False)]

    def hits_between(self, start: Vector, end: Vector) -> List[Hit]:
        """All that the way between two points hits, its ends included."""
        return [_hit(parts) for parts in self._core.hits(
            _triple(start), _triple(end), True)]

    def see_each_other(self, a: Vector, b: Vector) -> bool:
        """Whether nothing is between two points.

        Examples
        --------
        >>> from halfspace import Display, Solid
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> display.see_each_other((2, 2, 2), (-1, -1, -1))
        False
        """
        return self._core.see_each_other(_triple(a), _triple(b))

    def front_to_back(self, view: View = View(), *,
                      spans: bool = False) -> Traversal:
        """Parts of polygons so that none hides one before it.

        Parameters
        ----------
        view : View
        spans : bool
            With the pixels of each part, which cost as much as a picture.
        """
        return Traversal(self._core.order(view, True, bool(spans)))

    def back_to_front(self, view: View = View(), *,
                      spans: bool = False) -> Traversal:
        """Parts of polygons so that none hides one after it: a painter's order.

        Examples
        --------
        >>> from halfspace import Display, Solid
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> sorted(set(display.back_to_front().polygons.tolist()))
        [0, 1, 2, 3, 4, 5]
        """
        return Traversal(self._core.order(view, False, bool(spans)))

    def scan(self, view: View = View()) -> Ints:
        """Each pixel in which something is seen once, in spans: front to back,
        on a dynamic screen, until that is full.

        Returns
        -------
        ndarray of int32, shape (n, 4)
            The polygon; the line, the first and the last pixel.

        Examples
        --------
        >>> from halfspace import Display, Solid, View
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> view = View(width_px=64, height_px=48)
        >>> spans = display.scan(view)
        >>> int((spans[:, 3] - spans[:, 2] + 1).sum())
        1617
        """
        return self._core.scan(view)

    def insert(self, mesh: MeshLike) -> None:
        """Adds polygons, numbered after those that are there.

        Raises
        ------
        Error
            ``BAD_INDEX``, ``NOT_FINITE``, ``OUT_OF_RANGE``; nothing is changed
            then.
        """
        self._core.insert(mesh_of(mesh)._core)

    def remove(self, polygons: npt.ArrayLike) -> None:
        """Takes polygons out; the others keep their numbers. One that is gone
        already may be named again.

        Parameters
        ----------
        polygons : array_like of int32, shape (n,)

        Raises
        ------
        Error
            ``BAD_INDEX``; ``EMPTY``, where none would be left; nothing is
            changed then.

        Examples
        --------
        >>> from halfspace import Display, Solid, View
        >>> display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
        >>> display.remove([2])
        >>> bool((display.render(View(width_px=64, height_px=48)).ids == 2).any())
        False
        """
        self._core.remove(np.asarray(polygons, np.int32).reshape(-1))

    def move_to(self, vertices: npt.ArrayLike, points: npt.ArrayLike) -> None:
        """Takes vertices to other points, and with them the polygons there,
        which keep their numbers. A tree that was opened for `View.lazy`, or for
        rays, goes on: few polygons of many move at a cost that follows them,
        but for a copy of all. Others are made anew when they are needed.

        Parameters
        ----------
        vertices : array_like of int32, shape (n,)
            Numbered as they were given; of solids as `Solid.mesh` has them, one
            after the other.
        points : array_like of float64, shape (n, 3)
            Rounded to the display's grid: to a millionth or so of its greatest
            coordinate.

        Raises
        ------
        Error
            ``BAD_INDEX``, ``NOT_FINITE``, ``OUT_OF_RANGE``; ``UNKNOWN_FORMAT``
            (a scene file's polygons); ``EMPTY``, where nothing has an area any
            more; nothing is changed then.

        Examples
        --------
        >>> from halfspace import Display
        >>> display = Display.of(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        >>> display.move_to([0, 1, 2], [(0, 0, 3), (1, 0, 3), (0, 1, 3)])
        >>> display.first_hit((0.25, 0.25, 4), (0, 0, -1)).distance
        1.0
        """
        self._core.move_to(np.asarray(vertices, np.int32).reshape(-1),
                           np.asarray(points, np.float64).reshape(-1, 3))

    def visible_map(self, view: View = View(), *,
                    keys: Optional[npt.ArrayLike] = None,
                    most_cells: int = 50_000_000) -> VisibleMap:
        """The exact regions of the image.

        Parameters
        ----------
        view : View
        keys : array_like of int32, shape (polygon_count,), optional
            Polygons with one key make one region where they meet; not
            negative. None: each is for itself.
        most_cells : int
            Gives up where the map needs more.

        Raises
        ------
        Error
            ``BAD_CAMERA``, ``OUT_OF_RANGE``.
        """
        array = None if keys is None else np.asarray(keys, np.int32)
        core = _core.visible_map(self._core, _core.camera(self._core, view),
                                 array, view.cull, int(most_cells))
        return VisibleMap(core, view.width_px, view.height_px)

    def __repr__(self) -> str:
        return f"<halfspace.Display: {self.polygon_count} polygons>"


class DynamicScreen:
    """Which pixels of an image are still unlit, for renderers of one's own that
    go from front to back.

    Parameters
    ----------
    width_px, height_px : int
        1 to 65,536.

    Raises
    ------
    ValueError
        If a size is out of range.

    Examples
    --------
    >>> from halfspace import DynamicScreen
    >>> screen = DynamicScreen(8, 1)
    >>> screen.light([(0, 2, 4)]).tolist(), screen.light([(0, 0, 7)]).tolist()
    ([[0, 2, 4]], [[0, 0, 1], [0, 5, 7]])
    >>> screen.is_full()
    True
    """

    __slots__ = ("_core", "_size")

    def __init__(self, width_px: int, height_px: int) -> None:
        if not (1 <= width_px <= 65536 and 1 <= height_px <= 65536):
            raise ValueError("a screen has 1 to 65,536 columns and rows")
        self._core = _core.DynamicScreen(width_px, height_px)
        self._size = width_px, height_px

    def light(self, spans: npt.ArrayLike) -> Ints:
        """Lights spans, and gives those parts of them that were unlit.

        Parameters
        ----------
        spans : array_like of int32, shape (n, 3)
            The line, the first and the last pixel; within the screen.

        Raises
        ------
        ValueError
            If a span is not within the screen.
        """
        rows = np.asarray(spans, np.int32).reshape(-1, 3)
        width, height = self._size
        if rows.size and not (
                (rows >= 0).all() and (rows[:, 0] < height).all() and
                (rows[:, 2] < width).all() and
                (rows[:, 1] <= rows[:, 2]).all()):
            raise ValueError(f"a span is not within {width} x {height} pixels")
        return self._core.light(rows)

    def is_full(self) -> bool:
        """Whether every pixel is lit."""
        return self._core.is_full()
