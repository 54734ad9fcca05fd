/* Arrays out, one protocol for all: NULL arrays ask for the counts; a capacity too small writes the counts and nothing
 * else; the exact size works; what an array has more than the count stays as it was. check_protocol.sh sees that no
 * function with a capacity is missing here. */
#include "bad_scene.h"
#include "support/stick_man.h"

static Scene scene;
static hf_quads quads;
static hf_flow flow;
static double height[TUBE_VERTICES];
static hf_surface parted;        /* the octahedra, one cut open */
static hf_surface linked;        /* two octahedra side by side */
static hf_region curved;         /* enclosed by a curve round the tube */
static hf_direction round_field; /* on a closed surface, where the field has singularities */
static hf_skeleton skeleton;     /* of a stick man, played on itself */
static hf_retarget retarget;

enum { DIMENSIONS = 4, ARRAYS = 8 };

/* One array: which capacity it follows, the bytes of an entry, and how many entries more than that it has. */
typedef struct Array {
  int dimension;
  size_t entry, more;
} Array;

/* One call: arrays may be NULL; counts are what the function wrote. */
typedef struct Call {
  size_t capacity[DIMENSIONS], count[DIMENSIONS];
  void* array[ARRAYS];
} Call;

static hf_array heights(void) { return HF_ARRAY(height, TUBE_VERTICES); }

static hf_result get_stiffness(Call* c) {
  uint32_t count = 0;
  const hf_result r = hf_surface_get_stiffness(scene.sheet, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result get_cuts(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_surface_get_cuts(parted, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result trace_cut(Call* c) {
  const hf_place line[2] = {{{0, TUBE_AROUND, 1}, 0, {0.6, 0.01, 0.39}},
                            {{1, TUBE_AROUND, TUBE_AROUND + 1}, 0, {0.3, 0.4, 0.3}}};
  hf_cut_desc desc = HF_INIT(hf_cut_desc);
  desc.point_count = 2;
  desc.places = line;
  hf_cut cut = HF_INIT(hf_cut);
  cut.removed_triangle_capacity = (uint32_t)c->capacity[0];
  cut.new_vertex_capacity = (uint32_t)c->capacity[1];
  cut.new_triangle_capacity = (uint32_t)c->capacity[2];
  cut.rim_capacity = (uint32_t)c->capacity[3];
  cut.removed_triangles = c->array[0];
  cut.new_positions = c->array[1];
  cut.vertex_corners = c->array[2];
  cut.vertex_barycentrics = c->array[3];
  cut.new_triangles = c->array[4];
  cut.source_triangles = c->array[5];
  cut.corner_barycentrics = c->array[6];
  cut.rim_vertices = c->array[7];
  const hf_result r = hf_surface_trace_cut(scene.body, &desc, &cut);
  c->count[0] = cut.removed_triangle_count;
  c->count[1] = cut.new_vertex_count;
  c->count[2] = cut.new_triangle_count;
  c->count[3] = cut.rim_count;
  return r;
}
static hf_result get_components(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_surface_get_components(scene.sheet, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result get_links(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_surface_get_links(linked, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result get_pieces(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_surface_get_pieces(linked, (uint32_t)c->capacity[0], c->array[0], c->array[1], &count);
  c->count[0] = count;
  return r;
}
static hf_result measure_gaps(Call* c) {
  float posed[36] = {0};
  const hf_array desc = HF_ARRAY(posed, 12);
  hf_gaps_info info = HF_INIT(hf_gaps_info);
  const hf_result r = hf_surface_measure_gaps(linked, &desc, (uint32_t)c->capacity[0], c->array[0], &info);
  c->count[0] = info.link_count;
  return r;
}
static hf_result save(Call* c) {
  return hf_surface_save(scene.sheet, HF_FIELD_HARMONIC, NULL, c->capacity[0], c->array[0], &c->count[0]);
}
static hf_result find_critical_points(Call* c) {
  const hf_array field = heights();
  hf_critical_info info = HF_INIT(hf_critical_info);
  const hf_result r = hf_surface_find_critical_points(scene.body, &field, (uint32_t)c->capacity[0], c->array[0], &info);
  c->count[0] = info.point_count;
  return r;
}
static hf_result find_extremities(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_surface_find_extremities(scene.body, NULL, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result propose(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_surface_propose_handles(scene.body, NULL, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result trace_isolines(Call* c) {
  const hf_array field = heights();
  const double levels[2] = {3.5, 8.25};
  hf_isolines lines = HF_INIT(hf_isolines);
  lines.point_capacity = (uint32_t)c->capacity[0];
  lines.line_capacity = (uint32_t)c->capacity[1];
  lines.point_edges = c->array[0];
  lines.parameters = c->array[1];
  lines.positions = c->array[2];
  lines.line_starts = c->array[3];
  lines.line_levels = c->array[4];
  lines.line_closed = c->array[5];
  const hf_result r = hf_surface_trace_isolines(scene.body, &field, 2, levels, &lines);
  c->count[0] = lines.point_count;
  c->count[1] = lines.line_count;
  return r;
}
static hf_result find_path(Call* c) {
  const hf_place from = {{0, 0, 0}, 0, {1, 0, 0}};
  const hf_place to = {{TUBE_VERTICES - 2, 0, 0}, 0, {1, 0, 0}};
  hf_path path = HF_INIT(hf_path);
  path.point_capacity = (uint32_t)c->capacity[0];
  path.point_edges = c->array[0];
  path.parameters = c->array[1];
  path.positions = c->array[2];
  const hf_result r = hf_geodesics_find_path(scene.geodesics, &from, &to, &path);
  c->count[0] = path.point_count;
  return r;
}
static hf_result flow_trace(Call* c) {
  const hf_array field = heights();
  hf_streamlines lines = HF_INIT(hf_streamlines);
  lines.wanted_count = 5;
  lines.point_capacity = (uint32_t)c->capacity[0];
  lines.line_capacity = (uint32_t)c->capacity[1];
  lines.positions = c->array[0];
  lines.values = c->array[1];
  lines.line_starts = c->array[2];
  lines.line_ends = c->array[3];
  const hf_result r = hf_flow_trace(flow, &field, &lines);
  c->count[0] = lines.point_count;
  c->count[1] = lines.line_count;
  return r;
}
static hf_result quads_get_mesh(Call* c) {
  hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
  mesh.vertex_capacity = (uint32_t)c->capacity[0];
  mesh.face_capacity = (uint32_t)c->capacity[1];
  mesh.positions = c->array[0];
  mesh.triangles = c->array[1];
  mesh.barycentrics = c->array[2];
  mesh.corners = c->array[3];
  mesh.faces = c->array[4];
  const hf_result r = hf_quads_get_mesh(quads, &mesh);
  c->count[0] = mesh.vertex_count;
  c->count[1] = mesh.face_count;
  return r;
}
static hf_result get_sites(Call* c) {
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = (uint32_t)c->capacity[0];
  info.sites = c->array[0];
  info.vertices = c->array[1];
  info.components = c->array[2];
  info.values = c->array[3];
  info.stiffness = c->array[4];
  info.flux = c->array[5];
  info.radii = c->array[6];
  const hf_result r = hf_solver_get_sites(scene.solver, &info);
  c->count[0] = info.count;
  return r;
}
static hf_result direction_get_sites(Call* c) {
  uint32_t count = 777;
  const hf_result r =
      hf_direction_get_sites(scene.direction, (uint32_t)c->capacity[0], c->array[0], c->array[1], c->array[2], &count);
  c->count[0] = count;
  return r;
}
static hf_result get_singularities(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_direction_get_singularities(round_field, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result region_get_vertices(Call* c) {
  uint32_t count = 777;
  const hf_result r =
      hf_region_get_vertices(scene.region, HF_REGION_RIM, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result region_get_curve(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_region_get_curve(curved, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result weights_get(Call* c) {
  hf_weights_out out = HF_INIT(hf_weights_out);
  out.vertex_capacity = (uint32_t)c->capacity[0];
  out.joints = c->array[0];
  out.joints_u16 = c->array[1];
  out.weights = c->array[2];
  out.origins = c->array[3];
  const hf_result r = hf_weights_get(scene.weights, &out);
  c->count[0] = out.vertex_count;
  return r;
}
static hf_result weights_get_bones(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_weights_get_joints(scene.weights, (uint32_t)c->capacity[0], c->array[0], c->array[1], &count);
  c->count[0] = count;
  return r;
}
static hf_result weights_get_helpers(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_weights_get_helpers(scene.weights, NULL, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static uint32_t one_joint[TUBE_VERTICES];
static float one_share[TUBE_VERTICES];
static hf_weights_out to_weights(const Call* c) {
  for (int v = 0; v < TUBE_VERTICES; ++v) one_share[v] = 1;
  hf_weights_out out = HF_INIT(hf_weights_out);
  out.vertex_capacity = (uint32_t)c->capacity[0];
  out.joints = c->array[0];
  out.joints_u16 = c->array[1];
  out.weights = c->array[2];
  out.origins = c->array[3];
  return out;
}
static hf_result weights_carry(Call* c) {
  hf_weights_out out = to_weights(c);
  hf_weights_transfer_desc desc = HF_INIT(hf_weights_transfer_desc);
  desc.source_influence_count = 1;
  desc.joints = one_joint;
  desc.weights = one_share;
  const hf_result r = hf_weights_transfer(scene.body, scene.body, &desc, &out, NULL);
  c->count[0] = out.vertex_count;
  return r;
}
static hf_result weights_mirror(Call* c) {
  static const double head[3] = {0, 0, 0};
  hf_weights_out out = to_weights(c);
  hf_weights_mirror_desc desc = HF_INIT(hf_weights_mirror_desc);
  desc.joint_count = 1;
  desc.heads = head;
  desc.source_influence_count = 1;
  desc.joints = one_joint;
  desc.weights = one_share;
  const hf_result r = hf_weights_mirror(scene.body, &desc, &out, NULL, NULL, NULL, NULL);
  c->count[0] = out.vertex_count;
  return r;
}
static void to_skin(const Call* c, hf_skin_info* skin) {
  skin->joint_capacity = (uint32_t)c->capacity[0];
  skin->vertex_capacity = (uint32_t)c->capacity[1];
  skin->pivots = c->array[0];
  skin->rotations = c->array[1];
  skin->translations = c->array[2];
  skin->axes = c->array[3];
  skin->scales = c->array[4];
  skin->vertex_joints = c->array[5];
  skin->vertex_weights = c->array[6];
}
static hf_result pose_get_skin(Call* c) {
  hf_skin_info skin = HF_INIT(hf_skin_info);
  to_skin(c, &skin);
  const hf_result r = hf_pose_get_skin(scene.pose, &skin);
  c->count[0] = skin.joint_count;
  c->count[1] = skin.vertex_count;
  return r;
}
static hf_result pose_get_blend_rows(Call* c) {
  hf_blend_rows rows_of = HF_INIT(hf_blend_rows);
  rows_of.vertex_capacity = (uint32_t)c->capacity[0];
  rows_of.entry_capacity = (uint32_t)c->capacity[1];
  rows_of.rows = c->array[0];
  rows_of.positions = c->array[1];
  rows_of.normals = c->array[2];
  rows_of.offsets = c->array[3];
  rows_of.clusters = c->array[4];
  rows_of.weights = c->array[5];
  rows_of.gradients = c->array[6];
  const hf_result r = hf_pose_get_blend_rows(scene.pose, &rows_of);
  c->count[0] = rows_of.vertex_count;
  c->count[1] = rows_of.entry_count;
  return r;
}
static hf_result pose_get_blend_influences(Call* c) {
  hf_blend_influences rows_of = HF_INIT(hf_blend_influences);
  rows_of.vertex_capacity = (uint32_t)c->capacity[0];
  rows_of.influence_count = 4;
  rows_of.clusters = c->array[0];
  rows_of.weights = c->array[1];
  rows_of.byte_clusters = c->array[2];
  rows_of.byte_weights = c->array[3];
  const hf_result r = hf_pose_get_blend_influences(scene.pose, &rows_of);
  c->count[0] = rows_of.vertex_count;
  return r;
}
static hf_result pose_get_blend_transforms(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_pose_get_blend_transforms(scene.pose, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result transfer_get_skin(Call* c) {
  hf_skin_info skin = HF_INIT(hf_skin_info);
  to_skin(c, &skin);
  const hf_result r = hf_transfer_get_skin(scene.transfer, &skin);
  c->count[0] = skin.joint_count;
  c->count[1] = skin.vertex_count;
  return r;
}
static hf_result skeleton_get_joints(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_skeleton_get_joints(skeleton, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result skeleton_get_chains(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_skeleton_get_chains(skeleton, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result skeleton_get_chain_joints(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_skeleton_get_chain_joints(skeleton, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result retarget_get_chains(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_retarget_get_chains(retarget, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result retarget_get_partners(Call* c) {
  uint32_t count = 777;
  const hf_result r = hf_retarget_get_partners(retarget, (uint32_t)c->capacity[0], c->array[0], &count);
  c->count[0] = count;
  return r;
}
static hf_result skeleton_get_reasons(Call* c) {
  return hf_skeleton_get_reasons(skeleton, c->capacity[0], c->array[0], &c->count[0]);
}

static const struct {
  const char* function;
  hf_result (*call)(Call*);
  Array arrays[ARRAYS]; /* up to an entry of 0 bytes */
  int together;         /* what an array holds depends on which others are asked for */
} functions[] = {
    {"hf_surface_get_components", get_components, {{0, 4, 0}}, 0},
    {"hf_surface_get_stiffness", get_stiffness, {{0, 8, 0}}, 0},
    {"hf_surface_get_cuts", get_cuts, {{0, sizeof(hf_cut_corner), 0}}, 0},
    {"hf_surface_trace_cut",
     trace_cut,
     {{0, 4, 0}, {1, 24, 0}, {1, 12, 0}, {1, 24, 0}, {2, 12, 0}, {2, 4, 0}, {2, 72, 0}, {3, 8, 0}},
     0},
    {"hf_surface_get_links", get_links, {{0, sizeof(hf_link), 0}}, 0},
    {"hf_surface_get_pieces", get_pieces, {{0, 4, 0}, {0, 4, 0}}, 0},
    {"hf_surface_measure_gaps", measure_gaps, {{0, 8, 0}}, 0},
    {"hf_surface_save", save, {{0, 1, 0}}, 0},
    {"hf_surface_find_critical_points", find_critical_points, {{0, sizeof(hf_critical_point), 0}}, 0},
    {"hf_surface_find_extremities", find_extremities, {{0, sizeof(hf_extremity), 0}}, 0},
    {"hf_surface_propose_handles", propose, {{0, sizeof(hf_handle_proposal), 0}}, 0},
    {"hf_surface_trace_isolines",
     trace_isolines,
     {{0, 8, 0}, {0, 8, 0}, {0, 24, 0}, {1, 4, 1}, {1, 4, 0}, {1, 4, 0}},
     0},
    {"hf_geodesics_find_path", find_path, {{0, 8, 0}, {0, 8, 0}, {0, 24, 0}}, 0},
    {"hf_flow_trace", flow_trace, {{0, 24, 0}, {0, 8, 0}, {1, 4, 1}, {1, 8, 0}}, 0},
    {"hf_quads_get_mesh", quads_get_mesh, {{0, 24, 0}, {0, 4, 0}, {0, 24, 0}, {0, 12, 0}, {1, 16, 0}}, 0},
    {"hf_solver_get_sites",
     get_sites,
     {{0, 4, 0}, {0, 4, 0}, {0, 4, 0}, {0, 8, 0}, {0, 8, 0}, {0, 8, 0}, {0, 8, 0}},
     0},
    {"hf_direction_get_sites", direction_get_sites, {{0, 4, 0}, {0, 4, 0}, {0, 24, 0}}, 0},
    {"hf_direction_get_singularities", get_singularities, {{0, sizeof(hf_singularity), 0}}, 0},
    {"hf_region_get_vertices", region_get_vertices, {{0, 4, 0}}, 0},
    {"hf_region_get_curve", region_get_curve, {{0, 24, 0}}, 0},
    {"hf_weights_get", weights_get, {{0, 16, 0}, {0, 8, 0}, {0, 16, 0}, {0, 1, 0}}, 0},
    {"hf_weights_get_joints", weights_get_bones, {{0, 4, 0}, {0, 4, 0}}, 0},
    {"hf_weights_get_helpers", weights_get_helpers, {{0, 4, 0}}, 0},
    {"hf_weights_transfer", weights_carry, {{0, 16, 0}, {0, 8, 0}, {0, 16, 0}, {0, 1, 0}}, 0},
    {"hf_weights_mirror", weights_mirror, {{0, 16, 0}, {0, 8, 0}, {0, 16, 0}, {0, 1, 0}}, 0},
    {"hf_skeleton_get_joints", skeleton_get_joints, {{0, sizeof(hf_joint_info), 0}}, 0},
    {"hf_skeleton_get_chains", skeleton_get_chains, {{0, sizeof(hf_chain), 0}}, 0},
    {"hf_skeleton_get_chain_joints", skeleton_get_chain_joints, {{0, 4, 0}}, 0},
    {"hf_retarget_get_chains", retarget_get_chains, {{0, sizeof(hf_chain_match), 0}}, 0},
    {"hf_retarget_get_partners", retarget_get_partners, {{0, 4, 0}}, 0},
    {"hf_skeleton_get_reasons", skeleton_get_reasons, {{0, 1, 0}}, 0},
    {"hf_pose_get_skin",
     pose_get_skin,
     {{0, 24, 0}, {0, 32, 0}, {0, 24, 0}, {0, 32, 0}, {0, 24, 0}, {1, 16, 0}, {1, 16, 0}},
     1},
    {"hf_pose_get_blend_rows",
     pose_get_blend_rows,
     {{0, 8, 0}, {0, 12, 0}, {0, 12, 0}, {0, 12, 0}, {1, 2, 0}, {1, 4, 0}, {1, 12, 0}},
     1},
    {"hf_pose_get_blend_influences", pose_get_blend_influences, {{0, 8, 0}, {0, 8, 0}, {0, 4, 0}, {0, 4, 0}}, 0},
    {"hf_pose_get_blend_transforms", pose_get_blend_transforms, {{0, 48, 0}}, 0},
    {"hf_transfer_get_skin",
     transfer_get_skin,
     {{0, 24, 0}, {0, 32, 0}, {0, 24, 0}, {0, 32, 0}, {0, 24, 0}, {1, 16, 0}, {1, 16, 0}},
     1},
};

static void linked_create(void) {
  static float corners[36];
  static uint32_t faces[48];
  static const float one[18] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  static const uint32_t of_one[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  for (int i = 0; i < 36; ++i) corners[i] = one[i % 18] + (i >= 18 && i % 3 == 0 ? 2.05f : 0.0f);
  for (uint32_t i = 0; i < 48; ++i) faces[i] = of_one[i % 24] + i / 24 * 6;
  hf_links_desc links = HF_INIT(hf_links_desc);
  links.mode = HF_LINK_PIECES;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(corners, 12);
  desc.triangles = HF_ARRAY(faces, 16);
  desc.links = &links;
  assert_ok(hf_surface_create(&desc, &linked));
  desc.links = NULL;
  hf_surface plain = NULL;
  assert_ok(hf_surface_create(&desc, &plain));
  const uint32_t edges[4] = {faces[0], faces[1], faces[1], faces[2]};
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.cut_edge_count = 2;
  patch.cut_edges = edges;
  hf_surface_edit_desc edit = HF_INIT(hf_surface_edit_desc);
  edit.patch = &patch;
  assert_ok(hf_surface_edit(plain, &edit, &parted));
  hf_surface_destroy(plain);
}

static void round_field_create(void) {
  static float corners[18] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  static uint32_t faces[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  const Surface octahedron = {6, 8, corners, faces};
  const hf_surface surface = surface_on(&octahedron);
  const uint32_t vertex = 0;
  const double up[3] = {0, 0, 1};
  assert_ok(hf_direction_create(surface, NULL, &round_field));
  assert_ok(hf_direction_add_sites(round_field, 1, &vertex, up, NULL));
  hf_surface_destroy(surface);
}

static void scene_with_quads_create(void) {
  scene_create(&scene);
  for (int v = 0; v < TUBE_VERTICES; ++v) height[v] = (double)scene.tube.positions[3 * v + 1] + 0.01 * sin(2.3 * v);
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.edge_length = 2;
  desc.relax_count = 2;
  assert_ok(hf_quads_create(scene.body, &desc, &quads));
  assert_ok(hf_flow_create(scene.body, &flow));
  const uint32_t round[3] = {5 * TUBE_AROUND, 5 * TUBE_AROUND + TUBE_AROUND / 3, 5 * TUBE_AROUND + 2 * TUBE_AROUND / 3};
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  hf_region_edit_desc enclose = HF_INIT(hf_region_edit_desc);
  curve.point_count = 3;
  curve.vertices = round;
  enclose.curve = &curve;
  assert_ok(hf_region_create(scene.body, NULL, &curved));
  assert_ok(hf_region_edit(curved, &enclose));
  round_field_create();
  const StickMan man = stick_man(1, 0);
  const hf_skeleton_desc joints = man_desc(&man, NULL);
  assert_ok(hf_skeleton_create(&joints, &skeleton));
  assert_ok(hf_retarget_create(skeleton, skeleton, NULL, &retarget));
  linked_create();
}

/* Two entries behind what is needed, so that what is written there is seen. */
static size_t bytes_of(const Array* a, const Call* asked) { return (asked->count[a->dimension] + a->more) * a->entry; }
static size_t room_of(const Array* a, const Call* asked) { return bytes_of(a, asked) + 2 * a->entry; }
static int all_bytes(const unsigned char* bytes, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i)
    if (bytes[i] != 0x5A) return 0;
  return 1;
}

/* Calls with the arrays of `only` (all: -1), in new memory of 0x5A. */
static hf_result call_with(size_t f, Call* c, const Call* asked, int only) {
  for (int i = 0; i < ARRAYS; ++i) {
    const Array* a = &functions[f].arrays[i];
    c->array[i] = NULL;
    if (a->entry == 0 || (only >= 0 && i != only)) continue;
    c->array[i] = malloc(room_of(a, asked));
    assert_non_null(c->array[i]);
    memset(c->array[i], 0x5A, room_of(a, asked));
  }
  for (int d = 0; d < DIMENSIONS; ++d) c->count[d] = 777777;
  return functions[f].call(c);
}
static void free_call(Call* c) {
  for (int i = 0; i < ARRAYS; ++i) {
    free(c->array[i]);
    c->array[i] = NULL;
  }
}
static int dimensions_of(size_t f) {
  int most = 0;
  for (int i = 0; i < ARRAYS; ++i)
    if (functions[f].arrays[i].entry && functions[f].arrays[i].dimension > most)
      most = functions[f].arrays[i].dimension;
  return most + 1;
}
static int counts_are(size_t f, const Call* c, const Call* asked) {
  return memcmp(c->count, asked->count, sizeof(size_t) * (size_t)dimensions_of(f)) == 0;
}

#define HOLDS(what, condition) row_holds(__LINE__, functions[f].function, what, condition), ++rows.count

static void null_arrays_ask(size_t f, Call* asked) {
  const char* name = functions[f].function;
  memset(asked, 0, sizeof *asked);
  check_row(__LINE__, "capacity 0, no arrays", name, functions[f].call(asked), HF_OK, NO_INDEX);
  for (int d = 0; d < dimensions_of(f); ++d) HOLDS("there is something to write", asked->count[d] > 0);
  Call large;
  memset(&large, 0, sizeof large);
  for (int d = 0; d < DIMENSIONS; ++d) large.capacity[d] = 1000000;
  check_row(__LINE__, "a capacity, no arrays", name, functions[f].call(&large), HF_OK, NO_INDEX);
  HOLDS("the counts do not depend on the capacity", counts_are(f, &large, asked));
}

static void too_small_writes_counts_alone(size_t f, const Call* asked) {
  for (int d = 0; d < dimensions_of(f); ++d) {
    for (int zero = 0; zero < 2; ++zero) {
      Call c;
      memcpy(c.capacity, asked->count, sizeof c.capacity);
      c.capacity[d] = zero ? 0 : asked->count[d] - 1;
      check_row(__LINE__, "one too few", functions[f].function, call_with(f, &c, asked, -1), HF_ERROR_TOO_SMALL,
                NO_INDEX);
      HOLDS("the counts are written with the error", counts_are(f, &c, asked));
      for (int i = 0; i < ARRAYS; ++i)
        if (c.array[i]) HOLDS("nothing is written", all_bytes(c.array[i], 0, room_of(&functions[f].arrays[i], asked)));
      free_call(&c);
    }
  }
}

static void enough_writes_what_is_there_and_no_more(size_t f, const Call* asked) {
  Call exact;
  memcpy(exact.capacity, asked->count, sizeof exact.capacity);
  check_row(__LINE__, "the exact size", functions[f].function, call_with(f, &exact, asked, -1), HF_OK, NO_INDEX);
  HOLDS("the counts are the same", counts_are(f, &exact, asked));
  Call more;
  for (int d = 0; d < DIMENSIONS; ++d) more.capacity[d] = asked->count[d] + 1;
  check_row(__LINE__, "one more than needed", functions[f].function, call_with(f, &more, asked, -1), HF_OK, NO_INDEX);
  HOLDS("the counts are the same", counts_are(f, &more, asked));
  for (int i = 0; i < ARRAYS; ++i) {
    const Array* a = &functions[f].arrays[i];
    if (a->entry == 0) continue;
    const size_t bytes = bytes_of(a, asked);
    HOLDS("something is written", !all_bytes(exact.array[i], 0, bytes));
    HOLDS("nothing behind", all_bytes(exact.array[i], bytes, room_of(a, asked)));
    HOLDS("the same bits with more room", same_bits(exact.array[i], more.array[i], bytes));
    HOLDS("the room that is left stays as it was", all_bytes(more.array[i], bytes, room_of(a, asked)));
    /* alone, with no capacity for the arrays that are not asked for */
    Call alone;
    memset(&alone, 0, sizeof alone);
    alone.capacity[a->dimension] = asked->count[a->dimension];
    check_row(__LINE__, "one array alone", functions[f].function, call_with(f, &alone, asked, i), HF_OK, NO_INDEX);
    HOLDS("the counts are the same", counts_are(f, &alone, asked));
    if (!functions[f].together) HOLDS("the same bits alone", same_bits(exact.array[i], alone.array[i], bytes));
    HOLDS("nothing behind", all_bytes(alone.array[i], bytes, room_of(a, asked)));
    free_call(&alone);
  }
  free_call(&exact);
  free_call(&more);
}

static void every_function_with_a_capacity_keeps_the_protocol(void** state) {
  (void)state;
  scene_with_quads_create();
  for (size_t f = 0; f < COUNT_OF(functions); ++f) {
    Call asked;
    null_arrays_ask(f, &asked);
    too_small_writes_counts_alone(f, &asked);
    enough_writes_what_is_there_and_no_more(f, &asked);
  }
  finish_rows("arrays out");
  hf_quads_destroy(quads);
  hf_flow_destroy(flow);
  hf_direction_destroy(round_field);
  hf_retarget_destroy(retarget);
  hf_skeleton_destroy(skeleton);
  hf_region_destroy(curved);
  hf_surface_destroy(linked);
  hf_surface_destroy(parted);
  scene_destroy(&scene);
}

static void nothing_to_write_is_a_count_of_zero(void** state) {
  (void)state;
  scene_create(&scene);
  uint32_t count = 777, vertices[1] = {777};
  hf_region empty = NULL;
  assert_ok(hf_region_create(scene.body, NULL, &empty));
  assert_ok(hf_region_get_vertices(empty, HF_REGION_INSIDE, 0, NULL, &count));
  assert_int_equal(count, 0);
  count = 777;
  assert_ok(hf_region_get_vertices(empty, HF_REGION_INSIDE, 0, vertices, &count));
  assert_int_equal(count, 0);
  count = 777;
  assert_ok(hf_region_get_curve(empty, 0, NULL, &count));
  assert_int_equal(count, 0);
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.sites = vertices;
  info.count = 777;
  assert_ok(hf_solver_get_sites(scene.three, &info));
  assert_int_equal(info.count, 0);
  assert_int_equal(vertices[0], 777);
  hf_region_destroy(empty);
  scene_destroy(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_function_with_a_capacity_keeps_the_protocol),
      cmocka_unit_test(nothing_to_write_is_a_count_of_zero),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
