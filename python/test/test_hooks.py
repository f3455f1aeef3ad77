"""The hooks for trimesh and pyvista, which Debian 12 does not have: against
stand-ins that have what the hooks use of them, no more."""
import sys
import types

import numpy as np
import pytest

import halfspace.pyvista
import halfspace.trimesh
from halfspace import Error, Solid

CUBE = Solid.box((0, 0, 0), (1, 1, 1))


class Trimesh:
    def __init__(self, vertices, faces, process):
        assert process is False
        self.vertices, self.faces = vertices, faces


class PolyData:
    def __init__(self, points, faces):
        self.points, self.faces = points, faces


@pytest.fixture
def trimesh(monkeypatch):
    module = types.ModuleType("trimesh")
    module.Trimesh = Trimesh
    module.boolean = types.ModuleType("trimesh.boolean")
    module.boolean._engines = {}
    monkeypatch.setitem(sys.modules, "trimesh", module)
    monkeypatch.setitem(sys.modules, "trimesh.boolean", module.boolean)
    return module


@pytest.fixture
def pyvista(monkeypatch):
    module = types.ModuleType("pyvista")
    module.PolyData = type("PolyData", (PolyData,), {})
    monkeypatch.setitem(sys.modules, "pyvista", module)
    return module


def test_the_engine_of_trimesh(trimesh):
    halfspace.trimesh.register()
    engine = trimesh.boolean._engines["halfspace"]
    a = halfspace.trimesh.to_trimesh(CUBE)
    b = halfspace.trimesh.to_trimesh(CUBE.translated((0.5, 0, 0)))
    volumes = {operation: Solid.from_mesh(engine([a, b], operation)).volume()
               for operation in ("union", "difference", "intersection")}
    assert volumes == {"union": 1.5, "difference": 0.5, "intersection": 0.5}
    assert engine([a], "difference", check_volume=False).faces.shape == (12, 3)
    with pytest.raises(ValueError):
        engine([a, b], "xor")
    with pytest.raises(ValueError):
        engine([], "union")
    b.faces = b.faces[:-1]
    with pytest.raises(Error, match="operand 1: "):
        engine([a, b], "union")


def test_the_accessor_of_pyvista(pyvista):
    halfspace.pyvista.install()
    prism = Solid.cylinder(1, 1, 5)
    data = halfspace.pyvista.to_polydata(prism)
    assert sorted(set(data.faces[:1].tolist())) in ([4], [5])
    assert data.halfspace.volume() == pytest.approx(prism.volume())
    cube = halfspace.pyvista.to_polydata(CUBE)
    half = CUBE.translated((0.5, 0, 0))
    assert (cube.halfspace - half).halfspace.exact_volume() == 0.5
    for data in (cube.halfspace + halfspace.pyvista.to_polydata(half),
                 cube.halfspace & half, cube.halfspace ^ cube):
        assert isinstance(data, pyvista.PolyData)
    assert np.asarray((cube.halfspace ^ cube).points).shape == (0, 3)
