#!/usr/bin/env python3
"""How far a surface is from the true one, by samples of each and the exact nearest triangle of the other.

    accuracy.py SURFACE TRUTH [--samples N] [--seed N]

Lengths are in per cent of the diagonal of the truth's box. Chamfer is the mean of the two mean distances, the 99 % Hausdorff distance
the larger of the two 0.99-quantiles, the normal consistency the mean of |cos| between a sample's normal and that of the triangle
nearest to it, over both ways.
"""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "topology"))
import packages  # noqa: F401,E402
import numpy as np  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402
from surfaces import read_mesh, sample  # noqa: E402

SAMPLES = 100000
CHUNK = 20000  # queries that go down the tree together
FIRST = 4  # triangles by their centres, for a first bound


@dataclass(frozen=True)
class Accuracy:
    """Per cent of the truth's diagonal; `normals` has no unit."""

    to_truth: float  # mean distance of the surface's samples to the truth
    to_surface: float  # and of the truth's samples to the surface
    chamfer: float
    hausdorff99: float
    normals: float


def point_triangle(p, a, b, c):
    """Distances of the points p to the triangles (a, b, c), all (n, 3)."""
    def to_segment(u, v):
        along = v - u
        part = np.einsum("ij,ij->i", p - u, along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
        return np.linalg.norm(p - u - np.clip(part, 0, 1)[:, None] * along, axis=1)

    normal = np.cross(b - a, c - a)
    square = np.einsum("ij,ij->i", normal, normal)
    above = np.ones(len(p), bool)  # whether the foot on the plane lies inside all three edges
    for u, v in ((a, b), (b, c), (c, a)):
        above &= np.einsum("ij,ij->i", np.cross(v - u, p - u), normal) >= 0
    flat = np.abs(np.einsum("ij,ij->i", p - a, normal)) / np.sqrt(np.maximum(square, 1e-300))
    edges = np.minimum(np.minimum(to_segment(a, b), to_segment(b, c)), to_segment(c, a))
    return np.where(above & (square > 0), flat, edges)


class Triangles:
    """A mesh in a tree of boxes that halves its triangles, level by level, across the longest side."""

    def __init__(self, points, faces):
        corners = points[faces]
        self.corners = corners
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.normals = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        centres = corners.mean(axis=1)
        self.centres = cKDTree(centres)
        self.depth = max(0, int(np.ceil(np.log2(len(faces)))))
        leaves = 1 << self.depth
        # Some leaves share a triangle, so that all levels are full.
        order = np.arange(leaves) * len(faces) // leaves
        for level in range(self.depth):
            groups = order.reshape(1 << level, -1)
            spread = np.ptp(centres[groups], axis=1).argmax(axis=1)
            key = np.take_along_axis(centres[groups], spread[:, None, None], axis=2)[:, :, 0]
            order = np.take_along_axis(groups, key.argsort(axis=1, kind="stable"), axis=1).ravel()
        self.leaf = order
        self.low, self.high = [corners[order].min(axis=1)], [corners[order].max(axis=1)]
        for _ in range(self.depth):
            self.low.insert(0, self.low[0].reshape(-1, 2, 3).min(axis=1))
            self.high.insert(0, self.high[0].reshape(-1, 2, 3).max(axis=1))

    def distance(self, p, triangle):
        return point_triangle(p, *(self.corners[triangle, i] for i in range(3)))

    def _near(self, p):
        best, which = np.full(len(p), np.inf), np.zeros(len(p), np.int64)

        def offer(query, triangle):
            found = self.distance(p[query], triangle)
            order = np.lexsort((triangle, found, query))
            first = np.concatenate([[True], np.diff(query[order]) != 0]) if len(order) else np.zeros(0, bool)
            query, triangle, found = query[order][first], triangle[order][first], found[order][first]
            closer = found < best[query]
            best[query[closer]], which[query[closer]] = found[closer], triangle[closer]

        count = min(FIRST, len(self.corners))
        offer(np.repeat(np.arange(len(p)), count), self.centres.query(p, count)[1].reshape(-1).astype(np.int64))
        query, node = np.arange(len(p)), np.zeros(len(p), np.int64)
        for level in range(self.depth + 1):
            gap = np.maximum(np.maximum(self.low[level][node] - p[query], p[query] - self.high[level][node]), 0)
            keep = np.linalg.norm(gap, axis=1) < best[query]
            query, node = query[keep], node[keep]
            if level < self.depth:
                query, node = np.repeat(query, 2), np.stack([2 * node, 2 * node + 1], axis=1).ravel()
        offer(query, self.leaf[node])
        return best, which

    def nearest(self, p):
        """Distance (n) of each point to the mesh and the triangle (n) that is nearest."""
        parts = [self._near(p[i:i + CHUNK]) for i in range(0, len(p), CHUNK)]
        return np.concatenate([d for d, _ in parts]), np.concatenate([t for _, t in parts])


def measure(surface, truth, samples=SAMPLES, seed=1):
    """Accuracy of a surface; both are (points, faces)."""
    rng = np.random.default_rng(seed)
    used = truth[0][np.unique(truth[1])]
    unit = 100 / np.linalg.norm(np.ptp(used, axis=0))
    means, tails, cosines = [], [], []
    for one, other in ((surface, truth), (truth, surface)):
        places, normals = sample(*one, samples, rng)
        tree = Triangles(*other)
        distance, triangle = tree.nearest(places)
        means.append(unit * distance.mean())
        tails.append(unit * np.quantile(distance, 0.99))
        cosines.append(np.abs((normals * tree.normals[triangle]).sum(axis=1)).mean())
    return Accuracy(means[0], means[1], sum(means) / 2, max(tails), sum(cosines) / 2)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("surface")
    parser.add_argument("truth")
    parser.add_argument("--samples", type=int, default=SAMPLES)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    found = measure(read_mesh(options.surface), read_mesh(options.truth), options.samples, options.seed)
    print(f"chamfer {found.chamfer:.5g} % (to truth {found.to_truth:.5g}, to surface {found.to_surface:.5g}), "
          f"hausdorff99 {found.hausdorff99:.5g} %, normals {found.normals:.5f}")


if __name__ == "__main__":
    main()
