/* Surfaces of graphs: bad input to hf_surface_create_graph, one thing wrong per row, and every function that takes a
 * surface or a solver on one. What needs triangles says so and changes nothing; check_graph.sh sees that no function is
 * missing. */
#include "bad_scene.h"

enum { VERTICES = 8, EDGES = 9 };

static Scene scene;
static CountingAllocator counter;
static hf_graph_desc desc;
static uint32_t edges[2 * EDGES];
static double weights[EDGES], masses[VERTICES];
static hf_surface out;

/* Two squares, one with a diagonal; the edge 8 is parallel to the edge 0. */
static void good_input(void) {
  static const uint32_t good[2 * EDGES] = {0, 1, 1, 2, 2, 3, 3, 0, 0, 2, 4, 5, 5, 6, 6, 4, 1, 0};
  memcpy(edges, good, sizeof edges);
  for (size_t e = 0; e < EDGES; ++e) weights[e] = 0.5 + (double)e;
  for (size_t v = 0; v < VERTICES; ++v) masses[v] = 1 + (double)v;
  desc = HF_INIT(hf_graph_desc);
  desc.vertex_count = VERTICES;
  desc.edges = HF_ARRAY(edges, EDGES);
  desc.weights = HF_ARRAY(weights, EDGES);
  desc.masses = HF_ARRAY(masses, VERTICES);
  desc.allocator = counting_hooks(&counter);
  out = scene.sheet; /* must become NULL */
}
static int nothing_exists(void) {
  return out == NULL && counter.live_blocks == 0 && counter.mismatches == 0 && solver_unchanged(&scene);
}

#define GOOD good_input
#define UNCHANGED nothing_exists
#define CREATE(what, expected, index, change) ROW(what, expected, index, change, hf_surface_create_graph(&desc, &out))

static void no_edge_is_left(void) {
  for (size_t e = 0; e < EDGES; ++e) edges[2 * e + 1] = edges[2 * e];
}
static void no_weight_is_left(void) {
  for (size_t e = 0; e < EDGES; ++e) weights[e] = 0;
}

static void hf_surface_create_graph_refuses_bad_graphs(void** state) {
  (void)state;
  scene_create(&scene);
  good_input();
  assert_ok(hf_surface_create_graph(&desc, &out)); /* the good input is good */
  hf_surface_destroy(out);
  out = NULL;
  assert_true(nothing_exists());

  CREATE("no vertices", HF_ERROR_EMPTY, NO_INDEX, (desc.vertex_count = 0, desc.masses.count = 0));
  CREATE("no edges", HF_ERROR_EMPTY, NO_INDEX, (desc.edges.count = 0, desc.weights.count = 0));
  CREATE("no edge array", HF_ERROR_NULL_POINTER, NO_INDEX, desc.edges.data = NULL);
  CREATE("no weights", HF_ERROR_NULL_POINTER, NO_INDEX, desc.weights.data = NULL);
  CREATE("self loops alone", HF_ERROR_EMPTY, NO_INDEX, no_edge_is_left());
  CREATE("weights of 0 alone", HF_ERROR_EMPTY, NO_INDEX, no_weight_is_left());
  CREATE("end = vertex_count", HF_ERROR_OUT_OF_RANGE, 0, edges[0] = VERTICES);
  CREATE("end UINT32_MAX", HF_ERROR_OUT_OF_RANGE, 8, edges[17] = UINT32_MAX);
  CREATE("end 2^31", HF_ERROR_OUT_OF_RANGE, 3, edges[6] = 0x80000000u);
  CREATE("vertex_count one too small", HF_ERROR_OUT_OF_RANGE, 6, (desc.vertex_count = 6, desc.masses.count = 6));
  CREATE("a mass too few", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.masses.count -= 1);
  CREATE("a weight too few", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.weights.count -= 1);
  CREATE("weight NaN", HF_ERROR_NON_FINITE, 2, weights[2] = (double)NAN);
  CREATE("weight infinite", HF_ERROR_NON_FINITE, 0, weights[0] = HUGE_VAL);
  CREATE("weight minus infinity", HF_ERROR_NON_FINITE, 8, weights[8] = -HUGE_VAL);
  CREATE("weight NaN of a self loop", HF_ERROR_NON_FINITE, 4, (edges[8] = edges[9], weights[4] = (double)NAN));
  CREATE("weight above 1e100", HF_ERROR_TOO_LARGE, 5, weights[5] = 1.1e100);
  CREATE("weight below 0", HF_ERROR_INVALID_ARGUMENT, 4, weights[4] = -1e-300);
  CREATE("negative weights that outweigh the others", HF_ERROR_NOT_POSITIVE_DEFINITE, 0,
         (desc.allow_negative = 1, weights[3] = -100));
  CREATE("weight below -1e100", HF_ERROR_TOO_LARGE, 7, (desc.allow_negative = 1, weights[7] = -1.1e100));
  CREATE("mass NaN", HF_ERROR_NON_FINITE, 3, masses[3] = (double)NAN);
  CREATE("mass infinite", HF_ERROR_NON_FINITE, 7, masses[7] = HUGE_VAL);
  CREATE("mass 0", HF_ERROR_INVALID_ARGUMENT, 0, masses[0] = 0);
  CREATE("mass below 0", HF_ERROR_INVALID_ARGUMENT, 6, masses[6] = -1);
  CREATE("mass above 1e100", HF_ERROR_TOO_LARGE, 6, masses[6] = 2e100);

  CREATE("2^32 - 1 vertices", HF_ERROR_TOO_LARGE, NO_INDEX, desc.vertex_count = UINT32_MAX);
  CREATE("2^31 vertices, limit lifted", HF_ERROR_TOO_LARGE, NO_INDEX,
         (desc.vertex_count = desc.masses.count = 0x80000000u, desc.vertex_limit = UINT32_MAX));
  CREATE("2^32 - 1 edges", HF_ERROR_TOO_LARGE, NO_INDEX, desc.edges.count = desc.weights.count = UINT32_MAX);
  CREATE("2^31 edges, limit lifted", HF_ERROR_TOO_LARGE, NO_INDEX,
         (desc.edges.count = desc.weights.count = 0x80000000u, desc.edge_limit = UINT32_MAX));
  CREATE("more edges than sixteen per vertex of the limit", HF_ERROR_TOO_LARGE, NO_INDEX,
         (desc.vertex_limit = VERTICES, desc.edges.count = desc.weights.count = 16 * (VERTICES + 1)));
  CREATE("a vertex more than the limit", HF_ERROR_TOO_LARGE, NO_INDEX, desc.vertex_limit = VERTICES - 1);
  CREATE("an edge more than the limit", HF_ERROR_TOO_LARGE, NO_INDEX, desc.edge_limit = EDGES - 1);
  scene_destroy(&scene);
  finish_rows("graphs");
}

static void hf_surface_create_graph_refuses_bad_options(void** state) {
  (void)state;
  scene_create(&scene);
  hf_factor_desc saved = HF_INIT(hf_factor_desc);
  size_t size;
  unsigned char* bytes = saved_bytes(scene.body, HF_FIELD_HARMONIC, &size);
  saved.bytes = bytes;
  saved.byte_count = size;

  CREATE("allow_negative 2", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.allow_negative = 2);
  CREATE("field kind -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.field_kind = -1);
  CREATE("field kind 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.field_kind = 3);
  CREATE("ordering 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.ordering = 3);
  CREATE("257 threads", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.thread_count = 257);
  CREATE("struct_size 0", HF_ERROR_INVALID_DESC, NO_INDEX, desc.struct_size = 0);
  CREATE("allocator without release", HF_ERROR_NULL_POINTER, NO_INDEX, desc.allocator.release = NULL);
  CREATE("allocator that refuses at once", HF_ERROR_OUT_OF_MEMORY, NO_INDEX, counter.refuse_at = counter.calls + 1);
  CREATE("allocator that refuses later", HF_ERROR_OUT_OF_MEMORY, NO_INDEX,
         (counter.refuse_at = counter.calls + 20, counter.refuse_on = 1));
  counter.refuse_at = 0;
  counter.refuse_on = 0;
  CREATE("progress destroyed", HF_ERROR_INVALID_OBJECT, NO_INDEX, desc.progress = scene.stale_progress);
  CREATE("progress cancelled before", HF_ERROR_CANCELLED, NO_INDEX,
         (desc.progress = scene.progress, hf_progress_cancel(scene.progress)));
  CREATE("factor of a mesh", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.saved_factor = &saved);
  if (!has_gpl()) {
    CREATE("ordering of another build", HF_ERROR_UNSUPPORTED, NO_INDEX, desc.ordering = HF_ORDERING_METIS);
  }
  ROW("no desc", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_create_graph(NULL, &out));
  good_input();
  check_row(__LINE__, "no place for the handle", "hf_surface_create_graph", hf_surface_create_graph(&desc, NULL),
            HF_ERROR_NULL_POINTER, NO_INDEX);
  free(bytes);
  scene_destroy(&scene);
  finish_rows("options of graphs");
}

/* Every prefix of the allocations of a graph fails cleanly. */
static void hf_surface_create_graph_survives_every_refused_allocation(void** state) {
  (void)state;
  scene_create(&scene);
  good_input();
  size_t at = 1;
  counter.refuse_on = 1;
  for (;; ++at) {
    counter.calls = 0;
    counter.refuse_at = at;
    const hf_result result = hf_surface_create_graph(&desc, &out);
    if (result == HF_OK) break;
    assert_code(HF_ERROR_OUT_OF_MEMORY, result);
    assert_true(nothing_exists());
  }
  assert_true(at > 30);
  counter.refuse_at = 0;
  hf_surface_destroy(out);
  assert_int_equal(counter.live_blocks, 0);
  scene_destroy(&scene);
}

/* ---- every function on a graph ---- */

static hf_surface graph;
static hf_solver solver, vectors;
static double before[VERTICES];

static int field_unchanged(void) {
  double now[VERTICES];
  return hf_solver_solve(solver, OUT(now), NULL) == HF_OK && same_bits(now, before, sizeof now) &&
         hf_solver_get_site_count(vectors) == 1;
}
static void nothing(void) {}

#undef GOOD
#undef UNCHANGED
#define GOOD nothing
#define UNCHANGED field_unchanged
#define NEEDS(what, index, call)                                                             \
  do {                                                                                       \
    ROW(what, HF_ERROR_UNSUPPORTED, index, (void)0, call);                                   \
    hf_error_detail detail;                                                                  \
    assert_int_equal(hf_error_get_detail(&detail), HF_OK);                                   \
    row_holds(__LINE__, what, "the message says what is missing",                            \
              strstr(detail.message, "needs triangles") && strstr(detail.message, "graph")); \
  } while (0)

static void make_graph_solvers(void) {
  good_input();
  out = NULL;
  assert_ok(hf_surface_create_graph(&desc, &graph));
  hf_solver_desc three = HF_INIT(hf_solver_desc);
  three.channel_count = 3;
  const double up[3] = {0, 0, 1};
  assert_ok(hf_create(graph, NULL, &solver));
  assert_ok(hf_create(graph, &three, &vectors));
  add_site(solver, 0, 1);
  add_site(solver, 2, -1);
  assert_ok(hf_solver_add_site(vectors, 1, up, NULL));
  assert_ok(hf_solver_solve(solver, OUT(before), NULL));
}

static void surfaces_of_graphs_refuse_what_needs_triangles(void** state) {
  (void)state;
  scene_create(&scene);
  make_graph_solvers();
  const double point[3] = {0, 0, 0}, ray[3] = {0, 0, 1}, level = 0.5;
  hf_hit hit = HF_INIT(hf_hit);
  const hf_array scalars = HF_ARRAY(before, VERTICES);
  hf_isolines lines = HF_INIT(hf_isolines);
  hf_critical_info critical = HF_INIT(hf_critical_info);
  uint32_t number = 0;
  double levels[2], distance, xyz[3 * VERTICES];
  float xyz_f32[3 * VERTICES];
  hf_surface relinked = NULL;
  const hf_array posed = HF_ARRAY(xyz, VERTICES);
  hf_gaps_info gaps = HF_INIT(hf_gaps_info);
  hf_pose pose = NULL;
  hf_region region = NULL;
  hf_direction direction = NULL;
  hf_geodesics geodesics = NULL;
  hf_quads quads = NULL;
  hf_weights weights = NULL;
  const double head[3] = {0, 0, 0};
  hf_joints_desc bones = HF_INIT(hf_joints_desc);
  bones.joint_count = 1;
  bones.heads = head;
  hf_weights_transfer_desc carry = HF_INIT(hf_weights_transfer_desc);
  hf_weights_mirror_desc mirror = HF_INIT(hf_weights_mirror_desc);
  hf_weights_out skin = HF_INIT(hf_weights_out);
  hf_flow flow = NULL;
  hf_transfer transfer = NULL;

  assert_ok(hf_surface_get_links(graph, 0, NULL, &number)); /* a graph has no links */
  assert_int_equal(number, 0);
  assert_ok(hf_surface_get_pieces(graph, 0, NULL, NULL, &number));
  assert_int_equal(number, VERTICES);
  assert_ok(hf_surface_measure_gaps(graph, &posed, 0, NULL, &gaps));
  assert_int_equal(gaps.link_count, 0);
  hf_solver peer = NULL;
  assert_ok(hf_peer_refactor_create(graph, NULL, &peer)); /* the baselines of solvers need no triangles */
  hf_solver_destroy(peer);
  if (has_gpl()) assert_ok(hf_peer_updown_create(graph, NULL, 0, &peer));
  if (has_gpl()) hf_solver_destroy(peer);
  NEEDS("a ray", NO_INDEX, hf_surface_cast_ray(graph, point, ray, NULL, &hit));
  NEEDS("the nearest vertex", NO_INDEX, hf_surface_find_vertex(graph, point, NULL, &number, &distance));
  NEEDS("other links", NO_INDEX, hf_surface_relink(graph, NULL, NULL, &relinked));
  NEEDS("levels", NO_INDEX, hf_surface_space_levels(graph, &scalars, HF_LEVELS_VALUE, 2, levels));
  NEEDS("iso-lines", NO_INDEX, hf_surface_trace_isolines(graph, &scalars, 1, &level, &lines));
  NEEDS("critical points", NO_INDEX, hf_surface_find_critical_points(graph, &scalars, 0, NULL, &critical));
  NEEDS("proposed handles", NO_INDEX, hf_surface_propose_handles(graph, NULL, 0, NULL, &number));
  NEEDS("extremities", NO_INDEX, hf_surface_find_extremities(graph, NULL, 0, NULL, &number));
  NEEDS("a pose", NO_INDEX, hf_pose_create(graph, NULL, &pose));
  NEEDS("a transfer of the paper", 0, hf_peer_transfer_create(graph, graph, NULL, &transfer));
  NEEDS("a pose of the paper", NO_INDEX, hf_peer_pose_create(graph, NULL, 0, &pose));
  NEEDS("a region", NO_INDEX, hf_region_create(graph, NULL, &region));
  NEEDS("a direction field", NO_INDEX, hf_direction_create(graph, NULL, &direction));
  NEEDS("distances", NO_INDEX, hf_geodesics_create(graph, NULL, &geodesics));
  NEEDS("quads", NO_INDEX, hf_quads_create(graph, NULL, &quads));
  NEEDS("skin weights", NO_INDEX, hf_weights_create(graph, &bones, 4, &weights));
  NEEDS("weights carried from a graph", NO_INDEX, hf_weights_transfer(graph, scene.body, &carry, &skin, NULL));
  NEEDS("weights carried to a graph", NO_INDEX, hf_weights_transfer(scene.body, graph, &carry, &skin, NULL));
  NEEDS("mirrored weights", NO_INDEX, hf_weights_mirror(graph, &mirror, &skin, NULL, NULL, NULL, NULL));
  NEEDS("streamlines", NO_INDEX, hf_flow_create(graph, &flow));
  NEEDS("a transfer from a graph", 0, hf_transfer_create(graph, scene.body, NULL, &transfer));
  NEEDS("a transfer to a graph", 1, hf_transfer_create(scene.body, graph, NULL, &transfer));
  assert_true(!pose && !region && !direction && !geodesics && !quads && !flow && !transfer && !weights);

  const uint32_t vertex[2] = {5, 1}, site = 0;
  const hf_place corners = {{0, 1, 2}, 0, {0.5, 0.25, 0.25}};
  const double origin[3] = {0, 0, 0}, radii[2] = {0, 0.5}, angle = 1;
  hf_sites_desc in_triangle = HF_INIT(hf_sites_desc), disc = HF_INIT(hf_sites_desc);
  in_triangle.site_count = 1;
  in_triangle.places = &corners;
  hf_sites_desc in_space = HF_INIT(hf_sites_desc);
  in_space.site_count = 1;
  in_space.points = origin;
  disc.site_count = 2;
  disc.vertices = vertex;
  disc.radii = radii;
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  edit.remove_count = 1;
  edit.remove_sites = &site;
  edit.add = &disc;
  const double screening[VERTICES] = {1};
  NEEDS("a point in a triangle", 0, hf_add_sites(solver, &in_triangle, NULL));
  NEEDS("a point in space", 0, hf_add_sites(solver, &in_space, NULL));
  NEEDS("a disc", 1, hf_add_sites(solver, &disc, NULL));
  NEEDS("a disc in a batch", 1, hf_solver_edit_sites(solver, &edit, NULL));
  NEEDS("a move into a triangle", 0, hf_solver_move_sites(solver, 1, &site, &in_triangle));
  NEEDS("vectors", NO_INDEX, hf_solver_solve_vectors(vectors, OUT(xyz_f32), NULL, NULL));
  NEEDS("vectors in double", NO_INDEX, hf_solver_solve_vectors(vectors, OUT(xyz), NULL, NULL));
  NEEDS("vectors that move", NO_INDEX, hf_solver_move_vectors(vectors, 1, &site, vertex));
  NEEDS("vectors that turn", NO_INDEX, hf_solver_rotate_vectors(vectors, 1, &site, &angle));
  ROW("screening", HF_ERROR_UNSUPPORTED, NO_INDEX, (void)0, hf_solver_set_screening(solver, screening, NULL));
  ROW("a site at a vertex without an edge", HF_ERROR_INVALID_ARGUMENT, 0, (void)0,
      hf_solver_add_site(solver, 7, NULL, NULL));
  ROW("a vertex beyond the graph", HF_ERROR_OUT_OF_RANGE, 0, (void)0, hf_solver_add_site(solver, VERTICES, NULL, NULL));
  hf_solver_destroy(solver);
  hf_solver_destroy(vectors);
  hf_surface_destroy(graph);
  scene_destroy(&scene);
  finish_rows("calls that need triangles");
}

/* Stiff vertices pull their edges: the field of a chain is the voltage along resistors in a row. */
static void graphs_take_a_stiffness(void** state) {
  (void)state;
  scene_create(&scene);
  make_graph_solvers();
  const uint32_t vertex[2] = {1, 7};
  const double stiffness[2] = {10, 10};
  double out[VERTICES], again[VERTICES];
  uint32_t count = 0;
  hf_surface_edit_desc edit = HF_INIT(hf_surface_edit_desc);
  edit.vertex_count = 2;
  edit.vertices = vertex;
  edit.stiffness = stiffness;
  hf_surface stiff = NULL;
  assert_ok(hf_surface_edit(graph, &edit, &stiff));
  assert_ok(hf_surface_get_stiffness(stiff, VERTICES, out, &count));
  assert_true(count == VERTICES && out[1] == 10 && out[0] == 1 && out[7] == 1);
  assert_ok(hf_solver_solve(solver, OUT(out), NULL));
  assert_ok(hf_solver_move_to(solver, stiff));
  assert_ok(hf_solver_move_to(solver, graph));
  assert_ok(hf_solver_solve(solver, OUT(again), NULL));
  for (int v = 0; v < VERTICES; ++v) assert_float_equal(again[v], out[v], 1e-12);
  hf_pose none = NULL;
  assert_code(HF_ERROR_INVALID_OBJECT, hf_pose_move_to(none, stiff));
  assert_ok(hf_surface_get_cuts(graph, 0, NULL, &count));
  assert_int_equal(count, 0);
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.cut_edge_count = 1;
  patch.cut_edges = vertex;
  edit = HF_INIT(hf_surface_edit_desc);
  edit.patch = &patch;
  hf_surface cut = NULL;
  assert_code(HF_ERROR_UNSUPPORTED, hf_surface_edit(graph, &edit, &cut));
  hf_cut_desc knife = HF_INIT(hf_cut_desc);
  knife.point_count = 2;
  knife.vertices = vertex;
  hf_cut traced = HF_INIT(hf_cut);
  assert_code(HF_ERROR_UNSUPPORTED, hf_surface_trace_cut(graph, &knife, &traced));
  hf_surface_destroy(stiff);
  hf_solver_destroy(solver);
  hf_solver_destroy(vectors);
  hf_surface_destroy(graph);
  scene_destroy(&scene);
}

static void surfaces_of_graphs_do_all_else(void** state) {
  (void)state;
  scene_create(&scene);
  make_graph_solvers();
  hf_surface_info info = HF_INIT(hf_surface_info);
  hf_surface_report report = HF_INIT(hf_surface_report);
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  uint32_t components[VERTICES], count = 0, site = 0, other = 1;
  size_t size = 0;
  assert_ok(hf_surface_get_info(graph, &info));
  assert_int_equal(info.operator_kind, HF_OPERATOR_GRAPH);
  assert_int_equal(info.weld, HF_WELD_NONE);
  assert_true(info.vertex_count == VERTICES && info.edge_count == EDGES && info.triangle_count == 0);
  assert_ok(hf_surface_get_report(graph, &report));
  hf_mesh_statistics mesh = HF_INIT(hf_mesh_statistics);
  hf_links_info links = HF_INIT(hf_links_info);
  assert_ok(hf_surface_get_mesh_statistics(graph, &mesh));
  assert_ok(hf_surface_get_links_info(graph, &links));
  assert_int_equal(mesh.polygon_count + mesh.negative_edge_count + mesh.changed_vertex_count, 0);
  assert_int_equal(links.link_count, 0);
  assert_true(report.component_count == 2 && report.isolated_vertex_count == 1 && report.triangle_count == 0);
  assert_true(report.welded_vertex_count == VERTICES && report.boundary_edge_count == 0);
  assert_ok(hf_surface_get_components(graph, VERTICES, components, &count));
  assert_true(count == VERTICES && components[3] == 0 && components[4] == 1 && components[7] == HF_NO_INDEX);
  assert_ok(hf_surface_get_statistics(graph, &statistics));
  assert_int_equal(statistics.unknown_count, 7);
  assert_ok(hf_surface_save(graph, HF_FIELD_BIHARMONIC, NULL, 0, NULL, &size));

  float field[VERTICES];
  double values[2], field_f64[VERTICES];
  const uint32_t asked[2] = {7, 1};
  hf_solve_info solved = HF_INIT(hf_solve_info);
  hf_preview_info preview = HF_INIT(hf_preview_info);
  hf_certificate certificate = HF_INIT(hf_certificate);
  hf_solver_info options = HF_INIT(hf_solver_info);
  hf_solver_statistics counts = HF_INIT(hf_solver_statistics);
  hf_sites_info sites = HF_INIT(hf_sites_info);
  assert_ok(hf_solve(solver, field, 0, &solved));
  assert_true(solved.unreached_component_count == 1 && solved.first_unreached_component == 1);
  assert_int_equal(solved.unreached_vertex_count, 4); /* the second square and the vertex without an edge */
  assert_ok(hf_solver_solve_at(solver, 2, asked, values));
  assert_true(values[0] == 0 && values[1] == before[1]);
  assert_ok(hf_solver_solve_preview(solver, OUT(field), 1, &preview));
  assert_ok(hf_solver_solve_preview(solver, OUT(field_f64), 2, &preview));
  assert_ok(hf_solver_release_preview(solver));
  assert_ok(hf_solver_certify(solver, &certificate));
  assert_int_equal(certificate.overshoot_checked, 1);
  assert_ok(hf_solver_get_info(solver, &options));
  assert_ok(hf_solver_get_statistics(solver, &counts));
  assert_ok(hf_solver_get_sites(solver, &sites));
  assert_int_equal(sites.count, 2);

  hf_solver copy = NULL;
  assert_ok(hf_solver_clone(solver, &copy));
  hf_sites_desc to = HF_INIT(hf_sites_desc);
  const uint32_t place = 5;
  to.site_count = 1;
  to.vertices = &place;
  const double value = 3;
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  edit.set_count = 1;
  edit.set_sites = &other;
  edit.set_values = &value;
  assert_ok(hf_solver_move_sites(copy, 1, &site, &to));
  assert_ok(hf_solver_set_values(copy, 1, &site, &value));
  assert_ok(hf_solver_edit_sites(copy, &edit, NULL));
  assert_ok(hf_solver_prepare_rebase(copy));
  assert_ok(hf_remove_sites(copy, 1, &other));
  assert_ok(hf_solver_solve(solver, OUT(field_f64), NULL));
  assert_true(same_bits(field_f64, before, sizeof before));
  assert_int_equal(hf_solver_get_site_count(solver), 2);
  hf_solver_destroy(copy);
  assert_true(field_unchanged());
  hf_solver_destroy(solver);
  hf_solver_destroy(vectors);
  hf_surface_destroy(graph);
  assert_int_equal(counter.live_blocks, 0);
  scene_destroy(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hf_surface_create_graph_refuses_bad_graphs),
      cmocka_unit_test(hf_surface_create_graph_refuses_bad_options),
      cmocka_unit_test(hf_surface_create_graph_survives_every_refused_allocation),
      cmocka_unit_test(surfaces_of_graphs_refuse_what_needs_triangles),
      cmocka_unit_test(surfaces_of_graphs_do_all_else),
      cmocka_unit_test(graphs_take_a_stiffness),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
