#!/usr/bin/env python3
"""Runs all benchmarks of a build and writes their tables into a page, between its two markers.

    report.py --build build/release --page share/doc/performance.md [--repetitions 5] [--quick]

--quick runs everything once and small, to see that it works; its numbers mean nothing and go to standard output.
Every figure is the median of the repetitions with the least and the largest in brackets.
"""

import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import gate

BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"
MESHES = ["start", "step5", "step120", "million", "shuffled"]


def say(text):
    print(f"bench: {text}", file=sys.stderr, flush=True)


def short(value):
    """Three digits that mean something."""
    if value == 0:
        return "0"
    digits = max(0, 2 - int(f"{value:e}".split("e")[1]))
    return f"{value:,.{digits}f}"


def spread(values, scale=1.0):
    """median [least, largest]; the median alone where there is nothing to spread."""
    values = [scale * value for value in values]
    text = short(statistics.median(values))
    return text if len(values) < 2 else f"{text} [{short(min(values))}, {short(max(values))}]"


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "| --- |" + " ---: |" * (len(header) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def machine(build):
    """Processor, cores, compiler: what the figures hold for. No date and no names."""
    cpu = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    cache = dict(re.findall(r"^set\((CMAKE_CXX_COMPILER_ID|CMAKE_CXX_COMPILER_VERSION) \"([^\"]*)\"\)",
                            next((build / "CMakeFiles").glob("*/CMakeCXXCompiler.cmake")).read_text(), re.M))
    compiler = f"{cache['CMAKE_CXX_COMPILER_ID']} {cache['CMAKE_CXX_COMPILER_VERSION']}"
    kind = re.search(r"^CMAKE_BUILD_TYPE:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.M).group(1)
    return f"{cpu.group(1) if cpu else 'unknown processor'}, {os.cpu_count()} cores, {compiler}, {kind}"


class Bench:
    def __init__(self, build, repetitions, quick):
        self.programs = build / "bin"
        self.repetitions = 1 if quick else repetitions
        self.quick = quick

    def json_of(self, program, *words):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "out.json"
            before, after = (words[:words.index("--mesh")], words[words.index("--mesh"):]) if "--mesh" in words else (words, ())
            subprocess.run([self.programs / program, *before, "--json", file, *after], stdout=subprocess.DEVNULL, check=True)
            return json.loads(file.read_text())

    def micro(self):
        if not (self.programs / "dsc_bench").exists():
            return "The micro benchmarks are left out: google-benchmark is not installed.\n"
        say(f"micro benchmarks, {self.repetitions} repetitions")
        pattern = "start/walk" if self.quick else "."
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "out.json"
            subprocess.run([self.programs / "dsc_bench", f"--benchmark_filter={pattern}", f"--benchmark_out={file}",
                            "--benchmark_out_format=json", f"--benchmark_repetitions={self.repetitions}",
                            "--benchmark_enable_random_interleaving=true"],
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
            runs = json.loads(file.read_text())["benchmarks"]
        return "Nanoseconds of CPU time an attempt; `-`: the mesh has too few such places.\n\n" + markdown(
            ["what", *MESHES], micro_rows(runs))

    def protocol(self, cloud, *words):
        say(f"protocol on {cloud}, {self.repetitions} repetitions")
        small = ("--steps", "4") if self.quick else ()
        return [self.json_of("dsc_protocol", *words, *small) for _ in range(self.repetitions)]

    def scaling(self):
        say(f"scaling, {self.repetitions} repetitions")
        sizes = "300,600" if self.quick else "2000,6000,20000,60000,200000"
        return [self.json_of("dsc_scaling", "--n", sizes, *self.mesh()) for _ in range(self.repetitions)]

    def threads(self):
        say(f"threads, {self.repetitions} repetitions")
        size = "600" if self.quick else "20000"
        counts = [1, 2] + ([4] if (os.cpu_count() or 1) >= 4 else [])
        # In turns, so that the machine's moods meet all of them.
        return [{count: self.json_of("dsc_scaling", "--n", size, "--threads", str(count), *self.mesh())["rows"][0] for count in counts}
                for _ in range(self.repetitions)]

    def mesh(self):
        """A graded exterior where the build has one: a uniform grid grows with N to the power of 1.5."""
        return ("--mesh", "lattice") if list(self.programs.parent.glob("lib/dsc/plugins/libdsc_lattice.so")) else ()

    def peers(self):
        """Runs of dsc_bench_peers. Every run lets all programs work in turn, so that the machine's moods meet all of them."""
        if not (self.programs / "dsc_bench_peers").exists():
            return []
        say(f"other programs on the same work, {self.repetitions} repetitions")
        return [self.json_of("dsc_bench_peers", *(("--quick",) if self.quick else ())) for _ in range(self.repetitions)]

    def instructions(self):
        if not shutil.which("valgrind"):
            return "Instructions are left out: valgrind is not installed.\n"
        say("instructions of scaling under callgrind")
        # A uniform grid for 20,000 vertices takes callgrind minutes to build.
        sizes = [300, 600] if self.quick else [2000, 6000, 20000, 60000, 200000] if self.mesh() else [2000, 6000]
        steps = 2 if self.quick else 3
        rows = []
        for n in sizes:
            count, out = gate.count_instructions([str(self.programs / "dsc_scaling"), "--n", str(n), "--steps", str(steps), *self.mesh()])
            rows.append((float(out.splitlines()[1].split()[0]), count / steps))
        text = markdown(["interface vertices", "instructions per step", "per vertex and step"],
                        [[f"{n:,.0f}", f"{c:,.0f}", f"{c / n:,.0f}"] for n, c in rows])
        return text + f"\n\nExponent of the instructions: {exponent(rows):.3f}.\n"


def micro_rows(runs):
    times = {}
    # Interleaved repetitions come in a random order; the family's number is the order of registration.
    for run in sorted(runs, key=lambda run: run.get("family_index", 0)):
        if run.get("run_type") == "aggregate" or run.get("error_occurred"):
            continue
        mesh, name = run["name"].split("/")[:2]
        times.setdefault(name, {}).setdefault(mesh, []).append(run["real_time"])
    return [[name, *(spread(by_mesh[mesh]) if mesh in by_mesh else "-" for mesh in MESHES)] for name, by_mesh in times.items()]


def exponent(points):
    """Slope of log y over log x by least squares."""
    import math

    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x = statistics.mean(x for x, _ in logs)
    mean_y = statistics.mean(y for _, y in logs)
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)


def protocol_tables(by_cloud):
    phases = ["velocity", "move", "improve", "refine", "sum"]
    rows, steps = [], []
    for cloud, runs in by_cloud.items():
        each = [run["protocol"] for run in runs]
        rows.append([cloud, *(spread([run["seconds"][phase] for run in each]) for phase in phases),
                     short(each[0]["mean_interface_vertices"]), spread([run["us_per_vertex_and_step"] for run in each])])
        steps.append([cloud, *(spread([run["step_ms"][key] for run in each]) for key in each[0]["step_ms"]),
                      short(each[0]["tets_per_interface_vertex"]), spread([run["peak_rss_mb"] for run in each]),
                      f"{each[0]['shells']} / {each[0]['genus']}"])
    return "\n\n".join([
        markdown(["CPU seconds, 150 steps", *phases, "mean N", "us a vertex and step"], rows),
        markdown(["ms per step", *steps_header(by_cloud), "tets / N", "peak MB", "shells / genus"], steps)])


def steps_header(by_cloud):
    return list(next(iter(by_cloud.values()))[0]["protocol"]["step_ms"])


def quiet_table(runs):
    rows = [["settled", short(runs[0]["settled"]["interface_vertices"]), f"{runs[0]['settled']['tets']:,}",
             spread([run["settled"]["step_ms"] for run in runs]), "", ""]]

    def quiet(name, pick):
        first = pick(runs[0])
        rows.append([name, short(first["interface_vertices"]), f"{first['tets']:,}", "",
                     spread([pick(run)["idle_ms"] for run in runs]), spread([pick(run)["one_vertex_ms"] for run in runs])])

    quiet("settled, then nothing moves", lambda run: run["settled"]["quiet_steps"])
    for name in ("thesis' box", "ten times the tets"):
        quiet(f"cube in {name}" if name.startswith("thesis") else f"the same cube in {name}", lambda run, name=name: run["exterior"][name])
    ratio = spread([run["exterior"]["ratio"] for run in runs])
    return markdown(["ms", "N", "tets", "step", "idle", "one vertex"], rows) + \
        f"\n\nIdle, ten times the tets over the thesis' box: {ratio} times.\n"


def scaling_table(runs):
    rows = []
    for i, first in enumerate(runs[0]["rows"]):
        def figure(key, i=i):
            return spread([run["rows"][i][key] for run in runs])
        rows.append([f"{first['n']:,.0f}", f"{first['tets']:,.0f}", short(first["tets_per_vertex"]), figure("build_s"), figure("step_ms"),
                     figure("us_per_vertex_and_step"), figure("rss_mb"), figure("kb_per_vertex"), figure("peak_rss_mb")])
    text = markdown(["N", "tets", "tets / N", "build s", "step ms", "us a vertex and step", "MB", "kB / N", "peak MB"], rows)
    return f"Initial mesh `{runs[0]['mesh']}`, {runs[0]['steps']} steps.\n\n{text}\n\n" + \
        f"Exponent of the CPU time: {spread([run['exponent'] for run in runs])}.\n"


def threads_table(runs):
    rows = []
    for count in runs[0]:
        each = [run[count] for run in runs]
        rows.append([str(count), f"{each[0]['n']:,.0f}", spread([row["wall_ms"] for row in each]), spread([row["step_ms"] for row in each]),
                     spread([run[1]["wall_ms"] / run[count]["wall_ms"] for run in runs]),
                     spread([ns for row in each for ns in row.get("exchange_ns", [])]) if count > 1 else ""])
    digests = {row["digest"] for run in runs for row in run.values()}
    return markdown(["threads", "N", "wall ms per step", "CPU ms per step", "faster, times", "exchange, ns"], rows) + \
        ("\n\nThe complex at the end has the same bytes in all of these runs.\n" if len(digests) == 1
         else f"\n\nDIFFERENT RESULTS: {len(digests)} different complexes.\n")


def peer_rows(tables, start, figures):
    """A row per program; `tables` are the same table of several runs, `start` the first cells, `figures` the keys with their texts."""
    rows = []
    for i, first in enumerate(tables[0]["rows"]):
        if "missing" in first:
            rows.append([*start, f"{first['program']}: {first['missing']}", *([""] * len(figures))])
        else:
            rows.append([*start, first["program"], *(text([table["rows"][i][key] for table in tables]) for key, text in figures)])
    return rows


def same(values):
    """A figure that does not depend on the machine; more than one value where it should not be so."""
    return " / ".join(sorted({short(value) if isinstance(value, float) else f"{value:,}" for value in values}))


def change(values):
    """The same for a change in per cent, which may be nothing but rounding."""
    return " / ".join(sorted({f"{value:+.3f}" for value in values}))


def peers_tables(runs):
    """Time beside the quality of the mesh or the accuracy of the surface, for dsc and other programs."""
    if not runs:
        return "Other programs are left out: this build has no dsc_bench_peers.\n"
    versions = ", ".join(f"{name} {version or 'left out'}" for name, version in runs[0]["versions"].items())
    quality = [(key, same) for key in ("vertices", "tets", "least_quality", "low_quality", "least_dihedral")]
    before = runs[0]["remeshing"]["before"]
    remeshing = [["the mesh before", "", "", "", *(text([before[key]]) for key, text in quality), ""]]
    remeshing += peer_rows([run["remeshing"] for run in runs], [],
                           [("cpu_s", spread), ("wall_s", spread), ("us_per_vertex", spread), *quality, ("ball_change_percent", change)])
    surfaces = []
    for i, first in enumerate(runs[0]["reconstruction"]):
        surfaces += peer_rows([run["reconstruction"][i] for run in runs], [f"{first['shape']}, {first['points']:,} points"],
                              [("cpu_s", spread), ("wall_s", spread), *((key, same) for key in (
                                  "chamfer_percent", "hausdorff99_percent", "vertices", "boundary_edges", "shells", "genus"))])
    return "\n\n".join([
        f"Versions: {versions}. One thread each.",
        markdown(["one pass over a mesh", "CPU s", "wall s", "us a vertex", "vertices", "tets", "least quality", "5 % quality", "least dihedral", "ball %"],
                 remeshing),
        markdown(["cloud", "program", "CPU s", "wall s", "Chamfer %", "Hausdorff 99 %", "vertices", "boundary edges", "shells", "genus"], surfaces)])


def replace_measured(page, text):
    """The page with `text` between its markers."""
    if page.count(BEGIN) != 1 or page.count(END) != 1 or page.index(BEGIN) > page.index(END):
        raise ValueError(f"the page must have one line '{BEGIN}' and, below it, one line '{END}'")
    return page[:page.index(BEGIN) + len(BEGIN)] + "\n" + text.strip() + "\n" + page[page.index(END):]


def everything(bench, build):
    load = os.getloadavg()[0]
    clouds = {"built-in teapot": bench.protocol("the built-in teapot")}
    if os.environ.get("DSC_DATA"):
        for name in ("teapot", "bunny", "cow"):
            if (Path(os.environ["DSC_DATA"]) / f"{name}.obj").exists():
                clouds[f"{name}, as configs/thesis/{name}.yaml"] = bench.protocol(name, "--data", "--name", name, "--no-idle")
    parts = [f"Measured on: {machine(build)}; one thread unless another number is given. Median [least, largest] of {bench.repetitions} runs. The machine's load "
             f"before them was {load:.1f}: well below 1 is quiet.",
             "### The thesis' protocol", protocol_tables(clouds),
             "### Settled, idle and one-vertex steps", quiet_table(clouds["built-in teapot"]),
             "### Growth with the interface", scaling_table(bench.scaling()), bench.instructions(),
             "### Threads", threads_table(bench.threads()),
             "### Beside other programs", peers_tables(bench.peers()),
             "### Single operations", bench.micro()]
    return "\n\n".join(part.strip() for part in parts)


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--page", type=Path, required=True)
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args(words)
    text = everything(Bench(arguments.build, arguments.repetitions, arguments.quick), arguments.build)
    if arguments.quick:
        print(text)
    else:
        arguments.page.write_text(replace_measured(arguments.page.read_text(), text))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
