"""A sheet for line drawings that becomes an SVG file. Its background is white, so that it is readable on light and dark pages."""
import math
from xml.sax.saxutils import escape

from geometry import FACES, back_to_front, blend, cross, dot, mean, sub, unit

INK, SOFT, RED, BLUE = "#26324a", "#66708a", "#c2263a", "#1f5fae"
LABELS = ("#e6eef7", "#f6c887", "#9ed3ae")  # outside, object, a further phase
STYLE = (
    "text{font:15px Helvetica,Arial,sans-serif;fill:#26324a}.s{font-size:13.5px;fill:#505a72}.b{font-weight:bold}"
    ".m{white-space:pre;font-family:Menlo,Consolas,'DejaVu Sans Mono',monospace;font-size:13.5px}.r{fill:#c2263a}.u{fill:#1f5fae}.w{fill:#fff}"
    ".c{text-anchor:middle}.e{text-anchor:end}.h{paint-order:stroke;stroke:#fff;stroke-width:4px;stroke-linejoin:round}"
    "polygon,polyline,line,path,circle,rect{stroke-linejoin:round;stroke-linecap:round}")


def number(x):
    text = f"{x + 1e-6:.1f}"  # so that a tie is rounded up, whatever the last bits of a sine are
    text = text[:-2] if text.endswith(".0") else text
    return "0" if text == "-0" else text


def listed(points):
    return " ".join(f"{number(x)},{number(y)}" for x, y in points)


class Canvas:
    def __init__(self, width, height, title):
        self.size, self.title, self.parts = (width, height), title, []

    def put(self, tag, text=None, **attributes):
        words = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in attributes.items() if value is not None)
        self.parts.append(f"<{tag}{words}/>" if text is None else f"<{tag}{words}>{escape(text)}</{tag}>")

    def polygon(self, points, fill="none", line=INK, width=1.2, **more):
        self.put("polygon", points=listed(points), fill=fill, stroke=line, stroke_width=number(width), **more)

    def line(self, points, line=INK, width=1.2, dash=None, **more):
        self.put("polyline", points=listed(points), fill="none", stroke=line, stroke_width=number(width), stroke_dasharray=dash, **more)

    def dot(self, at, r=4.0, fill=INK, line="#fff", width=1.2):
        self.put("circle", cx=number(at[0]), cy=number(at[1]), r=number(r), fill=fill, stroke=line, stroke_width=number(width))

    def square(self, at, r=4.0, fill=INK, turned=False):
        x, y = at
        d = 1.3 * r
        corners = [(x - d, y), (x, y - d), (x + d, y), (x, y + d)] if turned else [(x - r, y - r), (x + r, y - r), (x + r, y + r), (x - r, y + r)]
        self.polygon(corners, fill, "#fff", 1.2)

    def box(self, x, y, w, h, fill="#fff", line=INK, width=1.2, round_by=6, dash=None):
        self.put("rect", x=number(x), y=number(y), width=number(w), height=number(h), rx=round_by, fill=fill, stroke=line,
                 stroke_width=number(width), stroke_dasharray=dash)

    def text(self, at, words, kind="", **more):
        """`kind`: classes of STYLE, such as b (bold), s (small), c (centred), h (with a halo)."""
        self.put("text", words, x=number(at[0]), y=number(at[1]), **({"class": kind} if kind else {}), **more)

    def lines(self, at, rows, kind="", step=19):
        for i, row in enumerate(rows):
            self.text((at[0], at[1] + i * step), row, kind)

    def arrow(self, points, line=INK, width=1.8, head=8.0, dash=None):
        """A polyline with a head at its last point."""
        (x0, y0), (x1, y1) = points[-2], points[-1]
        d = unit((x1 - x0, y1 - y0))
        n = (-d[1], d[0])
        base = (x1 - head * d[0], y1 - head * d[1])
        self.line([*points[:-1], base], line, width, dash)
        self.polygon([(x1, y1), (base[0] + 0.5 * head * n[0], base[1] + 0.5 * head * n[1]),
                      (base[0] - 0.5 * head * n[0], base[1] - 0.5 * head * n[1])], line, line, 0.5)

    def polygons(self, outlines, fill, line="#8c97ae", width=0.8):
        """Many polygons of one colour as one path."""
        path = "".join("M" + "L".join(f"{number(x)},{number(y)}" for x, y in outline) + "Z" for outline in outlines)
        self.put("path", d=path, fill=fill, stroke=line, stroke_width=number(width))

    def strokes(self, lines, line=INK, width=2.8):
        """Many segments of one colour as one path."""
        path = "".join("M" + "L".join(f"{number(x)},{number(y)}" for x, y in points) for points in lines)
        self.put("path", d=path, fill="none", stroke=line, stroke_width=number(width))

    def triangles(self, view, points, triangles, labels, line=SOFT):
        """A labelled mesh of triangles in the plane; `view` maps its points to the sheet."""
        for t, label in zip(triangles, labels):
            self.polygon([view(points[v]) for v in t], LABELS[label] if isinstance(label, int) else label, line, 1)

    def segments(self, view, points, edges, line=INK, width=2.8):
        self.strokes([[view(points[a]), view(points[b])] for a, b in edges], line, width)

    def tets(self, view, points, tets, fills, shrink=0.0, line=INK, width=1.2):
        """Tets, each drawn smaller about its centre by the part `shrink`; a face is darker the more it turns from the light."""
        for t in back_to_front(points, tets, view):
            middle = mean(points[v] for v in tets[t])
            corner = {v: blend(points[v], middle, shrink) for v in tets[t]}
            for face in FACES:
                a, b, c = (corner[tets[t][k]] for k in face)
                normal = unit(cross(sub(b, a), sub(c, a)))
                if dot(normal, view.eye) <= 1e-9:
                    continue
                self.polygon([view(p) for p in (a, b, c)], shaded(fills[t], 0.45 + 0.55 * dot(normal, light(view))), line, width)

    def svg(self):
        width, height = self.size
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img">'
                f"<title>{escape(self.title)}</title><style>{STYLE}</style>"
                f'<rect width="{width}" height="{height}" rx="10" fill="#fff"/>')
        return "\n".join([head, *self.parts, "</svg>"]) + "\n"


def light(view):
    """Direction of the light: over the left shoulder of the eye."""
    return unit(tuple(0.75 * e + 0.6 * u - 0.35 * r for e, u, r in zip(view.eye, view.up, view.right)))


def shaded(colour, brightness):
    """The colour, darker by up to a third."""
    factor = 0.68 + 0.32 * max(0.0, min(1.0, brightness))
    return "#" + "".join(f"{int(int(colour[k:k + 2], 16) * factor + 0.5):02x}" for k in (1, 3, 5))


def plane(scale, at):
    """Maps points of the plane to the sheet, where y points down."""
    return lambda p: (at[0] + scale * p[0], at[1] - scale * p[1])


def regular_polygon(n, radius=1.0, turn=0.0):
    return [(radius * math.cos(turn + 2 * math.pi * i / n), radius * math.sin(turn + 2 * math.pi * i / n)) for i in range(n)]
