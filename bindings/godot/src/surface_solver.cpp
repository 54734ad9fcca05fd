// Methods of the solver: sites, batches of edits, the field and its certificate (hf/solver.h).
#include "arguments.h"

namespace hf_godot {

hf_solver solver_of(Surface& s) {
  return make_once(s.solver, [&](hf_solver* out) { return hf_create(s.get(), nullptr, out); });
}

std::vector<hf_place> places_of(const Argument& argument) {
  const Doubles& list = argument.list;
  if (list.size() % 6 != 0) fail("places must hold three corners and three weights each");
  std::vector<hf_place> places(list.size() / 6);
  for (size_t i = 0; i < list.size(); ++i) {
    hf_place& place = places[i / 6];
    if (i % 6 < 3)
      place.corners[i % 6] = whole(list[i], "places");
    else
      place.barycentrics[i % 6 - 3] = list[i];
  }
  return places;
}

namespace {

// solver_create(options = {}): replaces the solver; without it the first call makes one of defaults
Value solver_create(Surface& s, const Arguments& a) {
  auto desc = make<hf_solver_desc>();
  read_options(at(a, 0), {{"field_kind", &desc.field_kind}, {"site_limit", &desc.site_limit}});
  make_again(s.solver, [&](hf_solver* out) { return hf_create(s.get(), &desc, out); });
  return done();
}

// add_sites(vertices, values, stiffness = null, radii = null, places = null): a place is three corners and three
// weights
Value add_sites(Surface& s, const Arguments& a) {
  const List vertices = integers(at(a, 0), "vertices");
  const std::vector<hf_place> places = places_of(at(a, 4));
  const size_t count = places.empty() ? vertices.count() : places.size();
  auto desc = make<hf_sites_desc>();
  desc.site_count = static_cast<uint32_t>(count);
  desc.vertices = vertices.data();
  desc.places = places.empty() ? nullptr : places.data();
  desc.values = doubles(at(a, 1), count, "values");
  desc.stiffness = doubles(at(a, 2), count, "stiffness");
  desc.radii = doubles(at(a, 3), count, "radii");
  Numbers made(count + 1);
  check(hf_add_sites(solver_of(s), &desc, made.data()));
  made.resize(count);
  return numbers(made);
}

// add_site(vertex, value = 0): one hard site; returns its number
Value add_site(Surface& s, const Arguments& a) {
  const double value = at(a, 1).number;
  Numbers made(1);
  check(hf_solver_add_site(solver_of(s), whole(at(a, 0).number, "vertex"), &value, made.data()));
  return number(made[0]);
}

Value move_sites(Surface& s, const Arguments& a) {
  const List sites = integers(at(a, 0), "sites"), vertices = integers(at(a, 1), "vertices");
  auto to = make<hf_sites_desc>();
  to.site_count = vertices.count();
  to.vertices = vertices.data();
  check(hf_solver_move_sites(solver_of(s), sites.count(), sites.data(), &to));
  return done();
}

Value record(Surface& s, const Arguments&) {
  return s.solver_history.record(hf::clone_of(s.solver, hf_solver_clone)), done();
}

// A state that was recorded before an edit of the surface moves to the surface of now; a refused one stays recorded.
using History = decltype(Surface::solver_history);
template <void (History::*step)(decltype(Surface::solver)&), void (History::*back)(decltype(Surface::solver)&)>
Value go(Surface& s, const Arguments&) {
  (s.solver_history.*step)(s.solver);
  try {
    if (s.moved && s.solver) check(hf_solver_move_to(s.solver.get(), s.get()));
  } catch (...) {
    (s.solver_history.*back)(s.solver);
    throw;
  }
  return done();
}

Value solve(Surface& s, const Arguments&) {
  Value value;
  value.kind = Value::reals;
  value.floats.resize(s.vertex_count + 1);
  check(hf_solve(solver_of(s), value.floats.data(), 0, nullptr));
  value.floats.resize(s.vertex_count);
  return value;
}

Value solve_at(Surface& s, const Arguments& a) {
  const List vertices = integers(at(a, 0), "vertices");
  Doubles found(vertices.count() + 1);
  check(hf_solver_solve_at(solver_of(s), vertices.count(), vertices.data(), found.data()));
  Value value;
  value.kind = Value::reals;
  value.floats.assign(found.begin(), found.end() - 1);
  return value;
}

// edit_sites(remove, move, move_to, set, set_values, add, add_values): one batch, all or nothing; lists may be null.
// Returns the numbers of the sites added.
Value edit_sites(Surface& s, const Arguments& a) {
  const List remove = integers(at(a, 0), "remove"), move = integers(at(a, 1), "move"),
             move_to = integers(at(a, 2), "move_to"), set = integers(at(a, 3), "set"), add = integers(at(a, 5), "add");
  if (move.values.size() != move_to.values.size()) fail("move and move_to must be of one length");
  auto edit = make<hf_edit_desc>();
  auto places = make<hf_sites_desc>(), added = make<hf_sites_desc>();
  edit.remove_count = static_cast<uint32_t>(remove.values.size());
  edit.remove_sites = remove.data();
  edit.move_count = static_cast<uint32_t>(move.values.size());
  edit.move_sites = move.data();
  edit.move_to = &places;
  places.site_count = edit.move_count;
  places.vertices = move_to.data();
  edit.set_count = static_cast<uint32_t>(set.values.size());
  edit.set_sites = set.data();
  edit.set_values = doubles(at(a, 4), set.values.size(), "set_values");
  added.site_count = static_cast<uint32_t>(add.values.size());
  added.vertices = add.data();
  added.values = doubles(at(a, 6), add.values.size(), "add_values");
  if (!add.values.empty()) edit.add = &added;
  Numbers made(add.values.size() + 1);
  check(hf_solver_edit_sites(solver_of(s), &edit, made.data()));
  made.pop_back();
  return numbers(made);
}

// certify(tolerance = 0): how right the field is; fails with HF_ERROR_INACCURATE when it is not
Value certify(Surface& s, const Arguments& a) {
  auto found = make<hf_certificate>();
  found.tolerance = at(a, 0).number;
  check(hf_solver_certify(solver_of(s), &found));
  return named({{"tolerance", found.tolerance},
                {"value_range", found.value_range},
                {"residual", found.residual},
                {"site_error", found.site_error},
                {"overshoot", found.overshoot},
                {"error_estimate", found.error_estimate},
                {"overshoot_checked", found.overshoot_checked},
                {"worst_vertex", found.worst_vertex}});
}

}  // namespace

const std::vector<Entry>& solver_methods() {
  static const std::vector<Entry> all = {
      {"solver_create", 0, 1, solver_create},
      {"add_sites", 2, 5, add_sites},
      {"add_site", 1, 2, add_site},
      {"move_sites", 2, 2, move_sites},
      {"edit_sites", 7, 7, edit_sites},
      {"record", 0, 0, record},
      {"undo", 0, 0, go<&History::undo, &History::redo>},
      {"redo", 0, 0, go<&History::redo, &History::undo>},
      {"solve", 0, 0, solve},
      {"solve_at", 1, 1, solve_at},
      {"certify", 0, 1, certify},
  };
  return all;
}

}  // namespace hf_godot
