#include "factor/edited_factor.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner::factor {
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

  std::size_t size;
  Vector<double> value;
};

// The paths T^-1 y of some sites: the paths y of the base, and what T^-1 adds to them.
class EditedPaths final : public PathGroup {
 public:
  EditedPaths(std::shared_ptr<const PathGroup> base, Memory& memory)
      : base_(std::move(base)), product(&memory), added(&memory), changed(&memory) {}
  Index count() const noexcept override { return base_->count(); }
  double bytes() const noexcept override {
    return base_->bytes() + 8.0 * static_cast<double>(product.size() + added.size() + changed.size());
  }
  const PathGroup& base() const noexcept { return *base_; }
  std::shared_ptr<const PathGroup> shared_base() const noexcept { return base_; }

 private:
  std::shared_ptr<const PathGroup> base_;

 public:
  Vector<double> product;   // [k][count] Y'y
  Vector<double> added;     // [k][count] W Y'y: the path is y + Y added
  Vector<double> changed;   // [k][count] M Y'y with M = W + W' + W'CW: products of paths change by (Y'y)' M Y'y
  bool has_inside = false;  // a site inside: its products with the inside are not all 0
};

// Probes of the inside's inverse: signs at random. With 16 its diagonal is known to a third, enough for a rounding.
constexpr Index probes = 16;

class EditedFactor final : public Factor {
 public:
  EditedFactor(std::shared_ptr<const Factor> base, std::size_t rim, std::size_t inside, Memory& memory)
      : base_(std::move(base)),
        memory_(memory),
        rim_(rim),
        inside_(inside),
        k_(rim + inside),
        statistics_(base_->statistics()),
        paths_(&memory),
        place_(rim, &memory),
        rows_(memory),
        unknown_(&memory),
        gram_(rim * rim, 0.0, &memory),
        entries_(&memory),
        rim_before_(rim, memory),
        rim_after_(rim, memory),
        coupling_(&memory) {}

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
  std::shared_ptr<const Factor> refactor_in_order(const SymmetricMatrix& matrix, Span<const Index> order,
                                                  Span<const std::uint8_t> eliminated, Memory& memory,
                                                  JobRunner& jobs) const override {
    return base_->refactor_in_order(matrix, order, eliminated, memory, jobs);
  }
  void solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                   Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<Index> out_group,
                   Span<Index> out_column) const override;
  bool rows_of(Span<const Index>, SparseVectors&) const override { return false; }
  void gram(const PathGroup& a, const PathGroup& b, double* gram, Index ld) const override {
    base_->gram(of(a).base(), of(b).base(), gram, ld);
    add_own_products(a, b, gram, ld);
  }
  void add_edit_products(const PathGroup& a, const PathGroup& b, double* gram, Index ld) const override {
    base_->add_edit_products(of(a).base(), of(b).base(), gram, ld);
    add_own_products(a, b, gram, ld);
  }
  void combine(const PathGroup& group, const double* lambda, Index channels, double* z) const override;
  void clear(const PathGroup& group, Index channels, double* z) const override {
    base_->clear(of(group).base(), channels, z);
    clear_own(channels, z);
  }
  void project(const PathGroup& group, const double* z, Index channels, double* out) const override;
  const Factor& path_base() const noexcept override { return base_->path_base(); }

 protected:
  std::shared_ptr<const PathGroup> base_paths(std::shared_ptr<const PathGroup> group) const override {
    return base_paths_of(*base_, of(*group).shared_base());
  }
  std::shared_ptr<const PathGroup> own_paths(std::shared_ptr<const PathGroup> base, const SparseColumns& columns,
                                             Memory& memory) const override;

 private:
  // An entry of both matrices in the block of the inside.
  struct Entry {
    Index row, column;
    double before, change;
  };
  static const EditedPaths& of(const PathGroup& group) noexcept { return static_cast<const EditedPaths&>(group); }
  void add_own_products(const PathGroup& a, const PathGroup& b, double* gram, Index ld) const;
  void add_inside(const SparseColumns& columns, std::size_t site, std::size_t column, EditedPaths& group) const;
  template <class AddInside>
  std::shared_ptr<const PathGroup> edited_paths(std::shared_ptr<const PathGroup> base, Memory& memory,
                                                AddInside&& add_inside_of) const;
  void form_rim(Span<const Index> unknowns, JobRunner& jobs);
  void factorise_inside(const MatrixChange& change, JobRunner& jobs);
  void form_change(const MatrixChange& change, Span<const Index> number, JobRunner& jobs);
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
  std::size_t rim_, inside_, k_;  // columns of V: first the rim's, then the inside's
  FactorStatistics statistics_;
  Vector<std::shared_ptr<const PathGroup>> paths_;  // of the rim
  struct Place {
    Index group, column;
  };
  Vector<Place> place_;    // by column of V
  SparseVectors rows_;     // of G, of the inside
  Vector<Index> unknown_;  // the inside in the caller's numbering, ascending; its columns of V are in the order of the
                           // factors below
  Vector<double> gram_;    // C of the rim, both triangles
  Vector<Entry> entries_;  // of the inside, by ascending unknown; `before` is C of the inside
  Lower rim_before_, rim_after_;  // H and L of the rim
  // H of the inside and H L, the factors of A and A' there. Null without an inside.
  std::shared_ptr<const Factor> inside_before_, inside_after_;
  Vector<double> coupling_;  // [inside][rim] L between the two, transposed
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
  JobRunner alone(1);
  const Index channels = static_cast<Index>(m);
  double* const inside = x + rim_ * m;
  Vector<double> y(x, x + k_ * m, &memory_);
  double* const y_inside = y.data() + rim_ * m;
  const auto couple = [&](auto&& take) {
    for (std::size_t i = 0; i < inside_; ++i) {
      for (std::size_t a = 0; a < rim_; ++a) take(coupling_[i * rim_ + a], y_inside + i * m, y.data() + a * m);
    }
  };
  if (inside_before_) inside_before_->forward(inside, channels, alone);
  rim_before_.solve(x, m);
  std::copy_n(x, rim_ * m, y.data());
  if (transposed) {
    rim_after_.solve_transposed(y.data(), m);
    std::copy_n(inside, inside_ * m, y_inside);
    couple([&](double value, double* of_inside, const double* of_rim) {
      for (std::size_t q = 0; q < m; ++q) of_inside[q] -= value * of_rim[q];
    });
    if (inside_after_) inside_after_->backward(y_inside, channels, alone);
    if (inside_before_) inside_before_->backward(inside, channels, alone);
    for (std::size_t i = 0; i < inside_ * m; ++i) inside[i] = y_inside[i] - inside[i];
  } else {
    if (inside_after_) inside_after_->forward(y_inside, channels, alone);
    couple([&](double value, const double* of_inside, double* of_rim) {
      for (std::size_t q = 0; q < m; ++q) of_rim[q] -= value * of_inside[q];
    });
    rim_after_.solve(y.data(), m);
    for (std::size_t i = 0; i < inside_ * m; ++i) inside[i] = y_inside[i] - inside[i];
    if (inside_before_) inside_before_->backward(inside, channels, alone);
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

// The two factors of the inside, of A and of A'. Entry (i, j) of a factor's matrix belongs to the i-th and the j-th
// unknown inside.
void EditedFactor::factorise_inside(const MatrixChange& change, JobRunner& jobs) {
  Vector<Index> number(k_, -1, &memory_);  // in the inside, by position in `unknown`
  for (std::size_t i = 0; i < inside_; ++i) number[at(change.inside[i])] = static_cast<Index>(i);
  const auto ascend = [](const Entry& a, const Entry& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  };
  const auto list = [&](const Vector<MatrixChange::Entry>& entries, bool is_change) {
    Vector<Entry> out(&memory_);
    for (const MatrixChange::Entry& entry : entries) {
      const Index row = number[at(entry.row)], column = number[at(entry.column)];
      if (row < 0 || column < 0) continue;
      out.push_back({row, column, is_change ? 0.0 : entry.value, is_change ? entry.value : 0.0});
    }
    std::sort(out.begin(), out.end(), ascend);
    return out;
  };
  // sorted apart and merged: std::sort takes its longest on one sorted list behind another
  const Vector<Entry> before = list(change.inside_entries, false), changed = list(change.entries, true);
  entries_.resize(before.size() + changed.size());
  std::merge(before.begin(), before.end(), changed.begin(), changed.end(), entries_.begin(), ascend);
  std::size_t kept = 0;
  for (const Entry& entry : entries_) {
    Entry* const last = kept > 0 ? &entries_[kept - 1] : nullptr;
    if (last && last->row == entry.row && last->column == entry.column) {
      last->before += entry.before;
      last->change += entry.change;
    } else {
      entries_[kept++] = entry;
    }
  }
  entries_.resize(kept);
  SymmetricMatrix matrix(memory_);
  matrix.column_start.push_back(0);
  for (std::size_t e = 0; e < kept; ++e) {
    matrix.row.push_back(entries_[e].column);
    matrix.value.push_back(entries_[e].before);
    if (e + 1 == kept || entries_[e + 1].row != entries_[e].row)
      matrix.column_start.push_back(static_cast<Index>(e + 1));
  }
  FactorOptions options;
  options.ordering = Ordering::minimum_degree;
  inside_before_ = Factor::make(matrix, {}, options, memory_, jobs);
  for (std::size_t e = 0; e < kept; ++e) matrix.value[e] += entries_[e].change;
  inside_after_ = inside_before_->refactor(matrix, {}, memory_, jobs);
}

// L by blocks, the inside first. With X = A_ri A_ii^-1 (r: the rim, i: the inside) the rim's rows of F = H' B^-1 are
// H' [I, -X]. Then I + F D F' has, with the factor H_after of A'_ii,
//
//     L_ii = H^-1 H_after,   L_ri = (F D)_i H_after'^-1,   L_rr L_rr' = I + F D F' - L_ri L_ri'
//
// So a soft inside beside a stiff one keeps its digits, which a factorisation of I + F D F' as it is would lose. H'
// comes before D, which takes differences of neighbours. number: a column of V by position in `unknown`.
void EditedFactor::form_change(const MatrixChange& change, Span<const Index> number, JobRunner& jobs) {
  const Index rim = static_cast<Index>(rim_);
  Vector<double> x(inside_ * rim_, 0.0, &memory_);  // X'
  for (const MatrixChange::Entry& entry : change.inside_entries) {
    const Index row = number[at(entry.row)], column = number[at(entry.column)];
    if (row >= rim && column < rim) x[at(row - rim) * rim_ + at(column)] = entry.value;
  }
  if (inside_before_ && rim > 0) inside_before_->solve_in_order(x.data(), rim, jobs);
  Vector<double> f(k_ * rim_, 0.0, &memory_), product(k_ * rim_, 0.0, &memory_);  // the rim's rows of F and F D
  for (std::size_t c = 0; c < rim_; ++c) {
    for (std::size_t a = 0; a <= c; ++a) f[c * rim_ + a] = rim_before_.at(c, a);
  }
  for (std::size_t i = 0; i < inside_; ++i) {
    double* const out = &f[(rim_ + i) * rim_];
    for (std::size_t c = 0; c < rim_; ++c) {
      const double* const h = &f[c * rim_];
      const double factor = x[i * rim_ + c];
      for (std::size_t a = 0; a <= c; ++a) out[a] -= factor * h[a];
    }
  }
  for (const MatrixChange::Entry& entry : change.entries) {
    const double* const row = &f[at(number[at(entry.row)]) * rim_];
    double* const out = &product[at(number[at(entry.column)]) * rim_];
    for (std::size_t a = 0; a < rim_; ++a) out[a] += entry.value * row[a];
  }
  poll();
  coupling_.assign(product.begin() + static_cast<std::ptrdiff_t>(rim_ * rim_), product.end());
  if (inside_after_ && rim > 0) inside_after_->forward(coupling_.data(), rim, jobs);
  // the lower triangle += the sum of factor * (left_c right_c'), four at once, so that it is read a fourth as often
  const auto add = [this](double factor, const double* left, const double* right, std::size_t count) {
    std::size_t c = 0;
    for (; c + 4 <= count; c += 4, left += 4 * rim_, right += 4 * rim_) {
      const double *const x0 = left, *const x1 = x0 + rim_, *const x2 = x1 + rim_, *const x3 = x2 + rim_;
      for (std::size_t b = 0; b < rim_; ++b) {
        double* const out = rim_after_.column(b);
        const double f0 = factor * right[b], f1 = factor * right[rim_ + b], f2 = factor * right[2 * rim_ + b],
                     f3 = factor * right[3 * rim_ + b];
        for (std::size_t a = b; a < rim_; ++a) out[a] += (f0 * x0[a] + f1 * x1[a]) + (f2 * x2[a] + f3 * x3[a]);
      }
    }
    for (; c < count; ++c, left += rim_, right += rim_) {
      for (std::size_t b = 0; b < rim_; ++b) {
        double* const out = rim_after_.column(b);
        for (std::size_t a = b; a < rim_; ++a) out[a] += factor * right[b] * left[a];
      }
    }
  };
  add(1, product.data(), f.data(), k_);
  add(-1, coupling_.data(), coupling_.data(), inside_);
  for (std::size_t a = 0; a < rim_; ++a) rim_after_.at(a, a) += 1;
  // D_ii (A^-1)_ii of the inside: F'F of the rim's rows, and A_ii^-1
  if (!inside_before_) return;
  Vector<double> probe(inside_ * at(probes), &memory_);
  std::minstd_rand random(1);
  for (double& sign : probe) sign = (random() >> 15) % 2 == 0 ? 1 : -1;
  inside_before_->backward(probe.data(), probes, jobs);
  for (const Entry& entry : entries_) {
    if (entry.row != entry.column) continue;
    const std::size_t i = at(inside_before_->position()[at(entry.row)]);
    double inverse = 0;
    for (Index q = 0; q < probes; ++q)
      inverse += probe[i * at(probes) + at(q)] * probe[i * at(probes) + at(q)] / probes;
    for (std::size_t a = 0; a < rim_; ++a) inverse += f[(rim_ + i) * rim_ + a] * f[(rim_ + i) * rim_ + a];
    const double softer = std::min(1.0, (entry.before + entry.change) / entry.before);
    statistics_.rounding = std::max(statistics_.rounding, 0x1p-52 * std::fabs(entry.change) * inverse / softer);
  }
}

void EditedFactor::prepare(const MatrixChange& change, JobRunner& jobs) {
  const auto refuse = [](Index v, const char* what) {
    fail(HF_ERROR_NOT_POSITIVE_DEFINITE, static_cast<std::uint32_t>(v), what, v);
  };
  constexpr const char* indefinite = "the edited matrix is not positive definite at unknown %d";
  for (std::size_t i = 0; i < inside_; ++i) unknown_.push_back(change.unknown[at(change.inside[i])]);
  if (inside_ > 0) {
    try {
      factorise_inside(change, jobs);
    } catch (const Error& error) {
      if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE) throw;
      refuse(unknown_[error.index()], indefinite);
    }
  }
  // columns of V: the rim, then the inside in the order of its factors
  Vector<Index> number(k_, -1, &memory_), unknown(k_, &memory_);
  for (std::size_t i = 0; i < inside_; ++i)
    number[at(change.inside[i])] = static_cast<Index>(rim_) + inside_before_->position()[i];
  Index next = 0;
  for (std::size_t p = 0; p < k_; ++p) {
    if (number[p] < 0) number[p] = next++;
    unknown[at(number[p])] = change.unknown[p];
  }
  if (inside_ > 0) base_->rows_of({unknown.data() + rim_, inside_}, rows_);
  form_rim({unknown.data(), rim_}, jobs);
  poll();
  for (std::size_t j = 0; j < rim_; ++j) std::copy_n(&gram_[j * rim_ + j], rim_ - j, rim_before_.column(j) + j);
  Index failed = rim_before_.factorise();
  if (failed >= 0) refuse(unknown[at(failed)], "the edited matrix lost its digits at unknown %d");
  form_change(change, number, jobs);
  poll();
  failed = rim_after_.factorise();
  if (failed >= 0) refuse(unknown[at(failed)], indefinite);
  for (const MatrixChange::Entry& entry : change.entries) {
    const std::size_t c = at(number[at(entry.row)]);
    if (entry.row != entry.column || c >= rim_) continue;
    const double l = rim_after_.at(c, c), ratio = std::fabs(entry.value) * gram_[c * (rim_ + 1)];
    statistics_.rounding = std::max(statistics_.rounding, 0x1p-52 * ratio / std::min(1.0, l * l));
  }
  for (const auto& own : paths_) statistics_.bytes += own->bytes();
  if (inside_ > 0) statistics_.bytes += inside_before_->statistics().bytes + inside_after_->statistics().bytes;
  statistics_.bytes += 12.0 * static_cast<double>(rows_.value.size()) + 32.0 * static_cast<double>(entries_.size()) +
                       8.0 * static_cast<double>(3 * rim_ * rim_ + inside_ * rim_);
}

void EditedFactor::solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                               Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<Index> out_group,
                               Span<Index> out_column) const {
  const std::size_t first = out_groups.size();
  base_->solve_paths(columns, memory, jobs, out_groups, out_group, out_column);
  for (std::size_t g = first; g < out_groups.size(); ++g) {
    out_groups[g] = edited_paths(std::move(out_groups[g]), memory, [&](EditedPaths& group) {
      for (std::size_t i = 0; i < out_group.size(); ++i)
        if (at(out_group[i]) == g) add_inside(columns, i, at(out_column[i]), group);
    });
  }
}

std::shared_ptr<const PathGroup> EditedFactor::own_paths(std::shared_ptr<const PathGroup> base,
                                                         const SparseColumns& columns, Memory& memory) const {
  return edited_paths(own_paths_of(*base_, std::move(base), columns, memory), memory, [&](EditedPaths& group) {
    for (std::size_t i = 0; i < at(columns.count()); ++i) add_inside(columns, i, i, group);
  });
}

// The products V'y of the inside are the weights of the site there. Adds the weights of one site to a column.
void EditedFactor::add_inside(const SparseColumns& columns, std::size_t site, std::size_t column,
                              EditedPaths& group) const {
  for (Index e = columns.start[site]; e < columns.start[site + 1]; ++e) {
    const auto there = std::lower_bound(unknown_.begin(), unknown_.end(), columns.row[at(e)]);
    if (there == unknown_.end() || *there != columns.row[at(e)]) continue;
    const std::size_t row = rim_ + at(inside_before_->position()[static_cast<std::size_t>(there - unknown_.begin())]);
    group.product[row * at(group.count()) + column] += columns.value[at(e)];
    group.has_inside = true;
  }
}

template <class AddInside>
std::shared_ptr<const PathGroup> EditedFactor::edited_paths(std::shared_ptr<const PathGroup> base, Memory& memory,
                                                            AddInside&& add_inside_of) const {
  const auto group = make_shared_in<EditedPaths>(memory, std::move(base), memory);
  const std::size_t m = at(group->count());
  double products[tile * tile];
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
  add_inside_of(*group);
  group->added.assign(group->product.begin(), group->product.end());
  apply(group->added.data(), m, false);
  Vector<double> whole(group->product.begin(), group->product.end(), &memory);  // Y'(T^-1 y)
  const auto add = [&](std::size_t i, std::size_t j, double c) {
    for (std::size_t q = 0; q < m; ++q) whole[i * m + q] += c * group->added[j * m + q];
  };
  for (std::size_t i = 0; i < rim_; ++i) {
    for (std::size_t j = 0; j < rim_; ++j) add(i, j, gram_[i * rim_ + j]);
  }
  for (const Entry& entry : entries_) {
    const Span<const Index> place = inside_before_->position();
    if (entry.before != 0) add(rim_ + at(place[at(entry.row)]), rim_ + at(place[at(entry.column)]), entry.before);
  }
  apply(whole.data(), m, true);
  group->changed.assign(group->added.begin(), group->added.end());
  for (std::size_t i = 0; i < whole.size(); ++i) group->changed[i] += whole[i];
  return group;
}

// (y_a + Y x_a)'(y_b + Y x_b) - y_a'y_b = (Y'y_a)'x_b + x_a'(Y'(y_b + Y x_b)), and x_a = W Y'y_a.
void EditedFactor::add_own_products(const PathGroup& first, const PathGroup& second, double* gram, Index ld) const {
  const EditedPaths &a = of(first), &b = of(second);
  const std::size_t m = at(a.count()), n = at(b.count()), rows = a.has_inside ? k_ : rim_;
  for (std::size_t r = 0; r < rows; ++r) {
    const double *pa = &a.product[r * m], *changed = &b.changed[r * n];
    for (std::size_t i = 0; i < m; ++i) {
      double* const out = gram + i * at(ld);
      for (std::size_t j = 0; j < n; ++j) out[j] += pa[i] * changed[j];
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
  SparseVectors none(memory);
  const std::size_t inside = base->rows_of({}, none) ? change.inside.size() : 0;
  const std::size_t rim = change.unknown.size() - inside;
  const auto made = make_shared_in<EditedFactor>(memory, std::move(base), rim, inside, memory);
  made->prepare(change, jobs);
  return made;
}

}  // namespace hf_inner::factor
