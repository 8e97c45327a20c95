#!/usr/bin/env python3
"""Whether the topology of a reconstruction depends on the pose, the scale, the order or the sample of a cloud.

    poses.py --dsc PATH [--cloud FILE.obj=COMPONENTS,GENUS]... [--mesh FILE.off=COMPONENTS,GENUS]... [--work FOLDER]

--cloud: the cloud itself, ten random rotations, scales 1e-6 and 1e6, a shift by 5e6 along each axis, and its points shuffled,
which must give the same bytes of surface and volume. --mesh: samples with seeds 2 to 5 of a truth mesh, clean, with noise,
with outliers, with missing parts and sparse. A third number after the genus is that of the cavities.
"""

import argparse
import sys
from pathlib import Path

import packages  # noqa: F401
import numpy as np

from clouds import POINTS, SPARSE, make
from reconstruction import HEADER, Outcome, add_options, each, finish, line, reconstruct
from surfaces import Topology, random_rotation, read_cloud, read_mesh, write_cloud

ROTATIONS = 10
SCALES = (1e-6, 1e6)
SHIFT = 5e6
SEEDS = (2, 3, 4, 5)
SAMPLES = {"clean": POINTS, "noise": POINTS, "outliers": POINTS, "missing": POINTS, "sparse": SPARSE}
RESULTS = ("surface.obj", "volume.dsc")


def expectation(text):
    """FILE=COMPONENTS,GENUS[,CAVITIES] as path and topology."""
    file, _, numbers = text.rpartition("=")
    numbers = [int(n) for n in numbers.split(",")]
    if not file or len(numbers) not in (2, 3):
        raise ValueError(text)
    return Path(file), Topology(numbers[0], numbers[2] if len(numbers) == 3 else 0, numbers[1])


def poses(points, rotations):
    """(kind, name, points) of a cloud's poses, the unchanged one first."""
    yield "as it is", "as-it-is", points
    for seed in range(1, rotations + 1):
        yield "rotation", f"rotation-{seed}", points @ random_rotation(np.random.default_rng(seed)).T
    for scale in SCALES:
        yield "scale", f"scale-{scale:g}", points * scale
    yield "shift", f"shift-{SHIFT:g}", points + SHIFT
    yield "shuffled", "shuffled", np.random.default_rng(1).permutation(points)


def planned(options):
    """(group, kind, name, expected, points) of all clouds; those with no room for missing parts are left out."""
    for file, expected in map(expectation, options.cloud):
        for kind, name, points in poses(read_cloud(file), options.rotations):
            yield file.stem, kind, f"{file.stem}-{name}", expected, points
    for file, expected in map(expectation, options.mesh):
        mesh = read_mesh(file)
        for kind, count in SAMPLES.items():
            for seed in SEEDS:
                points = make(mesh, kind, count, seed)
                if points is None:
                    print(f"{file.stem}: no room for missing parts with seed {seed}")
                else:
                    yield file.stem, f"sample, {kind}", f"{file.stem}-{kind}-{seed}", expected, points


def compare_shuffled(outcomes, results):
    """A shuffled cloud whose bytes differ from those of the cloud as it is gets that as its fault."""
    for outcome in outcomes:
        if outcome.kind == "shuffled" and outcome.got:
            first = results / f"{outcome.group}-as-it-is"
            differ = [name for name in RESULTS
                      if not (first / name).exists() or (first / name).read_bytes() != (results / outcome.name / name).read_bytes()]
            if differ:
                outcome.fault = "other bytes than before the shuffling: " + ", ".join(differ)


def main():
    parser = argparse.ArgumentParser()
    add_options(parser)
    parser.add_argument("--cloud", action="append", default=[], metavar="FILE=C,G", help="a cloud to pose; may repeat")
    parser.add_argument("--mesh", action="append", default=[], metavar="FILE=C,G", help="a truth mesh to sample; may repeat")
    parser.add_argument("--rotations", type=int, default=ROTATIONS)
    options = parser.parse_args()
    try:
        plan = list(planned(options))
    except ValueError as error:
        parser.error(f"expected FILE=COMPONENTS,GENUS[,CAVITIES]: {error}")
    results = options.work / "poses"

    def judge(item):
        group, kind, name, expected, points = item
        file = options.work / "posed" / f"{name}.obj"
        file.parent.mkdir(parents=True, exist_ok=True)
        write_cloud(file, points)
        return Outcome(name, group, kind, expected,
                       **reconstruct(options.dsc, file, results / name, options.threads, options.option, volume=True))

    outcomes = list(each(options.jobs, judge, plan))
    compare_shuffled(outcomes, results)
    print(HEADER)
    for outcome in outcomes:
        print(line(outcome, options.flag))
    return finish(outcomes, options)


if __name__ == "__main__":
    sys.exit(main())
