#!/usr/bin/env python3
"""The program's own checker and an independent JSON Schema validator, given the schema that `dsc schema` prints, judge alike.

    schema_test.py --program dsc --plugin libdsc_every_field.so [--seed N] [unittest's arguments]

Every shipped experiment is right for both. Then faults are planted, at every field of every strategy, in every way that its
declaration tells: both must find each of them, at its place, and nothing else.
"""

import argparse
import copy
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import jsonschema
    from experiments import Written, read
except ImportError as error:
    print(f"skipped: {error}; install python3-jsonschema and python3-yaml")
    sys.exit(77)
from values import Values, fields_of_schema, needs_value

ROOT = Path(__file__).resolve().parents[3]
ERROR = re.compile(r"^(?P<file>[^:\n]+)(?::(?P<line>\d+):\d+)?: error: (?P<message>.*)$", re.M)
OPTIONS = argparse.Namespace()


class Program:
    """`dsc` in a folder of its own."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)
        for name in ("bunny", "teapot", "cow"):
            (self.path / f"{name}.obj").write_text("v 0 0 0\n")
        self.environment = {**{k: v for k, v in os.environ.items() if not k.startswith("DSC_")}, "XDG_DATA_HOME": "/nonexistent",
                            "DSC_DATA": str(self.path), "DSC_TEST_TEXT": "some", "DSC_TEST_NUMBER": "3", "LC_ALL": "C"}

    def __call__(self, *words):
        return subprocess.run([OPTIONS.program, *words, "--plugin", OPTIONS.plugin], cwd=self.path, env=self.environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)

    def judge(self, text):
        """[(line, message)] of an experiment, line 0 where none is told; empty where it is right."""
        (self.path / "a.yaml").write_text(text)
        result = self("run", "a.yaml", "--print-config")
        found = [(int(m["line"] or 0), m["message"]) for m in ERROR.finditer(result.stderr)]
        if (result.returncode == 3) != bool(found) or result.returncode not in (0, 3):
            raise AssertionError(f"exit code {result.returncode} with\n{result.stderr}\nfor\n{text}")
        return found


def leaves(errors):
    for error in errors:
        if error.context and error.validator == "anyOf" and not is_required(error):
            yield from leaves(error.context)
        else:
            yield error


def is_required(error):
    """Something is missing, under its own or an old name."""
    return error.validator == "required" or (error.validator == "anyOf" and all(c.validator == "required" for c in error.context))


def inside(path, outer):
    return path[:len(outer)] == outer


class Plant:
    """A tree with faults planted; each by its path and its kind: value, unknown or missing."""

    def __init__(self, tree):
        self.tree = copy.deepcopy(tree)
        self.faults = []

    def owner(self, path):
        node = self.tree
        for key in path[:-1]:
            node = node[key]
        return node

    def free(self, path):
        """Whether the path stands for what it stood for in the tree without faults."""
        return not any(inside(path, fault) or inside(fault, path) for fault, _ in self.faults)

    def value(self, path, below, value):
        self.owner(path)[path[-1]] = copy.deepcopy(value)
        self.faults.append((path + below, "value"))

    def unknown(self, path):
        self.owner(path)[path[-1]] = 1
        self.faults.append((path, "unknown"))

    def missing(self, path):
        del self.owner(path)[path[-1]]
        self.faults.append((path, "missing"))


def explains(fault, error):
    """Whether an error of the validator tells this fault."""
    path, kind = fault
    at = tuple(error.absolute_path)
    if kind == "value":
        # Newer versions of the validator tell what may not be there at all without its key.
        return inside(at, path) or (error.validator is None and at == path[:-1])
    if kind == "unknown":
        return at == path[:-1] and error.validator == "additionalProperties" and repr(path[-1]) in error.message
    return at == path[:-1] and is_required(error) and (path[-1] in error.message or error.validator == "anyOf")


class Judges(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.program = Program()
        described = [json.loads(cls.program("plugin", "describe", s["id"], "--kind", s["kind"], "--format", "json").stdout)
                     for s in json.loads(cls.program("plugin", "list", "--json").stdout)]
        cls.strategies = {}
        for d in described:
            cls.strategies.setdefault(d["kind"], {})[d["id"]] = d
        cls.schema = json.loads(cls.program("schema").stdout)
        jsonschema.Draft7Validator.check_schema(cls.schema)
        cls.validator = jsonschema.Draft7Validator(cls.schema)
        cls.conditions = json.dumps(cls.schema)

    @classmethod
    def tearDownClass(cls):
        cls.program.folder.cleanup()

    def errors(self, text):
        return list(leaves(self.validator.iter_errors(read(text))))

    def values(self, name):
        return Values(random.Random(f"{OPTIONS.seed} {name}"), self.strategies)

    def expect_right(self, text):
        self.assertEqual([f"{list(e.absolute_path)}: {e.message}" for e in self.errors(text)], [], text)
        self.assertEqual(self.told(text), [], text)

    def told(self, text):
        """What dsc finds, but for conditions between parameters, which are beyond a schema."""
        return [(line, message) for line, message in self.program.judge(text) if message.split(": ", 1)[-1] not in self.conditions]

    def expect_wrong(self, plant):
        """Both find each fault and nothing else."""
        written = Written(plant.tree)
        told = self.told(written.text)
        errors = self.errors(written.text)
        for fault in plant.faults:
            path, kind = fault
            first, last = written.place(path[:-1] if kind == "missing" else path)
            self.assertTrue(any(first <= line <= last for line, _ in told), f"not told by dsc: {fault} in\n{written.text}\n{told}")
            self.assertTrue(any(explains(fault, e) for e in errors), f"not told by the schema: {fault} in\n{written.text}")
        places = [written.place(path[:-1] if kind == "missing" else path) for path, kind in plant.faults]
        for line, message in told:
            self.assertTrue(any(first <= line <= last for first, last in places), f"told by dsc: {line}: {message} in\n{written.text}")
        for e in errors:
            self.assertTrue(any(explains(fault, e) for fault in plant.faults),
                            f"told by the schema: {list(e.absolute_path)}: {e.message} in\n{written.text}")
        return len(plant.faults)


def experiment(**changes):
    return {"dsc": 1, "initial_mesh": {"type": "grid"}, "velocity": {"type": "normal"}, "improvement": {"type": "dsc"},
            "schedule": [{"steps": 1}], **changes}


def hosted(kind, strategy):
    """(an experiment with this strategy, the path of the strategy)."""
    if kind == "curvature":
        return experiment(velocity={"type": "curvature_flow", "curvature": strategy}), ("velocity", "curvature")
    if kind == "refinement":
        return experiment(schedule=[{"refine": strategy}]), ("schedule", 0, "refine")
    if kind == "observer":
        return experiment(observers=[strategy]), ("observers", 0)
    if kind == "filter":
        return experiment(input={"cloud": {"sample": {"shape": "sphere"}, "filters": [strategy]}}), ("input", "cloud", "filters", 0)
    return experiment(**{kind: strategy}), (kind,)


def sites(fields, path):
    """(path, field) of all fields, those in maps and in the first map of a list too."""
    for field in fields:
        here = path + (field["name"],)
        yield here, field
        if field["type"] in ("map", "list of maps"):
            yield from sites(field["fields"], here if field["type"] == "map" else here + (0,))


def maps(fields, path):
    """(path, names of the keys) of a map and all maps in it."""
    yield path, [field["name"] for field in fields]
    for field in fields:
        if field["type"] in ("map", "list of maps"):
            yield from maps(field["fields"], path + (field["name"],) + (() if field["type"] == "map" else (0,)))


class Shipped(Judges):
    def test_every_config_is_right_for_both(self):
        configs = sorted(c for c in (ROOT / "configs").rglob("*.yaml") if c.parent.name != "sweeps")
        self.assertGreater(len(configs), 10)
        for config in configs:
            with self.subTest(config=config.relative_to(ROOT).as_posix()):
                self.assertEqual([e.message for e in self.errors(config.read_text())], [])
                result = self.program("run", str(config), "--print-config")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertEqual([e.message for e in self.errors(result.stdout)], [], "what --print-config prints")

    def test_blocks_of_describe_are_right_where_they_belong(self):
        for kind, known in self.strategies.items():
            for name in known:
                block = self.program("plugin", "describe", name, "--kind", kind, "--format", "yaml").stdout
                pasted = next(iter(read(block).values()))
                pasted = pasted[0] if isinstance(pasted, list) else pasted
                with self.subTest(strategy=f"{kind} {name}"):
                    lacking = {f["name"] for f in known[name]["parameters"] if f["required"]} - pasted.keys()
                    for field in known[name]["parameters"]:
                        if field["name"] in lacking or needs_value(field):
                            pasted[field["name"]] = self.values(name).good(field)
                    self.expect_right(Written(hosted(kind, pasted)[0]).text)

    def test_numbers_are_read_as_the_program_reads_them(self):
        text = "[1e3, 1.0e-3, -2, 012, yes, 1:30, 0x1f, .5, +1, 2026-01-01, ~, null, true, False, 1_000]"
        self.assertEqual(read(text), [1000.0, 0.001, -2, "012", "yes", "1:30", "0x1f", ".5", "+1", "2026-01-01", None, None, True,
                                      "False", "1_000"])


class Strategies(Judges):
    def described(self):
        return [(kind, name, d) for kind, known in self.strategies.items() for name, d in known.items()]

    def complete(self, kind, name, values):
        values.complete = True
        return hosted(kind, values.good_strategy(kind, name))

    def test_good_values_are_right_for_both(self):
        for kind, name, _ in self.described():
            values = self.values(name)
            for number in range(8 if name == "every_field" else 3):
                with self.subTest(strategy=f"{kind} {name}", number=number):
                    self.expect_right(Written(hosted(kind, values.good_strategy(kind, name))[0]).text)
            for values.end in ("minimum", "maximum"):
                with self.subTest(strategy=f"{kind} {name}", ends=values.end):
                    self.expect_right(Written(self.complete(kind, name, values)[0]).text)

    def plant_values(self, kind, name, fields, whole):
        """All bad values of all fields, as many at once as there are fields."""
        values = self.values(name)
        tree, path = self.complete(kind, name, values)
        bad = {at: (list(values.bad(field))) for at, field in sites(fields, path)
               if (field["type"] in ("map", "list of maps")) == whole}
        count = 0
        for number in range(max(map(len, bad.values()), default=0)):
            plant = Plant(tree)
            for at, ways in bad.items():
                if number < len(ways) and plant.free(at):
                    plant.value(at, *ways[number])
            count += self.expect_wrong(plant)
        return count

    def test_bad_values_are_found_by_both(self):
        count = 0
        for kind, name, d in self.described():
            with self.subTest(strategy=f"{kind} {name}"):
                count += self.plant_values(kind, name, d["parameters"], whole=False)
                count += self.plant_values(kind, name, d["parameters"], whole=True)
        print(f"{count} bad values, seed {OPTIONS.seed}")
        self.assertGreater(count, 1000)

    def test_unknown_keys_are_found_by_both(self):
        for kind, name, d in self.described():
            with self.subTest(strategy=f"{kind} {name}"):
                tree, path = self.complete(kind, name, self.values(name))
                plant = Plant(tree)
                for at, keys in maps(d["parameters"], path):
                    plant.unknown(at + ((keys[0] if keys else "typ") + "x",))
                self.expect_wrong(plant)

    def test_missing_parameters_are_found_by_both(self):
        count = 0
        for kind, name, d in self.described():
            tree, path = self.complete(kind, name, self.values(name))
            for at, field in [((path + ("type",)), None), *sites(d["parameters"], path)]:
                if field is None or field["required"] or needs_value(field):
                    with self.subTest(path=at):
                        plant = Plant(tree)
                        plant.missing(at)
                        count += self.expect_wrong(plant)
        self.assertGreater(count, 20)

    def test_what_the_type_of_a_member_can_hold(self):
        values = self.values("storage")
        tree, path = self.complete("velocity", "every_field", values)
        for name, value in (("byte", 256), ("byte", -1), ("limit", 2**31), ("count", -2**40)):
            with self.subTest(name=name, value=value):
                plant = Plant(tree)
                plant.value(path + (name,), (), value)
                self.expect_wrong(plant)

    def test_old_names(self):
        values = self.values("old names")
        values.complete = True
        tree, _ = hosted("velocity", values.good_strategy("velocity", "every_field"))
        owner = tree["velocity"]
        owner["inner"] = {"heaviness": 0.5}
        for old, new, value in (("number", "count", 4), ("source", "file", "a.txt")):
            del owner[new]
            owner[old] = value
        self.expect_right(Written(tree).text)
        plant = Plant(tree)
        for old, new, value in (("number", "count", 4), ("source", "file", "a.txt")):
            plant.tree["velocity"][new] = value
            plant.faults.append((("velocity", old), "value"))
        self.expect_wrong(plant)
        plant = Plant(tree)
        plant.value(("velocity", "number"), (), "many")
        self.expect_wrong(plant)


class Experiments(Judges):
    """The keys of the experiment itself."""

    def fields(self):
        return [f for f in fields_of_schema(self.schema) if f["name"] != "include"]

    def complete(self, values):
        values.complete = True
        tree = values.good_map({"fields": [f for f in self.fields() if f["name"] not in ("dsc", "plugins")]})
        tree["input"]["cloud"]["sample"]["shape"] = "torus"
        return {"dsc": 1, **tree}

    def test_good_values_are_right_for_both(self):
        values = self.values("experiment")
        for number in range(10):
            with self.subTest(number=number):
                self.expect_right(Written(self.complete(values)).text)

    def test_bad_values_are_found_by_both(self):
        values = self.values("bad experiment")
        tree = self.complete(values)
        for whole in (False, True):
            bad = {}
            for at, field in sites(self.fields(), ()):
                if (field["type"] in ("map", "list of maps")) == whole and at[0] != "plugins":
                    bad[at] = list(values.bad(field))
            for number in range(max(map(len, bad.values()))):
                plant = Plant(tree)
                for at, ways in bad.items():
                    if number < len(ways) and plant.free(at):
                        plant.value(at, *ways[number])
                self.expect_wrong(plant)

    def test_unknown_and_missing_keys_are_found_by_both(self):
        tree = self.complete(self.values("keys"))
        plant = Plant(tree)
        for at, keys in maps(self.fields(), ()):
            plant.unknown(at + (keys[0] + "x",))
        self.expect_wrong(plant)
        for name in ("dsc", "initial_mesh", "velocity", "improvement", "schedule"):
            with self.subTest(missing=name):
                plant = Plant(tree)
                plant.missing((name,))
                self.expect_wrong(plant)

    def test_what_an_include_leaves_to_its_files(self):
        (self.program.path / "base.yaml").write_text(Written(experiment(velocity={"type": "point_cloud"})).text)
        self.expect_right("include: base.yaml\nvelocity: {alpha: 0.1}\n")
        self.expect_right("include: [base.yaml]\nvelocity: {type: rotate, degrees: 2}\n")
        for text, path in (("include: base.yaml\nvelocty: {}\n", ()),
                           ("include: base.yaml\nvelocity: {type: rotate, degrees: 200}\n", ("velocity", "degrees")),
                           ("include: base.yaml\nschedule: [{steps: 1, every: 1, refine: {factor: 2}}]\n", ("schedule", 0, "refine"))):
            with self.subTest(text=text):
                self.assertEqual([tuple(e.absolute_path) for e in self.errors(text)], [path])
                self.assertEqual([line for line, _ in self.program.judge(text)], [2])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("--program", "--plugin"):
        parser.add_argument(name, required=True, type=lambda text: str(Path(text).resolve()))
    parser.add_argument("--seed", type=int, default=1)
    _, rest = parser.parse_known_args(namespace=OPTIONS)
    unittest.main(argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
