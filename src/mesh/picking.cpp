#include "mesh/picking.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/arguments.h"
#include "base/index.h"
#include "mesh/places.h"

namespace hf_inner::mesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Triangles or vertices of one thread's job, some 0.1 ms: smaller jobs cost more to hand out, larger ones leave threads
// idle. No result depends on it. On 90,000 triangles and two threads, half and a quarter take about 10 % longer, double
// and four times the same.
constexpr std::size_t piece = 16384;

std::uint32_t pieces_of(std::size_t count) { return static_cast<std::uint32_t>((count + piece - 1) / piece); }

// Gives the positions of welded vertices in the frame of the search. For a surface at rest this is the library's
// centred and scaled frame. For a posed surface it is the caller's frame.
class Frame {
 public:
  explicit Frame(const PickTarget& target) noexcept : mesh_(target.mesh), posed_(target.posed) {}
  Vec3 of(Index v) const noexcept {
    if (!posed_) return mesh_.positions[at(v)];
    const std::size_t row = at(mesh_.given_of_inner[at(v)]);
    return {posed_.get(row, 0), posed_.get(row, 1), posed_.get(row, 2)};
  }
  void check(Index v, Vec3 p) const {
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) return;
    const std::uint32_t given = static_cast<std::uint32_t>(mesh_.given_of_inner[at(v)]);
    fail(HF_ERROR_NON_FINITE, given, "the position of vertex %u is not finite", given);
  }
  Vec3 point_in(Vec3 p) const noexcept { return posed_ ? p : mesh_.to_inner(p); }
  Vec3 direction_in(Vec3 d) const noexcept { return posed_ ? d : (1.0 / mesh_.scale) * d; }
  Vec3 point_out(Vec3 p) const noexcept { return posed_ ? p : mesh_.to_given(p); }
  double length_out(double length) const noexcept { return posed_ ? length : mesh_.scale * length; }

 private:
  const Mesh& mesh_;
  const ConstRows posed_;
};

// Shears space so that the ray runs along the last axis.
struct Shear {
  Shear(Vec3 origin, Vec3 direction) noexcept : from(origin) {
    const std::array<double, 3> d = {direction.x, direction.y, direction.z};
    axis[2] = 0;
    for (std::size_t k = 1; k < 3; ++k) axis[2] = std::fabs(d[k]) > std::fabs(d[axis[2]]) ? k : axis[2];
    axis[0] = (axis[2] + 1) % 3;
    axis[1] = (axis[2] + 2) % 3;
    if (d[axis[2]] < 0) std::swap(axis[0], axis[1]);  // keeps the orientation of triangles
    x = d[axis[0]] / d[axis[2]];
    y = d[axis[1]] / d[axis[2]];
    z = 1 / d[axis[2]];
  }
  Vec3 of(Vec3 p) const noexcept {
    const std::array<double, 3> q = {p.x - from.x, p.y - from.y, p.z - from.z};
    return {q[axis[0]] - x * q[axis[2]], q[axis[1]] - y * q[axis[2]], z * q[axis[2]]};
  }
  Vec3 from;
  std::array<std::size_t, 3> axis{};
  double x = 0, y = 0, z = 0;
};

struct Candidate {
  std::uint32_t triangle = HF_NO_INDEX;  // inner
  double distance = infinity;
  double weight[3] = {0, 0, 0};
};

// Tests a triangle with sheared corners, and keeps its hit if the hit is nearer than the best so far.
void test_triangle(const Vec3* corner, bool front_only, std::uint32_t triangle, Candidate& best) noexcept {
  const Vec3 &a = corner[0], &b = corner[1], &c = corner[2];
  const double u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
  const bool behind = u <= 0 && v <= 0 && w <= 0, front = u >= 0 && v >= 0 && w >= 0;
  if (!behind && !front) return;
  const double determinant = u + v + w;
  if (determinant == 0 || (front_only && !front)) return;
  const double distance = (u * a.z + v * b.z + w * c.z) / determinant;
  if (!(distance >= 0 && distance < best.distance)) return;
  best.triangle = triangle;
  best.distance = distance;
  best.weight[0] = u / determinant;
  best.weight[1] = v / determinant;
  best.weight[2] = w / determinant;
}

// Returns the first of the caller's triangles that lie on usable triangle t. along: the first that runs as t does.
std::uint32_t given_of(const Mesh& mesh, Index t, bool along) noexcept {
  const std::uint32_t first = mesh.given_of_triangle(t);
  bool against = false;
  for (const Mesh::Doubled& entry : mesh.doubled) {
    if (!along || mesh.triangle_of_given[at(entry.given)] != mesh.triangle_of_given[first]) continue;
    if (!entry.mirrored && against) return static_cast<std::uint32_t>(entry.given);
    if (static_cast<std::uint32_t>(entry.given) == first) against = entry.mirrored;
  }
  return first;
}

}  // namespace

PickTarget read_target(const Mesh& mesh, const hf_pick_desc& desc) {
  check_flag(desc.front_only, "front_only");
  return {mesh, read_reals(desc.positions, 3, mesh.report.vertex_count, "vertices", "positions"), desc.front_only == 1};
}

Vec3 read_direction(const double* direction) {
  const Vec3 along = read_point(direction, "direction");
  if (along.x == 0 && along.y == 0 && along.z == 0)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "direction is 0; a ray needs one");
  return along;
}

RayHit cast_ray(const PickTarget& target, Vec3 origin, Vec3 direction, JobRunner& jobs, Memory& memory) {
  const Mesh& mesh = target.mesh;
  const Frame places(target);
  const Shear shear(places.point_in(origin), places.direction_in(direction));
  const std::size_t triangles = at(mesh.triangle_count());
  // Numbers from `triangles` on stand for sides set aside. A mirrored one faces where its usable triangle does not.
  const std::size_t sides = triangles + (target.front_only ? mesh.doubled.size() : 0);
  Vector<Candidate> found(pieces_of(sides), &memory);
  const auto corners_of = [&](std::size_t t) {
    return t < triangles ? mesh.triangle(static_cast<Index>(t)) : mesh.doubled[t - triangles].corner;
  };
  jobs.for_each(pieces_of(sides), [&](std::uint32_t p) {
    for (std::size_t t = p * piece; t < std::min(sides, (p + std::size_t{1}) * piece); ++t) {
      if (t >= triangles && !mesh.doubled[t - triangles].mirrored) continue;
      const Index* v = corners_of(t);
      Vec3 corner[3];
      for (int k = 0; k < 3; ++k) {
        const Vec3 place = places.of(v[k]);
        places.check(v[k], place);
        corner[k] = shear.of(place);
      }
      test_triangle(corner, target.front_only, static_cast<std::uint32_t>(t), found[p]);
    }
  });
  Candidate best;
  for (const Candidate& candidate : found) {
    if (candidate.distance < best.distance) best = candidate;
  }
  RayHit hit;
  if (best.triangle == HF_NO_INDEX) return hit;
  hit.triangle = best.triangle < triangles ? given_of(mesh, static_cast<Index>(best.triangle), target.front_only)
                                           : static_cast<std::uint32_t>(mesh.doubled[best.triangle - triangles].given);
  hit.distance = best.distance;
  std::copy_n(best.weight, 3, hit.weight);
  const Index* v = corners_of(best.triangle);
  std::copy_n(v, 3, hit.corner);
  Vec3 p;
  for (int k = 0; k < 3; ++k) p = p + best.weight[k] * places.of(v[k]);
  hit.position = places.point_out(p);
  double nearest = infinity;
  for (int k = 0; k < 3; ++k) {
    const double distance = norm(places.of(v[k]) - p);
    if (distance < nearest) {
      nearest = distance;
      hit.vertex = v[k];
    }
  }
  return hit;
}

NearestVertex nearest_vertex(const PickTarget& target, Vec3 point, JobRunner& jobs, Memory& memory) {
  const Mesh& mesh = target.mesh;
  const Frame places(target);
  const Vec3 p = places.point_in(point);
  const std::size_t vertices = at(mesh.vertex_count());
  Vector<NearestVertex> found(pieces_of(vertices), &memory);
  jobs.for_each(pieces_of(vertices), [&](std::uint32_t i) {
    NearestVertex& best = found[i];
    best.distance = infinity;
    for (std::size_t v = i * piece; v < std::min(vertices, (i + std::size_t{1}) * piece); ++v) {
      const Vec3 place = places.of(static_cast<Index>(v));
      places.check(static_cast<Index>(v), place);
      const double distance = norm(place - p);
      const bool nearer = distance < best.distance;
      const bool earlier = distance == best.distance && best.vertex != Mesh::none &&
                           mesh.given_of_inner[v] < mesh.given_of_inner[at(best.vertex)];
      if (nearer || earlier) best = {static_cast<Index>(v), distance};
    }
  });
  NearestVertex best;
  best.distance = infinity;
  for (const NearestVertex& candidate : found) {
    const bool earlier = candidate.distance == best.distance && best.vertex != Mesh::none &&
                         candidate.vertex != Mesh::none &&
                         mesh.given_of_inner[at(candidate.vertex)] < mesh.given_of_inner[at(best.vertex)];
    if (candidate.distance < best.distance || earlier) best = candidate;
  }
  best.distance = places.length_out(best.distance);
  if (best.vertex == Mesh::none || !(best.distance <= farthest_pose * mesh.scale))
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "every vertex is more than %g box diagonals from the point; give a nearer one", farthest_pose);
  return best;
}

}  // namespace hf_inner::mesh
