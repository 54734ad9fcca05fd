#include "field/extremities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/index.h"
#include "field/peaks.h"
#include "mesh/link_constants.h"

namespace hf_inner::field {
namespace {

// Calls work(component, begin, end) for every run of consecutive vertices of one component.
template <class Work>
void for_runs(const surface::Core& core, Work&& work) {
  const SharedVector<Index>& component = core.mesh.component;
  for (std::size_t begin = 0, end = 0; begin < component.size(); begin = end) {
    for (end = begin + 1; end < component.size() && component[end] == component[begin];) ++end;
    work(at(component[begin]), begin, end);
  }
}

// A light piece counts as its edges do, so that no tip of a sheet rises above the body: the field falls as much there.
double area_of(const surface::Core& core, std::size_t v) noexcept {
  const mesh::Links* const links = core.geometry->links.get();
  return links && links->light[at(links->piece[v])] ? mesh::light_share * core.areas[v] : core.areas[v];
}

// Returns the area of every component.
Vector<double> component_areas(const surface::Core& core) {
  Vector<double> total(core.ground.size(), 0.0, core.memory.get());
  for_runs(core, [&](std::size_t c, std::size_t begin, std::size_t end) {
    double sum = total[c];
    for (std::size_t v = begin; v < end; ++v) sum += area_of(core, v);
    total[c] = sum;
  });
  return total;
}

// Returns the vertex of each component that is farthest from the centroid of the component.
Vector<Index> farthest_vertices(const surface::Core& core, const Vector<double>& total) {
  const std::size_t components = core.ground.size();
  Vector<Vec3> centre(components, core.memory.get());
  Vector<double> most(components, -1.0, core.memory.get());
  Vector<Index> farthest(core.ground.begin(), core.ground.end(), core.memory.get());
  for_runs(core, [&](std::size_t c, std::size_t begin, std::size_t end) {
    Vec3 sum = centre[c];
    for (std::size_t v = begin; v < end; ++v) sum = sum + area_of(core, v) * core.mesh.positions[v];
    centre[c] = sum;
  });
  for (std::size_t c = 0; c < components; ++c) {
    if (total[c] > 0) centre[c] = (1 / total[c]) * centre[c];
  }
  for_runs(core, [&](std::size_t c, std::size_t begin, std::size_t end) {
    const Vec3 middle = centre[c];
    double best = most[c];
    Index where = farthest[c];
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3 d = core.mesh.positions[v] - middle;
      const double squared = dot(d, d);
      if (squared > best) {
        best = squared;
        where = static_cast<Index>(v);
      }
    }
    most[c] = best;
    farthest[c] = where;
  });
  return farthest;
}

constexpr Index unseen = std::numeric_limits<Index>::max();

// Breadth-first search from a vertex, over vertices whose level is `unseen`. It writes the level of each vertex, which
// is its number of edges from the start, and lists the vertices in `queue`. Returns how many vertices it found. The
// queue needs room for the number of vertices plus one.
std::size_t search_levels(const mesh::Topology& topology, Index from, Index* level, Index* queue) {
  const Index *const start = topology.neighbour_start.data(), *const neighbour = topology.neighbour.data();
  std::size_t head = 0, tail = 0;
  queue[tail++] = from;
  level[at(from)] = 0;
  while (head < tail) {
    const Index v = queue[head++], next = level[at(v)] + 1, end = start[at(v) + 1];
    for (Index i = start[at(v)]; i < end; ++i) {
      // The loop has no branch, because the processor would mispredict it half of the time.
      const Index w = neighbour[at(i)], old = level[at(w)];
      queue[tail] = w;
      tail += old > next;
      level[at(w)] = std::min(old, next);
    }
  }
  return tail;
}

// Returns the vertex of the last level that is farthest from the start in space. Many may have that level, and which of
// them the search finds last follows from the order of the vertices.
Index last_vertex(Span<const Vec3> positions, Index from, const Index* level, const Index* queue, std::size_t count) {
  Index best = queue[count - 1];
  for (std::size_t i = count; i-- > 0 && level[at(queue[i])] == level[at(best)];) {
    const Vec3 here = positions[at(queue[i])] - positions[at(from)], there = positions[at(best)] - positions[at(from)];
    if (dot(here, here) > dot(there, there)) best = queue[i];
  }
  return best;
}

// Marks a ring of vertices around the middle of each component. A breadth-first search starts at the farthest vertex.
// The ring is about half as many edges away from there as the last vertex that the search finds, on the way to the
// farthest of these. The ring is edge-connected.
void mark_middles(const surface::Core& core, const Vector<double>& total, Vector<std::uint8_t>& middle) {
  const mesh::Topology& topology = core.topology();
  const std::size_t n = middle.size();
  Vector<Index> levels(n, unseen, core.memory.get()), waiting(n + 1, core.memory.get());
  Index *const level = levels.data(), *const queue = waiting.data();
  const Index *const start = topology.neighbour_start.data(), *const neighbour = topology.neighbour.data();
  for (const Index from : farthest_vertices(core, total)) {
    const auto away = [&](Index v) { return norm(core.mesh.positions[at(v)] - core.mesh.positions[at(from)]); };
    std::size_t head = 0, tail = search_levels(topology, from, level, queue);
    Index v = last_vertex(core.mesh.positions, from, level, queue, tail);
    const Index half = level[at(v)] / 2;
    while (level[at(v)] > half) {
      Index below = mesh::Mesh::none;
      for (Index i = start[at(v)]; i < start[at(v) + 1]; ++i) {
        const Index w = neighbour[at(i)];
        if (level[at(w)] + 1 != level[at(v)]) continue;
        if (below == mesh::Mesh::none || away(w) < away(below)) below = w;
      }
      v = below;
    }
    // The ring takes two neighbouring levels of the search, because the vertices of one level need not be
    // edge-connected.
    head = tail = 0;
    queue[tail++] = v;
    middle[at(v)] = 1;
    while (head < tail) {
      const Index w = queue[head++];
      for (Index i = start[at(w)]; i < start[at(w) + 1]; ++i) {
        const Index x = neighbour[at(i)];
        if (middle[at(x)] || level[at(x)] < half || level[at(x)] > half + 1) continue;
        middle[at(x)] = 1;
        queue[tail++] = x;
      }
    }
  }
}

// Solves the Poisson equation for u. Every vertex is a source of its area. The ring of vertices around the middle of
// each component takes all of it in evenly.
void solve_poisson(const surface::Core& core, const Vector<double>& total, Vector<double>& u) {
  Vector<std::uint8_t> middle(u.size(), 0, core.memory.get());
  mark_middles(core, total, middle);
  Vector<double> taken(total.size(), 0.0, core.memory.get());
  for (std::size_t v = 0; v < u.size(); ++v) {
    if (middle[v]) taken[at(core.mesh.component[v])] += area_of(core, v);
  }
  surface::Workspace z(core.workspaces, u.size());
  for_runs(core, [&](std::size_t c, std::size_t begin, std::size_t end) {
    // A middle ring without area takes nothing in. The right side of its component is then 0, so nothing flows into the
    // vertex that makes the matrix regular.
    const double outside = taken[c] > 0 ? 1 : 0, inside = taken[c] > 0 ? 1 - total[c] / taken[c] : 0.0;
    for (std::size_t v = begin; v < end; ++v) u[v] = area_of(core, v) * (middle[v] ? inside : outside);
  });
  core.factor->solve(u.data(), u.data(), 1, z.data(), *core.jobs);
}

double length_of(double fall, bool poisson) noexcept {
  fall = std::max(fall, 0.0);
  return poisson ? std::sqrt(2 * fall) : fall;
}

// Adds the maxima (tips) of found.field to the list if their limbs are long enough, with the lengths.
void propose(const surface::Core& core, const Vector<double>& total, double least_length_share, bool poisson,
             Extremities& found) {
  const Vector<double>& u = found.field;
  const Vector<Peak> peaks = find_peaks(core.topology(), u, *core.memory);
  // base[c]: level from which the length of the highest tip of component c is measured.
  Vector<double> base(total.size(), 0.0, core.memory.get());
  for_runs(core, [&](std::size_t c, std::size_t begin, std::size_t end) {
    double sum = base[c];
    for (std::size_t v = begin; v < end; ++v) sum += area_of(core, v) * u[v];
    base[c] = sum;
  });
  for (std::size_t c = 0; c < total.size(); ++c) base[c] = total[c] > 0 ? base[c] / total[c] : 0.0;
  const auto propose_one = [&](const Peak& peak, double level) {
    const double length = length_of(u[at(peak.vertex)] - level, poisson);
    if (length < least_length_share) return false;
    found.points.push_back({peak.vertex, core.mesh.component[at(peak.vertex)], length});
    return true;
  };
  for (const Peak& peak : peaks) {
    if (peak.saddle == mesh::Mesh::none || !propose_one(peak, u[at(peak.saddle)])) continue;
    double& level = base[at(core.mesh.component[at(peak.vertex)])];
    level = std::min(level, u[at(peak.saddle)]);
  }
  for (const Peak& peak : peaks) {
    if (peak.saddle == mesh::Mesh::none) propose_one(peak, base[at(core.mesh.component[at(peak.vertex)])]);
  }
  std::sort(found.points.begin(), found.points.end(), [](const Extremity& a, const Extremity& b) {
    return a.length != b.length ? a.length > b.length : a.vertex < b.vertex;
  });
}

}  // namespace

Extremities poisson_extremities(const surface::Core& core, double least_length_share) {
  constexpr float summed = 0.1f, solved = 0.8f;  // reported progress, by the usual share of time
  Extremities found(*core.memory);
  found.field.resize(at(core.size()));
  const Vector<double> total = component_areas(core);
  report(summed);
  solve_poisson(core, total, found.field);
  report(solved);
  propose(core, total, least_length_share, true, found);
  report(1.0f);
  return found;
}

Extremities geodesic_extremities(const Geodesics& geodesics, std::int32_t source_count, double least_length_share) {
  const surface::Core& core = geodesics.core();
  Extremities found(*core.memory);
  found.field.resize(at(core.size()));
  {
    constexpr float averaged = 0.95f;  // reported progress
    const ProgressRange range(0.0f, averaged);
    geodesics.average(source_count, found.field.data());
  }
  propose(core, component_areas(core), least_length_share, false, found);
  report(1.0f);
  return found;
}

Extremities geodesic_extremities(std::shared_ptr<const surface::Core> core, double smoothing, std::int32_t source_count,
                                 double least_length_share) {
  constexpr float factored = 0.3f;  // share of progress
  const std::optional<Geodesics> geodesics = [&] {
    const ProgressRange range(0.0f, factored);
    return std::optional<Geodesics>(std::in_place, std::move(core), smoothing);
  }();
  const ProgressRange range(factored, 1.0f);
  return geodesic_extremities(*geodesics, source_count, least_length_share);
}

}  // namespace hf_inner::field
