/* Every function that takes a handle, called with every kind of handle that is not one of its own:
 * HF_ERROR_INVALID_OBJECT, and every live object as before. */
#include "bad_scene.h"

static Scene scene;

static float floats[3 * TUBE_VERTICES];
static double doubles[3 * TUBE_VERTICES];
static uint32_t numbers[TUBE_VERTICES];

/* One call per function, everything but the handle in order. */
static hf_result clone(void* h) {
  hf_solver out;
  return hf_solver_clone(h, &out);
}
static hf_result get_mesh_report(void* h) {
  hf_surface_report r = HF_INIT(hf_surface_report);
  return hf_surface_get_report(h, &r);
}
static hf_result get_components(void* h) { return hf_surface_get_components(h, CUT_VERTICES, numbers, NULL); }
static hf_result get_statistics(void* h) {
  hf_solver_statistics s = HF_INIT(hf_solver_statistics);
  return hf_solver_get_statistics(h, &s);
}
static hf_result create(void* h) {
  hf_solver out;
  return hf_create(h, NULL, &out);
}
static hf_result surface_get_info(void* h) {
  hf_surface_info i = HF_INIT(hf_surface_info);
  return hf_surface_get_info(h, &i);
}
static hf_result surface_get_statistics(void* h) {
  hf_surface_statistics s = HF_INIT(hf_surface_statistics);
  return hf_surface_get_statistics(h, &s);
}
static hf_result surface_save(void* h) {
  size_t size;
  return hf_surface_save(h, HF_FIELD_HARMONIC, NULL, sizeof doubles, doubles, &size);
}
static hf_result cast_ray(void* h) {
  const double origin[3] = {0, 0, 9}, direction[3] = {0, 0, -1};
  hf_hit hit = HF_INIT(hf_hit);
  return hf_surface_cast_ray(h, origin, direction, NULL, &hit);
}
static hf_result find_vertex(void* h) {
  const double point[3] = {1, 1, 1};
  uint32_t vertex;
  return hf_surface_find_vertex(h, point, NULL, &vertex, NULL);
}
static hf_result solver_get_info(void* h) {
  hf_solver_info i = HF_INIT(hf_solver_info);
  return hf_solver_get_info(h, &i);
}
static hf_result solver_add_site(void* h) { return hf_solver_add_site(h, 7, NULL, NULL); }
static hf_result solver_certify(void* h) {
  hf_certificate c = HF_INIT(hf_certificate);
  return hf_solver_certify(h, &c);
}
static hf_result pose_get_info(void* h) {
  hf_pose_info i = HF_INIT(hf_pose_info);
  return hf_pose_get_info(h, &i);
}
static hf_result pose_add_handle_at(void* h) {
  const double point[3] = {1, 6, 0};
  return hf_pose_add_handle_at(h, point, 0.1, NULL);
}
static hf_result pose_set_transform(void* h) {
  const hf_transform rest = {{0, 0, 0, 1}, {0, 0, 0}};
  return hf_pose_set_transform(h, scene.handles[0], &rest);
}
static hf_result plain_deform(void* h) { return hf_deform(h, floats, NULL); }
static hf_result region_create(void* h) {
  hf_region out;
  return hf_region_create(h, NULL, &out);
}
static hf_result solve_preview(void* h) { return hf_solver_solve_preview(h, OUT(floats), 0, NULL); }
static hf_result release_preview(void* h) { return hf_solver_release_preview(h); }
static hf_result add_sites(void* h) {
  const uint32_t vertex = 7;
  const hf_sites_desc d = sites_at(1, &vertex, NULL);
  return hf_add_sites(h, &d, NULL);
}
static hf_result remove_sites(void* h) { return hf_remove_sites(h, 1, scene.sites); }
static hf_result move_sites(void* h) {
  const uint32_t vertex = 7;
  const hf_sites_desc d = sites_at(1, &vertex, NULL);
  return hf_solver_move_sites(h, 1, scene.sites, &d);
}
static hf_result set_site_values(void* h) {
  const double v = 3;
  return hf_solver_set_values(h, 1, scene.sites, &v);
}
static hf_result set_screening(void* h) { return hf_solver_set_screening(h, NULL, NULL); }
static hf_result edit_sites(void* h) {
  hf_edit_desc d = HF_INIT(hf_edit_desc);
  d.remove_count = 1;
  d.remove_sites = scene.sites;
  return hf_solver_edit_sites(h, &d, NULL);
}
static hf_result get_sites(void* h) {
  hf_sites_info i = HF_INIT(hf_sites_info);
  i.capacity = 3;
  return hf_solver_get_sites(h, &i);
}
static hf_result solve(void* h) { return hf_solve(h, floats, 0, NULL); }
static hf_result solve_f64(void* h) { return hf_solver_solve(h, OUT(doubles), NULL); }
static hf_result solve_vectors(void* h) { return hf_solver_solve_vectors(h, OUT(floats), NULL, NULL); }
static hf_result solve_at(void* h) {
  const uint32_t v = 3;
  return hf_solver_solve_at(h, 1, &v, doubles);
}
static hf_result prepare_rebase(void* h) { return hf_solver_prepare_rebase(h); }
static hf_result pose_create(void* h) {
  hf_pose out;
  return hf_pose_create(h, NULL, &out);
}
static hf_result transfer_from(void* h) {
  hf_transfer out;
  return hf_transfer_create(h, scene.body, NULL, &out);
}
static hf_result transfer_to(void* h) {
  hf_transfer out;
  return hf_transfer_create(scene.body, h, NULL, &out);
}

static hf_result space_levels(void* h) {
  const hf_array f = HF_ARRAY(doubles, CUT_VERTICES);
  double level;
  return hf_surface_space_levels(h, &f, HF_LEVELS_VALUE, 1, &level);
}
static hf_result trace_isolines(void* h) {
  const hf_array f = HF_ARRAY(doubles, CUT_VERTICES);
  const double level = 0.5;
  hf_isolines lines = HF_INIT(hf_isolines);
  return hf_surface_trace_isolines(h, &f, 1, &level, &lines);
}
static hf_result find_critical_points(void* h) {
  const hf_array f = HF_ARRAY(doubles, CUT_VERTICES);
  hf_critical_info info = HF_INIT(hf_critical_info);
  return hf_surface_find_critical_points(h, &f, 0, NULL, &info);
}
static hf_result geodesics_create(void* h) {
  hf_geodesics out;
  return hf_geodesics_create(h, NULL, &out);
}
static hf_result propose(void* h) {
  uint32_t count;
  return hf_surface_propose_handles(h, NULL, 0, NULL, &count);
}
static hf_result find_extremities(void* h) {
  uint32_t count;
  return hf_surface_find_extremities(h, NULL, 0, NULL, &count);
}
static hf_result geodesics_distance(void* h) {
  const uint32_t v = 3;
  return hf_geodesics_solve(h, 1, &v, OUT(floats));
}
static const hf_place first_vertex = {{0, HF_NO_INDEX, HF_NO_INDEX}, 0, {1, 0, 0}};
static hf_result geodesics_path(void* h) {
  hf_path path = HF_INIT(hf_path);
  return hf_geodesics_find_path(h, &first_vertex, &first_vertex, &path);
}
static hf_result geodesics_map(void* h) { return hf_geodesics_get_map(h, &first_vertex, 0, doubles, NULL); }
static hf_result find_extremities_with(void* h) {
  hf_extremities_desc d;
  uint32_t count;
  d = HF_INIT(hf_extremities_desc);
  d.kind = HF_EXTREMITIES_GEODESIC;
  d.geodesics = h;
  return h ? hf_surface_find_extremities(scene.body, &d, 0, NULL, &count)
           : hf_surface_find_extremities(NULL, &d, 0, NULL, &count); /* NULL there asks for one of its own */
}

static hf_result move_vector_sites(void* h) {
  const uint32_t vertex = 7;
  return hf_solver_move_vectors(h, 1, scene.sites, &vertex);
}
static hf_result rotate_vector_sites(void* h) {
  const double angle = 1;
  return hf_solver_rotate_vectors(h, 1, scene.sites, &angle);
}
static hf_result direction_create(void* h) {
  hf_direction out;
  return hf_direction_create(h, NULL, &out);
}
static hf_result direction_add_sites(void* h) {
  const uint32_t vertex = 7;
  const double vector[3] = {1, 0, 0};
  return hf_direction_add_sites(h, 1, &vertex, vector, NULL);
}
static hf_result direction_remove_sites(void* h) { return hf_direction_remove_sites(h, 1, scene.sites); }
static hf_result direction_move_sites(void* h) {
  const uint32_t vertex = 7;
  return hf_direction_move_sites(h, 1, scene.sites, &vertex);
}
static hf_result direction_set_vectors(void* h) {
  const double vector[3] = {1, 0, 0};
  return hf_direction_set_vectors(h, 1, scene.sites, vector);
}
static hf_result direction_rotate_sites(void* h) {
  const double angle = 1;
  return hf_direction_rotate_sites(h, 1, scene.sites, &angle);
}
static hf_result direction_clone(void* h) {
  hf_direction out;
  return hf_direction_clone(h, &out);
}
static hf_result direction_get_sites(void* h) { return hf_direction_get_sites(h, 2, numbers, NULL, NULL, NULL); }
static hf_result direction_solve(void* h) { return hf_direction_solve(h, OUT(floats), NULL); }
static hf_result direction_get_singularities(void* h) {
  uint32_t count;
  return hf_direction_get_singularities(h, 0, NULL, &count);
}
static hf_result direction_get_statistics(void* h) {
  hf_direction_statistics s = HF_INIT(hf_direction_statistics);
  return hf_direction_get_statistics(h, &s);
}

static hf_result pose_clone(void* h) {
  hf_pose out;
  return hf_pose_clone(h, &out);
}
static hf_result pose_add_handles(void* h) {
  const uint32_t count = 1, vertex = 5 * TUBE_AROUND;
  hf_handles_desc d = HF_INIT(hf_handles_desc);
  d.handle_count = 1;
  d.region_counts = &count;
  d.region_vertices = &vertex;
  return hf_pose_add_handles(h, &d, NULL);
}
static hf_result pose_remove_handles(void* h) { return hf_pose_remove_handles(h, 1, scene.handles); }
static hf_result pose_set_transforms(void* h) {
  const hf_transform rest = {{0, 0, 0, 1}, {0, 0, 0}};
  return hf_pose_set_transforms(h, 1, scene.handles, &rest);
}
static hf_result pose_set_matrices(void* h) {
  const double unit[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  return hf_pose_set_matrices(h, 1, scene.handles, unit);
}
static hf_result pose_set_free_rotations(void* h) { return hf_pose_set_free_rotations(h, 1, scene.handles, 1); }
static hf_result pose_set_rigid_pieces(void* h) { return hf_pose_set_rigid_pieces(h, 0, NULL); }
static hf_result pose_set_following(void* h) { return hf_pose_set_following(h, 1, scene.handles, 0.5); }
static hf_result pose_set_limb_refine(void* h) { return hf_pose_set_limb_refine(h, 1, scene.handles, 2); }
static hf_result pose_get_skin(void* h) {
  hf_skin_info info = HF_INIT(hf_skin_info);
  return hf_pose_get_skin(h, &info);
}
static hf_result pose_get_handle(void* h) {
  hf_handle_info i = HF_INIT(hf_handle_info);
  return hf_pose_get_handle(h, scene.handles[0], &i);
}
static hf_result pose_get_field(void* h) { return hf_pose_get_field(h, scene.handles[0], OUT(floats)); }
static hf_result deform(void* h) {
  hf_deform_desc d = HF_INIT(hf_deform_desc);
  d.positions = ROWS_OUT(floats);
  return hf_pose_deform(h, &d, NULL);
}

static hf_result transfer_add_pairs(void* h) {
  const uint32_t count = 1, vertex = 5 * TUBE_AROUND;
  hf_pairs_desc d = HF_INIT(hf_pairs_desc);
  d.pair_count = 1;
  d.source_counts = d.target_counts = &count;
  d.source_vertices = d.target_vertices = &vertex;
  return hf_transfer_add_pairs(h, &d, NULL);
}
static hf_result transfer_remove_pairs(void* h) { return hf_transfer_remove_pairs(h, 1, scene.pairs); }
static hf_result transfer_get_pair(void* h) {
  hf_pair_info i = HF_INIT(hf_pair_info);
  return hf_transfer_get_pair(h, scene.pairs[0], &i);
}
static hf_result transfer_get_info(void* h) {
  hf_transfer_info i = HF_INIT(hf_transfer_info);
  return hf_transfer_get_info(h, &i);
}
static hf_result transfer_set_dials(void* h) { return hf_transfer_set_dials(h, NULL); }
static hf_result transfer_get_dials(void* h) {
  hf_transfer_dials d = HF_INIT(hf_transfer_dials);
  return hf_transfer_get_dials(h, &d);
}
static hf_result transfer_get_sinking(void* h) { return hf_transfer_get_sinking(h, (uint8_t*)numbers); }
static hf_result transfer_apply(void* h) {
  hf_transfer_frame f = HF_INIT(hf_transfer_frame);
  f.source_positions = HF_ARRAY(scene.posed, TUBE_VERTICES);
  f.target_positions = ROWS_OUT(floats);
  return hf_transfer_apply(h, &f);
}
static hf_result transfer_get_skin(void* h) {
  hf_skin_info i = HF_INIT(hf_skin_info);
  return hf_transfer_get_skin(h, &i);
}

static hf_result weights_create(void* h) {
  const hf_joints_desc bones = scene_bones();
  hf_weights out;
  return hf_weights_create(h, &bones, 0, &out);
}
static hf_result weights_clone(void* h) {
  hf_weights out;
  return hf_weights_clone(h, &out);
}
static hf_result weights_set_bones(void* h) {
  const hf_joints_desc bones = scene_bones();
  return hf_weights_set_joints(h, &bones);
}
static hf_result weights_set_pins(void* h) {
  const hf_pins_desc pins = HF_INIT(hf_pins_desc);
  return hf_weights_set_pins(h, &pins);
}
static hf_result weights_set_locks(void* h) { return hf_weights_set_locks(h, 0, NULL, NULL); }
static hf_result weights_get(void* h) {
  hf_weights_out out = HF_INIT(hf_weights_out);
  return hf_weights_get(h, &out);
}
static hf_result weights_get_bones(void* h) { return hf_weights_get_joints(h, 0, NULL, NULL, numbers); }
static hf_result weights_get_helpers(void* h) { return hf_weights_get_helpers(h, NULL, 0, NULL, numbers); }
static hf_weights_transfer_desc carried(void) {
  static uint32_t joints[TUBE_VERTICES];
  static float shares[TUBE_VERTICES];
  for (int v = 0; v < TUBE_VERTICES; ++v) shares[v] = 1;
  hf_weights_transfer_desc desc = HF_INIT(hf_weights_transfer_desc);
  desc.source_influence_count = 1;
  desc.joints = joints;
  desc.weights = shares;
  return desc;
}
static hf_result weights_carry_from(void* h) {
  const hf_weights_transfer_desc desc = carried();
  hf_weights_out out = HF_INIT(hf_weights_out);
  return hf_weights_transfer(h, scene.body, &desc, &out, NULL);
}
static hf_result weights_carry_to(void* h) {
  const hf_weights_transfer_desc desc = carried();
  hf_weights_out out = HF_INIT(hf_weights_out);
  return hf_weights_transfer(scene.body, h, &desc, &out, NULL);
}
static hf_result weights_mirror(void* h) {
  static const double head[3] = {0, 0, 0};
  const hf_weights_transfer_desc given = carried();
  hf_weights_mirror_desc desc = HF_INIT(hf_weights_mirror_desc);
  desc.joint_count = 1;
  desc.heads = head;
  desc.source_influence_count = 1;
  desc.joints = given.joints;
  desc.weights = given.weights;
  hf_weights_out out = HF_INIT(hf_weights_out);
  return hf_weights_mirror(h, &desc, &out, NULL, NULL, NULL, NULL);
}
static hf_result weights_get_info(void* h) {
  hf_weights_info info = HF_INIT(hf_weights_info);
  return hf_weights_get_info(h, &info);
}
static hf_result links_info(void* h) {
  hf_links_info out = HF_INIT(hf_links_info);
  return hf_surface_get_links_info(h, &out);
}
static hf_result mesh_statistics(void* h) {
  hf_mesh_statistics out = HF_INIT(hf_mesh_statistics);
  return hf_surface_get_mesh_statistics(h, &out);
}
static hf_result weights_statistics(void* h) {
  hf_weights_statistics out = HF_INIT(hf_weights_statistics);
  return hf_weights_get_statistics(h, &out);
}
static hf_result pose_statistics(void* h) {
  hf_pose_statistics out = HF_INIT(hf_pose_statistics);
  return hf_pose_get_statistics(h, &out);
}
static hf_result transfer_statistics(void* h) {
  hf_transfer_statistics out = HF_INIT(hf_transfer_statistics);
  return hf_transfer_get_statistics(h, &out);
}

static hf_result progress_get(void* h) {
  double f;
  return hf_progress_get_fraction(h, &f);
}
static hf_result progress_cancel(void* h) { return hf_progress_cancel(h); }

enum Kind { SURFACE, SOLVER, POSE, TRANSFER, PROGRESS, GEODESICS, DIRECTION, WEIGHTS, KIND_COUNT };

static const struct {
  const char* function;
  enum Kind kind;
  hf_result (*call)(void* handle);
  uint32_t index;
} functions[] = {
    {"hf_create", SURFACE, create, NO_INDEX},
    {"hf_surface_get_info", SURFACE, surface_get_info, NO_INDEX},
    {"hf_surface_get_statistics", SURFACE, surface_get_statistics, NO_INDEX},
    {"hf_surface_cast_ray", SURFACE, cast_ray, NO_INDEX},
    {"hf_surface_find_vertex", SURFACE, find_vertex, NO_INDEX},
    {"hf_region_create", SURFACE, region_create, NO_INDEX},
    {"hf_solver_get_info", SOLVER, solver_get_info, NO_INDEX},
    {"hf_solver_add_site", SOLVER, solver_add_site, NO_INDEX},
    {"hf_solver_certify", SOLVER, solver_certify, NO_INDEX},
    {"hf_pose_get_info", POSE, pose_get_info, NO_INDEX},
    {"hf_pose_add_handle_at", POSE, pose_add_handle_at, NO_INDEX},
    {"hf_pose_set_transform", POSE, pose_set_transform, NO_INDEX},
    {"hf_deform", POSE, plain_deform, NO_INDEX},
    {"hf_solver_clone", SOLVER, clone, NO_INDEX},
    {"hf_surface_get_report", SURFACE, get_mesh_report, NO_INDEX},
    {"hf_surface_get_components", SURFACE, get_components, NO_INDEX},
    {"hf_solver_get_statistics", SOLVER, get_statistics, NO_INDEX},
    {"hf_surface_save", SURFACE, surface_save, NO_INDEX},
    {"hf_solver_solve_preview", SOLVER, solve_preview, NO_INDEX},
    {"hf_solver_release_preview", SOLVER, release_preview, NO_INDEX},
    {"hf_add_sites", SOLVER, add_sites, NO_INDEX},
    {"hf_remove_sites", SOLVER, remove_sites, NO_INDEX},
    {"hf_solver_move_sites", SOLVER, move_sites, NO_INDEX},
    {"hf_solver_set_values", SOLVER, set_site_values, NO_INDEX},
    {"hf_solver_set_screening", SOLVER, set_screening, NO_INDEX},
    {"hf_solver_edit_sites", SOLVER, edit_sites, NO_INDEX},
    {"hf_solver_get_sites", SOLVER, get_sites, NO_INDEX},
    {"hf_solve", SOLVER, solve, NO_INDEX},
    {"hf_solver_solve", SOLVER, solve_f64, NO_INDEX},
    {"hf_solver_solve_vectors", SOLVER, solve_vectors, NO_INDEX},
    {"hf_solver_solve_at", SOLVER, solve_at, NO_INDEX},
    {"hf_solver_prepare_rebase", SOLVER, prepare_rebase, NO_INDEX},
    {"hf_pose_create", SURFACE, pose_create, NO_INDEX},
    {"hf_transfer_create", SURFACE, transfer_from, 0},
    {"hf_transfer_create", SURFACE, transfer_to, 1},
    {"hf_pose_clone", POSE, pose_clone, NO_INDEX},
    {"hf_pose_add_handles", POSE, pose_add_handles, NO_INDEX},
    {"hf_pose_remove_handles", POSE, pose_remove_handles, NO_INDEX},
    {"hf_pose_set_transforms", POSE, pose_set_transforms, NO_INDEX},
    {"hf_pose_set_matrices", POSE, pose_set_matrices, NO_INDEX},
    {"hf_pose_set_free_rotations", POSE, pose_set_free_rotations, NO_INDEX},
    {"hf_pose_set_following", POSE, pose_set_following, NO_INDEX},
    {"hf_pose_set_limb_refine", POSE, pose_set_limb_refine, NO_INDEX},
    {"hf_pose_set_rigid_pieces", POSE, pose_set_rigid_pieces, NO_INDEX},
    {"hf_pose_get_skin", POSE, pose_get_skin, NO_INDEX},
    {"hf_pose_get_handle", POSE, pose_get_handle, NO_INDEX},
    {"hf_pose_get_field", POSE, pose_get_field, NO_INDEX},
    {"hf_pose_deform", POSE, deform, NO_INDEX},
    {"hf_transfer_add_pairs", TRANSFER, transfer_add_pairs, NO_INDEX},
    {"hf_transfer_remove_pairs", TRANSFER, transfer_remove_pairs, NO_INDEX},
    {"hf_transfer_get_pair", TRANSFER, transfer_get_pair, NO_INDEX},
    {"hf_transfer_get_info", TRANSFER, transfer_get_info, NO_INDEX},
    {"hf_transfer_set_dials", TRANSFER, transfer_set_dials, NO_INDEX},
    {"hf_transfer_get_dials", TRANSFER, transfer_get_dials, NO_INDEX},
    {"hf_transfer_get_sinking", TRANSFER, transfer_get_sinking, NO_INDEX},
    {"hf_transfer_apply", TRANSFER, transfer_apply, NO_INDEX},
    {"hf_transfer_get_skin", TRANSFER, transfer_get_skin, NO_INDEX},
    {"hf_surface_space_levels", SURFACE, space_levels, NO_INDEX},
    {"hf_surface_trace_isolines", SURFACE, trace_isolines, NO_INDEX},
    {"hf_surface_find_critical_points", SURFACE, find_critical_points, NO_INDEX},
    {"hf_geodesics_create", SURFACE, geodesics_create, NO_INDEX},
    {"hf_surface_find_extremities", SURFACE, find_extremities, NO_INDEX},
    {"hf_surface_propose_handles", SURFACE, propose, NO_INDEX},
    {"hf_geodesics_solve", GEODESICS, geodesics_distance, NO_INDEX},
    {"hf_geodesics_find_path", GEODESICS, geodesics_path, NO_INDEX},
    {"hf_geodesics_get_map", GEODESICS, geodesics_map, NO_INDEX},
    {"hf_surface_find_extremities", GEODESICS, find_extremities_with, NO_INDEX},
    {"hf_solver_move_vectors", SOLVER, move_vector_sites, NO_INDEX},
    {"hf_solver_rotate_vectors", SOLVER, rotate_vector_sites, NO_INDEX},
    {"hf_direction_create", SURFACE, direction_create, NO_INDEX},
    {"hf_direction_add_sites", DIRECTION, direction_add_sites, NO_INDEX},
    {"hf_direction_remove_sites", DIRECTION, direction_remove_sites, NO_INDEX},
    {"hf_direction_move_sites", DIRECTION, direction_move_sites, NO_INDEX},
    {"hf_direction_set_vectors", DIRECTION, direction_set_vectors, NO_INDEX},
    {"hf_direction_rotate_sites", DIRECTION, direction_rotate_sites, NO_INDEX},
    {"hf_direction_clone", DIRECTION, direction_clone, NO_INDEX},
    {"hf_direction_get_sites", DIRECTION, direction_get_sites, NO_INDEX},
    {"hf_direction_solve", DIRECTION, direction_solve, NO_INDEX},
    {"hf_direction_get_singularities", DIRECTION, direction_get_singularities, NO_INDEX},
    {"hf_direction_get_statistics", DIRECTION, direction_get_statistics, NO_INDEX},
    {"hf_progress_get_fraction", PROGRESS, progress_get, NO_INDEX},
    {"hf_progress_cancel", PROGRESS, progress_cancel, NO_INDEX},
    {"hf_weights_create", SURFACE, weights_create, NO_INDEX},
    {"hf_weights_clone", WEIGHTS, weights_clone, NO_INDEX},
    {"hf_weights_set_joints", WEIGHTS, weights_set_bones, NO_INDEX},
    {"hf_weights_set_pins", WEIGHTS, weights_set_pins, NO_INDEX},
    {"hf_weights_set_locks", WEIGHTS, weights_set_locks, NO_INDEX},
    {"hf_weights_get", WEIGHTS, weights_get, NO_INDEX},
    {"hf_weights_get_joints", WEIGHTS, weights_get_bones, NO_INDEX},
    {"hf_weights_get_info", WEIGHTS, weights_get_info, NO_INDEX},
    {"hf_surface_get_links_info", SURFACE, links_info, NO_INDEX},
    {"hf_surface_get_mesh_statistics", SURFACE, mesh_statistics, NO_INDEX},
    {"hf_weights_get_statistics", WEIGHTS, weights_statistics, NO_INDEX},
    {"hf_pose_get_statistics", POSE, pose_statistics, NO_INDEX},
    {"hf_transfer_get_statistics", TRANSFER, transfer_statistics, NO_INDEX},
    {"hf_weights_get_helpers", WEIGHTS, weights_get_helpers, NO_INDEX},
    {"hf_weights_transfer", SURFACE, weights_carry_from, NO_INDEX},
    {"hf_weights_transfer", SURFACE, weights_carry_to, NO_INDEX},
    {"hf_weights_mirror", SURFACE, weights_mirror, NO_INDEX},
};

static int unchanged(enum Kind kind) {
  if (kind == WEIGHTS) return weights_unchanged(&scene);
  return solver_unchanged(&scene) &&
         (kind == SURFACE || kind == SOLVER || kind == PROGRESS || kind == GEODESICS || kind == DIRECTION ||
          (kind == POSE ? pose_unchanged(&scene) : transfer_unchanged(&scene)));
}

static void every_function_refuses_every_handle_that_is_not_its_own(void** state) {
  (void)state;
  scene_create(&scene);
  int on_the_stack = 0;
  void* const live[KIND_COUNT] = {scene.sheet,    scene.solver,    scene.pose,      scene.transfer,
                                  scene.progress, scene.geodesics, scene.direction, scene.weights};
  void* const stale[KIND_COUNT] = {scene.stale_surface,   scene.stale_solver,   scene.stale_pose,
                                   scene.stale_transfer,  scene.stale_progress, scene.stale_geodesics,
                                   scene.stale_direction, scene.stale_weights};
  for (size_t f = 0; f < COUNT_OF(functions); ++f) {
    const enum Kind kind = functions[f].kind;
    struct {
      const char* what;
      void* handle;
    } bad[4 + KIND_COUNT] = {{"NULL", NULL},
                             {"destroyed", stale[kind]},
                             {"all bits set", (void*)UINTPTR_MAX},
                             {"the number 1", (void*)(uintptr_t)1},
                             {"a pointer", &on_the_stack}};
    size_t count = 5;
    for (int other = 0; other < KIND_COUNT; ++other) {
      if ((enum Kind)other != kind) {
        bad[count].what = "a live handle of another kind";
        bad[count++].handle = live[other];
      }
    }
    for (size_t b = 0; b < count; ++b) {
      check_row(__LINE__, bad[b].what, functions[f].function, functions[f].call(bad[b].handle), HF_ERROR_INVALID_OBJECT,
                functions[f].index);
    }
    row_holds(__LINE__, functions[f].function, "the live objects are unchanged", unchanged(kind));
  }
  finish_rows("handles");
  scene_destroy(&scene);
}

static void destroying_what_is_no_handle_does_nothing(void** state) {
  (void)state;
  scene_create(&scene);
  void* const bad[] = {NULL,
                       (void*)UINTPTR_MAX,
                       (void*)(uintptr_t)1,
                       &scene,
                       scene.stale_surface,
                       scene.stale_solver,
                       scene.stale_pose,
                       scene.stale_transfer,
                       scene.stale_progress,
                       scene.stale_geodesics,
                       scene.stale_direction,
                       scene.stale_weights};
  for (size_t b = 0; b < COUNT_OF(bad); ++b) {
    hf_solver_destroy(bad[b]);
    hf_pose_destroy(bad[b]);
    hf_transfer_destroy(bad[b]);
    hf_progress_destroy(bad[b]);
    hf_geodesics_destroy(bad[b]);
    hf_direction_destroy(bad[b]);
    hf_surface_destroy(bad[b]);
    hf_weights_destroy(bad[b]);
  }
  void* const live[KIND_COUNT] = {scene.sheet,    scene.solver,    scene.pose,      scene.transfer,
                                  scene.progress, scene.geodesics, scene.direction, scene.weights};
  for (int k = 0; k < KIND_COUNT; ++k) {
    if (k != SURFACE) hf_surface_destroy(live[k]);
    if (k != SOLVER) hf_solver_destroy(live[k]);
    if (k != POSE) hf_pose_destroy(live[k]);
    if (k != TRANSFER) hf_transfer_destroy(live[k]);
    if (k != PROGRESS) hf_progress_destroy(live[k]);
    if (k != GEODESICS) hf_geodesics_destroy(live[k]);
    if (k != DIRECTION) hf_direction_destroy(live[k]);
    if (k != WEIGHTS) hf_weights_destroy(live[k]);
  }
  double fraction;
  assert_ok(geodesics_distance(scene.geodesics));
  assert_ok(surface_get_info(scene.sheet));
  assert_true(solver_unchanged(&scene) && pose_unchanged(&scene) && transfer_unchanged(&scene));
  assert_true(weights_unchanged(&scene));
  assert_ok(hf_progress_get_fraction(scene.progress, &fraction));
  scene_destroy(&scene);
  assert_code(HF_ERROR_INVALID_OBJECT, hf_solver_release_preview(scene.solver));
}

static void counts_of_what_is_no_handle_are_zero(void** state) {
  (void)state;
  scene_create(&scene);
  assert_int_equal(hf_solver_get_site_count(NULL), 0);
  assert_int_equal(hf_direction_get_site_count(NULL), 0);
  assert_int_equal(hf_direction_get_site_count(scene.stale_direction), 0);
  assert_int_equal(hf_direction_get_site_count(scene.direction), 2);
  assert_int_equal(hf_solver_get_site_count((hf_solver)(void*)scene.sheet), 0);
  assert_int_equal(hf_solver_get_site_count(scene.stale_solver), 0);
  assert_int_equal(hf_solver_get_site_count((hf_solver)(void*)scene.pose), 0);
  assert_int_equal(hf_pose_get_handle_count(NULL), 0);
  assert_int_equal(hf_pose_get_handle_count(scene.stale_pose), 0);
  assert_int_equal(hf_pose_get_handle_count((hf_pose)(void*)scene.solver), 0);
  scene_destroy(&scene);
}

static void a_new_object_never_answers_to_an_old_handle(void** state) {
  (void)state;
  Surface sheet = surface_sheet(2, 2);
  hf_solver first = surface_solver(&sheet);
  hf_solver_destroy(first);
  for (int i = 0; i < 1000; ++i) {
    hf_solver next = surface_solver(&sheet);
    assert_ptr_not_equal(next, first);
    assert_code(HF_ERROR_INVALID_OBJECT, hf_solver_release_preview(first));
    hf_solver_destroy(next);
  }
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_function_refuses_every_handle_that_is_not_its_own),
      cmocka_unit_test(destroying_what_is_no_handle_does_nothing),
      cmocka_unit_test(counts_of_what_is_no_handle_are_zero),
      cmocka_unit_test(a_new_object_never_answers_to_an_old_handle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
