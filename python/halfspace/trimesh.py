"""Exact booleans for trimesh: an engine, and conversions.

`register` makes ``trimesh.boolean.union(meshes, engine="halfspace")`` and its
like work. trimesh is imported where it is needed.
"""

from __future__ import annotations

from typing import Any, Iterable

import numpy as np

from ._errors import Error
from ._solid import Solid

__all__ = ["boolean", "register", "to_trimesh"]


def boolean(meshes: Iterable[Any], operation: str, check_volume: bool = True,
            **unused: Any) -> Any:
    """The boolean of meshes, as trimesh calls its engines.

    Parameters
    ----------
    meshes : iterable of trimesh.Trimesh
        Closed, faces outwards.
    operation : {"union", "difference", "intersection"}
        Of a difference the first mesh is what the others are taken from.
    check_volume : bool
        Not used: a mesh that is no solid is always an error, which says where.

    Returns
    -------
    trimesh.Trimesh
        Rounded once to doubles.

    Raises
    ------
    Error
        Of the solid that is at fault.
    ValueError
        If the operation is another one, or there are no meshes.
    """
    # Coordinates of different meshes need not share a grid of decimals.
    solids = [Solid.from_mesh(mesh, may_round=True) for mesh in meshes]
    if not solids:
        raise ValueError("a boolean of no meshes")
    if operation == "union":
        result = Solid.union_of(solids)
    elif operation == "intersection":
        result = Solid.intersection_of(solids)
    elif operation == "difference":
        result = solids[0] - Solid.union_of(solids[1:])
    else:
        raise ValueError(f"{operation!r} is not union, difference or "
                         "intersection")
    for i, solid in enumerate(solids):
        try:
            solid.evaluate()
        except Error as error:
            raise Error(error.code, f"operand {i}: {error.message}",
                        error.index) from None
    return to_trimesh(result)


def to_trimesh(solid: Solid) -> Any:
    """The surface of a solid as a trimesh.Trimesh, vertex by vertex."""
    import trimesh

    vertices, faces = solid.mesh(triangles=True)
    return trimesh.Trimesh(vertices=np.array(vertices), faces=np.array(faces),
                           process=False)


def register(name: str = "halfspace") -> None:
    """Makes the engine known to trimesh under a name."""
    import trimesh.boolean

    trimesh.boolean._engines[name] = boolean
