#!/usr/bin/env python3
"""Runs every wrong experiment of errors/ and compares all that the program says with the golden text beside it.

    errors.py --program dsc [--plugin libdsc_every_field.so] [--update] [NAME...]

NAME.txt holds the exit code in its first line and the whole of stderr below it. Where NAME.yaml starts with a line
`# arguments: WORD...` or `# environment: NAME=VALUE...`, the command gets these. --update writes the golden texts: read
them, they are what a user reads.
"""

import argparse
import difflib
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent / "errors"


def header(text, word):
    """The words of a line `# word: ...` at the top of an experiment."""
    match = re.match(rf"# {word}: (.*)", text)
    return match.group(1).split() if match else []


def run(program, plugin, case):
    """(the golden text of a case, what the run did that none of them may do)."""
    text = case.read_text(encoding="utf-8")
    environment = {"PATH": os.environ.get("PATH", ""), "XDG_DATA_HOME": "/nonexistent", "LC_ALL": "C"}
    environment.update(word.split("=", 1) for word in header(text, "environment"))
    arguments = [plugin if word == "EVERY_FIELD" else word for word in header(text, "arguments")]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        result = subprocess.run([program, "run", case.name, *arguments, "-o", str(out)], cwd=HERE, env=environment,
                                stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        left = out.exists()
    said = result.stderr.replace(str(HERE), "DIR")
    faults = []
    if result.returncode == 0:
        faults.append("the experiment was accepted")
    if result.stdout:
        faults.append(f"it wrote to stdout: {result.stdout[:200]}")
    if left:
        faults.append("it left a run folder")
    return f"exit code {result.returncode}\n{said}", faults


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", required=True, type=lambda text: str(Path(text).resolve()), help="the command dsc")
    parser.add_argument("--plugin", default="", type=lambda text: str(Path(text).resolve()), help="the library for EVERY_FIELD")
    parser.add_argument("--update", action="store_true", help="write the golden texts")
    parser.add_argument("names", nargs="*", help="cases; default all")
    options = parser.parse_args(arguments)
    cases = sorted(HERE.glob("*.yaml"))
    unknown = set(options.names) - {case.stem for case in cases}
    if unknown:
        print(f"no such case: {', '.join(sorted(unknown))}", file=sys.stderr)
        return 2
    wrong = 0
    for case in cases:
        if options.names and case.stem not in options.names:
            continue
        text, faults = run(options.program, options.plugin, case)
        golden = case.with_suffix(".txt")
        if options.update and not faults:
            golden.write_text(text, encoding="utf-8")
        expected = golden.read_text(encoding="utf-8") if golden.exists() else ""
        difference = list(difflib.unified_diff(expected.splitlines(), text.splitlines(), "golden", "said", lineterm=""))
        if faults or difference:
            wrong += 1
            print("\n".join([f"{case.stem}: " + "; ".join(faults), *difference, ""]))
    orphans = sorted(path.name for path in HERE.glob("*.txt") if not path.with_suffix(".yaml").exists())
    if orphans:
        print(f"golden texts without an experiment: {', '.join(orphans)}")
    print(f"{len(cases)} wrong experiments, {wrong} not as recorded")
    if wrong and not options.update:
        print("where the new text is right: tests/golden/errors.py --update with the same --program and --plugin")
    return 1 if wrong or orphans else 0


if __name__ == "__main__":
    sys.exit(main())
