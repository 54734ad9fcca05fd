// The first use of what the library makes on demand, by eight threads at once. Eight threads read a transfer before its
// first frame: its fields must be solved once. Eight threads make solvers of a kind of field that the surface lacks:
// the factor must be made once. All threads must get the answers of one thread. ThreadSanitizer must report nothing.
//
// An allocator counts the work. Solving a transfer asks for many blocks, reading it later for none. How many blocks
// solvers ask for depends on the blocks that the library keeps, and threads share those. So factors are counted by
// their largest block: nothing else asks for one as large.
#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

#include "report.h"
#include "surfaces.h"
#include "support/arrays.h"

using namespace reliability;

namespace {

constexpr unsigned thread_count = 8;
std::atomic<long> allocations{0};
std::mutex sizes_mutex;
std::vector<std::size_t> sizes;  // of the blocks since the last count began

void* allocate(void*, std::size_t size, std::size_t alignment) {
  ++allocations;
  {
    const std::lock_guard<std::mutex> lock(sizes_mutex);
    sizes.push_back(size);
  }
  const std::size_t step = alignment < 16 ? 16 : alignment;
  return aligned_alloc(step, (size + step - 1) / step * step);
}
void release(void*, void* block, std::size_t, std::size_t) { free(block); }

hf_surface_desc counted(const Mesh& mesh, int field_kind = HF_FIELD_HARMONIC) {
  hf_surface_desc d = surface_desc(mesh);
  d.allocator = {allocate, release, nullptr};
  d.field_kind = field_kind;
  return d;
}

// Runs the body on eight threads, which start together.
template <class Body>
void on_eight(Body&& body) {
  std::vector<std::thread> threads;
  std::atomic<unsigned> come{0};
  for (unsigned t = 0; t < thread_count; ++t) {
    threads.emplace_back([&, t] {
      for (++come; come < thread_count;) std::this_thread::yield();
      body(t);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

// The allocations of what `work` does.
template <class Work>
long count(Work&& work) {
  const long before = allocations;
  sizes.clear();
  work();
  return allocations - before;
}

// Of the last count: the largest block, and how many blocks were at least so large.
std::size_t largest_block() { return sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end()); }
long blocks_from(std::size_t least) {
  return std::count_if(sizes.begin(), sizes.end(), [&](std::size_t size) { return size >= least; });
}

// ---- a transfer before its first frame ----

struct Answer {
  std::vector<double> numbers;
  bool operator!=(const Answer& other) const { return numbers != other.numbers; }
};

// Threads begin with different getters, so each kind comes first somewhere.
Answer read(hf_transfer transfer, unsigned first) {
  Answer answer;
  answer.numbers.resize(10 + 3 * 600);
  for (unsigned i = 0; i < 3; ++i) {
    switch ((first + i) % 3) {
      case 0:
        for (std::uint32_t p = 0; p < 2; ++p) {
          hf_pair_info pair = desc<hf_pair_info>();
          must(hf_transfer_get_pair(transfer, p, &pair), "hf_transfer_get_pair");
          answer.numbers[3 * p] = pair.source_leak;
          answer.numbers[3 * p + 1] = pair.confidence;
          answer.numbers[3 * p + 2] = pair.alignment_angle;
        }
        break;
      case 1: {
        hf_transfer_info info = desc<hf_transfer_info>();
        must(hf_transfer_get_info(transfer, &info), "hf_transfer_get_info");
        answer.numbers[6] = info.cluster_count;
        answer.numbers[7] = info.scale;
        answer.numbers[8] = info.aligned_count;
        break;
      }
      default: {
        hf_skin_info skin = desc<hf_skin_info>();
        skin.joint_capacity = 600;
        skin.pivots = answer.numbers.data() + 10;
        must(hf_transfer_get_skin(transfer, &skin), "hf_transfer_get_skin");
        answer.numbers[9] = skin.joint_count;
      }
    }
  }
  return answer;
}

hf_transfer make_transfer(hf_surface surface) {
  hf_transfer transfer = nullptr;
  must(hf_transfer_create(surface, surface, nullptr, &transfer), "hf_transfer_create");
  const std::uint32_t counts[2] = {20, 20};
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < 40; ++v) vertices.push_back(v < 20 ? v : 400 + v);
  hf_pairs_desc pairs = desc<hf_pairs_desc>();
  pairs.pair_count = 2;
  pairs.source_counts = pairs.target_counts = counts;
  pairs.source_vertices = pairs.target_vertices = vertices.data();
  must(hf_transfer_add_pairs(transfer, &pairs, nullptr), "hf_transfer_add_pairs");
  return transfer;
}

void transfers(const Mesh& mesh, int rounds, unsigned& different, unsigned& repeated) {
  const hf_surface surface = make_surface(counted(mesh));
  hf_transfer warm = make_transfer(surface);  // workspaces of the surface exist from here on
  read(warm, 0);
  hf_transfer_destroy(warm);
  const hf_transfer alone = make_transfer(surface);
  Answer right;
  const long first = count([&] { right = read(alone, 0); }), later = count([&] { read(alone, 0); });
  for (int round = 0; round < rounds; ++round) {
    const hf_transfer transfer = make_transfer(surface);
    std::atomic<unsigned> wrong{0};
    const long made = count([&] { on_eight([&](unsigned t) { wrong += read(transfer, t) != right; }); });
    different += wrong;
    // half a first call more would be a second solve; threads may need workspaces of their own
    repeated += made > first + (thread_count - 1) * later + (first - later) / 2;
    hf_transfer_destroy(transfer);
  }
  printf("a transfer read first: %ld allocations, later: %ld\n", first, later);
  hf_transfer_destroy(alone);
  hf_surface_destroy(surface);
}

// ---- a kind of field that the surface lacks ----

struct Made {
  hf_solver solver = nullptr;
  std::vector<double> field;
};

void make_and_solve(hf_surface surface, const Mesh& mesh, int kind, Made& made) {
  hf_solver_desc d = desc<hf_solver_desc>();
  d.field_kind = kind;
  made.solver = make_solver(surface, d);
  for (const std::uint32_t v : {3u, 200u, 411u}) {
    const double value = v % 7;
    must(hf_solver_add_site(made.solver, v, &value, nullptr), "hf_solver_add_site");
  }
  made.field.resize(mesh.vertex_count());
  must(hf_solver_solve(made.solver, OUT(made.field.data()), nullptr), "hf_solver_solve");
}

void kinds(const Mesh& mesh, int rounds, unsigned& different, unsigned& repeated) {
  for (int own = 0; own < 3; ++own) {
    const int kind = (own + 1) % 3;
    hf_surface surface = make_surface(counted(mesh, own));
    Made warm, right, second;
    make_and_solve(surface, mesh, own, warm);
    hf_solver_destroy(warm.solver);
    const long first = count([&] { make_and_solve(surface, mesh, kind, right); });
    const std::size_t factor = largest_block();
    const long blocks = blocks_from(factor);  // of one factor
    const long later = count([&] { make_and_solve(surface, mesh, kind, second); });
    // a second solver shares the factor of the first
    different += second.field != right.field;
    repeated += blocks_from(factor) != 0;
    hf_solver_destroy(right.solver);
    hf_solver_destroy(second.solver);
    for (int round = 0; round < rounds; ++round) {
      std::vector<Made> made(thread_count);
      count([&] { on_eight([&](unsigned t) { make_and_solve(surface, mesh, kind, made[t]); }); });
      repeated += blocks_from(factor) != blocks;
      if (round == rounds - 1) hf_surface_destroy(surface);  // the solvers still work
      for (const Made& each : made) {
        std::vector<double> again(mesh.vertex_count());
        must(hf_solver_solve(each.solver, OUT(again.data()), nullptr), "hf_solver_solve, again");
        different += each.field != right.field || again != right.field;
        hf_solver_destroy(each.solver);
      }
    }
    printf("kind %d on a surface of kind %d: %ld allocations (%ld of %zu bytes or more), later: %ld\n", kind, own,
           first, blocks, factor, later);
  }
}

// Solvers that come and go: the factor of their kind is made, shared, freed and made again.
void come_and_go(const Mesh& mesh, int rounds, unsigned& different) {
  const hf_surface surface = make_surface(counted(mesh));
  Made right[3];
  for (int kind = 0; kind < 3; ++kind) {
    make_and_solve(surface, mesh, kind, right[kind]);
    hf_solver_destroy(right[kind].solver);
  }
  std::atomic<unsigned> wrong{0};
  on_eight([&](unsigned t) {
    for (int round = 0; round < 4 * rounds; ++round) {
      const int kind = (static_cast<int>(t) + round) % 3;
      Made made;
      make_and_solve(surface, mesh, kind, made);
      wrong += made.field != right[kind].field;
      hf_solver_destroy(made.solver);
    }
  });
  different += wrong;
  hf_surface_destroy(surface);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = report_full(argc, argv) ? 100 : 5;
  Mesh mesh;
  add_torus(mesh, 24, 20);
  unsigned transfers_different = 0, solved_again = 0, kinds_different = 0, made_again = 0;
  transfers(mesh, rounds, transfers_different, solved_again);
  kinds(mesh, rounds, kinds_different, made_again);
  come_and_go(mesh, rounds, kinds_different);
  report_at_most("FIRST_CALLS_TRANSFERS_THAT_DIFFER", transfers_different, 0);
  report_at_most("FIRST_CALLS_TRANSFERS_SOLVED_AGAIN", solved_again, 0);
  report_at_most("FIRST_CALLS_KINDS_THAT_DIFFER", kinds_different, 0);
  report_at_most("FIRST_CALLS_FACTORS_MADE_AGAIN", made_again, 0);
  return report_status();
}
