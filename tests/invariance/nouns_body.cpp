// The report, links, picking, quads and graphs.
#include <algorithm>
#include <cmath>
#include <map>

#include "setting.h"

namespace invariance {

// What a change adds is counted, and taken off here.
Measured measure_report(const Setting& s) {
  hf_surface_report r = HF_INIT(hf_surface_report);
  ok(hf_surface_get_report(s.surface(), &r));
  hf_links_info links = HF_INIT(hf_links_info);
  ok(hf_surface_get_links_info(s.surface(), &links));
  hf_mesh_statistics m = HF_INIT(hf_mesh_statistics);
  ok(hf_surface_get_mesh_statistics(s.surface(), &m));
  Measured out;
  const std::uint32_t button_vertices = s.copy.added_pieces * 12;
  out.count("isolated", r.isolated_vertex_count - double(s.copy.added_isolated));
  out.count("welded", r.welded_vertex_count - double(s.copy.added_isolated) - button_vertices);
  out.count("components", r.component_count - double(s.copy.added_pieces));
  out.count("pieces", links.piece_count - double(s.copy.added_pieces));
  out.count("doubled", r.duplicate_triangle_count - double(s.copy.doubled_faces));
  out.count("degenerate", r.degenerate_triangle_count);
  out.count("collapsed", r.collapsed_triangle_count);
  out.count("non-manifold", r.non_manifold_edge_count);
  out.count("flipped", r.flipped_edge_count);
  out.count("border", r.boundary_edge_count);
  out.count("changed", m.changed_vertex_count);
  out.count("inside out", r.inside_out_count);
  out.add("smallest angle", {double(m.smallest_angle)});
  out.add("box", {s.back_size(r.bounding_box_diagonal)}, s.body.diagonal);
  std::vector<std::uint32_t> pieces(s.copy.points.size());
  ok(hf_surface_get_pieces(s.surface(), r.vertex_count, pieces.data(), nullptr, nullptr));
  // the numbers of pieces follow the order of vertices; who shares one does not
  std::map<std::uint32_t, std::uint32_t> first;
  std::vector<double> with;
  for (std::uint32_t v = 0; v < s.body.vertex_count(); ++v)
    with.push_back(first.try_emplace(pieces[s.vertex(v)], v).first->second);
  out.add("piece of a vertex", with);
  return out;
}

// Links as the programs make them, and a field that crosses them.
Measured measure_links(const Setting& s) {
  if (s.body.piece_count == 1) throw Refused("the body has one piece");
  hf_links_desc links = HF_INIT(hf_links_desc);
  links.mode = HF_LINK_PIECES;
  hf_surface_desc options = HF_INIT(hf_surface_desc);
  options.links = &links;
  const Surface surface = s.make(options);
  std::uint32_t count = 0;
  ok(hf_surface_get_links(surface, 0, nullptr, &count));
  std::vector<hf_link> found(count);
  ok(hf_surface_get_links(surface, count, found.data(), &count));
  double length = 0, weight = 0;
  for (const hf_link& link : found) {
    length += s.back_size(link.length) / s.body.diagonal;
    weight += double(link.weight);
  }
  Solver solver;
  ok(hf_create(surface, nullptr, solver.out()));
  const double values[] = {0, 1};
  for (std::size_t i = 0; i < 2; ++i) ok(hf_solver_add_site(solver, s.pick(i), values + i, nullptr));
  std::vector<double> field(s.copy.points.size());
  ok(hf_solver_solve_f64(solver, field.data(), 0, nullptr));
  Measured out;
  out.count("links", count);
  out.add("mean length and weight", {length, weight}, std::max(1.0, double(count)));
  out.add("field", s.gather(field));
  return out;
}

Measured measure_picking(const Setting& s) {
  Measured out;
  std::vector<double> hits, nearest;
  const auto count = static_cast<std::uint32_t>(s.body.triangles.size());
  for (std::uint32_t i = 0; i < 12; ++i) {
    const auto& c = s.body.triangles[i * (count / 12)];
    const Vec a = s.body.points[c[0]], b = s.body.points[c[1]], d = s.body.points[c[2]];
    const Vec inside = 0.21 * a + 0.37 * b + 0.42 * d;
    Vec normal = cross(b - a, d - a);
    normal = (s.body.diagonal / length(normal)) * normal;
    const Vec origin = s.place(inside + normal), direction = s.turn(-1.0 * normal);
    hf_hit hit = HF_INIT(hf_hit);
    ok(hf_surface_cast_ray(s.surface(), origin.data(), direction.data(), nullptr, &hit));
    const Vec at = s.back({hit.position[0], hit.position[1], hit.position[2]});
    hits.insert(hits.end(), at.begin(), at.end());
    // half-way to the ray's origin, as a click beside the body
    const Vec beside = s.place(inside + 0.02 * normal);
    std::uint32_t vertex = 0;
    double distance = 0;
    ok(hf_surface_find_vertex(s.surface(), beside.data(), nullptr, &vertex, &distance));
    nearest.insert(nearest.end(), {double(s.origin(vertex)), s.back_size(distance) / s.body.diagonal});
  }
  out.add("hits", hits, s.body.diagonal);
  out.add("nearest vertices", nearest);
  return out;
}

namespace {

constexpr double quad_edge = 0.06;                // of the box: few quads, so that the table is made quickly
constexpr double euler_weight = 10;               // another Euler characteristic is no near miss
constexpr double count_weight = quad_edge / 0.1;  // a tenth of the quads counts as an edge

}  // namespace

// Another order of the same numbers can give another mesh: it must be one of the same surface, to an edge.
Measured measure_quads(const Setting& s) {
  hf_quads_desc d = HF_INIT(hf_quads_desc);
  d.edge_length = s.size(quad_edge * s.body.diagonal);
  Owned<hf_quads, hf_quads_destroy> quads;
  ok(hf_quads_create(s.surface(), &d, quads.out()));
  hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
  ok(hf_quads_get_mesh(quads, &mesh));
  std::vector<double> positions(3 * std::size_t{mesh.vertex_count});
  std::vector<std::uint32_t> corners(positions.size());
  mesh.vertex_capacity = mesh.vertex_count;
  mesh.positions = positions.data();
  mesh.corners = corners.data();
  ok(hf_quads_get_mesh(quads, &mesh));
  std::vector<double> places;
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    if (s.origin(corners[3 * v]) == none) continue;  // of the button
    const Vec p = s.back({positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]});
    for (int k = 0; k < 3; ++k) places.push_back(p[k] / s.body.diagonal);
  }
  hf_quads_info info = HF_INIT(hf_quads_info);
  ok(hf_quads_get_info(quads, &info));
  Measured out;
  out.count("Euler characteristic", euler_weight * (info.euler_characteristic - 2.0 * s.copy.added_pieces));
  out.add("count", {count_weight * std::log(double(places.size() / 3))});
  out.add_set("places", 3, places);
  return out;
}

// The edges of the copy as a graph. Faces that come twice make parallel edges of half the weight each.
Measured measure_graph(const Setting& s) {
  std::map<std::array<std::uint32_t, 2>, double> length_of;
  for (const auto& t : s.copy.triangles) {
    for (int k = 0; k < 3; ++k) {
      std::array<std::uint32_t, 2> ends{t[k], t[(k + 1) % 3]};
      // copies of a vertex are one vertex of a graph
      for (std::uint32_t& v : ends) v = s.copy.origin[v] == none ? v : s.vertex(s.copy.origin[v]);
      if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
      length_of[ends] = s.back_size(length(s.copy.points[ends[0]] - s.copy.points[ends[1]]));
    }
  }
  std::vector<std::uint32_t> edges;
  std::vector<double> weights;
  for (const auto& [ends, size] : length_of) {
    edges.insert(edges.end(), ends.begin(), ends.end());
    weights.push_back(s.body.diagonal / size);
  }
  hf_graph_desc d = HF_INIT(hf_graph_desc);
  d.vertex_count = static_cast<std::uint32_t>(s.copy.points.size());
  d.edge_count = static_cast<std::uint32_t>(weights.size());
  d.edges = edges.data();
  d.weights = weights.data();
  Surface surface;
  ok(hf_surface_create_graph(&d, surface.out()));
  Solver solver;
  ok(hf_create(surface, nullptr, solver.out()));
  const double values[] = {0, 1, 0.4};
  for (std::size_t i = 0; i < 3; ++i) ok(hf_solver_add_site(solver, s.pick(i), values + i, nullptr));
  std::vector<double> field(s.copy.points.size());
  ok(hf_solver_solve_f64(solver, field.data(), 0, nullptr));
  Measured out;
  out.add("field", s.gather(field));
  return out;
}

}  // namespace invariance
