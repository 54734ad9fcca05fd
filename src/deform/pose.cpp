#include "deform/pose.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/number_pool.h"
#include "base/timer.h"

namespace hf_inner {
namespace {

bool is_finite(Vec3 v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void require_range(std::uint32_t value, std::uint32_t low, std::uint32_t high, const char* name) {
  if (value != 0 && (value < low || value > high))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s is %u; it must lie in %u to %u, or be 0 for the default", name,
         value, low, high);
}

PoseOptions checked(const PoseOptions& options) {
  if (options.mode != DeformMode::smooth && options.mode != DeformMode::paper)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "mode is %d; use HF_DEFORM_SMOOTH or HF_DEFORM_PAPER",
         static_cast<int>(options.mode));
  require_range(options.band_count, least_bands, most_bands, "band_count");
  require_range(options.iteration_count, 1, most_iterations, "iteration_count");
  require_range(options.group_count, 1, most_groups, "group_count");
  PoseOptions filled = options;
  const bool smooth = options.mode == DeformMode::smooth;
  if (filled.band_count == 0) filled.band_count = smooth ? default_bands_smooth : default_bands_paper;
  if (filled.iteration_count == 0)
    filled.iteration_count = smooth ? default_iterations_smooth : default_iterations_paper;
  if (filled.group_count == 0) filled.group_count = default_groups;
  return filled;
}

}  // namespace

void check_request(const DeformRequest& request) {
  require_range(request.iteration_count, 1, most_iterations, "iteration_count");
}

HandleTransform rigid_transform(const double* m, Vec3 centroid, std::uint32_t index) {
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(m[i])) fail(HF_ERROR_NON_FINITE, index, "matrix %u holds a number that is not finite", index);
  }
  Mat3 linear;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) linear(i, j) = m[4 * j + i];
  }
  const Quaternion rotation = best_rotation(linear, Quaternion());
  const Mat3 exact = rotation.toRotationMatrix();
  double off = std::fabs(m[3]) + std::fabs(m[7]) + std::fabs(m[11]) + std::fabs(m[15] - 1);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) off = std::max(off, std::fabs(linear(i, j) - exact(i, j)));
  }
  if (!(off <= rigid_tolerance))
    fail(HF_ERROR_INVALID_ARGUMENT, index, "matrix %u is no rigid motion; scale and shear are not taken", index);
  return {rotation, rotate(rotation, centroid) + Vec3{m[12], m[13], m[14]} - centroid};
}

struct Pose::Layout {
  explicit Layout(const Handles& list, std::shared_ptr<SiteSolver> solver, const Core& core, Memory& memory)
      : handles(list, &memory),
        sites(std::move(solver)),
        reach(core.mesh, handles, memory),
        fields(0, 0, memory),
        weights(memory) {}
  Handles handles;
  std::shared_ptr<SiteSolver> sites;
  Reach reach;
  HandleFields fields;
  ClusterWeights weights;
  std::shared_ptr<const Groups> groups;
  std::shared_ptr<const SmoothSystem> smooth;
  std::shared_ptr<const PaperSystem> paper;
};

Pose::Pose(std::shared_ptr<const Core> core, const PoseOptions& options, std::shared_ptr<const Rest> rest)
    : core_(std::move(core)),
      options_(options),
      rest_(std::move(rest)),
      positions_(memory(), static_cast<std::size_t>(core_->size())),
      turns_(memory(), handle_limit),
      start_(memory()) {}

std::shared_ptr<Pose> Pose::make(std::shared_ptr<const Core> core, const PoseOptions& options) {
  if (!core->factor) fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "poses need a solver made with HF_ENGINE_GREEN");
  if (core->refinements > 0)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "poses need fields that keep to the range of their sites; make a solver with HF_FIELD_HARMONIC for them");
  const PoseOptions filled = checked(options);
  Memory& memory = *core->memory;
  return make_owner_in<Pose>(core->memory, core, filled, make_shared_in<Rest>(memory, *core, memory));
}

std::shared_ptr<Pose> Pose::clone() const {
  auto copy = make_owner_in<Pose>(core_->memory, core_, options_, rest_);
  copy->groups_ = groups_;
  copy->layout_ = layout_, copy->previous_layout_ = previous_layout_;
  if (state_) copy->state_ = make_shared_in<State>(memory(), *state_, memory());
  copy->previous_state_ = previous_state_;
  if (posed_) {
    ensure_surface();
    std::memcpy(copy->positions_.data(), positions_.data(), positions_.size() * sizeof(Vec3));
  }
  copy->posed_ = posed_, copy->report_ = report_;
  return copy;
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
  if (i < 0) fail(HF_ERROR_NO_SUCH_HANDLE, position, "the pose has no handle %u", number);
  return i;
}

void Pose::check_regions(Span<const std::uint32_t> start, Span<const std::int32_t> vertices) const {
  if (start.size() < 2) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "no handle to add");
  const std::size_t added = start.size() - 1;
  if (added + handle_count() > handle_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u handles and %zu more; a pose holds at most %u", handle_count(), added,
         handle_limit);
  Vector<std::int32_t> owner(static_cast<std::size_t>(core_->size()), -1, &memory());  // -2: a handle there is
  if (layout_) {
    for (std::int32_t v = 0; v < core_->size(); ++v) owner[v] = layout_->reach.owner[v] >= 0 ? -2 : -1;
  }
  for (std::size_t r = 0; r < added; ++r) {
    if (start[r + 1] <= start[r]) fail(HF_ERROR_EMPTY, static_cast<std::uint32_t>(r), "region %zu has no vertex", r);
    for (std::uint32_t k = start[r]; k < start[r + 1]; ++k) {
      const std::int32_t v = vertices[k];
      if (v == Mesh::none)
        fail(HF_ERROR_INVALID_ARGUMENT, k, "entry %u of the regions is a vertex without a usable triangle", k);
      if (v < 0 || v >= core_->size())
        fail(HF_ERROR_OUT_OF_RANGE, k, "entry %u of the regions is no vertex of the mesh", k);
      if (owner[v] != -1 && owner[v] != static_cast<std::int32_t>(r))
        fail(HF_ERROR_OVERLAP, k, "entry %u: the vertex belongs to %s already; regions must not overlap", k,
             owner[v] == -2 ? "a handle" : "an earlier region");
      owner[v] = static_cast<std::int32_t>(r);
    }
  }
}

void Pose::add_handles(Span<const std::uint32_t> start, Span<const std::int32_t> vertices,
                       Span<std::uint32_t> out_numbers) {
  check_regions(start, vertices);
  Handles handles(&memory());
  if (layout_) handles.assign(layout_->handles.begin(), layout_->handles.end());
  const std::size_t first = handles.size();
  std::shared_ptr<SiteSolver> sites = layout_ ? layout_->sites->clone() : SiteSolver::make(EngineKind::green, core_, 0);
  NumberPool numbers, slot_numbers;
  Vector<std::uint8_t> slot_taken(static_cast<std::size_t>(sites->slot_count()), 0, &memory());
  for (const Handle& handle : handles) {
    for (const std::int32_t s : handle.region->slots) slot_taken[s] = 1;
  }
  Vector<std::int32_t> slots(&memory());
  Vector<Site> added(&memory());
  for (std::size_t r = 0; r + 1 < start.size(); ++r) {
    std::shared_ptr<HandleRegion> region =
        make_region(*core_, vertices.subspan(start[r], start[r + 1] - start[r]), options_.samples_per_ring, memory());
    for (const std::int32_t v : region->sites) {
      const std::uint32_t slot =
          slot_numbers.take([&](std::uint32_t s) { return s < slot_taken.size() && slot_taken[s]; });
      slots.push_back(static_cast<std::int32_t>(slot)), region->slots.push_back(slots.back());
      added.push_back(Site::at_vertex(core_->mesh, v));
    }
    const std::uint32_t number = numbers.take([&](std::uint32_t candidate) {
      return std::any_of(handles.begin(), handles.end(), [&](const Handle& h) { return h.number == candidate; });
    });
    handles.push_back({number, std::move(region)});
  }
  std::shared_ptr<const Layout> layout = make_layout(handles, std::move(sites), {{}, slots, added});
  std::shared_ptr<State> state = carry_over(*layout);
  previous_layout_ = layout_, previous_state_ = state_;
  install(std::move(layout), std::move(state));
  for (std::size_t r = 0; r < out_numbers.size(); ++r) out_numbers[r] = layout_->handles[first + r].number;
}

void Pose::remove_handles(Span<const std::uint32_t> numbers) {
  if (numbers.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "no handle to remove");
  Vector<std::uint8_t> leaving(handle_count(), 0, &memory());
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    const std::int32_t i = require(numbers[k], k);
    if (leaving[i]) fail(HF_ERROR_NO_SUCH_HANDLE, k, "handle %u is named twice", numbers[k]);
    leaving[i] = 1;
  }
  Handles remaining(&memory());
  Vector<std::int32_t> slots(&memory());
  for (std::size_t i = 0; i < leaving.size(); ++i) {
    const Handle& handle = layout_->handles[i];
    if (!leaving[i]) {
      remaining.push_back(handle);
    } else {
      slots.insert(slots.end(), handle.region->slots.begin(), handle.region->slots.end());
    }
  }
  if (remaining.empty()) {
    previous_layout_.reset(), previous_state_.reset();
    install(nullptr, nullptr);
    return;
  }
  if (restore_previous(remaining)) return;
  std::shared_ptr<SiteSolver> sites = layout_->sites->clone();
  std::shared_ptr<const Layout> layout = make_layout(remaining, std::move(sites), {slots, {}, {}});
  std::shared_ptr<State> state = carry_over(*layout);
  previous_layout_.reset(), previous_state_.reset();
  install(std::move(layout), std::move(state));
}

// The handles left are those before the last were added: back to that layout and solver state, with the transforms as
// they are now.
bool Pose::restore_previous(const Handles& remaining) {
  if (!previous_layout_ || previous_layout_->handles.size() != remaining.size()) return false;
  for (std::size_t i = 0; i < remaining.size(); ++i) {
    if (previous_layout_->handles[i].region != remaining[i].region ||
        previous_layout_->handles[i].number != remaining[i].number)
      return false;
  }
  auto state = make_shared_in<State>(memory(), *previous_state_, memory());
  for (std::size_t i = 0; i < remaining.size(); ++i) {
    const HandleState& now = state_->handles[find(remaining[i].number)];
    HandleState& then = state->handles[i];
    const bool same = std::memcmp(&now.rotation, &then.rotation, sizeof now.rotation) == 0 &&
                      std::memcmp(&now.translation, &then.translation, sizeof now.translation) == 0;
    state->changed = state->changed || !same;
    then.rotation = now.rotation, then.translation = now.translation, then.turn = now.turn;
  }
  std::shared_ptr<const Layout> layout = std::move(previous_layout_);
  previous_layout_.reset(), previous_state_.reset();
  install(std::move(layout), std::move(state));
  return true;
}

void Pose::install(std::shared_ptr<const Layout> layout, std::shared_ptr<State> state) noexcept {
  layout_ = std::move(layout), state_ = std::move(state);
  if (layout_ && layout_->groups) groups_ = layout_->groups;
  if (!layout_) posed_ = false, stale_ = false;
}

// Groups for the components in which handles meet. They need no field: the first time, both are made at once.
std::shared_ptr<const Groups> Pose::meet(const Layout& layout) const {
  Vector<std::int32_t> shared(&memory());
  for (std::int32_t c = 0; c < core_->mesh.component_count(); ++c) {
    if (layout.reach.handles_of(c).size() > 1) shared.push_back(c);
  }
  return Groups::with(groups_, *core_, *rest_, shared, static_cast<std::int32_t>(options_.group_count), memory());
}

std::shared_ptr<const Pose::Layout> Pose::make_layout(const Handles& handles, std::shared_ptr<SiteSolver> sites,
                                                      const SiteEdit& edit) const {
  auto layout = make_shared_in<Layout>(memory(), handles, std::move(sites), *core_, memory());
  const auto solve = [&] {
    if (!edit.remove.empty() || !edit.add.empty()) layout->sites->edit(edit);
    layout->fields = solve_handle_fields(*core_, *layout->sites, layout->handles, layout->reach, memory());
  };
  if (options_.mode != DeformMode::smooth) {
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
  BandOptions bands;
  bands.band_count = static_cast<std::int32_t>(options_.band_count);
  if (options_.mode == DeformMode::paper) bands.degree = 1, bands.spacing = BandSpacing::equal_value;
  layout->weights = make_cluster_weights(*core_, *rest_, layout->reach, layout->fields, bands, memory());
  list_blocks(layout->weights, *core_->jobs);
  if (options_.mode == DeformMode::smooth) {
    layout->smooth = make_shared_in<SmoothSystem>(memory(), *core_, *rest_, layout->weights, *layout->groups,
                                                  layout->fields, memory());
  } else {
    layout->paper = make_shared_in<PaperSystem>(memory(), *core_, layout->weights, memory());
  }
  return layout;
}

// A new handle takes over the rotation the surface has where it stands, so that its way back to rest is predicted like
// any turn.
void Pose::carry_handle(const Handle& handle, HandleState& state) const {
  if (!posed_) return;
  ensure_surface();
  const HandleRegion& region = *handle.region;
  Vector<Vec3> rest(&memory()), posed(&memory());
  for (const std::int32_t v : region.vertices) rest.push_back(core_->mesh.positions[v]), posed.push_back(positions_[v]);
  state.solved = fit_rigid(rest, posed, {}, Quaternion()).rotation;
  state.solved_turn = logarithm(state.solved);
}

std::shared_ptr<Pose::State> Pose::carry_over(const Layout& layout) const {
  auto state = make_shared_in<State>(memory(), memory());
  state->transforms.assign(static_cast<std::size_t>(layout.weights.cluster_count), Affine());
  state->columns.allocate(memory(), column_count(layout.weights));
  for (const Handle& handle : layout.handles) {
    const std::int32_t old = find(handle.number);
    HandleState carried;
    if (old >= 0 && layout_->handles[old].region == handle.region) {
      carried = state_->handles[old];
    } else {
      carry_handle(handle, carried);
    }
    state->handles.push_back(carried);
  }
  state->started = state_ && state_->started;
  if (layout.paper) {
    state->paper.fit(*layout.paper);
    if (posed_) {
      ensure_surface();
      Vector<Vec3> own_unit(&memory());
      own_unit.reserve(positions_.size());
      for (const Vec3& x : positions_) own_unit.push_back(core_->mesh.to_inner(x));
      fit_motions(*layout.paper, core_->mesh, own_unit.data(), state->paper);
    }
    return state;
  }
  if (state_) state->smooth.rotation.assign(state_->smooth.rotation.begin(), state_->smooth.rotation.end());
  state->smooth.fit(*layout.smooth, *layout.groups);
  // components that were rigid so far start from the fields
  Vector<Vec3> turns(&memory());
  for (const HandleState& handle : state->handles) turns.push_back(handle.solved_turn);
  for (const std::int32_t c : layout.weights.elastic_components) {
    const bool was_elastic = layout_ && std::binary_search(layout_->weights.elastic_components.begin(),
                                                           layout_->weights.elastic_components.end(), c);
    if (!was_elastic) start_rotations(*layout.smooth, *layout.groups, c, turns, state->smooth);
  }
  return state;
}

void Pose::check_transform(const HandleTransform& transform, std::uint32_t index, double scale) {
  const Quaternion& q = transform.rotation;
  if (!q.coeffs().allFinite() || !is_finite(transform.translation))
    fail(HF_ERROR_NON_FINITE, index, "transform %u holds a number that is not finite", index);
  if (!(norm(transform.translation) <= largest_translation * scale))
    fail(HF_ERROR_NON_FINITE, index, "the translation of transform %u is beyond %g box diagonals", index,
         largest_translation);
}

void Pose::set_transforms(Span<const std::uint32_t> numbers, Span<const HandleTransform> transforms) {
  if (numbers.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "no transform to set");
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    require(numbers[k], k);
    check_transform(transforms[k], k, core_->mesh.scale);
  }
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    HandleState& handle = state_->handles[find(numbers[k])];
    const Quaternion rotation = normalised(transforms[k].rotation);
    const Vec3 translation = (1.0 / core_->mesh.scale) * transforms[k].translation;
    handle.turn = continued_logarithm(rotation, handle.turn);
    handle.rotation = rotation, handle.translation = translation;
    state_->changed = true;
  }
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

Span<const double> Pose::field(std::uint32_t number) const {
  const std::int32_t handle = require(number, HF_NO_INDEX);  // first: without a handle there is no layout
  return {layout_->fields.of(handle), static_cast<std::size_t>(core_->size())};
}

const ClusterWeights* Pose::weights() const noexcept { return layout_ ? &layout_->weights : nullptr; }

Span<const Affine> Pose::cluster_transforms() const noexcept {
  return state_ ? Span<const Affine>(state_->transforms) : Span<const Affine>();
}

std::int32_t Pose::group_count() const noexcept {
  return layout_ && layout_->smooth ? static_cast<std::int32_t>(layout_->smooth->subspace.group.size()) : 0;
}

std::int32_t Pose::dropped_unknowns() const noexcept {
  return layout_ && layout_->smooth ? layout_->smooth->subspace.factor.dropped() : 0;
}

// ---- the pose ----

void Pose::place_handles() noexcept {
  for (std::size_t i = 0; i < state_->handles.size(); ++i) {
    const HandleState& handle = state_->handles[i];
    const Vec3 centroid = layout_->handles[i].region->centroid;
    const Mat3 r = handle.rotation.toRotationMatrix();
    const Vec3 t = centroid - r * centroid + handle.translation;
    auto& a = state_->transforms[i].a;
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) a[k][j] = r(k, j);
    }
    a[0][3] = t.x, a[1][3] = t.y, a[2][3] = t.z;
  }
}

void Pose::solve_smooth(std::uint32_t iterations) noexcept {
  State& state = *state_;
  const std::size_t count = state.handles.size();
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    turns_[i] = logarithm(state.handles[i].rotation * state.handles[i].solved.conjugate());
    largest = std::max(largest, norm(turns_[i]));
  }
  if (!state.started || largest > jump_turn) {
    for (std::size_t i = 0; i < count; ++i) turns_[i] = state.handles[i].turn;
    start_rotations(*layout_->smooth, *layout_->groups, -1, {turns_.data(), count}, state.smooth);
  } else if (largest > 0) {
    predict_rotations(*layout_->smooth, {turns_.data(), count}, state.smooth);
  }
  for (std::size_t i = 0; i < count; ++i) turns_[i] = state.handles[i].turn;
  set_turn_limit(*layout_->smooth, {turns_.data(), count}, state.smooth);
  for (HandleState& handle : state.handles) handle.solved = handle.rotation, handle.solved_turn = handle.turn;
  report_ = solve_pose(*layout_->smooth, iterations, settled_change, state.smooth, state.transforms.data());
}

void Pose::solve_paper(std::uint32_t iterations) noexcept {
  for (HandleState& handle : state_->handles) handle.solved = handle.rotation, handle.solved_turn = handle.turn;
  report_ = solve_paper_pose(*layout_->paper, core_->mesh, layout_->weights, iterations, settled_change, state_->paper,
                             state_->transforms.data());
}

// Makes what the frame needs beside the pose, all or nothing.
void Pose::prepare(const DeformRequest& request) {
  if (!layout_) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the pose has no handle; add one first");
  check_request(request);
  const std::size_t n = static_cast<std::size_t>(core_->mesh.vertex_count());
  Buffer<NormalSum> sums;
  Buffer<Normal> normals;
  const bool own_normals = request.normals && !request.packed_normals;
  if (request.normals && normal_sums_.size() < n) sums.allocate(memory(), n);
  if (own_normals && normals_.size() < n) normals.allocate(memory(), n);
  if (request.refine) {
    if (core_->refinements > 0)
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "the refinement step needs a solver of the harmonic equation");
    // one that is too small is replaced, so that it can be put back
    const std::int32_t slots = layout_->sites->slot_count();
    const std::shared_ptr<Refinement> refinement = refinement_ && refinement_->has_room(slots)
                                                       ? refinement_
                                                       : make_shared_in<Refinement>(memory(), *core_, memory());
    refinement->fit(slots);
    refinement_ = refinement;
  }
  if (!sums.empty()) normal_sums_ = std::move(sums);
  if (!normals.empty()) normals_ = std::move(normals);
}

struct Pose::Kept {
  std::shared_ptr<State> state;
  Buffer<Vec3> positions;
  std::shared_ptr<Refinement> refinement;
  bool posed = false, stale = false, whole = false;
  SolveReport report;
};

std::shared_ptr<Pose::Kept> Pose::keep(bool whole) {
  auto kept = make_shared_in<Kept>(memory());
  kept->refinement = refinement_, kept->whole = whole;
  if (!whole) return kept;
  kept->positions.allocate(memory(), positions_.size());
  std::memcpy(kept->positions.data(), positions_.data(), positions_.size() * sizeof(Vec3));
  if (state_) {  // the frame works on a copy
    kept->state = make_shared_in<State>(memory(), *state_, memory());
    kept->state.swap(state_);
  }
  kept->posed = posed_, kept->stale = stale_, kept->report = report_;
  return kept;
}

void Pose::put_back(Kept& kept) noexcept {
  refinement_.swap(kept.refinement);
  if (!kept.whole) return;
  state_.swap(kept.state), positions_.swap(kept.positions);
  posed_ = kept.posed, stale_ = kept.stale, report_ = kept.report;
}

void Pose::ensure_surface() const {
  if (!stale_) return;
  blend(core_->mesh, layout_->weights, state_->transforms.data(), state_->columns.data(), core_->mesh.centre,
        core_->mesh.scale, positions_.data(), nullptr, *core_->jobs);
  stale_ = false;
}

Vec3 Pose::blended(std::int32_t vertex) const noexcept {
  return core_->mesh.to_given(blend_vertex(core_->mesh, layout_->weights, state_->transforms.data(), vertex));
}

// Vertices and normals from the transforms.
void Pose::write_surface(const DeformRequest& request, DeformReport& report) {
  const Mesh& mesh = core_->mesh;
  posed_ = true;
  stale_ = !request.surface;
  report.cluster_count = static_cast<std::uint32_t>(layout_->weights.cluster_count);
  report.unreached_vertex_count = static_cast<std::uint32_t>(layout_->weights.unreached_vertex_count);
  report.last_change = state_->last_change;
  if (!request.surface) return;
  const Timer blend_timer;
  float* packed = request.refine ? nullptr : request.packed_positions;
  blend(mesh, layout_->weights, state_->transforms.data(), state_->columns.data(), mesh.centre, mesh.scale,
        positions_.data(), packed, *core_->jobs);
  report.packed_positions = packed != nullptr;
  report.blend_ms = blend_timer.milliseconds();
  if (request.refine) {
    const Timer refine_timer;
    const RefineInput input{*core_,
                            *rest_,
                            layout_->reach,
                            layout_->weights,
                            *layout_->sites,
                            layout_->handles,
                            layout_->groups.get(),
                            layout_->smooth ? &state_->smooth.rotation : nullptr,
                            state_->transforms.data()};
    refinement_->apply(input, positions_.data());
    report.refine_ms = refine_timer.milliseconds();
  }
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
    for (RigidMotion& motion : state.paper.motion) motion = RigidMotion();
    state.started = false, state.changed = true;
  }

  DeformReport report;
  const Timer solve_timer;
  if (state.changed) state.idle_iterations = 0;
  const std::uint32_t idle_limit = layout_->smooth ? idle_limit_smooth : idle_limit_paper;
  if (state.changed || (state.last_change >= settled_change && state.idle_iterations < idle_limit)) {
    const std::uint32_t iterations = request.iteration_count ? request.iteration_count : options_.iteration_count;
    place_handles();
    if (layout_->smooth) {
      solve_smooth(iterations);
    } else {
      solve_paper(iterations);
    }
    report.iteration_count = report_.iterations;
    state.idle_iterations += report_.iterations;
    state.started = true, state.changed = false, state.last_change = report_.last_change;
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
    start_.motion.assign(state_->paper.motion.begin(), state_->paper.motion.end());
    start_.own_unit.resize(core_->size());
  }
}

void Pose::take_start(Span<const Vec3> surface) noexcept {
  if (layout_->smooth) return start_.fit(*core_, *rest_, surface);
  for (std::size_t v = 0; v < surface.size(); ++v) start_.own_unit[v] = core_->mesh.to_inner(surface[v]);
  // of equal fits the one nearest to rest: the last frame must not show
  std::fill(state_->paper.motion.begin(), state_->paper.motion.end(), RigidMotion());
  fit_motions(*layout_->paper, core_->mesh, start_.own_unit.data(), state_->paper);
  std::copy(state_->paper.motion.begin(), state_->paper.motion.end(), start_.motion.begin());
}

DeformReport Pose::deform_from(const Pose& start, Span<const Vec3> turns, const DeformRequest& request) {
  prepare(request);
  State& state = *state_;
  DeformReport report;
  const Timer solve_timer;
  const std::uint32_t iterations = request.iteration_count ? request.iteration_count : options_.iteration_count;
  place_handles();
  if (layout_->smooth) {
    std::copy(start.start_.rotation.begin(), start.start_.rotation.end(), state.smooth.rotation.begin());
    std::fill(state.smooth.stress.begin(), state.smooth.stress.end(), Stress());
    predict_rotations(*layout_->smooth, turns, state.smooth);
    state.smooth.turn_limit = SmoothState::no_turn_limit;  // the start is close enough
    report_ = solve_pose(*layout_->smooth, iterations, settled_change, state.smooth, state.transforms.data());
  } else {
    std::copy(start.start_.motion.begin(), start.start_.motion.end(), state.paper.motion.begin());
    report_ = solve_paper_pose(*layout_->paper, core_->mesh, layout_->weights, iterations, settled_change, state.paper,
                               state.transforms.data());
  }
  report.iteration_count = report_.iterations;
  state.started = true, state.changed = true, state.last_change = report_.last_change;
  report.solve_ms = solve_timer.milliseconds();
  write_surface(request, report);
  return report;
}

}  // namespace hf_inner
