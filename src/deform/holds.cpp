#include "deform/holds.h"

#include <algorithm>
#include <cmath>

#include "base/compiler.h"

namespace hf_inner::deform {
namespace {

// Pins in all, and at least in a component: more hold every limb, fewer take less time and memory.
constexpr std::int32_t most_holds = 96, least_component_holds = 4;

class HoldsPreparation {
 public:
  HoldsPreparation(const HoldsInput& input, Holds& out, Memory& memory)
      : in_(input), out_(out), memory_(memory), size_(static_cast<std::size_t>(input.subspace.factor.size())) {}

  void run() {
    choose_vertices();
    if (out_.count() == 0) return;
    list_rows();
    respond();
    set_strengths();
  }

 private:
  // The seeds of groups are spread over a component, the first ones most evenly.
  void choose_vertices() {
    Vector<std::int32_t> components(&memory_);
    for (const std::int32_t c : in_.weights.elastic_components) {
      const Span<const std::int32_t> handles = in_.reach.handles_of(c);
      if (std::any_of(handles.begin(), handles.end(), [&](std::int32_t h) { return in_.follow[h] < 1; }))
        components.push_back(c);
    }
    if (components.empty()) return;
    const std::int32_t each =
        std::max(least_component_holds, most_holds / static_cast<std::int32_t>(components.size()));
    for (const std::int32_t c : components) {
      std::int32_t taken = 0;
      for (std::int32_t g = in_.groups.component_start[c]; g < in_.groups.component_end[c] && taken < each; ++g) {
        const std::int32_t v = in_.groups.seed[g];
        if (in_.reach.owner[v] >= 0 || !(wish(v) > 0)) continue;
        out_.vertex.push_back(v);
        ++taken;
      }
    }
  }

  // k_j / s. The limit of g for f = 0 is a number, because an infinite one would hold the limb too.
  double wish(std::int32_t v) const {
    double sum = 0, weighed = 0, largest = 0;
    for (std::size_t h = 0; h < in_.follow.size(); ++h) {
      const double f = in_.follow[h], phi = in_.fields.at(v)[h];
      if (!(f < 1)) continue;
      sum += phi;
      weighed += phi * (1 - f) / std::max(f, least_following);
      largest = std::max(largest, phi);
    }
    return sum > 0 ? hold_strength * weighed / sum * std::pow(1 - std::min(1.0, largest), hold_power) : 0.0;
  }

  void list_rows() {
    out_.row_start.push_back(0);
    for (const std::int32_t v : out_.vertex) {
      const Vec3 p = in_.mesh.positions[v];
      for (std::int32_t k = in_.weights.start[v]; k < in_.weights.start[v + 1]; ++k) {
        const double w = in_.weights.weight[k];
        out_.row.push_back({in_.weights.cluster[k], {w * p.x, w * p.y, w * p.z, w}});
      }
      out_.row_start.push_back(static_cast<std::int32_t>(out_.row.size()));
    }
  }

  template <class Use>
  void for_free_parts(std::size_t j, Use&& use) const {
    for (std::int32_t k = out_.row_start[j]; k < out_.row_start[j + 1]; ++k) {
      const std::int32_t f = out_.row[k].cluster - in_.weights.handle_count;
      if (f < 0) continue;
      for (std::size_t a = 0; a < 4; ++a) use(4 * static_cast<std::size_t>(f) + a, out_.row[k].z[a]);
    }
  }

  // U, four columns at a time
  void respond() {
    const std::size_t m = out_.count();
    out_.response.allocate(memory_, m * size_);
    Buffer<double> columns(memory_, 4 * size_);
    for (std::size_t first = 0; first < m; first += 4) {
      const std::size_t count = std::min<std::size_t>(4, m - first);
      std::fill(columns.begin(), columns.end(), 0.0);
      for (std::size_t k = 0; k < count; ++k)
        for_free_parts(first + k, [&](std::size_t row, double z) { columns[4 * row + k] += z; });
      in_.subspace.factor.solve_four(columns.data());
      for (std::size_t row = 0; row < size_; ++row) {
        for (std::size_t k = 0; k < count; ++k) out_.response[row * m + first + k] = columns[4 * row + k];
      }
    }
  }

  double compliance(std::size_t i, std::size_t j) const {
    double sum = 0;
    for_free_parts(i, [&](std::size_t row, double z) { sum += z * out_.response[row * out_.count() + j]; });
    return sum;
  }

  void set_strengths() {
    const std::size_t m = out_.count();
    Vector<double> compliances(static_cast<std::size_t>(in_.mesh.component_count()), 0.0, &memory_);
    for (std::size_t j = 0; j < m; ++j) compliances[in_.mesh.component[out_.vertex[j]]] += compliance(j, j);
    Buffer<double> lower(memory_, m * m);
    for (std::size_t i = 0; i < m; ++i) {
      const double unit = compliances[in_.mesh.component[out_.vertex[i]]];
      out_.strength.push_back(unit > 0 ? wish(out_.vertex[i]) / unit : 0.0);
      for (std::size_t j = 0; j < m; ++j) lower[i * m + j] = compliance(i, j);
      lower[i * m + i] += out_.strength[i] > 0 ? 1 / out_.strength[i] : 1 / least_moment;
    }
    out_.system.factorise(std::move(lower), static_cast<std::int32_t>(m), memory_);
  }

  const HoldsInput& in_;
  Holds& out_;
  Memory& memory_;
  std::size_t size_;
};

// Adds sign times Z' X of the clusters in [first, last) to out.
void add_places(const Holds& holds, std::int32_t first, std::int32_t last, double sign, const double* rows,
                double* out) noexcept {
  for (std::size_t j = 0; j < holds.count(); ++j) {
    for (std::int32_t k = holds.row_start[j]; k < holds.row_start[j + 1]; ++k) {
      const Holds::Part& part = holds.row[k];
      if (part.cluster < first || part.cluster >= last) continue;
      const double* x = rows + 16 * static_cast<std::size_t>(part.cluster);
      for (int a = 0; a < 4; ++a) {
        for (int i = 0; i < 3; ++i) out[4 * j + static_cast<std::size_t>(i)] += sign * part.z[a] * x[4 * a + i];
      }
    }
  }
}

}  // namespace

Holds make_holds(const HoldsInput& input, Memory& memory) {
  Holds holds(memory);
  HoldsPreparation(input, holds, memory).run();
  return holds;
}

void begin_holds(const Holds& holds, std::size_t handle_count, const double* rows, HoldsState& state) noexcept {
  std::copy(state.target.begin(), state.target.end(), state.gap.begin());
  add_places(holds, 0, static_cast<std::int32_t>(handle_count), -1, rows, state.gap.data());
}

HF_FOUR_LANES
void gap_before(const Holds& holds, const double* r, std::size_t size, HoldsState& state) noexcept {
  const std::size_t m = holds.count();
  std::copy(state.gap.begin(), state.gap.end(), state.pull.begin());
  for (std::size_t row = 0; row < size; ++row) {
    const double* u = holds.response.data() + row * m;
    for (std::size_t j = 0; j < m; ++j) {
      for (std::size_t i = 0; i < 4; ++i) state.pull[4 * j + i] -= u[j] * r[4 * row + i];
    }
  }
}

namespace {

// Adds U lambda.
HF_FOUR_LANES
void add_pull(const Holds& holds, const double* pull, double* solved, std::size_t size) noexcept {
  const std::size_t m = holds.count();
  for (std::size_t row = 0; row < size; ++row) {
    const double* u = holds.response.data() + row * m;
    double sum[4] = {};
    for (std::size_t j = 0; j < m; ++j) {
      for (std::size_t i = 0; i < 4; ++i) sum[i] += u[j] * pull[4 * j + i];
    }
    for (std::size_t i = 0; i < 4; ++i) solved[4 * row + i] += sum[i];
  }
}

}  // namespace

void add_holds(const Holds& holds, const double* rows, double* solved, std::size_t size, HoldsState& state) noexcept {
  std::copy(state.target.begin(), state.target.end(), state.pull.begin());
  add_places(holds, 0, 0x7fffffff, -1, rows, state.pull.data());
  holds.system.solve(state.pull.data());
  add_pull(holds, state.pull.data(), solved, size);
}

}  // namespace hf_inner::deform
