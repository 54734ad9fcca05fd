// Places the clusters of the target when their rotations are given.
//
// The posed target is v' = Y_v + sum_c W_vc t_c, with Y_v = sum_c W_vc R_c x_v. The C translations t minimise
//     E_overlap / tr + a E_spread / tr + sum_k l |row_k - y_k|^2 + r |centroid - g|^2
//         + e sum_c |R_c x_c + t_c - g_c|^2.
// E_overlap is the shape matching of overlapping clusters (Xu et al. 2009), E_spread a reduced Poisson energy:
//     E_overlap = 1/2 sum_v a_v sum_cd W_vc W_vd |R_c x_v + t_c - R_d x_v - t_d|^2,
//     E_spread  = sum_edges w_ij |(v'_i - v'_j) - (B_i + B_j)/2 (x_i - x_j)|^2,     B_v = sum_c W_vc R_c.
// Rows k are anchored regions, and the centroid is the root. The last term keeps clusters that overlap nothing near the
// motion of the whole.
//
// The right-hand side of both energies is linear in the rotations, rhs_c = sum_d R_d g_cd. For E_overlap, with row sums
// subtracted, and for E_spread, whose blended gradients combine to the midpoint of an edge:
//     g_cd = sum_v a_v W_vc W_vd x_v,     g_cd = - sum_edges w_ij (W_ic - W_jc)(W_id - W_jd) (x_i + x_j)/2.
// So a frame costs one C x C triangular solve and a product with a sparse table; no vertex is read. The matrix is
// constant and factored once. A rigid motion of everything minimises every term, and is returned to rounding.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "deform/dense.h"
#include "deform/rotation.h"
#include "engine/core.h"
#include "transfer/clusters.h"

namespace hf_inner {

struct TranslationOptions {
  double spread_share = default_spread_share;  // a
  double anchor = default_anchor_pull;         // l, relative to the mean diagonal of the energies
  double root = root_alone;                    // r, likewise
  double whole = default_whole_pull;           // e, likewise
};

// A region whose mean goes to a place whatever the energies say, wholly (share 1) or in part; vertical: only along up.
struct Hold {
  std::size_t row = 0;
  Vec3 goal;
  double share = 1;
  bool vertical = false;
};

class Translations {
 public:
  explicit Translations(Memory& memory)
      : factor_(memory),
        scratch_(&memory),
        table_start_(&memory),
        table_column_(&memory),
        table_(&memory),
        row_start_(&memory),
        row_column_(&memory),
        row_weight_(&memory),
        row_point_(&memory),
        influence_(&memory),
        gram_(&memory),
        hold_matrix_(&memory),
        hold_rhs_(&memory) {}

  // regions: vertices of each anchored region of the target; loose: of regions that only holds move. Rows are numbered
  // anchored regions first, then loose ones from regions.size() + 1 on (the root lies between).
  void prepare(const Core& target, Span<const double> area, const Clusters& clusters,
               Span<const Span<const std::int32_t>> regions, Span<const Span<const std::int32_t>> loose,
               const TranslationOptions& options);

  // goals: one per anchored region; centroid: of the whole; cluster_goals: one per cluster (x_c under the motion of the
  // whole). out: t_c, one per cluster. Allocates nothing; not for two threads at once.
  void solve(const Clusters& clusters, const Mat3* rotations, Span<const Vec3> goals, Vec3 centroid,
             const Vec3* cluster_goals, Vec3* out) noexcept;

  // Moves the solution so that the holds are met and the energies rise least (Woodbury): t += A^-1 R^T m with
  // (R A^-1 R^T + diag(s_k (1 - share) / share)) m = goal - place.
  // R holds the rows held, s is the diagonal. At most one hold per row. Allocates nothing.
  void hold(Span<const Hold> holds, Vec3 up, const Mat3* rotations, Vec3* shifts) noexcept;
  // Rows of single vertices, vertex_row(i) for i = first .. first + vertices.size() - 1 < vertex_rows, to be held like
  // regions: O(C^2) for four of them. Those before `first` stay, those after are void. Allocates nothing.
  std::size_t vertex_row(std::size_t i) const noexcept { return region_rows_ + i; }
  void set_vertex_rows(std::size_t first, Span<const std::int32_t> vertices, const Core& target,
                       const Clusters& clusters) noexcept;
  // The cluster of largest weight in a row.
  std::int32_t heaviest(std::size_t row) const noexcept;
  double row_weight(std::size_t row, std::int32_t cluster) const noexcept;
  // Where the mean of a row's region is now.
  Vec3 place(std::size_t row, const Mat3* rotations, const Vec3* shifts) const noexcept;

  // Mean of the region's rest points under the blend of `rotations` alone: sum_c R_c y_kc.
  Vec3 turned(std::size_t anchor, const Mat3* rotations) const noexcept;
  // Blend of the rotations over the region.
  Mat3 mean_rotation(std::size_t anchor, const Mat3* rotations) const noexcept;

 private:
  void add_overlap(Span<const double> area, const Core& target, const Clusters& clusters, Buffer<double>& matrix,
                   Vector<double>& table) const;
  void add_spread(const Core& target, const Clusters& clusters, double share, Buffer<double>& matrix,
                  Vector<double>& table) const;
  void add_row(Span<const std::int32_t> vertices, Span<const double> weights, const Core& target,
               const Clusters& clusters);

  void add_influences();
  // A^-1 of the rows first .. last - 1, and their columns and rows of the Gram matrix against all before `last`.
  void fill_influences(std::size_t first, std::size_t last) noexcept;
  // m of the held rows, `dimensions` numbers each in hold_rhs_; vertical holds take part when they are wanted.
  void solve_holds(Span<const Hold> holds, bool with_vertical) noexcept;

  std::int32_t count_ = 0;
  std::size_t anchored_ = 0, region_rows_ = 0;
  double anchor_ = 0, root_ = 0, whole_ = 0;
  DenseFactor factor_;
  Vector<double> scratch_;  // right-hand side and solution, four numbers per cluster
  Vector<std::int32_t> table_start_, table_column_;
  Vector<Vec3> table_;
  // anchored regions, the root last: sparse rows over clusters
  Vector<std::int32_t> row_start_, row_column_;
  Vector<double> row_weight_;
  Vector<Vec3> row_point_;
  // A^-1 of every row (rows x clusters), R A^-1 R^T, and scratch of the holds; the last vertex_rows rows are those of
  // set_vertex_rows
  Vector<double> influence_, gram_, hold_matrix_;
  Vector<Vec3> hold_rhs_;
};

}  // namespace hf_inner
