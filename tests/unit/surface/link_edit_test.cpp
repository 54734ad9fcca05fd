// Surfaces whose links were edited, against surfaces made with the same links and against dense solves.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solve/site_solver.h"
#include "support/hard_meshes.h"
#include "support/oracle.h"
#include "surface/edited_core.h"
#include "surface/link_change.h"
#include "surface/surface.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::mesh::Link;
using hf_inner::mesh::Mesh;
using hf_inner::solve::Site;
using hf_inner::surface::Core;
using hf_inner::surface::Geometry;

constexpr double always_rows = 1e9, never_rows = 0;
using Stiffness = std::shared_ptr<const hf_inner::Vector<double>>;

// Five pieces; the third has one triangle.
hf_test::PlainMesh five_pieces() {
  hf_test::PlainMesh mesh = hf_test::grid(14, 11, 1, 0.3);
  append(mesh, hf_test::torus(16, 9), 30);
  append(mesh, hf_test::grid(1, 1, 1), 50);
  mesh.triangles.resize(mesh.triangles.size() - 3);
  append(mesh, hf_test::torus(12, 7), 70);
  append(mesh, hf_test::grid(6, 6, 1, 0.2), 90);
  return mesh;
}

class LinkEdit : public ::testing::Test {
 protected:
  LinkEdit() : unlinked_(hf_test::make_core(five_pieces())->geometry) {}
  const Mesh& mesh() const { return unlinked_->mesh; }
  Index below(Index limit) { return std::uniform_int_distribution<Index>(0, limit - 1)(random_); }
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  // A link from a vertex to a point of a triangle, to an edge or to a vertex, of another piece or of the same.
  Link link(bool across = true) {
    for (;;) {
      Link made;
      made.vertex = below(mesh().vertex_count());
      const Index* const corner = mesh().triangle(below(mesh().triangle_count()));
      const bool crosses = mesh().component[at(corner[0])] != mesh().component[at(made.vertex)];
      if (crosses != across || std::find(corner, corner + 3, made.vertex) != corner + 3) continue;
      const int used = 1 + below(3);
      double sum = 0;
      for (int k = 0; k < used; ++k) sum += made.share[k] = number(0.1, 1);
      for (int k = 0; k < used; ++k) {
        made.share[k] /= sum;
        made.corner[k] = corner[k];
      }
      made.weight = number(0.2, 3);
      return made;
    }
  }
  std::shared_ptr<const Geometry> linked(const std::vector<Link>& links) {
    hf_inner::mesh::LinkOptions options;
    options.mode = hf_inner::mesh::LinkMode::list;
    options.stiffness = stiffness_of_links_;
    options.list = {links.data(), links.size()};
    options.light = light_;
    return Geometry::linked(unlinked_, options);
  }
  std::shared_ptr<const Core> fresh(const std::vector<Link>& links, const Stiffness& stiffness) {
    hf_inner::surface::CoreOptions options;
    options.stiffness = stiffness;
    return Core::make(linked(links), options);
  }
  // The geometry after links go out, each with a chance, and others come in.
  std::shared_ptr<const Geometry> change(const Core& from, std::vector<Link>& links, double chance, int added,
                                         bool across) {
    std::vector<std::uint8_t> removed(links.size(), 0);
    std::vector<Link> kept, more;
    for (std::size_t i = 0; i < links.size(); ++i) {
      removed[i] = number(0, 1) < chance;
      if (!removed[i]) kept.push_back(links[i]);
    }
    for (int i = 0; i < added; ++i) more.push_back(link(across));
    links = kept;
    links.insert(links.end(), more.begin(), more.end());
    return Geometry::relinked(from.geometry, hf_inner::surface::edited_links(mesh(), from.geometry->links.get(),
                                                                             {removed.data(), removed.size()},
                                                                             {more.data(), more.size()}, *from.memory));
  }
  Stiffness stroke(const Stiffness& before) {
    auto out = std::make_shared<hf_inner::Vector<double>>(at(mesh().vertex_count()), 1.0, unlinked_->memory.get());
    if (before) *out = *before;
    const double s = std::pow(10.0, number(-3, 3)), radius = number(0.02, 0.15);
    const hf_inner::Vec3 centre = mesh().positions[at(below(mesh().vertex_count()))];
    for (std::size_t v = 0; v < out->size(); ++v)
      if (norm(mesh().positions[v] - centre) < radius) (*out)[v] = s;
    return out;
  }

  std::mt19937 random_{5};
  std::shared_ptr<const Geometry> unlinked_;
  std::vector<Index> light_;
  double stiffness_of_links_ = 1;
};

std::vector<Site> sites_on(const Core& core) {
  std::vector<Site> sites;
  for (Index c = 0; c < core.mesh.component_count(); ++c) {
    std::vector<Index> there;
    for (Index v = 0; v < core.size(); ++v)
      if (core.mesh.component[at(v)] == c) there.push_back(v);
    sites.push_back(Site::at_vertex(core.mesh, there[there.size() / 3]));
    sites.push_back(Site::at_vertex(core.mesh, there.back(), 0.3));
    sites.push_back(Site::at_vertex(core.mesh, there[there.size() / 2 + 1]));
  }
  return sites;
}

double value_of(std::size_t site) { return site % 2 == 0 ? 1.0 : -2.5; }

std::vector<double> field_of(const std::shared_ptr<const Core>& core, bool rebased = false) {
  const std::vector<Site> sites = sites_on(*core);
  std::vector<Index> slots;
  std::vector<double> values;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    slots.push_back(static_cast<Index>(i));
    values.push_back(value_of(i));
  }
  const auto solver = hf_inner::solve::SiteSolver::make(core);
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  solver->edit(edit);
  if (rebased) solver->rebase(*core->jobs);
  std::vector<double> u(at(core->size()));
  solver->solve(values.data(), 1, u.data(), nullptr);
  return u;
}

double error_of(const std::shared_ptr<const Core>& core, bool rebased = false) {
  const std::vector<Site> sites = sites_on(*core);
  Eigen::MatrixXd exact(static_cast<Eigen::Index>(sites.size()), 1);
  for (std::size_t i = 0; i < sites.size(); ++i) exact(static_cast<Eigen::Index>(i), 0) = value_of(i);
  const std::vector<double> u = field_of(core, rebased);
  const Eigen::MatrixXd field = hf_test::dense_field(*core, sites, exact);
  double worst = 0;
  for (Index v = 0; v < core->size(); ++v) worst = std::max(worst, std::fabs(u[at(v)] - field(v, 0)));
  return worst;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
  return worst;
}

void expect_same_operator(const Core& edited, const Core& fresh, const std::string& what) {
  ASSERT_EQ(edited.mesh.component_count(), fresh.mesh.component_count()) << what;
  for (std::size_t v = 0; v < fresh.mesh.component.size(); ++v)
    ASSERT_EQ(edited.mesh.component[v], fresh.mesh.component[v]) << what << " vertex " << v;
  EXPECT_EQ(edited.ground, fresh.ground) << what;
  for (std::size_t c = 0; c < fresh.ground.size(); ++c)
    EXPECT_NEAR(edited.mean_diagonal[c], fresh.mean_diagonal[c], 1e-12 * fresh.mean_diagonal[c]) << what;
  ASSERT_EQ(edited.matrix().row, fresh.matrix().row) << what;
  for (std::size_t i = 0; i < fresh.matrix().value.size(); ++i)
    ASSERT_NEAR(edited.matrix().value[i], fresh.matrix().value[i], 1e-12 * (1 + std::fabs(fresh.matrix().value[i])))
        << what << " entry " << i;
  EXPECT_EQ(edited.geometry->given_count, fresh.geometry->given_count) << what;
  EXPECT_EQ(edited.topology().edges, fresh.topology().edges) << what;
  for (std::size_t e = 0; e < fresh.weights().size(); ++e)
    ASSERT_NEAR(edited.weights()[e], fresh.weights()[e], 1e-12 * (1 + std::fabs(fresh.weights()[e]))) << what;
}

// Pieces join and part at random, between strokes of stiffness.
TEST_F(LinkEdit, SequencesHaveTheFieldsOfFreshSurfacesAndOfDenseSolves) {
  for (const double most : {always_rows, never_rows}) {
    for (const bool light : {false, true}) {
      light_.assign(light ? 1 : 0, mesh().vertex_count() - 1);
      stiffness_of_links_ = light ? 0.4 : 1;
      std::vector<Link> links;
      for (int i = 0; i < 4; ++i) links.push_back(link());
      std::shared_ptr<const Core> core = fresh(links, nullptr);
      Stiffness stiffness;
      for (int step = 0; step < 10; ++step) {
        const std::string what = "step " + std::to_string(step) + " most " + std::to_string(most);
        std::shared_ptr<const Geometry> geometry = core->geometry;
        const int kind = step % 5;
        if (kind != 3) geometry = change(*core, links, kind == 0 ? 0.7 : 0.3, below(4), true);
        if (kind == 3) stiffness = stroke(stiffness);
        if (kind == 4 && below(2)) stiffness = nullptr;
        core = edit_core(core, {stiffness, geometry}, most);
        if (links.empty()) continue;  // a fresh surface without links has no light pieces
        const auto same = fresh(links, stiffness);
        expect_same_operator(*core, *same, what);
        EXPECT_LT(error_of(core), 1e-10) << what;
        EXPECT_LT(error_of(core, true), 1e-10) << what << " rebased";
        EXPECT_LT(difference(field_of(core), field_of(same)), 1e-10) << what;
        EXPECT_EQ(core->factored != nullptr, most == always_rows) << what;
      }
    }
  }
}

// One link joins two pieces; without it they are two again, and the last core is the first.
TEST_F(LinkEdit, BackAndForthIsTheCoreBefore) {
  const std::shared_ptr<const Core> plain = hf_test::make_core(five_pieces());
  unlinked_ = plain->geometry;
  std::vector<Link> links;
  const auto joined = edit_core(plain, {nullptr, change(*plain, links, 0, 1, true)}, always_rows);
  EXPECT_EQ(joined->mesh.component_count(), plain->mesh.component_count() - 1);
  expect_same_operator(*joined, *fresh(links, nullptr), "joined");
  EXPECT_LT(error_of(joined), 1e-10);
  EXPECT_EQ(edit_core(joined, {nullptr, plain->geometry}, always_rows), plain);
}

// Links inside a piece add to its edges, or make new ones.
TEST_F(LinkEdit, LinksInsideAPieceAddToItsEdges) {
  std::vector<Link> links;
  for (int i = 0; i < 3; ++i) links.push_back(link());
  std::shared_ptr<const Core> core = fresh(links, nullptr);
  for (int step = 0; step < 6; ++step) {
    core = edit_core(core, {nullptr, change(*core, links, 0.4, 3, step % 2 == 0)}, always_rows);
    if (links.empty()) continue;
    const auto same = fresh(links, nullptr);
    EXPECT_LT(difference(field_of(core), field_of(same)), 1e-10) << step;
    EXPECT_LT(error_of(core), 1e-10) << step;
  }
}

TEST_F(LinkEdit, ALinkCostsPathsAndNoNewFactor) {
  std::vector<Link> links = {link()};
  const std::shared_ptr<const Core> core = fresh(links, nullptr);
  const double before = static_cast<double>(core->memory->live_bytes());
  const auto edited = edit_core(core, {nullptr, change(*core, links, 0, 1, true)}, always_rows);
  EXPECT_NE(edited->factored, nullptr);
  EXPECT_LT(static_cast<double>(core->memory->live_bytes()) - before, 0.5 * core->factor->statistics().bytes);
}

// A solver that moves takes the paths of its sites along: to an edit, between two edits, and back.
TEST_F(LinkEdit, AMoveSolvesNoPathAgain) {
  std::vector<Link> links = {link(), link()};
  const std::shared_ptr<const Core> core = fresh(links, nullptr);
  const auto joined = edit_core(core, {nullptr, change(*core, links, 0, 2, true)}, always_rows);
  const auto stiff = edit_core(joined, {stroke(nullptr), joined->geometry}, always_rows);
  std::shared_ptr<hf_inner::solve::SiteSolver> solver = hf_inner::solve::SiteSolver::make(core);
  for (const auto& next : {joined, stiff, core, stiff}) {
    const std::vector<Site> sites = sites_on(*core);
    std::vector<Index> slots;
    std::vector<Site> there;
    std::vector<double> values, moved(at(core->size())), again(moved.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
      slots.push_back(static_cast<Index>(i));
      values.push_back(value_of(i));
      there.push_back(sites[i]);
      there.back().component = next->mesh.component[at(sites[i].vertex[0])];
    }
    hf_inner::solve::SiteEdit edit;
    edit.add = slots;
    edit.sites = there;
    const bool first = solver->slot_count() == 0;
    solver = solver->on(next);
    solver->edit(edit);
    EXPECT_EQ(solver->counters().path_solves, first ? sites.size() : 0);
    const auto oracle = hf_inner::solve::SiteSolver::make(next);
    oracle->edit(edit);
    solver->solve(values.data(), 1, moved.data(), nullptr);
    oracle->solve(values.data(), 1, again.data(), nullptr);
    EXPECT_LT(difference(moved, again), 1e-12);
  }
}

// The bi-harmonic kinds are made anew.
TEST_F(LinkEdit, BiharmonicFieldsAreThoseOfFreshSurfaces) {
  for (const auto kind : {hf_inner::mesh::FieldKind::biharmonic, hf_inner::mesh::FieldKind::biharmonic_graph}) {
    std::vector<Link> links = {link(), link()};
    hf_inner::surface::CoreOptions options;
    options.field_kind = kind;
    std::shared_ptr<const Core> core = Core::make(linked(links), options);
    const auto edited = edit_core(core, {nullptr, change(*core, links, 0.5, 2, true)});
    const auto same = Core::make(linked(links), options);
    EXPECT_EQ(field_of(edited), field_of(same));
  }
}

}  // namespace
