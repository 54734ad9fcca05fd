// Single-precision copy of a factor, half its size, for previews while a value is dragged: sweeps in half the time with
// relative errors of about 1e-6. Paths, Gram matrices and the dense solve stay double.
//
// Refinement removes the error: a residual in double, then a forward and a backward sweep in single precision. Each
// step shrinks the error by about 1e-6 (engine/green_preview.cpp). One step costs more than a double sweep, so a
// preview is refined after a drag, not during it.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "factor/factor.h"

namespace hf_inner {

struct Analysis;
struct Kernels;

class PreviewFactor {
 public:
  // Shares the lists of `factor`, not its numbers. Cost: one read of it and half a write.
  static std::shared_ptr<const PreviewFactor> make(const Factor& factor, Memory& memory, JobRunner& jobs);

  PreviewFactor(std::shared_ptr<const Analysis> analysis, const Kernels& kernels, const Buffer<double>& values,
                Memory& memory, JobRunner& jobs);

  // z <- G^-1 z and z <- G^-T z in place on z[row * channels + channel], rows in factor order.
  void forward(float* z, std::int32_t channels, JobRunner& jobs) const;
  void backward(float* z, std::int32_t channels, JobRunner& jobs) const;
  // The same on double numbers, scaled by a power of two so that any magnitude is taken. scratch: room for z.
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

}  // namespace hf_inner
