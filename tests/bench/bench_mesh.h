// The meshes of the benchmarks: two generated families at any size (a jittered torus; the horse of samples/assets,
// whose limbs make smaller factors) and, where the shared data folder is present, real scans. Made once per process.
#ifndef HF_BENCH_MESH_H
#define HF_BENCH_MESH_H

#include <memory>

#include "bench/bench_support.h"

namespace bench {

// Sizes named as in Table 1 of the paper. `small` stands for all of them in smoke tests.
enum class Size { k42, k84, k173, k304 };

enum class Family { torus, creature };
constexpr Family families[] = {Family::torus, Family::creature};
const char* family_name(Family family);

// The mesh of a family at one of the paper's sizes; tests run with `small` (a few thousand vertices).
std::shared_ptr<const Mesh> make_mesh(Family family, Size size, bool small);
// The mesh of a family with about this many vertices. Names are "304K_torus": true thousands and family.
std::shared_ptr<const Mesh> make_mesh(Family family, uint32_t vertices);

// A horse as a scanner writes it: marching tetrahedra whose vertices come as near to the grid as 1e-5 of its edges, so
// that a fifth of the triangles are slivers. Within a hundredth of this many vertices. Named "437K_scan".
std::shared_ptr<const Mesh> make_scan(uint32_t vertices);

// The real scans that are there, smallest first: data/meshes of the shared folder next to the checkout, or of the
// folder the environment variable HF_SHARED_DATA names. Empty, with a line on the console, where there is none.
std::vector<std::shared_ptr<const Mesh>> real_meshes();

}  // namespace bench

#endif
