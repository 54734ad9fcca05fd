#include "remesh/quad_mesh.h"

#include <algorithm>

#include "base/error.h"

namespace hf_inner::remesh {
namespace {

constexpr std::int32_t none = -1;

}  // namespace

VertexFans::VertexFans(const QuadMesh& mesh, Memory& memory) : start(memory), face(memory) {
  start.assign(mesh.position.size() + 1, 0);
  for (const std::int32_t v : mesh.corner) ++start[v + 1];
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) start[v + 1] += start[v];
  face.assign(mesh.corner.size(), 0);
  Table<std::int32_t> fill = start;
  for (std::int32_t k = 0; k < mesh.corner.size(); ++k) face[fill[mesh.corner[k]]++] = k / 4;
}

void grow_marks(const QuadMesh& mesh, std::int32_t rings, Table<std::uint8_t>& marked) {
  Table<std::uint8_t> before = marked;
  for (std::int32_t ring = 0; ring < rings; ++ring, before = marked)
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      const std::int32_t *first = mesh.quad(f), *last = first + 4;
      if (std::any_of(first, last, [&](std::int32_t v) { return before[v] != 0; }))
        for (const std::int32_t* c = first; c < last; ++c) marked[*c] = 1;
    }
}

Vec3 position_of(const FluxSurface& surface, const SurfacePoint& point) noexcept {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p = p + point.weight[k] * surface.position[surface.tail[3 * point.triangle + k]];
  return p;
}

void locate_in_mesh(const FluxSurface& surface, const mesh::Mesh& mesh, QuadMesh& quads) {
  for (SurfacePoint& point : quads.location) {
    const std::int32_t* corners = mesh.triangle(point.triangle);
    const SurfacePoint here = point;
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) {
        if (surface.mesh_vertex[surface.tail[3 * here.triangle + j]] == corners[k]) point.weight[k] = here.weight[j];
      }
    }
  }
}

void check_quads(const QuadMesh& mesh, std::int32_t euler_characteristic, Memory& memory) {
  // Half-edges are listed at the lower end of their edge. There a stamp on the other end says which were seen.
  const std::int32_t vertices = mesh.position.size();
  const auto each = [&](auto&& visit) {
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      const std::int32_t* c = mesh.quad(f);
      for (std::int32_t k = 0; k < 4; ++k) visit(c[k], c[(k + 1) % 4]);
    }
  };
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t *c = mesh.quad(f), *last = c + 4;
    for (const std::int32_t* v = c; v != last; ++v) {
      if (std::find(c, v, *v) != v)
        fail(HF_ERROR_INTERNAL, static_cast<std::uint32_t>(*v), "face %d has vertex %d twice", f, *v);
    }
  }
  Table<std::int32_t> start(vertices + 1, 0, memory);
  each([&](std::int32_t a, std::int32_t b) { ++start[std::min(a, b) + 1]; });
  for (std::int32_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
  Table<std::int32_t> end = start, other(start[vertices], 0, memory);  // ~ for a half-edge that ends at the lower end
  each([&](std::int32_t a, std::int32_t b) { other[end[std::min(a, b)]++] = a < b ? b : ~a; });
  Table<std::int32_t> away(vertices, none, memory), back(vertices, none, memory);
  std::int64_t edges = 0;
  for (std::int32_t v = 0; v < vertices; ++v) {
    for (std::int32_t i = start[v]; i < start[v + 1]; ++i) {
      const bool comes = other[i] < 0;
      const std::int32_t w = comes ? ~other[i] : other[i];
      edges += away[w] != v && back[w] != v;
      std::int32_t& stamp = (comes ? back : away)[w];
      if (stamp == v)
        fail(HF_ERROR_INTERNAL, static_cast<std::uint32_t>(comes ? w : v), "edge %d -> %d is in two faces",
             comes ? w : v, comes ? v : w);
      stamp = v;
    }
  }
  const std::int64_t found = std::int64_t{mesh.position.size()} - edges + mesh.face_count();
  if (found != euler_characteristic)
    fail(HF_ERROR_INTERNAL, HF_NO_INDEX, "the quads have Euler characteristic %lld, the surface %d: a face is no disc",
         static_cast<long long>(found), euler_characteristic);
}

}  // namespace hf_inner::remesh
