// What the tests of iso-lines, critical points, distances and extremities share: fields by formula and random ones, and
// shapes of genus 0 to 5.
#pragma once
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "assets/even_mesh.h"
#include "assets/shapes.h"
#include "support/meshes.h"

namespace hf_test {

inline PlainMesh from_shape(samples::ShapeMesh shape) {
  return {std::move(shape.positions), std::move(shape.triangles)};
}

// One value per inner vertex; the meshes here have every vertex in a triangle and none twice.
inline std::vector<double> field_of(const PlainMesh& mesh,
                                    const std::function<double(double x, double y, double z)>& f) {
  std::vector<double> field(mesh.vertex_count());
  for (std::size_t v = 0; v < field.size(); ++v)
    field[v] = f(mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]);
  return field;
}

inline std::vector<double> random_field(const PlainMesh& mesh, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> field(mesh.vertex_count());
  for (double& u : field) u = static_cast<double>(random() >> 11) * 0x1p-53;
  return field;
}

// A ladder of genus + 1 rungs between two rails, polygonised: closed, of that genus.
inline PlainMesh ladder(int genus, double spacing) {
  samples::ImplicitBody body;
  const auto bar = [&](double x0, double y0, double x1, double y1) {
    body.blobs.push_back(samples::capsule({x0, y0, 0}, {x1, y1, 0}, 0.3, 0.3, 0.1));
  };
  if (genus > 0) {
    bar(0, 0, genus, 0);
    bar(0, 1.5, genus, 1.5);
  }
  for (int rung = 0; rung <= genus; ++rung) bar(rung, 0, rung, 1.5);
  body.finish();
  const samples::TriangleMesh made = samples::polygonise(body, spacing);
  PlainMesh mesh;
  for (const auto& p : made.points) mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
  for (const auto& t : made.triangles) mesh.triangles.insert(mesh.triangles.end(), t.begin(), t.end());
  return mesh;
}

// An open tube of radius 1 along z.
inline PlainMesh tube(std::uint32_t around, std::uint32_t rings, double height) {
  PlainMesh mesh;
  const double two_pi = 8 * std::atan(1.0);
  for (std::uint32_t j = 0; j <= rings; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double a = two_pi * (i + 0.5 * (j % 2)) / around;
      mesh.positions.insert(mesh.positions.end(), {std::cos(a), std::sin(a), height * j / rings});
    }
  }
  for (std::uint32_t j = 0; j < rings; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = j * around + i, b = j * around + (i + 1) % around, c = a + around, d = b + around;
      if (j % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, b, d, c});
      else
        mesh.triangles.insert(mesh.triangles.end(), {a, d, c, a, b, d});
    }
  }
  return mesh;
}

}  // namespace hf_test
