// Large scratch arrays that solves share and reuse.
#pragma once
#include <mutex>

#include "base/memory.h"

namespace hf_inner::surface {

// Keeps scratch arrays for later solves. The first access to fresh memory would cost more than a sweep.
class WorkspacePool {
 public:
  // zeroed: buffers of this pool are all zero when taken, and must be all zero when given back.
  explicit WorkspacePool(Memory& memory, bool zeroed = false) : memory_(memory), zeroed_(zeroed), free_(&memory) {
    free_.reserve(most);  // giving back takes no memory
  }
  // Moves a buffer of at least `size` doubles out of the pool, or makes one.
  Buffer<double> take(std::size_t size);
  // Gives a buffer back to the pool. Never throws: if the pool cannot grow, the buffer is freed.
  void give(Buffer<double>&& buffer) noexcept;

 private:
  // Buffers kept. If more callers run at once, the others allocate their own. Less allocates again for that many
  // threads at once, more keeps memory that few hosts need. No result depends on it.
  static constexpr std::size_t most = 8;
  Memory& memory_;
  const bool zeroed_;
  std::mutex mutex_;
  Vector<Buffer<double>> free_;
};

// Takes a buffer from the pool for one scope.
class Workspace {
 public:
  Workspace(WorkspacePool& pool, std::size_t size) : pool_(pool), buffer_(pool.take(size)) {}
  ~Workspace() {
    if (!dropped_) pool_.give(std::move(buffer_));
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  double* data() noexcept { return buffer_.data(); }
  double& operator[](std::size_t i) noexcept { return buffer_[i]; }
  // For a zeroed pool: marks the buffer as not zero. It does not go back to the pool unless clean() is called.
  void soil() noexcept { dropped_ = true; }
  void clean() noexcept { dropped_ = false; }

 private:
  bool dropped_ = false;
  WorkspacePool& pool_;
  Buffer<double> buffer_;
};

}  // namespace hf_inner::surface
