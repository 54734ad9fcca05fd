// The peer: CHOLMOD with the BLAS it is linked with, used as a program would that has no library like this one.
//
//   recompute   METIS ordering and symbolic analysis once; sites are penalties on the diagonal, so the pattern never
//               changes; supernodal numeric factorisation and cholmod_solve at every change
//   updown      the paper's way, nothing between us and CHOLMOD: a packed simplicial LDL' factor without the relaxation
//               zeros of the supernodal one (cholmod_resymbol), cholmod_updown of the sites, cholmod_solve2 with kept
//               workspace
//
// BLAS gets as many threads as we do, during the peer's calls only.
#ifndef HF_BENCH_PEER_CHOLMOD_H
#define HF_BENCH_PEER_CHOLMOD_H

#include <memory>
#include <utility>

#include "bench/bench_support.h"

namespace bench {

// Lower triangle by columns, the diagonal first in every column.
struct PeerMatrix {
  std::vector<int> start, row;
  std::vector<double> value;
  size_t size() const { return start.size() - 1; }
};
// The plain cotangent Laplacian of a mesh; singular until it gets sites.
PeerMatrix cotangent_matrix(const Mesh& mesh);

class CholmodPeer {
 public:
  // Null in builds without HF_WITH_GPL.
  static std::unique_ptr<CholmodPeer> make(PeerMatrix matrix, uint32_t threads);
  virtual ~CholmodPeer() = default;
  // METIS alone, without symbolic analysis; the permutation goes to `order`.
  virtual double metis_ms(std::vector<int>& order) = 0;
  // CHOLMOD's copy of AMD alone, in the same way.
  virtual double amd_ms(std::vector<int>& order) = 0;
  // Symbolic analysis under a given permutation; replaces the factor.
  virtual double analyse_given_ms(const std::vector<int>& order) = 0;
  // METIS and symbolic analysis; replaces the factor.
  virtual double analyse_ms() = 0;
  // Writes diagonal and right-hand side; cheap, never timed.
  virtual void set_sites(const std::vector<uint32_t>& vertices) = 0;
  // One numeric factorisation with this many threads of BLAS; 0: as many as given to make().
  virtual double factorise_ms(uint32_t blas_threads = 0) = 0;
  // One cholmod_solve, threads as above; and cholmod_solve2 with this many right-hand sides and kept workspace.
  virtual double solve_ms(uint32_t blas_threads = 0) = 0;
  virtual double solve_kept_ms(uint32_t columns) = 0;

  // Turns a copy of the present numeric factor into the updatable one, with its sites.
  virtual void begin_updown(const std::vector<uint32_t>& sites) = 0;
  virtual double updown_ms(const std::vector<uint32_t>& insert, const std::vector<uint32_t>& remove) = 0;
  virtual double updown_solve_ms() = 0;
  // What the last solve_kept_ms or updown_solve_ms of one column left.
  virtual const double* solution() const = 0;
};

// Starts the program again with OPENBLAS_CORETYPE set when OpenBLAS does not know the processor and would run its
// oldest kernels on it (0.3.21 takes an Emerald Rapids for a Prescott and is four to five times slower for it): the
// peer gets the kernels its BLAS has for these vector units. Nothing when the variable is set already. Call first in
// main().
void give_peer_fitting_blas(char** argv);

// Versions of CHOLMOD and of the BLAS, name and value; says so when there is no peer.
std::vector<std::pair<std::string, std::string>> peer_versions();

}  // namespace bench

#endif
