#include "quads/definite_system.h"

#include <algorithm>

#include "base/progress.h"

namespace hf_inner::quads {

DefiniteSystem::DefiniteSystem(const SymmetricMatrix& matrix, std::shared_ptr<const factor::Factor> factor,
                               Memory& memory, JobRunner& jobs)
    : matrix_(matrix),
      factor_(std::move(factor)),
      memory_(memory),
      jobs_(jobs),
      paths_(memory),
      plain_(at(matrix.size()), 0.0, &memory),
      fixed_(&memory),
      values_(&memory) {
  double sum = 0;
  for (Index i = 0; i < matrix.size(); ++i) sum += matrix.value[matrix.diagonal(i)];
  if (sum > 0) weight_ = sum / matrix.size();
  // One component without a pin: its corner is -1 / weight and its border 0, so that its unknown of the border is 0.
  paths_.group.assign(1, -1);
  paths_.column.assign(1, 0);
  paths_.corner.assign(1, -1 / weight_);
  clear();
}

void DefiniteSystem::clear() {
  solve::PinnedOperator a;
  a.matrix = &matrix_;
  a.factor = factor_.get();
  a.pins = Span<const Index>(&pin_, 1);
  a.pin_weight = Span<const double>(&weight_, 1);
  a.paths = &paths_;
  a.memory = &memory_;
  a.jobs = &jobs_;
  system_.emplace(a);
  fixed_.clear();
  values_.clear();
}

void DefiniteSystem::set_right(Span<const double> right) {
  Vector<double> scratch(plain_.size(), &memory_);
  factor_->solve(right.data(), plain_.data(), 1, scratch.data(), jobs_);
}

void DefiniteSystem::set_scale(double factor) {
  scale_ = factor;
  clear();
}

void DefiniteSystem::forget() noexcept {
  system_.reset();
  Vector<Index>(fixed_.get_allocator()).swap(fixed_);
  Vector<double>(values_.get_allocator()).swap(values_);
}

void DefiniteSystem::fix(Span<const Index> unknowns, Span<const double> values) {
  Vector<Index> slots(&memory_);
  Vector<solve::Site> sites(&memory_);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    slots.push_back(static_cast<Index>(fixed_.size() + i));
    sites.push_back(solve::Site::at_unknown(unknowns[i], 0));
  }
  solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  system_->edit(edit);
  fixed_.insert(fixed_.end(), unknowns.begin(), unknowns.end());
  values_.insert(values_.end(), values.begin(), values.end());
}

// Returns the residual of the solution without sites at each site.
Vector<double> DefiniteSystem::missing() const {
  Vector<double> out(values_.size(), &memory_);
  for (std::size_t s = 0; s < out.size(); ++s) out[s] = values_[s] - scale_ * plain_[at(fixed_[s])];
  return out;
}

void DefiniteSystem::solve_at(Span<const Index> unknowns, double* out) const {
  for (std::size_t i = 0; i < unknowns.size(); ++i) out[i] = scale_ * plain_[at(unknowns[i])];
  if (fixed_.empty()) return;
  const Vector<double> values = missing();
  Vector<double> z(plain_.size(), 0.0, &memory_);
  solve::ConstraintSystem::Answer answer(memory_);
  if (system_->state().base) {
    system_->sweep(values.data(), 1, 0, 1, answer, z.data());
  } else {
    system_->find_centres(values.data(), 1, 0, 1, answer);
    system_->solve_dense(values.data(), 1, 0, 1, nullptr, answer);
    system_->combine(answer, 1, z.data());
    factor_->backward_at(unknowns, z.data(), 1);
  }
  const Span<const Index> position = system_->factor().position();
  for (std::size_t i = 0; i < unknowns.size(); ++i) out[i] += z[at(position[at(unknowns[i])])];
}

void DefiniteSystem::solve(double* x) const {
  for (std::size_t i = 0; i < plain_.size(); ++i) x[i] = scale_ * plain_[i];
  if (fixed_.empty()) return;
  const Vector<double> values = missing();
  Vector<double> z(plain_.size(), 0.0, &memory_);
  solve::ConstraintSystem::Answer answer(memory_);
  system_->sweep(values.data(), 1, 0, 1, answer, z.data());
  const Span<const Index> position = system_->factor().position();
  for (std::size_t i = 0; i < plain_.size(); ++i) x[i] += z[at(position[i])];
  for (std::size_t s = 0; s < values_.size(); ++s) x[at(fixed_[s])] = values_[s];
}

Vector<double> DefiniteSystem::inverse_at(Span<const Index> unknowns) const {
  const std::size_t n = unknowns.size();
  Vector<Index> start(&memory_), group(n, &memory_), column(n, &memory_);
  Vector<double> ones(n, 1.0, &memory_);
  for (std::size_t i = 0; i <= n; ++i) start.push_back(static_cast<Index>(i));
  Vector<std::shared_ptr<const factor::PathGroup>> groups(&memory_);
  factor_->solve_paths({start, unknowns, ones}, memory_, jobs_, groups, group, column);
  constexpr Index side = factor::PathGroup::capacity;
  Vector<double> out(lower_row(n), 0.0, &memory_), tile(at(side) * at(side), &memory_);
  Vector<Index> member(groups.size() * at(side), -1, &memory_);
  for (std::size_t i = 0; i < n; ++i) member[at(group[i]) * at(side) + at(column[i])] = static_cast<Index>(i);
  for (std::size_t a = 0; a < groups.size(); ++a) {
    poll();
    for (std::size_t b = 0; b <= a; ++b) {
      factor_->gram(*groups[a], *groups[b], tile.data(), side);
      for (Index i = 0; i < groups[a]->count(); ++i) {
        for (Index j = 0; j < groups[b]->count(); ++j) {
          const Index row = member[a * at(side) + at(i)], other = member[b * at(side) + at(j)];
          if (row < 0 || other < 0) continue;
          out[lower_row(at(std::max(row, other))) + at(std::min(row, other))] = tile[at(i) * at(side) + at(j)];
        }
      }
    }
  }
  return out;
}

}  // namespace hf_inner::quads
