#!/usr/bin/env python3
"""Arguments of every kind, results as arrays, and errors as exceptions."""

import hashlib
import inspect
import json
import os
import pickle
import subprocess
import sys
import unittest

import numpy

import common
import dsc

POINTS = common.sphere()


class Arguments(common.Scratch):
    def refused(self, code, *arguments, kind=dsc.UsageError, **options):
        with self.assertRaises(kind) as caught:
            dsc.reconstruct(*arguments, **options)
        error = caught.exception
        self.assertEqual(error.code, code, str(error))
        self.assertIsInstance(error, dsc.Error)
        for part in (error.cause, error.remedy):
            self.assertTrue(part)
            self.assertIn(part, str(error))
        return error

    def test_shapes_are_named(self):
        for wrong, shape in ((numpy.zeros((5, 2)), "(5, 2)"), (numpy.zeros(6), "(6,)"), (numpy.zeros((2, 3, 3)), "(2, 3, 3)"),
                             (numpy.zeros((3, 5)), "(3, 5)"), ([], "(0,)"), (1.5, "()")):
            error = self.refused("array.shape", wrong)
            self.assertIn(shape, error.cause)
            self.assertEqual(error.place, "points")
        self.refused("array.shape", numpy.zeros((0, 3)))
        self.refused("array.shape", POINTS, normals=POINTS[:-1])
        self.refused("array.shape", POINTS, colors=numpy.zeros((3, 3), numpy.uint8))
        self.refused("array.shape", POINTS, colors=numpy.zeros((len(POINTS), 4), numpy.uint8))

    def test_types_are_named(self):
        for wrong, name in ((POINTS.astype(complex), "complex128"), (POINTS.astype(str), "<U"), (POINTS > 0, "bool"),
                            ([["a", "b", "c"]], "<U1"), (numpy.empty((4, 3), object), "object")):
            self.assertIn(name, self.refused("array.type", wrong).cause)
        for wrong in (None, object(), {"points": 1}):
            self.refused("array.type", wrong)
        self.refused("array.type", [[0, 0, 0], [1, 0]])

    def test_not_finite_names_the_row(self):
        for value, word in ((numpy.nan, "NaN"), (numpy.inf, "infinite"), (-numpy.inf, "infinite")):
            points = POINTS.copy()
            points[17, 1] = value
            error = self.refused("array.not_finite", points)
            self.assertIn("row 17", error.cause)
            self.assertIn(word, error.cause)
        normals = POINTS.copy()
        normals[3, 0] = numpy.nan
        self.assertEqual(self.refused("array.not_finite", POINTS, normals=normals).place, "normals")

    def test_colours(self):
        self.refused("array.range", POINTS, colors=numpy.full(POINTS.shape, 256))
        self.refused("array.range", POINTS, colors=numpy.full(POINTS.shape, -1))
        self.refused("array.range", POINTS, colors=numpy.full(POINTS.shape, 1.5))

    def test_options(self):
        for options in ({"detail": "huge"}, {"edge_length": 0}, {"edge_length": float("nan")}, {"edge_length": "1"}, {"vertices": 99},
                        {"vertices": 100.5}, {"vertices": 100, "edge_length": 1}, {"smooth": -1}, {"smooth": "much"}, {"threads": 0},
                        {"on_step": 3}):
            self.assertIn(list(options)[-1], self.refused("usage.argument", POINTS, **options).place)
        with self.assertRaises(TypeError):
            dsc.reconstruct(POINTS, unknown=1)

    def test_geometry(self):
        self.refused("cloud.few", [[0, 0, 0], [1, 0, 0], [0, 1, 0]], kind=dsc.GeometryError)
        flat = POINTS * [1, 1, 0]
        self.assertEqual(self.refused("cloud.coplanar", flat, kind=dsc.GeometryError).exit_code, 5)

    def test_files(self):
        self.refused("io.missing", "absent.ply", kind=dsc.IoError)
        self.refused("usage.argument", "absent.ply", normals=POINTS)

    def test_layouts_and_types_of_points_do_not_matter(self):
        integers = numpy.round(POINTS * 1000).astype(numpy.int32)
        expected = dsc.reconstruct(integers.astype(float), detail="low")
        padded = numpy.zeros((len(integers), 5))
        padded[:, 1:4] = integers
        backwards = numpy.ascontiguousarray(integers[::-1].astype(float))[::-1]
        for same in (integers, integers.tolist(), padded[:, 1:4], numpy.asfortranarray(integers.astype(float)), backwards,
                     integers.astype(">f8"), integers.astype(numpy.float32), integers.astype(numpy.int64)):
            given = dsc.reconstruct(same, detail="low")
            numpy.testing.assert_array_equal(given.vertices, expected.vertices)
            numpy.testing.assert_array_equal(given.tets, expected.tets)


class Results(common.Scratch):
    @classmethod
    def setUpClass(cls):
        colors = numpy.where(POINTS[:, :1] > 0, [[255, 0, 0]], [[0, 0, 255]])
        cls.result = dsc.reconstruct(POINTS, normals=POINTS, colors=colors, detail="low")

    def test_arrays(self):
        r = self.result
        n, m, p, k = len(r.vertices), len(r.faces), len(r.points), len(r.tets)
        for name, shape, kind in (("vertices", (n, 3), "float64"), ("faces", (m, 3), "uint32"), ("points", (p, 3), "float64"),
                                  ("tets", (k, 4), "uint32"), ("labels", (k,), "int32"), ("quality", (k,), "float64"),
                                  ("vertex_points", (n,), "uint32"), ("support", (n,), "float64"), ("colors", (n, 3), "uint8")):
            array = getattr(r, name)
            self.assertEqual((array.shape, array.dtype.name), (shape, kind), name)
            self.assertTrue(array.flags.c_contiguous and array.flags.aligned, name)
            with self.assertRaises(ValueError, msg=name):
                array[0] = array[1]
        self.assertGreater(n, 100)
        numpy.testing.assert_array_equal(r.points[r.vertex_points], r.vertices)
        self.assertEqual(r.status, "converged")
        self.assertIsNone(r.folder)
        self.assertEqual(len(r.metrics["step"]), r.steps + 1)

    def test_the_solid_is_the_sphere(self):
        r = self.result
        self.assertEqual(n_euler(r.faces), 2)
        self.assertAlmostEqual(r.label_volume(1), 4.0 / 3.0 * numpy.pi, delta=0.1)
        corner = r.vertices[r.faces]  # the divergence theorem
        inside = numpy.einsum("ij,ij->i", corner[:, 0], numpy.cross(corner[:, 1], corner[:, 2])).sum() / 6
        self.assertAlmostEqual(inside, r.label_volume(1), places=9)
        edges = r.points[r.tets][:, 1:] - r.points[r.tets][:, :1]
        volumes = numpy.linalg.det(edges) / 6
        self.assertGreater(volumes.min(), 0)
        self.assertTrue(0 < r.quality.min() and r.quality.max() <= 1 + 1e-12)
        # 1 for the regular tet: 6 sqrt(2) V over the cube of the root mean square of the edges.
        a, b, c, d = numpy.moveaxis(r.points[r.tets], 1, 0)
        squares = sum(((q - s) ** 2).sum(axis=1) for q, s in ((a, b), (a, c), (a, d), (b, c), (b, d), (c, d))) / 6
        numpy.testing.assert_allclose(r.quality, 6 * numpy.sqrt(2) * volumes / squares ** 1.5, rtol=1e-9)

    def test_colours_and_support(self):
        r = self.result
        far = numpy.abs(r.vertices[:, 0]) > 0.3
        red = r.colors[:, 0] == 255
        self.assertTrue(numpy.array_equal(red[far], r.vertices[far, 0] > 0))
        self.assertTrue(0 <= r.support.min() and r.support.max() <= 1)
        self.assertGreater(r.support.mean(), 0.5)

    def test_saved_files_are_those_of_the_command(self):
        numpy.savetxt("points.xyz", POINTS, fmt="%.17g")
        given = dsc.reconstruct(POINTS, detail="low")
        self.dsc("reconstruct", "points.xyz", "--detail", "low", "-q", "-o", "a.obj", "-o", "a.ply", "-o", "a.stl", "-o", "a.off",
                 "-o", "a.vtu", "-o", "a.dsc", "-o", "a.msh", "-o", "a.mesh")
        for ending in ("obj", "ply", "stl", "off", "vtu", "dsc", "msh", "mesh"):
            given.save(self.folder / f"b.{ending}")
            self.assertEqual(digest(f"a.{ending}"), digest(f"b.{ending}"), ending)
        with self.assertRaises(dsc.UsageError) as caught:
            given.save("b.docx")
        self.assertEqual(caught.exception.code, "usage.format")
        with self.assertRaises(dsc.IoError):
            given.save("absent/b.ply")
        from_file = dsc.reconstruct("points.xyz", detail="low")
        numpy.testing.assert_array_equal(from_file.vertices, given.vertices)

    def test_evaluation(self):
        self.result.save("self.obj")
        moved = self.result.vertices + [0.01, 0, 0]
        same = dsc.evaluate(self.result, "self.obj", samples=2000)
        self.assertLess(same["hausdorff_percent"], 1e-9)
        self.assertEqual(same["f_score_0.5_percent"], 1)
        other = dsc.evaluate((moved, self.result.faces), self.result, samples=2000)
        self.assertGreater(other["hausdorff_percent"], 0.2)
        numpy.savetxt("unused.xyz", POINTS)
        from_command = json.loads(self.dsc("evaluate", "self.obj", "--truth", "self.obj", "--samples", "2000", "--json"))["truth"]
        self.assertEqual({k: v for k, v in from_command.items() if k in same}, same)
        for wrong in (5, (POINTS,), (POINTS, [[0, 1, len(POINTS)]]), (POINTS, [[0.5, 1, 2]])):
            with self.assertRaises(dsc.UsageError):
                dsc.evaluate(self.result, wrong)
        with self.assertRaises(dsc.UsageError):
            dsc.evaluate(self.result, "self.obj", samples=10)

    def test_arrays_outlive_the_result(self):
        result = dsc.reconstruct(POINTS, detail="low")
        kept, copy = result.vertices, result.vertices.copy()
        del result
        numpy.testing.assert_array_equal(kept, copy)
        self.assertEqual(pickle.loads(pickle.dumps(kept)).shape, copy.shape)


class Package(unittest.TestCase):
    def test_help_gives_shapes_and_units(self):
        text = inspect.getdoc(dsc.reconstruct)
        for word in ("(n, 3)", "units", "Raises", "detail", "normals"):
            self.assertIn(word, text)
        for name in dsc.__all__:
            self.assertTrue(inspect.getdoc(getattr(dsc, name)), name)

    def test_stubs_name_what_the_package_has(self):
        stub = os.path.join(os.path.dirname(dsc.__file__), "__init__.pyi")
        with open(stub, encoding="utf-8") as file:
            text = file.read()
        compile(text, stub, "exec")
        for name in dsc.__all__:
            self.assertRegex(text, rf"(?m)^(def|class) {name}\b", name)
        for name in ("reconstruct", "run", "evaluate"):
            names = list(inspect.signature(getattr(dsc, name)).parameters)
            stated = text[text.index(f"def {name}("):]
            stated = stated[:stated.index(") ->")]
            for parameter in names:
                self.assertRegex(stated, rf"\b{parameter}:", f"{name}({parameter})")
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(dsc.__file__), "py.typed")))

    def test_errors_have_parts(self):
        for name, exit_code in (("UsageError", 2), ("ConfigError", 3)):
            self.assertTrue(issubclass(getattr(dsc, name), dsc.Error))
            with self.assertRaises(getattr(dsc, name)) as caught:
                dsc.reconstruct(None) if exit_code == 2 else dsc.run({"dsc": 1, "schedule": [], "vellocity": 1})
            self.assertEqual(caught.exception.exit_code, exit_code)

    def test_version_is_that_of_the_command(self):
        said = subprocess.run([common.PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(said.split()[1], dsc.__version__)


def n_euler(faces):
    edges = numpy.unique(numpy.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
    return len(numpy.unique(faces)) - len(edges) + len(faces)


def digest(file):
    with open(file, "rb") as content:
        return hashlib.sha256(content.read()).hexdigest()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
