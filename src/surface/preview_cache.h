// Holds the single-precision copy of a core's factor. All users of the core share the copy.
//
// The first preview makes the copy, and the host may free it. Any number of threads may ask for it at the same time.
#pragma once
#include <memory>
#include <mutex>

#include "factor/preview.h"

namespace hf_inner::surface {

class PreviewCache {
 public:
  // Returns the copy, and makes it if there is none. If two threads ask first at the same time, both make a copy and
  // then share the copy that was ready first. So no thread holds a lock while threads of the host work.
  std::shared_ptr<const factor::PreviewFactor> get(const factor::Factor& factor, Memory& memory, JobRunner& jobs);
  // Frees the copy. Calls that use the copy keep it alive until they end.
  void release() noexcept;

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const factor::PreviewFactor> made_;
};

}  // namespace hf_inner::surface
