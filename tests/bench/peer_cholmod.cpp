#include "bench/peer_cholmod.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace bench {

PeerMatrix cotangent_matrix(const Mesh& mesh) {
  const size_t n = mesh.vertex_count();
  std::vector<std::map<uint32_t, double>> columns(n);
  for (size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t i = mesh.triangles[t + (k + 1) % 3], j = mesh.triangles[t + (k + 2) % 3],
                     o = mesh.triangles[t + k];
      std::array<double, 3> a{}, b{};
      for (size_t d = 0; d < 3; ++d) {
        a[d] = mesh.positions[3 * i + d] - mesh.positions[3 * o + d];
        b[d] = mesh.positions[3 * j + d] - mesh.positions[3 * o + d];
      }
      const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      const double cx = a[1] * b[2] - a[2] * b[1], cy = a[2] * b[0] - a[0] * b[2], cz = a[0] * b[1] - a[1] * b[0];
      const double w = 0.5 * dot / std::sqrt(cx * cx + cy * cy + cz * cz);
      columns[std::min(i, j)][std::max(i, j)] -= w;
      columns[i][i] += w;
      columns[j][j] += w;
    }
  }
  PeerMatrix out;
  for (size_t v = 0; v < n; ++v) {
    out.start.push_back(static_cast<int>(out.row.size()));
    for (const auto& [row, value] : columns[v]) {
      out.row.push_back(static_cast<int>(row));
      out.value.push_back(value);
    }
  }
  out.start.push_back(static_cast<int>(out.row.size()));
  return out;
}

}  // namespace bench

#ifdef HF_WITH_GPL

#include <cholmod.h>
#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

#include "factor/kernels.h"

namespace bench {
namespace {

constexpr const char* core_type = "OPENBLAS_CORETYPE";

template <class Function>
Function* loaded(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

// BLAS threads for one scope. Afterwards one again, and time for the helpers of BLAS to stop spinning: three runnable
// threads on two cores would slow down whoever is measured next.
class BlasThreads {
 public:
  explicit BlasThreads(uint32_t threads) : threads_(threads) { set(threads); }
  ~BlasThreads() {
    set(1);
    if (threads_ > 1) std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  static void set(uint32_t threads) {
    if (auto* function = loaded<void(int)>("openblas_set_num_threads")) function(static_cast<int>(threads));
  }
  uint32_t threads_;
};

class Peer final : public CholmodPeer {
 public:
  Peer(PeerMatrix matrix, uint32_t threads) : n_(matrix.size()), threads_(threads), matrix_(std::move(matrix)) {
    cholmod_start(&c_);
    c_.supernodal = CHOLMOD_SUPERNODAL;
    c_.nmethods = 1;
    c_.print = 0;
    view_.nrow = view_.ncol = n_;
    view_.nzmax = matrix_.row.size();
    view_.p = matrix_.start.data();
    view_.i = matrix_.row.data();
    view_.x = matrix_.value.data();
    view_.stype = -1;
    view_.itype = CHOLMOD_INT;
    view_.xtype = CHOLMOD_REAL;
    view_.dtype = CHOLMOD_DOUBLE;
    view_.sorted = view_.packed = 1;
    for (size_t v = 0; v < n_; ++v) {
      plain_.push_back(diagonal(v));
      mean_ += diagonal(v) / static_cast<double>(n_);
    }
    right_.assign(n_, 0.0);
  }
  ~Peer() override {
    cholmod_free_factor(&factor_, &c_);
    cholmod_free_factor(&updatable_, &c_);
    for (cholmod_dense** work : {&x_, &y_, &e_}) cholmod_free_dense(work, &c_);
    cholmod_finish(&c_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  double metis_ms(std::vector<int>& order) override {
    order.resize(n_);
    return time_ms([&] { require(cholmod_metis(&view_, nullptr, 0, 0, order.data(), &c_), "cholmod_metis"); });
  }
  double amd_ms(std::vector<int>& order) override {
    order.resize(n_);
    return time_ms([&] { require(cholmod_amd(&view_, nullptr, 0, order.data(), &c_), "cholmod_amd"); });
  }
  double analyse_given_ms(const std::vector<int>& order) override {
    cholmod_free_factor(&factor_, &c_);
    c_.method[0].ordering = CHOLMOD_GIVEN;
    const double ms =
        time_ms([&] { factor_ = cholmod_analyze_p(&view_, const_cast<int*>(order.data()), nullptr, 0, &c_); });
    require(factor_ != nullptr, "cholmod_analyze_p");
    return ms;
  }
  double analyse_ms() override {
    cholmod_free_factor(&factor_, &c_);
    c_.method[0].ordering = CHOLMOD_METIS;
    const double ms = time_ms([&] { factor_ = cholmod_analyze(&view_, &c_); });
    require(factor_ != nullptr, "cholmod_analyze");
    return ms;
  }
  void set_sites(const std::vector<uint32_t>& vertices) override {
    std::fill(right_.begin(), right_.end(), 0.0);
    for (size_t v = 0; v < n_; ++v) diagonal(v) = plain_[v];
    for (const uint32_t v : vertices) {
      diagonal(v) += alpha();
      right_[v] = alpha() * value_of(v);
    }
  }
  double factorise_ms(uint32_t blas_threads) override {
    const BlasThreads scope(blas_threads ? blas_threads : threads_);
    return time_ms([&] { require(cholmod_factorize(&view_, factor_, &c_), "cholmod_factorize"); });
  }
  double solve_ms(uint32_t blas_threads) override {
    cholmod_dense b = right_hand_side(right_, 1);
    cholmod_dense* x = nullptr;
    const BlasThreads scope(blas_threads ? blas_threads : threads_);
    const double ms = time_ms([&] { x = cholmod_solve(CHOLMOD_A, factor_, &b, &c_); });
    require(x != nullptr, "cholmod_solve");
    cholmod_free_dense(&x, &c_);
    return ms;
  }
  double solve_kept_ms(uint32_t columns) override {
    std::vector<double> right;
    for (uint32_t c = 0; c < columns; ++c) right.insert(right.end(), right_.begin(), right_.end());
    const BlasThreads scope(threads_);
    return solve_kept(factor_, right, columns);
  }

  void begin_updown(const std::vector<uint32_t>& sites) override {
    set_sites(sites);
    factorise_ms(0);
    cholmod_free_factor(&updatable_, &c_);
    updatable_ = cholmod_copy_factor(factor_, &c_);
    require(updatable_ && cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, updatable_, &c_), "cholmod_change_factor");
    require(cholmod_resymbol(&view_, nullptr, 0, 1, updatable_, &c_), "cholmod_resymbol");
    position_.resize(n_);
    for (size_t r = 0; r < n_; ++r)
      position_[static_cast<size_t>(static_cast<int*>(updatable_->Perm)[r])] = static_cast<int>(r);
  }
  double updown_ms(const std::vector<uint32_t>& insert, const std::vector<uint32_t>& remove) override {
    const double ms = change(insert, true) + change(remove, false);
    for (const uint32_t v : insert) right_[v] = alpha() * value_of(v);
    for (const uint32_t v : remove) right_[v] = 0;
    return ms;
  }
  double updown_solve_ms() override { return solve_kept(updatable_, right_, 1); }
  const double* solution() const override { return static_cast<const double*>(x_->x); }

 private:
  double& diagonal(size_t v) { return matrix_.value[static_cast<size_t>(matrix_.start[v])]; }
  double alpha() const { return 1e8 * mean_; }  // the paper's
  static void require(bool done, const char* what) {
    if (!done) throw std::runtime_error(std::string(what) + " failed");
  }
  cholmod_dense right_hand_side(std::vector<double>& right, uint32_t columns) const {
    cholmod_dense b{};
    b.nrow = b.d = n_;
    b.ncol = columns;
    b.nzmax = n_ * columns;
    b.x = right.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    return b;
  }
  double solve_kept(cholmod_factor* factor, std::vector<double>& right, uint32_t columns) {
    cholmod_dense b = right_hand_side(right, columns);
    return time_ms([&] {
      require(cholmod_solve2(CHOLMOD_A, factor, &b, nullptr, &x_, nullptr, &y_, &e_, &c_), "cholmod_solve2");
    });
  }
  // R holds sqrt(alpha) at the permuted row of every site, as the paper has it.
  double change(const std::vector<uint32_t>& sites, bool update) {
    if (sites.empty()) return 0;
    std::vector<int> start, row;
    std::vector<double> value(sites.size(), std::sqrt(alpha()));
    for (const uint32_t v : sites) {
      start.push_back(static_cast<int>(row.size()));
      row.push_back(position_[v]);
    }
    start.push_back(static_cast<int>(row.size()));
    cholmod_sparse r{};
    r.nrow = n_;
    r.ncol = sites.size();
    r.nzmax = sites.size();
    r.p = start.data();
    r.i = row.data();
    r.x = value.data();
    r.itype = CHOLMOD_INT;
    r.xtype = CHOLMOD_REAL;
    r.sorted = r.packed = 1;
    return time_ms([&] { require(cholmod_updown(update ? 1 : 0, &r, updatable_, &c_), "cholmod_updown"); });
  }

  size_t n_;
  uint32_t threads_;
  PeerMatrix matrix_;
  cholmod_common c_;
  cholmod_sparse view_{};
  cholmod_factor *factor_ = nullptr, *updatable_ = nullptr;
  cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
  std::vector<double> plain_, right_;
  std::vector<int> position_;
  double mean_ = 0;
};

}  // namespace

std::unique_ptr<CholmodPeer> CholmodPeer::make(PeerMatrix matrix, uint32_t threads) {
  return std::make_unique<Peer>(std::move(matrix), threads);
}

void give_peer_fitting_blas(char** argv) {
  auto* core = loaded<char*()>("openblas_get_corename");
  if (!core || std::getenv(core_type)) return;
  const std::string name = core();
  if (name != "Prescott" && name != "Generic" && name != "Core2") return;
  const char* fitting = hf_inner::factor::avx512_kernels() ? "SkylakeX"
                        : hf_inner::factor::avx2_kernels() ? "Haswell"
                                                           : nullptr;
  if (!fitting) return;
  setenv(core_type, fitting, 1);
  execv("/proc/self/exe", argv);  // returns only when it fails: the peer then runs as its BLAS would have it
}

std::vector<std::pair<std::string, std::string>> peer_versions() {
  auto* core = loaded<char*()>("openblas_get_corename");
  const char* forced = std::getenv(core_type);
  auto* config = loaded<char*()>("openblas_get_config");
  return {
      {"CHOLMOD", std::to_string(CHOLMOD_MAIN_VERSION) + "." + std::to_string(CHOLMOD_SUB_VERSION) + "." +
                      std::to_string(CHOLMOD_SUBSUB_VERSION) + " (SuiteSparse " +
                      std::to_string(SUITESPARSE_MAIN_VERSION) + "." + std::to_string(SUITESPARSE_SUB_VERSION) + "." +
                      std::to_string(SUITESPARSE_SUBSUB_VERSION) + "), METIS as it is linked with"},
      {"BLAS", config ? config() : "not OpenBLAS; threads as the environment sets them"},
      {"kernels of the BLAS", core ? std::string(core()) + (forced ? ", set by OPENBLAS_CORETYPE" : "") : "unknown"}};
}

}  // namespace bench

#else

namespace bench {
std::unique_ptr<CholmodPeer> CholmodPeer::make(PeerMatrix, uint32_t) { return nullptr; }
void give_peer_fitting_blas(char**) {}
std::vector<std::pair<std::string, std::string>> peer_versions() {
  return {{"peer", "none: this build has no GPL part (HF_WITH_GPL=OFF)"}};
}
}  // namespace bench

#endif
