// Methods of edits: stiffness, links, patches of triangles and cuts (hf/surface.h "edits"). An edit happens in place:
// the solver, its recorded states and the pose move along. Surfaces that share the mesh stay on the one before the
// edit.
#include "arguments.h"

namespace hf_godot {
namespace {

using Mesh = std::shared_ptr<hf::Handle<hf_surface, hf_surface_destroy>>;

// A pose without handles has nothing to move: it is made again with its options.
hf::Handle<hf_pose, hf_pose_destroy> pose_again(hf_pose pose, hf_surface surface) {
  auto info = make<hf_pose_info>();
  check(hf_pose_get_info(pose, &info));
  auto desc = make<hf_pose_desc>();
  desc.band_count = info.band_count;
  desc.iteration_count = info.iteration_count;
  desc.group_count = info.group_count;
  hf_pose raw = nullptr;
  check(hf_pose_create(surface, &desc, &raw));
  return hf::Handle<hf_pose, hf_pose_destroy>(raw);
}

// Takes a surface to another that an edit made from its own, or the other way round, with what moves along. What an
// edit of links or triangles changes and what cannot move is made anew on demand, or forgotten.
void move(Surface& s, const Mesh& mesh, bool lengths_stay) {
  auto info = make<hf_surface_info>();
  check(hf_surface_get_info(mesh->get(), &info));
  auto before = make<hf_surface_info>();
  check(hf_surface_get_info(s.get(), &before));
  const bool same_triangles = info.vertex_count == before.vertex_count && info.triangle_count == before.triangle_count;
  // a copy of the solver goes first, so that a refused pose changes nothing
  hf::Handle<hf_solver, hf_solver_destroy> solver;
  if (s.solver) {
    solver = hf::clone_of(s.solver, hf_solver_clone);
    check(hf_solver_move_to(solver.get(), mesh->get()));
  }
  if (s.pose) {
    auto pose = make<hf_pose_info>();
    check(hf_pose_get_info(s.pose.get(), &pose));
    const hf_result moved = hf_pose_move_to(s.pose.get(), mesh->get());
    if (moved == HF_ERROR_UNSUPPORTED && pose.handle_count == 0)
      s.pose = pose_again(s.pose.get(), mesh->get());
    else
      check(moved);
  }
  if (s.solver) s.solver = std::move(solver);
  s.mesh = mesh;
  s.vertex_count = info.vertex_count;
  s.moved = true;
  s.normals.clear();
  if (lengths_stay) return;
  s.geodesics = {};
  s.flow = {};
  if (same_triangles) return;
  s.transfer = {};
  s.direction = {};
  s.direction_history = {};
  s.quads = {};
  s.region = {};
  s.region_history = {};
  s.detail = {};
}

void edit_in_place(Surface& s, const hf_surface_edit_desc& desc) {
  hf_surface raw = nullptr;
  check(hf_surface_edit(s.get(), &desc, &raw));
  move(s, std::make_shared<hf::Handle<hf_surface, hf_surface_destroy>>(raw),
       desc.link_count == 0 && desc.removed_link_count == 0 && !desc.patch);
}

// Eight numbers for each link: a vertex, three corners of a triangle (-1: none), their three weights, and its own.
std::vector<hf_link> links_of(const Argument& argument) {
  const Doubles& list = argument.list;
  if (list.size() % 8 != 0) fail("links must hold eight numbers each: a vertex, three corners, their weights, its own");
  std::vector<hf_link> links(list.size() / 8);
  for (size_t i = 0; i < links.size(); ++i) {
    const double* const row = &list[8 * i];
    links[i].vertex = whole(row[0], "links");
    for (size_t k = 0; k < 3; ++k) {
      links[i].corners[k] = row[1 + k] == -1 ? HF_NO_INDEX : whole(row[1 + k], "links");
      links[i].barycentrics[k] = row[4 + k];
    }
    links[i].weight = row[7];
  }
  return links;
}

// edit(vertices, stiffness, links, removed links): each may be null, or missing at the end
Value edit(Surface& s, const Arguments& a) {
  const List vertices = integers(at(a, 0), "vertices"), removed = integers(at(a, 3), "removed links");
  const std::vector<hf_link> links = links_of(at(a, 2));
  auto desc = make<hf_surface_edit_desc>();
  if (!at(a, 1).null) {
    desc.vertex_count = static_cast<uint32_t>(vertices.null ? a[1].list.size() : vertices.values.size());
    desc.stiffness = doubles(a[1], desc.vertex_count, "stiffness");
  } else {
    desc.vertex_count = static_cast<uint32_t>(vertices.values.size());
  }
  desc.vertices = vertices.data();
  desc.link_count = static_cast<uint32_t>(links.size());
  desc.links = links.data();
  desc.removed_link_count = static_cast<uint32_t>(removed.values.size());
  desc.removed_links = removed.data();
  edit_in_place(s, desc);
  return done();
}

void edit_patch_in_place(Surface& s, const hf_patch_desc& patch) {
  auto desc = make<hf_surface_edit_desc>();
  desc.patch = &patch;
  edit_in_place(s, desc);
}

// edit_patch(removed triangles = null, new positions = null, new triangles = null): numbers stay, new ones follow
Value edit_patch(Surface& s, const Arguments& a) {
  const List removed = integers(at(a, 0), "removed triangles"), triangles = integers(at(a, 2), "new triangles");
  const Doubles& positions = at(a, 1).list;
  if (positions.size() % 3) fail("new positions hold three numbers each");
  if (triangles.values.size() % 3) fail("new triangles hold three numbers each");
  auto patch = make<hf_patch_desc>();
  patch.removed_triangle_count = static_cast<uint32_t>(removed.values.size());
  patch.removed_triangles = removed.data();
  patch.new_vertex_count = static_cast<uint32_t>(positions.size() / 3);
  patch.new_positions = positions.data();
  patch.new_triangle_count = static_cast<uint32_t>(triangles.values.size() / 3);
  patch.new_triangles = triangles.data();
  edit_patch_in_place(s, patch);
  return done();
}

std::vector<hf_cut_corner> cuts_of(const Surface& s) {
  uint32_t count = 0;
  check(hf_surface_get_cuts(s.get(), 0, nullptr, &count));
  std::vector<hf_cut_corner> found(count);
  if (count) check(hf_surface_get_cuts(s.get(), count, found.data(), &count));
  return found;
}
Value rows_of_cuts(const std::vector<hf_cut_corner>& corners, size_t first) {
  Value value;
  value.kind = Value::rows;
  for (size_t i = first; i < corners.size(); ++i) {
    const hf_cut_corner& c = corners[i];
    value.table.push_back({{"triangle", c.triangle}, {"corner", c.corner}, {"vertex", c.vertex}, {"copied", c.copied}});
  }
  return value;
}

// edit_cut(edges): two vertices each. Returns a row { triangle, corner, vertex, copied } for every corner that has
// another vertex now
Value edit_cut(Surface& s, const Arguments& a) {
  const List edges = integers(at(a, 0), "edges");
  if (edges.values.size() % 2) fail("edges must hold two vertices each");
  auto patch = make<hf_patch_desc>();
  patch.cut_edge_count = static_cast<uint32_t>(edges.values.size() / 2);
  patch.cut_edges = edges.data();
  const size_t before = cuts_of(s).size();
  edit_patch_in_place(s, patch);
  return rows_of_cuts(cuts_of(s), before);
}

// edit_line(places): six numbers each, three corners of a triangle and their weights. Returns a row for every new
// triangle: the triangle that it is a part of, its vertices a, b and c, and by a0 to c2 where these lie in it
Value edit_line(Surface& s, const Arguments& a) {
  const std::vector<hf_place> places = places_of(at(a, 0));
  auto desc = make<hf_cut_desc>();
  desc.point_count = static_cast<uint32_t>(places.size());
  desc.places = places.data();
  auto cut = make<hf_cut>();
  check(hf_surface_trace_cut(s.get(), &desc, &cut));
  Numbers removed(cut.removed_triangle_count), triangles(3 * cut.new_triangle_count), sources(cut.new_triangle_count);
  Doubles positions(3 * cut.new_vertex_count), weights(9 * cut.new_triangle_count);
  cut.removed_triangle_capacity = cut.removed_triangle_count;
  cut.new_vertex_capacity = cut.new_vertex_count;
  cut.new_triangle_capacity = cut.new_triangle_count;
  cut.removed_triangles = removed.data();
  cut.new_positions = positions.data();
  cut.new_triangles = triangles.data();
  cut.source_triangles = sources.data();
  cut.corner_barycentrics = weights.data();
  check(hf_surface_trace_cut(s.get(), &desc, &cut));
  auto patch = make<hf_patch_desc>();
  patch.removed_triangle_count = cut.removed_triangle_count;
  patch.removed_triangles = removed.data();
  patch.new_vertex_count = cut.new_vertex_count;
  patch.new_positions = positions.data();
  patch.new_triangle_count = cut.new_triangle_count;
  patch.new_triangles = triangles.data();
  edit_patch_in_place(s, patch);
  Value value;
  value.kind = Value::rows;
  for (size_t t = 0; t < sources.size(); ++t) {
    std::map<std::string, double> row = {{"triangle", sources[t]}};
    for (size_t k = 0; k < 3; ++k) {
      const std::string corner(1, static_cast<char>('a' + k));
      row[corner] = triangles[3 * t + k];
      for (size_t w = 0; w < 3; ++w) row[corner + std::to_string(w)] = weights[9 * t + 3 * k + w];
    }
    value.table.push_back(std::move(row));
  }
  return value;
}

// cuts(): rows as of edit_cut, of all cuts since the surface was made
Value cuts(Surface& s, const Arguments&) { return rows_of_cuts(cuts_of(s), 0); }

// move_to(surface): goes over to a surface that edits made from this one's, or this one's from it
Value move_to(Surface& s, const Arguments& a) {
  if (!at(a, 0).surface) fail("move_to needs a surface");
  const Surface& other = *a[0].surface;
  if (!s.get() || !other.get()) fail("the surface was disposed or not created", HF_ERROR_INVALID_OBJECT);
  if (!s.solver && !s.pose) {
    // a solver of the surface's own factor costs nothing, and says whether the two have a common origin
    auto info = make<hf_surface_info>();
    check(hf_surface_get_info(s.get(), &info));
    auto desc = make<hf_solver_desc>();
    desc.field_kind = info.field_kind;
    hf_solver raw = nullptr;
    check(hf_create(s.get(), &desc, &raw));
    const hf::Handle<hf_solver, hf_solver_destroy> trial(raw);
    check(hf_solver_move_to(raw, other.get()));
  }
  move(s, other.mesh, false);
  return done();
}

// stiffness(): a number for every vertex; 1 as the surface was made
Value stiffness(Surface& s, const Arguments&) {
  Doubles found(s.vertex_count + 1);
  check(hf_surface_get_stiffness(s.get(), static_cast<uint32_t>(s.vertex_count), found.data(), nullptr));
  Value value;
  value.kind = Value::reals;
  value.floats.assign(found.begin(), found.end() - 1);
  return value;
}

double index_of(uint32_t vertex) { return vertex == HF_NO_INDEX ? -1.0 : vertex; }

// links(): a row for every link. Its place in the list is its number for edit().
Value links(Surface& s, const Arguments&) {
  uint32_t count = 0;
  check(hf_surface_get_links(s.get(), 0, nullptr, &count));
  std::vector<hf_link> found(count);
  if (count) check(hf_surface_get_links(s.get(), count, found.data(), &count));
  Value value;
  value.kind = Value::rows;
  for (const hf_link& link : found) {
    value.table.push_back({{"vertex", link.vertex},
                           {"corner_0", index_of(link.corners[0])},
                           {"corner_1", index_of(link.corners[1])},
                           {"corner_2", index_of(link.corners[2])},
                           {"weight_0", link.barycentrics[0]},
                           {"weight_1", link.barycentrics[1]},
                           {"weight_2", link.barycentrics[2]},
                           {"length", link.length},
                           {"weight", link.weight},
                           {"in_tree", link.in_tree}});
  }
  return value;
}

// pieces(): of every vertex, linked or not; -1 for isolated ones
Value pieces(Surface& s, const Arguments&) {
  Numbers found(s.vertex_count);
  check(hf_surface_get_pieces(s.get(), static_cast<uint32_t>(found.size()), found.data(), nullptr, nullptr));
  return numbers(std::move(found));
}

}  // namespace

const std::vector<Entry>& edit_methods() {
  static const std::vector<Entry> all = {
      {"edit", 2, 4, edit},           {"edit_patch", 1, 3, edit_patch}, {"edit_cut", 1, 1, edit_cut},
      {"edit_line", 1, 1, edit_line}, {"move_to", 1, 1, move_to},       {"cuts", 0, 0, cuts},
      {"stiffness", 0, 0, stiffness}, {"links", 0, 0, links},           {"pieces", 0, 0, pieces}};
  return all;
}

}  // namespace hf_godot
