#!/usr/bin/env python3
"""The project's rules that a compiler does not check, checked over the sources.

    lint.py ROOT        prints one line a finding, exits 1 if there is one

Every rule is a function that yields findings; lint_test.py plants a violation of each and expects it to be found.
"""

import os
import re
import shutil
import subprocess
import sys
from collections import namedtuple
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path, PurePosixPath

Finding = namedtuple("Finding", "rule path line text")

# Who may include whom in core. An app may use everything; nobody may use the app.
BELOW = {
    "base": set(),
    "text": {"base"},
    "statistics": {"base"},
    "geometry": {"base", "text"},
    "decode": {"base", "text", "geometry"},
    "mesh": {"base", "text", "geometry"},
    "generate": {"base", "text", "geometry", "mesh"},
    "repair": {"base", "text", "geometry", "mesh"},
    "kernel": {"base", "text", "geometry", "mesh", "repair"},
    "surface": {"base", "text", "geometry", "mesh"},
    "cloud": {"base", "text", "geometry", "decode"},
    "config": {"base", "text"},
    "io": {"base", "text", "geometry", "decode", "mesh", "surface", "cloud"},
    "hooks": {"base", "text", "geometry", "decode", "mesh", "repair", "surface", "cloud", "config"},
    "plugin": {"base", "text", "geometry", "decode", "mesh", "generate", "repair", "surface", "cloud", "config", "hooks"},
    "run": {"base", "text", "geometry", "decode", "mesh", "repair", "kernel", "surface", "cloud", "config", "io", "hooks", "plugin"},
}
# What uses finished runs does so through the public headers of `run`, which knows neither of them.
BELOW["report"] = BELOW["sweep"] = BELOW["run"] | {"run", "statistics"}
FOR_STRATEGIES = BELOW["plugin"] | {"plugin"}

# A third-party header and the folders that may include it.
WALLS = {
    "pcl/": ("core/src/cloud/", "tests/bench/"),
    "nanoflann": ("core/src/cloud/",),
    "OpenMesh/": ("core/src/surface/", "core/src/io/"),
    "yaml-cpp/": ("core/src/config/",),
    "vtk": ("core/src/io/",),
    "dlfcn.h": ("plugins/host/",),
    "embree": ("core/src/io/",),
    "CLI/": ("core/app/",),
    "CGAL/": ("tests/",),
    "pybind11/": ("core/python/", "plugins/python/"),
    "Python.h": ("core/python/", "plugins/python/"),
    "doctest/": ("tests/", "plugins/sdk/"),
}
TOP_LEVEL = {"core", "plugins", "strategies", "configs", "tests", "share"}
SKIPPED_FOLDERS = {"build", "runs", "__pycache__"}
SOURCE = {".cpp", ".hpp", ".h"}
TEXT = SOURCE | {".txt", ".cmake", ".md", ".yaml", ".yml", ".json", ".py", ".sh", ".in", ".cff", ".bib", ""}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


class Tree:
    """The text files below a root, read once."""

    def __init__(self, root):
        self.root = Path(root)
        self.folders = sorted(p.name for p in self.root.iterdir() if p.is_dir())
        self.files = {}
        for folder, names, files in os.walk(self.root):
            names[:] = sorted(n for n in names if self.is_ours(Path(folder), n))
            for name in sorted(files):
                path = Path(folder) / name
                if name == ".git":  # a file where the checkout is a worktree
                    continue
                if path.suffix in TEXT and path.stat().st_size < 1_000_000:
                    text = path.read_text(encoding="utf-8", errors="replace")
                    self.files[path.relative_to(self.root).as_posix()] = text.splitlines()

    def is_ours(self, folder, name):
        at_top = folder == self.root
        return name != "__pycache__" and not (at_top and (name in SKIPPED_FOLDERS or name in {".git", ".cache"}))

    def lines(self, suffixes=TEXT, under=("",)):
        for path, lines in self.files.items():
            if PurePosixPath(path).suffix in suffixes and path.startswith(tuple(under)):
                for number, line in enumerate(lines, 1):
                    yield path, number, line

    def includes(self, under=("",)):
        for path, number, line in self.lines(SOURCE, under):
            match = INCLUDE.match(line)
            if match:
                yield path, number, match.group(1) == "<", match.group(2)


def is_test(path):
    return path.startswith("tests/") or path.endswith(("_test.cpp", "_test.hpp"))


def core_module(path):
    """core/include/dsc/mesh/x.hpp and core/src/mesh/x.cpp -> mesh."""
    match = re.match(r"core/(?:include/dsc|src)/([^/]+)/", path)
    return match.group(1) if match else None


def strategy_of(path):
    """strategies/velocity/normal/x.cpp -> strategies/velocity/normal."""
    parts = PurePosixPath(path).parts
    return "/".join(parts[:3]) if len(parts) > 3 and parts[0] == "strategies" else None


def third_party_walls(tree):
    """A third-party library is seen only behind its wall."""
    for path, number, _, header in tree.includes(("core/", "plugins/", "strategies/")):
        for prefix, homes in WALLS.items():
            is_unit_test = prefix == "doctest/" and is_test(path)
            if header.startswith(prefix) and not path.startswith(homes) and not is_unit_test:
                yield path, number, f"<{header}> belongs behind the wall of {' and '.join(homes)}"


def core_direction(tree):
    """Modules of core depend on the modules below them, and on nothing outside of core."""
    for path, number, angled, header in tree.includes(("core/include/", "core/src/")):
        module = core_module(path)
        parts = header.split("/")
        if parts[0] == "dsc" and len(parts) > 2:
            if parts[1] != module and parts[1] not in BELOW.get(module, set()):
                yield path, number, f"{module} must not use {parts[1]}"
        elif not angled and parts[0] in BELOW and parts[0] != module and len(parts) > 1:
            yield path, number, f"{header} is private to {parts[0]}"
        elif re.search(r"(^|/)(plugins|strategies|app)/", header):
            yield path, number, f"core must not use {header}"


def declared_direction(tree):
    """The USES of a module's CMakeLists.txt obeys the same direction."""
    for path, lines in tree.files.items():
        if not re.fullmatch(r"core/src/[^/]+/CMakeLists\.txt", path):
            continue
        text = "\n".join(line.split("#")[0] for line in lines)
        for name, arguments in re.findall(r"dsc_module\(\s*(\w+)([^)]*)\)", text):
            uses = re.search(r"\bUSES\b([\w\s]*?)(?:\bLINK\b|\bSOURCES\b|$)", arguments)
            for used in uses.group(1).split() if uses else []:
                if used not in BELOW.get(name, set()):
                    yield path, 1, f"{name} declares USES {used}, which is not below it"


def strategy_direction(tree):
    """A strategy sees the hooks and what they are made of: no other strategy, no host, no kernel."""
    for path, number, _, header in tree.includes(("strategies/",)):
        if is_test(path):
            continue
        own = strategy_of(path)
        parts = header.split("/")
        if parts[0] == "dsc" and len(parts) > 2 and parts[1] not in FOR_STRATEGIES:
            yield path, number, f"a strategy must not use {parts[1]}"
        landed = os.path.normpath(os.path.join(os.path.dirname(path), header)).replace(os.sep, "/")
        for target in (landed, header):
            if target.startswith("plugins/") or (target.startswith("strategies/") and strategy_of(target) != own):
                yield path, number, f"a strategy must not use {target}"
                break


def plugin_direction(tree):
    """core <- plugins/host <- plugins/conformance, and no part of plugins knows a strategy."""
    for path, number, _, header in tree.includes(("plugins/",)):
        if re.search(r"(^|/)strategies/", header):
            yield path, number, f"plugins must not use {header}"
        if path.startswith("plugins/host/") and re.search(r"(^|/)conformance/", header):
            yield path, number, f"the host must not use {header}"


def nobody_uses_the_app(tree):
    """The command line sees everything and is seen by nobody."""
    for path, number, _, header in tree.includes():
        if re.search(r"(^|/)app/", header) and not path.startswith(("core/app/", "tests/")):
            yield path, number, f"{header} belongs to the command line"


def banned_headers(tree):
    """clang 14 with libstdc++ 12 cannot use these."""
    for path, number, angled, header in tree.includes():
        if angled and header in {"ranges", "format", "source_location"}:
            yield path, number, f"<{header}> does not work with every supported compiler"


def prefetching(tree):
    """g++ removes the calls of a function that only uses the builtin."""
    for path, number, line in tree.lines(SOURCE, tuple(f"{name}/" for name in sorted(TOP_LEVEL))):
        if "__builtin_prefetch" in line and path != "core/include/dsc/base/prefetch.hpp":
            yield path, number, "use prefetch_line() of dsc/base/prefetch.hpp: g++ can remove the builtin"


def libraries_do_not_print(tree):
    """Library code throws; printing and leaving is for the command line."""
    speaks = re.compile(r"\bstd::(cout|cerr|clog|exit|quick_exit|abort|terminate)\b|(?<![\w.:>])f?printf\s*\(|\bputs\s*\(")
    for path, number, line in tree.lines(SOURCE, ("core/include/", "core/src/", "strategies/")):
        if not is_test(path) and speaks.search(line.split("//")[0]):
            yield path, number, "library code must not print or exit"


def header_guards(tree):
    """Every header starts with #pragma once."""
    for path, lines in tree.files.items():
        if path.endswith((".hpp", ".h")) and (not lines or lines[0].strip() != "#pragma once"):
            yield path, 1, "the first line of a header is #pragma once"


def short_files(tree):
    """A source file has at most 450 lines."""
    for path, lines in tree.files.items():
        if PurePosixPath(path).suffix in SOURCE | {".py", ".sh"} and len(lines) > 450:
            yield path, len(lines), f"{len(lines)} lines; split it by purpose"


def file_local_names(tree):
    """The sources of a folder, which the release build compiles as one, declare no file-local name twice."""
    named = re.compile(r"(?:template <.*> )?(?:(?:struct|class|enum|enum class) (\w+)(?= [:{])|using (\w+) ="
                       r"|(?:(?:inline|static) )*const(?:expr)? [^(]*?\b(\w+)(?: =|\{|\[)|(?!return|using)\w[\w:<>,*& ]*[ *&](\w+)\((.*)\) \{)")
    seen = {}
    for path, lines in tree.files.items():
        if not path.endswith(".cpp") or is_test(path) or not path.startswith(("core/", "plugins/", "strategies/")):
            continue
        inside, space = False, ""
        for number, line in enumerate(lines, 1):
            space = line if line.startswith("namespace dsc") else space
            inside = line == "namespace {" or (inside and line != "}  // namespace")
            match = named.match(line) if inside else None
            if not match:
                continue
            types = re.sub(r"\b\w+(?=,|$)", "", match[5]) if match[4] else ""  # functions of one name may differ in them
            name = match[1] or match[2] or match[3] or match[4]
            first, text = seen.setdefault((os.path.dirname(path), space, name, types), (path, line))
            if first != path and not (match[2] and line == text):
                yield path, number, f"{name} is a file-local name of {first} too, and the release build compiles both as one"


def open_ends(tree):
    """Nothing is left open in the sources."""
    marks = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")
    stubs = re.compile(r"not (yet )?implemen" r"ted|place" r"holder|for no" r"w,|in a real (system|implemen" r"tation)", re.I)
    for path, number, line in tree.lines(under=tuple(f"{name}/" for name in sorted(TOP_LEVEL))):
        if marks.search(line) or (not path.startswith("tests/") and stubs.search(line)):
            yield path, number, f"an open end: {line.strip()[:80]}"


def machine_paths(tree):
    """No path of somebody's machine and no host of a package registry."""
    paths = re.compile(r"(?<![A-Za-z0-9_.])/(?:work|farm|root|tmp)/")
    homes = re.compile(r"(?<![A-Za-z0-9_.])/home/")  # tests may invent one
    hosts = re.compile(r"\b(?:deb|security)\.debian\.org|\bpypi\.org|registry\.npmjs|crates\.io|proxy\.golang|conda\.anaconda")
    for path, number, line in tree.lines():
        found = paths.search(line) or hosts.search(line) or (not is_test(path) and homes.search(line))
        if found:
            yield path, number, f"{found.group(0)} is of one machine or registry"


def top_level(tree):
    """The top level holds the folders of the project's card and nothing else."""
    for name in tree.folders:
        if not name.startswith(".") and name not in TOP_LEVEL | SKIPPED_FOLDERS:
            yield name, 1, "not one of " + ", ".join(sorted(TOP_LEVEL))


def readme_commands(tree):
    """The README names both commands, before anything else that is a command."""
    text = "\n".join(tree.files.get("README.md", []))
    for command in ("share/setup.sh run", "share/setup.sh test"):
        if command not in text:
            yield "README.md", 1, f"does not name {command}"


def paper_keys(tree):
    """A paper that a comment names is in the bibliography."""
    known = set(re.findall(r"@\w+\{(\w+),", "\n".join(tree.files.get("share/doc/references.bib", []))))
    for path, number, line in tree.lines(SOURCE | {".md"}):
        for key in re.findall(r"\[([A-Z][A-Za-z]+(?:19|20)\d\d[a-z]?)\]", line):
            if key not in known:
                yield path, number, f"[{key}] is not in share/doc/references.bib"


def linked_pages(tree):
    """A relative link in a page leads to a file that exists. A block of code has no links: a lambda only looks like one."""
    fenced = False
    for path, number, line in tree.lines({".md"}):
        fenced = line.startswith("```") != (fenced and number > 1)
        for target in [] if fenced else re.findall(r"\]\(([^)#\s]+)", line):
            if "://" not in target and not target.startswith("mailto:"):
                if not (tree.root / os.path.dirname(path) / target).exists():
                    yield path, number, f"{target} does not exist"


# Turns of phrase that a reader has to read twice, and what to write instead.
TURNS = [
    (r"\bmend(?:s|ed|ing)?\b", "fix"),
    (r"\bspeaks? for\b", "supports"),
    (r"\bso many\b", "this many, or the number"),
    (r"\bstands? in\b", "is in, is written in"),
    (r"\b(?:comes?|came) about\b", "is made"),
    (r"\bdress rehearsal\b|\bobituary\b|\bended itself\b", "a plain word"),
    (r"\b(?:once|twice|one|ones|times|row|value|number|entry|line) an? (?:step|round|vertex|tet|point|face|edge|label|module|format|run)\b", "per"),
    (r"(?<!there )(?<!There )\b(?:is|are|was|were) no (?:plugin|number|strategy|file|count|name|format|point|tet|vertex|error)\b", "is not a"),
]


def plain_english(tree):
    """Pages, comments and messages keep away from turns that were hard to read."""
    turns = [(re.compile(turn), better) for turn, better in TURNS]
    for path, number, line in tree.lines(SOURCE | {".md", ".yaml", ".html", ".js"}):
        if path.startswith(("tests/", "share/doc/strategies/")) or path == "share/doc/glossary.md":  # it names the words to avoid
            continue
        for turn, better in turns:
            found = turn.search(line)
            if found:
                yield path, number, f"'{found.group(0)}'; better: {better}"


def error_codes(tree):
    """Every code of an error is in share/doc/errors.md, and no other."""
    code = re.compile(r'"([a-z][a-z0-9_]*\.[a-z][a-z0-9_]*)"')
    thrown = re.compile(r"(?:Error|fail|refuse|error|warning|fault_of)\s*\(|\bcode\s*=")
    file = re.compile(r".*\.(?:bpt|cpp|csv|dsc|hpp|html|json|jsonl|md|obj|off|ply|png|stl|vtu)")
    page = "share/doc/errors.md"
    known = {c: n for n, line in enumerate(tree.files.get(page, []), 1) for c in re.findall(r"^\| `([a-z0-9_]+\.[a-z0-9_]+)`", line)}
    written = set()
    for path, lines in tree.files.items():
        if not path.startswith(("core/", "plugins/", "strategies/")) or not path.endswith((".cpp", ".hpp")) or is_test(path):
            continue
        text = "\n".join(line.split("//")[0] for line in lines)
        for match in code.finditer(text):
            statement = text[max(text.rfind(end, 0, match.start()) for end in ";{}") + 1:match.start()]
            if not thrown.search(statement) or file.fullmatch(match[1]):
                continue
            written.add(match[1])
            if match[1] not in known:
                yield path, text.count("\n", 0, match.start()) + 1, f"the code {match[1]} is not in {page}"
    for path, lines in tree.files.items():
        if path.startswith("core/python/") and path.endswith(".py"):
            for number, line in enumerate(lines, 1):
                for name in re.findall(r'usage_error\("([a-z0-9_.]+)"', line):
                    written.add(name)
                    if name not in known:
                        yield path, number, f"the code {name} is not in {page}"
    for name in sorted(known.keys() - written):
        yield page, known[name], f"{name} is no error's code"


FORMATTED = ("core/", "plugins/", "strategies/", "tests/")
FORMAT = Path(__file__).resolve().parents[2] / ".clang-format"


@cache
def clang_format():
    """The program of version 14, the one that Debian 12 has; None if it is not installed. Versions differ in their results."""
    for name in ("clang-format-14", "clang-format"):
        program = shutil.which(name)
        if program and " version 14." in subprocess.run([program, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout:
            return program
    return None


def form(tree):
    """clang-format has nothing to change in a source."""
    program = clang_format()
    sources = [path for path in tree.files if path.startswith(FORMATTED) and PurePosixPath(path).suffix in SOURCE]
    if program is None or not sources:
        return
    check = [program, f"--style=file:{FORMAT}", "--dry-run", "--Werror"]

    def complaints(part):
        return subprocess.run(check + part, cwd=tree.root, stderr=subprocess.PIPE, text=True, check=False).stderr

    with ThreadPoolExecutor(2) as pool:
        said = "".join(pool.map(complaints, (part for part in (sources[::2], sources[1::2]) if part)))
    first = {}
    for path, number in re.findall(r"^(\S+?):(\d+):\d+: error: code should be clang-formatted", said, re.M):
        first.setdefault(path, int(number))
    for path, number in first.items():
        yield path, number, "clang-format-14 -i changes this file, first in this line"


RULES = [
    third_party_walls, core_direction, declared_direction, strategy_direction, plugin_direction, nobody_uses_the_app,
    banned_headers, prefetching, libraries_do_not_print, header_guards, short_files, file_local_names, open_ends, machine_paths, top_level, readme_commands,
    paper_keys, linked_pages, plain_english, error_codes, form,
]


def check(root):
    """All findings below `root`, in the order of the rules."""
    tree = Tree(root)
    return [Finding(rule.__name__, *found) for rule in RULES for found in rule(tree)]


def main(arguments):
    if len(arguments) != 1 or not (Path(arguments[0]) / "core").is_dir():
        print("usage: lint.py ROOT, a checkout of the project", file=sys.stderr)
        return 2
    findings = check(arguments[0])
    for finding in findings:
        print(f"{finding.path}:{finding.line}: [{finding.rule}] {finding.text}")
    if clang_format() is None:
        print("the rule `form` was skipped: clang-format 14 is not installed (Debian 12: clang-format-14)")
    print(f"{len(RULES)} rules, {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
