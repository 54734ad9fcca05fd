#include "engine/screened.h"

#include <algorithm>

namespace hf_inner {

ScreenedOperator::ScreenedOperator(std::shared_ptr<const Core> harmonic)
    : core(std::move(harmonic)),
      matrix(*core->memory),
      mass(core->memory.get()),
      pins(core->memory.get()),
      paths(*core->memory) {}

// Copies K. With options.least_weight >= 0 it raises the weights and sums the diagonal again.
void ScreenedOperator::copy_operator(const ScreenedOptions& options) {
  const SymmetricMatrix& k = core->laplacian;
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
      matrix.value[i] = -weight, sum += weight;
    }
    matrix.value[matrix.diagonal(v)] = sum;
  }
}

std::shared_ptr<const ScreenedOperator> ScreenedOperator::make(std::shared_ptr<const Core> harmonic,
                                                               Span<const double> screening,
                                                               const ScreenedOptions& options) {
  const std::shared_ptr<Memory> memory = harmonic->memory;
  const auto made = make_owner_in<ScreenedOperator>(memory, std::move(harmonic));
  const Core& core = *made->core;
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
    plain.push_back(diagonal), diagonal += core.mean_diagonal[c];
  }
  made->factor = core.factor->refactor(matrix, {}, *memory, *core.jobs);
  std::size_t next = 0;
  for (const Index pin : made->pins) {
    if (pin >= 0) matrix.value[matrix.diagonal(pin)] = plain[next++];
  }
  made->find_paths();
  return made;
}

// Solves the elimination paths of the pinned vertices. A screened component has no pin: its corner is -1 / beta and its
// border 0, so that its unknown of the border is 0.
void ScreenedOperator::find_paths() {
  Memory& memory = *core->memory;
  Vector<Index> start(1, 0, &memory), row(&memory);
  for (const Index pin : pins) {
    if (pin >= 0) row.push_back(pin), start.push_back(static_cast<Index>(row.size()));
  }
  paths.group.assign(pins.size(), -1), paths.column.assign(pins.size(), 0);
  paths.corner.resize(pins.size());
  for (std::size_t c = 0; c < pins.size(); ++c) paths.corner[c] = -1 / core->mean_diagonal[c];
  if (row.empty()) return;
  const Vector<double> ones(row.size(), 1.0, &memory);
  Vector<Index> group(row.size(), &memory), column(row.size(), &memory);
  factor->solve_paths({start, row, ones}, memory, *core->jobs, paths.groups, group, column);
  double tile[PathGroup::capacity * PathGroup::capacity];
  std::size_t next = 0;
  for (std::size_t c = 0; c < pins.size(); ++c) {
    if (pins[c] < 0) continue;
    const Index g = paths.group[c] = group[next], i = paths.column[c] = column[next++];
    factor->gram(*paths.groups[at(g)], *paths.groups[at(g)], tile, PathGroup::capacity);
    paths.corner[c] += tile[i * PathGroup::capacity + i];
  }
}

PinnedOperator ScreenedOperator::view() const noexcept {
  PinnedOperator a;
  a.matrix = &matrix, a.factor = factor.get();
  a.pins = pins, a.pin_weight = core->mean_diagonal;
  a.paths = &paths;
  a.memory = core->memory.get(), a.jobs = core->jobs.get();
  return a;
}

void ScreenedOperator::add_sites(const ConstraintSystem& system, const double* values, Index channels, double* u,
                                 std::size_t stride, double* flux) const {
  constexpr Index block = ConstraintSystem::channel_block;
  const ConstraintState& state = system.state();
  const std::size_t n = at(core->size()), slots = state.entries.size(), components = pins.size();
  if (state.rows == 0 && !state.base) return;
  Memory& memory = *core->memory;
  const Span<const Index> position = system.factor().position();
  Vector<double> missing(&memory), mean(&memory);
  ConstraintSystem::Answer answer(memory);
  for (Index first = 0; first < channels; first += block) {
    const Index count = std::min(block, channels - first);
    const std::size_t m = at(count);
    // The sites miss these values. On a component that is not screened, the mean goes into a constant: a large common
    // offset must not cost digits.
    missing.assign(slots * m, 0.0), mean.assign(components * m, 0.0);
    for (std::size_t slot = 0; slot < slots; ++slot) {
      const auto& entry = state.entries[slot];
      if (!entry.used()) continue;
      const std::size_t component = at(entry.site.component);
      for (std::size_t c = 0; c < m; ++c) {
        double value = values[slot * at(channels) + at(first) + c];
        for (int k = 0; k < 3; ++k) {
          if (entry.site.vertex[k] >= 0)
            value -= entry.site.weight[k] * u[at(entry.site.vertex[k]) * stride + at(first) + c];
        }
        missing[slot * m + c] = value;
        if (pins[component] >= 0) mean[component * m + c] += value / static_cast<double>(state.sites_of[component]);
      }
    }
    for (std::size_t slot = 0; slot < slots; ++slot) {
      if (!state.entries[slot].used()) continue;
      for (std::size_t c = 0; c < m; ++c) missing[slot * m + c] -= mean[at(state.entries[slot].site.component) * m + c];
    }
    Workspace z(core->workspaces, n * m);
    system.sweep(missing.data(), count, 0, count, answer, z.data());
    for (std::size_t slot = 0; flux && slot < slots; ++slot)
      std::copy_n(answer.slot.data() + slot * m, m, flux + slot * at(channels) + at(first));
    for (std::size_t v = 0; v < n; ++v) {
      const std::size_t component = at(core->mesh.component[v]);
      if (state.sites_of[component] == 0) continue;
      for (std::size_t c = 0; c < m; ++c)
        u[v * stride + at(first) + c] += z[at(position[v]) * m + c] + mean[component * m + c];
    }
    for (std::size_t slot = 0; slot < slots; ++slot) {
      const auto& entry = state.entries[slot];
      if (entry.used() && entry.site.is_hard_vertex())
        std::copy_n(values + slot * at(channels) + at(first), m, u + at(entry.site.vertex[0]) * stride + at(first));
    }
  }
}

}  // namespace hf_inner
