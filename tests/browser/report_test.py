#!/usr/bin/env python3
"""The report's page in a real browser: it loads from the disk, draws, and answers to its controls."""

import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import webdriver

DSC = os.environ["DSC_BROWSER_COMMAND"]
PLUGIN = os.environ["DSC_BROWSER_PLUGIN"]  # its velocity "upwards" publishes the attribute "height"
DOWN = "\ue015"  # the key, for the driver
KEEP = os.environ.get("DSC_BROWSER_KEEP")  # a folder for what the tests saw
# From a cube, so that the steps of the page differ; refined, so that the mesh changes.
EXPERIMENT = """dsc: 1
name: teapot
input: {cloud: {sample: {shape: teapot, n: 10000}}, normalize: {scale: 0.9}}
initial_mesh: {type: grid, cells: 30}
velocity: {type: point_cloud, alpha: 0.2, beta: 1.0e-4, curvature: {type: implicit_fairing, area: ring}}
improvement: {type: dsc}
schedule: [{steps: 40}, {refine: {type: average_area}}, {steps: 25}, {refine: {type: average_area}}, {steps: 25},
  {refine: {type: average_area}}, {steps: 25}, {refine: {type: average_area}}, {steps: 25}]
output: {surface: [obj, ply], volume: [vtu, dsc], report: true}
"""
ATTRIBUTE = """dsc: 1
name: ball
initial_mesh: {type: grid, cells: 16, shape: sphere, radius: 0.6, project: true}
velocity: {type: upwards, speed: 0.02}
improvement: {type: dsc}
schedule: [{steps: 5}]
output: {surface: [ply], report: true}
"""
SMALL = ["initial_mesh.cells=16", "schedule=[{steps: 20}, {refine: {type: average_area}}, {steps: 5}]", "input.cloud.sample.n=1500"]


def dsc(*words, cwd):
    done = subprocess.run([DSC, *map(str, words)], cwd=cwd, capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        raise AssertionError(f"dsc {' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def keep(name, data):
    if KEEP:
        Path(KEEP).mkdir(parents=True, exist_ok=True)
        (Path(KEEP) / name).write_bytes(data)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="dsc-report-")
        cls.folder = Path(cls.scratch.name)
        (cls.folder / "teapot.yaml").write_text(EXPERIMENT)
        dsc("run", "teapot.yaml", "-o", "teapot", "-q", cwd=cls.folder)
        cls.browser = webdriver.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.scratch.cleanup()

    def show(self, page, viewers):
        self.browser.open((self.folder / page).as_uri())
        self.settle()
        self.assertEqual(self.browser.script("return document.querySelectorAll('.viewer canvas').length"), viewers)
        self.assertEqual(self.browser.console(), [])
        # Nothing is fetched, from nowhere.
        self.assertEqual(self.browser.script("return performance.getEntriesByType('resource').map(e => e.name)"), [])

    def settle(self):
        """Until every viewer has drawn and none wants to draw again."""
        count = "return Array.from(document.querySelectorAll('.viewer')).map(e => Number(e.getAttribute('data-drawn') || 0))"
        before, deadline = None, time.monotonic() + 60
        while time.monotonic() < deadline:
            now = self.browser.script(count)
            if now == before and all(now):
                return
            before = now
            time.sleep(0.3)
        self.fail(f"the viewers do not come to rest: {before}")

    def set(self, control, value):
        """As a hand would: the value, then the events."""
        self.browser.script("""const c = document.querySelector('.viewer ' + arguments[0]);
            if (c.type === 'checkbox') c.checked = arguments[1]; else c.value = arguments[1];
            c.dispatchEvent(new Event('input', {bubbles: true}));
            c.dispatchEvent(new Event('change', {bubbles: true}));""", control, value)
        self.settle()
        return self.browser.shot(".viewer canvas")

    def test_teapot(self):
        page = self.folder / "teapot/report.html"
        self.assertLess(page.stat().st_size, 5_000_000)
        self.show("teapot/report.html", 1)
        # Nothing to choose from where no strategy publishes.
        self.assertFalse(self.browser.script("return Boolean(document.querySelector('.viewer .attribute'))"))
        keep("report.png", self.browser.page_shot())
        start = self.browser.shot(".viewer canvas")
        keep("surface.png", start.png)
        self.assertGreater(start.colours(), 100)
        self.assertGreater(start.covered(), 0.08)
        steps = int(self.browser.script("return document.querySelector('.viewer .step').max"))
        self.assertGreaterEqual(steps, 5)
        self.assertLess(steps, 12)
        first = self.set(".step", 0)
        keep("first.png", first.png)
        self.assertGreater(first.difference(start), 0.05, "the cube of the start looks like the result")
        middle = self.set(".step", 3)
        self.assertGreater(middle.difference(first), 0.02)
        self.assertLess(self.set(".step", steps).difference(start), 0.001, "the slider does not lead back")

        cut = self.set(".cut", True)
        keep("cut.png", cut.png)
        self.assertGreater(cut.difference(start), 0.05)
        moved = self.set(".position", 250)
        self.assertGreater(moved.difference(cut), 0.03)
        quality = self.set(".colour", "quality")
        keep("quality.png", quality.png)
        self.assertGreater(quality.difference(moved), 0.02)
        self.assertGreater(self.set(".axis", "x").difference(quality), 0.05)
        self.assertGreater(self.set(".outside", False).difference(quality), 0.05)
        self.assertLess(self.set(".cut", False).difference(start), 0.001)

        self.set(".cloud", True)
        cloud = self.set(".surface", False)
        keep("cloud.png", cloud.png)
        self.assertGreater(cloud.difference(start), 0.05)
        self.assertGreater(cloud.covered(), 0.01)
        self.set(".cloud", False)
        self.assertGreater(self.set(".edges", True).covered(), 0.01)
        self.set(".surface", True)
        self.set(".edges", False)
        self.browser.drag(".viewer canvas", 150, 40)
        self.settle()
        self.assertGreater(self.browser.shot(".viewer canvas").difference(start), 0.05, "it does not turn")
        self.assertEqual(self.browser.console(), [])
        keep("report.pdf", self.browser.print_pdf())

    def test_colour_by_an_attribute(self):
        (self.folder / "ball.yaml").write_text(ATTRIBUTE)
        dsc("run", "ball.yaml", "-o", "ball", "-q", "--plugin", PLUGIN, cwd=self.folder)
        self.show("ball/report.html", 1)
        options = "return Array.from(document.querySelectorAll('.viewer .attribute option')).map(o => o.textContent)"
        self.assertEqual(self.browser.script(options), ["none", "height"])
        legend = """const l = document.querySelector('.viewer .surface-legend');
            return l.offsetParent === null ? '' : l.innerText.replace(/\\s+/g, ' ').trim()"""
        self.assertEqual(self.browser.script(legend), "")
        plain = self.browser.shot(".viewer canvas")
        # By keyboard: the next choice.
        self.browser.press(".viewer .attribute", DOWN)
        self.settle()
        coloured = self.browser.shot(".viewer canvas")
        keep("attribute.png", self.browser.page_shot())
        self.assertEqual(self.browser.script("return document.querySelector('.viewer .attribute').value"), "height")
        self.assertGreater(coloured.difference(plain), 0.05)
        # z before the last of the steps of 0.02: from -0.6 to 0.6, and 0.08 up.
        said = re.fullmatch(r"height: (\S+) and less (\S+) and more", self.browser.script(legend))
        self.assertIsNotNone(said)
        self.assertAlmostEqual(float(said.group(1)), 0.08 - 0.6, delta=0.05)
        self.assertAlmostEqual(float(said.group(2)), 0.08 + 0.6, delta=0.05)
        steps = int(self.browser.script("return document.querySelector('.viewer .step').max"))
        start = self.set(".step", 0)
        self.assertEqual(self.browser.script(legend), "height: no values at this step")
        self.assertGreater(start.difference(coloured), 0.05)
        self.assertGreater(self.set(".step", 1).difference(start), 0.05)
        self.assertLess(self.set(".step", steps).difference(coloured), 0.001)
        self.assertLess(self.set(".attribute", "").difference(plain), 0.001, "plain is not what it was")
        self.assertEqual(self.browser.script(legend), "")
        self.assertEqual(self.browser.console(), [])

    def test_the_same_page_later(self):
        written = (self.folder / "teapot/report.html").read_bytes()
        self.assertEqual(dsc("report", "teapot", "-o", "again.html", cwd=self.folder), "again.html\n")
        self.assertEqual((self.folder / "again.html").read_bytes(), written)

    def test_comparison(self):
        dsc("run", "teapot.yaml", "-o", "coarse", "-q", "output.report=false", *SMALL, cwd=self.folder)
        dsc("run", "teapot.yaml", "-o", "rough", "-q", "output.report=false", "velocity.beta=0", *SMALL, cwd=self.folder)
        dsc("report", "teapot", "coarse", "rough", "-o", "three.html", cwd=self.folder)
        self.show("three.html", 3)
        keep("three.png", self.browser.page_shot())
        pictures = [self.browser.shot(f"#view-{i} canvas") for i in range(3)]
        for picture in pictures:
            self.assertGreater(picture.colours(), 100)
            self.assertGreater(picture.covered(), 0.05)
        self.assertGreater(pictures[0].difference(pictures[1]), 0.01)
        words = self.browser.script("return document.body.innerText")
        for word in ("coarse", "rough", "velocity.beta"):
            self.assertIn(word, words)

    def test_hostile_names(self):
        name = "<img src=x onerror=hacked=1>\"'</script><script>hacked=1</script>&.xyz"
        folder = self.folder / "hostile"
        folder.mkdir()
        # A file's name has no slash.
        cloud = folder / name.replace("/", "%")
        dsc("sample", "sphere", "-n", "600", "-o", "sphere.xyz", cwd=folder)
        (folder / "sphere.xyz").rename(cloud)
        (folder / "hostile.yaml").write_text(
            "dsc: 1\nname: hostile\ninput: {cloud: {file: '" + cloud.name.replace("'", "''") + "'}, normalize: {scale: 0.9}}\n"
            "initial_mesh: {type: grid, cells: 12}\nvelocity: {type: point_cloud}\nimprovement: {type: dsc}\nschedule: [{steps: 3}]\n"
            "output: {report: true}\n")
        dsc("run", "hostile.yaml", "-o", "out</script><script>hacked=1", "-q", cwd=folder)
        run = folder / "out<" / "script><script>hacked=1"
        os.rename(run, folder / "out")
        self.show("hostile/out/report.html", 1)
        self.assertIsNone(self.browser.script("return window.hacked === undefined ? null : window.hacked"))
        self.assertEqual(self.browser.script("return document.images.length"), 0)
        self.assertIn(cloud.name, self.browser.script("return document.body.innerText"))

    def test_without_webgl_the_picture_stands_in(self):
        browser = webdriver.Browser("--disable-3d-apis")
        self.addCleanup(browser.close)
        browser.open((self.folder / "teapot/report.html").as_uri())
        self.assertTrue(browser.script("return document.querySelector('.viewer img').complete"))
        self.assertIn("no WebGL", browser.script("return document.body.innerText"))
        self.assertGreater(browser.shot(".viewer img").colours(), 50)


if __name__ == "__main__":
    lacking = webdriver.missing()
    if lacking:
        print(f"SKIPPED: {' and '.join(lacking)} not found; share/setup.sh test --full installs what the browser tests need")
        sys.exit(77)
    unittest.main()
