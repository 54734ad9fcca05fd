#include "deform/subspace.h"

#include <algorithm>
#include <cmath>

namespace hf {
namespace {

constexpr double rigidity = 1e-3;         // eps, relative to the mean diagonal of the cluster's linear part
constexpr double edge_samples = 60000;    // about this many edges are used
constexpr std::int32_t few_edges = 1500;  // clusters with fewer are never sampled
constexpr double border_stiffness = 0.25;  // what edges at a handle's border gain

// z_c(e) of one edge, clusters ascending.
struct EdgeRow {
  explicit EdgeRow(Memory& memory) : cluster(&memory), z(&memory) {}
  void resize(std::size_t size) { cluster.resize(size), z.resize(size); }
  std::int32_t count = 0;
  Vector<std::int32_t> cluster;
  struct Z {
    double x[4];
  };
  Vector<Z> z;
};

class Assembly {
 public:
  Assembly(const Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups, Subspace& out,
           Memory& memory)
      : core_(core),
        rest_(rest),
        weights_(weights),
        groups_(groups),
        out_(out),
        memory_(memory),
        elastic_(&memory),
        slot_of_group_(&memory),
        edge_count_(&memory),
        needs_all_(&memory),
        entry_of_(&memory),
        row_(memory) {}

  void run() {
    find_elastic_components();
    count_edges();
    number_entries();
    const std::size_t size = 4 * static_cast<std::size_t>(weights_.free_count());
    lower_.allocate(memory_, size * size);
    std::fill(lower_.begin(), lower_.end(), 0.0);
    out_.coupling.allocate(memory_, size * 4 * static_cast<std::size_t>(weights_.handle_count));
    std::fill(out_.coupling.begin(), out_.coupling.end(), 0.0);
    list_uses();
    for (std::int32_t e = 0; e < core_.topology.edge_count(); ++e) add_edge(e);
    add_areas();
    add_rigidity();
    collect_means();
    out_.factor.factorise(std::move(lower_), static_cast<std::int32_t>(size), memory_);
  }

 private:
  void find_elastic_components() {
    elastic_.assign(core_.mesh.component_count(), 0);
    for (const std::int32_t c : weights_.elastic_components) elastic_[c] = 1;
    slot_of_group_.assign(groups_.count(), -1);
    for (std::int32_t g = 0; g < groups_.count(); ++g) {
      if (!elastic_[groups_.component[g]]) continue;
      slot_of_group_[g] = static_cast<std::int32_t>(out_.group.size());
      out_.group.push_back(g);
    }
  }

  bool is_elastic(std::int32_t vertex) const noexcept { return elastic_[core_.mesh.component[vertex]] != 0; }

  void count_edges() {
    edge_count_.assign(weights_.cluster_count, 0);
    std::int32_t widest = 0;
    for (std::int32_t v = 0; v < core_.size(); ++v)
      widest = std::max(widest, weights_.start[v + 1] - weights_.start[v]);
    row_.resize(2 * static_cast<std::size_t>(widest));
    elastic_edges_ = 0;
    // by vertex: each is an end of as many edges as it has neighbours
    const Topology& topology = core_.topology;
    double ends = 0;
    for (std::int32_t v = 0; v < core_.size(); ++v) {
      if (!is_elastic(v)) continue;
      const std::int32_t degree = topology.neighbour_start[v + 1] - topology.neighbour_start[v];
      ends += degree;
      for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k)
        edge_count_[weights_.cluster[k]] += degree;
    }
    elastic_edges_ = 0.5 * ends;
    needs_all_.assign(core_.size(), 0);
    for (std::int32_t v = 0; v < core_.size(); ++v) {
      for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k) {
        if (weights_.cluster[k] >= weights_.handle_count && edge_count_[weights_.cluster[k]] < few_edges)
          needs_all_[v] = 1;
      }
    }
  }

  // Weight of edge e in the sample, 0 when left out.
  double sample_weight(std::int32_t e) const noexcept {
    const std::int32_t i = core_.topology.first(e), j = core_.topology.second(e);
    if (!is_elastic(i)) return 0;
    const double probability = edge_samples / elastic_edges_;
    if (probability >= 1) return 1;
    if (needs_all_[i] || needs_all_[j]) return 1;
    return scattered(static_cast<std::uint32_t>(e)) < probability ? 1 / probability : 0;
  }

  // Entries (group, cluster) that occur: a table of marks, then numbers group by group.
  void number_entries() {
    const std::size_t clusters = static_cast<std::size_t>(weights_.cluster_count);
    entry_of_.assign(out_.group.size() * clusters, -1);
    const auto mark = [&](std::int32_t group, std::int32_t v) {
      std::int32_t* row = entry_of_.data() + static_cast<std::size_t>(slot_of_group_[group]) * clusters;
      for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k) row[weights_.cluster[k]] = 0;
    };
    const Topology& topology = core_.topology;
    for (std::int32_t e = 0; e < topology.edge_count(); ++e) {
      const std::int32_t i = topology.first(e), j = topology.second(e);
      if (!is_elastic(i)) continue;
      const std::int32_t gi = groups_.group_of[i], gj = groups_.group_of[j];
      if (gj != gi) mark(gi, j), mark(gj, i);
    }
    for (std::int32_t v = 0; v < core_.size(); ++v) {
      if (is_elastic(v)) mark(groups_.group_of[v], v);
    }
    out_.entry_start.push_back(0);
    for (std::size_t g = 0; g < out_.group.size(); ++g) {
      for (std::size_t c = 0; c < clusters; ++c) {
        std::int32_t& number = entry_of_[g * clusters + c];
        if (number < 0) continue;
        number = static_cast<std::int32_t>(out_.entry.size());
        out_.entry.push_back({static_cast<std::int32_t>(c), 0.0, {}});
      }
      out_.entry_start.push_back(static_cast<std::int32_t>(out_.entry.size()));
    }
  }

  void list_uses() {
    out_.use_start.assign(weights_.free_count() + 1, 0);
    const auto for_entries = [&](auto&& use) {
      for (std::size_t g = 0; g < out_.group.size(); ++g) {
        for (std::int32_t k = out_.entry_start[g]; k < out_.entry_start[g + 1]; ++k) {
          const std::int32_t f = out_.entry[k].cluster - weights_.handle_count;
          if (f >= 0) use(f, Subspace::Use{k, static_cast<std::int32_t>(g)});
        }
      }
    };
    for_entries([&](std::int32_t f, Subspace::Use) { ++out_.use_start[f + 1]; });
    for (std::int32_t f = 0; f < weights_.free_count(); ++f) out_.use_start[f + 1] += out_.use_start[f];
    out_.use.resize(out_.use_start.back());
    Vector<std::int32_t> next(out_.use_start, &memory_);
    for_entries([&](std::int32_t f, Subspace::Use use) { out_.use[next[f]++] = use; });
  }

  Subspace::Entry& entry(std::int32_t group, std::int32_t cluster) noexcept {
    return out_.entry[entry_of_[static_cast<std::size_t>(slot_of_group_[group]) *
                                    static_cast<std::size_t>(weights_.cluster_count) +
                                static_cast<std::size_t>(cluster)]];
  }

  void fill_row(std::int32_t i, std::int32_t j, EdgeRow& row) const noexcept {
    const Vec3 p = core_.mesh.positions[i], q = core_.mesh.positions[j];
    const double pi[4] = {p.x, p.y, p.z, 1}, pj[4] = {q.x, q.y, q.z, 1};
    std::int32_t a = weights_.start[i], b = weights_.start[j];
    const std::int32_t a_end = weights_.start[i + 1], b_end = weights_.start[j + 1];
    row.count = 0;
    while (a < a_end || b < b_end) {
      const std::int32_t ca = a < a_end ? weights_.cluster[a] : 0x7fffffff,
                         cb = b < b_end ? weights_.cluster[b] : 0x7fffffff;
      const double wa = ca <= cb ? weights_.weight[a] : 0.0, wb = cb <= ca ? weights_.weight[b] : 0.0;
      row.cluster[row.count] = std::min(ca, cb);
      for (int k = 0; k < 4; ++k) row.z[row.count].x[k] = wa * pi[k] - wb * pj[k];
      ++row.count;
      a += ca <= cb, b += cb <= ca;
    }
  }

  // The largest weight of a handle at a vertex: 1 on it, 0 beyond its last band.
  double handle_share(std::int32_t v) const noexcept {
    double largest = 0;
    for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k) {
      if (weights_.cluster[k] < weights_.handle_count) largest = std::max<double>(largest, weights_.weight[k]);
    }
    return largest;
  }

  void add_edge(std::int32_t e) {
    const double sampled = sample_weight(e);
    if (sampled == 0) return;
    const std::int32_t i = core_.topology.first(e), j = core_.topology.second(e);
    fill_row(i, j, row_);
    const double close = std::max(handle_share(i), handle_share(j)), square = close * close;
    const double w = sampled * rest_.stiffness[e] * (1 + border_stiffness * square * square);
    const Vec3 d = core_.mesh.positions[i] - core_.mesh.positions[j];
    const double dp[3] = {d.x, d.y, d.z};
    for (std::int32_t r = 0; r < row_.count; ++r) {
      if (row_.cluster[r] >= weights_.handle_count) add_blocks(r, w);
      for (const std::int32_t v : {i, j}) {
        auto& q = entry(groups_.group_of[v], row_.cluster[r]).q;
        for (int a = 0; a < 4; ++a) {
          const double s = 0.5 * w * row_.z[r].x[a];
          for (int b = 0; b < 3; ++b) q[a][b] += s * dp[b];
        }
      }
    }
  }

  // L of the edge's r-th cluster, a free one, with those before it and itself.
  void add_blocks(std::int32_t r, double w) noexcept {
    const std::size_t handles = static_cast<std::size_t>(weights_.handle_count),
                      size = 4 * static_cast<std::size_t>(weights_.free_count());
    const std::size_t row_first = 4 * (static_cast<std::size_t>(row_.cluster[r]) - handles);
    double wz[4];
    for (int a = 0; a < 4; ++a) wz[a] = w * row_.z[r].x[a];
    for (std::int32_t s = 0; s <= r; ++s) {
      const std::size_t c = static_cast<std::size_t>(row_.cluster[s]);
      const std::size_t stride = c < handles ? 4 * handles : size;
      double* block =
          (c < handles ? out_.coupling.data() + 4 * c : lower_.data() + 4 * (c - handles)) + row_first * stride;
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < 4; ++b) block[a * stride + b] += wz[a] * row_.z[s].x[b];
      }
    }
  }

  void add_areas() {
    for (std::int32_t v = 0; v < core_.size(); ++v) {
      if (!is_elastic(v)) continue;
      for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k)
        entry(groups_.group_of[v], weights_.cluster[k]).area += rest_.area[v] * weights_.weight[k];
    }
  }

  void add_rigidity() {
    const std::size_t size = 4 * static_cast<std::size_t>(weights_.free_count());
    out_.stiffness.assign(weights_.free_count(), 0.0);
    for (std::size_t f = 0; f < out_.stiffness.size(); ++f) {
      double trace = 0;
      for (std::size_t a = 0; a < 3; ++a) trace += lower_[(4 * f + a) * size + 4 * f + a];
      out_.stiffness[f] = rigidity * trace / 3;
      for (std::size_t a = 0; a < 3; ++a) lower_[(4 * f + a) * size + 4 * f + a] += out_.stiffness[f];
    }
  }

  void collect_means() {
    const std::size_t free_count = static_cast<std::size_t>(weights_.free_count());
    out_.mean_start.assign(free_count + 1, 0);
    const auto for_shares = [&](auto&& use) {
      for (std::size_t g = 0; g < out_.group.size(); ++g) {
        for (std::int32_t k = out_.entry_start[g]; k < out_.entry_start[g + 1]; ++k) {
          const Subspace::Entry& entry = out_.entry[k];
          if (entry.cluster >= weights_.handle_count && entry.area > 0)
            use(static_cast<std::int32_t>(g), entry.cluster - weights_.handle_count, entry.area);
        }
      }
    };
    for_shares([&](std::int32_t, std::int32_t f, double) { ++out_.mean_start[f + 1]; });
    for (std::size_t f = 0; f < free_count; ++f) out_.mean_start[f + 1] += out_.mean_start[f];
    out_.mean.resize(out_.mean_start[free_count]);
    Vector<std::int32_t> next(out_.mean_start, &memory_);
    for_shares([&](std::int32_t g, std::int32_t f, double area) { out_.mean[next[f]++] = {g, area}; });
  }

  const Core& core_;
  const Rest& rest_;
  const ClusterWeights& weights_;
  const Groups& groups_;
  Subspace& out_;
  Memory& memory_;
  Vector<std::uint8_t> elastic_;        // per component
  Vector<std::int32_t> slot_of_group_;  // position in out_.group, or -1
  Vector<std::int32_t> edge_count_;     // per cluster, ends counted
  Vector<std::uint8_t> needs_all_;      // per vertex: in a cluster with few edges
  Vector<std::int32_t> entry_of_;       // per active group and cluster
  double elastic_edges_ = 0;
  Buffer<double> lower_;
  EdgeRow row_;
};

}  // namespace

Subspace make_subspace(const Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups,
                       Memory& memory) {
  Subspace subspace(memory);
  Assembly(core, rest, weights, groups, subspace, memory).run();
  return subspace;
}

}  // namespace hf
