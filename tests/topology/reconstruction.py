"""One `dsc reconstruct` of a cloud, judged by the surface that it writes, and the tables that runs of many clouds print."""

import json
import os
import re
import shutil
import subprocess
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from surfaces import Topology, read_mesh, topology

WARNINGS_KEY = "warnings"  # of summary.json: a list of texts, or of objects with the keys below
WARNING_TEXTS = ("code", "type", "text", "message")
ANY_WARNING = "."


@dataclass
class Outcome:
    """What became of one cloud."""

    name: str
    group: str  # the shape, or the cloud that a pose was made from
    kind: str
    expected: Topology
    got: Topology | None = None  # none where dsc failed
    told: Topology | None = None  # what `dsc info` says of the same surface
    warnings: list = field(default_factory=list)
    seconds: float = 0.0  # of all processors, for dsc reconstruct
    fault: str = ""  # why there is no result, or what is wrong beside the topology

    def right(self):
        return self.got == self.expected and not self.fault

    def flagged(self, pattern):
        return any(re.search(pattern, w) for w in self.warnings)


def run_measured(command, log):
    """Exit code and processor seconds of a command whose output goes to a file."""
    with open(log, "w", encoding="utf-8") as out:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime


def warnings_of(folder):
    """The warnings in a run's summary as texts."""
    file = Path(folder) / "summary.json"
    listed = json.loads(file.read_text(encoding="utf-8")).get(WARNINGS_KEY, []) if file.exists() else []
    return [w if isinstance(w, str) else " ".join(str(w[k]) for k in WARNING_TEXTS if k in w) or str(w) for w in listed]


def told_by_info(dsc, surface):
    """Topology as `dsc info --json` tells it."""
    done = subprocess.run([dsc, "info", "--json", surface], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None
    told = json.loads(done.stdout)
    closed = told["boundary_edges"] == told["nonmanifold_edges"] == told["misoriented_edges"] == 0
    return Topology(told["components"], told["cavities"], told["genus"], closed, closed and told["nonmanifold_vertices"] == 0)


def reconstruct(dsc, cloud, folder, threads=1, options=(), volume=False):
    """Runs dsc on a cloud; `folder`/surface.obj (and volume.dsc) is the result. Fills got, told, warnings, seconds, fault."""
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    surface, run = folder / "surface.obj", folder / "run"
    outputs = ["-o", surface, *(["-o", folder / "volume.dsc"] if volume else [])]
    command = [dsc, "reconstruct", cloud, *outputs, "--keep-run", run, "--threads", str(threads), "-q", *options]
    code, seconds = run_measured(command, folder / "log.txt")
    warnings = warnings_of(run)
    shutil.rmtree(run, ignore_errors=True)
    result = {"seconds": seconds, "warnings": warnings}
    if code != 0 or not surface.exists():
        return {**result, "fault": f"dsc ended with code {code}, see {folder / 'log.txt'}"}
    got, told = topology(*read_mesh(surface)), told_by_info(dsc, surface)
    return {**result, "got": got, "told": told, "fault": "" if got == told else f"dsc info reports {told}, but the count is {got}"}


def each(jobs, work, items):
    """`work` of every item in the items' order, several at a time; yields as they come in that order."""
    with ThreadPoolExecutor(jobs) as pool:
        yield from pool.map(work, items)


def line(outcome, pattern):
    """A row of the table."""
    flag = "flagged" if outcome.flagged(pattern) else ""
    return (f"{outcome.name:32} {str(outcome.expected):12} {str(outcome.got or '-'):20} {'right' if outcome.right() else 'WRONG':6}"
            f" {flag:8} {outcome.seconds:8.1f}  {outcome.fault}")


HEADER = f"{'cloud':32} {'expected':12} {'got':20} {'':6} {'':8} {'CPU s':>8}"


def share(part, whole):
    return f"{part} of {whole}" + (f" ({100 * part / whole:.0f} %)" if whole else "")


def rates(outcomes, pattern):
    """The lines below the table."""
    for title, key in (("per shape", lambda o: o.group), ("per kind", lambda o: o.kind)):
        groups = defaultdict(list)
        for outcome in outcomes:
            groups[key(outcome)].append(outcome)
        yield f"right {title}:"
        for name, members in groups.items():
            yield f"    {name:28} {share(sum(o.right() for o in members), len(members))}"
    right = [o for o in outcomes if o.right()]
    wrong = [o for o in outcomes if not o.right()]
    yield f"right in all:        {share(len(right), len(outcomes))}"
    yield f"wrong and flagged:   {share(sum(o.flagged(pattern) for o in wrong), len(wrong))} wrong ones"
    yield f"right yet flagged:   {share(sum(o.flagged(pattern) for o in right), len(right))} right ones"
    yield f"CPU seconds:         {sum(o.seconds for o in outcomes):.1f}, most {max((o.seconds for o in outcomes), default=0):.1f}"


def as_json(outcomes, pattern):
    """For later comparison, one object per cloud."""
    rows = [{"name": o.name, "kind": o.kind, "expected": str(o.expected), "got": str(o.got), "right": o.right(),
             "flagged": o.flagged(pattern), "warnings": o.warnings, "seconds": round(o.seconds, 2), "fault": o.fault}
            for o in outcomes]
    return json.dumps(rows, indent=1) + "\n"


def add_options(parser):
    """Those that every program of the suite shares."""
    parser.add_argument("--dsc", required=True, help="the command to judge")
    parser.add_argument("--work", type=Path, default=Path("topology-work"), help="folder for truth meshes, clouds and results")
    parser.add_argument("--jobs", type=int, default=1, help="clouds at the same time")
    parser.add_argument("--threads", type=int, default=1, help="of each dsc")
    parser.add_argument("--option", action="append", default=[], help="passed on to dsc reconstruct, as --option=--detail=low")
    parser.add_argument("--flag", default=ANY_WARNING, help="regular expression of the warnings that count as a flag")
    parser.add_argument("--json", type=Path, help="file for the outcomes")
    parser.add_argument("--require", type=float, default=0.0, help="exit with 1 where a smaller share is right")


def finish(outcomes, options):
    """Prints the rates, writes the file, and returns the exit code."""
    for text in rates(outcomes, options.flag):
        print(text)
    if options.json:
        options.json.write_text(as_json(outcomes, options.flag), encoding="utf-8")
    if not outcomes:
        print("no cloud matches")
        return 2
    reached = sum(o.right() for o in outcomes) / len(outcomes)
    if reached < options.require:
        print(f"FAILED: {reached:.3f} are right, {options.require} are required")
        return 1
    return 0
