#include "sequence_player.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#include "hf/hf.h"
#include "sequence_model.h"

namespace sequences {
namespace {

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void fail(const std::string& what) {
  hf_error_detail detail;
  hf_get_error_detail(&detail);
  throw Failure(what + " (last detail: " + detail.function + ": " + detail.message + ")");
}

void expect(hf_result expected, hf_result got, const char* call) {
  if (got != expected)
    fail(std::string(call) + ": expected " + hf_result_name(expected) + ", got " + hf_result_name(got));
}
void hold(bool condition, const std::string& what) {
  if (!condition) fail(what);
}

class Bytes {
 public:
  Bytes(const std::uint8_t* bytes, std::size_t size) : next_(bytes), end_(bytes + size) {}
  bool done() const { return next_ == end_; }
  unsigned take() { return done() ? 0u : *next_++; }

 private:
  const std::uint8_t *next_, *end_;
};

// A handle and what it must be.
struct Branch {
  hf_solver solver = nullptr;
  Model model;
  explicit Branch(const Setting& setting) : model(setting) {}
  Branch(const Branch&) = delete;
  Branch& operator=(const Branch&) = delete;
  ~Branch() { hf_destroy(solver); }
};

const Operator& operator_of(std::size_t surface, int operator_kind, int field_kind) {
  static std::map<std::array<int, 3>, Operator> made;
  Operator& o = made[{static_cast<int>(surface), operator_kind, field_kind}];
  if (o.matrix.size() == 0) o = make_operator(surfaces()[surface], operator_kind, field_kind);
  return o;
}

class Player {
 public:
  Player(Bytes bytes, Outcome& outcome) : bytes_(bytes), outcome_(outcome) {}
  void run();

 private:
  void begin();
  hf_create_desc desc() const;
  Branch& here() { return *branches_[active_]; }
  // what bytes stand for
  Place take_place(bool points);
  double take_value();
  double take_stiffness();
  std::uint32_t take_site();
  void take_addition(Edit& edit, bool points);
  // calls
  void call(unsigned kind);
  void edit_sites(const Edit& edit, unsigned how);
  void record();
  void step(bool back);
  void branch_off();
  void reload();
  void solve_some();
  void solve_single();
  void preview();
  void rebase();
  // comparisons
  void compare(Branch& branch);
  void compare_sites(Branch& branch);
  std::vector<double> field_of(Branch& branch);
  double error_of(Branch& branch, const std::vector<double>& field);

  Bytes bytes_;
  Outcome& outcome_;
  const Surface* surface_ = nullptr;
  Setting setting_;
  std::size_t surface_number_ = 0;
  int operator_kind_ = 0, field_kind_ = 0, ordering_ = 0;
  std::vector<std::unique_ptr<Branch>> branches_;
  std::size_t active_ = 0;
};

hf_create_desc Player::desc() const {
  hf_create_desc d;
  HF_INIT(d);
  d.vertex_count = surface_->vertex_count(), d.triangle_count = surface_->triangle_count();
  d.positions = surface_->positions.data(), d.triangles = surface_->triangles.data();
  d.operator_kind = operator_kind_, d.field_kind = field_kind_, d.engine = setting_.engine, d.ordering = ordering_;
  d.channel_count = static_cast<std::uint32_t>(setting_.channels),
  d.site_limit = static_cast<std::uint32_t>(setting_.site_limit);
  return d;
}

void Player::begin() {
  surface_number_ = bytes_.take() % surfaces().size();
  surface_ = &surfaces()[surface_number_];
  operator_kind_ = static_cast<int>(bytes_.take() % 4);
  if (!surface_->acute && operator_kind_ == HF_OPERATOR_INTRINSIC_DELAUNAY) operator_kind_ = HF_OPERATOR_COTANGENT;
  const int fields[4] = {HF_FIELD_HARMONIC, HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC, HF_FIELD_BIHARMONIC_GRAPH};
  field_kind_ = fields[bytes_.take() % 4];
  const unsigned engine = bytes_.take() % 8;
  setting_.engine = engine < 6 ? HF_ENGINE_GREEN : HF_ENGINE_REFACTOR;
#ifdef HF_WITH_GPL
  if (engine == 7) setting_.engine = HF_ENGINE_UPDOWN;
#endif
  ordering_ = static_cast<int>(bytes_.take() % 2);
  setting_.channels = 1 + bytes_.take() % 3;
  setting_.surface = surface_;
  setting_.operation = &operator_of(surface_number_, operator_kind_, field_kind_);
  branches_.push_back(std::make_unique<Branch>(setting_));
  const hf_create_desc d = desc();
  expect(HF_OK, hf_create(&d, &here().solver), "hf_create");
}

Place Player::take_place(bool points) {
  Place place;
  const unsigned b = bytes_.take();
  if (!points) {
    place.vertex = b == 255 ? HF_NO_INDEX - b % 2 : b % surface_->vertex_count();
    if (b == 254) place.vertex = surface_->vertex_count();
    return place;
  }
  place.triangle = b == 255 ? surface_->triangle_count() : b % surface_->triangle_count();
  const unsigned w = bytes_.take(), i = w % 9, j = (w / 9) % (9 - i);
  place.weight[0] = i / 8.0, place.weight[1] = j / 8.0, place.weight[2] = (8 - i - j) / 8.0;
  if (w == 255) place.weight[0] = std::numeric_limits<double>::quiet_NaN();
  if (w == 254) place.weight[1] += 0.5;
  if (w == 253) place.weight[0] = -1, place.weight[1] = 1, place.weight[2] = 1;
  return place;
}

double Player::take_value() {
  const double values[] = {0, 1, -1, 0.5, 3, -7.25, 10000, 10001, 10000.5, 1e-3, 0, 2, 1e6, -0.125, 9999, 1};
  const unsigned b = bytes_.take();
  if (b == 255) return std::numeric_limits<double>::quiet_NaN();
  if (b == 254) return -std::numeric_limits<double>::infinity();
  return values[b % 16];
}

double Player::take_stiffness() {
  const double stiffness[] = {0, 0, 0, 0, 1e-3, 1, 100, 1e4};
  const unsigned b = bytes_.take();
  if (b == 255) return std::numeric_limits<double>::infinity();
  return b == 254 ? -1.0 : stiffness[b % 8];
}

// Mostly one that is there.
std::uint32_t Player::take_site() {
  const unsigned b = bytes_.take();
  const Model::Sites& sites = here().model.sites();
  if (sites.empty() || b >= 250) return b == 255 ? HF_NO_INDEX : b % 32;
  return std::next(sites.begin(), static_cast<std::ptrdiff_t>(b % sites.size()))->first;
}

void Player::take_addition(Edit& edit, bool points) {
  const unsigned b = bytes_.take(), count = 1 + b % 4;
  for (unsigned i = 0; i < count; ++i) {
    edit.add.push_back(take_place(points));
    for (std::size_t c = 0; c < setting_.channels && (b & 4) == 0; ++c) edit.add_values.push_back(take_value());
    if (b & 8) edit.add_stiffness.push_back(take_stiffness());
  }
}

// Places as hf_sites_desc wants them; borrows from itself.
struct PlaceLists {
  std::vector<std::uint32_t> vertices, triangles;
  std::vector<double> weights;
  hf_sites_desc desc;
  PlaceLists(const std::vector<Place>& places, const std::vector<double>* values,
             const std::vector<double>* stiffness) {
    HF_INIT(desc);
    desc.site_count = static_cast<std::uint32_t>(places.size());
    for (const Place& p : places) {
      vertices.push_back(p.vertex), triangles.push_back(p.triangle);
      weights.insert(weights.end(), p.weight, p.weight + 3);
    }
    if (places.empty() || places[0].triangle == HF_NO_INDEX)
      desc.vertices = vertices.data();
    else
      desc.triangles = triangles.data(), desc.barycentrics = weights.data();
    if (values && !values->empty()) desc.values = values->data();
    if (stiffness && !stiffness->empty()) desc.stiffness = stiffness->data();
  }
};

// how: 0 hf_edit_sites, otherwise the single call the batch has.
void Player::edit_sites(const Edit& edit, unsigned how) {
  const hf_result expected = here().model.judge(edit);
  const PlaceLists to(edit.move_to, nullptr, nullptr), add(edit.add, &edit.add_values, &edit.add_stiffness);
  const std::uint32_t untouched = 0xABCDEF01u;
  std::vector<std::uint32_t> numbers(edit.add.size(), untouched);
  const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  hf_result got;
  if (how == 0) {
    hf_edit_desc d;
    HF_INIT(d);
    d.remove_count = size(edit.remove), d.remove_sites = edit.remove.data();
    d.move_count = size(edit.move), d.move_sites = edit.move.data(), d.move_to = edit.move.empty() ? nullptr : &to.desc;
    d.set_count = size(edit.set), d.set_sites = edit.set.data(), d.set_values = edit.set_values.data();
    d.add = edit.add.empty() ? nullptr : &add.desc;
    got = hf_edit_sites(here().solver, &d, numbers.data());
  } else if (!edit.remove.empty()) {
    got = hf_remove_sites(here().solver, size(edit.remove), edit.remove.data());
  } else if (!edit.move.empty()) {
    got = hf_move_sites(here().solver, size(edit.move), edit.move.data(), &to.desc);
  } else if (!edit.set.empty()) {
    got = hf_set_site_values(here().solver, size(edit.set), edit.set.data(), edit.set_values.data());
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

std::vector<double> Player::field_of(Branch& branch) {
  std::vector<double> field(std::size_t{surface_->vertex_count()} * setting_.channels, -123.0);
  hf_solve_info info;
  HF_INIT(info);
  const hf_result got = hf_solve_f64(branch.solver, field.data(), 0, &info);
  if (branch.model.sites().empty()) {
    expect(HF_ERROR_NO_SITES, got, "hf_solve_f64");
    hold(std::count(field.begin(), field.end(), -123.0) == static_cast<std::ptrdiff_t>(field.size()),
         "a refused solve wrote");
    return {};
  }
  expect(HF_OK, got, "hf_solve_f64");
  const Model::Answer& answer = branch.model.answer();
  std::uint32_t unreached = 0, first = HF_NO_INDEX, vertices = 0;
  for (int c = surface_->component_count - 1; c >= 0; --c) {
    if (answer.sites_of_component[static_cast<std::size_t>(c)] == 0) ++unreached, first = static_cast<std::uint32_t>(c);
  }
  for (std::uint32_t v = 0; v < surface_->vertex_count(); ++v) {
    const int inner = surface_->inner[v];
    vertices +=
        inner < 0 ||
        answer.sites_of_component[static_cast<std::size_t>(surface_->component[static_cast<std::size_t>(inner)])] == 0;
  }
  hold(info.unreached_component_count == unreached && info.first_unreached_component == first &&
           info.unreached_vertex_count == vertices,
       "hf_solve_info is wrong");
  return field;
}

// Largest error over the scale of the component's values.
double Player::error_of(Branch& branch, const std::vector<double>& field) {
  const Model::Answer& answer = branch.model.answer();
  double worst = 0;
  for (std::uint32_t v = 0; v < surface_->vertex_count(); ++v) {
    const int inner = surface_->inner[v];
    for (std::size_t c = 0; c < setting_.channels; ++c) {
      const double got = field[v * setting_.channels + c];
      const Eigen::Index column = static_cast<Eigen::Index>(c);
      const int component = inner < 0 ? -1 : surface_->component[static_cast<std::size_t>(inner)];
      if (component < 0 || answer.sites_of_component[static_cast<std::size_t>(component)] == 0) {
        hold(got == 0, "an unreached vertex is not 0");
        continue;
      }
      const double error = std::fabs(got - answer.field(inner, column)) / answer.scale(component, column);
      hold(error <= 1e300, "a field value is not finite");
      worst = std::max(worst, error);
    }
  }
  return worst;
}

void Player::compare_sites(Branch& branch) {
  const Model::Sites& sites = branch.model.sites();
  const std::size_t count = sites.size(), m = setting_.channels;
  hold(hf_get_site_count(branch.solver) == count, "hf_get_site_count is wrong");
  std::vector<std::uint32_t> numbers(count), vertices(count), components(count);
  std::vector<double> values(count * m), stiffness(count), flux(count * m);
  hf_site_info info;
  HF_INIT(info);
  info.capacity = static_cast<std::uint32_t>(count);
  info.sites = numbers.data(), info.vertices = vertices.data(), info.components = components.data();
  info.values = values.data(), info.stiffness = stiffness.data(), info.flux = flux.data();
  expect(HF_OK, hf_get_sites(branch.solver, &info), "hf_get_sites");
  const Model::Answer& answer = branch.model.answer();
  std::size_t i = 0;
  for (const auto& [number, site] : sites) {
    const bool same =
        numbers[i] == number && vertices[i] == site.given_vertex &&
        components[i] == static_cast<std::uint32_t>(site.component) && stiffness[i] == site.stiffness &&
        std::equal(site.values.begin(), site.values.end(), values.begin() + static_cast<std::ptrdiff_t>(i * m));
    hold(same, "hf_get_sites: site " + std::to_string(number) + " is not what was set");
    for (std::size_t c = 0; c < m && setting_.engine != HF_ENGINE_UPDOWN; ++c) {
      const Eigen::Index column = static_cast<Eigen::Index>(c);
      // crowded points have fluxes far beyond the field's own
      const double unit = std::max(setting_.operation->mean_diagonal[static_cast<std::size_t>(site.component)] *
                                       answer.scale(site.component, column),
                                   answer.lambda.col(column).cwiseAbs().maxCoeff());
      const double error = std::fabs(flux[i * m + c] - answer.lambda(static_cast<Eigen::Index>(i), column)) / unit;
      char text[96];
      std::snprintf(text, sizeof text, "hf_get_sites: the flux of site %u is off by %.3g of its scale", number, error);
      hold(error <= (setting_.engine == HF_ENGINE_GREEN ? 1e-8 : 1e-6), text);
    }
    ++i;
  }
}

void Player::compare(Branch& branch) {
  compare_sites(branch);
  const std::vector<double> field = field_of(branch);
  if (field.empty()) return;
  const double error = error_of(branch, field);
  double& worst = outcome_.worst[static_cast<std::size_t>(setting_.engine)];
  worst = std::max(worst, error);
  const double most = setting_.engine == HF_ENGINE_UPDOWN     ? penalty_tolerance
                      : setting_.engine == HF_ENGINE_REFACTOR ? baseline_tolerance
                                                              : exact_tolerance;
  char text[64];
  std::snprintf(text, sizeof text, "the field is off by %.3g of its scale", error);
  hold(error <= most, text);
}

void Player::record() {
  here().model.recorded_field = field_of(here());
  expect(HF_OK, hf_record(here().solver), "hf_record");
  here().model.record();
}

void Player::step(bool back) {
  Branch& b = here();
  const bool possible = back ? b.model.undo() : b.model.redo();
  expect(possible ? HF_OK : HF_ERROR_NO_RECORD, back ? hf_undo(b.solver) : hf_redo(b.solver),
         back ? "hf_undo" : "hf_redo");
  if (!possible || b.model.recorded_field.empty() || b.model.sites().empty()) return;
  if (setting_.engine != HF_ENGINE_GREEN) return;  // the others follow by an edit: equal to rounding, see compare()
  const std::vector<double> field = field_of(b);
  hold(std::memcmp(field.data(), b.model.recorded_field.data(), sizeof(double) * field.size()) == 0,
       "the field after going back has other bits than at the record");
}

// Goes to another branch: an old one, or a clone.
void Player::branch_off() {
  const unsigned b = bytes_.take();
  if (branches_.size() < 3 && b % 2 == 0) {
    auto made = std::make_unique<Branch>(setting_);
    made->model = here().model;
    made->model.forget_records();
    expect(HF_OK, hf_clone(here().solver, &made->solver), "hf_clone");
    branches_.push_back(std::move(made));
    active_ = branches_.size() - 1;
  } else if (branches_.size() > 1 && b % 8 == 1) {
    const hf_solver gone = here().solver;
    branches_.erase(branches_.begin() + static_cast<std::ptrdiff_t>(active_));
    expect(HF_ERROR_INVALID_HANDLE, hf_record(gone), "hf_record on a destroyed handle");
    active_ = 0;
  } else {
    active_ = b / 2 % branches_.size();
  }
}

// The factor saved, loaded by a new solver, and the sites put there again.
void Player::reload() {
  std::size_t size = 0;
  expect(HF_OK, hf_get_factor_size(here().solver, &size), "hf_get_factor_size");
  std::vector<std::uint8_t> bytes(size + 1, 0x5A);
  expect(HF_OK, hf_save_factor(here().solver, bytes.data(), size), "hf_save_factor");
  hold(bytes[size] == 0x5A, "hf_save_factor wrote behind its size");
  hf_factor_desc factor;
  HF_INIT(factor);
  factor.bytes = bytes.data(), factor.byte_count = size;
  hf_create_desc d = desc();
  d.saved_factor = &factor;
  hf_solver made = nullptr;
  const unsigned b = bytes_.take();
  if (b % 4 == 3) {  // damaged: refused, nothing made
    bytes[bytes_.take() * 257u % size] ^= static_cast<std::uint8_t>(1u << (b / 4 % 8));
    const hf_result got = hf_create(&d, &made);
    hold(got != HF_OK && made == nullptr, "hf_create took a damaged factor");
    return;
  }
  expect(HF_OK, hf_create(&d, &made), "hf_create with saved_factor");
  auto fresh = std::make_unique<Branch>(setting_);
  fresh->solver = made;
  const Model::Sites sites = here().model.sites();
  branches_[active_] = std::move(fresh);
  for (const auto& entry : sites) {
    if (entry.second.at_vertex < 0) continue;  // vertices only: points lose their triangle in the model
    Edit edit;
    edit.add.resize(1);
    edit.add[0].vertex = static_cast<std::uint32_t>(
        std::find(surface_->inner.begin(), surface_->inner.end(), entry.second.at_vertex) - surface_->inner.begin());
    edit.add_values = entry.second.values, edit.add_stiffness = {entry.second.stiffness};
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
  const hf_result got = hf_solve_at(here().solver, count, vertices.data(), values.data());
  if (count > surface_->vertex_count()) return expect(HF_ERROR_TOO_LARGE, got, "hf_solve_at");
  if (outside) return expect(HF_ERROR_OUT_OF_RANGE, got, "hf_solve_at");
  if (here().model.sites().empty()) return expect(HF_ERROR_NO_SITES, got, "hf_solve_at");
  expect(HF_OK, got, "hf_solve_at");
  const std::vector<double> field = field_of(here());
  for (unsigned i = 0; i < count; ++i) {
    hold(std::memcmp(&values[std::size_t{i} * m], &field[std::size_t{vertices[i]} * m], m * sizeof(double)) == 0,
         "hf_solve_at has other bits than hf_solve_f64");
  }
}

void Player::solve_single() {
  const std::size_t m = setting_.channels, width = m + 1, n = surface_->vertex_count();
  std::vector<float> values(n * width, -9.0f);
  const hf_result got =
      hf_solve(here().solver, values.data(), static_cast<std::uint32_t>(width * sizeof(float)), nullptr);
  if (here().model.sites().empty()) return expect(HF_ERROR_NO_SITES, got, "hf_solve");
  expect(HF_OK, got, "hf_solve");
  const std::vector<double> field = field_of(here());
  for (std::size_t v = 0; v < n; ++v) {
    for (std::size_t c = 0; c < m; ++c)
      hold(values[v * width + c] == static_cast<float>(field[v * m + c]), "hf_solve is not hf_solve_f64 rounded");
    hold(values[v * width + m] == -9.0f, "hf_solve wrote between the rows");
  }
}

void Player::preview() {
  const unsigned corrections = bytes_.take() % 4;
  std::vector<double> field(std::size_t{surface_->vertex_count()} * setting_.channels, -3.0);
  hf_preview_info info;
  HF_INIT(info);
  const hf_result got = hf_solve_preview_f64(here().solver, field.data(), 0, corrections, &info);
  if (here().model.sites().empty()) return expect(HF_ERROR_NO_SITES, got, "hf_solve_preview_f64");
  expect(HF_OK, got, "hf_solve_preview_f64");
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
  const hf_result got = hf_prepare_rebase(here().solver);
  if (setting_.engine != HF_ENGINE_GREEN) return expect(HF_ERROR_UNSUPPORTED, got, "hf_prepare_rebase");
  expect(hard ? HF_OK : HF_ERROR_NO_SITES, got, "hf_prepare_rebase");
}

void Player::call(unsigned kind) {
  ++outcome_.calls[kind];
  Edit edit;
  const unsigned m = static_cast<unsigned>(setting_.channels);
  const auto take_moves = [&](bool points) {
    for (unsigned i = 0, count = 1 + bytes_.take() % 3; i < count; ++i)
      edit.move.push_back(take_site()), edit.move_to.push_back(take_place(points));
  };
  const auto take_sets = [&] {
    for (unsigned i = 0, count = 1 + bytes_.take() % 3; i < count; ++i) {
      edit.set.push_back(take_site());
      for (unsigned c = 0; c < m; ++c) edit.set_values.push_back(take_value());
    }
  };
  const auto take_removes = [&] {
    for (unsigned i = 0, count = 1 + bytes_.take() % 3; i < count; ++i) edit.remove.push_back(take_site());
  };
  switch (kind) {
    case 0:
    case 1:
    case 2:
      take_addition(edit, false);
      return edit_sites(edit, 1);
    case 3:
    case 4:
      take_addition(edit, true);
      return edit_sites(edit, 1);
    case 5:
      take_removes();
      return edit_sites(edit, 1);
    case 6:
      take_moves(false);
      return edit_sites(edit, 1);
    case 7:
      take_moves(true);
      return edit_sites(edit, 1);
    case 8:
      take_sets();
      return edit_sites(edit, 1);
    case 9: {
      const unsigned parts = bytes_.take();
      if (parts & 1) take_removes();
      if (parts & 2) take_moves(parts & 16);
      if (parts & 4) take_sets();
      if (parts & 8) take_addition(edit, parts & 32);
      return edit_sites(edit, 0);
    }
    case 10:
      return record();
    case 11:
      return step(true);
    case 12:
      return step(false);
    case 13:
      return branch_off();
    case 14:
      return reload();
    case 15:
      return solve_some();
    case 16:
      return solve_single();
    case 17:
      return preview();
    case 18:
      return rebase();
  }
}

void Player::run() {
  begin();
  compare(here());
  for (int calls = 0; !bytes_.done() && calls < 64; ++calls) {
    call(bytes_.take() % 19);
    compare(here());
  }
  for (const auto& branch : branches_) compare(*branch);  // what happened to one did not touch the others
}

}  // namespace

Outcome play(const std::uint8_t* bytes, std::size_t size) {
  Outcome outcome;
  try {
    Player(Bytes(bytes, size), outcome).run();
  } catch (const Failure& failure) {
    outcome.passed = false, outcome.failure = failure.what();
  }
  return outcome;
}

}  // namespace sequences
