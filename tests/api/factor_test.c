/* The factor as bytes: saved, loaded by copy and in place, refused when it is another's or damaged. */
#include "api_support.h"

enum { AROUND = 24, RINGS = 30, VERTICES = AROUND * RINGS };

typedef struct Saved {
  Surface tube;
  unsigned char* block; /* from malloc */
  unsigned char* bytes; /* inside it, aligned */
  size_t size;
} Saved;

static unsigned char* aligned_bytes(size_t size, unsigned char** block) {
  *block = malloc(size + HF_FACTOR_ALIGNMENT);
  assert_non_null(*block);
  const size_t off = (uintptr_t)*block % HF_FACTOR_ALIGNMENT;
  return *block + (off ? HF_FACTOR_ALIGNMENT - off : 0);
}

static Saved saved_tube(void) {
  Saved saved;
  saved.tube = surface_tube(AROUND, RINGS);
  hf_surface surface = surface_on(&saved.tube);
  assert_ok(hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, 0, NULL, &saved.size));
  saved.bytes = aligned_bytes(saved.size, &saved.block);
  assert_ok(hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, saved.size, saved.bytes, NULL));
  hf_surface_destroy(surface);
  return saved;
}
static void saved_free(Saved* saved) {
  free(saved->block);
  surface_free(&saved->tube);
}

static hf_result load(const Surface* surface, const void* bytes, size_t size, int borrow, hf_surface* out) {
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.bytes = bytes;
  factor.byte_count = size;
  factor.borrow = borrow;
  hf_surface_desc desc = options_of(surface).surface;
  desc.saved_factor = &factor;
  return hf_surface_create(&desc, out);
}

static double* some_field(hf_solver solver) {
  add_site(solver, 3, 1);
  add_site(solver, VERTICES - 5, -2);
  add_site(solver, VERTICES / 2, 0.5);
  return field_of(solver, VERTICES);
}

static void a_loaded_factor_gives_the_same_bits_as_a_made_one(void** state) {
  (void)state;
  Saved saved = saved_tube();
  hf_surface made_surface = surface_on(&saved.tube);
  hf_solver made = solver_on(made_surface);
  double* expected = some_field(made);
  hf_surface_statistics made_statistics = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(made_surface, &made_statistics));
  assert_int_equal(made_statistics.factor_loaded, 0);
  assert_true(made_statistics.load_ms == 0);
  unsigned char* untouched = malloc(saved.size);
  memcpy(untouched, saved.bytes, saved.size);
  for (int borrow = 0; borrow < 2; ++borrow) {
    for (uint32_t threads = 1; threads <= 4; threads *= 2) {
      hf_factor_desc factor = HF_INIT(hf_factor_desc);
      factor.bytes = saved.bytes;
      factor.byte_count = saved.size;
      factor.borrow = borrow;
      Options desc = options_of(&saved.tube);
      desc.surface.saved_factor = &factor;
      desc.surface.thread_count = threads;
      hf_surface surface = NULL;
      hf_solver loaded = NULL;
      assert_ok(make(&desc, &surface, &loaded));
      double* field = some_field(loaded);
      assert_true(same_bits(field, expected, sizeof(double) * VERTICES));
      hf_surface_statistics s = HF_INIT(hf_surface_statistics);
      assert_ok(hf_surface_get_statistics(surface, &s));
      assert_int_equal(s.factor_loaded, 1);
      assert_int_equal(s.factor_borrowed, borrow);
      assert_true(s.ordering_ms == 0 && s.symbolic_ms == 0 && s.numeric_ms == 0 && s.load_ms > 0);
      assert_true(s.factor_entries == made_statistics.factor_entries);
      assert_true(s.factor_bytes == made_statistics.factor_bytes);
      if (borrow) assert_true(s.memory_bytes < made_statistics.memory_bytes - 0.5 * s.factor_bytes);
      /* what a loaded surface saves is what it was given */
      size_t size = 0;
      unsigned char* again = saved_bytes(surface, HF_FIELD_HARMONIC, &size);
      assert_int_equal(size, saved.size);
      assert_true(same_bits(again, saved.bytes, size));
      free(again);
      free(field);
      hf_solver_destroy(loaded);
      hf_surface_destroy(surface);
    }
  }
  assert_true(same_bits(untouched, saved.bytes, saved.size));
  free(untouched);
  free(expected);
  hf_solver_destroy(made);
  hf_surface_destroy(made_surface);
  saved_free(&saved);
}

static void borrowed_bytes_serve_clones_and_poses_until_the_last_is_gone(void** state) {
  (void)state;
  Saved saved = saved_tube();
  hf_surface surface = NULL;
  assert_ok(load(&saved.tube, saved.bytes, saved.size, 1, &surface));
  hf_solver first = solver_on(surface), copy = NULL;
  assert_ok(hf_solver_clone(first, &copy));
  uint32_t handles[2];
  hf_pose pose = tube_pose(surface, AROUND, RINGS, handles);
  hf_solver_destroy(first);
  hf_surface_destroy(surface);
  double* field = some_field(copy);
  hf_solver made = surface_solver(&saved.tube);
  double* expected = some_field(made);
  assert_true(same_bits(field, expected, sizeof(double) * VERTICES));
  hf_solver_destroy(copy);
  float positions[3 * VERTICES];
  hf_deform_desc deform = HF_INIT(hf_deform_desc);
  deform.positions = ROWS_OUT(positions);
  assert_ok(hf_pose_deform(pose, &deform, NULL));
  hf_pose_destroy(pose);
  memset(saved.bytes, 0xFF, saved.size); /* no object reads them now */
  hf_solver_destroy(made);
  free(field);
  free(expected);
  saved_free(&saved);
}

static void copied_bytes_may_go_at_once_and_need_no_alignment(void** state) {
  (void)state;
  Saved saved = saved_tube();
  unsigned char* block;
  unsigned char* odd = aligned_bytes(saved.size + 1, &block) + 1;
  memcpy(odd, saved.bytes, saved.size);
  hf_surface surface = NULL;
  assert_code(HF_ERROR_INVALID_ARGUMENT, load(&saved.tube, odd, saved.size, 1, &surface));
  assert_null(surface);
  assert_ok(load(&saved.tube, odd, saved.size, 0, &surface));
  memset(odd, 0xFF, saved.size);
  hf_solver made = surface_solver(&saved.tube), loaded = solver_on(surface);
  hf_surface_destroy(surface);
  double *expected = some_field(made), *field = some_field(loaded);
  assert_true(same_bits(field, expected, sizeof(double) * VERTICES));
  free(expected);
  free(field);
  free(block);
  hf_solver_destroy(made);
  hf_solver_destroy(loaded);
  saved_free(&saved);
}

static void a_factor_of_another_surface_is_refused(void** state) {
  (void)state;
  Saved saved = saved_tube();
  hf_surface out = NULL;
  hf_error_detail detail;
  /* another size */
  Surface other = surface_tube(AROUND, RINGS + 1);
  assert_code(HF_ERROR_INVALID_ARGUMENT, load(&other, saved.bytes, saved.size, 0, &out));
  assert_ok(hf_error_get_detail(&detail));
  assert_non_null(strstr(detail.message, "another mesh"));
  surface_free(&other);
  /* the same size, another connectivity */
  other = surface_tube(RINGS, AROUND);
  assert_code(HF_ERROR_INVALID_ARGUMENT, load(&other, saved.bytes, saved.size, 0, &out));
  surface_free(&other);
  /* the same connectivity, one vertex moved by a hair */
  other = surface_tube(AROUND, RINGS);
  other.positions[3 * 100] += 1e-4f;
  assert_code(HF_ERROR_INVALID_ARGUMENT, load(&other, saved.bytes, saved.size, 0, &out));
  assert_ok(hf_error_get_detail(&detail));
  assert_non_null(strstr(detail.message, "other positions"));
  surface_free(&other);
  /* another operator */
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.bytes = saved.bytes;
  factor.byte_count = saved.size;
  hf_surface_desc desc = options_of(&saved.tube).surface;
  desc.saved_factor = &factor;
  desc.operator_kind = HF_OPERATOR_UNIFORM;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create(&desc, &out));
  assert_null(out);
  /* another ordering asked for */
  desc.operator_kind = HF_OPERATOR_INTRINSIC_DELAUNAY;
  desc.ordering = HF_ORDERING_MINIMUM_DEGREE;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create(&desc, &out));
  desc.ordering = HF_ORDERING_NESTED_DISSECTION;
  assert_ok(hf_surface_create(&desc, &out));
  hf_surface_destroy(out);
  saved_free(&saved);
}

static void an_ordering_is_saved_with_the_factor(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  Options desc = options_of(&tube);
  desc.surface.ordering = HF_ORDERING_MINIMUM_DEGREE;
  hf_surface surface = NULL, again = NULL;
  hf_solver solver = NULL;
  assert_ok(make(&desc, &surface, &solver));
  size_t size = 0;
  unsigned char* bytes = saved_bytes(surface, HF_FIELD_HARMONIC, &size);
  assert_ok(load(&tube, bytes, size, 0, &again)); /* ordering 0: the factor's own */
  hf_surface_info info = HF_INIT(hf_surface_info);
  assert_ok(hf_surface_get_info(again, &info));
  assert_int_equal(info.ordering, HF_ORDERING_MINIMUM_DEGREE);
  hf_solver loaded = solver_on(again);
  double *expected = some_field(solver), *field = some_field(loaded);
  assert_true(same_bits(field, expected, sizeof(double) * VERTICES));
  hf_solver_destroy(loaded);
  hf_surface_destroy(again);
  hf_surface_destroy(surface);
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.bytes = bytes;
  factor.byte_count = size;
  desc.surface.saved_factor = &factor;
  assert_ok(make(&desc, NULL, &loaded));
  free(expected);
  free(field);
  free(bytes);
  hf_solver_destroy(solver);
  hf_solver_destroy(loaded);
  surface_free(&tube);
}

static void bad_arguments_are_answered(void** state) {
  (void)state;
  Saved saved = saved_tube();
  hf_surface surface = surface_on(&saved.tube), out = NULL;
  size_t size = 7;
  assert_code(HF_ERROR_NULL_POINTER, hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, 0, NULL, NULL));
  assert_code(HF_ERROR_INVALID_OBJECT, hf_surface_save(NULL, HF_FIELD_HARMONIC, NULL, 0, NULL, &size));
  assert_int_equal(size, 7);
  unsigned char* small = malloc(saved.size + 16);
  memset(small, 0x5A, saved.size + 16);
  assert_code(HF_ERROR_TOO_SMALL, hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, saved.size - 1, small, &size));
  assert_int_equal(size, saved.size); /* the size is written with the error */
  assert_code(HF_ERROR_TOO_SMALL, hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, 0, small, NULL));
  for (size_t i = 0; i < saved.size + 16; ++i) assert_int_equal(small[i], 0x5A);
  assert_ok(hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, saved.size + 16, small, NULL));
  for (size_t i = saved.size; i < saved.size + 16; ++i) assert_int_equal(small[i], 0x5A);
  assert_code(HF_ERROR_NULL_POINTER, load(&saved.tube, NULL, saved.size, 0, &out));
  assert_code(HF_ERROR_EMPTY, load(&saved.tube, saved.bytes, 0, 0, &out));
  assert_code(HF_ERROR_INVALID_ARGUMENT, load(&saved.tube, saved.bytes, saved.size - 1, 0, &out));
  assert_code(HF_ERROR_INVALID_ARGUMENT, load(&saved.tube, saved.bytes, 1, 0, &out));
  assert_null(out);
  free(small);
  hf_surface_destroy(surface);
  saved_free(&saved);
}

/* Thousands of damaged copies through the front door: flips, truncations, splices, bytes of another factor. */
static void damaged_bytes_are_refused_and_never_crash(void** state) {
  (void)state;
  Surface sheet = surface_sheet(5, 4);
  hf_surface surface = surface_on(&sheet);
  size_t size = 0;
  assert_ok(hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, 0, NULL, &size));
  unsigned char *bytes_block, *damaged_block;
  unsigned char* bytes = aligned_bytes(size, &bytes_block);
  unsigned char* damaged = aligned_bytes(size, &damaged_block);
  assert_ok(hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, size, bytes, NULL));
  uint64_t random = 88172645463325252ull;
  unsigned refused = 0, unsupported = 0;
  for (int round = 0; round < 6000; ++round) {
    memcpy(damaged, bytes, size);
    size_t length = size;
    for (int change = 0; change <= round % 4; ++change) {
      random ^= random << 13;
      random ^= random >> 7;
      random ^= random << 17;
      const size_t at = (size_t)(random >> 8) % (round % 2 ? 128 : size);
      switch (round % 5) {
        case 0:
          damaged[at] ^= (unsigned char)(1u << (random & 7));
          break;
        case 1:
          damaged[at] = (unsigned char)(damaged[at] + 1 + random % 255);
          break;
        case 2:
          memset(damaged + at, 0xFF, size - at < 8 ? size - at : 8);
          break;
        case 3:
          length = at;
          break;
        default:
          memcpy(damaged + at, bytes, size - at);
          if (at == 0) damaged[8] ^= 1;
          break;
      }
    }
    if (length == size && same_bits(damaged, bytes, size)) continue;
    hf_surface out = (hf_surface)(void*)&sheet;
    const hf_result result = load(&sheet, damaged, length, round % 2, &out);
    assert_null(out);
    if (length == 0) {
      assert_string_equal(hf_result_get_name(result), "HF_ERROR_EMPTY");
    } else {
      assert_true(result == HF_ERROR_INVALID_ARGUMENT || result == HF_ERROR_UNSUPPORTED);
      refused += result == HF_ERROR_INVALID_ARGUMENT;
      unsupported += result == HF_ERROR_UNSUPPORTED;
    }
  }
  assert_true(refused > 3000 && unsupported > 50);
  free(bytes_block);
  free(damaged_block);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void memory_that_runs_out_while_loading_or_saving_leaves_nothing(void** state) {
  (void)state;
  Saved saved = saved_tube();
  for (int borrow = 0; borrow < 2; ++borrow) {
    size_t failures = 0;
    for (size_t n = 1;; ++n) {
      CountingAllocator memory;
      memset(&memory, 0, sizeof memory);
      memory.refuse_at = n;
      memory.refuse_on = 1; /* after a single refusal the library gives kept blocks back and asks again */
      hf_factor_desc factor = HF_INIT(hf_factor_desc);
      factor.bytes = saved.bytes;
      factor.byte_count = saved.size;
      factor.borrow = borrow;
      hf_surface_desc desc = options_of(&saved.tube).surface;
      desc.saved_factor = &factor;
      desc.allocator = counting_hooks(&memory);
      hf_surface surface = NULL;
      const hf_result result = hf_surface_create(&desc, &surface);
      if (result == HF_OK) {
        /* saving needs a little too */
        const size_t calls = memory.calls;
        unsigned char* again = malloc(saved.size);
        for (size_t m = 1;; ++m) {
          memory.refuse_at = memory.calls + m;
          const hf_result save = hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, saved.size, again, NULL);
          if (save == HF_OK) break;
          assert_string_equal(hf_result_get_name(save), "HF_ERROR_OUT_OF_MEMORY");
          assert_true(m < 100);
        }
        assert_true(memory.calls > calls);
        assert_true(same_bits(again, saved.bytes, saved.size));
        free(again);
      } else {
        assert_string_equal(hf_result_get_name(result), "HF_ERROR_OUT_OF_MEMORY");
        assert_null(surface);
        ++failures;
      }
      hf_surface_destroy(surface);
      assert_int_equal(memory.live_blocks, 0);
      assert_int_equal(memory.live_bytes, 0);
      assert_int_equal(memory.mismatches, 0);
      if (result == HF_OK) break;
    }
    assert_true(failures > 30);
  }
  saved_free(&saved);
}

static double worst_difference(const double* a, const double* b, size_t count) {
  double worst = 0;
  for (size_t i = 0; i < count; ++i) worst = fmax(worst, fabs(a[i] - b[i]));
  return worst;
}

static void a_preview_is_close_and_a_correction_makes_it_accurate(void** state) {
  (void)state;
  enum { AROUND_LARGE = 120, RINGS_LARGE = 150, LARGE = AROUND_LARGE * RINGS_LARGE };
  Surface tube = surface_tube(AROUND_LARGE, RINGS_LARGE);
  double* first[3] = {NULL, NULL, NULL};
  for (uint32_t threads = 1; threads <= 4; threads *= 2) {
    Options desc = options_of(&tube);
    desc.surface.thread_count = threads;
    hf_surface surface = NULL;
    hf_solver solver = NULL;
    assert_ok(make(&desc, &surface, &solver));
    for (uint32_t i = 0; i < 40; ++i) add_site(solver, (i * 7919u) % LARGE, sin(3.0 * i));
    double* exact = field_of(solver, LARGE);
    hf_surface_statistics before, after;
    before = HF_INIT(hf_surface_statistics);
    after = HF_INIT(hf_surface_statistics);
    assert_ok(hf_surface_get_statistics(surface, &before));
    for (uint32_t corrections = 0; corrections < 3; ++corrections) {
      double* field = malloc(sizeof(double) * LARGE);
      hf_preview_info info = HF_INIT(hf_preview_info);
      assert_ok(hf_solver_solve_preview(solver, OUT(field), corrections, &info));
      const double error = worst_difference(field, exact, LARGE);
      const double allowed[3] = {1e-5, 1e-9, 2e-12};
      assert_true(error <= allowed[corrections] * info.value_range);
      if (corrections < 2) assert_true(error > 0 && error <= info.error_estimate);
      assert_true(corrections == 0 ? info.largest_correction == 0 : info.largest_correction > 0);
      assert_int_equal(info.exact, 0);
      assert_int_equal(info.correction_count, corrections);
      assert_true(info.value_range > 1.9 && info.value_range <= 2);
      assert_true(info.preview_bytes > 0.3 * before.factor_bytes && info.preview_bytes < 0.6 * before.factor_bytes);
      for (uint32_t i = 0; i < 40; ++i) assert_true(field[(i * 7919u) % LARGE] == sin(3.0 * i));
      /* the same bits for any number of threads, and a second time */
      if (threads == 1) first[corrections] = field;
      assert_true(same_bits(field, first[corrections], sizeof(double) * LARGE));
      float* values = malloc(sizeof(float) * LARGE);
      assert_ok(hf_solver_solve_preview(solver, OUT(values), corrections, NULL));
      for (uint32_t v = 0; v < LARGE; ++v) assert_true(values[v] == (float)field[v]);
      free(values);
      if (threads != 1) free(field);
    }
    assert_ok(hf_surface_get_statistics(surface, &after));
    assert_true(after.memory_bytes >= before.memory_bytes + 0.3 * before.factor_bytes);
    assert_ok(hf_solver_release_preview(solver));
    assert_ok(hf_solver_release_preview(solver));
    const double with = after.memory_bytes;
    assert_ok(hf_surface_get_statistics(surface, &after));
    assert_true(after.memory_bytes <= with - 0.3 * before.factor_bytes);
    double* again = malloc(sizeof(double) * LARGE);
    assert_ok(hf_solver_solve_preview(solver, OUT(again), 0, NULL));
    assert_true(same_bits(again, first[0], sizeof(double) * LARGE));
    free(again);
    free(exact);
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }
  for (int i = 0; i < 3; ++i) free(first[i]);
  surface_free(&tube);
}

static void previews_of_tiny_huge_and_shifted_values_are_as_close(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  const double scale[] = {1e-42, 1e-300, 1e-5, 1e30, 1e120, 1}, shift[] = {0, 0, 0, 0, 0, 1e6};
  for (size_t k = 0; k < COUNT_OF(scale); ++k) {
    hf_solver solver = surface_solver(&tube);
    for (uint32_t i = 0; i < 9; ++i) add_site(solver, i * 71u, shift[k] + scale[k] * sin(2.0 * i));
    double *exact = field_of(solver, VERTICES), *field = malloc(sizeof(double) * VERTICES);
    hf_preview_info info = HF_INIT(hf_preview_info);
    for (uint32_t corrections = 0; corrections < 2; ++corrections) {
      assert_ok(hf_solver_solve_preview(solver, OUT(field), corrections, &info));
      const double allowed = (corrections ? 1e-9 : 1e-5) * scale[k] + 1e-15 * shift[k];
      assert_true(worst_difference(field, exact, VERTICES) <= allowed);
    }
    free(exact);
    free(field);
    hf_solver_destroy(solver);
  }
  surface_free(&tube);
}

static void solvers_without_a_preview_answer_with_the_exact_field(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  const int32_t engines[] = {ENGINE_REFACTOR, ENGINE_GREEN, ENGINE_UPDOWN};
  const size_t engine_count = has_gpl() ? 3 : 2;
  for (size_t e = 0; e < engine_count; ++e) {
    Options desc = options_of(&tube);
    desc.engine = engines[e];
    hf_solver solver = NULL;
    assert_ok(make(&desc, NULL, &solver));
    if (engines[e] == ENGINE_GREEN) {
      /* enough sites at once to move them into the factor */
      uint32_t vertices[VERTICES / 2];
      double values[VERTICES / 2];
      for (uint32_t i = 0; i < VERTICES / 2; ++i) {
        vertices[i] = 2 * i;
        values[i] = cos(0.1 * i);
      }
      const hf_sites_desc sites = sites_at(VERTICES / 2, vertices, values);
      assert_ok(hf_add_sites(solver, &sites, NULL));
      assert_ok(hf_solver_prepare_rebase(solver));
      add_site(solver, 1, 3);
      add_site(solver, 33, -2);
    } else {
      add_site(solver, 1, 3);
      add_site(solver, 33, -2);
    }
    double *exact = field_of(solver, VERTICES), *field = malloc(sizeof(double) * VERTICES);
    hf_preview_info info = HF_INIT(hf_preview_info);
    assert_ok(hf_solver_solve_preview(solver, OUT(field), 2, &info));
    assert_int_equal(info.exact, 1);
    assert_true(info.error_estimate == 0 && info.correction_count == 0);
    assert_true(same_bits(field, exact, sizeof(double) * VERTICES));
    free(exact);
    free(field);
    hf_solver_destroy(solver);
  }
  surface_free(&tube);
}

static void previews_report_what_no_site_reaches_and_check_their_arguments(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_solver solver = surface_solver(&cut);
  float values[2 * CUT_VERTICES];
  double doubles[CUT_VERTICES];
  hf_preview_info info = HF_INIT(hf_preview_info);
  memset(values, 0x5A, sizeof values);
  assert_code(HF_ERROR_EMPTY, hf_solver_solve_preview(solver, OUT(values), 0, &info));
  add_site(solver, CUT_LEFT, 1);
  add_site(solver, CUT_RIGHT, 3);
  assert_code(HF_ERROR_NULL_POINTER, hf_solver_solve_preview(solver, NULL, 0, &info));
  assert_code(HF_ERROR_NULL_POINTER, hf_solver_solve_preview(solver, NULL, 0, &info));
  assert_code(HF_ERROR_TOO_SMALL, hf_solver_solve_preview(solver, OUT_ROWS(values, 3), 0, &info));
  assert_code(HF_ERROR_TOO_SMALL, hf_solver_solve_preview(solver, OUT_ROWS(doubles, 4), 0, &info));
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_solver_solve_preview(solver, OUT(values), 9, &info));
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_solver_solve_preview(solver, OUT(doubles), UINT32_MAX, &info));
  for (size_t i = 0; i < sizeof values; ++i) assert_int_equal(((unsigned char*)values)[i], 0x5A);
  assert_ok(hf_solver_solve_preview(solver, OUT_ROWS(values, 8), 1, &info));
  assert_int_equal(info.unreached_component_count, 1);
  assert_true(values[2 * CUT_ISLAND] == 0 && values[2 * CUT_ISOLATED] == 0);
  assert_true(values[2 * CUT_SEAM_LEFT] == values[2 * CUT_SEAM_RIGHT]);
  assert_true(values[2 * CUT_LEFT] == 1 && values[2 * CUT_RIGHT] == 3);
  hf_solver_destroy(solver);
  surface_free(&cut);
}

static void memory_that_runs_out_in_a_preview_changes_nothing(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  CountingAllocator memory;
  memset(&memory, 0, sizeof memory);
  Options desc = options_of(&tube);
  desc.surface.allocator = counting_hooks(&memory);
  hf_solver solver = NULL;
  assert_ok(make(&desc, NULL, &solver));
  double* expected = some_field(solver);
  double field[VERTICES];
  size_t failures = 0;
  memory.refuse_on = 1;
  for (size_t n = 1;; ++n) {
    memory.refuse_at = memory.calls + n;
    const hf_result result = hf_solver_solve_preview(solver, OUT(field), 2, NULL);
    memory.refuse_at = 0;
    assert_ok(hf_solver_release_preview(solver));
    if (result == HF_OK) break;
    assert_string_equal(hf_result_get_name(result), "HF_ERROR_OUT_OF_MEMORY");
    double* after = field_of(solver, VERTICES);
    assert_true(same_bits(after, expected, sizeof(double) * VERTICES));
    free(after);
    ++failures;
  }
  assert_true(failures > 5);
  assert_true(worst_difference(field, expected, VERTICES) < 1e-11);
  hf_solver_destroy(solver);
  assert_int_equal(memory.live_blocks, 0);
  free(expected);
  surface_free(&tube);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_loaded_factor_gives_the_same_bits_as_a_made_one),
      cmocka_unit_test(borrowed_bytes_serve_clones_and_poses_until_the_last_is_gone),
      cmocka_unit_test(copied_bytes_may_go_at_once_and_need_no_alignment),
      cmocka_unit_test(a_factor_of_another_surface_is_refused),
      cmocka_unit_test(an_ordering_is_saved_with_the_factor),
      cmocka_unit_test(bad_arguments_are_answered),
      cmocka_unit_test(damaged_bytes_are_refused_and_never_crash),
      cmocka_unit_test(memory_that_runs_out_while_loading_or_saving_leaves_nothing),
      cmocka_unit_test(a_preview_is_close_and_a_correction_makes_it_accurate),
      cmocka_unit_test(previews_of_tiny_huge_and_shifted_values_are_as_close),
      cmocka_unit_test(solvers_without_a_preview_answer_with_the_exact_field),
      cmocka_unit_test(previews_report_what_no_site_reaches_and_check_their_arguments),
      cmocka_unit_test(memory_that_runs_out_in_a_preview_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
