// Farthest point sampling over the edge graph, in every component at once.
//
// The first sample of a component is the vertex farthest from its first vertex. Each next one is the vertex farthest
// from those before (Gonzalez 1985). Distances are lengths of edge paths; a search stops where an earlier sample is
// nearer.
//
// A component with more than 384 vertices for every sample is sampled by patches: vertices within two edges of a
// middle, at most 24 of them. Neighbouring patches are joined by the distance of their middles. Samples are middles
// then, and a patch counts to one sample as a whole. Cost: O(n) for the patches, and about as many searches of the
// patches as the harmonic number of the count.
#pragma once
#include "mesh/topology.h"

namespace hf_inner {

struct SpreadSamples {
  explicit SpreadSamples(Memory& memory) : vertex(&memory), share(&memory) {}
  std::int32_t count = 0;       // rounds
  Vector<std::int32_t> vertex;  // component * count + round; Mesh::none when the component has no more vertices
  Vector<double> share;         // of the component's area that is nearest to the sample; sums to 1
};

SpreadSamples spread_samples(const Mesh& mesh, const Topology& topology, const Vector<double>& areas,
                             std::int32_t count, Memory& memory);

}  // namespace hf_inner
