"""hf: dynamic harmonic fields. Sites come and go on a factored surface; handles pose it; motion plays on another.

    import numpy as np, hf
    surface = hf.Surface(positions, triangles)
    solver = hf.Solver(surface)
    solver.add_sites([0, 41], [0.0, 1.0])
    field = solver.solve()

The C headers (include/hf) are the reference. Objects close themselves, in any order; failures are exceptions with the
library's own message, HfError and its subclasses.
"""

from . import _raw as constants
from ._library import (BusyError, CancelledError, ConflictError, DuplicateError, EmptyError, InaccurateError,
                       InternalError, InvalidArgumentError, InvalidDescError, InvalidObjectError, NonFiniteError,
                       NotFoundError, NotPositiveDefiniteError, NullPointerError, OutOfMemoryError, OutOfRangeError,
                       ReentrantError, TooLargeError, TooSmallError, UnsupportedError)
from ._library import EXCEPTIONS, NO_INDEX, HfError, library
from ._raw import (hf_deform_info as DeformInfo, hf_direction_statistics as DirectionStatistics,
                   hf_handle_info as HandleInfo, hf_hit as Hit, hf_pair_info as PairInfo, hf_pose_info as PoseInfo,
                   hf_quads_info as QuadsInfo, hf_region_info as RegionInfo, hf_solve_info as SolveInfo,
                   hf_solver_info as SolverInfo, hf_solver_statistics as SolverStatistics,
                   hf_surface_info as SurfaceInfo, hf_surface_report as SurfaceReport,
                   hf_surface_statistics as SurfaceStatistics, hf_transfer_dials as TransferDials,
                   hf_transfer_info as TransferInfo,
                   hf_weights_transfer_info as WeightTransferInfo, hf_weights_mirror_info as MirrorInfo, hf_weights_info as WeightsInfo)
from .direction import Direction
from .pose import DeformMode, Pair, Pose, Skin, Transfer, TransferMode
from .quads import Flow, Streamlines, QuadMesh, Quads
from .region import Base, CurveKind, Detail, Region, RegionList, Side
from .solver import Engine, Solver
from .surface import DistanceMethod, Extremities, FieldKind, Geodesics, Isolines, Levels, Operator, Progress, Surface, Weld
from .weights import (JointFlag, HelperReason, Mirrored, MirrorTo, Origin, Pairing, VertexWeights, Weights, transfer_weights,
                      mirror_weights)

__version__ = constants.HEADER_VERSION


def version() -> tuple:
    """Version of the loaded library: (major, minor, patch)."""
    number = library().hf_version_get()
    return number // 1000000, number // 1000 % 1000, number % 1000
