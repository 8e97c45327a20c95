"""Marching tetrahedra over the cubes that a surface passes through, with every vertex found on the surface itself."""

import itertools

import packages  # noqa: F401
import numpy as np

BLOCK = 8  # cells along an edge of the blocks that are skipped where the surface is far
OFFSET = np.array([0.3819660112501051, 0.4142135623730951, 0.2360679774997897])  # no node falls onto a flat face of a shape
CORNERS = np.array(list(itertools.product((0, 1), repeat=3)))


def _kuhn_tets():
    """Six positively oriented tets of a cube, as corners' numbers; they fit those of the neighbouring cubes."""
    tets = []
    for path in itertools.permutations(range(3)):
        corners = np.zeros((4, 3), int)
        for k, axis in enumerate(path):
            corners[k + 1:, axis] = 1
        ids = (corners @ np.array([4, 2, 1])).tolist()
        if np.linalg.det((corners[1:] - corners[0]).astype(float)) < 0:
            ids[2], ids[3] = ids[3], ids[2]
        tets.append(ids)
    return np.array(tets)


def _even_order(chosen):
    """An even permutation of 0..3 that begins with the chosen ones."""
    for order in itertools.permutations(range(4)):
        odd = sum(order[i] > order[j] for i in range(4) for j in range(i + 1, 4)) % 2
        if not odd and set(order[:len(chosen)]) == set(chosen):
            return order
    raise AssertionError(chosen)


def _cases():
    """For each set of inside corners (bits) the triangles, as edges (inside corner, outside corner), outward."""
    table = {}
    for bits in range(1, 15):
        inside = [i for i in range(4) if bits >> i & 1]
        outside = [i for i in range(4) if not bits >> i & 1]
        if len(inside) == 1:
            a, b, c, d = _even_order(inside)
            table[bits] = [((a, b), (a, c), (a, d))]
        elif len(inside) == 3:
            a, b, c, d = _even_order(outside)
            table[bits] = [((b, a), (d, a), (c, a))]
        else:
            a, b, c, d = _even_order(inside)
            table[bits] = [((a, c), (a, d), (b, d)), ((a, c), (b, d), (b, c))]
    return table


TETS = _kuhn_tets()
CASES = _cases()


def _on_surface(field, inside, outside):
    """The field's zero on the segments between points inside and points outside, by halving."""
    low, high = np.zeros(len(inside)), np.ones(len(inside))
    for _ in range(12):
        middle = (low + high) / 2
        within = field(inside + middle[:, None] * (outside - inside)) < 0
        low, high = np.where(within, middle, low), np.where(within, high, middle)
    return inside + ((low + high) / 2)[:, None] * (outside - inside)


def _near_cells(field, origin, shape, cell):
    """Lowest corners (k, 3) of the cells in the blocks that the surface may reach, and the field at the 8 corners."""
    blocks = -(-shape // BLOCK)
    at = np.stack(np.meshgrid(*(np.arange(b) for b in blocks), indexing="ij"), axis=-1).reshape(-1, 3)
    half = np.sqrt(3) * BLOCK * cell / 2
    at = at[np.abs(field(origin + cell * BLOCK * (at + 0.5))) <= half * 1.01]
    nodes = np.stack(np.meshgrid(*[np.arange(BLOCK + 1)] * 3, indexing="ij"), axis=-1)
    corners, values = [], []
    for some in np.array_split(at, max(1, len(at) // 500)):
        grid = BLOCK * some[:, None, None, None, :] + nodes
        f = field(origin + cell * grid.reshape(-1, 3)).reshape(grid.shape[:-1])
        eight = np.stack([f[:, i:BLOCK + i, j:BLOCK + j, k:BLOCK + k] for i, j, k in CORNERS], axis=-1)
        mixed = (eight < 0).any(axis=-1) & (eight >= 0).any(axis=-1)
        corners.append(grid[:, :BLOCK, :BLOCK, :BLOCK][mixed])
        values.append(eight[mixed])
    return np.concatenate(corners), np.concatenate(values)


def surface_mesh(field, low, high, cell):
    """Points and outward triangles of {field = 0}, which is negative inside and changes by at most the distance walked.

    `low`, `high` are corners of a box around the surface, `cell` is the edge of the cubes.
    """
    origin = np.asarray(low, float) - cell * (1 + OFFSET)
    shape = np.ceil((np.asarray(high) - origin) / cell).astype(np.int64) + 2
    corner, values = _near_cells(field, origin, shape, cell)
    size = (-(-shape // BLOCK)) * BLOCK + 1
    ids = (corner[:, None, :] + CORNERS) @ np.array([size[1] * size[2], size[2], 1])
    tets, signs = ids[:, TETS].reshape(-1, 4), values[:, TETS].reshape(-1, 4) < 0
    bits = signs @ np.array([1, 2, 4, 8])
    ends = []
    for case, triangles in CASES.items():
        chosen = tets[bits == case]
        ends += [chosen[:, np.array(t)] for t in triangles]
    ends = np.concatenate(ends).reshape(-1, 2)
    nodes, packed = np.unique(ends, return_inverse=True)
    packed = packed.reshape(-1, 2)
    edges, vertex = np.unique(packed[:, 0] * len(nodes) + packed[:, 1], return_inverse=True)
    where = origin + cell * np.stack(np.unravel_index(nodes, size), axis=-1)
    points = _on_surface(field, where[edges // len(nodes)], where[edges % len(nodes)])
    return points, vertex.reshape(-1, 3)
