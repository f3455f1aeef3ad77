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
from ._display import (CapStyle, Display, DynamicScreen, Hit, Pick, Picture,
                       SeenPolygon, Traversal, View, VisibleMap)
from ._displays import (CutDisplay, MovingDisplay, MovingPicture, ScalarDisplay,
                        ScalarStyle, SeenAreas, VertexFeed)
from ._errors import Error, ErrorCode
from ._figure import EdgeClass, Figure, LineDrawing, SeenRegion
from ._mend import Mended, mended
from ._mesh import Mesh
from ._solid import Plane, Region, RoundingReport, Solid

__all__ = [
    "CapStyle", "CutDisplay", "Display", "DynamicScreen", "EdgeClass", "Error",
    "ErrorCode", "Figure", "Hit", "LineDrawing", "Mended", "Mesh",
    "MovingDisplay", "MovingPicture", "Pick", "Picture", "Plane", "Region",
    "RoundingReport", "ScalarDisplay", "ScalarStyle", "SeenAreas",
    "SeenPolygon", "SeenRegion", "Solid", "Traversal", "VertexFeed", "View",
    "VisibleMap", "__version__", "mended",
]
