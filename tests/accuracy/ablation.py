#!/usr/bin/env python3
"""What each part of the reconstruction is worth: the same clouds with one part at a time switched off.

    ablation.py --dsc PATH [--work FOLDER] [--only PATTERN] [--parts PATTERN] [--kept] [--page PAGE]

Runs configs/reconstruct/medium.yaml with overrides and writes Chamfer and normal consistency of every run as Markdown; --page puts them
between the markers of a page. Results are kept in --work as those of compare.py are.
"""

import argparse
import json
import re
import subprocess
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "topology"))
import packages  # noqa: F401,E402
from accuracy import measure  # noqa: E402
from compare import SAMPLES, stamp  # noqa: E402
from reconstruction import run_measured  # noqa: E402
from surfaces import read_mesh, topology  # noqa: E402
from trials import ABLATED, files_of, show, table  # noqa: E402

CONFIG = Path(__file__).resolve().parent.parent.parent / "configs" / "reconstruct" / "medium.yaml"
FILTERS = "{type: duplicates, sort: true}", "{type: outliers}", "{type: orient}"
EVERYWHERE = "."


@dataclass(frozen=True)
class Variant:
    """`clouds` is a regular expression on the names of those where the part has something to do."""

    title: str
    overrides: tuple = ()
    filters: tuple = FILTERS
    clouds: str = EVERYWHERE


def schedule(remesh):
    return f"schedule=[{{refine: {remesh}}}, {{steps: 24, every: 1, refine: {remesh}, until: finished}}]"


VARIANTS = {
    "full": Variant("the whole method"),
    "saturation": Variant("no saturation: all edges resist bending in full (`crease_angle: 1000`)", ("velocity.crease_angle=1000",)),
    "noise": Variant("noise taken for none (`noise: 0.000001`)", ("velocity.noise=0.000001",), clouds="noise|outliers"),
    "rough": Variant("a third of the smoothing length (`smoothing: 0.33`)", ("velocity.smoothing=0.33",)),
    "smooth": Variant("three times the smoothing length (`smoothing: 3`)", ("velocity.smoothing=3",)),
    "holes": Variant("holes are not filled (`fill_holes: false`)", ("velocity.fill_holes=false",), clouds="missing"),
    "thin": Variant("no short edges in thin parts (`thin_parts: false`)", (schedule("{type: remesh, thin_parts: false}"),), clouds="gear"),
    "remesh": Variant("no remeshing", ("schedule=[{steps: 24, until: finished}]",)),
    "outliers": Variant("no filter `outliers`", filters=(FILTERS[0], FILTERS[2]), clouds="outliers"),
    "start": Variant("the start alone, as `indicator` hands it over",
                     ("velocity={type: point_cloud, alpha: 0, beta: 0}", "schedule=[{steps: 1}]")),
}


def result(dsc, work, variant, name, cloud, truth, programs, kept_only):
    """Figures of one run, or a fault; None where nothing is there and nothing shall run."""
    folder = work / "ablation" / name
    folder.mkdir(parents=True, exist_ok=True)
    run, kept = folder / variant, folder / f"{variant}.json"
    what = VARIANTS[variant]
    overrides = [f"input.cloud={{file: '{cloud.resolve()}', filters: [{', '.join(what.filters)}]}}", *what.overrides]
    made_by = [programs, stamp(cloud, truth, CONFIG), overrides, SAMPLES]
    if kept.exists() and json.loads(kept.read_text())["made_by"] == made_by:
        return json.loads(kept.read_text())
    if kept_only:
        return None
    print(name, variant, file=sys.stderr, flush=True)
    subprocess.run(["rm", "-rf", run], check=True)
    code, seconds = run_measured([dsc, "run", CONFIG, "-o", run, "--threads", "1", "-q", *overrides], folder / f"{variant}.txt")
    found = {"made_by": made_by, "seconds": seconds}
    if code != 0:
        found["fault"] = f"ended with code {code}"
    else:
        surface = folder / f"{variant}.off"
        subprocess.run([dsc, "convert", run / "result" / "surface.ply", surface], check=True, capture_output=True)
        subprocess.run(["rm", "-rf", run], check=True)
        mesh, true = read_mesh(surface), read_mesh(truth)
        found.update(asdict(measure(mesh, true, SAMPLES)), vertices=len(mesh[0]), right=topology(*mesh) == topology(*true))
    kept.write_text(json.dumps(found, indent=1))
    return found


def written(results):
    """Results are by variant, then by cloud. A worse Chamfer than that of the whole method by more than 5 % is bold."""
    clouds = list(results["full"])
    rows = []
    for variant, row in results.items():
        cells = []
        for cloud in clouds:
            found, whole = row.get(cloud), results["full"][cloud]
            if found is None or "fault" in found:
                cells.append("" if found is None else "-")
                continue
            worse = "fault" not in whole and found["chamfer"] > 1.05 * whole["chamfer"]
            chamfer = f"{found['chamfer']:.4f}" + ("" if found["right"] else "*")
            cells.append((f"**{chamfer}**" if worse else chamfer) + f" / {found['normals']:.4f}")
        rows.append([VARIANTS[variant].title] + cells)
    return table(["Chamfer % / normals"] + clouds, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dsc", type=Path, required=True)
    parser.add_argument("--work", type=Path, default=Path("accuracy-work"))
    parser.add_argument("--only", default="", help="a regular expression on names")
    parser.add_argument("--parts", default="", help="a regular expression on the parts: " + ", ".join(VARIANTS))
    parser.add_argument("--kept", action="store_true", help="run nothing, show what is there")
    parser.add_argument("--page", type=Path, help="a page with the markers of 'ablation'")
    options = parser.parse_args()
    dsc = options.dsc.resolve()
    programs = stamp(dsc, *sorted(dsc.parent.parent.glob("lib/dsc/plugins/*.so")))
    results = {variant: {} for variant in VARIANTS}
    for trial in ABLATED:
        if not re.search(options.only, trial.name):
            continue
        files = files_of(trial, options.work / "clouds")
        for variant, what in VARIANTS.items():
            if re.search(what.clouds, trial.name) and re.search(options.parts, variant):
                found = result(dsc, options.work, variant, trial.name, *files, programs, options.kept)
                if found:
                    results[variant][trial.name] = found
    text = written({variant: row for variant, row in results.items() if row})
    show(options.page, "ablation", text)


if __name__ == "__main__":
    main()
