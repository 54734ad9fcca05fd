#include "deform/pose.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "base/number_pool.h"
#include "deform/pose_layout.h"

namespace hf_inner::deform {
namespace {

void require_range(std::uint32_t value, std::uint32_t low, std::uint32_t high, const char* name) {
  if (value != 0 && (value < low || value > high))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s is %u; it must lie in %u to %u, or be 0 for the default", name,
         value, low, high);
}

PoseOptions checked(const PoseOptions& options) {
  require_range(options.band_count, least_bands, most_bands, "band_count");
  require_range(options.iteration_count, 1, most_iterations, "iteration_count");
  require_range(options.group_count, 1, most_groups, "group_count");
  PoseOptions filled = options;
  const PoseScheme* scheme = options.scheme.get();
  if (filled.band_count == 0)
    filled.band_count = scheme ? static_cast<std::uint32_t>(scheme->bands.band_count) : default_pose_bands;
  if (filled.iteration_count == 0)
    filled.iteration_count = scheme ? scheme->default_iterations : default_pose_iterations;
  if (filled.group_count == 0) filled.group_count = default_groups;
  return filled;
}

}  // namespace

void check_request(const DeformRequest& request) {
  require_range(request.iteration_count, 1, most_iterations, "iteration_count");
}

Pose::Pose(std::shared_ptr<const surface::Core> core, const PoseOptions& options, std::shared_ptr<const Rest> rest)
    : core_(std::move(core)),
      options_(options),
      rest_(std::move(rest)),
      positions_(memory(), static_cast<std::size_t>(core_->size())),
      turns_(memory(), handle_limit),
      placed_(handle_limit, RigidMotion(), &memory()),
      start_(memory()) {}

std::shared_ptr<Pose> Pose::make(std::shared_ptr<const surface::Core> core, const PoseOptions& options) {
  const PoseOptions filled = checked(options);
  Memory& memory = *core->memory;
  return make_owner_in<Pose>(core->memory, core, filled, make_shared_in<Rest>(memory, *core, memory));
}

std::shared_ptr<Pose> Pose::clone() const {
  auto copy = make_owner_in<Pose>(core_->memory, core_, options_, rest_);
  copy->groups_ = groups_;
  copy->layout_ = layout_;
  copy->blend_revision_ = blend_revision_;
  copy->previous_layout_ = previous_layout_;
  if (state_) copy->state_ = make_shared_in<State>(memory(), *state_, memory());
  copy->previous_state_ = previous_state_;
  if (posed_ && !stale_) std::memcpy(copy->positions_.data(), positions_.data(), positions_.size() * sizeof(Vec3));
  copy->stale_ = stale_;
  copy->posed_ = posed_;
  copy->refined_ = refined_;
  copy->report_ = report_;
  copy->set_rigid(rigid_);
  return copy;
}

std::shared_ptr<const Rest> Pose::rest_on(const surface::Core& core) const {
  if (core.geometry != core_->geometry) return make_shared_in<Rest>(memory(), core, memory());
  return make_shared_in<Rest>(memory(), rest_->shape, core, memory());
}

std::shared_ptr<Pose> Pose::on(std::shared_ptr<const surface::Core> core, std::shared_ptr<const Rest> rest) const {
  ensure_surface();
  auto moved = clone();
  moved->core_ = core;
  moved->rest_ = std::move(rest);
  moved->previous_layout_.reset();
  moved->previous_state_.reset();
  const bool relinked = core->geometry != core_->geometry;
  if (relinked) moved->groups_.reset();  // they reach across links
  if (!layout_) return moved;
  Handles handles(&memory());
  for (const Handle& handle : layout_->handles) {
    const std::shared_ptr<const HandleRegion>& region = handle.region;
    handles.push_back(
        {handle.number, relinked ? make_region(*core, region->vertices, options_.rim_site_count, memory()) : region});
  }
  std::shared_ptr<const Layout> layout = moved->make_layout_on(handles, *layout_, *core_);
  if (state_->without) moved->brought_ = state_->without->on(core, moved->rest_);
  std::shared_ptr<State> state = moved->carry_over(*layout);
  moved->brought_.reset();
  // The groups keep their stresses too: without them a stroke that changes nothing moves the next frame.
  if (layout->smooth && layout->smooth->subspace.group == layout_->smooth->subspace.group && !relinked)
    state->smooth.stress = state_->smooth.stress;
  state->changed = true;
  moved->install(std::move(layout), std::move(state));
  return moved;
}

std::shared_ptr<Pose> Pose::without_handles() const {
  auto copy = make_owner_in<Pose>(core_->memory, core_, options_, rest_);
  copy->groups_ = groups_;
  return copy;
}

// ---- handles ----

std::uint32_t Pose::handle_count() const noexcept {
  return layout_ ? static_cast<std::uint32_t>(layout_->handles.size()) : 0;
}

std::int32_t Pose::find(std::uint32_t number) const noexcept {
  for (std::uint32_t i = 0; i < handle_count(); ++i) {
    if (layout_->handles[i].number == number) return static_cast<std::int32_t>(i);
  }
  return -1;
}

std::int32_t Pose::require(std::uint32_t number, std::uint32_t position) const {
  const std::int32_t i = find(number);
  if (i < 0) fail(HF_ERROR_NOT_FOUND, position, "the pose has no handle %u", number);
  return i;
}

void Pose::check_regions(Span<const std::uint32_t> start, Span<const std::int32_t> vertices) const {
  const std::size_t added = start.size() < 2 ? 0 : start.size() - 1;
  check_region_count(handle_count(), added, "handle");
  // by vertex: the region that has it, -1 for none, -2 - i for handle i
  Vector<std::int32_t> owner(static_cast<std::size_t>(core_->size()), -1, &memory());
  if (layout_) {
    for (std::int32_t v = 0; v < core_->size(); ++v)
      if (layout_->reach.owner[v] >= 0) owner[v] = -2 - layout_->reach.owner[v];
  }
  for (std::size_t r = 0; r < added; ++r) {
    if (start[r + 1] <= start[r]) fail(HF_ERROR_EMPTY, static_cast<std::uint32_t>(r), "region %zu has no vertex", r);
    for (std::uint32_t k = start[r]; k < start[r + 1]; ++k) {
      const std::int32_t v = vertices[k];
      if (v == mesh::Mesh::none)
        fail(HF_ERROR_INVALID_ARGUMENT, k, "entry %u of the regions is a vertex without a usable triangle", k);
      if (v < 0 || v >= core_->size())
        fail(HF_ERROR_OUT_OF_RANGE, k, "entry %u of the regions is no vertex of the mesh", k);
      if (owner[v] <= -2)
        fail(HF_ERROR_CONFLICT, k, "entry %u: the vertex belongs to handle %u already; regions must not overlap", k,
             layout_->handles[static_cast<std::size_t>(-2 - owner[v])].number);
      if (owner[v] != -1 && owner[v] != static_cast<std::int32_t>(r))
        fail(HF_ERROR_CONFLICT, k, "entry %u: the vertex belongs to region %d already; regions must not overlap", k,
             owner[v]);
      owner[v] = static_cast<std::int32_t>(r);
    }
  }
}

void Pose::add_handles(Span<const std::uint32_t> start, Span<const std::int32_t> vertices,
                       Span<std::uint32_t> out_numbers, const HandleKind& kind) {
  check_regions(start, vertices);
  check_free_turn(kind.free_turn);
  Handles handles(&memory());
  if (layout_) handles.assign(layout_->handles.begin(), layout_->handles.end());
  const std::size_t first = handles.size();
  NumberPool numbers;
  for (std::size_t r = 0; r + 1 < start.size(); ++r) {
    std::shared_ptr<HandleRegion> region =
        make_region(*core_, vertices.subspan(start[r], start[r + 1] - start[r]), options_.rim_site_count, memory());
    const std::uint32_t number = numbers.take([&](std::uint32_t candidate) {
      return std::any_of(handles.begin(), handles.end(), [&](const Handle& h) { return h.number == candidate; });
    });
    handles.push_back({number, std::move(region)});
  }
  std::shared_ptr<const Layout> layout = make_layout(handles);
  std::shared_ptr<State> state = carry_over(*layout, kind.free_turn);
  if (kind.in_place && posed_) {
    fit_new_handles(*layout, *state);
    keep_in_place(*layout, *state, true);
    state->stands = true;
  }
  previous_layout_ = layout_;
  previous_state_ = state_;
  install(std::move(layout), std::move(state));
  for (std::size_t r = 0; r < out_numbers.size(); ++r) out_numbers[r] = layout_->handles[first + r].number;
}

void Pose::remove_handles(Span<const std::uint32_t> numbers) {
  Vector<std::uint8_t> leaving(handle_count(), 0, &memory());
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    const std::int32_t i = require(numbers[k], k);
    if (leaving[i]) fail(HF_ERROR_NOT_FOUND, k, "handle %u is named twice", numbers[k]);
    leaving[i] = 1;
  }
  Handles remaining(&memory());
  for (std::size_t i = 0; i < leaving.size(); ++i) {
    if (!leaving[i]) remaining.push_back(layout_->handles[i]);
  }
  if (remaining.empty()) {
    previous_layout_.reset();
    previous_state_.reset();
    install(nullptr, nullptr);
    return;
  }
  if (restore_previous(remaining)) return;
  std::shared_ptr<const Layout> layout = make_layout(remaining);
  std::shared_ptr<State> state = carry_over(*layout);
  previous_layout_.reset();
  previous_state_.reset();
  install(std::move(layout), std::move(state));
}

// Restores the sites, fields, cluster weights and solver state before the last handles were added, if exactly those
// handles remain. The handles keep their present transforms, but free rotations go back with the solver.
bool Pose::restore_previous(const Handles& remaining) {
  if (!previous_layout_ || previous_layout_->handles.size() != remaining.size()) return false;
  for (std::size_t i = 0; i < remaining.size(); ++i) {
    if (previous_layout_->handles[i].region != remaining[i].region ||
        previous_layout_->handles[i].number != remaining[i].number)
      return false;
  }
  auto state = make_shared_in<State>(memory(), *previous_state_, memory());
  bool other_holds = false, other_limbs = false;
  for (std::size_t i = 0; i < remaining.size(); ++i) {
    const HandleState& now = state_->handles[find(remaining[i].number)];
    HandleState& then = state->handles[i];
    const bool found = now.free_turn && then.free_turn;  // by a solve; `then` has the one of the solve to go back to
    const bool same = (found || std::memcmp(&now.rotation, &then.rotation, sizeof now.rotation) == 0) &&
                      std::memcmp(&now.translation, &then.translation, sizeof now.translation) == 0;
    state->changed = state->changed || !same;
    then.translation = now.translation;
    if (!found) {
      then.rotation = now.rotation;
      then.turn = now.turn;
    }
    state->changed = state->changed || then.free_turn != now.free_turn;
    other_holds = other_holds || then.following != now.following || (state->without && then.free_turn != now.free_turn);
    other_limbs = other_limbs || then.limb_steps != now.limb_steps;
    then.free_turn = now.free_turn;
    then.following = now.following;
    then.limb_steps = now.limb_steps;
  }
  if (other_limbs) prepare_limbs(*previous_layout_, *state);
  if (other_holds) prepare_holds(*previous_layout_, *state);
  state->changed = state->changed || other_holds;
  prepare_turns(*previous_layout_, *state);
  std::shared_ptr<const Layout> layout = std::move(previous_layout_);
  previous_layout_.reset();
  previous_state_.reset();
  install(std::move(layout), std::move(state));
  return true;
}

void Pose::install(std::shared_ptr<const Layout> layout, std::shared_ptr<State> state) noexcept {
  ++blend_revision_;
  layout_ = std::move(layout);
  state_ = std::move(state);
  if (layout_ && layout_->groups) groups_ = layout_->groups;
  if (!layout_) {
    posed_ = false;
    stale_ = false;
  }
}

// Makes the groups of vertices that share a rotation, in components with at least two handles. This needs no field, so
// the first time groups and fields are made on two threads.
std::shared_ptr<const Groups> Pose::meet(const Layout& layout) const {
  Vector<std::int32_t> shared(&memory());
  for (std::int32_t c = 0; c < core_->mesh.component_count(); ++c) {
    if (layout.reach.handles_of(c).size() > 1) shared.push_back(c);
  }
  return Groups::with(groups_, *core_, *rest_, shared, static_cast<std::int32_t>(options_.group_count), memory());
}

std::shared_ptr<const Pose::Layout> Pose::make_layout(const Handles& handles) const {
  if (layout_) return make_layout(handles, layout_->sites->clone(), layout_->handles);
  return make_layout(handles, solve::SiteSolver::make(core_), Handles(&memory()));
}

// Makes the layout of a pose that comes from another core. Both engines take the elimination paths and the dense system
// of an engine on the core whose factor they extend. Such an engine is kept for the next move: strokes of a brush all
// have the same.
std::shared_ptr<const Pose::Layout> Pose::make_layout_on(const Handles& handles, const Layout& before,
                                                         const surface::Core& from) const {
  const Handles none(&memory());
  std::shared_ptr<solve::SiteSolver> plain;
  if (core_->factored && core_->factored->geometry == core_->geometry) {
    const bool same = from.geometry == core_->geometry;
    if (same && &from == core_->factored.get()) {
      plain = before.sites;
    } else if (same && before.plain_sites && from.factored == core_->factored) {
      plain = before.plain_sites;
    } else {
      plain = before.sites->on(core_->factored);
      set_handle_sites(*core_->factored, *plain, none, handles, memory());
    }
  }
  return make_layout(handles, (plain ? *plain : *before.sites).on(core_), none, plain);
}

std::shared_ptr<const Pose::Layout> Pose::make_layout(const Handles& handles, std::shared_ptr<solve::SiteSolver> sites,
                                                      const Handles& present,
                                                      std::shared_ptr<solve::SiteSolver> plain_sites) const {
  auto layout = make_shared_in<Layout>(memory(), handles, std::move(sites), *core_, memory());
  layout->plain_sites = std::move(plain_sites);
  const auto solve = [&] {
    set_handle_sites(*core_, *layout->sites, present, layout->handles, memory());
    layout->fields = solve_handle_fields(*core_, *layout->sites, layout->handles, layout->reach, memory());
  };
  if (options_.scheme) {
    solve();
  } else if (groups_) {
    solve();
    layout->groups = meet(*layout);
  } else {
    core_->jobs->for_each(2, [&](std::uint32_t half) {
      if (half == 0) {
        layout->groups = meet(*layout);
      } else {
        solve();
      }
    });
  }
  BandOptions bands = options_.scheme ? options_.scheme->bands : BandOptions();
  bands.band_count = static_cast<std::int32_t>(options_.band_count);
  layout->weights = make_cluster_weights(*core_, *rest_, layout->reach, layout->fields, bands, memory());
  list_blocks(layout->weights, *core_->jobs);
  layout->boxes = cluster_boxes(core_->mesh, layout->weights, memory());
  if (options_.scheme) {
    layout->rigid = options_.scheme->prepare(*core_, layout->weights, memory());
  } else {
    layout->smooth = make_shared_in<SmoothSystem>(memory(), *core_, *rest_, layout->weights, *layout->groups,
                                                  layout->fields, memory());
  }
  return layout;
}

std::shared_ptr<Pose::State> Pose::carry_over(const Layout& layout, bool free_turn) const {
  auto state = make_shared_in<State>(memory(), memory());
  state->transforms.assign(static_cast<std::size_t>(layout.weights.cluster_count), to_affine({}));
  state->columns.allocate(memory(), column_count(layout.weights));
  for (const Handle& handle : layout.handles) {
    const std::int32_t old = find(handle.number);
    HandleState carried;
    const auto same_region = [&](const HandleRegion& before) {
      return &before == handle.region.get() || before.vertices == handle.region->vertices;
    };
    if (old >= 0 && same_region(*layout_->handles[old].region)) {
      carried = state_->handles[old];
      state->handles.push_back(carried);
      continue;
    }
    carried.free_turn = free_turn;
    if (posed_) {
      // A new handle gets the rotation that the surface has at its region. So the step that predicts the next rotations
      // also works when the host turns the handle back to rest.
      carried.solved = fit_region(handle).rotation;
      carried.solved_turn = logarithm(carried.solved);
      if (free_turn) {
        carried.rotation = carried.solved;
        carried.turn = carried.solved_turn;
      }
    }
    state->handles.push_back(carried);
  }
  prepare_limbs(layout, *state);
  state->started = state_ && state_->started;
  if (state_ && state_->followed) {
    state->followed = make_shared_in<Followed>(memory(), core_->size(), layout.weights.cluster_count, memory());
    const Buffer<float>& correction = state_->followed->correction;
    std::copy(correction.begin(), correction.end(), state->followed->correction.begin());
  }
  if (layout.rigid) {
    state->rigid = layout.rigid->rest(memory());
    if (posed_) {
      ensure_surface();
      Vector<Vec3> own_unit(&memory());
      own_unit.reserve(positions_.size());
      for (const Vec3& x : positions_) own_unit.push_back(core_->mesh.to_inner(x));
      layout.rigid->fit(core_->mesh, own_unit.data(), *state->rigid);
    }
    return state;
  }
  if (state_) state->smooth.rotation.assign(state_->smooth.rotation.begin(), state_->smooth.rotation.end());
  state->smooth.fit(*layout.smooth, *layout.groups);
  prepare_holds(layout, *state);
  prepare_turns(layout, *state);
  // In components with a single handle so far, rotations start from the handles' whole turns and fields.
  Vector<Vec3> turns(&memory());
  for (const HandleState& handle : state->handles) turns.push_back(handle.solved_turn);
  for (const std::int32_t c : layout.weights.elastic_components) {
    const bool was_elastic = layout_ && std::binary_search(layout_->weights.elastic_components.begin(),
                                                           layout_->weights.elastic_components.end(), c);
    if (!was_elastic) start_rotations(*layout.smooth, *layout.groups, c, turns, state->smooth);
  }
  return state;
}

HandleReport Pose::handle(std::uint32_t number) const {
  const std::int32_t i = require(number, HF_NO_INDEX);
  const HandleRegion& region = *layout_->handles[i].region;
  HandleReport report;
  report.vertex_count = static_cast<std::uint32_t>(region.vertices.size());
  report.site_count = static_cast<std::uint32_t>(region.sites.size());
  report.component = static_cast<std::uint32_t>(region.component);
  report.centroid = core_->mesh.to_given(region.centroid);
  report.leak = layout_->fields.leak[i];
  return report;
}

HandleTransform Pose::transform(std::uint32_t number) const {
  const HandleState& handle = state_->handles[require(number, HF_NO_INDEX)];
  return {handle.rotation, core_->mesh.scale * handle.translation};
}

FieldColumn<const double> Pose::field(std::uint32_t number) const {
  const std::int32_t handle = require(number, HF_NO_INDEX);  // first: without a handle there is no field
  return static_cast<const Layout&>(*layout_).fields.of(handle);
}

const ClusterWeights* Pose::weights() const noexcept { return layout_ ? &layout_->weights : nullptr; }

Span<const Affine> Pose::cluster_transforms() const noexcept {
  return state_ ? Span<const Affine>(state_->transforms) : Span<const Affine>();
}

}  // namespace hf_inner::deform
