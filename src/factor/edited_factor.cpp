#include "factor/edited_factor.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner {
namespace {

constexpr Index tile = PathGroup::capacity;

// A dense lower triangular matrix, by columns: entry (i, j) is at j * size + i. The upper triangle is not used.
struct Lower {
  Lower(std::size_t k, Memory& memory) : size(k), value(k * k, 0.0, &memory) {}
  double& at(std::size_t i, std::size_t j) noexcept { return value[j * size + i]; }
  double at(std::size_t i, std::size_t j) const noexcept { return value[j * size + i]; }
  const double* column(std::size_t j) const noexcept { return value.data() + j * size; }
  double* column(std::size_t j) noexcept { return value.data() + j * size; }

  // Replaces a symmetric matrix by its Cholesky factor. Returns -1, or the first row without a positive pivot.
  Index factorise() noexcept {
    constexpr std::size_t step =
        4;  // columns that the others are updated with at once, so they are read a fourth as often
    for (std::size_t begin = 0; begin < size; begin += step) {
      const std::size_t end = std::min(size, begin + step);
      for (std::size_t j = begin; j < end; ++j) {
        double* const own = column(j);
        for (std::size_t c = begin; c < j; ++c) subtract(column(c)[j], column(c), own, j);
        if (!(own[j] > 0)) return static_cast<Index>(j);
        const double scale = 1 / std::sqrt(own[j]);
        for (std::size_t i = j; i < size; ++i) own[i] *= scale;
      }
      for (std::size_t c = end; c < size; ++c) {
        double* const other = column(c);
        if (end - begin < step) {
          for (std::size_t j = begin; j < end; ++j) subtract(column(j)[c], column(j), other, c);
          continue;
        }
        const double *const x0 = column(begin), *const x1 = x0 + size, *const x2 = x1 + size, *const x3 = x2 + size;
        const double f0 = x0[c], f1 = x1[c], f2 = x2[c], f3 = x3[c];
        for (std::size_t i = c; i < size; ++i) other[i] -= (f0 * x0[i] + f1 * x1[i]) + (f2 * x2[i] + f3 * x3[i]);
      }
    }
    return -1;
  }
  void subtract(double factor, const double* from, double* out, std::size_t begin) const noexcept {
    for (std::size_t i = begin; i < size; ++i) out[i] -= factor * from[i];
  }
  // x <- M^-1 x and x <- M'^-1 x, with x[row * m + q].
  void solve(double* x, std::size_t m) const noexcept {
    for (std::size_t j = 0; j < size; ++j) {
      const double* const own = column(j);
      for (std::size_t q = 0; q < m; ++q) x[j * m + q] /= own[j];
      for (std::size_t i = j + 1; i < size; ++i) {
        for (std::size_t q = 0; q < m; ++q) x[i * m + q] -= own[i] * x[j * m + q];
      }
    }
  }
  void solve_transposed(double* x, std::size_t m) const noexcept {
    for (std::size_t j = size; j-- > 0;) {
      const double* const own = column(j);
      for (std::size_t i = j + 1; i < size; ++i) {
        for (std::size_t q = 0; q < m; ++q) x[j * m + q] -= own[i] * x[i * m + q];
      }
      for (std::size_t q = 0; q < m; ++q) x[j * m + q] /= own[j];
    }
  }

  // Entry (i, i) of (M M')^-1. scratch: `size` numbers.
  double inverse_at(std::size_t i, double* scratch) const noexcept {
    std::fill(scratch + i, scratch + size, 0.0);
    scratch[i] = 1;
    double squares = 0;
    for (std::size_t j = i; j < size; ++j) {
      const double* const own = column(j);
      const double y = scratch[j] / own[j];
      squares += y * y;
      for (std::size_t r = j + 1; r < size; ++r) scratch[r] -= own[r] * y;
    }
    return squares;
  }

  std::size_t size;
  Vector<double> value;
};

// The paths T^-1 y of some sites: the paths y of the base, and what T^-1 adds to them.
class EditedPaths final : public PathGroup {
 public:
  EditedPaths(std::shared_ptr<const PathGroup> base, Memory& memory)
      : base_(std::move(base)), product(&memory), added(&memory), whole(&memory) {}
  Index count() const noexcept override { return base_->count(); }
  double bytes() const noexcept override {
    return base_->bytes() + 8.0 * static_cast<double>(product.size() + added.size() + whole.size());
  }
  const PathGroup& base() const noexcept { return *base_; }

 private:
  std::shared_ptr<const PathGroup> base_;

 public:
  Vector<double> product;  // [k][count] Y'y
  Vector<double> added;    // [k][count] W Y'y: the path is y + Y added
  Vector<double> whole;    // [k][count] Y'(T^-1 y)
};

class EditedFactor final : public Factor {
 public:
  EditedFactor(std::shared_ptr<const Factor> base, std::size_t rim, std::size_t inside, SparseVectors rows,
               Memory& memory)
      : base_(std::move(base)),
        memory_(memory),
        rim_(rim),
        inside_(inside),
        k_(rim + inside),
        statistics_(base_->statistics()),
        paths_(&memory),
        place_(rim, &memory),
        rows_(std::move(rows)),
        unknown_(&memory),
        gram_(rim * rim, 0.0, &memory),
        entries_(&memory),
        rim_before_(rim, memory),
        rim_after_(rim, memory),
        inside_before_(inside, memory),
        inside_after_(inside, memory),
        coupling_(&memory),
        ratio_(k_, 0.0, &memory) {}

  void prepare(const MatrixChange& change, JobRunner& jobs);

  Index size() const noexcept override { return base_->size(); }
  const FactorStatistics& statistics() const noexcept override { return statistics_; }
  double commute_time(Span<const Index> component, Span<const double> diagonal) const override {
    return base_->commute_time(component, diagonal);
  }
  Span<const Index> position() const noexcept override { return base_->position(); }
  Span<const Index> order() const noexcept override { return base_->order(); }

  void forward(double* z, Index channels, JobRunner& jobs) const override {
    base_->forward(z, channels, jobs);
    add_change(z, channels, false);
  }
  void backward(double* z, Index channels, JobRunner& jobs) const override {
    add_change(z, channels, true);
    base_->backward(z, channels, jobs);
  }
  void backward_at(Span<const Index> unknowns, double* z, Index channels) const override {
    add_change(z, channels, true);
    base_->backward_at(unknowns, z, channels);
  }
  void clear_at(Span<const Index> unknowns, double* z, Index channels) const override {
    base_->clear_at(unknowns, z, channels);
    clear_own(channels, z);
  }
  std::shared_ptr<const Factor> refactor(const SymmetricMatrix& matrix, Span<const std::uint8_t> eliminated,
                                         Memory& memory, JobRunner& jobs) const override {
    return base_->refactor(matrix, eliminated, memory, jobs);
  }
  void solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                   Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<Index> out_group,
                   Span<Index> out_column) const override;
  bool rows_of(Span<const Index>, SparseVectors&) const override { return false; }
  void gram(const PathGroup& a, const PathGroup& b, double* gram, Index ld) const override;
  void combine(const PathGroup& group, const double* lambda, Index channels, double* z) const override;
  void clear(const PathGroup& group, Index channels, double* z) const override {
    base_->clear(of(group).base(), channels, z);
    clear_own(channels, z);
  }
  void project(const PathGroup& group, const double* z, Index channels, double* out) const override;

 private:
  static const EditedPaths& of(const PathGroup& group) noexcept { return static_cast<const EditedPaths&>(group); }
  void form_rim(Span<const Index> unknowns, JobRunner& jobs);
  void form_change(const MatrixChange& change, const Vector<std::size_t>& number);
  // out[i * channels + q] = v_i' z.
  void project_own(const double* z, Index channels, double* out) const;
  // z += V x.
  void combine_own(const double* x, Index channels, double* z) const;
  // Sets z to 0 on every row that V touches.
  void clear_own(Index channels, double* z) const;
  // Replaces x by W x, or by W' x.
  void apply(double* x, std::size_t m, bool transposed) const;
  void add_change(double* z, Index channels, bool transposed) const;

  std::shared_ptr<const Factor> base_;
  Memory& memory_;
  std::size_t rim_, inside_, k_;  // columns of V: first those of the rim, then those of the inside
  FactorStatistics statistics_;
  Vector<std::shared_ptr<const PathGroup>> paths_;  // of the rim
  struct Place {
    Index group, column;
  };
  Vector<Place> place_;    // by column of V
  SparseVectors rows_;     // of G, of the inside
  Vector<Index> unknown_;  // the inside in the caller's numbering, ascending
  Vector<double> gram_;    // C of the rim, both triangles
  struct Entry {
    std::size_t row, column;
    double value;
  };
  Vector<Entry> entries_;               // C of the inside: entries of A, counted in the inside
  Lower rim_before_, rim_after_;        // H and L of the rim
  Lower inside_before_, inside_after_;  // H of the inside, and H L: the factors of A and A' there
  Vector<double> coupling_;             // [inside][rim] L between the two, transposed
  Vector<double> ratio_;                // by column of V: D_ii (A^-1)_ii
};

void EditedFactor::project_own(const double* z, Index channels, double* out) const {
  const std::size_t m = at(channels);
  Vector<double> products(paths_.size() * at(tile) * m, &memory_);
  for (std::size_t g = 0; g < paths_.size(); ++g)
    base_->project(*paths_[g], z, channels, products.data() + g * at(tile) * m);
  for (std::size_t i = 0; i < rim_; ++i)
    std::copy_n(&products[(at(place_[i].group) * at(tile) + at(place_[i].column)) * m], m, out + i * m);
  out += rim_ * m;
  std::fill_n(out, inside_ * m, 0.0);
  for (std::size_t i = 0; i < inside_; ++i, out += m) {
    for (Index e = rows_.start[i]; e < rows_.start[i + 1]; ++e) {
      const double value = rows_.value[at(e)];
      const double* const from = z + at(rows_.row[at(e)]) * m;
      for (std::size_t q = 0; q < m; ++q) out[q] += value * from[q];
    }
  }
}

void EditedFactor::combine_own(const double* x, Index channels, double* z) const {
  const std::size_t m = at(channels);
  Vector<double> factors(paths_.size() * at(tile) * m, 0.0, &memory_);
  for (std::size_t i = 0; i < rim_; ++i)
    std::copy_n(x + i * m, m, &factors[(at(place_[i].group) * at(tile) + at(place_[i].column)) * m]);
  for (std::size_t g = 0; g < paths_.size(); ++g)
    base_->combine(*paths_[g], factors.data() + g * at(tile) * m, channels, z);
  x += rim_ * m;
  for (std::size_t i = 0; i < inside_; ++i, x += m) {
    for (Index e = rows_.start[i]; e < rows_.start[i + 1]; ++e) {
      const double value = rows_.value[at(e)];
      double* const to = z + at(rows_.row[at(e)]) * m;
      for (std::size_t q = 0; q < m; ++q) to[q] += value * x[q];
    }
  }
}

void EditedFactor::clear_own(Index channels, double* z) const {
  for (const auto& group : paths_) base_->clear(*group, channels, z);
  for (const Index row : rows_.row) std::fill_n(z + at(row) * at(channels), channels, 0.0);
}

// W = H'^-1 (L^-1 - I) H^-1. For the inside L^-1 H^-1 is the inverse of the factor of A'.
void EditedFactor::apply(double* x, std::size_t m, bool transposed) const {
  double* const inside = x + rim_ * m;
  Vector<double> y(x, x + k_ * m, &memory_);
  double* const y_inside = y.data() + rim_ * m;
  const auto each = [&](auto&& take) {
    for (std::size_t i = 0; i < inside_; ++i) {
      for (std::size_t a = 0; a < rim_; ++a) take(coupling_[i * rim_ + a], y_inside + i * m, y.data() + a * m);
    }
  };
  inside_before_.solve(inside, m);
  rim_before_.solve(x, m);
  std::copy_n(x, rim_ * m, y.data());
  if (transposed) {
    rim_after_.solve_transposed(y.data(), m);
    std::copy_n(inside, inside_ * m, y_inside);
    each([&](double value, double* of_inside, const double* of_rim) {
      for (std::size_t q = 0; q < m; ++q) of_inside[q] -= value * of_rim[q];
    });
    inside_after_.solve_transposed(y_inside, m);
    inside_before_.solve_transposed(inside, m);
    for (std::size_t i = 0; i < inside_ * m; ++i) inside[i] = y_inside[i] - inside[i];
  } else {
    inside_after_.solve(y_inside, m);
    each([&](double value, const double* of_inside, double* of_rim) {
      for (std::size_t q = 0; q < m; ++q) of_rim[q] -= value * of_inside[q];
    });
    rim_after_.solve(y.data(), m);
    for (std::size_t i = 0; i < inside_ * m; ++i) inside[i] = y_inside[i] - inside[i];
    inside_before_.solve_transposed(inside, m);
  }
  for (std::size_t i = 0; i < rim_ * m; ++i) x[i] = y[i] - x[i];
  rim_before_.solve_transposed(x, m);
}

void EditedFactor::add_change(double* z, Index channels, bool transposed) const {
  Vector<double> x(k_ * at(channels), &memory_);
  project_own(z, channels, x.data());
  apply(x.data(), at(channels), transposed);
  combine_own(x.data(), channels, z);
}

// The rim's paths, and their products: C of the rim.
void EditedFactor::form_rim(Span<const Index> unknowns, JobRunner& jobs) {
  Vector<Index> start(rim_ + 1, &memory_), group(rim_, &memory_), column(rim_, &memory_);
  for (std::size_t i = 0; i <= rim_; ++i) start[i] = static_cast<Index>(i);
  const Vector<double> ones(rim_, 1.0, &memory_);
  base_->solve_paths({start, unknowns, ones}, memory_, jobs, paths_, group, column);
  Vector<Index> row_at(paths_.size() * at(tile), -1, &memory_);
  for (std::size_t i = 0; i < rim_; ++i) {
    place_[i] = {group[i], column[i]};
    row_at[at(group[i] * tile + column[i])] = static_cast<Index>(i);
  }
  jobs.for_each(static_cast<std::uint32_t>(paths_.size()), [&](std::uint32_t a) {
    double products[tile * tile];
    for (std::size_t b = 0; b <= a; ++b) {
      base_->gram(*paths_[a], *paths_[b], products, tile);
      for (Index i = 0; i < paths_[a]->count(); ++i) {
        for (Index j = 0; j < paths_[b]->count(); ++j) {
          const Index row = row_at[a * at(tile) + at(i)], other = row_at[b * at(tile) + at(j)];
          if (row < 0 || other < 0) continue;
          gram_[at(row) * rim_ + at(other)] = products[i * tile + j];
          gram_[at(other) * rim_ + at(row)] = products[i * tile + j];
        }
      }
    }
  });
}

// L by blocks, the inside first. With X = A_ri A_ii^-1 (r: the rim, i: the inside) the rim's rows of F = H' B^-1 are
// H' [I, -X]. Then I + F D F' has, with the factor H_after of A'_ii,
//
//     L_ii = H^-1 H_after,   L_ri = (F D)_i H_after'^-1,   L_rr L_rr' = I + F D F' - L_ri L_ri'
//
// So a soft inside beside a stiff one keeps its digits, which a factorisation of I + F D F' as it is would lose. H'
// comes before D, which takes differences of neighbours. number: a column of V by position in `unknown`.
void EditedFactor::form_change(const MatrixChange& change, const Vector<std::size_t>& number) {
  Vector<double> x(inside_ * rim_, 0.0, &memory_);  // X'
  for (const MatrixChange::Entry& entry : change.inside_entries) {
    const std::size_t row = number[at(entry.row)], column = number[at(entry.column)];
    if (row >= rim_ && column < rim_) x[(row - rim_) * rim_ + column] = entry.value;
  }
  inside_before_.solve(x.data(), rim_);
  inside_before_.solve_transposed(x.data(), rim_);
  poll();
  Vector<double> f(k_ * rim_, 0.0, &memory_),
      product(k_ * rim_, 0.0, &memory_);  // the rim's rows of F and F D, by column
  for (std::size_t c = 0; c < rim_; ++c) {
    for (std::size_t a = 0; a <= c; ++a) f[c * rim_ + a] = rim_before_.at(c, a);
  }
  for (std::size_t i = 0; i < inside_; ++i) {
    for (std::size_t a = 0; a < rim_; ++a) {
      double sum = 0;
      for (std::size_t b = a; b < rim_; ++b) sum += rim_before_.at(b, a) * x[i * rim_ + b];
      f[(rim_ + i) * rim_ + a] = -sum;
    }
  }
  for (const MatrixChange::Entry& entry : change.entries) {
    const double* const row = &f[number[at(entry.row)] * rim_];
    double* const out = &product[number[at(entry.column)] * rim_];
    for (std::size_t a = 0; a < rim_; ++a) out[a] += entry.value * row[a];
  }
  poll();
  coupling_.assign(product.begin() + static_cast<std::ptrdiff_t>(rim_ * rim_), product.end());
  inside_after_.solve(coupling_.data(), rim_);
  // the lower triangle += factor * (left right')
  const auto add = [this](double factor, const double* left, const double* right) {
    for (std::size_t b = 0; b < rim_; ++b) {
      double* const out = rim_after_.column(b);
      const double scaled = factor * right[b];
      for (std::size_t a = b; a < rim_; ++a) out[a] += scaled * left[a];
    }
  };
  for (std::size_t c = 0; c < k_; ++c) add(1, &product[c * rim_], &f[c * rim_]);
  for (std::size_t i = 0; i < inside_; ++i) add(-1, &coupling_[i * rim_], &coupling_[i * rim_]);
  for (std::size_t a = 0; a < rim_; ++a) rim_after_.at(a, a) += 1;
  // what the change of each unknown is to A^-1 there: F'F of the rim's rows, and A_ii^-1
  Vector<double> column(inside_, &memory_);
  for (const MatrixChange::Entry& entry : change.entries) {
    if (entry.row != entry.column) continue;
    const std::size_t c = number[at(entry.row)];
    double inverse = c < rim_ ? 0.0 : inside_before_.inverse_at(c - rim_, column.data());
    for (std::size_t a = 0; a < rim_; ++a) inverse += f[c * rim_ + a] * f[c * rim_ + a];
    ratio_[c] = std::fabs(entry.value) * inverse;
  }
}

void EditedFactor::prepare(const MatrixChange& change, JobRunner& jobs) {
  Vector<std::size_t> number(k_, k_, &memory_);
  Vector<Index> unknown(k_, &memory_);  // by column of V
  for (std::size_t i = 0; i < inside_; ++i) number[at(change.inside[i])] = rim_ + i;
  std::size_t next = 0;
  for (std::size_t p = 0; p < k_; ++p) {
    if (number[p] == k_) number[p] = next++;
    unknown[number[p]] = change.unknown[p];
  }
  unknown_.assign(unknown.begin() + static_cast<std::ptrdiff_t>(rim_), unknown.end());
  const auto require = [&](Index failed, std::size_t first, const char* what) {
    if (failed < 0) return;
    const Index v = unknown[first + at(failed)];
    fail(HF_ERROR_NOT_POSITIVE_DEFINITE, static_cast<std::uint32_t>(v), what, v);
  };
  constexpr const char* lost = "the edited matrix lost its digits at unknown %d";
  form_rim({unknown.data(), rim_}, jobs);
  poll();
  for (std::size_t j = 0; j < rim_; ++j) std::copy_n(&gram_[j * rim_ + j], rim_ - j, rim_before_.column(j) + j);
  require(rim_before_.factorise(), 0, lost);
  const auto add_inside = [&](const Vector<MatrixChange::Entry>& entries, Lower& out) {
    for (const MatrixChange::Entry& entry : entries) {
      const std::size_t row = number[at(entry.row)], column = number[at(entry.column)];
      if (row >= rim_ && column >= rim_) out.at(row - rim_, column - rim_) += entry.value;
    }
  };
  add_inside(change.inside_entries, inside_before_);
  add_inside(change.inside_entries, inside_after_);
  add_inside(change.entries, inside_after_);
  for (const MatrixChange::Entry& entry : change.inside_entries) {
    const std::size_t row = number[at(entry.row)], column = number[at(entry.column)];
    if (row >= rim_ && column >= rim_) entries_.push_back({row - rim_, column - rim_, entry.value});
  }
  constexpr const char* indefinite = "the edited matrix is not positive definite at unknown %d";
  require(inside_before_.factorise(), rim_, lost);
  require(inside_after_.factorise(), rim_, indefinite);
  form_change(change, number);
  poll();
  require(rim_after_.factorise(), 0, indefinite);
  for (std::size_t c = 0; c < k_; ++c) {
    const double l =
        c < rim_ ? rim_after_.at(c, c) : inside_after_.at(c - rim_, c - rim_) / inside_before_.at(c - rim_, c - rim_);
    statistics_.rounding = std::max(statistics_.rounding, 0x1p-52 * ratio_[c] / std::min(1.0, l * l));
  }
  for (const auto& own : paths_) statistics_.bytes += own->bytes();
  statistics_.bytes += 12.0 * static_cast<double>(rows_.value.size()) +
                       8.0 * static_cast<double>(3 * rim_ * rim_ + 2 * inside_ * inside_ + inside_ * rim_);
}

void EditedFactor::solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                               Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<Index> out_group,
                               Span<Index> out_column) const {
  const std::size_t first = out_groups.size();
  base_->solve_paths(columns, memory, jobs, out_groups, out_group, out_column);
  double products[tile * tile];
  for (std::size_t g = first; g < out_groups.size(); ++g) {
    const auto group = make_shared_in<EditedPaths>(memory, out_groups[g], memory);
    const std::size_t m = at(group->count());
    group->product.assign(k_ * m, 0.0);
    Vector<std::size_t> row(paths_.size() * at(tile), k_, &memory);
    for (std::size_t i = 0; i < rim_; ++i) row[at(place_[i].group * tile + place_[i].column)] = i;
    for (std::size_t own = 0; own < paths_.size(); ++own) {
      base_->gram(*paths_[own], group->base(), products, tile);
      for (Index i = 0; i < paths_[own]->count(); ++i) {
        const std::size_t place = row[own * at(tile) + at(i)];
        if (place < k_) std::copy_n(products + i * tile, m, &group->product[place * m]);
      }
    }
    for (std::size_t i = 0; i < out_group.size(); ++i) {
      if (at(out_group[i]) != g) continue;
      for (Index e = columns.start[i]; e < columns.start[i + 1]; ++e) {
        const auto there = std::lower_bound(unknown_.begin(), unknown_.end(), columns.row[at(e)]);
        if (there == unknown_.end() || *there != columns.row[at(e)]) continue;
        const std::size_t row = rim_ + static_cast<std::size_t>(there - unknown_.begin());
        group->product[row * m + at(out_column[i])] += columns.value[at(e)];
      }
    }
    group->added.assign(group->product.begin(), group->product.end());
    apply(group->added.data(), m, false);
    group->whole.assign(group->product.begin(), group->product.end());
    const auto add = [&](std::size_t i, std::size_t j, double c) {
      for (std::size_t q = 0; q < m; ++q) group->whole[i * m + q] += c * group->added[j * m + q];
    };
    for (std::size_t i = 0; i < rim_; ++i) {
      for (std::size_t j = 0; j < rim_; ++j) add(i, j, gram_[i * rim_ + j]);
    }
    for (const Entry& entry : entries_) add(rim_ + entry.row, rim_ + entry.column, entry.value);
    out_groups[g] = group;
  }
}

// (y_a + Y x_a)'(y_b + Y x_b) = y_a'y_b + (Y'y_a)'x_b + x_a'(Y'(y_b + Y x_b)).
void EditedFactor::gram(const PathGroup& first, const PathGroup& second, double* gram, Index ld) const {
  const EditedPaths &a = of(first), &b = of(second);
  base_->gram(a.base(), b.base(), gram, ld);
  const std::size_t m = at(a.count()), n = at(b.count());
  for (std::size_t r = 0; r < k_; ++r) {
    const double *pa = &a.product[r * m], *xa = &a.added[r * m], *xb = &b.added[r * n], *qb = &b.whole[r * n];
    for (std::size_t i = 0; i < m; ++i) {
      double* const out = gram + i * at(ld);
      for (std::size_t j = 0; j < n; ++j) out[j] += pa[i] * xb[j] + xa[i] * qb[j];
    }
  }
}

void EditedFactor::combine(const PathGroup& group, const double* lambda, Index channels, double* z) const {
  const EditedPaths& paths = of(group);
  base_->combine(paths.base(), lambda, channels, z);
  const std::size_t m = at(channels), n = at(paths.count());
  Vector<double> x(k_ * m, 0.0, &memory_);
  for (std::size_t r = 0; r < k_; ++r) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t q = 0; q < m; ++q) x[r * m + q] += paths.added[r * n + i] * lambda[i * m + q];
    }
  }
  combine_own(x.data(), channels, z);
}

void EditedFactor::project(const PathGroup& group, const double* z, Index channels, double* out) const {
  const EditedPaths& paths = of(group);
  base_->project(paths.base(), z, channels, out);
  const std::size_t m = at(channels), n = at(paths.count());
  Vector<double> x(k_ * m, &memory_);
  project_own(z, channels, x.data());
  for (std::size_t r = 0; r < k_; ++r) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t q = 0; q < m; ++q) out[i * m + q] += paths.added[r * n + i] * x[r * m + q];
    }
  }
}

}  // namespace

std::shared_ptr<const Factor> edit_factor(std::shared_ptr<const Factor> base, const MatrixChange& change,
                                          Memory& memory, JobRunner& jobs) {
  if (change.unknown.empty()) return base;
  SparseVectors rows(memory);
  Vector<Index> inside(&memory);
  for (const Index p : change.inside) inside.push_back(change.unknown[at(p)]);
  const bool whole_rim = inside.empty() || !base->rows_of(inside, rows);
  const std::size_t count = whole_rim ? 0 : inside.size(), rim = change.unknown.size() - count;
  const auto made = make_shared_in<EditedFactor>(memory, std::move(base), rim, count, std::move(rows), memory);
  made->prepare(change, jobs);
  return made;
}

}  // namespace hf_inner
