#!/usr/bin/env python3
"""The measure of accuracy judged by surfaces whose distance everybody knows.

    accuracy_test.py [unittest's arguments]

DSC_JUDGE may name a program that takes SURFACE TRUTH --json and prints chamfer_pct, hausdorff99_pct and normal_consistency; the
measure then must agree with it as well.
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent / "topology")]
import packages  # noqa: F401,E402
import numpy as np  # noqa: E402
from accuracy import Triangles, measure, point_triangle  # noqa: E402
from fields import ball  # noqa: E402
from marching import surface_mesh  # noqa: E402

SAMPLES = 20000


def cube(low, high):
    """Twelve triangles, outward."""
    points = np.array([[x, y, z] for x in (low, high) for y in (low, high) for z in (low, high)], float)
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, np.array([f for a, b, c, d in squares for f in ((a, b, c), (a, c, d))])


def sphere(radius):
    """Its corners are on the sphere, its flat faces at most 0.0004 radii below it."""
    return surface_mesh(ball(np.zeros(3), radius), [-radius] * 3, [radius] * 3, 0.04 * radius)


def square(size, height):
    corners = size * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    return corners + [0, 0, height], np.array([[0, 1, 2], [0, 2, 3]])


class Measures(unittest.TestCase):
    def test_one_sphere_in_another_is_as_far_as_the_radii_differ(self):
        found = measure(sphere(1.05), sphere(1.0), SAMPLES)
        percent = 100 * 0.05 / (2 * np.sqrt(3))
        self.assertAlmostEqual(found.chamfer, percent, delta=0.02 * percent)
        self.assertAlmostEqual(found.hausdorff99, percent, delta=0.03 * percent)
        self.assertGreater(found.normals, 0.999)

    def test_a_sphere_moved_aside(self):
        # From a sphere moved by s, a place at the angle t to the shift is s |cos t| away to first order: on average s / 2.
        points, faces = sphere(1.0)
        found = measure((points + [0.02, 0, 0], faces), (points, faces), SAMPLES)
        percent = 100 * 0.02 / (2 * np.sqrt(3))
        self.assertAlmostEqual(found.chamfer, percent / 2, delta=0.03 * percent)
        self.assertAlmostEqual(found.hausdorff99, 0.99 * percent, delta=0.03 * percent)

    def test_a_plane_shifted_and_a_plane_tilted(self):
        flat = square(1, 0)
        found = measure(square(1, 0.1), flat, 1000)
        self.assertAlmostEqual(found.chamfer, 100 * 0.1 / np.sqrt(8))
        self.assertAlmostEqual(found.normals, 1)
        points, faces = square(1, 0)
        c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
        tilted = points @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]]), faces[:, ::-1]
        self.assertAlmostEqual(measure(tilted, flat, 1000).normals, c)

    def test_a_cube_round_another(self):
        self.assertAlmostEqual(measure(cube(0, 1), cube(0, 1), SAMPLES).chamfer, 0)
        found = measure(cube(-0.1, 1.1), cube(0, 1), SAMPLES)
        # Within, each place is 0.1 away. From outside, places beyond the inner square are nearer to its border.
        at = np.linspace(-0.1, 1.1, 1201)
        at = (at[1:] + at[:-1]) / 2
        beyond = np.maximum(0, np.maximum(-at, at - 1)) ** 2
        outside = np.sqrt(0.01 + beyond[:, None] + beyond[None, :]).mean()
        unit = 100 / np.sqrt(3)
        self.assertAlmostEqual(found.to_surface, 0.1 * unit, places=9)
        self.assertAlmostEqual(found.to_truth, outside * unit, delta=0.005 * outside * unit)

    def test_a_missing_face_is_seen_from_the_truth_alone(self):
        points, faces = cube(0, 1)
        found = measure((points, faces[2:]), (points, faces), SAMPLES)
        self.assertAlmostEqual(found.to_truth, 0)
        # From one of six faces: the mean distance to the border of a unit square is 1/6.
        self.assertAlmostEqual(found.to_surface, 100 / np.sqrt(3) / 36, delta=0.05)

    def test_the_nearest_triangle_is_the_nearest_of_all(self):
        rng = np.random.default_rng(5)
        for count in (1, 2, 37, 200):
            points = rng.normal(size=(3 * count, 3)) * rng.choice([0.01, 1], size=(3 * count, 1)) + rng.normal(size=3)
            faces = np.arange(3 * count).reshape(-1, 3)
            places = 2 * rng.normal(size=(300, 3))
            distance, triangle = Triangles(points, faces).nearest(places)
            every = np.stack([point_triangle(places, *(np.broadcast_to(points[f[i]], places.shape) for i in range(3))) for f in faces])
            np.testing.assert_array_equal(distance, every.min(axis=0))
            np.testing.assert_array_equal(every[triangle, np.arange(len(places))], distance)

    def test_distances_to_a_triangle_are_those_of_the_closest_of_many_places_on_it(self):
        rng = np.random.default_rng(6)
        u, v = np.meshgrid(np.linspace(0, 1, 400), np.linspace(0, 1, 400))
        u, v = u[u + v <= 1], v[np.add(*np.meshgrid(np.linspace(0, 1, 400), np.linspace(0, 1, 400))) <= 1]
        for _ in range(20):
            a, b, c, p = rng.normal(size=(4, 3))
            places = a + u[:, None] * (b - a) + v[:, None] * (c - a)
            expected = np.linalg.norm(places - p, axis=1).min()
            self.assertAlmostEqual(point_triangle(p[None], a[None], b[None], c[None])[0], expected, delta=0.01)

    @unittest.skipUnless("DSC_JUDGE" in os.environ, "DSC_JUDGE names no program")
    def test_another_judge_agrees(self):
        rng = np.random.default_rng(7)
        points, faces = sphere(1.0)
        bumpy = points * (1 + 0.01 * rng.normal(size=(len(points), 1))), faces
        with tempfile.TemporaryDirectory() as folder:
            files = []
            for name, (p, f) in (("surface", bumpy), ("truth", (points, faces))):
                files.append(Path(folder) / f"{name}.off")
                with open(files[-1], "w", encoding="utf-8") as out:
                    out.write(f"OFF\n{len(p)} {len(f)} 0\n")
                    np.savetxt(out, p, "%.12g")
                    np.savetxt(out, np.column_stack([np.full(len(f), 3), f]), "%d")
            told = json.loads(subprocess.run([sys.executable, os.environ["DSC_JUDGE"], *files, "--json"], check=True,
                                             capture_output=True, text=True).stdout)
        found = measure(bumpy, (points, faces))
        self.assertAlmostEqual(found.chamfer / told["chamfer_pct"], 1, delta=0.03)
        self.assertAlmostEqual(found.hausdorff99 / told["hausdorff99_pct"], 1, delta=0.03)
        self.assertAlmostEqual(found.normals / told["normal_consistency"], 1, delta=0.03)


if __name__ == "__main__":
    unittest.main()
