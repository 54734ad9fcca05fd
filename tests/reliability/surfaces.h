// Meshes for the long tests, with surfaces and solvers on them.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "hf/hf.h"
#include "support/arrays.h"
#include "support/peers.h"

namespace reliability {

struct Mesh {
  std::vector<float> positions;
  std::vector<std::uint32_t> triangles;
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size() / 3); }
};

// Appends a bumpy torus of nu x nv vertices, shifted by dx along x.
inline void add_torus(Mesh& mesh, std::uint32_t nu, std::uint32_t nv, double dx = 0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  const std::uint32_t base = mesh.vertex_count();
  const double turn = 6.283185307179586;
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      const double u = turn * (i + jitter(random)) / nu, v = turn * (j + jitter(random)) / nv;
      const double r = 1 + 0.2 * std::sin(5 * u);
      for (const double p :
           {dx + (3 + r * std::cos(v)) * std::cos(u), (3 + r * std::cos(v)) * std::sin(u), r * std::sin(v)})
        mesh.positions.push_back(static_cast<float>(p));
    }
  }
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      const std::uint32_t a = base + i * nv + j, b = base + (i + 1) % nu * nv + j,
                          c = base + (i + 1) % nu * nv + (j + 1) % nv, d = base + i * nv + (j + 1) % nv;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    }
  }
}

template <class T>
T desc() {
  return HF_INIT(T);
}

// Checks a call that must succeed. On failure it prints the library's message and ends the program.
inline void must(hf_result result, const char* what) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  std::fprintf(stderr, "%s: %s: %s\n", what, hf_result_get_name(result), detail.message);
  std::exit(1);
}

inline hf_surface_desc surface_desc(const Mesh& mesh) {
  hf_surface_desc d = desc<hf_surface_desc>();
  d.positions = HF_ARRAY(mesh.positions.data(), mesh.vertex_count());
  d.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangles.size() / 3);
  return d;
}

inline hf_surface make_surface(const hf_surface_desc& d) {
  hf_surface surface = nullptr;
  must(hf_surface_create(&d, &surface), "hf_surface_create");
  return surface;
}

// engine: ENGINE_*
inline hf_solver make_solver(hf_surface surface, const hf_solver_desc& d = desc<hf_solver_desc>(),
                             std::int32_t engine = ENGINE_GREEN) {
  hf_solver solver = nullptr;
  must(create_with(engine, surface, &d, &solver), "hf_create");
  return solver;
}

// A solver on a surface that is destroyed at once: the solver keeps what it needs.
inline hf_solver make_solver(const hf_surface_desc& on, hf_solver_desc d = desc<hf_solver_desc>(),
                             std::int32_t engine = ENGINE_GREEN) {
  const hf_surface surface = make_surface(on);
  d.field_kind = on.field_kind;
  const hf_solver solver = make_solver(surface, d, engine);
  hf_surface_destroy(surface);
  return solver;
}

// A solver under random edits. It remembers its sites.
class EditedSolver {
 public:
  EditedSolver(const Mesh& mesh, std::uint32_t channels, unsigned seed) : mesh_(mesh), m_(channels), random_(seed) {
    hf_solver_desc d = desc<hf_solver_desc>();
    d.channel_count = channels;
    surface_ = make_surface(surface_desc(mesh));
    solver_ = make_solver(surface_, d);
  }
  ~EditedSolver() {
    hf_surface_destroy(surface_);
    hf_solver_destroy(solver_);
  }
  EditedSolver(const EditedSolver&) = delete;
  EditedSolver& operator=(const EditedSolver&) = delete;

  struct Held {
    std::uint32_t site, vertex;
    std::vector<double> values;
    double stiffness;  // 0 = hard
  };

  void add(std::size_t count, const std::vector<double>& offsets) {
    for (std::size_t i = 0; i < count; ++i) {
      Held h{0, free_vertex(), fresh_values(offsets), random_() % 10 == 0 ? 100.0 : 0.0};
      hf_sites_desc d = desc<hf_sites_desc>();
      d.site_count = 1;
      d.vertices = &h.vertex;
      d.values = h.values.data();
      d.stiffness = &h.stiffness;
      must(hf_add_sites(solver_, &d, &h.site), "hf_add_sites");
      taken_[h.vertex] = 1;
      held.push_back(h);
    }
  }
  void remove_one() {
    const std::size_t at = random_() % held.size();
    must(hf_remove_sites(solver_, 1, &held[at].site), "hf_remove_sites");
    taken_[held[at].vertex] = 0;
    held[at] = held.back();
    held.pop_back();
  }
  // Makes one random edit. Most move or set a site, some add or remove one. The count stays near `wanted`.
  void edit(std::size_t wanted, const std::vector<double>& offsets) {
    const unsigned kind = random_() % 10;
    Held& h = held[random_() % held.size()];
    if (kind < 4) {  // move
      const std::uint32_t to = free_vertex();
      hf_sites_desc d = desc<hf_sites_desc>();
      d.site_count = 1;
      d.vertices = &to;
      must(hf_solver_move_sites(solver_, 1, &h.site, &d), "hf_solver_move_sites");
      taken_[h.vertex] = 0;
      taken_[to] = 1;
      h.vertex = to;
    } else if (kind < 7) {
      h.values = fresh_values(offsets);
      must(hf_solver_set_values(solver_, 1, &h.site, h.values.data()), "hf_solver_set_values");
    } else if (held.size() > wanted + random_() % 10 || (held.size() + 5 > wanted && kind == 9)) {
      remove_one();
    } else {
      add(1, offsets);
    }
  }

  hf_solver get() const { return solver_; }
  hf_surface surface() const { return surface_; }
  std::vector<double> field() const {
    std::vector<double> values(std::size_t{mesh_.vertex_count()} * m_);
    must(hf_solver_solve(solver_, OUT(values.data()), nullptr), "hf_solver_solve");
    return values;
  }
  // The field of a new solver with the same sites, on the same surface.
  std::vector<double> fresh_field(std::int32_t engine) const {
    hf_solver_desc d = desc<hf_solver_desc>();
    d.channel_count = m_;
    const hf_solver solver = make_solver(surface_, d, engine);
    std::vector<std::uint32_t> vertices;
    std::vector<double> values, stiffness, out(std::size_t{mesh_.vertex_count()} * m_);
    for (const Held& h : held) {
      vertices.push_back(h.vertex);
      stiffness.push_back(h.stiffness);
      values.insert(values.end(), h.values.begin(), h.values.end());
    }
    hf_sites_desc sites = desc<hf_sites_desc>();
    sites.site_count = static_cast<std::uint32_t>(held.size());
    sites.vertices = vertices.data();
    sites.values = values.data();
    sites.stiffness = stiffness.data();
    must(hf_add_sites(solver, &sites, nullptr), "hf_add_sites, fresh");
    must(hf_solver_solve(solver, OUT(out.data()), nullptr), "hf_solver_solve, fresh");
    hf_solver_destroy(solver);
    return out;
  }

  std::vector<Held> held;

 private:
  std::uint32_t free_vertex() {
    if (taken_.empty()) taken_.resize(mesh_.vertex_count(), 0);
    for (;;) {
      const std::uint32_t v = static_cast<std::uint32_t>(random_() % mesh_.vertex_count());
      if (!taken_[v]) return v;
    }
  }
  // One value per channel, each in [offset, offset + 1].
  std::vector<double> fresh_values(const std::vector<double>& offsets) {
    std::vector<double> values;
    for (std::uint32_t c = 0; c < m_; ++c)
      values.push_back(offsets[c] + std::uniform_real_distribution<double>(0, 1)(random_));
    return values;
  }

  const Mesh& mesh_;
  std::uint32_t m_;
  std::mt19937 random_;
  std::vector<char> taken_;
  hf_surface surface_ = nullptr;
  hf_solver solver_ = nullptr;
};

}  // namespace reliability
