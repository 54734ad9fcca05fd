// Faces of any number of corners: the rule that cuts them, the polygon Laplacian, and the operator of a bent mesh.
#include "mesh/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "mesh/corner_tree.h"
#include "mesh/face_correction.h"
#include "mesh/face_cut.h"
#include "mesh/face_operator.h"
#include "mesh/polygon_laplacian.h"
#include "mesh/topology.h"

namespace {

using hf_inner::Vec3;
using Triangles = std::vector<std::vector<int>>;

// The triangles of a face as sets of vertex numbers, in one order.
Triangles cut_of(std::vector<std::int32_t> vertices, const std::vector<Vec3>& positions, bool* second = nullptr) {
  hf_inner::Memory memory;
  hf_inner::mesh::FaceCutter cutter(memory);
  std::vector<Vec3> points;
  for (const std::int32_t v : vertices) points.push_back(positions[static_cast<std::size_t>(v)]);
  cutter.cut(vertices, points);
  Triangles out;
  for (std::size_t t = 0; t < cutter.triangles.size(); t += 3) {
    out.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      out.back().push_back(vertices[static_cast<std::size_t>(cutter.triangles[t + k])]);
    std::sort(out.back().begin(), out.back().end());
  }
  std::sort(out.begin(), out.end());
  if (second) *second = cutter.second_cut;
  return out;
}

std::vector<Vec3> random_polygon(std::size_t n, unsigned seed, double bend) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double turn = 2 * M_PI * (static_cast<double>(i) + 0.8 * number(engine)) / static_cast<double>(n);
    const double radius = 0.3 + number(engine);
    points.push_back({radius * std::cos(turn), radius * std::sin(turn), bend * (number(engine) - 0.5)});
  }
  return points;
}

// The rule itself: of all ears without a reflex corner inside, the roundest is cut, of equal ones the lowest corner.
Triangles plain_cut_of(const std::vector<Vec3>& points) {
  std::vector<int> left(points.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
  const auto place = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  double area = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) area += cross(points[i] - points[0], points[i + 1] - points[0]).z;
  const auto side = [&](int a, int b, int c) { return area * cross(place(b) - place(a), place(c) - place(a)).z; };
  Triangles out;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t i = 0; i < n; ++i) {
      const int a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
      if (!(side(a, b, c) > 0)) continue;
      bool free = true;
      for (std::size_t q = 0; q < n && free; ++q) {
        const int it = left[q];
        if (it == a || it == b || it == c || side(left[(q + n - 1) % n], it, left[(q + 1) % n]) > 0) continue;
        free = !(side(a, b, it) >= 0 && side(b, c, it) >= 0 && side(c, a, it) >= 0);
      }
      const Vec3 x = place(b) - place(a), y = place(c) - place(b), z = place(a) - place(c);
      const double cost = (dot(x, x) + dot(y, y) + dot(z, z)) / norm(cross(x, y));
      if (free && cost < (1 - 1e-9) * least) {
        best = i;
        least = cost;
      }
    }
    out.push_back({left[(best + n - 1) % n], left[best], left[(best + 1) % n]});
    std::sort(out.back().begin(), out.back().end());
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  out.push_back(left);
  std::sort(out.back().begin(), out.back().end());
  std::sort(out.begin(), out.end());
  return out;
}

// From 128 corners on, corners are looked for in slabs. One far corner leaves the others in a small part of the plane.
TEST(FaceCut, cuts_large_faces_by_the_same_rule) {
  for (const std::size_t n : {40, 127, 128, 129, 300}) {
    for (unsigned seed = 0; seed < 6; ++seed) {
      std::vector<Vec3> points = random_polygon(n, seed, 0);
      if (seed == 3) points[n / 2].x = 1e4;
      if (seed == 4) {
        for (Vec3& p : points) p.y *= 1e-3;
      }
      if (seed == 5) {
        for (std::size_t i = 0; i < n; ++i) {  // a comb: many corners share a coordinate
          const std::size_t k = i < n / 2 ? i : n - 1 - i;
          points[i] = {static_cast<double>(k),
                       i < n / 2 ? 0.0 + 3.0 * static_cast<double>(k % 2) : 9.0 + static_cast<double>(k % 2), 0};
        }
      }
      std::vector<std::int32_t> around(n);
      for (std::size_t i = 0; i < n; ++i) around[i] = static_cast<std::int32_t>(i);
      const Triangles expected = plain_cut_of(points);
      EXPECT_EQ(cut_of(around, points), expected) << n << " corners, polygon " << seed;
    }
  }
}

TEST(FaceCut, does_not_depend_on_the_first_corner_the_orientation_or_a_mirror) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::size_t n = 4 + seed % 9;
    std::vector<Vec3> points = random_polygon(n, seed, seed % 2 ? 0.4 : 0.0);
    std::vector<std::int32_t> around(n);
    for (std::size_t i = 0; i < n; ++i) around[i] = static_cast<std::int32_t>(i);
    const Triangles expected = cut_of(around, points);
    EXPECT_EQ(expected.size(), n - 2);
    for (std::size_t turn = 0; turn < n; ++turn) {
      std::rotate(around.begin(), around.begin() + 1, around.end());
      EXPECT_EQ(cut_of(around, points), expected);
      std::vector<std::int32_t> back(around.rbegin(), around.rend());
      EXPECT_EQ(cut_of(back, points), expected);
      std::vector<Vec3> mirror = points;
      for (Vec3& p : mirror) p.x = -p.x;
      EXPECT_EQ(cut_of(back, mirror), expected);
    }
  }
}

TEST(FaceCut, covers_a_planar_polygon_once) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::size_t n = 4 + seed % 30;
    const std::vector<Vec3> points = random_polygon(n, seed, 0);
    std::vector<std::int32_t> around(n);
    for (std::size_t i = 0; i < n; ++i) around[i] = static_cast<std::int32_t>(i);
    double area = 0, cut = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 &p = points[i], &q = points[(i + 1) % n];
      area += 0.5 * (p.x * q.y - p.y * q.x);
    }
    for (const auto& t : cut_of(around, points)) {
      const Vec3 a = points[static_cast<std::size_t>(t[0])], b = points[static_cast<std::size_t>(t[1])],
                 c = points[static_cast<std::size_t>(t[2])];
      cut += 0.5 * norm(cross(b - a, c - a));
    }
    EXPECT_NEAR(cut, area, 1e-12 * area) << "seed " << seed;
  }
}

TEST(FaceCut, a_dart_has_one_cut_and_a_bent_square_two) {
  const std::vector<Vec3> dart = {{0, 0, 0}, {2, 0.5, 0}, {0.3, 0.4, 0}, {0.5, 2, 0}};
  bool second = true;
  EXPECT_EQ(cut_of({0, 1, 2, 3}, dart, &second), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_FALSE(second);
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(cut_of({1, 2, 3, 0}, square, &second), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_FALSE(second);
  std::vector<Vec3> bent = square;
  bent[2].z = 0.3;
  cut_of({1, 2, 3, 0}, bent, &second);
  EXPECT_TRUE(second);
}

// Every ear of a comb is blocked by reflex corners until its neighbours are gone.
TEST(CornerTree, tries_corners_on_the_sides_of_a_triangle_wherever_rounding_puts_them) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 20; ++round) {
    const Vec3 from{any(random), any(random), any(random)}, normal{any(random), any(random), any(random)};
    const Vec3 along = cross(normal, Vec3{1, 0, 0}), aside = cross(normal, along);
    std::vector<Vec3> points;
    const std::int32_t count = 100;  // a row of corners, and one beside it
    for (std::int32_t i = 0; i < count; ++i) points.push_back(from + (i / (count - 1.0)) * along);
    points.push_back(from + 0.5 * along + aside);
    hf_inner::Memory memory;
    hf_inner::mesh::CornerTree tree(memory);
    tree.make(points, normal);
    for (std::int32_t i = 0; i <= count; ++i) tree.put_in(i);
    for (std::int32_t i = 0; i <= count; ++i)
      EXPECT_EQ(tree.find(0, count - 1, count, [&](std::int32_t corner) { return corner == i; }), i);
  }
}

TEST(FaceCut, cuts_combs_of_thousands_of_corners) {
  std::vector<Vec3> points;
  const int teeth = 1000;
  for (int i = 0; i < teeth; ++i) {
    points.push_back({2.0 * i, 0, 0});
    points.push_back({2.0 * i + 1, 10, 0});
  }
  points.push_back({2.0 * teeth, -1, 0});
  points.push_back({0, -1, 0});
  std::reverse(points.begin(), points.end());
  std::vector<std::int32_t> around(points.size());
  for (std::size_t i = 0; i < around.size(); ++i) around[i] = static_cast<std::int32_t>(i);
  double area = 0, cut = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 &p = points[i], &q = points[(i + 1) % points.size()];
    area += 0.5 * (p.x * q.y - p.y * q.x);
  }
  for (const auto& t : cut_of(around, points)) {
    const Vec3 a = points[static_cast<std::size_t>(t[0])], b = points[static_cast<std::size_t>(t[1])],
               c = points[static_cast<std::size_t>(t[2])];
    cut += 0.5 * norm(cross(b - a, c - a));
  }
  EXPECT_NEAR(cut, area, 1e-9 * area);
}

TEST(FacePoint, is_the_middle_of_a_rectangle_and_its_weights_give_it) {
  hf_inner::Memory memory;
  hf_inner::Vector<double> weights(&memory);
  const Vec3 rectangle[4] = {{1, 1, 0}, {5, 1, 0}, {5, 2, 0}, {1, 2, 0}};
  Vec3 p = hf_inner::mesh::face_point({rectangle, 4}, weights);
  EXPECT_NEAR(p.x, 3, 1e-13);
  EXPECT_NEAR(p.y, 1.5, 1e-13);
  for (const double w : weights) EXPECT_NEAR(w, 0.25, 1e-13);
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<Vec3> points = random_polygon(3 + seed % 8, seed, 0.5);
    p = hf_inner::mesh::face_point(points, weights);
    double sum = 0, best = 0;
    Vec3 mean;
    const auto squares = [&](Vec3 x) {
      double total = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 n = cross(points[i] - x, points[(i + 1) % points.size()] - x);
        total += dot(n, n);
      }
      return total;
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
      sum += weights[i];
      mean = mean + weights[i] * points[i];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT(norm(mean - p), 1e-12);
    best = squares(p);
    for (const Vec3 step : {Vec3{1e-3, 0, 0}, Vec3{0, 1e-3, 0}, Vec3{0, 0, 1e-3}}) {
      if (points.size() == 4) continue;  // four corners span the space: the point may leave their mean plane
      EXPECT_GE(squares(p + step), best - 1e-12);
      EXPECT_GE(squares(p - step), best - 1e-12);
    }
  }
}

// A sheet of quads, bent or flat; skew slides rows.
struct Sheet {
  Sheet(int columns, int rows, double length, double bend) {
    for (int j = 0; j <= rows; ++j) {
      for (int i = 0; i <= columns; ++i)
        positions.insert(positions.end(),
                         {length * i + 0.4 * j, 1.0 * j, bend * std::sin(1.7 * i) * std::cos(1.1 * j)});
    }
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const unsigned a = static_cast<unsigned>(j * (columns + 1) + i), up = static_cast<unsigned>(columns) + 1;
        corners.insert(corners.end(), {a, a + 1, a + up + 1, a + up});
        sizes.push_back(4);
      }
    }
  }
  hf_inner::mesh::Mesh make(hf_inner::Memory& memory) const {
    hf_inner::mesh::MeshInput input;
    input.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    input.positions = hf_inner::ConstRows(positions.data(), 3 * sizeof(double));
    input.faces.face_count = static_cast<std::uint32_t>(sizes.size());
    input.faces.corner_count = static_cast<std::uint32_t>(corners.size());
    input.faces.sizes = hf_inner::IndexRows(sizes.data(), 1);
    input.faces.corners = hf_inner::IndexRows(corners.data(), 1);
    return hf_inner::mesh::Mesh::make(input, memory);
  }
  std::vector<double> positions;
  std::vector<std::uint32_t> corners, sizes;
};

void expect_laplacian(const hf_inner::SymmetricMatrix& k, bool no_negative_weights) {
  for (std::int32_t v = 0; v < k.size(); ++v) {
    double sum = 0;
    const std::size_t begin = static_cast<std::size_t>(k.column_start[static_cast<std::size_t>(v)]),
                      end = static_cast<std::size_t>(k.column_start[static_cast<std::size_t>(v) + 1]);
    for (std::size_t i = begin; i < end; ++i) {
      sum += k.value[i];
      if (i > begin) {
        EXPECT_LT(k.row[i - 1], k.row[i]);
      }
      if (k.row[i] == v) continue;
      if (no_negative_weights) {
        EXPECT_LE(k.value[i], 0.0);
      }
      const std::size_t j = static_cast<std::size_t>(k.row[i]);  // the same bits on the other side
      const auto first = k.row.begin() + k.column_start[j], last = k.row.begin() + k.column_start[j + 1];
      const auto there = std::lower_bound(first, last, v);
      ASSERT_TRUE(there != last && *there == v);
      EXPECT_EQ(k.value[static_cast<std::size_t>(there - k.row.begin())], k.value[i]);
    }
    EXPECT_NEAR(sum, 0, 1e-12);
  }
}

TEST(FaceOperator, is_symmetric_and_has_no_negative_weight_by_default) {
  hf_inner::Memory memory;
  using hf_inner::mesh::OperatorKind;
  for (const double length : {0.3, 1.0, 5.0}) {
    for (const double bend : {0.0, 0.4}) {
      const hf_inner::mesh::Mesh mesh = Sheet(6, 5, length, bend).make(memory);
      const auto topology = hf_inner::mesh::Topology::make(mesh, memory);
      const auto weights = hf_inner::mesh::edge_weights(mesh, topology, OperatorKind::cotangent, memory);
      for (const OperatorKind kind :
           {OperatorKind::intrinsic_delaunay, OperatorKind::cotangent, OperatorKind::clamped, OperatorKind::uniform})
        expect_laplacian(hf_inner::mesh::face_operator(mesh, topology, weights, kind, false, memory).laplacian,
                         kind != OperatorKind::cotangent);
    }
  }
}

TEST(FaceOperator, of_long_quads_the_polygon_laplacian_has_negative_weights) {
  hf_inner::Memory memory;
  const hf_inner::mesh::Mesh mesh = Sheet(6, 5, 5.0, 0.0).make(memory);
  const auto k = hf_inner::mesh::polygon_laplacian(mesh, memory);
  bool negative = false;
  for (std::int32_t v = 0; v < k.size(); ++v) {
    for (std::int32_t i = k.column_start[static_cast<std::size_t>(v)];
         i < k.column_start[static_cast<std::size_t>(v) + 1]; ++i)
      negative = negative || (k.row[static_cast<std::size_t>(i)] != v && k.value[static_cast<std::size_t>(i)] > 1e-3);
  }
  EXPECT_TRUE(negative);
}

// The two cuts of every bent quad count alike: exchanging them changes nothing where no edge flips across quads.
TEST(FaceOperator, of_bent_squares_weighs_both_diagonals_alike) {
  hf_inner::Memory memory;
  Sheet sheet(2, 2, 1.0, 0.0);
  sheet.positions = {0, 0, .2, 1, 0, 0, 2, 0, .2, 0, 1, 0, 1, 1, .2, 2, 1, 0, 0, 2, .2, 1, 2, 0, 2, 2, .2};
  const hf_inner::mesh::Mesh mesh = sheet.make(memory);
  const auto topology = hf_inner::mesh::Topology::make(mesh, memory);
  const auto weights = hf_inner::mesh::edge_weights(mesh, topology, hf_inner::mesh::OperatorKind::cotangent, memory);
  const auto k = hf_inner::mesh::face_operator(mesh, topology, weights,
                                               hf_inner::mesh::OperatorKind::intrinsic_delaunay, false, memory)
                     .laplacian;
  // the middle vertex sees the four corners alike and the four others alike
  std::vector<double> row(9, 0.0);
  for (std::int32_t i = k.column_start[4]; i < k.column_start[5]; ++i)
    row[static_cast<std::size_t>(k.row[static_cast<std::size_t>(i)])] = k.value[static_cast<std::size_t>(i)];
  for (const int v : {2, 6, 8}) EXPECT_NEAR(row[static_cast<std::size_t>(v)], row[0], 1e-12);
  for (const int v : {3, 5, 7}) EXPECT_NEAR(row[static_cast<std::size_t>(v)], row[1], 1e-12);
}

using Dense = std::vector<std::vector<double>>;
Dense dense(const hf_inner::SymmetricMatrix& k) {
  Dense out(static_cast<std::size_t>(k.size()), std::vector<double>(static_cast<std::size_t>(k.size()), 0.0));
  for (std::size_t v = 0; v < out.size(); ++v) {
    for (std::int32_t i = k.column_start[v]; i < k.column_start[v + 1]; ++i)
      out[v][static_cast<std::size_t>(k.row[static_cast<std::size_t>(i)])] = k.value[static_cast<std::size_t>(i)];
  }
  return out;
}
Dense operator_of(const hf_inner::mesh::Mesh& mesh, hf_inner::Memory& memory) {
  const auto topology = hf_inner::mesh::Topology::make(mesh, memory);
  const auto weights = hf_inner::mesh::edge_weights(mesh, topology, hf_inner::mesh::OperatorKind::cotangent, memory);
  return dense(hf_inner::mesh::face_operator(mesh, topology, weights, hf_inner::mesh::OperatorKind::intrinsic_delaunay,
                                             false, memory)
                   .laplacian);
}

// Weights 4 : 1 of neighbours and diagonals: exact for harmonic polynomials up to the seventh degree.
TEST(FaceOperator, of_flat_squares_has_the_nine_point_weights) {
  hf_inner::Memory memory;
  Sheet sheet(4, 4, 1.0, 0.0);
  for (std::size_t v = 0; v < 25; ++v) sheet.positions[3 * v] = static_cast<double>(v % 5);  // no skew
  const hf_inner::mesh::Mesh mesh = sheet.make(memory);
  const Dense k = operator_of(mesh, memory);
  const double unit = k[12][12];
  for (const std::size_t v : {7u, 11u, 13u, 17u}) EXPECT_NEAR(k[12][v] / unit, -0.2, 1e-12);
  for (const std::size_t v : {6u, 8u, 16u, 18u}) EXPECT_NEAR(k[12][v] / unit, -0.05, 1e-12);
}

// Edges flip across the border of the sheet, so the operator itself need not be exact beside it.
TEST(FaceCorrection, of_a_flat_mesh_keeps_linear_functions_and_lowers_weights_where_it_can) {
  hf_inner::Memory memory;
  using hf_inner::mesh::OperatorKind;
  for (const double length : {0.2, 1.0, 3.0, 9.0}) {
    const Sheet sheet(6, 6, length, 0.0);
    const hf_inner::mesh::Mesh mesh = sheet.make(memory);
    const auto topology = hf_inner::mesh::Topology::make(mesh, memory);
    const auto weights = hf_inner::mesh::edge_weights(mesh, topology, OperatorKind::cotangent, memory);
    const auto cut = hf_inner::mesh::delaunay_operator(mesh, topology, weights, false, memory).laplacian;
    const Dense d = dense(cut), k = dense(hf_inner::mesh::corrected_by_polygons(mesh, cut, memory, nullptr));
    double most = 0;
    for (std::size_t v = 0; v < 49; ++v) {
      double x = 0, y = 0;
      for (std::size_t w = 0; w < 49; ++w) {
        const double change = k[v][w] - d[v][w];
        x += change * sheet.positions[3 * w];
        y += change * sheet.positions[3 * w + 1];
        most = std::max(most, change);
      }
      EXPECT_NEAR(x, 0, 1e-11 * k[v][v]);
      EXPECT_NEAR(y, 0, 1e-11 * k[v][v]);
    }
    if (length == 1) {
      EXPECT_GT(most, 0.05);
    }
  }
}

// Takes faces as lists of points; equal points are one vertex.
Sheet sheet_of(const std::vector<std::vector<Vec3>>& faces) {
  Sheet sheet(0, 0, 1.0, 0.0);
  sheet.positions.clear();
  for (const auto& face : faces) {
    for (const Vec3& p : face) {
      std::size_t v = 0;
      while (3 * v < sheet.positions.size() &&
             std::fabs(sheet.positions[3 * v] - p.x) + std::fabs(sheet.positions[3 * v + 1] - p.y) > 1e-9)
        ++v;
      if (3 * v == sheet.positions.size()) sheet.positions.insert(sheet.positions.end(), {p.x, p.y, p.z});
      sheet.corners.push_back(static_cast<unsigned>(v));
    }
    sheet.sizes.push_back(static_cast<unsigned>(face.size()));
  }
  return sheet;
}

std::vector<Vec3> ngon(int n, double x, double y) {
  std::vector<Vec3> points;
  for (int k = 0; k < n; ++k) {
    const double turn = 2 * M_PI * (k + 0.5) / n;
    points.push_back({x + std::cos(turn), y + std::sin(turn), 0});
  }
  return points;
}

// The matrices before and after the correction, and the largest change of a weight.
double corrected(const Sheet& sheet, Dense& before, Dense& after, hf_inner::Memory& memory) {
  const hf_inner::mesh::Mesh mesh = sheet.make(memory);
  const auto topology = hf_inner::mesh::Topology::make(mesh, memory);
  const auto weights = hf_inner::mesh::edge_weights(mesh, topology, hf_inner::mesh::OperatorKind::cotangent, memory);
  const auto cut = hf_inner::mesh::delaunay_operator(mesh, topology, weights, false, memory).laplacian;
  const auto more = hf_inner::mesh::corrected_by_polygons(mesh, cut, memory, nullptr);
  expect_laplacian(more, true);
  before = dense(cut);
  after = dense(more);
  double most = 0;
  for (std::size_t v = 0; v < after.size(); ++v) {
    for (std::size_t w = 0; w < after.size(); ++w) most = std::max(most, std::fabs(after[v][w] - before[v][w]));
  }
  return most;
}

// A honeycomb: its faces are corrected by their own cuts, which are no quads.
TEST(FaceCorrection, of_hexagons_keeps_linear_functions) {
  hf_inner::Memory memory;
  std::vector<std::vector<Vec3>> faces;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) faces.push_back(ngon(6, std::sqrt(3.0) * (i + 0.5 * j), 1.5 * j));
  }
  const Sheet sheet = sheet_of(faces);
  Dense d, k;
  EXPECT_GT(corrected(sheet, d, k, memory), 0.05);
  for (std::size_t v = 0; v < k.size(); ++v) {
    double x = 0, y = 0;
    for (std::size_t w = 0; w < k.size(); ++w) {
      x += (k[v][w] - d[v][w]) * sheet.positions[3 * w];
      y += (k[v][w] - d[v][w]) * sheet.positions[3 * w + 1];
    }
    EXPECT_NEAR(x, 0, 1e-11);
    EXPECT_NEAR(y, 0, 1e-11);
  }
}

// Nine corners are too many, a U has no point that sees all its sides, a spike ends in a triangle without an area.
TEST(FaceCorrection, leaves_large_faces_and_those_that_are_not_star_shaped) {
  const std::vector<Vec3> u = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  for (const auto& face : {ngon(9, 0, 0), u}) {
    hf_inner::Memory memory;
    Dense d, k;
    EXPECT_EQ(corrected(sheet_of({face}), d, k, memory), 0) << face.size();
  }
}

// Faces of more than 64 corners count as the triangles of their cut.
TEST(PolygonLaplacian, of_a_face_of_many_corners_is_that_of_its_cut) {
  hf_inner::Memory memory;
  const Sheet sheet = sheet_of({ngon(80, 0, 0)});
  const hf_inner::mesh::Mesh mesh = sheet.make(memory);
  const auto k = hf_inner::mesh::polygon_laplacian(mesh, memory);
  const auto topology = hf_inner::mesh::Topology::make(mesh, memory);
  const auto weights = hf_inner::mesh::edge_weights(mesh, topology, hf_inner::mesh::OperatorKind::cotangent, memory);
  const Dense whole = dense(k), cut = dense(hf_inner::mesh::laplacian(topology, weights, memory));
  for (std::size_t v = 0; v < whole.size(); ++v) {
    for (std::size_t w = 0; w < whole.size(); ++w) EXPECT_NEAR(whole[v][w], cut[v][w], 1e-9 * cut[v][v]);
  }
}

// A face whose corners lie on a line has no area: its point is on the line, and the weights give it.
TEST(FacePoint, of_corners_on_a_line_lies_on_it) {
  hf_inner::Memory memory;
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 2, 3}, {3, 6, 9}, {2, 4, 6}};
  hf_inner::Vector<double> weights(&memory);
  const Vec3 p = hf_inner::mesh::face_point(points, weights);
  EXPECT_NEAR(p.y, 2 * p.x, 1e-12);
  EXPECT_NEAR(p.z, 3 * p.x, 1e-12);
  double sum = 0;
  for (const double w : weights) sum += w;
  EXPECT_NEAR(sum, 1, 1e-12);
  hf_inner::mesh::PolygonMatrix matrix(memory);
  matrix.make(points);
  EXPECT_FALSE(matrix.is_star);
}

// Rectangles of ratio r allow 4 / (1 + r^2) of the correction. Taking more, and cutting weights off, would change the
// second moments of the weights, which are twice the area.
TEST(FaceCorrection, of_long_rectangles_takes_what_the_weights_allow) {
  for (const double ratio : {1.0, 2.0, 3.0, 5.0}) {
    hf_inner::Memory memory;
    Sheet sheet(6, 6, ratio, 0.0);
    for (std::size_t v = 0; v < 49; ++v) sheet.positions[3 * v] = ratio * static_cast<double>(v % 7);  // no skew
    const Dense k = operator_of(sheet.make(memory), memory);
    double across = 0, along = 0;
    for (std::size_t v = 0; v < 49; ++v) {
      const double x = sheet.positions[3 * v] - 3 * ratio, y = sheet.positions[3 * v + 1] - 3;
      along -= k[24][v] * x * x;
      across -= k[24][v] * y * y;
    }
    EXPECT_NEAR(along, 2 * ratio, 1e-10 * ratio) << ratio;
    EXPECT_NEAR(across, 2 * ratio, 1e-10 * ratio) << ratio;
    const double part = std::min(2.0 / 3, 4 / (1 + ratio * ratio));
    EXPECT_NEAR(k[24][25], -(1 - part * (1 + ratio * ratio) / 4) / ratio, 1e-12) << ratio;
  }
}

// The weights of one quad alone: flat, they are those of its Delaunay cut, whichever diagonal it was cut along.
TEST(FaceCorrection, a_flat_quad_has_the_weights_of_its_delaunay_cut) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> number(-0.3, 0.3);
    Vec3 p[4] = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}};
    for (Vec3& q : p) {
      q.x += number(engine);
      q.y += number(engine);
    }
    const Vec3 turned[4] = {p[1], p[2], p[3], p[0]};
    double a[6], b[6];
    hf_inner::mesh::quad_weights(p, a);
    hf_inner::mesh::quad_weights(turned, b);
    const std::size_t next[6] = {3, 4, 0, 5, 1, 2};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a[next[k]], b[k], 1e-12);
    EXPECT_GE(a[1], 0);
    EXPECT_GE(a[4], 0);
    EXPECT_TRUE(a[1] == 0 || a[4] == 0);
  }
}

}  // namespace
