"""numpy and scipy, or a skipped test: import this before either of them."""

import os
import sys

try:
    import numpy  # noqa: F401
    import scipy.sparse.csgraph  # noqa: F401
    import scipy.spatial  # noqa: F401
except ImportError as error:
    DEBIAN = "/usr/bin/python3"  # whose packages they are, where another Python comes first
    if sys.prefix != "/usr" and os.access(DEBIAN, os.X_OK) and sys.argv[0].endswith(".py"):
        os.execv(DEBIAN, [DEBIAN, *sys.argv])
    print(f"SKIPPED: {error}; install python3-numpy and python3-scipy")
    sys.exit(77)
