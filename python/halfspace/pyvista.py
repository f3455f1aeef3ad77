"""Solids for pyvista: `install` gives each PolyData an attribute `halfspace`,
so that ``(plate.halfspace - drill).halfspace.volume()`` works.

pyvista is imported where it is needed.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Union

import numpy as np

from ._mesh import Mesh
from ._solid import Solid

__all__ = ["Accessor", "from_polydata", "install", "to_polydata"]


def from_polydata(data: Any) -> Mesh:
    """The polygons of a pyvista.PolyData."""
    flat = np.asarray(data.faces)
    faces, at = [], 0
    while at < len(flat):
        count = int(flat[at])
        faces.append(flat[at + 1:at + 1 + count])
        at += 1 + count
    return Mesh(np.asarray(data.points, dtype=np.float64), faces)


def to_polydata(solid: Solid) -> Any:
    """The surface of a solid as a pyvista.PolyData of convex polygons."""
    import pyvista

    mesh = solid.mesh()
    first = mesh.first_corner.astype(np.intp)
    flat = np.insert(mesh.corners, first[:-1], np.diff(first))
    return pyvista.PolyData(np.array(mesh.vertices), flat)


class Accessor:
    """What ``data.halfspace`` is: the solid of a PolyData.

    Operators take a PolyData, an accessor or a `Solid`, and give a PolyData.

    Attributes
    ----------
    solid : Solid
    """

    def __init__(self, data: Any) -> None:
        self.solid = Solid.from_mesh(from_polydata(data), may_round=True)

    def volume(self) -> float:
        """The volume. Raises `Error` where the surface bounds none."""
        return self.solid.volume()

    def exact_volume(self) -> Fraction:
        """The volume in full."""
        return self.solid.exact_volume()

    def __add__(self, other: Any) -> Any:
        return to_polydata(self.solid + _solid_of(other))

    def __sub__(self, other: Any) -> Any:
        return to_polydata(self.solid - _solid_of(other))

    def __and__(self, other: Any) -> Any:
        return to_polydata(self.solid & _solid_of(other))

    def __xor__(self, other: Any) -> Any:
        return to_polydata(self.solid ^ _solid_of(other))


def _solid_of(other: Union[Solid, Accessor, Any]) -> Solid:
    if isinstance(other, Solid):
        return other
    return (other if isinstance(other, Accessor) else Accessor(other)).solid


def install() -> None:
    """Gives each pyvista.PolyData the attribute ``halfspace``."""
    import pyvista

    pyvista.PolyData.halfspace = property(Accessor)
