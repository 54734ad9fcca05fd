// Work split over the threads the caller grants: a pool the library owns (thread_count from the desc), or the host's
// own job runner. Results never depend on the number of threads: work is cut into fixed pieces, and each piece writes
// its own output. No sum crosses a piece in an order that depends on threads.
#pragma once
#include <cstdint>
#include <exception>
#include <memory>

#include "base/memory.h"
#include "base/progress.h"
#include "hf/base.h"

namespace hf_inner {

class JobRunner {
 public:
  // thread_count: threads that may work at once, the caller's own included; 1 runs everything on the caller.
  explicit JobRunner(std::uint32_t thread_count, const hf_job_runner& host = {});
  ~JobRunner();
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  std::uint32_t thread_count() const noexcept { return thread_count_; }

  // Calls job(index) for index = 0 .. count-1, on any of the threads, in any order, each once; returns when all are
  // done. The first exception of a job is rethrown on the calling thread; the remaining jobs are still called or
  // skipped. Polls before every job: a cancelled call throws HF_ERROR_CANCELLED.
  template <class Job>
  void for_each(std::uint32_t count, Job&& job) {
    if (count == 0) return;
    if (thread_count_ == 1 || count == 1) {
      for (std::uint32_t i = 0; i < count; ++i) poll(), job(i);
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

// The same on a runner that may be absent: then on the calling thread.
template <class Job>
void for_each(JobRunner* jobs, std::uint32_t count, Job&& job) {
  if (jobs) return jobs->for_each(count, job);
  for (std::uint32_t i = 0; i < count; ++i) poll(), job(i);
}

// Calls work(begin, end) for the pieces of 0 .. count, `piece` numbers each.
template <class Work>
void for_ranges(JobRunner& jobs, std::size_t count, std::size_t piece, Work&& work) {
  jobs.for_each(static_cast<std::uint32_t>((count + piece - 1) / piece), [&](std::uint32_t p) {
    const std::size_t begin = p * piece;
    work(begin, count - begin < piece ? count : begin + piece);
  });
}

}  // namespace hf_inner
