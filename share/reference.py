#!/usr/bin/env python3
"""Writes what is generated from the declarations of the parameters: the pages in share/doc/strategies and the JSON Schema.

    share/reference.py [--dsc build/dev/bin/dsc]                    writes them
    share/reference.py [--dsc build/dev/bin/dsc] --check FOLDER     writes them below FOLDER, exits 1 if those here differ

Only strategies that come with dsc count, not those that DSC_PLUGIN_PATH or a user's folder add.
"""
import json
import os
import subprocess
import sys

import generated

KINDS = {
    "initial_mesh": ("Initial meshes", "the labelled volume mesh that a run starts from; key `initial_mesh`"),
    "velocity": ("Velocities", "the displacement of each interface vertex in a step; key `velocity`"),
    "curvature": ("Curvatures", "the curvature of the interface; a parameter of some velocities"),
    "refinement": ("Refinements", "which faces and edges are split, collapsed or flipped; key `refine` of an item of the `schedule`"),
    "improvement": ("Improvements", "the repairs that a step tries; key `improvement`"),
    "observer": ("Observers", "figures for `metrics.csv` and `summary.json`; items of `observers`"),
    "filter": ("Filters", "operations on the cloud before the run; items of `input.cloud.filters`"),
}


class Command:
    def __init__(self, dsc):
        self.dsc = dsc

    def __call__(self, *words):
        environment = {"PATH": os.environ.get("PATH", ""), "XDG_DATA_HOME": "/nonexistent", "LC_ALL": "C"}
        for name in ("ASAN_OPTIONS", "LSAN_OPTIONS", "TSAN_OPTIONS", "UBSAN_OPTIONS"):
            if name in os.environ:
                environment[name] = os.environ[name]
        return subprocess.run([self.dsc, *words], check=True, stdout=subprocess.PIPE, text=True, env=environment).stdout


def page_name(strategy):
    return f"{strategy['kind']}_{strategy['id']}.md"


def index(strategies):
    lines = ["# Strategies and their parameters",
             "Written by `share/reference.py` from the declarations in the code; `dsc plugin describe ID --format md` prints such a "
             "page for any strategy, of your own plugins too. The pages linked as *method* explain how the methods work."]
    for kind, (title, meaning) in KINDS.items():
        of_kind = [s for s in strategies if s["kind"] == kind]
        if not of_kind:
            continue
        lines += ["", f'<a id="{kind}"></a>', f"## {title}", f"{meaning[0].upper()}{meaning[1:]}.", "", "| | |", "| --- | --- |"]
        for s in of_kind:
            method = f"strategies/{kind}/{s['id']}/README.md"
            link = f"; [method](../../../{method})" if (generated.ROOT / method).exists() else ""
            lines.append(f"| [{s['id']}]({page_name(s)}) | {s['summary']}{link} |")
    return "\n".join(lines) + "\n"


def reference(dsc):
    """{path below share/: text} of everything that is generated."""
    strategies = json.loads(dsc("plugin", "list", "--json"))
    unknown = {s["kind"] for s in strategies} - set(KINDS)
    if unknown:
        raise SystemExit(f"reference.py does not know the kinds {', '.join(sorted(unknown))}; add them to KINDS")
    files = {"doc/strategies/README.md": index(strategies), "schema/dsc.schema.json": dsc("schema")}
    for s in strategies:
        files[f"doc/strategies/{page_name(s)}"] = dsc("plugin", "describe", s["id"], "--kind", s["kind"], "--format", "md")
    return files


if __name__ == "__main__":
    sys.exit(generated.main("reference.py", __doc__, lambda dsc: reference(Command(dsc)), ["doc/strategies/*.md", "schema/*.json"]))
