// Carries whole deformation gradients, with their stretch, from one surface to another (HF_TRANSFER_STRETCH).
//
// This is deformation transfer (Sumner and Popovic 2004) with the correspondence of matches.h. A source vertex has the
// gradient
//     F_a = argmin sum_b w_ab |F (p_a - p_b) - (q_a - q_b)|^2 + e |F n_a - n'_a|^2
// with rest places p, posed places q, and normals n, n' as long as the root of their area. The target minimises
//     sum_edges w_ij |(x'_i - x'_j) - y_ij|^2,     y_ij = A ((F_i + F_j)/2 A' (x_i - x_j) + k_ij r_ij),
//     r_ij = (q_i - q_j) - (F_i + F_j)/2 (p_i - p_j),     k_ij = |x_i - x_j| / |p_i - p_j|,
// a Poisson equation with the factor that the surface has. A takes the source's axes to the target's. The vector r is
// the residual of the source's own edge under one gradient at each end. With it a surface on itself gets its own pose,
// up to rounding. The equation leaves a shift of each component free. The mean of the component follows the scaled path
// of the matched points.
//
// Borders match borders (openings.h). Where two places i, j of the target's border face each other across a narrow
// opening, a soft constraint x'_i - x'_j = y_ij carries the width of the source's opening there. With the gap x of the
// target at rest, the source's gaps p at rest and q now, and the mean gradient F of both places, all in the target's
// axes, the gaps that the gradients alone would give are F x and F p. Then
//     y_ij = min(1, |F p| / |q|) |F x| / |F p| R q + s max(0, 1 - |F p| / |q|) q,
// with the minimal rotation R from F p to F x and the scale s: an opening that closes on the source closes on the
// target, whatever the two widths are; one that opens wider than the gradients say opens by the scaled rest. The parts
// of the gaps across the border are carried by themselves in this way. Where the source has no gap, an opening closes
// as the nearest one does. The constraints enter by their dense Schur complement over the same factor.
//
// A frame costs the gradients, one sweep pair for three channels (two with openings) and no allocation. Results do not
// depend on threads.
#pragma once
#include "deform/dense.h"
#include "surface/core.h"
#include "transfer/matches.h"
#include "transfer/openings.h"
#include "transfer/source_rotations.h"

namespace hf_inner::transfer {

class Gradients {
 public:
  explicit Gradients(Memory& memory)
      : matches_(memory),
        ratio_(&memory),
        inverse_(&memory),
        normal_(&memory),
        now_normal_(&memory),
        gradient_(&memory),
        matched_(&memory),
        blended_(&memory),
        mean_(&memory),
        rest_mean_(&memory),
        centre_(&memory),
        mass_(&memory),
        openings_(&memory),
        open_share_(&memory),
        opening_factor_(memory),
        forces_(&memory) {}

  // target_factor: the core whose operator and factor place the target; target.core may hold another rest pose.
  void prepare(const MatchSide& source, const MatchSide& target, const surface::Core& target_factor,
               Span<const double> target_area, Memory& memory);

  // posed, out: inner vertices in inner units. turn: the rotation of the whole source, in the target's frame.
  struct Frame {
    const surface::Core *source, *target, *factor;
    const Vec3* posed;
    WholeMotion whole;
    deform::Quaternion axes, turn;
    double scale;
    Vec3 target_centroid;
    Span<const double> area;
  };
  void apply(const Frame& frame, Vec3* out);
  std::int32_t opening_count() const noexcept { return static_cast<std::int32_t>(openings_.size()); }

 private:
  // A place as a mean of vertices.
  struct Place {
    std::int32_t vertex[4];
    double share[4];
    std::size_t count = 0;
    void add(std::int32_t vertex, double share) noexcept;
    Vec3 of(const Vec3* points) const noexcept;
    Mat3 of(const Mat3* matrices) const noexcept;
  };
  // Two places of the target's border that face each other, and their matches.
  struct Opening {
    Place target[2], source[2];
    std::int32_t like = -1;  // the source has no gap there: the opening closes as this one does
    Place edge[2];           // matches of the ends of the border edge at the target's far end
  };
  void find_openings(const surface::Core& source, const surface::Core& target, const Border& from, const Border& to,
                     Memory& memory);
  void factorise_openings(const surface::Core& factor, Memory& memory);
  Vec3 opening_goal(Vec3 own, Vec3 still, Vec3 now, double scale, Vec3 axis) const noexcept;
  Vec3 opening_miss(const Opening& opening, const Frame& frame, const Mat3& axes, Vec3 gap, Vec3 along,
                    double& open_share) const noexcept;
  void hold_openings(const Frame& frame, double* z);
  void find_gradients(const Frame& frame);
  Matches matches_;
  Vector<double> ratio_;  // by entry of the operator: k_ij
  Vector<Mat3> inverse_;  // by source vertex: the inverse moment of its edges and normal
  Vector<Vec3> normal_, now_normal_;
  Vector<Mat3> gradient_;                   // by source vertex
  Vector<Vec3> matched_;                    // by target vertex: the posed source point
  Vector<Mat3> blended_;                    // by target vertex: its gradient
  Vector<Vec3> mean_, rest_mean_, centre_;  // by target component: of the matched points now and at rest; of itself
  Vector<double> mass_;
  Vector<Opening> openings_;   // those with a gap on the source come first
  Vector<double> open_share_;  // by opening, of this frame
  deform::DenseFactor opening_factor_;
  Vector<double> forces_;  // four by opening: the force that holds it, and padding
};

}  // namespace hf_inner::transfer
