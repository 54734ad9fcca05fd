// Keeps pieces of the target rigid, such as a sword (deform/rigid_pieces.h). This is the last step of a frame, after
// the rules of the ground. Each piece is one joint of the skin. A failed call leaves the previous pieces.
#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"

namespace hf_inner::transfer {

void Transfer::set_rigid_pieces(Span<const std::int32_t> vertices) {
  Memory& memory = *target_core_->memory;
  std::shared_ptr<const deform::RigidPieces> rigid;
  // the core that was factorised has the links
  if (!vertices.empty())
    rigid = make_shared_in<deform::RigidPieces>(memory, *target_factor_, vertices, target_core_->mesh, memory);
  Buffer<Vec3> scratch(memory, rigid ? rigid->scratch_size() : 0);
  Vector<deform::RigidMotion> motions(rigid ? rigid->count() : 0, deform::RigidMotion(), &memory);
  if (prepared_) prepared_->rigid_motions.swap(motions);
  rigid_scratch_ = std::move(scratch);
  rigid_ = std::move(rigid);
}

void Transfer::make_rigid(Prepared& p, Vec3* out) noexcept {
  if (rigid_) rigid_->make_rigid(out, rigid_scratch_.data(), p.rigid_motions.data());
}

std::size_t Transfer::joint_count() { return at(prepare().clusters.count) + (rigid_ ? rigid_->count() : 0); }

void Transfer::skin_motion(Vec3* pivots, deform::Quaternion* rotations, Vec3* places) {
  if (options_.mode == HF_TRANSFER_STRETCH)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "a transfer of mode HF_TRANSFER_STRETCH is no skin; take its positions");
  const Prepared& p = prepare();
  const mesh::Mesh& mesh = target_core_->mesh;
  const std::size_t clusters = p.rotations.size();
  for (std::size_t c = 0; c < clusters; ++c) {
    if (pivots) pivots[c] = mesh.to_given(p.clusters.pivot[c]);
    if (rotations) rotations[c] = p.rotations[c];
    if (places) places[c] = mesh.to_given(p.matrices[c] * p.clusters.pivot[c] + p.shifts[c]);
  }
  for (std::size_t k = 0; k < p.rigid_motions.size(); ++k) {
    const Vec3 pivot = rigid_->centroid(k);
    if (pivots) pivots[clusters + k] = pivot;
    if (rotations) rotations[clusters + k] = p.rigid_motions[k].rotation;
    if (places) places[clusters + k] = hf_inner::deform::apply(p.rigid_motions[k], pivot);
  }
}

void Transfer::skin_weights(std::int32_t vertex, std::uint32_t influence_count, std::uint32_t* joints, float* weights) {
  const Prepared& p = prepare();
  const std::int32_t piece = rigid_ ? rigid_->piece_of(vertex) : -1;
  for (std::uint32_t i = 0; i < influence_count; ++i) {
    const bool used = i < blend_count && piece < 0;
    const std::size_t from = at(vertex) * blend_count + i;
    weights[i] = used ? p.clusters.weight[from] : 0.0f;
    joints[i] = used && weights[i] > 0 ? static_cast<std::uint32_t>(p.clusters.joint[from]) : 0u;
  }
  if (piece < 0) return;
  weights[0] = 1;
  joints[0] = static_cast<std::uint32_t>(p.clusters.count + piece);
}

}  // namespace hf_inner::transfer
