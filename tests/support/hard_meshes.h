// Surfaces that are hard on a solver: handles, dirt, strips, points that all lie in one place.
#pragma once
#include <functional>
#include <map>

#include "support/meshes.h"

namespace hf_test {

// The boundary of a solid of unit cubes, its quads split, its vertices moved by up to `jitter`. Cubes must meet in
// faces.
inline PlainMesh voxel_surface(int nx, int ny, int nz, const std::function<bool(int, int, int)>& solid,
                               double jitter = 0.2, std::uint32_t seed = 1) {
  PlainMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> number;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-jitter, jitter);
  const auto inside = [&](int x, int y, int z) {
    return x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz && solid(x, y, z);
  };
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [it, fresh] = number.try_emplace(p, mesh.vertex_count());
    if (fresh) {
      for (const int c : p) mesh.positions.push_back(c + offset(random));
    }
    return it->second;
  };
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        if (!inside(x, y, z)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (int side = 0; side < 2; ++side) {
            std::array<int, 3> step = {0, 0, 0};
            step[static_cast<std::size_t>(axis)] = side ? 1 : -1;
            if (inside(x + step[0], y + step[1], z + step[2])) continue;
            std::uint32_t corner[4];
            for (int k = 0; k < 4; ++k) {
              std::array<int, 3> p = {x, y, z};
              const int u = (axis + 1) % 3, v = (axis + 2) % 3;
              p[static_cast<std::size_t>(axis)] += side;
              p[static_cast<std::size_t>(u)] += (k == 1 || k == 2) ? 1 : 0;
              p[static_cast<std::size_t>(v)] += k >= 2 ? 1 : 0;
              corner[k] = vertex(p);
            }
            if (!side) std::swap(corner[1], corner[3]);
            mesh.triangles.insert(mesh.triangles.end(),
                                  {corner[0], corner[1], corner[2], corner[0], corner[2], corner[3]});
          }
        }
      }
    }
  }
  return mesh;
}

// A slab with `holes` square holes through it: genus = holes.
inline PlainMesh slab_with_holes(int holes, int width = 1) {
  const int step = 2 * width;
  return voxel_surface(step * holes + width, 3 * width, width,
                       [=](int x, int y, int) { return !(y / width == 1 && x / width % 2 == 1); });
}

// Everything that real assets have wrong: a sheet cut along a seam (stored copies), three sheets on one edge line,
// islands, triangles without area, duplicate and flipped triangles, vertices in no triangle.
inline PlainMesh dirty(std::uint32_t n = 6) {
  PlainMesh mesh = grid(n, n, 1, 0.25);
  const std::uint32_t row = n + 1;
  // a second sheet that shares the line y = n by stored copies at the same places
  PlainMesh other = grid(n, n, 1, 0.25, 2);
  for (std::uint32_t v = 0; v < other.vertex_count(); ++v)
    other.positions[3 * v + 1] = 2 * n - other.positions[3 * v + 1];
  for (std::size_t t = 0; t < other.triangles.size(); t += 3) std::swap(other.triangles[t], other.triangles[t + 1]);
  append(mesh, other, 0);
  // a third one stands on the middle line of the first: edges of four triangles
  const std::uint32_t base = mesh.vertex_count();
  for (std::uint32_t h = 1; h <= 3; ++h) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const std::size_t foot = 3 * (std::size_t{n / 2} * row + i);
      const double x = mesh.positions[foot], y = mesh.positions[foot + 1];
      mesh.positions.insert(mesh.positions.end(), {x, y, static_cast<double>(h)});
    }
  }
  const auto wall = [&](std::uint32_t h, std::uint32_t i) {
    return h == 0 ? (n / 2) * row + i : base + (h - 1) * row + i;
  };
  for (std::uint32_t h = 0; h < 3; ++h) {
    for (std::uint32_t i = 0; i < n; ++i) {
      mesh.triangles.insert(mesh.triangles.end(), {wall(h, i), wall(h, i + 1), wall(h + 1, i + 1), wall(h, i),
                                                   wall(h + 1, i + 1), wall(h + 1, i)});
    }
  }
  // a flipped and a duplicate triangle, one of equal corners, one without area
  mesh.triangles.insert(mesh.triangles.end(), {mesh.triangles[1], mesh.triangles[0], mesh.triangles[2]});
  mesh.triangles.insert(mesh.triangles.end(), {mesh.triangles[3], mesh.triangles[4], mesh.triangles[5]});
  mesh.triangles.insert(mesh.triangles.end(), {4, 4, 5});
  mesh.triangles.insert(mesh.triangles.end(), {0, 1, 2});
  // islands, and vertices in no triangle
  append(mesh, grid(2, 2, 0.1), 20);
  append(mesh, slab_with_holes(1), 40);
  for (int i = 0; i < 3; ++i) mesh.positions.insert(mesh.positions.end(), {60.0 + i, 0.0, 0.0});
  return mesh;
}

}  // namespace hf_test
