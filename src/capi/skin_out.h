// Writes the joints and weights of a pose or a transfer to the arrays of hf_skin_info.
#pragma once
#include <algorithm>

#include "base/arguments.h"
#include "capi/boundary.h"
#include "capi/vertex_writer.h"
#include "deform/rotation.h"
#include "hf/pose.h"

namespace hf_inner::capi {

class SkinOut {
 public:
  explicit SkinOut(hf_skin_info* inout) : inout_(inout), out_(read_struct(inout, "inout_skin")) {
    out_.influence_count = static_cast<std::uint32_t>(weights_per_vertex(out_.influence_count));
  }
  std::uint32_t influence_count() const noexcept { return out_.influence_count; }
  bool wants_scales() const noexcept { return out_.scales != nullptr; }

  // Call this first. Throws HF_ERROR_TOO_SMALL if the caller's arrays are too small.
  void write_counts(std::size_t joints, std::uint32_t vertices) {
    out_.joint_count = static_cast<std::uint32_t>(joints);
    out_.vertex_count = vertices;
    write_struct(inout_, out_);
    const bool per_joint = out_.pivots || out_.rotations || out_.translations || out_.axes || out_.scales;
    check_capacity(per_joint, out_.joint_capacity, joints, "joint_capacity");
    check_capacity(out_.vertex_joints || out_.vertex_weights, out_.vertex_capacity, vertices, "vertex_capacity");
  }
  void write_joint(std::size_t j, Vec3 pivot, const deform::Quaternion& rotation, Vec3 place,
                   const deform::Quaternion& axes, Vec3 scale) const {
    if (out_.pivots) put(pivot, out_.pivots + 3 * j);
    if (out_.translations) put(place, out_.translations + 3 * j);
    if (out_.rotations) put_quaternion(rotation, out_.rotations + 4 * j);
    if (out_.axes) put_quaternion(axes, out_.axes + 4 * j);
    if (out_.scales) put(scale, out_.scales + 3 * j);
  }
  // Calls weigh(inner, joints, weights) for every vertex of the caller's mesh. inner is the number of its welded
  // vertex, or Mesh::none for an isolated vertex.
  template <class Weigh>
  void write_vertices(const mesh::Mesh& mesh, Weigh&& weigh) const {
    if (!out_.vertex_joints && !out_.vertex_weights) return;
    mesh::visit_given(mesh, [&](std::size_t v, std::int32_t inner) {
      std::uint32_t joints[8] = {0};
      float weights[8] = {0};
      weigh(inner, joints, weights);
      if (out_.vertex_joints) std::copy_n(joints, influence_count(), out_.vertex_joints + v * influence_count());
      if (out_.vertex_weights) std::copy_n(weights, influence_count(), out_.vertex_weights + v * influence_count());
    });
  }

 private:
  static void put_quaternion(const deform::Quaternion& q, double* out) noexcept {
    std::copy_n(q.coeffs().data(), 4, out);  // x y z w
  }
  hf_skin_info* inout_;
  hf_skin_info out_;
};

}  // namespace hf_inner::capi
