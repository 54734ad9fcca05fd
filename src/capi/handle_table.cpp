#include "capi/handle_table.h"

#include <mutex>
#include <new>

namespace hf_inner::capi {
namespace {

constexpr unsigned index_bits = sizeof(std::uintptr_t) >= 8 ? 24 : 13;
constexpr unsigned generation_bits = sizeof(std::uintptr_t) >= 8 ? 32 : 15;
// Checks in every build, 64-bit ones included, that the kind fits the bits that a 32-bit handle has left for it.
static_assert(static_cast<unsigned>(Kind::surface) >> (32 - 13 - 15) == 0,
              "the last kind does not fit a 32-bit handle");
constexpr std::uintptr_t index_mask = (std::uintptr_t{1} << index_bits) - 1;
constexpr std::uintptr_t generation_mask = (std::uintptr_t{1} << (generation_bits - 1) << 1) - 1;

struct Slot {
  std::shared_ptr<Object> object;
  std::uintptr_t generation = 0;
};

struct Table {
  std::mutex mutex;
  Slot* slots = nullptr;
  std::size_t capacity = 0, used = 0;
  std::uintptr_t generation = 0;
};
Table table;  // trivially initialised; owns no memory while no handle is in use

thread_local const Reading* innermost_reading;  // the innermost reading call on this thread's stack

std::uintptr_t encode(std::size_t index, std::uintptr_t generation, Kind kind) noexcept {
  return (static_cast<std::uintptr_t>(kind) << (index_bits + generation_bits)) | (generation << index_bits) |
         static_cast<std::uintptr_t>(index);
}

// Returns the slot that a handle names, or null. The caller holds the mutex.
Slot* slot_of(std::uintptr_t handle, Kind kind) noexcept {
  const std::size_t index = handle & index_mask;
  if (handle >> (index_bits + generation_bits) != static_cast<std::uintptr_t>(kind) || index >= table.capacity)
    return nullptr;
  Slot& slot = table.slots[index];
  return slot.object && slot.generation == ((handle >> index_bits) & generation_mask) ? &slot : nullptr;
}

}  // namespace

Reading::Reading(Object& object) : object_(object), outer_(innermost_reading) {
  std::int32_t users = object.users_.load(std::memory_order_relaxed);
  do {
    if (users < 0) {
      if (object.owner_.load(std::memory_order_relaxed) == std::this_thread::get_id())
        fail(HF_ERROR_REENTRANT, HF_NO_INDEX,
             "called from a callback of a call that is changing this object; return first");
      fail(HF_ERROR_BUSY, HF_NO_INDEX, "another thread is changing this object; wait for it, or use a clone");
    }
  } while (!object.users_.compare_exchange_weak(users, users + 1, std::memory_order_acquire));
  innermost_reading = this;
}

Reading::~Reading() {
  innermost_reading = outer_;
  object_.users_.fetch_sub(1, std::memory_order_release);
}

bool Reading::by_this_thread(const Object& object) noexcept {
  for (const Reading* reading = innermost_reading; reading; reading = reading->outer_) {
    if (&reading->object_ == &object) return true;
  }
  return false;
}

Changing::Changing(Object& object) : object_(object) {
  std::int32_t users = 0;
  if (!object.users_.compare_exchange_strong(users, Object::writer, std::memory_order_acquire)) {
    if (object.owner_.load(std::memory_order_relaxed) == std::this_thread::get_id())
      fail(HF_ERROR_REENTRANT, HF_NO_INDEX,
           "called from a callback of a call that is changing this object; return first");
    if (Reading::by_this_thread(object))
      fail(HF_ERROR_REENTRANT, HF_NO_INDEX,
           "called from a callback of a call that is reading this object; return first");
    fail(HF_ERROR_BUSY, HF_NO_INDEX, "another thread is using this object; wait for it, or use a clone");
  }
  object.owner_.store(std::this_thread::get_id(), std::memory_order_relaxed);
}

std::uintptr_t insert(std::shared_ptr<Object> object) {
  const Kind kind = object->kind();
  const std::lock_guard<std::mutex> lock(table.mutex);
  if (table.used == table.capacity) {
    const std::size_t capacity = table.capacity ? 2 * table.capacity : 16;
    if (capacity > index_mask) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%zu objects are alive; destroy some", table.used);
    Slot* slots = new Slot[capacity];
    for (std::size_t i = 0; i < table.capacity; ++i) slots[i] = std::move(table.slots[i]);
    delete[] table.slots;
    table.slots = slots, table.capacity = capacity;
  }
  std::size_t index = 0;
  while (table.slots[index].object) ++index;
  table.generation = (table.generation + 1) & generation_mask;
  table.slots[index].object = std::move(object);
  table.slots[index].generation = table.generation;
  ++table.used;
  return encode(index, table.generation, kind);
}

std::shared_ptr<Object> find(std::uintptr_t handle, Kind kind) noexcept {
  const std::lock_guard<std::mutex> lock(table.mutex);
  const Slot* slot = slot_of(handle, kind);
  return slot ? slot->object : nullptr;
}

std::shared_ptr<Object> remove(std::uintptr_t handle, Kind kind) noexcept {
  const std::lock_guard<std::mutex> lock(table.mutex);
  Slot* slot = slot_of(handle, kind);
  if (!slot) return nullptr;
  std::shared_ptr<Object> object = std::move(slot->object);
  slot->object.reset();
  if (--table.used == 0) {
    delete[] table.slots;
    table.slots = nullptr, table.capacity = 0;
  }
  return object;  // destroyed outside the lock: its destructor may call the host's hooks
}

}  // namespace hf_inner::capi
