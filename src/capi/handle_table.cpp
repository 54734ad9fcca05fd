#include "capi/handle_table.h"

#include <mutex>

#include "capi/handle_slots.h"

namespace hf_inner::capi {
namespace {

// A handle is the kind above the number. On 32-bit hosts 28 bits are left for the number.
constexpr unsigned number_bits = sizeof(std::uintptr_t) >= 8 ? 56 : 28;
static_assert(static_cast<unsigned>(Kind::retarget) >> (32 - 28) == 0, "the last kind does not fit a 32-bit handle");

struct Table {
  std::mutex mutex;
  HandleSlots<Object, number_bits> slots;
};
Table table;  // trivially initialised; owns no memory while no handle is in use

thread_local const Reading* innermost_reading;  // the innermost reading call on this thread's stack

// The number in a handle of that kind; 0, which names no object, in any other.
std::uintptr_t number_in(std::uintptr_t handle, Kind kind) noexcept {
  const std::uintptr_t own = static_cast<std::uintptr_t>(kind);
  return handle >> number_bits == own ? handle ^ (own << number_bits) : 0;
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
  const std::uintptr_t kind = static_cast<std::uintptr_t>(object->kind());
  const std::lock_guard<std::mutex> lock(table.mutex);
  return (kind << number_bits) | table.slots.add(std::move(object));
}

std::shared_ptr<Object> find(std::uintptr_t handle, Kind kind) noexcept {
  const std::lock_guard<std::mutex> lock(table.mutex);
  const std::shared_ptr<Object>* object = table.slots.find(number_in(handle, kind));
  return object && (*object)->kind() == kind ? *object : nullptr;
}

std::shared_ptr<Object> remove(std::uintptr_t handle, Kind kind) noexcept {
  const std::lock_guard<std::mutex> lock(table.mutex);
  const std::uintptr_t number = number_in(handle, kind);
  const std::shared_ptr<Object>* object = table.slots.find(number);
  // destroyed outside the lock: its destructor may call the host's hooks
  return object && (*object)->kind() == kind ? table.slots.remove(number) : nullptr;
}

}  // namespace hf_inner::capi
