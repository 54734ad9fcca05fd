// A solver for a flat mesh, as the programs make it: welded within 1e-5 of the largest extent, because exporters round
// copies of a vertex differently now and then.
#ifndef HF_SAMPLES_TRANSFER_SURFACE_SOLVER_H
#define HF_SAMPLES_TRANSFER_SURFACE_SOLVER_H

#include <string>

#include "common/flat_mesh.h"
#include "hf/hf.h"

namespace samples {

// Throws std::runtime_error "what: the library's own sentence" unless the result is HF_OK.
void check(hf_result result, const std::string& what);

class SurfaceSolver {
 public:
  // paper: plain cotangents, as the paper has them, instead of the library's default operator.
  SurfaceSolver(const FlatMesh& mesh, const std::string& name, uint32_t threads, bool paper = false);
  ~SurfaceSolver() { hf_solver_destroy(solver_); }
  SurfaceSolver(const SurfaceSolver&) = delete;
  SurfaceSolver& operator=(const SurfaceSolver&) = delete;
  hf_solver get() const { return solver_; }

 private:
  hf_solver solver_ = nullptr;
};

}  // namespace samples

#endif
