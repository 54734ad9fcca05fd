#include "factor/separator.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/principal_axes.h"
#include "base/progress.h"

namespace hf_inner::factor {
namespace {

constexpr std::uint8_t touches_left = 1, touches_right = 2, on_path = 4;
constexpr std::int32_t none = -1, source = -2, sink = -3;
// Largest half width of the band in which a separator is searched, as a share of the vertices. At half the value: the
// factorisation's flops grow by up to 6 %. At twice the value: by up to 40 %, because the band takes in a whole side.
constexpr double widest_band = 0.3;
// Width of the band in which a separator is searched, in square roots of the number of vertices, for large and small
// graphs. Half the second number changes the factorisation's flops by -7 to +6 %, twice it by at most 2 %. Halving or
// doubling the first number changes no order.
constexpr double band_of_large = 16, band_of_small = 6;
// Up to this many vertices a graph is small (band_of_small). Larger graphs are coarsened first where possible. Half the
// value changes the factorisation's flops by at most 3 %, twice the value changes no order.
constexpr std::int32_t small_graph = 500;
// If a part's second squared extent is below this share of the first, no cut across its second axis is tried, which
// saves time. Halving or doubling it does not change the factor's size.
constexpr double long_shape = 0.04;
// If a separator's squared size is more than this many times the size of the graph, a cut by distances in the graph is
// tried too. Halving or doubling it changes the factor's size by at most 0.1 %.
constexpr double poor_separator = 2.5;
// Half width of the band in which a separator is searched a second time, when a cut by breadth-first order has an empty
// side. Halving or doubling it gives the same order on the test meshes torus, creature and scan.
constexpr double narrow_band = 0.05;

// The principal axes of the places of a graph, with signs that depend on the places alone.
PrincipalAxes axes_of(const GraphView& graph) noexcept {
  const auto place = [&](std::int32_t v) {
    return hf_eigen::Map<const hf_eigen::Vector3f>(graph.point + 3 * static_cast<std::size_t>(v)).cast<double>();
  };
  hf_eigen::Vector3d mean;
  for (std::int32_t v = 0; v < graph.size; ++v) mean += place(v);
  mean /= graph.size;
  Mat3 moments;
  for (std::int32_t v = 0; v < graph.size; ++v) {
    const hf_eigen::Vector3d d = place(v) - mean;
    moments += d * d.transpose();
  }
  PrincipalAxes out = principal_axes(moments);
  fix_signs(out.axes);
  return out;
}

// Returns the bits of a float in a form whose unsigned order is the order of the floats.
std::uint32_t ordered_bits(float x) noexcept {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

}  // namespace

double Cut::score() const noexcept {
  const double total = static_cast<double>(left + right);
  const double imbalance = total > 0 ? static_cast<double>(left - right) / total : 1.0;
  return (static_cast<double>(separator) + 0.5) * (1 + imbalance * imbalance);
}

// Collects the band between the two sides as a graph of its own, with flags for vertices next to a side.
void SeparatorSearch::collect_band(const GraphView& graph, const std::uint8_t* side) {
  band_.clear();
  if (slot_.size() < static_cast<std::size_t>(graph.size)) slot_.resize(static_cast<std::size_t>(graph.size));
  for (std::int32_t v = 0; v < graph.size; ++v) {
    if (side[v] == side_between) {
      slot_[v] = static_cast<std::int32_t>(band_.size());
      band_.push_back(v);
    }
  }
  const std::size_t count = band_.size();
  flags_.assign(count, 0);
  band_start_.resize(count + 1);
  std::size_t edges = 0;
  for (const std::int32_t v : band_) edges += static_cast<std::size_t>(graph.start[v + 1] - graph.start[v]);
  band_neighbour_.resize(edges);
  std::int32_t k = 0;
  for (std::size_t b = 0; b < count; ++b) {
    band_start_[b] = k;
    const std::int32_t v = band_[b];
    for (std::int32_t e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      const std::int32_t u = graph.neighbour[e];
      if (side[u] == side_between)
        band_neighbour_[k++] = slot_[u];
      else
        flags_[b] |= side[u] == side_left ? touches_left : touches_right;
    }
  }
  band_start_[count] = k;
  previous_.assign(count, none);
  next_.assign(count, none);
}

// Finds the breadth-first levels of the flow problem's residual graph from the source. State 2 b is the entry of vertex
// b, state 2 b + 1 its exit. A vertex on no path is entered and left at once, so it only has the exit. Returns true
// when the sink is reached.
bool SeparatorSearch::label_phase() {
  const std::size_t count = band_.size();
  level_.assign(2 * count, none);
  if (queue_.size() < 2 * count + 1) queue_.resize(2 * count + 1);
  std::int32_t* queue = queue_.data();
  std::int32_t* level_of = level_.data();
  const std::uint8_t* flags = flags_.data();
  std::size_t tail = 0;
  const auto entry_of = [&](std::int32_t b) { return 2 * b + ((flags[b] & on_path) ? 0 : 1); };
  for (std::size_t b = 0; b < count; ++b) {
    if (!(flags[b] & touches_left)) continue;
    const std::int32_t state = entry_of(static_cast<std::int32_t>(b));
    level_of[state] = 0;
    queue[tail++] = state;
  }
  std::int32_t last = INT32_MAX;
  for (std::size_t head = 0; head < tail; ++head) {
    const std::int32_t state = queue[head], b = state >> 1, level = level_of[state] + 1;
    if (level > last) break;
    if ((state & 1) == 0) {
      const std::int32_t to = 2 * previous_[b] + 1;
      if (previous_[b] >= 0 && level_of[to] == none) {
        level_of[to] = level;
        queue[tail++] = to;
      }
      continue;
    }
    if (flags[b] & touches_right) last = level;
    for (std::int32_t e = band_start_[b]; e < band_start_[b + 1]; ++e) {
      const std::int32_t to = entry_of(band_neighbour_[e]);
      if (level_of[to] == none) {
        level_of[to] = level;
        queue[tail++] = to;
      }
    }
    if ((flags[b] & on_path) && level_of[state - 1] == none) {
      level_of[state - 1] = level;
      queue[tail++] = state - 1;
    }
  }
  return last != INT32_MAX;
}

// Finds disjoint shortest paths by depth-first search on the levels. A state (entry or exit of a vertex) that is used
// or leads nowhere is removed.
std::int32_t SeparatorSearch::augment_phase() {
  const std::size_t count = band_.size();
  iterator_.assign(band_start_.begin(), band_start_.end() - 1);
  std::int32_t* level_of = level_.data();
  const auto entry_of = [&](std::int32_t b) { return 2 * b + ((flags_[b] & on_path) ? 0 : 1); };
  std::int32_t paths = 0;
  for (std::size_t start = 0; start < count; ++start) {
    const std::int32_t root = entry_of(static_cast<std::int32_t>(start));
    if (!(flags_[start] & touches_left) || level_of[root] != 0) continue;
    stack_.clear();
    stack_.push_back(root);
    while (!stack_.empty()) {
      const std::int32_t state = stack_.back(), b = state >> 1, level = level_of[state] + 1;
      std::int32_t step = none;
      if ((state & 1) == 0) {
        if (previous_[b] >= 0 && level_of[2 * previous_[b] + 1] == level) step = 2 * previous_[b] + 1;
      } else {
        if (flags_[b] & touches_right) {
          for (const std::int32_t used : stack_) level_of[used] = none;
          apply_path();
          ++paths;
          break;
        }
        std::int32_t& e = iterator_[b];
        for (; e < band_start_[b + 1]; ++e) {
          const std::int32_t to = entry_of(band_neighbour_[e]);
          if (level_of[to] != level) continue;
          step = to;
          break;
        }
        if (step == none && (flags_[b] & on_path) && level_of[state - 1] == level) step = state - 1;
      }
      if (step != none) {
        stack_.push_back(step);
      } else {
        level_of[state] = none;
        stack_.pop_back();
      }
    }
  }
  return paths;
}

// Adds the path on the stack to the flow.
void SeparatorSearch::apply_path() {
  std::int32_t from = source;  // the vertex whose exit comes before this state
  for (std::size_t k = 0; k < stack_.size(); ++k) {
    const std::int32_t state = stack_[k], b = state >> 1;
    if ((state & 1) == 0) {
      if (from == b) {
        // The path goes back into b from b's own exit, so b leaves its old path.
        flags_[b] &= static_cast<std::uint8_t>(~on_path);
        previous_[b] = next_[b] = none;
      } else {
        previous_[b] = from;
      }
      continue;
    }
    if (!(flags_[b] & on_path)) {
      flags_[b] |= on_path;
      previous_[b] = from;
    }
    if (k + 1 == stack_.size())
      next_[b] = sink;
    else if (stack_[k + 1] >> 1 != b)
      next_[b] = stack_[k + 1] >> 1;
    from = b;
  }
}

// Marks the states (entries and exits of vertices) from which the sink can be reached in the residual graph. A vertex
// on no path only has the exit.
void SeparatorSearch::mark_reaching_sink() {
  const std::size_t count = band_.size();
  reach_.assign(2 * count, 0);
  queue_.clear();
  const auto visit = [&](std::int32_t state) {
    if (reach_[state]) return;
    reach_[state] = 1;
    queue_.push_back(state);
  };
  for (std::size_t b = 0; b < count; ++b) {
    if (flags_[b] & touches_right) visit(static_cast<std::int32_t>(2 * b + 1));
  }
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::int32_t state = queue_[head], b = state >> 1;
    if ((state & 1) && (flags_[b] & on_path)) {
      if (next_[b] >= 0) visit(2 * next_[b]);
      continue;
    }
    // The states that lead into the entry of vertex b are the exits of its neighbours, and b's own exit when b is on a
    // path.
    for (std::int32_t e = band_start_[b]; e < band_start_[b + 1]; ++e) visit(2 * band_neighbour_[e] + 1);
    if (flags_[b] & on_path)
      visit(state + 1);
    else
      reach_[2 * b] = 1;
  }
}

// Chooses between the two extreme minimum cuts, those nearest to the source and to the sink. level_ marks the nodes
// that the source reaches, reach_ those that reach the sink.
Cut SeparatorSearch::choose_cut(const GraphView& graph, std::uint8_t* side) {
  mark_reaching_sink();
  Cut near_source, near_sink;
  std::int64_t left = 0, right = 0;
  for (std::int32_t v = 0; v < graph.size; ++v) {
    if (side[v] == side_left)
      left += graph.weight_of(v);
    else if (side[v] == side_right)
      right += graph.weight_of(v);
  }
  near_source.left = near_sink.left = left;
  near_source.right = near_sink.right = right;
  for (std::size_t b = 0; b < band_.size(); ++b) {
    const std::int32_t weight = graph.weight_of(band_[b]);
    const bool entered = level_[2 * b] != none, left_by = level_[2 * b + 1] != none;
    if (left_by)
      near_source.left += weight;
    else if (entered)
      ++near_source.separator;
    else
      near_source.right += weight;
    const bool exits = reach_[2 * b + 1] != 0, enters = reach_[2 * b] != 0;
    if (enters)
      near_sink.right += weight;
    else if (exits)
      ++near_sink.separator;
    else
      near_sink.left += weight;
  }
  const bool take_source = near_source.usable() && (!near_sink.usable() || near_source.score() <= near_sink.score());
  for (std::size_t b = 0; b < band_.size(); ++b) {
    std::uint8_t& target = side[band_[b]];
    if (take_source) {
      target = level_[2 * b + 1] != none ? side_left : level_[2 * b] != none ? side_between : side_right;
    } else {
      target = reach_[2 * b] ? side_right : reach_[2 * b + 1] ? side_between : side_left;
    }
  }
  return take_source ? near_source : near_sink;
}

Cut SeparatorSearch::refine(const GraphView& graph, std::uint8_t* side) {
  collect_band(graph, side);
  for (std::size_t b = 0; b < band_.size(); ++b) {
    if ((flags_[b] & (touches_left | touches_right)) == (touches_left | touches_right)) {
      flags_[b] |= on_path;
      previous_[b] = source;
      next_[b] = sink;
    }
  }
  while (label_phase() && augment_phase() > 0) poll();
  return choose_cut(graph, side);
}

// Sorts the vertices by key_ (a position or a breadth-first number). Those nearest to the median, up to the share
// `share` of all vertices on either side, form the band in which a minimum cut is then tried.
bool SeparatorSearch::try_keys(const GraphView& graph, std::uint8_t* side, Cut& best, double share) {
  poll();
  const std::int32_t n = graph.size;
  ranked_.resize(static_cast<std::size_t>(n));
  for (std::int32_t v = 0; v < n; ++v)
    ranked_[v] = static_cast<std::uint64_t>(ordered_bits(key_[v])) << 32 | static_cast<std::uint32_t>(v);
  trial_.assign(static_cast<std::size_t>(n), side_between);
  std::int32_t lefts = 0;
  if (graph.weight) {
    std::sort(ranked_.begin(), ranked_.end());
    std::int64_t total = 0, before = 0;
    for (std::int32_t v = 0; v < n; ++v) total += graph.weight[v];
    for (const std::uint64_t entry : ranked_) {
      const std::int32_t v = static_cast<std::int32_t>(entry & 0xffffffffu);
      const double middle = (static_cast<double>(before) + 0.5 * graph.weight[v]) / static_cast<double>(total);
      before += graph.weight[v];
      if (middle < 0.5 - share)
        trial_[v] = side_left;
      else if (middle > 0.5 + share)
        trial_[v] = side_right;
    }
  } else {
    const std::ptrdiff_t low = static_cast<std::ptrdiff_t>((0.5 - share) * n),
                         high = static_cast<std::ptrdiff_t>((0.5 + share) * n);
    std::nth_element(ranked_.begin(), ranked_.begin() + low, ranked_.end());
    std::nth_element(ranked_.begin() + low, ranked_.begin() + std::min<std::ptrdiff_t>(high, n - 1), ranked_.end());
    for (std::ptrdiff_t k = 0; k < low; ++k) trial_[ranked_[k] & 0xffffffffu] = side_left;
    for (std::ptrdiff_t k = high; k < n; ++k) trial_[ranked_[k] & 0xffffffffu] = side_right;
  }
  // If an edge jumps over the band, its left end moves into the band.
  for (std::int32_t v = 0; v < n; ++v) {
    if (trial_[v] != side_left) continue;
    for (std::int32_t e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      if (trial_[graph.neighbour[e]] != side_right) continue;
      trial_[v] = side_between;
      break;
    }
    lefts += trial_[v] == side_left;
  }
  if (lefts == 0) return false;
  const Cut cut = refine(graph, trial_.data());
  if (!cut.usable() || (best.usable() && best.score() <= cut.score())) return cut.usable();
  best = cut;
  std::copy(trial_.begin(), trial_.end(), side);
  return true;
}

// Numbers the vertices in breadth-first order, component after component. Each search starts at a vertex far from the
// component's first one.
void SeparatorSearch::breadth_first_keys(const GraphView& graph) {
  const std::int32_t n = graph.size;
  key_.assign(static_cast<std::size_t>(n), -1.0f);
  reach_.assign(static_cast<std::size_t>(n), 0);
  std::int32_t visited = 0;
  for (std::int32_t first = 0; first < n; ++first) {
    if (key_[first] >= 0) continue;
    std::int32_t root = first;
    for (const std::uint8_t mark : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
      queue_.clear();
      queue_.push_back(root);
      reach_[root] = mark;
      for (std::size_t head = 0; head < queue_.size(); ++head) {
        const std::int32_t v = queue_[head];
        if (mark == 3) key_[v] = static_cast<float>(visited++);
        for (std::int32_t e = graph.start[v]; e < graph.start[v + 1]; ++e) {
          const std::int32_t u = graph.neighbour[e];
          if (reach_[u] != mark) {
            reach_[u] = mark;
            queue_.push_back(u);
          }
        }
      }
      root = queue_.back();
    }
  }
}

void SeparatorSearch::projection_keys(const GraphView& graph, const double* axis) {
  key_.resize(static_cast<std::size_t>(graph.size));
  for (std::int32_t v = 0; v < graph.size; ++v) {
    const float* p = graph.point + 3 * static_cast<std::size_t>(v);
    key_[v] = static_cast<float>(axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2]);
  }
}

Cut SeparatorSearch::bisect(const GraphView& graph, std::uint8_t* side, bool thorough) {
  const std::int32_t n = graph.size;
  Cut best;
  if (n < 2) return best;
  const double share = std::min(
      widest_band, 0.5 * (n > small_graph ? band_of_large : band_of_small) / std::sqrt(static_cast<double>(n)));
  bool spread = false;
  if (graph.point) {
    const PrincipalAxes shape = axes_of(graph);
    const hf_eigen::Vector3d& extent = shape.moment;
    const auto try_axis = [&](const hf_eigen::Vector3d& axis) {
      projection_keys(graph, axis.data());
      try_keys(graph, side, best, share);
    };
    spread = extent[0] > 0;  // else all are in one place, or places are no numbers
    if (spread) {
      try_axis(shape.axes.col(0));
      // a long shape has one sensible axis
      if (extent[1] > long_shape * extent[0] || !best.usable()) try_axis(shape.axes.col(1));
      if (thorough) {
        // the diagonals of a box of these extents
        const hf_eigen::Vector3d along = std::sqrt(std::max(0.0, extent[1])) * shape.axes.col(0),
                                 across = std::sqrt(extent[0]) * shape.axes.col(1);
        try_axis((along + across).normalized());
        try_axis((along - across).normalized());
        try_axis(shape.axes.col(2));
      }
    }
  }
  // A separator far above the square root of the size means that positions mislead. For example, a tube with long
  // triangles is cut lengthwise. Then distances in the graph are tried too.
  const bool poor = static_cast<double>(best.separator) * best.separator > poor_separator * n;
  if (!spread || !best.usable() || thorough || poor) {
    breadth_first_keys(graph);
    if (!try_keys(graph, side, best, share) && !best.usable()) try_keys(graph, side, best, narrow_band);
  }
  return best;
}

}  // namespace hf_inner::factor
