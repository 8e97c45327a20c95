#!/usr/bin/env python3
"""A sweep of 12 points, repeated 5 times, with a truth: expanded, run, collected, compared, and its page in a real browser.

Statistics are compared with those computed here from the single results: by the standard library, by all signs of the differences,
and by a table of Student's t. Without a browser the tests of the page are skipped.
"""

import csv
import io
import itertools
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import webdriver

DSC = os.environ["DSC_BROWSER_COMMAND"]
KEEP = os.environ.get("DSC_BROWSER_KEEP")  # a folder for what the tests saw
LACKING = webdriver.missing()
T_4 = 2.7764451051977987  # 97.5 % quantile of Student's t with 4 degrees of freedom, from a table
BASE = """dsc: 1
input: {cloud: {file: ball.xyz, vary: {subsample: 0.9, rotate: true}}, normalize: {scale: 0.9}}
initial_mesh: {type: grid, cells: 8, shape: cube, half_width: 1.0}
velocity: {type: point_cloud, alpha: 0.2, beta: 1.0e-4, curvature: {type: implicit_fairing, area: ring}}
improvement: {type: dsc}
schedule: [{steps: 8}]
output: {surface: [obj], volume: [dsc]}
"""
SWEEP = """sweep: 1
base: base.yaml
truth: ball.obj
axes:
  - grid: {velocity.alpha: [0.1, 0.2, 0.3], velocity.beta: [0.0, 1.0e-4], initial_mesh.cells: [8, 10]}
repeat: 5
"""


def dsc(*words, cwd):
    done = subprocess.run([DSC, *map(str, words)], cwd=cwd, capture_output=True, text=True, timeout=900, check=False)
    if done.returncode != 0:
        raise AssertionError(f"dsc {' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def table(text):
    return list(csv.DictReader(io.StringIO(text)))


def ranks(values):
    """Mean ranks of the magnitudes."""
    order = sorted(map(abs, values))
    return [statistics.mean(i + 1 for i, v in enumerate(order) if v == abs(value)) for value in values]


def signed_rank(differences):
    """Statistic and two-sided probability, over all signs."""
    values = [d for d in differences if d != 0]
    of = ranks(values)
    smaller = min(sum(r for r, v in zip(of, values) if v > 0), sum(r for r, v in zip(of, values) if v < 0))
    as_extreme = sum(sum(itertools.compress(of, signs)) <= smaller for signs in itertools.product((0, 1), repeat=len(values)))
    return smaller, min(1.0, 2 * as_extreme / 2 ** len(values))


def sign_test(differences):
    n, k = sum(d != 0 for d in differences), min(sum(d > 0 for d in differences), sum(d < 0 for d in differences))
    return min(1.0, 2 * sum(math.comb(n, i) for i in range(k + 1)) / 2 ** n)


class Sweep(unittest.TestCase):
    """The sweep of this file, run once for all tests."""

    @classmethod
    def prepare(cls):
        scratch = tempfile.TemporaryDirectory(prefix="dsc-comparison-")
        unittest.addModuleCleanup(scratch.cleanup)
        cls.folder = folder = Path(scratch.name)
        (folder / "base.yaml").write_text(BASE)
        (folder / "sweep.yaml").write_text(SWEEP)
        dsc("sample", "sphere", "-n", 400, "-o", "ball.xyz", "--mesh", "ball.obj", cwd=folder)
        dsc("sweep", "expand", "sweep.yaml", "-o", "sweep", cwd=folder)
        lines = (folder / "sweep/jobs.tsv").read_text().splitlines()[1:]
        cls.points = [Path("sweep") / line.split("\t")[1] for line in lines]
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(lambda point: dsc("run", point / "experiment.yaml", "-o", point / "run", "-q", "--threads", 1, cwd=folder),
                          cls.points))
        dsc("sweep", "collect", "sweep", "-o", "results.csv", "--groups", "groups.csv", cwd=folder)
        cls.results = table((folder / "results.csv").read_text())
        cls.groups = table((folder / "groups.csv").read_text())
        # As a shell expands sweep/points/*/run: not in the order of the sweep.
        dsc("report", *sorted(f"{point}/run" for point in cls.points), "-o", "page.html", cwd=folder)

    def values(self, setting, figure):
        """Of the five seeds, in their order."""
        group = self.groups[setting]
        keys = ("velocity.alpha", "velocity.beta", "initial_mesh.cells")
        rows = [row for row in self.results if all(row[key] == group[key] for key in keys)]
        return [float(row[figure]) for row in sorted(rows, key=lambda row: int(row["seed"]))]


class Statistics(Sweep):
    def test_all_points_are_done_and_repeats_differ(self):
        self.assertEqual(len(self.results), 60)
        self.assertEqual({row["status"] for row in self.results}, {"done"})
        for setting in range(12):
            self.assertEqual(len(set(self.values(setting, "truth.chamfer_percent"))), 5, "repeats have the same result")

    def test_the_truth_is_that_of_evaluate(self):
        for i in (0, 31):
            alone = json.loads(dsc("evaluate", self.points[i] / "run", "--truth", "ball.obj", "--json", cwd=self.folder))["truth"]
            for figure in ("chamfer_percent", "hausdorff_percent", "normal_consistency", "f_score_1_percent"):
                self.assertEqual(float(self.results[i][f"truth.{figure}"]), alone[figure])

    def test_groups(self):
        self.assertEqual(len(self.groups), 12)
        for setting, row in enumerate(self.groups):
            self.assertEqual((row["group"], row["setting"], row["n"]), (str(setting), str(setting), "5"))
            for figure in ("truth.chamfer_percent", "truth.normal_consistency", "volume", "tets"):
                values = self.values(setting, figure)
                mean, deviation = statistics.mean(values), statistics.stdev(values)
                half = T_4 * deviation / math.sqrt(5)
                for part, expected in ((".mean", mean), (".deviation", deviation), (".low", mean - half), (".high", mean + half)):
                    self.assertAlmostEqual(float(row[figure + part]), expected, delta=1e-9 * max(1, abs(mean)))

    def test_pairs(self):
        for first, second in ((0, 1), (2, 9), (11, 0)):
            found = json.loads(dsc("sweep", "compare", "sweep", first, second, "--json", cwd=self.folder))
            self.assertEqual(found["pairs"], 5)
            for figure in ("truth.chamfer_percent", "volume", "genus", "tets"):
                differences = [b - a for a, b in zip(self.values(first, figure), self.values(second, figure))]
                of_figure = found["figures"][figure]
                self.assertAlmostEqual(of_figure["difference"]["mean"], statistics.mean(differences), delta=1e-9 * max(map(abs, differences + [1])))
                statistic, probability = signed_rank(differences)
                self.assertEqual(of_figure["wilcoxon"]["statistic"], statistic)
                self.assertEqual(of_figure["wilcoxon"]["p"], probability)
                self.assertAlmostEqual(of_figure["signs"]["p"], sign_test(differences), delta=1e-12)
        text = dsc("sweep", "compare", "sweep", 0, 1, cwd=self.folder)
        self.assertIn("5 pairs with the same seed and cloud", text)
        self.assertIn("truth.chamfer_percent", text)


@unittest.skipIf(LACKING, f"{' and '.join(LACKING)} not found")
class Page(Sweep):
    @classmethod
    def setUpClass(cls):
        cls.browser = webdriver.Browser(size=(1400, 900))
        cls.browser.open((cls.folder / "page.html").as_uri())
        deadline = time.monotonic() + 120
        while time.monotonic() < deadline and not cls.browser.script(
                "return Array.from(document.querySelectorAll('.viewer')).every(e => e.getAttribute('data-drawn'))"):
            time.sleep(0.3)
        if KEEP:
            Path(KEEP).mkdir(parents=True, exist_ok=True)
            (Path(KEEP) / "comparison.png").write_bytes(cls.browser.page_shot())
            (Path(KEEP) / "comparison.html").write_bytes((cls.folder / "page.html").read_bytes())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def script(self, text, *arguments):
        return self.browser.script(text, *arguments)

    def cells(self, identifier, column):
        """The main texts of a column: the mean, without deviation and interval."""
        return self.script("""return Array.from(document.querySelectorAll('#' + arguments[0] + ' tbody tr')).map(
            r => (r.cells[arguments[1]].querySelector('b') || r.cells[arguments[1]]).textContent)""", identifier, column)

    def heads(self, identifier):
        return self.script("return Array.from(document.querySelectorAll('#' + arguments[0] + ' thead th')).map(e => e.textContent)", identifier)

    def test_it_fits_1400_pixels(self):
        self.assertEqual(self.script("return innerWidth"), 1400)
        widths = self.script("""const box = document.querySelector('.wide');
            return [document.documentElement.scrollWidth, document.documentElement.clientWidth, box.scrollWidth, box.clientWidth];""")
        self.assertLessEqual(widths[0], widths[1], "the page scrolls sideways")
        self.assertLessEqual(widths[2], widths[3], "the first table scrolls sideways")
        self.assertEqual(self.script("return document.querySelector('.wide table').id"), "groups")
        # Numbers stay on one line: no cell is higher than its three lines.
        self.assertLess(self.script("return Math.max(...Array.from(document.querySelectorAll('#groups tbody tr')).map(r => r.offsetHeight))"), 90)
        self.assertEqual(self.browser.console(), [])

    def test_runs_are_named_by_what_differs_in_the_order_of_the_sweep(self):
        self.assertEqual(self.heads("runs")[:5], ["#", "alpha", "beta", "cells", "seed"])
        self.assertEqual(self.cells("runs", 0), [str(i) for i in range(60)])
        self.assertEqual(self.heads("groups")[:5], ["#", "alpha", "beta", "cells", "n"])
        self.assertEqual(self.cells("groups", 4), ["5"] * 12)
        titles = self.script("return Array.from(document.querySelectorAll('.run h3')).map(e => e.textContent)")
        self.assertEqual(len(titles), 60)
        self.assertEqual(len(set(titles)), 60)
        self.assertIn("alpha=0.3, beta=0.0001, cells=10, seed=5", titles)

    def test_means_are_those_of_collect(self):
        column = self.heads("groups").index("Chamfer distance, %")
        shown = [float(text) for text in self.cells("groups", column)]
        for value, row in zip(shown, self.groups):
            self.assertAlmostEqual(value, float(row["truth.chamfer_percent.mean"]), delta=1e-3 * value)

    def test_a_click_sorts(self):
        column = self.heads("runs").index("Chamfer distance, %")
        click = "document.querySelectorAll('#runs thead button')[arguments[0]].click()"
        self.script(click, column)
        up = [float(text) for text in self.cells("runs", column)]
        self.assertEqual(up, sorted(up))
        self.script(click, column)
        down = [float(text) for text in self.cells("runs", column)]
        self.assertEqual(down, sorted(down, reverse=True))
        self.assertNotEqual(up, down)
        self.script(click, 0)
        self.assertEqual(self.cells("runs", 0), [str(i) for i in range(60)])

    def test_at_most_eight_curves_which_can_be_chosen(self):
        curves = """return Array.from(document.querySelectorAll('.plots figure')).map(f =>
            Array.from(f.querySelectorAll('path')).filter(p => getComputedStyle(p).display !== 'none').map(p => p.dataset.run))"""
        first = self.script(curves)
        self.assertGreaterEqual(len(first), 5)
        for of_plot in first:
            self.assertEqual(of_plot, [str(5 * i) for i in range(8)])
        self.assertEqual(self.script("return document.querySelectorAll('.chooser input:checked').length"), 8)
        self.assertEqual(self.script("return document.querySelectorAll('.chooser input:disabled').length"), 52)
        for run in (10, 59):
            self.script("document.querySelectorAll('.chooser input')[arguments[0]].click()", run)
        for of_plot in self.script(curves):
            self.assertEqual(of_plot, ["0", "5", "15", "20", "25", "30", "35", "59"])
        legend = self.script("""return Array.from(document.querySelectorAll('.plots figure:first-child figcaption span'))
            .filter(e => e.offsetParent !== null).map(e => e.textContent)""")
        self.assertEqual(len(legend), 8)
        self.assertIn("alpha=0.3, beta=0.0001, cells=10, seed=5", legend)
        colours = self.script("""return Array.from(document.querySelectorAll('.plots figure:first-child path'))
            .filter(p => getComputedStyle(p).display !== 'none').map(p => getComputedStyle(p).stroke)""")
        self.assertEqual(len(set(colours)), 8)
        for run in (59, 10):
            self.script("document.querySelectorAll('.chooser input')[arguments[0]].click()", run)
        self.assertEqual(self.script(curves), first)

    def test_pairs_of_chosen_settings(self):
        def row(first, second):
            self.script("""for (const [name, value] of [['first', arguments[0]], ['second', arguments[1]]]) {
                const s = document.querySelector('select.' + name); s.value = value; s.dispatchEvent(new Event('change')); }""", first, second)
            rows = self.script("return Array.from(document.querySelectorAll('#pairs tbody tr')).map(r => Array.from(r.cells).map(c => c.textContent))")
            return next((r for r in rows if r[0] == "Chamfer distance, %"), None)

        found = json.loads(dsc("sweep", "compare", "sweep", 2, 9, "--json", cwd=self.folder))["figures"]["truth.chamfer_percent"]
        shown = row("2", "9")
        self.assertEqual(shown[1], "5")
        self.assertAlmostEqual(float(shown[4]), found["difference"]["mean"], delta=1e-3 * abs(found["difference"]["mean"]))
        self.assertAlmostEqual(float(shown[6]), found["wilcoxon"]["p"], delta=1e-3)
        self.assertEqual(shown[7], f"{found['signs']['positive']} / {found['signs']['negative']} / {found['signs']['zero']}")
        turned = row("9", "2")
        self.assertEqual((turned[2], turned[3], float(turned[4])), (shown[3], shown[2], -float(shown[4])))
        self.assertEqual(turned[6], shown[6])
        self.assertIsNone(row("4", "4"))

    def test_export(self):
        downloads = self.folder / "downloads"
        downloads.mkdir()
        self.browser.call("POST", "goog/cdp/execute", {"cmd": "Browser.setDownloadBehavior",
                                                       "params": {"behavior": "allow", "downloadPath": str(downloads)}})
        for name, rows in (("groups", 12), ("runs", 60)):
            self.script("document.querySelector('button.export[data-table=' + arguments[0] + ']').click()", name)
            file, deadline = downloads / f"{name}.csv", time.monotonic() + 30
            while not file.exists() and time.monotonic() < deadline:
                time.sleep(0.1)
            exported = table(file.read_text())
            self.assertEqual(len(exported), rows)
            if name == "groups":
                for mine, theirs in zip(exported, self.groups):
                    for part in (".mean", ".deviation", ".low", ".high"):
                        self.assertAlmostEqual(float(mine["truth.chamfer_percent" + part]), float(theirs["truth.chamfer_percent" + part]), delta=1e-12)
            else:
                self.assertEqual([row["velocity.alpha"] for row in exported], [row["velocity.alpha"] for row in self.results])
                self.assertEqual([float(row["volume"]) for row in exported], [float(row["volume"]) for row in self.results])


def setUpModule():
    Sweep.prepare()

if __name__ == "__main__":
    result = unittest.main(exit=False).result
    if LACKING and result.wasSuccessful():
        print(f"SKIPPED: {' and '.join(LACKING)} not found; share/setup.sh test --full installs what the browser tests need")
        sys.exit(77)
    sys.exit(not result.wasSuccessful())
