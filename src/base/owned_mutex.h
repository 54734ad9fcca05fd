// A mutex that knows its thread: for what is made at first use behind a const object.
#pragma once
#include <atomic>
#include <mutex>
#include <thread>

#include "base/error.h"

namespace hf_inner {

// Works with std::lock_guard. Locking it twice on one thread throws HF_ERROR_REENTRANT instead of waiting for itself:
// allocators and job runners of the host may call the library from inside the making.
class OwnedMutex {
 public:
  void lock() {
    if (owner_.load(std::memory_order_relaxed) == std::this_thread::get_id())
      fail(HF_ERROR_REENTRANT, HF_NO_INDEX, "called from a callback of the call that makes what is asked for");
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
