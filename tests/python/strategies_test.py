#!/usr/bin/env python3
"""Strategies written in Python: their answers, their faults, the conformance tests, and the same bytes as C++."""

import hashlib
import json
import os
import pathlib
import stat
import sys
import unittest

import numpy

import common
import dsc

PAGE = (common.SOURCE / "share/doc/python.md").read_text(encoding="utf-8")
MINE = PAGE[PAGE.index("<!-- file: my_strategies.py -->\n```python\n"):].split("```python\n", 1)[1].split("```\n", 1)[0]
HEAD = common.HEAD


class Strategies(common.Mine):
    # ---- answers

    def test_the_same_bytes_as_the_strategy_in_c_plus_plus(self):
        mine = self.write(MINE)
        for threads in (1, 2):
            given = dsc.run(common.EXPERIMENT, {"velocity": {"type": "attraction", "alpha": 0.3}}, plugins=[mine], threads=threads,
                            output="python")
            dsc.run(common.EXPERIMENT, {"velocity": {"type": "point_cloud", "alpha": 0.3, "beta": 0.0}}, output="c")
            for name in ("result/surface.obj", "result/volume.dsc", "metrics.csv"):
                self.assertEqual(digest("python/" + name), digest("c/" + name), name)
        self.assertEqual(given.steps, 4)

    def test_arrays_of_the_context(self):
        seen = {}
        text = HEAD + '''SEEN = {}

@dsc.velocity("mine")
class Mine:
    """Looks."""
    needs_faces_of_points = True
    needs_support = True

    def evaluate(self, context):
        assert context.volume is None
        for name in dir(context):
            if not name.startswith("_") and name not in ("uniform", "normal", "pass_number", "velocity", "cloud"):
                value = getattr(context, name)
                SEEN[name] = value.copy() if isinstance(value, numpy.ndarray) else value
                if isinstance(value, numpy.ndarray) and name != "box":
                    assert not value.flags.writeable, name
        SEEN["uniform"] = context.uniform(context.births, 2)
        SEEN["points"] = context.cloud.points
        SEEN["nearest"] = context.cloud.nearest(context.positions)
        SEEN["nearest3"] = context.cloud.nearest(context.positions, 3)
        return numpy.zeros((len(context.positions), 3), dtype=numpy.float32)
'''
        dsc.run(common.EXPERIMENT, {"velocity": {"type": "mine"}, "schedule.0.steps": 1}, plugins=[self.write(text)])
        (module,) = [m for n, m in sys.modules.items() if n.startswith("dsc_file_") and hasattr(m, "SEEN")]
        seen = module.SEEN
        x, faces, points = seen["positions"], seen["faces"], seen["points"]
        n, m, p = len(x), len(faces), len(points)
        self.assertEqual((seen["step"], seen["planned_steps"], seen["seed"], seen["cancelled"]), (1, 1, 1, False))
        for name, shape, kind in (("positions", (n, 3), "float64"), ("normals", (n, 3), "float64"), ("movable", (n,), "bool"),
                                  ("births", (n,), "uint32"), ("faces", (m, 3), "uint32"), ("face_areas", (m,), "float64"),
                                  ("face_normals", (m, 3), "float64"), ("face_tets", (m,), "uint32"),
                                  ("face_offsets", (n + 1,), "uint32"), ("vertex_faces", (3 * m,), "uint32"),
                                  ("target_lengths", (n,), "float64"), ("nearest_index", (n,), "uint32"),
                                  ("nearest_distance", (n,), "float64"), ("point_faces", (p,), "uint32"),
                                  ("point_weights", (p, 3), "float64"), ("point_distances", (p,), "float64"),
                                  ("face_labels", (m, 2), "int32"), ("previous_positions", (n, 3), "float64"),
                                  ("arrived", (n,), "bool"), ("age", (n,), "uint32"), ("support", (n,), "float64"),
                                  ("box", (2, 3), "float64"), ("uniform", (n, 2), "float64")):
            self.assertEqual((seen[name].shape, seen[name].dtype.name), (shape, kind), name)
        # Against NumPy's own calculation.
        corner = x[faces]
        normal = numpy.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        numpy.testing.assert_allclose(seen["face_areas"], numpy.linalg.norm(normal, axis=1) / 2, rtol=1e-12)
        numpy.testing.assert_allclose(seen["face_normals"], normal / numpy.linalg.norm(normal, axis=1, keepdims=True), atol=1e-12)
        self.assertGreater((seen["normals"] * x).sum(axis=1).min(), 0)  # outwards
        distance = numpy.linalg.norm(x[:, None] - points[None], axis=2)
        numpy.testing.assert_array_equal(seen["nearest_index"], distance.argmin(axis=1))
        numpy.testing.assert_allclose(seen["nearest_distance"], distance.min(axis=1), rtol=1e-12)
        numpy.testing.assert_array_equal(seen["nearest"][0], seen["nearest_index"])
        numpy.testing.assert_array_equal(seen["nearest3"][0], numpy.argsort(distance, axis=1, kind="stable")[:, :3])
        place = (corner[seen["point_faces"]] * seen["point_weights"][:, :, None]).sum(axis=1)
        numpy.testing.assert_allclose(numpy.linalg.norm(place - points, axis=1), seen["point_distances"], atol=1e-12)
        for v in (0, n // 2, n - 1):
            around = seen["vertex_faces"][seen["face_offsets"][v]:seen["face_offsets"][v + 1]]
            self.assertEqual(sorted(around), sorted(numpy.flatnonzero((faces == v).any(axis=1))))
        self.assertTrue((seen["face_labels"] == [0, 1]).all() and seen["arrived"].all() and (seen["age"] == 0).all())
        numpy.testing.assert_array_equal(seen["previous_positions"], x)
        self.assertTrue((0 <= seen["support"]).all() and (seen["support"] <= 1).all() and seen["support"].max() > 0)
        self.assertTrue((0 <= seen["uniform"]).all() and (seen["uniform"] < 1).all())
        self.assertGreater(len(numpy.unique(seen["uniform"])), n)

    def test_parameters(self):
        body = '''values = dsc.reals([1, 2], doc="List.")
            axis = dsc.vec3([0, 0, 1], unit="length", doc="Axis.")
            count = dsc.integer(3, minimum=1, maximum=9, unit="dimensionless", doc="Count.")
            mode = dsc.choice(["a", "b"], "a", doc="Mode.")
            limit = dsc.real(None, above=0, unit="length", doc="Limit; unset: none.")
            def evaluate(self, context):
                assert self.values == [1.0, 2.0] and self.count == 4 and self.mode == "b" and self.limit is None
                assert isinstance(self.axis, numpy.ndarray) and self.axis.tolist() == [0, 1, 0]
                return numpy.zeros_like(context.positions)'''.replace("            ", "")
        body = "\n".join(line for line in body.splitlines())
        given = {"velocity": {"type": "mine", "count": 4, "mode": "b", "axis": [0, 1, 0]}}
        self.run_mine(body, changes=given)
        for wrong, words in (({"count": 10}, "maximum"), ({"mode": "c"}, "not one of"), ({"kount": 3}, "did you mean 'count'"),
                             ({"limit": 0}, "above"), ({"axis": [1, 2]}, "exactly 3")):
            self.fault(body, words, kind=dsc.ConfigError, changes={"velocity": {"type": "mine", **wrong}})
        said = self.dsc("plugin", "describe", "mine", "--plugin", "mine.py")
        self.assertIn("integer, [1, 9], default 3", said.replace("1 to 9", "[1, 9]"))

    def test_nested_strategies(self):
        body = '''curvature = dsc.strategy("curvature", {"type": "implicit_fairing"}, doc="Curvature.")
base = dsc.strategy("velocity", doc="Velocity.")
def advance(self, context):
    self.base.advance(context)
def evaluate(self, context):
    self.base.prepare(context)
    self.curvature.prepare(context)
    scalar, vector = self.curvature.evaluate()
    assert scalar.shape == (len(context.positions),) and vector.shape == context.positions.shape
    self.mean = float(scalar.mean())
    assert self.mean > 0
    return self.base.evaluate()'''
        base = {"type": "point_cloud", "alpha": 0.3, "beta": 0.0}
        given = self.run_mine(body, changes={"velocity": {"type": "mine", "base": base}})
        expected = dsc.run(common.EXPERIMENT, {"velocity": base})
        numpy.testing.assert_array_equal(given.points, expected.points)

    def test_every_kind(self):
        text = HEAD + '''
@dsc.initial_mesh("cube")
class Cube:
    """Six tets round the diagonal of each cell of a grid; the inner cells have label 1."""
    cells = dsc.integer(6, minimum=4, maximum=20, unit="dimensionless", costly=True, doc="Cells along the box.")

    def build(self, context):
        n = self.cells
        axis = numpy.linspace(-1.5, 1.5, n + 1)
        points = numpy.stack(numpy.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
        index = numpy.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
        tets, labels = [], []
        import itertools
        for cell in itertools.product(range(n), repeat=3):
            inside = all(1 <= c < n - 1 for c in cell)
            for order in itertools.permutations(range(3)):
                corner = list(cell)
                path = [index[tuple(corner)]]
                for k in order:
                    corner[k] += 1
                    path.append(index[tuple(corner)])
                odd = order in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
                tets.append(path[:2] + path[:1:-1] if odd else path)
                labels.append(int(inside))
        return points, tets, labels

    def figures(self):
        return {"cells": self.cells}

    def warnings(self):
        return [("mine.note", "This is a note about the mesh.")]


@dsc.curvature("flat")
class Flat:
    """The curvature of a sphere of radius 1 everywhere."""
    def evaluate(self, context):
        return numpy.ones(len(context.positions)), context.normals


@dsc.velocity("shrink")
class Shrink:
    """Moves every vertex against its curvature."""
    part = dsc.real(0.02, minimum=0, unit="length", doc="Part of the curvature.")
    curvature = dsc.strategy("curvature", {"type": "flat"}, doc="Curvature.")

    def evaluate(self, context):
        self.curvature.prepare(context)
        self.last = self.curvature.evaluate()[0]
        return -self.part * self.curvature.evaluate()[1]

    def sample(self, points, normals):
        return -self.part * normals

    def publish(self):
        return {"bending": self.last}


@dsc.refinement("all_faces")
class AllFaces:
    """Splits all faces that move."""
    needs_sampling = True

    def refine(self, context):
        centre = context.positions[context.faces].mean(axis=1)
        speed = numpy.linalg.norm(context.velocity.sample(centre, context.face_normals), axis=1)
        assert context.pass_number == 0
        return {"split_faces": numpy.flatnonzero(speed > 0)}


@dsc.observer("volume")
class Volume:
    """Measures the volume by the divergence theorem."""
    def begin(self, context):
        self.first = self.volume(context)

    def volume(self, context):
        corner = context.positions[context.faces]
        return numpy.einsum("ij,ij->", corner[:, 0], numpy.cross(corner[:, 1], corner[:, 2])) / 6

    def step(self, context, figures):
        if context.volume is not None:  # it is, in some conformance tests
            self.look_at_tets(context.volume, figures)
        moved = numpy.linalg.norm(context.positions - context.previous_positions, axis=1)
        area = {label: context.face_areas[context.face_labels[:, 1] == label].sum() for label in (1, 2)}
        return {"volume": self.volume(context), "given": figures.volume, "moved": moved.max(), "area": area[1], "none": area[2]}

    def look_at_tets(self, volume, figures):
        row = numpy.full(volume.vertices.max() + 1, -1)
        row[volume.vertices] = numpy.arange(len(volume.vertices))
        corner = volume.positions[row[volume.tet_vertices]]
        volumes = numpy.linalg.det(corner[:, 1:] - corner[:, :1]) / 6
        numpy.testing.assert_allclose(volume.volumes, volumes, rtol=1e-9)
        numpy.testing.assert_allclose(volume.centroids, corner.mean(axis=1), rtol=1e-12)
        if figures.tets == len(volume.tets):  # in a run; the conformance tests invent figures and have other boxes
            numpy.testing.assert_allclose(volumes[volume.labels > 0].sum(), figures.volume, rtol=1e-9)
            numpy.testing.assert_allclose(volumes.sum(), 27, rtol=1e-9)  # the box
            assert abs(volume.quality.min() - figures.min_tet_quality) < 1e-6
            on_box = (abs(abs(corner) - 1.5) < 1e-12).any(axis=(1, 2))
            assert (volume.touches_box == on_box).all()
        inside = volume.neighbours != 2 ** 32 - 1
        place = numpy.full(volume.tets.max() + 1, -1)
        place[volume.tets] = numpy.arange(len(volume.tets))
        tet, face = numpy.nonzero(inside)
        across = place[volume.neighbours[tet, face]]
        assert (volume.neighbours[across] == volume.tets[tet][:, None]).any(axis=1).all()

    def end(self, context):
        return {"change": self.volume(context) - self.first}

    def state(self):
        return {"first": self.first}

    def load(self, state):
        self.first = state["first"]
'''
        mine = self.write(text)
        result = dsc.run({"dsc": 1, "name": "all", "initial_mesh": {"type": "cube"}, "velocity": {"type": "shrink"},
                          "improvement": {"type": "dsc"}, "schedule": [{"steps": 2}, {"refine": {"type": "all_faces"}}, {"steps": 2}],
                          "observers": [{"type": "volume"}]}, plugins=[mine])
        m = result.metrics
        numpy.testing.assert_allclose(m["observers.volume.volume"][1:], m["observers.volume.given"][1:], rtol=1e-12)
        self.assertTrue((m["observers.volume.moved"][1:3] > 0.01).all() and (m["observers.volume.none"][1:] == 0).all())
        self.assertEqual(result.summary["observers"]["volume"]["change"], m["observers.volume.volume"][-1] - 8.0)
        self.assertGreater(m["interface_faces"][3], 2 * m["interface_faces"][1])
        self.assertIn(("mine.note", "This is a note about the mesh."), result.warnings)
        self.assertTrue((result.attributes["bending"] == 1).all())
        self.assertTrue((numpy.diff(m["volume"]) < 0).all())
        self.assertIn("mine.py passes at level standard", self.dsc("plugin", "check", "mine.py", "--level", "standard"))

    # ---- faults

    def test_an_exception_names_file_and_line(self):
        error = self.fault("def evaluate(self, context):\n    return 1 / 0", "velocity 'mine'", "ZeroDivisionError", "mine.py:9",
                           "in evaluate", "step 1", code="strategy.threw")
        self.assertEqual(error.exit_code, 4)
        self.fault("def __init__(self):\n    raise ValueError('no')\ndef evaluate(self, c):\n    return 0", "constructor",
                   "ValueError: no")
        self.fault("def evaluate(self, context):\n    import sys\n    sys.exit(3)", "SystemExit: 3")
        said = self.dsc("run", self.experiment(), expect=4)
        self.assertIn("SystemExit: 3", said)

    def test_wrong_answers(self):
        for answer, words, code in (("None", "NoneType", None), ("context.positions[:-1]", "rows", None),
                                    ("context.positions.T", "shape", None), ("'text'", "data type", None),
                                    ("context.positions + numpy.nan", "(nan, nan, nan)", "strategy.not_finite")):
            self.fault(f"def evaluate(self, context):\n    return {answer}", words, "velocity 'mine'", code=code)

    def test_the_context_cannot_be_changed_or_kept(self):
        self.fault("def evaluate(self, context):\n    context.positions[0] = 0\n    return context.normals", "read-only")
        for keep in ("context.positions", "context.positions[5:, 0]", "context.faces.T", "context.nearest_distance[None]"):
            self.fault(f"def evaluate(self, context):\n    self.kept = {keep}\n    return 0 * context.normals", "keeps the array",
                       ".copy()")
        self.fault("def advance(self, context):\n    self.context = context\n"
                   "def evaluate(self, context):\n    return self.context.positions", "is used after the call")
        self.run_mine("def evaluate(self, context):\n    self.kept = context.positions.copy()\n    return 0.01 * context.normals")

    def test_ctrl_c_inside_a_strategy(self):
        with self.assertRaises(KeyboardInterrupt):
            self.run_mine("def evaluate(self, context):\n    raise KeyboardInterrupt")

    def test_faulty_files(self):
        for text, words in (("x = (", "SyntaxError"), ("raise RuntimeError('no')", "RuntimeError: no"), ("import absent", "absent"),
                            ("x = 1", "registers no strategy"), ("import sys\nsys.exit(0)", "SystemExit"),
                            (common.velocity("pass"), "has no method evaluate"),
                            (HEAD + "@dsc.velocity('mine')\nclass M:\n    def evaluate(self, c):\n        pass", "has no docstring"),
                            (common.velocity("a = dsc.real(5, maximum=1, doc='A.')\ndef evaluate(self, c):\n    pass"), "default"),
                            (common.velocity("a = dsc.real(5, doc='')\ndef evaluate(self, c):\n    pass"), "doc"),
                            (common.velocity("def evaluate(self, c):\n    pass\ndef state(self):\n    pass"), "state and load"),
                            (common.velocity("def evaluate(self, c):\n    pass", '@dsc.velocity("Mine")\nclass M:\n    """M."""\n'), "form")):
            with self.assertRaises(dsc.PluginError, msg=text) as caught:
                dsc.run(common.EXPERIMENT, plugins=[self.write(text)])
            self.assertIn(words, str(caught.exception))
            self.assertIn("mine.py", str(caught.exception))
        self.assertFalse(os.path.exists("__pycache__"))

    def test_a_file_that_others_may_write_is_refused(self):
        path = self.write(common.velocity("def evaluate(self, c):\n    return 0 * c.positions"))
        os.chmod(path, 0o666)
        with self.assertRaises(dsc.PluginError) as caught:
            dsc.run(common.EXPERIMENT, plugins=[path])
        self.assertEqual(caught.exception.code, "plugin.writable")
        os.chmod(path, stat.S_IRUSR | stat.S_IWUSR)

    def test_two_files_with_one_id(self):
        text = common.velocity("def evaluate(self, c):\n    return 0 * c.positions")
        with self.assertRaises(dsc.PluginError) as caught:
            dsc.run(common.EXPERIMENT, plugins=[self.write(text), self.write(text, "other.py")])
        self.assertEqual(caught.exception.code, "plugin.duplicate")

    # ---- provenance, the command, the program's own classes

    def test_provenance_has_the_hash_of_the_file(self):
        path = self.write(MINE, "my_strategies.py")
        text = json.dumps({**common.EXPERIMENT, "velocity": {"type": "attraction"}, "plugins": [{"python": "my_strategies.py"}]})
        pathlib.Path("a.yaml").write_text(text, encoding="utf-8")
        self.dsc("run", "a.yaml", "-o", "run", "-q")
        (entry,) = [p for p in dsc.load_run("run")["provenance"]["plugins"] if p["name"] == "my_strategies"]
        self.assertEqual((entry["sha256"], entry["version"], entry["license"]), (digest(path), "1.0.0", "MIT"))
        self.dsc("run", "run/config.resolved.yaml", "-o", "again", "-q")  # the resolved experiment reproduces the run
        self.assertEqual(digest("run/result/volume.dsc"), digest("again/result/volume.dsc"))
        hashes = {dsc.load_run(f)["provenance"]["config_sha256"] for f in ("run", "again")}
        self.assertEqual(len(hashes), 1)
        self.assertIn("attraction", self.dsc("plugin", "list", "--plugin", path))
        self.assertIn("ok", self.dsc("plugin", "doctor", path))

    def test_a_class_of_the_program(self):
        @dsc.velocity("of_program")
        class OfProgram:
            """Moves inwards."""
            speed = dsc.real(0.01, unit="length", doc="Speed.")

            def evaluate(self, context):
                return -self.speed * context.normals

        result = dsc.run(common.EXPERIMENT, {"velocity": {"type": "of_program"}}, output="run")
        self.assertTrue((numpy.diff(result.metrics["volume"]) < 0).all())
        (entry,) = [p for p in dsc.load_run("run")["provenance"]["plugins"] if p["file"].endswith("strategies_test.py")]
        self.assertEqual(entry["sha256"], digest(__file__))

    def test_conformance(self):
        self.write(MINE, "my_strategies.py")
        said = self.dsc("plugin", "check", "my_strategies.py", "--level", "standard")
        self.assertIn("velocity 'attraction'", said)
        self.assertIn("my_strategies.py passes at level standard", said)

    def test_conformance_finds_faults(self):
        for body, test in (("def evaluate(self, c):\n    import random\n    return c.normals * random.random()", "det.repeat"),
                           ("def prepare(self, c):\n    self.n = getattr(self, 'n', 0) + 1\n"
                            "def evaluate(self, c):\n    return self.n * 0.01 * c.normals", "state.prepare"),
                           ("def advance(self, c):\n    self.n = getattr(self, 'n', 0) + 1\n"
                            "def evaluate(self, c):\n    return self.n * 0.01 * c.normals", "state.roundtrip"),
                           ("def evaluate(self, c):\n    return c.positions[1:]", "param.default"),
                           ("def evaluate(self, c):\n    print('hello')\n    return c.normals", "out.quiet")):
            self.write(common.velocity(body))
            said = self.dsc_output("plugin", "check", "mine.py", "--level", "strict" if test == "out.quiet" else "standard")
            lines = [line for line in said.splitlines() if "FAIL" in line]
            self.assertTrue(any(test in line for line in lines), said)

    def dsc_output(self, *words):
        import subprocess
        return subprocess.run([common.PROGRAM, *words], capture_output=True, text=True, check=False).stdout


def digest(file):
    return hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
