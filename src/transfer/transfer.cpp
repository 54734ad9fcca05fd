// See transfer.h.
#include "transfer/transfer.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace hf {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr std::uint32_t known_flags =
    HF_PAIR_ANCHOR | HF_PAIR_FOOT | HF_PAIR_TRUNK | HF_PAIR_NO_ALIGNMENT | HF_PAIR_CONTACT;
constexpr double shortest_limb = 0.1;    // of the box: shorter limbs have no reliable direction
constexpr double rigid_residual = 1e-3;  // of the box: frames much nearer to rigid are moved rigidly
constexpr double turn_low = 20 * degree,
                 turn_high = 50 * degree;  // between these a turn of the whole takes the anchors' offsets along
// heights over the ground: of a foot, in boxes, that stands or flies; of a contact, in its own rest heights
constexpr double stands = 0.01, flies = 0.05, touches = 0.1, leaves = 0.45;
constexpr double least_side = 0.03;  // of the box: nearer to the middle a region is neither left nor right
constexpr std::int32_t enough_support = 6;
constexpr std::int32_t refit_rounds = 4;
constexpr std::size_t block = 2048;
std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

bool is_finite(Vec3 p) noexcept { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

double smooth_step(double low, double high, double x) noexcept {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// How rigid a frame of the source is, and how far it has turned as a whole, 0 to 1.
double rigid_share(const WholeMotion& whole) noexcept {
  const double ratio = whole.residual / rigid_residual;
  return 1 / (1 + ratio * ratio);
}
double turned_share(const Quaternion& turn) noexcept {
  return smooth_step(turn_low, turn_high, angle_between(turn, Quaternion()));
}

// How far it has fallen over: turns about the vertical do not count.
double fallen_share(const Quaternion& turn, Vec3 up) noexcept {
  return smooth_step(turn_low, turn_high, std::acos(std::clamp(dot(up, rotate(turn, up)), -1.0, 1.0)));
}

Vec3 region_mean(Span<const std::int32_t> region, const Vec3* points) noexcept {
  Vec3 sum;
  for (const std::int32_t v : region) sum = sum + points[v];
  return (1.0 / static_cast<double>(region.size())) * sum;
}

double lowest(Span<const std::int32_t> region, const Vec3* points, Vec3 up) noexcept {
  double low = 1e300;
  for (const std::int32_t v : region) low = std::min(low, dot(points[v], up));
  return low;
}

Vec3 area_mean(const Mesh& mesh, const Vector<double>& area) noexcept {
  Vec3 sum;
  for (std::size_t v = 0; v < area.size(); ++v) sum = sum + area[v] * mesh.positions[v];
  return sum;
}

}  // namespace

// What follows from the pairs, and the last frame. Made whole or not at all.
struct Transfer::Prepared {
  explicit Prepared(Memory& memory)
      : source_leak(&memory),
        target_leak(&memory),
        limb_angle(&memory),
        confidence(&memory),
        limb_turn(&memory),
        aligned(&memory),
        cluster_turn(&memory),
        clusters(memory),
        source_rotations(memory),
        translations(memory),
        refit(memory),
        anchors(&memory),
        posed(&memory),
        given(&memory),
        rotations(&memory),
        matrices(&memory),
        shifts(&memory),
        cluster_goals(&memory),
        goals(&memory),
        loose(&memory),
        holds(&memory),
        given_hold(&memory) {}
  struct Anchor {
    std::uint32_t number = 0, flags = 0;
    bool is_foot = false;
    Vec3 source_rest, target_rest;
  };

  Buffer<double> source_field, target_field;
  // per pair, in the order of numbers_
  Vector<double> source_leak, target_leak, limb_angle, confidence;
  Vector<Quaternion> limb_turn;  // D_h
  Vector<std::uint8_t> aligned;
  Vector<Quaternion> cluster_turn;  // D_h^w
  Clusters clusters;
  SourceRotations source_rotations;
  Translations translations;
  Refit refit;
  Vector<Anchor> anchors;
  double scale = 1;  // s in inner units
  double source_ground = 0, target_ground = 0;
  Vec3 target_centroid;
  // the last frame
  Vector<Vec3> posed;                   // source, inner units
  Vector<Quaternion> given, rotations;  // from the source, and as refitted
  Vector<Mat3> matrices;
  Vector<Vec3> shifts, cluster_goals, goals;
  Vector<Anchor> loose;     // pairs that are no anchors: only holds move them
  Vector<Hold> holds;       // of this round; room for one per pair
  Vector<Hold> given_hold;  // of the caller, per row; share 0 = none
};

Transfer::Transfer(std::shared_ptr<const Core> source, std::shared_ptr<const Core> target,
                   const TransferOptions& options)
    : source_core_(std::move(source)),
      target_core_(std::move(target)),
      options_(options),
      source_axes_(checked_axes(options.source_axes, "source")),
      target_axes_(checked_axes(options.target_axes, "target")),
      axes_(to_quaternion(transpose(target_axes_) * source_axes_)),
      source_(source_core_),
      target_(target_core_),
      numbers_(target_core_->memory.get()),
      flags_(target_core_->memory.get()),
      source_area_(area_shares(source_core_->mesh, *target_core_->memory)),
      target_area_(area_shares(target_core_->mesh, *target_core_->memory)) {
  if (options.mode != HF_TRANSFER_FIELDS && options.mode != HF_TRANSFER_PAPER)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "mode %d is none of HF_TRANSFER_*", options.mode);
  if (options.cluster_count > 512)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "cluster_count is %u; it may be 1 to 512, or 0 for the default",
         options.cluster_count);
  if (!std::isfinite(options.kernel_width) || !std::isfinite(options.scale) ||
      !std::isfinite(options.alignment_angle)) {
    fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "kernel_width, scale and alignment_angle must be finite");
  }
  // the ABI gives floats: the bounds hold for their nearest values too
  if (options.kernel_width != 0 && (options.kernel_width < 0.00499999 || options.kernel_width > 0.5000001)) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "kernel_width is %g; it may be 0.005 to 0.5, or 0 for the default",
         options.kernel_width);
  }
  if (options.scale != 0 && !(options.scale >= 1e-6 && options.scale <= 1e6)) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "scale is %g; it may be 1e-6 to 1e6, or 0 for the ratio of the legs",
         options.scale);
  }
  if (options_.kernel_width == 0) options_.kernel_width = 0.04;
  if (options_.alignment_angle == 0) options_.alignment_angle = 40 * degree;
}

Transfer::~Transfer() = default;

void Transfer::add_pairs(Span<const PairInput> pairs, std::uint32_t* out_pairs) {
  Memory& memory = *target_core_->memory;
  if (pairs.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the batch holds no pair");
  if (pairs.size() + numbers_.size() > handle_limit) {
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%zu pairs would be too many; a transfer holds at most %u",
         pairs.size() + numbers_.size(), handle_limit);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].flags & ~known_flags)
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(i),
           "pair %zu has flags that are none of HF_PAIR_*: %u", i, pairs[i].flags);
  }
  // the smallest free numbers
  Vector<std::uint32_t> fresh_numbers(&memory), numbers(numbers_, &memory), flags(flags_, &memory);
  Vector<Span<const std::int32_t>> source_regions(&memory), target_regions(&memory);
  std::uint32_t next = 0;
  for (const PairInput& pair : pairs) {
    while (source_.in_use(next)) ++next;
    if (flags.size() <= next) flags.resize(next + 1, 0u);
    flags[next] = pair.flags;
    numbers.push_back(next), fresh_numbers.push_back(next++);
    source_regions.push_back(pair.source), target_regions.push_back(pair.target);
  }
  std::sort(numbers.begin(), numbers.end());
  PairFields source(source_), target(target_);
  source.add({fresh_numbers.data(), fresh_numbers.size()}, {source_regions.data(), source_regions.size()}, "source");
  target.add({fresh_numbers.data(), fresh_numbers.size()}, {target_regions.data(), target_regions.size()}, "target");

  // nothing below fails
  source_ = std::move(source), target_ = std::move(target);
  numbers_.swap(numbers), flags_.swap(flags);
  prepared_.reset();
  if (out_pairs) std::copy(fresh_numbers.begin(), fresh_numbers.end(), out_pairs);
}

void Transfer::remove_pairs(Span<const std::uint32_t> pairs) {
  Memory& memory = *target_core_->memory;
  if (pairs.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the list holds no pair");
  Vector<std::uint32_t> numbers(numbers_, &memory);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto found = std::lower_bound(numbers.begin(), numbers.end(), pairs[i]);
    if (found == numbers.end() || *found != pairs[i])
      fail(HF_ERROR_NO_SUCH_PAIR, static_cast<std::uint32_t>(i), "entry %zu: the transfer has no pair %u", i, pairs[i]);
    numbers.erase(found);
  }
  PairFields source(source_), target(target_);
  source.remove(pairs), target.remove(pairs);
  source_ = std::move(source), target_ = std::move(target);
  numbers_.swap(numbers);
  prepared_.reset();
}

// Directions of the limbs at rest, which of them differ too much, and what that means for each cluster.
void Transfer::prepare_alignment(Prepared& p) const {
  const std::size_t width = numbers_.size();
  const RestSide source{
      &source_core_->mesh, {p.source_field.data(), p.source_field.size()}, source_area_, source_axes_};
  const RestSide target{
      &target_core_->mesh, {p.target_field.data(), p.target_field.size()}, target_area_, target_axes_};
  p.limb_angle.assign(width, -1.0), p.aligned.assign(width, std::uint8_t{0}), p.limb_turn.assign(width, Quaternion());
  Vector<std::int32_t> feet(target_core_->memory.get());
  for (std::size_t h = 0; h < width; ++h) {
    const std::uint32_t number = numbers_[h], flags = flags_[number];
    const auto column = static_cast<std::int32_t>(h);
    if (flags & HF_PAIR_FOOT) feet.push_back(column);
    if (flags & HF_PAIR_TRUNK) continue;
    Vec3 from, to;
    const bool known =
        limb_direction(source, column, region_mean(source_.region(number), source.mesh->positions.data()), to) &&
        limb_direction(target, column, region_mean(target_.region(number), target.mesh->positions.data()), from);
    if (!known || norm(from) < shortest_limb || norm(to) < shortest_limb) continue;
    to = rotate(axes_, to);
    const Vec3 right{target_axes_.m[0][0], target_axes_.m[0][1], target_axes_.m[0][2]};
    p.limb_turn[h] = minimal_rotation(from, to, right);
    p.limb_angle[h] = angle_between(p.limb_turn[h], Quaternion());
    p.aligned[h] = options_.mode == HF_TRANSFER_FIELDS && options_.alignment_angle > 0 &&
                   p.limb_angle[h] > options_.alignment_angle && !(flags & HF_PAIR_NO_ALIGNMENT);
  }

  p.confidence.assign(width, 0.0);
  Vector<double> owned(width, 0.0, target_core_->memory.get());
  p.cluster_turn.assign(at(p.clusters.count), Quaternion());
  for (std::int32_t c = 0; c < p.clusters.count; ++c) {
    const double* centre = p.clusters.centre.data() + at(c) * width;
    const auto h = static_cast<std::size_t>(std::max_element(centre, centre + width) - centre);
    owned[h] += 1;
    if (p.clusters.support[at(c)] >= enough_support) p.confidence[h] += 1;
    if (p.aligned[h]) p.cluster_turn[at(c)] = power(p.limb_turn[h], std::clamp((centre[h] - 0.35) / 0.2, 0.0, 1.0));
  }
  for (std::size_t h = 0; h < width; ++h) p.confidence[h] = owned[h] > 0 ? p.confidence[h] / owned[h] : 0.0;

  p.source_ground = ground_height(source), p.target_ground = ground_height(target);
  p.scale = 1;
  if (options_.scale > 0) {
    p.scale = options_.scale * source_core_->mesh.scale / target_core_->mesh.scale;
  } else if (!feet.empty()) {
    const double of_source = leg_length(source, {feet.data(), feet.size()}),
                 of_target = leg_length(target, {feet.data(), feet.size()});
    if (of_source > 1e-6 && of_target > 1e-6) p.scale = of_target / of_source;
  }
}

void Transfer::prepare_anchors(Prepared& p) const {
  Vector<Span<const std::int32_t>> regions(target_core_->memory.get());
  bool holds_trunk = false;
  Vector<Span<const std::int32_t>> loose(target_core_->memory.get());
  for (const std::uint32_t number : numbers_) {
    Prepared::Anchor anchor;
    anchor.number = number, anchor.flags = flags_[number], anchor.is_foot = (flags_[number] & HF_PAIR_FOOT) != 0;
    anchor.source_rest = region_mean(source_.region(number), source_core_->mesh.positions.data());
    anchor.target_rest = region_mean(target_.region(number), target_core_->mesh.positions.data());
    const bool anchored = (flags_[number] & (HF_PAIR_ANCHOR | HF_PAIR_FOOT)) != 0;
    (anchored ? p.anchors : p.loose).push_back(anchor);
    (anchored ? regions : loose).push_back(target_.region(number));
    if (!anchored) continue;
    holds_trunk = holds_trunk || (flags_[number] & HF_PAIR_TRUNK);
  }
  TranslationOptions options;
  if (options_.mode == HF_TRANSFER_PAPER) options.spread_share = 0;
  // feet alone would let the trunk float: the centroid holds it then
  options.root = p.anchors.empty() ? 1.0 : holds_trunk ? 1e-3 : 0.1;
  p.translations.prepare(*target_core_, target_area_, p.clusters, {regions.data(), regions.size()},
                         {loose.data(), loose.size()}, options);
  p.holds.reserve(numbers_.size()), p.given_hold.assign(numbers_.size() + 1, Hold());
}

Transfer::Prepared& Transfer::prepare() {
  if (prepared_) return *prepared_;
  if (numbers_.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the transfer has no pair; add one first");
  Memory& memory = *target_core_->memory;
  auto fresh = make_shared_in<Prepared>(memory, memory);
  Prepared& p = *fresh;
  const std::size_t width = numbers_.size();
  p.source_field.allocate(memory, at(source_core_->size()) * width),
      p.target_field.allocate(memory, at(target_core_->size()) * width);
  p.source_leak.resize(width), p.target_leak.resize(width);
  source_.solve({numbers_.data(), width}, p.source_field.data(), p.source_leak.data());
  target_.solve({numbers_.data(), width}, p.target_field.data(), p.target_leak.data());
  ClusterOptions cluster_options;
  cluster_options.paper_bands = options_.mode == HF_TRANSFER_PAPER;
  cluster_options.cluster_count = static_cast<std::int32_t>(options_.cluster_count);
  cluster_options.kernel_width = options_.kernel_width;
  p.clusters =
      make_clusters(cluster_options, static_cast<std::int32_t>(width), {p.source_field.data(), p.source_field.size()},
                    source_area_, *source_core_, {p.target_field.data(), p.target_field.size()}, target_area_,
                    target_core_->mesh, memory, *target_core_->jobs);
  prepare_alignment(p);
  prepare_anchors(p);
  p.source_rotations.prepare(source_core_->mesh, source_area_);
  p.refit.prepare(target_core_->mesh, target_area_, p.clusters, memory);
  p.target_centroid = area_mean(target_core_->mesh, target_area_);

  // the frame before the first: rest
  const std::size_t count = at(p.clusters.count);
  p.posed.resize(at(source_core_->size()));
  p.given.assign(count, Quaternion()), p.rotations.assign(count, Quaternion()),
      p.matrices.assign(count, Mat3::identity());
  p.shifts.assign(count, Vec3()), p.cluster_goals.assign(count, Vec3()), p.goals.assign(p.anchors.size(), Vec3());
  prepared_ = std::move(fresh);
  return p;
}

PairInfo Transfer::pair_info(std::uint32_t pair) {
  const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), pair);
  if (found == numbers_.end() || *found != pair) fail(HF_ERROR_NO_SUCH_PAIR, pair, "the transfer has no pair %u", pair);
  const Prepared& p = prepare();
  const auto h = static_cast<std::size_t>(found - numbers_.begin());
  PairInfo info;
  info.flags = flags_[pair];
  info.source_leak = p.source_leak[h], info.target_leak = p.target_leak[h];
  info.alignment_angle = p.limb_angle[h], info.confidence = p.confidence[h], info.aligned = p.aligned[h] != 0;
  info.crossed = is_crossed(pair);
  return info;
}

// On one side of the source and on the other of the target.
bool Transfer::is_crossed(std::uint32_t number) const {
  const auto side = [](const Core& core, const Mat3& axes, Span<const std::int32_t> region,
                       const Vector<double>& area) {
    return dot(Vec3{axes.m[0][0], axes.m[0][1], axes.m[0][2]},
               region_mean(region, core.mesh.positions.data()) - area_mean(core.mesh, area));
  };
  const double a = side(*source_core_, source_axes_, source_.region(number), source_area_),
               b = side(*target_core_, target_axes_, target_.region(number), target_area_);
  return std::abs(a) > least_side && std::abs(b) > least_side && a * b < 0;
}

// Where the anchored regions go. turn: rotation of the whole source in the target's frame.
void Transfer::place_anchors(Prepared& p, const WholeMotion& whole, const Quaternion& turn) const {
  const double share = std::max(rigid_share(whole), turned_share(turn));
  const Mat3 carried = to_matrix(power(turn, share));
  const Vec3 source_up{source_axes_.m[1][0], source_axes_.m[1][1], source_axes_.m[1][2]},
      up{target_axes_.m[1][0], target_axes_.m[1][1], target_axes_.m[1][2]};
  for (std::size_t k = 0; k < p.anchors.size(); ++k) {
    const Prepared::Anchor& anchor = p.anchors[k];
    const Span<const std::int32_t> from = source_.region(anchor.number), to = target_.region(anchor.number);
    const Vec3 path = p.scale * rotate(axes_, region_mean(from, p.posed.data()) - anchor.source_rest);
    const Vec3 offset =
        anchor.target_rest - p.target_centroid - p.scale * rotate(axes_, anchor.source_rest - whole.rest_centroid);
    p.goals[k] = anchor.target_rest + path + (carried * offset - offset);
    if (!anchor.is_foot) continue;
    // not deeper under the ground than the source's foot
    const double allowed =
        p.target_ground + std::min(0.0, p.scale * (lowest(from, p.posed.data(), source_up) - p.source_ground));
    const Mat3 rotation = p.translations.mean_rotation(k, p.matrices.data());
    double low = 1e300;
    for (const std::int32_t v : to)
      low = std::min(low, dot(up, rotation * (target_core_->mesh.positions[at(v)] - anchor.target_rest)));
    const double lift = allowed - (dot(up, p.goals[k]) + low);
    if (lift > 0) p.goals[k] = p.goals[k] + (1 - share) * lift * up;
  }
}

void Transfer::read_holds(Prepared& p, Span<const PairHold> holds) const {
  for (Hold& hold : p.given_hold) hold.share = 0;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const std::uint32_t number = holds[i].pair;
    if (!std::binary_search(numbers_.begin(), numbers_.end(), number))
      fail(HF_ERROR_NO_SUCH_PAIR, index, "entry %zu of the holds: the transfer has no pair %u", i, number);
    if (!is_finite(holds[i].place))
      fail(HF_ERROR_NON_FINITE, index, "entry %zu of the holds: the place of pair %u is not finite", i, number);
    const auto row_in = [&](const Vector<Prepared::Anchor>& list) {
      std::size_t k = 0;
      while (k < list.size() && list[k].number != number) ++k;
      return k;
    };
    std::size_t row = row_in(p.anchors);
    if (row == p.anchors.size()) row = p.anchors.size() + 1 + row_in(p.loose);
    Hold& hold = p.given_hold[row];
    if (hold.share > 0)
      fail(HF_ERROR_INVALID_ARGUMENT, index, "entry %zu of the holds: pair %u is held already", i, number);
    hold.row = row, hold.goal = target_core_->mesh.to_inner(holds[i].place), hold.share = 1, hold.vertical = false;
  }
}

// Holds the regions that stand, touch, would sink, or that the caller places. share: how far the frame is a rigid
// motion or the body has fallen over, where none of them hold by themselves.
void Transfer::hold_regions(Prepared& p, double share) const {
  const Vec3 source_up{source_axes_.m[1][0], source_axes_.m[1][1], source_axes_.m[1][2]},
      up{target_axes_.m[1][0], target_axes_.m[1][1], target_axes_.m[1][2]};
  const bool by_itself = options_.mode == HF_TRANSFER_FIELDS && share < 1;
  p.holds.clear();
  for (std::size_t row = 0; row < p.given_hold.size(); ++row) {
    if (p.given_hold[row].share > 0) {
      p.holds.push_back(p.given_hold[row]);
      continue;
    }
    if (!by_itself || row == p.anchors.size()) continue;
    const bool anchored = row < p.anchors.size();
    const Prepared::Anchor& pair = anchored ? p.anchors[row] : p.loose[row - p.anchors.size() - 1];
    const double height = lowest(source_.region(pair.number), p.posed.data(), source_up) - p.source_ground;
    Hold hold;
    hold.row = row;
    if (pair.is_foot) {
      hold.goal = p.goals[row], hold.share = (1 - share) * (1 - smooth_step(stands, flies, p.scale * height));
      if (hold.share > 0) p.holds.push_back(hold);
      continue;
    }
    // lowest vertex of the region about its mean, as the blend turns it
    const Mat3 rotation = p.translations.mean_rotation(row, p.matrices.data());
    double low = 1e300;
    for (const std::int32_t v : target_.region(pair.number))
      low = std::min(low, dot(up, rotation * (target_core_->mesh.positions[at(v)] - pair.target_rest)));
    const Vec3 now = p.translations.place(row, p.matrices.data(), p.shifts.data());
    const double at_height = dot(up, now) + low - p.target_ground;
    const double rest =
        lowest(source_.region(pair.number), source_core_->mesh.positions.data(), source_up) - p.source_ground;
    double wanted = at_height;
    if ((pair.flags & HF_PAIR_CONTACT) && rest > 0) {
      hold.share = (1 - share) * (1 - smooth_step(touches, leaves, std::max(height, 0.0) / rest));
      wanted = p.scale * height;
    }
    const double allowed = std::min(0.0, p.scale * height);
    if (at_height + hold.share * (wanted - at_height) < allowed) wanted = allowed, hold.share = 1 - share;
    if (wanted == at_height || !(hold.share > 1e-6)) continue;
    hold.goal = now + (wanted - at_height) * up, hold.vertical = true;
    p.holds.push_back(hold);
  }
  p.translations.hold({p.holds.data(), p.holds.size()}, up, p.matrices.data(), p.shifts.data());
}

void Transfer::apply(const Vec3* source, Vec3* out, Span<const PairHold> holds) {
  for (std::int32_t v = 0; v < source_core_->size(); ++v) {
    if (!is_finite(source[v]))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(v), "vertex %d of the posed source is not finite", v);
  }
  Prepared& p = prepare();
  read_holds(p, holds);
  const Mesh& from = source_core_->mesh;
  const Mesh& to = target_core_->mesh;
  JobRunner& jobs = *target_core_->jobs;
  for (std::size_t v = 0; v < p.posed.size(); ++v) p.posed[v] = from.to_inner(source[v]);
  const WholeMotion whole = p.source_rotations.whole(from, source_area_, p.posed.data());
  p.source_rotations.clusters(p.clusters, p.posed.data(), whole.rotation, p.given.data(), jobs);

  // into the target's axes and rest directions
  const Quaternion turn = normalised(axes_ * whole.rotation * conjugate(axes_));
  const Vec3 centroid = p.target_centroid + p.scale * rotate(axes_, whole.centroid - whole.rest_centroid);
  for (std::size_t c = 0; c < p.rotations.size(); ++c) {
    p.given[c] = p.rotations[c] = normalised(axes_ * p.given[c] * conjugate(axes_) * p.cluster_turn[c]);
    p.matrices[c] = to_matrix(p.rotations[c]);
    p.cluster_goals[c] = centroid + rotate(turn, p.clusters.pivot[c] - p.target_centroid);
  }
  place_anchors(p, whole, turn);
  const double fallen = fallen_share(turn, {target_axes_.m[1][0], target_axes_.m[1][1], target_axes_.m[1][2]});
  const double share = std::max(rigid_share(whole), fallen);
  p.translations.solve(p.clusters, p.matrices.data(), {p.goals.data(), p.goals.size()}, centroid,
                       p.cluster_goals.data(), p.shifts.data());
  hold_regions(p, share);
  // nothing pulls where there is no anchor
  const std::int32_t rounds =
      options_.mode == HF_TRANSFER_PAPER || (p.anchors.empty() && holds.empty()) ? 0 : refit_rounds;
  for (std::int32_t round = 0; round < rounds; ++round) {
    p.refit.turn(p.given.data(), p.shifts.data(), p.rotations.data(), p.matrices.data());
    for (std::size_t c = 0; c < p.rotations.size(); ++c) p.matrices[c] = to_matrix(p.rotations[c]);
    p.translations.solve(p.clusters, p.matrices.data(), {p.goals.data(), p.goals.size()}, centroid,
                         p.cluster_goals.data(), p.shifts.data());
    hold_regions(p, share);
  }

  lift_surface(p, (1 - rigid_share(whole)) * fallen);

  const std::size_t n = to.positions.size();
  jobs.for_each(static_cast<std::uint32_t>((n + block - 1) / block), [&](std::uint32_t b) {
    const std::size_t last = std::min(n, (std::size_t{b} + 1) * block);
    for (std::size_t v = std::size_t{b} * block; v < last; ++v) out[v] = to.to_given(blended(p, v));
  });
}

Vec3 Transfer::blended(const Prepared& p, std::size_t v) const noexcept {
  Vec3 sum;
  for (std::size_t i = v * blend_count; i < (v + 1) * blend_count; ++i) {
    const double w = static_cast<double>(p.clusters.weight[i]);
    if (w <= 0) break;
    const std::size_t c = at(p.clusters.joint[i]);
    sum = sum + w * (p.matrices[c] * target_core_->mesh.positions[v] + p.shifts[c]);
  }
  return sum;
}

// A body that has turned over lies on any part of its surface: all of it goes up by what sinks deeper under the ground
// than the source does. Upright bodies stand on their feet, which stay.
void Transfer::lift_surface(Prepared& p, double share) const noexcept {
  if (!(share > 0) || p.anchors.empty() || options_.mode != HF_TRANSFER_FIELDS) return;
  const Vec3 source_up{source_axes_.m[1][0], source_axes_.m[1][1], source_axes_.m[1][2]},
      up{target_axes_.m[1][0], target_axes_.m[1][1], target_axes_.m[1][2]};
  double source_low = 1e300, low = 1e300;
  for (const Vec3& point : p.posed) source_low = std::min(source_low, dot(point, source_up));
  for (std::size_t v = 0; v < target_core_->mesh.positions.size(); ++v) low = std::min(low, dot(blended(p, v), up));
  const double sunk = p.target_ground + p.scale * std::min(0.0, source_low - p.source_ground) - low;
  if (!(sunk > 0)) return;
  for (Vec3& shift : p.shifts) shift = shift + share * sunk * up;
}

std::int32_t Transfer::cluster_count() { return prepare().clusters.count; }

double Transfer::scale() { return prepare().scale * target_core_->mesh.scale / source_core_->mesh.scale; }

void Transfer::skin_motion(Vec3* pivots, Quaternion* rotations, Vec3* places) {
  const Prepared& p = prepare();
  const Mesh& mesh = target_core_->mesh;
  for (std::size_t c = 0; c < p.rotations.size(); ++c) {
    if (pivots) pivots[c] = mesh.to_given(p.clusters.pivot[c]);
    if (rotations) rotations[c] = p.rotations[c];
    if (places) places[c] = mesh.to_given(p.matrices[c] * p.clusters.pivot[c] + p.shifts[c]);
  }
}

void Transfer::skin_weights(std::int32_t vertex, std::uint32_t weight_count, std::uint32_t* joints, float* weights) {
  const Prepared& p = prepare();
  for (std::uint32_t i = 0; i < weight_count; ++i) {
    const bool used = i < blend_count;
    const std::size_t from = at(vertex) * blend_count + i;
    weights[i] = used ? p.clusters.weight[from] : 0.0f;
    joints[i] = used && weights[i] > 0 ? static_cast<std::uint32_t>(p.clusters.joint[from]) : 0u;
  }
}

}  // namespace hf
