// The subject of unchanged_solver.cpp and its calls (unchanged_solver_calls.cpp).
#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "support/arrays.h"
#include "support/peers.h"
#include "unchanged.h"

namespace unchanged {

struct Place {
  std::uint32_t vertex = HF_NO_INDEX;
  bool inside = false;  // else at the vertex
  hf_place place{};
};
using Places = std::map<std::uint32_t, Place>;  // by number

// What hf_solver_set_screening was given last, or nothing.
struct Screening {
  std::vector<double> strength, targets;
  hf_result set(hf_solver solver) const {
    return hf_solver_set_screening(solver, strength.empty() ? nullptr : strength.data(),
                                   targets.empty() ? nullptr : targets.data());
  }
};

struct SolverModel {
  Places places;
  Screening screening;
};
using SolverBranch = Clonable<hf_solver, hf_solver_destroy, SolverModel>;

// Places in the form of hf_sites_desc, which borrows from this object.
struct Lists {
  std::vector<Place> places;
  std::vector<std::uint32_t> vertices;
  std::vector<hf_place> inside;
  std::vector<double> values, stiffness, radii, points;
  hf_sites_desc desc = HF_INIT(hf_sites_desc);
  void finish() {
    for (const Place& p : places) {
      vertices.push_back(p.vertex);
      inside.push_back(p.place);
    }
    desc.site_count = static_cast<std::uint32_t>(places.size());
    if (!points.empty())
      desc.points = points.data();
    else if (places.empty() || !places[0].inside)
      desc.vertices = vertices.data();
    else
      desc.places = inside.data();
    if (!values.empty()) desc.values = values.data();
    if (!stiffness.empty()) desc.stiffness = stiffness.data();
    if (!radii.empty()) desc.radii = radii.data();
  }
};

class Solvers final : public Subject {
 public:
  Solvers(World& given, Random& random) : Subject(given) {
    desc_.field_kind = random.pick({0, 0, 0, 1, 2});
    engine_ = random.pick({0, 0, 0, 0, 0, 1, 2});
    desc_.channel_count = random.pick({1u, 1u, 3u, 2u});
    desc_.site_limit = random.pick({0u, 0u, 12u});
    channels_ = desc_.channel_count;
    if (random.one_in(6)) make_graph(random);
    hf_solver made = nullptr;
    if (engine_ == ENGINE_UPDOWN && !has_gpl()) engine_ = ENGINE_GREEN;
    const hf_result result = create_with(engine_, surface(), &desc_, &made);
    if (result == HF_OK) branches_.emplace_back(made, SolverModel());
  }
  ~Solvers() override { hf_surface_destroy(graph_); }
  bool ready() const { return !branches_.empty(); }

  void glance(State& state) override {
    for (const SolverBranch& b : branches_) {
      hf_solver_statistics statistics = HF_INIT(hf_solver_statistics);
      hf_solver_info info = HF_INIT(hf_solver_info);
      state.begin("statistics of a solver");
      state.add(hf_solver_get_statistics(b.handle, &statistics));
      statistics.sweep_count = 0;
      add_struct(state, statistics);
      state.begin("info of a solver");
      state.add(hf_solver_get_info(b.handle, &info));
      add_struct(state, info);
      state.add(hf_solver_get_site_count(b.handle));
    }
  }
  void look(State& state) override {
    for (const SolverBranch& b : branches_) {
      look_at_field(b, state);
      const std::uint32_t count = hf_solver_get_site_count(b.handle);
      std::vector<std::uint32_t> numbers(count), vertices(count), components(count);
      std::vector<double> values(count * channels_), stiffness(count), flux(count * channels_), radii(count);
      hf_sites_info sites = HF_INIT(hf_sites_info);
      sites.capacity = count;
      sites.sites = numbers.data();
      sites.vertices = vertices.data();
      sites.components = components.data();
      sites.values = values.data();
      sites.stiffness = stiffness.data();
      sites.flux = flux.data();
      sites.radii = radii.data();
      state.begin("sites of a solver");
      state.add(hf_solver_get_sites(b.handle, &sites));
      state.add(numbers);
      state.add(vertices);
      state.add(components);
      state.add(values);
      state.add(stiffness);
      state.add(radii);
      state.begin("flux of a solver");
      state.add(flux);
      expect(count == b.places.size(), "the number of sites is not that of the model");
      for (std::uint32_t i = 0; i < count && wrong.empty(); ++i)
        expect(b.places.count(numbers[i]) && vertex_of(b.places.at(numbers[i])) == vertices[i], "a site is elsewhere");
      hf_certificate certificate = HF_INIT(hf_certificate);
      state.begin("certificate");
      state.add(hf_solver_certify(b.handle, &certificate));
      add_struct(state, certificate);
    }
  }

  std::string compare_fresh() override {
    for (const SolverBranch& b : branches_) {
      const std::string fault = compare_fresh(b);
      if (!fault.empty()) return fault;
    }
    return {};
  }

  const std::vector<Command>& commands() const override;

 private:
  friend struct SolverCalls;
  // That of the world, or the graph of its edges.
  hf_surface surface() const { return graph_ ? graph_ : world.surface; }
  void make_graph(Random& random);
  std::size_t rows() const { return world.shape->vertices() * channels_; }
  SolverBranch& any(Random& random) { return branches_[random.below(static_cast<std::uint32_t>(branches_.size()))]; }
  std::uint64_t look_at_field(const SolverBranch& b, State& state) const {
    std::vector<double> field(rows());
    hf_solve_info info = HF_INIT(hf_solve_info);
    state.begin("field of a solver");
    state.add(hf_solver_solve(b.handle, OUT(field.data()), &info));
    state.add(field);
    add_struct(state, info);
    return state.last();
  }
  std::uint64_t field_of(const SolverBranch& b) {
    world.memory.disarm();
    State state;
    return look_at_field(b, state);
  }

  // The vertex that the library names: the given one, or the first copy of the only corner that counts.
  std::uint32_t vertex_of(const Place& p) const {
    if (!p.inside) return p.vertex;
    std::uint32_t only = HF_NO_INDEX, counting = 0;
    for (int k = 0; k < 3; ++k) {
      if (!(p.place.barycentrics[k] > 0)) continue;
      only = p.place.corners[k];
      ++counting;
    }
    if (counting != 1) return HF_NO_INDEX;
    const float* const all = world.shape->positions.data();
    for (std::uint32_t v = 0; v < only; ++v) {
      if (std::equal(all + 3 * v, all + 3 * v + 3, all + 3 * std::size_t{only})) return v;
    }
    return only;
  }
  Place place(Random& random, bool inside) const {
    Place p;
    if (!inside) return p.vertex = random.index(world.shape->vertices()), p;
    const std::uint32_t triangle = random.index(world.shape->count());
    const std::uint32_t i = random.below(5), j = random.below(5 - i);
    double weights[3] = {i / 4.0, j / 4.0, (4 - i - j) / 4.0};
    if (random.one_in(30)) weights[random.below(3)] += random.pick({0.5, -1.0, 1e-3});
    p.inside = true;
    p.place = place_in(world.shape->triangles.data(), world.shape->count(), triangle, weights);
    return p;
  }
  // A vertex of a triangle, as a place: the nearest place to its position.
  Place corner(Random& random) const {
    Place p;
    p.inside = true;
    const std::uint32_t any = random.below(static_cast<std::uint32_t>(world.shape->triangles.size()));
    p.place = {{world.shape->triangles[any], HF_NO_INDEX, HF_NO_INDEX}, 0, {1, 0, 0}};
    return p;
  }
  std::uint32_t number(const SolverBranch& b, Random& random) const {
    if (b.places.empty() || random.one_in(15)) return random.below(40);
    return std::next(b.places.begin(), random.below(static_cast<std::uint32_t>(b.places.size())))->first;
  }
  std::vector<std::uint32_t> numbers(const SolverBranch& b, Random& random) const {
    std::vector<std::uint32_t> list(1 + random.below(3));
    for (std::uint32_t& n : list) n = number(b, random);
    return list;
  }
  std::vector<double> values(std::size_t count, Random& random) const {
    std::vector<double> list(count);
    for (double& v : list) v = random.number();
    return list;
  }
  void take_places(Lists& lists, std::size_t count, Random& random, bool adding) const {
    const bool points = !graph_ && random.one_in(5), inside = random.one_in(3);
    for (std::size_t i = 0; i < count; ++i) {
      lists.places.push_back(points ? corner(random) : place(random, inside));
      for (std::uint32_t k = 0; points && k < 3; ++k)
        lists.points.push_back(static_cast<double>(world.shape->positions[3 * lists.places[i].place.corners[0] + k]));
    }
    if (points && count > 0 && random.one_in(12)) lists.points.back() = random.pick({HUGE_VAL, 1e300});  // refused
    if (adding && !random.one_in(6)) lists.values = values(count * channels_, random);
    for (std::size_t i = 0; adding && i < count && (i > 0 ? !lists.stiffness.empty() : random.one_in(4)); ++i)
      lists.stiffness.push_back(random.pick({0.0, 1.0, 1e-3, 1e5, random.number()}));
    for (std::size_t i = 0; adding && i < count && (i > 0 ? !lists.radii.empty() : random.one_in(8)); ++i)
      lists.radii.push_back(random.pick({0.0, 1.5, 0.4, random.number()}));
    lists.finish();
  }
  // What follows an edit that was done.
  void edited(SolverBranch& b, std::uint32_t rebases, bool refused) {
    const bool waited = waiting_.erase(b.handle) > 0;
    if (waited && !refused) {
      hf_solver_statistics now = HF_INIT(hf_solver_statistics);
      expect(hf_solver_get_statistics(b.handle, &now) == HF_OK && now.rebase_count > rebases,
             "the waiting rebase was not taken over by an edit that was done");
    }
  }
  std::uint32_t rebases(const SolverBranch& b) const {
    hf_solver_statistics now = HF_INIT(hf_solver_statistics);
    return hf_solver_get_statistics(b.handle, &now) == HF_OK ? now.rebase_count : 0;
  }
  std::string compare_fresh(const SolverBranch& b) const;

  hf_surface graph_ = nullptr;
  hf_solver_desc desc_ = HF_INIT(hf_solver_desc);
  std::int32_t engine_ = ENGINE_GREEN;
  std::size_t channels_ = 1;
  std::vector<SolverBranch> branches_;
  std::set<hf_solver> waiting_;  // solvers with a rebase that waits
};

}  // namespace unchanged
