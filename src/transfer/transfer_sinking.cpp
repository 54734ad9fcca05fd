// Finds which parts of the target may sink into the ground (transfer_ground.cpp), and how far clusters rise together.
//
// A thin part (an ear, an antler, a blade) may sink by thin_depth: to raise a whole body for it looks worse. The half
// thickness of a cluster is the mean of n.(x - c) over its area, with unit normals n and the cluster's centroid c. For
// a tube it is the radius times a factor near 1. A patch of a larger body is flat too, but its area vectors do not
// cancel. Legs never sink, because a foot's path is worth more. The whole limb of a pair flagged HF_PAIR_SINKS may
// sink.
#include <cmath>

#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"

namespace hf_inner {

void Transfer::prepare_sinking(Prepared& p) const {
  const std::size_t count = at(p.clusters.count), width = numbers_.size();
  Memory& memory = *target_core_->memory;
  const Mesh& mesh = target_core_->mesh;
  Vector<Vec3> vector(mesh.positions.size(), &memory);
  for (std::size_t t = 0; t < mesh.corners.size(); t += 3) {
    const Vec3 a = mesh.positions[at(mesh.corners[t])], b = mesh.positions[at(mesh.corners[t + 1])],
               c = mesh.positions[at(mesh.corners[t + 2])];
    const Vec3 third = (1.0 / 6) * cross(b - a, c - a);
    for (std::size_t k = 0; k < 3; ++k) vector[at(mesh.corners[t + k])] = vector[at(mesh.corners[t + k])] + third;
  }
  Vector<double> moment(count, 0.0, &memory), area(count, 0.0, &memory);
  Vector<Vec3> sum(count, &memory);
  p.sinks.assign(count, 0.0), p.falloff.allocate(memory, count * count);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (std::size_t i = v * blend_count; i < (v + 1) * blend_count; ++i) {
      const std::size_t c = at(p.clusters.joint[i]);
      const double w = static_cast<double>(p.clusters.weight[i]);
      moment[c] += w * dot(vector[v], mesh.positions[v] - p.clusters.pivot[c]);
      area[c] += w * norm(vector[v]), sum[c] = sum[c] + w * vector[v];
    }
  }
  for (std::size_t c = 0; c < count; ++c) {
    const double* centre = p.clusters.centre.data() + c * width;
    const std::uint32_t flags =
        flags_[numbers_[static_cast<std::size_t>(std::max_element(centre, centre + width) - centre)]];
    if (flags & HF_PAIR_SINKS) {
      p.sinks[c] = no_height;
    } else if (!(flags & (HF_PAIR_FOOT | HF_PAIR_TRUNK)) && area[c] > 0 && norm(sum[c]) < open_share * area[c]) {
      p.sinks[c] = thin_depth * (1 - smooth_step(thin_from, thin_to, std::abs(moment[c]) / area[c]));
    }
    for (std::size_t d = 0; d < count; ++d) {
      double square = 0;
      for (std::size_t h = 0; h < width; ++h) {
        const double x = centre[h] - p.clusters.centre[d * width + h];
        square += x * x;
      }
      p.falloff[c * count + d] = 1 - smooth_step(0, rise_reach, std::sqrt(square));
    }
  }
}

}  // namespace hf_inner
