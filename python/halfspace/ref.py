"""The reference: what the library does, carried out plainly in exact rational
numbers. An oracle for tests; slow, so for small inputs.

Examples
--------
>>> from halfspace import Solid, ref
>>> a = Solid.box((0, 0, 0), (2, 2, 2))
>>> b = a.translated((1, 1, 1))
>>> ref.Solid(a.mesh()) - ref.Solid(b.mesh())
<halfspace.ref.Solid: volume 7>
>>> (a - b).exact_volume()
Fraction(7, 1)
"""

from __future__ import annotations

from fractions import Fraction
from typing import List, NamedTuple

from . import _core
from ._display import Display, View
from ._mesh import Ints, Mesh, MeshLike, fraction_of, mesh_of

__all__ = ["Arc", "Solid", "render", "visible_map"]


class Solid:
    """A solid with rational vertices.

    Parameters
    ----------
    mesh : Mesh, (V, F), meshio mesh or trimesh
        Convex polygons whose coordinates are whole numbers.

    Raises
    ------
    Error
        ``OUT_OF_RANGE`` (no whole numbers), ``OPEN``, and those of polygons.
    """

    __slots__ = ("_core",)

    def __init__(self, mesh: MeshLike) -> None:
        self._core = _core.RefSolid.of(mesh_of(mesh)._core)

    def _combined(self, operation: str, other: "Solid") -> "Solid":
        solid = Solid.__new__(Solid)
        solid._core = self._core.combined(other._core, operation)
        return solid

    def __add__(self, other: "Solid") -> "Solid":
        return self._combined("+", other)

    def __sub__(self, other: "Solid") -> "Solid":
        return self._combined("-", other)

    def __and__(self, other: "Solid") -> "Solid":
        return self._combined("&", other)

    def __xor__(self, other: "Solid") -> "Solid":
        return self._combined("^", other)

    def exact_volume(self) -> Fraction:
        """The volume. Units: cubic model units."""
        return fraction_of(self._core.volume6()) / 6

    def bad_edge_count(self) -> int:
        """How many edges keep the surface from being closed."""
        return self._core.bad_edge_count()

    def mesh(self) -> Mesh:
        """The surface, rounded to the nearest doubles."""
        return Mesh._of(self._core.mesh())

    def __repr__(self) -> str:
        return f"<halfspace.ref.Solid: volume {self.exact_volume()}>"


class Arc(NamedTuple):
    """An arc of a visible map: its ends, and the polygons on its left and its
    right; -1 is the background, -2 the outside. Units: pixels."""

    from_x: Fraction
    from_y: Fraction
    to_x: Fraction
    to_y: Fraction
    left: int
    right: int


def render(display: Display, view: View = View()) -> Ints:
    """The polygon at each pixel; -1 where there is none.

    Returns
    -------
    ndarray of int32, shape (height, width)
    """
    return _core.ref_render(display._core, view)


def visible_map(display: Display, view: View = View()) -> List[Arc]:
    """The arcs of the visible map, exactly, in the order of their ends."""
    return [Arc(fraction_of(x0), fraction_of(y0), fraction_of(x1),
                fraction_of(y1), a, b)
            for x0, y0, x1, y1, a, b in
            _core.ref_visible_map(display._core, view)]
