// How far a deformation opens linked pieces where they touch at rest.
#include "mesh/touching.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/error.h"
#include "mesh/link_constants.h"
#include "mesh/nearest_triangle.h"
#include "support/meshes.h"
#include "support/parts.h"
#include "surface/link_change.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::mesh;
using hf_test::PlainMesh;

constexpr double far_up = 0.3;

// A small box on a large one, and a box beside both that touches the large one.
struct Stack {
  explicit Stack(bool skeleton = false) {
    hf_test::append(body, hf_test::box(6, {1, 1, 0.2}, {0, 0, 0}), 0);
    large = body.vertex_count();
    hf_test::append(body, hf_test::box(5, {0.4, 0.4, 0.2}, {0.1, 0.1, 0.204}), 0);
    small = body.vertex_count();
    hf_test::append(body, hf_test::box(4, {0.2, 0.5, 0.5}, {1.003, 0.2, 0.05}), 0);
    // The skeleton is 0 - 1 - 2 - 3. The large box has joint 0. Half of the small one is of joint 1, the rest of 3.
    for (std::size_t v = 0; v < body.vertex_count(); ++v)
      joint.push_back(v < large ? 0 : v < small && body.positions[3 * v] > 0.3 ? 3 : 1);
    weight.assign(joint.size(), 1);
    MeshInput input;
    input.vertex_count = body.vertex_count();
    input.triangle_count = body.triangle_count();
    input.positions = ConstRows(body.positions.data(), 3 * sizeof(double));
    input.triangles = IndexRows(body.triangles.data(), 3);
    shape = surface::Geometry::make(input, {}, std::make_shared<Memory>(), std::make_shared<JobRunner>(2u));
    LinkOptions options;
    options.mode = LinkMode::pieces;
    options.distance = default_link_distance;
    if (skeleton) options.skin = {1, joint.data(), weight.data(), parents};
    links = make_links(shape->mesh, shape->areas, options, *shape->memory, shape->jobs.get());
  }
  template <class Move>
  std::vector<double> moved(Move&& move) const {
    std::vector<double> out = body.positions;
    for (std::size_t v = 0; v < body.vertex_count(); ++v) move(v, &out[3 * v]);
    return out;
  }
  Opening opening(const std::vector<double>& posed) const {
    return measure_opening(shape->mesh, *links, ConstRows(posed.data(), 3 * sizeof(double)), *shape->memory);
  }
  Vec3 place(const std::vector<double>& posed, Index v) const {
    const double* const p = &posed[3 * at(shape->mesh.given_of_inner[at(v)])];
    return {p[0], p[1], p[2]};
  }
  // The distance of a point from a piece, over all of its triangles. share, triangle: null, or receive the nearest
  // point.
  double distance(const std::vector<double>& posed, Vec3 p, Index piece, double* share = nullptr,
                  Index* triangle = nullptr) const {
    double least = HUGE_VAL;
    for (Index t = 0; t < shape->mesh.triangle_count(); ++t) {
      const Index* const c = shape->mesh.triangle(t);
      if (links->piece[at(c[0])] != piece) continue;
      double weights[3];
      const double found = squared_to_triangle(p, place(posed, c[0]), place(posed, c[1]), place(posed, c[2]), weights);
      if (found >= least) continue;
      least = found;
      if (share) std::copy_n(weights, 3, share);
      if (triangle) *triangle = t;
    }
    return std::sqrt(least);
  }
  double opening(const std::vector<double>& posed, const Touch& touch) const {
    double share[3];
    Index triangle = 0;
    const double rest =
        distance(body.positions, place(body.positions, touch.vertex), piece_of(touch), share, &triangle);
    const Index* const c = shape->mesh.triangle(triangle);
    const Vec3 touched = share[0] * place(posed, c[0]) + share[1] * place(posed, c[1]) + share[2] * place(posed, c[2]);
    return std::min(distance(posed, place(posed, touch.vertex), piece_of(touch)),
                    distance(posed, touched, links->piece[at(touch.vertex)])) -
           rest;
  }
  Index piece_of(const Touch& touch) const { return links->piece[at(shape->mesh.triangle(touch.triangle)[0])]; }

  PlainMesh body;
  std::size_t large = 0, small = 0;
  std::vector<std::uint16_t> joint;
  std::vector<float> weight;
  const std::vector<std::uint32_t> parents{HF_NO_INDEX, 0, 1, 2};
  std::shared_ptr<const surface::Geometry> shape;
  std::shared_ptr<const Links> links;
};

TEST(Touching, AreAllVerticesNearALinkedPiece) {
  const Stack stack;
  std::set<std::pair<Index, Index>> found, expected;
  for (const Touch& touch : stack.links->touching) {
    found.insert({touch.vertex, stack.piece_of(touch)});
    EXPECT_NEAR(
        stack.shape->mesh.scale * touch.length,
        stack.distance(stack.body.positions, stack.place(stack.body.positions, touch.vertex), stack.piece_of(touch)),
        1e-12);
  }
  EXPECT_EQ(found.size(), stack.links->touching.size());
  const double within = touching * stack.shape->mesh.report.bounding_box_diagonal;
  for (Index v = 0; v < stack.shape->mesh.vertex_count(); ++v) {
    for (const auto& [a, b] : {std::pair<Index, Index>{0, 1}, {1, 0}, {0, 2}, {2, 0}})  // the last two do not touch
      if (stack.links->piece[at(v)] == a &&
          stack.distance(stack.body.positions, stack.place(stack.body.positions, v), b) < within)
        expected.insert({v, b});
  }
  EXPECT_GT(expected.size(), 30u);
  EXPECT_EQ(found, expected);
}

TEST(Touching, WhatSlidesOpensNothingAndWhatIsLiftedOpensByThat) {
  const Stack stack;
  const auto slid =
      stack.moved([&](std::size_t v, double* p) { p[0] += v >= stack.large && v < stack.small ? 0.4 : 0; });
  EXPECT_LT(stack.opening(slid).worst, 1e-12);
  Vector<double> gaps(stack.links->links.size(), &*stack.shape->memory);
  measure_gaps(stack.shape->mesh, stack.links->links, ConstRows(slid.data(), 3 * sizeof(double)), gaps);
  EXPECT_GT(*std::max_element(gaps.begin(), gaps.end()), 0.39);
  const auto lifted =
      stack.moved([&](std::size_t v, double* p) { p[2] += v >= stack.large && v < stack.small ? far_up : 0; });
  EXPECT_NEAR(stack.opening(lifted).worst, far_up, 1e-12);
  EXPECT_LT(stack.opening(stack.body.positions).worst, 1e-12);
}

TEST(Touching, TheOpeningIsTheWidestOfAllVertices) {
  const Stack stack;
  std::mt19937 random(4);
  for (int k = 0; k < 30; ++k) {
    const double size = std::pow(10.0, -k % 4);
    const auto posed = stack.moved([&](std::size_t, double* p) {
      for (int i = 0; i < 3; ++i) p[i] += size * (random() / 4294967296.0 - 0.5);
    });
    const Opening found = stack.opening(posed);
    double worst = 0;
    for (const Touch& touch : stack.links->touching) worst = std::max(worst, stack.opening(posed, touch));
    EXPECT_NEAR(found.worst, worst, 1e-12);
    EXPECT_GT(worst, 0);
    double own = 0;
    for (const Touch& touch : stack.links->touching)
      if (touch.vertex == found.vertex) own = std::max(own, stack.opening(posed, touch));
    EXPECT_NEAR(own, worst, 1e-12);
  }
}

TEST(Touching, JointsFarApartInTheSkeletonOnlyTouch) {
  const Stack plain, rigged(true);
  const auto joints = [&](const Stack& stack) {
    std::set<int> out;
    for (const Touch& touch : stack.links->touching)
      out.insert(stack.joint[at(stack.shape->mesh.given_of_inner[at(touch.vertex)])]);
    return out;
  };
  EXPECT_EQ(joints(plain), (std::set<int>{0, 1, 3}));
  EXPECT_EQ(joints(rigged), (std::set<int>{0, 1}));
}

TEST(Touching, PiecesWhoseLinksAnEditTakesOutDoNotOpen) {
  const Stack stack;
  const auto touches = [&](const Links& links) {
    std::set<Index> pieces;
    for (const Touch& touch : links.touching) pieces.insert(links.piece[at(touch.vertex)]);
    return pieces;
  };
  EXPECT_EQ(touches(*stack.links), (std::set<Index>{0, 1, 2}));
  std::vector<std::uint8_t> removed;
  const auto is_of_third = [&](Index v) { return v != Mesh::none && stack.links->piece[at(v)] == 2; };
  for (const Link& link : stack.links->links)
    removed.push_back(is_of_third(link.vertex) || std::any_of(link.corner, link.corner + 3, is_of_third));
  const auto edited = surface::edited_links(stack.shape->mesh, stack.links.get(), {removed.data(), removed.size()}, {},
                                            *stack.shape->memory);
  EXPECT_EQ(touches(*edited), (std::set<Index>{0, 1}));
}

TEST(Touching, PositionsThatAreNoPlacesAreRefused) {
  const Stack stack;
  for (const auto& [value, code] :
       {std::pair{std::nan(""), HF_ERROR_NON_FINITE}, {HUGE_VAL, HF_ERROR_NON_FINITE}, {-1e200, HF_ERROR_TOO_LARGE}}) {
    std::vector<double> posed = stack.body.positions;
    posed[3 * 40 + 1] = value;
    try {
      stack.opening(posed);
      FAIL() << value;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_EQ(error.index(), 40u);
    }
  }
}

}  // namespace
