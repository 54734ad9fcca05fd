// Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI as P/Invoke sees it.
using System;
using System.Runtime.InteropServices;

namespace Hf.Native
{
    public static class Constants
    {
        public const string HeaderVersion = "0.1.0";
        public const int HF_VERSION_MAJOR = 0;
        public const int HF_VERSION_MINOR = 1;
        public const int HF_VERSION_PATCH = 0;
        public const uint HF_NO_INDEX = 4294967295u;
        public const int HF_MESSAGE_SIZE = 256;
        public const int HF_OK = 0;
        public const int HF_ERROR_INVALID_ARGUMENT = -1;
        public const int HF_ERROR_NULL_POINTER = -2;
        public const int HF_ERROR_INVALID_OBJECT = -3;
        public const int HF_ERROR_INVALID_DESC = -4;
        public const int HF_ERROR_OUT_OF_RANGE = -5;
        public const int HF_ERROR_NON_FINITE = -6;
        public const int HF_ERROR_EMPTY = -7;
        public const int HF_ERROR_NOT_FOUND = -8;
        public const int HF_ERROR_DUPLICATE = -9;
        public const int HF_ERROR_CONFLICT = -10;
        public const int HF_ERROR_UNSUPPORTED = -11;
        public const int HF_ERROR_BUSY = -12;
        public const int HF_ERROR_REENTRANT = -13;
        public const int HF_ERROR_TOO_SMALL = -14;
        public const int HF_ERROR_OUT_OF_MEMORY = -100;
        public const int HF_ERROR_TOO_LARGE = -101;
        public const int HF_ERROR_CANCELLED = -102;
        public const int HF_ERROR_NOT_POSITIVE_DEFINITE = -200;
        public const int HF_ERROR_INACCURATE = -201;
        public const int HF_ERROR_INTERNAL = -300;
        public const int HF_TYPE_PLAIN = 0;
        public const int HF_TYPE_DOUBLE = 1;
        public const int HF_TYPE_UINT16 = 2;
        public const int HF_WELD_EXACT = 0;
        public const int HF_WELD_NONE = 1;
        public const int HF_WELD_TOLERANCE = 2;
        public const int HF_OPERATOR_INTRINSIC_DELAUNAY = 0;
        public const int HF_OPERATOR_CLAMPED = 1;
        public const int HF_OPERATOR_UNIFORM = 2;
        public const int HF_OPERATOR_COTANGENT = 3;
        public const int HF_OPERATOR_GRAPH = 4;
        public const int HF_FIELD_HARMONIC = 0;
        public const int HF_FIELD_BIHARMONIC = 1;
        public const int HF_FIELD_BIHARMONIC_GRAPH = 2;
        public const int HF_ORDERING_NESTED_DISSECTION = 0;
        public const int HF_ORDERING_MINIMUM_DEGREE = 1;
        public const int HF_ORDERING_METIS = 2;
        public const int HF_FACTOR_ALIGNMENT = 64;
        public const int HF_LINK_NONE = 0;
        public const int HF_LINK_PIECES = 1;
        public const int HF_LINK_LIST = 2;
        public const int HF_ROUTE_NONE = 0;
        public const int HF_ROUTE_DENSE = 1;
        public const int HF_ROUTE_FRESH = 2;
        public const int HF_ROUTE_REBASE = 3;
        public const int HF_LEVELS_VALUE = 0;
        public const int HF_LEVELS_AREA = 1;
        public const int HF_LEVELS_LENGTH = 2;
        public const int HF_CRITICAL_MINIMUM = 0;
        public const int HF_CRITICAL_MAXIMUM = 1;
        public const int HF_CRITICAL_SADDLE = 2;
        public const int HF_GEODESICS_AUTO = 0;
        public const int HF_GEODESICS_FRONT = 1;
        public const int HF_GEODESICS_EXACT = 2;
        public const int HF_GEODESICS_HEAT = 3;
        public const int HF_EXTREMITIES_POISSON = 0;
        public const int HF_EXTREMITIES_GEODESIC = 1;
        public const int HF_LAYER_COUNT = 8;
        public const int HF_HANDLE_LIMIT = 256;
        public const int HF_HANDLE_REASON_FOOT = 0;
        public const int HF_HANDLE_REASON_TIP = 1;
        public const int HF_HANDLE_REASON_END = 2;
        public const int HF_HANDLE_REASON_JOINT = 3;
        public const int HF_HANDLE_REASON_MIDDLE = 4;
        public const int HF_BASE_DEFAULT = 0;
        public const int HF_BASE_MEMBRANE = 1;
        public const int HF_BASE_THIN_PLATE = 2;
        public const int HF_BASE_THIN_PLATE_GRAPH = 3;
        public const int HF_SIDE_SMALLER = 0;
        public const int HF_SIDE_LARGER = 1;
        public const int HF_SIDE_SEED = 2;
        public const int HF_CURVE_STRAIGHT = 0;
        public const int HF_CURVE_EDGES = 1;
        public const int HF_REGION_INSIDE = 0;
        public const int HF_REGION_RIM = 1;
        public const int HF_REGION_SITES = 2;
        public const int HF_ROOT_MOTION_HIPS = 0;
        public const int HF_ROOT_MOTION_ROOT = 1;
        public const int HF_ROOT_MOTION_IN_PLACE = 2;
        public const int HF_RETARGET_KEEP_RESTS = 1;
        public const int HF_RETARGET_NO_GOALS = 2;
        public const int HF_RETARGET_NO_LOCK = 4;
        public const int HF_RETARGET_NO_COPY = 8;
        public const int HF_SCALE_GIVEN = 0;
        public const int HF_SCALE_LEGS = 1;
        public const int HF_SCALE_HIPS = 2;
        public const int HF_SCALE_HEIGHT = 3;
        public const int HF_ROLE_OTHER = 0;
        public const int HF_ROLE_SPINE = 1;
        public const int HF_ROLE_NECK = 2;
        public const int HF_ROLE_HEAD = 3;
        public const int HF_ROLE_JAW = 4;
        public const int HF_ROLE_SHOULDER = 5;
        public const int HF_ROLE_ARM = 6;
        public const int HF_ROLE_HAND = 7;
        public const int HF_ROLE_FINGER = 8;
        public const int HF_ROLE_LEG = 9;
        public const int HF_ROLE_FOOT = 10;
        public const int HF_ROLE_TOE = 11;
        public const int HF_ROLE_TAIL = 12;
        public const int HF_ROLE_WING = 13;
        public const int HF_ROLE_EAR = 14;
        public const int HF_ROLE_EYE = 15;
        public const int HF_ROLE_ANTENNA = 16;
        public const int HF_ROLE_FIN = 17;
        public const int HF_SIDE_MIDDLE = 0;
        public const int HF_SIDE_LEFT = 1;
        public const int HF_SIDE_RIGHT = 2;
        public const int HF_JOINT_KIND_BODY = 0;
        public const int HF_JOINT_KIND_HELPER = 1;
        public const int HF_JOINT_KIND_END = 2;
        public const int HF_JOINT_KIND_TWIST = 3;
        public const int HF_TRANSFER_FIELDS = 0;
        public const int HF_TRANSFER_STRETCH = 1;
        public const int HF_GROUND_KEEP = 0;
        public const int HF_GROUND_OFF = 1;
        public const int HF_PAIR_ANCHOR = 1;
        public const int HF_PAIR_FOOT = 2;
        public const int HF_PAIR_TRUNK = 4;
        public const int HF_PAIR_NO_ALIGNMENT = 8;
        public const int HF_PAIR_CONTACT = 16;
        public const int HF_PAIR_SINKS = 32;
        public const int HF_PAIR_NECK = 64;
        public const int HF_PAIR_TAIL = 128;
        public const int HF_PAIR_ARM = 256;
        public const int HF_PAIR_LIMIT = 256;
        public const int HF_WEIGHTS_INFORMED = 0;
        public const int HF_WEIGHTS_SOLVED = 1;
        public const int HF_WEIGHTS_PINNED = 2;
        public const int HF_WEIGHTS_NEAREST = 3;
        public const int HF_WEIGHTS_RIGID = 4;
        public const int HF_WEIGHTS_ISOLATED = 5;
        public const int HF_WEIGHTS_MATCHED = 6;
        public const int HF_WEIGHTS_KEPT = 7;
        public const int HF_JOINT_NO_LENGTH = 1;
        public const int HF_JOINT_COINCIDENT = 2;
        public const int HF_JOINT_INFORMS_NONE = 4;
        public const int HF_JOINT_OUTSIDE = 8;
        public const int HF_JOINT_HELPER = 16;
        public const int HF_HELPER_PROPOSED = 1;
        public const int HF_HELPER_NAME_ROOT = 2;
        public const int HF_HELPER_NAME_CONTROL = 4;
        public const int HF_HELPER_NAME_END = 8;
        public const int HF_HELPER_ROOT = 16;
        public const int HF_HELPER_APART = 32;
        public const int HF_HELPER_NO_LENGTH = 64;
        public const int HF_HELPER_COINCIDENT = 128;
        public const int HF_HELPER_OUTSIDE = 256;
        public const int HF_HELPER_INFORMS_NONE = 512;
        public const int HF_MIRROR_TO_NEGATIVE = 0;
        public const int HF_MIRROR_TO_POSITIVE = 1;
        public const int HF_MIRROR_BOTH = 2;
        public const int HF_MIRROR_PLANE_GIVEN = 0;
        public const int HF_MIRROR_PLANE_JOINTS = 1;
        public const int HF_MIRROR_PLANE_SURFACE = 2;
        public const int HF_MIRROR_JOINT_ALONE = 0;
        public const int HF_MIRROR_JOINT_NAMED = 1;
        public const int HF_MIRROR_JOINT_PLACED = 2;
        public const int HF_MIRROR_JOINT_CENTRE = 3;
        public const int HF_MIRROR_JOINT_GIVEN = 4;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_array
    {
        public IntPtr data;
        public uint count;
        public uint stride;
        public int type;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_array_out
    {
        public IntPtr data;
        public uint count;
        public uint stride;
        public int type;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_error_detail
    {
        public int code;
        public uint index;
        public fixed byte function[48];
        public fixed byte message[256];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_allocator
    {
        public IntPtr allocate;
        public IntPtr release;
        public IntPtr user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_job_runner
    {
        public IntPtr run;
        public IntPtr user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_factor_desc
    {
        public uint struct_size;
        public int borrow;
        public IntPtr bytes;
        public UIntPtr byte_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_link
    {
        public uint vertex;
        public fixed uint corners[3];
        public fixed double barycentrics[3];
        public double length;
        public double weight;
        public int in_tree;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_links_desc
    {
        public uint struct_size;
        public int mode;
        public double distance;
        public double stiffness;
        public double overlay_distance;
        public uint influence_count;
        public uint link_count;
        public uint light_count;
        public uint heavy_count;
        public uint joint_count;
        public uint reserved;
        public IntPtr joints;
        public IntPtr weights;
        public IntPtr joint_parents;
        public IntPtr tags;
        public IntPtr links;
        public IntPtr light_vertices;
        public IntPtr heavy_vertices;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_faces_desc
    {
        public uint struct_size;
        public uint reserved;
        public hf_array corners;
        public hf_array sizes;
        public hf_array starts;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_surface_desc
    {
        public uint struct_size;
        public int weld;
        public hf_array positions;
        public hf_array triangles;
        public IntPtr faces;
        public double weld_tolerance;
        public int operator_kind;
        public int field_kind;
        public int ordering;
        public uint thread_count;
        public uint vertex_limit;
        public uint triangle_limit;
        public uint memory_limit_mb;
        public uint work_limit_gflop;
        public hf_allocator allocator;
        public hf_job_runner job_runner;
        public IntPtr progress;
        public IntPtr saved_factor;
        public IntPtr links;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_graph_desc
    {
        public uint struct_size;
        public uint vertex_count;
        public hf_array edges;
        public hf_array weights;
        public hf_array masses;
        public int allow_negative;
        public int field_kind;
        public int ordering;
        public uint thread_count;
        public uint vertex_limit;
        public uint edge_limit;
        public uint memory_limit_mb;
        public uint work_limit_gflop;
        public hf_allocator allocator;
        public hf_job_runner job_runner;
        public IntPtr progress;
        public IntPtr saved_factor;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_surface_info
    {
        public uint struct_size;
        public uint vertex_count;
        public uint triangle_count;
        public int weld;
        public double weld_tolerance;
        public int operator_kind;
        public int field_kind;
        public int ordering;
        public uint thread_count;
        public uint vertex_limit;
        public uint triangle_limit;
        public uint memory_limit_mb;
        public uint work_limit_gflop;
        public uint edge_count;
        public uint edge_limit;
        public uint face_count;
        public uint corner_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_surface_report
    {
        public uint struct_size;
        public uint vertex_count;
        public uint triangle_count;
        public uint welded_vertex_count;
        public uint component_count;
        public uint isolated_vertex_count;
        public uint degenerate_triangle_count;
        public uint collapsed_triangle_count;
        public uint duplicate_triangle_count;
        public uint non_manifold_edge_count;
        public uint flipped_edge_count;
        public uint boundary_edge_count;
        public uint inside_out_count;
        public uint first_inside_out_vertex;
        public double bounding_box_diagonal;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_mesh_statistics
    {
        public uint struct_size;
        public uint polygon_count;
        public uint non_planar_count;
        public uint largest_face;
        public uint negative_edge_count;
        public uint changed_vertex_count;
        public uint first_changed_vertex;
        public uint reserved;
        public double smallest_angle;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_links_info
    {
        public uint struct_size;
        public uint piece_count;
        public uint link_count;
        public uint light_piece_count;
        public uint lone_piece_count;
        public uint contact_count;
        public double longest_tree_link;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_gaps_info
    {
        public uint struct_size;
        public uint link_count;
        public double percentile_95;
        public double worst;
        public uint worst_link;
        public uint contact_count;
        public double worst_contact;
        public uint contact_vertex;
        public uint touching_count;
        public double worst_opening;
        public uint opening_vertex;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_patch_desc
    {
        public uint struct_size;
        public uint removed_triangle_count;
        public uint new_vertex_count;
        public uint new_triangle_count;
        public uint cut_edge_count;
        public uint reserved;
        public IntPtr removed_triangles;
        public IntPtr new_positions;
        public IntPtr new_triangles;
        public IntPtr cut_edges;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_surface_edit_desc
    {
        public uint struct_size;
        public uint vertex_count;
        public IntPtr vertices;
        public IntPtr stiffness;
        public uint link_count;
        public uint removed_link_count;
        public IntPtr links;
        public IntPtr removed_links;
        public IntPtr patch;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_cut_corner
    {
        public uint triangle;
        public uint corner;
        public uint vertex;
        public uint copied;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_surface_statistics
    {
        public uint struct_size;
        public uint unknown_count;
        public double weld_ms;
        public double operator_ms;
        public double ordering_ms;
        public double symbolic_ms;
        public double numeric_ms;
        public double factor_entries;
        public double factor_bytes;
        public double factor_flops;
        public double memory_bytes;
        public double peak_memory_bytes;
        public double load_ms;
        public int factor_loaded;
        public int factor_borrowed;
        public double links_ms;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_place
    {
        public fixed uint corners[3];
        public uint reserved;
        public fixed double barycentrics[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_cut_desc
    {
        public uint struct_size;
        public uint point_count;
        public IntPtr vertices;
        public IntPtr places;
        public IntPtr points;
        public double snap_share;
        public uint crossing_limit;
        public uint reserved;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_cut
    {
        public uint struct_size;
        public uint removed_triangle_capacity;
        public uint new_vertex_capacity;
        public uint new_triangle_capacity;
        public uint rim_capacity;
        public uint removed_triangle_count;
        public uint new_vertex_count;
        public uint new_triangle_count;
        public uint rim_count;
        public uint reserved;
        public IntPtr removed_triangles;
        public IntPtr new_positions;
        public IntPtr new_triangles;
        public IntPtr vertex_corners;
        public IntPtr vertex_barycentrics;
        public IntPtr source_triangles;
        public IntPtr corner_barycentrics;
        public IntPtr rim_vertices;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_pick_desc
    {
        public uint struct_size;
        public int front_only;
        public hf_array positions;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_hit
    {
        public uint struct_size;
        public int found;
        public uint triangle;
        public uint vertex;
        public hf_place place;
        public fixed double position[3];
        public double distance;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_solver_desc
    {
        public uint struct_size;
        public int field_kind;
        public uint channel_count;
        public uint site_limit;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_solver_info
    {
        public uint struct_size;
        public int field_kind;
        public uint channel_count;
        public uint site_limit;
        public uint site_count;
        public uint vertex_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_sites_desc
    {
        public uint struct_size;
        public uint site_count;
        public IntPtr vertices;
        public IntPtr places;
        public IntPtr points;
        public IntPtr values;
        public IntPtr stiffness;
        public IntPtr radii;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_edit_desc
    {
        public uint struct_size;
        public uint remove_count;
        public IntPtr remove_sites;
        public uint move_count;
        public uint set_count;
        public IntPtr move_sites;
        public IntPtr move_to;
        public IntPtr set_sites;
        public IntPtr set_values;
        public IntPtr add;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_sites_info
    {
        public uint struct_size;
        public uint capacity;
        public uint count;
        public uint reserved;
        public IntPtr sites;
        public IntPtr vertices;
        public IntPtr components;
        public IntPtr values;
        public IntPtr stiffness;
        public IntPtr flux;
        public IntPtr radii;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_solve_info
    {
        public uint struct_size;
        public uint unreached_component_count;
        public uint first_unreached_component;
        public uint unreached_vertex_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_preview_info
    {
        public uint struct_size;
        public int exact;
        public uint correction_count;
        public uint unreached_component_count;
        public double value_range;
        public double largest_correction;
        public double error_estimate;
        public double preview_bytes;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_certificate
    {
        public uint struct_size;
        public int overshoot_checked;
        public double tolerance;
        public double value_range;
        public double residual;
        public double site_error;
        public double overshoot;
        public uint worst_vertex;
        public uint changed_vertex_count;
        public double error_estimate;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_solver_statistics
    {
        public uint struct_size;
        public uint site_count;
        public uint factorisation_count;
        public uint path_solve_count;
        public uint sweep_count;
        public uint last_route;
        public uint rebase_count;
        public uint dense_edit_count;
        public uint dense_row_count;
        public uint eliminated_count;
        public int rebase_advised;
        public uint reserved;
        public double site_memory_bytes;
        public double predicted_dense_ms;
        public double predicted_rebase_ms;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_isolines
    {
        public uint struct_size;
        public uint point_capacity;
        public uint line_capacity;
        public uint point_count;
        public uint line_count;
        public uint reserved;
        public IntPtr point_edges;
        public IntPtr parameters;
        public IntPtr positions;
        public IntPtr line_starts;
        public IntPtr line_levels;
        public IntPtr line_closed;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_critical_point
    {
        public uint vertex;
        public int kind;
        public int index;
        public uint component;
        public double value;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_critical_info
    {
        public uint struct_size;
        public uint point_count;
        public uint minimum_count;
        public uint maximum_count;
        public uint saddle_count;
        public int index_sum;
        public int euler_characteristic;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_geodesics_desc
    {
        public uint struct_size;
        public int method;
        public double smoothing;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_path
    {
        public uint struct_size;
        public uint point_capacity;
        public uint point_count;
        public uint reserved;
        public double length;
        public IntPtr point_edges;
        public IntPtr parameters;
        public IntPtr positions;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_extremities_desc
    {
        public uint struct_size;
        public int kind;
        public double least_length_share;
        public uint source_count;
        public uint reserved;
        public IntPtr geodesics;
        public IntPtr progress;
        public IntPtr out_field;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_extremity
    {
        public uint vertex;
        public uint component;
        public double length;
        public fixed double position[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_direction_desc
    {
        public uint struct_size;
        public uint degree;
        public uint site_limit;
        public uint reserved;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_singularity
    {
        public uint triangle;
        public uint vertex;
        public int index;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_direction_statistics
    {
        public uint struct_size;
        public uint degree;
        public uint site_limit;
        public uint unknown_count;
        public uint site_count;
        public uint factorisation_count;
        public uint path_solve_count;
        public uint sweep_count;
        public uint irregular_vertex_count;
        public uint eliminated_count;
        public double operator_ms;
        public double numeric_ms;
        public double factor_entries;
        public double factor_bytes;
        public double site_memory_bytes;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_pose_desc
    {
        public uint struct_size;
        public uint band_count;
        public uint iteration_count;
        public uint group_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_pose_info
    {
        public uint struct_size;
        public uint band_count;
        public uint iteration_count;
        public uint group_count;
        public uint handle_count;
        public uint vertex_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_handles_desc
    {
        public uint struct_size;
        public uint handle_count;
        public IntPtr region_counts;
        public IntPtr region_vertices;
        public IntPtr vertices;
        public IntPtr places;
        public IntPtr points;
        public IntPtr radii;
        public uint layer;
        public int in_place;
        public int free_rotation;
        public uint reserved;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_transform
    {
        public fixed double rotation[4];
        public fixed double translation[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_handle_info
    {
        public uint struct_size;
        public uint vertex_count;
        public uint site_count;
        public uint component;
        public fixed double centroid[3];
        public double leak;
        public fixed double rotation[4];
        public fixed double translation[3];
        public uint layer;
        public int free_rotation;
        public double following;
        public int limb_refine;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_deform_info
    {
        public uint struct_size;
        public uint iteration_count;
        public uint unreached_vertex_count;
        public uint reserved;
        public double last_change;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_deform_desc
    {
        public uint struct_size;
        public uint iteration_count;
        public hf_array_out positions;
        public hf_array_out normals;
        public int restart;
        public int refine;
        public int refine_from_last;
        public uint first_vertex;
        public uint vertex_count;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_pose_statistics
    {
        public uint struct_size;
        public uint cluster_count;
        public double solve_ms;
        public double blend_ms;
        public double normal_ms;
        public double refine_ms;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_skin_info
    {
        public uint struct_size;
        public uint joint_capacity;
        public uint vertex_capacity;
        public uint influence_count;
        public uint joint_count;
        public uint vertex_count;
        public IntPtr pivots;
        public IntPtr rotations;
        public IntPtr translations;
        public IntPtr axes;
        public IntPtr scales;
        public IntPtr vertex_joints;
        public IntPtr vertex_weights;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_blend_info
    {
        public uint struct_size;
        public uint cluster_count;
        public uint revision;
        public uint reserved;
        public double offset_share;
        public fixed double centre[3];
        public fixed double low[3];
        public fixed double high[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_blend_rows
    {
        public uint struct_size;
        public uint vertex_capacity;
        public uint entry_capacity;
        public uint vertex_count;
        public uint entry_count;
        public uint longest_row;
        public IntPtr rows;
        public IntPtr clusters;
        public IntPtr weights;
        public IntPtr gradients;
        public IntPtr positions;
        public IntPtr normals;
        public IntPtr offsets;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_blend_influences
    {
        public uint struct_size;
        public uint vertex_capacity;
        public uint influence_count;
        public uint vertex_count;
        public double change;
        public double byte_change;
        public double error;
        public double byte_error;
        public IntPtr clusters;
        public IntPtr weights;
        public IntPtr byte_clusters;
        public IntPtr byte_weights;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_handle_proposals_desc
    {
        public uint struct_size;
        public uint joint_count;
        public IntPtr joints;
        public IntPtr parents;
        public IntPtr skeleton;
        public fixed double up[3];
        public double least_length_share;
        public uint limit;
        public uint reserved;
        public IntPtr progress;
        public IntPtr out_regions;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_handle_proposal
    {
        public uint vertex;
        public uint component;
        public int reason;
        public int pinned;
        public uint joint;
        public int role;
        public int side;
        public uint reserved;
        public fixed double position[3];
        public double radius;
        public double length;
        public double following;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_quads_desc
    {
        public uint struct_size;
        public uint face_count;
        public double edge_length;
        public double crease_angle;
        public uint relax_count;
        public uint crease_count;
        public uint guide_count;
        public uint irregular_count;
        public fixed double symmetry_plane[4];
        public IntPtr crease_edges;
        public IntPtr guide_vertices;
        public IntPtr guide_vectors;
        public IntPtr guide_weights;
        public IntPtr irregular_points;
        public IntPtr irregular_valences;
        public IntPtr irregular_directions;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_quads_info
    {
        public uint struct_size;
        public uint vertex_count;
        public uint face_count;
        public int euler_characteristic;
        public double edge_length;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_quads_mesh
    {
        public uint struct_size;
        public uint vertex_capacity;
        public uint face_capacity;
        public uint vertex_count;
        public uint face_count;
        public uint reserved;
        public IntPtr positions;
        public IntPtr faces;
        public IntPtr triangles;
        public IntPtr barycentrics;
        public IntPtr corners;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_streamlines
    {
        public uint struct_size;
        public uint wanted_count;
        public uint seed_count;
        public uint point_capacity;
        public uint line_capacity;
        public uint point_count;
        public uint line_count;
        public uint reserved;
        public IntPtr seeds;
        public IntPtr positions;
        public IntPtr values;
        public IntPtr line_starts;
        public IntPtr line_ends;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_region_desc
    {
        public uint struct_size;
        public int @base;
        public hf_array positions;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_curve_desc
    {
        public uint struct_size;
        public uint point_count;
        public IntPtr vertices;
        public IntPtr places;
        public IntPtr points;
        public int side;
        public uint seed_vertex;
        public int kind;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_region_edit_desc
    {
        public uint struct_size;
        public int ring_count;
        public IntPtr curve;
        public uint remove_count;
        public uint add_count;
        public IntPtr remove_vertices;
        public IntPtr add_vertices;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_region_info
    {
        public uint struct_size;
        public int field_kind;
        public uint vertex_count;
        public uint rim_count;
        public uint site_count;
        public uint reserved;
        public double area;
        public double base_area;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_region_statistics
    {
        public uint struct_size;
        public uint inserted_count;
        public uint removed_count;
        public uint kept_count;
        public uint factorisation_count;
        public uint path_solve_count;
        public uint last_route;
        public int whole_sweep;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_morph_desc
    {
        public uint struct_size;
        public uint reserved;
        public double weight;
        public hf_array_out positions;
        public hf_array_out normals;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_detail_desc
    {
        public uint struct_size;
        public uint pair_count;
        public IntPtr source_vertices;
        public IntPtr target_vertices;
        public double scale;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_retarget_desc
    {
        public uint struct_size;
        public int root_motion;
        public uint leave_out;
        public uint reserved;
        public double scale;
        public fixed double ground_velocity[3];
        public IntPtr source_rest;
        public IntPtr target_rest;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_retarget_info
    {
        public uint struct_size;
        public uint source_joint_count;
        public uint target_joint_count;
        public uint matched_joint_count;
        public uint chain_count;
        public int same_skeleton;
        public int scale_from;
        public uint frame_count;
        public double scale;
        public double limb_angle;
        public double stride_share;
        public double deepest_drop;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_chain_match
    {
        public int role;
        public int side;
        public uint source_joint_count;
        public uint target_joint_count;
        public double mean_angle;
        public double worst_angle;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_skin_desc
    {
        public uint struct_size;
        public uint vertex_count;
        public uint triangle_count;
        public uint influence_count;
        public int at_rest;
        public uint reserved;
        public IntPtr positions;
        public IntPtr triangles;
        public IntPtr joints;
        public IntPtr weights;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_skeleton_desc
    {
        public uint struct_size;
        public uint joint_count;
        public IntPtr names;
        public IntPtr parents;
        public IntPtr rest;
        public IntPtr inverse_binds;
        public IntPtr up;
        public IntPtr forward;
        public IntPtr roles;
        public IntPtr sides;
        public uint travel_count;
        public uint reserved;
        public IntPtr travels;
        public IntPtr skin;
        public hf_allocator allocator;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_skeleton_info
    {
        public uint struct_size;
        public uint joint_count;
        public uint chain_count;
        public uint reserved;
        public fixed double up[3];
        public fixed double forward[3];
        public fixed double left[3];
        public fixed double middle[3];
        public double up_confidence;
        public double forward_confidence;
        public double left_confidence;
        public double role_confidence;
        public double height;
        public double leg_length;
        public double hip_height;
        public double arm_length;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_joint_info
    {
        public int kind;
        public int role;
        public int side;
        public uint chain;
        public uint mate;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_chain
    {
        public int role;
        public int side;
        public uint number;
        public uint parent;
        public uint first;
        public uint joint_count;
        public double length;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_transfer_desc
    {
        public uint struct_size;
        public int mode;
        public uint cluster_count;
        public int ground;
        public double kernel_width;
        public double scale;
        public double alignment_angle;
        public fixed double source_axes[9];
        public fixed double target_axes[9];
        public hf_array source_rest;
        public hf_array target_rest;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_pairs_desc
    {
        public uint struct_size;
        public uint pair_count;
        public IntPtr source_counts;
        public IntPtr source_vertices;
        public IntPtr target_counts;
        public IntPtr target_vertices;
        public IntPtr flags;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_pair_info
    {
        public uint struct_size;
        public uint flags;
        public double source_leak;
        public double target_leak;
        public double alignment_angle;
        public double confidence;
        public double alignment_share;
        public int aligned;
        public int crossed;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_transfer_info
    {
        public uint struct_size;
        public uint pair_count;
        public uint cluster_count;
        public uint aligned_count;
        public uint crossed_count;
        public int scale_found;
        public double scale;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_transfer_statistics
    {
        public uint struct_size;
        public uint source_factorisation_count;
        public uint target_factorisation_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_transfer_dials
    {
        public uint struct_size;
        public uint reserved;
        public double stride;
        public double hip_height_share;
        public double neck_follow;
        public double tail_follow;
        public double arm_space;
        public double long_follow;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_transfer_frame
    {
        public uint struct_size;
        public uint hold_count;
        public hf_array source_positions;
        public hf_array_out target_positions;
        public hf_array_out target_normals;
        public IntPtr hold_pairs;
        public IntPtr hold_positions;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_joints_desc
    {
        public uint struct_size;
        public uint joint_count;
        public IntPtr heads;
        public IntPtr tails;
        public IntPtr axes;
        public IntPtr parents;
        public IntPtr deforms;
        public IntPtr sources;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_pins_desc
    {
        public uint struct_size;
        public uint pin_count;
        public IntPtr vertices;
        public IntPtr places;
        public IntPtr points;
        public IntPtr radii;
        public uint influence_count;
        public uint reserved;
        public IntPtr joints;
        public IntPtr weights;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_weights_out
    {
        public uint struct_size;
        public uint vertex_capacity;
        public uint vertex_count;
        public uint influence_count;
        public IntPtr joints;
        public IntPtr joints_u16;
        public IntPtr weights;
        public IntPtr origins;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_weights_info
    {
        public uint struct_size;
        public uint vertex_count;
        public uint joint_count;
        public uint pin_count;
        public uint lock_count;
        public uint informed_count;
        public uint solved_count;
        public uint pinned_count;
        public uint nearest_count;
        public uint rigid_count;
        public uint isolated_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_weights_statistics
    {
        public uint struct_size;
        public uint nearest_piece_count;
        public uint rigid_piece_count;
        public int blind;
        public uint no_length_count;
        public uint coincident_count;
        public uint informs_none_count;
        public uint outside_count;
        public uint helper_count;
        public uint factorisation_count;
        public uint path_solve_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_weights_transfer_desc
    {
        public uint struct_size;
        public uint source_influence_count;
        public IntPtr joints;
        public IntPtr weights;
        public double distance;
        public double angle;
        public uint influence_count;
        public uint reserved;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_weights_transfer_info
    {
        public uint struct_size;
        public uint vertex_count;
        public uint matched_count;
        public uint solved_count;
        public uint nearest_count;
        public uint rigid_count;
        public uint isolated_count;
        public uint guessed_piece_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_weights_mirror_desc
    {
        public uint struct_size;
        public uint joint_count;
        public IntPtr heads;
        public IntPtr names;
        public IntPtr partners;
        public IntPtr plane;
        public uint source_influence_count;
        public int to;
        public IntPtr joints;
        public IntPtr weights;
        public double distance;
        public double angle;
        public uint influence_count;
        public uint reserved;
        public IntPtr progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_weights_mirror_info
    {
        public uint struct_size;
        public uint vertex_count;
        public int plane_from;
        public uint named_count;
        public uint placed_count;
        public uint centre_count;
        public uint given_count;
        public uint alone_count;
        public uint kept_count;
        public uint matched_count;
        public uint solved_count;
        public uint nearest_count;
        public uint rigid_count;
        public uint isolated_count;
        public fixed double point[3];
        public fixed double normal[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct hf_weights_mirror_statistics
    {
        public uint struct_size;
        public uint worst_joint;
        public uint worst_vertex;
        public uint reserved;
        public double joint_off;
        public double worst_joint_off;
        public double vertex_off;
        public double worst_vertex_off;
    }

    public static unsafe class Functions
    {
#if UNITY_IOS && !UNITY_EDITOR
        internal const string LibraryName = "__Internal";
#else
        internal const string LibraryName = "hf";
#endif

        static Functions() { Library.Load(); }

        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_error_get_detail(void* out_detail);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern IntPtr hf_result_get_name(int result);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern uint hf_version_get();
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_progress_create(void* out_progress);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_progress_destroy(IntPtr progress);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_progress_get_fraction(IntPtr progress, void* out_fraction);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_progress_cancel(IntPtr progress);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_create(void* desc, void* out_surface);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_create_graph(void* desc, void* out_surface);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_surface_destroy(IntPtr surface);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_info(IntPtr surface, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_report(IntPtr surface, void* out_report);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_mesh_statistics(IntPtr surface, void* out_statistics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_components(IntPtr surface, uint capacity, void* out_components, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_links_info(IntPtr surface, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_links(IntPtr surface, uint capacity, void* out_links, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_pieces(IntPtr surface, uint capacity, void* out_pieces, void* out_light, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_measure_gaps(IntPtr surface, void* positions, uint capacity, void* out_gaps, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_relink(IntPtr surface, void* links, IntPtr progress, void* out_surface);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_edit(IntPtr surface, void* desc, void* out_surface);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_cuts(IntPtr surface, uint capacity, void* out_cuts, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_stiffness(IntPtr surface, uint capacity, void* out_stiffness, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_get_statistics(IntPtr surface, void* out_statistics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_save(IntPtr surface, int field_kind, IntPtr progress, UIntPtr capacity, void* out_bytes, void* out_size);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_trace_cut(IntPtr surface, void* desc, void* inout_cut);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_cast_ray(IntPtr surface, void* origin, void* direction, void* desc, void* out_hit);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_find_vertex(IntPtr surface, void* point, void* desc, void* out_vertex, void* out_distance);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_create(IntPtr surface, void* desc, void* out_solver);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_clone(IntPtr solver, void* out_solver);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_move_to(IntPtr solver, IntPtr surface);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_solver_destroy(IntPtr solver);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_get_info(IntPtr solver, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_add_sites(IntPtr solver, void* sites, void* out_sites);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_add_site(IntPtr solver, uint vertex, void* values, void* out_site);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_remove_sites(IntPtr solver, uint site_count, void* sites);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_move_sites(IntPtr solver, uint site_count, void* sites, void* to);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_set_values(IntPtr solver, uint site_count, void* sites, void* values);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_edit_sites(IntPtr solver, void* edit, void* out_sites);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern uint hf_solver_get_site_count(IntPtr solver);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_get_sites(IntPtr solver, void* inout_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_set_screening(IntPtr solver, void* screening, void* targets);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solve(IntPtr solver, void* out_values, uint value_stride, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_solve(IntPtr solver, void* out_values, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_solve_at(IntPtr solver, uint vertex_count, void* vertices, void* out_values);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_solve_vectors(IntPtr solver, void* out_vectors, void* out_normals, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_solve_preview(IntPtr solver, void* out_values, uint correction_count, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_release_preview(IntPtr solver);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_move_vectors(IntPtr solver, uint site_count, void* sites, void* vertices);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_rotate_vectors(IntPtr solver, uint site_count, void* sites, void* angles);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_certify(IntPtr solver, void* inout_certificate);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_prepare_rebase(IntPtr solver);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_solver_get_statistics(IntPtr solver, void* out_statistics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_space_levels(IntPtr surface, void* field, int spacing, uint level_count, void* out_levels);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_trace_isolines(IntPtr surface, void* field, uint level_count, void* levels, void* inout_lines);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_find_critical_points(IntPtr surface, void* field, uint capacity, void* out_points, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_geodesics_create(IntPtr surface, void* desc, void* out_geodesics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_geodesics_destroy(IntPtr geodesics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_geodesics_solve(IntPtr geodesics, uint source_count, void* sources, void* out_distances);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_geodesics_find_path(IntPtr geodesics, void* from, void* to, void* inout_path);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_geodesics_get_map(IntPtr geodesics, void* centre, double radius, void* out_map, void* out_frame);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_find_extremities(IntPtr surface, void* desc, uint capacity, void* out_extremities, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_create(IntPtr surface, void* desc, void* out_direction);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_clone(IntPtr direction, void* out_direction);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_direction_destroy(IntPtr direction);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_add_sites(IntPtr direction, uint site_count, void* vertices, void* vectors, void* out_sites);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_remove_sites(IntPtr direction, uint site_count, void* sites);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_move_sites(IntPtr direction, uint site_count, void* sites, void* vertices);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_set_vectors(IntPtr direction, uint site_count, void* sites, void* vectors);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_rotate_sites(IntPtr direction, uint site_count, void* sites, void* angles);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern uint hf_direction_get_site_count(IntPtr direction);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_get_sites(IntPtr direction, uint capacity, void* out_sites, void* out_vertices, void* out_vectors, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_solve(IntPtr direction, void* out_vectors, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_get_singularities(IntPtr direction, uint capacity, void* out_singularities, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_direction_get_statistics(IntPtr direction, void* out_statistics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_create(IntPtr surface, void* desc, void* out_pose);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_clone(IntPtr pose, void* out_pose);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_move_to(IntPtr pose, IntPtr surface);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_pose_destroy(IntPtr pose);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_info(IntPtr pose, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_add_handles(IntPtr pose, void* handles, void* out_handles);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_add_handle_at(IntPtr pose, void* point, double radius, void* out_handle);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_remove_handles(IntPtr pose, uint handle_count, void* handles);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_set_transforms(IntPtr pose, uint handle_count, void* handles, void* transforms);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_set_transform(IntPtr pose, uint handle, void* transform);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_set_free_rotations(IntPtr pose, uint handle_count, void* handles, int free_rotation);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_set_following(IntPtr pose, uint handle_count, void* handles, double following);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_set_limb_refine(IntPtr pose, uint handle_count, void* handles, int refine);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_set_rigid_pieces(IntPtr pose, uint vertex_count, void* vertices);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_set_matrices(IntPtr pose, uint handle_count, void* handles, void* matrices);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_handle(IntPtr pose, uint handle, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern uint hf_pose_get_handle_count(IntPtr pose);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_field(IntPtr pose, uint handle, void* out_values);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_deform(IntPtr pose, void* out_positions, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_deform(IntPtr pose, void* desc, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_statistics(IntPtr pose, void* out_statistics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_skin(IntPtr pose, void* inout_skin);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_blend_info(IntPtr pose, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_blend_rows(IntPtr pose, void* inout_rows);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_blend_influences(IntPtr pose, void* inout_influences);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_solve(IntPtr pose, uint iteration_count, int restart, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_pose_get_blend_transforms(IntPtr pose, uint capacity, void* out_transforms, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_surface_propose_handles(IntPtr surface, void* desc, uint capacity, void* out_proposals, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_quads_create(IntPtr surface, void* desc, void* out_quads);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_quads_update(IntPtr quads, void* desc);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_quads_destroy(IntPtr quads);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_quads_get_info(IntPtr quads, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_quads_get_mesh(IntPtr quads, void* inout_mesh);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_flow_create(IntPtr surface, void* out_flow);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_flow_destroy(IntPtr flow);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_flow_trace(IntPtr flow, void* field, void* inout_lines);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_region_create(IntPtr surface, void* desc, void* out_region);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_region_clone(IntPtr region, void* out_region);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_region_destroy(IntPtr region);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_region_edit(IntPtr region, void* edit);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_region_get_info(IntPtr region, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_region_get_statistics(IntPtr region, void* out_statistics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_region_get_vertices(IntPtr region, int list, uint capacity, void* out_vertices, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_region_get_curve(IntPtr region, uint capacity, void* out_points, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_region_morph(IntPtr region, void* desc);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_detail_create(IntPtr source, IntPtr target, void* desc, void* out_detail);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_detail_destroy(IntPtr detail);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_detail_morph(IntPtr detail, void* desc);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_retarget_create(IntPtr source, IntPtr target, void* desc, void* out_retarget);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_retarget_clone(IntPtr retarget, void* out_retarget);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_retarget_destroy(IntPtr retarget);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_retarget_solve(IntPtr retarget, void* source_pose, double seconds, void* out_target_pose);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_retarget_reset(IntPtr retarget);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_retarget_get_info(IntPtr retarget, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_retarget_get_chains(IntPtr retarget, uint capacity, void* out_chains, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_retarget_get_partners(IntPtr retarget, uint capacity, void* out_partners, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_skeleton_get_ground_velocity(IntPtr skeleton, uint frame_count, void* poses, double seconds, void* out_velocity);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_skeleton_create(void* desc, void* out_skeleton);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_skeleton_destroy(IntPtr skeleton);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_skeleton_get_info(IntPtr skeleton, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_skeleton_get_joints(IntPtr skeleton, uint capacity, void* out_joints, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_skeleton_get_chains(IntPtr skeleton, uint capacity, void* out_chains, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_skeleton_get_chain_joints(IntPtr skeleton, uint capacity, void* out_joints, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_skeleton_get_reasons(IntPtr skeleton, UIntPtr capacity, void* out_text, void* out_size);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_create(IntPtr source, IntPtr target, void* desc, void* out_transfer);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_transfer_destroy(IntPtr transfer);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_add_pairs(IntPtr transfer, void* pairs, void* out_pairs);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_remove_pairs(IntPtr transfer, uint pair_count, void* pairs);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_get_pair(IntPtr transfer, uint pair, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_get_info(IntPtr transfer, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_get_statistics(IntPtr transfer, void* out_statistics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_set_dials(IntPtr transfer, void* dials);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_get_dials(IntPtr transfer, void* out_dials);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_set_rigid_pieces(IntPtr transfer, uint vertex_count, void* vertices);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_apply(IntPtr transfer, void* frame);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_get_sinking(IntPtr transfer, void* out_sinking);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_transfer_get_skin(IntPtr transfer, void* inout_skin);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_create(IntPtr surface, void* joints, uint influence_count, void* out_weights);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_clone(IntPtr weights, void* out_weights);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern void hf_weights_destroy(IntPtr weights);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_set_joints(IntPtr weights, void* joints);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_set_pins(IntPtr weights, void* pins);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_set_locks(IntPtr weights, uint lock_count, void* joints, void* values);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_get(IntPtr weights, void* inout_weights);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_get_joints(IntPtr weights, uint capacity, void* out_flags, void* out_vertex_counts, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_get_info(IntPtr weights, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_get_statistics(IntPtr weights, void* out_statistics);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_get_helpers(IntPtr weights, void* names, uint capacity, void* out_reasons, void* out_count);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_transfer(IntPtr source, IntPtr target, void* desc, void* inout_weights, void* out_info);
        [DllImport(LibraryName, CallingConvention = CallingConvention.Cdecl)] public static extern int hf_weights_mirror(IntPtr surface, void* desc, void* inout_weights, void* out_partners, void* out_pairings, void* out_info, void* out_statistics);
    }
}
