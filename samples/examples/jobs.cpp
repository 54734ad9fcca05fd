// Gives the library the job system of an engine, and an arena of fixed size for all its memory.
#include <hf/hf.h>

#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "mesh.h"

namespace {

// Keeps threads that wait for work. run() does all jobs of a list and returns when the last job is done.
class JobSystem {
 public:
  explicit JobSystem(unsigned threads) {
    while (threads-- > 1) workers_.emplace_back([this] { wait_for_work(); });
  }
  ~JobSystem() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      over_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  // The library may call this from several of your threads at once. Here a list waits until the list before is done.
  static void run(void* self, uint32_t count, void (*job)(void*, uint32_t), void* data) {
    static_cast<JobSystem*>(self)->do_all(count, job, data);
  }

 private:
  void do_all(uint32_t count, void (*job)(void*, uint32_t), void* data) {
    const std::lock_guard<std::mutex> one_list(lists_);
    std::unique_lock<std::mutex> lock(mutex_);
    job_ = job;
    data_ = data;
    next_ = 0;
    count_ = count;
    busy_ = static_cast<unsigned>(workers_.size());
    ++list_;
    wake_.notify_all();
    lock.unlock();
    take_jobs();
    lock.lock();
    done_.wait(lock, [this] { return busy_ == 0; });
  }

  void take_jobs() {
    for (uint32_t i = next_++; i < count_; i = next_++) job_(data_, i);
  }

  void wait_for_work() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (uint64_t seen = 0;;) {
      wake_.wait(lock, [&] { return over_ || list_ != seen; });
      if (over_) return;
      seen = list_;
      lock.unlock();
      take_jobs();
      lock.lock();
      if (--busy_ == 0) done_.notify_one();
    }
  }

  std::vector<std::thread> workers_;
  std::mutex lists_, mutex_;
  std::condition_variable wake_, done_;
  void (*job_)(void*, uint32_t) = nullptr;
  void* data_ = nullptr;
  std::atomic<uint32_t> next_{0};
  uint32_t count_ = 0;
  unsigned busy_ = 0;
  uint64_t list_ = 0;
  bool over_ = false;
};

// Cuts one block of memory into pieces whose sizes are powers of two. A released piece is used again for its size. When
// the arena is full, the call of the library fails with HF_ERROR_OUT_OF_MEMORY and leaves its objects as they were.
class Arena {
 public:
  explicit Arena(size_t bytes) : memory_(new unsigned char[bytes + largest_alignment]), end_(bytes) {
    const size_t beyond = reinterpret_cast<uintptr_t>(memory_.get()) % largest_alignment;
    start_ = memory_.get() + (largest_alignment - beyond);
  }

  static void* allocate(void* self, size_t size, size_t alignment) {
    return static_cast<Arena*>(self)->take(size, alignment);
  }
  static void release(void* self, void* block, size_t size, size_t alignment) {
    Arena& arena = *static_cast<Arena*>(self);
    const std::lock_guard<std::mutex> lock(arena.mutex_);
    *static_cast<void**>(block) = arena.free_[power_of(size, alignment)];
    arena.free_[power_of(size, alignment)] = block;
  }

  size_t used() const { return used_; }
  size_t calls() const { return calls_; }

 private:
  static constexpr size_t largest_alignment = 4096;

  static unsigned power_of(size_t size, size_t alignment) {
    unsigned power = 4;  // room for a pointer, and for its alignment
    while ((size_t{1} << power) < size || (size_t{1} << power) < alignment) ++power;
    return power;
  }

  void* take(size_t size, size_t alignment) {
    if (alignment > largest_alignment || size > end_) return nullptr;
    const std::lock_guard<std::mutex> lock(mutex_);
    ++calls_;
    const unsigned power = power_of(size, alignment);
    if (void* block = free_[power]) {
      free_[power] = *static_cast<void**>(block);
      return block;
    }
    const size_t whole = size_t{1} << power, step = whole < largest_alignment ? whole : largest_alignment;
    const size_t at = (used_ + step - 1) / step * step;
    if (whole > end_ || at > end_ - whole) return nullptr;
    used_ = at + whole;
    return start_ + at;
  }

  std::unique_ptr<unsigned char[]> memory_;
  unsigned char* start_;
  size_t end_, used_ = 0, calls_ = 0;
  void* free_[64] = {};
  std::mutex mutex_;
};

}  // namespace

int main(int argc, char** argv) {
  Mesh mesh = mesh_load(argc, argv);
  JobSystem jobs(4);
  Arena arena(size_t{64} << 20);

  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(mesh.positions, mesh.vertex_count);
  desc.triangles = HF_ARRAY(mesh.triangles, mesh.triangle_count);
  desc.thread_count = 4;  // the library divides a call into at most this many jobs
  desc.job_runner.run = JobSystem::run;
  desc.job_runner.user = &jobs;
  desc.allocator.allocate = Arena::allocate;
  desc.allocator.release = Arena::release;
  desc.allocator.user = &arena;
  hf_surface surface;
  ok(hf_surface_create(&desc, &surface));

  hf_pose pose;  // works on the same jobs and in the same arena
  uint32_t foot, hip;
  const double size = mesh_pose(&mesh, surface, &pose, &foot, &hip);

  std::vector<float> posed(3 * static_cast<size_t>(mesh.vertex_count));
  size_t calls = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    hf_transform moved = {{0, 0, 0, 1}, {0, 0, 0}};
    moved.translation[0] = 0.2 * size * std::sin(0.05 * frame);
    ok(hf_pose_set_transform(pose, hip, &moved));
    ok(hf_deform(pose, posed.data(), nullptr));
    if (frame == 9) calls = arena.calls();
  }
  std::printf("%.1f MB of the arena are in use; frames 10 to 999 made %zu allocations\n",
              static_cast<double>(arena.used()) / (1 << 20), arena.calls() - calls);

  hf_pose_destroy(pose);
  hf_surface_destroy(surface);  // before the arena and the job system go
  mesh_free(&mesh);
}
