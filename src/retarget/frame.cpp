// A frame, step by step.
#include <algorithm>
#include <cmath>

#include "base/arguments.h"
#include "base/error.h"
#include "base/progress.h"
#include "retarget/retargeter.h"

namespace hf_inner::retarget {

const char* scale_source_name(ScaleSource source) noexcept {
  static constexpr const char* names[] = {"given", "leg lengths", "hip heights", "body heights"};
  return names[static_cast<std::size_t>(source)];
}

Retargeter::Retargeter(const RetargetSide& s, const RetargetSide& t, const RetargetOptions& chosen, Memory& m)
    : memory(m),
      options(chosen),
      source(s, "source", m),
      target(t, "target", m),
      from(m),
      to(m),
      wanted(&m),
      follows(&m),
      pairs(&m),
      feet(&m),
      parts(&m),
      same(m),
      points(&m),
      report_(m) {
  check_choice(static_cast<std::int32_t>(chosen.root_motion), 3, "root_motion");
  check_finite(chosen.scale, "scale");
  for (const double v : chosen.ground_velocity) check_finite(v, "ground_velocity");
  if (chosen.scale < 0) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "scale is below 0; give a ratio, or 0 to find it");
  across = unit_turn(target.axes * inverse(source.axes));
  people = source.upright && target.upright;
  from.resize(at(source.count));
  to.resize(at(target.count));
  find_scale();
  poll();
  match_chains(s, t);
  poll();
  find_root();
  find_feet();
  std::size_t most = 0;
  for (const Rig* rig : {&source, &target}) {
    for (const RigLeg& leg : rig->legs) most = std::max(most, leg.sole.size());
  }
  points.reserve(most);
  find_parts(s, t);
  if (chosen.copy_same && chosen.root_motion == RootMotion::keep && !(chosen.scale > 0)) find_same(s, t);
  if (pairs.empty() && !same.found)
    fail(HF_ERROR_EMPTY, HF_NO_INDEX,
         "source and target have no chain of joints in common; declare roles in their characters");
  for (const ChainPair& pair : pairs)
    report_.chains.push_back({pair.role, pair.side, static_cast<std::uint32_t>(pair.source.joints.size()),
                              static_cast<std::uint32_t>(pair.target.joints.size()), 0, 0});
  report_.same_skeleton = same.found;
  report_.scale = scale;
}

// Stride and height by the lengths of legs, from hip to sole. Animals stand in legs that are bent at rest, each kind in
// its own way. Their legs are not aligned: they turn from rest to rest, so the heights of the hips count.
void Retargeter::find_scale() {
  const auto ratio = [](double t, double s) { return t > 0 && s > 0 ? t / s : 0.0; };
  const bool animals = !people;
  height_scale = animals ? ratio(target.hip_height, source.hip_height) : ratio(target.leg_length, source.leg_length);
  report_.scale_source = animals ? ScaleSource::hips : ScaleSource::legs;
  if (!(height_scale > 0) || source.legs.empty() || target.legs.empty()) {
    height_scale = ratio(target.height, source.height);
    report_.scale_source = ScaleSource::height;
  }
  if (!(height_scale > 0)) height_scale = 1;
  scale = height_scale;
  if (options.scale > 0) {
    scale = options.scale;
    report_.scale_source = ScaleSource::given;
  }
  source_hips = source.hip_place(source.rest);
  target_hips = target.hip_place(target.rest);
}

void Retargeter::find_root() {
  for (Index j = target.parents[at(target.mover)]; j >= 0; j = target.parents[at(j)]) root = j;
  if (root < 0 && options.root_motion == RootMotion::to_root)
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(target.mover),
         "joint %d of the target has no parent to move by the travel; keep the travel or leave it out", target.mover);
  for (const Index j : target.order) {
    const Index p = target.parents[at(j)];
    if (p < 0 || (j != target.mover && !target.linked[at(j)] && j != root)) continue;
    const Linear& m = target.rest.linear[at(p)];
    if (!(std::fabs(determinant(m)) > 1e-12 * norm(m.x) * norm(m.y) * norm(m.z)))
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(p),
           "the rest transform of joint %d of the target is flat; give it three axes", p);
  }
}

// Returns the turn of the line from root to tip of a limb of the source, beyond the turn of its first bone.
Turn Retargeter::line_turn(const Segments& limb) const {
  const std::size_t root = at(limb.joints[0]);
  const Vec3 was = source.tip_place(limb.tip, source.rest) - source.rest.place[root];
  const Vec3 now = source.tip_place(limb.tip, from) - from.place[root];
  return shortest_turn(from.turn[root] * (inverse(source.rest.turn[root]) * was), now);
}

void Retargeter::turn_joints() {
  for (const Follow& f : follows) {
    const Turn further = f.line < 0 ? Turn{} : line_turn(pairs[at(f.line)].source);
    const Turn a = across * (further * (from.turn[at(f.a)] * f.post_a));
    to.turn[at(f.target)] =
        f.a == f.b ? unit_turn(a) : unit_turn(between(a, across * (from.turn[at(f.b)] * f.post_b), f.share));
  }
  for (const FootPair& foot : feet) {
    for (const Index joint : foot.below) {
      if (!(foot.tilt < 1)) break;
      Turn& turn = to.turn[at(joint)];
      const Turn tilt = shortest_turn(target.up, turn * (inverse(target.rest.turn[at(joint)]) * target.up));
      turn = unit_turn(between({}, tilt, foot.tilt) * (inverse(tilt) * turn));
    }
  }
}

// Moves the hips of the target, in the middle of its thighs, to the scaled place of the hips of the source.
void Retargeter::move_root() {
  mover_place = target.rest.place[at(target.mover)];
  target.place(wanted, mover_place, to);
  const Vec3 hips = source.hip_place(from);
  const Vec3 moved = across * (hips - source_hips);
  Vec3 goal = target_hips + scale * target.level(moved);
  if (!target.legs.empty() && !source.legs.empty())
    goal = goal + (target.ground + height_scale * source.height_of(hips) - dot(goal, target.up)) * target.up;
  else
    goal = goal + (height_scale * dot(moved, target.up)) * target.up;
  const Vec3 shift = goal - target.hip_place(to);
  mover_place = mover_place + shift;
  for (std::size_t j = 0; j < at(target.count); ++j) {
    if (target.moves[j]) to.place[j] = to.place[j] + shift;
  }
}

void Retargeter::move_travel() {
  if (options.root_motion == RootMotion::keep) return;
  const Vec3 travel = target.level(target.hip_place(to) - target_hips);
  const bool leave_out = options.root_motion == RootMotion::in_place;
  for (std::size_t j = 0; j < at(target.count); ++j) {
    if (leave_out && target.moves[j]) to.place[j] = to.place[j] - travel;
    if (!leave_out && !target.moves[j] && target.is_under(static_cast<Index>(j), root))
      to.place[j] = to.place[j] + travel;
  }
}

void Retargeter::write_joints(double* out) const {
  for (std::size_t j = 0; j < at(target.count); ++j, out += 10) {
    const Index p = target.parents[j];
    Vec3 t = target.translations[j];
    const bool carried = static_cast<Index>(j) == root && options.root_motion == RootMotion::to_root;
    if (static_cast<Index>(j) == target.mover || target.linked[j] || carried)
      t = p < 0 ? to.place[j] : solve(to.linear[at(p)], to.place[j] - to.place[at(p)]);
    const Turn q = wanted[j] ? target.local_turn(static_cast<Index>(j), to) : target.rotations[j];
    const Vec3 s = target.scales[j];
    const double numbers[] = {t.x, t.y, t.z, q.x, q.y, q.z, q.w, s.x, s.y, s.z};
    std::copy(numbers, numbers + 10, out);
  }
}

void Retargeter::frame(const double* poses, double seconds, double* out) {
  require(poses, "source");
  require(out, "target");
  check_finite(seconds, "seconds");
  if (seconds < 0) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "seconds is below 0; call reset to go back in time");
  source.read_pose(poses, from);
  if (same.found) {
    copy_same(poses, out);
    ++report_.frames;
    return;
  }
  turn_joints();
  move_root();
  if (options.goals) {
    lift_trunk();
    meet_goals(seconds);
    clear_ground();
    measure_hover();
  }
  measure();
  move_travel();
  write_joints(out);
}

void Retargeter::reset() noexcept {
  for (FootPair& foot : feet) {
    foot.known = false;
    foot.offset = {};
    foot.walked = foot.walked_by = 0;
  }
  report_.stride = 1;
  for (ChainPair& pair : pairs) pair.sum = pair.worst = 0;
  for (ChainReport& chain : report_.chains) chain.mean_degrees = chain.worst_degrees = 0;
  report_.frames = 0;
  report_.limb_degrees = report_.deepest_drop = report_.hover = 0;
  hover_sum = hover_frames = 0;
}

void Retargeter::partners(std::uint32_t* out) const noexcept {
  for (const Follow& f : follows) out[at(f.target)] = static_cast<std::uint32_t>(f.share < 0.5 ? f.a : f.b);
  for (std::size_t j = 0; same.found && j < at(target.count); ++j) {
    if (same.partners[j] >= 0) out[j] = static_cast<std::uint32_t>(same.partners[j]);
  }
}

void Retargeter::copy_state(const Retargeter& other) {
  for (std::size_t k = 0; k < feet.size(); ++k) {
    const FootPair& by = other.feet[k];
    feet[k].offset = by.offset;
    feet[k].standing = by.standing;
    feet[k].known = by.known;
    feet[k].walked = by.walked;
    feet[k].walked_by = by.walked_by;
    feet[k].source_was = by.source_was;
    feet[k].target_was = by.target_was;
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    pairs[k].sum = other.pairs[k].sum;
    pairs[k].worst = other.pairs[k].worst;
  }
  report_.chains = other.report_.chains;
  report_.frames = other.report_.frames;
  report_.limb_degrees = other.report_.limb_degrees;
  report_.stride = other.report_.stride;
  report_.deepest_drop = other.report_.deepest_drop;
  report_.hover = other.report_.hover;
  hover_sum = other.hover_sum;
  hover_frames = other.hover_frames;
}

Retarget::Retarget(const RetargetSide& source, const RetargetSide& target, const RetargetOptions& options,
                   Memory& memory)
    : self_(make_shared_in<Retargeter>(memory, source, target, options, memory)) {}
Retarget::~Retarget() = default;
Retarget::Retarget(Retarget&&) noexcept = default;
Retarget& Retarget::operator=(Retarget&&) noexcept = default;
void Retarget::frame(const double* source, double seconds, double* target) { self_->frame(source, seconds, target); }
void Retarget::reset() noexcept { self_->reset(); }
const RetargetReport& Retarget::report() const noexcept { return self_->report(); }
void Retarget::partners(std::uint32_t* out) const noexcept { self_->partners(out); }
void Retarget::copy_state(const Retarget& other) { self_->copy_state(*other.self_); }

}  // namespace hf_inner::retarget
