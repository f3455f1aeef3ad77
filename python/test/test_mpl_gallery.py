"""Figures that users of Matplotlib have reported, before and after exact().

Each scene is of the kind that its thread is about: the number is that of the
issue, or of the pull request, in Matplotlib's repository. A test looks at
pixels whose colour tells what is in front. The pictures, before and after, are
left in the folder that HALFSPACE_GALLERY names.
"""
import os
import pathlib

import matplotlib
import numpy as np
import pytest
from matplotlib.patches import Circle, Rectangle
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection, pathpatch_2d_to_3d

from halfspace import mpl

matplotlib.use("Agg")
plt = pytest.importorskip("matplotlib.pyplot")

RED, GREEN, BLUE, YELLOW = "#ff0000", "#00ff00", "#0000ff", "#ffff00"


class Scene:
    """Axes, and points whose colour is known."""

    def __init__(self, elev=25, azim=-50):
        self.figure = plt.figure(figsize=(4, 4), dpi=100)
        self.ax = self.figure.add_subplot(projection="3d", elev=elev, azim=azim)
        self.ax.set_axis_off()

    def pixels(self):
        self.figure.canvas.draw()
        return np.asarray(self.figure.canvas.buffer_rgba())[:, :, :3]

    def color_at(self, pixels, point):
        x, y, _ = proj3d.proj_transform(*point, self.ax.get_proj())
        px, py = self.ax.transData.transform((x, y))
        return tuple(pixels[pixels.shape[0] - 1 - int(py), int(px)].tolist())

    def compare(self, name, expected):
        """`expected`: points, and the colour that is seen there."""
        wanted = [matplotlib.colors.to_rgb(color) for _, color in expected]
        wanted = [tuple(round(255 * c) for c in color) for color in wanted]
        before = self.pixels().copy()
        was = [self.color_at(before, point) for point, _ in expected]
        mpl.exact(self.ax)
        after = self.pixels().copy()
        now = [self.color_at(after, point) for point, _ in expected]
        folder = os.environ.get("HALFSPACE_GALLERY")
        if folder:
            pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
            both = np.concatenate([before, after], axis=1)
            plt.imsave(pathlib.Path(folder, name + ".png"), both)
        plt.close(self.figure)
        assert now == wanted
        assert was != wanted, "Matplotlib draws it right by itself"


def flat(ax, x, y, z, color):
    """A surface in one colour, without light."""
    return ax.plot_surface(*np.broadcast_arrays(x, y, z), color=color,
                           shade=False, rstride=1, cstride=1)


def plane(n=2, size=1.0):
    return np.meshgrid(np.linspace(-size, size, n), np.linspace(-size, size, n))


def test_3894_a_line_through_a_plane():
    scene = Scene()
    x, y = plane()
    flat(scene.ax, x, y, 0 * x, GREEN)
    scene.ax.plot([0, 0], [0, 0], [-1, 1], color=RED, linewidth=6)
    scene.compare("3894", [((0, 0, 0.6), RED), ((0, 0, -0.2), GREEN)])


def test_9499_patches_one_behind_the_other():
    scene = Scene(elev=30, azim=-60)
    disc = Circle((0, 0), 8, facecolor=BLUE, edgecolor="none")
    square = Rectangle((-5, -5), 10, 10, facecolor=GREEN, edgecolor="none")
    for patch, x in ((disc, 0), (square, 6)):
        scene.ax.add_patch(patch)
        pathpatch_2d_to_3d(patch, z=x, zdir="x")
    x, y = plane(2, 8)
    flat(scene.ax, x, y, 0 * x, YELLOW)
    scene.ax.set(xlim=(-16, 16), ylim=(-16, 16), zlim=(-16, 16))
    scene.compare("9499", [((6, 0, 2), GREEN), ((0, -5, 3), BLUE),
                           ((3, -6, 0), YELLOW), ((-7, -7, 0), YELLOW),
                           ((0, 0, 7), BLUE)])


def test_12620_a_segment_and_points_on_a_plane():
    scene = Scene(elev=30, azim=-60)
    corners = [(0, 0, 0), (0, 5, 0), (5, 5, 0), (5, 0, 0)]
    scene.ax.add_collection3d(Poly3DCollection([corners], facecolors=GREEN))
    scene.ax.plot([2, 2], [2, 2], [0, 4], color=RED, linewidth=5)
    scene.ax.scatter([3], [1], [1], color=BLUE, s=200, depthshade=False)
    scene.ax.set(xlim=(0, 5), ylim=(0, 5), zlim=(0, 2.5))
    scene.compare("12620", [((2, 2, 1), RED), ((3, 1, 1), BLUE),
                            ((4, 4, 0), GREEN)])


def test_14148_points_on_this_side_and_on_the_other():
    scene = Scene(elev=15, azim=-60)
    x, y = plane(21)
    flat(scene.ax, x, y, -(x * x + y * y), GREEN)
    scene.ax.scatter([0], [-0.3], [0.1], color=RED, s=150, depthshade=False)
    scene.ax.scatter([0], [0.9], [-1.2], color=BLUE, s=150, depthshade=False)
    scene.compare("14148", [((0, -0.3, 0.1), RED), ((0, 0.9, -1.2), GREEN)])


def test_16071_a_cylinder_beside_a_plane():
    scene = Scene(elev=20, azim=70)
    y, z = plane(2, 0.5)
    flat(scene.ax, 0 * y, y, z, YELLOW)
    t, h = np.meshgrid(np.linspace(0, 2 * np.pi, 50), np.linspace(-.5, .5, 20))
    flat(scene.ax, 0.1 * np.cos(t) + 0.1, 0.1 * np.sin(t), h, BLUE)
    scene.ax.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1, 1))
    scene.compare("16071", [((0.13, 0.095, 0), BLUE), ((0, 0.4, 0), YELLOW)])


def test_17147_lines_and_points_in_the_order_in_which_they_are_updated():
    scene = Scene(elev=10, azim=-90)
    for y, color in ((-1, RED), (0, GREEN), (1, BLUE)):
        scene.ax.plot([-1, 1], [y, y], [-1, 1], color=color, linewidth=12)
        scene.ax.scatter([0.8 * y], [-y], [0.9 * y], color=color, s=400,
                         depthshade=False)
    scene.ax.bar3d(-0.2, -0.2, -1, 0.4, 0.4, 2, color=YELLOW, shade=False)
    scene.compare("17147", [((0, -1, 0), RED), ((0, -0.2, -0.5), YELLOW),
                            ((0.8, -1, 0.9), BLUE)])


def test_18612_an_orbit_round_a_planet():
    scene = Scene(elev=20, azim=-60)
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 40), np.linspace(0, np.pi, 20))
    flat(scene.ax, np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v),
         GREEN)
    t = np.linspace(0, 2 * np.pi, 200)
    scene.ax.plot(1.4 * np.cos(t), 1.4 * np.sin(t), 0 * t, color=RED,
                  linewidth=6)
    to_eye = np.radians(-60)
    front = (1.4 * np.cos(to_eye), 1.4 * np.sin(to_eye), 0)
    behind = (-front[0], -front[1], 0)
    scene.compare("18612", [(front, RED), (behind, GREEN)])


def test_22165_polygons_of_different_sizes():
    scene = Scene(elev=30, azim=-60)
    big = [(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)]
    below = [(2, -3, -0.1), (3, -3, -0.1), (3, -2, -0.1), (2, -2, -0.1)]
    above = [(-3, 2, 0.1), (-2, 2, 0.1), (-2, 3, 0.1), (-3, 3, 0.1)]
    scene.ax.add_collection3d(Poly3DCollection(
        [big, below, above], facecolors=[GREEN, RED, RED]))
    scene.ax.set(xlim=(-4, 4), ylim=(-4, 4), zlim=(-1, 1))
    scene.compare("22165", [((2.5, -2.5, -0.1), GREEN),
                            ((-2.5, 2.5, 0.1), RED), ((0, 0, 0), GREEN)])


def test_23392_points_over_and_under_a_surface():
    scene = Scene(elev=30, azim=-60)
    x, y = np.meshgrid(np.linspace(-5, 5, 60), np.linspace(-5, 5, 60))

    def height(x, y):
        return np.sin(x) + 0.5 * y * np.cos(x)

    flat(scene.ax, x, y, height(x, y), GREEN)
    for offset, color in ((0.4, RED), (-0.4, BLUE)):
        scene.ax.scatter([0, 2.5], [-2, -1], [height(0, -2) + offset,
                                              height(2.5, -1) + offset],
                         color=color, s=120, depthshade=False)
    scene.compare("23392", [((2.5, -1, height(2.5, -1) + 0.4), RED),
                            ((2.5, -1, height(2.5, -1) - 0.4), GREEN)])


def test_29060_planes_that_cross():
    scene = Scene(elev=30, azim=-60)
    x, y = np.meshgrid([-1, 1], [-1, 1])
    flat(scene.ax, x, y, np.zeros_like(x), GREEN)
    flat(scene.ax, x, y, np.array([[-1, -1], [1, 1]]), BLUE)
    scene.compare("29060", [((0, -0.5, 0), GREEN), ((0.3, 0.3, 0.3), BLUE)])


def test_12744_points_over_a_surface_of_a_path():
    scene = Scene(elev=50, azim=-60)
    x, y = plane(21, 2)
    flat(scene.ax, x, y, x * x + y * y, GREEN)
    t = np.linspace(1, 0.1, 15)
    # Seen inside of the bowl, and hidden by its near wall outside of it.
    scene.ax.plot(t, t, 2 * t * t + 0.3, color=RED, linewidth=5)
    scene.ax.scatter([1], [1], [2.3], color=BLUE, s=120, depthshade=False)
    scene.compare("12744", [((1, 1, 2.3), BLUE), ((0.55, 0.55, 0.905), RED)])
