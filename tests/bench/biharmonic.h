// How much one more refinement would change a bi-harmonic field.
#ifndef HF_BENCH_BIHARMONIC_H
#define HF_BENCH_BIHARMONIC_H

#include "bench/bench_support.h"

namespace bench {

struct BiharmonicResult {
  double change = 0;    // largest change of the field by a further refinement, over the range of the site values
  double residual = 0;  // largest |(K u)_v| off the sites, over the mean diagonal
  double create_ms = 0, solve_ms = 0;
};

// The field of the library (refined once, as it always is) under 100 vertex sites, then one step of refinement of our
// own: r_v = -sum_j K_vj (u_j - u_v) off the sites, K du = r with the sites eliminated from a factor made for it. The
// step is independent of how the library solved; its size is what is left of the library's error.
BiharmonicResult biharmonic_refinement(const Mesh& mesh, uint32_t threads);

}  // namespace bench

#endif
