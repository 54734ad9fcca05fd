#include "factor/extended_factor.h"

#include <algorithm>

#include "base/index.h"
#include "factor/dissection.h"

namespace hf_inner::factor {
namespace {

// Paths of the base, and the entries at new unknowns.
class ExtendedPaths final : public PathGroup {
 public:
  ExtendedPaths(std::shared_ptr<const PathGroup> base, Memory& memory) : base_(std::move(base)), entries(&memory) {}
  Index count() const noexcept override { return base_->count(); }
  double bytes() const noexcept override { return base_->bytes() + 16.0 * static_cast<double>(entries.size()); }
  const PathGroup& base() const noexcept { return *base_; }
  std::shared_ptr<const PathGroup> shared_base() const noexcept { return base_; }

 private:
  std::shared_ptr<const PathGroup> base_;

 public:
  struct Entry {
    Index row, column;  // row: of the factor
    double value;
  };
  Vector<Entry> entries;  // by row
};

// The block of a matrix that belongs to some unknowns, ascending.
SymmetricMatrix part_of(const SymmetricMatrix& matrix, Span<const Index> unknowns, Memory& memory) {
  SymmetricMatrix part(memory);
  part.column_start.push_back(0);
  for (const Index v : unknowns) {
    for (Index e = matrix.column_start[at(v)]; e < matrix.column_start[at(v) + 1]; ++e) {
      const Index* const there = std::lower_bound(unknowns.begin(), unknowns.end(), matrix.row[at(e)]);
      if (there == unknowns.end() || *there != matrix.row[at(e)]) continue;
      part.row.push_back(static_cast<Index>(there - unknowns.begin()));
      part.value.push_back(matrix.value[at(e)]);
    }
    part.column_start.push_back(static_cast<Index>(part.row.size()));
  }
  return part;
}

class ExtendedFactor final : public Factor {
 public:
  ExtendedFactor(std::shared_ptr<const Factor> base, Vector<Index>&& rows, Index count, double scale, Memory& memory)
      : base_(std::move(base)),
        memory_(memory),
        count_(count),
        scale_(scale),
        position_(std::move(rows)),
        order_(position_.size(), &memory),
        statistics_(base_->statistics()) {
    for (std::size_t i = 0; i < position_.size(); ++i) order_[at(position_[i])] = static_cast<Index>(i);
    statistics_.bytes += 8.0 * static_cast<double>(position_.size());
  }

  Index size() const noexcept override { return static_cast<Index>(position_.size()); }
  const FactorStatistics& statistics() const noexcept override { return statistics_; }
  // The base was measured.
  double commute_time(Span<const Index>, Span<const double>) const override { return 0; }
  Span<const Index> position() const noexcept override { return position_; }
  Span<const Index> order() const noexcept override { return order_; }

  void forward(double* z, Index channels, JobRunner& jobs) const override {
    base_->forward(z, channels, jobs);
    divide_new(z, channels);
  }
  void backward(double* z, Index channels, JobRunner& jobs) const override {
    base_->backward(z, channels, jobs);
    divide_new(z, channels);
  }
  void backward_at(Span<const Index> unknowns, double* z, Index channels) const override {
    const Vector<Index> old = split(unknowns);
    base_->backward_at(old, z, channels);
    divide_new(z, channels);  // few rows: all at once, so that none is divided twice
  }
  void clear_at(Span<const Index> unknowns, double* z, Index channels) const override {
    const Vector<Index> old = split(unknowns);
    base_->clear_at(old, z, channels);
    for (std::size_t i = at(base_->size()) * at(channels); i < position_.size() * at(channels); ++i) z[i] = 0;
  }
  std::shared_ptr<const Factor> refactor(const SymmetricMatrix& matrix, Span<const std::uint8_t> eliminated,
                                         Memory& memory, JobRunner& jobs) const override;
  std::shared_ptr<const Factor> refactor_in_order(const SymmetricMatrix& matrix, Span<const Index> order,
                                                  Span<const std::uint8_t> eliminated, Memory& memory,
                                                  JobRunner& jobs) const override {
    return base_->refactor_in_order(matrix, order, eliminated, memory, jobs);
  }
  void solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                   Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<Index> out_group,
                   Span<Index> out_column) const override;
  bool rows_of(Span<const Index> unknowns, SparseVectors& out) const override;
  void gram(const PathGroup& a, const PathGroup& b, double* gram, Index ld) const override {
    base_->gram(of(a).base(), of(b).base(), gram, ld);
    add_new_products(of(a), of(b), gram, ld);
  }
  void add_edit_products(const PathGroup& a, const PathGroup& b, double* gram, Index ld) const override {
    base_->add_edit_products(of(a).base(), of(b).base(), gram, ld);
    add_new_products(of(a), of(b), gram, ld);
  }
  void combine(const PathGroup& group, const double* lambda, Index channels, double* z) const override;
  void clear(const PathGroup& group, Index channels, double* z) const override;
  void project(const PathGroup& group, const double* z, Index channels, double* out) const override;
  const Factor& path_base() const noexcept override { return base_->path_base(); }

 protected:
  std::shared_ptr<const PathGroup> base_paths(std::shared_ptr<const PathGroup> group) const override {
    return base_paths_of(*base_, of(*group).shared_base());
  }
  std::shared_ptr<const PathGroup> own_paths(std::shared_ptr<const PathGroup> base, const SparseColumns& columns,
                                             Memory& memory) const override;

 private:
  static const ExtendedPaths& of(const PathGroup& group) noexcept { return static_cast<const ExtendedPaths&>(group); }
  bool is_new(Index unknown) const noexcept { return unknown >= base_->size(); }
  // The unknown of the base, or the row of a new one.
  Index unknown_of(Index v) const noexcept {
    const Index row = position_[at(v)];
    return is_new(row) ? row : base_->order()[at(row)];
  }
  void divide_new(double* z, Index channels) const noexcept {
    for (std::size_t i = at(base_->size()) * at(channels); i < position_.size() * at(channels); ++i) z[i] /= scale_;
  }
  // The unknowns of the base among these.
  Vector<Index> split(Span<const Index> unknowns) const {
    Vector<Index> old(&memory_);
    for (const Index v : unknowns)
      if (!is_new(unknown_of(v))) old.push_back(unknown_of(v));
    return old;
  }
  // Columns in the numbering of the base. The entries at new unknowns are left out.
  struct BaseColumns {
    explicit BaseColumns(Memory& memory) : start(1, 0, &memory), row(&memory), value(&memory) {}
    Vector<Index> start, row;
    Vector<double> value;
  };
  BaseColumns base_columns(const SparseColumns& columns, Memory& memory) const;
  void add_new_products(const ExtendedPaths& a, const ExtendedPaths& b, double* gram, Index ld) const;
  // Adds the entries of a column at new unknowns to a column of a group.
  void add_new(const SparseColumns& columns, std::size_t from, Index to, ExtendedPaths& group) const;

  std::shared_ptr<const Factor> base_;
  Memory& memory_;
  Index count_;
  double scale_;
  Vector<Index> position_, order_;
  FactorStatistics statistics_;
};

std::shared_ptr<const Factor> ExtendedFactor::refactor(const SymmetricMatrix& matrix,
                                                       Span<const std::uint8_t> eliminated, Memory& memory,
                                                       JobRunner& jobs) const {
  Vector<Index> fresh(&memory), order(&memory);
  for (Index i = base_->size(); i < size(); ++i)
    if (order_[at(i)] < count_) fresh.push_back(order_[at(i)]);
  std::sort(fresh.begin(), fresh.end());
  Buffer<Index> place;  // the new unknowns come first: the rest of the tree stays
  order_by_dissection(part_of(matrix, fresh, memory), {}, memory, jobs, place);
  for (std::size_t i = 0; i < fresh.size(); ++i) order.push_back(fresh[at(place[i])]);
  for (Index i = 0; i < base_->size(); ++i)
    if (order_[at(i)] < count_) order.push_back(order_[at(i)]);
  return base_->refactor_in_order(matrix, order, eliminated, memory, jobs);
}

ExtendedFactor::BaseColumns ExtendedFactor::base_columns(const SparseColumns& columns, Memory& memory) const {
  BaseColumns out(memory);
  for (std::size_t i = 0; i < at(columns.count()); ++i) {
    for (Index e = columns.start[i]; e < columns.start[i + 1]; ++e) {
      const Index unknown = unknown_of(columns.row[at(e)]);
      if (is_new(unknown)) continue;
      out.row.push_back(unknown);
      out.value.push_back(columns.value[at(e)]);
    }
    out.start.push_back(static_cast<Index>(out.row.size()));
  }
  return out;
}

void ExtendedFactor::add_new(const SparseColumns& columns, std::size_t from, Index to, ExtendedPaths& group) const {
  for (Index e = columns.start[from]; e < columns.start[from + 1]; ++e) {
    const Index unknown = unknown_of(columns.row[at(e)]);
    if (is_new(unknown)) group.entries.push_back({unknown, to, columns.value[at(e)] / scale_});
  }
}

void ExtendedFactor::solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                                 Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<Index> out_group,
                                 Span<Index> out_column) const {
  const std::size_t first = out_groups.size();
  const BaseColumns base = base_columns(columns, memory);
  base_->solve_paths({base.start, base.row, base.value}, memory, jobs, out_groups, out_group, out_column);
  for (std::size_t g = first; g < out_groups.size(); ++g) {
    const auto group = make_shared_in<ExtendedPaths>(memory, std::move(out_groups[g]), memory);
    for (std::size_t i = 0; i < out_group.size(); ++i)
      if (at(out_group[i]) == g) add_new(columns, i, out_column[i], *group);
    std::sort(group->entries.begin(), group->entries.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
    out_groups[g] = group;
  }
}

std::shared_ptr<const PathGroup> ExtendedFactor::own_paths(std::shared_ptr<const PathGroup> base,
                                                           const SparseColumns& columns, Memory& memory) const {
  const BaseColumns there = base_columns(columns, memory);
  std::shared_ptr<const PathGroup> own =
      own_paths_of(*base_, std::move(base), {there.start, there.row, there.value}, memory);
  const auto group = make_shared_in<ExtendedPaths>(memory, std::move(own), memory);
  for (std::size_t i = 0; i < at(columns.count()); ++i) add_new(columns, i, static_cast<Index>(i), *group);
  std::sort(group->entries.begin(), group->entries.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
  return group;
}

bool ExtendedFactor::rows_of(Span<const Index> unknowns, SparseVectors& out) const {
  const Vector<Index> old = split(unknowns);
  SparseVectors rows(memory_);
  if (!base_->rows_of(old, rows)) return false;
  out.start.assign(1, 0);
  out.row.clear();
  out.value.clear();
  std::size_t next = 0;
  for (const Index v : unknowns) {
    const Index unknown = unknown_of(v);
    if (is_new(unknown)) {
      out.row.push_back(unknown);
      out.value.push_back(scale_);
    } else {
      const auto begin = rows.start[next], end = rows.start[next + 1];
      out.row.insert(out.row.end(), rows.row.begin() + begin, rows.row.begin() + end);
      out.value.insert(out.value.end(), rows.value.begin() + begin, rows.value.begin() + end);
      ++next;
    }
    out.start.push_back(static_cast<Index>(out.row.size()));
  }
  return true;
}

void ExtendedFactor::add_new_products(const ExtendedPaths& a, const ExtendedPaths& b, double* gram, Index ld) const {
  auto from = b.entries.begin();
  for (const ExtendedPaths::Entry& x : a.entries) {
    while (from != b.entries.end() && from->row < x.row) ++from;
    for (auto y = from; y != b.entries.end() && y->row == x.row; ++y)
      gram[at(x.column) * at(ld) + at(y->column)] += x.value * y->value;
  }
}

void ExtendedFactor::combine(const PathGroup& group, const double* lambda, Index channels, double* z) const {
  base_->combine(of(group).base(), lambda, channels, z);
  const std::size_t m = at(channels);
  for (const ExtendedPaths::Entry& e : of(group).entries) {
    for (std::size_t q = 0; q < m; ++q) z[at(e.row) * m + q] += e.value * lambda[at(e.column) * m + q];
  }
}

void ExtendedFactor::clear(const PathGroup& group, Index channels, double* z) const {
  base_->clear(of(group).base(), channels, z);
  for (const ExtendedPaths::Entry& e : of(group).entries) std::fill_n(z + at(e.row) * at(channels), channels, 0.0);
}

void ExtendedFactor::project(const PathGroup& group, const double* z, Index channels, double* out) const {
  base_->project(of(group).base(), z, channels, out);
  const std::size_t m = at(channels);
  for (const ExtendedPaths::Entry& e : of(group).entries) {
    for (std::size_t q = 0; q < m; ++q) out[at(e.column) * m + q] += e.value * z[at(e.row) * m + q];
  }
}

}  // namespace

std::shared_ptr<const Factor> extend_factor(std::shared_ptr<const Factor> base, Vector<Index>&& rows, Index count,
                                            double scale, Memory& memory) {
  return make_shared_in<ExtendedFactor>(memory, std::move(base), std::move(rows), count, scale, memory);
}

}  // namespace hf_inner::factor
