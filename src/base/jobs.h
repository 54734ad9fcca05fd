// Splits work over the threads that the caller allows: a thread pool of the library, or the host's own job runner.
// Results never depend on the number of threads. The work is cut into fixed pieces, and each piece writes its own
// output. The order of a sum over several pieces never depends on threads.
#pragma once
#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>

#include "base/memory.h"
#include "base/progress.h"
#include "hf/base.h"

namespace hf_inner {

// 0 or 1, swapped by several threads. A word, because riscv64 swaps no single byte without a library of its own.
using AtomicFlag = std::atomic<std::int32_t>;

class JobRunner {
 public:
  // Makes a runner of parallel jobs. thread_count: threads that may work at once, including the calling thread; 1 runs
  // every job on the calling thread.
  explicit JobRunner(std::uint32_t thread_count, const hf_job_runner& host = {});
  ~JobRunner();
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  std::uint32_t thread_count() const noexcept { return thread_count_; }

  // Calls job(index) once for each index = 0 .. count - 1, on any thread and in any order. Returns when all jobs are
  // done. If a job throws, the first exception is rethrown on the calling thread, and remaining jobs may be skipped.
  template <class Job>
  void for_each(std::uint32_t count, Job&& job) {
    if (count == 0) return;
    if (thread_count_ == 1 || count == 1) {
      for (std::uint32_t i = 0; i < count; ++i) {
        poll();
        job(i);
      }
      return;
    }
    run(
        count,
        [](void* context, std::uint32_t index) { (*static_cast<std::remove_reference_t<Job>*>(context))(index); },
        const_cast<void*>(static_cast<const void*>(&job)));
  }

 private:
  using Call = void (*)(void* context, std::uint32_t index);
  void run(std::uint32_t count, Call call, void* context);

  struct Pool;
  std::uint32_t thread_count_;
  hf_job_runner host_;
  std::unique_ptr<Pool> pool_;
};

// Same as JobRunner::for_each, but `jobs` may be null. Then the calling thread runs all jobs.
template <class Job>
void for_each(JobRunner* jobs, std::uint32_t count, Job&& job) {
  if (jobs) return jobs->for_each(count, job);
  for (std::uint32_t i = 0; i < count; ++i) {
    poll();
    job(i);
  }
}

// Cuts the range 0 .. count into pieces of `piece` numbers and calls work(begin, end) for each piece.
template <class Work>
void for_ranges(JobRunner& jobs, std::size_t count, std::size_t piece, Work&& work) {
  jobs.for_each(static_cast<std::uint32_t>((count + piece - 1) / piece), [&](std::uint32_t p) {
    const std::size_t begin = p * piece;
    work(begin, count - begin < piece ? count : begin + piece);
  });
}

}  // namespace hf_inner
