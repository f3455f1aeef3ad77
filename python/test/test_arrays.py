"""Arrays: types, shapes, owners, and that nothing is copied on the way out."""
import gc
import tracemalloc
from fractions import Fraction

import numpy as np
import pytest

from halfspace import (Display, DynamicScreen, Error, ErrorCode, Mesh, Solid,
                       View)

SMALL = View(width_px=64, height_px=48)


def address(array):
    return array.__array_interface__["data"][0]


def test_a_mesh_is_viewed_where_it_stands():
    mesh = Solid.sphere(1, 64).mesh(triangles=True)
    tracemalloc.start()
    arrays = [mesh.vertices, mesh.corners, mesh.first_corner, mesh.faces,
              mesh.origins]
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # np.diff of first_corner, which tells whether all polygons are triangles.
    assert peak < 12 * len(mesh) + 10_000 < mesh.vertices.nbytes * 2
    assert address(mesh.vertices) == address(mesh.vertices)
    assert address(mesh.faces) == address(mesh.corners)
    assert not any(array.flags.writeable for array in arrays)
    vertices = mesh.vertices
    total = vertices.sum()
    del mesh, arrays
    gc.collect()
    Solid.sphere(1, 64).mesh()
    assert vertices.sum() == total


def test_a_picture_is_handed_over():
    display = Display.of(Solid.sphere(1))
    view = View(width_px=1000, height_px=1000)
    tracemalloc.start()
    picture = display.render(view)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 100_000  # the picture has 7,000,000 bytes
    assert picture.ids.dtype == np.int32 and picture.colors.dtype == np.uint8
    assert picture.ids.flags.c_contiguous and picture.ids.flags.writeable
    assert picture.ids.base is not None


def test_arrays_of_the_right_type_are_taken_as_they_are():
    V, F = Solid.sphere(1, 256).mesh(triangles=True)
    tracemalloc.start()
    mesh = Mesh(V, F)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(mesh) == len(F)
    # first_corner is made: nothing is converted.
    assert peak < 13 * len(F) + 10_000
    buffer = memoryview(V)
    assert Mesh(buffer, F).vertices.tolist() == V.tolist()


def test_faces_may_differ_in_size_and_type():
    V, F = Solid.cylinder(1, 1, 5).mesh()
    assert sorted({len(face) for face in F}) == [4, 5]
    assert Solid.from_mesh((V, F)).volume() == \
        pytest.approx(Solid.cylinder(1, 1, 5).volume())
    assert Solid.from_mesh((V.tolist(), [f.tolist() for f in F])).genus() == 0
    with pytest.raises(TypeError):
        Mesh(V, np.zeros((1, 3)))
    with pytest.raises(ValueError):
        Mesh(V[:, :2], [[0, 1, 2]])
    with pytest.raises(OverflowError):
        Mesh(V, np.array([[0, 1, 2**40]]))


def test_a_painter_and_a_scan_line_renderer_get_the_picture():
    display = Display.of(Solid.torus(3, 1, 16, 8) - Solid.sphere(3, 8))
    ids = display.render(SMALL).ids
    painted = np.full_like(ids, -1)
    for part in display.back_to_front(SMALL, spans=True):
        for line, first, last in part.spans:
            painted[line, first:last + 1] = part.polygon
    assert (painted == ids).all()
    lit = np.full_like(ids, -1)
    screen = DynamicScreen(64, 48)
    for part in display.front_to_back(SMALL, spans=True):
        for line, first, last in screen.light(part.spans):
            lit[line, first:last + 1] = part.polygon
    assert (lit == ids).all()
    with pytest.raises(ValueError):
        screen.light([(48, 0, 1)])


def test_a_map_agrees_with_the_picture():
    display = Display.of(Solid.torus(3, 1, 16, 8))
    shown = display.visible_map(SMALL)
    areas = np.zeros(display.polygon_count + 1)
    np.add.at(areas, shown.items, shown.areas())
    counts = np.bincount(display.render(SMALL).ids.ravel() + 1,
                         minlength=len(areas))
    assert areas.sum() == pytest.approx(64 * 48)
    # A polygon's pixels differ from its area by its border at most.
    assert abs(areas[:-1] - counts[1:]).max() < 20
    assert len(display.visible_map(SMALL, keys=np.zeros(
        display.polygon_count, int))) < 5
    assert shown.draw(".pdf", fills=np.zeros((len(shown), 3)))[:4] == b"%PDF"


def test_pick_agrees_with_the_picture():
    cube = Solid.box((0, 0, 0), (1, 1, 1))
    display = Display.of([cube, cube.translated((2, 0, 0))])
    ids = display.render(SMALL).ids
    for y, x in [(0, 0), (24, 20), (24, 44)]:
        pick = display.pick(SMALL, x, y)
        assert (pick.polygon if pick else -1) == ids[y, x]
        assert pick is None or pick.solid == pick.polygon // 6


def test_meshio_comes_and_goes():
    meshio = pytest.importorskip("meshio")
    solid = Solid.cylinder(1, 1, 6) - Solid.box((0, 0, 0), (2, 2, 2))
    from halfspace.meshio import to_meshio
    other = to_meshio(solid.mesh())
    assert isinstance(other, meshio.Mesh)
    assert Solid.from_mesh(other).exact_volume() == \
        Solid.from_mesh(solid.mesh()).exact_volume()
    assert Display.of(other).polygon_count == len(solid.mesh())
    with pytest.raises(ValueError):
        Solid.from_mesh(meshio.Mesh([[0.0, 0, 0], [1, 0, 0]],
                                    [("line", [[0, 1]])]))


def test_rays_hit_what_is_there():
    display = Display.of(Solid.box((0, 0, 0), (1, 1, 1)))
    hits = display.all_hits((0.25, 0.5, 3), (0, 0, -6))
    assert [hit.fraction for hit in hits] == [Fraction(1, 3), Fraction(1, 2)]
    assert hits[0].point == (0.25, 0.5, 1) and hits[0].distance == 2
    assert len(display.hits_between((0.25, 0.5, 3), (0.25, 0.5, 0.5))) == 1
    assert display.first_hit((0.25, 0.5, 3), (0, 0, 1)) is None
    assert display.see_each_other((2, 2, 2), (3, 3, 3))
    with pytest.raises(Error) as caught:
        display.first_hit((0, 0, 0), (0, 0, 0))
    assert caught.value.code is ErrorCode.BAD_RAY
