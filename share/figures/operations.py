"""Figures of the local operations (method.md, section 4)."""
import math

from canvas import BLUE, INK, LABELS, RED, SOFT, Canvas, plane, regular_polygon
from geometry import (View, add, area, blend, cross, delaunay, dot, interface, mean, neighbours, norm, positive, quality, sides, sub,
                      unit)

FILL = "#f3d9b0"


def triangulations(n):
    """All triangulations of a convex n-gon, as lists of corners i < j < k."""
    def chain(i, j):
        if j - i < 2:
            return [[]]
        return [left + right + [(i, k, j)] for k in range(i + 1, j) for left in chain(i, k) for right in chain(k, j)]
    return chain(0, n - 1)


def arrow(sheet, x, y, above="", below="", half=26, both=False):
    sheet.arrow([(x - half, y), (x + half, y)], INK)
    if both:
        sheet.arrow([(x, y), (x - half, y)], INK)
    sheet.text((x, y - 12), above, "c s")
    if below:
        sheet.text((x, y + 24), below, "c s")


def shape(a, b, c):
    """Quality of a triangle: 1 if it is equilateral."""
    return 4 * math.sqrt(3) * area(a, b, c) / sum(dot(sub(p, q), sub(p, q)) for p, q in ((a, b), (b, c), (c, a)))


# ---- inside one phase ---------------------------------------------------------------------------------------------------

def ring_quality(points, corners, choice):
    """Least quality of the tets that a triangulation of the ring makes with both ends of the edge; points 0 and 1 are the ends."""
    a, b = points[0], points[1]
    return min(min(quality(points[corners[i]], points[corners[j]], points[corners[k]], b),
                   quality(points[corners[j]], points[corners[i]], points[corners[k]], a)) for i, j, k in choice)


def old_ring_quality(points, corners):
    n = len(corners)
    return min(quality(points[0], points[1], points[corners[i]], points[corners[(i + 1) % n]]) for i in range(n))


def flips():
    sheet = Canvas(760, 470, "Face removal and edge removal")
    bipyramid = [(0.0, 0.0, -1.05), (0.0, 0.0, 1.05)] + [(*p, 0.0) for p in regular_polygon(3, 1.0, 0.5)]
    two = [positive(bipyramid, t) for t in ((0, 2, 3, 4), (1, 2, 3, 4))]
    three = [positive(bipyramid, t) for t in ((0, 1, 2, 3), (0, 1, 3, 4), (0, 1, 4, 2))]
    octahedron = [(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)] + [(*p, 0.0) for p in regular_polygon(4, 1.0, 0.25)]
    four = [positive(octahedron, (0, 1, 2 + i, 2 + (i + 1) % 4)) for i in range(4)]
    other = [positive(octahedron, (2 + i, 2 + j, 2 + k, end)) for i, j, k in triangulations(4)[0] for end in (0, 1)]
    for x, points, tets in ((88, bipyramid, two), (296, bipyramid, three), (468, octahedron, four), (682, octahedron, other)):
        view = View(14, 20, 74, (x, 124))
        sheet.tets(view, points, tets, [FILL] * len(tets), 0.2)
        if tets is three or tets is four:  # the edge that all of them share
            sheet.line([view(points[0]), view(points[1])], RED, 2.6, "6 4")
        sheet.text((x, 234), f"{len(tets)} tets", "c")
    arrow(sheet, 192, 118, "face removal", "edge removal", both=True)
    arrow(sheet, 575, 118, "edge removal", half=22)
    sheet.text((192, 28), "a face, or an edge with three tets", "c b")
    sheet.text((575, 28), "an edge with four tets", "c b")

    ring = [(0.83, 0.12), (0.13, 0.78), (-0.61, 0.59), (-0.57, -0.62), (0.26, -0.82)]
    points = [(-0.5, -0.33, -0.72), (-0.46, -0.33, 0.72)] + [(*p, z) for p, z in zip(ring, (0.05, -0.1, 0.08, 0.0, -0.06))]
    corners = list(range(2, 7))
    before = old_ring_quality(points, corners)
    choices = triangulations(5)
    found = [ring_quality(points, corners, choice) for choice in choices]
    best = max(range(5), key=lambda i: found[i])
    assert found[best] > before and len(choices) == 5
    sheet.text((380, 276), "an edge with five tets, seen along it: the best of five triangulations", "c b")
    for i in range(6):
        at = (66 + 125.6 * i, 352)
        view = plane(56, at)
        outline = [view(p) for p in ring]
        sheet.polygon(outline, "#fff7ea" if i and i - 1 == best else "#fff", INK, 1.6)
        if i == 0:
            centre = mean(points[:2])[:2]
            for p in ring:
                sheet.line([view(centre), view(p)], SOFT, 1.2)
            sheet.dot(view(centre), 5, RED)
            sheet.text((at[0], 430), "5 tets", "c")
            sheet.text((at[0], 450), f"least q {before:.2f}", "c s")
            continue
        for t in choices[i - 1]:
            for a, b in ((t[0], t[1]), (t[1], t[2]), (t[0], t[2])):
                if abs(a - b) not in (1, 4):
                    sheet.line([view(ring[a]), view(ring[b])], BLUE if i - 1 == best else SOFT, 2.6 if i - 1 == best else 1.2)
        sheet.text((at[0], 430), "6 tets", "c")
        value = found[i - 1]
        words = f"least q {value:.2f}" if value > 0 else "not positive"
        sheet.text((at[0], 450), words + (": best" if i - 1 == best else ""), "c s u b" if i - 1 == best else "c s")
    return sheet


def splits():
    sheet = Canvas(760, 480, "Splits, smoothing and the compound")
    octahedron = [(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)] + [(*p, 0.0) for p in regular_polygon(4, 1.0, 0.25)] + [(0.0, 0.0, 0.1)]
    four = [positive(octahedron, (0, 1, 2 + i, 2 + (i + 1) % 4)) for i in range(4)]
    eight = [positive(octahedron, [6 if v == end else v for v in t]) for t in four for end in (0, 1)]
    pair = [(0.0, 0.0, -1.05), (0.0, 0.0, 1.05)] + [(*p, 0.0) for p in regular_polygon(3, 1.0, 0.5)] + [(0.08, 0.05, 0.0)]
    two = [positive(pair, t) for t in ((0, 2, 3, 4), (1, 2, 3, 4))]
    six = [positive(pair, [5 if v == corner else v for v in t]) for t in two for corner in (2, 3, 4)]
    for x, points, tets in ((92, octahedron, four), (284, octahedron, eight), (476, pair, two), (668, pair, six)):
        sheet.tets(View(14, 20, 72, (x, 122)), points, tets, [FILL] * len(tets), 0.2)
        sheet.text((x, 228), f"{len(tets)} tets", "c")
    arrow(sheet, 188, 118, half=20)
    arrow(sheet, 572, 118, half=20)
    sheet.text((188, 28), "edge split", "c b")
    sheet.text((572, 28), "face split", "c b")
    sheet.text((126, 268), "vertex split", "c b")
    sheet.text((380, 268), "Laplacian smoothing", "c b")
    sheet.text((634, 268), "compound", "c b")
    for x, case in ((126, vertex_split), (380, smoothing), (634, compound)):
        for side, (points, triangles, marks, more) in zip((-62, 62), case()):
            view = plane(42, (x + side, 358))
            sheet.triangles(view, points, triangles, [FILL if t in more else "#fff" for t in triangles], INK)
            for v, name, colour in marks:
                sheet.dot(view(points[v]), 5, colour)
                sheet.text(add(view(points[v]), (8, -7)), name, "h s")
        arrow(sheet, x, 358, half=11)
    sheet.lines((126, 438), ["v' lies inside the group,", "0.3 shortest edges from v"], "c s")
    sheet.lines((380, 438), ["v goes to the mean", "of its neighbours"], "c s")
    sheet.lines((634, 438), ["v moves into the edge ab,", "which is split there"], "c s")
    return sheet


def fan(centre, rim):
    """Points and triangles of a star; the centre comes last."""
    n = len(rim)
    return [*rim, centre], [(i, (i + 1) % n, n) for i in range(n)]


def vertex_split():
    points, triangles = fan((0.0, 0.0), [(1.0, 0.15), (0.75, 0.7), (0.1, 0.98), (-0.6, 0.8), (-1.0, 0.1), (-0.75, -0.7), (0.05, -1.0), (0.8, -0.6)])
    v, w = points[8], points[1]
    group = [t for t in triangles if dot(sub(mean(points[i] for i in t), v), sub(w, v)) > 0]
    edges = sides(group)
    rim = [next(i for i in edge if i != 8) for edge, own in edges.items() if 8 in edge and len(own) == 1]
    inside = mean(points[i] for t in group for i in t)

    def inward(i):
        d = unit(sub(points[i], v))
        n = (-d[1], d[0])
        return n if dot(n, sub(inside, v)) > 0 else (-n[0], -n[1])

    normals = [inward(i) for i in rim]
    direction = max([unit(add(*normals)), *normals], key=lambda d: min(dot(n, d) for n in normals))
    t = 0.3 * min(norm(sub(points[i], v)) for tri in group for i in tri if i != 8)
    after = [*points, add(v, direction, t)]
    moved = [tuple(9 if i == 8 else i for i in tri) if tri in group else tri for tri in triangles]
    new = [(8, i, 9) if area(after[8], after[i], after[9]) > 0 else (i, 8, 9) for i in rim]
    assert all(area(*(after[i] for i in tri)) > 0 for tri in moved + new)
    return (points, triangles, [(8, "v", RED)], group), (after, moved + new, [(8, "v", RED), (9, "v'", BLUE)], new)


def smoothing():
    points, triangles = fan((0.5, -0.38), [(0.95, 0.2), (0.45, 0.88), (-0.35, 0.95), (-0.95, 0.3), (-0.85, -0.6), (0.1, -0.98), (0.85, -0.62)])
    after = [*points[:7], mean(points[:7])]
    assert min(shape(*(after[i] for i in t)) for t in triangles) > min(shape(*(points[i] for i in t)) for t in triangles)
    return (points, triangles, [(7, "v", RED)], []), (after, triangles, [(7, "v", RED)], [])


def compound():
    points = [(-0.95, -0.05), (0.95, 0.0), (0.0, -1.0), (0.05, 0.12), (-0.75, 0.85), (0.7, 0.9)]
    triangles = [(0, 2, 1), (0, 1, 3), (0, 3, 4), (3, 5, 4), (1, 5, 3)]
    a, b, v = points[0], points[1], points[3]
    s = dot(sub(v, a), sub(b, a)) / dot(sub(b, a), sub(b, a))
    assert 0.05 < s < 0.95 and all(area(*(points[i] for i in t)) > 0 for t in triangles)
    after = [*points[:3], blend(a, b, s), *points[4:]]
    kept = [(0, 2, 3), (2, 1, 3), *triangles[2:]]
    assert all(area(*(after[i] for i in t)) > 0 for t in kept)
    ends = [(0, "a", INK), (1, "b", INK)]
    return (points, triangles, [*ends, (3, "v", RED)], [(0, 1, 3)]), (after, kept, [*ends, (3, "v", RED)], [])


# ---- with the interface -------------------------------------------------------------------------------------------------

def interface_edits():
    sheet = Canvas(760, 520, "Edits of the interface")
    flip(sheet)
    relabel(sheet)
    collapse(sheet)
    neck(sheet)
    return sheet


def flip(sheet):
    ring = [(1.0, 0.02), (0.45, 0.88), (-0.6, 0.8), (-1.0, 0.0), (-0.5, -0.9), (0.55, -0.8)]
    points = [(0.06, 0.0, -0.8), (0.0, 0.03, 0.8)] + [(*p, z) for p, z in zip(ring, (0.0, 0.06, -0.05, 0.04, 0.0, -0.08))]
    faces = [unit(cross(sub(points[1], points[0]), sub(points[2], points[0]))), unit(cross(sub(points[0], points[1]), sub(points[5], points[1])))]
    assert dot(*faces) > 0.995  # the two faces of the interface are flat to each other
    sheet.text((190, 28), "interface flip, seen along the edge", "c b")
    halves = [([2, 3, 4, 5], 0), ([5, 6, 7, 2], 1)]
    centre = mean(points[:2])[:2]
    for k, x in enumerate((94, 286)):
        view = plane(74, (x, 122))
        for corners, label in halves:
            sheet.polygon([view(points[v][:2]) for v in corners] + ([view(centre)] if k == 0 else []), LABELS[label], INK, 1.4)
            if k == 0:
                for v in corners:
                    sheet.line([view(centre), view(points[v][:2])], SOFT, 1.2)
            else:
                best = max(triangulations(4), key=lambda choice: ring_quality(points, corners, choice))
                i, j = next((a, b) for t in best for a, b in ((t[0], t[1]), (t[1], t[2]), (t[0], t[2])) if abs(a - b) == 2)
                sheet.line([view(points[corners[i]][:2]), view(points[corners[j]][:2])], BLUE, 2)
        sheet.line([view(points[2][:2]), *([view(centre)] if k == 0 else []), view(points[5][:2])], INK, 3.4)
        if k == 0:
            sheet.dot(view(centre), 5, RED)
            sheet.text(add(view(centre), (0, -12)), "ab", "h c s")
        sheet.text(add(view(points[2][:2]), (-14, -8)), "p", "h s")
        sheet.text(add(view(points[5][:2]), (8, -8)), "q", "h s")
    arrow(sheet, 190, 122, half=10)
    sheet.lines((190, 226), ["The interface changes its diagonal from ab to pq;", "each label's polygon is triangulated."], "c s")


def relabel(sheet):
    plan = [(0.9 * i + (0.45 if j % 2 else 0.0), 0.78 * j + (0.05 * ((2 * i + j) % 3 - 1) if 0 < j < 3 else 0.0)) for j in range(4) for i in range(4 - j % 2)]
    triangles = delaunay(plan)
    labels = [1 if mean(plan[v] for v in t)[1] < 1.0 else 0 for t in triangles]
    poking = max((t for t in range(len(triangles)) if labels[t] == 0),
                 key=lambda t: sum(1 for edge in interface(triangles, labels) if set(edge) <= set(triangles[t])))
    # A tooth of label 1 for the relabel to remove.
    labels[poking] = 1
    sheet.text((570, 28), "relabel, in a cut", "c b")
    for k, x in enumerate((402, 594)):
        view = plane(54, (x, 196))
        if k == 1:
            labels = [0 if t == poking else label for t, label in enumerate(labels)]
        sheet.triangles(view, plan, triangles, labels)
        sheet.segments(view, plan, interface(triangles, labels), INK, 3)
        sheet.polygon([view(plan[v]) for v in triangles[poking]], "none", RED, 2.2, stroke_dasharray="4 3")
    arrow(sheet, 572, 122, half=9)
    sheet.lines((570, 226), ["A tet takes the label of its neighbours;", "no vertex moves."], "c s")


def collapse(sheet):
    plan = [(0.42, 0.06), (-0.42, -0.04), (0.05, 0.95), (-0.02, -0.95), (1.2, 0.75), (1.35, -0.15), (0.95, -0.95), (-1.1, 0.85), (-1.4, 0.0),
            (-1.05, -0.9)]
    triangles = delaunay(plan)
    common = sorted(set(neighbours(triangles, 0)) & set(neighbours(triangles, 1)))
    assert len(common) == 2 and len(neighbours(triangles, 0)) + len(neighbours(triangles, 1)) >= 7
    sheet.text((190, 290), "collapse of ab, the interface from above", "c b")
    after = [blend(plan[0], plan[1], 0.5), *plan[1:]]
    kept = [tuple(0 if v == 1 else v for v in t) for t in triangles if not {0, 1} <= set(t)]
    assert all(area(*(after[v] for v in t)) > 0 for t in kept)
    for x, points, tris in ((94, plan, triangles), (286, after, kept)):
        view = plane(58, (x, 388))
        sheet.triangles(view, points, tris, [LABELS[1]] * len(tris), INK)
        names = [(0, "a", RED), (1, "b", RED)] if tris is triangles else [(0, "a", RED)]
        if tris is triangles:
            sheet.line([view(points[0]), view(points[1])], RED, 3)
        for v, name, colour in [*names, *((v, "cd"[i], BLUE) for i, v in enumerate(common))]:
            sheet.dot(view(points[v]), 5, colour)
            sheet.text(add(view(points[v]), (7, -8)), name, "h s")
    arrow(sheet, 190, 388, half=9)
    sheet.lines((190, 478), [f"a and b have {len(common)} common neighbours, c and d:", "the link condition holds, the topology is safe."], "c s")


def neck(sheet):
    """A neck of three sides. The edge ab belongs to its narrowest ring."""
    rings = [[(r * x, r * y, z) for x, y in regular_polygon(3, 1.0, math.radians(-60))] for z, r in ((-1.5, 1.25), (0.0, 0.62), (1.5, 1.25))]
    points = [p for ring in rings for p in ring]
    triangles = []
    for low in (0, 3):
        for i in range(3):
            j = (i + 1) % 3
            triangles += [(low + i, low + j, low + 3 + i), (low + j, low + 3 + j, low + 3 + i)]
    a, b, c = 3, 4, 5
    common = set(neighbours(triangles, a)) & set(neighbours(triangles, b))
    assert len(common) == 3 and c in common
    merged = [tuple(a if v == b else v for v in t) for t in triangles if not {a, b} <= set(t)]
    assert len(sides(merged)[tuple(sorted((a, c)))]) == 4  # after the collapse four faces meet at an edge
    view = View(0, 14, 43, (570, 384))
    sheet.text((570, 290), "no collapse of ab: a neck of three sides", "c b")
    order = sorted(triangles, key=lambda t: view.depth(mean(points[v] for v in t)))
    for t in order:
        p, q, r = (points[v] for v in t)
        front = dot(cross(sub(q, p), sub(r, p)), view.eye) > 0
        sheet.polygon([view(points[v]) for v in t], LABELS[1] if front else "#d9a565", INK, 1.2)
    for v in (a, b):
        sheet.line([view(points[v]), view(points[c])], BLUE, 2, "4 3")
    sheet.line([view(points[a]), view(points[b])], RED, 3.4)
    names = {a: "a", b: "b", c: "e", **{v: "cd"[i] for i, v in enumerate(sorted(common - {c}))}}
    for v, name in names.items():
        sheet.dot(view(points[v]), 5, RED if v in (a, b) else BLUE)
        left = v == a
        sheet.text(add(view(points[v]), (-14, -8) if left else (8, -8)), name, "h s")
    sheet.lines((570, 478), [f"a and b have {len(common)} common neighbours, c, d, e;", "the vertex would be irregular: refused."], "c s")
