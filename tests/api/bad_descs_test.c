/* Every struct with a struct_size: NULL, sizes below the released one, absurd sizes, and bytes behind the struct that
 * this version does not know. Zero bytes behind it (a newer header, nothing new used) are accepted. */
#include "bad_scene.h"

static Scene scene;
static float floats[3 * TUBE_VERTICES];
static double doubles[3 * TUBE_VERTICES];
static const double value = 2;
static const uint32_t one = 1, free_vertex = 7, middle = 5 * TUBE_AROUND;

/* For each struct: how to fill a good one, and a call that takes it. */
static void fill_surface(void* d) { *(hf_surface_desc*)d = options_of(&scene.cut).surface; }
static hf_result surface_create(void* d) {
  hf_surface surface = (hf_surface)(void*)&scene;
  const hf_result result = hf_surface_create(d, &surface);
  if (result != HF_OK && surface != NULL) return HF_ERROR_INTERNAL; /* the handle must be NULL after a failure */
  hf_surface_destroy(surface);
  return result;
}
static void fill_solver(void* d) { *(hf_solver_desc*)d = HF_INIT(hf_solver_desc); }
static hf_result create(void* d) {
  hf_solver solver = (hf_solver)(void*)&scene;
  const hf_result result = hf_create(scene.sheet, d, &solver);
  if (result != HF_OK && solver != NULL) return HF_ERROR_INTERNAL;
  hf_solver_destroy(solver);
  return result;
}
static union {
  double align[4];
  unsigned char bytes[1 << 16];
} saved;
static void fill_factor(void* d) {
  hf_factor_desc* factor = d;
  *factor = HF_INIT(hf_factor_desc);
  factor->bytes = saved.bytes;
  if (hf_surface_save(scene.sheet, HF_FIELD_HARMONIC, NULL, sizeof saved.bytes, saved.bytes, &factor->byte_count) !=
      HF_OK)
    factor->byte_count = 0;
}
static hf_result create_loaded(void* d) {
  hf_surface_desc desc;
  fill_surface(&desc);
  desc.saved_factor = d;
  return surface_create(&desc);
}
static void fill_surface_info(void* d) { *(hf_surface_info*)d = HF_INIT(hf_surface_info); }
static hf_result surface_info(void* d) { return hf_surface_get_info(scene.sheet, d); }
static void fill_surface_statistics(void* d) { *(hf_surface_statistics*)d = HF_INIT(hf_surface_statistics); }
static hf_result surface_statistics(void* d) { return hf_surface_get_statistics(scene.sheet, d); }
static const double origin[3] = {2.2, 1.3, 9}, down[3] = {0, 0, -1};
static void fill_pick(void* d) { *(hf_pick_desc*)d = HF_INIT(hf_pick_desc); }
static hf_result ray_from(void* d) {
  hf_hit hit = HF_INIT(hf_hit);
  return hf_surface_cast_ray(scene.sheet, origin, down, d, &hit);
}
static hf_result vertex_near(void* d) {
  uint32_t vertex;
  return hf_surface_find_vertex(scene.sheet, origin, d, &vertex, NULL);
}
static void fill_hit(void* d) { *(hf_hit*)d = HF_INIT(hf_hit); }
static hf_result cast_ray(void* d) { return hf_surface_cast_ray(scene.sheet, origin, down, NULL, d); }
static void fill_solver_info(void* d) { *(hf_solver_info*)d = HF_INIT(hf_solver_info); }
static hf_result solver_info(void* d) { return hf_solver_get_info(scene.solver, d); }
static void fill_certificate(void* d) { *(hf_certificate*)d = HF_INIT(hf_certificate); }
static hf_result certify(void* d) { return hf_solver_certify(scene.solver, d); }
static void fill_pose_info(void* d) { *(hf_pose_info*)d = HF_INIT(hf_pose_info); }
static hf_result pose_info(void* d) { return hf_pose_get_info(scene.pose, d); }
static hf_result plain_deform(void* d) { return hf_deform(scene.pose, floats, d); }
static void fill_report(void* d) { *(hf_surface_report*)d = HF_INIT(hf_surface_report); }
static hf_result get_mesh_report(void* d) { return hf_surface_get_report(scene.sheet, d); }
static void fill_statistics(void* d) { *(hf_solver_statistics*)d = HF_INIT(hf_solver_statistics); }
static hf_result get_statistics(void* d) { return hf_solver_get_statistics(scene.solver, d); }
static void fill_sites(void* d) { *(hf_sites_desc*)d = sites_at(1, &free_vertex, &value); }
static hf_result add_sites(void* d) { return hf_add_sites(scene.solver, d, NULL); }
static void fill_places(void* d) { *(hf_sites_desc*)d = sites_at(1, &free_vertex, NULL); }
static hf_result move_sites(void* d) { return hf_solver_move_sites(scene.solver, 1, scene.sites, d); }
static void fill_edit(void* d) {
  hf_edit_desc* edit = d;
  *edit = HF_INIT(hf_edit_desc);
  edit->remove_count = 1;
  edit->remove_sites = scene.sites;
}
static hf_result edit_sites(void* d) { return hf_solver_edit_sites(scene.solver, d, NULL); }
static hf_result edit_add(void* d) {
  hf_edit_desc edit;
  fill_edit(&edit);
  edit.add = d;
  return hf_solver_edit_sites(scene.solver, &edit, NULL);
}
static hf_result edit_move(void* d) {
  hf_edit_desc edit;
  fill_edit(&edit);
  edit.move_count = 1;
  edit.move_sites = scene.sites + 1;
  edit.move_to = d;
  return hf_solver_edit_sites(scene.solver, &edit, NULL);
}
static void fill_site_info(void* d) {
  *(hf_sites_info*)d = HF_INIT(hf_sites_info);
  ((hf_sites_info*)d)->capacity = 3;
}
static hf_result get_sites(void* d) { return hf_solver_get_sites(scene.solver, d); }
static void fill_solve_info(void* d) { *(hf_solve_info*)d = HF_INIT(hf_solve_info); }
static hf_result solve(void* d) { return hf_solve(scene.solver, floats, 0, d); }
static hf_result solve_f64(void* d) { return hf_solver_solve_f64(scene.solver, doubles, 0, d); }
static void fill_preview_info(void* d) { *(hf_preview_info*)d = HF_INIT(hf_preview_info); }
static hf_result solve_preview(void* d) { return hf_solver_solve_preview(scene.solver, floats, 0, 1, d); }
static hf_result solve_preview_f64(void* d) { return hf_solver_solve_preview_f64(scene.solver, doubles, 0, 0, d); }
static hf_result with_three_sites(hf_result (*call)(hf_solver, void*), void* d) {
  hf_solver copy = NULL;
  hf_result result = hf_solver_clone(scene.three, &copy);
  const double vector[3] = {1, 2, 3};
  const hf_sites_desc site = sites_at(1, &free_vertex, vector);
  if (result == HF_OK) result = hf_add_sites(copy, &site, NULL);
  if (result == HF_OK) result = call(copy, d);
  hf_solver_destroy(copy);
  return result;
}
static hf_result vectors(hf_solver s, void* d) { return hf_solver_solve_vectors(s, floats, 0, NULL, d); }
static hf_result vectors_f64(hf_solver s, void* d) { return hf_solver_solve_vectors_f64(s, doubles, 0, NULL, d); }
static hf_result solve_vectors(void* d) { return with_three_sites(vectors, d); }
static hf_result solve_vectors_f64(void* d) { return with_three_sites(vectors_f64, d); }

static void fill_pose(void* d) { *(hf_pose_desc*)d = HF_INIT(hf_pose_desc); }
static hf_result pose_create(void* d) {
  hf_pose pose = (hf_pose)(void*)&scene;
  const hf_result result = hf_pose_create(scene.body, d, &pose);
  if (result != HF_OK && pose != NULL) return HF_ERROR_INTERNAL;
  hf_pose_destroy(pose);
  return result;
}
static void fill_handles(void* d) {
  hf_handles_desc* handles = d;
  *handles = HF_INIT(hf_handles_desc);
  handles->handle_count = 1;
  handles->region_counts = &one;
  handles->region_vertices = &middle;
}
static hf_result pose_add_handles(void* d) { return hf_pose_add_handles(scene.pose, d, NULL); }
static void fill_handle_info(void* d) { *(hf_handle_info*)d = HF_INIT(hf_handle_info); }
static hf_result pose_get_handle(void* d) { return hf_pose_get_handle(scene.pose, scene.handles[0], d); }
static void fill_deform(void* d) {
  *(hf_deform_desc*)d = HF_INIT(hf_deform_desc);
  ((hf_deform_desc*)d)->positions = floats;
}
static hf_result deform(void* d) { return hf_pose_deform(scene.pose, d, NULL); }
static void fill_deform_info(void* d) { *(hf_deform_info*)d = HF_INIT(hf_deform_info); }
static hf_result deform_info(void* d) {
  hf_deform_desc desc;
  fill_deform(&desc);
  return hf_pose_deform(scene.pose, &desc, d);
}

static void fill_pose_skin(void* d) { *(hf_skin_info*)d = HF_INIT(hf_skin_info); }
static hf_result pose_get_skin(void* d) { return hf_pose_get_skin(scene.pose, d); }

static void fill_transfer(void* d) { *(hf_transfer_desc*)d = HF_INIT(hf_transfer_desc); }
static hf_result transfer_create(void* d) {
  hf_transfer transfer = (hf_transfer)(void*)&scene;
  const hf_result result = hf_transfer_create(scene.body, scene.body, d, &transfer);
  if (result != HF_OK && transfer != NULL) return HF_ERROR_INTERNAL;
  hf_transfer_destroy(transfer);
  return result;
}
static void fill_pairs(void* d) {
  hf_pairs_desc* pairs = d;
  *pairs = HF_INIT(hf_pairs_desc);
  pairs->pair_count = 1;
  pairs->source_counts = pairs->target_counts = &one;
  pairs->source_vertices = pairs->target_vertices = &middle;
}
static hf_result transfer_add_pairs(void* d) { return hf_transfer_add_pairs(scene.transfer, d, NULL); }
static void fill_pair_info(void* d) { *(hf_pair_info*)d = HF_INIT(hf_pair_info); }
static void fill_transfer_info(void* d) { *(hf_transfer_info*)d = HF_INIT(hf_transfer_info); }
static hf_result transfer_get_info(void* d) { return hf_transfer_get_info(scene.transfer, d); }
static hf_result transfer_get_pair(void* d) { return hf_transfer_get_pair(scene.transfer, scene.pairs[0], d); }
static void fill_dials(void* d) { *(hf_transfer_dials*)d = HF_INIT(hf_transfer_dials); }
static hf_result transfer_set_dials(void* d) { return hf_transfer_set_dials(scene.transfer, d); }
static hf_result transfer_get_dials(void* d) { return hf_transfer_get_dials(scene.transfer, d); }
static void fill_frame(void* d) {
  hf_transfer_frame* frame = d;
  *frame = HF_INIT(hf_transfer_frame);
  frame->source_positions = scene.posed;
  frame->target_positions = floats;
}
static hf_result transfer_apply(void* d) { return hf_transfer_apply(scene.transfer, d); }
static void fill_skin(void* d) { *(hf_skin_info*)d = HF_INIT(hf_skin_info); }
static hf_result transfer_get_skin(void* d) { return hf_transfer_get_skin(scene.transfer, d); }

static void fill_scalars(void* d) {
  for (uint32_t v = 0; v < CUT_VERTICES; ++v) doubles[v] = v;
  *(hf_scalars*)d = HF_INIT(hf_scalars);
  ((hf_scalars*)d)->values_f64 = doubles;
}
static hf_result space_levels(void* d) {
  double level;
  return hf_surface_space_levels(scene.sheet, d, HF_LEVELS_AREA, 1, &level);
}
static hf_result trace_field(void* d) {
  hf_isolines lines = HF_INIT(hf_isolines);
  return hf_surface_trace_isolines(scene.sheet, d, 1, &value, &lines);
}
static void fill_isolines(void* d) { *(hf_isolines*)d = HF_INIT(hf_isolines); }
static hf_result trace_isolines(void* d) {
  hf_scalars field;
  fill_scalars(&field);
  return hf_surface_trace_isolines(scene.sheet, &field, 1, &value, d);
}
static hf_result critical_field(void* d) {
  hf_critical_info info = HF_INIT(hf_critical_info);
  return hf_surface_find_critical_points(scene.sheet, d, 0, NULL, &info);
}
static void fill_critical_info(void* d) { *(hf_critical_info*)d = HF_INIT(hf_critical_info); }
static hf_result critical_info(void* d) {
  static hf_critical_point points[CUT_VERTICES];
  hf_scalars field;
  fill_scalars(&field);
  return hf_surface_find_critical_points(scene.sheet, &field, CUT_VERTICES, points, d);
}
static void fill_path(void* d) { *(hf_path*)d = HF_INIT(hf_path); }
static hf_result find_path(void* d) {
  const hf_place point = {{3, HF_NO_INDEX, HF_NO_INDEX}, 0, {1, 0, 0}};
  return hf_geodesics_find_path(scene.geodesics, &point, &point, d);
}
static void fill_geodesics(void* d) { *(hf_geodesics_desc*)d = HF_INIT(hf_geodesics_desc); }
static hf_result geodesics_create(void* d) {
  hf_geodesics geodesics = (hf_geodesics)(void*)&scene;
  const hf_result result = hf_geodesics_create(scene.body, d, &geodesics);
  if (result != HF_OK && geodesics != NULL) return HF_ERROR_INTERNAL;
  hf_geodesics_destroy(geodesics);
  return result;
}
static void fill_propose(void* d) { *(hf_handle_proposals_desc*)d = HF_INIT(hf_handle_proposals_desc); }
static hf_result propose(void* d) {
  uint32_t count;
  return hf_surface_propose_handles(scene.body, d, 0, NULL, &count);
}
static void fill_extremities(void* d) { *(hf_extremities_desc*)d = HF_INIT(hf_extremities_desc); }
static hf_result find_extremities(void* d) {
  uint32_t count;
  return hf_surface_find_extremities(scene.body, d, 0, NULL, &count);
}

static void fill_direction(void* d) { *(hf_direction_desc*)d = HF_INIT(hf_direction_desc); }
static hf_result direction_create(void* d) {
  hf_direction direction = (hf_direction)(void*)&scene;
  const hf_result result = hf_direction_create(scene.body, d, &direction);
  if (result != HF_OK && direction != NULL) return HF_ERROR_INTERNAL;
  hf_direction_destroy(direction);
  return result;
}
static hf_result direction_solve(void* d) { return hf_direction_solve(scene.direction, floats, 0, d); }
static hf_result direction_solve_f64(void* d) { return hf_direction_solve_f64(scene.direction, doubles, 0, d); }
static void fill_direction_statistics(void* d) { *(hf_direction_statistics*)d = HF_INIT(hf_direction_statistics); }
static hf_result direction_statistics(void* d) { return hf_direction_get_statistics(scene.direction, d); }

static void fill_region(void* d) { *(hf_region_desc*)d = HF_INIT(hf_region_desc); }
static hf_result region_create(void* d) {
  hf_region region = (hf_region)(void*)&scene;
  const hf_result result = hf_region_create(scene.body, d, &region);
  if (result != HF_OK && region != NULL) return HF_ERROR_INTERNAL;
  hf_region_destroy(region);
  return result;
}
static void fill_region_edit(void* d) {
  hf_region_edit_desc* edit = d;
  *edit = HF_INIT(hf_region_edit_desc);
  edit->add_count = 1;
  edit->add_vertices = &middle;
}
static hf_result region_edit(void* d) { return hf_region_edit(scene.region, d); }
static const uint32_t around[3] = {3 * TUBE_AROUND, 3 * TUBE_AROUND + 3, 3 * TUBE_AROUND + 6};
static void fill_curve(void* d) {
  hf_curve_desc* curve = d;
  *curve = HF_INIT(hf_curve_desc);
  curve->point_count = 3;
  curve->vertices = around;
}
static hf_result region_curve(void* d) {
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.curve = d;
  edit.add_count = 1;
  edit.add_vertices = &middle;
  return hf_region_edit(scene.region, &edit);
}
static void fill_region_info(void* d) { *(hf_region_info*)d = HF_INIT(hf_region_info); }
static hf_result region_info(void* d) { return hf_region_get_info(scene.region, d); }
static void fill_morph(void* d) {
  hf_morph_desc* morph = d;
  *morph = HF_INIT(hf_morph_desc);
  morph->positions = floats;
}
static hf_result region_morph(void* d) { return hf_region_morph(scene.region, d); }
static void fill_detail(void* d) { *(hf_detail_desc*)d = HF_INIT(hf_detail_desc); }
static hf_result detail_create(void* d) {
  hf_detail detail = (hf_detail)(void*)&scene;
  const hf_result result = hf_detail_create(scene.region, scene.region, d, &detail);
  if (result != HF_OK && detail != NULL) return HF_ERROR_INTERNAL;
  hf_detail_destroy(detail);
  return result;
}

static void fill_bones(void* d) { *(hf_joints_desc*)d = scene_bones(); }
static hf_result weights_create(void* d) {
  hf_weights weights = (hf_weights)(void*)&scene;
  const hf_result result = hf_weights_create(scene.body, d, 4, &weights);
  if (result != HF_OK && weights != NULL) return HF_ERROR_INTERNAL;
  hf_weights_destroy(weights);
  return result;
}
static hf_result weights_set_bones(void* d) { return hf_weights_set_joints(scene.weights, d); }
static void fill_pins(void* d) { *(hf_pins_desc*)d = HF_INIT(hf_pins_desc); }
static hf_result weights_set_pins(void* d) { return hf_weights_set_pins(scene.weights, d); }
static void fill_weights_out(void* d) { *(hf_weights_out*)d = HF_INIT(hf_weights_out); }
static hf_result weights_get(void* d) { return hf_weights_get(scene.weights, d); }
static uint32_t one_joint[TUBE_VERTICES];
static float one_share[TUBE_VERTICES];
static const double one_head[3] = {0, 0, 0};
static void fill_carry(void* d) {
  for (int v = 0; v < TUBE_VERTICES; ++v) one_share[v] = 1;
  hf_weights_transfer_desc* desc = d;
  *desc = HF_INIT(hf_weights_transfer_desc);
  desc->source_influence_count = 1;
  desc->joints = one_joint;
  desc->weights = one_share;
}
static hf_result weights_carry(void* d) {
  hf_weights_out out = HF_INIT(hf_weights_out);
  return hf_weights_transfer(scene.body, scene.body, d, &out, NULL);
}
static hf_result weights_carry_out(void* d) {
  hf_weights_transfer_desc desc;
  fill_carry(&desc);
  return hf_weights_transfer(scene.body, scene.body, &desc, d, NULL);
}
static void fill_carry_info(void* d) { *(hf_weights_transfer_info*)d = HF_INIT(hf_weights_transfer_info); }
static hf_result weights_carry_info(void* d) {
  hf_weights_transfer_desc desc;
  hf_weights_out out = HF_INIT(hf_weights_out);
  fill_carry(&desc);
  return hf_weights_transfer(scene.body, scene.body, &desc, &out, d);
}
static void fill_mirror(void* d) {
  hf_weights_transfer_desc given;
  fill_carry(&given);
  hf_weights_mirror_desc* desc = d;
  *desc = HF_INIT(hf_weights_mirror_desc);
  desc->joint_count = 1;
  desc->heads = one_head;
  desc->source_influence_count = 1;
  desc->joints = one_joint;
  desc->weights = one_share;
}
static hf_result weights_mirror(void* d) {
  hf_weights_out out = HF_INIT(hf_weights_out);
  return hf_weights_mirror(scene.body, d, &out, NULL, NULL, NULL, NULL);
}
static hf_result weights_mirror_out(void* d) {
  hf_weights_mirror_desc desc;
  fill_mirror(&desc);
  return hf_weights_mirror(scene.body, &desc, d, NULL, NULL, NULL, NULL);
}
static void fill_mirror_info(void* d) { *(hf_weights_mirror_info*)d = HF_INIT(hf_weights_mirror_info); }
static hf_result weights_mirror_info(void* d) {
  hf_weights_mirror_desc desc;
  hf_weights_out out = HF_INIT(hf_weights_out);
  fill_mirror(&desc);
  return hf_weights_mirror(scene.body, &desc, &out, NULL, NULL, d, NULL);
}
static void fill_weights_info(void* d) { *(hf_weights_info*)d = HF_INIT(hf_weights_info); }
static hf_result weights_info(void* d) { return hf_weights_get_info(scene.weights, d); }

static void fill_mirror_statistics(void* d) {
  *(hf_weights_mirror_statistics*)d = HF_INIT(hf_weights_mirror_statistics);
}
static hf_result weights_mirror_statistics(void* d) {
  hf_weights_mirror_desc desc;
  hf_weights_out out = HF_INIT(hf_weights_out);
  fill_mirror(&desc);
  return hf_weights_mirror(scene.body, &desc, &out, NULL, NULL, NULL, d);
}
static void fill_links_info(void* d) { *(hf_links_info*)d = HF_INIT(hf_links_info); }
static hf_result links_info(void* d) { return hf_surface_get_links_info(scene.sheet, d); }
static void fill_mesh_statistics(void* d) { *(hf_mesh_statistics*)d = HF_INIT(hf_mesh_statistics); }
static hf_result mesh_statistics(void* d) { return hf_surface_get_mesh_statistics(scene.sheet, d); }
static void fill_weights_statistics(void* d) { *(hf_weights_statistics*)d = HF_INIT(hf_weights_statistics); }
static hf_result weights_statistics(void* d) { return hf_weights_get_statistics(scene.weights, d); }
static void fill_region_statistics(void* d) { *(hf_region_statistics*)d = HF_INIT(hf_region_statistics); }
static hf_result region_statistics(void* d) { return hf_region_get_statistics(scene.region, d); }
static void fill_pose_statistics(void* d) { *(hf_pose_statistics*)d = HF_INIT(hf_pose_statistics); }
static hf_result pose_statistics(void* d) { return hf_pose_get_statistics(scene.pose, d); }
static void fill_transfer_statistics(void* d) { *(hf_transfer_statistics*)d = HF_INIT(hf_transfer_statistics); }
static hf_result transfer_statistics(void* d) { return hf_transfer_get_statistics(scene.transfer, d); }

static const struct {
  const char* what; /* function and argument */
  size_t size;
  void (*fill)(void*);
  hf_result (*call)(void*);
  int optional; /* NULL is allowed */
} structs[] = {
    {"hf_surface_create: desc", sizeof(hf_surface_desc), fill_surface, surface_create, 0},
    {"hf_surface_create: desc->saved_factor", sizeof(hf_factor_desc), fill_factor, create_loaded, 1},
    {"hf_surface_get_info: out_info", sizeof(hf_surface_info), fill_surface_info, surface_info, 0},
    {"hf_surface_get_statistics: out_statistics", sizeof(hf_surface_statistics), fill_surface_statistics,
     surface_statistics, 0},
    {"hf_surface_cast_ray: desc", sizeof(hf_pick_desc), fill_pick, ray_from, 1},
    {"hf_surface_cast_ray: out_hit", sizeof(hf_hit), fill_hit, cast_ray, 0},
    {"hf_surface_find_vertex: desc", sizeof(hf_pick_desc), fill_pick, vertex_near, 1},
    {"hf_create: desc", sizeof(hf_solver_desc), fill_solver, create, 1},
    {"hf_solver_get_info: out_info", sizeof(hf_solver_info), fill_solver_info, solver_info, 0},
    {"hf_solver_certify: inout_certificate", sizeof(hf_certificate), fill_certificate, certify, 0},
    {"hf_pose_get_info: out_info", sizeof(hf_pose_info), fill_pose_info, pose_info, 0},
    {"hf_deform: out_info", sizeof(hf_deform_info), fill_deform_info, plain_deform, 1},
    {"hf_surface_get_report: out_report", sizeof(hf_surface_report), fill_report, get_mesh_report, 0},
    {"hf_solver_get_statistics: out_statistics", sizeof(hf_solver_statistics), fill_statistics, get_statistics, 0},
    {"hf_add_sites: sites", sizeof(hf_sites_desc), fill_sites, add_sites, 0},
    {"hf_solver_move_sites: to", sizeof(hf_sites_desc), fill_places, move_sites, 0},
    {"hf_solver_edit_sites: edit", sizeof(hf_edit_desc), fill_edit, edit_sites, 0},
    {"hf_solver_edit_sites: edit->add", sizeof(hf_sites_desc), fill_sites, edit_add, 1},
    {"hf_solver_edit_sites: edit->move_to", sizeof(hf_sites_desc), fill_places, edit_move, 0},
    {"hf_solver_get_sites: out_info", sizeof(hf_sites_info), fill_site_info, get_sites, 0},
    {"hf_solve: out_info", sizeof(hf_solve_info), fill_solve_info, solve, 1},
    {"hf_solver_solve_f64: out_info", sizeof(hf_solve_info), fill_solve_info, solve_f64, 1},
    {"hf_solver_solve_preview: out_info", sizeof(hf_preview_info), fill_preview_info, solve_preview, 1},
    {"hf_solver_solve_preview_f64: out_info", sizeof(hf_preview_info), fill_preview_info, solve_preview_f64, 1},
    {"hf_solver_solve_vectors: out_info", sizeof(hf_solve_info), fill_solve_info, solve_vectors, 1},
    {"hf_solver_solve_vectors_f64: out_info", sizeof(hf_solve_info), fill_solve_info, solve_vectors_f64, 1},
    {"hf_pose_create: desc", sizeof(hf_pose_desc), fill_pose, pose_create, 1},
    {"hf_pose_add_handles: handles", sizeof(hf_handles_desc), fill_handles, pose_add_handles, 0},
    {"hf_pose_get_skin: info", sizeof(hf_skin_info), fill_pose_skin, pose_get_skin, 0},
    {"hf_pose_get_handle: out_info", sizeof(hf_handle_info), fill_handle_info, pose_get_handle, 0},
    {"hf_pose_deform: desc", sizeof(hf_deform_desc), fill_deform, deform, 0},
    {"hf_pose_deform: out_info", sizeof(hf_deform_info), fill_deform_info, deform_info, 1},
    {"hf_transfer_create: desc", sizeof(hf_transfer_desc), fill_transfer, transfer_create, 1},
    {"hf_transfer_add_pairs: pairs", sizeof(hf_pairs_desc), fill_pairs, transfer_add_pairs, 0},
    {"hf_transfer_get_pair: out_info", sizeof(hf_pair_info), fill_pair_info, transfer_get_pair, 0},
    {"hf_transfer_get_info: out_info", sizeof(hf_transfer_info), fill_transfer_info, transfer_get_info, 0},
    {"hf_transfer_set_dials: dials", sizeof(hf_transfer_dials), fill_dials, transfer_set_dials, 1},
    {"hf_transfer_get_dials: out_dials", sizeof(hf_transfer_dials), fill_dials, transfer_get_dials, 0},
    {"hf_transfer_apply: frame", sizeof(hf_transfer_frame), fill_frame, transfer_apply, 0},
    {"hf_surface_space_levels: field", sizeof(hf_scalars), fill_scalars, space_levels, 0},
    {"hf_surface_trace_isolines: field", sizeof(hf_scalars), fill_scalars, trace_field, 0},
    {"hf_surface_trace_isolines: out_lines", sizeof(hf_isolines), fill_isolines, trace_isolines, 0},
    {"hf_surface_find_critical_points: field", sizeof(hf_scalars), fill_scalars, critical_field, 0},
    {"hf_surface_find_critical_points: out_info", sizeof(hf_critical_info), fill_critical_info, critical_info, 1},
    {"hf_geodesics_find_path: inout_path", sizeof(hf_path), fill_path, find_path, 0},
    {"hf_geodesics_create: desc", sizeof(hf_geodesics_desc), fill_geodesics, geodesics_create, 1},
    {"hf_surface_propose_handles: desc", sizeof(hf_handle_proposals_desc), fill_propose, propose, 1},
    {"hf_surface_find_extremities: desc", sizeof(hf_extremities_desc), fill_extremities, find_extremities, 1},
    {"hf_direction_create: desc", sizeof(hf_direction_desc), fill_direction, direction_create, 1},
    {"hf_direction_solve: out_info", sizeof(hf_solve_info), fill_solve_info, direction_solve, 1},
    {"hf_direction_solve_f64: out_info", sizeof(hf_solve_info), fill_solve_info, direction_solve_f64, 1},
    {"hf_direction_get_statistics: out_statistics", sizeof(hf_direction_statistics), fill_direction_statistics,
     direction_statistics, 0},
    {"hf_region_create: desc", sizeof(hf_region_desc), fill_region, region_create, 1},
    {"hf_region_edit: edit", sizeof(hf_region_edit_desc), fill_region_edit, region_edit, 0},
    {"hf_region_edit: edit->curve", sizeof(hf_curve_desc), fill_curve, region_curve, 1},
    {"hf_region_get_info: out_info", sizeof(hf_region_info), fill_region_info, region_info, 0},
    {"hf_region_morph: desc", sizeof(hf_morph_desc), fill_morph, region_morph, 0},
    {"hf_detail_create: desc", sizeof(hf_detail_desc), fill_detail, detail_create, 1},
    {"hf_transfer_get_skin: info", sizeof(hf_skin_info), fill_skin, transfer_get_skin, 0},
    {"hf_weights_create: bones", sizeof(hf_joints_desc), fill_bones, weights_create, 0},
    {"hf_weights_set_joints: bones", sizeof(hf_joints_desc), fill_bones, weights_set_bones, 0},
    {"hf_weights_set_pins: pins", sizeof(hf_pins_desc), fill_pins, weights_set_pins, 0},
    {"hf_weights_get: inout_weights", sizeof(hf_weights_out), fill_weights_out, weights_get, 0},
    {"hf_weights_get_info: out_info", sizeof(hf_weights_info), fill_weights_info, weights_info, 0},
    {"hf_weights_transfer: desc", sizeof(hf_weights_transfer_desc), fill_carry, weights_carry, 0},
    {"hf_weights_transfer: inout_weights", sizeof(hf_weights_out), fill_weights_out, weights_carry_out, 0},
    {"hf_weights_transfer: out_info", sizeof(hf_weights_transfer_info), fill_carry_info, weights_carry_info, 1},
    {"hf_weights_mirror: desc", sizeof(hf_weights_mirror_desc), fill_mirror, weights_mirror, 0},
    {"hf_weights_mirror: inout_weights", sizeof(hf_weights_out), fill_weights_out, weights_mirror_out, 0},
    {"hf_weights_mirror: out_info", sizeof(hf_weights_mirror_info), fill_mirror_info, weights_mirror_info, 1},
    {"hf_weights_mirror: out_statistics", sizeof(hf_weights_mirror_statistics), fill_mirror_statistics,
     weights_mirror_statistics, 1},
    {"hf_surface_get_links_info: out_info", sizeof(hf_links_info), fill_links_info, links_info, 0},
    {"hf_surface_get_mesh_statistics: out_statistics", sizeof(hf_mesh_statistics), fill_mesh_statistics,
     mesh_statistics, 0},
    {"hf_weights_get_statistics: out_statistics", sizeof(hf_weights_statistics), fill_weights_statistics,
     weights_statistics, 0},
    {"hf_region_get_statistics: out_statistics", sizeof(hf_region_statistics), fill_region_statistics,
     region_statistics, 0},
    {"hf_pose_get_statistics: out_statistics", sizeof(hf_pose_statistics), fill_pose_statistics, pose_statistics, 0},
    {"hf_transfer_get_statistics: out_statistics", sizeof(hf_transfer_statistics), fill_transfer_statistics,
     transfer_statistics, 0},
};

enum { SPACE = 5000 };
static union {
  double align;
  unsigned char bytes[SPACE];
} given;

/* A good struct in the middle of known zero bytes, with another struct_size. */
static void* good(size_t s, uint32_t struct_size) {
  memset(&given, 0, sizeof given);
  structs[s].fill(given.bytes);
  memcpy(given.bytes, &struct_size, sizeof struct_size);
  return given.bytes;
}

static void every_struct_is_checked_before_anything_is_done(void** state) {
  (void)state;
  scene_create(&scene);
  for (size_t s = 0; s < COUNT_OF(structs); ++s) {
    const char* what = structs[s].what;
    const uint32_t size = (uint32_t)structs[s].size;
    const uint32_t refused[] = {0, 1, 4, size / 2, size - 1, SPACE - 1, 0x80000000u, UINT32_MAX};
    if (!structs[s].optional) check_row(__LINE__, "NULL", what, structs[s].call(NULL), HF_ERROR_NULL_POINTER, NO_INDEX);
    for (size_t r = 0; r < COUNT_OF(refused); ++r) {
      check_row(__LINE__, "struct_size wrong", what, structs[s].call(good(s, refused[r])), HF_ERROR_INVALID_DESC,
                NO_INDEX);
    }
    for (uint32_t more = 1; more <= 64; more *= 8) {
      void* longer = good(s, size + more);
      given.bytes[size + more - 1] = 1;
      check_row(__LINE__, "an unknown byte is set", what, structs[s].call(longer), HF_ERROR_INVALID_DESC, NO_INDEX);
    }
    row_holds(
        __LINE__, what, "the state is unchanged",
        solver_unchanged(&scene) && pose_unchanged(&scene) && transfer_unchanged(&scene) && weights_unchanged(&scene));
  }
  finish_rows("structs");
  scene_destroy(&scene);
}

static void a_longer_struct_with_zero_bytes_is_accepted_and_only_its_known_part_is_written(void** state) {
  (void)state;
  for (size_t s = 0; s < COUNT_OF(structs); ++s) {
    scene_create(&scene);
    const uint32_t size = (uint32_t)structs[s].size, longer = size + 24;
    check_row(__LINE__, "zero bytes of a newer version", structs[s].what, structs[s].call(good(s, longer)), HF_OK,
              NO_INDEX);
    uint32_t stored;
    memcpy(&stored, given.bytes, sizeof stored);
    row_holds(__LINE__, structs[s].what, "struct_size is left as it was", stored == longer);
    int written = 0;
    for (uint32_t i = size; i < SPACE; ++i) written |= given.bytes[i];
    row_holds(__LINE__, structs[s].what, "bytes behind the struct are not written", !written);
    scene_destroy(&scene);
  }
  finish_rows("longer structs");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_struct_is_checked_before_anything_is_done),
      cmocka_unit_test(a_longer_struct_with_zero_bytes_is_accepted_and_only_its_known_part_is_written),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
