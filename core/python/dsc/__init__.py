"""Surfaces and tetrahedral meshes from point clouds, by deformable simplicial complexes.

    import dsc
    result = dsc.reconstruct(points)      # points: array of shape (n, 3)
    result.save("surface.ply")

`reconstruct` makes a surface from points; `run` runs an experiment; `evaluate` measures a result; `load_runs` reads finished
runs. The decorators `velocity`, `curvature`, `refinement`, `initial_mesh` and `observer` make strategies of Python classes.
Arrays are NumPy arrays. Messages go to the logger "dsc" of the module logging.
"""

from . import _start  # noqa: F401, the first: it finds NumPy and connects the log
from ._errors import (CancelledError, ConfigError, Error, GeometryError, IoError, PluginError, StrategyError, UsageError)
from ._evaluate import evaluate
from ._parameters import boolean, choice, file, integer, integers, real, reals, strategy, string, strings, vec3
from ._result import Result, Warning
from ._run import reconstruct, run
from ._runs import load_run, load_runs
from ._start import version as __version__
from ._strategies import curvature, initial_mesh, observer, refinement, velocity

for _name in ("Error", "UsageError", "ConfigError", "PluginError", "StrategyError", "GeometryError", "IoError", "CancelledError",
              "Result", "Warning"):
    globals()[_name].__module__ = __name__  # the name under which users know them

__all__ = [
    "reconstruct", "run", "evaluate", "load_run", "load_runs", "Result", "Warning",
    "velocity", "curvature", "refinement", "initial_mesh", "observer",
    "boolean", "choice", "file", "integer", "integers", "real", "reals", "strategy", "string", "strings", "vec3",
    "Error", "UsageError", "ConfigError", "PluginError", "StrategyError", "GeometryError", "IoError", "CancelledError",
]
