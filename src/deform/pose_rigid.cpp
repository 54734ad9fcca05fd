// Rigid pieces (rigid_pieces.h) in poses and their layers: a handle on a piece moves the whole piece.
#include "base/error.h"
#include "deform/pose_layout.h"
#include "deform/pose_stack.h"

namespace hf_inner::deform {

void Pose::set_rigid(std::shared_ptr<const RigidPieces> rigid) {
  Buffer<Vec3> scratch(memory(), rigid ? rigid->scratch_size() : 0);
  rigid_scratch_ = std::move(scratch);
  rigid_ = std::move(rigid);
}

void Pose::make_rigid() const noexcept {
  if (rigid_) rigid_->make_rigid(positions_.data(), rigid_scratch_.data());
}

void PoseStack::set_rigid_pieces(Span<const std::int32_t> vertices) {
  std::shared_ptr<const RigidPieces> rigid;
  if (!vertices.empty()) rigid = make_shared_in<RigidPieces>(memory(), *core_, vertices, memory());
  if (rigid) check_rigid(*rigid, vertices);
  Buffer<Vec3> scratch(memory(), rigid ? rigid->scratch_size() : 0);
  base_->set_rigid(rigid);
  rigid_scratch_ = std::move(scratch);
  rigid_ = std::move(rigid);
  mark_stale(0);
}

// Refuses pieces of which a handle has a part.
void PoseStack::check_rigid(const RigidPieces& rigid, Span<const std::int32_t> vertices) const {
  Vector<std::size_t> inside(rigid.count(), std::size_t{0}, &memory());
  for (const Entry& entry : entries_) {
    const Span<const std::int32_t> region = region_of(entry);
    for (const std::int32_t v : region) {
      if (const std::int32_t p = rigid.piece_of(v); p >= 0) ++inside[p];
    }
    for (std::uint32_t k = 0; k < vertices.size(); ++k) {
      const std::size_t p = static_cast<std::size_t>(rigid.piece_of(vertices[k])), part = inside[p];
      if (part > 0 && part < rigid.vertices_of(p).size())
        fail(HF_ERROR_CONFLICT, k,
             "entry %u is on a piece that handle %u has a part of; remove the handle, and add it again after this call",
             k, entry.number);
    }
  }
}

// A region that touches a rigid piece gets all of the piece. Two handles on one piece are refused: a
// handle on a piece has all vertices of the piece, so check_regions finds the second one.
void PoseStack::take_whole_pieces(Span<const std::uint32_t> start, Span<const std::int32_t> vertices,
                                  Vector<std::uint32_t>& whole_start, Vector<std::int32_t>& whole) const {
  base_->check_regions(start, vertices);
  for (const auto& layer : layers_) {
    if (layer) layer->plain->check_regions(start, vertices);
  }
  constexpr std::int32_t nobody = -1;
  Vector<std::int32_t> owner(rigid_->count(), nobody, &memory());
  whole_start.assign(1, 0u);
  for (std::size_t r = 0; r + 1 < start.size(); ++r) {
    for (std::uint32_t k = start[r]; k < start[r + 1]; ++k) {
      const std::int32_t p = rigid_->piece_of(vertices[k]), own = static_cast<std::int32_t>(r);
      if (p < 0) {
        whole.push_back(vertices[k]);
      } else if (owner[p] == nobody) {
        owner[p] = own;
        const Span<const std::int32_t> piece = rigid_->vertices_of(static_cast<std::size_t>(p));
        whole.insert(whole.end(), piece.begin(), piece.end());
      } else if (owner[p] != own) {
        fail(HF_ERROR_CONFLICT, k, "entry %u is on a rigid piece that an earlier region has taken; leave the entry out",
             k);
      }
    }
    whole_start.push_back(static_cast<std::uint32_t>(whole.size()));
  }
}

}  // namespace hf_inner::deform
