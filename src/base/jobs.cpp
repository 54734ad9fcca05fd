#include "base/jobs.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "base/compiler.h"
#include "base/float_environment.h"

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace hf_inner {
namespace {

long this_process() noexcept {
#if defined(__unix__) || defined(__APPLE__)
  return static_cast<long>(getpid());
#else
  return 0;
#endif
}

// One batch of jobs. An atomic counter hands out the indices. The batch keeps the first exception.
struct Batch {
  std::uint32_t count;
  void (*call)(void*, std::uint32_t);
  void* context;
  Progress* progress;  // of the call that runs the batch
  std::atomic<std::uint32_t> next{0};
  AtomicFlag failed{0};
  std::exception_ptr error;

  void work_one(std::uint32_t index) noexcept {
    if (failed.load(std::memory_order_relaxed)) return;
    try {
      poll();
      call(context, index);
    } catch (...) {
      if (!failed.exchange(1)) error = std::current_exception();
    }
  }
  void work() noexcept {
    const CallProgress here(progress);
    for (;;) {
      const std::uint32_t index = next.fetch_add(1, std::memory_order_relaxed);
      if (index >= count) return;
      work_one(index);
    }
  }
};

// A thread without work polls for a new batch of jobs this long before it sleeps. A sleeping thread needs tens of
// microseconds to wake. A longer time would keep a core from the host.
constexpr std::chrono::microseconds spin_time{40};
// A waiting thread reads the clock after this many polls. Half and twice the value take
// the same time within 5 %. No result depends on this number.
constexpr int polls = 64;

// Waits for other threads: calls done() until it returns true or spin_time is over. A solve runs about a dozen batches
// in a row. Waking a sleeping thread for each batch would cost more than the smaller batches take.
template <class Done>
bool spin(Done&& done) noexcept {
  const auto until = std::chrono::steady_clock::now() + spin_time;
  for (;;) {
    for (int i = 0; i < polls; ++i) {
      if (done()) return true;
      pause_in_loop();
    }
    if (std::chrono::steady_clock::now() > until) return false;
  }
}

// True while this thread runs a job of a host's runner. A host's runner need not accept batches from within a job, so a
// nested batch runs on this thread alone.
thread_local bool in_host_job = false;

struct HostJob {
  const bool outer = in_host_job;
  HostJob() noexcept { in_host_job = true; }
  ~HostJob() { in_host_job = outer; }
};

}  // namespace

// The library's own threads. Between batches the workers poll for a moment, then sleep on a condition variable. The
// workers serve one batch at a time. Another caller, such as a clone or a job with jobs of its own, meanwhile runs its
// batch alone, so the pool cannot deadlock. A forked child process inherits the pool but not its threads, so it works
// alone. The child never frees the pool, because joining the missing threads would never return.
struct JobRunner::Pool {
  AtomicFlag taken{0};
  std::mutex mutex;
  std::condition_variable wake, done;
  Batch* batch = nullptr;
  std::atomic<std::uint64_t> generation{0};  // written under the mutex, like the next two
  std::atomic<std::uint32_t> busy{0};
  std::atomic<bool> stop{false};
  std::vector<std::thread> workers;
  const long process = this_process();

  explicit Pool(std::uint32_t count) {
    workers.reserve(count);
    try {
      for (std::uint32_t i = 0; i < count; ++i) workers.emplace_back([this] { loop(); });
    } catch (...) {
      // The pool got fewer threads than it asked for. Results do not depend on the number, so it uses the threads it
      // has.
    }
  }
  ~Pool() {
    {
      std::lock_guard<std::mutex> lock(mutex);
      stop = true;
    }
    wake.notify_all();
    for (std::thread& worker : workers) worker.join();
  }
  void loop() {
    FloatEnvironment environment;
    std::uint64_t seen = 0;
    std::unique_lock<std::mutex> lock(mutex, std::defer_lock);
    for (;;) {
      spin([&] { return stop || generation != seen; });
      lock.lock();
      wake.wait(lock, [&] { return stop || (batch && generation != seen); });
      if (stop) return;
      seen = generation;
      Batch* mine = batch;
      ++busy;
      lock.unlock();
      mine->work();
      lock.lock();
      if (--busy == 0) done.notify_all();
      lock.unlock();
    }
  }
  void run(Batch& work) {
    if (process != this_process() || taken.exchange(1, std::memory_order_acquire)) return work.work();
    {
      std::lock_guard<std::mutex> lock(mutex);
      batch = &work;
      ++generation;
    }
    wake.notify_all();
    work.work();
    std::unique_lock<std::mutex> lock(mutex);
    batch = nullptr;  // no thread joins any more
    if (busy > 0) {
      lock.unlock();
      spin([&] { return busy == 0; });
      lock.lock();
    }
    done.wait(lock, [&] { return busy == 0; });
    taken.store(0, std::memory_order_release);
  }
};

JobRunner::JobRunner(std::uint32_t thread_count, const hf_job_runner& host)
    : thread_count_(thread_count == 0 ? 1 : thread_count), host_(host) {
  if (!host_.run && thread_count_ > 1) pool_ = std::make_unique<Pool>(thread_count_ - 1);
}

JobRunner::~JobRunner() {
  if (pool_ && pool_->process != this_process()) static_cast<void>(pool_.release());
}

void JobRunner::run(std::uint32_t count, Call call, void* context) {
  Batch batch;
  batch.count = count;
  batch.call = call;
  batch.context = context;
  batch.progress = current_progress();
  if (host_.run && in_host_job) {
    batch.work();
  } else if (host_.run) {
    // The host should call us once per index. The library runs the jobs that the host leaves out, so a faulty runner
    // costs time but changes no result.
    host_.run(
        host_.user, count,
        [](void* data, std::uint32_t) {
          const FloatEnvironment environment;
          const HostJob here;
          static_cast<Batch*>(data)->work();
        },
        &batch);
    const HostJob here;
    batch.work();
  } else {
    pool_->run(batch);
  }
  if (batch.failed) std::rethrow_exception(batch.error);
}

}  // namespace hf_inner
