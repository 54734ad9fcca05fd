// Calls every exported function on one small surface and hashes every result. The tests of the host, of threads, of
// small stacks and of unloading compare this hash. The Scene holds all input numbers. So the run does no arithmetic of
// its own and works under any floating-point environment.
#pragma once
#include <cstdint>
#include <vector>

#include "hf/hf.h"
#include "support/peers.h"

namespace reliability {

struct Scene {
  std::uint32_t around = 0, rings = 0, vertex_count = 0, triangle_count = 0;
  std::vector<float> positions;
  std::vector<double> positions_f64;
  std::vector<std::uint32_t> triangles, ends;  // the first two and the last two rings
  std::vector<double> values, vectors, height, levels, angles, barycentrics, radii, stiffness, points, matrices;
  std::vector<double> ray;   // origin and direction of a ray that hits the tube
  std::vector<float> posed;  // the posed source of the transfer
};

// A bumpy tube of around x rings vertices.
Scene make_scene(std::uint32_t around = 16, std::uint32_t rings = 20);

struct Options {
  std::uint32_t threads = 1;
  const hf_job_runner* runner = nullptr;
  const hf_allocator* allocator = nullptr;
  bool paper_engine = true;  // also ENGINE_UPDOWN and METIS, in builds that have them
};

struct Outcome {
  std::uint64_t hash = 0;  // FNV-1a of every result
  unsigned calls = 0;
  unsigned unexpected = 0;  // calls with another result than expected
  const char* first = "";   // the first of them
  hf_result got = HF_OK;
};

Outcome run_whole_api(const Scene& scene, const Options& options = {});

}  // namespace reliability
