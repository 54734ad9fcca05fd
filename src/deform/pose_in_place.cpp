// Handles that begin on the posed surface. The surface stays there at first (crossfade.h).
#include "deform/pose_layout.h"
#include "deform/pose_stack.h"

namespace hf_inner::deform {

// Returns the rigid motion from rest that the posed surface has at a handle's region, in the unit of the scaled mesh.
RigidMotion Pose::fit_region(const Handle& handle) const {
  ensure_surface();
  Vector<Vec3> rest(&memory()), posed(&memory());
  for (const std::int32_t v : handle.region->vertices) {
    rest.push_back(core_->mesh.positions[v]);
    posed.push_back(core_->mesh.to_inner(positions_[v]));
  }
  return fit_rigid(rest, posed, {}, Quaternion());
}

// Places the new handles on the posed surface.
void Pose::fit_new_handles(const Layout& layout, State& state) const {
  for (std::size_t i = 0; i < layout.handles.size(); ++i) {
    if (find(layout.handles[i].number) >= 0) continue;
    const RigidMotion motion = fit_region(layout.handles[i]);
    HandleState& handle = state.handles[i];
    const Vec3 centroid = layout.handles[i].region->centroid;
    handle.rotation = motion.rotation;
    handle.translation = apply(motion, centroid) - centroid;
    handle.turn = handle.solved_turn = logarithm(motion.rotation);
    handle.solved = motion.rotation;
  }
}

// Solves, and notes how far the new pose is from the surface. It changes `state` alone. fades_at_rest: the difference
// also fades as the handles go back to rest.
void Pose::keep_in_place(const Layout& layout, State& state, bool fades_at_rest) {
  if (!layout.smooth) return;
  ensure_surface();
  place_handles(layout, state);
  Vector<Vec3> turns(&memory());
  for (const HandleState& handle : state.handles) turns.push_back(handle.turn);
  set_turn_limit(*layout.smooth, turns, state.smooth);
  start_turns(state);
  DeformRequest others;
  others.iteration_count = pose_idle_limit;  // the pins stand still afterwards
  pull_to_others(state, others);
  solve_pose(*layout.smooth, crossfade_iterations, settled_change, state.smooth, state.transforms.data());
  take_turns(state);
  state.started = true;
  state.changed = false;  // no frame solves again before a handle moves
  state.last_change = 0;
  const std::size_t n = positions_.size();
  Buffer<Vec3> fresh(memory(), n);
  blend(core_->mesh, layout.weights, state.transforms.data(), state.columns.data(), core_->mesh.centre,
        core_->mesh.scale, fresh.data(), nullptr, *core_->jobs);
  if (state.followed) state.followed->lead(fresh.data(), positions_.data());
  const Limbs* const limbs = state.limbs.get();
  const std::uint32_t steps = std::max(refined_, limbs ? limbs->steps : 0);
  if (steps > 0) make_refinement(layout, steps, state.followed.get());
  if (refined_ > 0) refine(layout, state, state.followed ? 0 : refined_, nullptr, fresh.data());
  if (limbs) refine(layout, state, limbs->steps, limbs, fresh.data());
  auto crossfade = make_shared_in<Crossfade>(memory(), n, memory());
  const Span<const RigidMotion> now = placed(state);
  crossfade->placed.assign(now.begin(), now.end());
  if (fades_at_rest) {
    crossfade->from_rest = way_from_rest(now);
    if (!(crossfade->from_rest > 0)) return;
  }
  for (std::size_t v = 0; v < n; ++v) {
    const Vec3 d = positions_[v] - fresh[v];
    float* offset = crossfade->offset.data() + 3 * v;
    offset[0] = static_cast<float>(d.x);
    offset[1] = static_cast<float>(d.y);
    offset[2] = static_cast<float>(d.z);
    const Vec3 rounded{offset[0], offset[1], offset[2]};
    Vec3 &low = crossfade->low, &high = crossfade->high;
    low = {std::min(low.x, rounded.x), std::min(low.y, rounded.y), std::min(low.z, rounded.z)};
    high = {std::max(high.x, rounded.x), std::max(high.y, rounded.y), std::max(high.z, rounded.z)};
  }
  state.crossfade = std::move(crossfade);
  state.share = 1;
  ++blend_revision_;
}

// ---- layers ----

// Fits a rigid motion to a region: the rotation of the edges at its vertices, and the mean of its vertices.
RigidMotion PoseStack::fit_region(const Entry& entry, Span<const std::int32_t> region,
                                  const Vec3* surface) const noexcept {
  Mat3 sum;
  Vec3 mean;
  for (const std::int32_t v : region) {
    add_ring(*core_, base_->rest(), surface, v, sum);
    mean = mean + surface[v];
  }
  RigidMotion motion;
  motion.rotation = best_rotation(sum, Quaternion());
  motion.translation = (1.0 / static_cast<double>(region.size())) * mean - rotate(motion.rotation, entry.centroid);
  return motion;
}

}  // namespace hf_inner::deform
