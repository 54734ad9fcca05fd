// Progress of a long call. Any thread can poll and cancel it. The work calls report() with the fraction done. After
// cancel(), report() throws HF_ERROR_CANCELLED, so a cancelled call unwinds like any failed call.
#pragma once
#include <atomic>

#include "base/error.h"

namespace hf_inner {

class Progress {
 public:
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  void reset() noexcept {
    cancelled_.store(false, std::memory_order_relaxed), fraction_.store(0.0f, std::memory_order_relaxed);
  }
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
  float low_ = 0, high_ = 1;  // range of the call's progress that the present part of the work covers
};

// During the lifetime of this object, reports from 0 to 1 are mapped to `from` .. `to` of the previous range. The
// progress may be null.
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

// Reports a fraction to a progress, which may be null.
inline void report(Progress* progress, float fraction) {
  if (progress) progress->report(fraction);
}

}  // namespace hf_inner
