// Which joints are of the body: those that own vertices, those between them, and those inside the skin above them.
#include <algorithm>
#include <cmath>

#include "skeleton/body.h"

namespace hf_inner::skeleton {
namespace {

void list_owned(Body& body) {
  const std::size_t n = at(body.count);
  body.owned_starts.assign(n + 1, 0);
  for (const Index owner : body.owners) {
    if (owner >= 0) ++body.owned_starts[at(owner) + 1];
  }
  for (std::size_t j = 0; j < n; ++j) body.owned_starts[j + 1] += body.owned_starts[j];
  body.owned.resize(body.owned_starts[n]);
  Vector<std::uint32_t> next(body.owned_starts.begin(), body.owned_starts.end(), &body.memory);
  for (std::size_t v = 0; v < body.owners.size(); ++v) {
    if (body.owners[v] >= 0) body.owned[next[at(body.owners[v])]++] = static_cast<std::uint32_t>(v);
  }
  body.boxes.assign(n, Box{});
  body.means.resize(n);
  for (Index j = 0; j < body.count; ++j) {
    Vec3 sum;
    for (const std::uint32_t v : body.owned_by(j)) {
      body.boxes[at(j)].add(body.points[v]);
      sum = sum + body.points[v];
    }
    const std::size_t owned = body.owned_count(j);
    body.means[at(j)] = owned > 0 ? (1.0 / static_cast<double>(owned)) * sum : body.pivots[at(j)];
    if (owned == 0) body.boxes[at(j)].add(body.pivots[at(j)]);
  }
}

// Whether the lines along axis k through p meet the skin on both sides of p.
bool between_skin(const Body& body, Vec3 p, int k) {
  const auto coordinate = [](Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
  const int a = (k + 1) % 3, b = (k + 2) % 3;
  bool above = false, below = false;
  for (std::size_t t = 0; t < body.input.triangle_count && !(above && below); ++t) {
    double u[3], v[3], w[3];
    for (int c = 0; c < 3; ++c) {
      const Vec3 d = body.points[body.input.triangles[3 * t + static_cast<std::size_t>(c)]] - p;
      u[c] = coordinate(d, a);
      v[c] = coordinate(d, b);
      w[c] = coordinate(d, k);
    }
    const double d0 = u[0] * v[1] - v[0] * u[1], d1 = u[1] * v[2] - v[1] * u[2], d2 = u[2] * v[0] - v[2] * u[0];
    if (!((d0 >= 0 && d1 >= 0 && d2 >= 0) || (d0 <= 0 && d1 <= 0 && d2 <= 0))) continue;
    const double area = d0 + d1 + d2;
    if (!(std::fabs(area) > 1e-18)) continue;
    const double height = (d1 * w[0] + d2 * w[1] + d0 * w[2]) / area;
    (height > 0 ? above : below) = true;
  }
  return above && below;
}

bool is_inside(const Body& body, Vec3 p) {
  return between_skin(body, p, 0) && between_skin(body, p, 1) && between_skin(body, p, 2);
}

bool is_bound(const Body& body, Index joint) { return !body.input.bound || body.input.bound[at(joint)]; }

// Whether a joint has a child in its own place that owns vertices: the two are one bone.
Vector<std::uint8_t> find_one_bone(const Body& body) {
  Vector<std::uint8_t> one_bone(at(body.count), 0, &body.memory);
  for (Index j = 0; j < body.count; ++j) {
    const Index p = body.parents[at(j)];
    if (p >= 0 && body.owns[at(j)] && norm(body.pivots[at(j)] - body.pivots[at(p)]) < one_place) one_bone[at(p)] = 1;
  }
  return one_bone;
}

// Whether a joint is a bone that ends where several parts of the body begin, such as a spine between two arms and a
// head. Parts below a control begin each in its own place. Two rows of bones along one trunk are one part.
Vector<std::uint8_t> find_branchings(const Body& body, const Vector<std::uint8_t>& below) {
  const std::size_t n = at(body.count);
  Vector<Index> first(n, -1, &body.memory), next(n, -1, &body.memory);
  for (Index j = 0; j < body.count; ++j) {
    const Index p = body.parents[at(j)];
    if (p >= 0 && below[at(j)] && next[at(p)] < 0) next[at(p)] = j;
  }
  const auto one_row = [&](Index a, Index b) {
    const Index c = next[at(a)], d = next[at(b)];
    return c >= 0 && d >= 0 && norm(body.pivots[at(c)] - body.pivots[at(d)]) < one_place;
  };
  Vector<std::uint8_t> parts(n, 0, &body.memory), apart(n, 0, &body.memory);
  for (Index j = 0; j < body.count; ++j) {
    const Index p = body.parents[at(j)];
    if (p < 0 || !below[at(j)]) continue;
    if (first[at(p)] < 0) first[at(p)] = j;
    parts[at(p)] |= first[at(p)] != j && !one_row(first[at(p)], j);
    apart[at(p)] |= norm(body.pivots[at(j)] - body.pivots[at(first[at(p)])]) >= one_place;
    apart[at(p)] |= norm(body.pivots[at(j)] - body.pivots[at(p)]) < one_place;
  }
  for (std::size_t j = 0; j < n; ++j) parts[j] = parts[j] && !apart[j];
  return parts;
}

// Joints that own nothing and stand above all owners: a spine that other joints deform for is inside, a root on the
// ground is not.
void keep_inner_joints(Body& body, const Vector<std::uint8_t>& below) {
  const Vector<std::uint8_t> one_bone = find_one_bone(body), branchings = find_branchings(body, below);
  std::size_t tests = 0;
  for (std::size_t k = body.order.size(); k-- > 0 && tests < inside_tests;) {
    const Index j = body.order[k];
    if (body.kept[at(j)] || !below[at(j)] || !is_bound(body, j)) continue;
    if (one_bone[at(j)] || branchings[at(j)]) {
      body.kept[at(j)] = 1;
      continue;
    }
    ++tests;
    if (is_inside(body, body.pivots[at(j)])) body.kept[at(j)] = 1;
  }
}

// Sets the kinds of joints that were not kept: ends of chains, and helpers.
void name_kinds(Body& body, const Vector<std::uint8_t>& below) {
  std::uint32_t helpers = 0;
  body.kinds.assign(at(body.count), JointKind::helper);
  for (const Index j : body.order) {
    const Index p = body.parents[at(j)];
    JointKind& kind = body.kinds[at(j)];
    if (body.kept[at(j)])
      kind = JointKind::body;
    else if (!below[at(j)] && p >= 0 && body.kept[at(p)] && is_bound(body, j))
      kind = JointKind::end;
    helpers += kind == JointKind::helper && is_bound(body, j);
  }
  if (helpers > 0) body.say("%u joints move no vertex: controls, targets or roots.", helpers);
}

}  // namespace

void find_owners(Body& body) {
  list_owned(body);
  const std::size_t n = at(body.count);
  Vector<std::uint8_t> below(n, 0, &body.memory), above(n, 0, &body.memory);
  const bool bare = std::find(body.owns.begin(), body.owns.end(), 1) == body.owns.end();
  if (bare) {
    body.say("No joint owns a vertex: controls cannot be told from the body.");
    for (std::size_t j = 0; j < n; ++j)
      body.owns[j] = is_bound(body, static_cast<Index>(j)) && !body.is_stray(static_cast<Index>(j));
  }
  for (std::size_t k = n; k-- > 0;) {
    const Index j = body.order[k], p = body.parents[at(j)];
    below[at(j)] |= body.owns[at(j)];
    if (p >= 0) below[at(p)] |= below[at(j)];
  }
  body.kept.assign(n, 0);
  for (const Index j : body.order) {
    const Index p = body.parents[at(j)];
    above[at(j)] = p >= 0 && (above[at(p)] || body.owns[at(p)]);
    const bool declared = body.input.roles && body.input.roles[at(j)] >= 0;
    body.kept[at(j)] =
        (body.owns[at(j)] || (below[at(j)] && above[at(j)]) || declared) && (is_bound(body, j) || declared);
  }
  keep_inner_joints(body, below);
  name_kinds(body, below);
}

}  // namespace hf_inner::skeleton
