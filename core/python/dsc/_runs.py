"""Reads the folders of runs."""

import csv
import glob
import json
import os

import numpy

from . import _start
from ._errors import usage_error

_dsc = _start._dsc


def read_metrics(folder):
    """The columns of metrics.csv as a dict of arrays; empty cells are NaN."""
    with open(os.path.join(folder, "metrics.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    columns = {}
    for index, name in enumerate(rows[0]):
        cells = [row[index] if index < len(row) else "" for row in rows[1:]]
        columns[name] = _column([_number(cell) for cell in cells])
    return columns


def read_json(folder, name):
    """The object in a file of the folder; an empty dict if there is none."""
    try:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return {}


def load_run(folder):
    """Figures and columns of one run.

    Returns a dict with `folder`, `status` (status.json), `experiment` (the experiment with all defaults), `summary`
    (summary.json), `provenance` (provenance.json) and `metrics` (dict of arrays, one row per step). What the run has not written
    yet is empty. Raises IoError for an experiment that cannot be read, UsageError for a folder that is not one of a run.
    """
    folder = os.fspath(folder)
    status = read_json(folder, "status.json")
    if not status:
        raise usage_error("run.folder", folder, "is not the folder of a run", "give the folder that contains status.json")
    experiment = os.path.join(folder, "config.resolved.yaml")
    metrics = os.path.join(folder, "metrics.csv")
    return {"folder": folder, "status": status, "experiment": _dsc.read_yaml(experiment) if os.path.exists(experiment) else {},
            "summary": read_json(folder, "summary.json"), "provenance": read_json(folder, "provenance.json"),
            "metrics": read_metrics(folder) if os.path.exists(metrics) else {}}


def load_runs(pattern):
    """The figures of several runs as columns, one row per run.

    pattern: a folder pattern such as "runs/*", or a list of folders. Folders that are not run folders are left out.

    Returns a dict of columns, all of one length, sorted by folder: `folder`, `state`, every value of the experiments that is not
    the same in all of them (such as "velocity.alpha"), and every number of summary.json (such as "volume" or "events.split").
    Numbers are NumPy arrays, with NaN where a run has no value; everything else is a list. pandas.DataFrame(columns) takes it.
    """
    folders = sorted(glob.glob(os.fspath(pattern))) if isinstance(pattern, (str, os.PathLike)) else [os.fspath(f) for f in pattern]
    folders = [folder for folder in folders if os.path.exists(os.path.join(folder, "status.json"))]
    runs = [load_run(folder) for folder in folders]
    columns = {"folder": folders, "state": [run["status"].get("state", "") for run in runs]}
    _add(columns, [_flat(run["experiment"]) for run in runs], only_differences=True)
    _add(columns, [{k: v for k, v in _flat(run["summary"]).items() if _is_number(v)} for run in runs])
    return columns


def _add(columns, rows, only_differences=False):
    for name in dict.fromkeys(name for row in rows for name in row):
        values = [row.get(name) for row in rows]
        if name in columns or only_differences and all(value == values[0] for value in values):
            continue
        columns[name] = _column(values) if all(v is None or _is_number(v) for v in values) else values


def _flat(value, name=""):
    """The leaves of nested dicts and lists by their dotted paths."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else None
    if items is None:
        return {name: value}
    leaves = {}
    for key, inner in items:
        leaves.update(_flat(inner, f"{name}.{key}" if name else str(key)))
    return leaves


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _number(cell):
    if cell == "":
        return None
    return int(cell) if cell.isdecimal() else float(cell)


def _column(values):
    whole = all(isinstance(value, int) for value in values)
    return numpy.array(values, dtype=numpy.int64) if whole and values else \
        numpy.array([numpy.nan if value is None else value for value in values], dtype=numpy.float64)
