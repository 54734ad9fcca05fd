/* Limits of work and memory: a factorisation that is too dear is refused before it begins, with the numbers needed. */
#include "api_support.h"

/* Triangles between any vertices: their factor is nearly full, and its flops grow with the cube of the vertices: 5.6
 * and 1.6 * 10^9. Under an emulator (HF_EMULATED) the larger takes 1,100 s. */
#ifdef HF_EMULATED
enum { COLUMNS = 50, ROWS = 40, TRIANGLES = 27000 };
#else
enum { COLUMNS = 60, ROWS = 50, TRIANGLES = 40000 };
#endif
enum { VERTICES = COLUMNS * ROWS };
static Surface places;
static uint32_t corners[3 * TRIANGLES];
static CountingAllocator counter;

static hf_surface_desc soup(void) {
  uint32_t random = 1;
  for (uint32_t i = 0; i < 3 * TRIANGLES; ++i) {
    random = random * 1664525u + 1013904223u;
    corners[i] = (random >> 8) % VERTICES;
  }
  hf_surface_desc desc = options_of(&places).surface;
  desc.triangles = HF_ARRAY(corners, TRIANGLES);
  desc.allocator = counting_hooks(&counter);
  return desc;
}

static hf_surface_statistics statistics_of(hf_surface surface) {
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(surface, &statistics));
  return statistics;
}

/* The call is refused with `code`; returns the message. Nothing is left behind. */
static const char* refused(hf_result code, const hf_surface_desc* desc) {
  static hf_error_detail detail;
  hf_surface surface = (hf_surface)(void*)&detail;
  assert_code(code, hf_surface_create(desc, &surface));
  assert_null(surface);
  assert_int_equal(counter.live_blocks, 0);
  assert_int_equal(counter.mismatches, 0);
  assert_ok(hf_error_get_detail(&detail));
  assert_int_equal(detail.index, HF_NO_INDEX);
  return detail.message;
}

static void a_work_limit_is_kept(void** state) {
  (void)state;
  hf_surface_desc desc = soup();
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  const double flops = 1e-9 * statistics_of(surface).factor_flops;
  hf_surface_destroy(surface);
#ifdef HF_EMULATED
  assert_true(flops > 1.2);
#else
  assert_true(flops > 4.5);
#endif
  const char* text = "the factorisation takes %lf * 10^9 operations, and the work_limit_gflop is %lf";
  double needed = 0, limit = 0;
  print_message("%.2f * 10^9 operations\n", flops);
  for (uint32_t given = 1; given < flops; ++given) {
    desc.work_limit_gflop = given;
    assert_int_equal(sscanf(refused(HF_ERROR_TOO_LARGE, &desc), text, &needed, &limit), 2);
    assert_true(limit == given);
    /* below a quarter of what is needed, the flops are those of minimum degree: the same to 5 % on a soup */
    assert_true(fabs(needed - flops) <= 0.5 + 0.05 * flops);
  }
  assert_true(fabs(needed - flops) <= 0.5);
#ifndef HF_EMULATED
  /* far below what is needed, the ordering does not begin either */
  double fraction = 1;
  assert_ok(hf_progress_create(&desc.progress));
  desc.work_limit_gflop = 1;
  refused(HF_ERROR_TOO_LARGE, &desc);
  assert_ok(hf_progress_get_fraction(desc.progress, &fraction));
  assert_true(fraction <= 0.25); /* the operator stands; after the ordering it is 0.56 */
  hf_progress_destroy(desc.progress);
  desc.progress = NULL;
#endif
  desc.work_limit_gflop = (uint32_t)ceil(flops);
  assert_ok(hf_surface_create(&desc, &surface));
  assert_true(fabs(1e-9 * statistics_of(surface).factor_flops - flops) <= 1e-9 * flops);
  hf_surface_destroy(surface);
  assert_int_equal(counter.live_blocks, 0);
}

static void a_memory_limit_counts_the_factor_before_it_is_made(void** state) {
  (void)state;
  const double mebibyte = 1048576;
  hf_surface_desc desc = soup();
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  const hf_surface_statistics whole = statistics_of(surface);
  hf_surface_destroy(surface);
  const char* text = "the factor needs %lf MiB more, and memory_limit_mb leaves %lf MiB";
  double needed = 0, room = 0;
  desc.memory_limit_mb = (uint32_t)(whole.factor_bytes / mebibyte);
  counter.peak_bytes = 0;
  assert_int_equal(sscanf(refused(HF_ERROR_OUT_OF_MEMORY, &desc), text, &needed, &room), 2);
  assert_true(needed > room && room < desc.memory_limit_mb);
  /* the numbers and the updates of a factorisation under way */
  assert_true(needed >= 8 * whole.factor_entries / mebibyte && needed <= ceil(whole.peak_memory_bytes / mebibyte));
  assert_true((double)counter.peak_bytes < 8 * whole.factor_entries); /* none of it was asked for */
  const uint32_t used = desc.memory_limit_mb - (uint32_t)room;
  desc.memory_limit_mb = used + (uint32_t)needed - 2; /* just below: the limit leaves whole MiB, rounded */
  assert_int_equal(sscanf(refused(HF_ERROR_OUT_OF_MEMORY, &desc), text, &needed, &room), 2);
  assert_true(needed > room && needed - room <= 2);
  desc.memory_limit_mb = (uint32_t)ceil(whole.peak_memory_bytes / mebibyte);
  assert_ok(hf_surface_create(&desc, &surface));
  hf_surface_destroy(surface);
  assert_int_equal(counter.live_blocks, 0);
}

/* L M^-1 L of a soup has nearly all entries: the work of L alone is counted, and refuses it. */
static void a_work_limit_refuses_a_biharmonic_operator_before_it_is_formed(void** state) {
  (void)state;
  hf_surface_desc desc = soup();
  desc.work_limit_gflop = 1;
  desc.field_kind = HF_FIELD_BIHARMONIC;
  const char* text = "the factorisation takes %lf * 10^9 operations, and the work_limit_gflop is %lf";
  double needed = 0, limit = 0;
  counter.peak_bytes = 0;
  assert_int_equal(sscanf(refused(HF_ERROR_TOO_LARGE, &desc), text, &needed, &limit), 2);
  assert_true(needed > 1 && limit == 1);
  assert_true((double)counter.peak_bytes < 24e6); /* formed, it takes 108 MB and more */
  /* a sound surface takes both factors */
  Surface sheet = surface_sheet(40, 40);
  hf_surface_desc small = options_of(&sheet).surface;
  small.work_limit_gflop = 1;
  hf_surface surface = NULL;
  hf_solver solver = NULL;
  hf_solver_desc thin = HF_INIT(hf_solver_desc);
  thin.field_kind = HF_FIELD_BIHARMONIC;
  assert_ok(hf_surface_create(&small, &surface));
  assert_ok(hf_create(surface, &thin, &solver));
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

int main(void) {
  places = surface_sheet(COLUMNS, ROWS);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_work_limit_is_kept),
      cmocka_unit_test(a_memory_limit_counts_the_factor_before_it_is_made),
      cmocka_unit_test(a_work_limit_refuses_a_biharmonic_operator_before_it_is_formed),
  };
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  surface_free(&places);
  return failed;
}
