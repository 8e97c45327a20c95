#!/usr/bin/env python3
"""share/doc/write-a-strategy.md, followed to the letter: its files are written and its commands run, in their order.

A block of the language sh is run. A block after a comment <!-- file: NAME --> is written to that file.
"""

import csv
import json
import math
import re
import unittest

import package

PAGE = package.SOURCE / "share/doc/write-a-strategy.md"
BLOCK = re.compile(r"(?:<!-- file: (\S+) -->\n)?```(\w+)\n(.*?)^```$", re.M | re.S)


def steps():
    """(file or None, text) in the order of the page."""
    for file, language, text in BLOCK.findall(PAGE.read_text(encoding="utf-8")):
        if file or language == "sh":
            yield file or None, text


def area_of(obj):
    """The sum of the areas of the triangles in an OBJ file."""
    lines = [line.split() for line in obj.read_text(encoding="utf-8").splitlines()]
    points = [[float(x) for x in words[1:4]] for words in lines if words[:1] == ["v"]]
    area = 0.0
    for words in lines:
        if words[:1] != ["f"]:
            continue
        p, q, r = (points[int(word.split("/")[0]) - 1] for word in words[1:4])
        u, v = ([b - a for a, b in zip(p, end)] for end in (q, r))
        cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        area += 0.5 * math.sqrt(sum(x * x for x in cross))
    return area


class Tutorial(unittest.TestCase):
    def examples(self, run):
        """What the page says about the project with three strategies."""
        with open(run / "metrics.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        areas = [float(row["observers.label_area.area_1"]) for row in rows[1:]]
        self.assertEqual(len(areas), 15)
        self.assertAlmostEqual(areas[-1] / area_of(run / "result/surface.obj"), 1.0, places=9)
        asked = int(rows[6]["refine_requested"])
        self.assertGreater(asked, 20)
        self.assertEqual(rows[5]["refine_requested"], "0")
        items = json.loads((run / "summary.json").read_text())["refinements"]["items"]
        self.assertEqual([(item["type"], item["item"], item["calls"], item["requested"]) for item in items], [("shave", 1, 1, asked)])
        self.assertEqual(items[0]["committed"], int(rows[6]["refine_committed"]))

    def test_every_command_works(self):
        folder = package.fresh_folder("tutorial")
        commands = 0
        for file, text in steps():
            if file:
                (folder / file).write_text(text, encoding="utf-8")
                continue
            commands += len(text.splitlines())
            package.run(["bash", "-euc", text], folder)
        self.assertGreater(commands, 8)
        for run, volume in (("run", 1.413), ("shrinking", 0.702)):  # the figures of the page
            summary = json.loads((folder / "steady" / run / "summary.json").read_text())
            self.assertAlmostEqual(summary["volume"], volume, places=3)
        self.examples(folder / "three/run")
        self.assertTrue((folder / "steady.png").stat().st_size > 1000)
        self.assertIn("steady", package.run(["dsc", "plugin", "list"], folder))
        (package.SCRATCH / "home/.local/share/dsc/plugins/libdsc_steady.so").unlink()


if __name__ == "__main__":
    unittest.main()
