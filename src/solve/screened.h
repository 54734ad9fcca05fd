// Solves screened fields (K + A H) u = A H p + W lambda, for constraints that fade with distance.
//
// H is a number per vertex in 1 / length^2, at least 0. A holds the lumped areas. p has a value per vertex: u follows p
// where H is large, and u is harmonic where H is 0. The operator is factorised with the ordering and the
// symbolic analysis of the harmonic core, because the diagonal adds no entry. So a new H costs one numeric
// factorisation. A component with some H > 0 is definite by itself. Other components are pinned at one vertex, as in
// the harmonic core.
#pragma once
#include "solve/constraint_system.h"
#include "surface/core.h"

namespace hf_inner::solve {

struct ScreenedOptions {
  // Raises every weight of K to this share of the mean diagonal of its component; below 0: keeps K. A share of at least
  // 0 makes all weights positive, so that a solution without sites lies between the smallest and the largest p.
  double least_weight = -1;
};

struct ScreenedOperator {
  explicit ScreenedOperator(std::shared_ptr<const surface::Core> harmonic);
  // screening: H by inner vertex, in 1 / (inner unit)^2. The function refuses nothing: the caller checks H >= 0. Throws
  // HF_ERROR_NOT_POSITIVE_DEFINITE if H of a component is so small that rounding hides it.
  static std::shared_ptr<const ScreenedOperator> make(std::shared_ptr<const surface::Core> harmonic,
                                                      Span<const double> screening, const ScreenedOptions& options);
  // The view for a ConstraintSystem, which adds sites. *this must outlive it.
  PinnedOperator view() const noexcept;
  bool screened(Index component) const noexcept { return pins[at(component)] < 0; }

  // Solves for u without sites: u[vertex * stride + c] for `channels` channels. wish(vertex, values) writes p of a
  // vertex. Components that are not screened get 0. Passes of ConstraintSystem::channel_block channels.
  template <class Wish>
  void solve(Index channels, double* u, std::size_t stride, Wish&& wish) const;
  // Adds to u what the sites of a system on this operator change. values: by slot of the system and channel. Hard
  // vertex sites get their values to the bit. flux: null, or receives lambda, [slot][channels]; sites that the factor
  // eliminates get none. The field takes corrections where
  // it may lose digits.
  void add_sites(const ConstraintSystem& system, const double* values, Index channels, double* u, std::size_t stride,
                 double* flux = nullptr) const;
  // Channels of a solve, in arrays with strides of their own. values and flux are by slot, u by vertex.
  struct Block {
    Index count;  // at most ConstraintSystem::channel_block
    const double* values;
    std::size_t value_stride;
    double* u;
    std::size_t stride;
    double* flux;
    std::size_t flux_stride;
    std::size_t m() const noexcept { return at(count); }
    double* row(Index v) const noexcept { return u + at(v) * stride; }
  };
  // One step of refinement from the field and the fluxes of a block, as a change of both: change[vertex][count] and
  // flux_change[slot][count]. wish: p, [vertex][count]; null: 0. plain: null, or a field that is subtracted first.
  void correct(const ConstraintSystem& system, const Block& block, const double* plain, const double* wish,
               double* change, Vector<double>& flux_change) const;
  // out = K u + A H (u - p), by differences of u. [vertex][channels]; wish: p, or null for 0. out must not be u.
  void multiply(const double* u, const double* wish, Index channels, double* out) const;
  // right <- A^-1 right, with A the factorised matrix. [vertex][channels], at most ConstraintSystem::channel_block.
  void solve_right(Index channels, double* right) const;

  std::shared_ptr<const surface::Core> core;  // first member: its memory outlives the rest
  SymmetricMatrix matrix;                     // K + A H
  Vector<double> mass;                        // A H by vertex
  Vector<Index> pins;                         // by component: its pinned vertex, or -1 where it is screened
  PinPaths paths;
  std::shared_ptr<const factor::Factor> factor;
  bool is_weak = false;  // rounding of K hides digits of A H: fields take corrections

 private:
  void place_sites(const ConstraintSystem& system, const Block& block) const;
  void correct_sites(const ConstraintSystem& system, const Block& block, const double* plain) const;
  void balance(const ConstraintSystem& system, Index channels, double* right, Vector<double>& gap,
               Vector<double>& flux) const;
  void copy_operator(const ScreenedOptions& options);
  void find_paths();
  void measure();
};

template <class Wish>
void ScreenedOperator::solve(Index channels, double* u, std::size_t stride, Wish&& wish) const {
  constexpr Index block = ConstraintSystem::channel_block;
  constexpr std::size_t piece = 16384;  // vertices of one thread's job: the figures of green.cpp hold
  const std::size_t n = at(core->size());
  const Span<const Index> position = factor->position();
  for (Index first = 0; first < channels; first += block) {
    const Index count = std::min(block, channels - first);
    const std::size_t m = at(count);
    surface::Workspace z(core->workspaces, n * m);
    for_ranges(*core->jobs, n, piece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        double* row = z.data() + at(position[v]) * m;
        std::fill_n(row, m, 0.0);
        if (mass[v] > 0) wish(static_cast<Index>(v), first, count, row);
        for (std::size_t c = 0; c < m; ++c) row[c] *= mass[v];
      }
    });
    factor->solve_in_order(z.data(), count, *core->jobs);
    for_ranges(*core->jobs, n, piece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        std::copy_n(z.data() + at(position[v]) * m, m, u + v * stride + at(first));
    });
  }
}

}  // namespace hf_inner::solve
