#!/usr/bin/env python3
"""The CPU time of a velocity in NumPy, compared with the same formula in C++, on the quick start."""

import os
import pathlib
import resource
import subprocess
import sys
import unittest

import common

STRATEGY = '''"""The data term of point_cloud."""
import numpy
import dsc


@dsc.velocity("attraction")
class Attraction:
    """Moves every vertex along its normal towards the nearest point of the cloud."""
    alpha = dsc.real(0.2, above=0, maximum=1, unit="dimensionless", doc="Fraction of the distance per step.")

    def evaluate(self, context):
        x, y, z = (context.cloud.points[context.nearest_index] - context.positions).T
        nx, ny, nz = context.normals.T
        speed = self.alpha * (nx * x + ny * y + nz * z)
        return speed[:, None] * context.normals
'''
LIMIT = 1.5


class Cost(common.Scratch):
    def cpu(self, *words):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([common.PROGRAM, "run", str(common.SOURCE / "configs/quickstart.yaml"), "-q", *words], check=True,
                       env={k: v for k, v in os.environ.items() if k != "PYTHONPATH"})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def test_the_quick_start_costs_little_more_and_has_the_same_bytes(self):
        pathlib.Path("attraction.py").write_text(STRATEGY, encoding="utf-8")
        plain = self.cpu("-o", "cpp", "velocity={type: point_cloud, alpha: 0.2, beta: 0.0}")
        python = self.cpu("-o", "numpy", "velocity={type: attraction, alpha: 0.2}", "--plugin", "attraction.py")
        for name in ("result/surface.obj", "result/volume.dsc", "metrics.csv", "events.jsonl"):
            self.assertEqual(pathlib.Path("cpp", name).read_bytes(), pathlib.Path("numpy", name).read_bytes(), name)
        print(f"C++ {plain:.2f} s, NumPy {python:.2f} s of CPU, ratio {python / plain:.2f}")
        self.assertLess(python, LIMIT * plain)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
