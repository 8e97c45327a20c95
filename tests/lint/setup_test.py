#!/usr/bin/env python3
"""share/setup.sh against a machine made of stand-ins: every tool that it calls is a script that notes its call."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DSC = """#!/bin/sh
echo "dsc $*" >>"$FAKE/calls"
case "$1" in
    run) mkdir -p "$4/result"; echo x >"$4/result/surface.obj"; echo x >"$4/result/volume.vtu"; echo x >"$4/preview.png"; echo x >"$4/report.html"
         echo "words of the run" ;;
    reconstruct) [ ! -e "$FAKE/dsc_fails" ] || exit 5
                 echo x >out_surface.ply; echo x >out_volume.vtu; echo out_surface.ply; echo out_volume.vtu ;;
    render) echo x >"$4" ;;
esac
"""
TOOLS = {
    "dpkg-query": 'for p; do :; done; grep -qxF "$p" "$FAKE/installed" && echo installed',
    "apt-cache": '[ -e "$FAKE/lists" ]',
    "apt-get": """echo "apt-get $*" >>"$FAKE/calls"
[ "$1" != update ] || { touch "$FAKE/lists"; exit 0; }
[ ! -e "$FAKE/apt_fails" ] || { echo "the reason of apt-get"; exit 100; }
for p; do
    case "$p" in install|-*) continue ;; esac
    if [ "$p" = chromium ] && [ -e "$FAKE/no_chromium" ]; then exit 100; fi
    echo "$p" >>"$FAKE/installed"
done""",
    "id": 'cat "$FAKE/uid"',
    "sudo": 'echo "sudo" >>"$FAKE/calls"; exec "$@"',
    "ninja": "true",
    "c++": "true",
    "cmake": """echo "cmake $*" >>"$FAKE/calls"
[ "$1" != --build ] || echo "status $NINJA_STATUS" >>"$FAKE/calls"
[ ! -e "$FAKE/build_fails" ] || exit 1
[ "$1" != --build ] || { mkdir -p "$2/bin"; cp "$FAKE/dsc" "$2/bin/dsc"; chmod +x "$2/bin/dsc"; }""",
    "cpack": 'echo "cpack $*" >>"$FAKE/calls"; echo x >dsc_1-1_amd64.deb',
    "ctest": 'echo "ctest $*" >>"$FAKE/calls"; echo "the closing line of ctest"; exit "$(cat "$FAKE/ctest_code")"',
}


class Setup(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, self.folder)
        self.project = self.folder / "a project"
        self.fake = self.folder / "fake"
        (self.project / "share").mkdir(parents=True)
        (self.fake / "bin").mkdir(parents=True)
        shutil.copy(ROOT / "share/setup.sh", self.project / "share/setup.sh")
        for name, body in TOOLS.items():
            tool = self.fake / "bin" / name
            tool.write_text(f"#!/bin/bash\n{body}\n")
            tool.chmod(0o755)
        self.put("dsc", DSC)
        self.put("installed", "cmake\ng++\n")
        self.put("uid", "0\n")
        self.put("ctest_code", "0\n")
        self.put("os", "ID=debian\nVERSION_ID=12\n")
        self.put("lists")

    def put(self, name, text=""):
        (self.fake / name).write_text(text)

    def remove(self, name):
        (self.fake / name).unlink()

    def setup(self, *arguments, cwd=None):
        self.put("calls")
        environment = {"PATH": f"{self.fake / 'bin'}:/usr/bin:/bin", "FAKE": str(self.fake),
                       "DSC_OS_RELEASE": str(self.fake / "os")}
        return subprocess.run([str(self.project / "share/setup.sh"), *arguments], cwd=cwd or self.project, env=environment,
                              capture_output=True, text=True, timeout=60)

    def calls(self, tool):
        return [line for line in (self.fake / "calls").read_text().splitlines() if line.startswith(tool)]

    def test_run_installs_only_what_is_missing_and_nothing_the_second_time(self):
        self.assertEqual(self.setup("run").returncode, 0)
        (install,) = self.calls("apt-get")
        self.assertIn(" --no-install-recommends ", install)
        self.assertIn(" libpcl-dev ", install)
        self.assertNotRegex(install, r" (cmake|g\+\+|chromium)( |$)")
        self.assertIn(" doctest-dev ", install)  # for the tests of one's own plugin
        self.assertEqual(self.setup("run").returncode, 0)
        self.assertEqual(self.calls("apt-get"), [])

    def test_package_lists_are_fetched_only_where_absent_or_stale(self):
        self.remove("lists")
        self.assertEqual(self.setup("run").returncode, 0)
        self.assertEqual([call.split()[1] for call in self.calls("apt-get")], ["update", "install"])

    def test_an_install_that_fails_ends_before_the_build(self):
        self.put("apt_fails")
        result = self.setup("run")
        self.assertEqual(result.returncode, 1)
        self.assertIn("could not be installed", result.stderr)
        self.assertIn("the reason of apt-get", result.stderr)
        self.assertEqual([call.split()[1] for call in self.calls("apt-get")], ["install", "update", "install"])
        self.assertEqual(self.calls("cmake"), [])

    def test_somebody_else_than_root_installs_with_sudo(self):
        self.put("uid", "1000\n")
        self.assertEqual(self.setup("run").returncode, 0)
        self.assertEqual(self.calls("sudo"), ["sudo"])

    @unittest.skipIf(shutil.which("sudo", path="/usr/bin:/bin"), "this machine has a sudo that cannot be hidden")
    def test_somebody_without_sudo_is_told_what_to_install(self):
        self.put("uid", "1000\n")
        (self.fake / "bin/sudo").unlink()
        result = self.setup("run")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"as root: apt-get install --no-install-recommends .*libpcl-dev")
        self.assertEqual(self.calls("cmake"), [])

    def test_another_distribution_gets_the_list_and_goes_on(self):
        self.put("os", "ID=fedora\nVERSION_ID=40\n")
        result = self.setup("run")
        self.assertEqual(result.returncode, 0)
        self.assertIn("libopenmesh-dev", result.stderr)
        self.assertEqual(self.calls("apt-get") + self.calls("sudo"), [])

    def test_run_ends_with_the_paths_and_what_to_do_next(self):
        result = self.setup("run")
        self.assertEqual(result.stdout.splitlines(), [
            "surface runs/quickstart/result/surface.obj", "volume runs/quickstart/result/volume.vtu",
            "picture runs/quickstart/preview.png", "report runs/quickstart/report.html",
            "next: build/release/bin/dsc reconstruct YOUR_CLOUD -o surface.obj -o volume.vtu"])
        self.assertTrue(any("--preset release" in call for call in self.calls("cmake")))

    def test_the_first_run_says_how_long_it_takes_and_shows_how_far_it_is(self):
        lines = self.setup("run").stderr.splitlines()
        self.assertRegex(lines[0], r"^setup: the first run compiles dsc, which usually takes [1-9]\d* min with [1-9]\d* at a time")
        self.assertEqual(self.calls("status"), ["status [%f/%t, %e s] "])
        self.assertNotIn("the first run", self.setup("run").stderr)

    def test_from_another_folder_the_paths_are_absolute(self):
        lines = self.setup("run", cwd=self.folder / "fake").stdout.splitlines()
        self.assertEqual(lines[0], f"surface {self.project}/runs/quickstart/result/surface.obj")
        self.assertEqual(lines[4].split(" reconstruct ")[0], f"next: {self.project}/build/release/bin/dsc")

    def test_run_with_a_cloud_reconstructs_it_in_the_callers_folder(self):
        home = self.folder / "home"
        home.mkdir()
        (home / "my cloud.xyz").write_text("0 0 0\n")
        result = self.setup("run", "my cloud.xyz", "--detail", "low", cwd=home)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.calls("dsc"), ["dsc reconstruct my cloud.xyz --detail low",
                                             "dsc render out_surface.ply -o out_picture.png"])
        self.assertEqual(result.stdout.splitlines()[-4:-1],
                         ["surface out_surface.ply", "volume out_volume.vtu", "picture out_picture.png"])
        self.assertTrue((home / "out_picture.png").exists())

    def test_a_reconstruction_that_fails_keeps_its_exit_code(self):
        self.put("dsc_fails")
        (self.project / "cloud.xyz").write_text("0 0 0\n")
        result = self.setup("run", "cloud.xyz")
        self.assertEqual(result.returncode, 5)
        self.assertEqual(result.stdout, "")

    def test_a_missing_cloud_is_told_before_anything_is_installed(self):
        result = self.setup("run", "nowhere.xyz")
        self.assertEqual(result.returncode, 6)
        self.assertEqual(result.stderr, "setup: nowhere.xyz: no such readable file; give the path of a point cloud\n")
        self.assertEqual((self.fake / "calls").read_text(), "")

    def test_test_ends_with_the_lines_and_the_code_of_ctest(self):
        for code in (0, 8):
            self.put("ctest_code", f"{code}\n")
            result = self.setup("test")
            self.assertEqual(result.returncode, code)
            self.assertEqual(result.stdout.splitlines()[-1], "the closing line of ctest")
        self.assertIn(" -j2", self.calls("ctest")[0])
        installed = set((self.fake / "installed").read_text().split())
        self.assertLessEqual({"doctest-dev", "clang-format-14"}, installed)
        self.assertNotIn("chromium", (self.fake / "installed").read_text())
        self.assertTrue(any("--preset test" in call for call in self.calls("cmake")))

    def test_full_installs_the_tools_of_the_rare_tests(self):
        self.assertEqual(self.setup("test", "--full").returncode, 0)
        self.assertTrue(any("--preset dev" in call for call in self.calls("cmake")))
        installed = set((self.fake / "installed").read_text().split())
        self.assertLessEqual({"valgrind", "chromium", "chromium-driver", "python3-meshio", "python3-scipy", "snakemake", "slurm-wlm"}, installed)

    def test_the_gate_is_run_by_full_only_and_its_absence_is_told(self):
        result = self.setup("test")
        self.assertIn(" -LE ^(gate|slow|browser|cluster)$", self.calls("ctest")[0])
        self.assertIn("without the gate", result.stderr)
        result = self.setup("test", "--full")
        self.assertNotIn("gate", self.calls("ctest")[0])
        self.assertNotIn("without the gate", result.stderr)

    def test_package_ends_with_the_file_and_how_to_install_it(self):
        result = self.setup("package")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.splitlines(), ["package build/release/dsc_1-1_amd64.deb",
                                                      "next: sudo apt-get install ./build/release/dsc_1-1_amd64.deb"])
        self.assertTrue(any("--preset release" in call for call in self.calls("cmake")))
        self.assertIn("dpkg-dev", (self.fake / "installed").read_text().split())

    def test_package_is_for_debian_12_only(self):
        self.put("os", "ID=fedora\nVERSION_ID=40\n")
        result = self.setup("package")
        self.assertEqual(result.returncode, 1)
        self.assertIn("cmake --install", result.stderr)
        self.assertEqual(self.calls("cpack"), [])

    def test_full_goes_on_without_a_tool_that_cannot_be_installed_and_says_so(self):
        self.put("no_chromium")
        result = self.setup("test", "--full")
        self.assertEqual(result.returncode, 0)
        self.assertIn("will be skipped", result.stderr)

    def test_a_build_that_fails_ends_without_running_anything(self):
        self.put("build_fails")
        for command in ("run", "test"):
            result = self.setup(command)
            self.assertEqual(result.returncode, 1)
            self.assertEqual(self.calls("ctest") + self.calls("dsc"), [])

    def test_wrong_calls_are_refused(self):
        for arguments, word in ((["walk"], "accepted are run, test and package"), (["test", "--fast"], "accepted is --full"),
                                (["run", "--detail"], "expected a point cloud"), ([], "share/setup.sh run CLOUD")):
            result = self.setup(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(word, result.stderr)
            self.assertEqual(result.stdout, "")
        self.assertEqual(self.setup("--help").returncode, 0)


if __name__ == "__main__":
    unittest.main()
