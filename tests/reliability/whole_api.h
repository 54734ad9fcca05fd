// Everything the library does, once: every exported function is called on one small surface, and every number it gives
// back goes into one hash. What a host's state, a thread, a small stack or an unloaded library must not change is then
// one comparison. All numbers that go in are made beforehand (Scene), so the run itself does no arithmetic of its own
// and may be done under any floating-point environment.
#pragma once
#include <cstdint>
#include <vector>

#include "hf/hf.h"

namespace reliability {

struct Scene {
  std::uint32_t around = 0, rings = 0, vertex_count = 0, triangle_count = 0;
  std::vector<float> positions;
  std::vector<double> positions_f64;
  std::vector<std::uint32_t> triangles, ends;  // ends: first and last two rings
  std::vector<double> values, vectors, height, levels, angles, barycentrics, radii, stiffness, points, matrices;
  std::vector<float> posed;  // a posed source for the transfer
};

// A bumpy tube of around x rings vertices.
Scene make_scene(std::uint32_t around = 16, std::uint32_t rings = 20);

struct Options {
  std::uint32_t threads = 1;
  const hf_job_runner* runner = nullptr;
  const hf_allocator* allocator = nullptr;
  bool paper_engine = true;  // also HF_ENGINE_UPDOWN and METIS, in builds that have them
};

struct Outcome {
  std::uint64_t hash = 0;  // of every result
  unsigned calls = 0;
  unsigned unexpected = 0;  // calls that did not answer what they should
  const char* first = "";   // the first of them
  hf_result got = HF_OK;
};

Outcome run_whole_api(const Scene& scene, const Options& options = {});

}  // namespace reliability
