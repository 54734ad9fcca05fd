#include "surface/preview_cache.h"

namespace hf_inner::surface {

std::shared_ptr<const factor::PreviewFactor> PreviewCache::get(const factor::Factor& factor, Memory& memory,
                                                               JobRunner& jobs) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (made_) return made_;
  }
  std::shared_ptr<const factor::PreviewFactor> fresh = factor::PreviewFactor::make(factor, memory, jobs);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!made_) made_ = fresh;
  return made_;
}

void PreviewCache::release() noexcept {
  std::shared_ptr<const factor::PreviewFactor> last;  // freed after the lock is
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last.swap(made_);
  }
}

}  // namespace hf_inner::surface
