#!/usr/bin/env python3
"""Judges dsc and other methods on the same clouds, of which the true surface is known.

    compare.py --dsc PATH [--peers PATH] [--work FOLDER] [--large] [--only PATTERN]
               [--pair CLOUD TRUTH]... [--page PAGE] [--full FILE]

--peers is the program that `ninja dsc_peers` builds; without it dsc is alone, and its own count of crossings is taken. Each result is kept
in --work, and what is there is not run again as long as the programs and clouds are the same. Prints Markdown; --page puts it
between the markers of a page instead, --full writes a row per result. With --pair those clouds alone are judged.
"""

import argparse
import hashlib
import json
import re
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "topology"))
import packages  # noqa: F401,E402
import numpy as np  # noqa: E402
from accuracy import measure  # noqa: E402
from reconstruction import run_measured  # noqa: E402
from surfaces import read_mesh, topology  # noqa: E402
from trials import COMPARED, LARGE, files_of, show, table  # noqa: E402

METHODS = {"dsc": "dsc", "advancing_front": "AF", "scale_space": "SS", "poisson": "Poisson"}
SAMPLES = 20000


def stamp(*files):
    """Changes where one of the files does."""
    digest = hashlib.sha256()
    for file in files:
        digest.update(Path(file).read_bytes())
    return digest.hexdigest()[:16]


class Bench:
    """Runs methods, judges them and keeps what it found."""

    def __init__(self, dsc, peers, work):
        self.dsc, self.peers, self.work = dsc, peers, Path(work)
        # Plugins are beside the program: they are dsc as well.
        plugins = sorted(dsc.parent.parent.glob("lib/dsc/plugins/*.so"))
        self.stamps = {"dsc": stamp(dsc, *plugins), **({"peers": stamp(peers)} if peers else {})}

    def methods(self):
        return list(METHODS) if self.peers else ["dsc"]

    def crossings(self, surface):
        if self.peers:
            return int(subprocess.run([self.peers, "crossings", surface], check=True, capture_output=True, text=True).stdout)
        told = subprocess.run([self.dsc, "info", "--json", surface], check=True, capture_output=True, text=True).stdout
        return json.loads(told)["self_intersections"]

    def command(self, method, cloud, surface):
        if method == "dsc":
            return [self.dsc, "reconstruct", cloud, "-o", surface, "--threads", "1", "-q"]
        return [self.peers, method, cloud, surface]

    def result(self, method, name, cloud, truth):
        """Of one method on one cloud: accuracy, validity, vertices and seconds, or a fault."""
        folder = self.work / "results" / name
        folder.mkdir(parents=True, exist_ok=True)
        surface, kept = folder / f"{method}.off", folder / f"{method}.json"
        made_by = [self.stamps["dsc" if method == "dsc" else "peers"], stamp(cloud, truth), SAMPLES]
        if kept.exists() and json.loads(kept.read_text())["made_by"] == made_by:
            return json.loads(kept.read_text())
        print(name, method, file=sys.stderr, flush=True)
        surface.unlink(missing_ok=True)
        code, seconds = run_measured(self.command(method, cloud, surface), folder / f"{method}.txt")
        found = {"made_by": made_by, "seconds": seconds}
        if code != 0 or not surface.exists():
            found["fault"] = f"ended with code {code}"
        else:
            found.update(judged(read_mesh(surface), read_mesh(truth)), crossings=self.crossings(surface))
        kept.write_text(json.dumps(found, indent=1))
        return found


def judged(surface, truth):
    """The shells count whichever way they are turned: not every method tells inside from outside."""
    got, expected = topology(*surface), topology(*truth)
    return {**asdict(measure(surface, truth, SAMPLES)), "vertices": len(np.unique(surface[1])), "closed": got.closed, "manifold": got.manifold,
            "shells": got.components + got.cavities, "genus": got.genus,
            "right": got.manifold and (got.components + got.cavities, got.genus) == (expected.components + expected.cavities, expected.genus)}


def valid(found):
    """Closed, manifold, free of crossings, with the truth's shells and genus."""
    return "fault" not in found and found["right"] and found["crossings"] == 0


def compact(results):
    """A row per cloud."""
    methods = [m for m in METHODS if any(m in row for row in results.values())]
    peers = methods[1:]
    rows = []
    for name, row in results.items():
        good = {m: row[m] for m in methods if "fault" not in row[m]}
        best = {"chamfer": min, "hausdorff99": min, "normals": max}

        def cell(method, key, digits):
            if method not in good:
                return "-"
            text = f"{good[method][key]:.{digits}f}" + ("" if key != "chamfer" or valid(good[method]) else "*")
            return f"**{text}**" if good[method][key] == best[key](found[key] for found in good.values()) else text

        def best_peer(key, digits):
            among = [m for m in peers if m in good]
            return cell(best[key](among, key=lambda m: good[m][key]), key, digits) if among else "-"
        rows.append([name] + [cell(m, "chamfer", 4) for m in methods]
                    + [text for key, digits in (("hausdorff99", 3), ("normals", 4))
                       for text in [cell("dsc", key, digits)] + ([best_peer(key, digits)] if peers else [])])
    split = [f"{title}, {who}" for title in ("H99 %", "normals") for who in (("dsc", "best other") if peers else ("dsc",))]
    return table(["cloud", *(f"Chamfer %, {METHODS[m]}" if m == "dsc" else METHODS[m] for m in methods), *split], rows)


def summary(results):
    """A row per method."""
    rows = []
    for method in METHODS:
        found = {name: row[method] for name, row in results.items() if method in row}
        if not found:
            continue
        good = {name: f for name, f in found.items() if "fault" not in f}
        both = [f["chamfer"] / results[name]["dsc"]["chamfer"] for name, f in good.items()
                if "fault" not in results[name]["dsc"] and not name.endswith("-outliers")]

        def count(test):
            return f"{sum(map(test, good.values()))}"
        rows.append([METHODS[method], f"{np.exp(np.mean(np.log(both))):.2f}" if both else "-", f"{len(good)} of {len(found)}",
                     count(lambda f: f["closed"]), count(lambda f: f["manifold"]), count(lambda f: f["right"]),
                     count(lambda f: f["crossings"] == 0), count(valid), f"{np.median([f['vertices'] for f in good.values()]):,.0f}" if good else "-",
                     f"{np.median([f['seconds'] for f in found.values()]):.1f}"])
    return table(["method", "Chamfer over dsc's, geometric mean without outliers", "surfaces", "closed", "manifold", "shells and genus right", "no crossings",
                  "all of these", "vertices, median", "CPU s, median"], rows)


def full(results):
    """A row per result."""
    rows = []
    for name, row in results.items():
        for method, f in row.items():
            figures = [f["fault"]] + ["-"] * 8 if "fault" in f else [
                f"{f['chamfer']:.4f}", f"{f['hausdorff99']:.3f}", f"{f['normals']:.4f}", "yes" if f["closed"] else "no",
                "yes" if f["manifold"] else "no", f"{f['shells']} / {f['genus']}" if f["closed"] else f"{f['shells']} / -",
                "yes" if f["right"] else "no", f"{f['crossings']}", f"{f['vertices']:,}"]
            rows.append([name, METHODS[method], *figures, f"{f['seconds']:.1f}"])
    return table(["cloud", "method", "Chamfer %", "H99 %", "normals", "closed", "manifold", "shells / genus", "as the truth", "crossings",
                  "vertices", "CPU s"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dsc", type=Path, required=True)
    parser.add_argument("--peers", type=Path)
    parser.add_argument("--work", type=Path, default=Path("accuracy-work"))
    parser.add_argument("--large", action="store_true", help="clouds of 10,000 points and more, and thinner shapes")
    parser.add_argument("--only", default="", help="a regular expression on names")
    parser.add_argument("--pair", nargs=2, action="append", default=[], metavar=("CLOUD", "TRUTH"), help=".obj or .off; may repeat")
    parser.add_argument("--page", type=Path, help="a page with the markers of 'comparison'")
    parser.add_argument("--full", type=Path, help="file for the table of all results")
    options = parser.parse_args()
    bench = Bench(options.dsc.resolve(), options.peers.resolve() if options.peers else None, options.work)
    cases = {Path(cloud).stem: (Path(cloud), Path(truth)) for cloud, truth in options.pair}
    if not cases:
        cases = {t.name: files_of(t, options.work / "clouds") for t in (LARGE if options.large else COMPARED) if re.search(options.only, t.name)}
    if not cases:
        raise SystemExit("no cloud matches")
    results = {name: {m: bench.result(m, name, *files) for m in bench.methods()} for name, files in cases.items()}
    counts = [t.points for t in (LARGE if options.large else COMPARED)] if not options.pair else []
    caption = f"Clouds of {min(counts):,} points{f', or up to {max(counts):,}' if max(counts) > min(counts) else ''}:\n\n" if counts else ""
    text = caption + compact(results) + "\n\n" + summary(results)
    if options.full:
        options.full.write_text(full(results) + "\n", encoding="utf-8")
    show(options.page, "comparison", text)


if __name__ == "__main__":
    main()
