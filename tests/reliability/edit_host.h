// The meshes of the player of edits, and how a host edits them.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hf/base.h"

namespace edits {

constexpr std::uint32_t none = HF_NO_INDEX;

// The mesh of a host, which it edits along with the surface. A triangle that went has no corners.
struct Host {
  std::vector<double> positions, stiffness;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 3>> gone;  // corners of triangles that went, to come again

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size() / 3); }
  bool there(std::uint32_t t) const { return triangles[t][0] != none; }
  std::vector<std::uint32_t> alive() const {
    std::vector<std::uint32_t> out;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      if (there(t)) out.push_back(t);
    return out;
  }
  std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> out;
    for (const auto& t : triangles) {
      if (std::find(t.begin(), t.end(), v) == t.end() || t[0] == none) continue;
      for (const std::uint32_t u : t)
        if (u != v) out.push_back(u);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
};

// A grid that is closed both ways (a torus), one way (a tube) or not at all (a sheet), slightly irregular.
inline void put_grid(Host& host, std::uint32_t columns, std::uint32_t rows, int closed, double x0) {
  constexpr double turn = 6.283185307179586;
  const std::uint32_t first = host.vertex_count();
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double u = i + 0.2 * std::sin(3.1 * i + 1.7 * j), v = j + 0.2 * std::cos(2.3 * i + 2.9 * j);
      const double a = turn * u / columns, b = turn * v / rows;
      if (closed == 2)
        host.positions.insert(host.positions.end(),
                              {x0 + (2 + std::cos(b)) * std::cos(a), (2 + std::cos(b)) * std::sin(a), std::sin(b)});
      if (closed == 1) host.positions.insert(host.positions.end(), {x0 + std::cos(a), std::sin(a), 0.6 * v});
      if (closed == 0) host.positions.insert(host.positions.end(), {x0 + u, v, 0.3 * std::sin(u)});
    }
  }
  for (std::uint32_t j = 0; j + (closed < 2 ? 1 : 0) < rows; ++j) {
    for (std::uint32_t i = 0; i + (closed < 1 ? 1 : 0) < columns; ++i) {
      const std::uint32_t i2 = (i + 1) % columns, j2 = (j + 1) % rows;
      const std::uint32_t a = first + j * columns + i, b = first + j * columns + i2, c = first + j2 * columns + i,
                          d = first + j2 * columns + i2;
      host.triangles.push_back({a, b, d});
      host.triangles.push_back({a, d, c});
    }
  }
}

inline Host host_of(unsigned kind) {
  Host host;
  switch (kind % 4) {
    case 0:
      put_grid(host, 9, 7, 1, 0);
      break;
    case 1:
      put_grid(host, 9, 6, 2, 0);
      break;
    case 2:
      put_grid(host, 8, 7, 0, 0);
      break;
    default:
      put_grid(host, 7, 5, 1, 0);
      put_grid(host, 5, 5, 0, 1.5);
      put_grid(host, 3, 3, 0, 9);
  }
  host.stiffness.assign(host.vertex_count(), 1.0);
  return host;
}

}  // namespace edits
