"""Figure of the topology stage: the kinds (s,o) of section 8.3 of method.md, on bodies of revolution."""
import math

from canvas import BLUE, INK, LABELS, RED, Canvas, shaded
from geometry import View

SECTORS = 16
REGION = "#e58b8b"


def revolve(r, z, i):
    a = 2 * math.pi * i / SECTORS
    return (r * math.cos(a), r * math.sin(a), z)


def boundary(cells):
    """Sides of the profile cells that bound them: ((r0, z0), (r1, z1), the cell behind). The axis r = 0 is not a side."""
    found = []
    for i, j in cells:
        for other, a, b in (((i, j - 1), (i, j), (i + 1, j)), ((i, j + 1), (i + 1, j + 1), (i, j + 1)),
                            ((i + 1, j), (i + 1, j), (i + 1, j + 1)), ((i - 1, j), (i, j + 1), (i, j))):
            if other not in cells and other[0] >= 0:
                found.append((a, b, other))
    return found


def euler(cells):
    """V - E + F of the surface that the boundary of the cells makes when it turns about the axis."""
    corners, edges, faces = set(), set(), 0
    for a, b, _ in boundary(cells):
        for k in range(SECTORS):
            ring = []
            for p, turn in ((a, k), (b, k), (b, k + 1), (a, k + 1)):
                q = (p[0], p[1], turn % SECTORS if p[0] else 0)
                if q not in ring:
                    ring.append(q)
            faces += 1
            corners |= set(ring)
            edges |= {frozenset((ring[m], ring[(m + 1) % len(ring)])) for m in range(len(ring))}
    return len(corners) - len(edges) + faces


def patches(region, phase):
    """Number of connected patches of the region's boundary that face the phase: sides of the profile joined at their ends."""
    left = [(a, b) for a, b, other in boundary(region) if phase(other)]
    count = 0
    while left:
        count += 1
        front = [left.pop()]
        while front:
            side = front.pop()
            near = [s for s in left if set(s) & set(side)]
            left = [s for s in left if s not in near]
            front += near
    return count


def outline(a, b):
    """The half of the surface that the side ab makes behind the plane x = 0, as one polygon in space."""
    turns = range(SECTORS // 4, 3 * SECTORS // 4 + 1)
    points = [revolve(*a, k) for k in turns] + [revolve(*b, k) for k in reversed(turns)]
    return [p for p, last in zip(points, [None, *points]) if p != last]


def runs(cells):
    """(first column, end, row) of the uninterrupted runs of cells in the rows."""
    for i, j in sorted(cells):
        if (i - 1, j) in cells:
            continue
        end = i
        while (end, j) in cells:
            end += 1
        yield i, end, j


def half(sheet, view, layers):
    """The half of each body behind the plane x = 0, and its cut. `layers`: (cells, colour)."""
    visible = []
    for cells, colour in layers:
        tops = {(i, j) for i, j in cells if (i, j + 1) not in cells}
        visible += [(j + 1, 0, outline((i, j + 1), (end, j + 1)), shaded(colour, 0.45)) for i, end, j in runs(tops)]
        hollows = [(a, b) for a, b, _ in boundary(cells) if a[0] == b[0] and b[1] < a[1]]  # the body is outside of them
        visible += [(b[1], 1, outline(a, b), shaded(colour, 0.1)) for a, b in hollows]
    for _, _, corners, colour in sorted(visible):
        sheet.polygon([view(p) for p in corners], colour, colour, 0.6)
    for cells, colour in layers:
        cut = [(sign * i, sign * end, j) for i, end, j in runs(cells) for sign in (1, -1)]
        sheet.polygons([[view((0.0, y, float(z))) for y, z in ((a, j), (b, j), (b, j + 1), (a, j + 1))] for a, b, j in cut], colour, colour)


def border(sheet, view, cells, colour_of, width):
    lines = {}
    for a, b, other in boundary(cells):
        for sign in (1, -1):
            lines.setdefault(colour_of(other), []).append([view((0.0, sign * r, float(z))) for r, z in (a, b)])
    for colour in sorted(lines):
        sheet.strokes(lines[colour], colour, width)


def block(columns, low, high, first=0):
    return {(i, j) for i in range(first, columns) for j in range(low, high)}


# Name, event, phase A, cells of label 1, region.
CASES = [
    ("(1,2) a sheet is pierced", "handle_opened", 1, block(3, 2, 3), block(1, 2, 3)),
    ("(1,2) a gap is bridged", "merge", 0, block(3, 0, 2) | block(3, 3, 5), block(1, 2, 3)),
    ("(2,1) a neck is cut", "split", 1, block(3, 0, 2) | block(1, 2, 3) | block(3, 3, 5), block(1, 2, 3)),
    ("(1,1) the interface shifts", "no event", 1, block(3, 1, 3) | block(1, 3, 4), block(1, 3, 4)),
    ("(0,1) component vanishes", "vanished", 1, block(3, 0, 1) | block(1, 3, 4), block(1, 3, 4)),
    ("(1,0) component is born", "born", 0, block(3, 0, 1), block(1, 3, 4)),
]


def kinds():
    sheet = Canvas(760, 560, "The kinds (s,o) of a change of topology")
    for n, (name, event, phase, body, region) in enumerate(CASES):
        other = 1 - phase
        s = patches(region, lambda cell: (cell in body) == (phase == 1))
        o = patches(region, lambda cell: (cell in body) == (other == 1))
        after = body - region if phase == 1 else body | region
        change = euler(after) - euler(body)
        assert name.startswith(f"({s},{o})") and change == 2 * (s - o), name
        x, y = 14 + 249 * (n % 3), 14 + 254 * (n // 3)
        sheet.box(x, y, 240, 244, "#fff", "#c9cfdd", 1, 8)
        sheet.text((x + 120, y + 24), name, "c b")
        for k, at in enumerate((x + 60, x + 180)):
            view = View(0, 20, 17.5, (at, y + 108), (0.0, 0.0, 2.5))
            cells = body - region if k == 0 else after
            half(sheet, view, [(cells, LABELS[1])] + ([(region, REGION)] if k == 0 else []))
            border(sheet, view, cells, lambda _: INK, 2.4)
            if k == 0:
                border(sheet, view, region, lambda cell: RED if (cell in body) == (phase == 1) else BLUE, 4)
        sheet.arrow([(x + 113, y + 108), (x + 129, y + 108)], INK, 1.8, 7)
        sheet.text((x + 120, y + 190), f"A = {phase}, B = {other}", "c s")
        sheet.text((x + 120, y + 209), f"Euler number {euler(body)} to {euler(after)}: {change:+d}".replace("+0", "0").replace("-", "\u2212"), "c s")
        sheet.text((x + 120, y + 230), event, "c m")
    sheet.box(16, 532, 18, 16, LABELS[1], INK, 1.2, 3)
    sheet.text((41, 545), "label 1, cut open", "s")
    sheet.box(178, 532, 18, 16, REGION, REGION, 1.2, 3)
    sheet.text((203, 545), "region R, from A to B", "s")
    sheet.line([(370, 540), (394, 540)], RED, 4)
    sheet.text((402, 545), "faces A (s patches)", "s")
    sheet.line([(566, 540), (590, 540)], BLUE, 4)
    sheet.text((598, 545), "faces B (o patches)", "s")
    return sheet
