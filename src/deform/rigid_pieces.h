// Pieces of a mesh that move rigidly, a sword for example: after the surface is posed, every piece gets the rigid
// motion that fits it best.
//
// The fit minimises sum_v w_v |R p_v + t - x_v|^2 (rotation.h) over the vertices of a piece. x is the posed surface.
// Vertices where links join the piece to others count most, so that it stays where it is held. A piece is whole: it has
// no edge to other vertices, so the step needs no blending. Cost: a few passes over the vertices of the pieces.
// Allocates nothing after it is made.
#pragma once
#include <cstdint>

#include "deform/rest.h"
#include "deform/rotation.h"

namespace hf_inner::deform {

class RigidPieces {
 public:
  // The pieces of these inner vertices, which may name a piece twice. core: with the links. rest: the mesh of the core,
  // perhaps in another pose.
  RigidPieces(const surface::Core& core, Span<const std::int32_t> vertices, const mesh::Mesh& rest, Memory& memory);
  RigidPieces(const surface::Core& core, Span<const std::int32_t> vertices, Memory& memory)
      : RigidPieces(core, vertices, core.mesh, memory) {}
  std::size_t count() const noexcept { return start_.size() - 1; }
  // The piece of a vertex, or -1.
  std::int32_t piece_of(std::int32_t vertex) const noexcept { return piece_[vertex]; }
  Span<const std::int32_t> vertices_of(std::size_t piece) const noexcept {
    return {vertex_.data() + start_[piece], static_cast<std::size_t>(start_[piece + 1] - start_[piece])};
  }
  // Room for the posed vertices of the largest piece.
  std::size_t scratch_size() const noexcept { return largest_; }
  // The mean of a piece at rest.
  Vec3 centroid(std::size_t piece) const noexcept;
  // motions: null, or room for the motion of each piece.
  void make_rigid(Vec3* positions, Vec3* scratch, RigidMotion* motions = nullptr) const noexcept;

 private:
  Vector<std::int32_t> piece_;           // by vertex, -1 outside
  Vector<std::int32_t> start_, vertex_;  // vertices of piece k: vertex_[start_[k] .. start_[k + 1])
  Vector<Vec3> rest_;                    // like vertex_, in the unit and frame of the caller's mesh
  Vector<double> weight_;                // like vertex_
  std::size_t largest_ = 0;
};

}  // namespace hf_inner::deform
