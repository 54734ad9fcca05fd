// The table behind all handles. It is the only state that all threads of a process share. A handle is no pointer. It
// encodes the kind of object, a generation and an index. Functions answer a stale, foreign or destroyed handle with
// HF_ERROR_INVALID_OBJECT. A generation is used again only after 2^32 objects; on 32-bit hosts after 2^15. An empty
// table holds no memory, so unloading the library leaks nothing.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/float_environment.h"
#include "base/memory.h"

namespace hf_inner::capi {

enum class Kind : std::uint32_t {
  solver = 1,
  pose = 2,
  transfer = 3,
  progress = 4,
  geodesics = 5,
  direction = 6,
  quads = 7,
  flow = 8,
  region = 9,
  detail = 10,
  surface = 11,
  weights = 12,
  skeleton = 13,
  retarget = 14
};

// The object of a handle. Several calls may read it at once; a call that changes it must be alone. No call waits for
// another. A call that cannot start because of another call returns HF_ERROR_BUSY. If it comes from a callback of that
// other call, it returns HF_ERROR_REENTRANT.
class Object {
 public:
  explicit Object(Kind kind, std::shared_ptr<Memory> lies_in = nullptr) noexcept
      : memory(std::move(lies_in)), kind_(kind) {}
  virtual ~Object() = default;
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  Kind kind() const noexcept { return kind_; }
  const std::shared_ptr<Memory> memory;  // outlives the parts of the object; null for a progress object

 private:
  friend class Reading;
  friend class Changing;
  static constexpr std::int32_t writer = -1;
  const Kind kind_;
  std::atomic<std::int32_t> users_{0};  // readers, or `writer`
  std::atomic<std::thread::id> owner_{};
};

class Reading {
 public:
  explicit Reading(Object& object);
  ~Reading();
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  // Returns true if this thread is inside a call that reads the object.
  static bool by_this_thread(const Object& object) noexcept;

 private:
  Object& object_;
  const Reading* outer_;  // the reading call whose callback this call came from
};

class Changing {
 public:
  explicit Changing(Object& object);
  ~Changing() {
    object_.owner_.store(std::thread::id{}, std::memory_order_relaxed);
    object_.users_.store(0, std::memory_order_release);
  }
  Changing(const Changing&) = delete;
  Changing& operator=(const Changing&) = delete;

 private:
  Object& object_;
};

// Registers an object and returns its handle. Throws std::bad_alloc, or HF_ERROR_TOO_LARGE when the table is full.
std::uintptr_t insert(std::shared_ptr<Object> object);
// Returns the object behind a handle and keeps it alive for the call. Returns null if no object of that kind has it.
std::shared_ptr<Object> find(std::uintptr_t handle, Kind kind) noexcept;
// Takes an object out of the table. The last call that uses the object destroys it.
std::shared_ptr<Object> remove(std::uintptr_t handle, Kind kind) noexcept;

// Returns the object behind a handle of the host, or throws HF_ERROR_INVALID_OBJECT. T::kind_of is the kind of handle.
template <class T, class Handle>
std::shared_ptr<T> get(Handle handle, const char* name, std::uint32_t index = HF_NO_INDEX) {
  std::shared_ptr<Object> object = find(reinterpret_cast<std::uintptr_t>(handle), T::kind_of);
  if (!object)
    fail(HF_ERROR_INVALID_OBJECT, index, "%s is %s; pass a live handle", name,
         handle ? "stale, destroyed or of another kind" : "NULL");
  return std::static_pointer_cast<T>(std::move(object));
}

// Makes an object and writes its handle to *out. After a failure *out is NULL.
template <class Handle, class Make>
void create(Handle* out, const char* name, Make&& make) {
  if (!out) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "%s is NULL", name);
  *out = nullptr;
  *out = reinterpret_cast<Handle>(insert(make()));
}

// The blocks that the object's Memory keeps for the next call go back to the host with it.
template <class T, class Handle>
void destroy(Handle handle) noexcept {
  const FloatEnvironment environment;
  std::shared_ptr<Object> object = remove(reinterpret_cast<std::uintptr_t>(handle), T::kind_of);
  if (!object) return;
  const std::shared_ptr<Memory> memory = object->memory;
  object.reset();
  if (memory) memory->release_kept();
}

}  // namespace hf_inner::capi
