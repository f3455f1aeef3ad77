"""Matplotlib's 3D axes made right: what is in front hides what is behind.

Matplotlib draws each artist of a 3D figure as a whole, by its mean or nearest
depth, so surfaces that cross, points before and behind a surface, and lines
through one come out wrong. `exact` replaces the drawing of an existing axes by
that of its visible map.

Examples
--------
>>> import matplotlib
>>> matplotlib.use("Agg")
>>> import matplotlib.pyplot as plt
>>> import numpy as np
>>> import halfspace.mpl
>>> figure, ax = plt.subplots(subplot_kw={"projection": "3d"})
>>> x, y = np.meshgrid([-1.0, 1.0], [-1.0, 1.0])
>>> _ = ax.plot_surface(x, y, 0 * x), ax.plot_surface(x, y, x)
>>> drawing = halfspace.mpl.exact(ax)
>>> figure.canvas.draw()
>>> drawing.region_count
5
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any, Dict, Iterable, List, Optional, Tuple

import numpy as np
import numpy.typing as npt
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.lines import Line2D
from matplotlib.path import Path
from mpl_toolkits.mplot3d import art3d

from . import _core
from ._display import Display
from ._mesh import Floats, Ints, Mesh

__all__ = ["ExactDrawing", "exact"]

# Bits of the axes' range that coordinates keep: 2^-24 of it is far below a
# pixel, and numbers with few digits are kept as they are.
_BITS = 24

# How much wider regions are drawn below themselves, so that no background
# shines through where two meet. Units: points.
_OVERLAP = 0.4


def exact(ax: Any, *, tolerance: float = 1e-5) -> "ExactDrawing":
    """Makes the drawing of a 3D axes right, now and whenever it is redrawn.

    Surfaces (`plot_surface`, `plot_trisurf`, `bar3d`, `voxels`, `contourf`,
    `Poly3DCollection`, patches) become the regions of their visible map, which is exact
    once coordinates are rounded to 2^-24 of the axes' range. Lines
    (`plot`, `plot_wireframe`, `quiver`, `contour`, edges of polygons) are drawn
    where no opaque surface is before them, markers and texts where none is
    before their point, in doubles. Where a surface is translucent, polygons are
    drawn in an exact painter's order, and what is behind it shines through.

    It holds for every backend: Agg, SVG, PDF, PGF. The map is made again when
    the view, the limits, the size or the artists change. What is added to the
    axes later is taken in.

    Parameters
    ----------
    ax : mpl_toolkits.mplot3d.axes3d.Axes3D
    tolerance : float
        What lies in a surface or behind it by up to this share of the depth is
        seen: lines on surfaces, for example.

    Returns
    -------
    ExactDrawing
        Its `remove()` gives the axes their own drawing back.

    Raises
    ------
    TypeError
        If the axes have no three dimensions.
    """
    if not hasattr(ax, "get_proj"):
        raise TypeError("exact() takes 3D axes: "
                        "subplot_kw={'projection': '3d'}")
    for child in ax.get_children():
        if isinstance(child, ExactDrawing):
            child.tolerance = tolerance
            return child
    drawing = ExactDrawing(tolerance)
    ax.add_artist(drawing)
    for artist in ax._children:
        _take_over(artist)
    return drawing


def _draw_nothing(renderer: Any) -> None:
    """Stands in for an artist's draw(): the axes' ExactDrawing draws it."""


def _project_whole(collection: Any) -> Any:
    """Stands in for a collection's do_3d_projection(), which sorts polygons
    and makes paths of them, one by one, that nobody draws. What is left are the
    colours and the depth."""
    if collection.get_picker() is not None:  # picking takes the paths
        return type(collection).do_3d_projection(collection)
    parts = collection._segslices
    collection._segslices = []
    try:
        depth = type(collection).do_3d_projection(collection)
    finally:
        collection._segslices = parts
    collection._facecolors2d = collection._facecolor3d
    collection._edgecolors2d = collection._edgecolor3d
    return depth


def _take_over(artist: Any) -> bool:
    """Makes an artist that exact() draws leave its drawing to it; whether it is
    one."""
    if not isinstance(artist, _KINDS):
        return False
    artist.draw = _draw_nothing
    if hasattr(artist, "_segslices"):
        artist.do_3d_projection = partial(_project_whole, artist)
    return True


@dataclass
class _Frame:
    """A view of the axes: points of the data to pixels of the axes' box, which
    stand from the top left, and how near they are (greater is nearer)."""

    rows: Floats  # 3, 4: x, y and w in pixels
    depth: Floats  # 4: of the projection, greater is farther
    extent: Floats  # 3: the limits' range
    left: float
    top: float
    width: int
    height: int

    @staticmethod
    def of(ax: Any) -> "_Frame":
        matrix = np.array(ax.M, dtype=np.float64)
        if not matrix[3, :3].any():  # parallel, with any scale
            matrix /= matrix[3, 3]
        screen = ax.transData.get_matrix()
        box = ax.bbox
        x = screen[0, :2] @ matrix[:2] + screen[0, 2] * matrix[3]
        y = screen[1, :2] @ matrix[:2] + screen[1, 2] * matrix[3]
        rows = np.array([x - box.x0 * matrix[3], box.y1 * matrix[3] - y,
                         matrix[3]])
        limits = np.asarray(ax.get_w_lims(), dtype=np.float64)
        extent = np.abs(limits[1::2] - limits[::2])
        return _Frame(rows, matrix[2], extent, box.x0, box.y1,
                      max(1, int(np.ceil(box.width))),
                      max(1, int(np.ceil(box.height))))

    @property
    def is_perspective(self) -> bool:
        return bool((self.rows[2, :3] != 0).any())

    def eye(self) -> Optional[Floats]:
        """The eye in the data's units, in perspective."""
        if not self.is_perspective:
            return None
        eye: Floats = np.linalg.solve(self.rows[:, :3], -self.rows[:, 3])
        return eye

    def image(self, points: Floats) -> Floats:
        """Columns x, y and nearness of points, shape (n, 3)."""
        at = points @ self.rows[:, :3].T + self.rows[:, 3]
        with np.errstate(divide="ignore", invalid="ignore"):
            if self.is_perspective:
                near = 1 / at[:, 2]
                at[at[:, 2] <= 0] = np.nan
            else:
                near = -(points @ self.depth[:3])
            return np.column_stack([at[:, :2] / at[:, 2:], near])

    def to_screen(self, image: Floats) -> Floats:
        return np.column_stack([self.left + image[:, 0],
                                self.top - image[:, 1]])


@dataclass
class _Surfaces:
    """All polygons of the axes that are filled."""

    polygons: List[Floats]
    colors: Floats  # n, 4

    @staticmethod
    def of(artists: Iterable[Any]) -> "_Surfaces":
        polygons: List[Floats] = []
        colors: List[Floats] = []
        for artist in artists:
            points = _polygons_of(artist)
            for polygon, fill in zip(points, _fills_of(artist, len(points))):
                if len(polygon) >= 3 and fill[3] > 0:
                    polygons.append(polygon)
                    colors.append(fill)
        return _Surfaces(polygons, np.array(colors).reshape(-1, 4))

    def mesh(self, frame: _Frame) -> Tuple[Mesh, Floats, Floats]:
        """The polygons in whole steps of the axes, and what a step is: the
        data's points are origin + step * point."""
        points = np.concatenate(self.polygons)
        low, high = points.min(0), points.max(0)
        # Numbers that are large beside their range have so many digits only.
        size = np.max([high - low, np.abs(points).max(0) * 2.0**-28,
                       frame.extent / 2**10], axis=0)
        eye = frame.eye()
        if eye is not None:  # it is within reach of the camera's lattice
            size = np.maximum(size, np.abs(eye - (low + high) / 2) / 16)
        step = 2.0 ** (np.ceil(np.log2(size)) - _BITS)
        origin = np.round((low + high) / 2 / step) * step
        first = np.cumsum([0] + [len(p) for p in self.polygons])
        corners = np.arange(first[-1])
        mesh = Mesh._of(_core.make_mesh(
            np.round((points - origin) / step), first.astype(np.uint32),
            corners.astype(np.int32)))
        return mesh, origin, step


def _polygons_of(collection: Any) -> List[Floats]:
    """The polygons of a Poly3DCollection or of a patch; those with a point that
    is no number are empty."""
    if isinstance(collection, art3d.Patch3D):
        return _loops_of(collection)
    if hasattr(collection, "_segslices"):  # Matplotlib 3.1 to 3.9
        points = _filled(collection._vec[:3])
        found = [points[:, which].T for which in collection._segslices]
    else:
        faces = _filled(collection._faces)
        unused = collection._invalid_vertices
        found = [face if unused is False else face[~unused[i]]
                 for i, face in enumerate(faces)]
    empty = np.empty((0, 3))
    return [p if np.isfinite(p).all() else empty for p in found]


def _loops_of(patch: Any) -> List[Floats]:
    """The loops of a patch, which lies across an axis; curves as polylines."""
    points = _filled(patch._segment3d)
    codes = getattr(patch, "_code3d", None)
    if codes is None or not np.isin(codes, (Path.CURVE3, Path.CURVE4)).any():
        ends = np.flatnonzero(np.asarray(codes) == Path.CLOSEPOLY) \
            if codes is not None else np.empty(0, int)
        keep = np.ones(len(points), bool)
        keep[ends] = False
        starts = (np.flatnonzero(np.asarray(codes) == Path.MOVETO)[1:]
                  if codes is not None else np.empty(0, int))
        return [loop[kept] for loop, kept in zip(np.split(points, starts),
                                                 np.split(keep, starts))]
    flat = int(np.argmin(np.ptp(points, axis=0)))
    across = [axis for axis in range(3) if axis != flat]
    # Curves are divided as those of a picture of that size.
    size = 2000 / max(float(np.ptp(points[:, across])), 1e-300)
    loops = Path(points[:, across] * size, codes).to_polygons()
    return [np.insert(loop[:-1] / size, flat, points[0, flat], axis=1)
            for loop in loops]


def _fills_of(artist: Any, count: int) -> Floats:
    """The colours of an artist's polygons."""
    if not isinstance(artist, art3d.Patch3D):
        return _per_item(artist._facecolor3d, count)
    fill = artist.get_facecolor() if artist.get_fill() else (0, 0, 0, 0)
    return _per_item([fill], count)


def _edges_of(artist: Any, count: int) -> Tuple[Floats, Any]:
    """The colours and the widths of the edges of an artist's polygons."""
    if not isinstance(artist, art3d.Patch3D):
        return (_per_item(artist._edgecolor3d, count),
                np.resize(artist.get_linewidths(), count))
    return (_per_item([artist.get_edgecolor()], count),
            np.full(count, artist.get_linewidth()))


def _filled(values: Any) -> Floats:
    """A copy in doubles; what is masked is not a number."""
    masked: Any = np.ma.array(  # type: ignore[no-untyped-call]
        values, dtype=np.float64)
    return np.array(masked.filled(np.nan))


def _per_item(colors: Any, count: int) -> Floats:
    """One colour an item, from none, one or more."""
    rows = np.asarray(colors, dtype=np.float64).reshape(-1, 4)
    if len(rows) == 0:
        return np.zeros((count, 4))
    return np.array(rows[np.arange(count) % len(rows)])


class ExactDrawing(Artist):  # type: ignore[misc]
    """What `exact` adds to axes: it draws the other artists of these.

    Attributes
    ----------
    region_count : int
        Of the last drawing's visible map; 0 where there is no opaque surface.
    """

    def __init__(self, tolerance: float) -> None:
        super().__init__()
        self.tolerance = tolerance
        self.region_count = 0
        self.set_zorder(-1e9)
        self.set_in_layout(False)
        self._cache: Optional[_Drawn] = None

    def remove(self) -> None:
        """Gives the axes their own drawing back."""
        for artist in self.axes._children:
            artist.__dict__.pop("draw", None)
            artist.__dict__.pop("do_3d_projection", None)
        super().remove()

    def __getstate__(self) -> Dict[str, Any]:
        state: Dict[str, Any] = super().__getstate__()
        state["_cache"] = None
        return state

    def get_tightbbox(self, renderer: Any = None) -> None:
        return None

    def draw(self, renderer: Any) -> None:
        if not self.get_visible():
            return
        artists = [artist for artist in self.axes._children
                   if _take_over(artist)]
        shown = [artist for artist in artists if artist.get_visible()]
        frame = _Frame.of(self.axes)
        drawn = self._drawn(frame, [artist for artist in shown if isinstance(
            artist, _SURFACES)])
        self.region_count = drawn.region_count
        drawn.draw_surfaces(self, renderer)
        for artist in sorted(shown, key=lambda artist: _rank(artist, frame)):
            drawn.draw_artist(self, renderer, artist)
        self.stale = False

    def _drawn(self, frame: _Frame, collections: List[Any]) -> "_Drawn":
        surfaces = _Surfaces.of(collections)
        cached = self._cache
        if cached is None or not cached.holds(frame, surfaces):
            cached = _Drawn(frame, surfaces, self.tolerance)
            self._cache = cached
        return cached

    def own(self, artist: Any) -> Any:
        """Makes an artist of the axes' one that is drawn and forgotten."""
        artist.set_figure(self.figure)
        artist.axes = self.axes
        artist.set_clip_path(self.axes.patch)
        return artist


_SURFACES = (art3d.Poly3DCollection, art3d.Patch3D)
_MARKERS = (art3d.Path3DCollection, art3d.Patch3DCollection)
_KINDS = (*_SURFACES, *_MARKERS, art3d.Line3D, art3d.Line3DCollection,
          art3d.Text3D)


def _points_of(artist: Any) -> Floats:
    """The points of lines and markers, shape (n, 3)."""
    if isinstance(artist, art3d.Line3DCollection):
        lines = [_filled(line) for line in artist._segments3d]
        return np.concatenate(lines) if lines else np.empty((0, 3))
    arrays = (artist._verts3d if isinstance(artist, art3d.Line3D)
              else artist._offsets3d)
    return np.column_stack([_filled(v) for v in np.broadcast_arrays(*arrays)])


def _rank(artist: Any, frame: _Frame) -> Tuple[float, ...]:
    """Edges of surfaces go first, then lines and markers, from far to near,
    markers after lines, then texts."""
    if isinstance(artist, _SURFACES):
        return 0, 0, 0, artist.get_zorder()
    if isinstance(artist, art3d.Text3D):
        return 2, 0, 0, artist.get_zorder()
    near = frame.image(_points_of(artist))[:, 2]
    near = near[np.isfinite(near)]
    mean = float(near.mean()) if len(near) else 0.0
    return 1, mean, isinstance(artist, _MARKERS), artist.get_zorder()


class _Drawn:
    """The surfaces of one frame, ready to be drawn, and what they hide."""

    def __init__(self, frame: _Frame, surfaces: _Surfaces,
                 tolerance: float) -> None:
        self.frame = frame
        self.surfaces = surfaces
        self.tolerance = tolerance
        self.paths: List[Path] = []
        self.colors: Floats = np.empty((0, 4))
        self.is_opaque = True
        self.region_count = 0
        # Rows of three points of the image, and which of them are opaque.
        self.triangles: Floats = np.empty((0, 9))
        self.opaque: npt.NDArray[np.bool_] = np.empty(0, bool)
        self.margin = 0.0
        if surfaces.polygons:
            self._work_out()

    def holds(self, frame: _Frame, surfaces: _Surfaces) -> bool:
        mine = self.surfaces
        return (np.array_equal(self.frame.rows, frame.rows) and
                (self.frame.left, self.frame.top, self.frame.width,
                 self.frame.height) == (frame.left, frame.top, frame.width,
                                        frame.height) and
                np.array_equal(mine.colors, surfaces.colors) and
                len(mine.polygons) == len(surfaces.polygons) and
                all(np.array_equal(a, b) for a, b in
                    zip(mine.polygons, surfaces.polygons)))

    def _work_out(self) -> None:
        frame, surfaces = self.frame, self.surfaces
        mesh, origin, step = surfaces.mesh(frame)
        display = _core.Display.of_mesh(mesh._core)
        rows = frame.rows.copy()
        rows[:, 3] += rows[:, :3] @ origin
        rows[:, :3] *= step
        x, y, z = (-frame.depth[:3] * step).tolist()
        camera = _core.camera_of_matrix(display, rows, (x, y, z), frame.width,
                                        frame.height)
        corners, owner = _core.scene_triangles(display)
        image = frame.image(origin + step * corners.reshape(-1, 3))
        self.triangles = image.reshape(-1, 9)
        alpha = surfaces.colors[owner, 3]
        usable = np.isfinite(self.triangles).all(1)
        self.triangles = np.ascontiguousarray(self.triangles[usable])
        self.opaque = alpha[usable] == 1
        near = self.triangles[:, 2::3]
        if near.size:
            self.margin = self.tolerance * float(near.max() - near.min())
        self.is_opaque = bool((surfaces.colors[:, 3] == 1).all())
        if self.is_opaque:
            self._regions(display, camera)
        else:
            self._layers(display, camera, origin, step)

    def _regions(self, display: _core.Display, camera: _core.Camera) -> None:
        """Paths of the visible map, one a region."""
        colors, keys = np.unique(self.surfaces.colors, axis=0,
                                 return_inverse=True)
        shown = _core.visible_map(display, camera,
                                  keys.reshape(-1).astype(np.int32), False,
                                  50_000_000)
        at = self.frame.to_screen(np.asarray(shown.vertices))
        regions = shown.regions
        filled = regions[regions[:, 1] >= 0]
        self.paths = _closed(at[shown.corners],
                             shown.first_corner.astype(np.intp),
                             filled[:, 2], filled[:, 2] + filled[:, 3])
        self.colors = colors[filled[:, 0]]
        self.region_count = len(regions)

    def _layers(self, display: _core.Display, camera: _core.Camera,
                origin: Floats, step: Floats) -> None:
        """Paths of parts of polygons, from back to front."""
        polygons, first, points = _core.painters_order(display, camera)
        image = self.frame.image(origin + step * points)
        at = self.frame.to_screen(image)
        bounds = first.astype(np.intp)
        kept = np.flatnonzero(np.logical_and.reduceat(
            np.isfinite(at).all(1), bounds[:-1]))
        self.paths = _closed(at, bounds, kept, kept + 1)
        self.colors = self.surfaces.colors[polygons[kept]]

    # Drawing.

    def draw_surfaces(self, owner: ExactDrawing, renderer: Any) -> None:
        if not self.paths:
            return
        is_seamless = self.colors[:, 3] == 1
        if self.is_opaque:
            below = PathCollection(self.paths, facecolors="none",
                                   edgecolors=self.colors,
                                   linewidths=_OVERLAP)
            over = PathCollection(self.paths, facecolors=self.colors,
                                  edgecolors="none", linewidths=0)
            layers = [below, over]
        else:
            edges = self.colors.copy()
            edges[~is_seamless, 3] = 0
            layers = [PathCollection(self.paths, facecolors=self.colors,
                                     edgecolors=edges, linewidths=_OVERLAP,
                                     antialiaseds=is_seamless)]
        for layer in layers:
            layer.set_transform(None)
            owner.own(layer).draw(renderer)

    def draw_artist(self, owner: ExactDrawing, renderer: Any,
                    artist: Any) -> None:
        if isinstance(artist, _SURFACES):
            self._draw_edges(owner, renderer, artist)
        elif isinstance(artist, art3d.Line3DCollection):
            self._draw_segments(owner, renderer, artist)
        elif isinstance(artist, art3d.Line3D):
            self._draw_line(renderer, artist)
        elif isinstance(artist, art3d.Text3D):
            position = np.array([artist.get_position_3d()], dtype=np.float64)
            if self._is_seen(position)[0]:
                type(artist).draw(artist, renderer)
        else:
            self._draw_markers(renderer, artist)

    def _draw_edges(self, owner: ExactDrawing, renderer: Any,
                    collection: Any) -> None:
        polygons = _polygons_of(collection)
        fills = _fills_of(collection, len(polygons))
        edges, widths = _edges_of(collection, len(polygons))
        # Edges in the colour of the face are there to hide seams.
        which = [i for i, polygon in enumerate(polygons) if len(polygon) > 1
                 and edges[i, 3] > 0 and widths[i] > 0 and
                 not (fills[i] == edges[i]).all()]
        if which:
            lines = [np.vstack([polygons[i], polygons[i][:1]]) for i in which]
            self._draw_lines(owner, renderer, lines, edges[which],
                             widths[which])

    def _draw_segments(self, owner: ExactDrawing, renderer: Any,
                       collection: Any) -> None:
        lines = [_filled(line)
                 for line in collection._segments3d]
        collection.update_scalarmappable()
        colors = _per_item(LineCollection.get_edgecolor(collection),
                           len(lines))
        widths = np.resize(collection.get_linewidths(), len(lines))
        self._draw_lines(owner, renderer, lines, colors, widths,
                         collection.get_linestyles())

    def _draw_lines(self, owner: ExactDrawing, renderer: Any,
                    lines: List[Floats], colors: Floats, widths: Any,
                    styles: Any = "solid") -> None:
        for parts, items, opacity in self._visible_lines(lines):
            if not parts:
                continue
            faded = colors[items]
            faded[:, 3] *= opacity
            styles_now = (styles if isinstance(styles, str) else
                          [styles[i % len(styles)] for i in items])
            layer = LineCollection(parts, colors=faded,
                                   linewidths=np.asarray(widths)[items],
                                   linestyles=styles_now, capstyle="round")
            layer.set_transform(None)
            owner.own(layer).draw(renderer)

    def _draw_line(self, renderer: Any, line: Any) -> None:
        points = _points_of(line)
        inverse = line.axes.transData.inverted()
        marker, style, alpha = (line.get_marker(), line.get_linestyle(),
                                line.get_alpha())
        try:
            line.set_marker("None")
            for parts, _, opacity in self._visible_lines([points]):
                if not parts:
                    continue
                gap = np.full((1, 2), np.nan)
                data = np.vstack([row for part in parts for row in (part, gap)])
                at = inverse.transform(data)
                line.set_data(at[:, 0], at[:, 1])
                line.set_alpha((1 if alpha is None else alpha) * opacity
                               if opacity < 1 else alpha)
                Line2D.draw(line, renderer)
            line.set_alpha(alpha)
            line.set_marker(marker)
            if marker not in (None, "None", "none", " ", ""):
                line.set_linestyle("None")
                seen = self._is_seen(points)
                image = self.frame.image(points[seen])
                at = inverse.transform(self.frame.to_screen(image))
                line.set_data(at[:, 0], at[:, 1])
                Line2D.draw(line, renderer)
        finally:
            line.set_marker(marker)
            line.set_linestyle(style)
            line.set_alpha(alpha)
        line.stale = False

    def _draw_markers(self, renderer: Any, collection: Any) -> None:
        points = _points_of(collection)
        # do_3d_projection() has put the offsets in the order of this index.
        order = collection._z_markers_idx
        seen = self._is_seen(points)[order]
        kept = collection.get_offsets()
        offsets = _filled(kept)
        offsets[~seen] = np.nan
        # Not by way of the 3D class, which would take them for data.
        PathCollection.set_offsets(collection, offsets)
        type(collection).draw(collection, renderer)
        PathCollection.set_offsets(collection, kept)

    # Visibility.

    def _is_seen(self, points: Floats) -> npt.NDArray[np.bool_]:
        """Whether no opaque surface is before points."""
        image = self.frame.image(points)
        seen: npt.NDArray[np.bool_] = np.isfinite(image).all(1)
        rows = np.repeat(image[seen], 2, axis=0).reshape(-1, 6)
        parts = _core.visible_parts(self.triangles[self.opaque], rows,
                                    self.margin)
        shown = np.zeros(len(rows), bool)
        shown[parts[:, 0].astype(int)] = True
        seen[seen] = shown
        return seen

    def _visible_lines(self, lines: List[Floats]) -> List[
            Tuple[List[Floats], Ints, float]]:
        """The parts of lines that are seen on the screen, with the line of
        each, and their opacity: those that something translucent is before,
        then those that nothing is before."""
        rows, items = self._rows(lines)
        clear = _core.visible_parts(self.triangles, rows, self.margin)
        groups = []
        if not self.opaque.all():
            # All that no opaque surface hides, in the share that shines
            # through; what is before everything is drawn over it in full.
            alpha = self.surfaces.colors[:, 3]
            opacity = 1 - float(alpha[alpha < 1].mean())
            seen = _core.visible_parts(self.triangles[self.opaque], rows,
                                       self.margin)
            groups.append((*self._joined(rows, items, seen), opacity))
        groups.append((*self._joined(rows, items, clear), 1.0))
        return groups

    def _rows(self, lines: List[Floats]) -> Tuple[Floats, Ints]:
        """The segments of lines in the image, and the line of each."""
        rows, items = [], []
        for i, line in enumerate(lines):
            image = self.frame.image(line)
            row = np.hstack([image[:-1], image[1:]])
            usable = np.isfinite(row).all(1)
            rows.append(row[usable])
            items.append(np.full(int(usable.sum()), i, np.int32))
        if not rows:
            return np.empty((0, 6)), np.empty(0, np.int32)
        return np.vstack(rows), np.concatenate(items)

    def _joined(self, rows: Floats, items: Ints,
                parts: Floats) -> Tuple[List[Floats], Ints]:
        """The parts of segments as polylines on the screen, as long as they
        go."""
        which = parts[:, 0].astype(int)
        begin, end = rows[which, :2], rows[which, 3:5]
        ends = [self.frame.to_screen(begin + (end - begin) * parts[:, k:k + 1])
                for k in (1, 2)]
        lines: List[Floats] = []
        owners: List[int] = []
        if len(which) == 0:
            return lines, np.empty(0, np.int32)
        goes_on = np.zeros(len(which), bool)
        goes_on[1:] = ((which[1:] == which[:-1] + 1) &
                       (items[which[1:]] == items[which[:-1]]) &
                       (parts[:-1, 2] == 1) & (parts[1:, 1] == 0) &
                       (np.abs(ends[0][1:] - ends[1][:-1]).max(1) < 1e-6))
        starts = np.flatnonzero(~goes_on)
        for a, b in zip(starts, np.append(starts[1:], len(which))):
            lines.append(np.vstack([ends[0][a:a + 1], ends[1][a:b]]))
            owners.append(int(items[which[a]]))
        return lines, np.array(owners, np.int32)


def _closed(points: Floats, first: npt.NDArray[np.intp], begins: Any,
            ends: Any) -> List[Path]:
    """Paths of loops, each of those from `begins` on that are before `ends`;
    `first` are the loops' first rows of points, and the number of these."""
    loops = len(first) - 1
    vertices = np.insert(points, first[1:], points[first[:-1]], axis=0)
    bounds = first + np.arange(loops + 1)
    codes = np.full(len(vertices), Path.LINETO, Path.code_type)
    codes[bounds[:-1]] = Path.MOVETO
    codes[bounds[1:] - 1] = Path.CLOSEPOLY
    return [Path(vertices[begin:end], codes[begin:end]) for begin, end in
            zip(bounds[begins].tolist(), bounds[ends].tolist())]
