#include "mesh/graph.h"

#include <algorithm>
#include <cmath>

#include "base/arguments.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/laplacian.h"

namespace hf_inner::mesh {
namespace {

// Weights and masses may be at most this large. Squares and sums of larger ones could overflow.
constexpr double largest_weight = 1e100;
// Weights below this share of the largest of their component are rounding, as cotangents of right angles are. They do
// not count for the median. Half or double changes no unit unless a weight lies between.
constexpr double rounding_share = 1e-12;
// Weights are kept to this factor around their median. Roots of products of two then fit single precision, which
// previews use. No matrix keeps the digits of weights that far apart, so the exact factor does not matter.
constexpr double widest_spread = 1e30;

// A cancelled call is noticed after this many vertices, some milliseconds: half of them in half the time, at the cost
// of one more look at a number. No result depends on it.
constexpr std::size_t polled_piece = 16384;

// One direction of an edge of the caller: its larger vertex and its weight.
struct Arc {
  Index to;
  double weight;
};

void check_counts(const GraphInput& input) {
  if (input.vertex_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "vertex_count is 0");
  if (input.edge_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "edges.count is 0");
  if (input.vertex_count > most_elements)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u vertices; at most %u are supported", input.vertex_count, most_elements);
  if (input.edge_count > most_elements)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u edges; at most %u are supported", input.edge_count, most_elements);
}

void check_edges(const GraphInput& input) {
  for (std::uint32_t e = 0; e < input.edge_count; ++e) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t v = input.edges.get(e, k);
      if (v >= input.vertex_count)
        fail(HF_ERROR_OUT_OF_RANGE, e, "edge %u: end %zu is vertex %u, but there are %u vertices", e, k, v,
             input.vertex_count);
    }
    const double w = input.weights.get(e, 0);
    if (!std::isfinite(w)) fail(HF_ERROR_NON_FINITE, e, "edge %u: the weight is not a finite number", e);
    if (std::fabs(w) > largest_weight)
      fail(HF_ERROR_TOO_LARGE, e, "edge %u: the weight is %g; scale the weights below 1e100", e, w);
    if (w < 0 && !input.allow_negative)
      fail(HF_ERROR_INVALID_ARGUMENT, e, "edge %u: the weight is %g; use 0 or more, or set allow_negative", e, w);
  }
}

void check_masses(const GraphInput& input) {
  for (std::uint32_t v = 0; input.masses && v < input.vertex_count; ++v) {
    const double mass = input.masses.get(v, 0);
    if (!std::isfinite(mass)) fail(HF_ERROR_NON_FINITE, v, "vertex %u: the mass is not a finite number", v);
    if (!(mass > 0)) fail(HF_ERROR_INVALID_ARGUMENT, v, "vertex %u: the mass is %g; it must be above 0", v, mass);
    if (mass > largest_weight)
      fail(HF_ERROR_TOO_LARGE, v, "vertex %u: the mass is %g; scale the masses below 1e100", v, mass);
  }
}

// Writes the edges with their sums to topology.edges and weights, in the numbers of the caller, ordered by (first,
// second). The order of the list does not change a sum.
void sum_edges(const GraphInput& input, Memory& memory, WeightedGraph& graph) {
  Vector<Index> start(std::size_t{input.vertex_count} + 1, 0, &memory);
  const auto each_edge = [&](auto&& work) {
    for (std::size_t e = 0; e < input.edge_count; ++e) {
      const std::uint32_t a = input.edges.get(e, 0), b = input.edges.get(e, 1);
      if (a != b) work(std::min(a, b), Arc{static_cast<Index>(std::max(a, b)), input.weights.get(e, 0)});
    }
  };
  each_edge([&](std::uint32_t from, const Arc&) { ++start[std::size_t{from} + 1]; });
  for (std::size_t v = 0; v < input.vertex_count; ++v) start[v + 1] += start[v];
  Vector<Arc> arcs(at(start.back()), &memory);
  Vector<Index> cursor(start.begin(), start.end() - 1, &memory);
  each_edge([&](std::uint32_t from, const Arc& arc) { arcs[at(cursor[from]++)] = arc; });
  poll();
  graph.topology.edges.reserve(2 * arcs.size());
  graph.weights.reserve(arcs.size());
  for (std::size_t v = 0; v < input.vertex_count; ++v) {
    if (v % polled_piece == 0) poll();
    const auto begin = arcs.begin() + start[v], end = arcs.begin() + start[v + 1];
    std::sort(begin, end, [](const Arc& a, const Arc& b) { return a.to != b.to ? a.to < b.to : a.weight < b.weight; });
    for (auto arc = begin; arc != end;) {
      const Index to = arc->to;
      double sum = 0;
      for (; arc != end && arc->to == to; ++arc) sum += arc->weight;
      if (sum == 0) continue;
      graph.topology.edges.push_back(static_cast<Index>(v));
      graph.topology.edges.push_back(to);
      graph.weights.push_back(sum);
    }
  }
  if (graph.weights.empty())
    fail(HF_ERROR_EMPTY, HF_NO_INDEX, "every edge is a self loop or has weight 0; nothing is left of the graph");
}

// Numbers the vertices that have an edge, in the caller's order, and takes their masses.
void number_vertices(const GraphInput& input, Memory& memory, WeightedGraph& graph) {
  Mesh& mesh = graph.mesh;
  mesh.inner_of_given.assign(input.vertex_count, Mesh::none);
  for (const Index v : graph.topology.edges) mesh.inner_of_given[at(v)] = 0;
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    if (mesh.inner_of_given[v] == Mesh::none) {
      mesh.isolated.push_back({static_cast<Index>(v), {}});
      continue;
    }
    mesh.inner_of_given[v] = static_cast<Index>(mesh.given_of_inner.size());
    mesh.given_of_inner.push_back(static_cast<Index>(v));
    graph.masses.push_back(input.masses ? input.masses.get(v, 0) : 1.0);
  }
  for (Index& v : graph.topology.edges) v = mesh.inner_of_given[at(v)];
  mesh.positions.resize(mesh.given_of_inner.size());
  graph.topology.edge_triangle_start.assign(graph.weights.size() + 1, 0);
  graph.topology.fill_neighbours(mesh.positions.size(), memory);
}

// Numbers the components in the order of their lowest vertices.
void find_components(Memory& memory, WeightedGraph& graph) {
  Mesh& mesh = graph.mesh;
  const Topology& topology = graph.topology;
  mesh.component.assign(mesh.positions.size(), Mesh::none);
  Vector<Index> open(&memory);
  for (Index first = 0; first < mesh.vertex_count(); ++first) {
    if (mesh.component[at(first)] != Mesh::none) continue;
    const Index number = static_cast<Index>(mesh.report.component_count++);
    mesh.component[at(first)] = number;
    open.push_back(first);
    while (!open.empty()) {
      const std::size_t v = at(open.back());
      open.pop_back();
      for (Index i = topology.neighbour_start[v]; i < topology.neighbour_start[v + 1]; ++i) {
        const Index w = topology.neighbour[at(i)];
        if (mesh.component[at(w)] == Mesh::none) {
          mesh.component[at(w)] = number;
          open.push_back(w);
        }
      }
    }
  }
}

// Returns the exponent of the power of two just above the median of the sizes. Sizes that are rounding do not count.
int exponent_of_median(double* begin, double* end) noexcept {
  const double least = rounding_share * *std::max_element(begin, end);
  begin = std::partition(begin, end, [&](double w) { return w < least; });
  double* const middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end);
  int exponent = 0;
  std::frexp(*middle, &exponent);
  return exponent;
}

// Divides the weights of every component by a power of two near their median, and limits those too far from it.
void scale_weights(Memory& memory, WeightedGraph& graph) {
  const Mesh& mesh = graph.mesh;
  const Topology& topology = graph.topology;
  const std::size_t components = at(mesh.component_count());
  const auto component_of = [&](std::size_t e) { return at(mesh.component[at(topology.edges[2 * e])]); };
  Vector<std::size_t> start(components + 1, 0, &memory);
  for (std::size_t e = 0; e < graph.weights.size(); ++e) ++start[component_of(e) + 1];
  for (std::size_t c = 0; c < components; ++c) start[c + 1] += start[c];
  Vector<double> sizes(graph.weights.size(), &memory);
  Vector<std::size_t> cursor(start.begin(), start.end() - 1, &memory);
  for (std::size_t e = 0; e < graph.weights.size(); ++e) sizes[cursor[component_of(e)]++] = std::fabs(graph.weights[e]);
  Vector<int> exponent(components, &memory);
  for (std::size_t c = 0; c < components; ++c) {
    exponent[c] = exponent_of_median(sizes.data() + start[c], sizes.data() + start[c + 1]);
    graph.weight_unit.push_back(std::ldexp(1.0, exponent[c]));
  }
  graph.limited.assign(mesh.positions.size(), 0);
  for (std::size_t e = 0; e < graph.weights.size(); ++e) {
    const double w = std::ldexp(graph.weights[e], -exponent[component_of(e)]);
    const double kept = std::min(std::max(std::fabs(w), 1 / widest_spread), widest_spread);
    graph.weights[e] = std::copysign(kept, graph.weights[e]);
    if (kept < std::fabs(w) || kept > std::fabs(w))
      graph.limited[at(topology.edges[2 * e])] = graph.limited[at(topology.edges[2 * e + 1])] = 1;
  }
}

}  // namespace

GraphInput read_graph(const hf_graph_desc& desc) {
  check_flag(desc.allow_negative, "allow_negative");
  GraphInput input;
  input.vertex_count = desc.vertex_count;
  input.edge_count = desc.edges.count;
  input.edges = read_indices(desc.edges, HF_TYPE_UINT16, 2, "edges");
  if (input.edges && !is_given(desc.weights)) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "weights.data is NULL");
  input.weights = read_reals(desc.weights, 1, input.edge_count, "edges", "weights");
  input.masses = read_reals(desc.masses, 1, input.vertex_count, "vertices", "masses");
  input.allow_negative = desc.allow_negative == 1;
  return input;
}

WeightedGraph WeightedGraph::make(const GraphInput& input, Memory& memory) {
  check_counts(input);
  check_edges(input);
  check_masses(input);
  WeightedGraph graph(memory);
  poll();
  sum_edges(input, memory, graph);
  poll();
  number_vertices(input, memory, graph);
  poll();
  find_components(memory, graph);
  scale_weights(memory, graph);
  MeshReport& report = graph.mesh.report;
  report.vertex_count = report.welded_vertex_count = input.vertex_count;
  report.isolated_vertex_count = static_cast<std::uint32_t>(graph.mesh.isolated.size());
  report.negative_edge_count = count_negative(graph.weights);
  return graph;
}

}  // namespace hf_inner::mesh
