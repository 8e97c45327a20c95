"""The result of a run."""

import collections
import os

import numpy

Warning = collections.namedtuple("Warning", "code text")
Warning.__doc__ = "A warning about a result: a stable code, and complete sentences."


class Result:
    """The surface and the volume of a run, in the units of the input.

    The arrays are read-only; `.copy()` gives an array that can be changed.

    Attributes:
        vertices: (n, 3) float64, positions of the vertices of the surface.
        faces: (m, 3) uint32, indices into vertices, counter-clockwise seen from outside.
        points: (p, 3) float64, positions of the vertices of the tets.
        tets: (k, 4) uint32, indices into points, positively oriented.
        labels: (k,) int32, label of each tet; 0 is outside.
        quality: (k,) float64, quality of each tet, 1 for a regular one.
        vertex_points: (n,) uint32, the row of points of each vertex.
        support: (n,) float64, 0 to 1: the part of the area round each vertex for which the cloud has points; None if the velocity
            does not publish it.
        colors: (n, 3) uint8, red, green and blue from the cloud; None without colours.
        attributes: dict of (n,) float64, all numbers per vertex that strategies have published.
        metrics: dict of arrays, the columns of metrics.csv, one row per step; row 0 is the state before the first step.
        summary: dict, the content of summary.json.
        warnings: list of Warning(code, text).
        status: "converged", "max_steps", "stalled" or "cancelled".
        steps: number of steps.
        folder: the folder of the run, or None if it was temporary.
        evaluation: what dsc.evaluate() returned, if `truth` was given, else None.
    """

    def __init__(self, data, folder, metrics, summary):
        self._data = data
        self.vertices, self.faces = data.vertices, data.faces
        self.points, self.tets, self.labels, self.quality = data.points, data.tets, data.labels, data.quality
        self.vertex_points = data.vertex_points
        self.attributes = data.attributes
        self.support = self.attributes.get("support")
        self.colors = data.colors if len(data.colors) else None
        self.warnings = [Warning(*warning) for warning in data.warnings]
        self.status, self.steps = data.status, data.steps
        self.folder, self.metrics, self.summary = folder, metrics, summary
        self.evaluation = None

    def save(self, path):
        """Writes the surface or the volume.

        The ending selects the format, as for `dsc reconstruct`: a surface or a volume. The file appears complete or not at all.
        Raises UsageError for another ending, IoError if the file cannot be written.
        """
        self._data.save(os.fspath(path))

    def label_volume(self, label=1):
        """Volume of all tets with this label, in cubed units of the input."""
        corner = self.points[self.tets[self.labels == label]]
        edges = corner[:, 1:] - corner[:, :1]
        return float(numpy.linalg.det(edges).sum() / 6.0)

    def __repr__(self):
        return (f"<dsc.Result: {self.status} after {self.steps} steps, {len(self.vertices)} vertices, {len(self.faces)} faces, "
                f"{len(self.tets)} tets, {len(self.warnings)} warnings>")
