// Faulty hooks of a host. allocate throws at each place in turn, with four types of exception. run throws before or
// after the jobs. It runs them twice, backwards or not at all, or it calls the library. Every call must end with a
// result, leave the object as it was, and succeed when it is repeated.
#include <atomic>
#include <stdexcept>
#include <thread>

#include "report.h"
#include "surfaces.h"
#include "support/arrays.h"

using namespace reliability;

namespace {

struct Foreign {};  // not a std::exception

struct Host {
  std::atomic<long> until_throw{-1};  // allocations until one throws; negative: never
  int kind = 0;                       // what is thrown
  int runner = 0;
  hf_solver solver = nullptr;
  std::atomic<long> live{0};
  std::atomic<unsigned> reentered{0}, wrong{0};
};

void* allocate(void* user, std::size_t size, std::size_t alignment) {
  Host& host = *static_cast<Host*>(user);
  if (host.until_throw >= 0 && host.until_throw-- == 0) {
    if (host.kind == 0) throw std::runtime_error("a fault of the host");
    if (host.kind == 1) throw std::bad_alloc();
    if (host.kind == 2) throw Foreign();
    throw 7;
  }
  const std::size_t step = alignment < 16 ? 16 : alignment;
  void* block = aligned_alloc(step, (size + step - 1) / step * step);
  if (block) ++host.live;
  return block;
}
void release(void* user, void* block, std::size_t, std::size_t) {
  --static_cast<Host*>(user)->live;
  free(block);
}

void run(void* user, std::uint32_t count, void (*job)(void*, std::uint32_t), void* data) {
  Host& host = *static_cast<Host*>(user);
  const auto all = [&] {
    for (std::uint32_t i = count; i-- > 0;) job(data, i);
  };
  if (host.runner == 1) throw std::runtime_error("a fault of the host's runner");
  if (host.runner == 2) return;  // does nothing
  all();
  if (host.runner == 3) all();
  if (host.runner == 4) throw Foreign();
  if (host.runner == 5 && host.solver) {  // a change from inside: refused
    ++host.reentered;
    const hf_result result = hf_solver_set_screening(host.solver, nullptr, nullptr);
    host.wrong += result != HF_ERROR_REENTRANT && result != HF_ERROR_BUSY;
  }
}

hf_result add(hf_solver solver, std::uint32_t count, std::uint32_t first) {
  std::vector<std::uint32_t> vertices;
  std::vector<double> values;
  for (std::uint32_t i = 0; i < count; ++i) {
    vertices.push_back(first + 37 * i);
    values.push_back(i % 5);
  }
  hf_sites_desc d = desc<hf_sites_desc>();
  d.site_count = count;
  d.vertices = vertices.data();
  d.values = values.data();
  return hf_add_sites(solver, &d, nullptr);
}

bool is_answer(int kind, hf_result result) {
  return result == HF_OK || result == (kind == 1 ? HF_ERROR_OUT_OF_MEMORY : HF_ERROR_INTERNAL);
}

double live_bytes(hf_surface surface) {
  hf_surface_statistics statistics = desc<hf_surface_statistics>();
  must(hf_surface_get_statistics(surface, &statistics), "hf_surface_get_statistics");
  return statistics.memory_bytes;
}

}  // namespace

int main() {
  Mesh mesh;
  add_torus(mesh, 60, 50);
  Host host;
  hf_surface_desc d = surface_desc(mesh);
  d.allocator = {allocate, release, &host};
  unsigned thrown = 0;

  // allocate throws at each place in turn: while a surface is made, a second factor, and sites; on 1 and 3 threads
  for (const std::uint32_t threads : {1u, 3u}) {
    d.thread_count = threads;
    for (int kind = 0; kind < 4; ++kind) {
      host.kind = kind;
      for (long at = 0;; at += 1 + at / 3) {
        const long before = host.live;
        hf_surface surface = nullptr;
        host.until_throw = at;
        const hf_result made = hf_surface_create(&d, &surface);
        const bool struck = host.until_throw < 0;
        host.until_throw = -1;
        host.wrong += !is_answer(kind, made) || (made != HF_OK && (surface || host.live != before));
        thrown += made != HF_OK;
        hf_surface_destroy(surface);
        host.wrong += host.live != before;
        if (!struck) break;
      }
      const hf_surface surface = make_surface(d);
      hf_solver_desc bent = desc<hf_solver_desc>();
      bent.field_kind = HF_FIELD_BIHARMONIC;
      for (long at = 0;; at += 1 + at / 3) {  // the factor that the surface lacks
        hf_solver_destroy(make_solver(surface));  // kept blocks go back with it
        const long before = host.live;
        hf_solver second = nullptr;
        host.until_throw = at;
        const hf_result made = hf_create(surface, &bent, &second);
        const bool struck = host.until_throw < 0;
        host.until_throw = -1;
        host.wrong += !is_answer(kind, made) || (made != HF_OK && (second || host.live != before));
        thrown += made != HF_OK;
        hf_solver_destroy(second);
        host.wrong += host.live > before + (made == HF_OK);  // the block that remembers a freed factor
        if (!struck) break;
      }
      hf_solver solver = make_solver(surface);
      must(add(solver, 5, 11), "hf_add_sites");
      std::vector<double> right(mesh.vertex_count()), field(right), before(right);
      must(hf_solver_solve(solver, OUT(before.data()), nullptr), "hf_solver_solve");
      hf_solver other = nullptr;
      must(hf_solver_clone(solver, &other), "hf_solver_clone");
      must(add(other, 40, 3), "hf_add_sites");
      must(hf_solver_solve(other, OUT(right.data()), nullptr), "hf_solver_solve");
      hf_solver_destroy(other);
      const double bytes = live_bytes(surface);
      for (long at = 0;; at += 1 + at / 8) {
        host.until_throw = at;
        const hf_result added = add(solver, 40, 3);
        host.until_throw = -1;
        host.wrong += !is_answer(kind, added);
        if (added == HF_OK) break;
        ++thrown;
        host.wrong += hf_solver_get_site_count(solver) != 5 || live_bytes(surface) != bytes;
        must(hf_solver_solve(solver, OUT(field.data()), nullptr), "hf_solver_solve");
        host.wrong += field != before;
      }
      must(hf_solver_solve(solver, OUT(field.data()), nullptr), "hf_solver_solve");
      host.wrong += field != right;
      hf_surface_destroy(surface);
      hf_solver_destroy(solver);
    }
  }

  // the runner, on a mesh large enough to use it
  Mesh large;
  add_torus(large, 205, 200);
  d = surface_desc(large);
  d.allocator = {allocate, release, &host};
  d.thread_count = 2;
  hf_solver plain = make_solver(d);
  must(add(plain, 5, 11), "hf_add_sites");
  std::vector<double> right(large.vertex_count()), field(right);
  must(hf_solver_solve(plain, OUT(right.data()), nullptr), "hf_solver_solve");
  hf_solver_destroy(plain);
  d.job_runner = {run, &host};
  unsigned refused = 0;
  for (int runner = 0; runner < 6; ++runner) {
    host.runner = 0;
    hf_solver solver = make_solver(d);
    host.runner = runner;
    host.solver = solver;
    const hf_result added = add(solver, 5, 11);
    host.runner = 0;
    host.wrong += added != HF_OK && added != HF_ERROR_INTERNAL;
    refused += added != HF_OK;
    if (added != HF_OK) {
      host.wrong += hf_solver_get_site_count(solver) != 0;
      must(add(solver, 5, 11), "hf_add_sites, again");
    }
    host.runner = runner;
    const hf_result solved = hf_solver_solve(solver, OUT(field.data()), nullptr);
    host.runner = 0;
    host.solver = nullptr;
    refused += solved != HF_OK;
    host.wrong += solved != HF_OK && solved != HF_ERROR_INTERNAL;
    must(hf_solver_solve(solver, OUT(field.data()), nullptr), "hf_solver_solve, again");
    host.wrong += field != right;
    hf_solver_destroy(solver);
  }
  report_at_least("CALLBACKS_EXCEPTIONS_SURVIVED", thrown, 200);
  report_at_least("CALLBACKS_FAULTY_RUNS_REFUSED", refused, 2);
  report_at_least("CALLBACKS_REENTERED", host.reentered, 1);
  report_at_most("CALLBACKS_WRONG_ANSWERS", host.wrong, 0);
  report_at_most("CALLBACKS_BLOCKS_LEFT", static_cast<double>(host.live), 0);
  return report_status();
}
