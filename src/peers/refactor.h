// The engine refactor: the baseline for measurements of other engines, and the reference for tests.
//
// Every edit factorises K again, with the hard vertex sites eliminated. Their rows and columns become the identity, so
// ordering and symbolic analysis stay. The stiffness alpha of soft vertex sites is added to the diagonal. With h the
// hard vertex sites, f the other vertices and s the site values:
//
//     u_h = s_h,   (K_ff + diag(alpha)) u_f = alpha s - K_fh s_h
//
// Points inside triangles, with weights W_p, go into a dense border S = W_p' A^-1 W_p + D, where A is the matrix above
// and D the softness of the points. A component without vertex sites is pinned, and the row 1'lambda = 0 joins the
// border. An edit costs a numeric factorisation. A field costs a forward and a backward sweep.
#pragma once
#include <atomic>

#include "solve/dense_block.h"
#include "solve/site_solver.h"

namespace hf_inner::peers {

class RefactorSolver final : public solve::SiteSolver {
 public:
  // Throws HF_ERROR_UNSUPPORTED for a core whose bi-harmonic K is not formed (Core::root).
  explicit RefactorSolver(std::shared_ptr<const surface::Core> core);
  RefactorSolver(const RefactorSolver& other);

  void edit(const solve::SiteEdit& edit) override;
  void solve(const double* values, std::int32_t channels, double* field, double* flux) const override;
  void solve_into(const double* values, std::int32_t channels, solve::FieldSink& sink) const override {
    solve::solve_copied(*this, *core_, values, channels, sink);
  }
  void solve_at(const double* values, std::int32_t channels, Span<const std::int32_t> vertices,
                double* out) const override;
  bool correct(const double* values, std::int32_t channels, const double* field, const double* flux, double* change,
               double* flux_change) const override;
  std::shared_ptr<solve::SiteSolver> clone() const override {
    return make_owner_in<RefactorSolver>(core_->memory, *this);
  }
  solve::EngineCounters counters() const noexcept override;
  std::int32_t site_count(std::int32_t component) const noexcept override {
    return state_.count[static_cast<std::size_t>(component)];
  }
  std::int32_t slot_count() const noexcept override { return static_cast<std::int32_t>(state_.sites.size()); }

 private:
  struct State {
    explicit State(Memory& memory)
        : sites(&memory), count(&memory), floating(&memory), points(&memory), dense(&memory) {}
    State(const State& other, Memory& memory)
        : sites(other.sites, &memory),
          count(other.count, &memory),
          floating(other.floating, &memory),
          points(other.points, &memory),
          dense(other.dense, &memory),
          factor(other.factor),
          path(other.path) {}
    Vector<solve::Site> sites;                               // by slot; component -1: not in use
    Vector<std::int32_t> count;                              // sites by component
    Vector<std::uint8_t> floating;                           // by component: 1 if it has no vertex site
    Vector<std::int32_t> points;                             // slots of the point sites
    Vector<std::shared_ptr<const solve::DenseBlock>> dense;  // by component, of its point sites
    std::shared_ptr<const factor::Factor> factor;
    std::shared_ptr<const Vector<double>> path;  // the columns A^-1 w of the point sites' weights w
  };
  void factorise(State& state) const;
  bool crowded_out(const State& state, const solve::DenseBlock& block) const;
  void solve_system(const Vector<double>& right, std::int32_t channels, double* u, Vector<double>& points,
                    Vector<double>& constant, const Vector<double>* total) const;
  void write_vertex_flux(const double* u, std::int32_t channels, const double* right, const double* missed,
                         double* flux) const;
  bool loses_digits() const noexcept;  // then a field needs corrections
  double softness(const solve::Site& site) const noexcept;

  std::shared_ptr<const surface::Core> core_;
  State state_;
  mutable std::atomic<std::uint32_t> factorisations_{1}, sweeps_{0};
};

}  // namespace hf_inner::peers
