#!/usr/bin/env python3
"""Runs of experiments: overrides, clouds in memory, callbacks, interruption, folders."""

import copy
import hashlib
import json
import logging
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy

import common
import dsc


class Runs(common.Scratch):
    def test_a_dict_is_an_experiment(self):
        result = dsc.run(common.EXPERIMENT, output="run")
        self.assertEqual((result.status, result.steps, result.folder), ("max_steps", 4, "run"))
        with open("experiment.yaml", "w", encoding="utf-8") as file:
            json.dump(common.EXPERIMENT, file)  # JSON is YAML
        self.dsc("run", "experiment.yaml", "-o", "by_command", "-q")
        same = ("result/surface.obj", "result/volume.dsc", "metrics.csv", "config.resolved.yaml")
        for name in same:
            self.assertEqual(digest("run/" + name), digest("by_command/" + name), name)
        again = dsc.run("experiment.yaml", threads=1)
        numpy.testing.assert_array_equal(again.vertices, result.vertices)
        self.assertIsNone(again.folder)

    def test_overrides(self):
        given = copy.deepcopy(common.EXPERIMENT)
        result = dsc.run(given, {"schedule.0.steps": 2, "velocity.alpha": 0.4, "input.cloud.sample": {"shape": "torus", "n": 1000}},
                         output="run")
        self.assertEqual(result.steps, 2)
        self.assertEqual(given, common.EXPERIMENT)
        loaded = dsc.load_run("run")
        self.assertEqual(loaded["experiment"]["velocity"]["alpha"], 0.4)
        self.assertEqual(loaded["experiment"]["input"]["cloud"]["sample"]["shape"], "torus")

    def test_faults_of_experiments(self):
        with self.assertRaises(dsc.ConfigError) as caught:
            dsc.run(common.EXPERIMENT, {"velocity.alhpa": 0.3})
        self.assertEqual(caught.exception.code, "config.unknown_key")
        self.assertIn("did you mean 'alpha'", str(caught.exception))
        with self.assertRaises(dsc.IoError):
            dsc.run("absent.yaml")
        for wrong in ({1: 2}, {"velocity": object()}, {"seed": 2 ** 80}):
            with self.assertRaises(dsc.UsageError) as caught:
                dsc.run({**common.EXPERIMENT, **wrong})
            self.assertEqual(caught.exception.code, "value.type")
        for arguments in ((5,), (common.EXPERIMENT, [1])):
            with self.assertRaises(dsc.UsageError):
                dsc.run(*arguments)
        with self.assertRaises(dsc.UsageError):
            dsc.run(common.EXPERIMENT, resume=True)
        with self.assertRaises(dsc.UsageError):
            dsc.run(common.EXPERIMENT, normals=common.sphere())

    def test_a_cloud_in_memory_is_hashed(self):
        points = common.sphere(1200)
        colors = numpy.zeros((1200, 3), numpy.uint8)
        result = dsc.run(common.EXPERIMENT, cloud=points, colors=colors, output="run")
        expected = hashlib.sha256(points.astype("<f8").tobytes() + colors.tobytes()).hexdigest()
        (entry,) = dsc.load_run("run")["provenance"]["inputs"]
        self.assertEqual((entry["sha256"], entry["bytes"]), (expected, 1200 * 27))
        self.assertEqual(result.colors.shape, result.vertices.shape)
        numpy.savetxt("points.xyz", points, fmt="%.17g")
        from_file = dsc.run(common.EXPERIMENT, {"input.cloud": {"file": "points.xyz"}})
        numpy.testing.assert_array_equal(from_file.vertices, result.vertices)
        plain = {k: v for k, v in common.EXPERIMENT.items() if k != "input"}
        numpy.testing.assert_array_equal(dsc.run(plain, cloud=points).vertices, from_file.vertices)

    def test_steps_are_reported_and_can_stop_the_run(self):
        rows = []
        dsc.run(common.EXPERIMENT, on_step=rows.append)
        self.assertEqual([row["step"] for row in rows], [0, 1, 2, 3, 4])
        self.assertEqual(rows[1]["planned_steps"], 4)
        self.assertIsInstance(rows[1]["tets"], int)
        self.assertIsInstance(rows[1]["mean_speed"], float)
        result = dsc.run(common.EXPERIMENT, on_step=lambda row: row["step"] < 2)
        self.assertEqual((result.status, result.steps), ("cancelled", 2))

    def test_an_exception_of_the_callback_is_passed_on(self):
        def fail(row):
            raise ZeroDivisionError("on purpose")
        with self.assertRaisesRegex(ZeroDivisionError, "on purpose"):
            dsc.run(common.EXPERIMENT, on_step=fail)

    def test_ctrl_c_stops_at_the_next_step_and_the_run_goes_on_later(self):
        script = ("import sys, dsc\n"
                  f"dsc.run({common.EXPERIMENT!r}, {{'schedule.0.steps': 400, 'output.checkpoint': {{'every': 1}}}}, output='run',\n"
                  "        on_step=lambda row: print(row['step'], flush=True))\n")
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for line in child.stdout:
            if int(line) == 3:
                child.send_signal(signal.SIGINT)
                break
        _, said = child.communicate(timeout=120)
        self.assertEqual(child.returncode, -signal.SIGINT, said)
        self.assertIn("KeyboardInterrupt", said)
        self.assertEqual(dsc.load_run("run")["status"]["state"], "stopped")
        self.assertTrue(os.listdir("run/checkpoint"))

    def test_resume_gives_the_same_bytes(self):
        changes = {"output.checkpoint": {"every": 1}}
        whole = dsc.run(common.EXPERIMENT, changes, output="whole")
        dsc.run(common.EXPERIMENT, changes, output="parts", on_step=lambda row: row["step"] < 2)
        parts = dsc.run(common.EXPERIMENT, changes, output="parts", resume=True)
        self.assertEqual(parts.steps, 4)
        numpy.testing.assert_array_equal(parts.points, whole.points)
        for name in ("result/surface.obj", "result/volume.dsc", "metrics.csv"):
            self.assertEqual(digest("whole/" + name), digest("parts/" + name), name)

    def test_a_class_without_source_is_hashed_by_its_code(self):
        script = ("import dsc\n@dsc.velocity('typed')\nclass Typed:\n    'Typed.'\n    def evaluate(self, c): return -0.01 * c.normals\n"
                  f"dsc.run({common.EXPERIMENT!r}, {{'velocity': {{'type': 'typed'}}}}, output=OUT)\n")
        hashes = []
        for out, text in (("a", script), ("b", script), ("c", script.replace("0.01", "0.02"))):
            subprocess.run([sys.executable, "-c", text.replace("OUT", repr(out))], check=True, capture_output=True)
            (plugin,) = [p for p in dsc.load_run(out)["provenance"]["plugins"] if p["file"] == "/memory/session.py"]
            hashes.append(plugin["sha256"])
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], hashes[2])

    def test_other_threads_run_meanwhile(self):
        counts = [0]
        over = threading.Event()

        def count():
            while not over.wait(0.001):
                counts[0] += 1
        thread = threading.Thread(target=count)
        thread.start()
        begin = time.monotonic()
        dsc.run(common.EXPERIMENT, {"schedule.0.steps": 20})
        seconds = time.monotonic() - begin
        over.set()
        thread.join()
        self.assertGreater(counts[0], 20 * seconds)  # it would be about none if the lock were held

    def test_messages_go_to_logging(self):
        with self.assertLogs("dsc", logging.INFO) as logged:
            dsc.run(common.EXPERIMENT)
        self.assertTrue(any("1500 points" in line for line in logged.output), logged.output)

    def test_truth(self):
        true = dsc.run(common.EXPERIMENT)
        result = dsc.run(common.EXPERIMENT, truth=true)
        self.assertLess(result.evaluation["chamfer_percent"], 1e-9)

    def test_runs_as_columns(self):
        for alpha in (0.1, 0.2, 0.4):
            dsc.run(common.EXPERIMENT, {"velocity.alpha": alpha}, output=f"runs/a{alpha}")
        os.mkdir("runs/other")
        columns = dsc.load_runs("runs/*")
        self.assertEqual({len(column) for column in columns.values()}, {3})
        numpy.testing.assert_array_equal(columns["velocity.alpha"], [0.1, 0.2, 0.4])
        self.assertNotIn("seed", columns)  # the same in all
        self.assertEqual(columns["state"], ["done"] * 3)
        volumes = [json.load(open(f"runs/a{alpha}/summary.json", encoding="utf-8"))["volume"] for alpha in (0.1, 0.2, 0.4)]
        numpy.testing.assert_array_equal(columns["volume"], volumes)
        self.assertEqual(dsc.load_runs("nothing/*")["folder"], [])
        with self.assertRaises(dsc.UsageError):
            dsc.load_run("runs/other")


def digest(file):
    with open(file, "rb") as content:
        return hashlib.sha256(content.read()).hexdigest()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
