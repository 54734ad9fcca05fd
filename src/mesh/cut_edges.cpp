#include "mesh/cut_edges.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "mesh/place_reader.h"
#include "mesh/places.h"
#include "mesh/vertex_fan.h"

namespace hf_inner::mesh {
namespace {

struct Edge : CutEdge {  // of inner vertices
  std::uint32_t given;
};

Vector<Edge> read_edges(const Mesh& mesh, Span<const std::uint32_t> edges, Memory& memory) {
  Vector<Edge> out(&memory);
  for (std::uint32_t i = 0; i < edges.size() / 2; ++i) {
    Index end[2];
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t given = edges[2 * i + k];
      if (given >= mesh.report.vertex_count)
        fail(HF_ERROR_OUT_OF_RANGE, i, "entry %u of cut_edges names vertex %u; the surface has %u vertices", i, given,
             mesh.report.vertex_count);
      end[k] = usable_vertex(mesh, given, i, "cut_edges");
    }
    if (end[0] == end[1])
      fail(HF_ERROR_INVALID_ARGUMENT, i, "entry %u of cut_edges: vertices %u and %u are one, or welded", i,
           edges[2 * i], edges[2 * i + 1]);
    out.push_back({{std::min(end[0], end[1]), std::max(end[0], end[1])}, i});
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

Vector<Mesh::CutCorner> cut_edges(const Mesh& mesh, Span<const std::uint32_t> edges, Memory& memory) {
  require_triangles(mesh, "a cut", HF_NO_INDEX);
  const Vector<Edge> cut = read_edges(mesh, edges, memory);
  Vector<std::uint8_t> on(mesh.positions.size(), 0, &memory);
  for (const Edge& edge : cut) on[at(edge.first)] = on[at(edge.second)] = 1;
  Vector<Wing> wings(&memory);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index* const v = mesh.triangle(t);
    for (int k = 0; k < 3; ++k)
      if (on[at(v[k])]) wings.push_back({v[k], t, k, v[(k + 1) % 3], v[(k + 2) % 3]});
  }
  std::stable_sort(wings.begin(), wings.end(), [](const Wing& a, const Wing& b) { return a.vertex < b.vertex; });
  Vector<CutEdge> there(&memory);
  for (const Wing& wing : wings) {
    for (const Index other : {wing.next, wing.last})
      there.push_back({std::min(wing.vertex, other), std::max(wing.vertex, other)});
  }
  std::sort(there.begin(), there.end());
  Vector<CutEdge> pairs(&memory);
  for (const Edge& edge : cut) {
    pairs.push_back(edge);
    if (!std::binary_search(there.begin(), there.end(), pairs.back()))
      fail(HF_ERROR_NOT_FOUND, edge.given, "entry %u of cut_edges: no triangle has an edge between vertices %u and %u",
           edge.given, edges[2 * edge.given], edges[2 * edge.given + 1]);
  }
  Vector<Index> given(at(mesh.triangle_count()), Mesh::none, &memory);
  for (std::size_t g = mesh.triangle_of_given.size(); g-- > 0;)
    if (mesh.triangle_of_given[g] != Mesh::none) given[at(mesh.triangle_of_given[g])] = static_cast<Index>(g);
  Vector<Mesh::CutCorner> out(&memory);
  Index next_copy = static_cast<Index>(mesh.report.vertex_count);
  for (std::size_t begin = 0, end = 0; begin < wings.size(); begin = end) {
    while (end < wings.size() && wings[end].vertex == wings[begin].vertex) ++end;
    const Vector<FanPart> parts = fan_parts({wings.data() + begin, end - begin}, pairs, memory);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i > 0 && parts[i].part != parts[i - 1].part) ++next_copy;
      const Wing& wing = wings[begin + at(parts[i].wing)];
      out.push_back({given[at(wing.triangle)], wing.corner, next_copy, mesh.given_of_inner[at(wing.vertex)]});
    }
    if (!parts.empty()) ++next_copy;
  }
  if (out.empty())
    fail(HF_ERROR_EMPTY, HF_NO_INDEX,
         "the cut parts nothing: inside a surface it takes two edges in a row, on the border one that ends there");
  return out;
}

}  // namespace hf_inner::mesh
