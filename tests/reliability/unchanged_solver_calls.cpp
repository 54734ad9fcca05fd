// The calls on solvers.
#include <algorithm>

#include "unchanged_solver.h"
#include "support/arrays.h"

namespace unchanged {

struct SolverCalls {
  static Solvers& of(Subject& s) { return static_cast<Solvers&>(s); }

  static hf_result add(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    SolverBranch& b = s.any(random);
    Lists lists;
    s.take_places(lists, random.one_in(10) ? 20 + random.below(40) : 1 + random.below(4), random, true);
    std::vector<std::uint32_t> out(lists.places.size());
    const std::uint32_t rebases = s.rebases(b);
    const std::size_t refused = s.world.memory.refused;
    const hf_result result = hf_add_sites(b.handle, random.spoiled(lists.desc), out.data());
    if (result != HF_OK) return result;
    for (std::size_t i = 0; i < out.size(); ++i) b.places[out[i]] = lists.places[i];
    return s.edited(b, rebases, s.world.memory.refused > refused), result;
  }
  static hf_result add_one(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    SolverBranch& b = s.any(random);
    const Place place = s.place(random, false);
    const std::vector<double> values = s.values(s.channels_, random);
    std::uint32_t out = 0;
    const std::uint32_t rebases = s.rebases(b);
    const std::size_t refused = s.world.memory.refused;
    const hf_result result = hf_solver_add_site(b.handle, place.vertex, values.data(), &out);
    if (result == HF_OK) {
      b.places[out] = place;
      s.edited(b, rebases, s.world.memory.refused > refused);
    }
    return result;
  }
  static hf_result remove(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    SolverBranch& b = s.any(random);
    const std::vector<std::uint32_t> list = s.numbers(b, random);
    const std::uint32_t rebases = s.rebases(b);
    const std::size_t refused = s.world.memory.refused;
    const hf_result result = hf_remove_sites(b.handle, static_cast<std::uint32_t>(list.size()), list.data());
    if (result != HF_OK) return result;
    for (const std::uint32_t n : list) b.places.erase(n);
    return s.edited(b, rebases, s.world.memory.refused > refused), result;
  }
  static hf_result move(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    SolverBranch& b = s.any(random);
    const std::vector<std::uint32_t> list = s.numbers(b, random);
    Lists to;
    s.take_places(to, list.size() + (random.one_in(30) ? 1 : 0), random, false);
    const std::uint32_t rebases = s.rebases(b);
    const std::size_t refused = s.world.memory.refused;
    const hf_result result =
        hf_solver_move_sites(b.handle, static_cast<std::uint32_t>(list.size()), list.data(), random.spoiled(to.desc));
    if (result != HF_OK) return result;
    for (std::size_t i = 0; i < list.size(); ++i) b.places[list[i]] = to.places[i];
    return s.edited(b, rebases, s.world.memory.refused > refused), result;
  }
  static hf_result set(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    SolverBranch& b = s.any(random);
    const std::vector<std::uint32_t> list = s.numbers(b, random);
    const std::vector<double> values = s.values(list.size() * s.channels_, random);
    const std::uint32_t rebases = s.rebases(b);
    const std::size_t refused = s.world.memory.refused;
    const hf_result result =
        hf_solver_set_values(b.handle, static_cast<std::uint32_t>(list.size()), list.data(), values.data());
    if (result == HF_OK) s.edited(b, rebases, s.world.memory.refused > refused);
    return result;
  }
  static hf_result batch(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    SolverBranch& b = s.any(random);
    const std::vector<std::uint32_t> gone = s.numbers(b, random), moved = s.numbers(b, random),
                                     set = s.numbers(b, random);
    const std::vector<double> values = s.values(set.size() * s.channels_, random);
    Lists to, added;
    s.take_places(to, moved.size(), random, false);
    s.take_places(added, 1 + random.below(3), random, true);
    std::vector<std::uint32_t> out(added.places.size());
    hf_edit_desc edit = HF_INIT(hf_edit_desc);
    const bool removes = random.one_in(2), moves = random.one_in(2), sets = random.one_in(3), adds = random.one_in(2);
    if (removes) {
      edit.remove_count = static_cast<std::uint32_t>(gone.size());
      edit.remove_sites = gone.data();
    }
    if (moves) {
      edit.move_count = static_cast<std::uint32_t>(moved.size());
      edit.move_sites = moved.data();
    }
    if (moves) edit.move_to = random.spoiled(to.desc);
    if (sets) {
      edit.set_count = static_cast<std::uint32_t>(set.size());
      edit.set_sites = set.data();
    }
    edit.set_values = values.data();
    if (adds) edit.add = &added.desc;
    const std::uint32_t rebases = s.rebases(b);
    const std::size_t refused = s.world.memory.refused;
    const hf_result result = hf_solver_edit_sites(b.handle, random.spoiled(edit), out.data());
    if (result != HF_OK) return result;
    for (std::size_t i = 0; removes && i < gone.size(); ++i) b.places.erase(gone[i]);
    for (std::size_t i = 0; moves && i < moved.size(); ++i) b.places[moved[i]] = to.places[i];
    for (std::size_t i = 0; adds && i < out.size(); ++i) b.places[out[i]] = added.places[i];
    return s.edited(b, rebases, s.world.memory.refused > refused), result;
  }
  static hf_result vectors(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    SolverBranch& b = s.any(random);
    const std::vector<std::uint32_t> list = s.numbers(b, random);
    const std::uint32_t count = static_cast<std::uint32_t>(list.size());
    const bool turns = random.one_in(2);
    std::vector<std::uint32_t> to(count);
    for (std::uint32_t& v : to) v = random.index(s.world.shape->vertices());
    const std::vector<double> angles = s.values(count, random);
    const std::uint32_t rebases = s.rebases(b);
    const std::size_t refused = s.world.memory.refused;
    const hf_result result = turns ? hf_solver_rotate_vectors(b.handle, count, list.data(), angles.data())
                                   : hf_solver_move_vectors(b.handle, count, list.data(), to.data());
    if (result != HF_OK) return result;
    for (std::size_t i = 0; !turns && i < count; ++i) {
      Place place;
      place.vertex = to[i];
      b.places[list[i]] = place;
    }
    return s.edited(b, rebases, s.world.memory.refused > refused), result;
  }
  static hf_result screen(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    SolverBranch& b = s.any(random);
    if ((s.graph_ || s.engine_ != ENGINE_GREEN || s.desc_.field_kind != HF_FIELD_HARMONIC) && !random.one_in(4))
      return skipped;  // it would be refused
    Screening given;
    const std::uint32_t vertices = s.world.shape->vertices(), reach = 1 + random.below(vertices);
    if (!random.one_in(4)) given.strength.assign(vertices, 0.0);
    for (std::uint32_t v = 0; v < vertices && !given.strength.empty(); ++v) {
      if (v % reach == 0 || random.one_in(3)) given.strength[v] = random.real(0.01, 5);
    }
    if (!given.strength.empty() && random.one_in(6)) given.strength[random.below(vertices)] = random.number();
    if (!given.strength.empty() && random.one_in(2)) {
      given.targets.resize(s.rows());
      for (double& p : given.targets) p = random.real(-3, 3);
      if (random.one_in(6)) given.targets[random.below(vertices)] = random.number();
    }
    if (random.one_in(12)) std::fill(given.strength.begin(), given.strength.end(), 0.0);
    const hf_result result = given.set(b.handle);
    if (result == HF_OK) {
      b.screening = given;
      s.waiting_.erase(b.handle);
    }
    return result;
  }
  static hf_result prepare(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    const hf_solver solver = s.any(random).handle;
    const hf_result result = hf_solver_prepare_rebase(solver);
    if (result == HF_OK) s.waiting_.insert(solver);
    return result;
  }
  static hf_result clone(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    return s.Subject::clone(s.branches_, random, hf_solver_clone, [&](const auto& b) { return s.field_of(b); });
  }
  static hf_result go_back(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    return s.Subject::go_back(s.branches_, random, [&](const auto& b) { return s.field_of(b); });
  }
  static hf_result make(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    hf_solver_desc desc = s.desc_;
    desc.field_kind = random.pick({0, 1, 2, 3, -1});
    const std::int32_t engine = random.pick({0, 0, 1, 2});
    desc.channel_count = random.pick({1u, 0u, 65u});
    const double penalty = random.pick({0.0, 1e8, -1.0, 2e10, random.number()});
    desc.progress = s.world.progress();
    hf_solver made = s.branches_[0].handle;
    const hf_solver_desc* given = random.spoiled(desc);
    const hf_result result = engine == ENGINE_UPDOWN ? hf_peer_updown_create(s.surface(), given, penalty, &made)
                                                     : create_with(engine, s.surface(), given, &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused solver is no NULL");
    return hf_solver_destroy(made), result;
  }
  static hf_result destroy(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    if (s.branches_.size() < 2) return skipped;
    const std::size_t i = random.below(static_cast<std::uint32_t>(s.branches_.size()));
    const hf_solver gone = s.branches_[i].handle;
    s.branches_.erase(s.branches_.begin() + static_cast<std::ptrdiff_t>(i));
    return hf_solver_add_site(gone, 0, nullptr, nullptr) == HF_ERROR_INVALID_OBJECT ? HF_OK : HF_ERROR_INTERNAL;
  }
  static hf_result solve(Subject& subject, Random& random) {
    Solvers& s = of(subject);
    const SolverBranch& b = s.any(random);
    std::vector<double> field(s.rows());
    std::vector<float> single(s.rows());
    hf_solve_info info = HF_INIT(hf_solve_info);
    hf_preview_info preview = HF_INIT(hf_preview_info);
    hf_certificate certificate = HF_INIT(hf_certificate);
    const std::uint32_t stride = random.one_in(20) ? 1 : 0, at[2] = {random.index(s.world.shape->vertices()), 1};
    switch (random.below(6)) {
      case 0:
        return hf_solve(b.handle, single.data(), stride, random.spoiled(info));
      case 1:
        return hf_solver_solve(b.handle, OUT_ROWS(field.data(), stride), random.spoiled(info));
      case 2:
        return hf_solver_solve_at(b.handle, 1 + random.below(2), at, field.data());
      case 3:
        return hf_solver_solve_vectors(b.handle, OUT_ROWS(field.data(), stride), nullptr, nullptr);
      case 4:
        certificate.tolerance = random.pick({0.0, 1e-6, -1.0});
        return hf_solver_certify(b.handle, random.spoiled(certificate));
      default: {
        const hf_result result =
            hf_solver_solve_preview(b.handle, OUT_ROWS(field.data(), stride), random.pick({0u, 1u, 9u}), &preview);
        return hf_solver_release_preview(b.handle), result;
      }
    }
  }
  static hf_result handle(Subject& subject, Random& random) {
    const Solvers& s = of(subject);
    const auto other = reinterpret_cast<hf_solver>(s.world.surface);
    hf_solver bad = random.one_in(2) ? nullptr : other;
    return random.one_in(2) ? hf_solver_prepare_rebase(bad) : hf_solver_add_site(bad, 0, nullptr, nullptr);
  }
};

const std::vector<Command>& Solvers::commands() const {
  static const std::vector<Command> table = {
      {"hf_add_sites", 10, SolverCalls::add},
      {"hf_solver_add_site", 4, SolverCalls::add_one},
      {"hf_remove_sites", 4, SolverCalls::remove},
      {"hf_solver_move_sites", 5, SolverCalls::move},
      {"hf_solver_set_values", 3, SolverCalls::set},
      {"hf_solver_edit_sites", 6, SolverCalls::batch},
      {"vectors of a solver", 3, SolverCalls::vectors},
      {"hf_solver_prepare_rebase", 4, SolverCalls::prepare},
      {"hf_solver_clone", 5, SolverCalls::clone},
      {"back to a clone", 4, SolverCalls::go_back},
      {"hf_create", 2, SolverCalls::make},
      {"hf_solver_destroy", 1, SolverCalls::destroy},
      {"a field of a solver", 5, SolverCalls::solve},
      {"a bad handle", 1, SolverCalls::handle},
      {"hf_solver_set_screening", 4, SolverCalls::screen},
  };
  return table;
}

}  // namespace unchanged
