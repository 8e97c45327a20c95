#!/usr/bin/env python3
"""Draws the pictures of share/doc/reconstruction.md from the surfaces that ablation.py and compare.py have left.

    pictures.py --dsc PATH [--work FOLDER] [--folder PICTURES]
"""

import argparse
import subprocess
from pathlib import Path

PICTURES = Path(__file__).resolve().parent.parent.parent / "share" / "doc" / "pictures"
# name: (surface, what dsc render is told)
SHOTS = {
    "start": ("ablation/block-clean/start.off", ["--edges"]),
    "block": ("ablation/block-clean/full.off", ["--edges"]),
    "animal": ("results/animal-missing/dsc.off", ["--view", "bottom"]),
}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--dsc", type=Path, required=True)
    parser.add_argument("--work", type=Path, default=Path("accuracy-work"))
    parser.add_argument("--folder", type=Path, default=PICTURES)
    options = parser.parse_args()
    for name, (surface, words) in SHOTS.items():
        subprocess.run([options.dsc.resolve(), "render", options.work / surface, "-o", options.folder / f"reconstruction_{name}.png",
                        "--size", "400x300", *words], check=True)


if __name__ == "__main__":
    main()
