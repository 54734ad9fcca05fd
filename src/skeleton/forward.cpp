// Finds forward: left x up where sides are named or declared, with the facts of the shape as a check; else by these
// facts.
#include <algorithm>
#include <cmath>

#include "skeleton/body.h"
#include "skeleton/legs.h"

namespace hf_inner::skeleton {
namespace {

// One fact has one vote, from -1 (backward) to 1, whatever it is measured on.
struct Fact {
  const char* name;
  double sum = 0;
  int count = 0;
  void add(double value) noexcept {
    sum += std::clamp(value, -1.0, 1.0);
    ++count;
  }
  double vote() const noexcept { return count > 0 ? sum / count : 0; }
};

struct Facts {
  Fact head{"head before hips"}, named{"front before back"}, toes{"toes before heels"},
      toe_joints{"toe joints before ankles"}, knees{"knees bend forward"}, eyes{"eyes before the head"},
      ends{"head before the middle"}, face{"face before the joint of the head"}, travel{"clips lead forward"};
  template <class Visit>
  void each(Visit visit) const {
    for (const Fact* f : {&travel, &head, &named, &toes, &toe_joints, &knees, &eyes, &ends, &face}) {
      if (f->count > 0) visit(*f);
    }
  }
  double sum() const {
    double total = 0;
    each([&](const Fact& f) { total += f.vote(); });
    return total;
  }
  int count() const {
    int total = 0;
    each([&](const Fact&) { ++total; });
    return total;
  }
  // Three facts, or two that are clear.
  bool all_against() const {
    bool all = true;
    each([&](const Fact& f) { all &= f.vote() < 0; });
    return all && (count() > 2 || sum() < -1.5);
  }
};

// The middle of the sole against the ankle, and the joint after the ankle. Without an ankle the knee counts, if it is
// almost below the hip.
void look_at_feet(const Body& body, const Limb& limb, Facts& facts) {
  constexpr double under = 0.5;  // in halves of a sole: a knee that is farther from under its hip is bent
  for (int side = 0; side < 2; ++side) {
    const auto& path = limb.paths[side];
    const std::size_t thigh = thigh_of(body, limb), ankle = ankle_of(body, path, thigh);
    if (path.size() < thigh + 2) continue;
    const Vec3 joint = body.pivots[at(ankle > 0 ? path[ankle] : path.back())],
               upper = body.pivots[at(ankle > 0 ? path[ankle] : path[thigh])];
    if (ankle > 0 && ankle + 1 < path.size()) {
      const Vec3 d = body.pivots[at(path[ankle + 1])] - joint;
      if (norm(d) > 0) facts.toe_joints.add(dot(d, body.forward) / norm(d));
    }
    double low = 1e300, front = -1e300, back = 1e300;
    body.for_points_below(limb.roots[side], [&](Vec3 p) { low = std::min(low, body.height_of(p)); });
    body.for_points_below(limb.roots[side], [&](Vec3 p) {
      if (body.height_of(p) >= low + 0.5 * standing * body.height) return;
      front = std::max(front, dot(p, body.forward));
      back = std::min(back, dot(p, body.forward));
    });
    if (!(front > back)) continue;
    const auto ahead = [&](Vec3 p) { return (front + back - 2 * dot(p, body.forward)) / (front - back); };
    if (std::fabs(ahead(joint) - ahead(upper)) < under) facts.toes.add(ahead(joint));
  }
}

// The knee against the line from hip to ankle: a tenth of the leg's length is a full vote.
void look_at_knees(const Body& body, const Limb& limb, Facts& facts) {
  for (const auto& path : limb.paths) {
    const std::size_t thigh = thigh_of(body, limb);
    if (path.size() < thigh + 3) continue;
    const Vec3 a = body.pivots[at(path[thigh])], b = body.pivots[at(path[thigh + 2])],
               knee = body.pivots[at(path[thigh + 1])], d = b - a;
    const double length = norm(d);
    if (length > 0)
      facts.knees.add(10 * dot(knee - a - (dot(knee - a, d) / (length * length)) * d, body.forward) / length);
  }
}

void look_at_trunk(const Body& body, const Vector<const Limb*>& legs, Facts& facts, double& trunk) {
  const Vec3 head = body.means[at(body.head)];
  const Limb* far = legs[0];
  const auto distance = [&](const Limb* l) { return norm(body.pivots[at(l->carrier)] - body.pivots[at(body.head)]); };
  for (const Limb* leg : legs) {
    if (distance(leg) > distance(far)) far = leg;
  }
  const Vec3 hips = 0.5 * (body.pivots[at(far->roots[0])] + body.pivots[at(far->roots[1])]);
  const Vec3 along = unit_vector(head - hips);
  trunk = dot(along, body.up);
  if (std::fabs(trunk) < upright_trunk || legs.size() > 1) facts.head.add(2 * dot(along, body.forward));
}

void look_at_names(const Body& body, Facts& facts) {
  Vec3 front, back;
  double fronts = 0, backs = 0;
  for (const Limb& limb : body.limbs) {
    const int along = body.named ? body.names[at(limb.roots[0])].along : 0;
    const Vec3 middle = 0.5 * (body.mean_below(limb.roots[0]) + body.mean_below(limb.roots[1]));
    if (along > 0) {
      front = front + middle;
      fronts += 1;
    }
    if (along < 0) {
      back = back + middle;
      backs += 1;
    }
    if (limb.named == NameClass::eye && body.head >= 0)
      facts.eyes.add(dot(middle - body.means[at(body.head)], body.forward) > 0 ? 1 : -1);
  }
  if (fronts > 0 && backs > 0)
    facts.named.add(dot((1 / fronts) * front - (1 / backs) * back, body.forward) > 0 ? 1 : -1);
}

// The median of the head's vertices against its joint. Hair and hoods make it a poor fact: it only adds to other facts
// where names have sides.
void look_at_face(const Body& body, Facts& facts) {
  if (body.head < 0 || body.head == body.root || body.owned_count(body.head) < 20 || body.trunk < upright_trunk) return;
  Vector<double> along(&body.memory);
  for (const std::uint32_t v : body.owned_by(body.head)) along.push_back(dot(body.points[v], body.forward));
  const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
  std::nth_element(along.begin(), middle, along.end());
  const auto [low, high] = std::minmax_element(along.begin(), along.end());
  if (*high > *low) facts.face.add(2 * (*middle - dot(body.pivots[at(body.head)], body.forward)) / (*high - *low));
}

// Clips that lead to a side say nothing.
void look_at_travels(const Body& body, Facts& facts) {
  for (std::uint32_t k = 0; k < body.input.travel_count; ++k) {
    const double along = dot(body.travel(k), body.forward);
    if (std::fabs(along) > 0.5) facts.travel.add(along > 0 ? 1 : -1);
  }
}

Facts collect(Body& body) {
  Facts facts;
  look_at_travels(body, facts);
  const Vector<const Limb*> legs = standing_limbs(body);
  if (body.head >= 0 && !legs.empty()) look_at_trunk(body, legs, facts, body.trunk);
  for (const Limb* leg : legs) look_at_feet(body, *leg, facts);
  if (legs.size() == 1 && body.trunk > upright_trunk) look_at_knees(body, *legs[0], facts);
  look_at_names(body, facts);
  if (body.sides_named && !body.sides_doubtful && !legs.empty()) look_at_face(body, facts);
  if (body.head >= 0 && legs.empty()) {
    double low = 1e300, high = -1e300;
    for (const Vec3& p : body.points) {
      low = std::min(low, dot(p, body.forward));
      high = std::max(high, dot(p, body.forward));
    }
    if (high > low)
      facts.ends.add(4 * (dot(body.means[at(body.head)], body.forward) - 0.5 * (low + high)) / (high - low));
  }
  return facts;
}

void turn_round(Body& body) {
  body.forward = -1.0 * body.forward;
  body.left = -1.0 * body.left;
  body.offset = -body.offset;
  for (Limb& limb : body.limbs) {
    std::swap(limb.roots[0], limb.roots[1]);
    std::swap(limb.paths[0], limb.paths[1]);
  }
}

void judge_named(Body& body, const Facts& facts) {
  if (facts.all_against()) {
    turn_round(body);
    body.forward_confidence = 0.5;
    body.say("Every fact of the shape is against the sides of the names: the names use the sides of the viewer.");
    return;
  }
  body.forward_confidence = facts.sum() > -unsure ? 0.95 : 0.7;
  if (facts.sum() <= -unsure) body.say("The shape says the body faces the other way than the sides of its names.");
}

void judge_shape(Body& body, const Facts& facts) {
  if (body.sides_doubtful && std::fabs(facts.sum()) < unsure) {
    body.forward_confidence = 0.4;
    body.say("The rest transforms mirror the body and its shape says nothing: the sides of the names count.");
    return;
  }
  if (facts.sum() < 0) turn_round(body);
  body.forward_confidence = facts.count() > 0 ? 0.5 + 0.4 * std::min(1.0, std::fabs(facts.sum())) : 0.3;
  if (body.sides_doubtful) return;
  if (body.mirror_margin < unsure || body.mirror_score < 0) {
    body.forward_confidence = std::min(body.forward_confidence, 0.4);
    body.say("The plane of symmetry is not sure.");
  }
}

// A declared forward holds unless it lies across.
void take_declared_forward(Body& body) {
  const Vec3 given = unit_vector({body.input.forward[0], body.input.forward[1], body.input.forward[2]});
  const double along = dot(given, body.forward);
  if (std::fabs(along) < 0.5) {
    body.forward_confidence = std::min(body.forward_confidence, 0.5);
    body.say("Forward as declared does not lie in the plane of symmetry: it is not used.");
  } else if (along > 0) {
    body.forward_confidence = std::max(body.forward_confidence, 0.95);
  } else {
    turn_round(body);
    body.forward_confidence = 0.6;
    body.say("Names or shape say the opposite of the declared forward, which is used.");
  }
}

// Writes the reasons for the forward that was chosen.
void give_reasons(Body& body, const Facts& facts, Vec3 looked_at) {
  const double sign = dot(body.forward, looked_at) > 0 ? 1 : -1;
  if (body.input.forward && body.forward_confidence > 0.5) add_reason(body.forward_why, "as declared");
  if (body.sides_named && !body.sides_doubtful && sign > 0) add_reason(body.forward_why, "left and right of the names");
  facts.each([&](const Fact& f) {
    if (sign * f.vote() > 0.2) add_reason(body.forward_why, f.name);
  });
  if (body.forward_why.empty()) add_reason(body.forward_why, "a guess");
}

}  // namespace

Vector<const Limb*> standing_limbs(const Body& body) {
  Vector<const Limb*> legs(&body.memory);
  for (const Limb& limb : body.limbs) {
    const NameClass c = limb.named;
    const bool other = c == NameClass::wing || c == NameClass::ear || c == NameClass::eye || c == NameClass::loose;
    if (limb.stands && !other) legs.push_back(&limb);
  }
  if (!legs.empty()) return legs;
  for (const Limb& limb : body.limbs) {
    if (limb.named == NameClass::leg) legs.push_back(&limb);
  }
  return legs;
}

bool leads_out(const Body& body, const Limb& limb) {
  const auto place = [&](int side, std::size_t k) { return body.pivots[at(limb.paths[side][k])]; };
  return limb.paths[0].size() > 1 && limb.paths[1].size() > 1 && norm(place(0, 0) - place(1, 0)) < one_place &&
         norm(place(0, 1) - place(1, 1)) > 2 * central;
}

// The bone is short, or nearly level and outward from the middle. A thigh that lies level, as on a chair, begins at
// the side of the body.
bool has_hip_bone(const Body& body, const Limb& limb) {
  if (limb.paths[0].size() < 4 || limb.paths[1].size() < 4 || standing_limbs(body).size() != 1) return false;
  return std::all_of(std::begin(limb.paths), std::end(limb.paths), [&](const Vector<Index>& path) {
    const Vec3 a = body.pivots[at(path[0])], b = body.pivots[at(path[1])], bone = b - a;
    if (norm(bone) < hip_stub * norm(body.pivots[at(path[2])] - b)) return true;
    const double out_a = std::fabs(body.lateral(a)), out_b = std::fabs(body.lateral(b));
    return std::fabs(dot(bone, body.up)) < level_bone * norm(bone) && out_a < 0.5 * out_b && out_b > central;
  });
}

std::size_t thigh_of(const Body& body, const Limb& limb) {
  return leads_out(body, limb) || has_hip_bone(body, limb) ? 1 : 0;
}

std::size_t ankle_of(const Body& body, const Vector<Index>& path, std::size_t thigh) {
  // The second of two joints is a knee unless it is far down: blocks have no foot.
  const double share = path.size() - thigh > 2 ? ankle_height : 0.5 * ankle_height;
  const double highest = share * body.height_of(body.pivots[at(path[thigh])]);
  std::size_t first = 0, last = 0;
  for (std::size_t k = thigh + 1; k < path.size(); ++k) {
    const double height = body.height_of(body.pivots[at(path[k])]);
    if (height >= highest) continue;
    if (first == 0) first = k;
    if (height > 0.5 * standing * body.height) last = k;
  }
  return last > 0 ? last : first;
}

void find_forward(Body& body) {
  const Vec3 looked_at = body.forward = cross(body.left, body.up);
  const Facts facts = collect(body);
  facts.each([&](const Fact& f) { body.say("Forward: %s, %+.2f.", f.name, f.vote()); });
  if (body.sides_named && !body.sides_doubtful)
    judge_named(body, facts);
  else
    judge_shape(body, facts);
  if (body.input.forward) take_declared_forward(body);
  give_reasons(body, facts, looked_at);
  for (Limb& limb : body.limbs)
    limb.place = 0.5 * dot(body.pivots[at(limb.roots[0])] + body.pivots[at(limb.roots[1])], body.forward);
}

}  // namespace hf_inner::skeleton
