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
  const double* column(std::size_t j) const noexcept { return value.data() + j * size; }
  double* column(std::size_t j) noexcept { return value.data() + j * size; }

  // Replaces a symmetric matrix by its Cholesky factor. Returns -1, or the first row without a positive pivot.
  Index factorise() noexcept {
    for (std::size_t j = 0; j < size; ++j) {
      double* const own = column(j);
      if (!(own[j] > 0)) return static_cast<Index>(j);
      const double scale = 1 / std::sqrt(own[j]);
      for (std::size_t i = j; i < size; ++i) own[i] *= scale;
      for (std::size_t c = j + 1; c < size; ++c) {
        const double factor = own[c];
        double* const other = column(c);
        for (std::size_t i = c; i < size; ++i) other[i] -= factor * own[i];
      }
    }
    return -1;
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
  EditedFactor(std::shared_ptr<const Factor> base, std::size_t k, Memory& memory)
      : base_(std::move(base)),
        memory_(memory),
        k_(k),
        statistics_(base_->statistics()),
        paths_(&memory),
        place_(k, &memory),
        gram_(k * k, 0.0, &memory),
        inner_(k, memory),
        outer_(k, memory) {}

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
    for (const auto& group : paths_) base_->clear(*group, channels, z);
  }
  std::shared_ptr<const Factor> refactor(const SymmetricMatrix& matrix, Span<const std::uint8_t> eliminated,
                                         Memory& memory, JobRunner& jobs) const override {
    return base_->refactor(matrix, eliminated, memory, jobs);
  }
  void solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                   Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<Index> out_group,
                   Span<Index> out_column) const override;
  void gram(const PathGroup& a, const PathGroup& b, double* gram, Index ld) const override;
  void combine(const PathGroup& group, const double* lambda, Index channels, double* z) const override;
  void clear(const PathGroup& group, Index channels, double* z) const override {
    base_->clear(of(group).base(), channels, z);
    for (const auto& own : paths_) base_->clear(*own, channels, z);
  }
  void project(const PathGroup& group, const double* z, Index channels, double* out) const override;

 private:
  static const EditedPaths& of(const PathGroup& group) noexcept { return static_cast<const EditedPaths&>(group); }
  // out[i * channels + q] = y_i' z for the paths y_i of R.
  void project_own(const double* z, Index channels, double* out) const;
  // z += Y x.
  void combine_own(const double* x, Index channels, double* z) const;
  // Replaces x by W x, or by W' x.
  void apply(double* x, std::size_t m, bool transposed) const;
  void add_change(double* z, Index channels, bool transposed) const;

  std::shared_ptr<const Factor> base_;
  Memory& memory_;
  std::size_t k_;
  FactorStatistics statistics_;
  Vector<std::shared_ptr<const PathGroup>> paths_;  // of R
  struct Place {
    Index group, column;
  };
  Vector<Place> place_;  // by position in R
  Vector<double> gram_;  // C, both triangles
  Lower inner_, outer_;  // H and L
};

void EditedFactor::project_own(const double* z, Index channels, double* out) const {
  const std::size_t m = at(channels);
  Vector<double> products(paths_.size() * at(tile) * m, &memory_);
  for (std::size_t g = 0; g < paths_.size(); ++g)
    base_->project(*paths_[g], z, channels, products.data() + g * at(tile) * m);
  for (std::size_t i = 0; i < k_; ++i)
    std::copy_n(&products[(at(place_[i].group) * at(tile) + at(place_[i].column)) * m], m, out + i * m);
}

void EditedFactor::combine_own(const double* x, Index channels, double* z) const {
  const std::size_t m = at(channels);
  Vector<double> factors(paths_.size() * at(tile) * m, 0.0, &memory_);
  for (std::size_t i = 0; i < k_; ++i)
    std::copy_n(x + i * m, m, &factors[(at(place_[i].group) * at(tile) + at(place_[i].column)) * m]);
  for (std::size_t g = 0; g < paths_.size(); ++g)
    base_->combine(*paths_[g], factors.data() + g * at(tile) * m, channels, z);
}

// W = H'^-1 (L^-1 - I) H^-1.
void EditedFactor::apply(double* x, std::size_t m, bool transposed) const {
  inner_.solve(x, m);
  Vector<double> before(x, x + k_ * m, &memory_);
  transposed ? outer_.solve_transposed(x, m) : outer_.solve(x, m);
  for (std::size_t i = 0; i < k_ * m; ++i) x[i] -= before[i];
  inner_.solve_transposed(x, m);
}

void EditedFactor::add_change(double* z, Index channels, bool transposed) const {
  Vector<double> x(k_ * at(channels), &memory_);
  project_own(z, channels, x.data());
  apply(x.data(), at(channels), transposed);
  combine_own(x.data(), channels, z);
}

void EditedFactor::prepare(const MatrixChange& change, JobRunner& jobs) {
  Vector<Index> start(k_ + 1, &memory_), group(k_, &memory_), column(k_, &memory_);
  for (std::size_t i = 0; i <= k_; ++i) start[i] = static_cast<Index>(i);
  const Vector<double> ones(k_, 1.0, &memory_);
  base_->solve_paths({start, change.unknown, ones}, memory_, jobs, paths_, group, column);
  Vector<Index> row_at(paths_.size() * at(tile), -1, &memory_);
  for (std::size_t i = 0; i < k_; ++i) {
    place_[i] = {group[i], column[i]};
    row_at[at(group[i] * tile + column[i])] = static_cast<Index>(i);
  }
  // C, one pair of groups at a time
  const std::size_t groups = paths_.size();
  jobs.for_each(static_cast<std::uint32_t>(groups), [&](std::uint32_t a) {
    double products[tile * tile];
    for (std::size_t b = 0; b <= a; ++b) {
      base_->gram(*paths_[a], *paths_[b], products, tile);
      for (Index i = 0; i < paths_[a]->count(); ++i) {
        for (Index j = 0; j < paths_[b]->count(); ++j) {
          const Index row = row_at[a * at(tile) + at(i)], other = row_at[b * at(tile) + at(j)];
          if (row < 0 || other < 0) continue;
          gram_[at(row) * k_ + at(other)] = products[i * tile + j];
          gram_[at(other) * k_ + at(row)] = products[i * tile + j];
        }
      }
    }
  });
  poll();
  for (std::size_t j = 0; j < k_; ++j) std::copy_n(&gram_[j * k_ + j], k_ - j, inner_.column(j) + j);
  Index failed = inner_.factorise();
  if (failed >= 0)
    fail(HF_ERROR_NOT_POSITIVE_DEFINITE, static_cast<std::uint32_t>(change.unknown[at(failed)]),
         "the edited matrix lost its digits at unknown %d", change.unknown[at(failed)]);
  poll();
  // I + H' (D H), with H lower triangular: column j of D H needs column j of H alone
  Vector<double> product(k_, &memory_);
  for (std::size_t j = 0; j < k_; ++j) {
    std::fill(product.begin(), product.end(), 0.0);
    const double* const h = inner_.column(j);
    for (const MatrixChange::Entry& entry : change.entries) {
      if (at(entry.column) >= j) product[at(entry.row)] += entry.value * h[entry.column];
    }
    for (std::size_t i = j; i < k_; ++i) {
      const double* const left = inner_.column(i);
      double sum[4] = {0, 0, 0, 0};
      std::size_t r = i;
      for (; r + 4 <= k_; r += 4) {
        for (std::size_t lane = 0; lane < 4; ++lane) sum[lane] += left[r + lane] * product[r + lane];
      }
      for (; r < k_; ++r) sum[0] += left[r] * product[r];
      outer_.at(i, j) = (sum[0] + sum[1]) + (sum[2] + sum[3]) + (i == j ? 1.0 : 0.0);
    }
  }
  poll();
  failed = outer_.factorise();
  if (failed >= 0)
    fail(HF_ERROR_NOT_POSITIVE_DEFINITE, static_cast<std::uint32_t>(change.unknown[at(failed)]),
         "the edited matrix is not positive definite at unknown %d", change.unknown[at(failed)]);
  double largest = 0, least = 1;  // least: of the pivots of L, which soft regions make small
  for (const MatrixChange::Entry& entry : change.entries) {
    if (entry.row == entry.column)
      largest = std::max(largest, std::fabs(entry.value) * gram_[at(entry.row) * (k_ + 1)]);
  }
  for (std::size_t i = 0; i < k_; ++i) least = std::min(least, outer_.at(i, i) * outer_.at(i, i));
  statistics_.rounding = 0x1p-52 * largest / least;
  for (const auto& own : paths_) statistics_.bytes += own->bytes();
  statistics_.bytes += 24.0 * static_cast<double>(k_ * k_);
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
    group->product.resize(k_ * m);
    Vector<std::size_t> row(paths_.size() * at(tile), k_, &memory);
    for (std::size_t i = 0; i < k_; ++i) row[at(place_[i].group * tile + place_[i].column)] = i;
    for (std::size_t own = 0; own < paths_.size(); ++own) {
      base_->gram(*paths_[own], group->base(), products, tile);
      for (Index i = 0; i < paths_[own]->count(); ++i) {
        const std::size_t place = row[own * at(tile) + at(i)];
        if (place < k_) std::copy_n(products + i * tile, m, &group->product[place * m]);
      }
    }
    group->added.assign(group->product.begin(), group->product.end());
    apply(group->added.data(), m, false);
    group->whole.assign(group->product.begin(), group->product.end());
    for (std::size_t i = 0; i < k_; ++i) {
      for (std::size_t j = 0; j < k_; ++j) {
        const double c = gram_[i * k_ + j];
        for (std::size_t q = 0; q < m; ++q) group->whole[i * m + q] += c * group->added[j * m + q];
      }
    }
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
  const auto made = make_shared_in<EditedFactor>(memory, std::move(base), change.unknown.size(), memory);
  made->prepare(change, jobs);
  return made;
}

}  // namespace hf_inner
