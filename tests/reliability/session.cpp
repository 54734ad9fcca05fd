// A long session on one solver, and the memory it takes: 100,000 edits on 41,000 vertices. Every twentieth edit solves
// a field. Each tenth of the session makes 500 clones for undo; the host keeps the last 256.
//
// The figures compare the memory of the library and of the process after the first tenth and at the end: the least of
// the last three tenths, because the places of gaps move it up and down by megabytes. Destroyed clones leave gaps in
// the heap that are used again; malloc_trim returns them before the process is measured. The growth with these gaps is
// a figure of its own. The long form also compares the time of an edit at the end with the beginning. It takes the
// fastest of twenty stretches, because other programs share the machine. The quick form makes 40,000 edits on 9,800
// vertices.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>

#include "report.h"
#include "surfaces.h"

using namespace reliability;

namespace {

double resident_bytes() {
  double size = 0;
  if (FILE* file = std::fopen("/proc/self/statm", "r")) {
    long pages = 0, resident = 0;
    if (std::fscanf(file, "%ld %ld", &pages, &resident) == 2) size = 4096.0 * static_cast<double>(resident);
    std::fclose(file);
  }
  return size;
}

struct Stretch {
  double fastest_ms = 1e9, library_bytes = 0, process_bytes = 0, with_gaps_bytes = 0;
};

using Clones = std::deque<hf_solver>;

void keep(Clones& clones, hf_solver solver) {
  constexpr std::size_t most = 256;
  clones.push_back(nullptr);
  must(hf_solver_clone(solver, &clones.back()), "hf_solver_clone");
  if (clones.size() <= most) return;
  hf_solver_destroy(clones.front());
  clones.pop_front();
}

// `count` edits in twenty parts.
Stretch edit_on(EditedSolver& solver, Clones& clones, int count) {
  Stretch stretch;
  const std::vector<double> offsets = {0};
  std::vector<double> field;
  for (int part = 0; part < 20; ++part) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < count / 20; ++i) {
      if (i % (count / 500) == 0) keep(clones, solver.get());
      solver.edit(50, offsets);
    }
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    stretch.fastest_ms = std::min(stretch.fastest_ms, took.count() / (count / 20));
    for (int i = 0; i < count / 400; ++i) field = solver.field();
  }
  hf_surface_statistics statistics = desc<hf_surface_statistics>();
  must(hf_surface_get_statistics(solver.surface(), &statistics), "hf_surface_get_statistics");
  stretch.library_bytes = statistics.memory_bytes;
  hf_solver_destroy(clones.front());  // kept blocks go back with it
  clones.pop_front();
  stretch.with_gaps_bytes = resident_bytes();
  malloc_trim(0);
  stretch.process_bytes = resident_bytes();
  return stretch;
}

Stretch least(const Stretch& a, const Stretch& b) {
  return {std::min(a.fastest_ms, b.fastest_ms), std::min(a.library_bytes, b.library_bytes),
          std::min(a.process_bytes, b.process_bytes), std::min(a.with_gaps_bytes, b.with_gaps_bytes)};
}

}  // namespace

int main(int argc, char** argv) {
  const bool full = report_full(argc, argv);
  const int edits = full ? 100000 : 40000;
  Mesh mesh;
  full ? add_torus(mesh, 205, 200) : add_torus(mesh, 100, 98);
  EditedSolver solver(mesh, 1, 5);
  solver.add(50, {0});
  Clones clones;
  const Stretch first = edit_on(solver, clones, edits / 10);
  Stretch last = first;
  for (int tenth = 2; tenth <= 10; ++tenth) {
    const Stretch next = edit_on(solver, clones, edits / 10);
    last = tenth > 8 ? least(last, next) : next;
  }
  for (const hf_solver clone : clones) hf_solver_destroy(clone);
  report_at_least("SESSION_EDITS", edits, 40000);
  report_at_most("SESSION_LIBRARY_GROWTH_BYTES", last.library_bytes - first.library_bytes, 1 << 20);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep what was given back
  // Blocks that the library keeps from edit to edit lie between those of clones: their places are gaps later.
  const double kept = full ? 8 << 20 : 2 << 20;  // their length is the number of vertices
  report_at_most("SESSION_PROCESS_GROWTH_BYTES", last.process_bytes - first.process_bytes, kept);
  report_at_most("SESSION_PROCESS_GROWTH_WITH_GAPS_BYTES", last.with_gaps_bytes - first.with_gaps_bytes, 2.5 * kept);
#endif
  if (full)  // the quick form's stretches are too short for a machine that others use
    report_at_most("SESSION_LAST_EDITS_TO_FIRST", last.fastest_ms / first.fastest_ms, 3);
  return report_status();
}
