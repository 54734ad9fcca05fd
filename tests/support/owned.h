// A handle of the library that is destroyed with its owner.
#pragma once
#include <utility>

namespace hf_test {

template <class Handle, void (*destroy)(Handle)>
class Owned {
 public:
  Owned() = default;
  ~Owned() { destroy(handle_); }
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  operator Handle() const { return handle_; }
  Handle* out() { return &handle_; }

 private:
  Handle handle_ = nullptr;
};

}  // namespace hf_test
