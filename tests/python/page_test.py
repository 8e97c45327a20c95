#!/usr/bin/env python3
"""The examples of share/doc/python.md, run in their order in one folder, and the three lines of README.md."""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import unittest

import common

BLOCK = re.compile(r"(?:<!-- file: (\S+) -->\n)?```(\w+)\n(.*?)^```$", re.M | re.S)


class Page(common.Scratch):
    def test_examples(self):
        text = (common.SOURCE / "share/doc/python.md").read_text(encoding="utf-8")
        names, ran = {"__name__": "examples"}, {"python": 0, "sh": 0}
        program = os.path.dirname(common.PROGRAM)
        said = io.StringIO()
        for file, language, block in BLOCK.findall(text):
            if file:
                (self.folder / file).write_text(block, encoding="utf-8")
            elif language == "python":
                with contextlib.redirect_stdout(said):
                    exec(compile(block, "share/doc/python.md", "exec"), names)  # the examples need no other guard than this folder
                ran["python"] += 1
            elif language == "sh":
                done = subprocess.run(["bash", "-euc", block], env={**os.environ, "PATH": f"{program}:{os.environ['PATH']}"},
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                ran["sh"] += 1
        self.assertEqual(ran, {"python": 5, "sh": 1})
        self.assertIn("<dsc.Result: converged", said.getvalue())
        self.assertIn("array.not_finite | points | contains NaN in row 2", said.getvalue())
        self.assertEqual(names["figures"]["f_score_1_percent"], 1)
        self.assertEqual(names["columns"]["velocity.alpha"].tolist(), [0.1, 0.3])
        self.assertGreater(names["grown"].metrics["volume"][-1], names["grown"].metrics["volume"][1])
        for name in ("result/surface.obj", "result/volume.dsc", "metrics.csv"):
            self.assertEqual((self.folder / "by_command" / name).read_bytes(), (self.folder / "by_python" / name).read_bytes(), name)

    def test_the_page_names_every_member_of_the_contexts(self):
        text = (common.SOURCE / "share/doc/python.md").read_text(encoding="utf-8")
        import dsc
        views = sys.modules["dsc._start"]._dsc
        for view in (views.StepContext, views.InitialMeshContext, views.Cloud, views.Volume, dsc.Result):
            for name in vars(view):
                if not name.startswith("_"):
                    self.assertRegex(text, rf"`[^`]*\b{name}\b[^`]*`", f"{view.__name__}.{name}")

    def test_readme(self):
        text = (common.SOURCE / "README.md").read_text(encoding="utf-8")
        (block,) = [block for block in re.findall(r"^```\w*\n(.*?)^```$", text, re.M | re.S) if "import dsc" in block]
        (self.folder / "build/release/lib").mkdir(parents=True)
        packages = os.environ["PYTHONPATH"]
        (self.folder / "build/release/lib/python3").mkdir()
        os.symlink(packages, self.folder / "build/release/lib/python3/dist-packages")
        os.symlink(os.path.dirname(common.PROGRAM), self.folder / "build/release/bin")
        environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
        done = subprocess.run(["bash", "-euc", block], env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        info = json.loads(self.dsc("info", "surface.ply", "--json"))
        self.assertTrue(info["solid"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
