// A body as the smooth union of tapered capsules and ellipsoids, cut flat at the ground.
//
// Each blob has a signed distance estimate d_i (exact for round capsules, scaled by the thinnest direction for
// flattened ones). The field is folded in the order of the blobs with the cubic smooth minimum
//   smin(a, b, k) = min(a, b) - h^3 k / 6,  h = max(k - |a - b|, 0) / k      (Quilez, "smooth minimum"; C2)
// so a blob acts only where its distance comes within about k of the field: evaluation looks at the blobs near the
// point, kept in a coarse grid. Cost of value(): O(blobs near the point). finish() refuses more than 256
// blobs; nothing can fail after it.
#ifndef HF_SAMPLES_ASSETS_IMPLICIT_H
#define HF_SAMPLES_ASSETS_IMPLICIT_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace samples {

using glm::dmat3;
using glm::dvec3;

struct Blob {
  dvec3 a{0}, b{0};  // axis; equal for an ellipsoid
  double radius_a = 1, radius_b = 1;
  dmat3 to_local{1.0};  // scales the flattened directions up, so that the section becomes round
  double thinnest = 1;  // smallest scale of the section, <= 1
  double blend = 0.05;  // k of the smooth minimum
  uint32_t joint = 0;   // the joint whose bone this flesh follows
  double detail = 1;    // wanted edge length relative to the body's

  // What distance() needs and the point does not change; call after the last change of the fields above.
  void prepare();
  double distance(const dvec3& p) const;
  double distance(const dvec3& p, dvec3& gradient) const;
  double log_detail() const { return log_detail_; }

 private:
  // A round section is not scaled: the product with the identity would give the same bits.
  dvec3 local(const dvec3& offset) const { return round_ ? offset : to_local * offset; }
  double nearest_sphere(const dvec3& pa) const;

  dvec3 ba_{0};             // the axis in local space
  double length_ = 0;       // of it; 0 where one sphere holds the other
  double slope_ = 0;        // of the cone: offset along the axis for distance across it
  double only_sphere_ = 0;  // t of the larger sphere
  double log_detail_ = 0;   // logarithm of detail
  bool round_ = true;       // to_local is the identity
};

// A tapered capsule from a to b. `side` is the direction whose half width is `flatten` times the radius (not parallel
// to the axis matters not: it is made orthogonal); `flatten` may exceed 1.
Blob capsule(const dvec3& a, const dvec3& b, double radius_a, double radius_b, double blend, double flatten = 1,
             const dvec3& side = {1, 0, 0});

// An ellipsoid with half axes radii.x along `side`, radii.z along `axis` (both made orthogonal) and radii.y across.
Blob ellipsoid(const dvec3& centre, const dvec3& radii, double blend, const dvec3& axis = {0, 0, 1},
               const dvec3& side = {1, 0, 0});

class ImplicitBody {
 public:
  std::vector<Blob> blobs;
  bool cut_at_ground = false;  // keep y >= 0 only, with a rounded edge
  double ground_edge = 0.012;  // its rounding

  // Builds the grid of nearby blobs; call after the last change of blobs.
  void finish();

  double value(const dvec3& p) const;
  // The same with its exact gradient, which is not normalised.
  double value(const dvec3& p, dvec3& gradient) const;
  dvec3 gradient(const dvec3& p) const;
  // Newton steps along the gradient onto the zero set.
  dvec3 project(dvec3 p, int steps) const;
  // Wanted edge length relative to the body's, a smooth mean over the blobs near p.
  double detail(const dvec3& p) const;
  // Joint of the blob nearest to p.
  uint32_t nearest_joint(const dvec3& p) const;

  dvec3 lower{0}, upper{0};  // box around the body with a small border, set by finish()

 private:
  struct Range {
    uint32_t begin = 0, end = 0;
  };
  Range near(const dvec3& p) const;
  template <typename Tell>
  double value(const dvec3& p, Tell tell) const;
  template <typename Visit>
  void for_each_near(const dvec3& p, Visit visit) const;

  double cell_ = 0.1;
  glm::ivec3 cells_{0};
  std::vector<Range> ranges_;      // per grid cell
  std::vector<uint32_t> entries_;  // blob indices, ascending per cell
};

}  // namespace samples

#endif
