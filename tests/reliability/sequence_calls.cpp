// The calls of a sequence. Each result is compared with the code of the model.
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "../support/place_in.h"
#include "sequence_play.h"

namespace sequences {
namespace {

// Places in the form of hf_sites_desc. The desc borrows from this object.
struct PlaceLists {
  std::vector<std::uint32_t> vertices;
  std::vector<hf_place> inside;
  hf_sites_desc desc;
  PlaceLists(const Surface& surface, const std::vector<Place>& places, const std::vector<double>* values,
             const std::vector<double>* stiffness) {
    desc = HF_INIT(hf_sites_desc);
    desc.site_count = static_cast<std::uint32_t>(places.size());
    for (const Place& p : places) {
      vertices.push_back(p.vertex);
      inside.push_back(place_in(surface.triangles.data(), surface.triangle_count(), p.triangle, p.weight));
    }
    if (places.empty() || places[0].triangle == HF_NO_INDEX)
      desc.vertices = vertices.data();
    else
      desc.places = inside.data();
    if (values && !values->empty()) desc.values = values->data();
    if (stiffness && !stiffness->empty()) desc.stiffness = stiffness->data();
  }
};

}  // namespace

// how: 0 for hf_solver_edit_sites, otherwise the single call for the only part of the batch.
void Player::edit_sites(const Edit& edit, unsigned how) {
  const hf_result expected = here().model.judge(edit);
  const PlaceLists to(*surface_, edit.move_to, nullptr, nullptr),
      add(*surface_, edit.add, &edit.add_values, &edit.add_stiffness);
  const std::uint32_t untouched = 0xABCDEF01u;
  std::vector<std::uint32_t> numbers(edit.add.size(), untouched);
  const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  hf_result got;
  if (how == 0) {
    hf_edit_desc d = HF_INIT(hf_edit_desc);
    d.remove_count = size(edit.remove);
    d.remove_sites = edit.remove.data();
    d.move_count = size(edit.move);
    d.move_sites = edit.move.data();
    d.move_to = edit.move.empty() ? nullptr : &to.desc;
    d.set_count = size(edit.set);
    d.set_sites = edit.set.data();
    d.set_values = edit.set_values.data();
    d.add = edit.add.empty() ? nullptr : &add.desc;
    got = hf_solver_edit_sites(here().solver, &d, numbers.data());
  } else if (!edit.remove.empty()) {
    got = hf_remove_sites(here().solver, size(edit.remove), edit.remove.data());
  } else if (!edit.move.empty()) {
    got = hf_solver_move_sites(here().solver, size(edit.move), edit.move.data(), &to.desc);
  } else if (!edit.set.empty()) {
    got = hf_solver_set_values(here().solver, size(edit.set), edit.set.data(), edit.set_values.data());
  } else {
    got = hf_add_sites(here().solver, &add.desc, numbers.data());
  }
  expect(expected, got, "an edit");
  ++outcome_.edits[got == HF_OK];
  if (got == HF_OK) {
    hold(here().model.accept(numbers), "an edit: the number of a new site is in use");
  } else {
    hold(std::count(numbers.begin(), numbers.end(), untouched) == static_cast<std::ptrdiff_t>(numbers.size()),
         "a refused edit wrote numbers");
  }
}

std::unique_ptr<Branch> Player::clone_of(Branch& branch) {
  auto made = std::make_unique<Branch>(setting_);
  made->model = branch.model;
  expect(HF_OK, hf_solver_clone(branch.solver, &made->solver), "hf_solver_clone");
  return made;
}

// Keeps a clone of this branch.
void Player::keep() {
  auto made = clone_of(here());
  made->kept_field = field_of(here());
  here().kept.push_back(std::move(made));
}

// The clone that was kept last becomes the solver: undo. The solver is destroyed, or becomes the kept clone: redo.
void Player::go_back(bool forget) {
  if (here().kept.empty()) return;
  auto now = std::move(here().kept.back());
  here().kept.pop_back();
  compare_kept(*now);
  now->surface = here().surface;
  now->kept = std::move(here().kept);
  std::swap(branches_[active_], now);
  if (forget) return;
  now->kept_field = field_of(*now);
  now->surface.reset();
  here().kept.push_back(std::move(now));
}

// Clones this branch, removes it, or switches to another.
void Player::branch_off() {
  const unsigned b = bytes_.take();
  if (branches_.size() < 3 && b % 2 == 0) {
    auto made = clone_of(here());
    made->surface = here().surface;
    branches_.push_back(std::move(made));
    active_ = branches_.size() - 1;
  } else if (branches_.size() > 1 && b % 8 == 1) {
    const hf_solver gone = here().solver;
    branches_.erase(branches_.begin() + static_cast<std::ptrdiff_t>(active_));
    hf_solver none = nullptr;
    expect(HF_ERROR_INVALID_OBJECT, hf_solver_clone(gone, &none), "hf_solver_clone of a destroyed solver");
    active_ = 0;
  } else {
    active_ = b / 2 % branches_.size();
  }
}

// Saves the factor, loads it into a new surface, and adds the sites to a new solver there.
void Player::reload() {
  const hf_surface surface = surface_of(here()).handle;
  std::size_t size = 0;
  expect(HF_OK, hf_surface_save(surface, field_kind_, nullptr, 0, nullptr, &size), "hf_surface_save, size");
  std::vector<std::uint8_t> bytes(size + 1, 0x5A);
  expect(HF_ERROR_TOO_SMALL, hf_surface_save(surface, field_kind_, nullptr, size - 1, bytes.data(), &size),
         "hf_surface_save");
  expect(HF_OK, hf_surface_save(surface, field_kind_, nullptr, size, bytes.data(), nullptr), "hf_surface_save");
  hold(bytes[size] == 0x5A, "hf_surface_save wrote beyond its size");
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.bytes = bytes.data();
  factor.byte_count = size;
  const unsigned b = bytes_.take();
  if (b % 4 == 3) {  // damaged bytes are refused
    bytes[bytes_.take() * 257u % size] ^= static_cast<std::uint8_t>(1u << (b / 4 % 8));
    hf_surface_desc d = surface_desc(field_kind_);
    d.saved_factor = &factor;
    hf_surface made = nullptr;
    const hf_result got = hf_surface_create(&d, &made);
    hold(got != HF_OK && made == nullptr, "hf_surface_create took a damaged factor");
    return;
  }
  auto fresh = std::make_unique<Branch>(setting_);
  fresh->surface = make_surface(field_kind_, &factor);
  const hf_solver_desc d = solver_desc();
  expect(HF_OK, hf_create(fresh->surface->handle, &d, &fresh->solver), "hf_create");
  const Model::Sites sites = here().model.sites();
  branches_[active_] = std::move(fresh);
  for (const auto& entry : sites) {
    if (entry.second.at_vertex < 0) continue;  // the model does not keep the triangle of a point
    Edit edit;
    edit.add.resize(1);
    edit.add[0].vertex = static_cast<std::uint32_t>(
        std::find(surface_->inner.begin(), surface_->inner.end(), entry.second.at_vertex) - surface_->inner.begin());
    edit.add_values = entry.second.values;
    edit.add_stiffness = {entry.second.stiffness};
    edit_sites(edit, 1);
  }
}

void Player::solve_some() {
  const unsigned count = 1 + bytes_.take() % 6, m = static_cast<unsigned>(setting_.channels);
  std::vector<std::uint32_t> vertices;
  bool outside = false;
  for (unsigned i = 0; i < count; ++i) {
    const unsigned b = bytes_.take();
    vertices.push_back(b == 255 ? HF_NO_INDEX : b % surface_->vertex_count());
    outside = outside || b == 255;
  }
  std::vector<double> values(std::size_t{count} * m, -5.0);
  const hf_result got = hf_solver_solve_at(here().solver, count, vertices.data(), values.data());
  if (count > surface_->vertex_count()) return expect(HF_ERROR_TOO_LARGE, got, "hf_solver_solve_at");
  if (outside) return expect(HF_ERROR_OUT_OF_RANGE, got, "hf_solver_solve_at");
  if (here().model.sites().empty()) return expect(HF_ERROR_EMPTY, got, "hf_solver_solve_at");
  expect(HF_OK, got, "hf_solver_solve_at");
  const std::vector<double> field = field_of(here());
  for (unsigned i = 0; i < count; ++i) {
    hold(std::memcmp(&values[std::size_t{i} * m], &field[std::size_t{vertices[i]} * m], m * sizeof(double)) == 0,
         "hf_solver_solve_at has other bits than hf_solver_solve_f64");
  }
}

void Player::solve_single() {
  const std::size_t m = setting_.channels, width = m + 1, n = surface_->vertex_count();
  std::vector<float> values(n * width, -9.0f);
  const hf_result got =
      hf_solve(here().solver, values.data(), static_cast<std::uint32_t>(width * sizeof(float)), nullptr);
  if (here().model.sites().empty()) return expect(HF_ERROR_EMPTY, got, "hf_solve");
  expect(HF_OK, got, "hf_solve");
  const std::vector<double> field = field_of(here());
  for (std::size_t v = 0; v < n; ++v) {
    for (std::size_t c = 0; c < m; ++c)
      hold(values[v * width + c] == static_cast<float>(field[v * m + c]),
           "hf_solve is not hf_solver_solve_f64 rounded");
    hold(values[v * width + m] == -9.0f, "hf_solve wrote between the rows");
  }
}

void Player::preview() {
  const unsigned corrections = bytes_.take() % 4;
  std::vector<double> field(std::size_t{surface_->vertex_count()} * setting_.channels, -3.0);
  hf_preview_info info = HF_INIT(hf_preview_info);
  const hf_result got = hf_solver_solve_preview_f64(here().solver, field.data(), 0, corrections, &info);
  if (here().model.sites().empty()) return expect(HF_ERROR_EMPTY, got, "hf_solver_solve_preview_f64");
  expect(HF_OK, got, "hf_solver_solve_preview_f64");
  if (info.exact) hold(info.correction_count == 0 && info.error_estimate == 0, "an exact preview says it is not");
  const double error = error_of(here(), field);
  const double most = setting_.engine == HF_ENGINE_UPDOWN || info.exact ? penalty_tolerance
                      : corrections == 0                                ? 1e-3
                                                                        : 1e-6;
  char text[96];
  std::snprintf(text, sizeof text, "a preview with %u corrections is off by %.3g of its scale", corrections, error);
  hold(error <= most, text);
}

void Player::rebase() {
  bool hard = false;
  for (const auto& site : here().model.sites())
    hard = hard || (site.second.at_vertex >= 0 && site.second.stiffness == 0);
  const hf_result got = hf_solver_prepare_rebase(here().solver);
  if (setting_.engine != HF_ENGINE_GREEN) return expect(HF_ERROR_UNSUPPORTED, got, "hf_solver_prepare_rebase");
  expect(hard ? HF_OK : HF_ERROR_EMPTY, got, "hf_solver_prepare_rebase");
}

}  // namespace sequences
