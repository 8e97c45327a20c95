"""Figures of a step: movement, the order of its parts, the list of a round (method.md, sections 5 and 6)."""
import math

from canvas import BLUE, INK, LABELS, RED, SOFT, Canvas, plane
from geometry import add, area, blend, delaunay, dot, interface, mean, neighbours, norm, sides, sub

FREE_PATH = 0.5  # part of the way to the first inversion that a move covers (DeformerOptions::free_path)
ARRIVAL = 1e-4   # in target lengths; the meshes here have edges of about 1


# ---- movement -----------------------------------------------------------------------------------------------------------

def first_inversion(points, triangles, v, destination):
    """Fraction of the way of v to the first line through an opposite edge, and that edge."""
    best = (math.inf, None)
    p = points[v]
    for t in triangles:
        if v not in t:
            continue
        k = t.index(v)
        a, b = points[t[(k + 1) % 3]], points[t[(k + 2) % 3]]
        normal = (b[1] - a[1], a[0] - b[0])  # out of the triangle
        rate = dot(normal, sub(destination, p))
        if rate > 0:
            best = min(best, (dot(normal, sub(a, p)) / rate, (t[(k + 1) % 3], t[(k + 2) % 3])))
    return best


def move(points, triangles, v, destination):
    fraction, _ = first_inversion(points, triangles, v, destination)
    f = min(1.0, FREE_PATH * fraction)
    points[v] = destination if f == 1.0 else blend(points[v], destination, f)
    assert all(area(*(points[w] for w in t)) > 0 for t in triangles)


def smooth(points, triangles, free):
    """Moves free vertices to the mean of their neighbours where this does not lower the least area of their triangles."""
    for v in free:
        own = [t for t in triangles if v in t]
        before, old = points[v], min(area(*(points[w] for w in t)) for t in own)
        points[v] = mean(points[w] for w in neighbours(triangles, v))
        if min(area(*(points[w] for w in t)) for t in own) < min(old, 0.1):
            points[v] = before


def movement():
    sheet = Canvas(760, 345, "Moves up to half the way to the first inversion")
    points = [(i + (0.5 if j % 2 else 0.0), 0.8 * j) for j in range(6) for i in range(6 - j % 2)]
    triangles = delaunay(points)
    row = [v for v, p in enumerate(points) if abs(p[1] - 1.6) < 1e-9]
    rim = {v for edge, own in sides(triangles).items() if len(own) == 1 for v in edge}
    moving = [v for v in row if v not in rim]
    free = [v for v in range(len(points)) if v not in rim and v not in moving]
    labels = [1 if mean(points[v] for v in t)[1] < 1.6 else 0 for t in triangles]
    rise = (0.55, 1.0, 1.15, 0.7)
    destinations = {v: add(points[v], (0.12, h)) for v, h in zip(moving, rise)}
    special = moving[1]

    def panel(x, title, rows, shown):
        view = plane(43, (x, 250))
        sheet.triangles(view, points, triangles, labels)
        sheet.segments(view, points, interface(triangles, labels), INK, 3)
        for v in moving:
            if shown and norm(sub(points[v], destinations[v])) > 0.05:
                sheet.arrow([view(points[v]), view(destinations[v])], BLUE, 1.8, 7)
            sheet.dot(view(points[v]), 4.5, BLUE)
        sheet.text((x + 108, 28), title, "c b")
        sheet.lines((x + 108, 286), rows, "c s")
        return view

    t, edge = first_inversion(points, triangles, special, destinations[special])
    view = panel(22, "destinations", ["The marked vertex would meet", f"the opposite edge at t = {t:.2f},",
                                      f"so f = 0.5 t = {FREE_PATH * t:.2f}."], True)
    a, b = points[edge[0]], points[edge[1]]
    sheet.line([view(blend(a, b, -0.35)), view(blend(a, b, 1.35))], RED, 1.6, "5 4")
    sheet.line([view(a), view(b)], RED, 3)
    sheet.dot(view(blend(points[special], destinations[special], t)), 4, "#fff", RED, 2)
    sheet.dot(view(blend(points[special], destinations[special], FREE_PATH * t)), 4, RED)
    sheet.dot(view(points[special]), 5.5, BLUE, RED, 2)
    for v in moving:
        move(points, triangles, v, destinations[v])
    left = sum(norm(sub(points[v], destinations[v])) for v in moving)
    total = sum(norm(sub(destinations[v], (destinations[v][0] - 0.12, destinations[v][1] - h))) for v, h in zip(moving, rise))
    panel(272, "after one pass", ["All have moved; all triangles", "are positive. D, the distance left,", f"fell from {total:.2f} to {left:.2f}."], True)
    passes = 1
    while any(norm(sub(points[v], destinations[v])) > ARRIVAL for v in moving):
        smooth(points, triangles, free)
        for v in moving:
            move(points, triangles, v, destinations[v])
        passes += 1
        assert passes < 50
    panel(522, f"after {passes} passes", ["Repairs between the passes,", "here smoothing, made room;", "all vertices have arrived."], False)
    return sheet


# ---- the order of a step ------------------------------------------------------------------------------------------------

def step():
    sheet = Canvas(760, 560, "The order of a step")

    def block(x, y, w, rows, fill="#fff", line=INK):
        h = 16 + 19 * len(rows)
        sheet.box(x, y, w, h, fill, line)
        for i, row in enumerate(rows):
            sheet.text((x + w / 2, y + 22 + 19 * i), row, "c b" if i == 0 else "c s")
        return h

    h = block(150, 16, 460, ["begin", "destinations from the velocity, clamped to the box less 2 L"], LABELS[0])
    sheet.arrow([(205, 16 + h), (205, 116)])
    sheet.box(40, 82, 680, 276, "none", SOFT, 1.4, 10, "6 4")
    sheet.text((702, 105), "a round, at most 50 per step", "e s")
    block(60, 116, 200, ["passes of movement", "one attempt per vertex,", "a second one if some", "have not arrived"], LABELS[1])
    block(300, 116, 190, ["progress?", "no 1 % in 5 rounds:", "the rest of the motion", "is dropped"], "#fff")
    block(530, 116, 172, ["list of tets", "changed ones first, then", "refused ones whose", "vertices have changed"], LABELS[2])
    block(394, 248, 308, ["improvement", "sees list, blocked vertices and outcomes;", "returns requests"], "#f3e3f5")
    block(60, 248, 294, ["kernel", "executes the requests in their order:", "commits, or refuses and remembers"], LABELS[1])
    sheet.arrow([(260, 162), (300, 162)])
    sheet.arrow([(490, 162), (530, 162)])
    sheet.arrow([(616, 208), (616, 248)])
    sheet.arrow([(394, 284), (354, 284)])
    sheet.arrow([(160, 248), (160, 208)])
    sheet.text((172, 233), "a vertex is under way", "s")
    sheet.arrow([(240, 321), (240, 340), (240, 388)])
    sheet.text((252, 376), "settled: no vertex was under way, or this was round 50", "s")
    h = block(60, 388, 640, ["topology stage, once per step", "seeds in the changed tets, regions, one batch of candidates to the improvement,",
                             "accepted ones one by one, small components vanish"], LABELS[2])
    sheet.arrow([(380, 388 + h), (380, 488)])
    block(60, 488, 640, ["report, then a refinement if one is due", "lengths, labels, face splits, edge splits, collapses, flips, moves"], LABELS[0])
    return sheet


# ---- the list of a round ------------------------------------------------------------------------------------------------

def queues():
    sheet = Canvas(760, 400, "Which triangles the list of the next round has")
    points = [(i + (0.5 if j % 2 else 0.0), 0.86 * j) for j in range(7) for i in range(8 - j % 2)]
    points = [p if p[0] in (0, 7) or p[1] in (0, 0.86 * 6) else add(p, (0.09 * ((5 * k) % 7 - 3) / 3, 0.09 * ((3 * k) % 7 - 3) / 3))
              for k, p in enumerate(points)]
    triangles = delaunay(points)
    moved = min(range(len(points)), key=lambda v: norm(sub(points[v], (2.6, 2.5))))
    clock = 41
    date = [0] * len(points)
    failed = [t for t in range(len(triangles)) if t % 6 == 1 and moved not in triangles[t]]
    changed = [t for t in range(len(triangles)) if moved in triangles[t]]
    for t in changed:  # the move at clock 41 dates all vertices of the star
        for v in triangles[t]:
            date[v] = clock
    refused_at = 40
    woken = [t for t in failed if any(date[v] > refused_at for v in triangles[t])]
    asleep = [t for t in failed if t not in woken]
    assert woken and asleep
    view = plane(56, (24, 336))
    colour = {**{t: "#fff" for t in range(len(triangles))}, **{t: "#f6c887" for t in changed}, **{t: "#9ed3ae" for t in woken},
              **{t: "#d5d9e2" for t in asleep}}
    sheet.triangles(view, points, triangles, [colour[t] for t in range(len(triangles))])
    for v, d in enumerate(date):
        if d:
            sheet.dot(view(points[v]), 11, RED if v == moved else "#fff", RED, 1.6)
            if v != moved:
                sheet.text(add(view(points[v]), (0, 4)), str(d), "c r s")
    sheet.text(add(view(points[moved]), (0, 4)), "v", "c b w")
    x = 440
    sheet.text((x, 40), "v moves: the clock becomes 41", "b")
    rows = [("#f6c887", f"{len(changed)} triangles of its star have changed:", "they are listed first"),
            ("#9ed3ae", f"{len(woken)} refused at clock 40, but a vertex has", "the date 41: listed behind them"),
            ("#d5d9e2", f"{len(asleep)} refused at clock 40, no vertex has a", "later date: they wait, at no cost"),
            ("#ffffff", "the others: nothing to do", "")]
    for i, (fill, one, two) in enumerate(rows):
        y = 66 + 62 * i
        sheet.box(x, y, 26, 26, fill, SOFT, 1.2, 4)
        sheet.lines((x + 38, y + 12 if two else y + 19), [one, two] if two else [one], "s", 19)
    sheet.lines((x, 330), ["A tet whose request is refused again", "waits with the clock of that refusal."], "s")
    return sheet
