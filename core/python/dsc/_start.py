"""Loads NumPy and the extension module, and connects the library's log with the module logging."""

import logging
import sys

from . import _build

try:
    import numpy  # noqa: F401
except ImportError:
    # An interpreter without a NumPy of its own uses that of the build, which fits interpreters of the same version.
    sys.path.append(_build.NUMPY_FOLDER)
    try:
        import numpy  # noqa: F401
    except ImportError as error:
        raise ImportError("dsc needs NumPy, which this interpreter does not have; install python3-numpy, or use /usr/bin/python3") \
            from error
    finally:
        sys.path.remove(_build.NUMPY_FOLDER)

from . import _dsc  # noqa: E402

version = _dsc.version
logger = logging.getLogger("dsc")
_LEVELS = (logging.DEBUG, logging.INFO, logging.WARNING, logging.ERROR)


def _log(level, text):
    logger.log(_LEVELS[level], "%s", text)


# In the command `dsc` the log belongs to the command.
if not getattr(sys, "_dsc_host", False):
    _dsc.set_log(_log)
