#include "surface/workspaces.h"

#include <algorithm>

namespace hf_inner::surface {

Buffer<double> WorkspacePool::take(std::size_t size) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto it = free_.begin(); it != free_.end(); ++it) {
      if (it->size() < size) continue;
      Buffer<double> found = std::move(*it);
      free_.erase(it);
      return found;
    }
  }
  Buffer<double> fresh(memory_, size);
  if (zeroed_) std::fill(fresh.begin(), fresh.end(), 0.0);
  return fresh;
}

void WorkspacePool::give(Buffer<double>&& buffer) noexcept {
  // Under a memory limit the pool keeps nothing. Otherwise a refused call could leave a buffer that makes a later call
  // meet the limit.
  if (memory_.room() != UINT64_MAX) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (free_.size() < most) {
    free_.push_back(std::move(buffer));
    return;
  }
  const auto smallest =
      std::min_element(free_.begin(), free_.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (smallest->size() < buffer.size()) *smallest = std::move(buffer);
}

}  // namespace hf_inner::surface
