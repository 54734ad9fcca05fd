/* Every kind of handle where another kind is asked for: HF_ERROR_INVALID_OBJECT, and every live object as before. One
 * function of each kind, on every platform; tests/bindings/bad_calls_test.py has every function. */
#include "bad_scene.h"

static Scene scene;

static float floats[3 * TUBE_VERTICES];

/* Everything but the handle is in order. */
static hf_result surface_get_info(void* h) {
  hf_surface_info i = HF_INIT(hf_surface_info);
  return hf_surface_get_info(h, &i);
}
static hf_result solver_get_info(void* h) {
  hf_solver_info i = HF_INIT(hf_solver_info);
  return hf_solver_get_info(h, &i);
}
static hf_result plain_deform(void* h) { return hf_deform(h, floats, NULL); }
static hf_result transfer_from(void* h) {
  hf_transfer out;
  return hf_transfer_create(h, scene.body, NULL, &out);
}
static hf_result transfer_to(void* h) {
  hf_transfer out;
  return hf_transfer_create(scene.body, h, NULL, &out);
}

static hf_result geodesics_distance(void* h) {
  const uint32_t v = 3;
  return hf_geodesics_solve(h, 1, &v, OUT(floats));
}

static hf_result direction_get_statistics(void* h) {
  hf_direction_statistics s = HF_INIT(hf_direction_statistics);
  return hf_direction_get_statistics(h, &s);
}

static hf_result transfer_get_info(void* h) {
  hf_transfer_info i = HF_INIT(hf_transfer_info);
  return hf_transfer_get_info(h, &i);
}

static hf_result weights_get_info(void* h) {
  hf_weights_info info = HF_INIT(hf_weights_info);
  return hf_weights_get_info(h, &info);
}

static hf_result progress_get(void* h) {
  double f;
  return hf_progress_get_fraction(h, &f);
}

enum Kind { SURFACE, SOLVER, POSE, TRANSFER, PROGRESS, GEODESICS, DIRECTION, WEIGHTS, KIND_COUNT };

static const struct {
  const char* function;
  enum Kind kind;
  hf_result (*call)(void* handle);
  uint32_t index;
} functions[] = {
    {"hf_surface_get_info", SURFACE, surface_get_info, NO_INDEX},
    {"hf_solver_get_info", SOLVER, solver_get_info, NO_INDEX},
    {"hf_deform", POSE, plain_deform, NO_INDEX},
    {"hf_transfer_create", SURFACE, transfer_from, 0},
    {"hf_transfer_create", SURFACE, transfer_to, 1},
    {"hf_transfer_get_info", TRANSFER, transfer_get_info, NO_INDEX},
    {"hf_geodesics_solve", GEODESICS, geodesics_distance, NO_INDEX},
    {"hf_direction_get_statistics", DIRECTION, direction_get_statistics, NO_INDEX},
    {"hf_progress_get_fraction", PROGRESS, progress_get, NO_INDEX},
    {"hf_weights_get_info", WEIGHTS, weights_get_info, NO_INDEX},
};

static int unchanged(enum Kind kind) {
  if (kind == WEIGHTS) return weights_unchanged(&scene);
  return solver_unchanged(&scene) &&
         (kind == SURFACE || kind == SOLVER || kind == PROGRESS || kind == GEODESICS || kind == DIRECTION ||
          (kind == POSE ? pose_unchanged(&scene) : transfer_unchanged(&scene)));
}

static void a_function_refuses_every_handle_that_is_not_its_own(void** state) {
  (void)state;
  scene_create(&scene);
  int on_the_stack = 0;
  void* const live[KIND_COUNT] = {scene.sheet,    scene.solver,    scene.pose,      scene.transfer,
                                  scene.progress, scene.geodesics, scene.direction, scene.weights};
  void* const stale[KIND_COUNT] = {scene.stale_surface,   scene.stale_solver,   scene.stale_pose,
                                   scene.stale_transfer,  scene.stale_progress, scene.stale_geodesics,
                                   scene.stale_direction, scene.stale_weights};
  for (size_t f = 0; f < COUNT_OF(functions); ++f) {
    const enum Kind kind = functions[f].kind;
    struct {
      const char* what;
      void* handle;
    } bad[4 + KIND_COUNT] = {{"NULL", NULL},
                             {"destroyed", stale[kind]},
                             {"all bits set", (void*)UINTPTR_MAX},
                             {"the number 1", (void*)(uintptr_t)1},
                             {"a pointer", &on_the_stack}};
    size_t count = 5;
    for (int other = 0; other < KIND_COUNT; ++other) {
      if ((enum Kind)other != kind) {
        bad[count].what = "a live handle of another kind";
        bad[count++].handle = live[other];
      }
    }
    for (size_t b = 0; b < count; ++b) {
      check_row(__LINE__, bad[b].what, functions[f].function, functions[f].call(bad[b].handle), HF_ERROR_INVALID_OBJECT,
                functions[f].index);
    }
    row_holds(__LINE__, functions[f].function, "the live objects are unchanged", unchanged(kind));
  }
  finish_rows("handles");
  scene_destroy(&scene);
}

static void destroying_what_is_no_handle_does_nothing(void** state) {
  (void)state;
  scene_create(&scene);
  void* const bad[] = {NULL,
                       (void*)UINTPTR_MAX,
                       (void*)(uintptr_t)1,
                       &scene,
                       scene.stale_surface,
                       scene.stale_solver,
                       scene.stale_pose,
                       scene.stale_transfer,
                       scene.stale_progress,
                       scene.stale_geodesics,
                       scene.stale_direction,
                       scene.stale_weights};
  for (size_t b = 0; b < COUNT_OF(bad); ++b) {
    hf_solver_destroy(bad[b]);
    hf_pose_destroy(bad[b]);
    hf_transfer_destroy(bad[b]);
    hf_progress_destroy(bad[b]);
    hf_geodesics_destroy(bad[b]);
    hf_direction_destroy(bad[b]);
    hf_surface_destroy(bad[b]);
    hf_weights_destroy(bad[b]);
  }
  void* const live[KIND_COUNT] = {scene.sheet,    scene.solver,    scene.pose,      scene.transfer,
                                  scene.progress, scene.geodesics, scene.direction, scene.weights};
  for (int k = 0; k < KIND_COUNT; ++k) {
    if (k != SURFACE) hf_surface_destroy(live[k]);
    if (k != SOLVER) hf_solver_destroy(live[k]);
    if (k != POSE) hf_pose_destroy(live[k]);
    if (k != TRANSFER) hf_transfer_destroy(live[k]);
    if (k != PROGRESS) hf_progress_destroy(live[k]);
    if (k != GEODESICS) hf_geodesics_destroy(live[k]);
    if (k != DIRECTION) hf_direction_destroy(live[k]);
    if (k != WEIGHTS) hf_weights_destroy(live[k]);
  }
  double fraction;
  assert_ok(geodesics_distance(scene.geodesics));
  assert_ok(surface_get_info(scene.sheet));
  assert_true(solver_unchanged(&scene) && pose_unchanged(&scene) && transfer_unchanged(&scene));
  assert_true(weights_unchanged(&scene));
  assert_ok(hf_progress_get_fraction(scene.progress, &fraction));
  scene_destroy(&scene);
  assert_code(HF_ERROR_INVALID_OBJECT, hf_solver_release_preview(scene.solver));
}

static void counts_of_what_is_no_handle_are_zero(void** state) {
  (void)state;
  scene_create(&scene);
  assert_int_equal(hf_solver_get_site_count(NULL), 0);
  assert_int_equal(hf_direction_get_site_count(NULL), 0);
  assert_int_equal(hf_direction_get_site_count(scene.stale_direction), 0);
  assert_int_equal(hf_direction_get_site_count(scene.direction), 2);
  assert_int_equal(hf_solver_get_site_count((hf_solver)(void*)scene.sheet), 0);
  assert_int_equal(hf_solver_get_site_count(scene.stale_solver), 0);
  assert_int_equal(hf_solver_get_site_count((hf_solver)(void*)scene.pose), 0);
  assert_int_equal(hf_pose_get_handle_count(NULL), 0);
  assert_int_equal(hf_pose_get_handle_count(scene.stale_pose), 0);
  assert_int_equal(hf_pose_get_handle_count((hf_pose)(void*)scene.solver), 0);
  scene_destroy(&scene);
}

static void a_new_object_never_answers_to_an_old_handle(void** state) {
  (void)state;
  Surface sheet = surface_sheet(2, 2);
  hf_solver first = surface_solver(&sheet);
  hf_solver_destroy(first);
  for (int i = 0; i < 1000; ++i) {
    hf_solver next = surface_solver(&sheet);
    assert_ptr_not_equal(next, first);
    assert_code(HF_ERROR_INVALID_OBJECT, hf_solver_release_preview(first));
    hf_solver_destroy(next);
  }
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_function_refuses_every_handle_that_is_not_its_own),
      cmocka_unit_test(destroying_what_is_no_handle_does_nothing),
      cmocka_unit_test(counts_of_what_is_no_handle_are_zero),
      cmocka_unit_test(a_new_object_never_answers_to_an_old_handle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
