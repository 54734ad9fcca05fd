// The single-precision copy of a core's factor, shared by all that share the core.
//
// The first preview makes it, the host drops it. Any number of threads may ask for it at once.
#pragma once
#include <memory>
#include <mutex>

#include "factor/preview.h"

namespace hf_inner {

class PreviewCache {
 public:
  // The copy, made when there is none. Two threads that ask first at the same time both make one and share the one that
  // was ready first. So no thread holds a lock while the threads of the host work.
  std::shared_ptr<const PreviewFactor> get(const Factor& factor, Memory& memory, JobRunner& jobs);
  // Calls that use it keep it until they are done.
  void release() noexcept;

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const PreviewFactor> made_;
};

}  // namespace hf_inner
