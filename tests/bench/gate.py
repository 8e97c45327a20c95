#!/usr/bin/env python3
"""Counts the instructions of small fixed scenarios and compares them with recorded numbers.

    gate.py --program dsc_gate [--numbers gate.json] [--update] [scenarios...]

Exits 1 if a scenario takes over 1 % more instructions than recorded, 77 (skipped) where the numbers cannot be compared:
without valgrind, or with another compiler, other flags, another C library or processor level than the recorded ones.
Only what runs inside the function dsc_measured counts, so neither start-up nor set-up does. --update records.
"""

import argparse
import json
import os
import platform
import re
import shutil
import subprocess
import sys
from collections import namedtuple
from pathlib import Path

SKIPPED = 77
ALLOWED = 0.01
NOTED = 0.003
Row = namedtuple("Row", "scenario recorded counted change verdict")


class Unusable(Exception):
    """The program could not be measured."""


def count_instructions(command, out=os.devnull):
    """(instructions inside dsc_measured, standard output) of a command under callgrind."""
    # Symbols are bound before the work begins; what the loader does is not part of it.
    environment = {"PATH": os.environ.get("PATH", ""), "LC_ALL": "C", "LD_BIND_NOW": "1"}
    result = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=dsc_measured", f"--callgrind-out-file={out}", *command],
                            capture_output=True, text=True, env=environment, check=False)
    collected = re.search(r"Collected\s*:\s*(\d+)", result.stderr)
    if result.returncode != 0 or not collected or int(collected.group(1)) == 0:
        raise Unusable(f"{' '.join(map(str, command))} under valgrind: exit code {result.returncode}\n{result.stderr.strip()[-2000:]}")
    return int(collected.group(1)), result.stdout.strip()


def processor_level():
    """What run-time dispatch in the C library looks at."""
    try:
        flags = re.search(r"^flags\s*:(.*)$", Path("/proc/cpuinfo").read_text(), re.M).group(1).split()
    except (OSError, AttributeError):
        return "unknown"
    return "avx2 and fma" if {"avx2", "fma"} <= set(flags) else "no avx2 and fma"


def conditions(program):
    """Everything that instruction counts depend on besides the sources."""
    build = subprocess.run([program, "--build"], capture_output=True, text=True, check=True).stdout.strip()
    valgrind = subprocess.run(["valgrind", "--version"], capture_output=True, text=True, check=True).stdout.strip()
    return {"build": build, "libc": " ".join(platform.libc_ver()), "valgrind": valgrind, "processor": processor_level()}


def differences(recorded, here):
    """One line a condition that is not as recorded."""
    return [f"{key}: recorded '{recorded.get(key, '')}', here '{here[key]}'" for key in here if recorded.get(key) != here[key]]


def compare(recorded, counted, allowed=ALLOWED):
    """Rows for all scenarios of both dictionaries; the verdicts SLOWER, UNRECORDED and GONE are failures."""
    rows = []
    for scenario in sorted(set(recorded) | set(counted)):
        before, now = recorded.get(scenario), counted.get(scenario)
        if before is None or now is None:
            rows.append(Row(scenario, before, now, None, "UNRECORDED" if before is None else "GONE"))
            continue
        change = (now - before) / before
        if change > allowed:
            verdict = "SLOWER"
        elif change > NOTED:
            verdict = "ok, but more"
        elif change < -allowed:
            verdict = "faster: record it"
        else:
            verdict = "ok"
        rows.append(Row(scenario, before, now, change, verdict))
    return rows


def failures(rows):
    return [row for row in rows if row.verdict in ("SLOWER", "UNRECORDED", "GONE")]


def table(rows):
    number = lambda n: "-" if n is None else f"{n:,}"  # noqa: E731
    lines = [f"{'scenario':<12}{'recorded':>16}{'counted':>16}{'change':>9}  verdict"]
    for row in rows:
        change = "-" if row.change is None else f"{100 * row.change:+.2f} %"
        lines.append(f"{row.scenario:<12}{number(row.recorded):>16}{number(row.counted):>16}{change:>9}  {row.verdict}")
    return "\n".join(lines)


def run(arguments):
    if not shutil.which("valgrind"):
        print("SKIPPED: valgrind is not installed, so no instructions can be counted")
        return SKIPPED
    numbers = json.loads(arguments.numbers.read_text()) if arguments.numbers.exists() else {"conditions": {}, "scenarios": {}}
    here = conditions(arguments.program)
    other = differences(numbers["conditions"], here)
    if other and not arguments.update:
        print("SKIPPED: the recorded numbers hold for other conditions; gate.py --update records these")
        print("\n".join(f"  {line}" for line in other))
        return SKIPPED
    if other and arguments.scenarios:
        print("the conditions have changed: --update must count all scenarios")
        return 2
    everything = subprocess.run([arguments.program, "--list"], capture_output=True, text=True, check=True).stdout.split()
    results = {name: count_instructions([arguments.program, name]) for name in arguments.scenarios or everything}
    counted = {name: count for name, (count, _) in results.items()}
    recorded = {name: entry["instructions"] for name, entry in numbers["scenarios"].items()
                if not arguments.scenarios or name in arguments.scenarios}
    rows = compare(recorded, counted)
    print(table(rows))
    for name, (_, result) in results.items():
        before = numbers["scenarios"].get(name, {}).get("result")
        if before not in (None, result):
            print(f"{name}: another result, so another piece of work: recorded '{before}', now '{result}'")
    if arguments.update:
        kept = {} if not arguments.scenarios else numbers["scenarios"]
        entries = {**kept, **{name: {"instructions": count, "result": result} for name, (count, result) in results.items()}}
        arguments.numbers.write_text(json.dumps({"conditions": here, "scenarios": dict(sorted(entries.items()))}, indent=2) + "\n")
        return 0
    return 1 if failures(rows) else 0


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--numbers", type=Path, default=Path(__file__).with_name("gate.json"))
    parser.add_argument("--update", action="store_true")
    parser.add_argument("scenarios", nargs="*")
    try:
        return run(parser.parse_args(words))
    except Unusable as error:
        print(f"gate: {error}")
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
