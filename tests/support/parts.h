// Parts of characters for tests of links: boxes, balls, tubes.
#pragma once
#include <array>
#include <cmath>
#include <functional>

#include "support/dirty_meshes.h"

namespace hf_test {

// A closed box of n x n squares a side, its lower corner at `low`.
inline PlainMesh box(std::uint32_t n, std::array<double, 3> size, std::array<double, 3> low) {
  PlainMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const PlainMesh face = grid(n, n, 1.0 / n);
      const std::uint32_t base = mesh.vertex_count();
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (std::uint32_t i = 0; i < face.vertex_count(); ++i) {
        double p[3];
        p[axis] = side;
        p[u] = face.positions[3 * std::size_t{i}];
        p[v] = face.positions[3 * std::size_t{i} + 1];
        // Rounded to a coarse lattice, so that copies on edges weld.
        for (std::size_t k = 0; k < 3; ++k) mesh.positions.push_back(low[k] + size[k] * std::round(p[k] * 1024) / 1024);
      }
      for (std::size_t c = 0; c < face.triangles.size(); c += 3) {
        const std::uint32_t a = base + face.triangles[c], b = base + face.triangles[c + 1],
                            d = base + face.triangles[c + 2];
        if (side) {
          mesh.triangles.insert(mesh.triangles.end(), {a, b, d});
        } else {
          mesh.triangles.insert(mesh.triangles.end(), {a, d, b});
        }
      }
    }
  }
  return mesh;
}

// A ball of 8 cuts^2 triangles.
inline PlainMesh ball(std::uint32_t cuts, double radius, std::array<double, 3> middle) {
  PlainMesh mesh = sphere(cuts);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] = middle[i % 3] + radius * mesh.positions[i];
  return mesh;
}

// A tube along x from `first` to `last`, about the line (y, z). radius: by the share of the way. closed: its ends are.
inline PlainMesh tube(std::uint32_t along, std::uint32_t around, double first, double last, double y, double z,
                      const std::function<double(double)>& radius, bool closed) {
  PlainMesh mesh;
  const double two_pi = 8 * std::atan(1.0);
  for (std::uint32_t i = 0; i <= along; ++i) {
    const double share = double(i) / along, r = radius(share);
    for (std::uint32_t j = 0; j < around; ++j) {
      const double angle = two_pi * j / around;
      mesh.positions.insert(mesh.positions.end(),
                            {first + share * (last - first), y + r * std::cos(angle), z + r * std::sin(angle)});
    }
  }
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t a = i * around + j, b = i * around + (j + 1) % around, c = a + around, d = b + around;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
    }
  }
  for (std::uint32_t side = 0; side < 2 && closed; ++side) {
    const std::uint32_t middle = mesh.vertex_count(), ring = side * along * around;
    mesh.positions.insert(mesh.positions.end(), {side ? last : first, y, z});
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t a = ring + j, b = ring + (j + 1) % around;
      if (side) {
        mesh.triangles.insert(mesh.triangles.end(), {a, b, middle});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {b, a, middle});
      }
    }
  }
  return mesh;
}

}  // namespace hf_test
