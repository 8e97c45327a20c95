"""Small meshes in the plane and in space, computed for the figures of share/doc/method.md."""
import math
from itertools import combinations, permutations

FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # of a tet, as in core/include/dsc/mesh/complex.hpp


def add(a, b, s=1.0):
    return tuple(x + s * y for x, y in zip(a, b))


def sub(a, b):
    return add(a, b, -1.0)


def mean(points):
    points = list(points)
    return tuple(sum(p[k] for p in points) / len(points) for k in range(len(points[0])))


def blend(a, b, s):
    return tuple((1 - s) * x + s * y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return tuple(x / norm(a) for x in a)


# ---- the plane ----------------------------------------------------------------------------------------------------------

def area(a, b, c):
    """Signed area of a triangle; positive if it runs counter-clockwise."""
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def in_circle(a, b, c, p):
    """Whether p lies inside the circle through a, b and c, which run counter-clockwise."""
    rows = [(x[0] - p[0], x[1] - p[1], (x[0] - p[0]) ** 2 + (x[1] - p[1]) ** 2) for x in (a, b, c)]
    return dot(rows[0], cross(rows[1], rows[2])) > 0


def delaunay(points):
    """Triangles of the Delaunay triangulation, by inserting one point after the other [Bowyer; Watson]."""
    n = len(points)
    far = [(-1e3, -1e3), (1e3, -1e3), (0.0, 1e3)]
    place = list(points) + far
    triangles = [(n, n + 1, n + 2)]
    for i, p in enumerate(points):
        bad = [t for t in triangles if in_circle(*(place[v] for v in t), p)]
        sides = [(t[k], t[(k + 1) % 3]) for t in bad for k in range(3)]
        triangles = [t for t in triangles if t not in bad]
        triangles += [(a, b, i) for a, b in sides if (b, a) not in sides]
    return [t for t in triangles if max(t) < n]


def neighbours(triangles, v):
    """The other vertices of the triangles at v."""
    return sorted({w for t in triangles if v in t for w in t} - {v})


def sides(triangles):
    """{edge: its triangles}."""
    found = {}
    for i, t in enumerate(triangles):
        for k in range(3):
            found.setdefault(tuple(sorted((t[k], t[(k + 1) % 3]))), []).append(i)
    return found


def interface(triangles, labels):
    """Edges between triangles of different labels."""
    return [edge for edge, pair in sides(triangles).items() if len(pair) == 2 and labels[pair[0]] != labels[pair[1]]]


def groups(cells, joined):
    """Number of connected groups of `cells`, where joined(a, b) says whether two cells are next to each other."""
    left, count = list(cells), 0
    while left:
        count += 1
        front = [left.pop()]
        while front:
            cell = front.pop()
            near = [other for other in left if joined(cell, other)]
            left = [other for other in left if other not in near]
            front += near
    return count


# ---- space --------------------------------------------------------------------------------------------------------------

def orient(a, b, c, d):
    """Six times the volume of the tet; positive as the kernel's orient3d."""
    return dot(cross(sub(b, a), sub(c, a)), sub(d, a))


def quality(a, b, c, d):
    """Volume-length measure: 6 sqrt(2) V / l_rms^3."""
    mean_square = sum(dot(sub(p, q), sub(p, q)) for p, q in combinations((a, b, c, d), 2)) / 6
    return math.sqrt(2) * orient(a, b, c, d) / mean_square ** 1.5


def positive(points, tet):
    """The tet with its vertices in positive order."""
    return tuple(tet) if orient(*(points[v] for v in tet)) > 0 else (tet[0], tet[1], tet[3], tet[2])


def adjacency(tets):
    """Per tet and face: (neighbour, its face), or None."""
    seen, result = {}, [[None] * 4 for _ in tets]
    for t, tet in enumerate(tets):
        for f, face in enumerate(FACES):
            key = frozenset(tet[k] for k in face)
            if key in seen:
                other = seen[key]
                result[t][f], result[other[0]][other[1]] = other, (t, f)
            seen[key] = (t, f)
    return result


class View:
    """Parallel projection of space onto the sheet; the eye looks from `azimuth` and `elevation` (degrees) at `centre`."""

    def __init__(self, azimuth, elevation, scale, at, centre=(0.0, 0.0, 0.0)):
        a, e = math.radians(azimuth), math.radians(elevation)
        self.eye = (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))
        self.right = (-math.sin(a), math.cos(a), 0.0)
        self.up = cross(self.eye, self.right)
        self.scale, self.at, self.centre = scale, at, centre

    def __call__(self, p):
        d = sub(p, self.centre)
        return (self.at[0] + self.scale * dot(d, self.right), self.at[1] - self.scale * dot(d, self.up))

    def depth(self, p):
        return dot(p, self.eye)


def back_to_front(points, tets, view):
    """Order in which the tets must be painted: of two tets at a face, the one on the far side of its plane comes first."""
    behind = {t: set() for t in range(len(tets))}
    for t, row in enumerate(adjacency(tets)):
        for f, other in enumerate(row):
            if other is None:
                continue
            a, b, c = (points[tets[t][k]] for k in FACES[f])
            towards = dot(cross(sub(b, a), sub(c, a)), view.eye)  # outward normal of tet t
            if towards > 0:
                behind[other[0]].add(t)
    order = []
    while len(order) < len(tets):
        ready = [t for t in behind if t not in order and behind[t] <= set(order)]
        order.append(min(ready, key=lambda t: view.depth(mean(points[v] for v in tets[t]))))
    return order


def ball_in_box(n, r, shift):
    """Points and tets of (2 n)^3 cubes round the origin, each divided into six tets along its diagonal. The cube of half-size r
    is deformed into a ball; each coordinate of the other inner points is moved by at most `shift`, so that the tets differ."""
    def moved(p):
        most = max(map(abs, p))
        if most in (0, n):
            return tuple(map(float, p))
        part = most / r if most <= r else (n - most) / (n - r)  # 1 on the ball, 0 at the origin and on the box
        factor = 1 - part + part * most / norm(p)
        spread = [(37 * p[0] + 17 * p[1] + 29 * p[2] + 13 * k * (p[k] + 3)) % 11 / 5 - 1 if most != r and p[0] != 0 else 0 for k in range(3)]
        return tuple(factor * x + shift * s for x, s in zip(p, spread))

    grid = [(i, j, k) for i in range(-n, n + 1) for j in range(-n, n + 1) for k in range(-n, n + 1)]
    number = {p: i for i, p in enumerate(grid)}
    points = [moved(p) for p in grid]
    tets = []
    for p in grid:
        if n in p:
            continue
        for order in permutations(range(3)):
            path = [p]
            for axis in order:
                path.append(tuple(x + (axis == m) for m, x in enumerate(path[-1])))
            tets.append(positive(points, [number[q] for q in path]))
    return points, tets, [mean(grid[v] for v in tet) for tet in tets]


def cut(points, tet, z):
    """The polygon in which the plane at height z cuts the tet, as points of the plane: none, three or four."""
    low = [v for v in tet if points[v][2] < z]
    high = [v for v in tet if points[v][2] >= z]
    corners = {}
    for a in low:
        for b in high:
            s = (z - points[a][2]) / (points[b][2] - points[a][2])
            corners[a, b] = blend(points[a], points[b], s)[:2]
    if len(corners) == 4:  # in the order round the quadrilateral
        (a, b), (c, d) = low, high
        return [corners[a, c], corners[a, d], corners[b, d], corners[b, c]]
    return list(corners.values())


def face_cut(points, face, z):
    """The segment in which the plane at height z cuts a triangle, or None."""
    ends = []
    for a, b in combinations(face, 2):
        if (points[a][2] < z) != (points[b][2] < z):
            s = (z - points[a][2]) / (points[b][2] - points[a][2])
            ends.append(blend(points[a], points[b], s)[:2])
    return ends if ends else None


def icosphere():
    """Points on the unit sphere and triangles: an icosahedron with each triangle divided into four."""
    g = (1 + math.sqrt(5)) / 2
    points = [unit(p) for p in [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
                                (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]]
    least = min(norm(sub(p, q)) for p, q in combinations(points, 2)) * 1.01
    near = {frozenset(e) for e in combinations(range(12), 2) if norm(sub(points[e[0]], points[e[1]])) < least}
    triangles, middle = [], {}
    for t in combinations(range(12), 3):
        if not all(frozenset(e) in near for e in combinations(t, 2)):
            continue
        for e in combinations(t, 2):
            if e not in middle:
                middle[e] = len(points)
                points.append(unit(mean((points[e[0]], points[e[1]]))))
        ab, ac, bc = (middle[e] for e in combinations(t, 2))
        triangles += [(t[0], ab, ac), (t[1], ab, bc), (t[2], ac, bc), (ab, ac, bc)]
    return points, triangles


def regular(star, labels, row_of):
    """Whether a vertex inside the box is regular (method.md, section 2); `row_of`: the neighbours of each tet."""
    def joined(s, t):
        return any(other is not None and other[0] == t for other in row_of[s])

    return all(groups([t for t in star if labels[t] == label], joined) == 1 and groups([t for t in star if labels[t] != label], joined) == 1
               for label in {labels[t] for t in star}) or len({labels[t] for t in star}) == 1
