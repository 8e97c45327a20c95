"""The clouds on which compare.py and ablation.py judge, with the true surfaces that they are samples of.

Most shapes and all kinds of clouds are those of tests/topology. Two shapes join them: one whose creases are exact, as the others come
from marching tetrahedra, which blunt them, and one that is organic.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "topology"))
import packages  # noqa: F401,E402
import numpy as np  # noqa: E402
from clouds import make  # noqa: E402
from fields import rod  # noqa: E402
from marching import surface_mesh  # noqa: E402
from shapes import checked_mesh  # noqa: E402
from surfaces import Topology, random_rotation, read_cloud, read_mesh, topology, write_cloud  # noqa: E402

POINTS, SPARSE = 10000, 3000


@dataclass(frozen=True)
class Trial:
    """A cloud of a shape; `name` is SHAPE-KIND."""

    name: str
    points: int
    seed: int

    @property
    def shape(self):
        return self.name.rpartition("-")[0]

    @property
    def kind(self):
        return self.name.rpartition("-")[2]


def block():
    """A stepped bracket with a window, sheared so that few angles are right: flat faces and exact creases."""
    x, y, z = [0, 0.3, 0.7, 1.1, 1.6], [0, 0.25, 0.75, 1.0], [0, 0.3, 0.55, 0.9]
    full = np.zeros((6, 5, 5), bool)  # of the cells of the grid, with an empty one all round
    full[1:5, 1:4, 1] = True
    full[1, 1:4, 1:4] = True
    full[3:5, 1:4, 2] = True
    full[4, 1:3, 3] = True
    full[2, 2, 1] = False
    points, faces = [], []
    for cell in np.argwhere(full):
        for axis in range(3):
            for side in (0, 1):
                beside = cell.copy()
                beside[axis] += 2 * side - 1
                if full[tuple(beside)]:
                    continue
                square = np.repeat((cell - 1)[None], 4, axis=0)
                square[:, axis] += side
                square[:, (axis + 1) % 3] += [0, 1, 1, 0]
                square[:, (axis + 2) % 3] += [0, 0, 1, 1]
                start = len(points)
                points += [(x[i], y[j], z[k]) for i, j, k in (square if side else square[::-1])]
                faces += [(start, start + 1, start + 2), (start, start + 2, start + 3)]
    points, index = np.unique(np.array(points, float), axis=0, return_inverse=True)
    return points @ np.array([[1, 0, 0], [0.25, 1, 0], [0.35, 0.2, 1.0]]), index.reshape(-1)[np.array(faces)]


def animal():
    """A body with a head, ears, four legs and a tail that run smoothly into each other."""
    parts = [rod((-0.6, 0, 0), (0.55, 0, 0.05), 0.32, 0.28), rod((0.7, 0, 0.3), (0.98, 0, 0.38), 0.22, 0.15),
             rod((-0.9, 0, 0.1), (-1.2, 0, 0.55), 0.08, 0.06)]
    parts += [rod((0.68, s * 0.13, 0.45), (0.62, s * 0.2, 0.72), 0.07, 0.05) for s in (-1, 1)]
    parts += [rod((x, s * 0.18, -0.1), (x + 0.05, s * 0.22, -0.75), 0.13, 0.1) for x in (-0.55, 0.45) for s in (-1, 1)]

    def field(p):
        return -np.log(sum(np.exp(-part(p) / 0.05) for part in parts)) * 0.05
    return surface_mesh(field, (-1.5, -0.7, -1.1), (1.4, 0.7, 1.0), 0.02)


OWN = {"block": (block, Topology(1, 0, 1)), "animal": (animal, Topology(1, 0, 0))}


def trials(count, names, seed):
    return [Trial(name, count, seed + i) for i, name in enumerate(names)]


KINDS = ("clean", "noise", "missing", "outliers")
COMPARED = trials(SPARSE, [*(f"{shape}-{kind}" for shape in ("block", "animal") for kind in KINDS), "two_rings-clean", "two_rings-noise",
                           "letter_b-missing", "gear-clean"], 7000)
# Of thin parts and gaps, which need more points, and of what else depends on their number.
LARGE = trials(POINTS, [*(f"{shape}-{kind}" for shape in ("block", "animal") for kind in KINDS), "gear-clean", "gear-noise",
                        "wine_glass-outliers", "socket_and_ball-clean", "foam-missing", "trefoil-noise"], 7100)
LARGE += trials(2 * POINTS, ["plate_with_holes-clean"], 7200)
ABLATED = trials(SPARSE, ["block-clean", "animal-noise", "animal-missing", "block-outliers", "gear-clean"], 8000)


def truth_mesh(name):
    """Points and triangles of a shape, which is turned at random once and for all."""
    if name not in OWN:
        points, faces = checked_mesh(name)
    else:
        points, faces = OWN[name][0]()
        if topology(points, faces) != OWN[name][1]:
            raise ValueError(f"the truth of {name} has {topology(points, faces)} instead of {OWN[name][1]}")
    return points @ random_rotation(np.random.default_rng(list(name.encode()))).T, faces


def write_off(path, points, faces):
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        np.savetxt(out, points, "%.12g")
        np.savetxt(out, np.column_stack([np.full(len(faces), 3), faces]), "%d")


def files_of(trial, folder):
    """Cloud and truth as files in the folder, made where they are not there."""
    cloud, truth = Path(folder) / f"{trial.name}-{trial.points}.obj", Path(folder) / f"{trial.shape}.off"
    Path(folder).mkdir(parents=True, exist_ok=True)
    if not truth.exists():
        part = truth.with_suffix(".part")
        write_off(part, *truth_mesh(trial.shape))
        part.rename(truth)
    if not cloud.exists():
        points = make(read_mesh(truth), trial.kind, trial.points, trial.seed)
        if points is None:
            raise ValueError(f"{trial.name}: there is no room for missing parts")
        part = cloud.with_suffix(".part")
        write_cloud(part, points)
        part.rename(cloud)
    return cloud, truth


def table(header, rows):
    """Markdown, numbers to the right."""
    lines = ["| " + " | ".join(header) + " |", "| --- |" + " ---: |" * (len(header) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def with_block(page, name, text):
    """The page with the text between the markers of one block replaced."""
    pattern = re.compile(rf"(<!-- {re.escape(name)}: begin -->\n).*?(<!-- {re.escape(name)}: end -->)", re.S)
    if len(pattern.findall(page)) != 1:
        raise SystemExit(f"the page must have the markers '<!-- {name}: begin -->' and '<!-- {name}: end -->' once")
    return pattern.sub(lambda m: m.group(1) + text + "\n" + m.group(2), page)


def show(page, name, text):
    """Puts the text into the block of the page, a file, or prints it where there is no page."""
    if page:
        page.write_text(with_block(page.read_text(encoding="utf-8"), name, text), encoding="utf-8")
    else:
        print(text)


__all__ = ["ABLATED", "COMPARED", "LARGE", "Trial", "files_of", "read_cloud", "show", "table", "with_block", "write_off"]
