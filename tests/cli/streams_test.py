#!/usr/bin/env python3
"""Standard streams of every kind, signals, outputs that cannot be written, and two runs for one folder.

    streams_test.py --program build/dev/bin/dsc
"""
import argparse
import fcntl
import json
import os
import pathlib
import pty
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

EXPERIMENT = """dsc: 1
name: streams
input: {cloud: {sample: {shape: sphere, n: 1000}}, normalize: {}}
initial_mesh: {type: grid, cells: 12}
velocity: {type: point_cloud, curvature: {type: implicit_fairing}}
improvement: {type: dsc}
schedule: [{steps: 12}]
output: {report: true}
"""
PROGRAM = ""


class Streams(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = pathlib.Path(tempfile.mkdtemp(prefix="dsc-streams-"))
        (cls.scratch / "a.yaml").write_text(EXPERIMENT, encoding="utf-8")
        cls.run_in(cls, "whole", "-q")
        subprocess.run([PROGRAM, "sample", "torus", "-n", "3000", "-o", "c.ply"], cwd=cls.scratch, check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.scratch)

    def run_in(self, folder, *more, **streams):
        return subprocess.run([PROGRAM, "run", "a.yaml", "-o", folder, *more], cwd=self.scratch, check=False, text=True,
                              **(streams or {"capture_output": True}))

    def require_whole(self, folder):
        for name in ("metrics.csv", "events.jsonl", "result/surface.obj"):
            self.assertEqual((self.scratch / folder / name).read_bytes(), (self.scratch / "whole" / name).read_bytes(), name)
        self.assertTrue((self.scratch / folder / "report.html").exists())
        self.assertEqual(json.loads((self.scratch / folder / "status.json").read_text())["state"], "done")

    def test_closed_streams(self):
        for closed in ((0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)):
            folder = "closed_" + "".join(map(str, closed))
            words = " ".join(f"{number}{'<' if number == 0 else '>'}&-" for number in closed)
            done = subprocess.run(["sh", "-c", f'exec "$0" run a.yaml -o {folder} {words}', PROGRAM], cwd=self.scratch,
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, f"{closed}: {done.stderr}")
            self.assertEqual(done.stdout, "" if 1 in closed else folder + "\n")
            self.require_whole(folder)

    def test_a_full_log_and_one_without_a_reader(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            self.assertEqual(self.run_in("full", stderr=full, stdout=subprocess.DEVNULL).returncode, 0)
            self.assertEqual(self.run_in("json", "--progress", "json", stderr=full, stdout=subprocess.DEVNULL).returncode, 0)
        self.require_whole("full")
        self.require_whole("json")
        read, write = os.pipe()
        os.close(read)
        self.assertEqual(self.run_in("unread", stderr=write, stdout=subprocess.DEVNULL).returncode, 0)
        os.close(write)
        self.require_whole("unread")

    def test_data_that_cannot_be_written(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([PROGRAM, "info", "c.ply"], cwd=self.scratch, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 6)
        self.assertIn("stdout: cannot be written", done.stderr)
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([PROGRAM, "info", "c.ply"], cwd=self.scratch, stdout=write, stderr=subprocess.PIPE, text=True, check=False)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, ""))

    def on_terminal(self, folder, columns, **environment):
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        process = subprocess.Popen([PROGRAM, "run", "a.yaml", "-o", folder], cwd=self.scratch, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=theirs, env={**os.environ, **environment})
        os.close(theirs)
        said = b""
        while True:
            try:
                block = os.read(ours, 65536)
            except OSError:  # the other end is closed
                break
            if not block:
                break
            said += block
        os.close(ours)
        self.assertEqual(process.wait(), 0)
        return said.decode()

    def test_terminals(self):
        said = self.on_terminal("dumb", 80, TERM="dumb")
        self.assertNotIn("\x1b", said)
        self.assertIn("step 12/12", said)
        for columns in (80, 30, 1):
            said = self.on_terminal(f"wide_{columns}", columns, TERM="xterm")
            lines = [line.split("\x1b[K")[0] for line in said.split("\r") if "\x1b[K" in line]
            self.assertTrue(lines)
            self.assertLessEqual(max(map(len, lines)), max(columns - 1, 1))

    def stopped(self, number, folder, *arguments):
        """A reconstruction that gets the signal while it runs; the process."""
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.scratch, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.until(lambda: (self.scratch / folder / "status.json").exists() or process.poll() is not None)
        process.send_signal(number)
        return process

    def until(self, condition):
        for _ in range(3000):
            if condition():
                return
            time.sleep(0.01)
        self.fail("it does not come")

    def test_signals_that_come_twice(self):
        for number in (signal.SIGHUP, signal.SIGXCPU, signal.SIGUSR1):
            folder = f"twice_{number}"
            process = self.stopped(number, folder, "run", "a.yaml", "schedule.0.steps=5000", "-o", folder)
            process.send_signal(number)
            err = process.communicate()[1]
            self.assertEqual(process.returncode, 75, err)
            self.assertEqual(json.loads((self.scratch / folder / "status.json").read_text())["state"], "stopped")

    def test_nohup(self):
        process = subprocess.Popen([PROGRAM, "run", "a.yaml", "-o", "nohup", "-q"], cwd=self.scratch, stdout=subprocess.DEVNULL,
                                   preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.until(lambda: (self.scratch / "nohup/status.json").exists())
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(), 0)
        self.require_whole("nohup")

    def test_a_stopped_reconstruct_writes_what_was_reached_or_says_that_nothing_is_kept(self):
        process = self.stopped(signal.SIGINT, "kept", "reconstruct", "c.ply", "-o", "r.obj", "-o", "r.vtu", "--keep-run", "kept")
        out, err = process.communicate()
        self.assertEqual(process.returncode, 75, err)
        written = [(self.scratch / name).exists() for name in ("r.obj", "r.vtu")]
        if all(written):
            self.assertEqual(out, "r.obj\nr.vtu\n")
            self.assertIn("the result is what was reached", err)
        else:
            self.assertEqual(written, [False, False])
            self.assertIn("no output was written", err)
            self.assertIn("--keep-run", err)

    def test_outputs_are_tried_before_the_work(self):
        for command in (["reconstruct", "c.ply", "--detail", "low", "-o", "/sys/kernel/x.obj"], ["sample", "torus", "-n", "100", "-o", "/sys/kernel/x.ply"],
                        ["convert", "c.ply", "/sys/kernel/x.xyz"], ["render", "whole", "-o", "/sys/kernel/x.png"],
                        ["report", "whole", "-o", "/sys/kernel/x.html"]):
            done = subprocess.run([PROGRAM, *command], cwd=self.scratch, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 6, done.stderr)
            self.assertTrue(done.stderr.startswith(f"error: {command[-1]}: cannot be written: "), done.stderr)

    def test_a_result_that_cannot_be_written_is_kept(self):
        (self.scratch / "target").mkdir()
        (self.scratch / "t").mkdir()
        process = subprocess.Popen([PROGRAM, "reconstruct", "c.ply", "--detail", "low", "-o", "target/s.obj", "-o", "other.obj"], cwd=self.scratch,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={**os.environ, "TMPDIR": str(self.scratch / "t")})
        self.until(lambda: list(self.scratch.glob("t/*/run/status.json")) or process.poll() is not None)
        shutil.rmtree(self.scratch / "target")
        out, err = process.communicate()
        self.assertEqual(process.returncode, 6, err)
        self.assertEqual(out, "other.obj\n")
        kept = err.split("the result is kept in ")[1].strip()
        self.assertTrue((pathlib.Path(kept) / "surface.obj").exists())

    def test_two_runs_for_one_folder(self):
        process = subprocess.Popen([PROGRAM, "run", "a.yaml", "-o", "one", "-q"], cwd=self.scratch, stdout=subprocess.DEVNULL)
        self.until(lambda: (self.scratch / "one/status.json").exists())
        process.send_signal(signal.SIGSTOP)  # else it may end before the second one begins
        for more in ([], ["--resume"]):
            second = self.run_in("one", "schedule.0.steps=2", *more)
            self.assertEqual(second.returncode, 2)
            self.assertIn(f"one: is in use by the run of process {process.pid}", second.stderr)
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(), 0)
        self.require_whole("one")
        self.assertFalse((self.scratch / "one/.lock").exists())

    def test_a_lock_of_a_killed_run_is_stale(self):
        process = subprocess.Popen([PROGRAM, "run", "a.yaml", "-o", "dead", "-q"], cwd=self.scratch, stdout=subprocess.DEVNULL)
        self.until(lambda: (self.scratch / "dead/status.json").exists())
        process.kill()
        process.wait()
        self.assertTrue((self.scratch / "dead/.lock").exists())
        self.assertEqual(self.run_in("dead").returncode, 0)
        self.require_whole("dead")

    def test_attributes_of_an_output_stay(self):
        for name in ("o.ply", "o.obj", "o.xyz"):
            target = self.scratch / ("disk_" + name)
            link = self.scratch / name
            link.symlink_to(target.name)
            for _ in range(2):
                subprocess.run([PROGRAM, "convert", "c.ply", name], cwd=self.scratch, check=True, capture_output=True)
                self.assertTrue(link.is_symlink())
                self.assertGreater(target.stat().st_size, 0)
                target.chmod(0o640)
            self.assertEqual(target.stat().st_mode & 0o777, 0o640)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    arguments, rest = parser.parse_known_args()
    PROGRAM = str(pathlib.Path(arguments.program).resolve())
    unittest.main(argv=[sys.argv[0], *rest])
