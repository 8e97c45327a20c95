#!/usr/bin/env python3
"""Runs the experiments of the thesis, prints their tables, and writes the figures and pictures of share/doc/thesis.md.

    share/thesis.py [--dsc build/release/bin/dsc] [--runs build/thesis] [--only NAME ...] [--page]

The tables are printed in the terminal. With --page, the text between the markers of share/doc/thesis.md and its pictures are
replaced as well. A run that the folder --runs already contains, with the same command and the same config, is not repeated.
The page RUNS/comparison.html shows tables 6.1 and 6.2 and all figures of the three clouds side by side.

DSC_DATA names the folder with the thesis' clouds:

    bunny.obj    2,503 points, 4,968 faces    the Stanford bunny with fewer points (Stanford Computer Graphics Laboratory)
    teapot.obj   1,202 points, 2,256 faces    a triangulation of Newell's teapot
    cow.obj      4,583 points, 5,804 faces    a cow, a common test model of computer graphics

The thesis calls them common OBJ files; this project does not contain them. Only their points are the clouds; their faces are the
truth with which results are compared. Other files with these names also work, but then the figures cannot be compared with those
of the thesis. If clouds are missing, only the experiments without these clouds run, and only their tables are printed.
"""
import argparse
import json
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "share" / "doc" / "thesis.md"
PICTURES = ROOT / "share" / "doc" / "pictures"

SPLIT = "{refine: {type: average_area}}"
SERIES = ["{steps: 50}", SPLIT, SPLIT, "{steps: 50}", SPLIT, SPLIT, "{steps: 50}"]
# name: (config, overrides, the cloud whose mesh is the truth)
RUNS = {
    "rotate": ("demos/rotate_sphere", [], None),
    "illinois": ("demos/rotate_sphere_illinois", [], None),
    "corner_box": ("demos/rotate_sphere_corner_box", [], None),
    "corner_box_55": ("demos/rotate_sphere_corner_box", ["schedule=[{steps: 55}]"], None),
    "deadlock": ("demos/rotate_sphere_corner_box",
                 ["improvement.fallbacks=false", "improvement.longest_spoke=0", "initial_mesh.divisions=7"], None),
    "average": ("demos/average", [], None),
    "normal": ("demos/normal", [], None),
    "box_tunnel": ("demos/box_tunnel", [], None),
    "start": ("thesis/teapot", ["schedule=[{steps: 1}]", "velocity.alpha=0", "velocity.beta=0"], None),
    "bunny": ("thesis/bunny", [], "bunny"),
    "teapot": ("thesis/teapot", [], "teapot"),
    "cow": ("thesis/cow", [], "cow"),
    "no_curvature": ("thesis/teapot", ["velocity.beta=0"], "teapot"),
    "one_per_cent": ("thesis/teapot", ["velocity.beta=0.01"], "teapot"),
    "angular_defect": ("thesis/teapot_angular_defect", [], "teapot"),
    "subpar": ("thesis/teapot_subpar", [], "teapot"),
    "default_quality": ("thesis/teapot", ["improvement.min_tet_quality=0.3", "improvement.degenerate_tet_quality=0.02"], "teapot"),
    "split_first": ("thesis/teapot", [f"schedule=[{', '.join([SPLIT] * 2)}, {{steps: 150}}]"], "teapot"),
    "no_split": ("thesis/teapot", ["schedule=[{steps: 150}]"], "teapot"),
    "cow_fourth": ("thesis/cow", [f"schedule=[{', '.join(SERIES)}, {{steps: 50}}]"], "cow"),
    "bunny_adaptive": ("thesis/bunny_adaptive", [], "bunny"),
    "teapot_adaptive": ("thesis/teapot_adaptive", [], "teapot"),
    "cow_adaptive": ("thesis/cow_adaptive", [], "cow"),
}
# picture: (run, options of dsc render)
SHOTS = {
    "corner_box": ("corner_box_55", ["--view", "front", "--edges"]),
    "start": ("start", ["--edges"]),
    "bunny": ("bunny", ["--view", "front"]),
    "bunny_bottom": ("bunny", ["--view", "bottom", "--edges"]),
    "teapot": ("teapot", []),
    "teapot_bottom": ("teapot", ["--view", "bottom"]),
    "cow": ("cow", ["--view", "front", "--edges"]),
    "one_per_cent": ("one_per_cent", []),
    "bunny_adaptive": ("bunny_adaptive", ["--view", "front"]),
    "teapot_adaptive": ("teapot_adaptive", []),
    "cow_adaptive": ("cow_adaptive", ["--view", "front"]),
    "box_tunnel": ("box_tunnel", []),
}
# Tables 6.1 and 6.2 of the thesis: seconds, vertices, faces; mean, least and largest distance.
THESIS = {"bunny": (946, 5063, 10154, 0.02915, 0.00015, 0.11350),
          "teapot": (845, 2550, 5110, 0.03291, 0.00034, 0.10509),
          "cow": (893, 2355, 4848, 0.02443, 0.00026, 0.16622)}


class Workshop:
    def __init__(self, dsc, runs):
        self.dsc = dsc
        self.runs = runs
        self.summaries = {}

    def call(self, *words):
        return subprocess.run([self.dsc, *map(str, words)], check=True, capture_output=True, text=True).stdout

    def run(self, name):
        config, overrides, truth = RUNS[name]
        path = ROOT / "configs" / f"{config}.yaml"
        folder, figures = self.runs / name, self.runs / f"{name}.json"
        made_by = {"config": path.read_text(), "overrides": overrides}
        if figures.exists() and folder.exists():
            summary = json.loads(figures.read_text())
            if summary["made_by"] == made_by:
                self.summaries[name] = summary
                return
        print("run", name, file=sys.stderr, flush=True)
        subprocess.run(["rm", "-rf", folder], check=True)
        self.call("run", path, "-o", folder, "-q", *overrides)
        summary = json.loads((folder / "summary.json").read_text())
        summary["made_by"] = made_by
        if truth:
            file = Path(os.environ["DSC_DATA"]) / f"{truth}.obj"
            summary["truth"] = json.loads(self.call("evaluate", folder, "--truth", file, "--json"))["truth"]
        figures.write_text(json.dumps(summary))
        self.summaries[name] = summary

    def picture(self, name):
        run, words = SHOTS[name]
        self.call("render", self.runs / run / "result" / "surface.ply" if (self.runs / run / "result" / "surface.ply").exists()
                  else self.runs / run, "-o", PICTURES / f"thesis_{name}.png", "--size", "640x480", *words)


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "| --- |" + " ---: |" * (len(header) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def chapter3(s):
    def row(what, name):
        summary = s[name]
        analytic = summary["observers"].get("analytic", {})
        return [what, f"{summary['steps']}", summary["status"], f"{analytic.get('vertex_ratio', 1):.3f}", f"{summary['tets']:,}",
                f"{analytic.get('distance_ratio', float('nan')):.3f}",
                " / ".join(str(summary["repair_classes"][c]["committed"]) if c in summary["repair_classes"] else "-"
                           for c in ("wedge", "tee", "cap", "sliver"))]
    return table(["rotation by 1 degree a step", "steps", "end", "vertices, end to start", "tets", "distance, end to start", "wedge / tee / cap / sliver"],
                 [row("improvement `dsc`", "rotate"), row("`illinois` in a grid", "illinois"),
                  row("`illinois`, corners, fall-backs on", "corner_box"), row("`illinois`, corners, fall-backs off", "deadlock")])


def trial(s, what, name):
    summary = s[name]
    return [what, f"{summary['truth']['chamfer_percent']:.4f}", f"{summary['interface_vertices']:,}",
            f"{summary['shells']} / {summary['genus']}", f"{summary['vertex_to_cloud']['mean']:.4f}", f"{summary['cpu_s']:.1f}"]


TRIAL = ["trial", "Chamfer %", "vertices", "shells / genus", "mean distance", "CPU s"]


def chapter4(s):
    return table(TRIAL, [trial(s, "as kept (`teapot.yaml`)", "teapot"), trial(s, "qualities of the original, 0.3 and 0.02", "default_quality"),
                         trial(s, "face areas and tet volume too (`teapot_subpar.yaml`)", "subpar"),
                         trial(s, "no curvature (`velocity.beta=0`)", "no_curvature"),
                         trial(s, "angular defect (`teapot_angular_defect.yaml`)", "angular_defect"),
                         trial(s, "two splits before the first step", "split_first"), trial(s, "no splits", "no_split")])


def table61(s):
    return table(["mesh", "seconds, thesis", "wall s", "CPU s", "vertices, thesis", "vertices", "faces, thesis", "faces"],
                 [[name, f"{t[0]}", f"{s[name]['wall_s']:.1f}", f"{s[name]['cpu_s']:.1f}", f"{t[1]:,}", f"{s[name]['interface_vertices']:,}",
                   f"{t[2]:,}", f"{s[name]['interface_faces']:,}"] for name, t in THESIS.items()])


def table62(s):
    def row(name, t):
        d = s[name]["vertex_to_cloud"]
        return [name, f"{t[3]:.5f}", f"{d['mean']:.5f}", f"{t[4]:.5f}", f"{d['min']:.5f}", f"{t[5]:.5f}", f"{d['max']:.5f}",
                f"{s[name]['shells']} / {s[name]['genus']}", f"{s[name]['self_intersections']}"]
    return table(["mesh", "mean, thesis", "mean", "least, thesis", "least", "largest, thesis", "largest", "shells / genus", "self-intersections"],
                 [row(name, t) for name, t in THESIS.items()])


def chapter7(s):
    return table(TRIAL, [trial(s, "teapot, plain", "teapot"), trial(s, "teapot, beta 0.01", "one_per_cent"),
                         trial(s, "teapot, adaptive", "teapot_adaptive"), trial(s, "bunny, plain", "bunny"),
                         trial(s, "bunny, adaptive", "bunny_adaptive"), trial(s, "cow, plain", "cow"),
                         trial(s, "cow, a fourth series", "cow_fourth"), trial(s, "cow, adaptive", "cow_adaptive")])


def filters(s):
    rows = [[name, f"{s[name + '_adaptive']['input']['points']:,}",
             ", ".join(f"{f['type']} {f['removed']}" for f in s[name + "_adaptive"]["input"]["filters"]),
             f"{s[name + '_adaptive']['input']['used']:,}"] for name in THESIS]
    return table(["cloud", "points", "set aside by", "used"], rows)


def motions(s):
    rows = []
    for name in ("average", "normal"):
        a = s[name]["observers"].get("analytic", {})
        rows.append([f"`{name}`", f"{s[name]['steps']}", s[name]["status"], f"{s[name]['inverted_tets']}", f"{s[name]['clamped']}",
                     ", ".join(f"{key} {value:.4g}" for key, value in a.items() if isinstance(value, (int, float)))])
    t = s["box_tunnel"]
    rows.append(["`box_tunnel`", f"{t['steps']}", t["status"], f"{t['inverted_tets']}", f"{t['clamped']}", f"shells {t['shells']}, genus {t['genus']}"])
    return table(["demo", "steps", "end", "inverted tets", "held at the box", "figures"], rows)


# The clouds of the thesis: points and faces.
CLOUDS = {"bunny": (2503, 4968), "teapot": (1202, 2256), "cow": (4583, 5804)}
# What each table needs.
NEEDS = {"chapter 3": ["rotate", "illinois", "corner_box", "deadlock"],
         "motions": ["average", "normal", "box_tunnel"],
         "chapter 4": ["teapot", "default_quality", "subpar", "no_curvature", "angular_defect", "split_first", "no_split"],
         "table 6.1": ["bunny", "teapot", "cow"], "table 6.2": ["bunny", "teapot", "cow"],
         "filters": ["bunny_adaptive", "teapot_adaptive", "cow_adaptive"],
         "chapter 7": ["teapot", "one_per_cent", "teapot_adaptive", "bunny", "bunny_adaptive", "cow", "cow_fourth", "cow_adaptive"]}
TITLES = {"chapter 3": "Chapter 3: the rotated sphere", "motions": "Chapter 4: motions without a cloud",
          "chapter 4": "Chapter 4: trials with the teapot", "table 6.1": "Table 6.1: time and size",
          "table 6.2": "Table 6.2: from the vertices of the interface to the cloud, normalised units",
          "filters": "Chapter 7: points that the filters set aside", "chapter 7": "Chapter 7: adaptive protocol and other trials"}
BLOCKS = {"chapter 3": chapter3, "chapter 4": chapter4, "table 6.1": table61, "table 6.2": table62, "chapter 7": chapter7,
          "filters": filters, "motions": motions}


def with_block(page, name, text):
    """The page with the text of one block replaced."""
    pattern = re.compile(rf"(<!-- {re.escape(name)}: begin -->\n).*?(<!-- {re.escape(name)}: end -->)", re.S)
    if len(pattern.findall(page)) != 1:
        raise SystemExit(f"{PAGE}: must have the markers '<!-- {name}: begin -->' and '<!-- {name}: end -->' once")
    return pattern.sub(lambda m: m.group(1) + text + "\n" + m.group(2), page)


def needs_cloud(name):
    return RUNS[name][0].startswith("thesis/")


def counts(file):
    """Points and faces of an OBJ file."""
    words = [line[:2] for line in file.read_text(errors="replace").splitlines()]
    return words.count("v "), words.count("f ")


def missing_clouds():
    """What keeps the experiments with clouds from running, as a sentence; empty if nothing does."""
    if "DSC_DATA" not in os.environ:
        return "the variable DSC_DATA, which names the folder with the clouds, is not set"
    folder = Path(os.environ["DSC_DATA"])
    absent = [f"{name}.obj" for name in CLOUDS if not (folder / f"{name}.obj").is_file()]
    if absent:
        return f"{' and '.join(absent)} not found in {folder} (DSC_DATA)"
    for name, expected in CLOUDS.items():
        found = counts(folder / f"{name}.obj")
        if found != expected:
            print(f"thesis.py: warning: {name}.obj has {found[0]:,} points and {found[1]:,} faces; the cloud of the thesis has "
                  f"{expected[0]:,} and {expected[1]:,}. The figures cannot be compared with those of the thesis.", file=sys.stderr)
    return ""


def in_columns(markdown):
    """A table of the page as text with aligned columns."""
    rows = [[cell.strip().replace("`", "") for cell in line.strip("|").split("|")] for line in markdown.splitlines()]
    right = [cell.endswith(":") for cell in rows.pop(1)]
    widths = [max(map(len, column)) for column in zip(*rows)]
    lines = ["  ".join(cell.rjust(width) if to_right else cell.ljust(width) for cell, width, to_right in zip(row, widths, right)).rstrip()
             for row in rows]
    return "\n".join([lines[0], "-" * max(map(len, lines)), *lines[1:]])


def print_tables(summaries):
    for name, needed in NEEDS.items():
        if all(run in summaries for run in needed):
            print(f"\n{TITLES[name]}\n\n{in_columns(BLOCKS[name](summaries))}")


def write_page(workshop):
    page = PAGE.read_text()
    for name, write in BLOCKS.items():
        page = with_block(page, name, write(workshop.summaries))
    for name in SHOTS:
        workshop.picture(name)
    PAGE.write_text(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dsc", type=Path, default=ROOT / "build" / "release" / "bin" / "dsc")
    parser.add_argument("--runs", type=Path, default=ROOT / "build" / "thesis")
    parser.add_argument("--only", nargs="+", choices=RUNS, help="run only these; tables for which runs are missing are left out")
    parser.add_argument("--page", action="store_true", help="also write the tables and pictures of share/doc/thesis.md")
    words = parser.parse_args()
    names = words.only or list(RUNS)
    absent = missing_clouds()
    if absent and (words.page or any(map(needs_cloud, words.only or []))):
        raise SystemExit(f"thesis.py: {absent}; share/thesis.py --help describes the clouds")
    if absent:
        names = [name for name in names if not needs_cloud(name)]
    if words.page and words.only:
        raise SystemExit("thesis.py: --page needs all runs; leave --only out")
    if not words.dsc.is_file():
        raise SystemExit(f"thesis.py: {words.dsc} does not exist; build it with share/setup.sh run, or name another dsc with --dsc")
    words.runs.mkdir(parents=True, exist_ok=True)
    workshop = Workshop(words.dsc.resolve(), words.runs)
    for name in names:
        workshop.run(name)
    print_tables(workshop.summaries)
    compared = [name for name in workshop.summaries if RUNS[name][2] and RUNS[name][0].startswith("thesis/")]
    if len(compared) > 1:
        page = words.runs / "comparison.html"
        workshop.call("report", *(words.runs / name for name in compared), "-o", page)
        print(f"\nAll figures of these runs side by side: {page}")
    if absent:
        print(f"\nThe tables with the thesis' clouds are missing: {absent}.\nshare/thesis.py --help describes the clouds.")
    if words.page:
        write_page(workshop)


if __name__ == "__main__":
    main()
