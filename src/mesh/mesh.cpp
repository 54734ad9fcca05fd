#include "mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/elementary.h"
#include "base/error.h"
#include "base/hypotenuse.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/doubled_faces.h"
#include "mesh/face_intake.h"
#include "mesh/line_faces.h"
#include "mesh/union_find.h"
#include "mesh/vertex_order.h"
#include "mesh/weld.h"

namespace hf_inner::mesh {

namespace {

// The diagonal of a mesh must be below this length. Sums of squares in inner coordinates must not overflow.
constexpr double largest_scale = 1e300;
// The report counts a triangle as zero-area if its area over the longest edge squared is below this number. Its height
// is then below 2e-12 of that edge. A count for the report alone. No field depends on it.
constexpr double zero_area = 1e-12;
// Number of triangles that one thread's job takes. Half and twice the value take the same time within 10 %, the
// noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t report_piece = 65536;

// Returns the number of triangles; for faces, the triangles of their cut.
std::uint32_t check_sizes(const MeshInput& input) {
  if (input.vertex_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "there are no vertices: positions.count is 0");
  if (input.triangle_count == 0 && input.faces.face_count == 0)
    fail(HF_ERROR_EMPTY, HF_NO_INDEX, "there are no triangles: triangles.count is 0");
  if (input.vertex_count > most_elements)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u vertices; at most %u are supported", input.vertex_count, most_elements);
  const std::uint64_t triangles =
      input.faces.face_count > 0 ? count_cut_triangles(input.faces) : std::uint64_t{input.triangle_count};
  if (triangles > most_elements)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%llu triangles; at most %u are supported",
         static_cast<unsigned long long>(triangles), most_elements);
  return static_cast<std::uint32_t>(triangles);
}

void check_triangles(const MeshInput& input) {
  check_face_corners(input.faces, input.vertex_count);
  for (std::uint32_t t = 0; t < input.triangle_count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = input.triangles.get(t, static_cast<std::size_t>(k));
      if (v >= input.vertex_count) {
        fail(HF_ERROR_OUT_OF_RANGE, t, "triangle %u: corner %d is vertex %u, but there are %u vertices", t, k, v,
             input.vertex_count);
      }
    }
  }
}

void check_positions(const MeshInput& input) {
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!std::isfinite(input.positions.get(v, k)))
        fail(HF_ERROR_NON_FINITE, v, "vertex %u: coordinate %zu is not a finite number", v, k);
    }
  }
}

// Computes centre and scale from the bounding box of the vertices that are welded to the corners of triangles or faces.
// Others do not count: a vertex that is left over in a file, far away or near, changes no result. is_corner: by
// representative.
void find_frame(const MeshInput& input, const Vector<Index>& representative, const Vector<std::uint8_t>& is_corner,
                Mesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    if (!is_corner[at(representative[v])]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = input.positions.get(v, k);
      low[k] = std::min(low[k], x);
      high[k] = std::max(high[k], x);
    }
  }
  if (low[0] > high[0]) return;  // no corner: the mesh is refused as empty
  double size = 0;
  double centre[3];
  for (std::size_t k = 0; k < 3; ++k) {
    centre[k] = 0.5 * low[k] + 0.5 * high[k];
    size = hypotenuse(size, 0.5 * high[k] - 0.5 * low[k]);
  }
  mesh.centre = {centre[0], centre[1], centre[2]};
  mesh.scale = size > 0 ? 2 * size : 1;  // the box diagonal; may be infinite for coordinates near the limit of double
  mesh.report.bounding_box_diagonal = 2 * size;
  if (!(mesh.scale < largest_scale))
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the mesh is %g wide; scale it below 1e300", mesh.scale);
}

// A usable triangle has three different corners after welding.
void take_triangles(const MeshInput& input, const Vector<Index>& representative, Mesh& mesh) {
  mesh.triangle_of_given.assign(input.triangle_count, Mesh::none);
  mesh.corners.reserve(std::size_t{3} * input.triangle_count);
  for (std::uint32_t t = 0; t < input.triangle_count; ++t) {
    Index v[3];
    for (std::size_t k = 0; k < 3; ++k) v[k] = representative[input.triangles.get(t, k)];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      ++mesh.report.collapsed_triangle_count;
      continue;
    }
    mesh.triangle_of_given[t] = mesh.triangle_count();
    mesh.corners.append(v, v + 3);
  }
}

// Gives the corners of all faces new numbers.
void number_corners(const Vector<Index>& number, Mesh& mesh) {
  for (Index& corner : mesh.corners) corner = number[at(corner)];
  for (Index& corner : mesh.faces.corner) corner = number[at(corner)];
  for (Mesh::Doubled& entry : mesh.doubled) {
    for (Index& corner : entry.corner) corner = number[at(corner)];
  }
}

// Gives the inner vertices other numbers: the i-th is the one that had the number order[i].
void renumber(const Vector<Index>& order, Mesh& mesh, Memory& memory) {
  Vector<Index> number(order.size(), &memory);
  for (std::size_t i = 0; i < order.size(); ++i) number[at(order[i])] = static_cast<Index>(i);
  Vector<Index> given(order.size(), &memory);
  Vector<Vec3> positions(order.size(), &memory);
  for (std::size_t i = 0; i < order.size(); ++i) {
    given[i] = mesh.given_of_inner[at(order[i])];
    positions[i] = mesh.positions[at(order[i])];
  }
  mesh.given_of_inner = std::move(given);
  mesh.positions = std::move(positions);
  for (Index& v : mesh.inner_of_given) {
    if (v != Mesh::none) v = number[at(v)];
  }
  number_corners(number, mesh);
}

}  // namespace

// The smallest angle has the largest cotangent.
void measure_triangles(const Mesh& mesh, MeshReport& report, JobRunner* jobs, Memory& memory) {
  struct Found {
    double cotangent = -std::numeric_limits<double>::infinity();
    std::uint32_t degenerate = 0;
  };
  const std::size_t count = at(mesh.triangle_count()), pieces = (count + report_piece - 1) / report_piece;
  Vector<Found> found(pieces, &memory);
  const auto measure = [&](std::uint32_t p) {
    Found own;
    for (std::size_t t = p * report_piece; t < std::min(count, (p + std::size_t{1}) * report_piece); ++t) {
      const Index* v = mesh.triangle(static_cast<Index>(t));
      const Vec3 e[3] = {mesh.positions[at(v[1])] - mesh.positions[at(v[0])],
                         mesh.positions[at(v[2])] - mesh.positions[at(v[1])],
                         mesh.positions[at(v[0])] - mesh.positions[at(v[2])]};
      const double area2 = norm(cross(e[0], e[2]));
      const double longest = std::max({dot(e[0], e[0]), dot(e[1], e[1]), dot(e[2], e[2])});
      for (int k = 0; k < 3; ++k) {
        const double cosine = -dot(e[k], e[(k + 2) % 3]);
        // A triangle without area has angles of 0 or pi. If two corners are at one place, the angle counts as 0.
        const double cotangent =
            area2 > 0 ? cosine / area2 : (cosine < 0 ? -1 : 1) * std::numeric_limits<double>::infinity();
        own.cotangent = std::max(own.cotangent, cotangent);
      }
      own.degenerate += !(0.5 * area2 > zero_area * longest);
    }
    found[p] = own;
  };
  for_each(jobs, static_cast<std::uint32_t>(pieces), measure);
  Found all;
  for (const Found& own : found) {
    all.cotangent = std::max(all.cotangent, own.cotangent);
    all.degenerate += own.degenerate;
  }
  report.smallest_angle = arc_tangent(1.0, all.cotangent);
  report.degenerate_triangle_count += all.degenerate;
}

std::uint32_t Mesh::given_of_triangle(Index t) const noexcept {
  if (!faces.empty()) {
    const auto next = std::upper_bound(faces.triangle_start.begin(), faces.triangle_start.end(), t);
    return static_cast<std::uint32_t>(faces.given[static_cast<std::size_t>(next - faces.triangle_start.begin()) - 1]);
  }
  const auto found = std::lower_bound(refilled.begin(), refilled.end(), t,
                                      [](const Refilled& one, Index triangle) { return one.triangle < triangle; });
  if (found != refilled.end() && found->triangle == t) return static_cast<std::uint32_t>(found->given);
  std::size_t given = at(t);  // triangles left out only move it up
  while (triangle_of_given[given] != t) ++given;
  return static_cast<std::uint32_t>(given);
}

Mesh Mesh::make(const MeshInput& input, Memory& memory, JobRunner* jobs) {
  const std::uint32_t triangles = check_sizes(input);
  check_triangles(input);
  Mesh mesh(memory);
  mesh.report.vertex_count = input.vertex_count;
  mesh.report.triangle_count = triangles;
  poll();
  check_positions(input);
  poll();

  // representative[v] is the first vertex of the caller that vertex v is welded with
  Vector<Index> representative = weld(input, memory);
  for (std::uint32_t v = 0; v < input.vertex_count; ++v)
    mesh.report.welded_vertex_count += representative[v] == static_cast<Index>(v);

  poll();
  Vector<std::uint8_t> is_corner(input.vertex_count, 0, &memory);
  if (input.faces.face_count > 0) {
    mark_corners(input, representative, is_corner, memory);
    find_frame(input, representative, is_corner, mesh);
    take_faces(input, representative, mesh, memory);
  } else {
    take_triangles(input, representative, mesh);
    for (const Index corner : mesh.corners) is_corner[at(corner)] = 1;
    find_frame(input, representative, is_corner, mesh);
  }
  if (mesh.corners.empty())
    fail(HF_ERROR_EMPTY, HF_NO_INDEX, "every %s has equal corners%s; nothing is left of the mesh",
         input.faces.face_count > 0 ? "face" : "triangle", input.weld == Weld::none ? "" : " after welding");

  poll();
  set_doubled_aside(mesh, input.vertex_count, memory);
  leave_line_faces_out(input, mesh, memory, jobs);

  poll();
  // The inner vertices are the welded vertices of usable triangles. They are numbered in the caller's order at first.
  Vector<Index> inner(input.vertex_count, none, &memory);
  for (Index& corner : mesh.corners) inner[at(corner)] = 0;
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    if (inner[v] == none) continue;
    inner[v] = static_cast<Index>(mesh.given_of_inner.size());
    mesh.given_of_inner.push_back(static_cast<Index>(v));
  }
  mesh.inner_of_given.resize(input.vertex_count);
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    mesh.inner_of_given[v] = inner[at(representative[v])];
    if (mesh.inner_of_given[v] != none) continue;
    ++mesh.report.isolated_vertex_count;
    mesh.isolated.push_back(
        {static_cast<Index>(v), {input.positions.get(v, 0), input.positions.get(v, 1), input.positions.get(v, 2)}});
  }
  number_corners(inner, mesh);

  const std::size_t count = mesh.given_of_inner.size();
  mesh.positions.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t v = at(mesh.given_of_inner[i]);
    mesh.positions[i] =
        mesh.to_inner({input.positions.get(v, 0), input.positions.get(v, 1), input.positions.get(v, 2)});
  }
  poll();
  if (!is_local(mesh.corners, count)) renumber(curve_order(mesh.positions, jobs, memory), mesh, memory);

  poll();
  turn_two_sided(input, mesh, memory, jobs);

  poll();
  UnionFind sets(count, memory);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    sets.unite(mesh.triangle(t)[0], mesh.triangle(t)[1]);
    sets.unite(mesh.triangle(t)[1], mesh.triangle(t)[2]);
  }
  // Components are numbered by the first of the caller's vertices in them.
  mesh.component.assign(count, none);
  for (const Index i : mesh.inner_of_given) {
    if (i == none || mesh.component[at(i)] != none) continue;
    Index& of_root = mesh.component[at(sets.find(i))];
    if (of_root == none) of_root = static_cast<Index>(mesh.report.component_count++);
    mesh.component[at(i)] = of_root;
  }

  poll();
  measure_triangles(mesh, mesh.report, jobs, memory);
  mesh.positions.leave_room();
  mesh.component.leave_room();
  mesh.inner_of_given.leave_room();
  mesh.given_of_inner.leave_room();
  return mesh;
}

}  // namespace hf_inner::mesh
