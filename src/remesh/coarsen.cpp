#include "remesh/coarsen.h"

#include <algorithm>

#include "remesh/constants.h"
#include "remesh/relax.h"

namespace hf_inner::remesh {
namespace {

constexpr std::int32_t none = -1;

struct Collapse {
  double length;  // length of the quad's shortest edge
  std::int32_t face, corner;
};

double side(const QuadMesh& mesh, std::int32_t f, std::int32_t k) {
  const std::int32_t* c = mesh.quad(f);
  return norm(mesh.position[c[(k + 1) % 4]] - mesh.position[c[k]]);
}

// Lists the quads that may collapse, that with the shortest edge first. Each collapses along its shorter diagonal if it
// may, else along the other.
void list_collapses(const QuadMesh& mesh, const VertexFans& fans, Vector<Collapse>& out) {
  out.clear();
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const double length =
        std::min(std::min(side(mesh, f, 0), side(mesh, f, 1)), std::min(side(mesh, f, 2), side(mesh, f, 3)));
    const std::int32_t* c = mesh.quad(f);
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
  for (std::int32_t k = 0; k < 4; ++k) {
    const std::int32_t v = mesh.quad(f)[k];
    for (std::int32_t i = fans.start[v]; i < fans.start[v + 1]; ++i)
      for (std::int32_t j = 0; j < 4; ++j) blocked[mesh.quad(fans.face[i])[j]] = 1;
  }
}

// Applies collapses of which no two share a vertex or a neighbour. merged: by vertex of the new mesh, whether it was
// two vertices.
void collapse_quads(const FluxSurface& surface, QuadMesh& mesh, const Vector<Collapse>& collapses,
                    Table<std::uint8_t>& merged, Memory& memory) {
  Table<std::int32_t> becomes(mesh.position.size(), 0, memory);
  for (std::int32_t v = 0; v < becomes.size(); ++v) becomes[v] = v;
  Table<std::uint8_t> gone(mesh.face_count(), 0, memory);
  for (const Collapse& collapse : collapses) {
    const std::int32_t* c = mesh.quad(collapse.face);
    std::int32_t a = c[collapse.corner], b = c[collapse.corner + 2];
    if (mesh.pinned[b]) std::swap(a, b);  // at most one of the two is pinned
    if (!mesh.pinned[a]) {
      mesh.location[a] = walk_surface(surface, mesh.location[a], 0.5 * (mesh.position[b] - mesh.position[a]));
      mesh.position[a] = position_of(surface, mesh.location[a]);
    }
    mesh.scale[a] = std::max(mesh.scale[a], mesh.scale[b]);
    becomes[b] = a;
    gone[collapse.face] = 1;
  }
  merged.clear();
  Table<std::int32_t> number(becomes.size(), none, memory);
  QuadMesh out(memory);
  Table<std::uint8_t> kept(becomes.size(), 0, memory);
  for (const Collapse& collapse : collapses) {
    const std::int32_t* c = mesh.quad(collapse.face);
    kept[becomes[c[collapse.corner]]] = 1;
  }
  for (std::int32_t v = 0; v < becomes.size(); ++v)
    if (becomes[v] == v) {
      merged.push_back(kept[v]);
      number[v] = out.add_vertex(mesh.location[v], mesh.position[v], mesh.pinned[v], mesh.border[v], mesh.scale[v]);
    }
  for (std::int32_t k = 0; k < mesh.corner.size(); ++k)
    if (!gone[k / 4]) out.corner.push_back(number[becomes[mesh.corner[k]]]);
  mesh = std::move(out);
}

}  // namespace

bool can_collapse(const QuadMesh& mesh, const VertexFans& fans, std::int32_t f, std::int32_t k) {
  const std::int32_t* q = mesh.quad(f);
  const std::int32_t a = q[k], b = q[(k + 1) % 4], c = q[(k + 2) % 4], d = q[(k + 3) % 4];
  for (const std::int32_t v : {a, b, c, d})
    if (mesh.border[v]) return false;
  if (mesh.pinned[a] && mesh.pinned[c]) return false;
  if (fans.valence(b) < 4 || fans.valence(d) < 4 || fans.valence(a) < 3 || fans.valence(c) < 3 ||
      fans.valence(a) + fans.valence(c) > collapse_most_faces)
    return false;
  for (std::int32_t i = fans.start[a]; i < fans.start[a + 1]; ++i) {
    const std::int32_t g = fans.face[i], *corner = mesh.quad(g);
    for (std::int32_t j = 0; j < 4; ++j) {
      if (g != f && corner[j] == c) return false;
      if (corner[j] != a) continue;
      for (const std::int32_t x : {corner[(j + 1) % 4], corner[(j + 3) % 4]}) {
        if (x == b || x == d) continue;
        for (std::int32_t l = fans.start[c]; l < fans.start[c + 1]; ++l) {  // is there an edge from x to c
          const std::int32_t* other = mesh.quad(fans.face[l]);
          for (std::int32_t m = 0; m < 4; ++m)
            if (other[m] == c && (other[(m + 1) % 4] == x || other[(m + 3) % 4] == x)) return false;
        }
      }
    }
  }
  return true;
}

std::int32_t collapse_misses(const FluxSurface& surface, QuadMesh& mesh, const Vector<QuadMiss>& misses,
                             Table<std::uint8_t>& merged, Memory& memory) {
  const VertexFans fans(mesh, memory);
  Table<std::uint8_t> blocked(mesh.position.size(), 0, memory);
  Vector<Collapse> taken(&memory);
  for (const QuadMiss& miss : misses) {
    const std::int32_t f = miss.face;
    if (miss.vertex != QuadMiss::of_quads) continue;
    const std::int32_t* c = mesh.quad(f);
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

void collapse_to_count(const FluxSurface& surface, QuadMesh& mesh, std::int32_t wanted, double edge_length,
                       Memory& memory) {
  Vector<Collapse> list(&memory), taken(&memory);
  Table<std::uint8_t> merged(memory);
  while (mesh.face_count() > wanted) {
    poll();
    const VertexFans fans(mesh, memory);
    list_collapses(mesh, fans, list);
    const std::int32_t most =
        std::min(mesh.face_count() - wanted, std::max<std::int32_t>(1, mesh.face_count() / count_share));
    Table<std::uint8_t> blocked(mesh.position.size(), 0, memory);
    taken.clear();
    for (const Collapse& collapse : list) {
      if (static_cast<std::int32_t>(taken.size()) >= most) break;
      const std::int32_t* c = mesh.quad(collapse.face);
      if (std::any_of(c, c + 4, [&](std::int32_t v) { return blocked[v] != 0; })) continue;
      block_around(mesh, fans, collapse.face, blocked);
      taken.push_back(collapse);
    }
    if (taken.empty()) return;
    collapse_quads(surface, mesh, taken, merged, memory);
    grow_marks(mesh, collapse_rings, merged);
    RelaxOptions relax;
    relax.rounds = collapse_relax_rounds;
    relax.edge_length = edge_length;
    relax.moving = &merged;
    relax_quads(surface, mesh, relax, memory);
  }
}

}  // namespace hf_inner::remesh
