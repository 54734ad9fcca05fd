// Intake: welding, components, the repair report, and what is refused.
#include "mesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "base/error.h"
#include "mesh/topology.h"
#include "support/meshes.h"

namespace {

struct Given {
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;
  hf_inner::mesh::Weld weld = hf_inner::mesh::Weld::exact;
  double tolerance = 0;

  hf_inner::mesh::Mesh make(hf_inner::Memory& memory) const {
    hf_inner::mesh::MeshInput input;
    input.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    input.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
    input.positions = hf_inner::ConstRows(positions.data(), 3 * sizeof(double));
    input.triangles = hf_inner::IndexRows(triangles.data(), 3);
    input.weld = weld;
    input.weld_tolerance = tolerance;
    hf_inner::mesh::Mesh mesh = hf_inner::mesh::Mesh::make(input, memory);
    hf_inner::mesh::count_edges(hf_inner::mesh::Topology::make(mesh, memory), mesh.report);
    return mesh;
  }
  hf_result code(std::uint32_t* index = nullptr) const {
    hf_inner::Memory memory;
    try {
      make(memory);
    } catch (const hf_inner::Error& error) {
      if (index) *index = error.index();
      return error.code();
    }
    return HF_OK;
  }
};

// two triangles of a square, cut along the diagonal: vertices 3 and 5 are copies of 0 and 2
Given cut_square() { return {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0.0, -0.0, 0, 0, 1, 0, 1, 1, 0}, {0, 1, 2, 3, 5, 4}}; }

TEST(Mesh, welds_bit_equal_copies_into_one_vertex) {
  hf_inner::Memory memory;
  const hf_inner::mesh::Mesh mesh = cut_square().make(memory);
  EXPECT_EQ(mesh.vertex_count(), 4);
  EXPECT_EQ(mesh.report.component_count, 1u);
  EXPECT_EQ(mesh.inner_of_given[0], mesh.inner_of_given[3]);
  EXPECT_EQ(mesh.inner_of_given[2], mesh.inner_of_given[5]);
  EXPECT_EQ(mesh.report.boundary_edge_count, 4u);
}

TEST(Mesh, keeps_vertices_as_stored_when_told_so) {
  hf_inner::Memory memory;
  Given given = cut_square();
  given.weld = hf_inner::mesh::Weld::none;
  const hf_inner::mesh::Mesh mesh = given.make(memory);
  EXPECT_EQ(mesh.vertex_count(), 6);
  EXPECT_EQ(mesh.report.component_count, 2u);
}

// Places made to share one slot of the table that finds equal ones (weld.cpp): it gives up, and sorting finds the same.
TEST(Mesh, welds_places_that_were_made_to_collide) {
  const auto hash = [](const double* p) {
    std::uint64_t b[3];
    std::memcpy(b, p, sizeof b);
    std::uint64_t h = b[0] * 0x9e3779b97f4a7c15u;
    h = ((h ^ (h >> 29)) + b[1]) * 0xbf58476d1ce4e5b9u;
    h = ((h ^ (h >> 32)) + b[2]) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
  };
  constexpr std::uint32_t places = 600;
  Given given;
  std::mt19937 random(5);
  for (std::uint32_t v = 0; v < places; ++v) {
    double p[3] = {double(v % 5), double(v / 5 % 3), 0};
    do p[2] = double(random()) / 4294967296.0;
    while (hash(p) % 4096 > 3);
    given.positions.insert(given.positions.end(), p, p + 3);
  }
  // every place twice, the copies in the other order; one triangle on each pair of neighbours and their copies
  for (std::uint32_t v = 0; v < places; ++v) {
    for (std::size_t k = 0; k < 3; ++k) given.positions.push_back(given.positions[3 * (places - 1 - v) + k]);
  }
  for (std::uint32_t v = 0; v + 2 < places; ++v)
    given.triangles.insert(given.triangles.end(), {v, 2 * places - 2 - v, v + 2});
  hf_inner::Memory memory;
  const hf_inner::mesh::Mesh mesh = given.make(memory);
  EXPECT_EQ(mesh.vertex_count(), static_cast<std::int32_t>(places));
  EXPECT_EQ(mesh.report.component_count, 1u);
  for (std::uint32_t v = 0; v < places; ++v)
    EXPECT_EQ(mesh.inner_of_given[v], mesh.inner_of_given[2 * places - 1 - v]) << v;
}

TEST(Mesh, welds_within_a_tolerance_across_cell_borders) {
  hf_inner::Memory memory;
  Given given = cut_square();
  given.positions[9] = -0.0007;
  given.positions[15] = 1.0006;
  EXPECT_EQ(given.make(memory).report.component_count, 2u);
  given.weld = hf_inner::mesh::Weld::tolerance;
  given.tolerance = 0.001;
  EXPECT_EQ(given.make(memory).report.component_count, 1u);
  given.tolerance = 0.0005;
  EXPECT_EQ(given.make(memory).report.component_count, 2u);
  given.tolerance = -1;
  EXPECT_EQ(given.code(), HF_ERROR_INVALID_ARGUMENT);
}

TEST(Mesh, counts_what_is_dirty) {
  hf_inner::Memory memory;
  // three pages on one edge, one of them flipped; a duplicate; a collapsed and a zero-area triangle; an isolated vertex
  const Given given{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 9, 9, 9, 2, 0, 0},
                    {0, 1, 2, 0, 1, 3, 1, 0, 4, 2, 0, 1, 3, 3, 4, 0, 1, 6}};
  const hf_inner::mesh::Mesh mesh = given.make(memory);
  EXPECT_EQ(mesh.report.isolated_vertex_count, 1u);
  EXPECT_EQ(mesh.inner_of_given[5], hf_inner::mesh::Mesh::none);
  EXPECT_EQ(mesh.report.collapsed_triangle_count, 1u);
  EXPECT_EQ(mesh.report.degenerate_triangle_count, 1u);
  EXPECT_EQ(mesh.report.duplicate_triangle_count, 1u);
  EXPECT_EQ(mesh.report.non_manifold_edge_count, 1u);
  EXPECT_GE(mesh.report.flipped_edge_count, 1u);
}

// One of the three neighbours of the middle triangle runs against the other two.
TEST(Mesh, a_two_sided_face_follows_most_of_its_neighbours) {
  const std::vector<double> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, -1, 1, 0, 1, -1, 0};
  const std::vector<std::uint32_t> neighbour[] = {{2, 1, 3}, {0, 2, 4}, {1, 0, 5}};
  for (int against = 0; against < 3; ++against) {
    for (const bool back_first : {false, true}) {
      Given given{positions, back_first ? std::vector<std::uint32_t>{1, 0, 2, 0, 1, 2}
                                        : std::vector<std::uint32_t>{0, 1, 2, 1, 0, 2}};
      for (int i = 0; i < 3; ++i) {
        std::vector<std::uint32_t> own = neighbour[i];
        if (i == against) std::swap(own[0], own[1]);
        given.triangles.insert(given.triangles.end(), own.begin(), own.end());
      }
      hf_inner::Memory memory;
      EXPECT_EQ(given.make(memory).report.flipped_edge_count, 1u) << against << back_first;
    }
  }
}

TEST(Mesh, numbers_components_by_their_first_vertex) {
  hf_inner::Memory memory;
  hf_test::PlainMesh plain = hf_test::grid(2, 2);
  append(plain, hf_test::grid(1, 1), 10);
  const hf_inner::mesh::Mesh mesh = Given{plain.positions, plain.triangles}.make(memory);
  EXPECT_EQ(mesh.report.component_count, 2u);
  EXPECT_EQ(mesh.component.front(), 0);
  EXPECT_EQ(mesh.component.back(), 1);
}

TEST(Mesh, refuses_what_it_cannot_take_and_names_it) {
  std::uint32_t index = 0;
  Given given = cut_square();
  given.triangles[4] = 6;
  EXPECT_EQ(given.code(&index), HF_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(index, 1u);
  given = cut_square();
  given.positions[7] = std::nan("");
  EXPECT_EQ(given.code(&index), HF_ERROR_NON_FINITE);
  EXPECT_EQ(index, 2u);
  given.positions[7] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(given.code(), HF_ERROR_NON_FINITE);
  given = cut_square();
  given.triangles = {0, 0, 1};
  EXPECT_EQ(given.code(), HF_ERROR_EMPTY);
  given.triangles.clear();
  EXPECT_EQ(given.code(), HF_ERROR_EMPTY);
}

// A vertex that is left over in a file: far away or near, first or last, in no triangle or in one of equal corners.
TEST(Mesh, a_vertex_without_a_triangle_changes_nothing) {
  hf_inner::Memory memory;
  const hf_test::PlainMesh plain = hf_test::torus(12, 8);
  const hf_inner::mesh::Mesh first = Given{plain.positions, plain.triangles}.make(memory);
  for (const double far : {1e5, -3.0, 0.01, 1.7e308}) {
    for (const bool in_front : {true, false}) {
      for (const bool collapsed : {true, false}) {
        Given given{plain.positions, plain.triangles};
        const std::uint32_t stray = in_front ? 0 : plain.vertex_count();
        const double place[3] = {far, -far, far};
        given.positions.insert(given.positions.begin() + 3 * static_cast<std::ptrdiff_t>(stray), place, place + 3);
        for (std::uint32_t& corner : given.triangles) corner += in_front;
        if (collapsed) given.triangles.insert(given.triangles.end(), {stray, stray, given.triangles[0]});
        const hf_inner::mesh::Mesh mesh = given.make(memory);
        ASSERT_EQ(mesh.positions.size(), first.positions.size());
        EXPECT_EQ(
            std::memcmp(mesh.positions.data(), first.positions.data(), sizeof(hf_inner::Vec3) * mesh.positions.size()),
            0);
        EXPECT_EQ(std::memcmp(&mesh.centre, &first.centre, sizeof mesh.centre), 0);
        EXPECT_EQ(mesh.scale, first.scale);
        EXPECT_EQ(mesh.report.bounding_box_diagonal, first.report.bounding_box_diagonal);
        EXPECT_EQ(mesh.report.isolated_vertex_count, 1u);
        EXPECT_EQ(mesh.isolated[0].given, static_cast<std::int32_t>(stray));
        EXPECT_EQ(mesh.isolated[0].position.x, far);
      }
    }
  }
}

// Squares of numbers of 1e200 leave the range of double: faces are cut in the frame of the surface, and a vertex that
// no face has is no part of it.
TEST(Mesh, faces_are_cut_alike_in_any_unit_and_beside_a_vertex_that_no_face_has) {
  std::vector<double> positions;
  std::vector<std::uint32_t> corners, sizes;
  constexpr std::uint32_t columns = 6;
  for (std::uint32_t i = 0; i < columns; ++i) {
    positions.insert(positions.end(), {1.0 * i, 0.1 * i * i, 0.3 * (i % 2)});
    positions.insert(positions.end(), {1.1 * i, 1.0 + 0.2 * i, 0});
    if (i > 0) {
      corners.insert(corners.end(), {2 * i - 2, 2 * i, 2 * i + 1, 2 * i - 1});
      sizes.push_back(4);
    }
  }
  std::vector<std::int32_t> expected;
  std::uint32_t bent = 0;
  for (const double unit : {1.0, 1e200, 1e-200}) {
    for (const double stray : {0.5, 1e5, 1e300}) {
      std::vector<double> moved = positions;
      for (double& x : moved) x *= unit;
      moved.insert(moved.end(), {stray, stray, stray});
      hf_inner::mesh::MeshInput input;
      input.vertex_count = static_cast<std::uint32_t>(moved.size() / 3);
      input.positions = hf_inner::ConstRows(moved.data(), 3 * sizeof(double));
      input.faces.face_count = static_cast<std::uint32_t>(sizes.size());
      input.faces.corner_count = static_cast<std::uint32_t>(corners.size());
      input.faces.sizes = hf_inner::IndexRows(sizes.data(), 1);
      input.faces.corners = hf_inner::IndexRows(corners.data(), 1);
      hf_inner::Memory memory;
      const hf_inner::mesh::Mesh mesh = hf_inner::mesh::Mesh::make(input, memory);
      if (expected.empty()) {
        expected.assign(mesh.corners.begin(), mesh.corners.end());
        bent = mesh.faces.non_planar_count;
      }
      EXPECT_EQ(std::vector<std::int32_t>(mesh.corners.begin(), mesh.corners.end()), expected) << unit << " " << stray;
      EXPECT_EQ(mesh.faces.non_planar_count, bent);
      EXPECT_EQ(mesh.report.isolated_vertex_count, 1u);
      EXPECT_LT(mesh.scale, 10 * unit);
    }
  }
  EXPECT_GT(bent, 0u);
}

TEST(Mesh, is_the_same_at_any_scale_and_place) {
  hf_inner::Memory memory;
  const hf_test::PlainMesh plain = hf_test::torus(12, 8);
  const hf_inner::mesh::Mesh first = Given{plain.positions, plain.triangles}.make(memory);
  for (const double scale : {1e-30, 1024.0, 1e30}) {
    std::vector<double> moved = plain.positions;
    for (double& x : moved) x = scale * x + (scale == 1024 ? 4096.0 : 0);
    const hf_inner::mesh::Mesh mesh = Given{moved, plain.triangles}.make(memory);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      EXPECT_LE(norm(mesh.positions[v] - first.positions[v]), 1e-14);
  }
}

}  // namespace
