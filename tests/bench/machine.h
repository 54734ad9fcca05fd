// The machine a figure was taken on, and the versions of what it was measured against.
#ifndef HF_BENCH_MACHINE_H
#define HF_BENCH_MACHINE_H

#include <string>
#include <utility>
#include <vector>

namespace bench {

// "processor, N cores".
std::string machine_name();
// Processor, cores, caches, memory, system, compiler, kernels in use, SuiteSparse, METIS's user, BLAS: name and value.
std::vector<std::pair<std::string, std::string>> machine_facts();

}  // namespace bench

#endif
