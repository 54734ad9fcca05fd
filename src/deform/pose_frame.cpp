// A frame of a pose: transforms of handles in, transforms of clusters, vertices and normals out.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/timer.h"
#include "deform/pose_layout.h"

namespace hf_inner::deform {

namespace {

// How far a matrix, column by column, is from the rigid motion of a rotation.
double off_rigid(const double* m, const Quaternion& rotation) {
  const Mat3 exact = rotation.toRotationMatrix();
  double off = std::fabs(m[3]) + std::fabs(m[7]) + std::fabs(m[11]) + std::fabs(m[15] - 1);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) off = std::max(off, std::fabs(m[4 * j + i] - exact(i, j)));
  }
  return off;
}

Quaternion rotation_of(const double* m) {
  Mat3 linear;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) linear(i, j) = m[4 * j + i];
  }
  return best_rotation(linear, Quaternion());
}

}  // namespace

HandleTransform rigid_transform(const double* m, Vec3 centroid, std::uint32_t index) {
  double turned[16];
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(m[i])) fail(HF_ERROR_NON_FINITE, index, "matrix %u holds a number that is not finite", index);
    turned[i] = m[4 * (i % 4) + i / 4];
  }
  const Quaternion rotation = rotation_of(m);
  if (!(off_rigid(m, rotation) <= rigid_tolerance)) {
    if (off_rigid(turned, rotation_of(turned)) <= rigid_tolerance)
      fail(
          HF_ERROR_INVALID_ARGUMENT, index,
          "matrix %u has its translation in elements 3, 7 and 11: is it transposed? Matrices go column by column, with "
          "the translation in elements 12 to 14",
          index);
    fail(HF_ERROR_INVALID_ARGUMENT, index, "matrix %u is no rigid motion; scale and shear are not taken", index);
  }
  return {rotation, rotate(rotation, centroid) + Vec3{m[12], m[13], m[14]} - centroid};
}

void Pose::check_transform(const HandleTransform& transform, std::uint32_t index, double scale) {
  const Quaternion& q = transform.rotation;
  const Vec3 t = transform.translation;
  if (!q.coeffs().allFinite() || !std::isfinite(t.x) || !std::isfinite(t.y) || !std::isfinite(t.z))
    fail(HF_ERROR_NON_FINITE, index, "transform %u holds a number that is not finite", index);
  if (!(norm(transform.translation) <= largest_translation * scale))
    fail(HF_ERROR_NON_FINITE, index, "the translation of transform %u is beyond %g box diagonals", index,
         largest_translation);
}

void Pose::set_transforms(Span<const std::uint32_t> numbers, Span<const HandleTransform> transforms) {
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    require(numbers[k], k);
    check_transform(transforms[k], k, core_->mesh.scale);
  }
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    HandleState& handle = state_->handles[find(numbers[k])];
    const Quaternion rotation = normalised(transforms[k].rotation);
    const Vec3 translation = (1.0 / core_->mesh.scale) * transforms[k].translation;
    const bool same = std::memcmp(&rotation, &handle.rotation, sizeof rotation) == 0 &&
                      std::memcmp(&translation, &handle.translation, sizeof translation) == 0;
    handle.turn = continued_logarithm(rotation, handle.turn);
    handle.rotation = rotation;
    handle.translation = translation;
    state_->changed = state_->changed || !same;
    state_->stands = state_->stands && same;
  }
}

void Pose::place_handles(const Layout& layout, State& state) const noexcept {
  for (std::size_t i = 0; i < state.handles.size(); ++i) {
    const HandleState& handle = state.handles[i];
    const Vec3 centroid = layout.handles[i].region->centroid;
    const Vec3 turned = handle.rotation.toRotationMatrix() * centroid;
    state.transforms[i] = to_affine({handle.rotation, centroid - turned + handle.translation});
  }
}

// Returns the handles as Crossfade::placed has them. The span stays valid until the next call.
Span<const RigidMotion> Pose::placed(const State& state) const noexcept {
  for (std::size_t i = 0; i < state.handles.size(); ++i)
    placed_[i] = {state.handles[i].rotation, state.handles[i].translation};
  return {placed_.data(), state.handles.size()};
}

void Pose::solve_smooth(std::uint32_t iterations) noexcept {
  State& state = *state_;
  const std::size_t count = state.handles.size();
  const Span<Vec3> turns{turns_.data(), count};
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    turns[i] = logarithm(state.handles[i].rotation * state.handles[i].solved.conjugate());
    largest = std::max(largest, norm(turns[i]));
  }
  if (!state.started || largest > jump_turn) {
    if (state.followed) state.followed->forget();
    follow_turns(state, turns, true);
    start_rotations(*layout_->smooth, *layout_->groups, -1, turns, state.smooth);
  } else if (largest > 0) {
    follow_turns(state, turns, false);
    predict_rotations(*layout_->smooth, turns, state.smooth);
  }
  for (std::size_t i = 0; i < count; ++i) turns[i] = state.handles[i].turn;
  set_turn_limit(*layout_->smooth, turns, state.smooth);
  start_turns(state);
  report_ = solve_pose(*layout_->smooth, iterations, settled_change, state.smooth, state.transforms.data());
  take_turns(state);
  for (HandleState& handle : state.handles) {
    handle.solved = handle.rotation;
    handle.solved_turn = handle.turn;
  }
}

void Pose::solve_rigid(std::uint32_t iterations) noexcept {
  for (HandleState& handle : state_->handles) {
    handle.solved = handle.rotation;
    handle.solved_turn = handle.turn;
  }
  report_ = layout_->rigid->solve(core_->mesh, layout_->weights, iterations, settled_change, *state_->rigid,
                                  state_->transforms.data());
}

void Pose::make_refinement(const Layout& layout, std::uint32_t steps, const Followed* followed) {
  // one that is too small is replaced, so that it can be put back
  const std::int32_t slots = layout.sites->slot_count();
  const std::shared_ptr<Refinement> refinement = refinement_ && refinement_->has_room(slots, steps, followed)
                                                     ? refinement_
                                                     : make_shared_in<Refinement>(memory(), *core_, memory());
  refinement->fit(slots, steps, followed);
  refinement_ = refinement;
}

// Makes the tables that the frame needs beside the pose, all or nothing.
void Pose::prepare(const DeformRequest& request) {
  if (!layout_) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the pose has no handle; add one first");
  check_request(request);
  const std::size_t n = static_cast<std::size_t>(core_->mesh.vertex_count());
  Buffer<NormalSum> sums;
  Buffer<Normal> normals;
  const bool own_normals = request.normals && !request.packed_normals;
  if (request.normals && normal_sums_.size() < n) sums.allocate(memory(), n);
  if (own_normals && normals_.size() < n) normals.allocate(memory(), n);
  std::shared_ptr<Followed> followed = request.refine_from_last ? state_->followed : nullptr;
  if (request.refine_from_last && !followed)
    followed = make_shared_in<Followed>(memory(), n, layout_->weights.cluster_count, memory());
  const std::uint32_t steps = std::max(request.refine, state_->limbs ? state_->limbs->steps : 0);
  if (steps > 0) make_refinement(*layout_, steps, followed.get());
  state_->followed = std::move(followed);
  if (!sums.empty()) normal_sums_ = std::move(sums);
  if (!normals.empty()) normals_ = std::move(normals);
}

struct Pose::Kept {
  std::shared_ptr<State> state;
  Buffer<Vec3> positions;
  std::shared_ptr<Refinement> refinement;
  bool posed = false, stale = false, whole = false;
  std::uint32_t refined = 0;
  SolveReport report;
};

std::shared_ptr<Pose::Kept> Pose::keep(bool whole) {
  auto kept = make_shared_in<Kept>(memory());
  kept->refinement = refinement_;
  kept->whole = whole;
  if (!whole) return kept;
  kept->positions.allocate(memory(), positions_.size());
  std::memcpy(kept->positions.data(), positions_.data(), positions_.size() * sizeof(Vec3));
  if (state_) {  // the frame works on a copy
    kept->state = make_shared_in<State>(memory(), *state_, memory());
    kept->state.swap(state_);
  }
  kept->posed = posed_;
  kept->stale = stale_;
  kept->refined = refined_;
  kept->report = report_;
  return kept;
}

void Pose::put_back(Kept& kept) noexcept {
  refinement_.swap(kept.refinement);
  if (!kept.whole) return;
  state_.swap(kept.state);
  positions_.swap(kept.positions);
  posed_ = kept.posed;
  stale_ = kept.stale;
  refined_ = kept.refined;
  report_ = kept.report;
}

void Pose::ensure_surface() const {
  if (!stale_) return;
  blend(core_->mesh, layout_->weights, state_->transforms.data(), state_->columns.data(), core_->mesh.centre,
        core_->mesh.scale, positions_.data(), nullptr, *core_->jobs);
  if (const double share = crossfade_share(); share > 0)
    add_crossfade(*state_->crossfade, share, positions_.data(), *core_->jobs);
  stale_ = false;
}

// Returns the share of a new frame. A crossfade that has no share is over.
double Pose::fade_crossfade() noexcept {
  state_->share = state_->crossfade ? share_left(*state_->crossfade, placed(*state_)) : 0;
  if (!(state_->share > 0)) state_->crossfade.reset();
  return state_->share;
}

// Takes full-mesh steps. limbs: null, or the only vertices that they move.
void Pose::refine(const Layout& layout, const State& state, std::uint32_t steps, const Limbs* limbs, Vec3* positions) {
  const RefineInput input{*core_,
                          *rest_,
                          layout.reach,
                          layout.weights,
                          *layout.sites,
                          layout.handles,
                          layout.groups.get(),
                          layout.smooth ? &state.smooth.rotation : nullptr,
                          state.transforms.data(),
                          limbs};
  refinement_->apply(input, steps, limbs ? nullptr : state.followed.get(), positions);
}

Vec3 Pose::blended(std::int32_t vertex) const noexcept {
  const Vec3 p = core_->mesh.to_given(blend_vertex(core_->mesh, layout_->weights, state_->transforms.data(), vertex));
  const double share = crossfade_share();
  if (!(share > 0)) return p;
  const float* d = state_->crossfade->offset.data() + 3 * static_cast<std::size_t>(vertex);
  return p + share * Vec3{d[0], d[1], d[2]};
}

BlendBox Pose::blend_box() const noexcept {
  BlendBox box =
      blended_box(core_->mesh, layout_->weights, layout_->boxes, posed_ ? state_->transforms.data() : nullptr);
  const double scale = core_->mesh.scale, share = crossfade_share();
  box = {scale * box.low, scale * box.high};
  if (share > 0) box = {box.low + share * state_->crossfade->low, box.high + share * state_->crossfade->high};
  return box;
}

// Vertices and normals from the transforms.
void Pose::write_surface(const DeformRequest& request, DeformReport& report) {
  const mesh::Mesh& mesh = core_->mesh;
  posed_ = true;
  refined_ = request.refine;
  stale_ = !request.surface;
  report.cluster_count = static_cast<std::uint32_t>(layout_->weights.cluster_count);
  report.unreached_vertex_count = static_cast<std::uint32_t>(layout_->weights.unreached_vertex_count);
  report.last_change = state_->last_change;
  const double share = fade_crossfade();
  if (!request.surface) return;
  const Timer blend_timer;
  const Limbs* const limbs = state_->limbs.get();
  const bool blended_only = request.refine == 0 && !limbs && !(share > 0) && !rigid_;
  float* packed = blended_only ? request.packed_positions : nullptr;
  blend(mesh, layout_->weights, state_->transforms.data(), state_->columns.data(), mesh.centre, mesh.scale,
        positions_.data(), packed, *core_->jobs);
  report.packed_positions = packed != nullptr;
  report.blend_ms = blend_timer.milliseconds();
  const Timer refine_timer;
  const bool stays = state_->followed && share == 1;  // handles were added in place, and nothing moved since
  if (request.refine > 0) refine(*layout_, *state_, stays ? 0 : request.refine, nullptr, positions_.data());
  if (limbs) refine(*layout_, *state_, limbs->steps, limbs, positions_.data());
  report.refine_ms = request.refine > 0 || limbs ? refine_timer.milliseconds() : 0;
  if (share > 0) add_crossfade(*state_->crossfade, share, positions_.data(), *core_->jobs);
  make_rigid();
  report.positions = {positions_.data(), positions_.size()};
  if (request.normals) {
    const Timer normal_timer;
    Normal* normals = request.packed_normals ? request.packed_normals : normals_.data();
    vertex_normals(mesh, *rest_, positions_.data(), normal_sums_.data(), normals, *core_->jobs);
    report.normals = {normals, positions_.size()};
    report.normal_ms = normal_timer.milliseconds();
  }
}

DeformReport Pose::deform(const DeformRequest& request) {
  prepare(request);
  State& state = *state_;
  if (request.restart) {
    for (HandleState& handle : state.handles) handle.turn = logarithm(handle.rotation);
    if (state.rigid) std::fill(state.rigid->motion.begin(), state.rigid->motion.end(), RigidMotion());
    state.started = state.stands = false;
    state.changed = true;
    state.crossfade.reset();
    if (state.followed) state.followed->forget();
  }

  DeformReport report;
  const Timer solve_timer;
  if (state.changed) state.idle_iterations = 0;
  const bool pulled = pull_to_others(state, request);
  const std::uint32_t idle_limit = options_.scheme ? options_.scheme->idle_limit : pose_idle_limit;
  if (state.changed || pulled || (state.last_change >= settled_change && state.idle_iterations < idle_limit)) {
    const std::uint32_t iterations = request.iteration_count ? request.iteration_count : options_.iteration_count;
    if (!state.started && state.smooth.turns) approach(state);
    place_handles(*layout_, state);
    if (layout_->smooth) {
      solve_smooth(iterations);
    } else {
      solve_rigid(iterations);
    }
    report.iteration_count = report_.iterations;
    state.idle_iterations += report_.iterations;
    state.started = true;
    state.changed = false;
    state.last_change = report_.last_change;
  }
  report.solve_ms = solve_timer.milliseconds();
  write_surface(request, report);
  return report;
}

// ---- for layers ----

Span<const std::int32_t> Pose::region(std::uint32_t number) const {
  return layout_->handles[require(number, HF_NO_INDEX)].region->vertices;
}

void Pose::prepare_start() {
  if (!layout_) return;
  if (layout_->smooth) {
    start_.choose(*core_, *layout_->groups, layout_->smooth->subspace.group);
  } else {
    start_.motion.assign(state_->rigid->motion.begin(), state_->rigid->motion.end());
    start_.own_unit.resize(core_->size());
  }
}

void Pose::take_start(Span<const Vec3> surface) noexcept {
  if (layout_->smooth) return start_.fit(*core_, *rest_, surface);
  for (std::size_t v = 0; v < surface.size(); ++v) start_.own_unit[v] = core_->mesh.to_inner(surface[v]);
  // Among equal fits the one nearest to rest is used, so the result does not depend on the last frame.
  Vector<RigidMotion>& motion = state_->rigid->motion;
  std::fill(motion.begin(), motion.end(), RigidMotion());
  layout_->rigid->fit(core_->mesh, start_.own_unit.data(), *state_->rigid);
  std::copy(motion.begin(), motion.end(), start_.motion.begin());
}

DeformReport Pose::deform_from(const Pose& start, Span<const Vec3> turns, const DeformRequest& request) {
  prepare(request);
  State& state = *state_;
  DeformReport report;
  const Timer solve_timer;
  const std::uint32_t iterations = request.iteration_count ? request.iteration_count : options_.iteration_count;
  place_handles(*layout_, state);
  if (layout_->smooth) {
    std::copy(start.start_.rotation.begin(), start.start_.rotation.end(), state.smooth.rotation.begin());
    std::fill(state.smooth.stress.begin(), state.smooth.stress.end(), Stress());
    state.smooth.anderson.forget();
    predict_rotations(*layout_->smooth, turns, state.smooth);
    state.smooth.turn_limit = SmoothState::no_turn_limit;  // the start is close enough
    start_turns(state);
    report_ = solve_pose(*layout_->smooth, iterations, settled_change, state.smooth, state.transforms.data());
    take_turns(state);
  } else {
    std::copy(start.start_.motion.begin(), start.start_.motion.end(), state.rigid->motion.begin());
    report_ = layout_->rigid->solve(core_->mesh, layout_->weights, iterations, settled_change, *state.rigid,
                                    state.transforms.data());
  }
  report.iteration_count = report_.iterations;
  state.started = true;
  state.changed = true;
  state.last_change = report_.last_change;
  report.solve_ms = solve_timer.milliseconds();
  write_surface(request, report);
  return report;
}

}  // namespace hf_inner::deform
