#include "deform/pose_stack.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_pool.h"
#include "base/timer.h"
#include "deform/normals.h"

namespace hf_inner::deform {
PoseStack::PoseStack(std::shared_ptr<const surface::Core> core, std::shared_ptr<Pose> base)
    : core_(std::move(core)), base_(std::move(base)), entries_(core_->memory.get()) {}

std::shared_ptr<PoseStack> PoseStack::make(std::shared_ptr<const surface::Core> core, const PoseOptions& options) {
  std::shared_ptr<Pose> base = Pose::make(core, options);
  return make_owner_in<PoseStack>(core->memory, core, std::move(base));
}

std::shared_ptr<PoseStack> PoseStack::clone() const {
  auto copy = make_owner_in<PoseStack>(core_->memory, core_, base_->clone());
  copy->entries_.assign(entries_.begin(), entries_.end());
  for (std::uint32_t k = 1; k < layer_limit; ++k) {
    if (layers_[k]) copy->layers_[k] = make_layer(layers_[k]->plain->clone());
  }
  copy->rigid_scratch_.allocate(memory(), rigid_scratch_.size());
  copy->rigid_ = rigid_;
  return copy;
}

void PoseStack::move_to(std::shared_ptr<const surface::Core> core) {
  const std::shared_ptr<const Rest> rest = base_->rest_on(*core);
  std::shared_ptr<Pose> base = base_->on(core, rest);
  std::array<std::shared_ptr<Layer>, layer_limit> layers;
  for (std::uint32_t k = 1; k < layer_limit; ++k) {
    if (layers_[k]) layers[k] = make_layer(layers_[k]->plain->on(core, rest));
  }
  base_ = std::move(base);
  layers_ = std::move(layers);
  core_ = std::move(core);
  mark_stale(0);
}

bool PoseStack::has_layers() const noexcept {
  return std::any_of(layers_.begin(), layers_.end(), [](const auto& layer) { return layer != nullptr; });
}

std::int32_t PoseStack::require(std::uint32_t number, std::uint32_t position) const {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].number == number) return static_cast<std::int32_t>(i);
  }
  fail(HF_ERROR_NOT_FOUND, position, "the pose has no handle %u", number);
}

Span<const std::int32_t> PoseStack::region_of(const Entry& entry) const {
  const Pose& pose = entry.layer == 0 ? *base_ : *layers_[entry.layer]->plain;
  return pose.region(entry.inner[entry.layer]);
}

void PoseStack::mark_stale(std::uint32_t layer) noexcept {
  if (layer == 0) base_stale_ = true;
  for (std::uint32_t k = std::max(layer, 1u); k < layer_limit; ++k) {
    if (!layers_[k]) continue;
    layers_[k]->edited_stale = true;
    if (k > layer) layers_[k]->plain_stale = true;
  }
}

// ---- handles ----

std::shared_ptr<Pose> PoseStack::make_plain(Vector<Entry>& entries, std::uint32_t k) const {
  std::shared_ptr<Pose> plain = base_->without_handles();
  Vector<std::uint32_t> start(1, 0u, &memory());
  Vector<std::int32_t> vertices(&memory());
  for (const Entry& entry : entries_) {
    if (entry.layer > k) continue;
    const Span<const std::int32_t> region = region_of(entry);
    vertices.insert(vertices.end(), region.begin(), region.end());
    start.push_back(static_cast<std::uint32_t>(vertices.size()));
  }
  Vector<std::uint32_t> numbers(start.size() - 1, 0u, &memory());
  if (numbers.empty()) return plain;
  plain->add_handles(start, vertices, numbers);
  std::size_t at = 0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].layer <= k) entries[i].inner[k] = numbers[at++];
  }
  return plain;
}

std::shared_ptr<PoseStack::Layer> PoseStack::make_layer(std::shared_ptr<Pose> plain) const {
  auto layer = make_shared_in<Layer>(memory(), memory());
  layer->plain = std::move(plain);
  layer->edited = layer->plain->clone();
  layer->plain->prepare_start();
  layer->surface.allocate(memory(), static_cast<std::size_t>(core_->size()));
  layer->relative.assign(static_cast<std::size_t>(layer->plain->weights()->cluster_count), Quaternion());
  layer->turns.assign(layer->plain->handle_count(), Vec3());
  layer->zeros.assign(layer->plain->handle_count(), Vec3());
  return layer;
}

void PoseStack::add_handles(Span<const std::uint32_t> start, Span<const std::int32_t> vertices, std::uint32_t layer,
                            Span<std::uint32_t> out_numbers, const HandleKind& kind) {
  Vector<std::uint32_t> whole_start(&memory());
  Vector<std::int32_t> whole(&memory());
  if (rigid_) {
    take_whole_pieces(start, vertices, whole_start, whole);
    start = whole_start;
    vertices = whole;
  }
  if (layer >= layer_limit)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "layer is %u; it must be 0 to %u", layer, layer_limit - 1);
  const std::size_t added = start.size() < 2 ? 0 : start.size() - 1, first = entries_.size();
  check_region_count(first, added, "handle");
  Vector<Entry> entries(&memory());
  entries.assign(entries_.begin(), entries_.end());
  NumberPool numbers;
  for (std::size_t r = 0; r < added; ++r) {
    const std::uint32_t number = numbers.take([&](std::uint32_t candidate) {
      return std::any_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.number == candidate; });
    });
    entries.push_back({});
    entries.back().number = number;
    entries.back().layer = layer;
    entries.back().free_turn = kind.free_turn;
  }
  Vector<std::uint32_t> inner(added, 0u, &memory());
  const auto enter = [&](Pose& pose, std::uint32_t k) {
    pose.add_handles(start, vertices, inner, {kind.in_place && k == 0, kind.free_turn && k == layer});
    for (std::size_t r = 0; r < added; ++r) {
      entries[first + r].inner[k] = inner[r];
      entries[first + r].centroid = pose.handle(inner[r]).centroid;
    }
  };
  // The new handles' layer and all layers above it get the handles, on copies. If the handles' layer does not exist
  // yet, it is created.
  std::array<std::shared_ptr<Layer>, layer_limit> layers = layers_;
  for (std::uint32_t k = std::max(layer, 1u); k < layer_limit; ++k) {
    if (!layers_[k] && k != layer) continue;
    std::shared_ptr<Pose> plain = layers_[k] ? layers_[k]->plain->clone() : make_plain(entries, k);
    enter(*plain, k);
    layers[k] = make_layer(std::move(plain));
  }
  if (layer == 0) enter(*base_, 0);  // changes all or nothing; the lines below cannot fail
  for (std::size_t r = 0; layer == 0 && r < added; ++r) {
    Entry& entry = entries[first + r];
    entry.edit = base_->transform(entry.inner[0]);
    entry.turn = logarithm(entry.edit.rotation);
    entry.placed = motion_of(entry.edit, entry.centroid);
  }
  entries_ = std::move(entries);
  layers_ = std::move(layers);
  mark_stale(layer);
  for (std::size_t r = 0; r < out_numbers.size(); ++r) out_numbers[r] = entries_[first + r].number;
}

void PoseStack::remove_handles(Span<const std::uint32_t> numbers) {
  Vector<std::uint8_t> leaving(entries_.size(), 0, &memory());
  std::uint32_t lowest = layer_limit;
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    const std::int32_t i = require(numbers[k], k);
    if (leaving[i]) fail(HF_ERROR_NOT_FOUND, k, "handle %u is named twice", numbers[k]);
    leaving[i] = 1;
    lowest = std::min(lowest, entries_[i].layer);
  }
  Vector<Entry> entries(&memory());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!leaving[i]) entries.push_back(entries_[i]);
  }
  Vector<std::uint32_t> inner(&memory());
  const auto collect = [&](std::uint32_t k) {
    inner.clear();
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (leaving[i] && entries_[i].layer <= k) inner.push_back(entries_[i].inner[k]);
    }
    return !inner.empty();
  };
  std::array<std::shared_ptr<Layer>, layer_limit> layers = layers_;
  for (std::uint32_t k = 1; k < layer_limit; ++k) {
    if (!layers_[k] || !collect(k)) continue;
    layers[k].reset();
    if (std::none_of(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.layer == k; })) continue;
    std::shared_ptr<Pose> plain = layers_[k]->plain->clone();
    plain->remove_handles(inner);
    layers[k] = make_layer(std::move(plain));
  }
  if (collect(0)) base_->remove_handles(inner);  // changes all or nothing; the lines below cannot fail
  entries_ = std::move(entries);
  layers_ = std::move(layers);
  take_base_turns();
  mark_stale(lowest);
}

void PoseStack::set_transforms(Span<const std::uint32_t> numbers, Span<const HandleTransform> transforms) {
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    require(numbers[k], k);
    Pose::check_transform(transforms[k], k, core_->mesh.scale);
  }
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    Entry& entry = entries_[require(numbers[k], k)];
    const Quaternion rotation = entry.free_turn ? entry.edit.rotation : normalised(transforms[k].rotation);
    entry.edit = {rotation, transforms[k].translation};
    entry.turn = continued_logarithm(rotation, entry.turn);
    if (entry.layer == 0) {
      entry.placed = motion_of(entry.edit, entry.centroid);
      base_->set_transforms({&entry.inner[0], 1}, {&entry.edit, 1});
    }
    mark_stale(entry.layer);
  }
}

std::uint32_t PoseStack::layer_of(std::uint32_t number) const { return entries_[require(number, HF_NO_INDEX)].layer; }

HandleReport PoseStack::handle(std::uint32_t number) const {
  const Entry& entry = entries_[require(number, HF_NO_INDEX)];
  return (entry.layer == 0 ? *base_ : *layers_[entry.layer]->plain).handle(entry.inner[entry.layer]);
}

HandleReport PoseStack::handle_at(std::uint32_t number, std::uint32_t index) const {
  require(number, index);
  return handle(number);
}

FieldColumn<const double> PoseStack::field(std::uint32_t number) const {
  const Entry& entry = entries_[require(number, HF_NO_INDEX)];
  return (entry.layer == 0 ? *base_ : *layers_[entry.layer]->plain).field(entry.inner[entry.layer]);
}

HandleTransform PoseStack::placed(std::uint32_t number) const {
  const Entry& entry = entries_[require(number, HF_NO_INDEX)];
  return transform_of(entry.placed, entry.centroid);
}

// ---- the pose ----

bool PoseStack::update(std::uint32_t k, Span<const Vec3> below, bool below_changed, const DeformRequest& request) {
  Layer& layer = *layers_[k];
  layer.plain_stale = layer.plain_stale || below_changed;
  layer.edited_stale = layer.edited_stale || layer.plain_stale;
  layer.report = DeformReport();
  if (!layer.edited_stale) return false;
  DeformRequest own = request;
  own.normals = false;
  own.restart = false;
  own.surface = true;
  own.packed_positions = nullptr;
  own.refine_from_last = false;  // X_k depends only on the layers below it
  if (own.iteration_count == 0) own.iteration_count = base_->options().iteration_count;
  own.iteration_count = std::max(own.iteration_count, least_layer_iterations);

  const Timer place_timer;
  for (Entry& entry : entries_) {
    if (entry.layer > k) continue;
    const std::uint32_t inner = entry.inner[k];
    RigidMotion found = entry.placed;
    Vec3& turn = layer.turns[layer.plain->position_of(inner)];
    turn = Vec3();
    if (entry.layer == k) {
      found = fit_region(entry, layer.plain->region(inner), below.data());
      if (entry.free_turn) entry.edit.rotation = Quaternion();
      if (entry.free_turn) entry.turn = Vec3();
      const RigidMotion edit = motion_of(entry.edit, entry.centroid);
      entry.placed = {normalised(found.rotation * edit.rotation),
                      rotate(found.rotation, edit.translation) + found.translation};
      const bool at_rest = norm(entry.turn) == 0 && norm(entry.edit.translation) == 0;
      if (at_rest) entry.placed = found;  // gives the unedited and the edited pose the same bits
      turn = rotate(found.rotation, entry.turn);
    }
    const HandleTransform unedited = transform_of(found, entry.centroid),
                          edited = transform_of(entry.placed, entry.centroid);
    if (layer.plain_stale) layer.plain->set_transforms({&inner, 1}, {&unedited, 1});
    layer.edited->set_transforms({&inner, 1}, {&edited, 1});
  }
  if (layer.plain_stale) layer.plain->take_start(below);
  const double place_ms = place_timer.milliseconds();
  DeformReport unedited;
  if (layer.plain_stale) unedited = layer.plain->deform_from(*layer.plain, layer.zeros, own);
  layer.report = layer.edited->deform_from(*layer.plain, layer.turns, own);
  take_turns(k);
  const Timer combine_timer;
  combine(layer, below);
  layer.report.solve_ms += unedited.solve_ms + place_ms;
  layer.report.blend_ms += unedited.blend_ms + combine_timer.milliseconds();
  layer.report.refine_ms += unedited.refine_ms;
  layer.report.iteration_count += unedited.iteration_count;
  layer.plain_stale = layer.edited_stale = false;
  return true;
}

// Computes the layer's surface X = E + q (X_below - U). U is the pose without and E with the edits of this layer's
// handles. q is the blended rotation from U to E (pose_stack.h).
void PoseStack::combine(Layer& layer, Span<const Vec3> below) noexcept {
  const Span<const Affine> from = layer.plain->cluster_transforms(), to = layer.edited->cluster_transforms();
  for (std::size_t c = 0; c < from.size(); ++c) {
    const Quaternion unedited = best_rotation(linear_part(from[c]), Quaternion()),
                     edited = best_rotation(linear_part(to[c]), unedited);
    layer.relative[c] = edited * unedited.conjugate();
  }
  const ClusterWeights& weights = *layer.plain->weights();
  const Span<const Vec3> plain = layer.plain->surface(), edited = layer.edited->surface();
  for_vertex_pieces(*core_->jobs, core_->size(), [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t v = first; v < last; ++v) {
      const Quaternion turn = blended_rotation(weights, layer.relative, v);
      layer.surface[v] = edited[v] + rotate(turn, below[v] - plain[v]);
    }
  });
  if (rigid_) rigid_->make_rigid(layer.surface.data(), rigid_scratch_.data());
}

DeformReport PoseStack::deform(const DeformRequest& request) {
  check_request(request);
  if (entries_.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the pose has no handle; add one first");
  if (request.refine == 0) return deform_all(request);
  // the full-mesh step takes memory after poses were solved: they are put back when there is none
  Vector<Entry> entries(entries_, &memory());
  Vector<std::pair<Pose*, std::shared_ptr<Pose::Kept>>> kept(&memory());
  kept.reserve(2 * layer_limit);
  try {
    kept.push_back({base_.get(), base_->keep(true)});
    for (const auto& layer : layers_) {
      if (!layer) continue;
      for (Pose* const pose : {layer->plain.get(), layer->edited.get()}) kept.push_back({pose, pose->keep(false)});
    }
    return deform_all(request);
  } catch (...) {
    for (auto& pose : kept) pose.first->put_back(*pose.second);
    std::copy(entries.begin(), entries.end(), entries_.begin());
    mark_stale(0);  // the layers follow from the layers below them
    for (const auto& layer : layers_)
      if (layer) layer->plain_stale = true;
    throw;
  }
}

// Allocates before it changes anything. Only the full-mesh step allocates later.
DeformReport PoseStack::deform_all(const DeformRequest& request) {
  if (!has_layers()) {
    base_stale_ = true;  // layers that are added later must not reuse old poses
    const DeformReport report = base_->deform(request);
    take_base_turns();
    return report;
  }
  const std::size_t n = static_cast<std::size_t>(core_->size());
  Buffer<NormalSum> sums;
  Buffer<Normal> own_normals;
  Buffer<Vec3> rest;
  if (request.normals && normal_sums_.empty()) sums.allocate(memory(), n);
  if (request.normals && !request.packed_normals && normals_.empty()) own_normals.allocate(memory(), n);
  if (base_->handle_count() == 0 && rest_.empty()) {
    rest.allocate(memory(), n);
    for (std::size_t v = 0; v < n; ++v) rest[v] = core_->mesh.to_given(core_->mesh.positions[v]);
  }
  if (!sums.empty()) normal_sums_ = std::move(sums);
  if (!own_normals.empty()) normals_ = std::move(own_normals);
  if (!rest.empty()) rest_ = std::move(rest);
  if (request.restart) {
    for (Entry& entry : entries_) entry.turn = logarithm(entry.edit.rotation);
  }
  DeformReport report;
  Span<const Vec3> surface;
  bool changed = base_stale_ || request.restart || request.refine != refined_ || request.refine_from_last != followed_;
  if (base_->handle_count() > 0) {
    DeformRequest own = request;
    own.normals = false;
    own.surface = true;
    own.packed_positions = nullptr;
    report = base_->deform(own);
    take_base_turns();
    surface = report.positions;
    changed = changed || report.iteration_count > 0 || request.refine_from_last;
  } else {
    surface = {rest_.data(), n};
  }
  for (std::uint32_t k = 1; k < layer_limit; ++k) {
    if (!layers_[k]) continue;
    changed = update(k, surface, changed, request) || changed;
    const DeformReport& own = layers_[k]->report;
    report.iteration_count += own.iteration_count;
    report.solve_ms += own.solve_ms;
    report.blend_ms += own.blend_ms;
    report.refine_ms += own.refine_ms;
    report.last_change = std::max(report.last_change, own.last_change);
    report.cluster_count = static_cast<std::uint32_t>(layers_[k]->plain->weights()->cluster_count);
    report.unreached_vertex_count = static_cast<std::uint32_t>(layers_[k]->plain->weights()->unreached_vertex_count);
    surface = {layers_[k]->surface.data(), n};
  }
  base_stale_ = false;
  refined_ = request.refine;
  followed_ = request.refine_from_last;
  report.positions = surface;
  report.normals = {};
  if (request.normals) {
    const Timer normal_timer;
    Normal* normals = request.packed_normals ? request.packed_normals : normals_.data();
    vertex_normals(core_->mesh, base_->rest(), surface.data(), normal_sums_.data(), normals, *core_->jobs);
    report.normals = {normals, n};
    report.normal_ms = normal_timer.milliseconds();
  }
  return report;
}

}  // namespace hf_inner::deform
