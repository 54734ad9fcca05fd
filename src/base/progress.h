// Progress of a long call, polled and cancelled from any thread. Work reports its share as it goes; report() throws
// HF_ERROR_CANCELLED once cancel() was called, so a cancelled call unwinds like any other failure.
#pragma once
#include <atomic>

#include "base/error.h"

namespace hf_inner {

class Progress {
 public:
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  // A cancel that stopped a call does not stop the next. The fraction stays where the call was.
  void clear_cancel() noexcept { cancelled_.store(false, std::memory_order_relaxed); }
  float fraction() const noexcept { return fraction_.load(std::memory_order_relaxed); }
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }
  void report(float fraction) {
    fraction = low_ + (high_ - low_) * fraction;
    fraction_.store(fraction, std::memory_order_relaxed);
    if (cancelled())
      fail(HF_ERROR_CANCELLED, HF_NO_INDEX, "cancelled by the caller at %.0f %%; nothing was changed",
           100.0 * static_cast<double>(fraction));
  }

 private:
  friend class ProgressRange;
  std::atomic<float> fraction_{0.0f};
  std::atomic<bool> cancelled_{false};
  float low_ = 0, high_ = 1;  // of what is reported; the work's own
};

// While it lives, reports of 0 to 1 stand for `from` to `to` of the range that was. The progress may be absent.
class ProgressRange {
 public:
  ProgressRange(Progress* progress, float from, float to) noexcept : progress_(progress) {
    if (!progress_) return;
    low_ = progress_->low_, high_ = progress_->high_;
    progress_->low_ = low_ + (high_ - low_) * from, progress_->high_ = low_ + (high_ - low_) * to;
  }
  ~ProgressRange() {
    if (progress_) progress_->low_ = low_, progress_->high_ = high_;
  }
  ProgressRange(const ProgressRange&) = delete;
  ProgressRange& operator=(const ProgressRange&) = delete;

 private:
  Progress* progress_;
  float low_ = 0, high_ = 1;
};

// Reports to a progress that may be absent.
inline void report(Progress* progress, float fraction) {
  if (progress) progress->report(fraction);
}

}  // namespace hf_inner
