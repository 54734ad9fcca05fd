// Behind the C ABI, for what it cannot show: the grounded matrix a solver factorises, made the way hf_create makes it.
#ifndef HF_BENCH_INNER_FACTOR_H
#define HF_BENCH_INNER_FACTOR_H

#include <memory>

#include "bench/bench_support.h"
#include "bench/peer_cholmod.h"
#include "surface/core.h"

namespace bench {

class InnerSystem {
 public:
  InnerSystem(const Mesh& mesh, uint32_t threads, hf_inner::mesh::FieldKind kind = hf_inner::mesh::FieldKind::harmonic);
  hf_inner::Memory& memory() const { return *memory_; }
  hf_inner::JobRunner& jobs() const { return *jobs_; }
  const hf_inner::SymmetricMatrix& matrix() const { return matrix_; }
  hf_inner::factor::Coordinates coordinates() const { return {coordinates_.data(), coordinates_.size()}; }
  // The operator without its grounds, in the core's own vertex numbers.
  const hf_inner::surface::Core& core() const { return *core_; }
  // The same matrix as the peer takes it.
  PeerMatrix peer_matrix() const;

 private:
  std::shared_ptr<hf_inner::Memory> memory_;
  std::shared_ptr<hf_inner::JobRunner> jobs_;
  std::shared_ptr<const hf_inner::surface::Core> core_;
  hf_inner::SymmetricMatrix matrix_;
  hf_inner::Vector<float> coordinates_;
};

}  // namespace bench

#endif
