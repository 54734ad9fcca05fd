// Shapes of reports_test.cpp: small meshes in double, made here.
#ifndef HF_TESTS_ORACLE_REPORTS_SHAPES_H
#define HF_TESTS_ORACLE_REPORTS_SHAPES_H

#include <array>
#include <cmath>
#include <vector>

#include "hf/hf.hpp"

namespace reports {

inline constexpr double pi = 3.14159265358979323846;
using Point = std::array<double, 3>;

struct Shape {
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
  uint32_t count() const { return static_cast<uint32_t>(positions.size() / 3); }
  Point at(uint32_t v) const { return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]}; }
  void add(const Point& p) { positions.insert(positions.end(), p.begin(), p.end()); }
  void add(const Shape& other, const Point& by = {0, 0, 0}) {
    const uint32_t first = count();
    for (uint32_t v = 0; v < other.count(); ++v) {
      add({other.at(v)[0] + by[0], other.at(v)[1] + by[1], other.at(v)[2] + by[2]});
    }
    for (const uint32_t v : other.triangles) triangles.push_back(first + v);
  }
  hf::Surface surface(int32_t weld = HF_WELD_EXACT) const {
    auto desc = hf::make<hf_surface_desc>();
    desc.positions = HF_ARRAY(positions.data(), count());
    desc.weld = weld;
    desc.triangles = HF_ARRAY(triangles.data(), triangles.size() / 3);
    return hf::Surface(desc);
  }
};

// Columns times rows vertices, a step apart, in the plane z = 0; vertex row * columns + column.
inline Shape grid(uint32_t columns, uint32_t rows) {
  Shape out;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) out.add({double(i), double(j), 0});
  }
  for (uint32_t j = 0; j + 1 < rows; ++j) {
    for (uint32_t i = 0; i + 1 < columns; ++i) {
      const uint32_t a = j * columns + i, b = a + 1, c = a + columns, d = c + 1;
      for (const uint32_t v : {a, b, d, a, d, c}) out.triangles.push_back(v);
    }
  }
  return out;
}

// Rings of sixteen vertices around the y axis from 0 to 2, closed by a point at each end.
inline constexpr uint32_t around = 16;
inline Shape tube(uint32_t rings, double radius) {
  Shape out;
  for (uint32_t j = 0; j < rings; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      out.add({radius * std::cos(angle), 2.0 * j / (rings - 1), radius * std::sin(angle)});
    }
  }
  const uint32_t start = out.count(), end = start + 1;
  out.add({0, 0, 0});
  out.add({0, 2, 0});
  for (uint32_t i = 0; i < around; ++i) {
    const uint32_t next = (i + 1) % around, last = (rings - 1) * around;
    for (uint32_t first = 0; first < last; first += around) {
      const uint32_t a = first + i, b = first + next, c = a + around, d = b + around;
      for (const uint32_t v : {a, c, b, b, c, d}) out.triangles.push_back(v);
    }
    for (const uint32_t v : {start, i, next, end, last + next, last + i}) out.triangles.push_back(v);
  }
  return out;
}

inline Shape cube(double size) {
  Shape out;
  for (int i = 0; i < 8; ++i) out.add({size * (i >> 2), size * (i >> 1 & 1), size * (i & 1)});
  out.triangles = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                   2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  return out;
}

inline double between(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace reports

#endif
