/* The host's own state before and after everything the library does: floating-point environment, rand(), locale,
 * signals, descriptors, threads, standard streams, stack. */
#define _GNU_SOURCE
#include <fenv.h>
#include <locale.h>
#include <pthread.h>
/* what a host can look at of itself: its signals, descriptors, threads and traps */
#if defined(__linux__)
#include <dirent.h>
#include <signal.h>
#include <unistd.h>
#define LINUX 1
#else
#define LINUX 0
#endif

#include "api_support.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

enum { AROUND = 12, RINGS = 20, VERTICES = AROUND * RINGS };

/* What one run of everything computes. */
typedef struct Work {
  double field[VERTICES];
  float posed[3 * VERTICES], normals[3 * VERTICES], transferred[3 * VERTICES];
  hf_result worst;
} Work;

static void note(Work* w, hf_result result) {
  if (result != HF_OK && w->worst == HF_OK) w->worst = result;
}

/* Everything once, without assertions, so that it may run on any thread and under any host state. */
static void work_with(Work* w, int32_t engine, int32_t ordering, uint32_t threads, const hf_job_runner* runner) {
  Surface tube = surface_tube(AROUND, RINGS);
  Options desc = options_of(&tube);
  desc.engine = engine;
  desc.surface.ordering = ordering;
  desc.surface.thread_count = threads;
  if (runner) desc.surface.job_runner = *runner;
  hf_surface surface = NULL;
  hf_solver solver = NULL, copy = NULL;
  note(w, make(&desc, &surface, &solver));
  const uint32_t vertices[3] = {0, 100, VERTICES - 1};
  const double values[3] = {0, 0.3, 1};
  uint32_t sites[3], handles[2];
  hf_sites_desc batch = sites_at(3, vertices, values);
  note(w, hf_add_sites(solver, &batch, sites));
  note(w, hf_solver_clone(solver, &copy));
  note(w, hf_remove_sites(copy, 1, sites));
  note(w, hf_solver_solve(solver, OUT(w->field), NULL));
  hf_add_sites(solver, &batch, NULL); /* a failure: formats a message */
  hf_pose pose = NULL;
  hf_transfer transfer = NULL;
  if (engine == ENGINE_GREEN) {
    uint32_t* ends = tube_ends(AROUND, RINGS);
    const uint32_t counts[2] = {2 * AROUND, 2 * AROUND};
    hf_handles_desc regions = HF_INIT(hf_handles_desc);
    regions.handle_count = 2;
    regions.region_counts = counts;
    regions.region_vertices = ends;
    note(w, hf_pose_create(surface, NULL, &pose));
    note(w, hf_pose_add_handles(pose, &regions, handles));
    const hf_transform turned = {{0, 0.5, 0, 0.8660254}, {1, 2, 3}};
    note(w, hf_pose_set_transforms(pose, 1, &handles[1], &turned));
    hf_deform_desc deform = HF_INIT(hf_deform_desc);
    deform.positions = ROWS_OUT(w->posed);
    deform.normals = ROWS_OUT(w->normals);
    note(w, hf_pose_deform(pose, &deform, NULL));
    hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
    pairs.pair_count = 2;
    pairs.source_counts = pairs.target_counts = counts;
    pairs.source_vertices = pairs.target_vertices = ends;
    note(w, hf_transfer_create(surface, surface, NULL, &transfer));
    note(w, hf_transfer_add_pairs(transfer, &pairs, NULL));
    hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
    frame.source_positions = HF_ARRAY(w->posed, VERTICES);
    frame.target_positions = ROWS_OUT(w->transferred);
    note(w, hf_transfer_apply(transfer, &frame));
    free(ends);
  }
  hf_pose_destroy(pose);
  hf_transfer_destroy(transfer);
  hf_solver_destroy(copy);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&tube);
}

static void work(Work* w) {
  memset(w, 0, sizeof *w);
  work_with(w, ENGINE_REFACTOR, HF_ORDERING_MINIMUM_DEGREE, 1, NULL);
  if (has_gpl()) work_with(w, ENGINE_UPDOWN, HF_ORDERING_METIS, 1, NULL);
  work_with(w, ENGINE_GREEN, HF_ORDERING_NESTED_DISSECTION, 1, NULL);
}

#if LINUX
static unsigned entries(const char* folder) {
  unsigned count = 0;
  DIR* d = opendir(folder);
  assert_non_null(d);
  while (readdir(d)) ++count;
  closedir(d);
  return count;
}
#else
static unsigned entries(const char* folder) {
  (void)folder;
  return 0;
}
#endif

static Work expected;
static unsigned threads_at_start, threads_after_own_engines;

static int create_expected(void** state) {
  (void)state;
  /* before anything else has run: Debian's CHOLMOD keeps OpenMP threads of its own once ENGINE_UPDOWN was used */
  threads_at_start = entries("/proc/self/task");
  work_with(&expected, ENGINE_REFACTOR, HF_ORDERING_MINIMUM_DEGREE, 1, NULL);
  work_with(&expected, ENGINE_GREEN, HF_ORDERING_NESTED_DISSECTION, 1, NULL);
  threads_after_own_engines = entries("/proc/self/task");
  work(&expected);
  return expected.worst;
}
#define assert_same_work(w) assert_true(same_bits(&(w), &expected, sizeof expected))

static void rounding_modes_are_kept_and_do_not_matter(void** state) {
  (void)state;
  const int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  Surface tube = surface_tube(AROUND, RINGS);
  double fields[COUNT_OF(modes)][VERTICES];
  for (size_t m = 0; m < COUNT_OF(modes); ++m) {
    const Options desc = options_of(&tube);
    const uint32_t vertices[2] = {0, VERTICES - 1};
    const double values[2] = {0.1, 1};
    const hf_sites_desc sites = sites_at(2, vertices, values);
    hf_solver solver = NULL;
    hf_result results[3];
    int after[4];
    assert_int_equal(fesetround(modes[m]), 0);
    results[0] = make(&desc, NULL, &solver);
    after[0] = fegetround();
    results[1] = hf_add_sites(solver, &sites, NULL);
    after[1] = fegetround();
    results[2] = hf_solver_solve(solver, OUT(fields[m]), NULL);
    after[2] = fegetround();
    hf_solver_destroy(solver);
    after[3] = fegetround();
    fesetround(FE_TONEAREST);
    for (int i = 0; i < 3; ++i) assert_int_equal(results[i], HF_OK);
    for (int i = 0; i < 4; ++i) assert_int_equal(after[i], modes[m]);
    assert_true(same_bits(fields[m], fields[0], sizeof fields[0]));
  }
  surface_free(&tube);
}

#if defined(__SSE2__)
/* valgrind does all arithmetic with the default settings, and keeps neither flags nor traps: what is said of them
 * cannot be tested there. */
static void skip_where_float_settings_are_not_kept(void) {
  feclearexcept(FE_ALL_EXCEPT);
  volatile double third = 1;
  third /= 3;
  const int kept = fetestexcept(FE_INEXACT) != 0;
  feclearexcept(FE_ALL_EXCEPT);
  if (kept) return;
  print_message("no floating-point flags here (valgrind?): skipped\n");
  skip();
}

/* The work of a host that flushes subnormals: the same bits, and its control word as it was after every call. */
static void flush_to_zero_is_kept_and_does_not_matter(void** state) {
  (void)state;
  skip_where_float_settings_are_not_kept();
  static Work done;
  const unsigned host = _mm_getcsr(), flushing = host | 0x8040u;
  _mm_setcsr(flushing);
  work(&done);
  const unsigned after = _mm_getcsr();
  _mm_setcsr(host);
  assert_int_equal(after & 0xFFC0u,
                   flushing & 0xFFC0u); /* masks, rounding, FTZ, DAZ; not the sticky flags our own cosf may raise */
  assert_same_work(done);
}

static void sticky_flags_are_kept(void** state) {
  (void)state;
  skip_where_float_settings_are_not_kept();
  Surface tube = surface_tube(4, 4);
  Options desc = options_of(&tube);
  hf_solver solver = NULL;
  for (int raised = 0; raised < 2; ++raised) {
    feclearexcept(FE_ALL_EXCEPT);
    if (raised) feraiseexcept(FE_INVALID);
    const unsigned before = _mm_getcsr();
    assert_ok(make(&desc, NULL, &solver));
    const unsigned after = _mm_getcsr();
    assert_int_equal(before, after);
    assert_int_equal(fetestexcept(FE_ALL_EXCEPT) & FE_INVALID, raised ? FE_INVALID : 0);
    hf_solver_destroy(solver);
  }
  surface_free(&tube);
}
#endif

#if LINUX && defined(__SSE2__)
static void floating_point_traps_of_the_host_do_not_strike(void** state) {
  (void)state;
  skip_where_float_settings_are_not_kept();
  Surface tube = surface_tube(AROUND, RINGS);
  /* needles and points: zero areas divide by zero inside */
  for (int i = 0; i < 30; ++i) {
    tube.positions[3 * i + 90] = 0;
    tube.positions[3 * i + 91] = 1e-30f * (float)i;
    tube.positions[3 * i + 92] = 0;
  }
  Options desc = options_of(&tube);
  hf_solver solver = NULL;
  static double field[VERTICES];
  const uint32_t vertices[2] = {0, VERTICES - 1};
  const double values[2] = {1e-310, 1e200}; /* subnormal and huge */
  const hf_sites_desc sites = sites_at(2, vertices, values);
  feclearexcept(FE_ALL_EXCEPT);
  const int traps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT;
  feenableexcept(traps);
  const hf_result made = make(&desc, NULL, &solver), added = hf_add_sites(solver, &sites, NULL),
                  solved = hf_solver_solve(solver, OUT(field), NULL);
  const int still = fegetexcept();
  fedisableexcept(traps);
  assert_int_equal(made, HF_OK);
  assert_int_equal(added, HF_OK);
  assert_int_equal(solved, HF_OK);
  assert_int_equal(still, traps);
  for (int v = 0; v < VERTICES; ++v) assert_true(isfinite(field[v]));
  hf_solver_destroy(solver);
  surface_free(&tube);
}
#endif

static void random_numbers_of_the_host_are_not_drawn(void** state) {
  (void)state;
  static Work done;
  int plain[8];
  srand(7);
  for (int i = 0; i < 8; ++i) plain[i] = rand();
  srand(7);
  for (int i = 0; i < 8; ++i) {
    if (i == 3) work(&done);
    assert_int_equal(rand(), plain[i]);
  }
#if LINUX
  long wide[8];
  srand48(7);
  for (int i = 0; i < 8; ++i) wide[i] = lrand48();
  srand48(7);
  for (int i = 0; i < 8; ++i) {
    if (i == 3) work(&done);
    assert_int_equal(lrand48(), wide[i]);
  }
#endif
}

#if LINUX
static void signals_locale_descriptors_and_threads_are_as_before(void** state) {
  (void)state;
  static Work done;
  struct sigaction before[65], after;
  sigset_t mask_before, mask_after;
  memset(before, 0, sizeof before);
  for (int s = 1; s < 65; ++s) sigaction(s, NULL, &before[s]);
  pthread_sigmask(SIG_BLOCK, NULL, &mask_before);
  char* locale = strdup(setlocale(LC_ALL, NULL));
  const unsigned descriptors = entries("/proc/self/fd"), threads = entries("/proc/self/task");
  work(&done);
  memset(&mask_after, 0, sizeof mask_after);
  pthread_sigmask(SIG_BLOCK, NULL, &mask_after);
  for (int s = 1; s < 65; ++s) {
    if (sigaction(s, NULL, &after) != 0) continue;
    assert_true(after.sa_handler == before[s].sa_handler && after.sa_flags == before[s].sa_flags);
    assert_int_equal(sigismember(&mask_before, s), sigismember(&mask_after, s));
  }
  assert_string_equal(setlocale(LC_ALL, NULL), locale);
  assert_int_equal(entries("/proc/self/fd"), descriptors);
  assert_int_equal(entries("/proc/self/task"), threads);
  free(locale);
}

static void no_thread_is_started_that_was_not_granted(void** state) {
  (void)state;
  assert_int_equal(threads_after_own_engines, threads_at_start);
}

static void granted_threads_end_with_their_solver(void** state) {
  (void)state;
  const unsigned threads = entries("/proc/self/task");
  Surface tube = surface_tube(AROUND, RINGS);
  Options desc = options_of(&tube);
  desc.surface.thread_count = 4;
  hf_solver solver = NULL;
  assert_ok(make(&desc, NULL, &solver));
  assert_true(entries("/proc/self/task") <= threads + 3);
  hf_solver_destroy(solver);
  surface_free(&tube);
  for (int wait = 0; wait < 200 && entries("/proc/self/task") != threads; ++wait)
    usleep(5000); /* the kernel lists joined threads a moment longer */
  assert_int_equal(entries("/proc/self/task"), threads);
}

static void nothing_is_printed(void** state) {
  (void)state;
  static Work done;
  char name[] = "hf_host_test_XXXXXX";
  const int file = mkstemp(name), out = dup(1), err = dup(2);
  assert_true(file >= 0 && out >= 0 && err >= 0);
  unlink(name);
  fflush(stdout);
  fflush(stderr);
  dup2(file, 1);
  dup2(file, 2);
  work(&done);
  for (hf_result code = -400; code <= 0; ++code) hf_result_get_name(code);
  hf_create(NULL, NULL, NULL);
  hf_surface_create(NULL, NULL);
  hf_solve(NULL, NULL, 0, NULL);
  hf_solver_destroy(NULL);
  fflush(stdout);
  fflush(stderr);
  dup2(out, 1);
  dup2(err, 2);
  const off_t printed = lseek(file, 0, SEEK_END);
  close(file);
  close(out);
  close(err);
  assert_int_equal(printed, 0);
}
#endif

static void* work_on_thread(void* done) {
  work(done);
  return NULL;
}

static void a_stack_of_256_kilobytes_is_enough(void** state) {
  (void)state;
  static Work done;
  pthread_attr_t attributes;
  pthread_t thread;
  pthread_attr_init(&attributes);
  assert_int_equal(pthread_attr_setstacksize(&attributes, 256 * 1024), 0);
  assert_int_equal(pthread_create(&thread, &attributes, work_on_thread, &done), 0);
  pthread_join(thread, NULL);
  pthread_attr_destroy(&attributes);
  assert_same_work(done);
}

/* A host's job system: indices from last to first, some of them on another thread. */
typedef struct HostJobs {
  unsigned batches, jobs;
} HostJobs;
typedef struct HostBatch {
  uint32_t count;
  void (*job)(void*, uint32_t);
  void* data;
} HostBatch;
static void* host_odd_jobs(void* user) {
  const HostBatch* b = user;
  for (uint32_t i = 1; i < b->count; i += 2) b->job(b->data, i);
  return NULL;
}
static void host_run(void* user, uint32_t count, void (*job)(void*, uint32_t), void* data) {
  HostJobs* jobs = user;
  HostBatch batch = {count, job, data};
  pthread_t thread;
  ++jobs->batches;
  jobs->jobs += count;
  const int threaded = pthread_create(&thread, NULL, host_odd_jobs, &batch) == 0;
  for (uint32_t i = (count + 1) / 2; i-- > 0;) job(data, 2 * i);
  if (threaded)
    pthread_join(thread, NULL);
  else
    host_odd_jobs(&batch);
}

static void threads_and_job_runners_give_the_same_bits(void** state) {
  (void)state;
  static Work done;
  for (uint32_t threads = 1; threads <= 8; ++threads) {
    memset(&done, 0, sizeof done);
    work_with(&done, ENGINE_GREEN, HF_ORDERING_NESTED_DISSECTION, threads, NULL);
    assert_same_work(done);
  }
  HostJobs jobs = {0, 0};
  const hf_job_runner runner = {host_run, &jobs};
  memset(&done, 0, sizeof done);
  work_with(&done, ENGINE_GREEN, HF_ORDERING_NESTED_DISSECTION, 2, &runner);
  assert_same_work(done);
}

/* A surface large enough to be cut into pieces everywhere. */
static void a_large_surface_gives_the_same_bits_on_any_threads(void** state) {
  (void)state;
  Surface sheet = surface_sheet(220, 180);
  double* reference = NULL;
  HostJobs jobs = {0, 0};
  for (int variant = 0; variant < 4; ++variant) {
    Options desc = options_of(&sheet);
    desc.surface.thread_count = variant == 0 ? 1 : variant == 1 ? 2 : 5;
    if (variant == 3) {
      desc.surface.job_runner.run = host_run;
      desc.surface.job_runner.user = &jobs;
    }
    hf_solver solver = NULL;
    assert_ok(make(&desc, NULL, &solver));
    for (uint32_t i = 0; i < 25; ++i) add_site(solver, i * 1500, (double)(i % 6));
    double* field = field_of(solver, sheet.vertex_count);
    if (reference) {
      assert_true(same_bits(field, reference, sizeof(double) * sheet.vertex_count));
      free(field);
    } else
      reference = field;
    hf_solver_destroy(solver);
  }
  assert_true(jobs.batches > 0 && jobs.jobs > jobs.batches);
  free(reference);
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(rounding_modes_are_kept_and_do_not_matter),
#if defined(__SSE2__)
    cmocka_unit_test(flush_to_zero_is_kept_and_does_not_matter),
    cmocka_unit_test(sticky_flags_are_kept),
#endif
#if LINUX && defined(__SSE2__)
    cmocka_unit_test(floating_point_traps_of_the_host_do_not_strike),
#endif
    cmocka_unit_test(random_numbers_of_the_host_are_not_drawn),
#if LINUX
    cmocka_unit_test(signals_locale_descriptors_and_threads_are_as_before),
    cmocka_unit_test(no_thread_is_started_that_was_not_granted),
    cmocka_unit_test(granted_threads_end_with_their_solver),
    cmocka_unit_test(nothing_is_printed),
#endif
    cmocka_unit_test(a_stack_of_256_kilobytes_is_enough),
    cmocka_unit_test(threads_and_job_runners_give_the_same_bits),
    cmocka_unit_test(a_large_surface_gives_the_same_bits_on_any_threads),
  };
  return cmocka_run_group_tests(tests, create_expected, NULL);
}
