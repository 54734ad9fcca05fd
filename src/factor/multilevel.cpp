#include "factor/multilevel.h"

#include <algorithm>

namespace hf {
namespace {

constexpr std::int32_t direct_size = 400;     // graphs this small are bisected as they are
constexpr std::int32_t thorough_size = 4000;  // parts this large try more directions on their coarsest graph
constexpr int widening = 2;                   // rings around a separator that is carried back
constexpr int repeats = 2;                    // further passes with the band moved along, on large parts

}  // namespace

// Stars first: a vertex whose ring is free takes it. What is left joins the cluster of its first clustered neighbour.
void MultilevelBisection::coarsen(const GraphView& fine, Level& coarse) {
  const std::int32_t n = fine.size;
  Vector<std::int32_t>& cluster = coarse.cluster;
  cluster.assign(static_cast<std::size_t>(n), -1);
  std::int32_t count = 0;
  for (std::int32_t v = 0; v < n; ++v) {
    if (cluster[v] >= 0) continue;
    bool free = true;
    for (std::int32_t e = fine.start[v]; free && e < fine.start[v + 1]; ++e) free = cluster[fine.neighbour[e]] < 0;
    if (!free) continue;
    cluster[v] = count;
    for (std::int32_t e = fine.start[v]; e < fine.start[v + 1]; ++e) cluster[fine.neighbour[e]] = count;
    ++count;
  }
  for (std::int32_t v = 0; v < n; ++v) {
    if (cluster[v] >= 0) continue;
    std::int32_t joined = -1;
    for (std::int32_t e = fine.start[v]; joined < 0 && e < fine.start[v + 1]; ++e) joined = cluster[fine.neighbour[e]];
    cluster[v] = joined >= 0 ? joined : count++;
  }
  // members by cluster
  cluster_size_.assign(static_cast<std::size_t>(count) + 1, 0);
  for (std::int32_t v = 0; v < n; ++v) ++cluster_size_[cluster[v] + 1];
  for (std::int32_t c = 0; c < count; ++c) cluster_size_[c + 1] += cluster_size_[c];
  queue_.resize(static_cast<std::size_t>(n));
  mark_.assign(cluster_size_.begin(), cluster_size_.end() - 1);
  for (std::int32_t v = 0; v < n; ++v) queue_[mark_[cluster[v]]++] = v;
  mark_.assign(static_cast<std::size_t>(count), -1);
  coarse.start.resize(static_cast<std::size_t>(count) + 1);
  coarse.weight.resize(static_cast<std::size_t>(count));
  coarse.neighbour.clear();
  coarse.neighbour.reserve(static_cast<std::size_t>(fine.start[n]) / 5 + 16);
  if (fine.point) coarse.point.resize(3 * static_cast<std::size_t>(count));
  for (std::int32_t c = 0; c < count; ++c) {
    coarse.start[c] = static_cast<std::int32_t>(coarse.neighbour.size());
    mark_[c] = c;
    std::int32_t weight = 0;
    float sum[3] = {0, 0, 0};
    for (std::int32_t k = cluster_size_[c]; k < cluster_size_[c + 1]; ++k) {
      const std::int32_t v = queue_[k];
      weight += fine.weight_of(v);
      for (int x = 0; fine.point && x < 3; ++x) sum[x] += fine.point[3 * static_cast<std::size_t>(v) + x];
      for (std::int32_t e = fine.start[v]; e < fine.start[v + 1]; ++e) {
        const std::int32_t other = cluster[fine.neighbour[e]];
        if (mark_[other] == c) continue;
        mark_[other] = c;
        coarse.neighbour.push_back(other);
      }
    }
    coarse.weight[c] = weight;
    const float members = static_cast<float>(cluster_size_[c + 1] - cluster_size_[c]);
    for (int x = 0; fine.point && x < 3; ++x) coarse.point[3 * static_cast<std::size_t>(c) + x] = sum[x] / members;
  }
  coarse.start[count] = static_cast<std::int32_t>(coarse.neighbour.size());
  coarse.view = {count, coarse.start.data(), coarse.neighbour.data(), fine.point ? coarse.point.data() : nullptr, coarse.weight.data()};
}

// Adds rings of neighbours to what lies between, as long as both sides keep a fifth of the whole.
void MultilevelBisection::widen(const GraphView& graph, std::uint8_t* side, int rings) {
  std::int32_t left[2] = {0, 0};
  queue_.clear();
  for (std::int32_t v = 0; v < graph.size; ++v) {
    if (side[v] == side_between) queue_.push_back(v);
    else ++left[side[v]];
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
        side[u] = static_cast<std::uint8_t>(side_between + 1 + side[u]);  // until the ring is accepted
      }
    }
    const bool keep = 5 * static_cast<std::int64_t>(left[0] - lost[0]) >= graph.size && 5 * static_cast<std::int64_t>(left[1] - lost[1]) >= graph.size;
    for (std::size_t k = end; k < queue_.size(); ++k) {
      const std::int32_t u = queue_[k];
      side[u] = keep ? static_cast<std::uint8_t>(side_between) : static_cast<std::uint8_t>(side[u] - side_between - 1);
    }
    if (!keep) return;
    left[0] -= lost[0], left[1] -= lost[1];
    begin = end;
  }
}

Cut MultilevelBisection::carry_back(const GraphView& fine, const Level& coarse, std::uint8_t* side) {
  for (std::int32_t v = 0; v < fine.size; ++v) side[v] = coarse.side[static_cast<std::size_t>(coarse.cluster[v])];
  widen(fine, side, widening);
  Cut cut = search_.refine(fine, side);
  for (int pass = 0; pass < repeats && cut.usable() && fine.size >= thorough_size; ++pass) {
    widen(fine, side, widening);
    const Cut again = search_.refine(fine, side);
    const bool better = again.usable() && again.score() < 0.995 * cut.score();
    cut = again;
    if (!better) break;
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
    // the list may have moved
    fine = depth == 0 ? &graph : &levels_[depth - 1].view;
    coarsen(*fine, levels_[depth]);
    if (levels_[depth].view.size > fine->size * 3 / 4) break;  // no stars to speak of: bisect what there is
    fine = &levels_[depth++].view;
  }
  if (depth == 0) return search_.bisect(graph, side, thorough);
  Level& coarsest = levels_[depth - 1];
  coarsest.side.resize(static_cast<std::size_t>(coarsest.view.size));
  Cut cut = search_.bisect(coarsest.view, coarsest.side.data(), thorough);
  for (std::size_t k = depth; cut.usable() && k-- > 0;) {
    const GraphView& finer = k == 0 ? graph : levels_[k - 1].view;
    if (k > 0) levels_[k - 1].side.resize(static_cast<std::size_t>(finer.size));
    cut = carry_back(finer, levels_[k], k == 0 ? side : levels_[k - 1].side.data());
  }
  // the way back lost a side: cut the part as it is
  return cut.usable() ? cut : search_.bisect(graph, side, true);
}

}  // namespace hf
