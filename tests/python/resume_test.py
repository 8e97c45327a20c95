#!/usr/bin/env python3
"""A run with a strategy in Python is killed at random moments and continued; its bytes do not change."""

import hashlib
import os
import pathlib
import random
import signal
import subprocess
import sys
import time
import unittest

import common

STRATEGIES = '''"""Strategies with state."""
import numpy
import dsc


@dsc.velocity("heavy")
class Heavy:
    """Attraction with momentum, state as JSON."""
    rigid = False

    def __init__(self):
        self.momentum = numpy.zeros(3)

    def advance(self, context):
        self.momentum = 0.5 * self.momentum + 0.05 * self.pull(context).mean(axis=0)

    def pull(self, context):
        return context.cloud.points[context.nearest_index] - context.positions

    def evaluate(self, context):
        jitter = 1e-3 * context.normal(context.births, 3)
        return 0.2 * self.pull(context) + self.momentum + jitter

    def state(self):
        return self.momentum.tolist()

    def load(self, state):
        self.momentum = numpy.array(state)


@dsc.observer("count")
class Count:
    """Counts vertices over all steps, state as bytes."""
    def __init__(self):
        self.total = 0

    def step(self, context, figures):
        self.total += len(context.positions)
        return {"total": self.total}

    def state(self):
        return self.total.to_bytes(8, "little")

    def load(self, state):
        self.total = int.from_bytes(state, "little")
'''
EXPERIMENT = """dsc: 1
name: killed
plugins: [{python: heavy.py}]
input: {cloud: {sample: {shape: teapot, n: 2000}}, normalize: {}}
initial_mesh: {type: grid, cells: 16}
velocity: {type: heavy}
improvement: {type: dsc}
schedule: [{steps: 15}, {refine: {type: average_area}}, {steps: 10}]
observers: [{type: count}]
output: {checkpoint: {every: 2, keep: 2}}
"""
SAME = ("result/surface.obj", "result/volume.dsc", "metrics.csv", "events.jsonl", "config.resolved.yaml")
KILLS = 6


class Kill(common.Scratch):
    def test_killed_runs_give_the_same_bytes(self):
        pathlib.Path("heavy.py").write_text(STRATEGIES, encoding="utf-8")
        pathlib.Path("a.yaml").write_text(EXPERIMENT, encoding="utf-8")
        begin = time.monotonic()
        self.dsc("run", "a.yaml", "-o", "whole", "-q")
        seconds = time.monotonic() - begin
        moments = random.Random(5)
        continued = 0
        for kill in range(KILLS):
            folder = f"killed{kill}"
            for _ in range(2):
                child = subprocess.Popen([common.PROGRAM, "run", "a.yaml", "-o", folder, "-q", "--resume"])
                time.sleep(seconds * moments.uniform(0.3, 0.7))
                child.send_signal(signal.SIGKILL)
                child.wait()
            continued += os.path.isdir(folder + "/checkpoint") and bool(os.listdir(folder + "/checkpoint"))
            self.dsc("run", "a.yaml", "-o", folder, "-q", "--resume", "--threads", str(1 + kill % 2))
            self.assertEqual(digests(folder), digests("whole"), folder)
        self.assertGreater(continued, KILLS // 2)

    def test_a_changed_file_is_another_run(self):
        pathlib.Path("heavy.py").write_text(STRATEGIES, encoding="utf-8")
        pathlib.Path("a.yaml").write_text(EXPERIMENT, encoding="utf-8")
        self.dsc("run", "a.yaml", "-o", "run", "-q", "--time-budget", "0.01", expect=75)
        pathlib.Path("heavy.py").write_text(STRATEGIES.replace("0.2 *", "0.3 *"), encoding="utf-8")
        said = self.dsc("run", "a.yaml", "-o", "run", "--resume", expect=2)
        self.assertIn("another experiment", said)


def digests(folder):
    return {name: hashlib.sha256((pathlib.Path(folder) / name).read_bytes()).hexdigest() for name in SAME}


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
