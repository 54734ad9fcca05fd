"""Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI as ctypes sees it."""
# fmt: off
from __future__ import annotations

from ctypes import (Array, CDLL, Structure, c_char, c_char_p, c_double, c_float, c_int32, c_size_t, c_uint32, c_void_p, sizeof)
from typing import Any, List

HEADER_VERSION = "0.1.0"

class Struct(Structure):
    """A struct of zeros with its size set, shown with its fields."""

    struct_size: int

    def __init__(self, *values: Any, **fields: Any) -> None:
        super().__init__(*values, **fields)
        if self._fields_[0][0] == "struct_size":
            self.struct_size = sizeof(self)

    def __repr__(self) -> str:
        shown: List[str] = []
        for name, *_ in self._fields_:
            value = getattr(self, name)
            if name not in ("struct_size", "reserved"):
                shown.append(f"{name}={list(value) if hasattr(value, '_length_') else value!r}")
        return f"{type(self).__name__}({', '.join(shown)})"
HF_VERSION_MAJOR = 0
HF_VERSION_MINOR = 1
HF_VERSION_PATCH = 0
HF_NO_INDEX = 4294967295
HF_MESSAGE_SIZE = 256
HF_OK = 0
HF_ERROR_INVALID_ARGUMENT = -1
HF_ERROR_NULL_POINTER = -2
HF_ERROR_INVALID_OBJECT = -3
HF_ERROR_INVALID_DESC = -4
HF_ERROR_OUT_OF_RANGE = -5
HF_ERROR_NON_FINITE = -6
HF_ERROR_EMPTY = -7
HF_ERROR_NOT_FOUND = -8
HF_ERROR_DUPLICATE = -9
HF_ERROR_CONFLICT = -10
HF_ERROR_UNSUPPORTED = -11
HF_ERROR_BUSY = -12
HF_ERROR_REENTRANT = -13
HF_ERROR_TOO_SMALL = -14
HF_ERROR_OUT_OF_MEMORY = -100
HF_ERROR_TOO_LARGE = -101
HF_ERROR_CANCELLED = -102
HF_ERROR_NOT_POSITIVE_DEFINITE = -200
HF_ERROR_INACCURATE = -201
HF_ERROR_INTERNAL = -300
HF_TYPE_PLAIN = 0
HF_TYPE_DOUBLE = 1
HF_TYPE_UINT16 = 2
HF_WELD_EXACT = 0
HF_WELD_NONE = 1
HF_WELD_TOLERANCE = 2
HF_OPERATOR_INTRINSIC_DELAUNAY = 0
HF_OPERATOR_CLAMPED = 1
HF_OPERATOR_UNIFORM = 2
HF_OPERATOR_COTANGENT = 3
HF_OPERATOR_GRAPH = 4
HF_FIELD_HARMONIC = 0
HF_FIELD_BIHARMONIC = 1
HF_FIELD_BIHARMONIC_GRAPH = 2
HF_ORDERING_NESTED_DISSECTION = 0
HF_ORDERING_MINIMUM_DEGREE = 1
HF_ORDERING_METIS = 2
HF_FACTOR_ALIGNMENT = 64
HF_LINK_NONE = 0
HF_LINK_PIECES = 1
HF_LINK_LIST = 2
HF_ROUTE_NONE = 0
HF_ROUTE_DENSE = 1
HF_ROUTE_FRESH = 2
HF_ROUTE_REBASE = 3
HF_LEVELS_VALUE = 0
HF_LEVELS_AREA = 1
HF_LEVELS_LENGTH = 2
HF_CRITICAL_MINIMUM = 0
HF_CRITICAL_MAXIMUM = 1
HF_CRITICAL_SADDLE = 2
HF_GEODESICS_AUTO = 0
HF_GEODESICS_FRONT = 1
HF_GEODESICS_EXACT = 2
HF_GEODESICS_HEAT = 3
HF_EXTREMITIES_POISSON = 0
HF_EXTREMITIES_GEODESIC = 1
HF_LAYER_COUNT = 8
HF_HANDLE_LIMIT = 256
HF_HANDLE_REASON_FOOT = 0
HF_HANDLE_REASON_TIP = 1
HF_HANDLE_REASON_END = 2
HF_HANDLE_REASON_JOINT = 3
HF_HANDLE_REASON_MIDDLE = 4
HF_BASE_DEFAULT = 0
HF_BASE_MEMBRANE = 1
HF_BASE_THIN_PLATE = 2
HF_BASE_THIN_PLATE_GRAPH = 3
HF_SIDE_SMALLER = 0
HF_SIDE_LARGER = 1
HF_SIDE_SEED = 2
HF_CURVE_STRAIGHT = 0
HF_CURVE_EDGES = 1
HF_REGION_INSIDE = 0
HF_REGION_RIM = 1
HF_REGION_SITES = 2
HF_ROOT_MOTION_HIPS = 0
HF_ROOT_MOTION_ROOT = 1
HF_ROOT_MOTION_IN_PLACE = 2
HF_RETARGET_KEEP_RESTS = 1
HF_RETARGET_NO_GOALS = 2
HF_RETARGET_NO_LOCK = 4
HF_RETARGET_NO_COPY = 8
HF_SCALE_GIVEN = 0
HF_SCALE_LEGS = 1
HF_SCALE_HIPS = 2
HF_SCALE_HEIGHT = 3
HF_ROLE_OTHER = 0
HF_ROLE_SPINE = 1
HF_ROLE_NECK = 2
HF_ROLE_HEAD = 3
HF_ROLE_JAW = 4
HF_ROLE_SHOULDER = 5
HF_ROLE_ARM = 6
HF_ROLE_HAND = 7
HF_ROLE_FINGER = 8
HF_ROLE_LEG = 9
HF_ROLE_FOOT = 10
HF_ROLE_TOE = 11
HF_ROLE_TAIL = 12
HF_ROLE_WING = 13
HF_ROLE_EAR = 14
HF_ROLE_EYE = 15
HF_ROLE_ANTENNA = 16
HF_ROLE_FIN = 17
HF_SIDE_MIDDLE = 0
HF_SIDE_LEFT = 1
HF_SIDE_RIGHT = 2
HF_JOINT_KIND_BODY = 0
HF_JOINT_KIND_HELPER = 1
HF_JOINT_KIND_END = 2
HF_JOINT_KIND_TWIST = 3
HF_TRANSFER_FIELDS = 0
HF_TRANSFER_STRETCH = 1
HF_GROUND_KEEP = 0
HF_GROUND_OFF = 1
HF_PAIR_ANCHOR = 1
HF_PAIR_FOOT = 2
HF_PAIR_TRUNK = 4
HF_PAIR_NO_ALIGNMENT = 8
HF_PAIR_CONTACT = 16
HF_PAIR_SINKS = 32
HF_PAIR_NECK = 64
HF_PAIR_TAIL = 128
HF_PAIR_ARM = 256
HF_PAIR_LIMIT = 256
HF_WEIGHTS_INFORMED = 0
HF_WEIGHTS_SOLVED = 1
HF_WEIGHTS_PINNED = 2
HF_WEIGHTS_NEAREST = 3
HF_WEIGHTS_RIGID = 4
HF_WEIGHTS_ISOLATED = 5
HF_WEIGHTS_MATCHED = 6
HF_WEIGHTS_KEPT = 7
HF_JOINT_NO_LENGTH = 1
HF_JOINT_COINCIDENT = 2
HF_JOINT_INFORMS_NONE = 4
HF_JOINT_OUTSIDE = 8
HF_JOINT_HELPER = 16
HF_HELPER_PROPOSED = 1
HF_HELPER_NAME_ROOT = 2
HF_HELPER_NAME_CONTROL = 4
HF_HELPER_NAME_END = 8
HF_HELPER_ROOT = 16
HF_HELPER_APART = 32
HF_HELPER_NO_LENGTH = 64
HF_HELPER_COINCIDENT = 128
HF_HELPER_OUTSIDE = 256
HF_HELPER_INFORMS_NONE = 512
HF_MIRROR_TO_NEGATIVE = 0
HF_MIRROR_TO_POSITIVE = 1
HF_MIRROR_BOTH = 2
HF_MIRROR_PLANE_GIVEN = 0
HF_MIRROR_PLANE_JOINTS = 1
HF_MIRROR_PLANE_SURFACE = 2
HF_MIRROR_JOINT_ALONE = 0
HF_MIRROR_JOINT_NAMED = 1
HF_MIRROR_JOINT_PLACED = 2
HF_MIRROR_JOINT_CENTRE = 3
HF_MIRROR_JOINT_GIVEN = 4

RESULT_NAMES = {
    0: "HF_OK",
    -1: "HF_ERROR_INVALID_ARGUMENT",
    -2: "HF_ERROR_NULL_POINTER",
    -3: "HF_ERROR_INVALID_OBJECT",
    -4: "HF_ERROR_INVALID_DESC",
    -5: "HF_ERROR_OUT_OF_RANGE",
    -6: "HF_ERROR_NON_FINITE",
    -7: "HF_ERROR_EMPTY",
    -8: "HF_ERROR_NOT_FOUND",
    -9: "HF_ERROR_DUPLICATE",
    -10: "HF_ERROR_CONFLICT",
    -11: "HF_ERROR_UNSUPPORTED",
    -12: "HF_ERROR_BUSY",
    -13: "HF_ERROR_REENTRANT",
    -14: "HF_ERROR_TOO_SMALL",
    -100: "HF_ERROR_OUT_OF_MEMORY",
    -101: "HF_ERROR_TOO_LARGE",
    -102: "HF_ERROR_CANCELLED",
    -200: "HF_ERROR_NOT_POSITIVE_DEFINITE",
    -201: "HF_ERROR_INACCURATE",
    -300: "HF_ERROR_INTERNAL",
}


class hf_array(Struct):
    """An array of yours that the library reads"""
    data: int
    count: int
    stride: int
    type: int
    reserved: int
    _fields_ = [("data", c_void_p), ("count", c_uint32), ("stride", c_uint32), ("type", c_int32), ("reserved",
                c_uint32)]


class hf_array_out(Struct):
    """An array of yours that the library writes."""
    data: int
    count: int
    stride: int
    type: int
    reserved: int
    _fields_ = [("data", c_void_p), ("count", c_uint32), ("stride", c_uint32), ("type", c_int32), ("reserved",
                c_uint32)]


class hf_error_detail(Struct):
    """Details of the last failed call on this thread."""
    code: int
    index: int
    function: bytes
    message: bytes
    _fields_ = [("code", c_int32), ("index", c_uint32), ("function", c_char * 48), ("message", c_char * 256)]


class hf_allocator(Struct):
    """Your allocator, which serves a surface and everything made from it."""
    allocate: int
    release: int
    user: int
    _fields_ = [("allocate", c_void_p), ("release", c_void_p), ("user", c_void_p)]


class hf_job_runner(Struct):
    """Your job system."""
    run: int
    user: int
    _fields_ = [("run", c_void_p), ("user", c_void_p)]


class hf_factor_desc(Struct):
    """A factor that hf_surface_save wrote."""
    struct_size: int
    borrow: int
    bytes: int
    byte_count: int
    _fields_ = [("struct_size", c_uint32), ("borrow", c_int32), ("bytes", c_void_p), ("byte_count", c_size_t)]


class hf_link(Struct):
    """A spring from a vertex to a point of a triangle."""
    vertex: int
    corners: Array[c_uint32]
    barycentrics: Array[c_double]
    length: float
    weight: float
    in_tree: int
    reserved: int
    _fields_ = [("vertex", c_uint32), ("corners", c_uint32 * 3), ("barycentrics", c_double * 3), ("length", c_double),
                ("weight", c_double), ("in_tree", c_int32), ("reserved", c_uint32)]


class hf_links_desc(Struct):
    """Says which pieces to link."""
    struct_size: int
    mode: int
    distance: float
    stiffness: float
    overlay_distance: float
    influence_count: int
    link_count: int
    light_count: int
    heavy_count: int
    joint_count: int
    reserved: int
    joints: int
    weights: int
    joint_parents: int
    tags: int
    links: int
    light_vertices: int
    heavy_vertices: int
    _fields_ = [("struct_size", c_uint32), ("mode", c_int32), ("distance", c_double), ("stiffness", c_double),
                ("overlay_distance", c_double), ("influence_count", c_uint32), ("link_count", c_uint32),
                ("light_count", c_uint32), ("heavy_count", c_uint32), ("joint_count", c_uint32), ("reserved",
                c_uint32), ("joints", c_void_p), ("weights", c_void_p), ("joint_parents", c_void_p), ("tags",
                c_void_p), ("links", c_void_p), ("light_vertices", c_void_p), ("heavy_vertices", c_void_p)]


class hf_faces_desc(Struct):
    """Faces of any number of corners."""
    struct_size: int
    reserved: int
    corners: hf_array
    sizes: hf_array
    starts: hf_array
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("corners", hf_array), ("sizes", hf_array),
                ("starts", hf_array)]


class hf_surface_desc(Struct):
    """The mesh and the options of a surface."""
    struct_size: int
    weld: int
    positions: hf_array
    triangles: hf_array
    faces: int
    weld_tolerance: float
    operator_kind: int
    field_kind: int
    ordering: int
    thread_count: int
    vertex_limit: int
    triangle_limit: int
    memory_limit_mb: int
    work_limit_gflop: int
    allocator: hf_allocator
    job_runner: hf_job_runner
    progress: int
    saved_factor: int
    links: int
    _fields_ = [("struct_size", c_uint32), ("weld", c_int32), ("positions", hf_array), ("triangles", hf_array),
                ("faces", c_void_p), ("weld_tolerance", c_double), ("operator_kind", c_int32), ("field_kind",
                c_int32), ("ordering", c_int32), ("thread_count", c_uint32), ("vertex_limit", c_uint32),
                ("triangle_limit", c_uint32), ("memory_limit_mb", c_uint32), ("work_limit_gflop", c_uint32),
                ("allocator", hf_allocator), ("job_runner", hf_job_runner), ("progress", c_void_p), ("saved_factor",
                c_void_p), ("links", c_void_p)]


class hf_graph_desc(Struct):
    """A graph of your own and the options of its surface"""
    struct_size: int
    vertex_count: int
    edges: hf_array
    weights: hf_array
    masses: hf_array
    allow_negative: int
    field_kind: int
    ordering: int
    thread_count: int
    vertex_limit: int
    edge_limit: int
    memory_limit_mb: int
    work_limit_gflop: int
    allocator: hf_allocator
    job_runner: hf_job_runner
    progress: int
    saved_factor: int
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("edges", hf_array), ("weights", hf_array),
                ("masses", hf_array), ("allow_negative", c_int32), ("field_kind", c_int32), ("ordering", c_int32),
                ("thread_count", c_uint32), ("vertex_limit", c_uint32), ("edge_limit", c_uint32), ("memory_limit_mb",
                c_uint32), ("work_limit_gflop", c_uint32), ("allocator", hf_allocator), ("job_runner", hf_job_runner),
                ("progress", c_void_p), ("saved_factor", c_void_p)]


class hf_surface_info(Struct):
    """The options a surface was made with, defaults filled in."""
    struct_size: int
    vertex_count: int
    triangle_count: int
    weld: int
    weld_tolerance: float
    operator_kind: int
    field_kind: int
    ordering: int
    thread_count: int
    vertex_limit: int
    triangle_limit: int
    memory_limit_mb: int
    work_limit_gflop: int
    edge_count: int
    edge_limit: int
    face_count: int
    corner_count: int
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("triangle_count", c_uint32), ("weld",
                c_int32), ("weld_tolerance", c_double), ("operator_kind", c_int32), ("field_kind", c_int32),
                ("ordering", c_int32), ("thread_count", c_uint32), ("vertex_limit", c_uint32), ("triangle_limit",
                c_uint32), ("memory_limit_mb", c_uint32), ("work_limit_gflop", c_uint32), ("edge_count", c_uint32),
                ("edge_limit", c_uint32), ("face_count", c_uint32), ("corner_count", c_uint32)]


class hf_surface_report(Struct):
    """Counts that the surface found in the mesh."""
    struct_size: int
    vertex_count: int
    triangle_count: int
    welded_vertex_count: int
    component_count: int
    isolated_vertex_count: int
    degenerate_triangle_count: int
    collapsed_triangle_count: int
    duplicate_triangle_count: int
    non_manifold_edge_count: int
    flipped_edge_count: int
    boundary_edge_count: int
    inside_out_count: int
    first_inside_out_vertex: int
    bounding_box_diagonal: float
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("triangle_count", c_uint32),
                ("welded_vertex_count", c_uint32), ("component_count", c_uint32), ("isolated_vertex_count", c_uint32),
                ("degenerate_triangle_count", c_uint32), ("collapsed_triangle_count", c_uint32),
                ("duplicate_triangle_count", c_uint32), ("non_manifold_edge_count", c_uint32), ("flipped_edge_count",
                c_uint32), ("boundary_edge_count", c_uint32), ("inside_out_count", c_uint32),
                ("first_inside_out_vertex", c_uint32), ("bounding_box_diagonal", c_double)]


class hf_mesh_statistics(Struct):
    """Figures of a mesh for developers"""
    struct_size: int
    polygon_count: int
    non_planar_count: int
    largest_face: int
    negative_edge_count: int
    changed_vertex_count: int
    first_changed_vertex: int
    reserved: int
    smallest_angle: float
    _fields_ = [("struct_size", c_uint32), ("polygon_count", c_uint32), ("non_planar_count", c_uint32),
                ("largest_face", c_uint32), ("negative_edge_count", c_uint32), ("changed_vertex_count", c_uint32),
                ("first_changed_vertex", c_uint32), ("reserved", c_uint32), ("smallest_angle", c_double)]


class hf_links_info(Struct):
    """How the pieces of a mesh are linked."""
    struct_size: int
    piece_count: int
    link_count: int
    light_piece_count: int
    lone_piece_count: int
    contact_count: int
    longest_tree_link: float
    _fields_ = [("struct_size", c_uint32), ("piece_count", c_uint32), ("link_count", c_uint32), ("light_piece_count",
                c_uint32), ("lone_piece_count", c_uint32), ("contact_count", c_uint32), ("longest_tree_link",
                c_double)]


class hf_gaps_info(Struct):
    """How far linked pieces have opened, in the unit of the positions."""
    struct_size: int
    link_count: int
    percentile_95: float
    worst: float
    worst_link: int
    contact_count: int
    worst_contact: float
    contact_vertex: int
    touching_count: int
    worst_opening: float
    opening_vertex: int
    reserved: int
    _fields_ = [("struct_size", c_uint32), ("link_count", c_uint32), ("percentile_95", c_double), ("worst", c_double),
                ("worst_link", c_uint32), ("contact_count", c_uint32), ("worst_contact", c_double), ("contact_vertex",
                c_uint32), ("touching_count", c_uint32), ("worst_opening", c_double), ("opening_vertex", c_uint32),
                ("reserved", c_uint32)]


class hf_patch_desc(Struct):
    """Lists triangles that go, vertices and triangles that come in, and edges to cut along."""
    struct_size: int
    removed_triangle_count: int
    new_vertex_count: int
    new_triangle_count: int
    cut_edge_count: int
    reserved: int
    removed_triangles: int
    new_positions: int
    new_triangles: int
    cut_edges: int
    _fields_ = [("struct_size", c_uint32), ("removed_triangle_count", c_uint32), ("new_vertex_count", c_uint32),
                ("new_triangle_count", c_uint32), ("cut_edge_count", c_uint32), ("reserved", c_uint32),
                ("removed_triangles", c_void_p), ("new_positions", c_void_p), ("new_triangles", c_void_p),
                ("cut_edges", c_void_p)]


class hf_surface_edit_desc(Struct):
    """Lists the changes of hf_surface_edit"""
    struct_size: int
    vertex_count: int
    vertices: int
    stiffness: int
    link_count: int
    removed_link_count: int
    links: int
    removed_links: int
    patch: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("vertices", c_void_p), ("stiffness",
                c_void_p), ("link_count", c_uint32), ("removed_link_count", c_uint32), ("links", c_void_p),
                ("removed_links", c_void_p), ("patch", c_void_p), ("progress", c_void_p)]


class hf_cut_corner(Struct):
    """A corner of a triangle that a cut gave another vertex."""
    triangle: int
    corner: int
    vertex: int
    copied: int
    _fields_ = [("triangle", c_uint32), ("corner", c_uint32), ("vertex", c_uint32), ("copied", c_uint32)]


class hf_surface_statistics(Struct):
    """hf_surface_get_statistics writes sizes and times of a surface here."""
    struct_size: int
    unknown_count: int
    weld_ms: float
    operator_ms: float
    ordering_ms: float
    symbolic_ms: float
    numeric_ms: float
    factor_entries: float
    factor_bytes: float
    factor_flops: float
    memory_bytes: float
    peak_memory_bytes: float
    load_ms: float
    factor_loaded: int
    factor_borrowed: int
    links_ms: float
    _fields_ = [("struct_size", c_uint32), ("unknown_count", c_uint32), ("weld_ms", c_double), ("operator_ms",
                c_double), ("ordering_ms", c_double), ("symbolic_ms", c_double), ("numeric_ms", c_double),
                ("factor_entries", c_double), ("factor_bytes", c_double), ("factor_flops", c_double), ("memory_bytes",
                c_double), ("peak_memory_bytes", c_double), ("load_ms", c_double), ("factor_loaded", c_int32),
                ("factor_borrowed", c_int32), ("links_ms", c_double)]


class hf_place(Struct):
    """A place on a surface"""
    corners: Array[c_uint32]
    reserved: int
    barycentrics: Array[c_double]
    _fields_ = [("corners", c_uint32 * 3), ("reserved", c_uint32), ("barycentrics", c_double * 3)]


class hf_cut_desc(Struct):
    """Describes the line of a knife"""
    struct_size: int
    point_count: int
    vertices: int
    places: int
    points: int
    snap_share: float
    crossing_limit: int
    reserved: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("point_count", c_uint32), ("vertices", c_void_p), ("places", c_void_p),
                ("points", c_void_p), ("snap_share", c_double), ("crossing_limit", c_uint32), ("reserved", c_uint32),
                ("progress", c_void_p)]


class hf_cut(Struct):
    """A cut as triangles that go and come."""
    struct_size: int
    removed_triangle_capacity: int
    new_vertex_capacity: int
    new_triangle_capacity: int
    rim_capacity: int
    removed_triangle_count: int
    new_vertex_count: int
    new_triangle_count: int
    rim_count: int
    reserved: int
    removed_triangles: int
    new_positions: int
    new_triangles: int
    vertex_corners: int
    vertex_barycentrics: int
    source_triangles: int
    corner_barycentrics: int
    rim_vertices: int
    _fields_ = [("struct_size", c_uint32), ("removed_triangle_capacity", c_uint32), ("new_vertex_capacity", c_uint32),
                ("new_triangle_capacity", c_uint32), ("rim_capacity", c_uint32), ("removed_triangle_count", c_uint32),
                ("new_vertex_count", c_uint32), ("new_triangle_count", c_uint32), ("rim_count", c_uint32),
                ("reserved", c_uint32), ("removed_triangles", c_void_p), ("new_positions", c_void_p),
                ("new_triangles", c_void_p), ("vertex_corners", c_void_p), ("vertex_barycentrics", c_void_p),
                ("source_triangles", c_void_p), ("corner_barycentrics", c_void_p), ("rim_vertices", c_void_p)]


class hf_pick_desc(Struct):
    """Options of picking"""
    struct_size: int
    front_only: int
    positions: hf_array
    _fields_ = [("struct_size", c_uint32), ("front_only", c_int32), ("positions", hf_array)]


class hf_hit(Struct):
    """hf_surface_cast_ray writes the first triangle that a ray hits here."""
    struct_size: int
    found: int
    triangle: int
    vertex: int
    place: hf_place
    position: Array[c_double]
    distance: float
    _fields_ = [("struct_size", c_uint32), ("found", c_int32), ("triangle", c_uint32), ("vertex", c_uint32), ("place",
                hf_place), ("position", c_double * 3), ("distance", c_double)]


class hf_solver_desc(Struct):
    struct_size: int
    field_kind: int
    channel_count: int
    site_limit: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("field_kind", c_int32), ("channel_count", c_uint32), ("site_limit",
                c_uint32), ("progress", c_void_p)]


class hf_solver_info(Struct):
    """hf_solver_get_info writes the options of a solver here, with defaults filled in, and the number of its sites."""
    struct_size: int
    field_kind: int
    channel_count: int
    site_limit: int
    site_count: int
    vertex_count: int
    _fields_ = [("struct_size", c_uint32), ("field_kind", c_int32), ("channel_count", c_uint32), ("site_limit",
                c_uint32), ("site_count", c_uint32), ("vertex_count", c_uint32)]


class hf_sites_desc(Struct):
    """Places and values of sites."""
    struct_size: int
    site_count: int
    vertices: int
    places: int
    points: int
    values: int
    stiffness: int
    radii: int
    _fields_ = [("struct_size", c_uint32), ("site_count", c_uint32), ("vertices", c_void_p), ("places", c_void_p),
                ("points", c_void_p), ("values", c_void_p), ("stiffness", c_void_p), ("radii", c_void_p)]


class hf_edit_desc(Struct):
    """One batch of edits, applied in the order remove, move, set, add."""
    struct_size: int
    remove_count: int
    remove_sites: int
    move_count: int
    set_count: int
    move_sites: int
    move_to: int
    set_sites: int
    set_values: int
    add: int
    _fields_ = [("struct_size", c_uint32), ("remove_count", c_uint32), ("remove_sites", c_void_p), ("move_count",
                c_uint32), ("set_count", c_uint32), ("move_sites", c_void_p), ("move_to", c_void_p), ("set_sites",
                c_void_p), ("set_values", c_void_p), ("add", c_void_p)]


class hf_sites_info(Struct):
    """Places, values and fluxes of the sites."""
    struct_size: int
    capacity: int
    count: int
    reserved: int
    sites: int
    vertices: int
    components: int
    values: int
    stiffness: int
    flux: int
    radii: int
    _fields_ = [("struct_size", c_uint32), ("capacity", c_uint32), ("count", c_uint32), ("reserved", c_uint32),
                ("sites", c_void_p), ("vertices", c_void_p), ("components", c_void_p), ("values", c_void_p),
                ("stiffness", c_void_p), ("flux", c_void_p), ("radii", c_void_p)]


class hf_solve_info(Struct):
    """The components that the sites of a solve did not reach."""
    struct_size: int
    unreached_component_count: int
    first_unreached_component: int
    unreached_vertex_count: int
    _fields_ = [("struct_size", c_uint32), ("unreached_component_count", c_uint32), ("first_unreached_component",
                c_uint32), ("unreached_vertex_count", c_uint32)]


class hf_preview_info(Struct):
    """Counts and errors of a preview."""
    struct_size: int
    exact: int
    correction_count: int
    unreached_component_count: int
    value_range: float
    largest_correction: float
    error_estimate: float
    preview_bytes: float
    _fields_ = [("struct_size", c_uint32), ("exact", c_int32), ("correction_count", c_uint32),
                ("unreached_component_count", c_uint32), ("value_range", c_double), ("largest_correction", c_double),
                ("error_estimate", c_double), ("preview_bytes", c_double)]


class hf_certificate(Struct):
    """The certificate says how accurate a field is."""
    struct_size: int
    overshoot_checked: int
    tolerance: float
    value_range: float
    residual: float
    site_error: float
    overshoot: float
    worst_vertex: int
    changed_vertex_count: int
    error_estimate: float
    _fields_ = [("struct_size", c_uint32), ("overshoot_checked", c_int32), ("tolerance", c_double), ("value_range",
                c_double), ("residual", c_double), ("site_error", c_double), ("overshoot", c_double), ("worst_vertex",
                c_uint32), ("changed_vertex_count", c_uint32), ("error_estimate", c_double)]


class hf_solver_statistics(Struct):
    """Counts, memory and cost estimates of a solver."""
    struct_size: int
    site_count: int
    factorisation_count: int
    path_solve_count: int
    sweep_count: int
    last_route: int
    rebase_count: int
    dense_edit_count: int
    dense_row_count: int
    eliminated_count: int
    rebase_advised: int
    reserved: int
    site_memory_bytes: float
    predicted_dense_ms: float
    predicted_rebase_ms: float
    _fields_ = [("struct_size", c_uint32), ("site_count", c_uint32), ("factorisation_count", c_uint32),
                ("path_solve_count", c_uint32), ("sweep_count", c_uint32), ("last_route", c_uint32), ("rebase_count",
                c_uint32), ("dense_edit_count", c_uint32), ("dense_row_count", c_uint32), ("eliminated_count",
                c_uint32), ("rebase_advised", c_int32), ("reserved", c_uint32), ("site_memory_bytes", c_double),
                ("predicted_dense_ms", c_double), ("predicted_rebase_ms", c_double)]


class hf_isolines(Struct):
    """Iso-lines as polylines."""
    struct_size: int
    point_capacity: int
    line_capacity: int
    point_count: int
    line_count: int
    reserved: int
    point_edges: int
    parameters: int
    positions: int
    line_starts: int
    line_levels: int
    line_closed: int
    _fields_ = [("struct_size", c_uint32), ("point_capacity", c_uint32), ("line_capacity", c_uint32), ("point_count",
                c_uint32), ("line_count", c_uint32), ("reserved", c_uint32), ("point_edges", c_void_p), ("parameters",
                c_void_p), ("positions", c_void_p), ("line_starts", c_void_p), ("line_levels", c_void_p),
                ("line_closed", c_void_p)]


class hf_critical_point(Struct):
    vertex: int
    kind: int
    index: int
    component: int
    value: float
    _fields_ = [("vertex", c_uint32), ("kind", c_int32), ("index", c_int32), ("component", c_uint32), ("value",
                c_double)]


class hf_critical_info(Struct):
    struct_size: int
    point_count: int
    minimum_count: int
    maximum_count: int
    saddle_count: int
    index_sum: int
    euler_characteristic: int
    reserved: int
    _fields_ = [("struct_size", c_uint32), ("point_count", c_uint32), ("minimum_count", c_uint32), ("maximum_count",
                c_uint32), ("saddle_count", c_uint32), ("index_sum", c_int32), ("euler_characteristic", c_int32),
                ("reserved", c_uint32)]


class hf_geodesics_desc(Struct):
    struct_size: int
    method: int
    smoothing: float
    progress: int
    _fields_ = [("struct_size", c_uint32), ("method", c_int32), ("smoothing", c_double), ("progress", c_void_p)]


class hf_path(Struct):
    """A path along the surface, from its first point to its last."""
    struct_size: int
    point_capacity: int
    point_count: int
    reserved: int
    length: float
    point_edges: int
    parameters: int
    positions: int
    _fields_ = [("struct_size", c_uint32), ("point_capacity", c_uint32), ("point_count", c_uint32), ("reserved",
                c_uint32), ("length", c_double), ("point_edges", c_void_p), ("parameters", c_void_p), ("positions",
                c_void_p)]


class hf_extremities_desc(Struct):
    struct_size: int
    kind: int
    least_length_share: float
    source_count: int
    reserved: int
    geodesics: int
    progress: int
    out_field: int
    _fields_ = [("struct_size", c_uint32), ("kind", c_int32), ("least_length_share", c_double), ("source_count",
                c_uint32), ("reserved", c_uint32), ("geodesics", c_void_p), ("progress", c_void_p), ("out_field",
                c_void_p)]


class hf_extremity(Struct):
    vertex: int
    component: int
    length: float
    position: Array[c_double]
    _fields_ = [("vertex", c_uint32), ("component", c_uint32), ("length", c_double), ("position", c_double * 3)]


class hf_direction_desc(Struct):
    struct_size: int
    degree: int
    site_limit: int
    reserved: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("degree", c_uint32), ("site_limit", c_uint32), ("reserved", c_uint32),
                ("progress", c_void_p)]


class hf_singularity(Struct):
    """A singularity is a triangle, or a face, around which the field makes extra turns."""
    triangle: int
    vertex: int
    index: int
    _fields_ = [("triangle", c_uint32), ("vertex", c_uint32), ("index", c_int32)]


class hf_direction_statistics(Struct):
    """The options a direction field was made with, and counts of its constraints and of the work done so far."""
    struct_size: int
    degree: int
    site_limit: int
    unknown_count: int
    site_count: int
    factorisation_count: int
    path_solve_count: int
    sweep_count: int
    irregular_vertex_count: int
    eliminated_count: int
    operator_ms: float
    numeric_ms: float
    factor_entries: float
    factor_bytes: float
    site_memory_bytes: float
    _fields_ = [("struct_size", c_uint32), ("degree", c_uint32), ("site_limit", c_uint32), ("unknown_count",
                c_uint32), ("site_count", c_uint32), ("factorisation_count", c_uint32), ("path_solve_count",
                c_uint32), ("sweep_count", c_uint32), ("irregular_vertex_count", c_uint32), ("eliminated_count",
                c_uint32), ("operator_ms", c_double), ("numeric_ms", c_double), ("factor_entries", c_double),
                ("factor_bytes", c_double), ("site_memory_bytes", c_double)]


class hf_pose_desc(Struct):
    struct_size: int
    band_count: int
    iteration_count: int
    group_count: int
    _fields_ = [("struct_size", c_uint32), ("band_count", c_uint32), ("iteration_count", c_uint32), ("group_count",
                c_uint32)]


class hf_pose_info(Struct):
    """hf_pose_get_info writes the options of a pose here, with defaults filled in, and the number of its handles."""
    struct_size: int
    band_count: int
    iteration_count: int
    group_count: int
    handle_count: int
    vertex_count: int
    _fields_ = [("struct_size", c_uint32), ("band_count", c_uint32), ("iteration_count", c_uint32), ("group_count",
                c_uint32), ("handle_count", c_uint32), ("vertex_count", c_uint32)]


class hf_handles_desc(Struct):
    """The handles to add."""
    struct_size: int
    handle_count: int
    region_counts: int
    region_vertices: int
    vertices: int
    places: int
    points: int
    radii: int
    layer: int
    in_place: int
    free_rotation: int
    reserved: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("handle_count", c_uint32), ("region_counts", c_void_p),
                ("region_vertices", c_void_p), ("vertices", c_void_p), ("places", c_void_p), ("points", c_void_p),
                ("radii", c_void_p), ("layer", c_uint32), ("in_place", c_int32), ("free_rotation", c_int32),
                ("reserved", c_uint32), ("progress", c_void_p)]


class hf_transform(Struct):
    """A rigid motion of a handle from its rest place."""
    rotation: Array[c_double]
    translation: Array[c_double]
    _fields_ = [("rotation", c_double * 4), ("translation", c_double * 3)]


class hf_handle_info(Struct):
    """hf_pose_get_handle writes the region of a handle here, its layer, and its motion in the last hf_deform."""
    struct_size: int
    vertex_count: int
    site_count: int
    component: int
    centroid: Array[c_double]
    leak: float
    rotation: Array[c_double]
    translation: Array[c_double]
    layer: int
    free_rotation: int
    following: float
    limb_refine: int
    reserved: int
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("site_count", c_uint32), ("component",
                c_uint32), ("centroid", c_double * 3), ("leak", c_double), ("rotation", c_double * 4), ("translation",
                c_double * 3), ("layer", c_uint32), ("free_rotation", c_int32), ("following", c_double),
                ("limb_refine", c_int32), ("reserved", c_uint32)]


class hf_deform_info(Struct):
    """The work of a deform."""
    struct_size: int
    iteration_count: int
    unreached_vertex_count: int
    reserved: int
    last_change: float
    _fields_ = [("struct_size", c_uint32), ("iteration_count", c_uint32), ("unreached_vertex_count", c_uint32),
                ("reserved", c_uint32), ("last_change", c_double)]


class hf_deform_desc(Struct):
    """The options of hf_pose_deform are outputs and a range of vertices."""
    struct_size: int
    iteration_count: int
    positions: hf_array_out
    normals: hf_array_out
    restart: int
    refine: int
    refine_from_last: int
    first_vertex: int
    vertex_count: int
    reserved: int
    _fields_ = [("struct_size", c_uint32), ("iteration_count", c_uint32), ("positions", hf_array_out), ("normals",
                hf_array_out), ("restart", c_int32), ("refine", c_int32), ("refine_from_last", c_int32),
                ("first_vertex", c_uint32), ("vertex_count", c_uint32), ("reserved", c_uint32)]


class hf_pose_statistics(Struct):
    """Size of a pose and times of its last deform, in milliseconds; 0 before the first."""
    struct_size: int
    cluster_count: int
    solve_ms: float
    blend_ms: float
    normal_ms: float
    refine_ms: float
    _fields_ = [("struct_size", c_uint32), ("cluster_count", c_uint32), ("solve_ms", c_double), ("blend_ms",
                c_double), ("normal_ms", c_double), ("refine_ms", c_double)]


class hf_skin_info(Struct):
    """This struct receives a pose or a transfer as a skin for linear blend skinning."""
    struct_size: int
    joint_capacity: int
    vertex_capacity: int
    influence_count: int
    joint_count: int
    vertex_count: int
    pivots: int
    rotations: int
    translations: int
    axes: int
    scales: int
    vertex_joints: int
    vertex_weights: int
    _fields_ = [("struct_size", c_uint32), ("joint_capacity", c_uint32), ("vertex_capacity", c_uint32),
                ("influence_count", c_uint32), ("joint_count", c_uint32), ("vertex_count", c_uint32), ("pivots",
                c_void_p), ("rotations", c_void_p), ("translations", c_void_p), ("axes", c_void_p), ("scales",
                c_void_p), ("vertex_joints", c_void_p), ("vertex_weights", c_void_p)]


class hf_blend_info(Struct):
    """hf_pose_get_blend_info writes here how the last frame of a pose is blended."""
    struct_size: int
    cluster_count: int
    revision: int
    reserved: int
    offset_share: float
    centre: Array[c_double]
    low: Array[c_double]
    high: Array[c_double]
    _fields_ = [("struct_size", c_uint32), ("cluster_count", c_uint32), ("revision", c_uint32), ("reserved",
                c_uint32), ("offset_share", c_double), ("centre", c_double * 3), ("low", c_double * 3), ("high",
                c_double * 3)]


class hf_blend_rows(Struct):
    """Receives the rows of a blend."""
    struct_size: int
    vertex_capacity: int
    entry_capacity: int
    vertex_count: int
    entry_count: int
    longest_row: int
    rows: int
    clusters: int
    weights: int
    gradients: int
    positions: int
    normals: int
    offsets: int
    _fields_ = [("struct_size", c_uint32), ("vertex_capacity", c_uint32), ("entry_capacity", c_uint32),
                ("vertex_count", c_uint32), ("entry_count", c_uint32), ("longest_row", c_uint32), ("rows", c_void_p),
                ("clusters", c_void_p), ("weights", c_void_p), ("gradients", c_void_p), ("positions", c_void_p),
                ("normals", c_void_p), ("offsets", c_void_p)]


class hf_blend_influences(Struct):
    """Receives a blend as rows of one length, as vertex buffers of engines have them (JOINTS_0 and WEIGHTS_0 of glTF)."""
    struct_size: int
    vertex_capacity: int
    influence_count: int
    vertex_count: int
    change: float
    byte_change: float
    error: float
    byte_error: float
    clusters: int
    weights: int
    byte_clusters: int
    byte_weights: int
    _fields_ = [("struct_size", c_uint32), ("vertex_capacity", c_uint32), ("influence_count", c_uint32),
                ("vertex_count", c_uint32), ("change", c_double), ("byte_change", c_double), ("error", c_double),
                ("byte_error", c_double), ("clusters", c_void_p), ("weights", c_void_p), ("byte_clusters", c_void_p),
                ("byte_weights", c_void_p)]


class hf_handle_proposals_desc(Struct):
    struct_size: int
    joint_count: int
    joints: int
    parents: int
    skeleton: int
    up: Array[c_double]
    least_length_share: float
    limit: int
    reserved: int
    progress: int
    out_regions: int
    _fields_ = [("struct_size", c_uint32), ("joint_count", c_uint32), ("joints", c_void_p), ("parents", c_void_p),
                ("skeleton", c_void_p), ("up", c_double * 3), ("least_length_share", c_double), ("limit", c_uint32),
                ("reserved", c_uint32), ("progress", c_void_p), ("out_regions", c_void_p)]


class hf_handle_proposal(Struct):
    """One proposed handle."""
    vertex: int
    component: int
    reason: int
    pinned: int
    joint: int
    role: int
    side: int
    reserved: int
    position: Array[c_double]
    radius: float
    length: float
    following: float
    _fields_ = [("vertex", c_uint32), ("component", c_uint32), ("reason", c_int32), ("pinned", c_int32), ("joint",
                c_uint32), ("role", c_int32), ("side", c_int32), ("reserved", c_uint32), ("position", c_double * 3),
                ("radius", c_double), ("length", c_double), ("following", c_double)]


class hf_quads_desc(Struct):
    """Options of a quad mesh."""
    struct_size: int
    face_count: int
    edge_length: float
    crease_angle: float
    relax_count: int
    crease_count: int
    guide_count: int
    irregular_count: int
    symmetry_plane: Array[c_double]
    crease_edges: int
    guide_vertices: int
    guide_vectors: int
    guide_weights: int
    irregular_points: int
    irregular_valences: int
    irregular_directions: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("face_count", c_uint32), ("edge_length", c_double), ("crease_angle",
                c_double), ("relax_count", c_uint32), ("crease_count", c_uint32), ("guide_count", c_uint32),
                ("irregular_count", c_uint32), ("symmetry_plane", c_double * 4), ("crease_edges", c_void_p),
                ("guide_vertices", c_void_p), ("guide_vectors", c_void_p), ("guide_weights", c_void_p),
                ("irregular_points", c_void_p), ("irregular_valences", c_void_p), ("irregular_directions", c_void_p),
                ("progress", c_void_p)]


class hf_quads_info(Struct):
    """Counts of a quad mesh."""
    struct_size: int
    vertex_count: int
    face_count: int
    euler_characteristic: int
    edge_length: float
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("face_count", c_uint32),
                ("euler_characteristic", c_int32), ("edge_length", c_double)]


class hf_quads_mesh(Struct):
    """hf_quads_get_mesh writes the quad mesh to these arrays."""
    struct_size: int
    vertex_capacity: int
    face_capacity: int
    vertex_count: int
    face_count: int
    reserved: int
    positions: int
    faces: int
    triangles: int
    barycentrics: int
    corners: int
    _fields_ = [("struct_size", c_uint32), ("vertex_capacity", c_uint32), ("face_capacity", c_uint32),
                ("vertex_count", c_uint32), ("face_count", c_uint32), ("reserved", c_uint32), ("positions", c_void_p),
                ("faces", c_void_p), ("triangles", c_void_p), ("barycentrics", c_void_p), ("corners", c_void_p)]


class hf_streamlines(Struct):
    struct_size: int
    wanted_count: int
    seed_count: int
    point_capacity: int
    line_capacity: int
    point_count: int
    line_count: int
    reserved: int
    seeds: int
    positions: int
    values: int
    line_starts: int
    line_ends: int
    _fields_ = [("struct_size", c_uint32), ("wanted_count", c_uint32), ("seed_count", c_uint32), ("point_capacity",
                c_uint32), ("line_capacity", c_uint32), ("point_count", c_uint32), ("line_count", c_uint32),
                ("reserved", c_uint32), ("seeds", c_void_p), ("positions", c_void_p), ("values", c_void_p),
                ("line_starts", c_void_p), ("line_ends", c_void_p)]


class hf_region_desc(Struct):
    struct_size: int
    base: int
    positions: hf_array
    progress: int
    _fields_ = [("struct_size", c_uint32), ("base", c_int32), ("positions", hf_array), ("progress", c_void_p)]


class hf_curve_desc(Struct):
    """Describes a closed curve through at least 3 points, on the mesh at rest."""
    struct_size: int
    point_count: int
    vertices: int
    places: int
    points: int
    side: int
    seed_vertex: int
    kind: int
    reserved: int
    _fields_ = [("struct_size", c_uint32), ("point_count", c_uint32), ("vertices", c_void_p), ("places", c_void_p),
                ("points", c_void_p), ("side", c_int32), ("seed_vertex", c_uint32), ("kind", c_int32), ("reserved",
                c_uint32)]


class hf_region_edit_desc(Struct):
    """A change of a region."""
    struct_size: int
    ring_count: int
    curve: int
    remove_count: int
    add_count: int
    remove_vertices: int
    add_vertices: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("ring_count", c_int32), ("curve", c_void_p), ("remove_count", c_uint32),
                ("add_count", c_uint32), ("remove_vertices", c_void_p), ("add_vertices", c_void_p), ("progress",
                c_void_p)]


class hf_region_info(Struct):
    """Counts and areas of a region."""
    struct_size: int
    field_kind: int
    vertex_count: int
    rim_count: int
    site_count: int
    reserved: int
    area: float
    base_area: float
    _fields_ = [("struct_size", c_uint32), ("field_kind", c_int32), ("vertex_count", c_uint32), ("rim_count",
                c_uint32), ("site_count", c_uint32), ("reserved", c_uint32), ("area", c_double), ("base_area",
                c_double)]


class hf_region_statistics(Struct):
    """Work of the last edit of a region, and of all its edits."""
    struct_size: int
    inserted_count: int
    removed_count: int
    kept_count: int
    factorisation_count: int
    path_solve_count: int
    last_route: int
    whole_sweep: int
    _fields_ = [("struct_size", c_uint32), ("inserted_count", c_uint32), ("removed_count", c_uint32), ("kept_count",
                c_uint32), ("factorisation_count", c_uint32), ("path_solve_count", c_uint32), ("last_route",
                c_uint32), ("whole_sweep", c_int32)]


class hf_morph_desc(Struct):
    """Gives hf_region_morph and hf_detail_morph their weight and outputs."""
    struct_size: int
    reserved: int
    weight: float
    positions: hf_array_out
    normals: hf_array_out
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("weight", c_double), ("positions", hf_array_out),
                ("normals", hf_array_out)]


class hf_detail_desc(Struct):
    struct_size: int
    pair_count: int
    source_vertices: int
    target_vertices: int
    scale: float
    progress: int
    _fields_ = [("struct_size", c_uint32), ("pair_count", c_uint32), ("source_vertices", c_void_p),
                ("target_vertices", c_void_p), ("scale", c_double), ("progress", c_void_p)]


class hf_retarget_desc(Struct):
    """Options of a retarget."""
    struct_size: int
    root_motion: int
    leave_out: int
    reserved: int
    scale: float
    ground_velocity: Array[c_double]
    source_rest: int
    target_rest: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("root_motion", c_int32), ("leave_out", c_uint32), ("reserved", c_uint32),
                ("scale", c_double), ("ground_velocity", c_double * 3), ("source_rest", c_void_p), ("target_rest",
                c_void_p), ("progress", c_void_p)]


class hf_retarget_info(Struct):
    """Figures of a retarget."""
    struct_size: int
    source_joint_count: int
    target_joint_count: int
    matched_joint_count: int
    chain_count: int
    same_skeleton: int
    scale_from: int
    frame_count: int
    scale: float
    limb_angle: float
    stride_share: float
    deepest_drop: float
    _fields_ = [("struct_size", c_uint32), ("source_joint_count", c_uint32), ("target_joint_count", c_uint32),
                ("matched_joint_count", c_uint32), ("chain_count", c_uint32), ("same_skeleton", c_int32),
                ("scale_from", c_int32), ("frame_count", c_uint32), ("scale", c_double), ("limb_angle", c_double),
                ("stride_share", c_double), ("deepest_drop", c_double)]


class hf_chain_match(Struct):
    """How a chain of the target follows the source."""
    role: int
    side: int
    source_joint_count: int
    target_joint_count: int
    mean_angle: float
    worst_angle: float
    _fields_ = [("role", c_int32), ("side", c_int32), ("source_joint_count", c_uint32), ("target_joint_count",
                c_uint32), ("mean_angle", c_double), ("worst_angle", c_double)]


class hf_skin_desc(Struct):
    """The skin of a character"""
    struct_size: int
    vertex_count: int
    triangle_count: int
    influence_count: int
    at_rest: int
    reserved: int
    positions: int
    triangles: int
    joints: int
    weights: int
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("triangle_count", c_uint32),
                ("influence_count", c_uint32), ("at_rest", c_int32), ("reserved", c_uint32), ("positions", c_void_p),
                ("triangles", c_void_p), ("joints", c_void_p), ("weights", c_void_p)]


class hf_skeleton_desc(Struct):
    """The joints of a character at rest."""
    struct_size: int
    joint_count: int
    names: int
    parents: int
    rest: int
    inverse_binds: int
    up: int
    forward: int
    roles: int
    sides: int
    travel_count: int
    reserved: int
    travels: int
    skin: int
    allocator: hf_allocator
    progress: int
    _fields_ = [("struct_size", c_uint32), ("joint_count", c_uint32), ("names", c_void_p), ("parents", c_void_p),
                ("rest", c_void_p), ("inverse_binds", c_void_p), ("up", c_void_p), ("forward", c_void_p), ("roles",
                c_void_p), ("sides", c_void_p), ("travel_count", c_uint32), ("reserved", c_uint32), ("travels",
                c_void_p), ("skin", c_void_p), ("allocator", hf_allocator), ("progress", c_void_p)]


class hf_skeleton_info(Struct):
    """The findings about a character."""
    struct_size: int
    joint_count: int
    chain_count: int
    reserved: int
    up: Array[c_double]
    forward: Array[c_double]
    left: Array[c_double]
    middle: Array[c_double]
    up_confidence: float
    forward_confidence: float
    left_confidence: float
    role_confidence: float
    height: float
    leg_length: float
    hip_height: float
    arm_length: float
    _fields_ = [("struct_size", c_uint32), ("joint_count", c_uint32), ("chain_count", c_uint32), ("reserved",
                c_uint32), ("up", c_double * 3), ("forward", c_double * 3), ("left", c_double * 3), ("middle",
                c_double * 3), ("up_confidence", c_double), ("forward_confidence", c_double), ("left_confidence",
                c_double), ("role_confidence", c_double), ("height", c_double), ("leg_length", c_double),
                ("hip_height", c_double), ("arm_length", c_double)]


class hf_joint_info(Struct):
    """The findings about a joint."""
    kind: int
    role: int
    side: int
    chain: int
    mate: int
    _fields_ = [("kind", c_int32), ("role", c_int32), ("side", c_int32), ("chain", c_uint32), ("mate", c_uint32)]


class hf_chain(Struct):
    """Joints of one role and side, from root to tip."""
    role: int
    side: int
    number: int
    parent: int
    first: int
    joint_count: int
    length: float
    _fields_ = [("role", c_int32), ("side", c_int32), ("number", c_uint32), ("parent", c_uint32), ("first", c_uint32),
                ("joint_count", c_uint32), ("length", c_double)]


class hf_transfer_desc(Struct):
    """most pairs of a transfer"""
    struct_size: int
    mode: int
    cluster_count: int
    ground: int
    kernel_width: float
    scale: float
    alignment_angle: float
    source_axes: Array[c_double]
    target_axes: Array[c_double]
    source_rest: hf_array
    target_rest: hf_array
    _fields_ = [("struct_size", c_uint32), ("mode", c_int32), ("cluster_count", c_uint32), ("ground", c_int32),
                ("kernel_width", c_double), ("scale", c_double), ("alignment_angle", c_double), ("source_axes",
                c_double * 9), ("target_axes", c_double * 9), ("source_rest", hf_array), ("target_rest", hf_array)]


class hf_pairs_desc(Struct):
    """The pairs to add."""
    struct_size: int
    pair_count: int
    source_counts: int
    source_vertices: int
    target_counts: int
    target_vertices: int
    flags: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("pair_count", c_uint32), ("source_counts", c_void_p), ("source_vertices",
                c_void_p), ("target_counts", c_void_p), ("target_vertices", c_void_p), ("flags", c_void_p),
                ("progress", c_void_p)]


class hf_pair_info(Struct):
    struct_size: int
    flags: int
    source_leak: float
    target_leak: float
    alignment_angle: float
    confidence: float
    alignment_share: float
    aligned: int
    crossed: int
    _fields_ = [("struct_size", c_uint32), ("flags", c_uint32), ("source_leak", c_double), ("target_leak", c_double),
                ("alignment_angle", c_double), ("confidence", c_double), ("alignment_share", c_double), ("aligned",
                c_int32), ("crossed", c_int32)]


class hf_transfer_info(Struct):
    """hf_transfer_get_info writes counts and the scale of a transfer here."""
    struct_size: int
    pair_count: int
    cluster_count: int
    aligned_count: int
    crossed_count: int
    scale_found: int
    scale: float
    _fields_ = [("struct_size", c_uint32), ("pair_count", c_uint32), ("cluster_count", c_uint32), ("aligned_count",
                c_uint32), ("crossed_count", c_uint32), ("scale_found", c_int32), ("scale", c_double)]


class hf_transfer_statistics(Struct):
    """Work of a transfer."""
    struct_size: int
    source_factorisation_count: int
    target_factorisation_count: int
    _fields_ = [("struct_size", c_uint32), ("source_factorisation_count", c_uint32), ("target_factorisation_count",
                c_uint32)]


class hf_transfer_dials(Struct):
    """Dials that an animator turns while a transfer plays."""
    struct_size: int
    reserved: int
    stride: float
    hip_height_share: float
    neck_follow: float
    tail_follow: float
    arm_space: float
    long_follow: float
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("stride", c_double), ("hip_height_share",
                c_double), ("neck_follow", c_double), ("tail_follow", c_double), ("arm_space", c_double),
                ("long_follow", c_double)]


class hf_transfer_frame(Struct):
    """Describes one frame"""
    struct_size: int
    hold_count: int
    source_positions: hf_array
    target_positions: hf_array_out
    target_normals: hf_array_out
    hold_pairs: int
    hold_positions: int
    _fields_ = [("struct_size", c_uint32), ("hold_count", c_uint32), ("source_positions", hf_array),
                ("target_positions", hf_array_out), ("target_normals", hf_array_out), ("hold_pairs", c_void_p),
                ("hold_positions", c_void_p)]


class hf_joints_desc(Struct):
    """The joints of a skeleton, in the unit and frame of the mesh."""
    struct_size: int
    joint_count: int
    heads: int
    tails: int
    axes: int
    parents: int
    deforms: int
    sources: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("joint_count", c_uint32), ("heads", c_void_p), ("tails", c_void_p),
                ("axes", c_void_p), ("parents", c_void_p), ("deforms", c_void_p), ("sources", c_void_p), ("progress",
                c_void_p)]


class hf_pins_desc(Struct):
    """Places with given weights."""
    struct_size: int
    pin_count: int
    vertices: int
    places: int
    points: int
    radii: int
    influence_count: int
    reserved: int
    joints: int
    weights: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("pin_count", c_uint32), ("vertices", c_void_p), ("places", c_void_p),
                ("points", c_void_p), ("radii", c_void_p), ("influence_count", c_uint32), ("reserved", c_uint32),
                ("joints", c_void_p), ("weights", c_void_p), ("progress", c_void_p)]


class hf_weights_out(Struct):
    """Receives the weights."""
    struct_size: int
    vertex_capacity: int
    vertex_count: int
    influence_count: int
    joints: int
    joints_u16: int
    weights: int
    origins: int
    _fields_ = [("struct_size", c_uint32), ("vertex_capacity", c_uint32), ("vertex_count", c_uint32),
                ("influence_count", c_uint32), ("joints", c_void_p), ("joints_u16", c_void_p), ("weights", c_void_p),
                ("origins", c_void_p)]


class hf_weights_info(Struct):
    """Counts of the weights."""
    struct_size: int
    vertex_count: int
    joint_count: int
    pin_count: int
    lock_count: int
    informed_count: int
    solved_count: int
    pinned_count: int
    nearest_count: int
    rigid_count: int
    isolated_count: int
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("joint_count", c_uint32), ("pin_count",
                c_uint32), ("lock_count", c_uint32), ("informed_count", c_uint32), ("solved_count", c_uint32),
                ("pinned_count", c_uint32), ("nearest_count", c_uint32), ("rigid_count", c_uint32), ("isolated_count",
                c_uint32)]


class hf_weights_statistics(Struct):
    """Figures of weights for developers"""
    struct_size: int
    nearest_piece_count: int
    rigid_piece_count: int
    blind: int
    no_length_count: int
    coincident_count: int
    informs_none_count: int
    outside_count: int
    helper_count: int
    factorisation_count: int
    path_solve_count: int
    _fields_ = [("struct_size", c_uint32), ("nearest_piece_count", c_uint32), ("rigid_piece_count", c_uint32),
                ("blind", c_int32), ("no_length_count", c_uint32), ("coincident_count", c_uint32),
                ("informs_none_count", c_uint32), ("outside_count", c_uint32), ("helper_count", c_uint32),
                ("factorisation_count", c_uint32), ("path_solve_count", c_uint32)]


class hf_weights_transfer_desc(Struct):
    """Weights to transfer from one surface to another."""
    struct_size: int
    source_influence_count: int
    joints: int
    weights: int
    distance: float
    angle: float
    influence_count: int
    reserved: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("source_influence_count", c_uint32), ("joints", c_void_p), ("weights",
                c_void_p), ("distance", c_double), ("angle", c_double), ("influence_count", c_uint32), ("reserved",
                c_uint32), ("progress", c_void_p)]


class hf_weights_transfer_info(Struct):
    """Counts of transferred weights."""
    struct_size: int
    vertex_count: int
    matched_count: int
    solved_count: int
    nearest_count: int
    rigid_count: int
    isolated_count: int
    guessed_piece_count: int
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("matched_count", c_uint32), ("solved_count",
                c_uint32), ("nearest_count", c_uint32), ("rigid_count", c_uint32), ("isolated_count", c_uint32),
                ("guessed_piece_count", c_uint32)]


class hf_weights_mirror_desc(Struct):
    """Weights to mirror."""
    struct_size: int
    joint_count: int
    heads: int
    names: int
    partners: int
    plane: int
    source_influence_count: int
    to: int
    joints: int
    weights: int
    distance: float
    angle: float
    influence_count: int
    reserved: int
    progress: int
    _fields_ = [("struct_size", c_uint32), ("joint_count", c_uint32), ("heads", c_void_p), ("names", c_void_p),
                ("partners", c_void_p), ("plane", c_void_p), ("source_influence_count", c_uint32), ("to", c_int32),
                ("joints", c_void_p), ("weights", c_void_p), ("distance", c_double), ("angle", c_double),
                ("influence_count", c_uint32), ("reserved", c_uint32), ("progress", c_void_p)]


class hf_weights_mirror_info(Struct):
    """The plane that hf_weights_mirror found, and counts of joints and vertices."""
    struct_size: int
    vertex_count: int
    plane_from: int
    named_count: int
    placed_count: int
    centre_count: int
    given_count: int
    alone_count: int
    kept_count: int
    matched_count: int
    solved_count: int
    nearest_count: int
    rigid_count: int
    isolated_count: int
    point: Array[c_double]
    normal: Array[c_double]
    _fields_ = [("struct_size", c_uint32), ("vertex_count", c_uint32), ("plane_from", c_int32), ("named_count",
                c_uint32), ("placed_count", c_uint32), ("centre_count", c_uint32), ("given_count", c_uint32),
                ("alone_count", c_uint32), ("kept_count", c_uint32), ("matched_count", c_uint32), ("solved_count",
                c_uint32), ("nearest_count", c_uint32), ("rigid_count", c_uint32), ("isolated_count", c_uint32),
                ("point", c_double * 3), ("normal", c_double * 3)]


class hf_weights_mirror_statistics(Struct):
    """Distances of a surface and its joints from their reflections, in the unit of the mesh."""
    struct_size: int
    worst_joint: int
    worst_vertex: int
    reserved: int
    joint_off: float
    worst_joint_off: float
    vertex_off: float
    worst_vertex_off: float
    _fields_ = [("struct_size", c_uint32), ("worst_joint", c_uint32), ("worst_vertex", c_uint32), ("reserved",
                c_uint32), ("joint_off", c_double), ("worst_joint_off", c_double), ("vertex_off", c_double),
                ("worst_vertex_off", c_double)]


STRUCTS = [hf_array, hf_array_out, hf_error_detail, hf_allocator, hf_job_runner, hf_factor_desc, hf_link, hf_links_desc, hf_faces_desc, hf_surface_desc, hf_graph_desc, hf_surface_info, hf_surface_report, hf_mesh_statistics, hf_links_info, hf_gaps_info, hf_patch_desc, hf_surface_edit_desc, hf_cut_corner, hf_surface_statistics, hf_place, hf_cut_desc, hf_cut, hf_pick_desc, hf_hit, hf_solver_desc, hf_solver_info, hf_sites_desc, hf_edit_desc, hf_sites_info, hf_solve_info, hf_preview_info, hf_certificate, hf_solver_statistics, hf_isolines, hf_critical_point, hf_critical_info, hf_geodesics_desc, hf_path, hf_extremities_desc, hf_extremity, hf_direction_desc, hf_singularity, hf_direction_statistics, hf_pose_desc, hf_pose_info, hf_handles_desc, hf_transform, hf_handle_info, hf_deform_info, hf_deform_desc, hf_pose_statistics, hf_skin_info, hf_blend_info, hf_blend_rows, hf_blend_influences, hf_handle_proposals_desc, hf_handle_proposal, hf_quads_desc, hf_quads_info, hf_quads_mesh, hf_streamlines, hf_region_desc, hf_curve_desc, hf_region_edit_desc, hf_region_info, hf_region_statistics, hf_morph_desc, hf_detail_desc, hf_retarget_desc, hf_retarget_info, hf_chain_match, hf_skin_desc, hf_skeleton_desc, hf_skeleton_info, hf_joint_info, hf_chain, hf_transfer_desc, hf_pairs_desc, hf_pair_info, hf_transfer_info, hf_transfer_statistics, hf_transfer_dials, hf_transfer_frame, hf_joints_desc, hf_pins_desc, hf_weights_out, hf_weights_info, hf_weights_statistics, hf_weights_transfer_desc, hf_weights_transfer_info, hf_weights_mirror_desc, hf_weights_mirror_info, hf_weights_mirror_statistics]

# name: (result type, argument types); every pointer and handle is a c_void_p
PROTOTYPES = {
    "hf_error_get_detail": (c_int32, [c_void_p]),
    "hf_result_get_name": (c_char_p, [c_int32]),
    "hf_version_get": (c_uint32, []),
    "hf_progress_create": (c_int32, [c_void_p]),
    "hf_progress_destroy": (None, [c_void_p]),
    "hf_progress_get_fraction": (c_int32, [c_void_p, c_void_p]),
    "hf_progress_cancel": (c_int32, [c_void_p]),
    "hf_surface_create": (c_int32, [c_void_p, c_void_p]),
    "hf_surface_create_graph": (c_int32, [c_void_p, c_void_p]),
    "hf_surface_destroy": (None, [c_void_p]),
    "hf_surface_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_surface_get_report": (c_int32, [c_void_p, c_void_p]),
    "hf_surface_get_mesh_statistics": (c_int32, [c_void_p, c_void_p]),
    "hf_surface_get_components": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_surface_get_links_info": (c_int32, [c_void_p, c_void_p]),
    "hf_surface_get_links": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_surface_get_pieces": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p, c_void_p]),
    "hf_surface_measure_gaps": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_surface_relink": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_surface_edit": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_surface_get_cuts": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_surface_get_stiffness": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_surface_get_statistics": (c_int32, [c_void_p, c_void_p]),
    "hf_surface_save": (c_int32, [c_void_p, c_int32, c_void_p, c_size_t, c_void_p, c_void_p]),
    "hf_surface_trace_cut": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_surface_cast_ray": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_surface_find_vertex": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_create": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_solver_clone": (c_int32, [c_void_p, c_void_p]),
    "hf_solver_move_to": (c_int32, [c_void_p, c_void_p]),
    "hf_solver_destroy": (None, [c_void_p]),
    "hf_solver_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_add_sites": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_solver_add_site": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_remove_sites": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_solver_move_sites": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_solver_set_values": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_solver_edit_sites": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_solver_get_site_count": (c_uint32, [c_void_p]),
    "hf_solver_get_sites": (c_int32, [c_void_p, c_void_p]),
    "hf_solver_set_screening": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_solve": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p]),
    "hf_solver_solve": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_solver_solve_at": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_solver_solve_vectors": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_solver_solve_preview": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p]),
    "hf_solver_release_preview": (c_int32, [c_void_p]),
    "hf_solver_move_vectors": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_solver_rotate_vectors": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_solver_certify": (c_int32, [c_void_p, c_void_p]),
    "hf_solver_prepare_rebase": (c_int32, [c_void_p]),
    "hf_solver_get_statistics": (c_int32, [c_void_p, c_void_p]),
    "hf_surface_space_levels": (c_int32, [c_void_p, c_void_p, c_int32, c_uint32, c_void_p]),
    "hf_surface_trace_isolines": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_surface_find_critical_points": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_geodesics_create": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_geodesics_destroy": (None, [c_void_p]),
    "hf_geodesics_solve": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_geodesics_find_path": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_geodesics_get_map": (c_int32, [c_void_p, c_void_p, c_double, c_void_p, c_void_p]),
    "hf_surface_find_extremities": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_direction_create": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_direction_clone": (c_int32, [c_void_p, c_void_p]),
    "hf_direction_destroy": (None, [c_void_p]),
    "hf_direction_add_sites": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p, c_void_p]),
    "hf_direction_remove_sites": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_direction_move_sites": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_direction_set_vectors": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_direction_rotate_sites": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_direction_get_site_count": (c_uint32, [c_void_p]),
    "hf_direction_get_sites": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_direction_solve": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_direction_get_singularities": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_direction_get_statistics": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_create": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_pose_clone": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_move_to": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_destroy": (None, [c_void_p]),
    "hf_pose_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_add_handles": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_pose_add_handle_at": (c_int32, [c_void_p, c_void_p, c_double, c_void_p]),
    "hf_pose_remove_handles": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_pose_set_transforms": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_pose_set_transform": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_pose_set_free_rotations": (c_int32, [c_void_p, c_uint32, c_void_p, c_int32]),
    "hf_pose_set_following": (c_int32, [c_void_p, c_uint32, c_void_p, c_double]),
    "hf_pose_set_limb_refine": (c_int32, [c_void_p, c_uint32, c_void_p, c_int32]),
    "hf_pose_set_rigid_pieces": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_pose_set_matrices": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_pose_get_handle": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_pose_get_handle_count": (c_uint32, [c_void_p]),
    "hf_pose_get_field": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_deform": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_pose_deform": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_pose_get_statistics": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_get_skin": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_get_blend_info": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_get_blend_rows": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_get_blend_influences": (c_int32, [c_void_p, c_void_p]),
    "hf_pose_solve": (c_int32, [c_void_p, c_uint32, c_int32, c_void_p]),
    "hf_pose_get_blend_transforms": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_surface_propose_handles": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_quads_create": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_quads_update": (c_int32, [c_void_p, c_void_p]),
    "hf_quads_destroy": (None, [c_void_p]),
    "hf_quads_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_quads_get_mesh": (c_int32, [c_void_p, c_void_p]),
    "hf_flow_create": (c_int32, [c_void_p, c_void_p]),
    "hf_flow_destroy": (None, [c_void_p]),
    "hf_flow_trace": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_region_create": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_region_clone": (c_int32, [c_void_p, c_void_p]),
    "hf_region_destroy": (None, [c_void_p]),
    "hf_region_edit": (c_int32, [c_void_p, c_void_p]),
    "hf_region_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_region_get_statistics": (c_int32, [c_void_p, c_void_p]),
    "hf_region_get_vertices": (c_int32, [c_void_p, c_int32, c_uint32, c_void_p, c_void_p]),
    "hf_region_get_curve": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_region_morph": (c_int32, [c_void_p, c_void_p]),
    "hf_detail_create": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_detail_destroy": (None, [c_void_p]),
    "hf_detail_morph": (c_int32, [c_void_p, c_void_p]),
    "hf_retarget_create": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_retarget_clone": (c_int32, [c_void_p, c_void_p]),
    "hf_retarget_destroy": (None, [c_void_p]),
    "hf_retarget_solve": (c_int32, [c_void_p, c_void_p, c_double, c_void_p]),
    "hf_retarget_reset": (c_int32, [c_void_p]),
    "hf_retarget_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_retarget_get_chains": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_retarget_get_partners": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_skeleton_get_ground_velocity": (c_int32, [c_void_p, c_uint32, c_void_p, c_double, c_void_p]),
    "hf_skeleton_create": (c_int32, [c_void_p, c_void_p]),
    "hf_skeleton_destroy": (None, [c_void_p]),
    "hf_skeleton_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_skeleton_get_joints": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_skeleton_get_chains": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_skeleton_get_chain_joints": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_skeleton_get_reasons": (c_int32, [c_void_p, c_size_t, c_void_p, c_void_p]),
    "hf_transfer_create": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_transfer_destroy": (None, [c_void_p]),
    "hf_transfer_add_pairs": (c_int32, [c_void_p, c_void_p, c_void_p]),
    "hf_transfer_remove_pairs": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_transfer_get_pair": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_transfer_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_transfer_get_statistics": (c_int32, [c_void_p, c_void_p]),
    "hf_transfer_set_dials": (c_int32, [c_void_p, c_void_p]),
    "hf_transfer_get_dials": (c_int32, [c_void_p, c_void_p]),
    "hf_transfer_set_rigid_pieces": (c_int32, [c_void_p, c_uint32, c_void_p]),
    "hf_transfer_apply": (c_int32, [c_void_p, c_void_p]),
    "hf_transfer_get_sinking": (c_int32, [c_void_p, c_void_p]),
    "hf_transfer_get_skin": (c_int32, [c_void_p, c_void_p]),
    "hf_weights_create": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p]),
    "hf_weights_clone": (c_int32, [c_void_p, c_void_p]),
    "hf_weights_destroy": (None, [c_void_p]),
    "hf_weights_set_joints": (c_int32, [c_void_p, c_void_p]),
    "hf_weights_set_pins": (c_int32, [c_void_p, c_void_p]),
    "hf_weights_set_locks": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_weights_get": (c_int32, [c_void_p, c_void_p]),
    "hf_weights_get_joints": (c_int32, [c_void_p, c_uint32, c_void_p, c_void_p, c_void_p]),
    "hf_weights_get_info": (c_int32, [c_void_p, c_void_p]),
    "hf_weights_get_statistics": (c_int32, [c_void_p, c_void_p]),
    "hf_weights_get_helpers": (c_int32, [c_void_p, c_void_p, c_uint32, c_void_p, c_void_p]),
    "hf_weights_transfer": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p, c_void_p]),
    "hf_weights_mirror": (c_int32, [c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p]),
}


def load(path: str) -> CDLL:
    """Loads the shared library and gives every function its prototype."""
    library = CDLL(path)
    version = library.hf_version_get()
    if not 1000 <= version < 1000000:
        raise OSError(f"it is of version {version // 1000000}.{version // 1000 % 1000}, this package of 0.1.0; install matching ones")
    for name, (result, arguments) in PROTOTYPES.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
    return library
