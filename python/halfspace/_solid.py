"""Solids: values that are expressions of other solids."""

from __future__ import annotations

import os
import pickle
from dataclasses import dataclass
from fractions import Fraction
from typing import (Any, Callable, Dict, Iterable, List, Literal, NamedTuple,
                    Optional, Sequence, Tuple, Union)

import numpy as np
import numpy.typing as npt

from . import _core
from ._mesh import (Floats, Mesh, MeshLike, fraction_of, holes_2d, mesh_of,
                    points_2d)

__all__ = ["Plane", "Region", "RoundingReport", "Solid"]

Merge = Literal["origin", "plane", "none"]
Progress = Callable[[float], Optional[bool]]
Vector = Union[Sequence[Any], npt.NDArray[Any]]
Path = Union[str, "os.PathLike[str]"]


class Plane(NamedTuple):
    """The plane normal . p = offset; its negative side is where that is less.

    Examples
    --------
    >>> import halfspace
    >>> halfspace.Plane((0, 0, 1), 2.5).offset
    2.5
    """

    normal: Vector
    offset: float = 0.0


@dataclass(frozen=True)
class Region:
    """A region of a plane in space.

    Attributes
    ----------
    boundary : ndarray of float64, shape (n, 3)
        Counterclockwise as seen from the plane's positive side.
    holes : list of ndarray of float64, shape (n, 3)
        Clockwise.
    """

    boundary: Floats
    holes: List[Floats]


@dataclass(frozen=True)
class RoundingReport:
    """What rounding did on the way to a solid: all there is of it.

    Attributes
    ----------
    moved : int
        How many coordinates moved.
    max_move : float
        No coordinate moved farther. Units: model units.
    step : float
        Of the grid that all operands are on. Units: model units.
    grid_bits : int
        26, 40 or 54.
    """

    moved: int
    max_move: float
    step: float
    grid_bits: int


# How a solid was made, so that it can be made again: the name of the step, its
# operands and its arguments.
_Recipe = Tuple[str, Tuple["Solid", ...], Tuple[Any, ...]]


def _triple(vector: Vector) -> Tuple[float, float, float]:
    x, y, z = vector
    return float(x), float(y), float(z)


def affine_rows(matrix: npt.ArrayLike) -> List[List[float]]:
    """The three rows of an affine map, of an array of three or four."""
    rows = np.asarray(matrix, dtype=np.float64)
    if rows.shape == (4, 4) and (rows[3] == (0, 0, 0, 1)).all():
        rows = rows[:3]
    if rows.shape != (3, 4):
        raise ValueError("an affine map has the shape (3, 4), or (4, 4) "
                         "and the last row 0, 0, 0, 1")
    return rows.tolist()  # type: ignore[no-any-return]


class Solid:
    """A solid: a value that is an expression of other solids.

    An expression is worked out when something is asked of it, once, and then
    kept. Copies are free and share that. Solids may be used in any threads at
    once, and other threads run while a solid is worked out. Ctrl-C stops the
    work between two booleans.

    A float of at most 12 significant decimal digits is that decimal, so 0.1 is
    one tenth; any other is the double. All operands of a result are put on one
    grid of integers, exactly where that can be; `rounding` says how far
    anything moved. From there on everything is exact.

    Making and combining solids cannot fail: what is wrong comes out where the
    solid is used, as a `halfspace.Error`: ``OUT_OF_RANGE`` (no grid holds all
    operands), ``OPEN``, ``INSIDE_OUT``, ``SELF_CROSSING`` (an operand is no
    solid), ``UNBOUNDED``, and those of reading files.

    ``+ - & ^ ~`` are union, difference, intersection, symmetric difference and
    complement, all regularised. Of faces that coincide the first solid's is
    kept. ``Solid()`` is empty.

    Examples
    --------
    >>> from halfspace import Solid
    >>> plate = Solid.box((0, 0, 0), (40, 30, 5))
    >>> drill = Solid.box((10, 10, -1), (20, 20, 6))
    >>> (plate - drill).volume()
    5500.0
    >>> (plate - drill).genus()
    1
    """

    __slots__ = ("_core", "_recipe", "__weakref__")

    def __init__(self) -> None:
        self._core = _core.Solid()
        self._recipe: Optional[_Recipe] = ("empty", (), ())

    @classmethod
    def _of(cls, core: _core.Solid, recipe: Optional[_Recipe]) -> "Solid":
        solid = cls.__new__(cls)
        solid._core = core
        solid._recipe = recipe
        return solid

    @staticmethod
    def _made(step: str, operands: Tuple["Solid", ...],
              *arguments: Any) -> "Solid":
        core = _STEPS[step](*[solid._core for solid in operands], *arguments)
        return Solid._of(core, (step, operands, arguments))

    # Makers.

    @staticmethod
    def box(corner: Vector, opposite: Vector) -> "Solid":
        """The box between two opposite corners.

        Parameters
        ----------
        corner, opposite : sequence of 3 floats
            Units: model units.

        Raises
        ------
        Error
            ``ZERO_AREA`` where it is used, if it is flat.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.box((0, 0, 0), (1, 2, 0.3)).exact_volume()
        Fraction(3, 5)
        """
        return Solid._made("box", (), _triple(corner), _triple(opposite))

    @staticmethod
    def sphere(radius: float, segments: int = 32) -> "Solid":
        """A sphere about the origin: `segments` meridians, and half as many
        bands of latitude. Its vertices are on the sphere, but for rounding.

        Parameters
        ----------
        radius : float
            Above 0. Units: model units.
        segments : int
            At least 3.

        Raises
        ------
        Error
            ``OUT_OF_RANGE`` where it is used, of this maker and the next ones.

        Examples
        --------
        >>> from halfspace import Solid
        >>> round(Solid.sphere(1, 64).volume(), 1)
        4.2
        """
        return Solid._made("sphere", (), float(radius), int(segments))

    @staticmethod
    def cylinder(radius: float, height: float, segments: int = 32) -> "Solid":
        """A cylinder about the z axis, from z = 0 up.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.cylinder(1, 2, 4).volume()
        4.0
        """
        return Solid._made("cylinder", (), float(radius), float(height),
                           int(segments))

    @staticmethod
    def cone(bottom_radius: float, top_radius: float, height: float,
             segments: int = 32) -> "Solid":
        """A cone or, if both radii are above 0, a frustum, from z = 0 up.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.cone(1, 0, 3, 4).volume()
        2.0
        """
        return Solid._made("cone", (), float(bottom_radius), float(top_radius),
                           float(height), int(segments))

    @staticmethod
    def torus(radius: float, tube_radius: float, segments: int = 48,
              tube_segments: int = 24) -> "Solid":
        """A ring about the z axis: `tube_radius` about a circle of `radius`.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.torus(3, 1).genus()
        1
        """
        return Solid._made("torus", (), float(radius), float(tube_radius),
                           int(segments), int(tube_segments))

    @staticmethod
    def prism(points: npt.ArrayLike, height: float, *,
              holes: Sequence[npt.ArrayLike] = ()) -> "Solid":
        """An outline in the plane z = 0, drawn up to z = height. Exact.

        Parameters
        ----------
        points : array_like, shape (n, 2)
            The outline, in either direction.
        height : float
            Above 0.
        holes : sequence of array_like, shape (n, 2)
            No two of all these loops may cross.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.prism([(0, 0), (4, 0), (0, 4)], 1).exact_volume()
        Fraction(8, 1)
        """
        return Solid._made("prism", (), points_2d(points), holes_2d(holes),
                           float(height))

    @staticmethod
    def revolution(points: npt.ArrayLike, segments: int = 32) -> "Solid":
        """An outline of points (r, z) with r >= 0, turned about the z axis.

        Parameters
        ----------
        points : array_like, shape (n, 2)
        segments : int
            At least 3.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.revolution([(1, 0), (2, 0), (2, 1), (1, 1)], 4).volume()
        6.0
        """
        return Solid._made("revolution", (), points_2d(points), int(segments))

    @staticmethod
    def hull(points: npt.ArrayLike) -> "Solid":
        """The convex hull of four points or more, not all in a plane. Exact.

        Parameters
        ----------
        points : array_like, shape (n, 3)

        Examples
        --------
        >>> from halfspace import Solid
        >>> corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        >>> Solid.hull(corners).exact_volume()
        Fraction(1, 6)
        """
        array = np.array(points, dtype=np.float64).reshape(-1, 3)
        return Solid._made("hull", (), array)

    @staticmethod
    def from_mesh(mesh: MeshLike, *, resolve: bool = False,
                  merge_coplanar: bool = True,
                  may_round: bool = False) -> "Solid":
        """The solid whose surface is the mesh, faces outwards.

        Parameters
        ----------
        mesh : Mesh, (V, F), meshio mesh or trimesh
            Copied.
        resolve : bool
            Take what the surface winds round at least once, where it crosses
            itself, in place of refusing it.
        merge_coplanar : bool
            Make polygons in one plane that share an edge and all properties
            one face before anything else.
        may_round : bool
            Let the finest grid round the coordinates, where other operands
            need one that does not hold them, in place of an error. The
            program does so with all files.

        Examples
        --------
        >>> from halfspace import Solid
        >>> V, F = Solid.box((0, 0, 0), (1, 1, 1)).mesh(triangles=True)
        >>> Solid.from_mesh((V, F)).volume()
        1.0
        """
        return Solid._made("from_mesh", (), mesh_of(mesh), bool(resolve),
                           bool(merge_coplanar), bool(may_round))

    @staticmethod
    def from_file(path: Path, *, resolve: bool = False,
                  merge_coplanar: bool = True,
                  may_round: bool = False) -> "Solid":
        """The solid in a mesh, scene or .hsolid file, which is read when
        it is needed. Text is read as exact decimals.

        Parameters
        ----------
        path : path-like
        resolve, merge_coplanar, may_round : bool
            As of `from_mesh`.

        Raises
        ------
        Error
            Where it is used: ``UNREADABLE``, ``SYNTAX`` and others, with
            `file` and, of text, `line`.
        """
        return Solid._made("from_file", (), os.fspath(path), bool(resolve),
                           bool(merge_coplanar), bool(may_round))

    @staticmethod
    def from_text(script: str, folder: Path = "") -> "Solid":
        """What a script says (docs/guide.md has the language); its files are
        sought from `folder`.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.from_text("box(2, 2, 2)").volume()
        8.0
        """
        return Solid._made("from_text", (), script, os.fspath(folder))

    @staticmethod
    def half_space(normal: Vector, offset: float = 0.0) -> "Solid":
        """All points on the negative side of a plane; a result must be bounded.

        Parameters
        ----------
        normal : sequence of 3 floats, or Plane
            Not zero.
        offset : float
            The plane is normal . p = offset.

        Examples
        --------
        >>> from halfspace import Solid
        >>> corner = Solid.half_space((1, 2, 3), 1)
        >>> (Solid.box((0, 0, 0), (1, 1, 1)) & corner).exact_volume()
        Fraction(1, 36)
        """
        return Solid._made("half_space", (), *_plane(normal, offset))

    # Maps.

    def translated(self, by: Vector) -> "Solid":
        """Moved. Exact where a grid holds the result.

        Parameters
        ----------
        by : sequence of 3 floats
            Units: model units.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.box((0, 0, 0), (1, 1, 1)).translated((0.5, 0, 0)).bounds()
        array([[0.5, 0. , 0. ],
               [1.5, 1. , 1. ]])
        """
        return Solid._made("translated", (self,), _triple(by))

    def scaled(self, factor: Union[float, Vector]) -> "Solid":
        """Scaled from the origin by a factor, or three of them, not 0.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.box((0, 0, 0), (1, 1, 1)).scaled((2, 3, 0.5)).volume()
        3.0
        """
        if np.ndim(factor) == 0:
            value = float(factor)  # type: ignore[arg-type]
            factors = (value, value, value)
        else:
            factors = _triple(factor)  # type: ignore[arg-type]
        return Solid._made("scaled", (self,), factors)

    def rotated(self, axis: Vector, degrees: float) -> "Solid":
        """Turned about an axis through the origin, counterclockwise as seen
        from where it points. Quarter turns about coordinate axes are exact.

        Parameters
        ----------
        axis : sequence of 3 floats
        degrees : float
            Units: degrees.

        Examples
        --------
        >>> from halfspace import Solid
        >>> box = Solid.box((0, 0, 0), (1, 2, 3)).rotated((0, 0, 1), 90)
        >>> box.rounding().moved
        0
        """
        return Solid._made("rotated", (self,), _triple(axis), float(degrees))

    def mirrored(self, normal: Vector, offset: float = 0.0) -> "Solid":
        """Mirrored at a plane. Planes across an axis are exact.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.box((0, 0, 0), (1, 1, 1)).mirrored((1, 0, 0)).bounds()[0]
        array([-1.,  0.,  0.])
        """
        return Solid._made("mirrored", (self,), *_plane(normal, offset))

    def transformed(self, matrix: npt.ArrayLike) -> "Solid":
        """Moved by any affine map.

        Parameters
        ----------
        matrix : array_like, shape (3, 4) or (4, 4)
            (x, y, z) goes to ``matrix[:3] @ (x, y, z, 1)``.

        Raises
        ------
        ValueError
            If the shape is another one, or the last of four rows is not
            0, 0, 0, 1.

        Examples
        --------
        >>> import numpy as np
        >>> from halfspace import Solid
        >>> Solid.box((0, 0, 0), (1, 1, 1)).transformed(2 * np.eye(3, 4)).volume()
        8.0
        """
        return Solid._made("transformed", (self,), affine_rows(matrix))

    # Names.

    def named(self, name: str) -> "Solid":
        """The same solid under a name, which messages and origins use.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.sphere(1).named("ball").name
        'ball'
        """
        return Solid._made("named", (self,), name)

    @property
    def name(self) -> str:
        """The name; of other operands what made them, or the file."""
        return self._core.name()

    # Algebra.

    def __add__(self, other: "Solid") -> "Solid":
        return self._combined("union", other)

    def __sub__(self, other: "Solid") -> "Solid":
        return self._combined("difference", other)

    def __and__(self, other: "Solid") -> "Solid":
        return self._combined("intersection", other)

    def __xor__(self, other: "Solid") -> "Solid":
        return self._combined("symmetric_difference", other)

    def _combined(self, step: str, other: "Solid") -> "Solid":
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid._made(step, (self, other))

    def __invert__(self) -> "Solid":
        return Solid._made("complement", (self,))

    @staticmethod
    def union_of(solids: Iterable["Solid"]) -> "Solid":
        """The union of many at once; of none, the empty solid.

        Examples
        --------
        >>> from halfspace import Solid
        >>> box = Solid.box((0, 0, 0), (1, 1, 1))
        >>> Solid.union_of(box.translated((i, 0, 0)) for i in range(9)).volume()
        9.0
        """
        return Solid._made("union_of", tuple(solids))

    @staticmethod
    def intersection_of(solids: Iterable["Solid"]) -> "Solid":
        """The intersection of many at once; of none, the empty solid."""
        return Solid._made("intersection_of", tuple(solids))

    def split(self, normal: Vector,
              offset: float = 0.0) -> Tuple["Solid", "Solid"]:
        """The parts on the negative and on the positive side of a plane.

        Examples
        --------
        >>> from halfspace import Solid
        >>> low, high = Solid.box((0, 0, 0), (1, 1, 1)).split((0, 0, 1), 0.25)
        >>> low.volume(), high.volume()
        (0.25, 0.75)
        """
        plane = _plane(normal, offset)
        parts = self._core.split(*plane)
        return (Solid._of(parts[0], ("below", (self,), plane)),
                Solid._of(parts[1], ("above", (self,), plane)))

    def __eq__(self, other: object) -> bool:
        """Whether two are the same expression, made at the same place; not
        whether they are the same points, which is ``(a ^ b).is_empty()``."""
        if not isinstance(other, Solid):
            return NotImplemented
        return self._core.is_same(other._core)

    __hash__ = None  # type: ignore[assignment]

    # Results.

    def evaluate(self, *, threads: int = 0,
                 progress: Optional[Progress] = None) -> None:
        """Works the solid out now.

        Parameters
        ----------
        threads : int
            0: as many as the machine has.
        progress : callable, optional
            Receives the share that is done, 0 to 1; where it returns False the
            work stops. It must not ask anything of this solid.

        Raises
        ------
        Error
            As the class says; ``STOPPED``. What `progress` raises, and
            KeyboardInterrupt, come out as they are.

        Examples
        --------
        >>> from halfspace import Solid
        >>> shares = []
        >>> part = Solid.box((0, 0, 0), (2, 2, 2)) - Solid.sphere(1)
        >>> part.evaluate(progress=shares.append)
        >>> shares[-1]
        1.0
        """
        self._core.evaluate(int(threads), progress)

    def mesh(self, *, merge: Merge = "origin", triangles: bool = False,
             threads: int = 0, progress: Optional[Progress] = None) -> Mesh:
        """The surface, with origins, and with the operands' properties if any
        of them has some. Rounded once, to nearest, from exact vertices.

        Parameters
        ----------
        merge : {"origin", "plane", "none"}
            Which faces in one plane become one: parts of one face of one
            operand; all, whatever their properties; none.
        triangles : bool
            Triangles only, in place of convex polygons.
        threads, progress
            Of working the solid out: as of `evaluate`.

        Examples
        --------
        >>> from halfspace import Solid
        >>> V, F = Solid.box((0, 0, 0), (1, 1, 1)).mesh(triangles=True)
        >>> V.shape, F.shape
        ((8, 3), (12, 3))
        """
        _check_merge(merge)
        return Mesh._of(self._core.mesh(merge, bool(triangles), int(threads),
                                        progress))

    def save(self, path: Path, *, merge: Merge = "origin",
             triangles: bool = False, threads: int = 0,
             progress: Optional[Progress] = None) -> None:
        """Writes the surface; the name of the file says the format. A name
        that ends in ``.hsolid`` gets the solid itself, exactly.

        Parameters
        ----------
        path : path-like
        merge, triangles, threads, progress
            As of `mesh`.

        Raises
        ------
        Error
            ``UNWRITABLE``, ``UNKNOWN_FORMAT``, and those of the class.
        """
        _check_merge(merge)
        self._core.save(os.fspath(path), merge, bool(triangles), int(threads),
                        progress)

    def decompose(self) -> List["Solid"]:
        """The connected parts, each with its cavities; parts that only touch
        are apart. Exact.

        Returns
        -------
        list of Solid
            Each has the operands, origins and properties of the whole.

        Raises
        ------
        Error
            Those of the solid; ``OUT_OF_RANGE`` where a part is used that a map
            rounds away.

        Examples
        --------
        >>> from halfspace import Solid
        >>> box = Solid.box((0, 0, 0), (1, 1, 1))
        >>> both = box + box.translated((1, 1, 0))
        >>> [part.volume() for part in both.decompose()]
        [1.0, 1.0]
        """
        return [Solid._of(core, ("part", (self,), (number,)))
                for number, core in enumerate(self._core.decompose())]

    def polygons_by_operand(self) -> Dict[str, int]:
        """How many polygons of `mesh` come from operands of each name.

        Examples
        --------
        >>> from halfspace import Solid
        >>> part = Solid.box((0, 0, 0), (2, 2, 2)) - Solid.sphere(1, 8)
        >>> sorted(part.polygons_by_operand())
        ['box', 'sphere']
        """
        return self._core.polygons_by_operand()

    def operands(self) -> List["Solid"]:
        """The operands that the result was made of, unmoved, half-spaces last:
        as `Mesh.origins` counts.

        Examples
        --------
        >>> from halfspace import Solid
        >>> part = Solid.sphere(1) - Solid.cylinder(0.5, 3).named("drill")
        >>> [operand.name for operand in part.operands()]
        ['sphere', 'drill']
        """
        known = _ordered(self)

        def found(core: _core.Solid) -> "Solid":
            for solid in known:
                if solid._core.is_same(core):
                    return solid
            return Solid._of(core, None)

        return [found(core) for core in self._core.operands()]

    def rounding(self) -> RoundingReport:
        """What rounding did to the operands.

        Examples
        --------
        >>> from halfspace import Solid
        >>> Solid.box((0, 0, 0), (1, 1, 0.1)).rounding().max_move
        0.0
        """
        return RoundingReport(*self._core.rounding())

    def section(self, normal: Vector, offset: float = 0.0) -> List[Region]:
        """Where a plane cuts the solid: the regions of the plane with the solid
        on both sides, or on its negative side.

        Parameters
        ----------
        normal : sequence of 3 floats, or Plane
        offset : float
            The plane is normal . p = offset.

        Examples
        --------
        >>> from halfspace import Solid
        >>> ring = Solid.cylinder(2, 1) - Solid.cylinder(1, 1)
        >>> [len(region.holes) for region in ring.section((0, 0, 1), 0.5)]
        [1]
        """
        return [Region(*parts)
                for parts in self._core.section(*_plane(normal, offset))]

    # Measures and questions.

    def is_empty(self) -> bool:
        """Whether there is no point in it."""
        return self._core.is_empty()

    def volume(self) -> float:
        """The volume, rounded to the nearest double. Units: model units ^ 3."""
        return self._core.volume()

    def area(self) -> float:
        """The surface's area, to the nearest double. Units: model units ^ 2."""
        return self._core.area()

    def exact_volume(self) -> Fraction:
        """The volume in full.

        Examples
        --------
        >>> from halfspace import Solid
        >>> a = Solid.box((0, 0, 0), (0.1, 0.1, 0.1))
        >>> a.exact_volume()
        Fraction(1, 1000)
        """
        return fraction_of(self._core.exact_volume())

    def exact_area(self) -> Optional[Fraction]:
        """The area in full, where it is rational; None where it is not."""
        text = self._core.exact_area()
        return None if text is None else fraction_of(text)

    def bounds(self) -> Floats:
        """The bounding box, to the nearest doubles.

        Returns
        -------
        ndarray of float64, shape (2, 3)
            The lowest and the highest coordinates.

        Raises
        ------
        Error
            ``EMPTY``.
        """
        return np.array(self._core.bounds())

    def centroid(self) -> Floats:
        """The centre of mass, shape (3,). Raises `Error` ``EMPTY``."""
        return np.array(self._core.centroid())

    def inertia(self) -> Floats:
        """The tensor of inertia about the centre of mass at density 1, shape
        (3, 3): entry (i, j) is the integral of |p|^2 [i = j] - p_i p_j."""
        return np.array(self._core.inertia())

    def shell_count(self) -> int:
        """How many connected surfaces there are."""
        return self._core.shell_count()

    def genus(self) -> int:
        """The handles of all surfaces: 1 of a torus."""
        return self._core.genus()

    def locate(self, points: npt.ArrayLike) -> Any:
        """Where points are against the solid. Exact.

        Parameters
        ----------
        points : array_like, shape (3,) or (n, 3)

        Returns
        -------
        int, or ndarray of int8 with shape (n,)
            -1 inside, 0 on the surface, 1 outside.

        Examples
        --------
        >>> from halfspace import Solid
        >>> box = Solid.box((0, 0, 0), (1, 1, 1))
        >>> box.locate((1, 0.5, 0.5))
        0
        >>> box.locate([(0.5, 0.5, 0.5), (2, 0, 0)])
        array([-1,  1], dtype=int8)
        """
        array = np.asarray(points, dtype=np.float64)
        sides = self._core.locate(array.reshape(-1, 3))
        return int(sides[0]) if array.ndim == 1 else sides

    def overlaps(self, other: "Solid") -> bool:
        """Whether the interiors of two solids have a point in common."""
        return self._core.overlaps(other._core)

    def touches(self, other: "Solid") -> bool:
        """Whether the closed solids have a point in common."""
        return self._core.touches(other._core)

    def contains(self, other: "Solid") -> bool:
        """Whether all of the other solid is in this one.

        Examples
        --------
        >>> from halfspace import Solid
        >>> box = Solid.box((0, 0, 0), (4, 4, 4))
        >>> box.contains(Solid.box((0, 0, 0), (1, 1, 1)))
        True
        """
        return self._core.contains(other._core)

    # Copies and pickles.

    def __copy__(self) -> "Solid":
        return self

    def __deepcopy__(self, memo: Any) -> "Solid":
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        """A pickle is the expression, step by step: a solid is made again and
        worked out where it is used. Files are read there, too."""
        numbers: Dict[int, int] = {}
        steps: List[Tuple[str, Tuple[int, ...], Tuple[Any, ...]]] = []
        for solid in _ordered(self):
            if solid._recipe is None:
                raise pickle.PicklingError(
                    f"{solid.name}: an operand of a script has no pickle; "
                    "pickle the script's solid, or its mesh")
            step, operands, arguments = solid._recipe
            numbers[id(solid)] = len(steps)
            steps.append((step, tuple(numbers[id(o)] for o in operands),
                          arguments))
        return _from_steps, (steps,)

    def __repr__(self) -> str:
        step = self._recipe[0] if self._recipe else "operand"
        name = self.name
        return f"<halfspace.Solid: {name or step}>"


def _plane(normal: Any, offset: float) -> Tuple[Any, float]:
    if isinstance(normal, Plane):
        return _triple(normal.normal), float(normal.offset)
    return _triple(normal), float(offset)


def _check_merge(merge: str) -> None:
    if merge not in ("origin", "plane", "none"):
        raise ValueError(f"merge is {merge!r}, not origin, plane or none")


def _ordered(root: Solid) -> List[Solid]:
    """The solids of an expression, each once and after its operands. No
    recursion, however deep it is."""
    found: List[Solid] = []
    seen = set()
    stack = [(root, False)]
    while stack:
        solid, is_done = stack.pop()
        if is_done:
            found.append(solid)
        elif id(solid) not in seen:
            seen.add(id(solid))
            stack.append((solid, True))
            if solid._recipe is not None:
                stack += [(operand, False) for operand in solid._recipe[1]]
    return found


def _from_steps(steps: List[Tuple[str, Tuple[int, ...],
                                  Tuple[Any, ...]]]) -> Solid:
    made: List[Solid] = []
    for step, operands, arguments in steps:
        made.append(Solid._made(step, tuple(made[i] for i in operands),
                                *arguments))
    return made[-1]


def _part(solid: _core.Solid, number: int) -> _core.Solid:
    return solid.decompose()[number]


_STEPS: Dict[str, Callable[..., _core.Solid]] = {
    "empty": _core.Solid,
    "box": _core.Solid.box,
    "sphere": _core.Solid.sphere,
    "cylinder": _core.Solid.cylinder,
    "cone": _core.Solid.cone,
    "torus": _core.Solid.torus,
    "prism": _core.Solid.prism,
    "revolution": _core.Solid.revolution,
    "hull": _core.Solid.hull,
    "from_mesh": lambda mesh, *how: _core.Solid.from_mesh(mesh._core, *how),
    "from_file": _core.Solid.from_file,
    "from_text": _core.Solid.from_text,
    "half_space": _core.Solid.half_space,
    "translated": _core.Solid.translated,
    "scaled": _core.Solid.scaled,
    "rotated": _core.Solid.rotated,
    "mirrored": _core.Solid.mirrored,
    "transformed": _core.Solid.transformed,
    "named": _core.Solid.named,
    "union": _core.Solid.union,
    "difference": _core.Solid.difference,
    "intersection": _core.Solid.intersection,
    "symmetric_difference": _core.Solid.symmetric_difference,
    "complement": _core.Solid.complement,
    "union_of": lambda *solids: _core.Solid.union_of(list(solids)),
    "intersection_of":
        lambda *solids: _core.Solid.intersection_of(list(solids)),
    "below": lambda solid, *plane: solid.split(*plane)[0],
    "above": lambda solid, *plane: solid.split(*plane)[1],
    "part": _part,
    "mended": lambda *how: _core.mended(*how)[0],
}
