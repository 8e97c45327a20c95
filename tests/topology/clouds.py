#!/usr/bin/env python3
"""The clouds of the topology suite: which kinds each shape gets, the table of them all, and the points of each.

    clouds.py --work FOLDER [--write]     prints the table; --write renews shapes.json, which run.py reads

Kinds, of points uniform by area on the truth mesh, which is turned at random once per shape:
    clean      no change
    noise      Gaussian in all directions, sigma 0.25 % of the diagonal of the box of the turned mesh
    one_sided  the same sigma, its absolute value, outward only
    outliers   10 % more points, uniform in the box 1.2 times as large
    gradient   density falls linearly to a tenth along the first axis
    missing    three balls cut away, each with 2 % of the points, apart from each other
    sparse     3,000 points, clean
Which kinds a shape gets follows from its least feature (the lesser of wall and gap) alone:
    sparse     the feature is at least 3 spacings of 3,000 points
    gradient   it is at least 3 spacings at the thin end, where the spacing is sqrt(0.55 / 0.1) times the mean
    noise, one_sided   it is at least 8 sigma
    missing    three places are found where a ball takes one sheet: every normal in it within 78 degrees of their mean
    outliers   every second shape; one_sided and gradient the others, so that the whole stays near a hundred clouds
"""

import argparse
import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

import packages  # noqa: F401
import numpy as np
from scipy.spatial import cKDTree

from shapes import POINTS, SHAPES, checked_mesh
from surfaces import Topology, random_rotation, sample, write_cloud

TABLE = Path(__file__).resolve().parent / "shapes.json"
KINDS = ("clean", "noise", "one_sided", "outliers", "gradient", "missing", "sparse")
SPARSE = 3000
SIGMA = 0.0025  # of the diagonal
LEAST_SPACINGS = 3
LEAST_SIGMAS = 8
OUTLIERS = 0.1
STEEPNESS = 10
BALLS, BALL_SHARE, ONE_SHEET, PLACES = 3, 0.02, 0.2, 400
# A box with few points is a matter of its own.
FEW = {"brick": ((150, ("clean", "noise")), (600, ("clean", "missing")))}


@dataclass(frozen=True)
class Cloud:
    """One row of the table; `spacings` is the shape's least feature in spacings of this cloud."""

    name: str
    shape: str
    kind: str
    points: int
    seed: int
    components: int
    cavities: int
    genus: int
    spacings: float

    @property
    def truth(self):
        return Topology(self.components, self.cavities, self.genus)


class Truths:
    """Turned truth meshes, kept as files in a folder."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def mesh(self, name):
        file = self.folder / f"{name}.npz"
        if not file.exists():
            points, faces = checked_mesh(name)
            np.savez(file, points=points, faces=faces)
        stored = np.load(file)
        turn = random_rotation(np.random.default_rng(list(SHAPES).index(name)))
        return stored["points"] @ turn.T, stored["faces"]


def diagonal(points):
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def without_balls(points, normals, rng):
    """The points outside of three balls that each take 2 % of them from one sheet, or None where there is no room."""
    count = round(BALL_SHARE * len(points))
    tree, balls, gone = cKDTree(points), [], np.zeros(len(points), bool)
    for place in rng.permutation(len(points))[:PLACES]:
        distance, near = tree.query(points[place], count)
        mean = normals[near].mean(axis=0)
        one_sheet = (normals[near] @ mean).min() > ONE_SHEET * np.linalg.norm(mean)
        apart = all(np.linalg.norm(points[place] - c) >= distance[-1] + r for c, r in balls)
        if one_sheet and apart:
            balls.append((points[place], distance[-1]))
            gone[near] = True
        if len(balls) == BALLS:
            return points[~gone]
    return None


def make(mesh, kind, count, seed):
    """Points (n, 3) of a kind, or None where the shape has no room for it."""
    rng = np.random.default_rng(seed)
    points, normals = sample(*mesh, count * (3 if kind == "gradient" else 1), rng)
    sigma = SIGMA * diagonal(mesh[0])
    low, high = mesh[0].min(axis=0), mesh[0].max(axis=0)
    if kind == "noise":
        points = points + sigma * rng.normal(size=points.shape)
    elif kind == "one_sided":
        points = points + sigma * np.abs(rng.normal(size=(count, 1))) * normals
    elif kind == "outliers":
        more = (low + high) / 2 + (rng.random((round(OUTLIERS * count), 3)) - 0.5) * 1.2 * (high - low)
        points = rng.permutation(np.concatenate([points, more]))
    elif kind == "gradient":
        density = 1 - (1 - 1 / STEEPNESS) * (points[:, 0] - low[0]) / (high[0] - low[0])
        points = points[rng.random(len(points)) < density][:count]
    elif kind == "missing":
        points = without_balls(points, normals, rng)
    return points


def suits(name, kind, count, mesh, seed):
    """Whether a shape gets a kind: the rules above."""
    shape = SHAPES[name]
    least = min(shape.wall, shape.gap)
    even = list(SHAPES).index(name) % 2 == 0
    thin_end = ((1 + 1 / STEEPNESS) / 2 * STEEPNESS) ** 0.5
    by_noise = least >= LEAST_SIGMAS * SIGMA * diagonal(mesh[0])
    rules = {"noise": lambda: by_noise,
             "one_sided": lambda: by_noise and not even,
             "outliers": lambda: even,
             "gradient": lambda: not even and shape.feature(count) >= LEAST_SPACINGS * thin_end,
             "missing": lambda: make(mesh, kind, count, seed) is not None,
             "sparse": lambda: shape.feature(count) >= LEAST_SPACINGS}
    return rules.get(kind, lambda: True)()


def designed(truths, names=SHAPES):
    """The table, from the shapes and the rules."""
    rows = []
    for name in names:
        shape, mesh, index = SHAPES[name], truths.mesh(name), list(SHAPES).index(name)
        plan = [(SPARSE if kind == "sparse" else POINTS, kind) for kind in KINDS]
        plan += [(count, kind) for count, kinds in FEW.get(name, ()) for kind in kinds]
        for number, (count, kind) in enumerate(plan):
            seed = 1000 + 100 * index + number
            if suits(name, kind, count, mesh, seed):
                few = "" if count in (POINTS, SPARSE) else f"-{count}"
                rows.append(Cloud(f"{name}-{kind}{few}", name, kind, count, seed, shape.truth.components, shape.truth.cavities,
                                  shape.truth.genus, round(shape.feature(count), 1)))
    return rows


def table():
    """The clouds of shapes.json."""
    return [Cloud(**row) for row in json.loads(TABLE.read_text(encoding="utf-8"))]


def cloud_file(cloud, folder, truths):
    """The cloud as a .obj file in the folder, made where it is not there."""
    file = Path(folder) / f"{cloud.name}.obj"
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        part = file.with_suffix(".part")
        write_cloud(part, make(truths.mesh(cloud.shape), cloud.kind, cloud.points, cloud.seed))
        part.rename(file)
    return file


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--work", type=Path, required=True, help="folder for the truth meshes")
    parser.add_argument("--write", action="store_true", help="renew shapes.json")
    options = parser.parse_args()
    rows = designed(Truths(options.work / "truth"))
    for row in rows:
        print(f"{row.name:28} {str(row.truth):12} {row.points:6} points  seed {row.seed}  {row.spacings:5} spacings")
    print(f"{len(rows)} clouds of {len(SHAPES)} shapes: "
          + ", ".join(f"{kind} {sum(r.kind == kind for r in rows)}" for kind in KINDS))
    if options.write:
        TABLE.write_text("[\n" + ",\n".join(json.dumps(asdict(row)) for row in rows) + "\n]\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
