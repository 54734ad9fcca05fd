"""hf: dynamic harmonic fields. Sites come and go on a factored surface; handles pose it; motion plays on another.

    import numpy as np, hf
    surface = hf.Surface(positions, triangles)
    solver = hf.Solver(surface)
    solver.add_sites([0, 41], [0.0, 1.0])
    field = solver.solve()

The C headers (include/hf) are the reference, and classes are made from them. Objects close themselves, in any order;
failures are exceptions with the library's own message, HfError and its subclasses.
"""

from . import _api, _raw as constants
from ._api import *  # noqa: F401,F403
from ._extended import Pose, Surface
from ._library import version

__version__ = constants.HEADER_VERSION
__all__ = ["constants", "version"]
__all__ += _api.__all__
