#include "field/flow_bound.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::field {
namespace {

// Classes of weights, each four times the next, that the tree takes one after the other: weak edges come last, and
// among equals the paths stay short. Weights of the last class may be any smaller. A smaller step would make more
// passes for the same tree; 64 classes span 38 digits.
constexpr int classes = 64;
constexpr Index root = -1, not_reached = -2;

struct Edge {
  Index from, to;
  double weight;
};

}  // namespace

FlowBound::FlowBound(const surface::Core& core, const SymmetricMatrix& k, Span<const Index> roots)
    : core_(core),
      order_(core.memory.get()),
      parent_(at(core.size()), not_reached, core.memory.get()),
      resistance_(at(core.size()), 0.0, core.memory.get()),
      path_(at(core.mesh.component_count()), 0.0, core.memory.get()) {
  Memory& memory = *core.memory;
  Vector<double> distance(at(core.size()), 0.0, &memory);
  int highest = 0;
  std::frexp(*std::max_element(k.value.begin(), k.value.end()), &highest);
  Vector<Vector<Edge>> waiting(classes, &memory);
  Vector<std::size_t> next(classes, 0, &memory);
  int first = classes;  // no edge waits in a class before
  order_.reserve(at(core.size()));
  const auto take = [&](Index v) {
    order_.push_back(v);
    for (std::size_t i = at(k.column_start[at(v)]); i < at(k.column_start[at(v) + 1]); ++i) {
      const double weight = -k.value[i];
      if (!(weight > 0) || parent_[at(k.row[i])] != not_reached) continue;
      int exponent = 0;
      std::frexp(weight, &exponent);
      const int kind = std::max(0, std::min(classes - 1, (highest - exponent) / 2));
      waiting[at(kind)].push_back({v, k.row[i], weight});
      first = std::min(first, kind);
    }
  };
  Vector<Index> starts(&memory);
  for (const Index v : roots) {
    if (parent_[at(v)] == not_reached) {
      parent_[at(v)] = root;
      starts.push_back(v);
    }
  }
  for (const Index v : starts) take(v);
  while (first < classes) {
    Vector<Edge>& edges = waiting[at(first)];
    std::size_t& done = next[at(first)];
    if (done == edges.size()) {
      edges.clear();
      done = 0;
      ++first;
      continue;
    }
    const Edge edge = edges[done++];
    if (parent_[at(edge.to)] != not_reached) continue;
    parent_[at(edge.to)] = edge.from;
    resistance_[at(edge.to)] = 1 / edge.weight;
    double& far = distance[at(edge.to)];
    far = distance[at(edge.from)] + 1 / edge.weight;
    double& longest = path_[at(core.mesh.component[at(edge.to)])];
    longest = std::max(longest, far);
    take(edge.to);
  }
}

Vector<double> FlowBound::bound(double* r, std::size_t channels) const {
  Vector<double> out(path_.size() * channels, 0.0, core_.memory.get());
  for (std::size_t i = order_.size(); i-- > 0;) {
    const std::size_t v = at(order_[i]), c = at(core_.mesh.component[v]);
    if (parent_[v] == root) continue;
    double* above = r + at(parent_[v]) * channels;
    for (std::size_t q = 0; q < channels; ++q) {
      const double flow = r[v * channels + q];
      above[q] += flow;
      out[c * channels + q] += flow * flow * resistance_[v];
    }
  }
  for (std::size_t v = 0; v < parent_.size(); ++v) {
    for (std::size_t q = 0; parent_[v] == not_reached && q < channels; ++q)
      if (r[v * channels + q] != 0) out[at(core_.mesh.component[v]) * channels + q] = HUGE_VAL;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double energy = out[i];
    out[i] = std::isfinite(energy) ? std::sqrt(energy) * std::sqrt(path_[i / channels]) : HUGE_VAL;
  }
  return out;
}

}  // namespace hf_inner::field
