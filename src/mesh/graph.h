// Reads a graph of the caller: edges, weights and masses become the arrays that a Mesh has, without triangles.
//
// Parallel edges are summed. Self loops and edges of weight 0 are left out. An inner vertex is a vertex with an edge
// that is left. Weights are scaled by component, so that rules for weights, which compare them with a median, hold for
// every component. The scale is a power of two, so it changes no digit of a field. Cost: O(n + m log m).
#pragma once
#include <cstdint>

#include "hf/surface.h"
#include "mesh/mesh.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

struct GraphInput {
  std::uint32_t vertex_count = 0;
  std::uint32_t edge_count = 0;
  IndexRows edges;    // edge_count x 2
  ConstRows weights;  // edge_count
  ConstRows masses;   // vertex_count, or null for ones
  bool allow_negative = false;
};

// Reads the arrays of a desc. Throws HF_ERROR_NULL_POINTER or HF_ERROR_INVALID_ARGUMENT; WeightedGraph::make checks
// their contents.
GraphInput read_graph(const hf_graph_desc& desc);

struct WeightedGraph {
  explicit WeightedGraph(Memory& memory)
      : mesh(memory), topology(memory), weights(&memory), masses(&memory), weight_unit(&memory), limited(&memory) {}
  // Throws HF_ERROR_EMPTY, HF_ERROR_OUT_OF_RANGE and HF_ERROR_NON_FINITE (index = edge, or vertex of a mass),
  // HF_ERROR_INVALID_ARGUMENT (a negative weight that is not allowed, a mass that is not above 0), HF_ERROR_TOO_LARGE.
  static WeightedGraph make(const GraphInput& input, Memory& memory);

  Mesh mesh;  // no triangles; the positions are all 0
  Topology topology;
  Vector<double> weights;        // by edge, in units of their component
  Vector<double> masses;         // by inner vertex
  Vector<double> weight_unit;    // by component: a weight of 1 here is this weight of the caller; a power of two
  Vector<std::uint8_t> limited;  // by inner vertex: 1 where a weight was too far from the median to be kept
};

}  // namespace hf_inner::mesh
