#!/usr/bin/env python3
"""What `dsc reconstruct` advises, it can do: no message names an option that it does not have or a key of an experiment.

    messages_test.py --program build/dev/bin/dsc --source .
"""
import argparse
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = ""
SOURCE = pathlib.Path()
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
# What only an experiment has.
KEYS = re.compile(r"`|\b(?:more cells|smaller steps|stop earlier|initial mesh 'lattice'|input\.|normalize:|half_width|another initial mesh)")


def sphere(n, radius, x=0.0, y=0.0, z=0.0):
    """Points on a sphere, evenly spread."""
    points = []
    for i in range(n):
        height = 1 - 2 * (i + 0.5) / n
        turn = 2.399963229728653 * i
        ring = (1 - height * height) ** 0.5
        points.append((x + radius * ring * math.cos(turn), y + radius * ring * math.sin(turn), z + radius * height))
    return points


def text(points):
    return "".join("%.6f %.6f %.6f\n" % p for p in points)


BAD_CLOUDS = {
    "tet.xyz": "0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
    "pair.xyz": text(sphere(700, 1) + sphere(700, 1, 30)),
    "needle.xyz": "".join(f"{i / 50} {(i % 7) * 1e-4} {(i % 5) * 1e-4}\n" for i in range(400)),
    "flat.xyz": "".join(f"{i % 20} {i // 20} 0\n" for i in range(400)),
    "line.xyz": "".join(f"{i} {i} {i}\n" for i in range(100)),
    "one.xyz": "1 2 3\n",
    "same.xyz": "1 2 3\n" * 50,
    "huge.xyz": text([(1e101 * x, y, z) for x, y, z in sphere(50, 1)]),
    "nan.xyz": "1 2 3\nnan 1 2\n",
    "comma.xyz": "1,5 2,5 3,5\n",
    "names.csv": "PointID,Code,Value\n1,2,3\n",
    "short.csv": "x,y,z\n1,2\n",
    "unfit.csv": "x,y,z\n1,2,3,4\n",
    "empty.xyz": "",
    "cut.ply": "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
    "mark.ply": "\ufeffply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
    "scan.las": "LASF",
    "scan.e57": "ASTM-E57",
    "cloud.doc": "1 2 3\n",
}


class Messages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="dsc-messages-")
        cls.options = set(OPTION.findall(cls.run_dsc(cls, "reconstruct", "--help").stdout))
        for name, content in BAD_CLOUDS.items():
            (pathlib.Path(cls.folder.name) / name).write_text(content, encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_dsc(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder.name, capture_output=True, text=True, check=False)

    def require_own_words(self, said):
        self.assertLessEqual(set(OPTION.findall(said)), self.options, said)
        self.assertIsNone(KEYS.search(said), said)

    def test_what_it_says_of_bad_clouds(self):
        for name in BAD_CLOUDS:
            with self.subTest(cloud=name):
                done = self.run_dsc("reconstruct", name, "--detail", "low", "-o", "s.obj", "--progress", "never")
                self.require_own_words(done.stderr)
                if done.returncode != 0:
                    self.assertRegex(done.stderr.splitlines()[-1], r"^error: .*;")

    def test_columns_are_chosen_in_each_command_its_own_way(self):
        self.assertIn("from 1: --columns X,Y,Z", self.run_dsc("reconstruct", "names.csv", "-o", "s.obj").stderr)
        self.assertIn("from 1: --columns X,Y,Z", self.run_dsc("info", "unfit.csv").stderr)
        (pathlib.Path(self.folder.name) / "a.yaml").write_text(
            "dsc: 1\ninput: {cloud: {file: names.csv}, normalize: {}}\ninitial_mesh: {type: grid}\nvelocity: {type: point_cloud}\n"
            "improvement: {type: dsc}\nschedule: [{steps: 1}]\n", encoding="utf-8")
        said = self.run_dsc("run", "a.yaml", "-o", "r").stderr
        self.assertIn("from 1: input.cloud.columns", said)
        self.assertNotIn("--columns", said)

    def test_a_name_that_is_not_utf8(self):
        folder = os.fsencode(self.folder.name)
        name = b"caf\xe9"
        os.mkdir(os.path.join(folder, name))
        for where, cloud in ((folder, name + b".xyz"), (os.path.join(folder, name), b"plain.xyz")):
            with open(os.path.join(where, cloud), "w", encoding="ascii") as file:
                file.write(text(sphere(400, 1)))
            for more in ([], ["--keep-run", name + b"_run"]):
                done = subprocess.run([PROGRAM, "reconstruct", cloud, "--detail", "low", "-o", name + b".obj", *more], cwd=where,
                                      capture_output=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stdout, name + b".obj\n")
            for command in (["info", "--json", name + b".obj"], ["info", name + b"_run"], ["render", name + b"_run", "-o", name + b".png"],
                            ["convert", name + b".obj", name + b".ply"]):
                done = subprocess.run([PROGRAM, *command], cwd=where, capture_output=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_every_option_in_the_text_of_the_sources_is_its_own(self):
        files = [SOURCE / "core/app" / name for name in ("reconstruct_command.cpp", "outcome.cpp", "temporary_folder.cpp")]
        files.append(SOURCE / "core/src/run/reconstruct_remedies.cpp")
        for folder in ("core/src/cloud", "core/src/io", "core/src/mesh", "core/src/generate", "core/src/surface", "core/src/kernel"):
            files += sorted((SOURCE / folder).glob("*.cpp"))
        for path in files:
            lines = [line.split("// ")[0] for line in path.read_text(encoding="utf-8").splitlines()]
            for number, line in enumerate(lines, 1):
                for literal in LITERAL.findall(line):
                    unknown = set(OPTION.findall(literal)) - self.options
                    self.assertEqual(unknown, set(), f"{path.name}:{number}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--source", required=True)
    arguments, rest = parser.parse_known_args()
    PROGRAM = str(pathlib.Path(arguments.program).resolve())
    SOURCE = pathlib.Path(arguments.source).resolve()
    unittest.main(argv=[sys.argv[0], *rest])
