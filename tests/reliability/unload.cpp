// Loads, uses and unloads the library over and over, as an editor does with its plug-ins: unload PLUGIN LIBRARY. After
// each round the library, its threads and its descriptors must be gone. The hash of the results stays the same, and the
// heap does not grow.
#include <dlfcn.h>
#include <malloc.h>
#include <unistd.h>

#include "process.h"
#include "report.h"
#include "whole_api.h"

namespace {

using reliability::entries;

// Threads of the process. The kernel may list joined threads for a moment.
unsigned settled_threads(unsigned expected) {
  unsigned count = entries("/proc/self/task");
  for (int wait = 0; wait < 200 && count != expected; ++wait) {
    usleep(5000);
    count = entries("/proc/self/task");
  }
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return fprintf(stderr, "usage: unload PLUGIN LIBRARY [--full]\n"), 2;
  const int rounds = report_full(argc, argv) ? 200 : 30;
  const reliability::Scene scene = reliability::make_scene();
  std::uint64_t first = 0;
  unsigned wrong = 0, still_there = 0;
  double heap = 0;
  const unsigned threads = entries("/proc/self/task");
  unsigned descriptors = 0;
  for (int round = 0; round < rounds; ++round) {
    void* plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!plugin) return fprintf(stderr, "%s\n", dlerror()), 1;
    int (*run)(const void*, std::uint64_t*) = nullptr;
    *reinterpret_cast<void**>(&run) = dlsym(plugin, "hf_plugin_run");
    if (!run) return fprintf(stderr, "%s\n", dlerror()), 1;
    std::uint64_t hash = 0;
    wrong += static_cast<unsigned>(run(&scene, &hash));
    if (round == 0) first = hash;
    wrong += hash != first;
    dlclose(plugin);
    if (void* left = dlopen(argv[2], RTLD_NOW | RTLD_NOLOAD)) {
      ++still_there;
      dlclose(left);
    }
    // after ten rounds the loader and the heap hold what they keep
    if (round == 9) {
      heap = static_cast<double>(mallinfo2().uordblks);
      descriptors = entries("/proc/self/fd");
    }
  }
  report_at_least("UNLOAD_ROUNDS", rounds, 30);
  report_at_most("UNLOAD_LIBRARY_STILL_THERE", still_there, 0);
  report_at_most("UNLOAD_WRONG_ANSWERS", wrong, 0);
  report_at_most("UNLOAD_THREADS_LEFT", settled_threads(threads) - static_cast<double>(threads), 0);
  report_at_most("UNLOAD_DESCRIPTORS_LEFT", entries("/proc/self/fd") - static_cast<double>(descriptors), 0);
  report_at_most("UNLOAD_HEAP_GROWTH_BYTES", static_cast<double>(mallinfo2().uordblks) - heap, 65536);
  return report_status();
}
