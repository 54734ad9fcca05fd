#include "remesh/coarsen.h"

#include <algorithm>
#include <cmath>

#include "remesh/constants.h"
#include "remesh/relax.h"

namespace hf_inner {
namespace {

constexpr std::int32_t none = -1;

struct Collapse {
  double length;  // length of the quad's shortest edge
  std::int32_t face, corner;
};

double side(const QuadMesh& mesh, std::int32_t f, std::int32_t k) {
  const std::int32_t* c = mesh.corner.data() + mesh.face_start[f];
  return norm(mesh.position[c[(k + 1) % 4]] - mesh.position[c[k]]);
}

// Lists the quads that may collapse and have a short edge, the shortest first. Each collapses along its shorter
// diagonal if it may, else along the other.
void list_collapses(const QuadMesh& mesh, const VertexFans& fans, double shortest, bool only_refined,
                    Vector<Collapse>& out) {
  out.clear();
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.size(f) != 4) continue;
    const double length =
        std::min(std::min(side(mesh, f, 0), side(mesh, f, 1)), std::min(side(mesh, f, 2), side(mesh, f, 3)));
    const std::int32_t* c = mesh.corner.data() + mesh.face_start[f];
    const bool refined = std::any_of(c, c + 4, [&](std::int32_t v) { return mesh.scale[v] < 1; });
    if (!(length < shortest) || (only_refined && !refined)) continue;
    const bool turned =
        norm(mesh.position[c[3]] - mesh.position[c[1]]) < norm(mesh.position[c[2]] - mesh.position[c[0]]);
    const std::int32_t k = turned ? 1 : 0;
    if (can_collapse(mesh, fans, f, k)) {
      out.push_back({length, f, k});
    } else if (can_collapse(mesh, fans, f, 1 - k)) {
      out.push_back({length, f, 1 - k});
    }
  }
  std::sort(out.begin(), out.end(), [](const Collapse& a, const Collapse& b) {
    return a.length != b.length ? a.length < b.length : a.face < b.face;
  });
}

// Marks all vertices near a quad that collapses, so that no quad beside it collapses in the same round.
void block_around(const QuadMesh& mesh, const VertexFans& fans, std::int32_t f, Table<std::uint8_t>& blocked) {
  for (std::int32_t k = mesh.face_start[f]; k < mesh.face_start[f + 1]; ++k) {
    const std::int32_t v = mesh.corner[k];
    for (std::int32_t i = fans.start[v]; i < fans.start[v + 1]; ++i)
      for (std::int32_t j = mesh.face_start[fans.face[i]]; j < mesh.face_start[fans.face[i] + 1]; ++j)
        blocked[mesh.corner[j]] = 1;
  }
}

std::int32_t nearest(const Vector<Vec3>& points, const Vec3& to) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (norm(points[i] - to) < norm(points[best] - to)) best = i;
  return static_cast<std::int32_t>(best);
}

// Applies collapses of which no two share a vertex or a neighbour. merged: by vertex of the new mesh, whether it was
// two vertices.
void collapse_quads(const FluxSurface& surface, QuadMesh& mesh, const Vector<Collapse>& collapses,
                    Table<std::uint8_t>& merged, Memory& memory) {
  Table<std::int32_t> becomes(mesh.position.size(), 0, memory);
  for (std::int32_t v = 0; v < becomes.size(); ++v) becomes[v] = v;
  Table<std::uint8_t> gone(mesh.face_count(), 0, memory);
  for (const Collapse& collapse : collapses) {
    const std::int32_t* c = mesh.corner.data() + mesh.face_start[collapse.face];
    std::int32_t a = c[collapse.corner], b = c[collapse.corner + 2];
    if (mesh.pinned[b]) std::swap(a, b);  // at most one of the two is pinned
    if (!mesh.pinned[a]) {
      mesh.location[a] = walk_surface(surface, mesh.location[a], 0.5 * (mesh.position[b] - mesh.position[a]));
      mesh.position[a] = position_of(surface, mesh.location[a]);
    }
    mesh.scale[a] = std::max(mesh.scale[a], mesh.scale[b]);
    becomes[b] = a, gone[collapse.face] = 1;
  }
  merged.clear();
  Table<std::int32_t> number(becomes.size(), none, memory);
  QuadMesh out(memory);
  Table<std::uint8_t> kept(becomes.size(), 0, memory);
  for (const Collapse& collapse : collapses) {
    const std::int32_t* c = mesh.corner.data() + mesh.face_start[collapse.face];
    kept[becomes[c[collapse.corner]]] = 1;
  }
  for (std::int32_t v = 0; v < becomes.size(); ++v)
    if (becomes[v] == v)
      merged.push_back(kept[v]),
          number[v] = out.add_vertex(mesh.location[v], mesh.position[v], mesh.pinned[v], mesh.border[v], mesh.scale[v]);
  out.face_start.push_back(0);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    if (gone[f]) continue;
    for (std::int32_t k = mesh.face_start[f]; k < mesh.face_start[f + 1]; ++k)
      out.corner.push_back(number[becomes[mesh.corner[k]]]);
    out.face_start.push_back(out.corner.size());
  }
  mesh = std::move(out);
}

}  // namespace

bool can_collapse(const QuadMesh& mesh, const VertexFans& fans, std::int32_t f, std::int32_t k) {
  const std::int32_t* q = mesh.corner.data() + mesh.face_start[f];
  const std::int32_t a = q[k], b = q[(k + 1) % 4], c = q[(k + 2) % 4], d = q[(k + 3) % 4];
  for (const std::int32_t v : {a, b, c, d})
    if (mesh.border[v]) return false;
  if (mesh.pinned[a] && mesh.pinned[c]) return false;
  if (fans.valence(b) < 4 || fans.valence(d) < 4 || fans.valence(a) < 3 || fans.valence(c) < 3 ||
      fans.valence(a) + fans.valence(c) > collapse_most_faces)
    return false;
  for (std::int32_t i = fans.start[a]; i < fans.start[a + 1]; ++i) {
    const std::int32_t g = fans.face[i], size = mesh.size(g);
    if (size != 4) return false;
    const std::int32_t* corner = mesh.corner.data() + mesh.face_start[g];
    for (std::int32_t j = 0; j < size; ++j) {
      if (g != f && corner[j] == c) return false;
      if (corner[j] != a) continue;
      for (const std::int32_t x : {corner[(j + 1) % size], corner[(j + size - 1) % size]}) {
        if (x == b || x == d) continue;
        for (std::int32_t l = fans.start[c]; l < fans.start[c + 1]; ++l) {  // is there an edge from x to c
          const std::int32_t h = fans.face[l], n = mesh.size(h), *other = mesh.corner.data() + mesh.face_start[h];
          for (std::int32_t m = 0; m < n; ++m)
            if (other[m] == c && (other[(m + 1) % n] == x || other[(m + n - 1) % n] == x)) return false;
        }
      }
    }
  }
  for (std::int32_t l = fans.start[c]; l < fans.start[c + 1]; ++l)
    if (mesh.size(fans.face[l]) != 4) return false;
  return true;
}

std::int32_t collapse_misses(const FluxSurface& surface, QuadMesh& mesh, const Vector<QuadMiss>& misses,
                             Table<std::uint8_t>& merged, Memory& memory) {
  const VertexFans fans(mesh, memory);
  Table<std::uint8_t> blocked(mesh.position.size(), 0, memory);
  Vector<Collapse> taken(&memory);
  for (const QuadMiss& miss : misses) {
    const std::int32_t f = miss.face;
    if (miss.vertex != QuadMiss::of_quads || mesh.size(f) != 4) continue;
    const std::int32_t* c = mesh.corner.data() + mesh.face_start[f];
    if (std::any_of(c, c + 4, [&](std::int32_t v) { return blocked[v] != 0; })) continue;
    const bool turned =
        norm(mesh.position[c[3]] - mesh.position[c[1]]) < norm(mesh.position[c[2]] - mesh.position[c[0]]);
    std::int32_t k = turned ? 1 : 0;
    if (!can_collapse(mesh, fans, f, k)) k = 1 - k;
    if (!can_collapse(mesh, fans, f, k)) continue;
    taken.push_back({0, f, k});
    block_around(mesh, fans, f, blocked);
  }
  if (!taken.empty()) collapse_quads(surface, mesh, taken, merged, memory);
  return static_cast<std::int32_t>(taken.size());
}

double coarsen_quads(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, double deviation,
                     const CoarsenOptions& options, Memory& memory) {
  Vector<Collapse> list(&memory), taken(&memory);
  Vector<QuadMiss> before(&memory), after(&memory);
  NearFaces known(memory);
  Table<std::uint8_t> moving(memory);
  Vector<Vec3> kept(&memory), centres(&memory);  // centres of collapses that were undone, and of those tried now
  const double length = options.edge_length;
  // Sums up how far places within a radius of a point are beyond the tolerance from the surface.
  const double reach = collapse_reach * length;
  auto excess = [&](const Vector<QuadMiss>& misses, const Vec3& point, double radius) {
    double sum = 0;
    for (const QuadMiss& miss : misses)
      if (norm(miss.point - point) < radius) sum += miss.distance - options.tolerance;
    return sum;
  };
  auto measure = [&](QuadMesh& at, Vector<QuadMiss>& misses) {
    distance.turn_quads(at, &known);
    misses.clear();
    distance.measure(at, options.tolerance, &misses, &known);
  };
  measure(mesh, before);
  bool any = false;
  for (std::int32_t round = 0; round < options.rounds; ++round) {
    report(static_cast<float>(round) / static_cast<float>(options.rounds));
    const VertexFans fans(mesh, memory);
    list_collapses(mesh, fans, options.shortest * length, options.only_refined, list);
    if (static_cast<double>(list.size()) <= collapse_enough * mesh.face_count()) break;
    Table<std::uint8_t> blocked(mesh.position.size(), 0, memory);
    taken.clear(), centres.clear();
    for (const Collapse& collapse : list) {
      const std::int32_t* c = mesh.corner.data() + mesh.face_start[collapse.face];
      bool free = true;
      for (std::int32_t k = 0; k < 4; ++k) free = free && !blocked[c[k]];
      const Vec3 centre = 0.5 * (mesh.position[c[collapse.corner]] + mesh.position[c[collapse.corner + 2]]);
      for (const Vec3& p : kept) free = free && norm(p - centre) > collapse_same_place * length;
      if (!free) continue;
      taken.push_back(collapse), centres.push_back(centre);
      block_around(mesh, fans, collapse.face, blocked);
    }
    if (taken.empty()) break;
    // Collapses that take the mesh too far from the surface are undone, until no such collapse is left.
    for (int tries = 0; tries < collapse_tries && !taken.empty(); ++tries) {
      QuadMesh trial = mesh;
      collapse_quads(surface, trial, taken, moving, memory);
      grow_marks(trial, collapse_rings, moving);
      RelaxOptions relax;
      relax.rounds = collapse_relax_rounds, relax.edge_length = length, relax.moving = &moving;
      relax_quads(surface, trial, relax, memory);
      measure(trial, after);
      Table<std::uint8_t> bad(static_cast<std::int32_t>(taken.size()), 0, memory);
      for (std::int32_t i = 0; i < bad.size(); ++i) {
        const Vec3& centre = centres[static_cast<std::size_t>(i)];
        bad[i] = excess(after, centre, reach) > excess(before, centre, reach);
      }
      // A place too far from the surface, and farther than `reach` from all collapses, counts against the nearest
      // collapse.
      const double limit = std::max(before.empty() ? 0 : before[0].distance, collapse_far * options.tolerance);
      if (std::count(bad.begin(), bad.end(), 1) == 0)
        for (const QuadMiss& miss : after)
          if (miss.distance > limit) bad[nearest(centres, miss.point)] = 1;
      std::size_t left = 0;
      for (std::size_t i = 0; i < taken.size(); ++i) {
        if (bad[static_cast<std::int32_t>(i)]) {
          kept.push_back(centres[i]);
        } else {
          taken[left] = taken[i], centres[left++] = centres[i];
        }
      }
      if (left == taken.size()) {
        mesh = std::move(trial), before.swap(after), any = true;
        break;
      }
      taken.resize(left), centres.resize(left);
    }
  }
  return any ? distance.measure(mesh, 0, nullptr) : deviation;
}

void collapse_to_count(const FluxSurface& surface, QuadMesh& mesh, std::int32_t wanted, double edge_length,
                       Memory& memory) {
  Vector<Collapse> list(&memory), taken(&memory);
  Table<std::uint8_t> merged(memory);
  while (mesh.face_count() > wanted) {
    poll();
    const VertexFans fans(mesh, memory);
    list_collapses(mesh, fans, HUGE_VAL, false, list);
    const std::int32_t most =
        std::min(mesh.face_count() - wanted, std::max<std::int32_t>(1, mesh.face_count() / count_share));
    Table<std::uint8_t> blocked(mesh.position.size(), 0, memory);
    taken.clear();
    for (const Collapse& collapse : list) {
      if (static_cast<std::int32_t>(taken.size()) >= most) break;
      const std::int32_t* c = mesh.corner.data() + mesh.face_start[collapse.face];
      if (std::any_of(c, c + 4, [&](std::int32_t v) { return blocked[v] != 0; })) continue;
      block_around(mesh, fans, collapse.face, blocked);
      taken.push_back(collapse);
    }
    if (taken.empty()) return;
    collapse_quads(surface, mesh, taken, merged, memory);
    grow_marks(mesh, collapse_rings, merged);
    RelaxOptions relax;
    relax.rounds = collapse_relax_rounds, relax.edge_length = edge_length, relax.moving = &merged;
    relax_quads(surface, mesh, relax, memory);
  }
}

}  // namespace hf_inner
