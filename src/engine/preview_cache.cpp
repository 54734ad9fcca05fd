#include "engine/preview_cache.h"

namespace hf_inner {

std::shared_ptr<const PreviewFactor> PreviewCache::get(const Factor& factor, Memory& memory, JobRunner& jobs) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (made_) return made_;
  }
  std::shared_ptr<const PreviewFactor> fresh = PreviewFactor::make(factor, memory, jobs);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!made_) made_ = fresh;
  return made_;
}

void PreviewCache::release() noexcept {
  std::shared_ptr<const PreviewFactor> last;  // freed after the lock is
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last.swap(made_);
  }
}

}  // namespace hf_inner
