#!/usr/bin/env python3
"""The wheel: its files, their hashes, and an environment that imports it."""

import csv
import io
import os
import pathlib
import subprocess
import sys
import unittest
import zipfile

import common

sys.path.insert(0, str(common.SOURCE / "core/python"))
import dsc_wheel  # noqa: E402


class Wheel(common.Scratch):
    def test_an_environment_with_the_wheel_runs(self):
        installed = self.folder / "installed"
        subprocess.run([os.environ["DSC_TEST_CMAKE"], "--install", os.environ["DSC_TEST_BUILD"], "--component", "program", "--prefix",
                        installed], check=True, capture_output=True)
        wheel = self.folder / dsc_wheel.pack(installed, self.folder)
        self.assertRegex(wheel.name, r"^dsc-\d+\.\d+\.\d+-cp3\d+-cp3\d+-linux_\w+\.whl$")
        with zipfile.ZipFile(wheel) as archive:
            names = archive.namelist()
            (record,) = [name for name in names if name.endswith("/RECORD")]
            rows = list(csv.reader(io.StringIO(archive.read(record).decode())))
            self.assertEqual(sorted(row[0] for row in rows), sorted(names))
            for path, code, size in rows:
                if path != record:
                    self.assertEqual((f"sha256={dsc_wheel.digest(archive.read(path))}", len(archive.read(path))), (code, int(size)))
            self.assertTrue(any(name.endswith(".data/data/lib/dsc/plugins/libdsc_grid.so") for name in names))
        self.environment(wheel)

    def environment(self, wheel):
        """Installs it where pip and venv are there."""
        made = subprocess.run([sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", "env"], capture_output=True,
                              check=False)
        if made.returncode != 0:
            self.skipTest("there is no module venv")
        pip = subprocess.run([sys.executable, "-m", "pip", "--python", "env/bin/python", "install", "--no-deps", "--no-index", wheel],
                             capture_output=True, text=True, check=False)
        if pip.returncode != 0 and "No module named pip" in pip.stderr:
            self.skipTest("there is no pip")
        self.assertEqual(pip.returncode, 0, pip.stderr)
        clean = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        script = ("import dsc\nprint(dsc.__file__)\n"
                  f"print(dsc.run({common.EXPERIMENT!r}).steps)\n")
        said = subprocess.run(["env/bin/python", "-c", script], env=clean, capture_output=True, text=True, check=False)
        self.assertEqual(said.returncode, 0, said.stderr)
        file, steps = said.stdout.split()
        self.assertIn(str(pathlib.Path("env/lib")), file)
        self.assertEqual(steps, "4")

    def test_metadata(self):
        folder = dsc_wheel.prepare_metadata_for_build_wheel(self.folder)
        text = (self.folder / folder / "METADATA").read_text(encoding="utf-8")
        self.assertIn("Name: dsc\nVersion: ", text)
        self.assertIn("Requires-Dist: numpy\n", text)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
