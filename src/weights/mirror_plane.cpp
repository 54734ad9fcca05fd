#include "weights/mirror_plane.h"

#include <algorithm>
#include <cmath>

#include "base/principal_axes.h"
#include "base/progress.h"
#include "mesh/nearest_triangle.h"
#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

struct PointPair {
  Vec3 p, q;
};

Vec3 column_of(const Mat3& axes, int c) noexcept { return {axes(0, c), axes(1, c), axes(2, c)}; }

// Makes the largest component of the normal positive. A normal that is an axis up to the rounding of an exporter
// becomes that axis.
void settle(mesh::MirrorPlane& plane) noexcept {
  double n[3] = {plane.normal.x, plane.normal.y, plane.normal.z};
  const int most =
      static_cast<int>(std::max_element(n, n + 3, [](double a, double b) { return std::fabs(a) < std::fabs(b); }) - n);
  if (n[most] < 0) {
    plane.normal = -1.0 * plane.normal;
    plane.offset = -plane.offset;
  }
  if (std::fabs(n[most]) < std::sqrt(1 - axis_slack * axis_slack)) return;
  plane.normal = {most == 0 ? 1.0 : 0.0, most == 1 ? 1.0 : 0.0, most == 2 ? 1.0 : 0.0};
}

// The plane with the least sum of squared distances between the reflected p and q. Count p and q from the middle of all
// points. The normal is the eigenvector of the least eigenvalue of the symmetric part of sum p q'.
mesh::MirrorPlane fit_plane(const Vector<PointPair>& pairs) {
  Vec3 middle;
  const double share = 0.5 / static_cast<double>(pairs.size());
  for (const PointPair& pair : pairs) middle = middle + share * (pair.p + pair.q);
  Mat3 moment;
  for (const PointPair& pair : pairs) {
    const Vec3 p = pair.p - middle, q = pair.q - middle;
    const double a[3] = {p.x, p.y, p.z}, b[3] = {q.x, q.y, q.z};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) moment(r, c) += 0.5 * (a[r] * b[c] + b[r] * a[c]);
    }
  }
  mesh::MirrorPlane plane;
  plane.normal = column_of(principal_axes(moment).axes, 2);
  settle(plane);
  plane.offset = dot(plane.normal, middle);
  return plane;
}

double mean_miss(const Vector<PointPair>& pairs, const mesh::MirrorPlane& plane) noexcept {
  double sum = 0;
  for (const PointPair& pair : pairs) sum += norm(plane.reflect(pair.p) - pair.q);
  return sum / static_cast<double>(pairs.size());
}

// The surface as a set of points and a tree of its triangles.
class Symmetry {
 public:
  Symmetry(const surface::Core& core, Memory& memory)
      : mesh_(core.mesh), memory_(memory), tree_(core.mesh.positions, core.mesh.corners, memory), sample_(&memory) {
    const std::size_t n = at(core.size()), step = std::max<std::size_t>(1, n / most_mirror_samples);
    for (std::size_t v = 0; v < n; v += step) sample_.push_back(mesh_.positions[v]);
  }
  // The samples with the nearest points of the surface to their reflections. Far ones are left out.
  Vector<PointPair> pairs(const mesh::MirrorPlane& plane, double& score) const {
    Vector<PointPair> out(&memory_);
    score = 0;
    Poller poller(samples_per_poll);
    for (const Vec3& p : sample_) {
      poller.due();
      const Vec3 there = plane.reflect(p);
      const auto found = tree_.find(there);
      double w[3];
      tree_.weights(there, found.triangle, w);
      Vec3 q;
      for (int k = 0; k < 3; ++k) q = q + w[k] * mesh_.positions[at(mesh_.triangle(found.triangle)[k])];
      const double away = norm(q - there);
      score += std::min(away, mirror_outlier) / static_cast<double>(sample_.size());
      if (away < mirror_outlier) out.push_back({p, q});
    }
    return out;
  }
  Vec3 centre() const noexcept {
    Vec3 sum;
    for (const Vec3& p : sample_) sum = sum + (1.0 / static_cast<double>(sample_.size())) * p;
    return sum;
  }
  Mat3 moments(const Vec3& centre) const {
    Mat3 out;
    for (const Vec3& p : sample_) {
      const double a[3] = {p.x - centre.x, p.y - centre.y, p.z - centre.z};
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) out(r, c) += a[r] * a[c];
      }
    }
    return out;
  }

 private:
  const mesh::Mesh& mesh_;
  Memory& memory_;
  const mesh::NearestTriangle tree_;
  Vector<Vec3> sample_;
};

}  // namespace

bool plane_of_bones(const Vector<Vec3>& heads, const Vector<Index>& partner, mesh::MirrorPlane& plane, Memory& memory) {
  Vector<PointPair> pairs(&memory);
  for (std::size_t b = 0; b < heads.size(); ++b) {
    const Index other = partner[b];
    if (other < 0 || at(other) == b || !(norm(heads[b] - heads[at(other)]) > paired_apart)) continue;
    pairs.push_back({heads[b], heads[at(other)]});
  }
  if (pairs.empty()) return false;
  mesh::MirrorPlane found = fit_plane(pairs);
  if (!(mean_miss(pairs, found) <= bones_mirror)) return false;
  found.from = mesh::PlaneFrom::bones;
  plane = found;
  return true;
}

mesh::MirrorPlane plane_of_surface(const surface::Core& core, Memory& memory) {
  const Symmetry shape(core, memory);
  const Vec3 centre = shape.centre();
  Mat3 axes = principal_axes(shape.moments(centre)).axes;
  mesh::MirrorPlane best;
  double best_score = HUGE_VAL;
  for (int candidate = 0; candidate < 6; ++candidate) {
    mesh::MirrorPlane plane;
    if (candidate < 3) {
      // The middle of the box is the origin of the inner frame.
      plane.normal = {candidate == 0 ? 1.0 : 0.0, candidate == 1 ? 1.0 : 0.0, candidate == 2 ? 1.0 : 0.0};
    } else {
      plane.normal = column_of(axes, candidate - 3);
      plane.offset = dot(plane.normal, centre);
      settle(plane);
    }
    double score = 0;
    Vector<PointPair> pairs = shape.pairs(plane, score);
    for (int step = 0; step < mirror_steps && !pairs.empty(); ++step) {
      const mesh::MirrorPlane next = fit_plane(pairs);
      double next_score = 0;
      Vector<PointPair> next_pairs = shape.pairs(next, next_score);
      if (!(next_score < mirror_gain * score)) break;
      plane = next;
      score = next_score;
      pairs = std::move(next_pairs);
    }
    // Candidates of the frame come first, and another must be clearly better.
    if (score < (best_score == HUGE_VAL ? HUGE_VAL : mirror_gain * best_score)) {
      best = plane;
      best_score = score;
    }
  }
  best.from = mesh::PlaneFrom::surface;
  return best;
}

}  // namespace hf_inner::weights
