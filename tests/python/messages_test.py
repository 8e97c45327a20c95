#!/usr/bin/env python3
"""What messages say about the faults of strategies written in Python: the method, the line, the value, the file."""

import os
import signal
import subprocess
import sys
import time
import unittest

import common
import dsc

HEAD = common.HEAD


class Messages(common.Mine):
    def test_the_method_and_the_users_line_are_named(self):
        self.fault("def prepare(self, c):\n    pass\ndef evaluate(self, context):\n    return 1 / 0", "evaluate at step 1 threw")
        self.fault("def prepare(self, c):\n    return 1 / 0\ndef evaluate(self, context):\n    pass", "prepare at step 1 threw")
        self.fault("def evaluate(self, context):\n    return numpy.linalg.inv(numpy.zeros((2, 2)))", "mine.py:9, in evaluate")
        self.fault("def evaluate(self, context):\n    import json\n    return json.dumps(self)", "mine.py:10, in evaluate")

    def test_a_state_that_cannot_be_stored(self):
        body = ("def evaluate(self, c):\n    return 0 * c.positions\ndef state(self):\n    return {1, 2}\n"
                "def load(self, s):\n    pass")
        with self.assertRaises(dsc.StrategyError) as caught:
            self.run_mine(body, changes={"output.checkpoint.every": 2})
        for word in ("state at step 2 threw", "JSON cannot store", "set is not JSON serializable"):
            self.assertIn(word, str(caught.exception))
        self.assertNotIn("encoder.py", str(caught.exception))

    def test_figures_that_are_not_numbers(self):
        for answer, type_name in (("'text'", "str"), ("numpy.ones(3)", "ndarray"), ("[1]", "list"), ("None", "NoneType")):
            text = HEAD + f"""
@dsc.observer("watch")
class Watch:
    \"\"\"Watches.\"\"\"
    def step(self, context, figures):
        return {{"good": numpy.float32(1), "count": 3, "bad": {answer}}}
"""
            with self.assertRaises(dsc.StrategyError) as caught:
                dsc.run(common.EXPERIMENT, {"observers": [{"type": "watch"}]}, plugins=[self.write(text)])
            for word in ("observer 'watch'", f"step() returned {type_name} for the figure 'bad' instead of a number"):
                self.assertIn(word, str(caught.exception))

    def test_a_mask_instead_of_indices(self):
        text = HEAD + """
@dsc.refinement("masked")
class Masked:
    \"\"\"Splits all faces, given as a mask.\"\"\"
    def refine(self, context):
        return {"split_faces": numpy.ones(len(context.faces), dtype=bool)}
"""
        with self.assertRaises(dsc.StrategyError) as caught:
            dsc.run(common.EXPERIMENT, {"schedule": [{"refine": {"type": "masked"}}, {"steps": 1}]}, plugins=[self.write(text)])
        self.assertIn("split_faces", str(caught.exception))
        self.assertIn("numpy.flatnonzero(mask)", str(caught.exception))

    def test_a_file_that_ends_the_process_is_named(self):
        for text, words, code in (("import ctypes\nctypes.string_at(0)", "the import crashed with signal 11", 4),
                                  ("import os\nos._exit(0)", "the import: ended the process", 4)):
            path = os.path.realpath(self.write(text))
            self.assertIn(f"{path}: {words}", self.dsc("run", self.experiment(), expect=code))

    def test_a_file_that_never_ends_is_named_on_ctrl_c(self):
        path = os.path.realpath(self.write("open('begun', 'w').close()\nimport time\ntime.sleep(600)"))
        child = subprocess.Popen([common.PROGRAM, "run", self.experiment()], stderr=subprocess.PIPE, text=True,
                                 preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        while child.poll() is None and not os.path.exists("begun"):
            time.sleep(0.05)
        child.send_signal(signal.SIGINT)
        said = child.communicate()[1]
        self.assertEqual(child.returncode, 75)
        self.assertIn(f"{path}: the import did not end and was interrupted", said)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
