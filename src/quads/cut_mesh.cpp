#include "quads/cut_mesh.h"

#include <algorithm>

#include "base/progress.h"
#include "quads/other_core.h"

namespace hf_inner::quads {
namespace {

// A surface is cut if at least this share of its area lies in triangles with an edge of more than so many edges of
// quads. Cutting others changes more than it mends. Chosen on 18 character models at 3,000 quads, by counts of models
// that are a twentieth better or worse (before most_facet). With 0.5 and 4, irregular vertices are better on 6 models
// and worse on 2, angles on 7 and 1. With 0.1, or with 2, more models are worse: 5 or 6.
constexpr double coarse_share = 0.5, coarse_length = 4;
// Then it is cut until no edge is longer than so many edges of quads. Chosen on mpi_triang, eight, double-torus and
// oblong at 5,000 quads, before most_facet: 2 and 3 lose a limb of oblong; with 1 all four are as good, in more time.
constexpr double cut_length = 1.5;
// Crosses even out over four times the facets of the surface. A facet counts up to so many edges of quads. Less follows
// the facets of a scan, more forgets the shape of few long triangles. On six scans at 50,000 quads, cutting multiplies
// the irregular vertices by 1.33 with 1 and by 0.79 with 4. On 18 characters both values multiply them by 0.9. With 4
// for the curvature too, 0.95 and 0.98.
constexpr double most_facet = 4;
// Cutting ends where there would be so many more triangles for each quad: needles have many pieces. Half and double
// change none of mpi_triang, eight, double-torus and oblong at 5,000 quads.
constexpr double most_cut = 16;

double longest_edge(const surface::Core& core) noexcept {
  double longest = 0;
  for (Index e = 0; e < core.topology().edge_count(); ++e) {
    longest = std::max(longest, norm(core.mesh.positions[at(core.topology().second(e))] -
                                     core.mesh.positions[at(core.topology().first(e))]));
  }
  return longest;
}

double mean_edge(const surface::Core& core) noexcept {
  double sum = 0;
  for (Index e = 0; e < core.topology().edge_count(); ++e) {
    sum += norm(core.mesh.positions[at(core.topology().second(e))] - core.mesh.positions[at(core.topology().first(e))]);
  }
  return sum / std::max(core.topology().edge_count(), 1);
}

Index most_triangles(const surface::Core& core, double quads) noexcept {
  const double most = core.mesh.triangle_count() + most_cut * quads;
  return static_cast<Index>(std::min<double>(most, mesh::most_elements));
}

Vec3 between(const Vector<Vec3>& position, Index a, Index b) noexcept {
  return 0.5 * (position[at(a)] + position[at(b)]);
}

CutMesh::Middle edge_of(Index a, Index b) noexcept { return {std::min(a, b), std::max(a, b), mesh::Mesh::none}; }

bool before(const CutMesh::Middle& x, const CutMesh::Middle& y) noexcept { return x.a != y.a ? x.a < y.a : x.b < y.b; }

// The middle of an edge in a sorted list, or none.
Index find_middle(const Vector<CutMesh::Middle>& list, Index a, Index b) noexcept {
  const CutMesh::Middle edge = edge_of(a, b);
  const auto found = std::lower_bound(list.begin(), list.end(), edge, before);
  return found == list.end() || before(edge, *found) ? mesh::Mesh::none : found->vertex;
}

}  // namespace

double coarse_part(const surface::Core& core, double length) noexcept {
  const mesh::Mesh& mesh = core.mesh;
  double coarse = 0, all = 0;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index* c = mesh.triangle(t);
    const Vec3 p = mesh.positions[at(c[0])], q = mesh.positions[at(c[1])], r = mesh.positions[at(c[2])];
    const double area = norm(cross(q - p, r - p));
    all += area;
    if (std::max({norm(q - p), norm(r - q), norm(p - r)}) > coarse_length * length) coarse += area;
  }
  return all > 0 ? coarse / all : 1;
}

bool is_coarse(double coarse_part) noexcept { return coarse_part >= coarse_share; }

Index CutMesh::middle_of(Index a, Index b) const noexcept { return find_middle(middle, a, b); }

CutMesh CutMesh::make(const surface::Core& core, double longest, Index most) {
  Memory& memory = *core.memory;
  CutMesh out(memory);
  out.position.assign(core.mesh.positions.begin(), core.mesh.positions.end());
  out.corner.assign(core.mesh.corners.begin(), core.mesh.corners.end());
  for (Index t = 0; t < core.mesh.triangle_count(); ++t) out.parent.push_back(t);
  out.weight.assign(out.parent.size(), Weights{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  // The longest edges are halved first, so the shortest edges remain where it ends.
  double now = longest_edge(core);
  while (now > longest && out.cut(std::max(longest, now / 2), most, memory)) {
    now = 0;
    for (std::size_t i = 0; i < out.corner.size(); ++i) {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      now = std::max(now, norm(out.position[at(out.corner[next])] - out.position[at(out.corner[i])]));
    }
  }
  std::sort(out.middle.begin(), out.middle.end(), before);
  return out;
}

// Cuts every edge longer than `longest` once. Returns whether the result has no more than `most` triangles; if not,
// nothing has changed.
bool CutMesh::cut(double longest, Index most, Memory& memory) {
  Poller poller;
  Vector<Middle> cuts(&memory);
  const auto is_long = [&](Index a, Index b) { return norm(position[at(b)] - position[at(a)]) > longest; };
  for (std::size_t i = 0; i < corner.size(); ++i) {
    poller.due();
    const Index a = corner[i], b = corner[i % 3 == 2 ? i - 2 : i + 1];
    if (is_long(a, b)) cuts.push_back(edge_of(a, b));
  }
  // An edge of a triangle that is cut makes one more.
  if (parent.size() + cuts.size() > at(most)) return false;
  std::sort(cuts.begin(), cuts.end(), before);
  cuts.erase(std::unique(cuts.begin(), cuts.end(),
                         [](const Middle& x, const Middle& y) { return !before(x, y) && !before(y, x); }),
             cuts.end());
  for (Middle& edge : cuts) {
    edge.vertex = static_cast<Index>(position.size());
    position.push_back(between(position, edge.a, edge.b));
  }
  middle.insert(middle.end(), cuts.begin(), cuts.end());
  const std::size_t triangles = parent.size();
  for (std::size_t t = 0; t < triangles; ++t) {
    poller.due();
    // The six places of the triangle: its corners, and the middles of the sides that begin there.
    Index place[6];
    double weights[6][3];
    int count = 0, single = 0, whole = 0;
    const Weights old = weight[t];
    for (int k = 0; k < 3; ++k) {
      place[k] = corner[3 * t + static_cast<std::size_t>(k)];
      std::copy(old.of[k], old.of[k] + 3, weights[k]);
    }
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      place[3 + k] = is_long(place[k], place[next]) ? find_middle(cuts, place[k], place[next]) : mesh::Mesh::none;
      if (place[3 + k] == mesh::Mesh::none)
        whole = k;
      else {
        ++count;
        single = k;
      }
      for (int j = 0; j < 3; ++j) weights[3 + k][j] = 0.5 * (old.of[k][j] + old.of[next][j]);
    }
    if (count == 0) continue;
    const Index of = parent[t];
    bool first = true;
    const auto add = [&](int a, int b, int c) {
      Weights own;
      const int corners[3] = {a, b, c};
      for (int k = 0; k < 3; ++k) std::copy(weights[corners[k]], weights[corners[k]] + 3, own.of[k]);
      if (first) {
        for (std::size_t k = 0; k < 3; ++k) corner[3 * t + k] = place[corners[k]];
        weight[t] = own;
        first = false;
        return;
      }
      for (const int k : corners) corner.push_back(place[k]);
      parent.push_back(of);
      weight.push_back(own);
    };
    if (count == 1) {
      const int k = single, next = (k + 1) % 3, last = (k + 2) % 3;
      add(k, 3 + k, last);
      add(3 + k, next, last);
    } else if (count == 2) {
      const int k = whole, next = (k + 1) % 3, last = (k + 2) % 3, p = 3 + next, q = 3 + last;
      add(p, last, q);
      const auto length = [&](int a, int b) { return norm(position[at(place[b])] - position[at(place[a])]); };
      if (length(k, p) <= length(next, q)) {
        add(k, next, p);
        add(k, p, q);
      } else {
        add(k, next, q);
        add(next, p, q);
      }
    } else {
      add(0, 3, 5);
      add(3, 1, 4);
      add(5, 4, 2);
      add(3, 4, 5);
    }
  }
  return true;
}

namespace {

CutMesh cut_checked(const surface::Core& whole, double length, double quads) {
  // Refuses a mesh that is no surface. A cut one has more edges, so its faults are a smaller share.
  remesh::FluxSurface::make(whole.mesh, whole.topology(), *whole.memory);
  return CutMesh::make(whole, cut_length * length, most_triangles(whole, quads));
}

}  // namespace

CutBase::CutBase(const surface::Core& whole, double given_length, double given_quads)
    : length(given_length),
      quads(given_quads),
      facet(std::min(mean_edge(whole), most_facet * length)),
      cut(cut_checked(whole, length, quads)),
      core(core_like(whole, cut.position, cut.corner)) {}

remesh::SurfacePoint CutBase::in_whole(const remesh::SurfacePoint& point) const noexcept {
  const std::size_t t = at(point.triangle);
  remesh::SurfacePoint out;
  out.triangle = cut.parent[t];
  for (std::size_t j = 0; j < 3; ++j) {
    // The corner of the cut triangle that is corner j in the core.
    std::size_t k = 0;
    while (core->mesh.inner_of_given[at(cut.corner[3 * t + k])] != core->mesh.triangle(point.triangle)[j]) ++k;
    for (std::size_t i = 0; i < 3; ++i) out.weight[i] += point.weight[j] * cut.weight[t].of[k][i];
  }
  return out;
}

}  // namespace hf_inner::quads
