/* Bad input to hf/base.h and hf/surface.h: one thing wrong per row. After a failed hf_surface_create nothing exists. */
#include "bad_scene.h"

static Scene scene;
static CountingAllocator counter;

/* The good input: a copy of the cut sheet that a row may spoil. */
static hf_surface_desc desc;
static hf_faces_desc faces;
static hf_solver_desc solver_desc;
static float positions[3 * CUT_VERTICES];
static double positions_f64[3 * CUT_VERTICES];
static uint32_t triangles[3 * CUT_TRIANGLES];
static uint16_t triangles_u16[3 * CUT_TRIANGLES];
static uint64_t triangles_u64[3 * CUT_TRIANGLES];
static uint32_t face_starts[CUT_TRIANGLES + 1], face_sizes[CUT_TRIANGLES];
static hf_surface out;
static hf_solver out_solver;

static void good_input(void) {
  memcpy(positions, scene.cut.positions, sizeof positions);
  memcpy(triangles, scene.cut.triangles, sizeof triangles);
  for (size_t i = 0; i < 3 * CUT_VERTICES; ++i) positions_f64[i] = (double)positions[i];
  desc = options_of(&scene.cut).surface;
  solver_desc = HF_INIT(hf_solver_desc);
  desc.positions = HF_ARRAY(positions, CUT_VERTICES);
  desc.triangles = HF_ARRAY(triangles, CUT_TRIANGLES);
  desc.allocator = counting_hooks(&counter);
  for (size_t i = 0; i < 3 * CUT_TRIANGLES; ++i) triangles_u16[i] = (uint16_t)triangles[i];
  for (uint32_t i = 0; i <= CUT_TRIANGLES; ++i) face_starts[i] = 3 * i;
  for (size_t i = 0; i < CUT_TRIANGLES; ++i) face_sizes[i] = 3;
  out = scene.sheet;
  out_solver = scene.solver; /* must become NULL */
}
static int nothing_exists(void) {
  return out == NULL && counter.live_blocks == 0 && counter.mismatches == 0 && solver_unchanged(&scene);
}

#define GOOD good_input
#define UNCHANGED nothing_exists
#define CREATE(what, expected, index, change) ROW(what, expected, index, change, hf_surface_create(&desc, &out))

static void no_position_array(void) { desc.positions.data = NULL; }
static void in_double(void) { desc.positions = HF_ARRAY(positions_f64, CUT_VERTICES); }

static void in_64_bits(void) {
  for (size_t i = 0; i < 3 * CUT_TRIANGLES; ++i) triangles_u64[i] = triangles[i];
}

static void in_16_bits(void) { desc.triangles = HF_ARRAY(triangles_u16, CUT_TRIANGLES); }

static void in_sizes(void) {
  desc.triangles = (hf_array){0};
  faces = HF_INIT(hf_faces_desc);
  faces.sizes = HF_ARRAY(face_sizes, CUT_TRIANGLES);
  faces.corners = HF_ARRAY(triangles, 3 * CUT_TRIANGLES);
  desc.faces = &faces;
}
static void in_offsets(void) {
  in_sizes();
  faces.sizes = (hf_array){0};
  faces.starts = HF_ARRAY(face_starts, CUT_TRIANGLES + 1);
}
static void in_loops(void) {
  in_sizes();
  faces.starts = HF_ARRAY(face_starts, CUT_TRIANGLES);
}

static void hf_surface_create_refuses_bad_faces(void** state) {
  (void)state;
  scene_create(&scene);
  good_input();
  in_offsets();
  assert_ok(hf_surface_create(&desc, &out)); /* the good faces are good */
  hf_surface_destroy(out);
  out = NULL;
  assert_true(nothing_exists());

  CREATE("faces and triangles", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (in_sizes(), desc.triangles = HF_ARRAY(triangles, CUT_TRIANGLES)));
  CREATE("faces and 16-bit triangles", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (in_sizes(), in_16_bits()));
  CREATE("faces and a triangle count", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (in_sizes(), desc.triangles.count = 1));
  CREATE("no offset", HF_ERROR_EMPTY, NO_INDEX, (in_offsets(), faces.starts.count = 0));
  CREATE("one offset", HF_ERROR_EMPTY, NO_INDEX, (in_offsets(), faces.starts.count = 1));
  CREATE("no size", HF_ERROR_EMPTY, NO_INDEX, (in_sizes(), faces.sizes.count = 0));
  CREATE("starts of other faces", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (in_loops(), faces.starts.count += 1));
  CREATE("sizes in 16 bits", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (in_sizes(), faces.sizes.type = HF_TYPE_UINT16));
  CREATE("faces of another size", HF_ERROR_INVALID_DESC, NO_INDEX, (in_sizes(), faces.struct_size = 4));
  CREATE("faces with reserved set", HF_ERROR_INVALID_DESC, NO_INDEX, (in_sizes(), faces.reserved = 1));
  CREATE("no starts and no sizes", HF_ERROR_NULL_POINTER, NO_INDEX, (in_sizes(), faces.sizes = (hf_array){0}));
  CREATE("no corners", HF_ERROR_NULL_POINTER, NO_INDEX, (in_sizes(), faces.corners = (hf_array){0}));
  CREATE("face stride below an entry", HF_ERROR_TOO_SMALL, NO_INDEX, (in_sizes(), faces.sizes.stride = 3));
  CREATE("corner stride below an entry", HF_ERROR_TOO_SMALL, NO_INDEX, (in_sizes(), faces.corners.stride = 1));
  CREATE("a face of two corners", HF_ERROR_INVALID_ARGUMENT, 5, (in_sizes(), face_sizes[5] = 2));
  CREATE("a face of no corner", HF_ERROR_INVALID_ARGUMENT, 72, (in_loops(), face_sizes[72] = 0));
  CREATE("offsets that stay", HF_ERROR_INVALID_ARGUMENT, 7, (in_offsets(), face_starts[8] = face_starts[7]));
  CREATE("offsets that go back", HF_ERROR_INVALID_ARGUMENT, 9, (in_offsets(), face_starts[10] = 0));
  CREATE("a face of too many corners", HF_ERROR_TOO_LARGE, 3, (in_sizes(), face_sizes[3] = 65536));
  CREATE("a face of 2^32 - 1 corners", HF_ERROR_TOO_LARGE, 0, (in_loops(), face_sizes[0] = UINT32_MAX));
  CREATE("an offset of 2^32 - 1", HF_ERROR_TOO_LARGE, 72, (in_offsets(), face_starts[CUT_TRIANGLES] = UINT32_MAX));
  CREATE("a corner beyond corner_count", HF_ERROR_OUT_OF_RANGE, 72, (in_sizes(), faces.corners.count -= 1));
  CREATE("a start beyond corner_count", HF_ERROR_OUT_OF_RANGE, 4, (in_loops(), face_starts[4] = UINT32_MAX));
  CREATE("corner_count 0", HF_ERROR_OUT_OF_RANGE, 0, (in_sizes(), faces.corners.count = 0));
  CREATE("corner = vertex_count", HF_ERROR_OUT_OF_RANGE, 24, (in_sizes(), triangles[3 * 24] = CUT_VERTICES));
  CREATE("corner UINT32_MAX", HF_ERROR_OUT_OF_RANGE, 7, (in_loops(), triangles[3 * 7 + 2] = UINT32_MAX));
  CREATE("every face collapses", HF_ERROR_EMPTY, NO_INDEX, (in_sizes(), memset(triangles, 0, sizeof triangles)));
  CREATE("faces of a limit of 1", HF_ERROR_TOO_LARGE, NO_INDEX, (in_sizes(), desc.triangle_limit = 1));

  scene_destroy(&scene);
  finish_rows("faces");
}

static void hf_surface_create_refuses_bad_meshes(void** state) {
  (void)state;
  scene_create(&scene);
  good_input();
  assert_ok(hf_surface_create(&desc, &out)); /* the good input is good */
  hf_surface_destroy(out);
  out = NULL;
  assert_true(nothing_exists());

  CREATE("no vertices", HF_ERROR_EMPTY, NO_INDEX, desc.positions.count = 0);
  CREATE("no triangles", HF_ERROR_EMPTY, NO_INDEX, desc.triangles.count = 0);
  CREATE("no positions", HF_ERROR_NULL_POINTER, NO_INDEX, no_position_array());
  CREATE("no triangle array", HF_ERROR_NULL_POINTER, NO_INDEX, desc.triangles.data = NULL);
  CREATE("stride below a row", HF_ERROR_TOO_SMALL, NO_INDEX, desc.positions.stride = 11);
  CREATE("stride of one byte", HF_ERROR_TOO_SMALL, NO_INDEX, desc.positions.stride = 1);
  CREATE("stride of floats for doubles", HF_ERROR_TOO_SMALL, NO_INDEX, (in_double(), desc.positions.stride = 12));

  CREATE("triangle stride below a row", HF_ERROR_TOO_SMALL, NO_INDEX, desc.triangles.stride = 11);
  CREATE("triangle stride of one byte", HF_ERROR_TOO_SMALL, NO_INDEX, desc.triangles.stride = 1);
  CREATE("16-bit triangle stride below a row", HF_ERROR_TOO_SMALL, NO_INDEX, (in_16_bits(), desc.triangles.stride = 5));
  CREATE("32-bit indices as 16-bit ones", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (in_16_bits(), desc.triangles.data = triangles));
  CREATE("64-bit indices as 32-bit ones", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (in_64_bits(), desc.triangles.data = triangles_u64));
  CREATE("16-bit corner = vertex_count", HF_ERROR_OUT_OF_RANGE, 5, (in_16_bits(), triangles_u16[16] = CUT_VERTICES));
  CREATE("16-bit corner 2^16 - 1", HF_ERROR_OUT_OF_RANGE, 72, (in_16_bits(), triangles_u16[3 * 72] = UINT16_MAX));

  CREATE("corner = vertex_count", HF_ERROR_OUT_OF_RANGE, 0, triangles[0] = CUT_VERTICES);
  CREATE("corner UINT32_MAX", HF_ERROR_OUT_OF_RANGE, 7, triangles[3 * 7 + 2] = UINT32_MAX);
  CREATE("corner 2^31", HF_ERROR_OUT_OF_RANGE, 72, triangles[3 * 72 + 1] = 0x80000000u);
  CREATE("vertex_count one too small", HF_ERROR_OUT_OF_RANGE, 64, desc.positions.count = 50);
  CREATE("NaN", HF_ERROR_NON_FINITE, 3, positions[9] = (float)NAN);
  CREATE("infinity", HF_ERROR_NON_FINITE, 0, positions[2] = (float)INFINITY);
  CREATE("minus infinity", HF_ERROR_NON_FINITE, 49, positions[3 * 49 + 1] = -(float)INFINITY);
  CREATE("NaN in an isolated vertex", HF_ERROR_NON_FINITE, CUT_ISOLATED, positions[3 * CUT_ISOLATED] = (float)NAN);
  CREATE("NaN in double", HF_ERROR_NON_FINITE, 12, (in_double(), positions_f64[36] = (double)NAN));
  CREATE("infinity in double", HF_ERROR_NON_FINITE, 12, (in_double(), positions_f64[37] = -HUGE_VAL));
  CREATE("wider than 1e300", HF_ERROR_TOO_LARGE, NO_INDEX,
         (in_double(), positions_f64[0] = 1e308, positions_f64[3] = -1e308));
  CREATE("every triangle collapses", HF_ERROR_EMPTY, NO_INDEX, memset(triangles, 0, sizeof triangles));
  CREATE("everything welds to a point", HF_ERROR_EMPTY, NO_INDEX,
         (desc.weld = HF_WELD_TOLERANCE, desc.weld_tolerance = 100.0));
  CREATE("all vertices at one place", HF_ERROR_EMPTY, NO_INDEX, memset(positions, 0, sizeof positions));

  CREATE("2^32 - 1 vertices", HF_ERROR_TOO_LARGE, NO_INDEX, desc.positions.count = UINT32_MAX);
  CREATE("2^31 vertices", HF_ERROR_TOO_LARGE, NO_INDEX, desc.positions.count = 0x80000000u);
  CREATE("2^31 vertices, limit lifted", HF_ERROR_TOO_LARGE, NO_INDEX,
         (desc.positions.count = 0x80000000u, desc.vertex_limit = UINT32_MAX));
  CREATE("2^32 - 1 triangles", HF_ERROR_TOO_LARGE, NO_INDEX, desc.triangles.count = UINT32_MAX);
  CREATE("2^31 triangles, limit lifted", HF_ERROR_TOO_LARGE, NO_INDEX,
         (desc.triangles.count = 0x80000000u, desc.vertex_limit = UINT32_MAX));
  CREATE("2^31 triangles, both limits lifted", HF_ERROR_TOO_LARGE, NO_INDEX,
         (desc.triangles.count = 0x80000000u, desc.vertex_limit = desc.triangle_limit = UINT32_MAX));
  CREATE("above the vertex_limit", HF_ERROR_TOO_LARGE, NO_INDEX, desc.vertex_limit = CUT_VERTICES - 1);

  scene_destroy(&scene);
  finish_rows("meshes");
}

static void host_run(void* user, uint32_t count, void (*job)(void*, uint32_t), void* data) {
  (void)user;
  for (uint32_t i = 0; i < count; ++i) job(data, i);
}

static void hf_surface_create_refuses_bad_options(void** state) {
  (void)state;
  scene_create(&scene);
  CREATE("weld -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.weld = -1);
  CREATE("weld 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.weld = 3);
  CREATE("weld INT32_MAX", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.weld = INT32_MAX);
  CREATE("operator -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.operator_kind = -1);
  CREATE("operator 4", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.operator_kind = 4);
  CREATE("field kind -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.field_kind = -1);
  CREATE("field kind 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.field_kind = 3);
  CREATE("a triangle more than the limit", HF_ERROR_TOO_LARGE, NO_INDEX,
         desc.triangle_limit = desc.triangles.count - 1);
  CREATE("triangles of a limit of 1", HF_ERROR_TOO_LARGE, NO_INDEX, desc.triangle_limit = 1);
  CREATE("ordering -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.ordering = -1);
  CREATE("ordering 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.ordering = 3);
  CREATE("weld tolerance 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.weld = HF_WELD_TOLERANCE);
  CREATE("weld tolerance negative", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (desc.weld = HF_WELD_TOLERANCE, desc.weld_tolerance = -1.0));
  CREATE("weld tolerance NaN", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (desc.weld = HF_WELD_TOLERANCE, desc.weld_tolerance = NAN));
  CREATE("weld tolerance infinite", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (desc.weld = HF_WELD_TOLERANCE, desc.weld_tolerance = INFINITY));
  CREATE("257 threads", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.thread_count = 257);
  CREATE("2^32 - 1 threads", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.thread_count = UINT32_MAX);
  CREATE("257 threads of the host", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (desc.thread_count = 257, desc.job_runner.run = host_run));
  CREATE("allocator without release", HF_ERROR_NULL_POINTER, NO_INDEX, desc.allocator.release = NULL);
  CREATE("allocator without allocate", HF_ERROR_NULL_POINTER, NO_INDEX, desc.allocator.allocate = NULL);
  CREATE("allocator that refuses at once", HF_ERROR_OUT_OF_MEMORY, NO_INDEX, counter.refuse_at = counter.calls + 1);
  counter.refuse_at = 0;
  CREATE("progress destroyed", HF_ERROR_INVALID_OBJECT, NO_INDEX, desc.progress = scene.stale_progress);
  CREATE("progress of another kind", HF_ERROR_INVALID_OBJECT, NO_INDEX,
         desc.progress = (hf_progress)(void*)scene.solver);
  CREATE("progress cancelled before", HF_ERROR_CANCELLED, NO_INDEX,
         (desc.progress = scene.progress, hf_progress_cancel(scene.progress)));
  if (!has_gpl()) {
    CREATE("METIS in a build without it", HF_ERROR_UNSUPPORTED, NO_INDEX, desc.ordering = HF_ORDERING_METIS);
  }
  ROW("desc NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_create(NULL, &out));
  out = NULL;
#undef GOOD
#define GOOD() (void)0
  ROW("out_surface NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_create(&desc, NULL));
  ROW("both NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_create(NULL, NULL));
  scene_destroy(&scene);
  finish_rows("options of surfaces");
}

static int solver_holds(void) { return solver_unchanged(&scene); }
static int no_solver(void) { return out_solver == NULL && solver_unchanged(&scene); }
#undef GOOD
#define GOOD good_input
#undef UNCHANGED
#define UNCHANGED no_solver
#define SOLVER(what, expected, index, change) \
  ROW(what, expected, index, change, hf_create(scene.sheet, &solver_desc, &out_solver))

static void hf_create_refuses_bad_options(void** state) {
  (void)state;
  scene_create(&scene);
  SOLVER("field kind -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, solver_desc.field_kind = -1);
  SOLVER("field kind 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, solver_desc.field_kind = 3);
  SOLVER("65 channels", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, solver_desc.channel_count = 65);
  SOLVER("2^32 - 1 channels", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, solver_desc.channel_count = UINT32_MAX);
  SOLVER("progress destroyed", HF_ERROR_INVALID_OBJECT, NO_INDEX, solver_desc.progress = scene.stale_progress);
  SOLVER("progress of another kind", HF_ERROR_INVALID_OBJECT, NO_INDEX,
         solver_desc.progress = (hf_progress)(void*)scene.solver);
  ROW("surface destroyed", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0,
      hf_create(scene.stale_surface, &solver_desc, &out_solver));
  ROW("no surface", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_create(NULL, &solver_desc, &out_solver));
#undef UNCHANGED
#define UNCHANGED solver_holds
  ROW("out_solver NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_create(scene.sheet, &solver_desc, NULL));
  ROW("all NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_create(NULL, NULL, NULL));
#undef GOOD
#define GOOD() (void)0
  scene_destroy(&scene);
  finish_rows("options of solvers");
}

static void a_memory_limit_is_kept(void** state) {
  (void)state;
  Surface sheet = surface_sheet(150, 150);
  hf_surface_desc wide = options_of(&sheet).surface;
  hf_surface surface = NULL;
  wide.memory_limit_mb = 1;
  assert_code(HF_ERROR_OUT_OF_MEMORY, hf_surface_create(&wide, &surface));
  assert_null(surface);
  hf_error_detail detail; /* says that the limit was the reason, and what would have been enough for this block */
  double needed = 0, used = 0, block = 0;
  assert_ok(hf_error_get_detail(&detail));
  const char* text =
      "memory_limit_mb is 1, but at least %lf MiB are needed: %lf MiB are in use, and one block of %lf MiB";
  assert_int_equal(sscanf(detail.message, text, &needed, &used, &block), 3);
  assert_true(needed > 1 && fabs(needed - used - block) <= 0.011);
  wide.memory_limit_mb = 1000;
  assert_ok(hf_surface_create(&wide, &surface));
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(surface, &statistics));
  assert_true(statistics.peak_memory_bytes < 1000.0 * 1048576.0);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void readers_of_base_and_surface_refuse_null_and_small_arrays(void** state) {
  (void)state;
  scene_create(&scene);
  uint32_t components[CUT_VERTICES + 1];
  double fraction;
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_clone(scene.solver, NULL));
  ROW("out NULL and no handle", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_clone(NULL, NULL));
  uint32_t count;
  ROW("array too small", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_surface_get_components(scene.sheet, CUT_VERTICES - 1, components, &count));
  ROW("array of 0", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_surface_get_components(scene.sheet, 0, components, &count));
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_get_components(scene.sheet, 0, NULL, NULL));
  unsigned char byte;
  size_t size;
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_save(scene.sheet, 0, NULL, 0, NULL, NULL));
  ROW("one byte", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_surface_save(scene.sheet, 0, NULL, 1, &byte, &size));
  ROW("field kind -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0,
      hf_surface_save(scene.sheet, -1, NULL, 1, &byte, &size));
  ROW("field kind 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0,
      hf_surface_save(scene.sheet, 3, NULL, 1, &byte, &size));
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_progress_create(NULL));
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_progress_get_fraction(scene.progress, NULL));
  ROW("handle NULL", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_progress_get_fraction(NULL, &fraction));
  assert_code(HF_ERROR_NULL_POINTER, hf_error_get_detail(NULL));
  scene_destroy(&scene);
  finish_rows("readers");
}

static void every_code_has_its_name_and_others_are_unknown(void** state) {
  (void)state;
  unsigned named = 0;
  for (hf_result code = -400; code <= 400; ++code) {
    const char* name = hf_result_get_name(code);
    assert_non_null(name);
    if (strcmp(name, "unknown") != 0) {
      ++named;
      assert_int_equal(strncmp(name, code ? "HF_ERROR_" : "HF_OK", code ? 9 : 5), 0);
    }
  }
  assert_int_equal(named, 21);
  assert_string_equal(hf_result_get_name(INT32_MIN), "unknown");
  assert_string_equal(hf_result_get_name(INT32_MAX), "unknown");
  assert_string_equal(hf_result_get_name(HF_ERROR_BUSY), "HF_ERROR_BUSY");
}

static void a_success_leaves_the_detail_of_the_last_failure(void** state) {
  (void)state;
  hf_error_detail before, after;
  assert_code(HF_ERROR_INVALID_OBJECT, hf_solver_release_preview(NULL));
  assert_ok(hf_error_get_detail(&before));
  Surface sheet = surface_sheet(2, 2);
  hf_solver solver = surface_solver(&sheet);
  hf_solver_destroy(solver);
  assert_ok(hf_error_get_detail(&after));
  assert_true(same_bits(&before, &after, sizeof before));
  assert_string_equal(after.function, "hf_solver_release_preview");
  surface_free(&sheet);
}

static void the_version_is_that_of_the_project(void** state) {
  (void)state;
  assert_int_equal(hf_version_get(), HF_EXPECTED_VERSION);
}

int main(void) {
  hf_error_detail detail;
  memset(&detail, 1, sizeof detail);
  const hf_error_detail zero = {0, 0, {0}, {0}};
  const int clean = hf_error_get_detail(&detail) == HF_OK && memcmp(&detail, &zero, sizeof zero) == 0;
  if (!clean) return printf("before the first failure the detail must be all zero\n"), 1;
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hf_surface_create_refuses_bad_meshes),
      cmocka_unit_test(hf_surface_create_refuses_bad_faces),
      cmocka_unit_test(hf_surface_create_refuses_bad_options),
      cmocka_unit_test(hf_create_refuses_bad_options),
      cmocka_unit_test(a_memory_limit_is_kept),
      cmocka_unit_test(readers_of_base_and_surface_refuse_null_and_small_arrays),
      cmocka_unit_test(every_code_has_its_name_and_others_are_unknown),
      cmocka_unit_test(a_success_leaves_the_detail_of_the_last_failure),
      cmocka_unit_test(the_version_is_that_of_the_project),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
