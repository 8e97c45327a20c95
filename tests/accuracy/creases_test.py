#!/usr/bin/env python3
"""The measure of creases judged by solids whose creases everybody knows.

    creases_test.py [unittest's arguments]
"""

import sys
import unittest
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent / "topology")]
import packages  # noqa: F401,E402
import numpy as np  # noqa: E402
from creases import crease_edges, found_share  # noqa: E402

RIGHT = np.radians(40), 0.1, np.radians(10)


def box(cells, size=1.0):
    """The surface of a cube of `cells`^3 squares, two triangles each."""
    points, faces = [], []
    for axis in range(3):
        for side in (0.0, 1.0):
            start = len(points)
            for i in range(cells + 1):
                for j in range(cells + 1):
                    place = [0.0, 0.0, 0.0]
                    place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side, i / cells, j / cells
                    points.append(place)
            for i in range(cells):
                for j in range(cells):
                    a = start + i * (cells + 1) + j
                    square = [a, a + cells + 1, a + cells + 2, a + 1]
                    square = square if side == 1.0 else square[::-1]
                    faces += [[square[0], square[1], square[2]], [square[0], square[2], square[3]]]
    points, index = np.unique(np.round(points, 9), axis=0, return_inverse=True)
    return size * points, index.reshape(-1)[np.array(faces)]


def turned(points, degrees):
    """Turned about the z axis through the middle of the unit cube."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return (points - 0.5) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + 0.5


class Creases(unittest.TestCase):
    def test_a_cube_has_its_twelve_edges(self):
        ends = crease_edges(*box(5), np.radians(40))
        self.assertAlmostEqual(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum(), 12.0)
        length, share = found_share(box(7), box(5), *RIGHT)
        self.assertAlmostEqual(length, 12.0)
        self.assertAlmostEqual(share, 1.0)

    def test_a_shift_beyond_the_bound_loses_what_leaves_the_crease(self):
        points, faces = box(10)
        mean = np.linalg.norm(points[faces[:, 0]] - points[faces[:, 1]], axis=1).mean()
        near, far = points + [0.05 * mean, 0, 0], points + [0.3 * mean, 0, 0]
        self.assertAlmostEqual(found_share((near, faces), box(3), *RIGHT)[1], 1.0)
        # The four edges along the shift stay on the creases, the other eight leave them.
        self.assertAlmostEqual(found_share((far, faces), box(3), *RIGHT)[1], 1 / 3, delta=0.02)

    def test_a_turn_beyond_the_angle_loses_the_edges(self):
        points, faces = box(10)
        # The axis of the turn keeps the direction of four edges, but not their places.
        self.assertLess(found_share((turned(points, 15), faces), box(3), *RIGHT)[1], 0.2)

    def test_a_smooth_truth_has_no_crease(self):
        points, faces = box(12)
        ball = (points - 0.5) / np.linalg.norm(points - 0.5, axis=1, keepdims=True)
        self.assertEqual(found_share(box(5), (ball, faces), *RIGHT), (0.0, 1.0))


if __name__ == "__main__":
    unittest.main()
