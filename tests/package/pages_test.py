#!/usr/bin/env python3
"""The commands of the documentation's pages, run in their order, each page in a folder of its own.

A block of the language sh is run. A block after a comment <!-- file: NAME --> is written to that file.
"""

import json
import re
import unittest

import package

BLOCK = re.compile(r"(?:<!-- file: (\S+) -->\n)?```(\w+)\n(.*?)^```$", re.M | re.S)


def follow(page):
    """Runs the page; its folder, and how many commands it had."""
    folder = package.fresh_folder(f"page_{page}")
    commands = 0
    text = (package.SOURCE / "share/doc" / f"{page}.md").read_text(encoding="utf-8")
    for file, language, block in BLOCK.findall(text):
        if file:
            (folder / file).write_text(block, encoding="utf-8")
        elif language == "sh":
            commands += len(block.splitlines())
            package.run(["bash", "-euc", block], folder)
    return folder, commands


class Pages(unittest.TestCase):
    def info(self, folder, file):
        return json.loads(package.run(["dsc", "info", file, "--json"], folder))

    def test_formats(self):
        folder, commands = follow("formats")
        self.assertEqual(commands, 7)
        self.assertEqual(self.info(folder, "survey.pcd")["points"], 4)
        self.assertTrue(self.info(folder, "torus.obj")["solid"])
        self.assertTrue(self.info(folder, "torus.dsc")["solid"])

    def test_concepts(self):
        folder, commands = follow("concepts")
        self.assertEqual(commands, 10)
        shipped = package.SOURCE / "share/doc/pictures"
        drawn = sorted(file.name for file in folder.glob("*.png"))
        self.assertEqual(drawn, sorted(file.name for file in shipped.glob("concepts_*.png")))
        for name in drawn:  # the same to the byte with one build; others may differ in a few pixels
            size = (shipped / name).stat().st_size
            self.assertLess(abs((folder / name).stat().st_size - size), 0.2 * size, name)
        self.assertEqual(self.info(folder, "after/result/volume.dsc")["inverted_tets"], 0)

    def test_tutorial(self):
        folder, commands = follow("tutorial")
        self.assertEqual(commands, 11)
        self.assertEqual(self.info(folder, "torus.obj")["genus"], 1)
        status = json.loads((folder / "run/status.json").read_text())
        self.assertEqual(status["state"], "done")
        self.assertLess((folder / "run/report.html").stat().st_size, 5e6)
        self.assertTrue((folder / "comparison.html").exists())

    def test_citing(self):
        _, commands = follow("citing")
        self.assertEqual(commands, 1)
        version = package.run(["dsc", "--version"]).split()[1]
        for page in ("CITATION.cff", "share/doc/citing.md"):
            self.assertRegex((package.SOURCE / page).read_text(encoding="utf-8"), rf"version(: | = \{{){re.escape(version)}\b", page)


if __name__ == "__main__":
    unittest.main()
