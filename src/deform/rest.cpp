#include "deform/rest.h"

#include <algorithm>

namespace hf_inner::deform {
namespace {

void sort_components(const mesh::Mesh& mesh, RestShape& rest) {
  const std::int32_t n = mesh.vertex_count(), components = mesh.component_count();
  rest.component_start.assign(components + 1, 0);
  rest.component_vertex.resize(n);
  for (std::int32_t v = 0; v < n; ++v) ++rest.component_start[mesh.component[v] + 1];
  for (std::int32_t c = 0; c < components; ++c) rest.component_start[c + 1] += rest.component_start[c];
  Vector<std::int32_t> next(rest.component_start, rest.component_start.get_allocator());
  for (std::int32_t v = 0; v < n; ++v) rest.component_vertex[next[mesh.component[v]]++] = v;
  rest.component_area.assign(components, 0.0);
  for (std::int32_t v = 0; v < n; ++v) rest.component_area[mesh.component[v]] += rest.area[v];
  rest.component_triangles.assign(components, 0);
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t)
    ++rest.component_triangles[mesh.component[mesh.triangle(t)[0]]];
}

void list_triangles_by_piece(const mesh::Mesh& mesh, RestShape& rest) {
  const std::int32_t pieces = (mesh.vertex_count() + vertex_piece - 1) / vertex_piece;
  const auto for_entries = [&](bool border, auto&& use) {
    for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
      const std::int32_t* k = mesh.triangle(t);
      const std::int32_t a = k[0] / vertex_piece, b = k[1] / vertex_piece, c = k[2] / vertex_piece;
      if ((b != a || c != a) != border) continue;
      use(a, k);
      if (b != a) use(b, k);
      if (c != a && c != b) use(c, k);
    }
  };
  rest.piece_start.assign(pieces + 1, 0);
  for (const bool border : {false, true})
    for_entries(border, [&](std::int32_t piece, const std::int32_t*) { ++rest.piece_start[piece + 1]; });
  for (std::int32_t p = 0; p < pieces; ++p) rest.piece_start[p + 1] += rest.piece_start[p];
  rest.piece_corner.resize(3 * static_cast<std::size_t>(rest.piece_start[pieces]));
  Vector<std::int32_t> next(rest.piece_start, rest.piece_start.get_allocator());
  for (const bool border : {false, true}) {
    for_entries(border, [&](std::int32_t piece, const std::int32_t* corner) {
      std::copy_n(corner, 3, rest.piece_corner.data() + 3 * static_cast<std::size_t>(next[piece]++));
    });
    if (!border) rest.piece_border.assign(next.begin(), next.end() - 1);
  }
}

void list_faces(const mesh::Mesh& mesh, RestShape& rest) {
  if (mesh.faces.empty()) return;
  const std::size_t n = mesh.positions.size();
  rest.face_start.assign(n + 1, 0);
  for (const std::int32_t v : mesh.faces.corner) ++rest.face_start[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < n; ++v) rest.face_start[v + 1] += rest.face_start[v];
  rest.face.resize(mesh.faces.corner.size());
  Vector<std::int32_t> next(rest.face_start, rest.face_start.get_allocator());
  for (std::int32_t f = 0; f < mesh.faces.count(); ++f) {
    for (const std::int32_t v : mesh.faces.corners_of(f)) rest.face[next[v]++] = f;
  }
}

void sample_triangles(const mesh::Mesh& mesh, RestShape& rest) {
  std::uint32_t share = 0;
  const std::int64_t count = mesh.triangle_count();
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
    for (; share * count / histogram_shares <= t; ++share)
      rest.sampled_start[share] = static_cast<std::int32_t>(rest.sampled.size());
    const std::int32_t* corner = mesh.triangle(t);
    if (scattered(static_cast<std::uint32_t>(t)) * rest.component_triangles[mesh.component[corner[0]]] >
        triangle_samples)
      continue;
    const Vec3 &p0 = mesh.positions[corner[0]], &p1 = mesh.positions[corner[1]], &p2 = mesh.positions[corner[2]];
    const double twice_area = norm(cross(p1 - p0, p2 - p0));
    if (!(twice_area > least_twice_area)) continue;
    rest.sampled.push_back({{corner[0], corner[1], corner[2]}, {p2 - p1, p0 - p2, p1 - p0}, twice_area});
  }
  for (; share <= histogram_shares; ++share) rest.sampled_start[share] = static_cast<std::int32_t>(rest.sampled.size());
}

}  // namespace

RestShape::RestShape(const surface::Core& core, Memory& memory)
    : component_start(&memory),
      component_vertex(&memory),
      component_triangles(&memory),
      component_area(&memory),
      area(core.areas.begin(), core.areas.end(), &memory),
      piece_start(&memory),
      piece_border(&memory),
      piece_corner(&memory),
      face_start(&memory),
      face(&memory),
      sampled(&memory),
      edge_weight(core.weights().begin(), core.weights().end(), &memory) {
  core.jobs->for_each(2, [&](std::uint32_t half) {
    if (half == 0) {
      list_triangles_by_piece(core.mesh, *this);
      list_faces(core.mesh, *this);
    } else {
      sort_components(core.mesh, *this);
      sample_triangles(core.mesh, *this);
      for (double& w : edge_weight) w = std::clamp(w, least_edge_weight, largest_edge_weight);
    }
  });
}

Rest::Rest(std::shared_ptr<const RestShape> of, const surface::Core& core, Memory& memory)
    : shape(std::move(of)),
      component_start(shape->component_start),
      component_vertex(shape->component_vertex),
      component_triangles(shape->component_triangles),
      component_area(shape->component_area),
      area(shape->area),
      piece_start(shape->piece_start),
      piece_border(shape->piece_border),
      piece_corner(shape->piece_corner),
      face_start(shape->face_start),
      face(shape->face),
      sampled(shape->sampled),
      sampled_start(shape->sampled_start, histogram_shares + 1),
      stiffness(shape->edge_weight, &memory) {
  if (!core.stiffness) return;
  const mesh::Topology& topology = core.topology();
  const Vector<double>& given = *core.stiffness;
  for (std::int32_t v = 0; v < core.size(); ++v) {
    if (given[v] == 1) continue;
    for (std::int32_t k = topology.neighbour_start[v]; k < topology.neighbour_start[v + 1]; ++k) {
      const std::int32_t e = topology.neighbour_edge[k];  // one with two stiff ends comes twice
      const double s = surface::edge_stiffness(given[topology.first(e)], given[topology.second(e)]);
      stiffness[e] = shape->edge_weight[e] * std::clamp(s, 1 / largest_energy_stiffness, largest_energy_stiffness);
    }
  }
}

}  // namespace hf_inner::deform
