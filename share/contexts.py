#!/usr/bin/env python3
"""Writes share/doc/contexts.md, the page about all data that a strategy can read, from the comments of the headers.

    share/contexts.py                   writes it
    share/contexts.py --check FOLDER    writes it below FOLDER, exits 1 if the one here differs

A comment of a member ends with its shape and unit in brackets, "[V x 3; n]", and then the tag of its threads, "[parallel]". A
sentence that begins with "Filled", "Null" or "Empty" says when the member is filled. The examples are those of
tests/golden/contexts/examples.cpp, which a test compiles and runs; each must use every member of its context.
"""
import re
import sys

import generated

INCLUDE = generated.ROOT / "core/include"
EXAMPLES = generated.ROOT / "tests/golden/contexts/examples.cpp"
PAGE = "doc/contexts.md"

# Name, header, what gets it.
CONTEXTS = [
    ("StepContext", "dsc/hooks/context.hpp", "velocities, curvatures, improvements, observers and, as `RefinementContext::step`, refinements"),
    ("SurfaceView", "dsc/surface/surface_view.hpp", "all that get a `StepContext`, as `StepContext::surface`"),
    ("VolumeView", "dsc/mesh/volume_view.hpp", "observers and refinements, as `StepContext::volume`"),
    ("TargetCloud", "dsc/cloud/target.hpp", "all that get a `StepContext`, and initial meshes, as `cloud`"),
    ("RefinementContext", "dsc/hooks/refinement_policy.hpp", "refinements, in `refine`"),
    ("InitialMeshContext", "dsc/hooks/initial_mesh.hpp", "initial meshes, in `build`"),
    ("FilterContext", "dsc/hooks/cloud_filter.hpp", "filters, in `apply`"),
    ("StepFigures", "dsc/hooks/observer.hpp", "observers, in `step`"),
]

HEAD = """# What a strategy can read
This page lists all data that a run passes to a strategy, with shapes, units and lifetimes. `share/contexts.py` writes it from the
comments of the headers. [Write a strategy](write-a-strategy.md) shows how to use the data, and the [glossary](glossary.md) explains
the terms.

- **Shapes.** V is the number of vertices of the surface view, F is the number of its faces, and P is the number of points of the
  cloud. 1 means one number or answer, and - means an object. A `std::vector<Vec3>` with V entries contains V x 3 doubles.
- **Units.** n means normalised units: the cloud is centred and scaled into the box, and `to_normalised` converts to these units. An
  "index" is a number in the view, and an "id" is a number in the complex. - means a number without a unit.
- **Steps** count from 1. Step 0 is the state before the first step: observers get it in `begin`, and a refinement that is the first
  item of the schedule gets it too.
- **Birth ids** are never used again. A vertex keeps its birth id through steps, refinements, checkpoints and resumed runs, while
  its indices and ids change. State per vertex belongs to the birth id.
- **Order.** All lists have the same order for any number of threads and in a resumed run.
- **Threads.** Everything may be read by several threads at once.
"""

TAG = re.compile(r"\s*\[(setup|step|parallel)\]")
FACETS = re.compile(r"\s*\[([^\[\];]+);\s*([^\[\];]+)\]$")
WHEN = ("Filled", "Null", "Empty", "It may be empty", "May be null")


class Member:
    def __init__(self, name, kind, doc):
        self.name, self.kind = name, kind
        doc = TAG.sub("", doc).strip()
        facets = FACETS.search(doc)
        if not facets:
            raise SystemExit(f"{name}: its comment does not end with [shape; unit]: {doc}")
        self.shape, self.unit = facets.group(1).strip(), facets.group(2).strip()
        sentences = re.split(r"(?<=[.])\s+(?=[A-Z])", FACETS.sub("", doc).strip())
        self.when = " ".join(s for s in sentences if s.startswith(WHEN))
        self.meaning = " ".join(s for s in sentences if not s.startswith(WHEN))


def comment(line):
    return re.sub(r"^\s*///<?\s?", "", line).strip()


def declared(text):
    """(name, type) of a declaration, None for what is no member to read."""
    text = re.sub(r"\s+", " ", text).strip()
    if re.match(r"(explicit|static|friend|using|~|template)\b", text) or "= delete" in text:
        return None
    method = re.match(r"(.+?)\b(operator\[\]|\w+)\((.*)\)( const)?( noexcept)?$", text)
    if method:
        kind, name, arguments = method.group(1).strip(), method.group(2), method.group(3)
        names = [re.split(r"[ &*]", a.split("=")[0].strip())[-1] for a in re.split(r",(?![^<]*>)", arguments) if a.strip()]
        call = f"[{names[0]}]" if name == "operator[]" else f"{name}({', '.join(names)})"
        return (call, kind) if kind else None
    field = re.match(r"(.+?)[ ]([\w]+)(\s*=.*|\{.*\})?$", text)
    return (field.group(2), field.group(1)) if field else None


def body(name, header):
    """The comment of a struct or class, and the lines between its braces."""
    lines = (INCLUDE / header).read_text(encoding="utf-8").splitlines()
    for i, line in enumerate(lines):
        opening = re.match(rf"(struct|class) {name} \{{$", line)
        if not opening:
            continue
        first = i
        while lines[first - 1].startswith("///"):
            first -= 1
        end = next(k for k in range(i, len(lines)) if lines[k] == "};")
        return " ".join(comment(part) for part in lines[first:i]), opening.group(1), lines[i + 1:end]
    raise SystemExit(f"{header} does not contain {name}")


def members(name, header):
    doc, keyword, lines = body(name, header)
    public, depth, notes, text, found = keyword == "struct", 0, [], "", []
    for line in lines:
        plain = line.strip()
        if depth == 0 and plain in ("public:", "private:", "protected:"):
            public = plain == "public:"
            continue
        if not public:
            continue
        if depth == 0 and plain.startswith("///"):
            notes.append(comment(plain))
            continue
        code = plain.split("//")[0].strip()
        if depth == 0:
            text += " " + code
        depth += code.count("{") - code.count("}")
        if depth > 0 or not text.strip() or not code.endswith((";", "}")):
            continue
        head = re.sub(r"\s*\{.*\}?$", "", text) if "(" in text.split("{")[0] else text
        member = declared(head.strip().rstrip(";").strip())
        if member:
            if not notes:
                raise SystemExit(f"{name}::{member[0]} has no comment")
            found.append(Member(*member, " ".join(notes)))
        notes, text = [], ""
    return TAG.sub("", doc), found


def examples():
    text = EXAMPLES.read_text(encoding="utf-8")
    return dict(re.findall(r"^// example: (\w+)\n(.*?)^// end$", text, re.M | re.S))


def cell(text):
    return text.replace("|", "\\|")


def section(name, header, receivers, example):
    doc, found = members(name, header)
    unused = [m.name for m in found if not re.search(rf"\b{re.escape(m.name.split('(')[0].strip('[]'))}\b", example) and not m.name.startswith("[")]
    if unused:
        raise SystemExit(f"the example of {name} in {EXAMPLES.name} does not use {', '.join(unused)}")
    lines = [f"## {name}", f"Header `{header}`; for {receivers}.", "", doc, "", "| member | type | shape | unit | meaning | when it is filled |",
             "| --- | --- | --- | --- | --- | --- |"]
    for m in found:
        lines.append(f"| `{cell(m.name)}` | `{cell(m.kind)}` | {cell(m.shape)} | {cell(m.unit)} | {cell(m.meaning)} | {cell(m.when) or 'always'} |")
    return "\n".join([*lines, "", "```cpp", example.strip(), "```", ""])


def page(_dsc):
    of = examples()
    parts = [HEAD]
    for name, header, receivers in CONTEXTS:
        if name not in of:
            raise SystemExit(f"{EXAMPLES.name} has no example of {name}")
        parts.append(section(name, header, receivers, of[name]))
    return {PAGE: "\n".join(parts)}


if __name__ == "__main__":
    sys.exit(generated.main("contexts.py", __doc__, page, [PAGE]))
