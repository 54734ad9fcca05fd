#include "mesh/face_correction.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/progress.h"
#include "mesh/laplacian.h"
#include "mesh/polygon_laplacian.h"

namespace hf_inner::mesh {
namespace {

// The largest part of the polygon Laplacian. On squares its hourglass energy is 1/2 of the cut's, and 2/3 cancels the
// error of fourth order (docs/surfaces.md). Half of it leaves half of that error; 5/6 gives a quarter of it
// with the other sign.
constexpr double largest_part = 2.0 / 3.0;
// Larger faces are not corrected: their corners would form a dense block. 8 corners have 28 pairs, of which a cut joins
// 13. Half would correct quads alone: jittered hexagons then have an error of 328e-6 instead of 193e-6
// (docs/surfaces.md). The double gives 120 pairs for 29.
constexpr std::size_t most_corrected = 8;
// Rounds in which faces share the rest of the weights equally. More rounds pass over the faces more often, and place
// the weights that a neighbour with a lower limit could not. On the 12 sheets of quads of docs/surfaces.md one round
// has errors up to 0.4 % larger, two rounds up to 0.08 %. Six and twelve rounds change no error by more than 0.02 %.
constexpr int share_rounds = 3;
// Faces or rows that one thread's job takes; the figures of polygon_laplacian.cpp hold.
constexpr std::size_t correction_piece = 8192;

template <class Work>
void in_pieces_of(JobRunner* jobs, std::size_t count, Work&& work) {
  for_each(jobs, static_cast<std::uint32_t>((count + correction_piece - 1) / correction_piece), [&](std::uint32_t p) {
    work(p * correction_piece, std::min(count, (p + std::size_t{1}) * correction_piece));
  });
}

// The pairs of corners of a face of n: 01 02 .. 0(n-1) 12 ...
std::size_t pair_count(std::size_t n) noexcept { return n * (n - 1) / 2; }

// Holds the gain of every pair of corners of a face: how a part of 1 changes the weight between them.
class Gains {
 public:
  Gains(const Mesh& mesh, Memory& memory, JobRunner* jobs)
      : mesh_(mesh), start_(at(mesh.faces.count()) + 1, 0, &memory), gain_(&memory) {
    Vector<Index> scratch(&memory);
    for (Index f = 0; f < mesh.faces.count(); ++f) {
      const Span<const Index> corner = mesh.faces.corners_of(f);
      const bool wanted = corner.size() <= most_corrected && is_connected(corner, scratch);
      start_[at(f) + 1] = start_[at(f)] + (wanted ? pair_count(corner.size()) : 0);
    }
    gain_.resize(start_.back());
    in_pieces_of(jobs, start_.size() - 1, [&](std::size_t begin, std::size_t end) {
      PolygonMatrix polygon(memory);
      Vector<Vec3> point(&memory);
      for (std::size_t f = begin; f < end; ++f) {
        if (start_[f + 1] > start_[f]) measure(static_cast<Index>(f), polygon, point);
      }
    });
  }
  bool has(Index face) const noexcept { return start_[at(face) + 1] > start_[at(face)]; }
  std::size_t first(Index face) const noexcept { return start_[at(face)]; }
  std::size_t end(Index face) const noexcept { return start_[at(face) + 1]; }
  std::size_t size() const noexcept { return gain_.size(); }
  double operator[](std::size_t pair) const noexcept { return gain_[pair]; }

 private:
  void measure(Index face, PolygonMatrix& polygon, Vector<Vec3>& point) {
    const Span<const Index> corner = mesh_.faces.corners_of(face);
    const std::size_t n = corner.size();
    double* const gain = gain_.data() + start_[at(face)];
    point.clear();
    for (const Index v : corner) point.push_back(mesh_.positions[at(v)]);
    polygon.make(point);
    std::fill_n(gain, pair_count(n), 0.0);
    if (!polygon.is_star) return;
    if (n == 4)
      subtract_quad(face, point, gain);
    else
      subtract_cut(face, gain);
    double* to = gain;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) *to++ -= polygon.value[i * n + j];
    }
  }
  void subtract_quad(Index face, const Vector<Vec3>& point, double* gain) const noexcept {
    const Span<const Index> corner = mesh_.faces.corners_of(face);
    const Index* const v = mesh_.triangle(mesh_.faces.triangle_start[at(face)]);
    std::size_t apart = 0;  // the first triangle lacks this corner: the diagonal joins its neighbours
    while (std::find(v, v + 3, corner[apart]) != v + 3) ++apart;
    const bool both = mesh_.faces.second_cut[at(face)] != 0;
    for (std::size_t turn = 0; turn < 2; ++turn) {
      const bool is_cut = turn != apart % 2;  // turn 0 cuts 02, turn 1 cuts 13
      if (!is_cut && !both) continue;
      const Vec3 turned[4] = {point[turn], point[turn + 1], point[(turn + 2) % 4], point[(turn + 3) % 4]};
      double weight[6];
      quad_weights(turned, weight);
      // pairs 01 02 03 12 13 23 of the turned quad, by pairs of the face
      constexpr std::size_t same[6] = {0, 1, 2, 3, 4, 5}, next[6] = {3, 4, 0, 5, 1, 2};
      for (std::size_t k = 0; k < 6; ++k) gain[(turn == 0 ? same : next)[k]] -= (both ? 0.5 : 1.0) * weight[k];
    }
  }
  void subtract_cut(Index face, double* gain) const noexcept {
    const Span<const Index> corner = mesh_.faces.corners_of(face);
    const std::size_t n = corner.size();
    for (Index t = mesh_.faces.triangle_start[at(face)]; t < mesh_.faces.triangle_start[at(face) + 1]; ++t) {
      double cotangent[3];
      corner_cotangents(mesh_, t, cotangent);
      std::size_t place[3];
      for (std::size_t k = 0; k < 3; ++k)
        place[k] =
            static_cast<std::size_t>(std::find(corner.begin(), corner.end(), mesh_.triangle(t)[k]) - corner.begin());
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = std::min(place[(k + 1) % 3], place[(k + 2) % 3]),
                          j = std::max(place[(k + 1) % 3], place[(k + 2) % 3]);
        gain[i * n - i * (i + 1) / 2 + j - i - 1] -= 0.5 * cotangent[k];
      }
    }
  }

  const Mesh& mesh_;
  Vector<std::size_t> start_;
  Vector<double> gain_;
};

// Returns `matrix` with an additional zero for every pair of corners of the faces in `gains`.
SymmetricMatrix with_pairs(const Mesh& mesh, const SymmetricMatrix& matrix, const Gains& gains, Memory& memory) {
  const std::size_t n = at(matrix.size());
  Vector<Index> start(n + 1, 0, &memory);
  const auto each_face_corner = [&](auto&& visit) {
    for (Index f = 0; f < mesh.faces.count(); ++f) {
      for (const Index v : mesh.faces.corners_of(f)) {
        if (gains.has(f)) visit(v, f);
      }
    }
  };
  each_face_corner([&](Index v, Index) { ++start[at(v) + 1]; });
  for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
  Vector<Index> face(at(start[n]), 0, &memory), next(start.begin(), start.end() - 1, &memory);
  each_face_corner([&](Index v, Index f) { face[at(next[at(v)]++)] = f; });
  SymmetricMatrix out(memory);
  out.column_start.reserve(n + 1);
  out.column_start.push_back(0);
  out.row.reserve(matrix.row.size() + face.size());
  out.value.reserve(matrix.row.size() + face.size());
  Vector<Index> row(&memory);
  for (std::size_t v = 0; v < n; ++v) {
    const Index begin = matrix.column_start[v], end = matrix.column_start[v + 1];
    row.assign(matrix.row.begin() + begin, matrix.row.begin() + end);
    for (Index i = start[v]; i < start[v + 1]; ++i) {
      const Span<const Index> corner = mesh.faces.corners_of(face[at(i)]);
      row.insert(row.end(), corner.begin(), corner.end());
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    Index from = begin;
    for (const Index r : row) {
      const bool there = from < end && matrix.row[at(from)] == r;
      out.row.push_back(r);
      out.value.push_back(there ? matrix.value[at(from)] : 0.0);
      from += there;
    }
    out.column_start.push_back(static_cast<Index>(out.row.size()));
  }
  return out;
}

}  // namespace

void quad_weights(const Vec3 p[4], double weights[6]) noexcept {
  const Vec3 first[3] = {p[0], p[1], p[2]}, second[3] = {p[2], p[3], p[0]};
  double a[3], b[3];
  corner_cotangents(first, a);
  corner_cotangents(second, b);
  double w01 = a[2], w12 = a[0], w23 = b[2], w30 = b[0], w02 = a[1] + b[1], w13 = 0;
  if (w02 < 0) {
    // The other diagonal, where both triangles are unfolded into a plane: 0 at the origin, 2 on the x axis.
    const double l = norm(p[2] - p[0]);
    const auto unfold = [&](Vec3 q, double& x, double& y) {
      x = dot(q - p[0], p[2] - p[0]) / l;
      y = norm(cross(q - p[0], p[2] - p[0])) / l;
    };
    double x1, y1, x3, y3;
    unfold(p[1], x1, y1);
    unfold(p[3], x3, y3);
    const Vec3 q0, q1 = {x1, -y1, 0}, q2 = {l, 0, 0}, q3 = {x3, y3, 0};
    const Vec3 left[3] = {q1, q2, q3}, right[3] = {q3, q0, q1};
    corner_cotangents(left, a);
    corner_cotangents(right, b);
    w12 = a[2];
    w23 = a[0];
    w30 = b[2];
    w01 = b[0];
    w13 = a[1] + b[1];
    w02 = 0;
  }
  const double all[6] = {w01, w02, w30, w12, w13, w23};
  for (int k = 0; k < 6; ++k) weights[k] = 0.5 * all[k];
}

namespace {

// Adds the gains of all faces to the weights, each with the largest part that leaves no weight below 0. The weights
// stand at the entries above the diagonal.
class Sharing {
 public:
  Sharing(const Mesh& mesh, const SymmetricMatrix& pattern, const Gains& gains, Memory& memory, JobRunner* jobs)
      : pattern_(pattern),
        gains_(gains),
        jobs_(jobs),
        entry_(gains.size(), 0, &memory),
        weight_(pattern.row.size(), 0.0, &memory),
        takers_(pattern.row.size(), 0, &memory),
        left_(at(mesh.faces.count()), largest_part, &memory),
        part_(left_.size(), 0.0, &memory) {
    for (std::size_t i = 0; i < weight_.size(); ++i) weight_[i] = -pattern.value[i];
    in_pieces_of(jobs, left_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Span<const Index> corner = mesh.faces.corners_of(static_cast<Index>(f));
        std::size_t pair = gains.first(static_cast<Index>(f));
        for (std::size_t i = 0; i < corner.size() && gains.has(static_cast<Index>(f)); ++i) {
          for (std::size_t j = i + 1; j < corner.size(); ++j) entry_[pair++] = upper(corner[i], corner[j]);
        }
      }
    });
  }

  void round() {
    const Index faces = static_cast<Index>(part_.size());
    std::fill(takers_.begin(), takers_.end(), 0u);
    for (Index f = 0; f < faces; ++f) {
      for (std::size_t p = gains_.first(f); p < gains_.end(f); ++p)
        takers_[entry_[p]] += left_[at(f)] > 0 && gains_[p] < 0;
    }
    in_pieces_of(jobs_, part_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) part_[f] = share(static_cast<Index>(f));
    });
    for (Index f = 0; f < faces; ++f) {
      left_[at(f)] -= part_[at(f)];
      for (std::size_t p = gains_.first(f); p < gains_.end(f); ++p) weight_[entry_[p]] += part_[at(f)] * gains_[p];
    }
  }
  double weight(Index i, Index j) const noexcept { return std::max(weight_[upper(i, j)], 0.0); }

 private:
  // Returns the part that the face takes in this round, limited by its share of every weight that it lowers.
  double share(Index face) const noexcept {
    double most = std::max(left_[at(face)], 0.0);
    for (std::size_t p = gains_.first(face); p < gains_.end(face) && most > 0; ++p) {
      if (gains_[p] < 0) most = std::min(most, std::max(weight_[entry_[p]], 0.0) / (-gains_[p] * takers_[entry_[p]]));
    }
    return most;
  }
  std::size_t upper(Index i, Index j) const noexcept {
    const Index column = std::min(i, j), row = std::max(i, j);
    const auto begin = pattern_.row.begin() + pattern_.column_start[at(column)],
               end = pattern_.row.begin() + pattern_.column_start[at(column) + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, row) - pattern_.row.begin());
  }

  const SymmetricMatrix& pattern_;
  const Gains& gains_;
  JobRunner* jobs_;
  Vector<std::size_t> entry_;  // by pair of corners: the entry of its weight
  Vector<double> weight_;
  Vector<std::uint32_t> takers_;  // faces that lower a weight
  Vector<double> left_, part_;    // by face
};

}  // namespace

SymmetricMatrix corrected_by_polygons(const Mesh& mesh, const SymmetricMatrix& laplacian, Memory& memory,
                                      JobRunner* jobs) {
  const Gains gains(mesh, memory, jobs);
  poll();
  SymmetricMatrix out = with_pairs(mesh, laplacian, gains, memory);
  poll();
  Sharing sharing(mesh, out, gains, memory, jobs);
  for (int k = 0; k < share_rounds; ++k) {
    sharing.round();
    poll();
  }
  in_pieces_of(jobs, at(out.size()), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double sum = 0;
      std::size_t diagonal = 0;
      for (std::size_t i = at(out.column_start[v]); i < at(out.column_start[v + 1]); ++i) {
        if (at(out.row[i]) == v) {
          diagonal = i;
          continue;
        }
        out.value[i] = -sharing.weight(out.row[i], static_cast<Index>(v));
        sum += out.value[i];
      }
      out.value[diagonal] = -sum;
    }
  });
  return out;
}

}  // namespace hf_inner::mesh
