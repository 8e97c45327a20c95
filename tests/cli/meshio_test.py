#!/usr/bin/env python3
"""What dsc writes for Gmsh and MEDIT, read by somebody else: meshio finds the same coordinates, tets and labels, and the way
back through meshio that share/doc/formats.md shows ends in the same bytes.

    meshio_test.py DSC [unittest's arguments]
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import meshio
    import numpy as np
except ImportError as error:
    debian = "/usr/bin/python3"  # whose packages they are, where another Python comes first
    if sys.prefix != "/usr" and os.access(debian, os.X_OK):
        os.execv(debian, [debian, *sys.argv])
    print(f"SKIPPED: {error}; install python3-meshio")
    sys.exit(77)

PAGE = Path(__file__).resolve().parents[2] / "share/doc/formats.md"
BLOCK = re.compile(r"<!-- file: (\S+\.py) -->\n```python\n(.*?)^```$", re.M | re.S)
DSC = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None

EXPERIMENT = """dsc: 1
input: {cloud: {sample: {shape: torus, n: 2000}}, normalize: {}}
initial_mesh: {type: grid, cells: 16}
velocity: {type: point_cloud}
improvement: {type: dsc}
schedule: [{steps: 12}]
output: {surface: [obj, ply, off, stl], volume: [vtu, dsc, msh, mesh]}
"""


def read_dsc(file):
    """Points, tets and labels of a .dsc, by Python's own conversion of numbers."""
    words = [line.split() for line in file.read_text().splitlines()]
    points = np.array([[float(x) for x in w[1:]] for w in words if w[0] == "v"])
    tets = np.array([[int(x) for x in w[1:]] for w in words if w[0] == "t"])
    return points, tets[:, :4], tets[:, 4]


def by_label(tets, labels):
    """As a .msh lists them: label by label, each in the order of the file."""
    order = np.argsort(labels, kind="stable")
    return tets[order], labels[order]


class Meshio(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        (cls.folder / "torus.yaml").write_text(EXPERIMENT)
        cls.dsc("run", "torus.yaml", "-o", "run", "-q")
        cls.result = cls.folder / "run" / "result"
        cls.points, cls.tets, cls.labels = read_dsc(cls.result / "volume.dsc")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def dsc(cls, *arguments):
        done = subprocess.run([DSC, *arguments], cwd=cls.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise AssertionError(f"dsc {' '.join(arguments)}: exit {done.returncode}\n{done.stderr}")
        return done.stdout

    def same(self, mesh, labels, tets, expected_labels):
        self.assertEqual(mesh.points.dtype, np.float64)
        self.assertEqual(mesh.points.tobytes(), self.points.tobytes())
        np.testing.assert_array_equal(mesh.get_cells_type("tetra"), tets)
        np.testing.assert_array_equal(labels, expected_labels)
        self.assertGreater(len(tets), 5000)
        self.assertEqual(set(np.unique(labels)), {0, 1})

    def test_vtu(self):
        mesh = meshio.read(self.result / "volume.vtu")
        self.same(mesh, mesh.get_cell_data("label", "tetra"), self.tets, self.labels)

    def test_medit(self):
        mesh = meshio.read(self.result / "volume.mesh")
        self.assertEqual([block.type for block in mesh.cells], ["tetra"])
        self.same(mesh, mesh.get_cell_data("medit:ref", "tetra"), self.tets, self.labels)

    def test_gmsh(self):
        mesh = meshio.read(self.result / "volume.msh")
        self.assertEqual({name: list(tag) for name, tag in mesh.field_data.items()}, {"label_0": [1, 3], "label_1": [2, 3]})
        self.same(mesh, mesh.get_cell_data("gmsh:physical", "tetra") - 1, *by_label(self.tets, self.labels))
        np.testing.assert_array_equal(mesh.get_cell_data("gmsh:geometrical", "tetra") - 1, np.sort(self.labels))

    def test_surfaces_and_clouds(self):
        surface = meshio.read(self.result / "surface.obj")
        for name in ("surface.ply", "surface.off"):
            other = meshio.read(self.result / name)
            self.assertEqual(other.points.astype(float).tobytes(), surface.points.tobytes(), name)
            np.testing.assert_array_equal(other.get_cells_type("triangle"), surface.get_cells_type("triangle"))
        self.assertEqual(len(meshio.read(self.result / "surface.stl").get_cells_type("triangle")),
                         len(surface.get_cells_type("triangle")))

    def test_the_way_back_that_the_page_shows(self):
        scripts = dict(BLOCK.findall(PAGE.read_text(encoding="utf-8")))
        self.assertEqual(sorted(scripts), ["from_gmsh.py", "from_medit.py"])
        for extension in ("msh", "mesh"):
            (self.folder / f"torus.{extension}").write_bytes((self.result / f"volume.{extension}").read_bytes())
        for script, text in scripts.items():
            (self.folder / script).write_text(text)
            subprocess.run([sys.executable, script], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
            self.dsc("convert", script.replace(".py", ".vtu"), script.replace(".py", ".dsc"))
        self.assertEqual((self.folder / "from_medit.dsc").read_bytes(), (self.result / "volume.dsc").read_bytes())
        points, tets, labels = read_dsc(self.folder / "from_gmsh.dsc")
        self.assertEqual(points.tobytes(), self.points.tobytes())
        expected_tets, expected_labels = by_label(self.tets, self.labels)
        np.testing.assert_array_equal(tets, expected_tets)
        np.testing.assert_array_equal(labels, expected_labels)


if __name__ == "__main__":
    unittest.main()
