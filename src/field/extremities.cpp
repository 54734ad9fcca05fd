#include "field/extremities.h"

#include <algorithm>
#include <cmath>

#include "field/peaks.h"

namespace hf {
namespace {

using Index = std::int32_t;
std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

// vertex_areas with everything in one loop: a sixth of the time of the search otherwise.
Vector<double> areas_of(const Core& core) {
  Vector<double> areas(at(core.size()), 0.0, core.memory.get());
  const Vec3* p = core.mesh.positions.data();
  for (Index t = 0; t < core.mesh.triangle_count(); ++t) {
    const Index* v = core.mesh.triangle(t);
    const Vec3 a = p[v[0]], n = cross(p[v[1]] - a, p[v[2]] - a);
    const double third = std::sqrt(dot(n, n)) * (1.0 / 6);
    for (int k = 0; k < 3; ++k) areas[at(v[k])] += third;
  }
  return areas;
}

// The vertex of each component that is farthest from its centroid.
Vector<Index> farthest_vertices(const Core& core, const Vector<double>& areas) {
  const std::size_t components = core.ground.size();
  Vector<Vec3> centre(components, core.memory.get());
  Vector<double> total(components, 0.0, core.memory.get()), most(components, -1.0, core.memory.get());
  Vector<Index> farthest(core.ground.begin(), core.ground.end(), core.memory.get());
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const std::size_t c = at(core.mesh.component[v]);
    centre[c] = centre[c] + areas[v] * core.mesh.positions[v], total[c] += areas[v];
  }
  for (std::size_t c = 0; c < components; ++c) {
    if (total[c] > 0) centre[c] = (1 / total[c]) * centre[c];
  }
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const std::size_t c = at(core.mesh.component[v]);
    const Vec3 d = core.mesh.positions[v] - centre[c];
    const double squared = dot(d, d);
    if (squared > most[c]) most[c] = squared, farthest[c] = static_cast<Index>(v);
  }
  return farthest;
}

// A ring of vertices around the middle of each component: those at one number of edges from the farthest vertex, half
// as many as to the end that a breadth-first search from there comes to, as far as they hang together with the vertex
// half way.
void mark_middles(const Core& core, const Vector<double>& areas, Vector<std::uint8_t>& middle) {
  const Topology& topology = core.topology;
  Vector<Index> level(areas.size(), Mesh::none, core.memory.get()), queue(areas.size() + 1, core.memory.get());
  for (const Index from : farthest_vertices(core, areas)) {
    std::size_t head = 0, tail = 0;
    queue[tail++] = from, level[at(from)] = 0;
    while (head < tail) {
      const Index v = queue[head++], next = level[at(v)] + 1;
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        const Index w = topology.neighbour[at(i)];
        const bool fresh = level[at(w)] == Mesh::none;  // no branch: it would be mispredicted every other time
        level[at(w)] = fresh ? next : level[at(w)];
        queue[tail] = w, tail += fresh;
      }
    }
    Index v = queue[tail - 1];
    const Index half = level[at(v)] / 2;
    while (level[at(v)] > half) {
      Index i = topology.neighbour_start[at(v)];
      while (level[at(topology.neighbour[at(i)])] + 1 != level[at(v)]) ++i;
      v = topology.neighbour[at(i)];
    }
    // two levels, because one alone need not hang together
    head = tail = 0;
    queue[tail++] = v, middle[at(v)] = 1;
    while (head < tail) {
      const Index w = queue[head++];
      for (Index i = topology.neighbour_start[at(w)]; i < topology.neighbour_start[at(w) + 1]; ++i) {
        const Index x = topology.neighbour[at(i)];
        if (middle[at(x)] || level[at(x)] < half || level[at(x)] > half + 1) continue;
        middle[at(x)] = 1, queue[tail++] = x;
      }
    }
  }
}

// u of the unit source density with all of a component's area taken in evenly by its middle.
void solve_poisson(const Core& core, const Vector<double>& areas, Vector<double>& u) {
  const Span<const Index> position = core.factor->position();
  const std::size_t components = core.ground.size();
  Vector<std::uint8_t> middle(areas.size(), 0, core.memory.get());
  mark_middles(core, areas, middle);
  Vector<double> whole(components, 0.0, core.memory.get()), taken(components, 0.0, core.memory.get());
  for (std::size_t v = 0; v < areas.size(); ++v) {
    whole[at(core.mesh.component[v])] += areas[v];
    if (middle[v]) taken[at(core.mesh.component[v])] += areas[v];
  }
  Workspace z(core.workspaces, areas.size());
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const std::size_t c = at(core.mesh.component[v]);
    // a middle without area takes nothing in: its component has no field, and no flow into the ground
    z[at(position[v])] = taken[c] > 0 ? areas[v] * (middle[v] ? 1 - whole[c] / taken[c] : 1.0) : 0.0;
  }
  core.factor->forward(z.data(), 1, *core.jobs);
  core.factor->backward(z.data(), 1, *core.jobs);
  for (std::size_t v = 0; v < areas.size(); ++v) u[v] = z[at(position[v])];
}

double length_of(double fall, bool poisson) noexcept {
  fall = std::max(fall, 0.0);
  return poisson ? std::sqrt(2 * fall) : fall;
}

// Peaks of found.field that are long enough, with their lengths.
void propose(const Core& core, const Vector<double>& areas, double least_length, bool poisson, Extremities& found) {
  const std::size_t components = at(core.mesh.component_count());
  const Vector<double>& u = found.field;
  const Vector<Peak> peaks = find_peaks(core.topology, u, *core.memory);
  // what the highest point of a component falls to
  Vector<double> base(components, 0.0, core.memory.get()), total(components, 0.0, core.memory.get());
  for (std::size_t v = 0; v < u.size(); ++v) {
    const std::size_t c = at(core.mesh.component[v]);
    base[c] += areas[v] * u[v], total[c] += areas[v];
  }
  for (std::size_t c = 0; c < components; ++c) base[c] = total[c] > 0 ? base[c] / total[c] : 0.0;
  const auto propose_one = [&](const Peak& peak, double level) {
    const double length = length_of(u[at(peak.vertex)] - level, poisson);
    if (length < least_length) return false;
    found.points.push_back({peak.vertex, core.mesh.component[at(peak.vertex)], length});
    return true;
  };
  for (const Peak& peak : peaks) {
    if (peak.saddle == Mesh::none || !propose_one(peak, u[at(peak.saddle)])) continue;
    double& level = base[at(core.mesh.component[at(peak.vertex)])];
    level = std::min(level, u[at(peak.saddle)]);
  }
  for (const Peak& peak : peaks) {
    if (peak.saddle == Mesh::none) propose_one(peak, base[at(core.mesh.component[at(peak.vertex)])]);
  }
  std::sort(found.points.begin(), found.points.end(), [](const Extremity& a, const Extremity& b) {
    return a.length != b.length ? a.length > b.length : a.vertex < b.vertex;
  });
}

}  // namespace

Extremities poisson_extremities(const Core& core, double least_length, Progress* progress) {
  require_laplacian(core);
  Extremities found(*core.memory);
  found.field.resize(at(core.size()));
  const Vector<double> areas = areas_of(core);
  report(progress, 0.1f);
  solve_poisson(core, areas, found.field);
  report(progress, 0.8f);
  propose(core, areas, least_length, true, found);
  report(progress, 1.0f);
  return found;
}

Extremities geodesic_extremities(const Geodesics& geodesics, std::int32_t source_count, double least_length,
                                 Progress* progress) {
  const Core& core = geodesics.core();
  Extremities found(*core.memory);
  found.field.resize(at(core.size()));
  geodesics.average(source_count, found.field.data(), progress, 0.3f, 0.95f);
  propose(core, areas_of(core), least_length, false, found);
  report(progress, 1.0f);
  return found;
}

}  // namespace hf
