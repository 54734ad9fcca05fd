#include "support/peers.h"
#include "thread_stories.h"

#include "support/arrays.h"

namespace reliability {
namespace {

hf_sites_desc sites_desc(const std::vector<std::uint32_t>& vertices, const double* values) {
  hf_sites_desc d = desc<hf_sites_desc>();
  d.site_count = static_cast<std::uint32_t>(vertices.size());
  d.vertices = vertices.data();
  d.values = values;
  return d;
}

// A patch of four by five vertices that starts at this ring and column.
std::vector<std::uint32_t> patch_at(const Scene& s, std::uint32_t ring, std::uint32_t column) {
  std::vector<std::uint32_t> patch;
  for (std::uint32_t r = ring; r < ring + 4; ++r)
    for (std::uint32_t i = column; i < column + 5; ++i) patch.push_back(r * s.around + i);
  return patch;
}

hf_result edit_to(hf_region region, const std::vector<std::uint32_t>& patch) {
  hf_region_edit_desc edit = desc<hf_region_edit_desc>();
  edit.add_count = static_cast<std::uint32_t>(patch.size());
  edit.add_vertices = patch.data();
  return hf_region_edit(region, &edit);
}

hf_result add_ends(const Scene& s, hf_pose pose, std::uint32_t* handles) {
  const std::uint32_t counts[2] = {2 * s.around, 2 * s.around};
  hf_handles_desc regions = desc<hf_handles_desc>();
  regions.handle_count = 2;
  regions.region_counts = counts;
  regions.region_vertices = s.ends.data();
  return hf_pose_add_handles(pose, &regions, handles);
}

hf_result add_pairs(const Scene& s, hf_transfer transfer) {
  const std::uint32_t counts[2] = {2 * s.around, 2 * s.around};
  hf_pairs_desc pairs = desc<hf_pairs_desc>();
  pairs.pair_count = 2;
  pairs.source_counts = pairs.target_counts = counts;
  pairs.source_vertices = pairs.target_vertices = s.ends.data();
  return hf_transfer_add_pairs(transfer, &pairs, nullptr);
}

hf_result turn(hf_pose pose, std::uint32_t handle, double angle) {
  const hf_transform to = {{0, std::sin(angle / 2), 0, std::cos(angle / 2)}, {angle, 0.5, -0.25}};
  return hf_pose_set_transforms(pose, 1, &handle, &to);
}

void take_pose(const Scene& s, hf_pose pose, Seen& seen) {
  std::vector<double> positions(3 * std::size_t{s.vertex_count});
  hf_deform_desc d = desc<hf_deform_desc>();
  d.positions = ROWS_OUT(positions.data());
  d.refine = 1;
  seen.call(hf_pose_deform(pose, &d, nullptr));
  seen.take(positions);
}

void take_field(const Scene& s, hf_solver solver, Seen& seen) {
  std::vector<double> field(s.vertex_count);
  seen.call(hf_solver_solve(solver, OUT(field.data()), nullptr));
  seen.take(field);
}

void take_region(const Scene& s, hf_region region, Seen& seen) {
  hf_region_info info = desc<hf_region_info>();
  seen.call(hf_region_get_info(region, &info));
  seen.take(&info, 1);
  std::vector<std::uint32_t> rim(info.rim_count);
  seen.call(hf_region_get_vertices(region, HF_REGION_RIM, info.rim_count, rim.data(), nullptr));
  seen.take(rim);
  std::vector<double> positions(3 * std::size_t{s.vertex_count});
  hf_morph_desc morph = desc<hf_morph_desc>();
  morph.weight = 0.5;
  morph.positions = ROWS_OUT(positions.data());
  seen.call(hf_region_morph(region, &morph));
  seen.take(positions);
}

void take_direction(const Scene& s, hf_direction direction, Seen& seen) {
  std::vector<double> vectors(3 * std::size_t{s.vertex_count});
  seen.call(hf_direction_solve(direction, OUT(vectors.data()), nullptr));
  seen.take(vectors);
}

}  // namespace

Objects make_objects(const Scene& s) {
  Objects o;
  hf_surface_desc d = desc<hf_surface_desc>();
  d.positions = HF_ARRAY(s.positions.data(), s.vertex_count);
  d.triangles = HF_ARRAY(s.triangles.data(), s.triangle_count);
  d.thread_count = 3;  // the threads of the surface; eight callers ask for them at once
  o.surface = make_surface(d);
  o.solver = make_solver(o.surface);
  d.field_kind = HF_FIELD_BIHARMONIC;
  o.bent = make_surface(d);
  const std::vector<std::uint32_t> vertices = {3, 100, 400, 801, 1200};
  const hf_sites_desc sites = sites_desc(vertices, s.values.data());
  must(hf_add_sites(o.solver, &sites, nullptr), "hf_add_sites");
  o.refactor = make_solver(o.surface, desc<hf_solver_desc>(), ENGINE_REFACTOR);
  must(hf_add_sites(o.refactor, &sites, nullptr), "hf_add_sites, refactor");
  must(hf_geodesics_create(o.surface, nullptr, &o.geodesics), "hf_geodesics_create");
  must(hf_flow_create(o.surface, &o.flow), "hf_flow_create");
  hf_quads_desc quads = desc<hf_quads_desc>();
  quads.edge_length = 0.5;
  must(hf_quads_create(o.surface, &quads, &o.quads), "hf_quads_create");
  must(hf_direction_create(o.surface, nullptr, &o.direction), "hf_direction_create");
  must(hf_direction_add_sites(o.direction, 4, vertices.data(), s.vectors.data(), nullptr), "hf_direction_add_sites");
  must(hf_pose_create(o.surface, nullptr, &o.pose), "hf_pose_create");
  std::uint32_t handles[2];
  must(add_ends(s, o.pose, handles), "hf_pose_add_handles");
  must(turn(o.pose, handles[1], 0.7), "transforms");
  must(hf_region_create(o.surface, nullptr, &o.region), "hf_region_create");
  must(hf_region_clone(o.region, &o.target), "hf_region_clone");
  must(edit_to(o.region, patch_at(s, 5, 3)), "hf_region_edit");
  must(edit_to(o.target, patch_at(s, 14, 6)), "hf_region_edit, target");
  must(hf_detail_create(o.region, o.target, nullptr, &o.detail), "hf_detail_create");
  Seen posed;
  take_pose(s, o.pose, posed);
  must(hf_transfer_create(o.surface, o.bent, nullptr, &o.transfer), "hf_transfer_create");
  must(add_pairs(s, o.transfer), "hf_transfer_add_pairs");
  return o;
}

Objects clones_of(const Objects& o) {
  Objects made;
  must(hf_solver_clone(o.solver, &made.solver), "hf_solver_clone");
  must(hf_solver_clone(o.refactor, &made.refactor), "hf_solver_clone");
  must(hf_pose_clone(o.pose, &made.pose), "hf_pose_clone");
  must(hf_direction_clone(o.direction, &made.direction), "hf_direction_clone");
  must(hf_region_clone(o.region, &made.region), "hf_region_clone");
  return made;
}

void destroy(const Objects& o) {
  hf_surface_destroy(o.surface);
  hf_surface_destroy(o.bent);
  hf_solver_destroy(o.solver);
  hf_solver_destroy(o.refactor);
  hf_region_destroy(o.region);
  hf_region_destroy(o.target);
  hf_pose_destroy(o.pose);
  hf_direction_destroy(o.direction);
  hf_detail_destroy(o.detail);
  hf_quads_destroy(o.quads);
  hf_flow_destroy(o.flow);
  hf_geodesics_destroy(o.geodesics);
  hf_transfer_destroy(o.transfer);
}

namespace {

// ---- readers: every thread gets the same answer ----

void read_solver(const Scene& s, const Objects& o, unsigned, Seen& seen) {
  take_field(s, o.solver, seen);
  take_field(s, o.refactor, seen);
  std::vector<double> preview(s.vertex_count);
  hf_preview_info reached = desc<hf_preview_info>();
  seen.call(hf_solver_solve_preview(o.solver, OUT(preview.data()), 1, &reached));
  seen.take(preview);
  const std::uint32_t asked[2] = {5, 700};
  double at[2];
  seen.call(hf_solver_solve_at(o.solver, 2, asked, at));
  seen.take(at, 2);
  hf_certificate certificate = desc<hf_certificate>();
  seen.call(hf_solver_certify(o.solver, &certificate));
  double values[5];
  hf_sites_info sites = desc<hf_sites_info>();
  sites.capacity = 5;
  sites.values = values;
  seen.call(hf_solver_get_sites(o.solver, &sites));
  seen.take(values, 5);
  hf_solver_statistics statistics = desc<hf_solver_statistics>();
  seen.call(hf_solver_get_statistics(o.solver, &statistics));
  seen.take(&statistics.site_count, 1);
}

// Reads the surfaces, saves each kind of factor, and makes the kinds that they lack.
void read_surfaces(const Scene& s, const Objects& o, unsigned, Seen& seen) {
  std::vector<std::uint32_t> components(s.vertex_count);
  seen.call(hf_surface_get_components(o.surface, s.vertex_count, components.data(), nullptr));
  seen.take(components);
  hf_hit hit = desc<hf_hit>();
  seen.call(hf_surface_cast_ray(o.surface, s.ray.data(), s.ray.data() + 3, nullptr, &hit));
  seen.take(&hit, 1);
  hf_pick_desc posed = desc<hf_pick_desc>();
  posed.positions = HF_ARRAY(s.posed.data(), s.posed.size() / 3);
  std::uint32_t nearest = 0;
  seen.call(hf_surface_find_vertex(o.surface, s.points.data(), &posed, &nearest, nullptr));
  seen.take(&nearest, 1);
  for (const hf_surface surface : {o.surface, o.bent}) {
    hf_surface_info info = desc<hf_surface_info>();
    seen.call(hf_surface_get_info(surface, &info));
    seen.take(&info, 1);
    for (int kind = 0; kind < 3; ++kind) {
      std::size_t size = 0;
      seen.call(hf_surface_save(surface, kind, nullptr, 0, nullptr, &size));
      std::vector<unsigned char> bytes(size);
      seen.call(hf_surface_save(surface, kind, nullptr, size, bytes.data(), nullptr));
      seen.take(bytes);
      hf_solver_desc wanted = desc<hf_solver_desc>();
      wanted.field_kind = kind;
      hf_solver solver = nullptr;
      seen.call(hf_create(surface, &wanted, &solver));
      const std::vector<std::uint32_t> vertices = {3, 400, 1200};
      const hf_sites_desc sites = sites_desc(vertices, s.values.data());
      seen.call(hf_add_sites(solver, &sites, nullptr));
      take_field(s, solver, seen);
      hf_solver_destroy(solver);
    }
  }
}

// Reads a transfer that was never applied. The first reader solves its fields.
void read_transfer(const Scene& s, const Objects& o, unsigned, Seen& seen) {
  for (std::uint32_t p = 0; p < 2; ++p) {
    hf_pair_info pair = desc<hf_pair_info>();
    seen.call(hf_transfer_get_pair(o.transfer, p, &pair));
    seen.take(&pair, 1);
  }
  hf_transfer_info info = desc<hf_transfer_info>();
  seen.call(hf_transfer_get_info(o.transfer, &info));
  seen.take(&info, 1);
  hf_skin_info skin = desc<hf_skin_info>();
  seen.call(hf_transfer_get_skin(o.transfer, &skin));
  std::vector<float> weights(4 * std::size_t{s.vertex_count});
  std::vector<double> pivots(3 * std::size_t{skin.joint_count});
  skin.joint_capacity = skin.joint_count;
  skin.vertex_capacity = skin.vertex_count;
  skin.vertex_weights = weights.data();
  skin.pivots = pivots.data();
  seen.call(hf_transfer_get_skin(o.transfer, &skin));
  seen.take(weights);
  seen.take(pivots);
}

void read_analysis(const Scene& s, const Objects& o, unsigned, Seen& seen) {
  const hf_array field = HF_ARRAY(s.height.data(), s.height.size());
  double levels[6];
  seen.call(hf_surface_space_levels(o.surface, &field, HF_LEVELS_AREA, 6, levels));
  seen.take(levels, 6);
  hf_isolines lines = desc<hf_isolines>();
  seen.call(hf_surface_trace_isolines(o.surface, &field, 6, levels, &lines));
  seen.take(&lines.point_count, 1);
  std::vector<hf_critical_point> points(s.vertex_count);
  hf_critical_info critical = desc<hf_critical_info>();
  seen.call(hf_surface_find_critical_points(o.surface, &field, s.vertex_count, points.data(), &critical));
  seen.take(points.data(), critical.point_count);
  std::vector<double> distance(s.vertex_count);
  const std::uint32_t sources[2] = {3, 900};
  seen.call(hf_geodesics_solve(o.geodesics, 2, sources, OUT(distance.data())));
  seen.take(distance);
  hf_extremities_desc wanted = desc<hf_extremities_desc>();
  wanted.kind = HF_EXTREMITIES_GEODESIC;
  wanted.geodesics = o.geodesics;
  wanted.source_count = 8;
  wanted.out_field = distance.data();
  std::uint32_t count = 0;
  seen.call(hf_surface_find_extremities(o.surface, &wanted, 0, nullptr, &count));
  seen.take(distance);
  seen.take(&count, 1);
  hf_streamlines flow = desc<hf_streamlines>();
  flow.wanted_count = 12;
  seen.call(hf_flow_trace(o.flow, &field, &flow));
  seen.take(&flow.point_count, 1);
}

void read_shapes(const Scene& s, const Objects& o, unsigned, Seen& seen) {
  std::vector<float> field(s.vertex_count);
  seen.call(hf_pose_get_field(o.pose, 1, OUT(field.data())));
  seen.take(field);
  hf_handle_info handle = desc<hf_handle_info>();
  seen.call(hf_pose_get_handle(o.pose, 1, &handle));
  seen.take(&handle, 1);
  hf_skin_info skin = desc<hf_skin_info>();
  seen.call(hf_pose_get_skin(o.pose, &skin));
  std::vector<float> weights(4 * std::size_t{s.vertex_count});
  std::vector<double> rotations(4 * std::size_t{skin.joint_count});
  skin.joint_capacity = skin.joint_count;
  skin.vertex_capacity = skin.vertex_count;
  skin.vertex_weights = weights.data();
  skin.rotations = rotations.data();
  seen.call(hf_pose_get_skin(o.pose, &skin));
  seen.take(weights);
  seen.take(rotations);
  take_region(s, o.region, seen);
  std::vector<double> positions(3 * std::size_t{s.vertex_count});
  hf_morph_desc morph = desc<hf_morph_desc>();
  morph.weight = 1;
  morph.positions = ROWS_OUT(positions.data());
  seen.call(hf_detail_morph(o.detail, &morph));
  seen.take(positions);
  hf_quads_info info = desc<hf_quads_info>();
  seen.call(hf_quads_get_info(o.quads, &info));
  seen.take(&info.face_count, 1);
  std::vector<std::uint32_t> corners(4 * std::size_t{info.face_count});
  hf_quads_mesh mesh = desc<hf_quads_mesh>();
  mesh.face_capacity = info.face_count;
  mesh.faces = corners.data();
  seen.call(hf_quads_get_mesh(o.quads, &mesh));
  seen.take(corners);
}

void read_directions(const Scene& s, const Objects& o, unsigned, Seen& seen) {
  take_direction(s, o.direction, seen);
  std::vector<hf_singularity> found(s.triangle_count);
  std::uint32_t count = 0;
  seen.call(hf_direction_get_singularities(o.direction, s.triangle_count, found.data(), &count));
  seen.take(found.data(), count);
  std::uint32_t sites[4];
  seen.call(hf_direction_get_sites(o.direction, 4, sites, nullptr, nullptr, nullptr));
  seen.take(sites, 4);
  hf_direction_statistics statistics = desc<hf_direction_statistics>();
  seen.call(hf_direction_get_statistics(o.direction, &statistics));
  seen.take(&statistics.unknown_count, 1);
}

// Makes new objects of the shared ones.
void make_more(const Scene& s, const Objects& o, unsigned t, Seen& seen) {
  hf_pose_desc paper = desc<hf_pose_desc>();
  paper.iteration_count = 6;
  hf_pose pose = nullptr;
  std::uint32_t handles[2];
  seen.call(create_pose_with(t % 2 == 0 ? POSE_PAPER : POSE_SMOOTH, o.surface, &paper, &pose));
  seen.call(add_ends(s, pose, handles));
  seen.call(turn(pose, handles[0], 0.2 + 0.1 * t));
  take_pose(s, pose, seen);
  hf_region region = nullptr;
  seen.call(hf_region_create(o.surface, nullptr, &region));
  seen.call(edit_to(region, patch_at(s, 6 + t, 4)));
  take_region(s, region, seen);
  hf_detail detail = nullptr;
  seen.call(hf_detail_create(o.region, region, nullptr, &detail));
  hf_transfer transfer = nullptr;
  seen.call(hf_transfer_create(o.surface, o.surface, nullptr, &transfer));
  seen.call(add_pairs(s, transfer));
  std::vector<double> positions(3 * std::size_t{s.vertex_count});
  hf_transfer_frame frame = desc<hf_transfer_frame>();
  frame.source_positions = HF_ARRAY(s.posed.data(), s.posed.size() / 3);
  frame.target_positions = ROWS_OUT(positions.data());
  seen.call(hf_transfer_apply(transfer, &frame));
  seen.take(positions);
  hf_direction direction = nullptr;
  seen.call(hf_direction_create(o.surface, nullptr, &direction));
  const std::uint32_t vertex = 50 + t;
  seen.call(hf_direction_add_sites(direction, 1, &vertex, s.vectors.data(), nullptr));
  take_direction(s, direction, seen);
  hf_pose_destroy(pose);
  hf_region_destroy(region);
  hf_detail_destroy(detail);
  hf_transfer_destroy(transfer);
  hf_direction_destroy(direction);
}

// ---- edits, of clones ----

// rebases: whether its engine can move sites into the factor.
void edit_solver(const Scene& s, hf_solver solver, bool rebases, unsigned t, Seen& seen) {
  std::vector<std::uint32_t> vertices = {40 + 17 * t, 300 + t, 640 + 3 * t};
  std::uint32_t sites[3];
  const hf_sites_desc more = sites_desc(vertices, s.values.data() + t);
  seen.call(hf_add_sites(solver, &more, sites));
  take_field(s, solver, seen);
  hf_solver before = nullptr;
  seen.call(hf_solver_clone(solver, &before));
  const std::vector<std::uint32_t> elsewhere = {1000 + t};
  const hf_sites_desc to = sites_desc(elsewhere, nullptr);
  seen.call(hf_solver_move_sites(solver, 1, sites, &to));
  seen.call(hf_remove_sites(solver, 1, sites + 1));
  take_field(s, solver, seen);
  std::vector<float> preview(s.vertex_count);
  seen.call(hf_solver_solve_preview(solver, OUT(preview.data()), 0, nullptr));
  seen.take(preview);
  if (t % 4 == 1) seen.call(hf_solver_release_preview(solver));  // for all solvers that share the factor
  hf_solver_info made = desc<hf_solver_info>();
  seen.call(hf_solver_get_info(solver, &made));
  seen.take(&made, 1);
  if (t % 4 == 3 && rebases) {
    seen.call(hf_solver_prepare_rebase(solver));
    take_field(s, solver, seen);
  }
  take_field(s, before, seen);
  hf_solver_destroy(before);
}

void edit_pose(const Scene& s, hf_pose pose, unsigned t, Seen& seen) {
  seen.call(turn(pose, 0, -0.1 * t));
  take_pose(s, pose, seen);
  hf_handles_desc layer = desc<hf_handles_desc>();
  const double radius = 0.5;
  layer.handle_count = 1;
  layer.radii = &radius;
  layer.layer = 1;
  layer.points = s.positions_f64.data() + 3 * (std::size_t{s.vertex_count / 2} + t);
  std::uint32_t handle = 0;
  seen.call(hf_pose_add_handles(pose, &layer, &handle));
  seen.call(turn(pose, handle, 0.3));
  take_pose(s, pose, seen);
  seen.call(hf_pose_remove_handles(pose, 1, &handle));
  take_pose(s, pose, seen);
}

void edit_direction(const Scene& s, hf_direction direction, unsigned t, Seen& seen) {
  const std::uint32_t vertex = 500 + 11 * t, to = 60 + t;
  std::uint32_t site = 0;
  seen.call(hf_direction_add_sites(direction, 1, &vertex, s.vectors.data() + 3 * t, &site));
  hf_direction before = nullptr;
  seen.call(hf_direction_clone(direction, &before));
  seen.call(hf_direction_move_sites(direction, 1, &site, &to));
  take_direction(s, direction, seen);
  const double angle = 0.25;
  seen.call(hf_direction_rotate_sites(before, 1, &site, &angle));
  take_direction(s, before, seen);
  hf_direction_destroy(before);
}

void edit_region(const Scene& s, hf_region region, unsigned t, Seen& seen) {
  hf_region before = nullptr;
  seen.call(hf_region_clone(region, &before));
  hf_region_edit_desc grow = desc<hf_region_edit_desc>();
  grow.ring_count = 1 + static_cast<int>(t % 3);
  seen.call(hf_region_edit(region, &grow));
  take_region(s, region, seen);
  seen.call(edit_to(before, patch_at(s, 20 + t, 8)));
  take_region(s, before, seen);
  hf_region_destroy(before);
}

void clone_and_edit(const Scene& s, const Objects& o, unsigned t, Seen& seen) {
  Objects mine;
  seen.call(hf_solver_clone(o.solver, &mine.solver));
  edit_solver(s, mine.solver, true, t, seen);
  seen.call(hf_pose_create(o.bent, nullptr, &mine.pose));  // the harmonic factor is shared with other threads
  std::uint32_t handles[2];
  seen.call(add_ends(s, mine.pose, handles));
  seen.call(turn(mine.pose, handles[1], 0.1 * t));
  take_pose(s, mine.pose, seen);
  seen.call(hf_region_create(o.bent, nullptr, &mine.region));
  seen.call(edit_to(mine.region, patch_at(s, 9, 3 + t)));
  take_region(s, mine.region, seen);
  seen.call(hf_solver_clone(o.refactor, &mine.refactor));
  edit_solver(s, mine.refactor, false, t, seen);
  destroy(mine);
}

void clone_and_edit_shapes(const Scene& s, const Objects& o, unsigned t, Seen& seen) {
  Objects mine;
  seen.call(hf_pose_clone(o.pose, &mine.pose));
  edit_pose(s, mine.pose, t, seen);
  seen.call(hf_direction_clone(o.direction, &mine.direction));
  edit_direction(s, mine.direction, t, seen);
  seen.call(hf_region_clone(o.region, &mine.region));
  edit_region(s, mine.region, t, seen);
  destroy(mine);
}

}  // namespace

std::uint64_t edit_all(const Scene& s, const Objects& o, unsigned t) {
  Seen seen;
  edit_solver(s, o.solver, true, t, seen);
  edit_solver(s, o.refactor, false, t, seen);
  edit_pose(s, o.pose, t, seen);
  edit_direction(s, o.direction, t, seen);
  edit_region(s, o.region, t, seen);
  return seen.hash();
}

const std::vector<Story> thread_stories = {
    {"THREADS_TRANSFER_READ", read_transfer},
    {"THREADS_SURFACES_READ", read_surfaces},
    {"THREADS_SOLVER_READ", read_solver},
    {"THREADS_ANALYSIS_READ", read_analysis},
    {"THREADS_SHAPES_READ", read_shapes},
    {"THREADS_DIRECTION_READ", read_directions},
    {"THREADS_OBJECTS_OF_ONE", make_more},
    {"THREADS_CLONES_OF_A_SOLVER", clone_and_edit},
    {"THREADS_CLONES_OF_SHAPES", clone_and_edit_shapes},
};

}  // namespace reliability
