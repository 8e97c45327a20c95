#!/usr/bin/env python3
"""share/doc/sweeps.md, followed to the letter: its blocks of the language sh are run in their order.

Exits 77 where a block could not be run because its engine is not installed; the others are run all the same.
"""

import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "share/doc/sweeps.md"
DSC = Path(os.environ["DSC_TEST_COMMAND"])
OPTIONAL = ("parallel", "snakemake")


def blocks():
    return re.findall(r"^```sh\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)


def run(text, folder):
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("DSC_", "XDG_"))}
    environment |= {"PATH": f"{DSC.parent}:{os.environ['PATH']}", "HOME": str(folder)}
    done = subprocess.run(["bash", "-euc", text], cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=600, check=False)
    if done.returncode != 0:
        raise SystemExit(f"FAILED: exit {done.returncode} of\n{text}\n{done.stdout}")
    return done.stdout


def main():
    skipped = [name for name in OPTIONAL if not shutil.which(name)]
    with tempfile.TemporaryDirectory(prefix="dsc-sweeps-") as scratch:
        folder = Path(scratch)
        for name in ("configs", "share"):
            (folder / name).symlink_to(ROOT / name)
        ran = 0
        no_engine = len(skipped) == len(OPTIONAL)
        left_out = [text for text in blocks() if text.split()[0] in skipped or (no_engine and text.startswith("dsc report"))]
        for text in blocks():
            if text not in left_out:
                run(text, folder)
                ran += 1
        rows = list(csv.DictReader((folder / "results.csv").read_text(encoding="utf-8").splitlines()))
        # The page says 12 points; where there is an engine, all of them are done by now.
        wanted = "missing" if no_engine else "done"
        if len(rows) != 12 or any(row["status"] != wanted for row in rows) or ran + len(left_out) != 5:
            raise SystemExit(f"FAILED: {ran} blocks led to {[row['status'] for row in rows]}")
    if skipped:
        print(f"SKIPPED: the lines of {', '.join(skipped)}, not installed; share/setup.sh test --full installs them")
        return 77
    print(f"{ran} blocks, 12 points")
    return 0


if __name__ == "__main__":
    sys.exit(main())
