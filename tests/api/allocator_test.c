/* The host's allocator: every byte through it, every byte back; and any single allocation may fail, after which the
 * call says HF_ERROR_OUT_OF_MEMORY, nothing has leaked, and the objects are as they were before the call. */
#include "api_support.h"

enum { AROUND = 8, RINGS = 10, VERTICES = AROUND * RINGS };

typedef struct World {
  CountingAllocator memory;
  Surface tube;
  int32_t engine;
  uint32_t threads;
  hf_surface surface, made_surface;
  hf_solver solver, made_solver;
  hf_pose pose, made_pose;
  hf_transfer transfer, made_transfer;
  hf_direction direction, made_direction;
  hf_region region, made_region;
  hf_detail detail, made_detail;
  uint32_t *ends, sites[2], handles[2], pairs[2], constraints[2];
  float posed[3 * VERTICES], result[3 * VERTICES];
  double field[VERTICES];
} World;

/* The scenarios: a call each, from a world that is fully set up. */
static hf_result call_surface(World* w) {
  hf_surface_desc desc = options_of(&w->tube).surface;
  desc.allocator = counting_hooks(&w->memory);
  return hf_surface_create(&desc, &w->made_surface);
}
static hf_result call_surface_save(World* w) { /* makes the factor of another kind */
  size_t size;
  return hf_surface_save(w->surface, HF_FIELD_BIHARMONIC, NULL, 0, NULL, &size);
}
static hf_result call_create(World* w) {
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.engine = w->engine;
  desc.channel_count = 2;
  return hf_create(w->surface, &desc, &w->made_solver);
}
static hf_result call_create_plate(World* w) {
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.engine = w->engine;
  desc.field_kind = HF_FIELD_BIHARMONIC;
  return hf_create(w->surface, &desc, &w->made_solver);
}
static hf_result call_add_site(World* w) {
  const double one = 1;
  return hf_solver_add_site(w->solver, 33, &one, NULL);
}
static hf_result call_add_handle_at(World* w) {
  const double point[3] = {1, 4, 0};
  return hf_pose_add_handle_at(w->pose, point, 0.5, NULL);
}
static hf_result call_set_transform(World* w) {
  const hf_transform rest = {{0, 0, 0, 1}, {0, 0, 0}};
  return hf_pose_set_transform(w->pose, w->handles[0], &rest);
}
static hf_result call_plain_deform(World* w) { return hf_deform(w->pose, w->result, NULL); }
static hf_result call_cast_ray(World* w) {
  const double origin[3] = {5, 4.3, 0.1}, direction[3] = {-1, 0, 0};
  hf_hit hit = HF_INIT(hf_hit);
  return hf_surface_cast_ray(w->surface, origin, direction, NULL, &hit);
}
static hf_result call_find_vertex(World* w) {
  const double point[3] = {1, 4, 0};
  uint32_t vertex;
  return hf_surface_find_vertex(w->surface, point, NULL, &vertex, NULL);
}
static hf_result call_clone(World* w) { return hf_solver_clone(w->solver, &w->made_solver); }
static hf_result call_add(World* w) {
  const uint32_t vertices[3] = {11, 33, 60};
  const double values[3] = {3, 4, 5};
  const hf_sites_desc sites = sites_at(3, vertices, values);
  return hf_add_sites(w->solver, &sites, NULL);
}
static hf_result call_remove(World* w) { return hf_remove_sites(w->solver, 1, w->sites); }
static hf_result call_move(World* w) {
  const uint32_t vertex = 44;
  const hf_sites_desc to = sites_at(1, &vertex, NULL);
  return hf_solver_move_sites(w->solver, 1, w->sites, &to);
}
static hf_result call_set(World* w) {
  const double value = 9;
  return hf_solver_set_values(w->solver, 1, w->sites, &value);
}
static hf_result call_edit(World* w) {
  const uint32_t vertex = 21, place = 47;
  const double value = 6;
  const hf_sites_desc add = sites_at(1, &vertex, &value), to = sites_at(1, &place, NULL);
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  edit.remove_count = 1;
  edit.remove_sites = w->sites;
  edit.move_count = 1;
  edit.move_sites = w->sites + 1;
  edit.move_to = &to;
  edit.add = &add;
  return hf_solver_edit_sites(w->solver, &edit, NULL);
}
static hf_result call_solve(World* w) { return hf_solver_solve_f64(w->solver, w->field, 0, NULL); }
static hf_result call_solve_at(World* w) {
  const uint32_t v[2] = {7, 70};
  return hf_solver_solve_at(w->solver, 2, v, w->field);
}
static hf_result call_get_sites(World* w) {
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = 2;
  info.flux = w->field;
  return hf_solver_get_sites(w->solver, &info);
}
static hf_result call_record(World* w) { return hf_solver_record(w->solver); }
static hf_result call_undo(World* w) { return hf_solver_undo(w->solver); }
static hf_result call_pose_create(World* w) { return hf_pose_create(w->surface, NULL, &w->made_pose); }
static hf_result call_pose_clone(World* w) { return hf_pose_clone(w->pose, &w->made_pose); }
static hf_result call_add_handles(World* w) {
  const uint32_t count = 2, region[2] = {5 * AROUND, 5 * AROUND + 1};
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = 1;
  desc.region_counts = &count;
  desc.region_vertices = region;
  return hf_pose_add_handles(w->pose, &desc, NULL);
}
static hf_result call_add_layer(World* w) {
  const double point[3] = {(double)w->tube.positions[3 * 4 * AROUND], (double)w->tube.positions[3 * 4 * AROUND + 1],
                           (double)w->tube.positions[3 * 4 * AROUND + 2]};
  const double radius = 0.2; /* one vertex */
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = 1;
  desc.points = point;
  desc.radii = &radius;
  desc.layer = 1;
  return hf_pose_add_handles(w->pose, &desc, NULL);
}
static hf_result call_pose_skin(World* w) {
  hf_skin_info info = HF_INIT(hf_skin_info);
  return hf_pose_get_skin(w->pose, &info);
}
static hf_result call_remove_handles(World* w) { return hf_pose_remove_handles(w->pose, 1, w->handles); }
static hf_result deform_to(World* w, float* positions) {
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = positions;
  desc.restart = 1;
  return hf_pose_deform(w->pose, &desc, NULL);
}
static hf_result call_deform(World* w) { return deform_to(w, w->result); }
static hf_result call_transfer_create(World* w) {
  return hf_transfer_create(w->surface, w->surface, NULL, &w->made_transfer);
}
static hf_result call_add_pairs(World* w) {
  const uint32_t count = 2, region[2] = {5 * AROUND, 5 * AROUND + 1};
  hf_pairs_desc desc = HF_INIT(hf_pairs_desc);
  desc.pair_count = 1;
  desc.source_counts = desc.target_counts = &count;
  desc.source_vertices = desc.target_vertices = region;
  return hf_transfer_add_pairs(w->transfer, &desc, NULL);
}
static hf_result call_remove_pairs(World* w) { return hf_transfer_remove_pairs(w->transfer, 1, w->pairs); }
static hf_result apply_to(World* w, float* positions, float* normals) {
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = w->posed;
  frame.target_positions = positions;
  frame.target_normals = normals;
  return hf_transfer_apply(w->transfer, &frame);
}
static hf_result call_apply(World* w) {
  float normals[3 * VERTICES];
  return apply_to(w, w->result, normals);
}
static hf_result call_get_skin(World* w) {
  hf_skin_info info = HF_INIT(hf_skin_info);
  return hf_transfer_get_skin(w->transfer, &info);
}

static hf_result call_direction_create(World* w) { return hf_direction_create(w->surface, NULL, &w->made_direction); }
static hf_result call_direction_add(World* w) {
  const uint32_t vertices[2] = {30, 50};
  const double vectors[6] = {0, 1, 0, 0, -1, 0};
  return hf_direction_add_sites(w->direction, 2, vertices, vectors, NULL);
}
static hf_result call_direction_remove(World* w) { return hf_direction_remove_sites(w->direction, 1, w->constraints); }
static hf_result call_direction_move(World* w) {
  const uint32_t vertex = 44;
  return hf_direction_move_sites(w->direction, 1, w->constraints, &vertex);
}
static hf_result call_direction_set(World* w) {
  const double vector[3] = {0, 3, 0};
  return hf_direction_set_vectors(w->direction, 1, w->constraints, vector);
}
static hf_result call_direction_rotate(World* w) {
  const double angle = 1;
  return hf_direction_rotate_sites(w->direction, 1, w->constraints, &angle);
}
static hf_result call_direction_solve(World* w) { return hf_direction_solve(w->direction, w->result, 0, NULL); }
static hf_result call_singularities(World* w) {
  uint32_t count;
  return hf_direction_get_singularities(w->direction, 0, NULL, &count);
}

static hf_result call_region_create(World* w) { return hf_region_create(w->surface, NULL, &w->made_region); }
static hf_result call_region_clone(World* w) { return hf_region_clone(w->region, &w->made_region); }
static hf_result call_region_edit(World* w) {
  const uint32_t points[3] = {2 * AROUND, 2 * AROUND + 3, 2 * AROUND + 6};
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  curve.point_count = 3;
  curve.vertices = points;
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.curve = &curve;
  edit.ring_count = 1;
  edit.remove_count = 1;
  edit.remove_vertices = points;
  return hf_region_edit(w->region, &edit);
}
static hf_result call_region_record(World* w) { return hf_region_record(w->region); }
static hf_result call_region_undo(World* w) { return hf_region_undo(w->region); }
static hf_result morph_into(World* w, float* positions) {
  float normals[3 * VERTICES];
  hf_morph_desc desc = HF_INIT(hf_morph_desc);
  desc.weight = 1;
  desc.positions = positions;
  desc.normals = normals;
  return hf_region_morph(w->region, &desc);
}
static hf_result call_region_morph(World* w) { return morph_into(w, w->result); }
static hf_result call_detail_create(World* w) { return hf_detail_create(w->region, w->region, NULL, &w->made_detail); }
static hf_result call_detail_morph(World* w) {
  float normals[3 * VERTICES];
  hf_morph_desc desc = HF_INIT(hf_morph_desc);
  desc.weight = 2;
  desc.positions = w->result;
  desc.normals = normals;
  return hf_detail_morph(w->detail, &desc);
}

static const struct {
  const char* name;
  hf_result (*call)(World*);
  int green_only;
} scenarios[] = {
    {"hf_surface_create", call_surface, 0},
    {"hf_surface_save", call_surface_save, 0},
    {"hf_create", call_create, 0},
    {"hf_create", call_create_plate, 0},
    {"hf_solver_add_site", call_add_site, 0},
    {"hf_surface_cast_ray", call_cast_ray, 1},
    {"hf_surface_find_vertex", call_find_vertex, 1},
    {"hf_pose_add_handle_at", call_add_handle_at, 1},
    {"hf_pose_set_transform", call_set_transform, 1},
    {"hf_deform", call_plain_deform, 1},
    {"hf_solver_clone", call_clone, 0},
    {"hf_add_sites", call_add, 0},
    {"hf_remove_sites", call_remove, 0},
    {"hf_solver_move_sites", call_move, 0},
    {"hf_solver_set_values", call_set, 0},
    {"hf_solver_edit_sites", call_edit, 0},
    {"hf_solver_solve_f64", call_solve, 0},
    {"hf_solver_solve_at", call_solve_at, 0},
    {"hf_solver_get_sites", call_get_sites, 0},
    {"hf_solver_record", call_record, 0},
    {"hf_solver_undo", call_undo, 0},
    {"hf_pose_create", call_pose_create, 1},
    {"hf_pose_clone", call_pose_clone, 1},
    {"hf_pose_add_handles", call_add_handles, 1},
    {"hf_pose_add_handles", call_add_layer, 1},
    {"hf_pose_get_skin", call_pose_skin, 1},
    {"hf_pose_remove_handles", call_remove_handles, 1},
    {"hf_pose_deform", call_deform, 1},
    {"hf_transfer_create", call_transfer_create, 1},
    {"hf_transfer_add_pairs", call_add_pairs, 1},
    {"hf_transfer_remove_pairs", call_remove_pairs, 1},
    {"hf_transfer_apply", call_apply, 1},
    {"hf_transfer_get_skin", call_get_skin, 1},
    {"hf_direction_create", call_direction_create, 1},
    {"hf_direction_add_sites", call_direction_add, 1},
    {"hf_direction_remove_sites", call_direction_remove, 1},
    {"hf_direction_move_sites", call_direction_move, 1},
    {"hf_direction_set_vectors", call_direction_set, 1},
    {"hf_direction_rotate_sites", call_direction_rotate, 1},
    {"hf_direction_solve", call_direction_solve, 1},
    {"hf_direction_get_singularities", call_singularities, 1},
    {"hf_region_create", call_region_create, 1},
    {"hf_region_clone", call_region_clone, 1},
    {"hf_region_edit", call_region_edit, 1},
    {"hf_region_record", call_region_record, 1},
    {"hf_region_undo", call_region_undo, 1},
    {"hf_region_morph", call_region_morph, 1},
    {"hf_detail_create", call_detail_create, 1},
    {"hf_detail_morph", call_detail_morph, 1},
};

static void create_world(World* w, int32_t engine) {
  memset(w, 0, sizeof *w);
  w->tube = surface_tube(AROUND, RINGS);
  w->engine = engine;
  Options desc = options_of(&w->tube);
  desc.surface.allocator = counting_hooks(&w->memory);
  desc.solver.engine = engine;
  assert_ok(make(&desc, &w->surface, &w->solver));
  w->sites[0] = add_site(w->solver, 0, 0);
  assert_ok(hf_solver_record(w->solver));
  w->sites[1] = add_site(w->solver, VERTICES - 1, 1);
  if (engine != HF_ENGINE_GREEN) return;
  const uint32_t constrained[2] = {9, 70};
  const double vectors[6] = {0, 1, 0, 0, 2, 0};
  assert_ok(hf_direction_create(w->surface, NULL, &w->direction));
  assert_ok(hf_direction_add_sites(w->direction, 2, constrained, vectors, w->constraints));
  const uint32_t inside[6] = {4 * AROUND, 4 * AROUND + 1, 4 * AROUND + 2, 5 * AROUND, 5 * AROUND + 1, 5 * AROUND + 2};
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = 6;
  edit.add_vertices = inside;
  assert_ok(hf_region_create(w->surface, NULL, &w->region));
  assert_ok(hf_region_record(w->region));
  assert_ok(hf_region_edit(w->region, &edit));
  assert_ok(hf_detail_create(w->region, w->region, NULL, &w->detail));
  w->pose = tube_pose(w->surface, AROUND, RINGS, w->handles);
  const hf_transform turned = {{0.5, 0, 0, 0.8660254}, {0, 1, 2}};
  assert_ok(hf_pose_set_transforms(w->pose, 1, &w->handles[1], &turned));
  assert_ok(deform_to(w, w->posed));
  w->ends = tube_ends(AROUND, RINGS);
  const uint32_t counts[2] = {2 * AROUND, 2 * AROUND};
  hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
  pairs.pair_count = 2;
  pairs.source_counts = pairs.target_counts = counts;
  pairs.source_vertices = pairs.target_vertices = w->ends;
  assert_ok(hf_transfer_create(w->surface, w->surface, NULL, &w->transfer));
  assert_ok(hf_transfer_add_pairs(w->transfer, &pairs, w->pairs));
}

static void destroy_world(World* w) {
  w->memory.refuse_at = 0;
  hf_surface_destroy(w->surface);
  hf_surface_destroy(w->made_surface);
  hf_solver_destroy(w->solver);
  hf_pose_destroy(w->pose);
  hf_transfer_destroy(w->transfer);
  hf_direction_destroy(w->direction);
  hf_direction_destroy(w->made_direction);
  hf_region_destroy(w->region);
  hf_region_destroy(w->made_region);
  hf_detail_destroy(w->detail);
  hf_detail_destroy(w->made_detail);
  hf_solver_destroy(w->made_solver);
  hf_pose_destroy(w->made_pose);
  hf_transfer_destroy(w->made_transfer);
  assert_int_equal(w->memory.live_blocks, 0);
  assert_int_equal(w->memory.live_bytes, 0);
  assert_int_equal(w->memory.mismatches, 0);
  surface_free(&w->tube);
  free(w->ends);
}

/* What a world computes: to be the same after a refused allocation as before. */
typedef struct Picture {
  uint32_t site_count, handle_count;
  double field[VERTICES];
  float posed[3 * VERTICES], transferred[3 * VERTICES], directed[3 * VERTICES], morphed[3 * VERTICES];
} Picture;

static void take_picture(World* w, Picture* p) {
  memset(p, 0, sizeof *p);
  p->site_count = hf_solver_get_site_count(w->solver);
  p->handle_count = hf_pose_get_handle_count(w->pose);
  assert_ok(hf_solver_solve_f64(w->solver, p->field, 0, NULL));
  if (!w->pose) return;
  assert_ok(deform_to(w, p->posed));
  assert_ok(apply_to(w, p->transferred, NULL));
  assert_ok(hf_direction_solve(w->direction, p->directed, 0, NULL));
  assert_ok(morph_into(w, p->morphed));
}

static int same_picture(const Picture* a, const Picture* b) {
  double worst = 0;
  for (int v = 0; v < VERTICES; ++v) worst = fmax(worst, fabs(a->field[v] - b->field[v]));
  return a->site_count == b->site_count && a->handle_count == b->handle_count && worst < 1e-7 &&
         same_bits(a->posed, b->posed, sizeof a->posed) &&
         same_bits(a->transferred, b->transferred, sizeof a->transferred) &&
         same_bits(a->directed, b->directed, sizeof a->directed) &&
         same_bits(a->morphed, b->morphed, sizeof a->morphed);
}

/* The refused allocations lie ever further apart: this program runs under emulators too. reliability_refuse refuses
 * every one. */
static size_t next_refused(size_t n) { return n + 1 + n / 2; }

/* Runs one scenario with allocation n = 1, 2, 4, ... refused until the call succeeds. on: all later ones are refused
 * too. */
static unsigned refuse_each(size_t s, int32_t engine, int on) {
  unsigned refused = 0;
  for (size_t n = 1;; n = next_refused(n)) {
    World world;
    Picture before, after;
    create_world(&world, engine);
    take_picture(&world, &before);
    /* what the world computes lazily is computed again by some calls: start them from an untouched world */
    if (scenarios[s].call == call_apply || scenarios[s].call == call_get_skin) {
      destroy_world(&world);
      create_world(&world, engine);
    }
    const size_t live = world.memory.live_blocks, bytes = world.memory.live_bytes;
    world.memory.calls = 0;
    world.memory.refuse_at = n;
    world.memory.refuse_on = on;
    const hf_result result = scenarios[s].call(&world);
    const int reached = world.memory.calls >= n;
    world.memory.refuse_at = 0;
    world.memory.refuse_on = 0;
    if (result != HF_OK) {
      if (result != HF_ERROR_OUT_OF_MEMORY)
        fail_msg("%s, engine %d, allocation %u: %s", scenarios[s].name, (int)engine, (unsigned)n,
                 hf_result_get_name(result));
      if (world.made_surface || world.made_solver || world.made_pose || world.made_transfer || world.made_direction ||
          world.made_region || world.made_detail)
        fail_msg("%s, allocation %u: a handle came back", scenarios[s].name, (unsigned)n);
      hf_error_detail detail;
      assert_ok(hf_error_get_detail(&detail));
      assert_int_equal(detail.code, HF_ERROR_OUT_OF_MEMORY);
      assert_string_equal(detail.function, scenarios[s].name);
      ++refused;
      /* a cache that the call has filled or a grown workspace may stay; a failed hf_surface_create leaves nothing at
       * all */
      if (scenarios[s].call == call_surface && (world.memory.live_blocks != live || world.memory.live_bytes != bytes))
        fail_msg("hf_surface_create leaked at allocation %u", (unsigned)n);
      take_picture(&world, &after);
      if (!same_picture(&before, &after))
        fail_msg("%s, engine %d, allocation %u: the state has changed", scenarios[s].name, (int)engine, (unsigned)n);
      assert_ok(scenarios[s].call(&world)); /* and the call succeeds when memory is there again */
    }
    destroy_world(&world);
    if (!reached) return refused;
  }
}

static void refuse_everywhere(int32_t engine) {
  unsigned total = 0;
  for (size_t s = 0; s < COUNT_OF(scenarios); ++s) {
    if (scenarios[s].green_only && engine != HF_ENGINE_GREEN) continue;
    total += refuse_each(s, engine, 0) + refuse_each(s, engine, 1);
  }
  print_message("engine %d: %u refused allocations\n", (int)engine, total);
  assert_true(total > 100);
}

static void any_allocation_may_be_refused_with_the_green_engine(void** state) {
  (void)state;
  refuse_everywhere(HF_ENGINE_GREEN);
}
static void any_allocation_may_be_refused_with_the_refactor_engine(void** state) {
  (void)state;
  refuse_everywhere(HF_ENGINE_REFACTOR);
}
static void any_allocation_may_be_refused_with_the_updown_engine(void** state) {
  (void)state;
  if (!has_peers()) skip();
  refuse_everywhere(HF_ENGINE_UPDOWN);
}

static void dragging_allocates_nothing(void** state) {
  (void)state;
  World world;
  create_world(&world, HF_ENGINE_GREEN);
  float normals[3 * VERTICES];
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = world.result;
  desc.normals = normals;
  assert_ok(hf_pose_deform(world.pose, &desc, NULL));
  world.memory.calls = 0;
  for (int i = 0; i < 20; ++i) {
    const hf_transform moved = {{0, 0, 0, 0}, {0.1 * i, 0, 0}};
    assert_ok(hf_pose_set_transforms(world.pose, 1, world.handles, &moved));
    assert_ok(hf_pose_deform(world.pose, &desc, NULL));
  }
  assert_int_equal(world.memory.calls, 0);
  destroy_world(&world);
}

static void repeated_fields_hold_no_more_memory(void** state) {
  (void)state;
  World world;
  create_world(&world, HF_ENGINE_GREEN);
  assert_ok(call_solve(&world));
  const size_t blocks = world.memory.live_blocks;
  for (int i = 0; i < 200; ++i) {
    const uint32_t site = add_site(world.solver, 40, i);
    assert_ok(call_solve(&world));
    assert_ok(hf_remove_sites(world.solver, 1, &site));
    assert_ok(call_solve(&world));
  }
  assert_true(world.memory.live_blocks <= blocks + 8);
  destroy_world(&world);
}

/* A callback that calls back. */
typedef struct Reentrant {
  CountingAllocator memory;
  hf_allocator inner;
  hf_solver solver;
  int armed, expect_read;
  unsigned tried;
} Reentrant;
static void* reentrant_allocate(void* user, size_t size, size_t alignment) {
  Reentrant* r = user;
  if (r->armed) {
    r->armed = 0; /* once: what is called here allocates too */
    double value[2];
    const uint32_t vertex = 3, site = 0;
    const hf_sites_desc sites = sites_at(1, &vertex, NULL);
    assert_code(HF_ERROR_REENTRANT, hf_add_sites(r->solver, &sites, NULL));
    assert_code(HF_ERROR_REENTRANT, hf_remove_sites(r->solver, 1, &site));
    assert_code(HF_ERROR_REENTRANT, hf_solver_record(r->solver));
    assert_code(r->expect_read, hf_solver_solve_at(r->solver, 1, &vertex, value));
    ++r->tried;
  }
  return r->inner.allocate(&r->memory, size, alignment);
}
static void reentrant_release(void* user, void* block, size_t size, size_t alignment) {
  Reentrant* r = user;
  r->inner.release(&r->memory, block, size, alignment);
}

static void a_callback_that_calls_back_is_refused(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  Reentrant r;
  memset(&r, 0, sizeof r);
  r.inner = counting_hooks(&r.memory);
  Options desc = options_of(&tube);
  desc.surface.allocator.allocate = reentrant_allocate;
  desc.surface.allocator.release = reentrant_release;
  desc.surface.allocator.user = &r;
  assert_ok(make(&desc, NULL, &r.solver));
  add_site(r.solver, 0, 0);
  r.armed = 1;
  r.expect_read = HF_ERROR_REENTRANT; /* inside a change nothing is allowed */
  add_site(r.solver, 50, 1);
  assert_int_equal(r.tried, 1);
  double values[2];
  const uint32_t vertices[2] = {7, 20};
  r.armed = 1;
  r.expect_read = HF_OK; /* inside a read, reading is */
  assert_ok(hf_solver_solve_at(r.solver, 2, vertices, values));
  assert_int_equal(r.tried, 2);
  assert_int_equal(hf_solver_get_site_count(r.solver), 2);
  hf_solver_destroy(r.solver);
  surface_free(&tube);
  assert_int_equal(r.memory.live_blocks, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_allocation_may_be_refused_with_the_green_engine),
      cmocka_unit_test(any_allocation_may_be_refused_with_the_refactor_engine),
      cmocka_unit_test(any_allocation_may_be_refused_with_the_updown_engine),
      cmocka_unit_test(dragging_allocates_nothing),
      cmocka_unit_test(repeated_fields_hold_no_more_memory),
      cmocka_unit_test(a_callback_that_calls_back_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
