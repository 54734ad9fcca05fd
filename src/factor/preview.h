// A single-precision copy of a factor, half its size, for previews while the user drags a value. Sweeps take half the
// time and have relative errors of about 1e-6. Paths, Gram matrices and the dense solve stay double.
//
// Refinement removes the error: it computes a residual in double, then a forward and a backward sweep in single
// precision. Each step multiplies the error by about 1e-6 (solve/green_preview.cpp). One step costs more than a double
// sweep, so a preview is refined after a drag, not during it.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "factor/factor.h"

namespace hf_inner::factor {

struct Analysis;
struct Kernels;

class PreviewFactor {
 public:
  // Copies the numbers of `factor` and shares its lists. Cost: one read of the numbers, and a write of half their size.
  static std::shared_ptr<const PreviewFactor> make(const Factor& factor, Memory& memory, JobRunner& jobs);

  PreviewFactor(std::shared_ptr<const Analysis> analysis, const Kernels& kernels, const Buffer<double>& values,
                Memory& memory, JobRunner& jobs);

  // The two sweeps compute z <- G^-1 z and z <- G^-T z in place on z[row * channels + channel], rows in factor order.
  void forward(float* z, std::int32_t channels, JobRunner& jobs) const;
  void backward(float* z, std::int32_t channels, JobRunner& jobs) const;
  // Forward and backward sweep on double numbers, with the single-precision factor. The numbers are scaled by a power
  // of two before the sweep, so any magnitude works. scratch: room for z.
  void forward(double* z, std::int32_t channels, float* scratch, JobRunner& jobs) const;
  void backward(double* z, std::int32_t channels, float* scratch, JobRunner& jobs) const;

  std::size_t size() const noexcept;
  double bytes() const noexcept { return 4.0 * static_cast<double>(values_.size()); }

 private:
  Memory& memory_;
  std::shared_ptr<const Analysis> analysis_;
  const Kernels* kernels_;
  Buffer<float> values_;
};

}  // namespace hf_inner::factor
