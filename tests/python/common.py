"""What the tests of the Python package share."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy

PROGRAM = os.environ["DSC_TEST_PROGRAM"]
SOURCE = pathlib.Path(os.environ["DSC_TEST_SOURCE"])

EXPERIMENT = {
    "dsc": 1, "name": "test", "input": {"cloud": {"sample": {"shape": "sphere", "n": 1500}}, "normalize": {}},
    "initial_mesh": {"type": "grid", "cells": 12}, "velocity": {"type": "point_cloud"}, "improvement": {"type": "dsc"},
    "schedule": [{"steps": 4}], "output": {"surface": ["obj"], "volume": ["dsc"]},
}


def sphere(count=2000, radius=1.0, seed=7):
    """Points of a sphere round the origin."""
    places = numpy.random.default_rng(seed).normal(size=(count, 3))
    return radius * places / numpy.linalg.norm(places, axis=1, keepdims=True)


class Scratch(unittest.TestCase):
    """A test with a folder of its own, which is the current one."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="dsc-python-"))
        self.before = os.getcwd()
        os.chdir(self.folder)

    def tearDown(self):
        os.chdir(self.before)
        shutil.rmtree(self.folder)

    def dsc(self, *words, expect=0):
        """Runs the command; its standard output, or its standard error where an error is expected."""
        environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}  # the command needs no help to find the package
        done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, env=environment, check=False)
        self.assertEqual(done.returncode, expect, done.stdout + done.stderr)
        return done.stdout if expect == 0 else done.stderr


HEAD = "import numpy\nimport dsc\n\n\n"


def velocity(body, head='@dsc.velocity("mine")\nclass Mine:\n    """Mine."""\n'):
    return HEAD + head + "".join(f"    {line}\n" for line in body.splitlines())


class Mine(Scratch):
    """Tests of strategies in the file mine.py."""

    def write(self, text, name="mine.py"):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return str(path)

    def run_mine(self, body, **options):
        import dsc
        changes = {"velocity": {"type": "mine"}, **options.pop("changes", {})}
        return dsc.run(EXPERIMENT, changes, plugins=[self.write(velocity(body))], **options)

    def fault(self, body, *words, kind=None, code=None, **options):
        import dsc
        with self.assertRaises(kind or dsc.StrategyError) as caught:
            self.run_mine(body, **options)
        for word in words:
            self.assertIn(word, str(caught.exception))
        if code:
            self.assertEqual(caught.exception.code, code)
        return caught.exception

    def experiment(self):
        text = json.dumps({**EXPERIMENT, "velocity": {"type": "mine"}, "plugins": [{"python": "mine.py"}]})
        return self.write(text, "experiment.yaml")
