#!/usr/bin/env python3
"""How much of the creases of a true surface a reconstruction has as edges.

    creases.py SURFACE TRUTH [--dihedral DEGREES] [--within MEAN_EDGES] [--angle DEGREES] [--require SHARE]

The creases are the edges of TRUTH whose two faces turn by more than --dihedral. Each is sampled; a sample counts as found where an edge
of SURFACE passes within --within mean edges of SURFACE and differs from the crease's direction by at most --angle. Prints the length of
the creases and the share that is found. Exits 1 below --require.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "topology"))
import packages  # noqa: F401,E402
import numpy as np  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402
from surfaces import read_mesh  # noqa: E402


def merged(points, faces):
    """The same with equal points made one, so that faces of files without shared points are neighbours."""
    unique, index = np.unique(points, axis=0, return_inverse=True)
    return unique, index.reshape(-1)[faces]


def edges_with_faces(faces):
    """Edges (n, 2) with exactly two faces, and the faces (n, 2)."""
    pairs = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    owner = np.tile(np.arange(len(faces)), 3)
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    pairs, owner = pairs[order], owner[order]
    first = np.concatenate([[True], (pairs[1:] != pairs[:-1]).any(axis=1)])
    start = np.flatnonzero(first)
    count = np.diff(np.append(start, len(pairs)))
    two = start[count == 2]
    return pairs[two], np.stack([owner[two], owner[two + 1]], axis=1)


def crease_edges(points, faces, dihedral):
    """Ends (n, 2, 3) of the edges whose faces turn by more than `dihedral` radians."""
    points, faces = merged(points, faces)
    normals = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    edges, sides = edges_with_faces(faces)
    turn = np.arccos(np.clip((normals[sides[:, 0]] * normals[sides[:, 1]]).sum(axis=1), -1, 1))
    return points[edges[turn > dihedral]]


def samples_along(ends, step):
    """Places (n, 3) along the edges, at most `step` apart, their unit directions and the lengths for which they stand."""
    vectors = ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(vectors, axis=1)
    counts = np.maximum(1, np.ceil(lengths / step)).astype(int)
    edge = np.repeat(np.arange(len(ends)), counts)
    number = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    places = ends[edge, 0] + vectors[edge] * ((number + 0.5) / counts[edge])[:, None]
    return places, (vectors / np.maximum(lengths, 1e-300)[:, None])[edge], (lengths / counts)[edge]


def found_share(surface, truth, dihedral, within, angle):
    """Length of the creases of `truth` and the share of it along which `surface` has an edge. Both are (points, faces)."""
    points, faces = surface
    edges = np.unique(np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1), axis=0)
    ends = points[edges]
    mean = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean()
    creases = crease_edges(*truth, dihedral)
    if len(creases) == 0:
        return 0.0, 1.0
    places, directions, lengths = samples_along(creases, 0.25 * mean)
    # Places along the surface's edges stand for them: an edge that passes within the bound has one within `reach`.
    gap = 0.25 * mean
    along, along_directions, _ = samples_along(ends, gap)
    edge_of = np.repeat(np.arange(len(ends)), np.maximum(1, np.ceil(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) / gap)).astype(int))
    near = cKDTree(along).query_ball_point(places, within * mean + 0.5 * gap)
    found = np.zeros(len(places), bool)
    for i, candidates in enumerate(near):
        for c in candidates:
            a, b = ends[edge_of[c]]
            part = np.clip(np.dot(places[i] - a, b - a) / max(np.dot(b - a, b - a), 1e-300), 0, 1)
            close = np.linalg.norm(a + part * (b - a) - places[i]) <= within * mean
            if close and abs(np.dot(along_directions[c], directions[i])) >= np.cos(angle):
                found[i] = True
                break
    return lengths.sum(), (lengths * found).sum() / lengths.sum()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("surface")
    parser.add_argument("truth")
    parser.add_argument("--dihedral", type=float, default=40.0)
    parser.add_argument("--within", type=float, default=0.1)
    parser.add_argument("--angle", type=float, default=10.0)
    parser.add_argument("--require", type=float, default=0.0)
    options = parser.parse_args()
    length, share = found_share(read_mesh(options.surface), read_mesh(options.truth), np.radians(options.dihedral), options.within,
                                np.radians(options.angle))
    print(f"creases {length:.4g}, found {100 * share:.2f} %")
    sys.exit(0 if share >= options.require else 1)


if __name__ == "__main__":
    main()
