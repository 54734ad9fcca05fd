// A mutex that knows which thread holds it. It guards data that a const object makes at first use.
#pragma once
#include <atomic>
#include <mutex>
#include <thread>

#include "base/error.h"

namespace hf_inner {

// Works with std::lock_guard. If one thread locks it twice, the second lock throws HF_ERROR_REENTRANT instead of
// waiting forever. This can happen because allocators and job runners of the host may call the library while it makes
// the data.
class OwnedMutex {
 public:
  void lock() {
    if (owner_.load(std::memory_order_relaxed) == std::this_thread::get_id())
      fail(HF_ERROR_REENTRANT, HF_NO_INDEX, "called from a callback of the call that makes this data; return first");
    mutex_.lock();
    owner_.store(std::this_thread::get_id(), std::memory_order_relaxed);
  }
  void unlock() noexcept {
    owner_.store(std::thread::id{}, std::memory_order_relaxed);
    mutex_.unlock();
  }

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_{};
};

}  // namespace hf_inner
