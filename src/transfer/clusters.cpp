// See clusters.h.
#include "transfer/clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/elementary.h"
#include "base/index.h"
#include "base/progress.h"
#include "base/unit_weights.h"

namespace hf_inner::transfer {
namespace {

double squared_distance(const double* a, const double* b, std::int32_t count) noexcept {
  double sum = 0;
  for (std::int32_t i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// The five nearest cluster centres of a target vertex, updated whenever a centre is added.
struct NearestCentres {
  static constexpr std::int32_t kept = blend_count + 1;
  double distance[kept];
  std::int32_t cluster[kept];
  void insert(double d, std::int32_t c) noexcept {
    if (d >= distance[kept - 1]) return;
    std::int32_t i = kept - 1;
    for (; i > 0 && distance[i - 1] > d; --i) {
      distance[i] = distance[i - 1];
      cluster[i] = cluster[i - 1];
    }
    distance[i] = d;
    cluster[i] = c;
  }
};

// Chooses cluster centres by farthest-point sampling of the vertices, with the differences of their field values as
// distances. The first centre is the vertex with the largest field value.
void sample_centres(const ClusterOptions& options, std::int32_t width, Span<const double> field, Clusters& out,
                    Vector<NearestCentres>& nearest, Memory& memory, JobRunner& jobs) {
  const std::size_t n = field.size() / at(width);
  const std::int32_t wanted = options.cluster_count ? options.cluster_count : default_cluster_count;
  NearestCentres empty;
  std::fill(std::begin(empty.distance), std::end(empty.distance), std::numeric_limits<double>::infinity());
  std::fill(std::begin(empty.cluster), std::end(empty.cluster), -1);
  nearest.assign(n, empty);
  std::size_t next = 0;
  double largest = -1;
  Poller poller;
  for (std::size_t v = 0; v < n; ++v) {
    poller.due();
    const double m = *std::max_element(field.data() + v * at(width), field.data() + (v + 1) * at(width));
    if (m > largest) {
      largest = m;
      next = v;
    }
  }
  const auto blocks = static_cast<std::uint32_t>((n + vertex_block - 1) / vertex_block);
  Vector<std::size_t> farthest(blocks, std::size_t{0}, &memory);
  const double redundant = redundant_share * options.kernel_width;
  while (out.count < wanted) {
    const std::int32_t c = out.count++;
    out.centre.insert(out.centre.end(), field.data() + next * at(width), field.data() + (next + 1) * at(width));
    const double* centre = out.centre.data() + at(c * width);
    jobs.for_each(blocks, [&](std::uint32_t b) {
      const std::size_t first = std::size_t{b} * vertex_block, last = std::min(n, first + vertex_block);
      farthest[b] = first;
      for (std::size_t v = first; v < last; ++v) {
        nearest[v].insert(squared_distance(field.data() + v * at(width), centre, width), c);
        if (nearest[v].distance[0] > nearest[farthest[b]].distance[0]) farthest[b] = v;
      }
    });
    next = farthest[0];
    for (const std::size_t v : farthest) {
      if (nearest[v].distance[0] > nearest[next].distance[0]) next = v;
    }
    if (nearest[next].distance[0] <= redundant * redundant) break;
  }
  out.field_count = width;
}

void weigh_by_distance(double kernel_width, const Vector<NearestCentres>& nearest, std::int32_t* joint, float* weight) {
  const double sharpness = 1.0 / (2 * kernel_width * kernel_width);
  Poller poller;
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    poller.due();
    const NearestCentres& near = nearest[v];
    ClusterWeight candidates[blend_count];
    std::int32_t count = 0;
    // A vertex belongs to the clusters of the four nearest centres. The weight at the fifth is subtracted from theirs,
    // so that weights stay continuous where the four change.
    const double last =
        near.cluster[blend_count] < 0 ? 0.0 : exponential(-sharpness * (near.distance[blend_count] - near.distance[0]));
    for (std::int32_t i = 0; i < blend_count && near.cluster[i] >= 0; ++i) {
      candidates[count].cluster = near.cluster[i];
      candidates[count++].weight = exponential(-sharpness * (near.distance[i] - near.distance[0])) - last;
    }
    write_weights(candidates, count, joint + v * blend_count, weight + v * blend_count);
  }
}

void thin(KernelRow& row, std::size_t most) {
  const std::size_t size = row.vertex.size();
  if (size <= most) return;
  for (std::size_t i = 0; i < most; ++i) {
    const std::size_t from = i * size / most;
    row.vertex[i] = row.vertex[from];
    row.weight[i] = row.weight[from];
  }
  row.vertex.resize(most);
  row.weight.resize(most);
}

void finish(KernelRow& row, std::size_t most, std::int32_t fallback) {
  thin(row, most);
  double sum = 0;
  for (const double w : row.weight) sum += w;
  if (!(sum > 0)) {
    row.vertex.assign(1, fallback);
    row.weight.assign(1, 1.0);
    return;
  }
  for (double& w : row.weight) w /= sum;
}

// Scratch arrays by source vertex; all are zero again after each cluster.
struct EdgeScratch {
  EdgeScratch(std::size_t count, Memory& memory)
      : kernel(count, 0.0, &memory),
        slope(count, Vec3(), &memory),
        met(count, std::uint8_t{0}, &memory),
        list(&memory) {}
  Vector<double> kernel;
  Vector<Vec3> slope;
  Vector<std::uint8_t> met;
  Vector<std::int32_t> list;
};

// Adds one cluster's slopes (vectors g of clusters.h): all edges of the kernel's vertices, summed up at their two ends.
void append_edges(const KernelRow& row, const surface::Core& core, EdgeScratch& scratch, SourceKernels& out) {
  const std::size_t begin = out.slope.size();
  Vector<double>& kernel = scratch.kernel;
  for (std::size_t i = 0; i < row.vertex.size(); ++i) kernel[at(row.vertex[i])] = row.weight[i];
  const auto add = [&](std::int32_t v, Vec3 g) {
    if (!scratch.met[at(v)]) {
      scratch.met[at(v)] = 1;
      scratch.list.push_back(v);
    }
    scratch.slope[at(v)] = scratch.slope[at(v)] + g;
  };
  double trace = 0;
  Poller poller;
  for (const std::int32_t v : row.vertex) {
    poller.due();
    for (std::int32_t e = core.topology().neighbour_start[at(v)]; e < core.topology().neighbour_start[at(v) + 1]; ++e) {
      const std::int32_t u = core.topology().neighbour[at(e)];
      if (u < v && kernel[at(u)] > 0) continue;
      const double w =
          std::clamp(core.weights()[at(core.topology().neighbour_edge[at(e)])], flattest_weight, steepest_weight) *
          (kernel[at(v)] + kernel[at(u)]);
      const Vec3 d = core.mesh.positions[at(v)] - core.mesh.positions[at(u)];
      add(v, w * d);
      add(u, -w * d);
      trace += w * dot(d, d);
    }
  }
  std::sort(scratch.list.begin(), scratch.list.end());
  for (const std::int32_t v : scratch.list) {
    out.vertex.push_back(v);
    out.slope.push_back(scratch.slope[at(v)]);
    scratch.slope[at(v)] = Vec3();
    scratch.met[at(v)] = 0;
  }
  scratch.list.clear();
  close_row(begin, trace, out);
  for (const std::int32_t v : row.vertex) kernel[at(v)] = 0;
}

// Collects the source vertices of a cluster's two Gaussian kernels around its centre. Where the source is coarse, the
// kernels are wider.
void centre_rows(const ClusterOptions& options, const double* centre, std::int32_t width, Span<const double> field,
                 ClusterRows& out, Memory& memory) {
  const std::size_t n = field.size() / at(width);
  Vector<double> distance(n, &memory), sorted(&memory);
  for (std::size_t v = 0; v < n; ++v)
    distance[v] = std::sqrt(squared_distance(field.data() + v * at(width), centre, width));
  sorted = distance;
  poll();
  const double base = options.kernel_width;
  for (const bool is_broad : {false, true}) {
    const double factor = is_broad ? broad_factor : 1.0;
    const std::size_t m = std::min(n - 1, static_cast<std::size_t>(factor * nearest_count) - 1);
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(m), sorted.end());
    const double s = std::max(factor * base, sorted[m]);
    KernelRow& row = is_broad ? out.broad : out.narrow;
    for (std::size_t v = 0; v < n; ++v) {
      if (distance[v] > kernel_cut * s) continue;
      row.vertex.push_back(static_cast<std::int32_t>(v));
      row.weight.push_back(exponential(-0.5 * distance[v] * distance[v] / (s * s)));
    }
  }
  std::int32_t nearest = 0;
  for (std::size_t v = 0; v < n; ++v) {
    if (distance[v] <= kernel_cut * base) ++out.support;
    if (distance[v] < distance[at(nearest)]) nearest = static_cast<std::int32_t>(v);
  }
  finish_rows(out, nearest);
}

// Computes mass and centroid of every cluster on the target. Clusters without mass are dropped, and the others
// renumbered.
void measure_target(Span<const double> area, const mesh::Mesh& mesh, Clusters& out, Vector<std::int32_t>& kept,
                    Memory& memory) {
  Vector<double> mass(at(out.count), 0.0, &memory);
  Vector<Vec3> pivot(at(out.count), &memory);
  Poller poller;
  for (std::size_t v = 0; v < area.size(); ++v) {
    poller.due();
    for (std::size_t i = v * blend_count; i < (v + 1) * blend_count; ++i) {
      const double w = area[v] * static_cast<double>(out.weight[i]);
      mass[at(out.joint[i])] += w;
      pivot[at(out.joint[i])] = pivot[at(out.joint[i])] + w * mesh.positions[v];
    }
  }
  Vector<std::int32_t> renumbered(at(out.count), 0, &memory);
  for (std::int32_t c = 0; c < out.count; ++c) {
    if (!(mass[at(c)] > 0)) continue;
    renumbered[at(c)] = static_cast<std::int32_t>(kept.size());
    kept.push_back(c);
    out.mass.push_back(mass[at(c)]);
    out.pivot.push_back((1 / mass[at(c)]) * pivot[at(c)]);
  }
  for (std::int32_t& joint : out.joint) joint = renumbered[at(joint)];
}

}  // namespace

void finish_rows(ClusterRows& rows, std::int32_t nearest) {
  finish(rows.narrow, most_narrow, nearest);
  finish(rows.broad, most_broad, nearest);
}

void close_row(std::size_t begin, double trace, SourceKernels& out) {
  for (std::size_t i = begin; i < out.slope.size(); ++i) out.slope[i] = (trace > 0 ? 1 / trace : 0.0) * out.slope[i];
  out.start.push_back(static_cast<std::int32_t>(out.slope.size()));
}

void write_weights(ClusterWeight* candidates, std::int32_t count, std::int32_t* joint, float* weight) noexcept {
  std::sort(candidates, candidates + count, [](const ClusterWeight& a, const ClusterWeight& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.cluster < b.cluster;
  });
  count = std::min(count, blend_count);
  double sum = 0;
  for (std::int32_t i = 0; i < count; ++i) sum += candidates[i].weight;
  if (!(sum > 0)) {  // the four nearest centres are as far away as the fifth
    for (std::int32_t i = 0; i < count; ++i) {
      candidates[i].weight = 1;
      sum += 1;
    }
  }
  split_units(
      blend_count, weight_units, sum, [&](std::int32_t i) { return i < count ? candidates[i].weight : 0.0; },
      [&](std::int32_t i, double units) {
        joint[i] = units > 0 ? candidates[i].cluster : count > 0 ? candidates[0].cluster : 0;
        weight[i] = static_cast<float>(units / weight_units);
      });
}

Vector<double> area_shares(const mesh::Mesh& mesh, Memory& memory) {
  Vector<double> area = mesh::vertex_areas(mesh, memory);
  double sum = 0;
  for (const double a : area) sum += a;
  const double floor = sum > 0 ? least_area_share * sum / static_cast<double>(area.size()) : 1.0;
  sum = 0;
  for (double& a : area) {
    a = std::max(a, floor);
    sum += a;
  }
  for (double& a : area) a /= sum;
  return area;
}

Clusters make_clusters(const ClusterOptions& options, std::int32_t field_count, Span<const double> source_field,
                       Span<const double> source_area, const surface::Core& source_core,
                       Span<const double> target_field, Span<const double> target_area, const mesh::Mesh& target_mesh,
                       Memory& memory, JobRunner& jobs) {
  Clusters out(memory);
  out.field_count = field_count;
  const std::size_t n = target_area.size();
  out.joint.resize(n * blend_count);
  out.weight.resize(n * blend_count);
  const ClusterScheme* scheme = options.scheme;
  if (scheme) {
    out.count = scheme->cluster_count(options.cluster_count, field_count);
    scheme->weigh(out.count, field_count, target_field, out.joint.data(), out.weight.data(), memory);
  } else {
    Vector<NearestCentres> nearest(&memory);
    sample_centres(options, field_count, target_field, out, nearest, memory, jobs);
    weigh_by_distance(options.kernel_width, nearest, out.joint.data(), out.weight.data());
  }
  Vector<std::int32_t> kept(&memory);
  measure_target(target_area, target_mesh, out, kept, memory);

  Vector<ClusterRows> rows(&memory);
  rows.reserve(kept.size());
  for (std::size_t c = 0; c < kept.size(); ++c) rows.emplace_back(memory);
  jobs.for_each(static_cast<std::uint32_t>(kept.size()), [&](std::uint32_t c) {
    if (scheme) {
      scheme->collect(kept[c], out.count, field_count, source_field, source_area, rows[c]);
    } else {
      centre_rows(options, out.centre.data() + at(kept[c] * field_count), field_count, source_field, rows[c], memory);
    }
  });

  // Copies the centres of the clusters that remain. With a scheme, a cluster's centre is the mean of its vertices'
  // field values, weighted by area.
  Vector<double> centres(kept.size() * at(field_count), 0.0, &memory);
  if (!scheme) {
    for (std::size_t c = 0; c < kept.size(); ++c) {
      std::copy_n(out.centre.data() + at(kept[c] * field_count), field_count, centres.data() + c * at(field_count));
    }
  } else {
    Poller poller;
    for (std::size_t v = 0; v < n; ++v) {
      poller.due();
      for (std::size_t i = v * blend_count; i < (v + 1) * blend_count; ++i) {
        const std::size_t c = at(out.joint[i]);
        const double w = target_area[v] * static_cast<double>(out.weight[i]) / out.mass[c];
        for (std::int32_t h = 0; h < field_count; ++h)
          centres[c * at(field_count) + at(h)] += w * target_field[v * at(field_count) + at(h)];
      }
    }
  }
  out.centre.swap(centres);
  out.count = static_cast<std::int32_t>(kept.size());
  EdgeScratch scratch(source_area.size(), memory);
  out.narrow.start.assign(1, 0);
  out.broad.start.assign(1, 0);
  for (const ClusterRows& row : rows) {
    if (scheme) {
      scheme->append(row.narrow, source_core, out.narrow);
      scheme->append(row.broad, source_core, out.broad);
    } else {
      append_edges(row.narrow, source_core, scratch, out.narrow);
      append_edges(row.broad, source_core, scratch, out.broad);
    }
    out.support.push_back(row.support);
  }
  return out;
}

SourceWeights weigh_source(const Clusters& clusters, double kernel_width, Span<const double> source_field,
                           Memory& memory, JobRunner& jobs) {
  const std::int32_t width = clusters.field_count;
  const std::size_t n = source_field.size() / at(width);
  NearestCentres empty;
  std::fill(std::begin(empty.distance), std::end(empty.distance), std::numeric_limits<double>::infinity());
  std::fill(std::begin(empty.cluster), std::end(empty.cluster), -1);
  Vector<NearestCentres> nearest(n, empty, &memory);
  jobs.for_each(static_cast<std::uint32_t>((n + vertex_block - 1) / vertex_block), [&](std::uint32_t b) {
    const std::size_t last = std::min(n, (std::size_t{b} + 1) * vertex_block);
    for (std::size_t v = std::size_t{b} * vertex_block; v < last; ++v)
      for (std::int32_t c = 0; c < clusters.count; ++c)
        nearest[v].insert(
            squared_distance(source_field.data() + v * at(width), clusters.centre.data() + at(c * width), width), c);
  });
  SourceWeights out(memory);
  out.joint.resize(n * blend_count);
  out.weight.resize(n * blend_count);
  weigh_by_distance(kernel_width, nearest, out.joint.data(), out.weight.data());
  return out;
}

}  // namespace hf_inner::transfer
