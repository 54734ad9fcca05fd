// See overlaps.h.
#include "transfer/overlaps.h"

#include <cmath>

#include "base/index.h"
#include "base/progress.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {

Overlaps overlaps_of(std::size_t cluster_count, const WeightedSurface& side, Memory& memory) {
  Overlaps out(cluster_count, memory);
  Poller poller;
  for (std::size_t v = 0; v < side.area.size(); ++v) {
    poller.due();
    const std::int32_t* joint = side.joint + v * blend_count;
    const float* weight = side.weight + v * blend_count;
    const Vec3 place = side.core->mesh.positions[v];
    for (std::int32_t i = 0; i < blend_count; ++i) {
      if (!(weight[i] > 0)) continue;
      const double own = side.area[v] * static_cast<double>(weight[i]);
      const std::size_t c = at(joint[i]);
      out.own[c] += own;
      out.centroid[c] = out.centroid[c] + own * place;
      for (std::int32_t j = 0; j < blend_count; ++j) {
        if (!(weight[j] > 0)) continue;
        const double w = own * static_cast<double>(weight[j]);
        const std::size_t entry = c * cluster_count + at(joint[j]);
        out.mass[entry] += w;
        out.sum[entry] = out.sum[entry] + w * place;
      }
    }
  }
  for (std::size_t c = 0; c < cluster_count; ++c)
    if (out.own[c] > 0) out.centroid[c] = (1 / out.own[c]) * out.centroid[c];
  for (std::size_t v = 0; v < side.area.size(); ++v) {
    poller.due();
    for (std::size_t i = v * blend_count; i < (v + 1) * blend_count; ++i) {
      const std::size_t c = at(side.joint[i]);
      const Vec3 d = side.core->mesh.positions[v] - out.centroid[c];
      out.spread[c] += side.area[v] * static_cast<double>(side.weight[i]) * dot(d, d);
    }
  }
  for (std::size_t c = 0; c < cluster_count; ++c)
    out.spread[c] = out.own[c] > 0 ? std::sqrt(out.spread[c] / out.own[c]) : 0.0;
  return out;
}

}  // namespace hf_inner::transfer
