#!/usr/bin/env python3
"""A sweep of 12 points on a real engine: a third of the points are killed midway, then the same command runs again.

    engine_test.py parallel|snakemake|slurm_array|snakemake_slurm

In the end 12 of 12 must be done, and the files of those that were done the first time must be the very same files. Needs
DSC_TEST_COMMAND, the dsc to use. Exits 77 where the engine is not installed.
"""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import one_node

ROOT = Path(__file__).resolve().parent.parent.parent
WORKFLOW = ROOT / "share/workflow"
DSC = os.environ["DSC_TEST_COMMAND"]

BASE = """\
dsc: 1
initial_mesh: {type: grid, cells: 16, shape: cube, half_width: 0.8}
velocity: {type: average, part: 0.5}
improvement: {type: dsc}
schedule: [{steps: 60}]
output: {surface: [obj], volume: [dsc]}
"""
SWEEP = """\
sweep: 1
base: base.yaml
axes: [{grid: {velocity.part: {from: 0.05, to: 0.3, count: 6}, initial_mesh.cells: [16, 18]}}]
"""


def state(point):
    try:
        return json.loads((point / "run/status.json").read_text(encoding="utf-8"))["state"]
    except OSError:
        return "missing"


def traces(point):
    """Which files a run has left, when it wrote them, and when it was started: a second run changes all of it."""
    files = {path.relative_to(point).as_posix(): (path.stat().st_ino, path.stat().st_mtime_ns)
             for path in (point / "run").rglob("*") if path.is_file()}
    return files, json.loads((point / "run/status.json").read_text(encoding="utf-8"))["started"]


def process_of(point):
    """The id of the dsc that carries out a point, 0 for none."""
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if os.path.samefile(folder / "exe", DSC) and any(w.endswith(f"{point.name}/experiment.yaml".encode()) for w in words):
                return int(folder.name)
        except OSError:
            pass  # it has ended, or is somebody else's
    return 0


class Killer(threading.Thread):
    """Kills the runs of some points, each once, when it has made a few steps."""

    def __init__(self, points):
        super().__init__(daemon=True)
        self.waiting = list(points)
        self.killed = []
        self.over = threading.Event()

    def run(self):
        while self.waiting and not self.over.is_set():
            for point in list(self.waiting):
                metrics = point / "run/metrics.csv"
                if metrics.exists() and metrics.read_text(encoding="utf-8").count("\n") >= 4:
                    self.kill(point)
            time.sleep(0.01)

    def kill(self, point):
        process = process_of(point)
        if process and state(point) == "running":
            os.kill(process, signal.SIGKILL)
            self.waiting.remove(point)
            self.killed.append(point)


class Engine:
    """Runs the command of an engine over a sweep until nothing goes on any more; gives its exit code."""

    def __init__(self, folder, slurm):
        self.sweep = folder / "sweep"
        self.slurm = slurm
        environment = slurm.environment if slurm else os.environ
        self.environment = {**environment, "DSC": DSC, "HOME": str(folder), "USER": environment.get("USER", "nobody")}
        for name in ("DSC_PLUGIN_PATH", "DSC_DATA"):
            self.environment.pop(name, None)

    def __call__(self, *command):
        done = subprocess.run([str(word) for word in command], cwd=self.sweep.parent, env=self.environment, timeout=800,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.said = done.stdout
        if self.slurm:
            self.slurm.wait_for_jobs(600)
        return done.returncode

    def parallel(self):
        return self("parallel", "--will-cite", "-j", 2, "--header", ":", "--colsep", r"\t", WORKFLOW / "run_point.sh",
                    "sweep/{folder}", "--threads", 1, "-q", "::::", "sweep/jobs.tsv")

    def snakemake(self, *more):
        return self("snakemake", "-s", WORKFLOW / "Snakefile", "-d", self.sweep, "-j", 2, "--keep-going", *more)

    def snakemake_slurm(self):
        return self.snakemake("--slurm", "-j", 12, "--max-status-checks-per-second", 1)

    def slurm_array(self):
        return self(WORKFLOW / "slurm_array.sh", "sweep")


# What must be installed, and whether the engine's exit code says that points have failed.
ENGINES = {"parallel": (["parallel", "flock"], True), "snakemake": (["snakemake", "flock"], True),
           "slurm_array": (["flock", *one_node.PROGRAMS], False),
           "snakemake_slurm": (["snakemake", "flock", *one_node.PROGRAMS], True)}


def expect(holds, what, engine):
    if not holds:
        raise SystemExit(f"FAILED: {what}\n{engine.said}")


def show(name, engine, reports_failure):
    points = [engine.sweep / row["folder"] for row in csv.DictReader(
        (engine.sweep / "jobs.tsv").read_text(encoding="utf-8").splitlines(), delimiter="\t", quoting=csv.QUOTE_NONE)]
    run = getattr(engine, name)
    victims = points[1::3]
    killer = Killer(victims)
    killer.start()
    code = run()
    killer.over.set()
    killer.join()
    finished = [point for point in points if state(point) == "done"]
    expect(sorted(killer.killed) == sorted(victims), f"{len(killer.killed)} runs were killed instead of 4", engine)
    expect(sorted(finished) == sorted(set(points) - set(victims)),
           f"{len(finished)} points are done after the first call instead of the 8 that nobody killed", engine)
    expect(all(state(point) == "running" and not (point / "run/result").exists() for point in victims),
           "a killed run looks finished", engine)
    expect((code != 0) == reports_failure, f"the first call ended with {code}", engine)
    before = {point: traces(point) for point in finished}

    expect(run() == 0, "the second call failed", engine)
    expect(all(state(point) == "done" for point in points),
           f"{sum(state(p) == 'done' for p in points)} of 12 points are done after the second call", engine)
    twice = [point.name for point in finished if traces(point) != before[point]]
    expect(not twice, f"finished points ran twice: {twice}", engine)

    everything = {point: traces(point) for point in points}
    expect(run() == 0, "the third call failed", engine)
    expect({point: traces(point) for point in points} == everything, "a third call ran something again", engine)
    table = subprocess.run([DSC, "sweep", "collect", engine.sweep], stdout=subprocess.PIPE, text=True, check=True).stdout
    rows = list(csv.DictReader(table.splitlines()))
    expect(len(rows) == 12 and all(row["status"] == "done" and row["steps"] == "60" for row in rows),
           "the table does not have 12 points that are done", engine)
    print(f"{name}: 4 of 12 points killed, then 12 of 12 done, none of the {len(finished)} finished ones run twice")


def main(name):
    programs, reports_failure = ENGINES[name]
    missing = [program for program in programs if shutil.which(program, path=one_node.path()) is None]
    if missing:
        print(f"SKIPPED: {name} needs {', '.join(missing)}; share/setup.sh test --full installs the packages")
        return 77
    with tempfile.TemporaryDirectory(prefix="dsc-sweep-") as scratch:
        folder = Path(scratch)
        (folder / "base.yaml").write_text(BASE, encoding="utf-8")
        (folder / "sweep.yaml").write_text(SWEEP, encoding="utf-8")
        subprocess.run([DSC, "sweep", "expand", "sweep.yaml", "-o", "sweep"], cwd=folder, check=True)
        if "slurm" in name:
            with one_node.OneNode(folder / "slurm") as slurm:
                show(name, Engine(folder, slurm), reports_failure)
        else:
            show(name, Engine(folder, None), reports_failure)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
