"""Figures of the data model and its invariants (method.md, sections 1 and 2)."""
from canvas import BLUE, INK, LABELS, RED, SOFT, Canvas, plane
from geometry import (FACES, View, add, adjacency, ball_in_box, blend, cut, delaunay, dot, face_cut, groups, icosphere, interface, mean, norm, orient,
                      positive, quality, regular, sides, sub)


def complex_in_a_cut():
    """A lattice of tets with a ball and a further phase, cut by a plane; and the kinds of vertices of a triangulation."""
    sheet = Canvas(760, 430, "A labelled complex in a cut, and the kinds of its vertices")
    points, tets, places = ball_in_box(3, 2, 0.12)
    labels = [0 if max(map(abs, p)) > 2 else 2 if p[0] > 0 else 1 for p in places]
    height = 0.45
    rows = adjacency(tets)
    stars = {}
    for t, tet in enumerate(tets):
        assert orient(*(points[v] for v in tet)) > 0
        for v in tet:
            stars.setdefault(v, []).append(t)
    assert all(regular(star, labels, rows) for star in stars.values())
    view = plane(56, (190, 212))
    for which in range(3):
        outlines = [cut(points, tet, height) for tet, own in zip(tets, labels) if own == which]
        sheet.polygons([[view(p) for p in outline] for outline in outlines if outline], LABELS[which])
    faces = [[tets[t][k] for k in FACES[f]] for t, row in enumerate(rows) for f, other in enumerate(row)
             if other is not None and other[0] > t and labels[t] != labels[other[0]]]
    crossed = [segment for segment in (face_cut(points, face, height) for face in faces) if segment]
    sheet.strokes([[view(p) for p in segment] for segment in crossed], INK, 3)
    sheet.text(view((0, 3.2)), "tets, cut by a plane", "b c")
    sheet.text(view((-2.85, 2.6)), "label 0: outside", "h")
    sheet.text(view((-1, 0.1)), "label 1", "h c")
    sheet.text(view((1, 0.1)), "label 2", "h c")
    sheet.text(view((0, -3.45)), "thick: the interface", "s c")

    kinds = {"free": [], "movable": [], "junction": [], "box": []}
    plan = [(i + (0.5 if j % 2 else 0.0), 0.87 * j) for j in range(7) for i in range(7 - j % 2)]
    plan = [(x + 0.07 * ((3 * k) % 5 - 2), y + 0.07 * ((2 * k) % 5 - 2)) if 0 < y < 5.2 and 0.1 < x < 5.9 else (x, y)
            for k, (x, y) in enumerate(plan)]
    plan += [(0.0, 0.87 * j) for j in (1, 3, 5)] + [(6.0, 0.87 * j) for j in (1, 3, 5)]
    triangles = delaunay(plan)
    middle = (2.95, 2.6)

    def phase(t):
        p = mean(plan[v] for v in t)
        if norm(sub(p, middle)) > 1.75:
            return 0
        return 2 if p[0] > middle[0] + 0.3 else 1

    phases = [phase(t) for t in triangles]
    view = plane(54, (404, 342))
    sheet.triangles(view, plan, triangles, phases)
    sheet.segments(view, plan, interface(triangles, phases), INK, 3)
    rim = {v for edge, pair in sides(triangles).items() if len(pair) == 1 for v in edge}
    for v, p in enumerate(plan):
        seen = {which for t, which in zip(triangles, phases) if v in t}
        kind = "box" if v in rim else "free" if len(seen) == 1 else "movable" if len(seen) == 2 else "junction"
        kinds[kind].append(v)
        mark(sheet, view(p), kind)
    assert len(kinds["junction"]) == 2 and all(kinds.values())

    def joined(s, t):
        return len(set(triangles[s]) & set(triangles[t])) == 2

    for v in range(len(plan)):
        star = [t for t in range(len(triangles)) if v in triangles[t]]
        assert all(groups([t for t in star if phases[t] == which], joined) == 1 for which in {phases[t] for t in star})
    sheet.text(view((3.0, 5.5)), "kinds of vertices", "b c")
    for i, (kind, words) in enumerate([("movable", "movable: two labels"), ("junction", "junction: three labels"),
                                       ("free", "free: one label"), ("box", "on the box")]):
        at = (400 + 168 * (i % 2), 382 + 24 * (i // 2))
        mark(sheet, at, kind)
        sheet.text((at[0] + 12, at[1] + 5), words, "s")
    return sheet


def mark(sheet, at, kind):
    if kind == "movable":
        sheet.dot(at, 5.5, BLUE)
    elif kind == "junction":
        sheet.square(at, 6, RED, turned=True)
    elif kind == "free":
        sheet.dot(at, 3.2, "#fff", INK)
    else:
        sheet.square(at, 4, INK)


def arrays():
    """A cube of five tets, taken apart, and the arrays that describe it."""
    sheet = Canvas(760, 452, "The arrays of a complex of five tets")
    points = [(float(i), float(j), float(k)) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    tets = [positive(points, t) for t in [(0, 3, 5, 6), (0, 1, 3, 5), (0, 2, 3, 6), (0, 4, 5, 6), (3, 5, 6, 7)]]
    labels = [0, 0, 0, 0, 1]
    rows = adjacency(tets)
    view = View(-14, 16, 96, (182, 200), (0.5, 0.5, 0.5))
    placed = []
    for t, tet in enumerate(tets):
        shift = (0.0, 0.0, 0.0) if t == 0 else tuple(1.9 * x for x in sub(mean(points[v] for v in tet), (0.5, 0.5, 0.5)))
        placed.append({v: add(points[v], shift) for v in tet})
    order = sorted(range(5), key=lambda t: view.depth(mean(placed[t].values())))
    for t in order:
        corner = [placed[t][v] for v in tets[t]]
        sheet.tets(view, corner, [(0, 1, 2, 3)], ["#ffffff" if t == 0 else LABELS[labels[t]]])
    for t in order:
        middle = mean(placed[t].values())
        for v, p in placed[t].items():
            sheet.text(add(view(p), (0, 5), 1.0), str(v), "h c s")
        # T2 is behind T0, so its name lies where it is visible.
        place = blend(mean((placed[t][0], placed[t][3])), middle, 0.25) if t == 2 else middle
        sheet.text(add(view(place), (0, 6)), f"T{t}", "h c b")
    sheet.text((172, 398), "a cube of five tets, taken apart", "b c")
    sheet.text((172, 418), "(small numbers are vertices)", "s c")

    left, top = 372, 52
    columns = [left, left + 44, left + 122, left + 250, left + 300]
    sheet.text((left, 26), "per tet", "b")
    for x, name in zip(columns, ("tet", "v[4]", "n[4]", "label", "quality")):
        sheet.text((x, top), name, "s")
    sheet.line([(left, top + 8), (748, top + 8)], SOFT, 1)
    for t, tet in enumerate(tets):
        y = top + 28 + 22 * t
        if t == 1:
            sheet.box(left - 4, y - 16, 380, 22, "#fdf0d2", "none", 0, 3)
        codes = [" -" if other is None else f"{4 * other[0] + other[1]:2d}" for other in rows[t]]
        for x, words in zip(columns, (f"T{t}", " ".join(map(str, tet)), " ".join(codes), f"{labels[t]}",
                                      f"{quality(*(points[v] for v in tet)):.3f}")):
            sheet.text((x, y), words, "m")
    face = next(f for f, other in enumerate(rows[1]) if other is not None)
    code = 4 * rows[1][face][0] + rows[1][face][1]
    y = top + 28 + 22 * 5
    corners = ", ".join(str(tets[1][k]) for k in FACES[face])
    sheet.lines((left, y + 4), [f"T1: face {face}, opposite vertex {tets[1][face]}, has the vertices {corners}.",
                                f"n[{face}] = {code} = 4 x {code // 4} + {code % 4}: behind it is face {code % 4} of T{code // 4}.",
                                "A minus stands for none: a face on the box."], "s", 20)
    top = y + 92
    sheet.text((left, top - 24), "per vertex", "b")
    heads = ("vertex", "position", "seed", "birth", "labels", "on box")
    columns = [left, left + 60, left + 152, left + 208, left + 264, left + 324]
    for x, name in zip(columns, heads):
        sheet.text((x, top), name, "s")
    sheet.line([(left, top + 8), (748, top + 8)], SOFT, 1)
    for i, v in enumerate((0, 3, 7)):
        star = [t for t, tet in enumerate(tets) if v in tet]
        seen = {labels[t] for t in star} | {0}
        for x, words in zip(columns, (str(v), "({:.0f}, {:.0f}, {:.0f})".format(*points[v]), f"T{star[0]}", str(v), str(len(seen)), "yes")):
            sheet.text((x, top + 28 + 22 * i), words, "m")
    sheet.text((left, top + 28 + 66), "The seed is a tet of the star; walks find the rest.", "s")
    return sheet


def stars():
    """The link of a vertex, a sphere of triangles, with the labels of the tets behind the triangles."""
    sheet = Canvas(760, 330, "Regular and irregular vertices by the labels on their links")
    points, triangles = icosphere()
    front = View(20, 24, 84, (0, 0)).eye
    middle = [mean(points[v] for v in t) for t in triangles]
    right = View(20, 24, 84, (0, 0)).right
    up = View(20, 24, 84, (0, 0)).up

    def near(p, direction, cosine):
        return dot(p, direction) > cosine * norm(p) * norm(direction)

    side_a, side_b = add(front, right, 0.8), add(front, right, -0.8)
    cases = [
        ("a disc", lambda p: 1 if near(p, front, 0.55) else 0),
        ("two discs", lambda p: 1 if near(p, side_a, 0.9) or near(p, side_b, 0.9) else 0),
        ("a ring", lambda p: 1 if near(p, front, 0.42) and not near(p, front, 0.9) else 0),
        ("three sectors", lambda p: 0 if dot(p, up) > 0.12 else 1 if dot(p, right) < 0 else 2),
    ]
    for i, (name, choose) in enumerate(cases):
        labels = [choose(p) for p in middle]
        view = View(20, 24, 80, (100 + 187 * i, 108))
        shown = [t for t in range(len(triangles)) if dot(middle[t], view.eye) > 0]
        for label in sorted(set(labels)):
            sheet.polygons([[view(points[v]) for v in triangles[t]] for t in shown if labels[t] == label], LABELS[label])
        edges = sides(triangles)
        sheet.segments(view, points, [edge for edge in interface(triangles, labels) if all(t in shown for t in edges[edge])], INK, 3)

        def joined(s, t):
            return len(set(triangles[s]) & set(triangles[t])) == 2

        regular, rows = True, []
        for label in sorted(set(labels)):
            own = groups([t for t, which in enumerate(labels) if which == label], joined)
            rest = groups([t for t, which in enumerate(labels) if which != label], joined)
            regular = regular and own == 1 and rest == 1
            rows.append(f"label {label}: {own} group{'s' if own > 1 else ''}, others {rest}")
        assert regular == (i in (0, 3)), name
        x = 100 + 187 * i
        sheet.text((x, 222), name, "c b")
        sheet.text((x, 244), "regular" if regular else "irregular", "c u b" if regular else "c r b")
        for k, row in enumerate(rows):
            sheet.text((x, 266 + 18 * k), row, "c s")
    return sheet
