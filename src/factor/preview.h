// Single-precision copy of a factor, half its size, for previews while a value is dragged: a backward sweep in half the
// time with relative errors of about 1e-6. Everything else (paths, Gram, dense solve) stays double; z is filled by
// combine in double and converted, or by the caller. Never refine it with double residuals: that costs more than the
// double sweep.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "factor/factor.h"

namespace hf {

struct Analysis;
struct Kernels;

class PreviewFactor {
 public:
  static std::shared_ptr<const PreviewFactor> make(const Factor& factor, Memory& memory, JobRunner& jobs);

  PreviewFactor(std::shared_ptr<const Analysis> analysis, const Kernels& kernels, const Buffer<double>& values,
                Memory& memory, JobRunner& jobs);

  // z <- G^-T z in place on z[row * channels + channel], rows in factor order.
  void backward(float* z, std::int32_t channels, JobRunner& jobs) const;
  double bytes() const noexcept { return 4.0 * static_cast<double>(values_.size()); }

 private:
  std::shared_ptr<const Analysis> analysis_;
  const Kernels* kernels_;
  Buffer<float> values_;
};

}  // namespace hf
