// See source_rotations.h.
#include "transfer/source_rotations.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/compiler.h"
#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/soft_rotation.h"

namespace hf_inner::transfer {
namespace {

HF_VECTOR(Four, double, 4);

// Adds q_i g_i' to the three columns of a matrix: q are the posed places of the vertices, relative to the origin.
HF_FOUR_LANES
void add_moments(const std::int32_t* vertex, const Vec3* slope, std::size_t count, Vec3 origin, const Vec3* posed,
                 double (&columns)[3][4]) noexcept {
  const Four from = {origin.x, origin.y, origin.z, 0};
  Four x = {0, 0, 0, 0}, y = x, z = x;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 place = posed[vertex[i]], g = slope[i];
    const Four q = Four{place.x, place.y, place.z, 0} - from;
    x += q * g.x;
    y += q * g.y;
    z += q * g.z;
  }
  std::memcpy(columns[0], &x, sizeof x);
  std::memcpy(columns[1], &y, sizeof y);
  std::memcpy(columns[2], &z, sizeof z);
}

// Returns the moment matrix M = sum_v q_v g_v' of cluster c: q are posed places, g the constant vectors of clusters.h.
// The g sum to zero, so any origin gives the same M. An origin near the cluster keeps the digits of poses far away.
Mat3 moment_of(const SourceKernels& kernels, std::int32_t c, const Vec3* posed) noexcept {
  Mat3 moment;
  const std::int32_t first = kernels.start[at(c)], last = kernels.start[at(c) + 1];
  if (first == last) return moment;
  double columns[3][4];
  add_moments(kernels.vertex.data() + first, kernels.slope.data() + first, at(last - first),
              posed[kernels.vertex[at(first)]], posed, columns);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) moment(i, j) = columns[j][i];
  return moment;
}

}  // namespace

void SourceRotations::prepare(const mesh::Mesh& mesh, Span<const double> area) {
  const std::size_t count = std::min(area.size(), most_sampled);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t v = i * area.size() / count;
    sample_.push_back(static_cast<std::int32_t>(v));
    sample_weight_.push_back(area[v]);
    sum += area[v];
  }
  for (std::size_t i = 0; i < count; ++i) {
    sample_weight_[i] /= sum;
    sample_centroid_ = sample_centroid_ + sample_weight_[i] * mesh.positions[at(sample_[i])];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = mesh.positions[at(sample_[i])] - sample_centroid_;
    sample_spread_ += sample_weight_[i] * dot(p, p);
  }
}

WholeMotion SourceRotations::whole(const mesh::Mesh& mesh, Span<const double> area, const Vec3* posed) const noexcept {
  WholeMotion out;
  for (std::size_t v = 0; v < area.size(); ++v) {
    out.rest_centroid = out.rest_centroid + area[v] * mesh.positions[v];
    out.centroid = out.centroid + area[v] * posed[v];
  }
  Mat3 moment;
  for (std::size_t i = 0; i < sample_.size(); ++i) {
    deform::add_outer(moment, sample_weight_[i], posed[sample_[i]] - out.centroid,
                      mesh.positions[at(sample_[i])] - sample_centroid_);
  }
  if (sample_spread_ > 0) out.rotation = deform::best_rotation((1 / sample_spread_) * moment, deform::Quaternion());
  const Mat3 rotation = out.rotation.toRotationMatrix();
  double sum = 0;
  for (std::size_t i = 0; i < sample_.size(); ++i) {
    const Vec3 d = posed[sample_[i]] - out.centroid - rotation * (mesh.positions[at(sample_[i])] - out.rest_centroid);
    sum += sample_weight_[i] * dot(d, d);
  }
  out.residual = std::sqrt(sum);
  return out;
}

void SourceRotations::clusters(const Clusters& clusters, const Vec3* posed, const deform::Quaternion& whole,
                               deform::Quaternion* out, JobRunner& jobs) const {
  jobs.for_each(static_cast<std::uint32_t>(clusters.count), [&](std::uint32_t i) {
    const auto c = static_cast<std::int32_t>(i);
    const Mat3 around = moment_of(clusters.broad, c, posed) + broad_prior * whole.toRotationMatrix();
    const deform::Quaternion broad = deform::best_rotation_from(around, whole);
    const Mat3 own = moment_of(clusters.narrow, c, posed) + narrow_prior * broad.toRotationMatrix();
    out[i] = soft_rotation(own, broad, narrow_sharpness);
  });
}

}  // namespace hf_inner::transfer
