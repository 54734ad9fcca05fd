// See transfer.h.
#include "transfer/transfer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/index.h"
#include "base/number_pool.h"
#include "base/progress.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"
#include "transfer/thin_parts.h"

namespace hf_inner::transfer {
namespace {

constexpr std::uint32_t known_flags = HF_PAIR_ANCHOR | HF_PAIR_FOOT | HF_PAIR_TRUNK | HF_PAIR_NO_ALIGNMENT |
                                      HF_PAIR_CONTACT | HF_PAIR_SINKS | HF_PAIR_NECK | HF_PAIR_TAIL | HF_PAIR_ARM;

Vec3 area_mean(const mesh::Mesh& mesh, const Vector<double>& area) noexcept {
  Vec3 sum;
  for (std::size_t v = 0; v < area.size(); ++v) sum = sum + area[v] * mesh.positions[v];
  return sum;
}

void check_options(const TransferOptions& options) {
  if (options.mode != HF_TRANSFER_FIELDS && options.mode != HF_TRANSFER_STRETCH)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "mode is %d; use HF_TRANSFER_FIELDS or HF_TRANSFER_STRETCH",
         options.mode);
  if (options.scheme && options.mode != HF_TRANSFER_FIELDS)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "mode is %d; a baseline of transfers takes HF_TRANSFER_FIELDS",
         options.mode);
  if (options.cluster_count > cluster_limit)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "cluster_count is %u; it must be 1 to %u, or 0 for the default",
         options.cluster_count, cluster_limit);
  // the ABI gives floats, so the bounds are compared as floats
  const auto width = static_cast<float>(options.kernel_width);
  if (width != 0 &&
      !(width >= static_cast<float>(least_kernel_width) && width <= static_cast<float>(most_kernel_width)))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "kernel_width is %g; it must be %g to %g, or 0 for the default",
         options.kernel_width, least_kernel_width, most_kernel_width);
  if (options.scale != 0 && !(options.scale >= least_scale && options.scale <= most_scale))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "scale is %g; it must be %g to %g, or 0 for the ratio of the legs",
         options.scale, least_scale, most_scale);
  if (!std::isfinite(options.alignment_angle))
    fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "alignment_angle is not a finite number");
}

// A core whose rest positions are others. Fields, and all that follows from edges, still come from the surface as made.
std::shared_ptr<const surface::Core> with_rest(const std::shared_ptr<const surface::Core>& core, Span<const Vec3> rest,
                                               const char* side) {
  if (rest.empty()) return core;
  const surface::Geometry& from = *core->geometry;
  Vector<Vec3> positions(rest.size(), core->memory.get());
  for (std::size_t v = 0; v < rest.size(); ++v) {
    if (!is_finite(rest[v])) {
      const auto given = static_cast<std::uint32_t>(from.mesh.given_of_inner[v]);
      fail(HF_ERROR_NON_FINITE, given, "vertex %u of the %s's rest pose is not finite", given, side);
    }
    positions[v] = from.mesh.to_inner(rest[v]);
    if (mesh::is_too_far(positions[v])) {
      const std::uint32_t given = mesh::given_vertex(from.mesh, static_cast<std::int32_t>(v));
      fail(HF_ERROR_TOO_LARGE, given, "vertex %u of the %s's rest pose is more than %g box diagonals from the surface",
           given, side, mesh::farthest_pose);
    }
  }
  return make_shared_in<surface::Core>(*core->memory, surface::Geometry::moved(from, positions));
}

}  // namespace

Transfer::Transfer(std::shared_ptr<const surface::Core> source, std::shared_ptr<const surface::Core> target,
                   const TransferOptions& options)
    : source_core_(with_rest(source, options.source_rest, "source")),
      target_core_(with_rest(target, options.target_rest, "target")),
      target_factor_(target),
      options_(options),
      source_axes_(checked_axes(options.source_axes, "source")),
      target_axes_(checked_axes(options.target_axes, "target")),
      axes_(Mat3(target_axes_.transpose() * source_axes_)),
      source_(std::move(source)),
      target_(std::move(target)),
      numbers_(target_core_->memory.get()),
      flags_(target_core_->memory.get()),
      source_area_(area_shares(source_core_->mesh, *target_core_->memory)),
      target_area_(area_shares(target_core_->mesh, *target_core_->memory)),
      thin_(target_core_->memory.get()) {
  check_options(options);
  options_.source_rest = options_.target_rest = {};
  if (options_.alignment_angle == 0) options_.alignment_angle = default_alignment_angle;
}

Transfer::~Transfer() = default;

void Transfer::add_pairs(Span<const PairInput> pairs, std::uint32_t* out_pairs, bool prepare_now) {
  Memory& memory = *target_core_->memory;
  deform::check_region_count(numbers_.size(), pairs.size(), "pair");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].flags & ~known_flags)
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(i),
           "pair %zu has flags that are none of HF_PAIR_*: %u", i, pairs[i].flags);
  }
  // New pairs of regions get the smallest free numbers.
  Vector<std::uint32_t> fresh_numbers(&memory), numbers(numbers_, &memory), flags(flags_, &memory);
  Vector<Span<const std::int32_t>> source_regions(&memory), target_regions(&memory);
  NumberPool pool;
  for (const PairInput& pair : pairs) {
    const std::uint32_t next = pool.take([&](std::uint32_t number) { return source_.in_use(number); });
    if (flags.size() <= next) flags.resize(next + 1, 0u);
    flags[next] = pair.flags;
    numbers.push_back(next);
    fresh_numbers.push_back(next);
    source_regions.push_back(pair.source);
    target_regions.push_back(pair.target);
  }
  std::sort(numbers.begin(), numbers.end());
  PairFields source(source_), target(target_);
  source.add({fresh_numbers.data(), fresh_numbers.size()}, {source_regions.data(), source_regions.size()}, "source");
  target.add({fresh_numbers.data(), fresh_numbers.size()}, {target_regions.data(), target_regions.size()}, "target");

  std::shared_ptr<Prepared> before = std::move(prepared_);
  const auto swap_pairs = [&]() noexcept {
    std::swap(source_, source);
    std::swap(target_, target);
    numbers_.swap(numbers);
    flags_.swap(flags);
  };
  swap_pairs();
  prepared_.reset();
  if (prepare_now) {
    try {
      prepare();
    } catch (...) {
      swap_pairs();
      prepared_ = std::move(before);
      throw;
    }
  }
  if (out_pairs) std::copy(fresh_numbers.begin(), fresh_numbers.end(), out_pairs);
}

void Transfer::remove_pairs(Span<const std::uint32_t> pairs) {
  Memory& memory = *target_core_->memory;
  Vector<std::uint32_t> numbers(numbers_, &memory);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto found = std::lower_bound(numbers.begin(), numbers.end(), pairs[i]);
    if (found == numbers.end() || *found != pairs[i])
      fail(HF_ERROR_NOT_FOUND, static_cast<std::uint32_t>(i), "entry %zu: the transfer has no pair %u", i, pairs[i]);
    numbers.erase(found);
  }
  PairFields source(source_), target(target_);
  source.remove(pairs);
  target.remove(pairs);
  source_ = std::move(source);
  target_ = std::move(target);
  numbers_.swap(numbers);
  prepared_.reset();
}

// Finds the rest directions of the limbs on both bodies, and turns the target's limb where they differ too much. Sets
// each cluster's part of that turn. Also finds scale and ground heights.
void Transfer::prepare_alignment(Prepared& p) const {
  const std::size_t width = numbers_.size();
  const RestSide source{
      &source_core_->mesh, {p.source_field.data(), p.source_field.size()}, source_area_, source_axes_};
  const RestSide target{
      &target_core_->mesh, {p.target_field.data(), p.target_field.size()}, target_area_, target_axes_};
  p.limb_angle.assign(width, -1.0);
  p.aligned.assign(width, 0.0);
  p.limb_turn.assign(width, deform::Quaternion());
  Vector<std::int32_t> feet(target_core_->memory.get());
  for (std::size_t h = 0; h < width; ++h) {
    const std::uint32_t number = numbers_[h], flags = flags_[number];
    const auto column = static_cast<std::int32_t>(h);
    if (flags & HF_PAIR_FOOT) feet.push_back(column);
    if (flags & HF_PAIR_TRUNK) continue;
    poll();
    Vec3 from, to;
    const bool known =
        limb_direction(source, column, region_mean(source_.region(number), source.mesh->positions.data()), to) &&
        limb_direction(target, column, region_mean(target_.region(number), target.mesh->positions.data()), from);
    if (!known || norm(from) < shortest_limb || norm(to) < shortest_limb) continue;
    to = deform::rotate(axes_, to);
    const Vec3 right{target_axes_(0, 0), target_axes_(0, 1), target_axes_(0, 2)};
    p.limb_turn[h] = minimal_rotation(from, to, right);
    p.limb_angle[h] = deform::angle_between(p.limb_turn[h], deform::Quaternion());
    if (has_kernels() && options_.alignment_angle > 0 && !(flags & HF_PAIR_NO_ALIGNMENT))
      p.aligned[h] =
          smooth_step(align_from * options_.alignment_angle, align_to * options_.alignment_angle, p.limb_angle[h]);
  }

  p.confidence.assign(width, 0.0);
  Vector<double> owned(width, 0.0, target_core_->memory.get());
  p.cluster_turn.assign(at(p.clusters.count), deform::Quaternion());
  for (std::int32_t c = 0; c < p.clusters.count; ++c) {
    const double* centre = p.clusters.centre.data() + at(c) * width;
    const auto h = static_cast<std::size_t>(std::max_element(centre, centre + width) - centre);
    owned[h] += 1;
    if (p.clusters.support[at(c)] >= enough_support) p.confidence[h] += 1;
    if (p.aligned[h] > 0)
      p.cluster_turn[at(c)] =
          power(p.limb_turn[h], p.aligned[h] * std::clamp((centre[h] - fade_from) / fade_width, 0.0, 1.0));
  }
  for (std::size_t h = 0; h < width; ++h) p.confidence[h] = owned[h] > 0 ? p.confidence[h] / owned[h] : 0.0;

  const auto ground = [&](const RestSide& side, const auto& regions) {
    double lows[2] = {no_height, no_height};  // feet, trunk
    for (const std::uint32_t number : numbers_) {
      const std::uint32_t flags = flags_[number];
      if (!(flags & (HF_PAIR_FOOT | HF_PAIR_TRUNK | HF_PAIR_NECK))) continue;
      double& low = lows[flags & HF_PAIR_FOOT ? 0 : 1];
      low = std::min(low, lowest(regions.region(number), side.mesh->positions.data(), side.up()));
    }
    return ground_height(side, lows[0], lows[1]);
  };
  p.source_ground = ground(source, source_);
  p.target_ground = ground(target, target_);
  p.scale = 1;
  if (options_.scale > 0) {
    p.scale = options_.scale * source_core_->mesh.scale / target_core_->mesh.scale;
  } else if (!feet.empty()) {
    const double of_source = leg_length(source, {feet.data(), feet.size()}, p.source_ground),
                 of_target = leg_length(target, {feet.data(), feet.size()}, p.target_ground);
    if (of_source > least_leg && of_target > least_leg) p.scale = of_target / of_source;
  }
}

void Transfer::prepare_anchors(Prepared& p) const {
  Vector<Span<const std::int32_t>> regions(target_core_->memory.get());
  bool holds_trunk = false;
  Vector<Span<const std::int32_t>> loose(target_core_->memory.get());
  for (const std::uint32_t number : numbers_) {
    Prepared::Anchor anchor;
    anchor.number = number;
    anchor.flags = flags_[number];
    anchor.is_foot = (flags_[number] & HF_PAIR_FOOT) != 0;
    anchor.source_rest = region_mean(source_.region(number), source_core_->mesh.positions.data());
    anchor.target_rest = region_mean(target_.region(number), target_core_->mesh.positions.data());
    const bool anchored = (flags_[number] & (HF_PAIR_ANCHOR | HF_PAIR_FOOT)) != 0;
    (anchored ? p.anchors : p.loose).push_back(anchor);
    (anchored ? regions : loose).push_back(target_.region(number));
    if (!anchored) continue;
    holds_trunk = holds_trunk || (flags_[number] & HF_PAIR_TRUNK);
  }
  TranslationOptions options;
  if (options_.scheme) options.spread_share = 0;
  // If the feet were the only anchors, the trunk would float. So the body's centroid gets more weight then.
  options.root = p.anchors.empty() ? root_alone : holds_trunk ? root_with_trunk : root_without_trunk;
  p.translations.prepare(*target_core_, target_area_, p.clusters, {regions.data(), regions.size()},
                         {loose.data(), loose.size()}, options);
  p.holds.reserve(numbers_.size());
  p.given_hold.assign(numbers_.size() + 1, Hold());
  for (std::size_t k = 0; k < p.anchors.size(); ++k) p.anchors[k].cluster = p.translations.heaviest(k);

  // Finds the vertices that are raised with the region of a pair, because they blend from the same clusters.
  p.rides.assign(at(target_core_->size()), -1);
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    poll();
    const std::size_t row = i < p.anchors.size() ? i : i + 1;
    for (std::size_t v = 0; v < p.rides.size(); ++v) {
      double share = 0;
      for (std::size_t k = v * blend_count; k < (v + 1) * blend_count; ++k)
        if (p.translations.row_weight(row, p.clusters.joint[k]) > region_cluster_share)
          share += static_cast<double>(p.clusters.weight[k]);
      if (share > region_vertex_share) p.rides[v] = static_cast<std::int32_t>(row);
    }
  }
}

// Finds the vertices that may sink: limbs that the caller names, thin tails, thin parts that no pair moves, and what
// hangs below the feet at rest. Feet never do by themselves. Nor do thin parts around a region that stands or touches,
// such as fingers, but what a hand holds does.
void Transfer::find_sinking(Prepared& p) {
  const std::size_t width = numbers_.size(), n = at(target_core_->size());
  const surface::Geometry& geometry = target_factor_->geometry->unlinked();
  Memory& memory = *target_core_->memory;
  if (thin_.empty()) thin_ = thin_vertices(geometry, memory, *target_core_->jobs);
  const Vector<std::uint8_t> idle = idle_vertices(geometry, p.target_field.data(), width, memory);
  Vector<std::uint8_t> reached(at(geometry.mesh.component_count()), std::uint8_t{0}, &memory);
  for (const std::uint32_t number : numbers_)
    for (const std::int32_t v : target_.region(number)) reached[at(geometry.mesh.component[at(v)])] = 1;
  constexpr std::uint32_t leading = HF_PAIR_ANCHOR | HF_PAIR_TRUNK | HF_PAIR_CONTACT;
  p.sinks.assign(n, std::uint8_t{0});
  for (std::size_t v = 0; v < n; ++v) {
    const double* row = p.target_field.data() + v * width;
    const auto h = static_cast<std::size_t>(std::max_element(row, row + width) - row);
    const std::uint32_t flags = flags_[numbers_[h]];
    const bool around = row[h] > handle_share && reached[at(geometry.mesh.component[v])];
    const bool leads = (flags & HF_PAIR_FOOT) || ((flags & leading) && around);
    p.sinks[v] = (flags & HF_PAIR_SINKS) ||
                 dot(up_of(target_axes_), target_core_->mesh.positions[v]) < p.target_ground ||
                 (thin_[v] && !leads && (idle[v] || ((flags & HF_PAIR_TAIL) && row[h] > limb_window.low)));
  }
}

// Finds the cluster of each source vertex, and the lowest rest height of each cluster.
void Transfer::prepare_ground(Prepared& p) const {
  const std::size_t width = numbers_.size(), count = at(p.clusters.count);
  const mesh::Mesh& mesh = source_core_->mesh;
  p.source_owner.assign(mesh.positions.size(), 0);
  p.rest_lows.assign(count, no_height);
  p.source_lows.assign(count, 0.0);
  p.target_lows.assign(count, 0.0);
  p.touch.assign(count, 0.0);
  target_core_->jobs->for_each(static_cast<std::uint32_t>((mesh.positions.size() + owner_block - 1) / owner_block),
                               [&](std::uint32_t b) {
                                 for (std::size_t v = std::size_t{b} * owner_block;
                                      v < std::min(mesh.positions.size(), (std::size_t{b} + 1) * owner_block); ++v) {
                                   const double* row = p.source_field.data() + v * width;
                                   double nearest = std::numeric_limits<double>::infinity();
                                   for (std::size_t c = 0; c < count; ++c) {
                                     const double* centre = p.clusters.centre.data() + c * width;
                                     double d = 0;
                                     for (std::size_t h = 0; h < width; ++h)
                                       d += (row[h] - centre[h]) * (row[h] - centre[h]);
                                     if (d < nearest) {
                                       nearest = d;
                                       p.source_owner[v] = static_cast<std::int32_t>(c);
                                     }
                                   }
                                 }
                               });
  const Vec3 up = up_of(source_axes_);
  p.source_hangs.resize(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    p.source_hangs[v] = dot(up, mesh.positions[v]) < p.source_ground;
    double& low = p.rest_lows[at(p.source_owner[v])];
    low = std::min(low, p.scale * (dot(up, mesh.positions[v]) - p.source_ground));
  }
}

void Transfer::prepare_levers(Prepared& p, const Overlaps& from, const Overlaps& to) const {
  const std::size_t width = numbers_.size();
  Vector<double> limb(at(p.clusters.count), 0.0, target_core_->memory.get()), outer(limb, target_core_->memory.get()),
      ends(at(p.clusters.count), 1.0, target_core_->memory.get());
  for (std::size_t c = 0; c < limb.size(); ++c) {
    const double* row = p.clusters.centre.data() + c * width;
    const auto h = static_cast<std::size_t>(std::max_element(row, row + width) - row);
    if (flags_[numbers_[h]] & (HF_PAIR_FOOT | HF_PAIR_TRUNK)) continue;
    limb[c] = std::clamp((row[h] - root_from) / root_width, 0.0, 1.0);
    outer[c] = std::clamp((row[h] - fade_from) / fade_width, 0.0, 1.0);
    const Vec3 source_end = region_mean(source_.region(numbers_[h]), source_core_->mesh.positions.data()),
               target_end = region_mean(target_.region(numbers_[h]), target_core_->mesh.positions.data());
    const double reach = std::max(p.scale * norm(source_end - from.centroid[c]), shortest_reach);
    const double unsure = ends_unsure * std::max(0.0, kernel_width() / default_kernel_width - 1) * to.spread[c];
    ends[c] = counted_ratio((norm(target_end - to.centroid[c]) - unsure) / reach, ends_from, ends_to);
  }
  p.levers.prepare(from, to, {limb.data(), limb.size()}, {outer.data(), outer.size()}, {ends.data(), ends.size()},
                   p.scale, p.target_centroid, *target_core_->memory);
}

void Transfer::prepare_gradients(Prepared& p) const {
  Vector<Vec3> source_means(target_core_->memory.get()), target_means(target_core_->memory.get());
  for (const std::uint32_t number : numbers_) {
    source_means.push_back(region_mean(source_.region(number), source_core_->mesh.positions.data()));
    target_means.push_back(region_mean(target_.region(number), target_core_->mesh.positions.data()));
  }
  MatchSide source, target;
  source.core = source_core_.get();
  source.field = p.source_field.data();
  source.axes = source_axes_;
  source.means = {source_means.data(), source_means.size()};
  source.unit = p.scale;
  target.core = target_core_.get();
  target.field = p.target_field.data();
  target.axes = target_axes_;
  target.means = {target_means.data(), target_means.size()};
  p.gradients.prepare(source, target, *target_factor_, target_area_, *target_core_->memory);
}

// Fields of many regions change faster along the surface, so kernels of the same size on it are wider in field values.
double Transfer::kernel_width() const noexcept {
  if (options_.kernel_width != 0) return options_.kernel_width;
  const double pairs = static_cast<double>(numbers_.size());
  return std::min(std::max(default_kernel_width, width_per_pair * pairs), widest_default_kernel);
}

Transfer::Prepared& Transfer::prepare() {
  if (prepared_) return *prepared_;
  if (numbers_.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the transfer has no pair; add one first");
  Memory& memory = *target_core_->memory;
  auto fresh = make_shared_in<Prepared>(memory, memory);
  Prepared& p = *fresh;
  const std::size_t width = numbers_.size();
  p.source_field.allocate(memory, at(source_core_->size()) * width);
  p.target_field.allocate(memory, at(target_core_->size()) * width);
  p.source_leak.resize(width);
  p.target_leak.resize(width);
  source_.solve({numbers_.data(), width}, p.source_field.data(), p.source_leak.data());
  target_.solve({numbers_.data(), width}, p.target_field.data(), p.target_leak.data());
  ClusterOptions cluster_options;
  cluster_options.scheme = options_.scheme.get();
  cluster_options.cluster_count = static_cast<std::int32_t>(options_.cluster_count);
  if (options_.cluster_count == 0 && !cluster_options.scheme)
    cluster_options.cluster_count =
        std::min(static_cast<std::int32_t>(cluster_limit),
                 std::max(default_cluster_count, clusters_per_pair * static_cast<std::int32_t>(width)));
  cluster_options.kernel_width = kernel_width();
  p.clusters =
      make_clusters(cluster_options, static_cast<std::int32_t>(width), {p.source_field.data(), p.source_field.size()},
                    source_area_, *source_core_, {p.target_field.data(), p.target_field.size()}, target_area_,
                    target_core_->mesh, memory, *target_core_->jobs);
  prepare_alignment(p);
  prepare_anchors(p);
  p.source_rotations.prepare(source_core_->mesh, source_area_);
  p.refit.prepare(target_core_->mesh, target_area_, p.clusters, memory);
  p.target_centroid = area_mean(target_core_->mesh, target_area_);
  if (has_kernels()) {
    const SourceWeights weights = weigh_source(
        p.clusters, kernel_width(), {p.source_field.data(), p.source_field.size()}, memory, *target_core_->jobs);
    const WeightedSurface source{source_core_.get(), source_area_, weights.joint.data(), weights.weight.data()},
        target{target_core_.get(), target_area_, p.clusters.joint.data(), p.clusters.weight.data()};
    const Overlaps from = overlaps_of(at(p.clusters.count), source, memory),
                   to = overlaps_of(at(p.clusters.count), target, memory);
    p.slack.prepare(source, from, to, p.translations, axes_.toRotationMatrix(), p.scale, memory);
    prepare_levers(p, from, to);
  } else {
    p.slack.prepare_none(p.clusters.count);
  }
  p.refit.take_pairs(p.slack.pairs());
  poll();
  prepare_ground(p);
  if (has_ground()) find_sinking(p);
  if (options_.mode == HF_TRANSFER_STRETCH) prepare_gradients(p);

  // The frame before the first one is the rest shape.
  const std::size_t count = at(p.clusters.count);
  p.posed.resize(at(source_core_->size()));
  p.given.assign(count, deform::Quaternion());
  p.rotations.assign(count, deform::Quaternion());
  p.matrices.assign(count, Mat3::Identity());
  p.columns.assign(count, BlendColumns());
  p.blended.resize(at(target_core_->size()));
  p.rises.assign(count, 0.0);
  p.needs.assign(at(target_core_->size()), 0.0);
  p.forces.assign(at(target_core_->size()), 0.0);
  p.block_needs.assign(p.needs.size() / rise_block + 1, 0.0);
  p.hold_forces.assign(numbers_.size() + 1, 0.0);
  p.excess.assign(p.anchors.size(), Vec3());
  p.dial_holds.reserve(numbers_.size() + 1);
  prepare_dials(p);
  turn_dials(p);
  p.shifts.assign(count, Vec3());
  p.cluster_goals.assign(count, Vec3());
  p.goals.assign(p.anchors.size(), Vec3());
  p.rigid_motions.assign(rigid_ ? rigid_->count() : 0, deform::RigidMotion());
  prepared_ = std::move(fresh);
  return p;
}

PairInfo Transfer::pair_info(std::uint32_t pair) {
  const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), pair);
  if (found == numbers_.end() || *found != pair) fail(HF_ERROR_NOT_FOUND, pair, "the transfer has no pair %u", pair);
  const Prepared& p = prepare();
  const auto h = static_cast<std::size_t>(found - numbers_.begin());
  PairInfo info;
  info.flags = flags_[pair];
  info.source_leak = p.source_leak[h];
  info.target_leak = p.target_leak[h];
  info.alignment_angle = p.limb_angle[h];
  info.confidence = p.confidence[h];
  info.alignment_share = p.aligned[h];
  info.crossed = is_crossed(pair);
  return info;
}

// Tells whether the two regions of a pair are on different sides: left on the source and right on the target, or the
// reverse.
bool Transfer::is_crossed(std::uint32_t number) const {
  const auto side = [](const surface::Core& core, const Mat3& axes, Span<const std::int32_t> region,
                       const Vector<double>& area) {
    return dot(Vec3{axes(0, 0), axes(0, 1), axes(0, 2)},
               region_mean(region, core.mesh.positions.data()) - area_mean(core.mesh, area));
  };
  const double a = side(*source_core_, source_axes_, source_.region(number), source_area_),
               b = side(*target_core_, target_axes_, target_.region(number), target_area_);
  return std::abs(a) > least_side && std::abs(b) > least_side && a * b < 0;
}

std::int32_t Transfer::cluster_count() { return prepare().clusters.count; }

double Transfer::scale() { return prepare().scale * target_core_->mesh.scale / source_core_->mesh.scale; }

const std::uint8_t* Transfer::sinking() {
  const Prepared& p = prepare();
  return p.sinks.empty() ? nullptr : p.sinks.data();
}

}  // namespace hf_inner::transfer
