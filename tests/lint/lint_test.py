#!/usr/bin/env python3
"""Shows that every rule of lint.py can fail, and that a clean tree passes: each case plants one violation."""

import tempfile
import unittest
from pathlib import Path

import lint

CLEAN = {
    "README.md": "share/setup.sh run\nshare/setup.sh test\n[page](share/doc/page.md)\n",
    "share/doc/page.md": "after [Known1999]\n",
    "share/doc/references.bib": "@article{Known1999,\n}\n",
    "core/include/dsc/base/error.hpp": "#pragma once\n",
    "core/src/mesh/complex.cpp": "#include <dsc/base/error.hpp>\n\n#include \"mesh/rings.hpp\"\n// std::cout is for others",
    "core/src/mesh/walks.cpp": "namespace dsc::mesh {\nnamespace {\nconstexpr int most = 3;\nusing Row = int;\nint turn(int a) {}\n"
                               "}  // namespace\n}  // namespace dsc::mesh",
    "core/src/mesh/CMakeLists.txt": "dsc_module(mesh SOURCES complex.cpp USES base text geometry LINK Boost::headers)\n",
    "core/src/cloud/read.cpp": "#include <pcl/io/pcd_io.h>\n",
    "core/src/io/vtu.cpp": "#include <OpenMesh/Core/Mesh/Handles.hh>\n#include <vtkPoints.h>\n",
    "core/app/main.cpp": "#include <CLI/CLI.hpp>\n\n#include <dsc/run/experiment.hpp>\nint main() { std::cout << 1; }\n",
    "plugins/host/library.cpp": "#include <dlfcn.h>\n\n#include <dsc/plugin/entry.hpp>\n",
    "strategies/velocity/normal/speeds.cpp": "#include <dsc/hooks/velocity_field.hpp>\n\n#include \"fields.hpp\"\n",
    "strategies/velocity/normal/strategy_test.cpp": "#include <doctest/doctest.h>\n\n#include <dsc/kernel/deformer.hpp>\n",
    "share/doc/errors.md": "| `io.known` | a code |\n",
    "core/src/io/stl.cpp": "fail(cut ? \"io.known\" : \"io.known\", place);  // fail(\"io.comment\")\nwrite(\"metrics.csv\");\n",
    "tests/unit/surface/judge_test.cpp": "#include <CGAL/Surface_mesh.h>\n",
}

NORMAL = "strategies/velocity/normal/strategy.cpp"
PLANTED = {
    "third_party_walls": [
        ("core/src/io/read.cpp", "#include <pcl/point_cloud.h>"),
        ("core/include/dsc/surface/view.hpp", "#pragma once\n#include <OpenMesh/Core/Mesh/Handles.hh>"),
        ("core/src/run/load.cpp", "#include <yaml-cpp/yaml.h>"),
        ("core/src/surface/dump.cpp", "  #  include <vtkPoints.h>"),
        ("core/src/plugin/open.cpp", "#include <dlfcn.h>"),
        ("plugins/conformance/open.cpp", "#include <dlfcn.h>"),
        (NORMAL, "#include <pcl/search/kdtree.h>"),
        ("core/src/geometry/exact.cpp", "#include <CGAL/Gmpq.h>"),
        ("core/src/base/log.cpp", "#include <doctest/doctest.h>"),
    ],
    "core_direction": [
        ("core/src/geometry/quality.cpp", "#include <dsc/mesh/complex.hpp>"),
        ("core/src/base/error.cpp", "#include <dsc/text/words.hpp>"),
        ("core/src/decode/obj.cpp", "#include <dsc/surface/triangle_mesh.hpp>"),
        ("core/include/dsc/text/words.hpp", "#pragma once\n#include <dsc/geometry/vec.hpp>"),
        ("core/include/dsc/kernel/deformer.hpp", "#pragma once\n#include <dsc/hooks/improvement.hpp>"),
        ("core/src/mesh/adopt.cpp", "#include \"surface/half_edges.hpp\""),
        ("core/src/mesh/adopt.cpp", "#include <dsc/generate/shapes.hpp>"),
        ("core/src/repair/contract.cpp", "#include <dsc/kernel/deformer.hpp>"),
        ("core/src/run/run_experiment.cpp", "#include <dsc/report/report.hpp>"),
        ("core/src/report/scene.cpp", "#include \"run/state_series.hpp\""),
        ("core/src/sweep/collect.cpp", "#include <dsc/report/report.hpp>"),
        ("core/src/run/experiment.cpp", "#include \"../../../strategies/velocity/normal/strategy.hpp\""),
        ("core/src/run/experiment.cpp", "#include \"plugins/host/registry.hpp\""),
    ],
    "declared_direction": [
        ("core/src/base/CMakeLists.txt", "dsc_module(base SOURCES\n  a.cpp USES geometry)"),
        ("core/src/text/CMakeLists.txt", "dsc_module(text SOURCES words.cpp USES base geometry LINK fmt::fmt)"),
        ("core/src/decode/CMakeLists.txt", "dsc_module(decode SOURCES obj.cpp USES cloud base)"),
        ("core/src/run/CMakeLists.txt", "dsc_module(run SOURCES a.cpp USES report base)"),
        ("core/src/cloud/CMakeLists.txt", "dsc_module(cloud USES base mesh LINK ${PCL_LIBRARIES} SOURCES a.cpp)"),
    ],
    "strategy_direction": [
        (NORMAL, "#include \"../average/strategy.hpp\""),
        (NORMAL, "#include \"strategies/curvature/angular_defect/strategy.hpp\""),
        (NORMAL, "#include <dsc/kernel/deformer.hpp>"),
        (NORMAL, "#include \"plugins/host/registry.hpp\""),
    ],
    "plugin_direction": [
        ("plugins/host/registry.cpp", "#include \"strategies/velocity/normal/strategy.hpp\""),
        ("plugins/host/registry.cpp", "#include \"../conformance/runner.hpp\""),
    ],
    "nobody_uses_the_app": [("plugins/host/registry.cpp", "#include \"core/app/options.hpp\"")],
    "banned_headers": [
        ("core/src/base/text.cpp", "#include <format>"),
        ("tests/unit/base/text_test.cpp", "#include <ranges>"),
        (NORMAL, "#include <source_location>"),
    ],
    "prefetching": [("core/src/mesh/adopt.cpp", "__builtin_prefetch(&tets_[t]);")],
    "libraries_do_not_print": [
        ("core/src/mesh/adopt.cpp", "std::cerr << 1;"),
        ("core/src/mesh/adopt.cpp", "    printf(\"x\");"),
        (NORMAL, "std::exit(1);"),
    ],
    "form": [
        ("core/src/mesh/adopt.cpp", "int  turn(int angle);"),
        ("core/src/mesh/adopt.cpp", "#include <vector>\n#include <dsc/base/error.hpp>"),
        ("tests/unit/mesh/adopt_test.cpp", "int f() {\n  return 1;\n}"),
    ],
    "header_guards": [("core/include/dsc/mesh/new.hpp", "// a header\n#pragma once"), (NORMAL[:-3] + "hpp", "")],
    "short_files": [("core/src/mesh/long.cpp", "\n" * 451)],
    "file_local_names": [
        ("core/src/mesh/zones.cpp", f"namespace dsc::mesh {{\nnamespace {{\n{line}\n}}  // namespace")
        for line in ("constexpr double most = 1.0;", "struct Row {", "using Row = double;", "double turn(int angle) {")
    ],
    "open_ends": [
        ("core/src/mesh/adopt.cpp", "// TO" "DO later"),
        ("tests/unit/mesh/adopt_test.cpp", "// FIX" "ME"),
        ("strategies/velocity/normal/README.md", "Not yet implemen" "ted."),
    ],
    "machine_paths": [
        ("configs/a.yaml", "file: /ho" "me/someone/a.obj"),
        ("share/doc/page.md", "see /wor" "k/notes"),
        ("share/fetch.sh", "curl https://py" "pi.org/x"),
    ],
    "top_level": [("scripts/run.sh", "true")],
    "readme_commands": [("README.md", "share/setup.sh run"), ("README.md", "share/setup.sh test")],
    "paper_keys": [("core/src/mesh/adopt.cpp", "// after [Unknown2001]")],
    "error_codes": [
        ("core/src/io/read.cpp", "throw IoError(\"io.gone\", file);"),
        ("plugins/host/src/scan.cpp", "faults[0] = fault_of(file,\n    \"plugin.gone\");"),
        (NORMAL, "constexpr const char* code = \"strategy.gone\";"),
        ("share/doc/errors.md", "| `io.known` | a code |\n| `io.gone` | nothing throws it |"),
    ],
    "plain_english": [
        ("share/doc/page.md", "Mend the vertex: you must mend it."),
        ("core/src/mesh/adopt.cpp", "// The list has one row a step."),
        (NORMAL, "fail(\"it is no plugin\");"),
    ],
    "linked_pages": [("share/doc/page.md", "[gone](gone.md)"), ("README.md", "share/setup.sh run test ![x](share/x.png)")],
}


def findings(changes):
    with tempfile.TemporaryDirectory() as folder:
        for path, text in {**CLEAN, **changes}.items():
            target = Path(folder) / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text if text.endswith("\n") else text + "\n", encoding="utf-8")
        return lint.check(folder)


class Lint(unittest.TestCase):
    def test_a_clean_tree_has_no_findings(self):
        self.assertEqual(findings({}), [])

    def test_every_rule_has_a_planted_violation(self):
        self.assertEqual(sorted(PLANTED), sorted(rule.__name__ for rule in lint.RULES))

    def test_every_planted_violation_is_found_where_it_is(self):
        for rule, cases in PLANTED.items():
            if rule == "form" and lint.clang_format() is None:
                continue
            for path, text in cases:
                with self.subTest(rule=rule, path=path, text=text[:60]):
                    found = findings({path: text})
                    self.assertIn(rule, {f.rule for f in found})
                    place = path.split("/")[0] if rule == "top_level" else path
                    self.assertEqual({f.path for f in found if f.rule == rule}, {place})

    def test_what_may_share_a_name(self):
        for line in ("using Row = int;", "double turn(double angle) {"):
            found = findings({"core/src/mesh/adopt.cpp": f"namespace dsc::mesh {{\nnamespace {{\n{line}\n}}  // namespace"})
            self.assertNotIn("file_local_names", {f.rule for f in found})
        self.assertEqual(findings({"core/src/mesh/adopt.cpp": "namespace dsc::mesh {\nconstexpr int most = 3;"}), [])

    def test_build_folders_are_not_searched(self):
        self.assertEqual(findings({"build/dev/x.cpp": "#include <format>", "runs/a/x.md": "[x](gone.md)"}), [])


if __name__ == "__main__":
    unittest.main()
