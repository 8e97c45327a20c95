"""Builds the wheel of the package dsc: configures, builds and installs with CMake, and packs the result.

The wheel contains the package, the core library and the built-in strategies. The latter two go to lib/ of the environment, where
the package looks for them. The libraries of the system that they use are not packed.
"""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """The hook of PEP 517. config_settings: `build`, a folder of a build to use again."""
    with tempfile.TemporaryDirectory(prefix="dsc-wheel-") as scratch:
        build = pathlib.Path((config_settings or {}).get("build", pathlib.Path(scratch) / "build"))
        installed = pathlib.Path(scratch) / "installed"
        run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DDSC_BUILD_TESTS=OFF", "-DDSC_PYTHON=ON",
            "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=0", "-DCMAKE_INSTALL_LIBDIR=lib",
            f"-DPython3_EXECUTABLE={sys.executable}")
        run("cmake", "--build", build)
        run("cmake", "--install", build, "--component", "program", "--prefix", installed)
        return pack(installed, pathlib.Path(wheel_directory))


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """The hook of PEP 517 that saves pip a build only to learn the name and the version."""
    folder = f"{name()}.dist-info"
    (pathlib.Path(metadata_directory) / folder).mkdir()
    (pathlib.Path(metadata_directory) / folder / "METADATA").write_text(metadata(), encoding="utf-8")
    return folder


def run(*command):
    """A command that must succeed. It sees the interpreter's own packages, which pip hides from a build."""
    clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    subprocess.run([str(word) for word in command], check=True, env=clean)


def project():
    """The table `project` of pyproject.toml."""
    return tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def name():
    """Name and version, as files of a wheel begin."""
    version = re.search(r"project\(dsc VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    return f"{project()['name']}-{version}"


def metadata():
    """The text of METADATA."""
    table = project()
    lines = ["Metadata-Version: 2.1", f"Name: {table['name']}", f"Version: {name().split('-')[1]}", f"Summary: {table['description']}",
             f"License: {table['license']['text']}", f"Requires-Python: {table['requires-python']}"]
    return "\n".join(lines + [f"Requires-Dist: {requirement}" for requirement in table["dependencies"]]) + "\n"


def pack(installed, folder):
    """Writes the wheel of an installation, and returns its name."""
    package = installed / "lib/python3/dist-packages"
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{tag}-{tag}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    files = {str(file.relative_to(package)): file.read_bytes() for file in sorted(package.rglob("*")) if file.is_file()}
    for file in sorted((installed / "lib").rglob("*.so*")):
        if package not in file.parents and file.name != "libdsc_python.so":  # the latter is of use only to the command
            files[f"{name()}.data/data/lib/{file.relative_to(installed / 'lib')}"] = file.read_bytes()
    files[f"{name()}.dist-info/METADATA"] = metadata().encode()
    files[f"{name()}.dist-info/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: dsc\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = "".join(f"{path},sha256={digest(data)},{len(data)}\n" for path, data in files.items())
    files[f"{name()}.dist-info/RECORD"] = (record + f"{name()}.dist-info/RECORD,,\n").encode()
    wheel = f"{name()}-{tag}.whl"
    with zipfile.ZipFile(folder / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path, (2024, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
    return wheel


def digest(data):
    """SHA-256 as a wheel's RECORD states it."""
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def build_sdist(sdist_directory, config_settings=None):
    """A source archive of the package alone could not be built."""
    raise NotImplementedError("dsc is built from its whole checkout: pip wheel --no-deps core/python")
