// Farthest point sampling over the edge graph, in every component at once.
//
// The first sample of a component is the vertex farthest from its first vertex, each next one the vertex farthest from
// those before (Gonzalez 1985). Distances are lengths of edge paths, each search cut off where an earlier sample
// is nearer. Cost: about n times the harmonic number of the count.
#pragma once
#include "mesh/topology.h"

namespace hf {

struct SpreadSamples {
  explicit SpreadSamples(Memory& memory) : vertex(&memory), share(&memory) {}
  std::int32_t count = 0;       // rounds
  Vector<std::int32_t> vertex;  // component * count + round; Mesh::none when the component has no more vertices
  Vector<double> share;         // of the component's area that is nearest to the sample; sums to 1
};

SpreadSamples spread_samples(const Mesh& mesh, const Topology& topology, const Vector<double>& areas,
                             std::int32_t count, Memory& memory);

}  // namespace hf
