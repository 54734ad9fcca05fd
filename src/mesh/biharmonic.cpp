#include "mesh/biharmonic.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner::mesh {
namespace {

// Number of matrix columns that one thread's job takes. Half and twice the value take the same time within 10 %, the
// noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t columns_piece = 8192;
// Number of products L_ik L_kj between two polls: one or two milliseconds, about 10,000 columns of a closed mesh. A
// larger number would delay a cancellation, a smaller one would make more and smaller blocks of memory. No result
// depends on this number.
constexpr std::size_t piece_products = std::size_t{1} << 19;
// The matrix columns are computed in this many strips at the same time. Each strip has a scratch row as long as the
// mesh, so more strips use more memory and more threads. On two threads, half and
// twice the value take the same time within 10 %. No result depends on this number.
constexpr std::size_t most_strips = 8;
// A vertex's area counts as at least this share of the mean of its component. It bounds the condition number of the
// operator where triangles have no area. A larger share changes fields of sound meshes. Half and double change no bit
// on eight shapes with needles, loose pieces and a long ribbon.
constexpr double least_mass = 1e-4;

// Columns of the operator K, each from its diagonal entry down. They are kept until the lengths of all are known.
struct Columns {
  explicit Columns(Memory& memory) : row(&memory), value(&memory) {}
  Vector<Index> row;
  Vector<double> value;
};

// Makes columns of K_ij = sum_k (L_ik L_kj) / m_k, with the Laplacian L and the vertex areas m_k. The sum runs over
// ascending k, so K_ij and K_ji are the same bit for bit. So one of them is computed.
class ColumnMaker {
 public:
  ColumnMaker(const SymmetricMatrix& l, const Vector<double>& inverse_mass, Memory& memory)
      : l_(l),
        inverse_mass_(inverse_mass),
        sum_(at(l.size()), 0.0, &memory),
        stamp_(at(l.size()), -1, &memory),
        found_(at(l.size()), 0, &memory) {}

  // Appends column v from the diagonal down to `out` and returns the length of that. The diagonal entry is 0.
  Index append(Index v, Columns& out) {
    // Plain pointers: the compiler need not read them again after every write.
    const Index *row = l_.row.data(), *start = l_.column_start.data();
    const double* value = l_.value.data();
    double* sum = sum_.data();
    Index *stamp = stamp_.data(), *found = found_.data();
    std::size_t count = 0;
    for (Index i = start[v]; i < start[v + 1]; ++i) {
      const Index k = row[i];
      const double own = value[i], weight = inverse_mass_.empty() ? 1.0 : inverse_mass_[at(k)];
      for (Index j = start[k + 1] - 1; j >= start[k] && row[j] >= v; --j) {
        const Index w = row[j];
        const double product = weight * (own * value[j]);
        if (stamp[w] != v) {
          stamp[w] = v;
          sum[w] = 0.0 + product;
          found[count++] = w;  // never -0.0
        } else {
          sum[w] += product;
        }
      }
    }
    sort_rows(v, count);
    sum[v] = 0;
    for (std::size_t i = 0; i < count; ++i) {
      out.row.push_back(found[i]);
      out.value.push_back(sum[found[i]]);
    }
    return static_cast<Index>(count);
  }

 private:
  void sort_rows(Index v, std::size_t count) {
    // Reading so many stamps takes less time than a sort.
    if (at(l_.size() - v) > 4 * count)
      return std::sort(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(count));
    std::size_t next = 0;
    for (Index w = v; next < count; ++w) {
      if (stamp_[at(w)] == v) found_[next++] = w;
    }
  }

  const SymmetricMatrix& l_;
  const Vector<double>& inverse_mass_;
  Vector<double> sum_;
  Vector<Index> stamp_, found_;
};

// Returns the first column of every piece of about piece_products products, and the number of columns.
Vector<std::size_t> cut_columns(const SymmetricMatrix& l, Memory& memory) {
  const auto length = [&](std::size_t v) { return at(l.column_start[v + 1] - l.column_start[v]); };
  Vector<std::size_t> first(1, 0, &memory);
  std::size_t products = 0;
  for (std::size_t v = 0; v < at(l.size()); ++v) {
    std::size_t own = 0;
    for (Index i = l.column_start[v]; i < l.column_start[v + 1]; ++i) own += length(at(l.row[at(i)]));
    if (products > 0 && products + own > piece_products) {
      first.push_back(v);
      products = 0;
    }
    products += own;
  }
  first.push_back(at(l.size()));
  return first;
}

}  // namespace

Vector<double> inverse_masses(const Mesh& mesh, Vector<double> areas) {
  const std::size_t components = at(mesh.component_count());
  Vector<double> mean(components, 0.0, areas.get_allocator()), count(components, 0.0, areas.get_allocator());
  for (std::size_t v = 0; v < areas.size(); ++v) {
    mean[at(mesh.component[v])] += areas[v];
    count[at(mesh.component[v])] += 1;
  }
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
    laplacian.value[i] = std::copysign(most, laplacian.value[i]);
    ++cut;
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
  const std::size_t n = at(laplacian.size());
  const Vector<std::size_t> first = cut_columns(laplacian, memory);
  const std::size_t pieces = first.size() - 1;
  Vector<Index> below(n, 0, &memory), above(n, 0, &memory);  // lengths of each column from the diagonal, and before it
  Vector<Columns> part(&memory);
  part.reserve(pieces);
  for (std::size_t p = 0; p < pieces; ++p) part.emplace_back(memory);
  // The work is cut into a fixed number of strips, each with its own maker. So the work does not depend on threads, and
  // its memory stays small.
  const std::size_t strips = std::min(pieces, most_strips);
  for_each(jobs, static_cast<std::uint32_t>(strips), [&](std::uint32_t strip) {
    ColumnMaker maker(laplacian, inverse_mass, memory);
    for (std::size_t p = strip; p < pieces; p += strips) {
      poll();
      for (std::size_t v = first[p]; v < first[p + 1]; ++v) below[v] = maker.append(static_cast<Index>(v), part[p]);
    }
  });
  std::size_t total = 0;
  for (const Columns& columns : part) {
    poll();
    total += 2 * columns.row.size();
    for (const Index w : columns.row) ++above[at(w)];
  }
  total -= n;
  if (total > at(INT32_MAX))
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the bi-harmonic operator has %zu entries; at most 2^31 - 1 are supported",
         total);
  SymmetricMatrix matrix(memory);
  matrix.column_start.assign(n + 1, 0);
  for (std::size_t v = 0; v < n; ++v) {
    above[v] -= 1;  // without the diagonal entry
    matrix.column_start[v + 1] = matrix.column_start[v] + above[v] + below[v];
  }
  matrix.row.resize(total);
  matrix.value.resize(total);
  // The part before the diagonal: columns in ascending order append their row number to the columns of their rows.
  Vector<Index> next(matrix.column_start.begin(), matrix.column_start.end() - 1, &memory);
  for (std::size_t p = 0; p < pieces; ++p) {
    poll();
    std::size_t i = 0;
    for (std::size_t v = first[p]; v < first[p + 1]; ++v) {
      for (const std::size_t end = i + at(below[v]); i < end; ++i) {
        const std::size_t w = at(part[p].row[i]), place = at(next[w]++);
        matrix.row[place] = static_cast<Index>(v);
        matrix.value[place] = part[p].value[i];
      }
    }
  }
  // The rest, and the diagonal: minus the sum of all others, so that constants have the value 0.
  for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
    std::size_t i = 0;
    for (std::size_t v = first[p]; v < first[p + 1]; ++v) {
      const std::size_t begin = at(matrix.column_start[v]), middle = begin + at(above[v]),
                        end = at(matrix.column_start[v + 1]);
      for (std::size_t j = middle; j < end; ++j, ++i) {
        matrix.row[j] = part[p].row[i];
        matrix.value[j] = part[p].value[i];
      }
      double rest = 0;
      for (std::size_t j = begin; j < end; ++j) rest += j == middle ? 0 : matrix.value[j];
      matrix.value[middle] = -rest;
    }
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

}  // namespace hf_inner::mesh
