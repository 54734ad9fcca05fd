#include "solve/screened.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "mesh/biharmonic.h"
#include "solve/corrections.h"

namespace hf_inner::solve {
namespace {

// The solution for p = 1 is 1. It may be off by this much: corrections still help. More says that A H is lost in
// rounding beside K. A larger number gives wrong fields, a smaller one refuses fields that are right.
constexpr double lost_share = 1e-2;
// Where it is off by more than this, fields take corrections. A larger number loses digits of weak screening, a smaller
// one adds corrections that are all rounding.
constexpr double weak_share = 1e-12;

}  // namespace

ScreenedOperator::ScreenedOperator(std::shared_ptr<const surface::Core> harmonic)
    : core(std::move(harmonic)),
      matrix(*core->memory),
      mass(core->memory.get()),
      pins(core->memory.get()),
      paths(*core->memory) {}

// Copies K. With options.least_weight >= 0 it raises the weights and sums the diagonal again.
void ScreenedOperator::copy_operator(const ScreenedOptions& options) {
  const SymmetricMatrix& k = core->matrix();
  matrix.column_start.assign(k.column_start.begin(), k.column_start.end());
  matrix.row.assign(k.row.begin(), k.row.end());
  matrix.value.assign(k.value.begin(), k.value.end());
  if (options.least_weight < 0) return;
  for (Index v = 0; v < k.size(); ++v) {
    const double least = options.least_weight * core->mean_diagonal[at(core->mesh.component[at(v)])];
    double sum = 0;
    for (std::size_t i = at(k.column_start[at(v)]); i < at(k.column_start[at(v) + 1]); ++i) {
      if (k.row[i] == v) continue;
      const double weight = std::max(-k.value[i], least);
      matrix.value[i] = -weight;
      sum += weight;
    }
    matrix.value[matrix.diagonal(v)] = sum;
  }
}

std::shared_ptr<const ScreenedOperator> ScreenedOperator::make(std::shared_ptr<const surface::Core> harmonic,
                                                               Span<const double> screening,
                                                               const ScreenedOptions& options) {
  const std::shared_ptr<Memory> memory = harmonic->memory;
  const auto made = make_owner_in<ScreenedOperator>(memory, std::move(harmonic));
  const surface::Core& core = *made->core;
  made->copy_operator(options);
  made->pins.assign(core.ground.begin(), core.ground.end());
  made->mass.resize(at(core.size()));
  for (Index v = 0; v < core.size(); ++v) {
    const double mass = core.areas[at(v)] * screening[at(v)];
    made->mass[at(v)] = mass;
    if (!(mass > 0)) continue;
    made->matrix.value[made->matrix.diagonal(v)] += mass;
    made->pins[at(core.mesh.component[at(v)])] = -1;
  }
  SymmetricMatrix& matrix = made->matrix;
  Vector<double> plain(memory.get());
  for (std::size_t c = 0; c < made->pins.size(); ++c) {
    if (made->pins[c] < 0) continue;
    double& diagonal = matrix.value[matrix.diagonal(made->pins[c])];
    plain.push_back(diagonal);
    diagonal += core.mean_diagonal[c];
  }
  made->factor = core.factor->refactor(matrix, {}, *memory, *core.jobs);
  std::size_t next = 0;
  for (const Index pin : made->pins) {
    if (pin >= 0) matrix.value[matrix.diagonal(pin)] = plain[next++];
  }
  made->find_paths();
  made->measure();
  return made;
}

// Solves for p = 1, whose solution is 1 where the operator is screened.
void ScreenedOperator::measure() {
  surface::Workspace right(core->workspaces, mass.size());
  std::copy(mass.begin(), mass.end(), right.data());
  solve_right(1, right.data());
  double lost = 0;
  for (std::size_t v = 0; v < mass.size(); ++v) {
    if (!screened(core->mesh.component[v])) continue;
    lost = std::max(lost, std::isfinite(right[v]) ? std::fabs(right[v] - 1) : HUGE_VAL);
  }
  if (!(lost <= lost_share))
    fail(HF_ERROR_NOT_POSITIVE_DEFINITE, HF_NO_INDEX,
         "the screening of a component is so small that rounding hides it; scale it up");
  is_weak = lost > weak_share;
}

// Solves the elimination paths of the pinned vertices. A screened component has no pin: its corner is -1 / beta and its
// border 0, so that its unknown of the border is 0.
void ScreenedOperator::find_paths() {
  Memory& memory = *core->memory;
  Vector<Index> start(1, 0, &memory), row(&memory);
  for (const Index pin : pins) {
    if (pin >= 0) {
      row.push_back(pin);
      start.push_back(static_cast<Index>(row.size()));
    }
  }
  paths.group.assign(pins.size(), -1);
  paths.column.assign(pins.size(), 0);
  paths.corner.resize(pins.size());
  for (std::size_t c = 0; c < pins.size(); ++c) paths.corner[c] = -1 / core->mean_diagonal[c];
  if (row.empty()) return;
  const Vector<double> ones(row.size(), 1.0, &memory);
  Vector<Index> group(row.size(), &memory), column(row.size(), &memory);
  factor->solve_paths({start, row, ones}, memory, *core->jobs, paths.groups, group, column);
  double tile[factor::PathGroup::capacity * factor::PathGroup::capacity];
  std::size_t next = 0;
  for (std::size_t c = 0; c < pins.size(); ++c) {
    if (pins[c] < 0) continue;
    const Index g = paths.group[c] = group[next], i = paths.column[c] = column[next++];
    factor->gram(*paths.groups[at(g)], *paths.groups[at(g)], tile, factor::PathGroup::capacity);
    paths.corner[c] += tile[i * factor::PathGroup::capacity + i];
  }
}

PinnedOperator ScreenedOperator::view() const noexcept {
  PinnedOperator a;
  a.matrix = &matrix;
  a.factor = factor.get();
  a.pins = pins;
  a.pin_weight = core->mean_diagonal;
  a.paths = &paths;
  a.memory = core->memory.get();
  a.jobs = core->jobs.get();
  return a;
}

void ScreenedOperator::add_sites(const ConstraintSystem& system, const double* values, Index channels, double* u,
                                 std::size_t stride, double* flux) const {
  const ConstraintState& state = system.state();
  if (state.rows == 0 && !state.base) return;
  Memory& memory = *core->memory;
  const bool is_corrected = is_weak || system.is_crowded(crowded_share);
  Vector<double> own(&memory);
  for (Index first = 0; first < channels; first += ConstraintSystem::channel_block) {
    const Index count = std::min(ConstraintSystem::channel_block, channels - first);
    Block block{count,       values + at(first), at(channels), u + at(first), stride, flux ? flux + at(first) : nullptr,
                at(channels)};
    const std::size_t m = block.m(), n = at(core->size());
    surface::Workspace plain(core->workspaces, is_corrected ? n * m : 0);
    if (is_corrected && !flux) {
      own.assign(state.entries.size() * m, 0.0);
      block.flux = own.data();
      block.flux_stride = m;
    }
    for (std::size_t v = 0; is_corrected && v < n; ++v) std::copy_n(block.u + v * stride, m, plain.data() + v * m);
    place_sites(system, block);
    if (is_corrected) correct_sites(system, block, plain.data());
  }
}

void ScreenedOperator::place_sites(const ConstraintSystem& system, const Block& block) const {
  const ConstraintState& state = system.state();
  const std::size_t n = at(core->size()), slots = state.entries.size(), components = pins.size(), m = block.m();
  Memory& memory = *core->memory;
  const Span<const Index> position = system.factor().position();
  ConstraintSystem::Answer answer(memory);
  // The sites miss these values. On a component that is not screened, the mean goes into a constant: a large common
  // offset must not cost digits.
  Vector<double> missing(slots * m, 0.0, &memory), mean(components * m, 0.0, &memory);
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const auto& entry = state.entries[slot];
    if (!entry.used()) continue;
    const std::size_t component = at(entry.site.component);
    for (std::size_t c = 0; c < m; ++c) {
      double value = block.values[slot * block.value_stride + c];
      for (int k = 0; k < 3; ++k) {
        if (entry.site.vertex[k] >= 0) value -= entry.site.weight[k] * block.row(entry.site.vertex[k])[c];
      }
      missing[slot * m + c] = value;
      if (pins[component] >= 0) mean[component * m + c] += value / static_cast<double>(state.sites_of[component]);
    }
  }
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (!state.entries[slot].used()) continue;
    for (std::size_t c = 0; c < m; ++c) missing[slot * m + c] -= mean[at(state.entries[slot].site.component) * m + c];
  }
  surface::Workspace z(core->workspaces, at(core->unknown_count()) * m);
  system.sweep(missing.data(), block.count, 0, block.count, answer, z.data());
  for (std::size_t slot = 0; block.flux && slot < slots; ++slot)
    std::copy_n(answer.slot.data() + slot * m, m, block.flux + slot * block.flux_stride);
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t component = at(core->mesh.component[v]);
    if (state.sites_of[component] == 0) continue;
    double* row = block.row(static_cast<Index>(v));
    for (std::size_t c = 0; c < m; ++c) row[c] += z[at(position[v]) * m + c] + mean[component * m + c];
  }
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const auto& entry = state.entries[slot];
    if (entry.used() && entry.site.is_hard_vertex())
      std::copy_n(block.values + slot * block.value_stride, m, block.row(entry.site.vertex[0]));
  }
}

// Corrects a field with its sites until it no longer helps. plain: the field before the sites, [vertex][count], which
// is taken to be right.
void ScreenedOperator::correct_sites(const ConstraintSystem& system, const Block& block, const double* plain) const {
  const ConstraintState& state = system.state();
  const std::size_t n = at(core->size()), m = block.m();
  Memory& memory = *core->memory;
  surface::Workspace change(core->workspaces, n * m);
  Vector<double> flux_change(&memory);
  // The unit of changes: how far the sites move the field, by component and channel.
  Vector<double> unit(pins.size() * m, 0.0, &memory);
  const auto widest = [&](std::size_t v, std::size_t c) -> double& {
    return unit[at(core->mesh.component[v]) * m + c];
  };
  for (std::size_t v = 0; v < n; ++v) {
    for (std::size_t c = 0; c < m; ++c)
      widest(v, c) = std::max(widest(v, c), std::fabs(block.row(static_cast<Index>(v))[c] - plain[v * m + c]));
  }
  Corrections corrections;
  double largest = 0;
  do {
    correct(system, block, plain, nullptr, change.data(), flux_change);
    largest = 0;
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t c = 0; c < m; ++c) {
        block.row(static_cast<Index>(v))[c] += change[v * m + c];
        if (widest(v, c) > 0) largest = std::max(largest, std::fabs(change[v * m + c]) / widest(v, c));
      }
    }
    for (std::size_t slot = 0; slot < state.entries.size(); ++slot) {
      const auto& entry = state.entries[slot];
      if (!entry.used()) continue;
      for (std::size_t c = 0; c < m; ++c) block.flux[slot * block.flux_stride + c] += flux_change[slot * m + c];
      if (entry.site.is_hard_vertex())
        std::copy_n(block.values + slot * block.value_stride, m, block.row(entry.site.vertex[0]));
    }
  } while (corrections.go_on(largest));
}

void ScreenedOperator::multiply(const double* u, const double* wish, Index channels, double* out) const {
  mesh::apply_laplacian(matrix, Vector<double>(core->memory.get()), u, channels, out,
                        *core->jobs);  // leaves out the masses
  const std::size_t m = at(channels);
  for (std::size_t v = 0; v < mass.size(); ++v) {
    for (std::size_t c = 0; mass[v] > 0 && c < m; ++c)
      out[v * m + c] += mass[v] * (u[v * m + c] - (wish ? wish[v * m + c] : 0.0));
  }
}

void ScreenedOperator::solve_right(Index channels, double* right) const {
  const std::size_t n = at(core->size()), m = at(channels);
  const Span<const Index> position = factor->position();
  surface::Workspace z(core->workspaces, n * m);
  for (std::size_t v = 0; v < n; ++v) std::copy_n(right + v * m, m, z.data() + at(position[v]) * m);
  factor->solve_in_order(z.data(), channels, *core->jobs);
  for (std::size_t v = 0; v < n; ++v) std::copy_n(z.data() + at(position[v]) * m, m, right + v * m);
}

void ScreenedOperator::correct(const ConstraintSystem& system, const Block& block, const double* plain,
                               const double* wish, double* change, Vector<double>& flux_change) const {
  const ConstraintState& state = system.state();
  const std::size_t n = at(core->size()), slots = state.entries.size(), m = block.m();
  Memory& memory = *core->memory;
  Vector<double> gap(slots * m, 0.0, &memory);
  {
    surface::Workspace moved(core->workspaces, n * m);
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t c = 0; c < m; ++c)
        moved[v * m + c] = block.row(static_cast<Index>(v))[c] - (plain ? plain[v * m + c] : 0.0);
    }
    multiply(moved.data(), wish, block.count, change);
  }
  for (std::size_t i = 0; i < n * m; ++i) change[i] = -change[i];
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const Site& site = state.entries[slot].site;
    if (!state.entries[slot].used()) continue;
    const double soft = site.compliance / core->mean_diagonal[at(site.component)];
    for (std::size_t c = 0; c < m; ++c) {
      const double flux = block.flux[slot * block.flux_stride + c];
      double& missed = gap[slot * m + c];
      missed = block.values[slot * block.value_stride + c] - soft * flux;
      for (int k = 0; k < 3; ++k) {
        if (site.vertex[k] < 0) continue;
        missed -= site.weight[k] * block.row(site.vertex[k])[c];
        change[at(site.vertex[k]) * m + c] += site.weight[k] * flux;
      }
    }
  }
  // The flux of an eliminated site is what its equation needs.
  for (const auto& entry : state.entries) {
    if (entry.used() && entry.eliminated >= 0) std::fill_n(change + at(entry.site.vertex[0]) * m, m, 0.0);
  }
  flux_change.assign(slots * m, 0.0);
  balance(system, block.count, change, gap, flux_change);
  solve_right(block.count, change);
  if (state.rows == 0 && !state.base) return;
  Vector<double> more(slots * m, 0.0, &memory);
  place_sites(system, {block.count, gap.data(), m, change, m, more.data(), m});
  for (std::size_t i = 0; i < more.size(); ++i) flux_change[i] += more[i];
}

// On a component without screening K has a solution only where the right-hand side sums to 0. The first site takes the
// sum.
void ScreenedOperator::balance(const ConstraintSystem& system, Index channels, double* right, Vector<double>& gap,
                               Vector<double>& flux) const {
  const ConstraintState& state = system.state();
  const std::size_t n = at(core->size()), m = at(channels);
  Vector<double> total(pins.size() * m, 0.0, core->memory.get());
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t component = at(core->mesh.component[v]);
    for (std::size_t c = 0; pins[component] >= 0 && c < m; ++c) {
      double& own = right[v * m + c];
      if (state.sites_of[component] == 0) own = 0;
      total[component * m + c] += own;
    }
  }
  Vector<std::uint8_t> done(pins.size(), 0, core->memory.get());
  for (std::size_t slot = 0; slot < state.entries.size(); ++slot) {
    const Site& site = state.entries[slot].site;
    if (!state.entries[slot].used() || pins[at(site.component)] < 0 || done[at(site.component)]) continue;
    done[at(site.component)] = 1;
    const double soft = site.compliance / core->mean_diagonal[at(site.component)];
    for (std::size_t c = 0; c < m; ++c) {
      const double sum = total[at(site.component) * m + c];
      flux[slot * m + c] = -sum;
      gap[slot * m + c] += soft * sum;
      for (int k = 0; k < 3; ++k) {
        if (site.vertex[k] >= 0) right[at(site.vertex[k]) * m + c] -= site.weight[k] * sum;
      }
    }
  }
}

}  // namespace hf_inner::solve
