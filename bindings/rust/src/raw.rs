// Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI as Rust sees it.
//! The C ABI, unsafe and without wrapping. The headers of hf describe it.
#![allow(non_camel_case_types, missing_docs)]
use std::os::raw::{c_char, c_void};

pub const HEADER_VERSION: &str = "0.1.0";
pub const HF_VERSION_MAJOR: i32 = 0;
pub const HF_VERSION_MINOR: i32 = 1;
pub const HF_VERSION_PATCH: i32 = 0;
pub const HF_NO_INDEX: u32 = 4294967295;
pub const HF_MESSAGE_SIZE: i32 = 256;
pub const HF_OK: i32 = 0;
pub const HF_ERROR_INVALID_ARGUMENT: i32 = -1;
pub const HF_ERROR_NULL_POINTER: i32 = -2;
pub const HF_ERROR_INVALID_OBJECT: i32 = -3;
pub const HF_ERROR_INVALID_DESC: i32 = -4;
pub const HF_ERROR_OUT_OF_RANGE: i32 = -5;
pub const HF_ERROR_NON_FINITE: i32 = -6;
pub const HF_ERROR_EMPTY: i32 = -7;
pub const HF_ERROR_NOT_FOUND: i32 = -8;
pub const HF_ERROR_DUPLICATE: i32 = -9;
pub const HF_ERROR_CONFLICT: i32 = -10;
pub const HF_ERROR_UNSUPPORTED: i32 = -11;
pub const HF_ERROR_BUSY: i32 = -12;
pub const HF_ERROR_REENTRANT: i32 = -13;
pub const HF_ERROR_TOO_SMALL: i32 = -14;
pub const HF_ERROR_OUT_OF_MEMORY: i32 = -100;
pub const HF_ERROR_TOO_LARGE: i32 = -101;
pub const HF_ERROR_CANCELLED: i32 = -102;
pub const HF_ERROR_NOT_POSITIVE_DEFINITE: i32 = -200;
pub const HF_ERROR_INACCURATE: i32 = -201;
pub const HF_ERROR_INTERNAL: i32 = -300;
pub const HF_TYPE_PLAIN: i32 = 0;
pub const HF_TYPE_DOUBLE: i32 = 1;
pub const HF_TYPE_UINT16: i32 = 2;
pub const HF_WELD_EXACT: i32 = 0;
pub const HF_WELD_NONE: i32 = 1;
pub const HF_WELD_TOLERANCE: i32 = 2;
pub const HF_OPERATOR_INTRINSIC_DELAUNAY: i32 = 0;
pub const HF_OPERATOR_CLAMPED: i32 = 1;
pub const HF_OPERATOR_UNIFORM: i32 = 2;
pub const HF_OPERATOR_COTANGENT: i32 = 3;
pub const HF_OPERATOR_GRAPH: i32 = 4;
pub const HF_FIELD_HARMONIC: i32 = 0;
pub const HF_FIELD_BIHARMONIC: i32 = 1;
pub const HF_FIELD_BIHARMONIC_GRAPH: i32 = 2;
pub const HF_ORDERING_NESTED_DISSECTION: i32 = 0;
pub const HF_ORDERING_MINIMUM_DEGREE: i32 = 1;
pub const HF_ORDERING_METIS: i32 = 2;
pub const HF_FACTOR_ALIGNMENT: i32 = 64;
pub const HF_LINK_NONE: i32 = 0;
pub const HF_LINK_PIECES: i32 = 1;
pub const HF_LINK_LIST: i32 = 2;
pub const HF_ROUTE_NONE: i32 = 0;
pub const HF_ROUTE_DENSE: i32 = 1;
pub const HF_ROUTE_FRESH: i32 = 2;
pub const HF_ROUTE_REBASE: i32 = 3;
pub const HF_LEVELS_VALUE: i32 = 0;
pub const HF_LEVELS_AREA: i32 = 1;
pub const HF_LEVELS_LENGTH: i32 = 2;
pub const HF_CRITICAL_MINIMUM: i32 = 0;
pub const HF_CRITICAL_MAXIMUM: i32 = 1;
pub const HF_CRITICAL_SADDLE: i32 = 2;
pub const HF_GEODESICS_AUTO: i32 = 0;
pub const HF_GEODESICS_FRONT: i32 = 1;
pub const HF_GEODESICS_EXACT: i32 = 2;
pub const HF_GEODESICS_HEAT: i32 = 3;
pub const HF_EXTREMITIES_POISSON: i32 = 0;
pub const HF_EXTREMITIES_GEODESIC: i32 = 1;
pub const HF_LAYER_COUNT: i32 = 8;
pub const HF_HANDLE_LIMIT: i32 = 256;
pub const HF_HANDLE_REASON_FOOT: i32 = 0;
pub const HF_HANDLE_REASON_TIP: i32 = 1;
pub const HF_HANDLE_REASON_END: i32 = 2;
pub const HF_HANDLE_REASON_JOINT: i32 = 3;
pub const HF_HANDLE_REASON_MIDDLE: i32 = 4;
pub const HF_BASE_DEFAULT: i32 = 0;
pub const HF_BASE_MEMBRANE: i32 = 1;
pub const HF_BASE_THIN_PLATE: i32 = 2;
pub const HF_BASE_THIN_PLATE_GRAPH: i32 = 3;
pub const HF_SIDE_SMALLER: i32 = 0;
pub const HF_SIDE_LARGER: i32 = 1;
pub const HF_SIDE_SEED: i32 = 2;
pub const HF_CURVE_STRAIGHT: i32 = 0;
pub const HF_CURVE_EDGES: i32 = 1;
pub const HF_REGION_INSIDE: i32 = 0;
pub const HF_REGION_RIM: i32 = 1;
pub const HF_REGION_SITES: i32 = 2;
pub const HF_ROOT_MOTION_HIPS: i32 = 0;
pub const HF_ROOT_MOTION_ROOT: i32 = 1;
pub const HF_ROOT_MOTION_IN_PLACE: i32 = 2;
pub const HF_RETARGET_KEEP_RESTS: i32 = 1;
pub const HF_RETARGET_NO_GOALS: i32 = 2;
pub const HF_RETARGET_NO_LOCK: i32 = 4;
pub const HF_RETARGET_NO_COPY: i32 = 8;
pub const HF_SCALE_GIVEN: i32 = 0;
pub const HF_SCALE_LEGS: i32 = 1;
pub const HF_SCALE_HIPS: i32 = 2;
pub const HF_SCALE_HEIGHT: i32 = 3;
pub const HF_ROLE_OTHER: i32 = 0;
pub const HF_ROLE_SPINE: i32 = 1;
pub const HF_ROLE_NECK: i32 = 2;
pub const HF_ROLE_HEAD: i32 = 3;
pub const HF_ROLE_JAW: i32 = 4;
pub const HF_ROLE_SHOULDER: i32 = 5;
pub const HF_ROLE_ARM: i32 = 6;
pub const HF_ROLE_HAND: i32 = 7;
pub const HF_ROLE_FINGER: i32 = 8;
pub const HF_ROLE_LEG: i32 = 9;
pub const HF_ROLE_FOOT: i32 = 10;
pub const HF_ROLE_TOE: i32 = 11;
pub const HF_ROLE_TAIL: i32 = 12;
pub const HF_ROLE_WING: i32 = 13;
pub const HF_ROLE_EAR: i32 = 14;
pub const HF_ROLE_EYE: i32 = 15;
pub const HF_ROLE_ANTENNA: i32 = 16;
pub const HF_ROLE_FIN: i32 = 17;
pub const HF_SIDE_MIDDLE: i32 = 0;
pub const HF_SIDE_LEFT: i32 = 1;
pub const HF_SIDE_RIGHT: i32 = 2;
pub const HF_JOINT_KIND_BODY: i32 = 0;
pub const HF_JOINT_KIND_HELPER: i32 = 1;
pub const HF_JOINT_KIND_END: i32 = 2;
pub const HF_JOINT_KIND_TWIST: i32 = 3;
pub const HF_TRANSFER_FIELDS: i32 = 0;
pub const HF_TRANSFER_STRETCH: i32 = 1;
pub const HF_GROUND_KEEP: i32 = 0;
pub const HF_GROUND_OFF: i32 = 1;
pub const HF_PAIR_ANCHOR: i32 = 1;
pub const HF_PAIR_FOOT: i32 = 2;
pub const HF_PAIR_TRUNK: i32 = 4;
pub const HF_PAIR_NO_ALIGNMENT: i32 = 8;
pub const HF_PAIR_CONTACT: i32 = 16;
pub const HF_PAIR_SINKS: i32 = 32;
pub const HF_PAIR_NECK: i32 = 64;
pub const HF_PAIR_TAIL: i32 = 128;
pub const HF_PAIR_ARM: i32 = 256;
pub const HF_PAIR_LIMIT: i32 = 256;
pub const HF_WEIGHTS_INFORMED: i32 = 0;
pub const HF_WEIGHTS_SOLVED: i32 = 1;
pub const HF_WEIGHTS_PINNED: i32 = 2;
pub const HF_WEIGHTS_NEAREST: i32 = 3;
pub const HF_WEIGHTS_RIGID: i32 = 4;
pub const HF_WEIGHTS_ISOLATED: i32 = 5;
pub const HF_WEIGHTS_MATCHED: i32 = 6;
pub const HF_WEIGHTS_KEPT: i32 = 7;
pub const HF_JOINT_NO_LENGTH: i32 = 1;
pub const HF_JOINT_COINCIDENT: i32 = 2;
pub const HF_JOINT_INFORMS_NONE: i32 = 4;
pub const HF_JOINT_OUTSIDE: i32 = 8;
pub const HF_JOINT_HELPER: i32 = 16;
pub const HF_HELPER_PROPOSED: i32 = 1;
pub const HF_HELPER_NAME_ROOT: i32 = 2;
pub const HF_HELPER_NAME_CONTROL: i32 = 4;
pub const HF_HELPER_NAME_END: i32 = 8;
pub const HF_HELPER_ROOT: i32 = 16;
pub const HF_HELPER_APART: i32 = 32;
pub const HF_HELPER_NO_LENGTH: i32 = 64;
pub const HF_HELPER_COINCIDENT: i32 = 128;
pub const HF_HELPER_OUTSIDE: i32 = 256;
pub const HF_HELPER_INFORMS_NONE: i32 = 512;
pub const HF_MIRROR_TO_NEGATIVE: i32 = 0;
pub const HF_MIRROR_TO_POSITIVE: i32 = 1;
pub const HF_MIRROR_BOTH: i32 = 2;
pub const HF_MIRROR_PLANE_GIVEN: i32 = 0;
pub const HF_MIRROR_PLANE_JOINTS: i32 = 1;
pub const HF_MIRROR_PLANE_SURFACE: i32 = 2;
pub const HF_MIRROR_JOINT_ALONE: i32 = 0;
pub const HF_MIRROR_JOINT_NAMED: i32 = 1;
pub const HF_MIRROR_JOINT_PLACED: i32 = 2;
pub const HF_MIRROR_JOINT_CENTRE: i32 = 3;
pub const HF_MIRROR_JOINT_GIVEN: i32 = 4;

#[repr(C)]
pub struct hf_progress_object {
    _opaque: [u8; 0],
}
pub type hf_progress = *mut hf_progress_object;
#[repr(C)]
pub struct hf_surface_object {
    _opaque: [u8; 0],
}
pub type hf_surface = *mut hf_surface_object;
#[repr(C)]
pub struct hf_solver_object {
    _opaque: [u8; 0],
}
pub type hf_solver = *mut hf_solver_object;
#[repr(C)]
pub struct hf_geodesics_object {
    _opaque: [u8; 0],
}
pub type hf_geodesics = *mut hf_geodesics_object;
#[repr(C)]
pub struct hf_direction_object {
    _opaque: [u8; 0],
}
pub type hf_direction = *mut hf_direction_object;
#[repr(C)]
pub struct hf_pose_object {
    _opaque: [u8; 0],
}
pub type hf_pose = *mut hf_pose_object;
#[repr(C)]
pub struct hf_quads_object {
    _opaque: [u8; 0],
}
pub type hf_quads = *mut hf_quads_object;
#[repr(C)]
pub struct hf_flow_object {
    _opaque: [u8; 0],
}
pub type hf_flow = *mut hf_flow_object;
#[repr(C)]
pub struct hf_region_object {
    _opaque: [u8; 0],
}
pub type hf_region = *mut hf_region_object;
#[repr(C)]
pub struct hf_detail_object {
    _opaque: [u8; 0],
}
pub type hf_detail = *mut hf_detail_object;
#[repr(C)]
pub struct hf_retarget_object {
    _opaque: [u8; 0],
}
pub type hf_retarget = *mut hf_retarget_object;
#[repr(C)]
pub struct hf_skeleton_object {
    _opaque: [u8; 0],
}
pub type hf_skeleton = *mut hf_skeleton_object;
#[repr(C)]
pub struct hf_transfer_object {
    _opaque: [u8; 0],
}
pub type hf_transfer = *mut hf_transfer_object;
#[repr(C)]
pub struct hf_weights_object {
    _opaque: [u8; 0],
}
pub type hf_weights = *mut hf_weights_object;

/// An array of yours that the library reads
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_array {
    pub data: *const c_void,
    pub count: u32,
    pub stride: u32,
    pub r#type: i32,
    pub reserved: u32,
}

/// An array of yours that the library writes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_array_out {
    pub data: *mut c_void,
    pub count: u32,
    pub stride: u32,
    pub r#type: i32,
    pub reserved: u32,
}

/// Details of the last failed call on this thread.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_error_detail {
    pub code: i32,
    pub index: u32,
    pub function: [c_char; 48],
    pub message: [c_char; 256],
}

/// Your allocator, which serves a surface and everything made from it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_allocator {
    pub allocate: *const c_void,
    pub release: *const c_void,
    pub user: *mut c_void,
}

/// Your job system.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_job_runner {
    pub run: *const c_void,
    pub user: *mut c_void,
}

/// A factor that hf_surface_save wrote.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_factor_desc {
    pub struct_size: u32,
    pub borrow: i32,
    pub bytes: *const c_void,
    pub byte_count: usize,
}

/// A spring from a vertex to a point of a triangle.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_link {
    pub vertex: u32,
    pub corners: [u32; 3],
    pub barycentrics: [f64; 3],
    pub length: f64,
    pub weight: f64,
    pub in_tree: i32,
    pub reserved: u32,
}

/// Says which pieces to link.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_links_desc {
    pub struct_size: u32,
    pub mode: i32,
    pub distance: f64,
    pub stiffness: f64,
    pub overlay_distance: f64,
    pub influence_count: u32,
    pub link_count: u32,
    pub light_count: u32,
    pub heavy_count: u32,
    pub joint_count: u32,
    pub reserved: u32,
    pub joints: *const u16,
    pub weights: *const f32,
    pub joint_parents: *const u32,
    pub tags: *const u32,
    pub links: *const hf_link,
    pub light_vertices: *const u32,
    pub heavy_vertices: *const u32,
}

/// Faces of any number of corners.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_faces_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub corners: hf_array,
    pub sizes: hf_array,
    pub starts: hf_array,
}

/// The mesh and the options of a surface.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_surface_desc {
    pub struct_size: u32,
    pub weld: i32,
    pub positions: hf_array,
    pub triangles: hf_array,
    pub faces: *const hf_faces_desc,
    pub weld_tolerance: f64,
    pub operator_kind: i32,
    pub field_kind: i32,
    pub ordering: i32,
    pub thread_count: u32,
    pub vertex_limit: u32,
    pub triangle_limit: u32,
    pub memory_limit_mb: u32,
    pub work_limit_gflop: u32,
    pub allocator: hf_allocator,
    pub job_runner: hf_job_runner,
    pub progress: hf_progress,
    pub saved_factor: *const hf_factor_desc,
    pub links: *const hf_links_desc,
}

/// A graph of your own and the options of its surface
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_graph_desc {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub edges: hf_array,
    pub weights: hf_array,
    pub masses: hf_array,
    pub allow_negative: i32,
    pub field_kind: i32,
    pub ordering: i32,
    pub thread_count: u32,
    pub vertex_limit: u32,
    pub edge_limit: u32,
    pub memory_limit_mb: u32,
    pub work_limit_gflop: u32,
    pub allocator: hf_allocator,
    pub job_runner: hf_job_runner,
    pub progress: hf_progress,
    pub saved_factor: *const hf_factor_desc,
}

/// The options a surface was made with, defaults filled in.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_surface_info {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub triangle_count: u32,
    pub weld: i32,
    pub weld_tolerance: f64,
    pub operator_kind: i32,
    pub field_kind: i32,
    pub ordering: i32,
    pub thread_count: u32,
    pub vertex_limit: u32,
    pub triangle_limit: u32,
    pub memory_limit_mb: u32,
    pub work_limit_gflop: u32,
    pub edge_count: u32,
    pub edge_limit: u32,
    pub face_count: u32,
    pub corner_count: u32,
}

/// Counts that the surface found in the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_surface_report {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub triangle_count: u32,
    pub welded_vertex_count: u32,
    pub component_count: u32,
    pub isolated_vertex_count: u32,
    pub degenerate_triangle_count: u32,
    pub collapsed_triangle_count: u32,
    pub duplicate_triangle_count: u32,
    pub non_manifold_edge_count: u32,
    pub flipped_edge_count: u32,
    pub boundary_edge_count: u32,
    pub inside_out_count: u32,
    pub first_inside_out_vertex: u32,
    pub bounding_box_diagonal: f64,
}

/// Figures of a mesh for developers
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_mesh_statistics {
    pub struct_size: u32,
    pub polygon_count: u32,
    pub non_planar_count: u32,
    pub largest_face: u32,
    pub negative_edge_count: u32,
    pub changed_vertex_count: u32,
    pub first_changed_vertex: u32,
    pub reserved: u32,
    pub smallest_angle: f64,
}

/// How the pieces of a mesh are linked.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_links_info {
    pub struct_size: u32,
    pub piece_count: u32,
    pub link_count: u32,
    pub light_piece_count: u32,
    pub lone_piece_count: u32,
    pub contact_count: u32,
    pub longest_tree_link: f64,
}

/// How far linked pieces have opened, in the unit of the positions.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_gaps_info {
    pub struct_size: u32,
    pub link_count: u32,
    pub percentile_95: f64,
    pub worst: f64,
    pub worst_link: u32,
    pub contact_count: u32,
    pub worst_contact: f64,
    pub contact_vertex: u32,
    pub touching_count: u32,
    pub worst_opening: f64,
    pub opening_vertex: u32,
    pub reserved: u32,
}

/// Lists triangles that go, vertices and triangles that come in, and edges to cut along.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_patch_desc {
    pub struct_size: u32,
    pub removed_triangle_count: u32,
    pub new_vertex_count: u32,
    pub new_triangle_count: u32,
    pub cut_edge_count: u32,
    pub reserved: u32,
    pub removed_triangles: *const u32,
    pub new_positions: *const f64,
    pub new_triangles: *const u32,
    pub cut_edges: *const u32,
}

/// Lists the changes of hf_surface_edit
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_surface_edit_desc {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub vertices: *const u32,
    pub stiffness: *const f64,
    pub link_count: u32,
    pub removed_link_count: u32,
    pub links: *const hf_link,
    pub removed_links: *const u32,
    pub patch: *const hf_patch_desc,
    pub progress: hf_progress,
}

/// A corner of a triangle that a cut gave another vertex.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_cut_corner {
    pub triangle: u32,
    pub corner: u32,
    pub vertex: u32,
    pub copied: u32,
}

/// hf_surface_get_statistics writes sizes and times of a surface here.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_surface_statistics {
    pub struct_size: u32,
    pub unknown_count: u32,
    pub weld_ms: f64,
    pub operator_ms: f64,
    pub ordering_ms: f64,
    pub symbolic_ms: f64,
    pub numeric_ms: f64,
    pub factor_entries: f64,
    pub factor_bytes: f64,
    pub factor_flops: f64,
    pub memory_bytes: f64,
    pub peak_memory_bytes: f64,
    pub load_ms: f64,
    pub factor_loaded: i32,
    pub factor_borrowed: i32,
    pub links_ms: f64,
}

/// A place on a surface
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_place {
    pub corners: [u32; 3],
    pub reserved: u32,
    pub barycentrics: [f64; 3],
}

/// Describes the line of a knife
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_cut_desc {
    pub struct_size: u32,
    pub point_count: u32,
    pub vertices: *const u32,
    pub places: *const hf_place,
    pub points: *const f64,
    pub snap_share: f64,
    pub crossing_limit: u32,
    pub reserved: u32,
    pub progress: hf_progress,
}

/// A cut as triangles that go and come.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_cut {
    pub struct_size: u32,
    pub removed_triangle_capacity: u32,
    pub new_vertex_capacity: u32,
    pub new_triangle_capacity: u32,
    pub rim_capacity: u32,
    pub removed_triangle_count: u32,
    pub new_vertex_count: u32,
    pub new_triangle_count: u32,
    pub rim_count: u32,
    pub reserved: u32,
    pub removed_triangles: *mut u32,
    pub new_positions: *mut f64,
    pub new_triangles: *mut u32,
    pub vertex_corners: *mut u32,
    pub vertex_barycentrics: *mut f64,
    pub source_triangles: *mut u32,
    pub corner_barycentrics: *mut f64,
    pub rim_vertices: *mut u32,
}

/// Options of picking
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_pick_desc {
    pub struct_size: u32,
    pub front_only: i32,
    pub positions: hf_array,
}

/// hf_surface_cast_ray writes the first triangle that a ray hits here.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_hit {
    pub struct_size: u32,
    pub found: i32,
    pub triangle: u32,
    pub vertex: u32,
    pub place: hf_place,
    pub position: [f64; 3],
    pub distance: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_solver_desc {
    pub struct_size: u32,
    pub field_kind: i32,
    pub channel_count: u32,
    pub site_limit: u32,
    pub progress: hf_progress,
}

/// hf_solver_get_info writes the options of a solver here, with defaults filled in, and the number of its sites.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_solver_info {
    pub struct_size: u32,
    pub field_kind: i32,
    pub channel_count: u32,
    pub site_limit: u32,
    pub site_count: u32,
    pub vertex_count: u32,
}

/// Places and values of sites.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_sites_desc {
    pub struct_size: u32,
    pub site_count: u32,
    pub vertices: *const u32,
    pub places: *const hf_place,
    pub points: *const f64,
    pub values: *const f64,
    pub stiffness: *const f64,
    pub radii: *const f64,
}

/// One batch of edits, applied in the order remove, move, set, add.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_edit_desc {
    pub struct_size: u32,
    pub remove_count: u32,
    pub remove_sites: *const u32,
    pub move_count: u32,
    pub set_count: u32,
    pub move_sites: *const u32,
    pub move_to: *const hf_sites_desc,
    pub set_sites: *const u32,
    pub set_values: *const f64,
    pub add: *const hf_sites_desc,
}

/// Places, values and fluxes of the sites.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_sites_info {
    pub struct_size: u32,
    pub capacity: u32,
    pub count: u32,
    pub reserved: u32,
    pub sites: *mut u32,
    pub vertices: *mut u32,
    pub components: *mut u32,
    pub values: *mut f64,
    pub stiffness: *mut f64,
    pub flux: *mut f64,
    pub radii: *mut f64,
}

/// The components that the sites of a solve did not reach.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_solve_info {
    pub struct_size: u32,
    pub unreached_component_count: u32,
    pub first_unreached_component: u32,
    pub unreached_vertex_count: u32,
}

/// Counts and errors of a preview.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_preview_info {
    pub struct_size: u32,
    pub exact: i32,
    pub correction_count: u32,
    pub unreached_component_count: u32,
    pub value_range: f64,
    pub largest_correction: f64,
    pub error_estimate: f64,
    pub preview_bytes: f64,
}

/// The certificate says how accurate a field is.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_certificate {
    pub struct_size: u32,
    pub overshoot_checked: i32,
    pub tolerance: f64,
    pub value_range: f64,
    pub residual: f64,
    pub site_error: f64,
    pub overshoot: f64,
    pub worst_vertex: u32,
    pub changed_vertex_count: u32,
    pub error_estimate: f64,
}

/// Counts, memory and cost estimates of a solver.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_solver_statistics {
    pub struct_size: u32,
    pub site_count: u32,
    pub factorisation_count: u32,
    pub path_solve_count: u32,
    pub sweep_count: u32,
    pub last_route: u32,
    pub rebase_count: u32,
    pub dense_edit_count: u32,
    pub dense_row_count: u32,
    pub eliminated_count: u32,
    pub rebase_advised: i32,
    pub reserved: u32,
    pub site_memory_bytes: f64,
    pub predicted_dense_ms: f64,
    pub predicted_rebase_ms: f64,
}

/// Iso-lines as polylines.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_isolines {
    pub struct_size: u32,
    pub point_capacity: u32,
    pub line_capacity: u32,
    pub point_count: u32,
    pub line_count: u32,
    pub reserved: u32,
    pub point_edges: *mut u32,
    pub parameters: *mut f64,
    pub positions: *mut f64,
    pub line_starts: *mut u32,
    pub line_levels: *mut u32,
    pub line_closed: *mut i32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_critical_point {
    pub vertex: u32,
    pub kind: i32,
    pub index: i32,
    pub component: u32,
    pub value: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_critical_info {
    pub struct_size: u32,
    pub point_count: u32,
    pub minimum_count: u32,
    pub maximum_count: u32,
    pub saddle_count: u32,
    pub index_sum: i32,
    pub euler_characteristic: i32,
    pub reserved: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_geodesics_desc {
    pub struct_size: u32,
    pub method: i32,
    pub smoothing: f64,
    pub progress: hf_progress,
}

/// A path along the surface, from its first point to its last.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_path {
    pub struct_size: u32,
    pub point_capacity: u32,
    pub point_count: u32,
    pub reserved: u32,
    pub length: f64,
    pub point_edges: *mut u32,
    pub parameters: *mut f64,
    pub positions: *mut f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_extremities_desc {
    pub struct_size: u32,
    pub kind: i32,
    pub least_length_share: f64,
    pub source_count: u32,
    pub reserved: u32,
    pub geodesics: hf_geodesics,
    pub progress: hf_progress,
    pub out_field: *mut f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_extremity {
    pub vertex: u32,
    pub component: u32,
    pub length: f64,
    pub position: [f64; 3],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_direction_desc {
    pub struct_size: u32,
    pub degree: u32,
    pub site_limit: u32,
    pub reserved: u32,
    pub progress: hf_progress,
}

/// A singularity is a triangle, or a face, around which the field makes extra turns.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_singularity {
    pub triangle: u32,
    pub vertex: u32,
    pub index: i32,
}

/// The options a direction field was made with, and counts of its constraints and of the work done so far.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_direction_statistics {
    pub struct_size: u32,
    pub degree: u32,
    pub site_limit: u32,
    pub unknown_count: u32,
    pub site_count: u32,
    pub factorisation_count: u32,
    pub path_solve_count: u32,
    pub sweep_count: u32,
    pub irregular_vertex_count: u32,
    pub eliminated_count: u32,
    pub operator_ms: f64,
    pub numeric_ms: f64,
    pub factor_entries: f64,
    pub factor_bytes: f64,
    pub site_memory_bytes: f64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_pose_desc {
    pub struct_size: u32,
    pub band_count: u32,
    pub iteration_count: u32,
    pub group_count: u32,
}

/// hf_pose_get_info writes the options of a pose here, with defaults filled in, and the number of its handles.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_pose_info {
    pub struct_size: u32,
    pub band_count: u32,
    pub iteration_count: u32,
    pub group_count: u32,
    pub handle_count: u32,
    pub vertex_count: u32,
}

/// The handles to add.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_handles_desc {
    pub struct_size: u32,
    pub handle_count: u32,
    pub region_counts: *const u32,
    pub region_vertices: *const u32,
    pub vertices: *const u32,
    pub places: *const hf_place,
    pub points: *const f64,
    pub radii: *const f64,
    pub layer: u32,
    pub in_place: i32,
    pub free_rotation: i32,
    pub reserved: u32,
    pub progress: hf_progress,
}

/// A rigid motion of a handle from its rest place.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_transform {
    pub rotation: [f64; 4],
    pub translation: [f64; 3],
}

/// hf_pose_get_handle writes the region of a handle here, its layer, and its motion in the last hf_deform.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_handle_info {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub site_count: u32,
    pub component: u32,
    pub centroid: [f64; 3],
    pub leak: f64,
    pub rotation: [f64; 4],
    pub translation: [f64; 3],
    pub layer: u32,
    pub free_rotation: i32,
    pub following: f64,
    pub limb_refine: i32,
    pub reserved: u32,
}

/// The work of a deform.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_deform_info {
    pub struct_size: u32,
    pub iteration_count: u32,
    pub unreached_vertex_count: u32,
    pub reserved: u32,
    pub last_change: f64,
}

/// The options of hf_pose_deform are outputs and a range of vertices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_deform_desc {
    pub struct_size: u32,
    pub iteration_count: u32,
    pub positions: hf_array_out,
    pub normals: hf_array_out,
    pub restart: i32,
    pub refine: i32,
    pub refine_from_last: i32,
    pub first_vertex: u32,
    pub vertex_count: u32,
    pub reserved: u32,
}

/// Size of a pose and times of its last deform, in milliseconds; 0 before the first.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_pose_statistics {
    pub struct_size: u32,
    pub cluster_count: u32,
    pub solve_ms: f64,
    pub blend_ms: f64,
    pub normal_ms: f64,
    pub refine_ms: f64,
}

/// This struct receives a pose or a transfer as a skin for linear blend skinning.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_skin_info {
    pub struct_size: u32,
    pub joint_capacity: u32,
    pub vertex_capacity: u32,
    pub influence_count: u32,
    pub joint_count: u32,
    pub vertex_count: u32,
    pub pivots: *mut f64,
    pub rotations: *mut f64,
    pub translations: *mut f64,
    pub axes: *mut f64,
    pub scales: *mut f64,
    pub vertex_joints: *mut u32,
    pub vertex_weights: *mut f32,
}

/// hf_pose_get_blend_info writes here how the last frame of a pose is blended.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_blend_info {
    pub struct_size: u32,
    pub cluster_count: u32,
    pub revision: u32,
    pub reserved: u32,
    pub offset_share: f64,
    pub centre: [f64; 3],
    pub low: [f64; 3],
    pub high: [f64; 3],
}

/// Receives the rows of a blend.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_blend_rows {
    pub struct_size: u32,
    pub vertex_capacity: u32,
    pub entry_capacity: u32,
    pub vertex_count: u32,
    pub entry_count: u32,
    pub longest_row: u32,
    pub rows: *mut u32,
    pub clusters: *mut u16,
    pub weights: *mut f32,
    pub gradients: *mut f32,
    pub positions: *mut f32,
    pub normals: *mut f32,
    pub offsets: *mut f32,
}

/// Receives a blend as rows of one length, as vertex buffers of engines have them (JOINTS_0 and WEIGHTS_0 of glTF).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_blend_influences {
    pub struct_size: u32,
    pub vertex_capacity: u32,
    pub influence_count: u32,
    pub vertex_count: u32,
    pub change: f64,
    pub byte_change: f64,
    pub error: f64,
    pub byte_error: f64,
    pub clusters: *mut u16,
    pub weights: *mut u16,
    pub byte_clusters: *mut u8,
    pub byte_weights: *mut u8,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_handle_proposals_desc {
    pub struct_size: u32,
    pub joint_count: u32,
    pub joints: *const f64,
    pub parents: *const u32,
    pub skeleton: hf_skeleton,
    pub up: [f64; 3],
    pub least_length_share: f64,
    pub limit: u32,
    pub reserved: u32,
    pub progress: hf_progress,
    pub out_regions: *mut u32,
}

/// One proposed handle.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_handle_proposal {
    pub vertex: u32,
    pub component: u32,
    pub reason: i32,
    pub pinned: i32,
    pub joint: u32,
    pub role: i32,
    pub side: i32,
    pub reserved: u32,
    pub position: [f64; 3],
    pub radius: f64,
    pub length: f64,
    pub following: f64,
}

/// Options of a quad mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_quads_desc {
    pub struct_size: u32,
    pub face_count: u32,
    pub edge_length: f64,
    pub crease_angle: f64,
    pub relax_count: u32,
    pub crease_count: u32,
    pub guide_count: u32,
    pub irregular_count: u32,
    pub symmetry_plane: [f64; 4],
    pub crease_edges: *const u32,
    pub guide_vertices: *const u32,
    pub guide_vectors: *const f64,
    pub guide_weights: *const f32,
    pub irregular_points: *const f64,
    pub irregular_valences: *const u32,
    pub irregular_directions: *const f64,
    pub progress: hf_progress,
}

/// Counts of a quad mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_quads_info {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub face_count: u32,
    pub euler_characteristic: i32,
    pub edge_length: f64,
}

/// hf_quads_get_mesh writes the quad mesh to these arrays.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_quads_mesh {
    pub struct_size: u32,
    pub vertex_capacity: u32,
    pub face_capacity: u32,
    pub vertex_count: u32,
    pub face_count: u32,
    pub reserved: u32,
    pub positions: *mut f64,
    pub faces: *mut u32,
    pub triangles: *mut u32,
    pub barycentrics: *mut f64,
    pub corners: *mut u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_streamlines {
    pub struct_size: u32,
    pub wanted_count: u32,
    pub seed_count: u32,
    pub point_capacity: u32,
    pub line_capacity: u32,
    pub point_count: u32,
    pub line_count: u32,
    pub reserved: u32,
    pub seeds: *const u32,
    pub positions: *mut f64,
    pub values: *mut f64,
    pub line_starts: *mut u32,
    pub line_ends: *mut u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_region_desc {
    pub struct_size: u32,
    pub base: i32,
    pub positions: hf_array,
    pub progress: hf_progress,
}

/// Describes a closed curve through at least 3 points, on the mesh at rest.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_curve_desc {
    pub struct_size: u32,
    pub point_count: u32,
    pub vertices: *const u32,
    pub places: *const hf_place,
    pub points: *const f64,
    pub side: i32,
    pub seed_vertex: u32,
    pub kind: i32,
    pub reserved: u32,
}

/// A change of a region.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_region_edit_desc {
    pub struct_size: u32,
    pub ring_count: i32,
    pub curve: *const hf_curve_desc,
    pub remove_count: u32,
    pub add_count: u32,
    pub remove_vertices: *const u32,
    pub add_vertices: *const u32,
    pub progress: hf_progress,
}

/// Counts and areas of a region.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_region_info {
    pub struct_size: u32,
    pub field_kind: i32,
    pub vertex_count: u32,
    pub rim_count: u32,
    pub site_count: u32,
    pub reserved: u32,
    pub area: f64,
    pub base_area: f64,
}

/// Work of the last edit of a region, and of all its edits.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_region_statistics {
    pub struct_size: u32,
    pub inserted_count: u32,
    pub removed_count: u32,
    pub kept_count: u32,
    pub factorisation_count: u32,
    pub path_solve_count: u32,
    pub last_route: u32,
    pub whole_sweep: i32,
}

/// Gives hf_region_morph and hf_detail_morph their weight and outputs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_morph_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub weight: f64,
    pub positions: hf_array_out,
    pub normals: hf_array_out,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_detail_desc {
    pub struct_size: u32,
    pub pair_count: u32,
    pub source_vertices: *const u32,
    pub target_vertices: *const u32,
    pub scale: f64,
    pub progress: hf_progress,
}

/// Options of a retarget.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_retarget_desc {
    pub struct_size: u32,
    pub root_motion: i32,
    pub leave_out: u32,
    pub reserved: u32,
    pub scale: f64,
    pub ground_velocity: [f64; 3],
    pub source_rest: *const f32,
    pub target_rest: *const f32,
    pub progress: hf_progress,
}

/// Figures of a retarget.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_retarget_info {
    pub struct_size: u32,
    pub source_joint_count: u32,
    pub target_joint_count: u32,
    pub matched_joint_count: u32,
    pub chain_count: u32,
    pub same_skeleton: i32,
    pub scale_from: i32,
    pub frame_count: u32,
    pub scale: f64,
    pub limb_angle: f64,
    pub stride_share: f64,
    pub deepest_drop: f64,
}

/// How a chain of the target follows the source.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_chain_match {
    pub role: i32,
    pub side: i32,
    pub source_joint_count: u32,
    pub target_joint_count: u32,
    pub mean_angle: f64,
    pub worst_angle: f64,
}

/// The skin of a character
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_skin_desc {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub triangle_count: u32,
    pub influence_count: u32,
    pub at_rest: i32,
    pub reserved: u32,
    pub positions: *const f32,
    pub triangles: *const u32,
    pub joints: *const u32,
    pub weights: *const f32,
}

/// The joints of a character at rest.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_skeleton_desc {
    pub struct_size: u32,
    pub joint_count: u32,
    pub names: *const c_char,
    pub parents: *const u32,
    pub rest: *const f32,
    pub inverse_binds: *const f32,
    pub up: *const f32,
    pub forward: *const f32,
    pub roles: *const i32,
    pub sides: *const i32,
    pub travel_count: u32,
    pub reserved: u32,
    pub travels: *const f32,
    pub skin: *const hf_skin_desc,
    pub allocator: hf_allocator,
    pub progress: hf_progress,
}

/// The findings about a character.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_skeleton_info {
    pub struct_size: u32,
    pub joint_count: u32,
    pub chain_count: u32,
    pub reserved: u32,
    pub up: [f64; 3],
    pub forward: [f64; 3],
    pub left: [f64; 3],
    pub middle: [f64; 3],
    pub up_confidence: f64,
    pub forward_confidence: f64,
    pub left_confidence: f64,
    pub role_confidence: f64,
    pub height: f64,
    pub leg_length: f64,
    pub hip_height: f64,
    pub arm_length: f64,
}

/// The findings about a joint.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_joint_info {
    pub kind: i32,
    pub role: i32,
    pub side: i32,
    pub chain: u32,
    pub mate: u32,
}

/// Joints of one role and side, from root to tip.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_chain {
    pub role: i32,
    pub side: i32,
    pub number: u32,
    pub parent: u32,
    pub first: u32,
    pub joint_count: u32,
    pub length: f64,
}

/// most pairs of a transfer
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_transfer_desc {
    pub struct_size: u32,
    pub mode: i32,
    pub cluster_count: u32,
    pub ground: i32,
    pub kernel_width: f64,
    pub scale: f64,
    pub alignment_angle: f64,
    pub source_axes: [f64; 9],
    pub target_axes: [f64; 9],
    pub source_rest: hf_array,
    pub target_rest: hf_array,
}

/// The pairs to add.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_pairs_desc {
    pub struct_size: u32,
    pub pair_count: u32,
    pub source_counts: *const u32,
    pub source_vertices: *const u32,
    pub target_counts: *const u32,
    pub target_vertices: *const u32,
    pub flags: *const u32,
    pub progress: hf_progress,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_pair_info {
    pub struct_size: u32,
    pub flags: u32,
    pub source_leak: f64,
    pub target_leak: f64,
    pub alignment_angle: f64,
    pub confidence: f64,
    pub alignment_share: f64,
    pub aligned: i32,
    pub crossed: i32,
}

/// hf_transfer_get_info writes counts and the scale of a transfer here.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_transfer_info {
    pub struct_size: u32,
    pub pair_count: u32,
    pub cluster_count: u32,
    pub aligned_count: u32,
    pub crossed_count: u32,
    pub scale_found: i32,
    pub scale: f64,
}

/// Work of a transfer.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_transfer_statistics {
    pub struct_size: u32,
    pub source_factorisation_count: u32,
    pub target_factorisation_count: u32,
}

/// Dials that an animator turns while a transfer plays.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_transfer_dials {
    pub struct_size: u32,
    pub reserved: u32,
    pub stride: f64,
    pub hip_height_share: f64,
    pub neck_follow: f64,
    pub tail_follow: f64,
    pub arm_space: f64,
    pub long_follow: f64,
}

/// Describes one frame
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_transfer_frame {
    pub struct_size: u32,
    pub hold_count: u32,
    pub source_positions: hf_array,
    pub target_positions: hf_array_out,
    pub target_normals: hf_array_out,
    pub hold_pairs: *const u32,
    pub hold_positions: *const f64,
}

/// The joints of a skeleton, in the unit and frame of the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_joints_desc {
    pub struct_size: u32,
    pub joint_count: u32,
    pub heads: *const f64,
    pub tails: *const f64,
    pub axes: *const f64,
    pub parents: *const u32,
    pub deforms: *const i32,
    pub sources: *const u32,
    pub progress: hf_progress,
}

/// Places with given weights.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_pins_desc {
    pub struct_size: u32,
    pub pin_count: u32,
    pub vertices: *const u32,
    pub places: *const hf_place,
    pub points: *const f64,
    pub radii: *const f64,
    pub influence_count: u32,
    pub reserved: u32,
    pub joints: *const u32,
    pub weights: *const f32,
    pub progress: hf_progress,
}

/// Receives the weights.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_weights_out {
    pub struct_size: u32,
    pub vertex_capacity: u32,
    pub vertex_count: u32,
    pub influence_count: u32,
    pub joints: *mut u32,
    pub joints_u16: *mut u16,
    pub weights: *mut f32,
    pub origins: *mut u8,
}

/// Counts of the weights.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_weights_info {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub joint_count: u32,
    pub pin_count: u32,
    pub lock_count: u32,
    pub informed_count: u32,
    pub solved_count: u32,
    pub pinned_count: u32,
    pub nearest_count: u32,
    pub rigid_count: u32,
    pub isolated_count: u32,
}

/// Figures of weights for developers
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_weights_statistics {
    pub struct_size: u32,
    pub nearest_piece_count: u32,
    pub rigid_piece_count: u32,
    pub blind: i32,
    pub no_length_count: u32,
    pub coincident_count: u32,
    pub informs_none_count: u32,
    pub outside_count: u32,
    pub helper_count: u32,
    pub factorisation_count: u32,
    pub path_solve_count: u32,
}

/// Weights to transfer from one surface to another.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_weights_transfer_desc {
    pub struct_size: u32,
    pub source_influence_count: u32,
    pub joints: *const u32,
    pub weights: *const f32,
    pub distance: f64,
    pub angle: f64,
    pub influence_count: u32,
    pub reserved: u32,
    pub progress: hf_progress,
}

/// Counts of transferred weights.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_weights_transfer_info {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub matched_count: u32,
    pub solved_count: u32,
    pub nearest_count: u32,
    pub rigid_count: u32,
    pub isolated_count: u32,
    pub guessed_piece_count: u32,
}

/// Weights to mirror.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_weights_mirror_desc {
    pub struct_size: u32,
    pub joint_count: u32,
    pub heads: *const f64,
    pub names: *const c_char,
    pub partners: *const u32,
    pub plane: *const f64,
    pub source_influence_count: u32,
    pub to: i32,
    pub joints: *const u32,
    pub weights: *const f32,
    pub distance: f64,
    pub angle: f64,
    pub influence_count: u32,
    pub reserved: u32,
    pub progress: hf_progress,
}

/// The plane that hf_weights_mirror found, and counts of joints and vertices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_weights_mirror_info {
    pub struct_size: u32,
    pub vertex_count: u32,
    pub plane_from: i32,
    pub named_count: u32,
    pub placed_count: u32,
    pub centre_count: u32,
    pub given_count: u32,
    pub alone_count: u32,
    pub kept_count: u32,
    pub matched_count: u32,
    pub solved_count: u32,
    pub nearest_count: u32,
    pub rigid_count: u32,
    pub isolated_count: u32,
    pub point: [f64; 3],
    pub normal: [f64; 3],
}

/// Distances of a surface and its joints from their reflections, in the unit of the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct hf_weights_mirror_statistics {
    pub struct_size: u32,
    pub worst_joint: u32,
    pub worst_vertex: u32,
    pub reserved: u32,
    pub joint_off: f64,
    pub worst_joint_off: f64,
    pub vertex_off: f64,
    pub worst_vertex_off: f64,
}

/// Structs of zeros with their size.
macro_rules! sized {
    ($($name:ident)*) => {$(
        impl Default for $name {
            fn default() -> Self {
                // SAFETY: every field may be zero: numbers, arrays of numbers and null pointers.
                let mut made: Self = unsafe { std::mem::zeroed() };
                made.struct_size = std::mem::size_of::<Self>() as u32;
                made
            }
        }
    )*};
}

/// Structs of zeros.
macro_rules! zeroed {
    ($($name:ident)*) => {$(
        impl Default for $name {
            fn default() -> Self {
                // SAFETY: every field may be zero: numbers, arrays of numbers and null pointers.
                unsafe { std::mem::zeroed() }
            }
        }
    )*};
}

/// Structs whose figures can be asked by name.
macro_rules! figures {
    ($($name:ident: $($field:ident)*;)*) => {$(
        impl $name {
            /// The figure of this name, for generic tools.
            pub fn figure(&self, name: &str) -> Option<f64> {
                Some(match name {
                    $(stringify!($field) => f64::from(self.$field),)*
                    _ => return None,
                })
            }
        }
    )*};
}

sized! {
    hf_factor_desc hf_links_desc hf_faces_desc hf_surface_desc hf_graph_desc hf_surface_info hf_surface_report
        hf_mesh_statistics hf_links_info hf_gaps_info hf_patch_desc hf_surface_edit_desc hf_surface_statistics
        hf_cut_desc hf_cut hf_pick_desc hf_hit hf_solver_desc hf_solver_info hf_sites_desc hf_edit_desc
        hf_sites_info hf_solve_info hf_preview_info hf_certificate hf_solver_statistics hf_isolines hf_critical_info
        hf_geodesics_desc hf_path hf_extremities_desc hf_direction_desc hf_direction_statistics hf_pose_desc
        hf_pose_info hf_handles_desc hf_handle_info hf_deform_info hf_deform_desc hf_pose_statistics hf_skin_info
        hf_blend_info hf_blend_rows hf_blend_influences hf_handle_proposals_desc hf_quads_desc hf_quads_info
        hf_quads_mesh hf_streamlines hf_region_desc hf_curve_desc hf_region_edit_desc hf_region_info
        hf_region_statistics hf_morph_desc hf_detail_desc hf_retarget_desc hf_retarget_info hf_skin_desc
        hf_skeleton_desc hf_skeleton_info hf_transfer_desc hf_pairs_desc hf_pair_info hf_transfer_info
        hf_transfer_statistics hf_transfer_dials hf_transfer_frame hf_joints_desc hf_pins_desc hf_weights_out
        hf_weights_info hf_weights_statistics hf_weights_transfer_desc hf_weights_transfer_info
        hf_weights_mirror_desc hf_weights_mirror_info hf_weights_mirror_statistics
}

zeroed! {
    hf_array hf_array_out hf_error_detail hf_allocator hf_job_runner hf_link hf_cut_corner hf_place
        hf_critical_point hf_extremity hf_singularity hf_transform hf_handle_proposal hf_chain_match hf_joint_info
        hf_chain
}

figures! {
    hf_surface_info: struct_size vertex_count triangle_count weld weld_tolerance operator_kind field_kind ordering
        thread_count vertex_limit triangle_limit memory_limit_mb work_limit_gflop edge_count edge_limit face_count
        corner_count;
    hf_surface_report: struct_size vertex_count triangle_count welded_vertex_count component_count
        isolated_vertex_count degenerate_triangle_count collapsed_triangle_count duplicate_triangle_count
        non_manifold_edge_count flipped_edge_count boundary_edge_count inside_out_count first_inside_out_vertex
        bounding_box_diagonal;
    hf_mesh_statistics: struct_size polygon_count non_planar_count largest_face negative_edge_count
        changed_vertex_count first_changed_vertex reserved smallest_angle;
    hf_links_info: struct_size piece_count link_count light_piece_count lone_piece_count contact_count
        longest_tree_link;
    hf_gaps_info: struct_size link_count percentile_95 worst worst_link contact_count worst_contact contact_vertex
        touching_count worst_opening opening_vertex reserved;
    hf_surface_statistics: struct_size unknown_count weld_ms operator_ms ordering_ms symbolic_ms numeric_ms
        factor_entries factor_bytes factor_flops memory_bytes peak_memory_bytes load_ms factor_loaded
        factor_borrowed links_ms;
    hf_solver_info: struct_size field_kind channel_count site_limit site_count vertex_count;
    hf_solve_info: struct_size unreached_component_count first_unreached_component unreached_vertex_count;
    hf_preview_info: struct_size exact correction_count unreached_component_count value_range largest_correction
        error_estimate preview_bytes;
    hf_certificate: struct_size overshoot_checked tolerance value_range residual site_error overshoot worst_vertex
        changed_vertex_count error_estimate;
    hf_solver_statistics: struct_size site_count factorisation_count path_solve_count sweep_count last_route
        rebase_count dense_edit_count dense_row_count eliminated_count rebase_advised reserved site_memory_bytes
        predicted_dense_ms predicted_rebase_ms;
    hf_critical_info: struct_size point_count minimum_count maximum_count saddle_count index_sum
        euler_characteristic reserved;
    hf_direction_statistics: struct_size degree site_limit unknown_count site_count factorisation_count
        path_solve_count sweep_count irregular_vertex_count eliminated_count operator_ms numeric_ms factor_entries
        factor_bytes site_memory_bytes;
    hf_pose_info: struct_size band_count iteration_count group_count handle_count vertex_count;
    hf_handle_info: struct_size vertex_count site_count component leak layer free_rotation following limb_refine
        reserved;
    hf_deform_info: struct_size iteration_count unreached_vertex_count reserved last_change;
    hf_pose_statistics: struct_size cluster_count solve_ms blend_ms normal_ms refine_ms;
    hf_blend_info: struct_size cluster_count revision reserved offset_share;
    hf_quads_info: struct_size vertex_count face_count euler_characteristic edge_length;
    hf_region_info: struct_size field_kind vertex_count rim_count site_count reserved area base_area;
    hf_region_statistics: struct_size inserted_count removed_count kept_count factorisation_count path_solve_count
        last_route whole_sweep;
    hf_retarget_info: struct_size source_joint_count target_joint_count matched_joint_count chain_count
        same_skeleton scale_from frame_count scale limb_angle stride_share deepest_drop;
    hf_skeleton_info: struct_size joint_count chain_count reserved up_confidence forward_confidence left_confidence
        role_confidence height leg_length hip_height arm_length;
    hf_joint_info: kind role side chain mate;
    hf_pair_info: struct_size flags source_leak target_leak alignment_angle confidence alignment_share aligned
        crossed;
    hf_transfer_info: struct_size pair_count cluster_count aligned_count crossed_count scale_found scale;
    hf_transfer_statistics: struct_size source_factorisation_count target_factorisation_count;
    hf_transfer_dials: struct_size reserved stride hip_height_share neck_follow tail_follow arm_space long_follow;
    hf_weights_info: struct_size vertex_count joint_count pin_count lock_count informed_count solved_count
        pinned_count nearest_count rigid_count isolated_count;
    hf_weights_statistics: struct_size nearest_piece_count rigid_piece_count blind no_length_count coincident_count
        informs_none_count outside_count helper_count factorisation_count path_solve_count;
    hf_weights_transfer_info: struct_size vertex_count matched_count solved_count nearest_count rigid_count
        isolated_count guessed_piece_count;
    hf_weights_mirror_info: struct_size vertex_count plane_from named_count placed_count centre_count given_count
        alone_count kept_count matched_count solved_count nearest_count rigid_count isolated_count;
    hf_weights_mirror_statistics: struct_size worst_joint worst_vertex reserved joint_off worst_joint_off vertex_off
        worst_vertex_off;
}

extern "C" {
    pub fn hf_error_get_detail(out_detail: *mut hf_error_detail) -> i32;
    pub fn hf_result_get_name(result: i32) -> *const c_char;
    pub fn hf_version_get() -> u32;
    pub fn hf_progress_create(out_progress: *mut hf_progress) -> i32;
    pub fn hf_progress_destroy(progress: hf_progress);
    pub fn hf_progress_get_fraction(progress: hf_progress, out_fraction: *mut f64) -> i32;
    pub fn hf_progress_cancel(progress: hf_progress) -> i32;
    pub fn hf_surface_create(desc: *const hf_surface_desc, out_surface: *mut hf_surface) -> i32;
    pub fn hf_surface_create_graph(desc: *const hf_graph_desc, out_surface: *mut hf_surface) -> i32;
    pub fn hf_surface_destroy(surface: hf_surface);
    pub fn hf_surface_get_info(surface: hf_surface, out_info: *mut hf_surface_info) -> i32;
    pub fn hf_surface_get_report(surface: hf_surface, out_report: *mut hf_surface_report) -> i32;
    pub fn hf_surface_get_mesh_statistics(surface: hf_surface, out_statistics: *mut hf_mesh_statistics) -> i32;
    pub fn hf_surface_get_components(surface: hf_surface, capacity: u32, out_components: *mut u32, out_count: *mut u32) -> i32;
    pub fn hf_surface_get_links_info(surface: hf_surface, out_info: *mut hf_links_info) -> i32;
    pub fn hf_surface_get_links(surface: hf_surface, capacity: u32, out_links: *mut hf_link, out_count: *mut u32) -> i32;
    pub fn hf_surface_get_pieces(surface: hf_surface, capacity: u32, out_pieces: *mut u32, out_light: *mut i32, out_count: *mut u32) -> i32;
    pub fn hf_surface_measure_gaps(surface: hf_surface, positions: *const hf_array, capacity: u32, out_gaps: *mut f64, out_info: *mut hf_gaps_info) -> i32;
    pub fn hf_surface_relink(surface: hf_surface, links: *const hf_links_desc, progress: hf_progress, out_surface: *mut hf_surface) -> i32;
    pub fn hf_surface_edit(surface: hf_surface, desc: *const hf_surface_edit_desc, out_surface: *mut hf_surface) -> i32;
    pub fn hf_surface_get_cuts(surface: hf_surface, capacity: u32, out_cuts: *mut hf_cut_corner, out_count: *mut u32) -> i32;
    pub fn hf_surface_get_stiffness(surface: hf_surface, capacity: u32, out_stiffness: *mut f64, out_count: *mut u32) -> i32;
    pub fn hf_surface_get_statistics(surface: hf_surface, out_statistics: *mut hf_surface_statistics) -> i32;
    pub fn hf_surface_save(surface: hf_surface, field_kind: i32, progress: hf_progress, capacity: usize, out_bytes: *mut c_void, out_size: *mut usize) -> i32;
    pub fn hf_surface_trace_cut(surface: hf_surface, desc: *const hf_cut_desc, inout_cut: *mut hf_cut) -> i32;
    pub fn hf_surface_cast_ray(surface: hf_surface, origin: *const f64, direction: *const f64, desc: *const hf_pick_desc, out_hit: *mut hf_hit) -> i32;
    pub fn hf_surface_find_vertex(surface: hf_surface, point: *const f64, desc: *const hf_pick_desc, out_vertex: *mut u32, out_distance: *mut f64) -> i32;
    pub fn hf_create(surface: hf_surface, desc: *const hf_solver_desc, out_solver: *mut hf_solver) -> i32;
    pub fn hf_solver_clone(solver: hf_solver, out_solver: *mut hf_solver) -> i32;
    pub fn hf_solver_move_to(solver: hf_solver, surface: hf_surface) -> i32;
    pub fn hf_solver_destroy(solver: hf_solver);
    pub fn hf_solver_get_info(solver: hf_solver, out_info: *mut hf_solver_info) -> i32;
    pub fn hf_add_sites(solver: hf_solver, sites: *const hf_sites_desc, out_sites: *mut u32) -> i32;
    pub fn hf_solver_add_site(solver: hf_solver, vertex: u32, values: *const f64, out_site: *mut u32) -> i32;
    pub fn hf_remove_sites(solver: hf_solver, site_count: u32, sites: *const u32) -> i32;
    pub fn hf_solver_move_sites(solver: hf_solver, site_count: u32, sites: *const u32, to: *const hf_sites_desc) -> i32;
    pub fn hf_solver_set_values(solver: hf_solver, site_count: u32, sites: *const u32, values: *const f64) -> i32;
    pub fn hf_solver_edit_sites(solver: hf_solver, edit: *const hf_edit_desc, out_sites: *mut u32) -> i32;
    pub fn hf_solver_get_site_count(solver: hf_solver) -> u32;
    pub fn hf_solver_get_sites(solver: hf_solver, inout_info: *mut hf_sites_info) -> i32;
    pub fn hf_solver_set_screening(solver: hf_solver, screening: *const f64, targets: *const f64) -> i32;
    pub fn hf_solve(solver: hf_solver, out_values: *mut f32, value_stride: u32, out_info: *mut hf_solve_info) -> i32;
    pub fn hf_solver_solve(solver: hf_solver, out_values: *const hf_array_out, out_info: *mut hf_solve_info) -> i32;
    pub fn hf_solver_solve_at(solver: hf_solver, vertex_count: u32, vertices: *const u32, out_values: *mut f64) -> i32;
    pub fn hf_solver_solve_vectors(solver: hf_solver, out_vectors: *const hf_array_out, out_normals: *mut f64, out_info: *mut hf_solve_info) -> i32;
    pub fn hf_solver_solve_preview(solver: hf_solver, out_values: *const hf_array_out, correction_count: u32, out_info: *mut hf_preview_info) -> i32;
    pub fn hf_solver_release_preview(solver: hf_solver) -> i32;
    pub fn hf_solver_move_vectors(solver: hf_solver, site_count: u32, sites: *const u32, vertices: *const u32) -> i32;
    pub fn hf_solver_rotate_vectors(solver: hf_solver, site_count: u32, sites: *const u32, angles: *const f64) -> i32;
    pub fn hf_solver_certify(solver: hf_solver, inout_certificate: *mut hf_certificate) -> i32;
    pub fn hf_solver_prepare_rebase(solver: hf_solver) -> i32;
    pub fn hf_solver_get_statistics(solver: hf_solver, out_statistics: *mut hf_solver_statistics) -> i32;
    pub fn hf_surface_space_levels(surface: hf_surface, field: *const hf_array, spacing: i32, level_count: u32, out_levels: *mut f64) -> i32;
    pub fn hf_surface_trace_isolines(surface: hf_surface, field: *const hf_array, level_count: u32, levels: *const f64, inout_lines: *mut hf_isolines) -> i32;
    pub fn hf_surface_find_critical_points(surface: hf_surface, field: *const hf_array, capacity: u32, out_points: *mut hf_critical_point, out_info: *mut hf_critical_info) -> i32;
    pub fn hf_geodesics_create(surface: hf_surface, desc: *const hf_geodesics_desc, out_geodesics: *mut hf_geodesics) -> i32;
    pub fn hf_geodesics_destroy(geodesics: hf_geodesics);
    pub fn hf_geodesics_solve(geodesics: hf_geodesics, source_count: u32, sources: *const u32, out_distances: *const hf_array_out) -> i32;
    pub fn hf_geodesics_find_path(geodesics: hf_geodesics, from: *const hf_place, to: *const hf_place, inout_path: *mut hf_path) -> i32;
    pub fn hf_geodesics_get_map(geodesics: hf_geodesics, centre: *const hf_place, radius: f64, out_map: *mut f64, out_frame: *mut f64) -> i32;
    pub fn hf_surface_find_extremities(surface: hf_surface, desc: *const hf_extremities_desc, capacity: u32, out_extremities: *mut hf_extremity, out_count: *mut u32) -> i32;
    pub fn hf_direction_create(surface: hf_surface, desc: *const hf_direction_desc, out_direction: *mut hf_direction) -> i32;
    pub fn hf_direction_clone(direction: hf_direction, out_direction: *mut hf_direction) -> i32;
    pub fn hf_direction_destroy(direction: hf_direction);
    pub fn hf_direction_add_sites(direction: hf_direction, site_count: u32, vertices: *const u32, vectors: *const f64, out_sites: *mut u32) -> i32;
    pub fn hf_direction_remove_sites(direction: hf_direction, site_count: u32, sites: *const u32) -> i32;
    pub fn hf_direction_move_sites(direction: hf_direction, site_count: u32, sites: *const u32, vertices: *const u32) -> i32;
    pub fn hf_direction_set_vectors(direction: hf_direction, site_count: u32, sites: *const u32, vectors: *const f64) -> i32;
    pub fn hf_direction_rotate_sites(direction: hf_direction, site_count: u32, sites: *const u32, angles: *const f64) -> i32;
    pub fn hf_direction_get_site_count(direction: hf_direction) -> u32;
    pub fn hf_direction_get_sites(direction: hf_direction, capacity: u32, out_sites: *mut u32, out_vertices: *mut u32, out_vectors: *mut f64, out_count: *mut u32) -> i32;
    pub fn hf_direction_solve(direction: hf_direction, out_vectors: *const hf_array_out, out_info: *mut hf_solve_info) -> i32;
    pub fn hf_direction_get_singularities(direction: hf_direction, capacity: u32, out_singularities: *mut hf_singularity, out_count: *mut u32) -> i32;
    pub fn hf_direction_get_statistics(direction: hf_direction, out_statistics: *mut hf_direction_statistics) -> i32;
    pub fn hf_pose_create(surface: hf_surface, desc: *const hf_pose_desc, out_pose: *mut hf_pose) -> i32;
    pub fn hf_pose_clone(pose: hf_pose, out_pose: *mut hf_pose) -> i32;
    pub fn hf_pose_move_to(pose: hf_pose, surface: hf_surface) -> i32;
    pub fn hf_pose_destroy(pose: hf_pose);
    pub fn hf_pose_get_info(pose: hf_pose, out_info: *mut hf_pose_info) -> i32;
    pub fn hf_pose_add_handles(pose: hf_pose, handles: *const hf_handles_desc, out_handles: *mut u32) -> i32;
    pub fn hf_pose_add_handle_at(pose: hf_pose, point: *const f64, radius: f64, out_handle: *mut u32) -> i32;
    pub fn hf_pose_remove_handles(pose: hf_pose, handle_count: u32, handles: *const u32) -> i32;
    pub fn hf_pose_set_transforms(pose: hf_pose, handle_count: u32, handles: *const u32, transforms: *const hf_transform) -> i32;
    pub fn hf_pose_set_transform(pose: hf_pose, handle: u32, transform: *const hf_transform) -> i32;
    pub fn hf_pose_set_free_rotations(pose: hf_pose, handle_count: u32, handles: *const u32, free_rotation: i32) -> i32;
    pub fn hf_pose_set_following(pose: hf_pose, handle_count: u32, handles: *const u32, following: f64) -> i32;
    pub fn hf_pose_set_limb_refine(pose: hf_pose, handle_count: u32, handles: *const u32, refine: i32) -> i32;
    pub fn hf_pose_set_rigid_pieces(pose: hf_pose, vertex_count: u32, vertices: *const u32) -> i32;
    pub fn hf_pose_set_matrices(pose: hf_pose, handle_count: u32, handles: *const u32, matrices: *const f64) -> i32;
    pub fn hf_pose_get_handle(pose: hf_pose, handle: u32, out_info: *mut hf_handle_info) -> i32;
    pub fn hf_pose_get_handle_count(pose: hf_pose) -> u32;
    pub fn hf_pose_get_field(pose: hf_pose, handle: u32, out_values: *const hf_array_out) -> i32;
    pub fn hf_deform(pose: hf_pose, out_positions: *mut f32, out_info: *mut hf_deform_info) -> i32;
    pub fn hf_pose_deform(pose: hf_pose, desc: *const hf_deform_desc, out_info: *mut hf_deform_info) -> i32;
    pub fn hf_pose_get_statistics(pose: hf_pose, out_statistics: *mut hf_pose_statistics) -> i32;
    pub fn hf_pose_get_skin(pose: hf_pose, inout_skin: *mut hf_skin_info) -> i32;
    pub fn hf_pose_get_blend_info(pose: hf_pose, out_info: *mut hf_blend_info) -> i32;
    pub fn hf_pose_get_blend_rows(pose: hf_pose, inout_rows: *mut hf_blend_rows) -> i32;
    pub fn hf_pose_get_blend_influences(pose: hf_pose, inout_influences: *mut hf_blend_influences) -> i32;
    pub fn hf_pose_solve(pose: hf_pose, iteration_count: u32, restart: i32, out_info: *mut hf_deform_info) -> i32;
    pub fn hf_pose_get_blend_transforms(pose: hf_pose, capacity: u32, out_transforms: *mut f32, out_count: *mut u32) -> i32;
    pub fn hf_surface_propose_handles(surface: hf_surface, desc: *const hf_handle_proposals_desc, capacity: u32, out_proposals: *mut hf_handle_proposal, out_count: *mut u32) -> i32;
    pub fn hf_quads_create(surface: hf_surface, desc: *const hf_quads_desc, out_quads: *mut hf_quads) -> i32;
    pub fn hf_quads_update(quads: hf_quads, desc: *const hf_quads_desc) -> i32;
    pub fn hf_quads_destroy(quads: hf_quads);
    pub fn hf_quads_get_info(quads: hf_quads, out_info: *mut hf_quads_info) -> i32;
    pub fn hf_quads_get_mesh(quads: hf_quads, inout_mesh: *mut hf_quads_mesh) -> i32;
    pub fn hf_flow_create(surface: hf_surface, out_flow: *mut hf_flow) -> i32;
    pub fn hf_flow_destroy(flow: hf_flow);
    pub fn hf_flow_trace(flow: hf_flow, field: *const hf_array, inout_lines: *mut hf_streamlines) -> i32;
    pub fn hf_region_create(surface: hf_surface, desc: *const hf_region_desc, out_region: *mut hf_region) -> i32;
    pub fn hf_region_clone(region: hf_region, out_region: *mut hf_region) -> i32;
    pub fn hf_region_destroy(region: hf_region);
    pub fn hf_region_edit(region: hf_region, edit: *const hf_region_edit_desc) -> i32;
    pub fn hf_region_get_info(region: hf_region, out_info: *mut hf_region_info) -> i32;
    pub fn hf_region_get_statistics(region: hf_region, out_statistics: *mut hf_region_statistics) -> i32;
    pub fn hf_region_get_vertices(region: hf_region, list: i32, capacity: u32, out_vertices: *mut u32, out_count: *mut u32) -> i32;
    pub fn hf_region_get_curve(region: hf_region, capacity: u32, out_points: *mut f64, out_count: *mut u32) -> i32;
    pub fn hf_region_morph(region: hf_region, desc: *const hf_morph_desc) -> i32;
    pub fn hf_detail_create(source: hf_region, target: hf_region, desc: *const hf_detail_desc, out_detail: *mut hf_detail) -> i32;
    pub fn hf_detail_destroy(detail: hf_detail);
    pub fn hf_detail_morph(detail: hf_detail, desc: *const hf_morph_desc) -> i32;
    pub fn hf_retarget_create(source: hf_skeleton, target: hf_skeleton, desc: *const hf_retarget_desc, out_retarget: *mut hf_retarget) -> i32;
    pub fn hf_retarget_clone(retarget: hf_retarget, out_retarget: *mut hf_retarget) -> i32;
    pub fn hf_retarget_destroy(retarget: hf_retarget);
    pub fn hf_retarget_solve(retarget: hf_retarget, source_pose: *const f32, seconds: f64, out_target_pose: *mut f32) -> i32;
    pub fn hf_retarget_reset(retarget: hf_retarget) -> i32;
    pub fn hf_retarget_get_info(retarget: hf_retarget, out_info: *mut hf_retarget_info) -> i32;
    pub fn hf_retarget_get_chains(retarget: hf_retarget, capacity: u32, out_chains: *mut hf_chain_match, out_count: *mut u32) -> i32;
    pub fn hf_retarget_get_partners(retarget: hf_retarget, capacity: u32, out_partners: *mut u32, out_count: *mut u32) -> i32;
    pub fn hf_skeleton_get_ground_velocity(skeleton: hf_skeleton, frame_count: u32, poses: *const f32, seconds: f64, out_velocity: *mut f64) -> i32;
    pub fn hf_skeleton_create(desc: *const hf_skeleton_desc, out_skeleton: *mut hf_skeleton) -> i32;
    pub fn hf_skeleton_destroy(skeleton: hf_skeleton);
    pub fn hf_skeleton_get_info(skeleton: hf_skeleton, out_info: *mut hf_skeleton_info) -> i32;
    pub fn hf_skeleton_get_joints(skeleton: hf_skeleton, capacity: u32, out_joints: *mut hf_joint_info, out_count: *mut u32) -> i32;
    pub fn hf_skeleton_get_chains(skeleton: hf_skeleton, capacity: u32, out_chains: *mut hf_chain, out_count: *mut u32) -> i32;
    pub fn hf_skeleton_get_chain_joints(skeleton: hf_skeleton, capacity: u32, out_joints: *mut u32, out_count: *mut u32) -> i32;
    pub fn hf_skeleton_get_reasons(skeleton: hf_skeleton, capacity: usize, out_text: *mut c_char, out_size: *mut usize) -> i32;
    pub fn hf_transfer_create(source: hf_surface, target: hf_surface, desc: *const hf_transfer_desc, out_transfer: *mut hf_transfer) -> i32;
    pub fn hf_transfer_destroy(transfer: hf_transfer);
    pub fn hf_transfer_add_pairs(transfer: hf_transfer, pairs: *const hf_pairs_desc, out_pairs: *mut u32) -> i32;
    pub fn hf_transfer_remove_pairs(transfer: hf_transfer, pair_count: u32, pairs: *const u32) -> i32;
    pub fn hf_transfer_get_pair(transfer: hf_transfer, pair: u32, out_info: *mut hf_pair_info) -> i32;
    pub fn hf_transfer_get_info(transfer: hf_transfer, out_info: *mut hf_transfer_info) -> i32;
    pub fn hf_transfer_get_statistics(transfer: hf_transfer, out_statistics: *mut hf_transfer_statistics) -> i32;
    pub fn hf_transfer_set_dials(transfer: hf_transfer, dials: *const hf_transfer_dials) -> i32;
    pub fn hf_transfer_get_dials(transfer: hf_transfer, out_dials: *mut hf_transfer_dials) -> i32;
    pub fn hf_transfer_set_rigid_pieces(transfer: hf_transfer, vertex_count: u32, vertices: *const u32) -> i32;
    pub fn hf_transfer_apply(transfer: hf_transfer, frame: *const hf_transfer_frame) -> i32;
    pub fn hf_transfer_get_sinking(transfer: hf_transfer, out_sinking: *mut u8) -> i32;
    pub fn hf_transfer_get_skin(transfer: hf_transfer, inout_skin: *mut hf_skin_info) -> i32;
    pub fn hf_weights_create(surface: hf_surface, joints: *const hf_joints_desc, influence_count: u32, out_weights: *mut hf_weights) -> i32;
    pub fn hf_weights_clone(weights: hf_weights, out_weights: *mut hf_weights) -> i32;
    pub fn hf_weights_destroy(weights: hf_weights);
    pub fn hf_weights_set_joints(weights: hf_weights, joints: *const hf_joints_desc) -> i32;
    pub fn hf_weights_set_pins(weights: hf_weights, pins: *const hf_pins_desc) -> i32;
    pub fn hf_weights_set_locks(weights: hf_weights, lock_count: u32, joints: *const u32, values: *const f32) -> i32;
    pub fn hf_weights_get(weights: hf_weights, inout_weights: *mut hf_weights_out) -> i32;
    pub fn hf_weights_get_joints(weights: hf_weights, capacity: u32, out_flags: *mut u32, out_vertex_counts: *mut u32, out_count: *mut u32) -> i32;
    pub fn hf_weights_get_info(weights: hf_weights, out_info: *mut hf_weights_info) -> i32;
    pub fn hf_weights_get_statistics(weights: hf_weights, out_statistics: *mut hf_weights_statistics) -> i32;
    pub fn hf_weights_get_helpers(weights: hf_weights, names: *const c_char, capacity: u32, out_reasons: *mut u32, out_count: *mut u32) -> i32;
    pub fn hf_weights_transfer(source: hf_surface, target: hf_surface, desc: *const hf_weights_transfer_desc, inout_weights: *mut hf_weights_out, out_info: *mut hf_weights_transfer_info) -> i32;
    pub fn hf_weights_mirror(surface: hf_surface, desc: *const hf_weights_mirror_desc, inout_weights: *mut hf_weights_out, out_partners: *mut u32, out_pairings: *mut u32, out_info: *mut hf_weights_mirror_info, out_statistics: *mut hf_weights_mirror_statistics) -> i32;
}
