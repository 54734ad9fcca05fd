#include "remesh/refine.h"

#include <algorithm>
#include <cmath>

#include "remesh/constants.h"
#include "remesh/relax.h"

namespace hf_inner::remesh {
namespace {

constexpr std::int32_t none = -1;

}  // namespace

void refine_quads(const FluxSurface& surface, QuadMesh& mesh, const Table<std::uint8_t>& marked, Memory& memory) {
  // Adds a vertex half way from v to the point `to`.
  auto half_way = [&](std::int32_t v, const Vec3& to) {
    const SurfacePoint at = walk_surface(surface, mesh.location[v], 0.5 * (to - mesh.position[v]));
    return mesh.add_vertex(at, position_of(surface, at), QuadMesh::free, false, subdivided_scale * mesh.scale[v]);
  };
  struct Middle {
    std::int32_t to, vertex;
  };
  // The middles of split edges at marked vertices, as linked lists: `first` starts the list of a vertex, `following`
  // continues it.
  Vector<Middle> middles(&memory);
  Table<std::int32_t> first(marked.size(), none, memory), following(memory);
  auto middle_of = [&](std::int32_t v, std::int32_t a) {
    for (std::int32_t m = first[v]; m != none; m = following[m])
      if (middles[static_cast<std::size_t>(m)].to == a) return middles[static_cast<std::size_t>(m)].vertex;
    const std::int32_t vertex = half_way(v, mesh.position[a]);
    middles.push_back({a, vertex});
    const std::int32_t m = following.push_back(first[v]);
    first[v] = m;
    return vertex;
  };
  Table<std::int32_t> corners(memory);
  auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    corners.push_back(a);
    corners.push_back(b);
    corners.push_back(c);
    corners.push_back(d);
  };
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t* q = mesh.quad(f);
    std::int32_t at = none;
    for (std::int32_t k = 0; k < 4; ++k)
      if (marked[q[k]]) at = k;
    if (at == none) {
      quad(q[0], q[1], q[2], q[3]);
      continue;
    }
    const std::int32_t v = q[at], a = q[(at + 1) % 4], b = q[(at + 2) % 4], c = q[(at + 3) % 4];
    const std::int32_t e_a = middle_of(v, a), e_c = middle_of(v, c), i = half_way(v, mesh.position[b]);
    quad(v, e_a, i, e_c);
    quad(e_a, a, b, i);
    quad(i, b, c, e_c);
  }
  for (std::int32_t v = 0; v < marked.size(); ++v)
    if (marked[v]) mesh.scale[v] *= subdivided_scale;
  mesh.corner.swap(corners);
}

std::int32_t split_vertex(QuadMesh& mesh, std::int32_t v, const Vec3& towards, Memory& memory) {
  // Lists the faces around v in counter-clockwise order. For each face, `first` and `last` are its two corners beside
  // v.
  Table<std::int32_t> faces(memory), spokes(memory);
  Table<std::int32_t> first(memory), last(memory);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f)
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t* c = mesh.quad(f);
      if (c[k] == v) {
        faces.push_back(f);
        first.push_back(c[(k + 1) % 4]);
        last.push_back(c[(k + 3) % 4]);
      }
    }
  const std::int32_t n = faces.size();
  for (std::int32_t i = 0; i + 1 < n; ++i)
    for (std::int32_t j = i + 1; j < n; ++j)
      if (first[j] == last[i]) {
        std::swap(first[j], first[i + 1]);
        std::swap(last[j], last[i + 1]);
        std::swap(faces[j], faces[i + 1]);
        break;
      }
  // A spoke is an edge at v. The new quad lies between two spokes that run across the direction `way`, with at least
  // two faces on each side.
  const Vec3 p = mesh.position[v], way = unit(towards - p);
  Table<double> along(memory);  // by spoke, how far it runs that way
  for (std::int32_t i = 0; i < n; ++i) along.push_back(dot(unit(mesh.position[first[i]] - p), way));
  std::int32_t from = none, to = none;
  double best = 0;
  for (std::int32_t i = 0; i < n; ++i) {
    double between = 0;
    for (std::int32_t count = 2; count <= n - 2; ++count) {  // `count` faces from edge (spoke) i on join the new vertex
      const std::int32_t j = (i + count) % n;
      between += along[(i + count - 1) % n];
      const double sum = between / (count - 1) - std::fabs(along[i]) - std::fabs(along[j]);
      if (from == none || sum > best) {
        best = sum;
        from = i;
        to = j;
      }
    }
  }
  mesh.scale[v] *= split_scale;
  const std::int32_t added = mesh.add_vertex(mesh.location[v], p, QuadMesh::free, false, mesh.scale[v]);
  for (std::int32_t i = from; i != to; i = (i + 1) % n)
    std::replace(mesh.quad(faces[i]), mesh.quad(faces[i]) + 4, v, added);
  mesh.add_quad(v, first[from], added, first[to]);
  return added;
}

}  // namespace hf_inner::remesh
