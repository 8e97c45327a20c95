#!/usr/bin/env python3
"""Plugins that do not fit: refused by the installed program with exit 4 and the reason, and by the build that makes one."""

import shutil
import unittest

import package

FIXTURES = package.BUILD / "tests/plugins/lib"


class Refusal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = package.fresh_folder("refusal")

    def refused(self, library, reason):
        for command in (["plugin", "list"], ["run", "experiment.yaml", "--check"]):
            said = package.run(["dsc", *command, "--plugin", library], self.folder, expect=4)
            self.assertIn(str(library), said)
            self.assertIn(reason, said)

    def setUp(self):
        (self.folder / "experiment.yaml").write_text(
            "dsc: 1\nname: a\ninitial_mesh: {type: grid}\nvelocity: {type: normal}\nimprovement: {type: dsc}\nschedule: [{steps: 1}]\n")
        package.run(["dsc", "run", "experiment.yaml", "--check"], self.folder)

    def test_built_in_another_way(self):
        align = FIXTURES / "libdsc_bad_align.so"
        if align.exists():
            self.refused(align, "align is '32' in the plugin and '16' in dsc")
        self.refused(FIXTURES / "libdsc_bad_debug_stl.so", "dbgstl is '1' in the plugin and '0' in dsc")

    def test_of_another_abi(self):
        self.refused(FIXTURES / "libdsc_bad_abi_old.so", "was built for ABI 7.0, this dsc has ABI 8.0")
        self.refused(FIXTURES / "libdsc_bad_abi_new.so", "needs ABI 8.1, this dsc has ABI 8.0")

    def test_truncated(self):
        whole = (FIXTURES / "libdsc_good.so").read_bytes()
        for part in range(1, 16):
            library = self.folder / "libdsc_cut.so"
            library.write_bytes(whole[: len(whole) * part // 16])
            self.refused(library, "is a damaged or truncated shared library")
        self.refused(FIXTURES / "libdsc_bad_short_entry.so", "is not a valid plugin entry")

    def test_no_library(self):
        text = self.folder / "libdsc_text.so"
        text.write_text("a plugin, honestly\n")
        self.refused(text, "is not a shared library")

    def test_a_build_that_makes_a_misfit_fails(self):
        package.run(["dsc", "plugin", "new", "misfit", "--kind", "refinement"], self.folder)
        for generator, program in (("Ninja", "ninja"), ("Unix Makefiles", "make")):
            if shutil.which(program) is None:
                continue
            shutil.rmtree(self.folder / "misfit/build", ignore_errors=True)
            package.run(["cmake", "-S", "misfit", "-B", "misfit/build", "-G", generator, "-DBUILD_TESTING=OFF"], self.folder,
                        CXXFLAGS="-D_GLIBCXX_DEBUG")
            for _ in range(2):  # a second try does not take the library for finished
                said = package.run(["cmake", "--build", "misfit/build"], self.folder, expect=None)
                self.assertIn("dbgstl is '1' in the plugin and '0' in dsc", said)
                self.assertIn("dsc does not take it", said)


if __name__ == "__main__":
    unittest.main()
