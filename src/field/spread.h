// Chooses sample vertices that lie far apart, in every component at once (farthest point sampling over the edge graph).
//
// The first sample of a component is the vertex farthest from the middle of its area. Each further sample is the vertex
// farthest from all samples so far (Gonzalez 1985). Distances between samples are lengths of edge paths. A search stops
// where an earlier sample is nearer. So samples do not depend on the order of the vertices.
//
// If a component has more than 384 vertices for every sample, patches are sampled instead of vertices. A patch has at
// most 24 vertices, all within two edges of its middle vertex. The distance between neighbouring patches is the
// distance of their middles. A sample is then the middle of a patch, and a whole patch belongs to one sample. Cost:
// O(n) to make the patches, then about 1 + 1/2 + ... + 1/count searches over all patches.
#pragma once
#include "mesh/topology.h"

namespace hf_inner::field {

struct SpreadSamples {
  explicit SpreadSamples(Memory& memory) : vertex(&memory), share(&memory) {}
  std::int32_t count = 0;       // samples of each component
  Vector<std::int32_t> vertex;  // component * count + round; Mesh::none when the component has no more vertices
  Vector<double> share;         // of the component's area that is nearest to the sample; sums to 1
};

SpreadSamples spread_samples(const mesh::Mesh& mesh, const mesh::Topology& topology, Span<const double> areas,
                             std::int32_t count, Memory& memory);

}  // namespace hf_inner::field
