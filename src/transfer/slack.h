// Carries over where the clusters of the source are joined.
//
// The energies of the target's translations (translations.h) let two clusters meet in the middle of their overlap. The
// source's clusters c and d meet there only if they turn about that point. A bone's joint lies elsewhere. Then they
// slide against each other in their overlap, and every joint of a limb adds to the error at its end. This slide is
// measured on the source in each frame:
//     s_cd = (R_c p_cd + t_c) - (R_d p_cd + t_d).
// R are the rotations of the source's clusters and p_cd is the centroid of the overlap on the source. The translations
// t come as near to the posed source q as they can. They minimise sum_v a_v |sum_c W_vc (R_c p_v + t_c) - q_v|^2. a_v
// is the area of vertex v, W_vc its weight in cluster c. On the source, weights follow from the fields as on the
// target. The target's energies then ask for the slide k_cd s_cd instead of none. E_spread ties the clusters at another
// point than E_overlap, and gets the slide of that point. On a coarse mesh edges also tie clusters that have no vertex
// in common. These slide too, as far as E_spread ties them alike on both bodies.
//
// The factor k_cd is the scale where both bodies are alike around the overlap, as on a body that plays its own motion.
// It is smaller where the overlaps are not alike: by their share of the clusters, by the distance of the clusters, and
// by the direction from one to the other. The product of these likenesses counts squared: slides of parts that do not
// correspond open kinks, and pieces of the target.
//
// A slide is at most limit_cd = m |R_c - R_d| d_cd, softly, with the distance d_cd of the clusters: turns about another
// point explain no more. So a rigid motion has no slide, and a source that is only stretched has none.
//
// A frame costs one C x C solve with a constant factor (C clusters), and reads each source vertex four times. It
// allocates nothing and depends on no other frame.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/span.h"
#include "deform/dense.h"
#include "deform/rotation.h"
#include "surface/core.h"
#include "transfer/clusters.h"
#include "transfer/overlaps.h"
#include "transfer/translations.h"

namespace hf_inner::transfer {

class Slack {
 public:
  explicit Slack(Memory& memory)
      : pairs_(&memory),
        slide_(&memory),
        force_(&memory),
        start_(&memory),
        vertex_(&memory),
        weight_(&memory),
        factor_(memory),
        table_start_(&memory),
        table_column_(&memory),
        table_(&memory),
        table_mass_(&memory),
        own_(&memory),
        centroid_(&memory),
        near_(&memory),
        matrix_(&memory),
        scratch_(&memory) {}

  // Two clusters that overlap, or that edges tie, on the source and on the target, first < second.
  struct Pair {
    std::int32_t first = 0, second = 0;
    Vec3 overlap_point, spread_point;                  // where the energies tie them, on the source
    double overlap_coupling = 0, spread_coupling = 0;  // how strongly, on the target
    double reach = 0;                                  // d: distance of the clusters on the source
    double factor = 0;                                 // k
  };
  using Side = WeightedSurface;

  // from, to: of the clusters on the source and on the target. axes: from the source's axes to the target's. scale:
  // lengths of the target over lengths of the source.
  void prepare(const Side& source, const Overlaps& from, const Overlaps& to, const Translations& translations,
               const Mat3& axes, double scale, Memory& memory);
  // Without slides, all forces are zero.
  void prepare_none(std::int32_t cluster_count) { force_.assign(static_cast<std::size_t>(cluster_count), Vec3()); }

  // Measures the slides of a frame. rotations: of the source's clusters, in the source's axes.
  void measure(const deform::Quaternion* rotations, const Vec3* posed, const deform::Quaternion& axes, JobRunner& jobs);

  Span<const Pair> pairs() const noexcept { return {pairs_.data(), pairs_.size()}; }
  // One for each pair: how far the first cluster shall lie from the second one in their overlap, in the target's axes.
  const Vec3* slides() const noexcept { return slide_.data(); }
  // One for each cluster: the term of the slides in the right-hand side of the energies.
  const Vec3* forces() const noexcept { return force_.data(); }

 private:
  void prepare_fit(std::size_t count, const Side& source, Span<const double> mass, const Vec3* sum, Memory& memory);

  Vector<Pair> pairs_;
  Vector<Vec3> slide_, force_;
  // By cluster: its source vertices, with area times weight.
  Vector<std::int32_t> start_, vertex_;
  Vector<double> weight_;
  deform::DenseFactor factor_;
  // By cluster: the overlapping clusters, the vectors sum_v a_v W_vc W_vd p_v, and the same sums without p_v.
  Vector<std::int32_t> table_start_, table_column_;
  Vector<Vec3> table_;
  Vector<double> table_mass_;
  // By cluster: area on the source and centroid at rest. near_: the translation that takes the centroid where the
  // cluster's vertices are in the mean; the fit starts there.
  Vector<double> own_;
  Vector<Vec3> centroid_, near_;
  Vector<Mat3> matrix_;
  Vector<double> scratch_;  // right-hand side and translations, four numbers for each cluster
};

}  // namespace hf_inner::transfer
