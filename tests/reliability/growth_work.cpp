// The work of a factor, known before it begins: sound surfaces against size, and a soup that the default limit refuses.
#include <cmath>
#include <cstdio>
#include <random>

#include "growth.h"
#include "hf/hf.h"

namespace growth {
namespace {

constexpr double default_work_limit_gflop = 100000, most_vertices = 2e7;  // hf/surface.h

hf_result create(const std::vector<float>& positions, const std::vector<std::uint32_t>& triangles,
                 hf_surface& surface) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions.data(), positions.size() / 3);
  desc.triangles = HF_ARRAY(triangles.data(), triangles.size() / 3);
  return hf_surface_create(&desc, &surface);
}

// Operations of the factor of a torus with about so many vertices; 0: refused.
double torus_flops(std::size_t vertices) {
  const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(vertices) / 2)), around = 2 * side;
  std::vector<float> positions;
  std::vector<std::uint32_t> triangles;
  const double turn = 6.283185307179586;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < side; ++k) {
      const double a = turn * i / around, b = turn * k / side, r = 2 + std::cos(b);
      for (const double x : {r * std::cos(a), r * std::sin(a), std::sin(b)}) positions.push_back(static_cast<float>(x));
      const std::uint32_t next = (i + 1) % around * side, up = (k + 1) % side, own = i * side;
      triangles.insert(triangles.end(), {own + k, next + k, own + up, own + up, next + k, next + up});
    }
  }
  hf_surface surface = nullptr;
  if (create(positions, triangles, surface) != HF_OK) return 0;
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  hf_surface_get_statistics(surface, &statistics);
  hf_surface_destroy(surface);
  return statistics.factor_flops;
}

}  // namespace

TorusWork torus_work(const std::vector<std::size_t>& sizes) {
  TorusWork work;
  for (const std::size_t n : sizes) work.flops.push_back(torus_flops(n));
  work.slope = slope(sizes, work.flops);
  work.limit_gflop = default_work_limit_gflop;
  work.largest_gflop =
      1e-9 * work.flops.back() * std::pow(most_vertices / static_cast<double>(sizes.back()), work.slope);
  return work;
}

DefaultRefusal default_refusal(std::uint32_t vertices) {
  std::mt19937 random(1);
  std::vector<float> positions(3 * std::size_t{vertices});
  std::vector<std::uint32_t> triangles(18 * std::size_t{vertices});
  for (float& x : positions) x = static_cast<float>(random() % 100000);
  for (std::uint32_t& corner : triangles) corner = random() % vertices;
  hf_surface surface = nullptr;
  DefaultRefusal found;
  const double begin = thread_seconds();
  const hf_result result = create(positions, triangles, surface);
  found.seconds = thread_seconds() - begin;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  const char* text = "the factorisation takes %lf * 10^9 operations, and the work_limit_gflop is %lf";
  found.refused = result == HF_ERROR_TOO_LARGE && !surface &&
                  std::sscanf(detail.message, text, &found.gflop, &found.limit_gflop) == 2;
  hf_surface_destroy(surface);
  return found;
}

}  // namespace growth
