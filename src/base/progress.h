// Progress of a long call. Any thread can poll and cancel it. The work calls report() with the fraction done. After
// cancel(), report() throws HF_ERROR_CANCELLED, so a cancelled call unwinds like any failed call.
#pragma once
#include <atomic>
#include <cstdint>

#include "base/error.h"

namespace hf_inner {

class Progress {
 public:
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  // A call begins: the fraction is 0. A cancel that came before stops the call.
  void begin() noexcept { fraction_.store(0.0f, std::memory_order_relaxed); }
  // A cancel that stopped a call does not stop the next. The fraction stays where the call was.
  void clear_cancel() noexcept { cancelled_.store(false, std::memory_order_relaxed); }
  float fraction() const noexcept { return fraction_.load(std::memory_order_relaxed); }
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }
  // Raises the fraction, which never falls during a call, then polls. Jobs of the call may report at the same time.
  void report(float fraction) {
    fraction = low_ + (high_ - low_) * fraction;
    float present = fraction_.load(std::memory_order_relaxed);
    while (present < fraction && !fraction_.compare_exchange_weak(present, fraction, std::memory_order_relaxed)) {
    }
    poll();
  }
  // Throws HF_ERROR_CANCELLED once cancel() was called.
  void poll() const {
    if (cancelled()) throw_cancelled();
  }

 private:
  friend class ProgressRange;
  [[noreturn]] void throw_cancelled() const {
    fail(HF_ERROR_CANCELLED, HF_NO_INDEX, "cancelled by the caller at %.0f %%; nothing was changed",
         100.0 * static_cast<double>(fraction()));
  }
  std::atomic<float> fraction_{0.0f};
  std::atomic<bool> cancelled_{false};
  float low_ = 0, high_ = 1;  // range of the call's progress that the present part of the work covers
};

// While it lives, this thread works for a call with that progress, or without one. JobRunner passes it on to the
// threads that take the call's jobs.
class CallProgress {
 public:
  explicit CallProgress(Progress* progress) noexcept;
  ~CallProgress();
  CallProgress(const CallProgress&) = delete;
  CallProgress& operator=(const CallProgress&) = delete;

 private:
  Progress* outer_;
};

// The progress of the call that this thread works for, or null.
Progress* current_progress() noexcept;

// Throws HF_ERROR_CANCELLED once the caller has cancelled the call that this thread works for. Every loop that may run
// for more than 10 ms polls; JobRunner does so before every job. A poll costs about 3 ns.
inline void poll() {
  if (const Progress* progress = current_progress()) progress->poll();
}

// Polls on every `every`-th call of due(), for loops whose steps are shorter than a poll. every: a power of two.
class Poller {
 public:
  explicit Poller(std::uint32_t every = 4096) noexcept : mask_(every - 1) {}
  void due() {
    if ((++steps_ & mask_) == 0) poll();
  }

 private:
  std::uint32_t mask_, steps_ = 0;
};

// Reports the share of the present range that is done, 0 to 1, and polls.
inline void report(float fraction) {
  if (Progress* const progress = current_progress()) progress->report(fraction);
}

// While it lives, reports of 0 to 1 stand for `from` to `to` of the range that was. Jobs that run meanwhile report
// within the range; they make none of their own.
class ProgressRange {
 public:
  ProgressRange(float from, float to) noexcept : progress_(current_progress()) {
    if (!progress_) return;
    low_ = progress_->low_;
    high_ = progress_->high_;
    progress_->low_ = low_ + (high_ - low_) * from;
    progress_->high_ = low_ + (high_ - low_) * to;
  }
  ~ProgressRange() {
    if (progress_) {
      progress_->low_ = low_;
      progress_->high_ = high_;
    }
  }
  ProgressRange(const ProgressRange&) = delete;
  ProgressRange& operator=(const ProgressRange&) = delete;

 private:
  Progress* const progress_;
  float low_ = 0, high_ = 1;
};

}  // namespace hf_inner
