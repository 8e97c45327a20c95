#!/usr/bin/env python3
"""The preset release, which compiles the sources of a target as one: it builds without a warning, and writes the same bytes as the
build under test, which compiles them one by one."""

import hashlib
import os
import unittest

import package

# Sampling, filters, fairing, repairs, refinement and every writer take part.
EXPERIMENT = """dsc: 1
name: bytes
seed: 1
input:
  cloud: {sample: {shape: torus, n: 4000}, filters: [{type: statistical_outliers}, {type: duplicates}]}
  normalize: {scale: 0.9}
initial_mesh: {type: grid, cells: 16, shape: cube, half_width: 1.0}
velocity: {type: point_cloud, alpha: 0.2, beta: 1.0e-4, curvature: {type: implicit_fairing, area: ring}}
improvement: {type: dsc, min_tet_quality: 0.2, degenerate_tet_quality: 0.03}
schedule: [{steps: 12}, {refine: {type: average_area}}, {steps: 6}]
output: {surface: [obj, ply, off, stl], volume: [vtu, dsc, msh, mesh]}
"""


class Unity(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = package.fresh_folder("unity")
        (cls.folder / "experiment.yaml").write_text(EXPERIMENT)

    def written(self, program, name):
        package.run([program, "run", "experiment.yaml", "-o", name], self.folder)
        result = sorted((self.folder / name / "result").iterdir())
        self.assertGreaterEqual(len(result), 8)
        figures = [self.folder / name / file for file in ("metrics.csv", "events.jsonl")]
        return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in result + figures}

    def test_the_bytes_do_not_depend_on_how_sources_are_compiled(self):
        build = self.folder / "build"
        package.run([package.CMAKE, "-S", package.SOURCE, "--preset", "release", "-B", build, "-DDSC_WERROR=ON"], self.folder)
        package.run([package.CMAKE, "--build", build, "--target", "dsc", "-j", os.environ["DSC_PACKAGE_JOBS"]], self.folder)
        self.assertTrue(list(build.rglob("Unity/unity_0_cxx.cxx.o")))
        self.assertEqual(self.written(build / "bin/dsc", "together"), self.written(package.BUILD / "bin/dsc", "one_by_one"))


if __name__ == "__main__":
    unittest.main()
