// The factor of dense.h as its loops read it: panels of eight rows, and once more panels of eight columns, so that both
// sweeps read memory in order. Shared by dense.cpp and its AVX2 and AVX-512 builds.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::deform {

struct DensePanels {
  static constexpr std::size_t wide = 8;  // rows or columns of a panel; no result depends on it
  std::size_t size;                       // unknowns
  // Panel p holds the rows 8 p .. 8 p + 7 column by column, up to column 8 p + 7. Entries on and above the diagonal are
  // 0.
  const double* rows;
  // Panel p holds the columns 8 p .. 8 p + 7 row by row, from row 8 p on. Entries on and above the diagonal are 0.
  const double* columns;
  const double* inverse_pivot;
  static std::size_t count(std::size_t size) noexcept { return (size + wide - 1) / wide; }
  // Where panel p of `rows` begins; with p = count(size), where the last one ends.
  static std::size_t rows_at(std::size_t p) noexcept { return wide * wide * (p * (p + 1) / 2); }
  static std::size_t columns_at(std::size_t p, std::size_t count) noexcept {
    return rows_at(count) - rows_at(count - p);
  }
};

// Solves L L' x = b in place for 3 or 4 right-hand sides: x[4 * unknown + k].
using DenseLoop = void (*)(const DensePanels& factor, int sides, double* x) noexcept;
void solve_dense(const DensePanels& factor, int sides, double* x) noexcept;
void solve_dense_avx2(const DensePanels& factor, int sides, double* x) noexcept;
void solve_dense_avx512(const DensePanels& factor, int sides, double* x) noexcept;

}  // namespace hf_inner::deform
