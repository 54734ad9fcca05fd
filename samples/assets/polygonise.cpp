// Marching tetrahedra. Every grid cube is cut into the six tetrahedra around its main diagonal (Kuhn 1960); the cut of
// neighbouring cubes agrees, so linear interpolation on tetrahedra gives a closed manifold without ambiguous cases.
// Blocks of cubes far from the surface, and blocks in them, are skipped by the bound |gradient| <= 1. Cost: O(cubes
// near the surface).
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "even_mesh.h"

namespace samples {
namespace {

constexpr int block = 8, part = 2;  // cubes along an edge of a block, and of one of its parts
constexpr int parts = block / part;

// Sign of the volume of the tetrahedron of cube corners p, a, b, c: positive when the triangle a, b, c turns
// counter-clockwise seen from the side away from p.
int orientation(int p, int a, int b, int c) {
  const auto offset = [p](int q, int axis) { return (q >> axis & 1) - (p >> axis & 1); };
  const int ax = offset(a, 0), ay = offset(a, 1), az = offset(a, 2);
  const int bx = offset(b, 0), by = offset(b, 1), bz = offset(b, 2);
  const int cx = offset(c, 0), cy = offset(c, 1), cz = offset(c, 2);
  return ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx);
}

class Grid {
 public:
  Grid(const ImplicitBody& body, double spacing, double level) : body_(body), spacing_(spacing), level_(level) {
    const dvec3 size = body.upper - body.lower;
    blocks_ = glm::ivec3(ceil(size / (spacing * block)));
    count_ = blocks_ * block + 1;
    if (double(count_.x) * double(count_.y) * double(count_.z) > 4e8) {
      throw std::runtime_error("polygonise: the grid spacing is too small for this body");
    }
    values_.assign(size_t(count_.x) * size_t(count_.y) * size_t(count_.z), 0.0f);
  }

  dvec3 point(int x, int y, int z) const { return body_.lower + spacing_ * dvec3(x, y, z); }
  size_t index(int x, int y, int z) const {
    return (size_t(z) * size_t(count_.y) + size_t(y)) * size_t(count_.x) + size_t(x);
  }
  dvec3 point(size_t i) const {
    const size_t row = size_t(count_.x), slab = row * size_t(count_.y);
    return point(int(i % row), int(i / row % size_t(count_.y)), int(i / slab));
  }

  // Field value, computed when first asked for; never exactly zero.
  double value(int x, int y, int z) {
    float& v = values_[index(x, y, z)];
    if (v == 0.0f) {
      v = float(body_.value(point(x, y, z)) - level_);
      if (v == 0.0f) v = 1e-12f;
    }
    return double(v);
  }

  template <typename Visit>
  void for_each_cube_near_surface(Visit visit) {
    const dvec3 lower = body_.lower;
    const auto far = [&](const dvec3& corner, int cubes) {
      const double reach = 0.5 * std::sqrt(3.0) * cubes * spacing_ * 1.05;
      return std::abs(body_.value(lower + spacing_ * (corner + 0.5 * cubes)) - level_) > reach;
    };
    bool skipped[parts * parts * parts];
    for (int bz = 0; bz < blocks_.z; ++bz) {
      for (int by = 0; by < blocks_.y; ++by) {
        for (int bx = 0; bx < blocks_.x; ++bx) {
          const int x = bx * block, y = by * block, z = bz * block;
          if (far(dvec3(x, y, z), block)) continue;
          for (int i = 0; i < parts * parts * parts; ++i) {
            skipped[i] = far(
                dvec3(x + part * (i % parts), y + part * (i / parts % parts), z + part * (i / (parts * parts))), part);
          }
          // in the order of the cubes of the whole block, which numbers the vertices
          for (int i = 0; i < block * block * block; ++i) {
            const int dx = i % block, dy = i / block % block, dz = i / (block * block);
            if (!skipped[(dz / part * parts + dy / part) * parts + dx / part]) visit(x + dx, y + dy, z + dz);
          }
        }
      }
    }
  }

 private:
  const ImplicitBody& body_;
  double spacing_, level_;
  glm::ivec3 blocks_{0}, count_{0};
  std::vector<float> values_;
};

}  // namespace

TriangleMesh polygonise(const ImplicitBody& body, double spacing, double level, double margin) {
  Grid grid(body, spacing, level);
  TriangleMesh mesh;
  std::unordered_map<uint64_t, uint32_t> on_edge;
  // paths from corner 0 to corner 7 of the cube, one axis at a time; bit k of a corner = offset along axis k
  static const int tetrahedron[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                        {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  size_t corner_index[8];
  double corner_value[8];
  const auto vertex = [&](int i, int j) {
    if (corner_index[i] > corner_index[j]) std::swap(i, j);
    // at most 2^32 grid points; the offset between the ends of an edge is one of seven
    const int difference = i ^ j;
    const uint64_t key = uint64_t(corner_index[i]) * 8 + uint64_t(difference);
    const auto [entry, fresh] = on_edge.emplace(key, static_cast<uint32_t>(mesh.points.size()));
    if (fresh) {
      const double t = corner_value[i] / (corner_value[i] - corner_value[j]);
      mesh.points.push_back(
          mix(grid.point(corner_index[i]), grid.point(corner_index[j]), std::clamp(t, margin, 1 - margin)));
    }
    return entry->second;
  };
  const auto emit = [&](bool outward, uint32_t a, uint32_t b, uint32_t c) {
    if (outward) {
      mesh.triangles.push_back({a, b, c});
    } else {
      mesh.triangles.push_back({a, c, b});
    }
  };
  grid.for_each_cube_near_surface([&](int x, int y, int z) {
    int inside_count = 0;
    for (int c = 0; c < 8; ++c) {
      corner_value[c] = grid.value(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2 & 1));
      inside_count += corner_value[c] < 0;
    }
    if (inside_count == 0 || inside_count == 8) return;
    for (int c = 0; c < 8; ++c) corner_index[c] = grid.index(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2 & 1));
    for (const auto& tet : tetrahedron) {
      int inside[4], outside[4], in = 0, out = 0;
      for (int corner : tet) {
        if (corner_value[corner] < 0) {
          inside[in++] = corner;
        } else {
          outside[out++] = corner;
        }
      }
      if (in == 0 || out == 0) continue;
      if (in == 1) {
        const uint32_t a = vertex(inside[0], outside[0]), b = vertex(inside[0], outside[1]),
                       c = vertex(inside[0], outside[2]);
        emit(orientation(inside[0], outside[0], outside[1], outside[2]) > 0, a, b, c);
      } else if (in == 3) {
        const uint32_t a = vertex(outside[0], inside[0]), b = vertex(outside[0], inside[1]),
                       c = vertex(outside[0], inside[2]);
        emit(orientation(outside[0], inside[0], inside[1], inside[2]) < 0, a, b, c);
      } else {
        const uint32_t a = vertex(inside[0], outside[0]), b = vertex(inside[0], outside[1]),
                       c = vertex(inside[1], outside[1]), d = vertex(inside[1], outside[0]);
        const bool outward = orientation(inside[0], outside[0], outside[1], inside[1]) > 0;
        emit(outward, a, b, c);
        emit(outward, a, c, d);
      }
    }
  });
  if (mesh.triangles.empty()) throw std::runtime_error("polygonise: the body has no surface inside its box");
  return mesh;
}

}  // namespace samples
