// Smoothest vector fields under edit: the connection Laplacian on a factor of its own, and its constraints in a small
// dense system, as in engine green.
//
//     E(z) = sum over edges of w_ij |z_j - r_ij z_i|^2,   r_ij = exp(i n rotation_ij)      (Knoeppel et al. 2013)
//
// One complex unknown per vertex (two real ones), n the degree of the field, w the cotangent weights floored at 1e-3 of
// their median. K = the matrix of E is definite on curved surfaces and singular where every round trip comes back
// unturned (a flat patch, a cylinder): so one vertex g of every component is grounded, A = K + sum_c beta_c E_g E_g',
// and the ground is taken away again exactly, as two more columns of the dense system (engine.md, end of Section 2):
//
//     Y = G^-1 P W,  S = Y_w'Y_w,  N = Y_w'Y_g,  C = Y_g'Y_g - I / beta
//     [ S   N ] [lambda]   [ s ]
//     [ N'  C ] [  nu  ] = [ 0 ],      u = P' G^-T (Y_w lambda + Y_g nu)
//
// S is definite and C - N' S^-1 N negative as soon as a component has a constraint. Unknowns are numbered in the order
// of the surface's own factor where that is one of the same graph; where the surface's operator has many edges of its
// own (intrinsic Delaunay on meshes that are not), the mesh's edges are ordered for themselves. A constraint is two
// paths and two rows; a new value only a dense solve and a backward sweep. Beyond some hundred constraints, when rows
// cost more than a factorisation, the constrained vertices are eliminated instead and every change of places factorises
// again. Edits are all or nothing.
#pragma once
#include <atomic>

#include "engine/core.h"
#include "engine/dense_block.h"
#include "field/connection.h"

namespace hf_inner {

struct DirectionCounters {
  std::uint32_t factorisations = 0, path_solves = 0, sweeps = 0;
  double bytes = 0;
};

// What all fields of one surface and degree share: connection, matrix, factor, and the paths of the grounds. Immutable.
class DirectionSystem {
 public:
  // Throws what Factor::make does.
  DirectionSystem(std::shared_ptr<const Core> core, std::int32_t degree);
  std::int32_t unknown(std::int32_t vertex, std::int32_t part) const noexcept {
    return 2 * position[static_cast<std::size_t>(vertex)] + part;
  }

  std::shared_ptr<const Core> core;  // first member: outlives what is allocated from its memory
  std::int32_t degree;
  Connection connection;
  Vector<std::int32_t> position;         // of every vertex in the order of elimination
  SymmetricMatrix matrix;                // K, unknowns 2 position + part
  std::shared_ptr<const Factor> factor;  // of A
  Vector<double> beta;                   // by component
  Vector<std::shared_ptr<const PathGroup>> ground_groups;
  Vector<std::int32_t> ground_group, ground_column;  // 2 component + part
  Vector<double> ground_block;                       // C, 4 per component
  double operator_ms = 0;

 private:
  void make_order();
  void make_matrix();
  void make_grounds();
};

class DirectionSolver {
 public:
  // degree >= 1: fields of vectors (1), lines (2), crosses (4). Throws what Factor::make does.
  DirectionSolver(std::shared_ptr<const Core> core, std::int32_t degree)
      : DirectionSolver(make_owner_in<DirectionSystem>(core->memory, core, degree)) {}
  // Without constraints, on a system that others may share.
  explicit DirectionSolver(std::shared_ptr<const DirectionSystem> system);
  // Shares the system and, until they are edited, paths and dense blocks; with the same constraints.
  DirectionSolver(const DirectionSolver& other);
  DirectionSolver& operator=(const DirectionSolver&) = delete;

  // Frees slots and puts constraints at vertices into slots; a slot may stand in both.
  struct Edit {
    Span<const std::int32_t> remove, add, vertices;
  };
  void edit(const Edit& edit);
  // z of every inner vertex, in its frame, raised to the degree; values by slot, likewise. Vertices of components
  // without a constraint get 0.
  void solve(Span<const std::complex<double>> values, std::complex<double>* field) const;

  const Core& core() const noexcept { return *system_->core; }
  const DirectionSystem& system() const noexcept { return *system_; }
  const Connection& connection() const noexcept { return system_->connection; }
  const SymmetricMatrix& matrix() const noexcept { return system_->matrix; }
  std::int32_t degree() const noexcept { return system_->degree; }
  std::int32_t constraint_count(std::int32_t component) const noexcept {
    return state_.count[static_cast<std::size_t>(component)];
  }
  bool eliminates() const noexcept { return state_.eliminated != nullptr; }
  const FactorStatistics& statistics() const noexcept { return system_->factor->statistics(); }
  double operator_ms() const noexcept { return system_->operator_ms; }
  DirectionCounters counters() const noexcept;

 private:
  using Index = std::int32_t;
  struct Group {
    std::shared_ptr<const PathGroup> paths;
    Index row[PathGroup::capacity];  // 2 slot + part; -1 once it is gone
    Index live = 0;
  };
  struct Slot {
    Index vertex = -1;
    Index group[2] = {-1, -1}, column[2] = {-1, -1};
    double ground[2][2] = {{0, 0}, {0, 0}};  // rows of N
  };

 public:
  struct State {
    State(std::size_t components, Memory& memory)
        : slots(&memory), groups(&memory), blocks(components, &memory), count(components, 0, &memory) {}
    State(const State& other, Memory& memory)
        : slots(other.slots, &memory),
          groups(other.groups, &memory),
          blocks(other.blocks, &memory),
          count(other.count, &memory),
          rows(other.rows),
          eliminated(other.eliminated) {}
    void swap(State& other) noexcept;
    Vector<Slot> slots;
    Vector<Group> groups;
    Vector<std::shared_ptr<const DenseBlock>> blocks;  // by component
    Vector<Index> count;                               // constraints by component
    Index rows = 0;
    std::shared_ptr<const Factor> eliminated;  // many constraints: a factor without their vertices
  };

  // The present constraints with their paths and dense blocks, all shared; going back to them gives the same bits.
  std::shared_ptr<const State> snapshot() const;
  void restore(const State& state);

 private:
  Index unknown(Index vertex, Index part) const noexcept { return system_->unknown(vertex, part); }
  Index component(Index vertex) const noexcept { return core().mesh.component[static_cast<std::size_t>(vertex)]; }
  void remove_rows(State& state, Span<const Index> slots) const;
  void add_paths(State& state, Span<const Index> slots) const;
  void add_rows(State& state, Span<const Index> slots) const;
  void tidy_groups(State& state) const;
  void eliminate(State& state) const;
  void solve_dense(Span<const std::complex<double>> values, double* z) const;
  void solve_eliminated(Span<const std::complex<double>> values, double* z) const;
  Memory& memory() const noexcept { return *core().memory; }

  std::shared_ptr<const DirectionSystem> system_;
  State state_;
  mutable std::atomic<std::uint32_t> factorisations_{0}, path_solves_{0}, sweeps_{0};
};

}  // namespace hf_inner
