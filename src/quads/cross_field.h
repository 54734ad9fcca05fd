// Smooth crosses that follow the curvature: soft alignment of a direction field of degree 4.
//
//     (K + t M) z = t M w          (Knoeppel, Crane, Pinkall and Schroeder 2013, Section 5)
//
// K is the operator of direction fields (field/direction_system.h), and M holds the vertex areas. The wished crosses w
// are complex numbers of the fourth degree with |w| <= 1. The number 1 / sqrt(t) is the radius over which crosses are
// evened out. The first solve takes w from the curvature alone. Each later round fills the rest of w with the crosses
// of the round before, at length 1: w = q + (1 - |q|) z / |z|. This is diffusion with normalisation (Viertel and Osting
// 2019). All rounds have the same matrix, so one factor serves them all. Hard crosses are sites on that factor.
#pragma once
#include <complex>

#include "field/direction_system.h"
#include "quads/definite_system.h"

namespace hf_inner::quads {

// Returns the wished crosses by vertex: the principal directions to the fourth degree. The length is 0 to 1: how much
// the two curvatures differ. The curvature tensor is the sum over edges (Cohen-Steiner and Morvan 2003), evened out
// over `passes` rings. connection: of the vertices.
Vector<std::complex<double>> curvature_crosses(const surface::Core& core, const field::Connection& connection,
                                               std::int32_t passes);

// A cross that does not give way.
struct HardCross {
  std::int32_t vertex;
  std::complex<double> cross;  // to the fourth degree, length 1, in the frame of the vertex
};

// The cross that a neighbour sees on its own side of a crease is the hard cross plus this change (side_crosses.h).
struct SeenCross {
  std::int32_t vertex, neighbour;
  std::complex<double> change;
};

// The factor of K + t M for one radius.
class CrossSmoother {
 public:
  // system: of degree 4; it must outlive *this. radius: inner units. Throws what Factor::make throws.
  CrossSmoother(const field::DirectionMatrix& system, double radius);
  double radius() const noexcept { return radius_; }
  // Returns the crosses by inner vertex, to the fourth degree. wish: by inner vertex.
  Vector<std::complex<double>> smooth(Span<const std::complex<double>> wish, Span<const HardCross> hard,
                                      Span<const SeenCross> seen = {});

 private:
  const field::DirectionMatrix& system_;
  double radius_;
  SymmetricMatrix matrix_;
  std::optional<DefiniteSystem> solver_;
};

}  // namespace hf_inner::quads
