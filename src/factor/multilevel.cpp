#include "factor/multilevel.h"

#include <algorithm>

#include "base/progress.h"

namespace hf_inner::factor {
namespace {

// Graphs up to this many vertices are bisected without coarsening. At half the value: the factorisation's flops grow by
// 1 to 5 %. At twice the value: they change by -3 to +4 %, and larger flow problems cost time.
constexpr std::int32_t direct_size = 400;
// Parts of the graph with at least this many vertices try more cut directions on their coarsest graph. Halving or
// doubling it changes the factorisation's flops by at most 2 %.
constexpr std::int32_t thorough_size = 4000;
// A separator carried back to a finer graph is widened by its neighbours this many times. At half the value: the
// factorisation's flops grow by 2 to 15 %. At twice the value: they change by -10 to +1 %, but finding it takes longer.
constexpr std::int32_t widening = 2;
// In large parts of the graph, a separator is improved this many more times, within a band around it. With none, the
// factorisation's flops grow by 1 to 4 %. With two they fall by 0 to 5 %, but finding the separator takes longer.
constexpr std::int32_t repeats = 1;
// A widened separator leaves at least 1 / this of the graph on each side. With 2, the factorisation's flops grow by up
// to 54 %. With 10 they change by -4 to +3 %.
constexpr std::int32_t smallest_side = 5;
// A graph is not coarsened if its coarser graph would be a larger share of it. Halving or doubling it gives the same
// order.
constexpr double least_shrinking = 0.75;

}  // namespace

// Groups the vertices of a graph into clusters, which become the vertices of a coarser graph. A vertex whose neighbours
// are all free takes them into its cluster. Each remaining vertex joins the cluster of its first clustered neighbour.
std::int32_t MultilevelBisection::make_clusters(const GraphView& fine, std::int32_t* cluster) {
  const std::int32_t n = fine.size;
  const std::int32_t* start = fine.start;
  const std::int32_t* neighbour = fine.neighbour;
  std::fill(cluster, cluster + n, -1);
  std::int32_t count = 0;
  for (std::int32_t v = 0; v < n; ++v) {
    if (cluster[v] >= 0) continue;
    bool free = true;
    for (std::int32_t e = start[v]; free && e < start[v + 1]; ++e) free = cluster[neighbour[e]] < 0;
    if (!free) continue;
    cluster[v] = count;
    for (std::int32_t e = start[v]; e < start[v + 1]; ++e) cluster[neighbour[e]] = count;
    ++count;
  }
  for (std::int32_t v = 0; v < n; ++v) {
    if (cluster[v] >= 0) continue;
    std::int32_t joined = -1;
    for (std::int32_t e = start[v]; joined < 0 && e < start[v + 1]; ++e) joined = cluster[neighbour[e]];
    cluster[v] = joined >= 0 ? joined : count++;
  }
  return count;
}

void MultilevelBisection::coarsen(const GraphView& fine, Level& coarse) {
  const std::int32_t n = fine.size;
  const auto grow = [](auto& array, std::size_t size) {
    if (array.size() < size) array.resize(size);
    return array.data();
  };
  std::int32_t* cluster = grow(coarse.cluster, static_cast<std::size_t>(n));
  const std::int32_t count = make_clusters(fine, cluster);
  // Lists the vertices of each cluster (vertex of the coarser graph).
  cluster_start_.assign(static_cast<std::size_t>(count) + 1, 0);
  std::int32_t* member_start = cluster_start_.data();
  for (std::int32_t v = 0; v < n; ++v) ++member_start[cluster[v] + 1];
  for (std::int32_t c = 0; c < count; ++c) member_start[c + 1] += member_start[c];
  std::int32_t* member = grow(queue_, static_cast<std::size_t>(n));
  mark_.assign(cluster_start_.begin(), cluster_start_.end() - 1);
  std::int32_t* mark = mark_.data();
  for (std::int32_t v = 0; v < n; ++v) member[mark[cluster[v]]++] = v;
  std::fill(mark, mark + count, -1);
  std::int32_t* start = grow(coarse.start, static_cast<std::size_t>(count) + 1);
  std::int32_t* weight = grow(coarse.weight, static_cast<std::size_t>(count));
  std::int32_t* neighbour = grow(coarse.neighbour, static_cast<std::size_t>(fine.start[n]));
  float* point = fine.point ? grow(coarse.point, 3 * static_cast<std::size_t>(count)) : nullptr;
  std::int32_t edges = 0;
  for (std::int32_t c = 0; c < count; ++c) {
    start[c] = edges;
    mark[c] = c;
    std::int32_t total = 0;
    for (std::int32_t k = member_start[c]; k < member_start[c + 1]; ++k) {
      const std::int32_t v = member[k];
      total += fine.weight_of(v);
      for (std::int32_t e = fine.start[v]; e < fine.start[v + 1]; ++e) {
        const std::int32_t other = cluster[fine.neighbour[e]];
        if (mark[other] == c) continue;
        mark[other] = c;
        neighbour[edges++] = other;
      }
    }
    weight[c] = total;
    if (!point) continue;
    float sum[3] = {0, 0, 0};
    for (std::int32_t k = member_start[c]; k < member_start[c + 1]; ++k) {
      const float* p = fine.point + 3 * static_cast<std::size_t>(member[k]);
      sum[0] += p[0];
      sum[1] += p[1];
      sum[2] += p[2];
    }
    const float members = static_cast<float>(member_start[c + 1] - member_start[c]);
    for (int x = 0; x < 3; ++x) point[3 * static_cast<std::size_t>(c) + x] = sum[x] / members;
  }
  start[count] = edges;
  coarse.view = {count, start, neighbour, point, weight};
}

// Adds its neighbours to the separator, several times, as long as both sides keep a fifth of the graph (smallest_side).
void MultilevelBisection::widen(const GraphView& graph, std::uint8_t* side, int rings) {
  std::int32_t left[2] = {0, 0};
  queue_.clear();
  for (std::int32_t v = 0; v < graph.size; ++v) {
    if (side[v] == side_between)
      queue_.push_back(v);
    else
      ++left[side[v]];
  }
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = queue_.size();
    std::int32_t lost[2] = {0, 0};
    for (std::size_t k = begin; k < end; ++k) {
      for (std::int32_t e = graph.start[queue_[k]]; e < graph.start[queue_[k] + 1]; ++e) {
        const std::int32_t u = graph.neighbour[e];
        if (side[u] >= side_between) continue;
        ++lost[side[u]];
        queue_.push_back(u);
        side[u] = static_cast<std::uint8_t>(side_between + 1 + side[u]);  // marked until this widening is accepted
      }
    }
    const bool keep = smallest_side * static_cast<std::int64_t>(left[0] - lost[0]) >= graph.size &&
                      smallest_side * static_cast<std::int64_t>(left[1] - lost[1]) >= graph.size;
    for (std::size_t k = end; k < queue_.size(); ++k) {
      const std::int32_t u = queue_[k];
      side[u] = keep ? static_cast<std::uint8_t>(side_between) : static_cast<std::uint8_t>(side[u] - side_between - 1);
    }
    if (!keep) return;
    left[0] -= lost[0];
    left[1] -= lost[1];
    begin = end;
  }
}

Cut MultilevelBisection::carry_back(const GraphView& fine, const Level& coarse, std::uint8_t* side) {
  for (std::int32_t v = 0; v < fine.size; ++v) side[v] = coarse.side[static_cast<std::size_t>(coarse.cluster[v])];
  widen(fine, side, widening);
  Cut cut = search_.refine(fine, side);
  for (int pass = 0; pass < repeats && cut.usable() && fine.size >= thorough_size; ++pass) {
    widen(fine, side, widening);
    cut = search_.refine(fine, side);
  }
  return cut;
}

Cut MultilevelBisection::run(const GraphView& graph, std::uint8_t* side) {
  const bool thorough = graph.size >= thorough_size;
  if (graph.size <= direct_size) return search_.bisect(graph, side, false);
  std::size_t depth = 0;
  const GraphView* fine = &graph;
  while (fine->size > direct_size) {
    while (levels_.size() <= depth) levels_.emplace_back(memory_);
    poll();
    // Growing levels_ may have moved its entries.
    fine = depth == 0 ? &graph : &levels_[depth - 1].view;
    coarsen(*fine, levels_[depth]);
    // Coarsening hardly shrinks this graph, so it is bisected as it is.
    if (levels_[depth].view.size > least_shrinking * fine->size) break;
    fine = &levels_[depth++].view;
  }
  if (depth == 0) return search_.bisect(graph, side, thorough);
  Level& coarsest = levels_[depth - 1];
  coarsest.side.resize(static_cast<std::size_t>(coarsest.view.size));
  Cut cut = search_.bisect(coarsest.view, coarsest.side.data(), thorough);
  for (std::size_t k = depth; cut.usable() && k-- > 0;) {
    poll();
    const GraphView& finer = k == 0 ? graph : levels_[k - 1].view;
    if (k > 0) levels_[k - 1].side.resize(static_cast<std::size_t>(finer.size));
    cut = carry_back(finer, levels_[k], k == 0 ? side : levels_[k - 1].side.data());
  }
  // If carrying the cut back to finer graphs has emptied a side, the original graph is cut directly.
  return cut.usable() ? cut : search_.bisect(graph, side, true);
}

}  // namespace hf_inner::factor
