#include "api_support.h"

static void* checked_malloc(size_t size) {
  void* block = malloc(size ? size : 1);
  if (!block) exit(2);
  return block;
}

static Surface surface_make(uint32_t vertex_count, uint32_t triangle_count) {
  Surface s;
  s.vertex_count = vertex_count;
  s.triangle_count = triangle_count;
  s.positions = checked_malloc(sizeof(float) * 3 * vertex_count);
  s.triangles = checked_malloc(sizeof(uint32_t) * 3 * triangle_count);
  return s;
}

/* Writes a sheet at a place in the arrays; x0 shifts it along x. Returns the number of triangles written. */
static uint32_t put_sheet(Surface* s, uint32_t vertex, uint32_t triangle, uint32_t columns, uint32_t rows_, float x0) {
  const uint32_t width = columns + 1;
  uint32_t t = triangle;
  for (uint32_t j = 0; j <= rows_; ++j) {
    for (uint32_t i = 0; i <= columns; ++i) {
      float* p = s->positions + 3 * (size_t)(vertex + j * width + i);
      p[0] = x0 + (float)i;
      p[1] = (float)j;
      p[2] = 0.25f * sinf(1.3f * p[0]) * cosf(0.9f * p[1]);
    }
  }
  for (uint32_t j = 0; j < rows_; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t a = vertex + j * width + i, b = a + 1, c = a + width, d = c + 1;
      const uint32_t corners[6] = {a, b, d, a, d, c};
      memcpy(s->triangles + 3 * (size_t)t, corners, sizeof corners);
      t += 2;
    }
  }
  return t - triangle;
}

Surface surface_sheet(uint32_t columns, uint32_t rows_) {
  Surface s = surface_make((columns + 1) * (rows_ + 1), 2 * columns * rows_);
  put_sheet(&s, 0, 0, columns, rows_, 0.0f);
  return s;
}

Surface surface_tube(uint32_t around, uint32_t rings) {
  Surface s = surface_make(around * rings, 2 * around * (rings - 1));
  uint32_t* corner = s.triangles;
  for (uint32_t r = 0; r < rings; ++r) {
    for (uint32_t i = 0; i < around; ++i) {
      const float angle = 6.2831853f * (float)i / (float)around;
      float* p = s.positions + 3 * (size_t)(r * around + i);
      p[0] = cosf(angle);
      p[1] = (float)r;
      p[2] = sinf(angle);
      if (r + 1 == rings) continue;
      const uint32_t a = r * around + i, b = r * around + (i + 1) % around, c = a + around, d = b + around;
      const uint32_t corners[6] = {a, c, b, b, c, d};
      memcpy(corner, corners, sizeof corners);
      corner += 6;
    }
  }
  return s;
}

Surface surface_fan(uint32_t triangles) {
  Surface s = surface_make(triangles + 1, triangles);
  memset(s.positions, 0, 3 * sizeof *s.positions);
  for (uint32_t i = 0; i < triangles; ++i) {
    const float angle = 6.2831853f * (float)i / (float)triangles;
    float* p = s.positions + 3 * (size_t)(i + 1);
    p[0] = cosf(angle);
    p[1] = sinf(angle);
    p[2] = 0;
    const uint32_t corners[3] = {0, 1 + i, 1 + (i + 1) % triangles};
    memcpy(s.triangles + 3 * (size_t)i, corners, sizeof corners);
  }
  return s;
}

Surface surface_cut(void) {
  Surface s = surface_make(CUT_VERTICES, CUT_TRIANGLES);
  uint32_t t = put_sheet(&s, 0, 0, 4, 4, 0.0f);
  t += put_sheet(&s, 25, t, 4, 4, 4.0f);
  t += put_sheet(&s, CUT_ISLAND, t, 2, 2, 20.0f);
  s.triangles[3 * t] = s.triangles[3 * t + 1] = 0;
  s.triangles[3 * t + 2] = 1;
  s.positions[3 * CUT_ISOLATED] = 30.0f;
  s.positions[3 * CUT_ISOLATED + 1] = 1.0f;
  s.positions[3 * CUT_ISOLATED + 2] = 2.0f;
  return s;
}

void surface_free(Surface* surface) {
  free(surface->positions);
  free(surface->triangles);
}

Options options_of(const Surface* surface) {
  Options o = {HF_INIT(hf_surface_desc), HF_INIT(hf_solver_desc), ENGINE_GREEN};
  o.surface.positions = HF_ARRAY(surface->positions, surface->vertex_count);
  o.surface.triangles = HF_ARRAY(surface->triangles, surface->triangle_count);
  return o;
}

hf_result make(const Options* options, hf_surface* out_surface, hf_solver* out_solver) {
  hf_surface surface = NULL;
  hf_solver_desc solver = options->solver;
  if (solver.field_kind == 0) solver.field_kind = options->surface.field_kind;
  *out_solver = NULL;
  if (out_surface) *out_surface = NULL;
  hf_result result = hf_surface_create(&options->surface, &surface);
  if (result == HF_OK) result = create_with(options->engine, surface, &solver, out_solver);
  if (result == HF_OK && out_surface)
    *out_surface = surface;
  else
    hf_surface_destroy(surface);
  return result;
}

hf_surface surface_on(const Surface* surface) {
  const Options options = options_of(surface);
  hf_surface made = NULL;
  assert_ok(hf_surface_create(&options.surface, &made));
  assert_non_null(made);
  return made;
}

hf_solver solver_on(hf_surface surface) {
  hf_solver solver = NULL;
  assert_ok(hf_create(surface, NULL, &solver));
  assert_non_null(solver);
  return solver;
}

hf_solver surface_solver(const Surface* surface) {
  const hf_surface made = surface_on(surface);
  const hf_solver solver = solver_on(made);
  hf_surface_destroy(made); /* the solver keeps alive what it needs */
  return solver;
}

unsigned char* saved_bytes(hf_surface surface, int32_t field_kind, size_t* out_size) {
  assert_ok(hf_surface_save(surface, field_kind, NULL, 0, NULL, out_size));
  unsigned char* bytes = checked_malloc(*out_size);
  assert_ok(hf_surface_save(surface, field_kind, NULL, *out_size, bytes, NULL));
  return bytes;
}

hf_sites_desc sites_at(uint32_t count, const uint32_t* vertices, const double* values) {
  hf_sites_desc desc = HF_INIT(hf_sites_desc);
  desc.site_count = count;
  desc.vertices = vertices;
  desc.values = values;
  return desc;
}

uint32_t add_site(hf_solver solver, uint32_t vertex, double value) {
  const hf_sites_desc desc = sites_at(1, &vertex, &value);
  uint32_t site = NO_INDEX;
  assert_ok(hf_add_sites(solver, &desc, &site));
  return site;
}

double* field_of(hf_solver solver, uint32_t vertex_count) {
  double* field = checked_malloc(sizeof(double) * vertex_count);
  assert_ok(hf_solver_solve(solver, OUT(field), NULL));
  return field;
}

int same_bits(const void* a, const void* b, size_t size) { return memcmp(a, b, size) == 0; }

uint32_t* tube_ends(uint32_t around, uint32_t rings) {
  uint32_t* vertices = checked_malloc(sizeof(uint32_t) * 4 * around);
  for (uint32_t i = 0; i < 2 * around; ++i) {
    vertices[i] = i;
    vertices[2 * around + i] = (rings - 2) * around + i;
  }
  return vertices;
}

void add_own_pairs(hf_transfer transfer, const uint32_t counts[2], const uint32_t* vertices) {
  hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
  pairs.pair_count = 2;
  pairs.source_counts = pairs.target_counts = counts;
  pairs.source_vertices = pairs.target_vertices = vertices;
  assert_ok(hf_transfer_add_pairs(transfer, &pairs, NULL));
}

void add_tube_pairs(hf_transfer transfer, uint32_t around, uint32_t rings) {
  const uint32_t counts[2] = {2 * around, 2 * around};
  uint32_t* ends = tube_ends(around, rings);
  add_own_pairs(transfer, counts, ends);
  free(ends);
}

hf_pose tube_pose(hf_surface surface, uint32_t around, uint32_t rings, uint32_t out_handles[2]) {
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  uint32_t* vertices = tube_ends(around, rings);
  const uint32_t counts[2] = {2 * around, 2 * around};
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = 2;
  desc.region_counts = counts;
  desc.region_vertices = vertices;
  assert_ok(hf_pose_add_handles(pose, &desc, out_handles));
  free(vertices);
  return pose;
}

/* Each block carries its size and alignment in front, to see that the library gives back what it was given. */
typedef struct BlockHead {
  void* base;
  size_t size, alignment;
} BlockHead;

static void* counting_allocate(void* user, size_t size, size_t alignment) {
  CountingAllocator* a = user;
  ++a->calls;
  if (a->refuse_at && (a->calls == a->refuse_at || (a->refuse_on && a->calls > a->refuse_at))) return NULL;
  if (alignment == 0 || (alignment & (alignment - 1)) != 0) ++a->mismatches;
  unsigned char* base = malloc(size + alignment + sizeof(BlockHead));
  if (!base) return NULL;
  const uintptr_t first = (uintptr_t)(base + sizeof(BlockHead));
  unsigned char* block = base + sizeof(BlockHead) + ((first + alignment - 1) / alignment * alignment - first);
  const BlockHead head = {base, size, alignment};
  memcpy(block - sizeof head, &head, sizeof head);
  ++a->live_blocks;
  a->live_bytes += size;
  if (a->live_bytes > a->peak_bytes) a->peak_bytes = a->live_bytes;
  return block;
}

static void counting_release(void* user, void* block, size_t size, size_t alignment) {
  CountingAllocator* a = user;
  BlockHead head;
  memcpy(&head, (unsigned char*)block - sizeof head, sizeof head);
  if (head.size != size || head.alignment != alignment) ++a->mismatches;
  --a->live_blocks;
  a->live_bytes -= head.size;
  free(head.base);
}

double memory_in_use(hf_surface surface) {
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(surface, &statistics));
  return statistics.memory_bytes;
}

void give_kept_back(hf_surface surface) { hf_solver_destroy(solver_on(surface)); }

hf_allocator counting_hooks(CountingAllocator* allocator) {
  hf_allocator hooks;
  hooks.allocate = counting_allocate;
  hooks.release = counting_release;
  hooks.user = allocator;
  return hooks;
}

Rows rows;

void row_holds(int line, const char* what, const char* condition, int holds) {
  if (holds) return;
  ++rows.failures;
  print_error("row at line %d, %s: %s does not hold\n", line, what, condition);
}

static int starts_with_name(const char* call, const char* name) {
  const size_t length = strlen(name);
  return length > 0 && strncmp(call, name, length) == 0 &&
         (call[length] == '(' || call[length] == '\0' || call[length] == ':' || call[length] == ' ');
}

void check_row(int line, const char* what, const char* call, hf_result got, hf_result expected, uint32_t index) {
  hf_error_detail detail;
  ++rows.count;
  if (got != expected) {
    ++rows.failures;
    print_error("row at line %d, %s, %s: got %s, expected %s\n", line, call, what, hf_result_get_name(got),
                hf_result_get_name(expected));
    if (got != HF_OK && hf_error_get_detail(&detail) == HF_OK) print_error("  detail: %s\n", detail.message);
    return;
  }
  if (expected == HF_OK) return;
  if (hf_error_get_detail(&detail) != HF_OK) memset(&detail, 0, sizeof detail);
  row_holds(line, what, "the detail has the code that was returned", detail.code == got);
  row_holds(line, what, "the detail names the function", starts_with_name(call, detail.function));
  row_holds(line, what, "the message is one line of text", strlen(detail.message) > 8 && !strchr(detail.message, '\n'));
  if (detail.index != index) {
    ++rows.failures;
    print_error("row at line %d, %s, %s: index %u, expected %u (%s)\n", line, call, what, detail.index, index,
                detail.message);
  }
}

void finish_rows(const char* table) {
  const Rows done = rows;
  memset(&rows, 0, sizeof rows);
  print_message("%s: %u rows, %u failures\n", table, done.count, done.failures);
  assert_int_equal(done.failures, 0);
}
