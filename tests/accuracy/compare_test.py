#!/usr/bin/env python3
"""The comparison judged with stand-ins for the methods: one that gives the truth, one with a hole, one that fails.

    compare_test.py [unittest's arguments]
"""

import sys
import tempfile
import unittest
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent / "topology")]
import packages  # noqa: F401,E402
import numpy as np  # noqa: E402
import compare  # noqa: E402
from creases import crease_edges  # noqa: E402
from surfaces import shell_volumes, topology  # noqa: E402
from trials import OWN, block, with_block, write_off  # noqa: E402

DSC = """#!/bin/sh
echo run >> "$(dirname "$0")/runs"
case $1 in reconstruct) cp "$(dirname "$0")/truth.off" "$4" ;; esac
"""
PEERS = """#!/bin/sh
case $1 in
  crossings) echo 0 ;;
  advancing_front) cp "$(dirname "$0")/holed.off" "$3" ;;
  *) exit 1 ;;
esac
"""


class Comparison(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.work = Path(self.folder.name) / "bin"
        self.work.mkdir()
        points, faces = block()
        write_off(self.work / "truth.off", points, faces)
        write_off(self.work / "holed.off", points * 1.01, faces[1:])
        (self.work / "cloud.obj").write_text("v 0 0 0\n", encoding="utf-8")
        for name, text in (("dsc", DSC), ("peers", PEERS)):
            (self.work / name).write_text(text, encoding="utf-8")
            (self.work / name).chmod(0o755)
        samples, compare.SAMPLES = compare.SAMPLES, 2000
        self.addCleanup(setattr, compare, "SAMPLES", samples)

    def test_a_truth_a_hole_and_failures_are_told_apart(self):
        bench = compare.Bench(self.work / "dsc", self.work / "peers", self.work / "kept")
        files = self.work / "cloud.obj", self.work / "truth.off"
        row = {method: bench.result(method, "block", *files) for method in bench.methods()}
        self.assertTrue(compare.valid(row["dsc"]))
        self.assertLess(row["dsc"]["chamfer"], 1e-9)
        self.assertAlmostEqual(row["dsc"]["normals"], 1)
        self.assertFalse(row["advancing_front"]["closed"] or compare.valid(row["advancing_front"]))
        self.assertIn("fault", row["poisson"])
        text = compare.compact({"block": row}) + compare.full({"block": row})
        self.assertRegex(text, r"\| block \| \*\*0\.0000\*\* \| \d\.\d{4}\* \| - \| - \|")
        bench.result("dsc", "block", *files)
        self.assertEqual((self.work / "runs").read_text(), "run\n")  # what is there is not run again

    def test_only_what_stands_between_the_markers_is_replaced(self):
        page = "a\n<!-- t: begin -->\nold\n<!-- t: end -->\nb\n"
        self.assertEqual(with_block(page, "t", "new"), page.replace("old", "new"))
        with self.assertRaises(SystemExit):
            with_block(page, "u", "new")


class OwnShapes(unittest.TestCase):
    def test_the_block_is_the_solid_of_its_cells(self):
        points, faces = block()
        self.assertEqual(topology(points, faces), OWN["block"][1])
        # The shear keeps volumes. Base less window, wall, step, knob:
        volume = 1.6 * 1.0 * 0.3 - 0.4 * 0.5 * 0.3 + 0.3 * 1.0 * 0.6 + 0.9 * 1.0 * 0.25 + 0.5 * 0.75 * 0.35
        self.assertAlmostEqual(shell_volumes(points, faces, np.zeros(len(faces), int), 1)[0], volume)
        ends = crease_edges(points, faces, np.radians(40))
        self.assertGreater(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum(), 20)


if __name__ == "__main__":
    unittest.main()
