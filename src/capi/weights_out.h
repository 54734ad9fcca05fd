// Writes weights by vertex to the arrays of hf_weights_out.
#pragma once
#include "capi/boundary.h"
#include "hf/weights.h"
#include "mesh/places.h"
#include "weights/pieces.h"

namespace hf_inner::capi {

inline bool wants_weights(const hf_weights_out& out) noexcept {
  return out.joints || out.joints_u16 || out.weights || out.origins;
}

// Writes the counts, and then checks that the arrays of the caller are long enough.
inline hf_weights_out read_weights_out(hf_weights_out* inout, const mesh::Mesh& mesh, std::int32_t influences) {
  hf_weights_out out = read_struct(inout, "inout_weights");
  out.vertex_count = mesh.report.vertex_count;
  out.influence_count = static_cast<std::uint32_t>(influences);
  write_struct(inout, out);
  check_capacity(wants_weights(out), out.vertex_capacity, out.vertex_count, "vertex_capacity");
  return out;
}

// largest: the largest number of a bone that the weights may name.
inline void check_joints_fit(const hf_weights_out& out, std::uint32_t largest) {
  constexpr std::uint32_t most_u16 = 65535;
  if (out.joints_u16 && largest > most_u16)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "joint %u does not fit 16 bits; use joints", largest);
}

// Made: WeightState or FilledWeights.
template <class Made>
void write_weights(const Made& made, const mesh::Mesh& mesh, const hf_weights_out& out) {
  const std::size_t k = out.influence_count;
  std::size_t isolated = 0;
  mesh::visit_given(mesh, [&](std::size_t v, std::int32_t welded) {
    const bool loose = welded == mesh::Mesh::none;
    const std::size_t inner = at(loose ? made.nearest_of_isolated[isolated++] : welded);
    for (std::size_t i = 0; i < k; ++i) {
      const std::uint32_t joint = made.joints[inner * k + i];
      if (out.joints) out.joints[v * k + i] = joint;
      if (out.joints_u16) out.joints_u16[v * k + i] = static_cast<std::uint16_t>(joint);
      if (out.weights) out.weights[v * k + i] = made.weights[inner * k + i];
    }
    if (out.origins) out.origins[v] = static_cast<std::uint8_t>(loose ? weights::Origin::isolated : made.origin[inner]);
  });
}

}  // namespace hf_inner::capi
