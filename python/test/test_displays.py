"""Clip planes, figures, drawings, areas, feeds, scalars, motion, removal: each
against the picture, or against another way to the same answer."""
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_oracle import SOLIDS

from halfspace import (CapStyle, CutDisplay, Display, EdgeClass, Error,
                       ErrorCode, Mesh, MovingDisplay, Plane, ScalarDisplay,
                       ScalarStyle, Solid, View, mended)

VIEW = View(width_px=48, height_px=36, eye=(23, -31, 19), target=(0, 0, 0))
CUBE = Solid.box((0, 0, 0), (1, 1, 1))


def area_of(loops):
    """Of a region, whose holes run the other way round."""
    total = 0
    for loop in loops:
        x, y = loop.T
        total += (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    return abs(total)


def triangles_of(indices):
    return {tuple(sorted(row)) for row in indices.reshape(-1, 3).tolist()}


@settings(max_examples=25)
@given(SOLIDS, st.integers(0, 2), st.integers(-2, 2), st.booleans())
def test_what_is_clipped_looks_like_what_is_cut(solid, axis, offset, flipped):
    normal = [0, 0, 0]
    normal[axis] = -1 if flipped else 1
    plane = Plane(normal, offset)
    display = Display.of(solid)
    clipped = display.render(
        replace(VIEW, clips=[plane], caps=CapStyle()))
    _, kept = solid.split(plane)
    if kept.is_empty():
        assert (clipped.ids == -1).all()
        return
    expected = Display.of(kept).render(VIEW).ids
    assert ((clipped.ids == -1) == (expected == -1)).all()
    cap = clipped.ids == display.polygon_count
    assert (clipped.colors[cap] == CapStyle().color).all()
    # Without caps the cut is open: where the cap was, others are seen.
    opened = display.render(replace(VIEW, clips=[plane])).ids
    assert (opened[~cap] == clipped.ids[~cap]).all()
    assert opened.max() < display.polygon_count


@settings(max_examples=20)
@given(st.lists(SOLIDS, min_size=1, max_size=2))
def test_figures_areas_and_pictures_agree(solids):
    display = Display.of(solids)
    picture = display.render(VIEW)
    figure = display.figure(VIEW, by="polygon")
    areas = CutDisplay.of(display).seen_areas(VIEW)
    found = np.zeros(display.polygon_count + 1)
    for region in figure:
        found[region.polygon] += area_of(region.loops)
    expected = np.zeros_like(found)
    expected[areas.polygons] = areas.area_px
    assert np.allclose(found, expected, atol=1e-6)
    assert areas.solid_angles.sum() < 4 * np.pi
    counts = np.bincount(picture.ids.ravel() + 1, minlength=len(found))
    assert abs(np.roll(found, 1) - counts).max() < 48
    spans = display.scan(VIEW)
    scanned = np.full_like(picture.ids, -1)
    for polygon, line, first, last in spans:
        assert (scanned[line, first:last + 1] == -1).all()
        scanned[line, first:last + 1] = polygon
    assert (scanned == picture.ids).all()
    colors = {region.color for region in display.figure(VIEW)}
    assert len(display.figure(VIEW)) >= len(colors)


@settings(max_examples=20)
@given(SOLIDS, st.data())
def test_what_is_removed_is_not_seen(solid, data):
    mesh = solid.mesh()
    count = len(mesh)
    gone = data.draw(st.sets(st.integers(0, count - 1), max_size=count - 1))
    display = Display.of(mesh)
    cut = CutDisplay.of(display)
    display.remove(list(gone))
    display.remove(list(gone))
    rest = [k for k in range(count) if k not in gone]
    faces = [mesh.faces[k] for k in rest]
    expected = Display.of((mesh.vertices, faces)).render(VIEW).ids
    found = display.render(VIEW).ids
    assert (found == np.array([*rest, -1])[expected]).all()
    with pytest.raises(ValueError, match="has changed"):
        cut.vertex_feed()
    with pytest.raises(Error) as caught:
        display.remove(rest)
    assert caught.value.code is ErrorCode.EMPTY


def test_bad_removals_are_errors():
    display = Display.of(CUBE)
    for bad in (6, -1):
        with pytest.raises(Error) as caught:
            display.remove([0, bad])
        assert caught.value.code is ErrorCode.BAD_INDEX
    assert (display.render(VIEW).ids == Display.of(CUBE).render(VIEW).ids).all()


def test_back_faces_are_marked():
    display = Display.of(CUBE)
    view = View(eye=(0.5, -5, 1), target=(0.5, 0.5, 0.5), width_px=24,
                height_px=18, clips=[((0, 1, 0), 0.5)])
    plain = display.render(view)
    marked = display.render(replace(view, back_color=(200, 0, 100)))
    assert (marked.ids == plain.ids).all()
    changed = (marked.colors != plain.colors).any(axis=2)
    light = plain.colors.astype(int).max(axis=2)
    assert changed.any()
    assert (marked.colors[..., 0][changed] ==
            ((200 * (255 + light) + 255) // 510)[changed]).all()
    assert (marked.colors[..., 1][changed] == 0).all()
    with pytest.raises(Error) as caught:
        display.render(replace(view, back_color=(1, 2, 3),
                               anti_aliasing="area"))
    assert caught.value.code is ErrorCode.OUT_OF_RANGE
    many = display.render(replace(view, back_color=(200, 0, 100),
                                  anti_aliasing=2))
    inner = (many.colors == marked.colors).all(axis=2)
    assert (inner & changed).any() and not inner.all()


def test_polygons_may_be_transparent():
    mesh = CUBE.mesh()
    display = Display.of(Mesh(mesh.vertices, mesh.faces, colors=np.full(
        (len(mesh), 3), 200)))
    view = View(eye=(0.5, -5, 0.5), target=(0.5, 0.5, 0.5), width_px=24,
                height_px=18, background=(0, 0, 0), alpha=100)
    glass = display.render(view)
    once = (2 * 100 * 200 + 255) // 510
    twice = (2 * (100 * 200 + 155 * once) + 255) // 510
    assert (glass.colors == twice).all(axis=2).any()
    figure = display.figure(view)
    colors = {(region.polygon, int(region.color[0])) for region in figure}
    assert (-2, twice) in colors and (-1, 0) in colors
    with pytest.raises(ValueError):
        View(alpha=256)
    many = display.render(replace(view, anti_aliasing=4))
    assert (many.colors == twice).all(axis=2).any()
    assert not (many.colors == glass.colors).all()
    with pytest.raises(Error) as caught:
        display.render(replace(view, anti_aliasing="area"))
    assert caught.value.code is ErrorCode.OUT_OF_RANGE


def test_anti_aliasing_and_figures_of_cuts(tmp_path):
    display = Display.of([CUBE, CUBE.translated((0.5, 0.5, 0.5))])
    view = View(width_px=24, height_px=18)
    plain = display.render(view)
    for kind in (2, 4, 8, "area"):
        smooth = display.render(View(width_px=24, height_px=18,
                                     anti_aliasing=kind))
        assert (smooth.colors != plain.colors).any()
        assert abs(smooth.colors.mean() - plain.colors.mean()) < 8
    with pytest.raises(ValueError):
        View(anti_aliasing=3)
    with pytest.raises(ValueError):
        display.figure(view, by="shape")
    with pytest.raises(Error) as caught:
        display.render(View(clips=[((0, 0, 0), 1)]))
    assert caught.value.code is ErrorCode.ZERO_AREA
    hatched = View(width_px=24, height_px=18, clips=[((0, 0, -1), -0.75)],
                   caps=CapStyle((1, 2, 3), (4, 5, 6)))
    figure = Display.of(CUBE).figure(hatched)
    assert {(1, 2, 3), (4, 5, 6)} < {region.color for region in figure}
    figure.lines = Display.of(CUBE).draw(view)
    figure.save(tmp_path / "figure.svg")
    text = (tmp_path / "figure.svg").read_text()
    assert "#010203" in text and "stroke" in text
    with pytest.raises(Error) as caught:
        figure.save(tmp_path / "figure.xyz")
    assert caught.value.code is ErrorCode.UNKNOWN_FORMAT


def test_caps_are_told_apart_by_solids():
    left, right = (Solid.box((x, 0, 0), (x + 4, 2, 2)) for x in (0, 2))
    display = Display.of([left, right])
    view = View(eye=(3, 1, 9), target=(3, 1, 0), up=(0, 1, 0), width_px=60,
                height_px=60, orthographic=True, ortho_height=6,
                clips=[Plane((0, 0, -1), -1)], caps=CapStyle((1, 2, 3)))
    picture = display.render(replace(view, caps_by_solid=True))
    numbers = picture.ids[30, [10, 30, 50]] - display.polygon_count
    assert numbers.tolist() == [0, 32, 16]
    assert picture.colors[30, 30].tolist() == [1, 2, 3]
    assert (display.render(view).ids[30, [10, 30, 50]]
            == display.polygon_count).all()


def test_drawings_have_visible_and_hidden_lines(tmp_path):
    lines = Display.of(CUBE).draw(VIEW)
    assert sorted(lines.layers.tolist()) == [0] * 9 + [1] * 3
    assert lines.starts.shape == lines.ends.shape == (12, 2)
    classes = [EdgeClass(value) for value in lines.edge_classes]
    assert classes.count(EdgeClass.SILHOUETTE) == 6
    assert classes.count(EdgeClass.CREASE) == 6
    for ending in ("svg", "dxf", "hpgl"):
        plain, full = tmp_path / f"a.{ending}", tmp_path / f"b.{ending}"
        lines.save(plain)
        lines.save(full, with_hidden=True)
        assert 0 < plain.stat().st_size < full.stat().st_size
    assert len(Display.of(Solid.sphere(1, 32)).draw(VIEW, crease_deg=90)) < \
        len(Display.of(Solid.sphere(1, 32)).draw(VIEW, crease_deg=5))


def test_feeds_are_one_set_of_triangles_in_two_orders():
    display = Display.of([CUBE, CUBE.translated((0.5, 0.25, 0.125))])
    cut = CutDisplay.of(display, threads=1)
    feed = cut.vertex_feed()
    back, front = (cut.feed_indices(VIEW, order=order)
                   for order in ("back_to_front", "front_to_back"))
    assert triangles_of(back) == triangles_of(front)
    assert len(triangles_of(back)) * 3 == len(back)
    assert set(feed.polygons.tolist()) == set(range(12))
    # The triangles cover the surface once: the area is that of two cubes.
    corners = feed.positions[back].reshape(-1, 3, 3)
    sides = corners[:, 1:] - corners[:, :1]
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2
    assert area == pytest.approx(12)
    # And a painter who fills them from back to front ends with the picture.
    view = View(width_px=48, height_px=36, eye=(0, 0, 9), target=(0, 0, 0),
                up=(0, 1, 0), orthographic=True, ortho_height=3.6)
    ids = display.render(view).ids
    painted = np.full_like(ids, -1)
    y, x = np.mgrid[0:36, 0:48]
    px, py = (x + 0.5) / 10 - 2.4, 1.8 - (y + 0.5) / 10
    indices = cut.feed_indices(view).reshape(-1, 3)
    for row in indices:
        a, b, c = feed.positions[row][:, :2]
        signs = [(q[0] - p[0]) * (py - p[1]) - (q[1] - p[1]) * (px - p[0])
                 for p, q in ((a, b), (b, c), (c, a))]
        if np.linalg.det(np.array([b - a, c - a])) == 0:
            continue
        inside = np.all([s > 0 for s in signs], axis=0) | \
            np.all([s < 0 for s in signs], axis=0)
        painted[inside] = feed.polygons[row[0]]
    assert (painted == ids).mean() > 0.97  # but for borders of triangles
    with pytest.raises(ValueError):
        cut.feed_indices(view, order="sideways")


def test_scalars_are_bands_and_ids_stay():
    V = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    square = Mesh(V, [(0, 1, 2, 3)], fields=[[-1], [1], [1], [-1]])
    view = View(eye=(0, 0, 10), target=(0, 0, 0), orthographic=True,
                ortho_height=2, width_px=8, height_px=8)
    display = ScalarDisplay.of(square)
    picture = display.render(view, ScalarStyle(map="grey", steps=4))
    row = picture.colors[0, :, 0].astype(int)
    assert (picture.ids == 0).all() and (picture.colors == picture.colors[0]).all()
    assert (row[0::2] == row[1::2]).all() and (np.diff(row[::2]) > 0).all()
    missing = Mesh(V, [(0, 1, 2, 3)], fields=[[np.nan], [1], [1], [-1]])
    nothing = ScalarDisplay.of(missing).render(
        view, ScalarStyle(low=0, high=1, no_data=(255, 0, 255)))
    assert (nothing.colors[..., 1] == 0).any()
    for code, call in [
            (ErrorCode.BAD_INDEX, lambda: ScalarDisplay.of(square, 1)),
            (ErrorCode.UNKNOWN_FORMAT,
             lambda: display.render(view, ScalarStyle(map="sunny"))),
            (ErrorCode.OUT_OF_RANGE, lambda: display.render(
                view, ScalarStyle(logarithmic=True, low=-1)))]:
        with pytest.raises(Error) as caught:
            call()
        assert caught.value.code is code


def test_moved_objects_look_like_moved_meshes():
    ground = Solid.box((-8, -8, -1), (8, 8, 0))
    ball = Solid.sphere(1, 16)
    display = MovingDisplay.of(ground.mesh())
    model = display.add_model(ball.mesh())
    tent = [(0, -3, .25), (7, -3, .25), (0, 3, .25), (7, 3, .25),
            (3.5, -3, 6), (3.5, 3, 6)]
    left = display.insert(model, [(-6, -3, 0.5), (-1, 3, 4)])
    right = display.insert(model, tent)
    view = View(width_px=80, height_px=60, eye=(9, -14, 12), target=(0, 0, 1))
    for step in (0.0, 0.5):
        places = {left: (step - 3.5, 0, 2), right: (3.5 - step, step, 1.5)}
        for number, place in places.items():
            matrix = np.eye(4)
            matrix[:3, 3] = place
            display.place(number, matrix)
        picture = display.render(view)
        still = Display.of([ground, *map(ball.translated, places.values())])
        first = np.array([0, len(ground.mesh()),
                          len(ground.mesh()) + len(ball.mesh())])
        ids = still.render(view).ids
        solids = np.searchsorted(first, ids, side="right") - 1
        # Corners of a ball are rounded to the grids of both.
        assert (picture.objects != solids).sum() <= 2
        same = (ids >= 0) & (picture.objects == solids)
        assert (picture.ids[same] != (ids - first[solids])[same]).sum() <= 4
    display.hide(left)
    assert left not in display.render(view).objects
    display.remove(left)
    for call in (lambda: display.remove(left), lambda: display.hide(9),
                 lambda: display.place(left, np.eye(4)),
                 lambda: display.insert(model + 1, tent)):
        with pytest.raises(Error) as caught:
            call()
        assert caught.value.code is ErrorCode.BAD_INDEX
    display.place(right, np.eye(3, 4))
    with pytest.raises(Error) as caught:
        display.render(view)
    assert caught.value.code is ErrorCode.OUT_OF_RANGE
    assert caught.value.index == right


@settings(max_examples=25)
@given(st.lists(SOLIDS, min_size=1, max_size=4))
def test_parts_make_the_whole(solids):
    whole = Solid.union_of(solids)
    parts = whole.decompose()
    assert sum(part.exact_volume() for part in parts) == whole.exact_volume()
    assert (Solid.union_of(parts) ^ whole).is_empty()
    for part in parts:
        assert len(part.decompose()) == 1
    again = pickle.loads(pickle.dumps(parts[-1]))
    assert again.exact_volume() == parts[-1].exact_volume()
    counts = whole.polygons_by_operand()
    assert sum(counts.values()) == len(whole.mesh())


def test_surfaces_are_mended(tmp_path):
    V, F = CUBE.mesh()
    rows = [f"v {x} {y} {z}" for x, y, z in V] + \
        ["f " + " ".join(str(k + 1) for k in face) for face in F[:5]]
    path = tmp_path / "open.obj"
    path.write_text("\n".join(rows) + "\n")
    with pytest.raises(Error) as caught:
        mended(path)
    assert caught.value.code is ErrorCode.OPEN
    result = mended(path, close_all=True)
    assert result.solid.exact_volume() == 1 and len(result.done) == 1
    assert pickle.loads(pickle.dumps(result.solid)).exact_volume() == 1
    shell = mended(path, thicken=0.125).solid
    assert 0 < shell.volume() < 1
    with pytest.raises(Error):
        mended(tmp_path / "none.obj")


def test_the_tree_of_a_view_may_be_stopped():
    V, F = Solid.sphere(1, 128).mesh(triangles=True)
    display = Display.of((V, F))
    with pytest.raises(Error) as caught:
        display.render(View(progress=lambda share: False))
    assert caught.value.code is ErrorCode.STOPPED

    class Mine(Exception):
        pass

    def raises(share):
        raise Mine

    with pytest.raises(Mine):
        display.figure(View(progress=raises))
    shares = []
    display.render(View(width_px=8, height_px=8, progress=shares.append))
    assert shares == sorted(shares) and shares[-1] > 0.5
    with pytest.raises(Error) as caught:
        CutDisplay.of(display, progress=lambda share: False)
    assert caught.value.code is ErrorCode.STOPPED


def test_a_lazy_view_has_the_same_picture():
    part = Solid.sphere(1, 24) - Solid.box((0, 0, 0), (2, 2, 2))
    view = View(width_px=64, height_px=48)
    whole = Display.of(part).render(view)
    lazy = Display.of(part).render(replace(view, lazy=True))
    assert (lazy.ids == whole.ids).all() and (whole.ids >= 0).any()
    assert (lazy.colors == whole.colors).all()
    for x in range(0, 64, 7):
        found = Display.of(part).pick(replace(view, lazy=True), x, 24)
        assert found == Display.of(part).pick(view, x, 24)


def test_vertices_move_and_polygons_with_them():
    box = Solid.box((0, 0, 0), (1, 1, 1))
    V, F = box.mesh(triangles=True)
    both = np.concatenate([V, V + (3, 0, 0)]), np.concatenate([F, F + len(V)])
    view = View(width_px=64, height_px=48, eye=(2, -20, 3), target=(2, 0, 0),
                lazy=True)
    display = Display.of(both)
    display.render(view)
    moving = np.arange(len(V), 2 * len(V))
    for step in range(1, 4):
        now = both[0].copy()
        now[moving] += (0, 0, 0.5 * step)
        display.move_to(moving, now[moving])
        picture = display.render(view)
        assert (picture.ids == Display.of((now, both[1])).render(view).ids).all()
        hit = display.first_hit((3.5, 0.25, 9), (0, 0, -1))
        assert hit.point == (3.5, 0.25, 1 + 0.5 * step)
        assert hit.polygon >= len(F)
    with pytest.raises(Error) as caught:
        display.move_to([99], [(0, 0, 0)])
    assert caught.value.code is ErrorCode.BAD_INDEX
