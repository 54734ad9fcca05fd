// The peer: what a program does that factorises again with CHOLMOD's supernodal Cholesky (and the BLAS it is linked
// with) when sites change. Ordering and symbolic analysis are kept; sites are penalties on the diagonal, so the pattern
// never changes.
#ifndef HF_BENCH_PEER_CHOLMOD_H
#define HF_BENCH_PEER_CHOLMOD_H

#include <memory>

#include "bench/bench_support.h"

namespace bench {

class CholmodPeer {
 public:
  // METIS ordering, as CHOLMOD's users have it. Null in builds without HF_WITH_GPL.
  static std::unique_ptr<CholmodPeer> make(const Mesh& mesh);
  virtual ~CholmodPeer() = default;
  virtual double analyse_ms() const = 0;                              // ordering and symbolic analysis
  virtual void set_sites(const std::vector<uint32_t>& vertices) = 0;  // writes the diagonal; cheap
  virtual double factorise_ms() = 0;                                  // one numeric factorisation
  virtual double solve_ms() = 0;                                      // one cholmod_solve
};

}  // namespace bench

#endif
