// Test shapes on regular grids; each function is O(output). The cactus lives with the implicit surfaces (cactus.cpp).
// Failure: std::runtime_error that names the argument.
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace samples {
namespace {

constexpr double pi = 3.14159265358979323846;

void require(bool condition, const char* sentence) {
  if (!condition) throw std::runtime_error(sentence);
}

uint32_t add(ShapeMesh& mesh, double x, double y, double z) {
  mesh.positions.insert(mesh.positions.end(), {x, y, z});
  return mesh.vertex_count() - 1;
}

void triangle(ShapeMesh& mesh, uint32_t a, uint32_t b, uint32_t c) {
  mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
}

double distance2(const ShapeMesh& mesh, uint32_t a, uint32_t b) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double d = mesh.positions[3 * size_t(a) + k] - mesh.positions[3 * size_t(b) + k];
    sum += d * d;
  }
  return sum;
}

// Corners counter-clockwise; cut along the shorter diagonal.
void quad(ShapeMesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  if (distance2(mesh, a, c) <= distance2(mesh, b, d)) {
    triangle(mesh, a, b, c);
    triangle(mesh, a, c, d);
  } else {
    triangle(mesh, a, b, d);
    triangle(mesh, b, c, d);
  }
}

template <typename Height>
ShapeMesh height_field(uint32_t columns, uint32_t rows, Height height) {
  require(columns >= 2 && rows >= 2, "plane: needs at least 2 columns and 2 rows");
  require(uint64_t(columns) * rows < 0xFFFFFFFFull, "plane: more vertices than 32 bits can index");
  ShapeMesh mesh;
  mesh.positions.reserve(3 * size_t(columns) * rows);
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const double x = -1 + 2.0 * i / (columns - 1), z = -1 + 2.0 * j / (rows - 1);
      add(mesh, x, height(x, z), z);
    }
  }
  for (uint32_t j = 0; j + 1 < rows; ++j) {
    for (uint32_t i = 0; i + 1 < columns; ++i) {
      const uint32_t a = j * columns + i;
      // alternate the diagonals, so that the mesh prefers no direction
      if ((i + j) % 2 == 0) {
        triangle(mesh, a, a + columns, a + 1);
        triangle(mesh, a + 1, a + columns, a + columns + 1);
      } else {
        triangle(mesh, a, a + columns, a + columns + 1);
        triangle(mesh, a, a + columns + 1, a + 1);
      }
    }
  }
  return mesh;
}

}  // namespace

double hash_to_unit(uint64_t seed, uint64_t index) {
  uint64_t z = seed * 0xD1342543DE82EF95ull + (index + 1) * 0x9E3779B97F4A7C15ull;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  z ^= z >> 31;
  return double(z >> 11) * 0x1.0p-53;
}

ShapeMesh jittered_torus(uint32_t nu, uint32_t nv, double jitter, double major_radius, double minor_radius,
                         uint64_t seed) {
  require(nu >= 3 && nv >= 3, "jittered_torus: nu and nv must be at least 3");
  require(uint64_t(nu) * nv < 0xFFFFFFFFull, "jittered_torus: more vertices than 32 bits can index");
  require(jitter >= 0 && jitter <= 0.45, "jittered_torus: jitter must lie in 0..0.45, beyond that triangles fold");
  require(minor_radius > 0 && major_radius > minor_radius, "jittered_torus: radii must satisfy 0 < minor < major");
  ShapeMesh mesh;
  mesh.positions.reserve(3 * size_t(nu) * nv);
  mesh.triangles.reserve(6 * size_t(nu) * nv);
  for (uint32_t i = 0; i < nu; ++i) {
    for (uint32_t j = 0; j < nv; ++j) {
      const uint64_t index = uint64_t(i) * nv + j;
      const double u = 2 * pi * (i + jitter * (2 * hash_to_unit(seed, 2 * index) - 1)) / nu;
      const double v = 2 * pi * (j + jitter * (2 * hash_to_unit(seed, 2 * index + 1) - 1)) / nv;
      const double ring = major_radius + minor_radius * std::cos(v);
      add(mesh, ring * std::sin(u), minor_radius * std::sin(v), ring * std::cos(u));
    }
  }
  for (uint32_t i = 0; i < nu; ++i) {
    for (uint32_t j = 0; j < nv; ++j) {
      const uint32_t i1 = (i + 1) % nu, j1 = (j + 1) % nv;
      quad(mesh, i * nv + j, i1 * nv + j, i1 * nv + j1, i * nv + j1);
    }
  }
  return mesh;
}

ShapeMesh plane(uint32_t columns, uint32_t rows) {
  return height_field(columns, rows, [](double, double) { return 0.0; });
}

ShapeMesh bumpy_plane(uint32_t columns, uint32_t rows) {
  return height_field(columns, rows, [](double x, double z) {
    const double wave = std::sin(3.5 * pi * x) * std::sin(3.5 * pi * z);
    return 0.10 * wave * (0.6 + 0.4 * std::abs(wave) * wave) + 0.02 * std::sin(2 * pi * (x + 0.5 * z));
  });
}

ShapeMesh sphere(uint32_t frequency) {
  require(frequency >= 1 && frequency <= 4096, "sphere: frequency must lie in 1..4096");
  const double g = 0.5 * (1 + std::sqrt(5.0));
  const double corner[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  const uint32_t face[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  ShapeMesh mesh;
  const uint32_t f = frequency;
  const auto project = [&](double x, double y, double z) {
    const double scale = 1 / std::sqrt(x * x + y * y + z * z);
    return add(mesh, x * scale, y * scale, z * scale);
  };
  for (const auto& c : corner) project(c[0], c[1], c[2]);
  // points of the original edges are shared by two faces: one run of f - 1 vertices per edge
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> edge_start;
  const auto on_edge = [&](uint32_t a, uint32_t b, uint32_t step) {  // step 0..f from a to b
    if (step == 0) return a;
    if (step == f) return b;
    const bool swapped = a > b;
    if (swapped) {
      std::swap(a, b);
      step = f - step;
    }
    const auto [entry, fresh] = edge_start.emplace(std::make_pair(a, b), mesh.vertex_count());
    if (fresh) {
      for (uint32_t i = 1; i < f; ++i) {
        const double t = double(i) / f;
        project(corner[a][0] + t * (corner[b][0] - corner[a][0]), corner[a][1] + t * (corner[b][1] - corner[a][1]),
                corner[a][2] + t * (corner[b][2] - corner[a][2]));
      }
    }
    return entry->second + step - 1;
  };
  for (const auto& tri : face) {
    // rows from corner 0 to the edge 1-2
    std::vector<std::vector<uint32_t>> row(f + 1);
    for (uint32_t i = 0; i <= f; ++i) {
      for (uint32_t j = 0; j <= i; ++j) {
        if (j == 0) {
          row[i].push_back(on_edge(tri[0], tri[1], i));
        } else if (j == i) {
          row[i].push_back(on_edge(tri[0], tri[2], i));
        } else if (i == f) {
          row[i].push_back(on_edge(tri[1], tri[2], j));
        } else {
          double p[3];
          for (size_t k = 0; k < 3; ++k) {
            p[k] = (corner[tri[0]][k] * (f - i) + corner[tri[1]][k] * (i - j) + corner[tri[2]][k] * j) / f;
          }
          row[i].push_back(project(p[0], p[1], p[2]));
        }
      }
    }
    for (uint32_t i = 0; i < f; ++i) {
      for (uint32_t j = 0; j <= i; ++j) {
        triangle(mesh, row[i][j], row[i + 1][j], row[i + 1][j + 1]);
        if (j < i) triangle(mesh, row[i][j], row[i + 1][j + 1], row[i][j + 1]);
      }
    }
  }
  return mesh;
}

ShapeMesh box(double x, double y, double z, uint32_t nx, uint32_t ny, uint32_t nz) {
  require(x > 0 && y > 0 && z > 0, "box: sizes must be positive");
  require(nx >= 1 && ny >= 1 && nz >= 1 && nx <= 20000 && ny <= 20000 && nz <= 20000,
          "box: counts must be in 1..20000");
  ShapeMesh mesh;
  std::unordered_map<uint64_t, uint32_t> known;
  const auto at = [&](uint32_t i, uint32_t j, uint32_t k) {
    const uint64_t key = (uint64_t(i) << 40) | (uint64_t(j) << 20) | k;
    const auto [entry, fresh] = known.emplace(key, mesh.vertex_count());
    if (fresh) add(mesh, x * (double(i) / nx - 0.5), y * double(j) / ny, z * (double(k) / nz - 0.5));
    return entry->second;
  };
  const auto cell = [&](uint32_t parity, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    if (parity % 2 == 0) {
      triangle(mesh, a, b, c);
      triangle(mesh, a, c, d);
    } else {
      triangle(mesh, a, b, d);
      triangle(mesh, b, c, d);
    }
  };
  for (uint32_t j = 0; j < ny; ++j) {
    for (uint32_t i = 0; i < nx; ++i) {
      cell(i + j, at(i, j, nz), at(i + 1, j, nz), at(i + 1, j + 1, nz), at(i, j + 1, nz));
      cell(i + j, at(i + 1, j, 0), at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0));
    }
    for (uint32_t k = 0; k < nz; ++k) {
      cell(j + k, at(nx, j, k + 1), at(nx, j, k), at(nx, j + 1, k), at(nx, j + 1, k + 1));
      cell(j + k, at(0, j, k), at(0, j, k + 1), at(0, j + 1, k + 1), at(0, j + 1, k));
    }
  }
  for (uint32_t i = 0; i < nx; ++i) {
    for (uint32_t k = 0; k < nz; ++k) {
      cell(i + k, at(i, ny, k + 1), at(i + 1, ny, k + 1), at(i + 1, ny, k), at(i, ny, k));
      cell(i + k, at(i, 0, k), at(i + 1, 0, k), at(i + 1, 0, k + 1), at(i, 0, k + 1));
    }
  }
  return mesh;
}

ShapeMesh bar(uint32_t n) {
  require(n >= 1 && n <= 5000, "bar: n must lie in 1..5000");
  return box(1, 4, 1, n, 4 * n, n);
}

ShapeMesh cylinder(uint32_t m, uint32_t rows) {
  require(m >= 1 && m <= 5000 && rows >= 2 && rows <= 100000, "cylinder: m must lie in 1..5000, rows in 2..100000");
  ShapeMesh mesh;
  const double radius = 0.5, height = 4;
  const uint32_t around = 6 * m;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * pi * (i + 0.5 * (j % 2)) / around;
      add(mesh, radius * std::sin(angle), height * j / (rows - 1), radius * std::cos(angle));
    }
  }
  for (uint32_t j = 0; j + 1 < rows; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const uint32_t i1 = (i + 1) % around, low = j * around, high = low + around;
      if (j % 2 == 0) {
        triangle(mesh, low + i, low + i1, high + i);
        triangle(mesh, low + i1, high + i1, high + i);
      } else {
        triangle(mesh, low + i, low + i1, high + i1);
        triangle(mesh, low + i, high + i1, high + i);
      }
    }
  }
  // discs: ring k has 6 k vertices, the centre closes ring 1
  for (int side = 0; side < 2; ++side) {
    const uint32_t outer_row = side ? rows - 1 : 0;
    const double y = side ? height : 0, shift = 0.5 * (outer_row % 2) / around;
    const auto face = [&](uint32_t a, uint32_t b, uint32_t c) {
      side ? triangle(mesh, a, b, c) : triangle(mesh, a, c, b);
    };
    std::vector<uint32_t> outer(around);
    for (uint32_t i = 0; i < around; ++i) outer[i] = outer_row * around + i;
    for (uint32_t k = m; k-- > 0;) {
      std::vector<uint32_t> inner;
      const uint32_t count = std::max(1u, 6 * k);
      for (uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * pi * (double(i) / count + shift), r = radius * k / m;
        inner.push_back(add(mesh, r * std::sin(angle), y, r * std::cos(angle)));
      }
      const uint32_t ring = k + 1;  // the outer ring has 6 * ring vertices in six sectors
      for (uint32_t sector = 0; sector < 6; ++sector) {
        for (uint32_t i = 0; i < ring; ++i) {
          const uint32_t o = sector * ring + i, o1 = (o + 1) % (6 * ring);
          const uint32_t in = k == 0 ? 0 : (sector * k + i) % count;
          face(outer[o], outer[o1], inner[in]);
          if (i + 1 < ring) face(outer[o1], inner[(in + 1) % count], inner[in]);
        }
      }
      outer = std::move(inner);
    }
  }
  return mesh;
}

}  // namespace samples
