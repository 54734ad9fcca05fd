// Surfaces whose triangles were exchanged, against surfaces made of the same triangles and against dense solves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "base/error.h"
#include "mesh/cut_edges.h"
#include "solve/site_solver.h"
#include "support/full.h"
#include "support/hard_meshes.h"
#include "support/oracle.h"
#include "surface/edited_core.h"
#include "surface/patch_rows.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::mesh::Mesh;
using hf_inner::solve::Site;
using hf_inner::surface::Core;
using hf_inner::surface::Geometry;

constexpr double always_rows = 1e9, never_rows = 0;
using Stiffness = std::shared_ptr<const hf_inner::Vector<double>>;

std::shared_ptr<const Core> make(const hf_test::PlainMesh& mesh, hf_inner::surface::CoreOptions options = {}) {
  hf_inner::mesh::MeshInput input;
  input.weld = hf_inner::mesh::Weld::none;
  input.vertex_count = mesh.vertex_count();
  input.triangle_count = mesh.triangle_count();
  input.positions = hf_inner::ConstRows(mesh.positions.data(), 3 * sizeof(double));
  input.triangles = hf_inner::IndexRows(mesh.triangles.data(), 3);
  return Core::make(input, options, std::make_shared<hf_inner::Memory>(), std::make_shared<hf_inner::JobRunner>(1));
}

// The mesh of a caller who exchanges triangles.
class Model {
 public:
  explicit Model(hf_test::PlainMesh mesh) : mesh_(std::move(mesh)), alive_(mesh_.triangle_count(), true) {}
  hf_test::PlainMesh now() const {
    hf_test::PlainMesh out;
    out.positions = mesh_.positions;
    for (std::size_t t = 0; t < alive_.size(); ++t)
      if (alive_[t]) out.triangles.insert(out.triangles.end(), &mesh_.triangles[3 * t], &mesh_.triangles[3 * t] + 3);
    return out;
  }
  std::shared_ptr<const Geometry> apply(const Core& from) {
    std::vector<hf_inner::Vec3> positions;
    for (std::size_t i = 0; i < added_positions_.size(); i += 3)
      positions.push_back({added_positions_[i], added_positions_[i + 1], added_positions_[i + 2]});
    hf_inner::mesh::MeshPatch patch;
    patch.removed = {removed_.data(), removed_.size()};
    patch.positions = {positions.data(), positions.size()};
    patch.triangles = {added_.data(), added_.size()};
    const auto out = Geometry::patched(from.geometry, patch);
    for (const std::uint32_t t : removed_) alive_[t] = false;
    mesh_.positions.insert(mesh_.positions.end(), added_positions_.begin(), added_positions_.end());
    mesh_.triangles.insert(mesh_.triangles.end(), added_.begin(), added_.end());
    alive_.resize(mesh_.triangle_count(), true);
    removed_.clear();
    added_.clear();
    added_positions_.clear();
    return out;
  }

  void forget() {
    removed_.clear();
    added_.clear();
    added_positions_.clear();
  }
  // Cuts along edges.
  std::shared_ptr<const Geometry> cut(const Core& from, const std::vector<std::uint32_t>& edges) {
    const auto cuts = hf_inner::mesh::cut_edges(from.mesh, {edges.data(), edges.size()}, *from.memory);
    hf_inner::mesh::MeshPatch patch;
    patch.cuts = cuts;
    for (const Mesh::CutCorner& corner : cuts) {
      std::uint32_t& v = mesh_.triangles[3 * at(corner.triangle) + at(corner.corner)];
      EXPECT_EQ(v, static_cast<std::uint32_t>(corner.copied));
      v = static_cast<std::uint32_t>(corner.vertex);
      if (v < mesh_.vertex_count()) continue;
      EXPECT_EQ(v, mesh_.vertex_count());
      for (int k = 0; k < 3; ++k) mesh_.positions.push_back(mesh_.positions[3 * at(corner.copied) + at(k)]);
    }
    return Geometry::patched(from.geometry, patch);
  }
  // A walk along edges from a random vertex, without turning back.
  std::vector<std::uint32_t> walk(std::mt19937& random, std::size_t length) const {
    std::vector<std::uint32_t> edges;
    std::set<std::uint32_t> seen;
    std::uint32_t here = HF_NO_INDEX;
    while (here == HF_NO_INDEX) {
      const std::size_t t = random() % alive_.size();
      if (alive_[t]) here = mesh_.triangles[3 * t];
    }
    while (edges.size() < 2 * length) {
      seen.insert(here);
      std::uint32_t next = HF_NO_INDEX;
      for (std::size_t t = 0; t < alive_.size(); ++t) {
        const std::uint32_t* const v = &mesh_.triangles[3 * t];
        if (!alive_[t] || std::find(v, v + 3, here) == v + 3) continue;
        for (int k = 0; k < 3; ++k)
          if (seen.count(v[k]) == 0 && (next == HF_NO_INDEX || random() % 3 == 0)) next = v[k];
      }
      if (next == HF_NO_INDEX) break;
      edges.insert(edges.end(), {here, next});
      here = next;
    }
    return edges;
  }

  // A change of one kind at a random place.
  void change(int kind, std::mt19937& random, int rings = 2) {
    std::vector<std::uint32_t> there;
    for (std::uint32_t t = 0; t < alive_.size(); ++t)
      if (alive_[t]) there.push_back(t);
    const auto below = [&](std::size_t limit) {
      return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
    };
    const std::uint32_t seed = there[below(there.size())];
    if (kind == 4) return rip(mesh_.triangles[3 * seed + below(3)], random);
    if (kind == 3) return flap(seed, static_cast<std::uint32_t>(below(3)), random);
    if (kind == 5) return fill(random);
    if (kind == 6) return flip(seed, static_cast<std::uint32_t>(below(3)));
    removed_ = disc(seed, kind == 2 ? 1 : rings);
    if (kind == 1) return;  // a hole
    for (const std::uint32_t t : removed_) {
      const std::uint32_t* const v = &mesh_.triangles[3 * t];
      const std::uint32_t middle = add_vertex(centre(v, 0.2, random));
      for (int k = 0; k < 3; ++k) add_triangle(v[k], v[(k + 1) % 3], middle);
    }
  }

  // The vertices below `limit` whose triangles have no others give their places to new ones, numbered at random.
  void renew(std::uint32_t limit, std::mt19937& random) {
    std::vector<std::uint32_t> renewed(mesh_.vertex_count()), list;
    std::iota(renewed.begin(), renewed.end(), 0);
    std::vector<bool> inside(limit, true);
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
      const std::uint32_t* const v = &mesh_.triangles[3 * t];
      if (std::max({v[0], v[1], v[2]}) < limit) {
        removed_.push_back(t);
        continue;
      }
      for (int k = 0; k < 3; ++k)
        if (v[k] < limit) inside[v[k]] = false;
    }
    for (std::uint32_t v = 0; v < limit; ++v)
      if (inside[v]) list.push_back(v);
    std::shuffle(list.begin(), list.end(), random);
    for (const std::uint32_t v : list) renewed[v] = add_vertex({position(v), position(v) + 3});
    for (const std::uint32_t t : removed_) {
      const std::uint32_t* const v = &mesh_.triangles[3 * t];
      add_triangle(renewed[v[0]], renewed[v[1]], renewed[v[2]]);
    }
  }

 private:
  std::vector<std::uint32_t> disc(std::uint32_t seed, int rings) const {
    std::set<std::uint32_t> vertices(&mesh_.triangles[3 * seed], &mesh_.triangles[3 * seed] + 3);
    std::vector<std::uint32_t> out = {seed};
    for (int ring = 0; ring < rings; ++ring) {
      std::set<std::uint32_t> more = vertices;
      out.clear();
      for (std::uint32_t t = 0; t < alive_.size(); ++t) {
        const std::uint32_t* const v = &mesh_.triangles[3 * t];
        if (!alive_[t] || !std::any_of(v, v + 3, [&](std::uint32_t u) { return vertices.count(u) > 0; })) continue;
        out.push_back(t);
        more.insert(v, v + 3);
      }
      vertices = more;
    }
    return out;
  }
  const double* position(std::uint32_t v) const { return &mesh_.positions[3 * v]; }
  std::vector<double> centre(const std::uint32_t* v, double jitter, std::mt19937& random) const {
    std::uniform_real_distribution<double> offset(-jitter, jitter);
    std::vector<double> out(3, 0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = position(v[0])[k], b = position(v[1])[k], c = position(v[2])[k];
      out[k] = (a + b + c) / 3 + offset(random) * std::max({a, b, c}) - offset(random) * std::min({a, b, c});
      out[k] = (a + b + c) / 3 + offset(random) * (std::max({a, b, c}) - std::min({a, b, c}) + 0.1);
    }
    return out;
  }
  std::uint32_t add_vertex(const std::vector<double>& p) {
    added_positions_.insert(added_positions_.end(), p.begin(), p.end());
    return mesh_.vertex_count() + static_cast<std::uint32_t>(added_positions_.size() / 3) - 1;
  }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { added_.insert(added_.end(), {a, b, c}); }
  // A vertex parts in two: some of its triangles take a copy at the same place.
  void rip(std::uint32_t vertex, std::mt19937& random) {
    const std::uint32_t copy = add_vertex({position(vertex), position(vertex) + 3});
    for (std::uint32_t t = 0; t < alive_.size(); ++t) {
      std::uint32_t v[3] = {mesh_.triangles[3 * t], mesh_.triangles[3 * t + 1], mesh_.triangles[3 * t + 2]};
      if (!alive_[t] || std::find(v, v + 3, vertex) == v + 3 || random() % 2 == 0) continue;
      removed_.push_back(t);
      std::replace(v, v + 3, vertex, copy);
      add_triangle(v[0], v[1], v[2]);
    }
  }
  // A triangle more on an edge, which then has three, or on a border.
  void flap(std::uint32_t t, std::uint32_t k, std::mt19937& random) {
    const std::uint32_t* const v = &mesh_.triangles[3 * t];
    add_triangle(v[(k + 1) % 3], v[k], add_vertex(centre(v, 1.0, random)));
  }
  // A triangle that went comes again; its corners may be isolated.
  void fill(std::mt19937& random) {
    for (int attempt = 0; attempt < 100; ++attempt) {
      const auto t = static_cast<std::uint32_t>(random() % alive_.size());
      if (alive_[t]) continue;
      const std::uint32_t* const v = &mesh_.triangles[3 * t];
      const std::set<std::uint32_t> own(v, v + 3);
      bool there = false;
      for (std::uint32_t s = 0; s < alive_.size(); ++s)
        there = there ||
                (alive_[s] && own == std::set<std::uint32_t>(&mesh_.triangles[3 * s], &mesh_.triangles[3 * s] + 3));
      if (!there) return add_triangle(v[0], v[1], v[2]);
    }
  }
  void flip(std::uint32_t t, std::uint32_t k) {
    const std::uint32_t* const v = &mesh_.triangles[3 * t];
    const std::uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
    for (std::uint32_t s = 0; s < alive_.size(); ++s) {
      const std::uint32_t* const w = &mesh_.triangles[3 * s];
      for (std::size_t j = 0; j < 3 && alive_[s] && s != t; ++j) {
        if (w[j] != b || w[(j + 1) % 3] != a || w[(j + 2) % 3] == c) continue;
        removed_ = {t, s};
        add_triangle(a, w[(j + 2) % 3], c);
        add_triangle(b, c, w[(j + 2) % 3]);
        return;
      }
    }
  }

  hf_test::PlainMesh mesh_;
  std::vector<bool> alive_;
  std::vector<std::uint32_t> removed_, added_;
  std::vector<double> added_positions_;
};

// The values by vertex of the caller.
std::map<Index, double> field_of(const std::shared_ptr<const Core>& core, const Core& fresh, bool rebased = false) {
  std::vector<Site> sites;
  std::vector<Index> slots;
  std::vector<double> values;
  for (Index c = 0; c < fresh.mesh.component_count(); ++c) {  // three vertices of each component, by given numbers
    std::vector<Index> there;
    for (Index v = 0; v < fresh.size(); ++v)
      if (fresh.mesh.component[at(v)] == c) there.push_back(fresh.mesh.given_of_inner[at(v)]);
    std::sort(there.begin(), there.end());
    const std::set<Index> chosen = {there.front(), there[there.size() / 2], there.back()};
    for (const Index given : chosen) {
      const bool soft = slots.size() % 3 == 1 && chosen.size() > 1;
      sites.push_back(Site::at_vertex(core->mesh, core->mesh.inner_of_given[at(given)], soft ? 0.3 : 0));
      values.push_back(static_cast<double>(slots.size() % 5) - 1.5);
      slots.push_back(static_cast<Index>(slots.size()));
    }
  }
  const auto solver = hf_inner::solve::SiteSolver::make(core);
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  solver->edit(edit);
  if (rebased) solver->rebase(*core->jobs);
  std::vector<double> u(at(core->size())), some(1);
  solver->solve(values.data(), 1, u.data(), nullptr);
  const Index middle = core->size() / 2;
  solver->solve_at(values.data(), 1, {&middle, 1}, some.data());
  EXPECT_NEAR(some[0], u[at(middle)], 1e-10);
  std::map<Index, double> out;
  for (Index v = 0; v < core->size(); ++v) out[core->mesh.given_of_inner[at(v)]] = u[at(v)];
  return out;
}

double difference(const std::map<Index, double>& a, const std::map<Index, double>& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double worst = 0;
  for (const auto& [given, value] : a)
    worst = std::max(worst, b.count(given) ? std::fabs(value - b.at(given)) : HUGE_VAL);
  return worst;
}

void expect_same_operator(const Core& edited, const Core& fresh, const std::string& what) {
  ASSERT_EQ(edited.size(), fresh.size()) << what;
  ASSERT_EQ(edited.mesh.component_count(), fresh.mesh.component_count()) << what;
  std::map<Index, Index> component;
  for (Index v = 0; v < fresh.size(); ++v) {
    const Index given = fresh.mesh.given_of_inner[at(v)], own = edited.mesh.inner_of_given[at(given)];
    ASSERT_NE(own, Mesh::none) << what << " vertex " << given;
    EXPECT_EQ(edited.mesh.given_of_inner[at(own)], given) << what;
    const Index c = fresh.mesh.component[at(v)], there = edited.mesh.component[at(own)];
    EXPECT_EQ(component.emplace(c, there).first->second, there) << what;
    EXPECT_NEAR(edited.areas[at(own)] * edited.mesh.scale * edited.mesh.scale,
                fresh.areas[at(v)] * fresh.mesh.scale * fresh.mesh.scale, 1e-12)
        << what;
    std::map<Index, double> row;
    for (Index i = fresh.matrix().column_start[at(v)]; i < fresh.matrix().column_start[at(v) + 1]; ++i)
      row[fresh.mesh.given_of_inner[at(fresh.matrix().row[at(i)])]] += fresh.matrix().value[at(i)];
    const double most = 1e-10 * (1 + std::fabs(row[given]));
    for (Index i = edited.matrix().column_start[at(own)]; i < edited.matrix().column_start[at(own) + 1]; ++i)
      row[edited.mesh.given_of_inner[at(edited.matrix().row[at(i)])]] -= edited.matrix().value[at(i)];
    for (const auto& [u, value] : row) ASSERT_NEAR(value, 0, most) << what << " row " << given << " column " << u;
  }
  for (const auto& [c, there] : component)
    EXPECT_NEAR(edited.mean_diagonal[at(there)], fresh.mean_diagonal[at(c)], 1e-10 * fresh.mean_diagonal[at(c)])
        << what;
  const hf_inner::mesh::MeshReport &a = edited.geometry->mesh_report(), &b = fresh.geometry->mesh_report();
  EXPECT_EQ(a.boundary_edge_count, b.boundary_edge_count) << what;
  EXPECT_EQ(a.non_manifold_edge_count, b.non_manifold_edge_count) << what;
  EXPECT_EQ(a.flipped_edge_count, b.flipped_edge_count) << what;
  EXPECT_EQ(a.isolated_vertex_count, b.isolated_vertex_count) << what;
  EXPECT_EQ(a.degenerate_triangle_count, b.degenerate_triangle_count) << what;
  EXPECT_NEAR(a.smallest_angle, b.smallest_angle, 1e-9) << what;
}

hf_test::PlainMesh three_pieces() {
  hf_test::PlainMesh mesh = hf_test::torus(40, 24);
  append(mesh, hf_test::grid(12, 9, 1, 0.3), 30);
  append(mesh, hf_test::grid(1, 1, 1), 50);
  return mesh;
}

// Triangles go and come at random, between strokes of stiffness; pieces part and join.
TEST(PatchEdit, SequencesHaveTheFieldsOfFreshSurfaces) {
  for (const auto kind : {hf_inner::mesh::OperatorKind::intrinsic_delaunay, hf_inner::mesh::OperatorKind::cotangent,
                          hf_inner::mesh::OperatorKind::uniform, hf_inner::mesh::OperatorKind::clamped}) {
    for (const double most : {always_rows, never_rows}) {
      std::mt19937 random(7);
      Model model(three_pieces());
      hf_inner::surface::CoreOptions options;
      options.operator_kind = kind;
      std::shared_ptr<const Core> core = make(model.now(), options);
      for (int step = 0; step < 16; ++step) {
        const std::string what = "operator " + std::to_string(static_cast<int>(kind)) + " most " +
                                 std::to_string(most) + " step " + std::to_string(step);
        std::shared_ptr<const Geometry> geometry;
        if (step % 8 == 7) {
          geometry = model.cut(*core, model.walk(random, 6));
        } else {
          model.change(step % 8, random);
          geometry = model.apply(*core);
        }
        core = edit_core(core, {nullptr, geometry}, most);
        const auto fresh = make(model.now(), options);
        expect_same_operator(*core, *fresh, what);
        const auto exact = field_of(fresh, *fresh);
        EXPECT_LT(difference(field_of(core, *fresh), exact), 1e-9) << what;
        EXPECT_LT(difference(field_of(core, *fresh, true), exact), 1e-9) << what << " rebased";
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

// 10,000 edits (of 300 in the short form): the difference from fresh surfaces does not grow.
TEST(PatchEdit, ManyEditsAddNoError) {
  const int steps = hf_test::is_full() ? 10000 : 300;
  std::mt19937 random(11);
  Model model(three_pieces());
  std::shared_ptr<const Core> core = make(model.now());
  for (int step = 1; step <= steps; ++step) {
    const int kind = static_cast<int>(random() % 8);
    std::shared_ptr<const Geometry> geometry;
    try {
      if (kind != 7) model.change(model.now().triangle_count() > 3000 ? 1 : kind, random, 1);
      geometry = kind == 7 ? model.cut(*core, model.walk(random, 6)) : model.apply(*core);
    } catch (const hf_inner::Error&) {  // an edge alone parts nothing, and two triangles may not be one
      model.forget();
      continue;
    }
    core = edit_core(core, {nullptr, geometry});
    if (step % 100 != 0) continue;
    const auto fresh = make(model.now());
    EXPECT_LT(difference(field_of(core, *fresh), field_of(fresh, *fresh)), 1e-11) << step;
  }
}

// Where a cut ends: inside a surface, on its border, in a loop, and beside another fan.
// The factor of a patched surface orders its new vertices: in the caller's order it had three times the entries.
TEST(PatchEdit, ManyNewVerticesInAnyOrderFillLittleMoreThanAFreshFactor) {
  const hf_test::PlainMesh torus = hf_test::torus(100, 100);
  Model model(torus);
  std::mt19937 random(5);
  const auto before = make(torus);
  model.renew(2400, random);
  const auto after = edit_core(before, {nullptr, model.apply(*before)}, never_rows);
  const double fresh = make(model.now())->factor->statistics().entries;
  EXPECT_LT(after->factor->statistics().entries, 1.5 * fresh);
}

TEST(CutEdges, PartsWhatItShould) {
  hf_test::PlainMesh mesh = hf_test::grid(4, 4);  // 5 x 5 vertices
  const std::shared_ptr<const Core> core = make(mesh);
  struct Case {
    std::vector<std::uint32_t> edges;
    std::size_t copies;
    Index components;
  };
  const Case cases[] = {
      {{6, 7, 7, 8}, 1, 1},                                                // inside: the middle parts
      {{5, 6}, 1, 1},                                                      // from the border: its end there parts
      {{10, 11, 11, 12, 12, 13, 13, 14}, 5, 2},                            // from border to border
      {{6, 7, 7, 8, 8, 13, 13, 18, 18, 17, 17, 16, 16, 11, 11, 6}, 8, 2},  // a loop
      {{11, 12, 12, 13, 7, 12, 12, 17}, 3, 1},                             // a cross: its middle is four
      {{0, 1, 1, 2, 6, 7, 7, 12}, 1, 1},                                   // the border itself parts nothing
  };
  for (const Case& one : cases) {
    Model model(mesh);
    const auto geometry = model.cut(*core, one.edges);
    EXPECT_EQ(geometry->mesh.report.vertex_count - 25, one.copies);
    EXPECT_EQ(geometry->mesh.component_count(), one.components);
    const auto edited = edit_core(core, {nullptr, geometry}, always_rows);
    expect_same_operator(*edited, *make(model.now()), "cut");
  }
  for (const std::vector<std::uint32_t>& edges :
       {std::vector<std::uint32_t>{6, 7}, {0, 1}, {0, 12}, {3, 3}, {3, 25}, {1, 2, 20, 24}})
    EXPECT_THROW(hf_inner::mesh::cut_edges(core->mesh, {edges.data(), edges.size()}, *core->memory), hf_inner::Error);
}

}  // namespace
