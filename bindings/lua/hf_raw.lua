-- Generated from include/hf/*.h by bindings/generate; do not edit. The C ABI for LuaJIT's FFI.
local ffi = require('ffi')

ffi.cdef[[
typedef int32_t hf_result;
typedef struct hf_progress_object* hf_progress;
typedef struct hf_surface_object* hf_surface;
typedef struct hf_solver_object* hf_solver;
typedef struct hf_geodesics_object* hf_geodesics;
typedef struct hf_direction_object* hf_direction;
typedef struct hf_pose_object* hf_pose;
typedef struct hf_quads_object* hf_quads;
typedef struct hf_flow_object* hf_flow;
typedef struct hf_region_object* hf_region;
typedef struct hf_detail_object* hf_detail;
typedef struct hf_transfer_object* hf_transfer;
typedef struct hf_weights_object* hf_weights;
typedef struct hf_error_detail {
  hf_result code;
  uint32_t index;
  char function[48];
  char message[256];
} hf_error_detail;
typedef struct hf_allocator {
  void *allocate;
  void *release;
  void* user;
} hf_allocator;
typedef struct hf_job_runner {
  void *run;
  void* user;
} hf_job_runner;
typedef struct hf_factor_desc {
  uint32_t struct_size;
  int32_t borrow;
  const void* bytes;
  size_t byte_count;
} hf_factor_desc;
typedef struct hf_link {
  uint32_t vertex;
  uint32_t corners[3];
  double barycentrics[3];
  double length;
  float weight;
  int32_t in_tree;
} hf_link;
typedef struct hf_links_desc {
  uint32_t struct_size;
  int32_t mode;
  float distance;
  float stiffness;
  float overlay_distance;
  uint32_t influence_count;
  const uint16_t* joints;
  const float* weights;
  const uint32_t* tags;
  uint32_t link_count;
  uint32_t light_count;
  uint32_t heavy_count;
  uint32_t reserved;
  const hf_link* links;
  const uint32_t* light_vertices;
  const uint32_t* heavy_vertices;
} hf_links_desc;
typedef struct hf_surface_desc {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t triangle_count;
  uint32_t position_stride;
  const float* positions;
  const double* positions_f64;
  const uint32_t* triangles;
  const uint16_t* triangles_u16;
  uint32_t triangle_stride;
  int32_t weld;
  float weld_tolerance;
  int32_t operator_kind;
  int32_t field_kind;
  int32_t ordering;
  uint32_t thread_count;
  uint32_t vertex_limit;
  uint32_t triangle_limit;
  uint32_t memory_limit_mb;
  uint32_t work_limit_gflop;
  uint32_t reserved;
  hf_allocator allocator;
  hf_job_runner job_runner;
  hf_progress progress;
  const hf_factor_desc* saved_factor;
  const hf_links_desc* links;
  uint32_t face_count;
  uint32_t corner_count;
  const uint32_t* face_starts;
  const uint32_t* face_sizes;
  const uint32_t* corners;
  uint32_t face_stride;
  uint32_t corner_stride;
} hf_surface_desc;
typedef struct hf_graph_desc {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t edge_count;
  int32_t allow_negative;
  const uint32_t* edges;
  const double* weights;
  const double* masses;
  int32_t field_kind;
  int32_t ordering;
  uint32_t thread_count;
  uint32_t vertex_limit;
  uint32_t edge_limit;
  uint32_t memory_limit_mb;
  uint32_t work_limit_gflop;
  uint32_t reserved;
  hf_allocator allocator;
  hf_job_runner job_runner;
  hf_progress progress;
  const hf_factor_desc* saved_factor;
} hf_graph_desc;
typedef struct hf_surface_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t triangle_count;
  int32_t weld;
  float weld_tolerance;
  int32_t operator_kind;
  int32_t field_kind;
  int32_t ordering;
  uint32_t thread_count;
  uint32_t vertex_limit;
  uint32_t triangle_limit;
  uint32_t memory_limit_mb;
  uint32_t work_limit_gflop;
  uint32_t edge_count;
  uint32_t edge_limit;
  uint32_t face_count;
  uint32_t corner_count;
} hf_surface_info;
typedef struct hf_surface_report {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t triangle_count;
  uint32_t welded_vertex_count;
  uint32_t component_count;
  uint32_t isolated_vertex_count;
  uint32_t degenerate_triangle_count;
  uint32_t collapsed_triangle_count;
  uint32_t duplicate_triangle_count;
  uint32_t non_manifold_edge_count;
  uint32_t flipped_edge_count;
  uint32_t boundary_edge_count;
  uint32_t negative_edge_count;
  float smallest_angle;
  double bounding_box_diagonal;
  uint32_t changed_vertex_count;
  uint32_t first_changed_vertex;
  uint32_t piece_count;
  uint32_t link_count;
  uint32_t light_piece_count;
  uint32_t lone_piece_count;
  double longest_tree_link;
  uint32_t face_count;
  uint32_t polygon_count;
  uint32_t non_planar_count;
  uint32_t largest_face;
  uint32_t inside_out_count;
  uint32_t first_inside_out_vertex;
} hf_surface_report;
typedef struct hf_gaps_desc {
  uint32_t struct_size;
  uint32_t position_stride;
  const float* positions;
  const double* positions_f64;
} hf_gaps_desc;
typedef struct hf_gaps_info {
  uint32_t struct_size;
  uint32_t link_count;
  double percentile_95;
  double worst;
  uint32_t worst_link;
  uint32_t reserved;
} hf_gaps_info;
typedef struct hf_surface_statistics {
  uint32_t struct_size;
  uint32_t unknown_count;
  double weld_ms;
  double operator_ms;
  double ordering_ms;
  double symbolic_ms;
  double numeric_ms;
  double factor_entries;
  double factor_bytes;
  double factor_flops;
  double memory_bytes;
  double peak_memory_bytes;
  double load_ms;
  int32_t factor_loaded;
  int32_t factor_borrowed;
  double links_ms;
} hf_surface_statistics;
typedef struct hf_pick_desc {
  uint32_t struct_size;
  uint32_t position_stride;
  const float* positions;
  const double* positions_f64;
  int32_t front_only;
  uint32_t reserved;
} hf_pick_desc;
typedef struct hf_hit {
  uint32_t struct_size;
  int32_t found;
  uint32_t triangle;
  uint32_t vertex;
  double barycentrics[3];
  double position[3];
  double distance;
  uint32_t corners[3];
  uint32_t reserved;
} hf_hit;
typedef struct hf_solver_desc {
  uint32_t struct_size;
  int32_t field_kind;
  int32_t engine;
  uint32_t channel_count;
  uint32_t site_limit;
  uint32_t reserved;
  double penalty;
  hf_progress progress;
} hf_solver_desc;
typedef struct hf_solver_info {
  uint32_t struct_size;
  int32_t field_kind;
  int32_t engine;
  uint32_t channel_count;
  uint32_t site_limit;
  uint32_t site_count;
  double penalty;
  uint32_t vertex_count;
  uint32_t reserved;
} hf_solver_info;
typedef struct hf_sites_desc {
  uint32_t struct_size;
  uint32_t site_count;
  const uint32_t* vertices;
  const uint32_t* triangles;
  const double* barycentrics;
  const double* values;
  const double* stiffness;
  const double* radii;
  const uint32_t* corners;
} hf_sites_desc;
typedef struct hf_edit_desc {
  uint32_t struct_size;
  uint32_t remove_count;
  const uint32_t* remove_sites;
  uint32_t move_count;
  uint32_t set_count;
  const uint32_t* move_sites;
  const hf_sites_desc* move_to;
  const uint32_t* set_sites;
  const double* set_values;
  const hf_sites_desc* add;
} hf_edit_desc;
typedef struct hf_sites_info {
  uint32_t struct_size;
  uint32_t capacity;
  uint32_t count;
  uint32_t reserved;
  uint32_t* sites;
  uint32_t* vertices;
  uint32_t* components;
  double* values;
  double* stiffness;
  double* flux;
  double* radii;
} hf_sites_info;
typedef struct hf_solve_info {
  uint32_t struct_size;
  uint32_t unreached_component_count;
  uint32_t first_unreached_component;
  uint32_t unreached_vertex_count;
} hf_solve_info;
typedef struct hf_preview_info {
  uint32_t struct_size;
  int32_t exact;
  uint32_t correction_count;
  uint32_t unreached_component_count;
  double value_range;
  double largest_correction;
  double error_estimate;
  double preview_bytes;
} hf_preview_info;
typedef struct hf_certificate {
  uint32_t struct_size;
  int32_t overshoot_checked;
  double tolerance;
  double value_range;
  double residual;
  double site_error;
  double overshoot;
  uint32_t worst_vertex;
  uint32_t changed_vertex_count;
  double error_estimate;
} hf_certificate;
typedef struct hf_solver_statistics {
  uint32_t struct_size;
  uint32_t site_count;
  uint32_t factorisation_count;
  uint32_t path_solve_count;
  uint32_t sweep_count;
  uint32_t last_route;
  uint32_t rebase_count;
  uint32_t dense_edit_count;
  uint32_t dense_row_count;
  uint32_t eliminated_count;
  int32_t rebase_advised;
  uint32_t reserved;
  double site_memory_bytes;
  double predicted_dense_ms;
  double predicted_rebase_ms;
} hf_solver_statistics;
typedef struct hf_scalars {
  uint32_t struct_size;
  uint32_t value_stride;
  const float* values;
  const double* values_f64;
} hf_scalars;
typedef struct hf_isolines {
  uint32_t struct_size;
  uint32_t point_capacity;
  uint32_t line_capacity;
  uint32_t point_count;
  uint32_t line_count;
  uint32_t reserved;
  uint32_t* point_edges;
  double* parameters;
  double* positions;
  uint32_t* line_starts;
  uint32_t* line_levels;
  int32_t* line_closed;
} hf_isolines;
typedef struct hf_critical_point {
  uint32_t vertex;
  int32_t kind;
  int32_t index;
  uint32_t component;
  double value;
} hf_critical_point;
typedef struct hf_critical_info {
  uint32_t struct_size;
  uint32_t point_count;
  uint32_t minimum_count;
  uint32_t maximum_count;
  uint32_t saddle_count;
  int32_t index_sum;
  int32_t euler_characteristic;
  uint32_t reserved;
} hf_critical_info;
typedef struct hf_geodesics_desc {
  uint32_t struct_size;
  float smoothing;
  hf_progress progress;
  int32_t method;
  uint32_t reserved;
} hf_geodesics_desc;
typedef struct hf_surface_point {
  uint32_t corners[3];
  uint32_t reserved;
  double barycentrics[3];
} hf_surface_point;
typedef struct hf_path {
  uint32_t struct_size;
  uint32_t point_capacity;
  uint32_t point_count;
  uint32_t reserved;
  double length;
  uint32_t* point_edges;
  double* parameters;
  double* positions;
} hf_path;
typedef struct hf_extremities_desc {
  uint32_t struct_size;
  int32_t kind;
  float least_length;
  uint32_t source_count;
  hf_geodesics geodesics;
  hf_progress progress;
  double* out_field;
} hf_extremities_desc;
typedef struct hf_extremity {
  uint32_t vertex;
  uint32_t component;
  double length;
  double position[3];
} hf_extremity;
typedef struct hf_direction_desc {
  uint32_t struct_size;
  uint32_t degree;
  uint32_t site_limit;
  uint32_t reserved;
  hf_progress progress;
} hf_direction_desc;
typedef struct hf_singularity {
  uint32_t triangle;
  uint32_t vertex;
  int32_t index;
} hf_singularity;
typedef struct hf_direction_statistics {
  uint32_t struct_size;
  uint32_t degree;
  uint32_t site_limit;
  uint32_t unknown_count;
  uint32_t site_count;
  uint32_t factorisation_count;
  uint32_t path_solve_count;
  uint32_t sweep_count;
  uint32_t irregular_vertex_count;
  uint32_t eliminated_count;
  double operator_ms;
  double numeric_ms;
  double factor_entries;
  double factor_bytes;
  double site_memory_bytes;
} hf_direction_statistics;
typedef struct hf_pose_desc {
  uint32_t struct_size;
  int32_t mode;
  uint32_t band_count;
  uint32_t iteration_count;
  uint32_t samples_per_ring;
  uint32_t group_count;
} hf_pose_desc;
typedef struct hf_pose_info {
  uint32_t struct_size;
  int32_t mode;
  uint32_t band_count;
  uint32_t iteration_count;
  uint32_t samples_per_ring;
  uint32_t group_count;
  uint32_t handle_count;
  uint32_t vertex_count;
} hf_pose_info;
typedef struct hf_handles_desc {
  uint32_t struct_size;
  uint32_t handle_count;
  const uint32_t* region_counts;
  const uint32_t* region_vertices;
  const double* points;
  const double* radii;
  uint32_t layer;
  int32_t in_place;
  hf_progress progress;
} hf_handles_desc;
typedef struct hf_transform {
  double rotation[4];
  double translation[3];
} hf_transform;
typedef struct hf_handle_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t site_count;
  uint32_t component;
  double centroid[3];
  double leak;
  double rotation[4];
  double translation[3];
  uint32_t layer;
  uint32_t reserved;
} hf_handle_info;
typedef struct hf_deform_info {
  uint32_t struct_size;
  uint32_t iteration_count;
  uint32_t cluster_count;
  uint32_t unreached_vertex_count;
  double last_change;
  double solve_ms;
  double blend_ms;
  double normal_ms;
  double refine_ms;
} hf_deform_info;
typedef struct hf_deform_desc {
  uint32_t struct_size;
  uint32_t position_stride;
  float* positions;
  double* positions_f64;
  float* normals;
  uint32_t normal_stride;
  uint32_t iteration_count;
  int32_t restart;
  int32_t refine;
  int32_t refine_from_last;
  uint32_t first_vertex;
  uint32_t vertex_count;
  uint32_t reserved;
} hf_deform_desc;
typedef struct hf_skin_info {
  uint32_t struct_size;
  uint32_t joint_capacity;
  uint32_t vertex_capacity;
  uint32_t weight_count;
  uint32_t joint_count;
  uint32_t vertex_count;
  double* pivots;
  double* rotations;
  double* translations;
  double* axes;
  double* scales;
  uint32_t* vertex_joints;
  float* vertex_weights;
} hf_skin_info;
typedef struct hf_propose_desc {
  uint32_t struct_size;
  uint32_t joint_count;
  const double* joints;
  const uint32_t* parents;
  double up[3];
  float least_length;
  uint32_t limit;
  hf_progress progress;
} hf_propose_desc;
typedef struct hf_handle_proposal {
  uint32_t vertex;
  uint32_t component;
  int32_t reason;
  int32_t pinned;
  uint32_t joint;
  uint32_t reserved;
  double position[3];
  double radius;
  double length;
} hf_handle_proposal;
typedef struct hf_quads_desc {
  uint32_t struct_size;
  uint32_t face_count;
  float edge_length;
  float crease_angle;
  uint32_t relax_count;
  uint32_t crease_count;
  uint32_t guide_count;
  uint32_t pole_count;
  double symmetry_plane[4];
  const uint32_t* crease_edges;
  const uint32_t* guide_vertices;
  const double* guide_vectors;
  const float* guide_weights;
  const double* pole_points;
  const uint32_t* pole_quads;
  const double* pole_directions;
  hf_progress progress;
} hf_quads_desc;
typedef struct hf_quads_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t face_count;
  int32_t euler_characteristic;
  float edge_length;
} hf_quads_info;
typedef struct hf_quads_mesh {
  uint32_t struct_size;
  uint32_t vertex_capacity;
  uint32_t face_capacity;
  uint32_t vertex_count;
  uint32_t face_count;
  uint32_t reserved;
  double* positions;
  uint32_t* faces;
  uint32_t* triangles;
  double* barycentrics;
  uint32_t* corners;
} hf_quads_mesh;
typedef struct hf_flow_lines {
  uint32_t struct_size;
  uint32_t wanted_count;
  uint32_t seed_count;
  uint32_t point_capacity;
  uint32_t line_capacity;
  uint32_t point_count;
  uint32_t line_count;
  uint32_t reserved;
  const uint32_t* seeds;
  double* positions;
  double* values;
  uint32_t* line_starts;
  uint32_t* line_ends;
} hf_flow_lines;
typedef struct hf_region_desc {
  uint32_t struct_size;
  int32_t base;
  const float* positions;
  const double* positions_f64;
  uint32_t position_stride;
  uint32_t reserved;
  hf_progress progress;
} hf_region_desc;
typedef struct hf_curve_desc {
  uint32_t struct_size;
  uint32_t point_count;
  const uint32_t* vertices;
  const uint32_t* triangles;
  const double* barycentrics;
  int32_t side;
  uint32_t seed_vertex;
  const uint32_t* corners;
  int32_t kind;
  uint32_t reserved;
} hf_curve_desc;
typedef struct hf_region_edit_desc {
  uint32_t struct_size;
  int32_t ring_count;
  const hf_curve_desc* curve;
  uint32_t remove_count;
  uint32_t add_count;
  const uint32_t* remove_vertices;
  const uint32_t* add_vertices;
  hf_progress progress;
} hf_region_edit_desc;
typedef struct hf_region_info {
  uint32_t struct_size;
  int32_t field_kind;
  uint32_t vertex_count;
  uint32_t rim_count;
  uint32_t site_count;
  uint32_t inserted_count;
  uint32_t removed_count;
  uint32_t kept_count;
  uint32_t factorisation_count;
  uint32_t path_solve_count;
  uint32_t last_route;
  int32_t whole_sweep;
  double area;
  double base_area;
} hf_region_info;
typedef struct hf_morph_desc {
  uint32_t struct_size;
  uint32_t position_stride;
  double weight;
  float* positions;
  double* positions_f64;
  float* normals;
  uint32_t normal_stride;
  uint32_t reserved;
} hf_morph_desc;
typedef struct hf_detail_desc {
  uint32_t struct_size;
  uint32_t pair_count;
  const uint32_t* source_vertices;
  const uint32_t* target_vertices;
  double scale;
  hf_progress progress;
} hf_detail_desc;
typedef struct hf_transfer_desc {
  uint32_t struct_size;
  int32_t mode;
  uint32_t cluster_count;
  float kernel_width;
  float scale;
  float alignment_angle;
  float source_axes[9];
  float target_axes[9];
  int32_t ground;
  uint32_t reserved;
  const float* source_rest;
  const float* target_rest;
} hf_transfer_desc;
typedef struct hf_pairs_desc {
  uint32_t struct_size;
  uint32_t pair_count;
  const uint32_t* source_counts;
  const uint32_t* source_vertices;
  const uint32_t* target_counts;
  const uint32_t* target_vertices;
  const uint32_t* flags;
  hf_progress progress;
} hf_pairs_desc;
typedef struct hf_pair_info {
  uint32_t struct_size;
  uint32_t flags;
  double source_leak;
  double target_leak;
  double alignment_angle;
  double confidence;
  double alignment_share;
  int32_t aligned;
  int32_t crossed;
} hf_pair_info;
typedef struct hf_transfer_info {
  uint32_t struct_size;
  uint32_t pair_count;
  uint32_t cluster_count;
  uint32_t aligned_count;
  uint32_t crossed_count;
  int32_t scale_found;
  uint32_t source_factorisation_count;
  uint32_t target_factorisation_count;
  double scale;
} hf_transfer_info;
typedef struct hf_transfer_dials {
  uint32_t struct_size;
  float stride;
  float hip_height;
  float neck_follow;
  float tail_follow;
  float arm_space;
  float long_follow;
} hf_transfer_dials;
typedef struct hf_transfer_frame {
  uint32_t struct_size;
  uint32_t source_stride;
  const float* source_positions;
  const double* source_positions_f64;
  uint32_t target_stride;
  uint32_t normal_stride;
  float* target_positions;
  double* target_positions_f64;
  float* target_normals;
  uint32_t hold_count;
  uint32_t reserved;
  const uint32_t* hold_pairs;
  const double* hold_positions;
} hf_transfer_frame;
typedef struct hf_bones_desc {
  uint32_t struct_size;
  uint32_t bone_count;
  const double* heads;
  const double* tails;
  const double* axes;
  const uint32_t* parents;
  const int32_t* deforms;
  const uint32_t* sources;
  hf_progress progress;
} hf_bones_desc;
typedef struct hf_pins_desc {
  uint32_t struct_size;
  uint32_t pin_count;
  const uint32_t* vertices;
  const uint32_t* triangles;
  const double* barycentrics;
  const double* radii;
  uint32_t joint_count;
  uint32_t reserved;
  const uint32_t* joints;
  const float* weights;
  hf_progress progress;
} hf_pins_desc;
typedef struct hf_weights_out {
  uint32_t struct_size;
  uint32_t vertex_capacity;
  uint32_t vertex_count;
  uint32_t weight_count;
  uint32_t* joints;
  uint16_t* joints_u16;
  float* weights;
  uint8_t* origins;
} hf_weights_out;
typedef struct hf_weights_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t bone_count;
  uint32_t pin_count;
  uint32_t lock_count;
  uint32_t informed_count;
  uint32_t solved_count;
  uint32_t pinned_count;
  uint32_t carried_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
  uint32_t carried_island_count;
  uint32_t rigid_island_count;
  int32_t blind;
  uint32_t no_length_count;
  uint32_t coincident_count;
  uint32_t informs_none_count;
  uint32_t outside_count;
  uint32_t helper_count;
  uint32_t factorisation_count;
  uint32_t path_solve_count;
  uint32_t reserved;
} hf_weights_info;
typedef struct hf_carry_desc {
  uint32_t struct_size;
  uint32_t influence_count;
  const uint32_t* joints;
  const float* weights;
  double distance;
  double angle;
  uint32_t weight_count;
  uint32_t reserved;
  hf_progress progress;
} hf_carry_desc;
typedef struct hf_carry_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t matched_count;
  uint32_t solved_count;
  uint32_t carried_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
  uint32_t guessed_island_count;
} hf_carry_info;
typedef struct hf_mirror_desc {
  uint32_t struct_size;
  uint32_t bone_count;
  const double* heads;
  const char* names;
  const uint32_t* partners;
  const double* plane;
  uint32_t influence_count;
  int32_t to;
  const uint32_t* joints;
  const float* weights;
  double distance;
  double angle;
  uint32_t weight_count;
  uint32_t reserved;
  hf_progress progress;
} hf_mirror_desc;
typedef struct hf_mirror_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  int32_t plane_from;
  uint32_t named_count;
  uint32_t placed_count;
  uint32_t centre_count;
  uint32_t given_count;
  uint32_t alone_count;
  uint32_t kept_count;
  uint32_t matched_count;
  uint32_t solved_count;
  uint32_t carried_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
  uint32_t worst_bone;
  uint32_t worst_vertex;
  double point[3];
  double normal[3];
  double bone_off;
  double worst_bone_off;
  double vertex_off;
  double worst_vertex_off;
} hf_mirror_info;
hf_result hf_error_get_detail(hf_error_detail* out_detail);
const char* hf_result_get_name(hf_result result);
uint32_t hf_version_get(void);
hf_result hf_progress_create(hf_progress* out_progress);
void hf_progress_destroy(hf_progress progress);
hf_result hf_progress_get_fraction(hf_progress progress, float* out_fraction);
hf_result hf_progress_cancel(hf_progress progress);
hf_result hf_surface_create(const hf_surface_desc* desc, hf_surface* out_surface);
hf_result hf_surface_create_graph(const hf_graph_desc* desc, hf_surface* out_surface);
void hf_surface_destroy(hf_surface surface);
hf_result hf_surface_get_info(hf_surface surface, hf_surface_info* out_info);
hf_result hf_surface_get_report(hf_surface surface, hf_surface_report* out_report);
hf_result hf_surface_get_components(hf_surface surface, uint32_t capacity, uint32_t* out_components, uint32_t* out_count);
hf_result hf_surface_get_links(hf_surface surface, uint32_t capacity, hf_link* out_links, uint32_t* out_count);
hf_result hf_surface_get_pieces(hf_surface surface, uint32_t capacity, uint32_t* out_pieces, int32_t* out_light, uint32_t* out_count);
hf_result hf_surface_measure_gaps(hf_surface surface, const hf_gaps_desc* desc, uint32_t capacity, double* out_gaps, hf_gaps_info* out_info);
hf_result hf_surface_relink(hf_surface surface, const hf_links_desc* links, hf_progress progress, hf_surface* out_surface);
hf_result hf_surface_get_statistics(hf_surface surface, hf_surface_statistics* out_statistics);
hf_result hf_surface_save(hf_surface surface, int32_t field_kind, hf_progress progress, size_t capacity, void* out_bytes, size_t* out_size);
hf_result hf_surface_cast_ray(hf_surface surface, const double* origin, const double* direction, const hf_pick_desc* desc, hf_hit* out_hit);
hf_result hf_surface_find_vertex(hf_surface surface, const double* point, const hf_pick_desc* desc, uint32_t* out_vertex, double* out_distance);
hf_result hf_create(hf_surface surface, const hf_solver_desc* desc, hf_solver* out_solver);
hf_result hf_solver_clone(hf_solver solver, hf_solver* out_solver);
void hf_solver_destroy(hf_solver solver);
hf_result hf_solver_get_info(hf_solver solver, hf_solver_info* out_info);
hf_result hf_add_sites(hf_solver solver, const hf_sites_desc* sites, uint32_t* out_sites);
hf_result hf_solver_add_site(hf_solver solver, uint32_t vertex, const double* values, uint32_t* out_site);
hf_result hf_remove_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites);
hf_result hf_solver_move_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites, const hf_sites_desc* to);
hf_result hf_solver_set_values(hf_solver solver, uint32_t site_count, const uint32_t* sites, const double* values);
hf_result hf_solver_edit_sites(hf_solver solver, const hf_edit_desc* edit, uint32_t* out_sites);
uint32_t hf_solver_get_site_count(hf_solver solver);
hf_result hf_solver_get_sites(hf_solver solver, hf_sites_info* inout_info);
hf_result hf_solver_set_screening(hf_solver solver, const double* screening, const double* targets);
hf_result hf_solve(hf_solver solver, float* out_values, uint32_t value_stride, hf_solve_info* out_info);
hf_result hf_solver_solve_f64(hf_solver solver, double* out_values, uint32_t value_stride, hf_solve_info* out_info);
hf_result hf_solver_solve_at(hf_solver solver, uint32_t vertex_count, const uint32_t* vertices, double* out_values);
hf_result hf_solver_solve_vectors(hf_solver solver, float* out_vectors, uint32_t vector_stride, double* out_normals, hf_solve_info* out_info);
hf_result hf_solver_solve_vectors_f64(hf_solver solver, double* out_vectors, uint32_t vector_stride, double* out_normals, hf_solve_info* out_info);
hf_result hf_solver_solve_preview(hf_solver solver, float* out_values, uint32_t value_stride, uint32_t correction_count, hf_preview_info* out_info);
hf_result hf_solver_solve_preview_f64(hf_solver solver, double* out_values, uint32_t value_stride, uint32_t correction_count, hf_preview_info* out_info);
hf_result hf_solver_release_preview(hf_solver solver);
hf_result hf_solver_move_vectors(hf_solver solver, uint32_t site_count, const uint32_t* sites, const uint32_t* vertices);
hf_result hf_solver_rotate_vectors(hf_solver solver, uint32_t site_count, const uint32_t* sites, const double* angles);
hf_result hf_solver_certify(hf_solver solver, hf_certificate* inout_certificate);
hf_result hf_solver_record(hf_solver solver);
hf_result hf_solver_undo(hf_solver solver);
hf_result hf_solver_redo(hf_solver solver);
hf_result hf_solver_prepare_rebase(hf_solver solver);
hf_result hf_solver_get_statistics(hf_solver solver, hf_solver_statistics* out_statistics);
hf_result hf_surface_space_levels(hf_surface surface, const hf_scalars* field, int32_t spacing, uint32_t level_count, double* out_levels);
hf_result hf_surface_trace_isolines(hf_surface surface, const hf_scalars* field, uint32_t level_count, const double* levels, hf_isolines* inout_lines);
hf_result hf_surface_find_critical_points(hf_surface surface, const hf_scalars* field, uint32_t capacity, hf_critical_point* out_points, hf_critical_info* out_info);
hf_result hf_geodesics_create(hf_surface surface, const hf_geodesics_desc* desc, hf_geodesics* out_geodesics);
void hf_geodesics_destroy(hf_geodesics geodesics);
hf_result hf_geodesics_solve(hf_geodesics geodesics, uint32_t source_count, const uint32_t* sources, float* out_distances, uint32_t value_stride);
hf_result hf_geodesics_solve_f64(hf_geodesics geodesics, uint32_t source_count, const uint32_t* sources, double* out_distances, uint32_t value_stride);
hf_result hf_geodesics_find_path(hf_geodesics geodesics, const hf_surface_point* from, const hf_surface_point* to, hf_path* inout_path);
hf_result hf_geodesics_get_map(hf_geodesics geodesics, const hf_surface_point* centre, double radius, double* out_map, double* out_frame);
hf_result hf_surface_find_extremities(hf_surface surface, const hf_extremities_desc* desc, uint32_t capacity, hf_extremity* out_extremities, uint32_t* out_count);
hf_result hf_direction_create(hf_surface surface, const hf_direction_desc* desc, hf_direction* out_direction);
hf_result hf_direction_clone(hf_direction direction, hf_direction* out_direction);
void hf_direction_destroy(hf_direction direction);
hf_result hf_direction_add_sites(hf_direction direction, uint32_t site_count, const uint32_t* vertices, const double* vectors, uint32_t* out_sites);
hf_result hf_direction_remove_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites);
hf_result hf_direction_move_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites, const uint32_t* vertices);
hf_result hf_direction_set_vectors(hf_direction direction, uint32_t site_count, const uint32_t* sites, const double* vectors);
hf_result hf_direction_rotate_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites, const double* angles);
hf_result hf_direction_record(hf_direction direction);
hf_result hf_direction_undo(hf_direction direction);
hf_result hf_direction_redo(hf_direction direction);
uint32_t hf_direction_get_site_count(hf_direction direction);
hf_result hf_direction_get_sites(hf_direction direction, uint32_t capacity, uint32_t* out_sites, uint32_t* out_vertices, double* out_vectors, uint32_t* out_count);
hf_result hf_direction_solve(hf_direction direction, float* out_vectors, uint32_t vector_stride, hf_solve_info* out_info);
hf_result hf_direction_solve_f64(hf_direction direction, double* out_vectors, uint32_t vector_stride, hf_solve_info* out_info);
hf_result hf_direction_get_singularities(hf_direction direction, uint32_t capacity, hf_singularity* out_singularities, uint32_t* out_count);
hf_result hf_direction_get_statistics(hf_direction direction, hf_direction_statistics* out_statistics);
hf_result hf_pose_create(hf_surface surface, const hf_pose_desc* desc, hf_pose* out_pose);
hf_result hf_pose_clone(hf_pose pose, hf_pose* out_pose);
void hf_pose_destroy(hf_pose pose);
hf_result hf_pose_get_info(hf_pose pose, hf_pose_info* out_info);
hf_result hf_pose_add_handles(hf_pose pose, const hf_handles_desc* handles, uint32_t* out_handles);
hf_result hf_pose_add_handle_at(hf_pose pose, const double* point, double radius, uint32_t* out_handle);
hf_result hf_pose_remove_handles(hf_pose pose, uint32_t handle_count, const uint32_t* handles);
hf_result hf_pose_set_transforms(hf_pose pose, uint32_t handle_count, const uint32_t* handles, const hf_transform* transforms);
hf_result hf_pose_set_transform(hf_pose pose, uint32_t handle, const hf_transform* transform);
hf_result hf_pose_set_matrices(hf_pose pose, uint32_t handle_count, const uint32_t* handles, const double* matrices);
hf_result hf_pose_get_handle(hf_pose pose, uint32_t handle, hf_handle_info* out_info);
uint32_t hf_pose_get_handle_count(hf_pose pose);
hf_result hf_pose_get_field(hf_pose pose, uint32_t handle, float* out_values, uint32_t value_stride);
hf_result hf_deform(hf_pose pose, float* out_positions, hf_deform_info* out_info);
hf_result hf_pose_deform(hf_pose pose, const hf_deform_desc* desc, hf_deform_info* out_info);
hf_result hf_pose_get_skin(hf_pose pose, hf_skin_info* inout_skin);
hf_result hf_propose_handles(hf_surface surface, const hf_propose_desc* desc, uint32_t capacity, hf_handle_proposal* out_proposals, uint32_t* out_count);
hf_result hf_quads_create(hf_surface surface, const hf_quads_desc* desc, hf_quads* out_quads);
hf_result hf_quads_update(hf_quads quads, const hf_quads_desc* desc);
void hf_quads_destroy(hf_quads quads);
hf_result hf_quads_get_info(hf_quads quads, hf_quads_info* out_info);
hf_result hf_quads_get_mesh(hf_quads quads, hf_quads_mesh* inout_mesh);
hf_result hf_flow_create(hf_surface surface, hf_flow* out_flow);
void hf_flow_destroy(hf_flow flow);
hf_result hf_flow_trace(hf_flow flow, const hf_scalars* field, hf_flow_lines* inout_lines);
hf_result hf_region_create(hf_surface surface, const hf_region_desc* desc, hf_region* out_region);
hf_result hf_region_clone(hf_region region, hf_region* out_region);
void hf_region_destroy(hf_region region);
hf_result hf_region_edit(hf_region region, const hf_region_edit_desc* edit);
hf_result hf_region_record(hf_region region);
hf_result hf_region_undo(hf_region region);
hf_result hf_region_redo(hf_region region);
hf_result hf_region_get_info(hf_region region, hf_region_info* out_info);
hf_result hf_region_get_vertices(hf_region region, int32_t list, uint32_t capacity, uint32_t* out_vertices, uint32_t* out_count);
hf_result hf_region_get_curve(hf_region region, uint32_t capacity, double* out_points, uint32_t* out_count);
hf_result hf_region_morph(hf_region region, const hf_morph_desc* desc);
hf_result hf_detail_create(hf_region source, hf_region target, const hf_detail_desc* desc, hf_detail* out_detail);
void hf_detail_destroy(hf_detail detail);
hf_result hf_detail_morph(hf_detail detail, const hf_morph_desc* desc);
hf_result hf_transfer_create(hf_surface source, hf_surface target, const hf_transfer_desc* desc, hf_transfer* out_transfer);
void hf_transfer_destroy(hf_transfer transfer);
hf_result hf_transfer_add_pairs(hf_transfer transfer, const hf_pairs_desc* pairs, uint32_t* out_pairs);
hf_result hf_transfer_remove_pairs(hf_transfer transfer, uint32_t pair_count, const uint32_t* pairs);
hf_result hf_transfer_get_pair(hf_transfer transfer, uint32_t pair, hf_pair_info* out_info);
hf_result hf_transfer_get_info(hf_transfer transfer, hf_transfer_info* out_info);
hf_result hf_transfer_set_dials(hf_transfer transfer, const hf_transfer_dials* dials);
hf_result hf_transfer_get_dials(hf_transfer transfer, hf_transfer_dials* out_dials);
hf_result hf_transfer_apply(hf_transfer transfer, const hf_transfer_frame* frame);
hf_result hf_transfer_get_sinking(hf_transfer transfer, uint8_t* out_sinking);
hf_result hf_transfer_get_skin(hf_transfer transfer, hf_skin_info* inout_skin);
hf_result hf_weights_create(hf_surface surface, const hf_bones_desc* bones, uint32_t weight_count, hf_weights* out_weights);
hf_result hf_weights_clone(hf_weights weights, hf_weights* out_weights);
void hf_weights_destroy(hf_weights weights);
hf_result hf_weights_set_bones(hf_weights weights, const hf_bones_desc* bones);
hf_result hf_weights_set_pins(hf_weights weights, const hf_pins_desc* pins);
hf_result hf_weights_set_locks(hf_weights weights, uint32_t lock_count, const uint32_t* bones, const float* values);
hf_result hf_weights_get(hf_weights weights, hf_weights_out* inout_weights);
hf_result hf_weights_get_bones(hf_weights weights, uint32_t capacity, uint32_t* out_flags, uint32_t* out_vertex_counts, uint32_t* out_count);
hf_result hf_weights_get_info(hf_weights weights, hf_weights_info* out_info);
hf_result hf_weights_record(hf_weights weights);
hf_result hf_weights_undo(hf_weights weights);
hf_result hf_weights_redo(hf_weights weights);
hf_result hf_weights_get_helpers(hf_weights weights, const char* names, uint32_t capacity, uint32_t* out_reasons, uint32_t* out_count);
hf_result hf_weights_carry(hf_surface source, hf_surface target, const hf_carry_desc* desc, hf_weights_out* inout_weights, hf_carry_info* out_info);
hf_result hf_weights_mirror(hf_surface surface, const hf_mirror_desc* desc, hf_weights_out* inout_weights, uint32_t* out_bones, uint32_t* out_pairings, hf_mirror_info* out_info);
]]

local constants = { header_version = '0.1.0',
  HF_VERSION_MAJOR = 0,
  HF_VERSION_MINOR = 1,
  HF_VERSION_PATCH = 0,
  HF_NO_INDEX = 4294967295,
  HF_MESSAGE_SIZE = 256,
  HF_OK = 0,
  HF_ERROR_INVALID_ARGUMENT = -1,
  HF_ERROR_NULL_POINTER = -2,
  HF_ERROR_INVALID_HANDLE = -3,
  HF_ERROR_INVALID_DESC = -4,
  HF_ERROR_OUT_OF_RANGE = -5,
  HF_ERROR_NON_FINITE = -6,
  HF_ERROR_EMPTY = -7,
  HF_ERROR_DUPLICATE_SITE = -8,
  HF_ERROR_NO_SUCH_SITE = -9,
  HF_ERROR_CONFLICT = -10,
  HF_ERROR_NO_SITES = -11,
  HF_ERROR_NO_SUCH_HANDLE = -12,
  HF_ERROR_NO_SUCH_PAIR = -13,
  HF_ERROR_OVERLAP = -14,
  HF_ERROR_UNSUPPORTED = -15,
  HF_ERROR_BUSY = -16,
  HF_ERROR_REENTRANT = -17,
  HF_ERROR_TOO_SMALL = -18,
  HF_ERROR_NO_RECORD = -19,
  HF_ERROR_OUT_OF_MEMORY = -100,
  HF_ERROR_TOO_LARGE = -101,
  HF_ERROR_CANCELLED = -102,
  HF_ERROR_NOT_POSITIVE_DEFINITE = -200,
  HF_ERROR_INACCURATE = -201,
  HF_ERROR_INTERNAL = -300,
  HF_WELD_EXACT = 0,
  HF_WELD_NONE = 1,
  HF_WELD_TOLERANCE = 2,
  HF_OPERATOR_INTRINSIC_DELAUNAY = 0,
  HF_OPERATOR_CLAMPED = 1,
  HF_OPERATOR_UNIFORM = 2,
  HF_OPERATOR_COTANGENT = 3,
  HF_OPERATOR_GRAPH = 4,
  HF_FIELD_HARMONIC = 0,
  HF_FIELD_BIHARMONIC = 1,
  HF_FIELD_BIHARMONIC_GRAPH = 2,
  HF_ORDERING_NESTED_DISSECTION = 0,
  HF_ORDERING_MINIMUM_DEGREE = 1,
  HF_ORDERING_METIS = 2,
  HF_FACTOR_ALIGNMENT = 64,
  HF_LINK_NONE = 0,
  HF_LINK_PIECES = 1,
  HF_LINK_LIST = 2,
  HF_ENGINE_GREEN = 0,
  HF_ENGINE_UPDOWN = 1,
  HF_ENGINE_REFACTOR = 2,
  HF_ROUTE_NONE = 0,
  HF_ROUTE_DENSE = 1,
  HF_ROUTE_FRESH = 2,
  HF_ROUTE_REBASE = 3,
  HF_LEVELS_VALUE = 0,
  HF_LEVELS_AREA = 1,
  HF_LEVELS_LENGTH = 2,
  HF_CRITICAL_MINIMUM = 0,
  HF_CRITICAL_MAXIMUM = 1,
  HF_CRITICAL_SADDLE = 2,
  HF_GEODESICS_AUTO = 0,
  HF_GEODESICS_FRONT = 1,
  HF_GEODESICS_EXACT = 2,
  HF_GEODESICS_HEAT = 3,
  HF_EXTREMITIES_POISSON = 0,
  HF_EXTREMITIES_GEODESIC = 1,
  HF_DEFORM_SMOOTH = 0,
  HF_DEFORM_PAPER = 1,
  HF_LAYER_COUNT = 8,
  HF_HANDLE_LIMIT = 256,
  HF_HANDLE_REASON_FOOT = 0,
  HF_HANDLE_REASON_TIP = 1,
  HF_HANDLE_REASON_END = 2,
  HF_HANDLE_REASON_JOINT = 3,
  HF_HANDLE_REASON_MIDDLE = 4,
  HF_BASE_DEFAULT = 0,
  HF_BASE_MEMBRANE = 1,
  HF_BASE_THIN_PLATE = 2,
  HF_BASE_THIN_PLATE_GRAPH = 3,
  HF_SIDE_SMALLER = 0,
  HF_SIDE_LARGER = 1,
  HF_SIDE_SEED = 2,
  HF_CURVE_STRAIGHT = 0,
  HF_CURVE_EDGES = 1,
  HF_REGION_INSIDE = 0,
  HF_REGION_RIM = 1,
  HF_REGION_SITES = 2,
  HF_TRANSFER_FIELDS = 0,
  HF_TRANSFER_PAPER = 1,
  HF_TRANSFER_STRETCH = 2,
  HF_GROUND_KEEP = 0,
  HF_GROUND_OFF = 1,
  HF_PAIR_ANCHOR = 1,
  HF_PAIR_FOOT = 2,
  HF_PAIR_TRUNK = 4,
  HF_PAIR_NO_ALIGNMENT = 8,
  HF_PAIR_CONTACT = 16,
  HF_PAIR_SINKS = 32,
  HF_PAIR_NECK = 64,
  HF_PAIR_TAIL = 128,
  HF_PAIR_ARM = 256,
  HF_PAIR_LIMIT = 256,
  HF_WEIGHTS_INFORMED = 0,
  HF_WEIGHTS_SOLVED = 1,
  HF_WEIGHTS_PINNED = 2,
  HF_WEIGHTS_CARRIED = 3,
  HF_WEIGHTS_RIGID = 4,
  HF_WEIGHTS_ISOLATED = 5,
  HF_WEIGHTS_MATCHED = 6,
  HF_WEIGHTS_KEPT = 7,
  HF_BONE_NO_LENGTH = 1,
  HF_BONE_COINCIDENT = 2,
  HF_BONE_INFORMS_NONE = 4,
  HF_BONE_OUTSIDE = 8,
  HF_BONE_HELPER = 16,
  HF_HELPER_PROPOSED = 1,
  HF_HELPER_NAME_ROOT = 2,
  HF_HELPER_NAME_CONTROL = 4,
  HF_HELPER_NAME_END = 8,
  HF_HELPER_ROOT = 16,
  HF_HELPER_APART = 32,
  HF_HELPER_NO_LENGTH = 64,
  HF_HELPER_COINCIDENT = 128,
  HF_HELPER_OUTSIDE = 256,
  HF_HELPER_INFORMS_NONE = 512,
  HF_MIRROR_TO_NEGATIVE = 0,
  HF_MIRROR_TO_POSITIVE = 1,
  HF_MIRROR_BOTH = 2,
  HF_MIRROR_PLANE_GIVEN = 0,
  HF_MIRROR_PLANE_BONES = 1,
  HF_MIRROR_PLANE_SURFACE = 2,
  HF_MIRROR_BONE_ALONE = 0,
  HF_MIRROR_BONE_NAMED = 1,
  HF_MIRROR_BONE_PLACED = 2,
  HF_MIRROR_BONE_CENTRE = 3,
  HF_MIRROR_BONE_GIVEN = 4,
}

return constants
