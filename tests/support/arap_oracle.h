// As-rigid-as-possible deformation of the full mesh (Sorkine and Alexa 2007), alternating a rotation per vertex and one
// prefactored Laplace solve, handles fixed: the oracle poses are compared with. Spokes energy, clamped cotangent
// weights; the factor is that of the library with the handles' rows eliminated. On cylinders and bars its minima
// collapse, so it is a target for planes and scans only.
#pragma once
#include <algorithm>
#include <vector>

#include "deform/refine.h"
#include "deform/rest.h"
#include "surface/core.h"

namespace hf_test {

class ArapOracle {
 public:
  // fixed: per inner vertex, non-zero where it belongs to a handle.
  ArapOracle(const hf_inner::surface::Core& core, std::vector<std::uint8_t> fixed)
      : core_(core),
        rest_(core, *core.memory),
        fixed_(std::move(fixed)),
        rotation_(static_cast<std::size_t>(core.size())),
        z_(3 * static_cast<std::size_t>(core.size())) {
    factor_ = core.factor->refactor(core.matrix(), {fixed_.data(), fixed_.size()}, *core.memory, *core.jobs);
  }

  // Smooth rotations (Levi and Gotsman 2015): the energy has share * area * sum_vu w_vu |R_v - R_u|^2 besides, area in
  // square units of the mesh. 0: none.
  void set_smoothness(double area_share) { smoothness_ = area_share; }

  // One iteration on positions in the mesh's own unit; the fixed ones stay.
  void iterate(std::vector<hf_inner::Vec3>& x) {
    const hf_inner::mesh::Topology& topology = core_.topology();
    const auto& p = core_.mesh.positions;
    before_ = rotation_;
    hf_inner::deform::for_vertex_pieces(*core_.jobs, core_.size(), [&](std::int32_t first, std::int32_t last) {
      for (std::int32_t v = first; v < last; ++v) {
        hf_inner::Mat3 s;
        hf_inner::deform::add_ring(core_, rest_, x.data(), v, s);
        for (std::int32_t k = topology.neighbour_start[v]; smoothness_ > 0 && k < topology.neighbour_start[v + 1]; ++k)
          s = s + smoothness_ * core_.weights()[topology.neighbour_edge[k]] *
                      before_[topology.neighbour[k]].toRotationMatrix();
        rotation_[v] = hf_inner::deform::best_rotation_from(s, rotation_[v]);
      }
    });
    const hf_inner::Span<const std::int32_t> position = core_.factor->position();
    hf_inner::deform::for_vertex_pieces(*core_.jobs, core_.size(), [&](std::int32_t first, std::int32_t last) {
      for (std::int32_t v = first; v < last; ++v) {
        hf_inner::Vec3 sum;
        if (!fixed_[v]) {
          const hf_inner::Mat3 own = rotation_[v].toRotationMatrix();
          for (std::int32_t k = topology.neighbour_start[v]; k < topology.neighbour_start[v + 1]; ++k) {
            const std::int32_t u = topology.neighbour[k];
            const double w = core_.weights()[topology.neighbour_edge[k]];
            const hf_inner::Mat3 r = own + rotation_[u].toRotationMatrix();
            sum = sum + 0.5 * w * (r * (p[v] - p[u]));
            if (fixed_[u]) sum = sum + w * x[u];
          }
        }
        double* row = z_.data() + 3 * static_cast<std::size_t>(position[v]);
        row[0] = sum.x;
        row[1] = sum.y;
        row[2] = sum.z;
      }
    });
    factor_->forward(z_.data(), 3, *core_.jobs);
    factor_->backward(z_.data(), 3, *core_.jobs);
    for (std::int32_t v = 0; v < core_.size(); ++v) {
      const double* row = z_.data() + 3 * static_cast<std::size_t>(position[v]);
      if (!fixed_[v]) x[v] = {row[0], row[1], row[2]};
    }
  }

  // Until 20 iterations lower the energy by less than 2e-5 of it, or `limit`. Returns the iterations done.
  template <class Energy>
  int converge(std::vector<hf_inner::Vec3>& x, int limit, Energy&& energy) {
    double last = energy(x);
    int done = 0;
    while (done < limit) {
      for (int i = 0; i < 20; ++i) iterate(x);
      done += 20;
      const double now = energy(x);
      if (last - now < 2e-5 * now) break;
      last = now;
    }
    return done;
  }

 private:
  const hf_inner::surface::Core& core_;
  hf_inner::deform::Rest rest_;
  std::vector<std::uint8_t> fixed_;
  std::shared_ptr<const hf_inner::factor::Factor> factor_;
  double smoothness_ = 0;
  std::vector<hf_inner::deform::Quaternion> rotation_, before_;
  std::vector<double> z_;
};

}  // namespace hf_test
