"""Builds the wheel of the package dsc: configures, builds and installs with CMake, and packs the result.

The wheel contains the package, the core library and the built-in strategies. The latter two go to lib/ of the environment, where
the package looks for them. The libraries of the system that they use are not packed.
"""

import base64
import hashlib
import pathlib
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


def run(*command):
    """A command that must succeed."""
    subprocess.run([str(word) for word in command], check=True)


def pack(installed, folder):
    """Writes the wheel of an installation, and returns its name."""
    project = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    package = installed / "lib/python3/dist-packages"
    version = {}
    exec((package / "dsc/_build.py").read_text(encoding="utf-8"), version)
    name = f"{project['name']}-{version['VERSION']}"
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{tag}-{tag}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    files = {str(file.relative_to(package)): file.read_bytes() for file in sorted(package.rglob("*")) if file.is_file()}
    for file in sorted((installed / "lib").rglob("*.so*")):
        if package not in file.parents and file.name != "libdsc_python.so":  # the latter is of use only to the command
            files[f"{name}.data/data/lib/{file.relative_to(installed / 'lib')}"] = file.read_bytes()
    metadata = [f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {version['VERSION']}\nSummary: {project['description']}",
                f"License: {project['license']['text']}\nRequires-Python: {project['requires-python']}"]
    metadata += [f"Requires-Dist: {requirement}" for requirement in project["dependencies"]]
    files[f"{name}.dist-info/METADATA"] = ("\n".join(metadata) + "\n").encode()
    files[f"{name}.dist-info/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: dsc\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = "".join(f"{path},sha256={digest(data)},{len(data)}\n" for path, data in files.items())
    files[f"{name}.dist-info/RECORD"] = (record + f"{name}.dist-info/RECORD,,\n").encode()
    wheel = f"{name}-{tag}.whl"
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
