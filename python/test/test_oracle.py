"""Python against the program, which is C++ alone, and against the reference."""
import os
import re
import subprocess

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from halfspace import Display, Solid, View, ref

COORDINATES = st.integers(-6, 6)


@st.composite
def boxes(draw):
    low = [draw(COORDINATES) for _ in range(3)]
    size = [draw(st.integers(1, 6)) for _ in range(3)]
    return Solid.box(low, [a + b for a, b in zip(low, size)])


@st.composite
def hulls(draw):
    point = st.tuples(COORDINATES, COORDINATES, COORDINATES)
    points = draw(st.lists(point, min_size=4, max_size=9, unique=True))
    if np.linalg.matrix_rank(np.diff(np.array(points), axis=0)) < 3:
        points += [(7, 0, 0), (0, 7, 0), (0, 0, 7), (-7, -7, -7)]
    return Solid.hull(points)


SOLIDS = boxes() | hulls()
OPERATIONS = {"+": Solid.__add__, "-": Solid.__sub__, "&": Solid.__and__,
              "^": Solid.__xor__}
REFERENCE = {"+": ref.Solid.__add__, "-": ref.Solid.__sub__,
             "&": ref.Solid.__and__, "^": ref.Solid.__xor__}


@settings(max_examples=60)
@given(SOLIDS, SOLIDS, st.sampled_from(list(OPERATIONS)))
def test_volumes_are_the_references(a, b, operation):
    ours = OPERATIONS[operation](a, b)
    theirs = REFERENCE[operation](ref.Solid(a.mesh()), ref.Solid(b.mesh()))
    assert ours.exact_volume() == theirs.exact_volume()
    assert theirs.bad_edge_count() == 0
    if not ours.is_empty():
        assert np.allclose(ours.mesh().vertices.min(0),
                           theirs.mesh().vertices.min(0))


@settings(max_examples=25)
@given(st.lists(SOLIDS, min_size=1, max_size=3),
       st.tuples(st.integers(-9, 9), st.integers(-9, 9), st.integers(3, 9)),
       st.booleans())
def test_pictures_are_the_references(solids, eye, orthographic):
    display = Display.of(solids)
    view = View(eye=eye, target=(0.25, 0.125, 0), width_px=24, height_px=18,
                orthographic=orthographic, ortho_height=16)
    assert (display.render(view).ids == ref.render(display, view)).all()


@settings(max_examples=10)
@given(boxes())
def test_visible_maps_are_the_references(box):
    display = Display.of(box)
    view = View(eye=(13, -17, 11), target=(0, 0, 0), width_px=24, height_px=18)
    ours = display.visible_map(view)
    ends = ours.vertices[ours.arcs[:, :2]].reshape(-1, 4)
    keys = np.append(ours.keys, -2)  # -1, the outside, is the last one
    found = [(*end, keys[left], keys[right]) for end, (left, right)
             in zip(ends.tolist(), ours.arcs[:, 2:].tolist())]
    wanted = [tuple(map(float, arc)) for arc in ref.visible_map(display, view)]
    assert sorted(found) == sorted(wanted)


def program(*arguments):
    done = subprocess.run([os.environ["HALFSPACE_PROGRAM"], *arguments],
                          check=True, text=True, capture_output=True)
    return done.stdout


needs_program = pytest.mark.skipif(
    "HALFSPACE_PROGRAM" not in os.environ,
    reason="HALFSPACE_PROGRAM does not name the program")


@needs_program
@settings(max_examples=15)
@given(SOLIDS, SOLIDS, st.sampled_from("+-&^"))
def test_the_program_writes_the_same_surface(tmp_path_factory, a, b,
                                             operation):
    folder = tmp_path_factory.mktemp("program")
    a.save(folder / "a.off")
    b.save(folder / "b.off")
    ours = OPERATIONS[operation](Solid.from_file(folder / "a.off"),
                                 Solid.from_file(folder / "b.off"))
    if ours.is_empty():
        return
    sign = {"+": "|"}.get(operation, operation)
    said = program("csg", f"A {sign} B", f"A={folder / 'a.off'}",
                   f"B={folder / 'b.off'}", "-o", str(folder / "c.off"))
    volume = re.search(r"volume ([0-9.e+-]+)", said)[1]
    assert float(volume) == pytest.approx(ours.volume(), rel=1e-9)
    written = Solid.from_file(folder / "c.off")
    assert written.volume() == pytest.approx(ours.volume(), rel=1e-9)


@needs_program
def test_the_program_draws_the_same_figure(tmp_path):
    Solid.torus(3, 1, 12, 8).save(tmp_path / "ring.off")
    program("draw", str(tmp_path / "ring.off"), "-o", str(tmp_path / "a.svg"),
            "--by", "polygon", "--fill", "none", "--lines", "regions")
    ours = Display.of_file(tmp_path / "ring.off").visible_map(View(fov_deg=40))
    theirs = (tmp_path / "a.svg").read_text()
    assert theirs.count("<path") <= 2 and len(ours.arcs) > 100
