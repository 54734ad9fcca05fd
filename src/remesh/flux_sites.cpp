#include "remesh/flux_sites.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/elementary.h"
#include "base/error.h"
#include "base/progress.h"
#include "factor/factor.h"
#include "remesh/border_flux.h"
#include "remesh/constants.h"

namespace hf_inner {
namespace {

// Computes the lengths of the shortest paths along edges from one vertex, and -1 for vertices without a path. Edges
// between a border and its apex (the vertex that closes it) have length 0.
void distances_from(const FluxSurface& s, std::int32_t source, Table<double>& distance, Memory& memory) {
  using Entry = std::pair<double, std::int32_t>;
  Vector<Entry> heap(&memory);
  const auto later = std::greater<Entry>();
  distance.assign(s.vertex_count(), -1.0);
  distance[source] = 0, heap.push_back({0.0, source});
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), later);
    const Entry entry = heap.back();
    heap.pop_back();
    const std::int32_t v = entry.second;
    if (entry.first > distance[v]) continue;
    if (s.is_apex(v) && v != source) continue;  // paths must not cross a hole
    const std::int32_t begin = s.out[v];
    for (std::int32_t g = begin;;) {
      const std::int32_t w = s.head(g);
      const double step = s.is_apex(v) || s.is_apex(w) ? 0.0 : norm(s.position[w] - s.position[v]);
      const double d = entry.first + step;
      if (distance[w] < 0 || d < distance[w]) {
        distance[w] = d, heap.push_back({d, w});
        std::push_heap(heap.begin(), heap.end(), later);
      }
      g = s.turn_left(g);
      if (g == begin) break;
    }
  }
}

Table<double> vertex_shares(const FluxSurface& s, Memory& memory) {
  Table<double> area(s.vertex_count(), 0.0, memory);
  for (std::int32_t t = 0; t < s.real_triangles; ++t) {
    const Vec3 a = s.position[s.tail[3 * t]], b = s.position[s.tail[3 * t + 1]], c = s.position[s.tail[3 * t + 2]];
    const double third = norm(cross(b - a, c - a)) / 6;
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) area[s.tail[h]] += third;
  }
  return area;
}

double border_length(const FluxSurface& s, std::int32_t apex) {
  double length = 0;
  const std::int32_t begin = s.out[apex];
  for (std::int32_t g = begin;;) {
    length += norm(s.position[s.head(g)] - s.position[s.head(s.turn_left(g))]);
    g = s.turn_left(g);
    if (g == begin) return length;
  }
}

double even(double x) { return std::max(least_lines, 2 * std::round(x / 2)); }

// The sites of one component, and the distances between them.
struct Group {
  explicit Group(Memory& memory) : sites(&memory), distance(&memory) {}
  Vector<FluxSite> sites;
  Vector<double> distance;  // between sites i and j: [i * count + j]
};

// Returns the cost of a partition into sources and sinks (flux_sites.h). sinks: one flag per site.
double partition_cost(const Group& g, const Vector<std::uint8_t>& sinks) {
  const std::size_t k = g.sites.size();
  double up = 0, down = 0, mean = 0, close = 0, like = 0;
  for (std::size_t i = 0; i < k; ++i) (sinks[i] ? up : down) += g.sites[i].lines;
  if (up <= 0 || down <= 0) return HUGE_VAL;
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < i; ++j) mean += g.distance[i * k + j];
  mean = std::max(mean / (0.5 * static_cast<double>(k * (k - 1))), least_mean_distance);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (sinks[i] != sinks[j]) continue;
      close += exponential(-g.distance[i * k + j] / mean), like += 1;
    }
  }
  return std::fabs(up - down) / (up + down) + (like > 0 ? neighbour_cost * close / like : 0.0);
}

// Chooses which sites are sinks. For few sites it tries all partitions. For more it exchanges one or two sites while
// the cost falls.
Vector<std::uint8_t> partition(const Group& g) {
  const std::size_t k = g.sites.size();
  Vector<std::uint8_t> best(k, std::uint8_t{0}, g.sites.get_allocator().resource()), trial(best, best.get_allocator());
  best[0] = 1;
  double least = partition_cost(g, best);
  if (k <= most_tried_at_once) {
    for (std::uint32_t d = 1; d < (1u << (k - 1)); ++d) {
      for (std::size_t i = 0; i < k; ++i) trial[i] = d >> i & 1;
      const double cost = partition_cost(g, trial);
      if (cost < least) least = cost, best = trial;
    }
    return best;
  }
  for (std::size_t i = 0; i < k; ++i) best[i] = i % 2 == 0;
  least = partition_cost(g, best);
  for (bool better = true; better;) {
    better = false;
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t j = k <= most_exchanged_in_pairs ? 0 : i; j <= i; ++j) {
        trial = best, trial[i] ^= 1;
        if (i != j) trial[j] ^= 1;
        const double cost = partition_cost(g, trial);
        if (cost < least - least_cost_gain) least = cost, best = trial, better = true;
      }
    }
  }
  return best;
}

// Scales the flow lines of all sinks, or of all sources, to the sum `total`, in steps of two lines.
void share_out(Vector<FluxSite>& sites, bool sinks, double total) {
  double sum = 0;
  for (const FluxSite& site : sites)
    if ((site.lines > 0) == sinks) sum += std::fabs(site.lines);
  double given = 0;
  Vector<std::pair<double, std::size_t>> rest(sites.get_allocator());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if ((sites[i].lines > 0) != sinks) continue;
    const double exact = std::fabs(sites[i].lines) * total / sum,
                 whole = std::max(least_lines, 2 * std::floor(exact / 2));
    rest.push_back({whole - exact, i});
    sites[i].lines = sinks ? whole : -whole, given += whole;
  }
  std::sort(rest.begin(), rest.end());
  for (std::size_t turn = 0; given != total; turn = (turn + 1) % rest.size()) {
    FluxSite& site = sites[rest[given < total ? turn : rest.size() - 1 - turn].second];
    const double step = given < total ? 2.0 : -2.0;
    if (std::fabs(site.lines) + step < least_lines) continue;
    site.lines += sinks ? step : -step, given += step;
  }
}

// Scales sources and sinks to the same even number of flow lines.
void even_out(Vector<FluxSite>& sites) {
  double up = 0, down = 0;
  std::size_t up_count = 0, down_count = 0;
  for (const FluxSite& site : sites) {
    (site.lines > 0 ? up : down) += std::fabs(site.lines);
    ++(site.lines > 0 ? up_count : down_count);
  }
  const double least = least_lines * static_cast<double>(std::max(up_count, down_count));
  const double total = std::max(2 * std::round(std::max(up, down) / 2), least);
  share_out(sites, true, total);
  share_out(sites, false, total);
}

void balance(Group& group) {
  bool chosen = false;
  for (const FluxSite& site : group.sites) chosen |= site.lines < 0;
  if (!chosen) {
    const Vector<std::uint8_t> sinks = partition(group);
    for (std::size_t i = 0; i < group.sites.size(); ++i)
      if (!sinks[i]) group.sites[i].lines = -group.sites[i].lines;
  }
  even_out(group.sites);
}

}  // namespace

Vector<FluxSite> choose_flux_sites(const FluxSurface& s, Span<const FluxSite> given, bool automatic, double edge_length,
                                   Memory& memory) {
  Vector<FluxSite> all(&memory);
  const Table<double> area = vertex_shares(s, memory);
  // Computes the Euler characteristic of each component after its borders are closed.
  Table<std::int32_t> euler(s.component_count, 0, memory);
  Table<std::int32_t> first(s.component_count, -1, memory);
  for (std::int32_t v = 0; v < s.vertex_count(); ++v) {
    euler[s.component[v]] += 1;
    if (first[s.component[v]] < 0) first[s.component[v]] = v;
  }
  // V - E + F, where closed triangle meshes have E = 3 F / 2.
  Table<std::int32_t> faces(s.component_count, 0, memory);
  for (std::int32_t t = 0; 3 * t < s.half_count(); ++t) faces[s.component[s.tail[3 * t]]] += 1;
  for (std::int32_t c = 0; c < s.component_count; ++c) euler[c] -= faces[c] / 2;
  Table<double> distance(memory), nearest(memory);
  for (std::int32_t c = 0; c < s.component_count; ++c) {
    Group group(memory);
    bool signs = false;
    for (std::int32_t v = s.first_apex; v < s.vertex_count(); ++v)
      if (s.component[v] == c) group.sites.push_back({v, 0.0});
    const std::size_t borders = group.sites.size();
    const std::size_t wanted = euler[c] < 2 && automatic ? least_sites_with_handles : least_sites;
    if (borders + given.size() > most_sites)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
           "a component has %zu borders; with the sites at most %zu can be partitioned", borders, most_sites);
    Vector<Table<double>> from(&memory);
    nearest.assign(s.vertex_count(), HUGE_VAL);
    auto reach = [&](std::size_t i) {
      const float part =
          static_cast<float>(i) / static_cast<float>(i + expected_sites);  // the number of sites is not known yet
      report((static_cast<float>(c) + part) / static_cast<float>(s.component_count));
      distances_from(s, group.sites[i].vertex, distance, memory);
      // The number of flow lines follows from the length of the circle around the site. That length is the derivative
      // of the area of discs.
      if (group.sites[i].lines == 0) {
        double circumference = 0;
        if (s.is_apex(group.sites[i].vertex)) {
          circumference = border_length(s, group.sites[i].vertex);
        } else {
          for (std::int32_t v = 0; v < s.first_apex; ++v)
            if (distance[v] >= (1 - circle_band) * circle_radius && distance[v] < (1 + circle_band) * circle_radius)
              circumference += area[v];
          circumference /= 2 * circle_band * circle_radius;
        }
        group.sites[i].lines = even(circumference / edge_length);
      }
      for (std::int32_t v = 0; v < s.vertex_count(); ++v)
        if (distance[v] >= 0) nearest[v] = std::min(nearest[v], distance[v]);
      from.push_back(distance);
    };
    for (std::size_t i = 0; i < borders; ++i) reach(i);
    for (const FluxSite& site : given) {
      if (s.component[site.vertex] != c || (automatic && nearest[site.vertex] < border_distance)) continue;
      group.sites.push_back(site), signs |= site.lines != 0;
      reach(group.sites.size() - 1);
    }
    while (group.sites.size() < wanted) {
      if (group.sites.empty()) {  // takes the vertex farthest from an arbitrary one
        distances_from(s, first[c], distance, memory);
        std::int32_t far = first[c];
        for (std::int32_t v = 0; v < s.first_apex; ++v)
          if (distance[v] > distance[far]) far = v;
        group.sites.push_back({far, 0.0});
      } else {
        std::int32_t far = -1;
        for (std::int32_t v = 0; v < s.first_apex; ++v)
          if (s.component[v] == c && (far < 0 || nearest[v] > nearest[far])) far = v;
        if (far < 0 || nearest[far] <= 0)
          fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "a component of the surface has no room for two sites");
        group.sites.push_back({far, 0.0});
      }
      reach(group.sites.size() - 1);
    }
    const std::size_t k = group.sites.size();
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t j = 0; j < k; ++j) group.distance.push_back(std::max(from[i][group.sites[j].vertex], 0.0));
    if (signs) {
      bool sink = false, source = false;
      for (const FluxSite& site : group.sites) sink |= site.lines > 0, source |= site.lines < 0;
      if (!sink || !source)
        fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
             "the sites of a component are all %s; give lines of both signs, or 0 for all", sink ? "sinks" : "sources");
    }
    balance(group);
    all.insert(all.end(), group.sites.begin(), group.sites.end());
    report(static_cast<float>(c + 1) / static_cast<float>(s.component_count));
  }
  return all;
}

FluxSolver::FluxSolver(const FluxSurface& s, Memory& memory, JobRunner& jobs)
    : surface_(&s), memory_(&memory), jobs_(&jobs) {
  const std::int32_t n = s.vertex_count();
  SymmetricMatrix k(memory);
  k.column_start.push_back(0);
  Vector<std::pair<std::int32_t, double>> column(&memory);
  Table<std::uint8_t> pinned(s.component_count, 0, memory);
  Vector<float> coordinates(&memory);
  Poller poller;
  for (std::int32_t v = 0; v < n; ++v) {
    poller.due();
    column.clear();
    double diagonal = 0;
    const std::int32_t begin = s.out[v];
    for (std::int32_t g = begin;;) {
      column.push_back({s.head(g), -s.weight[g]}), diagonal += s.weight[g];
      g = s.turn_left(g);
      if (g == begin) break;
    }
    if (!pinned[s.component[v]])
      pinned[s.component[v]] = 1, column.push_back({v, pinned_diagonal * diagonal});
    else
      column.push_back({v, diagonal});
    std::sort(column.begin(), column.end());
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (i > 0 && k.row.back() == column[i].first && static_cast<std::int32_t>(k.row.size()) > k.column_start.back()) {
        k.value.back() += column[i].second;  // two edges between the same two vertices
      } else {
        k.row.push_back(column[i].first), k.value.push_back(column[i].second);
      }
    }
    k.column_start.push_back(static_cast<std::int32_t>(k.row.size()));
    const Vec3 p = s.position[v];
    coordinates.push_back(static_cast<float>(p.x)), coordinates.push_back(static_cast<float>(p.y));
    coordinates.push_back(static_cast<float>(p.z));
  }
  FactorOptions options;
  factor_ = Factor::make(k, coordinates, options, memory, jobs);
}

Vector<double> FluxSolver::solve(Span<const FluxSite> sites) const {
  const FluxSurface& s = *surface_;
  const std::int32_t n = s.vertex_count();
  Vector<double> b(static_cast<std::size_t>(n), 0.0, memory_), z(static_cast<std::size_t>(n), 0.0, memory_),
      u(static_cast<std::size_t>(n), 0.0, memory_), r(memory_);
  for (const FluxSite& site : sites) b[static_cast<std::size_t>(site.vertex)] += site.lines;
  r = b;
  for (int round = 0; round < flux_solves; ++round) {
    factor_->solve(r.data(), r.data(), 1, z.data(), *jobs_);
    for (std::size_t v = 0; v < u.size(); ++v) u[v] += r[v];
    for (std::int32_t v = 0; v < n; ++v) {
      double sum = b[static_cast<std::size_t>(v)];
      const std::int32_t begin = s.out[v];
      for (std::int32_t g = begin;;) {
        sum += s.weight[g] * (u[static_cast<std::size_t>(s.head(g))] - u[static_cast<std::size_t>(v)]);
        g = s.turn_left(g);
        if (g == begin) break;
      }
      r[static_cast<std::size_t>(v)] = sum;
    }
  }
  return u;
}

void scale_lines(const FluxSurface& surface, std::int32_t component, double factor, Vector<FluxSite>& sites) {
  Vector<FluxSite> own(sites.get_allocator());
  for (const FluxSite& site : sites)
    if (surface.component[site.vertex] == component) own.push_back({site.vertex, site.lines * factor});
  even_out(own);
  std::size_t next = 0;
  for (FluxSite& site : sites)
    if (surface.component[site.vertex] == component) site = own[next++];
}

Vector<double> solve_with_borders(const FluxSurface& s, const FluxSolver& solver, Vector<FluxSite>& sites) {
  const Vector<FluxSite> asked(sites, sites.get_allocator());
  for (int round = 0;; ++round) {
    Vector<double> u = solver.solve(sites);
    const FluxSite* crossed = nullptr;
    for (FluxSite& site : sites) {
      if (!s.is_apex(site.vertex)) continue;
      bool wrong = false;
      const std::int32_t begin = s.out[site.vertex];
      for (std::int32_t g = begin;;) {
        const double rise = u[static_cast<std::size_t>(s.head(g))] - u[static_cast<std::size_t>(site.vertex)];
        wrong |= site.lines > 0 ? rise >= 0 : rise <= 0;
        g = s.turn_left(g);
        if (g == begin) break;
      }
      if (wrong) site.lines *= border_raise, crossed = &site;
    }
    if (!crossed) return u;
    if (round == border_rounds) {
      sites = asked;  // raised lines would only make the mesh finer
      return solve_between_levels(s, solver, sites);
    }
    for (std::int32_t c = 0; c < s.component_count; ++c) scale_lines(s, c, 1.0, sites);
  }
}

}  // namespace hf_inner
