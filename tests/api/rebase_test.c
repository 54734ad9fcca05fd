/* Discs and rebases through the ABI: a solver that is edited and solved on one thread while another prepares a rebase
 * answers every call, and the statistics say what was decided. */
#define _POSIX_C_SOURCE 200112L
#include <pthread.h>

#include "api_support.h"

enum { COLUMNS = 60, ROWS_ = 50, VERTICES = (COLUMNS + 1) * (ROWS_ + 1) };

static hf_solver_statistics statistics_of(hf_solver solver) {
  hf_solver_statistics statistics = HF_INIT(hf_solver_statistics);
  assert_ok(hf_solver_get_statistics(solver, &statistics));
  return statistics;
}

static hf_result prepared;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int finished;
static int is_finished(void) {
  pthread_mutex_lock(&lock);
  const int now = finished;
  pthread_mutex_unlock(&lock);
  return now;
}
static void* prepare(void* solver) {
  for (int i = 0; i < 4; ++i) prepared = prepared == HF_OK ? hf_solver_prepare_rebase(solver) : prepared;
  pthread_mutex_lock(&lock);
  finished = 1;
  pthread_mutex_unlock(&lock);
  return NULL;
}

static void edits_and_fields_go_on_while_a_rebase_is_prepared(void** state) {
  (void)state;
  Surface sheet = surface_sheet(COLUMNS, ROWS_);
  hf_solver solver = surface_solver(&sheet);
  for (uint32_t i = 0; i < 100; ++i) add_site(solver, 31 * i, (double)(i % 7));
  double* before = field_of(solver, VERTICES);
  pthread_t thread;
  prepared = HF_OK, finished = 0;
  assert_int_equal(pthread_create(&thread, NULL, prepare, solver), 0);
  for (uint32_t round = 0; !is_finished() && round < 3000; ++round) {
    const uint32_t site = add_site(solver, 31 * (round % 90) + 5, 2.5);
    double* field = field_of(solver, VERTICES);
    assert_true(field[31 * (round % 90) + 5] == 2.5);
    free(field);
    assert_ok(hf_remove_sites(solver, 1, &site));
  }
  pthread_join(thread, NULL);
  assert_ok(prepared);
  const uint32_t site = add_site(solver, 5, 1.0); /* takes it over */
  assert_ok(hf_remove_sites(solver, 1, &site));
  const hf_solver_statistics statistics = statistics_of(solver);
  assert_true(statistics.rebase_count >= 1);
  assert_int_equal(statistics.eliminated_count, 100);
  assert_int_equal(statistics.last_route, HF_ROUTE_DENSE);
  double* after = field_of(solver, VERTICES);
  for (uint32_t v = 0; v < VERTICES; ++v) assert_true(fabs(before[v] - after[v]) <= 1e-11);
  free(before), free(after);
  hf_solver_destroy(solver);
  surface_free(&sheet);
}

static void a_rebase_needs_a_solver_with_hard_sites(void** state) {
  (void)state;
  Surface sheet = surface_sheet(8, 8);
  hf_solver solver = surface_solver(&sheet);
  assert_code(HF_ERROR_NO_SITES, hf_solver_prepare_rebase(solver));
  assert_code(HF_ERROR_INVALID_HANDLE, hf_solver_prepare_rebase(NULL));
  hf_solver_destroy(solver);
  Options desc = options_of(&sheet);
  desc.solver.engine = HF_ENGINE_REFACTOR;
  assert_ok(make(&desc, NULL, &solver));
  add_site(solver, 3, 1);
  assert_code(HF_ERROR_UNSUPPORTED, hf_solver_prepare_rebase(solver));
  hf_solver_destroy(solver);
  surface_free(&sheet);
}

static void a_disc_is_one_site(void** state) {
  (void)state;
  Surface sheet = surface_sheet(COLUMNS, ROWS_);
  hf_solver solver = surface_solver(&sheet);
  const uint32_t vertices[2] = {20 * (COLUMNS + 1) + 15, 30 * (COLUMNS + 1) + 45};
  const double values[2] = {0, 1}, radii[2] = {4.5, 0};
  uint32_t numbers[2];
  hf_sites_desc sites = sites_at(2, vertices, values);
  sites.radii = radii;
  assert_ok(hf_add_sites(solver, &sites, numbers));
  assert_int_equal(hf_solver_get_site_count(solver), 2);
  double* field = field_of(solver, VERTICES);
  assert_true(fabs(field[vertices[0] + 3]) <= 1e-12 && fabs(field[vertices[0] - 3 * (COLUMNS + 1)]) <= 1e-12);
  assert_true(field[vertices[0] + 8] > 1e-3);
  free(field);
  double got_radii[2], flux[2];
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = 2, info.radii = got_radii, info.flux = flux;
  assert_ok(hf_solver_get_sites(solver, &info));
  assert_true(got_radii[0] == 4.5 && got_radii[1] == 0);
  assert_true(fabs(flux[0] + flux[1]) <= 1e-10 && flux[1] > 0.1);
  assert_code(HF_ERROR_NO_SUCH_SITE, hf_remove_sites(solver, 1, (const uint32_t[]){numbers[0] + 2})); /* of the disc */
  const uint32_t inside = vertices[0] + 1;
  sites = sites_at(1, &inside, values + 1);
  assert_code(HF_ERROR_CONFLICT, hf_add_sites(solver, &sites, NULL));
  const double negative = -1;
  sites.radii = &negative;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_add_sites(solver, &sites, NULL));
  assert_code(HF_ERROR_INVALID_ARGUMENT,
              hf_solver_move_sites(solver, 1, numbers, &sites)); /* a radius cannot be moved to */
  const uint32_t there = vertices[0] + 2 * (COLUMNS + 1) + 2;
  sites = sites_at(1, &there, NULL);
  assert_ok(hf_solver_move_sites(solver, 1, numbers, &sites));
  assert_ok(hf_remove_sites(solver, 2, numbers));
  assert_int_equal(statistics_of(solver).dense_row_count, 0);
  hf_solver_destroy(solver);
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edits_and_fields_go_on_while_a_rebase_is_prepared),
      cmocka_unit_test(a_rebase_needs_a_solver_with_hard_sites),
      cmocka_unit_test(a_disc_is_one_site),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
