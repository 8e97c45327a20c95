"""The moved installation that the tests of this folder share, and how they run commands against it."""

import os
import shlex
import shutil
import subprocess
from pathlib import Path

CMAKE = os.environ["DSC_PACKAGE_CMAKE"]
BUILD = Path(os.environ["DSC_PACKAGE_BUILD"])
SOURCE = Path(os.environ["DSC_PACKAGE_SOURCE"])
SCRATCH = Path(os.environ["DSC_PACKAGE_SCRATCH"])
PREFIX = SCRATCH / "moved prefix"
KINDS = ["velocity", "curvature", "refinement", "initial_mesh", "improvement", "observer", "filter"]


def install():
    """Installs to one prefix and moves it to another: what it says about itself must not depend on where it is."""
    first = SCRATCH / "first prefix"
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    run([CMAKE, "--install", BUILD, "--prefix", first])
    first.rename(PREFIX)
    return first


def environment():
    """That of a user who has the prefix on the PATH and nothing else: an own home, no variables of dsc."""
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("DSC_", "XDG_", "CMAKE_"))}
    home = SCRATCH / "home"
    home.mkdir(exist_ok=True)
    clean["HOME"] = str(home)
    # Compiling goes through the cache of this build's user, if there is one.
    clean.setdefault("CCACHE_DIR", str(Path.home() / ".cache" / "ccache"))
    clean["PATH"] = f"{PREFIX / 'bin'}:{os.environ['PATH']}"
    clean["CXX"] = os.environ["DSC_PACKAGE_CXX"]
    clean["CMAKE_GENERATOR"] = os.environ["DSC_PACKAGE_GENERATOR"]
    if os.environ["DSC_PACKAGE_LAUNCHER"]:
        clean["CMAKE_CXX_COMPILER_LAUNCHER"] = os.environ["DSC_PACKAGE_LAUNCHER"]
    return clean


def run(command, folder=None, expect=0, **variables):
    """Runs a command (a list) and returns all that it said; fails with its words where the exit code is another one."""
    command = [str(word) for word in command]
    done = subprocess.run(command, cwd=folder or SCRATCH, env={**environment(), **variables}, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if expect is not None and done.returncode != expect:
        raise AssertionError(f"{shlex.join(command)}: exit {done.returncode} instead of {expect}\n{done.stdout}")
    return done.stdout


def fresh_folder(name):
    folder = SCRATCH / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder
