#include "bench/peer_cholmod.h"

#ifdef HF_WITH_GPL

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace bench {
namespace {

class Peer final : public CholmodPeer {
 public:
  explicit Peer(const Mesh& mesh) : n_(mesh.vertex_count()) {
    cholmod_start(&c_);
    c_.supernodal = CHOLMOD_SUPERNODAL, c_.nmethods = 1, c_.method[0].ordering = CHOLMOD_METIS, c_.print = 0;
    build(mesh);
    const Clock clock;
    l_ = cholmod_analyze(a_, &c_);
    analyse_ms_ = clock.milliseconds();
    if (!l_) throw std::runtime_error("cholmod_analyze failed");
    b_ = cholmod_zeros(n_, 1, CHOLMOD_REAL, &c_);
  }
  ~Peer() override {
    cholmod_free_factor(&l_, &c_);
    cholmod_free_sparse(&a_, &c_);
    cholmod_free_dense(&b_, &c_);
    cholmod_finish(&c_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  double analyse_ms() const override { return analyse_ms_; }
  void set_sites(const std::vector<uint32_t>& vertices) override {
    double* x = static_cast<double*>(a_->x);
    std::fill_n(static_cast<double*>(b_->x), n_, 0.0);
    for (size_t v = 0; v < n_; ++v) x[diagonal_[v]] = plain_[v];
    for (const uint32_t v : vertices) {
      const double alpha = 1e8 * mean_;
      x[diagonal_[v]] += alpha;
      static_cast<double*>(b_->x)[v] = alpha * value_of(v);
    }
  }
  double factorise_ms() override {
    const Clock clock;
    if (!cholmod_factorize(a_, l_, &c_)) throw std::runtime_error("cholmod_factorize failed");
    return clock.milliseconds();
  }
  double solve_ms() override {
    const Clock clock;
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, l_, b_, &c_);
    const double ms = clock.milliseconds();
    if (!x) throw std::runtime_error("cholmod_solve failed");
    cholmod_free_dense(&x, &c_);
    return ms;
  }

 private:
  // plain cotangent Laplacian, lower triangle by columns
  void build(const Mesh& mesh) {
    std::vector<std::map<uint32_t, double>> columns(n_);
    plain_.assign(n_, 0.0);
    for (size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t i = mesh.triangles[t + (k + 1) % 3], j = mesh.triangles[t + (k + 2) % 3],
                       o = mesh.triangles[t + k];
        std::array<double, 3> a{}, b{};
        for (size_t d = 0; d < 3; ++d)
          a[d] = mesh.positions[3 * i + d] - mesh.positions[3 * o + d],
          b[d] = mesh.positions[3 * j + d] - mesh.positions[3 * o + d];
        const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        const double cx = a[1] * b[2] - a[2] * b[1], cy = a[2] * b[0] - a[0] * b[2], cz = a[0] * b[1] - a[1] * b[0];
        const double w = 0.5 * dot / std::sqrt(cx * cx + cy * cy + cz * cz);
        columns[std::min(i, j)][std::max(i, j)] -= w;
        plain_[i] += w, plain_[j] += w;
      }
    }
    size_t entries = n_;
    for (const auto& column : columns) entries += column.size();
    a_ = cholmod_allocate_sparse(n_, n_, entries, 1, 1, -1, CHOLMOD_REAL, &c_);
    int* p = static_cast<int*>(a_->p);
    int* i = static_cast<int*>(a_->i);
    double* x = static_cast<double*>(a_->x);
    int used = 0;
    diagonal_.resize(n_);
    for (size_t v = 0; v < n_; ++v) {
      p[v] = used;
      diagonal_[v] = used, i[used] = static_cast<int>(v), x[used++] = plain_[v];
      for (const auto& [row, value] : columns[v]) i[used] = static_cast<int>(row), x[used++] = value;
      mean_ += plain_[v] / static_cast<double>(n_);
    }
    p[n_] = used;
  }

  size_t n_;
  cholmod_common c_;
  cholmod_sparse* a_ = nullptr;
  cholmod_factor* l_ = nullptr;
  cholmod_dense* b_ = nullptr;
  std::vector<double> plain_;
  std::vector<int> diagonal_;
  double mean_ = 0, analyse_ms_ = 0;
};

}  // namespace

std::unique_ptr<CholmodPeer> CholmodPeer::make(const Mesh& mesh) { return std::make_unique<Peer>(mesh); }

}  // namespace bench

#else

namespace bench {
std::unique_ptr<CholmodPeer> CholmodPeer::make(const Mesh&) { return nullptr; }
}  // namespace bench

#endif
