// Dense kernels of the factorisation, compiled once for every instruction set (kernels_plain.cpp, kernels_avx2.cpp,
// kernels_avx512.cpp) and chosen at run time. Each element of a result is one chain of fused multiply-adds in a fixed
// order, so AVX2 and AVX-512 give the same bits. The plain build rounds every product and differs in the last digits.
//
// Front of a supernode with nc columns and m rows below: rows in tiles of 8, the nc triangle rows padded to a multiple
// of 8, then the m rows padded likewise. Panel: [tile][column][8]. Update matrix: lower triangle by column tiles of 8
// columns, tile t column-major with all rows from 8 t on, so its columns are 8 (T - t) numbers apart for T tiles.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

// Where column tile t of an update matrix of `tiles` tiles begins.
constexpr std::int64_t update_tile_start(std::int64_t tiles, std::int64_t t) noexcept {
  return 64 * (t * tiles - t * (t - 1) / 2);
}

// One front in work.
struct FrontView {
  double* panel;
  double* update;
  std::int32_t columns;         // nc
  std::int32_t below;           // m
  std::int32_t triangle_tiles;  // ceil(nc / 8)
  std::int32_t below_tiles;     // ceil(m / 8)
};

// A child's update matrix on its way into the parent's front. Its rows fall into runs that are consecutive in the front
// too.
struct ChildView {
  const double* update;
  std::int32_t tiles;
  std::int32_t size;          // rows of the child below its triangle
  std::int32_t into_panel;    // its first columns, those that fall into the parent's triangle
  const std::int32_t* place;  // padded row of the parent's front, ascending
  const std::int32_t* run;    // first rows of the runs, ending with `size`
};

// Supernodes of at most this many columns are stored solved: X = L^-1 and B X in place of L and B (kernels_narrow.inl).
constexpr std::int32_t narrow_columns = 16;

struct Kernels {
  const char* name;

  // Factors columns [begin, end) of the panel on the triangle tiles that hold them; begin is a multiple of 8, columns
  // before begin are done. The diagonal is stored inverted. A pivot must exceed `floor` of its column. Returns the
  // column whose pivot failed, or -1.
  std::int32_t (*factor_triangle)(const FrontView& front, std::int32_t begin, std::int32_t end, const double* floor);
  // Columns [begin, end) on tiles [tile_begin, tile_end), all below the triangle tiles of those columns.
  void (*solve_tiles)(const FrontView& front, std::int32_t begin, std::int32_t end, std::int32_t tile_begin,
                      std::int32_t tile_end);
  // Column tiles [tile_begin, tile_end) of the update matrix = -B B'.
  void (*form_update)(const FrontView& front, std::int32_t tile_begin, std::int32_t tile_end);
  // Adds columns [begin, end) of the child's update matrix to panel and update matrix.
  void (*extend_add)(const FrontView& front, const ChildView& child, std::int32_t begin, std::int32_t end);
  // A narrow front, after its update matrix: X in place of L, then W = B X on tiles [tile_begin, tile_end) below.
  void (*invert_triangle)(const FrontView& front);
  void (*multiply_inverse)(const FrontView& front, std::int32_t tile_begin, std::int32_t tile_end);
  // Writes tiles [tile_begin, tile_end) row by row: packed triangle, then the rows below.
  void (*store_tiles)(const FrontView& front, double* values, std::int32_t tile_begin, std::int32_t tile_end);

  // Backward sweep of one supernode on z[row * channels + channel]:
  // z[first + j] -= sum over the rows below of B[row][j] z[row], for columns j in [begin, end).
  void (*backward_rows)(const double* below, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                        std::int32_t begin, std::int32_t end, double* z, std::int32_t first, std::int32_t channels);
  // z <- L^-T z on the packed triangle.
  void (*backward_triangle)(const double* triangle, std::int32_t columns, double* z, std::int32_t channels);
  // Both of a narrow supernode.
  void (*backward_narrow)(const double* triangle, const std::int32_t* rows, std::int32_t row_count,
                          std::int32_t columns, double* z, std::int32_t first, std::int32_t channels);
  void (*backward_narrow_f32)(const float* triangle, const std::int32_t* rows, std::int32_t row_count,
                              std::int32_t columns, float* z, std::int32_t first, std::int32_t channels);
  // The same two on the single-precision copy.
  void (*backward_rows_f32)(const float* below, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                            std::int32_t begin, std::int32_t end, float* z, std::int32_t first, std::int32_t channels);
  void (*backward_triangle_f32)(const float* triangle, std::int32_t columns, float* z, std::int32_t channels);
  // Forward: z <- L^-1 z on the triangle, then out[k * channels] = B[k] z for every row k below (not subtracted); for a
  // narrow supernode the rows come before the triangle.
  void (*forward_triangle)(const double* triangle, std::int32_t columns, double* z, std::int32_t channels);
  void (*forward_rows)(const double* below, std::int32_t row_count, std::int32_t columns, const double* z, double* out,
                       std::int32_t channels);
  void (*forward_triangle_f32)(const float* triangle, std::int32_t columns, float* z, std::int32_t channels);
  void (*forward_rows_f32)(const float* below, std::int32_t row_count, std::int32_t columns, const float* z, float* out,
                           std::int32_t channels);

  // Path blocks x[nc][lanes], lanes a multiple of 8: x <- L^-1 x, then x[target[k]] -= B[k] x for every row below;
  // narrow ones the other way round.
  void (*path_triangle)(const double* triangle, std::int32_t columns, double* x, std::int32_t lanes);
  void (*path_rows)(const double* below, std::int32_t row_count, std::int32_t columns, const double* x,
                    std::int32_t lanes, double* base, const std::int64_t* target);
  // gram[i * stride + j] += sum over rows of a[row * a_lanes + i] b[row * b_lanes + j]; i < a_count, j < b_count
  // rounded up to 8.
  void (*gram)(const double* a, std::int32_t a_lanes, std::int32_t a_count, const double* b, std::int32_t b_lanes,
               std::int32_t b_count, std::int32_t rows, double* gram, std::int32_t stride);
};

// The best set this processor runs.
const Kernels& choose_kernels() noexcept;

// The sets by themselves, for tests that compare them; null when this build or processor has no such set.
const Kernels* plain_kernels() noexcept;
const Kernels* avx2_kernels() noexcept;
const Kernels* avx512_kernels() noexcept;

}  // namespace hf_inner
