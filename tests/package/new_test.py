#!/usr/bin/env python3
"""`dsc plugin new` for each kind, by the moved program: what it writes builds, passes its tests and runs at once."""

import csv
import json
import unittest

import package

WARNINGS = "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror"
# One build for all six saves the configuring of five; the libraries lie where the experiments look for them.
TOGETHER = """cmake_minimum_required(VERSION 3.25)
project(together LANGUAGES CXX)
find_package(dsc REQUIRED COMPONENTS sdk)
enable_testing()
foreach(kind IN ITEMS {kinds})
  add_subdirectory(my_${{kind}} ${{CMAKE_CURRENT_SOURCE_DIR}}/my_${{kind}}/build)
endforeach()
# Every public header, by itself in this order, with the package's own include folders only.
add_library(headers OBJECT headers.cpp)
target_link_libraries(headers PRIVATE dsc::core dsc::sdk)
"""
NOTES = """# Of @PROJECT_NAME@.
strategies: [{kind: observer, id: my_observer, waive: {seed.used: to see a waiver}}]
"""


class New(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = package.fresh_folder("new")
        for kind in package.KINDS:
            package.run(["dsc", "plugin", "new", f"my_{kind}", "--kind", kind], cls.folder)
        include = package.PREFIX / "include"
        headers = sorted(h.relative_to(include) for h in include.rglob("*.hpp"))
        (cls.folder / "headers.cpp").write_text("".join(f"#include <{h}>\n" for h in headers))
        # One of them has notes for `dsc plugin check`.
        (cls.folder / "notes.yaml").write_text(NOTES)
        project = cls.folder / "my_observer/CMakeLists.txt"
        project.write_text(project.read_text().replace(" TESTS", " CHECK ../notes.yaml TESTS"))
        (cls.folder / "CMakeLists.txt").write_text(TOGETHER.format(kinds=" ".join(package.KINDS)))
        package.run(["cmake", "-S", ".", "-B", "build"], cls.folder, CXXFLAGS=WARNINGS)
        package.run(["cmake", "--build", "build"], cls.folder)

    def test_a_project_is_complete_and_short(self):
        for kind in package.KINDS:
            project = self.folder / f"my_{kind}"
            names = sorted(f.name for f in project.iterdir() if f.name != "build")
            self.assertEqual(names, ["CMakeLists.txt", "README.md", "experiment.yaml", "strategy.cpp", "strategy_test.cpp"])
            self.assertLess(len((project / "CMakeLists.txt").read_text().splitlines()), 10)
            for name in names:
                self.assertNotIn("@", (project / name).read_text(encoding="utf-8"))

    def test_tests_pass(self):
        listed = package.run(["ctest", "--test-dir", "build", "-N"], self.folder)
        said = package.run(["ctest", "--test-dir", "build", "--output-on-failure"], self.folder)
        for kind in package.KINDS:
            self.assertIn(f"my_{kind}.conformance", listed)
            self.assertIn(f"plugin.my_{kind}.", said)

    def test_notes_lie_beside_their_library(self):
        notes = (self.folder / "my_observer/build/libdsc_my_observer.check.yaml").read_text()
        self.assertEqual(notes, NOTES.replace("@PROJECT_NAME@", "my_observer"))
        self.assertIn("waived: to see a waiver", package.run(
            ["dsc", "plugin", "check", "my_observer/build/libdsc_my_observer.so"], self.folder))

    def test_experiments_run_from_anywhere(self):
        for kind in package.KINDS:
            out = self.folder / f"run_{kind}"
            package.run(["dsc", "run", f"my_{kind}/experiment.yaml", "-o", out], self.folder)
            summary = json.loads((out / "summary.json").read_text())
            self.assertEqual(summary["status"], "max_steps")  # all steps of the schedule
            self.assertEqual(summary["inverted_tets"], 0)
            provenance = (out / "provenance.json").read_text()
            self.assertIn(f"my_{kind}", provenance)
        self.check_effects()

    def check_effects(self):
        def summary(kind):
            return json.loads((self.folder / f"run_{kind}" / "summary.json").read_text())

        def rows(kind):
            with open(self.folder / f"run_{kind}" / "metrics.csv", encoding="utf-8") as file:
                return list(csv.DictReader(file))

        self.assertGreater(summary("velocity")["volume"], 1.1 * summary("velocity")["volume_initial"])
        self.assertLess(summary("curvature")["volume"], summary("curvature")["volume_initial"])
        vertices = [int(row["interface_vertices"]) for row in rows("refinement")]
        self.assertGreater(vertices[-1], vertices[0])
        self.assertEqual(summary("initial_mesh")["genus"], 1)
        self.assertGreater(summary("improvement")["min_tet_quality"], 0.01)
        told = summary("filter")["input"]["filters"][0]
        self.assertEqual(told["type"], "my_filter")
        self.assertGreater(told["removed"], 0)
        self.assertEqual(sum(told["reasons"].values()), told["removed"])
        self.assertGreater(float(rows("observer")[-1]["observers.my_observer.sphericity"]),
                           float(rows("observer")[1]["observers.my_observer.sphericity"]))

    def test_installed_for_the_user_a_plugin_is_found_without_being_named(self):
        package.run(["cmake", "--install", "my_velocity/build"], self.folder)
        home = package.SCRATCH / "home"
        library = home / ".local/share/dsc/plugins/libdsc_my_velocity.so"
        self.assertTrue(library.is_file())
        self.assertIn("my_velocity", package.run(["dsc", "plugin", "list"], self.folder))
        library.unlink()


if __name__ == "__main__":
    unittest.main()
