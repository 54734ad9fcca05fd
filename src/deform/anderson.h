// Anderson acceleration of a fixed-point iteration (Anderson 1965; for local and global steps Peng and others 2018).
//
// The iteration z <- z + f(z) turns slowly what no handle holds, such as a free arm. The last steps tell how the
// residual f answers to a change of z. With the columns dZ and dF of their differences,
//     theta = argmin |f - dF theta|,   z <- z + f - (dZ + dF) theta.
// Steps of earlier frames count too, so a drag learns its slow motions as it goes.
//
// Only fit() allocates and can fail.
#pragma once
#include <array>
#include <cstddef>

#include "base/memory.h"
#include "base/span.h"
#include "deform/constants.h"

namespace hf_inner::deform {

class Anderson {
 public:
  explicit Anderson(Memory& memory) : store_(&memory) {}
  Anderson(const Anderson& other, Memory& memory)
      : store_(other.store_, &memory),
        gram_(other.gram_),
        right_(other.right_),
        size_(other.size_),
        count_(other.count_),
        next_(other.next_),
        last_residual_(other.last_residual_),
        open_(other.open_) {}
  // Makes room for an iterate of `size` numbers and forgets all steps.
  void fit(std::size_t size);
  void forget() noexcept {
    count_ = next_ = 0;
    open_ = false;
  }
  // The map changes: the next change of the iterate says nothing about the map. Steps before count on.
  void break_off() noexcept { open_ = false; }
  // Replaces the iterate z by the next one. f: its residual. Both have the size of fit(), a multiple of `block`. The
  // step of the acceleration is shortened until no block of numbers changes by more than `longest`.
  void step(Span<double> z, Span<const double> f, std::size_t block, double longest) noexcept;

 private:
  double* df(std::size_t k) noexcept { return store_.data() + 2 * k * size_; }
  double* both(std::size_t k) noexcept { return df(k) + size_; }
  double* last_z() noexcept { return store_.data() + 2 * anderson_steps * size_; }
  double* last_f() noexcept { return last_z() + size_; }
  double* leap() noexcept { return last_f() + size_; }
  void keep_difference(Span<const double> z, Span<const double> f) noexcept;

  Vector<double> store_;  // df and dz + df of every kept step, then the last iterate, its residual, and a leap
  std::array<std::array<double, anderson_steps>, anderson_steps> gram_{};  // dF' dF
  std::array<double, anderson_steps> right_{};                             // dF' f
  std::size_t size_ = 0, count_ = 0, next_ = 0;                            // kept steps; where the next one goes
  double last_residual_ = 0;                                               // squared
  bool open_ = false;  // the last iterate and its residual belong to the present map
};

}  // namespace hf_inner::deform
