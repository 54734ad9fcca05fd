/* A struct with a struct_size: NULL, sizes below the released one, absurd sizes, and bytes behind the struct that this
 * version does not know. Zero bytes behind it (a newer header, nothing new used) are accepted. One struct of each way
 * to pass it, on every platform; tests/bindings/bad_calls_test.py has every struct of every function. */
#include "bad_scene.h"

static Scene scene;
static float floats[3 * TUBE_VERTICES];
static const uint32_t free_vertex = 7;

/* For each struct: how to fill a good one, and a call that takes it. */
static void fill_surface(void* d) { *(hf_surface_desc*)d = options_of(&scene.cut).surface; }
static hf_result surface_create(void* d) {
  hf_surface surface = (hf_surface)(void*)&scene;
  const hf_result result = hf_surface_create(d, &surface);
  if (result != HF_OK && surface != NULL) return HF_ERROR_INTERNAL; /* the handle must be NULL after a failure */
  hf_surface_destroy(surface);
  return result;
}
static union {
  double align[4];
  unsigned char bytes[1 << 16];
} saved;
static void fill_factor(void* d) {
  hf_factor_desc* factor = d;
  *factor = HF_INIT(hf_factor_desc);
  factor->bytes = saved.bytes;
  if (hf_surface_save(scene.sheet, HF_FIELD_HARMONIC, NULL, sizeof saved.bytes, saved.bytes, &factor->byte_count) !=
      HF_OK)
    factor->byte_count = 0;
}
static hf_result create_loaded(void* d) {
  hf_surface_desc desc;
  fill_surface(&desc);
  desc.saved_factor = d;
  return surface_create(&desc);
}
static const double origin[3] = {2.2, 1.3, 9}, down[3] = {0, 0, -1};
static void fill_pick(void* d) { *(hf_pick_desc*)d = HF_INIT(hf_pick_desc); }
static hf_result ray_from(void* d) {
  hf_hit hit = HF_INIT(hf_hit);
  return hf_surface_cast_ray(scene.sheet, origin, down, d, &hit);
}
static void fill_certificate(void* d) { *(hf_certificate*)d = HF_INIT(hf_certificate); }
static hf_result certify(void* d) { return hf_solver_certify(scene.solver, d); }
static hf_result plain_deform(void* d) { return hf_deform(scene.pose, floats, d); }
static void fill_places(void* d) { *(hf_sites_desc*)d = sites_at(1, &free_vertex, NULL); }
static hf_result edit_move(void* d) {
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  edit.move_count = 1;
  edit.move_sites = scene.sites + 1;
  edit.move_to = d;
  return hf_solver_edit_sites(scene.solver, &edit, NULL);
}
static void fill_site_info(void* d) {
  *(hf_sites_info*)d = HF_INIT(hf_sites_info);
  ((hf_sites_info*)d)->capacity = 3;
}
static hf_result get_sites(void* d) { return hf_solver_get_sites(scene.solver, d); }

static void fill_deform_info(void* d) { *(hf_deform_info*)d = HF_INIT(hf_deform_info); }

static void fill_weights_out(void* d) { *(hf_weights_out*)d = HF_INIT(hf_weights_out); }
static hf_result weights_get(void* d) { return hf_weights_get(scene.weights, d); }

static const struct {
  const char* what; /* function and argument */
  size_t size;
  void (*fill)(void*);
  hf_result (*call)(void*);
  int optional; /* NULL is allowed */
} structs[] = {
    {"hf_surface_create: desc", sizeof(hf_surface_desc), fill_surface, surface_create, 0},
    {"hf_surface_create: desc->saved_factor", sizeof(hf_factor_desc), fill_factor, create_loaded, 1},
    {"hf_surface_cast_ray: desc", sizeof(hf_pick_desc), fill_pick, ray_from, 1},
    {"hf_solver_certify: inout_certificate", sizeof(hf_certificate), fill_certificate, certify, 0},
    {"hf_deform: out_info", sizeof(hf_deform_info), fill_deform_info, plain_deform, 1},
    {"hf_solver_edit_sites: edit->move_to", sizeof(hf_sites_desc), fill_places, edit_move, 0},
    {"hf_solver_get_sites: out_info", sizeof(hf_sites_info), fill_site_info, get_sites, 0},
    {"hf_weights_get: inout_weights", sizeof(hf_weights_out), fill_weights_out, weights_get, 0},
};

enum { SPACE = 5000 };
static union {
  double align;
  unsigned char bytes[SPACE];
} given;

/* A good struct in the middle of known zero bytes, with another struct_size. */
static void* good(size_t s, uint32_t struct_size) {
  memset(&given, 0, sizeof given);
  structs[s].fill(given.bytes);
  memcpy(given.bytes, &struct_size, sizeof struct_size);
  return given.bytes;
}

static void a_struct_is_checked_before_anything_is_done(void** state) {
  (void)state;
  scene_create(&scene);
  for (size_t s = 0; s < COUNT_OF(structs); ++s) {
    const char* what = structs[s].what;
    const uint32_t size = (uint32_t)structs[s].size;
    const uint32_t refused[] = {0, 1, 4, size / 2, size - 1, SPACE - 1, 0x80000000u, UINT32_MAX};
    if (!structs[s].optional) check_row(__LINE__, "NULL", what, structs[s].call(NULL), HF_ERROR_NULL_POINTER, NO_INDEX);
    for (size_t r = 0; r < COUNT_OF(refused); ++r) {
      check_row(__LINE__, "struct_size wrong", what, structs[s].call(good(s, refused[r])), HF_ERROR_INVALID_DESC,
                NO_INDEX);
    }
    for (uint32_t more = 1; more <= 64; more *= 8) {
      void* longer = good(s, size + more);
      given.bytes[size + more - 1] = 1;
      check_row(__LINE__, "an unknown byte is set", what, structs[s].call(longer), HF_ERROR_INVALID_DESC, NO_INDEX);
    }
    row_holds(
        __LINE__, what, "the state is unchanged",
        solver_unchanged(&scene) && pose_unchanged(&scene) && transfer_unchanged(&scene) && weights_unchanged(&scene));
  }
  finish_rows("structs");
  scene_destroy(&scene);
}

static void a_longer_struct_with_zero_bytes_is_accepted_and_only_its_known_part_is_written(void** state) {
  (void)state;
  for (size_t s = 0; s < COUNT_OF(structs); ++s) {
    scene_create(&scene);
    const uint32_t size = (uint32_t)structs[s].size, longer = size + 24;
    check_row(__LINE__, "zero bytes of a newer version", structs[s].what, structs[s].call(good(s, longer)), HF_OK,
              NO_INDEX);
    uint32_t stored;
    memcpy(&stored, given.bytes, sizeof stored);
    row_holds(__LINE__, structs[s].what, "struct_size is left as it was", stored == longer);
    int written = 0;
    for (uint32_t i = size; i < SPACE; ++i) written |= given.bytes[i];
    row_holds(__LINE__, structs[s].what, "bytes behind the struct are not written", !written);
    scene_destroy(&scene);
  }
  finish_rows("longer structs");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_struct_is_checked_before_anything_is_done),
      cmocka_unit_test(a_longer_struct_with_zero_bytes_is_accepted_and_only_its_known_part_is_written),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
