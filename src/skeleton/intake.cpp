// Reads what a caller gives: joints become world pivots and frames, vertices get their owners.
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "base/arguments.h"
#include "skeleton/body.h"
#include "skeleton/rest_transforms.h"

namespace hf_inner::skeleton {

void Box::add(Vec3 p) noexcept {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

void Box::add(const Box& other) noexcept {
  if (other.empty()) return;
  add(other.low);
  add(other.high);
}

Body::Body(const CharacterInput& given, Memory& m)
    : input(given),
      memory(m),
      pivots(&m),
      frames(&m),
      flipped(&m),
      parents(&m),
      order(&m),
      enter(&m),
      leave(&m),
      names(&m),
      points(&m),
      owners(&m),
      owned_starts(&m),
      owned(&m),
      boxes(&m),
      means(&m),
      owns(&m),
      kept(&m),
      kinds(&m),
      carriers(&m),
      tree(&m),
      child_starts(&m),
      children(&m),
      ends(&m),
      places(&m),
      reaches(&m),
      mates(&m),
      limbs(&m),
      roles(&m),
      sides(&m),
      numbers(&m),
      why(&m),
      up_why(&m),
      forward_why(&m) {}

void Body::say(const char* format, ...) {
  char text[400];
  std::va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (length <= 0) return;
  why.insert(why.end(), text, text + std::min<std::size_t>(static_cast<std::size_t>(length), sizeof text - 1));
  why.push_back('\n');
}

void add_reason(Vector<char>& reasons, const char* words) {
  for (const char* c = reasons.empty() ? "" : ", "; *c; ++c) reasons.push_back(*c);
  for (; *words; ++words) reasons.push_back(*words);
}

Vec3 Body::travel(std::uint32_t clip) const noexcept {
  const double* t = input.travels + 3 * std::size_t{clip};
  const Vec3 way = (1 / scale) * Vec3{t[0], t[1], t[2]}, level = input.up ? way - dot(way, up) * up : way;
  return norm(level) < travelled ? Vec3{} : unit_vector(level);
}

bool Body::is_stray(Index joint) const noexcept {
  while (parents[at(joint)] >= 0) joint = parents[at(joint)];
  return leave[at(joint)] - enter[at(joint)] < 2 && count >= 10;
}

double Body::lowest_below(Index joint, Vec3 axis) const noexcept {
  double lowest = 1e300;
  for_points_below(joint, [&](Vec3 p) { lowest = std::min(lowest, dot(p, axis)); });
  if (lowest < 1e300) return lowest;
  for (const Index j : subtree(joint)) lowest = std::min(lowest, dot(pivots[at(j)], axis));
  return lowest;
}

Vec3 Body::mean_below(Index joint) const noexcept {
  Vec3 sum;
  for (const Index j : subtree(joint)) sum = sum + means[at(j)];
  return (1.0 / static_cast<double>(subtree(joint).size())) * sum;
}

namespace {

// The rotation of a transform: its columns made perpendicular. A flipped one keeps x and y and turns z round.
RestFrame frame_of(const Transform& t) noexcept {
  RestFrame frame;
  frame.origin = t.origin;
  frame.y = unit_vector(t.y);
  if (!(norm(frame.y) > 0)) frame.y = {0, 1, 0};
  frame.x = unit_vector(t.x - dot(t.x, frame.y) * frame.y);
  if (!(norm(frame.x) > 0))
    frame.x = unit_vector(cross(frame.y, std::fabs(frame.y.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  frame.z = cross(frame.x, frame.y);
  return frame;
}

// Parents before children, brothers in the order of their numbers. A joint that no root leads to is on a cycle.
void sort_joints(Body& body) {
  const std::size_t n = at(body.count);
  Vector<Index> first(n, -1, &body.memory), next(n, -1, &body.memory), roots(&body.memory), stack(&body.memory);
  for (std::size_t j = n; j-- > 0;) {
    const Index p = body.parents[j];
    if (p < 0) {
      stack.push_back(static_cast<Index>(j));
    } else {
      next[j] = first[at(p)];
      first[at(p)] = static_cast<Index>(j);
    }
  }
  body.enter.assign(n, -1);
  body.leave.assign(n, 0);
  while (!stack.empty()) {
    const Index j = stack.back();
    stack.pop_back();
    body.enter[at(j)] = static_cast<Index>(body.order.size());
    body.order.push_back(j);
    const std::size_t begin = stack.size();
    for (Index c = first[at(j)]; c >= 0; c = next[at(c)]) stack.push_back(c);
    std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(begin), stack.end());
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (body.enter[j] < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(j),
           "joint %zu is its own ancestor; parents must lead to a joint with parent -1", j);
  }
  for (std::size_t k = n; k-- > 0;) {
    const Index j = body.order[k];
    body.leave[at(j)] = std::max(body.leave[at(j)], body.enter[at(j)]);
    if (const Index p = body.parents[at(j)]; p >= 0) body.leave[at(p)] = std::max(body.leave[at(p)], body.leave[at(j)]);
  }
}

void check_declared(const CharacterInput& in) {
  for (std::size_t j = 0; j < in.joint_count; ++j) {
    if (in.roles && (in.roles[j] < -1 || in.roles[j] >= role_count))
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(j), "roles[%zu] is %d; it must be -1 to %d", j,
           in.roles[j], role_count - 1);
    if (in.roles && in.roles[j] >= 0 && in.sides && (in.sides[j] < 0 || in.sides[j] > 2))
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(j), "sides[%zu] is %d; it must be 0 to 2", j,
           in.sides[j]);
  }
  for (const auto& [axis, name] : {std::pair{in.up, "up"}, std::pair{in.forward, "forward"}}) {
    if (axis && (!is_finite_point(axis) || !(norm(unit_vector({axis[0], axis[1], axis[2]})) > 0)))
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
           "%s is no direction; give three finite numbers that are not all 0, or NULL", name);
  }
}

void check_travels(const CharacterInput& in) {
  require_list(in.travel_count, in.travels, "travel_count", "travels");
  for (std::uint32_t k = 0; k < in.travel_count; ++k) {
    if (!is_finite_point(in.travels + 3 * std::size_t{k}))
      fail(HF_ERROR_NON_FINITE, k, "travel %u has a number that is not finite", k);
  }
}

// The heaviest joint of a vertex. Weights that are no numbers count as 0.
Index owner_of(const CharacterInput& in, std::size_t v, Vector<double>& weights) {
  Index best = -1;
  double most = 0;
  if (in.influence_starts) {
    for (std::uint32_t k = in.influence_starts[v]; k < in.influence_starts[v + 1]; ++k) {
      const double w = in.influence_weights ? in.influence_weights[k] : 1.0;
      const std::uint32_t j = in.influence_joints[k];
      if (j >= in.joint_count)
        fail(HF_ERROR_OUT_OF_RANGE, k, "influence_joints[%u] is %u; there are %u joints", k, j, in.joint_count);
      if (!(w > 0) || !std::isfinite(w)) continue;
      weights[j] += w;
      if (w > most) {
        most = w;
        best = static_cast<Index>(j);
      }
    }
  }
  if (best >= 0 || !in.vertex_joints) return best;
  const std::int32_t j = in.vertex_joints[v];
  if (j < -1 || j >= static_cast<std::int32_t>(in.joint_count))
    fail(HF_ERROR_OUT_OF_RANGE, static_cast<std::uint32_t>(v), "vertex_joints[%zu] is %d; it must be -1 to %u", v, j,
         in.joint_count - 1);
  if (j >= 0) weights[at(j)] += 1;
  return j;
}

void check_triangles(const CharacterInput& in) {
  if (in.triangle_count > 0) require(in.triangles, "triangles");
  for (std::size_t k = 0; k < 3 * std::size_t{in.triangle_count}; ++k) {
    if (in.triangles[k] >= in.vertex_count)
      fail(HF_ERROR_OUT_OF_RANGE, static_cast<std::uint32_t>(k / 3),
           "triangle %zu names vertex %u; there are %u vertices", k / 3, in.triangles[k], in.vertex_count);
  }
}

void check_influences(const CharacterInput& in) {
  if (!in.influence_starts) return;
  for (std::size_t v = 0; v < in.vertex_count; ++v) {
    if (in.influence_starts[v] > in.influence_starts[v + 1])
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(v),
           "influence_starts[%zu] is above the next; it must rise", v);
  }
  if (in.vertex_count > 0 && in.influence_starts[in.vertex_count] > 0) require(in.influence_joints, "influence_joints");
}

// Moves everything into a box of diagonal 1 about the origin.
void normalise(Body& body) {
  Box box;
  for (const Vec3& p : body.points) box.add(p);
  for (Index j = 0; j < body.count && body.points.empty(); ++j) {
    if (!body.is_stray(j)) box.add(body.pivots[at(j)]);
  }
  body.centre = box.middle();
  body.scale = norm(box.high - box.low);
  if (!(body.scale > 0) || !std::isfinite(body.scale)) {
    body.say("All points are at one place: nothing can be known.");
    body.scale = 1;
  }
  const auto moved = [&](Vec3 p) { return (1 / body.scale) * (p - body.centre); };
  for (Vec3& p : body.points) p = moved(p);
  for (Vec3& p : body.pivots) p = moved(p);
}

}  // namespace

void read_joints(Body& body) {
  const CharacterInput& in = body.input;
  require_list(in.joint_count, in.parents, "joint_count", "parents");
  if (in.joint_count > most_joints)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "joint_count is %u; at most %u are taken", in.joint_count, most_joints);
  require_either(in.matrices, in.trs, "matrices and trs");
  check_declared(in);
  if (in.travel_count > 0) check_travels(in);
  const std::size_t n = in.joint_count;
  if (in.bound && std::find(in.bound, in.bound + n, 1) == in.bound + n)
    fail(HF_ERROR_EMPTY, HF_NO_INDEX,
         "bound is 0 for every joint; set it to 1 for the joints of the skin, or give NULL");
  body.count = static_cast<Index>(n);
  body.parents.assign(in.parents, in.parents + n);
  for (std::size_t j = 0; j < n; ++j) {
    if (body.parents[j] < -1 || body.parents[j] >= body.count)
      fail(HF_ERROR_OUT_OF_RANGE, static_cast<std::uint32_t>(j), "parents[%zu] is %d; it must be -1 to %u", j,
           body.parents[j], in.joint_count - 1);
  }
  sort_joints(body);
  Vector<Transform> world(n, &body.memory);
  body.pivots.resize(n);
  body.frames.resize(n);
  body.flipped.assign(n, 0);
  for (const Index j : body.order) {
    const Transform local = local_transform(in, at(j));
    const Index p = body.parents[at(j)];
    const Transform& t = world[at(j)] = p < 0 ? local : world[at(p)] * local;
    if (!std::isfinite(t.origin.x + t.origin.y + t.origin.z))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(j),
           "the rest transforms above joint %d leave the range of numbers", j);
    body.pivots[at(j)] = t.origin;
    body.frames[at(j)] = frame_of(t);
    body.flipped[at(j)] = dot(cross(t.x, t.y), t.z) < 0;
  }
}

void read_vertices(Body& body) {
  const CharacterInput& in = body.input;
  if (in.vertex_count > 0) require(in.positions, "positions");
  check_triangles(in);
  check_influences(in);
  const std::size_t n = at(body.count), vertices = in.vertex_count;
  body.points.resize(vertices);
  body.owners.resize(vertices);
  Vector<double> weights(n, 0.0, &body.memory);
  for (std::size_t v = 0; v < vertices; ++v) {
    const double* p = in.positions + 3 * v;
    if (!is_finite_point(p)) fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(v), "position %zu is not finite", v);
    body.points[v] = {p[0], p[1], p[2]};
    body.owners[v] = owner_of(in, v, weights);
  }
  normalise(body);
  body.owns.assign(n, 0);
  // A joint that no skin names passes its vertices to the next that one does.
  Vector<Index> stands_for(n, &body.memory);
  for (const Index j : body.order) {
    const Index p = body.parents[at(j)];
    stands_for[at(j)] = in.bound && !in.bound[at(j)] && p >= 0 ? stands_for[at(p)] : j;
    if (stands_for[at(j)] != j) {
      weights[at(stands_for[at(j)])] += weights[at(j)];
      weights[at(j)] = 0;
    }
  }
  for (Index& owner : body.owners) {
    if (owner < 0) continue;
    owner = stands_for[at(owner)];
    body.owns[at(owner)] = !in.bound || in.bound[at(owner)];
  }
  // Below an owner any weight counts; above, stray weights do not make one.
  double total = 0;
  for (const double w : weights) total += w;
  Vector<std::uint8_t> below(n, 0, &body.memory);
  for (const Index j : body.order) {
    const Index p = body.parents[at(j)];
    if (p >= 0) below[at(j)] = below[at(p)] || body.owns[at(p)];
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (below[j] && weights[j] > 1e-9 * total) body.owns[j] = 1;
  }
}

}  // namespace hf_inner::skeleton
