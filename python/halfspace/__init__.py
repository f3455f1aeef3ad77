"""Exact visibility and solid modelling: the library halfspace for Python.

Solids are values with operators, whose volumes are exact; displays show them,
or any polygons, as pictures, orders and visible maps. docs/python.md has what
one does first.

Examples
--------
>>> from halfspace import Solid
>>> plate = Solid.box((0, 0, 0), (40, 30, 5))
>>> hole = Solid.cylinder(4, 9).translated((10, 15, -2))
>>> (plate - hole).genus()
1
"""

from ._core import VERSION as __version__
from ._display import (Display, DynamicScreen, Hit, Pick, Picture, SeenPolygon,
                       Traversal, View, VisibleMap)
from ._errors import Error, ErrorCode
from ._mesh import Mesh
from ._solid import Plane, Region, RoundingReport, Solid

__all__ = [
    "Display", "DynamicScreen", "Error", "ErrorCode", "Hit", "Mesh", "Pick",
    "Picture", "Plane", "Region", "RoundingReport", "SeenPolygon", "Solid",
    "Traversal", "View", "VisibleMap", "__version__",
]
