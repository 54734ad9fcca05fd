/* Links between pieces: fields and poses span them, the list that is read back makes the same bits, refused links
 * change nothing, a saved factor knows its links, other links keep the ordering, gaps are measured. */
#include "bad_scene.h"

static Surface mesh; /* the cut sheet, its piece pulled near */
static hf_surface linked, plain;

/* The piece lies beside the sheet, a tenth of a unit away. */
static void bring_piece_near(Surface* cut) {
  float low = INFINITY, right = -INFINITY;
  for (uint32_t v = 0; v < CUT_ISLAND; ++v) right = fmaxf(right, cut->positions[3 * v]);
  for (uint32_t v = CUT_ISLAND; v < CUT_ISOLATED; ++v) low = fminf(low, cut->positions[3 * v]);
  for (uint32_t v = CUT_ISLAND; v < CUT_ISOLATED; ++v) cut->positions[3 * v] += right + 0.1f - low;
}

static hf_links_desc automatic(void) {
  hf_links_desc links = HF_INIT(hf_links_desc);
  links.mode = HF_LINK_PIECES;
  links.overlay_distance = -1;
  return links;
}

static hf_surface surface_with(const hf_links_desc* links) {
  hf_surface_desc desc = options_of(&mesh).surface;
  desc.links = links;
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  return surface;
}

static hf_links_info links_info_of(hf_surface surface) {
  hf_links_info info = HF_INIT(hf_links_info);
  assert_ok(hf_surface_get_links_info(surface, &info));
  return info;
}

static uint32_t components_of(hf_surface surface) {
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(surface, &report));
  return report.component_count;
}

static hf_link* links_of(hf_surface surface, uint32_t* out_count) {
  assert_ok(hf_surface_get_links(surface, 0, NULL, out_count));
  hf_link* list = calloc(*out_count + 1, sizeof *list);
  assert_non_null(list);
  assert_ok(hf_surface_get_links(surface, *out_count, list, out_count));
  return list;
}

static double* field_on(hf_surface surface) {
  hf_solver solver = solver_on(surface);
  add_site(solver, CUT_LEFT, 1);
  add_site(solver, CUT_RIGHT, 3);
  double* field = field_of(solver, CUT_VERTICES);
  hf_solver_destroy(solver);
  return field;
}

static int set_up(void** state) {
  (void)state;
  mesh = surface_cut();
  bring_piece_near(&mesh);
  const hf_links_desc links = automatic();
  linked = surface_with(&links);
  plain = surface_with(NULL);
  return 0;
}
static int tear_down(void** state) {
  (void)state;
  hf_surface_destroy(linked);
  hf_surface_destroy(plain);
  surface_free(&mesh);
  return 0;
}

static void fields_span_linked_pieces(void** state) {
  (void)state;
  const hf_links_info with = links_info_of(linked), without = links_info_of(plain);
  assert_int_equal(with.piece_count, 2);
  assert_int_equal(components_of(linked), 1);
  assert_int_equal(with.lone_piece_count, 0);
  assert_int_equal(with.light_piece_count, 0);
  assert_true(with.link_count > 0);
  assert_true(with.longest_tree_link >= 0.1 && with.longest_tree_link < 0.3);
  assert_int_equal(without.piece_count, 2);
  assert_int_equal(components_of(plain), 2);
  assert_int_equal(without.lone_piece_count, 2);
  assert_int_equal(without.link_count, 0);
  double *across = field_on(linked), *apart = field_on(plain);
  for (uint32_t v = 0; v < CUT_VERTICES; ++v) {
    const int piece = v >= CUT_ISLAND && v < CUT_ISOLATED;
    assert_true(v == CUT_ISOLATED ? across[v] == 0 : across[v] >= 1 - 1e-12 && across[v] <= 3 + 1e-12);
    if (piece) assert_true(apart[v] == 0);
  }
  free(across);
  free(apart);
  uint32_t pieces[CUT_VERTICES], components[CUT_VERTICES], count = 0;
  int32_t light[CUT_VERTICES];
  assert_ok(hf_surface_get_pieces(linked, CUT_VERTICES, pieces, light, &count));
  assert_ok(hf_surface_get_components(linked, CUT_VERTICES, components, &count));
  assert_int_equal(count, CUT_VERTICES);
  assert_int_equal(pieces[CUT_LEFT], 0);
  assert_int_equal(pieces[CUT_ISLAND], 1);
  assert_int_equal(pieces[CUT_ISOLATED], HF_NO_INDEX);
  assert_int_equal(components[CUT_ISLAND], components[CUT_LEFT]);
  for (uint32_t v = 0; v < CUT_VERTICES; ++v) assert_int_equal(light[v], 0);
}

static void what_works_on_triangles_does_not_see_links(void** state) {
  (void)state;
  hf_geodesics with = NULL, without = NULL;
  assert_ok(hf_geodesics_create(linked, NULL, &with));
  assert_ok(hf_geodesics_create(plain, NULL, &without));
  const uint32_t source = CUT_LEFT;
  double a[CUT_VERTICES], b[CUT_VERTICES];
  assert_ok(hf_geodesics_solve(with, 1, &source, OUT(a)));
  assert_ok(hf_geodesics_solve(without, 1, &source, OUT(b)));
  assert_true(same_bits(a, b, sizeof a));
  hf_geodesics_destroy(with);
  hf_geodesics_destroy(without);
  double* field = field_on(plain);
  const hf_array scalars = HF_ARRAY(field, CUT_VERTICES);
  hf_critical_info x = HF_INIT(hf_critical_info), y = HF_INIT(hf_critical_info);
  assert_ok(hf_surface_find_critical_points(linked, &scalars, 0, NULL, &x));
  assert_ok(hf_surface_find_critical_points(plain, &scalars, 0, NULL, &y));
  assert_true(same_bits(&x, &y, sizeof x));
  free(field);
}

static void the_list_read_back_makes_the_same_bits(void** state) {
  (void)state;
  hf_links_desc list = HF_INIT(hf_links_desc);
  hf_link* links = links_of(linked, &list.link_count);
  list.mode = HF_LINK_LIST;
  list.links = links;
  hf_surface again = surface_with(&list);
  double *a = field_on(linked), *b = field_on(again);
  assert_true(same_bits(a, b, CUT_VERTICES * sizeof *a));
  uint32_t count = 0;
  hf_link* back = links_of(again, &count);
  assert_int_equal(count, list.link_count);
  for (uint32_t i = 0; i < count; ++i) {
    assert_int_equal(back[i].vertex, links[i].vertex);
    assert_true(fabs(back[i].length - links[i].length) < 1e-12);
  }
  free(a);
  free(b);
  free(back);
  hf_surface_destroy(again);
  /* Two vertices joined by hand: no corner but the first is looked at. */
  hf_link one;
  memset(&one, 0, sizeof one);
  one.vertex = CUT_ISLAND;
  one.corners[0] = CUT_RIGHT;
  one.corners[1] = one.corners[2] = HF_NO_INDEX;
  one.barycentrics[0] = 1;
  one.weight = 1;
  list.link_count = 1;
  list.links = &one;
  again = surface_with(&list);
  double* field = field_on(again);
  for (uint32_t v = CUT_ISLAND; v < CUT_ISOLATED; ++v) assert_true(fabs(field[v] - 3) < 1e-12);
  free(field);
  free(links);
  hf_surface_destroy(again);
  /* Shares whose rounded sum is not 1 come back as they were given. */
  const uint32_t corners[3] = {CUT_RIGHT, CUT_LEFT, CUT_ISLAND + 1};
  const double shares[3] = {0.7, 0.2, 0.1};
  assert_true(shares[0] + shares[1] + shares[2] < 1);
  memcpy(one.corners, corners, sizeof corners);
  memcpy(one.barycentrics, shares, sizeof shares);
  again = surface_with(&list);
  hf_link* own = links_of(again, &count);
  assert_true(same_bits(own[0].barycentrics, shares, sizeof shares));
  free(own);
  hf_surface_destroy(again);
}

static double* list_field(const hf_links_desc* list, const hf_factor_desc* factor) {
  hf_surface_desc desc = options_of(&mesh).surface;
  desc.links = list;
  desc.saved_factor = factor;
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  hf_surface_statistics s = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(surface, &s));
  assert_int_equal(s.factor_loaded, factor != NULL);
  double* field = field_on(surface);
  hf_surface_destroy(surface);
  return field;
}

/* A list alone makes a light piece heavy; with the vertices that hf_surface_get_pieces marks it makes the same bits,
 * and takes the same saved factor. */
static void a_list_with_its_light_pieces_makes_the_same_bits(void** state) {
  (void)state;
  hf_links_desc links = automatic();
  links.overlay_distance = 100;
  hf_surface light = surface_with(&links);
  assert_int_equal(links_info_of(light).light_piece_count, 1);
  int32_t marks[CUT_VERTICES];
  uint32_t named[CUT_VERTICES], count = 0;
  assert_ok(hf_surface_get_pieces(light, CUT_VERTICES, NULL, marks, NULL));
  for (uint32_t v = 0; v < CUT_VERTICES; ++v) {
    if (marks[v]) named[count++] = v;
  }
  size_t size = 0;
  unsigned char* bytes = saved_bytes(light, HF_FIELD_HARMONIC, &size);
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.bytes = bytes;
  factor.byte_count = size;
  hf_links_desc list = HF_INIT(hf_links_desc);
  hf_link* given = links_of(light, &list.link_count);
  list.mode = HF_LINK_LIST;
  list.links = given;
  double *a = field_on(light), *b = list_field(&list, NULL);
  assert_false(same_bits(a, b, CUT_VERTICES * sizeof *a));
  list.light_count = count;
  list.light_vertices = named;
  double *c = list_field(&list, NULL), *d = list_field(&list, &factor);
  assert_true(same_bits(a, c, CUT_VERTICES * sizeof *a) && same_bits(a, d, CUT_VERTICES * sizeof *a));
  free(a);
  free(b);
  free(c);
  free(d);
  free(given);
  free(bytes);
  hf_surface_destroy(light);
}

static void a_saved_factor_needs_its_links(void** state) {
  (void)state;
  size_t size = 0;
  unsigned char* bytes = saved_bytes(linked, HF_FIELD_HARMONIC, &size);
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.bytes = bytes;
  factor.byte_count = size;
  hf_surface_desc desc = options_of(&mesh).surface;
  desc.saved_factor = &factor;
  hf_surface surface = NULL;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create(&desc, &surface));
  assert_null(surface);
  hf_links_desc links = automatic();
  links.stiffness = 2;
  desc.links = &links;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create(&desc, &surface));
  links.stiffness = 0;
  assert_ok(hf_surface_create(&desc, &surface));
  double *a = field_on(linked), *b = field_on(surface);
  assert_true(same_bits(a, b, CUT_VERTICES * sizeof *a));
  free(a);
  free(b);
  free(bytes);
  hf_surface_destroy(surface);
}

static void other_links_keep_the_ordering_where_the_pattern_allows(void** state) {
  (void)state;
  hf_links_desc links = automatic();
  links.stiffness = 5;
  hf_surface stiffer = NULL, fresh = surface_with(&links);
  assert_ok(hf_surface_relink(linked, &links, NULL, &stiffer));
  hf_surface_statistics s = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(stiffer, &s));
  assert_true(s.ordering_ms == 0 && s.symbolic_ms == 0);
  double *a = field_on(stiffer), *b = field_on(fresh), *old = field_on(linked);
  for (uint32_t v = 0; v < CUT_VERTICES; ++v) assert_true(fabs(a[v] - b[v]) < 1e-12);
  assert_false(same_bits(a, old, CUT_VERTICES * sizeof *a));
  free(a);
  free(b);
  free(old);
  hf_surface_destroy(fresh);
  /* None: the same as a surface made without. */
  hf_surface none = NULL;
  assert_ok(hf_surface_relink(stiffer, NULL, NULL, &none));
  assert_int_equal(links_info_of(none).link_count, 0);
  a = field_on(none);
  b = field_on(plain);
  for (uint32_t v = 0; v < CUT_VERTICES; ++v) assert_true(fabs(a[v] - b[v]) < 1e-12);
  free(a);
  free(b);
  hf_surface_destroy(none);
  hf_surface_destroy(stiffer);
}

static void a_pose_takes_linked_pieces_along_and_gaps_are_measured(void** state) {
  (void)state;
  for (int with = 0; with < 2; ++with) {
    hf_pose pose = NULL;
    assert_ok(hf_pose_create(with ? linked : plain, NULL, &pose));
    const uint32_t counts[1] = {1}, vertices[1] = {CUT_LEFT};
    hf_handles_desc handles = HF_INIT(hf_handles_desc);
    handles.handle_count = 1;
    handles.region_counts = counts;
    handles.region_vertices = vertices;
    uint32_t handle = 0;
    assert_ok(hf_pose_add_handles(pose, &handles, &handle));
    hf_transform move;
    memset(&move, 0, sizeof move);
    move.rotation[3] = 1;
    move.translation[2] = 4;
    assert_ok(hf_pose_set_transform(pose, handle, &move));
    float posed[3 * CUT_VERTICES];
    hf_deform_info info = HF_INIT(hf_deform_info);
    assert_ok(hf_deform(pose, posed, &info));
    assert_int_equal(info.unreached_vertex_count, with ? 1 : 10);
    const hf_array desc = HF_ARRAY(posed, CUT_VERTICES);
    hf_gaps_info gaps = HF_INIT(hf_gaps_info);
    double each[64];
    assert_ok(hf_surface_measure_gaps(linked, &desc, 64, each, &gaps));
    assert_int_equal(gaps.link_count, links_info_of(linked).link_count);
    assert_true(with ? gaps.worst < 1e-5 : gaps.worst > 3.5 && gaps.percentile_95 > 3.5);
    assert_true(gaps.worst == each[gaps.worst_link]);
    assert_int_equal(gaps.touching_count, 0); /* a tenth of a unit is too far */
    assert_ok(hf_surface_measure_gaps(plain, &desc, 0, NULL, &gaps));
    assert_int_equal(gaps.link_count, 0);
    assert_int_equal(gaps.touching_count, 0);
    assert_int_equal(gaps.opening_vertex, HF_NO_INDEX);
    assert_int_equal(gaps.worst_link, HF_NO_INDEX);
    hf_pose_destroy(pose);
  }
}

/* A tile that lies on another: what it leaves opens, what it slides along does not. */
static void a_touching_piece_that_slides_opens_nothing(void** state) {
  (void)state;
  float tiles[24];
  uint32_t triangles[12];
  for (int tile = 0; tile < 2; ++tile) {
    for (int v = 0; v < 4; ++v) {
      const float corner[3] = {(float)(v % 2) * (tile ? 0.5f : 2.0f), (float)(v / 2) * (tile ? 0.5f : 2.0f),
                               tile ? 0.005f : 0};
      memcpy(tiles + 12 * tile + 3 * v, corner, sizeof corner);
    }
    const uint32_t two[6] = {0, 1, 3, 0, 3, 2};
    for (int k = 0; k < 6; ++k) triangles[6 * tile + k] = two[k] + 4 * (uint32_t)tile;
  }
  const hf_links_desc links = automatic();
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(tiles, 8);
  desc.triangles = HF_ARRAY(triangles, 4);
  desc.links = &links;
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  for (int axis = 0; axis < 3; axis += 2) {
    float moved[24];
    memcpy(moved, tiles, sizeof moved);
    for (int v = 4; v < 8; ++v) moved[3 * v + axis] += 0.75f;
    const hf_array rows = HF_ARRAY(moved, 8);
    hf_gaps_info gaps = HF_INIT(hf_gaps_info);
    assert_ok(hf_surface_measure_gaps(surface, &rows, 0, NULL, &gaps));
    assert_true(gaps.touching_count >= 4);
    assert_true(gaps.worst > 0.7);
    assert_true(axis == 0 ? gaps.worst_opening < 1e-6 : fabs(gaps.worst_opening - 0.75) < 1e-6);
    if (axis == 2) assert_true(gaps.opening_vertex < 8);
  }
  hf_surface_destroy(surface);
}

static void a_range_of_a_frame_has_the_rigid_piece_of_the_whole(void** state) {
  (void)state;
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(linked, NULL, &pose));
  const uint32_t counts[2] = {1, 1}, vertices[2] = {CUT_LEFT, CUT_RIGHT}, piece = CUT_ISLAND;
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  handles.handle_count = 2;
  handles.region_counts = counts;
  handles.region_vertices = vertices;
  uint32_t numbers[2];
  assert_ok(hf_pose_add_handles(pose, &handles, numbers));
  const hf_transform turned = {{0.5, 0, 0, 0.8660254}, {0, 0, 1}};
  assert_ok(hf_pose_set_transform(pose, numbers[1], &turned));
  double bent[3 * CUT_VERTICES], whole[3 * CUT_VERTICES], part[3 * 5], most = 0;
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = HF_ARRAY_OUT(bent, CUT_VERTICES);
  desc.restart = 1;
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  assert_ok(hf_pose_set_rigid_pieces(pose, 1, &piece));
  desc.positions = HF_ARRAY_OUT(whole, CUT_VERTICES);
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  for (int i = 0; i < 3 * CUT_VERTICES; ++i) most = fmax(most, fabs(bent[i] - whole[i]));
  assert_true(most > 1e-3);
  desc.positions = HF_ARRAY_OUT(part, 5);
  desc.first_vertex = CUT_ISLAND + 2;
  desc.vertex_count = 5;
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  assert_memory_equal(part, whole + 3 * (CUT_ISLAND + 2), sizeof part);
  hf_pose_destroy(pose);
}

/* ---- refused ---- */

static hf_links_desc bad;
static hf_link one;
static hf_surface out;
static double* expected;
static uint16_t joints[CUT_VERTICES];
static float weights[CUT_VERTICES], posed[3 * CUT_VERTICES];
static uint32_t vertex_list[2], parents[3];
static hf_array posed_rows;
static hf_gaps_info gaps_info;

static void good_input(void) {
  memset(&one, 0, sizeof one);
  one.vertex = CUT_ISLAND;
  one.corners[0] = 0;
  one.corners[1] = 1;
  one.corners[2] = 6;
  one.barycentrics[0] = 0.5;
  one.barycentrics[1] = 0.25;
  one.barycentrics[2] = 0.25;
  one.weight = 1;
  bad = HF_INIT(hf_links_desc);
  bad.mode = HF_LINK_LIST;
  bad.link_count = 1;
  bad.links = &one;
  vertex_list[0] = CUT_LEFT;
  vertex_list[1] = CUT_ISLAND;
  for (int v = 0; v < CUT_VERTICES; ++v) {
    joints[v] = 0;
    weights[v] = 1;
  }
  memcpy(posed, mesh.positions, sizeof posed);
  gaps_info = HF_INIT(hf_gaps_info);
  posed_rows = HF_ARRAY(posed, CUT_VERTICES);
  out = linked; /* must become NULL */
}
static int nothing_changed(void) {
  double* now = field_on(linked);
  const int same = same_bits(now, expected, CUT_VERTICES * sizeof *now);
  free(now);
  return same && out != NULL ? out == linked : same;
}
static void automatic_with_skin(void) {
  bad = automatic();
  bad.influence_count = 1;
  bad.joints = joints;
  bad.weights = weights;
}
static void with_skeleton(void) {
  automatic_with_skin();
  parents[0] = HF_NO_INDEX;
  parents[1] = 0;
  parents[2] = 1;
  bad.joint_count = 3;
  bad.joint_parents = parents;
}
static uint32_t linked_vertex;
static void spoil_linked_vertex(void) { posed[3 * linked_vertex] = NAN; }
static void light_list(uint32_t count) {
  bad.light_count = count;
  bad.light_vertices = vertex_list;
}
static void heavy_list(uint32_t count) {
  bad.heavy_count = count;
  bad.heavy_vertices = vertex_list;
}

#define GOOD good_input
#define UNCHANGED nothing_changed
#define RELINK(what, code, index, change) ROW(what, code, index, change, hf_surface_relink(linked, &bad, NULL, &out))

static void bad_links_are_refused_by_index_and_change_nothing(void** state) {
  (void)state;
  expected = field_on(linked);
  uint32_t count = 0;
  hf_link* list = links_of(linked, &count);
  linked_vertex = list[0].vertex;
  free(list);
  good_input();
  assert_ok(hf_surface_relink(linked, &bad, NULL, &out));
  hf_surface_destroy(out);
  RELINK("a mode that is none", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, bad.mode = 3);
  RELINK("no list", HF_ERROR_NULL_POINTER, NO_INDEX, bad.links = NULL);
  RELINK("a list without the mode", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, bad.mode = HF_LINK_PIECES);
  RELINK("vertex out of range", HF_ERROR_OUT_OF_RANGE, 0, one.vertex = CUT_VERTICES);
  RELINK("isolated vertex", HF_ERROR_INVALID_ARGUMENT, 0, one.vertex = CUT_ISOLATED);
  RELINK("corner out of range", HF_ERROR_OUT_OF_RANGE, 0, one.corners[2] = HF_NO_INDEX);
  RELINK("vertex to itself", HF_ERROR_INVALID_ARGUMENT, 0, one.corners[1] = CUT_ISLAND);
  RELINK("negative barycentric", HF_ERROR_INVALID_ARGUMENT, 0, one.barycentrics[1] = -0.25);
  RELINK("barycentrics of sum 2", HF_ERROR_INVALID_ARGUMENT, 0, one.barycentrics[1] = 1.25);
  RELINK("barycentric not finite", HF_ERROR_NON_FINITE, 0, one.barycentrics[0] = (double)NAN);
  RELINK("weight 0", HF_ERROR_INVALID_ARGUMENT, 0, one.weight = 0);
  RELINK("weight not finite", HF_ERROR_NON_FINITE, 0, one.weight = INFINITY);
  RELINK("stiffness below 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, bad.stiffness = -1);
  RELINK("stiffness not finite", HF_ERROR_NON_FINITE, NO_INDEX, bad.stiffness = NAN);
  RELINK("distance below 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, bad.distance = -1);
  RELINK("distance not finite", HF_ERROR_NON_FINITE, NO_INDEX, bad.distance = NAN);
  RELINK("overlay not finite", HF_ERROR_NON_FINITE, NO_INDEX, bad.overlay_distance = INFINITY);
  RELINK("too many influences", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (automatic_with_skin(), bad.influence_count = 65));
  RELINK("influences without a count", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (automatic_with_skin(), bad.influence_count = 0));
  RELINK("no joints", HF_ERROR_NULL_POINTER, NO_INDEX, (automatic_with_skin(), bad.joints = NULL));
  RELINK("no weights", HF_ERROR_NULL_POINTER, NO_INDEX, (automatic_with_skin(), bad.weights = NULL));
  RELINK("weight of a vertex not finite", HF_ERROR_NON_FINITE, 9, (automatic_with_skin(), weights[9] = NAN));
  RELINK("no parents", HF_ERROR_NULL_POINTER, NO_INDEX, (with_skeleton(), bad.joint_parents = NULL));
  RELINK("parents without a count", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (with_skeleton(), bad.joint_count = 0));
  RELINK("65,537 joints", HF_ERROR_TOO_LARGE, NO_INDEX, (with_skeleton(), bad.joint_count = 65537));
  RELINK("parents without a skin", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
         (with_skeleton(), bad.influence_count = 0, bad.joints = NULL, bad.weights = NULL));
  RELINK("a parent that is none", HF_ERROR_OUT_OF_RANGE, 2, (with_skeleton(), parents[2] = 3));
  RELINK("parents in a circle", HF_ERROR_INVALID_ARGUMENT, 1, (with_skeleton(), parents[1] = 2));
  RELINK("a joint that is none", HF_ERROR_OUT_OF_RANGE, 9, (with_skeleton(), joints[9] = 3));
  RELINK("reserved", HF_ERROR_INVALID_DESC, NO_INDEX, bad.reserved = 1);
  RELINK("light vertices missing", HF_ERROR_NULL_POINTER, NO_INDEX, bad.light_count = 1);
  RELINK("light vertex out of range", HF_ERROR_OUT_OF_RANGE, 1, (light_list(2), vertex_list[1] = CUT_VERTICES));
  RELINK("heavy vertex out of range", HF_ERROR_OUT_OF_RANGE, 0, (heavy_list(1), vertex_list[0] = CUT_VERTICES));
  RELINK("heavy and light", HF_ERROR_INVALID_ARGUMENT, 0, (light_list(1), heavy_list(2), vertex_list[0] = CUT_ISLAND));
  ROW("no list", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_get_links(linked, 0, NULL, NULL));
  ROW("short list", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_surface_get_links(linked, 0, &one, NULL));
  ROW("no array", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_get_pieces(linked, 0, NULL, NULL, NULL));
  ROW("short array", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_surface_get_pieces(linked, 1, vertex_list, NULL, NULL));
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_surface_measure_gaps(linked, &posed_rows, 0, NULL, NULL));
  ROW("no array", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_measure_gaps(linked, NULL, 0, NULL, &gaps_info));
  ROW("no positions", HF_ERROR_NULL_POINTER, NO_INDEX, posed_rows.data = NULL,
      hf_surface_measure_gaps(linked, &posed_rows, 0, NULL, &gaps_info));
  ROW("short gaps", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_surface_measure_gaps(linked, &posed_rows, 0, one.barycentrics, &gaps_info));
  ROW("stride", HF_ERROR_TOO_SMALL, NO_INDEX, posed_rows.stride = 8,
      hf_surface_measure_gaps(linked, &posed_rows, 0, NULL, &gaps_info));
  ROW("position not finite", HF_ERROR_NON_FINITE, linked_vertex, spoil_linked_vertex(),
      hf_surface_measure_gaps(linked, &posed_rows, 0, NULL, &gaps_info));
  ROW("destroyed surface", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_surface_relink(NULL, &bad, NULL, &out));
  free(expected);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fields_span_linked_pieces),
      cmocka_unit_test(what_works_on_triangles_does_not_see_links),
      cmocka_unit_test(the_list_read_back_makes_the_same_bits),
      cmocka_unit_test(a_list_with_its_light_pieces_makes_the_same_bits),
      cmocka_unit_test(a_saved_factor_needs_its_links),
      cmocka_unit_test(other_links_keep_the_ordering_where_the_pattern_allows),
      cmocka_unit_test(a_pose_takes_linked_pieces_along_and_gaps_are_measured),
      cmocka_unit_test(a_touching_piece_that_slides_opens_nothing),
      cmocka_unit_test(a_range_of_a_frame_has_the_rigid_piece_of_the_whole),
      cmocka_unit_test(bad_links_are_refused_by_index_and_change_nothing),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
