// Distances where triangles lie on each other, where many share an edge, and from many sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/index.h"
#include "mesh/exact_path.h"
#include "mesh/front_distance.h"
#include "support/meshes.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::norm;
using hf_test::PlainMesh;

// A mesh that keeps the numbers of its vertices, with its tables. Lengths are in box diagonals.
struct Shape {
  explicit Shape(const PlainMesh& plain)
      : mesh(make(plain, memory)),
        topology(hf_inner::mesh::Topology::make(mesh, memory)),
        sides(mesh, topology, memory) {}
  static hf_inner::mesh::Mesh make(const PlainMesh& plain, hf_inner::Memory& memory) {
    hf_inner::mesh::MeshInput input;
    input.vertex_count = plain.vertex_count();
    input.triangle_count = plain.triangle_count();
    input.positions = hf_inner::ConstRows(plain.positions.data(), 3 * sizeof(double));
    input.triangles = hf_inner::IndexRows(plain.triangles.data(), 3);
    input.weld = hf_inner::mesh::Weld::none;
    return hf_inner::mesh::Mesh::make(input, memory);
  }
  hf_inner::mesh::ExactDistance exact(const std::vector<Index>& given, std::uint64_t most_windows = 0) {
    const std::vector<Index> sources = inner(given);
    hf_inner::mesh::ExactTask task;
    task.sources = sources;
    task.most_windows = most_windows;
    return hf_inner::mesh::exact_distance(sides, task, memory);
  }
  std::vector<double> front(const std::vector<Index>& given) {
    const std::vector<Index> sources = inner(given);
    std::vector<double> d(mesh.positions.size());
    hf_inner::mesh::FrontDistance(mesh, topology, memory).distance(sources, d.data());
    return d;
  }
  std::vector<Index> inner(std::vector<Index> given) const {
    for (Index& v : given) v = mesh.inner_of_given[at(v)];
    return given;
  }
  double line(Index v, const std::vector<Index>& given) const {
    double least = 1e300;
    for (const Index s : inner(given)) least = std::min(least, norm(mesh.positions[at(v)] - mesh.positions[at(s)]));
    return least;
  }
  hf_inner::mesh::GeodesicPoint point(const Index* corners, const double* weights) {
    return hf_inner::mesh::GeodesicPoint(sides, corners, weights, memory);
  }
  hf_inner::Memory memory;
  hf_inner::mesh::Mesh mesh;
  hf_inner::mesh::Topology topology;
  hf_inner::mesh::TriangleSides sides;
};

PlainMesh bumpy_sheet(std::uint32_t n) {
  PlainMesh mesh = hf_test::grid(n, n, 1, 0.25, 3);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
    mesh.positions[v + 2] = 0.7 * std::sin(mesh.positions[v]) * std::cos(mesh.positions[v + 1]);
  return mesh;
}

// The sheet with `copies` more triangles for each of the first `share` of them, every other one turned over.
PlainMesh with_copies(PlainMesh mesh, int copies, double share) {
  const std::size_t count = mesh.triangles.size() / 3;
  for (std::size_t t = 0; t < static_cast<std::size_t>(share * static_cast<double>(count)); ++t) {
    for (int k = 0; k < copies; ++k) {
      const std::uint32_t a = mesh.triangles[3 * t], b = mesh.triangles[3 * t + 1], c = mesh.triangles[3 * t + 2];
      if (k % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {b, a, c});
      else
        mesh.triangles.insert(mesh.triangles.end(), {b, c, a});
    }
  }
  return mesh;
}

TEST(ExactDistance, of_a_two_sided_sheet_is_that_of_the_single_one) {
  const PlainMesh single = bumpy_sheet(20);
  Shape one(single);
  for (const auto& [copies, share] : {std::pair<int, double>{1, 1.0}, {2, 1.0}, {1, 0.5}, {3, 0.1}}) {
    Shape several(with_copies(single, copies, share));
    for (const std::vector<Index>& sources : {std::vector<Index>{0}, {220}, {7, 300, 431}}) {
      const auto expected = one.exact(sources), found = several.exact(sources);
      for (Index v = 0; v < one.mesh.vertex_count(); ++v)
        ASSERT_NEAR(found.distance[at(v)], expected.distance[at(v)], 1e-14) << copies << ", " << share;
      EXPECT_EQ(found.window_count, expected.window_count) << "a copy makes windows";
    }
  }
}

TEST(ShortestPath, and_maps_of_a_two_sided_sheet_are_those_of_the_single_one) {
  const PlainMesh single = bumpy_sheet(12);
  Shape one(single), two(with_copies(single, 1, 1));
  const double weights[3] = {0.2, 0.3, 0.5};
  for (const Index t : {0, 77, 287}) {
    for (const Index u : {5, 131, 250}) {
      const auto path = [&](Shape& shape) {
        return hf_inner::mesh::shortest_path(shape.sides, shape.point(shape.mesh.triangle(t), weights),
                                             shape.point(shape.mesh.triangle(u), weights), shape.memory);
      };
      const auto expected = path(one), found = path(two);
      EXPECT_NEAR(found.length, expected.length, 1e-14);
      EXPECT_EQ(found.points.size(), expected.points.size());
    }
    const auto map = [&](Shape& shape) {
      const auto from = shape.point(shape.mesh.triangle(t), weights);
      hf_inner::mesh::ExactTask task;
      task.from = &from;
      task.directions = true;
      return hf_inner::mesh::exact_distance(shape.sides, task, shape.memory);
    };
    const auto expected = map(one), found = map(two);
    for (std::size_t v = 0; v < expected.direction.size(); ++v)
      ASSERT_NEAR(found.direction[v], expected.direction[v], 1e-9);
  }
}

// Each quad of the second side has the other diagonal, so no two triangles are the same.
PlainMesh card_of_other_diagonals(std::uint32_t n) {
  PlainMesh mesh = hf_test::grid(n, n, 1, 0.25, 3);
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      if ((i + j) % 2)
        mesh.triangles.insert(mesh.triangles.end(), {b, a, c, d, b, c});
      else
        mesh.triangles.insert(mesh.triangles.end(), {b, a, d, d, a, c});
    }
  }
  return mesh;
}

TEST(ExactDistance, on_a_flat_card_of_two_triangulations_is_the_straight_line_with_few_windows) {
  Shape single(hf_test::grid(30, 30, 1, 0.25, 3)), card(card_of_other_diagonals(30));
  for (const Index s : {0, 480, 960}) {
    const auto found = card.exact({s});
    for (Index v = 0; v < card.mesh.vertex_count(); ++v) ASSERT_NEAR(found.distance[at(v)], card.line(v, {s}), 1e-11);
    // two sheets of windows, and parts where their triangles differ
    EXPECT_LT(found.window_count, 12 * single.exact({s}).window_count);
  }
}

TEST(ExactDistance, of_a_book_and_of_cells_takes_few_windows) {
  PlainMesh book = hf_test::grid(2, 20);  // 30 pages on the edges of one spine
  const std::uint32_t first = book.vertex_count();
  for (std::uint32_t page = 0; page < 30; ++page) {
    for (std::uint32_t j = 0; j <= 20; ++j)
      book.positions.insert(book.positions.end(), {std::cos(0.2 * page), 1.0 * j, std::sin(0.2 * page) + 0.1});
    for (std::uint32_t j = 0; j < 20; ++j) {
      const std::uint32_t a = 3 * j, b = a + 3, c = first + page * 21 + j, d = c + 1;
      book.triangles.insert(book.triangles.end(), {a, b, c, b, d, c});
    }
  }
  // walls between the cells of a block: inner edges have four walls, of two triangles each
  PlainMesh cells;
  const std::uint32_t n = 6;
  const auto corner = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return (z * n + y) * n + x; };
  for (std::uint32_t z = 0; z < n; ++z)
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) cells.positions.insert(cells.positions.end(), {1.0 * x, 1.0 * y, 1.0 * z});
  const std::uint32_t steps[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  for (std::uint32_t i = 0; i < n * n * n; ++i) {
    const std::uint32_t x = i % n, y = i / n % n, z = i / n / n;
    for (int k = 0; k < 3; ++k) {
      const auto *p = steps[k], *q = steps[k + 1];
      if (x + p[0] + q[0] >= n || y + p[1] + q[1] >= n || z + p[2] + q[2] >= n) continue;
      const std::uint32_t a = corner(x, y, z), b = corner(x + p[0], y + p[1], z + p[2]),
                          c = corner(x + q[0], y + q[1], z + q[2]),
                          d = corner(x + p[0] + q[0], y + p[1] + q[1], z + p[2] + q[2]);
      cells.triangles.insert(cells.triangles.end(), {a, b, c, b, d, c});
    }
  }
  for (const PlainMesh& mesh : {book, cells}) {
    Shape shape(mesh);
    const auto found = shape.exact({0});
    const double triangles = shape.mesh.triangle_count();
    EXPECT_LT(static_cast<double>(found.window_count), 10 * triangles * std::sqrt(triangles));
    for (Index v = 0; v < shape.mesh.vertex_count(); ++v) {
      ASSERT_GE(found.distance[at(v)], shape.line(v, {0}) - 1e-13);
      ASSERT_NEAR(shape.exact({v}).distance[0], found.distance[at(v)], 1e-11) << "the way back is longer";
      if (v > 20) v += 40;
    }
  }
}

TEST(ExactDistance, on_a_thousand_pages_takes_some_windows_a_page) {
  PlainMesh book;
  book.positions = {0, 0, 0, 0, 0, 1};
  for (std::uint32_t page = 0; page < 1000; ++page) {
    const double angle = 0.006 * page, height = 0.5 + 0.4 * std::sin(7.0 * page);
    book.positions.insert(book.positions.end(), {std::cos(angle), std::sin(angle), height});
    book.triangles.insert(book.triangles.end(), {0, 1, 2 + page});
  }
  Shape shape(book);
  for (const Index s : {0, 1, 2, 500}) {
    const auto found = shape.exact({s});
    EXPECT_LT(found.window_count, 20000u) << s;
    for (Index v = 0; v < shape.mesh.vertex_count(); ++v) ASSERT_GE(found.distance[at(v)], shape.line(v, {s}) - 1e-14);
  }
}

TEST(ExactDistance, beyond_the_windows_of_a_task_is_refused_by_name_with_nothing_left_allocated) {
  Shape shape(bumpy_sheet(20));
  const std::uint64_t before = shape.memory.live_bytes(), enough = shape.exact({0}).window_count;
  EXPECT_NO_THROW(shape.exact({0}, enough));
  try {
    shape.exact({0}, enough - 1);
    FAIL() << "not refused";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_TOO_LARGE);
    EXPECT_NE(std::string(error.what()).find("HF_GEODESICS_FRONT"), std::string::npos) << error.what();
  }
  EXPECT_EQ(shape.memory.live_bytes(), before);
}

TEST(GeodesicPoint, in_a_triangle_of_two_equal_corners_is_on_the_edge_between_them) {
  Shape shape(hf_test::grid(1, 1));
  const Index order[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double weights[3][3] = {{0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5}};
  const Index origin[3] = {0, -1, -1};
  const double whole[3] = {1, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const auto point = shape.point(order[k], weights[k]);
    ASSERT_TRUE(point.found());
    const double half = 0.5 * norm(shape.mesh.positions[1] - shape.mesh.positions[0]);
    EXPECT_NEAR(norm(point.position(shape.mesh) - shape.mesh.positions[0]), half, 1e-15);
    const auto there = hf_inner::mesh::shortest_path(shape.sides, point, shape.point(origin, whole), shape.memory);
    const auto back = hf_inner::mesh::shortest_path(shape.sides, shape.point(origin, whole), point, shape.memory);
    EXPECT_NEAR(there.length, half, 1e-15);
    EXPECT_NEAR(back.length, half, 1e-15);
  }
  const Index same[3] = {2, 2, 2};
  EXPECT_EQ(shape.point(same, weights[0]).vertex, 2);
}

std::vector<Index> border_of(std::uint32_t n) {
  std::vector<Index> border;
  for (Index v = 0; v < static_cast<Index>((n + 1) * (n + 1)); ++v) {
    const Index i = v % static_cast<Index>(n + 1), j = v / static_cast<Index>(n + 1);
    if (i == 0 || j == 0 || i == static_cast<Index>(n) || j == static_cast<Index>(n)) border.push_back(v);
  }
  return border;
}

TEST(FrontDistance, from_a_whole_border_is_never_below_the_straight_line_and_near_the_exact_one) {
  for (const double jitter : {0.0, 0.3}) {
    for (const double height : {0.0, 1.0}) {
      PlainMesh mesh = hf_test::grid(60, 60, 1, jitter, 5);
      for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
        mesh.positions[v + 2] = height * std::sin(0.3 * mesh.positions[v]) * std::cos(0.3 * mesh.positions[v + 1]);
      Shape shape(mesh);
      const std::vector<Index> border = border_of(60);
      const auto exact = shape.exact(border).distance;
      const auto d = shape.front(border);
      double sum = 0, largest = 0;
      for (Index v = 0; v < shape.mesh.vertex_count(); ++v) {
        ASSERT_GE(d[at(v)], shape.line(v, border)) << v;
        ASSERT_GE(exact[at(v)], shape.line(v, border) - 1e-14) << v;
        if (height == 0 && jitter == 0) {
          ASSERT_NEAR(d[at(v)], exact[at(v)], 1e-13) << v;
        }
        sum += std::fabs(d[at(v)] - exact[at(v)]);
        largest = std::max(largest, exact[at(v)]);
      }
      EXPECT_LT(sum / shape.mesh.vertex_count(), 0.01 * largest);
    }
  }
}

TEST(FrontDistance, from_scattered_sources_is_never_below_the_straight_line_and_near_the_exact_one) {
  Shape shape(hf_test::torus(90, 60));
  for (const std::uint32_t count : {1u, 2u, 10u, 100u, 1000u}) {
    std::mt19937 random(count);
    std::vector<Index> sources;
    for (std::uint32_t k = 0; k < count; ++k) sources.push_back(static_cast<Index>(random() % 5400));
    const auto exact = shape.exact(sources).distance;
    const auto d = shape.front(sources);
    double sum = 0, largest = 0;
    for (Index v = 0; v < shape.mesh.vertex_count(); ++v) {
      ASSERT_GE(d[at(v)], shape.line(v, sources)) << v;
      sum += std::fabs(d[at(v)] - exact[at(v)]);
      largest = std::max(largest, exact[at(v)]);
    }
    EXPECT_LT(sum / shape.mesh.vertex_count(), 0.01 * largest) << count;
  }
}

}  // namespace
