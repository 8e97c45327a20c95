"""Parameters of strategies: class attributes that an experiment may set."""

from ._errors import usage_error

_REQUIRED = object()


class Parameter:
    """One parameter, as the functions of this module declare it."""

    def __init__(self, type, default=_REQUIRED, *, doc, unit="", minimum=None, maximum=None, above=None, below=None, choices=(),
                 extensions=(), kind="", optional=False, advanced=False, costly=False):
        self.type = type
        self.required = default is _REQUIRED and not optional
        self.default = None if default is _REQUIRED else default
        self.doc = doc
        self.unit = unit
        self.minimum, self.maximum, self.above, self.below = minimum, maximum, above, below
        self.choices = list(choices)
        self.extensions = list(extensions)
        self.kind = kind
        self.optional = optional or self.default is None and not self.required
        self.tags = ["advanced"] * advanced + ["costly"] * costly


def boolean(default=_REQUIRED, **options):
    """A parameter that is true or false. Options: doc (required), advanced, costly."""
    return Parameter("boolean", default, **options)


def integer(default=_REQUIRED, **options):
    """An integer. Options: doc (required), unit, minimum, maximum (both ends belong to the range), above, below (they do not),
    advanced, costly. A parameter without a default must be given; a default of None means that it may stay unset."""
    return Parameter("integer", default, **options)


def real(default=_REQUIRED, **options):
    """A real number. Options as integer(). The unit is "dimensionless" for a pure number, "length" for normalised units."""
    return Parameter("real", default if default in (_REQUIRED, None) else float(default), **options)


def string(default=_REQUIRED, **options):
    """A text. Options: doc (required), advanced."""
    return Parameter("string", default, **options)


def choice(values, default=_REQUIRED, **options):
    """One of some texts. Options: doc (required), advanced."""
    return Parameter("choice", default, choices=values, **options)


def file(default=_REQUIRED, **options):
    """A file; a relative name starts at the folder of the experiment. Options: doc (required), extensions, such as [".obj"]."""
    return Parameter("file", default, **options)


def vec3(default=_REQUIRED, **options):
    """Three real numbers, as an array of shape (3,). Options as real()."""
    return Parameter("vec3", _reals(default), **options)


def integers(default=_REQUIRED, **options):
    """A list of integers. Options as integer()."""
    return Parameter("integers", default if default in (_REQUIRED, None) else list(default), **options)


def reals(default=_REQUIRED, **options):
    """A list of real numbers. Options as real()."""
    return Parameter("reals", _reals(default), **options)


def strings(default=_REQUIRED, **options):
    """A list of texts. Options: doc (required), choices."""
    return Parameter("strings", default if default in (_REQUIRED, None) else list(default), **options)


def strategy(kind, default=_REQUIRED, **options):
    """Another strategy, of the kind "velocity" or "curvature", from any plugin. Options: doc (required).

    The class gets an object with the methods advance(context), prepare(context) and evaluate(), to be called in this order once
    per step. evaluate() returns the displacements, shape (n, 3), of a velocity; the scalars, shape (n,), and the vectors, shape
    (n, 3), of a curvature. A default of None means that the parameter may stay unset; it is None then.
    """
    if kind not in ("velocity", "curvature"):
        raise usage_error("python.parameter", "strategy()", f"has the kind {kind!r}", "use 'velocity' or 'curvature'")
    return Parameter("strategy", default, kind=kind, **options)


def _reals(default):
    if default is _REQUIRED or default is None:
        return default
    return [float(value) for value in default]
