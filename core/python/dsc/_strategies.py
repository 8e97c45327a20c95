"""Strategies that are Python classes: the decorators, and what the library asks for when it loads a file."""

import hashlib
import inspect
import marshal
import os
import re
import sys
import types

import numpy

from . import _build
from ._errors import usage_error
from ._parameters import Parameter

# What a class needs at least, by kind.
_METHODS = {"velocity": ["evaluate"], "curvature": ["evaluate"], "refinement": ["refine"], "initial_mesh": ["build"],
            "observer": ["step"]}

_own = {}  # classes that the program itself declares, by kind and id
_loading = []  # lists of classes of the files that are being loaded


class Declaration:
    """What a decorated class declares."""

    def __init__(self, cls, kind, id):
        self.kind = kind
        self.id = id
        self.summary = _summary(cls)
        self.parameters = _parameters(cls)
        self.stochastic = bool(getattr(cls, "stochastic", False))
        self.rigid = bool(getattr(cls, "rigid", True))


class About:
    """What a Python file says about itself."""

    def __init__(self, file, module=None):
        def text(name, default=""):
            return str(getattr(module, name, None) or default)

        stem = re.sub(r"[^a-z0-9_]", "_", os.path.splitext(os.path.basename(file))[0].lower())
        self.file = file
        self.name = stem if re.match(r"[a-z]", stem) else "python_" + stem
        self.version = text("__version__", "0.0.0")
        self.license = text("__license__", "NOASSERTION")
        self.authors = text("__author__")
        self.summary = (text("__doc__").strip().splitlines() or ["strategies written in Python"])[0]
        self.fingerprint = f"python={sys.version.split()[0]};numpy={numpy.__version__};dsc={_build.VERSION}"


def velocity(id):
    """Makes a class a velocity, named `id` in experiments.

    Methods, of which only evaluate is required:
    - evaluate(self, context): the displacements of the vertices, shape (n, 3), normalised units.
    - advance(self, context): called once per step, first; the place to change state.
    - prepare(self, context): called before evaluate, perhaps more than once per step.
    - sample(self, points, normals): the displacements of other points of the surface, shape (m, 3).
    - publish(self): a dict of names and arrays of shape (n,), numbers per vertex.
    - finished(self), planned_steps(self): see share/doc/python.md.
    - state(self), load(self, state): the state for checkpoints: bytes, or an object that JSON can store.

    Attributes: stochastic = True if it uses context.uniform() or context.normal(); rigid = False if a parameter is a place or a
    direction; needs_faces_of_points = True for context.point_faces.
    """
    return _decorator("velocity", id)


def curvature(id):
    """Makes a class a curvature: evaluate(self, context) returns the signed curvatures, shape (n,), unit 1/length, and the
    curvature vectors, shape (n, 3). Optional: prepare, state, load, as for a velocity."""
    return _decorator("curvature", id)


def refinement(id):
    """Makes a class a refinement: refine(self, context) returns a dict of requests, or None.

    Keys: split_faces (m,), split_edges (m, 2), sizing (n,), relabel (m, 2), collapse_edges (m, 2) with collapse_places (m, 3),
    flip_edges (m, 2) with flip_flatness, move_vertices (m,) with move_places (m, 3), target_length, target_lengths (n,),
    attributes. Attributes of the class: needs_sampling, owns_sizing, passes, keep_creases. Optional: state, load.
    """
    return _decorator("refinement", id)


def initial_mesh(id):
    """Makes a class a generator of initial meshes: build(self, context) returns points (m, 3), tets (k, 4) and labels (k,).
    Optional: figures(self), a dict of numbers; warnings(self), a list of pairs (code, text)."""
    return _decorator("initial_mesh", id)


def observer(id):
    """Makes a class an observer: step(self, context, figures) returns a dict of numbers for the row of metrics.csv.
    Optional: begin(self, context); end(self, context), a dict of numbers for summary.json; state, load."""
    return _decorator("observer", id)


def _decorator(kind, id):
    if not isinstance(id, str):
        raise usage_error("python.declaration", f"@dsc.{kind}", "has no name", f'write @dsc.{kind}("name")')

    def declare(cls):
        where = f"@dsc.{kind}({id!r})"
        if not inspect.isclass(cls):
            raise usage_error("python.declaration", where, f"decorates {cls!r}", "decorate a class")
        for method in _METHODS[kind]:
            if not callable(getattr(cls, method, None)):
                raise usage_error("python.declaration", where, f"the class has no method {method}", "define it")
        if hasattr(cls, "state") != hasattr(cls, "load"):
            raise usage_error("python.declaration", where, "the class has only one of the methods state and load", "define both")
        cls.__dsc__ = Declaration(cls, kind, id)
        if _loading:
            _loading[-1].append(cls)
        else:
            _own[kind, id] = cls
        return cls

    return declare


def _summary(cls):
    lines = (cls.__dict__.get("__doc__") or "").strip().splitlines()
    if not lines:
        raise usage_error("python.declaration", cls.__qualname__, "has no docstring", "say in its first line what the strategy does")
    return lines[0].strip()


def _parameters(cls):
    return {name: value for base in reversed(cls.__mro__) for name, value in vars(base).items() if isinstance(value, Parameter)}


class Loaded:
    """The strategies of a file."""

    def __init__(self, about, classes, text=None):
        self.about = about
        self.classes = classes
        self.text = text


def load_file(path):
    """Runs a file and returns the strategies that it declares. Nothing is written beside the file."""
    with open(path, "rb") as source:
        code = compile(source.read(), path, "exec")
    name = "dsc_file_" + hashlib.sha256(path.encode(errors="surrogateescape")).hexdigest()[:12]
    module = types.ModuleType(name)
    module.__file__ = path
    sys.modules[name] = module
    _loading.append([])
    sys.path.insert(0, os.path.dirname(path))
    try:
        exec(code, module.__dict__)
        return Loaded(About(path, module), _loading[-1])
    finally:
        sys.path.remove(os.path.dirname(path))
        _loading.pop()


def own_strategies():
    """The strategies that the program declares, by the file that contains them."""
    groups = {}
    for cls in _own.values():
        groups.setdefault(getattr(sys.modules.get(cls.__module__), "__file__", None), []).append(cls)
    return [_group(file, classes) for file, classes in groups.items()]


def _group(file, classes):
    module = sys.modules.get(classes[0].__module__)
    if file is not None and os.path.exists(file):
        return Loaded(About(os.path.realpath(file), module), classes)
    return Loaded(About("/memory/session.py", module), classes, "\n".join(_text(cls) for cls in classes))


def _text(cls):
    """What the provenance of a run hashes: the source of a class, or its code where there is no source, as at the prompt."""
    try:
        return inspect.getsource(cls)
    except (OSError, TypeError):
        codes = {name: value.__code__ for name, value in vars(cls).items() if hasattr(value, "__code__")}
        return "\n".join(f"{cls.__qualname__}.{name} {marshal.dumps(code, 2).hex()}" for name, code in codes.items())


def make_instance(cls, values):
    """An object of the class whose attributes are the values of its parameters."""
    self = cls.__new__(cls)
    parameters = cls.__dsc__.parameters
    for name, value in values.items():
        is_vector = parameters[name].type == "vec3" and value is not None
        setattr(self, name, numpy.array(value) if is_vector else value)
    self.__init__()
    return self
