"""What the scripts that generate files below share/ have in common: they write them, or prove that those here are current."""
import argparse
import difflib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHARE = ROOT / "share"


def write(files, folder):
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")


def present(patterns):
    """{path below share/: text} of what is there now."""
    paths = [path for pattern in patterns for path in SHARE.glob(pattern)]
    return {path.relative_to(SHARE).as_posix(): path.read_text(encoding="utf-8") for path in paths}


def differences(files, here):
    for path in sorted(files.keys() | here.keys()):
        if path not in files:
            yield f"share/{path} is not generated any more"
        elif path not in here:
            yield f"share/{path} is missing"
        elif files[path] != here[path]:
            lines = difflib.unified_diff(here[path].splitlines(), files[path].splitlines(), f"share/{path}", "generated", lineterm="", n=1)
            yield "\n".join(list(lines)[:30])


def main(script, doc, make, patterns, arguments=None):
    """`make(dsc)` is {path below share/: text} of all that the script generates; `patterns` find what is there of it."""
    parser = argparse.ArgumentParser(description=doc.split("\n")[0])
    parser.add_argument("--dsc", default=str(ROOT / "build" / "dev" / "bin" / "dsc"), help="the command; default that of the preset dev")
    parser.add_argument("--check", metavar="FOLDER", type=Path, help="write below FOLDER and compare")
    options = parser.parse_args(arguments)
    files = make(options.dsc)
    here = present(patterns)
    write(files, options.check or SHARE)
    if options.check is None:
        for path in here.keys() - files.keys():
            (SHARE / path).unlink()
        print(f"{len(files)} files below share/ written")
        return 0
    found = list(differences(files, here))
    if found:
        print("\n".join(found))
        print(f"{len(found)} of {len(files)} files below share/ are not current; renew them with\n    share/{script} --dsc {options.dsc}")
        return 1
    print(f"{len(files)} files below share/ are current")
    return 0
