"""Reconstructions and experiments."""

import numbers
import os
import sys
import tempfile
import threading

from . import _start
from ._errors import usage_error
from ._evaluate import evaluate
from ._result import Result
from ._runs import read_json, read_metrics

_dsc = _start._dsc
_one_at_a_time = threading.RLock()  # the library loads plugins and logs for the whole process


def reconstruct(points, normals=None, colors=None, detail="medium", *, edge_length=None, vertices=None, smooth="auto", trim=False,
                threads=None, plugins=(), on_step=None, output=None, truth=None):
    """Reconstructs a surface and a volume from a point cloud, as `dsc reconstruct` does.

    points: (n, 3) real numbers in any units, or the name of a cloud file.
    normals: (n, 3) real numbers, directions out of the solid or into it; used if they are consistent. None: they are estimated.
    colors: (n, 3), integers 0 to 255 or real numbers 0 to 1; the vertices of the surface get them.
    detail: "low", "medium" or "high".
    edge_length: length of the edges of the surface in the units of the points; replaces detail.
    vertices: number of vertices that the surface may have, 100 to 10,000,000; replaces detail.
    smooth: "auto" (the noise of the points is measured), or its standard deviation in spacings, 0 to 100.
    trim: leave out the parts of the surface that no points support. The volume stays closed.
    threads: number of threads; None: one per core. The result does not depend on it.
    plugins: further plugins: libraries, folders, Python files.
    on_step: called after each step with a dict of the figures of metrics.csv and `planned_steps`; returns False to stop.
    output: the folder of the run, which is kept. None: a temporary folder.
    truth: the true surface, as for dsc.evaluate(); fills Result.evaluation.

    Returns a Result, in the units of the points.
    Raises UsageError for wrong arguments, GeometryError for points that bound no solid, IoError for files, CancelledError if it
    was stopped before there was a surface, KeyboardInterrupt after Ctrl-C.
    """
    options = _reconstruct_options(detail, edge_length, vertices, smooth, trim)
    if isinstance(points, (str, os.PathLike)):
        if normals is not None or colors is not None:
            raise usage_error("usage.argument", "normals and colors", "are given together with a cloud file", "give only the file")
        points = os.fspath(points)
    return _carry_out(lambda call: _dsc.reconstruct(points, normals, colors, {**options, **call}), threads, plugins, on_step,
                      output, truth)


def run(experiment, overrides=None, cloud=None, normals=None, colors=None, truth=None, on_step=None, *, output=None, threads=None,
        plugins=(), resume=False, time_budget=None):
    """Runs an experiment, as `dsc run` does.

    experiment: the name of a YAML file, or a dict with the same keys.
    overrides: dict of dotted paths and values that replace those of the experiment, such as {"velocity.alpha": 0.3}.
    cloud: (n, 3) real numbers that take the place of the experiment's cloud. An experiment without input gets one that is
        normalised.
    normals, colors: of the cloud, as for dsc.reconstruct().
    truth: the true surface, as for dsc.evaluate(); fills Result.evaluation.
    on_step: called after each step with a dict of the figures of metrics.csv and `planned_steps`; returns False to stop.
    output: the folder of the run, which is kept. None: a temporary folder.
    threads: number of threads; None: one per core. The result does not depend on it.
    plugins: further plugins: libraries, folders, Python files.
    resume: continue from the last checkpoint in the folder `output`.
    time_budget: seconds; the run stops after the step in which they are exceeded.

    Strategies that the program has declared with dsc.velocity() and so on can be named in the experiment.
    Returns a Result, in the units of the cloud.
    Raises ConfigError for a wrong experiment, PluginError, StrategyError, GeometryError, IoError, UsageError for wrong arguments,
    CancelledError if it was stopped before there was a result, KeyboardInterrupt after Ctrl-C; the folder then contains a
    checkpoint.
    """
    if not isinstance(experiment, dict):
        if not isinstance(experiment, (str, os.PathLike)):
            raise usage_error("usage.argument", "experiment", f"is {type(experiment).__name__}", "give a dict or the name of a file")
        experiment = os.fspath(experiment)
    if not isinstance(overrides or {}, dict):
        raise usage_error("usage.argument", "overrides", f"is {type(overrides).__name__}", 'give a dict such as {"seed": 2}')
    if cloud is None and (normals is not None or colors is not None):
        raise usage_error("usage.argument", "normals and colors", "are given without a cloud", "give the points as cloud")
    if resume and output is None:
        raise usage_error("usage.argument", "resume", "needs the folder of the run", "give it as output")
    if time_budget is not None and not _in_range(time_budget, 0, float("inf")):
        raise usage_error("usage.argument", "time_budget", f"is {time_budget!r}", "give a number of seconds")
    call = {"resume": bool(resume), "time_budget": None if time_budget is None else float(time_budget)}
    return _carry_out(lambda c: _dsc.run(experiment, dict(overrides or {}), cloud, normals, colors, {**c, **call}), threads,
                      plugins, on_step, output, truth)


def _reconstruct_options(detail, edge_length, vertices, smooth, trim):
    if detail not in ("low", "medium", "high"):
        raise usage_error("usage.argument", "detail", f"is {detail!r}", 'give "low", "medium" or "high"')
    if edge_length is not None and not _in_range(edge_length, 0, float("inf"), open_ends=True):
        raise usage_error("usage.argument", "edge_length", f"is {edge_length!r}", "give a finite number above 0")
    if vertices is not None and not (_in_range(vertices, 100, 10_000_000) and vertices == int(vertices)):
        raise usage_error("usage.argument", "vertices", f"is {vertices!r}", "give an integer from 100 to 10000000")
    if edge_length is not None and vertices is not None:
        raise usage_error("usage.argument", "edge_length and vertices", "are both given", "give one of them")
    if smooth != "auto" and not _in_range(smooth, 0, 100):
        raise usage_error("usage.argument", "smooth", f"is {smooth!r}",
                          'give "auto" or the standard deviation of the noise in spacings, 0 to 100')
    return {"detail": detail, "edge_length": None if edge_length is None else float(edge_length),
            "vertices": None if vertices is None else int(vertices), "noise": None if smooth == "auto" else float(smooth),
            "trim": bool(trim)}


def _in_range(value, low, high, open_ends=False):
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return False
    return low < value < high if open_ends else low <= value <= high


def _carry_out(work, threads, plugins, on_step, output, truth):
    if threads is not None and not (_in_range(threads, 1, 1024) and threads == int(threads)):
        raise usage_error("usage.argument", "threads", f"is {threads!r}", "give an integer from 1 to 1024")
    if on_step is not None and not callable(on_step):
        raise usage_error("usage.argument", "on_step", f"is {type(on_step).__name__}", "give a function")
    if isinstance(plugins, (str, os.PathLike)):
        plugins = [plugins]
    call = {"threads": int(threads or 0), "plugins": [os.path.abspath(os.fspath(p)) for p in plugins], "on_step": on_step,
            "resume": False, "time_budget": None, "keep": output is not None,
            "command": [os.path.basename(sys.executable or "python3"), *sys.argv]}
    with _one_at_a_time:
        result = _in_folder(work, call, output)
    if truth is not None:
        result.evaluation = evaluate(result, truth)
    return result


def _in_folder(work, call, output):
    if output is not None:
        return _result(work({**call, "folder": os.fspath(output)}), keep=True)
    with tempfile.TemporaryDirectory(prefix="dsc-") as folder:
        return _result(work({**call, "folder": os.path.join(folder, "run")}), keep=False)


def _result(data, keep):
    return Result(data, data.folder if keep else None, read_metrics(data.folder), read_json(data.folder, "summary.json"))
