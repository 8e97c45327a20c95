#!/usr/bin/env python3
"""Draws the figures of share/doc/method.md: share/doc/pictures/method_*.svg.

    share/figures/figures.py                    writes them
    share/figures/figures.py --check FOLDER     writes them below FOLDER, exits 1 if those here differ
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import generated  # noqa: E402
import operations  # noqa: E402
import process  # noqa: E402
import structure  # noqa: E402
import topology  # noqa: E402

FIGURES = {
    "complex": structure.complex_in_a_cut,
    "data": structure.arrays,
    "regular": structure.stars,
    "flips": operations.flips,
    "splits": operations.splits,
    "interface": operations.interface_edits,
    "movement": process.movement,
    "step": process.step,
    "queues": process.queues,
    "topology": topology.kinds,
}


def draw(_):
    """{path below share/: text} of all figures."""
    return {f"doc/pictures/method_{name}.svg": make().svg() for name, make in FIGURES.items()}


if __name__ == "__main__":
    sys.exit(generated.main("figures/figures.py", __doc__, draw, ["doc/pictures/method_*.svg"]))
