#!/usr/bin/env python3
"""The Debian package: its content and dependencies; where CI allows it, installed by apt-get, used and removed again.

Installing changes the machine, so it happens only as root and with DSC_TEST_DEBIAN_INSTALL=1, which CI sets, and never where
a package dsc is installed already.
"""

import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import package

TOOLS = ("dpkg-deb", "dpkg-shlibdeps", "cpack")
if missing := [tool for tool in TOOLS if shutil.which(tool) is None]:
    print(f"SKIPPED: {', '.join(missing)} missing; install dpkg-dev")
    sys.exit(77)

PYTHON = os.environ["DSC_PACKAGE_PYTHON"]  # empty where the build has no Python package
MAY_INSTALL = os.environ.get("DSC_TEST_DEBIAN_INSTALL") == "1" and os.geteuid() == 0


def plain(command, folder=None, expect=0):
    """Runs a command as a user of the machine would: no variable of dsc, no prefix on the PATH."""
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("DSC_", "CMAKE_", "PYTHON"))}
    clean["DEBIAN_FRONTEND"] = "noninteractive"
    done = subprocess.run([str(word) for word in command], cwd=folder, env=clean, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != expect:
        raise AssertionError(f"{command}: exit {done.returncode} instead of {expect}\n{done.stdout}")
    return done.stdout


class Debian(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = package.fresh_folder("debian")
        package.run(["cpack", "-G", "DEB", "-B", cls.folder, "--config", package.BUILD / "CPackConfig.cmake"])
        (cls.deb,) = cls.folder.glob("*.deb")

    def field(self, name):
        return package.run(["dpkg-deb", "--field", self.deb, name]).strip()

    def files(self):
        lines = package.run(["dpkg-deb", "--contents", self.deb]).splitlines()
        return {line.split()[5].removeprefix(".") for line in lines if not line.startswith("d")}

    def test_the_name_tells_package_version_and_architecture(self):
        architecture = package.run(["dpkg", "--print-architecture"]).strip()
        self.assertRegex(self.deb.name, rf"^dsc_\d+\.\d+\.\d+-1_{architecture}\.deb$")

    def test_everything_is_in_it(self):
        files = self.files()
        for wanted in (r"/usr/bin/dsc", r"/usr/lib/libdsc_core\.so\.[\d.]+", r"/usr/lib/dsc/plugins/libdsc_point_cloud\.so",
                       r"/usr/include/dsc/hooks/velocity_field\.hpp", r"/usr/lib/cmake/dsc/dscConfig\.cmake",
                       r"/usr/share/man/man1/dsc\.1(\.gz)?", r"/usr/share/bash-completion/completions/dsc",
                       r"/usr/share/doc/dsc/copyright", r"/usr/share/dsc/configs/quickstart\.yaml",
                       r"/usr/share/dsc/data/teapot\.bpt", r"/usr/share/doc/dsc/python\.md(\.gz)?",
                       r"/usr/lib/python3/dist-packages/dsc/__init__\.py"):
            self.assertTrue([f for f in files if re.fullmatch(wanted, f)], wanted)
        if PYTHON:
            modules = "/usr/lib/python3/dist-packages/dsc"
            for wanted in ("__init__.py", "__init__.pyi", "py.typed"):
                self.assertIn(f"{modules}/{wanted}", files)
            self.assertTrue([f for f in files if f.startswith(f"{modules}/_dsc.cpython")])
            self.assertTrue([f for f in files if f.startswith(f"{modules}/__pycache__/_run.")])
        for file in files:
            self.assertTrue(file.startswith("/usr/"), file)
            self.assertNotIn("/tests/", file)

    def test_the_dependencies_are_declared(self):
        depends = self.field("Depends")
        for library in ("libc6", "libstdc++6", "libpcl-io", "libvtk9", "libyaml-cpp", "libembree3", "libeigen3-dev", "python3-numpy"):
            self.assertIn(library, depends)
        self.assertEqual("python3-numpy" in depends, bool(PYTHON))
        for file in ("test", "doctest", "chromium"):
            self.assertNotIn(file, depends)

    def test_no_file_names_a_folder_of_the_build(self):
        root = self.folder / "extracted"
        package.run(["dpkg-deb", "-x", self.deb, root])
        for file in root.rglob("*"):
            if file.is_file() and not file.is_symlink():
                self.assertNotIn(str(package.BUILD).encode(), file.read_bytes(), file)

    @unittest.skipUnless(MAY_INSTALL, "installs on this machine: needs root and DSC_TEST_DEBIAN_INSTALL=1")
    def test_installed_used_and_removed(self):
        status = subprocess.run(["dpkg-query", "-W", "dsc"], capture_output=True, check=False)
        if status.returncode == 0:
            self.skipTest("a package dsc is installed")
        before = {f for f in self.files() if Path(f).exists()}
        self.assertEqual(before, set(), "files of another installation")
        plain(["apt-get", "install", "-y", "-q", "--no-install-recommends", self.deb])
        try:
            self.use()
        finally:
            plain(["apt-get", "remove", "-y", "-q", "--purge", "dsc"])
        left = {f for f in self.files() if Path(f).exists()}
        self.assertEqual(left, set())
        self.assertFalse(Path("/usr/lib/dsc").exists())
        self.assertFalse(Path("/usr/include/dsc").exists())
        self.assertFalse(Path("/usr/lib/python3/dist-packages/dsc").exists())

    def use(self):
        work = package.fresh_folder("debian use")
        dsc = "/usr/bin/dsc"
        plain([dsc, "sample", "sphere", "-n", "500", "-o", "cloud.ply"], work)
        plain([dsc, "reconstruct", "cloud.ply", "-o", "surface.glb", "-o", "volume.vtu", "-q"], work)
        self.assertGreater((work / "surface.glb").stat().st_size, 1000)
        plain(["/usr/bin/python3", "-c", "import dsc; dsc.reconstruct('cloud.ply', detail='low').save('python.ply')"], work)
        self.assertGreater((work / "python.ply").stat().st_size, 1000)
        for demo in sorted(Path("/usr/share/dsc/configs/demos").glob("*.yaml")):
            plain([dsc, "run", demo, "--check"], work)
        plain([dsc, "plugin", "new", "my_flow", "--kind", "velocity"], work)
        plain(["cmake", "-S", "my_flow", "-B", "my_flow/build"], work)
        plain(["cmake", "--build", "my_flow/build"], work)
        (library,) = (work / "my_flow" / "build").rglob("libdsc_my_flow.so")
        plain([dsc, "plugin", "check", library, "--level", "smoke"], work)
        if PYTHON:
            plain(["/usr/bin/python3", "-c", "import dsc; dsc.reconstruct('cloud.ply', detail='low').save('python.ply')"], work)
            self.assertGreater((work / "python.ply").stat().st_size, 1000)
            (work / "mine.py").write_text('import dsc\n\n@dsc.velocity("mine")\nclass Mine:\n    """Rests."""\n'
                                          "    def evaluate(self, context):\n        return 0 * context.positions\n", encoding="utf-8")
            plain([dsc, "plugin", "check", "mine.py", "--level", "smoke"], work)


if __name__ == "__main__":
    unittest.main()
