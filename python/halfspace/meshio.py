"""Meshes of meshio, in and out. `halfspace.Mesh`, `Solid.from_mesh` and
`Display.of` take them as they are; meshio is imported where it is needed."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._mesh import Mesh

__all__ = ["from_meshio", "to_meshio"]

# meshio's types of cells that are polygons, in all their corners.
_POLYGONS = ("triangle", "quad", "polygon")


def from_meshio(mesh: Any) -> Mesh:
    """The polygons of a meshio mesh; its lines, points and volume cells are
    left out.

    Parameters
    ----------
    mesh : meshio.Mesh
        Points in the plane get z = 0.

    Raises
    ------
    ValueError
        If it has no polygons.
    """
    faces = [list(face) for block in mesh.cells
             if block.type in _POLYGONS
             for face in np.asarray(block.data)]
    if not faces:
        kinds = sorted({block.type for block in mesh.cells})
        raise ValueError(f"no triangles, quads or polygons among {kinds}; "
                         "take the mesh's surface")
    points = np.asarray(mesh.points, dtype=np.float64)
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return Mesh(points, faces)


def to_meshio(mesh: Mesh) -> Any:
    """A meshio mesh of the polygons: one block of cells for each number of
    corners, with the materials as cell data "material", if there are any.

    Returns
    -------
    meshio.Mesh
    """
    import meshio

    first = mesh.first_corner.astype(np.intp)
    sizes = np.diff(first)
    names = {3: "triangle", 4: "quad"}
    cells, materials = [], []
    for size in np.unique(sizes):
        which = np.flatnonzero(sizes == size)
        rows = mesh.corners[first[which, None] + np.arange(size)]
        cells.append((names.get(int(size), "polygon"), rows))
        if len(mesh.materials):
            materials.append(mesh.materials[which])
    data = {"material": materials} if materials else {}
    return meshio.Mesh(mesh.vertices, cells, cell_data=data)
