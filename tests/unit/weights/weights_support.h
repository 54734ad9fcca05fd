// A tube with a chain of bones in it, and the weights of a surface by bone.
#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "base/index.h"
#include "support/meshes.h"
#include "weights/weights.h"

namespace hf_test {

using hf_inner::at;
using hf_inner::Index;

// A closed tube of unit radius along x from 0 to `length`, with a cap at either end.
inline PlainMesh tube(std::uint32_t around, std::uint32_t rings, double length) {
  PlainMesh mesh;
  const double two_pi = 8 * std::atan(1.0);
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const double a = two_pi * k / around;
      mesh.positions.insert(mesh.positions.end(), {length * i / (rings - 1), std::cos(a), std::sin(a)});
    }
  }
  for (std::uint32_t i = 0; i + 1 < rings; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around, c = a + around, d = b + around;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
    }
  }
  for (const bool far : {false, true}) {
    const std::uint32_t middle = mesh.vertex_count(), ring = far ? (rings - 1) * around : 0;
    mesh.positions.insert(mesh.positions.end(), {far ? length : 0.0, 0.0, 0.0});
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = ring + k, b = ring + (k + 1) % around;
      if (far) {
        mesh.triangles.insert(mesh.triangles.end(), {middle, a, b});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {middle, b, a});
      }
    }
  }
  return mesh;
}

// Bones one after the other along the axis of the tube.
inline hf_inner::weights::Bones chain(hf_inner::Memory& memory, int count, double length) {
  hf_inner::weights::Bones bones(memory);
  bones.has_tails = true;
  for (int b = 0; b < count; ++b) {
    bones.head.push_back({length * b / count, 0, 0});
    bones.tail.push_back({length * (b + 1) / count, 0, 0});
    bones.parent.push_back(b - 1);
    bones.deforms.push_back(1);
  }
  return bones;
}

inline std::shared_ptr<const hf_inner::weights::SkinSurface> skin_of(const PlainMesh& mesh, std::uint32_t threads = 1) {
  const auto core = make_core(mesh, threads);
  return hf_inner::make_owner_in<hf_inner::weights::SkinSurface>(core->memory, core);
}

inline double weight_of(const hf_inner::weights::Weights& weights, Index v, std::uint32_t bone) {
  const std::size_t k = at(weights.influences());
  double sum = 0;
  for (std::size_t i = 0; i < k; ++i) {
    if (weights.state().joints[at(v) * k + i] == bone)
      sum += static_cast<double>(weights.state().weights[at(v) * k + i]);
  }
  return sum;
}

// Every vertex has weights that are not negative, descend and sum to 1 in floats, and joints below the count.
inline void expect_valid(const hf_inner::weights::Weights& weights, const std::string& what = "") {
  const std::size_t k = at(weights.influences());
  const hf_inner::weights::WeightState& state = weights.state();
  std::size_t faults = 0;
  for (std::size_t v = 0; v < state.origin.size(); ++v) {
    float sum = 0;
    bool good = true;
    for (std::size_t i = 0; i < k; ++i) {
      const float w = state.weights[v * k + i];
      good &= w >= 0 && (i == 0 || w <= state.weights[v * k + i - 1]);
      good &= state.joints[v * k + i] < state.inputs->bones.head.size();
      sum += w;
    }
    faults += !(good && sum == 1.0f);
  }
  EXPECT_EQ(faults, 0u) << what;
}

inline double worst_difference(const hf_inner::weights::Weights& a, const hf_inner::weights::Weights& b) {
  double worst = 0;
  for (Index v = 0; at(v) < a.state().origin.size(); ++v) {
    for (std::uint32_t bone = 0; bone < a.state().inputs->bones.head.size(); ++bone)
      worst = std::max(worst, std::fabs(weight_of(a, v, bone) - weight_of(b, v, bone)));
  }
  return worst;
}

inline bool same_weights(const hf_inner::weights::Weights& a, const hf_inner::weights::Weights& b) {
  return a.state().joints == b.state().joints && a.state().weights == b.state().weights;
}

}  // namespace hf_test
