// Methods for distances, levels and iso-lines, critical points, tips, direction fields, quad meshes and streamlines.
#include <algorithm>

#include "arguments.h"

namespace hf_godot {
namespace {

// points and starts of polylines as lists of vectors
Value lines_of(const Doubles& positions, const Numbers& starts) {
  Value value;
  value.kind = Value::lines;
  for (size_t i = 0; i + 1 < starts.size(); ++i) {
    value.polylines.emplace_back(positions.begin() + 3 * std::ptrdiff_t{starts[i]},
                                 positions.begin() + 3 * std::ptrdiff_t{starts[i + 1]});
  }
  return value;
}

hf_geodesics geodesics_of(Surface& s, const Argument& argument) {
  auto desc = make<hf_geodesics_desc>();
  desc.method = signed_whole(argument.number, "method");
  const auto create = [&](hf_geodesics* out) { return hf_geodesics_create(s.get(), &desc, out); };
  if (desc.method < 0 || desc.method > HF_GEODESICS_HEAT) {
    hf::Handle<hf_geodesics, hf_geodesics_destroy> none;
    make_once(none, create);  // the library refuses it and says why
  }
  return make_once(s.geodesics[static_cast<size_t>(desc.method)], create);
}

// distance(sources, method = 0): along the surface, -1 where none can be reached
Value distance(Surface& s, const Arguments& a) {
  const List sources = integers(at(a, 0), "sources");
  hf_geodesics geodesics = geodesics_of(s, at(a, 1));
  Value value;
  value.kind = Value::reals;
  value.floats.resize(s.vertex_count + 1);
  const hf_array_out out = HF_ARRAY_OUT(value.floats.data(), s.vertex_count);
  check(hf_geodesics_solve(geodesics, sources.count(), sources.data(), &out));
  value.floats.resize(s.vertex_count);
  return value;
}

// A place is [vertex], or [three corners of a triangle, their three weights].
hf_place place_of(const Argument& argument, const char* name) {
  const Doubles& list = argument.list;
  if (list.size() != 1 && list.size() != 6)
    fail(std::string(name) + " must be [vertex], or three corners and three weights");
  hf_place point = {};
  for (size_t k = 0; k < 3; ++k) {
    point.corners[k] = whole(list[list.size() == 1 ? 0 : k], name);
    point.barycentrics[k] = list.size() == 6 ? list[3 + k] : k == 0 ? 1.0 : 0.0;
  }
  return point;
}

// find_path(from, to, method = 0): points of the shortest path between two places
Value find_path(Surface& s, const Arguments& a) {
  const hf_place from = place_of(at(a, 0), "from"), to = place_of(at(a, 1), "to");
  hf_geodesics geodesics = geodesics_of(s, at(a, 2));
  auto path = make<hf_path>();
  check(hf_geodesics_find_path(geodesics, &from, &to, &path));
  Doubles positions(3 * size_t{path.point_count} + 1);
  path.point_capacity = path.point_count;
  path.positions = positions.data();
  check(hf_geodesics_find_path(geodesics, &from, &to, &path));
  return lines_of(positions, {0, path.point_count});
}

// map_around(centre, radius = 0, method = 0): the surface laid out in a plane, two coordinates per vertex
Value map_around(Surface& s, const Arguments& a) {
  const hf_place centre = place_of(at(a, 0), "centre");
  hf_geodesics geodesics = geodesics_of(s, at(a, 2));
  Doubles map(2 * size_t{s.vertex_count} + 1);
  check(hf_geodesics_get_map(geodesics, &centre, at(a, 1).number, map.data(), nullptr));
  Value value;
  value.kind = Value::reals;
  value.floats.assign(map.begin(), map.end() - 1);
  return value;
}

// space_levels(field, count, spacing = 0)
Value space_levels(Surface& s, const Arguments& a) {
  const hf_array field = rows_of(at(a, 0), 1, s.vertex_count, "field");
  const uint32_t count = whole(at(a, 1).number, "count");
  Doubles levels(std::min(count, 1000000u) + 1);
  check(hf_surface_space_levels(s.get(), &field, signed_whole(at(a, 2).number, "spacing"), count, levels.data()));
  Value value;
  value.kind = Value::reals;
  value.floats.assign(levels.begin(), levels.end() - 1);
  return value;
}

// trace_isolines(field, levels): a list of points for every line
Value trace_isolines(Surface& s, const Arguments& a) {
  const hf_array field = rows_of(at(a, 0), 1, s.vertex_count, "field");
  const Doubles& levels = at(a, 1).list;
  const uint32_t count = at(a, 1).null ? 1u : static_cast<uint32_t>(levels.size());
  const double* given = levels.empty() ? nullptr : levels.data();
  auto lines = make<hf_isolines>();
  check(hf_surface_trace_isolines(s.get(), &field, count, given, &lines));
  Doubles positions(3 * size_t{lines.point_count});
  Numbers starts(size_t{lines.line_count} + 1);
  lines.point_capacity = lines.point_count;
  lines.line_capacity = lines.line_count;
  lines.positions = positions.data();
  lines.line_starts = starts.data();
  if (lines.line_count) check(hf_surface_trace_isolines(s.get(), &field, count, given, &lines));
  return lines_of(positions, starts);
}

// find_critical_points(field): { vertex, kind, index, value } each
Value find_critical_points(Surface& s, const Arguments& a) {
  const hf_array field = rows_of(at(a, 0), 1, s.vertex_count, "field");
  auto info = make<hf_critical_info>();
  check(hf_surface_find_critical_points(s.get(), &field, 0, nullptr, &info));
  std::vector<hf_critical_point> points(info.point_count);
  if (!points.empty()) check(hf_surface_find_critical_points(s.get(), &field, info.point_count, points.data(), &info));
  Value value;
  value.kind = Value::rows;
  for (const hf_critical_point& p : points)
    value.table.push_back({{"vertex", p.vertex}, {"kind", p.kind}, {"index", p.index}, {"value", p.value}});
  return value;
}

// Asks for a count, then for the items: call(capacity, out, count). row(item) returns one row of the table.
template <class Item, class Call, class Row>
Value table_of(Call&& call, Row&& row) {
  uint32_t count = 0;
  check(call(0, nullptr, &count));
  std::vector<Item> found(count);
  if (count) check(call(count, found.data(), &count));
  Value value;
  value.kind = Value::rows;
  for (const Item& item : found) value.table.push_back(row(item));
  return value;
}

using TableRow = decltype(Value::table)::value_type;

// find_extremities(): { vertex, length } each, the longest first
Value find_extremities(Surface& s, const Arguments&) {
  return table_of<hf_extremity>(
      [&](uint32_t capacity, hf_extremity* out, uint32_t* count) {
        return hf_surface_find_extremities(s.get(), nullptr, capacity, out, count);
      },
      [](const hf_extremity& tip) {
        return TableRow{{"vertex", tip.vertex}, {"length", tip.length}};
      });
}

// propose_handles(names = null, parents, rest, positions, triangles, joints, weights): rows of vertex, reason, pinned,
// radius, following, joint (-1: none), role, side, and x, y, z of the place; pinned ones first. The arguments are those
// of a skeleton, as for retarget_create, and of the skin: as many joints and weights for each vertex of the mesh.
Value propose_handles(Surface& s, const Arguments& a) {
  auto desc = make<hf_handle_proposals_desc>();
  hf::Handle<hf_skeleton, hf_skeleton_destroy> skeleton;
  Numbers regions(s.vertex_count, HF_NO_INDEX);
  if (at(a, 1).list.size() > 0) {
    const std::vector<float> positions(at(a, 3).list.begin(), at(a, 3).list.end()),
        weights(at(a, 6).list.begin(), at(a, 6).list.end());
    const List triangles = integers(at(a, 4), "triangles"), joints = integers(at(a, 5), "joints");
    auto skin = make<hf_skin_desc>();
    skin.vertex_count = static_cast<uint32_t>(positions.size() / 3);
    skin.triangle_count = static_cast<uint32_t>(triangles.values.size() / 3);
    skin.influence_count = static_cast<uint32_t>(weights.size() / std::max<size_t>(skin.vertex_count, 1));
    if (joints.values.size() != weights.size() || weights.size() != size_t{skin.influence_count} * skin.vertex_count)
      fail("joints and weights must have as many numbers for each vertex");
    skin.positions = positions.data();
    skin.triangles = triangles.data();
    skin.joints = joints.data();
    skin.weights = weights.data();
    skeleton = skeleton_of(at(a, 0), at(a, 1), at(a, 2), weights.empty() ? nullptr : &skin);
    desc.skeleton = skeleton.get();
  }
  desc.out_regions = regions.data();
  Value value = table_of<hf_handle_proposal>(
      [&](uint32_t capacity, hf_handle_proposal* out, uint32_t* count) {
        return hf_surface_propose_handles(s.get(), &desc, capacity, out, count);
      },
      [](const hf_handle_proposal& p) {
        return TableRow{
            {"vertex", p.vertex}, {"reason", p.reason},       {"pinned", p.pinned},
            {"radius", p.radius}, {"following", p.following}, {"joint", p.joint == HF_NO_INDEX ? -1.0 : p.joint},
            {"role", p.role},     {"side", p.side},           {"x", p.position[0]},
            {"y", p.position[1]}, {"z", p.position[2]}};
      });
  s.proposed.assign(value.table.size(), {});
  for (size_t v = 0; v < regions.size(); ++v)
    if (regions[v] != HF_NO_INDEX) s.proposed[regions[v]].push_back(static_cast<uint32_t>(v));
  return value;
}

// proposed_regions(): the vertices of each row of the last propose_handles, whole heads, hands and feet for one
Value proposed_regions(Surface& s, const Arguments&) {
  Value value;
  value.kind = Value::lists;
  value.sets = s.proposed;
  return value;
}

// ---- the direction field of a surface: direction_create(degree = 1) replaces it

Value direction_create(Surface& s, const Arguments& a) {
  auto desc = make<hf_direction_desc>();
  desc.degree = whole(at(a, 0).number, "degree");
  make_again(s.direction, [&](hf_direction* out) { return hf_direction_create(s.get(), &desc, out); });
  return done();
}

// direction_add_sites(vertices, vectors)
Value direction_add_sites(Surface& s, const Arguments& a) {
  const List vertices = integers(at(a, 0), "vertices");
  const double* given = doubles(at(a, 1), 3 * size_t{vertices.count()}, "vectors");
  Numbers made(vertices.count() + 1);
  check(hf_direction_add_sites(s.direction.get(), vertices.count(), vertices.data(), given, made.data()));
  made.resize(vertices.count());
  return numbers(made);
}

Value direction_record(Surface& s, const Arguments&) {
  return s.direction_history.record(hf::clone_of(s.direction, hf_direction_clone)), done();
}
Value direction_undo(Surface& s, const Arguments&) { return s.direction_history.undo(s.direction), done(); }
Value direction_redo(Surface& s, const Arguments&) { return s.direction_history.redo(s.direction), done(); }

// the vectors of the constraints
Value direction_vectors(Surface& s, const Arguments&) {
  const uint32_t count = hf_direction_get_site_count(s.direction.get());
  Doubles found(3 * size_t{count});
  check(hf_direction_get_sites(s.direction.get(), count, nullptr, nullptr, found.data(), nullptr));
  return vectors(found);
}

Value direction_solve(Surface& s, const Arguments&) {
  Value value;
  value.kind = Value::vectors;
  value.floats.resize(3 * s.vertex_count + 1);
  const hf_array_out out = HF_ARRAY_OUT(value.floats.data(), s.vertex_count);
  check(hf_direction_solve(s.direction.get(), &out, nullptr));
  value.floats.resize(3 * s.vertex_count);
  return value;
}

// { triangle, vertex, index } each
Value direction_singularities(Surface& s, const Arguments&) {
  uint32_t count = 0;
  check(hf_direction_get_singularities(s.direction.get(), 0, nullptr, &count));
  std::vector<hf_singularity> found(count);
  if (count) check(hf_direction_get_singularities(s.direction.get(), count, found.data(), &count));
  Value value;
  value.kind = Value::rows;
  for (const hf_singularity& one : found)
    value.table.push_back({{"triangle", one.triangle}, {"vertex", one.vertex}, {"index", one.index}});
  return value;
}

// ---- quads_create(options = {}, crease edges = null, guide vertices = null, guide vectors = null, guide weights =
// null, symmetry plane = null, pole points = null, pole quads = null, pole directions = null): face_count, edge_length,
// crease_angle, relax_count

template <class Make>
Value with_quads_desc(const Arguments& a, Make&& make_quads) {
  auto desc = make<hf_quads_desc>();
  read_options(at(a, 0), {{"face_count", &desc.face_count},
                          {"edge_length", &desc.edge_length},
                          {"crease_angle", &desc.crease_angle},
                          {"relax_count", &desc.relax_count}});
  const List edges = integers(at(a, 1), "crease edges"), guided = integers(at(a, 2), "guide vertices");
  if (edges.values.size() % 2) fail("crease edges must hold two vertices each");
  desc.crease_count = static_cast<uint32_t>(edges.values.size() / 2);
  desc.crease_edges = edges.data();
  const size_t guides = guided.values.size();
  desc.guide_count = static_cast<uint32_t>(guides);
  desc.guide_vertices = guided.data();
  desc.guide_vectors = doubles(at(a, 3), 3 * guides, "guide vectors");
  const double* given = doubles(at(a, 4), guides, "guide weights");
  const std::vector<float> weights(given, given + (given ? guides : 0));
  if (given) desc.guide_weights = weights.data();
  const List counts = integers(at(a, 7), "pole quads");
  const size_t poles = counts.values.size();
  desc.irregular_count = static_cast<uint32_t>(poles);
  desc.irregular_valences = counts.data();
  desc.irregular_points = doubles(at(a, 6), 3 * poles, "pole points");
  desc.irregular_directions = doubles(at(a, 8), 3 * poles, "pole directions");
  const double* plane = doubles(at(a, 5), 4, "symmetry plane");
  if (plane) std::copy(plane, plane + 4, desc.symmetry_plane);
  make_quads(desc);
  return done();
}

Value quads_create(Surface& s, const Arguments& a) {
  return with_quads_desc(a, [&](const hf_quads_desc& desc) {
    make_again(s.quads, [&](hf_quads* out) { return hf_quads_create(s.get(), &desc, out); });
  });
}

// quads_update(what quads_create takes): makes the quads of quads_create again, and keeps what strokes do not change
Value quads_update(Surface& s, const Arguments& a) {
  return with_quads_desc(a, [&](const hf_quads_desc& desc) { check(hf_quads_update(s.quads.get(), &desc)); });
}

hf_quads_info quads_info_of(const Surface& s) {
  auto info = make<hf_quads_info>();
  check(hf_quads_get_info(s.quads.get(), &info));
  return info;
}

Value quads_positions(Surface& s, const Arguments&) {
  auto mesh = make<hf_quads_mesh>();
  mesh.vertex_capacity = quads_info_of(s).vertex_count;
  Doubles positions(3 * size_t{mesh.vertex_capacity});
  mesh.positions = positions.data();
  check(hf_quads_get_mesh(s.quads.get(), &mesh));
  return vectors(positions);
}

// the four vertices of every face, counter-clockwise
Value quads_faces(Surface& s, const Arguments&) {
  const hf_quads_info info = quads_info_of(s);
  auto mesh = make<hf_quads_mesh>();
  Numbers corners(4 * size_t{info.face_count});
  mesh.face_capacity = info.face_count;
  mesh.faces = corners.data();
  check(hf_quads_get_mesh(s.quads.get(), &mesh));
  Value value;
  value.kind = Value::lists;
  for (auto face = corners.begin(); face != corners.end(); face += 4) value.sets.emplace_back(face, face + 4);
  return value;
}

// streamlines(field, count, seeds = null): lines of equal flux from the minima, or one through every seed
Value streamlines(Surface& s, const Arguments& a) {
  const hf_array field = rows_of(at(a, 0), 1, s.vertex_count, "field");
  const List seeds = integers(at(a, 2), "seeds");
  hf_flow flow = make_once(s.flow, [&](hf_flow* out) { return hf_flow_create(s.get(), out); });
  auto lines = make<hf_streamlines>();
  lines.wanted_count = at(a, 1).null ? 0u : whole(at(a, 1).number, "count");
  lines.seed_count = seeds.null ? 0u : seeds.count();
  lines.seeds = seeds.data();
  check(hf_flow_trace(flow, &field, &lines));
  Doubles positions(3 * size_t{lines.point_count});
  Numbers starts(size_t{lines.line_count} + 1);
  lines.point_capacity = lines.point_count;
  lines.line_capacity = lines.line_count;
  lines.positions = positions.data();
  lines.line_starts = starts.data();
  check(hf_flow_trace(flow, &field, &lines));
  return lines_of(positions, starts);
}

}  // namespace

const std::vector<Entry>& field_methods() {
  static const std::vector<Entry> all = {
      {"distance", 1, 2, distance},
      {"find_path", 2, 3, find_path},
      {"map_around", 1, 3, map_around},
      {"space_levels", 2, 3, space_levels},
      {"trace_isolines", 2, 2, trace_isolines},
      {"find_critical_points", 1, 1, find_critical_points},
      {"find_extremities", 0, 0, find_extremities},
      {"propose_handles", 0, 7, propose_handles},
      {"proposed_regions", 0, 0, proposed_regions},
      {"direction_create", 0, 1, direction_create},
      {"direction_add_sites", 2, 2, direction_add_sites},
      {"direction_record", 0, 0, direction_record},
      {"direction_undo", 0, 0, direction_undo},
      {"direction_redo", 0, 0, direction_redo},
      {"direction_vectors", 0, 0, direction_vectors},
      {"direction_solve", 0, 0, direction_solve},
      {"direction_singularities", 0, 0, direction_singularities},
      {"quads_create", 0, 9, quads_create},
      {"quads_update", 0, 9, quads_update},
      {"quads_positions", 0, 0, quads_positions},
      {"quads_faces", 0, 0, quads_faces},
      {"streamlines", 2, 3, streamlines},
  };
  return all;
}

}  // namespace hf_godot
