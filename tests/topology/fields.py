"""Distance-like functions of points (n, 3): negative inside, and nowhere steeper than 1, as marching.surface_mesh asks."""

import packages  # noqa: F401
import numpy as np
from scipy.spatial import cKDTree


def ball(centre, radius):
    return lambda p: np.linalg.norm(p - centre, axis=1) - radius


def box(centre, size):
    """`size` is the length of the edges; works in two dimensions too."""
    def field(p):
        q = np.abs(p - np.asarray(centre, float)) - np.asarray(size, float) / 2
        return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)
    return field


def rod(a, b, radius, end_radius=None):
    """A segment's neighbourhood with round ends, in two or three dimensions; the radius may change along it a little."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    slope = 0.0 if end_radius is None else end_radius - radius
    steepest = np.hypot(1.0, slope / np.linalg.norm(b - a))

    def field(p):
        t = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        return (np.linalg.norm(p - a - t[:, None] * (b - a), axis=1) - radius - slope * t) / steepest
    return field


def cylinder(centre, axis, radius, length=np.inf):
    """Flat ends at half the length on either side of the centre."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)

    def field(p):
        q = p - np.asarray(centre, float)
        along = q @ axis
        return np.maximum(np.linalg.norm(q - along[:, None] * axis, axis=1) - radius, np.abs(along) - length / 2)
    return field


def torus(centre, axis, ring, radius):
    """`ring` is the radius of the tube's centre line, `radius` that of the tube."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)

    def field(p):
        q = p - np.asarray(centre, float)
        along = q @ axis
        return np.hypot(np.linalg.norm(q - along[:, None] * axis, axis=1) - ring, along) - radius
    return field


def along(curve, radius):
    """Neighbourhood of a curve given by closely set points, in two or three dimensions."""
    tree = cKDTree(curve)
    return lambda p: tree.query(p)[0] - radius


def union(*fields):
    return lambda p: np.minimum.reduce([f(p) for f in fields])


def common(*fields):
    return lambda p: np.maximum.reduce([f(p) for f in fields])


def cut(field, *away):
    """What is left of a body without the others."""
    return lambda p: np.maximum.reduce([field(p), *(-f(p) for f in away)])


def extruded(flat, height):
    """A field in the plane, drawn out along z, symmetric about 0."""
    return lambda p: np.maximum(flat(p[:, :2]), np.abs(p[:, 2]) - height / 2)


def revolved(flat):
    """A field of (distance from the z axis, z)."""
    return lambda p: flat(np.stack([np.hypot(p[:, 0], p[:, 1]), p[:, 2]], axis=1))


def turned(flat, angle):
    """A field in the plane, turned about the origin."""
    c, s = np.cos(angle), np.sin(angle)
    return lambda p: flat(p @ np.array([[c, -s], [s, c]]))


def disc(radius, centre=(0.0, 0.0)):
    return ball(np.asarray(centre, float), radius)
