/* Discs and rebases through the ABI: a solver that is edited and solved on one thread while another prepares a rebase
 * answers every call, and the statistics say what was decided. */
#define _POSIX_C_SOURCE 200112L
#include <pthread.h>

#include "api_support.h"
#include "support/place_in.h"

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
  prepared = HF_OK;
  finished = 0;
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
  free(before);
  free(after);
  hf_solver_destroy(solver);
  surface_free(&sheet);
}

static void a_rebase_needs_a_solver_with_hard_sites(void** state) {
  (void)state;
  Surface sheet = surface_sheet(8, 8);
  hf_solver solver = surface_solver(&sheet);
  assert_code(HF_ERROR_EMPTY, hf_solver_prepare_rebase(solver));
  assert_code(HF_ERROR_INVALID_OBJECT, hf_solver_prepare_rebase(NULL));
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
  info.capacity = 2;
  info.radii = got_radii;
  info.flux = flux;
  assert_ok(hf_solver_get_sites(solver, &info));
  assert_true(got_radii[0] == 4.5 && got_radii[1] == 0);
  assert_true(fabs(flux[0] + flux[1]) <= 1e-10 && flux[1] > 0.1);
  assert_code(HF_ERROR_NOT_FOUND, hf_remove_sites(solver, 1, (const uint32_t[]){numbers[0] + 2})); /* of the disc */
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

/* Everything of a solver that a refused call could have changed. */
typedef struct Seen {
  hf_solver_statistics statistics;
  double memory_bytes;
  double* field;
} Seen;

static double memory_of(hf_surface surface) {
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(surface, &statistics));
  return statistics.memory_bytes;
}

static Seen look(hf_surface surface, hf_solver solver) {
  Seen seen;
  seen.field = field_of(solver, VERTICES); /* first: a solve counts as a sweep */
  seen.statistics = statistics_of(solver);
  seen.memory_bytes = memory_of(surface);
  return seen;
}

static void assert_unchanged(const Seen* before, hf_surface surface, hf_solver solver) {
  const hf_solver_statistics statistics = statistics_of(solver);
  assert_true(memory_of(surface) == before->memory_bytes);
  assert_memory_equal(&statistics, &before->statistics, sizeof statistics);
  double* field = field_of(solver, VERTICES);
  assert_memory_equal(field, before->field, sizeof(double) * VERTICES);
  free(field);
}

#define REFUSED(code, call)                                  \
  do {                                                       \
    Seen before = look(surface, solver);                     \
    assert_code(code, call);                                 \
    assert_unchanged(&before, surface, solver);              \
    assert_int_equal(before.statistics.eliminated_count, 0); \
    free(before.field);                                      \
  } while (0)

static hf_result add_point(hf_solver solver, const uint32_t* corners, const double* weights, double value) {
  const hf_place place = place_in(corners, 1, 0, weights);
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  sites.site_count = 1;
  sites.places = &place;
  sites.values = &value;
  return hf_add_sites(solver, &sites, NULL);
}

static void a_refused_edit_leaves_a_waiting_rebase_where_it_is(void** state) {
  (void)state;
  Surface sheet = surface_sheet(COLUMNS, ROWS_);
  const hf_surface surface = surface_on(&sheet);
  const hf_solver solver = solver_on(surface);
  for (uint32_t i = 0; i < 3; ++i) add_site(solver, sheet.triangles[i], (double)i);
  assert_ok(hf_solver_prepare_rebase(solver));
  const uint32_t first = 0, absent = 77, beyond = VERTICES, taken = sheet.triangles[1];
  const double value = 9, nan = (double)NAN, weights[3] = {0.25, 0.25, 0.5};
  REFUSED(HF_ERROR_NOT_FOUND, hf_solver_set_values(solver, 1, &absent, &value));
  REFUSED(HF_ERROR_NON_FINITE, hf_solver_set_values(solver, 1, &first, &nan));
  REFUSED(HF_ERROR_NOT_FOUND, hf_remove_sites(solver, 1, &absent));
  hf_sites_desc sites = sites_at(1, &beyond, &value);
  REFUSED(HF_ERROR_OUT_OF_RANGE, hf_add_sites(solver, &sites, NULL));
  REFUSED(HF_ERROR_CONFLICT, hf_solver_add_site(solver, taken, &value, NULL));
  sites = sites_at(1, &taken, NULL);
  REFUSED(HF_ERROR_CONFLICT, hf_solver_move_sites(solver, 1, &first, &sites));
  REFUSED(HF_ERROR_CONFLICT, add_point(solver, sheet.triangles, weights, value)); /* the engines refuse this one */
  assert_ok(hf_solver_set_values(solver, 1, &first, &value));                     /* takes it over */
  assert_int_equal(statistics_of(solver).eliminated_count, 3);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

enum { MANY = 220 };

/* Vertices from number `from` on, and the corners of triangle 0. */
static void take_many(const Surface* sheet, uint32_t from, uint32_t* vertices) {
  for (uint32_t i = 0; i < MANY; ++i) vertices[i] = i < 3 ? sheet->triangles[i] : from + i;
}

static void a_point_and_its_corners_are_refused_on_every_route(void** state) {
  (void)state;
  Surface sheet = surface_sheet(COLUMNS, ROWS_);
  const hf_surface surface = surface_on(&sheet);
  const double weights[3] = {0.25, 0.25, 0.5};
  uint32_t vertices[MANY];
  double values[MANY];
  for (uint32_t i = 0; i < MANY; ++i) values[i] = i % 5;
  take_many(&sheet, 1000, vertices);
  /* in one batch: its route is the rebase */
  hf_solver solver = solver_on(surface);
  assert_ok(add_point(solver, sheet.triangles, weights, 1));
  for (uint32_t count = 3; count <= MANY; count = count == 3 ? 100 : count + 20) {
    const hf_sites_desc sites = sites_at(count, vertices, values);
    REFUSED(HF_ERROR_CONFLICT, hf_add_sites(solver, &sites, NULL));
  }
  /* a prepared rebase is taken over by the edit that brings the corners */
  hf_sites_desc others = sites_at(MANY - 3, vertices + 3, values);
  assert_ok(hf_add_sites(solver, &others, NULL));
  const uint32_t eliminated = statistics_of(solver).eliminated_count;
  assert_ok(hf_solver_prepare_rebase(solver));
  const hf_sites_desc corners = sites_at(3, vertices, values);
  Seen before = look(surface, solver);
  assert_code(HF_ERROR_CONFLICT, hf_add_sites(solver, &corners, NULL));
  assert_unchanged(&before, surface, solver);
  assert_int_equal(before.statistics.eliminated_count, eliminated);
  free(before.field);
  const hf_sites_desc two = sites_at(2, vertices, values);
  assert_ok(hf_add_sites(solver, &two, NULL));
  assert_int_equal(statistics_of(solver).eliminated_count, MANY - 3);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edits_and_fields_go_on_while_a_rebase_is_prepared),
      cmocka_unit_test(a_rebase_needs_a_solver_with_hard_sites),
      cmocka_unit_test(a_disc_is_one_site),
      cmocka_unit_test(a_refused_edit_leaves_a_waiting_rebase_where_it_is),
      cmocka_unit_test(a_point_and_its_corners_are_refused_on_every_route),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
