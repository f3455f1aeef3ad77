"""Polygons in arrays: what goes into the library and what comes out."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core

__all__ = ["Mesh", "MeshLike"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]


def _polygons(faces: Any) -> Tuple[npt.NDArray[np.uint32], Ints]:
    """The first corners and the corners of faces in either form."""
    if isinstance(faces, np.ndarray) and faces.ndim == 2:
        rows, columns = faces.shape
        first = np.arange(rows + 1, dtype=np.uint32) * np.uint32(columns)
        return first, _indices(faces.reshape(-1))
    sizes = [len(face) for face in faces]
    if sizes and min(sizes) == max(sizes):
        return _polygons(np.asarray(faces))
    first = np.zeros(len(sizes) + 1, np.uint32)
    np.cumsum(sizes, out=first[1:])
    flat = [np.asarray(face).reshape(-1) for face in faces]
    return first, _indices(np.concatenate(flat) if flat else np.empty(0, int))


def _indices(corners: npt.NDArray[Any]) -> Ints:
    if corners.size and corners.dtype.kind not in "iu":
        raise TypeError(f"faces hold {corners.dtype}, not whole numbers")
    if corners.size and (corners.max() > 2**31 - 1 or corners.min() < -2**31):
        raise OverflowError("faces hold numbers of more than 32 bits")
    return np.ascontiguousarray(corners, dtype=np.int32)


class Mesh:
    """Polygons, and their properties, as read-only arrays.

    The arrays that a mesh gives are views of the memory that the library has
    filled; each keeps it alive. Arrays that go in are copied once.

    Parameters
    ----------
    vertices : array_like, shape (v, 3)
        Points. Units: model units.
    faces : array_like of int, shape (f, k), or sequence of sequences of int
        The vertices of each polygon, counterclockwise as seen from outside.
    colors : array_like of uint8, shape (f, 3), optional
        Red, green and blue of each polygon.
    materials : array_like of int32, shape (f,), optional
        A number that polygons have in common; faces never merge across it.
    fields : array_like, shape (c, k), optional
        Numbers at each of the c corners of all polygons, in order: texture
        coordinates, normals, temperatures.

    Raises
    ------
    ValueError
        If an array has another shape.
    TypeError
        If the faces are no whole numbers.

    Examples
    --------
    >>> import halfspace
    >>> mesh = halfspace.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> len(mesh), mesh.vertices.shape
    (1, (3, 3))
    """

    __slots__ = ("_core",)

    def __init__(self, vertices: npt.ArrayLike, faces: Any, *,
                 colors: Optional[npt.ArrayLike] = None,
                 materials: Optional[npt.ArrayLike] = None,
                 fields: Optional[npt.ArrayLike] = None) -> None:
        first, corners = _polygons(faces)
        points = np.asarray(vertices, dtype=np.float64)
        if points.size == 0:
            points = points.reshape(0, 3)
        self._core = _core.make_mesh(
            points, first, corners,
            None if colors is None else np.asarray(colors, np.uint8),
            None if materials is None else np.asarray(materials, np.int32),
            None if fields is None else np.asarray(fields, np.float64))

    @classmethod
    def _of(cls, core: _core.Mesh) -> "Mesh":
        mesh = cls.__new__(cls)
        mesh._core = core
        return mesh

    @property
    def vertices(self) -> Floats:
        """Points, shape (v, 3). Units: model units."""
        return self._core.vertices

    @property
    def first_corner(self) -> npt.NDArray[np.uint32]:
        """Where each polygon begins in `corners`, and their end: (f + 1,)."""
        return self._core.first_corner

    @property
    def corners(self) -> Ints:
        """The vertices of all polygons, one after the other: (c,)."""
        return self._core.corners

    @property
    def colors(self) -> npt.NDArray[np.uint8]:
        """Red, green and blue by polygon, (f, 3); or (0, 3)."""
        return self._core.colors

    @property
    def materials(self) -> Ints:
        """A number by polygon, (f,); or (0,)."""
        return self._core.materials

    @property
    def fields(self) -> Floats:
        """Numbers by corner, (c, k); or (0, 0)."""
        return self._core.fields

    @property
    def origins(self) -> Ints:
        """Of results: by polygon its operand, as `Solid.operands` counts, and
        the polygon of that operand, (f, 2); or (0, 2)."""
        return self._core.origins

    @property
    def faces(self) -> Union[Ints, List[Ints]]:
        """The corners by polygon.

        Returns
        -------
        ndarray of int32, shape (f, k), or list of ndarray
            A view of `corners`: one array if all polygons have k corners.

        Examples
        --------
        >>> import halfspace
        >>> halfspace.Solid.box((0, 0, 0), (1, 1, 1)).mesh().faces.shape
        (6, 4)
        """
        first = self.first_corner
        sizes = np.diff(first)
        if len(sizes) == 0:
            return self.corners.reshape(0, 3)
        if (sizes == sizes[0]).all():
            return self.corners.reshape(-1, int(sizes[0]))
        return np.split(self.corners, first[1:-1].astype(np.intp))

    def __len__(self) -> int:
        return len(self.first_corner) - 1

    def __iter__(self) -> Iterator[Any]:
        """The vertices and the faces: ``V, F = mesh``."""
        return iter((self.vertices, self.faces))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mesh):
            return NotImplemented
        return self._core == other._core

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Tuple[Any, ...]:
        return _from_arrays, (
            self.vertices, self.first_corner, self.corners,
            self.colors if len(self.colors) else None,
            self.materials if len(self.materials) else None,
            self.fields if len(self.fields) else None)

    def __copy__(self) -> "Mesh":
        return self

    def __deepcopy__(self, memo: Any) -> "Mesh":
        return self

    def __repr__(self) -> str:
        return (f"<halfspace.Mesh: {len(self.vertices)} vertices, "
                f"{len(self)} polygons>")


def _from_arrays(vertices: Floats, first: npt.NDArray[np.uint32],
                 corners: Ints, colors: Any, materials: Any,
                 fields: Any) -> Mesh:
    """A mesh from its own arrays, for pickles. Origins stay behind."""
    return Mesh._of(_core.make_mesh(vertices, first, corners, colors,
                                    materials, fields))


# A Mesh, a pair of vertices and faces, a meshio mesh or a trimesh.
MeshLike = Any


def mesh_of(thing: MeshLike) -> Mesh:
    """The mesh that a thing is: a `Mesh`, a pair (V, F), a meshio mesh, or
    anything with `vertices` and `faces`, such as a trimesh."""
    if isinstance(thing, Mesh):
        return thing
    if hasattr(thing, "points") and hasattr(thing, "cells"):
        from . import meshio
        return meshio.from_meshio(thing)
    if hasattr(thing, "vertices") and hasattr(thing, "faces"):
        return Mesh(thing.vertices, np.asarray(thing.faces))
    if isinstance(thing, (tuple, list)) and len(thing) == 2:
        return Mesh(*thing)
    raise TypeError(f"{type(thing).__name__} is no mesh: a Mesh, a pair of "
                    "vertices and faces, a meshio mesh or a trimesh is")


def _integer(digits: str) -> int:
    """int(), which refuses numbers of more than 4,300 digits."""
    if len(digits) <= 4000:
        return int(digits or "0")
    low = len(digits) // 2
    ten: int = 10 ** low
    return _integer(digits[:-low]) * ten + _integer(digits[-low:])


def fraction_of(text: str) -> Fraction:
    """The number that the library writes as a decimal or as a fraction, of
    however many digits."""
    sign = -1 if text.startswith("-") else 1
    above, _, below = text.lstrip("-").partition("/")
    whole, _, rest = above.partition(".")
    return Fraction(sign * _integer(whole + rest),
                    _integer(below or "1") * 10 ** len(rest))


def points_2d(points: npt.ArrayLike) -> Floats:
    return np.ascontiguousarray(points, dtype=np.float64).reshape(-1, 2)


def holes_2d(holes: Sequence[npt.ArrayLike]) -> List[Floats]:
    return [points_2d(hole) for hole in holes]
