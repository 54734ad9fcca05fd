#include <cmath>

#include "whole_api.h"

namespace reliability {

Scene make_scene(std::uint32_t around, std::uint32_t rings) {
  Scene s;
  s.around = around;
  s.rings = rings;
  s.vertex_count = around * rings;
  s.triangle_count = 2 * around * (rings - 1);
  for (std::uint32_t v = 0; v < s.vertex_count; ++v) {
    const double ring = v / around, turn = 6.283185307179586 * (v % around) / around;
    const double bump = 1 + 0.1 * std::sin(1.7 * ring) + 0.03 * std::sin(5.1 * v);
    for (const double p : {bump * std::cos(turn), 0.4 * ring, bump * std::sin(turn)}) {
      s.positions_f64.push_back(p);
      s.positions.push_back(static_cast<float>(p));
      s.posed.push_back(static_cast<float>(p + 0.02 * ring * ring));
    }
    s.values.push_back(std::sin(0.9 * v));
    s.height.push_back(0.4 * ring + 0.01 * std::sin(2.3 * v));
    for (int c = 0; c < 3; ++c) s.vectors.push_back(std::cos(1.1 * v + c));
    s.angles.push_back(std::sin(0.3 * v) * 3);
    s.radii.push_back(v % 3 == 0 ? 0.6 : 0);
    s.stiffness.push_back(v % 4 == 0 ? 0 : 50.0 * (v % 7 + 1));
  }
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = r * around + i, b = r * around + (i + 1) % around, c = a + around, d = b + around;
      s.triangles.insert(s.triangles.end(), {a, c, b, b, c, d});
    }
  }
  for (std::uint32_t i = 0; i < 2 * around; ++i) s.ends.push_back(i);
  for (std::uint32_t i = 0; i < 2 * around; ++i) s.ends.push_back((rings - 2) * around + i);
  for (int i = 1; i < 8; ++i) s.levels.push_back(0.9 * i);
  s.barycentrics = {0.25, 0.25, 0.5, 0.5, 0.25, 0.25};
  for (const std::size_t v : {std::size_t{0}, std::size_t{s.vertex_count - 1}})
    s.points.insert(s.points.end(), s.positions_f64.begin() + static_cast<std::ptrdiff_t>(3 * v),
                    s.positions_f64.begin() + static_cast<std::ptrdiff_t>(3 * v + 3));
  s.ray = {4, 0.4 * (rings / 2) + 0.1, 0.05, -1, 0, 0};
  s.matrices = {0.8, 0.6, 0, 0, -0.6, 0.8, 0, 0, 0, 0, 1, 0, 0.5, 0.25, -0.125, 1};
  return s;
}

}  // namespace reliability
