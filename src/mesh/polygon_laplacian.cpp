#include "mesh/polygon_laplacian.h"

#include <algorithm>

#include "base/algebra.h"
#include "base/index.h"
#include "base/principal_axes.h"
#include "base/progress.h"
#include "mesh/laplacian.h"

namespace hf_inner::mesh {
namespace {

// A larger face counts as the triangles of its cut. Its corners would form a dense block: 64 corners give 4,096
// entries; the double would give four times as many. Ladders of faces with 60 to 128 corners: a field changes by 0.8 %
// of its range between the two.
constexpr std::size_t most_connected = 64;
// Eigenvalues below this share of the largest count as 0: the face is flat in that direction. Rounding gives 1e-15; a
// larger share would move the point of a slightly bent face into its mean plane. Few matrices come this far: on 52
// generated meshes neither half, double nor 1e-7 changes a field.
constexpr double flat_share = 1e-10;
// A matrix with a determinant above this share of its cubed trace is inverted directly. Below it, a face bent by less
// than 1e-6 of its size counts as flat. The weights of its corners then give its point in the plane only. Half and
// double change fields on a double torus with coordinates of six digits by 6e-5 of their range, 1e-9 fields on jittered
// sheets by 3e-4.
constexpr double safe_determinant = 1e-12;
// Each triangle at the point of a star-shaped face has more than this share of the face's area. It keeps cotangents
// below 1e6; a larger share would leave more faces of uneven sides without a correction. On 52 generated meshes nothing
// between 5e-7 and 1e-2 changes a field.
constexpr double least_triangle = 1e-6;
// Rows that one thread's job sorts: smaller jobs cost more to hand out, larger ones leave threads idle. With half and
// double a field on 90,000 bent quads takes as long within the noise of 10 % (two threads).
constexpr std::size_t row_piece = 8192;

using Vector3 = hf_eigen::Vector3d;
Vector3 to_eigen(Vec3 p) noexcept { return {p.x, p.y, p.z}; }

bool is_regular(const Mat3& matrix) noexcept {
  const double size = matrix.trace();
  return matrix.determinant() > safe_determinant * size * size * size;
}

// Applies the pseudo-inverse of a symmetric matrix without negative eigenvalues. Along `normal`, unless it is 0, a
// matrix that is flat there gets an eigenvalue first: it changes nothing, and eigenvectors cost more.
Vector3 solve_flat(Mat3 matrix, const Vector3& right, const Vector3& normal) noexcept {
  if (!is_regular(matrix)) matrix += matrix.trace() * normal * normal.transpose();
  if (is_regular(matrix)) return matrix.inverse() * right;
  const PrincipalAxes found = principal_axes(matrix);
  Vector3 out = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!(found.moment[k] > flat_share * found.moment[0])) continue;
    out += (found.axes.col(k).dot(right) / found.moment[k]) * found.axes.col(k);
  }
  return out;
}

// The off-diagonal entries that one face adds to the matrix.
struct Entry {
  Index column, face;
  double value;
  bool operator<(const Entry& o) const noexcept {
    if (column != o.column) return column < o.column;
    return face != o.face ? face < o.face : value < o.value;
  }
};

// Calls put(row, column, face, value) for every entry off the diagonal.
template <class Put>
void each_entry(const Mesh& mesh, bool with_values, Memory& memory, Put&& put) {
  PolygonMatrix matrix(memory);
  Vector<Index> sorted(&memory);
  Vector<Vec3> point(&memory);
  for (Index f = 0; f < mesh.faces.count(); ++f) {
    const Span<const Index> corner = mesh.faces.corners_of(f);
    if (is_connected(corner, sorted)) {
      point.clear();
      for (const Index v : corner) point.push_back(mesh.positions[at(v)]);
      if (with_values) matrix.make(point);
      for (std::size_t i = 0; i < corner.size(); ++i) {
        for (std::size_t j = 0; j < corner.size(); ++j) {
          if (i != j) put(corner[i], corner[j], f, with_values ? matrix.value[i * corner.size() + j] : 0.0);
        }
      }
      continue;
    }
    for (Index t = mesh.faces.triangle_start[at(f)]; t < mesh.faces.triangle_start[at(f) + 1]; ++t) {
      const Index* v = mesh.triangle(t);
      double cotangent[3] = {0, 0, 0};
      if (with_values) corner_cotangents(mesh, t, cotangent);
      for (int k = 0; k < 3; ++k) {
        const Index a = v[(k + 1) % 3], b = v[(k + 2) % 3];
        put(a, b, f, -0.5 * cotangent[k]);
        put(b, a, f, -0.5 * cotangent[k]);
      }
    }
  }
}

}  // namespace

void PolygonMatrix::make(Span<const Vec3> corners) {
  const std::size_t n = corners.size();
  const Vec3 centre = face_point(corners, weight_);
  Vec3 normal;
  for (std::size_t i = 0; i < n; ++i) normal = normal + cross(corners[i] - centre, corners[(i + 1) % n] - centre);
  const double least = least_triangle * dot(normal, normal);
  value.assign(n * n, 0.0);
  spoke_.assign(n, 0.0);
  is_star = least > 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const Vec3 triangle[3] = {corners[i], corners[j], centre};
    is_star = is_star && dot(normal, cross(corners[i] - centre, corners[j] - centre)) > least;
    double cotangent[3];
    corner_cotangents(triangle, cotangent);
    value[i * n + j] -= 0.5 * cotangent[2];
    value[j * n + i] -= 0.5 * cotangent[2];
    spoke_[i] += 0.5 * cotangent[1];
    spoke_[j] += 0.5 * cotangent[0];
  }
  double sum = 0;
  for (const double w : spoke_) sum += w;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      value[i * n + j] += sum * weight_[i] * weight_[j] - (spoke_[i] * weight_[j] + weight_[i] * spoke_[j]);
      value[j * n + i] = value[i * n + j];
    }
  }
}

bool is_connected(Span<const std::int32_t> corner, Vector<std::int32_t>& sorted) {
  if (corner.size() < 4 || corner.size() > most_connected) return false;
  sorted.assign(corner.begin(), corner.end());
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

Vec3 face_point(Span<const Vec3> corners, Vector<double>& weights) {
  const std::size_t n = corners.size();
  Vector3 mean = Vector3::Zero();
  for (const Vec3& p : corners) mean += to_eigen(p - corners[0]);
  mean = to_eigen(corners[0]) + (1.0 / static_cast<double>(n)) * mean;
  // The sum of |(p - x) x (q - x)|^2 over the sides p q is least where A x = b; x is taken relative to the mean.
  Mat3 matrix = Mat3::Zero(), spread = Mat3::Zero();
  Vector3 right = Vector3::Zero(), normal = Vector3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3 p = to_eigen(corners[i]) - mean, q = to_eigen(corners[(i + 1) % n]) - mean, side = q - p;
    matrix += side.squaredNorm() * Mat3::Identity() - side * side.transpose();
    const Vector3 area = p.cross(q);
    right += side.cross(area);
    normal += area;
    spread += p * p.transpose();
  }
  const double length = normal.norm();
  if (length > 0) normal /= length;
  const Vector3 offset = solve_flat(matrix, right, Vector3::Zero());
  const Vector3 pull = solve_flat(spread, offset - normal.dot(offset) * (is_regular(spread) ? 0 : 1) * normal, normal);
  weights.clear();
  Vector3 point = Vector3::Zero();
  for (const Vec3& corner : corners) {
    weights.push_back(1.0 / static_cast<double>(n) + pull.dot(to_eigen(corner) - mean));
    point += weights.back() * (to_eigen(corner) - mean);
  }
  point += mean;
  return {point.x(), point.y(), point.z()};
}

SymmetricMatrix polygon_laplacian(const Mesh& mesh, Memory& memory, JobRunner* jobs) {
  const std::size_t n = mesh.positions.size();
  Vector<Index> start(n + 1, 0, &memory);
  each_entry(mesh, false, memory, [&](Index row, Index, Index, double) { ++start[at(row) + 1]; });
  for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
  poll();
  Buffer<Entry> entries(memory, at(start[n]));
  Vector<Index> end(start.begin(), start.end() - 1, &memory);
  each_entry(mesh, true, memory, [&](Index row, Index column, Index face, double value) {
    entries[at(end[at(row)]++)] = {column, face, value};
  });
  poll();
  for_each(jobs, static_cast<std::uint32_t>((n + row_piece - 1) / row_piece), [&](std::uint32_t p) {
    for (std::size_t v = p * row_piece; v < std::min(n, (p + std::size_t{1}) * row_piece); ++v) {
      Entry *const first = entries.data() + start[v], *last = first, *const stop = entries.data() + end[v];
      std::sort(first, stop);
      for (Entry* entry = first; entry != stop; ++entry) {
        if (entry != first && entry->column == (last - 1)->column)
          (last - 1)->value += entry->value;
        else
          *last++ = *entry;
      }
      end[v] = static_cast<Index>(last - entries.data());
    }
  });
  SymmetricMatrix out(memory);
  out.column_start.assign(n + 1, 0);
  for (std::size_t v = 0; v < n; ++v) out.column_start[v + 1] = out.column_start[v] + end[v] - start[v] + 1;
  out.row.reserve(at(out.column_start[n]));
  out.value.reserve(at(out.column_start[n]));
  for (std::size_t v = 0; v < n; ++v) {
    const auto put = [&](Index row, double value) {
      out.row.push_back(row);
      out.value.push_back(value);
    };
    double sum = 0;
    std::size_t diagonal = out.row.size();
    Index i = start[v];
    for (; i < end[v] && at(entries[at(i)].column) < v; ++i) ++diagonal;
    for (i = start[v]; i < end[v]; ++i) sum += entries[at(i)].value;
    for (i = start[v]; i < end[v]; ++i) {
      if (out.row.size() == diagonal) put(static_cast<Index>(v), -sum);
      put(entries[at(i)].column, entries[at(i)].value);
    }
    if (out.row.size() == diagonal) put(static_cast<Index>(v), -sum);
  }
  return out;
}

void clamp_weights(SymmetricMatrix& matrix, Memory& memory) {
  Vector<double> weights(&memory);
  for (Index v = 0; v < matrix.size(); ++v) {
    for (Index i = matrix.column_start[at(v)]; i < matrix.column_start[at(v) + 1]; ++i) {
      if (matrix.row[at(i)] > v) weights.push_back(matrix.value[at(i)]);
    }
  }
  const double floor = clamped_floor(weights, memory);
  for (Index v = 0; v < matrix.size(); ++v) {
    double sum = 0;
    for (Index i = matrix.column_start[at(v)]; i < matrix.column_start[at(v) + 1]; ++i) {
      if (matrix.row[at(i)] == v) continue;
      double& value = matrix.value[at(i)];
      value = std::min(value, -floor);
      sum += value;
    }
    matrix.value[matrix.diagonal(v)] = -sum;
  }
}

}  // namespace hf_inner::mesh
