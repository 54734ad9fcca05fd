// Eight threads use one object of every kind: they read it, make new objects of it, clone it and edit the clones. At
// last they edit clones while another thread destroys the originals. Each answer must have the bits that one thread
// gets on objects of its own. ThreadSanitizer must report nothing. (same_bits.cpp has a handle per thread, and
// tests/api/threads_test.c has calls that overlap a change.)
#include <array>
#include <atomic>
#include <thread>

#include "report.h"
#include "thread_stories.h"

using namespace reliability;

namespace {

constexpr unsigned thread_count = 8;

// Waits until all threads came here for the n-th time.
void meet(std::atomic<unsigned>& come, unsigned n) {
  for (++come; come < n * thread_count;) std::this_thread::yield();
}

template <class Body>
void on_eight(Body&& body) {
  std::vector<std::thread> threads;
  std::atomic<unsigned> ready{0};
  for (unsigned t = 0; t < thread_count; ++t) {
    threads.emplace_back([&, t] {
      meet(ready, 1);
      body(t);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = report_full(argc, argv) ? 20 : 2;
  const Scene scene = make_scene(32, 40);
  // one thread with objects of its own
  const std::size_t story_count = thread_stories.size();
  std::vector<std::array<std::uint64_t, thread_count>> alone(story_count);
  std::array<std::uint64_t, thread_count> edited{};
  unsigned failed = 0;
  const Objects own = make_objects(scene);
  for (std::size_t k = 0; k < story_count; ++k) {
    for (unsigned t = 0; t < thread_count; ++t) {
      Seen seen;
      thread_stories[k].tell(scene, own, t, seen);
      alone[k][t] = seen.hash();
      failed += seen.failed();
    }
  }
  for (unsigned t = 0; t < thread_count; ++t) {
    const Objects copies = clones_of(own);
    edited[t] = edit_all(scene, copies, t);
    destroy(copies);
  }
  destroy(own);
  report_at_most("THREADS_CALLS_THAT_FAIL_ALONE", failed, 0);

  // All tell the stories of the first round in step, so they ask at once for what a first call makes. Then they mix.
  std::atomic<unsigned> come{0};
  const Objects shared = make_objects(scene);
  std::vector<std::atomic<unsigned>> different(story_count);
  on_eight([&](unsigned t) {
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t i = 0; i < story_count; ++i) {
        if (round == 0) meet(come, static_cast<unsigned>(i) + 1);
        const std::size_t k = (i + (round > 0 ? t : 0)) % story_count;
        Seen seen;
        thread_stories[k].tell(scene, shared, t, seen);
        different[k] += seen.hash() != alone[k][t];
      }
    }
  });
  for (std::size_t k = 0; k < story_count; ++k) report_at_most(thread_stories[k].figure, different[k], 0);

  std::array<Objects, thread_count> copies;
  for (Objects& each : copies) each = clones_of(shared);
  std::atomic<unsigned> orphans{0};
  on_eight([&](unsigned t) {
    if (t == 0) destroy(shared);
    orphans += edit_all(scene, copies[t], t) != edited[t];
    destroy(copies[t]);
  });
  report_at_most("THREADS_CLONES_WHOSE_ORIGINAL_GOES", orphans, 0);
  return report_status();
}
