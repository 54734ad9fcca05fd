#include "sequence_player.h"

#include <iterator>
#include <limits>

#include "sequence_play.h"
#include "support/peers.h"

namespace sequences {
namespace {

const Operator& operator_of(std::size_t surface, int operator_kind, int field_kind) {
  static std::map<std::array<int, 3>, Operator> made;
  Operator& o = made[{static_cast<int>(surface), operator_kind, field_kind}];
  if (o.matrix.size() == 0) o = make_operator(surfaces()[surface], operator_kind, field_kind);
  return o;
}

// The kind of a call. The highest bytes are calls on surfaces, so kept inputs play as when they failed.
unsigned kind_of(unsigned byte) {
  constexpr unsigned first = first_surface_call, highest = 13 * first;
  return byte < highest ? byte % first : first + (byte - highest) % 4;
}

}  // namespace

hf_surface_desc Player::surface_desc(int field_kind) const {
  hf_surface_desc d = HF_INIT(hf_surface_desc);
  d.positions = HF_ARRAY(surface_->positions.data(), surface_->vertex_count());
  d.triangles = HF_ARRAY(surface_->triangles.data(), surface_->triangle_count());
  d.operator_kind = operator_kind_;
  d.field_kind = field_kind;
  d.ordering = ordering_;
  return d;
}

hf_solver_desc Player::solver_desc() const {
  hf_solver_desc d = HF_INIT(hf_solver_desc);
  d.field_kind = field_kind_;
  d.channel_count = static_cast<std::uint32_t>(setting_.channels);
  d.site_limit = static_cast<std::uint32_t>(setting_.site_limit);
  return d;
}

std::shared_ptr<Owned> Player::make_surface(int field_kind, const hf_factor_desc* saved) {
  hf_surface_desc d = surface_desc(field_kind);
  d.saved_factor = saved;
  auto made = std::make_shared<Owned>();
  made->field_kind = field_kind;
  expect(HF_OK, hf_surface_create(&d, &made->handle), "hf_surface_create");
  return made;
}

// The surface of a branch. One that was destroyed is made again.
Owned& Player::surface_of(Branch& branch) {
  if (!branch.surface) branch.surface = make_surface(field_kind_);
  return *branch.surface;
}

void Player::begin() {
  surface_number_ = bytes_.take() % surfaces().size();
  surface_ = &surfaces()[surface_number_];
  operator_kind_ = static_cast<int>(bytes_.take() % 4);
  if (!surface_->acute && operator_kind_ == HF_OPERATOR_INTRINSIC_DELAUNAY) operator_kind_ = HF_OPERATOR_COTANGENT;
  const int fields[4] = {HF_FIELD_HARMONIC, HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC, HF_FIELD_BIHARMONIC_GRAPH};
  field_kind_ = fields[bytes_.take() % 4];
  const unsigned engine = bytes_.take() % 8;
  setting_.engine = engine < 6 ? ENGINE_GREEN : ENGINE_REFACTOR;
  static const bool gpl = has_gpl();
  if (engine == 7 && gpl) setting_.engine = ENGINE_UPDOWN;
  ordering_ = static_cast<int>(bytes_.take() % 2);
  setting_.channels = 1 + bytes_.take() % 3;
  setting_.surface = surface_;
  setting_.operation = &operator_of(surface_number_, operator_kind_, field_kind_);
  branches_.push_back(std::make_unique<Branch>(setting_));
  // one surface in two lacks the factor of the solver
  here().surface = make_surface(ordering_ == 0 ? field_kind_ : HF_FIELD_HARMONIC);
  const hf_solver_desc d = solver_desc();
  expect(HF_OK, create_with(setting_.engine, here().surface->handle, &d, &here().solver), "hf_create");
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
  place.weight[0] = i / 8.0;
  place.weight[1] = j / 8.0;
  place.weight[2] = (8 - i - j) / 8.0;
  if (w == 255) place.weight[0] = std::numeric_limits<double>::quiet_NaN();
  if (w == 254) place.weight[1] += 0.5;
  if (w == 253) {
    place.weight[0] = -1;
    place.weight[1] = 1;
    place.weight[2] = 1;
  }
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

// Mostly the number of a site that exists.
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

void Player::call(unsigned kind) {
  ++outcome_.calls[kind];
  Edit edit;
  const unsigned m = static_cast<unsigned>(setting_.channels);
  const auto take_moves = [&](bool points) {
    for (unsigned i = 0, count = 1 + bytes_.take() % 3; i < count; ++i) {
      edit.move.push_back(take_site());
      edit.move_to.push_back(take_place(points));
    }
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
      return keep();
    case 11:
      return go_back(true);
    case 12:
      return go_back(false);
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
    case 19:
      return share();
    case 20:
      return drop_surface();
    case 21:
      return pick();
    case 22:
      return pose();
  }
}

void Player::run() {
  begin();
  compare(here());
  for (int calls = 0; !bytes_.done() && calls < 64; ++calls) {
    call(kind_of(bytes_.take()));
    compare(here());
  }
  for (const auto& branch : branches_) {  // calls on one branch leave the others and the kept clones alone
    compare(*branch);
    for (const auto& clone : branch->kept) compare_kept(*clone);
  }
}

Outcome play(const std::uint8_t* bytes, std::size_t size) {
  Outcome outcome;
  try {
    Player(Bytes(bytes, size), outcome).run();
  } catch (const Failure& failure) {
    outcome.passed = false;
    outcome.failure = failure.what();
  }
  return outcome;
}

}  // namespace sequences
