#include "peers/paper_transfer.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "base/index.h"
#include "base/progress.h"
#include "transfer/clusters.h"

namespace hf_inner::peers {
namespace {

// Level bands per field; each is a cluster of vertices. At half the value: the error of a horse
// transferred to itself is 0.018 (0.021 now), feet end twice as far from their paths. At twice the value: the error is
// 0.031, feet a sixth as far.
constexpr std::int32_t bands_per_field = 8;
// Level bands per field, at least and at most. Hat functions need two; the upper bound keeps a dense
// matrix small.
constexpr std::int32_t least_bands_per_field = 2, most_bands_per_field = 64;
// Power of the field that shrinks the clusters towards their region. At half the value: the error of a
// horse transferred to itself is 0.024 (0.021 now). At twice the value: 0.020, but feet end 1.1 times as far from their
// paths.
constexpr double band_exponent = 4;
// A cluster's rotation also reads the level bands up to this far from its own. Halving or doubling it
// changes errors and edge stretches by at most 3 %. It moves vertices by up to 0.005 boxes.
constexpr double broad_bands = 3;
// Weight of vertices with field 0 in a cluster's broad kernel. Halving or doubling it moves vertices by
// at most 2e-6 boxes.
constexpr double broad_band_floor = 1e-6;

// Returns the weight of one level band at the field value u. It is a hat function of `bands` bands over [0, 1], times
// u^band_exponent.
double band_weight(double u, std::int32_t band, std::int32_t bands) noexcept {
  const double hat = 1 - std::abs(u * (bands - 1) - band);
  static_assert(band_exponent == 4, "the power is two squares");
  return hat > 0 ? hat * ((u * u) * (u * u)) : 0.0;
}

void weigh_by_bands(std::int32_t width, std::int32_t bands, Span<const double> field, std::int32_t* joint,
                    float* weight, Memory& memory) {
  Vector<transfer::ClusterWeight> candidates(at(2 * width), &memory);
  Poller poller;
  for (std::size_t v = 0; v < field.size() / at(width); ++v) {
    poller.due();
    std::int32_t count = 0;
    for (std::int32_t h = 0; h < width; ++h) {
      const double u = field[v * at(width) + at(h)];
      const auto low = std::min(bands - 2, static_cast<std::int32_t>(u * (bands - 1)));
      for (std::int32_t k = low; k <= low + 1; ++k) {
        const double w = band_weight(u, k, bands);
        if (w > 0) {
          candidates[at(count)].cluster = h * bands + k;
          candidates[at(count++)].weight = w;
        }
      }
    }
    transfer::write_weights(candidates.data(), count, joint + v * transfer::blend_count,
                            weight + v * transfer::blend_count);
  }
}

// The narrow kernel of a cluster (which gives its rotation) has the weights of one level band. The broad
// kernel also covers the neighbouring bands.
void band_rows(std::int32_t h, std::int32_t band, std::int32_t bands, std::int32_t width, Span<const double> field,
               Span<const double> area, transfer::ClusterRows& out) {
  std::int32_t nearest = 0;
  double best = 2;
  const double level = static_cast<double>(band) / (bands - 1);
  for (std::size_t v = 0; v < area.size(); ++v) {
    const double u = field[v * at(width) + at(h)];
    const double narrow = band_weight(u, band, bands);
    const double around = 1 - std::abs(u * (bands - 1) - band) / broad_bands;
    if (narrow > 0) {
      out.narrow.vertex.push_back(static_cast<std::int32_t>(v));
      out.narrow.weight.push_back(area[v] * narrow);
      ++out.support;
    }
    if (around > 0) {
      out.broad.vertex.push_back(static_cast<std::int32_t>(v));
      out.broad.weight.push_back(area[v] * around * (u * u + broad_band_floor));
    }
    if (std::abs(u - level) < best) {
      best = std::abs(u - level);
      nearest = static_cast<std::int32_t>(v);
    }
  }
  transfer::finish_rows(out, nearest);
}

void append_vertices(const transfer::KernelRow& row, const surface::Core& core, transfer::SourceKernels& out) {
  const std::size_t begin = out.slope.size();
  Vec3 centroid;
  for (std::size_t i = 0; i < row.vertex.size(); ++i)
    centroid = centroid + row.weight[i] * core.mesh.positions[at(row.vertex[i])];
  double trace = 0;
  for (std::size_t i = 0; i < row.vertex.size(); ++i) {
    const Vec3 p = core.mesh.positions[at(row.vertex[i])] - centroid;
    out.vertex.push_back(row.vertex[i]);
    out.slope.push_back(row.weight[i] * p);
    trace += row.weight[i] * dot(p, p);
  }
  transfer::close_row(begin, trace, out);
}

class PaperClusters final : public transfer::ClusterScheme {
 public:
  std::int32_t cluster_count(std::int32_t given, std::int32_t field_count) const noexcept override {
    return field_count *
           (given ? std::clamp(given / field_count, least_bands_per_field, most_bands_per_field) : bands_per_field);
  }
  void weigh(std::int32_t cluster_count, std::int32_t field_count, Span<const double> field, std::int32_t* joint,
             float* weight, Memory& memory) const override {
    weigh_by_bands(field_count, cluster_count / field_count, field, joint, weight, memory);
  }
  void collect(std::int32_t cluster, std::int32_t cluster_count, std::int32_t field_count, Span<const double> field,
               Span<const double> area, transfer::ClusterRows& out) const override {
    const std::int32_t bands = cluster_count / field_count;
    band_rows(cluster / bands, cluster % bands, bands, field_count, field, area, out);
  }
  void append(const transfer::KernelRow& row, const surface::Core& core, transfer::SourceKernels& out) const override {
    append_vertices(row, core, out);
  }
};

}  // namespace

std::shared_ptr<const transfer::ClusterScheme> paper_clusters() noexcept {
  // A static object with a destructor would be a call at the end of the process; this one holds nothing and stays.
  alignas(PaperClusters) static unsigned char room[sizeof(PaperClusters)];
  static const PaperClusters* const scheme = new (room) PaperClusters;
  return {std::shared_ptr<void>(), scheme};
}

}  // namespace hf_inner::peers
