// Strokes of stiffness: patches of vertices, and surfaces on which they are stiff.
#ifndef HF_BENCH_STROKES_H
#define HF_BENCH_STROKES_H

#include <vector>

#include "bench/bench_support.h"

namespace bench {

std::vector<std::vector<uint32_t>> neighbours_of(const Mesh& mesh);
// The first `count` vertices around one, ring by ring.
std::vector<uint32_t> patch(const std::vector<std::vector<uint32_t>>& neighbours, uint32_t centre, uint32_t count);
// A new surface with this stiffness at these vertices.
hf_surface stiffened(hf_surface surface, const std::vector<uint32_t>& vertices, double stiffness);

}  // namespace bench

#endif
