// Links between the pieces of a mesh: which are found, and the operator they make.
#include "mesh/links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "mesh/contact_search.h"
#include "mesh/link_constants.h"
#include "mesh/nearest_triangle.h"
#include "support/meshes.h"
#include "support/oracle.h"
#include "support/parts.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_test::box;
using hf_test::PlainMesh;

constexpr double unit = 0.57735026918962573;  // cot 60 degrees

// Two unit cubes with a gap between them along x.
PlainMesh two_cubes(double gap = 0.01, std::uint32_t n = 6) {
  PlainMesh mesh = box(n, {1, 1, 1}, {0, 0, 0});
  hf_test::append(mesh, box(n + 1, {1, 1, 1}, {0, 0.05, 0.03}), 1 + gap);
  return mesh;
}

std::shared_ptr<const hf_inner::surface::Geometry> plain_geometry(const PlainMesh& mesh,
                                                                  hf_inner::mesh::OperatorKind kind = {}) {
  hf_inner::mesh::MeshInput input;
  input.vertex_count = mesh.vertex_count();
  input.triangle_count = mesh.triangle_count();
  input.positions = hf_inner::ConstRows(mesh.positions.data(), 3 * sizeof(double));
  input.triangles = hf_inner::IndexRows(mesh.triangles.data(), 3);
  return hf_inner::surface::Geometry::make(input, kind, std::make_shared<hf_inner::Memory>(),
                                           std::make_shared<hf_inner::JobRunner>(1u));
}

hf_inner::mesh::LinkOptions automatic() {
  hf_inner::mesh::LinkOptions options;
  options.mode = hf_inner::mesh::LinkMode::pieces;
  options.distance = hf_inner::mesh::default_link_distance;
  options.overlay = hf_inner::mesh::default_overlay;
  return options;
}

std::shared_ptr<const hf_inner::surface::Core> core_of(
    const std::shared_ptr<const hf_inner::surface::Geometry>& shape) {
  hf_inner::surface::CoreOptions options;
  options.operator_kind = shape->operator_kind;
  return hf_inner::surface::Core::make(shape, options);
}

Eigen::MatrixXd dense(const hf_inner::SymmetricMatrix& k) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(k.size(), k.size());
  for (Index v = 0; v < k.size(); ++v) {
    for (Index i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i) out(v, k.row[at(i)]) = k.value[at(i)];
  }
  return out;
}

std::vector<double> field_through(const std::shared_ptr<const hf_inner::surface::Core>& core,
                                  const std::vector<Index>& vertices, const std::vector<double>& values) {
  const auto engine = hf_inner::solve::SiteSolver::make(core);
  std::vector<hf_inner::solve::Site> sites;
  std::vector<Index> slots;
  for (const Index v : vertices) {
    slots.push_back(static_cast<Index>(sites.size()));
    sites.push_back(hf_inner::solve::Site::at_vertex(core->mesh, v));
  }
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  engine->edit(edit);
  std::vector<double> out(at(core->size()));
  engine->solve(values.data(), 1, out.data(), nullptr);
  return out;
}

TEST(Links, join_two_cubes_into_one_component) {
  const auto plain = plain_geometry(two_cubes());
  ASSERT_EQ(plain->mesh.component_count(), 2);
  const auto linked = hf_inner::surface::Geometry::linked(plain, automatic());
  ASSERT_TRUE(linked->links);
  EXPECT_EQ(linked->mesh.component_count(), 1);
  EXPECT_EQ(linked->links->alone_count, 0);
  EXPECT_EQ(linked->links->links.size(), 16u);  // eight of each side
  EXPECT_NEAR(linked->links->longest_tree_link * plain->mesh.scale, 0.01, 1e-12);
  EXPECT_EQ(&linked->unlinked(), plain.get());
  // The topology has the links as edges without triangles, and lists neighbours both ways.
  const hf_inner::mesh::Topology& t = linked->topology();
  Index without = 0;
  for (Index e = 0; e < t.edge_count(); ++e)
    without += t.edge_triangle_start[at(e)] == t.edge_triangle_start[at(e) + 1];
  EXPECT_EQ(without, t.edge_count() - plain->topology().edge_count());
  std::set<std::pair<Index, Index>> springs;
  for (const hf_inner::mesh::Link& link : linked->links->links) {
    for (const Index corner : link.corner) {
      if (corner >= 0) springs.insert(std::minmax(link.vertex, corner));
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(without), springs.size());
  for (Index v = 0; v < linked->mesh.vertex_count(); ++v) {
    for (Index i = t.neighbour_start[at(v)]; i < t.neighbour_start[at(v) + 1]; ++i) {
      const Index w = t.neighbour[at(i)], e = t.neighbour_edge[at(i)];
      EXPECT_TRUE((t.first(e) == v && t.second(e) == w) || (t.first(e) == w && t.second(e) == v));
    }
  }
}

TEST(Links, keep_the_operator_a_symmetric_m_matrix_whose_rows_sum_to_zero) {
  for (const auto kind : {hf_inner::mesh::OperatorKind::intrinsic_delaunay, hf_inner::mesh::OperatorKind::clamped,
                          hf_inner::mesh::OperatorKind::uniform}) {
    const auto core = core_of(hf_inner::surface::Geometry::linked(plain_geometry(two_cubes(), kind), automatic()));
    const Eigen::MatrixXd k = dense(core->laplacian);
    EXPECT_EQ((k - k.transpose()).cwiseAbs().maxCoeff(), 0);
    for (Index v = 0; v < core->size(); ++v) {
      EXPECT_LE(std::fabs(k.row(v).sum()), 1e-14 * k(v, v));
      for (Index w = 0; w < core->size(); ++w) {
        if (v != w) {
          EXPECT_LE(k(v, w), 1e-15);
        }
      }
    }
  }
}

TEST(Links, make_the_operator_of_springs_from_points_to_triangles) {
  const auto plain = plain_geometry(two_cubes());
  const auto linked = hf_inner::surface::Geometry::linked(plain, automatic());
  Eigen::MatrixXd k = dense(core_of(plain)->laplacian);
  for (const hf_inner::mesh::Link& link : linked->links->links) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (link.corner[c] < 0) continue;
      const double w = unit * link.weight * link.share[c];
      k(link.vertex, link.vertex) += w;
      k(link.corner[c], link.corner[c]) += w;
      k(link.vertex, link.corner[c]) -= w;
      k(link.corner[c], link.vertex) -= w;
      sum += link.share[c];
    }
    EXPECT_NEAR(sum, 1, 1e-15);
  }
  const auto core = core_of(linked);
  EXPECT_LE((k - dense(core->laplacian)).cwiseAbs().maxCoeff(), 1e-13);
  // One site on each cube: the field passes from one to the other, and stays between the values.
  const Index far = core->size() - 1;
  const std::vector<double> field = field_through(core, {0, far}, {-1, 2});
  Eigen::MatrixXd values(2, 1);
  values << -1, 2;
  const Eigen::MatrixXd exact = hf_test::dense_field(
      *core, {hf_inner::solve::Site::at_vertex(core->mesh, 0), hf_inner::solve::Site::at_vertex(core->mesh, far)},
      values);
  for (std::size_t v = 0; v < field.size(); ++v) {
    EXPECT_NEAR(field[v], exact(static_cast<Index>(v), 0), 1e-10);
    EXPECT_GE(field[v], -1 - 1e-12);
    EXPECT_LE(field[v], 2 + 1e-12);
  }
  // A site on one cube alone holds both.
  for (const double u : field_through(core, {0}, {3})) EXPECT_NEAR(u, 3, 1e-10);
}

TEST(Links, of_a_surface_of_one_piece_are_none) {
  const auto plain = plain_geometry(hf_test::torus(12, 9));
  EXPECT_EQ(hf_inner::surface::Geometry::linked(plain, automatic()), plain);
}

// A body and a sheet close above its top, over a third of it.
PlainMesh body_with_sheet() {
  PlainMesh mesh = box(12, {3, 3, 1}, {0, 0, 0});
  PlainMesh sheet = hf_test::grid(9, 9, 0.15);
  for (std::size_t i = 0; i < sheet.positions.size(); i += 3) {
    sheet.positions[i] += 0.7;
    sheet.positions[i + 1] += 0.9;
    sheet.positions[i + 2] = 1.02;
  }
  hf_test::append(mesh, sheet, 0);
  return mesh;
}

TEST(Links, a_sheet_is_light_and_hardly_changes_the_field_of_the_body) {
  const auto plain = plain_geometry(body_with_sheet());
  const auto linked = hf_inner::surface::Geometry::linked(plain, automatic());
  ASSERT_TRUE(linked->links);
  EXPECT_EQ(linked->links->light[0], 0);
  EXPECT_EQ(linked->links->light[1], 1);
  EXPECT_GE(linked->links->links.size(), 80u);  // all over the sheet
  const auto core = core_of(linked), own = core_of(plain);
  const std::vector<double> with = field_through(core, {0, 90}, {0, 1}), without = field_through(own, {0, 90}, {0, 1});
  double change = 0, low = 1, high = 0;
  for (Index v = 0; v < core->size(); ++v) {
    if (plain->mesh.component[at(v)] == 0) {
      change = std::max(change, std::fabs(with[at(v)] - without[at(v)]));
    } else {
      low = std::min(low, with[at(v)]);
      high = std::max(high, with[at(v)]);
    }
  }
  EXPECT_LE(change, 1e-4);
  EXPECT_GT(high - low, 0.1);  // the sheet has the body's field, not a mean
  // Heavy by the host's word, it does change it.
  auto options = automatic();
  const Index on_sheet = core->size() - 1;
  options.heavy = {&on_sheet, 1};
  const auto heavy = hf_inner::surface::Geometry::linked(plain, options);
  EXPECT_EQ(heavy->links->light[1], 0);
  const std::vector<double> stiff = field_through(core_of(heavy), {0, 90}, {0, 1});
  double heavy_change = 0;
  for (Index v = 0; v < core->size(); ++v) {
    if (plain->mesh.component[at(v)] == 0)
      heavy_change = std::max(heavy_change, std::fabs(stiff[at(v)] - without[at(v)]));
  }
  EXPECT_GT(heavy_change, 1e-3);
}

// Light by the host's word, a piece beside the body follows it: it is no sheet, and its links hold all over.
TEST(Links, a_piece_is_light_by_the_hosts_word) {
  const auto plain = plain_geometry(two_cubes());
  auto options = automatic();
  const Index on_second = plain->mesh.vertex_count() - 1;
  options.light = {&on_second, 1};
  const auto linked = hf_inner::surface::Geometry::linked(plain, options);
  ASSERT_TRUE(linked->links);
  EXPECT_EQ(linked->links->light[0], 0);
  EXPECT_EQ(linked->links->light[1], 1);
  EXPECT_EQ(linked->mesh.component_count(), 1);
  const auto heavy = hf_inner::surface::Geometry::linked(plain, automatic());
  const std::vector<double> alone = field_through(core_of(plain), {0, 40}, {0, 1}),
                            with = field_through(core_of(linked), {0, 40}, {0, 1}),
                            stiff = field_through(core_of(heavy), {0, 40}, {0, 1});
  double change = 0, heavy_change = 0;
  for (std::size_t v = 0; v < alone.size(); ++v) {
    if (plain->mesh.component[v] != 0) continue;
    change = std::max(change, std::fabs(with[v] - alone[v]));
    heavy_change = std::max(heavy_change, std::fabs(stiff[v] - alone[v]));
  }
  EXPECT_LE(change, 1e-3);
  EXPECT_GT(heavy_change, 10 * change);
  const Index on_first = 0;
  options.heavy = {&on_second, 1};
  EXPECT_THROW(hf_inner::surface::Geometry::linked(plain, options), hf_inner::Error);
  options.heavy = {&on_first, 1};
  EXPECT_EQ(hf_inner::surface::Geometry::linked(plain, options)->links->light[1], 1);
}

TEST(Links, the_difference_of_skin_weights_counts_a_joint_once) {
  PlainMesh mesh = hf_test::grid(1, 1, 1.0);
  const auto plain = plain_geometry(mesh);
  const std::uint16_t joints[] = {1, 1, 1, 2, 2, 2, 3, 1};
  const float weights[] = {0.5f, 0.5f, 1, 0, 0.5f, 0.5f, 0.25f, 0.75f};
  hf_inner::mesh::SkinHint skin;
  skin.influence_count = 2;
  skin.joints = joints;
  skin.weights = weights;
  const Index first[] = {1, 1, 1}, second[] = {2, 2, 2}, third[] = {3, 3, 3};
  const double share[] = {0.5, 0.25, 0.25};
  const auto inner = [&](const Index* given) {
    std::array<Index, 3> out;
    for (std::size_t k = 0; k < 3; ++k) out[k] = plain->mesh.inner_of_given[at(given[k])];
    return out;
  };
  const Index v = plain->mesh.inner_of_given[0];
  EXPECT_DOUBLE_EQ(difference(skin, plain->mesh, v, inner(first).data(), share), 0);
  EXPECT_DOUBLE_EQ(difference(skin, plain->mesh, v, inner(second).data(), share), 1);
  EXPECT_DOUBLE_EQ(difference(skin, plain->mesh, v, inner(third).data(), share), 0.25);
}

TEST(Links, pieces_of_different_tags_stay_apart) {
  const PlainMesh mesh = two_cubes();
  const auto plain = plain_geometry(mesh);
  std::vector<std::uint32_t> tags(mesh.vertex_count(), 1);
  for (std::size_t v = 0; v < tags.size(); ++v) tags[v] = mesh.positions[3 * v] > 1.001 ? 7 : 1;
  auto options = automatic();
  options.tags = tags;
  EXPECT_EQ(hf_inner::surface::Geometry::linked(plain, options), plain);
}

TEST(Links, stop_at_the_distance_and_count_what_stays_alone) {
  PlainMesh mesh = two_cubes();
  hf_test::append(mesh, box(2, {0.5, 0.5, 0.5}, {0, 0, 0}), 4);
  const auto linked = hf_inner::surface::Geometry::linked(plain_geometry(mesh), automatic());
  EXPECT_EQ(linked->mesh.component_count(), 2);
  EXPECT_EQ(linked->links->alone_count, 1);
  auto options = automatic();
  options.distance = 1;
  EXPECT_EQ(hf_inner::surface::Geometry::linked(plain_geometry(mesh), options)->mesh.component_count(), 1);
}

TEST(Links, skin_weights_choose_between_neighbours) {
  // A small cube above the seam of two, a little nearer to the left one. Its joint is that of the right one.
  PlainMesh mesh = box(4, {1, 1, 1}, {0, 0, 0});
  hf_test::append(mesh, box(4, {1, 1, 0.99}, {0, 0, 0}), 1.02);
  hf_test::append(mesh, box(2, {0.2, 0.2, 0.2}, {0, 0.4, 1.02}), 0.91);
  std::vector<std::uint16_t> joints;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    joints.push_back(mesh.positions[3 * v] > 1.015 || mesh.positions[3 * v + 2] > 1.01 ? 5 : 3);
  const std::vector<float> weights(mesh.vertex_count(), 1);
  const auto linked_to = [&](const hf_inner::mesh::SkinHint& skin) {
    auto options = automatic();
    options.skin = skin;
    options.overlay = 0;
    const auto shape = hf_inner::surface::Geometry::linked(plain_geometry(mesh), options);
    std::vector<int> count(3, 0);
    for (const hf_inner::mesh::Link& link : shape->links->links) {
      const Index a = shape->links->piece[at(link.vertex)];
      Index b = -1;
      for (const Index c : link.corner) b = c >= 0 ? shape->links->piece[at(c)] : b;
      if (std::max(a, b) == 2) ++count[at(std::min(a, b))];
    }
    return count;
  };
  const std::vector<int> nearest = linked_to({}), alike = linked_to({1, joints.data(), weights.data(), {}});
  EXPECT_GT(nearest[0], 0);
  EXPECT_EQ(nearest[1], 0);
  EXPECT_EQ(alike[0], 0);
  EXPECT_GT(alike[1], 0);
}

TEST(Links, what_moves_with_the_same_joints_is_held_together_firmly) {
  const PlainMesh mesh = two_cubes(0.01, 48);  // edges so short that all links count once
  // Both cubes have joint 1; the second one has a share of joint 2 too.
  const auto weight_of_links = [&](float share) {
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const float own = mesh.positions[3 * v] > 1.001 ? share : 0;
      joints.insert(joints.end(), {1, 2});
      weights.insert(weights.end(), {1 - own, own});
    }
    auto options = automatic();
    options.overlay = 0;
    options.skin = {2, joints.data(), weights.data(), {}};
    const auto linked = hf_inner::surface::Geometry::linked(plain_geometry(mesh), options);
    double least = 1e300, most = 0;
    for (const hf_inner::mesh::Link& link : linked->links->links) {
      least = std::min(least, link.weight);
      most = std::max(most, link.weight);
    }
    EXPECT_EQ(std::round(16 * least), 16 * least);
    return std::make_pair(least, most);
  };
  const auto equal = weight_of_links(0), half = weight_of_links(0.25f), other = weight_of_links(0.5f);
  EXPECT_DOUBLE_EQ(equal.first, 1 + hf_inner::mesh::rigid_weight);
  EXPECT_DOUBLE_EQ(equal.second, 1 + hf_inner::mesh::rigid_weight);
  EXPECT_NEAR(half.first, 1 + 0.5 * hf_inner::mesh::rigid_weight, 1);
  EXPECT_DOUBLE_EQ(other.first, 1);
  EXPECT_DOUBLE_EQ(other.second, 1);
}

// Pieces of different joints turn about each other. Near the middle of their contact they slide least.
TEST(Links, pieces_of_different_joints_link_near_the_middle_of_their_contact) {
  const PlainMesh mesh = two_cubes();
  std::vector<std::uint16_t> joints;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) joints.push_back(mesh.positions[3 * v] > 1.005 ? 5 : 3);
  const std::vector<float> weights(mesh.vertex_count(), 1);
  auto options = automatic();
  options.skin = {1, joints.data(), weights.data(), {}};
  const auto plain = plain_geometry(mesh);
  const auto shape = hf_inner::surface::Geometry::linked(plain, options);
  ASSERT_TRUE(shape->links);
  ASSERT_EQ(shape->links->links.size(), 2u);  // one of each side
  EXPECT_NE(shape->links->piece[at(shape->links->links[0].vertex)],
            shape->links->piece[at(shape->links->links[1].vertex)]);
  for (const hf_inner::mesh::Link& link : shape->links->links) {
    EXPECT_TRUE(link.tree);
    EXPECT_GE(link.weight, double{hf_inner::mesh::links_a_side});
    const hf_inner::Vec3 p = plain->mesh.to_given(plain->mesh.positions[at(link.vertex)]);
    EXPECT_LT(std::hypot(p.y - 0.5, p.z - 0.5), 0.2);
  }
}

// A sheet of another joint than all below swings about a place, and is not held all over.
TEST(Links, a_sheet_of_another_joint_has_few_links) {
  const PlainMesh mesh = body_with_sheet();
  std::vector<std::uint16_t> joints;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) joints.push_back(mesh.positions[3 * v + 2] > 1.01 ? 5 : 3);
  const std::vector<float> weights(mesh.vertex_count(), 1);
  auto options = automatic();
  options.skin = {1, joints.data(), weights.data(), {}};
  const auto shape = hf_inner::surface::Geometry::linked(plain_geometry(mesh), options);
  ASSERT_TRUE(shape->links);
  EXPECT_EQ(shape->links->light[1], 1);
  EXPECT_EQ(shape->links->links.size(), hf_inner::mesh::light_hinge_links);
}

// The least squared distance from a vertex to the triangles of a group, by trying all.
double least_distance(const hf_inner::mesh::Mesh& mesh, const std::vector<Index>& group, Index g, Index v) {
  double least = 1e300;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (group[at(t)] != g) continue;
    const Index* c = mesh.triangle(t);
    least = std::min(least, hf_inner::mesh::squared_to_triangle(mesh.positions[at(v)], mesh.positions[at(c[0])],
                                                                mesh.positions[at(c[1])], mesh.positions[at(c[2])]));
  }
  return least;
}

// The last triangle of a group.
Index search_hint(const std::vector<Index>& group, Index g) {
  return static_cast<Index>(group.rend() - std::find(group.rbegin(), group.rend(), g)) - 1;
}

TEST(Links, the_nearest_triangle_of_a_piece_agrees_with_trying_them_all) {
  const auto shape = plain_geometry(two_cubes());
  const hf_inner::mesh::Mesh& mesh = shape->mesh;
  std::vector<Index> group;
  for (Index t = 0; t < mesh.triangle_count(); ++t) group.push_back(mesh.component[at(mesh.triangle(t)[0])]);
  const hf_inner::mesh::SkinHint none;
  const hf_inner::mesh::ContactSearch search(mesh, none, *shape->memory);
  for (Index v = 0; v < mesh.vertex_count(); v += 3) {
    for (Index g = 0; g < 2; ++g) {
      const double least = least_distance(mesh, group, g, v);
      const hf_inner::Vec3 p = mesh.positions[at(v)];
      Index triangle = 7;
      EXPECT_NEAR(search.nearest(g, p, 10, 0, -1, triangle), least, 1e-15);
      ASSERT_GE(triangle, 0);
      EXPECT_EQ(group[at(triangle)], g);
      EXPECT_EQ(search.nearest(g, p, 0.5 * least, 0, -1, triangle), 0.5 * least);
      EXPECT_EQ(triangle, -1);
      // A search that may end early finds something near enough, also where the bounds are equal.
      const double bound = least + 1e-6;
      EXPECT_LT(search.nearest(g, p, bound, bound, -1, triangle), bound);
      EXPECT_GE(triangle, 0);
      // A hint changes no answer. The nearest of equal triangles is the first.
      Index hinted = 7;
      search.nearest(g, p, 10, -1, -1, triangle);
      for (const Index hint : {search_hint(group, g), triangle}) {
        EXPECT_NEAR(search.nearest(g, p, 10, -1, hint, hinted), least, 1e-15);
        EXPECT_EQ(hinted, triangle);
      }
    }
  }
}

TEST(Links, contacts_agree_with_trying_all_triangles) {
  const auto shape = plain_geometry(two_cubes());
  const hf_inner::mesh::Mesh& mesh = shape->mesh;
  std::vector<Index> group;
  for (Index t = 0; t < mesh.triangle_count(); ++t) group.push_back(mesh.component[at(mesh.triangle(t)[0])]);
  const hf_inner::mesh::SkinHint none;
  const hf_inner::mesh::ContactSearch search(mesh, none, *shape->memory);
  constexpr double range = 0.2, depth = 0.05;
  hf_inner::Memory memory;
  for (Index from = 0; from < 2; ++from) {
    hf_inner::Vector<hf_inner::mesh::Contact> found(&memory),
        best(at(mesh.vertex_count()), {-1, -1, 1e300, 1e300}, &memory);
    double reach = range, nearest = 1e300;
    search.find(from, 1 - from, depth, reach, found, SIZE_MAX);
    search.improve(from, 1 - from, range, best);
    std::vector<double> distance(at(mesh.vertex_count()), -1);
    for (const hf_inner::mesh::Contact& contact : found) distance[at(contact.vertex)] = contact.distance;
    for (const Index v : search.vertices_of(from))
      nearest = std::min(nearest, std::sqrt(least_distance(mesh, group, 1 - from, v)));
    EXPECT_NEAR(reach, nearest + depth, 1e-12);
    EXPECT_TRUE(
        std::is_sorted(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; }));
    for (const Index v : search.vertices_of(from)) {
      const double least = std::sqrt(least_distance(mesh, group, 1 - from, v));
      if (least < nearest + depth) {
        EXPECT_NEAR(distance[at(v)], least, 1e-12);
      }
      EXPECT_EQ(best[at(v)].vertex, least < range ? v : -1);
      if (least < range) {
        EXPECT_NEAR(best[at(v)].distance, least, 1e-12);
      }
    }
  }
}

// What skin weights add at least bounds the search, so that it must be below the cost of every contact.
TEST(Links, the_least_skin_cost_is_below_that_of_every_contact) {
  const auto shape = plain_geometry(two_cubes());
  const hf_inner::mesh::Mesh& mesh = shape->mesh;
  constexpr std::uint32_t slots = 3;
  std::uint32_t state = 7;
  const auto random = [&] { return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f; };
  for (const bool rigid : {false, true}) {
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    for (std::uint32_t v = 0; v < mesh.report.vertex_count; ++v) {
      const bool second = mesh.component[at(mesh.inner_of_given[v])] == 1;
      const float first = rigid ? 1 : 0.5f + 0.25f * random(), rest = (1 - first) / 2;
      // Joint 4 is named twice.
      joints.insert(joints.end(), {static_cast<std::uint16_t>(second ? 9 : 2), 4, 4});
      weights.insert(weights.end(), {first, rest, rest});
    }
    const hf_inner::mesh::SkinHint skin{slots, joints.data(), weights.data(), {}};
    const hf_inner::mesh::ContactSearch search(mesh, skin, *shape->memory);
    const double least = search.least_skin_cost(0, 1);
    EXPECT_EQ(search.least_skin_cost(1, 0), least);
    double lowest = 1, cheapest[2] = {1, 1};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Index from = mesh.component[at(v)];
      double nearest = 1, cost = 1;
      for (Index t = 0; t < mesh.triangle_count(); ++t) {
        const Index* c = mesh.triangle(t);
        if (mesh.component[at(c[0])] == from) continue;
        double share[3];
        const double d =
            std::sqrt(hf_inner::mesh::squared_to_triangle(mesh.positions[at(v)], mesh.positions[at(c[0])],
                                                          mesh.positions[at(c[1])], mesh.positions[at(c[2])], share));
        const double added = hf_inner::mesh::skin_distance * difference(skin, mesh, v, c, share);
        lowest = std::min(lowest, added);
        if (d < nearest) {
          nearest = d;
          cost = d + added;
        }
      }
      cheapest[at(from)] = std::min(cheapest[at(from)], cost);
    }
    EXPECT_LE(least, lowest);
    EXPECT_GE(least, lowest - (rigid ? 1e-8 : hf_inner::mesh::skin_distance / 2));
    EXPECT_GT(least, 0.5 * hf_inner::mesh::skin_distance * (rigid ? 2 : 1) - 1e-8);
    // The search ends at the cheapest contact, as trying all does.
    for (Index from = 0; from < 2; ++from) {
      hf_inner::Memory memory;
      hf_inner::Vector<hf_inner::mesh::Contact> found(&memory);
      double reach = 1, cost = 1;
      search.find(from, 1 - from, 0, reach, found, SIZE_MAX);
      for (const hf_inner::mesh::Contact& contact : found) cost = std::min(cost, contact.cost);
      EXPECT_NEAR(cost, cheapest[at(from)], 1e-12);
      EXPECT_NEAR(reach, cost - least, 1e-12);
    }
  }
}

TEST(Links, of_too_many_pieces_are_refused) {
  PlainMesh mesh;
  for (std::uint32_t i = 0; i <= 20000; ++i) {
    const double x = 2.0 * (i % 200), y = 2.0 * (i / 200);
    mesh.positions.insert(mesh.positions.end(), {x, y, 0, x + 1, y, 0, x, y + 1, 0});
    mesh.triangles.insert(mesh.triangles.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  }
  try {
    hf_inner::surface::Geometry::linked(plain_geometry(mesh), automatic());
    FAIL() << "not refused";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_TOO_LARGE);
  }
}

TEST(Links, of_thousands_of_pieces_are_found) {
  PlainMesh mesh;
  for (int i = 0; i < 400; ++i) hf_test::append(mesh, box(1, {0.9, 1, 1}, {0, 0, 0}), i);
  auto options = automatic();
  const auto linked = hf_inner::surface::Geometry::linked(plain_geometry(mesh), options);
  EXPECT_EQ(linked->mesh.component_count(), 1);
}

}  // namespace
