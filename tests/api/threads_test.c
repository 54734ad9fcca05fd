/* Threads: different handles at once, readers of one handle at once, and a change that overlaps is refused with
 * HF_ERROR_BUSY or done as if alone, never half. */
#define _POSIX_C_SOURCE 200112L
#include <pthread.h>
#include <time.h>

#include "api_support.h"

enum { COLUMNS = 30, ROWS_ = 24, VERTICES = (COLUMNS + 1) * (ROWS_ + 1), THREADS = 8, ROUNDS = 60 };

static Surface sheet;

typedef struct Worker {
  pthread_t thread;
  unsigned number, done, busy, wrong;
  hf_solver solver;
  const double* expected;
} Worker;

static void run_workers(Worker* workers, unsigned count, void* (*body)(void*)) {
  for (unsigned i = 0; i < count; ++i) {
    workers[i].number = i;
    assert_int_equal(pthread_create(&workers[i].thread, NULL, body, &workers[i]), 0);
  }
  for (unsigned i = 0; i < count; ++i) pthread_join(workers[i].thread, NULL);
}

static hf_result add_one(hf_solver solver, uint32_t vertex, double value, uint32_t* site) {
  const hf_sites_desc desc = sites_at(1, &vertex, &value);
  return hf_add_sites(solver, &desc, site);
}

/* A fixed sequence of edits and fields; the last field is the result. */
static hf_result edit_and_solve(hf_solver solver, unsigned number, double* field) {
  uint32_t sites[6];
  for (uint32_t i = 0; i < 6; ++i) {
    const hf_result added = add_one(solver, (number * 13 + 71 * i) % VERTICES, (double)i, &sites[i]);
    if (added != HF_OK) return added;
  }
  const hf_result removed = hf_remove_sites(solver, 2, sites + 1);
  return removed != HF_OK ? removed : hf_solver_solve(solver, OUT(field), NULL);
}

static void* own_solver(void* user) {
  Worker* w = user;
  double* field = malloc(sizeof(double) * VERTICES);
  for (int round = 0; round < 6; ++round) {
    const Options desc = options_of(&sheet);
    hf_solver solver = NULL;
    w->wrong += make(&desc, NULL, &solver) != HF_OK || edit_and_solve(solver, w->number, field) != HF_OK;
    w->wrong += !same_bits(field, w->expected + (size_t)VERTICES * w->number, sizeof(double) * VERTICES);
    hf_solver_destroy(solver);
    /* the detail belongs to the thread */
    hf_error_detail detail;
    w->wrong +=
        hf_pose_get_handle(NULL, w->number, NULL) != HF_ERROR_INVALID_OBJECT || hf_error_get_detail(&detail) != HF_OK;
    w->wrong += strcmp(detail.function, "hf_pose_get_handle") != 0;
  }
  free(field);
  return NULL;
}

static void* own_clone(void* user) {
  Worker* w = user;
  double* field = malloc(sizeof(double) * VERTICES);
  for (int round = 0; round < ROUNDS; ++round) {
    hf_solver copy = NULL;
    w->wrong += hf_solver_clone(w->solver, &copy) != HF_OK || edit_and_solve(copy, w->number, field) != HF_OK;
    w->wrong += !same_bits(field, w->expected + (size_t)VERTICES * w->number, sizeof(double) * VERTICES);
    hf_solver_destroy(copy);
  }
  free(field);
  return NULL;
}

static double* expected_fields(void) {
  double* fields = malloc(sizeof(double) * VERTICES * THREADS);
  for (unsigned i = 0; i < THREADS; ++i) {
    hf_solver solver = surface_solver(&sheet);
    assert_ok(edit_and_solve(solver, i, fields + (size_t)VERTICES * i));
    hf_solver_destroy(solver);
  }
  return fields;
}

static void solvers_and_clones_work_on_their_own_threads(void** state) {
  (void)state;
  double* expected = expected_fields();
  hf_solver shared = surface_solver(&sheet);
  void* (*const bodies[])(void*) = {own_solver, own_clone};
  for (size_t b = 0; b < COUNT_OF(bodies); ++b) {
    Worker workers[THREADS];
    memset(workers, 0, sizeof workers);
    for (int i = 0; i < THREADS; ++i) {
      workers[i].solver = shared;
      workers[i].expected = expected;
    }
    run_workers(workers, THREADS, bodies[b]);
    for (int i = 0; i < THREADS; ++i) assert_int_equal(workers[i].wrong, 0);
  }
  hf_solver_destroy(shared);
  free(expected);
}

static void* reader(void* user) {
  Worker* w = user;
  double* field = malloc(sizeof(double) * VERTICES);
  for (int round = 0; round < ROUNDS; ++round) {
    const uint32_t vertices[2] = {5, 300};
    double at[2];
    hf_solver_statistics statistics = HF_INIT(hf_solver_statistics);
    w->wrong += hf_solver_solve(w->solver, OUT(field), NULL) != HF_OK ||
                !same_bits(field, w->expected, sizeof(double) * VERTICES);
    w->wrong += hf_solver_solve_at(w->solver, 2, vertices, at) != HF_OK || fabs(at[1] - w->expected[300]) > 1e-11;
    w->wrong += hf_solver_get_statistics(w->solver, &statistics) != HF_OK || hf_solver_get_site_count(w->solver) != 2;
  }
  free(field);
  return NULL;
}

static void many_threads_may_read_one_solver(void** state) {
  (void)state;
  hf_solver solver = surface_solver(&sheet);
  add_site(solver, 0, 0);
  add_site(solver, VERTICES - 1, 1);
  double* expected = field_of(solver, VERTICES);
  Worker workers[THREADS];
  memset(workers, 0, sizeof workers);
  for (int i = 0; i < THREADS; ++i) {
    workers[i].solver = solver;
    workers[i].expected = expected;
  }
  run_workers(workers, THREADS, reader);
  for (int i = 0; i < THREADS; ++i) assert_int_equal(workers[i].wrong, 0);
  free(expected);
  hf_solver_destroy(solver);
}

/* Odd workers change the site set, even ones read it. Every answer is HF_OK or HF_ERROR_BUSY, every field read is one
 * of a whole set: the pair of sites is always added together, so a field is 0 everywhere or 1 at the second site. */
static void pause_a_moment(void) {
  const struct timespec moment = {0, 200000};
  nanosleep(&moment, NULL);
}

static void* contender(void* user) {
  Worker* w = user;
  double* field = malloc(sizeof(double) * VERTICES);
  for (int round = 0; round < 4 * ROUNDS; ++round) {
    if (w->number % 2) {
      const uint32_t vertices[2] = {w->number * 31, w->number * 31 + 200};
      const double values[2] = {1, 1};
      uint32_t sites[2];
      const hf_sites_desc pair = sites_at(2, vertices, values);
      hf_result result = hf_add_sites(w->solver, &pair, sites);
      w->wrong += result != HF_OK && result != HF_ERROR_BUSY;
      w->busy += result == HF_ERROR_BUSY;
      pause_a_moment();
      if (result != HF_OK) continue;
      ++w->done;
      while ((result = hf_remove_sites(w->solver, 2, sites)) == HF_ERROR_BUSY) ++w->busy;
      w->wrong += result != HF_OK;
    } else {
      const hf_result result = hf_solver_solve(w->solver, OUT(field), NULL);
      pause_a_moment();
      w->wrong += result != HF_OK && result != HF_ERROR_BUSY;
      w->wrong += hf_solver_get_site_count(w->solver) % 2 != 0;
      w->busy += result == HF_ERROR_BUSY;
      w->done += result == HF_OK;
      for (unsigned other = 1; result == HF_OK && other < THREADS; other += 2) {
        w->wrong += (field[other * 31] == 1) != (field[other * 31 + 200] == 1);
      }
    }
  }
  free(field);
  return NULL;
}

static void an_overlapping_change_is_busy_or_whole(void** state) {
  (void)state;
  hf_solver solver = surface_solver(&sheet);
  add_site(solver, 8, 0);
  add_site(solver, VERTICES - 1, 0.5);
  double* before = field_of(solver, VERTICES);
  Worker workers[THREADS];
  memset(workers, 0, sizeof workers);
  for (int i = 0; i < THREADS; ++i) workers[i].solver = solver;
  run_workers(workers, THREADS, contender);
  unsigned read = 0, changed = 0, busy = 0;
  for (int i = 0; i < THREADS; ++i) {
    assert_int_equal(workers[i].wrong, 0);
    busy += workers[i].busy;
    if (i % 2)
      changed += workers[i].done;
    else
      read += workers[i].done;
  }
  print_message("%u fields read, %u changes made, %u calls busy\n", read, changed, busy);
  assert_true(read > 0 && changed > 0);
  assert_int_equal(hf_solver_get_site_count(solver), 2);
  double* after = field_of(solver, VERTICES);
  for (int v = 0; v < VERTICES; ++v) assert_true(fabs(before[v] - after[v]) < 1e-12);
  free(before);
  free(after);
  hf_solver_destroy(solver);
}

/* Busy for certain: the second thread calls while the first is held inside an allocation. */
typedef struct Gate {
  CountingAllocator memory;
  hf_allocator inner;
  pthread_mutex_t mutex;
  pthread_cond_t changed;
  int armed, inside, released;
} Gate;
static void* gate_allocate(void* user, size_t size, size_t alignment) {
  Gate* g = user;
  pthread_mutex_lock(&g->mutex);
  if (g->armed) {
    g->armed = 0;
    g->inside = 1;
    pthread_cond_broadcast(&g->changed);
    while (!g->released) pthread_cond_wait(&g->changed, &g->mutex);
  }
  void* block = g->inner.allocate(&g->memory, size, alignment);
  pthread_mutex_unlock(&g->mutex);
  return block;
}
static void gate_release(void* user, void* block, size_t size, size_t alignment) {
  Gate* g = user;
  pthread_mutex_lock(&g->mutex);
  g->inner.release(&g->memory, block, size, alignment);
  pthread_mutex_unlock(&g->mutex);
}
static void* held_add(void* user) {
  Worker* w = user;
  uint32_t site;
  w->wrong += add_one(w->solver, 333, 4, &site) != HF_OK;
  return NULL;
}
static void* held_solve(void* user) {
  Worker* w = user;
  const uint32_t vertex = 333;
  double value;
  w->wrong += hf_solver_solve_at(w->solver, 1, &vertex, &value) != HF_OK;
  return NULL;
}

static void hold_a_call(Gate* gate, Worker* w, void* (*body)(void*)) {
  gate->armed = 1;
  gate->inside = gate->released = 0;
  assert_int_equal(pthread_create(&w->thread, NULL, body, w), 0);
  pthread_mutex_lock(&gate->mutex);
  while (!gate->inside) pthread_cond_wait(&gate->changed, &gate->mutex);
  pthread_mutex_unlock(&gate->mutex);
}
static void let_it_go(Gate* gate, Worker* w) {
  pthread_mutex_lock(&gate->mutex);
  gate->released = 1;
  pthread_cond_broadcast(&gate->changed);
  pthread_mutex_unlock(&gate->mutex);
  pthread_join(w->thread, NULL);
  assert_int_equal(w->wrong, 0);
}

static void calls_during_a_change_are_busy_and_destroy_waits_for_it(void** state) {
  (void)state;
  Gate gate;
  memset(&gate, 0, sizeof gate);
  gate.inner = counting_hooks(&gate.memory);
  pthread_mutex_init(&gate.mutex, NULL);
  pthread_cond_init(&gate.changed, NULL);
  Options desc = options_of(&sheet);
  desc.surface.allocator.allocate = gate_allocate;
  desc.surface.allocator.release = gate_release;
  desc.surface.allocator.user = &gate;
  hf_surface surface = NULL;
  hf_solver solver = NULL, copy = NULL;
  assert_ok(make(&desc, &surface, &solver));
  const uint32_t site = add_site(solver, 0, 1);
  double* field = malloc(sizeof(double) * VERTICES);
  const double value = 1;
  Worker w;
  memset(&w, 0, sizeof w);
  w.solver = solver;

  hold_a_call(&gate, &w, held_add);
  assert_code(HF_ERROR_BUSY, hf_solver_solve(solver, OUT(field), NULL));
  assert_code(HF_ERROR_BUSY, hf_solver_set_values(solver, 1, &site, &value));
  assert_code(HF_ERROR_BUSY, hf_solver_clone(solver, &copy));
  assert_null(copy);
  assert_code(HF_ERROR_BUSY, hf_solver_set_screening(solver, NULL, NULL));
  assert_int_equal(hf_solver_get_site_count(solver), 1); /* the count of the last finished change */
  let_it_go(&gate, &w);
  assert_int_equal(hf_solver_get_site_count(solver), 2);

  give_kept_back(surface); /* so that the call asks for memory */
  hold_a_call(&gate, &w, held_solve);
  assert_code(HF_ERROR_BUSY, hf_solver_set_values(solver, 1, &site, &value));
  assert_int_equal(hf_solver_get_site_count(solver), 2);
  let_it_go(&gate, &w);
  assert_ok(hf_solver_set_values(solver, 1, &site, &value));

  give_kept_back(surface); /* so that the call asks for memory */
  hold_a_call(&gate, &w, held_solve);
  hf_solver_destroy(solver); /* the call that is under way is finished first */
  assert_code(HF_ERROR_INVALID_OBJECT, hf_solver_release_preview(solver));
  let_it_go(&gate, &w);
  hf_surface_destroy(surface);
  assert_int_equal(gate.memory.live_blocks, 0);
  free(field);
  pthread_mutex_destroy(&gate.mutex);
  pthread_cond_destroy(&gate.changed);
}

/* Handles are made and destroyed everywhere at once; the table stays whole. */
static void* maker(void* user) {
  Worker* w = user;
  for (int round = 0; round < 400; ++round) {
    hf_solver copy = NULL;
    hf_progress progress = NULL;
    double fraction;
    w->wrong += hf_solver_clone(w->solver, &copy) != HF_OK || hf_progress_create(&progress) != HF_OK;
    w->wrong += hf_solver_get_site_count(copy) != 1 || hf_progress_get_fraction(progress, &fraction) != HF_OK;
    hf_solver_destroy(copy);
    hf_progress_destroy(progress);
    w->wrong += hf_solver_release_preview(copy) != HF_ERROR_INVALID_OBJECT ||
                hf_progress_cancel(progress) != HF_ERROR_INVALID_OBJECT;
  }
  return NULL;
}

static void handles_are_made_and_destroyed_on_all_threads(void** state) {
  (void)state;
  hf_solver solver = surface_solver(&sheet);
  add_site(solver, 4, 4);
  Worker workers[THREADS];
  memset(workers, 0, sizeof workers);
  for (int i = 0; i < THREADS; ++i) workers[i].solver = solver;
  run_workers(workers, THREADS, maker);
  for (int i = 0; i < THREADS; ++i) assert_int_equal(workers[i].wrong, 0);
  hf_solver_destroy(solver);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(solvers_and_clones_work_on_their_own_threads),
      cmocka_unit_test(many_threads_may_read_one_solver),
      cmocka_unit_test(an_overlapping_change_is_busy_or_whole),
      cmocka_unit_test(calls_during_a_change_are_busy_and_destroy_waits_for_it),
      cmocka_unit_test(handles_are_made_and_destroyed_on_all_threads),
  };
  sheet = surface_sheet(COLUMNS, ROWS_);
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  surface_free(&sheet);
  return failed;
}
