#include "quads/poles.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/error.h"
#include "field/vector_field.h"
#include "remesh/relax.h"

namespace hf_inner::quads {
namespace {

// A direction whose part along the surface is a smaller share of it says little: the noise of the normal decides.
constexpr double least_along = 0.1;
// Cosine of the largest turn from the normal of the irregular vertex to the normal of a vertex of the ring; a turn by
// 180 degrees has no axis.
constexpr double largest_turn = -0.9;

// The figures are of the 36 poles of poles_test on a torus and a sphere, without relaxation. The aspect is the mean of
// the quads within four edges.

// A vertex within this many edges of an irregular vertex is its own. 96 % of poles have one. With half, the vertices of
// some poles stay up to 0.67 edges away; double gives the same quads.
constexpr double pole_reach = 1;
// Walks to the place of an irregular vertex. With one, a vertex ends up to 0.005 edges away; with two, three and six,
// all are less than 0.00005 away.
constexpr int pole_walks = 2;
// Quads around an irregular vertex that move along, and in how many rounds. More are slower. The aspect is 1.38. With 2
// and 6 rings and with 2 rounds it is at most 1.39, with 10 rounds 1.43.
constexpr std::int32_t pole_rings = 3, pole_rounds = 5;

Index nearest_vertex(const mesh::Mesh& mesh, Vec3 place) noexcept {
  Index nearest = 0;
  double least = -1;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 d = mesh.positions[at(v)] - place;
    if (const double square = dot(d, d); least < 0 || square < least) {
      least = square;
      nearest = v;
    }
  }
  return nearest;
}

// Calls use(triangle) for the triangles at a vertex, those with two edges there twice.
template <class Use>
void for_triangles(const mesh::Topology& topology, Index v, Use&& use) {
  for (Index k = topology.neighbour_start[at(v)]; k < topology.neighbour_start[at(v) + 1]; ++k) {
    const std::size_t e = at(topology.neighbour_edge[at(k)]);
    for (Index i = topology.edge_triangle_start[e]; i < topology.edge_triangle_start[e + 1]; ++i)
      use(topology.triangle(i));
  }
}

// A point of the triangles at a vertex near a place, which may hover beside them.
Vec3 onto(const surface::Core& core, Index vertex, Vec3 place) {
  Vec3 nearest = core.mesh.positions[at(vertex)];
  double least = norm(nearest - place);
  for_triangles(core.topology(), vertex, [&](Index t) {
    const Index* corner = core.mesh.triangle(t);
    const Vec3 p[3] = {core.mesh.positions[at(corner[0])], core.mesh.positions[at(corner[1])],
                       core.mesh.positions[at(corner[2])]};
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    double share[3], sum = 0;
    for (int k = 0; k < 3; ++k) {
      share[k] = std::max(0.0, dot(cross(p[(k + 1) % 3] - place, p[(k + 2) % 3] - place), normal));
      sum += share[k];
    }
    if (!(sum > 0)) return;
    const Vec3 point = (share[0] / sum) * p[0] + (share[1] / sum) * p[1] + (share[2] / sum) * p[2];
    if (norm(point - place) < least) {
      least = norm(point - place);
      nearest = point;
    }
  });
  return nearest;
}

// The vertices that are edge-connected to the first one within a radius of a point, and those beside them.
struct PoleRing {
  PoleRing(const surface::Core& core, Index first, Vec3 point, double radius, Memory& memory)
      : inside(&memory), around(&memory) {
    const mesh::Topology& topology = core.topology();
    Vector<std::uint8_t> seen(at(core.size()), 0, &memory);
    inside.push_back(first);
    seen[at(first)] = 1;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const Index v = inside[i];
      for (Index k = topology.neighbour_start[at(v)]; k < topology.neighbour_start[at(v) + 1]; ++k) {
        const Index u = topology.neighbour[at(k)];
        if (seen[at(u)]) continue;
        seen[at(u)] = 1;
        (norm(core.mesh.positions[at(u)] - point) <= radius ? inside : around).push_back(u);
      }
    }
    std::sort(around.begin(), around.end());
  }
  Vector<Index> inside, around;
};

// The part of a direction across `up`, of length 1; without one, the part of an axis of space.
Vec3 in_plane(Vec3 up, Vec3 direction) noexcept {
  const Vec3 part = direction - dot(direction, up) * up;
  if (norm(part) > least_along * norm(direction)) return unit_vector(part);
  const double size[3] = {std::fabs(up.x), std::fabs(up.y), std::fabs(up.z)};
  const Vec3 axis = size[0] <= size[1] && size[0] <= size[2] ? Vec3{1, 0, 0}
                    : size[1] <= size[2]                     ? Vec3{0, 1, 0}
                                                             : Vec3{0, 0, 1};
  return unit_vector(axis - dot(axis, up) * up);
}

// Turns a vector across `up` by the smallest turn from `up` to a normal.
Vec3 turned(Vec3 vector, Vec3 up, Vec3 normal) noexcept {
  const Vec3 axis = cross(up, normal), first = cross(axis, vector);
  return vector + first + (1 / (1 + std::max(dot(normal, up), largest_turn))) * cross(axis, first);
}

}  // namespace

void add_pole_guides(const surface::Core& core, Span<const QuadPole> poles, double radius, Vector<QuadGuide>& out) {
  for (std::size_t i = 0; i < poles.size(); ++i) {
    poll();
    const QuadPole& pole = poles[i];
    const Index first = nearest_vertex(core.mesh, pole.place);
    const Vec3 point = onto(core, first, pole.place);
    const PoleRing ring(core, first, point, radius, *core.memory);
    Vec3 up;
    for (const Index v : ring.inside) up = up + core.areas[at(v)] * field::vertex_normal(core.mesh, core.topology(), v);
    up = unit_vector(up);
    if (!(norm(up) > 0))
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(i),
           "the surface has no normal at irregular_points[%zu]", i);
    const Vec3 x = in_plane(up, pole.direction), y = cross(up, x);
    for (const Index v : ring.around) {
      const Vec3 arm = core.mesh.positions[at(v)] - point;
      const double angle = 0.25 * (4 - pole.quads) * arc_tangent(dot(arm, y), dot(arm, x));
      const Vec3 vector = cosine(angle) * x + sine(angle) * y;
      out.push_back(
          {v, turned(vector, up, field::vertex_normal(core.mesh, core.topology(), v)), 1.0, QuadGuide::of_pole});
    }
  }
}

std::int32_t hold_poles(const remesh::FluxSurface& surface, Span<const QuadPole> poles, double edge_length,
                        remesh::QuadMesh& mesh, Memory& memory) {
  if (poles.empty()) return 0;
  const std::int32_t n = mesh.position.size();
  remesh::Table<std::int32_t> valence(n, 0, memory);
  for (const std::int32_t v : mesh.corner) ++valence[v];
  remesh::Table<std::uint8_t> moving(n, 0, memory);
  std::int32_t held = 0;
  for (const QuadPole& pole : poles) {
    std::int32_t best = -1;
    double least = pole_reach * edge_length;
    for (std::int32_t v = 0; v < n; ++v) {
      if (valence[v] != pole.quads || mesh.pinned[v] || mesh.border[v]) continue;
      if (const double d = norm(mesh.position[v] - pole.place); d < least) {
        least = d;
        best = v;
      }
    }
    if (best < 0) continue;
    // Each walk along the surface ends nearer to the place: it starts in another tangent plane.
    for (int walk = 0; walk < pole_walks; ++walk) {
      mesh.location[best] = remesh::walk_surface(surface, mesh.location[best], pole.place - mesh.position[best]);
      mesh.position[best] = remesh::position_of(surface, mesh.location[best]);
    }
    mesh.pinned[best] = remesh::QuadMesh::feature;
    moving[best] = 1;
    ++held;
  }
  if (held == 0) return 0;
  remesh::grow_marks(mesh, pole_rings, moving);
  remesh::RelaxOptions relax;
  relax.rounds = pole_rounds;
  relax.edge_length = edge_length;
  relax.moving = &moving;
  remesh::relax_quads(surface, mesh, relax, memory);
  return held;
}

}  // namespace hf_inner::quads
