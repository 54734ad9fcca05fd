// Matrices the factor's tests share. All are symmetric positive definite unless the name says otherwise.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "factor/matrix.h"

namespace hf_test {

// A matrix under construction: entries (i, j) and (j, i) are kept alike.
class Assembly {
 public:
  explicit Assembly(std::int32_t size) : columns_(static_cast<std::size_t>(size)) {
    for (std::int32_t i = 0; i < size; ++i) columns_[static_cast<std::size_t>(i)].emplace_back(i, 0.0);
  }
  void add(std::int32_t i, std::int32_t j, double value) {
    columns_[static_cast<std::size_t>(i)].emplace_back(j, value);
    if (i != j) columns_[static_cast<std::size_t>(j)].emplace_back(i, value);
  }
  // weight w between i and j: +w on both diagonals, -w off them
  void add_edge(std::int32_t i, std::int32_t j, double weight) {
    add(i, j, -weight);
    add(i, i, weight);
    add(j, j, weight);
  }
  hf_inner::SymmetricMatrix build(hf_inner::Memory& memory) {
    hf_inner::SymmetricMatrix matrix(memory);
    matrix.column_start.push_back(0);
    for (auto& column : columns_) {
      std::stable_sort(column.begin(), column.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t k = 0; k < column.size(); ++k) {
        if (k > 0 && column[k].first == column[k - 1].first) {
          matrix.value.back() += column[k].second;
        } else {
          matrix.row.push_back(column[k].first);
          matrix.value.push_back(column[k].second);
        }
      }
      matrix.column_start.push_back(static_cast<std::int32_t>(matrix.row.size()));
    }
    return matrix;
  }

 private:
  std::vector<std::vector<std::pair<std::int32_t, double>>> columns_;
};

inline hf_inner::SymmetricMatrix grid_laplacian(hf_inner::Memory& memory, std::int32_t nx, std::int32_t ny,
                                                double ground = 1.0, bool diagonals = true) {
  Assembly a(nx * ny);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> weight(0.5, 1.5);
  for (std::int32_t y = 0; y < ny; ++y) {
    for (std::int32_t x = 0; x < nx; ++x) {
      const std::int32_t v = y * nx + x;
      if (x + 1 < nx) a.add_edge(v, v + 1, weight(random));
      if (y + 1 < ny) a.add_edge(v, v + nx, weight(random));
      if (diagonals && x + 1 < nx && y + 1 < ny) a.add_edge(v, v + nx + 1, weight(random));
    }
  }
  a.add(0, 0, ground);
  return a.build(memory);
}

inline std::vector<float> grid_points(std::int32_t nx, std::int32_t ny) {
  std::vector<float> points;
  for (std::int32_t y = 0; y < ny; ++y) {
    for (std::int32_t x = 0; x < nx; ++x) {
      points.push_back(static_cast<float>(x));
      points.push_back(static_cast<float>(y));
      points.push_back(0.0f);
    }
  }
  return points;
}

// Random sparse symmetric pattern, diagonally dominant.
inline hf_inner::SymmetricMatrix random_matrix(hf_inner::Memory& memory, std::int32_t size, double density,
                                               std::uint32_t seed) {
  Assembly a(size);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0), weight(-1.0, 1.0);
  std::vector<double> sum(static_cast<std::size_t>(size), 0.0);
  for (std::int32_t i = 0; i < size; ++i) {
    for (std::int32_t j = 0; j < i; ++j) {
      if (unit(random) >= density) continue;
      const double w = weight(random);
      a.add(i, j, w);
      sum[static_cast<std::size_t>(i)] += std::abs(w);
      sum[static_cast<std::size_t>(j)] += std::abs(w);
    }
  }
  for (std::int32_t i = 0; i < size; ++i) a.add(i, i, sum[static_cast<std::size_t>(i)] + 0.01 + unit(random));
  return a.build(memory);
}

inline hf_inner::SymmetricMatrix arrow_matrix(hf_inner::Memory& memory, std::int32_t size) {
  Assembly a(size);
  for (std::int32_t i = 1; i < size; ++i) {
    a.add(0, i, 0.5);
    a.add(i, i, 2.0);
  }
  a.add(0, 0, static_cast<double>(size));
  return a.build(memory);
}

struct TriangleMesh {
  std::vector<double> points;           // xyz
  std::vector<std::int32_t> triangles;  // three each
};

// nu x nv torus, every vertex jittered by `jitter` of the local spacing inside the surface, quads split along the
// shorter diagonal: the family of the library's benchmarks.
inline TriangleMesh torus(std::int32_t nu, std::int32_t nv, double jitter) {
  TriangleMesh mesh;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double turn = 6.283185307179586;
  for (std::int32_t i = 0; i < nu; ++i) {
    for (std::int32_t j = 0; j < nv; ++j) {
      const double u = turn * (i + jitter * unit(random)) / nu, v = turn * (j + jitter * unit(random)) / nv;
      const double r = 1.0 + 0.4 * std::cos(v);
      mesh.points.insert(mesh.points.end(), {r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
    }
  }
  const auto distance = [&](std::int32_t p, std::int32_t q) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += std::pow(mesh.points[3 * p + k] - mesh.points[3 * q + k], 2);
    return sum;
  };
  for (std::int32_t i = 0; i < nu; ++i) {
    for (std::int32_t j = 0; j < nv; ++j) {
      const std::int32_t i1 = (i + 1) % nu, j1 = (j + 1) % nv;
      const std::int32_t a = i * nv + j, b = i1 * nv + j, c = i1 * nv + j1, d = i * nv + j1;
      if (distance(a, c) < distance(b, d))
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
      else
        mesh.triangles.insert(mesh.triangles.end(), {a, b, d, b, c, d});
    }
  }
  return mesh;
}

// Cotangent Laplacian, cotangents clamped from below so that the matrix is an M-matrix, and a ground at vertex 0.
inline hf_inner::SymmetricMatrix cotangent_matrix(hf_inner::Memory& memory, const TriangleMesh& mesh,
                                                  bool ground = true) {
  const std::int32_t n = static_cast<std::int32_t>(mesh.points.size() / 3);
  Assembly a(n);
  double trace = 0;
  for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t o = mesh.triangles[t + k], i = mesh.triangles[t + (k + 1) % 3],
                         j = mesh.triangles[t + (k + 2) % 3];
      double dot = 0, e[3], f[3];
      for (int c = 0; c < 3; ++c) {
        e[c] = mesh.points[3 * i + c] - mesh.points[3 * o + c];
        f[c] = mesh.points[3 * j + c] - mesh.points[3 * o + c];
      }
      for (int c = 0; c < 3; ++c) dot += e[c] * f[c];
      const double x = e[1] * f[2] - e[2] * f[1], y = e[2] * f[0] - e[0] * f[2], z = e[0] * f[1] - e[1] * f[0];
      const double weight = std::max(1e-3, 0.5 * dot / std::max(1e-30, std::sqrt(x * x + y * y + z * z)));
      a.add_edge(i, j, weight);
      trace += 2 * weight;
    }
  }
  if (ground) a.add(0, 0, trace / n);
  return a.build(memory);
}

// A A with unit mass, plus ground: the bi-harmonic pattern (two rings).
inline hf_inner::SymmetricMatrix squared(hf_inner::Memory& memory, const hf_inner::SymmetricMatrix& a, double ground) {
  hf_inner::SymmetricMatrix product(memory);
  product.column_start.push_back(0);
  std::vector<double> sum(static_cast<std::size_t>(a.size()), 0.0);
  std::vector<std::int32_t> touched;
  for (std::int32_t j = 0; j < a.size(); ++j) {
    touched.clear();
    for (std::int32_t e = a.column_start[j]; e < a.column_start[j + 1]; ++e) {
      for (std::int32_t f = a.column_start[a.row[e]]; f < a.column_start[a.row[e] + 1]; ++f) {
        if (std::find(touched.begin(), touched.end(), a.row[f]) == touched.end()) {
          touched.push_back(a.row[f]);
          sum[static_cast<std::size_t>(a.row[f])] = 0;
        }
        sum[static_cast<std::size_t>(a.row[f])] += a.value[f] * a.value[e];
      }
    }
    std::sort(touched.begin(), touched.end());
    for (const std::int32_t i : touched) {
      product.row.push_back(i);
      product.value.push_back(sum[static_cast<std::size_t>(i)] + (i == j && i == 0 ? ground : 0.0));
    }
    product.column_start.push_back(static_cast<std::int32_t>(product.row.size()));
  }
  return product;
}

inline std::vector<double> multiply(const hf_inner::SymmetricMatrix& a, const std::vector<double>& x) {
  std::vector<double> y(x.size(), 0.0);
  for (std::int32_t j = 0; j < a.size(); ++j) {
    for (std::int32_t e = a.column_start[j]; e < a.column_start[j + 1]; ++e)
      y[static_cast<std::size_t>(a.row[e])] += a.value[e] * x[static_cast<std::size_t>(j)];
  }
  return y;
}

}  // namespace hf_test
