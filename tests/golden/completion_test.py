#!/usr/bin/env python3
"""The bash completion at work: every command, option and choice that the helps name is offered where it belongs."""

import argparse
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "share"))
import manual  # noqa: E402  (lies beside what it writes)

SCRIPT = ROOT / "share/completion/dsc"


def offered(*words):
    """What bash would offer for the last of the words."""
    text = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _dsc; printf "%s\\n" "${COMPREPLY[@]}"'
    done = subprocess.run(["bash", "-uc", text, "bash", str(SCRIPT), "dsc", *words], check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    return done.stdout.split()


class Completion(unittest.TestCase):
    program = ""

    def test_every_word_of_every_help_is_offered(self):
        options = 0
        for command in manual.all_commands(manual.read_command(self.program, [])):
            for entry in command.sections["Subcommands"]:
                self.assertIn(entry.names[0], offered(*command.words, ""))
                self.assertEqual(offered(*command.words, entry.names[0]), [n for n in offered(*command.words, "")
                                                                          if n.startswith(entry.names[0])])
            for entry in command.sections["Options"]:
                for name in entry.names:
                    self.assertIn(name, offered(*command.words, "-"), command.name)
                    options += 1
                    if entry.choices:
                        self.assertEqual(offered(*command.words, name, ""), entry.choices)
        self.assertGreater(options, 50)

    def test_values_and_files_are_left_to_the_shell(self):
        self.assertEqual(offered("run", ""), [])
        self.assertEqual(offered("run", "a.yaml", "-o", ""), [])
        self.assertEqual(offered("run", "--progress", "n"), ["never"])
        self.assertEqual(offered("sweep", "e"), ["expand"])
        self.assertNotIn("--resume", offered("info", "-"))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    arguments, rest = parser.parse_known_args()
    Completion.program = arguments.program
    unittest.main(argv=[sys.argv[0], *rest])
