#!/usr/bin/env python3
"""What an installation holds: relocatable, complete, its headers free of everything but Eigen."""

import json
import os
import re
import unittest

import package


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.first = package.install()

    def test_no_text_names_a_folder_of_the_build(self):
        for file in package.PREFIX.rglob("*"):
            if file.suffix in {".cmake", ".hpp", ".cpp"}:
                text = file.read_text(encoding="utf-8")
                for folder in (self.first, package.BUILD, package.SOURCE):
                    self.assertNotIn(str(folder), text, file)

    def test_the_program_finds_its_library_plugins_and_data(self):
        self.assertIn("fingerprint abi_major=", package.run(["dsc", "--version"]))
        strategies = json.loads(package.run(["dsc", "plugin", "list", "--json"]))
        for kind in package.KINDS:
            self.assertTrue([s for s in strategies if s["kind"] == kind], kind)
        for strategy in strategies:
            self.assertTrue(strategy["file"].startswith(str(package.PREFIX)), strategy)
        self.assertTrue((package.PREFIX / "share/dsc/data/teapot.bpt").is_file())

    def test_man_page_completion_pages_and_workflow_are_there(self):
        for file in ("share/man/man1/dsc.1", "share/bash-completion/completions/dsc", "share/dsc/workflow/Snakefile"):
            self.assertTrue((package.PREFIX / file).is_file(), file)
        for page in sorted((package.SOURCE / "share/doc").rglob("*.md")):
            installed = package.PREFIX / "share/doc/dsc" / page.relative_to(package.SOURCE / "share/doc")
            self.assertEqual(installed.read_bytes(), page.read_bytes(), page)
        point = package.PREFIX / "share/dsc/workflow/run_point.sh"
        self.assertIn("expected a folder of a point", package.run([point], expect=2))

    def test_python_imports_the_moved_package_and_the_command_runs_python(self):
        modules = package.PREFIX / "lib/python3/dist-packages"
        python = os.environ["DSC_PACKAGE_PYTHON"]
        if not python:
            self.skipTest("this build has no Python package")
        said = package.run([python, "-c", "import dsc; print(dsc.__file__); r = dsc.run({'dsc': 1, 'initial_mesh': {'type': 'grid', "
                            "'cells': 8}, 'velocity': {'type': 'normal'}, 'improvement': {'type': 'dsc'}, 'schedule': [{'steps': 1}]}); "
                            "r.save('p.obj'); print(r.steps)"], PYTHONPATH=str(modules))
        self.assertEqual(said.split("\n")[0], str(modules / "dsc/__init__.py"))
        self.assertEqual(said.split()[-1], "1")
        (package.SCRATCH / "mine.py").write_text('import dsc\n\n@dsc.velocity("mine")\nclass Mine:\n    """Rests."""\n'
                                                 "    def evaluate(self, context):\n        return 0 * context.positions\n",
                                                 encoding="utf-8")
        self.assertIn("passes at level smoke", package.run(["dsc", "plugin", "check", "mine.py", "--level", "smoke"]))

    def test_headers_need_the_standard_library_and_eigen(self):
        headers = sorted((package.PREFIX / "include").rglob("*.hpp"))
        self.assertGreater(len(headers), 60)
        for header in headers:
            for included in re.findall(r"^\s*#\s*include\s*[<\"]([^>\"]+)", header.read_text(encoding="utf-8"), re.M):
                allowed = included.startswith(("dsc/", "Eigen/")) or re.fullmatch(r"[a-z_]+", included)
                self.assertTrue(allowed, f"{header}: {included}")
                if included.startswith("dsc/"):
                    self.assertTrue((package.PREFIX / "include" / included).is_file(), f"{header}: {included}")


if __name__ == "__main__":
    unittest.main()
