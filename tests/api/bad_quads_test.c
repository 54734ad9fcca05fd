/* Bad input to quads and streamlines, foreign handles to them and to regions, and what is no handle to every destroy
 * and every count. */
#include "bad_scene.h"

static Surface tube;
static hf_surface surface;
static hf_solver solver;
static hf_quads quads;
static hf_flow flow;
static hf_region region;
static double height[TUBE_VERTICES], positions[3 * TUBE_VERTICES];
static uint32_t numbers[TUBE_VERTICES];

static void setup_surface(void) {
  tube = surface_tube(TUBE_AROUND, TUBE_RINGS);
  surface = surface_on(&tube);
  solver = solver_on(surface);
  for (int v = 0; v < TUBE_VERTICES; ++v) height[v] = (double)tube.positions[3 * v + 1] + 0.01 * sin(2.3 * v);
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.edge_length = 2;
  desc.relax_count = 2;
  assert_ok(hf_quads_create(surface, &desc, &quads));
  assert_ok(hf_flow_create(surface, &flow));
  assert_ok(hf_region_create(surface, NULL, &region));
}

static void teardown_surface(void) {
  hf_quads_destroy(quads);
  hf_flow_destroy(flow);
  hf_region_destroy(region);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&tube);
}

/* One call per function, everything but the handle in order. */
static hf_result quads_create(void* h) {
  hf_quads out;
  return hf_quads_create(h, NULL, &out);
}
static hf_result quads_update(void* h) {
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  return hf_quads_update(h, &desc);
}
static hf_result quads_get_info(void* h) {
  hf_quads_info info = HF_INIT(hf_quads_info);
  return hf_quads_get_info(h, &info);
}
static hf_result quads_get_mesh(void* h) {
  hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
  return hf_quads_get_mesh(h, &mesh);
}
static hf_result flow_create(void* h) {
  hf_flow out;
  return hf_flow_create(h, &out);
}
static hf_result flow_trace(void* h) {
  const hf_array field = HF_ARRAY(height, TUBE_VERTICES);
  hf_streamlines lines = HF_INIT(hf_streamlines);
  lines.wanted_count = 4;
  return hf_flow_trace(h, &field, &lines);
}
static hf_result region_get_info(void* h) {
  hf_region_info info = HF_INIT(hf_region_info);
  return hf_region_get_info(h, &info);
}
static hf_result region_get_statistics(void* h) {
  hf_region_statistics statistics = HF_INIT(hf_region_statistics);
  return hf_region_get_statistics(h, &statistics);
}
static hf_result region_get_vertices(void* h) {
  return hf_region_get_vertices(h, HF_REGION_INSIDE, TUBE_VERTICES, numbers, NULL);
}
static hf_result region_get_curve(void* h) {
  uint32_t count = 0;
  return hf_region_get_curve(h, 0, NULL, &count);
}
static hf_result detail_morph(void* h) {
  hf_morph_desc desc = HF_INIT(hf_morph_desc);
  desc.positions = ROWS_OUT(positions);
  return hf_detail_morph(h, &desc);
}

static void quads_flow_and_regions_refuse_every_handle_that_is_not_their_own(void** state) {
  (void)state;
  setup_surface();
  hf_quads stale = NULL;
  assert_ok(hf_quads_create(surface, NULL, &stale));
  hf_quads_destroy(stale);
  int on_the_stack = 0;
  const struct {
    const char* function;
    hf_result (*call)(void*);
    void* own;
  } functions[] = {{"hf_quads_create", quads_create, surface},
                   {"hf_quads_update", quads_update, quads},
                   {"hf_quads_get_info", quads_get_info, quads},
                   {"hf_quads_get_mesh", quads_get_mesh, quads},
                   {"hf_flow_create", flow_create, surface},
                   {"hf_flow_trace", flow_trace, flow},
                   {"hf_region_get_statistics", region_get_statistics, region},
                   {"hf_region_get_info", region_get_info, region},
                   {"hf_region_get_vertices", region_get_vertices, region},
                   {"hf_region_get_curve", region_get_curve, region},
                   {"hf_detail_morph", detail_morph, &stale}};
  void* const bad[] = {
      NULL, (void*)UINTPTR_MAX, (void*)(uintptr_t)1, &on_the_stack, stale, surface, solver, quads, flow, region};
  for (size_t f = 0; f < COUNT_OF(functions); ++f) {
    for (size_t b = 0; b < COUNT_OF(bad); ++b) {
      if (bad[b] == functions[f].own) continue;
      check_row(__LINE__, "a handle of another kind", functions[f].function, functions[f].call(bad[b]),
                HF_ERROR_INVALID_OBJECT, NO_INDEX);
    }
  }
  finish_rows("handles of quads, flow and regions");
  teardown_surface();
}

static hf_quads_desc good_quads;
static hf_quads made;
static const uint32_t two_vertices[2] = {0, TUBE_VERTICES - 1};
static void refresh_quads(void) {
  good_quads = HF_INIT(hf_quads_desc);
  good_quads.edge_length = 2;
  good_quads.relax_count = 2;
  made = (hf_quads)(uintptr_t)5;
}
static double sum_before;
static double sum_of_quads(void) {
  hf_quads_info info = HF_INIT(hf_quads_info);
  assert_ok(hf_quads_get_info(quads, &info));
  double* all = calloc(info.vertex_count, 3 * sizeof *all);
  hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
  mesh.vertex_capacity = info.vertex_count;
  mesh.positions = all;
  assert_ok(hf_quads_get_mesh(quads, &mesh));
  double sum = info.face_count;
  for (uint32_t i = 0; i < 3 * info.vertex_count; ++i) sum += (i % 7 + 1) * all[i];
  free(all);
  return sum;
}
#define GOOD() refresh_quads()
#define UNCHANGED() (made == NULL)

static void quads_refuse_bad_descs(void** state) {
  (void)state;
  setup_surface();
  const uint32_t outside[2] = {3, TUBE_VERTICES};
  ROW("edge length below 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.edge_length = -1,
      hf_quads_create(surface, &good_quads, &made));
  ROW("edge length NaN", HF_ERROR_NON_FINITE, NO_INDEX, good_quads.edge_length = NAN,
      hf_quads_create(surface, &good_quads, &made));
  ROW("edge length infinite", HF_ERROR_NON_FINITE, NO_INDEX, good_quads.edge_length = INFINITY,
      hf_quads_create(surface, &good_quads, &made));
  ROW("rounds of relaxation", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.relax_count = 1001,
      hf_quads_create(surface, &good_quads, &made));
  ROW("crease angle NaN", HF_ERROR_NON_FINITE, NO_INDEX, good_quads.crease_angle = NAN,
      hf_quads_create(surface, &good_quads, &made));
  ROW("crease angle above pi", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.crease_angle = 3.15,
      hf_quads_create(surface, &good_quads, &made));
  ROW("crease angle below 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.crease_angle = -1,
      hf_quads_create(surface, &good_quads, &made));
#define GUIDES good_quads.guide_count = 2, good_quads.guide_vertices = two_vertices, good_quads.guide_vectors = along
  const uint32_t across[2] = {0, TUBE_VERTICES - 1}, beyond[4] = {0, 1, 0, TUBE_VERTICES}, point[2] = {3, 3};
  const double along[6] = {1, 2, 3, 3, 2, 1}, nowhere[6] = {1, 2, 3, 0, 0, 0}, nan_vector[6] = {1, 2, 3, NAN, 0, 0};
  const float heavy[2] = {1, 1.5f}, weightless[2] = {0, 1}, nan_weight[2] = {1, NAN};
  ROW("crease edges without a count", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.crease_edges = beyond,
      hf_quads_create(surface, &good_quads, &made));
  ROW("crease edges without a list", HF_ERROR_NULL_POINTER, NO_INDEX, good_quads.crease_count = 1,
      hf_quads_create(surface, &good_quads, &made));
  ROW("more crease edges than edges", HF_ERROR_TOO_LARGE, NO_INDEX,
      (good_quads.crease_count = 1000000, good_quads.crease_edges = beyond),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a crease edge outside", HF_ERROR_OUT_OF_RANGE, 1,
      (good_quads.crease_count = 2, good_quads.crease_edges = beyond), hf_quads_create(surface, &good_quads, &made));
  ROW("a crease edge that is none", HF_ERROR_INVALID_ARGUMENT, 0,
      (good_quads.crease_count = 1, good_quads.crease_edges = across), hf_quads_create(surface, &good_quads, &made));
  ROW("a crease edge from a vertex to itself", HF_ERROR_INVALID_ARGUMENT, 0,
      (good_quads.crease_count = 1, good_quads.crease_edges = point), hf_quads_create(surface, &good_quads, &made));
  ROW("guides without a count", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.guide_vectors = along,
      hf_quads_create(surface, &good_quads, &made));
  ROW("guides without vertices", HF_ERROR_NULL_POINTER, NO_INDEX, (GUIDES, good_quads.guide_vertices = NULL),
      hf_quads_create(surface, &good_quads, &made));
  ROW("guides without vectors", HF_ERROR_NULL_POINTER, NO_INDEX, (GUIDES, good_quads.guide_vectors = NULL),
      hf_quads_create(surface, &good_quads, &made));
  ROW("guides beyond any mesh", HF_ERROR_TOO_LARGE, NO_INDEX, (GUIDES, good_quads.guide_count = 0x80000000u),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a guide outside", HF_ERROR_OUT_OF_RANGE, 1, (GUIDES, good_quads.guide_vertices = outside),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a guide without direction", HF_ERROR_INVALID_ARGUMENT, 1, (GUIDES, good_quads.guide_vectors = nowhere),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a guide that is NaN", HF_ERROR_NON_FINITE, 1, (GUIDES, good_quads.guide_vectors = nan_vector),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a weight above 1", HF_ERROR_INVALID_ARGUMENT, 1, (GUIDES, good_quads.guide_weights = heavy),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a weight of 0", HF_ERROR_INVALID_ARGUMENT, 0, (GUIDES, good_quads.guide_weights = weightless),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a weight that is NaN", HF_ERROR_NON_FINITE, 1, (GUIDES, good_quads.guide_weights = nan_weight),
      hf_quads_create(surface, &good_quads, &made));
  const double places[6] = {0, 0, 0, 0.1, 0.1, 0}, nan_place[6] = {0, 0, 0, 0, NAN, 0},
               far_place[6] = {0, 0, 0, 1e155, 0, 0};
  const uint32_t three_five[2] = {3, 5}, three_four[2] = {3, 4};
#define POLES \
  good_quads.irregular_count = 2, good_quads.irregular_points = places, good_quads.irregular_valences = three_five
  ROW("poles without a count", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.irregular_points = places,
      hf_quads_create(surface, &good_quads, &made));
  ROW("poles without points", HF_ERROR_NULL_POINTER, NO_INDEX, (POLES, good_quads.irregular_points = NULL),
      hf_quads_create(surface, &good_quads, &made));
  ROW("poles without quads", HF_ERROR_NULL_POINTER, NO_INDEX, (POLES, good_quads.irregular_valences = NULL),
      hf_quads_create(surface, &good_quads, &made));
  ROW("more than 1,000 poles", HF_ERROR_TOO_LARGE, NO_INDEX, (POLES, good_quads.irregular_count = 1001),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a pole of four quads", HF_ERROR_INVALID_ARGUMENT, 1, (POLES, good_quads.irregular_valences = three_four),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a pole that is NaN", HF_ERROR_NON_FINITE, 1, (POLES, good_quads.irregular_points = nan_place),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a pole far away", HF_ERROR_TOO_LARGE, 1, (POLES, good_quads.irregular_points = far_place),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a direction of a pole that is NaN", HF_ERROR_NON_FINITE, 1, (POLES, good_quads.irregular_directions = nan_place),
      hf_quads_create(surface, &good_quads, &made));
  ROW("a plane that is infinite", HF_ERROR_NON_FINITE, NO_INDEX, good_quads.symmetry_plane[2] = INFINITY,
      hf_quads_create(surface, &good_quads, &made));
  ROW("a plane without a normal", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.symmetry_plane[3] = 1,
      hf_quads_create(surface, &good_quads, &made));
  ROW("a plane beside the surface", HF_ERROR_UNSUPPORTED, 5,
      (good_quads.symmetry_plane[0] = 1, good_quads.symmetry_plane[3] = 1e6),
      hf_quads_create(surface, &good_quads, &made));
  ROW("too many faces", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_quads.face_count = 10000001,
      hf_quads_create(surface, &good_quads, &made));
  ROW("struct_size 0", HF_ERROR_INVALID_DESC, NO_INDEX, good_quads.struct_size = 0,
      hf_quads_create(surface, &good_quads, &made));
  ROW("struct_size 3", HF_ERROR_INVALID_DESC, NO_INDEX, good_quads.struct_size = 3,
      hf_quads_create(surface, &good_quads, &made));
  ROW("a progress object that is none", HF_ERROR_INVALID_OBJECT, NO_INDEX,
      good_quads.progress = (hf_progress)(void*)solver, hf_quads_create(surface, &good_quads, &made));
#undef UNCHANGED
#define UNCHANGED() 1
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_quads_create(surface, &good_quads, NULL));
  sum_before = sum_of_quads();
#undef UNCHANGED
#define UNCHANGED() (sum_of_quads() == sum_before)
  ROW("no desc", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_quads_update(quads, NULL));
  ROW("a pole count without poles", HF_ERROR_NULL_POINTER, NO_INDEX, good_quads.irregular_count = 1,
      hf_quads_update(quads, &good_quads));
  ROW("struct_size 3", HF_ERROR_INVALID_DESC, NO_INDEX, good_quads.struct_size = 3,
      hf_quads_update(quads, &good_quads));
  ROW("edge length NaN", HF_ERROR_NON_FINITE, NO_INDEX, good_quads.edge_length = NAN,
      hf_quads_update(quads, &good_quads));
  ROW("a crease edge outside", HF_ERROR_OUT_OF_RANGE, 1,
      (good_quads.crease_count = 2, good_quads.crease_edges = beyond), hf_quads_update(quads, &good_quads));
  ROW("a guide that is NaN", HF_ERROR_NON_FINITE, 1, (GUIDES, good_quads.guide_vectors = nan_vector),
      hf_quads_update(quads, &good_quads));
  ROW("a plane beside the surface", HF_ERROR_UNSUPPORTED, 5,
      (good_quads.symmetry_plane[0] = 1, good_quads.symmetry_plane[3] = 1e6), hf_quads_update(quads, &good_quads));
  ROW("a progress object that is none", HF_ERROR_INVALID_OBJECT, NO_INDEX,
      good_quads.progress = (hf_progress)(void*)solver, hf_quads_update(quads, &good_quads));
#undef GUIDES
#undef UNCHANGED
#define UNCHANGED() 1
  hf_quads_info info = HF_INIT(hf_quads_info);
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_quads_get_info(quads, NULL));
  ROW("struct_size 0", HF_ERROR_INVALID_DESC, NO_INDEX, info.struct_size = 0, hf_quads_get_info(quads, &info));
  hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_quads_get_mesh(quads, NULL));
  ROW("no room", HF_ERROR_TOO_SMALL, NO_INDEX, (mesh.positions = positions, mesh.vertex_capacity = 1),
      hf_quads_get_mesh(quads, &mesh));
  mesh = HF_INIT(hf_quads_mesh);
  ROW("no room for faces", HF_ERROR_TOO_SMALL, NO_INDEX, (mesh.faces = numbers, mesh.face_capacity = 1),
      hf_quads_get_mesh(quads, &mesh));
  ROW("struct_size 0", HF_ERROR_INVALID_DESC, NO_INDEX, mesh.struct_size = 0, hf_quads_get_mesh(quads, &mesh));
  finish_rows("quads");
  teardown_surface();
}

static hf_array good_field;
static hf_streamlines good_lines;
static void refresh_flow(void) {
  good_field = HF_ARRAY(height, TUBE_VERTICES);
  good_lines = HF_INIT(hf_streamlines);
  good_lines.wanted_count = 4;
}
#undef GOOD
#define GOOD() refresh_flow()

static void flow_lines_refuse_bad_input(void** state) {
  (void)state;
  setup_surface();
  double broken[TUBE_VERTICES];
  memcpy(broken, height, sizeof broken);
  broken[33] = NAN;
  const uint32_t outside[2] = {3, TUBE_VERTICES};
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_flow_create(surface, NULL));
  ROW("no lines wanted", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_lines.wanted_count = 0,
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("too many lines wanted", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_lines.wanted_count = 1000001,
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("no field", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_flow_trace(flow, NULL, &good_lines));
  ROW("no values", HF_ERROR_NULL_POINTER, NO_INDEX, good_field.data = NULL,
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("a value too few", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, good_field.count = TUBE_VERTICES - 1,
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("a value that is none", HF_ERROR_NON_FINITE, 33, good_field.data = broken,
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("stride", HF_ERROR_TOO_SMALL, NO_INDEX, good_field.stride = 4, hf_flow_trace(flow, &good_field, &good_lines));
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_flow_trace(flow, &good_field, NULL));
  ROW("reserved of the field", HF_ERROR_INVALID_DESC, NO_INDEX, good_field.reserved = 1,
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("struct_size of the lines", HF_ERROR_INVALID_DESC, NO_INDEX, good_lines.struct_size = 1,
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("seeds without a list", HF_ERROR_NULL_POINTER, NO_INDEX, good_lines.seed_count = 2,
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("a seed outside", HF_ERROR_OUT_OF_RANGE, 1, (good_lines.seed_count = 2, good_lines.seeds = outside),
      hf_flow_trace(flow, &good_field, &good_lines));
  ROW("no room", HF_ERROR_TOO_SMALL, NO_INDEX, (good_lines.positions = positions, good_lines.point_capacity = 1),
      hf_flow_trace(flow, &good_field, &good_lines));
  finish_rows("streamlines");
  teardown_surface();
}

/* Functions that answer nothing, or a number: a row each for what is no handle. */
static void what_is_no_handle_is_ignored_by_every_destroy_and_counts_as_nothing(void** state) {
  (void)state;
  setup_surface();
  int on_the_stack = 0;
  hf_solver gone = surface_solver(&tube);
  hf_solver_destroy(gone);
  void* const bad[] = {NULL, (void*)UINTPTR_MAX, (void*)(uintptr_t)1, &on_the_stack, gone};
#define NOTHING_HAPPENS(function)                                                                     \
  do {                                                                                                \
    for (size_t b = 0; b < COUNT_OF(bad); ++b) {                                                      \
      function(bad[b]);                                                                               \
      row_holds(__LINE__, #function, "the live objects go on",                                        \
                hf_solver_get_site_count(solver) == 0 && hf_solver_release_preview(solver) == HF_OK); \
    }                                                                                                 \
  } while (0)
  NOTHING_HAPPENS(hf_surface_destroy);
  NOTHING_HAPPENS(hf_solver_destroy);
  NOTHING_HAPPENS(hf_pose_destroy);
  NOTHING_HAPPENS(hf_transfer_destroy);
  NOTHING_HAPPENS(hf_progress_destroy);
  NOTHING_HAPPENS(hf_geodesics_destroy);
  NOTHING_HAPPENS(hf_direction_destroy);
  NOTHING_HAPPENS(hf_quads_destroy);
  NOTHING_HAPPENS(hf_flow_destroy);
  NOTHING_HAPPENS(hf_region_destroy);
  NOTHING_HAPPENS(hf_detail_destroy);
  NOTHING_HAPPENS(hf_weights_destroy);
#define COUNTS_NOTHING(function)                                               \
  do {                                                                         \
    for (size_t b = 0; b < COUNT_OF(bad); ++b) {                               \
      row_holds(__LINE__, #function, "the count is 0", function(bad[b]) == 0); \
    }                                                                          \
  } while (0)
  COUNTS_NOTHING(hf_solver_get_site_count);
  COUNTS_NOTHING(hf_pose_get_handle_count);
  COUNTS_NOTHING(hf_direction_get_site_count);
  check_row(__LINE__, "no output", "hf_progress_create", hf_progress_create(NULL), HF_ERROR_NULL_POINTER, NO_INDEX);
  row_holds(__LINE__, "hf_error_get_detail", "no output is named", hf_error_get_detail(NULL) == HF_ERROR_NULL_POINTER);
  row_holds(__LINE__, "hf_result_get_name", "no such code is unknown",
            strcmp(hf_result_get_name(12345), "unknown") == 0);
  finish_rows("destroys and counts");
  teardown_surface();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(quads_flow_and_regions_refuse_every_handle_that_is_not_their_own),
      cmocka_unit_test(quads_refuse_bad_descs),
      cmocka_unit_test(flow_lines_refuse_bad_input),
      cmocka_unit_test(what_is_no_handle_is_ignored_by_every_destroy_and_counts_as_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
