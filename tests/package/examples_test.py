#!/usr/bin/env python3
"""share/doc/use-the-library.md: its programs are built against the moved installation and print what the page says.

Each section links a program, quotes parts of it (cpp) and shows its output (text).
"""

import re
import shutil
import unittest

import package

PAGE = (package.SOURCE / "share/doc/use-the-library.md").read_text(encoding="utf-8")
SOURCES = package.SOURCE / "tests/examples"
WARNINGS = "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror"
BLOCK = re.compile(r"```(\w+)\n(.*?)^```$", re.M | re.S)
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")


def sections():
    """(name of the program, quotes, output) in the order of the page."""
    for section in PAGE.split("\n## ")[1:]:
        program = re.search(r"\[(\w+)\.cpp\]", section)
        if program:
            blocks = BLOCK.findall(section)
            yield (program[1], [text for language, text in blocks if language == "cpp"],
                   [text for language, text in blocks if language == "text"])


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = package.fresh_folder("examples")
        shutil.copytree(SOURCES, cls.folder / "examples")
        package.run(["cmake", "-S", "examples", "-B", "build"], cls.folder, CXXFLAGS=WARNINGS)
        package.run(["cmake", "--build", "build"], cls.folder)
        package.run(["dsc", "sample", "torus", "-n", "4000", "-o", "torus.xyz"], cls.folder)

    def test_the_page_explains_every_program(self):
        self.assertEqual(sorted(name for name, _, _ in sections()), sorted(file.stem for file in SOURCES.glob("*.cpp")))

    def test_a_program_is_short_and_begins_with_what_the_reader_learns(self):
        for file in SOURCES.glob("*.cpp"):
            lines = file.read_text(encoding="utf-8").splitlines()
            self.assertLessEqual(len(lines), 60, file)
            self.assertTrue(lines[0].startswith("// You learn how to "), file)

    def test_quotes_are_parts_of_their_program(self):
        for name, quotes, _ in sections():
            self.assertTrue(quotes, name)
            for quote in quotes:
                self.assertIn(quote, (SOURCES / f"{name}.cpp").read_text(encoding="utf-8"))

    def test_programs_say_what_the_page_shows(self):
        for name, _, shown in sections():
            arguments = ["torus.xyz", "run"] if name == "reconstruct_a_cloud" else []
            said = package.run([self.folder / "build" / name, *arguments], self.folder)
            self.assertEqual(len(shown), 1, name)
            self.assert_same_figures(said, shown[0])

    def assert_same_figures(self, said, shown):
        """Words and whole numbers are equal; other numbers may differ in what compilers round."""
        self.assertEqual(NUMBER.sub("#", said), NUMBER.sub("#", shown))
        for one, other in zip(NUMBER.findall(said), NUMBER.findall(shown)):
            if "." in other:
                self.assertAlmostEqual(float(one) / float(other), 1.0, places=4, msg=said)
            else:
                self.assertEqual(one, other, said)

    def test_a_wrong_cloud_ends_with_the_message_and_the_exit_code(self):
        said = package.run([self.folder / "build/reconstruct_a_cloud", "nowhere.xyz", "run"], self.folder, expect=6)
        self.assertIn("nowhere.xyz", said)
        package.run([self.folder / "build/reconstruct_a_cloud"], self.folder, expect=2)


if __name__ == "__main__":
    unittest.main()
