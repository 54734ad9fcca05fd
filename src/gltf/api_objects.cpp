// See api_objects.h.
#include "gltf/api_objects.h"

#include <map>
#include <mutex>

namespace hf_gltf {
namespace {

std::mutex table_lock;
std::map<uintptr_t, std::shared_ptr<Object>>& table() {
  static std::map<uintptr_t, std::shared_ptr<Object>> objects;
  return objects;
}

thread_local hf_error_detail last{};

}  // namespace

uintptr_t insert(std::shared_ptr<Object> object) {
  static uintptr_t next = 0;
  const std::lock_guard<std::mutex> lock(table_lock);
  do ++next;  // numbers come again after 2^32 objects on hosts of 32 bits; those in use are left out
  while (next == 0 || table().count(next) > 0);
  table().emplace(next, std::move(object));
  return next;
}

std::shared_ptr<Object> find(uintptr_t handle) {
  const std::lock_guard<std::mutex> lock(table_lock);
  const auto found = table().find(handle);
  return found == table().end() ? nullptr : found->second;
}

void remove(uintptr_t handle) {
  std::shared_ptr<Object> object;  // outlives the lock: the last call that uses it destroys it
  const std::lock_guard<std::mutex> lock(table_lock);
  const auto found = table().find(handle);
  if (found == table().end()) return;
  object = std::move(found->second);
  table().erase(found);
}

void copy_text(const char* from, char* to, size_t capacity) {
  size_t length = std::strlen(from);
  if (length >= capacity) {
    length = capacity - 1;
    while (length > 0 && (static_cast<unsigned char>(from[length]) & 0xC0) == 0x80) --length;
  }
  std::memcpy(to, from, length);
  std::memset(to + length, 0, capacity - length);
}

hf_result record(hf_result code, uint32_t index, const char* function, const char* message) noexcept {
  last.code = code;
  last.index = index;
  copy_text(function, last.function, sizeof last.function);
  copy_text(message, last.message, sizeof last.message);
  return code;
}

const hf_error_detail& last_detail() { return last; }

}  // namespace hf_gltf
