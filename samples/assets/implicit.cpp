// Smooth union of blobs; see implicit.h for the equation.
#include "implicit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samples {
namespace {

// A creature has up to 70 blobs; detail() keeps a distance for each on the stack.
constexpr size_t most_blobs = 256;

// Folds b into a with the smooth minimum; a's gradient becomes the gradient of the result. Most blobs are farther apart
// than k: there the lesser one stays as it is.
void fold_min(double& a, dvec3& gradient_a, double b, const dvec3& gradient_b, double k) {
  if (std::abs(a - b) >= k) {
    if (b <= a) {
      a = b;
      gradient_a = gradient_b;
    }
    return;
  }
  const double h = (k - std::abs(a - b)) / k, share = 0.5 * h * h;
  const double of_b = a < b ? share : 1 - share;
  gradient_a = (1 - of_b) * gradient_a + of_b * gradient_b;
  a = std::min(a, b) - h * h * h * k * (1.0 / 6.0);
}

double smooth_min(double a, double b, double k) {
  if (std::abs(a - b) >= k) return std::min(a, b);
  const double h = (k - std::abs(a - b)) / k;
  return std::min(a, b) - h * h * h * k * (1.0 / 6.0);
}

dvec3 orthogonal_to(const dvec3& axis, const dvec3& wanted) {
  dvec3 side = wanted - dot(wanted, axis) * axis;
  if (dot(side, side) < 1e-12) side = cross(axis, std::abs(axis.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 1, 0));
  return normalize(side);
}

// The linear map that stretches direction u by factor s and leaves its complement.
dmat3 stretch(const dvec3& u, double s) { return dmat3(1.0) + (s - 1) * outerProduct(u, u); }

}  // namespace

void Blob::prepare() {
  ba_ = to_local * (b - a);
  const double length2 = dot(ba_, ba_), difference = radius_a - radius_b;
  const bool one_holds_the_other = length2 <= difference * difference + 1e-24;
  only_sphere_ = radius_a >= radius_b ? 0 : 1;
  length_ = one_holds_the_other ? 0 : std::sqrt(length2);
  slope_ = one_holds_the_other ? 0 : difference / std::sqrt(length2 - difference * difference);
  round_ = to_local == dmat3(1.0);
  log_detail_ = std::log(detail);
}

// Where on the axis the sphere sits that is nearest to a point: t in 0..1, in the blob's local space. For a tapered
// capsule |p - c(t)| - r(t) is least where the offset along the axis is the distance across it times the cone's slope.
double Blob::nearest_sphere(const dvec3& pa) const {
  if (length_ == 0) return only_sphere_;
  const double along = dot(pa, ba_) / length_;
  const double across = std::sqrt(std::max(dot(pa, pa) - along * along, 0.0));
  return std::clamp((along - across * slope_) / length_, 0.0, 1.0);
}

double Blob::distance(const dvec3& p) const {
  const dvec3 pa = local(p - a);
  const double t = nearest_sphere(pa);
  return (length(pa - t * ba_) - (radius_a + t * (radius_b - radius_a))) * thinnest;
}

double Blob::distance(const dvec3& p, dvec3& gradient) const {
  const dvec3 pa = local(p - a);
  const double t = nearest_sphere(pa);
  const dvec3 off = pa - t * ba_;
  const double size = length(off);
  // t minimises the distance, so its own change does not count
  gradient = size > 0 ? thinnest / size * (round_ ? off : transpose(to_local) * off) : dvec3(0, thinnest, 0);
  return (size - (radius_a + t * (radius_b - radius_a))) * thinnest;
}

Blob capsule(const dvec3& a, const dvec3& b, double radius_a, double radius_b, double blend, double flatten,
             const dvec3& side) {
  Blob blob;
  blob.a = a;
  blob.b = b;
  blob.radius_a = radius_a;
  blob.radius_b = radius_b;
  blob.blend = blend;
  if (flatten != 1) {
    const dvec3 axis = length(b - a) > 0 ? normalize(b - a) : dvec3(0, 0, 1);
    blob.to_local = stretch(orthogonal_to(axis, side), 1 / flatten);
    blob.thinnest = std::min(1.0, flatten);
  }
  return blob;
}

Blob ellipsoid(const dvec3& centre, const dvec3& radii, double blend, const dvec3& axis, const dvec3& side) {
  Blob blob;
  blob.a = blob.b = centre;
  const double largest = std::max({radii.x, radii.y, radii.z});
  const dvec3 along = normalize(axis), lateral = orthogonal_to(along, side), across = cross(along, lateral);
  blob.radius_a = blob.radius_b = largest;
  blob.to_local =
      stretch(lateral, largest / radii.x) * stretch(across, largest / radii.y) * stretch(along, largest / radii.z);
  blob.thinnest = std::min({radii.x, radii.y, radii.z}) / largest;
  blob.blend = blend;
  return blob;
}

void ImplicitBody::finish() {
  if (blobs.size() > most_blobs) throw std::runtime_error("the body has more than 256 blobs");
  lower = dvec3(1e300);
  upper = dvec3(-1e300);
  for (Blob& blob : blobs) {
    blob.prepare();
    // a flattened direction may also be widened: bound by the inverse map's stretch
    const dmat3 back = inverse(blob.to_local);
    const double wide = std::max({length(back[0]), length(back[1]), length(back[2]), 1.0});
    lower = min(lower, min(blob.a - wide * blob.radius_a, blob.b - wide * blob.radius_b));
    upper = max(upper, max(blob.a + wide * blob.radius_a, blob.b + wide * blob.radius_b));
  }
  if (cut_at_ground) lower.y = std::max(lower.y, 0.0);
  const double border = 0.03 * length(upper - lower);
  lower -= border;
  upper += border;
  cell_ = length(upper - lower) / 72;
  cells_ = glm::ivec3(ceil((upper - lower) / cell_)) + 1;
  ranges_.assign(size_t(cells_.x) * size_t(cells_.y) * size_t(cells_.z), {});
  entries_.clear();
  std::vector<double> distances(blobs.size());
  const double half = 0.5 * std::sqrt(3.0) * cell_;
  for (int z = 0; z < cells_.z; ++z) {
    for (int y = 0; y < cells_.y; ++y) {
      for (int x = 0; x < cells_.x; ++x) {
        const dvec3 centre = lower + cell_ * (dvec3(x, y, z) + 0.5);
        double nearest = 1e300;
        for (size_t i = 0; i < blobs.size(); ++i) {
          // distances change by at most `half` inside the cell (the estimates have gradient <= 1)
          distances[i] = blobs[i].distance(centre);
          nearest = std::min(nearest, distances[i]);
        }
        Range& range = ranges_[(size_t(z) * size_t(cells_.y) + size_t(y)) * size_t(cells_.x) + size_t(x)];
        range.begin = static_cast<uint32_t>(entries_.size());
        // a blob acts where it comes within k of the field, k its own or that of a later blob that acts here
        double reach = 0;
        for (size_t i = blobs.size(); i-- > 0;) {
          if (distances[i] - nearest <= 2 * half + blobs[i].blend) reach = std::max(reach, blobs[i].blend);
        }
        for (size_t i = 0; i < blobs.size(); ++i) {
          if (distances[i] - nearest <= 2 * half + 1.2 * reach) entries_.push_back(static_cast<uint32_t>(i));
        }
        range.end = static_cast<uint32_t>(entries_.size());
      }
    }
  }
}

ImplicitBody::Range ImplicitBody::near(const dvec3& p) const {
  const glm::ivec3 cell = clamp(glm::ivec3(floor((p - lower) / cell_)), glm::ivec3(0), cells_ - 1);
  return ranges_[(size_t(cell.z) * size_t(cells_.y) + size_t(cell.y)) * size_t(cells_.x) + size_t(cell.x)];
}

template <typename Visit>
void ImplicitBody::for_each_near(const dvec3& p, Visit visit) const {
  const Range range = near(p);
  for (uint32_t i = range.begin; i < range.end; ++i) visit(blobs[entries_[i]]);
}

// tell(DISTANCE) is called for each blob near p.
template <typename Tell>
double ImplicitBody::value(const dvec3& p, Tell tell) const {
  double field = 1e3;
  for_each_near(p, [&](const Blob& blob) {
    const double distance = blob.distance(p);
    tell(distance);
    field = smooth_min(field, distance, blob.blend);
  });
  if (cut_at_ground) field = -smooth_min(-field, p.y, ground_edge);
  return field;
}

double ImplicitBody::value(const dvec3& p) const {
  return value(p, [](double) {});
}

double ImplicitBody::value(const dvec3& p, dvec3& gradient) const {
  double field = 1e3;
  gradient = dvec3(0);
  for_each_near(p, [&](const Blob& blob) {
    dvec3 own;
    const double d = blob.distance(p, own);
    fold_min(field, gradient, d, own, blob.blend);
  });
  if (cut_at_ground) {
    field = -field;
    gradient = -gradient;
    fold_min(field, gradient, p.y, dvec3(0, 1, 0), ground_edge);
    field = -field;
    gradient = -gradient;
  }
  return field;
}

dvec3 ImplicitBody::gradient(const dvec3& p) const {
  dvec3 result;
  value(p, result);
  return result;
}

dvec3 ImplicitBody::project(dvec3 p, int steps) const {
  for (int i = 0; i < steps; ++i) {
    dvec3 g;
    const double field = value(p, g), g2 = dot(g, g);
    if (!(g2 > 1e-6)) break;
    dvec3 step = -field / g2 * g;
    const double longest = 0.5 * cell_, size = length(step);
    if (size > longest) step *= longest / size;
    p += step;
  }
  return p;
}

double ImplicitBody::detail(const dvec3& p) const {
  double sum = 0, weight = 0;
  double distances[most_blobs];
  double* next = distances;
  const double nearest = value(p, [&](double distance) { *next++ = distance; }), reach = 0.45 * cell_;
  const double* distance = distances;
  for_each_near(p, [&](const Blob& blob) {
    const double w = std::exp(-std::max(0.0, *distance++ - nearest) / reach);
    sum += w * blob.log_detail();
    weight += w;
  });
  return weight > 0 ? std::exp(sum / weight) : 1.0;
}

uint32_t ImplicitBody::nearest_joint(const dvec3& p) const {
  double nearest = 1e300;
  uint32_t joint = 0;
  for_each_near(p, [&](const Blob& blob) {
    const double d = blob.distance(p);
    if (d < nearest) {
      nearest = d;
      joint = blob.joint;
    }
  });
  return joint;
}

}  // namespace samples
