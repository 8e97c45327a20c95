"""Measures a result."""

import os

from . import _start
from ._errors import usage_error

_dsc = _start._dsc


def evaluate(result, truth, samples=100000):
    """Measures how near a surface is to the true one, as `dsc evaluate --truth` does.

    result, truth: a Result; a pair (vertices, faces) of arrays of shapes (n, 3) and (m, 3); an object with the attributes
        vertices and faces, such as a trimesh.Trimesh; the name of a surface or volume file, or of a run folder.
    samples: number of samples on each surface, 1000 to 100,000,000, uniform by area.

    Returns a dict with the figures of `dsc evaluate`: diagonal (units of the input), accuracy_percent, completeness_percent,
    chamfer_percent, hausdorff_percent, hausdorff99_percent (per cent of the diagonal of the box of the truth),
    f_score_0.5_percent, f_score_1_percent, normal_consistency. The formulas are in share/doc/python.md.
    Raises UsageError for arrays of wrong shapes, IoError for files that cannot be read.
    """
    if not isinstance(samples, int) or isinstance(samples, bool) or not 1000 <= samples <= 100_000_000:
        raise usage_error("array.range", "samples", f"is {samples!r}", "give an integer from 1000 to 100000000")
    return _dsc.evaluate(*surface_of(result, "result"), *surface_of(truth, "truth"), samples)


def surface_of(value, name):
    """The vertices and faces of whatever describes a surface."""
    if isinstance(value, (str, os.PathLike)):
        return _read(os.fspath(value))
    if hasattr(value, "vertices") and hasattr(value, "faces"):
        return value.vertices, value.faces
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return tuple(value)
    raise usage_error("array.type", name, f"is {type(value).__name__}, which is not a surface",
                      "give a Result, a pair (vertices, faces), a file or a run folder")


def _read(path):
    if os.path.isdir(path):
        for ending in ("obj", "ply", "off", "stl"):
            inside = os.path.join(path, "result", "surface." + ending)
            if os.path.exists(inside):
                return _dsc.read_surface(inside)
    if os.path.splitext(path)[1].lower() in (".dsc", ".vtu"):
        return _dsc.interface_of(path)
    return _dsc.read_surface(path)
