// Handles of free rotation in poses and their layers: the rotations go into a solve and come back from it.
#include "base/error.h"
#include "deform/pose_layout.h"
#include "deform/pose_stack.h"

namespace hf_inner::deform {

void Pose::check_free_turn(bool free_turn) const {
  if (free_turn && options_.scheme)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "a baseline of poses needs the rotation of every handle; make the pose with hf_pose_create");
}

bool Pose::free_turn(std::uint32_t number) const { return state_->handles[require(number, HF_NO_INDEX)].free_turn; }

void Pose::set_free_turns(Span<const std::uint32_t> numbers, bool free_turn, bool in_place) {
  for (std::uint32_t k = 0; k < numbers.size(); ++k) require(numbers[k], k);
  check_free_turn(free_turn);
  auto state = make_shared_in<State>(memory(), *state_, memory());
  bool changed = false, carries = false;
  for (const std::uint32_t number : numbers) {
    HandleState& handle = state->handles[find(number)];
    const bool other = handle.free_turn != free_turn;
    changed = changed || other;
    carries = carries || (other && handle.following == 1);
    handle.free_turn = free_turn;
  }
  if (!changed) return;
  if (carries && state->without) prepare_holds(*layout_, *state);
  prepare_turns(*layout_, *state);
  // A rotation that is given as it stands changes nothing. Handles that moved since the last frame leave the surface.
  const bool stands = posed_ && !state->changed;
  state->changed = state->changed || free_turn;
  if (free_turn && in_place && stands) keep_in_place(*layout_, *state, false);
  state_ = std::move(state);
}

// Prepares the solve for the handles of `state` that are free.
void Pose::prepare_turns(const Layout& layout, State& state) const {
  state.smooth.turns.reset();
  if (!layout.smooth) return;
  Vector<std::uint8_t> free(state.handles.size(), 0, &memory());
  bool any = false;
  for (std::size_t i = 0; i < free.size(); ++i) {
    free[i] = state.handles[i].free_turn;
    any = any || free[i];
  }
  if (!any) return;
  state.smooth.turns = make_shared_in<FreeTurns>(
      memory(), make_free_turns(layout.smooth->subspace, layout.handles, free, layout.smooth->seed_field,
                                state.smooth.holds.get(), memory()));
  state.smooth.free.fit(state.smooth.turns->count());
}

// A free handle starts a solve with the turn of the handles about it.
void Pose::follow_turns(State& state, Span<Vec3> turns, bool whole) const noexcept {
  if (whole) {
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = state.handles[i].turn;
  }
  if (!state.smooth.turns) return;
  const FreeTurns& free = *state.smooth.turns;
  for (std::size_t k = 0; k < free.count(); ++k) {
    Vec3 turn;
    for (std::size_t i = 0; i < turns.size(); ++i) turn = turn + free.follow[k * turns.size() + i] * turns[i];
    turns[free.handle[k]] = turn;
    HandleState& handle = state.handles[free.handle[k]];
    handle.turn = whole ? turn : turn + handle.turn;
    handle.rotation = whole ? exponential(turn) : normalised(exponential(turn) * handle.rotation);
  }
}

// The displacement of free handle k if it goes rigidly with the handles about it.
Vec3 Pose::carried(const State& state, std::size_t k) const noexcept {
  const FreeTurns& free = *state.smooth.turns;
  const std::size_t count = state.handles.size();
  Vec3 sum;
  double shares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = free.follow[k * count + i];
    const Vec3 to = free.centroid[k] - layout_->handles[i].region->centroid;
    sum = sum + share * (state.handles[i].rotation.toRotationMatrix() * to - to + state.handles[i].translation);
    shares += share;
  }
  return shares > 0 ? sum : state.handles[free.handle[k]].translation;  // shares are 1 together, or no handle is given
}

// A pose that starts anew takes the way of a drag: its free handles go to their places in steps. At once, the tail of a
// horse that is pulled up by its length ends in a fold, half a turn off.
void Pose::approach(State& state) noexcept {
  constexpr std::uint32_t steps = 8, iterations = 10;  // turns of a quick drag
  const FreeTurns& free = *state.smooth.turns;
  const Span<const RigidMotion> wanted = placed(state);
  for (std::uint32_t step = 1; step < steps; ++step) {
    const double way = static_cast<double>(step) / steps;
    for (std::size_t k = 0; k < free.count(); ++k) {
      const Vec3 to = wanted[free.handle[k]].translation, from = carried(state, k);
      state.handles[free.handle[k]].translation = from + way * (to - from);
    }
    place_handles(*layout_, state);
    solve_smooth(iterations);
    state.started = true;
  }
  for (std::size_t k = 0; k < free.count(); ++k)
    state.handles[free.handle[k]].translation = wanted[free.handle[k]].translation;
}

void Pose::start_turns(State& state) const noexcept {
  if (!state.smooth.turns) return;
  const FreeTurns& free = *state.smooth.turns;
  for (std::size_t k = 0; k < free.count(); ++k) {
    const HandleState& handle = state.handles[free.handle[k]];
    state.smooth.free.rotation[k] = handle.rotation;
    state.smooth.free.place[k] = free.centroid[k] + handle.translation;
  }
}

void Pose::take_turns(State& state) const noexcept {
  if (!state.smooth.turns) return;
  const FreeTurns& free = *state.smooth.turns;
  for (std::size_t k = 0; k < free.count(); ++k) {
    HandleState& handle = state.handles[free.handle[k]];
    handle.rotation = state.smooth.free.rotation[k];
    handle.turn = continued_logarithm(handle.rotation, handle.turn);
    handle.solved = handle.rotation;
    handle.solved_turn = handle.turn;
  }
}

// ---- layers ----

void PoseStack::set_free_turns(Span<const std::uint32_t> numbers, bool free_turn) {
  Vector<std::uint32_t> inner(&memory());
  for (std::uint32_t k = 0; k < numbers.size(); ++k) require(numbers[k], k);
  const auto collect = [&](std::uint32_t k) {
    inner.clear();
    for (const std::uint32_t number : numbers) {
      const Entry& entry = entries_[require(number, HF_NO_INDEX)];
      if (entry.layer == k && entry.free_turn != free_turn) inner.push_back(entry.inner[k]);
    }
    return !inner.empty();
  };
  std::array<std::shared_ptr<Layer>, layer_limit> layers = layers_;
  std::uint32_t lowest = layer_limit;
  for (std::uint32_t k = layer_limit - 1; k > 0; --k) {
    if (!collect(k)) continue;
    std::shared_ptr<Pose> plain = layers_[k]->plain->clone();
    plain->set_free_turns(inner, free_turn, false);
    layers[k] = make_layer(std::move(plain));
    lowest = k;
  }
  if (collect(0)) {
    base_->set_free_turns(inner, free_turn);  // changes all or nothing; the lines below cannot fail
    lowest = 0;
  }
  layers_ = std::move(layers);
  for (const std::uint32_t number : numbers) entries_[require(number, HF_NO_INDEX)].free_turn = free_turn;
  take_base_turns();
  if (lowest < layer_limit) mark_stale(lowest);
}

// Takes the rotations that the free handles of layer 0 have.
void PoseStack::take_base_turns() {
  for (Entry& entry : entries_) {
    if (entry.layer > 0 || !entry.free_turn) continue;
    entry.edit = base_->transform(entry.inner[0]);
    entry.turn = continued_logarithm(entry.edit.rotation, entry.turn);
    entry.placed = motion_of(entry.edit, entry.centroid);
  }
}

// Takes the rotations that the free handles of layer k found: q, which turns U to E. `placed` has F_h and the place.
void PoseStack::take_turns(std::uint32_t k) {
  for (Entry& entry : entries_) {
    if (entry.layer != k || !entry.free_turn || norm(entry.edit.translation) == 0) continue;
    const Quaternion from = layers_[k]->plain->transform(entry.inner[k]).rotation,
                     to = layers_[k]->edited->transform(entry.inner[k]).rotation, below = entry.placed.rotation;
    const Vec3 place = apply(entry.placed, entry.centroid);
    entry.placed.rotation = normalised(to * from.conjugate() * below);
    entry.placed.translation = place - rotate(entry.placed.rotation, entry.centroid);
    entry.edit.rotation = normalised(below.conjugate() * entry.placed.rotation);
    entry.turn = continued_logarithm(entry.edit.rotation, entry.turn);
  }
}

}  // namespace hf_inner::deform
