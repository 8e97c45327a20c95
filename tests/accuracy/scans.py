#!/usr/bin/env python3
"""Judges reconstructions of real scans, of which no true surface is known.

    scans.py --dsc PATH [--work FOLDER] [--trim] [--option OPTION]... CLOUD...

A tenth of the points is held out. `dsc reconstruct` gets the others, with --trim if wanted, and the row says: the topology, the mean
distance of the points held out to the surface in per cent of the diagonal of the cloud's box, the share of all points within 2 spacings
of the surface, the share of its area farther than 3 spacings from any point, its pieces, and the codes of the warnings. A spacing is the
median root of the area per point, from the 12th neighbour. Exits 0 whatever the results.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "topology"))
import packages  # noqa: F401,E402
import numpy as np  # noqa: E402
from accuracy import Triangles  # noqa: E402
from reconstruction import run_measured  # noqa: E402
from scipy.sparse import coo_matrix  # noqa: E402
from scipy.sparse.csgraph import connected_components  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402
from surfaces import read_mesh  # noqa: E402

HELD_OUT = 10  # one of 10 points
SAMPLES = 100000
MOST_JUDGED = 60000  # points whose distance is measured
SEED = 7


def points_of(dsc, cloud, work):
    """Different finite points of a cloud of any format that dsc reads, in random order."""
    text = work / "all.xyz"
    subprocess.run([dsc, "convert", cloud, text], check=True, capture_output=True)
    rows = [line.replace(",", " ").split()[:3] for line in text.read_text().splitlines()]
    points = np.array([row for row in rows if row and row[0][0] in "+-.0123456789"], float)
    points = np.unique(points[np.isfinite(points).all(axis=1)], axis=0)
    return np.random.default_rng(SEED).permutation(points)


def spacing_of(points):
    some = points[:MOST_JUDGED]
    return float(np.median(np.sqrt(np.pi / 12) * cKDTree(points).query(some, 13)[0][:, 12]))


def samples_of(points, faces):
    """Uniform by area."""
    random = np.random.default_rng(SEED)
    a, b, c = (points[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(faces), SAMPLES, p=area / area.sum())
    u, v = np.sqrt(random.random((SAMPLES, 1))), random.random((SAMPLES, 1))
    return (1 - u) * a[chosen] + u * (1 - v) * b[chosen] + u * v * c[chosen]


def pieces_of(points, faces):
    ends = np.roll(faces, 1, axis=1)
    graph = coo_matrix((np.ones(faces.size), (faces.ravel(), ends.ravel())), shape=(len(points), len(points)))
    labels = connected_components(graph, directed=False)[1]
    return len(np.unique(labels[faces]))


def judge(options, cloud):
    work = options.work / Path(cloud).stem
    work.mkdir(parents=True, exist_ok=True)
    points = points_of(options.dsc, cloud, work)
    held, given = points[:len(points) // HELD_OUT], points[len(points) // HELD_OUT:]
    np.savetxt(work / "given.xyz", given, fmt="%.17g")
    surface, run = work / "surface.obj", work / "run"
    subprocess.run(["rm", "-rf", run], check=True)
    command = [options.dsc, "reconstruct", work / "given.xyz", "-o", surface, "-o", work / "surface.ply", "--keep-run", run,
               "--threads", str(options.threads), "-q", *(["--trim"] if options.trim else []), *options.option]
    code, seconds = run_measured(command, work / "log.txt")
    if code != 0:
        return f"| {Path(cloud).name} | ended with code {code}: {(work / 'log.txt').read_text().strip()[-300:]} |"
    summary = json.loads((run / "summary.json").read_text())
    mesh = read_mesh(surface)
    tree, near = Triangles(*mesh), cKDTree(points)
    spacing, diagonal = spacing_of(points), np.linalg.norm(np.ptp(points, axis=0))
    outside = tree.nearest(held[:MOST_JUDGED])[0]
    covered = (tree.nearest(points[:MOST_JUDGED])[0] < 2 * spacing).mean()
    bare = (near.query(samples_of(*mesh))[0] > 3 * spacing).mean()
    topology = f"{summary['components']}/{summary['genus']}"
    codes = ", ".join(w["code"] for w in summary["warnings"]) or "-"
    return (f"| {Path(cloud).name} | {len(points)} | {len(mesh[0])} | {topology} | {summary['self_intersections']} | {summary['inverted_tets']} | "
            f"{100 * outside.mean() / diagonal:.4f} | {100 * covered:.2f} | {100 * bare:.2f} | {pieces_of(*mesh)} | {seconds:.0f} | {codes} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--dsc", required=True)
    parser.add_argument("--work", type=Path, default=Path("build/scans"))
    parser.add_argument("--trim", action="store_true")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--option", action="append", default=[], help="a further option of dsc reconstruct, as --option=--detail=high")
    parser.add_argument("clouds", nargs="+", metavar="CLOUD")
    options = parser.parse_args()
    print("| cloud | points | vertices | components/genus | crossings | inverted | held out % | covered % | bare % | pieces | CPU s | warnings |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |", flush=True)
    for cloud in options.clouds:
        print(judge(options, cloud), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
