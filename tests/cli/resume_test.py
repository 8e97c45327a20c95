#!/usr/bin/env python3
"""Runs that are stopped, killed or find their checkpoints damaged, and go on with --resume.

    resume_test.py --program build/dev/bin/dsc
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

EXPERIMENT = """dsc: 1
name: resumed
input: {cloud: {sample: {shape: teapot, n: 2000}}, normalize: {}}
initial_mesh: {type: grid, cells: 16}
velocity: {type: point_cloud, curvature: {type: implicit_fairing}}
improvement: {type: dsc}
schedule: [{steps: 20}, {refine: {type: average_area}}, {steps: 20}]
output: {checkpoint: {every: 3, keep: 2}}
"""
KILLS = 20
SAME = ("result/surface.obj", "result/surface.ply", "result/volume.dsc", "result/volume.vtu", "metrics.csv", "events.jsonl",
        "config.resolved.yaml")
PROGRAM = ""


def digest(folder):
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in SAME}


class Resume(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = pathlib.Path(tempfile.mkdtemp(prefix="dsc-resume-"))
        (cls.scratch / "a.yaml").write_text(EXPERIMENT, encoding="utf-8")
        begin = time.monotonic()
        cls.run_dsc(cls, "whole")
        cls.seconds = time.monotonic() - begin
        cls.whole = digest(cls.scratch / "whole")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.scratch)

    def command(self, folder, *more):
        return [PROGRAM, "run", "a.yaml", "-o", folder, "-q", *more]

    def run_dsc(self, folder, *more, expect=0):
        done = subprocess.run(self.command(self, folder, *more) if isinstance(self, type) else self.command(folder, *more),
                              cwd=self.scratch, capture_output=True, text=True, check=False)
        if done.returncode != expect:
            raise AssertionError(f"exit {done.returncode} instead of {expect}: {done.stderr}")
        return done

    def status(self, folder):
        return json.loads((self.scratch / folder / "status.json").read_text())["state"]

    def test_killed_at_random_moments(self):
        numbers = random.Random(7)
        killed = 0
        seconds = self.seconds
        for i in range(KILLS):
            folder = f"killed_{i}"
            begin = time.monotonic()
            process = subprocess.Popen(self.command(folder), cwd=self.scratch, stderr=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL)
            try:
                process.wait(numbers.uniform(0.0, 1.05 * seconds))
                seconds = min(seconds, time.monotonic() - begin)  # faster than the run that was timed
            except subprocess.TimeoutExpired:
                process.kill()
                killed += process.wait() == -signal.SIGKILL
            self.run_dsc(folder, "--resume")
            self.assertEqual(digest(self.scratch / folder), self.whole, f"killed run {i} ends otherwise")
            self.assertEqual(self.status(folder), "done")
            shutil.rmtree(self.scratch / folder)
        self.assertGreater(killed, KILLS // 2)  # most were under way

    def test_stopped_by_a_signal(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGHUP, signal.SIGXCPU):
            folder = f"signal_{number}"
            self.stop(folder, number)
            self.run_dsc(folder, "--resume")
            self.assertEqual(digest(self.scratch / folder), self.whole)

    def stop(self, folder, number):
        """A run that is stopped once it has written a checkpoint; its checkpoints."""
        process = subprocess.Popen(self.command(folder), cwd=self.scratch, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))  # nohup may have changed it
        while process.poll() is None and not list(self.scratch.glob(f"{folder}/checkpoint/*.dscstate")):
            time.sleep(0.01)
        process.send_signal(number)
        self.assertEqual(process.wait(), 75)
        self.assertEqual(self.status(folder), "stopped")
        return sorted(self.scratch.glob(f"{folder}/checkpoint/*.dscstate"))

    def test_time_budgets(self):
        # How long a run takes is not known beforehand on a busy machine: shorter and shorter, until one is stopped.
        for share in (0.3, 0.1, 0.03, 0.01):
            folder = f"budget_{share}"
            stops = self.stops_within(folder, share * self.seconds)
            self.assertEqual(digest(self.scratch / folder), self.whole)
            if stops > 0:
                return
        self.fail(f"a budget of {0.01 * self.seconds:.3f} s stops no run")

    def stops_within(self, folder, seconds):
        for stops in range(200):
            code = subprocess.run(self.command(folder, "--resume", "--time-budget", f"{seconds:.3f}s"), cwd=self.scratch,
                                  stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=False).returncode
            self.assertIn(code, (0, 75))
            if code == 0:
                return stops
        self.fail(f"a budget of {seconds:.3f} s does not end in 200 runs")

    def test_a_finished_run_stays(self):
        before = (self.scratch / "whole/summary.json").stat().st_mtime_ns
        self.assertEqual(self.run_dsc("whole", "--resume").stdout, "whole\n")
        self.assertEqual((self.scratch / "whole/summary.json").stat().st_mtime_ns, before)

    def test_a_damaged_checkpoint_is_named_and_the_one_before_taken(self):
        process = subprocess.Popen(self.command("damaged"), cwd=self.scratch, stderr=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL)
        while len(files := sorted(self.scratch.glob("damaged/checkpoint/*.dscstate"))) < 2 and process.poll() is None:
            time.sleep(0.01)
        process.kill()
        process.wait()
        files = sorted(self.scratch.glob("damaged/checkpoint/*.dscstate"))
        content = bytearray(files[-1].read_bytes())
        content[len(content) // 2] ^= 1
        files[-1].write_bytes(content)
        command = [word for word in self.command("damaged", "--resume", "--progress", "never") if word != "-q"]
        said = subprocess.run(command, cwd=self.scratch, capture_output=True, text=True, check=True).stderr
        self.assertIn(f"{files[-1].relative_to(self.scratch)} cannot be used: it is damaged", said)
        self.assertIn("continuing after step " + str(int(files[-2].stem.split("_")[1])), said)
        self.assertEqual(digest(self.scratch / "damaged"), self.whole)

    def test_another_experiment_is_refused_and_left_alone(self):
        self.run_dsc("other", "schedule=[{steps: 4}]", "output.checkpoint={every: 1, keep: 2}")
        before = {path: path.read_bytes() for path in (self.scratch / "other").rglob("*") if path.is_file()}
        done = self.run_dsc("other", "schedule=[{steps: 5}]", "output.checkpoint={every: 1, keep: 2}", "--resume", expect=2)
        self.assertIn("other: contains the run of another experiment: schedule.0.steps is 4 there and 5 here", done.stderr)
        self.assertEqual(before, {path: path.read_bytes() for path in (self.scratch / "other").rglob("*") if path.is_file()})
        self.run_dsc("other", "schedule=[{steps: 5}]")
        rows = (self.scratch / "other/metrics.csv").read_text().splitlines()
        self.assertEqual(len(rows), 7)  # the header, row 0, five steps

    def test_checkpoints_of_no_use_are_refused_and_left_alone(self):
        for file in self.stop("useless", signal.SIGTERM):
            file.write_bytes(file.read_bytes()[:-100])
        done = self.run_dsc("useless", "--resume", expect=2)
        self.assertIn("it is damaged", done.stderr)
        self.assertTrue((self.scratch / "useless/result").is_dir())
        self.stop("short", signal.SIGTERM)
        (self.scratch / "short/metrics.csv").write_text("step\n")
        done = self.run_dsc("short", "--resume", expect=2)
        self.assertIn("metrics.csv is shorter than at the checkpoint", done.stderr)
        self.assertTrue((self.scratch / "short/result").is_dir())

    def test_a_full_disk_ends_cleanly(self):
        def limit():
            import resource
            resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

        done = subprocess.run(self.command("full"), cwd=self.scratch, capture_output=True, text=True, check=False, preexec_fn=limit)
        self.assertEqual(done.returncode, 6)
        self.assertIn("checkpoint/step_", done.stderr)
        self.assertFalse((self.scratch / "full/result").exists())
        self.assertEqual(self.status("full"), "failed")
        self.assertEqual(list(self.scratch.glob("full/checkpoint/*")), [])
        self.run_dsc("full", "--resume")
        self.assertEqual(digest(self.scratch / "full"), self.whole)

    def test_a_folder_that_cannot_be_written(self):
        if os.geteuid() == 0:
            self.skipTest("the superuser may write everywhere")
        (self.scratch / "locked").mkdir(mode=0o500)
        self.run_dsc("locked/run", expect=6)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    arguments, rest = parser.parse_known_args()
    PROGRAM = str(pathlib.Path(arguments.program).resolve())
    unittest.main(argv=[sys.argv[0], *rest])
