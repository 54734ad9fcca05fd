#include "mesh/links.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/stable_sort.h"
#include "mesh/link_constants.h"
#include "mesh/link_search.h"
#include "mesh/touching.h"
#include "mesh/union_find.h"

namespace hf_inner::mesh {
namespace {

// The edge weight between two equilateral triangles, cot 60 degrees.
constexpr double equilateral_weight = 0.57735026918962573;

bool is_light(const Links& links, Index vertex) noexcept { return links.light[at(links.piece[at(vertex)])] != 0; }

// Marks the pieces of some vertices.
void mark(Span<const Index> vertices, const Links& links, Vector<std::uint8_t>& marks) {
  for (const Index v : vertices) marks[at(links.piece[at(v)])] = 1;
}

void take_list(const Mesh& mesh, const LinkOptions& options, Links& out) {
  mark(options.light, out, out.light);
  for (const Link& given : options.list) {
    Link link = given;
    link.length = rest_length(link, mesh);
    out.links.push_back(link);
  }
}

}  // namespace

double difference(const SkinHint& skin, const Mesh& mesh, Index vertex, const Index* corner, const double* share) {
  // The sum of |w_a - w_b| over joints, halved. Rows are short, so each joint is searched in the other rows.
  const auto row = [&](Index v) { return std::size_t{skin.influence_count} * at(mesh.given_of_inner[at(v)]); };
  const auto weight = [&](Index v, std::uint16_t joint) {
    double sum = 0;
    for (std::size_t i = row(v); i < row(v) + skin.influence_count; ++i)
      sum += skin.joints[i] == joint ? static_cast<double>(skin.weights[i]) : 0.0;
    return sum;
  };
  double common = 0;
  for (std::size_t i = row(vertex); i < row(vertex) + skin.influence_count; ++i) {
    bool again = false;  // a joint named twice
    for (std::size_t j = row(vertex); j < i; ++j) again = again || skin.joints[j] == skin.joints[i];
    if (again || !(skin.weights[i] > 0)) continue;
    double other = 0;
    for (std::size_t k = 0; k < 3; ++k) other += share[k] * weight(corner[k], skin.joints[i]);
    common += std::min(other, weight(vertex, skin.joints[i]));
  }
  return std::min(std::max(1 - common, 0.0), 1.0);
}

double rest_length(const Link& link, const Mesh& mesh) noexcept {
  Vec3 apart = mesh.positions[at(link.vertex)];
  for (std::size_t k = 0; k < 3; ++k) {
    if (link.share[k] > 0) apart = apart - link.share[k] * mesh.positions[at(link.corner[k])];
  }
  return norm(apart);
}

void find_groups(Links& out, Memory& memory) {
  const std::size_t pieces = out.light.size();
  UnionFind sets(pieces, memory);
  Vector<std::uint8_t> linked(pieces, 0, &memory);
  for (const Link& link : out.links) {
    for (const Index corner : link.corner) {
      if (corner == Mesh::none) continue;
      const Index a = out.piece[at(link.vertex)], b = out.piece[at(corner)];
      sets.unite(a, b);
      if (a != b) linked[at(a)] = linked[at(b)] = 1;
    }
  }
  out.group.resize(pieces);
  out.group_count = out.alone_count = 0;
  for (std::size_t p = 0; p < pieces; ++p) {
    const Index root = sets.find(static_cast<Index>(p));
    out.group[p] = root == static_cast<Index>(p) ? out.group_count++ : out.group[at(root)];
    out.alone_count += pieces > 1 && !linked[p];
  }
}

std::shared_ptr<const Links> make_links(const Mesh& mesh, Span<const double> areas, const LinkOptions& options,
                                        Memory& memory, JobRunner* jobs) {
  const std::shared_ptr<Links> made = make_shared_in<Links>(memory, memory);
  Links& out = *made;
  out.stiffness = options.stiffness;
  out.piece = mesh.component;
  out.light.assign(at(mesh.component_count()), 0);
  Vector<std::uint8_t> light(out.light.size(), 0, &memory);
  mark(options.light, out, light);
  for (std::size_t i = 0; i < options.heavy.size(); ++i) {
    if (light[at(out.piece[at(options.heavy[i])])])
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(i),
           "entry %zu of heavy_vertices: its piece is in light_vertices too", i);
  }
  if (options.mode == LinkMode::list) take_list(mesh, options, out);
  if (mesh.component_count() > 1 && (options.mode == LinkMode::pieces || !out.links.empty())) {
    const ContactSearch contacts(mesh, options.skin, memory);
    if (options.mode == LinkMode::pieces) search_links(mesh, areas, options, contacts, memory, jobs, out);
    find_touching(contacts, memory, jobs, out);
  }
  find_groups(out, memory);
  return made;
}

Vector<LinkEdge> link_edges(const Links& links, OperatorKind operator_kind, Memory& memory) {
  const double unit = links.stiffness * (operator_kind == OperatorKind::uniform ? 1.0 : equilateral_weight);
  Vector<LinkEdge> edges(&memory);
  for (const Link& link : links.links) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(link.share[k] > 0) || link.corner[k] == link.vertex) continue;
      const Index a = std::min(link.vertex, link.corner[k]), b = std::max(link.vertex, link.corner[k]);
      const double light = is_light(links, a) || is_light(links, b) ? light_share : 1.0;
      edges.push_back({a, b, unit * light * link.weight * link.share[k]});
    }
  }
  // Equal edges are summed in the order of the links.
  stable_sort(
      edges,
      [](const LinkEdge& a, const LinkEdge& b) { return a.first != b.first ? a.first < b.first : a.second < b.second; },
      memory);
  std::size_t kept = 0;
  for (const LinkEdge& edge : edges) {
    if (kept > 0 && edges[kept - 1].first == edge.first && edges[kept - 1].second == edge.second)
      edges[kept - 1].weight += edge.weight;
    else
      edges[kept++] = edge;
  }
  edges.resize(kept);
  return edges;
}

Mesh linked_mesh(const Mesh& mesh, const Links& links, Memory& memory) {
  Mesh out = mesh;
  out.faces = Faces(memory);
  out.component = SharedVector<Index>(memory);
  out.component.reserve(links.piece.size());
  // Pieces are numbered by their lowest vertices, so groups are too.
  out.component.change([&](Vector<Index>& component) {
    for (const Index piece : links.piece) component.push_back(links.group[at(piece)]);
  });
  out.report.component_count = static_cast<std::uint32_t>(links.group_count);
  return out;
}

Topology linked_topology(const Topology& topology, const Links& links, Span<const LinkEdge> edges,
                         Vector<double>& weights, Memory& memory) {
  Topology out(memory);
  Vector<double> merged(&memory);
  const auto copy_edge = [&](Index e) {
    out.edges.push_back(topology.first(e));
    out.edges.push_back(topology.second(e));
    out.edge_triangle_start.push_back(topology.edge_triangle_start[at(e)]);
    merged.push_back(weights[at(e)] * (is_light(links, topology.first(e)) ? light_share : 1.0));
  };
  Index e = 0;
  for (const LinkEdge& edge : edges) {
    const auto before = [&] {
      return topology.first(e) != edge.first ? topology.first(e) < edge.first : topology.second(e) < edge.second;
    };
    while (e < topology.edge_count() && before()) copy_edge(e++);
    if (e < topology.edge_count() && topology.first(e) == edge.first && topology.second(e) == edge.second) {
      copy_edge(e++);
      merged.back() += edge.weight;
      continue;
    }
    out.edges.push_back(edge.first);
    out.edges.push_back(edge.second);
    out.edge_triangle_start.push_back(topology.edge_triangle_start[at(e)]);
    merged.push_back(edge.weight);
  }
  while (e < topology.edge_count()) copy_edge(e++);
  out.edge_triangle_start.push_back(topology.edge_triangle_start.back());
  out.edge_side.assign(topology.edge_side.begin(), topology.edge_side.end());
  weights.assign(merged.begin(), merged.end());
  out.fill_neighbours(topology.neighbour_start.size() - 1, memory);
  return out;
}

void add_links(SymmetricMatrix& laplacian, const Links& links, Span<const LinkEdge> edges, Memory& memory) {
  const std::size_t n = at(laplacian.size());
  // The links of every vertex, in ascending order of the other end.
  Vector<Index> start(n + 1, 0, &memory);
  for (const LinkEdge& edge : edges) {
    ++start[at(edge.first) + 1];
    ++start[at(edge.second) + 1];
  }
  for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
  struct End {
    Index other;
    double weight;
  };
  Vector<End> ends(2 * edges.size(), &memory);
  Vector<Index> next(start.begin(), start.end() - 1, &memory);
  for (const LinkEdge& edge : edges) ends[at(next[at(edge.second)]++)] = {edge.first, edge.weight};
  for (const LinkEdge& edge : edges) ends[at(next[at(edge.first)]++)] = {edge.second, edge.weight};

  SymmetricMatrix out(memory);
  out.row.reserve(laplacian.row.size() + ends.size());
  out.value.reserve(laplacian.row.size() + ends.size());
  for (std::size_t v = 0; v < n; ++v) {
    const double scale = is_light(links, static_cast<Index>(v)) ? light_share : 1.0;
    const std::size_t begin = out.row.size();
    std::size_t diagonal = begin;
    double rest = 0;
    Index link = start[v];
    const auto put = [&](Index row, double value) {
      out.row.push_back(row);
      out.value.push_back(value);
      rest += value;
    };
    for (std::size_t i = at(laplacian.column_start[v]); i < at(laplacian.column_start[v + 1]); ++i) {
      const Index row = laplacian.row[i];
      for (; link < start[v + 1] && ends[at(link)].other < row; ++link)
        put(ends[at(link)].other, -ends[at(link)].weight);
      if (at(row) == v) {
        diagonal = out.row.size();
        out.row.push_back(row);
        out.value.push_back(scale * laplacian.value[i]);
        continue;
      }
      double value = scale * laplacian.value[i];
      if (link < start[v + 1] && ends[at(link)].other == row) value -= ends[at(link++)].weight;
      put(row, value);
    }
    for (; link < start[v + 1]; ++link) put(ends[at(link)].other, -ends[at(link)].weight);
    if (start[v] < start[v + 1]) out.value[diagonal] = -rest;  // vertices without a link keep their bits
    out.column_start.push_back(static_cast<Index>(begin));
  }
  out.column_start.push_back(static_cast<Index>(out.row.size()));
  laplacian = std::move(out);
}

void measure_gaps(const Mesh& mesh, Span<const Link> links, const ConstRows& posed, Span<double> gaps) {
  const auto place = [&](Index inner) {
    const std::size_t v = at(mesh.given_of_inner[at(inner)]);
    const Vec3 p{posed.get(v, 0), posed.get(v, 1), posed.get(v, 2)};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(v), "the position of vertex %zu is not finite", v);
    return p;
  };
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    Vec3 apart = place(link.vertex);
    for (std::size_t k = 0; k < 3; ++k) {
      if (link.corner[k] != Mesh::none) apart = apart - link.share[k] * place(link.corner[k]);
    }
    gaps[i] = std::max(0.0, norm(apart) - mesh.scale * link.length);
    if (!std::isfinite(gaps[i]))
      fail(HF_ERROR_TOO_LARGE, static_cast<std::uint32_t>(mesh.given_of_inner[at(link.vertex)]),
           "the gap at vertex %d is no number: give positions in the unit of the surface",
           mesh.given_of_inner[at(link.vertex)]);
  }
}

GapSummary summarise_gaps(Span<double> gaps) {
  GapSummary out;
  if (gaps.size() == 0) return out;
  const auto worst = std::max_element(gaps.begin(), gaps.end());
  out.worst = *worst;
  out.worst_link = static_cast<std::uint32_t>(worst - gaps.begin());
  const auto share = gaps.begin() + static_cast<std::ptrdiff_t>((95 * gaps.size() + 99) / 100 - 1);
  std::nth_element(gaps.begin(), share, gaps.end());
  out.percentile_95 = *share;
  return out;
}

}  // namespace hf_inner::mesh
