"""Solids: made, combined, measured, copied, pickled."""
import copy
import pickle
from fractions import Fraction

import numpy as np
import pytest

import halfspace
from halfspace import Error, ErrorCode, Mesh, Plane, Solid
from halfspace._mesh import fraction_of

CUBE = Solid.box((0, 0, 0), (1, 1, 1))


def test_operators_are_those_of_sets():
    moved = CUBE.translated((0.5, 0, 0))
    volumes = [s.exact_volume() for s in
               (CUBE + moved, CUBE - moved, CUBE & moved, CUBE ^ moved)]
    assert volumes == [Fraction(3, 2), Fraction(1, 2), Fraction(1, 2), 1]
    total = CUBE
    total += moved
    total -= CUBE
    assert total.volume() == 0.5
    assert (moved & ~CUBE).volume() == 0.5
    with pytest.raises(TypeError):
        CUBE + 1


def test_every_maker_makes_what_it_says():
    square = [(0, 0), (3, 0), (3, 3), (0, 3)]
    hole = [(1, 1), (2, 1), (2, 2), (1, 2)]
    assert Solid().is_empty()
    assert Solid.prism(square, 2, holes=[hole]).exact_volume() == 16
    assert Solid.revolution([(1, 0), (2, 0), (1, 1)], 4).genus() == 1
    assert Solid.sphere(2, 8).contains(Solid.sphere(1, 8))
    assert Solid.cone(2, 1, 1, 4).exact_volume() == Fraction(14, 3)
    assert Solid.torus(3, 1, 8, 4).shell_count() == 1
    assert Solid.half_space(Plane((0, 0, 1), 0.5)).name == "half-space"
    assert Solid.intersection_of([CUBE, CUBE.scaled(0.5)]).volume() == 0.125


def test_maps_keep_what_is_exact():
    turned = CUBE.rotated((0, 0, 1), 90).mirrored((1, 0, 0)).scaled((2, 1, 1))
    assert turned.exact_volume() == 2 and turned.rounding().moved == 0
    assert CUBE.rotated((1, 2, 3), 30).rounding().max_move < 1e-11
    matrix = np.diag([2.0, 2, 2, 1])
    assert CUBE.transformed(matrix).volume() == 8
    with pytest.raises(ValueError):
        CUBE.transformed(np.ones((4, 4)))


def test_measures_are_arrays():
    assert CUBE.bounds().tolist() == [[0, 0, 0], [1, 1, 1]]
    assert CUBE.centroid().tolist() == [0.5, 0.5, 0.5]
    assert np.allclose(CUBE.inertia(), np.eye(3) / 6)
    assert CUBE.exact_area() == 6
    assert Solid.sphere(1, 8).exact_area() is None


def test_volumes_may_have_more_digits_than_python_reads():
    third = "3" * 9000
    one = Fraction(int("3" * 4000) * 10 ** 5000 + int("3" * 4000) * 10 ** 1000 +
                   int("3" * 1000), 10 ** 9000)
    assert fraction_of("0." + third) == one
    assert fraction_of(f"-{third}/1" + "0" * 9000) == -one
    assert fraction_of("-12.50") == Fraction(-25, 2)
    assert fraction_of("7") == 7 and fraction_of("-1/3") == Fraction(-1, 3)


def test_sections_have_holes():
    frame = CUBE.scaled(3) - CUBE.translated((1, 1, 0)).scaled((1, 1, 3))
    region, = frame.section(Plane((0, 0, 1), 1))
    assert region.boundary.shape == (4, 3) and len(region.holes) == 1


def test_points_and_pairs():
    assert CUBE.locate([(2, 2, 2), (1, 1, 1), (.5, .5, .5)]).tolist() == \
        [1, 0, -1]
    beside = CUBE.translated((1, 0, 0))
    assert CUBE.touches(beside) and not CUBE.overlaps(beside)


def test_origins_name_operands():
    part = CUBE.named("block") - CUBE.translated((0.5, 0.5, 0.5))
    origins = part.mesh().origins
    assert origins.shape == (len(part.mesh()), 2)
    names = [operand.name for operand in part.operands()]
    assert names[0] == "block" and set(origins[:, 0]) == {0, 1}


def test_properties_come_out():
    mesh = CUBE.mesh()
    colors = np.arange(18, dtype=np.uint8).reshape(6, 3)
    painted = Solid.from_mesh(Mesh(mesh.vertices, mesh.faces, colors=colors,
                                   materials=range(6)))
    half = (painted - CUBE.translated((0.5, 0, 0))).mesh()
    assert set(half.materials.tolist()) <= set(range(6))
    assert {tuple(c) for c in half.colors} >= {tuple(colors[0])}


def test_errors_say_code_and_place(tmp_path):
    path = tmp_path / "bad.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n")
    with pytest.raises(Error) as caught:
        Solid.from_file(path).volume()
    error = caught.value
    assert error.code is ErrorCode.SYNTAX
    assert error.file == str(path) and error.line == 5
    mesh = CUBE.mesh()
    with pytest.raises(Error) as caught:
        Solid.from_mesh((mesh.vertices, mesh.faces[:5])).volume()
    assert caught.value.code is ErrorCode.OPEN
    assert isinstance(caught.value.polygon, int)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.code, str(again), again.polygon) == (
        caught.value.code, str(caught.value), caught.value.polygon)


def test_every_code_of_the_library_has_a_member():
    words = halfspace._core.error_codes()
    assert words == [code.value for code in ErrorCode]
    assert len(words) > 15


def test_copies_are_the_solid_and_pickles_are_made_again(tmp_path):
    path = tmp_path / "cube.off"
    CUBE.save(path)
    part = Solid.union_of([CUBE, Solid.from_file(path).translated((.5, 0, 0)),
                           Solid.hull(np.eye(4, 3)).named("tip")])
    part = part.split((0, 0, 1), 0.25)[1] - Solid.from_text("box(0.1)")
    assert copy.copy(part) is part and copy.deepcopy([part])[0] is part
    again = pickle.loads(pickle.dumps(part))
    assert again.exact_volume() == part.exact_volume()
    assert again.mesh() == part.mesh()
    twice = pickle.loads(pickle.dumps(again))
    assert (twice ^ part).is_empty()
    mesh = pickle.loads(pickle.dumps(part.mesh()))
    assert (mesh.vertices == part.mesh().vertices).all()


def test_a_long_chain_neither_recurses_nor_overflows():
    chain = CUBE
    for i in range(20_000):
        chain = chain + CUBE.translated((i % 7, 0, 0))
    data = pickle.dumps(chain)
    del chain
    assert pickle.loads(data).exact_volume() == 7


def test_equality_is_that_of_expressions():
    assert CUBE == CUBE and CUBE != Solid.box((0, 0, 0), (1, 1, 1))
    assert CUBE != 1
    with pytest.raises(TypeError):
        hash(CUBE)
