// The same bits in every case: any number of threads, any job runner, a stack of 256 KiB, eight threads at once, before
// and after a fork. Eight threads use solvers of their own, clones of one, and one solver that they read. The program
// prints the hash of everything, so that builds can be compared (same_builds.sh). With --hash it does nothing else.
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cinttypes>
#include <cstring>
#include <thread>

#include "report.h"
#include "surfaces.h"
#include "whole_api.h"
#include "support/arrays.h"

using namespace reliability;

namespace {

unsigned unexpected;

std::uint64_t hash_of(const Scene& scene, const Options& options) {
  const Outcome outcome = run_whole_api(scene, options);
  if (outcome.unexpected > 0) fprintf(stderr, "%s answered %s\n", outcome.first, hf_result_get_name(outcome.got));
  unexpected += outcome.unexpected;
  return outcome.hash;
}

Options with_threads(std::uint32_t threads) {
  Options options;
  options.threads = threads;
  options.paper_engine = false;
  return options;
}

// A host's job system. It counts down, and runs every other index on a second thread.
void run_backwards(void*, std::uint32_t count, void (*job)(void*, std::uint32_t), void* data) {
  std::thread odd([=] {
    for (std::uint32_t i = 1; i < count; i += 2) job(data, i);
  });
  for (std::uint32_t i = (count + 1) / 2; i-- > 0;) job(data, 2 * i);
  odd.join();
}

// The hash of a field of 60 sites, on a mesh large enough for every parallel path.
std::uint64_t large_hash(const Mesh& mesh, std::uint32_t threads, const hf_job_runner* runner) {
  hf_surface_desc d = surface_desc(mesh);
  d.thread_count = threads;
  if (runner) d.job_runner = *runner;
  const hf_solver solver = make_solver(d);
  std::vector<std::uint32_t> vertices;
  std::vector<double> values, field(mesh.vertex_count());
  for (std::uint32_t i = 0; i < 60; ++i) {
    vertices.push_back(i * 331);
    values.push_back(i % 7);
  }
  hf_sites_desc sites = desc<hf_sites_desc>();
  sites.site_count = 60;
  sites.vertices = vertices.data();
  sites.values = values.data();
  must(hf_add_sites(solver, &sites, nullptr), "hf_add_sites");
  must(hf_solver_solve(solver, OUT(field.data()), nullptr), "hf_solver_solve");
  hf_solver_destroy(solver);
  std::uint64_t hash = 14695981039346656037u;
  const unsigned char* bytes = reinterpret_cast<const unsigned char*>(field.data());
  for (std::size_t i = 0; i < field.size() * sizeof(double); ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

struct Small {
  const Scene* scene;
  std::uint64_t hash;
};

// The hash of the whole API on a thread with this much stack.
[[maybe_unused]] std::uint64_t hash_on_stack(const Scene& scene, std::size_t bytes) {
  Small small{&scene, 0};
  pthread_attr_t attributes;
  pthread_t thread;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, bytes);
  const auto body = [](void* user) -> void* {
    Small* s = static_cast<Small*>(user);
    Options options;  // with the paper's engine
    s->hash = hash_of(*s->scene, options);
    return nullptr;
  };
  if (pthread_create(&thread, &attributes, body, &small) == 0) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  return small.hash;
}

// Eight threads run the whole API at once, each on handles of its own. Then all read one solver. At last all edit
// clones of it.
unsigned different_on_eight_threads(const Scene& scene, std::uint64_t expected, int rounds) {
  std::atomic<unsigned> different{0};
  const auto on_eight = [&](auto&& body) {
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < 8; ++t) threads.emplace_back([&, t] { body(t); });
    for (std::thread& thread : threads) thread.join();
  };
  on_eight([&](unsigned) {
    for (int i = 0; i < rounds; ++i) {
      const Outcome outcome = run_whole_api(scene, with_threads(1));
      different += outcome.hash != expected || outcome.unexpected > 0;
    }
  });

  Mesh mesh;
  add_torus(mesh, 40, 30);
  hf_surface_desc d = surface_desc(mesh);
  d.thread_count = 3;  // the threads of the surface; eight callers ask for them at once
  const hf_solver shared = make_solver(d);
  const std::uint32_t vertices[3] = {5, 500, 1100};
  const double values[3] = {0, 1, 5};
  hf_sites_desc sites = desc<hf_sites_desc>();
  sites.site_count = 3;
  sites.vertices = vertices;
  sites.values = values;
  must(hf_add_sites(shared, &sites, nullptr), "hf_add_sites");
  std::vector<double> right(mesh.vertex_count());
  must(hf_solver_solve(shared, OUT(right.data()), nullptr), "hf_solver_solve");
  on_eight([&](unsigned) {
    std::vector<double> field(mesh.vertex_count());
    for (int i = 0; i < 20 * rounds; ++i) {
      different += hf_solver_solve(shared, OUT(field.data()), nullptr) != HF_OK || field != right;
      double at = 0;
      const std::uint32_t asked = 700;
      different += hf_solver_solve_at(shared, 1, &asked, &at) != HF_OK || !(std::fabs(at - right[asked]) < 1e-12);
      hf_certificate certificate = desc<hf_certificate>();
      different += hf_solver_certify(shared, &certificate) != HF_OK;
      hf_solver_statistics statistics = desc<hf_solver_statistics>();
      different += hf_solver_get_statistics(shared, &statistics) != HF_OK || hf_solver_get_site_count(shared) != 3;
    }
  });
  std::vector<double> edited[8];
  on_eight([&](unsigned t) {
    for (int i = 0; i < 10 * rounds; ++i) {
      hf_solver copy = nullptr;
      different += hf_solver_clone(shared, &copy) != HF_OK;
      const std::uint32_t vertex = 40 + 17 * t, moved = 90;
      const double value = 3;
      std::uint32_t site = 0;
      hf_sites_desc more = desc<hf_sites_desc>(), to = desc<hf_sites_desc>();
      more.site_count = to.site_count = 1;
      more.vertices = &vertex;
      more.values = &value;
      to.vertices = &moved;
      different += hf_add_sites(copy, &more, &site) != HF_OK || hf_solver_move_sites(copy, 1, &site, &to) != HF_OK;
      std::vector<double> field(mesh.vertex_count());
      different += hf_solver_solve(copy, OUT(field.data()), nullptr) != HF_OK;
      if (edited[t].empty()) edited[t] = field;
      different += field != edited[t];
      hf_solver_destroy(copy);
    }
  });
  for (unsigned t = 1; t < 8; ++t) different += edited[t] != edited[0];  // all moved their site to one place
  hf_solver_destroy(shared);
  return different;
}

// A child process uses inherited handles, makes objects of its own, and exits.
[[maybe_unused]] unsigned wrong_in_a_child(const Scene& scene, std::uint64_t expected) {
  Mesh mesh;
  add_torus(mesh, 150, 120);
  hf_solver inherited[2];
  std::vector<double> field(mesh.vertex_count()), right;
  for (int i = 0; i < 2; ++i) {
    hf_surface_desc d = surface_desc(mesh);
    d.thread_count = i == 0 ? 1 : 4;
    inherited[i] = make_solver(d);
    const std::uint32_t vertices[2] = {1, 5000};
    const double values[2] = {0, 1};
    hf_sites_desc sites = desc<hf_sites_desc>();
    sites.site_count = 2;
    sites.vertices = vertices;
    sites.values = values;
    must(hf_add_sites(inherited[i], &sites, nullptr), "hf_add_sites");
    must(hf_solver_solve(inherited[i], OUT(field.data()), nullptr), "hf_solver_solve");
    right = field;
  }
  fflush(stdout);
  fflush(stderr);
  unsigned wrong = 0;
  for (int round = 0; round < 3; ++round) {
    const pid_t child = fork();
    if (child < 0) return 100;
    if (child == 0) {
      alarm(60);  // the signal ends a child that hangs
      unsigned bad = 0;
      for (const hf_solver solver : inherited) {
        bad += hf_solver_solve(solver, OUT(field.data()), nullptr) != HF_OK || field != right;
        hf_solver clone = nullptr;
        bad += hf_solver_clone(solver, &clone) != HF_OK;
        hf_solver_destroy(clone);
      }
      for (const std::uint32_t threads : {1u, 3u}) bad += run_whole_api(scene, with_threads(threads)).hash != expected;
      for (const hf_solver solver : inherited) hf_solver_destroy(solver);
      _exit(bad > 50 ? 50 : static_cast<int>(bad));
    }
    // the parent works on meanwhile
    for (const hf_solver solver : inherited)
      wrong += hf_solver_solve(solver, OUT(field.data()), nullptr) != HF_OK || field != right;
    int status = 0;
    waitpid(child, &status, 0);
    wrong += WIFEXITED(status) ? static_cast<unsigned>(WEXITSTATUS(status)) : 100;
  }
  for (const hf_solver solver : inherited) hf_solver_destroy(solver);
  return wrong;
}

// Forks right after a call. A late worker of the parent may hold a lock then; the child must not wait for it.
[[maybe_unused]] unsigned wrong_in_many_children(int count) {
  Mesh mesh;
  add_torus(mesh, 120, 100);  // large enough for sweeps on all threads
  hf_surface_desc d = surface_desc(mesh);
  d.thread_count = 16;
  const hf_solver solver = make_solver(d);
  const std::uint32_t vertices[2] = {1, 500};
  const double values[2] = {0, 1};
  hf_sites_desc sites = desc<hf_sites_desc>();
  sites.site_count = 2;
  sites.vertices = vertices;
  sites.values = values;
  must(hf_add_sites(solver, &sites, nullptr), "hf_add_sites");
  std::vector<double> field(mesh.vertex_count()), right = field;
  must(hf_solver_solve(solver, OUT(right.data()), nullptr), "hf_solver_solve");
  fflush(stdout);
  fflush(stderr);
  unsigned wrong = 0;
  for (int i = 0; i < count && wrong < 3; ++i) {  // a child that hangs takes 20 s
    must(hf_solver_solve(solver, OUT(field.data()), nullptr), "hf_solver_solve");
    const pid_t child = fork();
    if (child < 0) return wrong + 100;
    if (child == 0) {
      alarm(20);
      _exit(hf_solver_solve(solver, OUT(field.data()), nullptr) != HF_OK || field != right);
    }
    int status = 0;
    waitpid(child, &status, 0);
    wrong += !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  }
  hf_solver_destroy(solver);
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  const bool full = report_full(argc, argv);
  const Scene scene = make_scene();
  const std::uint64_t expected = hash_of(scene, with_threads(1));
  Mesh large;
  add_torus(large, 205, 200);
  const std::uint64_t expected_large = large_hash(large, 1, nullptr);
  printf("hash %016" PRIx64 " %016" PRIx64 "\n", expected, expected_large);
  if (argc > 1 && std::strcmp(argv[1], "--hash") == 0) return unexpected > 0;

  const hf_job_runner runner = {run_backwards, nullptr};
  unsigned different = 0;
  for (std::uint32_t threads = 2; threads <= 8; ++threads)
    different += hash_of(scene, with_threads(threads)) != expected;
  for (const std::uint32_t threads : {2u, 3u, 8u}) different += large_hash(large, threads, nullptr) != expected_large;
  Options hosted = with_threads(2);
  hosted.runner = &runner;
  different += hash_of(scene, hosted) != expected;
  different += large_hash(large, 2, &runner) != expected_large;
  report_at_most("SAME_BITS_THREADS_THAT_DIFFER", different, 0);
  report_at_most("SAME_BITS_EIGHT_THREADS_AT_ONCE", different_on_eight_threads(scene, expected, full ? 10 : 1), 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their stack frames are several times as large
  const std::uint64_t all = hash_of(scene, Options());
  report_at_most("SAME_BITS_STACK_OF_256_KIB", hash_on_stack(scene, 256 * 1024) != all, 0);
#endif
#if !defined(__SANITIZE_THREAD__)  // it does not follow a fork of a process with threads
  report_at_most("SAME_BITS_WRONG_IN_A_FORKED_CHILD", wrong_in_a_child(scene, expected), 0);
  report_at_most("SAME_BITS_WRONG_IN_MANY_CHILDREN", wrong_in_many_children(full ? 2000 : 300), 0);
#endif
  report_at_most("SAME_BITS_UNEXPECTED_ANSWERS", unexpected, 0);
  return report_status();
}
