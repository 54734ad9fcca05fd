#include "remesh/refine.h"

#include <algorithm>
#include <cmath>

#include "remesh/capture.h"
#include "remesh/coarsen.h"
#include "remesh/relax.h"

namespace hf {
namespace {

constexpr std::int32_t none = -1;
constexpr float finer = 0.75f, finest = 0.5f;  // scales of a refined vertex's edges, and where refining ends

// Marks a corner near every miss; how many.
std::int32_t mark_misses(const QuadMesh& mesh, const Vector<QuadMiss>& misses, std::int32_t most, Memory& memory,
                         Table<std::uint8_t>& marked) {
  const VertexFans fans(mesh, memory);
  Table<std::uint8_t> blocked(mesh.position.size(), 0, memory);
  std::int32_t count = 0;
  auto can_be = [&](std::int32_t v) {
    if (mesh.border[v] || mesh.scale[v] < finest) return false;
    for (std::int32_t i = fans.start[v]; i < fans.start[v + 1]; ++i)
      if (mesh.size(fans.face[i]) != 4) return false;
    return true;
  };
  for (const QuadMiss& miss : misses) {
    if (count >= most) break;
    std::int32_t best = none;
    for (std::int32_t k = mesh.face_start[miss.face]; k < mesh.face_start[miss.face + 1]; ++k) {
      const std::int32_t v = mesh.corner[k];
      if (can_be(v) && (best == none || norm(mesh.position[v] - miss.point) < norm(mesh.position[best] - miss.point)))
        best = v;
    }
    if (best == none || blocked[best]) continue;
    marked[best] = 1, ++count;
    for (std::int32_t i = fans.start[best]; i < fans.start[best + 1]; ++i)
      for (std::int32_t k = mesh.face_start[fans.face[i]]; k < mesh.face_start[fans.face[i] + 1]; ++k)
        blocked[mesh.corner[k]] = 1;
  }
  return count;
}

}  // namespace

void refine_quads(const FluxSurface& surface, QuadMesh& mesh, const Table<std::uint8_t>& marked, Memory& memory) {
  // a vertex half way from v to the point `to`
  auto half_way = [&](std::int32_t v, const Vec3& to) {
    const SurfacePoint at = walk_surface(surface, mesh.location[v], 0.5 * (to - mesh.position[v]));
    return mesh.add_vertex(at, position_of(surface, at), QuadMesh::free, false, finer * mesh.scale[v]);
  };
  struct Middle {
    std::int32_t to, vertex;
  };
  // middles of edges at marked vertices: a list through `following`
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
  Table<std::int32_t> starts(memory), corners(memory);
  starts.push_back(0);
  auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    corners.push_back(a), corners.push_back(b), corners.push_back(c), corners.push_back(d);
    starts.push_back(corners.size());
  };
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t begin = mesh.face_start[f], size = mesh.size(f);
    std::int32_t at = none;
    for (std::int32_t k = 0; k < size; ++k)
      if (marked[mesh.corner[begin + k]]) at = k;
    if (at == none) {
      for (std::int32_t k = 0; k < size; ++k) corners.push_back(mesh.corner[begin + k]);
      starts.push_back(corners.size());
      continue;
    }
    const std::int32_t v = mesh.corner[begin + at], a = mesh.corner[begin + (at + 1) % 4],
                       b = mesh.corner[begin + (at + 2) % 4], c = mesh.corner[begin + (at + 3) % 4];
    const std::int32_t e_a = middle_of(v, a), e_c = middle_of(v, c), i = half_way(v, mesh.position[b]);
    quad(v, e_a, i, e_c), quad(e_a, a, b, i), quad(i, b, c, e_c);
  }
  for (std::int32_t v = 0; v < marked.size(); ++v)
    if (marked[v]) mesh.scale[v] *= finer;
  mesh.face_start.swap(starts), mesh.corner.swap(corners);
}

double refine_misses(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, double deviation,
                     const RefineOptions& options, Memory& memory) {
  if (deviation <= options.tolerance) return deviation;
  const std::int32_t most_faces = static_cast<std::int32_t>(options.most_faces * mesh.face_count());
  QuadMesh work = mesh;
  Vector<QuadMiss> misses(&memory), drawn_misses(&memory);
  Table<std::uint8_t> marked(memory);
  // what the misses exceed the tolerance by, all together: one place better is better, though another is still the
  // worst
  auto excess = [&](const Vector<QuadMiss>& list) {
    double sum = 0;
    for (const QuadMiss& miss : list) sum += miss.distance - options.tolerance;
    return sum;
  };
  auto look = [&](QuadMesh& at, Vector<QuadMiss>& list) {
    distance.turn_quads(at);
    list.clear();
    const double found = distance.measure(at, options.tolerance, &list, nullptr);
    if (found < deviation) deviation = found, mesh = at;
  };
  look(work, misses);
  double least = excess(misses);
  int worse = 0;  // rounds since it was least
  for (std::int32_t round = 0; round < options.rounds && deviation > options.tolerance; ++round) {
    report(options.progress, static_cast<float>(round) / static_cast<float>(options.rounds));
    // what was drawn out too far, or wrongly, may go back
    for (const QuadMiss& miss : misses)
      for (std::int32_t k = work.face_start[miss.face]; k < work.face_start[miss.face + 1]; ++k)
        if (miss.vertex == QuadMiss::of_quads && work.pinned[work.corner[k]] == QuadMesh::drawn_out)
          work.pinned[work.corner[k]] = QuadMesh::free;
    marked.assign(work.position.size(), 0);
    const std::int32_t room = (most_faces - work.face_count()) / 8;
    constexpr int most_worse = 2;
    if (worse < most_worse && mark_misses(work, misses, room, memory, marked) > 0) {
      refine_quads(surface, work, marked, memory);
    } else {
      worse = 0, least = excess(misses);
      if (close_misses(surface, work, misses, memory) == 0) break;
    }
    RelaxOptions relax;
    relax.rounds = options.relax_rounds, relax.edge_length = options.edge_length;
    relax_quads(surface, work, relax, memory);
    look(work, misses);
    if (misses.empty()) break;
    QuadMesh drawn = work;
    CaptureOptions capture;
    capture.edge_length = options.edge_length, capture.tolerance = options.tolerance, capture.rounds = 2;
    if (capture_features(surface, distance, drawn, capture, memory) > 0) {
      look(drawn, drawn_misses);
      if (excess(drawn_misses) < excess(misses)) work = std::move(drawn), misses.swap(drawn_misses);
    }
    worse = excess(misses) < least ? 0 : worse + 1;
    least = std::min(least, excess(misses));
  }
  return deviation;
}

}  // namespace hf
