/* hf_array and hf_array_out, for the nouns that take them: the same numbers in another form give the same bits, and
 * what a form has wrong is named. */
#include "api_support.h"

enum { AROUND = 8, RINGS = 9, COUNT = AROUND * RINGS, TRIANGLES = 2 * AROUND * (RINGS - 1) };

static Surface tube;
static hf_surface surface;
static hf_solver solver;

static int setup(void** state) {
  (void)state;
  tube = surface_tube(AROUND, RINGS);
  surface = surface_on(&tube);
  solver = solver_on(surface);
  add_site(solver, 0, 0);
  add_site(solver, COUNT - 1, 1);
  return 0;
}
static int teardown(void** state) {
  (void)state;
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&tube);
  return 0;
}

static hf_surface_desc good_desc(void) { return options_of(&tube).surface; }

/* The field on a surface made of a desc. */
static void field_on(const hf_surface_desc* desc, double* field) {
  hf_surface made = NULL;
  assert_ok(hf_surface_create(desc, &made));
  hf_solver on = solver_on(made);
  add_site(on, 0, 0);
  add_site(on, COUNT - 1, 1);
  assert_ok(hf_solver_solve(on, &HF_ARRAY_OUT(field, COUNT), NULL));
  hf_solver_destroy(on);
  hf_surface_destroy(made);
}

static void hf_array_takes_the_type_of_its_pointer(void** state) {
  (void)state;
  const float floats[3] = {0};
  const double doubles[3] = {0};
  const uint32_t words[3] = {0};
  const uint16_t halves[3] = {0};
  const char bytes[3] = {0};
  assert_int_equal(HF_ARRAY(floats, 1).type, HF_TYPE_PLAIN);
  assert_int_equal(HF_ARRAY(doubles, 1).type, HF_TYPE_DOUBLE);
  assert_int_equal(HF_ARRAY(words, 1).type, HF_TYPE_PLAIN);
  assert_int_equal(HF_ARRAY(halves, 1).type, HF_TYPE_UINT16);
  assert_int_equal(HF_ARRAY(bytes, 1).type, -1); /* every call refuses it */
  const hf_array view = HF_ARRAY(floats, 1);
  assert_true(view.data == floats && view.count == 1 && view.stride == 0 && view.reserved == 0);
}

static void meshes_in_every_form_give_the_same_bits(void** state) {
  (void)state;
  enum { RECORD = 37, SINGLE = 13, WIDE = 29, NARROW = 11 }; /* odd: rows are not aligned */
  static double doubles[3 * COUNT], plain[COUNT], field[COUNT];
  static uint16_t halves[3 * TRIANGLES];
  static unsigned char records[RECORD * COUNT + 1], singles[SINGLE * COUNT + 1], wide[WIDE * TRIANGLES + 1],
      narrow[NARROW * TRIANGLES + 1];
  for (size_t i = 0; i < 3 * COUNT; ++i) doubles[i] = (double)tube.positions[i];
  for (size_t i = 0; i < 3 * TRIANGLES; ++i) halves[i] = (uint16_t)tube.triangles[i];
  for (size_t v = 0; v < COUNT; ++v) memcpy(records + 1 + RECORD * v, doubles + 3 * v, 24);
  for (size_t v = 0; v < COUNT; ++v) memcpy(singles + 1 + SINGLE * v, tube.positions + 3 * v, 12);
  for (size_t t = 0; t < TRIANGLES; ++t) memcpy(wide + 1 + WIDE * t, tube.triangles + 3 * t, 12);
  for (size_t t = 0; t < TRIANGLES; ++t) memcpy(narrow + 1 + NARROW * t, halves + 3 * t, 6);
  const hf_array positions[] = {HF_ARRAY(tube.positions, COUNT),
                                HF_ARRAY(doubles, COUNT),
                                {records + 1, COUNT, RECORD, HF_TYPE_DOUBLE, 0},
                                {singles + 1, COUNT, SINGLE, HF_TYPE_PLAIN, 0}};
  const hf_array triangles[] = {HF_ARRAY(tube.triangles, TRIANGLES),
                                HF_ARRAY(halves, TRIANGLES),
                                {wide + 1, TRIANGLES, WIDE, HF_TYPE_PLAIN, 0},
                                {narrow + 1, TRIANGLES, NARROW, HF_TYPE_UINT16, 0}};
  hf_surface_desc desc = good_desc();
  field_on(&desc, plain);
  for (size_t p = 0; p < COUNT_OF(positions); ++p) {
    for (size_t t = 0; t < COUNT_OF(triangles); ++t) {
      desc.positions = positions[p];
      desc.triangles = triangles[t];
      field_on(&desc, field);
      assert_memory_equal(field, plain, sizeof field);
    }
  }
}

/* Every form of output for rows of `width` numbers: doubles, and floats that are those doubles rounded. */
typedef hf_result (*Write)(const hf_array_out* out, const void* object);
static void outputs_agree(Write write, const void* object, uint32_t width) {
  enum { GAP = 5 };
  static double doubles[3 * COUNT];
  static float floats[3 * COUNT];
  static unsigned char rows[(24 + GAP) * COUNT + 1];
  assert_ok(write(&HF_ARRAY_OUT(doubles, COUNT), object));
  assert_ok(write(&HF_ARRAY_OUT(floats, COUNT), object));
  for (uint32_t i = 0; i < width * COUNT; ++i) assert_true(floats[i] == (float)doubles[i]);
  for (int32_t type = HF_TYPE_PLAIN; type <= HF_TYPE_DOUBLE; ++type) {
    const size_t row = width * (type == HF_TYPE_DOUBLE ? sizeof(double) : sizeof(float)), stride = row + GAP;
    const unsigned char* packed = type == HF_TYPE_DOUBLE ? (const void*)doubles : (const void*)floats;
    memset(rows, 0xEE, sizeof rows);
    const hf_array_out spread = {rows + 1, COUNT, (uint32_t)stride, type, 0};
    assert_ok(write(&spread, object));
    for (size_t v = 0; v < COUNT; ++v) {
      assert_memory_equal(rows + 1 + stride * v, packed + row * v, row);
      for (size_t i = row; i < stride; ++i)
        assert_int_equal(rows[1 + stride * v + i], 0xEE); /* what is between stays */
    }
    memset(rows, 0xEE, sizeof rows); /* packed, and not aligned */
    const hf_array_out odd = {rows + 1, COUNT, 0, type, 0};
    assert_ok(write(&odd, object));
    assert_memory_equal(rows + 1, packed, row * COUNT);
  }
  /* what is wrong is named, and nothing is written */
  static double before[3 * COUNT];
  memcpy(before, doubles, sizeof before);
  hf_array_out bad = HF_ARRAY_OUT(doubles, COUNT - 1);
  assert_code(HF_ERROR_TOO_SMALL, write(&bad, object));
  hf_error_detail detail;
  assert_ok(hf_error_get_detail(&detail));
  assert_non_null(strstr(detail.message, "count is 71, but there are 72"));
  bad = HF_ARRAY_OUT(doubles, COUNT);
  bad.type = HF_TYPE_UINT16;
  assert_code(HF_ERROR_INVALID_ARGUMENT, write(&bad, object));
  double(*pairs)[2] = (double(*)[2])doubles; /* rows in place of numbers have the size of no number */
  bad = HF_ARRAY_OUT(pairs, COUNT);
  assert_int_equal(bad.type, -1);
  assert_code(HF_ERROR_INVALID_ARGUMENT, write(&bad, object));
  assert_ok(hf_error_get_detail(&detail));
  assert_non_null(strstr(detail.message, "HF_ARRAY needs a pointer to numbers, such as rows[0]"));
  bad.type = HF_TYPE_DOUBLE;
  bad.stride = 8 * width - 1;
  assert_code(HF_ERROR_TOO_SMALL, write(&bad, object));
  bad.stride = 0;
  bad.reserved = 1;
  assert_code(HF_ERROR_INVALID_DESC, write(&bad, object));
  bad.reserved = 0;
  bad.data = NULL;
  assert_code(HF_ERROR_NULL_POINTER, write(&bad, object));
  assert_memory_equal(doubles, before, sizeof before);
}

static hf_result write_field(const hf_array_out* out, const void* object) {
  (void)object;
  return hf_solver_solve(solver, out, NULL);
}
static void an_output_of_a_call_is_needed(void** state) {
  (void)state;
  const hf_array_out none = HF_ARRAY_OUT((double*)NULL, 0);
  assert_code(HF_ERROR_NULL_POINTER, write_field(NULL, NULL));
  assert_code(HF_ERROR_NULL_POINTER, write_field(&none, NULL));
}
static hf_result write_preview(const hf_array_out* out, const void* object) {
  (void)object;
  return hf_solver_solve_preview(solver, out, 2, NULL);
}
static hf_result write_distances(const hf_array_out* out, const void* object) {
  const uint32_t source = 3;
  return hf_geodesics_solve(*(const hf_geodesics*)object, 1, &source, out);
}
static hf_result write_directions(const hf_array_out* out, const void* object) {
  return hf_direction_solve(*(const hf_direction*)object, out, NULL);
}
static hf_result write_handle_field(const hf_array_out* out, const void* object) {
  return hf_pose_get_field(*(const hf_pose*)object, 0, out);
}
static hf_result write_posed(const hf_array_out* out, const void* object) {
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.restart = 1;
  desc.positions = *out;
  return hf_pose_deform(*(const hf_pose*)object, &desc, NULL);
}
static hf_result write_morphed(const hf_array_out* out, const void* object) {
  hf_morph_desc desc = HF_INIT(hf_morph_desc);
  desc.weight = 0.5;
  desc.positions = *out;
  return hf_region_morph(*(const hf_region*)object, &desc);
}
static hf_result write_transferred(const hf_array_out* out, const void* object) {
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(tube.positions, COUNT);
  frame.target_positions = *out;
  return hf_transfer_apply(*(const hf_transfer*)object, &frame);
}

static void every_output_takes_floats_doubles_and_strides(void** state) {
  (void)state;
  outputs_agree(write_field, NULL, 1);
  outputs_agree(write_preview, NULL, 1);
  hf_geodesics geodesics = NULL;
  assert_ok(hf_geodesics_create(surface, NULL, &geodesics));
  outputs_agree(write_distances, &geodesics, 1);
  hf_geodesics_destroy(geodesics);
  hf_direction direction = NULL;
  const uint32_t vertex = 20;
  const double along[3] = {0, 1, 0};
  assert_ok(hf_direction_create(surface, NULL, &direction));
  assert_ok(hf_direction_add_sites(direction, 1, &vertex, along, NULL));
  outputs_agree(write_directions, &direction, 3);
  hf_direction_destroy(direction);
  hf_pose pose = NULL;
  const double ends[2][3] = {{1, 0, 0}, {1, RINGS - 1, 0}};
  uint32_t handles[2];
  assert_ok(hf_pose_create(surface, NULL, &pose));
  for (int i = 0; i < 2; ++i) assert_ok(hf_pose_add_handle_at(pose, ends[i], 0.5, &handles[i]));
  const hf_transform turned = {{0, 0, 0.3, 0.9}, {0.5, 0, 0}};
  assert_ok(hf_pose_set_transform(pose, handles[1], &turned));
  outputs_agree(write_handle_field, &pose, 1);
  outputs_agree(write_posed, &pose, 3);
  hf_pose_destroy(pose);
  hf_region region = NULL;
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  const uint32_t middle = 4 * AROUND;
  edit.add_count = 1;
  edit.add_vertices = &middle;
  assert_ok(hf_region_create(surface, NULL, &region));
  assert_ok(hf_region_edit(region, &edit));
  outputs_agree(write_morphed, &region, 3);
  hf_region_destroy(region);
  hf_transfer transfer = NULL;
  const uint32_t ones[2] = {1, 1}, at[2] = {0, COUNT - 1};
  assert_ok(hf_transfer_create(surface, surface, NULL, &transfer));
  add_own_pairs(transfer, ones, at);
  outputs_agree(write_transferred, &transfer, 3);
  hf_transfer_destroy(transfer);
}

/* Calls that read one number for each vertex, or three. */
typedef hf_result (*Read)(const hf_array* in);
static hf_result read_levels(const hf_array* in) {
  double levels[3];
  return hf_surface_space_levels(surface, in, HF_LEVELS_AREA, 3, levels);
}
static hf_result read_critical(const hf_array* in) {
  hf_critical_info info = HF_INIT(hf_critical_info);
  return hf_surface_find_critical_points(surface, in, 0, NULL, &info);
}
static hf_result read_gaps(const hf_array* in) {
  hf_gaps_info info = HF_INIT(hf_gaps_info);
  return hf_surface_measure_gaps(surface, in, 0, NULL, &info);
}
static hf_result read_picked(const hf_array* in) {
  const double eye[3] = {9, 3, 0}, look[3] = {-1, 0, 0};
  hf_pick_desc desc = HF_INIT(hf_pick_desc);
  hf_hit hit = HF_INIT(hf_hit);
  if (in) desc.positions = *in;
  return hf_surface_cast_ray(surface, eye, look, &desc, &hit);
}
static hf_result read_region(const hf_array* in) {
  hf_region_desc desc = HF_INIT(hf_region_desc);
  hf_region region = NULL;
  if (in) desc.positions = *in;
  const hf_result result = hf_region_create(surface, &desc, &region);
  hf_region_destroy(region);
  return result;
}
static hf_result read_rest(const hf_array* in) {
  hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
  hf_transfer transfer = NULL;
  if (in) desc.source_rest = desc.target_rest = *in;
  const hf_result result = hf_transfer_create(surface, surface, &desc, &transfer);
  hf_transfer_destroy(transfer);
  return result;
}

static void every_input_says_what_is_wrong_with_it(void** state) {
  (void)state;
  static double numbers[3 * COUNT];
  for (size_t i = 0; i < 3 * COUNT; ++i) numbers[i] = (double)tube.positions[i];
  const struct {
    Read read;
    uint32_t width;
    int optional;
  } calls[] = {{read_levels, 1, 0}, {read_critical, 1, 0}, {read_gaps, 3, 0},
               {read_picked, 3, 1}, {read_region, 3, 1},   {read_rest, 3, 1}};
  for (size_t c = 0; c < COUNT_OF(calls); ++c) {
    const Read read = calls[c].read;
    const hf_array good = HF_ARRAY(numbers, COUNT);
    hf_array bad = good;
    assert_ok(read(&good));
    const hf_array none = HF_ARRAY((const float*)NULL, 0);
    assert_code(calls[c].optional ? HF_OK : HF_ERROR_NULL_POINTER, read(NULL));
    assert_code(calls[c].optional ? HF_OK : HF_ERROR_NULL_POINTER, read(&none));
    for (int more = -1; more <= 1; more += 2) {
      bad.count = (uint32_t)(COUNT + more);
      assert_code(HF_ERROR_INVALID_ARGUMENT, read(&bad));
      hf_error_detail detail;
      assert_ok(hf_error_get_detail(&detail));
      assert_non_null(
          strstr(detail.message, more < 0 ? "count is 71, but there are 72" : "count is 73, but there are 72"));
    }
    bad = good;
    bad.type = HF_TYPE_UINT16;
    assert_code(HF_ERROR_INVALID_ARGUMENT, read(&bad));
    bad.type = 3;
    assert_code(HF_ERROR_INVALID_ARGUMENT, read(&bad));
    bad = good;
    bad.stride = 8 * calls[c].width - 1;
    assert_code(HF_ERROR_TOO_SMALL, read(&bad));
    bad = good;
    bad.reserved = 1;
    assert_code(HF_ERROR_INVALID_DESC, read(&bad));
    bad = good;
    bad.data = NULL;
    assert_code(HF_ERROR_NULL_POINTER, read(&bad));
  }
}

static void graphs_take_indices_of_16_bits_and_single_weights(void** state) {
  (void)state;
  const uint32_t edges[8] = {0, 1, 1, 2, 2, 3, 3, 0};
  const uint16_t narrow[8] = {0, 1, 1, 2, 2, 3, 3, 0};
  const double weights[4] = {1, 2, 1, 2};
  const float single[4] = {1, 2, 1, 2};
  double fields[2][4];
  for (int i = 0; i < 2; ++i) {
    hf_graph_desc desc = HF_INIT(hf_graph_desc);
    desc.vertex_count = 4;
    desc.edges = HF_ARRAY(edges, 4);
    desc.weights = HF_ARRAY(weights, 4);
    if (i == 1) {
      desc.edges = HF_ARRAY(narrow, 4);
      desc.weights = HF_ARRAY(single, 4);
      desc.masses = HF_ARRAY(single, 4);
    }
    hf_surface graph = NULL;
    assert_ok(hf_surface_create_graph(&desc, &graph));
    hf_solver on = solver_on(graph);
    add_site(on, 0, 0);
    add_site(on, 2, 1);
    assert_ok(hf_solver_solve(on, &HF_ARRAY_OUT(fields[i], 4), NULL));
    hf_solver_destroy(on);
    hf_surface_destroy(graph);
    desc.weights.count = 3;
    assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create_graph(&desc, &graph));
    desc.weights.count = 4;
    desc.masses = HF_ARRAY(weights, 3);
    assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create_graph(&desc, &graph));
  }
  assert_memory_equal(fields[0], fields[1], sizeof fields[0]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hf_array_takes_the_type_of_its_pointer),
      cmocka_unit_test(meshes_in_every_form_give_the_same_bits),
      cmocka_unit_test(an_output_of_a_call_is_needed),
      cmocka_unit_test(every_output_takes_floats_doubles_and_strides),
      cmocka_unit_test(every_input_says_what_is_wrong_with_it),
      cmocka_unit_test(graphs_take_indices_of_16_bits_and_single_weights),
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
