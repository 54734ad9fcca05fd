"""Generated from include/hf/*.h by bindings/generate; do not edit. Classes, enums and results of the package."""
# fmt: off

from __future__ import annotations

import ctypes
from enum import IntEnum, IntFlag
from typing import Any, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _errors, _raw
from ._errors import *  # noqa: F401,F403
from ._library import ArrayLike, Call, Object, Recorded, address, call, handle_of, library, number, place, ref
from ._library import PlaceLike

NO_INDEX = _raw.HF_NO_INDEX


def told(of: Any, counts: Sequence[str], report: str = "") -> str:
    """The repr of an object: its counts, and those of its report that are not 0."""
    if of.closed:
        return f"<hf.{type(of).__name__} closed>"
    shown = [(name, getattr(of, name)) for name in counts]
    found = getattr(of, report) if report else None
    for name, *_ in found._fields_ if found else ():
        if name.endswith("_count") and name not in counts and getattr(found, name):
            shown.append((name, getattr(found, name)))
    return f"<hf.{type(of).__name__}{''.join(f' {name}={value}' for name, value in shown)}>"


Link = _raw.hf_link
SurfaceInfo = _raw.hf_surface_info
SurfaceReport = _raw.hf_surface_report
MeshStatistics = _raw.hf_mesh_statistics
LinksInfo = _raw.hf_links_info
GapsInfo = _raw.hf_gaps_info
CutCorner = _raw.hf_cut_corner
SurfaceStatistics = _raw.hf_surface_statistics
Place = _raw.hf_place
Hit = _raw.hf_hit
SolverInfo = _raw.hf_solver_info
SolveInfo = _raw.hf_solve_info
PreviewInfo = _raw.hf_preview_info
Certificate = _raw.hf_certificate
SolverStatistics = _raw.hf_solver_statistics
CriticalPoint = _raw.hf_critical_point
CriticalInfo = _raw.hf_critical_info
Extremity = _raw.hf_extremity
Singularity = _raw.hf_singularity
DirectionStatistics = _raw.hf_direction_statistics
PoseInfo = _raw.hf_pose_info
Transform = _raw.hf_transform
HandleInfo = _raw.hf_handle_info
DeformInfo = _raw.hf_deform_info
PoseStatistics = _raw.hf_pose_statistics
BlendInfo = _raw.hf_blend_info
HandleProposal = _raw.hf_handle_proposal
QuadsInfo = _raw.hf_quads_info
RegionInfo = _raw.hf_region_info
RegionStatistics = _raw.hf_region_statistics
RetargetInfo = _raw.hf_retarget_info
ChainMatch = _raw.hf_chain_match
SkeletonInfo = _raw.hf_skeleton_info
JointInfo = _raw.hf_joint_info
Chain = _raw.hf_chain
PairInfo = _raw.hf_pair_info
TransferInfo = _raw.hf_transfer_info
TransferStatistics = _raw.hf_transfer_statistics
TransferDials = _raw.hf_transfer_dials
WeightsInfo = _raw.hf_weights_info
WeightsStatistics = _raw.hf_weights_statistics
WeightsTransferInfo = _raw.hf_weights_transfer_info
WeightsMirrorInfo = _raw.hf_weights_mirror_info
WeightsMirrorStatistics = _raw.hf_weights_mirror_statistics


class Weld(IntEnum):
    """Selects how the surface joins vertices at one place. Modelling tools split vertices at texture seams: a horse
    model can have 1,109 separate pieces as stored and be one piece when welded. Functions write results to every copy
    of a vertex.
    """

    EXACT = _raw.HF_WELD_EXACT
    """bit-equal positions (+0 and -0 are equal)"""
    NONE = _raw.HF_WELD_NONE
    """vertices as stored"""
    TOLERANCE = _raw.HF_WELD_TOLERANCE
    """positions closer than weld_tolerance, transitively"""


class Operator(IntEnum):
    """Selects the edge weights w_ij of the discrete Laplacian L of a field u: (L u)_i = sum_j w_ij (u_i - u_j)."""

    INTRINSIC_DELAUNAY = _raw.HF_OPERATOR_INTRINSIC_DELAUNAY
    """cotangent weights of the intrinsic Delaunay triangulation, on the tufted cover where edges are open or non-
    manifold (Bobenko and Springborn 2007; Sharp and Crane 2020). Weights are never negative: a field keeps to the
    range of its sites on any mesh
    """
    CLAMPED = _raw.HF_OPERATOR_CLAMPED
    """cotangents, at least 1e-3 of the median weight: keeps to the range too"""
    UNIFORM = _raw.HF_OPERATOR_UNIFORM
    """w_ij = 1"""
    COTANGENT = _raw.HF_OPERATOR_COTANGENT
    """w_ij = (cot a_ij + cot b_ij) / 2, the paper's; can be negative at obtuse triangles"""
    GRAPH = _raw.HF_OPERATOR_GRAPH
    """your own weights; only Surface.from_graph makes it"""


class FieldKind(IntEnum):
    """Selects the matrix K that a field solves with. A bi-harmonic field is smooth at its sites and overshoots their
    values. Its factor is 3 to 4 times larger than a harmonic one, and its solve adds one correction step.
    """

    HARMONIC = _raw.HF_FIELD_HARMONIC
    """K = L"""
    BIHARMONIC = _raw.HF_FIELD_BIHARMONIC
    """K = L M^-1 L, M the vertex areas scaled to mean 1 by component: does not depend on the scale of the mesh"""
    BIHARMONIC_GRAPH = _raw.HF_FIELD_BIHARMONIC_GRAPH
    """K = L^2, as in the paper: fields change with the density of the vertices"""


class Ordering(IntEnum):
    """Selects how the unknowns are ordered. A good order keeps the factor small."""

    NESTED_DISSECTION = _raw.HF_ORDERING_NESTED_DISSECTION
    """our own; gives the smallest factor"""
    MINIMUM_DEGREE = _raw.HF_ORDERING_MINIMUM_DEGREE
    """quicker to compute, larger factor on large meshes"""
    METIS = _raw.HF_ORDERING_METIS
    """builds with HF_WITH_GPL only"""


class LinkMode(IntEnum):
    """Selects how the pieces of a mesh are linked. A piece is an edge-connected part, such as an eye or a plate of a
    robot. Without links every piece is a domain of its own: a field or a pose ends where the piece ends.
    """

    NONE = _raw.HF_LINK_NONE
    """pieces stay apart. The default, because a scan or a scene may hold bodies that do not belong together; the
    programs and bindings for characters link by default
    """
    PIECES = _raw.HF_LINK_PIECES
    """automatic: a tree over the pieces by smallest distance, and all pieces that touch"""
    LIST = _raw.HF_LINK_LIST
    """the links you give, and no others; only light_vertices name light pieces then"""


class Route(IntEnum):
    """These values say how the solver carried out the last edit of site places (SolverStatistics.last_route)."""

    NONE = _raw.HF_ROUTE_NONE
    """no place was edited yet"""
    DENSE = _raw.HF_ROUTE_DENSE
    """rows of the dense system were added and removed"""
    FRESH = _raw.HF_ROUTE_FRESH
    """the dense system was recomputed, which was quicker"""
    REBASE = _raw.HF_ROUTE_REBASE
    """factorised again with hard vertex sites eliminated"""


class Levels(IntEnum):
    """Selects how levels divide a field into strips. N levels give N + 1 strips."""

    VALUE = _raw.HF_LEVELS_VALUE
    """equal steps of the value"""
    AREA = _raw.HF_LEVELS_AREA
    """equal areas: the strips cover the same area each"""
    LENGTH = _raw.HF_LEVELS_LENGTH
    """equal mean widths: the width of a strip is its area over the mean length of its lines"""


class Critical(IntEnum):
    MINIMUM = _raw.HF_CRITICAL_MINIMUM
    MAXIMUM = _raw.HF_CRITICAL_MAXIMUM
    SADDLE = _raw.HF_CRITICAL_SADDLE


class DistanceMethod(IntEnum):
    """Selects how distances are computed. docs/geodesics.md has the errors of each."""

    AUTO = _raw.HF_GEODESICS_AUTO
    """EXACT up to 10,000 vertices, FRONT beyond"""
    FRONT = _raw.HF_GEODESICS_FRONT
    """fast: circular fronts on the intrinsic Delaunay triangulation (Novotni and Klein 2002)"""
    EXACT = _raw.HF_GEODESICS_EXACT
    """exact up to rounding: windows (Mitchell, Mount and Papadimitriou 1987)"""
    HEAT = _raw.HF_GEODESICS_HEAT
    """smooth, and least exact: the heat method (Crane, Weischedel and Wardetzky 2013)"""


class ExtremityKind(IntEnum):
    """Selects how Surface.find_extremities finds tips. Both kinds take the maxima of a field that rises towards
    protruding parts.
    """

    POISSON = _raw.HF_EXTREMITIES_POISSON
    """a field with a source at every vertex: one solve"""
    GEODESIC = _raw.HF_EXTREMITIES_GEODESIC
    """mean geodesic distance to the rest of the component (Hilaga et al. 2001)"""


class HandleReason(IntEnum):
    """Says why a place is proposed as a handle."""

    FOOT = _raw.HF_HANDLE_REASON_FOOT
    """stands on the ground: the surface rises from it along a leg"""
    TIP = _raw.HF_HANDLE_REASON_TIP
    """a protruding part ends there: head, tail, hand, horn (Surface.find_extremities)"""
    END = _raw.HF_HANDLE_REASON_END
    """one of the two ends of a component without feet or tips"""
    JOINT = _raw.HF_HANDLE_REASON_JOINT
    """a joint of the given skeleton: an end, or where it branches. Or a head, hand or foot that is no tip of the surface
    """
    MIDDLE = _raw.HF_HANDLE_REASON_MIDDLE
    """The trunk of the largest component: the chest of a biped; pinned, inside the surface. With a skeleton of an
    upright body, the vertices of chest and shoulders are held, up to the neck
    """


class Base(IntEnum):
    """The smooth base of a region."""

    DEFAULT = _raw.HF_BASE_DEFAULT
    """THIN_PLATE"""
    MEMBRANE = _raw.HF_BASE_MEMBRANE
    """harmonic: the least area for its rim, nearly; it meets the rim with a crease"""
    THIN_PLATE = _raw.HF_BASE_THIN_PLATE
    """bi-harmonic (FieldKind.BIHARMONIC): leaves the surface around it without a crease"""
    THIN_PLATE_GRAPH = _raw.HF_BASE_THIN_PLATE_GRAPH
    """the paper's bi-harmonic field (FieldKind.BIHARMONIC_GRAPH)"""


class Side(IntEnum):
    """A closed curve cuts the surface in two. The side says which part becomes the region. Where a curve along edges
    touches itself there are more parts: SMALLER takes all but the largest, SEED the part of its vertex.
    """

    SMALLER = _raw.HF_SIDE_SMALLER
    """the side of smaller area"""
    LARGER = _raw.HF_SIDE_LARGER
    """the side of larger area"""
    SEED = _raw.HF_SIDE_SEED
    """the side that seed_vertex lies in"""


class CurveKind(IntEnum):
    """How the points of a curve are joined: each to the next, and the last to the first."""

    STRAIGHT = _raw.HF_CURVE_STRAIGHT
    """by shortest paths along the surface, through triangles, exact up to rounding"""
    EDGES = _raw.HF_CURVE_EDGES
    """by shortest paths along edges; points in triangles stand for their nearest corner"""


class RegionList(IntEnum):
    """Lists of vertices of a region."""

    INSIDE = _raw.HF_REGION_INSIDE
    """the region"""
    RIM = _raw.HF_REGION_RIM
    """the vertices next to it"""
    SITES = _raw.HF_REGION_SITES
    """vertices whose positions fix the base"""


class RootMotion(IntEnum):
    """Which joint gets the travel over the ground."""

    HIPS = _raw.HF_ROOT_MOTION_HIPS
    """the hips"""
    ROOT = _raw.HF_ROOT_MOTION_ROOT
    """the topmost joint above the hips, as engines want for root motion"""
    IN_PLACE = _raw.HF_ROOT_MOTION_IN_PLACE
    """none: the body stays in its place"""


class RetargetStep(IntFlag):
    """Bits that name steps to leave out."""

    NONE = 0
    KEEP_RESTS = _raw.HF_RETARGET_KEEP_RESTS
    """limbs are not aligned: both rests are alike, or you want their difference"""
    NO_GOALS = _raw.HF_RETARGET_NO_GOALS
    """joints turn and the hips travel; feet and ground are ignored"""
    NO_LOCK = _raw.HF_RETARGET_NO_LOCK
    """planted feet may slide. A frame then has no state: a scrubbed timeline gives the bits of a played one"""
    NO_COPY = _raw.HF_RETARGET_NO_COPY
    """equal skeletons are retargeted like others"""


class ScaleFrom(IntEnum):
    """Says where the scale comes from."""

    GIVEN = _raw.HF_SCALE_GIVEN
    LEGS = _raw.HF_SCALE_LEGS
    """lengths of legs, from hip to sole"""
    HIPS = _raw.HF_SCALE_HIPS
    """heights of hips: both stand on four legs or more"""
    HEIGHT = _raw.HF_SCALE_HEIGHT
    """heights of bodies: one has no legs"""


class Role(IntEnum):
    """The part of the body that a joint or a chain is."""

    OTHER = _raw.HF_ROLE_OTHER
    SPINE = _raw.HF_ROLE_SPINE
    NECK = _raw.HF_ROLE_NECK
    HEAD = _raw.HF_ROLE_HEAD
    JAW = _raw.HF_ROLE_JAW
    SHOULDER = _raw.HF_ROLE_SHOULDER
    ARM = _raw.HF_ROLE_ARM
    HAND = _raw.HF_ROLE_HAND
    FINGER = _raw.HF_ROLE_FINGER
    LEG = _raw.HF_ROLE_LEG
    FOOT = _raw.HF_ROLE_FOOT
    TOE = _raw.HF_ROLE_TOE
    TAIL = _raw.HF_ROLE_TAIL
    WING = _raw.HF_ROLE_WING
    EAR = _raw.HF_ROLE_EAR
    EYE = _raw.HF_ROLE_EYE
    ANTENNA = _raw.HF_ROLE_ANTENNA
    FIN = _raw.HF_ROLE_FIN


class BodySide(IntEnum):
    """The side of the character, not of the person who looks at it."""

    MIDDLE = _raw.HF_SIDE_MIDDLE
    LEFT = _raw.HF_SIDE_LEFT
    RIGHT = _raw.HF_SIDE_RIGHT


class JointKind(IntEnum):
    """How a joint serves the body."""

    BODY = _raw.HF_JOINT_KIND_BODY
    """it moves a part of the body"""
    HELPER = _raw.HF_JOINT_KIND_HELPER
    """a control, a pole, a target or a root: it moves no part"""
    END = _raw.HF_JOINT_KIND_END
    """it marks the tip of a chain"""
    TWIST = _raw.HF_JOINT_KIND_TWIST
    """it lies along a bone and takes a share of its turn"""


class TransferMode(IntEnum):
    FIELDS = _raw.HF_TRANSFER_FIELDS
    """a cluster: vertices with similar values of all fields; the default"""
    STRETCH = _raw.HF_TRANSFER_STRETCH
    """Transfers stretch too: faces, breathing, squash. Play each morph target of the source as a frame. Each target
    vertex i matches a source point with the deformation gradient F_i (Sumner and Popovic 2004). The result x'
    minimises sum over edges of w_ij |(x'_i - x'_j) - (F_i + F_j) / 2 (x_i - x_j)|^2 with cotangent weights w. It is a
    Poisson equation with the factor of the surface. Borders match borders, and narrow openings between them, such as
    lids, close as on the source. There is no ground, no rest alignment, no dial, no hold and no skin; flags of pairs
    only set the scale. A surface on itself gets its own pose
    """


class Ground(IntEnum):
    KEEP = _raw.HF_GROUND_KEEP
    """feet are held at the ground. A part goes no deeper under the ground than on the source; thin parts may. The
    default
    """
    OFF = _raw.HF_GROUND_OFF
    """there is no ground: for flying and swimming, or where the host has its own"""


class PairFlag(IntFlag):
    """Bits that describe a pair of regions."""

    NONE = 0
    ANCHOR = _raw.HF_PAIR_ANCHOR
    """the target's region follows the scaled path of the source's (feet, trunk)"""
    FOOT = _raw.HF_PAIR_FOOT
    """an anchor that also stands on the ground, and whose leg gives the scale"""
    TRUNK = _raw.HF_PAIR_TRUNK
    """part of the trunk: no rest alignment"""
    NO_ALIGNMENT = _raw.HF_PAIR_NO_ALIGNMENT
    """keep the source's rotations as they are even if the rest limbs point elsewhere"""
    CONTACT = _raw.HF_PAIR_CONTACT
    """comes as near to the ground as the source's region, scaled, while that is near it (a nose that grazes, a hand that
    leans); elsewhere it is free
    """
    SINKS = _raw.HF_PAIR_SINKS
    """this limb may sink into the ground, thick or thin (Transfer.sinking)"""
    NECK = _raw.HF_PAIR_NECK
    """head, nose or ears: neck_follow of hf_transfer_dials turns the neck that they share"""
    TAIL = _raw.HF_PAIR_TAIL
    """part of the tail: tail_follow turns it"""
    ARM = _raw.HF_PAIR_ARM
    """a hand: arm_space turns the arms of each side"""


class WeightsOrigin(IntEnum):
    """How the weights of a vertex were found."""

    INFORMED = _raw.HF_WEIGHTS_INFORMED
    """its nearest joint is in sight"""
    SOLVED = _raw.HF_WEIGHTS_SOLVED
    """from the vertices around it"""
    PINNED = _raw.HF_WEIGHTS_PINNED
    """given by a pin"""
    NEAREST = _raw.HF_WEIGHTS_NEAREST
    """guessed: its piece has no information; from the nearest vertices of others"""
    RIGID = _raw.HF_WEIGHTS_RIGID
    """guessed, as NEAREST: one mean for all vertices of a small piece"""
    ISOLATED = _raw.HF_WEIGHTS_ISOLATED
    """guessed: it belongs to no triangle; from the nearest vertex"""
    MATCHED = _raw.HF_WEIGHTS_MATCHED
    """transferred or mirrored: from a near point whose normal agrees"""
    KEPT = _raw.HF_WEIGHTS_KEPT
    """mirrored: it is on the side to copy from"""


class JointFlag(IntFlag):
    """Bits that say why a joint deserves a look."""

    NONE = 0
    NO_LENGTH = _raw.HF_JOINT_NO_LENGTH
    """it is a point"""
    COINCIDENT = _raw.HF_JOINT_COINCIDENT
    """it lies exactly on a joint of a lower number"""
    INFORMS_NONE = _raw.HF_JOINT_INFORMS_NONE
    """no vertex has it as its nearest joint in sight"""
    OUTSIDE = _raw.HF_JOINT_OUTSIDE
    """no part of it is inside the skin"""
    HELPER = _raw.HF_JOINT_HELPER
    """a proposal that follows from the other flags: it looks like a helper that should not deform"""


class HelperReason(IntFlag):
    """Bits that say why a joint looks like a helper: a root, a target or a control that moves no skin."""

    NONE = 0
    PROPOSED = _raw.HF_HELPER_PROPOSED
    """the reasons together are enough to propose it"""
    NAME_ROOT = _raw.HF_HELPER_NAME_ROOT
    """its name says root, armature, master, ..."""
    NAME_CONTROL = _raw.HF_HELPER_NAME_CONTROL
    """its name says pole, target, IK, control, ..."""
    NAME_END = _raw.HF_HELPER_NAME_END
    """its name says end, tip, slot, ..."""
    ROOT = _raw.HF_HELPER_ROOT
    """it has no parent, but children"""
    APART = _raw.HF_HELPER_APART
    """it has no child, and its parent is a root with other joints"""
    NO_LENGTH = _raw.HF_HELPER_NO_LENGTH
    """as JointFlag.NO_LENGTH, and so on"""
    COINCIDENT = _raw.HF_HELPER_COINCIDENT
    OUTSIDE = _raw.HF_HELPER_OUTSIDE
    INFORMS_NONE = _raw.HF_HELPER_INFORMS_NONE


class MirrorTo(IntEnum):
    """Which side of the plane gives its weights."""

    TO_NEGATIVE = _raw.HF_MIRROR_TO_NEGATIVE
    """the side that the normal points to"""
    TO_POSITIVE = _raw.HF_MIRROR_TO_POSITIVE
    """the other side"""
    BOTH = _raw.HF_MIRROR_BOTH
    """each side takes the mean of both"""


class MirrorPlane(IntEnum):
    """Where a plane of symmetry comes from."""

    GIVEN = _raw.HF_MIRROR_PLANE_GIVEN
    JOINTS = _raw.HF_MIRROR_PLANE_JOINTS
    """from joints with partners"""
    SURFACE = _raw.HF_MIRROR_PLANE_SURFACE
    """from the surface"""


class MirrorPairing(IntEnum):
    """How a joint found its partner."""

    ALONE = _raw.HF_MIRROR_JOINT_ALONE
    """it has none, and moves the other side too"""
    NAMED = _raw.HF_MIRROR_JOINT_NAMED
    """the names differ in the side: arm.L and arm.R, LeftArm and RightArm"""
    PLACED = _raw.HF_MIRROR_JOINT_PLACED
    """it lies where the partner's reflection lies"""
    CENTRE = _raw.HF_MIRROR_JOINT_CENTRE
    """it lies on the plane, and is its own partner"""
    GIVEN = _raw.HF_MIRROR_JOINT_GIVEN


class Cut(NamedTuple):
    """A cut as triangles that go and come. The first three arrays fit hf_patch_desc. New vertices and triangles have the
    numbers after the last ones of your mesh. The arrays are yours: each is None or as large as its capacity.
    """

    removed_triangles: np.ndarray[Any, Any]
    """(removed_triangle_capacity,) triangles of your mesh, ascending"""
    new_positions: np.ndarray[Any, Any]
    """(new_vertex_capacity, 3) in the unit of your mesh"""
    new_triangles: np.ndarray[Any, Any]
    """(new_triangle_capacity, 3) vertices of your mesh, the first of welded copies, and new ones"""
    vertex_corners: np.ndarray[Any, Any]
    """(new_vertex_capacity, 3) vertices of your mesh; the new vertex lies between them. Mix their attributes, as skin
    weights. NO_INDEX where a weight is 0
    """
    vertex_barycentrics: np.ndarray[Any, Any]
    """(new_vertex_capacity, 3) their weights, of sum 1. A single 1 copies a vertex"""
    source_triangles: np.ndarray[Any, Any]
    """(new_triangle_capacity,) the removed triangle that each new one is a part of"""
    corner_barycentrics: np.ndarray[Any, Any]
    """(new_triangle_capacity, 3, 3) three weights for each corner of a new triangle, of the corners of its source: for
    what corners have, as UVs at seams
    """
    rim_vertices: np.ndarray[Any, Any]
    """(rim_capacity, 2) along the line: the vertex on its left and that on its right; one and the same where the line
    ends inside the surface. At a border between its ends: those after it
    """


class Isolines(NamedTuple):
    """Iso-lines as polylines. Each point lies on a mesh edge with the end vertices a and b, at the position (1 -
    parameter) a + parameter b. So you can interpolate any vertex attribute at the point. The arrays are yours: each
    is None or as large as its capacity.
    """

    point_edges: np.ndarray[Any, Any]
    """(point_capacity, 2) vertices a and b of your mesh, the first of welded copies"""
    parameters: np.ndarray[Any, Any]
    """(point_capacity,) 0 to 1"""
    positions: np.ndarray[Any, Any]
    """(point_capacity, 3) in the unit and frame of your mesh"""
    line_starts: np.ndarray[Any, Any]
    """(line_capacity + 1,) line i holds the points line_starts(i,) to line_starts(i + 1,) - 1"""
    line_levels: np.ndarray[Any, Any]
    """(line_capacity,) position of its level in the list"""
    line_closed: np.ndarray[Any, Any]
    """(line_capacity,) 1: closed, the first point is not repeated; 0: ends at borders"""

    def lines(self) -> List[np.ndarray[Any, Any]]:
        """The positions of each line."""
        return [self.positions[a:b] for a, b in zip(self.line_starts[:-1], self.line_starts[1:])]


class SitesInfo(NamedTuple):
    """Places, values and fluxes of the sites. The arrays are yours; each is None or has `capacity` entries. The entries
    are ordered by site number.
    """

    sites: np.ndarray[Any, Any]
    """(capacity,) numbers"""
    vertices: np.ndarray[Any, Any]
    """(capacity,) the vertex of the place, NO_INDEX for a point in a triangle"""
    components: np.ndarray[Any, Any]
    """(capacity,)"""
    values: np.ndarray[Any, Any]
    """(capacity, channel_count)"""
    stiffness: np.ndarray[Any, Any]
    """(capacity,) 0 = hard"""
    flux: np.ndarray[Any, Any]
    """(capacity, channel_count) lambda: what flows into the surface at the site, in value x weight; the sum over a disc
    """
    radii: np.ndarray[Any, Any]
    """(capacity,) 0 = a point"""


class Path(NamedTuple):
    """A path along the surface, from its first point to its last. Each point lies on a mesh edge with the end vertices a
    and b, at the position (1 - parameter) a + parameter b; at a vertex a is b. An end inside a triangle has NO_INDEX
    for both. The arrays are yours: each is None or as large as the capacity.
    """

    point_edges: np.ndarray[Any, Any]
    """(point_capacity, 2) vertices a and b of your mesh, the first of welded copies"""
    parameters: np.ndarray[Any, Any]
    """(point_capacity,) 0 to 1"""
    positions: np.ndarray[Any, Any]
    """(point_capacity, 3) in the unit and frame of your mesh"""
    length: float
    """in the unit of the mesh; -1: no path"""


class SkinInfo(NamedTuple):
    """This struct receives a pose or a transfer as a skin for linear blend skinning. The clusters become joints with
    fixed vertex weights, and the skin holds their motion in the last frame. Joint j takes a point p to R (p - pivot)
    + translation, with R its rotation. Its inverse bind matrix is the translation by -pivot.

    If you ask for scales, a joint may also stretch along its own axes. With B the rotation of `axes`, the joint takes
    p to R B diag(scale) B^-1 (p - pivot) + translation. In a scene file that is a node with rotation R B and that
    scale, and the inverse bind matrix takes p to B^-1 (p - pivot). The arrays are yours; each may be None.
    """

    pivots: np.ndarray[Any, Any]
    """(joint_capacity, 3) rest centroid of what each joint moves"""
    rotations: np.ndarray[Any, Any]
    """(joint_capacity, 4) quaternion x, y, z, w of the last frame"""
    translations: np.ndarray[Any, Any]
    """(joint_capacity, 3) posed place of the pivot"""
    axes: np.ndarray[Any, Any]
    """(joint_capacity, 4) quaternion of B, fixed while handles stay"""
    vertex_joints: np.ndarray[Any, Any]
    """(vertex_capacity, influence_count)"""
    vertex_weights: np.ndarray[Any, Any]
    """(vertex_capacity, influence_count) of sum 1, descending"""
    scales: Optional[np.ndarray[Any, Any]] = None
    """(joint_capacity, 3) along the axes in the last frame; None = joints are rigid"""


class BlendRows(NamedTuple):
    """Receives the rows of a blend. The arrays are yours; each may be None. Positions and offsets are in the unit of the
    mesh, gradients per unit of the mesh.
    """

    rows: np.ndarray[Any, Any]
    """(vertex_capacity, 2) number of the first entry of the vertex, and count of its entries"""
    clusters: np.ndarray[Any, Any]
    """(entry_capacity,) each below the count of clusters"""
    weights: np.ndarray[Any, Any]
    """(entry_capacity,) multiples of 2^-24; the weights of a vertex sum to 1"""
    gradients: np.ndarray[Any, Any]
    """(entry_capacity, 3) of the weights along the rest surface, for normals"""
    positions: np.ndarray[Any, Any]
    """(vertex_capacity, 3) at rest, relative to centre"""
    normals: np.ndarray[Any, Any]
    """(vertex_capacity, 3) unit, at rest"""
    offsets: np.ndarray[Any, Any]
    """(vertex_capacity, 3) 0 unless handles were added in place or rotations freed"""
    longest_row: int
    """entries of the vertex that has the most"""


class BlendInfluences(NamedTuple):
    """Receives a blend as rows of one length, as vertex buffers of engines have them (JOINTS_0 and WEIGHTS_0 of glTF).
    The arrays are yours; each may be None. Rows hold the heaviest entries of a vertex, by falling weight. Unused
    entries have weight 0.

    The errors say what shorter rows and rounded weights cost. A vertex is off by at most the change of its weights
    times the largest distance between the places to which its clusters move it.
    """

    clusters: np.ndarray[Any, Any]
    """(vertex_capacity, influence_count) each below the count of clusters"""
    weights: np.ndarray[Any, Any]
    """(vertex_capacity, influence_count) 65535ths; the weights of a vertex sum to 65535"""
    change: float
    """the largest change of a vertex's weights, 0 to 1: half the sum of the differences"""
    byte_change: float
    """the same for byte_weights"""
    error: float
    """the largest distance of a vertex from its place in the last frame, in box diagonals"""
    byte_error: float
    """the same for byte_weights"""
    byte_clusters: Optional[np.ndarray[Any, Any]] = None
    """(vertex_capacity, influence_count) None = not wanted. Refused for more than 256 clusters"""
    byte_weights: Optional[np.ndarray[Any, Any]] = None
    """(vertex_capacity, influence_count) None = not wanted. 255ths, of sum 255; weights that round to 0 are left out
    """


class QuadsMesh(NamedTuple):
    """Quads.mesh writes the quad mesh to these arrays. They are yours: each is None or as large as its capacity."""

    positions: np.ndarray[Any, Any]
    """(vertex_capacity, 3) in the unit and frame of your mesh"""
    faces: np.ndarray[Any, Any]
    """(face_capacity, 4) vertices of each quad, counter-clockwise"""
    triangles: np.ndarray[Any, Any]
    """(vertex_capacity,) triangle or face of your mesh that contains the vertex"""
    barycentrics: np.ndarray[Any, Any]
    """(vertex_capacity, 3) weights of that triangle's corners, in its own order, of sum 1; in a face of more corners the
    weights of `corners`
    """
    corners: np.ndarray[Any, Any]
    """(vertex_capacity, 3) vertices of your mesh that barycentrics belong to, the first of welded copies"""


class Streamlines(NamedTuple):
    """Results."""

    positions: np.ndarray[Any, Any]
    """(point_capacity, 3) in the unit and frame of your mesh"""
    values: np.ndarray[Any, Any]
    """(point_capacity,) of the field, rising along every line"""
    line_starts: np.ndarray[Any, Any]
    """(line_capacity + 1,) line i holds the points line_starts(i,) to line_starts(i + 1,) - 1"""
    line_ends: np.ndarray[Any, Any]
    """(line_capacity, 2) vertices where it starts and ends, of welded copies the first"""

    def lines(self) -> List[np.ndarray[Any, Any]]:
        """The positions of each line."""
        return [self.positions[a:b] for a, b in zip(self.line_starts[:-1], self.line_starts[1:])]


class WeightsOut(NamedTuple):
    """Receives the weights. The arrays are yours; each may be None."""

    joints: np.ndarray[Any, Any]
    """(vertex_capacity, influence_count)"""
    weights: np.ndarray[Any, Any]
    """(vertex_capacity, influence_count) descending, of sum exactly 1"""
    origins: np.ndarray[Any, Any]
    """(vertex_capacity,) WeightsOrigin"""


def _factor_desc(c: Call, prefix: str = '', *, bytes: Optional[bytes] = None) -> Any:
    desc = c.struct(_raw.hf_factor_desc, {})
    desc.bytes, desc.byte_count = c.bytes('bytes', bytes)
    return desc


def _links_desc(c: Call, prefix: str = '', *, joints: Optional[ArrayLike] = None, weights: Optional[ArrayLike] = None,
        joint_parents: Optional[ArrayLike] = None, tags: Optional[ArrayLike] = None, links: Optional[ArrayLike] = None,
        light_vertices: Optional[ArrayLike] = None, heavy_vertices: Optional[ArrayLike] = None,
        mode: int = LinkMode.NONE, distance: float = 0.0, stiffness: float = 0.0, overlay_distance: float = 0.0) -> Any:
    desc = c.struct(_raw.hf_links_desc, {'mode': mode, 'distance': distance, 'stiffness': stiffness,
            'overlay_distance': overlay_distance})
    desc.joints = c.array('joints', joints, 'u2', ('vertex_count', prefix + 'influence_count'))
    desc.weights = c.array('weights', weights, 'f4', ('vertex_count', prefix + 'influence_count'))
    desc.joint_parents = c.array('joint_parents', joint_parents, 'u4', (prefix + 'joint_count',), sentinel=True)
    desc.tags = c.array('tags', tags, 'u4', ('vertex_count',))
    desc.links = c.written('links', links, _raw.hf_link, (prefix + 'link_count',))
    desc.light_vertices = c.array('light_vertices', light_vertices, 'u4', (prefix + 'light_count',))
    desc.heavy_vertices = c.array('heavy_vertices', heavy_vertices, 'u4', (prefix + 'heavy_count',))
    desc.influence_count = c.n.setdefault(prefix + 'influence_count', 0)
    desc.link_count = c.n.setdefault(prefix + 'link_count', 0)
    desc.light_count = c.n.setdefault(prefix + 'light_count', 0)
    desc.heavy_count = c.n.setdefault(prefix + 'heavy_count', 0)
    desc.joint_count = c.n.setdefault(prefix + 'joint_count', 0)
    return desc


def _faces_desc(c: Call, prefix: str = '', *, corners: Optional[ArrayLike] = None, sizes: Optional[ArrayLike] = None,
        starts: Optional[ArrayLike] = None) -> Any:
    desc = c.struct(_raw.hf_faces_desc, {})
    desc.corners = c.view('corners', corners, 'u4', ('corner_count',))
    desc.sizes = c.view('sizes', sizes, 'u4', ('faces',))
    desc.starts = c.view('starts', starts, 'u4', ('faces + 1',) if sizes is None else ('faces',))
    return desc


def _surface_desc(c: Call, prefix: str = '', *, positions: Optional[ArrayLike] = None,
        triangles: Optional[ArrayLike] = None, weld: int = Weld.EXACT, faces: Any = None, weld_tolerance: float = 0.0,
        operator_kind: int = Operator.INTRINSIC_DELAUNAY, field_kind: int = FieldKind.HARMONIC,
        ordering: int = Ordering.NESTED_DISSECTION, thread_count: int = 0, vertex_limit: int = 0,
        triangle_limit: int = 0, memory_limit_mb: int = 0, work_limit_gflop: int = 0,
        progress: Optional[Progress] = None, saved_factor: Any = None, links: Any = None) -> Any:
    desc = c.struct(_raw.hf_surface_desc, {'weld': weld, 'weld_tolerance': weld_tolerance,
            'operator_kind': operator_kind, 'field_kind': field_kind, 'ordering': ordering,
            'thread_count': thread_count, 'vertex_limit': vertex_limit, 'triangle_limit': triangle_limit,
            'memory_limit_mb': memory_limit_mb, 'work_limit_gflop': work_limit_gflop})
    desc.positions = c.view('positions', positions, 'f4 f8', ('vertex_count', 3))
    desc.triangles = c.view('triangles', triangles, 'u4 u2', ('triangle_count', 3))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.faces = c.inner(faces, 'corners', _faces_desc, 'faces.')
    desc.saved_factor = c.inner(saved_factor, 'bytes', _factor_desc, 'saved_factor.')
    desc.links = c.inner(links, 'joints', _links_desc, 'links.')
    return desc


def _graph_desc(c: Call, prefix: str = '', *, edges: Optional[ArrayLike] = None, weights: Optional[ArrayLike] = None,
        masses: Optional[ArrayLike] = None, vertex_count: int = 0, allow_negative: bool = False,
        field_kind: int = FieldKind.HARMONIC, ordering: int = Ordering.NESTED_DISSECTION, thread_count: int = 0,
        vertex_limit: int = 0, edge_limit: int = 0, memory_limit_mb: int = 0, work_limit_gflop: int = 0,
        progress: Optional[Progress] = None, saved_factor: Any = None) -> Any:
    desc = c.struct(_raw.hf_graph_desc, {'vertex_count': vertex_count, 'allow_negative': allow_negative,
            'field_kind': field_kind, 'ordering': ordering, 'thread_count': thread_count, 'vertex_limit': vertex_limit,
            'edge_limit': edge_limit, 'memory_limit_mb': memory_limit_mb, 'work_limit_gflop': work_limit_gflop})
    if number(vertex_count, 'vertex_count'):
        c.n['vertex_count'] = vertex_count
    desc.edges = c.view('edges', edges, 'u4 u2', ('edge_count', 2))
    desc.weights = c.view('weights', weights, 'f4 f8', ('edge_count',))
    desc.masses = c.view('masses', masses, 'f4 f8', ('vertex_count',))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.saved_factor = c.inner(saved_factor, 'bytes', _factor_desc, 'saved_factor.')
    return desc


def _patch_desc(c: Call, prefix: str = '', *, removed_triangles: Optional[ArrayLike] = None,
        new_positions: Optional[ArrayLike] = None, new_triangles: Optional[ArrayLike] = None,
        cut_edges: Optional[ArrayLike] = None) -> Any:
    desc = c.struct(_raw.hf_patch_desc, {})
    desc.removed_triangles = c.array('removed_triangles', removed_triangles, 'u4', (prefix + 'removed_triangle_count',))
    desc.new_positions = c.array('new_positions', new_positions, 'f8', (prefix + 'new_vertex_count', 3))
    desc.new_triangles = c.array('new_triangles', new_triangles, 'u4', (prefix + 'new_triangle_count', 3))
    desc.cut_edges = c.array('cut_edges', cut_edges, 'u4', (prefix + 'cut_edge_count', 2))
    desc.removed_triangle_count = c.n.setdefault(prefix + 'removed_triangle_count', 0)
    desc.new_vertex_count = c.n.setdefault(prefix + 'new_vertex_count', 0)
    desc.new_triangle_count = c.n.setdefault(prefix + 'new_triangle_count', 0)
    desc.cut_edge_count = c.n.setdefault(prefix + 'cut_edge_count', 0)
    return desc


def _surface_edit_desc(c: Call, prefix: str = '', *, vertices: Optional[ArrayLike] = None,
        stiffness: Optional[ArrayLike] = None, links: Optional[ArrayLike] = None,
        removed_links: Optional[ArrayLike] = None, patch: Any = None, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_surface_edit_desc, {})
    desc.vertices = c.array('vertices', vertices, 'u4', (prefix + 'vertex_count',))
    desc.stiffness = c.array('stiffness', stiffness, 'f8', (prefix + 'vertex_count',))
    desc.links = c.written('links', links, _raw.hf_link, (prefix + 'link_count',))
    desc.removed_links = c.array('removed_links', removed_links, 'u4', (prefix + 'removed_link_count',))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.patch = c.inner(patch, 'removed_triangles', _patch_desc, 'patch.')
    desc.vertex_count = c.n.setdefault(prefix + 'vertex_count', 0)
    desc.link_count = c.n.setdefault(prefix + 'link_count', 0)
    desc.removed_link_count = c.n.setdefault(prefix + 'removed_link_count', 0)
    return desc


def _cut_desc(c: Call, prefix: str = '', *, vertices: Optional[ArrayLike] = None,
        places: Optional[Sequence[PlaceLike]] = None, points: Optional[ArrayLike] = None, snap_share: float = 0.0,
        crossing_limit: int = 0, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_cut_desc, {'snap_share': snap_share, 'crossing_limit': crossing_limit})
    desc.vertices = c.array('vertices', vertices, 'u4', (prefix + 'point_count',))
    desc.places = c.places('places', places, (prefix + 'point_count',))
    desc.points = c.array('points', points, 'f8', (prefix + 'point_count', 3))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.point_count = c.n.setdefault(prefix + 'point_count', 0)
    return desc


def _pick_desc(c: Call, prefix: str = '', *, positions: Optional[ArrayLike] = None, front_only: bool = False) -> Any:
    desc = c.struct(_raw.hf_pick_desc, {'front_only': front_only})
    desc.positions = c.view('positions', positions, 'f4 f8', ('vertex_count', 3))
    return desc


def _solver_desc(c: Call, prefix: str = '', *, field_kind: int = FieldKind.HARMONIC, channel_count: int = 0,
        site_limit: int = 0, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_solver_desc, {'field_kind': field_kind, 'channel_count': channel_count,
            'site_limit': site_limit})
    c.n['channel_count'] = number(channel_count, 'channel_count') or 1
    desc.progress = handle_of(progress, Progress, 'progress')
    return desc


def _sites_desc(c: Call, prefix: str = '', *, vertices: Optional[ArrayLike] = None, values: Optional[ArrayLike] = None,
        places: Optional[Sequence[PlaceLike]] = None, points: Optional[ArrayLike] = None,
        stiffness: Optional[ArrayLike] = None, radii: Optional[ArrayLike] = None) -> Any:
    desc = c.struct(_raw.hf_sites_desc, {})
    desc.vertices = c.array('vertices', vertices, 'u4', (prefix + 'site_count',))
    desc.places = c.places('places', places, (prefix + 'site_count',))
    desc.points = c.array('points', points, 'f8', (prefix + 'site_count', 3))
    desc.values = c.array('values', values, 'f8', (prefix + 'site_count', 'channel_count'))
    desc.stiffness = c.array('stiffness', stiffness, 'f8', (prefix + 'site_count',))
    desc.radii = c.array('radii', radii, 'f8', (prefix + 'site_count',))
    desc.site_count = c.n.setdefault(prefix + 'site_count', 1)
    return desc


def _edit_desc(c: Call, prefix: str = '', *, remove_sites: Optional[ArrayLike] = None,
        move_sites: Optional[ArrayLike] = None, set_sites: Optional[ArrayLike] = None,
        set_values: Optional[ArrayLike] = None, move_to: Any = None, add: Any = None) -> Any:
    desc = c.struct(_raw.hf_edit_desc, {})
    desc.remove_sites = c.array('remove_sites', remove_sites, 'u4', (prefix + 'remove_count',))
    desc.move_sites = c.array('move_sites', move_sites, 'u4', (prefix + 'move_count',))
    desc.set_sites = c.array('set_sites', set_sites, 'u4', (prefix + 'set_count',))
    desc.set_values = c.array('set_values', set_values, 'f8', (prefix + 'set_count', 'channel_count'))
    desc.move_to = c.inner(move_to, 'vertices', _sites_desc, 'move_to.')
    desc.add = c.inner(add, 'vertices', _sites_desc, 'add.')
    desc.remove_count = c.n.setdefault(prefix + 'remove_count', 0)
    desc.move_count = c.n.setdefault(prefix + 'move_count', 0)
    desc.set_count = c.n.setdefault(prefix + 'set_count', 0)
    return desc


def _geodesics_desc(c: Call, prefix: str = '', *, method: int = DistanceMethod.AUTO, smoothing: float = 0.0,
        progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_geodesics_desc, {'method': method, 'smoothing': smoothing})
    desc.progress = handle_of(progress, Progress, 'progress')
    return desc


def _extremities_desc(c: Call, prefix: str = '', *, kind: int = ExtremityKind.POISSON, least_length_share: float = 0.0,
        source_count: int = 0, geodesics: Optional[Geodesics] = None, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_extremities_desc, {'kind': kind, 'least_length_share': least_length_share,
            'source_count': source_count})
    c.n['source_count'] = number(source_count, 'source_count') or 40
    desc.geodesics = handle_of(geodesics, Geodesics, 'geodesics')
    desc.progress = handle_of(progress, Progress, 'progress')
    return desc


def _direction_desc(c: Call, prefix: str = '', *, degree: int = 0, site_limit: int = 0,
        progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_direction_desc, {'degree': degree, 'site_limit': site_limit})
    desc.progress = handle_of(progress, Progress, 'progress')
    return desc


def _pose_desc(c: Call, prefix: str = '', *, band_count: int = 0, iteration_count: int = 0,
        group_count: int = 0) -> Any:
    desc = c.struct(_raw.hf_pose_desc, {'band_count': band_count, 'iteration_count': iteration_count,
            'group_count': group_count})
    return desc


def _handles_desc(c: Call, prefix: str = '', *, region_vertices: Optional[Sequence[ArrayLike]] = None,
        vertices: Optional[ArrayLike] = None, places: Optional[Sequence[PlaceLike]] = None,
        points: Optional[ArrayLike] = None, radii: Optional[ArrayLike] = None, layer: int = 0, in_place: bool = False,
        free_rotation: bool = False, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_handles_desc, {'layer': layer, 'in_place': in_place, 'free_rotation': free_rotation})
    desc.region_counts, desc.region_vertices = c.lists('region_vertices', region_vertices, (prefix + 'handle_count',))
    desc.vertices = c.array('vertices', vertices, 'u4', (prefix + 'handle_count',))
    desc.places = c.places('places', places, (prefix + 'handle_count',))
    desc.points = c.array('points', points, 'f8', (prefix + 'handle_count', 3))
    desc.radii = c.array('radii', radii, 'f8', (prefix + 'handle_count',))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.handle_count = c.n.setdefault(prefix + 'handle_count', 1)
    return desc


def _deform_desc(c: Call, prefix: str = '', *, iteration_count: int = 0, restart: bool = False, refine: int = 0,
        refine_from_last: bool = False, first_vertex: int = 0, vertex_count: int = 0) -> Any:
    desc = c.struct(_raw.hf_deform_desc, {'iteration_count': iteration_count, 'restart': restart, 'refine': refine,
            'refine_from_last': refine_from_last, 'first_vertex': first_vertex, 'vertex_count': vertex_count})
    if number(vertex_count, 'vertex_count'):
        c.n['vertex_count'] = vertex_count
    return desc


def _handle_proposals_desc(c: Call, prefix: str = '', *, joints: Optional[ArrayLike] = None,
        parents: Optional[ArrayLike] = None, skeleton: Optional[Skeleton] = None, up: Optional[ArrayLike] = None,
        least_length_share: float = 0.0, limit: int = 0, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_handle_proposals_desc, {'least_length_share': least_length_share, 'limit': limit})
    desc.joints = c.array('joints', joints, 'f8', (prefix + 'joint_count', 3))
    desc.parents = c.array('parents', parents, 'u4', (prefix + 'joint_count',), sentinel=True)
    c.fixed(desc.up, 'up', up)
    desc.skeleton = handle_of(skeleton, Skeleton, 'skeleton')
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.joint_count = c.n.setdefault(prefix + 'joint_count', 0)
    return desc


def _quads_desc(c: Call, prefix: str = '', *, crease_edges: Optional[ArrayLike] = None,
        guide_vertices: Optional[ArrayLike] = None, guide_vectors: Optional[ArrayLike] = None,
        guide_weights: Optional[ArrayLike] = None, irregular_points: Optional[ArrayLike] = None,
        irregular_valences: Optional[ArrayLike] = None, irregular_directions: Optional[ArrayLike] = None,
        face_count: int = 0, edge_length: float = 0.0, crease_angle: float = 0.0, relax_count: int = 0,
        symmetry_plane: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_quads_desc, {'face_count': face_count, 'edge_length': edge_length,
            'crease_angle': crease_angle, 'relax_count': relax_count})
    desc.crease_edges = c.array('crease_edges', crease_edges, 'u4', (prefix + 'crease_count', 2))
    desc.guide_vertices = c.array('guide_vertices', guide_vertices, 'u4', (prefix + 'guide_count',))
    desc.guide_vectors = c.array('guide_vectors', guide_vectors, 'f8', (prefix + 'guide_count', 3))
    desc.guide_weights = c.array('guide_weights', guide_weights, 'f4', (prefix + 'guide_count',))
    desc.irregular_points = c.array('irregular_points', irregular_points, 'f8', (prefix + 'irregular_count', 3))
    desc.irregular_valences = c.array('irregular_valences', irregular_valences, 'u4', (prefix + 'irregular_count',))
    desc.irregular_directions = c.array('irregular_directions', irregular_directions, 'f8', (prefix + 'irregular_count',
            3))
    c.fixed(desc.symmetry_plane, 'symmetry_plane', symmetry_plane)
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.crease_count = c.n.setdefault(prefix + 'crease_count', 0)
    desc.guide_count = c.n.setdefault(prefix + 'guide_count', 0)
    desc.irregular_count = c.n.setdefault(prefix + 'irregular_count', 0)
    return desc


def _region_desc(c: Call, prefix: str = '', *, positions: Optional[ArrayLike] = None, base: int = Base.DEFAULT,
        progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_region_desc, {'base': base})
    desc.positions = c.view('positions', positions, 'f4 f8', ('vertex_count', 3))
    desc.progress = handle_of(progress, Progress, 'progress')
    return desc


def _curve_desc(c: Call, prefix: str = '', *, vertices: Optional[ArrayLike] = None,
        places: Optional[Sequence[PlaceLike]] = None, points: Optional[ArrayLike] = None, side: int = Side.SMALLER,
        seed_vertex: int = 0, kind: int = CurveKind.STRAIGHT) -> Any:
    desc = c.struct(_raw.hf_curve_desc, {'side': side, 'seed_vertex': seed_vertex, 'kind': kind})
    desc.vertices = c.array('vertices', vertices, 'u4', (prefix + 'point_count',))
    desc.places = c.places('places', places, (prefix + 'point_count',))
    desc.points = c.array('points', points, 'f8', (prefix + 'point_count', 3))
    desc.point_count = c.n.setdefault(prefix + 'point_count', 0)
    return desc


def _region_edit_desc(c: Call, prefix: str = '', *, remove_vertices: Optional[ArrayLike] = None,
        add_vertices: Optional[ArrayLike] = None, ring_count: int = 0, curve: Any = None,
        progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_region_edit_desc, {'ring_count': ring_count})
    desc.remove_vertices = c.array('remove_vertices', remove_vertices, 'u4', (prefix + 'remove_count',))
    desc.add_vertices = c.array('add_vertices', add_vertices, 'u4', (prefix + 'add_count',))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.curve = c.inner(curve, 'vertices', _curve_desc, 'curve.')
    desc.remove_count = c.n.setdefault(prefix + 'remove_count', 0)
    desc.add_count = c.n.setdefault(prefix + 'add_count', 0)
    return desc


def _morph_desc(c: Call, prefix: str = '', *, weight: float = 0.0) -> Any:
    desc = c.struct(_raw.hf_morph_desc, {'weight': weight})
    return desc


def _detail_desc(c: Call, prefix: str = '', *, source_vertices: Optional[ArrayLike] = None,
        target_vertices: Optional[ArrayLike] = None, scale: float = 0.0, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_detail_desc, {'scale': scale})
    desc.source_vertices = c.array('source_vertices', source_vertices, 'u4', (prefix + 'pair_count',))
    desc.target_vertices = c.array('target_vertices', target_vertices, 'u4', (prefix + 'pair_count',))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.pair_count = c.n.setdefault(prefix + 'pair_count', 0)
    return desc


def _retarget_desc(c: Call, prefix: str = '', *, source_rest: Optional[ArrayLike] = None,
        target_rest: Optional[ArrayLike] = None, root_motion: int = RootMotion.HIPS, leave_out: int = 0,
        scale: float = 0.0, ground_velocity: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_retarget_desc, {'root_motion': root_motion, 'leave_out': leave_out, 'scale': scale})
    desc.source_rest = c.array('source_rest', source_rest, 'f4', ('source.joint_count', 10))
    desc.target_rest = c.array('target_rest', target_rest, 'f4', ('target.joint_count', 10))
    c.fixed(desc.ground_velocity, 'ground_velocity', ground_velocity)
    desc.progress = handle_of(progress, Progress, 'progress')
    return desc


def _skin_desc(c: Call, prefix: str = '', *, positions: Optional[ArrayLike] = None,
        triangles: Optional[ArrayLike] = None, joints: Optional[ArrayLike] = None, weights: Optional[ArrayLike] = None,
        at_rest: bool = False) -> Any:
    desc = c.struct(_raw.hf_skin_desc, {'at_rest': at_rest})
    desc.positions = c.array('positions', positions, 'f4', (prefix + 'vertex_count', 3))
    desc.triangles = c.array('triangles', triangles, 'u4', (prefix + 'triangle_count', 3))
    desc.joints = c.array('joints', joints, 'u4', (prefix + 'vertex_count', prefix + 'influence_count'))
    desc.weights = c.array('weights', weights, 'f4', (prefix + 'vertex_count', prefix + 'influence_count'))
    desc.vertex_count = c.n.setdefault(prefix + 'vertex_count', 0)
    desc.triangle_count = c.n.setdefault(prefix + 'triangle_count', 0)
    desc.influence_count = c.n.setdefault(prefix + 'influence_count', 0)
    return desc


def _skeleton_desc(c: Call, prefix: str = '', *, names: Union[None, str, Sequence[str]] = None,
        parents: Optional[ArrayLike] = None, rest: Optional[ArrayLike] = None,
        inverse_binds: Optional[ArrayLike] = None, up: Optional[ArrayLike] = None, forward: Optional[ArrayLike] = None,
        roles: Optional[ArrayLike] = None, sides: Optional[ArrayLike] = None, travels: Optional[ArrayLike] = None,
        skin: Any = None, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_skeleton_desc, {})
    desc.parents = c.array('parents', parents, 'u4', (prefix + 'joint_count',), sentinel=True)
    desc.rest = c.array('rest', rest, 'f4', (prefix + 'joint_count', 10))
    desc.inverse_binds = c.array('inverse_binds', inverse_binds, 'f4', (prefix + 'joint_count', 16))
    desc.up = c.array('up', up, 'f4', (3,))
    desc.forward = c.array('forward', forward, 'f4', (3,))
    desc.roles = c.array('roles', roles, 'i4', (prefix + 'joint_count',))
    desc.sides = c.array('sides', sides, 'i4', (prefix + 'joint_count',))
    desc.travels = c.array('travels', travels, 'f4', (prefix + 'travel_count', 3))
    desc.names = c.text(names)
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.skin = c.inner(skin, 'positions', _skin_desc, 'skin.')
    desc.joint_count = c.n.setdefault(prefix + 'joint_count', 0)
    desc.travel_count = c.n.setdefault(prefix + 'travel_count', 0)
    return desc


def _transfer_desc(c: Call, prefix: str = '', *, source_rest: Optional[ArrayLike] = None,
        target_rest: Optional[ArrayLike] = None, mode: int = TransferMode.FIELDS, cluster_count: int = 0,
        ground: int = Ground.KEEP, kernel_width: float = 0.0, scale: float = 0.0, alignment_angle: float = 0.0,
        source_axes: Optional[ArrayLike] = None, target_axes: Optional[ArrayLike] = None) -> Any:
    desc = c.struct(_raw.hf_transfer_desc, {'mode': mode, 'cluster_count': cluster_count, 'ground': ground,
            'kernel_width': kernel_width, 'scale': scale, 'alignment_angle': alignment_angle})
    desc.source_rest = c.view('source_rest', source_rest, 'f4 f8', ('source.vertex_count', 3))
    desc.target_rest = c.view('target_rest', target_rest, 'f4 f8', ('target.vertex_count', 3))
    c.fixed(desc.source_axes, 'source_axes', source_axes)
    c.fixed(desc.target_axes, 'target_axes', target_axes)
    return desc


def _pairs_desc(c: Call, prefix: str = '', *, source_vertices: Optional[Sequence[ArrayLike]] = None,
        target_vertices: Optional[Sequence[ArrayLike]] = None, flags: Optional[ArrayLike] = None,
        progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_pairs_desc, {})
    desc.source_counts, desc.source_vertices = c.lists('source_vertices', source_vertices, (prefix + 'pair_count',))
    desc.target_counts, desc.target_vertices = c.lists('target_vertices', target_vertices, (prefix + 'pair_count',))
    desc.flags = c.array('flags', flags, 'u4', (prefix + 'pair_count',))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.pair_count = c.n.setdefault(prefix + 'pair_count', 1)
    return desc


def _transfer_dials(c: Call, prefix: str = '', *, stride: float = 0.0, hip_height_share: float = 0.0,
        neck_follow: float = 0.0, tail_follow: float = 0.0, arm_space: float = 0.0, long_follow: float = 0.0) -> Any:
    desc = c.struct(_raw.hf_transfer_dials, {'stride': stride, 'hip_height_share': hip_height_share,
            'neck_follow': neck_follow, 'tail_follow': tail_follow, 'arm_space': arm_space, 'long_follow': long_follow})
    return desc


def _transfer_frame(c: Call, prefix: str = '', *, source_positions: Optional[ArrayLike] = None,
        hold_pairs: Optional[ArrayLike] = None, hold_positions: Optional[ArrayLike] = None) -> Any:
    desc = c.struct(_raw.hf_transfer_frame, {})
    desc.source_positions = c.view('source_positions', source_positions, 'f4 f8', ('source.vertex_count', 3))
    desc.hold_pairs = c.array('hold_pairs', hold_pairs, 'u4', (prefix + 'hold_count',))
    desc.hold_positions = c.array('hold_positions', hold_positions, 'f8', (prefix + 'hold_count', 3))
    desc.hold_count = c.n.setdefault(prefix + 'hold_count', 0)
    return desc


def _joints_desc(c: Call, prefix: str = '', *, heads: Optional[ArrayLike] = None, tails: Optional[ArrayLike] = None,
        axes: Optional[ArrayLike] = None, parents: Optional[ArrayLike] = None, deforms: Optional[ArrayLike] = None,
        sources: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_joints_desc, {})
    desc.heads = c.array('heads', heads, 'f8', (prefix + 'joint_count', 3))
    desc.tails = c.array('tails', tails, 'f8', (prefix + 'joint_count', 3))
    desc.axes = c.array('axes', axes, 'f8', (prefix + 'joint_count', 3))
    desc.parents = c.array('parents', parents, 'u4', (prefix + 'joint_count',), sentinel=True)
    desc.deforms = c.array('deforms', deforms, 'i4', (prefix + 'joint_count',))
    desc.sources = c.array('sources', sources, 'u4', (prefix + 'joint_count',), sentinel=True)
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.joint_count = c.n.setdefault(prefix + 'joint_count', 0)
    return desc


def _pins_desc(c: Call, prefix: str = '', *, vertices: Optional[ArrayLike] = None,
        places: Optional[Sequence[PlaceLike]] = None, points: Optional[ArrayLike] = None,
        radii: Optional[ArrayLike] = None, joints: Optional[ArrayLike] = None, weights: Optional[ArrayLike] = None,
        progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_pins_desc, {})
    desc.vertices = c.array('vertices', vertices, 'u4', (prefix + 'pin_count',))
    desc.places = c.places('places', places, (prefix + 'pin_count',))
    desc.points = c.array('points', points, 'f8', (prefix + 'pin_count', 3))
    desc.radii = c.array('radii', radii, 'f8', (prefix + 'pin_count',))
    desc.joints = c.array('joints', joints, 'u4', (prefix + 'pin_count', prefix + 'influence_count'))
    desc.weights = c.array('weights', weights, 'f4', (prefix + 'pin_count', prefix + 'influence_count'))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.pin_count = c.n.setdefault(prefix + 'pin_count', 0)
    desc.influence_count = c.n.setdefault(prefix + 'influence_count', 0)
    return desc


def _weights_transfer_desc(c: Call, prefix: str = '', *, joints: Optional[ArrayLike] = None,
        weights: Optional[ArrayLike] = None, distance: float = 0.0, angle: float = 0.0, influence_count: int = 0,
        progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_weights_transfer_desc, {'distance': distance, 'angle': angle,
            'influence_count': influence_count})
    c.n['influence_count'] = number(influence_count, 'influence_count') or 4
    desc.joints = c.array('joints', joints, 'u4', ('source.vertex_count', prefix + 'source_influence_count'))
    desc.weights = c.array('weights', weights, 'f4', ('source.vertex_count', prefix + 'source_influence_count'))
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.source_influence_count = c.n.setdefault(prefix + 'source_influence_count', 0)
    return desc


def _weights_mirror_desc(c: Call, prefix: str = '', *, heads: Optional[ArrayLike] = None, names: Union[None, str,
        Sequence[str]] = None, partners: Optional[ArrayLike] = None, plane: Optional[ArrayLike] = None,
        joints: Optional[ArrayLike] = None, weights: Optional[ArrayLike] = None, to: int = MirrorTo.TO_NEGATIVE,
        distance: float = 0.0, angle: float = 0.0, influence_count: int = 0,
        progress: Optional[Progress] = None) -> Any:
    desc = c.struct(_raw.hf_weights_mirror_desc, {'to': to, 'distance': distance, 'angle': angle,
            'influence_count': influence_count})
    c.n['influence_count'] = number(influence_count, 'influence_count') or 4
    desc.heads = c.array('heads', heads, 'f8', (prefix + 'joint_count', 3))
    desc.partners = c.array('partners', partners, 'u4', (prefix + 'joint_count',), sentinel=True)
    desc.plane = c.array('plane', plane, 'f8', (6,))
    desc.joints = c.array('joints', joints, 'u4', ('vertex_count', prefix + 'source_influence_count'))
    desc.weights = c.array('weights', weights, 'f4', ('vertex_count', prefix + 'source_influence_count'))
    desc.names = c.text(names)
    desc.progress = handle_of(progress, Progress, 'progress')
    desc.joint_count = c.n.setdefault(prefix + 'joint_count', 0)
    desc.source_influence_count = c.n.setdefault(prefix + 'source_influence_count', 0)
    return desc


class Progress(Object):
    """Reports the progress of a long call. Any thread can poll the object and cancel the call through it. Use one object
    for one call at a time. If a cancel may come after the end of the call, make a new object for the next call.

    Creates a progress object.
    """

    _destroy = 'hf_progress_destroy'
    _counts = ()

    def __repr__(self) -> str:
        return told(self, ())

    def __init__(self) -> None:
        c = Call()
        self._own('hf_progress_create', c)

    @property
    def fraction(self) -> float:
        """Writes how much of the running call is done."""
        c = Call(self)
        fraction = ctypes.c_double()
        call('hf_progress_get_fraction', self._handle, ref(fraction))
        return fraction.value

    def cancel(self) -> None:
        """Stops the call that uses this object, or the next one that does. That call returns CancelledError."""
        c = Call(self)
        call('hf_progress_cancel', self._handle)


class Surface(Object):
    """hf/surface.h - prepare a mesh once: weld it, check it and factorise its Laplacian.

    Make one surface per mesh, or per graph of your own (Surface.from_graph). Solvers, poses, direction fields,
    regions, transfers and quads are made on a surface and share its factor. A surface never changes, so any number of
    threads may use it: an edit makes another one (Surface.edit). An object made on a surface keeps the data it needs,
    so you can destroy objects in any order.

    Makes a surface: welds and checks the mesh, builds the operator, orders and factorises it. The call copies the
    mesh. Afterwards the surface uses only the allocator and the job runner of the desc. The mesh may be dirty: the
    surface counts non-manifold edges, flipped, duplicate and zero-area triangles, isolated vertices and components.
    Surface.report gives these counts.

    A doubled face counts once: fields, poses, quads and all else are the same on the mesh without it. Faces are
    doubled if they have the same corners after welding, in either direction. So a two-sided sheet, such as a leaf,
    hair or a cape, is one sheet with a border. Results give the index of the first of doubled triangles; calls take
    the index of any. Vertices of the second side alone get opposite normals from poses, and a ray with front_only
    hits both sides.

    positions: (vertex_count, 3) of float or double, any unit, any offset
    triangles: (triangle_count, 3) of uint32_t or uint16_t, counter-clockwise seen from outside
    weld: Weld
    faces: faces instead of triangles
    weld_tolerance: for Weld.TOLERANCE, in the unit of the positions, > 0
    operator_kind: Operator
    field_kind: FieldKind: the factor made now. Others are made when a solver or region needs one
    ordering: Ordering
    thread_count: threads the library may use, yours included, 1 to 256; 0 = 1
    vertex_limit: refuse larger meshes before allocating; 0 = 20,000,000. More than 357,913,941 vertices, triangles or
        edges are always refused
    triangle_limit: refuse more triangles, or faces that would be cut into more; 0 = eight per vertex of the vertex
        limit
    memory_limit_mb: refuse to hold more memory than this, in MiB, surface and all on it; 0 = no limit
    work_limit_gflop: refuse a factorisation of more than this many 10^9 operations. They are counted before it
        begins; 0 = 100,000, about an hour of one core
    progress: an object to poll and cancel through
    saved_factor: the saved factor of this mesh; ordering is then 0 or the factor's
    links: None: LinkMode.NONE. A saved factor needs the links it was made with
    """

    _destroy = 'hf_surface_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count',), 'report')

    def __init__(self, positions: Optional[ArrayLike] = None, triangles: Optional[ArrayLike] = None, *,
            weld: int = Weld.EXACT, faces: Any = None, weld_tolerance: float = 0.0,
            operator_kind: int = Operator.INTRINSIC_DELAUNAY, field_kind: int = FieldKind.HARMONIC,
            ordering: int = Ordering.NESTED_DISSECTION, thread_count: int = 0, vertex_limit: int = 0,
            triangle_limit: int = 0, memory_limit_mb: int = 0, work_limit_gflop: int = 0,
            progress: Optional[Progress] = None, saved_factor: Any = None, links: Any = None) -> None:
        c = Call()
        desc = _surface_desc(c, positions=positions, triangles=triangles, weld=weld, faces=faces,
                weld_tolerance=weld_tolerance, operator_kind=operator_kind, field_kind=field_kind, ordering=ordering,
                thread_count=thread_count, vertex_limit=vertex_limit, triangle_limit=triangle_limit,
                memory_limit_mb=memory_limit_mb, work_limit_gflop=work_limit_gflop, progress=progress,
                saved_factor=saved_factor, links=links)
        self._own('hf_surface_create', c, ref(desc))

    @classmethod
    def from_graph(cls, edges: Optional[ArrayLike] = None, weights: Optional[ArrayLike] = None, *,
            masses: Optional[ArrayLike] = None, vertex_count: int = 0, allow_negative: bool = False,
            field_kind: int = FieldKind.HARMONIC, ordering: int = Ordering.NESTED_DISSECTION, thread_count: int = 0,
            vertex_limit: int = 0, edge_limit: int = 0, memory_limit_mb: int = 0, work_limit_gflop: int = 0,
            progress: Optional[Progress] = None, saved_factor: Any = None) -> "Surface":
        """Makes a surface of a graph, for fields on any domain whose edges and weights you compute. The call copies the
        graph. Solvers with sites at vertices, fields, previews, certificates, clones, saved factors, components and
        reports work as on a mesh. A call that needs triangles returns UnsupportedError. These are poses, regions,
        directions, geodesics, iso-lines, extremities, quads, flow, picking, transfers, skin weights, vector fields,
        links and screening. Sites at places, at points or on discs need triangles too.

        A vertex without an edge is isolated: fields are 0 there, and it takes no site. Weights that differ from the
        median of their component by a factor above 1e30 are limited; MeshStatistics counts their vertices as changed.
        Bi-harmonic fields limit weights to 1e3 times the median.

        edges: (edge_count, 2) of uint32_t or uint16_t: vertices, in any order. The weights of parallel edges are
            added up. Self loops are ignored
        weights: (edge_count,) of float or double, any unit, up to 1e100 in size. An edge of weight 0 is left out
        masses: (vertex_count,) of float or double: M of FieldKind.BIHARMONIC, any unit, above 0 and up to 1e100;
            None: all 1. A mass below 1e-4 of the mean of its component is raised to it
        vertex_count: >= 1, also without masses
        allow_negative: 1: weights may be below 0, if L stays positive semi-definite. The cotangent weights of
            tetrahedra do. A field can then leave the range of its sites. 0: they are refused
        field_kind: FieldKind: the factor made now. Others are made when a solver asks
        ordering: Ordering
        thread_count: threads the library may use, yours included, 1 to 256; 0 = 1
        vertex_limit: refuse larger graphs before allocating; 0 = 20,000,000
        edge_limit: refuse more edges; 0 = sixteen per vertex of the vertex limit
        memory_limit_mb: refuse to hold more memory than this, in MiB; 0 = no limit
        work_limit_gflop: refuse a factorisation of more than this many 10^9 operations; 0 = 100,000
        progress: an object to poll and cancel through
        saved_factor: the saved factor of this graph; ordering is then 0 or the factor's

        Raises CancelledError, EmptyError, InvalidArgumentError, NonFiniteError, NotPositiveDefiniteError,
        OutOfRangeError, TooLargeError, UnsupportedError.
        """
        c = Call()
        desc = _graph_desc(c, edges=edges, weights=weights, masses=masses, vertex_count=vertex_count,
                allow_negative=allow_negative, field_kind=field_kind, ordering=ordering, thread_count=thread_count,
                vertex_limit=vertex_limit, edge_limit=edge_limit, memory_limit_mb=memory_limit_mb,
                work_limit_gflop=work_limit_gflop, progress=progress, saved_factor=saved_factor)
        made = cls.__new__(cls)
        made._own('hf_surface_create_graph', c, ref(desc))
        return made

    @property
    def info(self) -> SurfaceInfo:
        """Writes the options of a surface."""
        c = Call(self)
        info = c.struct(_raw.hf_surface_info, {})
        call('hf_surface_get_info', self._handle, ref(info))
        return info

    @property
    def report(self) -> SurfaceReport:
        """Writes the report of the mesh."""
        c = Call(self)
        report = c.struct(_raw.hf_surface_report, {})
        call('hf_surface_get_report', self._handle, ref(report))
        return report

    @property
    def mesh_statistics(self) -> MeshStatistics:
        """Writes the statistics of the mesh."""
        c = Call(self)
        statistics = c.struct(_raw.hf_mesh_statistics, {})
        call('hf_surface_get_mesh_statistics', self._handle, ref(statistics))
        return statistics

    def components(self) -> np.ndarray[Any, Any]:
        """Writes the component of every vertex of your mesh, and NO_INDEX for isolated vertices. Components are numbered
        in the order of their lowest vertex numbers.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_surface_get_components', self._handle, room['capacity'], address(made['components']), ref(count))

        found = c.grow(self, 'hf_surface_get_components', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'components': (np.uint32, ('capacity',))})
        return found['components']

    @property
    def links_info(self) -> LinksInfo:
        """Writes how the pieces of a surface are linked."""
        c = Call(self)
        info = c.struct(_raw.hf_links_info, {})
        call('hf_surface_get_links_info', self._handle, ref(info))
        return info

    def links(self) -> np.ndarray[Any, Any]:
        """Writes the links of a surface. You can edit them and give them back with LinkMode.LIST. A list does not say
        which pieces are light: name them in light_vertices, as Surface.pieces marks them. Then the list alone gives
        the same surface, bit for bit, without a search.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_surface_get_links', self._handle, room['capacity'], address(made['links']), ref(count))

        found = c.grow(self, 'hf_surface_get_links', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'links': (np.dtype(_raw.hf_link), ('capacity',))})
        return found['links']

    def pieces(self) -> Tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """Writes the piece of every vertex of your mesh, and NO_INDEX for isolated vertices. Pieces are numbered in the
        order of their lowest vertices.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_surface_get_pieces', self._handle, room['capacity'], address(made['pieces']),
                    address(made['light']), ref(count))

        found = c.grow(self, 'hf_surface_get_pieces', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'pieces': (np.uint32, ('capacity',)), 'light': (np.int32, ('capacity',))})
        found['light'] = found['light'] != 0
        return found['pieces'], found['light']

    def measure_gaps(self, positions: ArrayLike, *, info: Optional[GapsInfo] = None) -> np.ndarray[Any, Any]:
        """Measures the gaps that a deformation opens between linked pieces. The gap of a link is how much farther its
        ends are apart than at rest, and 0 if they are nearer. The gap of a contact (LinksInfo) is measured in the
        same way. A vertex touches a piece if it is nearer to it than 0.5 % of the bounding box. With joint_parents
        its joint must be the joint of the nearest point there, or the parent or child of that joint. Each touches one
        point of the piece: the nearest at rest. Its opening is the smaller of two distances, minus the distance at
        rest: its own distance from the piece, and the distance of the point that it touched from the piece of the
        vertex. So a piece that slides along another opens no vertex, but its links have gaps. Touching vertices are
        found where links are: by Surface and Surface.relink. Links that an edit adds have none.

        positions: (vertex_count, 3) of float or double: the deformed mesh. It can come from a pose, a transfer or any
            other source.
        info: filled in when given

        Raises NonFiniteError, TooLargeError.
        """
        c = Call(self)
        positions_ = c.view('positions', positions, 'f4 f8', ('vertex_count', 3))
        info = info or c.struct(_raw.hf_gaps_info, {})

        def run(room: Any, made: Any) -> None:
            call('hf_surface_measure_gaps', self._handle, None if positions is None else ref(positions_),
                    room['capacity'], address(made['gaps']), ref(info, _raw.hf_gaps_info))

        found = c.grow(self, 'hf_surface_measure_gaps', run, lambda: {'capacity': info.link_count}, {'capacity': None},
                {'gaps': (np.float64, ('capacity',))})
        return found['gaps']

    def relink(self, joints: Optional[ArrayLike] = None, weights: Optional[ArrayLike] = None,
            joint_parents: Optional[ArrayLike] = None, tags: Optional[ArrayLike] = None,
            links: Optional[ArrayLike] = None, light_vertices: Optional[ArrayLike] = None,
            heavy_vertices: Optional[ArrayLike] = None, *, mode: int = LinkMode.NONE, distance: float = 0.0,
            stiffness: float = 0.0, overlay_distance: float = 0.0, progress: Optional[Progress] = None) -> "Surface":
        """Makes a surface with other links from the mesh of a surface. The new surface orders the unknowns as the old
        one where its matrix has the same pattern: other stiffness, weights or light pieces.

        joints: (vertex_count, influence_count) of a skin: pieces of the same joint link sooner
        weights: (vertex_count, influence_count) of sum 1; where all are 0, a vertex shares no joint
        joint_parents: (joint_count,) parent of each joint, NO_INDEX for a root; needs joints and weights. Pieces of
            parent and child link wherever they touch. Pieces of joints farther apart in the skeleton, such as two
            feet, link only if nothing else joins them
        tags: (vertex_count,): pieces with different tags do not link, as a rider and a horse. The first vertex of a
            piece counts
        links: (link_count,)
        light_vertices: (light_count,): their pieces are light
        heavy_vertices: (heavy_count,): their pieces are not, as one that gets a site or handle
        mode: LinkMode
        distance: longest automatic link, in the unit of the positions; 0 = 5 % of the bounding box diagonal
        stiffness: of all links, times each one's weight; 0 = 1
        overlay_distance: automatic: a piece is light if half of it is nearer than this to a larger one; 0 = 1.5 % of
            the diagonal, below 0: no piece is light unless light_vertices say so
        progress: an object to poll and cancel through.

        Raises CancelledError, EmptyError, InvalidArgumentError, NonFiniteError, NotPositiveDefiniteError,
        OutOfRangeError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        desc = _links_desc(c, joints=joints, weights=weights, joint_parents=joint_parents, tags=tags, links=links,
                light_vertices=light_vertices, heavy_vertices=heavy_vertices, mode=mode, distance=distance,
                stiffness=stiffness, overlay_distance=overlay_distance)
        made = type(self).__new__(type(self))
        c.n.update(self._n)
        made._own('hf_surface_relink', c, self._handle, ref(desc), handle_of(progress, Progress, 'progress'))
        return made

    def edit(self, vertices: Optional[ArrayLike] = None, stiffness: Optional[ArrayLike] = None,
            links: Optional[ArrayLike] = None, removed_links: Optional[ArrayLike] = None, *, patch: Any = None,
            progress: Optional[Progress] = None) -> "Surface":
        """Makes a surface with another stiffness, other links or other triangles from a surface, which stays as it is.
        The new surface shares the factor: an edit of up to a few thousand vertices costs the elimination paths of its
        rim, as sites do, and a link costs up to six paths. The library factorises again with the same ordering where
        that costs less, and for bi-harmonic fields. A surface that is edited back has the fields of the old one.

        Fields, poses and weights follow the stiffness. Where the stiffness is 100 or more, a pose changes lengths of
        edges by about half a percent in the mean. A part that must not bend at all is a rigid piece
        (Pose.set_rigid_pieces). Bi-harmonic operators square it, so they count at most 100 and at least 0.01. Lengths
        do not change, so regions, transfers, distances, directions and quads do not see stiffness.

        A link joins two pieces, and removing the last link between two pieces parts them: a sword that is taken up
        and dropped. The new surface is the one that Surface.relink makes of the same list of links.
        Surface.components gives the new components. Light pieces and contacts stay as they are.

        After a patch the surface is the one that Surface makes of the triangles without the removed ones and with the
        new ones, Weld.NONE for the new vertices. Vertices keep their stiffness. New ones, and those that were
        isolated, have 1. Distances, directions and quads make a factor of their own when they are first asked for, as
        on a new surface. Patches over a quarter of the surface, and with Operator.CLAMPED, make the whole operator
        and its factor anew. Take links out before, and put them in again after it.

        Solver.move_to takes sites along, and Pose.move_to takes handles along. After a patch or a cut make a new
        pose: Pose.move_to refuses other triangles. Soft sites keep the unit of their stiffness while links and
        triangles stay; others change it as they do for Surface.relink. Surface.save is refused: save the factor of
        the surface before its edits. Memory limits hold for both surfaces together.

        vertices: (vertex_count,) as given; other vertices keep their stiffness. None: all vertices in order
        stiffness: (vertex_count,) 1e-4 to 1e4; 1: as the surface was made. Welded copies share one. None: no
            stiffness changes, and vertex_count is 0
        links: (link_count,) links that come in, after those that stay
        removed_links: (removed_link_count,) links that go out, by their numbers in Surface.links
        patch: triangles that go and come, or a cut; the edit changes nothing else then
        progress: an object to poll and cancel through

        Raises CancelledError, ConflictError, EmptyError, InvalidArgumentError, NonFiniteError, NotFoundError,
        NotPositiveDefiniteError, OutOfRangeError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        desc = _surface_edit_desc(c, 'list_', vertices=vertices, stiffness=stiffness, links=links,
                removed_links=removed_links, patch=patch, progress=progress)
        made = type(self).__new__(type(self))
        c.n.update(self._n)
        made._own('hf_surface_edit', c, self._handle, ref(desc))
        made._n['vertex_count'] = made.info.vertex_count
        return made

    def cuts(self) -> np.ndarray[Any, Any]:
        """Writes the corners that all cuts gave other vertices since the surface was made, in the order of the cuts. A
        second cut adds its corners behind the corners of the first cut: go on from the last count.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_surface_get_cuts', self._handle, room['capacity'], address(made['cuts']), ref(count))

        found = c.grow(self, 'hf_surface_get_cuts', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'cuts': (np.dtype(_raw.hf_cut_corner), ('capacity',))})
        return found['cuts']

    def stiffness(self) -> np.ndarray[Any, Any]:
        """Writes the stiffness of every vertex of your mesh, and 1 for isolated vertices."""
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_surface_get_stiffness', self._handle, room['capacity'], address(made['stiffness']), ref(count))

        found = c.grow(self, 'hf_surface_get_stiffness', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'stiffness': (np.float64, ('capacity',))})
        return found['stiffness']

    @property
    def statistics(self) -> SurfaceStatistics:
        """Writes the statistics of a surface and of the factor it was made with."""
        c = Call(self)
        statistics = c.struct(_raw.hf_surface_statistics, {})
        call('hf_surface_get_statistics', self._handle, ref(statistics))
        return statistics

    def save(self, field_kind: int = FieldKind.HARMONIC, *, progress: Optional[Progress] = None) -> bytes:
        """Saves the factor of one kind of field. An authoring tool saves it once. A game ships the bytes beside the mesh
        and gives them to Surface, which then takes a fraction of the time. The bytes are the same for the same mesh,
        options and library version, whatever the number of threads. The bytes are little-endian and hold a format
        version, a hash of the matrix and a checksum. They hold no sites.

        field_kind: FieldKind. If its factor does not exist yet, the call makes it first.
        progress: an object to poll and cancel through.

        Raises CancelledError, TooSmallError.
        """
        c = Call(self)
        size = ctypes.c_size_t()
        call('hf_surface_save', self._handle, number(field_kind, 'field_kind', ctypes.c_int32, flag=False),
                handle_of(progress, Progress, 'progress'), 0, None, ref(size))
        block = np.empty(size.value, np.uint8)
        call('hf_surface_save', self._handle, number(field_kind, 'field_kind', ctypes.c_int32, flag=False),
                handle_of(progress, Progress, 'progress'), block.size, address(block), ref(size))
        return block.tobytes()

    def trace_cut(self, vertices: Optional[ArrayLike] = None, places: Optional[Sequence[PlaceLike]] = None,
            points: Optional[ArrayLike] = None, *, snap_share: float = 0.0, crossing_limit: int = 0,
            progress: Optional[Progress] = None) -> Cut:
        """Turns a line on the surface into a cut through triangles. Give the arrays to Surface.edit as a patch, and
        change your mesh in the same way. The surface itself does not change.

        A line from border to border, or a closed line around a part, parts it from the rest. A line that starts at
        the border opens it. An end inside the surface stays closed. The line may pass vertices and run along edges.
        It is straight where its triangles are unfolded, and bends at its points and at vertices only. The parts of a
        triangle are a Delaunay triangulation of it. Points are whole multiples of 2^-29 of an edge. On a mesh whose
        triangles are turned alike, left is left for a viewer who looks at the outside along the line. New vertices
        have the stiffness 1.

        vertices: (point_count,) vertices of your mesh, or None
        places: (point_count,), or None
        points: (point_count, 3) points in space, at rest, in the unit and frame of the mesh, or None. Each stands for
            the nearest point of the surface, up to two boxes away
        snap_share: a point nearer to a vertex than this share of its edge becomes the vertex, and one nearer to an
            edge than this share of the height moves onto the edge. So no slivers come in. From 1e-6 to 0.4; 0 = 0.05
        crossing_limit: refuse a line of more points and crossings of edges; 0 = 1,000,000
        progress: an object to poll and cancel through

        Raises CancelledError, ConflictError, EmptyError, InvalidArgumentError, NonFiniteError, NotFoundError,
        OutOfRangeError, TooLargeError, TooSmallError, UnsupportedError.
        """
        c = Call(self)
        desc = _cut_desc(c, vertices=vertices, places=places, points=points, snap_share=snap_share,
                crossing_limit=crossing_limit, progress=progress)
        cut = c.struct(_raw.hf_cut, {})

        def run(room: Any, made: Any) -> None:
            c.into(cut, room, made)
            call('hf_surface_trace_cut', self._handle, ref(desc), ref(cut))

        found = c.grow(self, 'hf_surface_trace_cut', run,
                lambda: {'removed_triangle_capacity': cut.removed_triangle_count,
                'new_vertex_capacity': cut.new_vertex_count, 'new_triangle_capacity': cut.new_triangle_count,
                'rim_capacity': cut.rim_count}, {'removed_triangle_capacity': None, 'new_vertex_capacity': None,
                'new_triangle_capacity': None, 'rim_capacity': None}, {'removed_triangles': (np.uint32,
                ('removed_triangle_capacity',)), 'new_positions': (np.float64, ('new_vertex_capacity', 3)),
                'new_triangles': (np.uint32, ('new_triangle_capacity', 3)), 'vertex_corners': (np.uint32,
                ('new_vertex_capacity', 3)), 'vertex_barycentrics': (np.float64, ('new_vertex_capacity', 3)),
                'source_triangles': (np.uint32, ('new_triangle_capacity',)), 'corner_barycentrics': (np.float64,
                ('new_triangle_capacity', 3, 3)), 'rim_vertices': (np.uint32, ('rim_capacity', 2))})
        return Cut(**found)

    def cast_ray(self, origin: ArrayLike, direction: ArrayLike, positions: Optional[ArrayLike] = None, *,
            front_only: bool = False) -> Optional[Hit]:
        """Finds what a mouse click hits: the first triangle on a ray.

        origin: (3,) in the frame of the positions. The direction can have any length above 0.
        direction: (3,) in the frame of the positions. The direction can have any length above 0.
        positions: (vertex_count, 3) of float or double: posed positions (Pose.deform writes them). None: the rest
            positions
        front_only: 1: a ray passes through triangles seen from behind

        Raises InvalidArgumentError, NonFiniteError.
        """
        c = Call(self)
        origin_ = c.array('origin', origin, 'f8', (3,))
        direction_ = c.array('direction', direction, 'f8', (3,))
        desc = _pick_desc(c, positions=positions, front_only=front_only)
        hit = c.struct(_raw.hf_hit, {})
        call('hf_surface_cast_ray', self._handle, origin_, direction_, ref(desc), ref(hit))
        return hit if hit.found else None

    def find_vertex(self, point: ArrayLike, positions: Optional[ArrayLike] = None, *,
            front_only: bool = False) -> Tuple[int, float]:
        """Finds the vertex nearest to a point.

        point: (3,) in the frame of the positions.
        positions: (vertex_count, 3) of float or double: posed positions (Pose.deform writes them). None: the rest
            positions
        front_only: 1: a ray passes through triangles seen from behind

        Raises NonFiniteError, TooLargeError.
        """
        c = Call(self)
        point_ = c.array('point', point, 'f8', (3,))
        desc = _pick_desc(c, positions=positions, front_only=front_only)
        vertex = ctypes.c_uint32()
        distance = ctypes.c_double()
        call('hf_surface_find_vertex', self._handle, point_, ref(desc), ref(vertex), ref(distance))
        return vertex.value, distance.value

    def space_levels(self, field: ArrayLike, level_count: int, spacing: int = Levels.VALUE) -> np.ndarray[Any, Any]:
        """Writes levels, ascending. Levels.AREA makes all strips equal in area. Levels.LENGTH makes the mean widths of
        the strips equal. So iso-lines around point sites are evenly spaced, where equal steps of the value would
        crowd them. Levels.LENGTH leaves out the parts where the field is flat to 1e-9 of its range.

        In formulas, A(c) is the area where the field is below c, and L(c) is the length of the iso-line of level c.
        Both are exact for the piecewise linear field. Levels.AREA takes equal steps of A. Levels.LENGTH takes equal
        steps of the integral of A'(c) / L(c) dc. That integral is the height on a cylinder and the distance from the
        pole on a sphere.

        field: (vertex_count,) of float or double.
        spacing: Levels.
        level_count: 1 to 1,000,000.

        Raises EmptyError, InvalidArgumentError, NonFiniteError.
        """
        c = Call(self)
        field_ = c.view('field', field, 'f4 f8', ('vertex_count',))
        if number(level_count, 'level_count'):
            c.n['level_count'] = level_count
        levels = c.out(None, 'f8', ('level_count',), packed=True)
        call('hf_surface_space_levels', self._handle, None if field is None else ref(field_), number(spacing, 'spacing',
                ctypes.c_int32, flag=False), number(level_count, 'level_count', ctypes.c_uint32), address(levels))
        return levels

    def trace_isolines(self, field: ArrayLike, levels: ArrayLike) -> Isolines:
        """Traces the iso-lines of levels. The levels must be finite and can have any order; the lines come in the order
        of the levels. A vertex whose value equals a level counts as just above it, so lines have no gaps. A line
        either closes or ends. It ends at a border or at a triangle without values. At an edge of three or more
        triangles (non-manifold), these are taken in pairs. A line continues inside a pair, and ends at a triangle
        without a partner. The function leaves out lines of length zero. Seen from outside a consistently oriented
        mesh, the field is higher on the left of a line.

        field: (vertex_count,) of float or double.
        levels: (level_count,).

        Raises NonFiniteError, TooLargeError.
        """
        c = Call(self)
        field_ = c.view('field', field, 'f4 f8', ('vertex_count',))
        levels_ = c.array('levels', levels, 'f8', ('level_count',))
        lines = c.struct(_raw.hf_isolines, {})

        def run(room: Any, made: Any) -> None:
            c.into(lines, room, made)
            call('hf_surface_trace_isolines', self._handle, None if field is None else ref(field_),
                    c.n.setdefault('level_count', 1), levels_, ref(lines))

        found = c.grow(self, 'hf_surface_trace_isolines', run, lambda: {'point_capacity': lines.point_count,
                'line_capacity': lines.line_count}, {'point_capacity': None, 'line_capacity': None},
                {'point_edges': (np.uint32, ('point_capacity', 2)), 'parameters': (np.float64, ('point_capacity',)),
                'positions': (np.float64, ('point_capacity', 3)), 'line_starts': (np.uint32, ('line_capacity + 1',)),
                'line_levels': (np.uint32, ('line_capacity',)), 'line_closed': (np.int32, ('line_capacity',))})
        return Isolines(line_closed=found.pop('line_closed') != 0, **found)

    def find_critical_points(self, field: ArrayLike, *, info: Optional[CriticalInfo] = None) -> np.ndarray[Any, Any]:
        """Lists the minima, maxima and saddles of the piecewise linear field. The signs of the field around each vertex
        decide (Banchoff 1970). Take its neighbours with lower values and the edges between them. The index of the
        vertex is 1 minus their Euler characteristic. The vertex number breaks ties, so a flat area has critical
        points too. The indices sum to the Euler characteristic on every component. On a mesh that is not Delaunay a
        harmonic field can show an extremum away from its sites, because the default operator uses other edges than
        the mesh. Operator.CLAMPED uses the edges of the mesh and avoids this.

        field: (vertex_count,) of float or double.
        info: filled in when given

        Raises NonFiniteError.
        """
        c = Call(self)
        field_ = c.view('field', field, 'f4 f8', ('vertex_count',))
        info = info or c.struct(_raw.hf_critical_info, {})

        def run(room: Any, made: Any) -> None:
            call('hf_surface_find_critical_points', self._handle, None if field is None else ref(field_),
                    room['capacity'], address(made['points']), ref(info, _raw.hf_critical_info))

        found = c.grow(self, 'hf_surface_find_critical_points', run, lambda: {'capacity': info.point_count},
                {'capacity': None}, {'points': (np.dtype(_raw.hf_critical_point), ('capacity',))})
        return found['points']

    def find_extremities(self, *, kind: int = ExtremityKind.POISSON, least_length_share: float = 0.0,
            source_count: int = 0, geodesics: Optional[Geodesics] = None, progress: Optional[Progress] = None,
            field: Optional[np.ndarray[Any, Any]] = None) -> np.ndarray[Any, Any]:
        """Proposes the tips of the surface as places for sites and handles, the longest tip first. The list does not
        depend on the order of the vertices. Pose and meshing change it only within the resolution of the mesh.

        kind: ExtremityKind
        least_length_share: tips that protrude less are left out: share of the box diagonal; 0 = 0.05; up to 10
        source_count: sources of the mean distance per component, 1 to 1,000; 0 = 40
        geodesics: for ExtremityKind.GEODESIC: an object of this surface. If its method is DistanceMethod.HEAT its
            factor serves; else, and for None, the call makes a factor
        progress: an object to poll and cancel through
        field: (vertex_count,), packed: the field whose peaks are proposed, 0 at isolated vertices. Unit: length^2
            (Poisson), length (geodesic), each up to a constant per component

        Raises CancelledError, InvalidArgumentError.
        """
        c = Call(self)
        desc = _extremities_desc(c, kind=kind, least_length_share=least_length_share, source_count=source_count,
                geodesics=geodesics, progress=progress)
        if field is not None:
            field = c.out(field, 'f8', ('vertex_count',), name='field', packed=True)
            desc.out_field = address(field)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_surface_find_extremities', self._handle, ref(desc), room['capacity'], address(made['extremities']),
                    ref(count))

        found = c.grow(self, 'hf_surface_find_extremities', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'extremities': (np.dtype(_raw.hf_extremity), ('capacity',))})
        return found['extremities']

    def propose_handles(self, joints: Optional[ArrayLike] = None, parents: Optional[ArrayLike] = None, *,
            skeleton: Optional[Skeleton] = None, up: Optional[ArrayLike] = None, least_length_share: float = 0.0,
            limit: int = 0, progress: Optional[Progress] = None, regions: Optional[np.ndarray[Any,
            Any]] = None) -> np.ndarray[Any, Any]:
        """Proposes handles for the first drag of a mesh: feet and the trunk hold, tips are dragged. Pinned proposals
        come first, then the others, each group by length, the longest first. The places do not depend on the order of
        the vertices. They follow translation and scale. A skeleton gives each proposal the joint that moves it, a
        role and a side. If its roles are known, feet and the trunk are pinned. Hands, heads, tails and pieces that
        hang on them, such as a sword, are not. Each head, hand, foot, tail, ear and wing gets at most one proposal. A
        part that no joint of the skin moves, such as the box that an animator drags, gets none.

        joints: (joint_count, 3) their places at rest, in the unit and frame of the mesh
        parents: (joint_count,) position of each joint's parent in the list; NO_INDEX for a root
        skeleton: the skeleton of the mesh, instead of joints and parents. It rests in the unit and frame of the mesh.
            If it has a skin, the skin has the vertices of the mesh
        up: direction away from the ground, of any length; zero = up of the skeleton where it is known, else the y
            axis
        least_length_share: as in hf_extremities_desc; 0 = 0.05
        limit: most proposals, 1 to HF_HANDLE_LIMIT; 0 = 32
        progress: an object to poll and cancel through
        regions: (vertex_count,): position in the list of the proposal whose region has the vertex; NO_INDEX for a
            vertex of no region

        Raises CancelledError, InvalidArgumentError, NonFiniteError, OutOfRangeError.
        """
        c = Call(self)
        desc = _handle_proposals_desc(c, joints=joints, parents=parents, skeleton=skeleton, up=up,
                least_length_share=least_length_share, limit=limit, progress=progress)
        if regions is not None:
            regions = c.out(regions, 'u4', ('vertex_count',), name='regions', packed=True)
            desc.out_regions = address(regions)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_surface_propose_handles', self._handle, ref(desc), room['capacity'], address(made['proposals']),
                    ref(count))

        found = c.grow(self, 'hf_surface_propose_handles', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'proposals': (np.dtype(_raw.hf_handle_proposal), ('capacity',))})
        return found['proposals']


class Solver(Recorded):
    """A set of sites on a surface, and their field.

    Creates a solver without sites.

    field_kind: FieldKind; if the surface has no factor of that kind yet, it is made now
    channel_count: fields solved at once, 1 to 64; 0 = 1
    site_limit: at most this many sites; 0 = 100,000
    progress: an object to poll and cancel through
    """

    _destroy = 'hf_solver_destroy'
    _counts = ('channel_count', 'vertex_count')

    @property
    def channel_count(self) -> int:
        """As it was made with."""
        return self._n.get('channel_count', 0)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('channel_count', 'vertex_count', 'site_count'))

    def __init__(self, surface: Surface, *, field_kind: int = FieldKind.HARMONIC, channel_count: int = 0,
            site_limit: int = 0, progress: Optional[Progress] = None) -> None:
        c = Call(surface=surface)
        desc = _solver_desc(c, field_kind=field_kind, channel_count=channel_count, site_limit=site_limit,
                progress=progress)
        self._own('hf_create', c, handle_of(surface, Surface, 'surface'), ref(desc))

    def clone(self) -> "Solver":
        """Creates a solver with the same sites under the same numbers; its fields have the same bits. Both share the
        factor and the solved sites, so a copy costs its list of sites only. Use one copy per thread or per set of
        sites. For undo, keep copies: one before each edit.
        """
        c = Call(self)
        made = type(self).__new__(type(self))
        c.n.update(self._n)
        made._own('hf_solver_clone', c, self._handle)
        return made

    def move_to(self, surface: Surface) -> None:
        """Moves a solver to an edited surface. Its sites keep their numbers, values and screening.

        surface: any number of calls of Surface.edit or Surface.relink make it from the solver's surface, or the
            solver's surface from it.

        Raises CancelledError, ConflictError, UnsupportedError.
        """
        c = Call(self, surface=surface)
        call('hf_solver_move_to', self._handle, handle_of(surface, Surface, 'surface'))
        self._n['vertex_count'] = surface._n['vertex_count']

    @property
    def info(self) -> SolverInfo:
        """Writes the options of a solver."""
        c = Call(self)
        info = c.struct(_raw.hf_solver_info, {})
        call('hf_solver_get_info', self._handle, ref(info))
        return info

    def add_sites(self, vertices: Optional[ArrayLike] = None, values: Optional[ArrayLike] = None, *,
            places: Optional[Sequence[PlaceLike]] = None, points: Optional[ArrayLike] = None,
            stiffness: Optional[ArrayLike] = None, radii: Optional[ArrayLike] = None) -> np.ndarray[Any, Any]:
        """Adds sites.

        vertices: (site_count,) vertices of your mesh, or None
        values: (site_count, channel_count), up to 1e200 in size; None = 0
        places: (site_count,), or None
        points: (site_count, 3) points in space, at rest, in the unit and frame of the mesh, or None. Each stands for
            the nearest point of the surface, up to two boxes away
        stiffness: (site_count,) >= 0, relative to the mean diagonal of K; 0 = hard (exact); None = all hard; clamped
            to 1e-12 to 1e12
        radii: (site_count,) >= 0, geodesic, in the unit of the mesh; 0 = a point; None = all points

        Raises ConflictError, DuplicateError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError,
        UnsupportedError.
        """
        c = Call(self)
        desc = _sites_desc(c, vertices=vertices, values=values, places=places, points=points, stiffness=stiffness,
                radii=radii)
        sites = c.out(None, 'u4', ('site_count',), packed=True)
        call('hf_add_sites', self._handle, ref(desc), address(sites))
        return sites

    def add_site(self, vertex: int, values: Optional[ArrayLike] = None) -> int:
        """Adds one hard site at a vertex.

        values: (channel_count,), or None for 0.

        Raises ConflictError, DuplicateError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError,
        UnsupportedError.
        """
        c = Call(self)
        values_ = c.array('values', values, 'f8', ('channel_count',))
        site = ctypes.c_uint32()
        call('hf_solver_add_site', self._handle, number(vertex, 'vertex', ctypes.c_uint32), values_, ref(site))
        return site.value

    def remove_sites(self, sites: ArrayLike) -> None:
        """Removes sites by number. The field is 0 on a component that has no site left. If you add a site there again,
        the field is exact.

        sites: (site_count,).

        Raises NotFoundError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        call('hf_remove_sites', self._handle, c.n.setdefault('site_count', 1), sites_)

    def move_sites(self, sites: ArrayLike, vertices: Optional[ArrayLike] = None, values: Optional[ArrayLike] = None, *,
            places: Optional[Sequence[PlaceLike]] = None, points: Optional[ArrayLike] = None,
            stiffness: Optional[ArrayLike] = None, radii: Optional[ArrayLike] = None) -> None:
        """Moves sites to new places. Each site keeps its number, value, stiffness and radius.

        sites: (site_count,).
        vertices: (site_count,) vertices of your mesh, or None
        values: (site_count, channel_count), up to 1e200 in size; None = 0
        places: (site_count,), or None
        points: (site_count, 3) points in space, at rest, in the unit and frame of the mesh, or None. Each stands for
            the nearest point of the surface, up to two boxes away
        stiffness: (site_count,) >= 0, relative to the mean diagonal of K; 0 = hard (exact); None = all hard; clamped
            to 1e-12 to 1e12
        radii: (site_count,) >= 0, geodesic, in the unit of the mesh; 0 = a point; None = all points

        Raises ConflictError, DuplicateError, InvalidArgumentError, NonFiniteError, NotFoundError, OutOfRangeError,
        TooLargeError, UnsupportedError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        desc = _sites_desc(c, vertices=vertices, values=values, places=places, points=points, stiffness=stiffness,
                radii=radii)
        call('hf_solver_move_sites', self._handle, c.n.setdefault('site_count', 1), sites_, ref(desc))

    def set_values(self, sites: ArrayLike, values: ArrayLike) -> None:
        """Gives sites new values. The call costs nothing until the next solve.

        sites: (site_count,).
        values: (site_count, channel_count).

        Raises NonFiniteError, NotFoundError, TooLargeError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        values_ = c.array('values', values, 'f8', ('site_count', 'channel_count'))
        call('hf_solver_set_values', self._handle, c.n.setdefault('site_count', 1), sites_, values_)

    def edit_sites(self, remove_sites: Optional[ArrayLike] = None, move_sites: Optional[ArrayLike] = None,
            set_sites: Optional[ArrayLike] = None, set_values: Optional[ArrayLike] = None, *, move_to: Any = None,
            add: Any = None) -> np.ndarray[Any, Any]:
        """Applies a batch of edits at once.

        remove_sites: (remove_count,)
        move_sites: (move_count,)
        set_sites: (set_count,)
        set_values: (set_count, channel_count)
        move_to: places of (move_count,) sites
        add: the sites to add
        """
        c = Call(self)
        desc = _edit_desc(c, remove_sites=remove_sites, move_sites=move_sites, set_sites=set_sites,
                set_values=set_values, move_to=move_to, add=add)
        sites = c.out(None, 'u4', ('add.site_count',), packed=True)
        call('hf_solver_edit_sites', self._handle, ref(desc), address(sites))
        return sites

    @property
    def site_count(self) -> int:
        """Returns the number of sites, or 0 for an invalid object."""
        return library().hf_solver_get_site_count(self._handle)

    def sites(self) -> SitesInfo:
        """Writes all sites."""
        c = Call(self)
        info = c.struct(_raw.hf_sites_info, {})

        def run(room: Any, made: Any) -> None:
            c.into(info, room, made)
            call('hf_solver_get_sites', self._handle, ref(info))

        found = c.grow(self, 'hf_solver_get_sites', run, lambda: {'capacity': info.count}, {'capacity': None},
                {'sites': (np.uint32, ('capacity',)), 'vertices': (np.uint32, ('capacity',)), 'components': (np.uint32,
                ('capacity',)), 'values': (np.float64, ('capacity', 'channel_count')), 'stiffness': (np.float64,
                ('capacity',)), 'flux': (np.float64, ('capacity', 'channel_count')), 'radii': (np.float64,
                ('capacity',))})
        return SitesInfo(**found)

    def set_screening(self, screening: Optional[ArrayLike] = None, targets: Optional[ArrayLike] = None) -> None:
        """Screens the field: (K + A H) u = A H p + W lambda, with A the vertex areas. The field follows p where H is
        large, and the influence of a site fades over a distance of about 1 / sqrt(H). A H is at most 1e12 times the
        mean diagonal of K. Such a field needs no site on a component where some H is above 0.

        screening: (vertex_count,) H >= 0, in 1 / length^2 with the unit of the mesh; None removes the screening.
        targets: (vertex_count, channel_count) p, or None for 0. Both are copied. The values of the first of welded
            copies hold for all of them. Sites stay. A site with a radius holds the rim of its disc only. Undo
            restores the screening with the sites.

        Raises InvalidArgumentError, NonFiniteError, NotPositiveDefiniteError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        screening_ = c.array('screening', screening, 'f8', ('vertex_count',))
        targets_ = c.array('targets', targets, 'f8', ('vertex_count', 'channel_count'))
        call('hf_solver_set_screening', self._handle, screening_, targets_)

    def solve(self, out: Optional[np.ndarray[Any, Any]] = None, *, dtype: Any = np.float32,
            info: Optional[SolveInfo] = None) -> np.ndarray[Any, Any]:
        """Solves for the field at every vertex of your mesh, in single or double precision. Hard sites hold their values
        exactly. The field is 0 on components without a site.

        out: (vertex_count, channel_count) of float or double.
        info: filled in when given

        Raises EmptyError, TooLargeError.
        """
        c = Call(self)
        out = c.out(out, 'f4 f8', ('vertex_count', 'channel_count'), dtype)
        out_view = c.view_out(out, ('vertex_count', 'channel_count'))
        call('hf_solver_solve', self._handle, ref(out_view), ref(info, _raw.hf_solve_info))
        return out

    def solve_at(self, vertices: ArrayLike) -> np.ndarray[Any, Any]:
        """Solves for the field at chosen vertices only, with the same bits as Solver.solve in double. The call reads
        only those columns of the factor on which these vertices depend (elimination paths), on the calling thread.
        One path is up to a sixth of the factor, but the paths of many vertices share most of their columns. The call
        costs a whole solve for bi-harmonic fields, and whenever sites are eliminated in the factor (see
        Solver.prepare_rebase). A vertex of a component without a site gets 0.

        vertices: (vertex_count,).

        Raises EmptyError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        c.n.pop('vertex_count', None)  # of the list given here
        vertices_ = c.array('vertices', vertices, 'u4', ('vertex_count',))
        values = c.out(None, 'f8', ('vertex_count', 'channel_count'), packed=True)
        call('hf_solver_solve_at', self._handle, c.n.setdefault('vertex_count', 1), vertices_, address(values))
        return values

    def solve_vectors(self, out: Optional[np.ndarray[Any, Any]] = None, *, dtype: Any = np.float32,
            normals: Optional[np.ndarray[Any, Any]] = None, info: Optional[SolveInfo] = None) -> np.ndarray[Any, Any]:
        """Solves for a tangent vector field, with a solver of 3 channels (Xu, Zhang, Cohen-Or and Xiong 2009, Section
        3.3). The channels are the x, y and z of the constraint vectors, and the call solves each as a field. It then
        projects the vector v of each vertex on the tangent plane: v - (n . v) n. Here n is the area-weighted normal.

        out: (vertex_count, 3) of float or double, not normalised.
        normals: (vertex_count, 3), packed: the normals used.
        info: filled in when given

        Raises EmptyError, InvalidArgumentError, TooLargeError.
        """
        c = Call(self)
        out = c.out(out, 'f4 f8', ('vertex_count', 3), dtype)
        out_view = c.view_out(out, ('vertex_count', 3))
        if normals is not None:
            normals = c.out(normals, 'f8', ('vertex_count', 3), name='normals', packed=True)
        call('hf_solver_solve_vectors', self._handle, ref(out_view), address(normals), ref(info, _raw.hf_solve_info))
        return out

    def solve_preview(self, correction_count: int = 0, out: Optional[np.ndarray[Any, Any]] = None, *,
            dtype: Any = np.float32, info: Optional[PreviewInfo] = None) -> np.ndarray[Any, Any]:
        """Solves with a single-precision copy of the factor. This reads half the bytes of Solver.solve; use it while the
        user drags a value or a site. The error is about 1e-6 of the value range for harmonic fields. Bi-harmonic
        fields, long shapes and crowded sites can have an error of any size: ask for corrections there and read
        error_estimate. Hard sites at vertices are exact. One correction (iterative refinement, Wilkinson 1963)
        reduces the error of a harmonic field below 1e-9, a second one below 1e-12. Each correction costs as much as
        two to three calls of Solver.solve.

        The first call makes the single-precision copy, which costs about two solves. All solvers of that field kind
        on the surface share the copy. It is freed with the last of these solvers, or by Solver.release_preview. A
        solver whose factor eliminates sites gives the exact field. info.exact is then 1.

        correction_count: 0 to 8.
        out: (vertex_count, channel_count) of float or double, as Solver.solve. Single precision rounds most
            corrections away.
        info: filled in when given

        Raises EmptyError, InvalidArgumentError.
        """
        c = Call(self)
        out = c.out(out, 'f4 f8', ('vertex_count', 'channel_count'), dtype)
        out_view = c.view_out(out, ('vertex_count', 'channel_count'))
        call('hf_solver_solve_preview', self._handle, ref(out_view), number(correction_count, 'correction_count',
                ctypes.c_uint32), ref(info, _raw.hf_preview_info))
        return out

    def release_preview(self) -> None:
        """Frees the single-precision copy for all solvers that share it, as soon as no running call uses it. The next
        preview makes the copy again.
        """
        c = Call(self)
        call('hf_solver_release_preview', self._handle)

    def move_vectors(self, sites: ArrayLike, vertices: ArrayLike) -> None:
        """Moves vector sites to other vertices of their components. Each vector is carried along the shortest path of
        edges, from vertex normal to vertex normal (parallel transport; Xu and others 2009, Section 3.3).

        sites: (site_count,).
        vertices: (site_count,).

        Raises ConflictError, DuplicateError, InvalidArgumentError, NotFoundError, OutOfRangeError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        vertices_ = c.array('vertices', vertices, 'u4', ('site_count',))
        call('hf_solver_move_vectors', self._handle, c.n.setdefault('site_count', 1), sites_, vertices_)

    def rotate_vectors(self, sites: ArrayLike, angles: ArrayLike) -> None:
        """Turns the vector of site i about its vertex normal, counter-clockwise by angles(i,) radians. Does not
        factorise.

        sites: (site_count,).
        angles: (site_count,).

        Raises InvalidArgumentError, NonFiniteError, NotFoundError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        angles_ = c.array('angles', angles, 'f8', ('site_count',))
        call('hf_solver_rotate_vectors', self._handle, c.n.setdefault('site_count', 1), sites_, angles_)

    def certify(self, tolerance: float = 0.0) -> Certificate:
        """Solves the field and checks it against its equations. The check uses only the operator K and the site values.
        So it finds a damaged factor, borrowed bytes that changed, or a fault of the machine. The call returns
        InaccurateError (index = worst vertex) if the check fails, and writes certificate then too. Do not use fields
        of that solver; make the surface again.

        tolerance: largest error to accept, > 0; 0 = 1e-8

        Raises EmptyError, InaccurateError, InvalidArgumentError.
        """
        c = Call(self)
        certificate = c.struct(_raw.hf_certificate, {'tolerance': tolerance})
        call('hf_solver_certify', self._handle, ref(certificate))
        return certificate

    def prepare_rebase(self) -> None:
        """Factorises in the background with the hard vertex sites eliminated, so that they cost no dense solve. It runs
        on the calling thread, while other threads edit and solve with this solver. The next edit switches to the new
        factor. Fields before and after are the same up to rounding. Call it on a thread of yours when
        SolverStatistics.rebase_advised is 1. An edit of very many sites does this by itself when that is quicker.
        Memory: one more factor, for as long as it eliminates sites.

        Raises BusyError, EmptyError.
        """
        c = Call(self)
        call('hf_solver_prepare_rebase', self._handle)

    @property
    def statistics(self) -> SolverStatistics:
        """Writes the statistics."""
        c = Call(self)
        statistics = c.struct(_raw.hf_solver_statistics, {})
        call('hf_solver_get_statistics', self._handle, ref(statistics))
        return statistics


class Geodesics(Object):
    """Computes geodesic distances on one surface: the lengths of shortest paths along it.

    Creates the object and the tables of its method. FRONT and EXACT take a pass over the triangles. HEAT takes one
    numeric factorisation and holds a factor of its own beside the surface's.

    method: DistanceMethod
    smoothing: of HEAT: m of the time step m h^2, h the mean edge length; larger is smoother. From 0.1 to 10,000; 0 =
        1
    progress: an object to poll and cancel through: creation and every later call report to it
    """

    _destroy = 'hf_geodesics_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count',))

    def __init__(self, surface: Surface, *, method: int = DistanceMethod.AUTO, smoothing: float = 0.0,
            progress: Optional[Progress] = None) -> None:
        c = Call(surface=surface)
        desc = _geodesics_desc(c, method=method, smoothing=smoothing, progress=progress)
        self._own('hf_geodesics_create', c, handle_of(surface, Surface, 'surface'), ref(desc))

    def solve(self, sources: ArrayLike, out: Optional[np.ndarray[Any, Any]] = None, *,
            dtype: Any = np.float32) -> np.ndarray[Any, Any]:
        """Writes the distance along the surface from every vertex to the nearest source, in the unit of the mesh. The
        distance is 0 at the sources, and -1 at vertices that no source can reach.

        sources: (source_count,) vertices of your mesh; repeats are allowed. Paths follow the triangles and ignore
            links. Triangles with the same corners count once: a two-sided sheet measures as a single one. No distance
            of EXACT and FRONT is below the straight line to the nearest source. EXACT is right up to rounding. The
            error of FRONT falls with the edge length. HEAT rounds the distance off at corners and where two shortest
            paths meet.
        out: (vertex_count,) of float or double.

        Raises CancelledError, InvalidArgumentError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        sources_ = c.array('sources', sources, 'u4', ('source_count',))
        out = c.out(out, 'f4 f8', ('vertex_count',), dtype)
        out_view = c.view_out(out, ('vertex_count',))
        call('hf_geodesics_solve', self._handle, c.n.setdefault('source_count', 1), sources_, ref(out_view))
        return out

    def find_path(self, from_: PlaceLike, to: PlaceLike) -> Path:
        """Finds the shortest path between two points, exact up to rounding, whatever the method of the object. If
        several are as short, it writes one of them. The path is straight where its triangles are unfolded; it bends
        at vertices only.

        Raises CancelledError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError, TooSmallError.
        """
        c = Call(self)
        path = c.struct(_raw.hf_path, {})

        def run(room: Any, made: Any) -> None:
            c.into(path, room, made)
            call('hf_geodesics_find_path', self._handle, ref(place(from_, 'from')), ref(place(to, 'to')), ref(path))

        found = c.grow(self, 'hf_geodesics_find_path', run, lambda: {'point_capacity': path.point_count},
                {'point_capacity': None}, {'point_edges': (np.uint32, ('point_capacity', 2)), 'parameters': (np.float64,
                ('point_capacity',)), 'positions': (np.float64, ('point_capacity', 3))})
        return Path(length=path.length, **found)

    def map(self, centre: PlaceLike, radius: float = 0.0) -> Tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """Lays the surface around a point out in a plane (logarithmic map): for decals, brushes and textures. A vertex
        lies at the length of its shortest path from the point, in the direction in which the path starts.

        radius: vertices farther away get NaN too and take no time; 0 = no bound.

        Raises CancelledError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError, TooSmallError.
        """
        c = Call(self)
        map = c.out(None, 'f8', ('vertex_count', 2), packed=True)
        frame = c.out(None, 'f8', (6,), packed=True)
        call('hf_geodesics_get_map', self._handle, ref(place(centre, 'centre')), number(radius, 'radius',
                ctypes.c_double), address(map), address(frame))
        return map, frame


class Direction(Recorded):
    """A direction field on a surface, with a factor and constraints of its own.

    Makes a direction field without constraints. It computes the connection between tangent planes and the operator,
    and factorises once, with two unknowns per vertex.

    degree: 1 vectors, 2 lines, 4 crosses. A turn by 360 / degree changes nothing. 0 = 1
    site_limit: most constraints; 0 = 100,000
    progress: an object to poll and cancel through
    """

    _destroy = 'hf_direction_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count', 'site_count'))

    def __init__(self, surface: Surface, *, degree: int = 0, site_limit: int = 0,
            progress: Optional[Progress] = None) -> None:
        c = Call(surface=surface)
        desc = _direction_desc(c, degree=degree, site_limit=site_limit, progress=progress)
        self._own('hf_direction_create', c, handle_of(surface, Surface, 'surface'), ref(desc))

    def clone(self) -> "Direction":
        """Makes a direction field with the same constraints under the same numbers; it has the same bits. Both share
        connection and factor, so the copy costs the constraints only. For undo, keep copies: one before each edit.
        """
        c = Call(self)
        made = type(self).__new__(type(self))
        c.n.update(self._n)
        made._own('hf_direction_clone', c, self._handle)
        return made

    def add_sites(self, vertices: ArrayLike, vectors: ArrayLike) -> np.ndarray[Any, Any]:
        """Adds constraints: vectors at vertices. The function projects the vectors on the tangent planes. Each
        constraint costs two sparse triangular solves (elimination paths) and two rows of a small dense system. For a
        batch of very many constraints, the function factorises once instead, with their vertices eliminated. Later
        edits cost paths and rows again.

        vertices: (site_count,) vertices of your mesh.
        vectors: (site_count, 3); a zero vector makes the field 0 there.

        Raises DuplicateError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        vertices_ = c.array('vertices', vertices, 'u4', ('site_count',))
        vectors_ = c.array('vectors', vectors, 'f8', ('site_count', 3))
        sites = c.out(None, 'u4', ('site_count',), packed=True)
        call('hf_direction_add_sites', self._handle, c.n.setdefault('site_count', 1), vertices_, vectors_,
                address(sites))
        return sites

    def remove_sites(self, sites: ArrayLike) -> None:
        """Removes constraints by number.

        sites: (site_count,).

        Raises NotFoundError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        call('hf_direction_remove_sites', self._handle, c.n.setdefault('site_count', 1), sites_)

    def move_sites(self, sites: ArrayLike, vertices: ArrayLike) -> None:
        """Moves constraints to other vertices of the same component. The connection transports each vector along the
        shortest path of edges, from tangent plane to tangent plane.

        sites: (site_count,).
        vertices: (site_count,).

        Raises ConflictError, DuplicateError, InvalidArgumentError, NotFoundError, OutOfRangeError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        vertices_ = c.array('vertices', vertices, 'u4', ('site_count',))
        call('hf_direction_move_sites', self._handle, c.n.setdefault('site_count', 1), sites_, vertices_)

    def set_vectors(self, sites: ArrayLike, vectors: ArrayLike) -> None:
        """Gives constraints new vectors and projects them on the tangent planes. Does not factorise.

        sites: (site_count,).
        vectors: (site_count, 3).

        Raises InvalidArgumentError, NonFiniteError, NotFoundError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        vectors_ = c.array('vectors', vectors, 'f8', ('site_count', 3))
        call('hf_direction_set_vectors', self._handle, c.n.setdefault('site_count', 1), sites_, vectors_)

    def rotate_sites(self, sites: ArrayLike, angles: ArrayLike) -> None:
        """Turns constraint i by angles(i,) radians, counter-clockwise seen from outside. Does not factorise.

        sites: (site_count,).
        angles: (site_count,).

        Raises NonFiniteError, NotFoundError.
        """
        c = Call(self)
        sites_ = c.array('sites', sites, 'u4', ('site_count',))
        angles_ = c.array('angles', angles, 'f8', ('site_count',))
        call('hf_direction_rotate_sites', self._handle, c.n.setdefault('site_count', 1), sites_, angles_)

    @property
    def site_count(self) -> int:
        """Returns the number of constraints, or 0 for an invalid object."""
        return library().hf_direction_get_site_count(self._handle)

    def sites(self) -> Tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """Writes the constraints. Their numbers ascend."""
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_direction_get_sites', self._handle, room['capacity'], address(made['sites']),
                    address(made['vertices']), address(made['vectors']), ref(count))

        found = c.grow(self, 'hf_direction_get_sites', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'sites': (np.uint32, ('capacity',)), 'vertices': (np.uint32, ('capacity',)), 'vectors': (np.float64,
                ('capacity', 3))})
        return found['sites'], found['vertices'], found['vectors']

    def solve(self, out: Optional[np.ndarray[Any, Any]] = None, *, dtype: Any = np.float32,
            info: Optional[SolveInfo] = None) -> np.ndarray[Any, Any]:
        """Writes the field as vectors in space. The vectors are tangent to the surface up to 1e-12 of their length. For
        degree 2 or 4 the function writes one of the 2 or 4 directions. Constrained vertices hold their vectors;
        vertices that no constraint reaches get 0.

        out: (vertex_count, 3) of float or double.
        info: filled in when given

        Raises EmptyError.
        """
        c = Call(self)
        out = c.out(out, 'f4 f8', ('vertex_count', 3), dtype)
        out_view = c.view_out(out, ('vertex_count', 3))
        call('hf_direction_solve', self._handle, ref(out_view), ref(info, _raw.hf_solve_info))
        return out

    def singularities(self) -> np.ndarray[Any, Any]:
        """Lists the singularities of the field, ordered by triangle (Crane, Desbrun and Schroeder 2010, Section 5). On a
        closed manifold component of one orientation the indices sum to degree times the Euler characteristic.

        Raises EmptyError.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_direction_get_singularities', self._handle, room['capacity'], address(made['singularities']),
                    ref(count))

        found = c.grow(self, 'hf_direction_get_singularities', run, lambda: {'capacity': count.value},
                {'capacity': None}, {'singularities': (np.dtype(_raw.hf_singularity), ('capacity',))})
        return found['singularities']

    @property
    def statistics(self) -> DirectionStatistics:
        """Writes the statistics."""
        c = Call(self)
        statistics = c.struct(_raw.hf_direction_statistics, {})
        call('hf_direction_get_statistics', self._handle, ref(statistics))
        return statistics


class Pose(Recorded):
    """A set of handles on a surface.

    Creates a pose without handles.

    band_count: bands per field, 2 to 64; 0 = 10
    iteration_count: iterations of a pose solve, 1 to 1000; 0 = 10
    group_count: groups of vertices that share a rotation, 1 to 2000; 0 = 250
    """

    _destroy = 'hf_pose_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count', 'handle_count'))

    def __init__(self, surface: Surface, *, band_count: int = 0, iteration_count: int = 0,
            group_count: int = 0) -> None:
        c = Call(surface=surface)
        desc = _pose_desc(c, band_count=band_count, iteration_count=iteration_count, group_count=group_count)
        self._own('hf_pose_create', c, handle_of(surface, Surface, 'surface'), ref(desc))

    def clone(self) -> "Pose":
        """Copies a pose with its handles and transforms, so that several threads can pose one rig."""
        c = Call(self)
        made = type(self).__new__(type(self))
        c.n.update(self._n)
        made._own('hf_pose_clone', c, self._handle)
        return made

    def move_to(self, surface: Surface) -> None:
        """Moves a pose to an edited surface: its handles keep their numbers, layers, transforms and options. The next
        Pose.deform goes on from the pose as it stands, with the new stiffness and links. So a faint stroke moves next
        to nothing, also where handles of free rotation could rest in two poses. With restart the frame equals the
        frame of a new pose on `surface`, to 1e-6 of the box.

        surface: any number of calls of Surface.edit or Surface.relink make it from the pose's surface, or the pose's
            surface from it.

        Raises ConflictError, UnsupportedError.
        """
        c = Call(self, surface=surface)
        call('hf_pose_move_to', self._handle, handle_of(surface, Surface, 'surface'))
        self._n['vertex_count'] = surface._n['vertex_count']

    @property
    def info(self) -> PoseInfo:
        """Writes the options of a pose."""
        c = Call(self)
        info = c.struct(_raw.hf_pose_info, {})
        call('hf_pose_get_info', self._handle, ref(info))
        return info

    def add_handles(self, region_vertices: Optional[Sequence[ArrayLike]] = None, *,
            vertices: Optional[ArrayLike] = None, places: Optional[Sequence[PlaceLike]] = None,
            points: Optional[ArrayLike] = None, radii: Optional[ArrayLike] = None, layer: int = 0,
            in_place: bool = False, free_rotation: bool = False, progress: Optional[Progress] = None) -> np.ndarray[Any,
            Any]:
        """Adds handles with identity transforms. On layer 0 the identity is the rest place, so a new handle pulls a
        posed surface back to rest there. Use in_place to grab a posed surface. Each new handle then gets the rigid
        motion of its region in the last pose (Pose.handle writes it). The surface stays in place (to 1e-6 of the
        box). It goes over to the best pose of the new handles while handles move by 0.05 of the box, or back to rest.
        Until then the region of the new handle keeps a part of its bend. restart ends this at once. On a higher layer
        the surface does not move (to 1e-9 of the box) until you move the handle. Handles of lower layers hold the
        surface in place for the higher layers.

        region_vertices: lists of whole numbers: all regions one after the other; None: places are given
        vertices: (handle_count,) vertices of your mesh, or None
        places: (handle_count,), or None
        points: (handle_count, 3) points in space, at rest, in the unit and frame of the mesh, or None. A point can
            lie inside the body, as a joint does: its nearest vertex counts
        radii: (handle_count,) of the regions of places, in the unit of the mesh; None: regions are given. A radius
            below 1 % of the box makes regions of 2 vertices or more
        layer: 0 to HF_LAYER_COUNT - 1, for the whole batch
        in_place: 1: handles of layer 0 start on the posed surface, not at rest; see below
        free_rotation: 1: you give the places alone of all these handles; Pose.set_free_rotations frees single ones
        progress: an object to poll and cancel through

        Raises ConflictError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        desc = _handles_desc(c, region_vertices=region_vertices, vertices=vertices, places=places, points=points,
                radii=radii, layer=layer, in_place=in_place, free_rotation=free_rotation, progress=progress)
        handles = c.out(None, 'u4', ('handle_count',), packed=True)
        call('hf_pose_add_handles', self._handle, ref(desc), address(handles))
        return handles

    def add_handle_at(self, point: ArrayLike, radius: float) -> int:
        """Adds one handle on layer 0. Its region has the vertex nearest to a point at rest. It also has all vertices
        within `radius` of the point that are edge-connected to this vertex.

        point: (3,).

        Raises ConflictError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        point_ = c.array('point', point, 'f8', (3,))
        handle = ctypes.c_uint32()
        call('hf_pose_add_handle_at', self._handle, point_, number(radius, 'radius', ctypes.c_double), ref(handle))
        return handle.value

    def remove_handles(self, handles: ArrayLike) -> None:
        """Removes handles by number. A handle on a higher layer takes its edit with it: the surface is then, bit for
        bit, as if the handle had never been added. On layer 0 this holds when you remove the handles that were added
        last, and for frames with `restart`.

        handles: (handle_count,).

        Raises NotFoundError.
        """
        c = Call(self)
        handles_ = c.array('handles', handles, 'u4', ('handle_count',))
        call('hf_pose_remove_handles', self._handle, c.n.setdefault('handle_count', 1), handles_)

    def set_transforms(self, handles: ArrayLike, rotations: Optional[ArrayLike] = None,
            translations: Optional[ArrayLike] = None) -> None:
        """Places handles. On layer 0 a transform is a motion from the rest place. On a higher layer it is an edit in the
        rest frame of the handle. There the region moves by F (edit) F^-1, with F the rigid motion that the lower
        layers give the handle. Rotations continue from call to call, so a handle that you dragged past 180 degrees
        stays turned that far. The transforms take effect at the next Pose.deform.

        handles: (handle_count,).
        rotations: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
        translations: up to 1e15 box diagonals

        Raises NonFiniteError, NotFoundError.
        """
        c = Call(self)
        handles_ = c.array('handles', handles, 'u4', ('handle_count',))
        transforms = c.records(_raw.hf_transform, ('handle_count',), {'rotation': ('rotations', rotations),
                'translation': ('translations', translations)})
        call('hf_pose_set_transforms', self._handle, c.n.setdefault('handle_count', 1), handles_, transforms)

    def set_transform(self, handle: int, rotation: Optional[ArrayLike] = None,
            translation: Optional[ArrayLike] = None) -> None:
        """Places one handle.

        rotation: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
        translation: up to 1e15 box diagonals

        Raises NonFiniteError, NotFoundError.
        """
        c = Call(self)
        transform = _raw.hf_transform()
        c.fixed(transform.rotation, 'rotation', rotation)
        c.fixed(transform.translation, 'translation', translation)
        call('hf_pose_set_transform', self._handle, number(handle, 'handle', ctypes.c_uint32), ref(transform))

    def set_free_rotations(self, handles: ArrayLike, free_rotation: bool = False) -> None:
        """Frees the rotations of handles, or lets you give them again. A handle of free rotation is a positional
        constraint (Sorkine and Alexa 2007). Its centroid lands exactly where its transform puts it; the rotation of
        the transform is ignored. Each Pose.deform finds the rotation together with the pose, and Pose.handle writes
        it. The rotation has the least as-rigid-as-possible energy. The energy of a pulled group of vertices is
        measured from a longer and thinner shape than the rest shape of the group. So the rotation is not exactly the
        rotation of least energy from the rest shape.

        Free the rotation while the user drags a handle: the wrist then follows the hand. Give the rotation while the
        user turns a ring. A given rotation starts at the present rotation of the handle, so the pose does not change.
        When you free a rotation on layer 0, the surface stays as it is. It releases the old rotation as handles move,
        as with in_place; so move the handles after this call. On a higher layer a changed handle moves the surface at
        the next frame. A handle alone in its component keeps its rotation. The first frame of a pose, and a frame
        with restart, move free handles to their places in 8 steps, as a drag does. Such a frame takes the time of
        about 8 pose solves. refine keeps the rotation of the smooth pose.

        handles: (handle_count,).
        free_rotation: 1: the solve finds the rotations; 0: you give them.

        Raises InvalidArgumentError, NotFoundError.
        """
        c = Call(self)
        handles_ = c.array('handles', handles, 'u4', ('handle_count',))
        call('hf_pose_set_free_rotations', self._handle, c.n.setdefault('handle_count', 1), handles_,
                number(free_rotation, 'free_rotation', ctypes.c_int32))

    def set_following(self, handles: ArrayLike, following: float = 0.0) -> None:
        """Sets how much of the surface follows handles of layer 0. Below 1, soft pins hold the surface where it would be
        without these handles. So a body does not lean after a dragged hand. Where the field of the handle is near 1,
        the pins are weak, so the limb stays free. Keep 1 for the handles that hold the body, and set less for a
        handle that is dragged. Every handle still lands exactly, and a limb that is too short gets longer. The next
        Pose.deform shows a change at once. But a handle that was just added in place leaves the surface where it
        stands until a handle moves. Full-mesh steps (refine) ignore the pins. Repeated steps (refine_from_last) let
        the body lean again.

        handles: (handle_count,).
        following: 0 to 1. At 1 all of the surface follows the handle; a new handle has 1. At 0 only the limb of the
            handle follows, such as an arm.

        Raises InvalidArgumentError, NonFiniteError, NotFoundError, UnsupportedError.
        """
        c = Call(self)
        handles_ = c.array('handles', handles, 'u4', ('handle_count',))
        call('hf_pose_set_following', self._handle, c.n.setdefault('handle_count', 1), handles_, number(following,
                'following', ctypes.c_double))

    def set_limb_refine(self, handles: ArrayLike, refine: int = 0) -> None:
        """Keeps the lengths of edges on the limbs of handles of layer 0, such as an arm whose hand is pulled. The limb
        is the part of the surface where the field of the handle falls a long way over little area. It ends at the
        trunk, or at the next handle on the limb. The steps move the limb alone. All other vertices keep their bits,
        so the body leans no more than without the steps. A limb that is pulled beyond its length is stretched evenly.
        The limbs take their steps after the steps of hf_deform_desc.refine. If handles have different counts of
        steps, all their limbs take the largest count.

        handles: (handle_count,).
        refine: 0 to 64 steps of as-rigid-as-possible on the limb in every frame; 0 = none, as in a new handle. With
            1, bends stay smooth. With 8 and more, most edges keep their lengths to a few per cent, and the limb bends
            like two bones. Edges beside the handle can change more.

        Raises InvalidArgumentError, NotFoundError, UnsupportedError.
        """
        c = Call(self)
        handles_ = c.array('handles', handles, 'u4', ('handle_count',))
        call('hf_pose_set_limb_refine', self._handle, c.n.setdefault('handle_count', 1), handles_, number(refine,
                'refine', ctypes.c_int32))

    def set_rigid_pieces(self, vertices: ArrayLike) -> None:
        """Names the rigid pieces of the mesh, such as a sword. A piece is an edge-connected part of the mesh. Each frame
        moves a rigid piece by the rigid motion that fits the piece best, also after refine. Vertices near links count
        most in this fit. If the region of a handle touches a rigid piece, the whole piece joins the region and moves
        with the handle. A second handle on the same piece is refused (ConflictError). Call this function before you
        add such handles. Pose.skin writes the motions before this fit.

        vertices: (vertex_count,), one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The
            list replaces the previous list.

        Raises ConflictError, InvalidArgumentError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        c.n.pop('vertex_count', None)  # of the list given here
        vertices_ = c.array('vertices', vertices, 'u4', ('vertex_count',))
        call('hf_pose_set_rigid_pieces', self._handle, c.n.setdefault('vertex_count', 1), vertices_)

    def set_matrices(self, handles: ArrayLike, matrices: ArrayLike) -> None:
        """Places handles by 4 x 4 matrices M.

        handles: (handle_count,).
        matrices: (handle_count, 16), column by column. The last column is the translation. M moves a rest position p
            to the posed position M p. Its linear part must be a rotation within 1e-4; the function takes the nearest
            rotation. Its last row must be 0 0 0 1.

        Raises InvalidArgumentError, NonFiniteError, NotFoundError.
        """
        c = Call(self)
        handles_ = c.array('handles', handles, 'u4', ('handle_count',))
        matrices_ = c.array('matrices', matrices, 'f8', ('handle_count', 16))
        call('hf_pose_set_matrices', self._handle, c.n.setdefault('handle_count', 1), handles_, matrices_)

    def handle(self, handle: int) -> HandleInfo:
        """Writes the info of a handle.

        Raises NotFoundError.
        """
        c = Call(self)
        info = c.struct(_raw.hf_handle_info, {})
        call('hf_pose_get_handle', self._handle, number(handle, 'handle', ctypes.c_uint32), ref(info))
        return info

    @property
    def handle_count(self) -> int:
        """Returns the number of handles, or 0 for an invalid object."""
        return library().hf_pose_get_handle_count(self._handle)

    def field(self, handle: int, out: Optional[np.ndarray[Any, Any]] = None, *,
            dtype: Any = np.float32) -> np.ndarray[Any, Any]:
        """Writes the field of a handle, which says how much each vertex follows the handle. At a vertex that a handle
        reaches, the fields of all handles sum to 1.

        out: (vertex_count,) of float or double.

        Raises NotFoundError.
        """
        c = Call(self)
        out = c.out(out, 'f4 f8', ('vertex_count',), dtype)
        out_view = c.view_out(out, ('vertex_count',))
        call('hf_pose_get_field', self._handle, number(handle, 'handle', ctypes.c_uint32), ref(out_view))
        return out

    def deform(self, out: Optional[np.ndarray[Any, Any]] = None, *, iteration_count: int = 0, restart: bool = False,
            refine: int = 0, refine_from_last: bool = False, first_vertex: int = 0, vertex_count: int = 0,
            dtype: Any = np.float32, normals: Optional[np.ndarray[Any, Any]] = None,
            info: Optional[DeformInfo] = None) -> np.ndarray[Any, Any]:
        """Does the same as Pose.deform, with the options of a desc.

        iteration_count: 1 to 1000; 0 = the pose's
        restart: 1: forget the last pose and start from the fields. The frame then has the bits of a fresh pose with
            the same handles, added in the same order, and the same transforms. Without restart a frame continues from
            the last one, so it also depends on that
        refine: 0 to 64: steps of as-rigid-as-possible on the whole surface, with the same factor. A step takes about
            0.2 us per vertex. 0 and 1 keep bends smooth. 8 and more keep the lengths of edges; bends get sharper
        refine_from_last: 1: the steps go on from the surface of the last call, instead of starting at the smooth
            pose. Then one step a frame keeps lengths in a drag as well as 8 do without. If the handles do not move,
            more calls converge to the minimum. A restart, or a call without it, forgets that surface. Needs a refine
            of 1 or more. Higher layers start at the smooth pose. Memory: 72 bytes per vertex
        first_vertex: outputs hold vertex_count vertices from this one on; 0 and 0: all
        vertex_count: positions of a range cost only the range; but with higher layers, rigid pieces, refine,
            limb_refine or normals they cost the whole surface
        out: (vertex_count, 3) of float or double: posed positions
        normals: (vertex_count, 3) of float or double: unit normals of the posed surface, shared across seams
        info: filled in when given

        Raises EmptyError, InvalidArgumentError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        desc = _deform_desc(c, iteration_count=iteration_count, restart=restart, refine=refine,
                refine_from_last=refine_from_last, first_vertex=first_vertex, vertex_count=vertex_count)
        out = c.out(out, 'f4 f8', ('vertex_count', 3), dtype)
        desc.positions = c.view_out(out, ('vertex_count', 3))
        if normals is not None:
            normals = c.out(normals, 'f4 f8', ('vertex_count', 3), name='normals')
            desc.normals = c.view_out(normals, ('vertex_count', 3))
        call('hf_pose_deform', self._handle, ref(desc), ref(info, _raw.hf_deform_info))
        return out

    @property
    def statistics(self) -> PoseStatistics:
        """Writes the statistics of a pose."""
        c = Call(self)
        statistics = c.struct(_raw.hf_pose_statistics, {})
        call('hf_pose_get_statistics', self._handle, ref(statistics))
        return statistics

    def skin(self, influence_count: int = 0, *, scales: bool = False) -> SkinInfo:
        """Writes the joints and weights of a pose. Joints 0 to handle_count - 1 are its handles in the order they were
        added. If the handles do not reach some vertices, a last joint that never moves holds those vertices. The
        weights of a vertex are its 4 or 8 largest, scaled so that their sum is exactly 1 in single precision. Weights
        and pivots change only when handles are added or removed.

        The joint motions bring the skin as near as possible to the last Pose.deform, as it is without refine. With
        scales, classic bends, twists and lifts replay within 0.5 per cent of the box. Without scales, bends and
        twists replay within 1 per cent and stretched surfaces within about 2.5 per cent.

        influence_count: joints per vertex, 4 or 8; 0 = 4
        scales: (joint_capacity, 3) along the axes in the last frame; None = joints are rigid

        Raises EmptyError, InvalidArgumentError, UnsupportedError.
        """
        c = Call(self)
        skin = c.struct(_raw.hf_skin_info, {'influence_count': influence_count})
        c.n['influence_count'] = number(influence_count, 'influence_count') or 4

        def run(room: Any, made: Any) -> None:
            c.into(skin, room, made)
            call('hf_pose_get_skin', self._handle, ref(skin))

        found = c.grow(self, 'hf_pose_get_skin', run, lambda: {'joint_capacity': skin.joint_count,
                'vertex_capacity': skin.vertex_count}, {'joint_capacity': c.n.get('joint_count'),
                'vertex_capacity': c.n.get('vertex_count')}, {'pivots': (np.float64, ('joint_capacity', 3)),
                'rotations': (np.float64, ('joint_capacity', 4)), 'translations': (np.float64, ('joint_capacity', 3)),
                'axes': (np.float64, ('joint_capacity', 4)), **({'scales': (np.float64, ('joint_capacity',
                3))} if scales else {}), 'vertex_joints': (np.uint32, ('vertex_capacity', 'influence_count')),
                'vertex_weights': (np.float32, ('vertex_capacity', 'influence_count'))})
        return SkinInfo(**found)

    @property
    def blend_info(self) -> BlendInfo:
        """Writes the info of a blend.

        Raises EmptyError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        info = c.struct(_raw.hf_blend_info, {})
        call('hf_pose_get_blend_info', self._handle, ref(info))
        return info

    def blend_rows(self) -> BlendRows:
        """Writes the arrays that a shader needs once for each `revision`. Call it without arrays for the counts, then
        with arrays. If handles do not reach some vertices, a last cluster that never moves holds those vertices.

        Raises EmptyError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        rows = c.struct(_raw.hf_blend_rows, {})

        def run(room: Any, made: Any) -> None:
            c.into(rows, room, made)
            call('hf_pose_get_blend_rows', self._handle, ref(rows))

        found = c.grow(self, 'hf_pose_get_blend_rows', run, lambda: {'vertex_capacity': rows.vertex_count,
                'entry_capacity': rows.entry_count}, {'vertex_capacity': c.n.get('vertex_count'),
                'entry_capacity': None}, {'rows': (np.uint32, ('vertex_capacity', 2)), 'clusters': (np.uint16,
                ('entry_capacity',)), 'weights': (np.float32, ('entry_capacity',)), 'gradients': (np.float32,
                ('entry_capacity', 3)), 'positions': (np.float32, ('vertex_capacity', 3)), 'normals': (np.float32,
                ('vertex_capacity', 3)), 'offsets': (np.float32, ('vertex_capacity', 3))})
        return BlendRows(longest_row=rows.longest_row, **found)

    def blend_influences(self, influence_count: int = 0, *, byte_clusters: bool = False,
            byte_weights: bool = False) -> BlendInfluences:
        """Writes rows of one length. They change with `revision`, as the rows of Pose.blend_rows do. Call it without
        arrays for the count and the errors.

        influence_count: clusters of each vertex, the length of a row, 1 to 64; 0 = 8
        byte_clusters: (vertex_capacity, influence_count) None = not wanted. Refused for more than 256 clusters
        byte_weights: (vertex_capacity, influence_count) None = not wanted. 255ths, of sum 255; weights that round to
            0 are left out

        Raises EmptyError, InvalidArgumentError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        influences = c.struct(_raw.hf_blend_influences, {'influence_count': influence_count})
        c.n['influence_count'] = number(influence_count, 'influence_count') or 8

        def run(room: Any, made: Any) -> None:
            c.into(influences, room, made)
            call('hf_pose_get_blend_influences', self._handle, ref(influences))

        found = c.grow(self, 'hf_pose_get_blend_influences', run, lambda: {'vertex_capacity': influences.vertex_count},
                {'vertex_capacity': c.n.get('vertex_count')}, {'clusters': (np.uint16, ('vertex_capacity',
                'influence_count')), 'weights': (np.uint16, ('vertex_capacity', 'influence_count')),
                **({'byte_clusters': (np.uint8, ('vertex_capacity', 'influence_count'))} if byte_clusters else {}),
                **({'byte_weights': (np.uint8, ('vertex_capacity', 'influence_count'))} if byte_weights else {})})
        return BlendInfluences(change=influences.change, byte_change=influences.byte_change, error=influences.error,
                byte_error=influences.byte_error, **found)

    def solve(self, iteration_count: int = 0, restart: bool = False, *, info: Optional[DeformInfo] = None) -> None:
        """Solves a frame without writing vertices, for a shader that computes them. The pose is the same as after
        Pose.deform. Higher layers, rigid pieces and limb_refine need the surface. With them the call costs as much as
        Pose.deform.

        iteration_count: 1 to 1000; 0 = as in hf_pose_desc.
        restart: 1: as in hf_deform_desc.
        info: filled in when given

        Raises EmptyError, InvalidArgumentError.
        """
        c = Call(self)
        call('hf_pose_solve', self._handle, number(iteration_count, 'iteration_count', ctypes.c_uint32), number(restart,
                'restart', ctypes.c_int32), ref(info, _raw.hf_deform_info))

    def blend_transforms(self) -> np.ndarray[Any, Any]:
        """Writes the transforms of the clusters in the last Pose.solve or Pose.deform, without its refine. Before the
        first solve they are identities. After handles were added or removed, solve before you read them: they may be
        identities until then. The call allocates nothing.

        Raises EmptyError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_pose_get_blend_transforms', self._handle, room['capacity'], address(made['transforms']),
                    ref(count))

        found = c.grow(self, 'hf_pose_get_blend_transforms', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'transforms': (np.float32, ('capacity', 12))})
        return found['transforms']


class Quads(Object):
    """Makes a quad mesh of a surface. Every face is a quad. Edges follow smooth crosses along the curvature. Creases and
    borders are straight lines of edges. Irregular vertices are the singularities of the crosses, and places where the
    function split quads to keep to the surface.

    The function relaxes the mesh along the surface. Where mesh and surface are farther apart than 0.39 edge lengths,
    it snaps vertices to the surface and adds quads. A relaxed quad starts at the corner whose diagonal keeps nearer
    to the surface, so a renderer should split quads into triangles from the first corner. If the mesh stays farther
    than an edge length from the surface, a limb is lost. Then the function makes up to three finer meshes, and
    removes rows of quads until the number is right. The function checks every result. Each directed edge occurs once.
    No face repeats a corner. The result has the Euler characteristic of the surface.

    The surface may have borders, any genus and several components; the function turns triangles that disagree in
    orientation. Where three or more triangles share an edge, the two flattest are joined, then the next two. A
    triangle without a partner gets a border. Surface.report counts such edges. A Moebius band is parted across.

    With symmetry_plane a vertex on the plane is its own image, and all others come in pairs, exact to rounding. Half
    of the quads lie on each side. Where surface and mirror image differ, by up to 0.05 box diagonals, the side of the
    normal counts.

    The user can place irregular vertices and drag them. The function makes each by guides on a ring around the place,
    an edge of the quads away. The crosses on the ring make a quarter turn along it. 96 % of 1,000 irregular vertices
    at random places of 20 meshes come out within an edge of the place; such a vertex then moves to the place and
    stays there. A vertex of 5 quads brings others of 3 with it, because the indices of the crosses sum to four times
    the Euler characteristic. On a torus or a knot a single one of 5 is often lost.

    crease_edges: (crease_count, 2) the two vertices of each edge, of your mesh
    guide_vertices: (guide_count,) vertices of your mesh; guides of one vertex are averaged
    guide_vectors: (guide_count, 3) along the surface, of any length above 0; quads run along the vector and across it
    guide_weights: None = all 1, or (guide_count,), above 0 to 1: 1 holds the direction. A smaller weight mixes it
        with the direction of the curvature, which has the rest of the weight
    irregular_points: (irregular_count, 3) at the surface, in the unit and frame of the mesh
    irregular_valences: (irregular_count,) how many quads meet there: 3 or 5
    irregular_directions: None = any, or (irregular_count, 3): one side of the irregular vertex runs along it; 0 0 0 =
        any
    face_count: wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
    edge_length: wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
    crease_angle: edges of the surface that bend by more than this, radians, up to pi, become edges of quads; 0 =
        none.  If there are more than 1,024 lines of creases and borders, only the longest are kept. Creases nearer to
        each other than an edge may be released
    relax_count: rounds of tangential relaxation, up to 1,000; 0 = 60; NO_INDEX = none, and the mesh is not fitted to
        the surface either
    symmetry_plane: a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none. Quads are
        made of the side that (a, b, c) points to, and mirrored. Creases, guides and irregular vertices on the other
        side are not used
    progress: an object to poll and cancel through
    """

    _destroy = 'hf_quads_destroy'
    _counts = ()

    def __repr__(self) -> str:
        return told(self, ())

    def __init__(self, surface: Surface, crease_edges: Optional[ArrayLike] = None,
            guide_vertices: Optional[ArrayLike] = None, guide_vectors: Optional[ArrayLike] = None,
            guide_weights: Optional[ArrayLike] = None, irregular_points: Optional[ArrayLike] = None,
            irregular_valences: Optional[ArrayLike] = None, irregular_directions: Optional[ArrayLike] = None, *,
            face_count: int = 0, edge_length: float = 0.0, crease_angle: float = 0.0, relax_count: int = 0,
            symmetry_plane: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> None:
        c = Call(surface=surface)
        desc = _quads_desc(c, crease_edges=crease_edges, guide_vertices=guide_vertices, guide_vectors=guide_vectors,
                guide_weights=guide_weights, irregular_points=irregular_points, irregular_valences=irregular_valences,
                irregular_directions=irregular_directions, face_count=face_count, edge_length=edge_length,
                crease_angle=crease_angle, relax_count=relax_count, symmetry_plane=symmetry_plane, progress=progress)
        self._own('hf_quads_create', c, handle_of(surface, Surface, 'surface'), ref(desc))

    def update(self, crease_edges: Optional[ArrayLike] = None, guide_vertices: Optional[ArrayLike] = None,
            guide_vectors: Optional[ArrayLike] = None, guide_weights: Optional[ArrayLike] = None,
            irregular_points: Optional[ArrayLike] = None, irregular_valences: Optional[ArrayLike] = None,
            irregular_directions: Optional[ArrayLike] = None, *, face_count: int = 0, edge_length: float = 0.0,
            crease_angle: float = 0.0, relax_count: int = 0, symmetry_plane: Optional[ArrayLike] = None,
            progress: Optional[Progress] = None) -> None:
        """Makes the mesh of `quads` again, with other options: for strokes and creases that the user drags. Quads with
        the same options gives the same result, bit for bit. The first update takes as long. It keeps the tables that
        do not depend on guides, creases and relax_count. Later updates with the same edge_length, face_count and
        symmetry_plane take less time. Without relaxation (relax_count = NO_INDEX) they take 0.1 s for 15,000
        vertices. Use that while the user drags, and relax_count = 0 at the end. Other sizes and planes are allowed;
        what belongs to them is made again. After an error `quads` is unchanged. Kept memory: 2 to 4 kB per vertex,
        until `quads` is destroyed.

        crease_edges: (crease_count, 2) the two vertices of each edge, of your mesh
        guide_vertices: (guide_count,) vertices of your mesh; guides of one vertex are averaged
        guide_vectors: (guide_count, 3) along the surface, of any length above 0; quads run along the vector and
            across it
        guide_weights: None = all 1, or (guide_count,), above 0 to 1: 1 holds the direction. A smaller weight mixes it
            with the direction of the curvature, which has the rest of the weight
        irregular_points: (irregular_count, 3) at the surface, in the unit and frame of the mesh
        irregular_valences: (irregular_count,) how many quads meet there: 3 or 5
        irregular_directions: None = any, or (irregular_count, 3): one side of the irregular vertex runs along it; 0 0
            0 = any
        face_count: wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
        edge_length: wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
        crease_angle: edges of the surface that bend by more than this, radians, up to pi, become edges of quads; 0 =
            none.  If there are more than 1,024 lines of creases and borders, only the longest are kept. Creases
            nearer to each other than an edge may be released
        relax_count: rounds of tangential relaxation, up to 1,000; 0 = 60; NO_INDEX = none, and the mesh is not fitted
            to the surface either
        symmetry_plane: a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none. Quads
            are made of the side that (a, b, c) points to, and mirrored. Creases, guides and irregular vertices on the
            other side are not used
        progress: an object to poll and cancel through

        Raises CancelledError, InternalError, InvalidArgumentError, NonFiniteError, NotPositiveDefiniteError,
        OutOfRangeError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        desc = _quads_desc(c, crease_edges=crease_edges, guide_vertices=guide_vertices, guide_vectors=guide_vectors,
                guide_weights=guide_weights, irregular_points=irregular_points, irregular_valences=irregular_valences,
                irregular_directions=irregular_directions, face_count=face_count, edge_length=edge_length,
                crease_angle=crease_angle, relax_count=relax_count, symmetry_plane=symmetry_plane, progress=progress)
        call('hf_quads_update', self._handle, ref(desc))

    @property
    def info(self) -> QuadsInfo:
        """Writes the counts."""
        c = Call(self)
        info = c.struct(_raw.hf_quads_info, {})
        call('hf_quads_get_info', self._handle, ref(info))
        return info

    def mesh(self) -> QuadsMesh:
        """Writes every array that is not None.

        Raises TooSmallError.
        """
        c = Call(self)
        mesh = c.struct(_raw.hf_quads_mesh, {})

        def run(room: Any, made: Any) -> None:
            c.into(mesh, room, made)
            call('hf_quads_get_mesh', self._handle, ref(mesh))

        found = c.grow(self, 'hf_quads_get_mesh', run, lambda: {'vertex_capacity': mesh.vertex_count,
                'face_capacity': mesh.face_count}, {'vertex_capacity': c.n.get('vertex_count'), 'face_capacity': None},
                {'positions': (np.float64, ('vertex_capacity', 3)), 'faces': (np.uint32, ('face_capacity', 4)),
                'triangles': (np.uint32, ('vertex_capacity',)), 'barycentrics': (np.float64, ('vertex_capacity', 3)),
                'corners': (np.uint32, ('vertex_capacity', 3))})
        return QuadsMesh(**found)


class Flow(Object):
    """A surface that is prepared for tracing streamlines.

    Prepares a surface for tracing: computes half-edges and weights.
    """

    _destroy = 'hf_flow_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count',))

    def __init__(self, surface: Surface) -> None:
        c = Call(surface=surface)
        self._own('hf_flow_create', c, handle_of(surface, Surface, 'surface'))

    def trace(self, field: ArrayLike, seeds: Optional[ArrayLike] = None, wanted_count: int = 0) -> Streamlines:
        """Traces streamlines of any field that is finite at every vertex in a triangle. For a harmonic field of
        Operator.CLAMPED the lines are denser where the field is steeper. Surface.trace_isolines gives the lines that
        cross the streamlines.

        field: (vertex_count,) of float or double.
        seeds: (seed_count,) vertices of your mesh
        wanted_count: lines from the minima of the field, each for the same flux, 1 to 1,000,000; without seeds

        Raises InvalidArgumentError, NonFiniteError, OutOfRangeError.
        """
        c = Call(self)
        field_ = c.view('field', field, 'f4 f8', ('vertex_count',))
        lines = c.struct(_raw.hf_streamlines, {'wanted_count': wanted_count})
        lines.seeds = c.array('seeds', seeds, 'u4', ('seed_count',))
        lines.seed_count = c.n.setdefault('seed_count', 0)

        def run(room: Any, made: Any) -> None:
            c.into(lines, room, made)
            call('hf_flow_trace', self._handle, None if field is None else ref(field_), ref(lines))

        found = c.grow(self, 'hf_flow_trace', run, lambda: {'point_capacity': lines.point_count,
                'line_capacity': lines.line_count}, {'point_capacity': None, 'line_capacity': None},
                {'positions': (np.float64, ('point_capacity', 3)), 'values': (np.float64, ('point_capacity',)),
                'line_starts': (np.uint32, ('line_capacity + 1',)), 'line_ends': (np.uint32, ('line_capacity', 2))})
        return Streamlines(**found)


class Region(Recorded):
    """A region of a surface and its smooth base.

    Creates a region without vertices.

    positions: (vertex_count, 3) of float or double: positions of the mesh or of a pose. A morph of weight 0 writes
        the same bits. None: the positions of the mesh, to 1e-15 of the box. The call copies the array
    base: Base. If the surface has no factor for it yet, it is made now
    progress: an object to poll and cancel through
    """

    _destroy = 'hf_region_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count',))

    def __init__(self, surface: Surface, positions: Optional[ArrayLike] = None, *, base: int = Base.DEFAULT,
            progress: Optional[Progress] = None) -> None:
        c = Call(surface=surface)
        desc = _region_desc(c, positions=positions, base=base, progress=progress)
        self._own('hf_region_create', c, handle_of(surface, Surface, 'surface'), ref(desc))

    def clone(self) -> "Region":
        """Copies a region. The copy shares the factor and all memory, until one of the two is edited. For undo, keep
        copies: one before each edit.
        """
        c = Call(self)
        made = type(self).__new__(type(self))
        c.n.update(self._n)
        made._own('hf_region_clone', c, self._handle)
        return made

    def edit(self, remove_vertices: Optional[ArrayLike] = None, add_vertices: Optional[ArrayLike] = None, *,
            ring_count: int = 0, curve: Any = None, progress: Optional[Progress] = None) -> None:
        """Changes the region and computes its new base. The vertices next to the region (its rim) are sites with their
        positions as values. Sites that stay cost nothing; the others are one batch as in Solver.edit_sites. One
        backward sweep over the factor then gives the base; for a small region the sweep covers only the part of the
        factor that its vertices need. A region may have several pieces, in several components. Progress covers curve,
        sites and base; the call can be cancelled between them.

        remove_vertices: (remove_count,) vertices that leave the region; others are passed over
        add_vertices: (add_count,) vertices that join it; those in it already are passed over
        ring_count: rings of vertices by which the region grows; below 0 it shrinks
        curve: the region becomes what this curve encloses
        progress: an object to poll and cancel through

        Raises CancelledError, EmptyError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        desc = _region_edit_desc(c, remove_vertices=remove_vertices, add_vertices=add_vertices, ring_count=ring_count,
                curve=curve, progress=progress)
        call('hf_region_edit', self._handle, ref(desc))

    @property
    def info(self) -> RegionInfo:
        """Writes the info of a region."""
        c = Call(self)
        info = c.struct(_raw.hf_region_info, {})
        call('hf_region_get_info', self._handle, ref(info))
        return info

    @property
    def statistics(self) -> RegionStatistics:
        """Writes the statistics of a region."""
        c = Call(self)
        statistics = c.struct(_raw.hf_region_statistics, {})
        call('hf_region_get_statistics', self._handle, ref(statistics))
        return statistics

    def vertices(self, list: int = RegionList.INSIDE) -> np.ndarray[Any, Any]:
        """Writes one list of vertices of your mesh, ascending. Where vertices were welded, the list has the first copy.

        list: RegionList.

        Raises InvalidArgumentError.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_region_get_vertices', self._handle, number(list, 'list', ctypes.c_int32, flag=False),
                    room['capacity'], address(made['vertices']), ref(count))

        found = c.grow(self, 'hf_region_get_vertices', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'vertices': (np.uint32, ('capacity',))})
        return found['vertices']

    def curve(self) -> np.ndarray[Any, Any]:
        """Writes the corners of the region's last curve, to draw it, in order, in the unit and frame of the positions in
        hf_region_desc. The last corner is joined to the first. Rings, added and removed vertices leave it as it is.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_region_get_curve', self._handle, room['capacity'], address(made['points']), ref(count))

        found = c.grow(self, 'hf_region_get_curve', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'points': (np.float64, ('capacity', 3))})
        return found['points']

    def morph(self, weight: float = 0.0, out: Optional[np.ndarray[Any, Any]] = None, *, dtype: Any = np.float32,
            normals: Optional[np.ndarray[Any, Any]] = None) -> np.ndarray[Any, Any]:
        """Morphs the region. A vertex of the region moves from p to p + weight (base - p), with p its position in
        hf_region_desc. All other vertices stay at p. Weight 0 gives p bit for bit, and weight 1 gives the base. A
        weight below 0 exaggerates detail, and a weight above 1 turns it inside out. An empty region gives p. The call
        solves nothing.

        weight: any finite number
        out: (vertex_count, 3) of float or double, in the unit of the mesh
        normals: (vertex_count, 3) of float or double: unit normals of the morphed surface, shared across seams

        Raises NonFiniteError, TooLargeError.
        """
        c = Call(self)
        desc = _morph_desc(c, weight=weight)
        out = c.out(out, 'f4 f8', ('vertex_count', 3), dtype)
        desc.positions = c.view_out(out, ('vertex_count', 3))
        if normals is not None:
            normals = c.out(normals, 'f4 f8', ('vertex_count', 3), name='normals')
            desc.normals = c.view_out(normals, ('vertex_count', 3))
        call('hf_region_morph', self._handle, ref(desc))
        return out


class Detail(Object):
    """The detail of a source region, transferred to a target region. Both may be on one surface or on two.

    Carries the detail of the source region to the target region. A harmonic map with positive weights takes each
    region to the unit disc (an embedding: Tutte 1963, Floater 1997). Vertices around a region (its rim) lie on the
    circle, by arc length between the pairs of desc. Points at the same place in the disc correspond. The function
    stores the offset from base to surface in a local frame of the source. The axes of the frame are the normal of the
    base and the direction in which the first disc coordinate grows. It interpolates the offsets in the triangles of
    the source, and applies them in the same frames of the target. The detail fades to nothing at the rim. If source
    and target are the same region, the result is the surface itself. Later edits of the regions do not change the
    object.

    Both regions must be discs: in one piece, one rim loop, no hole, manifold, of one orientation.

    source_vertices: (pair_count,) rim vertices of the source mesh
    target_vertices: (pair_count,) rim vertices of the target mesh
    scale: of the detail, > 0; 0 = square root of target base area over source base area
    progress: an object to poll and cancel through
    """

    _destroy = 'hf_detail_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count',))

    def __init__(self, source: Region, target: Region, source_vertices: Optional[ArrayLike] = None,
            target_vertices: Optional[ArrayLike] = None, *, scale: float = 0.0,
            progress: Optional[Progress] = None) -> None:
        c = Call(source=source, target=target)
        desc = _detail_desc(c, source_vertices=source_vertices, target_vertices=target_vertices, scale=scale,
                progress=progress)
        self._own('hf_detail_create', c, handle_of(source, Region, 'source'), handle_of(target, Region, 'target'),
                ref(desc))

    def morph(self, weight: float = 0.0, out: Optional[np.ndarray[Any, Any]] = None, *, dtype: Any = np.float32,
            normals: Optional[np.ndarray[Any, Any]] = None) -> np.ndarray[Any, Any]:
        """Writes the target's surface with its detail replaced. A vertex of the target region gets base + weight
        (transferred detail); all others keep their positions. Weight 0 gives the smooth base, and weight 1 the detail
        as it was on the source. A weight above 1 exaggerates the detail, and a weight below 0 turns it inside out.

        weight: any finite number
        out: (vertex_count, 3) of float or double, in the unit of the mesh
        normals: (vertex_count, 3) of float or double: unit normals of the morphed surface, shared across seams

        Raises NonFiniteError, TooLargeError.
        """
        c = Call(self)
        desc = _morph_desc(c, weight=weight)
        out = c.out(out, 'f4 f8', ('vertex_count', 3), dtype)
        desc.positions = c.view_out(out, ('vertex_count', 3))
        if normals is not None:
            normals = c.out(normals, 'f4 f8', ('vertex_count', 3), name='normals')
            desc.normals = c.view_out(normals, ('vertex_count', 3))
        call('hf_detail_morph', self._handle, ref(desc))
        return out


class Retarget(Recorded):
    """The motion of one skeleton on another.

    Pairs the joints of two skeletons.

    source_rest: (source.joint_count, 10) a pose that counts as rest, or None: the rest of the skeleton. Give poses in
        which both characters stand alike
    target_rest: (target.joint_count, 10) the same for the target, or None
    root_motion: RootMotion
    leave_out: bits of RetargetStep
    scale: travel of the target over travel of the source; 0: the ratio of leg lengths
    ground_velocity: of the ground under a clip on the spot, in the space of the source, per second; 0: the ground
        rests. Skeleton.ground_velocity finds it
    progress: an object to poll and cancel through
    """

    _destroy = 'hf_retarget_destroy'
    _counts = ('joint_count',)

    @property
    def joint_count(self) -> int:
        """As it was made with."""
        return self._n.get('joint_count', 0)

    def __repr__(self) -> str:
        return told(self, ('joint_count',))

    def __init__(self, source: Skeleton, target: Skeleton, source_rest: Optional[ArrayLike] = None,
            target_rest: Optional[ArrayLike] = None, *, root_motion: int = RootMotion.HIPS, leave_out: int = 0,
            scale: float = 0.0, ground_velocity: Optional[ArrayLike] = None,
            progress: Optional[Progress] = None) -> None:
        c = Call(source=source, target=target)
        desc = _retarget_desc(c, source_rest=source_rest, target_rest=target_rest, root_motion=root_motion,
                leave_out=leave_out, scale=scale, ground_velocity=ground_velocity, progress=progress)
        self._own('hf_retarget_create', c, handle_of(source, Skeleton, 'source'), handle_of(target, Skeleton, 'target'),
                ref(desc))

    def clone(self) -> "Retarget":
        """Copies a retarget with the state of its feet: for another character with the same skeletons, and for undo.
        """
        c = Call(self)
        made = type(self).__new__(type(self))
        c.n.update(self._n)
        made._own('hf_retarget_clone', c, self._handle)
        return made

    def solve(self, source_pose: ArrayLike, seconds: float = 0.0) -> np.ndarray[Any, Any]:
        """Computes the pose of the target. The frame depends on the source pose and on the state of the feet: whether
        each is planted, and how far it is moved to keep its place. The state comes from the frames since the last
        reset and fades within a step.

        source_pose: (source.joint_count, 10).
        seconds: time since the last frame, 0 for the first frame and for a repeated frame.

        Raises InvalidArgumentError, NonFiniteError.
        """
        c = Call(self)
        source_pose_ = c.array('source_pose', source_pose, 'f4', ('source.joint_count', 10))
        target_pose = c.out(None, 'f4', ('target.joint_count', 10), packed=True)
        call('hf_retarget_solve', self._handle, source_pose_, number(seconds, 'seconds', ctypes.c_double),
                address(target_pose))
        return target_pose

    def reset(self) -> None:
        """Forgets the state of the feet and the figures of the info. Call it where the clip jumps."""
        c = Call(self)
        call('hf_retarget_reset', self._handle)

    @property
    def info(self) -> RetargetInfo:
        """Writes the figures."""
        c = Call(self)
        info = c.struct(_raw.hf_retarget_info, {})
        call('hf_retarget_get_info', self._handle, ref(info))
        return info

    def chains(self) -> np.ndarray[Any, Any]:
        """Writes how chains follow."""
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_retarget_get_chains', self._handle, room['capacity'], address(made['chains']), ref(count))

        found = c.grow(self, 'hf_retarget_get_chains', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'chains': (np.dtype(_raw.hf_chain_match), ('capacity',))})
        return found['chains']

    def partners(self) -> np.ndarray[Any, Any]:
        """Writes which joint of the source each joint of the target follows. A joint between two gets the nearer, a
        joint without a partner NO_INDEX.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_retarget_get_partners', self._handle, room['capacity'], address(made['partners']), ref(count))

        found = c.grow(self, 'hf_retarget_get_partners', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'partners': (np.uint32, ('capacity',))})
        return found['partners']


class Skeleton(Object):
    """A skeleton at rest and the findings about it. Calls read the object, none changes it.

    Reads a character and finds its axes, roles and chains. The skin says where soles and heads end, so give it if
    feet shall stand on the ground. The object keeps a copy of everything.

    names: one line for each joint in UTF-8, or None: names then say nothing
    parents: (joint_count,) number of the parent, NO_INDEX for a root
    rest: (joint_count, 10) joint transforms
    inverse_binds: (joint_count, 16) inverse bind matrices, columns first. All zero: no skin names the joint; it moves
        its children and rigid meshes only. None: the skin is given in the pose `rest`, and every joint can bend it
    up: (3,) declared axis, any length, or None: find it
    forward: (3,) declared axis, any length, or None: find it
    roles: (joint_count,) declared Role, -1 for a joint without; or None
    sides: (joint_count,) BodySide of joints with a declared role; or None: find the sides
    travels: (travel_count, 3) where each clip leads from its first to its last frame; it tells forward; or None
    skin: None: there is none, and joints are judged by names and places alone
    progress: an object to poll and cancel through
    """

    _destroy = 'hf_skeleton_destroy'
    _counts = ('joint_count',)

    @property
    def joint_count(self) -> int:
        """As it was made with."""
        return self._n.get('joint_count', 0)

    def __repr__(self) -> str:
        return told(self, ('joint_count',))

    def ground_velocity(self, poses: ArrayLike, seconds: float) -> np.ndarray[Any, Any]:
        """Finds the velocity of the soles where they touch the ground, for a clip on the spot: a treadmill under a walk.
        It is 0 for a clip that travels.

        poses: (frame_count, joint_count, 10).
        seconds: between two frames, above 0.

        Raises EmptyError, InvalidArgumentError, NonFiniteError.
        """
        c = Call(self)
        poses_ = c.array('poses', poses, 'f4', ('frame_count', 'joint_count', 10))
        velocity = c.out(None, 'f8', (3,), packed=True)
        call('hf_skeleton_get_ground_velocity', self._handle, c.n.setdefault('frame_count', 1), poses_, number(seconds,
                'seconds', ctypes.c_double), address(velocity))
        return velocity

    def __init__(self, names: Union[None, str, Sequence[str]] = None, parents: Optional[ArrayLike] = None,
            rest: Optional[ArrayLike] = None, *, inverse_binds: Optional[ArrayLike] = None,
            up: Optional[ArrayLike] = None, forward: Optional[ArrayLike] = None, roles: Optional[ArrayLike] = None,
            sides: Optional[ArrayLike] = None, travels: Optional[ArrayLike] = None, skin: Any = None,
            progress: Optional[Progress] = None) -> None:
        c = Call()
        desc = _skeleton_desc(c, names=names, parents=parents, rest=rest, inverse_binds=inverse_binds, up=up,
                forward=forward, roles=roles, sides=sides, travels=travels, skin=skin, progress=progress)
        self._own('hf_skeleton_create', c, ref(desc))

    @property
    def info(self) -> SkeletonInfo:
        """Writes the findings."""
        c = Call(self)
        info = c.struct(_raw.hf_skeleton_info, {})
        call('hf_skeleton_get_info', self._handle, ref(info))
        return info

    def joints(self) -> np.ndarray[Any, Any]:
        """Writes one entry for each joint."""
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_skeleton_get_joints', self._handle, room['capacity'], address(made['joints']), ref(count))

        found = c.grow(self, 'hf_skeleton_get_joints', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'joints': (np.dtype(_raw.hf_joint_info), ('capacity',))})
        return found['joints']

    def chains(self) -> np.ndarray[Any, Any]:
        """Writes the chains."""
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_skeleton_get_chains', self._handle, room['capacity'], address(made['chains']), ref(count))

        found = c.grow(self, 'hf_skeleton_get_chains', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'chains': (np.dtype(_raw.hf_chain), ('capacity',))})
        return found['chains']

    def chain_joints(self) -> np.ndarray[Any, Any]:
        """Writes the joints of chain after chain."""
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_skeleton_get_chain_joints', self._handle, room['capacity'], address(made['joints']), ref(count))

        found = c.grow(self, 'hf_skeleton_get_chain_joints', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'joints': (np.uint32, ('capacity',))})
        return found['joints']

    def reasons(self) -> str:
        """Writes the reasons as text. The reasons for the axes come first. Then each doubtful finding has one line."""
        c = Call(self)
        size = ctypes.c_size_t()
        call('hf_skeleton_get_reasons', self._handle, 0, None, ref(size))
        block = np.empty(size.value, np.uint8)
        call('hf_skeleton_get_reasons', self._handle, block.size, address(block), ref(size))
        return block[:-1].tobytes().decode()


class Transfer(Object):
    """hf/transfer.h - play the motion of one surface on another.

    You pair regions of the source surface with regions of the target surface. From the pairs both surfaces get the
    same harmonic coordinates, and places of equal coordinates correspond. The vertices around such a place form a
    cluster. The target takes over the rotations of the source's clusters. Its translations follow from its own shape
    (Xu, Zhang, Cohen-Or and Xiong 2009, Section 6), and from where the source's clusters turn about one another. A
    limb whose parts reach farther than the source's turns less, so that it moves as far: a held sword, a long tail, a
    large head. The dial long_follow gives it the whole turn.

    Creates a transfer between two surfaces; both may be the same.

    source_rest: (source.vertex_count, 3) of float or double Poses in which the two bodies correspond, in each
        surface's unit. None: the positions of the surface. Give a standing pose here for a character bound in a
        crouch. Motion is measured from these poses. They do not change the fields.
    target_rest: (target.vertex_count, 3) of float or double
    mode: TransferMode
    cluster_count: 1 to 512. 0 = the larger of 80 and 5 per pair
    ground: Ground
    kernel_width: width of a cluster, in field values, 0.005 to 0.5. 0 = the larger of 0.03 and 0.004 per pair, up to
        0.12
    scale: lengths of the target over lengths of the source, 1e-6 to 1e6; 0 = from the legs, or from the boxes when no
        pair is a foot
    alignment_angle: A limb whose rest directions differ by this angle is aligned by half, radians. Below 0.6 times
        the angle it is not aligned, from 1.4 times on it is aligned fully. 0 = 40 degrees; negative = never.
    source_axes: Rows right, up, forward of the source and of the target. All zero = x, y, z (glTF: up +y, forward
        +z). Lengths, and right x up = forward, must hold within 1e-3. The library takes the nearest rotation.
    """

    _destroy = 'hf_transfer_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count',))

    def __init__(self, source: Surface, target: Surface, source_rest: Optional[ArrayLike] = None,
            target_rest: Optional[ArrayLike] = None, *, mode: int = TransferMode.FIELDS, cluster_count: int = 0,
            ground: int = Ground.KEEP, kernel_width: float = 0.0, scale: float = 0.0, alignment_angle: float = 0.0,
            source_axes: Optional[ArrayLike] = None, target_axes: Optional[ArrayLike] = None) -> None:
        c = Call(source=source, target=target)
        desc = _transfer_desc(c, source_rest=source_rest, target_rest=target_rest, mode=mode,
                cluster_count=cluster_count, ground=ground, kernel_width=kernel_width, scale=scale,
                alignment_angle=alignment_angle, source_axes=source_axes, target_axes=target_axes)
        self._own('hf_transfer_create', c, handle_of(source, Surface, 'source'), handle_of(target, Surface, 'target'),
                ref(desc))

    def add_pairs(self, source_vertices: Optional[Sequence[ArrayLike]] = None,
            target_vertices: Optional[Sequence[ArrayLike]] = None, flags: Optional[ArrayLike] = None, *,
            progress: Optional[Progress] = None) -> np.ndarray[Any, Any]:
        """Adds pairs.

        source_vertices: lists of whole numbers: all regions one after the other; vertices of your mesh, up to 4
            entries per vertex
        target_vertices: lists of whole numbers:
        flags: (pair_count,) PairFlag, or None for none
        progress: an object to poll and cancel through

        Raises CancelledError, ConflictError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        desc = _pairs_desc(c, source_vertices=source_vertices, target_vertices=target_vertices, flags=flags,
                progress=progress)
        pairs = c.out(None, 'u4', ('pair_count',), packed=True)
        call('hf_transfer_add_pairs', self._handle, ref(desc), address(pairs))
        return pairs

    def remove_pairs(self, pairs: ArrayLike) -> None:
        """Removes pairs by number.

        pairs: (pair_count,).

        Raises NotFoundError.
        """
        c = Call(self)
        pairs_ = c.array('pairs', pairs, 'u4', ('pair_count',))
        call('hf_transfer_remove_pairs', self._handle, c.n.setdefault('pair_count', 1), pairs_)

    def pair(self, pair: int) -> PairInfo:
        """Writes the info of a pair. The first call after a change of pairs solves the fields of all pairs, unless
        Transfer.apply has done so. This changes no result.

        Raises NotFoundError.
        """
        c = Call(self)
        info = c.struct(_raw.hf_pair_info, {})
        call('hf_transfer_get_pair', self._handle, number(pair, 'pair', ctypes.c_uint32), ref(info))
        return info

    @property
    def info(self) -> TransferInfo:
        """Writes the info of the whole transfer. The first call after a change of pairs solves fields, as Transfer.pair
        does.

        Raises EmptyError.
        """
        c = Call(self)
        info = c.struct(_raw.hf_transfer_info, {})
        call('hf_transfer_get_info', self._handle, ref(info))
        return info

    @property
    def statistics(self) -> TransferStatistics:
        """Writes the statistics of a transfer."""
        c = Call(self)
        statistics = c.struct(_raw.hf_transfer_statistics, {})
        call('hf_transfer_get_statistics', self._handle, ref(statistics))
        return statistics

    def set_dials(self, *, stride: float = 0.0, hip_height_share: float = 0.0, neck_follow: float = 0.0,
            tail_follow: float = 0.0, arm_space: float = 0.0, long_follow: float = 0.0) -> None:
        """Sets the dials of a transfer for the next frames.

        stride: the paths of feet and trunk along the ground count this many times, 0.1 to 4; 0 = 1, neutral. A
            planted foot does not slide. The body travels as much farther
        hip_height_share: raises the pairs flagged PairFlag.TRUNK and PairFlag.ANCHOR by this share of their mean
            height at rest, -0.5 to 0.5; 0 = neutral. Feet stay, legs bend or stretch. A fallen body is not raised
        neck_follow: pairs flagged PairFlag.NECK, together one limb How far a limb follows the source, -1 to 1. At 0
            (neutral) the limb plays the source's motion from its own rest direction. At 1 it also gets the rest
            direction of the source's limb. At -1 it does not move against its root.
        tail_follow: pairs flagged PairFlag.TAIL, together one limb
        arm_space: turns arms (PairFlag.ARM) away from the body, about the forward axis at rest, -pi/2 to pi/2
            radians; 0 = neutral
        long_follow: how far parts that reach farther than the source's follow, 0 to 1. 0 = neutral: they turn less,
            so that they move as far. 1: they make the whole turn. Between, a part may jump that turns by half a turn
            against the part before it

        Raises InvalidArgumentError, NonFiniteError.
        """
        c = Call(self)
        desc = _transfer_dials(c, stride=stride, hip_height_share=hip_height_share, neck_follow=neck_follow,
                tail_follow=tail_follow, arm_space=arm_space, long_follow=long_follow)
        call('hf_transfer_set_dials', self._handle, ref(desc))

    @property
    def dials(self) -> TransferDials:
        """Writes the dials; stride is never 0."""
        c = Call(self)
        dials = c.struct(_raw.hf_transfer_dials, {})
        call('hf_transfer_get_dials', self._handle, ref(dials))
        return dials

    def set_rigid_pieces(self, vertices: ArrayLike) -> None:
        """Names the rigid pieces of the target, such as a sword. A piece is an edge-connected part of the mesh. Each
        frame moves a rigid piece by the rigid motion that fits the piece best, as Pose.set_rigid_pieces does. This
        fit is the last step of a frame. So a hold on a part of a rigid piece may miss its position, and a rigid piece
        may sink into the ground.

        vertices: (vertex_count,), one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The
            list replaces the previous list and applies from the next frame on. The call does not factorise.

        Raises InvalidArgumentError, OutOfRangeError, TooLargeError.
        """
        c = Call(self)
        c.n.pop('vertex_count', None)  # of the list given here
        vertices_ = c.array('vertices', vertices, 'u4', ('vertex_count',))
        call('hf_transfer_set_rigid_pieces', self._handle, c.n.setdefault('vertex_count', 1), vertices_)

    def apply(self, source_positions: Optional[ArrayLike] = None, out: Optional[np.ndarray[Any, Any]] = None, *,
            hold_pairs: Optional[ArrayLike] = None, hold_positions: Optional[ArrayLike] = None, dtype: Any = np.float32,
            target_normals: Optional[np.ndarray[Any, Any]] = None) -> np.ndarray[Any, Any]:
        """Transfers one posed frame. If the source is at rest, the target is at rest too. If a limb's rest directions
        differ much on the two surfaces (PairInfo), it takes the direction of the source's limb instead, by a share.

        The bits of a frame depend on the pairs, in the order of their numbers, on the dials and on this desc alone.
        Removed pairs and earlier frames have no effect, so a scrubbed timeline and a played one give the same frames,
        bit for bit. The result changes as little as the source does: a source that stands still except for noise
        gives a target that stands still.

        The ground counts too if the mode is TransferMode.FIELDS and some pairs are anchors (their target region
        follows the path of the source's region). While a foot of the source stands on the ground, the target's foot
        follows its scaled path exactly. No vertex of the target sinks deeper into the ground than the source, scaled,
        except the vertices of Transfer.sinking. A part that would sink bends up. The ground does not move regions
        that you hold. A lying target rests on the parts that the source rests on. A rigid motion of the whole source
        is copied unchanged. All rules of the ground come in continuously. The ground is under the feet of each body
        at rest, and what hangs lower is none: a cape, a tail, scenery. Without feet, or where the trunk is below
        them, it is the lowest vertex. Ground.OFF switches it off.

        source_positions: (source.vertex_count, 3) of float or double: the posed source, its own vertex order
        hold_pairs: (hold_count,) each pair at most once A hold puts the target region of a pair exactly at a position
            of yours, such as a foot on a step or a hand on a rail. The mean of the region's vertices lands there;
            welded copies count once. The rest of the surface follows.
        hold_positions: (hold_count, 3) in the target's unit and frame
        out: (target.vertex_count, 3) of float or double
        target_normals: (target.vertex_count, 3) of float or double

        Raises EmptyError, InvalidArgumentError, NonFiniteError, NotFoundError, TooLargeError, UnsupportedError.
        """
        c = Call(self)
        desc = _transfer_frame(c, source_positions=source_positions, hold_pairs=hold_pairs,
                hold_positions=hold_positions)
        out = c.out(out, 'f4 f8', ('target.vertex_count', 3), dtype)
        desc.target_positions = c.view_out(out, ('target.vertex_count', 3))
        if target_normals is not None:
            target_normals = c.out(target_normals, 'f4 f8', ('target.vertex_count', 3), name='target_normals')
            desc.target_normals = c.view_out(target_normals, ('target.vertex_count', 3))
        call('hf_transfer_apply', self._handle, ref(desc))
        return out

    def sinking(self) -> np.ndarray[Any, Any]:
        """Writes which target vertices may sink into the ground.

        Raises EmptyError.
        """
        c = Call(self)
        sinking = c.out(None, 'u1', ('target.vertex_count',), packed=True)
        call('hf_transfer_get_sinking', self._handle, address(sinking))
        return sinking != 0

    def skin(self, influence_count: int = 0, *, scales: bool = False) -> SkinInfo:
        """Writes the transfer as a skin (hf/pose.h), with the motion of the last frame. With influence_count 4 the skin
        replays Transfer.apply exactly, because that function also uses the four largest weights. Each rigid piece is
        one joint. These joints come after the joints of clusters.

        influence_count: joints per vertex, 4 or 8; 0 = 4
        scales: (joint_capacity, 3) along the axes in the last frame; None = joints are rigid

        Raises EmptyError, InvalidArgumentError, UnsupportedError.
        """
        c = Call(self)
        skin = c.struct(_raw.hf_skin_info, {'influence_count': influence_count})
        c.n['influence_count'] = number(influence_count, 'influence_count') or 4

        def run(room: Any, made: Any) -> None:
            c.into(skin, room, made)
            call('hf_transfer_get_skin', self._handle, ref(skin))

        found = c.grow(self, 'hf_transfer_get_skin', run, lambda: {'joint_capacity': skin.joint_count,
                'vertex_capacity': skin.vertex_count}, {'joint_capacity': c.n.get('joint_count'),
                'vertex_capacity': c.n.get('vertex_count')}, {'pivots': (np.float64, ('joint_capacity', 3)),
                'rotations': (np.float64, ('joint_capacity', 4)), 'translations': (np.float64, ('joint_capacity', 3)),
                'axes': (np.float64, ('joint_capacity', 4)), **({'scales': (np.float64, ('joint_capacity',
                3))} if scales else {}), 'vertex_joints': (np.uint32, ('vertex_capacity', 'influence_count')),
                'vertex_weights': (np.float32, ('vertex_capacity', 'influence_count'))})
        return SkinInfo(**found)


class Weights(Recorded):
    """The weights of one surface for one skeleton.

    Computes weights.

    heads: (joint_count, 3)
    tails: (joint_count, 3), or None: heads are joints, and the library finds the tails
    axes: (joint_count, 3) with tails None: where each joint points, any length, a zero vector for unknown; or None.
        A joint reaches to the child that lies there, or to the end of the skin. A      child that does      not
        deform says where a last joint ends
    parents: (joint_count,) number of the parent, NO_INDEX for a root; None: all are roots
    deforms: (joint_count,) 1: the joint gets weights; None: all do
    sources: (joint_count,) for Weights.set_joints: the number that the joint had before, NO_INDEX for a new one;
        None: the same number. Weights: None
    progress: an object to poll and cancel through
    influence_count: joints per vertex, 4 or 8, or 0 for 4. Uses the harmonic factor of the surface; if it has none,
        it is made now. Sets *weights to None first.
    """

    _destroy = 'hf_weights_destroy'
    _counts = ('vertex_count',)

    @property
    def vertex_count(self) -> int:
        """Vertices of the surface, as given."""
        return self._n.get('vertex_count', 0)

    def __repr__(self) -> str:
        return told(self, ('vertex_count',))

    def __init__(self, surface: Surface, heads: Optional[ArrayLike] = None, tails: Optional[ArrayLike] = None,
            axes: Optional[ArrayLike] = None, parents: Optional[ArrayLike] = None, deforms: Optional[ArrayLike] = None,
            sources: Optional[ArrayLike] = None, influence_count: int = 0, *,
            progress: Optional[Progress] = None) -> None:
        c = Call(surface=surface)
        desc = _joints_desc(c, heads=heads, tails=tails, axes=axes, parents=parents, deforms=deforms, sources=sources,
                progress=progress)
        c.n['influence_count'] = number(influence_count, 'influence_count') or 4
        self._own('hf_weights_create', c, handle_of(surface, Surface, 'surface'), ref(desc), number(influence_count,
                'influence_count', ctypes.c_uint32))

    def clone(self) -> "Weights":
        """Copies the weights with joints, pins and locks. The copy shares the factors and all memory, until one of the
        two is changed. For undo, keep copies: one before each change.
        """
        c = Call(self)
        made = type(self).__new__(type(self))
        c.n.update(self._n)
        made._own('hf_weights_clone', c, self._handle)
        return made

    def set_joints(self, heads: Optional[ArrayLike] = None, tails: Optional[ArrayLike] = None,
            axes: Optional[ArrayLike] = None, parents: Optional[ArrayLike] = None, deforms: Optional[ArrayLike] = None,
            sources: Optional[ArrayLike] = None, *, progress: Optional[Progress] = None) -> None:
        """Replaces all

        heads: (joint_count, 3)
        tails: (joint_count, 3), or None: heads are joints, and the library finds the tails
        axes: (joint_count, 3) with tails None: where each joint points, any length, a zero vector for unknown; or
            None.      A joint reaches to the child that lies there, or to the end of the skin. A      child that does
            not deform says where a last joint ends
        parents: (joint_count,) number of the parent, NO_INDEX for a root; None: all are roots
        deforms: (joint_count,) 1: the joint gets weights; None: all do
        sources: (joint_count,) for Weights.set_joints: the number that the joint had before, NO_INDEX for a new one;
            None: the same number. Weights: None
        progress: an object to poll and cancel through

        Raises CancelledError, ConflictError, DuplicateError, EmptyError, InvalidArgumentError, NonFiniteError,
        OutOfRangeError, UnsupportedError.
        """
        c = Call(self)
        desc = _joints_desc(c, heads=heads, tails=tails, axes=axes, parents=parents, deforms=deforms, sources=sources,
                progress=progress)
        call('hf_weights_set_joints', self._handle, ref(desc))

    def set_pins(self, vertices: Optional[ArrayLike] = None, *, places: Optional[Sequence[PlaceLike]] = None,
            points: Optional[ArrayLike] = None, radii: Optional[ArrayLike] = None, joints: Optional[ArrayLike] = None,
            weights: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> None:
        """Replaces all pins and computes the weights. A pinned vertex gets its weights exactly; so do all vertices of a
        disc. Pins at the same places with other weights cost no path.

        vertices: (pin_count,) vertices of your mesh, or None
        places: (pin_count,), or None
        points: (pin_count, 3) points in space, at rest, in the unit and frame of the mesh, or None. Each stands for
            the nearest point of the surface, up to two boxes away
        radii: (pin_count,) of the geodesic disc around the place, in the unit of the mesh; None or 0: the place alone
        joints: (pin_count, influence_count) joints
        weights: (pin_count, influence_count) >= 0, scaled to the sum 1
        progress: an object to poll and cancel through

        Raises CancelledError, ConflictError, DuplicateError, InvalidArgumentError, NonFiniteError, OutOfRangeError,
        TooLargeError.
        """
        c = Call(self)
        desc = _pins_desc(c, vertices=vertices, places=places, points=points, radii=radii, joints=joints,
                weights=weights, progress=progress)
        call('hf_weights_set_pins', self._handle, ref(desc))

    def set_locks(self, joints: ArrayLike, values: Optional[ArrayLike] = None) -> None:
        """Locks joints: their weights stay, and the other joints share the rest. Replaces all locks; lock_count 0
        unlocks.

        joints: (lock_count,).
        values: (vertex_count, lock_count) weights to keep, 0 to 1, or None for the present ones. Welded copies take
            the values of the first. Pinned vertices keep the weights of their pins.

        Raises DuplicateError, InvalidArgumentError, NonFiniteError, OutOfRangeError.
        """
        c = Call(self)
        joints_ = c.array('joints', joints, 'u4', ('lock_count',))
        values_ = c.array('values', values, 'f4', ('vertex_count', 'lock_count'))
        call('hf_weights_set_locks', self._handle, c.n.setdefault('lock_count', 1), joints_, values_)

    def get(self) -> WeightsOut:
        """Writes the weights. Welded copies of a vertex get the same. Unused places have weight 0 and the first joint of
        the vertex.

        Raises TooLargeError.
        """
        c = Call(self)
        weights = c.struct(_raw.hf_weights_out, {})

        def run(room: Any, made: Any) -> None:
            c.into(weights, room, made)
            call('hf_weights_get', self._handle, ref(weights))

        found = c.grow(self, 'hf_weights_get', run, lambda: {'vertex_capacity': weights.vertex_count,
                'influence_count': weights.influence_count}, {'vertex_capacity': c.n.get('vertex_count')},
                {'joints': (np.uint32, ('vertex_capacity', 'influence_count')), 'weights': (np.float32,
                ('vertex_capacity', 'influence_count')), 'origins': (np.uint8, ('vertex_capacity',))})
        return WeightsOut(**found)

    def joints(self) -> Tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """Writes the flags of each joint, and how many vertices have a constraint for it. Joints that do not deform have
        no flags.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_weights_get_joints', self._handle, room['capacity'], address(made['flags']),
                    address(made['vertex_counts']), ref(count))

        found = c.grow(self, 'hf_weights_get_joints', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'flags': (np.uint32, ('capacity',)), 'vertex_counts': (np.uint32, ('capacity',))})
        return found['flags'], found['vertex_counts']

    @property
    def info(self) -> WeightsInfo:
        """Writes the info."""
        c = Call(self)
        info = c.struct(_raw.hf_weights_info, {})
        call('hf_weights_get_info', self._handle, ref(info))
        return info

    @property
    def statistics(self) -> WeightsStatistics:
        """Writes the statistics."""
        c = Call(self)
        statistics = c.struct(_raw.hf_weights_statistics, {})
        call('hf_weights_get_statistics', self._handle, ref(statistics))
        return statistics

    def helpers(self, names: Union[None, str, Sequence[str]] = None) -> np.ndarray[Any, Any]:
        """Proposes joints that should not deform, and says why. The weights do not change: to follow a proposal, set
        deforms to 0.

        names: one line for each joint in UTF-8, or None.

        Raises InvalidArgumentError.
        """
        c = Call(self)
        count = ctypes.c_uint32()

        def run(room: Any, made: Any) -> None:
            call('hf_weights_get_helpers', self._handle, c.text(names), room['capacity'], address(made['reasons']),
                    ref(count))

        found = c.grow(self, 'hf_weights_get_helpers', run, lambda: {'capacity': count.value}, {'capacity': None},
                {'reasons': (np.uint32, ('capacity',))})
        return found['reasons']

    @staticmethod
    def transfer(source: Surface, target: Surface, joints: Optional[ArrayLike] = None,
            weights: Optional[ArrayLike] = None, *, distance: float = 0.0, angle: float = 0.0, influence_count: int = 0,
            progress: Optional[Progress] = None, info: Optional[WeightsTransferInfo] = None) -> WeightsOut:
        """Transfers weights from one surface to another: clothes, hair, levels of detail, new topology. Both stand in
        the same frame. A vertex gets the weights of the nearest point of the source whose normal agrees. One bi-
        harmonic field fills in the vertices without such a point. A piece without any takes the weights of the
        nearest points.

        joints: (source.vertex_count, source_influence_count)
        weights: (source.vertex_count, source_influence_count) >= 0; a vertex whose weights are all 0 gives none
        distance: a vertex matches points within it, unit of the mesh; 0: 0.05 of the source's diagonal
        angle: between the normals of vertex and point, radians, up to 3.15; 0: 0.52 (30 degrees)
        influence_count: joints of each vertex in the result: 4 or 8; 0: 4
        progress: an object to poll and cancel through
        info: filled in when given

        Raises CancelledError, EmptyError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError,
        TooSmallError, UnsupportedError.
        """
        c = Call(source=source, target=target)
        desc = _weights_transfer_desc(c, joints=joints, weights=weights, distance=distance, angle=angle,
                influence_count=influence_count, progress=progress)
        weights_ = c.struct(_raw.hf_weights_out, {})

        def run(room: Any, made: Any) -> None:
            c.into(weights_, room, made)
            call('hf_weights_transfer', handle_of(source, Surface, 'source'), handle_of(target, Surface, 'target'),
                    ref(desc), ref(weights_), ref(info, _raw.hf_weights_transfer_info))

        found = c.grow(source, 'hf_weights_transfer', run, lambda: {'vertex_capacity': weights_.vertex_count,
                'influence_count': weights_.influence_count}, {'vertex_capacity': c.n.get('vertex_count')},
                {'joints': (np.uint32, ('vertex_capacity', 'influence_count')), 'weights': (np.float32,
                ('vertex_capacity', 'influence_count')), 'origins': (np.uint8, ('vertex_capacity',))})
        return WeightsOut(**found)

    @staticmethod
    def mirror(surface: Surface, heads: Optional[ArrayLike] = None, names: Union[None, str, Sequence[str]] = None,
            partners: Optional[ArrayLike] = None, plane: Optional[ArrayLike] = None, joints: Optional[ArrayLike] = None,
            weights: Optional[ArrayLike] = None, *, to: int = MirrorTo.TO_NEGATIVE, distance: float = 0.0,
            angle: float = 0.0, influence_count: int = 0, progress: Optional[Progress] = None,
            info: Optional[WeightsMirrorInfo] = None,
            statistics: Optional[WeightsMirrorStatistics] = None) -> Tuple[WeightsOut, np.ndarray[Any, Any],
            np.ndarray[Any, Any]]:
        """Mirrors the weights of one side to the other. The mesh need not be symmetric. A vertex gets the weights of the
        nearest point to its reflection whose normal agrees, with the joints of the other side. One bi-harmonic field
        fills in the rest. The plane comes from joints with partners, else from the surface. The largest component of
        a found normal is positive. So for a normal along x, MirrorTo.TO_NEGATIVE copies from +x to -x.

        heads: (joint_count, 3) the joints at rest, in the frame of the mesh
        names: one line for each joint in UTF-8, or None: joints are paired by their places
        partners: (joint_count,) the joint of the other side, NO_INDEX: find it; or None
        plane: (6,) a point and a normal, or None: find the plane
        joints: (vertex_count, source_influence_count)
        weights: (vertex_count, source_influence_count) >= 0; a vertex whose weights are all 0 gives none
        to: MirrorTo
        distance: as in hf_weights_transfer_desc
        angle: as in hf_weights_transfer_desc
        influence_count: joints of each vertex in the result: 4 or 8; 0: 4
        progress: an object to poll and cancel through
        info: filled in when given
        statistics: filled in when given

        Raises CancelledError, EmptyError, InvalidArgumentError, NonFiniteError, OutOfRangeError, TooLargeError,
        TooSmallError, UnsupportedError.
        """
        c = Call(surface=surface)
        desc = _weights_mirror_desc(c, heads=heads, names=names, partners=partners, plane=plane, joints=joints,
                weights=weights, to=to, distance=distance, angle=angle, influence_count=influence_count,
                progress=progress)
        weights_ = c.struct(_raw.hf_weights_out, {})
        partners_ = c.out(None, 'u4', ('joint_count',), packed=True)
        pairings = c.out(None, 'u4', ('joint_count',), packed=True)

        def run(room: Any, made: Any) -> None:
            c.into(weights_, room, made)
            call('hf_weights_mirror', handle_of(surface, Surface, 'surface'), ref(desc), ref(weights_),
                    address(partners_), address(pairings), ref(info, _raw.hf_weights_mirror_info), ref(statistics,
                    _raw.hf_weights_mirror_statistics))

        found = c.grow(surface, 'hf_weights_mirror', run, lambda: {'vertex_capacity': weights_.vertex_count,
                'influence_count': weights_.influence_count}, {'vertex_capacity': c.n.get('vertex_count')},
                {'joints': (np.uint32, ('vertex_capacity', 'influence_count')), 'weights': (np.float32,
                ('vertex_capacity', 'influence_count')), 'origins': (np.uint8, ('vertex_capacity',))})
        return WeightsOut(**found), partners_, pairings


__all__ = [
    'Base', 'BlendInfluences', 'BlendInfo', 'BlendRows', 'BodySide', 'Certificate', 'Chain', 'ChainMatch',
    'Critical', 'CriticalInfo', 'CriticalPoint', 'CurveKind', 'Cut', 'CutCorner', 'DeformInfo', 'Detail',
    'Direction', 'DirectionStatistics', 'DistanceMethod', 'Extremity', 'ExtremityKind', 'FieldKind', 'Flow',
    'GapsInfo', 'Geodesics', 'Ground', 'HandleInfo', 'HandleProposal', 'HandleReason', 'HelperReason', 'Hit',
    'Isolines', 'JointFlag', 'JointInfo', 'JointKind', 'Levels', 'Link', 'LinkMode', 'LinksInfo',
    'MeshStatistics', 'MirrorPairing', 'MirrorPlane', 'MirrorTo', 'NO_INDEX', 'Operator', 'Ordering', 'PairFlag',
    'PairInfo', 'Path', 'Place', 'Pose', 'PoseInfo', 'PoseStatistics', 'PreviewInfo', 'Progress', 'Quads',
    'QuadsInfo', 'QuadsMesh', 'Region', 'RegionInfo', 'RegionList', 'RegionStatistics', 'Retarget',
    'RetargetInfo', 'RetargetStep', 'Role', 'RootMotion', 'Route', 'ScaleFrom', 'Side', 'Singularity',
    'SitesInfo', 'Skeleton', 'SkeletonInfo', 'SkinInfo', 'SolveInfo', 'Solver', 'SolverInfo', 'SolverStatistics',
    'Streamlines', 'Surface', 'SurfaceInfo', 'SurfaceReport', 'SurfaceStatistics', 'Transfer', 'TransferDials',
    'TransferInfo', 'TransferMode', 'TransferStatistics', 'Transform', 'Weights', 'WeightsInfo',
    'WeightsMirrorInfo', 'WeightsMirrorStatistics', 'WeightsOrigin', 'WeightsOut', 'WeightsStatistics',
    'WeightsTransferInfo', 'Weld'
]
__all__ += _errors.__all__
