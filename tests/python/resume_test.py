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
POLITE = '''"""A strategy that can be stopped."""
import os
import pathlib
import dsc


@dsc.velocity("heavy")
class Polite:
    """Attraction with momentum; in step 3 it may wait until it is told to stop, and then gives no motion."""
    rigid = False

    def __init__(self):
        self.speed = 0.0

    def advance(self, context):
        self.speed = 0.5 * self.speed + 0.1
        if context.step == 3 and "POLITE_WAITS" in os.environ:
            pathlib.Path("waiting").touch()
            while not context.cancelled:
                pass

    def evaluate(self, context):
        if context.cancelled:
            return 0 * context.positions
        return self.speed * (context.cloud.points[context.nearest_index] - context.positions)

    def state(self):
        return self.speed

    def load(self, state):
        self.speed = state
'''
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
        self.assertIn(f"the content of {os.path.realpath('heavy.py')} has changed", said)

    def test_a_changed_file_is_named_wherever_it_was_found(self):
        pathlib.Path("heavy.py").write_text(STRATEGIES, encoding="utf-8")
        pathlib.Path("a.yaml").write_text(EXPERIMENT.replace("plugins: [{python: heavy.py}]\n", ""), encoding="utf-8")
        run = ("run", "a.yaml", "schedule=[{steps: 3}]", "output.checkpoint={every: 1, keep: 2}", "-q", "--plugin", "heavy.py")
        self.dsc(*run, "-o", "done")
        self.assertEqual(self.dsc(*run, "-o", "done", "--resume"), "done\n")
        before = pathlib.Path("done/status.json").read_bytes()
        pathlib.Path("heavy.py").write_text(STRATEGIES.replace("0.2 *", "0.3 *"), encoding="utf-8")
        said = self.dsc(*run, "-o", "done", "--resume", expect=2)
        self.assertIn(f"{os.path.realpath('heavy.py')}, which provides velocity 'heavy'", said)
        self.assertEqual(pathlib.Path("done/status.json").read_bytes(), before)
        pathlib.Path("heavy.py").write_text(STRATEGIES, encoding="utf-8")
        self.assertEqual(self.dsc(*run, "-o", "done", "--resume"), "done\n")

    def test_a_changed_program_is_another_run(self):
        program = STRATEGIES + f"""
import sys
EXPERIMENT = {EXPERIMENT.replace("plugins: [{python: heavy.py}]", "")!r}
open("p.yaml", "w").write(EXPERIMENT)
try:
    dsc.run("p.yaml", {{"schedule": [{{"steps": 4}}], "output.checkpoint.every": 1}}, output="run", resume="resume" in sys.argv,
            on_step=lambda row: row["step"] < 2)
except dsc.UsageError as error:
    print(error.code, error.cause)
"""
        pathlib.Path("program.py").write_text(program, encoding="utf-8")
        self.assertEqual(self.program(), "")
        self.assertEqual(self.program("resume"), "")
        pathlib.Path("program.py").write_text(program.replace("0.2 *", "0.3 *"), encoding="utf-8")
        said = self.program("resume")
        self.assertIn("run.resume", said)
        self.assertIn(f"{os.path.realpath('program.py')}, which provides velocity 'heavy'", said)

    def program(self, *words):
        return subprocess.run([sys.executable, "program.py", *words], capture_output=True, text=True, check=True).stdout

    # A step that a strategy leaves early does not count.

    def polite(self, folder, *more):
        pathlib.Path("polite.py").write_text(POLITE, encoding="utf-8")
        pathlib.Path("p.yaml").write_text(EXPERIMENT.replace("heavy.py", "polite.py").replace("every: 2", "every: 1"),
                                          encoding="utf-8")
        return [common.PROGRAM, "run", "p.yaml", "-o", folder, "-q", "observers=[]", "schedule=[{steps: 5}]", *more]

    def test_an_answer_after_ctrl_c_is_discarded(self):
        subprocess.run(self.polite("whole"), check=True, stdout=subprocess.DEVNULL)
        child = subprocess.Popen(self.polite("stopped"), stdout=subprocess.DEVNULL, env={**os.environ, "POLITE_WAITS": "1"},
                                 preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        while child.poll() is None and not pathlib.Path("waiting").exists():
            time.sleep(0.05)
        child.send_signal(signal.SIGINT)
        self.assertEqual((child.wait(), self.steps("stopped")), (75, 2))
        subprocess.run(self.polite("stopped", "--resume"), check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(digests("stopped"), digests("whole"))

    def test_an_answer_after_the_time_budget_is_discarded(self):
        subprocess.run(self.polite("whole"), check=True, stdout=subprocess.DEVNULL)
        environment = {**os.environ, "POLITE_WAITS": "1"}
        done = subprocess.run(self.polite("stopped", "--time-budget", "8s"), check=False, stdout=subprocess.DEVNULL, env=environment)
        self.assertEqual((done.returncode, self.steps("stopped")), (75, 2))
        subprocess.run(self.polite("stopped", "--resume"), check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(digests("stopped"), digests("whole"))

    def steps(self, folder):
        rows = pathlib.Path(folder, "metrics.csv").read_text(encoding="utf-8").splitlines()
        return int(rows[-1].split(",")[0])


def digests(folder):
    return {name: hashlib.sha256((pathlib.Path(folder) / name).read_bytes()).hexdigest() for name in SAME}


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
