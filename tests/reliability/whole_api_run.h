// The parts of run_whole_api (whole_api.cpp, whole_api_shapes.cpp).
#pragma once
#include <cstring>

#include "support/arrays.h"
#include "whole_api.h"

namespace reliability {

using Numbers = std::vector<double>;

class Run {
 public:
  Run(const Scene& scene, const Options& options) : s(scene), options_(options), n(scene.vertex_count) {
    floats.resize(3 * std::size_t{n});
    doubles.resize(3 * std::size_t{n});
  }
  Outcome outcome;

  void surface_and_picking();
  void edits(hf_surface surface);
  void solver_and_sites();
  void other_kinds();
  void other_engines();
  void vectors();
  void factor_and_preview();
  void analysis();
  void directions();
  void pose_and_transfer();
  void quads_and_flow();
  void regions();
  void graph();
  void skin_weights();
  void carried_weights(hf_surface surface, const Numbers& heads, const std::vector<std::uint32_t>& joints,
                       const std::vector<float>& shares);
  void skeletons();
  void errors();

 private:
  void call(hf_result got, const char* what, hf_result expected = HF_OK) {
    ++outcome.calls;
    if (got == expected || outcome.unexpected++ > 0) return;
    outcome.first = what;
    outcome.got = got;
  }
  template <class T>
  void take(const T* values, std::size_t count) {  // FNV-1a
    const unsigned char* bytes = reinterpret_cast<const unsigned char*>(values);
    for (std::size_t i = 0; i < count * sizeof(T); ++i) outcome.hash = (outcome.hash ^ bytes[i]) * 1099511628211u;
  }
  void take_floats() { take(floats.data(), floats.size()); }
  void take_doubles() { take(doubles.data(), doubles.size()); }
  template <class T>
  static T desc() {
    return HF_INIT(T);
  }
  hf_surface_desc surface_desc() const {
    hf_surface_desc d = desc<hf_surface_desc>();
    d.positions = HF_ARRAY(s.positions.data(), n);
    d.triangles = HF_ARRAY(s.triangles.data(), s.triangle_count);
    d.thread_count = options_.threads;
    if (options_.runner) d.job_runner = *options_.runner;
    if (options_.allocator) d.allocator = *options_.allocator;
    return d;
  }
  hf_surface make(const hf_surface_desc& d) {
    hf_surface surface = nullptr;
    call(hf_surface_create(&d, &surface), "hf_surface_create");
    return surface;
  }
  hf_solver make_solver(hf_surface surface, std::uint32_t channels = 1) {
    hf_solver_desc d = desc<hf_solver_desc>();
    d.channel_count = channels;
    hf_solver solver = nullptr;
    call(hf_create(surface, &d, &solver), "hf_create");
    return solver;
  }
  // Sites at start, start + step, ... with the scene's values from `first` on.
  hf_sites_desc sites_at(std::uint32_t count, std::uint32_t step, std::size_t first = 0, std::uint32_t start = 0) {
    places.clear();
    for (std::uint32_t i = 0; i < count; ++i) places.push_back(start + i * step);
    hf_sites_desc d = desc<hf_sites_desc>();
    d.site_count = count;
    d.vertices = places.data();
    d.values = s.values.data() + first;
    return d;
  }
  void take_field(hf_solver solver) {
    hf_solve_info info = desc<hf_solve_info>();
    call(hf_solver_solve(solver, OUT(doubles.data()), &info), "hf_solver_solve");
    take_doubles();
    take(&info, 1);
  }

  const Scene& s;
  const Options options_;
  const std::uint32_t n;
  std::vector<float> floats;
  Numbers doubles;
  std::vector<std::uint32_t> places;
};

}  // namespace reliability
