// Finds left and the pairs: by declared sides and the sides of names, else by the best plane of symmetry.
#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/principal_axes.h"
#include "skeleton/mirror.h"

namespace hf_inner::skeleton {
namespace {

constexpr Vec3 coordinate_axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

double component(Vec3 v, int axis) noexcept { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// The coordinate axis within 14 degrees, or the vector.
Vec3 snap(Vec3 v) noexcept {
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(component(v, k)) > snapped) return (component(v, k) > 0 ? 1.0 : -1.0) * coordinate_axes[k];
  }
  return v;
}

bool is_straight(Vec3 v) noexcept {
  return std::any_of(std::begin(coordinate_axes), std::end(coordinate_axes),
                     [&](Vec3 axis) { return std::fabs(dot(v, axis)) == 1; });
}

// Two joints, one on each side, whose names differ only in the side.
void pair_names(Body& body) {
  Vector<std::pair<std::uint64_t, Index>> keys(&body.memory);
  for (Index j = 0; j < body.count; ++j) {
    if (body.kept[at(j)] && body.names[at(j)].side != 0) keys.push_back({body.names[at(j)].key, j});
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t end = i;
    while (end < keys.size() && keys[end].first == keys[i].first) ++end;
    if (end == i + 2 && body.names[at(keys[i].second)].side != body.names[at(keys[i + 1].second)].side) {
      body.mates[at(keys[i].second)] = keys[i + 1].second;
      body.mates[at(keys[i + 1].second)] = keys[i].second;
    }
    i = end;
  }
}

// Declared joints of one role, in the order of the tree, where both sides have as many.
void pair_declared(Body& body) {
  if (!body.input.roles || !body.input.sides) return;
  for (std::int32_t role = 0; role < role_count; ++role) {
    Vector<Index> left(&body.memory), right(&body.memory);
    for (const Index j : body.order) {
      if (body.input.roles[at(j)] != role || body.mates[at(j)] >= 0) continue;
      if (body.input.sides[at(j)] == 1) left.push_back(j);
      if (body.input.sides[at(j)] == 2) right.push_back(j);
    }
    if (left.size() != right.size()) continue;
    for (std::size_t k = 0; k < left.size(); ++k) {
      body.mates[at(left[k])] = right[k];
      body.mates[at(right[k])] = left[k];
    }
  }
}

// Returns the way from the right joint of a pair to the left one. It uses the pivots or the means of the vertices that
// they own, whichever are farther apart.
Vec3 across(const Body& body, Index left) {
  const Index right = body.mates[at(left)];
  const Vec3 pivots = body.pivots[at(left)] - body.pivots[at(right)],
             means = body.means[at(left)] - body.means[at(right)];
  return norm(means) > norm(pivots) ? means : pivots;
}

struct NamedSides {
  Vec3 all, roots;  // sums over all pairs, and over those whose parents are not a pair: a pose does not move these
  std::size_t pairs = 0, against = 0, flipped = 0;
};

NamedSides sum_sides(const Body& body) {
  NamedSides sum;
  for (Index j = 0; j < body.count; ++j) {
    if (body.mates[at(j)] < 0 || body.names[at(j)].side <= 0) continue;
    const Vec3 v = across(body, j);
    if (norm(v) <= central) continue;
    sum.all = sum.all + unit_vector(v);
    sum.flipped += body.flipped[at(j)];
    ++sum.pairs;
  }
  for (Index j = 0; j < body.count; ++j) {
    if (body.mates[at(j)] < 0 || body.names[at(j)].side <= 0) continue;
    const Index p = body.parents[at(j)];
    const Vec3 v = body.pivots[at(j)] - body.pivots[at(body.mates[at(j)])];
    sum.against += dot(v, sum.all) < 0;
    if ((p < 0 || body.mates[at(p)] < 0) && dot(v, sum.all) > 0) sum.roots = sum.roots + v;
  }
  return sum;
}

void take_plane(Body& body, const Plane& plane) {
  for (Index j = 0; j < body.count; ++j) {
    const Index m = plane.mates[at(j)];
    if (m >= 0 && body.mates[at(j)] < 0 && body.mates[at(m)] < 0) {
      body.mates[at(j)] = m;
      body.mates[at(m)] = j;
    }
  }
}

double offset_of_pairs(const Body& body, double without) {
  Vector<double> middles(&body.memory);
  for (Index j = 0; j < body.count; ++j) {
    if (body.mates[at(j)] > j)
      middles.push_back(0.5 * dot(body.pivots[at(j)] + body.pivots[at(body.mates[at(j)])], body.left));
  }
  if (middles.empty()) return without;
  const auto middle = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
  std::nth_element(middles.begin(), middle, middles.end());
  return *middle;
}

// Names give the side, the mirror gives the plane.
void find_named_plane(Body& body, const NamedSides& sides, MirrorSearch& search) {
  Vector<Vec3> candidates(&body.memory);
  candidates.push_back(unit_vector(sides.all));
  if (norm(sides.roots) > central) candidates.push_back(unit_vector(sides.roots));
  for (std::size_t k = candidates.size(); k-- > 0;) {
    for (int axis = 0; axis < 3; ++axis) {
      const double c = component(candidates[k], axis);
      if (std::fabs(c) > snapped - unsure) candidates.push_back((c > 0 ? 1.0 : -1.0) * coordinate_axes[axis]);
    }
  }
  double best = -1e300, straight = -1e300;
  Vec3 axis;
  for (const Vec3& candidate : candidates) {
    const double score = search.look(candidate, true).score + (is_straight(candidate) ? central : 0);
    if (score > best) {
      best = score;
      body.left = candidate;
    }
    if (is_straight(candidate) && score > straight) {
      straight = score;
      axis = candidate;
    }
  }
  if (best < 0 && straight > -1e300) body.left = axis;  // a stride mirrors in no plane, and turns hips and shoulders
  body.left = snap(body.left);
  const Plane plane = search.look(body.left, false, true);
  body.offset = offset_of_pairs(body, plane.offset);
  body.mirror_score = best;
  take_plane(body, plane);
}

// The side axis that best fits the pairs of a plane, straight where up is known.
Vec3 refined(const Body& body, const Plane& plane, const Vector<Vec3>& pivots, bool level) {
  Mat3 moments = Mat3::Zero();
  for (Index j = 0; j < body.count; ++j) {
    const Index m = plane.mates[at(j)];
    if (m < 0) continue;
    Vec3 d = pivots[at(j)] - pivots[at(m)];
    if (level) d = d - dot(d, body.up) * body.up;
    const hf_eigen::Vector3d v(d.x, d.y, d.z);
    moments += v * v.transpose();
  }
  if (!(moments.trace() > 0)) return plane.left;
  Mat3 axes = principal_axes(moments).axes;
  fix_signs(axes);
  return {axes(0, 0), axes(1, 0), axes(2, 0)};
}

std::ptrdiff_t count_mates(const Vector<Index>& mates) {
  return std::count_if(mates.begin(), mates.end(), [](Index m) { return m >= 0; });
}

// Directions all round an axis, every 15 degrees.
void add_round(Vec3 a, Vec3 b, MirrorSearch& search, const Body& body, const Vector<Vec3>& pivots, bool level,
               Vector<Vec3>& candidates) {
  std::pair<double, Vec3> best[2] = {{-1e300, a}, {-1e300, b}};
  for (int k = 0; k < 12; ++k) {
    const double angle = k * 0.26179938779914944;
    const Vec3 v = cosine(angle) * a + sine(angle) * b;
    // By pairs alone: an axis that joints hardly leave has none that lack one.
    const double score = static_cast<double>(count_mates(search.look(v, false).mates));
    if (score > best[0].first) {
      best[1] = best[0];
      best[0] = {score, v};
    } else if (score > best[1].first)
      best[1] = {score, v};
  }
  for (auto& [score, v] : best) {
    for (int round = 0; round < 2; ++round) {
      const Plane plane = search.look(v, false);
      if (count_mates(plane.mates) > 1) v = refined(body, plane, pivots, level);
    }
    if (norm(snap(v) - v) == 0) candidates.push_back(v);
  }
}

// Across the direction in which the joints spread most; along the level, where up is known.
Vec3 narrowest(const Body& body, const Vector<Vec3>& candidates, bool level) {
  Vec3 sum;
  double count = 0;
  for (Index j = 0; j < body.count; ++j) {
    if (body.kept[at(j)]) {
      sum = sum + body.pivots[at(j)];
      count += 1;
    }
  }
  const Vec3 mean = (1 / count) * sum;
  Mat3 moments = Mat3::Zero();
  for (Index j = 0; j < body.count; ++j) {
    Vec3 d = body.pivots[at(j)] - mean;
    if (level) d = d - dot(d, body.up) * body.up;
    const hf_eigen::Vector3d v(d.x, d.y, d.z);
    if (body.kept[at(j)]) moments += v * v.transpose();
  }
  Mat3 axes = principal_axes(moments).axes;
  fix_signs(axes);
  const Vec3 longest{axes(0, 0), axes(1, 0), axes(2, 0)};
  if (level && moments.trace() > 0) return snap(unit_vector(cross(body.up, longest)));
  Vec3 best = candidates[0];
  for (const Vec3& c : candidates) {
    if (std::fabs(dot(c, longest)) < std::fabs(dot(best, longest))) best = c;
  }
  return best;
}

// Returns the number that clips add to the score of a plane, because a clip leads along the plane of symmetry. It is at
// most the difference between two planes that are not sure.
double travel_bonus(const Body& body, Vec3 left) {
  double across = 0, count = 0;
  for (std::uint32_t k = 0; k < body.input.travel_count; ++k) {
    const Vec3 way = body.travel(k);
    if (!(norm(way) > 0)) continue;
    across += std::fabs(dot(way, left));
    count += 1;
  }
  return count > 0 ? 2 * unsure * (1 - across / count) : 0;
}

// Across the way that clips lead, forward or backward; of length 0 where none leads anywhere.
Vec3 across_travels(const Body& body) {
  Vec3 sum;
  for (std::uint32_t k = 0; k < body.input.travel_count; ++k) {
    const Vec3 way = body.travel(k);
    sum = dot(sum, way) < 0 ? sum - way : sum + way;
  }
  const Vec3 left = cross(body.up, sum);
  return norm(left) > 0 ? unit_vector(left) : Vec3{};
}

struct Choice {
  Vec3 left;
  double score = -1e300, margin = 0;
  std::ptrdiff_t pairs = 0;
};

Choice best_of(const Body& body, const Vector<Vec3>& candidates, MirrorSearch& search, bool with_skin) {
  Choice best;
  Vector<double> scores(candidates.size(), 0.0, candidates.get_allocator());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Plane plane = search.look(candidates[k], with_skin);
    scores[k] = plane.score + (is_straight(candidates[k]) ? central : 0) + travel_bonus(body, candidates[k]);
    best.pairs = std::max(best.pairs, count_mates(plane.mates));
    if (scores[k] > best.score) {
      best.score = scores[k];
      best.left = candidates[k];
    }
  }
  double next = -1e300;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (std::fabs(dot(candidates[k], best.left)) < snapped) next = std::max(next, scores[k]);
  }
  best.margin = best.score - next;
  return best;
}

void find_plane(Body& body, MirrorSearch& search) {
  Vector<Vec3> candidates(&body.memory);
  const bool level = body.input.up != nullptr;
  for (const Vec3& axis : coordinate_axes) {
    if (!level || std::fabs(dot(axis, body.up)) < 0.5) candidates.push_back(axis);
  }
  if (level) {
    const Vec3 a = candidates[0], b = unit_vector(cross(body.up, a));
    add_round(a, b, search, body, body.pivots, true, candidates);
  } else {
    for (int k = 0; k < 3; ++k)
      add_round(coordinate_axes[k], coordinate_axes[(k + 1) % 3], search, body, body.pivots, false, candidates);
  }
  Choice choice = best_of(body, candidates, search, true);
  if (choice.pairs < 4) {
    const Vec3 across = level ? across_travels(body) : Vec3{};
    const bool led = norm(across) > 0;
    choice.left = led ? snap(across) : narrowest(body, candidates, level);
    body.say(led ? "No joints mirror each other: the side axis is at a right angle to the travel of clips."
                 : "No joints mirror each other: the side axis is where the joints spread least.");
  }
  body.left = choice.left;
  body.mirror_score = choice.score;
  body.mirror_margin = choice.margin;
  const Plane plane = search.look(body.left, false, true);
  take_plane(body, plane);
  body.offset = offset_of_pairs(body, plane.offset);
  body.say("The plane of symmetry has a score of %.2f, the next best %.2f.", choice.score,
           choice.score - choice.margin);
}

// Places of the joints when the skin was bound: symmetric where the rest pose is not.
Vector<Vec3> bind_pivots(const Body& body) {
  Vector<Vec3> out(body.pivots, &body.memory);
  for (Index j = 0; j < body.count; ++j) {
    const double* m = body.input.inverse_binds + 16 * at(j);
    if (!body.kept[at(j)]) continue;
    Mat3 turn;
    turn << m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10];
    const double volume = turn.determinant();
    if (!(std::fabs(volume) > 1e-30) || !std::isfinite(volume)) return Vector<Vec3>(&body.memory);
    const hf_eigen::Vector3d place = -(turn.inverse() * hf_eigen::Vector3d(m[12], m[13], m[14]));
    out[at(j)] = {place.x(), place.y(), place.z()};
    if (!place.allFinite()) return Vector<Vec3>(&body.memory);
  }
  Box box;
  for (Index j = 0; j < body.count; ++j) {
    if (body.kept[at(j)]) box.add(out[at(j)]);
  }
  const double size = norm(box.high - box.low);
  if (!(size > 0)) out.clear();
  for (Vec3& p : out) p = (1 / size) * (p - box.middle());
  return out;
}

// A rest pose in mid-stride is not symmetric; the bind pose may be.
void look_at_bind_pose(Body& body, Index main) {
  if (!body.input.inverse_binds || body.mirror_score >= 3 * unsure) return;
  const Vector<Vec3> pivots = bind_pivots(body);
  if (pivots.empty()) return;
  MirrorSearch search(body, main, pivots, pivots);
  Vector<Vec3> candidates(std::begin(coordinate_axes), std::end(coordinate_axes), &body.memory);
  const Choice choice = best_of(body, candidates, search, false);
  if (choice.score <= body.mirror_score + 2 * unsure) return;
  const Plane plane = search.look(choice.left, false, true);
  if (count_mates(plane.mates) < 4) return;
  std::fill(body.mates.begin(), body.mates.end(), -1);
  take_plane(body, plane);
  body.left = snap(refined(body, plane, body.pivots, body.input.up != nullptr));
  body.offset = offset_of_pairs(body, body.offset);
  body.mirror_score = choice.score;
  body.mirror_margin = choice.margin;
  body.say("The rest pose is not symmetric; the pose of binding has a plane with a score of %.2f.", choice.score);
}

// The root of the piece that owns most vertices.
Index heaviest_root(const Body& body) {
  Vector<Index> roots(at(body.count), -1, &body.memory);
  Vector<std::size_t> weights(at(body.count), 0, &body.memory);
  Index best = -1;
  for (const Index j : body.order) {
    if (!body.kept[at(j)]) continue;
    const Index p = body.carriers[at(j)];
    const Index root = roots[at(j)] = p < 0 ? j : roots[at(p)];
    weights[at(root)] += 1 + body.owned_count(j);
  }
  for (const Index j : body.order) {
    if (body.kept[at(j)] && (best < 0 || weights[at(j)] > weights[at(best)])) best = j;
  }
  return best;
}

// The next kept joint above, across joints that were left out.
void find_carriers(Body& body) {
  body.carriers.assign(at(body.count), -1);
  for (const Index j : body.order) {
    Index p = body.parents[at(j)];
    if (p >= 0 && !body.kept[at(p)]) p = body.carriers[at(p)];
    body.carriers[at(j)] = p;
  }
}

}  // namespace

void find_mirror(Body& body) {
  body.mates.assign(at(body.count), -1);
  find_carriers(body);
  body.root = heaviest_root(body);
  if (body.input.up) body.up = unit_vector({body.input.up[0], body.input.up[1], body.input.up[2]});
  pair_names(body);
  pair_declared(body);
  MirrorSearch search(body, body.root, body.pivots, body.means);
  const NamedSides sides = sum_sides(body);
  body.sides_named = sides.pairs > 0 && norm(sides.all) > central;
  if (body.sides_named) {
    find_named_plane(body, sides, search);
    body.say("%zu pairs of names have sides; %zu of them lie the other way round.", sides.pairs, sides.against);
    body.sides_doubtful = 2 * sides.flipped > sides.pairs || 4 * sides.against > sides.pairs;
  } else {
    find_plane(body, search);
    look_at_bind_pose(body, body.root);
  }
}

}  // namespace hf_inner::skeleton
