// Faces that lie on a line: those that join nothing are left out, those that shut a T-junction stay.
#include "mesh/line_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/meshes.h"

namespace {

using Triangle = std::vector<std::uint32_t>;

constexpr std::uint32_t around = 12, along = 9;

// A tube of rings. Vertices of one number in the rings lie on a line.
hf_test::PlainMesh tube() {
  hf_test::PlainMesh mesh;
  for (std::uint32_t r = 0; r < along; ++r) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double turn = 2 * M_PI * i / around;
      mesh.positions.insert(mesh.positions.end(), {std::cos(turn), 0.4 * r, std::sin(turn)});
    }
  }
  for (std::uint32_t r = 0; r + 1 < along; ++r) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = r * around + i, b = r * around + (i + 1) % around;
      mesh.triangles.insert(mesh.triangles.end(), {a, a + around, b, b, a + around, b + around});
    }
  }
  return mesh;
}

hf_test::PlainMesh with(hf_test::PlainMesh mesh, const Triangle& more) {
  mesh.triangles.insert(mesh.triangles.end(), more.begin(), more.end());
  return mesh;
}

hf_inner::mesh::MeshInput input_of(const hf_test::PlainMesh& mesh) {
  hf_inner::mesh::MeshInput input;
  input.vertex_count = mesh.vertex_count();
  input.triangle_count = mesh.triangle_count();
  input.positions = hf_inner::ConstRows(mesh.positions.data(), 3 * sizeof(double));
  input.triangles = hf_inner::IndexRows(mesh.triangles.data(), 3);
  return input;
}

hf_inner::mesh::Mesh made(const hf_test::PlainMesh& mesh, hf_inner::Memory& memory) {
  return hf_inner::mesh::Mesh::make(input_of(mesh), memory);
}

void expect_left_out(const hf_test::PlainMesh& plain, const hf_test::PlainMesh& more, std::uint32_t count) {
  hf_inner::Memory memory;
  const hf_inner::mesh::Mesh without = made(plain, memory), mesh = made(more, memory);
  EXPECT_EQ(std::vector<std::int32_t>(mesh.corners.begin(), mesh.corners.end()),
            std::vector<std::int32_t>(without.corners.begin(), without.corners.end()));
  EXPECT_EQ(mesh.report.collapsed_triangle_count, without.report.collapsed_triangle_count + count);
  EXPECT_EQ(mesh.report.duplicate_triangle_count, without.report.duplicate_triangle_count);
  EXPECT_EQ(mesh.report.degenerate_triangle_count, without.report.degenerate_triangle_count);
  EXPECT_TRUE(mesh.doubled.empty());
  for (std::size_t t = 0; t < mesh.triangle_of_given.size(); ++t) {
    const bool usable = t < plain.triangles.size() / 3;
    EXPECT_EQ(mesh.triangle_of_given[t], usable ? static_cast<std::int32_t>(t) : hf_inner::mesh::Mesh::none) << t;
  }
}

TEST(LineFaces, a_flap_over_three_vertices_of_a_line_is_left_out) {
  expect_left_out(tube(), with(tube(), {0, around, 2 * around}), 1);
  expect_left_out(tube(), with(tube(), {5, 6 * around + 5, 2 * around + 5}), 1);  // no edge of the tube
}

TEST(LineFaces, a_flap_that_is_listed_again_is_left_out_with_its_copies) {
  expect_left_out(tube(), with(tube(), {0, around, 2 * around, around, 0, 2 * around, 0, around, 2 * around}), 3);
}

TEST(LineFaces, a_fan_of_flaps_is_left_out_as_a_whole_in_any_order) {
  const Triangle fan = {0, around, 2 * around, 0, 2 * around, 3 * around, 0, 3 * around, 5 * around};
  for (std::size_t first = 0; first < 3; ++first) {
    Triangle turned = fan;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(3 * first), turned.end());
    expect_left_out(tube(), with(tube(), turned), 3);
  }
}

TEST(LineFaces, a_flap_whose_vertices_were_rounded_to_floats_is_left_out) {
  hf_test::PlainMesh mesh = tube();
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {  // no line along an axis
    const double x = mesh.positions[i], y = mesh.positions[i + 1];
    mesh.positions[i] = static_cast<float>(0.36 * x - 0.93 * y);
    mesh.positions[i + 1] = static_cast<float>(0.93 * x + 0.36 * y);
  }
  expect_left_out(mesh, with(mesh, {0, around, 2 * around}), 1);
}

TEST(LineFaces, a_thin_border_with_vertices_of_its_own_stays) {
  hf_inner::Memory memory;
  hf_test::PlainMesh mesh = tube();
  mesh.positions.insert(mesh.positions.end(), {1, -1, 0});  // on the line of the vertices 0, 12, 24
  const hf_inner::mesh::Mesh spiked = made(with(mesh, {0, around, mesh.vertex_count() - 1}), memory);
  EXPECT_EQ(spiked.report.collapsed_triangle_count, 0u);
  EXPECT_EQ(spiked.report.isolated_vertex_count, 0u);
  hf_test::PlainMesh squeezed = hf_test::grid(6, 4);
  for (std::size_t i = 1; i < squeezed.positions.size(); i += 3) squeezed.positions[i] *= 1e-7;
  EXPECT_EQ(made(squeezed, memory).report.collapsed_triangle_count, 0u);
}

// A square of 6 x 6 with the middle of one edge as a vertex of the upper side alone; a sliver shuts the junction.
struct Junction {
  hf_test::PlainMesh open = hf_test::grid(6, 6), shut, cut;
  std::uint32_t middle = 0;
  Junction() {
    // the edge between two vertices of one row, and the triangles on it
    const std::uint32_t a = 3 * 7 + 2, b = a + 1;
    middle = open.vertex_count();
    open.positions.insert(open.positions.end(), {2.5, 3, 0});
    cut = open;
    std::uint32_t above = 0, below = 0;
    for (std::uint32_t t = 0; t < open.triangle_count(); ++t) {
      const std::uint32_t* v = &open.triangles[3 * t];
      if (std::count(v, v + 3, a) + std::count(v, v + 3, b) < 2) continue;
      for (int k = 0; k < 3; ++k) {
        if (v[k] != a && v[k] != b) (v[k] > b ? above : below) = t;
      }
    }
    split(open, above, a, b);
    shut = with(open, {a, b, middle});
    split(cut, above, a, b);
    split(cut, below, a, b);
  }

 private:
  void split(hf_test::PlainMesh& mesh, std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    Triangle other(mesh.triangles.begin() + 3 * t, mesh.triangles.begin() + 3 * t + 3);
    std::replace(other.begin(), other.end(), a, middle);
    std::replace(mesh.triangles.begin() + 3 * t, mesh.triangles.begin() + 3 * t + 3, b, middle);
    mesh.triangles.insert(mesh.triangles.end(), other.begin(), other.end());
  }
};

TEST(LineFaces, a_sliver_that_shuts_a_junction_stays) {
  hf_inner::Memory memory;
  const Junction junction;
  const hf_inner::mesh::Mesh shut = made(junction.shut, memory);
  EXPECT_EQ(shut.report.collapsed_triangle_count, 0u);
  EXPECT_EQ(shut.report.degenerate_triangle_count, 1u);
  EXPECT_EQ(shut.triangle_count(), made(junction.open, memory).triangle_count() + 1);
  // a flap over the sliver goes, and the sliver stays
  const std::uint32_t a = 3 * 7 + 2, far_left = 3 * 7;
  const hf_inner::mesh::Mesh both = made(with(junction.shut, {far_left, a, a + 1}), memory);
  EXPECT_EQ(both.report.collapsed_triangle_count, 1u);
  EXPECT_EQ(both.triangle_count(), shut.triangle_count());
}

TEST(LineFaces, a_polygon_on_a_line_is_left_out_if_it_joins_nothing) {
  const auto report = [](const std::vector<std::vector<std::uint32_t>>& more) {
    const hf_test::PlainMesh mesh = hf_test::grid(6, 6);
    std::vector<std::uint32_t> corners = mesh.triangles, sizes(mesh.triangle_count(), 3);
    for (const auto& face : more) {
      corners.insert(corners.end(), face.begin(), face.end());
      sizes.push_back(static_cast<std::uint32_t>(face.size()));
    }
    hf_inner::mesh::MeshInput input = input_of(mesh);
    input.triangles = {};
    input.triangle_count = 0;
    input.faces.sizes = hf_inner::IndexRows(sizes.data(), 1);
    input.faces.corners = hf_inner::IndexRows(corners.data(), 1);
    input.faces.face_count = static_cast<std::uint32_t>(sizes.size());
    input.faces.corner_count = static_cast<std::uint32_t>(corners.size());
    hf_inner::Memory memory;
    const hf_inner::mesh::Mesh made = hf_inner::mesh::Mesh::make(input, memory);
    EXPECT_EQ(made.triangle_of_given.size(), sizes.size());
    EXPECT_EQ(made.faces.count(), 72 + static_cast<std::int32_t>(more.size()) -
                                      static_cast<std::int32_t>(made.report.collapsed_triangle_count));
    return made.report;
  };
  EXPECT_EQ(report({{7, 8, 9, 10}}).collapsed_triangle_count, 1u);
  EXPECT_EQ(report({{7, 8, 9, 10}, {14, 15, 16, 17, 18}, {7, 11, 10}}).collapsed_triangle_count, 3u);
}

}  // namespace
