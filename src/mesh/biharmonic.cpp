#include "mesh/biharmonic.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner {
namespace {

// Number of matrix columns that one thread's job takes. Half and twice the value take the same time within 10 %, the
// noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t columns_piece = 8192;
// The matrix columns are computed in this many strips at the same time. Each strip has a scratch row as long as the
// mesh, so more strips use more memory and more threads. On two threads, half and
// twice the value take the same time within 10 %. No result depends on this number.
constexpr std::size_t most_strips = 8;
// A vertex's area counts as at least this share of the mean of its component. It bounds the condition number of the
// operator where triangles have no area. A larger share changes fields of sound meshes. Half and double change no bit
// on eight shapes with needles, loose pieces and a long ribbon.
constexpr double least_mass = 1e-4;

// The columns of the operator K that one job computes. They are kept until the lengths of all columns are known.
struct Columns {
  explicit Columns(Memory& memory) : row(&memory), value(&memory) {}
  Vector<Index> row;
  Vector<double> value;
};

// Makes columns of K_ij = sum_k (L_ik L_kj) / m_k, with the Laplacian L and the vertex areas m_k. The sum runs over
// ascending k, so K_ij and K_ji are the same bit for bit.
class ColumnMaker {
 public:
  ColumnMaker(const SymmetricMatrix& l, const Vector<double>& inverse_mass, Memory& memory)
      : l_(l), inverse_mass_(inverse_mass), sum_(at(l.size()), 0.0, &memory), stamp_(at(l.size()), -1, &memory) {}

  // Appends column v to `out` and returns its length.
  Index append(Index v, Columns& out) {
    const std::size_t first = out.row.size();
    for (Index i = l_.column_start[at(v)]; i < l_.column_start[at(v) + 1]; ++i) {
      const Index k = l_.row[at(i)];
      const double weight = inverse_mass_.empty() ? 1.0 : inverse_mass_[at(k)];
      for (Index j = l_.column_start[at(k)]; j < l_.column_start[at(k) + 1]; ++j) {
        const Index w = l_.row[at(j)];
        if (stamp_[at(w)] != v) stamp_[at(w)] = v, sum_[at(w)] = 0, out.row.push_back(w);
        sum_[at(w)] += weight * (l_.value[at(i)] * l_.value[at(j)]);
      }
    }
    std::sort(out.row.begin() + static_cast<std::ptrdiff_t>(first), out.row.end());
    double rest = 0;
    std::size_t diagonal = first;
    for (std::size_t i = first; i < out.row.size(); ++i) {
      if (out.row[i] == v)
        diagonal = i;
      else
        rest += sum_[at(out.row[i])];
      out.value.push_back(sum_[at(out.row[i])]);
    }
    out.value[diagonal] = -rest;
    return static_cast<Index>(out.row.size() - first);
  }

 private:
  const SymmetricMatrix& l_;
  const Vector<double>& inverse_mass_;
  Vector<double> sum_;
  Vector<Index> stamp_;
};

}  // namespace

Vector<double> inverse_masses(const Mesh& mesh, Vector<double> areas) {
  const std::size_t components = at(mesh.component_count());
  Vector<double> mean(components, 0.0, areas.get_allocator()), count(components, 0.0, areas.get_allocator());
  for (std::size_t v = 0; v < areas.size(); ++v)
    mean[at(mesh.component[v])] += areas[v], count[at(mesh.component[v])] += 1;
  for (std::size_t c = 0; c < components; ++c) mean[c] = mean[c] > 0 ? mean[c] / count[c] : 1.0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const double whole = mean[at(mesh.component[v])];
    areas[v] = whole / std::max(areas[v], least_mass * whole);
  }
  return areas;
}

std::int32_t cap_weights(SymmetricMatrix& laplacian, double times, Memory& memory, Vector<std::uint8_t>* changed,
                         double rounding) {
  Vector<double> magnitude(&memory);
  magnitude.reserve(laplacian.row.size());
  const auto each_column = [&](auto&& work) {
    for (Index v = 0; v < laplacian.size(); ++v) {
      for (Index i = laplacian.column_start[at(v)]; i < laplacian.column_start[at(v) + 1]; ++i) work(v, at(i));
    }
  };
  each_column([&](Index v, std::size_t i) {
    const double size = std::fabs(laplacian.value[i]);
    if (laplacian.row[i] != v && size > rounding) magnitude.push_back(size);
  });
  if (magnitude.empty()) return 0;
  const auto middle = magnitude.begin() + static_cast<std::ptrdiff_t>(magnitude.size() / 2);
  std::nth_element(magnitude.begin(), middle, magnitude.end());
  const double most = times * *middle;
  std::int32_t cut = 0;
  each_column([&](Index v, std::size_t i) {
    if (laplacian.row[i] == v || std::fabs(laplacian.value[i]) <= most) return;
    laplacian.value[i] = std::copysign(most, laplacian.value[i]), ++cut;
    if (changed) (*changed)[at(v)] = 1;
  });
  if (cut == 0) return 0;
  for (Index v = 0; v < laplacian.size(); ++v) {
    double rest = 0;
    std::size_t diagonal = 0;
    for (std::size_t i = at(laplacian.column_start[at(v)]); i < at(laplacian.column_start[at(v) + 1]); ++i) {
      if (laplacian.row[i] == v)
        diagonal = i;
      else
        rest += laplacian.value[i];
    }
    laplacian.value[diagonal] = -rest;
  }
  return cut / 2;
}

SymmetricMatrix biharmonic(const SymmetricMatrix& laplacian, const Vector<double>& inverse_mass, Memory& memory,
                           JobRunner* jobs) {
  const std::size_t n = at(laplacian.size()), pieces = (n + columns_piece - 1) / columns_piece;
  SymmetricMatrix matrix(memory);
  matrix.column_start.assign(n + 1, 0);
  Vector<Columns> part(&memory);
  for (std::size_t p = 0; p < pieces; ++p) part.emplace_back(memory);
  // The work is cut into a fixed number of strips, each with its own maker. So the work does not depend on threads, and
  // its memory stays small.
  const std::size_t strips = std::min(pieces, most_strips);
  for_each(jobs, static_cast<std::uint32_t>(strips), [&](std::uint32_t strip) {
    ColumnMaker maker(laplacian, inverse_mass, memory);
    for (std::size_t p = strip; p < pieces; p += strips) {
      for (std::size_t v = p * columns_piece; v < std::min(n, (p + 1) * columns_piece); ++v)
        matrix.column_start[v + 1] = maker.append(static_cast<Index>(v), part[p]);
    }
  });
  std::size_t total = 0;
  for (const Columns& columns : part) total += columns.row.size();
  if (total > at(INT32_MAX))
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the bi-harmonic operator has %zu entries; at most 2^31 - 1 are supported",
         total);
  for (std::size_t v = 0; v < n; ++v) matrix.column_start[v + 1] += matrix.column_start[v];
  matrix.row.resize(total), matrix.value.resize(total);
  for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
    const std::ptrdiff_t start = matrix.column_start[p * columns_piece];
    std::copy(part[p].row.begin(), part[p].row.end(), matrix.row.begin() + start);
    std::copy(part[p].value.begin(), part[p].value.end(), matrix.value.begin() + start);
  });
  return matrix;
}

bool exceeds_valence(const SymmetricMatrix& laplacian, Index most) noexcept {
  for (std::size_t v = 0; v < at(laplacian.size()); ++v) {
    if (laplacian.column_start[v + 1] - laplacian.column_start[v] - 1 > most) return true;
  }
  return false;
}

void apply_laplacian(const SymmetricMatrix& laplacian, const Vector<double>& scale, const double* u, Index channels,
                     double* out, JobRunner& jobs) {
  const std::size_t m = at(channels);
  for_ranges(jobs, at(laplacian.size()), columns_piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double* own = out + v * m;
      std::fill_n(own, m, 0.0);
      for (Index i = laplacian.column_start[v]; i < laplacian.column_start[v + 1]; ++i) {
        const double* there = u + at(laplacian.row[at(i)]) * m;
        for (std::size_t q = 0; q < m; ++q) own[q] += laplacian.value[at(i)] * (there[q] - u[v * m + q]);
      }
      for (std::size_t q = 0; !scale.empty() && q < m; ++q) own[q] *= scale[v];
    }
  });
}

Vector<double> biharmonic_diagonal(const SymmetricMatrix& laplacian, const Vector<double>& inverse_mass,
                                   Memory& memory) {
  Vector<double> diagonal(at(laplacian.size()), 0.0, &memory);
  for (std::size_t v = 0; v < diagonal.size(); ++v) {
    for (Index i = laplacian.column_start[v]; i < laplacian.column_start[v + 1]; ++i) {
      const double weight = inverse_mass.empty() ? 1.0 : inverse_mass[at(laplacian.row[at(i)])];
      diagonal[v] += weight * (laplacian.value[at(i)] * laplacian.value[at(i)]);
    }
  }
  return diagonal;
}

}  // namespace hf_inner
