// A long session on one solver: 100,000 edits on 41,000 vertices, a field every twentieth, an undo record 500 times in
// every tenth (the stack is bounded). The memory of the solver after the first tenth and at the end; that of the
// process from the tenth that ends 15,000 edits or more on: clones that come and go as undo records leave gaps in the C
// library's heap, which are filled by then, and no more come (40 tenths long, it stays to the page). What the gaps take
// is a figure of its own: the growth of the process from the first tenth on. In the long form also how long an edit
// takes at the end and at the beginning (the fastest of twenty stretches each, because other programs run beside this
// one). The quick form makes 40,000 edits on 9,800 vertices.
#include <algorithm>
#include <chrono>
#include <cstring>

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
  double fastest_ms = 1e9, library_bytes = 0, process_bytes = 0;
};

// `count` edits in twenty parts.
Stretch edit_on(EditedSolver& solver, int count) {
  Stretch stretch;
  const std::vector<double> offsets = {0};
  std::vector<double> field;
  for (int part = 0; part < 20; ++part) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < count / 20; ++i) {
      if (i % (count / 500) == 0) must(hf_record(solver.get()), "hf_record");
      solver.edit(50, offsets);
    }
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    stretch.fastest_ms = std::min(stretch.fastest_ms, took.count() / (count / 20));
    for (int i = 0; i < count / 400; ++i) field = solver.field();
  }
  hf_statistics statistics = desc<hf_statistics>();
  must(hf_get_statistics(solver.get(), &statistics), "hf_get_statistics");
  stretch.library_bytes = statistics.memory_bytes, stretch.process_bytes = resident_bytes();
  return stretch;
}

}  // namespace

int main(int argc, char** argv) {
  const bool full = report_full(argc, argv);
  const int edits = full ? 100000 : 40000;
  Surface surface;
  full ? add_torus(surface, 205, 200) : add_torus(surface, 100, 98);
  EditedSolver solver(surface, 1, 5);
  solver.add(50, {0});
  const Stretch first = edit_on(solver, edits / 10);
  Stretch settled = first, last = first;
  for (int tenth = 2; tenth <= 10; ++tenth) {
    last = edit_on(solver, edits / 10);
    if ((tenth - 1) * (edits / 10) < 15000) settled = last;
  }
  report_at_least("SESSION_EDITS", edits, 40000);
  report_at_most("SESSION_LIBRARY_GROWTH_BYTES", last.library_bytes - first.library_bytes, 1 << 20);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep what was given back
  report_at_most("SESSION_PROCESS_GROWTH_BYTES", last.process_bytes - settled.process_bytes, 1 << 20);
  report_at_most("SESSION_PROCESS_GROWTH_WITH_GAPS_BYTES", last.process_bytes - first.process_bytes, 4 << 20);
#endif
  if (full)  // the quick form's stretches are too short for a machine that others use
    report_at_most("SESSION_LAST_EDITS_TO_FIRST", last.fastest_ms / first.fastest_ms, 3);
  return report_status();
}
