// Smooth crosses that follow the curvature: soft alignment of a direction field of degree 4.
//
//     (K + t M) z = t M w          (Knoeppel, Crane, Pinkall and Schroeder 2013, Section 5)
//
// K is the operator of direction fields (field/direction_system.h), M the vertex areas, w the wished crosses as complex
// numbers of the fourth degree with |w| <= 1. 1 / sqrt(t) is the radius over which crosses are evened out. The first
// solve takes w from the curvature alone. Each later round fills the rest of w with the crosses of the round before,
// at length 1: w = q + (1 - |q|) z / |z|. This is diffusion with normalisation (Viertel and Osting 2019). All rounds
// have the same matrix, so one factor serves them all. Hard crosses are sites on that factor.
#pragma once
#include <complex>

#include "field/direction_system.h"
#include "quads/definite_system.h"

namespace hf_inner {

// Returns the wished crosses by vertex: the principal directions to the fourth degree. The length is 0 to 1: how much
// the two curvatures differ. The curvature tensor is the sum over edges (Cohen-Steiner and Morvan 2003), evened out
// over `passes` rings. connection: of the vertices.
Vector<std::complex<double>> curvature_crosses(const Core& core, const Connection& connection, std::int32_t passes);

struct CrossOptions {
  double radius = 0.05;  // inner units
  // Rounds after the first solve: each takes a solve, and the crosses come nearer to length 1. In 15 runs, 4 and 16
  // give 4 and 5 % fewer irregular vertices, and distances grow by 3 and 10 %.
  std::int32_t rounds = 8;
};

// A cross that does not give way.
struct HardCross {
  std::int32_t vertex;
  std::complex<double> cross;  // to the fourth degree, length 1, in the frame of the vertex
};

// Returns the crosses by inner vertex, to the fourth degree. system: of degree 4. wish: by inner vertex.
Vector<std::complex<double>> smooth_crosses(const DirectionSystem& system, Span<const std::complex<double>> wish,
                                            Span<const HardCross> hard, const CrossOptions& options);

}  // namespace hf_inner
