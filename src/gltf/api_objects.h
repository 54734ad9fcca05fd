// The objects behind the handles of hf_gltf/gltf.h, and the boundary: no exception leaves the library.
//
// A handle is a number and no pointer: stale and foreign ones are refused. Several calls may read an object at once; a
// call that finds it in use by a call that changes it returns HF_ERROR_BUSY.
#ifndef HF_GLTF_API_OBJECTS_H
#define HF_GLTF_API_OBJECTS_H

#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "gltf/flat_mesh.h"
#include "gltf/pairs_file.h"
#include "hf_gltf/gltf.h"

namespace hf_gltf {

struct Failure : std::runtime_error {
  Failure(hf_result code_given, const std::string& message, uint32_t index_given = HF_NO_INDEX)
      : std::runtime_error(message), code(code_given), index(index_given) {}
  hf_result code;
  uint32_t index;
};

struct Object {
  virtual ~Object() = default;
  std::shared_mutex use;
};

struct ModelObject : Object {
  Model model;
  FlatMesh mesh;  // empty without triangles
};

struct PairsObject : Object {
  PairsFile pairs;
  std::vector<Region> source, target;
  std::vector<double> confidence;
  double source_diagonal = 0, target_diagonal = 0, scale = 0;
  std::string text;
};

uintptr_t insert(std::shared_ptr<Object> object);
std::shared_ptr<Object> find(uintptr_t handle);
void remove(uintptr_t handle);
// Copies UTF-8, cut between letters, with zeros behind it.
void copy_text(const char* from, char* to, size_t capacity);
const hf_error_detail& last_detail();
hf_result record(hf_result code, uint32_t index, const char* function, const char* message) noexcept;

template <class T, class Handle>
std::shared_ptr<T> get(Handle handle, const char* name) {
  std::shared_ptr<T> object = std::dynamic_pointer_cast<T>(find(reinterpret_cast<uintptr_t>(handle)));
  if (!object)
    throw Failure(HF_ERROR_INVALID_OBJECT, std::string(name) + " is " +
                                               (handle ? "stale, destroyed or of another kind" : "NULL") +
                                               "; pass a live handle");
  return object;
}

// An object in use for a call: Reading with others, Changing alone.
template <class T, class Lock>
class InUse {
 public:
  template <class Handle>
  InUse(Handle handle, const char* name) : object_(get<T>(handle, name)), lock_(object_->use, std::try_to_lock) {
    if (!lock_) throw Failure(HF_ERROR_BUSY, std::string(name) + " is in use by another call");
  }
  T* operator->() const { return object_.get(); }
  T& operator*() const { return *object_; }

 private:
  std::shared_ptr<T> object_;
  Lock lock_;
};
template <class T>
using Reading = InUse<T, std::shared_lock<std::shared_mutex>>;
template <class T>
using Changing = InUse<T, std::unique_lock<std::shared_mutex>>;

inline void need(const void* pointer, const char* name) {
  if (!pointer) throw Failure(HF_ERROR_NULL_POINTER, std::string(name) + " is NULL");
}

// The caller's struct must be as long as the one of this version, which is the first.
template <class T>
T& sized(T* given, const char* name) {
  need(given, name);
  if (given->struct_size != sizeof(T))
    throw Failure(HF_ERROR_INVALID_DESC, std::string(name) + ": struct_size is " + std::to_string(given->struct_size) +
                                             "; set it to sizeof (" + std::to_string(sizeof(T)) +
                                             " here), as HF_INIT does");
  return *given;
}

// Writes a handle of what `make` returns; NULL after a failure.
template <class Handle, class Make>
void create(Handle* out, const char* name, Make&& make) {
  need(out, name);
  *out = nullptr;
  *out = reinterpret_cast<Handle>(insert(make()));
}

template <class T, class Handle>
void destroy(Handle handle) noexcept {
  const auto number = reinterpret_cast<uintptr_t>(handle);
  if (std::dynamic_pointer_cast<T>(find(number))) remove(number);
}

// Writes bytes of a text that has a count and, where `to` is given, a capacity.
inline void write_text(const std::string& text, uint64_t capacity, void* to, uint64_t* out_count) {
  *out_count = text.size();
  if (!to) return;
  if (capacity < text.size())
    throw Failure(HF_ERROR_TOO_SMALL,
                  "capacity is " + std::to_string(capacity) + "; " + std::to_string(text.size()) + " are needed");
  std::memcpy(to, text.data(), text.size());
}

// Runs a call of the C interface. `otherwise`: the code of a sentence about a file.
template <class Work>
hf_result guarded(const char* function, Work&& work, hf_result otherwise = HF_ERROR_INVALID_ARGUMENT) noexcept {
  try {
    work();
    return HF_OK;
  } catch (const Failure& failure) {
    return record(failure.code, failure.index, function, failure.what());
  } catch (const std::bad_alloc&) {
    return record(HF_ERROR_OUT_OF_MEMORY, HF_NO_INDEX, function, "memory ran out; the object is as it was");
  } catch (const std::runtime_error& error) {
    return record(otherwise, HF_NO_INDEX, function, error.what());
  } catch (const std::exception& error) {
    return record(HF_ERROR_INTERNAL, HF_NO_INDEX, function, error.what());
  } catch (...) {
    return record(HF_ERROR_INTERNAL, HF_NO_INDEX, function, "an unknown exception reached the boundary");
  }
}

}  // namespace hf_gltf

#endif
