// How much follows a handle: the pins of holds.h in poses and their layers.
#include <cstring>

#include "base/error.h"
#include "deform/pose_layout.h"
#include "deform/pose_stack.h"

namespace hf_inner::deform {

double Pose::following(std::uint32_t number) const { return state_->handles[require(number, HF_NO_INDEX)].following; }

void Pose::set_following(Span<const std::uint32_t> numbers, double following) {
  for (std::uint32_t k = 0; k < numbers.size(); ++k) require(numbers[k], k);
  if (options_.scheme && following < 1)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "a baseline of poses has no following; make the pose with hf_pose_create");
  auto state = make_shared_in<State>(memory(), *state_, memory());
  bool changed = false;
  for (const std::uint32_t number : numbers) {
    HandleState& handle = state->handles[find(number)];
    changed = changed || handle.following != following;
    handle.following = following;
  }
  if (!changed) return;
  prepare_holds(*layout_, *state);
  prepare_turns(*layout_, *state);
  state->smooth.anderson.forget();  // its steps belong to other equations
  state->changed = true;
  if (state->stands) keep_in_place(*layout_, *state, state->crossfade && state->crossfade->from_rest > 0);
  state_ = std::move(state);
}

// Prepares the pins, and the pose without the handles that are held back.
void Pose::prepare_holds(const Layout& layout, State& state) const {
  state.smooth.holds.reset();
  state.without.reset();
  if (!layout.smooth) return;
  Vector<double> follow(&memory());
  Vector<std::uint32_t> start(1, 0u, &memory()), free(&memory());
  Vector<std::int32_t> vertices(&memory());
  for (std::size_t i = 0; i < state.handles.size(); ++i) {
    follow.push_back(state.handles[i].following);
    if (follow[i] < 1) continue;
    const Vector<std::int32_t>& region = layout.handles[i].region->vertices;
    vertices.insert(vertices.end(), region.begin(), region.end());
    start.push_back(static_cast<std::uint32_t>(vertices.size()));
  }
  if (start.size() == follow.size() + 1) return;
  auto holds = make_shared_in<Holds>(memory(), make_holds({core_->mesh, layout.smooth->subspace, layout.weights,
                                                           *layout.groups, layout.fields, layout.reach, follow},
                                                          memory()));
  if (holds->count() == 0) return;
  state.smooth.held.fit(holds->count());
  state.smooth.holds = std::move(holds);
  if (vertices.empty()) return;
  if (brought_ && brought_->handle_count() + 1 == start.size()) {
    state.without = brought_;
    return;
  }
  std::shared_ptr<Pose> without = without_handles();
  Vector<std::uint32_t> numbers(start.size() - 1, 0u, &memory());
  without->add_handles(start, vertices, numbers);
  std::size_t k = 0;
  for (const HandleState& handle : state.handles) {
    if (handle.following < 1) continue;
    if (handle.free_turn) free.push_back(numbers[k]);
    ++k;
  }
  without->set_free_turns(free, true, false);
  state.without = std::move(without);
}

// Solves the pose without the handles that are held back, and notes where the pins pull to. Returns whether it moved.
bool Pose::pull_to_others(State& state, const DeformRequest& request) const {
  if (!state.smooth.holds) return false;
  bool moved = false;
  if (Pose* const other = state.without.get()) {
    std::size_t k = 0;
    for (const HandleState& handle : state.handles) {
      if (handle.following < 1) continue;
      HandleState& to = other->state_->handles[k++];
      const bool turned = !to.free_turn && std::memcmp(&to.rotation, &handle.rotation, sizeof handle.rotation) != 0,
                 shifted = std::memcmp(&to.translation, &handle.translation, sizeof handle.translation) != 0;
      to.translation = handle.translation;
      if (turned) {
        to.rotation = handle.rotation;
        to.turn = handle.turn;
      }
      other->state_->changed = other->state_->changed || turned || shifted;
    }
    DeformRequest own;
    own.iteration_count = request.iteration_count;
    own.restart = request.restart;
    own.surface = false;
    moved = other->deform(own).iteration_count > 0;
  }
  const Holds& holds = *state.smooth.holds;
  for (std::size_t j = 0; j < holds.count(); ++j) {
    const std::int32_t v = holds.vertex[j];
    const Vec3 p = state.without ? core_->mesh.to_inner(state.without->blended(v)) : core_->mesh.positions[v];
    double* const target = state.smooth.held.target.data() + 4 * j;
    target[0] = p.x;
    target[1] = p.y;
    target[2] = p.z;
  }
  return moved;
}

// ---- layers ----

void PoseStack::set_following(Span<const std::uint32_t> numbers, double following) {
  base_->set_following(on_base(numbers, "following"), following);
  mark_stale(0);
}

double PoseStack::following(std::uint32_t number) const {
  const Entry& entry = entries_[require(number, HF_NO_INDEX)];
  return entry.layer > 0 ? 1 : base_->following(entry.inner[0]);
}

}  // namespace hf_inner::deform
