// Small meshes for tests, made on the spot.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "surface/core.h"

namespace hf_test {

struct PlainMesh {
  std::vector<double> positions;  // xyz
  std::vector<std::uint32_t> triangles;
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size() / 3); }
  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(triangles.size() / 3); }
};

// (nx + 1) x (ny + 1) vertices on [0, nx * h] x [0, ny * h], jittered inside by `jitter` spacings.
inline PlainMesh grid(std::uint32_t nx, std::uint32_t ny, double h = 1, double jitter = 0, std::uint32_t seed = 1) {
  PlainMesh mesh;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-jitter, jitter);
  for (std::uint32_t j = 0; j <= ny; ++j) {
    for (std::uint32_t i = 0; i <= nx; ++i) {
      const bool inside = i > 0 && j > 0 && i < nx && j < ny;
      const double dx = offset(random), dy = offset(random);
      mesh.positions.insert(mesh.positions.end(), {h * (i + (inside ? dx : 0)), h * (j + (inside ? dy : 0)), 0.0});
    }
  }
  for (std::uint32_t j = 0; j < ny; ++j) {
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      if ((i + j) % 2) {
        mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, b, d, c});
      }
    }
  }
  return mesh;
}

// Torus of nu x nv vertices, jittered along the surface.
inline PlainMesh torus(std::uint32_t nu, std::uint32_t nv, double jitter = 0.2, std::uint32_t seed = 1) {
  PlainMesh mesh;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-jitter, jitter);
  const double two_pi = 8 * std::atan(1.0);
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      const double u = two_pi * (i + offset(random)) / nu, v = two_pi * (j + offset(random)) / nv;
      mesh.positions.insert(mesh.positions.end(),
                            {(2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)});
    }
  }
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      const std::uint32_t a = i * nv + j, b = ((i + 1) % nu) * nv + j, c = ((i + 1) % nu) * nv + (j + 1) % nv,
                          d = i * nv + (j + 1) % nv;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    }
  }
  return mesh;
}

// Appends `other` moved by dx.
inline void append(PlainMesh& mesh, const PlainMesh& other, double dx) {
  const std::uint32_t base = mesh.vertex_count();
  for (std::size_t i = 0; i < other.positions.size(); ++i)
    mesh.positions.push_back(other.positions[i] + (i % 3 == 0 ? dx : 0.0));
  for (const std::uint32_t v : other.triangles) mesh.triangles.push_back(base + v);
}

inline std::shared_ptr<const hf_inner::surface::Core> make_core(
    const PlainMesh& mesh, std::uint32_t threads = 1, hf_inner::surface::CoreOptions options = {},
    std::shared_ptr<hf_inner::Memory> memory = std::make_shared<hf_inner::Memory>()) {
  hf_inner::mesh::MeshInput input;
  input.vertex_count = mesh.vertex_count();
  input.triangle_count = mesh.triangle_count();
  input.positions = hf_inner::ConstRows(mesh.positions.data(), 3 * sizeof(double));
  input.triangles = hf_inner::IndexRows(mesh.triangles.data(), 3);
  return hf_inner::surface::Core::make(input, options, std::move(memory),
                                       std::make_shared<hf_inner::JobRunner>(threads));
}

}  // namespace hf_test
