// Bounds the error of a harmonic field by its residual, without a factor.
//
// Let K e = r with e = 0 at the roots, K with weights w >= 0. Send every r_v along a tree of edges to a root: edge t
// carries f_t, the sum of r beyond it. For any such flow
//
//     e'Ke <= F = sum_t f_t^2 / w_t     (Thomson's principle; equality for the flow w (e_i - e_j)),
//     |e_v| <= sqrt(R_v F)              (Cauchy and Schwarz; R_v = sum of 1 / w on the path from v to its root).
//
// More sites, hard or soft, only make e smaller. Rounding of a field leaves a residual that cancels beyond an edge, so
// the bound stays near rounding. An error over many edges leaves a residual that adds up.
#pragma once
#include "base/index.h"
#include "base/span.h"
#include "surface/core.h"

namespace hf_inner::field {

class FlowBound {
 public:
  // k: K, or a matrix with its weights off the diagonal. roots: vertices where e is 0, at least one in every component
  // that is asked about. Cost: a pass over the edges.
  FlowBound(const surface::Core& core, const SymmetricMatrix& k, Span<const Index> roots);

  // The bound of every component and channel; r: vertex * channels + c, overwritten with the flows. Where r has a part
  // that no root is reached from, the bound is infinite.
  Vector<double> bound(double* r, std::size_t channels) const;

 private:
  const surface::Core& core_;
  Vector<Index> order_, parent_;  // reached vertices, parents first; by vertex, -1: a root, -2: not reached
  Vector<double> resistance_;     // by vertex, of its edge to the parent
  Vector<double> path_;           // by component, the largest R_v
};

}  // namespace hf_inner::field
