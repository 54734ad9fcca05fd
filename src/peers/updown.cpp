#include "peers/updown.h"

#include <cholmod.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "base/error.h"
#include "base/index.h"
#include "peers/intake.h"

namespace hf_inner::peers {
namespace {

// After this many edited sites since the last factorisation, a solve takes a refinement step. A step costs one more
// sweep in every field. Fewer refine sooner. Half and double pass the 70 tests of the engine.
constexpr std::uint32_t refine_after = 256;
// Default tolerance of a certificate. A penalty of 1e8 holds a site to about 1e-8, a weaker one to less.
constexpr double penalty_tolerance = 1e-5;

// CHOLMOD's workspace, with its printing switched off.
struct Common {
  Common() noexcept {
    cholmod_start(&c);
    c.print = 0;
    c.error_handler = nullptr;
    c.supernodal = CHOLMOD_SUPERNODAL;
    c.nmethods = 1;
    c.method[0].ordering = CHOLMOD_GIVEN;
    c.postorder = 1;
  }
  ~Common() { cholmod_finish(&c); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
  cholmod_common c;
};

[[noreturn]] void throw_status(const cholmod_common& c) {
  if (c.status == CHOLMOD_OUT_OF_MEMORY || c.status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
  fail(HF_ERROR_NOT_POSITIVE_DEFINITE, HF_NO_INDEX, "CHOLMOD stopped with status %d", c.status);
}

class UpdownSolver final : public solve::SiteSolver {
 public:
  UpdownSolver(std::shared_ptr<const surface::Core> core, double penalty)
      : core_(std::move(core)), penalty_(penalty), sites_(core_->memory.get()), count_(core_->memory.get()) {
    count_.assign(at(core_->mesh.component_count()), 0);
    try {
      rebuild();
    } catch (...) {
      cholmod_free_factor(&factor_, &common_.c);  // no destructor runs for a half-made object
      throw;
    }
  }
  UpdownSolver(const UpdownSolver& other)
      : core_(other.core_),
        penalty_(other.penalty_),
        sites_(other.sites_, core_->memory.get()),
        count_(other.count_, core_->memory.get()),
        edits_(other.edits_),
        factorisations_(other.factorisations_),
        sweeps_(other.sweeps_.load()) {
    const std::lock_guard<std::mutex> lock(other.mutex_);
    position_.assign(other.position_.begin(), other.position_.end());
    factor_ = other.factor_ ? cholmod_copy_factor(other.factor_, &other.common_.c) : nullptr;
    if (other.factor_ && !factor_) throw std::bad_alloc();
  }
  ~UpdownSolver() override {
    cholmod_free_factor(&factor_, &common_.c);
    for (cholmod_dense** array : {&work_.x, &work_.y, &work_.e}) cholmod_free_dense(array, &common_.c);
  }
  UpdownSolver& operator=(const UpdownSolver&) = delete;

  void edit(const solve::SiteEdit& edit) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!factor_) rebuild();
    Memory& memory = *core_->memory;
    Vector<solve::Site> sites(sites_, &memory);
    Vector<Index> count(count_, &memory);
    Vector<solve::Site> leaving(&memory), coming(edit.sites.begin(), edit.sites.end(), &memory);
    for (const Index slot : edit.remove) {
      leaving.push_back(sites[at(slot)]);
      --count[at(sites[at(slot)].component)];
      sites[at(slot)] = solve::Site{};
    }
    for (std::size_t i = 0; i < edit.add.size(); ++i) {
      if (sites.size() <= at(edit.add[i])) sites.resize(at(edit.add[i]) + 1);
      sites[at(edit.add[i])] = edit.sites[i];
      ++count[at(edit.sites[i].component)];
    }
    // A component is pinned (its diagonal raised at one vertex) before its last site is removed. It is unpinned after
    // its first site was added.
    for (std::size_t c = 0; c < count.size(); ++c) {
      if (count_[c] > 0 && count[c] == 0) coming.push_back(ground(static_cast<Index>(c)));
      if (count_[c] == 0 && count[c] > 0) leaving.push_back(ground(static_cast<Index>(c)));
    }
    if (!change(coming, true) || !change(leaving, false)) {
      // The factor may contain half of the edit or no numbers at all. Factorise again with the sites from before the
      // edit.
      rebuild();
      throw std::bad_alloc();
    }
    edits_ += static_cast<std::uint32_t>(edit.remove.size() + edit.add.size());
    std::swap(sites_, sites);
    std::swap(count_, count);
  }

  void solve(const double* values, Index channels, double* field, double* flux) const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!factor_)
      fail(HF_ERROR_OUT_OF_MEMORY, HF_NO_INDEX,
           "the factor was lost when memory ran out; edit the sites to make it again");
    Memory& memory = *core_->memory;
    const std::size_t n = at(core_->size()), m = at(channels);
    Vector<double> centre(count_.size() * m, 0.0, &memory);
    for (std::size_t slot = 0; slot < sites_.size(); ++slot) {
      const solve::Site& site = sites_[slot];
      if (site.component < 0) continue;
      for (std::size_t c = 0; c < m; ++c)
        centre[at(site.component) * m + c] += values[slot * m + c] / count_[at(site.component)];
    }
    // Computes the right-hand side R R' s by columns. The mean of each component is subtracted from s.
    surface::Workspace right(core_->workspaces, n * m), wanted(core_->workspaces, sites_.size() * m);
    std::fill_n(right.data(), n * m, 0.0);
    for (std::size_t slot = 0; slot < sites_.size(); ++slot) {
      const solve::Site& site = sites_[slot];
      if (site.component < 0) continue;
      const double a = alpha(site);
      for (std::size_t c = 0; c < m; ++c) {
        const double s = values[slot * m + c] - centre[at(site.component) * m + c];
        wanted[slot * m + c] = s;
        for (int k = 0; k < 3; ++k) {
          if (site.vertex[k] >= 0) right[c * n + at(site.vertex[k])] += a * site.weight[k] * s;
        }
      }
    }
    const double* u = back_substitute(right.data(), m);
    surface::Workspace refined(core_->workspaces, edits_ > refine_after || core_->refinements > 0 ? n * m : 0);
    if (edits_ > refine_after || core_->refinements > 0) {
      std::copy_n(u, n * m, refined.data());
      surface::Workspace residual(core_->workspaces, n * m);
      residual_of(wanted.data(), refined.data(), channels, residual.data());
      const double* correction = back_substitute(residual.data(), m);
      for (std::size_t i = 0; i < n * m; ++i) refined[i] += correction[i];
      u = refined.data();
    }
    if (field) {
      for (std::size_t v = 0; v < n; ++v) {
        const std::size_t component = at(core_->mesh.component[v]);
        for (std::size_t c = 0; c < m; ++c)
          field[v * m + c] = count_[component] ? u[c * n + v] + centre[component * m + c] : 0.0;
      }
    }
    if (!flux) return;
    for (std::size_t slot = 0; slot < sites_.size(); ++slot) {
      const solve::Site& site = sites_[slot];
      for (std::size_t c = 0; c < m; ++c) {
        double difference = 0;
        if (site.component >= 0) {
          difference = values[slot * m + c] - centre[at(site.component) * m + c];
          for (int k = 0; k < 3; ++k) {
            if (site.vertex[k] >= 0) difference -= site.weight[k] * u[c * n + at(site.vertex[k])];
          }
          difference *= alpha(site);
        }
        flux[slot * m + c] = difference;
      }
    }
  }

  void solve_into(const double* values, Index channels, solve::FieldSink& sink) const override {
    solve::solve_copied(*this, *core_, values, channels, sink);
  }
  void solve_at(const double* values, Index channels, Span<const Index> vertices, double* out) const override {
    // This engine cannot solve at single vertices, so it solves the whole field.
    Vector<double> field(at(core_->size()) * at(channels), core_->memory.get());
    solve(values, channels, field.data(), nullptr);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      std::copy_n(field.data() + at(vertices[i]) * at(channels), channels, out + i * at(channels));
  }

  std::shared_ptr<solve::SiteSolver> clone() const override {
    return make_owner_in<UpdownSolver>(core_->memory, *this);
  }
  double tolerance() const noexcept override { return penalty_tolerance; }
  solve::EngineCounters counters() const noexcept override {
    solve::EngineCounters counters;
    counters.factorisations = 1 + factorisations_;  // the core's own first
    counters.sweeps = sweeps_;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (factor_) counters.bytes = static_cast<double>(factor_->nzmax) * (sizeof(double) + sizeof(Index));
    return counters;
  }
  Index site_count(Index component) const noexcept override { return count_[at(component)]; }
  Index slot_count() const noexcept override { return static_cast<Index>(sites_.size()); }

 private:
  // Returns the penalty of a site in the unit of K. A compliance of 0 is a hard site.
  double alpha(const solve::Site& site) const noexcept {
    return core_->mean_diagonal[at(site.component)] *
           (site.compliance > 0 ? std::min(1 / site.compliance, penalty_) : penalty_);
  }
  solve::Site ground(Index component) const noexcept {
    return solve::Site::at_vertex(core_->mesh, core_->ground[at(component)], 1.0);
  }

  // Updates or downdates the factor with all of these sites at once. Returns false if CHOLMOD failed; the factor is
  // then invalid.
  bool change(const Vector<solve::Site>& sites, bool update) {
    if (sites.empty()) return true;
    const Span<const Index> position = position_;
    cholmod_sparse* r =
        cholmod_allocate_sparse(at(core_->size()), sites.size(), 3 * sites.size(), 1, 1, 0, CHOLMOD_REAL, &common_.c);
    if (!r) return false;
    int* start = static_cast<int*>(r->p);
    int* row = static_cast<int*>(r->i);
    double* value = static_cast<double*>(r->x);
    int used = 0;
    for (std::size_t j = 0; j < sites.size(); ++j) {
      start[j] = used;
      const double root = std::sqrt(alpha(sites[j]));
      int order[3] = {0, 1, 2};  // rows ascending in factor order
      std::sort(order, order + 3, [&](int a, int b) {
        const Index va = sites[j].vertex[a], vb = sites[j].vertex[b];
        return (va < 0 ? core_->size() : position[at(va)]) < (vb < 0 ? core_->size() : position[at(vb)]);
      });
      for (const int k : order) {
        if (sites[j].vertex[k] < 0 || sites[j].weight[k] == 0) continue;
        row[used] = position[at(sites[j].vertex[k])];
        value[used++] = root * sites[j].weight[k];
      }
    }
    start[sites.size()] = used;
    const bool done = cholmod_updown(update ? 1 : 0, r, factor_, &common_.c) && common_.c.status >= CHOLMOD_OK;
    cholmod_free_sparse(&r, &common_.c);
    return done;
  }

  // Factorises K + R R', where R R' are the penalties of the present sites, with raised diagonals at pinned vertices.
  void rebuild() {
    cholmod_free_factor(&factor_, &common_.c);
    const Index n = core_->size();
    const SymmetricMatrix& k = core_->matrix();
    cholmod_sparse* a = cholmod_allocate_sparse(at(n), at(n), k.row.size(), 1, 1, -1, CHOLMOD_REAL, &common_.c);
    if (!a) throw_status(common_.c);
    int used = 0;
    for (Index v = 0; v < n; ++v) {
      static_cast<int*>(a->p)[v] = used;
      for (Index i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i) {
        if (k.row[at(i)] < v) continue;
        static_cast<int*>(a->i)[used] = k.row[at(i)];
        double value = k.value[at(i)];
        const Index c = core_->mesh.component[at(v)];
        // No site is in the factor yet, so every component is pinned.
        if (k.row[at(i)] == v && v == core_->ground[at(c)]) value += core_->mean_diagonal[at(c)];
        static_cast<double*>(a->x)[used++] = value;
      }
    }
    static_cast<int*>(a->p)[n] = used;
    const Span<const Index> order = core_->factor->order();
    factor_ = cholmod_analyze_p(a, const_cast<int*>(order.data()), nullptr, 0, &common_.c);
    bool done = factor_ && cholmod_factorize(a, factor_, &common_.c) && common_.c.status == CHOLMOD_OK;
    // cholmod_updown only changes factors of the form L D L' that are stored column by column (simplicial).
    done = done && cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, factor_, &common_.c);
    cholmod_free_sparse(&a, &common_.c);
    if (done) {
      // CHOLMOD changes the given order of the unknowns (postorder of its elimination tree). Stores where every unknown
      // went.
      position_.resize(at(n));
      for (Index r = 0; r < n; ++r) position_[at(static_cast<int*>(factor_->Perm)[r])] = r;
      ++factorisations_;
      edits_ = 0;
      done = insert_present();
    }
    if (!done) {
      cholmod_free_factor(&factor_, &common_.c);
      throw_status(common_.c);
    }
  }

  bool insert_present() {
    Vector<solve::Site> coming(core_->memory.get()), leaving(core_->memory.get());
    for (const solve::Site& site : sites_) {
      if (site.component >= 0) coming.push_back(site);
    }
    for (std::size_t c = 0; c < count_.size(); ++c) {
      if (count_[c] > 0) leaving.push_back(ground(static_cast<Index>(c)));
    }
    return change(coming, true) && change(leaving, false);
  }

  // Solves into CHOLMOD's own array, which stays valid until the next call.
  const double* back_substitute(const double* right, std::size_t columns) const {
    cholmod_dense b{};
    b.nrow = b.d = at(core_->size());
    b.ncol = columns;
    b.nzmax = b.nrow * columns;
    b.x = const_cast<double*>(right);
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    if (!cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &work_.x, nullptr, &work_.y, &work_.e, &common_.c))
      throw_status(common_.c);
    sweeps_ += 2;
    return static_cast<double*>(work_.x->x);
  }

  // Computes residual = R R' s - (K + R R' + pins) u for each channel. The pins raise the diagonal at the vertices of
  // components without sites. R R' is the penalty matrix of the sites (updown.h), s their values and u the field. K u
  // is computed from differences of u. The error of each site is computed first. If it were summed by vertex, its
  // rounding, multiplied by the penalty, would not point along the weights w. Along w the penalty makes rounding
  // harmless.
  void residual_of(const double* wanted, const double* u, Index channels, double* residual) const {
    const SymmetricMatrix& k = core_->matrix();
    const std::size_t n = at(core_->size()), m = at(channels);
    for (std::size_t c = 0; c < m; ++c, u += n, residual += n) {
      for (Index v = 0; v < core_->size(); ++v) {
        double sum = 0;
        for (Index i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i)
          sum -= k.value[at(i)] * (u[k.row[at(i)]] - u[v]);
        const Index component = core_->mesh.component[at(v)];
        if (count_[at(component)] == 0 && v == core_->ground[at(component)])
          sum -= core_->mean_diagonal[at(component)] * u[v];
        residual[v] = sum;
      }
      for (std::size_t slot = 0; slot < sites_.size(); ++slot) {
        const solve::Site& site = sites_[slot];
        if (site.component < 0) continue;
        double missed = wanted[slot * m + c];
        for (int q = 0; q < 3; ++q) missed -= site.vertex[q] >= 0 ? site.weight[q] * u[site.vertex[q]] : 0.0;
        for (int q = 0; q < 3; ++q) {
          if (site.vertex[q] >= 0) residual[site.vertex[q]] += alpha(site) * site.weight[q] * missed;
        }
      }
    }
  }

  std::shared_ptr<const surface::Core> core_;
  double penalty_;
  Vector<solve::Site> sites_;  // by slot; component -1: not in use
  Vector<Index> count_;
  Vector<Index> position_{core_->memory.get()};
  mutable std::mutex mutex_;
  mutable Common common_;
  cholmod_factor* factor_ = nullptr;
  struct Work {  // scratch of cholmod_solve2, kept from solve to solve
    cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;
  };
  mutable Work work_;
  std::uint32_t edits_ = 0, factorisations_ = 0;
  mutable std::atomic<std::uint32_t> sweeps_{0};
};

}  // namespace

void require_updown() {}

std::shared_ptr<solve::SiteSolver> make_updown_solver(std::shared_ptr<const surface::Core> core, double penalty) {
  require_formed(*core);
  const std::shared_ptr<Memory> memory = core->memory;
  return make_owner_in<UpdownSolver>(memory, std::move(core), penalty);
}

}  // namespace hf_inner::peers
