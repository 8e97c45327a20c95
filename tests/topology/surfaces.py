"""Triangle meshes: reading, writing clouds, sampling, and a count of the topology that owes nothing to dsc."""

from dataclasses import dataclass
from pathlib import Path

import packages  # noqa: F401
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


@dataclass(frozen=True)
class Topology:
    """What a closed surface encloses. Genus is the sum over all shells, those of cavities included."""

    components: int  # shells of positive volume
    cavities: int  # shells of negative volume
    genus: int
    closed: bool = True  # every edge has two faces, which run through it in opposite directions
    manifold: bool = True  # and the faces around every vertex form one ring

    def __str__(self):
        faults = ("" if self.closed else " open") + ("" if self.manifold else " non-manifold")
        return f"c{self.components} v{self.cavities} g{self.genus}{faults}"


def read_mesh(path):
    """Points (n, 3) and triangles (m, 3) of a .obj or .off file."""
    text = Path(path).read_text(encoding="utf-8", errors="replace")
    points, faces = [], []
    if str(path).endswith(".off"):
        words = text.split()
        count, many = int(words[1]), int(words[2])
        points = np.array(words[4:4 + 3 * count], float).reshape(-1, 3)
        at = 4 + 3 * count
        for _ in range(many):
            size = int(words[at])
            ring = [int(w) for w in words[at + 1:at + 1 + size]]
            faces += [(ring[0], ring[i], ring[i + 1]) for i in range(1, size - 1)]
            at += size + 1
    else:
        for line in text.splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                points.append([float(w) for w in words[1:4]])
            elif words[:1] == ["f"]:
                ring = [int(w.split("/")[0]) for w in words[1:]]
                ring = [i - 1 if i > 0 else len(points) + i for i in ring]
                faces += [(ring[0], ring[i], ring[i + 1]) for i in range(1, len(ring) - 1)]
    return np.asarray(points, float).reshape(-1, 3), np.asarray(faces, np.int64).reshape(-1, 3)


def read_cloud(path):
    """Points (n, 3) of a .obj file."""
    return read_mesh(path)[0]


def write_cloud(path, points):
    """As .obj, with every digit."""
    with open(path, "w", encoding="utf-8") as out:
        out.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())


def _groups(count, a, b):
    """Number of the connected groups of `count` things that the pairs a[i], b[i] join, and the group of each."""
    return connected_components(coo_matrix((np.ones(len(a), np.int8), (a, b)), (count, count)), directed=False)


def shell_volumes(points, faces, shell, shells):
    """Signed, about the middle of the points, which keeps the digits of a surface far from the origin."""
    a, b, c = (points[faces[:, i]] - points.mean(axis=0) for i in range(3))
    return np.bincount(shell, np.einsum("ij,ij->i", a, np.cross(b, c)) / 6, shells)


def topology(points, faces):
    """Counts by V - E + F of each shell, with a vertex counted once per ring of faces around it."""
    if len(faces) == 0:
        return Topology(0, 0, 0)
    n = len(faces)
    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    corner = np.arange(3 * n)
    next_corner = 3 * (corner // 3) + (corner + 1) % 3
    low, high = np.minimum(start, end), np.maximum(start, end)
    at_low = np.where(start == low, corner, next_corner)
    at_high = np.where(start == low, next_corner, corner)
    order = np.lexsort((high, low))
    new = np.ones(3 * n, bool)
    new[1:] = (np.diff(low[order]) != 0) | (np.diff(high[order]) != 0)
    first = np.flatnonzero(new)
    uses = np.diff(np.append(first, 3 * n))
    h, twin = order[first[uses == 2]], order[first[uses == 2] + 1]
    opposite = start[h] == end[twin]
    shells, shell = _groups(n, h // 3, twin // 3)
    rings, ring = _groups(3 * n, np.concatenate([at_low[h], at_high[h]]), np.concatenate([at_low[twin], at_high[twin]]))
    ring_shell = np.zeros(rings, np.int64)
    ring_shell[ring] = shell[corner // 3]
    euler = (np.bincount(ring_shell, minlength=shells) - np.bincount(shell[order[first] // 3], minlength=shells)
             + np.bincount(shell, minlength=shells))
    volume = shell_volumes(points, faces, shell, shells)
    closed = bool((uses == 2).all() and opposite.all())
    return Topology(int((volume > 0).sum()), int((volume < 0).sum()), int(((2 - euler) // 2).sum()), closed,
                    closed and rings == len(np.unique(faces)))


def area_of(points, faces):
    """Of the whole mesh."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def sample(points, faces, count, rng):
    """`count` points, uniform by area, and the unit normals of their faces, both (count, 3)."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    twice = np.linalg.norm(normal, axis=1)
    total = np.cumsum(twice)
    face = np.minimum(np.searchsorted(total, rng.random(count) * total[-1], side="right"), len(faces) - 1)
    root, part = np.sqrt(rng.random(count))[:, None], rng.random(count)[:, None]
    where = (1 - root) * a[face] + root * (1 - part) * b[face] + root * part * c[face]
    return where, normal[face] / twice[face][:, None]


def random_rotation(rng):
    """A proper rotation matrix, uniform over all of them."""
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else q[:, [1, 0, 2]]
