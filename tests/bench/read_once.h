// The floor under every sweep: how long it takes to read the stored factor once.
#ifndef HF_BENCH_READ_ONCE_H
#define HF_BENCH_READ_ONCE_H

#include "base/jobs.h"
#include "base/memory.h"

namespace bench {

// Reads as many bytes as the factor has, from pages like its own, with as many threads. The fastest way found: the
// widest loads of the processor, in one, two or four streams a thread, whichever was fastest at the start.
class Reader {
 public:
  Reader(double bytes, uint32_t threads);
  double ms();  // of one pass

 private:
  double pass(size_t streams);
  hf_inner::Memory memory_;
  hf_inner::JobRunner jobs_;
  hf_inner::Buffer<double> data_;
  hf_inner::Buffer<double> sums_;
  size_t streams_ = 1;
};

// The median of a few passes.
double read_once_ms(double bytes, uint32_t threads);

}  // namespace bench

#endif
