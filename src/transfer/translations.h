// Places the clusters of the target when their rotations are given.
//
// Vertex v has rest position x_v and the weights W_vc. Cluster c has the rotation R_c and the unknown translation t_c.
// The posed vertex is v' = sum_c W_vc (R_c x_v + t_c). The translations t minimise
//     E_overlap / tr + a E_spread / tr + sum_k l |row_k - y_k|^2 + r |centroid - g|^2
//         + e sum_c |R_c x_c + t_c - g_c|^2.
// E_overlap is the shape matching of overlapping clusters (Xu et al. 2009), E_spread a reduced Poisson energy:
//     E_overlap = 1/2 sum_v a_v sum_cd W_vc W_vd |R_c x_v + t_c - R_d x_v - t_d|^2,
//     E_spread  = sum_edges w_ij |(v'_i - v'_j) - (B_i + B_j)/2 (x_i - x_j)|^2,     B_v = sum_c W_vc R_c.
// Row k is the mean of anchored region k, with goal y_k. The centroid of the whole body (called the root) has the goal
// g. The last term keeps clusters without overlap near the motion of the whole body.
//
// The right-hand side of both energies is linear in the rotations: rhs_c = sum_d R_d g_cd. The first formula below
// belongs to E_overlap and leaves out its row sums. The second belongs to E_spread, whose blended gradients combine to
// the midpoint of an edge:
//     g_cd = sum_v a_v W_vc W_vd x_v,     g_cd = - sum_edges w_ij (W_ic - W_jc)(W_id - W_jd) (x_i + x_j)/2.
// So a frame costs one C x C triangular solve (C clusters) and a product with a sparse table. It reads no vertex. The
// matrix is constant and factored once. A rigid motion of the whole body minimises every term, so the solution is that
// motion, up to rounding.
#pragma once
#include <cstdint>

#include "base/index.h"
#include "base/span.h"
#include "deform/dense.h"
#include "deform/rotation.h"
#include "surface/core.h"
#include "transfer/clusters.h"

namespace hf_inner::transfer {

struct TranslationOptions {
  double spread_share = default_spread_share;  // a: weight of E_spread beside E_overlap
  // L: weight of each region's goal, as a share of the energies' mean diagonal.
  double anchor = default_anchor_pull;
  double root = root_alone;           // r: weight of the centroid's goal, as a share of the same mean
  double whole = default_whole_pull;  // e: weight of the motion of the whole body, of the same mean
};

// A constraint that moves the mean of a region to a goal, against the energies. A share of 1 meets the goal exactly, a
// smaller share in part. vertical: it constrains only the up direction.
struct Hold {
  std::size_t row = 0;
  Vec3 goal;
  double share = 1;
  bool vertical = false;
};

// E_spread of one surface with weights W, scaled to trace 1: the matrix, its table of vectors g (three numbers each),
// and the sum of the sizes of the terms of each entry. All are clusters x clusters.
struct SpreadTies {
  SpreadTies(std::size_t count, Memory& memory)
      : matrix(count * count, 0.0, &memory),
        size(count * count, 0.0, &memory),
        table(3 * count * count, 0.0, &memory) {}
  Vector<double> matrix, size, table;
};
// joint, weight: blend_count for each vertex of the surface.
SpreadTies spread_ties(const surface::Core& core, const std::int32_t* joint, const float* weight, std::size_t count,
                       Memory& memory);

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
        overlap_coupling_(&memory),
        spread_coupling_(&memory),
        influence_(&memory),
        compliance_(&memory),
        gram_(&memory),
        hold_matrix_(&memory),
        hold_rhs_(&memory) {}

  // Builds and factors the matrix. regions: vertices of each target region that follows its source (anchored). loose:
  // vertices of the other regions, which only constraints (holds) move. Rows number the anchored regions first, then
  // the root, then the loose regions from regions.size() + 1.
  void prepare(const surface::Core& target, Span<const double> area, const Clusters& clusters,
               Span<const Span<const std::int32_t>> regions, Span<const Span<const std::int32_t>> loose,
               const TranslationOptions& options);

  // Computes the translation of every cluster. The array goals: one per anchored region. centroid: goal of the whole
  // body. The array cluster_goals: one per cluster, its rest centroid under the motion of the whole body. Allocates
  // nothing. Two threads must not call it at once.
  void solve(const Clusters& clusters, const Mat3* rotations, Span<const Vec3> goals, Vec3 centroid,
             const Vec3* cluster_goals, const Vec3* forces, Vec3* out) noexcept;

  // How strongly each energy ties two different clusters.
  double overlap_coupling(std::size_t c, std::size_t d) const noexcept { return overlap_coupling_[c * at(count_) + d]; }
  double spread_coupling(std::size_t c, std::size_t d) const noexcept { return spread_coupling_[c * at(count_) + d]; }

  // The same for E_spread of trace 1.
  double spread_tie(std::size_t c, std::size_t d) const noexcept { return spread_coupling(c, d) / spread_share_; }

  // Changes the translations t so that the constraints (holds) are met and the energies rise least (Woodbury formula):
  //     t += A^-1 R^T m,     (R A^-1 R^T + diag(s_k (1 - share) / share)) m = goal - place.
  // A is the matrix of the energies. R holds the rows of the held regions, s the diagonal of R A^-1 R^T. A row
  // may have one hold at most. Allocates nothing.
  void hold(Span<const Hold> holds, Vec3 up, const Mat3* rotations, Vec3* shifts) noexcept;
  // How far each cluster moves for a unit force on another: the inverse of the energies' matrix, clusters x clusters.
  const double* compliance() const noexcept { return compliance_.data(); }
  // How far each cluster moves for a unit force on a row, and how far the row itself does.
  const double* influence(std::size_t row) const noexcept { return influence_.data() + row * at(count_); }
  double give(std::size_t row) const noexcept { return gram_[row * (row_start_.size() - 1) + row]; }
  // Returns the mean of numbers per cluster over a row's region.
  double mean(std::size_t row, const double* numbers) const noexcept;
  // Returns the cluster with the largest weight in a row.
  std::int32_t heaviest(std::size_t row) const noexcept;
  double row_weight(std::size_t row, std::int32_t cluster) const noexcept;
  // Returns the present mean of a row's region.
  Vec3 place(std::size_t row, const Mat3* rotations, const Vec3* shifts) const noexcept;

  // Returns the mean of the region's rest points after the rotations alone, without translations.
  Vec3 turned(std::size_t anchor, const Mat3* rotations) const noexcept;
  // Returns the mean of the cluster rotations over the region.
  Mat3 mean_rotation(std::size_t anchor, const Mat3* rotations) const noexcept;

 private:
  void add_overlap(Span<const double> area, const surface::Core& target, const Clusters& clusters,
                   Buffer<double>& matrix, Vector<double>& table) const;
  void add_row(Span<const std::int32_t> vertices, Span<const double> weights, const surface::Core& target,
               const Clusters& clusters);

  void add_influences();
  // Finds how a constraint on each of the rows first .. last - 1 moves all clusters: A^-1 R^T. A
  // is the matrix of the energies, R the rows. Also fills R A^-1 R^T, how it moves these rows and all rows before
  // `last`.
  void fill_influences(std::size_t first, std::size_t last) noexcept;
  // Finds how strongly each constraint (hold) must pull, one vector (Lagrange multiplier) each, in hold_rhs_.
  // with_vertical: constraints along the up direction count too.
  void solve_holds(Span<const Hold> holds, bool with_vertical) noexcept;

  std::int32_t count_ = 0;
  std::size_t anchored_ = 0, region_rows_ = 0;
  double anchor_ = 0, root_ = 0, whole_ = 0, spread_share_ = 1;
  deform::DenseFactor factor_;
  Vector<double> scratch_;  // right-hand side and solution, four numbers per cluster
  Vector<std::int32_t> table_start_, table_column_;
  Vector<Vec3> table_;
  // These arrays hold points as sparse rows of cluster weights. The regions that follow their source come first, then
  // the whole body (root), and the other regions.
  Vector<std::int32_t> row_start_, row_column_;
  Vector<double> row_weight_;
  Vector<Vec3> row_point_;
  Vector<double> overlap_coupling_, spread_coupling_;
  // influence_: A^-1 R^T, rows x clusters, with A the matrix of the energies and R the rows. gram_: R A^-1 R^T.
  // hold_matrix_: scratch of the constraints (holds).
  Vector<double> influence_, compliance_, gram_, hold_matrix_;
  Vector<Vec3> hold_rhs_;
};

}  // namespace hf_inner::transfer
