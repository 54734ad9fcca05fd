// Sums over the vertices of each cluster: area, centroid and spread. The same sums over the vertices that two clusters
// have in common.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "surface/core.h"

namespace hf_inner::transfer {

// A surface whose vertices have weights in clusters.
struct WeightedSurface {
  const surface::Core* core = nullptr;
  Span<const double> area;
  const std::int32_t* joint = nullptr;  // blend_count for each vertex
  const float* weight = nullptr;
};

// a_v is the area of vertex v, W_vc its weight in cluster c, p_v its place at rest.
struct Overlaps {
  Overlaps(std::size_t count, Memory& memory)
      : mass(count * count, 0.0, &memory),
        sum(count * count, &memory),
        own(count, 0.0, &memory),
        centroid(count, &memory),
        spread(count, 0.0, &memory) {}
  // clusters x clusters
  Vector<double> mass;  // sum_v a_v W_vc W_vd
  Vector<Vec3> sum;     // sum_v a_v W_vc W_vd p_v
  // clusters
  Vector<double> own;  // sum_v a_v W_vc
  Vector<Vec3> centroid;
  Vector<double> spread;  // root mean square distance from the centroid
};

Overlaps overlaps_of(std::size_t cluster_count, const WeightedSurface& side, Memory& memory);

}  // namespace hf_inner::transfer
