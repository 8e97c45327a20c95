#!/usr/bin/env python3
"""The topology suite judged: its counter by solids that everybody knows, its truths, its clouds, and both programs by a
stand-in for dsc whose answers are known.

    shapes_test.py [unittest's arguments]
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import packages  # noqa: F401
import numpy as np
from scipy.spatial import cKDTree

import clouds
from fields import torus
from marching import surface_mesh
from poses import expectation, poses
from shapes import SHAPES, faults
from surfaces import Topology, read_mesh, sample, topology, write_cloud

FOLDER = Path(__file__).resolve().parent
CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
CUBE_FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                       [0, 6, 4], [1, 5, 7], [1, 7, 3]])
# Writes the cube whatever the cloud, with a warning, and fails where the cloud has fewer than 10 points.
STAND_IN = """#!{python}
import json, pathlib, sys
words = sys.argv[1:]
if words[0] == "info":
    print(json.dumps(dict(components=1, cavities=0, genus=0, boundary_edges=0, nonmanifold_edges=0, misoriented_edges=0,
                          nonmanifold_vertices=0)))
    sys.exit(0)
lines = pathlib.Path(words[1]).read_text().splitlines()
if len(lines) < 10:
    sys.exit(5)
for i, word in enumerate(words):
    if word == "-o":
        name = pathlib.Path(words[i + 1])
        name.write_text({cube!r} if name.suffix == ".obj" else words[1].count("shuffled") * "other")
    if word == "--keep-run":
        pathlib.Path(words[i + 1]).mkdir()
        (pathlib.Path(words[i + 1]) / "summary.json").write_text(json.dumps({{"warnings": [{{"code": "topology.doubt"}}]}}))
"""


def cube_text():
    return "".join(f"v {x:g} {y:g} {z:g}\n" for x, y, z in CUBE) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in CUBE_FACES)


class Counter(unittest.TestCase):
    def test_a_cube_and_a_hollow_cube(self):
        self.assertEqual(topology(CUBE, CUBE_FACES), Topology(1, 0, 0))
        both = np.concatenate([CUBE, 0.25 + CUBE / 2])
        self.assertEqual(topology(both, np.concatenate([CUBE_FACES, 8 + CUBE_FACES[:, ::-1]])), Topology(1, 1, 0))
        self.assertEqual(topology(both + 5e6, np.concatenate([CUBE_FACES, 8 + CUBE_FACES[:, ::-1]])), Topology(1, 1, 0))

    def test_a_torus_of_quadrilaterals(self):
        n = 12
        i, j = np.divmod(np.arange(n * n), n)
        a, b = i * 2 * np.pi / n, j * 2 * np.pi / n
        points = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], axis=1)
        right, up = ((i + 1) % n) * n + j, i * n + (j + 1) % n
        across = ((i + 1) % n) * n + (j + 1) % n
        faces = np.concatenate([np.stack([np.arange(n * n), right, across], 1), np.stack([np.arange(n * n), across, up], 1)])
        self.assertEqual(topology(points, faces), Topology(1, 0, 1))

    def test_faults_are_seen(self):
        self.assertFalse(topology(CUBE, CUBE_FACES[1:]).closed)
        turned = CUBE_FACES.copy()
        turned[0] = turned[0, ::-1]
        self.assertFalse(topology(CUBE, turned).closed)
        other = 8 + CUBE_FACES
        other[other == 8] = 7  # the first corner of the second cube is the last one of the first
        touching = topology(np.concatenate([CUBE, 1 + CUBE]), np.concatenate([CUBE_FACES, other]))
        self.assertEqual(touching, Topology(2, 0, 0, True, False))

    def test_reading(self):
        with tempfile.TemporaryDirectory() as folder:
            obj, off = Path(folder) / "cube.obj", Path(folder) / "cube.off"
            obj.write_text(cube_text(), encoding="utf-8")
            off.write_text("OFF\n8 12 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in CUBE)
                           + "".join(f"3 {a} {b} {c}\n" for a, b, c in CUBE_FACES), encoding="utf-8")
            for file in (obj, off):
                points, faces = read_mesh(file)
                np.testing.assert_array_equal(points, CUBE)
                np.testing.assert_array_equal(faces, CUBE_FACES)


class Truth(unittest.TestCase):
    def test_every_shape_has_the_stated_topology_and_area(self):
        for name, shape in SHAPES.items():
            with self.subTest(shape=name):
                self.assertEqual(faults(shape, *shape.mesh(fineness=1)), [])

    def test_vertices_lie_on_the_surface(self):
        points, _ = surface_mesh(torus((0, 0, 0), (0, 0, 1), 1.0, 0.3), (-1.3, -1.3, -0.3), (1.3, 1.3, 0.3), 0.05)
        off = np.hypot(np.hypot(points[:, 0], points[:, 1]) - 1, points[:, 2]) - 0.3
        self.assertLess(np.abs(off).max(), 1e-4)

    def test_fields_are_no_steeper_than_one(self):
        rng = np.random.default_rng(3)
        for name, shape in SHAPES.items():
            with self.subTest(shape=name):
                low, high = np.array(shape.low), np.array(shape.high)
                a = low + rng.random((500, 3)) * (high - low)
                step = 0.05 * rng.normal(size=(500, 3))
                rise = np.abs(shape.field(a + step) - shape.field(a))
                self.assertLess((rise / np.linalg.norm(step, axis=1)).max(), 1 + 1e-3)


class Clouds(unittest.TestCase):
    def test_the_table_is_of_these_shapes(self):
        table = clouds.table()
        self.assertEqual(len({c.name for c in table}), len(table))
        self.assertEqual(len({c.seed for c in table}), len(table))
        self.assertEqual({c.shape for c in table}, set(SHAPES))
        self.assertEqual({c.kind for c in table}, set(clouds.KINDS))
        for c in table:
            self.assertEqual(c.truth, SHAPES[c.shape].truth, c.name)
            self.assertEqual(c.spacings, round(SHAPES[c.shape].feature(c.points), 1), c.name)
            if c.kind == "sparse":
                self.assertGreaterEqual(SHAPES[c.shape].feature(c.points), clouds.LEAST_SPACINGS, c.name)

    def test_kinds(self):
        mesh = surface_mesh(torus((0, 0, 0), (0, 0, 1), 1.0, 0.4), (-1.4, -1.4, -0.4), (1.4, 1.4, 0.4), 0.05)

        def off(points):
            return np.hypot(np.hypot(points[:, 0], points[:, 1]) - 1, points[:, 2]) - 0.4
        made = {kind: clouds.make(mesh, kind, 5000, 7) for kind in clouds.KINDS}
        sigma = 0.0025 * np.linalg.norm([2.8, 2.8, 0.8])
        self.assertLess(np.abs(off(made["clean"])).max(), 2e-3)
        self.assertAlmostEqual(off(made["noise"]).std() / sigma, 1, delta=0.05)
        self.assertAlmostEqual(off(made["one_sided"]).mean() / sigma, (2 / np.pi) ** 0.5, delta=0.05)
        self.assertGreater(off(made["one_sided"]).min(), -2e-3)
        self.assertEqual(len(made["outliers"]), 5500)
        self.assertGreater((np.abs(off(made["outliers"])) > 0.02).sum(), 400)
        self.assertEqual(len(made["missing"]), 4700)
        hole, _ = cKDTree(made["missing"]).query(made["clean"])
        self.assertGreater(hole.max(), 0.2)  # a ball with 2 % of the area has a radius near 0.3
        left, right = (np.abs(made["gradient"][:, 0] - x) < 0.2 for x in (-1.0, 1.0))
        self.assertAlmostEqual(left.sum() / right.sum(), (1 - 0.9 * 0.4 / 2.8) / (1 - 0.9 * 2.4 / 2.8), delta=0.6)
        np.testing.assert_array_equal(made["noise"], clouds.make(mesh, "noise", 5000, 7))

    def test_samples_are_uniform_by_area(self):
        points, normals = sample(CUBE * [1, 1, 3], CUBE_FACES, 20000, np.random.default_rng(1))
        self.assertAlmostEqual((np.abs(normals[:, 2]) > 0.5).mean(), 2 / 14, delta=0.01)
        self.assertAlmostEqual(points[:, 2].mean(), 1.5, delta=0.03)

    def test_missing_parts_spare_thin_sheets(self):
        thin = CUBE * [1, 1, 0.05]
        self.assertIsNone(clouds.make((thin, CUBE_FACES), "missing", 2000, 1))


class Programs(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = Path(self.scratch.name)
        self.dsc = self.folder / "dsc"
        self.dsc.write_text(STAND_IN.format(python=sys.executable, cube=cube_text()), encoding="utf-8")
        self.dsc.chmod(0o755)

    def program(self, name, *arguments):
        return subprocess.run([sys.executable, FOLDER / name, "--dsc", self.dsc, "--work", self.folder / "work", "--json",
                               self.folder / "out.json", *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)

    def outcomes(self):
        return {row["name"]: row for row in json.loads((self.folder / "out.json").read_text(encoding="utf-8"))}

    def test_run_tells_right_from_wrong(self):
        chosen = "^(brick-clean-150|torus-sparse)$"
        done = self.program("run.py", "--only", chosen)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("right in all:        1 of 2 (50 %)", done.stdout)
        self.assertIn("wrong and flagged:   1 of 1 (100 %)", done.stdout)
        found = self.outcomes()
        self.assertTrue(found["brick-clean-150"]["right"])
        self.assertFalse(found["torus-sparse"]["right"])
        self.assertEqual(self.program("run.py", "--only", chosen, "--require", "0.5").returncode, 0)
        self.assertEqual(self.program("run.py", "--only", chosen, "--require", "0.6").returncode, 1)
        unflagged = self.program("run.py", "--only", chosen, "--flag", "another")
        self.assertIn("wrong and flagged:   0 of 1 (0 %)", unflagged.stdout)

    def test_poses(self):
        cloud = self.folder / "small.obj"
        write_cloud(cloud, CUBE.repeat(2, axis=0))
        mesh = self.folder / "cube.obj"
        mesh.write_text(cube_text(), encoding="utf-8")
        done = self.program("poses.py", "--cloud", f"{cloud}=1,0", "--mesh", f"{mesh}=1,0", "--rotations", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = self.outcomes()
        self.assertEqual(len(found), 7 + 5 * 4)
        # The stand-in's volume differs for a file of that name; all else is right.
        self.assertEqual([name for name, row in found.items() if not row["right"]], ["small-shuffled"])
        self.assertIn("volume.dsc", found["small-shuffled"]["fault"])

    def test_a_failure_of_dsc_is_a_wrong_result(self):
        cloud = self.folder / "few.obj"
        write_cloud(cloud, CUBE)
        done = self.program("poses.py", "--cloud", f"{cloud}=1,0", "--rotations", "0")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("dsc ended with code 5", done.stdout)
        self.assertIn("right in all:        0 of 5 (0 %)", done.stdout)

    def test_poses_are_rigid(self):
        kinds = {}
        for kind, name, points in poses(CUBE, 3):
            kinds[name] = points
            if kind == "rotation":
                np.testing.assert_allclose(np.linalg.norm(points - points[0], axis=1), np.linalg.norm(CUBE - CUBE[0], axis=1), atol=1e-12)
        self.assertEqual(sorted(map(tuple, kinds["shuffled"])), sorted(map(tuple, CUBE)))
        self.assertEqual(expectation("a=b.obj=2,3,1"), (Path("a=b.obj"), Topology(2, 1, 3)))


if __name__ == "__main__":
    unittest.main()
