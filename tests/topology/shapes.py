#!/usr/bin/env python3
"""The shapes of the topology suite: closed surfaces whose components, cavities and genus are known by construction.

    shapes.py [--only PATTERN] [--write FOLDER]

makes each truth mesh, checks it against what is stated, and prints a table. No constant of dsc was chosen with these shapes,
and they stay as they are: a shape is changed only where its truth is wrong.

`wall` is the least thickness of the solid and `gap` the least width of the space between its parts, in the shape's own units.
"""

import argparse
import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import packages  # noqa: F401
import numpy as np

from fields import (along, ball, box, common, cut, cylinder, disc, extruded, revolved, rod, torus, turned, union)
from marching import surface_mesh
from surfaces import Topology, area_of, topology

NO_GAP = float("inf")
X, Y, Z = np.eye(3)
O = np.zeros(3)
TAU = 2 * np.pi
POINTS = 20000  # of an ordinary cloud; the truth mesh is finer than the spacing of its points


@dataclass(frozen=True)
class Shape:
    """A solid: its field, a box around it, the area of its surface (to 2 %), its least features and its topology."""

    field: Callable
    low: tuple
    high: tuple
    area: float
    wall: float
    gap: float
    truth: Topology

    def spacing(self, count):
        """Root of the area per point."""
        return (self.area / count) ** 0.5

    def feature(self, count=POINTS):
        """The least of wall and gap, in spacings of a cloud of `count` points."""
        return min(self.wall, self.gap) / self.spacing(count)

    def mesh(self, fineness=2):
        """Points and outward triangles, from cubes of a spacing over `fineness`."""
        return surface_mesh(self.field, self.low, self.high, self.spacing(POINTS) / fineness)


def solid(field, half, area, wall, gap, components=1, cavities=0, genus=0):
    """A shape in the box from -half to half."""
    half = np.broadcast_to(np.asarray(half, float), 3)
    return Shape(field, tuple(-half), tuple(half), area, wall, gap, Topology(components, cavities, genus))


def cheese():
    """A cube with twenty tunnels in four layers, crosswise."""
    at = 0.37 * np.arange(-2, 3)
    heights = (-0.72, -0.24, 0.24, 0.72)
    tunnels = [cylinder((0, s, z) if k % 2 else (s, 0, z), X if k % 2 else Y, 0.1) for k, z in enumerate(heights) for s in at]
    return solid(cut(box(O, (2, 2, 2)), *tunnels), 1, 48, 0.16, 0.2, genus=20)


def nested_boxes():
    outer = cut(box(O, [2.0] * 3), box(O, [1.64] * 3))
    inner = cut(box(O, [1.0] * 3), box(O, [0.64] * 3))
    return solid(union(outer, inner), 1, 48.6, 0.18, 0.32, components=2, cavities=2)


def plate_with_holes():
    """2.5 spacings thick."""
    holes = [cylinder((x, y, 0), Z, 0.25) for x in (-0.95, 0, 0.95) for y in (-0.48, 0.48)]
    return solid(cut(box(O, (3, 2, 0.058)), *holes), (1.5, 1, 0.05), 10.77, 0.058, 0.5, genus=6)


def gear():
    """Sixteen teeth, a bore and five windows between spokes."""
    teeth = [turned(box((1.05, 0), (0.24, 0.2)), TAU * k / 16) for k in range(16)]
    spokes = [turned(box((0.52, 0), (0.6, 0.16)), TAU * (k + 0.3) / 5) for k in range(5)]
    flat = cut(union(cut(union(disc(1.0), *teeth), disc(0.78)), disc(0.32), *spokes), disc(0.14))
    return solid(extruded(flat, 0.3), (1.2, 1.2, 0.2), 11.5, 0.16, 0.19, genus=6)


def helix():
    t = np.linspace(-1.5 * TAU, 1.5 * TAU, 6000)
    curve = np.stack([np.cos(t), np.sin(t), 0.55 * t / TAU], axis=1)
    return solid(along(curve, 0.12), (1.15, 1.15, 1), 14.3, 0.24, 0.30)


def trefoil():
    t = np.linspace(0, TAU, 8000, endpoint=False)
    curve = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=1)
    return solid(along(curve, 0.4), (3.5, 3.5, 1.5), 72.4, 0.8, 0.41, genus=1)


def letter_a():
    flat = union(rod((-0.7, -1), (0, 1), 0.14), rod((0.7, -1), (0, 1), 0.14), rod((-0.5, -0.4), (0.5, -0.4), 0.13))
    return solid(extruded(flat, 0.3), (0.9, 1.2, 0.2), 5.67, 0.26, 0.38, genus=1)


def letter_b():
    def bowl(centre, radius):
        t = np.linspace(-TAU / 4, TAU / 4, 1500)
        arc = np.asarray(centre) + radius * np.stack([np.cos(t), np.sin(t)], axis=1)
        ends = [rod((-0.4, centre[1] + s * radius), (centre[0], centre[1] + s * radius), 0.12) for s in (-1, 1)]
        return union(along(arc, 0.12), *ends)
    flat = union(rod((-0.4, -1), (-0.4, 0.9), 0.12), bowl((0.2, -0.5), 0.5), bowl((0.1, 0.45), 0.45))
    return solid(extruded(flat, 0.28), (0.9, 1.2, 0.2), 6.2, 0.24, 0.6, genus=2)


def figure_8():
    flat = cut(union(disc(0.62, (0, -0.5)), disc(0.5, (0, 0.5))), disc(0.38, (0, -0.5)), disc(0.28, (0, 0.5)))
    return solid(extruded(flat, 0.3), (0.7, 1.2, 0.2), 5.5, 0.22, 0.56, genus=2)


def wine_glass():
    """A deep open bowl on a stem; no handle, no cavity."""
    t = np.linspace(0, 1, 2000)
    bowl = np.stack([0.55 * np.sin(0.62 * np.pi * t), 1.2 * t ** 1.5], axis=1)
    flat = union(along(bowl, 0.05), rod((0, -1), (0, 0), 0.07), rod((0, -1), (0.5, -1), 0.05))
    return solid(revolved(flat), (0.65, 0.65, 1.3), 10.3, 0.1, 0.5)


def mug():
    handle = torus((0.62, 0, 0), Y, 0.36, 0.09)
    body = union(cylinder(O, Z, 0.6, 1.3), handle)
    return solid(cut(body, cylinder((0, 0, 0.1), Z, 0.5, 1.3)), (1.2, 0.7, 0.7), 11.3, 0.1, 0.28, genus=1)


def struts():
    """3 x 3 x 2 nodes and the 33 struts between neighbours: genus 33 - 18 + 1."""
    nodes = [np.array([x, y, z]) for x in (-0.8, 0, 0.8) for y in (-0.8, 0, 0.8) for z in (-0.4, 0.4)]
    pairs = [(a, b) for i, a in enumerate(nodes) for b in nodes[i + 1:] if abs(np.linalg.norm(a - b) - 0.8) < 1e-9]
    assert len(pairs) == 33
    return solid(union(*(rod(a, b, 0.1) for a, b in pairs)), (0.95, 0.95, 0.55), 14.05, 0.2, 0.6, genus=16)


def socket_and_ball():
    """A ball in a socket, four spacings apart."""
    gap = 0.112
    bowl = common(cut(cylinder((0, 0, -0.3), Z, 0.9, 1.0), ball(O, 0.6 + gap)), lambda p: p[:, 2])
    return solid(union(bowl, ball(O, 0.6)), 1, 15.6, 0.108, gap, components=2)


def scroll():
    """A sheet rolled up in two and a half turns."""
    t = np.linspace(0, 2.5, 6000)
    curve = (0.25 + 0.25 * t)[:, None] * np.stack([np.cos(TAU * t), np.sin(TAU * t)], axis=1)
    return solid(extruded(along(curve, 0.05), 0.8), (1, 1, 0.45), 16.1, 0.1, 0.15)


def heat_sink():
    fins = [box((x, 0, 0.3), (0.09, 1.2, 0.7)) for x in np.linspace(-0.955, 0.955, 7)]
    return solid(union(box((0, 0, -0.1), (2, 1.2, 0.15)), *fins), (1.05, 0.65, 0.7), 17.8, 0.09, 0.228)


def pipe_tee():
    """A pipe with a branch, open at three ends."""
    outer = union(cylinder(O, X, 0.4, 2), cylinder((0, 0, 0.5), Z, 0.4, 1))
    inner = union(cylinder(O, X, 0.26), cylinder((0, 0, 0.75), Z, 0.26, 1.5))
    return solid(cut(outer, inner), (1.05, 0.5, 1.05), 11.6, 0.14, 0.52, genus=2)


def foam():
    """A ball with five hollows."""
    hollows = [ball(0.55 * s, 0.28) for s in (X, -X, Y, -Y, Z)]
    return solid(cut(ball(O, 1.0), *hollows), 1, 17.5, 0.17, 0.56, cavities=5)


def rounded_pair():
    """Two rounded boxes, face to face, two spacings apart."""
    def rounded(centre):
        return lambda p: box(centre, (0.6, 0.8, 0.4))(p) - 0.1
    gap = 0.0366
    return solid(union(rounded((0, 0, 0.3 + gap / 2)), rounded((0, 0, -0.3 - gap / 2))), (0.5, 0.6, 0.7), 6.68, 0.6, gap, components=2)


def plates():
    """Three separate plates."""
    return solid(union(*(box((0, 0, z), (1.6, 1.2, 0.12)) for z in (-0.24, 0, 0.24))), (0.9, 0.7, 0.4), 13.5, 0.12, 0.12, components=3)


SHAPES = {
    "torus": solid(torus(O, Z, 1.0, 0.4), (1.4, 1.4, 0.4), 15.8, 0.8, 1.2, genus=1),
    "thin_torus": solid(torus(O, Z, 1.0, 0.05), (1.1, 1.1, 0.1), 1.97, 0.1, 1.9, genus=1),
    "two_rings": solid(union(torus((-0.5, 0, 0), Z, 1.0, 0.22), torus((0.5, 0, 0), Y, 1.0, 0.22)), (1.75, 1.25, 1.25),
                       17.4, 0.44, 0.56, components=2, genus=2),
    "three_rings": solid(union(torus((-1.4, 0, 0), Z, 1.0, 0.15), torus(O, Y, 1.0, 0.15), torus((1.4, 0, 0), Z, 1.0, 0.15)),
                         (2.6, 1.2, 1.2), 17.8, 0.3, 0.3, components=3, genus=3),
    "cheese": cheese(),
    "hollow_ball": solid(cut(ball(O, 1.0), ball(O, 0.7)), 1, 18.7, 0.3, 1.4, cavities=1),
    "nested_boxes": nested_boxes(),
    "plate_with_holes": plate_with_holes(),
    "gear": gear(),
    "rounded_pair": rounded_pair(),
    "socket_and_ball": socket_and_ball(),
    "helix": helix(),
    "letter_a": letter_a(),
    "letter_b": letter_b(),
    "figure_8": figure_8(),
    "needle": solid(rod((-2, 0, 0), (2, 0, 0), 0.08, 0.03), (2.1, 0.1, 0.1), 1.43, 0.06, NO_GAP),
    "brick": solid(box(O, (1, 0.8, 0.6)), (0.5, 0.4, 0.3), 3.76, 0.6, NO_GAP),
    "trefoil": trefoil(),
    "wine_glass": wine_glass(),
    "mug": mug(),
    "struts": struts(),
    "plates": plates(),
    "heat_sink": heat_sink(),
    "pipe_tee": pipe_tee(),
    "foam": foam(),
    "hollow_torus": solid(cut(torus(O, Z, 1.0, 0.42), torus(O, Z, 1.0, 0.27)), (1.45, 1.45, 0.45), 27.2, 0.15, 0.54,
                          cavities=1, genus=2),
    "scroll": scroll(),
}


AREA_TOLERANCE = 0.02


def faults(shape, points, faces):
    """What a mesh of the shape lacks to be its truth; empty where nothing does."""
    found, area = topology(points, faces), area_of(points, faces)
    return ([f"topology {found} instead of {shape.truth}"] if found != shape.truth else []) + (
        [f"area {area:.4g} instead of {shape.area}"] if abs(area / shape.area - 1) > AREA_TOLERANCE else [])


def checked_mesh(name):
    """The truth mesh; raises ValueError where it is not what is stated."""
    points, faces = SHAPES[name].mesh()
    wrong = faults(SHAPES[name], points, faces)
    if wrong:
        raise ValueError(f"the truth of {name} has {' and '.join(wrong)}")
    return points, faces


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", default="", help="a regular expression on names")
    parser.add_argument("--write", type=Path, help="folder for the truth meshes, as .off")
    options = parser.parse_args()
    wrong = 0
    print(f"{'shape':18} {'truth':12} {'area':>8} {'wall':>7} {'gap':>7}  in spacings of {POINTS:,} points")
    for name, shape in SHAPES.items():
        if not re.search(options.only, name):
            continue
        points, faces = shape.mesh()
        problems = faults(shape, points, faces)
        wrong += bool(problems)
        spacing = shape.spacing(POINTS)
        print(f"{name:18} {str(shape.truth):12} {shape.area:8.3f} {shape.wall / spacing:7.1f} {shape.gap / spacing:7.1f}"
              f"  {'; '.join(problems)}", flush=True)
        if options.write:
            options.write.mkdir(parents=True, exist_ok=True)
            with open(options.write / f"{name}.off", "w", encoding="utf-8") as out:
                out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
                np.savetxt(out, points, "%.9g")
                np.savetxt(out, np.column_stack([np.full(len(faces), 3), faces]), "%d")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
