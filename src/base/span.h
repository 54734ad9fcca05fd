// Span views contiguous memory owned by another object, as std::span of C++20 does. Rows views rows at a byte stride.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace hf_inner {

template <class T>
class Span {
 public:
  constexpr Span() noexcept = default;
  constexpr Span(T* data, std::size_t size) noexcept : data_(data), size_(size) {}
  template <class Container,
            class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<Container&>().data()), T*>>>
  constexpr Span(Container& container) noexcept : data_(container.data()), size_(container.size()) {}
  template <class Container,
            class = std::enable_if_t<std::is_const_v<T> &&
                                     std::is_convertible_v<decltype(std::declval<const Container&>().data()), T*>>,
            class = void>
  constexpr Span(const Container& container) noexcept : data_(container.data()), size_(container.size()) {}

  constexpr T* data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr T* begin() const noexcept { return data_; }
  constexpr T* end() const noexcept { return data_ + size_; }
  constexpr T& operator[](std::size_t i) const noexcept { return data_[i]; }
  constexpr Span subspan(std::size_t offset, std::size_t count) const noexcept { return {data_ + offset, count}; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

// Rows of floats or doubles, `stride` bytes apart and possibly unaligned. ConstRows reads the numbers as doubles, and
// Rows writes doubles to them.
class ConstRows {
 public:
  ConstRows() noexcept = default;
  ConstRows(const float* data, std::size_t stride) noexcept
      : bytes_(reinterpret_cast<const char*>(data)), stride_(stride), is_double_(false) {}
  ConstRows(const double* data, std::size_t stride) noexcept
      : bytes_(reinterpret_cast<const char*>(data)), stride_(stride), is_double_(true) {}
  ConstRows(const void* data, std::size_t stride, bool is_double) noexcept
      : bytes_(static_cast<const char*>(data)), stride_(stride), is_double_(is_double) {}
  explicit operator bool() const noexcept { return bytes_ != nullptr; }
  double get(std::size_t row, std::size_t column) const noexcept {
    const char* p = bytes_ + row * stride_;
    if (is_double_) {
      double v;
      std::memcpy(&v, p + column * sizeof(double), sizeof v);
      return v;
    }
    float v;
    std::memcpy(&v, p + column * sizeof(float), sizeof v);
    return static_cast<double>(v);
  }

 private:
  const char* bytes_ = nullptr;
  std::size_t stride_ = 0;
  bool is_double_ = false;
};

// Rows of indices in 32 or 16 bits, `stride` bytes apart and possibly unaligned.
class IndexRows {
 public:
  IndexRows() noexcept = default;
  IndexRows(const std::uint32_t* packed, std::size_t width) noexcept
      : IndexRows(packed, width * sizeof(std::uint32_t), false) {}
  IndexRows(const void* data, std::size_t stride, bool narrow) noexcept
      : bytes_(static_cast<const char*>(data)), stride_(stride), narrow_(narrow) {}
  explicit operator bool() const noexcept { return bytes_ != nullptr; }
  std::uint32_t get(std::size_t row, std::size_t column) const noexcept {
    const char* p = bytes_ + row * stride_;
    if (narrow_) {
      std::uint16_t v;
      std::memcpy(&v, p + column * sizeof v, sizeof v);
      return v;
    }
    std::uint32_t v;
    std::memcpy(&v, p + column * sizeof v, sizeof v);
    return v;
  }

 private:
  const char* bytes_ = nullptr;
  std::size_t stride_ = 0;
  bool narrow_ = false;
};

class Rows {
 public:
  Rows() noexcept = default;
  Rows(float* data, std::size_t stride) noexcept
      : bytes_(reinterpret_cast<char*>(data)), stride_(stride), is_double_(false) {}
  Rows(double* data, std::size_t stride) noexcept
      : bytes_(reinterpret_cast<char*>(data)), stride_(stride), is_double_(true) {}
  Rows(void* data, std::size_t stride, bool is_double) noexcept
      : bytes_(static_cast<char*>(data)), stride_(stride), is_double_(is_double) {}
  explicit operator bool() const noexcept { return bytes_ != nullptr; }
  bool is_double() const noexcept { return is_double_; }
  // As they were given, for code that writes whole rows.
  char* bytes() const noexcept { return bytes_; }
  std::size_t stride() const noexcept { return stride_; }
  void set(std::size_t row, std::size_t column, double value) const noexcept {
    char* p = bytes_ + row * stride_;
    if (is_double_) {
      std::memcpy(p + column * sizeof(double), &value, sizeof value);
    } else {
      const float v = static_cast<float>(value);
      std::memcpy(p + column * sizeof(float), &v, sizeof v);
    }
  }

 private:
  char* bytes_ = nullptr;
  std::size_t stride_ = 0;
  bool is_double_ = false;
};

}  // namespace hf_inner
