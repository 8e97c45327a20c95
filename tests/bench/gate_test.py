#!/usr/bin/env python3
"""The gate can fail: gate.py against a valgrind and a program made of stand-ins, with a count that is too high."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import gate

HERE = Path(__file__).resolve().parent
VALGRIND = """#!/bin/sh
[ "$1" != --version ] || { echo valgrind-3.0; exit 0; }
for word; do :; done
[ ! -e "$(dirname "$0")/breaks" ] || { echo "the work went wrong" >&2; exit 5; }
echo "==1== Collected : $(cat "$(dirname "$0")/count.$word")" >&2
cat "$(dirname "$0")/result"
"""
PROGRAM = """#!/bin/sh
case "$1" in
    --list) echo one; echo two ;;
    --build) cat "$(dirname "$0")/build" ;;
esac
"""


class Comparison(unittest.TestCase):
    def verdict(self, now):
        (row,) = gate.compare({"work": 1_000_000}, {"work": now})
        return row.verdict, bool(gate.failures([row]))

    def test_two_percent_more_fails(self):
        self.assertEqual(self.verdict(1_020_000), ("SLOWER", True))

    def test_the_border_is_one_percent(self):
        self.assertEqual(self.verdict(1_010_000), ("ok, but more", False))
        self.assertEqual(self.verdict(1_010_001), ("SLOWER", True))

    def test_as_much_or_less_passes(self):
        self.assertEqual(self.verdict(1_000_000), ("ok", False))
        self.assertEqual(self.verdict(500_000), ("faster: record it", False))

    def test_a_scenario_without_a_number_and_a_number_without_a_scenario_fail(self):
        rows = gate.compare({"old": 1}, {"new": 1})
        self.assertEqual({row.scenario: row.verdict for row in gate.failures(rows)}, {"old": "GONE", "new": "UNRECORDED"})

    def test_every_condition_that_differs_is_named(self):
        here = {"build": "GNU 13", "libc": "glibc 2"}
        self.assertEqual(gate.differences({"build": "GNU 12", "libc": "glibc 2"}, here), ["build: recorded 'GNU 12', here 'GNU 13'"])
        self.assertEqual(gate.differences(here, here), [])


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, self.folder)
        for name, text in (("valgrind", VALGRIND), ("dsc_gate", PROGRAM)):
            self.put(name, text)
            (self.folder / name).chmod(0o755)
        self.put("build", "GNU 12")
        self.put("result", "10 tets\n")
        self.counts(100_000, 200_000)

    def put(self, name, text):
        (self.folder / name).write_text(text)

    def counts(self, one, two):
        self.put("count.one", str(one))
        self.put("count.two", str(two))

    def gate(self, *words, path=None):
        environment = {**os.environ, "PATH": path or f"{self.folder}:{os.environ['PATH']}"}
        return subprocess.run([sys.executable, str(HERE / "gate.py"), "--program", str(self.folder / "dsc_gate"),
                               "--numbers", str(self.folder / "gate.json"), *words],
                              capture_output=True, text=True, env=environment, timeout=60, check=False)

    def test_a_planted_two_percent_fails_and_is_named(self):
        self.assertEqual(self.gate("--update").returncode, 0)
        self.assertEqual(self.gate().returncode, 0)
        self.counts(100_000, 204_000)
        result = self.gate()
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"two +200,000 +204,000 +\+2\.00 % +SLOWER")
        self.assertEqual(self.gate("one").returncode, 0)
        self.assertEqual(self.gate("two").returncode, 1)

    def test_an_update_of_one_scenario_keeps_the_others(self):
        self.gate("--update")
        self.counts(50_000, 50_000)
        self.assertEqual(self.gate("--update", "one").returncode, 0)
        numbers = json.loads((self.folder / "gate.json").read_text())["scenarios"]
        self.assertEqual([numbers[name]["instructions"] for name in ("one", "two")], [50_000, 200_000])

    def test_another_compiler_is_skipped_with_the_reason(self):
        self.gate("--update")
        self.put("build", "Clang 14")
        result = self.gate()
        self.assertEqual(result.returncode, gate.SKIPPED)
        self.assertIn("SKIPPED: ", result.stdout)
        self.assertIn("build: recorded 'GNU 12', here 'Clang 14'", result.stdout)

    def test_without_valgrind_it_is_skipped_with_the_reason(self):
        empty = self.folder / "empty"
        empty.mkdir()
        result = self.gate(path=str(empty))
        self.assertEqual(result.returncode, gate.SKIPPED)
        self.assertIn("SKIPPED: valgrind is not installed", result.stdout)

    def test_a_result_that_changed_is_told(self):
        self.gate("--update")
        self.put("result", "11 tets\n")
        self.assertIn("one: another result", self.gate().stdout)

    def test_work_that_breaks_or_counts_nothing_fails(self):
        self.gate("--update")
        self.counts(0, 200_000)
        self.assertEqual(self.gate().returncode, 1)
        self.put("breaks", "")
        result = self.gate()
        self.assertEqual(result.returncode, 1)
        self.assertIn("the work went wrong", result.stdout)


if __name__ == "__main__":
    unittest.main()
