#include "deform/subspace.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/compiler.h"

namespace hf_inner::deform {
namespace {

// The rest positions p_v and cluster weights of the vertices. With cluster transforms A, x_v = sum_k weight[k]
// A_cluster[k] (p_v, 1).
struct BlendRows {
  const std::int32_t* start;
  const std::uint16_t* cluster;
  const float* weight;
  const Vec3* positions;
};

// Compiled to two halves without AVX.
HF_VECTOR(Four, double, 4);

// An edge i - j that the elastic energy uses, with its weight w_e.
struct Sample {
  std::int32_t i, j;
  double weight;
};

// Some edges, one after the other, with the same clusters at their ends: most neighbours have them. Their sums go to
// the same places, which are read and written once.
struct EdgeRun {
  const Sample* sample;  // the first edge
  std::int32_t edges, width;
  const std::uint16_t* cluster;  // [width] ascending
  const double* z;  // [edges][width][4] z_c(e) = W_ic (p_i, 1) - W_jc (p_j, 1). W are the weights, p the rest positions
};

// Cuts edges into runs.
class RunReader {
 public:
  // widest: the most clusters of a vertex.
  RunReader(const BlendRows& rows, std::int32_t widest, Memory& memory)
      : rows_(rows),
        merged_(memory, 2 * static_cast<std::size_t>(widest)),
        cluster_(memory, merged_.size()),
        z_(memory, 4 * (longest_run + 1) * merged_.size()) {}

  template <class Use>
  void read(const Sample* samples, std::size_t count, Use&& use) noexcept {
    EdgeRun run{samples, 0, 0, cluster_.data(), z_.data()};
    for (std::size_t e = 0; e < count; ++e) {
      const std::size_t used = 4 * static_cast<std::size_t>(run.edges) * static_cast<std::size_t>(run.width);
      double* const own = z_.data() + used;
      const Span<const std::uint16_t> clusters = fill(samples[e].i, samples[e].j, own);
      const bool joins = run.edges > 0 && run.edges < longest_run &&
                         clusters.size() == static_cast<std::size_t>(run.width) &&
                         std::equal(clusters.begin(), clusters.end(), cluster_.data());
      if (!joins) {
        if (run.edges > 0) use(run);
        run.sample = samples + e;
        run.edges = 0;
        run.width = static_cast<std::int32_t>(clusters.size());
        std::copy(clusters.begin(), clusters.end(), cluster_.data());
        std::copy_n(own, 4 * clusters.size(), z_.data());
      }
      ++run.edges;
    }
    if (run.edges > 0) use(run);
  }

 private:
  // Writes the vectors z of an edge, and returns its clusters.
  Span<const std::uint16_t> fill(std::int32_t i, std::int32_t j, double* z) noexcept {
    const Vec3 p = rows_.positions[i], q = rows_.positions[j];
    const double pi[4] = {p.x, p.y, p.z, 1}, pj[4] = {q.x, q.y, q.z, 1};
    std::int32_t a = rows_.start[i], b = rows_.start[j];
    const std::int32_t a_end = rows_.start[i + 1], b_end = rows_.start[j + 1], length = a_end - a;
    const std::uint16_t* const own = rows_.cluster + a;
    if (b_end - b == length && std::equal(own, own + length, rows_.cluster + b)) {  // most edges
      for (std::int32_t r = 0; r < length; ++r) {
        const double wa = rows_.weight[a + r], wb = rows_.weight[b + r];
        for (int k = 0; k < 4; ++k) z[4 * r + k] = wa * pi[k] - wb * pj[k];
      }
      return {own, static_cast<std::size_t>(length)};
    }
    std::size_t width = 0;
    for (; a < a_end || b < b_end; ++width) {
      const std::int32_t ca = a < a_end ? rows_.cluster[a] : 0x7fffffff, cb = b < b_end ? rows_.cluster[b] : 0x7fffffff;
      const double wa = ca <= cb ? rows_.weight[a] : 0.0, wb = cb <= ca ? rows_.weight[b] : 0.0;
      merged_[width] = static_cast<std::uint16_t>(std::min(ca, cb));
      for (std::size_t k = 0; k < 4; ++k) z[4 * width + k] = wa * pi[k] - wb * pj[k];
      a += ca <= cb;
      b += cb <= ca;
    }
    return {merged_.data(), width};
  }

  BlendRows rows_;
  Buffer<std::uint16_t> merged_, cluster_;
  Buffer<double> z_;  // of the run, and of one edge more
};

// The 4 x 4 blocks of the system matrix. Each cluster that is no handle has one row of blocks in lower and coupling, a
// handle has one in between.
struct Blocks {
  double *lower, *coupling, *between;
  std::size_t handles, free;
};

// Adds the 4 x 4 matrices L_cd (subspace.h) of the edges of a run. They couple each cluster c with itself and the
// clusters before it. Handles come first.
HF_FOUR_LANES
void add_blocks(const EdgeRun& run, const Blocks& out) noexcept {
  const std::size_t handle_stride = 4 * out.handles, free_stride = 4 * out.free;
  const std::size_t width = static_cast<std::size_t>(run.width), edges = static_cast<std::size_t>(run.edges);
  double wz[longest_run][4];
  for (std::size_t r = 0; r < width; ++r) {
    const std::size_t own = run.cluster[r];
    double* const handle_rows = own < out.handles ? out.between + 4 * own * handle_stride
                                                  : out.coupling + 4 * (own - out.handles) * handle_stride;
    for (std::size_t e = 0; e < edges; ++e) {
      for (std::size_t a = 0; a < 4; ++a) wz[e][a] = run.sample[e].weight * run.z[4 * (width * e + r) + a];
    }
    for (std::size_t s = 0; s <= r; ++s) {
      const std::size_t c = run.cluster[s];
      const bool handle = c < out.handles;
      const std::size_t stride = handle ? handle_stride : free_stride;
      double* const block =
          handle ? handle_rows + 4 * c : out.lower + 4 * (c - out.handles) + 4 * (own - out.handles) * stride;
      Four z, line0, line1, line2, line3;  // an array of them would not stay in registers
      std::memcpy(&line0, block, sizeof z);
      std::memcpy(&line1, block + stride, sizeof z);
      std::memcpy(&line2, block + 2 * stride, sizeof z);
      std::memcpy(&line3, block + 3 * stride, sizeof z);
      for (std::size_t e = 0; e < edges; ++e) {
        std::memcpy(&z, run.z + 4 * (width * e + s), sizeof z);
        line0 += wz[e][0] * z;
        line1 += wz[e][1] * z;
        line2 += wz[e][2] * z;
        line3 += wz[e][3] * z;
      }
      std::memcpy(block, &line0, sizeof z);
      std::memcpy(block + stride, &line1, sizeof z);
      std::memcpy(block + 2 * stride, &line2, sizeof z);
      std::memcpy(block + 3 * stride, &line3, sizeof z);
    }
  }
}

// The arrays to which the sums add the coefficient matrix Q_gc of group g and cluster c (subspace.h). Row a and column
// b of the matrix are at wide[16 entry + 4 a + b], where entry is entry_of[row_of_group[g] + c]. Column 3 stays 0.
struct Moments {
  double* wide;
  const std::int32_t* entry_of;
  const std::size_t* row_of_group;  // where the group's row begins
  const std::int32_t* group_of;
};

HF_FOUR_LANES
void add_moments(const EdgeRun& run, const Vec3* positions, const Moments& out) noexcept {
  const std::size_t width = static_cast<std::size_t>(run.width), edges = static_cast<std::size_t>(run.edges);
  Four step[longest_run];
  for (std::size_t e = 0; e < edges; ++e) {
    const Vec3 d = positions[run.sample[e].i] - positions[run.sample[e].j];
    step[e] = Four{d.x, d.y, d.z, 0};
  }
  for (std::size_t first = 0, last; first < edges; first = last) {
    // edges between the same two groups
    const std::int32_t gi = out.group_of[run.sample[first].i], gj = out.group_of[run.sample[first].j];
    for (last = first + 1; last < edges; ++last) {
      if (out.group_of[run.sample[last].i] != gi || out.group_of[run.sample[last].j] != gj) break;
    }
    const double share = gi == gj ? 1.0 : 0.5;
    const std::int32_t *entry_i = out.entry_of + out.row_of_group[gi], *entry_j = out.entry_of + out.row_of_group[gj];
    for (std::size_t r = 0; r < width; ++r) {
      double* const q = out.wide + 16 * static_cast<std::size_t>(entry_i[run.cluster[r]]);
      double* const other = out.wide + 16 * static_cast<std::size_t>(entry_j[run.cluster[r]]);
      for (std::size_t a = 0; a < 4; ++a) {
        Four line, beside;
        std::memcpy(&line, q + 4 * a, sizeof line);
        std::memcpy(&beside, other + 4 * a, sizeof beside);
        for (std::size_t e = first; e < last; ++e) {
          const double w = share * run.sample[e].weight;
          const Four term = (w * run.z[4 * (width * e + r) + a]) * step[e];
          line += term;
          beside += term;
        }
        std::memcpy(q + 4 * a, &line, sizeof line);
        if (gi != gj) std::memcpy(other + 4 * a, &beside, sizeof beside);
      }
    }
  }
}

class Assembly {
 public:
  Assembly(const surface::Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups,
           Subspace& out, Memory& memory)
      : core_(core),
        rest_(rest),
        weights_(weights),
        groups_(groups),
        out_(out),
        memory_(memory),
        elastic_(&memory),
        needs_all_(&memory),
        entry_of_(&memory),
        row_of_group_(&memory),
        handle_share_(&memory),
        samples_(&memory) {}

  void run() {
    find_elastic_components();
    count_edges();
    number_entries();
    const std::size_t size = 4 * static_cast<std::size_t>(weights_.free_count());
    lower_.allocate(memory_, size * size);
    std::fill(lower_.begin(), lower_.end(), 0.0);
    out_.coupling.allocate(memory_, size * 4 * static_cast<std::size_t>(weights_.handle_count));
    std::fill(out_.coupling.begin(), out_.coupling.end(), 0.0);
    const std::size_t handles = 4 * static_cast<std::size_t>(weights_.handle_count);
    out_.between.allocate(memory_, handles * handles);
    std::fill(out_.between.begin(), out_.between.end(), 0.0);
    list_uses();
    list_samples();
    // The sums of L (couples clusters) and Q (couples clusters with rotation groups) use the same edges in the same
    // order. So one or two threads give the same bits.
    Buffer<double> wide(memory_, 16 * out_.entry.size());
    std::fill(wide.begin(), wide.end(), 0.0);
    if (core_.jobs->thread_count() == 1)
      sum(true, true, wide.data());
    else
      core_.jobs->for_each(2, [&](std::uint32_t half) { sum(half == 0, half == 1, wide.data()); });
    for (std::size_t k = 0; k < out_.entry.size(); ++k) {
      for (std::size_t a = 0; a < 4; ++a) std::copy_n(wide.data() + 16 * k + 4 * a, 3, out_.entry[k].q[a]);
    }
    add_rigidity();
    collect_means();
    out_.factor.factorise(std::move(lower_), static_cast<std::int32_t>(size), memory_);
  }

 private:
  void find_elastic_components() {
    elastic_.assign(core_.mesh.component_count(), 0);
    for (std::size_t k = 0; k < weights_.elastic_components.size(); ++k)
      elastic_[weights_.elastic_components[k]] = 1 + weights_.shared[k];
    // The numbers of groups say which component got its second handle first. Sums over all groups must not, so groups
    // are listed by component.
    for (std::size_t k = 0; k < weights_.elastic_components.size(); ++k) {
      const std::int32_t c = weights_.elastic_components[k];
      for (std::int32_t g = groups_.component_start[c]; g < groups_.component_end[c]; ++g) {
        out_.group.push_back(g);
        out_.shared.push_back(weights_.shared[k]);
      }
    }
  }

  bool is_elastic(std::int32_t vertex) const noexcept { return elastic_[core_.mesh.component[vertex]] != 0; }

  // Counts the edge ends in each cluster, and marks the vertices of clusters that have few.
  void count_edges() {
    struct Counts {
      Counts(std::size_t clusters, Memory& memory) : by_cluster(clusters, 0, &memory) {}
      Vector<std::int32_t> by_cluster;
      std::int64_t all = 0;
      std::int32_t widest = 0;
    };
    const mesh::Topology& topology = core_.topology();
    const std::size_t clusters = static_cast<std::size_t>(weights_.cluster_count);
    Vector<Counts> counts(&memory_);
    counts.reserve(count_shares);
    for (std::uint32_t share = 0; share < count_shares; ++share) counts.emplace_back(clusters, memory_);
    const auto first_of = [&](std::uint32_t share) {
      return static_cast<std::int32_t>(std::int64_t{core_.size()} * share / count_shares);
    };
    core_.jobs->for_each(count_shares, [&](std::uint32_t share) {
      Counts& own = counts[share];
      for (std::int32_t v = first_of(share); v < first_of(share + 1); ++v) {
        own.widest = std::max(own.widest, weights_.start[v + 1] - weights_.start[v]);
        if (!is_elastic(v)) continue;
        // Edges are counted at both ends: a vertex has as many edges as neighbours.
        const std::int32_t degree = topology.neighbour_start[v + 1] - topology.neighbour_start[v];
        own.all += degree;
        for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k)
          own.by_cluster[weights_.cluster[k]] += degree;
      }
    });
    Counts total(clusters, memory_);
    for (const Counts& own : counts) {
      total.all += own.all;
      widest_ = std::max(widest_, own.widest);
      for (std::size_t c = 0; c < clusters; ++c) total.by_cluster[c] += own.by_cluster[c];
    }
    if (total.all > 0) {
      probability_ = edge_samples / (0.5 * static_cast<double>(total.all));
      sampled_weight_ = 1 / probability_;
    }
    Vector<std::uint8_t> few(clusters, 0, &memory_);
    bool any = false;
    for (std::size_t c = static_cast<std::size_t>(weights_.handle_count); c < clusters; ++c) {
      few[c] = total.by_cluster[c] < few_edges;
      any = any || few[c];
    }
    needs_all_.assign(core_.size(), 0);
    if (!any) return;
    core_.jobs->for_each(count_shares, [&](std::uint32_t share) {
      for (std::int32_t v = first_of(share); v < first_of(share + 1); ++v) {
        for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k)
          needs_all_[v] |= few[weights_.cluster[k]];
      }
    });
  }

  // Returns the weight of edge e in the sample, or 0 if the sample leaves it out.
  double sample_weight(std::int32_t e) const noexcept {
    const std::int32_t i = core_.topology().first(e), j = core_.topology().second(e);
    const bool all = probability_ >= 1 || (needs_all_[i] | needs_all_[j]) != 0;
    const bool sampled = scattered(static_cast<std::uint32_t>(e)) < probability_;
    return is_elastic(i) ? all ? 1.0 : sampled ? sampled_weight_ : 0.0 : 0.0;
  }

  // Numbers the pairs (rotation group, cluster) that share vertices or edges, and sums the areas of their vertices. It
  // marks them in a table, then numbers them group by group.
  void number_entries() {
    const std::size_t clusters = static_cast<std::size_t>(weights_.cluster_count);
    entry_of_.assign(out_.group.size() * clusters, -1);
    Vector<double> area(entry_of_.size(), 0.0, &memory_);
    row_of_group_.assign(groups_.count(), 0);
    for (std::size_t k = 0; k < out_.group.size(); ++k) row_of_group_[out_.group[k]] = k * clusters;
    const auto mark = [&](std::int32_t group, std::int32_t v) {
      std::int32_t* row = entry_of_.data() + row_of_group_[group];
      for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k) row[weights_.cluster[k]] = 0;
    };
    const mesh::Topology& topology = core_.topology();
    for (const std::int32_t e : groups_.border_edge) {
      const std::int32_t i = topology.first(e), j = topology.second(e);
      if (is_elastic(i)) {
        mark(groups_.group_of[i], j);
        mark(groups_.group_of[j], i);
      }
    }
    for (std::int32_t v = 0; v < core_.size(); ++v) {
      if (!is_elastic(v)) continue;
      const std::size_t row = row_of_group_[groups_.group_of[v]];
      for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k) {
        entry_of_[row + weights_.cluster[k]] = 0;
        area[row + weights_.cluster[k]] += rest_.area[v] * weights_.weight[k];
      }
    }
    out_.entry_start.push_back(0);
    for (std::size_t g = 0; g < out_.group.size(); ++g) {
      for (std::size_t c = 0; c < clusters; ++c) {
        std::int32_t& number = entry_of_[g * clusters + c];
        if (number < 0) continue;
        number = static_cast<std::int32_t>(out_.entry.size());
        out_.entry.push_back({static_cast<std::int32_t>(c), area[g * clusters + c], {}});
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

  // Lists the edges that the energy uses, in pieces of fixed size.
  void list_samples() {
    const mesh::Topology& topology = core_.topology();
    handle_share_.assign(core_.size(), 0.0f);
    for_vertex_pieces(*core_.jobs, core_.size(), [&](std::int32_t first, std::int32_t last) {
      for (std::int32_t v = first; v < last; ++v) {
        for (std::int32_t k = weights_.start[v]; k < weights_.start[v + 1]; ++k) {
          if (weights_.cluster[k] >= weights_.handle_count) break;  // handles come first
          handle_share_[v] = std::max(handle_share_[v], weights_.weight[k]);
        }
      }
    });
    const std::int32_t edges = topology.edge_count();
    const std::uint32_t pieces = static_cast<std::uint32_t>((edges + edge_piece - 1) / edge_piece);
    for (std::uint32_t p = 0; p < pieces; ++p) samples_.emplace_back();
    const double share = std::min(1.0, 1.1 * probability_);  // most pieces stay below it
    core_.jobs->for_each(pieces, [&](std::uint32_t p) {
      samples_[p].reserve(static_cast<std::size_t>(share * edge_piece));
      const std::int32_t first = static_cast<std::int32_t>(p) * edge_piece;
      // the edges of the sample, listed without branches: no processor predicts them
      Buffer<std::int32_t> listed(memory_, edge_piece + 1);
      std::int32_t count = 0;
      for (std::int32_t e = first; e < std::min(edges, first + edge_piece); ++e) {
        listed[count] = e;
        count += sample_weight(e) > 0;
      }
      for (std::int32_t n = 0; n < count; ++n) {
        const std::int32_t e = listed[n];
        const double sampled = sample_weight(e);
        const std::int32_t i = topology.first(e), j = topology.second(e);
        const double gain = border_stiffness[elastic_[core_.mesh.component[i]] - 1];
        const double close = std::max(handle_share_[i], handle_share_[j]), square = close * close;
        samples_[p].push_back({i, j, sampled * rest_.stiffness[e] * (1 + gain * square * square)});
      }
    });
  }

  void sum(bool blocks, bool moments, double* wide) {
    const BlendRows rows{weights_.start.data(), weights_.cluster.data(), weights_.weight.data(),
                         core_.mesh.positions.data()};
    const Blocks of_clusters{lower_.data(), out_.coupling.data(), out_.between.data(),
                             static_cast<std::size_t>(weights_.handle_count),
                             static_cast<std::size_t>(weights_.free_count())};
    const Moments of_groups{wide, entry_of_.data(), row_of_group_.data(), groups_.group_of.data()};
    RunReader runs(rows, widest_, memory_);
    for (const auto& piece : samples_) {
      runs.read(piece.data(), piece.size(), [&](const EdgeRun& run) {
        if (blocks) add_blocks(run, of_clusters);
        if (moments) add_moments(run, rows.positions, of_groups);
      });
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

  const surface::Core& core_;
  const Rest& rest_;
  const ClusterWeights& weights_;
  const Groups& groups_;
  Subspace& out_;
  Memory& memory_;
  // By component: 0 without free clusters, 1 with free clusters, 2 if more than two handles meet there too.
  Vector<std::uint8_t> elastic_;
  Vector<std::uint8_t> needs_all_;    // by vertex: 1 in a cluster with few edges
  Vector<std::int32_t> entry_of_;     // by group and cluster: number of the pair
  Vector<std::size_t> row_of_group_;  // by rotation group: where its row of entry_of_ begins
  Vector<float> handle_share_;        // by vertex: largest weight of a handle, 1 on the handle
  Vector<Vector<Sample>> samples_;    // edges used, in pieces of fixed size
  double probability_ = 1, sampled_weight_ = 1;
  std::int32_t widest_ = 0;  // largest number of weights of a vertex
  Buffer<double> lower_;
};

}  // namespace

Subspace make_subspace(const surface::Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups,
                       Memory& memory) {
  Subspace subspace(memory);
  Assembly(core, rest, weights, groups, subspace, memory).run();
  return subspace;
}

}  // namespace hf_inner::deform
