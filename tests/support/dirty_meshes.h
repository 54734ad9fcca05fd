// Surfaces that plain cotangents do badly on: obtuse, open, non-manifold, flipped, doubled and thin triangles.
#pragma once
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "support/meshes.h"

namespace hf_test {

// Rings of 6, 12, 18 ... vertices on the unit disc.
inline PlainMesh disk(std::uint32_t rings) {
  PlainMesh mesh;
  const double two_pi = 8 * std::atan(1.0);
  mesh.positions = {0, 0, 0};
  const auto vertex = [](std::uint32_t ring, std::uint32_t i) {
    return ring == 0 ? 0u : 1 + 3 * ring * (ring - 1) + i % (6 * ring);
  };
  for (std::uint32_t r = 1; r <= rings; ++r) {
    for (std::uint32_t i = 0; i < 6 * r; ++i) {
      const double radius = double(r) / rings, angle = two_pi * i / (6 * r);
      mesh.positions.insert(mesh.positions.end(), {radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
    for (std::uint32_t side = 0; side < 6; ++side) {
      for (std::uint32_t i = 0; i < r; ++i) {
        mesh.triangles.insert(mesh.triangles.end(), {vertex(r - 1, side * (r - 1) + i), vertex(r, side * r + i),
                                                     vertex(r, side * r + i + 1)});
        if (i + 1 < r)
          mesh.triangles.insert(mesh.triangles.end(), {vertex(r - 1, side * (r - 1) + i), vertex(r, side * r + i + 1),
                                                       vertex(r - 1, side * (r - 1) + i + 1)});
      }
    }
  }
  return mesh;
}

// The octahedron, each edge cut into `cuts`, on the unit sphere.
inline PlainMesh sphere(std::uint32_t cuts) {
  PlainMesh mesh;
  const double corner[6][3] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const int face[8][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  std::map<std::array<int, 3>, std::uint32_t> known;  // lattice points, shared by faces
  const int n = static_cast<int>(cuts);
  const auto vertex = [&](const int* f, int i, int j) {
    std::array<int, 3> key{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = i * corner[f[0]][k] + j * corner[f[1]][k] + (n - i - j) * corner[f[2]][k];
      key[k] = static_cast<int>(std::lround(x));
    }
    const auto found = known.find(key);
    if (found != known.end()) return found->second;
    const double length = std::sqrt(double(key[0]) * key[0] + double(key[1]) * key[1] + double(key[2]) * key[2]);
    for (const int x : key) mesh.positions.push_back(x / length);
    return known[key] = mesh.vertex_count() - 1;
  };
  for (const auto& f : face) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        mesh.triangles.insert(mesh.triangles.end(), {vertex(f, i, j), vertex(f, i + 1, j), vertex(f, i, j + 1)});
        if (i + j + 1 < n)
          mesh.triangles.insert(mesh.triangles.end(),
                                {vertex(f, i + 1, j), vertex(f, i + 1, j + 1), vertex(f, i, j + 1)});
      }
    }
  }
  return mesh;
}

// A jittered patch sheared by `shear`: most triangles become obtuse.
inline PlainMesh sheared_patch(std::uint32_t nx, std::uint32_t ny, double shear, std::uint32_t seed = 2) {
  PlainMesh mesh = grid(nx, ny, 1, 0.3, seed);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) mesh.positions[i] += shear * mesh.positions[i + 1];
  return mesh;
}

// `count` pages that share the row of vertices on the y axis, every second one with its triangles turned over.
inline PlainMesh book(int count, std::uint32_t nx, std::uint32_t ny, double shear) {
  PlainMesh mesh;
  const double two_pi = 8 * std::atan(1.0);
  for (int page = 0; page < count; ++page) {
    PlainMesh leaf = grid(nx, ny, 1, 0.25, 7 + static_cast<std::uint32_t>(page));
    const double angle = two_pi * (page + 0.15 * page * page / count) / count;
    const std::uint32_t base = mesh.vertex_count();
    for (std::size_t i = 0; i < leaf.positions.size(); i += 3) {
      const double x = leaf.positions[i], y = leaf.positions[i + 1];
      mesh.positions.insert(mesh.positions.end(), {x * std::cos(angle), y + shear * x, x * std::sin(angle)});
    }
    for (std::size_t t = 0; t < leaf.triangles.size(); t += 3) {
      std::uint32_t v[3] = {base + leaf.triangles[t], base + leaf.triangles[t + 1], base + leaf.triangles[t + 2]};
      if (page % 2) std::swap(v[1], v[2]);
      mesh.triangles.insert(mesh.triangles.end(), v, v + 3);
    }
    for (std::uint32_t j = 0; j <= ny; ++j) {  // the spine, equal to the bit so that it welds
      double* p = mesh.positions.data() + 3 * (base + j * (nx + 1));
      p[0] = 0;
      p[1] = j;
      p[2] = 0;
    }
  }
  return mesh;
}

inline PlainMesh turned_over(PlainMesh mesh, std::uint32_t every) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3 * std::size_t{every})
    std::swap(mesh.triangles[t + 1], mesh.triangles[t + 2]);
  return mesh;
}

inline std::vector<std::pair<std::string, PlainMesh>> dirty_meshes() {
  std::vector<std::pair<std::string, PlainMesh>> meshes;
  PlainMesh long_torus = torus(60, 8, 0.35, 3);
  meshes.emplace_back("obtuse torus", long_torus);
  meshes.emplace_back("sheared patch", sheared_patch(16, 12, 3));
  meshes.emplace_back("three pages on one spine", book(3, 6, 9, 1.5));
  meshes.emplace_back("five pages on one spine", book(5, 4, 7, 1));
  meshes.emplace_back("torus with flipped triangles", turned_over(torus(20, 12, 0.3, 5), 7));
  PlainMesh doubled = sheared_patch(8, 6, 1);
  for (std::size_t t = 0; t < 30; ++t) doubled.triangles.push_back(doubled.triangles[t]);
  meshes.emplace_back("doubled triangles", doubled);
  PlainMesh touching = torus(14, 9, 0.2, 8);  // two tori that share one vertex
  append(touching, torus(14, 9, 0.2, 8), 20);
  for (std::size_t k = 0; k < 3; ++k) touching.positions[3 * 126 + k] = touching.positions[k];
  meshes.emplace_back("two tori at one vertex", touching);
  PlainMesh moebius;
  for (int i = 0; i < 40; ++i) {
    const double t = 8 * std::atan(1.0) * i / 40;
    for (const double w : {-0.4, 0.0, 0.35})
      moebius.positions.insert(moebius.positions.end(), {(2 + w * std::cos(t / 2)) * std::cos(t),
                                                         (2 + w * std::cos(t / 2)) * std::sin(t), w * std::sin(t / 2)});
  }
  for (std::uint32_t i = 0; i < 40; ++i) {
    for (std::uint32_t j = 0; j < 2; ++j) {
      const bool last = i == 39;
      const std::uint32_t a = 3 * i + j, b = last ? 2 - j : a + 3, c = last ? 1 - j : a + 4, d = a + 1;
      moebius.triangles.insert(moebius.triangles.end(), {a, b, c, a, c, d});
    }
  }
  meshes.emplace_back("moebius strip", moebius);
  PlainMesh thin = sheared_patch(10, 8, 0.5);  // three vertices moved onto lines, one onto a neighbour
  for (const std::uint32_t v : {24u, 50u, 61u}) {
    for (std::size_t k = 0; k < 3; ++k)
      thin.positions[3 * v + k] = 0.5 * (thin.positions[3 * (v - 1) + k] + thin.positions[3 * (v + 1) + k]);
  }
  for (std::size_t k = 0; k < 3; ++k) thin.positions[3 * 38 + k] = thin.positions[3 * 39 + k] + (k == 0 ? 1e-13 : 0);
  meshes.emplace_back("zero-area triangles", thin);
  PlainMesh strip;  // all on one line
  for (int i = 0; i < 20; ++i) strip.positions.insert(strip.positions.end(), {double(i), 0.0, 0.0});
  for (std::uint32_t i = 0; i + 2 < 20; ++i) strip.triangles.insert(strip.triangles.end(), {i, i + 1, i + 2});
  meshes.emplace_back("strip on a line", strip);
  PlainMesh fan;  // needles: a hub with a ring of 200 at a thousand times their spacing, and a second hub far away
  const double two_pi = 8 * std::atan(1.0);
  fan.positions.insert(fan.positions.end(), {0.0, 0.0, 0.0, 0.0, 0.0, 5.0});
  for (int i = 0; i < 200; ++i)
    fan.positions.insert(fan.positions.end(), {std::cos(two_pi * i / 200), std::sin(two_pi * i / 200), 0.0});
  for (std::uint32_t i = 0; i < 200; ++i)
    fan.triangles.insert(fan.triangles.end(), {0u, 2 + i, 2 + (i + 1) % 200, 1u, 2 + (i + 1) % 200, 2 + i});
  meshes.emplace_back("needles at two hubs", fan);
  return meshes;
}

// No ties: no three points on a line, no coinciding pages.
inline bool is_generic(const std::string& name) {
  return name != "doubled triangles" && name != "zero-area triangles" && name != "strip on a line" &&
         name != "needles at two hubs";
}

// place[v]: where vertex v went.
inline PlainMesh shuffled_and_rotated(const PlainMesh& mesh, std::uint32_t seed, std::vector<std::uint32_t>& place) {
  std::mt19937 random(seed);
  place.resize(mesh.vertex_count());
  for (std::uint32_t v = 0; v < place.size(); ++v) place[v] = v;
  std::shuffle(place.begin(), place.end(), random);
  const double a = 0.7 * seed, b = 1.3 * seed;
  PlainMesh out;
  out.positions.resize(mesh.positions.size());
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    const double* p = mesh.positions.data() + 3 * std::size_t{v};
    const double x = std::cos(a) * p[0] - std::sin(a) * p[1], y = std::sin(a) * p[0] + std::cos(a) * p[1];
    double* q = out.positions.data() + 3 * std::size_t{place[v]};
    q[0] = x;
    q[1] = std::cos(b) * y - std::sin(b) * p[2];
    q[2] = std::sin(b) * y + std::cos(b) * p[2];
  }
  std::vector<std::size_t> order(mesh.triangles.size() / 3);
  for (std::size_t t = 0; t < order.size(); ++t) order[t] = t;
  std::shuffle(order.begin(), order.end(), random);
  for (const std::size_t t : order) {
    const std::size_t turn = random() % 3;
    for (std::size_t k = 0; k < 3; ++k) out.triangles.push_back(place[mesh.triangles[3 * t + (k + turn) % 3]]);
  }
  return out;
}

}  // namespace hf_test
